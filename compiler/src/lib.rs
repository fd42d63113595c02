//! Compiler.
#![allow(missing_docs, dead_code)]
pub mod algebra;
pub mod arithmetic;
mod error;
pub mod expression;
mod limits;
pub use error::*;
pub use limits::*;
