//! Systems with constraints, and with friction.

mod discrete_lagrangians;
mod forces;
mod formulas;
mod friction;
mod holonomic;
mod rotation;
mod scales;
mod start;
mod systems;
