//! The progress of a run: by trajectories, or within a single one.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// The length of the bar of a single trajectory.
const PARTS: u64 = 1000;

/// A progress bar, hidden unless standard error is a terminal.
pub(super) struct Progress {
    bar: ProgressBar,
    is_single: bool,
}

impl Progress {
    pub(super) fn new(trajectories: usize) -> Self {
        let target = match std::io::stderr().is_terminal() {
            true => ProgressDrawTarget::stderr(),
            false => ProgressDrawTarget::hidden(),
        };
        Self::on(target, trajectories)
    }

    fn on(target: ProgressDrawTarget, trajectories: usize) -> Self {
        let is_single = trajectories == 1;
        let (length, template) = match is_single {
            true => (PARTS, "{wide_bar} {percent} %, {eta} left"),
            false => (
                trajectories as u64,
                "{wide_bar} {pos}/{len} trajectories, {eta} left",
            ),
        };
        let bar = ProgressBar::with_draw_target(Some(length), target);
        let bar = match ProgressStyle::with_template(template) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        };
        Progress { bar, is_single }
    }

    /// Whether there is one trajectory, whose steps are shown.
    pub(super) fn is_single(&self) -> bool {
        self.is_single
    }

    /// Shows that a fraction of a single trajectory is done; does nothing if there are more.
    pub(super) fn within(&self, fraction: f64) {
        // The cast rounds down, and NaN is 0.
        let part = (fraction * PARTS as f64) as u64;
        if self.is_single && part > self.bar.position() {
            self.bar.set_position(part.min(PARTS));
        }
    }

    /// Shows that another trajectory is done.
    pub(super) fn trajectory(&self) {
        match self.is_single {
            true => self.bar.set_position(PARTS),
            false => self.bar.inc(1),
        }
    }

    /// Removes the bar.
    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trajectories_are_counted_and_a_single_one_is_shown_in_parts() {
        let hidden = ProgressDrawTarget::hidden;
        let single = Progress::on(hidden(), 1);
        let positions = [0.0, 0.25, 0.25, 0.1, f64::NAN, 0.9999, 2.0].map(|fraction| {
            single.within(fraction);
            single.bar.position()
        });
        assert_eq!(positions, [0, 250, 250, 250, 250, 999, 1000]);
        let many = Progress::on(hidden(), 3);
        many.within(0.5);
        many.trajectory();
        assert_eq!((many.bar.position(), many.bar.length()), (1, Some(3)));
    }
}
