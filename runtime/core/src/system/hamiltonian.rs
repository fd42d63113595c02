//! Hamiltonian systems, written once for every scalar.

#[cfg(feature = "alloc")]
use crate::contract::Jacobian;
use crate::contract::{Class, LaneWork, Masses, Separable, System, first};
use crate::error::Error;
use crate::number::{
    F64x2, F64x4, F64x8, Lanes, Scalar, Vector, WideF64x4, WideF64x8, WidestF64x8,
};

/// A Hamiltonian system, given by the right-hand sides of Hamilton's equations
///
/// ```text
/// q' = velocity(t, q, p) = ∂H/∂p      p' = force(t, q, p) = −∂H/∂q
/// ```
///
/// It is written once, for every [`Scalar`]: an integrator evaluates it with doubles, with doubles side by side in SIMD lanes, and
/// with dual numbers. A system that only doubles can evaluate implements [`System`](crate::System) instead; its steps are slower.
///
/// Results are written into the last argument, which has the dimension of `q` and `p` and holds old values:
/// every component has to be set. A result with another dimension, or with a component that is NaN or infinite, is an
/// error of the step. As in all code for every scalar, no branch may depend on a value.
///
/// A system whose velocity depends only on `p`, and whose force only on `q`, implements [`SeparableHamiltonian`] instead and gets this
/// trait from it. Any other system sets `type Class` to [`General`](crate::General), or, with friction or constraints, to another
/// [`Class`]. [`hamiltonian`](crate::hamiltonian()) makes a system from two closures.
///
/// # Time
///
/// If H depends on time, a partitioned method uses two times per stage. Stage `i` evaluates the *force* at `t0 + c_i h`, the time of its
/// position `Q_i`. It evaluates the *velocity* at `t0 + c̃_i h`, the time of its momentum `P_i`. For a separable H this is an autonomous
/// system in which positions and momenta each have their own time variable, so the method keeps its order. If `c = c̃`, as MW 4.9.3
/// (Marsden & West, 2001) requires, both times are the same. With two times a step of a non-separable H is not symplectic if ∂²H/∂q∂p
/// depends on time: choose a method with `c = c̃`.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::{General, Hamiltonian, Scalar};
///
/// /// H = (q² + 1)(p² + 1)/2
/// struct Coupled;
///
/// impl Hamiltonian for Coupled {
///     type Class = General;
///     type Vector<T: Scalar> = SVector<T, 1>;
///
///     fn velocity<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
///         velocity[0] = p[0] * (q[0] * q[0] + T::one());
///     }
///
///     fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>, force: &mut SVector<T, 1>) {
///         force[0] = -q[0] * (p[0] * p[0] + T::one());
///     }
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a Hamiltonian system",
    label = "implement `SeparableHamiltonian`, or `Hamiltonian` with `type Class = General`",
    note = "for doubles alone there are closures, `separable(…)` and `hamiltonian(…)`, and the trait `System`",
    note = "a Lagrangian that is not quadratic in the velocities is for `variational::LagrangianIntegrator`"
)]
pub trait Hamiltonian {
    /// The class of the Hamiltonian: see [`Class`].
    type Class: Class;

    /// Positions and momenta over a scalar: [`SVector<T, N>`](nalgebra::SVector), or `DVector<T>` if the dimension is known only at
    /// run time.
    type Vector<T: Scalar>: Vector<Scalar = T, With<F64x2> = Self::Vector<F64x2>>
        + Vector<With<F64x4> = Self::Vector<F64x4>>
        + Vector<With<F64x8> = Self::Vector<F64x8>>
        + Vector<With<WideF64x4> = Self::Vector<WideF64x4>>
        + Vector<With<WideF64x8> = Self::Vector<WideF64x8>>
        + Vector<With<WidestF64x8> = Self::Vector<WidestF64x8>>;

    /// Optional declaration about the masses: see [`Masses`].
    const MASSES: Masses = Masses::Any;

