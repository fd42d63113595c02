"""Time of one trajectory with a global error of 1e-9: this package beside heyoka.py, REBOUND's IAS15, SciPy's and numbalsoda's DOP853.

    pip install ./runtime/python heyoka numba numbalsoda rebound scipy
    python runtime/python/benchmarks/single_runs.py

A method or a tolerance is chosen by its error against a reference of this package; every time is the median of whole runs, from the call
until the end state is an array. Compilation (of heyoka's code, of numba's right-hand sides) is not counted, except in the last table: the
time from a new formula to its first result. Packages that are not installed are left out.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from importlib.util import find_spec

import numpy as np

import symplectica as sy

ERROR = 1e-9
ROUNDS = 7
METHODS = ("gauss-8", "gauss-6", "sofroniou-spaletta-2005-s35odr10", "blanes-moan-2002-s10", "blanes-moan-2002-srkn14a")
EVERY_H = ("gauss-8", "gauss-6", "gauss-4")

MASSES = [1.00000597682, 0.000954786104043, 0.000285583733151, 0.0000437273164546, 0.0000517759138449, 1 / 1.3e8]
PLACES = [[0, 0, 0], [-3.5023653, -3.8169847, -1.5507963], [9.0755314, -3.0458353, -1.6483708], [8.310142, -16.2901086, -7.2521278],
          [11.4707666, -25.7294829, -10.8169456], [-15.5387357, -25.2225594, -3.1902382]]
SPEEDS = [[0, 0, 0], [0.00565429, -0.0041249, -0.00190589], [0.00168318, 0.00483525, 0.00192462], [0.00354178, 0.00137102, 0.00055029],
          [0.0028893, 0.00114527, 0.00039677], [0.00276725, -0.00170702, -0.00136504]]
G = 2.95912208286e-4


class Scene:
    """A system, a start and an end, in this package and as a right-hand side y' = f(y) for the others."""

    def __init__(self, name: str, formula: str, q: list, p: list, end: float, steps: list[float], rhs: str, *, masses: bool = False) -> None:
        self.name, self.formula, self.q, self.p, self.end, self.steps, self.rhs, self.masses = name, formula, np.array(q, float), np.array(p, float), end, steps, rhs, masses
        self.system = sy.system(formula, parameters={"m": MASSES} if masses else None)
        exact = self.system.integrate(self.q, self.p, t=end, step=steps[-1] / 4, method="gauss-8", output=0)
        self.exact = np.concatenate([exact.state[1].ravel(), exact.state[2].ravel()])

    def error(self, end: np.ndarray) -> float:
        half = self.exact.size // 2
        return float(np.linalg.norm(end[:half] - self.exact[:half]) / np.linalg.norm(self.exact[:half]))


def planets_rhs() -> str:
    """The right-hand side of the planets, written out."""
    lines = [f"d[{k}] = y[{18 + k}]/{MASSES[k // 3]!r}" for k in range(18)]
    pairs: dict[int, list[str]] = {k: [] for k in range(18)}
    for i in range(6):
        for j in range(i + 1, 6):
            lines += [f"x{i}{j}_{k} = y[{3 * i + k}] - y[{3 * j + k}]" for k in range(3)]
            lines.append(f"c{i}{j} = {G * MASSES[i] * MASSES[j]!r}*(x{i}{j}_0*x{i}{j}_0 + x{i}{j}_1*x{i}{j}_1 + x{i}{j}_2*x{i}{j}_2)**(-1.5)")
            for k in range(3):
                pairs[3 * i + k].append(f"- c{i}{j}*x{i}{j}_{k}")
                pairs[3 * j + k].append(f"+ c{i}{j}*x{i}{j}_{k}")
    lines += [f"d[{18 + k}] = 0.0 " + " ".join(terms) for k, terms in pairs.items()]
    return "\n".join(lines)


def springs_rhs(n: int) -> str:
    """The right-hand side of the chain of Fermi, Pasta, Ulam and Tsingou."""
    place = ["0.0", *[f"y[{k}]" for k in range(n)], "0.0"]
    lines = [f"d[{k}] = y[{n + k}]" for k in range(n)]
    lines += [f"s{k} = {place[k + 1]} - {place[k]}" for k in range(n + 1)]
    lines += [f"f{k} = s{k} + s{k}*s{k}*s{k}" for k in range(n + 1)]
    lines += [f"d[{n + k}] = f{k + 1} - f{k}" for k in range(n)]
    return "\n".join(lines)


