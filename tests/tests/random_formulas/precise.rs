//! Formulas and their derivatives with 71 digits.

use symplectic::Scalar;
use symplectic::nalgebra::SVector;
use symplectic::num_traits::{One, Zero};
use symplectic_formula::System;
use symplectic_formula::derivative::{Scatter, gradient};
use symplectic_formula::evaluate::{Evaluator, Point, Real};
use symplectic_formula::function::Elementary;
use symplectic_formula::graph::{Half, Number, integer};
use symplectic_tests::references::Wide;

/// A number of 71 digits.
#[derive(Clone, Debug)]
struct Precise(Wide);

impl Real for Precise {
    fn number(value: &Number) -> Self {
        let parse = |n: String| Wide::parse(&n).expect("a number");
        Self(parse(value.numer().to_string()) / parse(value.denom().to_string()))
    }

    fn pi() -> Self {
        Self(Wide::one().atan() * Wide::from_f64(4.0))
    }

    fn add(&self, other: &Self) -> Self {
        Self(self.0 + other.0)
    }

    fn multiply(&self, other: &Self) -> Self {
        Self(self.0 * other.0)
    }

    fn power(&self, exponent: &Number) -> Self {
        if exponent.is_integer() {
            let exponent = exponent.numer().to_string().parse();
            return Self(self.0.powi(exponent.expect("a small exponent")));
        }
        Self((self.0.ln() * Self::number(exponent).0).exp())
    }

    fn elementary(&self, function: Elementary) -> Self {
        let x = self.0;
        Self(match function {
            Elementary::Exp => x.exp(),
            Elementary::Ln => x.ln(),
            Elementary::Sin => x.sin(),
            Elementary::Cos => x.cos(),
            Elementary::Tan => x.tan(),
            Elementary::Asin => x.asin(),
            Elementary::Acos => x.acos(),
            Elementary::Atan => x.atan(),
            Elementary::Sinh => x.sinh(),
            Elementary::Cosh => x.cosh(),
            Elementary::Tanh => x.tanh(),
        })
    }

    fn atan2(&self, x: &Self) -> Self {
        Self(Scalar::atan2(self.0, x.0))
    }
}

/// H and its derivatives by the graph of a formula.
pub struct Slopes {
    system: System,
    /// ∂H/∂q and ∂H/∂p
    gradients: [Vec<Scatter>; 2],
}

impl Slopes {
    pub fn new(mut system: System) -> Self {
        let energy = system.energy;
        let gradients = [Half::Q, Half::P]
            .map(|half| gradient(&mut system.graph, energy, &[], integer(1), half));
        Self { system, gradients }
    }

    /// H
    pub fn energy<const D: usize>(&self, q: &SVector<f64, D>, p: &SVector<f64, D>) -> Wide {
        let point = point([q, p]);
        let mut evaluator = Evaluator::new(&self.system.graph, &point);
        evaluator.value(self.system.energy).expect("a value").0
    }

    /// Velocity and force.
    pub fn first<const D: usize>(
        &mut self,
        q: &SVector<f64, D>,
        p: &SVector<f64, D>,
    ) -> (Vec<Wide>, Vec<Wide>) {
        let point = point([q, p]);
        (self.slope(Half::P, &point), self.slope(Half::Q, &point))
    }

    /// The derivatives of the velocity by position and by momentum, and those of the force by position, by rows: by differences, with
    /// an error of 10⁻⁴⁰ times a third derivative.
    pub fn second<const D: usize>(
        &self,
        q: &SVector<f64, D>,
        p: &SVector<f64, D>,
    ) -> [Vec<Wide>; 3] {
        let blocks = [(Half::P, 0), (Half::P, 1), (Half::Q, 0)];
        blocks.map(|(of, by)| {
            let mut matrix = vec![Wide::zero(); D * D];
            let small = Wide::from_f64(1e-20);
            for k in 0..D {
                let [high, low] = [small, -small].map(|shift| {
                    let mut point = point([q, p]);
                    let x = &mut point.halves[by][k][0];
                    *x = Precise(x.0 + shift);
                    self.slope(of, &point)
                });
                for i in 0..D {
                    matrix[i * D + k] = (high[i] - low[i]) / (small + small);
                }
            }
            matrix
        })
    }

    /// The velocity for `P`, the force for `Q`.
    fn slope(&self, half: Half, point: &Point<Precise>) -> Vec<Wide> {
        let (parts, sign) = match half == Half::P {
            true => (&self.gradients[1], Wide::one()),
            false => (&self.gradients[0], -Wide::one()),
        };
        let sum = Evaluator::new(&self.system.graph, point).sum(parts);
        let sum = sum.expect("values");
        sum.iter()
            .map(|components| components[0].0 * sign)
            .collect()
    }
}

/// The point, at the parameter g = 5/4.
fn point<const D: usize>(halves: [&SVector<f64, D>; 2]) -> Point<Precise> {
    let precise = |x: f64| Precise(Wide::from_f64(x));
    Point {
        time: precise(0.3),
        halves: halves.map(|half| half.iter().map(|&x| vec![precise(x)]).collect()),
        parameters: vec![vec![vec![precise(1.25)]]],
        pairs: vec![Vec::new()],
    }
}
