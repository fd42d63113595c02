//! Shared code of the integration tests, the examples and the report: [`scenes`], [`methods`], measurements
//! ([`measure`], [`counting`], [`counted`], [`order`]), and comparisons ([`references`], [`peers`]).

pub mod at_run_time;
pub mod counted;
pub mod counting;
pub mod drift;
pub mod formulas;
pub mod lagrangians;
pub mod linear_stability;
pub mod measure;
pub mod methods;
pub mod order;
pub mod peers;
pub mod references;
pub mod scenes;
pub mod stiff_and_extreme;
pub mod stiff_steps;
pub mod table;
