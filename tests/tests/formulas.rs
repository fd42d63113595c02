//! Systems from formulas against the same systems by hand, and against themselves over other scalars.

mod systems;

use symplectic::nalgebra::{DVector, SMatrix, SVector};
use symplectic::{Integrator, State, System, Vector};
use symplectic_tests::formulas;
use symplectic_tests::scenes::{self, outer_solar_system as planets};
use systems::{consistent, same, states, values};

symplectic::hamiltonian! {
    /// A bead on a surface of revolution: the momentum of the angle is conserved, and so is that of z, with its own drift.
    Bead { g: 1 }
    q: [r, angle, z], p: [pr, l, pz];
    H = (pr^2 + l^2/r^2)/2 + r^2 + pz^2/2 + g z
    invariants: { fall = pz + g t }
}

symplectic::hamiltonian! {
    /// A driven oscillator: nothing of it is conserved.
    Driven q: [x], p: [px]; H = (px^2 + x^2)/2 - x cos(2 t)
}

#[test]
fn conserved_quantities_of_a_formula_can_be_observed() {
    let masses = [1.0, 0.5, 0.25];
    let planets = formulas::Planets::<3>::new(masses);
    let q = SMatrix::<f64, 3, 3>::from_fn(|i, j| (i * i + 2 * j) as f64 + 0.3);
    let p = SMatrix::<f64, 3, 3>::from_fn(|i, j| (i + 3 * j) as f64 - 3.5);
    let start = State::new(0.0, q, p);
    let mut observers = planets.invariants(&start);
    let by_hand = |state: &State<SMatrix<f64, 3, 3>>| {
        let mut values =
            vec![System::energy(&planets, 0.0, &state.q, &state.p).expect("H is known")];
        for k in 0..3 {
            values.push((0..3).map(|body| state.p[(k, body)]).sum());
        }
        for (a, b) in [(1, 2), (2, 0), (0, 1)] {
            let turning = |body| {
                state.q[(a, body)] * state.p[(b, body)] - state.q[(b, body)] * state.p[(a, body)]
            };
            values.push((0..3).map(turning).sum());
        }
        values
    };
    let near = |values: [f64; 7], by_hand: Vec<f64>| {
        for (value, by_hand) in values.iter().zip(by_hand) {
            assert!((value - by_hand).abs() < 1e-13, "{value} {by_hand}");
        }
    };
    let names = [
        "energy",
        "momentum[0]",
        "momentum[1]",
        "momentum[2]",
        "angular_momentum[0]",
        "angular_momentum[1]",
        "angular_momentum[2]",
    ];
    assert_eq!(observers.each_ref().map(|(name, _)| *name), names);
    near(
        observers.each_ref().map(|(_, observer)| observer.initial()),
        by_hand(&start),
    );
    // Another state has other values, which are the last ones.
    let other = State::new(1.0, q * 2.0, p * 0.75);
    for (_, observer) in &mut observers {
        observer.observe(&other);
        assert!(observer.deviation() > 0.1);
    }
    near(
        observers.each_ref().map(|(_, observer)| observer.last()),
        by_hand(&other),
    );
}

#[test]
fn cyclic_momenta_and_invariants_of_the_time_are_observed() {
    let start = State::from_arrays(2.0, [1.0, 0.5, 3.0], [0.1, 0.7, -0.2]);
    let observers = Bead::default().invariants(&start);
    let values = observers
        .each_ref()
        .map(|(name, observer)| (*name, observer.initial()));
    let energy = (0.01_f64 + 0.49) / 2.0 + 1.0 + 0.02 + 3.0;
    assert_eq!(values.map(|(name, _)| name), ["energy", "l", "fall"]);
    assert!((values[0].1 - energy).abs() < 1e-15);
    assert_eq!((values[1].1, values[2].1), (0.7, -0.2 + 2.0));
}

/// Systems without anything that is conserved have no method `invariants`: this one is taken.
trait NoInvariants {
    fn invariants(&self) -> usize {
        0
    }
}

impl NoInvariants for Driven {}

#[test]
fn a_driven_system_conserves_nothing() {
    assert_eq!(Driven.invariants(), 0);
}

