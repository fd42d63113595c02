//! Iterations with prescribed changes.

use super::*;
use crate::contract::{EvaluationCounts, General, HalfChange, Separable};
use crate::number::dither::{dither_last_sweep, dither_side};
use alloc::vec;
use alloc::vec::Vec;

/// Stages with prescribed changes, in units of EPSILON of the values.
struct Scripted<'a, const STOPS_AT_ROUNDING: bool> {
    changes: &'a [[f64; 2]],
    /// Sizes of the values in each sweep; the last entry holds for all later sweeps.
    scales: &'a [f64],
    made: usize,
    /// Number of calls of `begin`.
    begun: usize,
    /// Number of sweeps before the over-relaxed sweep.
    overrelaxed: Option<usize>,
    time: f64,
}

impl<'a, const STOPS_AT_ROUNDING: bool> Scripted<'a, STOPS_AT_ROUNDING> {
    const fn new(changes: &'a [[f64; 2]], scales: &'a [f64], time: f64) -> Self {
        Self {
            changes,
            scales,
            made: 0,
            begun: 0,
            overrelaxed: None,
            time,
        }
    }
}

impl<const STOPS_AT_ROUNDING: bool> Sweeps for Scripted<'_, STOPS_AT_ROUNDING> {
    type Movement = StageChange;

    const STOPS_AT_ROUNDING: bool = STOPS_AT_ROUNDING;

    fn evaluations(&self) -> EvaluationCounts {
        EvaluationCounts {
            begin: 0,
            start: 0,
            sweep: 1,
            finish: 0,
            carried: 0,
        }
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn begin(&mut self, _kept: WarmStart) {
        self.begun += 1;
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        None
    }

    fn non_finite_force(&self) -> Option<usize> {
        None
    }

    fn sweep(&mut self) -> StageChange {
        let scale = self.scales[self.made.min(self.scales.len() - 1)];
        let [q, p] = self.changes[self.made].map(|units| {
            let mut change = HalfChange::default();
            change.join(units * f64::EPSILON * scale, scale);
            change
        });
        self.made += 1;
        StageChange { q, p }
    }

    fn overrelaxed_sweep(&mut self) -> StageChange {
        self.overrelaxed = Some(self.made);
        self.sweep()
    }

    fn scales(&self, movement: &StageChange) -> [f64; 2] {
        movement.scales()
    }
}

/// The number of sweeps of one iteration, not repeated without a warm start, and the sizes of its stages.
fn made<C: Class, W: Sweeps>(
    sweeps: &mut W,
    kept: WarmStart,
    stopping: Stopping,
) -> Result<(u32, [f64; 2]), Failure> {
    let mut work = StepStatistics::default();
    attempt::<C, f64, _>(sweeps, kept, stopping, &mut work)?;
    assert_eq!(work.evaluations, work.iterations);
    Ok((work.iterations, work.scales))
}

/// A time with this `dither_last_sweep` at which `dither_side` is false.
fn time(side: bool) -> f64 {
    let mut time = 1.0;
    while dither_last_sweep(time) != side || dither_side(time) {
        time += 1.0;
    }
    time
}

/// The number of sweeps of an iteration with these changes, at a time with this `dither_last_sweep`.
fn sweeps<C: Class, const STOPS_AT_ROUNDING: bool>(
    changes: &[[f64; 2]],
    scales: &[f64],
    dither_last_sweep: bool,
) -> Result<u32, Failure> {
    let mut script = Scripted::<STOPS_AT_ROUNDING>::new(changes, scales, time(dither_last_sweep));
    let settled = made::<C, _>(&mut script, WarmStart::default(), at_most(changes.len()));
    settled.map(|(iterations, _)| iterations)
}

/// The number of sweeps of an iteration that stops at rounding, and the sizes of the stages that it returns. All values are one;
/// in the previous step they had the sizes `before`.
fn after<C: Class>(before: [f64; 2], changes: &[[f64; 2]]) -> Result<(u32, [f64; 2]), Failure> {
    let mut script = Scripted::<true>::new(changes, &[1.0], 1.0);
    made::<C, _>(&mut script, stages(before), at_most(changes.len()))
}

/// At most `sweeps` sweeps, to rounding.
fn at_most(sweeps: usize) -> Stopping {
    Stopping {
        max_iterations: sweeps as u32,
        ..Stopping::DEFAULT
    }
}

/// A warm start from stages of these sizes.
fn stages(scales: [f64; 2]) -> WarmStart {
    WarmStart {
        scales,
        ..WarmStart::new(false, true)
    }
}

