"""Ends of runs with derivatives, for JAX and PyTorch."""

from __future__ import annotations

import doctest
import importlib
import sys
from typing import Any

import numpy as np
import pytest

import symplectica as sy

KEPLER = sy.system("{ mu: 1 } q: [2], p: [2]; H = |p|^2/2 - mu/|q|")
Q, P = np.array([0.4, 0.1]), np.array([0.2, 1.9])
RUN: dict[str, Any] = {"t": 1.5, "step": 0.05, "method": "gauss-2"}
#: Central differences with a step of 1e-5 have errors of 1e-10, multiplied by the third derivative of the orbit.
TOLERANCE = 1e-6


def ends(y: Any) -> Any:
    run = KEPLER.integrate(y[:2], y[2:], output=0, **RUN)
    return np.concatenate([run.q[-1], run.p[-1]])


def differences(y: Any) -> Any:
    """The Jacobian by central differences: of the steps, not of the orbit, which differs by 1e-4."""
    size = 1e-5
    return np.stack([(ends(y + size * one) - ends(y - size * one)) / (2 * size) for one in np.eye(len(y))], axis=1)


START = np.concatenate([Q, P])
JACOBIAN = differences(START)


def test_derivative_of_the_steps_differs_from_that_of_the_orbit() -> None:
    _, _, exact = KEPLER.state_transition(Q, P, t=1.5, step=0.005, method="gauss-8")
    assert abs(exact - JACOBIAN).max() > 20 * TOLERANCE


class TestJax:
    @pytest.fixture(autouse=True)
    def _doubles(self) -> Any:
        self.jax = pytest.importorskip("jax")
        self.jax.config.update("jax_enable_x64", True)
        self.jnp = pytest.importorskip("jax.numpy")
        from symplectica.jax import end_state

        self.end = end_state(KEPLER, **RUN)
        self.end_state = end_state

    def whole(self, y: Any) -> Any:
        return self.jnp.concatenate(self.end(y[:2], y[2:]))

    @pytest.mark.parametrize("compiled", [False, True])
    def test_value_is_that_of_the_run(self, compiled: bool) -> None:
        function = self.jax.jit(self.whole) if compiled else self.whole
        assert np.array_equal(function(START), ends(START))

    @pytest.mark.parametrize("compiled", [False, True])
    @pytest.mark.parametrize("mode", ["jacfwd", "jacrev"])
    def test_jacobian_is_that_of_differences(self, mode: str, compiled: bool) -> None:
        function = getattr(self.jax, mode)(self.whole)
        found = (self.jax.jit(function) if compiled else function)(self.jnp.array(START))
        assert np.allclose(found, JACOBIAN, rtol=0, atol=TOLERANCE)

    def test_jvp_and_vjp_are_transposed(self) -> None:
        tangent, cotangent = np.array([0.3, -0.2, 0.1, 0.5]), np.array([1.0, 2.0, -1.0, 0.5])
        _, forward = self.jax.jvp(self.whole, (self.jnp.array(START),), (self.jnp.array(tangent),))
        _, transposed = self.jax.vjp(self.whole, self.jnp.array(START))
        assert cotangent @ np.asarray(forward) == pytest.approx(tangent @ np.asarray(transposed(self.jnp.array(cotangent))[0]), rel=1e-13)
        assert np.allclose(forward, JACOBIAN @ tangent, rtol=0, atol=TOLERANCE)

    @pytest.mark.parametrize("first", ["jacfwd", "jacrev"])
    @pytest.mark.parametrize("second", ["jacfwd", "jacrev"])
    def test_second_derivative_is_refused(self, first: str, second: str) -> None:
        with pytest.raises(ValueError, match="do not support JVP"):
            getattr(self.jax, second)(getattr(self.jax, first)(lambda y: (self.whole(y) ** 2).sum()))(self.jnp.array(START))

    @pytest.mark.parametrize("compiled", [False, True])
    def test_vmap_of_value_and_gradient_is_that_of_each_start(self, compiled: bool) -> None:
        starts = START + 0.01 * np.arange(3)[:, None]

        def first(y: Any) -> Any:
            return self.whole(y)[0]

        values = self.jax.vmap(self.whole)
        gradients = self.jax.vmap(self.jax.grad(first))
        if compiled:
            values, gradients = self.jax.jit(values), self.jax.jit(gradients)
        assert np.array_equal(values(starts), [ends(one) for one in starts])
        assert np.allclose(gradients(self.jnp.array(starts)), [differences(one)[0] for one in starts], rtol=0, atol=TOLERANCE)

    def test_vmap_over_momenta_alone_repeats_the_positions(self) -> None:
        momenta = P + 0.01 * np.arange(3)[:, None]
        found = self.jax.vmap(self.end, in_axes=(None, 0))(Q, momenta)
        assert np.array_equal(found[0], [ends(np.concatenate([Q, p]))[:2] for p in momenta])

    def test_single_precision_gives_single_precision(self) -> None:
        q, p = self.end(self.jnp.array(Q, dtype="float32"), self.jnp.array(P, dtype="float32"))
        assert q.dtype == "float32" and np.allclose(q, ends(START)[:2], rtol=0, atol=1e-5)

    def test_whole_numbers_are_a_start(self) -> None:
        assert np.array_equal(self.end([1, 0], [0, 1])[0], ends(np.array([1.0, 0, 0, 1]))[:2])

    def test_parameters_and_start_time_are_used(self) -> None:
        end = self.end_state(KEPLER, 1.5, 0.05, t0=0.5, parameters={"mu": 2})
        run = KEPLER.integrate(Q, P, t=1.5, t0=0.5, step=0.05, parameters={"mu": 2})
        assert np.array_equal(end(Q, P)[0], run.q[-1])

    def test_states_of_vectors_keep_their_shape(self) -> None:
        bodies = sy.system("q: [2; 2], p: [2; 2]; H = sum(i: |p[i]|^2/2 + |q[i]|^4/4) + q[0]·q[1]")
        end = self.end_state(bodies, 1.0, 0.1)
        q, p = np.array([[1.0, 0.2], [0.1, 0.3]]), np.array([[0.1, 0.2], [0.3, 0.4]])
        found = self.jax.jacrev(lambda q: end(q, p)[0])(self.jnp.array(q))
        _, _, matrix = bodies.state_transition(q, p, t=1.0, step=0.1)
        assert found.shape == (2, 2, 2, 2) and np.allclose(found.reshape(4, 4), matrix[:4, :4], rtol=0, atol=1e-15)

    def test_shapes_that_differ_are_refused(self) -> None:
        with pytest.raises(sy.ArgumentError, match="must be the same"):
            self.end(Q, P[:1])


