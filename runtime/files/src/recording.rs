//! A table of the states of a run.

use std::io::{self, Error, ErrorKind, Write};
use std::path::Path;

use super::replace_file;
#[cfg(feature = "npz")]
use crate::npz::Npz;
use symplectic_core::system::Named;
use symplectic_core::{State, Vector};

/// The states of one run with the names of their components, to be written as CSV or, with the feature `npz`, for NumPy.
/// [`record_to`](super::record_to) does in one line what this example does:
///
/// ```
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
/// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
/// use symplectic::files::Recording;
/// use symplectic::{Integrator, State};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut run = Integrator::new(Gauss2, Pendulum, State::from_arrays(0.0, [1.0], [0.0]), 0.1)?;
/// let mut table = Recording::of(run.system(), run.state())?;
/// run.integrate_with(10.0, |state| table.record(state))?;
/// # let path = std::env::temp_dir().join("symplectic-pendulum.csv");
/// table.save(&path)?;
/// assert!(std::fs::read_to_string(&path)?.starts_with("time,a,pa\n0.0,1.0,0.0\n0.1,"));
/// # std::fs::remove_file(path)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Recording {
    /// Of the columns after the time.
    names: Vec<String>,
    times: Vec<f64>,
    values: Vec<f64>,
    /// Components of the first state that had another number.
    other: Option<usize>,
}

impl Recording {
    /// A table that begins with this state, with the names of a system: those of its formula, such as `x` or `q[0]`.
    ///
    /// # Errors
    ///
    /// As for [`from_start`](Self::from_start).
    pub fn of<S: Named, V: Vector<Scalar = f64>>(system: &S, start: &State<V>) -> io::Result<Self> {
        let mut table = Self::empty(system, start)?;
        table.record(start);
        Ok(table)
    }

    /// [`of`](Self::of) without the state.
    pub(super) fn empty<S: Named, V: Vector>(_system: &S, state: &State<V>) -> io::Result<Self> {
        let names = S::NAMES
            .into_iter()
            .zip(["q", "p"])
            .zip([&state.q, &state.p]);
        let names = names.flat_map(|((names, letter), vector)| {
            let number = |k| match S::COMPONENTS {
                Some(components) => format!("{letter}[{}][{}]", k / components, k % components),
                None => format!("{letter}[{k}]"),
            };
            match names {
                [] => (0..vector.dimension()).map(number).collect(),
                names => names.iter().map(ToString::to_string).collect::<Vec<_>>(),
            }
        });
        Self::with_names(names.collect(), state)
    }

    /// A table that begins with this state, with a name for each component of the position and then of the momentum.
    ///
    /// # Errors
    ///
    /// [`ErrorKind::InvalidInput`] if the number of names is not that of the components, a name occurs twice or is `time`, is empty, or
    /// contains a comma, a quotation mark or a control character.
    pub fn from_start<V: Vector<Scalar = f64>, N: Into<String>>(
        start: &State<V>,
        names: impl IntoIterator<Item = N>,
    ) -> io::Result<Self> {
        let mut table = Self::with_names(names.into_iter().map(Into::into).collect(), start)?;
        table.record(start);
        Ok(table)
    }

    /// A table without states.
    fn with_names<V: Vector>(names: Vec<String>, state: &State<V>) -> io::Result<Self> {
        let components = state.q.dimension() + state.p.dimension();
        if names.len() != components {
            return Err(invalid(format!(
                "the state has {components} components, positions and momenta; there are {} names",
                names.len()
            )));
        }
        let odd = |c: char| c == ',' || c == '"' || c.is_control();
        for (k, name) in names.iter().enumerate() {
            if name.is_empty() || name.contains(odd) || name == "time" || names[..k].contains(name)
            {
                return Err(invalid(format!(
                    "the name {name:?} of component {k}: take different names, not `time`, without commas and quotation marks"
                )));
            }
        }
        Ok(Self {
            names,
            times: Vec::new(),
            values: Vec::new(),
            other: None,
        })
    }

    /// Appends a state. A state with another number of components is left out, and the table can then not be written.
    pub fn record<V: Vector<Scalar = f64>>(&mut self, state: &State<V>) {
        let (q, p) = (state.q.as_slice(), state.p.as_slice());
        let components = q.len() + p.len();
        if components == self.names.len() {
            self.times.push(state.time);
            self.values.extend(q.iter().chain(p));
        } else {
            self.other = self.other.or(Some(components));
        }
    }

    /// The number of states.
    pub const fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether there are no states.
    pub const fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Writes a table with a line of names and a line for each state: the time, positions, momenta. Read again, the numbers are the same.
    ///
    /// # Errors
    ///
    /// I/O errors, and [`ErrorKind::InvalidInput`] if a state had another number of components.
    pub fn write_csv(&self, mut out: impl Write) -> io::Result<()> {
        self.check()?;
        write!(out, "time")?;
        for name in &self.names {
            write!(out, ",{name}")?;
        }
        writeln!(out)?;
        for (row, time) in self.times.iter().enumerate() {
            write!(out, "{time:?}")?;
            let width = self.names.len();
            for value in &self.values[row * width..][..width] {
                write!(out, ",{value:?}")?;
            }
            writeln!(out)?;
        }
        out.flush()
    }

