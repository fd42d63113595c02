"""Single trajectories: output, events, invariants, errors."""

import copy
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import symplectica as sy


def ellipse(e: float) -> tuple[list[float], list[float]]:
    """A Kepler orbit of semi-major axis 1 from its pericentre; the period is 2π."""
    return [1 - e, 0.0], [0.0, np.sqrt((1 + e) / (1 - e))]


def test_a_kepler_orbit_closes_after_a_period(kepler):
    q, p = ellipse(0.6)
    run = kepler.integrate(q, p, t=2 * np.pi, step=0.05, method="gauss-8")
    assert run.t[-1] == 2 * np.pi and run.state[0] == 2 * np.pi
    np.testing.assert_allclose(run.q[-1], q, atol=1e-12)
    assert abs(run.energy_error).max() < 1e-13
    # With an order less it does not close as well.
    other = kepler.integrate(q, p, t=2 * np.pi, step=0.05, method="gauss-2")
    assert abs(other.q[-1] - q).max() > 1e-6


def test_output_inside_steps_has_the_order_of_the_method(oscillator):
    times = np.linspace(0, 10, 37)
    errors = []
    for step in (1.0, 0.5):
        run = oscillator.integrate([1.0], [0.0], t=10, step=step, method="gauss-4", output=times)
        assert run.t.tolist() == times.tolist()
        errors.append(abs(run.q[:, 0] - np.cos(times)).max())
    # A cubic through the ends of a step has an error of 1e-3.
    assert errors[0] < 1e-6 and 7.5 < np.log2(errors[0] / errors[1]) < 9


def test_default_output_is_at_ends_of_steps_and_bounded(kepler):
    q, p = ellipse(0.2)
    short = kepler.integrate(q, p, t=1, step=0.1, method="gauss-2")
    assert len(short.t) == 11 and short.t[0] == 0
    long = kepler.integrate(q, p, t=1000, step=0.1, method="stormer-verlet")
    assert len(long.t) <= 1001 and long.t[-1] == 1000
    assert len(kepler.integrate(q, p, t=1, step=0.1, output=0).t) == 1
    assert len(kepler.integrate(q, p, t=1, step=0.1, output=5).t) == 5


def test_runs_backward_return_to_the_start(kepler):
    q, p = ellipse(0.3)
    forth = kepler.integrate(q, p, t=5, step=0.05, method="gauss-4", output=0)
    back = kepler.integrate(forth.state[1], forth.state[2], t0=5, t=0, step=0.05, method="gauss-4")
    np.testing.assert_allclose(back.q[-1], q, atol=1e-13)


def test_states_have_the_shape_of_the_start():
    planets = sy.system("{ m: [..] } q: [..; 2], p: [..; 2]; H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: m[i] m[j]/|q[i] - q[j]|)")
    q, p = np.array([[0.0, 0.0], [1.0, 0.0]]), np.array([[0.0, -0.01], [0.0, 0.01]])
    run = planets.integrate(q, p, t=1, step=0.01, parameters={"m": [1.0, 0.01]}, method="blanes-moan-2002-s10", output=[0.5, 1.0])
    assert run.q.shape == (2, 2, 2)
    assert run.columns == ["q[0][0]", "q[0][1]", "q[1][0]", "q[1][1]", "p[0][0]", "p[0][1]", "p[1][0]", "p[1][1]"]
    assert run.system.parameters["m"].tolist() == [1.0, 0.01]
    # Without the second mass H has another value.
    assert planets.with_parameters(m=[1.0, 0.01]).energy(q, p) != planets.with_parameters(m=[1.0, 0.02]).energy(q, p)


def test_rows_of_vectors_must_have_the_components_of_the_formula():
    bodies = sy.system("q: [..; 3], p: [..; 3]; H = sum(i: |p[i]|^2)/2 + sum(i: |q[i]|^2)/2")
    assert bodies.integrate(np.ones((2, 3)), np.zeros((2, 3)), t=1, step=0.1).q.shape[1:] == (2, 3)
    assert bodies.integrate(np.ones(6), np.zeros(6), t=1, step=0.1).q.shape[1:] == (6,)
    with pytest.raises(sy.ArgumentError, match="rows must have 3 components"):
        bodies.integrate(np.ones((3, 2)), np.zeros((3, 2)), t=1, step=0.1)


