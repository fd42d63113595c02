//! The names of constraints.

use core::fmt;

/// The name of a constraint: `rod`, or `rods[3]` in a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ConstraintName {
    /// The name of the constraint, or of its family.
    pub name: &'static str,
    /// The index in the family, from 0.
    pub member: Option<usize>,
}

impl fmt::Display for ConstraintName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name)?;
        self.member
            .map_or(Ok(()), |member| write!(formatter, "[{member}]"))
    }
}
