//! A formula as a system for integrators.

use std::fmt::Debug;
use std::marker::PhantomData;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use symplectic::constraints::{
    Constrained, ConstraintName, Gradients, HolonomicConstraints, Nonholonomic,
    NonholonomicConstraints,
};
use symplectic::emitted::LaneWork;
use symplectic::nalgebra::{DMatrix, DVector};
use symplectic::simd::Lanes;
use symplectic::system::{Class, Unconstrained};
use symplectic::{General, Hamiltonian, Scalar, Separable, Vector};
use symplectic_formula::derivative::gradient;
use symplectic_formula::graph::{Half, integer};
use symplectic_formula::{Structure, System};

use crate::constraints::Constraints;
use crate::interpreter::copy_to;
use crate::tape::{At, Input, Parameters, Tape};
use crate::unroll::{Refusal, Unrolled};
use crate::values::Values;

/// The tapes of a formula.
#[derive(Debug)]
pub struct Tapes {
    velocity: Tape,
    /// With the applied force.
    force: Tape,
    /// The applied force alone, if there is one.
    applied: Option<Tape>,
    constraints: Option<Constraints>,
    /// Velocity followed by force.
    slopes: Tape,
    energy: Tape,
    /// With friction, the factors of the momenta in the states of integrators.
    factors: Option<Tape>,
}

impl Tapes {
    /// Differentiates a system and unrolls its loops. Friction damps momenta from the time `start` on. The names of constraints are kept
    /// until the program ends.
    ///
    /// # Errors
    ///
    /// The [`Refusal`] of a formula that is too long or goes beyond its arrays.
    pub fn new(
        system: &mut System,
        structure: &Structure,
        values: &Values,
        start: f64,
    ) -> Result<Self, Refusal> {
        let energy = system.energy;
        let (kinetic, potential) = match structure.split {
            Ok(split) => (split.kinetic, split.potential),
            Err(_) => (energy, energy),
        };
        let mut by = |of, sign, half| gradient(&mut system.graph, of, &[], integer(sign), half);
        let velocity = by(kinetic, 1, Half::P);
        let mut force = by(potential, -1, Half::Q);
        system.add_applied(&mut force);
        let applied = system.applied.clone();
        if system.graph.overflowed() {
            return Err(Refusal::TooLong);
        }
        let parts = velocity.iter().chain(&force).chain(&applied);
        let parts = parts.map(|part| part.value);
        let mut unrolled = Unrolled::new(system, values, &parts.collect::<Vec<_>>(), Some(start))?;
        // Further coordinates of the velocity stand after the momenta.
        let beside = match values.further() {
            0 => None,
            _ => {
                let parts: Vec<_> = velocity.iter().map(|part| part.value).collect();
                let mut beside =
                    Unrolled::with_further(system, values, &parts, Some(start), Half::P)?;
                let velocity = beside.gradient(&velocity)?;
                Some(beside.tape(&velocity)?)
            }
        };
        let velocity = unrolled.gradient(&velocity)?;
        let force = unrolled.gradient(&force)?;
        let force = unrolled.undamped(force)?;
        let applied = match applied.as_slice() {
            [] => None,
            applied => {
                let applied = unrolled.gradient(applied)?;
                let applied = unrolled.undamped(applied)?;
                Some(unrolled.tape(&applied)?)
            }
        };
        let factors = unrolled.factors()?;
        let of_energy = Unrolled::new(system, values, &[energy], None)?;
        Ok(Tapes {
            slopes: unrolled.tape(&[velocity.as_slice(), &force].concat())?,
            velocity: match beside {
                Some(beside) => beside,
                None => unrolled.tape(&velocity)?,
            },
            force: unrolled.tape(&force)?,
            applied,
            factors: factors.map(|factors| unrolled.tape(&factors)).transpose()?,
            energy: of_energy.tape(&[of_energy.of(energy)?])?,
            constraints: Constraints::new(system, values)?,
        })
    }

    /// The constraints, if there are any.
    pub fn constraints(&self) -> Option<&Constraints> {
        self.constraints.as_ref()
    }

    /// The number of operations of an evaluation of velocity and force, at least one.
    pub fn operations(&self) -> usize {
        self.slopes.operations().max(1)
    }

