//! The tangent map: how a small displacement of the start grows along an orbit, and whether the orbit is chaotic.
//!
//! * [`Tangent`] is a system together with its variational equations.
//! * [`Megno`] is an indicator of chaos, and the largest Lyapunov exponent, from a run of it.

mod dual_vector;
mod megno;

pub use megno::Megno;

use alloc::vec;

use dual_vector::{halves, joined, part, zeros};

use crate::error::Error;
use crate::integrator::validation::check_state;
use crate::number::dual::Dual;
use crate::number::{Lanes, Scalar, Vector};
use crate::solver::Automatic;
use crate::state::State;
use crate::system::{Class, Conservative, Hamiltonian, LaneWork, OverEveryScalar, System};

/// A system together with its variational equations, for positions `(q, δq)` and momenta `(p, δp)`:
///
/// ```text
/// q' = ∂H/∂p     δq' = D(∂H/∂p)·(δq, δp)      p' = −∂H/∂q     δp' = −D(∂H/∂q)·(δq, δp)
/// ```
///
/// The derivatives are exact, by dual numbers through the code of the system. A step of an explicit method maps the displacement
/// `(δq, δp)` by the derivative of the step itself: two displacements keep their symplectic product, and `(q, p)` has the bits that it has
/// without a displacement.
///
/// The vectors have twice the dimension: `SVector<f64, 4>` for two positions. It runs like any other system, in the lanes of an
/// [`Ensemble`](crate::ensemble::Ensemble) too. Dynamic vectors are allocated in every evaluation: prefer fixed ones.
///
/// A displacement is a direction, and explicit methods do not care how long it is: one of length 10⁻³⁰⁰ may grow by 10⁶⁰⁰ before a run
/// ends with [`Error::NonFinite`]. With implicit methods it should not be much smaller than the state, for the iteration stops where
/// the largest numbers do not change any more.
///
/// ```
/// use symplectic::nalgebra::{SVector, Vector2};
/// use symplectic::tangent::{Megno, Tangent};
/// use symplectic::{Error, Integrator, State};
///
/// symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }
/// symplectic::hamiltonian! {
///     HenonHeiles
///     q: [x, y], p: [px, py];
///     H = (px^2 + py^2)/2 + (x^2 + y^2)/2 + x^2 y - y^3/3
/// }
///
/// /// The mean MEGNO after a time of 1000, of an orbit through x = 0 with the energy 1/8.
/// fn megno(y: f64, py: f64) -> Result<f64, Error> {
///     let px = (0.25 - y * y + 2.0 / 3.0 * y * y * y - py * py).sqrt();
///     let system = Tangent::new(HenonHeiles);
///     let displacement = (&Vector2::new(0.6, 0.3), &Vector2::new(-0.2, 0.7));
///     let start: State<SVector<f64, 4>> = system.start(&State::from_arrays(0.0, [0.0, y], [px, py]), displacement)?;
///     let mut megno = Megno::new(&start)?;
///     let mut run = Integrator::new(ForestRuth, system, start, 0.05)?;
///     for _ in 0..20_000 {
///         megno.see(run.step()?);
///     }
///     Ok(megno.mean())
/// }
///
/// # fn main() -> Result<(), Error> {
/// assert!(megno(0.2, 0.0)? < 2.5, "it is quasi-periodic");
/// assert!(megno(-0.16, 0.0)? > 10.0, "it is chaotic");
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Tangent<S>(S);

impl<S> Tangent<S> {
    /// A system together with its variational equations.
    pub const fn new(system: S) -> Self {
        Self(system)
    }

    /// The system.
    pub const fn system(&self) -> &S {
        &self.0
    }
}

impl<S: Hamiltonian> Tangent<S> {
    /// The state with a displacement `(δq, δp)`.
    ///
    /// # Errors
    ///
    /// [`Error::Dimension`], [`Error::NonFiniteState`]; [`Error::NoDisplacement`] where it is zero; [`Error::Length`] where the
    /// vectors `W` do not have twice the dimension.
    pub fn start<W: Vector<Scalar = f64>>(
        &self,
        state: &State<S::Vector<f64>>,
        (dq, dp): (&S::Vector<f64>, &S::Vector<f64>),
    ) -> Result<State<W>, Error> {
        let dimension = state.q.dimension();
        check_state(state.time, &state.q, &state.p, dimension)?;
        check_state(state.time, dq, dp, dimension)?;
        let mut parts = dq.as_slice().iter().chain(dp.as_slice());
        if parts.all(|&part| part == 0.0) {
            return Err(Error::NoDisplacement);
        }
        let both = |vector: &S::Vector<f64>, displacement: &S::Vector<f64>| {
            W::from_slice(&[vector.as_slice(), displacement.as_slice()].concat())
        };
        let q = both(&state.q, dq)?;
        Ok(State::new(state.time, q, both(&state.p, dp)?))
    }