class TestTorch:
    @pytest.fixture(autouse=True)
    def _doubles(self) -> Any:
        self.torch = pytest.importorskip("torch")
        from symplectica.torch import end_state

        self.end = end_state(KEPLER, **RUN)
        self.end_state = end_state

    def whole(self, y: Any) -> Any:
        return self.torch.cat(self.end(y[:2], y[2:]))

    def start(self, requires_grad: bool = False) -> Any:
        return self.torch.tensor(START, requires_grad=requires_grad)

    def test_value_is_that_of_the_run(self) -> None:
        # The variational equations are integrated beside the state.
        assert np.allclose(self.whole(self.start()).numpy(), ends(START), rtol=0, atol=1e-14)

    def test_backward_gives_the_rows_of_the_jacobian(self) -> None:
        for row in range(4):
            start = self.start(requires_grad=True)
            self.whole(start)[row].backward()
            assert np.allclose(start.grad.numpy(), JACOBIAN[row], rtol=0, atol=TOLERANCE)

    @pytest.mark.parametrize("mode", ["jacfwd", "jacrev"])
    def test_jacobian_is_that_of_differences(self, mode: str) -> None:
        found = getattr(self.torch.func, mode)(self.whole)(self.start())
        assert np.allclose(found.numpy(), JACOBIAN, rtol=0, atol=TOLERANCE)

    def test_gradcheck_of_pytorch_passes(self) -> None:
        assert self.torch.autograd.gradcheck(self.whole, self.start(requires_grad=True), eps=1e-5, atol=TOLERANCE, rtol=0, check_forward_ad=True)

    def test_vmap_of_value_and_gradient_is_that_of_each_start(self) -> None:
        starts = START + 0.01 * np.arange(3)[:, None]
        values = self.torch.func.vmap(self.whole)(self.torch.tensor(starts))
        gradients = self.torch.func.vmap(self.torch.func.grad(lambda y: self.whole(y)[0]))(self.torch.tensor(starts))
        assert np.allclose(values.numpy(), [ends(one) for one in starts], rtol=0, atol=1e-14)
        assert np.allclose(gradients.numpy(), [differences(one)[0] for one in starts], rtol=0, atol=TOLERANCE)

    def test_vmap_over_momenta_alone_repeats_the_positions(self) -> None:
        momenta = P + 0.01 * np.arange(3)[:, None]
        found = self.torch.func.vmap(self.end, in_dims=(None, 1))(self.torch.tensor(Q), self.torch.tensor(momenta.T))
        assert np.allclose(found[0].numpy(), [ends(np.concatenate([Q, p]))[:2] for p in momenta], rtol=0, atol=1e-14)

    def test_single_precision_gives_single_precision(self) -> None:
        q, _ = self.end(self.torch.tensor(Q).float(), self.torch.tensor(P).float())
        assert q.dtype == self.torch.float32 and np.allclose(q.numpy(), ends(START)[:2], rtol=0, atol=1e-5)

    def test_second_derivative_by_backward_is_refused(self) -> None:
        start = self.start(requires_grad=True)
        # Without its part in M the second derivative of a square would be wrong, not absent.
        (gradient,) = self.torch.autograd.grad(self.whole(start)[0] ** 2, start, create_graph=True)
        with pytest.raises(RuntimeError, match="first derivatives only"):
            gradient.sum().backward()

    @pytest.mark.parametrize("first", ["jacfwd", "jacrev"])
    @pytest.mark.parametrize("second", ["jacfwd", "jacrev"])
    def test_second_derivative_by_transforms_is_refused(self, first: str, second: str) -> None:
        func = self.torch.func
        with pytest.raises(RuntimeError, match="first derivatives only"):
            getattr(func, second)(getattr(func, first)(lambda y: (self.whole(y) ** 2).sum()))(self.start())

    @pytest.mark.parametrize("other", [P[:1], P.astype(np.float32), [0.0, 1.0]])
    def test_start_that_does_not_fit_is_refused(self, other: Any) -> None:
        with pytest.raises(sy.ArgumentError):
            self.end(self.torch.tensor(Q), self.torch.from_numpy(other) if isinstance(other, np.ndarray) else other)