    /// Whether H is conserved along trajectories without any error.
    pub fn energy_is_conserved(&self) -> bool {
        let has_time = self.energy.inputs().any(|input| input == Input::Time);
        !has_time && self.factors.is_none() && self.applied.is_none()
    }

    /// Whether momenta have friction.
    pub fn has_friction(&self) -> bool {
        self.factors.is_some()
    }

    /// The factors of the momenta in the states of integrators at a time, if there is friction.
    pub fn factors(&self, parameters: &Parameters, time: f64) -> Option<Vec<f64>> {
        let tape = self.factors.as_ref()?;
        let at = At {
            parameters,
            time,
            q: &[],
            p: &[],
        };
        let mut factors = vec![1.0; tape.results];
        tape.run(at, |to, values| copy_to(&mut factors, to, values));
        Some(factors)
    }

    /// The tape of H.
    pub fn energy(&self) -> &Tape {
        &self.energy
    }

    /// The velocity at a point.
    pub fn velocity_at(&self, point: At<'_, f64>) -> Vec<f64> {
        let mut velocity = vec![0.0; point.q.len()];
        let write = |to: usize, values: &[f64]| copy_to(&mut velocity, to, values);
        self.velocity.run(point, write);
        velocity
    }

    /// The momentum of a velocity at a position, for H that is quadratic in the momenta; `None` if its matrix is singular.
    pub fn momentum_of(
        &self,
        parameters: &Parameters,
        (time, q): (f64, &[f64]),
        velocity: &[f64],
    ) -> Option<Vec<f64>> {
        let velocity_at = |p: &[f64]| {
            DVector::from_vec(self.velocity_at(At {
                parameters,
                time,
                q,
                p,
            }))
        };
        let mut momentum = vec![0.0; q.len()];
        let at_rest = velocity_at(&momentum);
        let mut columns = Vec::new();
        for k in 0..q.len() {
            momentum[k] = 1.0;
            columns.push(velocity_at(&momentum) - &at_rest);
            momentum[k] = 0.0;
        }
        let inverse_masses = DMatrix::from_columns(&columns).lu();
        let wanted = DVector::from_column_slice(velocity);
        // The second time corrects rounding errors.
        for _ in 0..2 {
            let missing = &wanted - velocity_at(&momentum);
            let more = inverse_masses.solve(&missing)?;
            for (momentum, more) in momentum.iter_mut().zip(&more) {
                *momentum += more;
            }
        }
        Some(momentum)
    }

    /// H at a point.
    pub fn energy_at<T: Scalar>(&self, point: At<'_, T>) -> T {
        self.energy.value(point)
    }
}

/// A time, with the positions and the momenta.
type Point<'a, T> = (T, &'a DVector<T>, &'a DVector<T>);

/// Fills vectors with NaN, so that a step fails.
#[cold]
fn stop<'a, T: Scalar>(vectors: impl IntoIterator<Item = &'a mut DVector<T>>) {
    for vector in vectors {
        vector.fill(T::from_f64(f64::NAN));
    }
}

/// What sees the evaluations of a system, such as a display of the progress.
pub trait Watch: Debug + Send + Sync {
    /// The time of the starts.
    fn start(&self) -> f64;

    /// The force of a number of trajectories was evaluated on this thread, at a time since the start.
    fn evaluated(&self, elapsed: f64, trajectories: usize);
}

/// A system of class `C`, with an applied force if it is `FORCED`. The tapes of a separable system read no momentum for the force, and no position for the velocity.
#[derive(Debug)]
pub struct Formula<C, const FORCED: bool = false> {
    tapes: Arc<Tapes>,
    parameters: Parameters,
    /// The number of trajectories.
    count: usize,
    watch: Option<Arc<dyn Watch>>,
    stop: Option<Arc<AtomicBool>>,
    class: PhantomData<fn() -> C>,
}

impl<C, const FORCED: bool> Formula<C, FORCED> {
    /// The system of one trajectory, with the parameters that vary between trajectories. Its class `C` must be that of the formula: for
    /// `Separable`, H is T(p) + U(q) (`Structure::split`).
    pub fn new(tapes: Arc<Tapes>, parameters: Parameters) -> Self {
        Formula {
            tapes,
            parameters,
            count: 1,
            watch: None,
            stop: None,
            class: PhantomData,
        }
    }

