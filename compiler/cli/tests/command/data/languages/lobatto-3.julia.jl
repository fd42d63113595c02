# lobatto-3, 3 stages, basis polynomial(3), nodes lobatto(3)
# source: Sun, Symplectic partitioned Runge–Kutta methods, J. Comput. Math. 11 (1993)
# source: Jay, SIAM J. Numer. Anal. 33 (1996)
# source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.2.2 and §VI.4
# source: built as in Marsden & West 2001, Theorem 2.6.2
# source: the same method as clenshaw-curtis-3 and newton-cotes-3 and galerkin-2-lobatto-3
# order 4 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
# symplectic (proved), symmetric (proved)
# written by symplectic VERSION
lobatto_3 = (
    name = :lobatto_3,
    order = 4,
    stages = 3,
    c = Rational{BigInt}[0//1, 1//2, 1//1],
    b = Rational{BigInt}[1//6, 2//3, 1//6],
    c_tilde = Rational{BigInt}[0//1, 1//2, 1//1],
    b_tilde = Rational{BigInt}[1//6, 2//3, 1//6],
    a = Rational{BigInt}[
        0//1 0//1 0//1
        5//24 1//3 -1//24
        1//6 2//3 1//6
    ],
    a_tilde = Rational{BigInt}[
        1//6 -1//6 0//1
        1//6 1//3 0//1
        1//6 5//6 0//1
    ],
)
# RungeKutta.jl: PartitionedTableau(lobatto_3.name,
#     Tableau(lobatto_3.name, lobatto_3.order, lobatto_3.a, lobatto_3.b, lobatto_3.c),
#     Tableau(lobatto_3.name, lobatto_3.order, lobatto_3.a_tilde, lobatto_3.b_tilde, lobatto_3.c_tilde))
# RootedTrees.jl: AdditiveRungeKuttaMethod([
#     RungeKuttaMethod(lobatto_3.a, lobatto_3.b, lobatto_3.c), RungeKuttaMethod(lobatto_3.a_tilde, lobatto_3.b_tilde, lobatto_3.c_tilde)])
