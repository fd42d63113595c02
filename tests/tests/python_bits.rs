//! The ends of compiled programs, which the Python package has to reach to the last bit: `runtime/python/tests/test_bits.py` reads the file
//! that this test compares. `UPDATE_EXPECT=1` writes it.

use std::fmt::Write as _;
use std::path::Path;

use symplectic::nalgebra::{DVector, SMatrix};
use symplectic::system::{Conservative, Frictionless};
use symplectic::{Integrator, Method, ProvedFor, Separable, State, System, Vector};

symplectic::tableau! {
    Gauss1 { base: gauss-1 }
    Gauss2 { base: gauss-2 }
    Gauss3 { base: gauss-3 }
    Gauss4 { base: gauss-4 }
    Gauss6 { base: gauss-6 }
    Gauss8 { base: gauss-8 }
    StoermerVerlet { base: stormer-verlet }
    BlanesMoanS10 { base: blanes-moan-2002-s10 }
    BlanesMoanSrkn14a { base: blanes-moan-2002-srkn14a }
    SofroniouSpaletta10 { base: sofroniou-spaletta-2005-s35odr10 }
    Lobatto2 { base: lobatto-2 }
    Lobatto3 { base: lobatto-3 }
}

/// Declares a system, and its formula as text.
macro_rules! formula {
    ($text:ident: $name:ident $($formula:tt)*) => {
        symplectic::hamiltonian! { $name $($formula)* }
        const $text: &str = stringify!($name $($formula)*);
    };
}

formula! { KEPLER: Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q| }
formula! { HENON_HEILES: HenonHeiles q: [x, y], p: [px, py]; H = (px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3 }
formula! {
    DOUBLE_PENDULUM: DoublePendulum { g: 9.8 }
    q: [a, b], p: [pa, pb];
    let d = a - b;
    H = (pa^2 + 2 pb^2 - 2 pa pb cos(d))/(2 (1 + sin(d)^2)) - g (2 cos(a) + cos(b))
}
formula! {
    PLANETS: Planets { m: [3], G: 2.95912208286e-4 }
    q: [3; 3], p: [3; 3];
    H = sum(i in 0..3: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)
}
formula! { SPRINGS: Springs q: [..], p: [..]; bonds: walls; H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + d^4/4) }
formula! { DRIVEN: Driven { omega: 1.7 } q: [x], p: [px]; H = px^2/2 + exp(-x^2) + x sin(omega t) }
formula! {
    ROD: Rod
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + y
    constraints: { rod = x^2 + y^2 - 1 }
}

/// Where a run begins and how far it goes.
struct Scene<'a, S, V> {
    name: &'a str,
    formula: &'a str,
    parameters: &'a str,
    system: S,
    start: State<V>,
    step: f64,
    end: f64,
}

impl<S: System<V> + Clone, V: Vector<Scalar = f64>> Scene<'_, S, V> {
    /// Writes the row of a method, whose name is that of the catalogue.
    fn row<M: Method + ProvedFor<S::Class>>(&self, rows: &mut Vec<String>, name: &str, method: M)
    where
        S::Class: Frictionless,
    {
        let Scene {
            start, step, end, ..
        } = self;
        let mut run = Integrator::new(method, self.system.clone(), start.clone(), *step)
            .unwrap_or_else(|error| panic!("{}, {name}: {error}", self.name));
        let state = run
            .integrate_to(*end)
            .unwrap_or_else(|error| panic!("{}, {name}: {error}", self.name));
        let (q, p) = state.as_slices();
        let bits: Vec<String> = q
            .iter()
            .chain(p)
            .map(|value| format!("\"{:016x}\"", value.to_bits()))
            .collect();
        let (first_q, first_p) = start.as_slices();
        let mut text = String::new();
        let _ = write!(
            text,
            "{{\"scene\": {:?}, \"method\": {name:?}, \"formula\": {:?}, \"parameters\": {}, \"q\": {first_q:?}, \"p\": {first_p:?}, \
             \"step\": {step:?}, \"end\": {end:?}, \"bits\": [{}]}}",
            self.name,
            self.formula
                .split_whitespace()
                .collect::<Vec<_>>()
                .join(" "),
            self.parameters,
            bits.join(", ")
        );
        rows.push(text);
    }

    fn implicit(&self, rows: &mut Vec<String>)
    where
        S::Class: Conservative + Frictionless,
        Gauss1: ProvedFor<S::Class>,
        Gauss2: ProvedFor<S::Class>,
        Gauss3: ProvedFor<S::Class>,
        Gauss4: ProvedFor<S::Class>,
        Gauss6: ProvedFor<S::Class>,
        Gauss8: ProvedFor<S::Class>,
    {
        self.row(rows, "gauss-1", Gauss1);
        self.row(rows, "gauss-2", Gauss2);
        self.row(rows, "gauss-3", Gauss3);
        self.row(rows, "gauss-4", Gauss4);
        self.row(rows, "gauss-6", Gauss6);
        self.row(rows, "gauss-8", Gauss8);
    }
}