def test_found_and_declared_invariants_are_conserved(kepler):
    q, p = ellipse(0.5)
    run = kepler.integrate(q, p, t=20, step=0.05, method="gauss-4")
    angular = run.invariants["angular_momentum"]
    assert angular.shape == run.t.shape and abs(angular - angular[0]).max() < 1e-13
    declared = sy.system("q: [2], p: [2]; H = |p|^2/2 - 1/|q| invariants: { area = q[0] p[1] - q[1] p[0] }")
    assert "area" in declared.integrate(q, p, t=1, step=0.05).invariants
    # An explicit method of order 1 conserves the angular momentum, too, but not the energy.
    with pytest.warns(UserWarning, match="energy error at the end"):
        euler = kepler.integrate(q, p, t=20, step=0.05, method="symplectic-euler")
    assert abs(euler.energy_error).max() > 1e-2


def test_expressions_are_evaluated_along_a_run(kepler):
    run = kepler.integrate(*ellipse(0.4), t=3, step=0.1)
    np.testing.assert_allclose(run.evaluate("|q|"), np.hypot(*run.q.T), rtol=1e-15)
    with pytest.raises(sy.DefinitionError, match="unknown name `z`"):
        run.evaluate("z + 1")
    with pytest.raises(sy.ArgumentError, match="components"):
        run.evaluate("q")


def test_events_are_found_with_the_order_of_the_method(kepler):
    run = kepler.integrate(*ellipse(0.6), t=20, step=0.1, method="gauss-8", events={"node": sy.Event("q[1]", direction="rising"), "end": "q[0]"})
    nodes = run.events["node"]
    # The start on the axis is no event.
    np.testing.assert_allclose(nodes.t, 2 * np.pi * np.arange(1, 4), atol=1e-11)
    assert nodes.q.shape == (3, 2) and len(run.events["end"]) == 7 and list(run.events) == ["node", "end"]


def test_terminal_events_end_a_run_there(kepler):
    run = kepler.integrate(*ellipse(0.6), t=100, step=0.1, method="gauss-8", events=sy.Event("q[1]", direction="rising", terminal=2))
    assert len(run.events[0]) == 2
    np.testing.assert_allclose(run.state[0], 4 * np.pi, atol=1e-11)
    # The state at the event is the last row.
    assert run.t[-1] == run.state[0] and (run.q[-1] == run.state[1]).all()
    by_text = kepler.integrate(*ellipse(0.6), t=10, step=0.1, events="q[1]").events
    assert by_text["q[1]"] is by_text[0]
    with pytest.raises(KeyError, match="there is no event 'x'"):
        _ = by_text["x"]


def test_a_ball_between_walls_keeps_its_energy():
    ball = sy.system("q: [y], p: [py]; H = py^2/2 + y")
    floor = sy.Event("y", wall=True, set={"py": "-py"})
    run = ball.integrate([1.0], [0.0], t=20, step=0.05, method="stormer-verlet", events=floor)
    assert run.q.min() > -1e-12 and abs(run.energy_error).max() < 1e-10 and len(run.events[0]) == 7
    with pytest.raises(sy.ArgumentError, match="no coordinate"):
        ball.integrate([1.0], [0.0], t=1, step=0.1, events=sy.Event("y", set={"py + y": "0"}))


def test_time_dependent_systems_start_at_their_time():
    driven = sy.system("q: [x], p: [px]; H = px^2/2 + x sin(t)")
    run = driven.integrate([0.0], [0.0], t0=np.pi, t=2 * np.pi, step=0.01, method="gauss-4", output=0)
    np.testing.assert_allclose(run.state[2], [2.0], atol=1e-12)


def test_friction_damps_momenta():
    damped = sy.system("{ c: 0.1 } q: [x], p: [px]; H = (px^2 + x^2)/2 friction: c")
    run = damped.integrate([1.0], [0.0], t=10, step=0.01, method="stormer-verlet", output=[5.0, 10.0])
    w = np.sqrt(1 - 0.05**2)
    exact = np.exp(-0.05 * run.t) * (np.cos(w * run.t) + 0.05 / w * np.sin(w * run.t))
    np.testing.assert_allclose(run.q[:, 0], exact, atol=3e-5)
    velocity = -np.exp(-0.05 * run.t) * np.sin(w * run.t) / w
    np.testing.assert_allclose(run.p[:, 0], velocity, atol=3e-5)
    np.testing.assert_allclose(run.state[2], run.p[-1])


