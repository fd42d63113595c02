//! A formula with the values of its parameters: what can be integrated.

use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use symplectic::State;
use symplectic::nalgebra::DVector;
use symplectic::output::unit_of;
use symplectic_compiler::expression::Input;
use symplectic_formula::graph::{Half, Id};
use symplectic_formula::syntax::Length;
use symplectic_formula::{Layout, Parameter, Shape, System, description};
use symplectic_run::method::constraints_of;
use symplectic_tape::{At, Entry, Parameters, Refusal, Tape, Tapes, Values};

use crate::errors;
use crate::formula::Formula;

/// A parameter without values: its name and its dimensions.
type Dimensions = (String, Vec<usize>);

/// A parameter: its name, its dimensions and its numbers.
type Given = (String, Vec<usize>, Vec<f64>);

/// A conserved function: its name, and the tapes of its components.
type Conserved = (String, Vec<Tape>);

/// A formula with values.
#[pyclass(frozen, module = "symplectica._native")]
pub(crate) struct Problem {
    pub(crate) kind: Kind,
    pub(crate) tapes: Arc<Tapes>,
    pub(crate) dimension: usize,
    /// The number of parameters of each trajectory that vary.
    pub(crate) varied: usize,
    pub(crate) start: f64,
    form: symplectic_formula::Form,
    text: String,
    values: Values,
    invariants: Vec<Conserved>,
}

/// What decides the type of a system.
#[derive(Clone, Copy)]
pub(crate) struct Kind {
    pub(crate) is_separable: bool,
    pub(crate) is_forced: bool,
    /// Whether the constraints are holonomic, if there are any.
    pub(crate) holonomic: Option<bool>,
}

#[pymethods]
impl Problem {
    /// A formula in a number of coordinates. `parameters` have their values; each of `varied` has its dimensions only, because its values
    /// differ between trajectories. So has each of `further`, whose values are further coordinates, after the positions and after the momenta.
    #[new]
    fn new(
        py: Python<'_>,
        formula: &Formula,
        dimension: usize,
        parameters: Vec<Given>,
        varied: Vec<Dimensions>,
        further: Vec<Dimensions>,
        start: f64,
    ) -> PyResult<Self> {
        let open = [&varied[..], &further];
        let (values, [varied, further]) = values(formula.system(), dimension, &parameters, open)?;
        let made = py.detach(|| {
            let mut system = formula.system().clone();
            let invariants = invariants(&mut system, formula, &values, start)?;
            let tapes = Tapes::new(&mut system, formula.structure(), &values, start)?;
            Ok((tapes, invariants))
        });
        let (tapes, invariants) =
            made.map_err(|refusal: Refusal| errors::argument(refusal.to_string()))?;
        let system = formula.system();
        Ok(Problem {
            kind: Kind {
                is_separable: formula.is_separable(),
                is_forced: !system.applied.is_empty(),
                holonomic: constraints_of(system),
            },
            tapes: Arc::new(tapes),
            dimension: dimension + further,
            varied,
            start,
            form: formula.form(),
            text: formula.text().to_owned(),
            values,
            invariants,
        })
    }

    /// The numbers of coordinates, and of parameters that vary.
    #[getter]
    fn size(&self) -> (usize, usize) {
        (self.dimension, self.varied)
    }

    #[getter]
    fn energy_is_conserved(&self) -> bool {
        self.tapes.energy_is_conserved()
    }

    /// Names of the conserved functions, with their numbers of components.
    #[getter]
    fn invariants(&self) -> Vec<(String, usize)> {
        let all = self.invariants.iter();
        all.map(|(name, parts)| (name.clone(), parts.len()))
            .collect()
    }

