//! Trajectories beside those of the macros.

use std::fs;
use std::ops::ControlFlow;

use ::symplectic::ensemble::Ensemble;
use ::symplectic::nalgebra::DVector;
use ::symplectic::{Compensated, Method, ProvedFor, State, Summation, System, Vector};

use crate::{PENDULUM, columns, csv, folder};

::symplectic::tableau! {
    S10 { base: blanes-moan-2002-s10 }
    Gauss2 { basis: polynomial(2), nodes: gauss(2) }
}

::symplectic::hamiltonian! { Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a) }
::symplectic::hamiltonian! { Product q: [x], p: [px]; H = (x^2 + 1)(px^2 + 1)/2 }
::symplectic::hamiltonian! {
    Planets { m: [..], G: 1 }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)
}

/// The ends of an ensemble of an emitted method.
pub(super) fn ends<M, S, V>(
    method: M,
    system: S,
    starts: Vec<State<V>>,
    size: f64,
    end: f64,
) -> Vec<Vec<f64>>
where
    M: Method + ProvedFor<S::Class>,
    S: System<V> + Clone + Send + Sync,
    V: Vector<Scalar = f64> + Send + Sync,
{
    ends_with::<M, S, V, Compensated>(method, system, starts, size, end)
}

/// [`ends`] with these sums.
pub(super) fn ends_with<M, S, V, R>(
    method: M,
    system: S,
    starts: Vec<State<V>>,
    size: f64,
    end: f64,
) -> Vec<Vec<f64>>
where
    M: Method + ProvedFor<S::Class>,
    S: System<V> + Clone + Send + Sync,
    V: Vector<Scalar = f64> + Send + Sync,
    R: Summation,
{
    let mut ends = Vec::new();
    Ensemble::<M, S, V, R>::with_summation(method, [(system, starts)], size)
        .expect("starts")
        .integrate_to(end, |row| {
            assert_eq!(row.outcome, Ok(()));
            let (q, p) = row.state.as_slices();
            ends.push([q, p].concat());
            ControlFlow::Continue(())
        });
    ends
}

pub(super) fn assert_near(found: &[Vec<f64>], expected: &[Vec<f64>], bound: f64) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!(found.len(), expected.len());
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < bound, "{found:?} {expected:?}");
        }
    }
}

#[test]
fn a_pendulum_ends_where_the_emitted_method_does() {
    let folder = folder("pendulum");
    let found = columns(&csv(&folder, PENDULUM), &["a", "pa"]);
    let start = |k: i32| State::from_arrays(0.0, [-1.0 + 0.2 * f64::from(k)], [0.5]);
    let starts = || (0..11).map(start).collect::<Vec<_>>();
    let expected = ends(S10, Pendulum { g: 4.0 }, starts(), 0.05, 10.0);
    // 200 steps with a rounding error each, amplified by the flow.
    assert_near(&found, &expected, 1e-12);
    // With another g they are elsewhere.
    let other = ends(S10, Pendulum { g: 9.81 }, starts(), 0.05, 10.0);
    assert!((other[0][0] - found[0][0]).abs() > 0.1);

    let errors = columns(&csv(&folder, PENDULUM), &["energy_error", "steps"]);
    assert!(
        errors
            .iter()
            .all(|row| row[0].abs() < 1e-7 && row[1] == 200.0),
        "{errors:?}"
    );
}

/// On a separatrix H is 0 except for rounding; its terms are 1. The state at the end has |H| of about 10⁻¹⁰, by the error of the method.
#[test]
fn energy_errors_on_a_separatrix_are_relative_to_the_terms() {
    let setup = r#"
system = "Well q: [x], p: [px]; H = px^2/2 - x^2/2 + x^4/4"
method = "gauss-3"
step_size = 0.1
end = 100
starts = { x = 1.4142135623730951, px = 0 }
output = { file = "out.csv" }
"#;
    let errors = columns(&csv(&folder("separatrix"), setup), &["energy_error"]);
    assert!(errors[0][0].abs() < 1e-8, "{errors:?}");
}

