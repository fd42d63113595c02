"""Tables (.toml) of the catalogue: they say what their certificates say."""

import tomllib
from fractions import Fraction

from check_certificate import check_rounded, demand, density, rationals, read_tree, rounded_from


def functions(lists):
    """Polynomials without the zeros at their ends."""
    found = [functions(f) if isinstance(f, list) else rationals([f])[0] for f in lists]
    return found[: max((k + 1 for k, f in enumerate(found) if f), default=0)]


def table(text, certificate, exact):
    """Checks decimals, the functions of the nodes and the orders; `exact` has functions for the ends of all coefficients, by name."""
    table = tomllib.loads(text)
    demand(table["stages"] == certificate["stages"], f"{table['stages']} stages")
    decimals = table["decimals"]
    needed = {"c", "c_tilde", "b", "b_tilde"} | ({"a", "a_tilde"} if certificate["layout"] == "matrices" else set())
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
        demand(rationals([found["wanted"]])[0] == Fraction(1, density(read_tree(claim["violated"]))), f"1/gamma ({kind})")
    return "table"
