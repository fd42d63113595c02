#![allow(missing_docs, clippy::print_stdout)]
use std::time::Instant;
use symplectic_contest::pairs;
fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    for pair in pairs() {
        let label = pair.label();
        if !wanted.is_empty() && !wanted.iter().any(|part| label.contains(part)) {
            continue;
        }
        let mut best = f64::INFINITY;
        let mut bits = 0u64;
        for _ in 0..9 {
            let t = Instant::now();
            let state = (pair.library)(256.min(pair.steps)).expect("runs");
            best = best.min(t.elapsed().as_secs_f64());
            bits = state.iter().fold(0u64, |h, x| {
                (h ^ x.to_bits())
                    .wrapping_mul(0x100000001b3)
                    .rotate_left(17)
            });
        }
        println!("{label}\t{:.3}\t{bits:016x}", best * 1e6);
    }
}
