//! The macro `lagrangian!`.

/// A system from the formula of its Lagrangian. If L is quadratic in the velocities, the Hamiltonian follows, and from it everything that
/// [`hamiltonian!`](macro@crate::hamiltonian) derives. Otherwise the type has the trait [`Lagrangian`](trait@crate::system::Lagrangian), and a
/// `variational::LagrangianIntegrator`, of the feature `mechanics`, takes its steps.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::{Error, Integrator, State};
///
/// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
///
/// symplectic::lagrangian! {
///     /// The double pendulum.
///     pub DoublePendulum { g: 9.81 }
///     q: [a, b], v: [va, vb];
///     let d = a - b;
///     L = va^2 + vb^2/2 + va vb cos(d) + g (2 cos(a) + cos(b))
/// }
///
/// # fn main() -> Result<(), Error> {
/// let pendulum = DoublePendulum::default();
/// let (q, v) = (SVector::from([1.0_f64, 2.0]), SVector::from([0.5, 0.0]));
/// let p = pendulum.momentum_of_velocity(0.0, &q, &v);
/// assert_eq!(p, SVector::from([2.0 * 0.5, (1.0_f64 - 2.0).cos() * 0.5]));
///
/// let mut run = Integrator::new(Gauss4, pendulum, State::new(0.0, q, p), 0.01)?;
/// let before = run.energy().expect("H is known");
/// run.integrate_to(100.0)?;
/// assert!((run.energy().expect("H is known") - before).abs() < 1e-11);
/// # Ok(())
/// # }
/// ```
///
/// The language is that of [`hamiltonian!`](macro@crate::hamiltonian), with velocities `v` in place of momenta `p`, and `L = …` in place of
/// `H = …`.
///
/// # From L to H
///
/// L is quadratic in the velocities if there are functions M, A and U of the positions and the time with
///
/// $$ L = \tfrac12 v^T M v + A^T v - U \qquad p = \frac{\partial L}{\partial v} = M v + A \qquad
/// H = \tfrac12 (p - A)^T M^{-1} (p - A) + U $$
///
/// Then H is a formula too. Velocities that M does not couple are not coupled in H. So a sum over bodies remains a loop, and the code is
/// that of the same system written with H. M is inverted in closed form for two or three coupled velocities, by elimination for up to
/// sixteen. Cartesian velocities may be written with sines and cosines of angles: `cos a cos b + sin a sin b = cos(a − b)` is used in M.
///
/// # Momenta
///
/// `momentum_of_velocity(time, &q, &v)` returns p for the start. The momentum of a coordinate `a` is called `pa`, or `p_a` if that name is
/// taken. `invariants: { … }` are written with momenta.
///
/// # Regular Lagrangians
///
/// M has to be regular. If it consists of numbers, that is proved; otherwise its determinant is evaluated at random points, exactly. If it
/// vanishes, positions and momenta obey a primary constraint, which is not an ordinary Hamiltonian system. The error names it. A
/// `variational::DiracIntegrator` takes such Lagrangians.
///
/// ```compile_fail
/// symplectic::lagrangian! {
///     // error: L does not contain `vx`: px = 0 is a primary constraint
///     Degenerate q: [x, y], v: [vx, vy]; L = vy^2/2 - x y
/// }
/// ```
///
/// # Other Lagrangians
///
/// If L is not quadratic in the velocities, H has no formula. The documentation of the type says so, and the same methods take their steps
/// in Lagrangian form, with velocities as unknowns. Applied forces are allowed; constraints, friction, invariants and `require` need H.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::variational::LagrangianSteps;
///
/// symplectic::tableau! { Gauss3 { basis: polynomial(3), nodes: gauss(3) } }
///
/// symplectic::lagrangian! {
///     /// A relativistic particle in a trap.
///     Relativistic { m: 1, c: 1 } q: [3], v: [3]; L = -m c^2 sqrt(1 - |v|^2/c^2) - |q|^2/2
/// }
///
/// # fn main() -> Result<(), symplectic::variational::Error> {
/// let (q, v) = (SVector::from([1.0, 0.0, 0.0]), SVector::from([0.0, 0.9, 0.0]));
/// let mut run = LagrangianSteps::from_velocity(Gauss3, Relativistic::new(), 0.0, q, v, 0.05)?;
/// let energy = run.stepper().energy()?;
/// run.integrate_to(100.0)?;
/// assert!((run.stepper().energy()? - energy).abs() < 1e-8);
/// # Ok(())
/// # }
/// ```
pub use symplectic_macros::lagrangian;
