//! Systems with constraints, and with friction.

mod friction;
mod holonomic;
mod scales;
mod start;
mod systems;
