! lobatto-2, 2 stages, basis polynomial(2), nodes lobatto(2)
! source: Sun, Symplectic partitioned Runge–Kutta methods, J. Comput. Math. 11 (1993)
! source: Jay, SIAM J. Numer. Anal. 33 (1996)
! source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.2.2 and §VI.4
! source: built as in Marsden & West 2001, Theorem 2.6.2
! source: the same method as stormer-verlet and newton-cotes-2 and leok-zhang-3
! order 2 for every H (proved), 2 for T(p) + U(q) (proved), 2 for T quadratic (proved)
! symplectic (proved), symmetric (proved)
! written by symplectic VERSION
module lobatto_2_tableau
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none

  real(real64), parameter :: c(2) = [ &
    real(z'0000000000000000', real64), & ! 0
    real(z'3FF0000000000000', real64) & ! 1
  ]

  real(real64), parameter :: b(2) = [ &
    real(z'3FE0000000000000', real64), & ! 1/2
    real(z'3FE0000000000000', real64) & ! 1/2
  ]

  real(real64), parameter :: c_tilde(2) = [ &
    real(z'3FE0000000000000', real64), & ! 1/2
    real(z'3FE0000000000000', real64) & ! 1/2
  ]

  real(real64), parameter :: b_tilde(2) = [ &
    real(z'3FE0000000000000', real64), & ! 1/2
    real(z'3FE0000000000000', real64) & ! 1/2
  ]

  real(real64), parameter, private :: a_1(2) = [ &
    real(z'0000000000000000', real64), & ! 0
    real(z'0000000000000000', real64) & ! 0
  ]

  real(real64), parameter, private :: a_2(2) = [ &
    real(z'3FE0000000000000', real64), & ! 1/2
    real(z'3FE0000000000000', real64) & ! 1/2
  ]

  real(real64), parameter :: a(2, 2) = reshape([ &
    a_1, &
    a_2 &
  ], [2, 2], order=[2, 1])

  real(real64), parameter, private :: a_tilde_1(2) = [ &
    real(z'3FE0000000000000', real64), & ! 1/2
    real(z'0000000000000000', real64) & ! 0
  ]

  real(real64), parameter, private :: a_tilde_2(2) = [ &
    real(z'3FE0000000000000', real64), & ! 1/2
    real(z'0000000000000000', real64) & ! 0
  ]

  real(real64), parameter :: a_tilde(2, 2) = reshape([ &
    a_tilde_1, &
    a_tilde_2 &
  ], [2, 2], order=[2, 1])
end module lobatto_2_tableau
