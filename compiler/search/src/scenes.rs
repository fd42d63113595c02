//! Systems on which methods are compared, each with a run of many periods.
//!
//! Systems with quadratic kinetic energy also have the derivative of the force along a vector, for gradient kicks.
//! Drifts and kicks are exact flows of both parts. Sums are compensated, so that rounding errors stay far below the errors of methods.

/// A number as a sum of two doubles: increments are added without loss.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sum {
    value: f64,
    rest: f64,
}

impl Sum {
    fn add(&mut self, increment: f64) {
        let increment = increment + self.rest;
        let sum = self.value + increment;
        let part = sum - self.value;
        self.rest = (self.value - (sum - part)) + (increment - part);
        self.value = sum;
    }
}

/// Positions and momenta.
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub(crate) q: Vec<Sum>,
    pub(crate) p: Vec<Sum>,
}

impl State {
    fn of(numbers: &[f64]) -> Vec<Sum> {
        numbers
            .iter()
            .map(|&value| Sum { value, rest: 0.0 })
            .collect()
    }

    /// The largest distance of any coordinate or momentum.
    pub(crate) fn distance(&self, other: &State) -> f64 {
        let pairs = self
            .q
            .iter()
            .zip(&other.q)
            .chain(self.p.iter().zip(&other.p));
        pairs.fold(0.0, |largest, (x, y)| {
            let difference = (x.value - y.value) + (x.rest - y.rest);
            match difference.is_finite() {
                true => largest.max(difference.abs()),
                false => f64::INFINITY,
            }
        })
    }
}

/// The classes of Hamiltonians for which a scene is an example.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// `p²/2 + U(q)`.
    Quadratic,
    /// `T(p) + U(q)` with `T` not quadratic.
    Separable,
    /// `A + εB` with the exact flow of `A`.
    Perturbed,
}

/// A part of the Hamiltonian.
#[derive(Debug)]
enum Part {
    /// The derivatives by which the other half changes: velocities of momenta, or forces of positions.
    Derivative(fn(&[f64], &mut [f64])),
    /// Forces, and their derivatives along a vector.
    Force(fn(&[f64], &mut [f64]), fn(&[f64], &[f64], &mut [f64])),
    /// The exact flow, which changes both halves.
    Flow(fn(f64, &mut [f64], &mut [f64])),
}

/// A system with its start and the time of a run.
#[derive(Debug)]
pub(crate) struct Scene {
    pub(crate) name: &'static str,
    pub(crate) kind: Kind,
    /// Force evaluations in a unit of time at which methods begin to be accurate.
    pub(crate) rate: f64,
    pub(crate) time: f64,
    q: &'static [f64],
    p: &'static [f64],
    drift: Part,
    kick: Part,
}

/// The part that a step applies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Half {
    Drift,
    Kick,
    /// What a gradient kick adds to a kick, `f′f` for masses 1.
    Gradient,
}

impl Scene {
    pub(crate) fn start(&self) -> State {
        State {
            q: State::of(self.q),
            p: State::of(self.p),
        }
    }

    /// Lets a part act for a time.
    pub(crate) fn apply(&self, half: Half, time: f64, state: &mut State) {
        let values = |sums: &[Sum]| -> Vec<f64> { sums.iter().map(|sum| sum.value).collect() };
        let part = match half {
            Half::Drift => &self.drift,
            Half::Kick | Half::Gradient => &self.kick,
        };
        match part {
            Part::Flow(flow) => {
                let (mut q, mut p) = (values(&state.q), values(&state.p));
                flow(time, &mut q, &mut p);
                (state.q, state.p) = (State::of(&q), State::of(&p));
            }
            Part::Derivative(derivative) | Part::Force(derivative, _) => {
                let (from, to) = match half {
                    Half::Drift => (&state.p, &mut state.q),
                    Half::Kick | Half::Gradient => (&state.q, &mut state.p),
                };
                let from = values(from);
                let mut increments = vec![0.0; from.len()];
                derivative(&from, &mut increments);
                if let (Half::Gradient, Part::Force(_, along)) = (half, part) {
                    let force = increments.clone();
                    along(&from, &force, &mut increments);
                }
                for (sum, increment) in to.iter_mut().zip(increments) {
                    sum.add(time * increment);
                }
            }
        }
    }
}

/// `q' = p`
fn free(p: &[f64], v: &mut [f64]) {
    v.copy_from_slice(p);
}

/// The exact flow of `(p² + q²)/2`.
fn rotation(time: f64, q: &mut [f64], p: &mut [f64]) {
    let (sin, cos) = time.sin_cos();
    for (q, p) in q.iter_mut().zip(p) {
        (*q, *p) = (cos * *q + sin * *p, cos * *p - sin * *q);
    }
}