/// The same changes in both halves.
fn alike<const N: usize>(changes: [f64; N]) -> [[f64; 2]; N] {
    changes.map(|units| [units, units])
}

#[test]
fn a_stagnating_iteration_has_one_sweep_more_at_half_of_the_times() {
    let changes = alike([1e12, 1e6, 10.0, 1.0, 1.0, 1.0, 1.0]);
    assert_eq!(sweeps::<Separable, false>(&changes, &[1.0], false), Ok(5));
    assert_eq!(sweeps::<Separable, false>(&changes, &[1.0], true), Ok(6));
    // Not at the bound.
    let bounded = sweeps::<Separable, false>(&changes[..5], &[1.0], true);
    assert_eq!(bounded, Ok(5));
    // Stages that stand still get no further sweep: nothing would change.
    let changes = alike([1e12, 1e6, 10.0, 0.0, 0.0, 0.0]);
    assert_eq!(sweeps::<Separable, false>(&changes, &[1.0], true), Ok(4));
}

#[test]
fn a_warm_stagnating_iteration_has_one_sweep_more_at_half_of_the_times() {
    let changes = alike([1e12, 1e6, 10.0, 4.0, 5.0, 3.0, 3.0]);
    let after = |dither_last_sweep: bool, bound: usize| {
        let mut script = Scripted::<false>::new(&changes, &[1.0], time(dither_last_sweep));
        made::<Separable, _>(&mut script, stages([1.0; 2]), at_most(bound)).map(|x| x.0)
    };
    // The bound may follow immediately.
    for bound in [6, 7] {
        assert_eq!(after(false, bound), Ok(5));
        assert_eq!(after(true, bound), Ok(6));
    }
    assert_eq!(after(true, 5), Ok(5));
    assert!(after(true, 4).is_err());
}

#[test]
fn the_extra_sweep_does_not_depend_on_the_number_of_sweeps() {
    let near = [60.0, 50.0, 40.0, 30.0, 20.0, 10.0, 5.0, 6.0, 6.0, 6.0];
    for far in 1..=20 {
        // Each ends when a change at the level of rounding has grown; with more than sixteen sweeps, when two have.
        let first = (0..far).map(|sweep| 1e12 / 3_f64.powi(sweep));
        let changes: Vec<_> = first.chain(near).map(|change| [change; 2]).collect();
        let made = |kept: WarmStart, dither_last_sweep: bool| {
            let mut script = Scripted::<false>::new(&changes, &[1.0], time(dither_last_sweep));
            made::<Separable, _>(&mut script, kept, at_most(100)).map(|x| x.0)
        };
        for kept in [stages([1.0; 2]), WarmStart::default()] {
            let sweeps = made(kept, false).expect("it stagnates");
            let waits = if sweeps > 16 { 2 } else { 1 };
            assert_eq!(sweeps, far as u32 + 7 + waits, "{far}");
            assert_eq!(made(kept, true), Ok(sweeps + 1), "{far}");
        }
    }
}

#[test]
fn an_iteration_begins_once_for_any_bound() {
    fn check<const STOPS_AT_ROUNDING: bool>(bound: usize) {
        let changes = alike([1e3, 100.0, 60.0, 60.0, 60.0, 60.0]);
        let mut script = Scripted::<STOPS_AT_ROUNDING>::new(&changes, &[1.0], time(false));
        let settled = made::<General, _>(&mut script, stages([1.0; 2]), at_most(bound));
        assert_eq!(script.begun, 1);
        assert_eq!(script.made, bound.min(4));
        assert_eq!(settled.is_ok(), bound >= 4, "{settled:?}");
    }
    for bound in 1..=6 {
        check::<false>(bound);
        check::<true>(bound);
    }
    // A bound of zero counts as a bound of one.
    let changes = alike([1e3; 2]);
    let mut script = Scripted::<false>::new(&changes, &[1.0], time(false));
    assert!(made::<General, _>(&mut script, stages([1.0; 2]), at_most(0)).is_err());
    assert_eq!(script.made, 1);
    // A failed iteration is repeated without the warm start, and its sweeps are counted.
    let changes = alike([1e3, 1.0]);
    let mut script = Scripted::<true>::new(&changes, &[1.0], 1.0);
    let work = settle::<General, f64, _>(&mut script, stages([1.0; 2]), at_most(1));
    let work = work.expect("a change of one unit");
    assert_eq!((work.iterations, work.evaluations), (2, 2));
    assert_eq!((script.begun, script.made), (2, 2));
}

