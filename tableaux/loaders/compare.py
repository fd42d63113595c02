"""Compares what a library has loaded, NAME.json beside: compare.py LIBRARY

The file LIBRARY.loaded has a line `version …` and lines `NAME PART value value …`, NAME with underscores. Doubles are their 64 bits in
hexadecimal. The parts are

    c, b, a, c_tilde, b_tilde, a_tilde    coefficients, matrices row by row
    flows       drifts and kicks in the order in which they are stepped: d=BITS, k=BITS; those of size zero are passed over
    inverse     the inverse of a, row by row
    order       the order
    least       an order that the method has at least
    state       q and p of the Kepler problem after three steps of 1/16
"""

import glob
import json
import os
import struct
import sys
from collections import Counter
from fractions import Fraction

START = ([0.4, 0.0], [0.0, 2.0])
STEPS, STEP = 3, 0.0625
# The rounding of a few thousand additions, and what an iteration leaves.
NEAR = 1e-11


def bits(value):
    # A zero has no sign here.
    return struct.pack(">d", value + 0.0).hex()


class Method:
    """The numbers of a method, from its JSON."""

    def __init__(self, path):
        with open(path) as file:
            self.json = json.load(file)
        self.explicit = self.json["properties"]["explicit"]["holds"]
        self.b, self.b_tilde = self.decimals("b"), self.decimals("b_tilde")
        self.kicks_first = False
        if self.json["a"] is None:
            self.a, self.a_tilde = self.staircases()
        else:
            self.a, self.a_tilde = self.decimals("a"), self.decimals("a_tilde")

    def decimals(self, part):
        def read(x):
            return [read(y) for y in x] if isinstance(x, list) else Fraction(x["decimal"])

        return read(self.json[part])

    def doubles(self, part):
        def read(x):
            return [z for y in x for z in read(y)] if isinstance(x, list) else [float(x["f64"])]

        return read(self.json[part])

    def staircases(self):
        """The matrices of a long splitting, which are left out: it begins with the kick if the first position is that of the start."""
        early = self.kicks_first = Fraction(self.json["c"][0]["decimal"]) == 0
        stages = range(len(self.b))
        a = [[self.b[j] if j < i + 1 - early else Fraction() for j in stages] for i in stages]
        a_tilde = [[self.b_tilde[j] if j < i + early else Fraction() for j in stages] for i in stages]
        return a, a_tilde

    def flows(self):
        """Drifts and kicks in turn: an evaluation stands behind those that its stage has in its row."""

        def groups(weights, others, matrix):
            found = {}
            for weight, row in zip(weights, matrix):
                if weight != 0:
                    before = sum(x != 0 for x, other in zip(row, others) if other != 0)
                    many, total = found.get(before, (0, Fraction()))
                    found[before] = (many + 1, total + weight)
            return found

        drifts = groups(self.b, self.b_tilde, self.a_tilde)
        kicks = groups(self.b_tilde, self.b, self.a)
        done = {"d": 0, "k": 0}
        flows = []
        while drifts or kicks:
            kind = "d" if done["k"] in drifts else "k"
            source, other = (drifts, "k") if kind == "d" else (kicks, "d")
            many, total = source.pop(done[other])
            done[kind] += many
            flows.append(f"{kind}={bits(float(total))}")
        return flows

    def inverse(self):
        """Gauss–Jordan with fractions."""
        size = len(self.a)
        rows = [row + [Fraction(i == j) for j in range(size)] for i, row in enumerate(self.a)]
        for k in range(size):
            pivot = max(range(k, size), key=lambda i: abs(rows[i][k]))
            rows[k], rows[pivot] = rows[pivot], rows[k]
            rows[k] = [x / rows[k][k] for x in rows[k]]
            for i in range(size):
                if i != k:
                    rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k])]
        # What the digits do not tell from zero is zero.
        tiny = Fraction(1, 10**25)
        return [bits(float(x)) if abs(x) > tiny else bits(0.0) for row in rows for x in row[size:]]

    def state(self):
        """Steps of the partitioned Runge–Kutta method as it is defined, whatever its drifts and kicks are."""
        a, a_tilde = ([[float(x) for x in row] for row in m] for m in (self.a, self.a_tilde))
        b, b_tilde = ([float(x) for x in v] for v in (self.b, self.b_tilde))
        q, p = START

        def sums(row, values):
            # A long splitting has rows that are half empty.
            pairs = [(x, v) for x, v in zip(row, values) if x != 0.0]
            return [sum(x * v[k] for x, v in pairs) for k in (0, 1)]

        for _ in range(STEPS):
            velocities, forces = [p] * len(b), [force(q)] * len(b)
            before = None
            for _ in range(10 * len(b) + 200):
                for i, (row, row_tilde) in enumerate(zip(a, a_tilde)):
                    forces[i] = force([x + STEP * dx for x, dx in zip(q, sums(row, velocities))])
                    velocities[i] = [x + STEP * dx for x, dx in zip(p, sums(row_tilde, forces))]
                if self.kicks_first:
                    break  # one sweep is the step of such a staircase
                if before is not None and all(
                    abs(x - y) < 1e-16 for u, v in zip(before, velocities) for x, y in zip(u, v)
                ):
                    break
                before = list(velocities)
            q = [x + STEP * dx for x, dx in zip(q, sums(b, velocities))]
            p = [x + STEP * dx for x, dx in zip(p, sums(b_tilde, forces))]
        return q + p

    def order(self, splitting):
        classes = ["separable", "nystrom"] if splitting else ["general"]
        return max(self.json["order"][key]["order"] for key in classes)


