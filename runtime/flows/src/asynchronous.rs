//! Asynchronous variational integrators: every potential has its own step size.

use alloc::collections::BinaryHeap;
use alloc::collections::binary_heap::PeekMut;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Ordering;

use super::{Flow, FlowError, Span, check_count, check_dimension, check_parameter};
use crate::Error;
use symplectic_core::{Quantity, Vector};

/// A system `H = Σ p_i²/(2m_i) + Σ_K V_K(t, q)` for [`Asynchronous`]. Each element K depends on a few components of the position: bonds,
/// springs, the cells of a mesh.
pub trait Elements {
    /// The number of elements.
    fn count(&self) -> usize;

    /// The components of the position on which `V_K` depends, each once. They must not change.
    fn components(&self, element: usize) -> &[usize];

    /// Writes the force `−∂V_K/∂q` on each [component](Self::components) of an element, in their order; `q` holds their positions.
    fn force(&self, element: usize, time: f64, q: &[f64], force: &mut [f64]);

    /// The longest step `h_K` of an element: well below the shortest period of its own oscillations.
    fn step_size(&self, element: usize) -> f64;

    /// `1/m_i` of a component of the position.
    fn inverse_mass(&self, _component: usize) -> f64 {
        1.0
    }
}

/// The step of an asynchronous variational integrator (Lew, Marsden, Ortiz & West 2003): each element kicks with its own step size.
///
/// In a step of size h, element K takes `n_K = ⌈h/h_K⌉` equal steps, where `h_K` is its [step size](Elements::step_size). At the times
/// `k h/n_K` the components of the element drift from their last positions. They then get the kick
///
/// ```text
/// p ← p − (h/n_K) ∂V_K/∂q,   half of it for k = 0 and k = n_K.
/// ```
///
/// $$ p \leftarrow p - \frac{h}{n_K} \frac{\partial V_K}{\partial q} $$
///
/// So the force of a stiff bond is evaluated often, and that of a soft bond rarely. The numbers `n_K` need no common divisor. The step is
/// symplectic, symmetric and of order 2. It conserves the total momentum up to rounding if the forces of each element add up to zero. Use
/// it as the whole system, in a [`FlowIntegrator`](super::FlowIntegrator), or as a part beside other flows. Within
/// [`Substeps`](super::Substeps) the half kicks at the end of one step and the start of the next share one evaluation.
///
/// As in every method with several step sizes, kicks of fast elements can resonate with the oscillations of slow ones. Keep h below half
/// of the shortest period of the elements with `n_K = 1`, or compare the energy for several step sizes. Sums are not compensated.
///
/// ```
/// use symplectic::State;
/// use symplectic::flow::{Asynchronous, Elements, FlowSteps};
/// use symplectic::nalgebra::SVector;
///
/// /// Bonds of a chain: every other one is stiff.
/// struct Bonds([[usize; 2]; 3]);
///
/// impl Bonds {
///     fn stiffness(bond: usize) -> f64 {
///         if bond % 2 == 0 { 100.0 } else { 1.0 }
///     }
/// }
///
/// impl Elements for Bonds {
///     fn count(&self) -> usize {
///         self.0.len()
///     }
///     fn components(&self, bond: usize) -> &[usize] {
///         &self.0[bond]
///     }
///     fn force(&self, bond: usize, _time: f64, q: &[f64], force: &mut [f64]) {
///         let tension = Self::stiffness(bond) * (q[1] - q[0]);
///         force.copy_from_slice(&[tension, -tension]);
///     }
///     fn step_size(&self, bond: usize) -> f64 {
///         0.1 / Self::stiffness(bond).sqrt()
///     }
/// }
///
/// # fn main() -> Result<(), symplectic::flow::Error> {
/// let step = Asynchronous::new(Bonds([[0, 1], [1, 2], [2, 3]]), 4)?;
/// let start = State::new(0.0, SVector::from([0.0, 0.1, 0.0, 0.0]), SVector::from([0.0, 0.0, 0.0, 0.5]));
/// let mut run = FlowSteps::run(step, start, 0.1)?;
/// run.integrate_to(100.0)?;
/// assert!((run.state().p.sum() - 0.5).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Asynchronous<E> {
    elements: E,
    drifts: Drifts,
    /// The index in `forces` where the forces of each element begin; the last entry is the length of `forces`.
    begins: Vec<usize>,
    /// The forces of all elements at their last kicks.
    forces: Vec<f64>,
    /// Work space for the positions of one element.
    positions: Vec<f64>,
    /// The next kick of each element, in the present step.
    queue: BinaryHeap<Kick>,
}

/// The drifts of the components of the position within a step.
#[derive(Clone, Debug)]
struct Drifts {
    inverse_masses: Vec<f64>,
    /// The fraction of the step up to which each component has drifted.
    reached: Vec<f64>,
}

impl Drifts {
    /// Drifts a component up to the fraction `part` of a step of this size.
    fn take(&mut self, component: usize, part: f64, size: f64, q: &mut [f64], p: &[f64]) {
        let way = part - self.reached[component];
        q[component] += size * way * self.inverse_masses[component] * p[component];
        self.reached[component] = part;
    }
}

/// The `number`-th kick of an element in a step; `number` runs from 0 to `count`, the steps of the element.
#[derive(Clone, Copy, Debug)]
struct Kick {
    element: usize,
    number: u32,
    count: u32,
}

impl Kick {
    /// The time of the kick, as a fraction of the step.
    fn part(self) -> f64 {
        f64::from(self.number) / f64::from(self.count)
    }
}

