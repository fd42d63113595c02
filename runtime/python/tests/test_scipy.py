"""The function in place of SciPy's."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import symplectica as sy

OSCILLATOR = "q: [x], p: [px]; H = px^2/2 + x^2/2"
KEPLER = "q: [2], p: [2]; H = |p|^2/2 - 1/|q|"
START = [0.4, 0.0, 0.0, 2.0]
BALL = "{ g: 9.81 } q: [y], p: [py]; H = py^2/2 + g y"


def reason(*arguments: Any, **keywords: Any) -> str:
    with pytest.raises(sy.ArgumentError) as error:
        sy.solve_ivp(*arguments, **keywords)
    return str(error.value)


def test_kepler_orbit_agrees_with_dop853_of_scipy() -> None:
    integrate = pytest.importorskip("scipy.integrate")

    def equations(t: float, y: Any) -> Any:
        return np.concatenate([y[2:], -y[:2] / np.hypot(*y[:2]) ** 3])

    times = np.linspace(0, 6, 13)
    ours = sy.solve_ivp(KEPLER, (0, 6), START, t_eval=times, step=0.01)
    theirs = integrate.solve_ivp(equations, (0, 6), START, "DOP853", t_eval=times, rtol=1e-13, atol=1e-13)
    assert ours.t.tolist() == theirs.t.tolist() and ours.y.shape == theirs.y.shape
    # The tolerance of DOP853, multiplied by the condition of the orbit.
    assert abs(ours.y - theirs.y).max() < 1e-10
    assert set(theirs) <= set(ours)
    assert (ours.status, ours.message, ours.success) == (theirs.status, theirs.message, theirs.success)
    assert ours["t"] is ours.t and ours.t_events is None and ours.sol is None


def test_states_of_all_steps_are_kept_without_t_eval() -> None:
    found = sy.solve_ivp(OSCILLATOR, (0, 200), [1, 0], step=0.1)
    assert found.t.shape == (2001,) and found.y.shape == (2, 2001)
    assert np.allclose(found.y, [np.cos(found.t), -np.sin(found.t)], rtol=0, atol=1e-11)


def test_run_backward_returns_to_the_start() -> None:
    found = sy.solve_ivp(KEPLER, (3, 0), sy.solve_ivp(KEPLER, (0, 3), START, step=0.01).y[:, -1], step=0.01)
    assert found.t[0] == 3 and found.t[-1] == 0
    assert np.allclose(found.y[:, -1], START, rtol=0, atol=1e-12)


def test_max_step_is_the_step_if_there_is_no_other() -> None:
    found = sy.solve_ivp(OSCILLATOR, (0, 1), [1, 0], max_step=0.25)
    assert len(found.t) == 5
    assert "give `step`" in reason(OSCILLATOR, (0, 1), [1, 0])
    assert "give `step`" in reason(OSCILLATOR, (0, 1), [1, 0], max_step=np.inf)


@pytest.mark.parametrize("backward", [False, True])
def test_dense_output_inside_steps_has_the_order_of_the_method(backward: bool) -> None:
    end = -10.0 if backward else 10.0
    found = sy.solve_ivp(OSCILLATOR, (0, end), [1, 0], step=0.5, dense_output=True)
    times = end * np.array([0.77, 0.0, 1.0, 0.123, 0.1234, 0.5, 0.77])
    assert found.sol(times).shape == (2, 7)
    # The phase error of the method at t = 10 is 1e-8; interpolation of order 4 in steps of 0.5 has errors of 1e-4.
    assert np.allclose(found.sol(times), [np.cos(times), -np.sin(times)], rtol=0, atol=2e-8)
    assert np.array_equal(found.sol(times[0]), found.sol(times[:1])[:, 0])
    assert np.array_equal(found.sol(found.t[7]), found.y[:, 7])
    assert (found.sol.t_min, found.sol.t_max) == (min(0, end), max(0, end))


def test_dense_output_outside_the_run_is_refused() -> None:
    found = sy.solve_ivp(OSCILLATOR, (0, 1), [1, 0], step=0.5, dense_output=True)
    with pytest.raises(sy.ArgumentError, match="known from 0.0 to 1.0"):
        found.sol(1.1)


def test_dense_output_with_t_eval_has_these_times() -> None:
    found = sy.solve_ivp(OSCILLATOR, (0, 1), [1, 0], step=0.5, t_eval=[0.1, 0.9], dense_output=True)
    assert found.t.tolist() == [0.1, 0.9]
    assert np.allclose(found.y[0], np.cos(found.t), rtol=0, atol=1e-9)
    assert len(found.sol.ts) == 3


def test_event_without_an_end_is_located_and_the_run_goes_on() -> None:
    found = sy.solve_ivp(OSCILLATOR, (0, 10), [1, 0], step=0.1, events=["x", sy.Event("px", direction="rising")])
    assert np.allclose(found.t_events[0], np.pi * (np.arange(3) + 0.5), rtol=0, atol=1e-10)
    assert np.allclose(found.t_events[1], [np.pi, 3 * np.pi], rtol=0, atol=1e-10)
    assert found.y_events[0].shape == (3, 2) and np.allclose(found.y_events[0][:, 1], [-1, 1, -1])
    assert found.status == 0


def test_terminal_event_ends_the_run_with_its_state() -> None:
    fall = np.sqrt(2 / 9.81)
    found = sy.solve_ivp(BALL, (0, 2), [1, 0], step=0.1, events=sy.Event("y", terminal=True), dense_output=True)
    assert (found.status, found.success, found.message) == (1, True, "A termination event occurred.")
    assert found.t[-1] == found.t_events[0][0] == pytest.approx(fall, rel=1e-14)
    assert found.y[0, -1] == pytest.approx(0, abs=1e-14)
    times = np.array([0.05, 0.43, fall * (1 - 1e-15)])
    assert np.allclose(found.sol(times)[0], 1 - 9.81 * times**2 / 2, rtol=0, atol=1e-13)


def test_dense_output_before_a_terminal_event_is_that_of_the_run_without_an_end() -> None:
    # A step of 0.5 of the midpoint rule has an error of 1e-2, and a shorter last one another.
    ended, whole = (
        sy.solve_ivp(OSCILLATOR, (0, 3), [1, 0], "gauss-1", step=0.5, events=events, dense_output=True) for events in (sy.Event("x", terminal=True), None)
    )
    assert 1.5 < ended.sol.t_max < 2
    times = np.array([1.1, 1.3, ended.sol.t_max - 0.01])
    assert np.allclose(ended.sol(times), whole.sol(times), rtol=0, atol=1e-14)


def test_dense_output_up_to_a_wall_that_ends_the_run_has_all_times() -> None:
    floor = sy.Event("y", wall=True, set={"py": "-py"}, terminal=2)
    found = sy.solve_ivp(BALL, (0, 3), [1, 0], step=0.1, events=floor, dense_output=True)
    end = 3 * np.sqrt(2 / 9.81)
    assert found.status == 1 and found.sol.t_max == pytest.approx(end, rel=1e-14)
    assert found.sol([end / 3 + 0.1, end / 3 + 0.2, found.sol.t_max]).shape == (2, 3)


def test_times_after_a_terminal_event_have_no_states() -> None:
    for dense in (False, True):
        event = sy.Event("y", terminal=True)
        found = sy.solve_ivp(BALL, (0, 2), [1, 0], step=0.1, events=event, t_eval=[0.1, 0.2, 1.0], dense_output=dense)
        assert found.t.tolist() == [0.1, 0.2] and found.y.shape == (2, 2)
        found = sy.solve_ivp(BALL, (0, 2), [1, 0], step=0.1, events=event, t_eval=[1.0, 1.5], dense_output=dense)
        assert found.t.shape == (0,) and found.y.shape == (2, 0) and found.status == 1


def test_dense_output_of_a_ball_that_bounces_is_its_path() -> None:
    floor = sy.Event("y", wall=True, set={"py": "-py"})
    found = sy.solve_ivp(BALL, (0, 1.2), [1, 0], step=0.1, events=floor, dense_output=True)
    times = np.linspace(0, 1.2, 50)
    fall = np.sqrt(2 / 9.81)
    since = (times + fall) % (2 * fall) - fall
    assert np.allclose(found.sol(times)[0], 1 - 9.81 * since**2 / 2, rtol=0, atol=1e-12)


def test_step_that_fails_gives_the_run_before_it() -> None:
    found = sy.solve_ivp("q: [y], p: [py]; H = py^2/2 + exp(y)", (0, -200), [0, 0], step=50)
    assert (found.status, found.success) == (-1, False)
    assert "did not converge" in found.message
    assert found.t.tolist() == [0]


def test_parameters_have_the_given_values() -> None:
    found = sy.solve_ivp(sy.system(BALL), (0, 1), [1, 0], step=0.1, parameters={"g": 2})
    assert found.y[:, -1] == pytest.approx([0, -2], abs=1e-14)
    assert found.run.system.parameters == {"g": 2.0}


def test_method_by_name_is_used() -> None:
    found = sy.solve_ivp(OSCILLATOR, (0, 1), [1, 0], "stormer-verlet", step=0.1)
    assert found.run.method.name == "stormer-verlet" and found.njev == found.nlu == 0
    assert found.nfev > 0


def test_constraints_have_their_own_default_method() -> None:
    rod = "q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + y constraints: { rod = x^2 + y^2 - 1 }"
    found = sy.solve_ivp(rod, (0, 1), [0.6, -0.8, 0, 0], step=0.01)
    assert found.run.method.name == "lobatto-3"


@pytest.mark.parametrize(
    ("keywords", "words"),
    [
        ({"rtol": 1e-8}, "`rtol` is not an option of this `solve_ivp`: a symplectic method takes steps of equal size"),
        ({"atol": 1e-8}, "give `step`; then halve it"),
        ({"args": (1,)}, "`parameters="),
        ({"jac": None}, "derived from the formula"),
        ({"first_step": 0.1}, "all steps have the size"),
        ({"speed": 1}, "known here"),
        ({"method": "RK45"}, "not symplectic"),
        ({"events": lambda t, y: y[0]}, "the text of an expression"),
        ({"events": [1]}, "found int"),
        ({"step": 1e-9}, "give `t_eval`"),
        ({"step": -0.1}, "must be positive"),
        ({"t_eval": [0.5, 0.2]}, "sorted"),
        ({"t_eval": [0.5, 1.2]}, "must be in `t_span`"),
    ],
)
def test_option_without_meaning_is_refused_with_a_hint(keywords: dict[str, Any], words: str) -> None:
    assert words in reason(OSCILLATOR, (0, 1), [1, 0], **{"step": 0.1, **keywords})


def test_python_function_is_refused_with_both_ways_out() -> None:
    message = reason(lambda t, y: y, (0, 1), [1, 0], step=0.1)
    assert "write the formula of H" in message and "python_function" in message


@pytest.mark.parametrize(("span", "start", "words"), [((0, 1, 2), [1, 0], "`t_span`"), ((0, 1), [1, 0, 0], "d positions"), ((0, 1), 1.0, "d positions")])
def test_shape_that_does_not_fit_is_refused(span: Any, start: Any, words: str) -> None:
    assert words in reason(OSCILLATOR, span, start, step=0.1)


def test_system_of_another_type_is_refused() -> None:
    assert "found int" in reason(3, (0, 1), [1, 0], step=0.1)
