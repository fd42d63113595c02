//! Chains: forces, energies, and many steps at once.

use crate::common::methods::{
    AdjointEuler, Gauss2, PositionJump, StoermerVerlet, SymplecticEuler, TripleJump,
};
use symplectic::emitted::{Bonds, Chain};
use symplectic::nalgebra::DVector;
use symplectic::simd::{F64x4, Lanes};
use symplectic::{Compensated, Error, Integrator, Method, Scalar, State, System, Vector};

/// `V(d) = d²/2 + d³/3`, which pulls at rest length too once it is moved by a quarter; a driven pendulum on every particle.
#[derive(Clone, Copy)]
struct Driven;

impl Bonds for Driven {
    fn tension<T: Scalar>(&self, time: T, stretch: T) -> T {
        stretch.fused(stretch, stretch + T::from_f64(0.25)) + time * T::from_f64(0.01)
    }

    fn outer_force<T: Scalar>(&self, time: T, position: T) -> Option<T> {
        Some(time * T::from_f64(0.125) - position.sin())
    }

    fn bond_energy<T: Scalar>(&self, time: T, d: T) -> Option<T> {
        let third = T::from_f64(1.0 / 3.0);
        let pull = T::from_f64(0.25) + time * T::from_f64(0.01);
        Some(d * d * T::from_f64(0.5) + d * d * d * third + pull * d)
    }

    fn outer_energy<T: Scalar>(&self, time: T, position: T) -> Option<T> {
        Some(-position.cos() - time * T::from_f64(0.125) * position)
    }
}

/// The same in registers that the program detects.
#[derive(Clone, Copy)]
struct Inlined;

impl Bonds for Inlined {
    const INLINED: bool = true;

    fn tension<T: Scalar>(&self, time: T, stretch: T) -> T {
        Driven.tension(time, stretch)
    }

    fn outer_force<T: Scalar>(&self, time: T, position: T) -> Option<T> {
        Driven.outer_force(time, position)
    }
}

/// Harmonic bonds, and nothing else; no energy is known.
#[derive(Clone, Copy)]
struct Springs;

impl Bonds for Springs {
    fn tension<T: Scalar>(&self, _time: T, stretch: T) -> T {
        stretch
    }
}

fn chains<B: Bonds + Copy>(bonds: B) -> [Chain<B>; 3] {
    [
        Chain::between_walls(bonds),
        Chain::with_free_ends(bonds),
        Chain::ring(bonds),
    ]
}

fn waves(n: usize, phase: f64) -> DVector<f64> {
    DVector::from_fn(n, |i, _| 0.3 * (phase + 1.7 * i as f64).sin())
}

fn force<V: Vector, S: System<V>>(system: &S, time: f64, q: &V) -> V {
    let mut force = q.zeros_like();
    system.force(V::Scalar::from_f64(time), q, q, &mut force);
    force
}

#[test]
fn forces_are_those_of_the_energy() {
    for n in [1, 2, 3, 7, 8, 9, 64, 71] {
        let (q, p) = (waves(n, 0.2), waves(n, 1.1));
        for chain in chains(Driven) {
            let force = force(&chain, 0.7, &q);
            for i in 0..n {
                let energy = |by: f64| {
                    let mut q = q.clone();
                    q[i] += by;
                    System::energy(&chain, 0.7, &q, &p).expect("an energy")
                };
                let slope = (energy(1e-5) - energy(-1e-5)) / 2e-5;
                assert!((force[i] + slope).abs() < 1e-8, "{n} {i}");
            }
        }
    }
}

/// Written out, particle by particle.
#[test]
fn walls_free_ends_and_rings_have_their_forces() {
    let q = DVector::from_vec(vec![1.0, 3.0, 7.0]);
    let [walls, free, ring] = chains(Springs).map(|chain| force(&chain, 0.0, &q));
    assert_eq!(walls.as_slice(), [1.0, 2.0, -11.0]);
    assert_eq!(free.as_slice(), [2.0, 2.0, -4.0]);
    assert_eq!(ring.as_slice(), [8.0, 2.0, -10.0]);
    let q = DVector::from_element(1, 5.0);
    let forces = chains(Springs).map(|chain| force(&chain, 0.0, &q)[0]);
    assert_eq!(forces, [-10.0, 0.0, 0.0]);
    for chain in chains(Springs) {
        assert_eq!(force(&chain, 0.0, &DVector::<f64>::zeros(0)).len(), 0);
    }
    assert_eq!(System::energy(&chains(Springs)[0], 0.0, &q, &q), None);
}

