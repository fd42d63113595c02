"""IAS15 of REBOUND on the orbit of the example `variable_steps`: eccentricity 0.999, 100 orbits from the apocentre.

    pip install rebound
    python tests/benchmarks/beside_rebound.py
"""

import math
import time

import rebound

ECCENTRICITY = 0.999
ROUNDS = 5


def run(epsilon):
    """Seconds, and the error of the position."""
    simulation = rebound.Simulation()
    far = 1 + ECCENTRICITY
    simulation.add(m=1.0)
    speed = math.sqrt((1 - ECCENTRICITY) / (1 + ECCENTRICITY))
    simulation.add(m=0.0, x=-far, vy=-speed)
    simulation.N_active = 1
    simulation.integrator = "ias15"
    simulation.integrator.epsilon = epsilon
    began = time.perf_counter()
    simulation.integrate(200 * math.pi)
    seconds = time.perf_counter() - began
    body, centre = simulation.particles[1], simulation.particles[0]
    return seconds, math.hypot(body.x - centre.x + far, body.y - centre.y)


print(f"REBOUND {rebound.__version__}, IAS15\n")
print("| epsilon | ms | error |\n|---|---:|---:|")
for exponent in range(5, 11):
    seconds, error = min(run(10.0**-exponent) for _ in range(ROUNDS))
    print(f"| 1e-{exponent} | {1e3 * seconds:.1f} | {error:.0e} |")