/// The exact flow of `p²/2 − 1/|q|` in the plane, for bound orbits.
fn kepler(time: f64, q: &mut [f64], p: &mut [f64]) {
    let r = q[0].hypot(q[1]);
    let energy = 0.5 * (p[0] * p[0] + p[1] * p[1]) - 1.0 / r;
    let a = -0.5 / energy;
    let n = a.powf(-1.5);
    let radial = (q[0] * p[0] + q[1] * p[1]) / a.sqrt();
    // Kepler's equation for the change x of the eccentric anomaly: x − (1 − r/a) sin x + radial (1 − cos x) = n t
    let mut x = n * time;
    for _ in 0..50 {
        let (sin, cos) = x.sin_cos();
        let residual = x - (1.0 - r / a) * sin + radial * (1.0 - cos) - n * time;
        let slope = 1.0 - (1.0 - r / a) * cos + radial * sin;
        let step = residual / slope;
        x -= step;
        if step.abs() < 1e-15 {
            break;
        }
    }
    let (sin, cos) = x.sin_cos();
    let f = 1.0 - a / r * (1.0 - cos);
    let g = time - (x - sin) / n;
    let (old_q, old_p) = ([q[0], q[1]], [p[0], p[1]]);
    for k in 0..2 {
        q[k] = f * old_q[k] + g * old_p[k];
    }
    let new_r = q[0].hypot(q[1]);
    let df = -a * a * n / (r * new_r) * sin;
    let dg = 1.0 - a / new_r * (1.0 - cos);
    for k in 0..2 {
        p[k] = df * old_q[k] + dg * old_p[k];
    }
}

/// Hénon–Heiles: `U = (x² + y²)/2 + x²y − y³/3`.
fn henon_heiles(q: &[f64], f: &mut [f64]) {
    let (x, y) = (q[0], q[1]);
    f[0] = -x - x * y * 2.0;
    f[1] = -y - x * x + y * y;
}

fn henon_heiles_along(q: &[f64], w: &[f64], d: &mut [f64]) {
    let (x, y) = (q[0], q[1]);
    d[0] = -(1.0 + 2.0 * y) * w[0] - 2.0 * x * w[1];
    d[1] = -2.0 * x * w[0] + (2.0 * y - 1.0) * w[1];
}

/// `U = −1/|q|`
fn attraction(q: &[f64], f: &mut [f64]) {
    let square = q[0] * q[0] + q[1] * q[1];
    let cube = square * square.sqrt();
    f[0] = -q[0] / cube;
    f[1] = -q[1] / cube;
}

fn attraction_along(q: &[f64], w: &[f64], d: &mut [f64]) {
    let square = q[0] * q[0] + q[1] * q[1];
    let cube = square * square.sqrt();
    let radial = 3.0 * (q[0] * w[0] + q[1] * w[1]) / square;
    d[0] = (radial * q[0] - w[0]) / cube;
    d[1] = (radial * q[1] - w[1]) / cube;
}

/// `U = −cos q`
fn pendulum(q: &[f64], f: &mut [f64]) {
    f[0] = -q[0].sin();
}

fn pendulum_along(q: &[f64], w: &[f64], d: &mut [f64]) {
    d[0] = -q[0].cos() * w[0];
}

/// A chain between walls with cubic springs: `U = Σ d²/2 + d³/4 + d⁴/4`, `d` the extensions.
fn chain(q: &[f64], f: &mut [f64]) {
    let tension = |d: f64| d + d * d * 0.75 + d * d * d;
    let at = |k: usize| {
        if k == 0 || k > q.len() { 0.0 } else { q[k - 1] }
    };
    for k in 1..=q.len() {
        f[k - 1] = tension(at(k + 1) - at(k)) - tension(at(k) - at(k - 1));
    }
}

fn chain_along(q: &[f64], w: &[f64], d: &mut [f64]) {
    let at = |list: &[f64], k: usize| {
        if k == 0 || k > list.len() {
            0.0
        } else {
            list[k - 1]
        }
    };
    let extended = |list: &[f64], k: usize| at(list, k + 1) - at(list, k);
    let stiff = |d: f64| 1.0 + 1.5 * d + 3.0 * d * d;
    let tension = |k: usize| stiff(extended(q, k)) * extended(w, k);
    for k in 1..=q.len() {
        d[k - 1] = tension(k) - tension(k - 1);
    }
}

