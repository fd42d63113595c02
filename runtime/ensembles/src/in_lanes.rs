//! Vectors over lanes: set and read lane by lane, and evaluations there, compared with those of doubles.

use symplectic_core::inside::Work;
use symplectic_core::simd::Lanes;
use symplectic_core::{Scalar, State, System, Vector};

/// Sets every lane of a vector to the doubles of another one.
pub(super) fn fill<'v, W: Vector<Scalar: Lanes>, T: Scalar>(
    vector: &mut W,
    lane: impl Fn(usize) -> &'v [T],
) {
    for (number, component) in vector.as_mut_slice().iter_mut().enumerate() {
        *component = Lanes::from_fn(|place| {
            let doubles = T::doubles(lane(place)).unwrap_or(&[]);
            doubles.get(number).copied().unwrap_or_default()
        });
    }
}

/// Copies the vector of a lane.
pub(super) fn copy_lane<V: Vector, W: Vector<Scalar: Lanes>>(lane: usize, from: &W, to: &mut V) {
    for (to, from) in to.as_mut_slice().iter_mut().zip(from.as_slice()) {
        *to = V::Scalar::from_f64(from.get(lane));
    }
}

/// The velocity and the force of a system at a state.
pub(super) fn evaluations<V: Vector, S: System<V>>(system: &S, state: &State<V>) -> [V; 2] {
    V::Scalar::in_registers(Evaluate { system, state })
}

/// Whether velocity and force have the same bits in a lane and as doubles.
pub(super) fn is_same<W, V>(in_lanes: &[W; 2], lane: usize, alone: &[V; 2]) -> bool
where
    W: Vector<Scalar: Lanes>,
    V: Vector,
{
    in_lanes.iter().zip(alone).all(|(in_lanes, alone)| {
        let (in_lanes, alone) = (in_lanes.as_slice(), V::Scalar::doubles(alone.as_slice()));
        let alone = alone.unwrap_or(&[]);
        let mut pairs = in_lanes.iter().zip(alone);
        in_lanes.len() == alone.len()
            && pairs.all(|(in_lanes, alone)| in_lanes.get(lane).to_bits() == alone.to_bits())
    })
}

/// Velocity and force at a state.
struct Evaluate<'a, S, V> {
    system: &'a S,
    state: &'a State<V>,
}

impl<V: Vector, S: System<V>> Work for Evaluate<'_, S, V> {
    type Output = [V; 2];

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> [V; 2] {
        let State { time, q, p } = self.state;
        let time = V::Scalar::from_f64(*time);
        let mut found = [q.zeros_like(), q.zeros_like()];
        let [velocity, force] = &mut found;
        self.system.velocity(time, q, p, velocity);
        self.system.force(time, q, p, force);
        found
    }
}