DOUBLE = """c = cos(y[0] - y[1])
s = sin(y[0] - y[1])
n = 1.0 + s*s
k = (y[2]*y[2] + 2.0*y[3]*y[3] - 2.0*y[2]*y[3]*c)/(n*n)
d[0] = (y[2] - y[3]*c)/n
d[1] = (2.0*y[3] - y[2]*c)/n
d[2] = k*s*c - y[2]*y[3]*s/n - 19.6*sin(y[0])
d[3] = -k*s*c + y[2]*y[3]*s/n - 9.8*sin(y[1])"""

SCENES = [
    lambda: Scene("Kepler, e = 0.6", "q: [2], p: [2]; H = |p|^2/2 - 1/|q|", [0.4, 0], [0, 2], 125.0, [0.4, 0.3, 0.2, 0.14, 0.1, 0.07, 0.05, 0.03],
                  "c = (y[0]*y[0] + y[1]*y[1])**(-1.5)\nd[0] = y[2]\nd[1] = y[3]\nd[2] = -y[0]*c\nd[3] = -y[1]*c"),
    lambda: Scene("Hénon–Heiles", "q: [x, y], p: [px, py]; H = (px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3", [0, 0.1], [0.3, 0.35], 300.0,
                  [1.5, 1.2, 1.0, 0.8, 0.6, 0.45, 0.3, 0.2, 0.15, 0.1], "d[0] = y[2]\nd[1] = y[3]\nd[2] = -y[0] - 2.0*y[0]*y[1]\nd[3] = -y[1] - y[0]*y[0] + y[1]*y[1]"),
    lambda: Scene("Outer planets", "{ m: [..], G: 2.95912208286e-4 } q: [..; 3], p: [..; 3]; H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)",
                  PLACES, [[m * v for v in speed] for m, speed in zip(MASSES, SPEEDS, strict=True)], 100_000.0, [1500, 1200, 1000, 800, 600, 450, 300, 200, 120, 80],
                  planets_rhs(), masses=True),
    lambda: Scene("Double pendulum", "q: [a, b], p: [pa, pb]; let d = a - b; H = (pa^2 + 2 pb^2 - 2 pa pb cos(d))/(2 (1 + sin(d)^2)) - 9.8 (2 cos(a) + cos(b))",
                  [0.6, 0.4], [0, 0.1], 30.0, [0.2, 0.15, 0.1, 0.07, 0.05, 0.03, 0.02], DOUBLE),
    lambda: Scene("FPUT springs, N = 32", "q: [..], p: [..]; bonds: walls; H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + d^4/4)",
                  [0.5 * np.sin(np.pi * (k + 1) / 33) for k in range(32)], [0.0] * 32, 100.0, [1.0, 0.8, 0.6, 0.4, 0.3, 0.2, 0.15, 0.1, 0.07, 0.05], springs_rhs(32)),
]


def median(run: Callable[[], object]) -> float:
    """The median time of some runs."""
    times = []
    for _ in range(ROUNDS):
        before = time.perf_counter()
        run()
        times.append(time.perf_counter() - before)
    return statistics.median(times)


def ours(scene: Scene) -> tuple[float, str] | None:
    found = []
    for name in METHODS if scene.system.is_separable else EVERY_H:
        for step in scene.steps:
            def run() -> sy.Run:
                return scene.system.integrate(scene.q, scene.p, t=scene.end, step=step, method=name, output=0)

            try:
                _, q, p = run().state
            except sy.StepError:
                continue
            if scene.error(np.concatenate([q.ravel(), p.ravel()])) < ERROR:
                found.append((median(run), f"{name}, h = {step:g}"))
                break
    return min(found, default=None)


def by_tolerance(scene: Scene, run: Callable[[float], np.ndarray]) -> tuple[float, str] | None:
    for exponent in np.arange(6.0, 16.0, 0.5):
        try:
            end = run(10.0**-exponent)
        except Exception:
            continue
        if scene.error(end) < ERROR:
            return median(lambda: run(10.0**-exponent)), f"tolerance 1e-{exponent:g}"
    return None


def python_function(scene: Scene, arguments: str = "t, y") -> Callable:
    code = f"def f({arguments}):\n    d = np.empty({scene.exact.size})\n    " + scene.rhs.replace("\n", "\n    ") + "\n    return d\n"
    names = {"np": np, "sin": np.sin, "cos": np.cos}
    exec(code, names)
    return names["f"]


def scipy(scene: Scene) -> tuple[float, str] | None:
    from scipy.integrate import solve_ivp

    function, start = python_function(scene), np.concatenate([scene.q.ravel(), scene.p.ravel()])
    return by_tolerance(scene, lambda tolerance: solve_ivp(function, (0, scene.end), start, "DOP853", t_eval=[scene.end], rtol=max(tolerance, 3e-14), atol=tolerance * 1e-3).y[:, -1])


