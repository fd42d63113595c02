//! Points in lanes.

use alloc::vec::Vec;

use symplectic_core::inside::array;
use symplectic_core::simd::Lanes;

/// The components of points in lanes; lanes without a point repeat the last point.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn gather<L: Lanes, const N: usize>(points: &[[f64; N]]) -> [L; N] {
    array(L::zero(), |axis| match points.get(..L::WIDTH) {
        Some(points) => L::from_fn(|lane| points[lane][axis]),
        None => L::from_fn(|lane| points[lane.min(points.len() - 1)][axis]),
    })
}

/// Writes components in lanes into points; lanes without a point are dropped.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn scatter<L: Lanes, const N: usize>(lanes: [L; N], points: &mut [[f64; N]]) {
    let lanes = lanes.map(L::to_array);
    let of = |lane: usize| array(0.0, |axis| lanes[axis].as_ref()[lane]);
    match points.get_mut(..L::WIDTH) {
        Some(points) => (0..L::WIDTH).for_each(|lane| points[lane] = of(lane)),
        None => (0..points.len()).for_each(|lane| points[lane] = of(lane)),
    }
}

/// Points stored by axis.
pub(super) type Axes = [Vec<f64>; 3];

/// The points from index `first` on, in lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn load<L: Lanes>(axes: &Axes, first: usize) -> [L; 3] {
    array(L::zero(), |axis| load_one(&axes[axis], first))
}

/// Numbers in lanes.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn load_one<L: Lanes>(list: &[f64], first: usize) -> L {
    let list = &list[first..first + L::WIDTH];
    L::from_fn(|lane| list[lane])
}

/// Writes points in lanes, from index `first` on.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn store<L: Lanes>(axes: &mut Axes, first: usize, points: [L; 3]) {
    for axis in 0..3 {
        let list = &mut axes[axis][first..first + L::WIDTH];
        list.copy_from_slice(points[axis].to_array().as_ref());
    }
}
