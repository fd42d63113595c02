"""Formulas from SymPy: from expressions to the language of formulas, and back."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from functools import reduce
from typing import Any

from ._errors import ArgumentError
from ._printed import expression_of

__all__ = ["expression_of", "text_of"]

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


def _sympy() -> Any:
    try:
        import sympy
    except ImportError:
        raise ImportError("a formula from SymPy needs SymPy: `pip install sympy`") from None
    return sympy


def _short(expression: Any) -> str:
    text = str(expression)
    return text if len(text) <= 80 else f"{text[:77]}…"


def _is_name(expression: Any) -> bool:
    """Whether it stands for a number: a symbol, or an element of an indexed base or of a matrix of symbols."""
    return type(expression).__name__ in ("Indexed", "MatrixElement") or bool(expression.is_Symbol)


def _is_function(expression: Any) -> bool:
    from sympy.core.function import AppliedUndef

    return isinstance(expression, AppliedUndef)


def _plain(expression: Any) -> str:
    """The name of a symbol, of a function of the time, or of its derivative."""
    if type(expression).__name__ == "Derivative":
        return "v" + _plain(expression.expr)
    return str(expression.func.__name__) if _is_function(expression) else str(getattr(expression, "name", expression))


def _cleaned(name: str) -> str:
    """A name that the language allows: letters, digits and `_`."""
    name = name.replace("'", "_prime")
    kept = "".join(c if c.isalnum() and c not in _RAISED else "_" for c in name)
    name = "_".join(part for part in kept.split("_") if part) or "x"
    return name if name[0].isalpha() else f"_{name}"


class _Names:
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
        self._of[expression] = self.new(_plain(expression)) if name is None else name


class _Writer:
    """Writes expressions."""

    def __init__(self, names: _Names) -> None:
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
            raise ArgumentError(f"the formula contains `{_short(e)}`, which does not commute: a formula has numbers only")
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
            raise ArgumentError(f"the formula contains `{_short(e)}`: {reason}")
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


def _listed(value: Any) -> list[Any]:
    """A list of expressions; a single one is a list of one."""
    if value is None:
        return []
    if isinstance(value, Set):
        raise ArgumentError(f"found the set {value}, which has no order: give a list")
    sympy = _sympy()
    is_list = isinstance(value, sympy.MatrixBase) or isinstance(value, Iterable) and not isinstance(value, sympy.Expr)
    return list(value) if is_list else [value]


def _coordinates(given: Any, key: str) -> list[Any]:
    """Coordinates: symbols, functions of the time, or derivatives of these."""
    sympy = _sympy()
    found = _listed(given)
    for one in found:
        known = isinstance(one, sympy.Basic) and (_is_name(one) or _is_function(one) or type(one).__name__ == "Derivative")
        if not known:
            raise ArgumentError(f"`{key}` contains {_short(one)!r}, expected a symbol of SymPy or a function of the time")
    return found


def _expression(given: Any, key: str) -> Any:
    """An expression; of an equation, left side minus right side."""
    sympy = _sympy()
    if isinstance(given, sympy.Equality):
        return given.lhs - given.rhs
    try:
        found = sympy.sympify(given, strict=True)
    except sympy.SympifyError:
        found = None
    if not isinstance(found, sympy.Expr):
        raise ArgumentError(f"`{key}`: found {type(given).__name__} `{_short(given)}`, expected an expression of SymPy")
    return found


def _named(given: Any, key: str) -> dict[str, Any]:
    """Constraints by name."""
    if given is None:
        return {}
    if isinstance(given, Mapping):
        return {str(name): _expression(value, key) for name, value in given.items()}
    values = [_expression(value, key) for value in _listed(given)]
    return {f"{key}{number}" if len(values) > 1 else key: value for number, value in enumerate(values)}


def _by_coordinate(given: Any, coordinates: Sequence[Any]) -> dict[Any, Any]:
    """Forces by coordinate."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        values = _listed(given)
        if len(values) != len(coordinates):
            raise ArgumentError(f"`force` has {len(values)} components; there are {len(coordinates)} coordinates")
        return {coordinate: _expression(value, "force") for coordinate, value in zip(coordinates, values, strict=True)}
    found = {}
    for name, value in given.items():
        same = [one for one in coordinates if name in (one, _plain(one))]
        if not same:
            raise ArgumentError(f"`force` has the key `{name}`; the coordinates are {', '.join(map(_plain, coordinates))}")
        found[same[0]] = _expression(value, "force")
    return found


