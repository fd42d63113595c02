//! Multipliers of constraints: in closed form, their orders, and those of SHAKE.

use symplectic::constraints::{Constrained, constraint_force};
use symplectic::nalgebra::{SMatrix, SVector, Vector2};
use symplectic::variational::{Error, StepWithStages};
use symplectic::{
    Hamiltonian, Integrator, Method, ProvedFor, Separable, State, Vector, system::Unconstrained,
};

use crate::forces::Resisted;
use crate::systems::*;

type Vector6 = SVector<f64, 6>;

const MASSES: [f64; 6] = [1.0, 1.0, 1.0, 2.0, 2.0, 2.0];
const WEIGHTS: [f64; 6] = [0.0, 0.0, -1.0, 0.0, 0.0, -2.0];

/// `G` of the double spherical pendulum.
fn gradients(q: &Vector6) -> SMatrix<f64, 2, 6> {
    let mut gradients = SMatrix::zeros();
    for k in 0..3 {
        let link = q[k + 3] - q[k];
        gradients[(0, k)] = 2.0 * q[k];
        gradients[(1, k)] = -2.0 * link;
        gradients[(1, k + 3)] = 2.0 * link;
    }
    gradients
}

/// λ = S⁻¹ (G M⁻¹ force + v·∂²φ·v) with S = G M⁻¹ Gᵀ, of the double spherical pendulum.
#[test]
fn multipliers_of_a_double_pendulum_have_their_closed_form() -> Result<(), Error> {
    let (masses, force) = (Vector6::from(MASSES), Vector6::from(WEIGHTS));
    let mut run = Integrator::new(Lobatto4, DoubleSpherical, double_start(), 0.05)?;
    for _ in 0..50 {
        let state = run.step()?;
        let found = constraint_force(&DoubleSpherical, state)?;
        let rows = gradients(&state.q);
        let normal = rows * SMatrix::from_diagonal(&masses.map(f64::recip)) * rows.transpose();
        let v = state.p.component_div(&masses);
        let curvature = Vector2::new(
            2.0 * v.fixed_rows::<3>(0).norm_squared(),
            2.0 * (v.fixed_rows::<3>(3) - v.fixed_rows::<3>(0)).norm_squared(),
        );
        let right = rows * force.component_div(&masses) + curvature;
        let exact = normal.try_inverse().expect("regular") * right;
        for (found, exact) in found.multipliers.iter().zip(exact.iter()) {
            // A difference quotient with about twelve digits.
            assert!((found - exact).abs() < 1e-10, "{found} {exact}");
        }
        assert!((found.force + rows.transpose() * exact).amax() < 1e-10);
    }
    Ok(())
}

/// `p1 = p0 + Σ h b_i (force_i − G(Q_i)ᵀΛ_i)`, for a composition over the stages of all its steps, also with a weight zero. The first
/// multipliers of small steps are near those at the state.
#[test]
fn multipliers_of_stages_give_the_momentum_after_the_step() -> Result<(), Error> {
    fn check<M>(method: M, stages: usize) -> Result<(), Error>
    where
        M: Method + ProvedFor<Constrained<Separable>>,
    {
        let size = 1.0 / 64.0;
        let mut run = Integrator::new(method, DoubleSpherical, double_start(), size)?;
        for _ in 0..10 {
            let before = run.state().clone();
            let at_start = constraint_force(&DoubleSpherical, &before)?.multipliers;
            let step = run.step_with_stages()?;
            assert_eq!(step.stages().len(), stages, "{}", M::NAME);
            let mut p = before.p;
            for stage in step.stages() {
                let multipliers = Vector2::from_column_slice(&stage.multipliers);
                // A composition has at most one other size.
                let weight = match stage.force_weight {
                    0.0 => size,
                    weight => weight,
                };
                p += stage.force * stage.force_weight;
                p -= gradients(&stage.q).transpose() * multipliers * weight;
                for (found, at_start) in stage.multipliers.iter().zip(&at_start) {
                    // Over a step the multipliers change by about 4 h; those of compositions with steps back by more.
                    assert!((found - at_start).abs() < 0.5, "{}", M::NAME);
                }
            }
            // The momenta are below 4; a few roundings in each of the stages.
            let error = (p - run.state().p).amax();
            assert!(error < 64.0 * f64::EPSILON, "{}: {error:e}", M::NAME);
        }
        Ok(())
    }
    check(Rattle, 2)?;
    check(Lobatto4, 4)?;
    check(Rattle4, 6)?;
    check(Euler, 2)?;
    check(AdjointEuler, 2)
}