    /// Whether everything that velocity and force call is inlined. Each function that computes with numbers `T` is marked
    /// `#[inline(always)]`. No closure computes with them, and no function of whole vectors of nalgebra, such as `dot`, is called. Coupled
    /// stages and the trajectories of ensembles are then computed in the widest registers of the processor, AVX2 or AVX-512. This also
    /// holds for a program that is compiled for every x86-64 processor. The results have the same bits. Systems from a formula without
    /// functions of your own declare it.
    ///
    /// A function that is not inlined after all makes steps many times slower: see the chapter "Faster steps" of the book.
    const INLINED: bool = false;

    /// Whether the force has a part without a potential: [`applied_force`](Self::applied_force).
    const FORCED: bool = false;

    /// [`System::WELL_DECLARED`]
    #[doc(hidden)]
    const WELL_DECLARED: bool = false;

    /// Writes ∂H/∂p at `(time, q, p)` into `velocity`.
    fn velocity<T: Scalar>(
        &self,
        time: T,
        q: &Self::Vector<T>,
        p: &Self::Vector<T>,
        velocity: &mut Self::Vector<T>,
    );

    /// Writes −∂H/∂q at `(time, q, p)`, plus the [applied force](Self::applied_force), into `force`.
    fn force<T: Scalar>(
        &self,
        time: T,
        q: &Self::Vector<T>,
        p: &Self::Vector<T>,
        force: &mut Self::Vector<T>,
    );

    /// Whether a separable system gives its force gradient: see [`SeparableHamiltonian::force_gradient`].
    const FORCE_GRADIENT: bool = false;

    /// The force gradient of a separable system: see [`SeparableHamiltonian::force_gradient`].
    fn force_gradient<T: Scalar>(
        &self,
        _time: T,
        _q: &Self::Vector<T>,
        _force: &Self::Vector<T>,
        gradient: &mut Self::Vector<T>,
    ) {
        gradient.as_mut_slice().fill(T::from_f64(f64::NAN));
    }

    /// [`velocity`](Self::velocity) and [`force`](Self::force) at one time and place, with the same bits. Implement it if both share
    /// costly terms.
    ///
    /// ```
    /// use symplectic::nalgebra::SVector;
    /// use symplectic::{General, Hamiltonian, Scalar};
    ///
    /// /// H = p² exp(−q²)/2
    /// struct Bell;
    ///
    /// type Vector1<T> = SVector<T, 1>;
    ///
    /// impl Hamiltonian for Bell {
    ///     type Class = General;
    ///     type Vector<T: Scalar> = Vector1<T>;
    ///
    ///     fn velocity<T: Scalar>(&self, _time: T, q: &Vector1<T>, p: &Vector1<T>, velocity: &mut Vector1<T>) {
    ///         velocity[0] = p[0] * (-q[0] * q[0]).exp();
    ///     }
    ///
    ///     fn force<T: Scalar>(&self, time: T, q: &Vector1<T>, p: &Vector1<T>, force: &mut Vector1<T>) {
    ///         self.slopes(time, q, p, (&mut q.clone(), force));
    ///     }
    ///
    ///     // One exponential for both.
    ///     fn slopes<T: Scalar>(
    ///         &self,
    ///         time: T,
    ///         q: &Vector1<T>,
    ///         p: &Vector1<T>,
    ///         (velocity, force): (&mut Vector1<T>, &mut Vector1<T>),
    ///     ) {
    ///         self.velocity(time, q, p, velocity);
    ///         force[0] = q[0] * p[0] * velocity[0];
    ///     }
    /// }
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes<T: Scalar>(
        &self,
        time: T,
        q: &Self::Vector<T>,
        p: &Self::Vector<T>,
        (velocity, force): (&mut Self::Vector<T>, &mut Self::Vector<T>),
    ) {
        self.velocity(time, q, p, velocity);
        self.force(time, q, p, force);
    }

