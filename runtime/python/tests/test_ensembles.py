"""Many trajectories: arrays, sections, chaos, parameters that vary."""

import copy
import pickle

import numpy as np
import pytest

import symplectica as sy

HENON = "q: [x, y], p: [px, py]; H = (px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3"


def starts(count: int) -> tuple[np.ndarray, np.ndarray]:
    return np.linspace(0.1, 3.0, count)[:, None], np.zeros((count, 1))


@pytest.mark.parametrize("method", ["gauss-4", "blanes-moan-2002-s10", "lobatto-3"])
def test_trajectories_have_the_bits_of_single_runs(pendulum, method):
    q, p = starts(21)
    many = pendulum.ensemble(q, p, t=3, step=0.05, method=method)
    for row in (0, 7, 20):
        alone = pendulum.integrate(q[row], p[row], t=3, step=0.05, method=method, output=0)
        assert (many.q[row] == alone.state[1]).all() and (many.p[row] == alone.state[2]).all()
    assert len(many) == 21 and (many.statistics["steps"] == 60).all()


def test_results_do_not_depend_on_threads(pendulum):
    q, p = starts(50)
    one, two = (pendulum.ensemble(q, p, t=3, step=0.05, threads=threads) for threads in (1, 3))
    assert (one.q == two.q).all() and (one.p == two.p).all()


def test_output_fills_an_array_of_times(pendulum):
    q, p = starts(9)
    times = [0.0, 1.0, 2.0]
    many = pendulum.ensemble(q, p, t=2, step=0.1, method="gauss-2", output=times)
    assert many.q.shape == (9, 3, 1) and many.t.tolist() == times
    assert (many.q[:, 0] == q).all() and abs(many.energy_error).max() < 1e-3
    alone = pendulum.integrate(q[4], p[4], t=2, step=0.1, method="gauss-2", output=times)
    np.testing.assert_allclose(many.q[4], alone.q, atol=1e-14)


def test_output_inside_steps_warns_that_it_is_interpolated(pendulum):
    q, p = starts(3)
    with pytest.warns(UserWarning, match="interpolates with order 4"):
        pendulum.ensemble(q, p, t=1, step=0.1, method="gauss-8", output=[0.05, 1.0])


def test_parameters_vary_between_trajectories(pendulum):
    g = np.array([1.0, 4.0, 9.0])
    many = pendulum.ensemble([[0.5]], [[0.0]], t=2, step=0.05, method="gauss-4", parameters={"g": g})
    assert len(many) == 3 and abs(many.energy_error).max() < 1e-8
    for row, value in enumerate(g):
        alone = pendulum.integrate([0.5], [0.0], t=2, step=0.05, method="gauss-4", parameters={"g": value}, output=0)
        # A parameter that varies is not folded into constants.
        np.testing.assert_allclose(many.q[row], alone.state[1], atol=1e-13)
    with pytest.raises(sy.ArgumentError, match="values for 3 trajectories"):
        pendulum.ensemble(np.zeros((2, 1)), np.zeros((2, 1)), t=2, step=0.05, parameters={"g": g})


def test_failures_are_told_and_the_others_go_on():
    well = sy.system("q: [x], p: [px]; H = px^2/2 - sqrt(2 - x)")
    many = well.ensemble([[0.0], [0.0], [0.0]], [[-1.0], [3.0], [-2.0]], t=1, step=0.01, method="stormer-verlet")
    assert many.failed.tolist() == [False, True, False]
    failure = many.failures[0]
    assert failure.trajectory == 1 and failure.kind == "not finite" and "force" in failure.message
    assert many.end.t[1] < 1 and many.end.t[0] == 1


def test_a_section_has_the_states_on_the_plane():
    system = sy.system(HENON)
    energy, y = 1 / 12, np.linspace(-0.2, 0.3, 5)
    px = np.sqrt(2 * energy - y**2 + 2 * y**3 / 3)
    q, p = np.stack([0 * y, y], axis=1), np.stack([px, 0 * y], axis=1)
    many = system.ensemble(q, p, t=200, step=0.1, method="blanes-moan-2002-s10", section="x")
    assert many.section is not None and len(many.section) == 5
    for states in many.section:
        assert len(states) > 20 and abs(states.q[:, 0]).max() < 1e-10 and (states.p[:, 0] > 0).all()
    assert abs(many.energy_error).max() < 1e-6


def test_megno_tells_regular_from_chaotic_orbits():
    system = sy.system(HENON)
    y, py = np.array([0.2, -0.16]), np.array([0.0, 0.0])
    px = np.sqrt(0.25 - y**2 + 2 / 3 * y**3 - py**2)
    many = system.ensemble(np.stack([0 * y, y], axis=1), np.stack([px, py], axis=1), t=1000, step=0.05, method="forest-ruth-1990", megno=True)
    assert many.megno[0] < 2.5 and many.megno[1] > 10 and many.lyapunov[1] > 0.01


