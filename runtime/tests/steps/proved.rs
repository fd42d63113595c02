//! Methods on systems for which they are not proved: refused, or taken on a word.

use crate::common::methods::{ForestRuth, Gauss2, McLachlanAtela};
use symplectic::nalgebra::Vector1;
use symplectic::{
    Error, Integrator, Method, ProvedFor, Separable, State, System, acceleration, hamiltonian,
    separable,
};

type V = Vector1<f64>;

fn start() -> State<V> {
    State::from_arrays(0.0, [0.25], [0.0])
}

/// The energy at the start and after 1000 steps.
fn energies<M, S>(method: M, system: S, step_size: f64) -> Result<[f64; 2], Error>
where
    M: Method + ProvedFor<Separable>,
    S: System<V, Class = Separable>,
{
    let mut integrator = Integrator::new(method, system, start(), step_size)?;
    let before = integrator.energy().expect("an energy");
    integrator.take_steps(1000)?;
    Ok([before, integrator.energy().expect("an energy")])
}

/// `H = √(1 + p²) + q²/2`: separable, with a kinetic energy that is not quadratic.
fn relativistic() -> impl System<V, Class = Separable> {
    separable::<V, _, _>(
        |_, p, v| v[0] = p[0] / (1.0 + p[0] * p[0]).sqrt(),
        |_, q, f| f[0] = -q[0],
    )
    .with_energy(|_, q, p| (1.0 + p[0] * p[0]).sqrt() + q[0] * q[0] / 2.0)
}

#[test]
fn orders_are_those_of_the_catalogue() {
    let orders = |orders: symplectic::Orders| (orders.general, orders.separable, orders.nystrom);
    assert_eq!(orders(ForestRuth::ORDERS), (1, 4, 4));
    assert_eq!(orders(McLachlanAtela::ORDERS), (1, 3, 4));
    assert_eq!(orders(Gauss2::ORDERS), (4, 4, 4));
}

#[test]
fn a_nystrom_method_is_refused_where_the_velocity_is_not_linear() -> Result<(), Error> {
    let error = Integrator::new(McLachlanAtela, relativistic(), start(), 0.1);
    let error = error.expect_err("not quadratic");
    let Error::NotQuadraticKinetic {
        method,
        order,
        lower_order,
        component,
        velocity,
        linear,
    } = error
    else {
        panic!("{error:?}");
    };
    assert_eq!((method, order, lower_order), ("McLachlanAtela", 4, 3));
    assert_eq!(component, 0);
    assert!((velocity - linear).abs() > 0.1, "{velocity} {linear}");
    let said = error_text(relativistic());
    assert!(
        said.contains("order 4") && said.contains(".accept_lower_order()"),
        "{said}"
    );
    // With a word it is taken, and methods of the class are.
    energies(McLachlanAtela.accept_lower_order(), relativistic(), 0.05)?;
    energies(ForestRuth, relativistic(), 0.05)?;
    Ok(())
}

fn error_text(system: impl System<V, Class = Separable>) -> String {
    let refused = Integrator::plain(McLachlanAtela, system, start(), 0.1);
    refused.expect_err("not quadratic").to_string()
}

#[test]
fn a_nystrom_method_takes_masses_of_any_kind() -> Result<(), Error> {
    // Masses that are in no constant, and unit masses by their type.
    let pendulum = |mass: f64| {
        separable::<V, _, _>(
            move |_, p, v| v[0] = p[0] / mass,
            |_, q, f| f[0] = -q[0].sin(),
        )
        .with_energy(move |_, q, p| p[0] * p[0] / (2.0 * mass) - q[0].cos())
    };
    for mass in [1e-12, 0.3, 7.0, 1e12] {
        let [before, after] = energies(McLachlanAtela, pendulum(mass), 0.05 * mass.sqrt())?;
        assert!((after - before).abs() < 1e-8, "{mass}: {before} {after}");
    }
    let unit = acceleration::<V, _>(|_, q, a| a[0] = -q[0].sin());
    Integrator::new(McLachlanAtela, unit, start(), 0.1)?.take_steps(10)?;
    // A mass that changes with time is none of H = pᵀM⁻¹p/2 + U(q).
    let rocket = separable::<V, _, _>(|t, p, v| v[0] = p[0] / (2.0 - t), |_, q, f| f[0] = -q[0]);
    let refused = Integrator::new(McLachlanAtela, rocket, start(), 0.1);
    assert!(matches!(
        refused.map(|_| ()),
        Err(Error::NotQuadraticKinetic { component: 0, .. })
    ));
    Ok(())
}

/// The case of the report: a splitting on `H = p²(1 + q²)/2 + q²/2`, which compiles with the word only.
#[test]
fn a_splitting_steps_a_general_system_if_lower_order_is_accepted() -> Result<(), Error> {
    let system = || {
        hamiltonian::<V, _, _>(
            |_, q, p, v| v[0] = p[0] * (1.0 + q[0] * q[0]),
            |_, q, p, f| f[0] = -q[0] - q[0] * p[0] * p[0],
        )
        .with_energy(|_, q, p| (p[0] * p[0] * (1.0 + q[0] * q[0]) + q[0] * q[0]) / 2.0)
    };
    let start = || State::from_arrays(0.0, [1.0], [0.5]);
    let mut gauss = Integrator::new(Gauss2, system(), start(), 0.05)?;
    gauss.integrate_to(100.0)?;
    assert!((gauss.energy().expect("an energy") - 0.75).abs() < 1e-6);
    let mut splitting = Integrator::new(ForestRuth.accept_lower_order(), system(), start(), 0.05)?;
    splitting.integrate_to(100.0)?;
    // It is not symplectic there, which is why it takes the word.
    assert!(splitting.energy().expect("an energy") < 0.1);
    Ok(())
}

#[test]
fn accept_lower_order_keeps_the_bits() -> Result<(), Error> {
    let oscillator = || acceleration::<V, _>(|_, q, a| a[0] = -q[0]);
    let mut plain = Integrator::new(ForestRuth, oscillator(), start(), 0.1)?;
    let mut word = Integrator::new(ForestRuth.accept_lower_order(), oscillator(), start(), 0.1)?;
    assert_eq!(plain.take_steps(100)?, word.take_steps(100)?);
    assert_eq!(
        <symplectic::proved::LowerOrder<ForestRuth> as Method>::NAME,
        "ForestRuth"
    );
    Ok(())
}
