"""Values of the expressions in tables, such as `2*sqrt(3) - cbrt(2)^2/3` and the trace `2 − ν²`."""

import ast
import operator
import re
from decimal import Context, Decimal
from fractions import Fraction

from check_certificate import demand

OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}
SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹"
CONTEXT = Context(prec=120)  # Of roots.
NEAR = Fraction(1, 10**60)  # What roots may be wrong by.
MAX_BITS = 100_000


def root(name, x):
    x = CONTEXT.divide(Decimal(x.numerator), Decimal(x.denominator))
    return Fraction(x.sqrt(CONTEXT) if name == "sqrt" else CONTEXT.power(x, CONTEXT.divide(Decimal(1), Decimal(3))))


def evaluated(text, nu=Fraction(0)):
    """The value; `None` if the expression has other numbers than integers, their roots and `ν`."""
    demand(isinstance(text, str) and len(text) <= 5000, "an expression")
    if "…" in text or re.search(r"(root|cos|sin|tan|exp)\(|pi|\be\b", text):
        return None
    python = re.sub(f"[{SUPERSCRIPTS}]+", lambda power: "^" + "".join(str(SUPERSCRIPTS.index(c)) for c in power[0]), text)
    python = re.sub(r"([0-9)])\s*ν", r"\1*ν", python.replace("−", "-")).replace("^", "**")

    def of(node):
        match node:
            case ast.Constant(value=int(value)):
                return Fraction(value)
            case ast.Name(id="ν"):
                return nu
            case ast.UnaryOp(op=ast.USub(), operand=x):
                return -of(x)
            case ast.Call(func=ast.Name(id="sqrt" | "cbrt" as name), args=[x]):
                return root(name, of(x))
            case ast.BinOp(left=x, op=ast.Pow(), right=ast.Constant(value=int(power))):
                x = of(x)
                demand(max(x.numerator.bit_length(), x.denominator.bit_length()) * power <= MAX_BITS, f"small powers in {text:.99}")
                return x**power
            case ast.BinOp(left=x, op=op, right=y) if type(op) in OPERATORS:
                return OPERATORS[type(op)](of(x), of(y))
        demand(False, f"an expression, not {text:.99}")

    try:
        return of(ast.parse(python, mode="eval").body)
    except SyntaxError:
        demand(False, f"an expression, not {text:.99}")


def check_expression(text, ends, what):
    """Checks an expression against the ends of its number, which are equal if it is rational, as far as it can be evaluated."""
    found, slack = evaluated(text), NEAR if "(" in text else 0
    demand(found is None or ends[0] - slack <= found <= ends[1] + slack, f"{what} = {text:.99}")
