//! A spherical pendulum of length 1 in a resisting medium: a holonomic constraint and a force that depends on the momentum.
//!
//! *Needs:* a method that is `constrained`; not separable. *Source:* Marsden & West (2001), §3.7, forces with constraints; the numbers are
//! our choice. *Reference:* in angles, [`InAngles`].

use symplectic::State;
use symplectic::nalgebra::{Vector2, Vector3};

symplectic::hamiltonian! {
    /// The pendulum in Cartesian coordinates.
    pub OnARod { drag: 0.1 }
    q: [3], p: [3];
    H = |p|^2/2 + q[2]
    constraints: { rod = |q|^2 - 1 }
    force: { q[i] = -drag p[i] }
}

symplectic::hamiltonian! {
    /// The pendulum in angles: a from the vertical, b about it. The drag −γv is −γp in angles too, because the masses are 1.
    pub InAngles { drag: 0.1 }
    q: [a, b], p: [pa, pb];
    H = pa^2/2 + pb^2/(2 sin(a)^2) - cos(a)
    force: { a = -drag pa, b = -drag pb }
}

/// The state at time 0, in angles.
pub fn start_in_angles() -> State<Vector2<f64>> {
    State::from_arrays(0.0, [1.2, 0.0], [0.3, 0.9])
}

/// The state in Cartesian coordinates of a state in angles.
pub fn on_a_rod(state: &State<Vector2<f64>>) -> State<Vector3<f64>> {
    let ([a, b], [pa, pb]) = state.to_arrays();
    let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
    let q = Vector3::new(sa * cb, sa * sb, -ca);
    let along = Vector3::new(ca * cb, ca * sb, sa);
    let across = Vector3::new(-sb, cb, 0.0);
    State::new(state.time, q, along * pa + across * (pb / sa))
}

#[cfg(test)]
mod tests {
    use symplectic::constraints::Constrained;
    use symplectic::{General, Integrator, Method, ProvedFor, System};

    use super::*;
    use crate::methods::{Gauss6, Lobatto3, Lobatto4, Lobatto5, StoermerVerlet};
    use crate::order::ObservedOrder;
    use crate::scenes::check;

    #[test]
    fn the_derivatives_are_those_of_the_energy() {
        check::derivatives(&InAngles { drag: 0.0 }, &start_in_angles(), 1e-5, 1e-8);
        let start = on_a_rod(&start_in_angles());
        check::derivatives(&OnARod { drag: 0.0 }, &start, 1e-5, 1e-8);
    }

    #[test]
    fn both_forms_are_the_same_motion() {
        let (angles, start) = (start_in_angles(), on_a_rod(&start_in_angles()));
        let energies = [
            System::energy(&InAngles::new(), 0.0, &angles.q, &angles.p),
            System::energy(&OnARod::new(), 0.0, &start.q, &start.p),
        ];
        let [Some(one), Some(other)] = energies else {
            panic!("both are known")
        };
        assert!((one - other).abs() < 1e-15);
        let mut run = Integrator::new(Gauss6, InAngles::new(), angles, 0.05).expect("a start");
        let expected = on_a_rod(run.integrate_to(2.0).expect("steps"));
        let mut run = Integrator::new(Lobatto4, OnARod::new(), start, 0.02).expect("a start");
        let found = run.integrate_to(2.0).expect("steps");
        assert!((found.q - expected.q).norm() < 1e-9 && (found.p - expected.p).norm() < 1e-9);
        // The drag matters.
        let lost = one - run.energy().expect("known");
        assert!(lost > 0.1, "{lost}");
    }

    /// The orders against the motion in angles, with drag and without, and not one higher.
    #[test]
    fn constrained_methods_have_their_orders_with_drag() {
        fn slope<M>(method: M, drag: f64, order: f64, steps: [u64; 3])
        where
            M: Method + ProvedFor<Constrained<General>> + Copy,
        {
            const END: f64 = 2.0;
            let angles = InAngles { drag };
            let mut exact =
                Integrator::new(Gauss6, angles, start_in_angles(), END / 256.0).expect("a start");
            let exact = on_a_rod(exact.take_steps(256).expect("steps"));
            let runs = steps.map(|steps| {
                let (start, size) = (on_a_rod(&start_in_angles()), END / steps as f64);
                let mut run =
                    Integrator::new(method, OnARod { drag }, start, size).expect("a start");
                let end = run.take_steps(steps).expect("steps");
                (size, (end.q - exact.q).norm() + (end.p - exact.p).norm())
            });
            let found = ObservedOrder::of(&runs);
            assert!(
                found.shows(order, 0.05),
                "{}, drag {drag}: {found}",
                M::NAME
            );
        }
        for drag in [0.0, 0.1] {
            slope(StoermerVerlet, drag, 2.0, [100, 200, 400]);
            slope(Lobatto3, drag, 4.0, [20, 40, 80]);
            slope(Lobatto4, drag, 6.0, [10, 16, 24]);
            slope(Lobatto5, drag, 8.0, [5, 7, 10]);
        }
    }
}
