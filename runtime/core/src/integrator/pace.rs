//! Who chooses the sizes of the steps.

/// Who chooses the sizes of the steps of a [`Stepper`](super::Stepper): the run ([`Equal`]) or the stepper ([`Own`]).
pub trait Pace: sealed::Sealed {
    /// Whether the stepper chooses.
    const OWN: bool;
}

/// The run chooses the sizes: all steps are equal.
#[derive(Clone, Copy, Debug)]
pub struct Equal;

/// The stepper chooses the size of each step.
#[derive(Clone, Copy, Debug)]
pub struct Own;

impl Pace for Equal {
    const OWN: bool = false;
}

impl Pace for Own {
    const OWN: bool = true;
}

mod sealed {
    pub trait Sealed {}

    impl Sealed for super::Equal {}
    impl Sealed for super::Own {}
}
