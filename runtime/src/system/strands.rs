//! The order in memory of the components of positions and momenta.

use core::ops::Range;

use crate::number::Vector;

/// The order in memory of the components of positions and momenta: the natural order, or a part of them in strands side by side,
///
/// ```text
/// 0 1 2 3 4 5 6 7 8 9     in two strands of four from the second one on:     0 1 5 2 6 3 7 4 8 9
/// ```
///
/// In a system with forces between neighbours, such as a [`Chain`](crate::emitted::Chain), the neighbours of a whole row of
/// strands are the rows before and after it: nothing moves from one lane of the processor to another. Rows may begin at different
/// places in the momenta and in the positions, so that both are aligned. Components outside the strands keep their order.
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
    /// The natural order.
    pub const NATURAL: Self = Self {
        strands: 0,
        length: 0,
        begin: [0, 0],
    };

    /// `strands` strands of `length` components each, side by side; `begin` is where their rows begin in the positions and in the
    /// momenta. The strands hold the components from the first entry of `begin` on. With less than two strands, or less than
    /// two components per strand, it is [`NATURAL`](Self::NATURAL).
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

    /// Whether all components are in natural order.
    pub const fn is_natural(&self) -> bool {
        self.strands == 0
    }

    /// Reorders positions and momenta from the natural order to this layout. `place` is scratch memory of the same length. Returns `false`
    /// if one of the three is too short; then nothing changes.
    #[must_use = "where there is no place for the layout the state is as before"]
    pub fn put<T: Copy>(&self, state: (&mut [T], &mut [T]), place: &mut [T]) -> bool {
        self.change(state, place, Lying::put)
    }

    /// Reorders positions and momenta from this layout to the natural order, with a `place` as for [`put`](Self::put).
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

    /// Whether the layout fits `dimension` components.
    fn fits(&self, dimension: usize) -> bool {
        let end = (self.strands.checked_mul(self.length))
            .and_then(|count| self.begin[0].max(self.begin[1]).checked_add(count));
        end.is_some_and(|end| end <= dimension)
    }

    /// Begin and end of the rows of strands in the positions.
    pub(crate) const fn rows(&self) -> (usize, usize) {
        let [begin, _] = self.begin;
        (begin, begin + self.strands * self.length)
    }

    /// The parts of a state of `dimension` components; the strands are the [third part](ROWS).
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

/// Components that are contiguous in the positions and in the momenta.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    /// Their begin in the positions.
    pub(crate) q: usize,
    /// Their begin in the momenta.
    pub(crate) p: usize,
    pub(crate) length: usize,
}

impl Part {
    /// Their range in the positions.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) const fn in_q(&self) -> Range<usize> {
        self.q..self.q + self.length
    }

    /// Their range in the momenta.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) const fn in_p(&self) -> Range<usize> {
        self.p..self.p + self.length
    }
}

/// Index of the part with the rows among the [`parts`].
const ROWS: usize = 2;

/// The parts of vectors of `dimension` components, with rows from `begin` to `end` in the positions, and from `in_p` on in the momenta.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn parts((begin, end): (usize, usize), in_p: usize, dimension: usize) -> [Part; 5] {
    let part = |q: usize, p: usize, end: usize| Part {
        q,
        p,
        length: end.saturating_sub(q),
    };
    let (same, count) = (begin.min(in_p), end - begin);
    // If rows begin later in the momenta, the same number of later components precede them.
    let moved = end + in_p.saturating_sub(begin);
    [
        part(0, 0, same),
        part(same, same + count, begin),
        part(begin, in_p, end),
        part(end, begin, moved),
        part(moved, moved, dimension),
    ]
}

/// The order of one vector in memory.
struct Lying {
    /// The ranges of the components in natural order and in memory.
    parts: [Part; 5],
    strands: usize,
    length: usize,
}

impl Lying {
    /// Reorders from `place`, in natural order.
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

    /// Reorders from `place`, in the order of this layout.
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
