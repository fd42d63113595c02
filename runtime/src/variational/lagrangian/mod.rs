//! Lagrangians: their derivatives, and the steps that need no Hamiltonian.

pub(crate) mod derivatives;
