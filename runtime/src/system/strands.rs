//! How the components of positions and momenta lie in memory.

use core::ops::Range;

use crate::number::Vector;

/// How the components of positions and momenta lie in memory: in their order, or with a part of them in strands side by side,
///
/// ```text
/// 0 1 2 3 4 5 6 7 8 9     in two strands of four from the second one on:     0 1 5 2 6 3 7 4 8 9
/// ```
///
/// A system whose components feel their neighbours, as a [`Chain`](crate::emitted::Chain) is one, has the neighbours of a whole row of
/// strands in the rows before and after it: nothing is moved from one lane of the processor to another. Rows may begin at another
/// place in the momenta than in the positions, for each to lie well; the components that are in no strand keep their order.
///
/// ```
/// use symplectic::system::Layout;
///
/// let layout = Layout::strands(2, 4, [1, 2]);
/// let (mut q, mut p) = ([0, 1, 2, 3, 4, 5, 6, 7, 8, 9], [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
/// let mut place = [0; 10];
/// assert!(layout.put((&mut q, &mut p), &mut place));
/// assert_eq!(q, [0, 1, 5, 2, 6, 3, 7, 4, 8, 9]);
/// assert_eq!(p, [0, 9, 1, 5, 2, 6, 3, 7, 4, 8]);
/// assert!(layout.put_back((&mut q, &mut p), &mut place));
/// assert_eq!((q, p), ([0, 1, 2, 3, 4, 5, 6, 7, 8, 9], [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    strands: usize,
    length: usize,
    begin: [usize; 2],
}

impl Layout {
    /// All in their order.
    pub const NATURAL: Self = Self {
        strands: 0,
        length: 0,
        begin: [0, 0],
    };

    /// So many strands of so many components each, side by side, where `begin` is where their rows begin in the positions and in the
    /// momenta. They are the components from where they begin in the positions on. Of less than two strands, or of strands of less
    /// than two components, it is [`NATURAL`](Self::NATURAL).
    pub const fn strands(strands: usize, length: usize, begin: [usize; 2]) -> Self {
        if strands < 2 || length < 2 {
            return Self::NATURAL;
        }
        Self {
            strands,
            length,
            begin,
        }
    }

    /// Whether all are in their order.
    pub const fn is_natural(&self) -> bool {
        self.strands == 0
    }

    /// Puts positions and momenta, which are in their order, into this layout, with a `place` for as many components. `false` where
    /// one of the three is too short for it; then all stay as they are.
    #[must_use = "where there is no place for the layout the state is as before"]
    pub fn put<T: Copy>(&self, state: (&mut [T], &mut [T]), place: &mut [T]) -> bool {
        self.change(state, place, Lying::put)
    }

    /// Puts positions and momenta, which are in this layout, back into their order; as [`put`](Self::put) with a `place`.
    #[must_use = "where there is no place for the layout the state is as before"]
    pub fn put_back<T: Copy>(&self, state: (&mut [T], &mut [T]), place: &mut [T]) -> bool {
        self.change(state, place, Lying::put_back)
    }

    /// [`put`](Self::put) of vectors.
    pub(crate) fn put_vectors<V: Vector>(&self, (q, p): (&mut V, &mut V), place: &mut V) -> bool {
        self.put((q.as_mut_slice(), p.as_mut_slice()), place.as_mut_slice())
    }

    /// [`put_back`](Self::put_back) of vectors.
    pub(crate) fn put_vectors_back<V: Vector>(
        &self,
        (q, p): (&mut V, &mut V),
        place: &mut V,
    ) -> bool {
        self.put_back((q.as_mut_slice(), p.as_mut_slice()), place.as_mut_slice())
    }

    /// Whether it has a place in so many components.
    fn fits(&self, dimension: usize) -> bool {
        let end = (self.strands.checked_mul(self.length))
            .and_then(|count| self.begin[0].max(self.begin[1]).checked_add(count));
        end.is_some_and(|end| end <= dimension)
    }

