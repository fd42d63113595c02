#!/usr/bin/env python3
"""Checks certificates of symplectic methods. It shares no code with the compiler that wrote them.

    python3 check_certificate.py certificates/gauss-2.json certificates/forest-ruth-1990.json
    python3 check_certificate.py                      # every certificate of the catalogue, with its table

This file is the place to start trusting. It needs Python 3.11 and its standard library. A certificate has the exact coefficients of a
method, and what is claimed of them. From the coefficients alone this file proves

  * the doubles: none is nearer to the exact coefficient;
  * that a method is `symplectic` and `symmetric` or not;
  * the `order` for each class of Hamiltonians: all order conditions up to it, from trees that this file makes itself, and that of
    `violated`, a tree of the next order, does not hold. With more than MAX_TREES trees of one order, FURTHER has another proof.

The files of FURTHER check the other claims. If one is missing, the output says "not checked here" and which file is needed. The exit
status is 0 if nothing is wrong, 1 if something is wrong, 2 if a claim is not checked.  HLW: Hairer, Lubich & Wanner, Geometric numerical integration
"""
import json
import math
import re
import sys
from fractions import Fraction
from functools import lru_cache
from importlib import import_module
from itertools import accumulate
from pathlib import Path

FURTHER = {  # Claims, and the files in the folder `checker` with a function of that name for them.
    "assumptions": "assumptions",  # Orders that have too many trees.
    "gradient": "gradient",  # Gradient kicks of splittings, for a quadratic T.
    "functions": "functions",  # The coefficients are functions of a transcendental number.
    "levels": "compositions",  # The coefficients are those of compositions of compositions.
    "solution": "solutions",  # The coefficients are the solution of order conditions.
    "symmetric": "symmetry",  # With the stages in an order that is given.
    "palindrome": "splittings",  # The flows of a splitting are the same forwards and backwards.
    "perturbed": "splittings",  # The orders for H_A + eps H_B.
    "stability": "stability",  # All stable step sizes of the oscillator.
    "table": "tables",  # The table of the same name in the folder above says what the certificate says.
}
CLASSES = ("general", "separable", "nystrom")  # Any H; T(p) + U(q); the same with a quadratic T.
NOT_COVERED = {"symplectic", "symmetric", "palindrome", "stability", "order (perturbed)", *(f"order ({kind})" for kind in CLASSES)}

MAX_TREES, MAX_VERTICES = 1000, 60  # Of one order, and of a tree in a file.
MAX_BYTES, MAX_STAGES = 1 << 24, 64  # Of a file and of a method.
MAX_DEGREE, MAX_DIGITS = 100, 3000  # Of polynomials that define nodes and fields, and of their coefficients, all as long as the longest.
UNIT = 1 << 250  # Irrational roots are known between two neighbouring multiples of 1/UNIT.
TIE = Fraction(1, 1 << 240)  # What is nearer to the middle between two decimals may be rounded to both.

class Rejected(Exception): """A claim that does not hold."""
class OtherVersion(Exception): """A file that this checker does not read."""
class NotChecked(str): """What to say of a claim that is not checked."""
WRONG = (Rejected, OtherVersion, ArithmeticError, AttributeError, LookupError, MemoryError, OSError, RecursionError, TypeError, ValueError)  # What is caught.

def demand(holds, claim):
    if not holds: raise Rejected(claim)

def check_members(thing, needed, optional=()):
    demand(isinstance(thing, dict), "an object")
    for name in needed: thing[name]
    unknown = thing.keys() - {*needed, *optional}
    demand(not unknown, f"members that are known, not {', '.join(unknown)}")

def whole(x):
    demand(type(x) is int and 0 <= x <= 1000, f"a whole number up to 1000, not {str(x):.40}")
    return x

def rationals(texts):
    demand(isinstance(texts, list) and len(texts) <= 1000, "a list of rational numbers")
    for text in texts:
        demand(isinstance(text, str) and re.fullmatch(r"-?[0-9]{1,500}(/[0-9]{1,500})?", text), f"a rational number, not {str(text):.40}")
    return [Fraction(text) for text in texts]

# Polynomials: lists of the coefficients of 1, x, x^2, ..., whole or rational.
def value(f, x):
    (f, divisor), total, power = over_one_denominator(f), 0, 1
    for c in reversed(f):
        total, power = total * x.numerator + c * power, power * x.denominator
    return Fraction(total * x.denominator, divisor * power)

