(** * A computation decides all order conditions

    Trees are not enumerated: what is kept of all trees with n vertices is the set of their weights. *)

From Coq Require Import Arith Bool Lia List QArith Ring.
From SPRK Require Import Definitions.
Import ListNotations.

(** ** 1. Sums and rationals *)

Section Sums.
  Context {K : Algebra}.
  Local Open Scope algebra_scope.
  Add Ring K_ring : (ring_laws K).

  Lemma rational_zero : rational 0 = (0 : K).
  Proof.
    assert (H : rational 0 + rational 0 = (rational 0 : K)) by (rewrite <- rational_plus; now apply rational_equal).
    transitivity (rational 0 + rational 0 - (rational 0 : K)); [ring | rewrite H; ring].
  Qed.

  Lemma rational_opposite x : rational (- x)%Q = - (rational x : K).
  Proof.
    assert (H : rational (- x)%Q + rational x = (0 : K)).
    { rewrite <- rational_plus, <- rational_zero. apply rational_equal. ring. }
    transitivity (rational (- x)%Q + rational x - (rational x : K)); [ring | rewrite H; ring].
  Qed.

  Lemma sum_equal {I} (f g : I -> K) l : (forall i, In i l -> f i = g i) -> sum f l = sum g l.
  Proof.
    induction l as [|i l IH]; simpl; intros H; [reflexivity|].
    rewrite (H i), IH by auto; reflexivity.
  Qed.

  Lemma sum_times {I} (x : K) (f : I -> K) l : sum (fun i => x * f i) l = x * sum f l.
  Proof. induction l as [|i l IH]; simpl; [ring | rewrite IH; ring]. Qed.

  Lemma sum_plus {I} (f g : I -> K) l : sum (fun i => f i + g i) l = sum f l + sum g l.
  Proof. induction l as [|i l IH]; simpl; [ring | rewrite IH; ring]. Qed.

  Lemma sum_zero {I} (l : list I) : sum (fun _ => (0 : K)) l = 0.
  Proof. induction l as [|i l IH]; simpl; [ring | rewrite IH; ring]. Qed.

  Lemma sum_map {I J} (g : I -> J) (f : J -> K) l : sum f (map g l) = sum (fun i => f (g i)) l.
  Proof. induction l as [|i l IH]; simpl; [reflexivity | now rewrite IH]. Qed.
End Sums.

(** ** 2. Lists without repetitions *)

(** The search tree forgets what it has already. That nothing else is lost does not depend on how [compare] orders. *)
Inductive search_tree (A : Type) := Leaf | Branch (l : search_tree A) (x : A) (r : search_tree A).
Arguments Leaf {A}.
Arguments Branch {A}.

Section SearchTree.
  Context {A : Type} (compare : A -> A -> comparison) (compare_equal : forall x y, compare x y = Eq -> x = y).

  Fixpoint insert (x : A) (t : search_tree A) : search_tree A :=
    match t with
    | Leaf => Branch Leaf x Leaf
    | Branch l y r =>
        match compare x y with
        | Eq => t
        | Lt => Branch (insert x l) y r
        | Gt => Branch l y (insert x r)
        end
    end.
  Fixpoint elements (t : search_tree A) (rest : list A) : list A :=
    match t with Leaf => rest | Branch l x r => elements l (x :: elements r rest) end.
  Definition distinct (l : list A) : list A := elements (fold_right insert Leaf l) [].

  Fixpoint within (x : A) (t : search_tree A) : Prop :=
    match t with Leaf => False | Branch l y r => x = y \/ within x l \/ within x r end.

  Lemma within_insert x t : within x (insert x t).
  Proof.
    induction t as [|l IHl y r IHr]; simpl; [tauto|].
    destruct (compare x y) eqn:E; simpl; auto.
  Qed.

  Lemma insert_keeps x y t : within y t -> within y (insert x t).
  Proof.
    induction t as [|l IHl z r IHr]; simpl; [tauto|].
    destruct (compare x z); simpl; intuition.
  Qed.

  Lemma elements_complete x t rest : within x t \/ In x rest -> In x (elements t rest).
  Proof.
    revert rest; induction t as [|l IHl y r IHr]; simpl; intros rest; [tauto|].
    intros H; apply IHl; simpl.
    destruct H as [[H | [H | H]] | H]; auto.
  Qed.

  Lemma distinct_complete x l : In x l -> In x (distinct l).
  Proof.
    intros H; apply elements_complete; left; revert H.
    induction l as [|y l IH]; simpl; [tauto|].
    intros [-> | H]; [apply within_insert | now apply insert_keeps, IH].
  Qed.
