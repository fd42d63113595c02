//! Systems with constraints, and with friction.

mod formulas;
mod friction;
mod holonomic;
mod scales;
mod start;
mod systems;
