//! What the macro emits is what the compiler derives, however the method is named.

// Attributes of a definition reach its type: without the one on `lower_case` this would not compile.
#![deny(non_camel_case_types)]

use std::collections::{BTreeSet, HashSet};

use symplectic::solver::Coefficient;
use symplectic::{Error, General, Integrator, Method, ProvedFor, Scalar};
use symplectic_compiler::{Coefficients, Definition, Limits, Properties, Tableau};
use symplectic_tests::scenes::kepler::{Kepler, start};

symplectic::tableau! {
    /// From a file.
    GaussFromFile { file: "../tableaux/gauss-4.toml", require: [symplectic, symmetric, equal_matrices] }
    /// The same by its basis and nodes.
    GaussFromRule { basis: polynomial(4), nodes: gauss(4) }

    LobattoFromFile { file: "../tableaux/lobatto-3.toml" }
    LobattoFromRule { basis: polynomial(3), nodes: lobatto(3) }
    LobattoFromLists { basis: [1, t, t^2], nodes: [0, 1/2, 1] }
    /// Another basis of the same span, and nodes in another order.
    LobattoFromOtherLists { nodes: [1, 0, 2/4,], basis: [t - 1/2, 2, (t + 1)^2 / 3] }

    RadauLeft { basis: polynomial(3), nodes: radau-left(3), require: [symplectic] }
    RadauRight { basis: polynomial(2), nodes: radau-right(2) }
    Chebyshev { basis: polynomial(4), nodes: chebyshev(4) }
    ClenshawCurtis { basis: polynomial(4), nodes: clenshaw-curtis(4) }
    Fejer { basis: polynomial(3), nodes: fejer(3) }
    NewtonCotes { basis: polynomial(4), nodes: newton-cotes(4) }

    /// Everything that an explicit method can be asked for.
    Verlet {
        basis: polynomial(2),
        nodes: lobatto(2),
        require: [
            symplectic, symmetric, consistent, explicit, first_row_zero, stiffly_accurate, first_same_as_last,
            positive_weights, constrained, nonholonomic,
        ],
    }
    /// And what only a Runge–Kutta method has.
    Midpoint { basis: polynomial(1), nodes: gauss(1), require: [equal_matrices], max_stages: 1 }

    /// A coefficient whose double is the middle of two singles.
    BetweenSingles { basis: polynomial(1), nodes: [1/2 + 1/2^25 + 1/2^70] }

    /// Other tiers and constructions.
    Waves { basis: [1, cos(pi*t), sin(pi*t)], nodes: [0, 1/2, 1], require: [symplectic, symmetric] }
    NotConjugate { basis: polynomial(2), nodes: [1/2 - sqrt(2)/4, 1 - e^-1], require: [symplectic] }
    HalfWaves {
        basis: [1, t, cos(pi*t), sin(pi*t)],
        nodes: gauss(4),
        require: [symplectic, symmetric, consistent],
        accept: verified(1000 bits),
    }
    Tang { basis: legendre(2), quadrature: gauss(4), require: [symplectic, symmetric] }
    Simpson { basis: polynomial(2), quadrature: [0, 1/2, 1], weights: [1/6, 2/3, 1/6] }
    Exchanged { basis: polynomial(2), nodes: lobatto(2), exchange: true, require: [symplectic, explicit] }
    Heun { a: [[0, 0], [1, 0]], b: [1/2, 1/2], require: [consistent, explicit, equal_matrices] }
    GaussPartner {
        a: [[1/4, 1/4 - sqrt(3)/6], [1/4 + sqrt(3)/6, 1/4]],
        b: [1/2, 1/2],
        a_tilde: symplectic_partner,
        require: [symplectic, symmetric, equal_matrices],
    }

    #[allow(non_camel_case_types)]
    #[derive(Hash)]
    lower_case { basis: polynomial(1), nodes: [0] }
}