    /// H at states in rows.
    fn energies<'py>(
        &self,
        py: Python<'py>,
        t: PyReadonlyArray1<'py, f64>,
        q: PyReadonlyArray2<'py, f64>,
        p: PyReadonlyArray2<'py, f64>,
        varied: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let states = States::new(self, &t, &q, &p, &varied)?;
        let found = py.detach(|| states.values(self.tapes.energy()));
        Ok(found.into_pyarray(py))
    }

    /// What errors of H are relative to: |H| at a start, or the size of its terms if H there is nothing but rounding.
    fn energy_unit(&self, t: f64, q: Vec<f64>, p: Vec<f64>, varied: Vec<f64>) -> PyResult<f64> {
        self.check_state(&q, &p, &varied)?;
        let parameters = Parameters::from(varied.as_slice());
        let start = State::new(t, DVector::from_vec(q), DVector::from_vec(p));
        let energy = |state: &State<DVector<f64>>| {
            let (q, p) = state.as_slices();
            self.tapes.energy_at(At {
                parameters: &parameters,
                time: state.time,
                q,
                p,
            })
        };
        Ok(unit_of(energy, &start))
    }

    /// The components of a conserved function at states in rows, one after another.
    fn invariant<'py>(
        &self,
        py: Python<'py>,
        number: usize,
        t: PyReadonlyArray1<'py, f64>,
        q: PyReadonlyArray2<'py, f64>,
        p: PyReadonlyArray2<'py, f64>,
        varied: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Vec<Bound<'py, PyArray1<f64>>>> {
        let states = States::new(self, &t, &q, &p, &varied)?;
        let parts = self.invariants.get(number).map(|(_, parts)| &parts[..]);
        let found = py.detach(|| {
            let parts = parts.unwrap_or_default().iter();
            parts.map(|part| states.values(part)).collect::<Vec<_>>()
        });
        Ok(found
            .into_iter()
            .map(|part| part.into_pyarray(py))
            .collect())
    }

    /// An expression at states in rows.
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        text: &str,
        t: PyReadonlyArray1<'py, f64>,
        q: PyReadonlyArray2<'py, f64>,
        p: PyReadonlyArray2<'py, f64>,
        varied: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        // The momenta of states are those of the formula, also with friction.
        let tape = self.tape("expression", text, None)?;
        let states = States::new(self, &t, &q, &p, &varied)?;
        let found = py.detach(|| states.values(&tape));
        Ok(found.into_pyarray(py))
    }

    /// The largest |φ| or |w·q'| at states in rows.
    fn constraint_errors<'py>(
        &self,
        py: Python<'py>,
        t: PyReadonlyArray1<'py, f64>,
        q: PyReadonlyArray2<'py, f64>,
        p: PyReadonlyArray2<'py, f64>,
        varied: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Option<Bound<'py, PyArray1<f64>>>> {
        let Some(constraints) = self.tapes.constraints() else {
            return Ok(None);
        };
        let states = States::new(self, &t, &q, &p, &varied)?;
        let found = py.detach(|| {
            let error = |row: usize| {
                let parameters = states.parameters(row);
                let at = states.at(&parameters, row);
                let velocity = self.tapes.velocity_at(at);
                constraints.error(&parameters, at.q, &velocity)
            };
            (0..states.count).map(error).collect::<Vec<_>>()
        });
        Ok(Some(found.into_pyarray(py)))
    }

    /// The velocity at a state.
    fn velocity(&self, t: f64, q: Vec<f64>, p: Vec<f64>, varied: Vec<f64>) -> PyResult<Vec<f64>> {
        self.check_state(&q, &p, &varied)?;
        let parameters = Parameters::from(varied.as_slice());
        Ok(self.tapes.velocity_at(At {
            parameters: &parameters,
            time: t,
            q: &q,
            p: &p,
        }))
    }

    /// The momentum of a velocity. H must be quadratic in the momenta.
    fn momentum(&self, t: f64, q: Vec<f64>, v: Vec<f64>, varied: Vec<f64>) -> PyResult<Vec<f64>> {
        self.check_state(&q, &v, &varied)?;
        let parameters = Parameters::from(varied.as_slice());
        let Some(p) = self.tapes.momentum_of(&parameters, (t, &q), &v) else {
            return Err(errors::argument(
                "the masses are singular at this position: give momenta",
            ));
        };
        let velocity = |p: &[f64]| {
            self.tapes.velocity_at(At {
                parameters: &parameters,
                time: t,
                q: &q,
                p,
            })
        };
        let largest = |list: &[f64]| {
            list.iter()
                .fold(0.0, |largest: f64, x| largest.max(x.abs()))
        };
        let found = velocity(&p);
        let missing = v.iter().zip(&found).map(|(v, found)| (v - found).abs());
        let scale = largest(&v).max(largest(&velocity(&vec![0.0; q.len()])));
        if !missing.into_iter().all(|missing| missing <= 1e-9 * scale) {
            return Err(errors::argument(
                "H is not quadratic in the momenta, so velocities do not determine them: give the momenta `p`",
            ));
        }
        Ok(p)
    }
}

