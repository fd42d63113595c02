"""Orders from simplifying assumptions, where trees are too many (Butcher 1964; HLW II.1 and III.2)."""

from fractions import Fraction
from itertools import count

from check_certificate import NotChecked


def assumptions(of, order, claim):
    """The claim of this order, if the order proved is not lower."""
    found = proved(of)
    return claim if order <= found else NotChecked(f"{claim} not checked: too many trees, and simplifying assumptions prove {found}")


def proved(of):
    """An order for every Hamiltonian, or 0. The method has one vector b and one vector c, and for each colour

        B(p)  sum_i b_i c_i^(k-1) = 1/k             k <= p
        C(e)  sum_j a_ij c_j^(k-1) = c_i^k/k        k <= e
        D(z)  sum_i b_i c_i^(k-1) a_ij = b_j (1 - c_j^k)/k        k <= z

    Let e be the smaller one of both colours. C replaces a subtree with m <= e vertices by leaves in place of it, and one with m = e + 1
    too if its colour has C(m): the smallest that may stay has m = min(e of its colour, e) + 1 or one vertex more. With at most 2 e + 2
    vertices, a tree keeps at most one child of its root that is no leaf, of m vertices. D(n - m) of its colour replaces the edge to it:
    trees with fewer edges above leaves remain, and in the end those of B. The exact solution satisfies B, C and D, so conditions hold.
    """
    b, c = of.weights["q"], of.apply("q", of.one)
    if b != of.weights["p"] or c != of.apply("p", of.one):
        return 0
    powers = [of.one]

    def power(k):
        while len(powers) <= k:
            powers.append(of.times(powers[-1], c))
        return powers[k]

    def largest(holds):
        return next(k for k in count(1) if k > 2 * of.s or not holds(k)) - 1

    def scaled(f, k):
        return [x * Fraction(1, k) for x in f]

    def is_d(k, rows):
        weights, rest = of.times(b, power(k - 1)), of.times(b, scaled([x - y for x, y in zip(of.one, power(k))], k))
        return all(of.dot(weights, row) == of.dot(rest, e) for e, row in zip(of.basis, rows))

    p = largest(lambda k: of.dot(b, power(k - 1)) == Fraction(1, k))
    reached = {x: largest(lambda k, x=x: of.apply(x, power(k - 1)) == scaled(power(k), k)) for x in "qp"}
    rows = {x: [of.apply(x, e) for e in of.basis] for x in "qp"}
    dual = {x: largest(lambda k, x=x: is_d(k, rows[x])) for x in "qp"}
    e = min(reached.values())
    stays = {x: min(reached[x], e + 1) + 1 for x in "qp"}
    return min(p, 2 * e + 2, *(stays[x] + dual[x] for x in "qp"))
