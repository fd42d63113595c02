#!/usr/bin/env python3
"""Checks certificates of symplectic methods, and shares no code with the compiler that wrote them.

    python3 check_certificate.py certificates/gauss-2.json certificates/forest-ruth-1990.json
    python3 check_certificate.py                      # every certificate and table of the catalogue

This is the place to start trusting: this file and the folder `checker`, Python 3.11 and its standard library. A certificate has the
coefficients of a method as exact numbers, and what is claimed of them. From the coefficients alone this program proves

  * the doubles: none is nearer to the exact coefficient;
  * that a method is `symplectic` and `symmetric` or not, or that a splitting is a `palindrome`;
  * the `order` for each class of Hamiltonians: all order conditions up to it, from trees that this program makes itself, and that the
    condition of `violated`, a tree of the next order, does not hold;
  * the `perturbed` orders of a splitting for H_A + eps H_B, from words, and that none is higher;
  * `stability`: the trace of a step of the oscillator, and all step sizes that are stable.

Coefficients that are the solution of order conditions are proved to exist. Orders with more than MOST_TREES trees are not checked: the
output says "general 6 (8 is claimed)", and what a certificate itself names as not covered. A table of the same name in the folder above is checked too: its
decimals, functions of the nodes and orders.
"""

import json
import sys
from fractions import Fraction
from pathlib import Path

from checker.methods import Nodes, Stages, Weights
from checker.numbers import Field, Rejected, check_decimal, check_double, demand, enclosed, whole
from checker.solutions import Solution
from checker.stability import check_stability
from checker.tables import check_table
from checker.trees import fits, read_tree, size, trees, unrooted
from checker.words import check_palindrome, check_perturbed

MOST_TREES = 1000
MOST_BYTES = 1 << 24
MOST_STAGES = 64
# Errors of files that are no certificates.
WRONG = (Rejected, ArithmeticError, AttributeError, LookupError, MemoryError, OSError, RecursionError, TypeError, ValueError)
CLASSES = ("general", "separable", "nystrom")
NOT_COVERED = {"symplectic", "symmetric", "palindrome", "stability", "order (perturbed)", *(f"order ({kind})" for kind in CLASSES)}
MEMBERS = ("format", "version", "name", "stages", "layout", "numbers", "b", "b_tilde", "doubles", "order", "not_covered")
NUMBERS = {"nodes": ("polynomial",), "field": ("polynomial", "root"), "solution": ("class", "orders", "unknowns")}


def check_members(thing, needed, optional=()):
    demand(isinstance(thing, dict), "an object")
    for name in needed:
        thing[name]
    demand(thing.keys() <= {*needed, *optional}, f"members that are known, not {', '.join(thing.keys() - {*needed, *optional})}")


def symplectic(of):
    """What has to vanish: b_i a~_ij + b~_j a_ji - b_i b~_j, tested with functions of i and of j, and b_i - b~_i (HLW VI.4)."""
    b, b_tilde = of.weights["q"], of.weights["p"]
    rows, columns = ([of.apply(colour, f) for f in of.basis] for colour in "pq")
    yield from (x - y for x, y in zip(b, b_tilde))
    for e, column in zip(of.basis, columns):
        for f, row in zip(of.basis, rows):
            yield of.dot(of.times(b, e), row) + of.dot(of.times(b_tilde, f), column) - of.dot(b, e) * of.dot(b_tilde, f)


def symmetric(of):
    """What has to vanish: b_(s+1-j) - b_j and a_(s+1-i)(s+1-j) + a_ij - b_j, and so with a~ and b~ (HLW V.2)."""
    if not of.can_be_turned():
        yield Fraction(1)
        return
    for colour in "qp":
        b = of.weights[colour]
        yield from (x - y for x, y in zip(of.turned(b), b))
        for f in of.basis:
            there, here = of.turned(of.apply(colour, of.turned(f))), of.apply(colour, f)
            yield from (x + y - of.dot(b, f) * z for x, y, z in zip(there, here, of.one))


