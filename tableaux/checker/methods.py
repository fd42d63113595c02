"""Methods. A vector has a number for each stage; matrices are seen only by what they make of vectors.

The method is  Q_i = q0 + h sum_j a_ij V_j,  P_i = p0 + h sum_j a_tilde_ij F_j,  q1 = q0 + h sum_i b_i V_i,  p1 = p0 + h sum_i b_tilde_i F_i
with V_i = dH/dp and F_i = -dH/dq at (Q_i, P_i). What is multiplied with V has the colour q, what is multiplied with F the colour p.
"""

from fractions import Fraction

from .numbers import Quotient, Roots, between, common_divisor, demand, enclosed, has_root, is_zero, monic, product, rationals, reduced, trimmed, value
from .trees import density


class Stages:
    """Vectors as lists. The matrices of splittings are given by their weights."""

    def __init__(self, layout, weights, matrices):
        self.layout, self.weights, self.matrices = layout, weights, matrices
        self.s = len(weights["q"])
        rows = [row for matrix in matrices.values() for row in (matrix, *matrix)]
        demand(all(len(row) == self.s for row in (weights["p"], *rows)), "lists of one length")
        self.one = [Fraction(1)] * self.s
        self.basis = [[Fraction(i == k) for i in range(self.s)] for k in range(self.s)]

    def times(self, f, g):
        return [x * y if x and y else Fraction(0) for x, y in zip(f, g)]

    def dot(self, f, g):
        return sum((x * y for x, y in zip(f, g) if x and y), Fraction(0))

    def apply(self, colour, f):
        """sum_j a_ij f_j, or with a_tilde"""
        if self.matrices:
            return [self.dot(row, f) for row in self.matrices[colour]]
        total, found = Fraction(0), []
        own = (self.layout == "kicks first") == (colour == "p")
        for term in self.times(self.weights[colour], f):
            found.append(total + term if own else total)
            total = total + term
        return found

    def values(self, f):
        return f

    def entries(self, colour):
        return self.matrices.get(colour) or [list(row) for row in zip(*(self.apply(colour, f) for f in self.basis))]

    def flows(self, is_zero=is_zero):
        """The flows of a splitting one after another, with their fractions of the step."""
        first = "pq" if self.layout == "kicks first" else "qp"
        pairs = zip(*(self.weights[colour] for colour in first))
        return [(colour, x) for pair in pairs for colour, x in zip(first, pair) if not is_zero(x)]

    def turned(self, f):
        return f[::-1]

    def can_be_turned(self):
        return True


class Nodes:
    """Vectors as functions of the nodes, the roots of a polynomial m: elements of Q[x]/m. A sum over the nodes is a trace."""

    def __init__(self, polynomial, weights, matrices):
        self.m = monic(polynomial)
        self.s, self.ring = len(self.m) - 1, Quotient(self.m)
        # Sums of powers of the nodes, by Newton's identities.
        self.powers = [Fraction(self.s)]
        for k in range(1, 3 * self.s):
            sum_ = sum(self.m[self.s - i] * self.powers[k - i] for i in range(1, min(k - 1, self.s) + 1))
            self.powers.append(-sum_ - (k * self.m[self.s - k] if k <= self.s else 0))
        self.basis = [[Fraction(i == k) for i in range(self.s)] for k in range(self.s)]
        self.one = self.basis[0]
        self.nodes = Roots(self.m).all()
        demand(len(self.nodes) == self.s, "as many real nodes as the degree of their polynomial")
        self.weights = {colour: self.function(f) for colour, f in weights.items()}
        self.matrices = {colour: [self.function(f) for f in rows] for colour, rows in matrices.items()}
        demand(all(len(rows) <= self.s for rows in self.matrices.values()), "matrices of functions")
        sums = [self.apply(colour, self.one) for colour in "qp"]
        demand(reduced([Fraction(0), Fraction(1)], self.m) in sums, "nodes that are c or, of an exchanged method, c_tilde")

    def function(self, f):
        f = rationals(f)
        demand(len(f) <= self.s, "a function of the nodes")
        return f + [Fraction(0)] * (self.s - len(f))

    def times(self, f, g):
        return self.ring.product(f, g)

    def dot(self, f, g):
        return sum(x * self.dot_power(i, g) for i, x in enumerate(f) if x)

    def dot_power(self, i, f):
        return sum(x * self.powers[i + j] for j, x in enumerate(f) if x)

    def apply(self, colour, f):
        """sum_j a(x, c_j) f(c_j): the rows of a matrix are the factors of the powers of c_j."""
        found = [Fraction(0)] * self.s
        for power, row in enumerate(self.matrices[colour]):
            sum_ = self.dot_power(power, f)
            found = [x + c * sum_ for x, c in zip(found, row)]
        return found

    def values(self, f):
        return [self.at(f, node) for node in self.nodes]

    def at(self, f, node):
        if node[0] == node[1]:
            return value(f, node[0])
        found = enclosed(value(f, between(*node)))
        if not found.is_not_zero() and any(f) and has_root(common_divisor(self.m, trimmed(list(f))), node):
            return Fraction(0)
        return found if any(f) else Fraction(0)

    def entries(self, colour):
        columns = []
        for node in self.nodes:
            y = node[0] if node[0] == node[1] else between(*node)
            if isinstance(y, Fraction):
                terms = zip(*([c * y**k for c in row] for k, row in enumerate(self.matrices[colour])))
                columns.append(self.values([sum(term) for term in terms]))
            else:
                columns.append([value([self.at(row, x) for row in self.matrices[colour]], y) for x in self.nodes])
        return [list(row) for row in zip(*columns)]

    def turned(self, f):
        """f(1 - x)"""
        found, power = self.function([]), self.one
        for c in f:
            found = [x + c * y for x, y in zip(found, power)]
            power = reduced(product(power, [Fraction(1), Fraction(-1)]), self.m)
        return found

    def can_be_turned(self):
        """Whether 1 - x is a node with x."""
        sign = (-1) ** self.s
        return all(value(self.m, t) == sign * value(self.m, 1 - t) for t in range(self.s + 1))


class Weights:
    """The elementary weights of trees (HLW III.2)."""

    def __init__(self, method):
        self.method, self.sums, self.products = method, {}, {(): method.one}

    def product(self, children):
        """The product of the sums of these trees, at every stage."""
        if children not in self.products:
            first = self.product(children[:-1])
            self.products[children] = self.method.times(first, self.sum(children[-1]))
        return self.products[children]

    def sum(self, tree):
        """sum_j of a_ij or a_tilde_ij times the product of the children of a tree, at every stage."""
        if tree not in self.sums:
            self.sums[tree] = self.method.apply(tree[0], self.product(tree[1]))
        return self.sums[tree]

    def residual(self, tree):
        colour, children = tree
        return self.method.dot(self.method.weights[colour], self.product(children)) - Fraction(1, density(tree))
