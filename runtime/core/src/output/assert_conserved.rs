//! A test assertion: a run conserves a quantity.

/// Takes steps and asserts that a function of the state stays within a bound of its first value.
///
/// `assert_conserved!(run, steps, function, bound)` takes `steps` steps of `run`, an [`Integrator`](crate::Integrator) or any other
/// integrator of this crate; `function` maps a reference to its state to `f64`. It panics if a step fails, or if the function differs from
/// its first value by more than `bound`. The message states the difference and the step.
///
/// ```
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
/// symplectic::hamiltonian! { Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q| }
/// # use symplectic::{Error, Integrator, State, assert_conserved};
/// # use symplectic::nalgebra::Vector2;
/// # fn main() -> Result<(), Error> {
/// let start = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::new(0.0, 2.0));
/// let mut run = Integrator::new(Gauss2, Kepler, start, 0.05)?;
/// assert_conserved!(run, 1000, |state: &State<Vector2<f64>>| state.q.perp(&state.p), 1e-14);
/// # Ok(())
/// # }
/// ```
///
/// The energy is not conserved to this bound:
///
/// ```should_panic
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
/// symplectic::hamiltonian! { Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q| }
/// # use symplectic::{Error, Integrator, State, System, assert_conserved};
/// # use symplectic::nalgebra::Vector2;
/// # fn main() -> Result<(), Error> {
/// let start = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::new(0.0, 2.0));
/// let mut run = Integrator::new(Gauss2, Kepler, start, 0.05)?;
/// let energy = |state: &State<Vector2<f64>>| Kepler.energy(state.time, &state.q, &state.p).expect("it is known");
/// assert_conserved!(run, 1000, energy, 1e-14);
/// # Ok(())
/// # }
/// ```
#[macro_export]
macro_rules! assert_conserved {
    ($run:expr, $steps:expr, $function:expr, $bound:expr $(,)?) => {{
        let mut invariant = $crate::Invariant::new($function, $run.state());
        let bound: f64 = $bound;
        for step in 1..=$steps {
            match $run.step() {
                ::core::result::Result::Ok(state) => invariant.observe(state),
                ::core::result::Result::Err(error) => ::core::panic!("{}", error),
            }
            ::core::assert!(
                invariant.deviation() <= bound,
                "`{}` is not conserved: {:e} from its first value {:e} after step {}, more than {:e}",
                ::core::stringify!($function),
                invariant.deviation(),
                invariant.initial(),
                step,
                bound
            );
        }
    }};
}
