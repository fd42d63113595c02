"""Symmetry with the stages in another order than the reverse one, which the certificate gives (HLW V.2)."""

from check_certificate import Stages, demand, whole


def symmetric(of, certificate):
    """b_s(i) = b_i and a_s(i)s(j) + a_ij = b_j, and so with a~ and b~, for the order s of the stages."""
    order = [whole(k) - 1 for k in certificate["symmetric"]]
    demand(isinstance(of, Stages) and sorted(order) == list(range(of.s)), "symmetric: an order of the stages")
    for colour in "qp":
        a, b = of.matrices[colour], of.weights[colour]
        for i, k in enumerate(order):
            demand(b[k] == b[i], f"symmetric, stage {i + 1}")
            for j, m in enumerate(order):
                demand(a[k][m] + a[i][j] == b[j], f"symmetric, stages {i + 1} and {j + 1}")
    return "symmetric"
