(** * The check of a table whose entries are polynomials in the nodes

    A sum over the nodes is a rational number, by Newton's identities: no node is ever computed. *)

From Coq Require Import Arith Bool Lia List Permutation QArith Ring.
From SPRK Require Export Definitions Orders Symplectic Tables.
Import ListNotations.

(** ** 1. Newton's identities *)

(** Sums of powers of the roots, by Newton's identities: p_k = r_(s-1) p_(k-1) + r_(s-2) p_(k-2) + ... + k r_(s-k). *)
Fixpoint dot (f g : list Q) : Q :=
  match f, g with c :: f, d :: g => c * d + dot f g | _, _ => 0 end.
Fixpoint power_sums (highest_first : list Q) (k : nat) : list Q :=
  match k with
  | O => []
  | S k =>
      let before := power_sums highest_first k in
      Qred (dot highest_first before + inject_Z (Z.of_nat (S k)) * nth k highest_first 0) :: before
  end.
Definition power_sum (r : polynomial) (k : nat) : Q :=
  match k with O => inject_Z (Z.of_nat (length r)) | _ => hd 0%Q (power_sums (rev r) k) end.

Section Newton.
  Context {K : Algebra}.
  Add Ring K_ring : (ring_laws K).
  Local Open Scope algebra_scope.

  Definition natural (n : nat) : K := rational (inject_Z (Z.of_nat n)).
  Lemma natural_successor n : natural (S n) = natural n + 1.
  Proof.
    unfold natural. rewrite <- rational_one, <- rational_plus. apply rational_equal.
    rewrite Nat2Z.inj_succ. unfold Z.succ. now rewrite inject_Z_plus.
  Qed.

  (** The coefficient of X^(s-j) in the product of the X - c_i. *)
  Fixpoint symmetric_function (nodes : list K) (j : nat) : K :=
    match nodes, j with
    | _, O => 1
    | [], S _ => 0
    | c :: nodes, S j => symmetric_function nodes (S j) - c * symmetric_function nodes j
    end.
  Definition sum_of_powers (nodes : list K) (k : nat) : K := sum (fun c => power c k) nodes.
  Definition convolution (e p : nat -> K) (k : nat) : K := sum (fun j => e j * p (k - j)%nat) (seq 0 k).

  Lemma sum_successor (f : nat -> K) k : sum f (seq 0 (S k)) = f 0%nat + sum (fun j => f (S j)) (seq 0 k).
  Proof. simpl. now rewrite <- seq_shift, sum_map. Qed.

  Lemma sum_append {I} (f : I -> K) l m : sum f (l ++ m) = sum f l + sum f m.
  Proof. induction l as [|i l IH]; simpl; [ring | rewrite IH; ring]. Qed.

  Lemma newton nodes k :
    convolution (symmetric_function nodes) (sum_of_powers nodes) k = - (natural k * symmetric_function nodes k).
  Proof.
    revert k; induction nodes as [|c nodes IH]; intros k.
    - unfold convolution, sum_of_powers; simpl.
      rewrite (sum_equal _ (fun _ => 0)) by (intros; ring). rewrite sum_zero.
      destruct k; simpl; [|ring]. replace (natural 0) with (0 : K) by (symmetry; apply rational_zero). ring.
    - destruct k as [|k].
      { replace (natural 0) with (0 : K) by (symmetry; apply rational_zero). unfold convolution; simpl. ring. }
      set (e := symmetric_function nodes). set (p := sum_of_powers nodes).
      assert (split_sum : forall k, convolution e (sum_of_powers (c :: nodes)) k
        = convolution e p k + convolution e (power c) k).
      { intros n. unfold convolution. rewrite <- sum_plus. apply sum_equal. intros j _.
        unfold sum_of_powers; simpl. fold (sum_of_powers nodes (n - j)). fold p. ring. }
      assert (powers : convolution e (power c) (S k) = c * convolution e (power c) k + e k * c).
      { unfold convolution. rewrite seq_S, sum_append.
        rewrite (sum_equal _ (fun j => c * (e j * power c (k - j)%nat)) (seq 0 k)).
        - rewrite sum_times. cbn [sum fold_right]. change (0 + k)%nat with k. replace (S k - k)%nat with 1%nat by lia. simpl. ring.
        - intros j Hj. apply in_seq in Hj. replace (S k - j)%nat with (S (k - j)) by lia. simpl. ring. }
      transitivity (convolution e (sum_of_powers (c :: nodes)) (S k) - c * convolution e (sum_of_powers (c :: nodes)) k).
      { unfold convolution. rewrite !sum_successor. simpl symmetric_function. fold e.
        replace (symmetric_function (c :: nodes) 0) with (1 : K) by reflexivity.
        replace (e 0%nat) with (1 : K) by (unfold e; destruct nodes; reflexivity).
        rewrite (sum_equal _ (fun j => e (S j) * sum_of_powers (c :: nodes) (S k - S j)%nat
          + (- c) * (e j * sum_of_powers (c :: nodes) (k - j)%nat))).
        - rewrite sum_plus, sum_times. ring.
        - intros j _. simpl symmetric_function. fold e. change (S k - S j)%nat with (k - j)%nat. ring. }
      rewrite !split_sum, powers. unfold e, p. rewrite !IH. rewrite natural_successor. simpl symmetric_function. ring.
  Qed.

  Lemma times_plus_nth x f g k : nth k (times_plus x f g) 0 = x * nth k f 0 + nth k g (0 : K).
  Proof.
    revert g k; induction f as [|c f IH]; intros [|d g] [|k]; simpl; try ring; rewrite IH; destruct k; simpl; ring.
  Qed.

  Lemma times_plus_length (x : K) f c : length (times_plus x f (c :: f)) = S (length f).
  Proof. revert c; induction f as [|d f IH]; intros c; simpl; [reflexivity | now rewrite IH]. Qed.

  Lemma product_length (nodes : list K) : length (product_of_roots nodes) = S (length nodes).
  Proof. induction nodes as [|c nodes IH]; simpl; [reflexivity | now rewrite times_plus_length, IH]. Qed.

  Lemma symmetric_function_beyond nodes j : (length nodes < j)%nat -> symmetric_function nodes j = 0.
  Proof.
    revert j; induction nodes as [|c nodes IH]; intros [|j]; simpl; intros H; try lia; [reflexivity|].
    rewrite !IH by lia. ring.
  Qed.

  Lemma product_coefficient nodes j : (j <= length nodes)%nat ->
    nth (length nodes - j) (product_of_roots nodes) 0 = symmetric_function nodes j.
  Proof.
    revert j; induction nodes as [|c nodes IH]; intros j Hj.
    - simpl in Hj. replace j with 0%nat by lia. reflexivity.
    - simpl length in *. simpl product_of_roots. rewrite times_plus_nth. destruct j as [|j].
      + rewrite Nat.sub_0_r. simpl nth at 2. rewrite nth_overflow by (rewrite product_length; lia).
        specialize (IH 0%nat). rewrite Nat.sub_0_r in IH. rewrite IH by lia.
        destruct nodes; simpl; ring.
      + simpl symmetric_function. replace (S (length nodes) - S j)%nat with (length nodes - j)%nat by lia.
        rewrite IH by lia. destruct (Nat.eq_dec j (length nodes)) as [-> | H].
        * rewrite Nat.sub_diag. simpl nth. rewrite (symmetric_function_beyond nodes (S (length nodes))) by lia. ring.
        * replace (length nodes - j)%nat with (S (length nodes - S j)) by lia. simpl nth. rewrite IH by lia. ring.
  Qed.

  Lemma times_plus_value x f g (y : K) :
    value_of (fun c => c) (times_plus x f g) y = x * value_of (fun c => c) f y + value_of (fun c => c) g y.
  Proof.
    revert g; induction f as [|c f IH]; intros [|d g]; simpl; try ring; rewrite IH; simpl; ring.
  Qed.

  Lemma product_vanishes nodes (c : K) : In c nodes -> value_of (fun c => c) (product_of_roots nodes) c = 0.
  Proof.
    induction nodes as [|d nodes IH]; simpl; [tauto|].
    rewrite times_plus_value. simpl. intros [-> | H]; [ring | rewrite IH by assumption; ring].
  Qed.

  Lemma value_append {A} (v : A -> K) f g x : value_of v (f ++ g) x = value_of v f x + power x (length f) * value_of v g x.
  Proof. induction f as [|c f IH]; simpl; [ring | rewrite IH; ring]. Qed.

  Context (r : polynomial) (nodes : list K) (Hnodes : are_roots r nodes).

  Lemma nodes_length : length nodes = length r.
  Proof.
    pose proof (product_length nodes) as H. unfold are_roots in Hnodes.
    rewrite Hnodes, app_length, map_length in H. simpl in H. lia.
  Qed.

  Lemma node_is_root c : In c nodes -> is_root r c.
  Proof.
    intros H. pose proof (product_vanishes nodes c H) as E. unfold are_roots in Hnodes. rewrite Hnodes in E.
    rewrite value_append, map_length in E. simpl in E.
    assert (Hr : value_of (fun c => c) (map (fun c => rational (- c)%Q) r) c = - value r c).
    { unfold value. clear. induction r as [|d f IH]; simpl; [ring | rewrite IH, rational_opposite; ring]. }
    rewrite Hr in E. unfold is_root. apply equal_from_zero. rewrite <- E. ring.
  Qed.

  Lemma relation_coefficient j : rational (nth j (rev r) 0%Q) = - symmetric_function nodes (S j).
  Proof.
    pose proof nodes_length as Hlength.
    destruct (Nat.lt_ge_cases j (length r)) as [H | H].
    - rewrite <- product_coefficient by lia. unfold are_roots in Hnodes. rewrite Hnodes, rev_nth by exact H.
      rewrite app_nth1 by (rewrite map_length, Hlength; lia).
      replace (length nodes - S j)%nat with (length r - S j)%nat by lia.
      rewrite nth_indep with (d' := rational (- 0)%Q) by (rewrite map_length; lia).
      rewrite (map_nth (fun c => rational (- c)%Q)), rational_opposite. ring.
    - rewrite nth_overflow by (rewrite rev_length; lia). rewrite symmetric_function_beyond by lia.
      rewrite rational_zero. ring.
  Qed.

  Lemma dot_value f g : rational (dot f g)
    = sum (fun j => rational (nth j f 0%Q) * nth j (map rational g) 0) (seq 0 (length g)) :> K.
  Proof.
    revert f; induction g as [|d g IH]; intros f; [destruct f; apply rational_zero|].
    simpl length. rewrite sum_successor. destruct f as [|c f]; simpl.
    - rewrite (sum_equal _ (fun _ => 0)) by (intros; rewrite rational_zero; ring). rewrite sum_zero, rational_zero. ring.
    - rewrite rational_plus, rational_times, IH. ring.
  Qed.

  Lemma power_sums_value k :
    map rational (power_sums (rev r) k) = map (fun i => sum_of_powers nodes (k - i)) (seq 0 k).
  Proof.
    induction k as [|k IH]; [reflexivity|].
    assert (Hlength : length (power_sums (rev r) k) = k) by (clear; induction k; simpl; congruence).
    cbn [power_sums map seq]. rewrite <- seq_shift, map_map. f_equal.
    - rewrite (rational_equal K _ _ (Qred_correct _)), rational_plus, dot_value, Hlength, rational_times, relation_coefficient.
      fold (natural (S k)). pose proof (newton nodes (S k)) as N. unfold convolution in N. rewrite sum_successor in N.
      replace (symmetric_function nodes 0) with (1 : K) in N by (destruct nodes; reflexivity).
      rewrite Nat.sub_0_r in N |- *.
      rewrite (sum_equal _ (fun j => - (1) * (symmetric_function nodes (S j) * sum_of_powers nodes (S k - S j)%nat))).
      + rewrite sum_times. apply equal_from_zero.
        match type of N with ?u + ?v = ?w => transitivity (- (1) * ((u + v) - w)); [ring | rewrite N; ring] end.
      + intros j Hj. apply in_seq in Hj. rewrite relation_coefficient, IH.
        rewrite nth_indep with (d' := sum_of_powers nodes (k - 0)) by (rewrite map_length, seq_length; lia).
        rewrite (map_nth (fun i => sum_of_powers nodes (k - i))), seq_nth by lia. simpl. ring.
    - rewrite IH. apply map_ext. intros i. reflexivity.
  Qed.

  Lemma power_sum_value k : rational (power_sum r k) = sum_of_powers nodes k.
  Proof.
    destruct k as [|k].
    - unfold power_sum. rewrite <- nodes_length. unfold sum_of_powers. clear. fold (natural (length nodes)).
      induction nodes as [|c l IH]; simpl; [apply rational_zero|]. rewrite natural_successor, IH. simpl. ring.
    - pose proof (power_sums_value (S k)) as H. simpl in H. injection H as H _. exact H.
  Qed.
End Newton.

(** ** 2. The check *)

Section NodeTables.
  Context (T : NodeTable).
  Let r := node_reduction T.
  Let zeros := map (fun _ => 0%Q) r.
  Let plus := add 0%Q plus_times.
  Let times := multiply 0%Q plus_times r.

  (** Sums of the powers in a product of two functions; others are computed anew. *)
  Definition sums : list Q := map (power_sum r) (seq 0 (2 * length r)).
  Definition known_sum (known : list Q) (k : nat) : Q :=
    match nth_error known k with Some p => p | None => power_sum r k end.

  (** sum_i c_i^k f(c_i) *)
  Fixpoint moment (known : list Q) (k : nat) (f : polynomial) : Q :=
    match f with [] => 0 | c :: f => c * known_sum known k + moment known (S k) f end.

  Fixpoint columns_times (known : list Q) (k : nat) (n : Q) (m : list polynomial) (f : polynomial) : polynomial :=
    match m with
    | [] => zeros
    | column :: m => plus (Qred (n * moment known k f)) column (columns_times known (S k) n m f)
    end.

  (** Functions of two nodes: polynomials in y whose coefficients are polynomials in x. *)
  Let plus2 := add [] plus.
  Let times_y := multiply [] plus r.
  Definition times_in_x (f : polynomial) (m : list polynomial) : list polynomial := map (times f) m.
  Definition in_y (f : polynomial) : list polynomial := map (fun c => [c]) f.
  Fixpoint transposed (m : list polynomial) : list polynomial :=
    match m with
    | [] => []
    | column :: m => plus2 1 (in_y column) (map (cons 0%Q) (transposed m))
    end.
  Definition is_zero2 (m : list polynomial) : bool := forallb is_zero m.

  Definition nodes_symplectic_for_separable : bool :=
    let b := node_weights T position in
    let b' := node_weights T momentum in
    is_zero2 (plus2 1 (times_in_x b (columns T momentum))
             (plus2 1 (times_y b' (transposed (columns T position)))
             (plus2 (-1) (times_y b' [b]) []))).
  Definition nodes_symplectic : bool :=
    if nodes_symplectic_for_separable
    then is_zero (plus (-1) (node_weights T momentum) (node_weights T position)) else false.

  Definition nodes_symmetric : bool :=
    forallb (fun c =>
      let b := node_weights T c in
      let m := columns T c in
      is_zero (plus (-1) b (reflect 0%Q plus_times r b)) &&
      is_zero2 (plus2 (-1) (in_y b) (plus2 1 m (reflect [] plus r (map (reflect 0%Q plus_times r) m)))))
    [position; momentum].

  Context {K : Algebra} (nodes : list K) (Hnodes : are_roots r nodes).
  Let M := node_method T nodes.
  Add Ring K_ring : (ring_laws K).
  Local Open Scope algebra_scope.

  Lemma node_plus_value c f g (x : K) : value (plus c f g) x = rational c * value f x + value g x.
  Proof. apply add_value; [apply rational_zero | apply plus_times_value]. Qed.

  Lemma node_times_value f g x : In x nodes -> value (times f g) x = value f x * value g x.
  Proof.
    intros Hx. apply multiply_value; [apply rational_zero | apply plus_times_value | now apply node_is_root with nodes].
  Qed.

  Lemma node_reflect_value f x : In x nodes -> value (reflect 0%Q plus_times r f) x = value f (1 - x).
  Proof.
    intros Hx. apply reflect_value; [apply rational_zero | apply plus_times_value | now apply node_is_root with nodes].
  Qed.

  Lemma plus2_value c f g (x y : K) : value2 (plus2 c f g) x y = rational c * value2 f x y + value2 g x y.
  Proof. apply add_value; [reflexivity | intros; apply node_plus_value]. Qed.

  Lemma times_y_value f g x y : In y nodes -> value2 (times_y f g) x y = value f y * value2 g x y.
  Proof.
    intros Hy. apply multiply_value; [reflexivity | intros; apply node_plus_value | now apply node_is_root with nodes].
  Qed.

  Lemma reflect2_value f x y : In y nodes -> value2 (reflect [] plus r f) x y = value2 f x (1 - y).
  Proof.
    intros Hy. apply reflect_value; [reflexivity | intros; apply node_plus_value | now apply node_is_root with nodes].
  Qed.

  Lemma value2_map (g : polynomial -> polynomial) m (factor x x' y : K) :
    (forall f, value (g f) x = factor * value f x') -> value2 (map g m) x y = factor * value2 m x' y.
  Proof. intros H. unfold value2. induction m as [|f m IH]; simpl; [ring | rewrite H, IH; ring]. Qed.

  Lemma in_y_value f (x y : K) : value2 (in_y f) x y = value f y.
  Proof. unfold value2, value. induction f as [|c f IH]; simpl; [reflexivity | rewrite IH; ring]. Qed.

  Lemma transposed_value m (x y : K) : value2 (transposed m) x y = value2 m y x.
  Proof.
    induction m as [|f m IH]; simpl; [reflexivity|].
    rewrite plus2_value, in_y_value, (value2_map _ _ x x x), IH, rational_one.
    - unfold value2 at 2; simpl. fold (value2 m y x). ring.
    - intros g. unfold value; simpl. rewrite rational_zero. ring.
  Qed.

  Lemma is_zero2_value m (x y : K) : is_zero2 m = true -> value2 m x y = 0.
  Proof.
    unfold value2. induction m as [|f m IH]; simpl; [reflexivity|].
    intros H; apply andb_prop in H; destruct H as [Hf Hm]. rewrite (is_zero_value _ _ Hf), IH by assumption. ring.
  Qed.

  Lemma known_sum_value k : rational (known_sum sums k) = sum_of_powers nodes k.
  Proof.
    rewrite <- (power_sum_value r nodes Hnodes). unfold known_sum, sums.
    destruct (nth_error _ k) as [p|] eqn:E; [|reflexivity].
    assert (H : (k < 2 * length r)%nat).
    { rewrite <- (seq_length (2 * length r) 0), <- (map_length (power_sum r)). apply nth_error_Some. congruence. }
    apply nth_error_nth with (d := power_sum r 0) in E.
    rewrite (map_nth (power_sum r)), seq_nth in E by exact H. now rewrite <- E.
  Qed.

  Lemma moment_value k f : rational (moment sums k f) = sum (fun x => power x k * value f x) nodes.
  Proof.
    unfold value. revert k; induction f as [|c f IH]; intros k; simpl.
    - rewrite (sum_equal _ (fun _ => 0)) by (intros; ring). now rewrite sum_zero, rational_zero.
    - rewrite rational_plus, rational_times, known_sum_value, IH. unfold sum_of_powers. rewrite <- sum_times, <- sum_plus.
      apply sum_equal. intros x _. simpl. ring.
  Qed.

  Lemma columns_times_value k n m f x : value (columns_times sums k n m f) x
    = rational n * sum (fun y => power y k * value2 m x y * value f y) nodes.
  Proof.
    revert k; induction m as [|g m IH]; intros k; cbn [columns_times].
    - rewrite (sum_equal _ (fun _ => 0)) by (intros; unfold value2; simpl; ring). rewrite sum_zero.
      unfold zeros, value. rewrite noughts_value by apply rational_zero. ring.
    - rewrite node_plus_value, IH, (rational_equal K _ _ (Qred_correct _)), rational_times, moment_value.
      transitivity (rational n * (value g x * sum (fun y => power y k * value f y) nodes
        + sum (fun y => power y (S k) * value2 m x y * value f y) nodes)); [ring|].
      rewrite <- sum_times, <- sum_plus. f_equal. apply sum_equal. intros y _. unfold value2; simpl. ring.
  Qed.

  Definition node_code : Code M.
  Proof.
    refine (let known := sums in
      Build_Code K M polynomial (compare_lists compare_rationals) (fun f x => value f x)
      (1%Q :: map (fun _ => 0%Q) (tl r)) times (fun c n f => columns_times known 0 n (columns T c) f)
      (fun c f v => Qeq_bool (moment known 0 (times (node_weights T c) f)) v) _ _ _ _ _).
    - apply compare_lists_equal, compare_rationals_equal.
    - intros x _. unfold value; simpl. rewrite noughts_value, rational_one by apply rational_zero. ring.
    - intros f g x Hx. now apply node_times_value.
    - intros c n f x _. unfold known. rewrite columns_times_value. f_equal. apply sum_equal. intros y _. simpl. ring.
    - intros c f v H. apply Qeq_bool_eq in H. unfold known in H. apply (rational_equal K) in H.
      rewrite moment_value in H. rewrite <- H. apply sum_equal. intros x Hx. rewrite node_times_value by assumption. simpl. ring.
  Defined.

  Theorem nodes_symplectic_for_separable_sound :
    nodes_symplectic_for_separable = true -> is_symplectic_for_separable M.
  Proof.
    intros H x y Hx Hy. apply (is_zero2_value _ x y) in H.
    rewrite !plus2_value, !times_y_value, transposed_value, (rational_opposite 1), !rational_one in H by assumption.
    unfold times_in_x in H.
    rewrite (value2_map _ _ (value (node_weights T position) x) x x) in H by (intros; now apply node_times_value).
    change (value2 [] x y) with (0 : K) in H.
    change (value2 [node_weights T position] x y) with (value (node_weights T position) x + y * 0) in H.
    apply equal_from_zero. rewrite <- H. simpl. ring.
  Qed.

  Theorem nodes_symplectic_sound : nodes_symplectic = true -> is_symplectic M.
  Proof.
    unfold nodes_symplectic. destruct nodes_symplectic_for_separable eqn:E; [|discriminate]. intros H.
    split; [now apply nodes_symplectic_for_separable_sound|]. intros x _. apply (is_zero_value _ x) in H.
    rewrite node_plus_value, (rational_opposite 1), rational_one in H.
    apply equal_from_zero. rewrite <- H. simpl. ring.
  Qed.

  (** With every node c, 1 - c is one: so it is for the real roots of a polynomial that 1 - X changes in sign alone. *)
  Definition are_mirrored : Prop := Permutation (map (fun x => 1 - x) nodes) nodes.

  Theorem nodes_symmetric_sound : nodes_symmetric = true -> are_mirrored -> is_symmetric M.
  Proof.
    intros H Hmirrored. exists (fun x => 1 - x : K). split; [exact Hmirrored|].
    intros c x Hx. unfold nodes_symmetric in H. rewrite forallb_forall in H.
    assert (Hc : In c [position; momentum]) by (destruct c; simpl; tauto).
    specialize (H c Hc). apply andb_prop in H; destruct H as [Hb Ha]. split.
    - apply (is_zero_value _ x) in Hb.
      rewrite node_plus_value, node_reflect_value, (rational_opposite 1), rational_one in Hb by assumption.
      apply equal_from_zero. rewrite <- Hb. simpl. ring.
    - intros y Hy. apply (is_zero2_value _ x y) in Ha.
      rewrite !plus2_value, reflect2_value, in_y_value, (rational_opposite 1), !rational_one in Ha by assumption.
      rewrite (value2_map _ _ 1 x (1 - x)) in Ha by (intros; rewrite node_reflect_value by assumption; ring).
      apply equal_from_zero. rewrite <- Ha. simpl. ring.
  Qed.
End NodeTables.

(** Proves by computation what a file claims of a table in the nodes. *)
Ltac prove_nodes :=
  intros K nodes Hnodes; cbv zeta;
  lazymatch goal with
  | |- context [is_symplectic (node_method ?T nodes)] =>
      assert (is_symplectic (node_method T nodes))
        by (apply (nodes_symplectic_sound T nodes Hnodes); vm_cast_no_check (eq_refl true))
  | _ => idtac
  end;
  repeat match goal with |- _ /\ _ => split end;
  lazymatch goal with
  | H : is_symplectic ?M |- is_symplectic ?M => exact H
  | H : is_symplectic (node_method ?T nodes) |- has_order (node_method ?T nodes) general ?p =>
      apply (symplectic_order_sound _ H (node_code T nodes Hnodes) p); vm_cast_no_check (eq_refl true)
  | |- has_order (node_method ?T nodes) _ _ =>
      apply (all_trees_sound (node_code T nodes Hnodes)); vm_cast_no_check (eq_refl true)
  | |- is_symplectic_for_separable (node_method ?T nodes) =>
      apply (nodes_symplectic_for_separable_sound T nodes Hnodes); vm_cast_no_check (eq_refl true)
  | |- _ -> is_symmetric (node_method ?T nodes) => apply (nodes_symmetric_sound T nodes Hnodes); vm_cast_no_check (eq_refl true)
  end.