def check_property(name, claim, residuals):
    """All residuals are zero, or the value of one is not."""
    holds = all(not x for x in residuals) if claim is True else any(enclosed(x).is_not_zero() for x in residuals)
    demand(type(claim) is bool and holds, f"{name} = {claim}")


def coefficients(of):
    """All coefficients by their names in files."""
    rows = {"b": of.values(of.weights["q"]), "b_tilde": of.values(of.weights["p"])}
    for colour, tilde in (("q", ""), ("p", "_tilde")):
        rows["c" + tilde] = of.values(of.apply(colour, of.one))
        rows |= {f"a{tilde}[{i + 1}]": row for i, row in enumerate(of.entries(colour))}
    return rows


def check_doubles(rows, doubles):
    for name in ("a", "a_tilde"):
        demand(name not in doubles or len(doubles[name]) == len(rows["b"]), f"as many rows of doubles in {name} as stages")
    for name, numbers in rows.items():
        name, _, row = name.partition("[")
        # The weights of a splitting say its matrices.
        if name in doubles or not row:
            texts = doubles[name][int(row[:-1]) - 1] if row else doubles[name]
            demand(len(texts) == len(numbers), f"as many doubles in {name} as stages")
            for j, (text, x) in enumerate(zip(texts, numbers)):
                check_double(text, x, f"{name}[{row}[{j + 1}]" if row else f"{name}[{j + 1}]")


def check_order(weights, kind, claim, given, one_rooting):
    """Returns up to which order the conditions were checked; `given` is the order that is known."""
    check_members(claim, ("order", "violated", "residual"))
    order, checked = whole(claim["order"]), 0
    what = f"order {order} ({kind})"
    tree = read_tree(claim["violated"])
    demand(size(tree) == order + 1 and fits(tree, kind), f"{what}: {claim['violated']} as a tree of the next order and the class")
    residual = weights.residual(tree)
    check_decimal(claim["residual"], residual, f"{what}: residual of {claim['violated']}")
    demand(enclosed(residual).is_not_zero(), f"{what} and no higher")
    if given is not None:
        demand(order <= given, f"{what}, from the conditions that were solved")
        return order
    while checked < order and len(trees(checked + 1, kind)) <= MOST_TREES:
        checked += 1
        for tree in (unrooted if one_rooting else trees)(checked, kind):
            demand(weights.residual(tree) == 0, f"{what}, tree {tree}")
    return checked


def method_of(certificate):
    """The method, and the orders that follow from the conditions that were solved."""
    numbers, layout, stages = certificate["numbers"], certificate["layout"], whole(certificate["stages"])
    demand(numbers["kind"] in NUMBERS, "numbers of a kind that is known")
    check_members(numbers, ("kind", *NUMBERS[numbers["kind"]]), ("weights",) if numbers.get("class") == "composition" else ())
    count = len(numbers["polynomial"]) - 1 if numbers["kind"] == "nodes" else len(certificate["b"])
    demand(0 < stages <= MOST_STAGES and stages == count, f"{stages} stages, of at most {MOST_STAGES}")
    weights = {"q": certificate["b"], "p": certificate["b_tilde"]}
    matrices = {"q": certificate["a"], "p": certificate["a_tilde"]} if layout == "matrices" else {}
    if numbers["kind"] == "nodes":
        demand(matrices, "matrices of functions of the nodes")
        return Nodes(numbers["polynomial"], weights, matrices), ({}, None)
    if numbers["kind"] == "solution":
        solution = Solution(numbers, layout, weights)
        return Stages(layout, solution.weights, {}), solution.given()
    field = Field(numbers["polynomial"], numbers["root"])
    weights = {colour: [field.number(x) for x in f] for colour, f in weights.items()}
    matrices = {colour: [[field.number(x) for x in row] for row in rows] for colour, rows in matrices.items()}
    return Stages(layout, weights, matrices), ({}, None)


