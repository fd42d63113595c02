//! Methods that are known only at run time: a tableau is a value instead of a type.

use alloc::string::{String, ToString};
use alloc::sync::Arc;
use core::fmt::Write as _;

use symplectic_core::inside::ConstrainedStep;
use symplectic_core::solver::{Coefficients, Solver};
use symplectic_core::system::{Class, Frictionless};
use symplectic_core::{Error, General, Method, Orders, ProvedFor, Separable, System, Vector};

use crate::coefficients::RunTimeCoefficients;
use crate::error::{self, TableauError, Weights};
use crate::plan::{RunTimeMemory, RunTimePlan};
use crate::rows::RunTimeRows;
use crate::schedule::Schedule;

/// A symplectic partitioned Runge–Kutta method that is known only at run time: derived by the program, or read from a file.
///
/// [`Integrator::new`](symplectic_core::Integrator#method.new) steps a system with it, as with a method that a macro emits. Steps take
/// longer, by a factor measured in the guide.
///
/// On separable systems an explicit tableau takes drifts and kicks. Coupled stages use the iteration of
/// [`FixedPoint`](symplectic_core::solver::FixedPoint), one by one and never in lanes. For stiff systems take `by_newton`, with the feature
/// `newton`. Dense output is the cubic polynomial through the ends of the step.
///
/// [`Error::SeparableTableau`] refuses a system that is not separable if the tableau has a lower order there or is not symplectic: see
/// [`accept_lower_order`](Self::accept_lower_order). With constraints the tableau needs its
/// [constrained steps](Self::with_constrained_steps). With friction take an emitted method:
///
/// ```compile_fail,E0277
/// # use symplectic::at_run_time::RunTimeTableau;
/// # use symplectic::{Integrator, State};
/// symplectic::hamiltonian! { Damped q: [x], p: [px]; H = (px^2 + x^2)/2 friction: 0.1 }
///
/// fn step(tableau: RunTimeTableau) -> Result<(), symplectic::Error> {
///     let start = State::from_arrays(0.0, [1.0], [0.0]);
///     Integrator::new(tableau, Damped, start, 0.1)?.step()?;
///     Ok(())
/// }
/// # let _used: fn(RunTimeTableau) -> Result<(), symplectic::Error> = step;
/// ```
///
/// Solvers in lanes need an emitted method, too:
///
/// ```compile_fail
/// # use symplectic::at_run_time::RunTimeTableau;
/// # use symplectic::solver::SimdFixedPoint;
/// # use symplectic::{Integrator, State};
/// symplectic::hamiltonian! { Oscillator q: [x], p: [px]; H = px^2/2 + x^2/2 }
///
/// fn step(tableau: RunTimeTableau) -> Result<(), symplectic::Error> {
///     let start = State::from_arrays(0.0, [1.0], [0.0]);
///     Integrator::new(tableau, Oscillator, start, 0.1)?.with_solver(SimdFixedPoint).step()?;
///     Ok(())
/// }
/// # let _used: fn(RunTimeTableau) -> Result<(), symplectic::Error> = step;
/// ```
///
/// It is symplectic as rounded, like emitted methods: stages are sums of increments with `μ_ij = a_ij/b_j` and `μ̃_ij = ã_ij/b̃_j`. The
/// larger of the two is rounded and the other is its exact complement, so that `μ̃_ij + μ_ji = 1`. Coefficients are known to 53 bits,
/// whatever the scalar.
///
/// A copy shares the coefficients.
///
/// ```
/// use symplectic::at_run_time::{RunTimeCoefficients, RunTimeTableau};
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{Integrator, Orders, State, acceleration};
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
///     gradient: Vec::new(),
/// };
/// let orders = Orders { general: 2, separable: 2, nystrom: 2 };
/// let midpoint = RunTimeTableau::new("midpoint", &midpoint, orders)?;
///
/// let pendulum = acceleration(|_time, q: &Vector1<f64>, acceleration| acceleration[0] = -q[0].sin());
/// let start = State::from_arrays(0.0, [1.0], [0.0]);
/// let mut integrator = Integrator::new(midpoint, pendulum, start, 0.1)?;
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
    /// * [`GradientKicks`](TableauError::GradientKicks);
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
        error::check(coefficients, Weights::SumToOne)?;
        Ok(Self::checked(name, coefficients.clone(), orders))
    }

    /// The method with coefficients that are fitted to a frequency, whose weights need not sum to 1.
    pub(crate) fn fitted(
        name: &str,
        coefficients: RunTimeCoefficients,
        orders: Orders,
    ) -> Result<Self, TableauError> {
        error::check(&coefficients, Weights::Fitted)?;
        Ok(Self::checked(name, coefficients, orders))
    }

    fn checked(name: &str, coefficients: RunTimeCoefficients, orders: Orders) -> Self {
        Self {
            data: Arc::new(Data {
                name: name.to_string(),
                orders,
                separable: Schedule::new(&coefficients, true),
                general: Schedule::new(&coefficients, false),
                coefficients,
            }),
            accepts_lower_order: false,
            holonomic: &[],
            nonholonomic: &[],
        }
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
    /// use symplectic::at_run_time::RunTimeTableau;
    /// use symplectic::{Integrator, Method, State};
    ///
    /// symplectic::tableau! { Rattle { basis: polynomial(2), nodes: lobatto(2) } }
    /// symplectic::hamiltonian! { Rod q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + y constraints: { rod = x^2 + y^2 - 1 } }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let rattle = RunTimeTableau::new("RATTLE", &Rattle::COEFFICIENTS.into(), Rattle::ORDERS)?;
    /// let rattle = rattle.with_constrained_steps(Rattle::CONSTRAINED, Rattle::NONHOLONOMIC);
    /// let start = State::from_arrays(0.0, [1.0, 0.0], [0.0; 2]);
    /// let mut run = Integrator::new(rattle, Rod, start.clone(), 0.1)?;
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
    fn keeps_its_order_in_general(&self) -> bool {
        let Orders {
            general, separable, ..
        } = self.data.orders;
        let RunTimeCoefficients { b, b_tilde, .. } = &self.data.coefficients;
        let mut weights = b.iter().zip(b_tilde);
        let are_equal = |(b, b_tilde): (&f64, &f64)| error::is_about(*b, *b_tilde, 0);
        self.accepts_lower_order || general >= separable && weights.all(are_equal)
    }

    /// The schedule of its steps for systems of class `C`.
    fn schedule<C: Class>(&self) -> &Schedule {
        if C::SEPARABLE {
            &self.data.separable
        } else {
            &self.data.general
        }
    }
}