def test_constraints_hold_and_starts_are_projected():
    rod = sy.system("q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + y constraints: { rod = x^2 + y^2 - 1 }")
    run = rod.integrate([1.0, 0.0], [0.0, 0.0], t=10, step=0.01)
    assert run.constraint_error.max() < 1e-13 and run.method.name == "lobatto-3"
    with pytest.raises(sy.ArgumentError, match="project_starts"):
        rod.integrate([1.1, 0.0], [0.0, 0.0], t=1, step=0.01)
    moved = rod.integrate([1.1, 0.0], [0.0, 0.0], t=1, step=0.01, project_starts=True)
    assert moved.constraint_error[-1] < 1e-13
    with pytest.raises(sy.ArgumentError, match="lobatto-2"):
        rod.integrate([1.0, 0.0], [0.0, 0.0], t=1, step=0.01, method="gauss-4")


def test_rolling_stays_without_slip():
    skate = sy.system(
        "q: [x, y, a], p: [px, py, pa]; v: [vx, vy, va]; H = (px^2 + py^2 + pa^2)/2 + x nonholonomic: { edge = vx sin(a) - vy cos(a) }"
    )
    run = skate.integrate([0.0, 0.0, 0.0], [1.0, 0.0, 0.5], t=10, step=0.01)
    assert run.constraint_error.max() < 1e-13 and run.method.name == "gauss-1"


def test_lagrangians_start_from_velocities():
    pendulum = sy.system("{ m: 2, l: 3, g: 9.81 } q: [a], v: [va]; L = m l^2 va^2/2 + m g l cos(a)")
    np.testing.assert_allclose(pendulum.momentum([0.3], [0.7]), [2 * 9 * 0.7])
    run = pendulum.integrate([0.3], v=[0.7], t=5, step=0.01, method="gauss-4")
    assert abs(run.energy_error).max() < 1e-12


def test_newton_solves_stiff_steps_that_fixed_points_do_not():
    stiff = sy.system("q: [x], p: [px]; H = px^2/2 + 1e8 x^2/2")
    with pytest.raises(sy.StepError, match="newton") as caught:
        stiff.integrate([1.0], [0.0], t=1, step=0.1, method="gauss-2")
    error = caught.value
    assert error.kind == "no convergence" and error.step == 1 and error.time == 0 and error.step_size == 0.1
    assert error.run.state[0] == 0 and isinstance(error, RuntimeError)
    run = stiff.integrate([1.0], [0.0], t=1, step=0.1, method="gauss-2", solver="newton")
    assert abs(run.energy_error).max() < 1e-8


def test_a_failed_run_keeps_its_states_up_to_the_failure():
    run = None
    try:
        sy.system("q: [x], p: [px]; H = px^2/2 - sqrt(2 - x)").integrate([0.0], [3.0], t=100, step=0.01, method="stormer-verlet")
    except sy.StepError as error:
        run = error.run
    assert run is not None and 0 < run.state[0] < 3 and run.q[-1, 0] < 2 and len(run.t) > 1


def test_runs_pickle_and_copy(kepler):
    run = kepler.integrate(*ellipse(0.3), t=3, step=0.1, method="gauss-4", events="q[1]")
    for other in (pickle.loads(pickle.dumps(run)), copy.copy(run), copy.deepcopy(run)):
        assert (other.q == run.q).all() and other.system == kepler and other.method == run.method
        assert (other.energy_error == run.energy_error).all() and (other.events[0].t == run.events[0].t).all()


def test_state_transition_is_symplectic_and_matches_differences(kepler):
    q, p = ellipse(0.3)
    run = kepler.integrate(q, p, t=2, step=0.05, method="gauss-4", output=0)
    derivative = run.state_transition
    unit = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.eye(2), np.zeros((2, 2))]])
    np.testing.assert_allclose(derivative.T @ unit @ derivative, unit, atol=1e-12)
    small = 1e-6
    for column in range(4):
        ends = []
        for sign in (1, -1):
            start = np.array([*q, *p])
            start[column] += sign * small
            _, end_q, end_p = kepler.integrate(start[:2], start[2:], t=2, step=0.05, method="gauss-4", output=0).state
            ends.append(np.concatenate([end_q, end_p]))
        np.testing.assert_allclose(derivative[:, column], (ends[0] - ends[1]) / (2 * small), atol=1e-8)