    /// Checks the parameters for states of this dimension. Systems from a formula implement it.
    #[doc(hidden)]
    fn check_dimension(&self, _dimension: usize) -> Result<(), Error> {
        Ok(())
    }

    /// Whether trajectories with different parameters run in lanes side by side: see [`in_lanes`](Self::in_lanes).
    #[doc(hidden)]
    const JOINS: bool = false;

    /// Runs `work` with the type of the systems whose lanes have different parameters; without [`JOINS`](Self::JOINS), with this type.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn in_lanes<V, L, K>(work: K) -> K::Output
    where
        Self: Clone + System<V, Class = <Self as Hamiltonian>::Class>,
        V: Vector,
        L: Lanes,
        K: LaneWork<V, Self, L>,
    {
        work.run::<Self::Vector<L>, Self>(first)
    }

    /// [`velocity`](Self::velocity) at every stage, with the same bits; `at` returns the time, the positions and the momenta of a stage.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocities<'a, T: Scalar>(
        &self,
        at: impl Fn(usize) -> (T, &'a Self::Vector<T>, &'a Self::Vector<T>),
        velocities: &mut [Self::Vector<T>],
    ) where
        Self::Vector<T>: 'a,
    {
        for (stage, velocity) in velocities.iter_mut().enumerate() {
            let (time, q, p) = at(stage);
            self.velocity(time, q, p, velocity);
        }
    }

    /// [`force`](Self::force) at every stage: see [`velocities`](Self::velocities).
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn forces<'a, T: Scalar>(
        &self,
        at: impl Fn(usize) -> (T, &'a Self::Vector<T>, &'a Self::Vector<T>),
        forces: &mut [Self::Vector<T>],
    ) where
        Self::Vector<T>: 'a,
    {
        for (stage, force) in forces.iter_mut().enumerate() {
            let (time, q, p) = at(stage);
            self.force(time, q, p, force);
        }
    }

    /// H at `(time, q, p)`, if the system provides it. No method needs it.
    fn energy<T: Scalar>(&self, _time: T, _q: &Self::Vector<T>, _p: &Self::Vector<T>) -> Option<T> {
        None
    }

    /// Writes f, the part of the force without a potential, into `applied`, with [`FORCED`](Self::FORCED) `= true`:
    ///
    /// ```text
    /// p' = force(t, q, p) = −∂H/∂q + f(t, q, p)
    /// ```
    ///
    /// [`force`](Self::force) already contains f, so steps need nothing else. Balances (`variational::StepWithStages`) of
    /// energy and momentum, and Newton's iteration, use this function. A force that depends on momenta makes the class
    /// [`General`](crate::General), where a method has its order for general Hamiltonians (Marsden & West, 2001, Example 3.2.5). A
    /// separable system with a force that depends on time and positions only stays separable.
    ///
    /// The time of a stage is `t0 + c_i h`, even if the nodes c̃ of the momenta differ, as in Störmer–Verlet. Time counts as one more
    /// position, with velocity 1, so the order holds for forces of time and momentum, too.
    ///
    /// ```
    /// use symplectic::nalgebra::SVector;
    /// use symplectic::{Error, General, Hamiltonian, Integrator, Scalar, State};
    ///
    /// symplectic::tableau! { Gauss3 { basis: polynomial(3), nodes: gauss(3) } }
    ///
    /// /// Van der Pol's oscillator: q'' = −q + (1 − q²) q'.
    /// struct VanDerPol;
    ///
    /// type Vector1<T> = SVector<T, 1>;
    ///
    /// impl Hamiltonian for VanDerPol {
    ///     type Class = General;
    ///     type Vector<T: Scalar> = Vector1<T>;
    ///     const FORCED: bool = true;
    ///
    ///     fn velocity<T: Scalar>(&self, _: T, _: &Vector1<T>, p: &Vector1<T>, velocity: &mut Vector1<T>) {
    ///         *velocity = *p;
    ///     }
    ///
    ///     fn force<T: Scalar>(&self, time: T, q: &Vector1<T>, p: &Vector1<T>, force: &mut Vector1<T>) {
    ///         self.applied_force(time, q, p, force);
    ///         *force -= q;
    ///     }
    ///
    ///     fn applied_force<T: Scalar>(&self, _: T, q: &Vector1<T>, p: &Vector1<T>, applied: &mut Vector1<T>) {
    ///         applied[0] = (T::one() - q[0] * q[0]) * p[0];
    ///     }
    /// }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let start = State::from_arrays(0.0, [2.0], [0.0]);
    /// let mut run = Integrator::new(Gauss3, VanDerPol, start, 0.05)?;
    /// // The period of the limit cycle is 6.6632868593…
    /// let end = run.integrate_to(20.0 * 6.663_286_859_323)?.clone();
    /// let next = run.integrate_to(21.0 * 6.663_286_859_323)?;
    /// assert!((end.q[0] - next.q[0]).abs() < 1e-6);
    /// # Ok(())
    /// # }
    /// ```
    fn applied_force<T: Scalar>(
        &self,
        _time: T,
        _q: &Self::Vector<T>,
        _p: &Self::Vector<T>,
        applied: &mut Self::Vector<T>,
    ) {
        applied.as_mut_slice().fill(T::zero());
    }

    /// Writes the second derivatives of H at `(time, q, p)` into `jacobian`, which is initially zero, and returns `true`. Returns `false`
    /// if the system does not provide them; the iteration of `solver::Newton` then uses differences. Derivatives of an
    /// [applied force](Self::applied_force) with respect to positions are added to `force_by_position`; those with respect to momenta have
    /// a separate matrix.
    #[cfg(feature = "alloc")]
    fn second_derivatives<T: Scalar>(
        &self,
        _time: T,
        _q: &Self::Vector<T>,
        _p: &Self::Vector<T>,
        _jacobian: &mut Jacobian<T>,
    ) -> bool {
        false
    }

    /// The largest `|i − j|` of components that interact: `∂²H/∂x_i∂y_j = 0` beyond it, for positions or momenta x and y.
    /// A chain with one component per particle has 1. `usize::MAX` if it is not known.
    fn half_bandwidth(&self) -> usize {
        usize::MAX
    }

    /// The friction or the constraints of the system. The classes [`General`](crate::General) and [`Separable`](crate::Separable) have none:
    /// keep the default. A system of any other class implements the trait of its class and returns `Some(self)`. This is
    /// `friction::Friction` (feature `flows`), `constraints::HolonomicConstraints` or `constraints::NonholonomicConstraints` (feature
    /// `mechanics`).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extra<T: Scalar>(&self) -> Option<<Self::Class as Class>::Extra<'_, Self::Vector<T>>> {
        None
    }
}

