//! Problems, one a file: the Hamiltonian over any scalar, the initial data with its source, a reference, and what a
//! method has to bring along to integrate it.

pub mod henon_heiles;
pub mod kepler;
pub mod outer_solar_system;