/// The constants of a method.
macro_rules! constants {
    ($method:ty) => {
        Coefficients {
            c: <$method>::C.to_vec(),
            c_tilde: <$method>::C_TILDE.to_vec(),
            b: <$method>::B.to_vec(),
            b_tilde: <$method>::B_TILDE.to_vec(),
            a: <$method>::A.iter().map(|row| row.to_vec()).collect(),
            a_tilde: <$method>::A_TILDE.iter().map(|row| row.to_vec()).collect(),
            gradient: Vec::new(),
        }
    };
}

/// The bits: 0.0 and −0.0 are not the same constant.
fn bits(coefficients: &Coefficients<f64>) -> Coefficients<u64> {
    coefficients.map(|value| value.to_bits())
}

fn derived(definition: &str) -> Result<Tableau, symplectic_compiler::Error> {
    Definition::parse(definition)?.derive(&Limits::default())
}

#[test]
fn constants_are_the_doubles_of_the_derivation() -> Result<(), symplectic_compiler::Error> {
    macro_rules! check {
        ($($method:ident)*) => {
            $(
                let exact = derived($method::DEFINITION)?;
                assert_eq!(bits(&constants!($method)), bits(&exact.to_f64()), "{}", $method::NAME);
                assert_eq!($method::STAGES, exact.stages());
                assert_eq!($method::NAME, stringify!($method));
            )*
        };
    }
    check! {
        GaussFromFile GaussFromRule LobattoFromFile LobattoFromRule LobattoFromLists LobattoFromOtherLists RadauLeft
        RadauRight Chebyshev ClenshawCurtis Fejer NewtonCotes Verlet Midpoint lower_case
    }
    Ok(())
}

/// What the runtime computes with, as lists like those of a derivation.
fn runtime<M: Method>() -> Coefficients<Coefficient> {
    let of = M::COEFFICIENTS;
    let matrix = |rows: &[&[Coefficient]]| rows.iter().map(|row| row.to_vec()).collect();
    Coefficients {
        c: of.c.to_vec(),
        c_tilde: of.c_tilde.to_vec(),
        b: of.b.to_vec(),
        b_tilde: of.b_tilde.to_vec(),
        a: matrix(of.a),
        a_tilde: matrix(of.a_tilde),
        gradient: of.gradient.to_vec(),
    }
}

#[test]
fn coefficients_are_rounded_from_the_derivation_for_every_scalar()
-> Result<(), symplectic_compiler::Error> {
    macro_rules! check {
        ($($method:ident)*) => {
            $(
                let exact = derived($method::DEFINITION)?;
                let expected = exact.numbers().map(|number| {
                    let double = number.to_f64();
                    Coefficient::new(double, number.low_double(double), number.to_f32())
                });
                assert_eq!(runtime::<$method>(), expected, "{}", $method::NAME);
            )*
        };
    }
    check! {
        GaussFromFile GaussFromRule LobattoFromFile LobattoFromRule LobattoFromLists LobattoFromOtherLists RadauLeft
        RadauRight Chebyshev ClenshawCurtis Fejer NewtonCotes Verlet Midpoint lower_case BetweenSingles
        Waves NotConjugate HalfWaves Tang Simpson Exchanged Heun GaussPartner
    }
    Ok(())
}

#[test]
fn singles_are_rounded_once() {
    // c = 1/2 + 2⁻²⁵ + 2⁻⁷⁰: the double drops the last term and is the middle of two singles, of which 1/2 is even.
    let c = BetweenSingles::COEFFICIENTS.c[0];
    assert_eq!(f64::from_coefficient(c), 0.5 + 2.0_f64.powi(-25));
    assert_eq!(c.low(), 2.0_f64.powi(-70));
    assert_eq!(f32::from_coefficient(c), 0.5 + 2.0_f32.powi(-24));
    assert_eq!(f32::from_f64(c.double()), 0.5, "rounded twice");
}