    /// Writes a `.npz` file with an array for `time` and for each name.
    ///
    /// # Errors
    ///
    /// As for [`write_csv`](Self::write_csv) and [`Npz::doubles`].
    #[cfg(feature = "npz")]
    pub fn write_npz(&self, out: impl Write) -> io::Result<()> {
        self.check()?;
        let (count, width) = (self.len(), self.names.len());
        let mut file = Npz::new(out);
        file.doubles("time", &[count], &self.times)?;
        for (k, name) in self.names.iter().enumerate() {
            let column = self.values.iter().skip(k).step_by(width);
            file.doubles(name, &[count], &column.copied().collect::<Vec<f64>>())?;
        }
        file.finish().map(|_| ())
    }

    /// [Replaces](replace_file) a file by this table, in the format of its name: `.csv`, or `.npz` with the feature `npz`.
    ///
    /// # Errors
    ///
    /// Those of [`write_csv`](Self::write_csv); [`ErrorKind::InvalidInput`] for another name.
    pub fn save(&self, path: impl AsRef<Path>) -> io::Result<()> {
        let path = path.as_ref();
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("csv") => replace_file(path, |out| self.write_csv(out)),
            #[cfg(feature = "npz")]
            Some("npz") => replace_file(path, |out| self.write_npz(out)),
            _ => Err(invalid(format!(
                "{}: the name must end in `.csv`, or in `.npz` with the feature `npz`",
                path.display()
            ))),
        }
    }

    fn check(&self) -> io::Result<()> {
        match self.other {
            None => Ok(()),
            Some(other) => Err(invalid(format!(
                "a recorded state has {other} components, the first one {}",
                self.names.len()
            ))),
        }
    }
}

fn invalid(what: impl ToString) -> Error {
    Error::new(ErrorKind::InvalidInput, what.to_string())
}

#[cfg(test)]
mod tests {
    use nalgebra::{DVector, Vector2};

    use super::*;

    fn state(time: f64) -> State<Vector2<f64>> {
        State::from_arrays(time, [0.1, f64::NAN], [1e300, -0.0])
    }

    #[test]
    fn a_table_has_the_names_and_all_digits() {
        let mut table =
            Recording::from_start(&state(0.0), ["x", "y", "px", "py"]).expect("a table");
        table.record(&state(1.0 / 3.0));
        let mut out = Vec::new();
        table.write_csv(&mut out).expect("a table");
        let expected =
            "time,x,y,px,py\n0.0,0.1,NaN,1e300,-0.0\n0.3333333333333333,0.1,NaN,1e300,-0.0\n";
        assert_eq!(out, expected.as_bytes());
        let failure = table.save("table.txt").expect_err("an unknown format");
        assert_eq!(failure.kind(), ErrorKind::InvalidInput);
    }

    #[test]
    fn names_that_do_not_fit_are_refused() {
        let two: [&[&str]; 5] = [
            &["x", "y", "px"],
            &["x", "y", "px", "x"],
            &["x", "y", "px", "time"],
            &["x", "y", "px", "a,b"],
            &["x", "y", "px", ""],
        ];
        for names in two {
            let failure = Recording::from_start(&state(0.0), names.iter().copied());
            assert_eq!(
                failure.expect_err("refused").kind(),
                ErrorKind::InvalidInput
            );
        }
    }

    #[test]
    fn a_state_of_another_dimension_is_refused_when_the_table_is_written() {
        let mut table =
            Recording::from_start(&state(0.0), ["x", "y", "px", "py"]).expect("a table");
        let other: State<DVector<f64>> =
            State::from_slices(1.0, &[1.0; 3], &[1.0; 3]).expect("a state");
        table.record(&other);
        assert_eq!(table.len(), 1);
        let failure = table.write_csv(Vec::new()).expect_err("another dimension");
        assert_eq!(
            failure.to_string(),
            "a recorded state has 6 components, the first one 4"
        );
    }

    #[cfg(feature = "npz")]
    #[test]
    fn an_npz_file_has_an_array_for_each_name() {
        use crate::npz::{NpzArray, NpzValues};

        let mut table =
            Recording::from_start(&state(0.0), ["x", "y", "px", "py"]).expect("a table");
        table.record(&state(0.5));
        let mut out = Vec::new();
        table.write_npz(&mut out).expect("a file");
        let arrays = NpzArray::read_all(&out).expect("arrays");
        let names: Vec<&str> = arrays.iter().map(|array| array.name.as_str()).collect();
        assert_eq!(names, ["time", "x", "y", "px", "py"]);
        assert_eq!(arrays[0].values, NpzValues::Doubles([0.0, 0.5].into()));
        assert_eq!(arrays[3].values, NpzValues::Doubles([1e300; 2].into()));
    }
}