@pytest.mark.parametrize("method", ["gauss-4", "blanes-moan-2002-s10", "lobatto-3"])
def test_derivatives_by_parameters_match_differences(method):
    # One parameter is in the kinetic energy, one in the potential, one in both.
    springs = sy.system(
        "{ k: [..], m, c } q: [..], p: [..]; H = sum(i: p[i]^2/(2 m)) (1 + c/9) + sum(i: k[i] q[i]^2)/2 + c sum(i: q[i]^4)/4",
        parameters={"k": [1.0, 2.5], "m": 1.3, "c": 0.4},
    )
    arguments = {"q": [1.0, 0.5], "p": [0.2, -0.1], "t": 2.0, "step": 0.05, "method": method}
    found = springs.parameter_derivatives(**arguments)
    assert {name: value.shape for name, value in found.items()} == {"k": (4, 2), "m": (4,), "c": (4,)}

    def end(**parameters):
        _, q, p = springs.integrate(**arguments, output=0, parameters=parameters).state
        return np.concatenate([q, p])

    small = 1e-6
    for name in ("m", "c"):
        value = springs.parameters[name]
        difference = (end(**{name: value + small}) - end(**{name: value - small})) / (2 * small)
        np.testing.assert_allclose(found[name], difference, atol=1e-8)
    for place in range(2):
        shift = small * np.eye(2)[place]
        difference = (end(k=springs.parameters["k"] + shift) - end(k=springs.parameters["k"] - shift)) / (2 * small)
        np.testing.assert_allclose(found["k"][:, place], difference, atol=1e-8)
    assert list(springs.parameter_derivatives("c", **arguments)) == ["c"]
    with pytest.raises(sy.ArgumentError, match="no parameter `x`"):
        springs.parameter_derivatives("x", **arguments)


def test_tables_and_files_have_all_columns(pendulum, tmp_path):
    run = pendulum.integrate([1.0], [0.0], t=1, step=0.1)
    run.save(tmp_path / "run.npz")
    stored = np.load(tmp_path / "run.npz")
    assert (stored["q"] == run.q).all() and str(stored["method"]) == "gauss-4" and "9.81" in str(stored["formula"])
    with pytest.raises(sy.ArgumentError, match="must end in"):
        run.save(tmp_path / "run.txt")
    pytest.importorskip("pandas")
    run.save(tmp_path / "run.csv")
    assert (tmp_path / "run.csv").read_text(encoding="utf-8").startswith("t,a,pa,energy_error")
    assert list(run.to_pandas().columns) == ["t", "a", "pa", "energy_error"]


def test_pictures_are_drawn(pendulum, kepler):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    run = kepler.integrate(*ellipse(0.3), t=3, step=0.1)
    for kind in ("orbit", "phase", "time", "energy"):
        assert run.plot(kind).lines
    assert pendulum.integrate([1.0], [0.0], t=1, step=0.1).plot().get_xlabel() == "a"
    with pytest.raises(sy.ArgumentError, match="unknown kind"):
        run.plot("orbits")


def test_progress_is_called_with_growing_fractions(kepler):
    seen = []
    kepler.integrate(*ellipse(0.3), t=20_000, step=0.01, method="stormer-verlet", output=0, progress=seen.append)
    assert len(seen) > 1 and seen == sorted(seen) and 0 <= seen[0] < seen[-1] == 1


def test_an_exception_of_the_progress_stops_the_run(kepler):
    def stop(_fraction: float) -> None:
        raise OverflowError("enough")

    before = time.monotonic()
    with pytest.raises(OverflowError, match="enough"):
        kepler.integrate(*ellipse(0.3), t=1e7, step=0.01, method="stormer-verlet", output=0, progress=stop)
    assert time.monotonic() - before < 5


@pytest.mark.skipif(not hasattr(signal, "SIGINT"), reason="no signals")
def test_ctrl_c_stops_a_run_and_leaves_the_last_full_step(kepler):
    # REBOUND, in other tests, leaves a handler of its own.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    sent: list[float] = []

    def interrupt() -> None:
        time.sleep(0.3)
        sent.append(time.monotonic())
        # A signal for the main thread, which runs.
        signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(sy.Interrupted) as caught:
        kepler.integrate(*ellipse(0.3), t=1e4, step=0.001, method="gauss-4", output=0)
    stopped = time.monotonic()
    thread.join()
    assert stopped - sent[0] < 0.1
    run = caught.value.run
    assert isinstance(caught.value, KeyboardInterrupt) and 0 < run.state[0] < 1e4
    assert abs(run.energy_error[-1]) < 1e-12 and run.statistics["steps"] > 0


def test_other_threads_run_meanwhile(kepler):
    counts = []

    def count() -> None:
        number = 0
        while not done.is_set():
            number += 1
            time.sleep(0.001)
        counts.append(number)

    done = threading.Event()
    thread = threading.Thread(target=count)
    thread.start()
    kepler.integrate(*ellipse(0.3), t=5000, step=0.01, method="stormer-verlet", output=0)
    done.set()
    thread.join()
    assert counts[0] > 5


