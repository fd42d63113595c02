"""Coefficients that are known as the solution of order conditions. That there is one near some digits is proved here."""

import math
import re
from fractions import Fraction
from functools import lru_cache

from check_certificate import Number, Stages, check_members, demand, rationals, read_tree, residuals, rounded_from, whole

from . import processed
from .gradient import gradient
from .rootings import rootings, unrooted
from .splittings import base_conditions, base_residual, coefficient, flows, is_palindrome, product_of, splitting_conditions, splitting_residual

MAX_ORDER = {"separable": 10, "nystrom": 8, "composition": 10, "perturbed": 24}
MAX_UNKNOWNS = 40
EDGE = Fraction(2, 10**38)  # Of the box in which the solution is proved to be.
PLACES = 400
UNIT = 1 << PLACES  # The ends of intervals are whole multiples of 1/UNIT.


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
        return Interval(min(products) >> PLACES, -(-max(products) >> PLACES))

    def ends(self):
        return Fraction(self.low, UNIT), Fraction(self.high, UNIT)

    def middle(self):
        return sum(self.ends()) / 2

    def is_inside(self, low, high):
        return low * UNIT <= self.low and self.high <= high * UNIT


class Affine(Interval):
    """An interval around an affine function of the unknowns, so that sums that do not depend on them are exact."""

    def __init__(self, x, around):
        self.low, self.high, self.x = around.low, around.high, x

    def __add__(self, other):
        found = super().__add__(other)
        if isinstance(other, Affine):
            x = tuple(c + d for c, d in zip(self.x, other.x))
            return Affine(x, found) if any(x[1:]) else x[0]
        return found if isinstance(other, Interval) else Affine((self.x[0] + other, *self.x[1:]), found)

    def __mul__(self, other):
        found = super().__mul__(other)
        return found if isinstance(other, Interval) else Affine(tuple(c * other for c in self.x), found)


def between(low, high):
    return Interval(math.floor(low * UNIT), math.ceil(high * UNIT))


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
    return splitting(layout, found.weights, found.given())


def splitting(layout, weights, solved=None):
    return gradient(layout, weights, solved) if "g" in weights else Stages(layout, weights, {}, solved)