    /// From where to where the rows of strands are in the positions.
    pub(crate) const fn rows(&self) -> (usize, usize) {
        let [begin, _] = self.begin;
        (begin, begin + self.strands * self.length)
    }

    /// The parts of a state of so many components, the strands the [third](ROWS).
    pub(crate) fn parts(&self, dimension: usize) -> [Part; 5] {
        parts(self.rows(), self.begin[1], dimension)
    }

    fn change<T: Copy>(
        &self,
        (q, p): (&mut [T], &mut [T]),
        place: &mut [T],
        change: impl Fn(&Lying, &mut [T], &[T]),
    ) -> bool {
        if self.is_natural() {
            return true;
        }
        let n = q.len().min(p.len()).min(place.len());
        if !self.fits(n) {
            return false;
        }
        let Self {
            strands,
            length,
            begin,
        } = *self;
        for (vector, begin) in [q, p].into_iter().zip(begin) {
            let (vector, place) = (&mut vector[..n], &mut place[..n]);
            place.copy_from_slice(vector);
            let lying = Lying {
                parts: parts(self.rows(), begin, n),
                strands,
                length,
            };
            change(&lying, vector, place);
        }
        true
    }
}

/// Components that lie together in the positions and in the momenta.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    /// Where they begin in the positions.
    pub(crate) q: usize,
    /// Where they begin in the momenta.
    pub(crate) p: usize,
    pub(crate) length: usize,
}

impl Part {
    /// Its place in the positions.
    #[inline(always)]
    pub(crate) const fn in_q(&self) -> Range<usize> {
        self.q..self.q + self.length
    }

    /// Its place in the momenta.
    #[inline(always)]
    pub(crate) const fn in_p(&self) -> Range<usize> {
        self.p..self.p + self.length
    }
}

/// Which of the [`parts`] has the rows.
const ROWS: usize = 2;

/// The parts of vectors of so many components with rows from `begin` to `end` in the positions, and from `in_p` on in the momenta.
#[inline(always)]
pub(crate) fn parts((begin, end): (usize, usize), in_p: usize, dimension: usize) -> [Part; 5] {
    let part = |q: usize, p: usize, end: usize| Part {
        q,
        p,
        length: end.saturating_sub(q),
    };
    let (same, count) = (begin.min(in_p), end - begin);
    // Where rows begin later in the momenta, as many of the components after them lie before them.
    let moved = end + in_p.saturating_sub(begin);
    [
        part(0, 0, same),
        part(same, same + count, begin),
        part(begin, in_p, end),
        part(end, begin, moved),
        part(moved, moved, dimension),
    ]
}

/// How one vector lies.
struct Lying {
    /// Where its components are in their order, and where in memory.
    parts: [Part; 5],
    strands: usize,
    length: usize,
}

impl Lying {
    /// From `place`, in their order.
    fn put<T: Copy>(&self, vector: &mut [T], place: &[T]) {
        for (number, part) in self.parts.iter().enumerate() {
            let (vector, place) = (&mut vector[part.in_p()], &place[part.in_q()]);
            if number != ROWS {
                vector.copy_from_slice(place);
                continue;
            }
            for (row, components) in vector.chunks_exact_mut(self.strands).enumerate() {
                for (strand, component) in components.iter_mut().enumerate() {
                    *component = place[strand * self.length + row];
                }
            }
        }
    }

    /// From `place`, where they are as in memory.
    fn put_back<T: Copy>(&self, vector: &mut [T], place: &[T]) {
        for (number, part) in self.parts.iter().enumerate() {
            let (vector, place) = (&mut vector[part.in_q()], &place[part.in_p()]);
            if number != ROWS {
                vector.copy_from_slice(place);
                continue;
            }
            for (row, components) in place.chunks_exact(self.strands).enumerate() {
                for (strand, &component) in components.iter().enumerate() {
                    vector[strand * self.length + row] = component;
                }
            }
        }
    }
}
