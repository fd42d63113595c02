"""Exact numbers, and intervals with exact ends: everything that is decided is decided with these."""

import math
import re
from fractions import Fraction

UNIT = 1 << 400  # The ends of intervals are whole multiples of 1/UNIT.
NARROW = 1 << 250  # Roots are enclosed between multiples of 1/NARROW.
TIE = Fraction(1, 1 << 240)  # What is nearer to the middle between two decimals may be rounded to both.
MOST_DEGREE = 100  # Of polynomials that define nodes and fields,
MOST_DIGITS = 3000  # and of their coefficients, all as long as the longest.


class Rejected(Exception):
    """A claim that does not hold."""


def demand(holds, claim):
    if not holds:
        raise Rejected(claim)


def rationals(texts):
    demand(isinstance(texts, list) and len(texts) <= 1000, "a list of rational numbers")
    for text in texts:
        known = isinstance(text, str) and re.fullmatch(r"-?[0-9]{1,500}(/[0-9]{1,500})?", text)
        demand(known, f"a rational number, not {str(text):.40}")
    return [Fraction(text) for text in texts]


def whole(x):
    demand(type(x) is int and 0 <= x <= 1000, f"a whole number up to 1000, not {str(x):.40}")
    return x


def monic(texts):
    """A polynomial with whole coefficients without a common factor, which is one of its multiples, divided by the last of them."""
    f = rationals(texts)
    demand(1 < len(f) <= MOST_DEGREE, f"a polynomial of degree 1 to {MOST_DEGREE - 1}")
    demand(len(f) * max(map(len, texts)) <= MOST_DIGITS, f"a polynomial with at most {MOST_DIGITS} digits")
    primitive = all(c.denominator == 1 for c in f) and math.gcd(*(c.numerator for c in f)) == 1
    demand(f[-1] > 0 and primitive, "a polynomial with coprime whole coefficients")
    return [c / f[-1] for c in f]


# Polynomials with rational coefficients of 1, x, x^2, ...


def value(f, x):
    total = Fraction(0)
    for c in reversed(f):
        total = total * x + c
    return total


def product(f, g, zero=Fraction(0)):
    found = [zero] * max(len(f) + len(g) - 1, 0)
    for i, x in enumerate(f):
        if x:
            for j, y in enumerate(g):
                found[i + j] += x * y
    return found


def trimmed(f):
    f = list(f)
    while f and f[-1] == 0:
        f.pop()
    return f


def combined(f, x, g, y):
    """x f + y g"""
    longest = max(len(f), len(g))
    f, g = (list(h) + [Fraction(0)] * (longest - len(h)) for h in (f, g))
    return trimmed(x * u + y * v for u, v in zip(f, g))


def divided(f, g):
    """The quotient and the remainder."""
    f, quotient = list(f), [Fraction(0)] * max(len(f) - len(g) + 1, 0)
    for k in reversed(range(len(quotient))):
        quotient[k] = f[k + len(g) - 1] / g[-1]
        for i, c in enumerate(g):
            f[k + i] -= quotient[k] * c
    return quotient, trimmed(f[: len(g) - 1])


def reduced(f, m):
    """The remainder, with as many coefficients as the degree of m, whose last coefficient is 1."""
    rest = divided(f, m)[1]
    return rest + [Fraction(0)] * (len(m) - 1 - len(rest))


class Quotient:
    """Products in Q[x]/m, in whole numbers over one denominator."""

    def __init__(self, m):
        degree = len(m) - 1
        powers = [reduced([Fraction(0)] * k + [Fraction(1)], m) for k in range(degree, 2 * degree - 1)]
        self.denominator = math.lcm(*(c.denominator for power in powers for c in power))
        self.powers = [[(i, int(c * self.denominator)) for i, c in enumerate(power) if c] for power in powers]

    def product(self, f, g):
        (f, d), (g, e) = over_one_denominator(f), over_one_denominator(g)
        all_ = product(f, g, 0)
        found = [x * self.denominator for x in all_[: len(f)]]
        for x, power in zip(all_[len(f) :], self.powers):
            for i, c in power if x else ():
                found[i] += x * c
        return [Fraction(x, d * e * self.denominator) for x in found]


