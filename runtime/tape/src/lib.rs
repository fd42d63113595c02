//! Formulas that are known only when a program runs, as systems for the integrators of [`symplectic`].
//!
//! [`Tapes`] are the derivatives of H as lists of operations, which an interpreter applies; [`Formula`] is the system that
//! they make. The operations are those that `symplectic::hamiltonian!` emits for the same formula, so the results have the same bits. A
//! program with many trajectories pays less for the interpreter: it reads each operation once for all trajectories that are in SIMD lanes.
//!
//! ```
//! use std::sync::Arc;
//!
//! use symplectic::nalgebra::DVector;
//! use symplectic::{Integrator, Separable, State};
//! use symplectic_formula::{Form, Structure, System};
//! use symplectic_tape::{Formula, Parameters, Tapes, Values};
//!
//! symplectic::tableau! { StoermerVerlet { base: velocity-verlet } }
//!
//! let text = "Oscillator q: [x], p: [px]; H = px^2/2 + x^2/2";
//! let mut system = System::read_as(Form::Hamiltonian, "the oscillator", text)?;
//! let structure = Structure::of(&mut system);
//! assert!(structure.split.is_ok());
//!
//! let values = Values::of_bodies(1);
//! let tapes = Tapes::new(&mut system, &structure, &values, 0.0)?;
//! let oscillator = Formula::<Separable>::new(Arc::new(tapes), Parameters::none());
//! let start = State::new(0.0, DVector::from_element(1, 1.0), DVector::zeros(1));
//! let mut run = Integrator::new(StoermerVerlet, oscillator, start, 0.01)?;
//! let end = run.integrate_to(1.0)?;
//! assert!((end.q[0] - 1.0_f64.cos()).abs() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod assembly;
mod constraints;
mod formula;
mod inputs;
mod interpreter;
mod operation;
mod tape;
mod unroll;
mod values;

pub use constraints::Constraints;
pub use formula::{Formula, Tapes, Watch};
pub use tape::{At, Input, Parameters, Tape};
pub use unroll::{MAX_OPERATIONS, Refusal};
pub use values::{Entry, Values};
