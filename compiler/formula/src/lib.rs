//! Hamiltonians and Lagrangians as formulas: parsing, derivatives, and analysis.
//!
//! ```
//! use symplectic_formula::{System, Structure, Kinetic};
//!
//! let mut pendulum = System::read("pendulum", "Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)")?;
//! let structure = Structure::of(&mut pendulum);
//! assert!(structure.split.is_ok());
//! assert_eq!(structure.kinetic, Kinetic::Unit);
//! # Ok::<(), symplectic_exact::error::Error>(())
//! ```
//!
//! | what | where |
//! |---|---|
//! | the language | [`parse`] |
//! | names, shapes and indices | [`elaborate`] |
//! | formulas as a graph | [`graph`] |
//! | derivatives | [`derivative`] |
//! | from L to H | [`legendre`] |
//! | whether a formula vanishes | [`modular`] |
//! | class, kinetic energy, symmetries | [`structure`] |
//! | whether a formula is smooth where `|x|` in it has a kink | `smooth` |
//! | the degree of a polynomial, a singular `∂²H/∂p²` | [`degree`], [`hessian`] |
//! | the equations of motion | [`System::equations_of_motion`] |
//! | as text, LaTeX and JSON | [`description`], [`display`] |
//! | the operations of an evaluation, in their order | [`operations`] |
//! | statements and loops | [`statements`] |
//! | as Rust | [`emit::system`] |

mod check;
mod common_parts;
pub mod degree;
pub mod derivative;
pub mod description;
pub mod display;
pub mod distance;
pub mod elaborate;
pub mod emit;
mod equations;
pub mod evaluate;
mod force_gradient;
pub mod function;
pub mod graph;
pub mod hessian;
mod lagrangian_form;
pub mod legendre;
pub mod modular;
pub mod operations;
pub mod parse;
mod rewrite;
mod smooth;
pub mod statements;
pub mod structure;
pub mod syntax;
mod system;
mod trigonometry;

pub use check::PROPERTIES;
pub use structure::{Kinetic, Structure};
pub use syntax::Form;
pub use system::{
    Bonds, Constraint, Invariant, Lagrangian, Layout, Legendre, Parameter, Shape, System,
};

use self::graph::Id;
use self::syntax::{Definition, Name, ParameterKind};
use symplectic_exact::error::Error;
pub use symplectic_exact::error::FormulaError;
use symplectic_exact::input::Input;

impl System {
    /// Reads the definition of a system by its Hamiltonian; `name` names the source of the text.
    ///
    /// # Errors
    /// Any error in the definition, at its place.
    pub fn read(name: &str, text: &str) -> Result<Self, Error> {
        Self::read_as(Form::Hamiltonian, name, text)
    }

    /// Reads the definition of a system by its Hamiltonian or its Lagrangian; `name` names the source of the text.
    ///
    /// # Errors
    /// Any error in the definition, at its place.
    pub fn read_as(form: Form, name: &str, text: &str) -> Result<Self, Error> {
        let input = Input { name, text };
        let definition = parse::parse(input, form)?;
        Self::of_definition(input, &definition)
    }

    /// Reads the definition of a system, and an expression with its names and with `numbers`, the names of further parameters; returns the
    /// components of the expression in the graph. The definition is one that [`read_as`](Self::read_as) accepts.
    ///
    /// ```
    /// use symplectic_exact::input::Input;
    /// use symplectic_formula::{Form, System};
    ///
    /// let pendulum = "Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)";
    /// let section = Input { name: "section", text: "pa - g sin(t)" };
    /// let (_, parts) = System::read_with(Form::Hamiltonian, pendulum, &[], section)?;
    /// assert_eq!(parts.len(), 1);
    /// let wrong = Input { name: "section", text: "pa) + (b" };
    /// let error = System::read_with(Form::Hamiltonian, pendulum, &[], wrong).unwrap_err();
    /// assert_eq!(error.place.unwrap().span, 2..3);
    /// # Ok::<(), symplectic_exact::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// Any error in the expression, at its place in the expression.
    pub fn read_with(
        form: Form,
        text: &str,
        numbers: &[String],
        expression: Input<'_>,
    ) -> Result<(Self, Vec<Id>), Error> {
        let before = format!("{text}\n");
        let whole = format!("{before}{}", expression.text);
        let input = Input {
            name: expression.name,
            text: &whole,
        };
        let placed = |mut error: Error| {
            let within = |at: usize| at.saturating_sub(before.len()).min(expression.text.len());
            error.place = error
                .place
                .map(|place| expression.place(within(place.span.start)..within(place.span.end)));
            error
        };
        let mut definition = parse::parse_with(input, form, before.len()).map_err(placed)?;
        let parameters = numbers.iter().map(|text| syntax::Parameter {
            name: Name {
                text: text.clone(),
                span: before.len()..whole.len(),
            },
            kind: ParameterKind::Number(None),
        });
        definition.parameters.extend(parameters);
        let mut system = Self::of_definition(input, &definition).map_err(placed)?;
        let parts = system.invariants.pop().map(|last| last.parts);
        Ok((system, parts.unwrap_or_default()))
    }

    fn of_definition(input: Input<'_>, definition: &Definition) -> Result<Self, Error> {
        let mut system = elaborate::elaborate(input, definition)?;
        if definition.form == Form::Lagrangian {
            system = legendre::transform(system, definition, input)?;
        }
        system.find_smooth_powers();
        Ok(system)
    }
}

impl Form {
    /// The form of a text: L, if it has `L = …` or `v: […]`, else H.
    pub fn of(text: &str) -> Self {
        parse::form(Input { name: "", text })
    }
}
