//! A Hamiltonian of one's own, three methods, one call, a page: `cargo run --release -p symplectic-report --example my_problem`

#![allow(clippy::print_stdout, reason = "an example prints")]

use symplectic::State;
use symplectic_report::{Problem, Reference, Study};

symplectic::tableau! {
    /// Störmer–Verlet, order 2, explicit.
    Verlet { basis: polynomial(2), nodes: lobatto(2) }

    /// Gauss with three stages, order 6.
    Gauss3 { basis: polynomial(3), nodes: gauss(3) }

    /// Gauss with eight stages, order 16: for the reference.
    Gauss8 { basis: polynomial(8), nodes: gauss(8) }
}

symplectic::composition! {
    /// Blanes & Moan, order 6 for quadratic kinetic energy, explicit.
    BlanesMoan { base: blanes-moan-2002-srkn14a }
}

symplectic::hamiltonian! {
    /// A particle on a spring without a rest length that is weaker in one direction, in a quartic well.
    Well
    q: [2], p: [2];
    H = (|p|^2 + q[0]^2 + 2 q[1]^2)/2 + |q|^4/4
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let start = State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.5]);
    let reference = Reference::computed(Gauss8, Well, &start, 100.0, 0.1)?;

    let problem = Problem::new("A well", Well, start, reference, 1.0)
        .described("H = (|p|² + q₁² + 2q₂²)/2 + |q|⁴/4")
        .method(Verlet)
        .method(BlanesMoan)
        .method(Gauss3);
    let study = Study::new("My problem").problem(problem);
    let page = study.measure().write("target/my_problem")?;
    println!("{}", page.display());
    Ok(())
}
