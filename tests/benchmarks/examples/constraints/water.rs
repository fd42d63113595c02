//! A planar box of rigid triangles with a short-range force between their atoms, against SHAKE and RATTLE as usually written: bond by bond
//! until the error of every bond is below a tolerance. Both programs call the same code for the forces.

use core::cell::RefCell;
use symplectic::constraints::{Constrained, Gradients, HolonomicConstraints};

use symplectic::nalgebra::DVector;
use symplectic::solver::FixedPoint;
use symplectic::{Error, Integrator, Separable, State, System};

use crate::{Rattle, medians};

/// Number of triangles, and of those in a row.
const COUNT: usize = 1000;
const ROW: usize = 32;
/// Distance of neighbouring triangles at the start.
const SPACING: f64 = 2.2;
/// Side of the periodic box.
const SIDE: f64 = ROW as f64 * SPACING;
/// Range of the force. The box has this many cells in a row, each at least as wide.
const RANGE: f64 = 1.5;
const CELLS: usize = (SIDE / RANGE) as usize;
/// Mass and place of every atom of a triangle, and its rods: two atoms and their distance.
const ATOMS: [(f64, [f64; 2]); 3] = [(16.0, [0.0, 0.0]), (1.0, [1.0, 0.0]), (1.0, [0.0, 1.0])];
const RODS: [(usize, usize, f64); 3] =
    [(0, 1, 1.0), (0, 2, 1.0), (1, 2, core::f64::consts::SQRT_2)];

const STEPS: usize = 20;
const H: f64 = 0.02;

/// The triangles, with the energy `(1 − r²/R²)³` of any two atoms of different triangles at a distance r < R.
#[derive(Clone)]
struct Water {
    masses: Vec<f64>,
    rods: Vec<(usize, usize, f64)>,
    /// The atoms of every cell, in linked lists: the first atom of each cell, and the atom after each atom.
    cells: RefCell<[Vec<usize>; 2]>,
}

/// No atom: the end of a list.
const NONE: usize = usize::MAX;

impl Water {
    fn new() -> Self {
        let rods = (0..COUNT).flat_map(|triangle| {
            RODS.map(|(i, j, length)| (3 * triangle + i, 3 * triangle + j, length))
        });
        Self {
            masses: ATOMS.map(|(mass, _)| mass).repeat(COUNT),
            rods: rods.collect(),
            cells: RefCell::new([vec![NONE; CELLS * CELLS], vec![NONE; 3 * COUNT]]),
        }
    }

    /// Triangles that are turned and move differently, each as a rigid body.
    fn start() -> [Vec<[f64; 2]>; 2] {
        let (mut q, mut p) = (Vec::new(), Vec::new());
        for triangle in 0..COUNT {
            let number = triangle as f64;
            let (sine, cosine) = (2.4 * number).sin_cos();
            let (sideways, along) = (0.7 * number).sin_cos();
            let spin = (1.1 * number).sin();
            let center = [triangle % ROW, triangle / ROW].map(|k| k as f64 * SPACING);
            for (mass, [a, b]) in ATOMS {
                let turned = [cosine * a - sine * b, sine * a + cosine * b];
                q.push([center[0] + turned[0], center[1] + turned[1]]);
                let velocity = [
                    0.3 * along - spin * turned[1],
                    0.3 * sideways + spin * turned[0],
                ];
                p.push(velocity.map(|v| mass * v));
            }
        }
        [q, p]
    }

