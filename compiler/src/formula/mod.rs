//! Hamiltonians as formulas: read, differentiated, and looked at.
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
//! | class, kinetic energy, symmetries | [`structure`] |
//! | as text, LaTeX and JSON | [`description`], [`display`] |
//! | as Rust | [`emit::system`](crate::emit::system()) |

mod check;
pub mod derivative;
pub mod description;
pub mod display;
pub mod distance;
pub mod elaborate;
mod error;
pub mod evaluate;
pub mod function;
pub mod graph;
pub mod parse;
pub mod structure;
pub mod syntax;
mod system;

pub use check::PROPERTIES;
pub use error::FormulaError;
pub use structure::{Kinetic, Structure};
pub use system::{Bonds, Invariant, Layout, Parameter, Shape, System};

use crate::error::Error;
use crate::expression::Input;

impl System {
    /// Reads the definition of a system; `name` says where the text is from.
    ///
    /// # Errors
    /// Anything that is wrong with it, at its place.
    pub fn read(name: &str, text: &str) -> Result<Self, Error> {
        let input = Input { name, text };
        let definition = parse::parse(input)?;
        elaborate::elaborate(input, &definition)
    }
}