#[test]
fn nan_changes_do_not_end_a_warm_iteration() {
    for [q, p] in [[f64::NAN, f64::NAN], [f64::NAN, 1.0], [1.0, f64::NAN]] {
        let mut changes = alike([1e12, 1e6, 10.0]).to_vec();
        changes.extend([[q, p]; 20]);
        let mut script = Scripted::<false>::new(&changes, &[1.0], 1.0);
        let settled = made::<Separable, _>(&mut script, stages([1.0; 2]), at_most(changes.len()));
        assert!(settled.is_err(), "{q} {p}: {settled:?}");
    }
}

#[test]
fn the_dither_is_unbiased_and_uncorrelated_for_any_step_size() {
    for size in [0.125, 0.1, 488.0, 1e-7, 1.0 / 3.0, -0.39] {
        for start in [0.0, 1e3, 2.5e6] {
            let dither_last_sweep = |step: u32| dither_last_sweep(start + f64::from(step) * size);
            let heads = (0..10_000).filter(|&step| dither_last_sweep(step)).count();
            let pairs =
                (0..10_000).filter(|&step| dither_last_sweep(step) == dither_last_sweep(step + 1));
            let pairs = pairs.count();
            // Four standard deviations of as many independent bits.
            assert!(heads.abs_diff(5_000) <= 200, "{size} {start}: {heads}");
            assert!(pairs.abs_diff(5_000) <= 200, "{size} {start}: {pairs}");
        }
    }
}

#[test]
fn changes_far_above_rounding_are_not_taken_for_noise_in_early_sweeps() {
    // At the third sweep the change would count as noise: 2^-10 of the first, not shrinking, but above rounding errors.
    let far = 5e3;
    let changes = alike([1e12, far, far, far, far, far, far, far, far, 1.0, 1.0]);
    assert_eq!(sweeps::<Separable, false>(&changes, &[1.0], false), Ok(11));
    // An earlier bound is still respected.
    let shown = sweeps::<Separable, false>(&changes[..5], &[1.0], false);
    let Err(Failure::NoConvergence {
        residual,
        iterations: 5,
    }) = shown
    else {
        panic!("{shown:?}");
    };
    assert_eq!(residual, far * f64::EPSILON);
}

#[test]
fn a_slow_iteration_that_grows_for_a_sweep_goes_on() {
    // The change shrinks by a factor 0.8 per sweep, but every other change is half of that. From the 44th sweep on it is at most
    // 64 units, and it grows at the 45th.
    let mut changes: Vec<[f64; 2]> = (0..64)
        .map(|sweep| 1e6 * 0.8_f64.powi(sweep) / f64::from(1 + sweep % 2))
        .map(|units| [units, units])
        .collect();
    changes.extend([[1.0, 1.0]; 10]);
    assert_eq!(sweeps::<Separable, false>(&changes, &[1.0], false), Ok(69));
    // If the bound comes first, one growing change suffices.
    let bounded = |bound| sweeps::<Separable, false>(&changes[..bound], &[1.0], false);
    assert_eq!(bounded(45), Ok(45));
    assert!(bounded(46).is_err(), "{:?}", bounded(46));
}

#[test]
fn noise_may_be_amplified_after_it_was_rounding() {
    let dip = [1e12, 1e9, 1e6, 1e3, 50.0];
    let changes = |after: f64| {
        let mut changes = alike(dip).to_vec();
        changes.extend([[after, after]; 30]);
        sweeps::<Separable, false>(&changes, &[1.0], false)
    };
    assert_eq!(changes(60.0), Ok(6));
    // Ten sweeps without progress.
    assert_eq!(changes(200.0), Ok(15));
    let Err(Failure::Stagnation { iterations: 35, .. }) = changes(300.0) else {
        panic!("{:?}", changes(300.0));
    };
}

#[test]
fn noise_is_recognised_after_sweeps_that_were_not_measured() {
    let mut changes = alike([1e12, 1e9, 1e6, 1e3, 50.0]).to_vec();
    changes.extend([[200.0; 2]; 30]);
    let settled = |kept: WarmStart| {
        let mut script = Scripted::<false>::new(&changes, &[1.0], 1.0);
        made::<Separable, _>(&mut script, kept, at_most(changes.len()))
    };
    assert_eq!(settled(WarmStart::default()), Ok((15, [1.0; 2])));
    assert_eq!(settled(stages([1.0; 2])), Ok((15, [1.0; 2])));
    // If one half never settles, the other does not end the iteration.
    let changes = [[0.5, 1e12]; 40];
    for kept in [WarmStart::default(), stages([1.0; 2])] {
        let mut script = Scripted::<false>::new(&changes, &[1.0], 1.0);
        let settled = made::<General, _>(&mut script, kept, at_most(40));
        assert!(settled.is_err(), "{settled:?}");
    }
    let settled = after::<General>([1.0; 2], &changes);
    assert!(settled.is_err(), "{settled:?}");
}

