"""Prints for how many trees `checker.rootings.turned_over` gives one whose condition is equivalent for a symplectic method.

    python3 rootings.py FOLDER

If a tree u has the tree v on its root, and the other one v the tree u, then phi(u v) + phi(v u) = phi(u) phi(v) where
b_i a_ij + b_j a~_ji = b_i b_j. Here phi is that of a method with random b and a.
"""

import random
import sys
from fractions import Fraction

sys.path.insert(0, sys.argv[1])

from check_certificate import Stages, density, residuals, trees
from checker.rootings import turned_over

random.seed(1)
STAGES = range(3)
b = [Fraction(random.randint(1, 9), 7) for _ in STAGES]
a = [[Fraction(random.randint(-9, 9), 5) for _ in STAGES] for _ in STAGES]
a_tilde = [[b[j] - b[j] * a[j][i] / b[i] for j in STAGES] for i in STAGES]
residual = residuals(Stages("matrices", {"q": b, "p": b}, {"q": a, "p": a_tilde}))


def phi(tree):
    return residual(tree) + Fraction(1, density(tree))


def is_equivalent(tree, i):
    (colour, children), turned = tree, turned_over(tree, i)
    parts = (colour, children[:i] + children[i + 1 :]), children[i]
    return phi(tree) + phi(turned) == phi(parts[0]) * phi(parts[1])


found = [is_equivalent(t, i) for n in range(2, 6) for t in trees(n, "general") for i in range(len(t[1]))]
print(found.count(True), "of", len(found))
