"""Methods of nodepy and SciPy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import symplectica as sy

KEPLER = sy.system("q: [2], p: [2]; H = |p|^2/2 - 1/|q|")
START: tuple[Any, Any] = ([0.4, 0.0], [0.0, 2.0])


@pytest.fixture
def nodepy_methods() -> Any:
    pytest.importorskip("nodepy")
    from nodepy import rk

    return rk.loadRKM()


@pytest.mark.parametrize(("name", "stages"), [("GL2", 2), ("GL3", 3)])
def test_gauss_method_of_nodepy_is_that_of_the_catalogue_without_proofs(nodepy_methods: Any, name: str, stages: int) -> None:
    method, own = sy.method(nodepy_methods[name]), sy.method(f"gauss-{stages}")
    assert isinstance(method, sy.Doubles) and isinstance(own, sy.Tableau)
    assert not method.proved and method.name == name
    assert method.order() == own.order() == 2 * stages
    # nodepy evaluates its exact numbers; ours are correctly rounded.
    assert np.allclose(method.a, own.a, rtol=4e-16, atol=1e-16) and np.allclose(method.b, own.b, rtol=4e-16)


def test_run_with_a_gauss_method_of_nodepy_is_that_with_our_own(nodepy_methods: Any) -> None:
    runs = [KEPLER.integrate(*START, t=2, step=0.01, method=method) for method in (nodepy_methods["GL3"], "gauss-3")]
    assert np.allclose(runs[0].q[-1], runs[1].q[-1], rtol=0, atol=1e-13)
    assert runs[0].method.name == "GL3"
    assert abs(runs[0].energy_error).max() < 1e-9


@pytest.mark.parametrize("name", ["RK44", "LobattoIIIA2", "RadauIIA3", "FE"])
def test_method_of_nodepy_that_is_not_symplectic_is_refused_with_its_first_defect(nodepy_methods: Any, name: str) -> None:
    with pytest.raises(sy.ArgumentError, match="are not symplectic: b_i ã_ij"):
        sy.method(nodepy_methods[name])


@pytest.mark.parametrize("name", ["RK23", "RK45", "DOP853"])
def test_explicit_method_of_scipy_is_refused_as_not_symplectic(name: str) -> None:
    integrate = pytest.importorskip("scipy.integrate")
    for run in (lambda: sy.method(getattr(integrate, name)), lambda: KEPLER.integrate(*START, t=1, step=0.1, method=getattr(integrate, name))):
        with pytest.raises(sy.ArgumentError, match="not symplectic"):
            run()


@pytest.mark.parametrize("name", ["Radau", "BDF", "LSODA"])
def test_solver_of_scipy_without_a_tableau_is_refused(name: str) -> None:
    integrate = pytest.importorskip("scipy.integrate")
    with pytest.raises(sy.ArgumentError, match="expected a method"):
        sy.method(getattr(integrate, name))


def test_object_with_a_tableau_and_a_perturbed_coefficient_is_refused() -> None:
    class Midpoint:
        """The implicit midpoint rule, as other packages write it."""

        A = np.array([[0.5]])
        b = np.array([1.0])
        p = 2

    assert sy.method(Midpoint()).order() == 2
    Midpoint.A = np.array([[0.5 + 1e-12]])
    with pytest.raises(sy.ArgumentError, match="not symplectic"):
        sy.method(Midpoint())