/// Two wells: `U = (x² − 1)²/4 + y²/2 + xy²/5`.
fn wells(q: &[f64], f: &mut [f64]) {
    let (x, y) = (q[0], q[1]);
    f[0] = x - x * x * x - y * y * 0.2;
    f[1] = -y - x * y * 0.4;
}

fn wells_along(q: &[f64], w: &[f64], d: &mut [f64]) {
    let (x, y) = (q[0], q[1]);
    d[0] = (1.0 - 3.0 * x * x) * w[0] - 0.4 * y * w[1];
    d[1] = -0.4 * y * w[0] - (1.0 + 0.4 * x) * w[1];
}

/// `T = √(1 + |p|²)`
fn relativistic(p: &[f64], v: &mut [f64]) {
    let energy = p.iter().fold(1.0, |sum, p| sum + p * p).sqrt();
    for (v, p) in v.iter_mut().zip(p) {
        *v = p / energy;
    }
}

/// `U = x²/2 + y² + x²y²/4`
fn bowl(q: &[f64], f: &mut [f64]) {
    let (x, y) = (q[0], q[1]);
    f[0] = -x - 0.5 * x * y * y;
    f[1] = -2.0 * y - 0.5 * x * x * y;
}

/// `T = −cos p`
fn lattice(p: &[f64], v: &mut [f64]) {
    for (v, p) in v.iter_mut().zip(p) {
        *v = p.sin();
    }
}

/// `T = |p|²/2 + |p|⁴/4`
fn quartic(p: &[f64], v: &mut [f64]) {
    let square: f64 = p.iter().map(|p| p * p).sum();
    for (v, p) in v.iter_mut().zip(p) {
        *v = p * (1.0 + square);
    }
}

/// `ε(x²y − y³/3)`, `ε = 0.03`
fn weak_henon_heiles(q: &[f64], f: &mut [f64]) {
    let (x, y) = (q[0], q[1]);
    f[0] = -0.06 * x * y;
    f[1] = -0.03 * (x * x - y * y);
}

/// `ε q⁴/4` and a coupling `ε x²y²/2`, `ε = 0.01`
fn weak_quartic(q: &[f64], f: &mut [f64]) {
    let (x, y) = (q[0], q[1]);
    f[0] = -0.01 * (x * x * x + x * y * y);
    f[1] = -0.01 * (y * y * y + x * x * y);
}

/// Rotors: `−ε Σ cos(q_{k+1} − q_k)`, `ε = 0.02`
fn weak_rotors(q: &[f64], f: &mut [f64]) {
    f.fill(0.0);
    for k in 1..q.len() {
        let force = 0.02 * (q[k] - q[k - 1]).sin();
        f[k] -= force;
        f[k - 1] += force;
    }
}

/// An oblate body: `ε(3y²/r⁵ − 1/r³)/2`, `ε = 0.003`
fn oblate(q: &[f64], f: &mut [f64]) {
    const SIZE: f64 = 0.003;
    let (x, y) = (q[0], q[1]);
    let r2 = x * x + y * y;
    let r5 = r2 * r2 * r2.sqrt();
    let common = SIZE * (-7.5 * y * y / r2 + 1.5) / r5;
    f[0] = -common * x;
    f[1] = -common * y - SIZE * 3.0 * y / r5;
}

/// The tide of a far body that does not move: `−ε(x² − y²/2)`, `ε = 0.002`
fn tide(q: &[f64], f: &mut [f64]) {
    f[0] = 0.004 * q[0];
    f[1] = -0.002 * q[1];
}

