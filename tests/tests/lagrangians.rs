//! Systems from Lagrangians against the same systems from Hamiltonians, and against themselves over other scalars.

mod systems;

use symplectic::nalgebra::{DVector, SMatrix, SVector};
use symplectic::{Integrator, State, System, Vector};
use symplectic_tests::scenes::outer_solar_system as planets;
use symplectic_tests::{formulas, lagrangians};
use systems::{consistent, same, states};

#[test]
fn lagrangians_give_what_hamiltonians_give() {
    same::<SVector<f64, 2>, SVector<f64, 2>>(&formulas::Kepler, &lagrangians::Kepler, 2, 0.0);
    same::<SVector<f64, 2>, SVector<f64, 2>>(
        &formulas::HenonHeiles,
        &lagrangians::HenonHeiles,
        2,
        1e-14,
    );
    let by_hamiltonian = formulas::DoublePendulum::default();
    same::<SVector<f64, 2>, SVector<f64, 2>>(
        &by_hamiltonian,
        &lagrangians::DoublePendulum::default(),
        2,
        1e-14,
    );
    same::<SVector<f64, 2>, SVector<f64, 2>>(
        &by_hamiltonian,
        &lagrangians::CartesianDoublePendulum::default(),
        2,
        1e-14,
    );
    same::<SVector<f64, 3>, SVector<f64, 3>>(
        &formulas::ChargedParticle,
        &lagrangians::ChargedParticle,
        3,
        1e-14,
    );
    let omega = 50.0;
    same::<SVector<f64, 2>, SVector<f64, 2>>(
        &formulas::SpringPendulum { omega },
        &lagrangians::SpringPendulum { omega },
        2,
        0.0,
    );
    let masses = planets::BODIES_AT_START.map(|body| body.mass);
    same::<SMatrix<f64, 3, 6>, SMatrix<f64, 3, 6>>(
        &formulas::Planets::new(masses),
        &lagrangians::Planets::new(masses),
        18,
        0.0,
    );
    for n in [1, 2, 17, 64] {
        same::<DVector<f64>, DVector<f64>>(
            &formulas::SineGordon::default(),
            &lagrangians::SineGordon::default(),
            n,
            0.0,
        );
    }
}

#[test]
fn lagrangians_are_the_same_in_lanes_and_their_jacobians_are_exact() {
    consistent(&lagrangians::DoublePendulum::default(), 2);
    consistent(&lagrangians::CartesianDoublePendulum::default(), 2);
    consistent(&lagrangians::ChargedParticle, 3);
    consistent(&lagrangians::Planets::new([1.0, 2.0, 3.0]), 9);
    consistent(&lagrangians::FivePendulums::default(), 5);
    consistent(&lagrangians::PolarSpringPendulum { omega: 3.0 }, 2);
}

/// The velocity of the momentum of a velocity is that velocity.
fn there_and_back<S, V>(system: &S, momentum: impl Fn(&V, &V) -> V, dimension: usize)
where
    V: Vector<Scalar = f64>,
    S: System<V>,
{
    for [q, v] in states(dimension) {
        let [q, v] = [q, v].map(|half| V::from_slice(&half).expect("as many components"));
        let p = momentum(&q, &v);
        let mut back = q.zeros_like();
        system.velocity(0.3, &q, &p, &mut back);
        for (v, back) in v.as_slice().iter().zip(back.as_slice()) {
            assert!((v - back).abs() < 1e-13, "{back:e} for {v:e}");
        }
    }
}

#[test]
fn velocities_become_momenta_and_momenta_velocities() {
    let system = lagrangians::DoublePendulum::default();
    there_and_back(&system, |q, v| system.momentum_of_velocity(0.3, q, v), 2);
    let system = lagrangians::CartesianDoublePendulum::default();
    there_and_back(&system, |q, v| system.momentum_of_velocity(0.3, q, v), 2);
    let system = lagrangians::ChargedParticle;
    there_and_back(&system, |q, v| system.momentum_of_velocity(0.3, q, v), 3);
    let system = lagrangians::Planets::new([1.0, 2.0, 3.0]);
    there_and_back(&system, |q, v| system.momentum_of_velocity(0.3, q, v), 9);
    let system = lagrangians::SineGordon::default();
    there_and_back(&system, |q, v| system.momentum_of_velocity(0.3, q, v), 20);
    let system = lagrangians::FivePendulums::default();
    there_and_back(&system, |q, v| system.momentum_of_velocity(0.3, q, v), 5);
}

symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }

/// The pendulum on a spring in polar coordinates swings as in Cartesian ones.
#[test]
fn polar_and_cartesian_lagrangians_have_the_same_motion() {
    let omega = 10.0;
    let (r, f, vr, vf) = (1.1, -1.0_f64, 0.2, 0.5);
    let polar = lagrangians::PolarSpringPendulum { omega };
    let (q, v) = (SVector::from([r, f]), SVector::from([vr, vf]));
    let p = polar.momentum_of_velocity(0.0, &q, &v);
    let mut polar = Integrator::new(Gauss4, polar, State::new(0.0, q, p), 0.005).expect("a start");
    let cartesian = lagrangians::SpringPendulum { omega };
    let q = SVector::from([r * f.cos(), r * f.sin()]);
    let v = SVector::from([
        vr * f.cos() - r * f.sin() * vf,
        vr * f.sin() + r * f.cos() * vf,
    ]);
    let p = cartesian.momentum_of_velocity(0.0, &q, &v);
    assert_eq!(p, v);
    let mut cartesian =
        Integrator::new(Gauss4, cartesian, State::new(0.0, q, p), 0.005).expect("a start");
    polar.integrate_to(2.0).expect("steps");
    cartesian.integrate_to(2.0).expect("steps");
    let [r, f] = polar.state().q.into();
    // The error of order 8 is below 10⁻¹² in both.
    for (x, y) in [r * f.cos(), r * f.sin()].iter().zip(&cartesian.state().q) {
        assert!((x - y).abs() < 1e-10, "{x} and {y}");
    }
}