/// The multipliers at four times up to `end`.
fn along<M, S, C, V>(method: M, system: S, start: &State<V>, (end, steps): (f64, u32)) -> Vec<f64>
where
    M: Method + ProvedFor<Constrained<C>>,
    V: Vector<Scalar = f64>,
    S: Hamiltonian<Class = Constrained<C>, Vector<f64> = V> + Copy,
    C: symplectic::system::Class + Unconstrained,
{
    let size = end / f64::from(steps);
    let mut run = Integrator::new(method, system, start.clone(), size).expect("consistent");
    let mut found = Vec::new();
    for quarter in 1..=4 {
        let state = run
            .integrate_to(end * f64::from(quarter) / 4.0)
            .expect("steps");
        found.extend(
            constraint_force(&system, state)
                .expect("regular")
                .multipliers,
        );
    }
    found
}

/// The slope of the largest error of a multiplier between a number of steps and twice as many, against Lobatto with six stages.
fn slope<M, S, C, V>(method: M, system: S, start: &State<V>, (end, steps): (f64, u32)) -> f64
where
    M: Method + Copy + ProvedFor<Constrained<C>>,
    V: Vector<Scalar = f64>,
    S: Hamiltonian<Class = Constrained<C>, Vector<f64> = V> + Copy,
    C: symplectic::system::Class + Unconstrained,
{
    let exact = along(Lobatto6, system, start, (end, 128));
    let [coarse, fine] = [steps, 2 * steps].map(|steps| {
        let found = along(method, system, start, (end, steps));
        let pairs = found.iter().zip(&exact);
        pairs.fold(0.0_f64, |largest, (a, b)| largest.max((a - b).abs()))
    });
    (coarse / fine).log2()
}

/// Multipliers have the order of the state, not s − 1 as those inside a step: with two constraints, a kinetic energy that depends on the
/// place, and an applied force.
#[test]
fn multipliers_have_the_order_of_the_state() {
    macro_rules! each {
        ($($method:ident ($end:literal, $steps:literal) $system:expr, $start:expr => $order:literal;)*) => {$(
            let found = slope($method, $system, &$start, ($end, $steps));
            assert!(
                (found - f64::from($order)).abs() < 0.05,
                "{} {}: {found}", stringify!($system), stringify!($method),
            );
        )*};
    }
    each! {
        Rattle4 (1.0, 80) DoubleSpherical, double_start() => 4;
        Lobatto4 (1.0, 20) DoubleSpherical, double_start() => 6;
        Rattle4 (1.0, 80) Bead, sphere_start() => 4;
        Lobatto4 (1.0, 8) Bead, sphere_start() => 6;
        Rattle4 (1.0, 64) Resisted::new(), sphere_start() => 4;
        Lobatto4 (4.0, 16) Resisted::new(), sphere_start() => 6;
    }
}

/// The largest part, over a run, of `M (q_{k+1} − 2q_k + q_{k−1}) − h² force` that is no combination of the rows of `G(q_k)`, and the
/// largest part that is.
fn off_the_recursion<M>(method: M, size: f64) -> Result<[f64; 2], Error>
where
    M: Method + ProvedFor<Constrained<Separable>>,
{
    let mut run = Integrator::new(method, DoubleSpherical, double_start(), size)?;
    let mut positions = vec![run.state().q];
    for _ in 0..200 {
        positions.push(run.step()?.q);
    }
    let (masses, force) = (Vector6::from(MASSES), Vector6::from(WEIGHTS));
    let (mut off, mut along) = (0.0_f64, 0.0_f64);
    for around in positions.windows(3) {
        let second = around[2] - around[1] * 2.0 + around[0];
        let rest = second.component_mul(&masses) - force * (size * size);
        let rows = gradients(&around[1]);
        let normal = (rows * rows.transpose()).try_inverse().expect("regular");
        let multipliers = normal * rows * rest;
        let combination = rows.transpose() * multipliers;
        off = off.max((rest - combination).amax());
        along = along.max(combination.amax());
    }
    Ok([off, along])
}

/// `M (q_{k+1} − 2q_k + q_{k−1})/h² = force(q_k) − G(q_k)ᵀ λ_k` for some λ_k: the positions of RATTLE obey SHAKE's recursion up to rounding
/// errors of the positions, and those of Lobatto with three stages do not.
#[test]
fn positions_of_rattle_are_those_of_shake() -> Result<(), Error> {
    for size in [0.1, 0.02] {
        let [off, along] = off_the_recursion(Rattle, size)?;
        // Four units of rounding of positions up to 2, with masses up to 2.
        assert!(off < 16.0 * f64::EPSILON, "{size}: {off:e}");
        assert!(along > size * size, "{size}: {along:e}");
    }
    let [off, _] = off_the_recursion(Lobatto3, 0.1)?;
    assert!(off > 1e-6, "{off:e}");
    Ok(())
}
