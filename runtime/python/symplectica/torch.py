"""Runs as functions of PyTorch: differentiable, also with the transforms of ``torch.func``.

>>> import torch
>>> import symplectica
>>> import symplectica.torch
>>> oscillator = symplectica.system("q: [x], p: [px]; H = px^2/2 + x^2/2")
>>> end = symplectica.torch.end_state(oscillator, t=1.0, step=0.1)
>>> q = torch.tensor([1.0], dtype=torch.float64, requires_grad=True)
>>> end(q, torch.zeros_like(q))[0].sum().backward()
>>> bool(torch.isclose(q.grad, torch.cos(torch.ones_like(q))))
True
"""

# mypy: disallow-subclassing-any=False

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ._arrays import number
from ._end import End
from ._errors import ArgumentError
from ._system import Method, System

__all__ = ["end_state"]

_FIRST_ONLY = "the end of a run has first derivatives only: no second ones, as in `hessian`"


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
        ``(q, p) -> (q, p)``, tensors of the same shape. Each call computes M: for ends without derivatives take :meth:`System.integrate`. Runs
        have double precision and are on the CPU; the results have the type and the device of the start.

    Raises
    ------
    ImportError
        If PyTorch is not installed.
    ArgumentError
        For an argument that does not fit.
    """
    try:
        import torch
    except ImportError:
        raise ImportError("`symplectica.torch` needs PyTorch: `pip install torch`") from None

    made = End(system, number(t, "t"), number(step, "step"), method, number(t0, "t0"), parameters)

    def computed(q: Any, p: Any, batch: int) -> tuple[Any, ...]:
        starts = [half.detach().cpu().double().numpy() for half in (q, p)]
        return tuple(torch.from_numpy(array).to(q) for array in made.transitions(starts[0], starts[1], batch))

    class _Once(torch.autograd.Function):
        """M as a first derivative uses it: its own derivative, which a second one needs, is an error."""

        @staticmethod
        def forward(matrix: Any) -> Any:
            return matrix.clone()

        @staticmethod
        def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
            pass

        @staticmethod
        def backward(ctx: Any, _: Any) -> Any:
            raise RuntimeError(_FIRST_ONLY)

        jvp = backward

        @staticmethod
        def vmap(info: Any, axes: Any, matrix: Any) -> Any:
            return _Once.apply(matrix), axes[0]

    class _EndState(torch.autograd.Function):
        """The end and M, which backward passes use."""

        @staticmethod
        def forward(q: Any, p: Any, batch: int) -> Any:
            return computed(q, p, batch)

        @staticmethod
        def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
            ctx.batch = inputs[2]
            ctx.save_for_backward(output[2])
            ctx.save_for_forward(output[2])

        @staticmethod
        def backward(ctx: Any, of_q: Any, of_p: Any, _: Any) -> Any:
            moved = _flat(of_q, of_p, ctx.batch).unsqueeze(-2) @ _Once.apply(*ctx.saved_tensors)
            return *_halves(moved.squeeze(-2), of_q.shape), None

        @staticmethod
        def jvp(ctx: Any, of_q: Any, of_p: Any, _: Any) -> Any:
            (matrix,) = ctx.saved_tensors
            moved = _Once.apply(matrix) @ _flat(of_q, of_p, ctx.batch).unsqueeze(-1)
            return *_halves(moved.squeeze(-1), of_q.shape), torch.zeros_like(matrix)

        @staticmethod
        def vmap(info: Any, axes: Any, q: Any, p: Any, batch: int) -> Any:
            q, p = (
                half.expand(info.batch_size, *half.shape) if axis is None else half.movedim(axis, 0) for half, axis in zip((q, p), axes, strict=False)
            )
            return _EndState.apply(q, p, batch + 1), (0, 0, 0)

    def _flat(q: Any, p: Any, batch: int) -> Any:
        """(q, p) as one vector, after the axes of the batch."""
        return torch.cat([half.reshape(*half.shape[:batch], -1) for half in (q, p)], dim=-1)

    def _halves(moved: Any, shape: Any) -> tuple[Any, Any]:
        first, second = moved.chunk(2, dim=-1)
        return first.reshape(shape), second.reshape(shape)

    def function(q: Any, p: Any) -> tuple[Any, Any]:
        """The state at the end."""
        if not isinstance(q, torch.Tensor) or not isinstance(p, torch.Tensor):
            raise ArgumentError("`q` and `p` must be tensors")
        if q.shape != p.shape:
            raise ArgumentError(f"`q` has the shape {tuple(q.shape)} and `p` the shape {tuple(p.shape)}: they must be the same")
        if not q.is_floating_point() or q.dtype != p.dtype:
            raise ArgumentError(f"`q` and `p` must have the same floating type; found {q.dtype} and {p.dtype}")
        end, momentum, _ = _EndState.apply(q, p, 0)
        return end, momentum

    return function