impl Problem {
    /// The tape of an expression with the names of the formula, for the states of integrators.
    pub(crate) fn expression(&self, key: &str, text: &str) -> PyResult<Tape> {
        self.tape(key, text, Some(self.start))
    }

    /// The tape of an expression. With friction from a time `start`, the momenta are those of integrators.
    fn tape(&self, key: &str, text: &str, start: Option<f64>) -> PyResult<Tape> {
        let input = Input { name: key, text };
        let read = System::read_with(self.form, &self.text, &[], input);
        let (system, parts) = read.map_err(|error| errors::definition(&error))?;
        let &[part] = &parts[..] else {
            return Err(errors::argument(match parts.len() {
                0 => format!("`{text}` has no components: give an expression with a value"),
                count => format!("`{text}` has {count} components: give one of them"),
            }));
        };
        Tape::of_value(&system, &self.values, part, start).map_err(|refusal| {
            let last = self.values.bodies.saturating_sub(1);
            errors::argument(match refusal {
                Refusal::TooLong => format!("`{text}`: {refusal}"),
                Refusal::Outside => {
                    format!("an index in `{text}` is out of range: positions are from 0 to {last}")
                }
            })
        })
    }

    /// The place of a coordinate that is named by an expression: its half and its number.
    pub(crate) fn coordinate(&self, key: &str, text: &str) -> PyResult<(Half, usize)> {
        let tape = self.expression(key, text)?;
        let refused = || errors::argument(format!("`{text}` is no coordinate"));
        let inputs: Vec<_> = tape.inputs().collect();
        let [input] = inputs[..] else {
            return Err(refused());
        };
        match input {
            symplectic_tape::Input::Position(k) => Ok((Half::Q, k)),
            symplectic_tape::Input::Momentum(k) => Ok((Half::P, k)),
            _ => Err(refused()),
        }
    }

    fn check_state(&self, q: &[f64], p: &[f64], varied: &[f64]) -> PyResult<()> {
        let fits =
            (q.len(), p.len(), varied.len()) == (self.dimension, self.dimension, self.varied);
        match fits {
            true => Ok(()),
            false => Err(errors::internal("a state of another dimension")),
        }
    }
}

/// States in rows.
pub(crate) struct States<'a> {
    pub(crate) count: usize,
    dimension: usize,
    t: &'a [f64],
    q: &'a [f64],
    p: &'a [f64],
    varied: &'a [f64],
    width: usize,
}

impl<'a> States<'a> {
    fn new(
        problem: &Problem,
        t: &'a PyReadonlyArray1<'_, f64>,
        q: &'a PyReadonlyArray2<'_, f64>,
        p: &'a PyReadonlyArray2<'_, f64>,
        varied: &'a PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Self> {
        let states = States {
            dimension: problem.dimension,
            t: t.as_slice()?,
            q: q.as_slice()?,
            p: p.as_slice()?,
            varied: varied.as_slice()?,
            count: t.len()?,
            width: problem.varied,
        };
        let numbers = states.count * states.dimension;
        let rows = [states.width, states.count * states.width];
        let fits = states.q.len() == numbers && states.p.len() == numbers;
        match fits && rows.contains(&states.varied.len()) {
            true => Ok(states),
            false => Err(errors::internal("states of another dimension")),
        }
    }

