#!/usr/bin/env python3
"""Checks what the files of this folder claim, and shares no code with the compiler that wrote them.

    python3 check_certificate.py gauss-2.toml forest-ruth-1990.toml
    python3 check_certificate.py                      # every file beside this program

A file has a partitioned Runge-Kutta method exactly: its section [exact]. From that alone, in exact arithmetic, this program checks

  * every decimal: it is the exact number, rounded correctly;
  * `symplectic` and `symmetric`, the conditions on a, b, a_tilde, b_tilde;
  * `order`, for each class of Hamiltonians: all order conditions up to it, from trees that this program makes itself, and the
    condition of the next order that does not hold, with both of its numbers.

Long methods are checked up to a lower order than they claim; the output says up to which. Files with claims of other kinds (enclosures
in place of exact numbers, functions such as pi and exp) are named and not checked. Python 3.11, standard library.

The method is  Q_i = q0 + h sum_j a_ij V_j,  P_i = p0 + h sum_j a_tilde_ij F_j,  q1 = q0 + h sum_i b_i V_i,  p1 = p0 + h sum_i b_tilde_i F_i
with V_i = dH/dp and F_i = -dH/dq at (Q_i, P_i). See Hairer, Lubich & Wanner, Geometric numerical integration, III.2.
"""

import math
import re
import sys
import tomllib
from fractions import Fraction
from functools import lru_cache
from pathlib import Path

MOST_TREES = 1000  # Orders with more trees are not checked.


class Rejected(Exception):
    """A claim that does not hold."""


class Unchecked(Exception):
    """A file that says something this program does not know."""


def demand(holds, claim):
    if not holds:
        raise Rejected(claim)


# Trees: (colour, children), the colour 'q' or 'p', the children sorted.


@lru_cache(maxsize=None)
def trees(order, kind):
    """All trees with so many vertices for a class of Hamiltonians."""
    found = []
    for colour in "qp":
        for children in forests(order - 1, kind, colour):
            found.append((colour, children))
    return found


@lru_cache(maxsize=None)
def forests(size, kind, parent):
    """All multisets of trees with so many vertices together that may hang on a vertex of this colour."""
    found = set()

    def extend(chosen, rest, least):
        if rest == 0:
            found.add(tuple(sorted(chosen)))
            return
        if kind == "nystrom" and parent == "q" and chosen:
            return  # The velocity is linear in p: no second derivative.
        for part in range(least, rest + 1):
            for tree in trees(part, kind):
                if kind == "general" or tree[0] != parent:
                    extend(chosen + (tree,), rest - part, part)

    extend((), size, 1)
    return sorted(found)


def size(tree):
    return 1 + sum(size(child) for child in tree[1])


def density(tree):
    """gamma: the product of the sizes of all subtrees."""
    return size(tree) * math.prod(density(child) for child in tree[1])


def read_tree(text):
    """`q[p^2,q[p]]`"""
    tokens = re.findall(r"[qp\[\],]|\^\d+", text) + ["end"]

    def tree():
        colour, children = tokens.pop(0), []
        demand(colour in "qp", f"a tree, not {text}")
        if tokens[0] == "[":
            while tokens.pop(0) in ("[", ","):
                child = tree()
                copies = int(tokens.pop(0)[1:]) if tokens[0].startswith("^") else 1
                children += [child] * copies
        return (colour, tuple(sorted(children)))

    found = tree()
    demand(tokens == ["end"], f"a tree, not {text}")
    return found


# Enclosures: pairs of rationals.


def add(x, y):
    return (x[0] + y[0], x[1] + y[1])


def multiply(x, y):
    products = [u * v for u in x for v in y]
    return (min(products), max(products))


def is_rounded(decimal, enclosure):
    """Whether every number of the enclosure is the decimal, up to half of its last place."""
    mantissa, _, exponent = decimal.lower().partition("e")
    places = len(mantissa.partition(".")[2]) - int(exponent or 0)
    value, half = Fraction(decimal), Fraction(1, 2) / Fraction(10) ** places
    return value - half <= enclosure[0] and enclosure[1] <= value + half


# Polynomials with rational coefficients of 1, x, x^2, ...


def value(polynomial, x):
    total = Fraction(0)
    for c in reversed(polynomial):
        total = total * x + c
    return total


