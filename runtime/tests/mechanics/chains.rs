//! Chains of links: the band of `G M⁻¹ Gᵀ`, and the same motion in other formulations.

use crate::methods::{Gauss6, Lobatto5};
use symplectic::constraints::{Constrained, Gradients, HolonomicConstraints};
use symplectic::nalgebra::{DVector, SVector};
use symplectic::system::{Lagrangian, Masses};
use symplectic::variational::{Error, LagrangianSteps, momentum_of_velocity};
use symplectic::{Hamiltonian, Integrator, Scalar, Separable};

use crate::systems::*;

/// The chain of [`Links`] with gradients that have an entry in every place, most of them zero: `G M⁻¹ Gᵀ` is a full matrix.
#[derive(Clone, Copy)]
struct Dense(Links);

impl Hamiltonian for Dense {
    type Class = Constrained<Separable>;
    type Vector<T: Scalar> = DVector<T>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(&self, _: T, _: &DVector<T>, p: &DVector<T>, velocity: &mut DVector<T>) {
        velocity.copy_from(p);
    }

    fn force<T: Scalar>(&self, time: T, q: &DVector<T>, p: &DVector<T>, force: &mut DVector<T>) {
        Hamiltonian::force(&self.0, time, q, p, force);
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn HolonomicConstraints<DVector<T>>> {
        Some(self)
    }
}

impl<T: Scalar> HolonomicConstraints<DVector<T>> for Dense {
    fn constraints(&self) -> usize {
        HolonomicConstraints::<DVector<T>>::constraints(&self.0)
    }
    fn constraint_values(&self, q: &DVector<T>, values: &mut [T]) {
        HolonomicConstraints::constraint_values(&self.0, q, values);
    }
    fn constraint_gradients(&self, q: &DVector<T>, gradients: &mut Gradients<T>) {
        let links = self.0.0;
        for link in 0..links {
            for component in 0..2 * links {
                let before = if link > 0 {
                    q[2 * link - 2 + component % 2]
                } else {
                    T::zero()
                };
                let twice = T::from_f64(2.0) * (q[2 * link + component % 2] - before);
                let entry = match (component / 2).abs_diff(link) {
                    0 => twice,
                    1 if component / 2 < link => -twice,
                    _ => T::zero(),
                };
                gradients.set(link, component, entry);
            }
        }
    }
}

/// A band and a full matrix give the same motion up to rounding errors, which grow as the chain falls.
#[test]
#[ignore = "thorough"]
fn a_band_and_a_full_matrix_are_the_same_motion() -> Result<(), Error> {
    let links = Links(30);
    let mut band = Integrator::new(Rattle, links, links.start(), 0.005)?;
    let mut full = Integrator::new(Rattle, Dense(links), links.start(), 0.005)?;
    for _ in 0..5 {
        let (band, full) = (band.take_steps(80)?, full.take_steps(80)?);
        let apart = (&band.q - &full.q).amax().max((&band.p - &full.p).amax());
        assert!(apart < 1e-10, "t = {}: {apart:e}", band.time);
    }
    let moved = (&band.state().q - links.start().q).amax();
    assert!(moved > 1.0, "{moved}");
    Ok(())
}

symplectic::hamiltonian! {
    /// A chain of masses in air.
    Dragged { m: [..], rods: pairs }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/(2 m[i]) + q[i][1])
    force: { q[i] = -p[i]/(10 m[i]) }
    constraints: { anchor = |q[0]|^2 - 1, rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - 1 }
}

