//! The coefficients of coupled stages as matrices.

#[cfg(feature = "alloc")]
use alloc::sync::Arc;
use core::fmt::Debug;
use core::marker::PhantomData;

#[cfg(feature = "alloc")]
use crate::contract::CoupledRows;
use crate::contract::{Class, StagePlan, SystemLanes};
use crate::number::Vector;

/// The coupled stages of a plan as matrices, for solvers that treat all stages at once.
///
/// There may be fewer stages than in the tableau, because equal ones are merged. With `Q_i` the position of the force `i` and `P_i` the
/// momentum of the velocity `i`,
///
/// ```text
/// Q_i = q0 + Σ_j positions_ij u_j    u_j = h b_j velocity_j
/// P_i = p0 + Σ_j momenta_ij w_j      w_j = h b̃_j force_j
/// ```
///
/// if the sums are of [`INCREMENTS`](Self::INCREMENTS); otherwise `u_j = velocity_j` and `w_j = force_j`, with factors of `h` in front of
/// the sums.
pub trait StageTableau: StagePlan {
    /// The lanes that hold the stages.
    type Lanes: SystemLanes;
    /// An array with an entry for each group of lanes; together the groups hold all stages.
    type Groups<T: Debug>: Debug + AsRef<[T]> + AsMut<[T]>;

    /// Whether stages are sums of increments, with `μ_ij = a_ij/b_j` and `μ̃_ij = ã_ij/b̃_j`, rounded so that the method is symplectic.
    /// Otherwise they are sums of evaluations, with `a_ij` and `ã_ij`.
    const INCREMENTS: bool;
    /// Positions, and the forces there.
    const POSITIONS: HalfTableau;
    /// Momenta, and the velocities there.
    const MOMENTA: HalfTableau;
    /// For separable systems with the velocity `M⁻¹p`, M constant; `None` if the method is not symplectic for separable systems.
    const SECOND_ORDER: Option<SecondOrderTableau>;

    /// How the linear systems of a Newton iteration decouple; `None` if they do not, or if this is not known.
    const DECOUPLING: Option<Decoupling> = None;

    /// Whether the coefficients are known only at run time: then the constants are empty, and a plan that is a value has [rows](Self::rows).
    const AT_RUN_TIME: bool = false;

    /// The coefficients of a plan whose coefficients are known only at run time.
    #[cfg(feature = "alloc")]
    #[doc(hidden)]
    fn rows(&self) -> Option<&Arc<CoupledRows>> {
        None
    }

    /// A value for each group of lanes, by its number from 0.
    fn groups<T: Debug>(make: impl FnMut(usize) -> T) -> Self::Groups<T>;

    /// The velocities and the forces that a step has left in its memory.
    fn stored<V: Vector>(stages: &Self::Stages<V>) -> [StoredEvaluations<'_, V>; 2];
}

/// Work with a tableau that is a type.
#[doc(hidden)]
pub trait TableauWork<C: Class> {
    /// The result of the work.
    type Output;

    /// Runs the work with the tableau of a method for systems of class `C`.
    fn run<P: StageTableau<Class = C>>(self) -> Self::Output;
}

/// Velocities or forces as a step leaves them, stage by stage.
#[derive(Clone, Copy, Debug)]
pub struct StoredEvaluations<'a, V> {
    /// One for each stage: the evaluation, or the increment computed from it.
    pub values: &'a [V],
    /// The stages whose evaluations are stored unscaled although others are increments, because the next step begins with them.
    pub carried: &'static [usize],
}

/// The polynomial through the evaluations of a step at its nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StagePolynomial {
    /// For k = 1, …, s − 1 a list with an entry for each stage j. The entry is the coefficient `γ_jk` of the Lagrange polynomial
    /// `ℓ_j = Σ_k γ_jk L_k` in Legendre polynomials on [0, 1]. It is divided by the weight `b_j` if evaluations are stored as increments.
    /// Correctly rounded.
    pub legendre: &'static [&'static [f64]],
    /// The order of its integral: see [`Interpolation`](crate::output::Interpolation).
    pub order: u32,
}

