//! The reaction to a failed step.

/// The reaction of an [`Integrator`](crate::Integrator) if the stages of a step do not converge or a result is NaN or infinite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Retry {
    /// The step fails, with the error.
    #[default]
    Never,
    /// The step is repeated as 2, 4, … up to 2^`halvings` equal steps; if all attempts fail, it fails with the error
    /// of the whole step. `halvings` is limited to [`Retry::MOST_HALVINGS`].
    ///
    /// A method with variable steps is not the symplectic map that it is with equal steps. Use this for rare
    /// stiff phases; [`Statistics::rejected`](crate::Statistics::rejected) counts them. Convergence of the
    /// stages does not make a step accurate. Each retry allocates memory for the state before the step.
    Split {
        /// The largest number of halvings.
        halvings: u32,
    },
}

impl Retry {
    /// Bound on the work of one step: 65 536 steps instead of one.
    pub const MOST_HALVINGS: u32 = 16;

    /// The number of parts of the step in each attempt.
    pub(crate) fn parts(self) -> impl Iterator<Item = u32> {
        let halvings = match self {
            Self::Never => 0,
            Self::Split { halvings } => halvings.min(Self::MOST_HALVINGS),
        };
        (1..=halvings).map(|halving| 1 << halving)
    }
}
