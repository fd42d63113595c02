"""Trees with vertices of two colours, 'q' and 'p': (colour, children), the children sorted (HLW III.2)."""

import math
import re
from functools import lru_cache

from .numbers import demand

MOST_VERTICES = 60  # Of a tree in a file.


@lru_cache(maxsize=None)
def trees(order, kind):
    """All trees with this number of vertices for a class of Hamiltonians."""
    return [(colour, children) for colour in "qp" for children in forests(order - 1, kind, colour)]


@lru_cache(maxsize=None)
def forests(size, kind, parent):
    """All multisets of trees with this number of vertices together that may hang on a vertex of this colour."""
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


def turned_over(tree, i):
    """The tree with its child i as the root. For a symplectic method, and conditions of lower orders, the conditions of both are equivalent.

    By b_i a_ij + b~_j a~_ji = b_i b~_j, where the child has the colour q, the old root becomes a child of the colour p, and the other way
    round.
    """
    _, children = tree
    other, grandchildren = children[i]
    left = ("p" if other == "q" else "q", children[:i] + children[i + 1 :])
    return (other, tuple(sorted(grandchildren + (left,))))


def rootings(tree):
    """The same tree with each of its vertices as the root."""
    found, rest = {tree}, [tree]
    while rest:
        tree = rest.pop()
        for moved in (turned_over(tree, i) for i in range(len(tree[1]))):
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
    demand(isinstance(text, str) and re.fullmatch(r"([qp\[\],]|\^[1-9][0-9]?)*", text), f"a tree, not {text}")
    tokens = re.findall(r"[qp\[\],]|\^[0-9]+", text) + ["end"]

    def tree():
        """A tree and the number of its vertices."""
        colour, children, vertices = tokens.pop(0), [], 1
        demand(colour in ("q", "p"), f"a tree, not {text}")
        separator = tokens.pop(0) if tokens[0] == "[" else None
        while separator in ("[", ","):
            child, size = tree()
            copies = int(tokens.pop(0)[1:]) if tokens[0].startswith("^") else 1
            vertices += size * copies
            demand(vertices <= MOST_VERTICES, f"a tree with at most {MOST_VERTICES} vertices")
            children += [child] * copies
            separator = tokens.pop(0)
        demand(separator in (None, "]"), f"a tree, not {text}")
        return (colour, tuple(sorted(children))), vertices

    found, _ = tree()
    demand(tokens == ["end"], f"a tree, not {text}")
    return found


def fits(tree, kind):
    colour, children = tree
    if kind != "general" and any(child[0] == colour for child in children):
        return False
    if kind == "nystrom" and colour == "q" and len(children) > 1:
        return False
    return all(fits(child, kind) for child in children)
