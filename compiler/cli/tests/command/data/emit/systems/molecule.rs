// The system Molecule: H = (1/2) Σ(0 ≤ i < N) (p[i][0]² + p[i][1]² + p[i][2]²)/m[i] + (1/2) Σ((j′, j″) in springs) stiffness[j] (√((q[j′][0] − q[j″][0])² + (q[j′][1] − q[j″][1])² + (q[j′][2] − q[j″][2])²) − length[j])² − Σ(0 ≤ i < N) Σ(i+1 ≤ k < N) G m[i] m[k]/√((q[i][0] − q[k][0])² + (q[i][1] − q[k][1])² + (q[i][2] − q[k][2])²)
// The formula's q[i][k] is the entry 3 i + k of q, counted from 0; p likewise.
//
// Usage:
//
//     let system = Molecule { m: ..., springs: ..., stiffness: ..., length: ..., G: 0.125 };
/// A length that the formula leaves open: set it here.
pub const LENGTH_N: usize = 4;

/// A length that the formula leaves open: set it here.
#[allow(non_upper_case_globals)]
pub const LENGTH_springs: usize = 4;

#[allow(non_snake_case)]
#[derive(Clone, Copy, Debug)]
pub struct Molecule {
    pub m: [f64; LENGTH_N],
    pub springs: [(usize, usize); LENGTH_springs],
    pub stiffness: [f64; LENGTH_springs],
    pub length: [f64; LENGTH_springs],
    pub G: f64,
}

/// The number of coordinates.
pub const DIMENSION: usize = 3 * LENGTH_N;

#[allow(unused_mut, unused_variables, non_snake_case)]
impl System<DIMENSION> for Molecule {
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
            for k in i + 1..LENGTH_N {
                let x5 = q[3 * i + 2] - q[3 * k + 2];
                let x6 = q[3 * i] - q[3 * k];
                let x7 = q[3 * i + 1] - q[3 * k + 1];
                let x8 = x6 * x6 + x7 * x7 + x5 * x5;
                let x9 = x4 * self.m[k] / (x8 * f64::sqrt(x8));
                let x10 = x5 * x9;
                x1 += x10;
                let x11 = x7 * x9;
                x2 += x11;
                let x12 = x6 * x9;
                x3 += x12;
                f[3 * k] += x12;
                f[3 * k + 1] += x11;
                f[3 * k + 2] += x10;
            }
            f[3 * i] += -x3;
            f[3 * i + 1] += -x2;
            f[3 * i + 2] += -x1;
        }
        for (j, &(j_0, j_1)) in self.springs.iter().enumerate() {
            if j_0 >= LENGTH_N || j_1 >= LENGTH_N {
                return [f64::NAN; DIMENSION];
            }
            let x13 = q[3 * j_0] - q[3 * j_1];
            let x14 = q[3 * j_0 + 1] - q[3 * j_1 + 1];
            let x15 = q[3 * j_0 + 2] - q[3 * j_1 + 2];
            let x16 = f64::sqrt(x13 * x13 + x14 * x14 + x15 * x15);
            let x17 = self.stiffness[j] * (x16 - self.length[j]) / x16;
            let x18 = x13 * x17;
            f[3 * j_0] += -x18;
            let x19 = x14 * x17;
            f[3 * j_0 + 1] += -x19;
            let x20 = x15 * x17;
            f[3 * j_0 + 2] += -x20;
            f[3 * j_1] += x18;
            f[3 * j_1 + 1] += x19;
            f[3 * j_1 + 2] += x20;
        }
        f
    }
}

#[allow(unused_variables, non_snake_case)]
impl Molecule {
    /// H
    pub fn energy(&self, t: f64, q: &[f64; DIMENSION], p: &[f64; DIMENSION]) -> f64 {
        let mut x1 = 0.0;
        let mut x2 = 0.0;
        let mut x3 = 0.0;
        for i in 0..LENGTH_N {
            let mut x4 = 0.0;
            let x5 = self.G * self.m[i];
            for k in i + 1..LENGTH_N {
                let x6 = q[3 * i] - q[3 * k];
                let x7 = q[3 * i + 1] - q[3 * k + 1];
                let x8 = q[3 * i + 2] - q[3 * k + 2];
                x4 += x5 * self.m[k] / f64::sqrt(x6 * x6 + x7 * x7 + x8 * x8);
            }
            x1 += 1.0 / self.m[i] * (p[3 * i] * p[3 * i] + p[3 * i + 1] * p[3 * i + 1] + p[3 * i + 2] * p[3 * i + 2]);
            x3 += x4;
        }
        for (j, &(j_0, j_1)) in self.springs.iter().enumerate() {
            if j_0 >= LENGTH_N || j_1 >= LENGTH_N {
                return f64::NAN;
            }
            let x9 = q[3 * j_0] - q[3 * j_1];
            let x10 = q[3 * j_0 + 1] - q[3 * j_1 + 1];
            let x11 = q[3 * j_0 + 2] - q[3 * j_1 + 2];
            let x12 = f64::sqrt(x9 * x9 + x10 * x10 + x11 * x11) - self.length[j];
            x2 += self.stiffness[j] * (x12 * x12);
        }
        0.5 * x1 + 0.5 * x2 - x3
    }
}
