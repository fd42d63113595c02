"""From and to simulations of REBOUND.

::

    H = Σ_i |p_i|²/(2 m_i) − G Σ_{i<j} m_i m_j/√(|q_i − q_j|² + ε²)      p_i = m_i v_i

>>> import rebound
>>> import symplectica.rebound
>>> simulation = rebound.Simulation()
>>> simulation.add(m=1)
>>> simulation.add(m=1e-3, a=1, e=0.1)
>>> system, q, p = symplectica.rebound.from_simulation(simulation)
>>> run = system.integrate(q, p, t=10, step=0.05, method="gauss-8")
>>> end = symplectica.rebound.to_simulation(run)
>>> end.t, bool(abs(end.energy() / simulation.energy() - 1) < 1e-13)
(10.0, True)
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _arrays
from ._arrays import Array
from ._errors import ArgumentError
from ._system import System

if TYPE_CHECKING:
    from ._run import Run

__all__ = ["from_simulation", "to_simulation"]

_KINETIC = "sum(i: |p[i]|^2/(2 m[i]))"
_PLAIN = f"NBody<N> {{ m: [N], G }}\nq: [N; 3], p: [N; 3];\nH = {_KINETIC} - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)"
_SOFTENED = (
    f"NBody<N> {{ m: [N], G, softening }}\nq: [N; 3], p: [N; 3];\nH = {_KINETIC} - sum(i < j: G m[i] m[j]/sqrt(|q[i] - q[j]|^2 + softening^2))"
)


def _rebound() -> Any:
    try:
        import rebound
    except ImportError:
        raise ImportError("simulations of REBOUND need it: `pip install rebound`") from None
    return rebound


def from_simulation(simulation: Any, *, softening: float | None = None) -> tuple[System, Array, Array]:
    """The system of the bodies of a simulation, and its state.

    Parameters
    ----------
    simulation : rebound.Simulation
        Its bodies have masses. It is not changed. Additional forces in Python or of REBOUNDx are not known here and not part of the system.
    softening : float, optional
        The softening length ε; by default that of the simulation.

    Returns
    -------
    system : System
        With the parameters ``m``, ``G`` and, if it is not zero, ``softening``.
    q, p : ndarray, shape (N, 3)
        Positions and momenta. The time is ``simulation.t``: give ``t0=simulation.t`` if it is not 0.

    Raises
    ------
    ArgumentError
        For bodies without mass, test particles, collisions, a boundary, or a simulation without gravity.
    ImportError
        If REBOUND is not installed.
    """
    if not isinstance(simulation, _rebound().Simulation):
        raise ArgumentError(f"found {type(simulation).__name__}, expected a rebound.Simulation")
    for key, reason in (("collision", "collisions"), ("boundary", "a boundary")):
        if getattr(simulation, key) != "none":
            raise ArgumentError(f"the simulation has {reason}, `{key} = {getattr(simulation, key)!r}`: set it to 'none' to integrate the bodies without")
    if simulation.gravity == "none":
        raise ArgumentError("the simulation has no gravity, so it has no Hamiltonian of bodies")
    count = int(simulation.N)
    if int(simulation.N_active) < count:
        raise ArgumentError(f"the bodies from number {simulation.N_active} are test particles: integrate the others as bodies, and leave these out")
    if not simulation.is_synchronized:
        with warnings.catch_warnings():
            # The copy has no functions of the user.
            warnings.simplefilter("ignore", RuntimeWarning)
            simulation = simulation.copy()
        simulation.synchronize()
    bodies = [simulation.particles[k] for k in range(count)]
    m = np.array([body.m for body in bodies])
    if count == 0 or (m <= 0).any():
        which = f"body {int(np.flatnonzero(m <= 0)[0])} has no mass" if count else "the simulation has no bodies"
        raise ArgumentError(f"{which}: a Hamiltonian of bodies needs positive masses")
    q = np.array([[body.x, body.y, body.z] for body in bodies])
    p = m[:, None] * np.array([[body.vx, body.vy, body.vz] for body in bodies])
    length = _arrays.number(simulation.softening if softening is None else softening, "softening")
    parameters = {"m": m, "G": simulation.G}
    if length == 0:
        return System(_PLAIN, parameters), q, p
    return System(_SOFTENED, {**parameters, "softening": length}), q, p


def to_simulation(run: Run, index: int = -1) -> Any:
    """A simulation of the bodies of a run.

    Parameters
    ----------
    run : Run
        A run of a system from :func:`from_simulation`.
    index : int
        Which of the states of the run.

    Returns
    -------
    rebound.Simulation
        With the masses, G, the softening length, the time and the state; everything else as in a new simulation.

    Raises
    ------
    ArgumentError
        If the system is not one of bodies, or the run has no such state.
    ImportError
        If REBOUND is not installed.
    """
    rebound = _rebound()
    parameters = run.system.parameters
    if run.system.text not in (_PLAIN, _SOFTENED) or "m" not in parameters or "G" not in parameters:
        raise ArgumentError("the run is not that of a system from `from_simulation`")
    if not -len(run.t) <= index < len(run.t):
        raise ArgumentError(f"the run has {len(run.t)} states; there is no state {index}")
    simulation = rebound.Simulation()
    simulation.G = float(parameters["G"])
    simulation.softening = float(parameters.get("softening", 0.0))
    simulation.t = float(run.t[index])
    for m, q, p in zip(parameters["m"].tolist(), run.q[index].reshape(-1, 3), run.p[index].reshape(-1, 3), strict=True):
        x, y, z = q.tolist()
        vx, vy, vz = (p / m).tolist()
        simulation.add(m=m, x=x, y=y, z=z, vx=vx, vy=vy, vz=vz)
    return simulation
