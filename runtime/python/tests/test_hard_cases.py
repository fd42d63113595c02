"""Cases that were wrong once: forks, threads, memory, friction, doubles, velocities, arrays of the caller."""

import multiprocessing
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import symplectica as sy

KEPLER = "q: [2], p: [2]; H = |p|^2/2 - 1/|q|"


def _run_in_child(queue) -> None:
    kepler = sy.system(KEPLER)
    run = kepler.integrate([0.4, 0], [0, 2], t=1, step=0.05)
    many = kepler.ensemble([[0.4, 0]] * 20, [[0, 2]] * 20, t=1, step=0.05)
    queue.put((run.q[-1].tolist(), many.q[3].tolist()))


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_forked_process_runs_after_its_parent_ran(kepler):
    expected = kepler.ensemble([[0.4, 0]] * 20, [[0, 2]] * 20, t=1, step=0.05).q[3].tolist()
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=_run_in_child, args=(queue,), daemon=True)
    child.start()
    try:
        assert queue.get(timeout=60) == (expected, expected)
    finally:
        child.kill()


def test_a_short_run_does_not_wait_for_an_ensemble(kepler):
    thread = threading.Thread(target=lambda: kepler.ensemble([[0.4, 0]] * 64, [[0, 2]] * 64, t=300, step=0.05))
    thread.start()
    time.sleep(0.1)
    before = time.monotonic()
    sy.system(KEPLER).integrate([0.4, 0], [0, 2], t=1, step=0.1)
    waited, is_alive = time.monotonic() - before, thread.is_alive()
    thread.join()
    assert waited < 0.5 or not is_alive


INTERRUPTED = """
import signal, sys, threading, time
import numpy as np
import symplectica as sy
kepler = sy.system("q: [2], p: [2]; H = |p|^2/2 - 1/|q|")
oscillator = sy.system("q: [..], p: [..]; H = sum(i: p[i]^2)/2 + sum(i: q[i]^4)/4")
signal.signal(signal.SIGINT, signal.default_int_handler)
sent = []
def interrupt():
    time.sleep(0.5)
    sent.append(time.monotonic())
    signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)
threading.Thread(target=interrupt, daemon=True).start()
try:
    {call}
except sy.Interrupted as caught:
    print(time.monotonic() - sent[0])
    found = caught.run
    {check}
"""

CALLS = {
    "many steps": ('kepler.integrate([0.4, 0], [0, 2], t=1e12, step=1e-2)', "assert found.t[-1] == found.state[0] > 0"),
    "many looks": ('kepler.integrate([0.4, 0], [0, 2], t=1e4, step=0.1, events=sy.Event("q[1]", samples=10_000))', "assert found.state[0] > 0"),
    "many outputs": ("kepler.integrate([0.4, 0], [0, 2], t=1, step=0.1, output=np.linspace(0, 1, 3_000_000))", "assert 0 <= found.t[-1] < 1 and (np.diff(found.t) > 0).all()"),
    "newton": ('oscillator.integrate(np.ones(60), np.zeros(60), t=1000, step=0.1, method="gauss-2", solver="newton")', "assert found.state[0] < 1000"),
    "ensemble": (
        "kepler.ensemble([[0.4, 0]] * 3000, [[0, 2]] * 3000, t=1e4, step=0.05, output=[1e4])",
        'assert len(found.q) == len(found) < 3000 and {failure.kind for failure in found.failures} <= {"interrupted"}; found.energy_error; found.to_pandas',
    ),
}


@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="no signals of threads")
@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_stops_every_kind_of_run(name):
    call, check = CALLS[name]
    code = INTERRUPTED.format(call=call, check=check)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=100, check=False)
    assert done.returncode == 0, done.stderr
    # Under load threads wait for processors.
    assert float(done.stdout) < 1.0


def test_output_that_does_not_fit_into_memory_is_refused(kepler):
    many = np.ones((3 * 10**4, 2))
    with pytest.raises(MemoryError, match="give fewer times"):
        kepler.ensemble(many, many, t=1, step=0.1, method="gauss-2", output=np.linspace(0, 1, 10**6))
    with pytest.raises(sy.ArgumentError, match="from 0 to 1000000000"):
        kepler.integrate([0.4, 0], [0, 2], t=1, step=0.1, output=10**10)


def test_expressions_with_friction_have_the_momenta_of_the_run():
    damped = sy.system("{ c: 0.5 } q: [x], p: [px]; H = (px^2 + x^2)/2 friction: c")
    run = damped.integrate([1.0], [0.0], t=6, step=0.05, method="stormer-verlet", events="px")
    np.testing.assert_allclose(run.evaluate("px"), run.p[:, 0], rtol=1e-15)
    assert abs(run.events[0].p).max() < 1e-12 and len(run.events[0]) == 1


def test_doubles_are_not_replaced_by_a_method_of_their_order(oscillator):
    wrong = sy.Doubles([[0.25, 0.0], [0.5, 0.25]], [0.5, 0.5], order=4)
    own = oscillator.integrate([1.0], [0.0], t=1, step=0.5, method=wrong, output=0)
    gauss = oscillator.integrate([1.0], [0.0], t=1, step=0.5, method="gauss-2", output=0)
    assert abs(own.q[-1] - gauss.q[-1]).max() > 1e-3
    two_midpoints = oscillator.integrate([1.0], [0.0], t=1, step=0.25, method="gauss-1", output=0)
    np.testing.assert_allclose(own.q[-1], two_midpoints.q[-1], atol=1e-13)


