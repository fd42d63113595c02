"""From SymPy expressions to text in the language of formulas."""

from __future__ import annotations

from functools import reduce
from typing import Any

from ._errors import ArgumentError

#: Words of the language that are not names.
_WORDS = {"H", "q", "p", "t", "pi", "π", "let", "sum", "in", "bonds", "extern", "fn", "invariants", "require", "self", "Self", "super", "crate", "_"}

#: Functions of the language with the class of SymPy that has the same meaning, as `NAME(arguments)`.
_FUNCTIONS = {
    "exp": "exp",
    "log": "ln",
    "sin": "sin",
    "cos": "cos",
    "tan": "tan",
    "asin": "asin",
    "acos": "acos",
    "atan": "atan",
    "sinh": "sinh",
    "cosh": "cosh",
    "tanh": "tanh",
    "atan2": "atan2",
    "Abs": "abs",
    "Max": "max",
    "Min": "min",
}

#: Functions of SymPy that are a quotient of functions of the language.
_QUOTIENTS = {"sec": "1/cos", "csc": "1/sin", "cot": "1/tan", "sech": "1/cosh", "csch": "1/sinh", "coth": "1/tanh"}

#: Other functions of the language, and those that it rejects.
_OTHER_FUNCTIONS = {"sqrt", "norm", "dot", "cross", "hypot", "sign", "floor", "ceil", "round", "mod"}

#: Why a class of SymPy is not part of the language.
_REASONS = {
    "Piecewise": "a formula has no cases: H must be smooth; `Max(x, 0)**3` vanishes for x < 0",
    "Heaviside": "H must be smooth; `Max(x, 0)**3` vanishes for x < 0",
    "sign": "H must be smooth",
    "Integral": "call `.doit()` first",
    "Sum": "call `.doit()` first",
    "Product": "call `.doit()` first",
    "re": "declare the symbols as real: `symbols('x', real=True)`",
    "im": "declare the symbols as real: `symbols('x', real=True)`",
    "conjugate": "declare the symbols as real: `symbols('x', real=True)`",
    "ImaginaryUnit": "formulas are real",
}

# How strongly a text binds.
_SUM, _PRODUCT, _POWER, _ATOM = range(4)

_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"


def imported() -> Any:
    """SymPy."""
    try:
        import sympy
    except ImportError:
        raise ImportError("a formula from SymPy needs SymPy: `pip install sympy`") from None
    return sympy


def short(expression: Any) -> str:
    text = str(expression)
    return text if len(text) <= 80 else f"{text[:77]}…"


def is_name(expression: Any) -> bool:
    """Whether it stands for a number: a symbol, or an element of an indexed base or of a matrix of symbols."""
    return type(expression).__name__ in ("Indexed", "MatrixElement") or bool(expression.is_Symbol)


def is_function(expression: Any) -> bool:
    from sympy.core.function import AppliedUndef

    return isinstance(expression, AppliedUndef)


def plain(expression: Any) -> str:
    """The name of a symbol, of a function of the time, or of its derivative."""
    if type(expression).__name__ == "Derivative":
        return "v" + plain(expression.expr)
    return str(expression.func.__name__) if is_function(expression) else str(getattr(expression, "name", expression))


def _cleaned(name: str) -> str:
    """A name that the language allows: letters, digits and `_`."""
    name = name.replace("'", "_prime")
    kept = "".join(c if c.isalnum() and c not in _RAISED else "_" for c in name)
    name = "_".join(part for part in kept.split("_") if part) or "x"
    return name if name[0].isalpha() else f"_{name}"


class Names:
    """The names of coordinates, parameters and constraints: allowed and different."""

    def __init__(self, words: set[str]) -> None:
        self._taken = _WORDS | words | set(_FUNCTIONS.values()) | _OTHER_FUNCTIONS
        self._of: dict[Any, str] = {}

    def __contains__(self, expression: object) -> bool:
        return expression in self._of

    def __getitem__(self, expression: Any) -> str:
        return self._of[expression]

    def new(self, name: str) -> str:
        """A new name like this one."""
        name = own = _cleaned(name)
        number = 1
        while own in self._taken:
            own = f"{name}_" if number == 1 else f"{name}_{number}"
            number += 1
        self._taken.add(own)
        return own

    def add(self, expression: Any, name: str | None = None) -> None:
        self._of[expression] = self.new(plain(expression)) if name is None else name


