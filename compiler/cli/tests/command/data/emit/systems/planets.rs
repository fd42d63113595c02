// The system Planets: H = (1/2) Σ(0 ≤ i < N) (p[i][0]² + p[i][1]² + p[i][2]²)/m[i] − Σ(0 ≤ i < N) Σ(i+1 ≤ j < N) G m[i] m[j]/√((q[i][0] − q[j][0])² + (q[i][1] − q[j][1])² + (q[i][2] − q[j][2])²)
// The formula's q[i][k] is the entry 3 i + k of q, counted from 0; p likewise.
//
// Usage:
//
//     let system = Planets { m: ..., G: 1.0 };
/// A length that the formula leaves open: set it here.
pub const LENGTH_N: usize = 3;

#[allow(non_snake_case)]
#[derive(Clone, Copy, Debug)]
pub struct Planets {
    pub m: [f64; LENGTH_N],
    pub G: f64,
}

/// The number of coordinates.
pub const DIMENSION: usize = 3 * LENGTH_N;

#[allow(unused_mut, unused_variables, non_snake_case)]
impl System<DIMENSION> for Planets {
    fn velocity(&self, t: f64, p: &[f64; DIMENSION]) -> [f64; DIMENSION] {
        let mut v = [0.0; DIMENSION];
        for i in 0..LENGTH_N {
            let x1 = 1.0 / self.m[i];
            v[3 * i] = x1 * p[3 * i];
            v[3 * i + 1] = x1 * p[3 * i + 1];
            v[3 * i + 2] = x1 * p[3 * i + 2];
        }
        v
    }

    fn force(&self, t: f64, q: &[f64; DIMENSION]) -> [f64; DIMENSION] {
        let mut f = [0.0; DIMENSION];
        for i in 0..LENGTH_N {
            let mut x1 = 0.0;
            let mut x2 = 0.0;
            let mut x3 = 0.0;
            let x4 = self.G * self.m[i];
            for j in i + 1..LENGTH_N {
                let x5 = q[3 * i + 2] - q[3 * j + 2];
                let x6 = q[3 * i] - q[3 * j];
                let x7 = q[3 * i + 1] - q[3 * j + 1];
                let x8 = x6 * x6 + x7 * x7 + x5 * x5;
                let x9 = x4 * self.m[j] / (x8 * f64::sqrt(x8));
                let x10 = x5 * x9;
                x1 += x10;
                let x11 = x7 * x9;
                x2 += x11;
                let x12 = x6 * x9;
                x3 += x12;
                f[3 * j] += x12;
                f[3 * j + 1] += x11;
                f[3 * j + 2] += x10;
            }
            f[3 * i] += -x3;
            f[3 * i + 1] += -x2;
            f[3 * i + 2] += -x1;
        }
        f
    }
}

#[allow(unused_variables, non_snake_case)]
impl Planets {
    /// H
    pub fn energy(&self, t: f64, q: &[f64; DIMENSION], p: &[f64; DIMENSION]) -> f64 {
        let mut x1 = 0.0;
        let mut x2 = 0.0;
        for i in 0..LENGTH_N {
            let mut x3 = 0.0;
            let x4 = self.G * self.m[i];
            for j in i + 1..LENGTH_N {
                let x5 = q[3 * i] - q[3 * j];
                let x6 = q[3 * i + 1] - q[3 * j + 1];
                let x7 = q[3 * i + 2] - q[3 * j + 2];
                x3 += x4 * self.m[j] / f64::sqrt(x5 * x5 + x6 * x6 + x7 * x7);
            }
            x1 += 1.0 / self.m[i] * (p[3 * i] * p[3 * i] + p[3 * i + 1] * p[3 * i + 1] + p[3 * i + 2] * p[3 * i + 2]);
            x2 += x3;
        }
        0.5 * x1 - x2
    }
}