/// The memory of a run is linear in the number of links, and quadratic with a full matrix: twice as many links add twice as much.
#[test]
#[ignore = "thorough"]
fn the_memory_is_linear_in_the_links() {
    fn growth(size: impl Fn(usize) -> usize) -> f64 {
        let [a, b, c] = [50, 100, 200].map(|links| size(links) as f64);
        (c - b) / (b - a)
    }
    let band = growth(|links| {
        let chain = Links(links);
        let mut run = Integrator::new(Rattle, chain, chain.start(), 0.005).expect("a run");
        run.step().expect("a step");
        format!("{:?}", run.checkpoint().expect("saved")).len()
    });
    let full = growth(|links| {
        let chain = Links(links);
        let mut run = Integrator::new(Rattle, Dense(chain), chain.start(), 0.005).expect("a run");
        run.step().expect("a step");
        format!("{:?}", run.checkpoint().expect("saved")).len()
    });
    // With constant masses and a force of momenta too.
    let dragged = growth(|links| {
        let rods = (1..links).map(|k| (k - 1, k)).collect();
        let chain = Dragged::new(vec![2.0; links], rods);
        let mut run = Integrator::new(Rattle, chain, Links(links).start(), 0.005).expect("a run");
        run.step().expect("a step");
        format!("{:?}", run.checkpoint().expect("saved")).len()
    });
    // The number of digits of the dimension may differ.
    assert!((band - 2.0).abs() < 1e-3, "{band}");
    assert!((dragged - 2.0).abs() < 1e-3, "{dragged}");
    assert!(full > 3.0, "{full}");
}

/// The number of sweeps does not grow with the number of links, so the work of a step is linear in it.
#[test]
fn the_sweeps_do_not_depend_on_the_links() {
    let sweeps = |links: usize| {
        let chain = Links(links);
        let mut run = Integrator::new(Rattle, chain, chain.start(), 0.005).expect("a run");
        run.take_steps(100).expect("steps");
        run.statistics().iterations as f64
    };
    let (short, long) = (sweeps(100), sweeps(1000));
    assert!((long / short - 1.0).abs() < 0.1, "{short} {long}");
}

/// The chain by its angles from below: the place of a body is the sum of the links before it.
#[derive(Clone, Copy)]
struct ByAngles;

const LINKS: usize = 6;

impl Lagrangian for ByAngles {
    type Vector<T: Scalar> = SVector<T, LINKS>;

    fn lagrangian<T: Scalar>(&self, _: T, a: &SVector<T, LINKS>, v: &SVector<T, LINKS>) -> T {
        let (mut height, mut velocity) = (T::zero(), [T::zero(); 2]);
        let mut sum = T::zero();
        for (&a, &v) in a.iter().zip(v.iter()) {
            let (sine, cosine) = (a.sin(), a.cos());
            height -= cosine;
            velocity = [velocity[0] + cosine * v, velocity[1] + sine * v];
            let square = velocity[0] * velocity[0] + velocity[1] * velocity[1];
            sum += square * T::from_f64(0.5) - height;
        }
        sum
    }
}

#[test]
fn coordinates_and_angles_are_the_same_motion() -> Result<(), Error> {
    let links = Links(LINKS);
    let angles = SVector::from([core::f64::consts::FRAC_PI_2; LINKS]);
    let rest = SVector::zeros();
    assert_eq!(momentum_of_velocity(&ByAngles, 0.0, &angles, &rest)?, rest);
    let mut angles =
        LagrangianSteps::from_velocity(Gauss6, ByAngles, 0.0, angles, rest, 1.0 / 64.0)?;
    let mut plane = Integrator::new(Lobatto5, links, links.start(), 1.0 / 128.0)?;
    for time in [0.5, 1.0, 1.5] {
        let (a, q) = (angles.integrate_to(time)?.q, &plane.integrate_to(time)?.q);
        let mut place = [0.0, 0.0];
        for (link, a) in a.iter().enumerate() {
            let (sine, cosine) = a.sin_cos();
            place = [place[0] + sine, place[1] - cosine];
            for k in 0..2 {
                let apart = (q[2 * link + k] - place[k]).abs();
                assert!(apart < 1e-10, "t = {time}, link {link}: {apart:e}");
            }
        }
    }
    Ok(())
}
