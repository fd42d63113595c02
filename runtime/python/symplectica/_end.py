"""The end of a run as a function of its start, with its derivative: what ``symplectica.jax`` and ``symplectica.torch`` wrap."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _arrays
from ._arrays import Array
from ._errors import ArgumentError, StepError
from ._system import Method, System
from ._tableau import method as method_of


@dataclass(frozen=True)
class End:
    """The end of runs from `t0` to `t`; starts have any number of batch axes before the axes of a state."""

    system: System
    t: float
    step: float
    method: Method | None
    t0: float
    parameters: Mapping[str, Any] | None

    def __post_init__(self) -> None:
        if not isinstance(self.system, System):
            raise ArgumentError(f"found {type(self.system).__name__}, expected a System")
        # Inside JAX an error has another type.
        _arrays.check_names(self.parameters or {}, self.system._native.parameters)
        if self.method is not None:
            method_of(self.method)

    @property
    def _run(self) -> dict[str, Any]:
        return {"t": self.t, "t0": self.t0, "step": self.step, "method": self.method, "parameters": self.parameters}

    def states(self, q: Any, p: Any, batch: int) -> tuple[Array, Array]:
        """The ends; the first `batch` axes are those of a batch, which runs as an ensemble."""
        q, p = _arrays.numbers(q, "q"), _arrays.numbers(p, "p")
        if batch == 0:
            run = self.system.integrate(q, p, output=0, **self._run)
            return run.q[-1], run.p[-1]
        shape, own = q.shape, q.shape[batch:]
        if q.size == 0:
            return q, p
        found = self.system.ensemble(q.reshape(-1, *own), p.reshape(-1, *own), **self._run)
        if found.failures:
            raise StepError(f"trajectory {found.failures[0].trajectory}: {found.failures[0].message}", kind=found.failures[0].kind)
        return found.q.reshape(shape), found.p.reshape(shape)

    def transitions(self, q: Any, p: Any, batch: int) -> tuple[Array, Array, Array]:
        """The ends, and ∂(q, p)(t)/∂(q, p)(t0) of shape (2d, 2d) after the axes of the batch."""
        q, p = _arrays.numbers(q, "q"), _arrays.numbers(p, "p")
        shape, axes, own = q.shape, q.shape[:batch], q.shape[batch:]
        size = 2 * int(np.prod(own))
        rows = [
            self.system.state_transition(*start, **self._run) for start in zip(q.reshape(-1, *own), p.reshape(-1, *own), strict=True)
        ]
        ends, momenta, matrices = (np.array([row[k] for row in rows]) for k in range(3))
        return ends.reshape(shape), momenta.reshape(shape), matrices.reshape(*axes, size, size)
