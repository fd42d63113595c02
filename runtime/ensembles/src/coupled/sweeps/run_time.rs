//! Coupled stages of a tableau that is known only at run time.

use alloc::vec::Vec;
use core::marker::PhantomData;

use super::{LaneSweeps, Sums, keep, largest, relax, settle::settle, transform};
use crate::coupled::stages::{LaneMemory, LaneOutcome, LaneStages, StepInLanes};
use symplectic_core::inside::rows::{CoupledRows, CoupledStep, HalfRows, Row};
use symplectic_core::inside::sweeps::{
    BasePlusSum, LaneMovement, Overrelaxed, moved, noted, shortest, sum_of_products,
};
use symplectic_core::inside::{Work, array, copy};
use symplectic_core::num_traits::Zero;
use symplectic_core::simd::Lanes;
use symplectic_core::system::Class;
use symplectic_core::{Scalar, Summation, System, Vector};

/// A step of a tableau at run time; its result is `None` if stages are not coupled.
pub(super) struct ByTableau<C, R, T>(pub(super) T, pub(super) PhantomData<(C, R)>);

impl<C, R, W, S> Work for ByTableau<C, R, StepInLanes<'_, W, S>>
where
    C: Class,
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W, Class = C>,
{
    type Output = Option<LaneOutcome<W::Scalar>>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        let StepInLanes {
            step,
            system,
            memory,
            live,
            stopping,
            outcome,
        } = self.0;
        let LaneMemory {
            before,
            now,
            settled,
            scales,
            rows,
        } = memory;
        let rows = &**rows.as_ref()?;
        let common = &CoupledStep { step, system, rows };
        let mut sweeps = ByRows::<R, W, S> {
            common,
            before,
            now,
            settled,
            sums: PhantomData,
        };
        let found = settle::<C, _, _>(&mut sweeps, step.time, live, *scales, stopping);
        common.totals::<R>(&settled.velocity, &settled.force, outcome);
        let is_sound = !now.mismatch(step.q.dimension());
        Some(LaneOutcome {
            settled: if is_sound { found.lanes } else { 0 },
            sweeps: found.sweeps,
            scales: found.scales,
            counts: rows.counts(),
        })
    }
}

/// The stages of a step.
struct ByRows<'a, R, W, S> {
    common: &'a CoupledStep<'a, W, S>,
    before: &'a LaneStages<W>,
    now: &'a mut LaneStages<W>,
    settled: &'a mut LaneStages<W>,
    sums: PhantomData<R>,
}

/// Computes `$all` with the constant `$n = $count` up to eight, so that its sums are straight-line code, or else `$any`.
macro_rules! by_count {
    ($count:expr, |$n:ident| $all:expr, $any:expr) => {
        by_count!($count, |$n| $all, $any, 1 2 3 4 5 6 7 8)
    };
    ($count:expr, |$n:ident| $all:expr, $any:expr, $($number:literal)*) => {
        match $count {
            $($number => {
                const $n: usize = $number;
                $all
            })*
            _ => $any,
        }
    };
}

/// Computes new stage values from the terms in the rows; returns the largest change of each trajectory.
#[cfg_attr(not(debug_assertions), inline(always))]
fn relax_rows<R: Summation, W: Vector<Scalar: Lanes>>(
    rows: &[Row],
    out: &mut [W],
    base: (&W, &W),
    terms: &[W],
) -> W::Scalar {
    let count = terms.len();
    // Stages that all depend on each other, as those of Gauss methods do.
    let is_full = rows.len() == count && rows.iter().all(|row| row.len() == count);
    by_count!(
        if is_full { count } else { 0 },
        |N| relax_all::<R, W, N>(rows, out, base, terms),
        relax::<R, W>(&sums::<R>(rows), out, base, terms, BasePlusSum)
    )
}

/// The sums of a half.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sums<R: Summation>(
    rows: &[Row],
) -> Sums<impl Fn(usize) -> usize, impl Fn(usize, usize) -> (usize, f64)> {
    Sums {
        count: |stage: usize| rows[stage].len(),
        term: |stage: usize, j: usize| rows[stage][j],
        with_low: R::COMPENSATED,
    }
}

/// [`relax`] where each of the `N` stages has all `N` terms. Not inlined, because there are eight of them: so it has to enter the registers
/// again.
#[inline(never)]
fn relax_all<R: Summation, W: Vector<Scalar: Lanes>, const N: usize>(
    rows: &[Row],
    out: &mut [W],
    base: (&W, &W),
    terms: &[W],
) -> W::Scalar {
    W::Scalar::in_registers(RelaxAll::<R, W, N> {
        rows,
        out,
        base,
        terms,
        sums: PhantomData,
    })
}

/// The work of [`relax_all`].
struct RelaxAll<'a, R, W, const N: usize> {
    rows: &'a [Row],
    out: &'a mut [W],
    base: (&'a W, &'a W),
    terms: &'a [W],
    sums: PhantomData<R>,
}

