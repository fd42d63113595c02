//! The linear systems of a Newton iteration.

use alloc::vec::Vec;
use core::fmt::Debug;
use core::marker::PhantomData;

use super::every_stage::{AllStages, EveryStage, NOT_FINITE};
use super::jacobian::Derivatives;
use symplectic_core::solver::{Failure, Visit, Words, scalar_words};
use symplectic_core::system::{BandMatrix, Class, Jacobian};
use symplectic_core::{Scalar, System, Vector};
use symplectic_linearisation::{Complex, Elimination};

/// Coupling between the parts of the unknown of a linear system: the factor `γ` in `(1 − γ J) x = r`.
///
/// For a separable system `J` is `∂velocity/∂p · ∂force/∂q`, n×n, with `γ ~ h²`. For a general system it is
/// `∂(velocity, force)/∂(q, p)`, 2n×2n, with `γ ~ h`; there the components of a vector are `q_1, p_1, q_2, p_2, …`
#[derive(Clone, Copy, Debug)]
pub enum Coupling<'a> {
    /// A real number.
    Real(f64),
    /// A complex number, by its real and imaginary part; the unknown has two parts, `x_1 + i x_2`.
    Complex(f64, f64),
    /// Matrices over the stages. The columns of `J` that belong to positions are multiplied by the first matrix, those that belong
    /// to momenta by the second. For a separable system all columns are multiplied by the first.
    Stages {
        /// The number of stages, and of parts of the unknown.
        count: usize,
        /// By rows.
        positions: &'a [f64],
        /// By rows.
        momenta: &'a [f64],
    },
}

/// The number of parts of the unknown of a linear system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parts {
    /// One: [`Coupling::Real`].
    One,
    /// Two: [`Coupling::Complex`].
    Two,
    /// One per stage: [`Coupling::Stages`].
    Stages(usize),
}

impl Parts {
    /// The number of parts.
    pub const fn count(self) -> usize {
        match self {
            Self::One => 1,
            Self::Two => 2,
            Self::Stages(count) => count,
        }
    }
}

