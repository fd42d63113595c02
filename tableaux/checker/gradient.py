"""Splittings with gradient kicks, for a quadratic T: p += h (b~_i f + 2 g_i h^2 f' f/M) with the force f = -dU/dq (Chin 1997).

Expanded about the start of the step, f' f/M is made of trees whose root, of the colour p, has a child q[v]. The children of v are forces at
the same stage as the other children of the root. So in place of b~_i Phi_i there is b~_i Phi_i + 2 g_i sum_v Phi_i(the children of both).
A kick by another potential is symplectic too, and the flow of [B, [A, B]] commutes with that of B.
"""

from fractions import Fraction
from functools import lru_cache
from itertools import accumulate

from check_certificate import Stages, demand, density, fits, product

from .functions import trimmed
from .splittings import is_zero


class GradientKicks(Stages):
    """A splitting with the weights g."""

    def __init__(self, layout, weights, solved=None):
        super().__init__(layout, weights, {}, solved)
        demand(len(weights["g"]) == self.s, "a gradient weight for each stage")

    def residuals(self):
        """As for other methods, for trees of a quadratic T."""

        @lru_cache(maxsize=None)
        def terms(tree):
            colour, children = tree
            found = self.times(self.weights[colour], values(children))
            for k, (_, forces) in enumerate(children) if colour == "p" else ():
                for _, below in forces:
                    both = self.times(self.weights["g"], values(children[:k] + children[k + 1 :] + below))
                    found = [x + y * 2 for x, y in zip(found, both)]
            return found

        @lru_cache(maxsize=None)
        def stages(tree):
            sums = list(accumulate(terms(tree), initial=Fraction(0)))
            return sums[1:] if tree[0] == self.first else sums[:-1]

        @lru_cache(maxsize=None)
        def values(children):
            return self.times(values(children[:-1]), stages(children[-1])) if children else self.one

        def residual(tree):
            demand(fits(tree, "nystrom"), "trees of a quadratic T")
            return sum(terms(tree), Fraction(0)) - Fraction(1, density(tree))

        return residual

    def one_step(self):
        """The step of the oscillator as in `stability`: a kick is p -= nu (b~ - 2 g z) q."""
        add = lambda f, g: trimmed([x + y for x, y in zip(f + [Fraction(0)] * len(g), g + [Fraction(0)] * len(f))])
        m11, m12, m21, m22 = [Fraction(1)], [], [], [Fraction(1)]
        for drift, kick, g in zip(*(self.weights[colour] for colour in "qpg")):
            for colour in "pq" if self.first == "p" else "qp":
                if colour == "q":
                    m11, m12 = add(m11, product([Fraction(0), drift * -1], m21)), add(m12, product([drift], m22))
                else:
                    m21 = add(m21, product([kick, g * -2], m11))
                    m22 = add(m22, product([Fraction(0), kick * -1, g * 2], m12))
        return [Fraction(1)], {name: trimmed(f) for name, f in (("11", m11), ("12", m12), ("21", m21), ("22", m22))}


def gradient(layout, weights, solved=None):
    """The splitting with these weights: of orders that follow from conditions that were solved, that for a quadratic T."""
    known = {"nystrom": solved["nystrom"]} if solved else None
    demand(not all(map(is_zero, weights["g"])), "a gradient weight that is not zero")
    return GradientKicks(layout, weights, known)
