//! What the macros emit for a splitting whose matrices are too large to write out.

use crate::contract::{
    Failure, General, Outcome, Plan, Solver, Step, StepStatistics, Stopping, System, WarmStart,
};
use crate::number::{Summation, Vector};

/// The lower triangular matrix with the entry `weights[j]` in row `i` for `j < i`, and for `j = i` if `own`; the other entries are `zero`.
/// These are `a` and `ã` of a splitting.
///
/// ```
/// const A: [[f64; 3]; 3] = symplectic::emitted::lower_triangular([0.25, 0.5, 0.25], 0.0, false);
/// assert_eq!(A, [[0.0, 0.0, 0.0], [0.25, 0.0, 0.0], [0.25, 0.5, 0.0]]);
/// ```
pub const fn lower_triangular<T: Copy, const N: usize>(
    weights: [T; N],
    zero: T,
    own: bool,
) -> [[T; N]; N] {
    let mut matrix = [[zero; N]; N];
    let mut i = 0;
    while i < N {
        let steps = if own { i + 1 } else { i };
        let mut j = 0;
        while j < steps {
            matrix[i][j] = weights[j];
            j += 1;
        }
        i += 1;
    }
    matrix
}

/// The rows of a matrix, in the form of [`Coefficients`](crate::solver::Coefficients).
pub const fn rows<T, const N: usize>(matrix: &[[T; N]; N]) -> [&[T]; N] {
    let mut rows: [&[T]; N] = [&[]; N];
    let mut i = 0;
    while i < N {
        rows[i] = &matrix[i];
        i += 1;
    }
    rows
}

/// The plan for general Hamiltonians of a splitting with more than 36 stages: it does not exist. Code that steps a system with such a
/// Hamiltonian by the method does not compile, because the plan is not [`Possible`](crate::contract::Possible).
///
/// Such a step would have to solve for every stage, and the method would still have order 1 or 2.
#[derive(Clone, Copy, Debug)]
pub struct SeparableOnly;

impl Plan for SeparableOnly {
    type Class = General;
    type Memory<V: Vector, S: System<V>, N: Solver<V, S>> = crate::method::Evaluations<V>;

    fn take<R: Summation, V: Vector, S: System<V, Class = General>, N: Solver<V, S>>(
        _step: &Step<'_, V>,
        _system: &S,
        _memory: &mut crate::method::Evaluations<V>,
        _kept: WarmStart,
        _stopping: Stopping,
        _outcome: Outcome<'_, V>,
    ) -> Result<StepStatistics, Failure> {
        unreachable!("no method is `ProvedFor<General>` with this plan")
    }
}
