"""From printed formulas to SymPy expressions."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ._errors import ArgumentError

if TYPE_CHECKING:
    from ._system import System

#: The values of the indices of sums.
_Indices = dict[str, int]
#: A part of a formula: an expression for each value of the indices.
_Part = Callable[[_Indices], Any]

# The name in `x²` ends before the power.
_TOKEN = re.compile(r"\s*(?:(?P<number>\d+(?:\.\d+)?)|(?P<raised>[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)|(?P<name>[^\W\d][^\W⁰¹²³⁴⁵⁶⁷⁸⁹]*[′″]?)|(?P<symbol>\S))")
_DIGITS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_FUNCTIONS = {"exp", "ln", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "atan2"}


class _Reader:
    """Reads the notation in which the library prints formulas: ``(1/2) px²/m − √(x² + y²)``, ``Σ(0 ≤ i < 3) p[i]²``."""

    def __init__(self, text: str, symbols: dict[str, Any], pairs: dict[str, Any]) -> None:
        import sympy

        self._sympy, self._symbols, self._pairs = sympy, symbols, pairs
        self._tokens = [(str(found.lastgroup), found[str(found.lastgroup)]) for found in _TOKEN.finditer(text)]
        self._next = 0

    def read(self) -> Any:
        part = self._sum()
        if self._next < len(self._tokens):
            raise self._unknown()
        return part({})

    def _unknown(self) -> ArgumentError:
        found = self._tokens[self._next][1] if self._next < len(self._tokens) else "its end"
        return ArgumentError(f"the formula contains `{found}`, which has no form in SymPy")

    def _peek(self) -> tuple[str, str]:
        return self._tokens[self._next] if self._next < len(self._tokens) else ("end", "")

    def _accept(self, text: str) -> bool:
        found = self._peek()[1] == text
        self._next += found
        return found

    def _expect(self, text: str) -> None:
        if not self._accept(text):
            raise self._unknown()

    def _take(self, kind: str) -> str:
        found, text = self._peek()
        if found != kind:
            raise self._unknown()
        self._next += 1
        return text

    def _sum(self) -> _Part:
        terms = [(self._accept("−"), self._term())]
        while self._peek()[1] in ("+", "−"):
            minus = self._accept("−") or not self._accept("+")
            terms.append((minus, self._term()))
        if len(terms) == 1 and not terms[0][0]:
            return terms[0][1]
        return lambda at: self._sympy.Add(*(-term(at) if minus else term(at) for minus, term in terms))

    def _term(self) -> _Part:
        factors = [(False, self._factor())]
        while True:
            kind, text = self._peek()
            divided = self._accept("/")
            if not divided and not (kind in ("number", "name") or text in ("(", "√", "Σ")):
                break
            factors.append((divided, self._factor()))
        if len(factors) == 1:
            return factors[0][1]
        return lambda at: self._sympy.Mul(*(1 / factor(at) if divided else factor(at) for divided, factor in factors))

    def _factor(self) -> _Part:
        base = self._atom()
        if self._peek()[0] == "raised":
            power = int(self._take("raised").translate(_DIGITS))
            return lambda at: base(at) ** power
        if self._accept("^"):
            exponent = self._atom()
            return lambda at: base(at) ** exponent(at)
        return base

    def _atom(self) -> _Part:
        kind, text = self._peek()
        self._next += 1
        if kind == "number":
            number = self._sympy.Rational(text)
            return lambda at: number
        if text == "(":
            inner = self._sum()
            self._expect(")")
            return inner
        if text == "√":
            argument = self._atom()
            return lambda at: self._sympy.sqrt(argument(at))
        if text == "Σ":
            return self._total()
        if kind != "name":
            self._next -= 1
            raise self._unknown()
        if text == "π":
            return lambda at: self._sympy.pi
        if text in _FUNCTIONS:
            return self._call(text)
        indices = []
        while self._accept("["):
            indices.append(self._index())
            while self._accept(","):
                indices.append(self._index())
            self._expect("]")
        return self._element(text, indices)

    def _call(self, name: str) -> _Part:
        self._expect("(")
        arguments = [self._sum()]
        while self._accept(","):
            arguments.append(self._sum())
        self._expect(")")
        function = getattr(self._sympy, {"ln": "log"}.get(name, name))
        return lambda at: function(*(argument(at) for argument in arguments))

    def _element(self, name: str, indices: list[Callable[[_Indices], int]]) -> _Part:
        if name not in self._symbols:
            self._next -= 1
            raise self._unknown()

        def element(at: _Indices) -> Any:
            found = self._symbols[name]
            for index in indices:
                found = found[index(at)]
            return found

        return element

    def _index(self) -> Callable[[_Indices], int]:
        kind, text = self._peek()
        self._next += 1
        offset = 0
        if self._peek()[1] in ("+", "-"):
            sign = 1 if self._accept("+") or not self._accept("-") else -1
            offset = sign * int(self._take("number"))
        return lambda at: (int(text) if kind == "number" else at[text]) + offset

    def _total(self) -> _Part:
        self._expect("(")
        if self._accept("("):
            first = self._take("name")
            self._expect(",")
            second = self._take("name")
            self._expect(")")
            self._expect("in")
            pairs = self._pairs[self._take("name")]
            self._expect(")")
            values = [{first[:-1]: number, first: int(i), second: int(j)} for number, (i, j) in enumerate(pairs)]
            body = self._term()
            return lambda at: self._sympy.Add(*(body({**at, **own}) for own in values))
        start = self._index()
        self._expect("≤")
        name = self._take("name")
        self._expect("<")
        end = self._index()
        self._expect(")")
        terms = self._term()
        return lambda at: self._sympy.Add(*(terms({**at, name: value}) for value in range(start(at), end(at))))


def expression_of(system: System) -> dict[str, Any]:
    """H of a system as a SymPy expression, with its symbols.

    Parameters
    ----------
    system : System
        Its coordinates have names or a fixed number: ``q: [x, y]``, ``q: [2]``, ``q: [3; 2]``.

    Returns
    -------
    dict
        ``H``: the expression, also of a Lagrangian. ``q``, ``p``: lists of symbols; ``q[0]`` is ``q_0``, and ``q[0][1]`` is ``q_0_1``. ``t``: the
        time. ``parameters``: by name, symbols or nested lists of symbols. ``values``: the values that are set, by symbol, for ``subs``; a
        default is an exact number. All symbols are real.

    Raises
    ------
    ArgumentError
        If the number of coordinates is not fixed, or H is not a formula that SymPy has.
    ImportError
        If SymPy is not installed.

    Examples
    --------
    >>> import symplectica as sy
    >>> from symplectica._sympy import expression_of
    >>> found = expression_of(sy.system("{ m: 2 } q: [2], p: [2]; H = |p|^2/(2 m) - 1/|q|"))
    >>> found["H"]
    -1/sqrt(q_0**2 + q_1**2) + (p_0**2 + p_1**2)/(2*m)
    >>> found["H"].diff(found["p"][0]).subs(found["values"])
    p_0/2
    """
    try:
        import sympy
    except ImportError:
        raise ImportError("an expression of SymPy needs SymPy: `pip install sympy`") from None

    native = system._native
    if (refusal := native.refusal) is not None:
        raise ArgumentError(f"SymPy has no form of {refusal}")

    def symbol(name: str) -> Any:
        return sympy.Symbol(name, real=True)

    def array(name: str, lengths: list[int]) -> Any:
        return [array(f"{name}_{k}", lengths[1:]) for k in range(lengths[0])] if lengths else symbol(name)

    symbols: dict[str, Any] = {"t": symbol("t")}
    length, components = native.layout
    if (names := native.coordinates) is not None:
        halves = [list(map(symbol, half)) for half in names]
        symbols.update(zip(names[0] + names[1], halves[0] + halves[1], strict=True))
    elif length is None:
        raise ArgumentError("the formula does not fix the number of its coordinates: write it, as in `q: [3; 2]`")
    else:
        for name in ("q", "p"):
            symbols[name] = array(name, [length] if components == 1 else [length, components])
        halves = [[one for row in symbols[name] for one in (row if components > 1 else [row])] for name in ("q", "p")]

    values: dict[Any, Any] = {}
    pairs: dict[str, Any] = {}
    given = system._parameters
    parameters: dict[str, Any] = {}
    for name, lengths, default in native.parameters:
        if lengths[:1] == ["pairs"]:
            if name not in given:
                raise ArgumentError(f"the sums of the formula are over `{name}`: give its pairs in `parameters`")
            pairs[name] = given[name].reshape(-1, 2)
            continue
        sizes = [int(one) if one.isdigit() else len(pairs[one.removeprefix("pairs of ")]) if one.startswith("pairs of ") else None for one in lengths]
        if None in sizes:
            raise ArgumentError(f"the formula does not fix the length of `{name}`: write it, as in `{name}: [3]`")
        parameters[name] = symbols[name] = array(name, [size for size in sizes if size is not None])
        if name in given:
            flat = [parameters[name]] if not sizes else [one for row in parameters[name] for one in (row if len(sizes) > 1 else [row])]
            values.update(zip(flat, given[name].ravel().tolist(), strict=True))
        elif default is not None:
            values[parameters[name]] = sympy.sympify(default, rational=True)

    text = system.hamiltonian
    if "…" in text:
        raise ArgumentError("the formula is too long to be printed: it has more than 20 000 characters")
    expression = _Reader(text, symbols, pairs).read()
    return {"H": expression, "q": halves[0], "p": halves[1], "t": symbols["t"], "parameters": parameters, "values": values}
