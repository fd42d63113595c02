# gauss-2, 2 stages, basis polynomial(2), nodes gauss(2)
# source: Kuntzmann 1961
# source: Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964)
# source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3
# source: built as in Marsden & West 2001, Theorem 2.6.2
# source: the same method as chebyshev-2
# order 4 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
# symplectic (proved), symmetric (proved)
# written by symplectic VERSION
import numpy
import sympy
from nodepy.runge_kutta_method import RungeKuttaMethod

A = numpy.array([
    [sympy.sympify("1/4"), sympy.sympify("1/4 - sqrt(3)/6")],
    [sympy.sympify("1/4 + sqrt(3)/6"), sympy.sympify("1/4")],
], dtype=object)
b = numpy.array([sympy.sympify("1/2"), sympy.sympify("1/2")], dtype=object)
gauss_2 = RungeKuttaMethod(A, b, name="gauss_2")