/// The sweeps of an iteration that stops at rounding, with values of size one, to a tolerance in units of EPSILON.
fn tolerant<C: Class>(
    units: f64,
    kept: WarmStart,
    changes: &[[f64; 2]],
) -> Result<(u32, [f64; 2]), Failure> {
    let mut script = Scripted::<true>::new(changes, &[1.0], 1.0);
    let stopping = Stopping {
        max_iterations: changes.len() as u32,
        tolerance: units * f64::EPSILON,
    };
    made::<C, _>(&mut script, kept, stopping)
}

#[test]
fn a_tolerance_ends_an_iteration_at_the_first_change_within_it() {
    let changes = alike([1e12, 1e9, 1e6, 1e3, 1.0, 0.5]);
    for kept in [
        WarmStart::default(),
        stages([0.0; 2]),
        stages([1.0; 2]),
        stages([1e-3; 2]),
    ] {
        for (units, sweeps) in [(1e12, 1), (1e9, 2), (2e6, 3), (1e5, 4), (2.0, 5)] {
            let made = tolerant::<General>(units, kept, &changes);
            assert_eq!(made.map(|(made, _)| made), Ok(sweeps), "{units} {kept:?}");
        }
    }
    // Also in the last allowed sweep.
    for bound in 1..=5 {
        let kept = stages([1.0; 2]);
        let made = tolerant::<General>(2.0, kept, &changes[..bound]);
        assert_eq!(made.is_ok(), bound == 5, "{bound}");
    }
    // Momenta are tested in general systems only.
    let changes = [[1e12, 1e12], [1.0, 1e6], [1.0, 1.0]];
    for (kept, general) in [(WarmStart::default(), 3), (stages([1.0; 2]), 3)] {
        assert_eq!(
            tolerant::<General>(9.0, kept, &changes).map(|x| x.0),
            Ok(general)
        );
        assert_eq!(
            tolerant::<Separable>(9.0, kept, &changes).map(|x| x.0),
            Ok(2)
        );
    }
}

#[test]
fn a_tolerance_is_not_waited_for_where_the_next_change_would_be_a_unit() {
    let kept = stages([1.0; 2]);
    let changes = alike([1e12, 1e9, 1e6, 30.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0]);
    assert_eq!(tolerant::<General>(1.0, kept, &changes), Ok((4, [1.0; 2])));
    assert_eq!(tolerant::<General>(7.9, kept, &changes), Ok((4, [1.0; 2])));
    let changes = alike([1e12, 1e9, 100.0, 60.0, 30.0, 20.0, 20.0]);
    assert_eq!(tolerant::<General>(25.0, kept, &changes), Ok((6, [1.0; 2])));
    let changes = alike([1e12, 1e9, 1e6, 30.0, 2.0, 0.7, 0.7, 0.7, 0.7, 0.7, 0.7, 0.7]);
    assert_eq!(tolerant::<General>(1e-3, kept, &changes), Ok((4, [1.0; 2])));
    // Larger values in the previous step do not make the bound too wide, and the new sizes are returned.
    let kept = stages([1e9; 2]);
    let made = tolerant::<General>(1.0, kept, &changes);
    assert_eq!(made, Ok((4, [1.0; 2])));
}

#[test]
fn nan_changes_are_not_within_a_tolerance() {
    let mut changes = alike([1e12, 1e9]).to_vec();
    changes.extend([[f64::NAN; 2]; 20]);
    for kept in [WarmStart::default(), stages([1.0; 2])] {
        let made = tolerant::<General>(1e3, kept, &changes);
        assert!(
            matches!(made, Err(Failure::NoConvergence { .. })),
            "{made:?}"
        );
    }
}

#[test]
fn a_diverging_iteration_reports_its_last_finite_change() {
    let residual = |changes: &[[f64; 2]]| match sweeps::<Separable, false>(changes, &[1.0], false) {
        Err(Failure::NoConvergence { residual, .. }) => residual,
        other => panic!("{other:?}"),
    };
    let near = alike([1e12, 1e3, f64::NAN, 0.0]);
    assert_eq!(residual(&near), 1e3 * f64::EPSILON);
    let far = alike([1e12, 1e14, 1e18, f64::NAN, 0.0]);
    assert_eq!(residual(&far), 1e18 * f64::EPSILON);
}

