(** * What is claimed of a symplectic partitioned Runge-Kutta method

    The theorems in the files of `symplectic show NAME --format coq` speak of these definitions: read this file to know what is
    proved. The other files prove that the check is sound. They use Coq's standard library, and no axiom.

    Hairer, Lubich & Wanner, Geometric Numerical Integration: III.2 (trees), VI.4, VI.6 and VI.7 (symplecticity), V.2 (symmetry). *)

From Coq Require Import List Permutation QArith Ring.
Import ListNotations.

(** ** 1. Numbers: a commutative ring that contains the rationals, such as the real numbers *)

Record Algebra := {
  carrier :> Type;
  zero : carrier;
  one : carrier;
  plus : carrier -> carrier -> carrier;
  times : carrier -> carrier -> carrier;
  minus : carrier -> carrier -> carrier;
  opposite : carrier -> carrier;
  ring_laws : ring_theory zero one plus times minus opposite (@eq carrier);
  rational : Q -> carrier;
  rational_equal : forall x y, (x == y)%Q -> rational x = rational y;
  rational_one : rational 1%Q = one;
  rational_plus : forall x y, rational (x + y)%Q = plus (rational x) (rational y);
  rational_times : forall x y, rational (x * y)%Q = times (rational x) (rational y)
}.
Arguments zero {_}.
Arguments one {_}.
Arguments plus {_}.
Arguments times {_}.
Arguments minus {_}.
Arguments opposite {_}.
Arguments rational {_}.

Declare Scope algebra_scope.
Delimit Scope algebra_scope with K.
Notation "0" := zero : algebra_scope.
Notation "1" := one : algebra_scope.
Infix "+" := plus : algebra_scope.
Infix "*" := times : algebra_scope.
Infix "-" := minus : algebra_scope.
Notation "- x" := (opposite x) : algebra_scope.

Fixpoint power {K : Algebra} (x : K) (n : nat) : K :=
  match n with O => 1%K | S n => (x * power x n)%K end.

Definition sum {K : Algebra} {I : Type} (f : I -> K) (indices : list I) : K :=
  fold_right (fun i total => f i + total)%K 0%K indices.

(** ** 2. Bicoloured trees *)

(** The colour of a vertex: [position] for dH/dp, the derivative of q, and [momentum] for -dH/dq, that of p. *)
Inductive colour := position | momentum.

Definition other (c : colour) : colour := match c with position => momentum | momentum => position end.

(** A rooted tree is a vertex, or a tree [t] with another tree [u] joined to its root by an edge. *)
Inductive tree :=
| vertex (c : colour)
| join (t u : tree).

Fixpoint root (t : tree) : colour :=
  match t with vertex c => c | join t _ => root t end.

Definition bare (t : tree) : bool :=
  match t with vertex _ => true | join _ _ => false end.

(** The number of vertices. *)
Fixpoint order (t : tree) : nat :=
  match t with vertex _ => 1 | join t u => order t + order u end.

Definition size (t : tree) : Q := inject_Z (Z.of_nat (order t)).

(** The density gamma: the product of the sizes of all subtrees. *)
Fixpoint density_below (t : tree) : Q :=
  match t with vertex _ => 1 | join t u => density_below t * (size u * density_below u) end.
Definition density (t : tree) : Q := size t * density_below t.

(** Classes of Hamiltonians: every H(q, p); T(p) + U(q); the same with quadratic T. *)
Inductive class := general | separable | nystrom.

Definition equal_colours (c d : colour) : bool :=
  match c, d with position, position | momentum, momentum => true | _, _ => false end.

(** Whether a tree with a root [d] may be joined to a root [c]: for separable H neighbours have different colours; for quadratic T
    moreover a vertex for dH/dp has one child at most. *)
Definition may_join (k : class) (c : colour) (is_bare : bool) (d : colour) : bool :=
  match k with
  | general => true
  | separable => negb (equal_colours c d)
  | nystrom => negb (equal_colours c d) && (equal_colours c momentum || is_bare)
  end.

(** The trees of a class: all others vanish for its Hamiltonians. *)
Fixpoint in_class (k : class) (t : tree) : bool :=
  match t with
  | vertex _ => true
  | join t u => in_class k t && in_class k u && may_join k (root t) (bare t) (root u)
  end.

(** ** 3. Methods *)

(** Q_i = q0 + h sum_j a_ij V_j, P_i = p0 + h sum_j a~_ij F_j, q1 = q0 + h sum_i b_i V_i, p1 = p0 + h sum_i b~_i F_i, with
    V_i = dH/dp and F_i = -dH/dq at (Q_i, P_i). The colour tells [a position] = a from [a momentum] = a~, and b from b~. *)
Record Method (K : Algebra) := {
  label : Type;
  stages : list label;
  a : colour -> label -> label -> K;
  b : colour -> label -> K
}.
Arguments label {_}.
Arguments stages {_}.
Arguments a {_}.
Arguments b {_}.

