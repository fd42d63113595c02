"""Numbers in Q(theta)(X), where X is transcendental: pi, exp(1/n) or tan(1/n). An identity with X as a variable holds for the number X."""

import math
import re
from fractions import Fraction
from itertools import accumulate

from check_certificate import UNIT, Number, common_divisor, demand, ends, field, primitive, product

MAX_DEGREE = 40
TERMS = 120  # Of an alternating series.


class Quotient(Number):
    """f(X)/g(X), where X lies between two positive ends. Two are equal if the products across are."""

    def __init__(self, x, numerator, denominator):
        self.x, (self.numerator, self.denominator) = x, reduced(trimmed(numerator), trimmed(denominator))
        demand(self.denominator, "a denominator that is not zero")

    def __add__(self, other):
        f, g = parts(other)
        if g == self.denominator:
            return Quotient(self.x, plus(self.numerator, f), g)
        return Quotient(self.x, plus(product(self.numerator, g), product(f, self.denominator)), product(self.denominator, g))

    def __mul__(self, other):
        f, g = parts(other)
        return Quotient(self.x, product(self.numerator, f), product(self.denominator, g))

    def __eq__(self, other):
        return not (self - other)

    def __bool__(self):
        return bool(self.numerator)

    def ends(self):
        if not self.numerator:
            return Fraction(0), Fraction(0)
        above, below = (value_between(f, self.x) for f in (self.numerator, self.denominator))
        demand(below[0] > 0 or below[1] < 0, "a denominator that is not zero")
        found = [a / b for a in above for b in below]
        return Fraction(math.floor(min(found) * UNIT), UNIT), Fraction(math.ceil(max(found) * UNIT), UNIT)

    def rational(self):
        """The same number, as a fraction if it is one."""
        constant = len(self.numerator) == len(self.denominator) == 1 and all(isinstance(f[0], Fraction) for f in parts(self))
        return self.numerator[0] / self.denominator[0] if constant else self


def parts(x):
    return (x.numerator, x.denominator) if isinstance(x, Quotient) else ([x] if x else [], [Fraction(1)])


def trimmed(f):
    """Without zeros at the end."""
    return f[: max((k + 1 for k, c in enumerate(f) if c), default=0)]


def plus(f, g):
    return [x + y for x, y in zip(f, g)] + f[len(g) :] + g[len(f) :]


def reduced(f, g):
    """Without common factors, or without common powers of X if there are irrational coefficients."""
    if all(isinstance(c, (int, Fraction)) for c in f + g) and f and g:
        divisor = common_divisor(primitive(f), primitive(g))
        f, g = divided(f, divisor), divided(g, divisor)
        return [c / g[-1] for c in f], [c / g[-1] for c in g]
    while f and g and not f[0] and not g[0]:
        f, g = f[1:], g[1:]
    return f, g


def divided(f, g):
    """The quotient by a divisor."""
    found, rest = [], [Fraction(c) for c in f]
    while len(rest) >= len(g):
        found.append(rest[-1] / g[-1])
        shift = len(rest) - len(g)
        rest = [c - found[-1] * g[k - shift] if k >= shift else c for k, c in enumerate(rest[:-1])]
    return found[::-1]


def value_between(f, x):
    """The ends of f(x) for a positive x between two ends."""
    terms = [[c * y**k for c in ends(coefficient) for y in x] for k, coefficient in enumerate(f)]
    return sum(map(min, terms)), sum(map(max, terms))


def alternating(term):
    """The ends of an alternating series: two partial sums."""
    return sorted([*accumulate(map(term, range(TERMS + 1)))][-2:])


def arctangent(n):
    return alternating(lambda k: Fraction((-1) ** k, (2 * k + 1) * n ** (2 * k + 1)))


def transcendental(text):
    """The ends of X: pi by Machin's formula, exp(1/n) from exp(-1/n), tan(1/n) from sine and cosine."""
    if text == "pi":
        fifth, other = arctangent(5), arctangent(239)
        return 16 * fifth[0] - 4 * other[1], 16 * fifth[1] - 4 * other[0]
    known = isinstance(text, str) and re.fullmatch(r"(exp|tan)\(1/([1-9][0-9]{0,2})\)", "exp(1/1)" if text == "e" else text)
    demand(known, f"a number X that is known, not {str(text):.40}")
    n = int(known[2])
    if known[1] == "exp":
        low, high = alternating(lambda k: Fraction((-1) ** k, n**k * math.factorial(k)))
        return 1 / high, 1 / low
    sine, cosine = (alternating(lambda k: Fraction((-1) ** k, n ** (2 * k + d) * math.factorial(2 * k + d))) for d in (1, 0))
    return sine[0] / cosine[1], sine[1] / cosine[0]


def functions(numbers):
    """The function that reads numbers: numerator and denominator, each with a list for each power of X."""
    number, x = field(numbers["polynomial"], numbers["root"]), transcendental(numbers["variable"])
    x = Fraction(math.floor(x[0] * UNIT), UNIT), Fraction(math.ceil(x[1] * UNIT), UNIT)

    def read(pair):
        demand(len(pair) == 2 and all(len(f) <= MAX_DEGREE for f in pair), "a numerator and a denominator of bounded degree")
        return Quotient(x, *([number(c) for c in f] for f in pair))

    return read
