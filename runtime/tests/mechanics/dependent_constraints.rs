//! Constraints that depend on each other at a state: the error says when, which, and by how much.

use symplectic::constraints::{ConstraintName, consistent, constraint_force};
use symplectic::nalgebra::{DVector, SVector, Vector3};
use symplectic::{Error, Integrator, Method, ProvedFor, State};

use crate::systems::{Lobatto3, Lobatto4, Rattle};

symplectic::hamiltonian! {
    /// A bead on two planes, with the angle atan(slope) between them.
    pub Planes { slope: 1 }
    q: [x, y, z], p: [px, py, pz];
    H = (px^2 + py^2 + pz^2)/2
    constraints: { wall = x, roof = x + slope y }
}

symplectic::hamiltonian! {
    /// A bead on a plane and on a cross of two planes: on the line y = z = 0, except that the gradients are parallel at x = 0.
    pub Cross
    q: [x, y, z], p: [px, py, pz];
    H = (px^2 + py^2 + pz^2)/2
    constraints: { ground = y, twist = y + x z }
}

symplectic::hamiltonian! {
    /// Points that are joined by rods.
    pub Frame { rods: pairs, length: [rods] }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/2)
    constraints: { rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - length[s]^2 }
}

const fn name(name: &'static str, member: Option<usize>) -> Option<ConstraintName> {
    Some(ConstraintName { name, member })
}

/// Planes at an angle ε have `G Gᵀ = (1 1; 1 1 + ε²)`, whose second pivot is ε². For ε = 2⁻²³ that is below 2⁻⁴⁰ = 4096 units of rounding,
/// for ε = 2⁻¹⁹ above.
#[test]
fn constraints_of_nearly_parallel_planes_are_dependent() {
    let start = || State::from_arrays(0.0, [0.0; 3], [0.0, 0.0, 1.0]);
    let state: State<Vector3<f64>> = State {
        time: 3.0,
        ..start()
    };
    let parallel = Planes {
        slope: 2.0_f64.powi(-23),
    };
    let errors = [
        Integrator::new(Rattle, parallel, state.clone(), 0.1).map(|_| ()),
        Integrator::new(Lobatto4, parallel, state.clone(), 0.1).map(|_| ()),
        constraint_force(&parallel, &state).map(|_| ()),
        consistent(&parallel, state.clone()).map(|_| ()),
    ];
    for error in errors {
        let error = error.expect_err("parallel");
        // Relative to the diagonal entry 1 + 2⁻⁴⁶.
        let expected = Error::DependentConstraints {
            time: 3.0,
            constraint: 1,
            name: name("roof", None),
            pivot: 2.0_f64.powi(-46) / (1.0 + 2.0_f64.powi(-46)),
        };
        assert_eq!(error, expected);
        let text = error.to_string();
        assert!(text.contains("roof") && text.contains("1.42"), "{text}");
    }
    let apart = Planes {
        slope: 2.0_f64.powi(-19),
    };
    let mut run = Integrator::new(Rattle, apart, start(), 0.125).expect("regular");
    assert_eq!(run.step().expect("a step").q[2], 0.125);
}

/// The bead reaches the cross at the end of step 8.
#[test]
fn constraints_that_become_dependent_end_the_run() {
    fn check<M: Method + ProvedFor<symplectic::constraints::Constrained<symplectic::Separable>>>(
        method: M,
    ) {
        let start: State<Vector3<f64>> = State::from_arrays(0.0, [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]);
        let mut run = Integrator::new(method, Cross, start, 0.125).expect("a run");
        let before = run.take_steps(7).expect("steps").clone();
        let there = SVector::from([0.125, 0.0, 0.0]);
        assert!((before.q - there).amax() < 1e-15, "{}", before.q);
        let error = run.step().map(|_| ()).expect_err("a cross");
        let Error::DependentConstraints {
            time,
            constraint,
            name: found,
            pivot,
        } = error
        else {
            panic!("{error}");
        };
        assert_eq!((constraint, found), (1, name("twist", None)));
        // The square of a position that is zero up to rounding errors.
        assert!(time == 0.875 && pivot < 1e-30, "{time} {pivot:e}");
        assert!(error.to_string().contains("twist"), "{error}");
        assert_eq!(run.state(), &before);
    }
    check(Rattle);
    check(Lobatto3);
}

/// A triangle whose corners lie on a line: one of its rods is redundant to first order, the last.
#[test]
fn the_dependent_member_of_a_family_is_named() {
    let frame = Frame::new(vec![(0, 1), (1, 2), (0, 2)], vec![1.0, 1.0, 2.0]);
    let q = DVector::from_vec(vec![0.0, 0.0, 1.0, 0.0, 2.0, 0.0]);
    let state = State::new(0.0, q.clone(), q * 0.0);
    let error = Integrator::new(Rattle, frame, state, 0.1).map(|_| ());
    let error = error.expect_err("on a line");
    let Error::DependentConstraints {
        constraint,
        name: found,
        pivot,
        ..
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!((constraint, found), (2, name("rod", Some(2))));
    assert!(pivot < 4.0 * f64::EPSILON, "{pivot:e}");
    assert!(error.to_string().contains("rod[2]"), "{error}");
}
