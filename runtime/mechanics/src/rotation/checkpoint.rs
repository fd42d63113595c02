//! Checkpoints of rigid bodies.

use alloc::vec::Vec;

use nalgebra::{Quaternion, UnitQuaternion};

use super::body::RigidBody;
use super::integrator::RotationSteps;
use super::state::RotationState;
use symplectic_core::Checkpoint;
use symplectic_core::inside::SaveWords;
use symplectic_core::solver::{Visit, Words};
use symplectic_core::stepper::Stepper;

impl<B: RigidBody> SaveWords for RotationSteps<B> {
    fn blank_checkpoint(&self) -> Checkpoint {
        let definition = self.steps.definition();
        Checkpoint::of_method("steps of a rigid body", definition, 3).with_compensated_sums()
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        self.present.words(visit);
    }

    /// The moments of inertia and the torque, also where the body is turned further, because symmetry may hide a parameter.
    fn fingerprint(&mut self) -> Vec<f64> {
        let RotationState { time, attitude, .. } = *self.state();
        let turn = UnitQuaternion::new_unchecked(Quaternion::new(0.8, 0.36, 0.48, 0.0));
        let torques = [attitude, attitude * turn].map(|at| self.body.torque(time, &at));
        let numbers = torques.iter().chain([&self.moments]).flatten();
        numbers.copied().collect()
    }
}
