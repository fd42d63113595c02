"""Processed compositions P K P^-1 of a symmetric method, with a kernel K and a processor P.

P is the product of the written steps, or back and forth: P(h) = Q(h) Q(-h) with that product Q. Let K be a palindrome, so that log K is odd
in h. If log P is even up to the degree p - 1, the logarithm of P K P^-1 is odd up to the degree p: the conditions of even degree follow. Log P
is even up to there if the coefficients of the words of odd degree vanish, since Lyndon words determine the others. For Q(h) Q(-h) brackets with
an even part, of degree 4 or more if the weights sum to 0, and with an odd part are what is not even: they have the degree 4 + 2j + 3 or more if
the words of odd degree up to 2j + 1 vanish in Q.
"""

from check_certificate import check_members, demand

from .splittings import base_conditions, is_palindrome


def written(numbers, read):
    """The steps that are written, and whether P is Q(h) Q(-h)."""
    check_members(numbers, ("weights", "back_and_forth"))
    demand(type(numbers["back_and_forth"]) is bool and numbers["weights"], "a processor")
    steps = [read(x) for x in numbers["weights"]]
    demand(not any(map(sum, zip(*steps))), "weights of a processor that sum to 0")
    return [(None, x) for x in steps], numbers["back_and_forth"]


def kernel(factors, steps, back_and_forth):
    """What stands between P^-1 and P."""
    minus = lambda factor: (None, tuple(-c for c in factor[1]))
    processor = [*map(minus, steps), *steps] if back_and_forth else steps
    n = len(processor)
    inverse = [minus(factor) for factor in reversed(processor)]
    demand(len(factors) > 2 * n and factors[:n] == inverse and factors[-n:] == processor, "a kernel between a processor and its inverse")
    return factors[n:-n]


def even_words(between, order, back_and_forth):
    """The step of the degrees on the whole, and the words other than (1,) that have to vanish in the written product."""
    if not is_palindrome(between):
        return 1, []
    # 2j + 1 for the smallest j with 4 + 2j + 3 >= p.
    degree = 2 * max(0, -(-(order - 7) // 2)) + 1 if back_and_forth else order - 1
    return 2, [word for word in base_conditions(degree, 2) if word != (1,)]
