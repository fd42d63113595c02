(* gauss-4, 4 stages, basis polynomial(4), nodes gauss(4)
   source: Kuntzmann 1961
   source: Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964)
   source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3
   source: built as in Marsden & West 2001, Theorem 2.6.2
   order 8 for every H (proved), 8 for T(p) + U(q) (proved), 8 for T quadratic (proved)
   symplectic (proved), symmetric (proved)
   written by symplectic VERSION *)

From Coq Require Import List QArith.
From SPRK Require Import Nodes.
Import ListNotations.
Open Scope Q_scope.

(** The nodes are the roots of 70*x^4 - 140*x^3 + 90*x^2 - 20*x + 1; the entries are polynomials in them. *)
Definition gauss_4_table : NodeTable := {|
  node_reduction := [-1#70; 2#7; -9#7; 2];
  columns c := [[1#8; 2#3; -5#2; 35#18];
     [-41#24; 20#3; 95#12; -245#18];
     [35#8; -175#6; 175#12; 245#18];
     [-35#12; 70#3; -70#3; 0]];
  node_weights c := [1#9; 35#36; -35#36; 0]
|}.

Theorem gauss_4_is_proved : forall (K : Algebra) (nodes : list K), are_roots (node_reduction gauss_4_table) nodes ->
  let M := node_method gauss_4_table nodes in
  has_order M general 8 /\
  is_symplectic M /\
  (are_mirrored nodes -> is_symmetric M).
Proof. prove_nodes. Qed.

Print Assumptions gauss_4_is_proved.