def remainder(f, g):
    """The remainder of f by g, without leading zeros."""
    f = list(f)
    while len(f) >= len(g):
        factor = f[-1] / g[-1]
        for i, c in enumerate(g):
            f[len(f) - len(g) + i] -= factor * c
        f.pop()
    while f and f[-1] == 0:
        f.pop()
    return f


def common_divisor(f, g):
    while g:
        f, g = g, remainder(f, g)
    return f


def real_roots(f):
    """Narrow enclosures of the real roots in ascending order, by a Sturm chain; rational roots with small denominators exactly."""
    chain = [f, [k * c for k, c in enumerate(f)][1:]]
    while len(chain[-1]) > 1:
        chain.append([-c for c in remainder(chain[-2], chain[-1])])
        demand(chain[-1], "a node polynomial without multiple roots")

    def changes(x):
        signs = [v > 0 for v in (value(g, x) for g in chain) if v != 0]
        return sum(a != b for a, b in zip(signs, signs[1:]))

    bound = 1 + max(abs(c / f[-1]) for c in f)
    found, rest = [], [(-bound, bound)]
    while rest:
        low, high = rest.pop()
        number = changes(low) - changes(high)
        middle = (low + high) / 2
        if number == 0:
            continue
        guess = middle.limit_denominator(1000)
        if number == 1 and high - low < Fraction(1, 10**6):
            found.append((guess, guess) if value(f, guess) == 0 else narrowed(f, low, high))
        else:
            rest += [(low, middle), (middle, high)]
    return sorted(found)


def narrowed(f, low, high):
    """A narrower enclosure of the one root between these."""
    rising = value(f, high) > 0
    while high - low > Fraction(1, 10**75):
        middle = (low + high) / 2
        if (value(f, middle) > 0) == rising:
            high = middle
        else:
            low = middle
    return (low, high)


class Nodes:
    """Functions of the nodes, the roots of a polynomial m: elements of Q[x]/m. A sum over the nodes is a trace, a rational number."""

    def __init__(self, exact):
        m = [Fraction(x) for x in exact["node_polynomial"]]
        # Whole coefficients without a common factor, so that each method has one polynomial.
        whole = all(x.denominator == 1 for x in m) and math.gcd(*(x.numerator for x in m)) == 1
        demand(len(m) > 1 and m[-1] > 0 and whole, "a primitive node polynomial")
        self.m = [x / m[-1] for x in m]
        self.s = len(m) - 1
        # Sums of powers of the nodes, by Newton's identities.
        self.powers = [Fraction(self.s)]
        for k in range(1, 3 * self.s):
            sum_ = sum(
                self.m[self.s - i] * self.powers[k - i] for i in range(1, min(k - 1, self.s) + 1)
            )
            self.powers.append(-sum_ - (k * self.m[self.s - k] if k <= self.s else 0))
        self.one = self.function([1])
        self.basis = [self.function([0] * k + [1]) for k in range(self.s)]
        self.nodes = real_roots(self.m)
        demand(len(self.nodes) == self.s, "as many real nodes as the degree of their polynomial")
        self.b, self.b_tilde = self.function(exact["b"]), self.function(exact["b_tilde"])
        self.a, self.a_tilde = (
            [self.function(row) for row in exact[name]] for name in ("a", "a_tilde")
        )
        demand(len(self.a) <= self.s and len(self.a_tilde) <= self.s, "matrices of functions")
        node = self.function([0, 1]) if self.s > 1 else [-self.m[0]]
        row_sums = [self.apply(matrix, self.one) for matrix in (self.a, self.a_tilde)]
        demand(node in row_sums, "nodes c or, of an exchanged method, c_tilde")

    def function(self, coefficients):
        demand(len(coefficients) <= self.s, "a function of the nodes")
        f = [Fraction(x) for x in coefficients]
        return f + [Fraction(0)] * (self.s - len(f))

    def times(self, f, g):
        if f is self.one:
            return g
        product = [Fraction(0)] * (2 * self.s - 1)
        for i, x in enumerate(f):
            if x:
                for j, y in enumerate(g):
                    product[i + j] += x * y
        for k in range(len(product) - 1, self.s - 1, -1):
            top = product[k]
            if top:
                for i in range(self.s):
                    product[k - self.s + i] -= top * self.m[i]
        return product[: self.s]

    def sum_product(self, f, g):
        total = Fraction(0)
        for i, x in enumerate(f):
            if x:
                total += x * sum(y * self.powers[i + j] for j, y in enumerate(g) if y)
        return total

    def apply(self, matrix, f):
        """sum_j a(x, c_j) f(c_j)"""
        result = [Fraction(0)] * self.s
        for power, row in enumerate(matrix):
            sum_ = sum(y * self.powers[power + j] for j, y in enumerate(f) if y)
            for k, x in enumerate(row):
                result[k] += x * sum_
        return result

    def plus(self, x, y):
        return x + y

    def product(self, x, y):
        return x * y

    def constant(self, x):
        return self.function([x])

    def is_not_zero(self, x):
        return x != 0

    def number(self, text):
        return Fraction(text)

    def vector_at_nodes(self, f):
        return [self.at(f, node) for node in self.nodes]

    def matrix_at_nodes(self, matrix):
        powers = [[self.at(row, x) for row in matrix] for x in self.nodes]
        columns = []
        for y in self.nodes:
            if y[0] == y[1]:
                # A function of x alone.
                terms = zip(*([c * y[0] ** k for c in row] for k, row in enumerate(matrix)))
                columns.append(self.vector_at_nodes([sum(term) for term in terms]))
            else:
                columns.append([self.at_enclosures(by_powers, y) for by_powers in powers])
        return [list(row) for row in zip(*columns)]

    def at(self, f, x):
        """Zero exactly where f and m have the root in common."""
        found = self.at_enclosures([(c, c) for c in f], x)
        if found[0] < 0 < found[1]:
            common = common_divisor(self.m, remainder(f, self.m))
            if value(common, x[0]) * value(common, x[1]) < 0:
                return (Fraction(0), Fraction(0))
        return found

    def at_enclosures(self, coefficients, x):
        value = (Fraction(0), Fraction(0))
        for c in reversed(coefficients):
            value = add(multiply(value, x), c)
        return value

    def turned(self, f):
        """f(1 - x)"""
        result, power = self.function([]), self.one
        turn = self.function([1, -1]) if self.s > 1 else [1 + self.m[0]]
        for c in f:
            result = [x + c * y for x, y in zip(result, power)]
            power = self.times(power, turn)
        return result

    def can_be_turned(self):
        """Whether 1 - x is a node with x."""
        sign = (-1) ** self.s
        return all(value(self.m, t) == sign * value(self.m, 1 - t) for t in range(self.s + 1))


