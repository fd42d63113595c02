"""A trajectory: its states, energies, invariants, events."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import Array
from ._errors import ArgumentError
from ._events import Events, States
from ._files import parameter_facts, save
from ._tableau import Doubles, Tableau

if TYPE_CHECKING:
    from ._system import System


@dataclass(frozen=True, eq=False)
class Run:
    """A trajectory.

    Attributes
    ----------
    t : ndarray, shape (n,)
        Times.
    q, p : ndarray, shape (n, …)
        Positions and momenta at these times, in the shape of the start.
    state : (float, ndarray, ndarray)
        Time, position and momentum at the end, or after the last full step.
    events : Events
        The states at events.
    statistics : dict
        Steps, sweeps of the stage iteration, evaluations.
    system : System
    method : Tableau or Doubles
    step : float
        The size of the equal steps to the end: at most the one that was asked for.
    start : (float, ndarray, ndarray)
        The state at the start.
    """

    t: Array
    q: Array
    p: Array
    state: tuple[float, Array, Array]
    events: Events
    statistics: dict[str, float]
    system: System
    method: Tableau | Doubles
    step: float
    start: tuple[float, Array, Array]
    _setting: dict[str, Any] = field(repr=False, default_factory=dict)

    @classmethod
    def _of(cls, system: System, method: Any, q0: Array, p0: Array, start: float, setting: dict[str, Any], names: list[Any], texts: list[str], found: dict[str, Any]) -> Run:
        shape = q0.shape

        def shaped(rows: Array) -> Array:
            return rows.reshape(rows.shape[:-1] + shape)

        index = found["event_index"]
        events = []
        for number in range(len(names)):
            chosen = index == number
            events.append(States(found["event_t"][chosen], shaped(found["event_q"][chosen]), shaped(found["event_p"][chosen])))
        time, q, p = found["state"]
        state = (time, shaped(q), shaped(p))
        rows = found["t"], shaped(found["q"]), shaped(found["p"])
        if len(rows[0]) == 0:
            rows = np.array([time]), state[1][None], state[2][None]
        elif (found["ended"] or found["error"] is not None or found["interrupted"] is not None) and (time - rows[0][-1]) * setting["step"] > 0:
            # The run ended before its end: the last state is that of the event, or of the last full step.
            rows = np.append(rows[0], time), np.append(rows[1], state[1][None], axis=0), np.append(rows[2], state[2][None], axis=0)
        return cls(*rows, state, Events(names, events, texts), found["statistics"], system, method, found["step"], (start, q0, p0), setting)

    @property
    def dimension(self) -> int:
        """The number of degrees of freedom."""
        return int(self.start[1].size)

    @cached_property
    def _problem(self) -> Any:
        return self.system._problem(self.dimension, self.start[0], {}, {})

    def _rows(self) -> tuple[Array, Array, Array, Array]:
        dimension = self.dimension
        q, p = (np.ascontiguousarray(half.reshape(-1, dimension)) for half in (self.q, self.p))
        return np.ascontiguousarray(self.t), q, p, np.empty((1, 0))

    @cached_property
    def energy(self) -> Array:
        """H at the times, shape (n,)."""
        energies: Array = self._problem.energies(*self._rows())
        return energies

    @cached_property
    def _energy_of_start(self) -> tuple[float, float]:
        """H at the start, and what its errors are relative to."""
        time, q, p = self.start
        rows = np.array([time]), q.reshape(1, -1), p.reshape(1, -1), np.empty((1, 0))
        return float(self._problem.energies(*rows)[0]), self._problem.energy_unit(time, q.ravel().tolist(), p.ravel().tolist(), [])

    @property
    def _last_energy_error(self) -> float:
        time, q, p = self.state
        first, unit = self._energy_of_start
        last = self._problem.energies(np.array([time]), np.ascontiguousarray(q.reshape(1, -1)), np.ascontiguousarray(p.reshape(1, -1)), np.empty((1, 0)))
        return (float(last[0]) - first) / unit

    @cached_property
    def energy_error(self) -> Array:
        """(H − H₀)/\\|H₀\\| at the times; relative to the terms of H if H₀ is nothing but rounding.

        With a force, friction or a time in H it is the change of the energy, not an error.
        """
        first, unit = self._energy_of_start
        return np.asarray((self.energy - first) / unit)

    @cached_property
    def invariants(self) -> dict[str, Array]:
        """The conserved functions that the formula declares or that were found, by name: shape (n,), or (n, k) if they have k components."""
        found = {}
        for number, (name, _) in enumerate(self._problem.invariants):
            parts = self._problem.invariant(number, *self._rows())
            found[name] = parts[0] if len(parts) == 1 else np.stack(parts, axis=1)
        return found

    @cached_property
    def constraint_error(self) -> Array | None:
        """The largest \\|φ(q)\\| or \\|w·q'\\| at the times; None without constraints."""
        errors: Array | None = self._problem.constraint_errors(*self._rows())
        return errors

    def evaluate(self, expression: str) -> Array:
        """An expression with the names of the formula at the times, shape (n,).

        Examples
        --------
        >>> import symplectica as sy
        >>> run = sy.system("q: [x], p: [px]; H = px^2/2 + x^2/2").integrate([1.0], [0.0], t=1, step=0.1, output=3)
        >>> run.evaluate("x^2 + px^2").round(12).tolist()
        [1.0, 1.0, 1.0]
        """
        values: Array = self._problem.evaluate(expression, *self._rows())
        return values

    @cached_property
    def state_transition(self) -> Array:
        """∂(q, p)(end)/∂(q, p)(start), shape (2d, 2d), by the variational equations of the method: see :meth:`System.state_transition`."""
        _, _, derivative = self.system.state_transition(**self._again())
        return derivative

    def _again(self) -> dict[str, Any]:
        """The arguments of a run with derivatives."""
        if any(len(states) for states in self.events.values()):
            raise ArgumentError("derivatives are those of runs without events")
        time, q, p = self.start
        return {
            "q": q,
            "p": p,
            "t": self.state[0],
            "t0": time,
            "step": abs(self.step),
            "method": self.method,
            "solver": "newton" if self._setting["newton"] else None,
            "accept_lower_order": self._setting["accept_lower_order"],
        }

    def parameter_derivatives(self, *names: str) -> dict[str, Array]:
        """The derivatives of the end by parameters: see :meth:`System.parameter_derivatives`."""
        return self.system.parameter_derivatives(*names, **self._again())

    @property
    def columns(self) -> list[str]:
        """The names of the coordinates, positions first."""
        positions, momenta = self.system._native.names(self.dimension)
        return [*positions, *momenta]

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with the time, the coordinates and the energy error as columns."""
        import pandas

        _, q, p, _ = self._rows()
        table = pandas.DataFrame(np.hstack([self.t[:, None], q, p]), columns=["t", *self.columns])
        table["energy_error"] = self.energy_error
        return table

    def save(self, path: str | Path) -> None:
        """Writes ``t``, ``q``, ``p``, the energy error, the formula and the method to a file.

        Parameters
        ----------
        path : str or Path
            A name that ends in ``.npz`` (NumPy), ``.h5`` (HDF5, with h5py), ``.parquet`` or ``.csv`` (a table, with pandas).
        """
        arrays = {"t": self.t, "q": self.q, "p": self.p, "energy_error": self.energy_error}
        facts = {"formula": self.system.text, "method": self.method.name or "", "step": self.step, **parameter_facts(self.system.parameters)}
        save(path, arrays, facts, self.to_pandas)

    def plot(self, kind: str | None = None, ax: Any = None) -> Any:
        """A picture with matplotlib.

        Parameters
        ----------
        kind : str, optional
            ``orbit`` (paths of bodies in the plane, or of the first two coordinates), ``phase`` (p against q of the first coordinate),
            ``time`` (positions against the time) or ``energy`` (the energy error). By default ``phase`` with one degree of freedom, else
            ``orbit``.
        ax : matplotlib Axes, optional
            Where to draw.

        Returns
        -------
        matplotlib Axes
        """
        from ._plots import plot_run

        return plot_run(self, kind, ax)

    def __repr__(self) -> str:
        largest = float(np.max(np.abs(self.energy_error)))
        label = "energy error" if self._problem.energy_is_conserved else "change of energy"
        name = self.method.name or "a method without a name"
        return f"<Run to t = {self.state[0]:g}: {name}, {self.statistics['steps']} steps of {self.step:g}, {len(self.t)} rows, {label} {largest:.1e}>"

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_problem"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