/// Not the coefficients: these are in the value.
const IN_THE_VALUE: &str = "the coefficients of a tableau at run time are in its value, not in its type: this needs a method that a macro emits";

impl Method for RunTimeTableau {
    const NAME: &'static str = "the tableau at run time";
    const STAGES: usize = panic!("{}", IN_THE_VALUE);
    const DEFINITION: &'static str = "at run time";
    const COEFFICIENTS: Coefficients = panic!("{}", IN_THE_VALUE);
    const ORDERS: Orders = panic!("{}", IN_THE_VALUE);
    const AT_RUN_TIME: bool = true;
    type General = RunTimePlan<General>;
    type Separable = RunTimePlan<Separable>;

    fn name(&self) -> &str {
        &self.data.name
    }

    fn orders(&self) -> Orders {
        self.data.orders
    }

    fn needs_quadratic_kinetic(&self) -> Option<Orders> {
        let Orders {
            separable, nystrom, ..
        } = self.data.orders;
        (!self.accepts_lower_order && nystrom > separable).then_some(self.data.orders)
    }

    fn identity(&self) -> String {
        let RunTimeCoefficients {
            a,
            a_tilde,
            b,
            b_tilde,
            c,
            c_tilde,
            gradient: _,
        } = &self.data.coefficients;
        let mut text = String::from("at run time:");
        let lists = [b, b_tilde, c, c_tilde].into_iter();
        for value in lists.chain(a).chain(a_tilde).flatten() {
            let written = write!(text, " {:016x}", value.to_bits());
            debug_assert!(written.is_ok(), "a string takes all");
        }
        text
    }

    fn holonomic(&self) -> &'static [ConstrainedStep] {
        self.holonomic
    }

    fn nonholonomic(&self) -> &'static [ConstrainedStep] {
        self.nonholonomic
    }

    fn check_order<C: Class>(&self) -> Result<(), Error> {
        // A method keeps its order with constraints only if it has it for every H.
        let is_split = C::SEPARABLE && !C::CONSTRAINED;
        if is_split || self.keeps_its_order_in_general() {
            return Ok(());
        }
        Err(Error::SeparableTableau {
            order: self.data.orders.separable,
            lower_order: self.data.orders.general,
        })
    }

    fn is_lanewise(&self) -> bool {
        self.is_explicit()
    }

    fn general_memory<V: Vector, S: System<V>, N: Solver<V, S>>(
        &self,
        prototype: &V,
    ) -> RunTimeMemory<V, N::Memory<RunTimeRows<General>>> {
        RunTimeMemory::new::<General, S, N>(self.schedule::<General>(), prototype)
    }

    fn separable_memory<V: Vector, S: System<V>, N: Solver<V, S>>(
        &self,
        prototype: &V,
    ) -> RunTimeMemory<V, N::Memory<RunTimeRows<Separable>>> {
        RunTimeMemory::new::<Separable, S, N>(self.schedule::<Separable>(), prototype)
    }
}

// Checked when the integrator is created.
impl<C: Frictionless> ProvedFor<C> for RunTimeTableau {}