End SearchTree.

(** ** 3. All trees at once *)

Lemma order_positive t : (1 <= order t)%nat.
Proof. induction t; simpl; lia. Qed.

(** The number of vertices of the largest branch of the root. *)
Fixpoint widest (t : tree) : nat :=
  match t with vertex _ => 0 | join t u => Nat.max (widest t) (order u) end.

Lemma widest_bound t : (widest t < order t)%nat.
Proof. induction t; simpl; lia. Qed.

(** How functions of the stages are computed with. [apply c n f] is n sum_j a_ij f_j; [total c f v] decides sum_i b_i f_i = v. *)
Record Code {K : Algebra} (M : Method K) := {
  F : Type;
  compare : F -> F -> comparison;
  at_stage : F -> label M -> K;
  unit : F;
  product : F -> F -> F;
  apply : colour -> Q -> F -> F;
  total : colour -> F -> Q -> bool;
  compare_equal : forall f g, compare f g = Eq -> f = g;
  at_unit : forall i, In i (stages M) -> at_stage unit i = 1%K;
  at_product : forall f g i, In i (stages M) -> at_stage (product f g) i = (at_stage f i * at_stage g i)%K;
  at_apply : forall c n f i, In i (stages M) ->
    at_stage (apply c n f) i = (rational n * sum (fun j => a M c i j * at_stage f j) (stages M))%K;
  total_sound : forall c f v, total c f v = true ->
    sum (fun i => b M c i * at_stage f i)%K (stages M) = rational v
}.

Lemma in_firstn {A} (l : list A) d i h : (i < h)%nat -> (i < length l)%nat -> In (nth i l d) (firstn h l).
Proof.
  revert i h; induction l as [|x l IH]; intros [|i] [|h]; simpl; try lia; [auto|].
  intros Hi Hl. right. apply IH; lia.
Qed.

