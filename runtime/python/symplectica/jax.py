"""Runs as functions of JAX: differentiable, under ``jit`` and ``vmap``.

>>> import jax
>>> import jax.numpy as jnp
>>> import symplectica
>>> import symplectica.jax
>>> jax.config.update("jax_enable_x64", True)
>>> oscillator = symplectica.system("q: [x], p: [px]; H = px^2/2 + x^2/2")
>>> end = symplectica.jax.end_state(oscillator, t=1.0, step=0.1)
>>> gradient = jax.jit(jax.grad(lambda q, p: end(q, p)[0][0]))
>>> bool(jnp.allclose(gradient(jnp.array([1.0]), jnp.array([0.0])), jnp.cos(1.0)))
True
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ._arrays import number
from ._end import End
from ._errors import ArgumentError
from ._system import Method, System

__all__ = ["end_state"]


def end_state(
    system: System,
    t: float,
    step: float,
    method: Method | None = None,
    *,
    t0: float = 0.0,
    parameters: Mapping[str, Any] | None = None,
) -> Callable[[Any, Any], tuple[Any, Any]]:
    """The end of a run as a function of its start.

    Its derivative is that of the discrete steps, M = ∂(q, p)(t)/∂(q, p)(t0), from the variational equations of the method
    (:meth:`System.state_transition`): forward mode computes M(δq, δp), reverse mode Mᵀ(λ, μ). First derivatives only.

    Parameters
    ----------
    system : System
        The system.
    t, step, method, t0, parameters
        As for :meth:`System.integrate`.

    Returns
    -------
    function
        ``(q, p) -> (q, p)``, arrays of the same shape. Under ``vmap`` the starts run as an ensemble; their derivatives one after the other. Runs
        have double precision; the results have the precision of the start, so switch on ``jax_enable_x64``. Runs are on the CPU. A failed step
        is an error of the callback.

    Raises
    ------
    ImportError
        If JAX is not installed.
    ArgumentError
        For an argument that does not fit.
    """
    try:
        import jax
        import jax.numpy as jnp
    except ImportError:
        raise ImportError("`symplectica.jax` needs JAX: `pip install jax`") from None

    kind: Any = jax.ShapeDtypeStruct
    made = End(system, number(t, "t"), number(step, "step"), method, number(t0, "t0"), parameters)

    def called(host: Callable[..., tuple[Any, ...]], q: Any, p: Any, shapes: list[tuple[int, ...]]) -> Any:
        """Calls the host; under ``vmap`` its arrays have the axes of the batch first."""

        def on_host(q: Any, p: Any) -> tuple[Any, ...]:
            q, p = np.asarray(q), np.asarray(p)
            results = host(q, p, q.ndim - len(shapes[0]))
            return tuple(result.astype(q.dtype) for result in results)

        return jax.pure_callback(on_host, tuple(kind(shape, q.dtype) for shape in shapes), q, p, vmap_method="broadcast_all")

    @jax.custom_jvp
    def end(q: Any, p: Any) -> Any:
        return called(made.states, q, p, [q.shape, p.shape])

    @end.defjvp
    def _(starts: Any, tangents: Any) -> Any:
        q, p = starts
        size = 2 * q.size
        q1, p1, matrix = called(made.transitions, q, p, [q.shape, p.shape, (size, size)])
        moved = matrix @ jnp.concatenate([jnp.ravel(tangent) for tangent in tangents])
        return (q1, p1), (moved[: q.size].reshape(q.shape), moved[q.size :].reshape(p.shape))

    def function(q: Any, p: Any) -> tuple[Any, Any]:
        """The state at the end."""
        q, p = jnp.asarray(q), jnp.asarray(p)
        if q.shape != p.shape:
            raise ArgumentError(f"`q` has the shape {q.shape} and `p` the shape {p.shape}: they must be the same")
        precision = jnp.result_type(q, p, 0.0)
        found: tuple[Any, Any] = end(q.astype(precision), p.astype(precision))
        return found

    return function