/// [`BinaryHeap`] returns the greatest kick: the earliest one, and at equal times that of the element with the smallest index.
impl Ord for Kick {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_time = other.part().total_cmp(&self.part());
        by_time.then(other.element.cmp(&self.element))
    }
}

impl PartialOrd for Kick {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Kick {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Kick {}

impl<E: Elements> Asynchronous<E> {
    /// The step for these elements; positions have `dimension` components.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] if the step size of an element is not finite and positive, or an inverse mass is negative or not finite.
    /// Also if a component does not exist, or an element lists it twice.
    pub fn new(elements: E, dimension: usize) -> Result<Self, Error> {
        let (mut begins, mut longest) = (vec![0], 0);
        let mut seen_by = vec![None; dimension];
        for element in 0..elements.count() {
            check_parameter(
                "step size of an element",
                element,
                elements.step_size(element),
                false,
            )?;
            let components = elements.components(element);
            for &component in components {
                let what = "component of an element";
                let range = "below the number of components of the position";
                check_count(what, component, component < dimension, range)?;
                let first = seen_by[component].replace(element) != Some(element);
                check_count(what, component, first, "there once")?;
            }
            longest = longest.max(components.len());
            begins.push(begins[element] + components.len());
        }
        let inverse_masses: Vec<f64> = (0..dimension).map(|i| elements.inverse_mass(i)).collect();
        for (component, &inverse_mass) in inverse_masses.iter().enumerate() {
            check_parameter("inverse mass", component, inverse_mass, true)?;
        }
        Ok(Self {
            forces: vec![0.0; begins[elements.count()]],
            positions: vec![0.0; longest],
            drifts: Drifts {
                inverse_masses,
                reached: vec![0.0; dimension],
            },
            queue: BinaryHeap::with_capacity(elements.count()),
            begins,
            elements,
        })
    }

    /// The elements.
    pub const fn elements(&self) -> &E {
        &self.elements
    }

    /// Takes one step. If it follows another step, the forces at its start are already known.
    fn step(
        &mut self,
        span: Span,
        forces_known: bool,
        q: &mut [f64],
        p: &mut [f64],
    ) -> Result<(), FlowError> {
        self.queue.clear();
        self.drifts.reached.fill(0.0);
        for element in 0..self.elements.count() {
            let count = steps(span.size, self.elements.step_size(element))?;
            let kick = Kick {
                element,
                number: 0,
                count,
            };
            if !forces_known {
                self.evaluate(kick, span, q)?;
            }
            self.kick(kick, span, p);
            self.queue.push(Kick { number: 1, ..kick });
        }
        while let Some(&kick) = self.queue.peek() {
            for &component in self.elements.components(kick.element) {
                self.drifts.take(component, kick.part(), span.size, q, p);
            }
            self.evaluate(kick, span, q)?;
            self.kick(kick, span, p);
            if let Some(mut next) = self.queue.peek_mut() {
                if kick.number == kick.count {
                    PeekMut::pop(next);
                } else {
                    next.number += 1;
                }
            }
        }
        (0..q.len()).for_each(|component| self.drifts.take(component, 1.0, span.size, q, p));
        Ok(())
    }

    /// Evaluates the forces of an element for a kick.
    fn evaluate(&mut self, kick: Kick, span: Span, q: &[f64]) -> Result<(), FlowError> {
        let components = self.elements.components(kick.element);
        let positions = &mut self.positions[..components.len()];
        for (position, &component) in positions.iter_mut().zip(components) {
            *position = q[component];
        }
        let forces = &mut self.forces[self.begins[kick.element]..self.begins[kick.element + 1]];
        let time = span.time + span.size * kick.part();
        self.elements.force(kick.element, time, positions, forces);
        match forces.iter().all(|force| force.is_finite()) {
            true => Ok(()),
            false => Err(FlowError::NonFinite {
                what: Quantity::Force,
            }),
        }
    }

    /// Kicks an element with its last evaluated forces.
    fn kick(&self, kick: Kick, span: Span, p: &mut [f64]) {
        let Kick {
            element,
            number,
            count,
        } = kick;
        let at_an_end = number == 0 || number == count;
        let weight = span.size / f64::from(count) * if at_an_end { 0.5 } else { 1.0 };
        let components = self.elements.components(element);
        for (&component, force) in components.iter().zip(&self.forces[self.begins[element]..]) {
            p[component] += weight * force;
        }
    }
}

/// The smallest number of equal steps that are no longer than `longest`. A quotient that exceeds an integer by rounding counts as that integer.
fn steps(size: f64, longest: f64) -> Result<u32, FlowError> {
    let ratio = size.abs() / longest * (1.0 - 4.0 * f64::EPSILON);
    if ratio < f64::from(u32::MAX) {
        return Ok(libm::ceil(ratio).max(1.0) as u32);
    }
    Err(FlowError::Other {
        reason: "an element has more than 2^32 steps in one step; take shorter steps, or longer ones of the elements",
    })
}

impl<V: Vector<Scalar = f64>, E: Elements> Flow<V> for Asynchronous<E> {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        self.flow_through(core::iter::once(span), q, p)
    }

    fn flow_through(
        &mut self,
        spans: impl Iterator<Item = Span>,
        q: &mut V,
        p: &mut V,
    ) -> Result<(), FlowError> {
        let dimension = self.drifts.reached.len();
        check_dimension(dimension, q)?;
        check_dimension(dimension, p)?;
        let (q, p) = (q.as_mut_slice(), p.as_mut_slice());
        for (number, span) in spans.enumerate() {
            self.step(span, number > 0, q, p)?;
        }
        Ok(())
    }
}
