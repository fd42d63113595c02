//! Processed compositions of Störmer–Verlet by printed weights: the exact weights near the digits are certified.

use super::Row;

pub(super) const ROWS: &[Row] = &[
    Row {
        name: "morales-2025-yp8m8",
        title: "17 steps of Störmer–Verlet of conjugate order 8, processed: order 7",
        definition: "base: velocity-verlet, weights: [0.21456475499897766986381219621761, \
                     0.51788649682987924281787142226803, -0.33342207567391682979227850551172, \
                     0.15757644257569146373033662060461, -0.37307499512657736825709230652023, \
                     0.18372413281145589944261642180363, 0.1947017706053903224022456342907, \
                     0.21784176681731006074681969186513, -0.55959658767642092190866235003552], symmetric: true, \
                     processor: back_and_forth(-0.44324901019570126590495430949294, \
                     0.25459857192003772850622377066944, -0.73862036266779261573694538099739, \
                     -0.00024139614958652134370419495289618, 0.73873460354125365739379753874964, \
                     -0.20285971152536085519251666906017, 0.44989521689676869571827637424046, \
                     0.29538398007876871184026747505657, -0.3364996155865700091428329802017, \
                     -0.01714227631181752613761162401), claim: separable(7)",
        stages: &[58],
        source: "Morales et al., Selection and improvement of product formulae for \
                 best performance of quantum simulation, Quantum Inf. Comput. 25 (2025), Table 2 and Appendix B; the last weights \
                 from their sums. The paper says order 8: that is the conjugate order of the kernel. The processor Q(h) Q(-h) is even \
                 in h up to the degree 6 only, since the sum of the cubes of its weights is -1.6e-5, and leaves an error of order 7, \
                 1e-8 times a bracket, which does not grow with time",
    },
    Row {
        name: "processed-8-17",
        title: "the same kernel, with a processor that gives it order 8",
        definition: "base: velocity-verlet, weights: [0.21456475499897766986381219621761, \
                     0.51788649682987924281787142226803, -0.33342207567391682979227850551172, \
                     0.157576442575691463730336620604, -0.37307499512657736825709230652023, \
                     0.18372413281145589944261642180363, 0.1947017706053903224022456342907, \
                     0.21784176681731006074681969186513, -0.55959658767642092190866235003552], symmetric: true, \
                     processor: back_and_forth(-0.44323399073245710068561992839643, \
                     0.25459857192003772850622377066944, -0.73862036266779261573694538099739, \
                     -0.00024139973837514866410898836310241, 0.73873420859207074599455433936868, \
                     -0.20285971152536085519251666906017, 0.44989521689676869571827637424046, \
                     0.29538398007876871184026747505657, -0.33647556343102551028871829138313, \
                     -0.017180949392634651491412701135), claim: separable(8)",
        stages: &[58],
        source: "the solution with the sum of the cubes of the processor's weights zero that is nearest to morales-2025-yp8m8, \
                 by Newton's iteration of the claim separable(8)",
    },
];
