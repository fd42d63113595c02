//! What the package `symplectic-tools` needs of this one, and no other: no part of the interface.

pub use crate::certify::{
    Affine, Best, DRIFT, Enclosed, Equations, KICK, Kind, PROOF_BITS, Proof, Row, Settled, Square,
    Step, System, Target, Unknown, decimal_text, inverse, middle, minimax, pivots, settle,
};
pub use crate::derive::Scheme;
pub use crate::emit::{Known, Relative};
pub use crate::evidence::evidence_text;
pub use crate::exact::Exact;
pub use crate::export::{Fact, first_line, separable_only, written};
pub use crate::expression::shown;
pub use crate::library::Notation;
pub use crate::numerals::{PLACES, Source, Value, computed, value_of, zero};
pub use crate::order::composition::order_within as order_of_composition_within;
pub use crate::order::{Plan, one_of_each_rooting, order_within};
pub use crate::partitioned::{LowerTriangular, Partitioned};
pub use crate::properties::images;
pub use crate::quadrature::check_stages;
pub use crate::suggestion::with_suggestion;
pub use crate::tableau::left_out;
