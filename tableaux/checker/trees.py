"""Trees with vertices of two colours, 'q' and 'p': (colour, children), the children sorted (HLW III.2)."""

import math
import re
from functools import lru_cache

from .numbers import demand


@lru_cache(maxsize=None)
def trees(order, kind):
    """All trees with so many vertices for a class of Hamiltonians."""
    return [(colour, children) for colour in "qp" for children in forests(order - 1, kind, colour)]


@lru_cache(maxsize=None)
def forests(size, kind, parent):
    """All multisets of trees with so many vertices together that may hang on a vertex of this colour."""
    found = set()

    def extend(chosen, rest, least):
        if rest == 0:
            found.add(tuple(sorted(chosen)))
            return
        if kind == "nystrom" and parent == "q" and chosen:
            return  # The velocity is linear in p: no second derivative.
        for part in range(least, rest + 1):
            for tree in trees(part, kind):
                if kind == "general" or tree[0] != parent:
                    extend(chosen + (tree,), rest - part, part)

    extend((), size, 1)
    return sorted(found)


def size(tree):
    return 1 + sum(size(child) for child in tree[1])


def density(tree):
    """gamma: the product of the sizes of all subtrees."""
    return size(tree) * math.prod(density(child) for child in tree[1])


def rootings(tree):
    """Trees whose conditions are equivalent for a symplectic method, those of lower orders given: each vertex is the root of one.

    By b_i a_ij + b~_j a~_ji = b_i b~_j, for a child of colour q, the old root becomes a child of colour p, and the other way round.
    """
    found, rest = {tree}, [tree]
    while rest:
        _, children = rest.pop()
        for i, (other, grandchildren) in enumerate(children):
            left = ("p" if other == "q" else "q", children[:i] + children[i + 1 :])
            moved = (other, tuple(sorted(grandchildren + (left,))))
            if moved not in found:
                found.add(moved)
                rest.append(moved)
    return found


@lru_cache(maxsize=None)
def unrooted(order, kind):
    """One rooting of each tree. If a method is symplectic, its condition and those of lower orders imply those of the others (HLW VI.7)."""
    seen, found = set(), []
    for tree in trees(order, kind):
        if tree not in seen:
            found.append(tree)
            seen |= rootings(tree)
    return found


def read_tree(text):
    """`q[p^2,q[p]]`"""
    tokens = re.findall(r"[qp\[\],]|\^\d{1,2}", text) + ["end"]

    def tree():
        colour, children = tokens.pop(0), []
        demand(colour in "qp", f"a tree, not {text}")
        if tokens[0] == "[":
            while tokens.pop(0) in ("[", ","):
                child = tree()
                copies = int(tokens.pop(0)[1:]) if tokens[0].startswith("^") else 1
                children += [child] * copies
        return (colour, tuple(sorted(children)))

    found = tree()
    demand(tokens == ["end"], f"a tree, not {text}")
    return found


def fits(tree, kind):
    colour, children = tree
    if kind != "general" and any(child[0] == colour for child in children):
        return False
    if kind == "nystrom" and colour == "q" and len(children) > 1:
        return False
    return all(fits(child, kind) for child in children)
