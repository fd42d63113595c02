"""Progress of a run: a bar on a terminal and in notebooks, or a function of yours."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

from ._errors import ArgumentError


def shown(progress: Any, length: float, trajectories: int | None) -> Callable[[float, int], None] | None:
    """The function that the library calls with the elapsed time of a trajectory and the number of finished ones."""
    if progress is False or progress is None:
        return None
    show = progress if callable(progress) else _Bar() if progress is True else None
    if show is None:
        raise ArgumentError(f"`progress` must be True, False or a function of the fraction, found {type(progress).__name__}")

    def call(elapsed: float, finished: int) -> None:
        done = finished / trajectories if trajectories else elapsed / abs(length) if length else 1.0
        show(min(max(done, 0.0), 1.0))

    return call


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


def _duration(seconds: float) -> str:
    minutes, seconds = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{seconds:02}" if hours else f"{minutes}:{seconds:02}"
