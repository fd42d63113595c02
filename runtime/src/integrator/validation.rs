//! What is looked at before an integrator is made or changed.

use crate::error::{Error, Quantity};
use crate::method::Method;
use crate::method::storage::is_finite;
use crate::number::array::array;
use crate::number::linear_combination::kick_and_drift;
use crate::number::{F64x2, F64x4, F64x8, Lanes, Scalar, Vector, copy};
use crate::state::State;
use crate::system::HamiltonianInLanes;
use crate::system::linearity::non_linear_velocity;
use crate::system::{Class, Components, Hamiltonian, Layout, MOST_ROW_STAGES, StageRows};

pub(crate) fn check_step_size(value: f64) -> Result<(), Error> {
    if value.is_finite() && value != 0.0 {
        Ok(())
    } else {
        Err(Error::StepSize { value })
    }
}

/// Checks that the velocity is the momentum where the system says so.
pub(super) fn check_masses<V: Vector, S: Hamiltonian<V>>(
    system: &S,
    state: &State<V>,
) -> Result<(), Error> {
    if !S::UNIT_MASSES {
        return Ok(());
    }
    let State { time, q, p } = state;
    let mut velocity = p.zeros_like();
    system.velocity(V::Scalar::from_f64(*time), q, p, &mut velocity);
    first_difference(&velocity, p).map_or(Ok(()), |(component, velocity, momentum)| {
        Err(Error::NotUnitMasses {
            component,
            velocity,
            momentum,
        })
    })
}

/// Checks that the velocity is linear in the momentum, for a method that has its order there only.
pub(super) fn check_quadratic_kinetic<M: Method, V: Vector, S: Hamiltonian<V>>(
    system: &S,
    state: &State<V>,
) -> Result<(), Error> {
    if !M::NEEDS_QUADRATIC_KINETIC || S::UNIT_MASSES {
        return Ok(());
    }
    let State { time, q, p } = state;
    non_linear_velocity(system, *time, q, p).map_or(Ok(()), |found| {
        Err(Error::NotQuadraticKinetic {
            method: M::NAME,
            order: M::ORDERS.nystrom,
            lower_order: M::ORDERS.separable,
            component: found.component,
            velocity: found.velocity,
            linear: found.linear,
        })
    })
}

/// Checks that one kick or two, and a drift, in one pass are those by the force, in any layout, where the system makes such passes.
/// Another system is not asked for its force.
pub(super) fn check_pass<V: Vector, S: Hamiltonian<V>>(
    system: &S,
    state: &State<V>,
    step_size: f64,
) -> Result<(), Error> {
    if !(S::UNIT_MASSES && S::Class::SEPARABLE) {
        return Ok(());
    }
    let time = V::Scalar::from_f64(state.time);
    let [half, whole] = [0.5 * step_size, step_size].map(V::Scalar::from_f64);
    let both = [&[half, whole][..], &[whole]];
    let State { mut q, mut p, .. } = state.clone();
    let mut place = q.zeros_like();
    let layouts = [Layout::NATURAL, system.layout(q.as_slice(), p.as_slice())];
    let count = if layouts[1].is_natural() { 1 } else { 2 };
    for layout in &layouts[..count] {
        copy(&mut q, &state.q);
        copy(&mut p, &state.p);
        if !layout.put_vectors((&mut q, &mut p), &mut place) {
            continue;
        }
        // One pass after the other: what is wrong with the first is still there after the second.
        let made = both.map(|kicks| {
            let state = (q.as_mut_slice(), p.as_mut_slice());
            system.kick_and_drift(time, state, *layout, kicks, whole)
        });
        layout.put_vectors_back((&mut q, &mut p), &mut place);
        if made == [false; 2] {
            continue;
        }
        let State {
            q: of_q, p: of_p, ..
        } = &mut state.clone();
        for (kicks, made) in both.into_iter().zip(made) {
            if made {
                system.force(time, of_q, of_p, &mut place);
                kick_and_drift(of_q, of_p, &place, kicks, whole);
            }
        }
        let differing = first_difference(&p, of_p).or_else(|| first_difference(&q, of_q));
        if let Some((component, of_pass, expected)) = differing {
            return Err(Error::NotTheSameForce {
                component,
                of_pass,
                expected,
            });
        }
    }
    Ok(())
}

/// Checks that the force component by component is the force, where the system makes it so: of doubles and of all lanes, for which it
/// may be written apart, and in rows; at the present positions and at uneven ones around them.
pub(super) fn check_local_forces<V, S>(
    system: &S,
    state: &State<V>,
    step_size: f64,
) -> Result<(), Error>
where
    V: Vector<Scalar = f64>,
    S: HamiltonianInLanes<V>,
{
    if !<S as Hamiltonian<V>>::LOCAL_FORCE {
        return Ok(());
    }
    let State { time, q, p } = state;
    let stages: [V; MOST_ROW_STAGES] =
        core::array::from_fn(|stage| uneven(state, step_size, stage));
    for q in [q, &stages[1]] {
        check_local_force(system, *time, q, p)?;
        check_local_force(system, *time, &splat::<V, F64x2>(q), &splat(p))?;
        check_local_force(system, *time, &splat::<V, F64x4>(q), &splat(p))?;
        check_local_force(system, *time, &splat::<V, F64x8>(q), &splat(p))?;
    }
    check_row_forces(system, state, step_size, &stages)
}