/// All scenes.
pub(crate) const SCENES: &[Scene] = &[
    Scene {
        name: "Hénon–Heiles",
        kind: Kind::Quadratic,
        rate: 4.0,
        time: 300.0,
        q: &[0.3, 0.2],
        p: &[0.2, -0.1],
        drift: Part::Derivative(free),
        kick: Part::Force(henon_heiles, henon_heiles_along),
    },
    Scene {
        name: "Kepler, e = 0.3",
        kind: Kind::Quadratic,
        rate: 6.0,
        time: 300.0,
        q: &[0.7, 0.0],
        p: &[0.0, 1.362_770_287_738_494_6],
        drift: Part::Derivative(free),
        kick: Part::Force(attraction, attraction_along),
    },
    Scene {
        name: "pendulum",
        kind: Kind::Quadratic,
        rate: 4.0,
        time: 300.0,
        q: &[1.5],
        p: &[0.5],
        drift: Part::Derivative(free),
        kick: Part::Force(pendulum, pendulum_along),
    },
    Scene {
        name: "chain of 5",
        kind: Kind::Quadratic,
        rate: 6.0,
        time: 200.0,
        q: &[0.1, 0.3, 0.2, -0.1, 0.05],
        p: &[0.0, 0.1, -0.2, 0.0, 0.1],
        drift: Part::Derivative(free),
        kick: Part::Force(chain, chain_along),
    },
    Scene {
        name: "two wells",
        kind: Kind::Quadratic,
        rate: 4.0,
        time: 200.0,
        q: &[1.3, 0.4],
        p: &[0.1, 0.3],
        drift: Part::Derivative(free),
        kick: Part::Force(wells, wells_along),
    },
    Scene {
        name: "relativistic bowl",
        kind: Kind::Separable,
        rate: 4.0,
        time: 200.0,
        q: &[1.0, 0.5],
        p: &[0.5, 1.0],
        drift: Part::Derivative(relativistic),
        kick: Part::Derivative(bowl),
    },
    Scene {
        name: "lattice, −cos p − cos q",
        kind: Kind::Separable,
        rate: 4.0,
        time: 200.0,
        q: &[1.2],
        p: &[0.6],
        drift: Part::Derivative(lattice),
        kick: Part::Force(pendulum, pendulum_along),
    },
    Scene {
        name: "quartic in p",
        kind: Kind::Separable,
        rate: 6.0,
        time: 150.0,
        q: &[0.6, 0.2],
        p: &[0.3, 0.4],
        drift: Part::Derivative(quartic),
        kick: Part::Derivative(bowl),
    },
    Scene {
        name: "weak Hénon–Heiles",
        kind: Kind::Perturbed,
        rate: 1.0,
        time: 600.0,
        q: &[1.0, 0.7],
        p: &[0.5, -0.8],
        drift: Part::Flow(rotation),
        kick: Part::Derivative(weak_henon_heiles),
    },
    Scene {
        name: "weak quartic",
        kind: Kind::Perturbed,
        rate: 1.0,
        time: 600.0,
        q: &[1.0, 0.3],
        p: &[0.2, 1.1],
        drift: Part::Flow(rotation),
        kick: Part::Derivative(weak_quartic),
    },
    Scene {
        name: "weakly coupled rotors",
        kind: Kind::Perturbed,
        rate: 1.0,
        time: 400.0,
        q: &[0.0, 1.0, 2.0],
        p: &[1.0, 0.4, -0.7],
        drift: Part::Derivative(free),
        kick: Part::Derivative(weak_rotors),
    },
    Scene {
        name: "Kepler about an oblate body",
        kind: Kind::Perturbed,
        rate: 2.0,
        time: 400.0,
        q: &[0.8, 0.0],
        p: &[0.0, 1.224_744_871_391_589],
        drift: Part::Flow(kepler),
        kick: Part::Derivative(oblate),
    },
    Scene {
        name: "Kepler with a tide",
        kind: Kind::Perturbed,
        rate: 2.0,
        time: 400.0,
        q: &[0.9, 0.0],
        p: &[0.0, 1.1],
        drift: Part::Flow(kepler),
        kick: Part::Derivative(tide),
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_along_a_vector_are_differences_of_forces() {
        for scene in SCENES {
            let Part::Force(force, along) = &scene.kick else {
                continue;
            };
            let vector: Vec<f64> = (0..scene.q.len()).map(|k| 0.3 + 0.2 * k as f64).collect();
            let at = |step: f64| {
                let moved: Vec<f64> = scene
                    .q
                    .iter()
                    .zip(&vector)
                    .map(|(q, w)| q + step * w)
                    .collect();
                let mut found = vec![0.0; moved.len()];
                force(&moved, &mut found);
                found
            };
            let mut derivative = vec![0.0; vector.len()];
            along(scene.q, &vector, &mut derivative);
            for (k, (high, low)) in at(1e-5).into_iter().zip(at(-1e-5)).enumerate() {
                assert!(
                    (derivative[k] - (high - low) / 2e-5).abs() < 1e-8,
                    "{}",
                    scene.name
                );
            }
        }
    }

    /// A flow there and back is the identity, and flows of two halves are that of the whole.
    #[test]
    fn exact_flows_are_flows() {
        for scene in SCENES
            .iter()
            .filter(|scene| matches!(scene.drift, Part::Flow(_)))
        {
            let moved = |times: &[f64]| {
                let mut state = scene.start();
                for time in times {
                    scene.apply(Half::Drift, *time, &mut state);
                }
                state
            };
            assert!(
                moved(&[1.3, -1.3]).distance(&scene.start()) < 1e-13,
                "{}",
                scene.name
            );
            assert!(
                moved(&[0.4, 2.6]).distance(&moved(&[3.0])) < 1e-13,
                "{}",
                scene.name
            );
        }
    }
}