WRONG = [
    ({"step": 0}, "must be positive"),
    ({"step": -0.1}, "must be positive"),
    ({"step": float("nan")}, "not finite"),
    ({"step": "small"}, "expected numbers"),
    ({"t": float("inf")}, "not finite"),
    ({"step": 1e-300}, "2\\^53"),
    ({"output": [0.5, 0.2]}, "sorted"),
    ({"output": [0.5, 2.0]}, "from t0"),
    ({"output": []}, "at least one time"),
    ({"output": -1}, "whole number"),
    ({"solver": "newtn"}, "newton"),
    ({"project_starts": True}, "no constraints"),
    ({"parameters": {"mu": 1}}, "no parameter `mu`"),
    ({"events": 3}, "expression"),
    ({"events": [3]}, "expression"),
    ({"events": "q[7]"}, "between 0 and 1"),
    ({"events": sy.Event("q[1]", direction="up")}, "rising, falling, both"),
    ({"halvings": -1}, "whole number"),
    ({"progress": 3}, "progress"),
]


@pytest.mark.parametrize(("wrong", "message"), WRONG, ids=[next(iter(wrong)) + str(k) for k, (wrong, _) in enumerate(WRONG)])
def test_wrong_arguments_are_refused_with_what_to_do(kepler, wrong, message):
    arguments = {"t": 1.0, "step": 0.1, **wrong}
    with pytest.raises((sy.ArgumentError, sy.DefinitionError), match=message):
        kepler.integrate([1.0, 0.0], [0.0, 1.0], **arguments)


def test_wrong_states_are_refused(kepler):
    for q, p, message in [
        ([1.0], [0.0], "needs 2"),
        ([1.0, 0.0], [0.0], "same"),
        ([1.0, np.nan], [0.0, 1.0], "not finite"),
        ([], [], "empty"),
        (["x", 1], [0, 1], "numbers"),
    ]:
        with pytest.raises(sy.ArgumentError, match=message):
            kepler.integrate(q, p, t=1, step=0.1)
    with pytest.raises(sy.ArgumentError, match="either"):
        kepler.integrate([1.0, 0.0], t=1, step=0.1)


def test_a_method_for_separable_systems_is_refused_for_others():
    product = sy.system("q: [x], p: [px]; H = (x^2 + 1)(px^2 + 1)/2")
    with pytest.raises(sy.ArgumentError, match="not separable"):
        product.integrate([0.3], [0.7], t=1, step=0.01, method="blanes-moan-2002-s10")
    assert product.integrate([0.3], [0.7], t=1, step=0.01, method="blanes-moan-2002-s10", accept_lower_order=True).t[-1] == 1


def test_missing_parameters_are_named():
    spring = sy.system("{ k, m: [..] } q: [..], p: [..]; H = sum(i: p[i]^2/(2 m[i])) + k sum(i: q[i]^2)/2")
    assert spring.parameter_names == ["k", "m"]
    with pytest.raises(sy.ArgumentError, match="`k` has no value"):
        spring.integrate([0.0], [1.0], t=1, step=0.1, parameters={"m": [1.0]})
    with pytest.raises(sy.ArgumentError, match="needs 1"):
        spring.integrate([0.0], [1.0], t=1, step=0.1, parameters={"m": [1.0, 2.0], "k": 1})
    with pytest.raises(sy.ArgumentError, match="is one number; the formula needs a list"):
        spring.integrate([0.0], [1.0], t=1, step=0.1, parameters={"m": 1.0, "k": 1})


def test_formulas_describe_themselves(kepler):
    assert "q'[0] = p[0]" in str(kepler.equations)
    assert "aligned" in kepler.equations._repr_latex_() and kepler._repr_latex_().startswith("$$H")
    assert any("angular_momentum" in fact for fact in kepler.facts)
    assert "H" in kepler.describe("json")
    with pytest.raises(sy.DefinitionError) as caught:
        sy.system("q: [x], p: [px]; H = px^2/2 + foo(x)")
    assert caught.value.span is not None and "^" in str(caught.value)
    with pytest.raises(sy.ArgumentError, match="macros"):
        sy.system("q: [x], v: [vx]; L = vx^4/4 - x^2").integrate([0.0], [1.0], t=1, step=0.1)


def test_systems_pickle_and_compare(pendulum):
    other = pickle.loads(pickle.dumps(pendulum.with_parameters(g=1.62)))
    assert other.parameters == {"g": 1.62} and other != pendulum and other == pendulum.with_parameters(g=1.62)
