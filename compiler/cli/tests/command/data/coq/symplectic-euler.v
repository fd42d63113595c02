(* symplectic-euler, 1 stage, basis polynomial(1), nodes 0
   source: Leok & Zhang, Discrete Hamiltonian Variational Integrators, Example 2 with c = 0
   source: the same method as radau-left-1
   order 1 for every H (proved), 1 for T(p) + U(q) (proved), 1 for T quadratic (proved)
   symplectic (proved)
   written by symplectic VERSION *)

From Coq Require Import List QArith.
From SPRK Require Import Tables.
Import ListNotations.
Open Scope Q_scope.

(** The entries are rational: polynomials in x = 0. *)
Definition symplectic_euler_table : Table := {|
  reduction := [0];
  matrix c := match c with
  | position => [[[0]]]
  | momentum => [[[1]]]
  end;
  weights c := [[1]]
|}.

Theorem symplectic_euler_is_proved : forall K : Algebra,
  let M := method symplectic_euler_table (@zero K) in
  has_order M general 1 /\
  is_symplectic M.
Proof. prove_rational_table no_images. Qed.

Print Assumptions symplectic_euler_is_proved.
