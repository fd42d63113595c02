//! A table of a run in Rust has the names of `symplectic run`.

use std::fs;
use symplectic::State;

use symplectic::ensemble::NpzArray;
use symplectic::files::Recording;
use symplectic::nalgebra::DVector;
use symplectic::system::Named;

use crate::{csv, folder};

/// The columns of recordings with this number of coordinates: those of the CSV file, which are those of the `.npz` file.
fn names(system: &impl Named, dimension: usize) -> Vec<String> {
    let zeros = DVector::zeros(dimension);
    let start = State::new(0.0, zeros.clone(), zeros);
    let table = Recording::of(system, &start).expect("a table");
    let (mut text, mut file) = (Vec::new(), Vec::new());
    table.write_csv(&mut text).expect("written");
    table.write_npz(&mut file).expect("written");
    let text = String::from_utf8(text).expect("text");
    let header = text.lines().next().expect("a header").split(',');
    let header: Vec<String> = header.map(str::to_owned).collect();
    let arrays = NpzArray::read_all(&file).expect("arrays");
    let fields: Vec<String> = arrays.into_iter().map(|array| array.name).collect();
    assert_eq!(header, fields);
    header
}

/// Runs a formula from a file of starts with these names, and compares with the columns of the result.
fn compare(formula: &str, names: &[String]) {
    let folder = folder("names");
    let values: Vec<String> = (1..names.len()).map(|k| format!("0.{k}")).collect();
    let starts = format!("{}\n{}\n", names[1..].join(","), values.join(","));
    fs::write(folder.join("starts.csv"), starts).expect("a file");
    let setup = format!(
        "system = \"{formula}\"\nmethod = \"gauss-2\"\nstep_size = 0.1\nend = 0.1\nstarts = \"starts.csv\"\noutput.file = \"out.csv\""
    );
    let text = csv(&folder, &setup);
    let header = text.lines().next().expect("a header").split(',');
    let columns = header.skip_while(|name| *name != "time");
    let columns: Vec<&str> = columns.take_while(|name| *name != "energy_error").collect();
    assert_eq!(columns, names, "{formula}");
}

/// Each definition as a type and as text.
macro_rules! compare {
    ($($kind:ident $name:ident $dimension:literal { $($definition:tt)* })*) => {
        $(
            symplectic::$kind! { $name $($definition)* }
            let formula = concat!(stringify!($name), " ", stringify!($($definition)*));
            compare(&formula.replace('\n', " "), &names(&$name, $dimension));
        )*
    };
}

#[test]
fn recordings_of_formulas_have_the_columns_of_runs() {
    compare! {
        hamiltonian Scalars 2 { q: [x, angle], p: [px, L]; H = (px^2 + L^2)/2 + x^2/2 - cos(angle) }
        hamiltonian Single 1 { q: [q], p: [p]; H = (p^2 + q^2)/2 }
        hamiltonian Vector 2 { q: [2], p: [2]; H = |p|^2/2 + |q|^2/2 }
        hamiltonian Chain 3 { q: [..], p: [..]; bonds: walls; H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + d^4/4) }
        hamiltonian Bodies 4 { q: [..; 2], p: [..; 2]; H = sum(i: |p[i]|^2/2 + |q[i]|^2/2) }
        hamiltonian Fixed 6 { q: [2; 3], p: [2; 3]; H = sum(i: |p[i]|^2/2) + |q[0] - q[1]|^2 }
        hamiltonian Thin 2 { q: [2; 1], p: [2; 1]; H = sum(i: |p[i]|^2/2 + |q[i]|^2/2) }
        lagrangian Swing 2 { q: [a, b], v: [va, vb]; L = va^2/2 + vb^2/2 - a^2 b^2 - a^2 - b^2 }
        lagrangian Taken 1 { q: [x], v: [px]; L = px^2/2 - x^2/2 }
        lagrangian Numbered 2 { q: [2], v: [2]; L = |v|^2/2 - |q|^2/2 }
    }
    assert_eq!(names(&Taken, 1), ["time", "x", "p_x"]);
    assert_eq!(
        names(&Bodies, 2),
        ["time", "q[0][0]", "q[0][1]", "p[0][0]", "p[0][1]"]
    );
}
