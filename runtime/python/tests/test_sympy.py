"""Formulas from and to SymPy."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest

import symplectica as sy

sympy = pytest.importorskip("sympy")

from symplectica._sympy import expression_of, text_of  # noqa: E402

x, y, px, py = sympy.symbols("x y p_x p_y", real=True)
m, g, t = sympy.symbols("m g t", positive=True)


def reason(formula: Any, **keywords: Any) -> str:
    with pytest.raises(sy.ArgumentError) as error:
        text_of(formula, **keywords)
    return str(error.value)


def test_hamiltonian_with_parameters_gives_their_values_by_name() -> None:
    text, values = text_of(px**2 / (2 * m) + m * g * x, q=[x], p=[px], parameters={m: 2, "g": 9.81})
    assert text == "{ g, m }\nq: [x], p: [p_x];\nH = g*m*x + p_x^2/(2*m);"
    assert values == {"m": 2, "g": 9.81}


@pytest.mark.parametrize(
    "function",
    [
        sympy.sqrt(x),
        x ** sympy.Rational(-5, 3),
        1 / sympy.sqrt(x**2 + 1),
        -(x**2),
        (-x) ** 3 - (1 - x) / (2 * x),
        -3 * (x - 1) ** 2 / (4 * (x + 2)),
        2**x + x**x,
        sympy.Mul(2, sympy.Add(x, -1, evaluate=False), sympy.Mul(x, 3, evaluate=False), evaluate=False),
        sympy.Pow(sympy.Pow(x, 2, evaluate=False), 3, evaluate=False),
        sympy.exp(-x) + sympy.E**2 + sympy.pi * x,
        sympy.log(x) * sympy.log(x, 10),
        sympy.sin(x) + sympy.cos(x) * sympy.tan(x / 2),
        sympy.asin(x / 2) + sympy.acos(x / 2) + sympy.atan(x),
        sympy.sinh(x) + sympy.cosh(x) / sympy.tanh(x),
        sympy.sec(x) + sympy.csc(x) - 2 / sympy.cot(x),
        sympy.sech(x) + x * sympy.csch(x) / sympy.coth(x),
        sympy.atan2(x, 2) + sympy.Abs(x - 9) ** 3,
        sympy.Max(x, 0, x - 1) ** 3 - sympy.Min(x, 0) ** 3,
        sympy.Float("0.1") * x + 1e-30 + 1.5e20,
        sympy.Float("0.1234567890123456789", 25) * x,
        sympy.Rational(1, 3) * x + sympy.Rational(-7, 5),
    ],
)
def test_expression_of_sympy_has_the_same_value_as_the_formula(function: Any) -> None:
    system = sy.system(px**2 / 2 + function, q=[x], p=[px])
    expected = float((px**2 / 2 + function).subs({x: 0.7, px: 0.3}).evalf(30))
    # A few roundings of terms of this size.
    assert system.energy([0.7], [0.3]) == pytest.approx(expected, rel=4e-15)


def test_rational_number_stays_exact() -> None:
    system = sy.system(px**2 / 2 + sympy.Rational(1, 3) * x**2, q=[x], p=[px])
    assert "(1/3) x²" in system.hamiltonian


def test_float_is_its_shortest_decimal_and_keeps_more_digits_than_those_of_a_double() -> None:
    assert "0.1*x^2" in text_of(px**2 / 2 + 0.1 * x**2, q=[x], p=[px])[0]
    assert "0.12345678901234567890*x" in text_of(px**2 / 2 + sympy.Float("0.12345678901234567890") * x, q=[x], p=[px])[0]


def test_names_that_the_language_does_not_allow_are_changed_to_different_names() -> None:
    q, p, hamilton, theta, theta_again, sine = sympy.symbols(r"q p H \theta theta sin", real=True)
    text, values = text_of(
        p**2 / 2 + px**2 + x + hamilton * q + theta * theta_again * sine, q=[q, x], p=[p, px], parameters={"H": 1, r"\theta": 2, theta_again: 3, "sin": 4}
    )
    system = sy.System(text, values)
    assert system._native.coordinates == [["q_", "x"], ["p_", "p_x"]]
    assert set(system.parameter_names) == {"H_", "theta", "theta_", "sin_"}
    assert sorted(values.values()) == [1, 2, 3, 4] and (values["H_"], values["sin_"]) == (1, 4)
    assert system.energy([1, 0], [0, 0]) == 1 + 24


def test_single_coordinate_keeps_the_name_q() -> None:
    q, p = sympy.symbols("q p")
    assert text_of(p**2 / 2 + q**2, q=q, p=p)[0] == "q: [q], p: [p];\nH = p^2/2 + q^2;"


@pytest.mark.parametrize("name", ["t", "L", "v", "lambda", "x'", "m_{1}", "2", "ħ", "self", "_", "Δ²"])
def test_parameter_with_a_strange_name_is_read(name: str) -> None:
    strange = sympy.Symbol(name)
    system = sy.system(px**2 / 2 + strange * x, q=[x], p=[px], parameters={strange: 3})
    assert system.energy([2], [0]) == 6
    v = sympy.Symbol("w")
    lagrangian = sy.system(v**2 / 2 - strange * x, q=[x], v=[v], parameters={name: 3})
    assert lagrangian.energy([2], [0]) == 6


def test_lagrangian_in_symbols_has_the_hamiltonian_of_its_momenta() -> None:
    vx, vy = sympy.symbols("v_x v_y")
    system = sy.system(m * (vx**2 + x**2 * vy**2) / 2 - g * x, q=[x, y], v=[vx, vy], parameters={m: 2, g: 3})
    assert system.momentum([2, 0], [1, 5]).tolist() == [2, 40]
    assert system.energy([2, 0], [2, 40]) == 2 * (1 + 4 * 25) / 2 + 6


def test_lagrangian_of_mechanics_in_functions_of_time_is_read_without_naming_velocities() -> None:
    mechanics = pytest.importorskip("sympy.physics.mechanics")
    theta, position = mechanics.dynamicsymbols("theta x")
    bob = sympy.Matrix([position + sympy.sin(theta), -sympy.cos(theta)])
    velocity = bob.diff(mechanics.dynamicsymbols._t)
    lagrangian = velocity.dot(velocity) / 2 + position.diff() ** 2 - g * bob[1] + mechanics.dynamicsymbols._t * position
    system = sy.system(lagrangian, q=[position, theta], parameters={g: 9.81})
    text = sy.system("{g} q: [x, a], v: [vx, va]; L = ((vx + cos(a) va)^2 + (sin(a) va)^2)/2 + vx^2 + g cos(a) + t x", parameters={"g": 9.81})
    state = [0.3, 0.5], [0.2, -0.4]
    assert system.energy(*state, t=0.7) == pytest.approx(text.energy(*state, t=0.7), rel=1e-15)


def test_hamiltonian_in_functions_of_time_has_no_velocities() -> None:
    q, p = sympy.Function("x")(t), sympy.Function("p_x")(t)
    text, _ = text_of(p**2 / 2 + t * q, q=[q], p=[p])
    assert text == "q: [x], p: [p_x];\nH = t*x + p_x^2/2;"
    assert sy.System(text).energy([2], [0], t=3) == 6


def test_sums_in_sums_have_the_value_of_the_whole() -> None:
    inner = sympy.Add(-x, sympy.Add(3, -px, evaluate=False), evaluate=False)
    nested = sympy.Add(px**2, sympy.Mul(-1, inner, evaluate=False), inner, sympy.Add(2, x, evaluate=False), evaluate=False)
    assert sy.system(nested, q=[x], p=[px]).energy([5], [7]) == 49 + 2 + 5


def test_equations_of_a_double_pendulum_from_sympy_agree_with_the_formula_in_text() -> None:
    mechanics = pytest.importorskip("sympy.physics.mechanics")
    a, b = mechanics.dynamicsymbols("a b")
    one = sympy.Matrix([sympy.sin(a), -sympy.cos(a)])
    two = one + sympy.Matrix([sympy.sin(b), -sympy.cos(b)])
    kinetic = sum(point.diff(mechanics.dynamicsymbols._t).dot(point.diff(mechanics.dynamicsymbols._t)) for point in (one, two)) / 2
    system = sy.system(kinetic - g * (one[1] + two[1]), q=[a, b], v=[a.diff(), b.diff()], parameters={g: 9.81})
    text = sy.system(
        "{ g: 9.81 } q: [a, b], p: [pa, pb]; let d = a - b;"
        "H = (pa^2 + 2 pb^2 - 2 pa pb cos(d)) / (2 (1 + sin(d)^2)) - g (2 cos(a) + cos(b))"
    )
    ends = [one.integrate([0.5, 0.4], [0.1, 0.0], t=1, step=0.01).q[-1] for one in (system, text)]
    # Both are near the solution; their terms have different roundings.
    assert np.allclose(ends[0], ends[1], rtol=0, atol=1e-12)


@pytest.mark.parametrize("given", [x**2 + y**2 - m**2, [sympy.Eq(x**2 + y**2, m**2)], {"rod": x**2 + y**2 - m**2}])
def test_constraint_in_each_form_holds_along_a_run(given: Any) -> None:
    system = sy.system((px**2 + py**2) / 2 + g * y, q=[x, y], p=[px, py], constraints=given, parameters={m: 1, g: 9.81})
    run = system.integrate([0.6, -0.8], [0.0, 0.0], t=1, step=0.01)
    assert run.constraint_error is not None and run.constraint_error.max() < 1e-13
    assert abs(np.hypot(*run.q.T) - 1).max() < 1e-13


def test_nonholonomic_form_of_a_skate_gives_the_equations_of_the_text() -> None:
    a, vx, vy, va, pa = sympy.symbols("a v_x v_y v_a p_a")
    form = vx * sympy.sin(a) - vy * sympy.cos(a)
    lagrangian = sy.system((vx**2 + vy**2 + va**2) / 2 + 2 * x, q=[x, y, a], v=[vx, vy, va], nonholonomic={"edge": form})
    hamiltonian = sy.system((px**2 + py**2 + pa**2) / 2 - 2 * x, q=[x, y, a], p=[px, py, pa], v=[vx, vy, va], nonholonomic=form)
    text = sy.system("q: [x, y, a], v: [vx, vy, va]; L = (vx^2 + vy^2 + va^2)/2 + 2 x nonholonomic: { edge = vx sin(a) - vy cos(a) }")
    ends = [one.integrate([0, 0, 0], [0, 0, 1.5], t=1, step=0.05).q[-1] for one in (lagrangian, hamiltonian, text)]
    assert np.allclose(ends[0], ends[2], atol=1e-13) and np.allclose(ends[1], ends[2], atol=1e-13)
    assert abs(ends[2][1]) > 0.1


@pytest.mark.parametrize("given", [{x: -m * px + sympy.cos(t)}, {"x": -m * px + sympy.cos(t)}, [-m * px + sympy.cos(t), 0]])
def test_force_by_symbol_name_or_list_is_that_of_the_text(given: Any) -> None:
    system = sy.system((px**2 + py**2 + x**2) / 2, q=[x, y], p=[px, py], t=t, force=given, parameters={m: 0.1})
    text = sy.system("q: [x, y], p: [px, py]; H = (px^2 + py^2 + x^2)/2 force: { x = -0.1 px + cos(t) }")
    runs = [one.integrate([1, 0], [0, 1], t=2, step=0.1) for one in (system, text)]
    assert np.allclose(runs[0].q, runs[1].q, rtol=0, atol=1e-14)


@pytest.mark.parametrize(("given", "rate"), [(0.1, "0.1"), (m, "0.1"), ([m, 2 * m], "[0.1, 0.2]")])
def test_friction_is_that_of_the_text(given: Any, rate: str) -> None:
    parameters = None if isinstance(given, float) else {m: 0.1}
    system = sy.system((px**2 + py**2 + x**2) / 2, q=[x, y], p=[px, py], friction=given, parameters=parameters)
    text = sy.system(f"q: [x, y], p: [px, py]; H = (px^2 + py^2 + x^2)/2 friction: {rate}")
    runs = [one.integrate([1, 0], [0, 1], t=2, step=0.1, method="stormer-verlet") for one in (system, text)]
    assert np.allclose(runs[0].p, runs[1].p, rtol=0, atol=1e-14)


def test_value_that_is_given_at_the_run_is_used() -> None:
    system = sy.system(px**2 / (2 * m) + g * x, q=[x], p=[px], parameters={m: 2})
    assert system.energy([1], [2], parameters={"g": 3}) == 4


@pytest.mark.parametrize("kind", [tuple, np.array, sympy.Matrix, sympy.ImmutableMatrix, lambda symbols: sympy.Tuple(*symbols)])
def test_coordinates_in_any_sequence_keep_their_order(kind: Any) -> None:
    assert text_of(px**2 + py**2 + x - y, q=kind([y, x]), p=kind([py, px]))[0].startswith("q: [y, x], p: [p_y, p_x];")


def test_indexed_coordinates_are_named_by_their_indices() -> None:
    q = sympy.IndexedBase("r")
    p = sympy.MatrixSymbol("s", 2, 1)
    text, _ = text_of(p[0, 0] ** 2 + p[1, 0] ** 2 + q[0] * q[1], q=[q[0], q[1]], p=[p[0, 0], p[1, 0]])
    assert text.startswith("q: [r_0, r_1], p: [s_0_0, s_1_0];")


@pytest.mark.parametrize(
    ("term", "words"),
    [
        (sympy.Piecewise((x, x > 0), (0, True)), "no cases"),
        (sympy.gamma(x), "the language of formulas has no `gamma`"),
        (sympy.asinh(x), "no `asinh`"),
        (sympy.Heaviside(x), "smooth"),
        (sympy.I * x, "real"),
        (sympy.oo + x, "finite"),
        (sympy.EulerGamma * x, "EulerGamma"),
        (sympy.Function("f")(x), "not a coordinate"),
        (sympy.Symbol("A", commutative=False) * x, "does not commute"),
        (sympy.Integral(sympy.exp(-(y**2)), (y, 0, x)), "doit"),
    ],
)
def test_term_that_the_language_does_not_have_is_named(term: Any, words: str) -> None:
    message = reason(px**2 / 2 + 3 * term, q=[x], p=[px])
    assert words in message


def test_second_derivative_of_a_coordinate_is_refused() -> None:
    theta = sympy.Function("theta")(t)
    assert "not a velocity" in reason(theta.diff(t) ** 2 + theta.diff(t, 2), q=[theta])


def test_symbols_of_the_same_name_with_other_assumptions_are_refused() -> None:
    assert "other" not in text_of(px**2 + x, q=[x], p=[px])[0]
    assert "two different symbols are named `x`" in reason(px**2 + sympy.Symbol("x"), q=[x], p=[px])


def test_symbol_t_without_a_meaning_is_refused() -> None:
    assert "give `t=t`" in reason(px**2 / 2 + x * t, q=[x], p=[px])
    assert text_of(px**2 / 2 + x * t, q=[x], p=[px], t=t)[0].endswith("+ t*x;")


@pytest.mark.parametrize(
    ("keywords", "words"),
    [
        ({"p": [px]}, "needs its coordinates"),
        ({"q": [x]}, "give the momenta"),
        ({"q": [x, y], "p": [px]}, "`p` has 1 coordinates, and `q` has 2"),
        ({"q": [x, x], "p": [px, py]}, "twice"),
        ({"q": ["x"], "p": [px]}, "expected a symbol"),
        ({"q": {x, y}, "p": [px, py]}, "has no order"),
        ({"q": [x], "p": [px], "parameters": {"k": 1}}, "the key `k`"),
        ({"q": [x], "p": [px], "parameters": {sympy.Symbol("m"): 1}}, "other assumptions"),
        ({"q": [x], "p": [px], "parameters": {m: 1, "m": 2}}, "two values"),
        ({"q": [x], "p": [px], "force": {y: 1}}, "the coordinates are x"),
        ({"q": [x], "p": [px], "force": [1, 2]}, "2 components"),
        ({"q": [x], "p": [px], "nonholonomic": px}, "name the velocities"),
        ({"q": [x], "p": [px], "constraints": "x"}, "expected an expression"),
        ({"q": [x], "p": [px], "constraints": x < 1}, "expected an expression"),
    ],
)
def test_argument_that_does_not_fit_is_named(keywords: dict[str, Any], words: str) -> None:
    assert words in reason(px**2 / (2 * m) + x, **keywords)


def test_sympy_that_is_not_installed_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sympy", None)
    with pytest.raises(ImportError, match="pip install sympy"):
        text_of(px**2, q=[x], p=[px])
    with pytest.raises(ImportError, match="pip install sympy"):
        expression_of(sy.system("q: [x], p: [px]; H = px^2/2"))


def test_formula_that_is_no_expression_is_refused() -> None:
    assert "expected a formula" in reason([1, 2], q=[x], p=[px])


FORMULAS = [
    "Pendulum { g: 9.81, m: 2 } q: [a], p: [pa]; H = pa^2/(2 m) - g m^2 sqrt(2) exp(-a^2/3) cos(a)/sqrt(a) + 0.1 a^(3/2)- atan2(a, m) - |a|^3 + pi a^-2",
    "q: [q], p: [p]; H = p^2/2 + 1e20 q^2 - 0.000075 q^3 (q - 2)^(-3/2) + t",
    "q: [4], p: [4]; bonds: ring; H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + d^4)",
    "q: [4], p: [4]; bonds: walls; H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + d^4)",
    "{ l: 2 } q: [x, y], v: [vx, vy]; L = (vx^2 + vy^2 + x^2 vy^2)/2 + t x - l y",
    "q: [3; 2], p: [3; 2]; H = sum(i: |p[i]|^2/2) - sum(i < j: 1/|q[i] - q[j]|) + sum(i in 0..2: q[i][0] q[i+1][1])",
]


@pytest.mark.parametrize("formula", FORMULAS)
def test_expression_of_a_formula_has_its_energy(formula: str) -> None:
    system = sy.system(formula)
    found = expression_of(system)
    dimension = len(found["q"])
    q, p = 2.5 + np.arange(dimension) ** 1.5, 0.5 - np.arange(dimension)
    point = {**found["values"], found["t"]: 0.5, **dict(zip(found["q"] + found["p"], [*q, *p], strict=True))}
    assert float(found["H"].subs(point)) == pytest.approx(system.energy(q, p, t=0.5), rel=1e-14)


@pytest.mark.parametrize("formula", FORMULAS)
def test_expression_of_a_formula_gives_the_same_system_again(formula: str) -> None:
    system = sy.system(formula)
    found = expression_of(system)
    again = sy.system(found["H"], q=found["q"], p=found["p"], t=found["t"], parameters=found["values"])
    q, p = 2.5 + np.arange(len(found["q"])), np.ones(len(found["q"]))
    assert again.energy(q, p, t=0.5) == pytest.approx(system.energy(q, p, t=0.5), rel=1e-14)


def test_expression_over_pairs_needs_the_pairs_and_arrays_have_their_values() -> None:
    text = "{ m: [3], rods: pairs, l: [rods] } q: [3; 2], p: [3; 2]; H = sum(i: |p[i]|^2/(2 m[i])) + sum(s = (i, j) in rods: (|q[i] - q[j]| - l[s])^4)"
    with pytest.raises(sy.ArgumentError, match="give its pairs"):
        expression_of(sy.system(text))
    system = sy.system(text, parameters={"rods": [(0, 1), (1, 2)], "l": [1.0, 0.5], "m": [1, 2, 3]})
    found = expression_of(system)
    q, p = np.array([[0, 0], [2, 0], [2, 3]]), np.ones((3, 2))
    point = {**found["values"], **dict(zip(found["q"] + found["p"], [*q.ravel(), *p.ravel()], strict=True))}
    assert float(found["H"].subs(point)) == pytest.approx(system.energy(q, p), rel=1e-15)


@pytest.mark.parametrize(
    ("formula", "words"),
    [
        ("q: [..], p: [..]; H = sum(i: p[i]^2)", "does not fix the number"),
        ("System<N> { m: [N] } q: [N], p: [N]; H = sum(i: p[i]^2/m[i])", "does not fix the number"),
        ("System<N> { m: [N] } q: [2], p: [2]; H = |p|^2 + |q|^2 sum(i in 0..N: m[i])", "does not fix the length of `m`"),
        ("q: [x], v: [w]; L = w^4/4 + w^2/2", "not quadratic"),
    ],
)
def test_expression_of_a_formula_without_a_fixed_form_is_refused(formula: str, words: str) -> None:
    with pytest.raises(sy.ArgumentError, match=words):
        expression_of(sy.system(formula))
