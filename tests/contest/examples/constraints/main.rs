//! Constrained steps against hand-written code, and the cost of a chain of links:
//! `cargo run --release -p symplectic-contest --example constraints`.
//!
//! Rigid triangles in a plane trap: RATTLE of the library against SHAKE and RATTLE as usually written, bond by bond
//! until the error of every bond is below a tolerance. Chains of links: time per link and step. The double pendulum in
//! Cartesian coordinates and in angles, by methods of order 4, 6 and 8.

#![allow(clippy::print_stdout, reason = "it prints")]

use cpu_time::ThreadTime;
use symplectic::nalgebra::{DVector, SVector};
use symplectic::{Constrained, Error, General, Integrator, Method, ProvedFor, Separable, State};

symplectic::tableau! {
    Rattle { basis: polynomial(2), nodes: lobatto(2), require: [constrained] }
    Lobatto3 { basis: polynomial(3), nodes: lobatto(3), require: [constrained] }
    Lobatto4 { basis: polynomial(4), nodes: lobatto(4), require: [constrained] }
    Lobatto5 { basis: polynomial(5), nodes: lobatto(5), require: [constrained] }
}

symplectic::hamiltonian! {
    /// Rigid triangles in a trap.
    pub Triangles { m: [..], rods: pairs, length: [rods] }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/(2 m[i]) + |q[i]|^2/2)
    constraints: { rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - length[s]^2 }
}

symplectic::hamiltonian! {
    /// A hanging chain.
    pub Chain { rods: pairs }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/2 + q[i][1])
    constraints: { anchor = |q[0]|^2 - 1, rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - 1 }
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

/// Number of runs of each program, in turn.
const RUNS: usize = 9;

/// The median CPU times of two programs that run in turn, in seconds.
fn medians(mut programs: [Box<dyn FnMut() + '_>; 2]) -> [f64; 2] {
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..RUNS {
        for (program, times) in programs.iter_mut().zip(&mut times) {
            let start = ThreadTime::now();
            program();
            times.push(start.elapsed().as_secs_f64());
        }
    }
    times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[RUNS / 2]
    })
}

/// Hand-written code for the triangles.
struct ByHand {
    masses: Vec<f64>,
    rods: Vec<(usize, usize, f64)>,
    q: Vec<[f64; 2]>,
    p: Vec<[f64; 2]>,
    force: Vec<[f64; 2]>,
}

impl ByHand {
    /// Largest relative error of the length of a bond.
    const TOLERANCE: f64 = 1e-14;

    fn kick(&mut self, h: f64) {
        for (p, force) in self.p.iter_mut().zip(&self.force) {
            for k in 0..2 {
                p[k] += 0.5 * h * force[k];
            }
        }
    }

    fn step(&mut self, h: f64) {
        self.kick(h);
        let before = self.q.clone();
        for ((q, p), m) in self.q.iter_mut().zip(&self.p).zip(&self.masses) {
            for k in 0..2 {
                q[k] += h * p[k] / m;
            }
        }
        for molecule in self.rods.chunks(3) {
            for _ in 0..100 {
                let mut largest = 0.0_f64;
                for &(i, j, length) in molecule {
                    let d = [0, 1].map(|k| self.q[i][k] - self.q[j][k]);
                    let off = d[0] * d[0] + d[1] * d[1] - length * length;
                    largest = largest.max(off.abs() / (length * length));
                    let old = [0, 1].map(|k| before[i][k] - before[j][k]);
                    let inverse = 1.0 / self.masses[i] + 1.0 / self.masses[j];
                    let factor = off / (2.0 * inverse * (d[0] * old[0] + d[1] * old[1]));
                    for (k, old) in old.into_iter().enumerate() {
                        self.q[i][k] -= factor * old / self.masses[i];
                        self.q[j][k] += factor * old / self.masses[j];
                        self.p[i][k] -= factor * old / h;
                        self.p[j][k] += factor * old / h;
                    }
                }
                if largest <= Self::TOLERANCE {
                    break;
                }
            }
        }
        for (force, q) in self.force.iter_mut().zip(&self.q) {
            *force = [-q[0], -q[1]];
        }
        self.kick(h);
        for molecule in self.rods.chunks(3) {
            for _ in 0..100 {
                let mut largest = 0.0_f64;
                for &(i, j, length) in molecule {
                    let d = [0, 1].map(|k| self.q[i][k] - self.q[j][k]);
                    let v = [0, 1]
                        .map(|k| self.p[i][k] / self.masses[i] - self.p[j][k] / self.masses[j]);
                    let rate = d[0] * v[0] + d[1] * v[1];
                    largest = largest.max(rate.abs() / length);
                    let inverse = 1.0 / self.masses[i] + 1.0 / self.masses[j];
                    let factor = rate / (inverse * length * length);
                    for (k, d) in d.into_iter().enumerate() {
                        self.p[i][k] -= factor * d;
                        self.p[j][k] += factor * d;
                    }
                }
                if largest <= Self::TOLERANCE {
                    break;
                }
            }
        }
    }
}

