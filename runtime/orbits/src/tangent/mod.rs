//! The tangent map: growth of a small displacement along an orbit, and indicators of chaos.
//!
//! * [`Tangent`] is a system together with its variational equations.
//! * [`Megno`] computes an indicator of chaos and the largest Lyapunov exponent from its trajectory.

mod dual_vector;
mod megno;

pub use crate::error::Error;
pub use megno::Megno;

use alloc::vec;

use dual_vector::{halves, halves_mut, joined, part, zeros};

use symplectic_core::inside::{check_start, check_state, first};
use symplectic_core::simd::Lanes;
use symplectic_core::solver::Automatic;
use symplectic_core::system::{Class, Conservative, LaneWork, OverEveryScalar};
use symplectic_core::{Hamiltonian, Quantity, Scalar, State, System, Vector};
use symplectic_linearisation::Dual;

/// A system together with its variational equations, for positions `(q, δq)` and momenta `(δp, p)`:
///
/// ```text
/// q' = ∂H/∂p     δq' = D(∂H/∂p)·(δq, δp)      δp' = −D(∂H/∂q)·(δq, δp)     p' = −∂H/∂q
/// ```
///
/// With these conjugate pairs it is a Hamiltonian system with `K = DH·(δq, δp)`, its [energy](System::energy). So
/// steps, events and solvers apply unchanged. The derivatives are exact: dual numbers run through the code of the
/// system.
///
/// A step of an explicit method maps the displacement `(δq, δp)` by the derivative of the step map. So the symplectic
/// product of two displacements is conserved, and `(q, p)` has the same bits as without a displacement.
///
/// The vectors have twice the dimension: `SVector<f64, 4>` for two positions. The system runs like any other, also in the lanes of
/// an `Ensemble`. In steps of variable size the monitor depends on `q`
/// only. Each step then maps the displacement by its derivative at fixed size, which agrees with the variational equations to the
/// order of the method.
///
/// Limits: systems with friction or constraints, closures and chains have no tangent system. Dynamic vectors are allocated in every
/// evaluation; prefer fixed sizes. If velocity or force is not differentiable, such as `|x|` at zero written as a root, a step
/// fails with [`NonFinite`](symplectic_core::Error::NonFinite).
///
/// A displacement is a direction. Choose it no longer than the state: a new integrator checks whether the velocity is
/// linear in the momentum, relative to the largest component. Explicit methods work with any shorter length; a
/// displacement of length 10⁻³⁰⁰ may grow by 10⁶⁰⁰ before a run ends with this error. The iteration of an
/// implicit method stops when the largest components no longer change. There, use a displacement about as long as the
/// state and compensated sums, which remain accurate for a growth by 10¹⁰.
///
/// ```
/// use symplectic::nalgebra::{SVector, Vector2};
/// use symplectic::tangent::{Error, Megno, Tangent};
/// use symplectic::{Integrator, State};
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

    /// The original system.
    pub const fn system(&self) -> &S {
        &self.0
    }
}

impl<S: Hamiltonian> Tangent<S> {
    /// The state of the tangent system for `state` with the displacement `(δq, δp)`.
    ///
    /// # Errors
    ///
    /// [`Error::NoDisplacement`] for a zero displacement. [`Error::Core`] with `Dimension`, `NonFiniteState`, or `Length` if the vectors `W`
    /// do not have twice the dimension of the system.
    pub fn start<W: Vector<Scalar = f64>>(
        &self,
        state: &State<S::Vector<f64>>,
        (dq, dp): (&S::Vector<f64>, &S::Vector<f64>),
    ) -> Result<State<W>, Error> {
        let dimension = state.q.dimension();
        check_start(&self.0, state)?;
        check_state(state.time, dq, dp, dimension).map_err(|error| match error {
            symplectic_core::Error::NonFiniteState { .. } => {
                symplectic_core::Error::NonFiniteState {
                    what: Quantity::Displacement,
                }
            }
            error => error,
        })?;
        let mut parts = dq.as_slice().iter().chain(dp.as_slice());
        if parts.all(|&part| part == 0.0) {
            return Err(Error::NoDisplacement);
        }
        let both = |one: &S::Vector<f64>, other: &S::Vector<f64>| {
            W::from_slice(&[one.as_slice(), other.as_slice()].concat())
        };
        let q = both(&state.q, dq)?;
        Ok(State::new(state.time, q, both(dp, &state.p)?))
    }

    /// The state without its displacement.
    ///
    /// # Errors
    ///
    /// [`Error::Core`] with `Length` if the vectors `W` do not have twice the dimension of the system.
    pub fn state<W: Vector<Scalar = f64>>(
        &self,
        state: &State<W>,
    ) -> Result<State<S::Vector<f64>>, Error> {
        check_even(&state.q)?;
        check_even(&state.p)?;
        let q = S::Vector::from_slice(halves(state.q.as_slice()).0)?;
        let p = S::Vector::from_slice(halves(state.p.as_slice()).1)?;
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
        check_even(&state.q)?;
        check_even(&state.p)?;
        let dq = S::Vector::from_slice(halves(state.q.as_slice()).1)?;
        Ok((dq, S::Vector::from_slice(halves(state.p.as_slice()).0)?))
    }
}

