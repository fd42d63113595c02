"""Random calls: every one ends with a result or an exception of this package, never with a panic or a crash."""

import os
import random

import numpy as np
import pytest

import symplectica as sy

#: 10⁵ by hand: SYMPLECTICA_FUZZ=100000.
CALLS = int(os.environ.get("SYMPLECTICA_FUZZ", "3000"))

NUMBERS = [0, 1, -1, 2, 0.5, 1e-3, 1e3, 1e300, -1e300, 1e-320, float("nan"), float("inf"), 2**70, "1/2", "1/0", "x", "", None, [], [1, 2], True, "é\u202e", "\0"]
PIECES = ["q", "p", "x", "px", "[2]", "[x]", ":", ";", ",", "H", "=", "^2", "/2", "+", "-", "*", "|q|", "|p|", "(", ")", "{", "}", "m", "sum(i: ", "sin(", "ln(", "1e999", "0", "constraints:", "friction:", "é", "√"]
FORMULAS = [
    "q: [2], p: [2]; H = |p|^2/2 - 1/|q|",
    "q: [x], p: [px]; H = px^2/2 + x^4/4",
    "{ g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)",
    "q: [x], p: [px]; H = (x^2 + 1)(px^2 + 1)/2",
    "q: [x], p: [px]; H = px^2/2 - sqrt(2 - x)",
    "q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + y constraints: { rod = x^2 + y^2 - 1 }",
    "{ m: [..] } q: [..], p: [..]; H = sum(i: p[i]^2/(2 m[i])) + sum(i: q[i]^2)/2",
    "q: [x], p: [px]; H = (px^2 + x^2)/2 friction: 0.1",
    "q: [x], v: [vx]; L = vx^2/2 - cos(x)",
]
METHODS = ["gauss-2", "gauss-4", "stormer-verlet", "blanes-moan-2002-s10", "lobatto-3", "lobatto-2", "symplectic-euler", "radau-2", "nothing", "", "a = 1", {"basis": "polynomial(2)", "nodes": "gauss(2)"}, 3]
KEYS = ["parameters", "basis", "nodes", "quadrature", "weights", "a", "b", "a_tilde", "b_tilde", "kick", "drift", "gradient", "processor", "first", "claim", "base", "compose", "symmetric", "exchange", "adjoint", "wrong"]
VALUES = ["polynomial(2)", "gauss(2)", "lobatto(3)", "polynomial(0)", "polynomial(99999)", "1, t", "0, 1", "1/2, 1/2", "triple_jump(4)", "separable(4)", "gauss-2", "velocity-verlet", "[", "1/0", "sqrt(-1)", "root(t^2 - 2, 1)"]


def some(chance: random.Random, depth: int = 0) -> object:
    """Anything."""
    if depth < 2 and chance.random() < 0.2:
        return [some(chance, depth + 1) for _ in range(chance.randrange(4))]
    return chance.choice(NUMBERS)


def vector(chance: random.Random, size: int) -> object:
    if chance.random() < 0.05:
        return some(chance)
    return [chance.choice([0.0, 1.0, -0.5, 0.3, 1e-9, 2.0, 1e200, float("nan")] if chance.random() < 0.1 else [0.0, 1.0, 0.5, 0.3]) for _ in range(size)]


def tableau(chance: random.Random) -> object:
    if chance.random() < 0.2:
        return sy.tableau(basis=f"polynomial({chance.randrange(5)})", nodes=f"gauss({chance.randrange(5)})")
    keys = chance.sample(KEYS, chance.randrange(1, 4))
    return sy.tableau(**{key: some(chance) if chance.random() < 0.2 else chance.choice(VALUES) for key in keys})


def formula(chance: random.Random) -> object:
    if chance.random() < 0.5:
        text = " ".join(chance.choice(PIECES) for _ in range(chance.randrange(1, 14)))
    else:
        letters = list(chance.choice(FORMULAS))
        for _ in range(chance.randrange(1, 4)):
            letters[chance.randrange(len(letters))] = chance.choice(PIECES)
        text = "".join(letters)
    system = sy.system(text)
    return system.equations, system.facts, repr(system), system.energy(vector(chance, 2), vector(chance, 2))