/// A system with a separable Hamiltonian `H = T(t, p) + U(t, q)`: the velocity depends only on `p`, the force only on `q`.
///
/// Many symplectic methods are explicit for such a system. For results, scalars and time see [`Hamiltonian`], which every
/// separable system implements; [`separable`](crate::separable) makes a system from two closures.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::{Scalar, SeparableHamiltonian};
///
/// /// H = p²/2 − cos q
/// struct Pendulum;
///
/// impl SeparableHamiltonian for Pendulum {
///     type Vector<T: Scalar> = SVector<T, 1>;
///
///     fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
///         velocity[0] = p[0];
///     }
///
///     fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
///         force[0] = -q[0].sin();
///     }
///
///     fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>) -> Option<T> {
///         Some(p[0] * p[0] * T::from_f64(0.5) - q[0].cos())
///     }
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a Hamiltonian system",
    label = "implement `SeparableHamiltonian`, or `Hamiltonian` with `type Class = General`",
    note = "for doubles alone there are closures, `separable(…)` and `hamiltonian(…)`, and the trait `System`",
    note = "a Lagrangian that is not quadratic in the velocities is for `variational::LagrangianIntegrator`"
)]
pub trait SeparableHamiltonian {
    /// Positions and momenta over a scalar: [`SVector<T, N>`](nalgebra::SVector), or `DVector<T>` if the dimension is known only at
    /// run time.
    type Vector<T: Scalar>: Vector<Scalar = T, With<F64x2> = Self::Vector<F64x2>>
        + Vector<With<F64x4> = Self::Vector<F64x4>>
        + Vector<With<F64x8> = Self::Vector<F64x8>>
        + Vector<With<WideF64x4> = Self::Vector<WideF64x4>>
        + Vector<With<WideF64x8> = Self::Vector<WideF64x8>>
        + Vector<With<WidestF64x8> = Self::Vector<WidestF64x8>>;