/// 2⁻³²
const FRACTION: f64 = 1.0 / 4_294_967_296.0;

/// Positions around the present ones: they themselves for stage 0, and others in which all components differ for those after it. Where
/// positions and momenta are zero so are many forces that are wrong.
fn uneven<V: Vector<Scalar = f64>>(state: &State<V>, step_size: f64, stage: usize) -> V {
    let largest = |vector: &V| {
        vector
            .as_slice()
            .iter()
            .fold(0.0, |a: f64, &b| a.max(b.abs()))
    };
    let size = largest(&state.q).max(largest(&state.p) * step_size.abs());
    let size = if size > 0.0 { size } else { 1.0 };
    let mut positions = state.q.clone();
    for (component, position) in positions.as_mut_slice().iter_mut().enumerate() {
        // The fractions of the multiples of the golden section, in units of 2⁻³²: far from each other, however many there are.
        let multiple = (component as u32).wrapping_add(1).wrapping_mul(0x9e37_79b9);
        let fraction = f64::from(multiple) * FRACTION - 0.5;
        *position += 0.125 * size * stage as f64 * fraction;
    }
    positions
}

/// Checks that the force in rows is the force, of as many stages as there can be, each at its time and at positions of its own.
fn check_row_forces<V, S>(
    system: &S,
    state: &State<V>,
    step_size: f64,
    positions: &[V; MOST_ROW_STAGES],
) -> Result<(), Error>
where
    V: Vector<Scalar = f64>,
    S: Hamiltonian<V>,
{
    let State { time, q, p } = state;
    if !S::ROW_FORCES || q.dimension() == 0 || !q.dimension().is_multiple_of(F64x8::WIDTH) {
        return Ok(());
    }
    let times = core::array::from_fn(|stage| time + step_size * stage as f64 / 8.0);
    let mut forces = positions.clone();
    for force in &mut forces {
        force.as_mut_slice().fill(f64::NAN);
    }
    let mut stages = positions.iter().zip(&mut forces);
    let mut rows = RowsInMemory {
        times,
        stages: core::array::from_fn(|_| {
            let (q, force) = stages.next().map_or((&[][..], &mut [][..]), |(q, force)| {
                (q.as_slice(), force.as_mut_slice())
            });
            InMemory { q, force }
        }),
        outside: None,
    };
    system.row_forces(&mut rows);
    if let Some(row) = rows.outside {
        let rows = rows.count();
        return Err(Error::NoSuchRow { row, rows });
    }
    for ((time, q), local) in times.into_iter().zip(positions).zip(&forces) {
        let mut force = q.zeros_like();
        system.force(time, q, p, &mut force);
        check_same(local, &force)?;
    }
    Ok(())
}

/// Checks that a force made locally is the force.
fn check_same<V: Vector>(local: &V, force: &V) -> Result<(), Error> {
    match first_difference(local, force) {
        Some((component, local, expected)) => Err(Error::NotTheSameLocalForce {
            component,
            local,
            expected,
        }),
        None => Ok(()),
    }
}

/// Stages that are in memory, in rows.
struct RowsInMemory<'a> {
    times: [f64; MOST_ROW_STAGES],
    stages: [InMemory<'a, f64>; MOST_ROW_STAGES],
    /// The first row that was asked for, or set, and is none.
    outside: Option<usize>,
}

impl RowsInMemory<'_> {
    fn look(&mut self, row: usize) {
        if row >= self.count() {
            self.outside.get_or_insert(row);
        }
    }
}

impl StageRows for RowsInMemory<'_> {
    fn count(&self) -> usize {
        self.stages[0].dimension() / F64x8::WIDTH
    }

    fn stages(&self) -> usize {
        self.stages.len()
    }

    fn time(&self, stage: usize) -> F64x8 {
        F64x8::from_f64(self.times.get(stage).copied().unwrap_or(f64::NAN))
    }

    fn positions(&mut self, row: usize) -> [F64x8; MOST_ROW_STAGES] {
        self.look(row);
        array(F64x8::from_f64(f64::NAN), |stage| {
            F64x8::from_fn(|lane| {
                self.stages[stage].position(row.saturating_mul(F64x8::WIDTH).saturating_add(lane))
            })
        })
    }

    fn set_forces(&mut self, row: usize, forces: [F64x8; MOST_ROW_STAGES]) {
        self.look(row);
        for (stage, force) in self.stages.iter_mut().zip(forces) {
            for (lane, force) in force.to_array().into_iter().enumerate() {
                stage.set_force(row.saturating_mul(F64x8::WIDTH).saturating_add(lane), force);
            }
        }
    }
}