class Radicals:
    """Numbers that are sums of products of roots of whole numbers: polynomials in these, with r^n = d."""

    def __init__(self, exact):
        self.roots = {}
        self.b, self.b_tilde = ([self.number(x) for x in exact[name]] for name in ("b", "b_tilde"))
        self.s = len(self.b)
        if "a" not in exact:
            raise Unchecked("its matrices are left out")
        self.a, self.a_tilde = (
            [[self.number(x) for x in row] for row in exact[name]] for name in ("a", "a_tilde")
        )
        shapes = [len(self.b_tilde), len(self.a), len(self.a_tilde)]
        shapes += [len(row) for row in self.a + self.a_tilde]
        demand(all(length == self.s for length in shapes), "matrices of one size")
        self.one = [{(): Fraction(1)}] * self.s
        self.basis = [[{(): Fraction(1)} if i == k else {} for i in range(self.s)] for k in range(self.s)]

    def number(self, text):
        """Reads `-1/3 - 2*cbrt(2)/3 - cbrt(2)^2/3`."""
        total = {}
        for sign, term in re.findall(r"([+-]?)\s*([^\s+-]+)", text):
            value = {(): Fraction(-1 if sign == "-" else 1)}
            for operator, factor in re.findall(r"([*/]?)([^*/]+)", term):
                known = re.fullmatch(r"(sqrt|cbrt)\((\d+)\)(?:\^(\d+))?|(\d+)", factor)
                if not known or (operator == "/" and not known[4]):
                    raise Unchecked(f"it has numbers such as {text}")
                if known[4]:
                    whole = Fraction(int(known[4]))
                    if operator == "/":
                        demand(whole != 0, "no division by zero")
                        whole = 1 / whole
                    value = {m: c * whole for m, c in value.items()}
                else:
                    name = (known[1], int(known[2]))
                    self.roots[name] = None
                    for _ in range(int(known[3] or 1)):
                        value = self.product(value, {((name, 1),): Fraction(1)})
            total = self.plus(total, value)
        return total

    def plus(self, x, y):
        total = dict(x)
        for monomial, c in y.items():
            total[monomial] = total.get(monomial, Fraction(0)) + c
        return {monomial: c for monomial, c in total.items() if c}

    def product(self, x, y):
        total = {}
        for m, c in x.items():
            for n, d in y.items():
                powers, factor = dict(m), c * d
                for name, k in n:
                    degree = 2 if name[0] == "sqrt" else 3
                    k += powers.pop(name, 0)
                    if k >= degree:
                        factor, k = factor * name[1], k - degree
                    if k:
                        powers[name] = k
                monomial = tuple(sorted(powers.items()))
                total[monomial] = total.get(monomial, Fraction(0)) + factor
        return {monomial: c for monomial, c in total.items() if c}

    def enclosure(self, x):
        total = (Fraction(0), Fraction(0))
        for monomial, c in x.items():
            value = (c, c)
            for name, power in monomial:
                for _ in range(power):
                    value = multiply(value, self.root(name))
            total = add(total, value)
        return total

    def root(self, name):
        if self.roots.get(name) is None:
            degree, places = (2 if name[0] == "sqrt" else 3), 120
            scaled = name[1] * 10 ** (degree * places)
            low, high = 0, scaled + 1
            while high - low > 1:
                middle = (low + high) // 2
                low, high = (middle, high) if middle**degree <= scaled else (low, middle)
            self.roots[name] = (Fraction(low, 10**places), Fraction(low + 1, 10**places))
        return self.roots[name]

    def is_not_zero(self, x):
        low, high = self.enclosure(x)
        return low > 0 or high < 0

    def times(self, f, g):
        return [self.product(x, y) for x, y in zip(f, g)]

    def sum_product(self, f, g):
        total = {}
        for x, y in zip(f, g):
            if x and y:
                total = self.plus(total, self.product(x, y))
        return total

    def apply(self, matrix, f):
        return [self.sum_product(row, f) for row in matrix]

    def vector_at_nodes(self, f):
        return [self.enclosure(x) for x in f]

    def matrix_at_nodes(self, matrix):
        return [self.vector_at_nodes(row) for row in matrix]

    def constant(self, x):
        return [x] * self.s

    def turned(self, f):
        return f[::-1]

    def can_be_turned(self):
        return True