#[test]
fn constants_are_those_that_papers_print() {
    // GNI, Table II.2.1 and II.2.2.
    assert_eq!(
        LobattoFromLists::A,
        [
            [0.0; 3],
            [5.0 / 24.0, 1.0 / 3.0, -1.0 / 24.0],
            [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0]
        ]
    );
    assert_eq!(LobattoFromLists::A_TILDE[2], [1.0 / 6.0, 5.0 / 6.0, 0.0]);
    assert_eq!(Midpoint::A, [[0.5]]);
    // Table II.1.1: (88 − 7√6)/360 and (4 − √6)/10 are of Radau on the right with three stages; on the left the nodes
    // are mirrored.
    assert!((RadauLeft::C[1] - (6.0 - 6.0_f64.sqrt()) / 10.0).abs() < 1e-15);
    assert_eq!(RadauLeft::B[0], 1.0 / 9.0);
}

#[test]
fn a_method_from_a_file_steps_like_the_one_from_its_basis_and_nodes() -> Result<(), Error> {
    fn same<M: Method, N: Method>(one: M, other: N) -> Result<bool, Error> {
        let mut one = Integrator::new(one, Kepler, start::<f64>(0.6), 0.1)?;
        let mut other = Integrator::new(other, Kepler, start::<f64>(0.6), 0.1)?;
        let (one, other) = (one.integrate_to(20.0)?, other.integrate_to(20.0)?);
        let bits = |x: f64, y: f64| x.to_bits() == y.to_bits();
        let parts = [(&one.q, &other.q), (&one.p, &other.p)];
        Ok(parts
            .iter()
            .all(|(x, y)| x.iter().zip(y.iter()).all(|(x, y)| bits(*x, *y))))
    }
    assert!(same(GaussFromFile, GaussFromRule)?);
    assert!(same(LobattoFromFile, LobattoFromRule)?);
    assert!(same(LobattoFromLists, LobattoFromRule)?);
    assert!(same(LobattoFromOtherLists, LobattoFromRule)?);
    assert!(
        !same(GaussFromFile, LobattoFromFile)?,
        "the comparison can fail"
    );
    Ok(())
}

#[test]
fn a_method_from_a_file_states_its_definition() {
    let gauss = "basis: polynomial(4), nodes: gauss(4)";
    assert_eq!(GaussFromFile::DEFINITION, gauss);
    assert_eq!(GaussFromRule::DEFINITION, gauss);
    assert!(RadauLeft::DEFINITION.ends_with("nodes: radau-left(3)"));
}

#[test]
fn every_property_is_required_of_a_method_that_has_it() -> Result<(), symplectic_compiler::Error> {
    // The requirements of `Verlet` and `Midpoint` above are all there are.
    let verlet = derived(Verlet::DEFINITION)?.properties();
    let midpoint = derived(Midpoint::DEFINITION)?.properties();
    let held: BTreeSet<&str> = verlet
        .all()
        .into_iter()
        .filter_map(|(name, property)| property.holds.then_some(name))
        .chain(midpoint.equal_matrices.holds.then_some("equal_matrices"))
        .collect();
    assert_eq!(held, Properties::NAMES.iter().copied().collect());
    assert_eq!(
        Properties::NAMES.len(),
        11,
        "a new property belongs into the list of `Verlet` or `Midpoint`"
    );
    Ok(())
}

#[test]
fn attributes_reach_the_type() {
    // `Hash` is derived by the attribute, the rest by the macro.
    let mut set = HashSet::new();
    assert!(set.insert(lower_case) && !set.insert(lower_case));
    assert_eq!(format!("{lower_case:?}"), "lower_case");
}

mod inner {
    use symplectic::Method;

    symplectic::tableau! {
        /// Everywhere in this crate.
        pub(crate) Crate { basis: polynomial(1), nodes: [1] }
        pub(super) Super { basis: polynomial(1), nodes: [1] }
        pub Public { basis: polynomial(1), nodes: [1] }
        Private { basis: polynomial(1), nodes: [1] }
    }

    pub(super) const NAME: &str = <Private as Method>::NAME;
}

mod other {
    pub(super) struct Private;
}

#[test]
fn visibilities_are_those_written() {
    // Were the method `Private` visible here, this name would be ambiguous and not compile.
    use inner::*;
    use other::*;
    let _ = Private;
    assert_eq!(
        [Crate::NAME, Super::NAME, Public::NAME],
        ["Crate", "Super", "Public"]
    );
    assert_eq!(NAME, "Private");
}