def common_divisor(f, g):
    while g:
        f, g = g, divided(f, g)[1]
        g = [c / g[-1] for c in g]
    return f


def derivative(f):
    return [k * c for k, c in enumerate(f)][1:]


def square_free(f):
    return divided(f, common_divisor(f, derivative(f)))[0]


class Roots:
    """The real roots of a polynomial without multiple ones, each as a pair of rationals around it, equal ones for a rational root."""

    def __init__(self, f):
        # A Sturm chain: its changes of sign count the roots.
        chain = [f, derivative(f)]
        while len(chain[-1]) > 1:
            rest = divided(chain[-2], chain[-1])[1]
            demand(rest, "a polynomial without multiple roots")
            chain.append([-c / abs(rest[-1]) for c in rest])
        self.chain = [over_one_denominator(g)[0] for g in chain]
        self.bound = 1 + max(abs(c / f[-1]) for c in f)

    def sign(self, x):
        return sign(self.chain[0], x.numerator, x.denominator)

    def count(self, low, high):
        return self.changes(low) - self.changes(high)

    def changes(self, x):
        signs = [s for s in (sign(f, x.numerator, x.denominator) for f in self.chain) if s]
        return sum(a != b for a, b in zip(signs, signs[1:]))

    def all(self):
        return self.above(-self.bound)

    def above(self, low):
        found, rest = [], [(low, self.bound, self.changes(low), self.changes(self.bound))]
        while rest:
            low, high, more, fewer = rest.pop()
            if more - fewer == 1 and not self.sign(high):
                found.append((high, high))
            elif more - fewer == 1 and self.sign(low):
                found.append(self.narrowed(low, high))
            elif more > fewer:
                middle = (low + high) / 2
                here = self.changes(middle)
                rest += [(low, middle, more, here), (middle, high, here, fewer)]
        return sorted(found)

    def narrowed(self, low, high):
        """A narrower enclosure of the one root between these."""
        before = self.sign(low)
        while high - low > Fraction(1, 1 << 20):
            middle = (low + high) / 2
            low, high = (middle, high) if self.sign(middle) == before else (low, middle)
        simple = ((low + high) / 2).limit_denominator(1000)
        if low <= simple <= high and not self.sign(simple):
            return (simple, simple)
        first, last = math.ceil(low * NARROW), math.floor(high * NARROW)
        while last - first > 1:
            middle = (first + last) // 2
            first, last = (middle, last) if sign(self.chain[0], middle, NARROW) == before else (first, middle)
        low, high = Fraction(first, NARROW), Fraction(last, NARROW)
        demand(self.sign(low) == before and self.sign(high) != before, "a root between multiples of 2^-250")
        return (low, high)


