//! Where a system is.

/// A point of phase space at a time.
///
/// ```
/// use symplectic::State;
/// use symplectic::nalgebra::Vector2;
///
/// let state = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::new(0.0, 2.0));
/// assert_eq!(state.p[1], 2.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct State<V> {
    /// Time t.
    pub time: f64,
    /// Position q.
    pub q: V,
    /// Momentum p, of the same dimension as `q`.
    pub p: V,
}

impl<V> State<V> {
    /// The state `(q, p)` at `time`.
    pub const fn new(time: f64, q: V, p: V) -> Self {
        Self { time, q, p }
    }
}
