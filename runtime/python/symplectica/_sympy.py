"""Formulas from SymPy: from expressions to the language of formulas, and back."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from typing import Any

from ._errors import ArgumentError
from ._printed import expression_of
from ._written import Names, Writer, imported, is_function, is_name, plain, short

__all__ = ["expression_of", "text_of"]


def _listed(value: Any) -> list[Any]:
    """A list of expressions; a single one is a list of one."""
    if value is None:
        return []
    if isinstance(value, Set):
        raise ArgumentError(f"found the set {value}, which has no order: give a list")
    sympy = imported()
    is_list = isinstance(value, sympy.MatrixBase) or isinstance(value, Iterable) and not isinstance(value, sympy.Expr)
    return list(value) if is_list else [value]


def _coordinates(given: Any, key: str) -> list[Any]:
    """Coordinates: symbols, functions of the time, or derivatives of these."""
    sympy = imported()
    found = _listed(given)
    for one in found:
        known = isinstance(one, sympy.Basic) and (is_name(one) or is_function(one) or type(one).__name__ == "Derivative")
        if not known:
            raise ArgumentError(f"`{key}` contains {short(one)!r}, expected a symbol of SymPy or a function of the time")
    return found


def _expression(given: Any, key: str) -> Any:
    """An expression; of an equation, left side minus right side."""
    sympy = imported()
    if isinstance(given, sympy.Equality):
        return given.lhs - given.rhs
    try:
        found = sympy.sympify(given, strict=True)
    except sympy.SympifyError:
        found = None
    if not isinstance(found, sympy.Expr):
        raise ArgumentError(f"`{key}`: found {type(given).__name__} `{short(given)}`, expected an expression of SymPy")
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
        same = [one for one in coordinates if name in (one, plain(one))]
        if not same:
            raise ArgumentError(f"`force` has the key `{name}`; the coordinates are {', '.join(map(plain, coordinates))}")
        found[same[0]] = _expression(value, "force")
    return found


def _symbols(expressions: Iterable[Any], names: Names) -> list[Any]:
    """The symbols of expressions that have no name yet, by name."""
    found, seen, stack = set(), set(), list(expressions)
    while stack:
        one = stack.pop()
        if one in names or one in seen:
            continue
        seen.add(one)
        if is_function(one):
            raise ArgumentError(f"the formula contains the function `{short(one)}`, which is not a coordinate: list it in `q`, or write its formula")
        if type(one).__name__ == "Derivative":
            raise ArgumentError(f"the formula contains `{short(one)}`, which is not a velocity in `v`: call `.doit()`, or list it")
        if is_name(one):
            found.add(one)
        else:
            stack.extend(one.args)
    return sorted(found, key=plain)


def _check_different(symbols: Sequence[Any]) -> None:
    """Checks that no two symbols look the same."""
    known: dict[str, Any] = {}
    for symbol in symbols:
        text = str(symbol)
        if known.setdefault(text, symbol) != symbol:
            raise ArgumentError(f"two different symbols are named `{text}`: they have different assumptions, such as `positive=True`; use one of them")


def _values(parameters: Mapping[Any, Any] | None, symbols: Sequence[Any], names: Names) -> dict[str, Any]:
    """The values of parameters by their names in the text."""
    found: dict[str, Any] = {}
    for key, value in (parameters or {}).items():
        same = [one for one in symbols if (key in (plain(one), names[one]) if isinstance(key, str) else key == one)]
        if not same:
            looks = [one for one in symbols if str(one) == str(key)]
            hint = "a symbol with this name has other assumptions" if looks else f"its parameters are {', '.join(map(plain, symbols)) or 'none'}"
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
    sympy = imported()
    if not isinstance(formula, sympy.Expr):
        raise ArgumentError(f"found {type(formula).__name__}, expected a formula: a text, or an expression of SymPy")
    positions = _coordinates(q, "q")
    if not positions:
        raise ArgumentError("a formula from SymPy needs its coordinates: `q=[x, y], p=[px, py]` for H, `q=[x, y], v=[vx, vy]` for L")
    momenta, velocities = _coordinates(p, "p"), _coordinates(v, "v")
    times = {one.args[0] for one in positions if is_function(one)} | ({t} if t is not None else set())
    if len(times) > 1 or any(is_function(one) and len(one.args) != 1 for one in positions):
        raise ArgumentError(f"the coordinates must be functions of one time; found {', '.join(sorted(map(short, times)))}")
    time = next(iter(times), None)
    if not velocities and time is not None and all(map(is_function, positions)):
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
    names = Names(set() if momenta else {"v", "L"})
    is_single = [plain(one) for one in coordinates] == ["q", second]
    for one in coordinates:
        names.add(one, plain(one) if is_single else None)
    if time is not None:
        names.add(time, "t")
    expressions = [formula, *forms["constraints"].values(), *forms["nonholonomic"].values(), *forces.values(), *rates]
    symbols = _symbols(expressions, names)
    _check_different([*coordinates, *symbols])
    for symbol in symbols:
        if str(symbol) == "t" and not any(str(key) == "t" for key in parameters or {}):
            raise ArgumentError("the formula contains the symbol `t`: give `t=t` if it is the time, or its value in `parameters`")
        names.add(symbol)

    write = Writer(names)
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
