//! The systems that are integrated.

use crate::number::Vector;
use crate::system::{Class, Components, Layout, Separable, StageRows};

/// A Hamiltonian system, given by the right-hand sides of Hamilton's equations
///
/// ```text
/// q' = velocity(t, q, p) = ∂H/∂p      p' = force(t, q, p) = −∂H/∂q
/// ```
///
/// Results are written into the last argument, which has the dimension of `q` and `p` and holds some older value:
/// every component has to be set. A result of another dimension or with a component that is not finite is an
/// error of the step.
///
/// [`Class`](Self::Class) says what may depend on what. A system whose velocity sees only `p` and whose force
/// sees only `q` implements [`SeparableHamiltonian`] instead and gets this trait from it; any other says
/// `type Class = General`. [`hamiltonian`](crate::hamiltonian) makes a system of two closures.
///
/// A general system implements this for `SVector<T, N>`, for `DVector<T>`, or for both, over any `T` and `N`; an
/// implementation for all `V: Vector` at once the compiler refuses, because a crate further down could make the same
/// type separable over a vector of its own. A separable system has no such limit.
///
/// # Time
///
/// Where H depends on time, a partitioned method reads two clocks: stage `i` asks for the *force* at
/// `t0 + c_i h`, the time of its position `Q_i`, and for the *velocity* at `t0 + c̃_i h`, the time of its momentum
/// `P_i`. For a separable H this is the autonomous system in which each half has got a time of its own, so the order of
/// the method is kept. Where `c = c̃`, as MW 4.9.3 (Marsden & West, 2001) asks, there is one time only.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::{General, Hamiltonian, Scalar};
///
/// /// H = (q² + 1)(p² + 1)/2
/// struct Coupled;
///
/// impl<T: Scalar> Hamiltonian<SVector<T, 1>> for Coupled {
///     type Class = General;
///
///     fn velocity(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
///         velocity[0] = p[0] * (q[0] * q[0] + T::one());
///     }
///
///     fn force(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>, force: &mut SVector<T, 1>) {
///         force[0] = -q[0] * (p[0] * p[0] + T::one());
///     }
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a Hamiltonian system over the vectors `{V}`",
    label = "implement `SeparableHamiltonian<{V}>`, or `Hamiltonian<{V}>` with `type Class = General`"
)]
pub trait Hamiltonian<V: Vector> {
    /// What the derivatives depend on: [`General`](crate::General) or [`Separable`].
    type Class: Class;

    /// Whether the velocity is the momentum, as with unit masses: see [`SeparableHamiltonian::UNIT_MASSES`].
    const UNIT_MASSES: bool = false;

    /// Writes ∂H/∂p at `(time, q, p)` into `velocity`.
    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V);

    /// Writes −∂H/∂q at `(time, q, p)` into `force`.
    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V);

    /// Whether [`slopes`](Self::slopes) is written out.
    const SHARED_SLOPES: bool = false;

    /// [`velocity`](Self::velocity) and [`force`](Self::force) at one time and place, with the same bits: to be written out, and
    /// [said](Self::SHARED_SLOPES), where they have costly parts in common. [`SimdJacobi`](crate::solver::SimdJacobi) evaluates it;
    /// where other bits come out of it for the first state, making an integrator fails with
    /// [`Error::NotTheSameSlopes`](crate::Error::NotTheSameSlopes).
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
    /// impl<T: Scalar> Hamiltonian<Vector1<T>> for Bell {
    ///     type Class = General;
    ///
    ///     const SHARED_SLOPES: bool = true;
    ///
    ///     fn velocity(&self, _time: T, q: &Vector1<T>, p: &Vector1<T>, velocity: &mut Vector1<T>) {
    ///         velocity[0] = p[0] * (-q[0] * q[0]).exp();
    ///     }
    ///
    ///     fn force(&self, time: T, q: &Vector1<T>, p: &Vector1<T>, force: &mut Vector1<T>) {
    ///         self.slopes(time, q, p, (&mut q.clone(), force));
    ///     }
    ///
    ///     // One exponential for both.
    ///     fn slopes(
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
    #[inline(always)]
    fn slopes(&self, time: V::Scalar, q: &V, p: &V, (velocity, force): (&mut V, &mut V)) {
        self.velocity(time, q, p, velocity);
        self.force(time, q, p, force);
    }

    /// Whether the force is local: see [`SeparableHamiltonian::LOCAL_FORCE`].
    const LOCAL_FORCE: bool = false;

    /// The force, component by component: see [`SeparableHamiltonian::local_force`].
    #[inline(always)]
    fn local_force(&self, _time: V::Scalar, _components: &mut impl Components<V::Scalar>) {}

    /// Whether the force is made in rows: see [`SeparableHamiltonian::ROW_FORCES`].
    const ROW_FORCES: bool = false;

    /// The force in rows: see [`SeparableHamiltonian::row_forces`].
    #[inline(always)]
    fn row_forces(&self, _rows: &mut impl StageRows) {}

    /// Kicks and a drift in one pass: see [`SeparableHamiltonian::kick_and_drift`].
    #[inline(always)]
    fn kick_and_drift(
        &self,
        _time: V::Scalar,
        _state: (&mut [V::Scalar], &mut [V::Scalar]),
        _layout: Layout,
        _kicks: &[V::Scalar],
        _drift: V::Scalar,
    ) -> bool {
        false
    }

    /// The layout for many passes: see [`SeparableHamiltonian::layout`].
    #[inline(always)]
    fn layout(&self, _q: &[V::Scalar], _p: &[V::Scalar]) -> Layout {
        Layout::NATURAL
    }

    /// H at `(time, q, p)`, where the system knows it. No method needs it.
    fn energy(&self, _time: V::Scalar, _q: &V, _p: &V) -> Option<V::Scalar> {
        None
    }
}

