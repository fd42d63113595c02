"""Simulations of REBOUND."""

from __future__ import annotations

import doctest
import sys
from typing import Any

import numpy as np
import pytest

import symplectica as sy

rebound = pytest.importorskip("rebound")

from symplectica.rebound import from_simulation, to_simulation  # noqa: E402


def two_planets(softening: float = 0.0) -> Any:
    simulation = rebound.Simulation()
    simulation.G = 2.5
    simulation.softening = softening
    simulation.add(m=1.5)
    simulation.add(m=1e-3, a=1, e=0.1, inc=0.2)
    simulation.add(m=2e-3, a=2.2, e=0.2, omega=1.0)
    simulation.move_to_com()
    return simulation


def states(simulation: Any) -> Any:
    return np.array([[body.x, body.y, body.z, body.vx, body.vy, body.vz] for body in simulation.particles[: simulation.N]])


def test_energy_is_that_of_rebound() -> None:
    simulation = two_planets()
    system, q, p = from_simulation(simulation)
    assert q.shape == p.shape == (3, 3)
    assert system.energy(q, p) == pytest.approx(simulation.energy(), rel=1e-13, abs=0)
    assert system.parameters["G"] == 2.5


def test_softening_that_is_given_replaces_that_of_the_simulation() -> None:
    system, q, p = from_simulation(two_planets(0.1), softening=0.2)
    other, *_ = from_simulation(two_planets(0.2))
    assert system == other
    assert system.energy(q, p) != pytest.approx(two_planets(0.1).energy(), rel=1e-3)


@pytest.mark.parametrize("softening", [0.0, 0.1])
def test_end_state_is_that_of_ias15(softening: float) -> None:
    simulation = two_planets(softening)
    system, q, p = from_simulation(simulation)
    run = system.integrate(q, p, t=20, step=0.02, method="gauss-8", output=0)
    simulation.integrator = "ias15"
    simulation.integrate(20)
    # Both are exact to rounding, which grows along some ten orbits.
    assert np.allclose(states(to_simulation(run)), states(simulation), rtol=0, atol=1e-11)


def test_simulation_of_a_run_has_its_time_masses_and_constants() -> None:
    simulation = two_planets(0.1)
    system, q, p = from_simulation(simulation)
    run = system.integrate(q, p, t0=1, t=3, step=0.1, output=[1, 2, 3])
    first, middle = to_simulation(run, 0), to_simulation(run, 1)
    assert np.allclose(states(first), states(simulation), rtol=1e-15, atol=0)
    assert (first.t, middle.t, to_simulation(run).t) == (1, 2, 3)
    assert (first.G, first.softening) == (2.5, 0.1)
    assert [body.m for body in middle.particles[: middle.N]] == [1.5, 1e-3, 2e-3]
    again, *state = from_simulation(middle)
    # `energy()` of REBOUND does not contain the softening length.
    assert again == system and again.energy(*state) == pytest.approx(system.energy(q, p), rel=1e-9, abs=0)


def test_simulation_is_not_changed() -> None:
    simulation = two_planets()
    before = states(simulation)
    from_simulation(simulation)
    assert np.array_equal(states(simulation), before) and simulation.t == 0


def test_simulation_between_half_steps_gives_the_state_at_the_end_of_the_step() -> None:
    simulation = two_planets()
    simulation.integrator = "whfast"
    simulation.integrator.safe_mode = 0
    simulation.dt = 0.01
    seen = []

    def look(pointer: Any) -> None:
        inside = pointer.contents
        if inside.steps_done == 3:
            seen.append((inside.is_synchronized, states(inside)[:, :3], from_simulation(inside)[1], inside.is_synchronized))

    simulation.heartbeat = look
    simulation.integrate(0.1, exact_finish_time=0)
    [(before, raw, q, after)] = seen
    own = two_planets()
    own.integrator, own.dt = "whfast", 0.01
    own.steps(3)
    assert (before, after) == (0, 0)
    assert np.allclose(q, states(own)[:, :3], rtol=0, atol=1e-15) and not np.allclose(raw, q, atol=1e-4)


def change(key: str, value: Any) -> Any:
    simulation = two_planets()
    setattr(simulation, key, value)
    return simulation


def with_a_massless_body() -> Any:
    simulation = two_planets()
    simulation.add(m=0, a=5)
    return simulation


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: 1, "expected a rebound.Simulation"),
        (lambda: rebound.Simulation(), "no bodies"),
        (with_a_massless_body, "body 3 has no mass"),
        (lambda: change("N_active", 2), "from number 2 are test particles"),
        (lambda: change("gravity", "none"), "no gravity"),
        (lambda: change("collision", "direct"), "has collisions"),
        (lambda: change("boundary", "open"), "has a boundary"),
    ],
)
def test_simulation_that_is_no_hamiltonian_system_of_bodies_is_refused(make: Any, words: str) -> None:
    with pytest.raises(sy.ArgumentError, match=words):
        from_simulation(make())


def test_example_of_the_module_runs() -> None:
    results = doctest.testmod(sys.modules[from_simulation.__module__])
    assert results.attempted > 0 and results.failed == 0


def test_rebound_that_is_not_installed_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "rebound", None)
    with pytest.raises(ImportError, match="pip install rebound"):
        from_simulation(two_planets)


def test_run_of_another_system_is_refused() -> None:
    run = sy.system("q: [x], p: [px]; H = px^2/2 + x^2/2").integrate([1.0], [0.0], t=1, step=0.1)
    with pytest.raises(sy.ArgumentError, match="from_simulation"):
        to_simulation(run)


def test_state_that_the_run_does_not_have_is_refused() -> None:
    system, q, p = from_simulation(two_planets())
    run = system.integrate(q, p, t=1, step=0.1, output=3)
    with pytest.raises(sy.ArgumentError, match="no state 7"):
        to_simulation(run, 7)
