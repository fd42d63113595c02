//! Parameters of formulas that do not fit the state: an error when an integrator is created, and not in a step.

use crate::common::methods::{Gauss2, StoermerVerlet};
use symplectic::adaptive::Logarithmic;
use symplectic::ensemble::{Ensemble, EnsembleError};
use symplectic::nalgebra::DVector;
use symplectic::tangent::Tangent;
use symplectic::variational::{self, LagrangianSteps, Newmark, generating_function};
use symplectic::{Error, Integrator, State};

symplectic::hamiltonian! {
    /// Bodies that attract each other.
    Bodies { m: [..] }
    q: [..; 3], p: [..; 3];
    H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: m[i] m[j]/|q[i] - q[j]|)
}

symplectic::hamiltonian! {
    /// Particles and springs between some of them.
    Net { springs: pairs, stiffness: [springs], coupling: [.., ..] }
    q: [..], p: [..];
    H = sum(i: p[i]^2/2) + sum(s = (i, j) in springs: stiffness[s] (q[i] - q[j])^2/2) + sum(i < j: coupling[i, j] q[i] q[j])
}

symplectic::hamiltonian! {
    /// Particles, of which the formula names the first two.
    Held q: [..], p: [..];
    H = sum(i: p[i]^2/2) + (q[0]^2 + q[1]^4)/2
}

symplectic::hamiltonian! {
    /// A pair of parameters in a matrix over the pairs of a system of fixed length.
    Three { springs: pairs, both: [springs, 2] }
    q: [3], p: [3];
    H = |p|^2/2 + sum(s = (i, j) in springs: both[s, 0] (q[i] - q[j])^2/2 + both[s, 1] (q[i] - q[j])^4/4)
}

symplectic::lagrangian! {
    /// Relativistic particles: there is no formula of H.
    Fast { m: [..] }
    q: [..], v: [..];
    L = -sum(i: m[i] sqrt(1 - v[i]^2)) - sum(i: q[i]^2/2)
}

symplectic::hamiltonian! {
    Attracted { mu: 1 } q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 - mu/sqrt(x^2 + y^2)
}

#[test]
fn a_parameter_is_a_number() {
    let start = || State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.0]);
    let error = Integrator::new(Gauss2, Attracted { mu: f64::NAN }, start(), 0.01).err();
    let parameter = "mu";
    assert_eq!(error, Some(Error::ParameterNotANumber { parameter }));
    assert!(Integrator::new(Gauss2, Attracted { mu: 2.0 }, start(), 0.01).is_ok());
}

#[test]
fn every_entry_of_a_parameter_is_a_number() {
    let masses = Bodies::new(vec![1.0, f64::NAN]);
    let error = Integrator::new(StoermerVerlet, masses, start(6), 0.01).err();
    let parameter = "m";
    assert_eq!(error, Some(Error::ParameterNotANumber { parameter }));
    let rows = vec![vec![1.0, 1.0], vec![f64::NAN, 1.0]];
    let net = Net::new(vec![(0, 1)], vec![1.0], rows);
    let error = Integrator::new(StoermerVerlet, net, start(2), 0.01).err();
    let parameter = "coupling";
    assert_eq!(error, Some(Error::ParameterNotANumber { parameter }));
    let three = Three::new(vec![(0, 1)], vec![[1.0, f64::NAN]]);
    let at_rest = State::from_arrays(0.0, [0.0, 1.0, 2.0], [0.0; 3]);
    let error = Integrator::new(StoermerVerlet, three, at_rest, 0.01).err();
    let parameter = "both";
    assert_eq!(error, Some(Error::ParameterNotANumber { parameter }));
}

/// A state at rest whose positions are all different.
fn start(dimension: usize) -> State<DVector<f64>> {
    let q = DVector::from_fn(dimension, |i, _| (i * i) as f64);
    State::new(0.0, q, DVector::zeros(dimension))
}

fn masses(length: usize) -> Bodies {
    Bodies::new(vec![1.0; length])
}

fn length(parameter: &'static str, found: usize, expected: usize) -> Error {
    Error::ParameterLength {
        parameter,
        found,
        expected,
    }
}

#[test]
fn a_wrong_number_of_masses_is_refused() {
    for found in [0, 1, 3, 7] {
        let error = Integrator::new(StoermerVerlet, masses(found), start(6), 0.01).err();
        assert_eq!(error, Some(length("m", found, 2)));
    }
    let text = length("m", 7, 2).to_string();
    assert!(
        text.starts_with("the parameter `m` has 7 entries; it needs 2: give an entry"),
        "{text}"
    );
    let text = length("m", 1, 2).to_string();
    assert!(
        text.starts_with("the parameter `m` has 1 entry; it needs 2: "),
        "{text}"
    );
    let mut run = Integrator::new(StoermerVerlet, masses(2), start(6), 0.01).expect("fits");
    run.step().expect("is defined");
}

