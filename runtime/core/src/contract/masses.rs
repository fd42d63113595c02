//! What a system declares about its masses.

/// What a system declares about its masses: [`Hamiltonian::MASSES`](crate::Hamiltonian::MASSES).
///
/// The declaration is optional and only saves work. In a separable system the integrator itself determines whether the kinetic energy is
/// `pᵀM⁻¹p/2` with constant M.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Masses {
    /// No declaration.
    #[default]
    Any,
    /// The velocity depends on the momentum alone. It matters for constrained systems of class [`General`](crate::General), whose force
    /// depends on momenta too. If the velocity is `M⁻¹p`, constrained steps then compute M⁻¹ once.
    Constant,
    /// The velocity equals the momentum to the last bit, `H = |p|²/2 + U(t, q)`. Steps then use the momentum as the velocity,
    /// without copies of long vectors. If the velocity differs from the momentum, creating an integrator returns
    /// [`Error::NotUnitMasses`](crate::Error::NotUnitMasses).
    Unit,
}

impl Masses {
    /// Whether they are [`Unit`](Self::Unit).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn are_unit(self) -> bool {
        matches!(self, Self::Unit)
    }
}
