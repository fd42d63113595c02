//! A chain of 32 links of length 1 with unit masses, in the plane, hanging from one end and released sideways: 32 holonomic constraints.
//!
//! *Needs:* a method that is `constrained`. *Source:* our choice. *Reference:* computed by Lobatto with five stages.

use symplectic::State;
use symplectic::nalgebra::DVector;

/// Number of links.
pub const LINKS: usize = 32;

symplectic::hamiltonian! {
    /// The chain; `rods` are pairs of masses, and the first mass is tied to the origin.
    pub Chain { rods: pairs }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/2 + q[i][1])
    constraints: { anchor = |q[0]|^2 - 1, rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - 1 }
}

/// The system.
pub fn system() -> Chain {
    Chain::new((1..LINKS).map(|k| (k - 1, k)).collect())
}

/// At rest, on an arc that goes down to the right.
pub fn start() -> State<DVector<f64>> {
    let mut q = DVector::zeros(2 * LINKS);
    let (mut x, mut y) = (0.0, 0.0);
    for k in 0..LINKS {
        let angle = 0.5 + k as f64 / LINKS as f64;
        (x, y) = (x + angle.cos(), y - angle.sin());
        (q[2 * k], q[2 * k + 1]) = (x, y);
    }
    State::new(0.0, q, DVector::zeros(2 * LINKS))
}

#[cfg(test)]
mod tests {
    use symplectic::Integrator;
    use symplectic::constraints::HolonomicConstraints;

    use super::*;
    use crate::methods::Lobatto4;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        check::derivatives(&system(), &start(), 1e-5, 1e-8);
    }

    /// The energy and the lengths of the links are conserved, while the chain falls.
    #[test]
    fn the_chain_falls() {
        let mut run = Integrator::new(Lobatto4, system(), start(), 1.0 / 32.0).expect("a start");
        let before = run.energy().expect("known");
        run.integrate_to(2.0).expect("steps");
        let after = run.energy().expect("known");
        assert!((after / before - 1.0).abs() < 1e-9);
        let mut values = [1.0; LINKS];
        HolonomicConstraints::constraint_values(&system(), &run.state().q, &mut values);
        // Coordinates up to 32 are known to 10⁻¹⁵ of this.
        assert!(values.iter().all(|value| value.abs() < 1e-13));
        assert!(run.state().q[2 * LINKS - 1] < start().q[2 * LINKS - 1] - 0.5);
    }
}
