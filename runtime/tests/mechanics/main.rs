//! Systems with holonomic constraints.

mod holonomic;
mod start;
mod systems;
