//! The coefficients of a method, rounded once for each type of scalar.

/// A coefficient of a method: the exact number, rounded to double and to single precision.
///
/// Rounding a number to a double and then to a single may not give the nearest single. The double may lie midway between two singles. The
/// single is therefore rounded from the exact number as well. Scalars with more digits than a double use a second double, which extends the
/// number to 106 bits.
///
/// ```
/// use symplectic::solver::Coefficient;
///
/// const THIRD: Coefficient = Coefficient::new(1.0 / 3.0, 1.850371707708594e-17, 0.33333334);
/// assert_eq!(THIRD.double() as f32, THIRD.single());
/// // The double is below 1/3 by what the other one holds.
/// assert_eq!(3.0_f64.mul_add(-THIRD.double(), 1.0), 3.0 * THIRD.low());
///
/// const HALF: Coefficient = Coefficient::exact(0.5);
/// assert_eq!((HALF.double(), HALF.low(), HALF.single()), (0.5, 0.0, 0.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficient {
    double: f64,
    low: f64,
    single: f32,
}

impl Coefficient {
    /// The coefficient x whose nearest double is `double`, whose nearest single is `single`, and for which `low` is the double nearest to
    /// x − `double`. The single is infinite if x exceeds the largest one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn new(double: f64, low: f64, single: f32) -> Self {
        Self {
            double,
            low,
            single,
        }
    }

    /// The coefficient that is this double, exactly.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn exact(value: f64) -> Self {
        Self::new(value, 0.0, value as f32)
    }

    /// The nearest double.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn double(self) -> f64 {
        self.double
    }

    /// The double nearest to x − [`double`](Self::double) for the coefficient x.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn low(self) -> f64 {
        self.low
    }

    /// The nearest single; infinite above the largest single.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn single(self) -> f32 {
        self.single
    }
}

/// [`Coefficient::exact`], as generated code writes it.
pub const fn exact(value: f64) -> Coefficient {
    Coefficient::exact(value)
}

/// The coefficient x whose nearest double is `double`, with the double `low` nearest to x − `double`; its nearest single is that of
/// `double`.
pub const fn rounded(double: f64, low: f64) -> Coefficient {
    Coefficient::new(double, low, double as f32)
}

/// The coefficients of a [`Method`](crate::Method) with s stages: every matrix has s rows of s entries, and every
/// other list has s entries.
///
/// ```
/// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
/// use symplectic::Method;
/// use symplectic::solver::Coefficient;
///
/// assert_eq!(Midpoint::COEFFICIENTS.a, [[Coefficient::exact(0.5)]]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// `a_ij`: the position stages from the velocities.
    pub a: &'static [&'static [Coefficient]],
    /// `ã_ij`: the momentum stages from the forces.
    pub a_tilde: &'static [&'static [Coefficient]],
    /// `b_i`: the weights of the velocities.
    pub b: &'static [Coefficient],
    /// `b̃_i`: the weights of the forces.
    pub b_tilde: &'static [Coefficient],
    /// `c_i = Σ_j a_ij`.
    pub c: &'static [Coefficient],
    /// `c̃_i = Σ_j ã_ij`.
    pub c_tilde: &'static [Coefficient],
    /// `g_i` of gradient kicks; empty for methods without such kicks.
    pub gradient: &'static [Coefficient],
}

/// The matrices and the weights, each for positions and for momenta.
type Matrices = [&'static [&'static [Coefficient]]; 2];
type Weights = [&'static [Coefficient]; 2];

impl Coefficients {
    /// Those of a method without gradient kicks.
    #[doc(hidden)]
    pub const fn new([a, a_tilde]: Matrices, [b, b_tilde]: Weights, [c, c_tilde]: Weights) -> Self {
        Self {
            a,
            a_tilde,
            b,
            b_tilde,
            c,
            c_tilde,
            gradient: &[],
        }
    }
}