impl<R: Summation, W: Vector<Scalar: Lanes>, const N: usize> Work for RelaxAll<'_, R, W, N> {
    type Output = W::Scalar;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> W::Scalar {
        let Self {
            rows,
            out,
            base: (base, low),
            terms,
            ..
        } = self;
        let n = shortest(&*out).min(shortest(terms));
        let n = n.min(base.dimension()).min(low.dimension());
        let (base, low) = (&base.as_slice()[..n], &low.as_slice()[..n]);
        let factors: [[f64; N]; N] = array([0.0; N], |i| array(0.0, |j| rows[i][j].1));
        let terms: [&[W::Scalar]; N] = array(&[][..], |j| &terms[j].as_slice()[..n]);
        let mut largest = None;
        for k in 0..n {
            let terms: [W::Scalar; N] = array(W::Scalar::zero(), |j| terms[j][k]);
            for (out, factors) in out.iter_mut().zip(&factors) {
                let factors: [_; N] = array(W::Scalar::zero(), |j| W::Scalar::from_f64(factors[j]));
                let start = R::COMPENSATED.then_some(low[k]);
                let new = base[k] + sum_of_products(start, N, |j| (factors[j], terms[j]));
                let component = &mut out.as_mut_slice()[k];
                let new = moved(R::OVERRELAXED, *component, new);
                largest = Some(noted(largest, (new - *component).abs()));
                *component = new;
            }
        }
        largest.unwrap_or_else(W::Scalar::zero)
    }
}

impl<R, W, S> ByRows<'_, R, W, S>
where
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W>,
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn positions<T: Summation>(&mut self) -> W::Scalar {
        let CoupledStep { step, rows, .. } = *self.common;
        let (base, rows) = ((step.q, step.q_low), &rows.positions.rows);
        relax_rows::<T, W>(rows, &mut self.now.q, base, &self.now.velocity)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn momenta<T: Summation>(&mut self) -> W::Scalar {
        let CoupledStep { step, rows, .. } = *self.common;
        let (base, rows) = ((step.p, step.p_low), &rows.momenta.rows);
        relax_rows::<T, W>(rows, &mut self.now.p, base, &self.now.force)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep_by<T: Summation>(&mut self) -> LaneMovement<W::Scalar> {
        let LaneStages { q, p, force, .. } = &mut *self.now;
        self.common.forces(q, p, force);
        let change = self.momenta::<T>();
        let LaneStages { q, p, velocity, .. } = &mut *self.now;
        self.common.velocities(q, p, velocity);
        LaneMovement {
            q: self.positions::<T>(),
            p: change,
        }
    }
}

/// Extrapolates the increments of a half from those of the previous step.
#[cfg_attr(not(debug_assertions), inline(always))]
fn extrapolate<W: Vector<Scalar: Lanes>>(half: &HalfRows, out: &mut [W], before: &[W]) {
    by_count!(
        before.len(),
        |N| extrapolate_all::<W, N>(&half.extrapolation, out, before),
        transform(out, before, |i, j| half.extrapolation[i][j])
    );
}

/// [`transform`] of `N` vectors. Not inlined, as above.
#[inline(never)]
fn extrapolate_all<W: Vector<Scalar: Lanes>, const N: usize>(
    matrix: &[Vec<f64>],
    out: &mut [W],
    before: &[W],
) {
    W::Scalar::in_registers(ExtrapolateAll::<W, N> {
        matrix,
        out,
        before,
    });
}

/// The work of [`extrapolate_all`].
struct ExtrapolateAll<'a, W, const N: usize> {
    matrix: &'a [Vec<f64>],
    out: &'a mut [W],
    before: &'a [W],
}

impl<W: Vector<Scalar: Lanes>, const N: usize> Work for ExtrapolateAll<'_, W, N> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        let Self {
            matrix,
            out,
            before,
        } = self;
        let n = shortest(&*out).min(shortest(before));
        let before: [&[W::Scalar]; N] = array(&[][..], |j| &before[j].as_slice()[..n]);
        let matrix: [[f64; N]; N] = array([0.0; N], |i| array(0.0, |j| matrix[i][j]));
        // `k` counts entries of all `N` vectors, not the vectors.
        #[allow(clippy::needless_range_loop)]
        for k in 0..n {
            let terms: [W::Scalar; N] = array(W::Scalar::zero(), |j| before[j][k]);
            for (out, row) in out.iter_mut().zip(&matrix) {
                let product = |j: usize| (W::Scalar::from_f64(row[j]), terms[j]);
                out.as_mut_slice()[k] = sum_of_products(None, N, product);
            }
        }
    }
}

impl<R, W, S> LaneSweeps<W::Scalar> for ByRows<'_, R, W, S>
where
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W>,
{
    const STOPS_AT_ROUNDING: bool = !R::COMPENSATED;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn begin(&mut self) {
        let CoupledStep { step, rows, .. } = *self.common;
        let CoupledRows {
            positions, momenta, ..
        } = rows;
        if momenta.extrapolation.is_empty() {
            self.common.start(&mut self.now.velocity);
        } else {
            extrapolate(momenta, &mut self.now.velocity, &self.before.velocity);
        }
        self.positions::<R>();
        if positions.extrapolation.is_empty() {
            self.now.p.iter_mut().for_each(|p| copy(p, step.p));
        } else {
            extrapolate(positions, &mut self.now.force, &self.before.force);
            self.momenta::<R>();
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sweep(&mut self) -> LaneMovement<W::Scalar> {
        self.sweep_by::<R>()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn overrelaxed_sweep(&mut self) -> LaneMovement<W::Scalar> {
        self.sweep_by::<Overrelaxed<R>>()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn scales(&self) -> [W::Scalar; 2] {
        [
            largest(self.common.step.q, &self.now.q),
            largest(self.common.step.p, &self.now.p),
        ]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn keep(&mut self, lanes: u32) {
        keep(lanes, self.now, self.settled);
    }
}