/// A vector in all lanes.
fn splat<V: Vector<Scalar = f64>, L: Lanes>(vector: &V) -> V::With<L> {
    let mut lanes = vector.zeros_with::<L>();
    let components = lanes.as_mut_slice().iter_mut();
    for (lanes, &component) in components.zip(vector.as_slice()) {
        *lanes = L::from_f64(component);
    }
    lanes
}

fn check_local_force<V: Vector, S: Hamiltonian<V>>(
    system: &S,
    time: f64,
    q: &V,
    p: &V,
) -> Result<(), Error> {
    if !S::LOCAL_FORCE {
        return Ok(());
    }
    let time = V::Scalar::from_f64(time);
    let [mut force, mut local] = [q.zeros_like(), q.zeros_like()];
    system.force(time, q, p, &mut force);
    local.as_mut_slice().fill(V::Scalar::from_f64(f64::NAN));
    let mut components = InMemory {
        q: q.as_slice(),
        force: local.as_mut_slice(),
    };
    system.local_force(time, &mut components);
    check_same(&local, &force)
}

/// Components that are in memory. The positions of those whose forces are set are no numbers any more, and neither are forces that are
/// set twice.
struct InMemory<'a, T> {
    q: &'a [T],
    force: &'a mut [T],
}

impl<T: Scalar> Components<T> for InMemory<'_, T> {
    fn dimension(&self) -> usize {
        self.q.len()
    }

    fn position(&mut self, component: usize) -> T {
        match (self.q.get(component), self.force.get(component)) {
            (Some(&q), Some(force)) if force.magnitude().is_nan() => q,
            _ => T::from_f64(f64::NAN),
        }
    }

    fn set_force(&mut self, component: usize, force: T) {
        if let Some(place) = self.force.get_mut(component) {
            *place = match place.magnitude().is_nan() {
                true => force,
                false => T::from_f64(f64::NAN),
            };
        }
    }
}

/// Checks that velocity and force at once are those one by one, where the system says so.
pub(super) fn check_slopes<V: Vector, S: Hamiltonian<V>>(
    system: &S,
    state: &State<V>,
) -> Result<(), Error> {
    if !S::SHARED_SLOPES {
        return Ok(());
    }
    let State { time, q, p } = state;
    let time = V::Scalar::from_f64(*time);
    let blank = || (q.zeros_like(), q.zeros_like());
    let (mut slopes, mut alone) = (blank(), blank());
    system.slopes(time, q, p, (&mut slopes.0, &mut slopes.1));
    system.velocity(time, q, p, &mut alone.0);
    system.force(time, q, p, &mut alone.1);
    for (what, slopes, alone) in [
        (Quantity::Velocity, &slopes.0, &alone.0),
        (Quantity::Force, &slopes.1, &alone.1),
    ] {
        if let Some((component, at_once, alone)) = first_difference(slopes, alone) {
            return Err(Error::NotTheSameSlopes {
                what,
                component,
                at_once,
                alone,
            });
        }
    }
    Ok(())
}

/// Components that are compared at once.
const BLOCK: usize = 1 << 6;

/// The first component in which two vectors differ, and how large it is in them; none where both are not finite, which is an error of
/// the first step.
fn first_difference<V: Vector>(left: &V, right: &V) -> Option<(usize, f64, f64)> {
    if left.dimension() != right.dimension() {
        // An error of the first step, too.
        return None;
    }
    let (left, right) = (left.as_slice(), right.as_slice());
    // Most are the same, which is seen for many at once.
    let same = |(left, right): (&[_], &[_])| {
        (left.iter().zip(right)).fold(true, |same, (left, right)| same & (left == right))
    };
    let blocks = left.chunks(BLOCK).zip(right.chunks(BLOCK));
    let begin = BLOCK * blocks.take_while(|&blocks| same(blocks)).count();
    let pairs = left.iter().zip(right).skip(begin);
    let differ = |(_, (left, right)): &(usize, (&V::Scalar, &V::Scalar))| {
        left != right && (left.is_finite() || right.is_finite())
    };
    let (component, (left, right)) = pairs.enumerate().find(differ)?;
    Some((begin + component, left.magnitude(), right.magnitude()))
}

pub(crate) fn check_state<V: Vector>(
    time: f64,
    q: &V,
    p: &V,
    dimension: usize,
) -> Result<(), Error> {
    let (position, momentum) = (q.dimension(), p.dimension());
    if position != dimension || momentum != dimension {
        return Err(Error::Dimension { position, momentum });
    }
    let what = if !time.is_finite() {
        Quantity::Time
    } else if !is_finite(q) {
        Quantity::Position
    } else if !is_finite(p) {
        Quantity::Momentum
    } else {
        return Ok(());
    };
    Err(Error::NonFiniteState { what })
}