#[test]
fn formulas_give_what_systems_by_hand_give() {
    same::<SVector<f64, 1>, SVector<f64, 1>>(
        &scenes::pendulum::Pendulum,
        &formulas::Pendulum,
        1,
        1e-15,
    );
    let omega = 3.0;
    same::<SVector<f64, 1>, SVector<f64, 1>>(
        &scenes::harmonic_oscillator::HarmonicOscillator { omega },
        &formulas::HarmonicOscillator { omega },
        1,
        1e-15,
    );
    same::<SVector<f64, 2>, SVector<f64, 2>>(&scenes::kepler::Kepler, &formulas::Kepler, 2, 1e-14);
    same::<SVector<f64, 2>, SVector<f64, 2>>(
        &scenes::henon_heiles::HenonHeiles,
        &formulas::HenonHeiles,
        2,
        1e-14,
    );
    same::<SVector<f64, 2>, SVector<f64, 2>>(
        &scenes::double_pendulum::DoublePendulum,
        &formulas::DoublePendulum::default(),
        2,
        1e-14,
    );
    same::<SVector<f64, 3>, SVector<f64, 3>>(
        &scenes::charged_particle::ChargedParticle,
        &formulas::ChargedParticle,
        3,
        1e-14,
    );
    same::<SVector<f64, 2>, SVector<f64, 2>>(
        &scenes::damped_particle::DampedParticle,
        &formulas::DampedParticle,
        2,
        1e-14,
    );
    let omega = 50.0;
    same::<SVector<f64, 2>, SVector<f64, 2>>(
        &scenes::spring_pendulum::SpringPendulum { omega },
        &formulas::SpringPendulum { omega },
        2,
        1e-14,
    );
    same::<SVector<f64, 1>, SVector<f64, 1>>(
        &scenes::nonseparable::Nonseparable,
        &formulas::Nonseparable,
        1,
        1e-15,
    );
    same::<SVector<f64, 1>, SVector<f64, 1>>(
        &scenes::hyperbolic::Hyperbolic,
        &formulas::Hyperbolic,
        1,
        0.0,
    );
    let by_hand = scenes::post_newtonian_kepler::EQUAL_MASSES;
    same::<SVector<f64, 2>, SVector<f64, 2>>(
        &by_hand,
        &formulas::PostNewtonianKepler {
            epsilon: by_hand.epsilon,
            nu: by_hand.mass_ratio,
        },
        2,
        1e-13,
    );
    let by_hand = scenes::point_vortices::FOUR;
    same::<SVector<f64, 4>, SVector<f64, 4>>(
        &by_hand,
        &formulas::PointVortices {
            strength: by_hand.strengths,
        },
        4,
        1e-13,
    );
    same::<SVector<f64, 6>, SVector<f64, 6>>(
        &scenes::fput_springs::FputSprings { omega },
        &formulas::FputSprings { omega },
        6,
        1e-13,
    );
    same::<SVector<f64, 6>, SMatrix<f64, 2, 3>>(
        &scenes::pythagorean_three_body::PythagoreanThreeBody,
        &formulas::PythagoreanThreeBody::new(scenes::pythagorean_three_body::MASSES),
        6,
        1e-13,
    );
    same::<SVector<f64, 14>, SMatrix<f64, 2, 7>>(
        &scenes::argon_crystal::ArgonCrystal,
        &formulas::ArgonCrystal::new(scenes::argon_crystal::MASS),
        14,
        1e-12,
    );
    same::<SVector<f64, 18>, SMatrix<f64, 3, 6>>(
        &planets::OuterSolarSystem,
        &outer_planets(),
        18,
        1e-13,
    );
    for n in [1, 2, 3, 17, 64, 100] {
        same::<DVector<f64>, DVector<f64>>(
            &scenes::fput_chain::system(),
            &formulas::FputChain,
            n,
            1e-13,
        );
        same::<DVector<f64>, DVector<f64>>(
            &scenes::sine_gordon::system(),
            &formulas::SineGordon::default(),
            n,
            1e-13,
        );
    }
}

fn outer_planets() -> formulas::Planets<6> {
    formulas::Planets::new(planets::BODIES_AT_START.map(|body| body.mass))
}

