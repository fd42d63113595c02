//! Systems with constraints, and with friction.

mod circuits;
mod cotangent_lift;
mod dirac;
mod dirac_forms;
mod discrete_lagrangians;
mod forces;
mod formulas;
mod friction;
mod galerkin;
mod hamilton_jacobi;
mod holonomic;
mod lagrangians;
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