def _symbols(expressions: Iterable[Any], names: _Names) -> list[Any]:
    """The symbols of expressions that have no name yet, by name."""
    found, seen, stack = set(), set(), list(expressions)
    while stack:
        one = stack.pop()
        if one in names or one in seen:
            continue
        seen.add(one)
        if _is_function(one):
            raise ArgumentError(f"the formula contains the function `{_short(one)}`, which is not a coordinate: list it in `q`, or write its formula")
        if type(one).__name__ == "Derivative":
            raise ArgumentError(f"the formula contains `{_short(one)}`, which is not a velocity in `v`: call `.doit()`, or list it")
        if _is_name(one):
            found.add(one)
        else:
            stack.extend(one.args)
    return sorted(found, key=_plain)


def _check_different(symbols: Sequence[Any]) -> None:
    """Checks that no two symbols look the same."""
    known: dict[str, Any] = {}
    for symbol in symbols:
        text = str(symbol)
        if known.setdefault(text, symbol) != symbol:
            raise ArgumentError(f"two different symbols are named `{text}`: they have different assumptions, such as `positive=True`; use one of them")


def _values(parameters: Mapping[Any, Any] | None, symbols: Sequence[Any], names: _Names) -> dict[str, Any]:
    """The values of parameters by their names in the text."""
    found: dict[str, Any] = {}
    for key, value in (parameters or {}).items():
        same = [one for one in symbols if (key in (_plain(one), names[one]) if isinstance(key, str) else key == one)]
        if not same:
            looks = [one for one in symbols if str(one) == str(key)]
            hint = "a symbol with this name has other assumptions" if looks else f"its parameters are {', '.join(map(_plain, symbols)) or 'none'}"
            raise ArgumentError(f"`parameters` has the key `{key}`, which is not a parameter of the formula; {hint}")
        name = names[same[0]]
        if name in found:
            raise ArgumentError(f"`parameters` has two values for `{name}`")
        found[name] = value
    return found