def derivative(f): return [k * c for k, c in enumerate(f)][1:]

def product(f, g):
    found = [0] * max(len(f) + len(g) - 1, 0)
    for i, x in enumerate(f):
        for j, y in enumerate(g) if x else ():
            found[i + j] += x * y
    return found

def over_one_denominator(f):
    """Whole coefficients, and what they are to be divided by."""
    common = math.lcm(*(c.denominator for c in f))
    return [c.numerator * (common // c.denominator) for c in f], common

def primitive(f):
    """The multiple by a positive number that has coprime whole coefficients, without zeros at the end."""
    f, _ = over_one_denominator(f[: max((k + 1 for k, c in enumerate(f) if c), default=0)])
    return [c // math.gcd(*f) for c in f]

def remainder(f, m):
    """That of a division by m, without fractions: it is to be divided by the second result."""
    divisor = 1
    while len(f) >= len(m):
        *f, highest = f
        if highest:
            f, divisor = [c * m[-1] for c in f], divisor * m[-1]
            for i, c in enumerate(m[:-1], len(f) - len(m) + 1):
                f[i] -= highest * c
    return f, divisor

def product_modulo(f, g, m):
    """f g in Q[x]/m"""
    (f, d), (g, e) = over_one_denominator(f), over_one_denominator(g)
    found, divisor = remainder(product(f, g), m)
    return [Fraction(c, d * e * divisor) for c in found]

def common_divisor(f, g):
    while g:
        f, g = g, primitive(remainder(f, g)[0])
    return f

def definition(texts):
    """A polynomial that defines nodes or a field. Of its multiples, it is the one with coprime whole coefficients."""
    f = rationals(texts)
    demand(1 < len(f) <= MAX_DEGREE, f"a polynomial of degree 1 to {MAX_DEGREE - 1}")
    demand(len(f) * max(map(len, texts)) <= MAX_DIGITS, f"a polynomial with at most {MAX_DIGITS} digits")
    demand(f[-1] > 0 and primitive(f) == f, "a polynomial with coprime whole coefficients")
    return primitive(f)

def coordinates(texts, m):
    """A polynomial as an element of Q[x]/m."""
    f, degree = rationals(texts), len(m) - 1
    demand(len(f) <= degree, f"at most {degree} coefficients, the degree of the polynomial")
    return f + [Fraction(0)] * (degree - len(f))

# Ends: two rational numbers between which a real number is; equal ones if it is rational.
def root_between(f, low, high, what):
    """The ends of a root of f, which changes its sign there or is zero; equal ones for a simple fraction."""
    low, high = math.ceil(low * UNIT), math.floor(high * UNIT)
    scaled = [c * UNIT ** (len(f) - 1 - k) for k, c in enumerate(f)]  # UNIT^degree f(x / UNIT)
    before = value(scaled, low)
    demand(low <= high and before * value(scaled, high) <= 0, what)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if value(scaled, middle) * before > 0 else (low, middle)
    simple = Fraction(low + high, 2 * UNIT).limit_denominator(1000)
    is_simple = low <= simple * UNIT <= high and value(f, simple) == 0
    return (simple, simple) if is_simple else (Fraction(low, UNIT), Fraction(high, UNIT))

def enclosed(f, x):
    """The ends of f(x): f in the middle, rounded, and more or less the distance times sum_k k |f_k| |x|^(k-1), rounded up."""
    if x[0] == x[1] or not any(f):
        return value(f, x[0]), value(f, x[0])
    middle, slope = sum(x) / 2, value(derivative([math.ceil(abs(c)) for c in f]), max(-x[0], x[1]))
    found = Fraction(sum(round(c * middle**k * UNIT**2) for k, c in enumerate(f)), UNIT**2)
    error = (x[1] - x[0]) * slope + Fraction(len(f), UNIT**2)
    return found - error, found + error

def ends(x): return x.ends() if isinstance(x, Number) else (x, x)

def is_not_zero(x): return ends(x)[0] > 0 or ends(x)[1] < 0

def rounded_from(decimal, tie=TIE):
    """The numbers that round to a decimal: half a unit of its last place to both sides."""
    known = isinstance(decimal, str) and re.fullmatch(r"-?[0-9]{1,99}(?:\.([0-9]{1,99}))?(?:e(-?[0-9]{1,3}))?", decimal)
    demand(known, f"a decimal, not {str(decimal):.40}")
    demand(re.search("[1-9]", decimal.partition("e")[0]), f"a decimal that is not zero, not {decimal}")
    half = Fraction(10) ** (int(known[2] or 0) - len(known[1] or "")) / 2 + tie
    return Fraction(decimal) - half, Fraction(decimal) + half

def nearest_to(text):
    """The numbers to which no other double is nearer than this one. Only zero belongs to zero."""
    known = isinstance(text, str) and re.fullmatch(r"-?0x[01](\.[0-9a-f]{1,13})?p[+-][0-9]{1,4}", text)
    demand(known and text == re.sub(r"\.?0*p", "p", float.fromhex(text).hex()), f"a double, not {str(text):.40}")
    double = float.fromhex(text)
    sides = (-math.inf, math.inf) if double else (double, double)
    return tuple((Fraction(double) + Fraction(math.nextafter(double, side))) / 2 for side in sides)

def check_rounded(text, x, rounding, what):
    """Checks the text of a number, or texts of a vector or a matrix, against the ends of what they say."""
    if not isinstance(x, list):
        low, high = rounding(text)
        return demand(low <= x[0] and x[1] <= high, f"{what} = {text}")
    demand(isinstance(text, list) and len(text) == len(x), f"as many entries in {what} as stages")
    for k, (entry, y) in enumerate(zip(text, x), 1):
        check_rounded(entry, y, rounding, f"{what}[{k}]")

class Number:
    """What follows from + and * of numbers that are not rational, with rationals too."""
    __radd__ = lambda self, other: self + other
    __rmul__ = lambda self, other: self * other
    __sub__ = lambda self, other: self + other * -1

class Element(Number):
    """f(root) for f in Q[x]/m. Two are equal if their coordinates are."""
    def __init__(self, m, root, f):
        self.m, self.root, self.f = m, root, f

    def __add__(self, other):
        f = other.f if isinstance(other, Element) else [other] + [0] * (len(self.f) - 1)
        return Element(self.m, self.root, [x + y for x, y in zip(self.f, f)])

    def __mul__(self, other):
        f = product_modulo(self.f, other.f, self.m) if isinstance(other, Element) else [x * other for x in self.f]
        return Element(self.m, self.root, f)
    __eq__ = lambda self, other: not (self - other)
    __bool__ = lambda self: any(self.f)
    ends = lambda self: enclosed(self.f, self.root)

def field(polynomial, root):
    """The function that reads numbers f(root). The root is the one that rounds to a decimal; "0" and x make the rationals."""
    m, ends = definition(polynomial), None
    if m != [0, 1] or root != "0":
        near, what = rounded_from(root, tie=0), f"one root of the polynomial that rounds to {root}"
        low, high = enclosed(derivative(m), near)
        demand(low > 0 or high < 0, what)
        ends = root_between(m, *near, what)
    return lambda texts: Element(m, ends, coordinates(texts, m)) if len(m) > 2 else coordinates(texts, m)[0]

# Methods:  Q_i = q0 + h sum_j a_ij V_j,  P_i = p0 + h sum_j a~_ij F_j,  q1 = q0 + h sum_i b_i V_i,  p1 = p0 + h sum_i b~_i F_i
# with V_i = dH/dp and F_i = -dH/dq at (Q_i, P_i). What is multiplied with V has the colour q, what is multiplied with F the colour p.
# A vector has a number for each stage. Proofs see matrices only by what they make of vectors.
class Stages:
    """Vectors as lists. Splittings have weights only. `solved` are orders that are known."""
    turns = True
    def __init__(self, layout, weights, matrices, solved=None):
        self.s, self.weights, self.matrices, self.solved = len(weights["q"]), weights, matrices, solved or {}
        self.first = "p" if layout == "kicks first" else "q"
        rows = [row for matrix in matrices.values() for row in (matrix, *matrix)]
        demand(all(len(row) == self.s for row in (weights["p"], *rows)), "lists of one length")
        self.one = [Fraction(1)] * self.s
        self.basis = [[Fraction(i == k) for i in range(self.s)] for k in range(self.s)]

    times = lambda self, f, g: [x * y if x and y else Fraction(0) for x, y in zip(f, g)]
    dot = lambda self, f, g: sum((x * y for x, y in zip(f, g) if x and y), Fraction(0))
    turned = lambda self, f: f[::-1]
    ends = lambda self, f: [ends(x) for x in f]
    entries = lambda self, colour: [self.ends(row) for row in zip(*(self.apply(colour, f) for f in self.basis))]

    def apply(self, colour, f):
        """sum_j a_ij f_j, or with a~. A flow of a splitting sees those before it, and the first one of its stage itself."""
        if self.matrices:
            return [self.dot(row, f) for row in self.matrices[colour]]
        sums = list(accumulate(self.times(self.weights[colour], f), initial=Fraction(0)))
        return sums[1:] if colour == self.first else sums[:-1]

class Nodes:
    """Vectors as functions of the nodes, the roots of a polynomial m: elements of Q[x]/m. A sum over the nodes is a trace."""
    solved = {}
    def __init__(self, polynomial, weights, matrices, doubles):
        self.m = definition(polynomial)
        self.s = len(self.m) - 1
        self.basis = [[Fraction(i == k) for i in range(self.s)] for k in range(self.s)]
        self.one, powers = self.basis[0], self.basis[:1]
        while len(powers) < 3 * self.s:
            powers.append(self.times(powers[-1], [Fraction(0), Fraction(1)]))
        # The traces of x^k, which maps x^i to x^(i + k).
        self.sums, self.divisor = over_one_denominator([sum(powers[i + k][i] for i in range(self.s)) for k in range(2 * self.s)])
        self.weights = {colour: coordinates(f, self.m) for colour, f in weights.items()}
        self.matrices = {colour: [coordinates(f, self.m) for f in rows] for colour, rows in matrices.items()}
        demand(all(len(rows) <= self.s for rows in self.matrices.values()), "matrices of functions")
        names = [name for name, colour in (("c", "q"), ("c_tilde", "p")) if self.apply(colour, self.one) == powers[1]]
        demand(names and len(doubles[names[0]]) == self.s, f"{self.s} nodes that are c or, of an exchanged method, c~")
        self.nodes = [root_between(self.m, *nearest_to(text), f"a node that rounds to {text}") for text in doubles[names[0]]]
        # Each has ends of its own, so there are no other roots.
        demand(all(x[1] < y[0] for x, y in zip(self.nodes, self.nodes[1:])), "nodes in order")
        self.turns = not any(self.turned(self.m))

    times = lambda self, f, g: product_modulo(f, g, self.m)
    dot = lambda self, f, g: sum(x * y for x, y in zip(self.moments(f), g))
    ends = lambda self, f: [self.at(f, node) for node in self.nodes]
    entries = lambda self, colour: [[self.entry(self.matrices[colour], x, y) for y in self.nodes] for x in self.nodes]

    def moments(self, f):
        """The sums over the nodes of f, x f, x^2 f, ..."""
        f, divisor = over_one_denominator(f)
        return [Fraction(sum(c * x for c, x in zip(f, self.sums[k:])), divisor * self.divisor) for k in range(self.s)]

    def apply(self, colour, f):
        """sum_j a(x, c_j) f(c_j) for a(x, y) = sum_k row_k(x) y^k"""
        terms = [(row, moment) for row, moment in zip(self.matrices[colour], self.moments(f)) if moment]
        return [sum((row[i] * moment for row, moment in terms), Fraction(0)) for i in range(self.s)]

    def turned(self, f):
        """f(1 - x)"""
        found = [Fraction(0)] * self.s
        for c in reversed(f):
            found = self.times(found, [Fraction(1), Fraction(-1)])
            found[0] += c
        return found

    def at(self, f, node):
        """The ends of f(node), which tell whether it is zero."""
        low, high = enclosed(f, node)
        # The common divisor of f and m has this root of m or none here.
        before, after = (value(common_divisor(self.m, primitive(f)), x) for x in node) if low <= 0 <= high else (1, 1)
        return (low, high) if before * after > 0 else (Fraction(0), Fraction(0))

    def entry(self, rows, x, y):
        """The ends of a(x, y), with an error of y as in `enclosed`."""
        low, high = self.at([value(column, sum(y) / 2) for column in zip(*rows)], x)
        bounds = [max(map(abs, self.at(row, x))) for row in rows] if y[0] < y[1] else []
        error = (y[1] - y[0]) / 2 * value(derivative(bounds), max(-y[0], y[1]))
        return low - error, high + error

# Trees with vertices of two colours, 'q' and 'p': (colour, children), the children sorted (HLW III.2).
def fits(tree, kind):
    """Of T(p) + U(q) the colours alternate. If T is quadratic, the velocity has no second derivative."""
    colour, children = tree
    carries = kind == "general" or all(child[0] != colour for child in children)
    return carries and (kind != "nystrom" or colour == "p" or len(children) < 2) and all(fits(child, kind) for child in children)

@lru_cache(maxsize=None)
def trees(order, kind):
    """All trees with this number of vertices for a class of Hamiltonians."""
    return [tree for colour in "qp" for tree in ((colour, children) for children in forests(order - 1, kind)) if fits(tree, kind)]

@lru_cache(maxsize=None)
def forests(size, kind):
    """All multisets of trees with this number of vertices together."""
    firsts = ((tree, n) for n in range(1, size + 1) for tree in trees(n, kind))
    return sorted({tuple(sorted((tree, *rest))) for tree, n in firsts for rest in forests(size - n, kind)}) if size else [()]

size = lambda tree: 1 + sum(size(child) for child in tree[1])
density = lambda tree: size(tree) * math.prod(density(child) for child in tree[1])

def read_tree(text):
    """`q[p^2,q[p]]`"""
    tokens, wrong = ["end", *re.findall(r"\^[1-9][0-9]?|.", text, re.DOTALL)[::-1]], f"a tree, not {text}"

    def tree():
        """A tree and the number of its vertices."""
        colour, children, vertices = tokens.pop(), [], 1
        demand(colour in ("q", "p"), wrong)
        separator = tokens.pop() if tokens[-1] == "[" else "]"
        while separator != "]":
            child, size = tree()
            copies = int(tokens.pop()[1:]) if re.match(r"\^[1-9]", tokens[-1]) else 1
            children, vertices = children + [child] * copies, vertices + size * copies
            demand(vertices <= MAX_VERTICES, f"a tree with at most {MAX_VERTICES} vertices")
            separator = tokens.pop()
            demand(separator in (",", "]"), wrong)
        return (colour, tuple(sorted(children))), vertices

    found, _ = tree()
    demand(tokens == ["end"], wrong)
    return found

@lru_cache(maxsize=1)
def residuals(of):
    """The function that tells by how much a method violates the condition of a tree: its elementary weight less 1/gamma (HLW III.2)."""
    if hasattr(of, "residuals"): return of.residuals()
    stages = lru_cache(maxsize=None)(lambda tree: of.apply(tree[0], product(tree[1])))
    product = lru_cache(maxsize=None)(lambda trees: of.times(product(trees[:-1]), stages(trees[-1])) if trees else of.one)
    return lambda tree: of.dot(of.weights[tree[0]], product(tree[1])) - Fraction(1, density(tree))

# Claims.
def symplectic(of):
    """What has to vanish: b_i a~_ij + b~_j a_ji - b_i b~_j, tested with functions of i and of j, and b_i - b~_i (HLW VI.4)."""
    b, b_tilde = of.weights["q"], of.weights["p"]
    rows, columns = ([of.apply(colour, f) for f in of.basis] for colour in "pq")
    yield from (x - y for x, y in zip(b, b_tilde))
    for e, column in zip(of.basis, columns):
        for f, row in zip(of.basis, rows):
            yield of.dot(of.times(b, e), row) + of.dot(of.times(b_tilde, f), column) - of.dot(b, e) * of.dot(b_tilde, f)

def symmetric(of):
    """What has to vanish: b_(s+1-j) - b_j and a_(s+1-i)(s+1-j) + a_ij - b_j, and so with a~ and b~ (HLW V.2)."""
    for colour in "qp" if of.turns else ():
        b = of.weights[colour]
        yield from (x - y for x, y in zip(of.turned(b), b))
        for f in of.basis:
            there, here = of.turned(of.apply(colour, of.turned(f))), of.apply(colour, f)
            yield from (x + y - of.dot(b, f) * z for x, y, z in zip(there, here, of.one))
    yield 0 if of.turns else 1  # Whether 1 - c is a node with c.

def check_property(name, claim, residuals):
    """All residuals are zero, or the value of one is not."""
    holds = all(not x for x in residuals) if claim is True else any(map(is_not_zero, residuals))
    demand(type(claim) is bool and holds, f"{name} = {claim}")
    return name if claim else f"not {name}"

def check_order(of, residual, kind, claim):
    check_members(claim, ("order", "violated", "residual"))
    order, checked = whole(claim["order"]), 0
    what, tree = f"order {order} ({kind})", read_tree(claim["violated"])
    demand(size(tree) == order + 1 and fits(tree, kind), f"{what}: {claim['violated']} as a tree of the next order and the class")
    check_rounded(claim["residual"], ends(residual(tree)), rounded_from, f"{what}: residual of {claim['violated']}")
    demand(is_not_zero(residual(tree)), f"{what} and no higher")
    if kind in of.solved:
        demand(order <= of.solved[kind], f"{what}, from the conditions that were solved")
        return f"{kind} {order}"
    while checked < order and len(trees(checked + 1, kind)) <= MAX_TREES:
        checked += 1
        for tree in trees(checked, kind):
            demand(residual(tree) == 0, f"{what}, tree {tree}")
    found = f"{kind} {order}"
    return found if checked == order else further("assumptions", of, order, found)

def further(claim, *arguments):
    """What another file says of a claim, or that it is missing."""
    try:
        return getattr(import_module(f"checker.{FURTHER[claim]}"), claim)(*arguments)
    except ModuleNotFoundError as error:
        return NotChecked(f"{claim} not checked here: needs checker/{FURTHER[claim]}.py beside this file ({error})")

# Certificates.
def read(text):
    """An object. Its numbers are whole, and its members have different names."""
    refuse = lambda number: demand(False, f"a whole number or a text, not {number:.40}")
    members = lambda pairs: demand(len(dict(pairs)) == len(pairs), "members with different names") or dict(pairs)
    found = json.loads(text, parse_float=refuse, parse_constant=refuse, object_pairs_hook=members)
    return demand(isinstance(found, dict), "an object") or found

def method_of(certificate):
    numbers, layout, stages = certificate["numbers"], certificate["layout"], whole(certificate["stages"])
    kind, weights = numbers["kind"], {colour: certificate[name] for colour, name in (("q", "b"), ("p", "b_tilde"), ("g", "gradient")) if name in certificate}
    matrices = {"q": certificate["a"], "p": certificate["a_tilde"]} if layout == "matrices" else {}
    count = len(numbers["polynomial"]) - 1 if kind == "nodes" else stages if kind == "levels" else len(certificate["b"])
    demand(0 < stages == count and (stages <= MAX_STAGES or kind == "levels"), f"{stages} stages, of at most {MAX_STAGES}")
    demand("g" not in weights or kind != "levels" and not matrices, "gradient kicks of a splitting that is written out")
    if kind in ("solution", "levels") and not matrices:
        return further(kind, numbers, layout, weights)
    if kind == "nodes" and matrices:
        check_members(numbers, ("kind", "polynomial"))
        return Nodes(numbers["polynomial"], weights, matrices, certificate["doubles"])
    demand(kind in ("field", "functions"), "numbers of a kind that is known and belongs to the layout")
    number = further("functions", numbers) if kind == "functions" else field(numbers["polynomial"], numbers["root"])
    if isinstance(number, NotChecked): return number
    check_members(numbers, ("kind", "polynomial", "root"), ("variable",) if kind == "functions" else ())
    weights = {colour: [number(x) for x in f] for colour, f in weights.items()}
    matrices = {colour: [[number(x) for x in row] for row in rows] for colour, rows in matrices.items()}
    return further("gradient", layout, weights) if "g" in weights else Stages(layout, weights, matrices)

def check(text):
    """Returns a certificate, its method with functions for the ends of the coefficients, by name, and what was checked, or raises one of WRONG."""
    certificate = read(text)
    demand(certificate["format"] == "symplectic certificate", "a certificate, as `symplectic certify` writes it")
    if whole(certificate["version"]) != 1: raise OtherVersion(f"a certificate of version {certificate['version']}: this checker reads version 1; take the one of the version of symplectic that wrote it")
    demand(isinstance(certificate["name"], str), "the name as a text")
    demand(certificate["layout"] in ("matrices", "kicks first", "drifts first"), "a layout that is known")
    matrices = ("a", "a_tilde") if certificate["layout"] == "matrices" else ()  # Those of a splitting follow from its weights.
    first, last = ("symplectic", "symmetric") if matrices else ("palindrome",), ("perturbed", "stability")
    needed = ("format", "version", "name", "stages", "layout", "numbers", "b", "b_tilde", *matrices, "doubles", "order", "not_covered")
    kicks = ("gradient",) if "gradient" in certificate else ()  # For these T is quadratic.
    check_members(certificate, needed, (*first, *kicks, *(last[1:] if kicks else last)))
    check_members(certificate["doubles"], ("c", "c_tilde", "b", "b_tilde", *kicks, *matrices), ("a", "a_tilde"))
    check_members(certificate["order"], (), CLASSES[2:] if kicks else CLASSES)
    missing, covered = certificate["not_covered"], {*certificate, *(f"order ({kind})" for kind in (*certificate["order"], *certificate))}
    listed = isinstance(missing, list) and len(missing) == len({*missing}) and {*missing} <= NOT_COVERED - covered
    demand(listed, "not_covered as a list of claims that are not made, each once")
    of = method_of(certificate)
    if isinstance(of, NotChecked): return certificate, None, [of]
    demand(of.s == certificate["stages"], f"{of.s} stages")
    exact, residual, tests = {"method": of}, residuals(of), {"symplectic": symplectic, "symmetric": symmetric}
    exact.update({name: lambda: of.ends(of.weights["g"]) for name in kicks})
    for colour, tilde in (("q", ""), ("p", "_tilde")):
        exact["a" + tilde] = lambda colour=colour: of.entries(colour)
        exact["b" + tilde] = lambda colour=colour: of.ends(of.weights[colour])
        exact["c" + tilde] = lambda colour=colour: of.ends(of.apply(colour, of.one))
    for name, texts in certificate["doubles"].items():
        check_rounded(texts, exact[name](), nearest_to, name)
    here = lambda name: name in tests and (name != "symmetric" or type(certificate[name]) is not list)  # An order of the stages is.
    proved = lambda name: check_property(name, certificate[name], tests[name](of)) if here(name) else further(name, of, certificate)
    done = ["doubles", *(proved(name) for name in first if name in certificate)]
    done += [check_order(of, residual, kind, claim) for kind, claim in certificate["order"].items()]
    claimed = [certificate["order"][kind]["order"] for kind in CLASSES if kind in certificate["order"]]
    demand(claimed == sorted(claimed), "orders that do not fall where the class of Hamiltonians gets smaller")
    done += [proved(name) for name in last if name in certificate]
    return certificate, exact, done + [f"{name} not covered" for name in missing]

def content(path):
    demand(path.stat().st_size <= MAX_BYTES and path.is_file(), f"a file of at most {MAX_BYTES} bytes")
    return path.read_text(encoding="utf-8")

def verdict(path):
    """The exit status of a file, and what to say of it."""
    table, file = path.resolve().parent.parent / f"{path.stem}.toml", ""
    try:
        certificate, exact, done = check(content(path))
        if exact and path.resolve().parent.name == "certificates" and table.exists():
            file = f"{table.name}: "
            done.append(further("table", content(table), certificate, exact))
    except WRONG as error:
        kind = {Rejected: "not proved: ", OtherVersion: ""}.get(type(error), f"{type(error).__name__}: ")
        return 1, f"WRONG: {file}{f'the member {error} is missing' if isinstance(error, KeyError) else f'{kind}{error}'}"
    status = 2 if any(isinstance(x, NotChecked) for x in done) else 0
    return status, f"{'NOT ALL CHECKED' if status else 'right'}: {', '.join(done)}"

def main(paths):
    found, paths = {0}, paths or sorted((Path(__file__).parent / "certificates").glob("*.json")) or sys.exit("no certificates beside this file: name some")
    for path in map(Path, paths):
        status, text = verdict(path)
        found.add(status)
        print("".join(c if c.isprintable() else "?" for c in f"{path.name}: {text}"[:1000]), flush=True)  # One line, whatever the texts are.
    return 1 if 1 in found else max(found)

if __name__ == "__main__":
    sys.modules["check_certificate"] = sys.modules["__main__"]  # What the further files import.
    sys.stdout.reconfigure(errors="backslashreplace")
    sys.exit(main(sys.argv[1:]))
