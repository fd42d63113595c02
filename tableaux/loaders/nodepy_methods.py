"""What nodepy holds of every Runge–Kutta method, and what it says of the order."""

import contextlib
import glob
import struct
import sys
from importlib.metadata import version

import sympy
from nodepy.runge_kutta_method import RungeKuttaMethod

# nodepy evaluates the conditions up to this order, in doubles; and exactly, where that takes seconds only.
HIGHEST = 13
EXACTLY = 2


def shown(values):
    return " ".join(struct.pack(">d", float(x)).hex() for x in values)


print(f"version nodepy {version('nodepy')}, SymPy {sympy.__version__}")
for path in sorted(glob.glob("*.nodepy")):
    holds = {}
    with open(path) as file, contextlib.redirect_stdout(sys.stderr):
        exec(compile(file.read(), path, "exec"), holds)
        name, method = next((n, m) for n, m in holds.items() if isinstance(m, RungeKuttaMethod))
        order = method.order()
        exact = method.order(mode="exact") if len(method) <= EXACTLY else order
    print(name, "a", shown(method.A.flatten()))
    print(name, "b", shown(method.b))
    print(name, "least" if order == HIGHEST else "order", order)
    print(name, "least" if order == HIGHEST else "order", exact)