/// Solves the linear systems of a [`Newton`](crate::Newton) iteration for a system `S` over the vectors `V`.
///
/// [`BandOrDense`], [`Dense`] and [`Banded`] store matrices. A solver without matrices, such as a Krylov method, stores the point in
/// [`linearize`](Self::linearize). In [`factor`](Self::factor) it computes at most a preconditioner, and in
/// [`solve`](Self::solve) it applies the derivatives of the system. It need not solve more exactly than the iteration has to contract.
pub trait LinearSolver<V: Vector, S: System<V>>: Copy + Debug + 'static {
    /// Its memory, allocated once and used for every step.
    type Memory: Clone + Debug;

    /// Allocates the memory, for vectors of the dimension of `prototype` and linear systems with these parts.
    fn memory(prototype: &V, systems: &[Parts]) -> Self::Memory;

    /// Passes to `visit` all numbers that the next step uses, such as the factors of the linear systems: a checkpoint stores them.
    fn words(memory: &mut Self::Memory, visit: &mut Visit<'_>);

    /// Evaluates the derivatives at `(time, q, p)` for the following calls; returns whether they are finite.
    fn linearize(memory: &mut Self::Memory, system: &S, time: V::Scalar, q: &V, p: &V) -> bool;

    /// Prepares the linear system with this number, from 0; returns whether it is regular.
    fn factor(memory: &mut Self::Memory, system: &S, number: usize, coupling: Coupling<'_>)
    -> bool;

    /// Solves the linear system with this number: `unknown` holds the right-hand side, component by component with all
    /// its parts.
    fn solve(memory: &mut Self::Memory, system: &S, number: usize, unknown: &mut [V::Scalar]);

    /// Writes `∂velocity/∂p · vector`; called for separable systems only.
    fn velocity_by_momentum(
        memory: &Self::Memory,
        system: &S,
        vector: &[V::Scalar],
        product: &mut [V::Scalar],
    );

    /// Writes `∂force/∂q · vector`; called for separable systems only.
    fn force_by_position(
        memory: &Self::Memory,
        system: &S,
        vector: &[V::Scalar],
        product: &mut [V::Scalar],
    );

    /// Whether [`correct`](Self::correct) is implemented.
    const EVERY_STAGE: bool = false;

    /// Full Newton: evaluates the derivatives at every stage, and turns residuals into corrections, in place. `x` holds the residuals of
    /// `h velocity` and `y` those of `h force`, stage by stage. For a general system `x` holds both, alternating component by component.
    ///
    /// [`Newton`](crate::Newton) calls it if derivatives at one point contract too slowly.
    ///
    /// # Errors
    ///
    /// [`Failure::NonFinite`] if a derivative is NaN or infinite; [`Failure::SingularMatrix`] if the linear system is singular.
    fn correct(
        _memory: &mut Self::Memory,
        _system: &S,
        _stages: EveryStage<'_, V>,
        _x: &mut [V::Scalar],
        _y: &mut [V::Scalar],
    ) -> Result<(), Failure> {
        Err(Failure::SingularMatrix)
    }
}

/// Band matrices with the [half bandwidth](System::half_bandwidth) of the system, and derivatives from `D`. A system with an unknown
/// half bandwidth gets full matrices.
#[derive(Clone, Copy, Debug, Default)]
pub struct BandOrDense<D>(PhantomData<D>);

/// Full matrices, with derivatives from `D`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dense<D>(PhantomData<D>);

/// Band matrices, with derivatives from `D`: a component depends only on the `HALF` components before and after it.
///
/// Entries outside the band are neglected. If they are small, the iteration is slower, but its result is never wrong.
#[derive(Clone, Copy, Debug, Default)]
pub struct Banded<const HALF: usize, D>(PhantomData<D>);

/// The memory of [`BandOrDense`], [`Dense`] and [`Banded`].
#[derive(Clone, Debug)]
pub struct Matrices<T, D> {
    derivatives: D,
    systems: Vec<Parts>,
    jacobian: Jacobian<T>,
    /// The matrix `J` of [`Coupling`].
    matrix: BandMatrix<T>,
    factors: Vec<Factors<T>>,
    /// Allocated when first needed.
    all_stages: Option<AllStages<T>>,
}

/// The factors of one linear system.
#[derive(Clone, Debug)]
enum Factors<T> {
    Real(Elimination<T>),
    Complex(Elimination<Complex<T>>),
}

impl<T: Scalar, D> Matrices<T, D> {
    fn new(
        dimension: usize,
        half_bandwidth: usize,
        separable: bool,
        systems: &[Parts],
        derivatives: D,
    ) -> Self {
        let mut matrices = Self {
            derivatives,
            systems: systems.to_vec(),
            jacobian: Jacobian::new(dimension, 0),
            matrix: BandMatrix::new(0, 0),
            factors: Vec::new(),
            all_stages: None,
        };
        matrices.allocate(half_bandwidth, separable);
        matrices
    }

    /// Allocates matrices for derivatives of this half bandwidth.
    fn allocate(&mut self, half_bandwidth: usize, separable: bool) {
        let dimension = self.jacobian.force_by_position.size();
        self.jacobian = Jacobian::new(dimension, half_bandwidth);
        let half = self.jacobian.force_by_position.half_bandwidth();
        self.matrix = if separable {
            BandMatrix::new(dimension, 2 * half)
        } else {
            BandMatrix::new(2 * dimension, 2 * half + 1)
        };
        let (size, half) = (self.matrix.size(), self.matrix.half_bandwidth());
        let factors = self.systems.iter().map(|parts| match parts {
            Parts::One => Factors::Real(Elimination::new(size, half)),
            Parts::Two => Factors::Complex(Elimination::new(size, half)),
            Parts::Stages(count) => {
                let half = (half + 1) * count;
                Factors::Real(Elimination::new(size * count, half.saturating_sub(1)))
            }
        });
        self.factors = factors.collect();
        self.all_stages = None;
    }

    /// Allocates new matrices for another half bandwidth; does nothing if it has not changed.
    fn fit(&mut self, half_bandwidth: usize, separable: bool) {
        let matrix = &self.jacobian.force_by_position;
        if matrix.half_bandwidth() != half_bandwidth.min(matrix.size().saturating_sub(1)) {
            self.allocate(half_bandwidth, separable);
        }
    }

    /// Visits the derivatives and the factors computed from them; those of all stages are recomputed in every sweep.
    fn words(&mut self, separable: bool, visit: &mut Visit<'_>) {
        let mut half_bandwidth = self.jacobian.force_by_position.half_bandwidth();
        half_bandwidth.words(visit);
        self.fit(half_bandwidth, separable);
        for matrix in self.jacobian.each_mut() {
            scalar_words(matrix.entries_mut(), visit);
        }
        scalar_words(self.matrix.entries_mut(), visit);
        for factors in &mut self.factors {
            match factors {
                Factors::Real(factors) => factors.words(visit),
                Factors::Complex(factors) => factors.words(visit),
            }
        }
    }

    /// Computes the matrix `J` from the derivatives.
    fn assemble(&mut self, separable: bool) {
        let Jacobian {
            velocity_by_position,
            velocity_by_momentum,
            force_by_position,
            ..
        } = &self.jacobian;
        for i in 0..self.matrix.size() {
            for j in self.matrix.columns(i) {
                let entry = if separable {
                    let inner = velocity_by_momentum.columns(i);
                    let products =
                        inner.map(|k| velocity_by_momentum.get(i, k) * force_by_position.get(k, j));
                    products.fold(T::zero(), |sum, product| sum + product)
                } else {
                    let (k, l) = (i / 2, j / 2);
                    match (i % 2, j % 2) {
                        (0, 0) => velocity_by_position.get(k, l),
                        (0, _) => velocity_by_momentum.get(k, l),
                        (_, 0) => force_by_position.get(k, l),
                        _ => self.jacobian.force_by_momentum(k, l),
                    }
                };
                self.matrix.set(i, j, entry);
            }
        }
    }

    fn factor(&mut self, number: usize, coupling: Coupling<'_>, separable: bool) -> bool {
        let matrix = &self.matrix;
        let unit = |same: bool| if same { T::one() } else { T::zero() };
        match (self.factors.get_mut(number), coupling) {
            (Some(Factors::Real(factors)), Coupling::Real(factor)) => {
                let factor = T::from_f64(factor);
                factors.factor(|i, j| unit(i == j) - factor * matrix.get(i, j))
            }
            (Some(Factors::Complex(factors)), Coupling::Complex(re, im)) => {
                let (re, im) = (T::from_f64(re), T::from_f64(im));
                factors.factor(|i, j| {
                    let entry = matrix.get(i, j);
                    Complex {
                        re: unit(i == j) - re * entry,
                        im: -(im * entry),
                    }
                })
            }
            (
                Some(Factors::Real(factors)),
                Coupling::Stages {
                    count,
                    positions,
                    momenta,
                },
            ) => factors.factor(|row, column| {
                let ((k, i), (l, j)) =
                    ((row / count, row % count), (column / count, column % count));
                let of_position = separable || l % 2 == 0;
                let coupling = if of_position { positions } else { momenta };
                let factor = T::from_f64(coupling[i * count + j]);
                unit(row == column) - factor * matrix.get(k, l)
            }),
            _ => false,
        }
    }

    fn solve(&mut self, number: usize, unknown: &mut [T]) {
        match self.factors.get_mut(number) {
            Some(Factors::Real(factors)) => {
                let (right, unknown) = (factors.right.len(), unknown);
                let unknown = &mut unknown[..right];
                factors.right.copy_from_slice(unknown);
                factors.solve();
                unknown.copy_from_slice(&factors.right);
            }
            Some(Factors::Complex(factors)) => {
                for (right, parts) in factors.right.iter_mut().zip(unknown.chunks_exact(2)) {
                    *right = Complex {
                        re: parts[0],
                        im: parts[1],
                    };
                }
                factors.solve();
                for (right, parts) in factors.right.iter().zip(unknown.chunks_exact_mut(2)) {
                    parts[0] = right.re;
                    parts[1] = right.im;
                }
            }
            None => {}
        }
    }
}

macro_rules! matrices {
    ([$($parameter:tt)*] $name:ty, $least:expr, $half_bandwidth:expr) => {
        impl<V, S, D, $($parameter)*> LinearSolver<V, S> for $name
        where
            V: Vector,
            S: System<V>,
            D: Derivatives<V, S>,
        {
            type Memory = Matrices<V::Scalar, D::Memory>;

            fn memory(prototype: &V, systems: &[Parts]) -> Self::Memory {
                let separable = S::Class::SEPARABLE;
                let derivatives = D::memory(prototype);
                Matrices::new(prototype.dimension(), $least, separable, systems, derivatives)
            }

            fn words(memory: &mut Self::Memory, visit: &mut Visit<'_>) {
                memory.words(S::Class::SEPARABLE, visit);
            }

            fn linearize(
                memory: &mut Self::Memory,
                system: &S,
                time: V::Scalar,
                q: &V,
                p: &V,
            ) -> bool {
                memory.fit($half_bandwidth(system), S::Class::SEPARABLE);
                memory.jacobian.clear();
                let Matrices { derivatives, jacobian, .. } = memory;
                D::evaluate(derivatives, system, time, q, p, jacobian);
                memory.assemble(S::Class::SEPARABLE);
                memory.jacobian.is_finite()
            }

            fn factor(
                memory: &mut Self::Memory,
                _system: &S,
                number: usize,
                coupling: Coupling<'_>,
            ) -> bool {
                memory.factor(number, coupling, S::Class::SEPARABLE)
            }

            fn solve(
                memory: &mut Self::Memory,
                _system: &S,
                number: usize,
                unknown: &mut [V::Scalar],
            ) {
                memory.solve(number, unknown);
            }

            fn velocity_by_momentum(
                memory: &Self::Memory,
                _system: &S,
                vector: &[V::Scalar],
                product: &mut [V::Scalar],
            ) {
                memory.jacobian.velocity_by_momentum.multiply(vector, product);
            }

            fn force_by_position(
                memory: &Self::Memory,
                _system: &S,
                vector: &[V::Scalar],
                product: &mut [V::Scalar],
            ) {
                memory.jacobian.force_by_position.multiply(vector, product);
            }

            const EVERY_STAGE: bool = true;

            fn correct(
                memory: &mut Self::Memory,
                system: &S,
                stages: EveryStage<'_, V>,
                x: &mut [V::Scalar],
                y: &mut [V::Scalar],
            ) -> Result<(), Failure> {
                memory.fit($half_bandwidth(system), S::Class::SEPARABLE);
                let Matrices { derivatives, jacobian, all_stages, .. } = memory;
                let (points, momenta) = (stages.count(), stages.p.len());
                let all = all_stages.get_or_insert_with(|| {
                    AllStages::new(jacobian, points, momenta, S::Class::SEPARABLE)
                });
                for (number, jacobian) in all.jacobians.iter_mut().enumerate() {
                    let (time, q, p) = stages.point(number);
                    jacobian.clear();
                    D::evaluate(derivatives, system, V::Scalar::from_f64(time), q, p, jacobian);
                    if !jacobian.is_finite() {
                        return Err(NOT_FINITE);
                    }
                }
                if S::Class::SEPARABLE {
                    all.correct_separable(&stages, x, y)
                } else {
                    all.correct_general(&stages, x)
                }
            }
        }
    };
}

// The initial half bandwidth, and that of a system.
matrices!([] BandOrDense<D>, 0, |system: &S| system.half_bandwidth());
matrices!([] Dense<D>, usize::MAX, |_: &S| usize::MAX);
matrices!([const HALF: usize] Banded<HALF, D>, HALF, |_: &S| HALF);
