(** * The check of a table whose entries are polynomials in one number *)

From Coq Require Import Arith Bool Lia List Permutation QArith Ring.
From SPRK Require Export Definitions Orders Symplectic.
Import ListNotations.

(** ** 1. Polynomials modulo x^d = r_0 + r_1 x + ... *)

Definition is_nought (c : Q) : bool := Z.eqb (Qnum c) 0.

Section Polynomials.
  (** Coefficients may be rationals, or polynomials in another variable. [plus_times c x y] is c x + y. *)
  Context {A : Type} (nought : A) (plus_times : Q -> A -> A -> A).

  Fixpoint add_multiple (c : Q) (f g : list A) : list A :=
    match f with
    | [] => g
    | x :: f =>
        match g with
        | [] => plus_times c x nought :: add_multiple c f []
        | y :: g => plus_times c x y :: add_multiple c f g
        end
    end.
  Definition add (c : Q) (f g : list A) : list A := if is_nought c then g else add_multiple c f g.

  (** c + x f without its highest coefficient, and that. *)
  Fixpoint push (c : A) (f : list A) : list A * A :=
    match f with
    | [] => ([], c)
    | d :: f => let (low, top) := push d f in (c :: low, top)
    end.

  (** Products with x and with a polynomial of rational coefficients. *)
  Definition times_x (r : polynomial) (f : list A) : list A :=
    if Nat.eqb (length f) (length r) then
      let (low, top) := push nought f in
      map (fun '(c, y) => plus_times c top y) (combine r low)
    else nought :: f.
  Fixpoint multiply (r f : polynomial) (g : list A) : list A :=
    match f with
    | [] => map (fun _ => nought) r
    | c :: f => add c g (times_x r (multiply r f g))
    end.

  (** f(1 - x) *)
  Fixpoint reflect (r : polynomial) (f : list A) : list A :=
    match f with
    | [] => map (fun _ => nought) r
    | c :: f => let g := reflect r f in add 1 [c] (add (-1) (times_x r g) g)
    end.

  Context {K : Algebra} (v : A -> K).
  Hypothesis v_nought : v nought = 0%K.
  Hypothesis v_plus_times : forall c x y, v (plus_times c x y) = (rational c * v x + v y)%K.
  Local Open Scope algebra_scope.
  Add Ring K_ring : (ring_laws K).

  Lemma nought_value c : is_nought c = true -> rational c = (0 : K).
  Proof.
    intros H; apply Z.eqb_eq in H. rewrite <- rational_zero. apply rational_equal.
    unfold Qeq. rewrite H. reflexivity.
  Qed.

  Lemma add_value c f g x : value_of v (add c f g) x = rational c * value_of v f x + value_of v g x.
  Proof.
    unfold add. destruct (is_nought c) eqn:E; [rewrite (nought_value _ E); ring|]. clear E.
    revert g; induction f as [|y f IH]; intros g; simpl; [ring|].
    destruct g; simpl; rewrite IH, v_plus_times; simpl; [rewrite v_nought|]; ring.
  Qed.

  Lemma noughts_value {B} (l : list B) x : value_of v (map (fun _ => nought) l) x = 0.
  Proof. induction l as [|y l IH]; simpl; [reflexivity | rewrite IH, v_nought; ring]. Qed.

  Lemma push_value c f x : let (low, top) := push c f in
    value_of v low x + power x (length f) * v top = v c + x * value_of v f x /\ length low = length f.
  Proof.
    revert c; induction f as [|d f IH]; intros c; simpl; [split; [ring | reflexivity]|].
    specialize (IH d). destruct (push d f) as [low top]. simpl. destruct IH as [IH Hlength]; split; [|congruence].
    transitivity (v c + x * (value_of v low x + power x (length f) * v top)); [ring|]. rewrite IH. reflexivity.
  Qed.

  Lemma low_value top r low x : length low = length r ->
    value_of v (map (fun '(c, y) => plus_times c top y) (combine r low)) x = value r x * v top + value_of v low x.
  Proof.
    revert low; induction r as [|c r IH]; intros [|y low]; simpl; intros H; try discriminate; [unfold value; simpl; ring|].
    rewrite IH, v_plus_times by congruence. unfold value; simpl. ring.
  Qed.

  Context (r : polynomial) (x : K) (Hx : is_root r x).

  Lemma times_x_value f : value_of v (times_x r f) x = x * value_of v f x.
  Proof.
    unfold times_x. destruct (Nat.eqb (length f) (length r)) eqn:E; [|simpl; rewrite v_nought; ring].
    apply Nat.eqb_eq in E. pose proof (push_value nought f x) as H. destruct (push nought f) as [low top].
    destruct H as [H Hlength]. rewrite low_value by congruence. unfold is_root in Hx. rewrite <- Hx, <- E.
    transitivity (value_of v low x + power x (length f) * v top); [ring|]. rewrite H, v_nought. ring.
  Qed.

  Lemma multiply_value f g : value_of v (multiply r f g) x = value f x * value_of v g x.
  Proof.
    unfold value. induction f as [|c f IH]; simpl; [rewrite noughts_value; ring|].
    rewrite add_value, times_x_value, IH. ring.
  Qed.

  Lemma reflect_value f : value_of v (reflect r f) x = value_of v f (1 - x).
  Proof.
    induction f as [|c f IH]; simpl; [rewrite noughts_value; ring|].
    rewrite !add_value, times_x_value, IH; simpl.
    rewrite (rational_opposite 1), rational_one. ring.
  Qed.
End Polynomials.

Definition plus_times (c x y : Q) : Q := Qred (c * x + y).
Definition is_zero (f : polynomial) : bool := forallb is_nought f.

(** Any order of rationals and of lists will do. *)
Definition compare_rationals (x y : Q) : comparison :=
  match Z.compare (Qnum x) (Qnum y) with Eq => Pos.compare (Qden x) (Qden y) | different => different end.
Fixpoint compare_lists {A} (compare : A -> A -> comparison) (f g : list A) : comparison :=
  match f, g with
  | [], [] => Eq
  | [], _ => Lt
  | _, [] => Gt
  | x :: f, y :: g => match compare x y with Eq => compare_lists compare f g | different => different end
  end.

Lemma compare_rationals_equal x y : compare_rationals x y = Eq -> x = y.
Proof.
  destruct x as [n d], y as [m e]. unfold compare_rationals; simpl.
  destruct (Z.compare_spec n m); try discriminate. intros E. apply Pos.compare_eq in E. congruence.
Qed.

Lemma compare_lists_equal {A} (compare : A -> A -> comparison) :
  (forall x y, compare x y = Eq -> x = y) -> forall f g, compare_lists compare f g = Eq -> f = g.
Proof.
  intros H f; induction f as [|x f IH]; intros [|y g]; simpl; try discriminate; [reflexivity|].
  destruct (compare x y) eqn:E; try discriminate. intros E'. rewrite (H x y E), (IH g E'). reflexivity.
Qed.

Section RationalPolynomials.
  Context {K : Algebra}.
  Add Ring K_ring : (ring_laws K).

  Lemma plus_times_value c x y : rational (plus_times c x y) = (rational c * rational x + rational y)%K :> K.
  Proof.
    unfold plus_times. rewrite (rational_equal K _ _ (Qred_correct _)), rational_plus, rational_times. reflexivity.
  Qed.

  Lemma is_zero_value f (x : K) : is_zero f = true -> value f x = 0%K.
  Proof.
    unfold value. induction f as [|c f IH]; simpl; [reflexivity|].
    intros H; apply andb_prop in H; destruct H as [Hc Hf]. rewrite (nought_value _ Hc), IH by assumption. ring.
  Qed.

  (** A rational table has x = 0. *)
  Lemma zero_is_root : is_root [0%Q] (zero : K).
  Proof. unfold is_root, value; simpl. rewrite rational_zero. ring. Qed.

  Lemma equal_from_zero (x y : K) : (x - y = 0)%K -> x = y.
  Proof. intros H. transitivity (x - y + y)%K; [ring | rewrite H; ring]. Qed.
End RationalPolynomials.

(** ** 2. The check *)

Section Tables.
  Context (T : Table).
  Let r := reduction T.
  Let s := length (weights T position).
  Let plus := add 0%Q plus_times.
  Let times := multiply 0%Q plus_times r.
  Let entry c i j := nth j (nth i (matrix T c) []) [].
  Let w c i := nth i (weights T c) [].

  (** sum_j row_j f_j over the first n stages *)
  Fixpoint row_times (n : nat) (row f : list polynomial) : polynomial :=
    match n, row, f with
    | S n, x :: row, y :: f => plus 1 (times x y) (row_times n row f)
    | _, _, _ => map (fun _ => 0%Q) r
    end.

  Definition table_unit : list polynomial := map (fun _ => 1%Q :: map (fun _ => 0%Q) (tl r)) (weights T position).
  Definition table_product (f g : list polynomial) : list polynomial := map (fun '(x, y) => times x y) (combine f g).
  Definition table_apply (c : colour) (n : Q) (f : list polynomial) : list polynomial :=
    map (fun row => plus n (row_times s row f) (map (fun _ => 0%Q) r)) (matrix T c).
  Definition table_total (c : colour) (f : list polynomial) (v : Q) : bool :=
    is_zero (plus (-1) [v] (row_times s (weights T c) f)).

  Definition for_all_stages (f : nat -> nat -> bool) : bool := forallb (fun i => forallb (f i) (seq 0 s)) (seq 0 s).

  Definition table_symplectic_for_separable : bool := for_all_stages (fun i j =>
    is_zero (plus 1 (times (w position i) (entry momentum i j))
            (plus 1 (times (w momentum j) (entry position j i))
            (plus (-1) (times (w position i) (w momentum j)) [])))).
  Definition table_symplectic : bool :=
    if table_symplectic_for_separable
    then forallb (fun i => is_zero (plus (-1) (w momentum i) (w position i))) (seq 0 s) else false.

  Definition table_symmetric (images : list nat) : bool :=
    let image i := nth i images 0%nat in
    forallb (fun i => existsb (fun j => Nat.eqb i (image j)) (seq 0 s)) (seq 0 s) &&
    forallb (fun c => for_all_stages (fun i j =>
      is_zero (plus (-1) (w c i) (w c (image i))) &&
      is_zero (plus (-1) (w c j) (plus 1 (entry c i j) (entry c (image i) (image j)))))) [position; momentum].

  (** The used stages of a splitting are n successive ones after the first m, for each colour; the symmetry reverses them. *)
  Definition of_colour (drifts kicks : nat * nat) (c : colour) : nat * nat :=
    match c with position => drifts | momentum => kicks end.
  Definition used_stages (range : nat * nat) : list nat := seq (fst range) (snd range).
  Definition unused_stages (range : nat * nat) : list nat :=
    seq 0 (fst range) ++ seq (fst range + snd range) (s - (fst range + snd range)).
  Definition mirrored (range : nat * nat) (i : nat) : nat := 2 * fst range + snd range - 1 - i.

  Definition table_symmetric_for_separable (drifts kicks : nat * nat) : bool :=
    let range := of_colour drifts kicks in
    forallb (fun c =>
      Nat.leb (fst (range c) + snd (range c)) s &&
      forallb (fun i => is_zero (w c i) && forallb (fun j => is_zero (entry c j i)) (used_stages (range (other c))))
        (unused_stages (range c)) &&
      forallb (fun i => is_zero (plus (-1) (w c i) (w c (mirrored (range c) i))) &&
        forallb (fun j => is_zero (plus (-1) (w c i)
          (plus 1 (entry c j i) (entry c (mirrored (range (other c)) j) (mirrored (range c) i)))))
        (used_stages (range (other c)))) (used_stages (range c))) [position; momentum].

  Context {K : Algebra} (x : K) (Hx : is_root r x).
  Let M := method T x.
  Add Ring K_ring : (ring_laws K).
  Local Open Scope algebra_scope.

  Lemma plus_value c f g : value (plus c f g) x = rational c * value f x + value g x.
  Proof. apply add_value; [apply rational_zero | apply plus_times_value]. Qed.

  Lemma times_value f g : value (times f g) x = value f x * value g x.
  Proof. apply multiply_value; [apply rational_zero | apply plus_times_value | exact Hx]. Qed.

  Lemma zeros_value {B} (l : list B) : value (map (fun _ => 0%Q) l) x = 0.
  Proof. apply noughts_value. apply rational_zero. Qed.

  Lemma row_times_value n row f :
    value (row_times n row f) x = sum (fun j => value (nth j row []) x * value (nth j f []) x) (seq 0 n).
  Proof.
    revert row f; induction n as [|n IH]; intros row f; [apply zeros_value|].
    simpl seq; simpl sum. rewrite <- seq_shift, sum_map.
    destruct row as [|y row], f as [|z f]; simpl row_times; cbn [nth];
      [| | | rewrite plus_value, times_value, IH, rational_one; ring];
      rewrite zeros_value;
      (rewrite (sum_equal _ (fun _ => 0)); [rewrite sum_zero | intros j _; destruct j]); simpl; unfold value; simpl; ring.
  Qed.

  Lemma nth_map_default {A B} (f : A -> B) l d e i : f d = e -> nth i (map f l) e = f (nth i l d).
  Proof. intros <-. apply map_nth. Qed.

  Lemma table_product_value f g i :
    value (nth i (table_product f g) []) x = value (nth i f []) x * value (nth i g []) x.
  Proof.
    unfold table_product. revert g i; induction f as [|y f IH]; intros [|z g] [|i]; simpl; try (unfold value; simpl; ring).
    - apply times_value.
    - apply IH.
  Qed.

  Definition table_code : Code M.
  Proof.
    refine (Build_Code K M (list polynomial) (compare_lists (compare_lists compare_rationals))
      (fun f i => value (nth i f []) x) table_unit table_product table_apply table_total _ _ _ _ _).
    - apply compare_lists_equal, compare_lists_equal, compare_rationals_equal.
    - intros i Hi. apply in_seq in Hi. simpl in Hi. unfold table_unit.
      rewrite nth_indep with (d' := 1%Q :: map (fun _ => 0%Q) (tl r)) by (rewrite map_length; lia).
      rewrite (map_nth (fun _ : polynomial => _) _ []). unfold value; simpl.
      fold (value (map (fun _ => 0%Q) (tl r)) x). rewrite zeros_value, rational_one. ring.
    - intros f g i _. apply table_product_value.
    - intros c n f i _. simpl. unfold table_apply.
      set (row := fun row => plus n (row_times s row f) (map (fun _ => 0%Q) r)).
      transitivity (value (row (nth i (matrix T c) [])) x).
      + destruct (Nat.lt_ge_cases i (length (matrix T c))) as [H | H].
        * rewrite nth_indep with (d' := row []) by now rewrite map_length. now rewrite (map_nth row).
        * rewrite nth_overflow by now rewrite map_length. rewrite (nth_overflow (matrix T c)) by assumption.
          unfold row. rewrite plus_value, zeros_value, row_times_value.
          rewrite (sum_equal _ (fun _ => 0)); [rewrite sum_zero; unfold value; simpl; ring|].
          intros j _. destruct j; unfold value; simpl; ring.
      + unfold row. rewrite plus_value, zeros_value, row_times_value. simpl. fold s. ring.
    - intros c f v H. apply (is_zero_value _ x) in H.
      rewrite plus_value, row_times_value, (rational_opposite 1), rational_one in H. unfold value at 1 in H; simpl in H.
      apply equal_from_zero. rewrite <- H. simpl. fold s. ring.
  Defined.

  Theorem table_symplectic_for_separable_sound : table_symplectic_for_separable = true -> is_symplectic_for_separable M.
  Proof.
    unfold table_symplectic_for_separable, for_all_stages. intros H i j Hi Hj.
    rewrite forallb_forall in H. specialize (H i Hi). rewrite forallb_forall in H. specialize (H j Hj).
    apply (is_zero_value _ x) in H. rewrite !plus_value, !times_value, (rational_opposite 1), !rational_one in H.
    apply equal_from_zero. rewrite <- H. unfold value at 7; simpl. unfold entry, w. ring.
  Qed.

  Theorem table_symplectic_sound : table_symplectic = true -> is_symplectic M.
  Proof.
    unfold table_symplectic. destruct table_symplectic_for_separable eqn:E; [|discriminate]. intros H.
    split; [now apply table_symplectic_for_separable_sound|]. intros i Hi.
    rewrite forallb_forall in H. specialize (H i Hi). apply (is_zero_value _ x) in H.
    rewrite !plus_value, (rational_opposite 1), rational_one in H.
    apply equal_from_zero. rewrite <- H. simpl. unfold w. ring.
  Qed.

  Theorem table_symmetric_sound images : table_symmetric images = true -> is_symmetric M.
  Proof.
    unfold table_symmetric. intros H. apply andb_prop in H; destruct H as [Hbijective H].
    exists (fun i => nth i images 0%nat). split.
    - apply Permutation_sym, NoDup_Permutation_bis; [apply seq_NoDup | now rewrite map_length |].
      intros i Hi. rewrite forallb_forall in Hbijective. specialize (Hbijective i Hi).
      apply existsb_exists in Hbijective. destruct Hbijective as [j [Hj E]]. apply Nat.eqb_eq in E. subst i.
      now apply (in_map (fun i => nth i images 0%nat)).
    - intros c i Hi. rewrite forallb_forall in H.
      assert (Hc : In c [position; momentum]) by (destruct c; simpl; tauto).
      specialize (H c Hc). unfold for_all_stages in H. rewrite forallb_forall in H. specialize (H i Hi).
      rewrite forallb_forall in H. split.
      + specialize (H i Hi). apply andb_prop in H; destruct H as [H _]. apply (is_zero_value _ x) in H.
        rewrite !plus_value, (rational_opposite 1), rational_one in H.
        apply equal_from_zero. rewrite <- H. simpl. unfold w. ring.
      + intros j Hj. specialize (H j Hj). apply andb_prop in H; destruct H as [_ H]. apply (is_zero_value _ x) in H.
        rewrite !plus_value, (rational_opposite 1), rational_one in H.
        apply equal_from_zero. rewrite <- H. simpl. unfold w, entry. ring.
  Qed.

  Lemma parts_of_a_sequence m n t : (m + n <= t)%nat ->
    Permutation (seq m n ++ seq 0 m ++ seq (m + n) (t - (m + n))) (seq 0 t).
  Proof.
    intros H. rewrite app_assoc.
    transitivity ((seq 0 m ++ seq m n) ++ seq (m + n) (t - (m + n))); [apply Permutation_app_tail, Permutation_app_comm|].
    replace (seq m n) with (seq (0 + m) n) by reflexivity. rewrite <- seq_app.
    replace (seq (m + n) (t - (m + n))) with (seq (0 + (m + n)) (t - (m + n))) by reflexivity. rewrite <- seq_app.
    replace (m + n + (t - (m + n)))%nat with t by lia. reflexivity.
  Qed.

  Lemma reversed_sequence m n : Permutation (map (fun i => 2 * m + n - 1 - i)%nat (seq m n)) (seq m n).
  Proof.
    apply Permutation_sym, NoDup_Permutation_bis; [apply seq_NoDup | now rewrite map_length |].
    intros i Hi. apply in_seq in Hi. apply in_map_iff. exists (2 * m + n - 1 - i)%nat. split; [lia|]. apply in_seq. lia.
  Qed.

  Theorem table_symmetric_for_separable_sound drifts kicks :
    table_symmetric_for_separable drifts kicks = true -> is_symmetric_for_separable M.
  Proof.
    unfold table_symmetric_for_separable. set (range := of_colour drifts kicks). intros H.
    exists (fun c => used_stages (range c)), (fun c => unused_stages (range c)), (fun c => mirrored (range c)).
    intros c. rewrite forallb_forall in H.
    assert (Hc : In c [position; momentum]) by (destruct c; simpl; tauto).
    specialize (H c Hc).
    apply andb_prop in H; destruct H as [H Hused]. apply andb_prop in H; destruct H as [Hfits Hunused].
    apply Nat.leb_le in Hfits. rewrite forallb_forall in Hunused, Hused.
    split; [now apply parts_of_a_sequence|]. split; [apply reversed_sequence|]. split; intros i Hi.
    - specialize (Hunused i Hi). apply andb_prop in Hunused; destruct Hunused as [Hb Ha].
      rewrite forallb_forall in Ha.
      split; [exact (is_zero_value _ x Hb) | intros j Hj; exact (is_zero_value _ x (Ha j Hj))].
    - specialize (Hused i Hi). apply andb_prop in Hused; destruct Hused as [Hb Ha]. rewrite forallb_forall in Ha. split.
      + apply (is_zero_value _ x) in Hb. rewrite !plus_value, (rational_opposite 1), rational_one in Hb.
        apply equal_from_zero. rewrite <- Hb. simpl. unfold w. ring.
      + intros j Hj. specialize (Ha j Hj). apply (is_zero_value _ x) in Ha.
        rewrite !plus_value, (rational_opposite 1), rational_one in Ha.
        apply equal_from_zero. rewrite <- Ha. simpl. unfold w, entry. ring.
  Qed.
End Tables.

Definition no_stages : nat * nat := (0, 0)%nat.
Definition no_images : list nat := [].

(** Proves by computation what a file claims of a table; [images] are the images of the stages under the symmetry, [drifts] and
    [kicks] the used stages of a splitting. *)
Ltac compute_claims Hx images drifts kicks :=
  cbv zeta;
  lazymatch goal with
  | |- context [is_symplectic (method ?T ?x)] =>
      assert (is_symplectic (method T x)) by (apply (table_symplectic_sound T x Hx); vm_cast_no_check (eq_refl true))
  | _ => idtac
  end;
  repeat match goal with |- _ /\ _ => split end;
  lazymatch goal with
  | H : is_symplectic ?M |- is_symplectic ?M => exact H
  | H : is_symplectic (method ?T ?x) |- has_order (method ?T ?x) general ?p =>
      apply (symplectic_order_sound _ H (table_code T x Hx) p); vm_cast_no_check (eq_refl true)
  | |- has_order (method ?T ?x) _ _ => apply (all_trees_sound (table_code T x Hx)); vm_cast_no_check (eq_refl true)
  | |- is_symplectic_for_separable (method ?T ?x) =>
      apply (table_symplectic_for_separable_sound T x Hx); vm_cast_no_check (eq_refl true)
  | |- is_symmetric (method ?T ?x) => apply (table_symmetric_sound T x images); vm_cast_no_check (eq_refl true)
  | |- is_symmetric_for_separable (method ?T ?x) =>
      apply (table_symmetric_for_separable_sound T x drifts kicks); vm_cast_no_check (eq_refl true)
  end.
Ltac prove_table images := intros K x Hx; compute_claims Hx images no_stages no_stages.
Ltac prove_rational_table images := intros K; compute_claims (@zero_is_root K) images no_stages no_stages.
Ltac prove_splitting drifts kicks := intros K x Hx; compute_claims Hx no_images drifts kicks.
Ltac prove_rational_splitting drifts kicks := intros K; compute_claims (@zero_is_root K) no_images drifts kicks.
