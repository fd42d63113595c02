//! Quantities in error messages.

use core::fmt;

/// The quantity that an [`Error`](crate::Error) is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Quantity {
    /// Time t.
    Time,
    /// Position q.
    Position,
    /// Momentum p.
    Momentum,
    /// ∂H/∂p.
    Velocity,
    /// −∂H/∂q.
    Force,
    /// The displacement (δq, δp) of a tangent.
    Displacement,
    /// A derivative of the velocity or the force.
    Derivative,
    /// The change of the momentum by a kick.
    Kick,
    /// H.
    Energy,
    /// A constraint: φ, or a row of w.
    Constraint,
    /// The attitude R of a rigid body.
    Attitude,
    /// A torque on a rigid body.
    Torque,
    /// A discrete Lagrangian, its derivatives or its forces.
    DiscreteLagrangian,
    /// A Lagrangian, its derivatives or its force.
    Lagrangian,
}

impl fmt::Display for Quantity {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Time => "time",
            Self::Position => "position",
            Self::Momentum => "momentum",
            Self::Velocity => "velocity",
            Self::Force => "force",
            Self::Displacement => "displacement",
            Self::Derivative => "derivative of the velocity or the force",
            Self::Kick => "change of the momentum by a kick",
            Self::Energy => "energy",
            Self::Constraint => "constraint",
            Self::Attitude => "attitude",
            Self::Torque => "torque",
            Self::DiscreteLagrangian => "discrete Lagrangian",
            Self::Lagrangian => "Lagrangian",
        })
    }
}