class Method:
    """A method with the weights of trees."""

    def __init__(self, algebra):
        self.algebra, self.sums, self.products = algebra, {}, {(): algebra.one}

    def product(self, children):
        """The product of the sums of these trees, at every stage."""
        if children not in self.products:
            first = self.product(children[:-1])
            self.products[children] = self.algebra.times(first, self.sum(children[-1]))
        return self.products[children]

    def sum(self, tree):
        """sum_j of a_ij or a_tilde_ij times the product of the children of a tree, at every stage."""
        if tree not in self.sums:
            matrix = self.algebra.a if tree[0] == "q" else self.algebra.a_tilde
            self.sums[tree] = self.algebra.apply(matrix, self.product(tree[1]))
        return self.sums[tree]

    def weight(self, tree):
        weights = self.algebra.b if tree[0] == "q" else self.algebra.b_tilde
        return self.algebra.sum_product(weights, self.product(tree[1]))


def is_symplectic(of):
    """b_i a~_ij + b~_j a_ji = b_i b~_j, tested with functions of i and of j."""
    if of.b != of.b_tilde:
        return False
    rows, columns = ([of.apply(m, f) for f in of.basis] for m in (of.a_tilde, of.a))
    for e, column in zip(of.basis, columns):
        for f, row in zip(of.basis, rows):
            left = of.sum_product(of.times(of.b, e), row)
            left = of.plus(left, of.sum_product(of.times(of.b_tilde, f), column))
            if left != of.product(of.sum_product(of.b, e), of.sum_product(of.b_tilde, f)):
                return False
    return True


def is_symmetric(of):
    """b_(s+1-j) = b_j and a_(s+1-i)(s+1-j) + a_ij = b_j, and so with a~ and b~."""

    def half(a, b):
        pairs = ((of.turned(of.apply(a, of.turned(f))), of.apply(a, f), f) for f in of.basis)
        return of.turned(b) == b and all(
            [of.plus(x, y) for x, y in zip(there, here)] == of.constant(of.sum_product(b, f))
            for there, here, f in pairs
        )

    return of.can_be_turned() and half(of.a, of.b) and half(of.a_tilde, of.b_tilde)