    /// The same system, whose evaluations are watched.
    pub fn watched(self, watch: Option<Arc<dyn Watch>>) -> Self {
        Formula { watch, ..self }
    }

    /// The same system, whose runs end as soon as the flag is set: forces are then NaN, so that the step fails.
    pub fn stopped_by(self, stop: Arc<AtomicBool>) -> Self {
        Formula {
            stop: Some(stop),
            ..self
        }
    }

    #[inline(always)]
    fn at<'a, T: Scalar>(&'a self, (time, q, p): Point<'a, T>) -> At<'a, T> {
        At {
            parameters: &self.parameters,
            time,
            q: q.as_slice(),
            p: p.as_slice(),
        }
    }

    #[inline(always)]
    fn goes_on<T: Scalar>(&self, time: T) -> bool {
        if let Some(watch) = &self.watch {
            let elapsed = time - T::from_f64(watch.start());
            watch.evaluated(elapsed.magnitude(), self.count);
        }
        let stop = self.stop.as_ref();
        !stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }

    /// The constraints, if they are holonomic or not as wanted.
    fn of_kind(&self, holonomic: bool) -> Option<&Constraints> {
        let constraints = self.tapes.constraints();
        constraints.filter(|constraints| constraints.are_holonomic() == holonomic)
    }

    fn name_of(&self, constraint: usize) -> Option<ConstraintName> {
        let constraints = self.tapes.constraints()?;
        constraints.names().get(constraint).copied()
    }

    /// The parameters that vary between trajectories.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }
}

impl<C, const FORCED: bool> Clone for Formula<C, FORCED> {
    fn clone(&self) -> Self {
        Formula {
            tapes: Arc::clone(&self.tapes),
            parameters: self.parameters.clone(),
            count: self.count,
            watch: self.watch.clone(),
            stop: self.stop.clone(),
            class: PhantomData,
        }
    }
}

impl<C: ClassOfFormula, const FORCED: bool> Hamiltonian for Formula<C, FORCED> {
    type Class = C;
    type Vector<T: Scalar> = DVector<T>;

    const JOINS: bool = true;
    const INLINED: bool = true;
    const FORCED: bool = FORCED;

    fn in_lanes<V: Vector, L: Lanes, K: LaneWork<V, Self, L>>(work: K) -> K::Output
    where
        Self: symplectic::System<V, Class = C>,
    {
        work.run::<DVector<L>, Self>(|systems| {
            let mut systems = systems.peekable();
            let mut joined = (*systems.peek()?).clone();
            // Lanes without a trajectory repeat the systems from the first one.
            let mut own: Vec<*const Self> = Vec::new();
            let all = systems.inspect(|system| {
                if !own.contains(&std::ptr::from_ref(*system)) {
                    own.push(*system);
                }
            });
            joined.parameters = Parameters::join(all.map(|system| &system.parameters))?;
            joined.count = own.len();
            Some(joined)
        })
    }

    fn velocity<T: Scalar>(&self, time: T, q: &DVector<T>, p: &DVector<T>, out: &mut DVector<T>) {
        let out = out.as_mut_slice();
        let write = |to: usize, values: &[T]| copy_to(out, to, values);
        self.tapes.velocity.run(self.at((time, q, p)), write);
    }

    fn force<T: Scalar>(&self, time: T, q: &DVector<T>, p: &DVector<T>, out: &mut DVector<T>) {
        if !self.goes_on(time) {
            return stop([out]);
        }
        let out = out.as_mut_slice();
        let write = |to: usize, values: &[T]| copy_to(out, to, values);
        self.tapes.force.run(self.at((time, q, p)), write);
    }

