//! 10⁸ steps of the midpoint rule on the harmonic oscillator, with and without compensated sums.
//!
//! `cargo run --release -p symplectic-tests --example hundred_million`, half a minute; `-- --quick` for 10⁶ steps.
//!
//! A step of size h turns the state by the angle `2 atan(h/2)`, exactly: where it is after N steps is known from the power
//! `((2 + ih)/(2 − ih))ᴺ`, in double-double arithmetic. The energy of an ideal run is a random walk of √N rounding errors.

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic::nalgebra::SVector;
use symplectic::solver::Solver;
use symplectic::{Error, Integrator, State, Summation};

symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }

symplectic::hamiltonian! { Oscillator q: [x], p: [px]; H = (px^2 + x^2)/2 }

/// A power of two, so that it has no rounding error.
const STEP_SIZE: f64 = 0.25;

fn main() -> Result<(), Error> {
    let quick = std::env::args().any(|argument| argument == "--quick");
    let steps: u64 = if quick { 1_000_000 } else { 100_000_000 };
    let exact = rotated(steps);
    println!("{steps} steps of the midpoint rule of size {STEP_SIZE} on the harmonic oscillator\n");
    println!("| sums | energy error | distance from the exact rotation |");
    println!("|---|---:|---:|");
    let start = || State::from_arrays(0.0, [1.0], [0.0]);
    let compensated = Integrator::new(Midpoint, Oscillator, start(), STEP_SIZE)?;
    row("compensated", compensated, steps, exact)?;
    let plain = Integrator::plain(Midpoint, Oscillator, start(), STEP_SIZE)?;
    row("plain", plain, steps, exact)
}

fn row<R, N>(
    sums: &str,
    mut integrator: Integrator<Midpoint, Oscillator, SVector<f64, 1>, R, N>,
    steps: u64,
    exact: [f64; 2],
) -> Result<(), Error>
where
    R: Summation,
    N: Solver<SVector<f64, 1>, Oscillator>,
{
    integrator.take_steps(steps)?;
    let State { q, p, .. } = integrator.state();
    let energy = (q[0] * q[0] - 1.0) + p[0] * p[0];
    let distance = (q[0] - exact[0]).hypot(p[0] - exact[1]);
    println!("| {sums} | {energy:.1e} | {distance:.1e} |");
    Ok(())
}

/// `(cos Nφ, −sin Nφ)` with `φ = 2 atan(h/2)`.
fn rotated(steps: u64) -> [f64; 2] {
    // (2 + ih)² / (4 + h²)
    let norm = 4.0 + STEP_SIZE * STEP_SIZE;
    let part = |value: f64| Double::quotient(value, norm);
    let mut square = Complex {
        re: part(4.0 - STEP_SIZE * STEP_SIZE),
        im: part(4.0 * STEP_SIZE),
    };
    let mut power = Complex {
        re: Double::new(1.0),
        im: Double::new(0.0),
    };
    let mut rest = steps;
    while rest > 0 {
        if rest % 2 == 1 {
            power = power.times(square);
        }
        square = square.times(square);
        rest /= 2;
    }
    [power.re.high, -power.im.high]
}

#[derive(Clone, Copy)]
struct Complex {
    re: Double,
    im: Double,
}

impl Complex {
    fn times(self, other: Self) -> Self {
        Self {
            re: self
                .re
                .times(other.re)
                .plus(self.im.times(other.im).negated()),
            im: self.re.times(other.im).plus(self.im.times(other.re)),
        }
    }
}

/// An unevaluated sum of two doubles.
#[derive(Clone, Copy)]
struct Double {
    high: f64,
    low: f64,
}

impl Double {
    fn new(value: f64) -> Self {
        Self {
            high: value,
            low: 0.0,
        }
    }

    fn quotient(dividend: f64, divisor: f64) -> Self {
        let high = dividend / divisor;
        let low = high.mul_add(-divisor, dividend) / divisor;
        Self { high, low }
    }

    fn negated(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }

    fn plus(self, other: Self) -> Self {
        let sum = self.high + other.high;
        let part = sum - self.high;
        let error = (self.high - (sum - part)) + (other.high - part);
        Self::new(sum).with(error + self.low + other.low)
    }

    fn times(self, other: Self) -> Self {
        let product = self.high * other.high;
        let error = self.high.mul_add(other.high, -product);
        Self::new(product).with(error + self.high * other.low + self.low * other.high)
    }

    fn with(self, low: f64) -> Self {
        let high = self.high + low;
        Self {
            high,
            low: low - (high - self.high),
        }
    }
}
