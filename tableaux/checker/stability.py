"""Stability of the oscillator: for z = (h omega)^2, nu = h omega, one step is the matrix [[m11, nu m12], [-nu m21, m22]]."""

from fractions import Fraction
from functools import lru_cache

from check_certificate import (
    Element, NotChecked, check_members, common_divisor, demand, derivative, ends, primitive, product, rationals, remainder, root_between,
    rounded_from, value
)

from .functions import Quotient, trimmed
from .simple_roots import Undecided, sign, simple_roots, with_whole_ends

MAX_STAGES = 40


def stability(of, certificate):
    """The trace, and all step sizes for which the stages exist and all powers of the step are bounded."""
    claim = certificate["stability"]
    check_members(claim, ("intervals",), ("numerator", "denominator", "chain"))
    demand(of.s <= MAX_STAGES, f"at most {MAX_STAGES} stages")
    determinant, step = one_step(of)
    trace = [simple(c) for c in combined(step["11"], 1, step["22"], 1)]
    if of.matrices:
        turning = [Fraction(0)] + product(step["12"], step["21"])
        area = combined(product(step["11"], step["22"]), 1, turning, 1)
        demand(area == product(determinant, determinant), "a step of the oscillator that preserves areas")
    # Else the step is a product of shears.
    if "numerator" in claim:
        numerator, denominator = (trimmed(rationals(claim[name])) for name in ("numerator", "denominator"))
        demand(denominator and product(numerator, determinant) == product(trace, denominator), "the trace of a step of the oscillator")
    try:
        if are_rational(trace + determinant + step["12"] + step["21"]):
            found = stable_intervals(determinant, trace, common_divisor(primitive(step["12"]), primitive(step["21"])), claim["chain"])
        else:
            demand("chain" not in claim, "no chain, as a coefficient is irrational")
            found = stable_intervals_of_reals(determinant, trace)
    except Undecided:
        return NotChecked("stability not checked: the trace may touch 2 or -2")
    demand(len(found) == len(claim["intervals"]), f"{len(claim['intervals'])} intervals of stable steps")
    for interval, bounds in zip(claim["intervals"], found):
        stable = [x is closed for x, (_, closed) in zip(interval[2:], bounds)]
        demand(len(interval) == 4 and all(stable), f"the stable ends of {interval[:2]}")
        for text, (square, _) in zip(interval, bounds):
            if isinstance(square, str):
                demand(text == square, f"the end {square} of stable steps, not {text}")
            else:
                low, high = rounded_from(text, tie=0)
                demand(0 < low and low**2 <= square[0] and square[1] <= high**2, f"the end {text} of stable steps")
    return "stability"


# Polynomials and their roots.


def combined(f, x, g, y):
    """x f + y g"""
    longest = max(len(f), len(g))
    f, g = (list(h) + [Fraction(0)] * (longest - len(h)) for h in (f, g))
    return trimmed([x * u + y * v for u, v in zip(f, g)])


def check_chain(chain, f):
    """Checks Sturm's chain: the first member has the roots of f, each once; then its derivative, and negative remainders down to a number."""
    demand(isinstance(chain, list) and 1 < len(chain) <= 2 * MAX_STAGES * 3, "a chain of a bounded length")
    demand(all(type(c) is int for g in chain for c in g), "a chain of whole numbers")
    first, divides = chain[0], lambda g, f: not any(remainder(f, g)[0])
    # The first multiplies the derivative of f to a multiple of f if all roots of f are among its own.
    demand(primitive(first) == first and divides(first, f) and divides(f, product(first, derivative(f))), "the roots of the chain")
    demand(chain[1] == primitive(derivative(first)) and len(chain[-1]) == 1, "a chain from a derivative to a number")
    for f, g, h in zip(chain, chain[1:], chain[2:]):
        rest, divisor = remainder(f, g)
        demand(h == primitive([-c * divisor for c in rest]), "a chain of remainders")


