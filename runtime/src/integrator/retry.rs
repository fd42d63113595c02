//! What is done about a step that fails.

/// What an [`Integrator`](crate::Integrator) does where the stages of a step are not found or something is not finite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Retry {
    /// The step fails, with the error.
    #[default]
    Never,
    /// The step is taken again as 2, 4, … up to 2^`halvings` equal ones; if none of that helps it fails, with the error
    /// of the whole step. More halvings than [`Retry::MOST_HALVINGS`] count as so many.
    ///
    /// A method with steps of different sizes is not the symplectic map that one of equal steps is: this is for a rare
    /// stiff while, and [`Statistics::rejected`](crate::Statistics::rejected) says how rare it was. That the
    /// stages are found does not make a step accurate. Memory for the state before the step is made each time.
    Split {
        /// The most halvings.
        halvings: u32,
    },
}

impl Retry {
    /// A bound on the work that one step can ask for: 65 536 steps instead of one.
    pub const MOST_HALVINGS: u32 = 16;

    /// How many steps the whole one is split into, one attempt after another.
    pub(crate) fn parts(self) -> impl Iterator<Item = u32> {
        let halvings = match self {
            Self::Never => 0,
            Self::Split { halvings } => halvings.min(Self::MOST_HALVINGS),
        };
        (1..=halvings).map(|halving| 1 << halving)
    }
}
