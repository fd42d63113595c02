//! The progress of a run, shown once it takes more than two seconds.

use std::io::{IsTerminal, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use symplectic_tape::Watch;

/// A shorter run shows nothing.
const SILENT: Duration = Duration::from_secs(2);
/// The time between two pictures of the bar.
const FRAME: Duration = Duration::from_millis(200);
/// The time between two lines where there is no terminal.
const LINE: Duration = Duration::from_secs(10);
/// The length of the bar.
const PARTS: f64 = 1000.0;

/// What the trajectories of a run have done, by the times at which their forces are evaluated. So every kind of run shows its
/// progress, also within trajectories, and computes the same.
#[derive(Debug)]
pub(super) struct Meter {
    start: f64,
    /// The duration of a trajectory, positive.
    duration: f64,
    /// The steps of a trajectory.
    steps: f64,
    trajectories: AtomicUsize,
    /// Trajectories of an interrupted run.
    before: AtomicUsize,
    finished: AtomicUsize,
    /// One for each thread.
    slots: Vec<Slot>,
}

/// The bits of two numbers that one thread writes.
#[derive(Debug, Default)]
#[repr(align(64))]
struct Slot {
    /// The furthest time of the present trajectories since their start.
    elapsed: AtomicU64,
    /// The sum of the times of all trajectories.
    total: AtomicU64,
}

impl Meter {
    pub(super) fn new([start, end]: [f64; 2], step_size: f64) -> Self {
        let duration = (end - start).abs();
        let slots = (0..rayon::current_num_threads()).map(|_| Slot::default());
        Meter {
            start,
            duration,
            steps: duration / step_size.abs(),
            trajectories: AtomicUsize::new(0),
            before: AtomicUsize::new(0),
            finished: AtomicUsize::new(0),
            slots: slots.collect(),
        }
    }

    /// Sets the number of trajectories, and how many of these are finished.
    fn begin(&self, trajectories: usize, before: usize) {
        self.trajectories.store(trajectories, Ordering::Relaxed);
        self.before.store(before, Ordering::Relaxed);
        self.finished.store(before, Ordering::Relaxed);
    }

    /// The done part of the run, from 0 to 1, with trajectories of an interrupted run, and without these.
    fn fractions(&self) -> [f64; 2] {
        let all = self.trajectories.load(Ordering::Relaxed).max(1) as f64;
        let slots = self.slots.iter();
        let times = slots.map(|slot| f64::from_bits(slot.total.load(Ordering::Relaxed)));
        let before = self.before.load(Ordering::Relaxed) as f64;
        // A failed trajectory is finished before its end.
        let finished = self.finished.load(Ordering::Relaxed) as f64 - before;
        let own = (times.sum::<f64>() / self.duration).max(finished);
        let own = own.min(all - before);
        [(before + own) / all, own / all]
    }

    /// The progress after a time of computing.
    fn line(&self, seconds: f64) -> String {
        let [fraction, own] = self.fractions();
        let trajectories = self.trajectories.load(Ordering::Relaxed);
        let rate = own * trajectories as f64 * self.steps / seconds;
        let left = match own > 0.0 {
            true => duration(seconds * (1.0 - fraction) / own),
            false => "?".to_owned(),
        };
        let count = match trajectories {
            1 => String::new(),
            all => format!(
                "{}/{all} trajectories, ",
                self.finished.load(Ordering::Relaxed)
            ),
        };
        format!(
            "{:.0} %, {count}{rate:.1e} steps/s, {left} left",
            (100.0 * fraction).floor()
        )
    }
}

impl Watch for Meter {
    fn start(&self) -> f64 {
        self.start
    }

    fn evaluated(&self, elapsed: f64, trajectories: usize) {
        let slot = rayon::current_thread_index().and_then(|thread| self.slots.get(thread));
        let Some(slot) = slot else {
            return;
        };
        let get = |place: &AtomicU64| f64::from_bits(place.load(Ordering::Relaxed));
        let set = |place: &AtomicU64, value: f64| place.store(value.to_bits(), Ordering::Relaxed);
        let last = get(&slot.elapsed);
        // Stages of a step may go back, but not so far: these are other trajectories.
        let last = if elapsed < 0.1 * last { 0.0 } else { last };
        if elapsed >= last {
            let more = trajectories as f64 * (elapsed - last);
            set(&slot.total, get(&slot.total) + more);
            set(&slot.elapsed, elapsed);
        }
    }
}

/// A duration with its two largest units.
pub(super) fn duration(seconds: f64) -> String {
    // The cast is saturating.
    let whole = seconds.round() as u64;
    match whole {
        0..10 => format!("{seconds:.1} s"),
        10..60 => format!("{whole} s"),
        60..3600 => format!("{} min {} s", whole / 60, whole % 60),
        3600..86_400 => format!("{} h {} min", whole / 3600, whole / 60 % 60),
        _ => format!("{} d {} h", whole / 86_400, whole / 3600 % 24),
    }
}

/// Whether and where the progress is shown.
pub(super) struct Progress {
    meter: Arc<Meter>,
    way: Option<Way>,
}

#[derive(Clone, Copy)]
enum Way {
    Bar,
    Lines,
}

impl Progress {
    /// A bar if standard error is a terminal; lines if these are wanted; otherwise nothing.
    pub(super) fn new(meter: Meter, wants_lines: bool) -> Self {
        let way = match std::io::stderr().is_terminal() {
            true => Some(Way::Bar),
            false => wants_lines.then_some(Way::Lines),
        };
        Progress {
            meter: Arc::new(meter),
            way,
        }
    }

    /// What evaluations note, if it is shown.
    pub(super) fn meter(&self) -> Option<Arc<dyn Watch>> {
        self.way.map(|_| Arc::clone(&self.meter) as Arc<dyn Watch>)
    }

    /// Shows the progress of a number of trajectories, some of which are finished before, until the result is dropped.
    pub(super) fn show(&self, trajectories: usize, before: usize) -> Shown {
        self.meter.begin(trajectories, before);
        Shown(self.way.map(|way| {
            let (end, ended) = channel();
            let meter = Arc::clone(&self.meter);
            (end, thread::spawn(move || show(&meter, way, &ended)))
        }))
    }

    /// Notes that another trajectory is finished.
    pub(super) fn finished(&self) {
        self.meter.finished.fetch_add(1, Ordering::Relaxed);
    }
}

/// A thread that shows the progress.
pub(super) struct Shown(Option<(Sender<()>, JoinHandle<()>)>);

impl Drop for Shown {
    fn drop(&mut self) {
        if let Some((end, thread)) = self.0.take() {
            drop(end);
            let _ = thread.join();
        }
    }
}

fn show(meter: &Meter, way: Way, ended: &Receiver<()>) {
    let began = Instant::now();
    let mut wait = SILENT;
    let mut bar = None;
    while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(wait) {
        let line = meter.line(began.elapsed().as_secs_f64());
        wait = match way {
            Way::Bar => {
                let bar = bar.get_or_insert_with(new_bar);
                bar.set_message(line);
                bar.set_position((PARTS * meter.fractions()[0]) as u64);
                FRAME
            }
            Way::Lines => {
                let _ = writeln!(std::io::stderr().lock(), "{line}");
                LINE
            }
        };
    }
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
}

fn new_bar() -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(PARTS as u64), ProgressDrawTarget::stderr());
    match ProgressStyle::with_template("{wide_bar} {msg}") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use symplectic::ensemble::Ensemble;
    use symplectic::nalgebra::DVector;
    use symplectic::simd::F64x8;
    use symplectic::{Method, ProvedFor, Separable, State};
    use symplectic_formula::{Form, Structure, System};
    use symplectic_tape::{Formula, Parameters, Tapes, Values};

    use super::*;

    /// Evaluations of twenty steps of two trajectories, side by side in lanes or one after another.
    #[test]
    fn evaluations_show_the_progress_within_trajectories() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let pool = pool.expect("a thread");
        let meter = |before| {
            let meter = pool.install(|| Meter::new([1.0, 21.0], -1.0));
            meter.begin(4, before);
            meter
        };
        // A step of Forest and Ruth goes back.
        let step = |time: f64| [0.68, 0.5, 0.32, 1.0].map(|node| time + node);
        let times = || (0..20).map(f64::from).flat_map(step);
        let lanes = meter(0);
        pool.install(|| times().for_each(|time| lanes.evaluated(time, 2)));
        assert_eq!(lanes.fractions(), [0.5, 0.5]);
        let alone = meter(1);
        pool.install(|| {
            times()
                .chain(times())
                .for_each(|time| alone.evaluated(time, 1))
        });
        alone.finished.store(2, Ordering::Relaxed);
        assert_eq!(alone.fractions(), [0.75, 0.5]);
        assert_eq!(
            alone.line(4.0),
            "75 %, 2/4 trajectories, 1.0e1 steps/s, 2.0 s left"
        );
        // Failed trajectories are finished.
        alone.finished.store(4, Ordering::Relaxed);
        assert_eq!(alone.fractions(), [1.0, 0.75]);
    }

    symplectic::tableau! { Verlet { base: velocity-verlet } }
    symplectic::tableau! { Gauss2 { base: gauss-2 } }

    /// The number of trajectories that are counted in a run of `count` trajectories in eight lanes.
    fn counted<M: Method + ProvedFor<Separable> + Sync>(method: M, count: u32) -> f64 {
        let text = "P q: [x], p: [px]; H = px^2/2 + x^2/2";
        let mut system = System::read_as(Form::Hamiltonian, "", text).expect("a formula");
        let structure = Structure::of(&mut system);
        let values = Values {
            bodies: 1,
            ..Values::default()
        };
        let tapes = Arc::new(Tapes::new(&mut system, &structure, &values, 0.0).expect("tapes"));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        pool.expect("a thread").install(|| {
            let meter = Arc::new(Meter::new([0.0, 10.0], 0.1));
            meter.begin(100, 0);
            let family = |k: u32| {
                let own = Parameters::none();
                let system = Formula::<Separable>::new(Arc::clone(&tapes), own);
                let q = DVector::from_element(1, f64::from(k));
                let start = State::new(0.0, q, DVector::zeros(1));
                (system.watched(Some(Arc::clone(&meter) as _)), vec![start])
            };
            Ensemble::of_families(method, (1..=count).map(family), 0.1)
                .expect("an ensemble")
                .in_lanes::<F64x8>()
                .integrate_to(10.0, |_| ControlFlow::Continue(()));
            100.0 * meter.fractions()[0]
        })
    }

    #[test]
    fn lanes_without_a_trajectory_are_not_counted() {
        // Groups of eight and three, and of five.
        for (found, count) in [(counted(Verlet, 11), 11.0), (counted(Gauss2, 5), 5.0)] {
            assert!((found - count).abs() < 0.01 * count, "{found} of {count}");
        }
    }

    #[test]
    fn durations_have_two_units() {
        let found = [0.04, 59.0, 61.0, 7260.0, 9e4, 1e300].map(duration);
        let expected = ["0.0 s", "59 s", "1 min 1 s", "2 h 1 min", "1 d 1 h"];
        assert_eq!(found[..5], expected);
    }
}
