//! The forces of the scenes over lanes: the same arithmetic, rewritten.

use super::lanes::Lanes;
use symplectic_tests::scenes::double_pendulum::GRAVITY;
use symplectic_tests::scenes::outer_solar_system::{
    BODIES, BODIES_AT_START, GRAVITATIONAL_CONSTANT,
};

/// A separable system with quadratic kinetic energy.
pub trait Separable<const N: usize> {
    /// The velocity `M⁻¹ p`.
    #[inline(always)]
    fn velocity<L: Lanes>(&self, p: &[L; N]) -> [L; N] {
        *p
    }

    /// The force at `q`.
    fn force<L: Lanes>(&self, q: &[L; N]) -> [L; N];
}

/// A system with any Hamiltonian.
pub trait General<const N: usize> {
    /// Velocity and force at `(q, p)`.
    fn slopes<L: Lanes>(&self, q: &[L; N], p: &[L; N]) -> ([L; N], [L; N]);
}

/// `−q/|q|³`.
#[derive(Clone, Copy, Debug)]
pub struct Kepler;

impl Separable<2> for Kepler {
    #[inline(always)]
    fn force<L: Lanes>(&self, &[x, y]: &[L; 2]) -> [L; 2] {
        let square = x * x + y * y;
        let factor = L::splat(1.0) / (square * square.sqrt());
        [-x * factor, -y * factor]
    }
}

/// The Hénon–Heiles system.
#[derive(Clone, Copy, Debug)]
pub struct HenonHeiles;

impl Separable<2> for HenonHeiles {
    #[inline(always)]
    fn force<L: Lanes>(&self, &[x, y]: &[L; 2]) -> [L; 2] {
        let product = x * y;
        [-x - product - product, y * y - x * x - y]
    }
}

/// The Sun and the five outer planets.
#[derive(Clone, Copy, Debug)]
pub struct OuterSolarSystem;

const INVERSE_MASSES: [f64; BODIES] = {
    let mut inverses = [0.0; BODIES];
    let mut i = 0;
    while i < BODIES {
        inverses[i] = 1.0 / BODIES_AT_START[i].mass;
        i += 1;
    }
    inverses
};

const STRENGTHS: [[f64; BODIES]; BODIES] = {
    let mut strengths = [[0.0; BODIES]; BODIES];
    let mut i = 0;
    while i < BODIES {
        let mut j = 0;
        while j < BODIES {
            strengths[i][j] =
                GRAVITATIONAL_CONSTANT * BODIES_AT_START[i].mass * BODIES_AT_START[j].mass;
            j += 1;
        }
        i += 1;
    }
    strengths
};

impl Separable<18> for OuterSolarSystem {
    #[inline(always)]
    fn velocity<L: Lanes>(&self, p: &[L; 18]) -> [L; 18] {
        let mut velocity = *p;
        for i in 0..BODIES {
            let inverse = L::splat(INVERSE_MASSES[i]);
            for k in 3 * i..3 * i + 3 {
                velocity[k] = p[k] * inverse;
            }
        }
        velocity
    }

    #[inline(always)]
    fn force<L: Lanes>(&self, q: &[L; 18]) -> [L; 18] {
        let mut force = [L::splat(0.0); 18];
        for i in 0..BODIES {
            for j in i + 1..BODIES {
                let x = q[3 * j] - q[3 * i];
                let y = q[3 * j + 1] - q[3 * i + 1];
                let z = q[3 * j + 2] - q[3 * i + 2];
                let square = x * x + y * y + z * z;
                let strength = L::splat(STRENGTHS[i][j]) / (square * square.sqrt());
                for (k, d) in [x, y, z].into_iter().enumerate() {
                    let pull = strength * d;
                    force[3 * i + k] += pull;
                    force[3 * j + k] = force[3 * j + k] - pull;
                }
            }
        }
        force
    }
}

/// Stiff harmonic and soft quartic springs in turn.
#[derive(Clone, Copy, Debug)]
pub struct FputSprings {
    /// The frequency of the stiff springs.
    pub omega: f64,
}

impl Separable<6> for FputSprings {
    #[inline(always)]
    fn force<L: Lanes>(&self, q: &[L; 6]) -> [L; 6] {
        let cube = |d: L| d * d * d;
        let stiffness = L::splat(self.omega * self.omega);
        let a = cube(q[0] - q[3]);
        let b = cube((q[1] - q[4]) - (q[0] + q[3]));
        let c = cube((q[2] - q[5]) - (q[1] + q[4]));
        let d = cube(-(q[2] + q[5]));
        [
            b - a,
            c - b,
            d - c,
            (b + a) - stiffness * q[3],
            (c + b) - stiffness * q[4],
            (d + c) - stiffness * q[5],
        ]
    }
}

/// The double pendulum; velocity and force share the sines and cosines.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum;

impl General<2> for DoublePendulum {
    #[inline(always)]
    fn slopes<L: Lanes>(&self, q: &[L; 2], p: &[L; 2]) -> ([L; 2], [L; 2]) {
        let (sine, cosine) = (q[0] - q[1]).sin_cos();
        let two = L::splat(2.0);
        let inverse = L::splat(1.0) / (two - cosine * cosine);
        let velocity = [
            (p[0] - p[1] * cosine) * inverse,
            (p[1] + p[1] - p[0] * cosine) * inverse,
        ];
        let product = p[0] * p[1];
        let twice_kinetic = (p[0] * p[0] + (p[1] * p[1] - product * cosine) * two) * inverse;
        let coupling = sine * inverse * (product - twice_kinetic * cosine);
        let force = [
            -coupling - q[0].sin() * L::splat(2.0 * GRAVITY),
            coupling - q[1].sin() * L::splat(GRAVITY),
        ];
        (velocity, force)
    }
}

/// `(q² + 1)(p² + 1)/2`.
#[derive(Clone, Copy, Debug)]
pub struct Nonseparable;

impl General<1> for Nonseparable {
    #[inline(always)]
    fn slopes<L: Lanes>(&self, &[q]: &[L; 1], &[p]: &[L; 1]) -> ([L; 1], [L; 1]) {
        let one = L::splat(1.0);
        ([p * (q * q + one)], [-q * (p * p + one)])
    }
}
