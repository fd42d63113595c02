(** The theorem of Gauss's method with two stages at the real number sqrt 3: its hypothesis can be met. *)

From Coq Require Import QArith Qreals Reals RealField.
From SPRK Require Import Tables.
From SPRK Require Import gauss_2.

Definition reals : Algebra.
Proof.
  refine {| carrier := R; ring_laws := RTheory; rational := Q2R |}.
  - exact Qeq_eqR.
  - unfold Q2R; simpl; field.
  - exact Q2R_plus.
  - exact Q2R_mult.
Defined.

Theorem gauss_2_in_the_reals :
  let M := method gauss_2_table (sqrt 3 : reals) in has_order M general 4 /\ is_symplectic M /\ is_symmetric M.
Proof.
  apply gauss_2_is_proved. unfold is_root, value, value_of, Q2R; simpl. unfold Q2R; simpl.
  transitivity (sqrt 3 * sqrt 3)%R; [ring | rewrite sqrt_sqrt; [field | ]].
  apply Rlt_le, (IZR_lt 0 3); reflexivity.
Qed.