/// A system with a separable Hamiltonian `H = T(t, p) + U(t, q)`: the velocity sees only `p`, the force only `q`.
///
/// Many symplectic methods are explicit for such a system. For results and time see [`Hamiltonian`], which every
/// separable system is; [`separable`](crate::separable) makes one of two closures.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::{Scalar, SeparableHamiltonian};
///
/// /// H = p²/2 − cos q
/// struct Pendulum;
///
/// impl<T: Scalar> SeparableHamiltonian<SVector<T, 1>> for Pendulum {
///     fn velocity(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
///         velocity[0] = p[0];
///     }
///
///     fn force(&self, _time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
///         force[0] = -q[0].sin();
///     }
///
///     fn energy(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>) -> Option<T> {
///         Some(p[0] * p[0] * T::from_f64(0.5) - q[0].cos())
///     }
/// }
/// ```
pub trait SeparableHamiltonian<V: Vector> {
    /// Whether the velocity is the momentum to the last bit, `H = |p|²/2 + U(t, q)`. The drifts of a splitting, and the sweeps
    /// of [`SimdNystrom`](crate::solver::SimdNystrom), then take the momentum for it: long vectors are not copied. Where it is said and not so,
    /// [`Error::NotUnitMasses`](crate::Error::NotUnitMasses) is what an integrator is made of.
    ///
    /// ```
    /// use symplectic::nalgebra::DVector;
    /// use symplectic::SeparableHamiltonian;
    ///
    /// /// Oscillators of frequency 1.
    /// struct Oscillators;
    ///
    /// impl SeparableHamiltonian<DVector<f64>> for Oscillators {
    ///     const UNIT_MASSES: bool = true;
    ///
    ///     fn velocity(&self, _time: f64, p: &DVector<f64>, velocity: &mut DVector<f64>) {
    ///         velocity.copy_from(p);
    ///     }
    ///
    ///     fn force(&self, _time: f64, q: &DVector<f64>, force: &mut DVector<f64>) {
    ///         force.zip_apply(q, |force, q| *force = -q);
    ///     }
    /// }
    /// ```
    const UNIT_MASSES: bool = false;

    /// Writes ∂H/∂p at `(time, p)` into `velocity`.
    fn velocity(&self, time: V::Scalar, p: &V, velocity: &mut V);

    /// Writes −∂H/∂q at `(time, q)` into `force`.
    fn force(&self, time: V::Scalar, q: &V, force: &mut V);

    /// Whether [`local_force`](Self::local_force) is written out.
    const LOCAL_FORCE: bool = false;