def read(text):
    """An object. Its numbers are whole, and its members have different names."""

    def refuse(number):
        raise Rejected(f"a whole number or a text, not {number:.40}")

    def members(pairs):
        demand(len(dict(pairs)) == len(pairs), "members with different names")
        return dict(pairs)

    found = json.loads(text, parse_float=refuse, parse_constant=refuse, object_pairs_hook=members)
    demand(isinstance(found, dict), "an object")
    return found


def check(text):
    """Checks a certificate; returns it with the coefficients and what was checked."""
    certificate = read(text)
    demand(certificate["format"] == "symplectic certificate" and whole(certificate["version"]) == 1, "a certificate of version 1")
    layout = certificate["layout"]
    demand(layout in ("matrices", "kicks first", "drifts first"), "a layout that is known")
    matrices = ("a", "a_tilde") if layout == "matrices" else ()
    properties = ("symplectic", "symmetric") if matrices else ("palindrome", "perturbed")
    check_members(certificate, (*MEMBERS, *matrices), (*properties, "stability"))
    check_members(certificate["doubles"], ("c", "c_tilde", "b", "b_tilde", *matrices), ("a", "a_tilde"))
    missing = certificate["not_covered"]
    demand(isinstance(missing, list) and all(name in NOT_COVERED for name in missing), "not_covered as a list of claims")
    of, (given, powers) = method_of(certificate)
    rows, done = coefficients(of), ["doubles"]
    check_doubles(rows, certificate["doubles"])
    for name, residuals in (("symplectic", symplectic), ("symmetric", symmetric)):
        if name in certificate:
            check_property(name, certificate[name], residuals(of))
            done.append(name if certificate[name] else f"not {name}")
    if "palindrome" in certificate:
        check_palindrome(of.flows(), certificate["palindrome"])
        done.append("palindrome" if certificate["palindrome"] else "not palindrome")
    weights = Weights(of)
    check_members(certificate["order"], (), CLASSES)
    for kind, claim in certificate["order"].items():
        one_rooting = certificate.get("symplectic", not of.matrices and kind != "general")
        checked = check_order(weights, kind, claim, given.get(kind), one_rooting)
        done.append(f"{kind} {checked}" + (f" ({claim['order']} is claimed)" if checked < claim["order"] else ""))
    if "perturbed" in certificate:
        check_perturbed(of.flows(), [whole(x) for x in certificate["perturbed"]], powers)
        done.append(f"perturbed {certificate['perturbed']}")
    if "stability" in certificate:
        check_members(certificate["stability"], ("numerator", "denominator", "intervals"))
        check_stability(of, certificate["stability"])
        done.append("stability")
    return certificate, rows, done + [f"{name} not covered" for name in certificate["not_covered"]]


def say(text):
    """One line, whatever a file has in its texts."""
    print("".join(c if c.isprintable() else "?" for c in text[:1000]), flush=True)


def reason(error):
    if isinstance(error, Rejected):
        return f"not proved: {error}"
    if isinstance(error, KeyError):
        return f"the member {error} is missing"
    return f"{type(error).__name__}: {error}"


def content(path):
    demand(path.stat().st_size <= MOST_BYTES and path.is_file(), f"a file of at most {MOST_BYTES} bytes")
    return path.read_text(encoding="utf-8")


def main(paths):
    paths = [Path(path) for path in paths] or sorted((Path(__file__).parent / "certificates").glob("*.json"))
    wrong = 0
    for path in paths:
        try:
            certificate, rows, done = check(content(path))
            table = path.parent.parent / f"{path.stem}.toml"
            if table.exists():
                check_table(content(table), certificate, rows)
                done.append("table")
            verdict = f"right: {', '.join(done)}"
        except WRONG as error:
            wrong += 1
            verdict = f"WRONG: {reason(error)}"
        say(f"{path.name}: {verdict}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.stdout.reconfigure(errors="backslashreplace")
    sys.exit(main(sys.argv[1:]))
