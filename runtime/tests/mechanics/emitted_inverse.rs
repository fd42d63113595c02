//! The matrices X⁻¹ of constrained tableaux as the macro emits them.

use symplectic::Method;

use crate::systems::{ClenshawCurtis5, Lobatto5};

fn assert_rounded<M: Method>(_: M, decimals: [[&str; 4]; 4]) {
    let found = M::CONSTRAINED[0].tableau.multipliers;
    assert_eq!(found.len(), 4, "{}", M::NAME);
    for (found, decimals) in found.iter().zip(decimals) {
        // Reading a decimal rounds it correctly.
        let rounded: [f64; 4] = decimals.map(|decimal| decimal.parse().expect("a number"));
        assert_eq!(**found, rounded, "{}", M::NAME);
    }
}

/// Every entry is the nearest double, for X = (A Ã)_ik with i = 2..5 and k = 1..4.
///
/// The decimals are from 70-digit decimal arithmetic: A from the integrals of the Lagrange polynomials of the nodes, Ã from
/// `b_i ã_ij + b_j a_ji = b_i b_j`, and X⁻¹ by Gauss–Jordan elimination.
#[test]
fn multiplier_matrices_are_correctly_rounded() {
    let decimals = [
        [
            "156.515403017612053440938104164224",
            "-21.3333333333333333333333333333",
            "6.81793031572127989239522916910919",
            "-2",
        ],
        [
            "-46.6666666666666666666666666666",
            "21.3333333333333333333333333333",
            "-4.66666666666666666666666666666",
            "1.25227291513247998023585841881595",
        ],
        [
            "16.3333333333333333333333333333",
            "-26.6666666666666666666666666666",
            "16.3333333333333333333333333333",
            "-3",
        ],
        [
            "-4.66666666666666666666666666666",
            "21.3333333333333333333333333333",
            "-46.6666666666666666666666666666",
            "28.7477270848675200197641415811840",
        ],
    ];
    assert_rounded(Lobatto5, decimals);
    let decimals = [
        [
            "209.137084989847603904135097936775",
            "16",
            "-17.137084989847603904135097936775",
            "6",
        ],
        ["-36", "8", "4", "-2.1421356237309504880168872420969"],
        [
            "5.33333333333333333333333333333",
            "-13.3333333333333333333333333333",
            "5.33333333333333333333333333333",
            "1.33333333333333333333333333333",
        ],
        ["4", "8", "-36", "26.1421356237309504880168872420969"],
    ];
    assert_rounded(ClenshawCurtis5, decimals);
}
