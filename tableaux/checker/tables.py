"""Tables (.toml) of the catalogue: they say what their certificates say."""

import math
import re
import tomllib
from fractions import Fraction

from check_certificate import check_rounded, demand, density, ends, rationals, read_tree, residuals, rounded_from

from .expressions import check_expression, evaluated
from .splittings import coefficient, flows, product_of


def functions(lists):
    """Polynomials without the zeros at their ends."""
    found = [functions(f) if isinstance(f, list) else rationals([f])[0] for f in lists]
    return found[: max((k + 1 for k, f in enumerate(found) if f), default=0)]


def check_number(text, x, what):
    """Checks a decimal that goes on, `0.333…`, or an expression."""
    if text.endswith("…"):
        check_rounded(text[:-1], ends(x), rounded_from, what)
    else:
        check_expression(text, ends(x), what)


def check_condition(found, x, wanted, what):
    """Checks a violated condition: its value, what is wanted, and the difference."""
    demand(rationals([found["wanted"]])[0] == wanted, f"{wanted} as what is wanted ({what})")
    check_number(found["value"], x, f"value ({what})")
    check_number(found["residual"], x + wanted * -1, f"residual ({what})")


def check_perturbed(found, certificate, of):
    """Checks the words, such as `A^4B`, that violate the orders for H_A + eps H_B; drifts are A. Only splittings have them."""
    orders = [power["order"] for power in found]
    demand(orders == certificate.get("perturbed", orders), "the orders of the certificate (perturbed)")
    if certificate["layout"] == "matrices":
        return
    factors = product_of(flows(certificate["layout"], of.weights))
    for power in found:
        blocks = re.findall(r"([AB])(?:\^([1-9][0-9]?))?", power["refuted_by"])
        word = "".join(letter * int(copies or 1) for letter, copies in blocks)
        demand(len(word) == power["order"] + 1, f"a word of the next order, not {power['refuted_by']:.99}")
        x = coefficient(word.replace("A", "q").replace("B", "p"), factors)
        check_condition(power, x, Fraction(1, math.factorial(len(word))), "perturbed")


def check_stability(found, claim):
    """Checks the intervals and, if it is rational, the trace."""
    decimals = [interval[:2] for interval in claim["intervals"]]
    demand(found["decimal"] == decimals, "the stable intervals of the certificate")
    demand(found["closed"] == [interval[2:] for interval in claim["intervals"]], "the closed ends of the certificate")
    demand(found["determinant"] == "1", "determinant 1")
    for texts, interval in zip(found["intervals"], decimals, strict=True):
        for text, decimal in zip(texts, interval, strict=True):
            if decimal in ("0", "infinity"):
                demand(text == decimal, f"the end {decimal}, not {text}")
            elif text:
                x = evaluated(text)
                check_rounded(decimal, (x, x), rounded_from, f"{text} as the decimal of an end")
    if "numerator" in claim:
        nu = Fraction(7, 11)
        top, bottom = (sum(c * nu ** (2 * k) for k, c in enumerate(rationals(claim[name]))) for name in ("numerator", "denominator"))
        demand(evaluated(found["trace"], nu) == top / bottom, "the trace of the certificate")


def table(text, certificate, exact):
    """Checks decimals, the functions of the nodes, orders and stable steps; `exact` has functions for the ends of the coefficients."""
    table, residual = tomllib.loads(text), residuals(exact["method"])
    demand(table["stages"] == certificate["stages"], f"{table['stages']} stages")
    decimals = table["decimals"]
    needed = {"c", "c_tilde", "b", "b_tilde"} | ({"a", "a_tilde"} if certificate["layout"] == "matrices" else set())
    needed |= {"gradient"} & certificate.keys()
    demand(needed <= decimals.keys(), "decimals of all coefficients")

    def rounding(text):
        """With the digits of the table, or only zero for zero."""
        plain = text.partition("e")[0].lstrip("-").replace(".", "").lstrip("0")
        demand(text == "0" or len(plain) == decimals["digits"], f"{decimals['digits']} digits, not {text:.99}")
        return rounded_from(text) if plain else (Fraction(0), Fraction(0))

    # Long splittings have no matrices.
    for name in exact.keys() & decimals.keys():
        check_rounded(decimals[name], exact[name](), rounding, name)
    if certificate["numbers"]["kind"] == "nodes":
        demand(table["exact"]["node_polynomial"] == certificate["numbers"]["polynomial"], "the node polynomial of the certificate")
        for name in ("b", "b_tilde", "a", "a_tilde"):
            demand(functions(table["exact"][name]) == functions(certificate[name]), f"the functions of the certificate for {name}")
    for name in {"symplectic", "symmetric"} & certificate.keys() & table["properties"].keys():
        holds = certificate[name] is not False  # Or an order of the stages.
        demand(table["properties"][name]["holds"] is holds, f"{name} = {holds}, as the certificate says")
    for kind, claim in certificate["order"].items():
        found = table["order"][kind]
        demand((found["order"], found["refuted_by"]) == (claim["order"], claim["violated"]), f"the order of the certificate ({kind})")
        tree = read_tree(claim["violated"])
        wanted = Fraction(1, density(tree))
        check_condition(found, residual(tree) + wanted, wanted, kind)
    if "perturbed" in table["order"]:
        check_perturbed(table["order"]["perturbed"], certificate, exact["method"])
    if "stability" in certificate:
        check_stability(table["stability"], certificate["stability"])
    return "table"