/// Checks that the dimension is even.
fn check_even<W: Vector>(vector: &W) -> Result<(), symplectic_core::Error> {
    match vector.dimension() {
        found if found % 2 == 1 => Err(symplectic_core::Error::Length {
            expected: found + 1,
            found,
        }),
        _ => Ok(()),
    }
}

/// The displacements `(δq, δp)` of a system.
pub type Displacement<S> = (
    <S as Hamiltonian>::Vector<f64>,
    <S as Hamiltonian>::Vector<f64>,
);

/// The vectors of a system over dual numbers.
type Duals<S, W> = <S as Hamiltonian>::Vector<Dual<<W as Vector>::Scalar>>;

/// The dual position of `(q, δq)`, the dual momentum of `(δp, p)`, and a zero vector; `None` if the vectors of the
/// system have another dimension.
#[cfg_attr(not(debug_assertions), inline(always))]
fn duals<S: Hamiltonian, W: Vector>(q: &W, p: &W) -> Option<[Duals<S, W>; 3]> {
    let (values, slopes) = halves(q.as_slice());
    let q = joined(values, slopes)?;
    let (slopes, values) = halves(p.as_slice());
    Some([q, joined(values, slopes)?, zeros(values.len())?])
}

/// Writes a velocity as `(v, δv)`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn write_velocity<W: Vector>(duals: &[Dual<W::Scalar>], out: &mut W) {
    let (values, slopes) = halves_mut(out.as_mut_slice());
    part(duals, values, slopes);
}

/// Writes a force as `(δf, f)`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn write_force<W: Vector>(duals: &[Dual<W::Scalar>], out: &mut W) {
    let (slopes, values) = halves_mut(out.as_mut_slice());
    part(duals, values, slopes);
}

/// Writes NaN as velocity or force: the first step then fails, and [`System::explain`] gives the reason.
fn write_nothing<W: Vector>(out: &mut W) {
    out.as_mut_slice().fill(W::Scalar::from_f64(f64::NAN));
}

impl<S: Hamiltonian<Class: Conservative>, W: Vector> System<W> for Tangent<S> {
    type Class = S::Class;
    type Solver = Automatic;

    const FORCED: bool = S::FORCED;
    const WELL_DECLARED: bool = S::WELL_DECLARED;
    const DISPLACED: bool = true;
    const INLINED: bool = S::INLINED;

    fn check_dimension(&self, dimension: usize) -> Result<(), symplectic_core::Error> {
        self.0.check_dimension(dimension / 2)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocity(&self, time: W::Scalar, q: &W, p: &W, velocity: &mut W) {
        // The velocity of a separable system does not depend on q; any vector serves.
        let q = if S::Class::SEPARABLE { p } else { q };
        let Some([q, p, mut found]) = duals::<S, W>(q, p) else {
            return write_nothing(velocity);
        };
        self.0.velocity(Dual::constant(time), &q, &p, &mut found);
        write_velocity(found.as_slice(), velocity);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force(&self, time: W::Scalar, q: &W, p: &W, force: &mut W) {
        let p = if S::Class::SEPARABLE { q } else { p };
        let Some([q, p, mut found]) = duals::<S, W>(q, p) else {
            return write_nothing(force);
        };
        self.0.force(Dual::constant(time), &q, &p, &mut found);
        write_force(found.as_slice(), force);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes(&self, time: W::Scalar, q: &W, p: &W, (velocity, force): (&mut W, &mut W)) {
        let Some([q, p, mut rates]) = duals::<S, W>(q, p) else {
            write_nothing(velocity);
            return write_nothing(force);
        };
        let mut found = rates.zeros_like();
        let both = (&mut rates, &mut found);
        self.0.slopes(Dual::constant(time), &q, &p, both);
        write_velocity(rates.as_slice(), velocity);
        write_force(found.as_slice(), force);
    }

    /// `K = DH·(δq, δp)`; H is the energy of the [system](Self::system) at the [state](Self::state).
    fn energy(&self, time: W::Scalar, q: &W, p: &W) -> Option<W::Scalar> {
        let [q, p, _] = duals::<S, W>(q, p)?;
        let energy = self.0.energy(Dual::constant(time), &q, &p)?;
        Some(energy.slope)
    }

    fn applied_force(&self, time: W::Scalar, q: &W, p: &W, applied: &mut W) {
        let Some([q, p, mut found]) = duals::<S, W>(q, p) else {
            return write_nothing(applied);
        };
        self.0
            .applied_force(Dual::constant(time), &q, &p, &mut found);
        write_force(found.as_slice(), applied);
    }

    /// Replaces the error if the vectors of the system have another dimension.
    fn explain(&self, error: symplectic_core::Error, q: &W) -> symplectic_core::Error {
        if let Err(odd) = check_even(q) {
            return odd;
        }
        match S::Vector::from_slice(&vec![0.0; q.dimension() / 2]) {
            Err(symplectic_core::Error::Length { expected, .. }) => {
                symplectic_core::Error::Length {
                    expected: 2 * expected,
                    found: q.dimension(),
                }
            }
            _ => error,
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn over_lanes<L: Lanes, K: LaneWork<W, Self, L>>(work: K) -> Option<K::Output>
    where
        Self: Clone,
    {
        Some(work.run::<W::With<L>, Self>(first))
    }
}

impl<S: Hamiltonian<Class: Conservative>, W: Vector> OverEveryScalar<W> for Tangent<S> {
    type Doubles = W::With<f64>;
}