    /// Declaration about the [masses](Masses). With `Masses::Unit` steps use the momentum as the velocity.
    ///
    /// ```
    /// use symplectic::nalgebra::DVector;
    /// use symplectic::system::Masses;
    /// use symplectic::{Scalar, SeparableHamiltonian};
    ///
    /// /// Oscillators of frequency 1.
    /// struct Oscillators;
    ///
    /// impl SeparableHamiltonian for Oscillators {
    ///     type Vector<T: Scalar> = DVector<T>;
    ///
    ///     const MASSES: Masses = Masses::Unit;
    ///
    ///     fn velocity<T: Scalar>(&self, _time: T, p: &DVector<T>, velocity: &mut DVector<T>) {
    ///         velocity.copy_from(p);
    ///     }
    ///
    ///     fn force<T: Scalar>(&self, _time: T, q: &DVector<T>, force: &mut DVector<T>) {
    ///         force.zip_apply(q, |force, q| *force = -q);
    ///     }
    /// }
    /// ```
    const MASSES: Masses = Masses::Any;

    /// Whether everything is inlined: see [`Hamiltonian::INLINED`].
    const INLINED: bool = false;

    /// Writes ∂H/∂p at `(time, p)` into `velocity`.
    fn velocity<T: Scalar>(&self, time: T, p: &Self::Vector<T>, velocity: &mut Self::Vector<T>);

    /// Writes −∂H/∂q at `(time, q)` into `force`.
    fn force<T: Scalar>(&self, time: T, q: &Self::Vector<T>, force: &mut Self::Vector<T>);

    /// Whether there is a [`force_gradient`](Self::force_gradient), which methods with gradient kicks need.
    const FORCE_GRADIENT: bool = false;