#[test]
fn a_hasty_iteration_ends_where_the_next_change_would_be_a_unit() {
    // 30²/1000 is below one, 50²/1000 is not.
    let near = alike([1e12, 1e9, 1000.0, 30.0, 1.0, 1.0]);
    assert_eq!(sweeps::<Separable, true>(&near, &[1.0], true), Ok(4));
    let far = alike([1e12, 1e9, 1000.0, 50.0, 1.0, 1.0]);
    assert_eq!(sweeps::<Separable, true>(&far, &[1.0], true), Ok(5));
}

#[test]
fn a_hasty_iteration_after_another_ends_at_the_same_sweep() {
    let near = alike([1e12, 1e9, 1000.0, 30.0, 1.0, 1.0]);
    let far = alike([1e12, 1e9, 1000.0, 50.0, 1.0, 1.0]);
    let still = alike([1e12, 1e9, 1000.0, 0.0, 0.0]);
    let at_once = alike([0.5, 0.5]);
    for (changes, sweeps) in [(&near[..], 4), (&far, 5), (&still, 4), (&at_once, 1)] {
        for before in [1.0, 0.6, 1.9, 2.0, 1e6] {
            let now = after::<General>([before; 2], changes);
            let Ok((made, [size, _])) = now else {
                panic!("{now:?}");
            };
            assert_eq!(made, sweeps, "{before}");
            // A size is measured again unless it is known up to a factor of two.
            assert!(0.5 * size < 1.0 && 1.0 <= 2.0 * size, "{before}: {size}");
        }
    }
    // The size of momenta that are not tested need not be known.
    assert_eq!(after::<Separable>([1.0, 0.0], &near), Ok((4, [1.0; 2])));
    assert_eq!(after::<General>([1.0, 0.0], &near), Ok((4, [1.0; 2])));
}

/// Changes that shrink from a large value to noise, each sequence by its own factor.
fn shrinking(seed: u64) -> Vec<[f64; 2]> {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
        (state >> 33) as f64 / 2.0_f64.powi(31)
    };
    let (factor, noise) = (0.9 * random(), 100.0 * random() * random());
    let mut size = 1e5;
    let mut changes = vec![];
    for _ in 0..400 {
        let shrunk = |random: f64| size * (0.5 + random) + (noise * random).floor();
        changes.push([shrunk(random()), shrunk(random())]);
        size *= factor;
    }
    changes
}

/// How many of a thousand iterations end at a different sweep after a warm start with values of size `before`; the values are one.
fn others<C: Class, const STOPS_AT_ROUNDING: bool>(before: f64) -> usize {
    let scripted = |seed: u64, changes: &[[f64; 2]], kept: WarmStart| {
        let mut script =
            Scripted::<STOPS_AT_ROUNDING>::new(changes, &[1.0], time(seed.is_multiple_of(2)));
        let made = made::<C, _>(&mut script, kept, at_most(changes.len())).map(|x| x.0);
        assert_eq!(script.begun, 1);
        made
    };
    let differs = |seed: u64| {
        let changes = shrinking(seed);
        let [after, alone] =
            [stages([before; 2]), WarmStart::default()].map(|kept| scripted(seed, &changes, kept));
        after != alone
    };
    (0..1000).filter(|&seed| differs(seed)).count()
}

#[test]
fn an_iteration_after_another_ends_at_the_same_sweep() {
    // The previous sizes are those of the values up to a factor of two, or so much larger that every change is examined.
    for before in [1.0, 0.51, 0.6, 1.9, 30.0, 1e15] {
        let others = [
            others::<General, false>(before),
            others::<Separable, false>(before),
            others::<General, true>(before),
            others::<Separable, true>(before),
        ];
        assert_eq!(others, [0; 4], "{before}");
    }
}

#[test]
fn a_hasty_iteration_of_growing_values_checks_at_the_tenth_sweep() {
    let changes = alike([
        1e12, 1e9, 1e6, 30.0, 30.0, 30.0, 30.0, 30.0, 30.0, 30.0, 30.0, 30.0,
    ]);
    // No change is at the level of rounding errors of the previous step's values.
    assert_eq!(after::<General>([0.1; 2], &changes), Ok((11, [1.0; 2])));
    assert_eq!(after::<General>([1.0; 2], &changes), Ok((4, [1.0; 2])));
}

