# gauss-2, 2 stages, basis polynomial(2), nodes gauss(2)
# source: Kuntzmann 1961
# source: Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964)
# source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3
# source: built as in Marsden & West 2001, Theorem 2.6.2
# source: the same method as chebyshev-2
# order 4 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
# symplectic (proved), symmetric (proved)
# written by symplectic VERSION
# Numbers are rounded to the digits that they have.
gauss_2 = (
    name = :gauss_2,
    order = 4,
    stages = 2,
    c = BigFloat[big"0.2113248654051871177454256097490212721762", big"0.7886751345948128822545743902509787278238"],
    b = BigFloat[big"0.5000000000000000000000000000000000000000", big"0.5000000000000000000000000000000000000000"],
    a = BigFloat[
        big"0.2500000000000000000000000000000000000000" big"-0.03867513459481288225457439025097872782380"
        big"0.5386751345948128822545743902509787278238" big"0.2500000000000000000000000000000000000000"
    ],
)
# RungeKutta.jl: Tableau(gauss_2.name, gauss_2.order, gauss_2.a, gauss_2.b, gauss_2.c)
# DiffEqBase.jl: ImplicitRKTableau(Float64.(gauss_2.a), Float64.(gauss_2.c), Float64.(gauss_2.b), gauss_2.order)
# RootedTrees.jl: RungeKuttaMethod(gauss_2.a, gauss_2.b, gauss_2.c)
