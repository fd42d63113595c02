"""Tables (.toml) of the catalogue: they say what their certificates say."""

import tomllib
from fractions import Fraction

from .numbers import check_decimal, demand, enclosed, rationals, trimmed
from .trees import density, read_tree


def functions(lists):
    """Polynomials without the zeros at their ends."""
    if lists and isinstance(lists[0], list):
        found = [functions(f) for f in lists]
        return found[: max((k + 1 for k, f in enumerate(found) if f), default=0)]
    return trimmed(rationals(lists))


def check_table(text, certificate, rows):
    """Checks decimals, the functions of the nodes and the orders; `rows` are the exact coefficients, by name."""
    table = tomllib.loads(text)
    demand(table["stages"] == certificate["stages"], f"{table['stages']} stages")
    decimals = table["decimals"]
    needed = {"c", "c_tilde", "b", "b_tilde"} | ({"a", "a_tilde"} if certificate["layout"] == "matrices" else set())
    demand(needed <= decimals.keys(), "decimals of all coefficients")
    # Long splittings have no matrices.
    rows = {name: numbers for name, numbers in rows.items() if name.partition("[")[0] in decimals}
    for name, numbers in rows.items():
        name, _, row = name.partition("[")
        texts = decimals[name] if not row else decimals[name][int(row[:-1]) - 1]
        demand(len(texts) == len(numbers), f"as many decimals in {name} as stages")
        for j, (text, x) in enumerate(zip(texts, numbers)):
            plain = text.partition("e")[0].lstrip("-").replace(".", "").lstrip("0")
            demand(len(plain) in (0, decimals["digits"]), f"{decimals['digits']} digits in {name}")
            if plain:
                check_decimal(text, x, f"{name}[{j + 1}]")
            else:
                demand(text == "0" and (enclosed(x).low, enclosed(x).high) == (0, 0), f"{name}[{j + 1}] = {text}")
    if certificate["numbers"]["kind"] == "nodes":
        exact = table["exact"]
        demand(exact["node_polynomial"] == certificate["numbers"]["polynomial"], "the node polynomial of the certificate")
        for name in ("b", "b_tilde", "a", "a_tilde"):
            demand(functions(exact[name]) == functions(certificate[name]), f"the functions of the certificate for {name}")
    for kind, claim in certificate["order"].items():
        found = table["order"][kind]
        demand((found["order"], found["refuted_by"]) == (claim["order"], claim["violated"]), f"the order of the certificate ({kind})")
        demand(rationals([found["wanted"]])[0] == Fraction(1, density(read_tree(claim["violated"]))), f"1/gamma ({kind})")
