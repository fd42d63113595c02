# gauss-2, 2 stages, basis polynomial(2), nodes gauss(2)
# source: Kuntzmann 1961
# source: Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964)
# source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3
# source: built as in Marsden & West 2001, Theorem 2.6.2
# source: the same method as chebyshev-2
# order 4 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
# symplectic (proved), symmetric (proved)
# written by symplectic VERSION
#
# Entries are texts: exact fractions, or decimals of as many digits as they have.
name = "gauss_2"
order = 4
c = ["0.2113248654051871177454256097490212721762", "0.7886751345948128822545743902509787278238"]
b = ["1/2", "1/2"]
a = [
    ["1/4", "-0.03867513459481288225457439025097872782380"],
    ["0.5386751345948128822545743902509787278238", "1/4"],
]


def numbers(entries, kind):
    """The same lists with numbers: `kind` makes one of a Fraction."""
    from fractions import Fraction

    if isinstance(entries, str):
        return kind(Fraction(entries))
    return [numbers(entry, kind) for entry in entries]


def fractions(entries):
    return numbers(entries, lambda fraction: fraction)


def doubles(entries):
    """Correctly rounded. For an array: numpy.array(doubles(a))."""
    return numbers(entries, float)


def mpmath_matrix(entries):
    """With the precision that mpmath has at that time."""
    import mpmath

    return mpmath.matrix(
        numbers(entries, lambda x: mpmath.mpf(x.numerator) / mpmath.mpf(x.denominator))
    )
