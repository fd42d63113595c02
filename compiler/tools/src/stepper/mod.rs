//! Programs that take steps of a method: a self-contained file for each of four languages.
//!
//! A method that consists of drifts and kicks becomes straight-line code. Any other method solves for its stages, by fixed-point
//! iteration until stagnation, with coefficients that are [symplectic as rounded](symplectic_compiler::emit). Both carry the state as a sum of two
//! numbers (compensated summation). The parts common to all methods are a template of the language; [`plan`] has the others, and
//! [`system`] the velocity, force and energy of a formula.

mod languages;
mod plan;
mod system;
mod template;

use self::languages::Notation;
use self::plan::{Coupled, Plan};
use self::template::fill;
use crate::language::table::{Entry, Flow, Table};
use symplectic_compiler::Error;
use symplectic_compiler::Tableau;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_formula::{Structure, System};

/// A language of steppers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stepper {
    /// C99; the dimension is an argument, and the caller provides the memory.
    C,
    /// Rust without the standard library; the dimension is a generic constant of the type.
    Rust,
    /// Julia, with vectors.
    Julia,
    /// Python, with lists.
    Python,
}

/// The class of Hamiltonians of a stepper.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SteppedClass {
    /// Every `H(t, q, p)`.
    General,
    /// `H = T(t, p) + U(t, q)`, for methods that consist of drifts and kicks for this class.
    Separable,
}

/// Significant digits of decimals in comments.
const DIGITS: usize = 17;

/// The largest number of sweeps over coupled stages.
const MAX_SWEEPS: usize = 100;

impl Stepper {
    /// Writes a stepper. Without a class, it is for separable Hamiltonians if the method then consists of drifts and kicks, and
    /// otherwise for all.
    ///
    /// All languages do the same operations in the same order: a test compares the bits of C, Rust and Python.
    ///
    /// ```
    /// use symplectic_compiler::derive;
    /// use symplectic_tools::Stepper;
    ///
    /// let verlet = derive("polynomial(2)", "lobatto(2)")?.named("stormer-verlet");
    /// let text = Stepper::C.write(&verlet, None)?;
    /// assert!(text.contains("    stormer_verlet_kick(s, h * 0x1p-1); /* 1/2 */\n"));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`ErrorKind::NoStepper`](symplectic_compiler::ErrorKind::NoStepper) for a method with coupled stages that is not symplectic or has a
    /// weight of zero, for a method that does not consist of drifts and kicks though the class requires it, and for a method that is too
    /// long.
    pub fn write(self, tableau: &Tableau, class: Option<SteppedClass>) -> Result<String, Error> {
        self.write_for(tableau, class, None)
    }

    /// Writes a stepper with the parameters, the velocity, the force and the energy of a system. A system that is not separable has a
    /// stepper for every H.
    ///
    /// The order of the operations is that of the macro `hamiltonian!`.
    ///
    /// ```
    /// use symplectic_compiler::derive;
    /// use symplectic_tools::Stepper;
    /// use symplectic_formula::{Structure, System};
    ///
    /// let mut pendulum = System::read("pendulum", "Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)")?;
    /// let structure = Structure::of(&mut pendulum);
    /// let verlet = derive("polynomial(2)", "lobatto(2)")?.named("stormer-verlet");
    /// let text = Stepper::Python.write_with_system(&verlet, None, &pendulum, &structure)?;
    /// assert!(text.contains("        f[0] = -self.g * x1\n"));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`write`](Self::write); [`ErrorKind::NoStepperOfSystem`](symplectic_compiler::ErrorKind::NoStepperOfSystem) for a system that is more than
    /// a formula of H; [`ErrorKind::NoStepper`](symplectic_compiler::ErrorKind::NoStepper) for a method whose order is for a class that the system does
    /// not belong to.
    pub fn write_with_system(
        self,
        tableau: &Tableau,
        class: Option<SteppedClass>,
        system: &System,
        structure: &Structure,
    ) -> Result<String, Error> {
        self.write_for(tableau, class, Some((system, structure)))
    }