/// Doubles go in rows, numbers of other kinds one by one.
#[test]
fn rows_have_the_bits_of_single_particles() {
    for n in (1..40).chain([64, 127, 200]) {
        for (chain, wide) in chains(Driven).iter().zip(chains(Inlined)) {
            let q = waves(n, 0.4);
            let side_by_side = q.map(|q| F64x4::from_fn(|lane| q + 0.01 * lane as f64));
            let expected = force(chain, 0.7, &side_by_side);
            for lane in 0..4 {
                let q = side_by_side.map(|q| q.to_array()[lane]);
                let expected = expected.map(|force| force.to_array()[lane]);
                assert_eq!(force(chain, 0.7, &q), expected, "{n}");
                assert_eq!(force(&wide, 0.7, &q), expected, "{n}");
            }
        }
    }
}

#[test]
#[ignore = "thorough"]
fn many_steps_are_the_steps_one_by_one() -> Result<(), Error> {
    fn check<M: Method + Copy>(method: M, n: usize) -> Result<(), Error> {
        for chain in chains(Driven) {
            let start = State::new(0.5, waves(n, 0.1), waves(n, 1.3));
            let made = || Integrator::plain(method, chain, start.clone(), 0.02);
            let (mut at_once, mut one_by_one) = (made()?, made()?);
            for count in [2, 3, 300] {
                at_once.take_steps(count)?;
                for _ in 0..count {
                    one_by_one.step()?;
                }
                assert_eq!(at_once.state(), one_by_one.state(), "{} {n}", M::NAME);
                assert_eq!(at_once.statistics(), one_by_one.statistics());
            }
        }
        Ok(())
    }
    for n in [3, 8, 70, 257] {
        check(StoermerVerlet, n)?;
        check(SymplecticEuler, n)?;
        check(AdjointEuler, n)?;
        check(TripleJump, n)?;
        check(PositionJump, n)?;
    }
    Ok(())
}

/// Rings and chains with free ends push nobody.
#[test]
fn the_momentum_of_a_chain_without_walls_is_kept() -> Result<(), Error> {
    for chain in &chains(Springs)[1..] {
        let start = State::new(0.0, waves(100, 0.0), waves(100, 0.5));
        let total = start.p.sum();
        let mut plain = Integrator::plain(TripleJump, *chain, start.clone(), 0.05)?;
        assert!((plain.take_steps(4000)?.p.sum() - total).abs() < 1e-12);
        let mut implicit = Integrator::<_, _, _, Compensated>::new(Gauss2, *chain, start, 0.05)?;
        assert!((implicit.take_steps(400)?.p.sum() - total).abs() < 1e-13);
    }
    Ok(())
}

/// A force that is not finite among many steps: the error, and the state, of the step that has it.
#[test]
fn a_step_that_fails_among_many_is_found() -> Result<(), Error> {
    #[derive(Clone, Copy)]
    struct Breaking;
    impl Bonds for Breaking {
        fn tension<T: Scalar>(&self, _time: T, stretch: T) -> T {
            (T::one() - stretch).sqrt()
        }
    }
    let start = State::new(0.0, DVector::zeros(80), waves(80, 0.0));
    let made = || Integrator::plain(StoermerVerlet, Chain::ring(Breaking), start.clone(), 0.01);
    let (mut at_once, mut one_by_one) = (made()?, made()?);
    let expected = loop {
        if let Err(error) = one_by_one.step() {
            break error;
        }
    };
    assert_eq!(at_once.take_steps(100_000).expect_err("a break"), expected);
    assert_eq!(at_once.state(), one_by_one.state());
    assert!(at_once.steps() > 100);
    Ok(())
}
