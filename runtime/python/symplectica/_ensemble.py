"""Many trajectories."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._arrays import Array
from ._errors import ArgumentError
from ._events import States
from ._files import parameter_facts, save
from ._tableau import Doubles, Tableau

if TYPE_CHECKING:
    from ._system import System


@dataclass(frozen=True)
class Failure:
    """A trajectory that failed.

    Attributes
    ----------
    trajectory : int
        Its number.
    message : str
        Why.
    kind : str
        As in :class:`StepError`.
    """

    trajectory: int
    message: str
    kind: str


@dataclass(frozen=True, eq=False)
class Ensemble:
    """Many trajectories.

    Attributes
    ----------
    t : ndarray
        With `output` its times, shape (m,); otherwise the times of the last states, shape (n,).
    q, p : ndarray
        With `output` shape (n, m, …), where a time that was not reached has NaN; otherwise the last states, shape (n, …).
    end : States
        The last states, shape (n, …), also of trajectories that failed.
    section : list of States or None
        The states of the section, for each trajectory.
    megno, lyapunov : ndarray or None
        Mean MEGNO and largest Lyapunov exponent, shape (n,). A MEGNO near 2 is regular; it grows with the time for chaos.
    failures : list of Failure
        The trajectories that failed.
    statistics : dict of ndarray
        Counts of each trajectory.
    system, method, step
        What was integrated.
    """

    t: Array
    q: Array
    p: Array
    end: States
    section: list[States] | None
    megno: Array | None
    lyapunov: Array | None
    failures: list[Failure]
    statistics: dict[str, npt.NDArray[np.uint64]]
    system: System
    method: Tableau | Doubles
    step: float
    _starts: tuple[float, Array, Array, Array] = field(repr=False)
    _same: dict[str, Array] = field(repr=False)
    _varied: dict[str, Array] = field(repr=False)

    @classmethod
    def _of(
        cls,
        system: System,
        method: Any,
        shape: tuple[int, ...],
        start: float,
        setting: dict[str, Any],
        base: tuple[Any, ...],
        names: list[str],
        same: dict[str, Array],
        varied: dict[str, Array],
        found: dict[str, Any],
    ) -> Ensemble:
        def shaped(rows: Array) -> Array:
            return rows.reshape(rows.shape[:-1] + shape)

        end = States(found["end_t"], shaped(found["end_q"]), shaped(found["end_p"]))
        section = None
        if "counts" in found:
            ends = np.cumsum(found["counts"].astype(np.int64))
            parts = [States(t, shaped(q), shaped(p)) for t, q, p in zip(*(np.split(found[key], ends[:-1]) for key in ("event_t", "event_q", "event_p")), strict=True)]
            section = parts
        _, _, _, _, q0, p0, table = base
        has_output = "q" in found
        # An interrupted run has fewer trajectories.
        rows = len(end)
        return cls(
            found["t"] if has_output else end.t,
            shaped(found["q"][:rows]) if has_output else end.q,
            shaped(found["p"][:rows]) if has_output else end.p,
            end,
            section,
            found.get("megno"),
            found.get("lyapunov"),
            [Failure(*failure) for failure in found["failures"]],
            found["statistics"],
            system,
            method,
            setting["step"],
            (start, q0, p0, table),
            same,
            varied,
        )

    def __len__(self) -> int:
        return len(self.end.t)

    @cached_property
    def failed(self) -> npt.NDArray[np.bool_]:
        """Which trajectories failed, shape (n,)."""
        failed = np.zeros(len(self), dtype=bool)
        failed[[failure.trajectory for failure in self.failures]] = True
        return failed

    @cached_property
    def _problem(self) -> Any:
        return self.system._problem(self._starts[1].shape[1], self._starts[0], self._same, self._varied)

    def _energies(self, t: Array, q: Array, p: Array, repeat: int) -> Array:
        dimension = self._starts[1].shape[1]
        table = np.ascontiguousarray(np.repeat(self._starts[3][: len(self)], repeat, axis=0))
        rows = (np.ascontiguousarray(half.reshape(-1, dimension)) for half in (q, p))
        energies: Array = self._problem.energies(np.ascontiguousarray(t), *rows, table)
        return energies

    @cached_property
    def energy_error(self) -> Array:
        """(H − H₀)/\\|H₀\\| of the states in `q` and `p`, shape (n, m) with `output`, otherwise (n,)."""
        start, q0, p0, table = self._starts
        count = len(self)
        q0, p0 = q0[:count], p0[:count]
        first = self._energies(np.full(count, start), q0, p0, 1)
        unit = np.array([self._problem.energy_unit(start, q, p, own) for q, p, own in zip(q0.tolist(), p0.tolist(), table[:count].tolist(), strict=True)])
        if self.q is self.end.q:
            return np.asarray((self._energies(self.t, self.q, self.p, 1) - first) / unit)
        times = len(self.t)
        found = self._energies(np.tile(self.t, count), self.q[:count], self.p[:count], times)
        return np.asarray((found.reshape(count, times) - first[:, None]) / unit[:, None])

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each trajectory, or for each trajectory and time."""
        import pandas

        dimension = self._starts[1].shape[1]
        positions, momenta = self.system._native.names(dimension)
        times = self.q.shape[1] if self.q is not self.end.q else 1
        table = pandas.DataFrame(
            np.hstack([self.q.reshape(-1, dimension), self.p.reshape(-1, dimension)]), columns=[*positions, *momenta]
        )
        count = self.q.shape[0]
        table.insert(0, "trajectory", np.repeat(np.arange(count), times))
        table.insert(1, "t", self.t if self.q is self.end.q else np.tile(self.t, count))
        if self.megno is not None:
            table["megno"], table["lyapunov"] = self.megno, self.lyapunov
        return table

    def save(self, path: str | Path) -> None:
        """Writes the arrays, the formula and the method to a file.

        Parameters
        ----------
        path : str or Path
            A name that ends in ``.npz`` (NumPy), ``.h5`` (HDF5, with h5py), ``.parquet`` or ``.csv`` (a table, with pandas).
        """
        arrays: dict[str, Any] = {"t": self.t, "q": self.q, "p": self.p, "failed": self.failed}
        if self.megno is not None and self.lyapunov is not None:
            arrays |= {"megno": self.megno, "lyapunov": self.lyapunov}
        if self.section is not None:
            arrays["section_count"] = np.array([len(states) for states in self.section])
            for key in ("t", "q", "p"):
                arrays[f"section_{key}"] = np.concatenate([getattr(states, key) for states in self.section])
        facts = {"formula": self.system.text, "method": self.method.name or "", "step": self.step, **parameter_facts({**self._same, **self._varied})}
        save(path, arrays, facts, self.to_pandas)

    def plot(self, x: str | None = None, y: str | None = None, ax: Any = None) -> Any:
        """A picture with matplotlib: the section, or the last states, in the plane of two coordinates.

        Parameters
        ----------
        x, y : str, optional
            Names of coordinates; by default the first position and its momentum.
        ax : matplotlib Axes, optional
            Where to draw.
        """
        from ._plots import plot_ensemble

        return plot_ensemble(self, x, y, ax)

    def coordinate(self, name: str, states: States | None = None) -> Array:
        """A coordinate of states by its name; of the last ones if `states` is not given."""
        dimension = self._starts[1].shape[1]
        positions, momenta = self.system._native.names(dimension)
        chosen = self.end if states is None else states
        for names, half in ((positions, chosen.q), (momenta, chosen.p)):
            if name in names:
                return half.reshape(-1, dimension)[:, names.index(name)]
        raise ArgumentError(f"there is no coordinate `{name}`; the coordinates are {', '.join([*positions, *momenta][:20])}")

    def __repr__(self) -> str:
        name = self.method.name or "a method without a name"
        return f"<Ensemble of {len(self)} trajectories: {name}, steps of {self.step:g}, {len(self.failures)} failed>"

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_problem"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