    /// Calls `see(i, j, d, x)` for every pair of atoms within the range, where `d` is their difference and `x = 1 − |d|²/R²`.
    fn pairs(&self, q: &[[f64; 2]], mut see: impl FnMut(usize, usize, [f64; 2], f64)) {
        let [first, next] = &mut *self.cells.borrow_mut();
        first.fill(NONE);
        for (i, q) in q.iter().enumerate() {
            let [x, y] = q.map(|x| (x / SIDE).rem_euclid(1.0));
            let [x, y] = [x, y].map(|x| ((x * CELLS as f64) as usize).min(CELLS - 1));
            next[i] = core::mem::replace(&mut first[y * CELLS + x], i);
        }
        for cell in 0..CELLS * CELLS {
            let (x, y) = (cell % CELLS, cell / CELLS);
            // Half of the cells around it: each pair of cells once.
            let right = (x + 1) % CELLS;
            let left = (x + CELLS - 1) % CELLS;
            let above = (y + 1) % CELLS * CELLS;
            let others = [y * CELLS + right, above + left, above + x, above + right];
            let mut i = first[cell];
            while i != NONE {
                let here = core::iter::once(next[i]);
                for mut j in here.chain(others.map(|other| first[other])) {
                    while j != NONE {
                        if i / 3 != j / 3 {
                            let d = [0, 1].map(|k| {
                                let d = q[i][k] - q[j][k];
                                d - SIDE * (d / SIDE).round()
                            });
                            let x = 1.0 - (d[0] * d[0] + d[1] * d[1]) / (RANGE * RANGE);
                            if x > 0.0 {
                                see(i, j, d, x);
                            }
                        }
                        j = next[j];
                    }
                }
                i = next[i];
            }
        }
    }

    fn forces(&self, q: &[[f64; 2]], force: &mut [[f64; 2]]) {
        force.fill([0.0; 2]);
        self.pairs(q, |i, j, d, x| {
            let factor = 6.0 * x * x / (RANGE * RANGE);
            for k in 0..2 {
                force[i][k] += factor * d[k];
                force[j][k] -= factor * d[k];
            }
        });
    }

    fn total_energy(&self, q: &[[f64; 2]], p: &[[f64; 2]]) -> f64 {
        let kinetic = self.masses.iter().zip(p);
        let mut energy = kinetic
            .map(|(m, p)| (p[0] * p[0] + p[1] * p[1]) / (2.0 * m))
            .sum();
        self.pairs(q, |_, _, _, x| energy += x * x * x);
        energy
    }
}

fn atoms(vector: &DVector<f64>) -> &[[f64; 2]] {
    vector.as_slice().as_chunks().0
}

impl System<DVector<f64>> for Water {
    type Class = Constrained<Separable>;
    type Solver = FixedPoint;

    fn velocity(&self, _: f64, _: &DVector<f64>, p: &DVector<f64>, velocity: &mut DVector<f64>) {
        let pairs = velocity.as_mut_slice().iter_mut().zip(p.as_slice());
        for (k, (velocity, p)) in pairs.enumerate() {
            *velocity = p / self.masses[k / 2];
        }
    }

    fn force(&self, _: f64, q: &DVector<f64>, _: &DVector<f64>, force: &mut DVector<f64>) {
        self.forces(atoms(q), force.as_mut_slice().as_chunks_mut().0);
    }

    fn energy(&self, _: f64, q: &DVector<f64>, p: &DVector<f64>) -> Option<f64> {
        Some(self.total_energy(atoms(q), atoms(p)))
    }

    fn extra(&self) -> Option<&dyn HolonomicConstraints<DVector<f64>>> {
        Some(self)
    }
}

impl HolonomicConstraints<DVector<f64>> for Water {
    fn constraints(&self) -> usize {
        self.rods.len()
    }
    fn constraint_values(&self, q: &DVector<f64>, values: &mut [f64]) {
        let q = atoms(q);
        for (value, &(i, j, length)) in values.iter_mut().zip(&self.rods) {
            let d = [0, 1].map(|k| q[i][k] - q[j][k]);
            *value = d[0] * d[0] + d[1] * d[1] - length * length;
        }
    }
    fn constraint_gradients(&self, q: &DVector<f64>, gradients: &mut Gradients<f64>) {
        let q = atoms(q);
        for (rod, &(i, j, _)) in self.rods.iter().enumerate() {
            let d = [0, 1].map(|k| 2.0 * (q[i][k] - q[j][k]));
            for (k, d) in d.into_iter().enumerate() {
                gradients.set(rod, 2 * i + k, d);
                gradients.set(rod, 2 * j + k, -d);
            }
        }
    }
}