    /// The force with the same bits as by [`force`](Self::force), in one walk along the components: to be written out, and
    /// [said](Self::LOCAL_FORCE), where the force on a component sees those beside it and few others, as in a [`Chain`](crate::system::Chain).
    ///
    /// For vectors on the heap, [unit masses](Self::UNIT_MASSES) and up to eight stages at different times
    /// [`SimdNystrom`](crate::solver::SimdNystrom) then makes sums over stages, evaluates, and notes what changed in one pass. The
    /// positions of the stages need not go to memory, but where a step does not go on from one before it, or its iteration does not
    /// settle in the first sweeps. Making that solver fails with [`Error::NotTheSameLocalForce`](crate::Error::NotTheSameLocalForce) where
    /// other bits come out of it in doubles or in lanes, for the present state or for one near it whose components all differ.
    ///
    /// ```
    /// use symplectic::nalgebra::DVector;
    /// use symplectic::{Scalar, SeparableHamiltonian};
    /// use symplectic::emitted::copy;
    /// use symplectic::system::Components;
    ///
    /// /// V(q_k, q_{k+1}) = q_k² q_{k+1}²/2 between neighbours of unit mass.
    /// struct Coupled;
    ///
    /// /// What two neighbours do to the first of them; nothing where there is none.
    /// fn pull<T: Scalar>(here: T, there: Option<T>) -> T {
    ///     there.map_or(T::zero(), |there| here * (there * there))
    /// }
    ///
    /// impl<T: Scalar> SeparableHamiltonian<DVector<T>> for Coupled {
    ///     const UNIT_MASSES: bool = true;
    ///     const LOCAL_FORCE: bool = true;
    ///
    ///     fn velocity(&self, _time: T, p: &DVector<T>, velocity: &mut DVector<T>) {
    ///         copy(velocity, p);
    ///     }
    ///
    ///     fn force(&self, _time: T, q: &DVector<T>, force: &mut DVector<T>) {
    ///         for k in 0..q.len() {
    ///             let left = k.checked_sub(1).map(|left| q[left]);
    ///             force[k] = -(pull(q[k], left) + pull(q[k], q.get(k + 1).copied()));
    ///         }
    ///     }
    ///
    ///     fn local_force(&self, _time: T, components: &mut impl Components<T>) {
    ///         let n = components.dimension();
    ///         let (mut left, mut here) = (None, components.position(0));
    ///         for k in 0..n {
    ///             let right = (k + 1 < n).then(|| components.position(k + 1));
    ///             components.set_force(k, -(pull(here, left) + pull(here, right)));
    ///             (left, here) = (Some(here), right.unwrap_or(here));
    ///         }
    ///     }
    /// }
    /// ```
    #[inline(always)]
    fn local_force(&self, _time: V::Scalar, _components: &mut impl Components<V::Scalar>) {}

    /// Whether [`row_forces`](Self::row_forces) is written out.
    const ROW_FORCES: bool = false;

    /// [`local_force`](Self::local_force) of doubles, with the same bits, of all stages and of eight neighbouring components at once: to be
    /// written out beside it, and [said](Self::ROW_FORCES), where the components feel each other in the same way everywhere, as in a
    /// [`Chain`](crate::system::Chain). A system that wraps another one has to pass it on to keep it.
    ///
    /// [`SimdNystrom`](crate::solver::SimdNystrom) asks for it in place of `local_force` where a method has fewer than eight stages
    /// and the number of components is a multiple of eight: then no lane is without work, and results are made row by row too.
    /// Making that solver fails with [`Error::NotTheSameLocalForce`](crate::Error::NotTheSameLocalForce) where other bits come out of it
    /// than by `force`, for as many stages as there can be, each with a time and with positions of its own near those of the present
    /// state, and with [`Error::NoSuchRow`](crate::Error::NoSuchRow) where it asks for a row that there is not, or sets it.
    ///
    /// ```
    /// use symplectic::nalgebra::DVector;
    /// use symplectic::{Scalar, SeparableHamiltonian};
    /// use symplectic::emitted::copy;
    /// use symplectic::simd::F64x8;
    /// use symplectic::system::{Components, MOST_ROW_STAGES, StageRows};
    ///
    /// /// H = Σ p_k²/2 + q_k⁴/4
    /// struct Quartic;
    ///
    /// fn force<T: Scalar>(q: T) -> T {
    ///     -(q * q * q)
    /// }
    ///
    /// impl<T: Scalar> SeparableHamiltonian<DVector<T>> for Quartic {
    ///     const UNIT_MASSES: bool = true;
    ///     const LOCAL_FORCE: bool = true;
    ///     const ROW_FORCES: bool = true;
    ///
    ///     fn velocity(&self, _time: T, p: &DVector<T>, velocity: &mut DVector<T>) {
    ///         copy(velocity, p);
    ///     }
    ///
    ///     fn force(&self, _time: T, q: &DVector<T>, out: &mut DVector<T>) {
    ///         for (out, &q) in out.iter_mut().zip(q) {
    ///             *out = force(q);
    ///         }
    ///     }
    ///
    ///     fn local_force(&self, _time: T, components: &mut impl Components<T>) {
    ///         for k in 0..components.dimension() {
    ///             let q = components.position(k);
    ///             components.set_force(k, force(q));
    ///         }
    ///     }
    ///
    ///     fn row_forces(&self, rows: &mut impl StageRows) {
    ///         for row in 0..rows.count() {
    ///             let positions = rows.positions(row);
    ///             let mut forces = [F64x8::from_f64(0.0); MOST_ROW_STAGES];
    ///             for stage in 0..rows.stages() {
    ///                 forces[stage] = force(positions[stage]);
    ///             }
    ///             rows.set_forces(row, forces);
    ///         }
    ///     }
    /// }
    ///
    /// # fn main() -> Result<(), symplectic::Error> {
    /// use symplectic::{Integrator, State};
    ///
    /// symplectic::tableau! { Gauss3 { basis: polynomial(3), nodes: gauss(3) } }
    ///
    /// let start = State::new(0.0, DVector::from_element(16, 1.0), DVector::zeros(16));
    /// let mut integrator = Integrator::new(Gauss3, Quartic, start, 0.1)?.in_second_order_lanes()?;
    /// integrator.take_steps(100)?;
    /// # Ok(())
    /// # }
    /// ```
    #[inline(always)]
    fn row_forces(&self, _rows: &mut impl StageRows) {}

