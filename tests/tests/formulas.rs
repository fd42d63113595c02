//! Systems from formulas against the same systems by hand, and against themselves over other scalars.

use symplectic::nalgebra::{DVector, SMatrix, SVector};
use symplectic::simd::{F64x4, Lanes};
use symplectic::solver::{Derivatives, DualNumbers, SystemInDuals};
use symplectic::system::Jacobian;
use symplectic::{Hamiltonian, Integrator, Scalar, State, System, Vector};
use symplectic_tests::formulas;
use symplectic_tests::scenes::{self, outer_solar_system as planets};

/// Velocity, force and energy at a state.
fn values<V: Vector<Scalar = f64>>(system: &impl System<V>, q: &[f64], p: &[f64]) -> [Vec<f64>; 3] {
    let [q, p] = [q, p].map(|half| V::from_slice(half).expect("as many components"));
    let (mut velocity, mut force) = (q.zeros_like(), q.zeros_like());
    system.slopes(0.3, &q, &p, (&mut velocity, &mut force));
    let energy = system.energy(0.3, &q, &p).expect("an energy");
    // Apart they are the same.
    let (mut other, mut another) = (q.zeros_like(), q.zeros_like());
    system.velocity(0.3, &q, &p, &mut other);
    system.force(0.3, &q, &p, &mut another);
    assert_eq!((&velocity, &force), (&other, &another));
    [
        velocity.as_slice().to_vec(),
        force.as_slice().to_vec(),
        vec![energy],
    ]
}

/// A few states without a pattern.
fn states(dimension: usize) -> Vec<[Vec<f64>; 2]> {
    let mut seed = 7_u64;
    let mut next = || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    (0..8)
        .map(|_| [0, 1].map(|_| (0..dimension).map(|_| next()).collect()))
        .collect()
}

/// The formula gives what the system by hand gives, up to rounding.
fn same<V, W>(hand: &impl System<V>, formula: &impl System<W>, dimension: usize, tolerance: f64)
where
    V: Vector<Scalar = f64>,
    W: Vector<Scalar = f64>,
{
    for [q, p] in states(dimension) {
        let (by_hand, found) = (values(hand, &q, &p), values(formula, &q, &p));
        for (by_hand, found) in by_hand.iter().zip(&found) {
            let largest = by_hand
                .iter()
                .fold(1e-300_f64, |largest, x| largest.max(x.abs()));
            for (by_hand, found) in by_hand.iter().zip(found) {
                assert!(
                    (by_hand - found).abs() <= tolerance * largest,
                    "{found:e} for {by_hand:e}"
                );
            }
        }
    }
}

/// A formula in lanes has the bits of the same formula in doubles. Its Jacobian is that by dual numbers, and within its half bandwidth.
fn consistent<H, V>(system: &H, dimension: usize)
where
    V: Vector<Scalar = f64>,
    H: Hamiltonian<Vector<f64> = V> + SystemInDuals<V>,
{
    for [q, p] in states(dimension) {
        let lanes = |half: &[f64]| {
            let lanes: Vec<F64x4> = half
                .iter()
                .map(|&x| F64x4::from_fn(|lane| x * (1.0 + lane as f64 / 16.0)))
                .collect();
            H::Vector::<F64x4>::from_slice(&lanes).expect("as many components")
        };
        let (q4, p4) = (lanes(&q), lanes(&p));
        let (mut velocity, mut force) = (q4.zeros_like(), q4.zeros_like());
        Hamiltonian::slopes(
            system,
            F64x4::from_f64(0.3),
            &q4,
            &p4,
            (&mut velocity, &mut force),
        );
        for lane in 0..4 {
            let [q, p] = [&q, &p].map(|half| {
                half.iter()
                    .map(|x| x * (1.0 + lane as f64 / 16.0))
                    .collect::<Vec<_>>()
            });
            let [alone, by_itself, _] = values::<V>(system, &q, &p);
            let of = |vector: &[F64x4]| {
                vector
                    .iter()
                    .map(|x| x.to_array()[lane])
                    .collect::<Vec<_>>()
            };
            assert_eq!(of(velocity.as_slice()), alone);
            assert_eq!(of(force.as_slice()), by_itself);
        }
        let [q, p] = [q, p].map(|half| V::from_slice(&half).expect("as many components"));
        let band = Hamiltonian::half_bandwidth(system);
        let mut exact = Jacobian::new(dimension, band);
        assert!(Hamiltonian::second_derivatives(
            system, 0.3, &q, &p, &mut exact
        ));
        let (exact, dual) = (&exact, &mut Jacobian::new(dimension, dimension));
        let mut memory = <DualNumbers as Derivatives<V, H>>::memory(&q);
        <DualNumbers as Derivatives<V, H>>::evaluate(&mut memory, system, 0.3, &q, &p, dual);
        for part in [
            |j: &Jacobian<f64>, i, k| j.velocity_by_position.get(i, k),
            |j: &Jacobian<f64>, i, k| j.velocity_by_momentum.get(i, k),
            |j: &Jacobian<f64>, i, k| j.force_by_position.get(i, k),
        ] as [fn(&Jacobian<f64>, usize, usize) -> f64; 3]
        {
            let places = || (0..dimension).flat_map(|i| (0..dimension).map(move |k| (i, k)));
            let largest = places().fold(1e-300_f64, |largest, (i, k)| {
                largest.max(part(dual, i, k).abs())
            });
            for (i, k) in places() {
                let (exact, dual) = (part(exact, i, k), part(dual, i, k));
                assert!(
                    (exact - dual).abs() <= 1e-13 * largest,
                    "({i}, {k}): {exact:e} for {dual:e}"
                );
            }
        }
    }
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
fn what_is_missing_at_run_time_is_an_error_of_the_integrator() {
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
