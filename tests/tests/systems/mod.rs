//! Two systems compared at states without a pattern.
#![allow(dead_code, reason = "each test file uses its own part")]

use symplectic::simd::{F64x4, Lanes};
use symplectic::solver::{Derivatives, DualNumbers, SystemInDuals};
use symplectic::system::Jacobian;
use symplectic::{Hamiltonian, Scalar, System, Vector};

/// Velocity, force and energy at a state.
pub fn values<V: Vector<Scalar = f64>>(
    system: &impl System<V>,
    q: &[f64],
    p: &[f64],
) -> [Vec<f64>; 3] {
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
pub fn states(dimension: usize) -> Vec<[Vec<f64>; 2]> {
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
pub fn same<V, W>(hand: &impl System<V>, formula: &impl System<W>, dimension: usize, tolerance: f64)
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
pub fn consistent<H, V>(system: &H, dimension: usize)
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
