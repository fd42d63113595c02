"""In place of ``scipy.integrate.solve_ivp``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _arrays
from ._arrays import Array
from ._errors import ArgumentError, StepError
from ._events import Event, States
from ._run import Run
from ._system import Method, System, system

#: Methods of SciPy.
_SCIPY = ("RK23", "RK45", "DOP853", "Radau", "BDF", "LSODA")

_TOLERANCE = (
    "a symplectic method takes steps of equal size, so a tolerance has no meaning: give `step`; then halve it, and compare the ends to see the error"
)
_EQUAL = "all steps have the size `step`"
_DERIVED = "derivatives are derived from the formula: leave it out"

#: What to do instead of an option of SciPy.
_OPTIONS = {
    "rtol": _TOLERANCE,
    "atol": _TOLERANCE,
    "first_step": _EQUAL,
    "min_step": _EQUAL,
    "args": "the values of parameters of the formula are `parameters={'g': 9.81}`",
    "jac": _DERIVED,
    "jac_sparsity": _DERIVED,
    "lband": _DERIVED,
    "uband": _DERIVED,
    "vectorized": _DERIVED,
}

#: The largest number of steps that are all kept.
_EVERY_STEP = 10**8


class OdeResult(dict[str, Any]):
    """The result of :func:`solve_ivp`, with the fields as keys and as attributes."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(name) from None

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self})

    def __repr__(self) -> str:
        width = max(map(len, self), default=0)
        return "\n".join(f"{name:>{width}}: {value!r}" for name, value in self.items())


class _Solution:
    """A solution at any time of the run: a state inside a step comes from a shorter step of the method, so it has the order of the method.

    Attributes
    ----------
    ts : ndarray
        The times of the steps.
    t_min, t_max : float
        The ends.
    """

    def __init__(self, run: Run, t: Array, y: Array, options: dict[str, Any]) -> None:
        self.ts, self._run, self._y, self._options = t, run, y, options
        self.t_min, self.t_max = float(min(t[0], t[-1])), float(max(t[0], t[-1]))

    def __call__(self, t: npt.ArrayLike) -> Array:
        """The state at `t`: shape (2d,) for a number, (2d, n) for n times."""
        times = _arrays.numbers(t, "t")
        if times.ndim > 1:
            raise ArgumentError(f"`t` must be a number or a list; it has the shape {times.shape}")
        flat = np.atleast_1d(times)
        if flat.size == 0:
            return np.empty((len(self._y), 0))
        if flat.min() < self.t_min or flat.max() > self.t_max:
            raise ArgumentError(f"the solution is known from {self.t_min} to {self.t_max}; found {flat.min()} to {flat.max()}")
        sign = 1.0 if self.ts[-1] >= self.ts[0] else -1.0
        order = np.argsort(sign * flat, kind="stable")
        states = np.empty((len(self._y), flat.size))
        states[:, order] = self._sorted(flat[order], sign)
        return states[:, 0] if times.ndim == 0 else states

    def _sorted(self, times: Array, sign: float) -> Array:
        """The states at sorted times, by the steps of the run around them."""
        first = int(np.searchsorted(sign * self.ts, sign * times[0], side="right")) - 1
        last = int(np.searchsorted(sign * self.ts, sign * times[-1], side="left"))
        if last <= first:
            return np.repeat(self._y[:, first : first + 1], len(times), axis=1)
        # The last step of a run that ends at an event is shorter.
        size = self.ts[1] - self.ts[0]
        half, run = len(self._y) // 2, self._run
        again = run.system.integrate(
            self._y[:half, first],
            self._y[half:, first],
            t0=self.ts[first],
            t=self.ts[first] + (last - first) * size if last == len(self.ts) - 1 and last > 1 else self.ts[last],
            step=abs(size) * (1 + 1e-9),
            method=run.method,
            output=times,
            **self._options,
        )
        return np.hstack([again.q, again.p]).T