    fn parameters(&self, row: usize) -> Parameters {
        let row = if self.varied.len() == self.width {
            0
        } else {
            row
        };
        Parameters::from(&self.varied[row * self.width..][..self.width])
    }

    fn at<'p>(&'p self, parameters: &'p Parameters, row: usize) -> At<'p, f64> {
        let range = row * self.dimension..(row + 1) * self.dimension;
        At {
            parameters,
            time: self.t[row],
            q: &self.q[range.clone()],
            p: &self.p[range],
        }
    }

    fn values(&self, tape: &Tape) -> Vec<f64> {
        let same = (self.varied.len() == self.width).then(|| self.parameters(0));
        let value = |row: usize| match &same {
            Some(parameters) => tape.value(self.at(parameters, row)),
            None => tape.value(self.at(&self.parameters(row), row)),
        };
        (0..self.count).map(value).collect()
    }
}

/// The conserved functions of a system: those that it declares, and the momenta that were found.
fn invariants(
    system: &mut System,
    formula: &Formula,
    values: &Values,
    start: f64,
) -> Result<Vec<Conserved>, Refusal> {
    let mut all: Vec<(String, Vec<Id>)> = Vec::new();
    for declared in &system.invariants {
        all.push((declared.name.clone(), declared.parts.clone()));
    }
    let structure = formula.structure();
    if system.is_free() && system.without_hamiltonian().is_none() {
        for &k in &structure.cyclic {
            if let Layout::Named([_, momenta]) = &system.layout {
                let name = momenta[k].clone();
                let coordinate = symplectic_formula::graph::Coordinate {
                    half: Half::P,
                    index: symplectic_formula::graph::Index::number(k as i64),
                    component: 0,
                };
                let id = system.graph.coordinate(coordinate);
                all.push((name, vec![id]));
            }
        }
        for (name, momentum) in description::momenta(system, structure) {
            let parts = momentum.parts(system);
            all.push((name.to_owned(), parts));
        }
    }
    let taped = all.into_iter().map(|(name, parts)| {
        let tapes = parts.iter();
        let tapes = tapes.map(|&part| Tape::of_value(system, values, part, Some(start)));
        Ok((name, tapes.collect::<Result<_, _>>()?))
    });
    taped.collect()
}