def text_of(
    formula: Any,
    *,
    q: Any = None,
    p: Any = None,
    v: Any = None,
    t: Any = None,
    parameters: Mapping[Any, Any] | None = None,
    constraints: Any = None,
    nonholonomic: Any = None,
    force: Any = None,
    friction: Any = None,
) -> tuple[str, dict[str, Any]]:
    """The text of a formula from SymPy, and the values of its parameters.

    Parameters
    ----------
    formula : SymPy expression
        H(t, q, p) if `p` is given; L(t, q, v) if only `v` is given. All symbols that are not coordinates or the time are parameters.
    q : list of symbols or functions of the time
        Positions: symbols, or functions such as ``dynamicsymbols("theta")``.
    p : list of symbols, optional
        Momenta.
    v : list of symbols or derivatives, optional
        Velocities of a Lagrangian, or of the `nonholonomic` forms. By default the derivatives of `q` by the time, if `q` are functions.
    t : symbol, optional
        The time; by default the argument of the functions `q`.
    parameters : dict, optional
        Values by symbol or by name; values may also be given when the system is integrated.
    constraints : expression, equation, list or dict of these, optional
        Functions φ(q) that vanish; the keys of a dict are their names.
    nonholonomic : expression, equation, list or dict of these, optional
        Linear forms w(q)·v of the velocities that vanish.
    force : dict or list, optional
        Forces without a potential, by coordinate.
    friction : expression or list, optional
        The rate γ of the force −γp, or one for each coordinate.

    Returns
    -------
    text : str
        The formula in the language of ``hamiltonian!`` and ``lagrangian!``. Rational numbers stay exact, floats are their shortest decimals.
        A name that the language does not allow is changed: ``\\theta`` to ``theta``, ``t`` of a parameter to ``t_``.
    values : dict
        The values of parameters by their names in the text.

    Raises
    ------
    ArgumentError
        For an expression that the language does not have; the error shows it.
    ImportError
        If SymPy is not installed.

    Examples
    --------
    >>> import sympy
    >>> a, pa, g, l = sympy.symbols("a p_a g l", positive=True)
    >>> text, values = text_of(pa**2 / (2 * l**2) - g * l * sympy.cos(a), q=[a], p=[pa], parameters={g: 9.81})
    >>> print(text)
    { g, l }
    q: [a], p: [p_a];
    H = -g*l*cos(a) + p_a^2/(2*l^2);
    >>> values
    {'g': 9.81}

    A Lagrangian with coordinates of ``sympy.physics.mechanics``:

    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> theta = dynamicsymbols("theta")
    >>> print(text_of(theta.diff() ** 2 / 2 + sympy.cos(theta), q=[theta])[0])
    q: [theta], v: [vtheta];
    L = cos(theta) + vtheta^2/2;
    """
    sympy = _sympy()
    if not isinstance(formula, sympy.Expr):
        raise ArgumentError(f"found {type(formula).__name__}, expected a formula: a text, or an expression of SymPy")
    positions = _coordinates(q, "q")
    if not positions:
        raise ArgumentError("a formula from SymPy needs its coordinates: `q=[x, y], p=[px, py]` for H, `q=[x, y], v=[vx, vy]` for L")
    momenta, velocities = _coordinates(p, "p"), _coordinates(v, "v")
    times = {one.args[0] for one in positions if _is_function(one)} | ({t} if t is not None else set())
    if len(times) > 1 or any(_is_function(one) and len(one.args) != 1 for one in positions):
        raise ArgumentError(f"the coordinates must be functions of one time; found {', '.join(sorted(map(_short, times)))}")
    time = next(iter(times), None)
    if not velocities and time is not None and all(map(_is_function, positions)):
        velocities = [one.diff(time) for one in positions]
    if not momenta and not velocities:
        raise ArgumentError("give the momenta `p` of a Hamiltonian, or the velocities `v` of a Lagrangian")
    for key, half in (("p", momenta), ("v", velocities)):
        if half and len(half) != len(positions):
            raise ArgumentError(f"`{key}` has {len(half)} coordinates, and `q` has {len(positions)}")
    forms = {"constraints": _named(constraints, "constraint"), "nonholonomic": _named(nonholonomic, "form")}
    forces = _by_coordinate(force, positions)
    rates = [_expression(rate, "friction") for rate in _listed(friction)]
    if momenta and forms["nonholonomic"] and not velocities:
        raise ArgumentError("the forms in `nonholonomic` are sums of velocities: name the velocities with `v`")
    if momenta and not forms["nonholonomic"]:
        velocities = []
    second, function = ("p", "H") if momenta else ("v", "L")

    coordinates = [*positions, *momenta, *velocities]
    if len(set(coordinates)) < len(coordinates):
        raise ArgumentError("a coordinate occurs twice in `q`, `p` and `v`")
    names = _Names(set() if momenta else {"v", "L"})
    is_single = [_plain(one) for one in coordinates] == ["q", second]
    for one in coordinates:
        names.add(one, _plain(one) if is_single else None)
    if time is not None:
        names.add(time, "t")
    expressions = [formula, *forms["constraints"].values(), *forms["nonholonomic"].values(), *forces.values(), *rates]
    symbols = _symbols(expressions, names)
    _check_different([*coordinates, *symbols])
    for symbol in symbols:
        if str(symbol) == "t" and not any(str(key) == "t" for key in parameters or {}):
            raise ArgumentError("the formula contains the symbol `t`: give `t=t` if it is the time, or its value in `parameters`")
        names.add(symbol)

    write = _Writer(names)
    lines = [f"{{ {', '.join(names[symbol] for symbol in symbols)} }}"] if symbols else []
    halves = {"q": positions, "p": momenta, "v": velocities}
    lines.append(", ".join(f"{key}: [{', '.join(names[one] for one in half)}]" for key, half in halves.items() if half) + ";")
    lines.append(f"{function} = {write.text(formula)};")
    for key, entries in forms.items():
        if entries:
            lines.append(f"{key}: {{ {', '.join(f'{names.new(name)} = {write.text(value)}' for name, value in entries.items())} }}")
    if forces:
        lines.append(f"force: {{ {', '.join(f'{names[one]} = {write.text(value)}' for one, value in forces.items())} }}")
    if rates:
        texts = ", ".join(map(write.text, rates))
        lines.append(f"friction: [{texts}];" if len(rates) > 1 else f"friction: {texts};")
    return "\n".join(lines), _values(parameters, symbols, names)
