//! Momentum maps of symmetries.

use symplectic_core::{State, Vector};

/// The momentum map `J(q, p)·ξ = p·ξ_Q(q)` of a symmetry with the generator `ξ_Q`, which `generator(q, out)` writes into `out`
/// (Marsden & West, 2001, §1.3.3).
///
/// ```
/// use symplectic::State;
/// use symplectic::nalgebra::Vector2;
/// use symplectic::variational::momentum_map;
///
/// // Rotations of the plane: the angular momentum.
/// let state = State::new(0.0, Vector2::new(1.0, 2.0), Vector2::new(3.0, 5.0));
/// assert_eq!(momentum_map(&state, |q, out| *out = Vector2::new(-q[1], q[0])), -1.0);
/// ```
pub fn momentum_map<V: Vector>(state: &State<V>, generator: impl FnOnce(&V, &mut V)) -> V::Scalar {
    let mut direction = state.q.zeros_like();
    generator(&state.q, &mut direction);
    super::two_ends::dot(&state.p, &direction)
}
