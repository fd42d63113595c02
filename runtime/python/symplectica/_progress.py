"""Progress of a run: a bar on a terminal and in notebooks, or a function of yours."""

from __future__ import annotations

import sys
import time
from typing import Any

from ._errors import ArgumentError


class Progress:
    """What a run calls with the elapsed time of a trajectory and the number of finished ones."""

    def __init__(self, progress: Any, length: float, trajectories: int | None) -> None:
        self._length, self._trajectories = length, trajectories
        self._bar = _Bar() if progress is True else None
        self._show: Any = progress if self._bar is None else self._bar
        if not callable(self._show):
            raise ArgumentError(f"`progress` must be True, False or a function of the fraction, found {type(progress).__name__}")

    def __call__(self, elapsed: float, finished: int) -> None:
        done = finished / self._trajectories if self._trajectories else elapsed / abs(self._length) if self._length else 1.0
        self._show(min(max(done, 0.0), 1.0))

    def end(self, complete: bool) -> None:
        """The run has ended."""
        if complete:
            self._show(1.0)
        if self._bar is not None:
            self._bar.end()


def shown(progress: Any, length: float, trajectories: int | None) -> Progress | None:
    """What a run calls, if it shows its progress."""
    return None if progress is False or progress is None else Progress(progress, length, trajectories)


class _Bar:
    """A line on standard error that is written again; notebooks show it as well."""

    def __init__(self) -> None:
        self._start = time.monotonic()

    def __call__(self, fraction: float) -> None:
        elapsed = time.monotonic() - self._start
        left = "" if fraction <= 0 else f", {_duration(elapsed * (1 - fraction) / fraction)} left"
        width = 30
        full = int(width * fraction)
        bar = "█" * full + "░" * (width - full)
        sys.stderr.write(f"\r{100 * fraction:3.0f} % {bar} {_duration(elapsed)}{left}   ")
        sys.stderr.flush()


    def end(self) -> None:
        """Goes on to the next line."""
        sys.stderr.write("\n")
        sys.stderr.flush()


def _duration(seconds: float) -> str:
    minutes, seconds = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{seconds:02}" if hours else f"{minutes}:{seconds:02}"
