"""heyoka's batch mode on the ensembles of the example `beside_heyoka`, one core.

    pip install heyoka numpy
    python tests/benchmarks/beside_heyoka.py [lanes]
"""

import sys
import time

import heyoka
import numpy

TARGETS = [1e-4, 1e-6, 1e-8, 1e-10]
LANES = int(sys.argv[1]) if len(sys.argv) > 1 else heyoka.recommended_simd_size()
ROUNDS = 3
X, Y, P, R = heyoka.make_vars("x", "y", "px", "py")


def ends(equations, starts, end, tolerance):
    """The positions at the end, and the seconds of the fastest of some runs."""
    run = heyoka.taylor_adaptive_batch(
        equations, numpy.zeros((4, LANES)), tol=tolerance
    )
    fastest = float("inf")
    for _ in range(ROUNDS):
        seconds, found = 0.0, []
        for first in range(0, starts.shape[1], LANES):
            run.set_time(0.0)
            run.state[:] = starts[:, first : first + LANES]
            began = time.perf_counter()
            run.propagate_until(end)
            seconds += time.perf_counter() - began
            found.append(run.state[:2].copy())
        fastest = min(fastest, seconds)
    return numpy.hstack(found), fastest


def table(name, equations, starts, end, exact):
    """The fastest run for every error."""
    runs = []
    for exponent in numpy.arange(2.0, 16.0, 0.5):
        found, seconds = ends(equations, starts, end, 10.0**-exponent)
        runs.append((seconds, numpy.hypot(*(found - exact)).max(), exponent))
    for target in TARGETS:
        good = [run for run in runs if run[1] < target]
        if good:
            seconds, error, exponent = min(good)
            print(f"| {name} | {target:.0e} | 1e-{exponent} | {error:.0e} | {seconds:.4f} |")


print(f"heyoka {heyoka.__version__}, {LANES} lanes\n")
print("| ensemble | error below | tolerance | error | seconds |")
print("|---|---:|---:|---:|---:|")

cube = (X * X + Y * Y) ** -1.5
e = 0.3 * numpy.arange(4096) / 4096
orbits = numpy.array([1 - e, 0 * e, 0 * e, numpy.sqrt((1 + e) / (1 - e))])
table(
    "4096 Kepler orbits, e < 0.3, 32 periods",
    [(X, P), (Y, R), (P, -X * cube), (R, -Y * cube)],
    orbits,
    64 * numpy.pi,
    orbits[:2],
)
y = -0.1 + 0.2 * numpy.arange(1024) / 1024
stars = numpy.array([0 * y, y, 0.3 + 0 * y, 0 * y])
equations = [(X, P), (Y, R), (P, -X - 2 * X * Y), (R, -Y - X * X + Y * Y)]
exact, _ = ends(equations, stars, 128.0, 1e-18)
table("1024 Hénon–Heiles orbits to t = 128", equations, stars, 128.0, exact)
