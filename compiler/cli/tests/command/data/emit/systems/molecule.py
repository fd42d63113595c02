# The system Molecule: H = (1/2) Σ(0 ≤ i < N) (p[i][0]² + p[i][1]² + p[i][2]²)/m[i] + (1/2) Σ((j′, j″) in springs) stiffness[j] (√((q[j′][0] − q[j″][0])² + (q[j′][1] − q[j″][1])² + (q[j′][2] − q[j″][2])²) − length[j])² − Σ(0 ≤ i < N) Σ(i+1 ≤ k < N) G m[i] m[k]/√((q[i][0] − q[k][0])² + (q[i][1] − q[k][1])² + (q[i][2] − q[k][2])²)
# The formula's q[i][k] is the entry 3 i + k of q, counted from 0; p likewise.
#
# Usage:
#
#     system = Molecule(N=..., m=..., springs=..., stiffness=..., length=..., G=0.125)
#     step(state, system.velocity, system.force, t0 + k * h, h)
class Molecule:
    """Velocity, force and energy of the system."""

    def __init__(self, N, m, springs, stiffness, length, G=0.125):
        self.N = N
        self.m = m
        self.springs = springs
        self.stiffness = stiffness
        self.length = length
        self.G = G

    def velocity(self, t, p):
        """dH/dp"""
        v = [0.0] * (3 * self.N)
        for i in range(0, self.N):
            x1 = 1.0 / self.m[i]
            v[3 * i] = x1 * p[3 * i]
            v[3 * i + 1] = x1 * p[3 * i + 1]
            v[3 * i + 2] = x1 * p[3 * i + 2]
        return v

    def force(self, t, q):
        """-dH/dq"""
        f = [0.0] * (3 * self.N)
        for i in range(0, self.N):
            x1 = 0.0
            x2 = 0.0
            x3 = 0.0
            x4 = self.G * self.m[i]
            for k in range(i + 1, self.N):
                x5 = q[3 * i + 2] - q[3 * k + 2]
                x6 = q[3 * i] - q[3 * k]
                x7 = q[3 * i + 1] - q[3 * k + 1]
                x8 = x6 * x6 + x7 * x7 + x5 * x5
                x9 = x4 * self.m[k] / (x8 * math.sqrt(x8))
                x10 = x5 * x9
                x1 += x10
                x11 = x7 * x9
                x2 += x11
                x12 = x6 * x9
                x3 += x12
                f[3 * k] += x12
                f[3 * k + 1] += x11
                f[3 * k + 2] += x10
            f[3 * i] += -x3
            f[3 * i + 1] += -x2
            f[3 * i + 2] += -x1
        for j, (j_0, j_1) in enumerate(self.springs):
            if not (0 <= j_0 < self.N and 0 <= j_1 < self.N):
                raise ValueError("a pair has an index out of range")
            x13 = q[3 * j_0] - q[3 * j_1]
            x14 = q[3 * j_0 + 1] - q[3 * j_1 + 1]
            x15 = q[3 * j_0 + 2] - q[3 * j_1 + 2]
            x16 = math.sqrt(x13 * x13 + x14 * x14 + x15 * x15)
            x17 = self.stiffness[j] * (x16 - self.length[j]) / x16
            x18 = x13 * x17
            f[3 * j_0] += -x18
            x19 = x14 * x17
            f[3 * j_0 + 1] += -x19
            x20 = x15 * x17
            f[3 * j_0 + 2] += -x20
            f[3 * j_1] += x18
            f[3 * j_1 + 1] += x19
            f[3 * j_1 + 2] += x20
        return f

    def energy(self, t, q, p):
        """H"""
        x1 = 0.0
        x2 = 0.0
        x3 = 0.0
        for i in range(0, self.N):
            x4 = 0.0
            x5 = self.G * self.m[i]
            for k in range(i + 1, self.N):
                x6 = q[3 * i] - q[3 * k]
                x7 = q[3 * i + 1] - q[3 * k + 1]
                x8 = q[3 * i + 2] - q[3 * k + 2]
                x4 += x5 * self.m[k] / math.sqrt(x6 * x6 + x7 * x7 + x8 * x8)
            x1 += 1.0 / self.m[i] * (p[3 * i] * p[3 * i] + p[3 * i + 1] * p[3 * i + 1] + p[3 * i + 2] * p[3 * i + 2])
            x3 += x4
        for j, (j_0, j_1) in enumerate(self.springs):
            if not (0 <= j_0 < self.N and 0 <= j_1 < self.N):
                raise ValueError("a pair has an index out of range")
            x9 = q[3 * j_0] - q[3 * j_1]
            x10 = q[3 * j_0 + 1] - q[3 * j_1 + 1]
            x11 = q[3 * j_0 + 2] - q[3 * j_1 + 2]
            x12 = math.sqrt(x9 * x9 + x10 * x10 + x11 * x11) - self.length[j]
            x2 += self.stiffness[j] * (x12 * x12)
        return 0.5 * x1 + 0.5 * x2 - x3