#[test]
fn kepler_orbits_close_after_a_period() {
    let folder = folder("kepler");
    // Of semi-major axis 1, from the pericentre: the eccentricity is 1 − q.
    let setup = r#"
        system = "Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q|"
        method = "blanes-moan-2002-s10"
        step_size = 0.01
        end = 6.283185307179586
        starts = "starts.csv"
        output.file = "out.csv"
    "#;
    let mut starts = "p[1], q[1], q[0], p[0]\n".to_owned();
    let mut expected = Vec::new();
    for eccentricity in [0.0_f64, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6] {
        let (q, p) = (
            1.0 - eccentricity,
            ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt(),
        );
        starts.push_str(&format!("{p},0,{q},0\n"));
        expected.push(vec![q, 0.0, 0.0, p]);
    }
    fs::write(folder.join("starts.csv"), starts).expect("a file");
    let found = columns(&csv(&folder, setup), &["q[0]", "q[1]", "p[0]", "p[1]"]);
    assert_near(&found, &expected, 1e-8);
}

#[test]
fn three_bodies_end_where_the_emitted_method_does() {
    let setup = r#"
        system = """
        Planets { m: [..], G: 1 }
        q: [..; 2], p: [..; 2];
        H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)
        """
        method = "blanes-moan-2002-s10"
        step_size = 0.01
        end = 5.0
        parameters.m = [1, 1e-3, 2e-3]
        [starts]
        q = [[0, 0], [1, 0], [{ from = -2, to = -1.5, count = 3 }, 0]]
        p = [[0, 0], [0, 1e-3], [0, -1.4e-3]]
        [output]
        file = "out.csv"
    "#;
    let names: Vec<String> = ["q", "p"]
        .iter()
        .flat_map(|half| (0..3).flat_map(move |i| (0..2).map(move |k| format!("{half}[{i}][{k}]"))))
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let found = columns(&csv(&folder("planets"), setup), &names);
    let start = |x: f64| {
        let q = [0.0, 0.0, 1.0, 0.0, x, 0.0];
        let p = [0.0, 0.0, 0.0, 1e-3, 0.0, -1.4e-3];
        let vector = |numbers: &[f64]| DVector::from_column_slice(numbers);
        State::new(0.0, vector(&q), vector(&p))
    };
    let system = Planets {
        m: vec![1.0, 1e-3, 2e-3],
        G: 1.0,
    };
    let starts = vec![start(-2.0), start(-1.75), start(-1.5)];
    assert_near(&found, &ends(S10, system, starts, 0.01, 5.0), 1e-11);
}

#[test]
fn a_nonseparable_system_ends_where_the_emitted_method_does() {
    let setup = r#"
        system = "Product q: [x], p: [px]; H = (x^2 + 1)(px^2 + 1)/2"
        method = { basis = "polynomial(2)", nodes = "gauss(2)" }
        sums = "plain"
        step_size = -0.05
        end = -5
        [[starts]]
        x = 0.1
        px = 0.3
        [[starts]]
        x = 0.2
        px = 0.4
        [output]
        file = "out.csv"
    "#;
    let found = columns(&csv(&folder("product"), setup), &["x", "px"]);
    let starts = [[0.1, 0.3], [0.2, 0.4]].map(|[x, p]| State::from_arrays(0.0, [x], [p]));
    // Iterations stop within some units of rounding.
    assert_near(
        &found,
        &ends(Gauss2, Product, starts.to_vec(), -0.05, -5.0),
        1e-11,
    );
}

/// H = Σ p²/2 + (Σ_i Σ_j A_ij q_i q_j)/2: a free sum in a sum. From q = (1, 0) with A = [[2, -1], [-1, 2]] the frequencies are 1 and √3.
#[test]
fn a_nested_sum_has_its_closed_form() {
    let folder = folder("sums");
    let setup = |end: f64| {
        format!(
            r#"
    system = "Coupled {{ A: [.., ..] }} q: [..], p: [..]; H = sum(i: p[i]^2/2) + sum(i: sum(j: A[i, j] q[i] q[j]))/2"
    method = "blanes-moan-2002-s10"
    step_size = 0.05
    end = {end}
    parameters.A = [[2, -1], [-1, 2]]
    starts = {{ q = [1, 0], p = [0, 0] }}
    output.file = "out.csv"
"#
        )
    };
    let found = columns(&csv(&folder, &setup(7.0)), &["q[0]", "q[1]"]);
    let (slow, fast) = (7.0_f64.cos() / 2.0, (7.0 * 3.0_f64.sqrt()).cos() / 2.0);
    assert_near(&found, &[vec![slow + fast, slow - fast]], 1e-8);
}

