"""Error against run time of methods on a system of yours."""

from __future__ import annotations

import time
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _arrays
from ._arrays import Array
from ._errors import ArgumentError, StepError
from ._tableau import method as method_of

if TYPE_CHECKING:
    from ._system import System

#: Methods to compare by default, by the kind of system.
_SEPARABLE = ("stormer-verlet", "blanes-moan-2002-s10", "sofroniou-spaletta-2005-s35odr10", "gauss-4", "gauss-8")
_GENERAL = ("gauss-2", "gauss-4", "gauss-8")
_HOLONOMIC = ("lobatto-2", "lobatto-3", "lobatto-4")
_NONHOLONOMIC = ("gauss-1",)


@dataclass(frozen=True)
class Measurement:
    """A run of a comparison.

    Attributes
    ----------
    method : str
    step : float
    error : float
        The distance of the end from the exact one, relative to the size of the exact one; infinite if the run failed.
    energy_error : float
        At the end.
    seconds : float
        The median of the times of the whole run.
    evaluations : int
        Of velocities and forces.
    """

    method: str
    step: float
    error: float
    energy_error: float
    seconds: float
    evaluations: int


@dataclass(frozen=True)
class Comparison:
    """Error against run time.

    Attributes
    ----------
    measurements : list of Measurement
    reference : (ndarray, ndarray)
        The exact end.
    """

    measurements: list[Measurement]
    reference: tuple[Array, Array]

    def fastest(self, error: float) -> Measurement | None:
        """The fastest run with at most this error."""
        good = [found for found in self.measurements if found.error <= error]
        return min(good, key=lambda found: found.seconds, default=None)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each run."""
        import pandas

        return pandas.DataFrame([vars(found) for found in self.measurements])

    def plot(self, ax: Any = None) -> Any:
        """The work–precision diagram with matplotlib."""
        from ._plots import plot_comparison

        return plot_comparison(self, ax)

    def __str__(self) -> str:
        header = ("method", "step", "error", "energy error", "time", "evaluations")
        table = [header] + [
            (
                found.method,
                f"{found.step:g}",
                f"{found.error:.1e}" if np.isfinite(found.error) else "failed",
                f"{found.energy_error:.1e}" if np.isfinite(found.energy_error) else "",
                _seconds(found.seconds),
                str(found.evaluations),
            )
            for found in self.measurements
        ]
        widths = [max(len(row[k]) for row in table) for k in range(len(header))]
        lines = ["  ".join([row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True))]) for row in table]
        return "\n".join(line.rstrip() for line in lines)

    __repr__ = __str__


def _seconds(seconds: float) -> str:
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-6:.3g} µs"


def compare(
    system: System,
    methods: Sequence[Any] | None,
    q: Any,
    p: Any,
    *,
    t: float,
    steps: npt.ArrayLike,
    t0: float,
    parameters: Mapping[str, Any] | None,
    reference: Any,
    repeats: int,
) -> Comparison:
    """Measures methods on a system: see :meth:`System.compare`."""
    if q is None or p is None:
        raise ArgumentError("give the start: `q` and `p`")
    if methods is None:
        if system._constraints is not None:
            methods = _HOLONOMIC if system._constraints else _NONHOLONOMIC
        else:
            methods = _SEPARABLE if system.is_separable else _GENERAL
    sizes = np.atleast_1d(_arrays.numbers(steps, "steps"))
    repeats = _arrays.count(repeats, "repeats", 1)
    start: dict[str, Any] = {"t": t, "t0": t0, "parameters": parameters}
    if reference is None:
        reference = _reference(system, q, p, float(sizes.min()), start)
    exact = tuple(_arrays.numbers(half, "reference") for half in reference)
    size = float(np.sqrt(sum((half**2).sum() for half in exact))) or 1.0
    found = []
    with warnings.catch_warnings():
        # The table has the errors.
        warnings.simplefilter("ignore", UserWarning)
        for given in methods:
            made = method_of(given)
            name = str(given) if isinstance(given, str) else made.name or "a method without a name"
            for step in sizes:
                seconds, run = [], None
                try:
                    # The first run derives the method and fills caches.
                    for number in range(repeats + 1):
                        before = time.perf_counter()
                        run = system.integrate(q, p, step=float(step), method=made, output=0, **start)
                        if number > 0:
                            seconds.append(time.perf_counter() - before)
                except StepError:
                    found.append(Measurement(name, float(step), float("inf"), float("inf"), float("nan"), 0))
                    continue
                assert run is not None
                _, end_q, end_p = run.state
                distance = np.sqrt(((end_q - exact[0]) ** 2).sum() + ((end_p - exact[1]) ** 2).sum())
                energy = float(run.energy_error[-1])
                found.append(Measurement(name, float(step), float(distance) / size, energy, float(np.median(seconds)), int(run.statistics["evaluations"])))
    return Comparison(found, (exact[0], exact[1]))


def _reference(system: System, q: Any, p: Any, step: float, start: dict[str, Any]) -> tuple[Array, Array]:
    """The end by a method of high order, with steps that are halved until nothing but rounding changes."""
    method = {None: "gauss-8", True: "lobatto-4", False: {"base": "gauss-1", "weights": "suzuki(4)"}}[system._constraints]
    before = None
    for _ in range(12):
        try:
            _, end_q, end_p = system.integrate(q, p, step=step, method=method, output=0, **start).state
        except StepError:
            end_q = None
        if end_q is not None:
            if before is not None:
                change = max(abs(end_q - before[0]).max(), abs(end_p - before[1]).max())
                if change <= 1e-13 * max(abs(end_q).max(), abs(end_p).max()):
                    return end_q, end_p
            before = end_q, end_p
        step /= 2
    if before is None:
        raise ArgumentError("no step of the reference converges: give smaller `steps`, or a `reference`")
    return before