    fn write_for(
        self,
        tableau: &Tableau,
        class: Option<SteppedClass>,
        system: Option<(&System, &Structure)>,
    ) -> Result<String, Error> {
        if tableau.has_gradient_kicks() {
            return Err(plan::refused(
                "it has gradient kicks, which a stepper in another language does not take; `tableau!` takes them",
            ));
        }
        let table = Table::new(tableau, DIGITS);
        let class = match system {
            None => class,
            Some((system, structure)) => {
                system::check(system)?;
                plan::class_of(&table, class, system, structure)?
            }
        };
        let plan = Plan::new(&table, class, DIGITS)?;
        let notation = languages::notation(self);
        let about = (notation.comment)(&about(&table, &plan));
        let mut name = table.name.clone();
        if table.flows.is_some() && matches!(plan, Plan::Coupled(_)) {
            // One program may have both.
            name.push_str("_general");
        }
        let (upper, module) = (name.to_uppercase(), module(&name));
        let names = [("name", &name[..]), ("NAME", &upper), ("module", &module)];
        let add = fill(notation.add.trim_end(), &names);
        let mut values = vec![("about", about.trim_end()), ("add", &add)];
        values.extend(names);
        let (template, stages, sweeps);
        let body = match &plan {
            Plan::Splitting(flows) => {
                template = notation.splitting;
                let first = flows.first();
                let carries = first.is_some_and(|flow| flow.is_carried && !flow.is_drift);
                values.push(("carries", notation.carries[usize::from(carries)]));
                ("steps", steps(notation, flows, &names))
            }
            Plan::Coupled(coupled) => {
                template = notation.coupled;
                stages = coupled.matrices[0].1.len().to_string();
                sweeps = MAX_SWEEPS.to_string();
                values.extend([("stages", &stages[..]), ("sweeps", &sweeps)]);
                ("tables", tables(notation, coupled, &names))
            }
        };
        let section = match system {
            None => String::new(),
            Some((system, structure)) => {
                let is_splitting = matches!(plan, Plan::Splitting(_));
                system::section(self, system, structure, is_splitting, &names)?
            }
        };
        values.extend([(body.0, &body.1[..]), ("system", &section)]);
        Ok(fill(template, &values))
    }
}

/// The lines of the comment at the top.
fn about(table: &Table<'_>, plan: &Plan<'_>) -> Vec<String> {
    let mut lines = table.description();
    let (class, what) = match plan {
        Plan::Splitting(_) => (
            HamiltonianClass::Separable,
            "A step of H = T(t, p) + U(t, q): drifts and kicks, with compensated sums.",
        ),
        Plan::Coupled(_) => (
            HamiltonianClass::General,
            "A step of every H(t, q, p): the stages are solved for by fixed-point iteration, with compensated sums.",
        ),
    };
    lines.push(what.to_owned());
    let [order, most] = [class, HamiltonianClass::Nystrom].map(|class| table.order(class));
    if most > order {
        lines.push(format!(
            "The order {most} needs a kinetic energy that is quadratic in p and does not depend on t; else it is {order}."
        ));
    }
    lines
}

/// Drifts and kicks as straight-line code.
fn steps(notation: &Notation, flows: &[Flow], names: &[(&str, &str)]) -> String {
    let mut text = String::new();
    for flow in flows {
        let time = match flow.time {
            0.0 => "t".to_owned(),
            1.0 => "t + h".to_owned(),
            time => format!("t + h * {}", (notation.number)(time)),
        };
        let (weight, remark) = ((notation.number)(flow.weight.double), flow.weight.remark());
        let pattern = match (flow.is_drift, flow.is_carried) {
            (true, _) => notation.drift,
            (false, false) => notation.kick,
            (false, true) => notation.carried_kick,
        };
        let mut values = vec![
            ("time", &time[..]),
            ("weight", &weight),
            ("remark", &remark),
        ];
        values.extend(names);
        text.push_str(&fill(pattern, &values));
    }
    text.truncate(text.trim_end().len());
    text
}

/// The coefficients of coupled stages.
fn tables(notation: &Notation, coupled: &Coupled, names: &[(&str, &str)]) -> String {
    let mut text = String::new();
    for (name, entries) in &coupled.vectors {
        let entry = |entry: &Entry| {
            let (number, remark) = ((notation.number)(entry.double), entry.remark());
            fill(notation.entry, &[("number", &number), ("remark", &remark)])
        };
        let entries: String = entries.iter().map(entry).collect();
        let upper = name.to_uppercase();
        let mut values = vec![("vector", *name), ("VECTOR", &upper), ("entries", &entries)];
        values.extend(names);
        text.push_str(&fill(notation.vector, &values));
    }
    text.push_str(&(notation.remark)(SYMPLECTIC));
    text.push('\n');
    for (name, rows) in &coupled.matrices {
        let row = |row: &Vec<f64>| {
            let numbers: Vec<String> = row.iter().map(|&x| (notation.number)(x)).collect();
            fill(notation.row, &[("numbers", &numbers.join(", "))])
        };
        let rows: String = rows.iter().map(row).collect();
        let upper = name.to_uppercase();
        let mut values = vec![("vector", *name), ("VECTOR", &upper), ("entries", &rows)];
        values.extend(names);
        text.push_str(&fill(notation.matrix, &values));
    }
    text
}

/// The comment about the matrices.
const SYMPLECTIC: &str = "mu_ij = a_ij / b_j and mu_tilde_ij = a_tilde_ij / b_tilde_j, rounded so that mu_ij + mu_tilde_ji is 1 exactly: symplectic as rounded.";

/// The name of a module from a method's name, `Gauss2` from `gauss_2`.
fn module(name: &str) -> String {
    let mut text = String::new();
    let mut capital = true;
    for c in name.chars() {
        match (c, capital) {
            ('_', _) => capital = true,
            (c, true) => {
                text.push(c.to_ascii_uppercase());
                capital = false;
            }
            (c, false) => text.push(c),
        }
    }
    text
}