class Writer:
    """Writes expressions."""

    def __init__(self, names: Names) -> None:
        self._names = names
        self._known: dict[Any, tuple[str, int]] = {}

    def text(self, expression: Any) -> str:
        return self._written(expression)[0]

    def _held(self, expression: Any, strength: int) -> str:
        text, own = self._written(expression)
        return text if own >= strength else f"({text})"

    def _written(self, expression: Any) -> tuple[str, int]:
        if expression not in self._known:
            self._known[expression] = self._write(expression)
        return self._known[expression]

    def _write(self, e: Any) -> tuple[str, int]:
        if e in self._names:
            return self._names[e], _ATOM
        kind = type(e).__name__
        if getattr(e, "is_commutative", True) is False:
            raise ArgumentError(f"the formula contains `{short(e)}`, which does not commute: a formula has numbers only")
        if e.is_Number:
            return _number(e)
        if kind == "Pi":
            return "pi", _ATOM
        if kind == "Exp1":
            return "exp(1)", _ATOM
        if e.is_Add:
            return self._sum(e), _SUM
        if e.is_Mul or e.is_Pow and e.exp.is_Number and e.exp.is_negative:
            return self._product(e)
        if e.is_Pow:
            return self._power(e.base, e.exp)
        if kind in _QUOTIENTS:
            return f"{_QUOTIENTS[kind]}({self.text(e.args[0])})", _PRODUCT
        if kind not in _FUNCTIONS:
            reason = _REASONS.get(kind, f"the language of formulas has no `{kind}`; its functions are sqrt, {', '.join(_FUNCTIONS.values())}")
            raise ArgumentError(f"the formula contains `{short(e)}`: {reason}")
        name, arguments = _FUNCTIONS[kind], [self.text(argument) for argument in e.args]
        if kind in ("Max", "Min"):
            # SymPy gives no order; the language takes two arguments.
            first, *others = sorted(arguments)
            return reduce(lambda text, other: f"{name}({text}, {other})", others, first), _ATOM
        return f"{name}({', '.join(arguments)})", _ATOM

    def _sum(self, e: Any) -> str:
        text = ""
        for term in e.as_ordered_terms():
            own = self.text(term)
            if not text:
                text = own
            elif own.startswith("-"):
                text += f" - {own[1:]}"
            else:
                text += f" + {own}"
        return text

    def _product(self, e: Any) -> tuple[str, int]:
        coefficient, rest = e.as_coeff_Mul()
        minus = bool(coefficient.is_negative)
        above, below = [], []
        size = abs(coefficient)
        if size.is_Rational:
            above += [str(size.p)] if size.p != 1 else []
            below += [str(size.q)] if size.q != 1 else []
        else:
            above.append(_number(size)[0])
        for factor in [] if rest == 1 else rest.as_ordered_factors() if rest.is_Mul else [rest]:
            if factor.is_Pow and factor.exp.is_Number and factor.exp.is_negative:
                below.append(self._power(factor.base, -factor.exp)[0] if factor.exp != -1 else self._held(factor.base, _POWER))
            else:
                above.append(self._held(factor, _POWER))
        text = "*".join(above) or "1"
        if below:
            text += f"/{below[0]}" if len(below) == 1 else f"/({'*'.join(below)})"
        alone = len(above) == 1 and not below
        return (f"-{text}", _SUM) if minus else (text, _POWER if alone else _PRODUCT)

    def _power(self, base: Any, exponent: Any) -> tuple[str, int]:
        if exponent == 1:
            return self._held(base, _POWER), _POWER
        if exponent.is_Rational and (exponent.p, exponent.q) == (1, 2):
            return f"sqrt({self.text(base)})", _ATOM
        if type(base).__name__ == "Exp1":
            return f"exp({self.text(exponent)})", _ATOM
        return f"{self._held(base, _ATOM)}^{self._held(exponent, _ATOM)}", _POWER


def _number(value: Any) -> tuple[str, int]:
    if not value.is_finite:
        raise ArgumentError(f"the formula contains `{value}`: constants must be finite")
    if value.is_Rational:
        text = str(abs(value.p)) if value.q == 1 else f"({abs(value.p)}/{value.q})"
    else:
        # The shortest decimal of a double; all digits of a number of higher precision.
        text = repr(abs(float(value))) if value._prec == 53 else str(abs(value))
    return (f"-{text}", _SUM) if value.is_negative else (text, _ATOM)