/// SHAKE and RATTLE.
struct ByHand {
    water: Water,
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
        let masses = &self.water.masses;
        for ((q, p), m) in self.q.iter_mut().zip(&self.p).zip(masses) {
            for k in 0..2 {
                q[k] += h * p[k] / m;
            }
        }
        for molecule in self.water.rods.chunks(3) {
            for _ in 0..100 {
                let mut largest = 0.0_f64;
                for &(i, j, length) in molecule {
                    let d = [0, 1].map(|k| self.q[i][k] - self.q[j][k]);
                    let off = d[0] * d[0] + d[1] * d[1] - length * length;
                    largest = largest.max(off.abs() / (length * length));
                    let old = [0, 1].map(|k| before[i][k] - before[j][k]);
                    let inverse = 1.0 / masses[i] + 1.0 / masses[j];
                    let factor = off / (2.0 * inverse * (d[0] * old[0] + d[1] * old[1]));
                    for (k, old) in old.into_iter().enumerate() {
                        self.q[i][k] -= factor * old / masses[i];
                        self.q[j][k] += factor * old / masses[j];
                        self.p[i][k] -= factor * old / h;
                        self.p[j][k] += factor * old / h;
                    }
                }
                if largest <= Self::TOLERANCE {
                    break;
                }
            }
        }
        self.water.forces(&self.q, &mut self.force);
        self.kick(h);
        let masses = &self.water.masses;
        for molecule in self.water.rods.chunks(3) {
            for _ in 0..100 {
                let mut largest = 0.0_f64;
                for &(i, j, length) in molecule {
                    let d = [0, 1].map(|k| self.q[i][k] - self.q[j][k]);
                    let v = [0, 1].map(|k| self.p[i][k] / masses[i] - self.p[j][k] / masses[j]);
                    let rate = d[0] * v[0] + d[1] * v[1];
                    largest = largest.max(rate.abs() / length);
                    let inverse = 1.0 / masses[i] + 1.0 / masses[j];
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

/// Prints the times of both programs, and of the forces alone.
pub fn compare() -> Result<(), Error> {
    let water = Water::new();
    let [q, p] = Water::start();
    let flat = |vectors: &[[f64; 2]]| DVector::from_column_slice(vectors.as_flattened());
    let start = State::new(0.0, flat(&q), flat(&p));
    let mut force = vec![[0.0; 2]; q.len()];
    water.forces(&q, &mut force);
    let before = water.total_energy(&q, &p);
    let mut run = Integrator::new(Rattle, water.clone(), start, H)?;
    let mut by_hand = ByHand {
        water: water.clone(),
        force: force.clone(),
        q: q.clone(),
        p,
    };
    let [library, hand, forces] = medians([
        Box::new(|| {
            run.take_steps(STEPS as u64).expect("steps");
        }),
        Box::new(|| (0..STEPS).for_each(|_| by_hand.step(H))),
        Box::new(|| (0..STEPS).for_each(|_| water.forces(&q, &mut force))),
    ])
    .map(|time| time * 1e9 / (COUNT * STEPS) as f64);
    let State { time, q, p } = run.state();
    let difference = (q - flat(&by_hand.q)).amax();
    let energies = [
        water.total_energy(atoms(q), atoms(p)),
        water.total_energy(&by_hand.q, &by_hand.p),
    ];
    println!(
        "{COUNT} rigid triangles in a box, RATTLE: {library:.0} ns a triangle and step, by hand {hand:.0}: {:.2} times; \
         forces alone {forces:.0}",
        library / hand
    );
    println!(
        "  at t = {time:.1} the positions differ by {difference:.0e}; energy {before:.6} at the start, then {:.6} and by hand {:.6}",
        energies[0], energies[1]
    );
    Ok(())
}
