"""Roots of polynomials whose coefficients are known between two rational numbers."""

import math
from fractions import Fraction

from check_certificate import demand, over_one_denominator, value

NARROW = Fraction(1, 1 << 160)  # The distance between the ends of a root,
MAX_CELLS = 1000  # and the number of intervals that are looked at for all of them.


class Undecided(Exception):
    """Roots that may be multiple ones, or numbers that are not known well enough."""


def with_whole_ends(f):
    """The coefficients times a positive number that makes all ends whole."""
    _, common = over_one_denominator([end for c in f for end in c])
    return [tuple(int(end * common) for end in c) for c in f]


def simple_roots(f):
    """The ends of all positive roots in order. A coefficient is a pair of whole ends. Where f is not known to have no root, it is monotone."""
    found, rest = [], [(Fraction(0), above_roots(f))]
    for _ in range(MAX_CELLS):
        if not rest:
            return found
        low, high = rest.pop()
        # The coefficients of f(middle + half t) times a positive number, for |t| up to 1.
        terms = list(zip(*(shifted(g, (low + high) / 2, (high - low) / 2) for g in zip(*f))))
        if sign_of_sum(terms):
            continue
        if sign_of_sum([(k * x, k * y) for k, (x, y) in enumerate(terms)][1:]):
            if sign(f, low) != sign(f, high):
                found.append(narrowed(f, low, high))
            continue
        # Not in the middle, where roots may be.
        cut = low + (high - low) * Fraction(131, 256)
        rest += [(cut, high), (low, cut)]
    raise Undecided


def above_roots(f):
    """A number from which the highest term is larger than all others together."""
    *rest, (low, high) = f
    demand(low > 0 or high < 0, "a highest coefficient that is not zero")
    bound, highest = Fraction(1), max(low, -high)
    while value([max(-x, y) for x, y in rest], bound) >= highest * bound ** len(rest):
        bound *= 2
    return bound


def shifted(f, x, width):
    """The coefficients of f(x + width t) times a positive number, in whole numbers."""
    step, degree = math.lcm(x.denominator, width.denominator), len(f) - 1
    x, width = int(x * step), int(width * step)
    f = [c * step ** (degree - k) for k, c in enumerate(f)]
    for start in range(degree):
        for k in range(degree - 1, start - 1, -1):
            f[k] += x * f[k + 1]
    return [c * width**k for k, c in enumerate(f)]


def numerator(f, x):
    """f(x) for whole coefficients, times the power of the denominator of x that makes it whole. It has the sign of f(x)."""
    total, power, x, step = 0, 1, x.numerator, x.denominator
    for c in reversed(f):
        total, power = total * x + c * power, power * step
    return total


def sign_of_sum(terms):
    """The sign of the first term if it is larger than all others together, else 0."""
    (low, high), *rest = terms
    others = sum(max(-x, y) for x, y in rest)
    return (low > others) - (high < -others)


def sign(f, x):
    """The sign at a number that is not negative."""
    low, high = (numerator(g, x) for g in zip(*f))
    if low <= 0 <= high:
        raise Undecided
    return 1 if low > 0 else -1


def narrowed(f, low, high):
    """The ends of the root between two numbers where the signs differ, as near to each other as f is known."""
    before = sign(f, low)
    while high - low > NARROW:
        middle = (low + high) / 2
        if not any(numerator(g, middle) for g in zip(*f)):
            return middle, middle  # Coefficients that are known exactly have a root that is.
        try:
            low, high = (middle, high) if sign(f, middle) == before else (low, middle)
        except Undecided:
            break
    return low, high