def check_decimals(algebra, decimals):
    digits = decimals["digits"]
    c, c_tilde = (algebra.apply(matrix, algebra.one) for matrix in (algebra.a, algebra.a_tilde))
    vectors = [("c", c), ("c_tilde", c_tilde), ("b", algebra.b), ("b_tilde", algebra.b_tilde)]
    rows = [(name, 0, decimals[name], algebra.vector_at_nodes(f)) for name, f in vectors]
    for name in ("a", "a_tilde"):
        matrix = algebra.matrix_at_nodes(getattr(algebra, name))
        demand(len(matrix) == len(decimals.get(name, [])), f"all rows of {name}")
        rows += [(name, i + 1, decimals[name][i], row) for i, row in enumerate(matrix)]
    for name, i, texts, enclosures in rows:
        demand(len(texts) == len(enclosures), f"as many decimals in {name} as stages")
        for j, (text, enclosure) in enumerate(zip(texts, enclosures)):
            place = f"{name}[{i}][{j + 1}]" if i else f"{name}[{j + 1}]"
            plain = text.lower().partition("e")[0].lstrip("-").replace(".", "").lstrip("0")
            demand(len(plain) in (0, digits), f"{digits} digits of {place}")
            if plain:
                demand(is_rounded(text, enclosure), f"{place} = {text}")
            else:
                demand(enclosure == (0, 0), f"{place} = 0")


def check_order(method, kind, claim):
    """Returns up to which order the conditions were checked."""
    algebra, order, checked = method.algebra, claim["order"], 0
    while checked < order and len(trees(checked + 1, kind)) <= MOST_TREES:
        checked += 1
        for tree in trees(checked, kind):
            wanted = algebra.number(f"1/{density(tree)}")
            demand(method.weight(tree) == wanted, f"order {order} ({kind}), tree {tree}")
    if "refuted_by" in claim:
        tree = read_tree(claim["refuted_by"])
        demand(size(tree) == order + 1, f"a tree of order {order + 1} ({kind})")
        demand(fits(tree, kind), f"a tree of the class {kind}")
        weight, wanted = method.weight(tree), Fraction(1, density(tree))
        demand(Fraction(claim["wanted"]) == wanted, f"1/gamma = {wanted} of {claim['refuted_by']}")
        residual = algebra.plus(weight, algebra.number(str(-wanted)))
        demand(algebra.is_not_zero(residual), f"order {order} and no higher ({kind})")
        for name, value in (("value", weight), ("residual", residual)):
            if name in claim and "…" not in claim[name]:
                demand(algebra.number(claim[name]) == value, f"{name} of {claim['refuted_by']}")
    return checked


def fits(tree, kind):
    colour, children = tree
    if kind != "general" and any(child[0] == colour for child in children):
        return False
    if kind == "nystrom" and colour == "q" and len(children) > 1:
        return False
    return all(fits(child, kind) for child in children)


def check(text):
    """Checks a file; returns what it has checked."""
    table = tomllib.loads(text)
    if "exact" not in table:
        raise Unchecked("it has enclosures in place of exact numbers")
    exact, decimals = table["exact"], table["decimals"]
    algebra = (Nodes if "node_polynomial" in exact else Radicals)(exact)
    demand(table["stages"] == algebra.s, f"{table['stages']} stages")
    check_decimals(algebra, decimals)
    done = ["decimals"]
    claims = {"symplectic": is_symplectic, "symmetric": is_symmetric}
    for name, holds in claims.items():
        claim = table["properties"][name]
        demand((claim["evidence"] == "proved") == claim["holds"], f"evidence of {name}")
        demand(holds(algebra) == claim["holds"], f"{name} = {claim['holds']}")
        done += [name] if claim["holds"] else [f"not {name}"]
    method = Method(algebra)
    for kind in ("general", "separable", "nystrom"):
        claim = table["order"][kind]
        demand(claim["evidence"] == "proved", f"a proof of the order ({kind})")
        checked = check_order(method, kind, claim)
        done.append(f"{kind} {checked}" + (f" of {claim['order']}" if checked < claim["order"] else ""))
    return ", ".join(done)


def main(paths):
    paths = [Path(path) for path in paths] or sorted(Path(__file__).parent.glob("*.toml"))
    rejected = 0
    for path in paths:
        try:
            print(f"{path.name}: right: {check(path.read_text(encoding='utf-8'))}")
        except Unchecked as reason:
            print(f"{path.name}: not checked: {reason}")
        except (Rejected, KeyError, ValueError, TypeError, tomllib.TOMLDecodeError) as error:
            rejected += 1
            print(f"{path.name}: WRONG: {error}")
    return 1 if rejected else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
