//! Friction with a method that has no such steps: an error at the call, in every profile.

symplectic::hamiltonian! { pub Oscillator q: [x], p: [px]; H = (px^2 + x^2)/2 friction: 0.1 }
symplectic::tableau! { pub Gauss2 { base: gauss-2 } }

fn main() {
    let start = symplectic::State::from_arrays(0.0, [1.0], [0.0]);
    let mut run = symplectic::Integrator::new(Gauss2, Oscillator::default(), start, 0.1).unwrap();
    run.take_steps(1).unwrap();
}