def over_one_denominator(f):
    """Whole coefficients, and what they are to be divided by."""
    common = math.lcm(*(c.denominator for c in f))
    return [c.numerator * (common // c.denominator) for c in f], common


def sign(f, numerator, denominator):
    """That of the value of a polynomial with whole coefficients."""
    total, power = 0, 1
    for c in reversed(f):
        total, power = total * numerator + c * power, power * denominator
    return (total > 0) - (total < 0)


def has_root(f, root):
    """Whether a polynomial that has no other root there has this one."""
    return value(f, root[0]) == 0 or value(f, root[0]) * value(f, root[1]) < 0


# Numbers: rationals; elements of a field; intervals; intervals with derivatives. All have + and *, with rationals too.


class Number:
    """What follows from + and *."""

    def __radd__(self, other):
        return self + other

    def __rmul__(self, other):
        return self * other

    def __sub__(self, other):
        return self + other * -1


class Element(Number):
    """f(root) for a polynomial f: an element of Q[x]/m."""

    def __init__(self, field, f):
        self.field, self.f = field, f

    def __add__(self, other):
        if not isinstance(other, Element):
            return Element(self.field, [self.f[0] + other] + self.f[1:])
        return Element(self.field, [x + y for x, y in zip(self.f, other.f)])

    def __mul__(self, other):
        if not isinstance(other, Element):
            return Element(self.field, [x * other for x in self.f])
        return Element(self.field, self.field.ring.product(self.f, other.f))

    def __eq__(self, other):
        return not (self - other)

    def __bool__(self):
        return any(self.f)

    def enclosure(self):
        return value(self.f, self.field.root)


class Field:
    """The numbers f(root) for rational polynomials f; the root is the one that rounds to a decimal."""

    def __init__(self, polynomial, root):
        self.m = monic(polynomial)
        self.ring = Quotient(self.m)
        if self.m == [0, 1] and root == "0":
            self.root = enclosed(0)
            return
        roots, (low, high) = Roots(square_free(self.m)), rounded_from(root)
        one = roots.sign(low) * roots.sign(high) < 0 and roots.count(low, high) == 1
        demand(one, f"one root of the polynomial that rounds to {root}")
        self.root = between(*roots.narrowed(low, high))

    def number(self, f):
        f = rationals(f)
        demand(len(f) < len(self.m), "as many coordinates as the degree of the polynomial at most")
        f += [Fraction(0)] * (len(self.m) - 1 - len(f))
        return f[0] if len(f) == 1 else Element(self, f)


class Interval(Number):
    """All numbers between two multiples of 1/UNIT."""

    def __init__(self, low, high):
        self.low, self.high = low, high

    def __add__(self, other):
        other = enclosed(other)
        return Interval(self.low + other.low, self.high + other.high)

    def __mul__(self, other):
        other = enclosed(other)
        products = [x * y for x in (self.low, self.high) for y in (other.low, other.high)]
        return Interval(min(products) // UNIT, -(-max(products) // UNIT))

    def enclosure(self):
        return self

    def middle(self):
        return Fraction(self.low + self.high, 2 * UNIT)

    def magnitude(self):
        return max(abs(self.low), abs(self.high))

    def is_inside(self, low, high):
        return low * UNIT <= self.low and self.high <= high * UNIT

    def is_not_zero(self):
        return self.low > 0 or self.high < 0


def is_zero(x):
    """Whether a number is zero. An element of a field that is not may still have the value zero if its polynomial is a product."""
    demand(not isinstance(x, Element) or not x or enclosed(x).is_not_zero(), "a number that is not zero, or whose coordinates are")
    return x == 0 if isinstance(x, (Element, Fraction)) else False


def between(low, high):
    return Interval(math.floor(low * UNIT), math.ceil(high * UNIT))


def enclosed(x):
    return x.enclosure() if isinstance(x, Number) else between(x, x)


def rational(x):
    """The value of what is known to be rational."""
    if isinstance(x, Element) and not any(x.f[1:]):
        return x.f[0]
    demand(isinstance(x, Fraction), "a rational number")
    return x


# Rounding.


def rounded_from(decimal):
    """The numbers that round to a decimal: half a unit of its last place to both sides."""
    known = isinstance(decimal, str) and re.fullmatch(r"-?[0-9]{1,99}(?:\.([0-9]{1,99}))?(?:e(-?[0-9]{1,3}))?", decimal)
    demand(known, f"a decimal, not {str(decimal):.40}")
    demand(re.search("[1-9]", decimal.partition("e")[0]), f"a decimal that is not zero, not {decimal}")
    half = Fraction(10) ** (int(known[2] or 0) - len(known[1] or "")) / 2
    return Fraction(decimal) - half, Fraction(decimal) + half


def check_decimal(decimal, x, what):
    low, high = rounded_from(decimal)
    # A tie is known by an interval only.
    demand(enclosed(x).is_inside(low - TIE, high + TIE), f"{what} = {decimal}")


def check_double(text, x, what):
    """That no double is nearer."""
    known = isinstance(text, str) and re.fullmatch(r"-?0x[01](\.[0-9a-f]{1,13})?p[+-][0-9]{1,4}", text)
    demand(known and text == re.sub(r"\.?0*p", "p", float.fromhex(text).hex()), f"a double, not {str(text):.40}")
    double, x = float.fromhex(text), enclosed(x)
    if double == 0:
        demand(x.low == x.high == 0, f"{what} = 0")
        return
    low, high = ((Fraction(double) + Fraction(math.nextafter(double, s))) / 2 for s in (-math.inf, math.inf))
    demand(x.is_inside(low, high), f"{what} = {double!r}")
