//! Methods that are known only at run time: a tableau is a value instead of a type.

mod decoupling;
mod error;
mod plan;
mod schedule;

use alloc::string::{String, ToString};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt::Write as _;

pub use error::TableauError;
pub use plan::{RunTimePlan, RunTimeStages};
use schedule::NO_STAGES;
pub use schedule::{Coupled, Half};
pub(crate) use schedule::{Kind, MAX_EVALUATIONS, Row, Schedule, Splitting};

use crate::contract::{
    Class, ConstrainedStep, Frictionless, General, Method, Orders, ProvedFor, Separable,
};
use crate::number::{Coefficient, Coefficients};

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
        }
    }
}

/// A symplectic partitioned Runge–Kutta method that is known only at run time: derived by the program, or read from a file.
///
/// [`Integrator::at_run_time`](crate::Integrator::at_run_time) steps a system with it. Steps take longer than those of a method that a
/// macro emits, by a factor measured in the guide.
///
/// It is symplectic as rounded, like emitted methods: stages are sums of increments with `μ_ij = a_ij/b_j` and `μ̃_ij = ã_ij/b̃_j`. The
/// larger of the two is rounded and the other is its exact complement, so that `μ̃_ij + μ_ji = 1`. Coefficients are known to 53 bits,
/// whatever the scalar.
///
/// A copy shares the coefficients.
///
/// ```
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{Integrator, Orders, RunTimeCoefficients, RunTimeTableau, State, acceleration};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// // The midpoint rule.
/// let midpoint = RunTimeCoefficients {
///     a: vec![vec![0.5]],
///     a_tilde: vec![vec![0.5]],
///     b: vec![1.0],
///     b_tilde: vec![1.0],
///     c: vec![0.5],
///     c_tilde: vec![0.5],
/// };
/// let orders = Orders { general: 2, separable: 2, nystrom: 2 };
/// let midpoint = RunTimeTableau::new("midpoint", &midpoint, orders)?;
///
/// let pendulum = acceleration(|_time, q: &Vector1<f64>, acceleration| acceleration[0] = -q[0].sin());
/// let start = State::from_arrays(0.0, [1.0], [0.0]);
/// let mut integrator = Integrator::at_run_time(&midpoint, pendulum, start, 0.1)?;
/// integrator.integrate_to(10.0)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RunTimeTableau {
    data: Arc<Data>,
    accepts_lower_order: bool,
    holonomic: &'static [ConstrainedStep],
    nonholonomic: &'static [ConstrainedStep],
}

/// The coupled stages of a tableau for systems of class `C`; none without a tableau, or if its steps are drifts and kicks.
#[inline]
pub fn coupled<C: Class>(tableau: Option<&RunTimeTableau>) -> &Coupled {
    match tableau.map(RunTimeTableau::schedule::<C>) {
        Some(Schedule::Coupled(coupled)) => coupled,
        _ => &NO_STAGES,
    }
}

#[derive(Debug, PartialEq)]
struct Data {
    name: String,
    orders: Orders,
    coefficients: RunTimeCoefficients,
    separable: Schedule,
    general: Schedule,
}

impl RunTimeTableau {
    /// The method with these coefficients. `orders` are its orders for each class of Hamiltonians, as found by the compiler; they decide
    /// for which systems the method is refused.
    ///
    /// # Errors
    ///
    /// [`TableauError`], with the row that is wrong:
    ///
    /// * [`Shape`](TableauError::Shape) and [`NotFinite`](TableauError::NotFinite);
    /// * [`Weights`](TableauError::Weights) if weights do not sum to 1;
    /// * [`Node`](TableauError::Node) if a node is not the sum of its row;
    /// * [`NotSymplectic`](TableauError::NotSymplectic) if `b_i ã_ij + b̃_j a_ji` is not `b_i b̃_j`. All except the first two are tested up
    ///   to rounding of the coefficients.
    pub fn new(
        name: &str,
        coefficients: &RunTimeCoefficients,
        orders: Orders,
    ) -> Result<Self, TableauError> {
        error::check(coefficients)?;
        Ok(Self {
            data: Arc::new(Data {
                name: name.to_string(),
                orders,
                coefficients: coefficients.clone(),
                separable: Schedule::new(coefficients, true),
                general: Schedule::new(coefficients, false),
            }),
            accepts_lower_order: false,
            holonomic: &[],
            nonholonomic: &[],
        })
    }

    /// The same method for every system, even if its order is lower or it is not symplectic.
    #[must_use]
    pub fn accept_lower_order(self) -> Self {
        Self {
            accepts_lower_order: true,
            ..self
        }
    }

