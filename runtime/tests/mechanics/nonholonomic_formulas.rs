//! Non-holonomic constraints from formulas, against the same systems by hand.

use symplectic::constraints::{Nonholonomic, NonholonomicConstraints};
use symplectic::nalgebra::SMatrix;
use symplectic::{Error, Integrator, State, System};

use crate::rolling::*;

symplectic::lagrangian! {
    /// A disk that rolls upright on a plane.
    pub DiskByLagrangian { radius: 0.7, inertia: 0.3, turning: 0.2 }
    q: [x, y, theta, phi], v: [vx, vy, rolls, turns];
    L = (vx^2 + vy^2 + inertia rolls^2 + turning turns^2)/2
    nonholonomic: { along_x = vx - radius cos(phi) rolls, along_y = vy - radius sin(phi) rolls }
}

symplectic::hamiltonian! {
    /// The non-holonomic oscillator.
    pub OscillatorByFormula
    q: [x, y, z], p: [px, py, pz], v: [vx, vy, vz];
    H = (px^2 + py^2 + pz^2 + x^2 + y^2)/2
    nonholonomic: { helix = y vx - vz }
}

symplectic::lagrangian! {
    /// The sleigh of Chaplygin: the masses depend on the place.
    pub SleighByLagrangian { length: 0.5, inertia: 0.4 }
    q: [x, y, a], v: [vx, vy, va];
    L = (vx^2 + vy^2 + (inertia + length^2) va^2)/2 + length va (vy cos(a) - vx sin(a))
    nonholonomic: { edge = vx sin(a) - vy cos(a) }
}

symplectic::hamiltonian! {
    /// Points in the plane, each with a velocity along the position of the one before, and the first along x.
    pub Followers<N>
    q: [N; 2], p: [N; 2], v: [N; 2];
    H = sum(i: |p[i]|^2 + |q[i]|^2)/2
    nonholonomic: { first = v[0][1], follow(i in 1..N) = q[i-1][0] v[i][1] - q[i-1][1] v[i][0] }
}

/// The states of two systems after some steps.
fn both<S, T, C, V>(formula: S, by_hand: T, start: State<V>) -> Result<[State<V>; 2], Error>
where
    V: symplectic::Vector<Scalar = f64>,
    S: System<V, Class = Nonholonomic<C>>,
    T: System<V, Class = Nonholonomic<C>>,
    C: symplectic::system::Class + symplectic::system::Unconstrained,
{
    let mut formula = Integrator::new(Midpoint, formula, start.clone(), 0.1)?;
    let mut by_hand = Integrator::new(Midpoint, by_hand, start, 0.1)?;
    Ok([
        formula.take_steps(50)?.clone(),
        by_hand.take_steps(50)?.clone(),
    ])
}

#[track_caller]
fn assert_near<V: symplectic::Vector<Scalar = f64>>([a, b]: [State<V>; 2]) {
    for (a, b) in [(&a.q, &b.q), (&a.p, &b.p)] {
        for (a, b) in a.as_slice().iter().zip(b.as_slice()) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }
}

#[test]
fn formulas_are_the_systems_by_hand() -> Result<(), Error> {
    assert_near(both(DiskByLagrangian::default(), Disk, disk_start())?);
    assert_near(both(OscillatorByFormula, Oscillator, oscillator_start())?);
    let sleigh = State::new(0.0, [0.1, 0.2, 0.3].into(), sleigh_momentum(0.3, -0.4, 1.1));
    assert_near(both(SleighByLagrangian::default(), Sleigh, sleigh)?);
    Ok(())
}

/// A family of constraints: one for each index.
#[test]
fn a_family_has_one_nonholonomic_constraint_for_each_index() -> Result<(), Error> {
    let system = Followers::<3>;
    assert_eq!(
        NonholonomicConstraints::<SMatrix<f64, 2, 3>>::nonholonomic_constraints(&system),
        3
    );
    let q = SMatrix::from_column_slice(&[1.0, 0.5, 0.3, 0.8, -0.2, 1.0]);
    let p = SMatrix::from_column_slice(&[0.7, 0.0, 0.4, 0.2, 0.15, 0.4]);
    let start: State<SMatrix<f64, 2, 3>> = State::new(0.0, q, p);
    let mut run = Integrator::new(Midpoint, system, start, 0.05)?;
    for _ in 0..100 {
        let State { q, p, .. } = run.step()?;
        assert!(p[1].abs() < 1e-15);
        for i in [1, 2] {
            let slip = q[2 * i - 2] * p[2 * i + 1] - q[2 * i - 1] * p[2 * i];
            assert!(slip.abs() < 4e-15, "{slip:e}");
        }
    }
    Ok(())
}