@pytest.mark.parametrize("method", ["ruth-1983", "stormer-verlet", "gauss-2"])
def test_functions_of_time_have_the_nodes_of_their_halves(method):
    function = sy.python_function(lambda t, q, p: (1 + np.sin(t)) * p, lambda t, q, p: -np.cos(2 * t) * q, separable=method != "gauss-2")
    formula = sy.system("q: [x], p: [px]; H = (1 + sin(t)) px^2/2 + cos(2 t) x^2/2")
    run = function.integrate([1.0], [0.2], t=2, step=0.1, method=method)
    exact = formula.integrate([1.0], [0.2], t=2, step=0.1, method=method)
    np.testing.assert_allclose(run.q[-1], exact.q[-1], atol=1e-13)


@pytest.mark.parametrize("energy", ["sqrt(1 + px^2)", "px^4/4"])
def test_velocities_are_refused_if_they_do_not_determine_momenta_linearly(energy):
    system = sy.system(f"q: [x], p: [px]; H = {energy} + x^2/2")
    with pytest.raises(sy.ArgumentError, match="not quadratic"):
        system.momentum([0.0], [0.9])
    with pytest.raises(sy.ArgumentError, match="not quadratic"):
        system.integrate([0.0], v=[0.9], t=1, step=0.1)


def test_derivatives_are_refused_for_runs_with_events():
    ball = sy.system("{ g: 9.81 } q: [y], p: [py]; H = py^2/2 + g y")
    run = ball.integrate([1.0], [0.0], t=1, step=0.01, method="stormer-verlet", events=sy.Event("y", wall=True, set={"py": "-py"}))
    with pytest.raises(sy.ArgumentError, match="without events"):
        run.parameter_derivatives("g")
    with pytest.raises(sy.ArgumentError, match="without events"):
        _ = run.state_transition


def test_derivatives_of_a_run_have_its_solver():
    stiff = sy.system("{ k: 1e8 } q: [x], p: [px]; H = px^2/2 + k x^2/2")
    run = stiff.integrate([1e-4], [0.0], t=1, step=0.1, method="gauss-2", solver="newton")
    assert run.parameter_derivatives("k")["k"].shape == (2,) and run.state_transition.shape == (2, 2)


def test_arrays_of_the_caller_may_change(kepler):
    q, p = np.array([[0.4, 0.0]]), np.array([[0.0, 2.0]])
    many = kepler.ensemble(q, p, t=1, step=0.05)
    run = kepler.integrate(q[0], p[0], t=1, step=0.05)
    k = np.array([1.0, 2.0])
    system = sy.system("{ k: [2] } q: [2], p: [2]; H = |p|^2/2 + sum(i: k[i] q[i]^2)/2", parameters={"k": k})
    q[:], p[:], k[:] = 5, 5, 50
    system.parameters["k"][0] = 7
    assert abs(many.energy_error).max() < 1e-9 and abs(run.energy_error).max() < 1e-9
    assert run.start[1].tolist() == [0.4, 0.0] and system.parameters["k"].tolist() == [1.0, 2.0]


def test_arrays_of_every_layout_are_taken(kepler):
    q, p = np.array([0.4, 9.0, 0.0, 9.0])[::2], np.array([2.0, 0.0])[::-1]
    expected = kepler.integrate([0.4, 0], [0, 2], t=1, step=0.05).q
    assert (kepler.integrate(q, p, t=1, step=0.05).q == expected).all()
    assert kepler.energy(q, p) == kepler.energy([0.4, 0], [0, 2])
    many = kepler.ensemble(np.broadcast_to([0.4, 0.0], (5, 2)), np.asfortranarray(np.tile([0.0, 2.0], (5, 1))), t=1, step=0.05)
    assert (many.q == expected[-1]).all()


def test_output_of_an_ensemble_is_in_equal_steps_to_the_end():
    fall = sy.system("q: [x], p: [px]; H = px^2/2 - sqrt(1 - t) x")
    many = fall.ensemble([[0.0]], [[0.0]], t=0.95, step=0.3, method="gauss-2", output=[0.95])
    alone = fall.integrate([0.0], [0.0], t=0.95, step=0.3, method="gauss-2", output=[0.95])
    assert not many.failed.any()
    np.testing.assert_allclose(many.q[0, 0], alone.q[0], atol=1e-14)
    # The last states are those at the end, also if no output is there.
    kepler = sy.system(KEPLER)
    with pytest.warns(UserWarning, match="interpolates"):
        early = kepler.ensemble([[0.4, 0.0]], [[0.0, 2.0]], t=1, step=0.3, output=[0.3])
    np.testing.assert_allclose(early.end.q[0], kepler.integrate([0.4, 0.0], [0.0, 2.0], t=1, step=0.3).q[-1], atol=1e-14)


def test_a_parameter_of_the_system_may_vary(pendulum):
    many = pendulum.with_parameters(g=[1.0, 2.0]).ensemble([[0.1]], [[0.0]], t=1, step=0.1)
    assert len(many) == 2


def test_the_step_of_a_run_is_that_of_its_equal_steps(kepler):
    assert kepler.integrate([0.4, 0], [0, 2], t=1, step=0.3).step == 0.25


def test_a_run_that_fails_ends_with_its_last_full_step():
    with pytest.raises(sy.StepError) as caught:
        sy.system("q: [x], p: [px]; H = px^2/2 - sqrt(2 - x)").integrate([0.0], [3.0], t=10, step=0.01, method="stormer-verlet", output=[0.0, 0.5, 9.0])
    run = caught.value.run
    assert run.t[-1] == run.state[0] and run.t[:2].tolist() == [0.0, 0.5] and (run.q[-1] == run.state[1]).all()