Section Orders.
  (** Only trees whose root has branches of at most [most] vertices are looked at. *)
  Context {K : Algebra} {M : Method K} (C : Code M) (k : class) (most : nat).
  Add Ring K_ring : (ring_laws K).

  (** What is kept of a tree: the colour of its root, whether it is bare, and its weights at the stages times its density over its
      size. Then the order condition is a sum equal to 1/n, and trees that agree in these are one case: most trees, of a method
      that satisfies simplifying assumptions. *)
  Definition entry := (colour * bool * F M C)%type.

  Fixpoint encoded (t : tree) : F M C :=
    match t with
    | vertex _ => unit M C
    | join t u => product M C (encoded t) (apply M C (root u) (size u) (encoded u))
    end.
  Definition entry_of (t : tree) : entry := (root t, bare t, encoded t).

  Lemma encoded_value t i : In i (stages M) ->
    at_stage M C (encoded t) i = (rational (density_below t) * stage_weight M t i)%K.
  Proof.
    revert i; induction t as [c | t IHt u IHu]; intros i Hi; simpl.
    - rewrite at_unit, rational_one by assumption. ring.
    - rewrite at_product, at_apply, IHt by assumption.
      rewrite (sum_equal _ (fun j => rational (density_below u) * (a M (root u) i j * stage_weight M u j))%K)
        by (intros j Hj; rewrite IHu by assumption; ring).
      rewrite sum_times, !rational_times. ring.
  Qed.

  Definition compare_entries (x y : entry) : comparison :=
    let '(c, s, f) := x in
    let '(d, t, g) := y in
    match c, d with
    | position, momentum => Lt
    | momentum, position => Gt
    | _, _ => match s, t with true, false => Lt | false, true => Gt | _, _ => compare M C f g end
    end.

  Lemma compare_entries_equal x y : compare_entries x y = Eq -> x = y.
  Proof.
    destruct x as [[[|] [|]] f], y as [[[|] [|]] g]; simpl; intros H; try discriminate;
      f_equal; now apply (compare_equal M C).
  Qed.

  (** An entry with what it gives to a tree that it is joined to. *)
  Definition with_branch (n : nat) (x : entry) : entry * F M C :=
    let '(c, _, f) := x in (x, if (n <=? most)%nat then apply M C c (inject_Z (Z.of_nat n)) f else f).

  Definition joined (x y : entry * F M C) : list entry :=
    let '((c, s, f), _) := x in
    let '((d, _, _), g) := y in
    if may_join k c s d then [(c, false, product M C f g)] else [].

  (** The trees of n + 1 vertices, from those of n, n - 1, ..., 1. *)
  Definition next (levels : list (list (entry * F M C))) : list entry :=
    flat_map (fun '(ts, us) => flat_map (fun t => flat_map (joined t) us) ts) (firstn most (combine levels (rev levels))).

  Definition fits (n : nat) (x : entry) : bool :=
    let '(c, _, f) := x in total M C c f (/ inject_Z (Z.of_nat n)).

  Fixpoint check_from (steps n : nat) (entries : list entry) (levels : list (list (entry * F M C))) : bool :=
    match steps with
    | O => true
    | S steps =>
        if forallb (fits n) entries then
          match steps with
          | O => true
          | _ =>
              let levels := map (with_branch n) (distinct compare_entries entries) :: levels in
              check_from steps (S n) (next levels) levels
          end
        else false
    end.

  Definition check_order (p : nat) : bool :=
    check_from p 1 [(position, true, unit M C); (momentum, true, unit M C)] [].

  Definition is_seen (t : tree) : Prop := in_class k t = true /\ (widest t <= most)%nat.

  Definition complete (n : nat) (levels : list (list (entry * F M C))) : Prop :=
    length levels = n /\ forall t, is_seen t -> (order t <= n)%nat ->
    In (with_branch (order t) (entry_of t)) (nth (n - order t) levels []).

  Lemma next_complete n levels t : (1 <= n)%nat -> complete n levels -> is_seen t -> order t = S n ->
    In (entry_of t) (next levels).
  Proof.
    intros Hn [Hlength H] Ht Horder.
    destruct t as [c | t u]; simpl in Horder; [lia|].
    destruct Ht as [Ht Hwidest]; simpl in Ht, Hwidest; apply andb_prop in Ht; destruct Ht as [Ht Hjoin].
    apply andb_prop in Ht; destruct Ht as [Ht Hu].
    pose proof (order_positive t); pose proof (order_positive u); pose proof (widest_bound u).
    apply in_flat_map.
    exists (nth (order u - 1) (combine levels (rev levels)) ([], [])); split.
    - apply in_firstn; [lia | rewrite combine_length, rev_length; lia].
    - rewrite combine_nth by now rewrite rev_length.
      rewrite rev_nth by lia.
      apply in_flat_map; exists (with_branch (order t) (entry_of t)); split.
      { replace (order u - 1)%nat with (n - order t)%nat by lia.
        apply H; [split; [assumption | lia] | lia]. }
      apply in_flat_map; exists (with_branch (order u) (entry_of u)); split.
      { replace (length levels - S (order u - 1))%nat with (n - order u)%nat by lia.
        apply H; [split; [assumption | lia] | lia]. }
      unfold joined, with_branch, entry_of. replace (order u <=? most)%nat with true by (symmetry; apply Nat.leb_le; lia).
      rewrite Hjoin. now left.
  Qed.

  Lemma check_from_sound steps n entries levels :
    complete n levels -> (forall t, is_seen t -> order t = S n -> In (entry_of t) entries) ->
    check_from steps (S n) entries levels = true ->
    forall t, is_seen t -> (n < order t <= n + steps)%nat -> fits (order t) (entry_of t) = true.
  Proof.
    revert n entries levels; induction steps as [|steps IH]; intros n entries levels Hlevels Hentries Hcheck t Ht Horder;
      simpl in Hcheck; [lia|].
    destruct (forallb (fits (S n)) entries) eqn:Hfits; [|discriminate].
    rewrite forallb_forall in Hfits.
    destruct (Nat.eq_dec (order t) (S n)) as [E | NE].
    { rewrite E. apply Hfits, Hentries; assumption. }
    destruct steps as [|steps]; [lia|].
    revert Hcheck; set (new := map _ _ :: levels); intros Hcheck.
    assert (Hnew : complete (S n) new).
    { destruct Hlevels as [Hlength H]; split; [simpl; congruence|].
      intros u Hu Hu'. destruct (Nat.eq_dec (order u) (S n)) as [E | NE'].
      - rewrite E, Nat.sub_diag. unfold new; cbn [nth]. apply in_map, distinct_complete; [apply compare_entries_equal|].
        now apply Hentries.
      - replace (S n - order u)%nat with (S (n - order u)) by lia. unfold new; cbn [nth].
        apply H; [assumption | lia]. }
    apply (IH (S n) (next new) new); try assumption; [|lia].
    intros u Hu Hu'. apply (next_complete (S n)); [lia | assumption..].
  Qed.

  Lemma density_below_positive t : ~ (density_below t == 0)%Q.
  Proof.
    assert (Hsize : forall u, ~ (size u == 0)%Q).
    { intros u. pose proof (order_positive u). unfold size, Qeq; simpl. lia. }
    induction t as [c | t IHt u IHu]; simpl; [discriminate|].
    intros H. destruct (Qmult_integral _ _ H) as [H' | H']; [tauto|].
    destruct (Qmult_integral _ _ H') as [H'' | H'']; [now apply (Hsize u) | tauto].
  Qed.

  Theorem check_order_sound p t : check_order p = true -> is_seen t -> (order t <= p)%nat ->
    weight M t = rational (/ density t).
  Proof.
    intros Hcheck Ht Hp.
    assert (Hfits : fits (order t) (entry_of t) = true).
    { apply (check_from_sound p 0 _ [] ) with (3 := Hcheck); try assumption.
      - split; [reflexivity|]. intros u _ Hu. pose proof (order_positive u). lia.
      - intros u _ Hu. destruct u as [[|] | u v]; simpl; auto.
        simpl in Hu. pose proof (order_positive u); pose proof (order_positive v). lia.
      - pose proof (order_positive t). lia. }
    apply total_sound in Hfits. unfold weight.
    rewrite (sum_equal _ (fun i => rational (density_below t) * (b M (root t) i * stage_weight M t i))%K) in Hfits
      by (intros i Hi; rewrite encoded_value by assumption; ring).
    rewrite sum_times in Hfits. pose proof (density_below_positive t) as Hd.
    set (w := sum _ _) in *.
    transitivity (rational (/ density_below t) * (rational (density_below t) * w))%K.
    - transitivity (rational 1 * w)%K; [rewrite rational_one; ring|].
      rewrite (rational_equal K 1 (/ density_below t * density_below t)%Q) by (field; assumption).
      rewrite rational_times. ring.
    - rewrite Hfits, <- rational_times. apply rational_equal.
      unfold density. rewrite Qinv_mult_distr. apply Qmult_comm.
  Qed.
End Orders.

Theorem all_trees_sound {K} {M : Method K} (C : Code M) k p : check_order C k p p = true -> has_order M k p.
Proof.
  intros H t Ht Hp. apply (check_order_sound C k p p); [assumption | | assumption].
  split; [assumption|]. pose proof (widest_bound t). lia.
Qed.

(** The smaller the class, the fewer conditions. *)
Theorem order_of_smaller_class {K} (M : Method K) p :
  (has_order M general p -> has_order M separable p) /\ (has_order M separable p -> has_order M nystrom p).
Proof.
  split; intros H t Ht; apply H; clear H; induction t as [c | t IHt u IHu]; simpl in *; try reflexivity;
    apply andb_prop in Ht; destruct Ht as [Ht Hjoin]; apply andb_prop in Ht; destruct Ht as [Ht Hu];
    rewrite IHt, IHu by assumption; [reflexivity|].
  unfold may_join in *. apply andb_prop in Hjoin. now destruct Hjoin as [-> _].
Qed.
