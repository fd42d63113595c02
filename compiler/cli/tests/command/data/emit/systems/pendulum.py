# The system Pendulum: H = (1/2) pa² − g cos(a) + (1/8) exp(−t) sin(a)
# Positions q = (a), momenta p = (pa).
#
# Usage:
#
#     system = Pendulum(g=9.81)
#     step(state, system.velocity, system.force, t0 + k * h, h)
class Pendulum:
    """Velocity, force and energy of the system."""

    def __init__(self, g=9.81):
        self.g = g

    def velocity(self, t, p):
        """dH/dp"""
        v = [0.0] * 1
        v[0] = p[0]
        return v

    def force(self, t, q):
        """-dH/dq"""
        f = [0.0] * 1
        x1 = math.sin(q[0])
        x2 = math.cos(q[0])
        f[0] = -(0.125 * x2 * math.exp(-t) + self.g * x1)
        return f

    def energy(self, t, q, p):
        """H"""
        x1 = math.sin(q[0])
        x2 = math.cos(q[0])
        return 0.5 * (p[0] * p[0]) - self.g * x2 + 0.125 * math.exp(-t) * x1