def _events(given: Any) -> list[Event] | None:
    """Events as a list."""
    if given is None:
        return None
    entries = [given] if isinstance(given, (str, Event)) or callable(given) else list(given)
    for entry in entries:
        if callable(entry):
            raise ArgumentError("an event is the text of an expression, such as `'x - 1'`, or an `Event`: a Python function is not called in a step")
        if not isinstance(entry, (str, Event)):
            raise ArgumentError(f"an event is an expression in text or an `Event`, found {type(entry).__name__}")
    return [Event(entry) if isinstance(entry, str) else entry for entry in entries]


def _check_options(options: Mapping[str, Any]) -> None:
    for name in options:
        hint = _OPTIONS.get(name, "known here: method, t_eval, dense_output, events, step, max_step, parameters, and those of `System.integrate`")
        raise ArgumentError(f"`{name}` is not an option of this `solve_ivp`: {hint}")


def _step(step: float | None, max_step: float | None) -> float:
    chosen = max_step if step is None and max_step is not None and np.isfinite(max_step) else step
    if chosen is None:
        raise ArgumentError("give `step`, the size of all steps: a symplectic method does not choose it by a tolerance")
    return chosen


def _columns(states: States | Run) -> Array:
    return np.hstack([states.q.reshape(len(states.t), -1), states.p.reshape(len(states.t), -1)]).T


def _has_ended(run: Run, events: list[Event] | None) -> bool:
    """Whether an event ended the run."""
    return any(
        event.terminal is not False and len(states) >= int(event.terminal) for event, states in zip(events or [], run.events.values(), strict=True)
    )


