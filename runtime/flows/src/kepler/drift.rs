//! The exact flow of bodies on Kepler orbits.

use alloc::vec;
use alloc::vec::Vec;
use core::marker::PhantomData;

use super::free::Free;
use super::groups::{gather, scatter};
use super::in_lanes::changes;
use super::orbit::{NoEnd, Orbit};
use crate::{Error, Flow, FlowError, Span, check_count, check_dimension, check_parameter};
use symplectic_core::Vector;
use symplectic_core::inside::array;
use symplectic_core::simd::{F64x2, F64x4, F64x8, Lanes};

/// The flow of `H = Σ |p|²/(2m) − mμ/|q|`: any number of bodies in space, each on a Kepler orbit about the origin. They are computed in
/// lanes of `L`, the last ones in narrower lanes.
///
/// Ellipses, parabolas, hyperbolas and lines are one case. With the universal anomaly s, `t' = |q|`, Stumpff's functions
/// `G_k = s^k c_k(βs²)` and `β = 2μ/|q| − |v|²`, the end is (Battin, *An introduction to the mathematics and methods of astrodynamics*,
/// 4.5; Rein & Tamayo, *MNRAS* 452, 2015)
///
/// ```text
/// h = |q| G1 + (q·v) G2 + μ G3      q1 = f q + g v     v1 = f' q + g' v
/// f = 1 − μG2/|q|      g = h − μG3      f' = −μG1/(|q||q1|)      g' = 1 − μG2/|q1|
/// ```
///
/// $$ h = |q| G_1 + (q \cdot v) G_2 + \mu G_3 \qquad f = 1 - \frac{\mu G_2}{|q|} \qquad g = h - \mu G_3 $$
///
/// A body that falls into the centre turns back there, which is the limit of thin ellipses.
///
/// # Errors
///
/// [`FlowError::AtCentre`] if a body starts or ends at the centre, [`FlowError::Periods`], [`FlowError::NoOrbit`] if its end overflows or
/// loses half of its digits, [`FlowError::Dimension`].
///
/// ```
/// use symplectic::flow::kepler::KeplerDrift;
/// use symplectic::flow::{Flow, Span};
/// use symplectic::nalgebra::Vector3;
///
/// // A circle, half a period.
/// let mut drift = KeplerDrift::new(&[1.0], &[1.0])?;
/// let (mut q, mut p) = (Vector3::x(), Vector3::y());
/// drift.flow(Span { time: 0.0, size: std::f64::consts::PI }, &mut q, &mut p).expect("a flow");
/// assert!((q + Vector3::x()).norm() < 1e-14);
/// # Ok::<(), symplectic::flow::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct KeplerDrift<L = F64x8> {
    /// A body that moves freely and comes before the others.
    free: Option<Free>,
    /// 1/m
    lighter: Vec<f64>,
    mus: Vec<f64>,
    /// Positions and momenta at the end.
    ends: [Vec<f64>; 2],
    lanes: PhantomData<L>,
}

impl KeplerDrift {
    /// Bodies with these masses, and the gravitational parameter μ of the centre for each of them.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] if a mass or a μ is not finite and positive, or their numbers differ.
    pub fn new(masses: &[f64], mus: &[f64]) -> Result<Self, Error> {
        check_count(
            "number of masses",
            masses.len(),
            masses.len() == mus.len(),
            "that of the gravitational parameters",
        )?;
        for (what, values) in [("mass", masses), ("gravitational parameter", mus)] {
            for (index, &value) in values.iter().enumerate() {
                check_parameter(what, index, value, false)?;
            }
        }
        Ok(Self::with(None, masses.into(), mus.into()))
    }

    /// Bodies that follow a free body of mass `free`.
    pub(super) fn of_checked(free: f64, masses: Vec<f64>, mus: Vec<f64>) -> Self {
        Self::with(Some(Free::new(free)), masses, mus)
    }

