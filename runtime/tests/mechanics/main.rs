//! Systems with constraints, and with friction.

mod friction;
mod holonomic;
mod start;
mod systems;
