//! Hamiltonians and Lagrangians as formulas: parsing, derivatives, and analysis.
//!
//! ```
//! use symplectic_compiler::formula::{System, Structure, Kinetic};
//!
//! let mut pendulum = System::read("pendulum", "Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)")?;
//! let structure = Structure::of(&mut pendulum);
//! assert!(structure.split.is_ok());
//! assert_eq!(structure.kinetic, Kinetic::Unit);
//! # Ok::<(), symplectic_compiler::Error>(())
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
//! | the degree of a polynomial, a singular `∂²H/∂p²` | [`degree`], [`hessian`] |
//! | as text, LaTeX and JSON | [`description`], [`display`] |
//! | the operations of an evaluation, in their order | [`operations`] |
//! | statements and loops | [`statements`] |
//! | as Rust | [`emit::system`](crate::emit::system()) |

mod check;
mod common_parts;
pub mod degree;
pub mod derivative;
pub mod description;
pub mod display;
pub mod distance;
pub mod elaborate;
mod error;
pub mod evaluate;
pub mod function;
pub mod graph;
pub mod hessian;
mod lagrangian_form;
pub mod legendre;
pub mod modular;
pub mod operations;
pub mod parse;
mod rewrite;
pub mod statements;
pub mod structure;
pub mod syntax;
mod system;
mod trigonometry;

pub use check::PROPERTIES;
pub use error::FormulaError;
pub use structure::{Kinetic, Structure};
pub use syntax::Form;
pub use system::{
    Bonds, Constraint, Invariant, Lagrangian, Layout, Legendre, Parameter, Shape, System,
};

use crate::error::Error;
use crate::expression::Input;

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
        let system = elaborate::elaborate(input, &definition)?;
        match form {
            Form::Hamiltonian => Ok(system),
            Form::Lagrangian => legendre::transform(system, &definition, input),
        }
    }
}

impl Form {
    /// The form of a text: L, if it has `L = …` or `v: […]`, else H.
    pub fn of(text: &str) -> Self {
        parse::form(Input { name: "", text })
    }
}