def numbalsoda(scene: Scene) -> tuple[float, str] | None:
    import math

    import numba
    from numbalsoda import dop853, lsoda_sig

    code = "def f(t, y, d, p):\n    " + scene.rhs.replace("\n", "\n    ") + "\n"
    names = {"sin": math.sin, "cos": math.cos}
    exec(code, names)
    address = numba.cfunc(lsoda_sig)(names["f"]).address
    start, times = np.concatenate([scene.q.ravel(), scene.p.ravel()]), np.array([0.0, scene.end])

    def run(tolerance: float) -> np.ndarray:
        states, success = dop853(address, start, times, rtol=max(tolerance, 3e-14), atol=tolerance * 1e-3)
        if not success:
            raise ArithmeticError
        return states[-1]

    return by_tolerance(scene, run)


def heyoka_equations(scene: Scene) -> list:
    import heyoka

    y = heyoka.make_vars(*[f"y{k}" for k in range(scene.exact.size)])
    names = {"y": y, "d": {}, "sin": heyoka.sin, "cos": heyoka.cos}
    exec(scene.rhs, names)
    return [(y[k], names["d"][k] + 0.0 * y[k] if isinstance(names["d"][k], float) else names["d"][k]) for k in range(scene.exact.size)]


def heyoka(scene: Scene) -> tuple[float, str] | None:
    import heyoka as hy

    equations, start = heyoka_equations(scene), np.concatenate([scene.q.ravel(), scene.p.ravel()])
    made: dict[float, object] = {}

    def run(tolerance: float) -> np.ndarray:
        if tolerance not in made:
            made[tolerance] = hy.taylor_adaptive(equations, start.copy(), tol=tolerance)
        integrator = made[tolerance]
        integrator.time = 0.0
        integrator.state[:] = start
        integrator.propagate_until(scene.end)
        return integrator.state.copy()

    return by_tolerance(scene, run)


def rebound(scene: Scene) -> tuple[float, str] | None:
    if not (scene.masses or scene.name.startswith("Kepler")):
        return None
    import rebound as rb

    def run(tolerance: float) -> np.ndarray:
        simulation = rb.Simulation()
        if scene.masses:
            simulation.G = G
            for m, q, v in zip(MASSES, PLACES, SPEEDS, strict=True):
                simulation.add(m=m, x=q[0], y=q[1], z=q[2], vx=v[0], vy=v[1], vz=v[2])
        else:
            simulation.add(m=1.0)
            simulation.add(m=0.0, x=0.4, vy=2.0)
        simulation.integrator = "ias15"
        simulation.integrator.epsilon = tolerance
        simulation.integrate(scene.end)
        places = [[b.x, b.y, b.z] for b in simulation.particles]
        if scene.masses:
            return np.concatenate([np.ravel(places), np.zeros(18)])
        return np.concatenate([places[1][:2], [0.0, 0.0]])

    return by_tolerance(scene, run)


PEERS = {"heyoka": heyoka, "rebound": rebound, "scipy": scipy, "numbalsoda": numbalsoda}


def shown(found: tuple[float, str] | None) -> str:
    return "–" if found is None else f"{found[0] * 1e3:.3g} ms ({found[1]})"


def first_results() -> None:
    """The time from a new formula to its first result."""
    print("\n| formula | first result |\n|---|---:|")
    for number, scene in enumerate((SCENES[0](), SCENES[2]())):
        times = []
        for round_ in range(5):
            # A formula that no cache has seen.
            text = scene.formula.replace("H =", f"let c{round_} = {number + 2}; H =")
            before = time.perf_counter()
            system = sy.system(text, parameters={"m": MASSES} if scene.masses else None)
            system.integrate(scene.q, scene.p, t=scene.steps[0], step=scene.steps[0], method="gauss-8", output=0)
            times.append(time.perf_counter() - before)
        print(f"| {scene.name} | {statistics.median(times) * 1e3:.2f} ms |")


def main() -> None:
    peers = {name: peer for name, peer in PEERS.items() if find_spec(name)}
    print(f"| one trajectory to {ERROR:g} | symplectica | " + " | ".join(peers) + " |")
    print("|---|" + "---:|" * (1 + len(peers)))
    for make in SCENES:
        scene = make()
        cells = [shown(ours(scene)), *[shown(peer(scene)) for peer in peers.values()]]
        print(f"| {scene.name} | " + " | ".join(cells) + " |", flush=True)
    first_results()


if __name__ == "__main__":
    main()