#[test]
fn a_method_of_lower_order_runs_if_accepted() {
    let setup = PENDULUM
        .replace("pa^2/2", "pa^4/4")
        .replace(
            "blanes-moan-2002-s10",
            "mclachlan-atela-1992-order-4-optimal",
        )
        .replace("end = 10.0", "end = 1.0\n    accept_lower_order = true");
    assert_eq!(csv(&folder("lower"), &setup).lines().count(), 12);
}

/// Spheres that touch, at rest where all functions with kinks are zero: beside a system of the macro.
#[test]
fn kinks_are_those_of_the_macro() {
    ::symplectic::hamiltonian! {
        Contact q: [x, y], p: [px, py];
        H = (px^2 + py^2)/2 + max(x - y, 0)^(5/2) + max(-x, 0)^2.2 + |y - 1|^3 + |[x, y]|^2.5
    }
    let setup = r#"
        system = "Contact q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + max(x - y, 0)^(5/2) + max(-x, 0)^2.2 + |y - 1|^3 + |[x, y]|^2.5"
        method = "gauss-2"
        step_size = 0.1
        end = 1.0
        starts = { x = 0, y = 0, px = { from = 0, to = 0.5, count = 3 }, py = 0 }
        output.file = "out.csv"
    "#;
    let found = columns(&csv(&folder("contact"), setup), &["x", "y", "px", "py"]);
    let starts = [0.0, 0.25, 0.5].map(|px| State::from_arrays(0.0, [0.0; 2], [px, 0.0]));
    // Iterations stop within some units of rounding.
    assert_near(
        &found,
        &ends(Gauss2, Contact, starts.to_vec(), 0.1, 1.0),
        1e-13,
    );
}

/// Every function, in steps of size 0.01: beside a system of the macro.
#[test]
fn every_function_is_that_of_the_macro() {
    ::symplectic::hamiltonian! {
        Functions { k: 2 } q: [x, y], p: [px, py];
        H = (px^2 + py^2)/2 + exp(-x^2) + ln(2 + y) + tan(x/3) + asin(y/3) + acos(x/4) + atan(k x) + sinh(y/2)
            + cosh(x) + tanh(y) + atan2(1 + x, 2 + y) + sqrt(1 + x^2) + |x - 5|^3/7 + (2 + x)^(1/3) + sin(x y) cos(t) + pi x/(1 + y^2)^2
    }
    let formula = "Functions { k: 2 } q: [x, y], p: [px, py];
        H = (px^2 + py^2)/2 + exp(-x^2) + ln(2 + y) + tan(x/3) + asin(y/3) + acos(x/4) + atan(k x) + sinh(y/2)
            + cosh(x) + tanh(y) + atan2(1 + x, 2 + y) + sqrt(1 + x^2) + |x - 5|^3/7 + (2 + x)^(1/3) + sin(x y) cos(t) + pi x/(1 + y^2)^2";
    let setup = format!(
        "system = '''{formula}'''\nmethod = 'blanes-moan-2002-s10'\nstep_size = 0.01\nstart_time = 0.5\nend = 1.0
        starts = {{ x = {{ from = 0, to = 0.5, count = 9 }}, y = 0.1, px = 0, py = 0.2 }}\noutput.file = 'out.csv'"
    );
    let found = columns(&csv(&folder("functions"), &setup), &["x", "y", "px", "py"]);
    let starts = (0..9).map(|k| State::from_arrays(0.5, [0.0625 * f64::from(k), 0.1], [0.0, 0.2]));
    let expected = ends(S10, Functions { k: 2.0 }, starts.collect(), 0.01, 1.0);
    assert_near(&found, &expected, 1e-13);
}
