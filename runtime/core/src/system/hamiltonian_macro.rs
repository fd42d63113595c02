//! The macro `hamiltonian!`.

/// Defines a Hamiltonian system by its formula. Everything else is derived while the crate compiles.
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
/// The macro makes the type, with a field for each parameter. It implements [`SeparableHamiltonian`](crate::SeparableHamiltonian) or
/// [`Hamiltonian`](crate::Hamiltonian), depending on the class of H. The derivatives are exact, first and second. Newton's iteration,
/// `by_newton`, uses the [second](crate::Hamiltonian::second_derivatives); they are
/// [banded](crate::Hamiltonian::half_bandwidth) if only neighbours interact. The documentation of the type shows H, the equations of motion
/// and the properties found.
///
/// A system may also be given by its Lagrangian: [`lagrangian!`](macro@crate::lagrangian).
///
/// # Coordinates
///
/// | written | coordinates | vectors |
/// |---|---|---|
/// | `q: [a, b], p: [pa, pb];` | with names | `SVector<T, 2>` |
/// | `q: [q], p: [p];` | a single one, with its letter as its name | `SVector<T, 1>` |
/// | `q: [4], p: [4];` | `q[0]` … `q[3]` | `SVector<T, 4>` |
/// | `Name<N>`, a capital letter, and `q: [N; 3], p: [N; 3];` | `N` bodies in space, `q[i]` is a vector | `SMatrix<T, 3, N>`, a column each |
/// | `q: [..], p: [..];`, `q: [..; 3], p: [..; 3];` | numbers or vectors, whose count is known at run time only | `DVector<T>`, one body after the other: `x0, y0, z0, x1, …` |
///
/// Indices begin at 0. A name has one meaning: a parameter, a coordinate, an abbreviation, a function and the index of a sum need different
/// names.
///
/// # Parameters
///
/// They are listed in braces, `{ g: 9.81, omega, m: [N] }`:
///
/// | written | parameter |
/// |---|---|
/// | `g: 9.81` | a number with a default |
/// | `omega` | a number |
/// | `m: [N]`, `charges: [..]` | an array: of `N` numbers, or of a length known at run time only |
/// | `A: [3, 3]` | a matrix |
/// | `springs: pairs` | pairs of indices |
/// | `stiffness: [springs]` | an array with a number for each of these pairs |
///
/// Parameters are public fields. `Name::new(…)` takes those without a default, in order. If every parameter has a default, the type
/// implements `Default`. When an integrator is created, it checks that the lengths and pairs fit the state.
///
/// # Formulas
///
/// Juxtaposition is multiplication: `2 a b`. A product after `/` needs parentheses. A formula may contain
///
/// * `+ - * / ^`, `pi`, and the time `t`;
/// * what formulas are printed with: `x²`, `√(1 + x²)`, `π` (in files; the macros read Rust's own characters);
/// * `sqrt exp ln sin cos tan asin acos atan sinh cosh tanh atan2 hypot abs max min`;
/// * vectors `[x, y, z]` with `|v|`, `dot(v, w)` and `cross(v, w)`, and a matrix times a vector. A vector of one component is a number where
///   a number is meant.
///
/// | written | sum over |
/// |---|---|
/// | `sum(i: p[i]^2)`, `sum(i in 0..N: …)` | an index; `0..N` ends before `N` |
/// | `sum(i < j: …)` | all pairs |
/// | `sum((i, j) in springs: …)`, `sum(s = (i, j) in springs: stiffness[s] …)` | the pairs of a parameter; `s` is the number of the pair |
/// | `bonds: walls;` and `sum(bonds d: d^2/2)` | the bonds of a chain between `walls`, with `free` ends, or in a `ring`; `d` is the stretch |
///
/// The number of coordinates is the length `N`, or `sum(i: 1)` for `[..]`.
///
/// `let d = a - b;` is an abbreviation; `let s(i, j) = sigma^2/|q[i] - q[j]|^2;` has arguments. `extern fn V with dV, d2V;` names functions
/// in scope: `fn V<T: Scalar>(x: T) -> T` and its two derivatives. They must be generic, even if they depend on a parameter only. H must be
/// twice continuously differentiable, a force once. `|x|`, `abs`, `max`, `min` and `sqrt(x^2)` may be in it where the whole is: in H
/// `|x|^3`, `x^2 |x|` or `max(x, 0)^(5/2)`, in a force `px |px|` or `max(x, 0)^2`. Their derivatives are finite at the kink. Those of
/// `|x| sin(|x|)`, whose second derivative contains the square of `x/|x|`, are not computed there: a step from it returns an error. The length
/// of a vector may be in any formula; where it is zero and the formula is not differentiable, a step returns an error. Constants must be
/// finite in double precision.
///
/// # Constraints, friction and forces
///
/// `constraints: { rod = |q[0]|^2 - 1, link(i in 1..N) = |q[i] - q[i-1]|^2 - 1 }` lists the functions φ(q) that vanish. They are numbers or
/// vectors. `link(i in 1..N)` is one for each index; `rod(s = (i, j) in rods) = …` is one for each pair of a parameter. The class of the
/// system is `constraints::Constrained` (feature `mechanics`), for methods that are `constrained`.
///
/// `nonholonomic: { edge = vx sin(a) - vy cos(a) }` lists the linear forms of the velocities that vanish. Their coefficients are functions
/// of the positions. `v: [vx, vy, va]` after `p: […]` names the velocities for this section. The class of the system is
/// `constraints::Nonholonomic` (feature `mechanics`), for methods that are `nonholonomic`.
///
/// `friction: gamma` adds the force `−γp` to a separable system. `friction: [a, b]` has a rate for each coordinate or, if positions are
/// vectors, for each component of a vector. The class of the system is `friction::Damped` (feature
/// `flows`), for splittings.
///
/// `force: { x = -c px + cos(t) }` adds forces without a potential, `force: { q[i] = -c p[i] }` one for each index. If a force depends on
/// momenta, the class of the system is [`General`](crate::General), with constraints `Constrained<General>`.
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
/// A symmetry that is visible in the formula gives a conserved momentum and a method for it. Translation symmetry gives `total_momentum`,
/// rotation symmetry `angular_momentum`. The methods return the conserved components only; the documentation of the type names them:
/// `total_momentum` in x and y, `angular_momentum` about z.
///
/// `invariants: { name = …, }` adds methods for your own invariants. An invariant that follows from a symmetry is proved. For any other the
/// Poisson bracket with H is evaluated at three states and must vanish; otherwise the definition does not compile. The documentation of the
/// method says whether the invariant is proved.
///
/// `invariants(&start)` makes an [`Invariant`](crate::Invariant) of the energy and of each of these numbers, with its name. `observe` the
/// states of a run with it; it keeps the largest deviation.
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
/// `require: […]` demands properties of the system: `separable`, `quadratic_kinetic` (with constant masses), `unit_masses`,
/// `time_independent`, `chain`. A requirement that fails is an error at the violating term.
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
/// * The same text gives the same bits, for one trajectory and in an ensemble.
/// * Numeric factors are multiplied exactly, and equal terms and factors are combined. The others keep the order in which they first
///   appear; a sum or product in parentheses counts as one.
/// * Expressions of parameters only are computed first, in double precision. Divisors are multiplied with each other, and divide last.
/// * Common subexpressions are computed once, for velocity and force together if H is not separable.
/// * Sums are loops: the code is as long for a thousand bodies as for three.
pub use symplectic_macros::hamiltonian;