def keywords(chance: random.Random) -> dict[str, object]:
    arguments: dict[str, object] = {"t": 0.5, "step": 0.1, "method": chance.choice(METHODS if chance.random() < 0.3 else METHODS[:4])}
    if chance.random() < 0.5:
        return arguments
    choices: dict[str, list[object]] = {
        "t": [0, -0.5, *NUMBERS],
        "t0": NUMBERS,
        "step": NUMBERS,
        "output": [3, [0.1, 0.2], [0.2, 0.1], 0, *NUMBERS],
        "parameters": [{"g": 2}, {"m": [1, 2]}, {"m": some(chance)}, {"nothing": 1}, 3],
        "solver": ["newton", None, "x"],
        "accept_lower_order": [True],
        "project_starts": [True],
        "halvings": [2, -1, "x"],
    }
    for key in chance.sample(sorted(choices), chance.randrange(4)):
        arguments[key] = chance.choice(choices[key])
    # No run of this test is long.
    for key in ("t", "t0", "step"):
        value = arguments.get(key, 1.0)
        if isinstance(value, (int, float)) and (abs(value) > 10 or 0 < abs(value) < 1e-3) and value == value and abs(value) != float("inf"):
            arguments[key] = 0.25
    return arguments


def run(chance: random.Random) -> object:
    system = sy.system(chance.choice(FORMULAS))
    size = chance.choice([1, 1, 2, 3])
    arguments = keywords(chance)
    if chance.random() < 0.3:
        arguments["events"] = chance.choice(["x", "q[0]", sy.Event("px", terminal=True), sy.Event("x", wall=True, set={"px": "-px"}), sy.Event("t", direction="x"), ["x", 3], {"a": "ln(-1)"}])
    found = system.integrate(vector(chance, size), vector(chance, size), **arguments)
    return repr(found), found.energy_error, found.invariants, found.constraint_error


def ensemble(chance: random.Random) -> object:
    system = sy.system(chance.choice(FORMULAS))
    size, count = chance.choice([1, 2]), chance.choice([1, 2, 9])
    arguments = keywords(chance)
    for key, values in (("threads", [1, 2, 0, "x"]), ("section", ["x", "q[0]", 3]), ("megno", [True])):
        if chance.random() < 0.2:
            arguments[key] = chance.choice(values)
    starts = [[vector(chance, size) for _ in range(count)] for _ in range(2)]
    found = system.ensemble(*starts, **arguments)
    return repr(found), found.failures, found.energy_error


def others(chance: random.Random) -> object:
    return chance.choice(
        [
            lambda: sy.Doubles(some(chance), some(chance), order=chance.choice([0, 4, -1, 10**9])),
            lambda: sy.audit(some(chance), some(chance)),
            lambda: sy.refine(some(chance), some(chance), order=chance.choice([1, 2, 99])),
            lambda: sy.method(chance.choice([*METHODS, *NUMBERS])),
            lambda: sy.method("gauss-2").to(chance.choice(["text", "json", "coq", "x"]), chance.choice([None, 5, 0, -1, 10**9])),
            lambda: sy.method("gauss-2").require(chance.choice(["symplectic", "order == 4", "order = 4", "x", "", "stable_to(1/0)"])),
            lambda: sy.system(FORMULAS[0]).state_transition(vector(chance, 2), vector(chance, 2), t=0.3, step=0.1, method=chance.choice(METHODS)),
        ]
    )()


@pytest.mark.filterwarnings("ignore")
def test_random_calls_end_with_a_result_or_an_error_of_the_package():
    chance = random.Random(7)
    kinds = [tableau, formula, formula, run, run, ensemble, others]
    counts = {"results": 0, "errors": 0}
    with np.errstate(all="ignore"):
        for number in range(CALLS):
            seed = chance.randrange(2**32)
            kind = kinds[number % len(kinds)]
            try:
                kind(random.Random(seed))
                counts["results"] += 1
            except (sy.SymplecticError, MemoryError) as error:
                assert str(error), f"{kind.__name__} with the seed {seed} has an error without a text"
                counts["errors"] += 1
            except BaseException as error:
                raise AssertionError(f"{kind.__name__} with the seed {seed}: {type(error).__name__}: {error}") from error
    # Both happen often.
    assert counts["results"] > CALLS / 20 and counts["errors"] > CALLS / 20