Section Claims.
  Context {K : Algebra} (M : Method K).
  Local Open Scope algebra_scope.

  (** The elementary weight of a tree at a stage, and of the method. *)
  Fixpoint stage_weight (t : tree) (i : label M) : K :=
    match t with
    | vertex _ => 1
    | join t u => stage_weight t i * sum (fun j => a M (root u) i j * stage_weight u j) (stages M)
    end.
  Definition weight (t : tree) : K := sum (fun i => b M (root t) i * stage_weight t i) (stages M).

  (** Order p for a class: all order conditions, sum_i b_i Phi_i(t) = 1/gamma(t). *)
  Definition has_order (k : class) (p : nat) : Prop :=
    forall t, in_class k t = true -> (order t <= p)%nat -> weight t = rational (/ density t)%Q.

  Definition is_symplectic_for_separable : Prop :=
    forall i j, In i (stages M) -> In j (stages M) ->
    b M position i * a M momentum i j + b M momentum j * a M position j i = b M position i * b M momentum j.

  Definition is_symplectic : Prop :=
    is_symplectic_for_separable /\ forall i, In i (stages M) -> b M position i = b M momentum i.

  (** Equal to the adjoint, with the stages in another order. *)
  Definition is_symmetric : Prop :=
    exists s : label M -> label M, Permutation (map s (stages M)) (stages M) /\
    forall c i, In i (stages M) -> b M c (s i) = b M c i /\
    forall j, In j (stages M) -> a M c i j + a M c (s i) (s j) = b M c j.

  (** The same for separable H. There V_i depends only on P_i, and F_i only on Q_i: [used position] has the stages whose V_i is used,
      [used momentum] those whose F_i is, and each of the two lists has an order of its own. *)
  Definition is_symmetric_for_separable : Prop :=
    exists (used unused : colour -> list (label M)) (s : colour -> label M -> label M), forall c,
    Permutation (used c ++ unused c) (stages M) /\ Permutation (map (s c) (used c)) (used c) /\
    (forall i, In i (unused c) -> b M c i = 0 /\ forall j, In j (used (other c)) -> a M c j i = 0) /\
    (forall i, In i (used c) -> b M c (s c i) = b M c i /\
      forall j, In j (used (other c)) -> a M c j i + a M c (s (other c) j) (s c i) = b M c i).
End Claims.

(** ** 4. Tables: what a file has *)

(** A polynomial: coefficients of 1, x, x^2, ... *)
Definition polynomial := list Q.

(** f_0 + f_1 x + f_2 x^2 + ..., for coefficients that are themselves values of something. *)
Definition value_of {A : Type} {K : Algebra} (coefficient : A -> K) (f : list A) (x : K) : K :=
  fold_right (fun c rest => coefficient c + x * rest)%K 0%K f.
Definition value {K : Algebra} (f : polynomial) (x : K) : K := value_of rational f x.

(** Entries are polynomials in a number x with x^d = r_0 + r_1 x + ... + r_(d-1) x^(d-1): [reduction] has the r. *)
Record Table := {
  reduction : polynomial;
  matrix : colour -> list (list polynomial);
  weights : colour -> list polynomial
}.

Definition is_root {K : Algebra} (r : polynomial) (x : K) : Prop := power x (length r) = value r x.

(** Read a file as it is: missing entries count as 0, and what is beyond the weights for [position] does not count. *)
Definition method {K : Algebra} (T : Table) (x : K) : Method K := {|
  label := nat;
  stages := seq 0 (length (weights T position));
  a c i j := value (nth j (nth i (matrix T c) []) []) x;
  b c i := value (nth i (weights T c) []) x
|}.

(** The same if the nodes c_1, ..., c_s are the roots of one polynomial x^s - r_0 - r_1 x - ..., and entries are polynomials in
    them: b_i = b(c_i), and a_ij = sum_k a_k(c_i) c_j^k. [node_reduction] has the r, [columns] the a_k. *)
Record NodeTable := {
  node_reduction : polynomial;
  columns : colour -> list polynomial;
  node_weights : colour -> polynomial
}.

(** sum_k f_k(x) y^k *)
Definition value2 {K : Algebra} (f : list polynomial) (x y : K) : K := value_of (fun column => value column x) f y.

Definition node_method {K : Algebra} (T : NodeTable) (nodes : list K) : Method K := {|
  label := K;
  stages := nodes;
  a c x y := value2 (columns T c) x y;
  b c x := value (node_weights T c) x
|}.

(** f x + g, coefficient by coefficient. *)
Fixpoint times_plus {K : Algebra} (x : K) (f g : list K) : list K :=
  match f, g with
  | [], _ => g
  | c :: f, [] => (x * c)%K :: times_plus x f []
  | c :: f, d :: g => (x * c + d)%K :: times_plus x f g
  end.

(** The coefficients of (X - c_1) ... (X - c_s). *)
Fixpoint product_of_roots {K : Algebra} (nodes : list K) : list K :=
  match nodes with
  | [] => [1%K]
  | c :: nodes => let f := product_of_roots nodes in times_plus (- c)%K f (0%K :: f)
  end.

(** The nodes are the roots of x^s - r_0 - r_1 x - ..., each as often as it is one. *)
Definition are_roots {K : Algebra} (r : polynomial) (nodes : list K) : Prop :=
  product_of_roots nodes = map (fun c => rational (- c)%Q) r ++ [1%K].
