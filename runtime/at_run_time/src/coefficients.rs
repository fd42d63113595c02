//! The coefficients of a tableau at run time.

use alloc::vec::Vec;

use symplectic_core::solver::{Coefficient, Coefficients};

/// The coefficients of a method with s stages, each the double nearest to the exact number.
///
/// ```text
/// Q_i = q0 + h Σ_j a_ij velocity_j      q1 = q0 + h Σ_i b_i velocity_i      velocity_i at t0 + c̃_i h
/// P_i = p0 + h Σ_j ã_ij force_j         p1 = p0 + h Σ_i b̃_i force_i         force_i at t0 + c_i h
/// ```
///
/// `Tableau::to_f64` of the package `symplectic-compiler` has the same fields, and so have its files in JSON and TOML.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunTimeCoefficients {
    /// `a_ij`, by rows.
    pub a: Vec<Vec<f64>>,
    /// `ã_ij`, by rows.
    pub a_tilde: Vec<Vec<f64>>,
    /// `b_i`
    pub b: Vec<f64>,
    /// `b̃_i`
    pub b_tilde: Vec<f64>,
    /// `c_i = Σ_j a_ij`
    pub c: Vec<f64>,
    /// `c̃_i = Σ_j ã_ij`
    pub c_tilde: Vec<f64>,
    /// `g_i` of gradient kicks, which only emitted methods take: a tableau at run time has none.
    pub gradient: Vec<f64>,
}

/// The coefficients of an emitted method: `Midpoint::COEFFICIENTS.into()`.
impl From<Coefficients> for RunTimeCoefficients {
    fn from(exact: Coefficients) -> Self {
        let doubles = |list: &[Coefficient]| list.iter().map(|x| x.double()).collect();
        let matrix = |rows: &[&[Coefficient]]| rows.iter().map(|row| doubles(row)).collect();
        Self {
            a: matrix(exact.a),
            a_tilde: matrix(exact.a_tilde),
            b: doubles(exact.b),
            b_tilde: doubles(exact.b_tilde),
            c: doubles(exact.c),
            c_tilde: doubles(exact.c_tilde),
            gradient: doubles(exact.gradient),
        }
    }
}
