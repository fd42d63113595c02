# forest-ruth-1990, 4 stages, kick -1/(2*(cbrt(2) - 2)), (cbrt(2) - 1)/(2*(cbrt(2) - 2)), drift -1/(cbrt(2) - 2), cbrt(2)/(cbrt(2) - 2), symmetric true
# source: Forest & Ruth, Fourth-order symplectic integration, Physica D 43 (1990)
# source: Candy & Rozmus, J. Comput. Phys. 92 (1991)
# source: Yoshida 1990
# order 1 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
# symplectic(separable) (proved), symmetric(separable) (proved)
# written by symplectic VERSION
# A step of H = T(t, p) + U(t, q): drifts and kicks, with compensated sums.
#
# Usage, for H = T(t, p) + U(t, q), with velocity!(v, t, p) that writes dT/dp and force!(f, t, q) that writes -dU/dq:
#
#     state = ForestRuth1990.State(q, p)
#     for k in 0:steps-1
#         ForestRuth1990.step!(state, velocity!, force!, t0 + k * h, h) == :ok || break
#     end
module ForestRuth1990

# Positions q + q_low and momenta p + p_low: the low parts are what rounding left out.
mutable struct State
    q::Vector{Float64}
    q_low::Vector{Float64}
    p::Vector{Float64}
    p_low::Vector{Float64}
    slope::Vector{Float64}
    start::Vector{Vector{Float64}}
    # Set it to false after a change of q, of the force, or of the time other than by a step.
    force_is_known::Bool
end

State(q, p) = State(copy(q), zero(q), copy(p), zero(p), zero(q), [zero(q) for _ in 1:4], false)

# A step of size h from the time t. Returns :ok, or :not_finite, where the state stays as it was.
function step!(s::State, velocity!, force!, t, h)
    parts = (s.q, s.q_low, s.p, s.p_low)
    foreach(copyto!, s.start, parts)
    s.force_is_known || force!(s.slope, t, s.q)
    advance!(s.p, s.p_low, h * 0.6756035959798288, s.slope) # 1/3 + cbrt(2)/6 + cbrt(2)^2/12 = 0.67560359597982882
    velocity!(s.slope, t + h * 0.6756035959798288, s.p)
    advance!(s.q, s.q_low, h * 1.3512071919596575, s.slope) # 2/3 + cbrt(2)/3 + cbrt(2)^2/6 = 1.3512071919596576
    force!(s.slope, t + h * 1.3512071919596575, s.q)
    advance!(s.p, s.p_low, h * -0.17560359597982883, s.slope) # 1/6 - cbrt(2)/6 - cbrt(2)^2/12 = -0.17560359597982882
    velocity!(s.slope, t + h * 0.5, s.p)
    advance!(s.q, s.q_low, h * -1.7024143839193153, s.slope) # -1/3 - 2*cbrt(2)/3 - cbrt(2)^2/3 = -1.7024143839193153
    force!(s.slope, t + h * -0.35120719195965766, s.q)
    advance!(s.p, s.p_low, h * -0.17560359597982883, s.slope) # 1/6 - cbrt(2)/6 - cbrt(2)^2/12 = -0.17560359597982882
    velocity!(s.slope, t + h * 0.32439640402017117, s.p)
    advance!(s.q, s.q_low, h * 1.3512071919596575, s.slope) # 2/3 + cbrt(2)/3 + cbrt(2)^2/6 = 1.3512071919596576
    force!(s.slope, t + h, s.q)
    advance!(s.p, s.p_low, h * 0.6756035959798288, s.slope) # 1/3 + cbrt(2)/6 + cbrt(2)^2/12 = 0.67560359597982882
    if !all(part -> all(isfinite, part), parts)
        foreach(copyto!, parts, s.start)
        s.force_is_known = false
        return :not_finite
    end
    s.force_is_known = true
    return :ok
end

# A drift of q or a kick of p.
function advance!(high, low, factor, slope)
    for i in eachindex(high)
        high[i], low[i] = add(high[i], low[i], factor * slope[i])
    end
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
