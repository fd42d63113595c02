"""Coefficients that are known as the solution of order conditions. That there is one near some digits is proved here."""

from fractions import Fraction
from functools import lru_cache
from math import ceil, floor

from check_certificate import Number, Stages, check_members, check_rounded, demand, ends, rationals, residuals, rounded_from, whole

from .rootings import unrooted
from .splittings import base_residuals, flows, is_palindrome, product_of, splitting_conditions, splitting_residual

MOST_ORDER = {"separable": 10, "nystrom": 8, "composition": 10, "perturbed": 24}
MOST_UNKNOWNS = 40
RADIUS = Fraction(1, 1 << 64)  # Half the edge of the cube in which the solution is proved to be.
UNIT = 1 << 400  # The ends of intervals are whole multiples of 1/UNIT.


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

    def ends(self):
        return Fraction(self.low, UNIT), Fraction(self.high, UNIT)

    def middle(self):
        return sum(self.ends()) / 2

    def magnitude(self):
        return max(-self.low, self.high)

    def is_inside(self, low, high):
        return low * UNIT <= self.low and self.high <= high * UNIT


def between(low, high):
    return Interval(floor(low * UNIT), ceil(high * UNIT))


def enclosed(x):
    return x if isinstance(x, Interval) else between(x, x)


class Jet(Number):
    """An interval with its derivatives by the unknowns."""

    def __init__(self, value, slopes):
        self.value, self.slopes = value, slopes

    def __add__(self, other):
        if not isinstance(other, Jet):
            return Jet(self.value + other, self.slopes)
        return Jet(self.value + other.value, [x + y for x, y in zip(self.slopes, other.slopes)])

    def __mul__(self, other):
        if not isinstance(other, Jet):
            other = enclosed(other)
            return Jet(self.value * other, [x * other for x in self.slopes])
        pairs = zip(self.slopes, other.slopes)
        return Jet(self.value * other.value, [x * other.value + self.value * y for x, y in pairs])


def solution(numbers, layout, weights):
    """The splitting with these coefficients, and the orders that follow."""
    found = Solution(numbers, layout, weights)
    return Stages(layout, found.weights, {}, found.given())