@pytest.mark.parametrize("package", ["jax", "torch"])
def test_example_of_the_module_runs(package: str) -> None:
    pytest.importorskip(package)
    results = doctest.testmod(importlib.import_module(f"symplectica.{package}"))
    assert results.attempted > 0 and results.failed == 0


@pytest.mark.parametrize("package", ["jax", "torch"])
def test_step_that_fails_is_an_error(package: str) -> None:
    pytest.importorskip(package)
    steep = sy.system("q: [y], p: [py]; H = py^2/2 + exp(y)")
    end = importlib.import_module(f"symplectica.{package}").end_state(steep, -200.0, 50.0)
    start = np.zeros(1) if package == "jax" else importlib.import_module("torch").zeros(1)
    with pytest.raises(Exception, match="did not converge"):
        end(start, start)


@pytest.mark.parametrize("package", ["jax", "torch"])
@pytest.mark.parametrize(
    ("keywords", "words"), [({"method": "gaus-4"}, "unknown method"), ({"parameters": {"G": 1}}, "no parameter `G`"), ({"t0": np.nan}, "not finite")]
)
def test_argument_that_does_not_fit_is_refused_before_a_run(package: str, keywords: dict[str, Any], words: str) -> None:
    pytest.importorskip(package)
    with pytest.raises(sy.SymplecticError, match=words):
        importlib.import_module(f"symplectica.{package}").end_state(KEPLER, 1.0, 0.1, **keywords)


@pytest.mark.parametrize(("package", "words"), [("jax", "pip install jax"), ("torch", "pip install torch")])
def test_package_that_is_not_installed_is_named(package: str, words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    module = importlib.import_module(f"symplectica.{package}")
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=words):
        module.end_state(KEPLER, 1.0, 0.1)


@pytest.mark.parametrize("package", ["jax", "torch"])
def test_system_of_another_type_is_refused(package: str) -> None:
    pytest.importorskip(package)
    with pytest.raises(sy.ArgumentError, match="expected a System"):
        importlib.import_module(f"symplectica.{package}").end_state("q: [x], p: [px]; H = px^2", 1.0, 0.1)
