//! Systems with constraints, and with friction.

mod cotangent_lift;
mod discrete_lagrangians;
mod forces;
mod formulas;
mod friction;
mod hamilton_jacobi;
mod holonomic;
mod newmark;
mod nonholonomic;
mod nonholonomic_formulas;
mod nonholonomic_start;
mod observed_order;
mod rolling;
mod rotation;
mod scales;
mod start;
mod symmetry;
mod systems;
