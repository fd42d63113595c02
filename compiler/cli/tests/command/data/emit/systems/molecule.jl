# The system Molecule: H = (1/2) Σ(0 ≤ i < N) (p[i][0]² + p[i][1]² + p[i][2]²)/m[i] + (1/2) Σ((j′, j″) in springs) stiffness[j] (√((q[j′][0] − q[j″][0])² + (q[j′][1] − q[j″][1])² + (q[j′][2] − q[j″][2])²) − length[j])² − Σ(0 ≤ i < N) Σ(i+1 ≤ k < N) G m[i] m[k]/√((q[i][0] − q[k][0])² + (q[i][1] − q[k][1])² + (q[i][2] − q[k][2])²)
# The formula's q[i][k] is the entry 3 i + k of q, counted from 0; p likewise.
#
# Usage:
#
#     system = ForestRuth1990.Molecule(N = ..., m = ..., springs = ..., stiffness = ..., length = ..., G = 0.125)
#     velocity!(v, t, p) = ForestRuth1990.velocity!(system, v, t, p)
#     force!(f, t, q) = ForestRuth1990.force!(system, f, t, q)
Base.@kwdef struct Molecule
    N::Int
    m::Vector{Float64}
    springs::Vector{Tuple{Int, Int}} # pairs of indices from 1
    stiffness::Vector{Float64}
    length::Vector{Float64}
    G::Float64 = 0.125
end

# v = dH/dp
function velocity!(s::Molecule, v, t, p)
    for i in 0:s.N - 1
        x1 = 1.0 / s.m[i + 1]
        v[3 * i + 1] = x1 * p[3 * i + 1]
        v[3 * i + 2] = x1 * p[3 * i + 2]
        v[3 * i + 3] = x1 * p[3 * i + 3]
    end
    return v
end

# f = -dH/dq
function force!(s::Molecule, f, t, q)
    fill!(f, 0.0)
    for i in 0:s.N - 1
        x1 = 0.0
        x2 = 0.0
        x3 = 0.0
        x4 = s.G * s.m[i + 1]
        for k in i + 1:s.N - 1
            x5 = q[3 * i + 3] - q[3 * k + 3]
            x6 = q[3 * i + 1] - q[3 * k + 1]
            x7 = q[3 * i + 2] - q[3 * k + 2]
            x8 = x6 * x6 + x7 * x7 + x5 * x5
            x9 = x4 * s.m[k + 1] / (x8 * sqrt(x8))
            x10 = x5 * x9
            x1 += x10
            x11 = x7 * x9
            x2 += x11
            x12 = x6 * x9
            x3 += x12
            f[3 * k + 1] += x12
            f[3 * k + 2] += x11
            f[3 * k + 3] += x10
        end
        f[3 * i + 1] += -x3
        f[3 * i + 2] += -x2
        f[3 * i + 3] += -x1
    end
    for j in 0:length(s.springs) - 1
        j_0, j_1 = s.springs[j + 1] .- 1
        0 <= j_0 < s.N && 0 <= j_1 < s.N || throw(ArgumentError("a pair has an index out of range"))
        x13 = q[3 * j_0 + 1] - q[3 * j_1 + 1]
        x14 = q[3 * j_0 + 2] - q[3 * j_1 + 2]
        x15 = q[3 * j_0 + 3] - q[3 * j_1 + 3]
        x16 = sqrt(x13 * x13 + x14 * x14 + x15 * x15)
        x17 = s.stiffness[j + 1] * (x16 - s.length[j + 1]) / x16
        x18 = x13 * x17
        f[3 * j_0 + 1] += -x18
        x19 = x14 * x17
        f[3 * j_0 + 2] += -x19
        x20 = x15 * x17
        f[3 * j_0 + 3] += -x20
        f[3 * j_1 + 1] += x18
        f[3 * j_1 + 2] += x19
        f[3 * j_1 + 3] += x20
    end
    return f
end

# H
function energy(s::Molecule, t, q, p)
    x1 = 0.0
    x2 = 0.0
    x3 = 0.0
    for i in 0:s.N - 1
        x4 = 0.0
        x5 = s.G * s.m[i + 1]
        for k in i + 1:s.N - 1
            x6 = q[3 * i + 1] - q[3 * k + 1]
            x7 = q[3 * i + 2] - q[3 * k + 2]
            x8 = q[3 * i + 3] - q[3 * k + 3]
            x4 += x5 * s.m[k + 1] / sqrt(x6 * x6 + x7 * x7 + x8 * x8)
        end
        x1 += 1.0 / s.m[i + 1] * (p[3 * i + 1] * p[3 * i + 1] + p[3 * i + 2] * p[3 * i + 2] + p[3 * i + 3] * p[3 * i + 3])
        x3 += x4
    end
    for j in 0:length(s.springs) - 1
        j_0, j_1 = s.springs[j + 1] .- 1
        0 <= j_0 < s.N && 0 <= j_1 < s.N || throw(ArgumentError("a pair has an index out of range"))
        x9 = q[3 * j_0 + 1] - q[3 * j_1 + 1]
        x10 = q[3 * j_0 + 2] - q[3 * j_1 + 2]
        x11 = q[3 * j_0 + 3] - q[3 * j_1 + 3]
        x12 = sqrt(x9 * x9 + x10 * x10 + x11 * x11) - s.length[j + 1]
        x2 += s.stiffness[j + 1] * (x12 * x12)
    end
    return 0.5 * x1 + 0.5 * x2 - x3
end

end