    fn with(free: Option<Free>, masses: Vec<f64>, mus: Vec<f64>) -> Self {
        Self {
            free,
            ends: [0; 2].map(|_| vec![0.0; 3 * masses.len()]),
            lighter: masses.iter().map(|mass| mass.recip()).collect(),
            mus,
            lanes: PhantomData,
        }
    }
}

impl<L: Lanes> KeplerDrift<L> {
    /// The same flow with another lane type; the results have the same bits.
    ///
    /// ```
    /// use symplectic::flow::kepler::KeplerDrift;
    /// use symplectic::simd::F64x4;
    ///
    /// let drift = KeplerDrift::new(&[1.0; 8], &[1.0; 8])?.in_lanes::<F64x4>();
    /// # Ok::<(), symplectic::flow::Error>(())
    /// ```
    pub fn in_lanes<W: Lanes>(self) -> KeplerDrift<W> {
        KeplerDrift {
            free: self.free,
            lighter: self.lighter,
            mus: self.mus,
            ends: self.ends,
            lanes: PhantomData,
        }
    }

    /// The ends of the orbits of a group of bodies; lanes without a body repeat the last orbit.
    fn group<W: Lanes>(
        &mut self,
        first: usize,
        h: f64,
        q: &[f64],
        p: &[f64],
    ) -> Result<usize, FlowError> {
        let of = |list: &[f64]| {
            let [lanes] = gather(list[first..].as_chunks().0);
            lanes
        };
        let [q, p] = [q, p].map(|list| gather::<W, 3>(&list.as_chunks().0[first..]));
        let orbit = Orbit::new(of(&self.mus), of(&self.lighter), q, p);
        let [a, b, c, d] = changes(&orbit, h).map_err(|(lane, why)| {
            let body = (first + lane).min(self.mus.len() - 1);
            let body = body + usize::from(self.free.is_some());
            match why {
                NoEnd::AtCentre => FlowError::AtCentre { body },
                NoEnd::Periods(periods) => FlowError::Periods { body, periods },
                NoEnd::NotFound => FlowError::NoOrbit { body },
            }
        })?;
        let [end_q, end_p] = &mut self.ends;
        let q1: [W; 3] = array(a, |axis| q[axis] + (a * q[axis] + b * p[axis]));
        let p1: [W; 3] = array(a, |axis| p[axis] + (c * q[axis] + d * p[axis]));
        scatter(q1, &mut end_q.as_chunks_mut().0[first..]);
        scatter(p1, &mut end_p.as_chunks_mut().0[first..]);
        Ok(W::WIDTH)
    }
}

impl<V: Vector<Scalar = f64>, L: Lanes> Flow<V> for KeplerDrift<L> {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let (count, h) = (self.mus.len(), span.size);
        let free = 3 * usize::from(self.free.is_some());
        check_dimension(3 * count + free, q)?;
        check_dimension(3 * count + free, p)?;
        let (free_q, q) = q.as_mut_slice().split_at_mut(free);
        let (free_p, p) = p.as_mut_slice().split_at_mut(free);
        let mut first = 0;
        while first < count {
            // One or two remaining bodies use two lanes, three or four use four.
            first += match count - first {
                1..=2 if L::WIDTH > 2 => self.group::<F64x2>(first, h, q, p)?,
                3..=4 if L::WIDTH > 4 => self.group::<F64x4>(first, h, q, p)?,
                _ => self.group::<L>(first, h, q, p)?,
            };
        }
        q.copy_from_slice(&self.ends[0]);
        p.copy_from_slice(&self.ends[1]);
        let places = (free_q.first_chunk_mut(), free_p.first_chunk());
        if let (Some(free), (Some(q), Some(p))) = (&mut self.free, places) {
            free.move_on(h, q, p);
        }
        Ok(())
    }

    fn memory(&mut self, visit: &mut dyn FnMut(&mut u64)) {
        let free = self.free.iter_mut();
        for low in free.flat_map(|free| free.low.iter_mut().chain(&mut free.place)) {
            let mut word = low.to_bits();
            visit(&mut word);
            *low = f64::from_bits(word);
        }
    }
}
