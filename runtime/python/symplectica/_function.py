"""Systems that are given by Python functions: the slow way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _arrays
from ._arrays import Array
from ._errors import ArgumentError, StepError
from ._tableau import Doubles, Tableau, method as method_of

#: A function of the time, the positions and the momenta.
Function = Callable[[float, Array, Array], Any]

_MOST_SWEEPS = 200
#: After this number of sweeps an iteration that converges changes the stages by less than a tenth.
_SWEEPS_TO_APPROACH = 20


@dataclass(frozen=True)
class FunctionRun:
    """A trajectory of Python functions.

    Attributes
    ----------
    t : ndarray, shape (n,)
        The times of all steps.
    q, p : ndarray, shape (n, …)
        Positions and momenta.
    energy, energy_error : ndarray or None, shape (n,)
        H, and (H − H₀)/\\|H₀\\| (H − H₀ if H₀ is 0); None without `energy`.
    statistics : dict
        Steps, sweeps of the stage iteration, evaluations.
    method, step
        What was integrated.
    """

    t: Array
    q: Array
    p: Array
    energy: Array | None
    energy_error: Array | None
    statistics: dict[str, int]
    method: Tableau | Doubles
    step: float


def _order(a: Array, a_tilde: Array) -> list[tuple[int, int]] | None:
    """The order of evaluations (0: velocity, 1: force; stage) if the method is explicit for separable systems.

    The velocity of stage j needs P_j, so the forces k with ã_jk ≠ 0; the force needs Q_j, so the velocities k with a_jk ≠ 0.
    """
    stages = range(len(a))
    needs = {(half, j): [(1 - half, int(k)) for k in np.flatnonzero(row[j])] for half, row in enumerate((a_tilde, a)) for j in stages}
    try:
        return list(TopologicalSorter(needs).static_order())
    except CycleError:
        return None


@dataclass(frozen=True)
class PythonFunction:
    """A system of Python functions: see :func:`python_function`."""

    velocity: Function
    force: Function
    energy: Function | None = None
    separable: bool = False

    def integrate(self, q: npt.ArrayLike, p: npt.ArrayLike, *, t: float, step: float, t0: float = 0.0, method: Any = "gauss-4") -> FunctionRun:
        """Integrates to the time `t`, in equal steps of about `step`, with compensated sums.

        Raises
        ------
        ArgumentError
            For an argument, or a shape of a returned array, that does not fit.
        StepError
            If a state is not finite, or the stages do not converge.
        """
        start, end, size = _arrays.number(t0, "t0"), _arrays.number(t, "t"), _arrays.number(step, "step")
        if size <= 0:
            raise ArgumentError(f"the step is {size}: it must be positive")
        states = np.array([_arrays.numbers(q, "q"), _arrays.numbers(p, "p")]) if np.shape(q) == np.shape(p) else np.empty(0)
        if states.size == 0:
            raise ArgumentError(f"`q` and `p` have the shapes {np.shape(q)} and {np.shape(p)}: they must be the same, and not empty")
        made = method_of(method)
        count = int(np.ceil(abs(end - start) / size * (1 - 1e-12)))
        h = (end - start) / max(count, 1)
        run = _Stages(self, made, states.shape[1:], h)
        y, rest = states.reshape(2, -1), np.zeros((2, states[0].size))
        times: Array = start + h * np.arange(count + 1, dtype=np.float64)
        rows = [y]
        times[-1] = end
        for number, time in enumerate(times[:-1], 1):
            increment = run.increment(float(time), y, number) - rest
            new = y + increment
            rest, y = (new - y) - increment, new
            rows.append(y)
        halves = np.array(rows).reshape(count + 1, *states.shape)
        energies = error = None
        if self.energy is not None:
            energies = np.array([float(self.energy(float(time), *halves[k])) for k, time in enumerate(times)])
            error = (energies - energies[0]) / (abs(energies[0]) or 1.0)
        return FunctionRun(times, halves[:, 0], halves[:, 1], energies, error, {"steps": count, **run.counts}, made, h)


class _Stages:
    """The stages of a step: explicit if the method is, otherwise by fixed-point iteration from those of the previous step."""

    def __init__(self, system: PythonFunction, method: Tableau | Doubles, shape: tuple[int, ...], h: float) -> None:
        self._functions = (system.velocity, system.force)
        self._a, self._b, self._h, self._shape = (method.a, method.a_tilde), (method.b, method.b_tilde), h, shape
        # No symplectic method is explicit for every H.
        self._order = _order(*self._a) if system.separable else None
        self._nodes = self._order or [(half, j) for j in range(len(method.b)) for half in (0, 1)]
        # A stage that nothing depends on is not evaluated.
        self._nodes = [(half, j) for half, j in self._nodes if self._b[half][j] or self._a[half][:, j].any()]
        self._hides = system.separable
        # Velocities are at t0 + c̃h, forces at t0 + ch.
        self._c = (method.a_tilde.sum(axis=1), method.a.sum(axis=1))
        self._slopes = np.zeros((2, len(method.b), int(np.prod(shape))))
        self.counts = {"iterations": 0, "most_iterations": 0, "evaluations": 0}

    def _evaluate(self, half: int, j: int, time: float, y: Array) -> Array:
        arguments = [(y[k] + self._h * (self._a[k][j] @ self._slopes[k])).reshape(self._shape) for k in (0, 1)]
        if self._hides:
            # The velocity of a separable system does not see the positions: NaN would show.
            arguments[half] = np.full(self._shape, np.nan)
        found = np.asarray(self._functions[half](time + self._c[half][j] * self._h, *arguments), dtype=float)
        if found.shape != self._shape:
            raise ArgumentError(f"`{('velocity', 'force')[half]}` returned the shape {found.shape}, expected {self._shape}")
        self.counts["evaluations"] += 1
        return found.ravel()

    def increment(self, time: float, y: Array, number: int) -> Array:
        """h Σ b_i k_i for both halves."""
        last, sweeps = np.inf, 0
        while True:
            before = self._slopes.copy()
            for half, j in self._nodes:
                self._slopes[half, j] = self._evaluate(half, j, time, y)
            if not np.isfinite(self._slopes).all():
                hint = "; with `separable=True` the velocity must not use `q`, nor the force `p`: these are NaN there" * self._hides
                raise StepError(f"step {number} at time {time}: a velocity or force is not finite{hint}", kind="not finite", time=time, step=number, step_size=self._h)
            if self._order is not None:
                break
            sweeps += 1
            # Positions and momenta have different units.
            scale = np.maximum(abs(y).max(axis=1), abs(self._h * self._slopes).max(axis=(1, 2)))
            moved = abs(self._h * (self._slopes - before)).max(axis=(1, 2))
            change = float((moved / np.where(scale > 0, scale, 1.0)).max())
            if change <= np.finfo(float).eps or last <= change < 1e-10:
                break
            if sweeps == _MOST_SWEEPS or sweeps >= _SWEEPS_TO_APPROACH and change > 0.1:
                words = f"step {number} at time {time}: the stages did not converge in {sweeps} sweeps (last relative change {change:.1e}); take a smaller step"
                raise StepError(words, kind="no convergence", time=time, step=number, step_size=self._h)
            last = change
        self.counts["iterations"] += sweeps
        self.counts["most_iterations"] = max(self.counts["most_iterations"], sweeps)
        return np.array([self._h * (self._b[half] @ self._slopes[half]) for half in (0, 1)])


def python_function(velocity: Function, force: Function, energy: Function | None = None, *, separable: bool = False) -> PythonFunction:
    """A system of Python functions, for what no formula describes; slow.

    ::

        q' = velocity(t, q, p)      p' = force(t, q, p)

    An evaluation costs about 10 µs of Python and NumPy, where that of a formula costs about 10 ns: write a formula if you can. See :func:`system`.

    Parameters
    ----------
    velocity, force : function
        ∂H/∂p and −∂H/∂q at (t, q, p); the arrays have the shape of the start.
    energy : function, optional
        H at (t, q, p), for the energy error.
    separable : bool
        Whether the velocity depends on (t, p) only, and the force on (t, q): splittings are then explicit. The other argument is NaN.

    Returns
    -------
    PythonFunction
        Its ``integrate(q, p, t=…, step=…, method=…)`` returns all states.

    Examples
    --------
    >>> import numpy as np
    >>> import symplectica as sy
    >>> pendulum = sy.python_function(lambda t, q, p: p, lambda t, q, p: -np.sin(q), lambda t, q, p: p @ p / 2 - np.cos(q).sum())
    >>> run = pendulum.integrate([1.0], [0.0], t=10, step=0.1)
    >>> run.q.shape, bool(abs(run.energy_error).max() < 1e-10)
    ((101, 1), True)
    """
    return PythonFunction(velocity, force, energy, separable)