def solve_ivp(
    fun: System | str,
    t_span: Sequence[float],
    y0: npt.ArrayLike,
    method: Method | None = None,
    t_eval: npt.ArrayLike | None = None,
    dense_output: bool = False,
    events: Event | str | Sequence[Event | str] | None = None,
    *,
    step: float | None = None,
    max_step: float | None = None,
    parameters: Mapping[str, Any] | None = None,
    solver: str | None = None,
    accept_lower_order: bool = False,
    **options: Any,
) -> OdeResult:
    """Solves an initial value problem like ``scipy.integrate.solve_ivp``, by a symplectic method.

    The right-hand side is a formula::

        q' = ∂H/∂p      p' = −∂H/∂q      y = (q, p)

    Parameters
    ----------
    fun : System or str
        A system, or the text of its formula.
    t_span : (float, float)
        Start and end; the end may be before the start.
    y0 : array_like, shape (2d,)
        Positions and momenta of the start, one after the other.
    method : str, Tableau, dict, optional
        As for :meth:`System.integrate`; by default ``gauss-4``.
    t_eval : array_like, optional
        The times of the states that are kept; by default those of all steps.
    dense_output : bool
        Whether `sol` is a function of the time. It repeats the steps around the times that it is called with.
    events : str, Event, or list of these, optional
        Zeros of expressions: see :class:`Event`.
    step : float
        The step size.
    max_step : float, optional
        The step size, if `step` is not given.
    parameters, solver, accept_lower_order
        As for :meth:`System.integrate`.

    Returns
    -------
    OdeResult
        With the fields of SciPy's result and one more:

        t : ndarray, shape (n,)
            The times.
        y : ndarray, shape (2d, n)
            The states.
        sol : function or None
            The solution at any time.
        t_events, y_events : list of ndarray or None
            For each event its times, and its states with the shape (count, 2d).
        nfev : int
            The evaluations of the velocity or the force.
        njev, nlu : int
            The factorisations by ``solver="newton"``.
        status : int
            0 at the end, 1 at an event that ended the run, −1 after a step that failed.
        message : str
            The reason.
        success : bool
            Whether `status` is 0 or 1.
        run : Run
            The run: energy error, invariants, pictures.

    Raises
    ------
    ArgumentError
        For a Python function as `fun`, for `rtol` and `atol` and other options without meaning, and for any other argument that does not fit.

    Examples
    --------
    >>> import numpy as np
    >>> import symplectica as sy
    >>> found = sy.solve_ivp("q: [x], p: [px]; H = px^2/2 + x^2/2", (0, 10), [1, 0], t_eval=np.linspace(0, 10, 5), step=0.1)
    >>> np.allclose(found.y[0], np.cos(found.t), atol=1e-12)
    True
    >>> sy.solve_ivp("q: [x], p: [px]; H = px^2/2 + x^2/2", (0, 10), [1, 0], step=0.1, rtol=1e-8)
    Traceback (most recent call last):
        ...
    symplectica._errors.ArgumentError: `rtol` is not an option of this `solve_ivp`: a symplectic method takes steps of equal size, ...
    """
    if isinstance(fun, str):
        fun = system(fun)
    if not isinstance(fun, System):
        if callable(fun):
            raise ArgumentError(
                "found a Python function, expected a system: write the formula of H, `system('q: [x], p: [px]; H = px^2/2 + x^2/2')`, and it runs as "
                "compiled code; `python_function(velocity, force)` calls Python functions, about a thousand times slower"
            )
        raise ArgumentError(f"found {type(fun).__name__}, expected a system or the text of a formula")
    _check_options(options)
    if isinstance(method, str) and method in _SCIPY:
        raise ArgumentError(f"SciPy's method `{method}` is not symplectic: leave out `method` for `gauss-4`, or take a name of `catalogue()`")
    size = _step(step, max_step)
    span = _arrays.numbers(t_span, "t_span")
    if span.shape != (2,):
        raise ArgumentError(f"`t_span` must be a start and an end; it has the shape {span.shape}")
    start, end = map(float, span)
    y = _arrays.numbers(y0, "y0")
    if y.ndim != 1 or y.size % 2 or y.size == 0:
        raise ArgumentError(f"`y0` must contain d positions and d momenta; it has the shape {y.shape}")
    times = None if t_eval is None else _arrays.numbers(t_eval, "t_eval")
    if times is not None:
        sign = 1.0 if end >= start else -1.0
        if times.ndim != 1 or (np.diff(times) * sign < 0).any():
            raise ArgumentError("`t_eval` must be a list of times, sorted from the start to the end")
        if times.size and ((times[0] - start) * sign < 0 or (end - times[-1]) * sign < 0):
            raise ArgumentError(f"the times in `t_eval` must be in `t_span`, from {start} to {end}; found {times[0]} to {times[-1]}")

    zeros = _events(events)
    keeps_steps = times is None or dense_output
    if keeps_steps and abs(end - start) > _EVERY_STEP * _arrays.number(size, "step") > 0:
        raise ArgumentError("there are more than 10^8 steps, and all are kept: give `t_eval`, the times to keep, without `dense_output`")
    output: Any = _EVERY_STEP + 1 if keeps_steps or times is None else times if times.size else 0
    status, message = 0, "The solver successfully reached the end of the integration interval."
    half = y.size // 2
    more: dict[str, Any] = {"solver": solver, "accept_lower_order": accept_lower_order}
    try:
        run = fun.integrate(
            y[:half],
            y[half:],
            t0=start,
            t=end,
            step=size,
            method=method,
            output=output,
            events=zeros,
            parameters=parameters,
            **more,
        )
    except StepError as error:
        if error.run is None:
            raise
        run, status, message = error.run, -1, error.message
    if status == 0 and _has_ended(run, zeros):
        status, message = 1, "A termination event occurred."

    t, states = run.t, _columns(run)
    last, *final = run.state
    if keeps_steps and last != t[-1]:
        # An event ended the run inside a step.
        t, states = np.append(t, last), np.column_stack([states, np.concatenate(final)])
    solution = None
    if dense_output:
        changes = [replace(event, terminal=False) for event in zeros or [] if event.wall or event.set]
        solution = _Solution(run, t, states, {**more, "events": changes})
    if times is not None:
        t = times[abs(times - start) <= abs(last - start)]
        states = states[:, : len(t)] if solution is None else solution(t)
    found = list(run.events.values())
    return OdeResult(
        t=t,
        y=states,
        sol=solution,
        t_events=None if zeros is None else [one.t for one in found],
        y_events=None if zeros is None else [_columns(one).T for one in found],
        nfev=int(run.statistics["evaluations"]),
        njev=int(run.statistics["factorisations"]),
        nlu=int(run.statistics["factorisations"]),
        status=status,
        message=message,
        success=status >= 0,
        run=run,
    )