def test_velocities_of_many_starts_become_momenta():
    pendulum = sy.system("{ l: 2 } q: [a], v: [va]; L = l^2 va^2/2 + cos(a)")
    many = pendulum.ensemble([[0.1], [0.2]], v=[[1.0], [2.0]], t=1, step=0.1, output=[0.0])
    np.testing.assert_allclose(many.p[:, 0, 0], [4.0, 8.0])


def test_friction_damps_the_momenta_of_all_outputs():
    damped = sy.system("{ c: 0.3 } q: [x], p: [px]; H = (px^2 + x^2)/2 friction: c")
    many = damped.ensemble([[1.0], [2.0]], [[0.0], [0.0]], t=2, step=0.1, method="stormer-verlet", output=[1.0, 2.0])
    alone = damped.integrate([2.0], [0.0], t=2, step=0.1, method="stormer-verlet", output=[1.0, 2.0])
    np.testing.assert_allclose(many.p[1], alone.p, atol=1e-14)
    np.testing.assert_allclose(many.end.p[1], alone.p[-1], atol=1e-14)


def test_ensembles_pickle_and_make_tables(pendulum, tmp_path):
    q, p = starts(4)
    many = pendulum.ensemble(q, p, t=1, step=0.1, output=[0.5, 1.0], method="gauss-2")
    for other in (pickle.loads(pickle.dumps(many)), copy.copy(many)):
        assert (other.q == many.q).all() and (other.energy_error == many.energy_error).all()
    many.save(tmp_path / "many.npz")
    assert np.load(tmp_path / "many.npz")["q"].shape == (4, 2, 1)
    pytest.importorskip("pandas")
    table = many.to_pandas()
    assert list(table.columns) == ["trajectory", "t", "a", "pa"] and len(table) == 8


def test_wrong_ensembles_are_refused(pendulum):
    q, p = starts(3)
    for arguments, message in [
        ({"output": [0.1], "megno": True}, "one of"),
        ({"threads": 0}, "whole number"),
        ({"threads": 1000}, "256"),
        ({"section": "b"}, "unknown name"),
        ({"parameters": {"g": np.ones((3, 2))}}, "is a list of lists"),
    ]:
        with pytest.raises((sy.ArgumentError, sy.DefinitionError), match=message):
            pendulum.ensemble(q, p, t=1, step=0.1, **arguments)
    with pytest.raises(sy.ArgumentError, match="first axis"):
        pendulum.ensemble([1.0], [0.0], t=1, step=0.1)
    with pytest.raises(sy.ArgumentError, match="no starts"):
        pendulum.ensemble(np.zeros((0, 1)), np.zeros((0, 1)), t=1, step=0.1)
    damped = sy.system("q: [x], p: [px]; H = (px^2 + x^2)/2 friction: 0.1")
    with pytest.raises(sy.ArgumentError, match="without friction"):
        damped.ensemble(q, p, t=1, step=0.1, method="stormer-verlet", megno=True)


def test_comparisons_measure_error_and_time(pendulum):
    found = pendulum.compare(["stormer-verlet", "gauss-4"], [1.0], [0.0], t=5, steps=[0.1, 0.05], repeats=1)
    assert len(found.measurements) == 4
    error = {(entry.method, entry.step): entry.error for entry in found.measurements}
    assert 3.5 < error["stormer-verlet", 0.1] / error["stormer-verlet", 0.05] < 4.5
    assert error["gauss-4", 0.05] < 1e-9
    fastest = found.fastest(1e-6)
    assert fastest is not None and fastest.method == "gauss-4" and "stormer-verlet" in str(found)


def test_a_setup_file_runs_as_on_the_command_line(tmp_path):
    path = tmp_path / "orbits.toml"
    path.write_text(
        'system = "Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q|"\nmethod = "gauss-4"\nstep_size = 0.05\nend = 10\n'
        'starts = { "q[0]" = { from = 0.4, to = 0.8, count = 5 }, "q[1]" = 0, "p[0]" = 0, "p[1]" = 1 }\noutput = { file = "orbits.npz" }\n',
        encoding="utf-8",
    )
    assert "5 trajectories, 0 failed" in sy.run_file(path, threads=2)
    assert np.load(tmp_path / "orbits.npz")
    path.write_text('system = "q"', encoding="utf-8")
    with pytest.raises(sy.ArgumentError):
        sy.run_file(path)
