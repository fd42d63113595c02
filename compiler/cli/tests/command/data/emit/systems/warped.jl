# The system Warped: H = (1/2) (x² lambda + 1) (px² + py²) + (1/2) x² k[0, 0] + (1/4) y⁴ k[1, 1] + x⁵ y k[0, 1]/(y² + 1)^(3/2)
# Positions q = (x, y), momenta p = (px, py).
#
# Usage:
#
#     system = Gauss2.Warped(lambda = 0.25, k = ...)
#     velocity!(v, t, q, p) = Gauss2.velocity!(system, v, t, q, p)
#     force!(f, t, q, p) = Gauss2.force!(system, f, t, q, p)
Base.@kwdef struct Warped
    lambda::Float64 = 0.25
    k::Matrix{Float64}
end

# v = dH/dp
function velocity!(s::Warped, v, t, q, p)
    x1 = s.lambda * (q[1] * q[1]) + 1.0
    v[1] = p[1] * x1
    v[2] = p[2] * x1
    return v
end

# f = -dH/dq
function force!(s::Warped, f, t, q, p)
    x1 = q[1] * q[1]
    x2 = x1 * x1
    x3 = q[2] * q[2]
    x4 = x3 + 1.0
    x5 = sqrt(x4)
    x6 = 1.0 / (x4 * x5)
    f[1] = -(5.0 * s.k[1, 2] * x2 * q[2] * x6 + s.k[1, 1] * q[1] + s.lambda * q[1] * (p[1] * p[1] + p[2] * p[2]))
    x7 = s.k[1, 2] * (q[1] * x2)
    f[2] = -(x7 * x6 - 3.0 * q[2] * (x7 * q[2] / (x4 * x4 * x5)) + s.k[2, 2] * (q[2] * x3))
    return f
end

# H
function energy(s::Warped, t, q, p)
    x1 = q[1] * q[1]
    x2 = q[2] * q[2]
    x3 = x2 + 1.0
    return 0.5 * (s.lambda * x1 + 1.0) * (p[1] * p[1] + p[2] * p[2]) + 0.5 * s.k[1, 1] * x1 + 0.25 * s.k[2, 2] * (x2 * x2) + s.k[1, 2] * (q[1] * (x1 * x1)) * q[2] / (x3 * sqrt(x3))
end

end