impl<S: System<V, Class = Separable> + Clone, V: Vector<Scalar = f64>> Scene<'_, S, V> {
    fn separable(&self, rows: &mut Vec<String>) {
        self.implicit(rows);
        self.row(rows, "stormer-verlet", StoermerVerlet);
        self.row(rows, "blanes-moan-2002-s10", BlanesMoanS10);
        self.row(rows, "blanes-moan-2002-srkn14a", BlanesMoanSrkn14a);
        self.row(
            rows,
            "sofroniou-spaletta-2005-s35odr10",
            SofroniouSpaletta10,
        );
    }
}

fn rows() -> Vec<String> {
    let mut rows = Vec::new();
    Scene {
        name: "kepler",
        formula: KEPLER,
        parameters: "{}",
        system: Kepler,
        start: State::from_arrays(0.0, [0.4, 0.0], [0.0, 2.0]),
        step: 0.05,
        end: 12.3,
    }
    .separable(&mut rows);
    Scene {
        name: "henon-heiles",
        formula: HENON_HEILES,
        parameters: "{}",
        system: HenonHeiles,
        start: State::from_arrays(0.0, [0.0, 0.1], [0.3, 0.4]),
        step: 0.1,
        end: 20.0,
    }
    .separable(&mut rows);
    Scene {
        name: "planets",
        formula: PLANETS,
        parameters: "{\"m\": [1.0, 0.000954786104043, 0.000285583733151]}",
        system: Planets::new([1.0, 0.000954786104043, 0.000285583733151]),
        start: State::new(
            0.0,
            SMatrix::from_column_slice(&[0.0, 0.0, 0.0, -3.5, -3.8, -1.55, 9.07, -3.04, -1.65]),
            SMatrix::from_column_slice(&[
                0.0, 0.0, 0.0, 5.4e-6, -3.9e-6, -1.8e-6, 4.8e-7, 1.38e-6, 5.5e-7,
            ]),
        ),
        step: 50.0,
        end: 3000.0,
    }
    .separable(&mut rows);
    Scene {
        name: "springs",
        formula: SPRINGS,
        parameters: "{}",
        system: Springs,
        start: State::new(
            0.0,
            DVector::from_fn(9, |k, _| 0.1 * k as f64 - 0.3),
            DVector::from_fn(9, |k, _| 0.2 - 0.03 * (k * k) as f64),
        ),
        step: 0.1,
        end: 10.0,
    }
    .separable(&mut rows);
    Scene {
        name: "driven",
        formula: DRIVEN,
        parameters: "{}",
        system: Driven { omega: 1.7 },
        start: State::from_arrays(0.0, [0.3], [0.1]),
        step: 0.05,
        end: 10.0,
    }
    .separable(&mut rows);
    Scene {
        name: "double-pendulum",
        formula: DOUBLE_PENDULUM,
        parameters: "{}",
        system: DoublePendulum { g: 9.8 },
        start: State::from_arrays(0.0, [1.2, 0.7], [0.0, 0.3]),
        step: 0.02,
        end: 3.0,
    }
    .implicit(&mut rows);
    let rod = Scene {
        name: "rod",
        formula: ROD,
        parameters: "{}",
        system: Rod,
        start: State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.5]),
        step: 0.02,
        end: 3.0,
    };
    rod.row(&mut rows, "lobatto-2", Lobatto2);
    rod.row(&mut rows, "lobatto-3", Lobatto3);
    rows
}

#[test]
fn the_file_for_python_has_the_bits_of_compiled_programs() -> std::io::Result<()> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime/python/tests/data/bits.json");
    let found = format!("[\n{}\n]\n", rows().join(",\n"));
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&path, &found)?;
    }
    assert_eq!(std::fs::read_to_string(&path)?, found);
    Ok(())
}
