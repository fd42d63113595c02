(** * Of a symplectic method, trees with small branches are enough

    Where two trees t and u are joined by an edge, the root may be on either side of it:
    phi(t o u) + phi(u o t) = phi(t) phi(u), up to the colour of a root (GNI VI.7.2). So the root may move to the middle of a tree,
    where no branch has more than half of its vertices. *)

From Coq Require Import Arith Bool Lia List QArith Ring.
From SPRK Require Import Definitions Orders.
Import ListNotations.

Fixpoint recoloured (c : colour) (t : tree) : tree :=
  match t with vertex _ => vertex c | join t u => join (recoloured c t) u end.

Lemma recoloured_order c t : order (recoloured c t) = order t.
Proof. induction t as [d | t IHt u _]; simpl; congruence. Qed.

Lemma recoloured_root c t : root (recoloured c t) = c.
Proof. induction t as [d | t IHt u _]; simpl; congruence. Qed.

Lemma recoloured_density c t : density_below (recoloured c t) = density_below t.
Proof. induction t as [d | t IHt u _]; simpl; congruence. Qed.

Section Symplectic.
  Context {K : Algebra} (M : Method K) (HM : is_symplectic M).
  Local Open Scope algebra_scope.
  Add Ring K_ring : (ring_laws K).

  Definition holds (t : tree) : Prop := weight M t = rational (/ density t)%Q.

  Lemma sum_exchange {I J} (f : I -> J -> K) l m :
    sum (fun i => sum (f i) m) l = sum (fun j => sum (fun i => f i j) l) m.
  Proof.
    induction l as [|i l IH]; simpl; [now rewrite sum_zero|]. now rewrite IH, sum_plus.
  Qed.

  Lemma recoloured_stage_weight c t i : stage_weight M (recoloured c t) i = stage_weight M t i.
  Proof. induction t as [d | t IHt u _]; simpl; congruence. Qed.

  Lemma same_weights c d i : In i (stages M) -> b M c i = b M d i.
  Proof. intros Hi. destruct HM as [_ H]. destruct c, d; auto. symmetry; auto. Qed.

  Lemma weight_by c t : weight M t = sum (fun i => b M c i * stage_weight M t i) (stages M).
  Proof. apply sum_equal. intros i Hi. now rewrite (same_weights (root t) c). Qed.

  (** The condition of symplecticity, for an edge to a vertex of either colour. *)
  Lemma edge c i j : In i (stages M) -> In j (stages M) ->
    b M position i * a M c i j + b M position j * a M (other c) j i = b M position i * b M position j.
  Proof.
    intros Hi Hj. destruct HM as [H _]. destruct c; simpl.
    - specialize (H j i Hj Hi). rewrite !(same_weights momentum position) in H by assumption.
      transitivity (b M position j * a M momentum j i + b M position i * a M position i j); [ring | rewrite H; ring].
    - specialize (H i j Hi Hj). rewrite !(same_weights momentum position) in H by assumption. exact H.
  Qed.

  Lemma weights_of_joined t u :
    weight M (join t u) + weight M (join u (recoloured (other (root u)) t)) = weight M t * weight M u.
  Proof.
    rewrite !(weight_by position). simpl stage_weight. rewrite recoloured_root.
    set (f i j := b M position i * a M (root u) i j * (stage_weight M t i * stage_weight M u j)).
    set (g i j := b M position j * a M (other (root u)) j i * (stage_weight M t i * stage_weight M u j)).
    transitivity (sum (fun i => sum (f i) (stages M)) (stages M) + sum (fun i => sum (g i) (stages M)) (stages M)).
    { f_equal; [|rewrite (sum_exchange g)]; apply sum_equal; intros i _; rewrite <- !sum_times; apply sum_equal; intros j _;
        unfold f, g; rewrite ?recoloured_stage_weight; ring. }
    rewrite <- sum_plus.
    transitivity (sum (fun i => (sum (fun j => b M position j * stage_weight M u j) (stages M))
      * (b M position i * stage_weight M t i)) (stages M)); [|rewrite sum_times; ring].
    apply sum_equal; intros i Hi. rewrite <- sum_plus.
    transitivity (sum (fun j => (b M position i * stage_weight M t i) * (b M position j * stage_weight M u j)) (stages M));
      [|rewrite sum_times; ring].
    apply sum_equal; intros j Hj. unfold f, g.
    transitivity ((b M position i * a M (root u) i j + b M position j * a M (other (root u)) j i)
      * (stage_weight M t i * stage_weight M u j)); [ring | rewrite edge by assumption; ring].
  Qed.

  Lemma size_positive t : ~ (size t == 0)%Q.
  Proof. pose proof (order_positive t). unfold size, Qeq; simpl. lia. Qed.

  Lemma moved_root t u : holds t -> holds u -> holds (join u (recoloured (other (root u)) t)) -> holds (join t u).
  Proof.
    unfold holds. intros Ht Hu Hut. pose proof (weights_of_joined t u) as H. rewrite Ht, Hu, Hut in H.
    transitivity (rational (/ density t)%Q * rational (/ density u)%Q
      - rational (/ density (join u (recoloured (other (root u)) t)))%Q : K); [rewrite <- H; ring|].
    rewrite <- rational_times.
    assert (E : (/ density t * / density u == / density (join t u)
      + / density (join u (recoloured (other (root u)) t)))%Q).
    { unfold density. simpl density_below. rewrite recoloured_density.
      assert (S1 : (size (join t u) == size t + size u)%Q)
        by (unfold size; simpl order; rewrite Nat2Z.inj_add, inject_Z_plus; reflexivity).
      assert (S2 : (size (join u (recoloured (other (root u)) t)) == size t + size u)%Q)
        by (unfold size; simpl order; rewrite recoloured_order, Nat2Z.inj_add, inject_Z_plus; ring).
      assert (S3 : size (recoloured (other (root u)) t) = size t) by (unfold size; now rewrite recoloured_order).
      rewrite S1, S2, S3. pose proof (size_positive (join t u)) as P. rewrite S1 in P.
      field. repeat split; auto using size_positive, density_below_positive. }
    rewrite (rational_equal K _ _ E), rational_plus. ring.
  Qed.

  (** The largest branch may come last. *)
  Lemma largest_last t : (1 <= widest t)%nat -> exists v u, order u = widest t /\ order t = (order v + order u)%nat /\
    (widest v <= widest t)%nat /\ root t = root v /\ (density_below t == density_below (join v u))%Q /\
    forall i, stage_weight M t i = stage_weight M (join v u) i.
  Proof.
    induction t as [c | t IHt w _]; simpl widest; intros H; [lia|].
    destruct (Nat.le_gt_cases (widest t) (order w)) as [Hw | Hw].
    - exists t, w. repeat split; simpl; try reflexivity; lia.
    - destruct IHt as (v & u & Hu & Hsum & Hwidest & Hroot & Hdensity & Hweight); [lia|].
      exists (join v w), u. repeat split; simpl; try lia; [assumption | |].
      + rewrite Hdensity; simpl. ring.
      + intros i. rewrite Hweight; simpl. ring.
  Qed.

  Lemma small_branches_suffice n : (forall t, (order t < n)%nat -> holds t) ->
    (forall t, order t = n -> (2 * widest t <= n)%nat -> holds t) -> forall t, order t = n -> holds t.
  Proof.
    intros Hsmaller Hsmall.
    assert (Hall : forall m t, (widest t <= m)%nat -> order t = n -> holds t).
    { induction m as [|m IH]; intros t Hm Ht; [apply Hsmall; lia|].
      destruct (Nat.le_gt_cases (2 * widest t) n) as [H | H]; [now apply Hsmall|].
      destruct (largest_last t) as (v & u & Hu & Hsum & Hwidest & Hroot & Hdensity & Hweight); [lia|].
      pose proof (order_positive v); pose proof (order_positive u); pose proof (widest_bound u).
      assert (Hjoin : holds (join v u)).
      { apply moved_root; [apply Hsmaller; lia | apply Hsmaller; lia |].
        apply IH; simpl; rewrite recoloured_order; lia. }
      unfold holds in *. rewrite (weight_by position) in *.
      rewrite (sum_equal _ (fun i => b M position i * stage_weight M (join v u) i)) by (intros i _; now rewrite Hweight).
      rewrite Hjoin. apply rational_equal. unfold density. rewrite Hdensity.
      replace (size (join v u)) with (size t); [reflexivity|]. unfold size; simpl. now rewrite Hsum. }
    intros t. now apply (Hall (widest t)).
  Qed.

  Theorem symplectic_order_sound (C : Code M) p : check_order C general (p / 2) p = true -> has_order M general p.
  Proof.
    intros Hcheck.
    assert (Hclass : forall t, in_class general t = true).
    { induction t as [c | t IHt u IHu]; simpl; [reflexivity | now rewrite IHt, IHu]. }
    assert (Hall : forall n, (n <= p)%nat -> forall t, (order t <= n)%nat -> holds t).
    { induction n as [|n IH]; intros Hn t Ht; [pose proof (order_positive t); lia|].
      destruct (Nat.eq_dec (order t) (S n)) as [E | NE]; [|apply IH; lia].
      apply (small_branches_suffice (S n)); [intros u Hu; apply IH; lia | | exact E].
      intros u Hu Hwidest. apply (check_order_sound C general (p / 2) p); [assumption | | lia].
      split; [apply Hclass|]. apply Nat.div_le_lower_bound; lia. }
    intros t _ Ht. now apply (Hall p).
  Qed.
End Symplectic.