def positive_roots(chain):
    """The ends of all positive roots of the first member of a chain, in order, by Sturm's theorem."""

    @lru_cache(maxsize=None)
    def changes(x):
        """How often the sign changes in the chain: more often at `low` than at `high`, once for each root above `low` up to `high`."""
        signs = [y > 0 for y in (value(g, x) for g in chain) if y]
        return sum(s != t for s, t in zip(signs, signs[1:]))

    found, rest = [], [(Fraction(0), Fraction(2 + max(abs(c) for c in chain[0]) // abs(chain[0][-1])))]
    while rest:
        low, high = rest.pop()
        count = changes(low) - changes(high)
        if count == 1 and value(chain[0], low):
            found.append(root_between(chain[0], low, high, "a root between multiples of 2^-250"))
        elif count:
            rest += [((low + high) / 2, high), (low, (low + high) / 2)]
    return found


def has_root(f, root):
    """Whether a divisor f of a polynomial with one root between these ends has it."""
    return value(f, root[0]) * value(f, root[1]) <= 0


# The oscillator.


def simple(x):
    """A number, as a fraction if it is known to be one."""
    if isinstance(x, Element):
        return x if any(x.f[1:]) else x.f[0]
    return x.rational() if isinstance(x, Quotient) else x


def are_rational(numbers):
    return all(isinstance(x, (int, Fraction)) for x in numbers)


def one_step(of):
    """The determinant of the equations of the stages, and the numerators of m11, m12, m21, m22 over it."""
    if hasattr(of, "one_step"):
        determinant, step = of.one_step()
        return determinant, {name: [simple(x) for x in f] for name, f in step.items()}
    # Q = q0 u + nu p0 A v and P = p0 v - nu q0 A~ u with u = (1 + z A A~)^-1 1 and v = (1 + z A~ A)^-1 1, as series in z.
    series, u, v = {"11": [Fraction(1)], "12": [], "21": [], "22": [Fraction(1)]}, of.one, of.one
    for _ in range(of.s + 1):
        p_u, q_v = of.apply("p", u), of.apply("q", v)
        for name, colour, f, sign in (("11", "q", p_u, -1), ("12", "q", v, 1), ("21", "p", u, 1), ("22", "p", q_v, -1)):
            series[name].append(simple(sign * of.dot(of.weights[colour], f)))
        u, v = ([x * -1 for x in of.apply(colour, f)] for colour, f in (("q", p_u), ("p", q_v)))
    determinant = determinant_of(of)
    # Numerators have degree s at most.
    return determinant, {name: trimmed(product(determinant, f)[: of.s + 1]) for name, f in series.items()}


def determinant_of(of):
    """det(1 + z A A~) by the method of Leverrier and Faddeev."""
    if not of.matrices:
        return [Fraction(1)]
    columns = [of.apply("q", of.apply("p", f)) for f in of.basis]
    matrix = [[simple(x) for x in row] for row in zip(*columns)]
    if not any(any(row[i:]) for i, row in enumerate(matrix)):
        return [Fraction(1)]  # Of a composition.
    found, power = [Fraction(1)], [[Fraction(0)] * of.s] * of.s
    for k in range(1, of.s + 1):
        # M (power + c), and the next c = -tr/k
        power = [[x + found[-1] * (i == j) for j, x in enumerate(row)] for i, row in enumerate(power)]
        power = [[sum(x * y for x, y in zip(row, column)) for column in zip(*power)] for row in matrix]
        found.append(simple(sum(power[i][i] for i in range(of.s)) * Fraction(-1, k)))
    return trimmed([(-1) ** k * c for k, c in enumerate(found)])


def stable_intervals(determinant, trace, turning, chain):
    """Where |trace| < 2, or the step is 1 or -1: pairs of ends, each the square of the step size there and whether it is stable."""
    inside = product(combined(determinant, 2, trace, -1), combined(determinant, 2, trace, 1))
    cuts = product(inside, determinant)
    demand(any(cuts), "a trace that is not 2 or -2 for all step sizes")
    check_chain(chain, primitive(without_roots_at_zero(cuts)))
    roots = positive_roots(chain)
    singular, alone = (common_divisor(chain[0], primitive(f)) for f in (determinant, turning))
    at_roots = [has_root(alone, root) and not has_root(singular, root) for root in roots]
    return cells(roots, at_roots, lambda x: value(inside, x) > 0)


def stable_intervals_of_reals(determinant, trace):
    """The same, if all roots are simple. Then none is stable: where the step is 1 or -1, |trace| - 2 touches zero."""
    factors = [combined(determinant, 2, trace, -1), combined(determinant, 2, trace, 1), determinant]
    demand(all(map(any, factors)), "a trace that is not 2 or -2 for all step sizes")
    factors = [with_whole_ends([near(c) for c in without_roots_at_zero(f)]) for f in factors]
    roots = sorted(root for f in factors for root in simple_roots(f))
    if any(x[1] >= y[0] for x, y in zip(roots, roots[1:])):
        raise Undecided
    return cells(roots, [False] * len(roots), lambda x: sign(factors[0], x) == sign(factors[1], x))


def without_roots_at_zero(f):
    return f[next(k for k, c in enumerate(f) if c) :]


def near(x):
    """The ends of an exact number, as near to each other as for a number of size 1."""
    size = max(map(abs, x.f)) or 1 if isinstance(x, Element) else 1
    scale = 1 << max(0, int(1 / size).bit_length())
    return tuple(end / scale for end in ends(x * scale))


def cells(roots, at_roots, is_stable):
    """Intervals of stable cells: from zero to the first root, that root, from there to the next one, ..."""
    lows, highs = [Fraction(0)] + [root[1] for root in roots], [root[0] for root in roots]
    samples = [(low + high) / 2 for low, high in zip(lows, highs + [lows[-1] + 2])]
    stable = [is_stable(samples[0])]
    for at_root, sample in zip(at_roots, samples[1:]):
        stable += [at_root, is_stable(sample)]
    found, start = [], None
    for k, here in enumerate(stable + [False]):
        if here and start is None:
            start = k
        elif not here and start is not None:
            # A cell ends at the root beside it, a root at itself.
            low = ("0", False) if start == 0 else (roots[(start - 1) // 2], start % 2 == 1)
            high = ("infinity", False) if k == len(stable) else (roots[(k - 1) // 2], k % 2 == 0)
            found.append((low, high))
            start = None
    return found
