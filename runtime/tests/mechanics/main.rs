//! Systems with constraints, and with friction.

mod forces;
mod formulas;
mod friction;
mod holonomic;
mod scales;
mod start;
mod systems;
