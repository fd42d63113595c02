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
# Usage, with velocity!(v, t, q, p) that writes dH/dp and force!(f, t, q, p) that writes -dH/dq:
#
#     state = Gauss2.State(q, p)
#     for k in 0:steps-1
#         Gauss2.step!(state, velocity!, force!, t0 + k * h, h) == :ok || break
#     end
module Gauss2

const STAGES = 2
const MAX_SWEEPS = 100
const C = [
    0.2113248654051871, # 1/2 - sqrt(3)/6 = 0.21132486540518712
    0.7886751345948129, # 1/2 + sqrt(3)/6 = 0.78867513459481288
]
const B = [
    0.5, # 1/2
    0.5, # 1/2
]
const B_TILDE = [
    0.5, # 1/2
    0.5, # 1/2
]
# mu_ij = a_ij / b_j and mu_tilde_ij = a_tilde_ij / b_tilde_j, rounded so that mu_ij + mu_tilde_ji is 1 exactly: symplectic as rounded.
const MU = [
    [0.5, -0.07735026918962573],
    [1.0773502691896257, 0.5],
]
const MU_TILDE = [
    [0.5, -0.07735026918962573],
    [1.0773502691896257, 0.5],
]

# Positions q + q_low and momenta p + p_low: the low parts are what rounding left out.
struct State
    q::Vector{Float64}
    q_low::Vector{Float64}
    p::Vector{Float64}
    p_low::Vector{Float64}
    slope::Vector{Float64}
    stage_q::Vector{Vector{Float64}}
    stage_p::Vector{Vector{Float64}}
    drift::Vector{Vector{Float64}}
    kick::Vector{Vector{Float64}}
end

function State(q, p)
    stages() = [zero(q) for _ in 1:STAGES]
    State(copy(q), zero(q), copy(p), zero(p), zero(q), stages(), stages(), stages(), stages())
end

# A step of size h from the time t. Stages are iterated until they no longer change, or change by rounding errors only and twice
# no less than before. Returns :ok, or :not_finite or :does_not_converge, where the state stays as it was.
function step!(s::State, velocity!, force!, t, h)
    for k in 1:STAGES
        copyto!(s.stage_q[k], s.q)
        copyto!(s.stage_p[k], s.p)
    end
    drifts!(s, velocity!, t, h)
    moved = stages!(s.q, s.q_low, MU, s.drift, s.stage_q)
    isfinite(moved) || return :not_finite
    least, sweeps, stalled = Inf, 0, 0
    while true
        kicks!(s, force!, t, h)
        moved_p = stages!(s.p, s.p_low, MU_TILDE, s.kick, s.stage_p)
        isfinite(moved_p) || return :not_finite
        drifts!(s, velocity!, t, h)
        moved_q = stages!(s.q, s.q_low, MU, s.drift, s.stage_q)
        isfinite(moved_q) || return :not_finite
        moved = max(moved_q, moved_p)
        stalled += moved >= least
        if moved == 0.0 || (stalled >= 2 && min(moved_q, moved_p) <= 64.0 * eps())
            break
        end
        least = min(least, moved)
        sweeps += 1
        sweeps == MAX_SWEEPS && return :does_not_converge
    end
    for k in 1:STAGES, i in eachindex(s.q)
        s.q[i], s.q_low[i] = add(s.q[i], s.q_low[i], s.drift[k][i])
        s.p[i], s.p_low[i] = add(s.p[i], s.p_low[i], s.kick[k][i])
    end
    return :ok
end

function kicks!(s, force!, t, h)
    for k in 1:STAGES
        force!(s.slope, t + h * C[k], s.stage_q[k], s.stage_p[k])
        s.kick[k] .= (h * B_TILDE[k]) .* s.slope
    end
end

function drifts!(s, velocity!, t, h)
    for k in 1:STAGES
        velocity!(s.slope, t + h * C[k], s.stage_q[k], s.stage_p[k])
        s.drift[k] .= (h * B[k]) .* s.slope
    end
end

# Stages as sums of increments: x + (low + sum_j factors[j] increments[j]). Returns how far they moved, relative to the largest;
# NaN where one is not finite.
function stages!(x, low, factors, increments, stages)
    moved = largest = 0.0
    for k in 1:STAGES, i in eachindex(x)
        total = low[i]
        for j in 1:STAGES
            total += factors[k][j] * increments[j][i]
        end
        stage = x[i] + total
        isfinite(stage) || return NaN
        moved = max(moved, abs(stage - stages[k][i]))
        largest = max(largest, abs(stage))
        stages[k][i] = stage
    end
    return moved == 0.0 ? 0.0 : moved / largest
end

# high + low + term as the nearest double and the rest (Knuth, Dekker).
function add(high, low, term)
    total = high + term
    part = total - high
    rest = low + ((high - (total - part)) + (term - part))
    high = total + rest
    return high, rest - (high - total)
end
end
