"""Splittings as products of exponentials exp(x_1 L_1) exp(x_2 L_2) ..., and the coefficients of words in them (HLW III.5).

A kick has the letter 'p', a drift 'q', of degree 1. A symmetric base method has the logarithm h E1 + h^3 E3 + ...: its letters are the
degrees 1, 3, ..., and its factors have no letter of their own. The conditions of Lyndon words are enough: the coefficients of all other
words are polynomials in theirs (Radford 1979).
"""

import math
from fractions import Fraction
from functools import lru_cache
from itertools import combinations, zip_longest

from check_certificate import MAX_TREES, Element, demand, is_not_zero, residuals, trees, whole

from .functions import Quotient

MAX_WORDS = 20000  # Of one length, and of all that an order needs.


def is_zero(x):
    """Whether a number is zero. An element of a field that is not may still have the value zero if its polynomial is a product."""
    demand(not isinstance(x, (Element, Quotient)) or not x or is_not_zero(x), "a number that is not zero, or whose coordinates are")
    return x == 0 if isinstance(x, (Element, Fraction, Quotient)) else False


def flows(layout, weights, is_zero=is_zero):
    """The flows of a splitting one after another, with their fractions of the step."""
    colours = "pq" if layout == "kicks first" else "qp"
    if "g" in weights:  # Half of [B, [A, B]] before the kick and half after it: the same forwards and backwards.
        colours = colours.replace("p", "gpg")
    pairs = zip(*(weights[colour] for colour in colours))
    return [(colour, x) for pair in pairs for colour, x in zip(colours, pair) if not is_zero(x)]


def coefficient(word, factors):
    """Of a word in a product: the sum over all ways to cut it into blocks, one for each factor."""
    found = [Fraction(1)] + [Fraction(0)] * len(word)
    for letter, power in factors:
        for end in range(len(word), 0, -1):
            for start in reversed(range(end)):
                if letter and word[start] != letter:
                    break
                degree = end - start if letter else sum(word[start:end])
                found[end] = found[end] + found[start] * power(degree, end - start)
    return found[-1]


def product_of(factors):
    """Factors with functions for x^degree/length!."""

    def exponential(x):
        @lru_cache(maxsize=None)
        def power(degree, length):
            if length > 1:
                return power(degree, 1) * Fraction(1, math.factorial(length))
            return x * power(degree - 1, 1) if degree > 1 else x

        return power

    return [(letter, exponential(x)) for letter, x in factors]


def is_lyndon(word):
    """Whether a word is smaller than all its ends: degrees in order, q before p."""
    order = [-ord(letter) if isinstance(letter, str) else letter for letter in word]
    return all(order < order[k:] for k in range(1, len(word)))


@lru_cache(maxsize=None)
def splitting_words(degree, kicks):
    """The Lyndon words of this length with this number of 'p'."""
    demand(math.comb(degree, kicks) <= MAX_WORDS, "orders with fewer words")
    chosen = combinations(range(degree), kicks)
    words = (tuple("p" if k in places else "q" for k in range(degree)) for places in chosen)
    return [word for word in words if is_lyndon(word)]


def splitting_conditions(orders, step):
    """The words for the order (s_1, s_2, ...) for H_A + eps H_B: degrees up to s_k with k kicks. One order is that for T(p) + U(q)."""
    kinds = [
        (degree, kicks)
        for degree in range(1, orders[0] + 1, step)
        for kicks in range(degree + 1)
        if degree == 1 or (0 < kicks < degree and degree <= orders[min(kicks, len(orders)) - 1])
    ]
    demand(sum(math.comb(*kind) for kind in kinds) <= MAX_WORDS, "orders with fewer words")
    for kind in kinds:
        yield from splitting_words(*kind)


@lru_cache(maxsize=None)
def base_words(degree):
    return [()] if degree == 0 else [(k, *rest) for k in range(1, degree + 1, 2) for rest in base_words(degree - k)]


def splitting_residual(word, factors):
    """What has to vanish: the exact flow has the coefficients 1/n!."""
    return coefficient(word, factors) - Fraction(1, math.factorial(len(word)))


def base_conditions(order, step):
    return [word for degree in range(1, order + 1, step) for word in base_words(degree) if is_lyndon(word)]


def base_residual(word, factors):
    """Of a composition of any symmetric method: the exact flow is exp(h E1)."""
    return coefficient(word, factors) - (word == (1,))


def is_palindrome(factors):
    return factors == factors[::-1]


def palindrome(of, certificate):
    """Whether the flows are the same forwards and backwards, so that the method is symmetric."""
    claim, forwards = certificate["palindrome"], flows(certificate["layout"], of.weights)
    pairs = zip(forwards, forwards[::-1])
    differ = any(one != other or is_not_zero(x + y * -1) for (one, x), (other, y) in pairs)
    demand(is_palindrome(forwards) if claim is True else claim is False and differ, f"palindrome = {claim}")
    return "palindrome" if claim else "not palindrome"


def perturbed(of, certificate):
    """Orders for H_A + eps H_B, in the powers of eps, the last one in all higher powers, and that none is higher."""
    orders = [whole(x) for x in certificate["perturbed"]]
    what = f"orders {orders} for H_A + eps H_B"
    demand(orders and 0 < orders[-1] and orders == sorted(orders, reverse=True) and orders[0] <= 30, what)
    residual, conditions, higher = by_trees(of, orders) if of.matrices else by_words(of, orders, certificate["layout"])
    for power, order in enumerate(orders, 1):
        demand(any(is_not_zero(residual(x)) for x in higher(order + 1, power)), f"{what} and no higher")
    given = of.solved.get("perturbed")
    if given:
        # Beyond the ends of the lists their last orders hold.
        pairs = zip_longest(orders, given)
        demand(all((order or orders[-1]) <= (most or given[-1]) for order, most in pairs), f"{what}, from what was solved")
    else:
        for x in conditions():
            demand(residual(x) == 0, f"{what}, {x}")
    return f"perturbed {orders}"


def by_words(of, orders, layout):
    """The residual of a word, the conditions, and those of a degree with at most this power of eps."""
    all_flows = flows(layout, of.weights)
    factors = product_of(all_flows)
    # Of a symmetric method even degrees follow from odd ones (HLW II.3).
    conditions = lambda: splitting_conditions(orders, 2 if is_palindrome(all_flows) else 1)
    higher = lambda degree, power: (word for kicks in range(1, power + 1) for word in splitting_words(degree, kicks))
    return lambda word: splitting_residual(word, factors), conditions, higher


def by_trees(of, orders):
    """The same by trees for T(p) + eps U(q): each vertex of the colour p is a force, with a factor eps."""

    def higher(degree, power):
        found = trees(degree, "separable")
        demand(len(found) <= MAX_TREES, "orders with fewer trees")
        return (tree for tree in found if kicks(tree) <= power)

    kicks = lambda tree: (tree[0] == "p") + sum(map(kicks, tree[1]))
    power = lambda degree: max(k for k, order in enumerate(orders, 1) if degree <= order)
    conditions = lambda: (tree for n in range(1, orders[0] + 1) for tree in higher(n, n if n <= orders[-1] else power(n)))
    return residuals(of), conditions, higher
