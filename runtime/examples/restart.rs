//! A run that is saved in a file and resumed has the same bits as the run without a break:
//! `cargo run --release -p symplectic --features serde --example restart`

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use std::{env, fs};

use symplectic::{Integrator, State};

symplectic::tableau! {
    /// Gauss with four stages, order 8.
    Gauss4 { basis: polynomial(4), nodes: gauss(4), require: [symplectic, symmetric] }
}

symplectic::hamiltonian! { Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q| }

fn main() -> Result<(), Box<dyn Error>> {
    let start = || State::from_arrays(0.0, [0.4_f64, 0.0], [0.0, 2.0]);

    let mut run = Integrator::new(Gauss4, Kepler, start(), 0.05)?;
    run.take_steps(1000)?;
    let file = env::temp_dir().join("symplectic-restart.json");
    fs::write(&file, serde_json::to_string(&run.checkpoint()?)?)?;
    println!("saved at time {} in {}", run.state().time, file.display());
    run.take_steps(1000)?;

    // In another process: the integrator as it was made before, then the checkpoint.
    let mut resumed = Integrator::new(Gauss4, Kepler, start(), 0.05)?;
    resumed.restore(&serde_json::from_str(&fs::read_to_string(&file)?)?)?;
    resumed.take_steps(1000)?;
    fs::remove_file(&file)?;

    for (name, integrator) in [("without a break", &run), ("resumed", &resumed)] {
        let State { time, q, p } = integrator.state();
        println!(
            "{name:>15}: time {time}, q {:?}, p {:?}",
            q.as_slice(),
            p.as_slice()
        );
    }
    println!("equal: {}", run.state() == resumed.state());
    Ok(())
}