    /// The state without its displacement.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] where the vectors `W` do not have twice the dimension of those of the system.
    pub fn state<W: Vector<Scalar = f64>>(
        &self,
        state: &State<W>,
    ) -> Result<State<S::Vector<f64>>, Error> {
        let q = S::Vector::from_slice(halves(&state.q).0)?;
        let p = S::Vector::from_slice(halves(&state.p).0)?;
        Ok(State::new(state.time, q, p))
    }

    /// The displacement `(δq, δp)` of a state.
    ///
    /// # Errors
    ///
    /// Those of [`state`](Self::state).
    pub fn displacement<W: Vector<Scalar = f64>>(
        &self,
        state: &State<W>,
    ) -> Result<Displacement<S>, Error> {
        let q = S::Vector::from_slice(halves(&state.q).1)?;
        Ok((q, S::Vector::from_slice(halves(&state.p).1)?))
    }
}

/// The displacements `(δq, δp)` of a system.
pub type Displacement<S> = (
    <S as Hamiltonian>::Vector<f64>,
    <S as Hamiltonian>::Vector<f64>,
);

/// The vectors of a system over dual numbers.
type Duals<S, W> = <S as Hamiltonian>::Vector<Dual<<W as Vector>::Scalar>>;

/// Writes what `function` gives at positions and momenta; NaN where the system has vectors of another dimension.
#[inline(always)]
fn evaluate<S: Hamiltonian, W: Vector>(
    (q, p): (&W, &W),
    out: &mut W,
    function: impl FnOnce(&Duals<S, W>, &Duals<S, W>, &mut Duals<S, W>),
) {
    let dimension = out.dimension();
    let found = zeros::<Duals<S, W>>(dimension / 2).filter(|_| dimension.is_multiple_of(2));
    let (Some(q), Some(p), Some(mut found)) = (joined(q), joined(p), found) else {
        out.as_mut_slice().fill(W::Scalar::from_f64(f64::NAN));
        return;
    };
    function(&q, &p, &mut found);
    part(&found, out);
}

impl<S: Hamiltonian<Class: Conservative>, W: Vector> System<W> for Tangent<S> {
    type Class = S::Class;
    type Solver = Automatic;

    const UNIT_MASSES: bool = S::UNIT_MASSES;
    const FORCED: bool = S::FORCED;

    #[inline(always)]
    fn velocity(&self, time: W::Scalar, q: &W, p: &W, velocity: &mut W) {
        // What it does not depend on is any vector at hand.
        let q = if S::Class::SEPARABLE { p } else { q };
        evaluate::<S, W>((q, p), velocity, |q, p, velocity| {
            self.0.velocity(Dual::constant(time), q, p, velocity);
        });
    }

    #[inline(always)]
    fn force(&self, time: W::Scalar, q: &W, p: &W, force: &mut W) {
        let p = if S::Class::SEPARABLE { q } else { p };
        evaluate::<S, W>((q, p), force, |q, p, force| {
            self.0.force(Dual::constant(time), q, p, force);
        });
    }

    #[inline(always)]
    fn slopes(&self, time: W::Scalar, q: &W, p: &W, (velocity, force): (&mut W, &mut W)) {
        evaluate::<S, W>((q, p), force, |q, p, found| {
            let mut rates = found.zeros_like();
            let both = (&mut rates, found);
            self.0.slopes(Dual::constant(time), q, p, both);
            part(&rates, velocity);
        });
    }

    fn energy(&self, time: W::Scalar, q: &W, p: &W) -> Option<W::Scalar> {
        let (q, p): (Duals<S, W>, Duals<S, W>) = (joined(q)?, joined(p)?);
        let energy = self.0.energy(Dual::constant(time), &q, &p)?;
        Some(energy.value)
    }

    fn applied_force(&self, time: W::Scalar, q: &W, p: &W, applied: &mut W) {
        evaluate::<S, W>((q, p), applied, |q, p, applied| {
            self.0.applied_force(Dual::constant(time), q, p, applied);
        });
    }

    /// Where the system has vectors of another dimension, that is what is wrong.
    fn explain(&self, error: Error, q: &W) -> Error {
        match S::Vector::from_slice(&vec![0.0; q.dimension() / 2]) {
            Err(Error::Length { expected, .. }) => Error::Length {
                expected: 2 * expected,
                found: q.dimension(),
            },
            _ => error,
        }
    }

    #[inline(always)]
    fn over_lanes<L: Lanes, K: LaneWork<W, Self, L>>(work: K) -> Option<K::Output> {
        Some(work.run::<W::With<L>>())
    }
}

impl<S: Hamiltonian<Class: Conservative>, W: Vector> OverEveryScalar<W> for Tangent<S> {
    type Doubles = W::With<f64>;
}