/// The values of a formula, and the number of values that vary between trajectories and that are further coordinates.
fn values(
    system: &System,
    dimension: usize,
    given: &[Given],
    open: [&[Dimensions]; 2],
) -> PyResult<(Values, [usize; 2])> {
    let components = system.layout.components();
    let bodies = dimension / components;
    let fixed = match system.layout.length() {
        Length::Fixed(n) => Some(n),
        _ => None,
    };
    if dimension == 0 || !dimension.is_multiple_of(components) || fixed.is_some_and(|n| n != bodies)
    {
        let wanted = match (fixed, components) {
            (Some(n), 1) => n.to_string(),
            (Some(n), _) => format!("{n} × {components}"),
            (None, _) => format!("a multiple of {components}"),
        };
        return Err(errors::argument(format!(
            "the position has {dimension} coordinates; the formula needs {wanted}"
        )));
    }
    if bodies < system.least {
        return Err(errors::argument(format!(
            "the position has {bodies} coordinates; the formula needs at least {}",
            system.least
        )));
    }
    let mut values = Values {
        bodies,
        pairs: vec![Vec::new(); system.parameters.len()],
        ..Values::default()
    };
    let known = |name: &String| given.iter().find(|(known, ..)| known == name);
    // Lists of pairs first, because they may determine the lengths of arrays.
    for (place, Parameter { name, shape }) in system.parameters.iter().enumerate() {
        if let Shape::Pairs = shape {
            let pairs = known(name).and_then(|(_, dimensions, numbers)| {
                let is_list = matches!(dimensions[..], [_, 2]);
                is_list.then(|| pairs(numbers, bodies)).flatten()
            });
            values.pairs[place] = pairs.ok_or_else(|| {
                errors::argument(format!(
                    "`{name}`: expected pairs of indices from 0 to {}, such as [[0, 1], [1, 2]]",
                    bodies.saturating_sub(1)
                ))
            })?;
        }
    }
    let kinds: [fn(usize) -> Entry; 2] = [Entry::Varied, Entry::Further];
    let mut counts = [0; 2];
    for Parameter { name, shape } in &system.parameters {
        let lengths: &[Length] = match shape {
            Shape::Pairs => {
                values.parameters.push(Vec::new());
                continue;
            }
            Shape::Number(_) => &[],
            Shape::Array(lengths) => lengths,
        };
        let find = |kind: usize| Some((kind, open[kind].iter().find(|(known, _)| known == name)?));
        let is_open = find(0).or_else(|| find(1));
        let (dimensions, entries): (&[usize], Vec<Entry>) = match (is_open, known(name), shape) {
            (Some((kind, (_, dimensions))), ..) => {
                let size: usize = dimensions.iter().product();
                let first = counts[kind];
                counts[kind] += size;
                (dimensions, (first..counts[kind]).map(kinds[kind]).collect())
            }
            (None, Some((_, dimensions, numbers)), _) => {
                if let Some(wrong) = numbers.iter().find(|number| !number.is_finite()) {
                    return Err(errors::argument(format!(
                        "`{name}` contains {wrong}: parameters must be finite"
                    )));
                }
                let entries = numbers.iter().copied().map(Entry::Number).collect();
                (dimensions, entries)
            }
            (None, None, Shape::Number(Some(default))) => {
                use symplectic_formula::evaluate::Real;
                let number = <f64 as Real>::number(default);
                (&[], vec![Entry::Number(number)])
            }
            (None, None, _) => {
                let what = match lengths.len() {
                    0 => "a number",
                    1 => "a list of numbers",
                    _ => "a list of lists of numbers",
                };
                return Err(errors::argument(format!(
                    "the parameter `{name}` has no value: give {what}, parameters={{\"{name}\": …}}"
                )));
            }
        };
        if dimensions.len() != lengths.len() {
            let shape = |dimensions: usize| match dimensions {
                0 => "one number",
                1 => "a list",
                2 => "a list of lists",
                _ => "an array of more dimensions",
            };
            return Err(errors::argument(format!(
                "`{name}` is {}; the formula needs {} (values that vary between trajectories are for ensembles, with one axis more)",
                shape(dimensions.len()),
                shape(lengths.len())
            )));
        }
        for (length, &found) in lengths.iter().zip(dimensions) {
            match values.length(system, length) {
                Some(expected) if expected != found => {
                    return Err(errors::argument(format!(
                        "`{name}` has {found} entries; it needs {expected}"
                    )));
                }
                Some(_) => {}
                None => {
                    values.lengths.insert(length.clone(), found);
                }
            }
        }
        let width = match dimensions {
            [_, columns] => *columns,
            _ => 1,
        };
        let rows = entries.chunks(width.max(1)).map(<[Entry]>::to_vec);
        values.parameters.push(rows.collect());
    }
    Ok((values, counts))
}

fn pairs(numbers: &[f64], bodies: usize) -> Option<Vec<[usize; 2]>> {
    let index = |number: f64| {
        let is_index = number >= 0.0 && number < bodies as f64 && number.fract() == 0.0;
        is_index.then_some(number as usize)
    };
    let pairs = numbers.chunks_exact(2);
    pairs
        .map(|pair| Some([index(pair[0])?, index(pair[1])?]))
        .collect()
}
