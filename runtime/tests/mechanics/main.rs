//! Systems with constraints, and with friction.

mod formulas;
mod friction;
mod holonomic;
mod nonholonomic;
mod nonholonomic_formulas;
mod nonholonomic_start;
mod rolling;
mod scales;
mod start;
mod systems;
