//! The macro `hamiltonian!`.

/// A Hamiltonian system from its formula: everything else is derived while the crate compiles.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::{Error, Integrator, State};
///
/// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
///
/// symplectic::hamiltonian! {
///     /// The double pendulum.
///     pub DoublePendulum { g: 9.81 }
///     q: [a, b], p: [pa, pb];
///     let d = a - b;
///     H = (pa^2 + 2 pb^2 - 2 pa pb cos(d)) / (2 (1 + sin(d)^2)) - g (2 cos(a) + cos(b))
/// }
///
/// # fn main() -> Result<(), Error> {
/// let start = State::new(0.0, SVector::from([1.0_f64, 2.0]), SVector::from([0.0, 0.0]));
/// let mut run = Integrator::new(Gauss4, DoublePendulum { g: 1.62 }, start, 0.01)?;
/// let before = run.energy().expect("H is known");
/// run.integrate_to(100.0)?;
/// assert!((run.energy().expect("H is known") - before).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
///
/// The macro makes the type with a field for each parameter, and implements [`SeparableHamiltonian`](crate::SeparableHamiltonian) or
/// [`Hamiltonian`](crate::Hamiltonian) for it, whichever it finds. The derivatives are exact, first and second. The
/// [second](crate::Hamiltonian::second_derivatives) are for Newton's iteration, [`by_newton`](crate::Integrator::by_newton), with a
/// [band](crate::Hamiltonian::half_bandwidth) where only neighbours interact. The page of the type shows H, the equations of motion
/// and what was found.
///
/// A system may also be given by its Lagrangian: [`lagrangian!`](macro@crate::lagrangian).
///
/// # Coordinates
///
/// | written | coordinates | vectors |
/// |---|---|---|
/// | `q: [a, b], p: [pa, pb];` | with names | `SVector<T, 2>` |
/// | `q: [4], p: [4];` | `q[0]` … `q[3]` | `SVector<T, 4>` |
/// | `Name<N>`, a capital letter, and `q: [N; 3], p: [N; 3];` | `N` bodies in space, `q[i]` is a vector | `SMatrix<T, 3, N>`, a column each |
/// | `q: [..], p: [..];`, `q: [..; 3], p: [..; 3];` | as many as there are at run time | `DVector<T>` |
///
/// # Parameters
///
/// `{ g: 9.81, omega, m: [N], A: [3, 3], charges: [..], springs: pairs, stiffness: [springs] }`: a number with its value unless it is
/// set, a number, arrays and a matrix, and pairs of indices from data. They are public fields; `Name::new(…)` takes those without a value,
/// in order. Where all have one there is a `Default`.
///
/// # Formulas
///
/// Factors that follow one another are multiplied; what follows a quotient needs parentheses. There are `+ - * / ^`, whole and rational
/// powers, `sqrt exp ln sin cos tan asin acos atan sinh cosh tanh atan2 hypot`, `pi`, the time `t`, vectors `[x, y, z]` with `|v|`,
/// `dot(v, w)` and `cross(v, w)`, and a matrix times a vector.
///
/// | written | sum over |
/// |---|---|
/// | `sum(i: p[i]^2)`, `sum(i in 0..N: …)` | an index |
/// | `sum(i < j: …)` | all pairs |
/// | `sum((i, j) in springs: …)`, `sum(s = (i, j) in springs: stiffness[s] …)` | the pairs of a parameter; `s` is the number of the pair |
/// | `bonds: walls;` and `sum(bonds d: d^2/2)` | the bonds of a chain between `walls`, with `free` ends, or in a `ring`; `d` is the stretch |
///
/// `let d = a - b;` is an abbreviation, `let s(i, j) = sigma^2/|q[i] - q[j]|^2;` one with arguments. `extern fn V with dV, d2V;` names
/// functions in scope, `fn V<T: Scalar>(x: T) -> T` and its two derivatives. They must be generic, also functions of a parameter alone. H
/// has to be twice continuously differentiable: `abs`, `min` and `max` are refused; `|x|^3` is not.
///
/// # Constraints and friction
///
/// `constraints: { rod = |q[0]|^2 - 1, link(i in 1..N) = |q[i] - q[i-1]|^2 - 1 }` says what is zero: functions of the positions, or vectors
/// of them, one or one for each index; `rod(s = (i, j) in rods) = …` has one for each pair of a parameter. The class of the system is
/// then [`Constrained`](crate::Constrained), and methods that are `constrained` step it.
///
/// `nonholonomic: { edge = vx sin(a) - vy cos(a) }` says which forms of the velocities are zero, each a sum of velocities times functions of
/// the positions; `v: [vx, vy, va]` after `p: […]` names the velocities for this section. The class is then
/// [`Nonholonomic`](crate::Nonholonomic), and methods that are `nonholonomic` step it.
///
/// `friction: gamma` adds the force `−γp` to a separable system; `friction: [a, b]` has a rate for each coordinate, or, if positions are
/// vectors, for each component of a vector. The class is [`Damped`](crate::Damped), for splittings.
///
/// ```
/// use symplectic::{Error, Integrator, State};
///
/// symplectic::tableau! { Lobatto3 { basis: polynomial(3), nodes: lobatto(3), require: [constrained, order == 4] } }
///
/// symplectic::hamiltonian! {
///     /// A pendulum in the plane.
///     pub Pendulum { g: 9.81, l: 1 }
///     q: [x, y], p: [px, py];
///     H = (px^2 + py^2)/2 + g y
///     constraints: { rod = x^2 + y^2 - l^2 }
/// }
///
/// # fn main() -> Result<(), Error> {
/// let start = State::from_arrays(0.0, [0.6, -0.8], [0.0, 0.0]);
/// let mut run = Integrator::new(Lobatto3, Pendulum::default(), start, 0.01)?;
/// let [x, y]: [f64; 2] = run.integrate_to(10.0)?.to_arrays().0;
/// assert!((x.hypot(y) - 1.0).abs() < 1e-15);
/// # Ok(())
/// # }
/// ```
///
/// # Conserved quantities
///
/// A momentum is conserved where H has a symmetry that shows in its form: where all positions can be moved together there is a method
/// `total_momentum`, where they can be turned `angular_momentum`. `invariants: { name = …, }` adds methods of your own. One that belongs
/// to a symmetry of the formula is proved; of any other the Poisson bracket with H is computed at a few states, and what is not zero there
/// does not compile. The page of the method says which. `invariants(&start)` makes an [`Invariant`](crate::Invariant) of each of these
/// numbers, and of the energy, with its name: `observe` the states of a run, and they know the largest deviation.
///
/// ```
/// use symplectic::State;
/// use symplectic::nalgebra::SMatrix;
///
/// symplectic::hamiltonian! {
///     /// `N` bodies.
///     pub Planets<N> { m: [N], G: 2.95912208286e-4 }
///     q: [N; 3], p: [N; 3];
///     H = sum(i: |p[i]|^2 / (2 m[i])) - sum(i < j: G m[i] m[j] / |q[i] - q[j]|)
///     require: [separable, quadratic_kinetic]
/// }
///
/// let planets = Planets::new([1.0, 9.5e-4]);
/// let q = SMatrix::<f64, 3, 2>::from([[0.0, 0.0, 0.0], [5.2, 0.0, 0.0]]);
/// let p = SMatrix::from([[0.0, -7e-6, 0.0], [0.0, 7e-6, 0.0]]);
/// assert_eq!(planets.total_momentum(&q, &p), [0.0; 3]);
/// assert_eq!(planets.angular_momentum(&q, &p), [0.0, 0.0, 5.2 * 7e-6]);
///
/// let observers = planets.invariants(&State::new(0.0, q, p));
/// let names = observers.each_ref().map(|(name, _)| *name);
/// assert_eq!(names[..3], ["energy", "total_momentum[0]", "total_momentum[1]"]);
/// assert_eq!((names[6], observers[6].1.initial()), ("angular_momentum[2]", 5.2 * 7e-6));
/// ```
///
/// # Requirements
///
/// `require: […]` proves what is found: `separable`, `quadratic_kinetic` (with constant masses), `unit_masses`, `time_independent`,
/// `chain`. What does not hold is an error at the term that violates it.
///
/// ```compile_fail
/// symplectic::hamiltonian! {
///     // error: the system is not separable: this term depends on positions and momenta
///     Coupled q: [x], p: [px]; H = px^2/2 + x px require: [separable]
/// }
/// ```
///
/// # Order of evaluation
///
/// The same text gives the same bits, in doubles and in lanes. Numbers that are factors are collected exactly; equal terms and factors are
/// joined; terms and factors are taken in the order in which they first appear, a sum or product in parentheses as one. What depends on
/// parameters only is computed in double precision first; divisors are multiplied with each other, and divide last. Parts that appear more
/// than once are computed once, for velocity and force together where H is not separable. Sums are loops, so the code is as long for a
/// thousand bodies as for three.
pub use symplectic_macros::hamiltonian;