/// The positions or the momenta of a [`StageTableau`]: stage values, and the evaluations at them.
///
/// Every list over the stages has an entry for each lane: the last stage is repeated to fill the lanes.
#[derive(Clone, Copy, Debug)]
pub struct HalfTableau {
    /// The number of stages.
    pub count: usize,
    /// The matrix by its columns, with an entry for each stage: for positions one column for each velocity, for momenta one for each force.
    pub columns: &'static [&'static [f64]],
    /// The times of the evaluations, as fractions of the step.
    pub times: &'static [f64],
    /// The weights of the evaluations in the result of the step.
    pub weights: &'static [f64],
    /// The matrix, by its columns, that extrapolates the increments to the next step of the same size; empty if there is none.
    pub extrapolation: &'static [&'static [f64]],
    /// The polynomial through the evaluations of a step, with as many entries as there are stages. `None` if times coincide or if the
    /// weights are not those of a polynomial.
    pub polynomial: Option<StagePolynomial>,
}

/// The coefficients for second-order systems `q'' = M⁻¹ f(q)`, from which the momentum stages are eliminated (Nyström):
///
/// ```text
/// Q_i = q0 + h c_i v(p0) + h Σ_k ν_ik v(w_k)      q1 = q0 + h v(p0) + h Σ_k (1 − c_k) v(w_k)
/// ```
///
/// with the velocity `v(p) = M⁻¹ p` and the increments `w_k = h b̃_k force_k` of the momentum. The coefficients are rounded so that
/// `ν_ik − ν_ki = c_i − c_k` exactly: the rounded method is symplectic too (Suris, 1989).
#[derive(Clone, Copy, Debug)]
pub struct SecondOrderTableau {
    /// `c_i`
    pub nodes: &'static [f64],
    /// `ν` by its columns.
    pub columns: &'static [&'static [f64]],
    /// `ν_ik b̃_k` by its columns: the factors of the forces themselves, with `h²` in front of the sum.
    pub of_forces: &'static [&'static [f64]],
}

/// Whether the momenta of the stages of this method are eliminated on systems with a [`SecondOrderTableau`].
#[cfg_attr(not(debug_assertions), inline(always))]
pub const fn eliminates<P: StageTableau>() -> bool {
    P::SECOND_ORDER.is_some() && P::Class::SEPARABLE
}

/// The columns up to the last nonzero one: those after it add nothing. If the evaluation of such a column is not finite, this shows in the
/// result of the step but in no stage.
const fn significant(columns: &'static [&'static [f64]]) -> &'static [&'static [f64]] {
    let mut count = columns.len();
    while count > 1 && is_zero(columns[count - 1]) {
        count -= 1;
    }
    columns.split_at(count).0
}

const fn is_zero(column: &[f64]) -> bool {
    let mut i = 0;
    while i < column.len() && column[i] == 0.0 {
        i += 1;
    }
    i == column.len()
}

/// The `significant` columns of the matrices of a plan.
pub struct Columns<P>(PhantomData<P>);

impl<P: StageTableau> Columns<P> {
    /// Those of the positions.
    pub const POSITIONS: &'static [&'static [f64]] = significant(P::POSITIONS.columns);
    /// Those of the momenta.
    pub const MOMENTA: &'static [&'static [f64]] = significant(P::MOMENTA.columns);
    /// The columns for second-order systems; empty if there are no coefficients for them.
    pub const SECOND_ORDER: &'static [&'static [f64]] = match P::SECOND_ORDER {
        Some(tableau) => significant(tableau.columns),
        None => &[],
    };
    /// The columns of [`SECOND_ORDER`](Self::SECOND_ORDER) as factors of the forces.
    pub const OF_FORCES: &'static [&'static [f64]] = match P::SECOND_ORDER {
        Some(tableau) => significant(tableau.of_forces),
        None => &[],
    };
}

/// A transformation `X⁻¹ B X` of a stage matrix to block-diagonal form.
///
/// For a [`Separable`](crate::Separable) system `B = Ã A`, the product of the matrices of momenta and positions, which maps velocities to
/// velocities. For a [`General`](crate::General) system `B = A`, and there is a transformation only if `A = Ã`. Each real eigenvalue is a
/// block, and so is each pair `α ± iω` of complex eigenvalues, `[[α, −ω], [ω, α]]`. The s coupled linear systems, with n unknowns for each
/// velocity, become s systems of n unknowns. These are solved one after the other, two of them as one complex system (Butcher, 1976; Hairer
/// & Wanner, *Solving ODEs II*, IV.8).
#[derive(Clone, Copy, Debug)]
pub struct Decoupling {
    /// The blocks in their order: `(α, ω)`, with `ω = 0` for a real eigenvalue.
    pub blocks: &'static [(f64, f64)],
    /// `X` by rows.
    pub to_stages: &'static [&'static [f64]],
    /// `X⁻¹` by rows.
    pub from_stages: &'static [&'static [f64]],
}