    fn velocities<'a, T: Scalar>(
        &self,
        at: impl Fn(usize) -> Point<'a, T>,
        out: &mut [DVector<T>],
    ) {
        let point = |k: usize| self.at(at(k));
        self.tapes.velocity.fill(point, out);
    }

    fn forces<'a, T: Scalar>(&self, at: impl Fn(usize) -> Point<'a, T>, out: &mut [DVector<T>]) {
        if !out.is_empty() && !self.goes_on(at(0).0) {
            return stop(out);
        }
        let point = |k: usize| self.at(at(k));
        self.tapes.force.fill(point, out);
    }

    fn slopes<T: Scalar>(
        &self,
        time: T,
        q: &DVector<T>,
        p: &DVector<T>,
        (velocity, force): (&mut DVector<T>, &mut DVector<T>),
    ) {
        if !self.goes_on(time) {
            return stop([velocity, force]);
        }
        let (velocity, force) = (velocity.as_mut_slice(), force.as_mut_slice());
        let count = velocity.len();
        let write = |to: usize, values: &[T]| match to.checked_sub(count) {
            Some(to) => copy_to(force, to, values),
            None => {
                let (first, rest) = values.split_at(values.len().min(count - to));
                copy_to(velocity, to, first);
                copy_to(force, 0, rest);
            }
        };
        self.tapes.slopes.run(self.at((time, q, p)), write);
    }

    fn energy<T: Scalar>(&self, time: T, q: &DVector<T>, p: &DVector<T>) -> Option<T> {
        // With friction the momenta of the states have factors, and the energy is not conserved.
        let energy = || self.tapes.energy_at(self.at((time, q, p)));
        self.tapes.factors.is_none().then(energy)
    }

    fn applied_force<T: Scalar>(
        &self,
        time: T,
        q: &DVector<T>,
        p: &DVector<T>,
        applied: &mut DVector<T>,
    ) {
        match &self.tapes.applied {
            Some(tape) if FORCED => {
                let applied = applied.as_mut_slice();
                tape.run(self.at((time, q, p)), |to, values| {
                    copy_to(applied, to, values);
                });
            }
            _ => applied.fill(T::zero()),
        }
    }

    fn extra<T: Scalar>(&self) -> Option<C::Extra<'_, DVector<T>>> {
        C::extra(self)
    }
}

/// A class of formulas.
pub trait ClassOfFormula: Class {
    /// The constraints of a formula, if the class has any.
    fn extra<T: Scalar, const F: bool>(
        _formula: &Formula<Self, F>,
    ) -> Option<Self::Extra<'_, DVector<T>>> {
        None
    }
}

impl ClassOfFormula for General {}

impl ClassOfFormula for Separable {}

impl<C: Class + Unconstrained> ClassOfFormula for Constrained<C> {
    fn extra<T: Scalar, const F: bool>(
        formula: &Formula<Self, F>,
    ) -> Option<Self::Extra<'_, DVector<T>>> {
        Some(formula)
    }
}

impl<C: Class + Unconstrained> ClassOfFormula for Nonholonomic<C> {
    fn extra<T: Scalar, const F: bool>(
        formula: &Formula<Self, F>,
    ) -> Option<Self::Extra<'_, DVector<T>>> {
        Some(formula)
    }
}

impl<C: Class + Unconstrained, T: Scalar, const F: bool> HolonomicConstraints<DVector<T>>
    for Formula<Constrained<C>, F>
{
    fn constraints(&self) -> usize {
        self.of_kind(true).map_or(0, Constraints::count)
    }

    fn constraint_name(&self, constraint: usize) -> Option<ConstraintName> {
        self.name_of(constraint)
    }

    fn constraint_values(&self, q: &DVector<T>, values: &mut [T]) {
        if let Some(constraints) = self.of_kind(true) {
            constraints.values(&self.parameters, q.as_slice(), values);
        }
    }

    fn constraint_gradients(&self, q: &DVector<T>, gradients: &mut Gradients<T>) {
        if let Some(constraints) = self.of_kind(true) {
            constraints.set(&self.parameters, q, gradients);
        }
    }
}

impl<C: Class + Unconstrained, T: Scalar, const F: bool> NonholonomicConstraints<DVector<T>>
    for Formula<Nonholonomic<C>, F>
{
    fn nonholonomic_constraints(&self) -> usize {
        self.of_kind(false).map_or(0, Constraints::count)
    }

    fn constraint_name(&self, constraint: usize) -> Option<ConstraintName> {
        self.name_of(constraint)
    }

    fn nonholonomic_rows(&self, q: &DVector<T>, rows: &mut Gradients<T>) {
        if let Some(constraints) = self.of_kind(false) {
            constraints.set(&self.parameters, q, rows);
        }
    }
}
