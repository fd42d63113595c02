# The system Planets: H = (1/2) Σ(0 ≤ i < N) (p[i][0]² + p[i][1]² + p[i][2]²)/m[i] − Σ(0 ≤ i < N) Σ(i+1 ≤ j < N) G m[i] m[j]/√((q[i][0] − q[j][0])² + (q[i][1] − q[j][1])² + (q[i][2] − q[j][2])²)
# The formula's q[i][k] is the entry 3 i + k of q, counted from 0; p likewise.
#
# Usage:
#
#     system = Planets(N=..., m=..., G=1.0)
#     step(state, system.velocity, system.force, t0 + k * h, h)
class Planets:
    """Velocity, force and energy of the system."""

    def __init__(self, N, m, G=1.0):
        self.N = N
        self.m = m
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
            for j in range(i + 1, self.N):
                x5 = q[3 * i + 2] - q[3 * j + 2]
                x6 = q[3 * i] - q[3 * j]
                x7 = q[3 * i + 1] - q[3 * j + 1]
                x8 = x6 * x6 + x7 * x7 + x5 * x5
                x9 = x4 * self.m[j] / (x8 * math.sqrt(x8))
                x10 = x5 * x9
                x1 += x10
                x11 = x7 * x9
                x2 += x11
                x12 = x6 * x9
                x3 += x12
                f[3 * j] += x12
                f[3 * j + 1] += x11
                f[3 * j + 2] += x10
            f[3 * i] += -x3
            f[3 * i + 1] += -x2
            f[3 * i + 2] += -x1
        return f

    def energy(self, t, q, p):
        """H"""
        x1 = 0.0
        x2 = 0.0
        for i in range(0, self.N):
            x3 = 0.0
            x4 = self.G * self.m[i]
            for j in range(i + 1, self.N):
                x5 = q[3 * i] - q[3 * j]
                x6 = q[3 * i + 1] - q[3 * j + 1]
                x7 = q[3 * i + 2] - q[3 * j + 2]
                x3 += x4 * self.m[j] / math.sqrt(x5 * x5 + x6 * x6 + x7 * x7)
            x1 += 1.0 / self.m[i] * (p[3 * i] * p[3 * i] + p[3 * i + 1] * p[3 * i + 1] + p[3 * i + 2] * p[3 * i + 2])
            x2 += x3
        return 0.5 * x1 - x2
