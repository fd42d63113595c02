//! The sum of the energies of the stages of a step.

use crate::Error;
use symplectic_core::{Error as CoreError, Scalar, System, Vector};

/// A stage of a step.
pub(super) struct EnergyAt<'a, V: Vector> {
    /// `h b_i` and `h b̃_i`.
    pub(super) weights: [V::Scalar; 2],
    /// The times of the position and of the momentum.
    pub(super) times: [f64; 2],
    pub(super) q: &'a V,
    pub(super) p: &'a V,
}

/// `h Σ b_i H(Q_i, P_i)`. If `b̃ ≠ b`, as for splittings, `h Σ (b_i T(P_i) + b̃_i U(Q_i))` for `H = T + U`, from the energies at
/// `(q, P_i)`, `(Q_i, p)` and `(q, p)` for any point: both lists of weights have the sum h. `check` receives the energies at the stages,
/// and the number of the stage from 1.
pub(super) fn weighted_energy<'a, S: System<V>, V: Vector>(
    system: &S,
    (q, p): (&V, &V),
    stages: impl Iterator<Item = EnergyAt<'a, V>> + Clone,
    check: impl Fn(V::Scalar, usize) -> Result<(), Error>,
) -> Result<V::Scalar, Error> {
    let at = |time, q: &V, p: &V| {
        let energy = system.energy(V::Scalar::from_f64(time), q, p);
        energy.ok_or(CoreError::NoEnergy)
    };
    let same_weights = stages
        .clone()
        .all(|stage| stage.weights[0] == stage.weights[1]);
    let mut sum = V::Scalar::from_f64(0.0);
    for (stage, number) in stages.zip(1..) {
        let [position_time, momentum_time] = stage.times;
        let energy = at(position_time, stage.q, stage.p)?;
        check(energy, number)?;
        // A system independent of time gives the same number, bit for bit.
        if position_time != momentum_time && at(momentum_time, stage.q, stage.p)? != energy {
            return Err(Error::DifferentNodes {
                stage: number,
                position_time,
                momentum_time,
            });
        }
        let [weight, force_weight] = stage.weights;
        sum += if same_weights {
            weight * energy
        } else {
            let both = at(position_time, q, p)?;
            weight * (at(position_time, q, stage.p)? - both)
                + force_weight * at(position_time, stage.q, p)?
        };
    }
    Ok(sum)
}
