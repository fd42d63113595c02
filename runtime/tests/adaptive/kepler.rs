//! Kepler orbits in closed form, and the methods of these tests.

use symplectic::State;
use symplectic::nalgebra::{SVector, Vector2};

symplectic::tableau! {
    pub VelocityVerlet { base: velocity-verlet }
    pub PositionVerlet { base: position-verlet }
    pub ForestRuth { base: forest-ruth-1990 }
    /// Of order 4 for quadratic kinetic energies only.
    pub McLachlanAtela { base: mclachlan-atela-1992-order-4-optimal }
    /// Lobatto IIIA–IIIB with two stages.
    pub Rattle { basis: polynomial(2), nodes: lobatto(2) }
    pub Gauss1 { basis: polynomial(1), nodes: gauss(1) }
    pub Gauss2 { basis: polynomial(2), nodes: gauss(2) }
    pub Gauss5 { basis: polynomial(5), nodes: gauss(5) }
}

symplectic::composition! {
    pub PositionJump { base: position-verlet, weights: triple_jump(4) }
}

symplectic::hamiltonian! {
    pub Kepler
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)
}

symplectic::hamiltonian! {
    /// The mass at the centre oscillates.
    pub Pulsating
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 - (1 + sin(3 t)/4)/sqrt(x^2 + y^2)
}

/// The pericentre of an orbit with semi-major axis 1.
pub fn pericentre(eccentricity: f64) -> State<Vector2<f64>> {
    let speed = ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt();
    State::from_arrays(0.0, [1.0 - eccentricity, 0.0], [0.0, speed])
}

/// The position at a time after the pericentre, by Kepler's equation.
pub fn position(eccentricity: f64, time: f64) -> Vector2<f64> {
    let mut anomaly = std::f64::consts::PI;
    for _ in 0..100 {
        let residual = anomaly - eccentricity * anomaly.sin() - time;
        anomaly -= residual / (1.0 - eccentricity * anomaly.cos());
    }
    let width = (1.0 - eccentricity * eccentricity).sqrt();
    Vector2::new(anomaly.cos() - eccentricity, width * anomaly.sin())
}

pub fn energy<const N: usize>(state: &State<SVector<f64, N>>) -> f64 {
    let distance = state.q[0].hypot(state.q[1]);
    (state.p[0] * state.p[0] + state.p[1] * state.p[1]) / 2.0 - 1.0 / distance
}

/// The angular momentum, and the Laplace vector `p × L − q/|q|`.
pub fn laplace(state: &State<Vector2<f64>>) -> (f64, Vector2<f64>) {
    let State { q, p, .. } = state;
    let momentum = q[0] * p[1] - q[1] * p[0];
    (
        momentum,
        Vector2::new(p[1], -p[0]) * momentum - q / q.norm(),
    )
}

/// Checks that errors at halved steps fall with an order, and not with one higher.
#[track_caller]
pub fn assert_order(name: &str, order: f64, errors: &[f64]) {
    for pair in errors.windows(2) {
        let slope = (pair[0] / pair[1]).log2();
        assert!(
            (slope - order).abs() < 0.05,
            "{name}: {slope} in {errors:?}"
        );
    }
}