def force(q):
    cube = (q[0] * q[0] + q[1] * q[1]) ** 1.5
    return [-q[0] / cube, -q[1] / cube]


def difference(method, part, values):
    """What is wrong, if anything."""
    if part == "state":
        found = [struct.unpack(">d", bytes.fromhex(x))[0] for x in values]
        distance = max(abs(x - y) for x, y in zip(found, method.state()))
        return f"{distance:.1e} from the step of the tableau" if not distance < NEAR else None
    if part == "least":
        return None if method.order(False) >= int(values[0]) else f"order {values[0]}"
    expected = {
        "flows": method.flows,
        "inverse": method.inverse,
        "order": lambda: [str(method.order(method.explicit))],
    }.get(part, lambda: [bits(x) for x in method.doubles(part)])()
    if part == "flows":
        values = [x for x in values if x[2:] not in ("0" * 16, "8" + "0" * 15)]
    else:
        values = ["0" * 16 if x == "8" + "0" * 15 else x for x in values]
    wrong = sum(x != y for x, y in zip(values, expected)) + abs(len(values) - len(expected))
    return f"{wrong} of {len(expected)} differ" if wrong else None


def main(library):
    names = {path[:-5].replace("-", "_"): path[:-5] for path in glob.glob("*.json")}
    written = {name for name in names if os.path.exists(f"{names[name]}.{library}")}
    version, numbers, loaded, differences = "", 0, set(), []
    methods = {}
    with open(f"{library}.loaded") as lines:
        for line in lines:
            name, part, *values = line.split()
            if name == "version":
                version = " ".join([part, *values])
                continue
            if name not in methods:
                methods[name] = Method(names[name] + ".json")
            numbers += len(values)
            loaded.add(name)
            wrong = difference(methods[name], part, values)
            if wrong:
                differences.append(f"    {names[name]}, {part}: {wrong}")
    differences += [f"    {names[name]}: not loaded" for name in sorted(written - loaded)]
    refused = Counter(open(path).read().strip() for path in glob.glob(f"*.{library}.refused"))
    print(
        f"{library}, {version}: {len(loaded)} methods loaded, {numbers} numbers, {len(differences)} differences,"
        f" {sum(refused.values())} methods refused"
    )
    for reason, count in refused.most_common():
        print(f"    {count} refused: {reason}")
    print("\n".join(differences), end="\n" if differences else "")
    return bool(differences) or not loaded


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