#[test]
fn a_hasty_iteration_after_another_that_runs_away_is_an_error() {
    let changes = alike([1e12, f64::NAN]);
    let Err(Failure::NoConvergence { iterations: 2, .. }) = after::<General>([1.0; 2], &changes)
    else {
        panic!("{:?}", after::<General>([1.0; 2], &changes));
    };
    let Err(Failure::NonFinite { .. }) = after::<General>([1.0; 2], &changes[1..]) else {
        panic!("{:?}", after::<General>([1.0; 2], &changes[1..]));
    };
}

#[test]
fn a_hasty_iteration_of_numbers_of_any_size_ends_at_the_same_sweep() {
    for scale in [1.0, 1e-120, 1e-130, 1e-150, 1e-280, 1e150, 1e200] {
        for (last, sweeps) in [(30.0, 4), (32.0, 5)] {
            let changes = alike([1e12, 1e9, 1000.0, last, 0.0]);
            let scales = [scale];
            let mut script = Scripted::<true>::new(&changes, &scales, 1.0);
            let scales = [scale; 2];
            let settled = made::<General, _>(&mut script, stages(scales), at_most(5));
            assert_eq!(settled, Ok((sweeps, scales)), "{scale} {last}");
        }
    }
}

#[test]
fn a_hasty_iteration_waits_for_the_slower_half() {
    let changes = [
        [1e12, 1e12],
        [1e3, 1e10],
        [1.0, 1e8],
        [0.5, 1e3],
        [0.5, 10.0],
        [0.5, 0.5],
    ];
    assert_eq!(sweeps::<General, true>(&changes, &[1.0], true), Ok(5));
    // The momenta of a separable system are a function of the positions.
    assert_eq!(sweeps::<Separable, true>(&changes, &[1.0], true), Ok(3));
}

#[test]
fn both_halves_must_be_near_for_a_hasty_end() {
    let changes = [
        [1e12, 1e12],
        [100.0, 1e6],
        [50.0, 10.0],
        [25.0, 1.0],
        [12.0, 0.5],
        [6.0, 0.5],
        [3.0, 0.5],
        [1.5, 0.5],
        [0.5, 0.5],
    ];
    // 6²/12 and 3²/6 are above one, 1.5²/3 is not.
    assert_eq!(sweeps::<General, true>(&changes, &[1.0], true), Ok(8));
}

#[test]
fn values_that_shrink_narrow_the_rounding_bound() {
    // The values shrink from 10⁶ to 1 together with the changes: 50 units of 10⁶ are many units of 1.
    let scales = [1e6, 1.0];
    let changes = alike([1e12, 5e7, 1e4, 1.0, 0.5]);
    assert_eq!(sweeps::<Separable, true>(&changes, &scales, true), Ok(4));
}

/// Over-relaxation is used only for general systems, with sums that wait for stagnation, after a warm start, and if the bound
/// allows enough sweeps.
#[test]
fn half_of_the_steps_come_from_the_other_side() {
    fn overrelaxed<C: Class, const STOPS_AT_ROUNDING: bool>(
        time: f64,
        kept: WarmStart,
        sweeps: usize,
    ) -> Option<usize> {
        let changes: Vec<_> = [1e6, 1e3, 1e6, 1.0, 0.0].map(|x| [x; 2]).to_vec();
        let mut script = Scripted::<STOPS_AT_ROUNDING>::new(&changes, &[1.0], time);
        let (made, _) = made::<C, _>(&mut script, kept, at_most(sweeps)).expect("settled");
        // The over-relaxed sweep is counted.
        assert_eq!(made as usize, script.made);
        script.overrelaxed
    }
    let kept = || stages([1.0; 2]);
    let [mut heads, steps] = [0, 1000];
    for step in 0..steps {
        let time = 0.1 * f64::from(step);
        let expected = dither_side(time).then_some(1);
        heads += u32::from(dither_side(time));
        assert_eq!(overrelaxed::<General, false>(time, kept(), 100), expected);
        assert_eq!(overrelaxed::<Separable, false>(time, kept(), 100), None);
        assert_eq!(overrelaxed::<General, true>(time, kept(), 100), None);
        assert_eq!(
            overrelaxed::<General, false>(time, WarmStart::default(), 100),
            None
        );
        assert_eq!(overrelaxed::<General, false>(time, kept(), 5), None);
    }
    assert!((450..550).contains(&heads), "{heads}");
}