fn triangles() -> Result<(), Error> {
    const COUNT: usize = 1000;
    const STEPS: usize = 20;
    const H: f64 = 0.02;
    let (mut masses, mut pairs, mut lengths) = (Vec::new(), Vec::new(), Vec::new());
    let (mut q, mut p) = (Vec::new(), Vec::new());
    for molecule in 0..COUNT {
        let first = 3 * molecule;
        masses.extend([16.0, 1.0, 1.0]);
        pairs.extend([
            (first, first + 1),
            (first, first + 2),
            (first + 1, first + 2),
        ]);
        lengths.extend([1.0, 1.0, 2.0_f64.sqrt()]);
        let center = [(molecule % 32) as f64 * 0.1, (molecule / 32) as f64 * 0.1];
        let spin = 0.2 + 0.001 * molecule as f64;
        for (place, mass) in [([0.0, 0.0], 16.0), ([1.0, 0.0], 1.0), ([0.0, 1.0], 1.0)] {
            q.push([center[0] + place[0], center[1] + place[1]]);
            p.push([-spin * place[1] * mass, spin * place[0] * mass]);
        }
    }
    let flat = |vectors: &[[f64; 2]]| DVector::from_vec(vectors.concat());
    let mut by_hand = ByHand {
        rods: pairs
            .iter()
            .zip(&lengths)
            .map(|(&(i, j), &l)| (i, j, l))
            .collect(),
        force: q.iter().map(|q| [-q[0], -q[1]]).collect(),
        masses: masses.clone(),
        q: q.clone(),
        p: p.clone(),
    };
    let system = Triangles::new(masses, pairs, lengths);
    let mut run = Integrator::new(Rattle, system, State::new(0.0, flat(&q), flat(&p)), H)?;
    let [library, hand] = medians([
        Box::new(|| {
            run.take_steps(STEPS as u64).expect("steps");
        }),
        Box::new(|| {
            for _ in 0..STEPS {
                by_hand.step(H);
            }
        }),
    ]);
    let difference = (&run.state().q - flat(&by_hand.q)).amax();
    println!(
        "{COUNT} rigid triangles, RATTLE: {:.0} ns a triangle and step, by hand {:.0}: {:.2} times; the positions differ by {difference:.0e}",
        library * 1e9 / (COUNT * STEPS) as f64,
        hand * 1e9 / (COUNT * STEPS) as f64,
        library / hand
    );
    Ok(())
}

fn chains() -> Result<(), Error> {
    for links in [100, 1000, 10_000] {
        let chain = Chain::new((1..links).map(|k| (k - 1, k)).collect());
        let place = |k: usize, _: usize| {
            if k.is_multiple_of(2) {
                (k / 2 + 1) as f64
            } else {
                0.0
            }
        };
        let start = State::new(
            0.0,
            DVector::from_fn(2 * links, place),
            DVector::zeros(2 * links),
        );
        let mut run = Integrator::new(Rattle, chain, start, 0.002)?;
        run.take_steps(2)?;
        let start = ThreadTime::now();
        run.take_steps(100)?;
        println!(
            "chain of {links} links, RATTLE: {:.0} ns a link and step",
            start.elapsed().as_secs_f64() * 1e7 / links as f64
        );
    }
    Ok(())
}

/// Both forms of the double pendulum to an error of 1e-9 by a method; returns the ratio of their times. Begins with a number of steps.
fn double_pendulum<M>(method: M, first: u64) -> Result<f64, Error>
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

fn main() -> Result<(), Error> {
    triangles()?;
    chains()?;
    let ratios = [
        double_pendulum(Lobatto3, 1000)?,
        double_pendulum(Lobatto4, 150)?,
        double_pendulum(Lobatto5, 60)?,
    ];
    let mean = ratios.iter().product::<f64>().cbrt();
    println!("geometric mean of the three: {mean:.2} times the time");
    Ok(())
}
