"""Exact numbers: from Python to the words of definitions, and back."""

from __future__ import annotations

from collections.abc import Iterable
from decimal import Decimal
from fractions import Fraction
from typing import Any

from ._errors import ArgumentError

#: A number of a definition: exact, or the text of an expression.
Exact = Any

#: The largest denominator of a float that is surely meant as it is: 0.5, 0.375.
_DYADIC = 1 << 16


def words(value: Exact, key: str) -> str:
    """The text of a value of a definition: a number, a text, or a list of them."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Fraction):
        return str(value)
    if isinstance(value, (int, Decimal)):
        return str(value)
    if isinstance(value, float):
        return _of_float(value, key)
    if hasattr(value, "free_symbols") or type(value).__module__.startswith("sympy"):
        return _of_sympy(value)
    if hasattr(value, "item") and getattr(value, "ndim", 0) == 0:
        return words(value.item(), key)
    if isinstance(value, Iterable):
        return "[" + ", ".join(words(part, key) for part in value) + "]"
    raise ArgumentError(
        f"`{key}`: found {type(value).__name__}, expected a number, a text such as '1/2 - sqrt(3)/6', or a list of them"
    )


def _of_sympy(value: Any) -> str:
    """The text of a SymPy constant; roots of degree 3 have a function of their own."""
    from sympy import Pow, Rational
    from sympy.printing.str import StrPrinter

    class Printer(StrPrinter):  # type: ignore[misc]
        def _print_Pow(self, expr: Any, rational: bool = False) -> str:
            base, exponent = expr.as_base_exp()
            if isinstance(exponent, Rational) and exponent.q == 3:
                root = f"cbrt({self._print(base)})"
                return root if exponent.p == 1 else f"({root})^({exponent.p})" if exponent.p > 0 else f"1/({self._print(Pow(base, -exponent))})"
            return str(super()._print_Pow(expr, rational))

    return str(Printer().doprint(value)).replace("**", "^")


def unbracketed(text: str) -> str:
    """A list without its outer brackets, as the keys of a definition take it."""
    text = text.strip()
    return text[1:-1] if text.startswith("[") and text.endswith("]") and _is_one_list(text) else text


def _is_one_list(text: str) -> bool:
    depth = 0
    for place, character in enumerate(text):
        depth += (character in "[(") - (character in "])")
        if depth == 0:
            return place == len(text) - 1
    return False


def _of_float(value: float, key: str) -> str:
    exact = Fraction(value) if value == value and abs(value) != float("inf") else None
    if exact is not None and exact.denominator <= _DYADIC:
        return str(exact)
    near = Fraction(value).limit_denominator(1000) if exact is not None else None
    hint = "write an exact number: a text such as '1/2 - sqrt(3)/6', a Fraction; printed digits are texts, with the `claim` or `order` that they have"
    if near is not None and float(near) == value and len(repr(value)) > 12:
        hint = f"write '{near}' or Fraction({near.numerator}, {near.denominator})"
    raise ArgumentError(f"`{key}` contains the float {value!r}, and nothing can be proved about a rounded number: {hint}")


def fraction(text: str) -> Fraction | None:
    """The rational number of a text such as ``-1/24``, if it is one."""
    try:
        return Fraction(text)
    except (ValueError, ZeroDivisionError):
        return None


def to_sympy(text: str) -> Any:
    """A SymPy expression of an exact form."""
    import sympy

    local = {
        "cbrt": sympy.cbrt,
        "e": sympy.E,
        "root": lambda polynomial, k: sympy.CRootOf(polynomial, int(k) - 1),
        "t": sympy.Symbol("t"),
    }
    return sympy.sympify(text.replace("^", "**"), locals=local, rational=True)
