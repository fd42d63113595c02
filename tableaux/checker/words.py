"""Splittings as products of exponentials exp(x_1 L_1) exp(x_2 L_2) ..., and the coefficients of words in them (HLW III.5).

A kick has the letter 'p', a drift 'q', of degree 1. A symmetric base method has the logarithm h E1 + h^3 E3 + ...: its letters are the
degrees 1, 3, ..., and its factors have no letter of their own. The conditions of Lyndon words are enough: the coefficients of all other
words are polynomials in theirs (Radford 1979).
"""

import math
from fractions import Fraction
from functools import lru_cache
from itertools import combinations

from .numbers import demand, enclosed

MOST_WORDS = 20000  # Of one length, and of all that an order needs.


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
    return all(word < word[k:] for k in range(1, len(word)))


@lru_cache(maxsize=None)
def splitting_words(degree, kicks):
    """The Lyndon words of this length with this number of 'p'."""
    demand(math.comb(degree, kicks) <= MOST_WORDS, "orders with fewer words")
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
    demand(sum(math.comb(*kind) for kind in kinds) <= MOST_WORDS, "orders with fewer words")
    for kind in kinds:
        yield from splitting_words(*kind)


@lru_cache(maxsize=None)
def base_words(degree):
    return [()] if degree == 0 else [(k, *rest) for k in range(1, degree + 1, 2) for rest in base_words(degree - k)]


def splitting_residual(word, factors):
    """What has to vanish: the exact flow has the coefficients 1/n!."""
    return coefficient(word, factors) - Fraction(1, math.factorial(len(word)))


def base_residuals(order, step, factors):
    """Of a composition of any symmetric method: the exact flow is exp(h E1)."""
    words = [word for degree in range(1, order + 1, step) for word in base_words(degree) if is_lyndon(word)]
    return [coefficient(word, factors) - (word == (1,)) for word in words]


def check_perturbed(flows, orders, given):
    """Orders for H_A + eps H_B, in the powers of eps, the last one in all higher powers; `given` are those that are known."""
    what = f"orders {orders} for H_A + eps H_B"
    demand(orders and 0 < orders[-1] and orders == sorted(orders, reverse=True) and orders[0] <= 30, what)
    factors = product_of(flows)
    for k, order in enumerate(orders, 1):
        higher = (word for kicks in range(1, k + 1) for word in splitting_words(order + 1, kicks))
        demand(any(enclosed(splitting_residual(word, factors)).is_not_zero() for word in higher), f"{what} and no higher")
    if given:
        demand(all(order <= given[min(k, len(given) - 1)] for k, order in enumerate(orders)), f"{what}, from what was solved")
        return
    # Of a symmetric method even degrees follow from odd ones (HLW II.3).
    for word in splitting_conditions(orders, 2 if is_palindrome(flows) else 1):
        demand(splitting_residual(word, factors) == 0, f"{what}, word {''.join(word)}")


def is_palindrome(factors):
    return factors == factors[::-1]


def check_palindrome(flows, claim):
    pairs = zip(flows, flows[::-1])
    differ = any(one != other or enclosed(x + y * -1).is_not_zero() for (one, x), (other, y) in pairs)
    demand(is_palindrome(flows) if claim is True else claim is False and differ, f"palindrome = {claim}")