class Solution:
    """A splitting whose fractions are affine functions of unknowns: lists with a constant and a factor for each unknown."""

    def __init__(self, numbers, layout, weights):
        self.kind, self.orders = numbers["class"], [whole(x) for x in numbers["orders"]]
        check_members(numbers, ("kind", "class", "orders", "unknowns", *(("weights",) if self.kind == "composition" else ())))
        decimals = numbers["unknowns"]
        demand(self.kind in MOST_ORDER and 0 < len(self.orders) <= 24, "conditions of a class that is known")
        demand(0 < min(self.orders) and max(self.orders) <= MOST_ORDER[self.kind], "conditions of an order that is bounded")
        demand(self.orders == sorted(self.orders, reverse=True), "orders that do not grow with the power of eps")
        demand(len(self.orders) == 1 or self.kind == "perturbed", "one order")
        demand(0 < len(decimals) <= MOST_UNKNOWNS, f"between 1 and {MOST_UNKNOWNS} unknowns")
        self.layout, self.affine = layout, {colour: [self.vector(x, decimals) for x in list_] for colour, list_ in weights.items()}
        demand(len(weights["q"]) == len(weights["p"]), "lists of one length")
        self.factors = all_flows = flows(layout, self.affine, is_zero=lambda x: not any(x))
        if self.kind == "composition":
            self.factors = [(None, self.vector(x, decimals)) for x in numbers["weights"]]
            demand(all_flows == verlet([x for _, x in self.factors], all_flows[0][0]), "a composition of Stoermer-Verlet")
        self.symmetric = is_palindrome(self.factors)
        _, self.weights = self.at(self.solve(decimals))

    def vector(self, x, decimals):
        x = tuple(rationals(x))
        demand(len(x) == len(decimals) + 1, "a constant and a factor for each unknown")
        return x

    def at(self, unknowns):
        """The factors and the weights."""

        @lru_cache(maxsize=None)
        def number(x):
            return x[0] + sum((y * c for c, y in zip(x[1:], unknowns) if c), Fraction(0))

        factors = [(letter, number(x)) for letter, x in self.factors]
        return factors, {colour: [number(x) for x in list_] for colour, list_ in self.affine.items()}

    def conditions(self, unknowns):
        """What has to vanish, sufficient for the order: of a symmetric method in odd degrees (HLW II.3), and as many as unknowns."""
        (factors, weights), step = self.at(unknowns), 2 if self.symmetric else 1
        if self.kind == "nystrom":
            # One rooting of each tree, as splittings are symplectic (HLW VI.7).
            residual = residuals(Stages(self.layout, weights, {}))
            found = [residual(tree) for n in range(1, self.orders[0] + 1, step) for tree in unrooted(n, "nystrom")]
        elif self.kind == "composition":
            found = base_residuals(self.orders[0], step, product_of(factors))
        else:
            factors = product_of(factors)
            found = [splitting_residual(word, factors) for word in splitting_conditions(self.orders, step)]
        demand(all(x == 0 for x in found if isinstance(x, Fraction)), "conditions without unknowns")
        found = [x for x in found if not isinstance(x, Fraction)]
        demand(len(found) == len(unknowns), f"{len(found)} unknowns, as many as conditions")
        return found

    def solve(self, decimals):
        """Krawczyk's test. Let C be any matrix, y a point, and X the cube of radius r around it, in the norm of the largest component. If
        |C F(y)| + e r < r with e = |1 - C F'(X)|, then x - C F(x) maps X into itself and contracts it by e < 1. It has one fixed point
        x there, a zero of F, and |x - y| <= |C F(y)|/(1 - e)."""
        n = len(decimals)
        unit = [[enclosed(i == j) for j in range(n)] for i in range(n)]
        start = [enclosed(sum(rounded_from(x)) / 2) for x in decimals]
        # This cube has those around all y that are at most RADIUS away from the decimals.
        cube = [Jet(x + between(-2 * RADIUS, 2 * RADIUS), row) for x, row in zip(start, unit)]
        derivative = [f.slopes for f in self.conditions(cube)]
        matrix = inverted([[float(x.middle()) for x in row] for row in derivative])
        times = lambda f: [sum(c * x for c, x in zip(row, f)) for row in matrix]
        rows = zip(*(times(column) for column in zip(*derivative)))
        contraction = max(sum((x - one).magnitude() for x, one in zip(row, line)) for row, line in zip(rows, unit))
        y = start
        for _ in range(4):
            y = [enclosed((x - step).middle()) for x, step in zip(y, times(self.conditions(y)))]
            # Far away the numbers would get longer and longer.
            moved = all((x - x0).is_inside(-RADIUS, RADIUS) for x, x0 in zip(y, start))
            demand(moved, "a solution of the order conditions near the digits")
        step = max(x.magnitude() for x in times(self.conditions(y)))
        near = Interval(-2 * step, 2 * step)
        proved = 2 * contraction < enclosed(1).low and near.is_inside(-RADIUS, RADIUS)
        demand(proved, "a solution of the order conditions near the digits")
        found = [x + near for x in y]
        check_rounded(decimals, [ends(x) for x in found], rounded_from, "the solution of the order conditions")
        return found

    def given(self):
        """The orders for the classes, and in the powers of eps, that follow. Those of symmetric methods are even."""
        even = lambda order: order + (order % 2 if self.symmetric else 0)
        order = self.orders[-1]
        # Trees with 3 vertices are the same for quadratic T and for all.
        separable = min(order, 3) if self.kind == "nystrom" else order
        powers = self.orders if self.kind == "perturbed" else [separable]
        return {"general": 1, "separable": even(separable), "nystrom": even(order), "perturbed": [even(s) for s in powers]}


def verlet(weights, outer):
    """The flows of steps of Stoermer-Verlet with these fractions, neighbours of one kind merged."""
    inner, flows = "p" if outer == "q" else "q", []
    for x in weights:
        half = tuple(c / 2 for c in x)
        for colour, fraction in ((outer, half), (inner, x), (outer, half)):
            if flows and flows[-1][0] == colour:
                fraction = tuple(c + d for c, d in zip(flows.pop()[1], fraction))
            flows.append((colour, fraction))
    return flows


def inverted(matrix):
    """The inverse of a matrix of floating-point numbers, rounded: any matrix may take its place."""
    n = len(matrix)
    rows = [row + [float(i == j) for j in range(n)] for i, row in enumerate(matrix)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        demand(rows[k][k] != 0, "a regular derivative of the order conditions")
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(n):
            if i != k:
                rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k])]
    return [[enclosed(Fraction(x)) for x in row[n:]] for row in rows]