#[test]
fn formulas_are_the_same_in_lanes_and_their_jacobians_are_exact() {
    consistent(&formulas::HarmonicOscillator { omega: 3.0 }, 1);
    consistent(&formulas::Pendulum, 1);
    consistent(&formulas::Kepler, 2);
    consistent(&formulas::HenonHeiles, 2);
    consistent(&formulas::DoublePendulum::default(), 2);
    consistent(&formulas::ChargedParticle, 3);
    consistent(&formulas::RestrictedThreeBody::default(), 2);
    consistent(&formulas::DampedParticle, 2);
    consistent(&formulas::SpringPendulum { omega: 50.0 }, 2);
    consistent(&formulas::Nonseparable, 1);
    consistent(&formulas::Hyperbolic, 1);
    consistent(
        &formulas::PostNewtonianKepler {
            epsilon: 0.01,
            nu: 0.25,
        },
        2,
    );
    consistent(
        &formulas::PointVortices {
            strength: [1.0, 2.0, -1.0, 0.5],
        },
        4,
    );
    consistent(&formulas::FputSprings { omega: 50.0 }, 6);
    consistent(&formulas::PythagoreanThreeBody::new([3.0, 4.0, 5.0]), 6);
    consistent(&formulas::ArgonCrystal::new(5.0), 14);
    consistent(&outer_planets(), 18);
    consistent(&formulas::Planets::new([1.0]), 3);
    consistent(&formulas::Planets::new([1.0; 50]), 150);
}

/// Functions of the user, parameters in all shapes, the time, pairs from data, and more bodies than anyone has by hand.
mod others {
    symplectic::hamiltonian! {
        /// Springs between particles, from data.
        pub Molecule { m: [..], springs: pairs, stiffness: [springs], length: [springs] }
        q: [..; 3], p: [..; 3];
        H = sum(i: |p[i]|^2/(2 m[i])) + sum(s = (i, j) in springs: stiffness[s] (|q[i] - q[j]| - length[s])^2/2)
    }

    symplectic::hamiltonian! {
        /// A particle that is driven, in a potential by hand.
        pub Driven { strength: 0.5, frequency: 1.5 }
        q: [x], p: [px];
        extern fn well with well_slope, well_curvature;
        H = px^2/2 + well(x) - strength x cos(frequency t)
    }

    /// V(x) = x⁴/4
    pub fn well<T: symplectic::Scalar>(x: T) -> T {
        x.powi(4) * T::from_f64(0.25)
    }

    /// V′
    pub fn well_slope<T: symplectic::Scalar>(x: T) -> T {
        x.powi(3)
    }

    /// V″
    pub fn well_curvature<T: symplectic::Scalar>(x: T) -> T {
        x.powi(2) * T::from_f64(3.0)
    }

