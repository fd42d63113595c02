"""For symplectic methods the order conditions of all rootings of a tree are equivalent (HLW VI.7): solutions are known by one of each."""

from functools import lru_cache

from check_certificate import trees


def turned_over(tree, i):
    """The tree with its child i as the root. For a symplectic method with the conditions of lower orders, both conditions are equivalent.

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
    """One rooting of each tree. If a method is symplectic, its condition and those of lower orders imply those of the others."""
    seen, found = set(), []
    for tree in trees(order, kind):
        if tree not in seen:
            found.append(tree)
            seen |= rootings(tree)
    return found
