//! Methods that `symplectic search` found. The source is the command that finds them again.

use super::Row;

pub(super) const ROWS: &[Row] = &[
    Row {
        name: "symplectic-2026-s7",
        title: "7 kicks a step, order 4, least error in long runs",
        definition: "kick: [0.070221973283211520782511265131072992, 0.1884, -0.087621973283211520782511265131072992, 0.3290], \
                     drift: [0.17698617790199167707981955397946916, 0.2576, -0.055736177901991677079819553979469157, 0.2423], \
                     symmetric: true, claim: separable(4)",
        stages: &[8],
        source: "symplectic search --order 4 --kicks 7 --structure bab --minimise long-runs --largest 0.6 --starts 2000",
    },
    Row {
        name: "symplectic-2026-srkn14",
        title: "14 kicks a step, order 6 for quadratic T, least error in long runs",
        definition: "kick: [0.028187833197556611509793050666838056, -0.21630, 0.35475, 0.00049108613510508964507209258968085395, \
                     0.13664789496732215055721412972891942, -0.33070, 0.45023818570001614828792072701456167, 0.15337], \
                     drift: [0.10258, -0.0039123131528276361730951149482851190, 0.36703, -0.22697730383847770811625957127602582, \
                     0.13347, -0.0031088526125935280387477512827525215, 0.13091846960389887232810243750706346], \
                     symmetric: true, claim: nystrom(6)",
        stages: &[15],
        source: "symplectic search --class nystrom --order 6 --kicks 14 --structure bab --minimise long-runs --largest 0.45 \
                 --starts 3712",
    },
    Row {
        name: "symplectic-2026-s19odr8",
        title: "19 steps of Störmer–Verlet, order 8, least error in long runs",
        definition: "base: velocity-verlet, weights: [0.096303574365049492723373904235409687, 0.165, \
                     -0.25628514740844573013094154237477269, 0.21516421230649451708900426082957710, \
                     0.14096742837611477013087938405475266, 0.46166426292177306366650110070156261, \
                     -0.35289388418951133815551587090233907, 0.12356919413721873932284020639282556, 0.155, \
                     -0.49697928101738702929228288587403171], symmetric: true, claim: separable(8)",
        stages: &[20],
        source: "symplectic search --order 8 --kicks 19 --structure composition --minimise long-runs --starts 36032",
    },
    Row {
        name: "symplectic-2026-p17odr8",
        title: "17 steps of Störmer–Verlet, processed: order 8, least error in long runs",
        definition: "base: velocity-verlet, weights: [0.18943536333340006232991027211118853, \
                     0.54013150574624611274878408139201345, -0.3582, 0.15285328181988271444065409853216805, \
                     -0.39317016027759632107087403465217862, 0.1711, 0.29324003500146213447323352111182688, 0.1960, \
                     -0.58278005124678940584341587699003659], symmetric: true, \
                     processor: back_and_forth(-0.58366027669917091124504866244019737, \
                     -0.079560065535596905663259663826701946, 0.0488, 0.028721412883281787177807103166488653, 0.5772, -0.5157, \
                     0.52419892935148602973050122310041066), claim: separable(8)",
        stages: &[46],
        source: "symplectic search --structure processed --order 8 --kicks 17 --processor 7 --minimise long-runs --starts 26432 \
                 --keep 2, the second one",
    },
];