#[test]
fn a_macro_may_stand_in_a_function() {
    symplectic::tableau! { Local { basis: polynomial(1), nodes: [1/2] } }
    assert_eq!(Local::A, Midpoint::A);
}

macro_rules! with_function {
    ($name:ident, $function:expr) => {
        symplectic::tableau! { $name { basis: [1, 2 * $function], nodes: [0, 1] } }
    };
}

with_function!(FromAnotherMacro, 1 + t);

#[test]
fn an_expression_from_another_macro_is_one_operand() {
    assert_eq!(
        FromAnotherMacro::DEFINITION,
        "basis: [1, 2*t + 2], nodes: [0, 1]"
    );
}

/// A wrong coefficient or time of any of them would show: the order of the drift on a system without force, and that
/// symplectic methods keep the area.
#[test]
fn methods_of_all_tiers_step() -> Result<(), Error> {
    use symplectic::nalgebra::SVector;
    use symplectic::{State, hamiltonian};

    fn area<M: Method + Copy + ProvedFor<General>>(method: M) -> Result<f64, Error> {
        type Vector = SVector<f64, 1>;
        let step = |q: f64, p: f64| {
            let system = hamiltonian(
                |_, q: &Vector, p: &Vector, v: &mut Vector| v[0] = p[0] * (1.0 + q[0] * q[0]),
                |_, q: &Vector, p: &Vector, f: &mut Vector| f[0] = -q[0] * (1.0 + p[0] * p[0]),
            );
            let start = State::new(0.0, SVector::from([q]), SVector::from([p]));
            let mut integrator = Integrator::new(method, system, start, 0.2)?;
            integrator.step()?;
            let State { q, p, .. } = integrator.state();
            Ok::<_, Error>([q[0], p[0]])
        };
        let d = 1e-5;
        let [east, west] = [step(0.4 + d, 0.3)?, step(0.4 - d, 0.3)?];
        let [north, south] = [step(0.4, 0.3 + d)?, step(0.4, 0.3 - d)?];
        let derivative = |a: [f64; 2], b: [f64; 2], i: usize| (a[i] - b[i]) / (2.0 * d);
        Ok(derivative(east, west, 0) * derivative(north, south, 1)
            - derivative(east, west, 1) * derivative(north, south, 0))
    }

    for area in [
        area(Waves)?,
        area(NotConjugate)?,
        area(HalfWaves)?,
        area(Tang)?,
        area(Simpson)?,
        area(Exchanged)?,
        area(GaussPartner)?,
    ] {
        // Central differences of 1e-5: errors of 1e-10 times third derivatives, and of rounding by 1e-5.
        assert!((area - 1.0).abs() < 1e-8, "{area}");
    }
    assert!((area(Heun)? - 1.0).abs() > 1e-4);
    Ok(())
}

#[test]
fn orders_are_asserted() {
    use symplectic_compiler::assert_order;
    use symplectic_tests::methods::{Gauss8, Lobatto3};

    assert_order!(Lobatto3, general == 4);
    assert_order!(Lobatto3, nystrom >= 3);
    assert_order!(Gauss8, separable == 16);
    assert_order!(Waves, general == 2);
    assert_order!(Saba3, perturbed == (6, 2));
    assert_order!(Saba3, perturbed >= (4, 2));
    let wrong = std::panic::catch_unwind(|| assert_order!(Lobatto3, general == 5));
    let message = wrong.expect_err("the order is 4");
    let message = message.downcast_ref::<String>().expect("a text");
    assert!(
        message.starts_with("Lobatto3: the order for general H is 4, not 5: q[q^4] has the weight 5/24 instead of 1/5"),
        "{message}"
    );
}

symplectic::splitting! {
    /// Laskar & Robutel's with Gauss nodes.
    Saba3 {
        kick: [5/18, 4/9], drift: [1/2 - sqrt(15)/10, sqrt(15)/10], first: drift, symmetric: true,
        require: [order(separable) == 2, order(perturbed) == (6, 2), order(perturbed) >= (4, 2)],
    }
}
