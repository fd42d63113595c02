//! What the integration tests, the examples and the report share: [`scenes`] to integrate, [`methods`] to
//! integrate them with, how results are measured ([`measure`], [`counting`], [`counted`], [`order`]), and what they are measured
//! against ([`references`], [`peers`]).

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
