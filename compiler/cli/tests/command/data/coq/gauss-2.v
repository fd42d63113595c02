(* gauss-2, 2 stages, basis polynomial(2), nodes gauss(2)
   source: Kuntzmann 1961
   source: Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964)
   source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3
   source: built as in Marsden & West 2001, Theorem 2.6.2
   source: the same method as chebyshev-2
   order 4 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
   symplectic (proved), symmetric (proved)
   written by symplectic VERSION *)

From Coq Require Import List QArith.
From SPRK Require Import Tables.
Import ListNotations.
Open Scope Q_scope.

(** The entries are polynomials in x = sqrt(3); coefficients of 1, x, ... *)
Definition gauss_2_table : Table := {|
  reduction := [3; 0];
  matrix c := [[[1#4; 0]; [1#4; -1#6]]; [[1#4; 1#6]; [1#4; 0]]];
  weights c := [[1#2; 0]; [1#2; 0]]
|}.

Theorem gauss_2_is_proved : forall (K : Algebra) (x : K), is_root (reduction gauss_2_table) x ->
  let M := method gauss_2_table x in
  has_order M general 4 /\
  is_symplectic M /\
  is_symmetric M.
Proof. prove_table [1; 0]%nat. Qed.

Print Assumptions gauss_2_is_proved.
