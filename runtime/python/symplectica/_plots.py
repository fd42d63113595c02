"""Pictures with matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import ArgumentError

if TYPE_CHECKING:
    from ._compare import Comparison
    from ._ensemble import Ensemble
    from ._run import Run

_KINDS = ("orbit", "phase", "time", "energy")


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.subplots(layout="constrained")[1]


def plot_run(run: Run, kind: str | None, ax: Any) -> Any:
    """Draws a run: see :meth:`Run.plot`."""
    dimension = run.dimension
    kind = kind or ("phase" if dimension == 1 else "orbit")
    if kind not in _KINDS:
        raise ArgumentError(f"unknown kind `{kind}`; known here: {', '.join(_KINDS)}")
    if kind == "orbit" and dimension == 1:
        raise ArgumentError("an orbit needs two coordinates: take kind='phase' or kind='time'")
    ax = _axes(ax)
    positions, momenta = run.system._native.names(dimension)
    q = run.q.reshape(len(run.t), -1)
    if kind == "phase":
        ax.plot(q[:, 0], run.p.reshape(len(run.t), -1)[:, 0])
        ax.set(xlabel=positions[0], ylabel=momenta[0])
    elif kind == "orbit":
        components = run.system._native.layout[1]
        bodies = range(0, dimension, components) if components > 1 else [0]
        for body in bodies:
            name = positions[body].removesuffix("[0]")
            (line,) = ax.plot(q[:, body], q[:, body + 1], label=name if len(bodies) > 1 else None)
            if len(bodies) > 1:
                # Where the body is at the end; without a line of its own in the legend.
                ax.plot(q[-1, body], q[-1, body + 1], "o", color=line.get_color(), markersize=4, label="_end")
        if 1 < len(bodies) <= 12:
            ax.legend()
        names = positions[:2] if len(bodies) == 1 else [name.replace("[0]", "[i]", 1) for name in positions[:2]]
        ax.set(xlabel=names[0], ylabel=names[1])
        ax.set_aspect("equal", adjustable="datalim")
    elif kind == "time":
        for place, name in list(enumerate(positions))[:12]:
            ax.plot(run.t, q[:, place], label=name)
        # Beside the curves, which fill the axes.
        ax.legend(loc="center left", bbox_to_anchor=(1, 0.5))
        ax.set(xlabel="t")
    else:
        ax.plot(run.t, run.energy_error)
        ax.set(xlabel="t", ylabel="energy error")
    return ax


def plot_ensemble(ensemble: Ensemble, x: str | None, y: str | None, ax: Any) -> Any:
    """Draws an ensemble: see :meth:`Ensemble.plot`."""
    ax = _axes(ax)
    dimension = ensemble._starts[1].shape[1]
    positions, momenta = ensemble.system._native.names(dimension)
    x, y = x or positions[0], y or momenta[0]
    parts = ensemble.section if ensemble.section is not None else [ensemble.end]
    count = sum(len(states) for states in parts)
    style = {"linestyle": "none", "marker": ".", "markersize": 3 if count < 5000 else 1, "markeredgewidth": 0}
    for states in parts:
        ax.plot(ensemble.coordinate(x, states), ensemble.coordinate(y, states), color=None if len(parts) > 1 else "black", **style)
    ax.set(xlabel=x, ylabel=y)
    return ax


def plot_comparison(comparison: Comparison, ax: Any) -> Any:
    """Draws a work–precision diagram: see :meth:`Comparison.plot`."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    ax = _axes(ax)
    names = list(dict.fromkeys(found.method for found in comparison.measurements))
    times = [1e3 * found.seconds for found in comparison.measurements if np.isfinite(found.error)]
    for name in names:
        # In the order of the steps: times have noise.
        good = [found for found in comparison.measurements if found.method == name and np.isfinite(found.error)]
        good.sort(key=lambda found: found.step)
        ax.loglog([1e3 * found.seconds for found in good], [found.error for found in good], "o-", label=name)
    is_wide = bool(times) and max(times) > 100 * min(times)
    ax.xaxis.set_major_locator(LogLocator(subs=(1.0,) if is_wide else (1.0, 2.0, 5.0)))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.set(xlabel="time of a run in ms", ylabel="relative error at the end")
    ax.legend()
    return ax