    /// Writes `(∂f/∂q) M⁻¹ f = −U″ M⁻¹ f` at `(time, q)` into `gradient`, with [`FORCE_GRADIENT`](Self::FORCE_GRADIENT) `= true`, for
    /// quadratic kinetic energy `T = pᵀM⁻¹p/2` with constant masses. The argument `force` is f, the [`force`](Self::force) at the same
    /// time and place.
    ///
    /// Methods with gradient kicks need it, such as `chin-1997-c`: their kicks are `p += h (b f + 2 g h² f′ M⁻¹ f)` (Suzuki 1995; Chin
    /// 1997). A program that steps another system by such a method does not compile. Systems from a formula give it if their masses are
    /// constant. A step is symplectic and has its order only if it is exact; differences of forces are not.
    ///
    /// ```
    /// use symplectic::nalgebra::SVector;
    /// use symplectic::{Error, Integrator, Scalar, SeparableHamiltonian, State};
    ///
    /// symplectic::tableau! { Chin { base: chin-1997-c } }
    ///
    /// /// H = p²/2 − cos q
    /// struct Pendulum;
    ///
    /// type Vector1<T> = SVector<T, 1>;
    ///
    /// impl SeparableHamiltonian for Pendulum {
    ///     type Vector<T: Scalar> = Vector1<T>;
    ///     const FORCE_GRADIENT: bool = true;
    ///
    ///     fn velocity<T: Scalar>(&self, _time: T, p: &Vector1<T>, velocity: &mut Vector1<T>) {
    ///         velocity[0] = p[0];
    ///     }
    ///
    ///     fn force<T: Scalar>(&self, _time: T, q: &Vector1<T>, force: &mut Vector1<T>) {
    ///         force[0] = -q[0].sin();
    ///     }
    ///
    ///     fn force_gradient<T: Scalar>(&self, _time: T, q: &Vector1<T>, force: &Vector1<T>, gradient: &mut Vector1<T>) {
    ///         gradient[0] = -q[0].cos() * force[0];
    ///     }
    /// }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let error = |h| {
    ///     let start = State::from_arrays(0.0, [1.0], [0.0]);
    ///     let mut run = Integrator::new(Chin, Pendulum, start, h)?;
    ///     let end = run.integrate_to(3.0)?;
    ///     // A Taylor series in 30 digits.
    ///     Ok::<f64, Error>((end.q[0] + 0.948_751_596_946_198_2).abs())
    /// };
    /// let ratio = error(0.1)? / error(0.05)?;
    /// assert!((ratio.log2() - 4.0).abs() < 0.05, "{ratio}");
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Without it a program does not compile:
    ///
    /// ```compile_fail,E0080
    /// use symplectic::nalgebra::Vector1;
    /// use symplectic::{Error, Integrator, State, acceleration};
    ///
    /// symplectic::tableau! { Chin { base: chin-1997-c } }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let pendulum = acceleration(|_time, q: &Vector1<f64>, acceleration| acceleration[0] = -q[0].sin());
    /// Integrator::new(Chin, pendulum, State::from_arrays(0.0, [1.0], [0.0]), 0.1)?.step()?;
    /// # Ok(())
    /// # }
    /// ```
    fn force_gradient<T: Scalar>(
        &self,
        _time: T,
        _q: &Self::Vector<T>,
        _force: &Self::Vector<T>,
        gradient: &mut Self::Vector<T>,
    ) {
        gradient.as_mut_slice().fill(T::from_f64(f64::NAN));
    }

    /// H at `(time, q, p)`, if the system provides it. No method needs it.
    fn energy<T: Scalar>(&self, _time: T, _q: &Self::Vector<T>, _p: &Self::Vector<T>) -> Option<T> {
        None
    }

    /// Writes the second derivatives of H at `(time, q, p)` into `jacobian`, which is initially zero, and returns `true`. Returns `false`
    /// if the system does not provide them; the iteration of `solver::Newton` then uses differences.
    ///
    /// ```
    /// use symplectic::nalgebra::SVector;
    /// use symplectic::solver::ByNewton;
    /// use symplectic::system::Jacobian;
    /// use symplectic::{Error, Integrator, Scalar, SeparableHamiltonian, State};
    ///
    /// symplectic::tableau! { Gauss3 { basis: polynomial(3), nodes: gauss(3) } }
    ///
    /// /// H = p²/2 + 10¹² (1 − cos q)
    /// struct Stiff;
    ///
    /// type Vector1<T> = SVector<T, 1>;
    ///
    /// impl SeparableHamiltonian for Stiff {
    ///     type Vector<T: Scalar> = Vector1<T>;
    ///
    ///     fn velocity<T: Scalar>(&self, _time: T, p: &Vector1<T>, velocity: &mut Vector1<T>) {
    ///         *velocity = *p;
    ///     }
    ///
    ///     fn force<T: Scalar>(&self, _time: T, q: &Vector1<T>, force: &mut Vector1<T>) {
    ///         force[0] = -q[0].sin() * T::from_f64(1e12);
    ///     }
    ///
    ///     fn second_derivatives<T: Scalar>(&self, _: T, q: &Vector1<T>, _: &Vector1<T>, jacobian: &mut Jacobian<T>) -> bool {
    ///         jacobian.velocity_by_momentum.set(0, 0, T::one());
    ///         jacobian.force_by_position.set(0, 0, -q[0].cos() * T::from_f64(1e12));
    ///         true
    ///     }
    /// }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let start = State::new(0.0, SVector::from([1e-6]), SVector::from([0.0]));
    /// let mut integrator = Integrator::new(Gauss3, Stiff, start, 0.01)?.by_newton();
    /// integrator.integrate_to(1.0)?;
    /// assert!(integrator.statistics().mean_iterations() < 6.0);
    /// # Ok(())
    /// # }
    /// ```
    #[cfg(feature = "alloc")]
    fn second_derivatives<T: Scalar>(
        &self,
        _time: T,
        _q: &Self::Vector<T>,
        _p: &Self::Vector<T>,
        _jacobian: &mut Jacobian<T>,
    ) -> bool {
        false
    }