    symplectic::hamiltonian! {
        /// A kinetic energy with a full mass matrix, names that are words of Rust, and a mean field.
        pub MeanField<N> { inverse_mass: [3, 3], r#match: 2, T: [N] }
        q: [N; 3], p: [N; 3];
        let centre = sum(i: T[i] q[i]);
        let weight = sum(i: T[i]);
        H = sum(i: dot(p[i], inverse_mass p[i]))/2 + match sum(i: |q[i] - centre/weight|^3)
    }

    symplectic::hamiltonian! {
        /// A sum in a function in a sum, as of atoms embedded in the density of the others.
        pub Embedded<N>
        q: [N], p: [N];
        H = sum(i: p[i]^2/2) + sum(i: ln(1 + sum(j: exp(-(q[i] - q[j])^2))))
    }

    symplectic::hamiltonian! {
        /// Powers of sums of sums, and sums of products of sums.
        pub Squares<N>
        q: [N], p: [N];
        let s = sum(i: q[i] p[i]);
        H = sum(i: p[i]^2/2) + sum(i: sum(j: q[i] q[j]^2))^2 + sum(i: exp(-sum(j: q[j] q[i])))
            + sum(i: q[i]^2 s) + sum(i: sum(j in 0..i: (q[i] - q[j])^4))
            + sum(i < j: q[j]^3 cos(q[i])) sum(i < j: q[j] p[i])
    }

    symplectic::hamiltonian! {
        /// Three sums in one another.
        pub Bonded<N>
        q: [N; 2], p: [N; 2];
        let cut(i, j) = exp(-|q[i] - q[j]|^2);
        H = sum(i: |p[i]|^2/2)
            + sum(i: sum(j: cut(i, j)/(1 + sum(k: cut(i, k) (1 + dot(q[i] - q[j], q[i] - q[k]))^2))))
    }

    symplectic::hamiltonian! {
        /// Angles and roots.
        pub Angles
        q: [x, y], p: [px, py];
        H = (px^2 + py^2)/2 + atan2(y, x)^2 + (x + 2)^(1/3) + 2^x + |x|^3 + sinh(x) tanh(y) + asin(x/9) acos(y/9) + atan(x) + tan(y)
    }
}

#[test]
fn all_of_the_language_is_derived() {
    consistent(&others::Driven::default(), 1);
    consistent(&others::Angles, 2);
    consistent(&others::Embedded::<4>, 4);
    consistent(&others::Squares::<4>, 4);
    consistent(&others::Bonded::<3>, 6);
    let field = others::MeanField::new(
        [[2.0, 0.5, 0.0], [0.5, 1.0, 0.25], [0.0, 0.25, 3.0]],
        [0.5, 2.0, 1.0, 0.25],
    );
    consistent(&field, 12);
    let springs = vec![(0, 1), (1, 2), (0, 2)];
    let molecule = others::Molecule::new(
        vec![1.0, 2.0, 3.0],
        springs,
        vec![1.0, 2.0, 0.5],
        vec![1.0, 0.5, 1.5],
    );
    consistent(&molecule, 9);
}

/// The energy by central differences, for what has no other form.
#[test]
fn derivatives_are_those_of_the_energy() {
    fn check<V: Vector<Scalar = f64>>(system: &impl System<V>, dimension: usize) {
        for [q, p] in states(dimension) {
            let [velocity, force, _] = values(system, &q, &p);
            for i in 0..dimension {
                let slope = |half: usize| {
                    let energy = |by: f64| {
                        let mut state = [q.clone(), p.clone()];
                        state[half][i] += by;
                        let [q, p] = &state;
                        values(system, q, p)[2][0]
                    };
                    (energy(1e-5) - energy(-1e-5)) / 2e-5
                };
                for (found, slope) in [(velocity[i], slope(1)), (force[i], -slope(0))] {
                    assert!(
                        (found - slope).abs() < 1e-7 * (1.0 + slope.abs()),
                        "{found} for {slope}"
                    );
                }
            }
        }
    }
    check::<SVector<f64, 1>>(&others::Driven::default(), 1);
    check::<SVector<f64, 2>>(&others::Angles, 2);
    check::<SVector<f64, 4>>(&others::Embedded::<4>, 4);
    check::<SVector<f64, 4>>(&others::Squares::<4>, 4);
    check::<SMatrix<f64, 2, 3>>(&others::Bonded::<3>, 6);
    let field = others::MeanField::new(
        [[2.0, 0.5, 0.0], [0.5, 1.0, 0.25], [0.0, 0.25, 3.0]],
        [0.5, 2.0, 1.0, 0.25],
    );
    check::<SMatrix<f64, 3, 4>>(&field, 12);
}

#[test]
fn missing_parameters_at_run_time_are_refused() {
    let start = || {
        State::new(
            0.0,
            DVector::from_element(9, 0.5),
            DVector::from_element(9, 0.1),
        )
    };
    let molecule = |springs, masses: usize| {
        others::Molecule::new(vec![1.0; masses], springs, vec![1.0; 1], vec![1.0; 1])
    };
    let run = |system| {
        let mut run = Integrator::new(symplectic_tests::methods::Gauss2, system, start(), 0.1)?;
        run.integrate_to(1.0).map(|_| ())
    };
    assert!(
        run(molecule(vec![(0, 7)], 3)).is_err(),
        "there are three particles"
    );
    assert!(
        run(molecule(vec![(0, 1)], 2)).is_err(),
        "the third has no mass"
    );
}

#[test]
fn symmetries_give_conserved_momenta() {
    let planets = outer_planets();
    let q = SMatrix::<f64, 3, 6>::from(planets::BODIES_AT_START.map(|body| body.position));
    let p = SMatrix::<f64, 3, 6>::from(
        planets::BODIES_AT_START.map(|body| body.velocity.map(|v| v * body.mass)),
    );
    let before = (planets.momentum(&q, &p), planets.angular_momentum(&q, &p));
    let mut run = Integrator::new(
        symplectic_tests::methods::Gauss4,
        planets,
        State::new(0.0, q, p),
        50.0,
    )
    .expect("a start");
    run.integrate_to(10_000.0).expect("a run");
    let state = run.state();
    let after = (
        planets.momentum(&state.q, &state.p),
        planets.angular_momentum(&state.q, &state.p),
    );
    for k in 0..3 {
        assert!((after.0[k] - before.0[k]).abs() < 1e-16);
        assert!((after.1[k] - before.1[k]).abs() < 1e-13 * before.1[2].abs());
    }
    // Of one body, without being asked for.
    let (q, p) = (SVector::from([1.0, 2.0]), SVector::from([3.0, 4.0]));
    assert_eq!(
        formulas::Kepler.angular_momentum(&q, &p),
        1.0 * 4.0 - 2.0 * 3.0
    );
}
