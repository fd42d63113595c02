//! Steps of variable size.

mod controller;
mod energy_momentum;
mod errors;
mod kepler;
mod logarithmic;
mod monitors;
mod output;
mod poincare;
mod restart;
mod tangent;