    /// The largest `|i − j|` of components that interact: `∂²H/∂x_i∂y_j = 0` beyond it, for positions or momenta x and y.
    /// A chain with one component per particle has 1. `usize::MAX` if it is not known.
    fn half_bandwidth(&self) -> usize {
        usize::MAX
    }

    /// See [`Hamiltonian::check_dimension`].
    #[doc(hidden)]
    fn check_dimension(&self, _dimension: usize) -> Result<(), Error> {
        Ok(())
    }

    /// See [`Hamiltonian::JOINS`].
    #[doc(hidden)]
    const JOINS: bool = false;

    /// See [`Hamiltonian::in_lanes`].
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn in_lanes_of_separable<V, L, K>(work: K) -> K::Output
    where
        Self: Clone + System<V, Class = Separable>,
        V: Vector,
        L: Lanes,
        K: LaneWork<V, Self, L>,
    {
        work.run::<Self::Vector<L>, Self>(first)
    }
}

impl<S: SeparableHamiltonian> Hamiltonian for S {
    type Class = Separable;
    type Vector<T: Scalar> = S::Vector<T>;

    const MASSES: Masses = S::MASSES;
    const JOINS: bool = S::JOINS;
    const INLINED: bool = S::INLINED;
    const FORCE_GRADIENT: bool = S::FORCE_GRADIENT;
    // By the arguments of the functions.
    const WELL_DECLARED: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn in_lanes<V, L, K>(work: K) -> K::Output
    where
        Self: Clone + System<V, Class = Separable>,
        V: Vector,
        L: Lanes,
        K: LaneWork<V, Self, L>,
    {
        S::in_lanes_of_separable(work)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocity<T: Scalar>(
        &self,
        time: T,
        _q: &S::Vector<T>,
        p: &S::Vector<T>,
        velocity: &mut S::Vector<T>,
    ) {
        SeparableHamiltonian::velocity(self, time, p, velocity);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force<T: Scalar>(
        &self,
        time: T,
        q: &S::Vector<T>,
        _p: &S::Vector<T>,
        force: &mut S::Vector<T>,
    ) {
        SeparableHamiltonian::force(self, time, q, force);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force_gradient<T: Scalar>(
        &self,
        time: T,
        q: &S::Vector<T>,
        force: &S::Vector<T>,
        gradient: &mut S::Vector<T>,
    ) {
        SeparableHamiltonian::force_gradient(self, time, q, force, gradient);
    }

    fn energy<T: Scalar>(&self, time: T, q: &S::Vector<T>, p: &S::Vector<T>) -> Option<T> {
        SeparableHamiltonian::energy(self, time, q, p)
    }

    #[cfg(feature = "alloc")]
    fn second_derivatives<T: Scalar>(
        &self,
        time: T,
        q: &S::Vector<T>,
        p: &S::Vector<T>,
        jacobian: &mut Jacobian<T>,
    ) -> bool {
        SeparableHamiltonian::second_derivatives(self, time, q, p, jacobian)
    }

    fn half_bandwidth(&self) -> usize {
        SeparableHamiltonian::half_bandwidth(self)
    }

    fn check_dimension(&self, dimension: usize) -> Result<(), Error> {
        SeparableHamiltonian::check_dimension(self, dimension)
    }
}
