(* position-verlet, 2 stages, kick 1, 0, drift 1/2, 1/2, first drift
   source: Tuckerman, Berne & Martyna 1992
   source: for separable Hamiltonians the method of lobatto-2-exchanged
   source: the same method as saba-1
   order 1 for every H (proved), 2 for T(p) + U(q) (proved), 2 for T quadratic (proved)
   symplectic(separable) (proved), symmetric(separable) (proved)
   written by symplectic VERSION *)

From Coq Require Import List QArith.
From SPRK Require Import Tables.
Import ListNotations.
Open Scope Q_scope.

(** The entries are rational: polynomials in x = 0. *)
Definition position_verlet_table : Table := {|
  reduction := [0];
  matrix c := match c with
  | position => [[[1#2]; [0]]; [[1#2]; [1#2]]]
  | momentum => [[[0]; [0]]; [[1]; [0]]]
  end;
  weights c := match c with
  | position => [[1#2]; [1#2]]
  | momentum => [[1]; [0]]
  end
|}.

Theorem position_verlet_is_proved : forall K : Algebra,
  let M := method position_verlet_table (@zero K) in
  has_order M general 1 /\
  has_order M separable 2 /\
  is_symplectic_for_separable M /\
  is_symmetric_for_separable M.
Proof. prove_rational_splitting (0, 2)%nat (0, 1)%nat. Qed.

Print Assumptions position_verlet_is_proved.
