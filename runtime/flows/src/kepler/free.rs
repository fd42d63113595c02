//! A body that moves freely.

use symplectic_core::inside::{fast_two_sum, two_sum};

/// A free body. Its displacement is the same in all steps, and so would be the rounding errors: displacement and position are sums of two
/// doubles.
#[derive(Clone, Debug)]
pub(super) struct Free {
    mass: f64,
    /// What rounding has left of the last position.
    pub(super) low: [f64; 3],
    pub(super) place: [f64; 3],
    /// The last time and momentum, and their displacement.
    size: f64,
    momentum: [f64; 3],
    way: [[f64; 2]; 3],
}

impl Free {
    pub(super) const fn new(mass: f64) -> Self {
        Self {
            mass,
            low: [0.0; 3],
            place: [0.0; 3],
            size: 0.0,
            momentum: [0.0; 3],
            way: [[0.0; 2]; 3],
        }
    }

    /// Moves the body for the time `h`.
    pub(super) fn move_on(&mut self, h: f64, q: &mut [f64; 3], p: &[f64; 3]) {
        if h != self.size || *p != self.momentum {
            (self.size, self.momentum) = (h, *p);
            self.way = p.map(|p| {
                let (product, rest) = exact_product(h, p);
                let way = product / self.mass;
                let (found, error) = exact_product(way, self.mass);
                let rest = ((product - found) - error + rest) / self.mass;
                // The halves of huge numbers overflow.
                [way, if rest.is_finite() { rest } else { 0.0 }]
            });
        }
        // What is left belongs to the last position only.
        if *q != self.place {
            self.low = [0.0; 3];
        }
        for ((q, low), [way, rest]) in q.iter_mut().zip(&mut self.low).zip(self.way) {
            let (sum, left) = two_sum(*q, way);
            (*q, *low) = fast_two_sum(sum, left + (*low + rest));
        }
        self.place = *q;
    }
}

/// The product and its rounding error (Dekker). The error of numbers whose halves overflow is not finite.
fn exact_product(a: f64, b: f64) -> (f64, f64) {
    let halves = |x: f64| {
        let big = 134_217_729.0 * x;
        let high = big - (big - x);
        [high, x - high]
    };
    let ([a1, a2], [b1, b2]) = (halves(a), halves(b));
    let product = a * b;
    let error = a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2);
    (product, error)
}
