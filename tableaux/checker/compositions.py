"""Compositions of compositions of Stoermer-Verlet: each level raises the order by two, with fractions in a field of its own."""

from fractions import Fraction
from functools import lru_cache
from math import prod

from check_certificate import Stages, check_members, demand, ends, field

from .solutions import between

MAX_STEPS = 1000


def levels(numbers, layout, weights):
    """The splitting, and the orders that follow. A symmetric method of order p, composed with fractions g_i that are the same forwards and
    backwards, with sum g_i = 1 and sum g_i^(p+1) = 0, has order p + 1 (HLW II.4), and as it is symmetric, p + 2 (HLW II.3)."""
    check_members(numbers, ("kind", "levels"))
    demand(weights == {"q": [], "p": []}, "no weights, as the levels give them")
    order, steps, values = 2, [()], []
    for level in numbers["levels"]:
        check_members(level, ("polynomial", "root", "weights"))
        number = field(level["polynomial"], level["root"])
        fractions = [number(x) for x in level["weights"]]
        demand(0 < len(steps) * len(fractions) <= MAX_STEPS, f"at most {MAX_STEPS} steps")
        raises = sum(fractions) == 1 and sum(prod([x] * order, start=x) for x in fractions) == 0
        demand(fractions == fractions[::-1] and raises, f"a level to order {order + 2}")
        values.append([between(*ends(x)) for x in fractions])
        steps, order = [(fractions.index(x), *step) for x in fractions for step in steps], order + 2
    inner, outer = steps_of_verlet(steps, values[::-1])
    weights = dict(zip("pq" if layout == "kicks first" else "qp", (outer, [*inner, Fraction(0)])))
    return Stages(layout, weights, {}, {"general": 1, "separable": order, "nystrom": order, "perturbed": [order]})


def steps_of_verlet(steps, values):
    """The fractions of the flows inside and outside. Equal ones are the same object, so that a palindrome is known as one."""

    @lru_cache(maxsize=None)
    def half(step):
        return prod((level[i] for level, i in zip(values, step)), start=Fraction(1, 2))

    @lru_cache(maxsize=None)
    def both(one, other):
        return half(one) + half(other)

    between_steps = [both(*sorted(pair)) for pair in zip(steps, steps[1:])]
    return [both(step, step) for step in steps], [half(steps[0]), *between_steps, half(steps[-1])]
