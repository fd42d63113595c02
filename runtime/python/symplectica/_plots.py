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
            ax.plot(q[:, body], q[:, body + 1], label=positions[body].split("[0]")[0] if len(bodies) > 1 else None)
        if 1 < len(bodies) <= 12:
            ax.legend()
        ax.set(xlabel=positions[0], ylabel=positions[1])
        ax.set_aspect("equal", adjustable="datalim")
    elif kind == "time":
        for place, name in list(enumerate(positions))[:12]:
            ax.plot(run.t, q[:, place], label=name)
        ax.legend()
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
    for states in parts:
        ax.plot(ensemble.coordinate(x, states), ensemble.coordinate(y, states), ",", color=None if len(parts) > 1 else "black")
    ax.set(xlabel=x, ylabel=y)
    return ax


def plot_comparison(comparison: Comparison, ax: Any) -> Any:
    """Draws a work–precision diagram: see :meth:`Comparison.plot`."""
    ax = _axes(ax)
    names = list(dict.fromkeys(found.method for found in comparison.measurements))
    for name in names:
        good = [found for found in comparison.measurements if found.method == name and np.isfinite(found.error)]
        good.sort(key=lambda found: found.seconds)
        ax.loglog([found.seconds for found in good], [found.error for found in good], "o-", label=name)
    ax.set(xlabel="time of a run in s", ylabel="relative error at the end")
    ax.legend()
    return ax
