//! Pendulums on one rod and on two.

use symplectic::constraints::Constrained;
use symplectic::nalgebra::SVector;
use symplectic::{Error, General, Integrator, Method, ProvedFor, Separable, State};

use crate::{Lobatto3, Rattle, medians};

symplectic::hamiltonian! {
    /// A mass on one rod.
    pub Pendulum
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + y
    constraints: { rod = x^2 + y^2 - 1 }
}

symplectic::hamiltonian! {
    /// The double pendulum in Cartesian coordinates.
    pub Plane
    q: [x1, y1, x2, y2], p: [px1, py1, px2, py2];
    H = (px1^2 + py1^2 + px2^2 + py2^2)/2 + y1 + y2
    constraints: { first = x1^2 + y1^2 - 1, second = (x2 - x1)^2 + (y2 - y1)^2 - 1 }
}

symplectic::lagrangian! {
    /// The double pendulum in angles.
    pub Angles
    q: [a, b], v: [va, vb];
    L = va^2 + vb^2/2 + va vb cos(a - b) + 2 cos(a) + cos(b)
}

/// A step of RATTLE for [`Pendulum`] with one number for the multiplier, by Newton's iteration. Returns the new state.
fn by_hand([x0, y0, px, py]: [f64; 4], h: f64) -> [f64; 4] {
    let half = 0.5 * h;
    let (mut px, mut py) = (px, py - half);
    let (mut x, mut y) = (x0 + h * px, y0 + h * py);
    for _ in 0..20 {
        let off = x * x + y * y - 1.0;
        if off.abs() <= 2.0 * f64::EPSILON {
            break;
        }
        let impulse = off / (2.0 * h * (x * x0 + y * y0));
        (px, py) = (px - impulse * x0, py - impulse * y0);
        (x, y) = (x0 + h * px, y0 + h * py);
    }
    py -= half;
    let impulse = (x * px + y * py) / (x * x + y * y);
    [x, y, px - impulse * x, py - impulse * y]
}

/// The pendulum by RATTLE and by Lobatto with three stages, against RATTLE by hand.
pub fn one_rod() -> Result<(), Error> {
    const STEPS: usize = 100_000;
    const H: f64 = 1.0 / 64.0;
    let start = || State::from_arrays(0.0, [0.6, -0.8], [0.0; 2]);
    let mut rattle = Integrator::new(Rattle, Pendulum, start(), H)?;
    let mut lobatto = Integrator::new(Lobatto3, Pendulum, start(), H)?;
    let mut state = [0.6, -0.8, 0.0, 0.0];
    let [library, higher, hand] = medians([
        Box::new(|| {
            rattle.take_steps(STEPS as u64).expect("steps");
        }),
        Box::new(|| {
            lobatto.take_steps(STEPS as u64).expect("steps");
        }),
        Box::new(|| (0..STEPS).for_each(|_| state = by_hand(state, H))),
    ])
    .map(|time| time * 1e9 / STEPS as f64);
    let ([x, y], _) = rattle.state().to_arrays();
    println!(
        "pendulum on one rod: RATTLE {library:.0} ns a step, by hand {hand:.0}: {:.1} times; the positions differ by {:.0e}; \
         Lobatto3 {higher:.0} ns, {:.1} times",
        library / hand,
        (x - state[0]).abs().max((y - state[1]).abs()),
        higher / hand
    );
    Ok(())
}

/// Both forms of the double pendulum to an error of 1e-9 by a method; returns the ratio of their times. Begins with a number of steps.
pub fn two_rods<M>(method: M, first: u64) -> Result<f64, Error>
where
    M: Method + ProvedFor<Constrained<Separable>> + ProvedFor<General> + Copy,
{
    let (a, b) = (1.2_f64, 2.0_f64);
    let place = |a: f64, b: f64| {
        let first = [a.sin(), -a.cos()];
        [first[0], first[1], first[0] + b.sin(), first[1] - b.cos()]
    };
    let plane = |steps: u64| {
        let start = State::from_arrays(0.0, place(a, b), [0.0; 4]);
        let mut run = Integrator::new(method, Plane, start, 10.0 / steps as f64)?;
        run.take_steps(steps)?;
        Ok::<_, Error>(run.state().to_arrays().0)
    };
    let angles = |steps: u64| {
        let start = State::new(0.0, SVector::from([a, b]), SVector::from([0.0, 0.0]));
        let mut run = Integrator::new(method, Angles, start, 10.0 / steps as f64)?;
        run.take_steps(steps)?;
        let [a, b] = run.state().to_arrays().0;
        Ok::<_, Error>(place(a, b))
    };
    let exact = angles(8000)?;
    let error = |found: [f64; 4]| {
        found
            .iter()
            .zip(exact)
            .fold(0.0_f64, |e, (x, y)| e.max((x - y).abs()))
    };
    // A number of steps for an error of 1e-9, within one per cent.
    let wanted = |run: &dyn Fn(u64) -> Result<[f64; 4], Error>| -> Result<u64, Error> {
        let mut steps = first;
        while error(run(steps)?) > 1e-9 {
            steps += 1 + steps / 100;
        }
        Ok(steps)
    };
    let counts = [wanted(&plane)?, wanted(&angles)?];
    let times = medians([
        Box::new(|| (0..20).for_each(|_| drop(plane(counts[0])))),
        Box::new(|| (0..20).for_each(|_| drop(angles(counts[1])))),
    ]);
    println!(
        "double pendulum to 1e-9 at t = 10, {}: in coordinates {} steps, error {:.0e}, by angles {} steps, error {:.0e}: {:.2} times the time",
        M::NAME,
        counts[0],
        error(plane(counts[0])?),
        counts[1],
        error(angles(counts[1])?),
        times[0] / times[1]
    );
    Ok(times[0] / times[1])
}