#[test]
fn the_dimension_is_a_multiple_of_the_components() {
    let error = Integrator::new(StoermerVerlet, masses(2), start(7), 0.01).err();
    let (dimension, factor) = (7, 3);
    assert_eq!(error, Some(Error::DimensionFactor { dimension, factor }));
}

#[test]
fn pairs_out_of_range_are_refused() {
    let net = |springs: Vec<(usize, usize)>, stiffness: usize, rows: &[usize]| {
        let coupling = rows.iter().map(|&row| vec![1.0; row]).collect();
        let net = Net::new(springs, vec![1.0; stiffness], coupling);
        Integrator::new(StoermerVerlet, net, start(2), 0.01).map(|_| ())
    };
    let pair_out_of_range = |index, pair| {
        Err(Error::PairOutOfRange {
            parameter: "springs",
            index,
            pair,
            bodies: 2,
        })
    };
    let both = [2, 2];
    assert_eq!(net(vec![(0, 1)], 1, &both), Ok(()));
    assert_eq!(net(vec![], 0, &both), Ok(()));
    assert_eq!(
        net(vec![(1, 0), (0, 2)], 2, &both),
        pair_out_of_range(1, (0, 2))
    );
    assert_eq!(net(vec![(3, 0)], 1, &both), pair_out_of_range(0, (3, 0)));
    assert_eq!(
        net(vec![(0, 1); 3], 2, &both),
        Err(length("stiffness", 2, 3))
    );
    assert_eq!(
        net(vec![(0, 1); 2], 3, &both),
        Err(length("stiffness", 3, 2))
    );
    assert_eq!(net(vec![(0, 1)], 1, &[2]), Err(length("coupling", 1, 2)));
    assert_eq!(net(vec![(0, 1)], 1, &[2, 3]), Err(length("coupling", 3, 2)));
    let text = pair_out_of_range(1, (0, 2))
        .expect_err("an error")
        .to_string();
    assert!(
        text.starts_with("pair 1 of the parameter `springs` is (0, 2), but there are 2 bodies"),
        "{text}"
    );
}

#[test]
fn pairs_of_a_system_of_fixed_length_are_checked() {
    let three = |springs: Vec<(usize, usize)>, count: usize| {
        let start = State::from_arrays(0.0, [0.0, 1.0, 3.0], [0.0; 3]);
        let system = Three::new(springs, vec![[1.0, 2.0]; count]);
        Integrator::new(StoermerVerlet, system, start, 0.01).map(|_| ())
    };
    assert_eq!(three(vec![(0, 1), (1, 2)], 2), Ok(()));
    assert_eq!(three(vec![(0, 1), (1, 2)], 1), Err(length("both", 1, 2)));
    let error = three(vec![(0, 3)], 1).expect_err("there is no body 3");
    assert!(
        matches!(error, Error::PairOutOfRange { bodies: 3, .. }),
        "{error}"
    );
}

#[test]
fn there_are_as_many_bodies_as_the_formula_names() {
    let error = Integrator::new(StoermerVerlet, Held, start(1), 0.01).err();
    let (bodies, least) = (1, 2);
    assert_eq!(error, Some(Error::TooFewBodies { bodies, least }));
    assert!(Integrator::new(StoermerVerlet, Held, start(2), 0.01).is_ok());
}

#[test]
fn ensembles_check_every_start() {
    let error = Ensemble::new(StoermerVerlet, masses(3), vec![start(6)], 0.01).err();
    let (trajectory, error_of_start) = (0, length("m", 3, 2));
    assert_eq!(
        error,
        Some(EnsembleError::Start {
            trajectory,
            error: error_of_start
        })
    );
}

#[test]
fn systems_around_a_system_check_it_too() {
    let expected = length("m", 3, 2);
    let displaced = start(12);
    let error = Integrator::new(StoermerVerlet, Tangent::new(masses(3)), displaced, 0.01).err();
    assert_eq!(error, Some(expected.clone()));
    let extended: Result<State<DVector<f64>>, _> = Logarithmic::new(masses(3)).extend(&start(6));
    assert_eq!(extended.err(), Some(expected.clone().into()));
    let newmark = Newmark::new(masses(3), 0.25, 0.01).expect("finite");
    let in_mechanics = Some(variational::Error::Core(expected.clone()));
    assert_eq!(newmark.shift(&start(6)).err(), in_mechanics);
    let error = generating_function(Gauss2, &masses(3), 0.0, &start(6).q, &start(6).p, 0.01).err();
    assert_eq!(error, in_mechanics);
    let system = Fast::new(vec![1.0; 3]);
    let error = LagrangianSteps::run(Gauss2, system, start(2), 0.01).err();
    assert_eq!(error, in_mechanics);
}
