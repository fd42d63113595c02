"""Systems of Python functions."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import symplectica as sy
from symplectica import python_function
from symplectica._function import PythonFunction

KEPLER = "q: [2], p: [2]; H = |p|^2/2 - 1/|q|"
START = [0.4, 0.0], [0.0, 2.0]
#: A splitting has a lower order if H is not separable.
ACCEPTED: dict[str, Any] = {"accept_lower_order": True}


def kepler(separable: bool) -> PythonFunction:
    return python_function(
        lambda t, q, p: p,
        lambda t, q, p: -q / np.sqrt(q @ q) ** 3,
        lambda t, q, p: p @ p / 2 - 1 / np.sqrt(q @ q),
        separable=separable,
    )


@pytest.mark.parametrize("method", ["gauss-4", "lobatto-3", "stormer-verlet", "ruth-1983", "blanes-moan-2002-s10", "symplectic-euler"])
@pytest.mark.parametrize("separable", [True, False])
def test_kepler_orbit_is_that_of_the_formula(method: str, separable: bool) -> None:
    run = kepler(separable).integrate(*START, t=2, step=0.01, method=method)
    other = sy.system(KEPLER).integrate(*START, t=2, step=0.01, method=method)
    # Both have the same discrete orbit; 200 steps of different roundings.
    assert np.allclose(run.q[-1], other.q[-1], rtol=0, atol=1e-12)
    assert np.allclose(run.p[-1], other.p[-1], rtol=0, atol=1e-12)
    assert run.q.shape == (201, 2) and run.t[-1] == 2


def test_splitting_of_a_separable_system_is_explicit() -> None:
    explicit, iterated = (kepler(separable).integrate(*START, t=1, step=0.01, method="stormer-verlet") for separable in (True, False))
    assert explicit.statistics["iterations"] == 0
    assert iterated.statistics["iterations"] > 100
    assert explicit.statistics["evaluations"] <= 4 * 100 < iterated.statistics["evaluations"]


def test_energy_error_is_that_of_the_formula() -> None:
    run = kepler(True).integrate(*START, t=5, step=0.05, method="stormer-verlet")
    other = sy.system(KEPLER).integrate(*START, t=5, step=0.05, method="stormer-verlet")
    assert run.energy_error is not None
    assert np.allclose(run.energy_error, other.energy_error, rtol=0, atol=1e-12)
    assert abs(run.energy_error).max() > 1e-4


def test_run_without_an_energy_has_no_energy_error() -> None:
    assert python_function(lambda t, q, p: p, lambda t, q, p: -q).integrate([1.0], [0.0], t=1, step=0.1).energy_error is None


def test_system_that_is_not_separable_agrees_with_the_formula() -> None:
    system = python_function(lambda t, q, p: p * (1 + q**2), lambda t, q, p: -q * (1 + p**2))
    text = sy.system("q: [x], p: [px]; H = (1 + x^2) (1 + px^2)/2")
    for method in ("gauss-2", "stormer-verlet", "symplectic-euler"):
        run, other = (one.integrate([1.0], [0.2], t=3, step=0.05, method=method, **more) for one, more in ((system, {}), (text, ACCEPTED)))
        assert np.allclose(run.q[-1], other.q[-1], rtol=0, atol=1e-13)


def test_time_in_a_force_is_that_of_the_formula() -> None:
    system = python_function(lambda t, q, p: p, lambda t, q, p: -q + np.cos(3 * t), separable=True)
    text = sy.system("q: [x], p: [px]; H = px^2/2 + x^2/2 - x cos(3 t)")
    for method in ("stormer-verlet", "gauss-2"):
        run, other = (one.integrate([1.0], [0.2], t=3, t0=1, step=0.1, method=method) for one in (system, text))
        assert np.allclose(run.q[-1], other.q[-1], rtol=0, atol=1e-13)


def test_units_of_positions_and_momenta_may_differ() -> None:
    mass = 1e-8
    system = python_function(lambda t, q, p: p / mass, lambda t, q, p: -mass * q)
    run = system.integrate([1.0], [0.0], t=1, step=0.1)
    assert run.p[-1] / mass == pytest.approx(-np.sin(1), rel=1e-12)


def test_small_positions_beside_large_momenta_converge() -> None:
    # One step of the midpoint rule on q' = q: its factor is (1 + h/2)/(1 − h/2).
    system = python_function(lambda t, q, p: q, lambda t, q, p: 0 * p)
    run = system.integrate([1e-12], [1.0], t=0.1, step=0.1, method="gauss-1")
    assert run.q[-1, 0] == pytest.approx(1e-12 * 1.05 / 0.95, rel=1e-14, abs=0)


def test_sums_are_compensated() -> None:
    system = python_function(lambda t, q, p: p, lambda t, q, p: 0 * q, separable=True)
    run = system.integrate([0.0], [0.1], t=1000, step=0.1, method="stormer-verlet")
    # Plain sums of 10⁴ steps have an error of 10⁻¹² here.
    assert run.q[-1, 0] == pytest.approx(100, rel=4e-16)


def test_backward_run_returns_to_the_start() -> None:
    there = kepler(False).integrate(*START, t=1, step=0.01)
    back = kepler(False).integrate(there.q[-1], there.p[-1], t0=1, t=0, step=0.01)
    assert np.allclose(back.q[-1], START[0], rtol=0, atol=1e-13) and back.t[-1] == 0


def test_shape_of_the_start_is_that_of_the_arrays() -> None:
    seen = set()

    def velocity(t: float, q: Any, p: Any) -> Any:
        seen.add((q.shape, p.shape))
        return p

    run = python_function(velocity, lambda t, q, p: -q).integrate(np.ones((3, 2)), np.zeros((3, 2)), t=1, step=0.1)
    assert seen == {((3, 2), (3, 2))} and run.q.shape == (11, 3, 2)


def test_separable_system_that_is_not_separable_is_refused() -> None:
    system = python_function(lambda t, q, p: p * q, lambda t, q, p: -q, separable=True)
    with pytest.raises(sy.StepError, match="the velocity must not use `q`") as error:
        system.integrate([1.0], [1.0], t=1, step=0.1, method="stormer-verlet")
    assert (error.value.kind, error.value.step) == ("not finite", 1)


def test_stages_that_do_not_converge_are_refused() -> None:
    system = python_function(lambda t, q, p: p, lambda t, q, p: -1e4 * q)
    with pytest.raises(sy.StepError) as error:
        system.integrate([1.0], [0.0], t=10, step=1.0)
    assert (error.value.kind, error.value.step, error.value.time) == ("no convergence", 1, 0.0)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"q": [1.0], "p": [0.0, 1.0]}, "must be the same"),
        ({"q": [], "p": []}, "not empty"),
        ({"q": [1.0], "p": [1.0], "step": 0}, "must be positive"),
    ],
)
def test_argument_that_does_not_fit_is_refused(arguments: dict[str, Any], words: str) -> None:
    with pytest.raises(sy.ArgumentError, match=words):
        kepler(False).integrate(**{"t": 1, "step": 0.1, **arguments})


def test_shape_that_a_function_returns_is_checked() -> None:
    with pytest.raises(sy.ArgumentError, match="`force` returned the shape"):
        python_function(lambda t, q, p: p, lambda t, q, p: 1.0).integrate([1.0, 2.0], [0.0, 0.0], t=1, step=0.1)
