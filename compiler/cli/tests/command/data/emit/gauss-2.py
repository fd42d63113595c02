# gauss-2, 2 stages, basis polynomial(2), nodes gauss(2)
# source: Kuntzmann 1961
# source: Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964)
# source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3
# source: built as in Marsden & West 2001, Theorem 2.6.2
# source: the same method as chebyshev-2
# order 4 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
# symplectic (proved), symmetric (proved)
# written by symplectic VERSION
# A step of every H(t, q, p): the stages are solved for by fixed-point iteration, with compensated sums.
#
# Usage, with velocity(t, q, p) = dH/dp and force(t, q, p) = -dH/dq as lists:
#
#     state = State(q, p)
#     for k in range(steps):
#         step(state, velocity, force, t0 + k * h, h)
import math
import sys

STAGES = 2
MAX_SWEEPS = 100
C = [
    0.2113248654051871,  # 1/2 - sqrt(3)/6 = 0.21132486540518712
    0.7886751345948129,  # 1/2 + sqrt(3)/6 = 0.78867513459481288
]
B = [
    0.5,  # 1/2
    0.5,  # 1/2
]
B_TILDE = [
    0.5,  # 1/2
    0.5,  # 1/2
]
# mu_ij = a_ij / b_j and mu_tilde_ij = a_tilde_ij / b_tilde_j, rounded so that mu_ij + mu_tilde_ji is 1 exactly: symplectic as rounded.
MU = [
    [0.5, -0.07735026918962573],
    [1.0773502691896257, 0.5],
]
MU_TILDE = [
    [0.5, -0.07735026918962573],
    [1.0773502691896257, 0.5],
]


class NotFinite(ArithmeticError):
    """A stage is not finite."""


class DoesNotConverge(ArithmeticError):
    """Stages do not converge: a smaller step may do."""


class State:
    """Positions q + q_low and momenta p + p_low: the low parts are what rounding left out."""

    def __init__(self, q, p):
        self.q, self.p = [float(x) for x in q], [float(x) for x in p]
        self.q_low, self.p_low = [0.0] * len(self.q), [0.0] * len(self.p)


def step(state, velocity, force, t, h):
    """A step of size h from the time t. Stages are iterated until they no longer change, or change by rounding
    errors only and twice no less than before. Where they do not, or are not finite, the state stays as it was."""

    def kicks():
        return [[h * B_TILDE[k] * f for f in force(t + h * C[k], stage_q[k], stage_p[k])] for k in range(STAGES)]

    def drifts():
        return [[h * B[k] * v for v in velocity(t + h * C[k], stage_q[k], stage_p[k])] for k in range(STAGES)]

    stage_q = [state.q[:] for _ in range(STAGES)]
    stage_p = [state.p[:] for _ in range(STAGES)]
    drift = drifts()
    _stages(state.q, state.q_low, MU, drift, stage_q)
    least, sweeps, stalled = math.inf, 0, 0
    while True:
        kick = kicks()
        moved_p = _stages(state.p, state.p_low, MU_TILDE, kick, stage_p)
        drift = drifts()
        moved_q = _stages(state.q, state.q_low, MU, drift, stage_q)
        moved = max(moved_q, moved_p)
        stalled += moved >= least
        if moved == 0.0 or (stalled >= 2 and min(moved_q, moved_p) <= 64.0 * sys.float_info.epsilon):
            break
        least = min(least, moved)
        sweeps += 1
        if sweeps == MAX_SWEEPS:
            raise DoesNotConverge("the stages do not converge: take a smaller step")
    for k in range(STAGES):
        for i in range(len(state.q)):
            state.q[i], state.q_low[i] = _add(state.q[i], state.q_low[i], drift[k][i])
            state.p[i], state.p_low[i] = _add(state.p[i], state.p_low[i], kick[k][i])


def _stages(x, low, factors, increments, stages):
    """Stages as sums of increments: x + (low + sum_j factors[j] increments[j]). Returns how far they moved, relative to the
    largest."""
    moved = largest = 0.0
    for k in range(STAGES):
        for i in range(len(x)):
            total = low[i]
            for j in range(STAGES):
                total += factors[k][j] * increments[j][i]
            stage = x[i] + total
            if not math.isfinite(stage):
                raise NotFinite("a stage is not finite")
            moved = max(moved, abs(stage - stages[k][i]))
            largest = max(largest, abs(stage))
            stages[k][i] = stage
    relative = 0.0 if moved == 0.0 else moved / largest
    if not math.isfinite(relative):
        raise NotFinite("a stage is not finite")
    return relative


def _add(high, low, term):
    """high + low + term as the nearest double and the rest (Knuth, Dekker)."""
    total = high + term
    part = total - high
    rest = low + ((high - (total - part)) + (term - part))
    high = total + rest
    return high, rest - (high - total)
