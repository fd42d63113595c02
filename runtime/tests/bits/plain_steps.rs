//! Recorded bits of steps without forces and constraints.
//!
//! The types of method and system decide what is compiled, so systems with forces, friction and constraints leave these steps as they are.
//! The arithmetic is that of IEEE 754 and the elementary functions are those of the library, so every machine gives these bits: x86-64 and
//! aarch64, with and without vector instructions. A change of a hash is a change of the results of every user; it belongs in the change log.

use symplectic::nalgebra::Vector2;
use symplectic::{Integrator, Method, ProvedFor, Separable, State, Summation, System};

use crate::common::methods::{Gauss4, Lobatto3, StoermerVerlet};

symplectic::tableau! { BlanesMoanS10 { base: blanes-moan-2002-s10 } }

symplectic::hamiltonian! {
    /// Two coupled oscillators, with a root and a cosine.
    Coupled
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + sqrt(1 + x^2 + y^2) - cos(x - y)/2
}

/// The hash of the bits of all states of a run (FNV-1a over 64-bit words).
fn hash<M, S, R>(integrator: Result<Integrator<M, S, Vector2<f64>, R>, symplectic::Error>) -> u64
where
    M: Method,
    S: System<Vector2<f64>>,
    R: Summation,
    symplectic::solver::Automatic: symplectic::solver::Solver<Vector2<f64>, S>,
{
    let mut run = integrator.expect("a run");
    (0..200).fold(0xcbf2_9ce4_8422_2325, |hash, _| {
        let state = run.step().expect("a step");
        let numbers = state.q.iter().chain(&state.p);
        numbers.fold(hash, |hash, number| {
            (hash ^ number.to_bits()).wrapping_mul(0x0100_0000_01b3)
        })
    })
}

/// The hashes with compensated and with plain sums.
fn hashes<M: Method + Copy + ProvedFor<Separable>>(method: M) -> [u64; 2] {
    let start = || State::from_arrays(0.0, [0.7, -0.2], [0.3, 0.9]);
    [
        hash(Integrator::new(method, Coupled, start(), 0.125)),
        hash(Integrator::plain(method, Coupled, start(), 0.125)),
    ]
}

#[test]
fn plain_steps_keep_their_bits() {
    let found = [
        hashes(Gauss4),
        hashes(Lobatto3),
        hashes(StoermerVerlet),
        hashes(BlanesMoanS10),
    ];
    // With the feature `fma` products are added before they are rounded.
    let recorded = if cfg!(feature = "fma") {
        [
            [0x8976_6151_121d_676e, 0x45ea_7e55_b1cc_d01b],
            [0x6e3d_d9b0_3802_47ab, 0xfc88_0fad_eb5c_3fb0],
            [0xdefd_0095_d3db_0a0f, 0x7159_1f81_9bbc_1366],
            [0xbe56_fff2_786a_5bfe, 0x8152_949d_b970_de06],
        ]
    } else {
        [
            [0x9ed9_ab16_10c5_edf5, 0x6074_8ffb_41fd_a92a],
            [0x6e3d_d9b0_3802_47ab, 0xfc88_0fad_eb5c_3fb0],
            [0xdefc_ff95_d3db_085c, 0x7159_1f81_9bbc_1366],
            [0x9451_21ca_a143_63b1, 0x9844_eb05_988a_8b40],
        ]
    };
    assert_eq!(found, recorded, "{found:x?}");
}