    /// For a system of [unit masses](Self::UNIT_MASSES) that can do it in one pass over its components, as a [`Chain`](crate::system::Chain)
    /// can: kicks of the momenta by one force, one after the other, and a drift of the positions,
    ///
    /// ```text
    /// p = kick_k.fused(force(time, q), p)   for each kick      q = drift.fused(p, q)
    /// ```
    ///
    /// component by component, with the same bits as by [`force`](Self::force) and [`Scalar::fused`](crate::Scalar::fused). `false`
    /// where it cannot; then nothing may have changed, and an integrator makes them one after the other. The components are in their
    /// order, `layout` is natural, or in the [layout](Self::layout) that the system itself says for these slices.
    ///
    /// With plain sums and 64 components or more an integrator asks for it in blocks of explicit steps. It looks at one and at two
    /// kicks of the first state: where other bits come out of them than by `force`, making it fails with
    /// [`Error::NotTheSameForce`](crate::Error::NotTheSameForce). A system that wraps another one has to pass it on, with `layout` and
    /// `UNIT_MASSES`, to keep it.
    #[inline(always)]
    fn kick_and_drift(
        &self,
        _time: V::Scalar,
        _state: (&mut [V::Scalar], &mut [V::Scalar]),
        _layout: Layout,
        _kicks: &[V::Scalar],
        _drift: V::Scalar,
    ) -> bool {
        false
    }

    /// The layout in which [`kick_and_drift`](Self::kick_and_drift) goes fastest for positions and momenta that are where `q` and `p`
    /// are in memory. An integrator puts them into it for many passes, and back after them; one that has no place in them counts as
    /// [`Layout::NATURAL`].
    #[inline(always)]
    fn layout(&self, _q: &[V::Scalar], _p: &[V::Scalar]) -> Layout {
        Layout::NATURAL
    }

    /// H at `(time, q, p)`, where the system knows it. No method needs it.
    fn energy(&self, _time: V::Scalar, _q: &V, _p: &V) -> Option<V::Scalar> {
        None
    }
}

impl<V: Vector, S: SeparableHamiltonian<V>> Hamiltonian<V> for S {
    type Class = Separable;

    const UNIT_MASSES: bool = S::UNIT_MASSES;

    #[inline(always)]
    fn velocity(&self, time: V::Scalar, _q: &V, p: &V, velocity: &mut V) {
        SeparableHamiltonian::velocity(self, time, p, velocity);
    }

    #[inline(always)]
    fn force(&self, time: V::Scalar, q: &V, _p: &V, force: &mut V) {
        SeparableHamiltonian::force(self, time, q, force);
    }

    const LOCAL_FORCE: bool = S::LOCAL_FORCE;

    #[inline(always)]
    fn local_force(&self, time: V::Scalar, components: &mut impl Components<V::Scalar>) {
        SeparableHamiltonian::local_force(self, time, components);
    }

    const ROW_FORCES: bool = S::ROW_FORCES;

    #[inline(always)]
    fn row_forces(&self, rows: &mut impl StageRows) {
        SeparableHamiltonian::row_forces(self, rows);
    }

    #[inline(always)]
    fn kick_and_drift(
        &self,
        time: V::Scalar,
        state: (&mut [V::Scalar], &mut [V::Scalar]),
        layout: Layout,
        kicks: &[V::Scalar],
        drift: V::Scalar,
    ) -> bool {
        SeparableHamiltonian::kick_and_drift(self, time, state, layout, kicks, drift)
    }

    #[inline(always)]
    fn layout(&self, q: &[V::Scalar], p: &[V::Scalar]) -> Layout {
        SeparableHamiltonian::layout(self, q, p)
    }

    #[inline]
    fn energy(&self, time: V::Scalar, q: &V, p: &V) -> Option<V::Scalar> {
        SeparableHamiltonian::energy(self, time, q, p)
    }
}