class Solution:
    """A splitting whose fractions are affine functions of unknowns: lists with a constant and a factor for each unknown."""

    def __init__(self, numbers, layout, weights):
        self.kind, self.orders = numbers["class"], [whole(x) for x in numbers["orders"]]
        needed = ("kind", "class", "orders", "unknowns", "conditions", "box", "inverse")
        weighted = self.kind == "composition"
        check_members(numbers, (*needed, *(("weights",) if weighted else ())), ("processor",) if weighted else ())
        decimals = numbers["unknowns"]
        demand(self.kind in MAX_ORDER and 0 < len(self.orders) <= 24, "conditions of a class that is known")
        demand(0 < min(self.orders) and max(self.orders) <= MAX_ORDER[self.kind], "conditions of an order that is bounded")
        demand(self.orders == sorted(self.orders, reverse=True), "orders that do not grow with the power of eps")
        demand(len(self.orders) == 1 or self.kind == "perturbed", "one order")
        demand(0 < len(decimals) <= MAX_UNKNOWNS, f"between 1 and {MAX_UNKNOWNS} unknowns")
        demand(len(numbers["conditions"]) == len(decimals), f"{len(numbers['conditions'])} conditions, as many as unknowns")
        self.layout, self.affine = layout, {colour: [self.vector(x, decimals) for x in list_] for colour, list_ in weights.items()}
        demand(len({*map(len, weights.values())}) == 1, "lists of one length")
        demand("g" not in weights or self.kind == "nystrom", "gradient kicks for a quadratic T")
        self.factors = all_flows = flows(layout, self.affine, is_zero=lambda x: not any(x))
        if self.kind == "composition":
            self.factors = [(None, self.vector(x, decimals)) for x in numbers["weights"]]
            demand(all_flows == verlet([x for _, x in self.factors], all_flows[0][0]), "a composition of Stoermer-Verlet")
        self.symmetric, self.steps, self.vanish = is_palindrome(self.factors), [], {}
        self.apart = 2 if self.symmetric else 1
        if "processor" in numbers:
            self.steps, both_ways = processed.written(numbers["processor"], lambda x: self.vector(x, decimals))
            between = processed.kernel(self.factors, self.steps, both_ways)
            self.apart, words = processed.even_words(between, self.orders[0], both_ways)
            self.vanish = {f"processor {name_of(word)}": word for word in words}
        self.names = numbers["conditions"]
        self.all = self.named(self.names)
        _, weights = self.at(self.solve(decimals, places(numbers["box"], 38), places(numbers["inverse"], 10)))
        # Equal functions are one number.
        number = lru_cache(maxsize=None)(lambda x, value: Affine(x, value) if isinstance(value, Interval) else value)
        self.weights = {colour: [*map(number, self.affine[colour], list_)] for colour, list_ in weights.items()}

    def vector(self, x, decimals):
        x = tuple(rationals(x))
        demand(len(x) == len(decimals) + 1, "a constant and a factor for each unknown")
        return x

    def at(self, unknowns):
        """The factors, followed by the written steps of a processor, and the weights."""

        @lru_cache(maxsize=None)
        def number(x):
            return x[0] + sum((y * c for c, y in zip(x[1:], unknowns) if c), Fraction(0))

        factors = [(letter, number(x)) for letter, x in (*self.factors, *self.steps)]
        return factors, {colour: [number(x) for x in list_] for colour, list_ in self.affine.items()}

    def named(self, names):
        """All conditions by name, sufficient for the order: of a symmetric method in odd degrees (HLW II.3)."""
        step = self.apart
        if self.kind == "composition":
            words = base_conditions(self.orders[0], step)
        elif self.kind != "nystrom":
            words = splitting_conditions(self.orders, step)
        else:
            # One rooting of each tree, as splittings are symplectic (HLW VI.7): that of the name.
            same = lambda tree: min(rootings(tree))
            given = {same(tree): (name, tree) for name, tree in zip(names, map(read_tree, names))}
            trees = (tree for n in range(1, self.orders[0] + 1, step) for tree in unrooted(n, "nystrom"))
            return dict(given.get(same(tree), (tree, tree)) for tree in trees)
        return {name_of(word): word for word in words}

    def conditions(self, unknowns):
        """What has to vanish, as many as unknowns."""
        factors, weights = self.at(unknowns)
        if self.kind == "nystrom":
            residual = residuals(splitting(self.layout, weights))
        else:
            count, factors = len(self.factors), product_of(factors)
            factors, steps, residual_of = factors[:count], factors[count:], base_residual if self.kind == "composition" else splitting_residual
            residual = lambda word: residual_of(word, factors) * math.factorial(len(word))
        found = {name: residual(x) for name, x in self.all.items()}
        found |= {name: coefficient(word, steps) * math.factorial(len(word)) for name, word in self.vanish.items()}
        known = [name for name, x in found.items() if isinstance(x, Fraction)]
        demand(not any(map(found.pop, known)), "conditions without unknowns")
        demand(found.keys() == {*self.names} and len(found) == len(self.names), "the conditions of the class, each once")
        return [found[name] for name in self.names]

    def solve(self, decimals, box, matrix):
        """Krawczyk's test with any matrix C: if K(X) = y - C F(y) + (1 - C F'(X)) (X - y) lies inside the box X around the point y, then F
        has one zero in X, and it lies in K(X)."""
        n, half = len(decimals), Fraction(50001, 10**15)
        demand(len(box) == len(matrix) == n and all(len(row) == n for row in matrix), "an edge and a row for each unknown")
        demand(all(high - low == EDGE for low, high in box), f"a box with edges of length {EDGE}")
        unit = [[enclosed(i == j) for j in range(n)] for i in range(n)]
        found, matrix = [between(*edge) for edge in box], [[enclosed(c) for c in row] for row in matrix]
        times = lambda matrix, f: [sum(c * x for c, x in zip(row, f)) for row in matrix]
        derivative = [f.slopes for f in self.conditions([Jet(x, row) for x, row in zip(found, unit)])]
        columns = [[one - x for x, one in zip(times(matrix, f), row)] for f, row in zip(zip(*derivative), unit)]
        error = list(zip(*columns))
        # The digits of C are those of the inverse: it differs by less than half a unit.
        rounded = all(x.is_inside(-half, half) for column in zip(*matrix) for x in times(error, column))
        demand(rounded, "the digits of the inverse")
        bounds = [rounded_from(text, tie=0) for text in decimals]
        for _ in range(4):  # Once proves it, and then there are more digits.
            y = [enclosed(x.middle()) for x in found]
            steps, errors = times(matrix, self.conditions(y)), times(error, [x - z for x, z in zip(found, y)])
            found = [z - step + x for z, step, x in zip(y, steps, errors)]
            inside = all(x.is_inside(*ends) for x, ends in zip(found, bounds))
            demand(inside, "a solution of the order conditions that rounds to the digits")
        demand(all(low < x[0] and x[1] < high for (low, high), x in zip(box, bounds)), "digits inside the box")
        return found

    def given(self):
        """The orders for the classes, and in the powers of eps, that follow. Those of symmetric methods are even."""
        even = lambda order: order + (order % 2 if self.symmetric else 0)
        order = self.orders[-1]
        # Trees with 3 vertices are the same for quadratic T and for all. Those with at most two vertices of the colour p are too, with the
        # root at one of these: then no vertex of the colour q has two children.
        separable = min(order, 3) if self.kind == "nystrom" else order
        powers = self.orders if self.kind == "perturbed" else [order, order, separable]
        return {"general": 1, "separable": even(separable), "nystrom": even(order), "perturbed": [even(s) for s in powers]}


def name_of(word):
    return "".join({"q": "A", "p": "B"}.get(letter, f"E{letter}") for letter in word)


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


def places(rows, count):
    """Rows of decimals with this number of places."""
    known = lambda text: isinstance(text, str) and re.fullmatch(rf"-?[0-9]{{1,20}}\.[0-9]{{{count}}}", text)
    demand(all(known(text) for row in rows for text in row), f"decimals with {count} places")
    return [[Fraction(text) for text in row] for row in rows]
