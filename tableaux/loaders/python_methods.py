"""What fractions, NumPy and mpmath make of the lists of texts."""

import glob
import struct

import mpmath
import numpy

print(f"version Python's fractions, NumPy {numpy.__version__}, mpmath {mpmath.__version__}")
# mpmath rounds a quotient to this many places, and the double of it is the double of the fraction.
mpmath.mp.prec = 100
for path in sorted(glob.glob("*.python")):
    holds = {}
    with open(path) as file:
        exec(compile(file.read(), path, "exec"), holds)
    for part in ("c", "b", "c_tilde", "b_tilde", "a", "a_tilde"):
        if part not in holds:
            continue
        lists = (
            numpy.array(holds["doubles"](holds[part])).flatten(),
            list(holds["mpmath_matrix"](holds[part])),
        )
        for values in lists:
            print(holds["name"], part, *(struct.pack(">d", float(x)).hex() for x in values))