    /// The same method with its steps for systems with holonomic and with non-holonomic constraints: the constants
    /// [`CONSTRAINED`](Method::CONSTRAINED) and [`NONHOLONOMIC`](Method::NONHOLONOMIC) of an emitted method, empty if it has no such steps.
    /// `emit::constrained_steps` of the package `symplectic-compiler` computes them; a program makes them static by `Box::leak`.
    ///
    /// ```
    /// use symplectic::{Integrator, Method, RunTimeTableau, State};
    ///
    /// symplectic::tableau! { Rattle { basis: polynomial(2), nodes: lobatto(2) } }
    /// symplectic::hamiltonian! { Rod q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + y constraints: { rod = x^2 + y^2 - 1 } }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let rattle = RunTimeTableau::new("RATTLE", &Rattle::COEFFICIENTS.into(), Rattle::ORDERS)?;
    /// let rattle = rattle.with_constrained_steps(Rattle::CONSTRAINED, Rattle::NONHOLONOMIC);
    /// let start = State::from_arrays(0.0, [1.0, 0.0], [0.0; 2]);
    /// let mut run = Integrator::at_run_time(&rattle, Rod, start.clone(), 0.1)?;
    /// let mut emitted = Integrator::new(Rattle, Rod, start, 0.1)?;
    /// assert_eq!(run.integrate_to(10.0)?, emitted.integrate_to(10.0)?);
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    pub fn with_constrained_steps(
        self,
        holonomic: &'static [ConstrainedStep],
        nonholonomic: &'static [ConstrainedStep],
    ) -> Self {
        Self {
            holonomic,
            nonholonomic,
            ..self
        }
    }

    /// Its steps for systems with holonomic constraints.
    pub(crate) fn holonomic(&self) -> &'static [ConstrainedStep] {
        self.holonomic
    }

    /// Its steps for systems with non-holonomic constraints.
    pub(crate) fn nonholonomic(&self) -> &'static [ConstrainedStep] {
        self.nonholonomic
    }

    /// Name of the method.
    pub fn name(&self) -> &str {
        &self.data.name
    }

    /// Number of stages s.
    pub fn stages(&self) -> usize {
        self.data.coefficients.b.len()
    }

    /// Its order for each class of Hamiltonians, as it was given.
    pub fn orders(&self) -> Orders {
        self.data.orders
    }

    /// The coefficients, as they were given.
    pub fn coefficients(&self) -> &RunTimeCoefficients {
        &self.data.coefficients
    }

    /// Whether a step of a separable system is explicit: drifts and kicks, one after the other.
    pub fn is_explicit(&self) -> bool {
        matches!(self.data.separable, Schedule::Splitting(_))
    }

    /// Whether it keeps its properties for general Hamiltonians: it is symplectic, which needs `b = b̃`, and has the same order.
    pub(crate) fn keeps_its_order_in_general(&self) -> bool {
        let Orders {
            general, separable, ..
        } = self.data.orders;
        let RunTimeCoefficients { b, b_tilde, .. } = &self.data.coefficients;
        let mut weights = b.iter().zip(b_tilde);
        let are_equal = |(b, b_tilde): (&f64, &f64)| error::is_about(*b, *b_tilde, 0);
        self.accepts_lower_order || general >= separable && weights.all(are_equal)
    }

    /// The orders, if the higher one requires a quadratic kinetic energy and a lower order is not accepted.
    #[doc(hidden)]
    pub fn needs_quadratic_kinetic(&self) -> Option<Orders> {
        let Orders {
            separable, nystrom, ..
        } = self.data.orders;
        (!self.accepts_lower_order && nystrom > separable).then_some(self.data.orders)
    }

    /// The schedule of its steps for systems of class `C`.
    #[inline]
    pub(crate) fn schedule<C: Class>(&self) -> &Schedule {
        if C::SEPARABLE {
            &self.data.separable
        } else {
            &self.data.general
        }
    }

    /// All coefficients, bit by bit; checkpoints are compared by them.
    pub(crate) fn definition(&self) -> String {
        let RunTimeCoefficients {
            a,
            a_tilde,
            b,
            b_tilde,
            c,
            c_tilde,
        } = &self.data.coefficients;
        let mut text = String::from("at run time:");
        let lists = [b, b_tilde, c, c_tilde].into_iter();
        for value in lists.chain(a).chain(a_tilde).flatten() {
            let written = write!(text, " {:016x}", value.to_bits());
            debug_assert!(written.is_ok(), "a string takes all");
        }
        text
    }
}

/// The method of an integrator [at run time](crate::Integrator::at_run_time): its coefficients are in a [`RunTimeTableau`].
#[derive(Clone, Copy, Debug)]
pub struct AtRunTime(());

impl Method for AtRunTime {
    const NAME: &'static str = "the tableau at run time";
    const STAGES: usize = 0;
    const DEFINITION: &'static str = "at run time";
    const COEFFICIENTS: Coefficients = Coefficients {
        a: &[],
        a_tilde: &[],
        b: &[],
        b_tilde: &[],
        c: &[],
        c_tilde: &[],
    };
    const ORDERS: Orders = Orders {
        general: 0,
        separable: 0,
        nystrom: 0,
    };
    type General = RunTimePlan<General>;
    type Separable = RunTimePlan<Separable>;
}

// Checked when the integrator is created.
impl<C: Frictionless> ProvedFor<C> for AtRunTime {}
