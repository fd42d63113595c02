//! Vectors have the bits of single doubles, in all registers that this processor has.

use core::marker::PhantomData;

use super::{Avx2, Avx512, Work};
use crate::number::{Lanes, Scalar, WideF64x4, WideF64x8, WidestF64x8};

struct Comparison<L>(PhantomData<L>);

impl<L: Lanes> Work for Comparison<L> {
    type Output = ();

    fn run(self) {
        compare::<L>();
    }
}

#[test]
fn vectors_have_the_bits_of_doubles() {
    if let Some(avx2) = Avx2::detect() {
        avx2.run(Comparison::<WideF64x4>(PhantomData));
        avx2.run(Comparison::<WideF64x8>(PhantomData));
    }
    if let Some(avx512) = Avx512::detect() {
        avx512.run(Comparison::<WidestF64x8>(PhantomData));
    }
}

/// Doubles of all sizes, also at the limits beyond which `libm` is called, and next to these limits.
fn arguments() -> impl Iterator<Item = f64> + Clone {
    let special = [
        0.0,
        5e-324,
        1e-310,
        f64::MIN_POSITIVE,
        1.0,
        708.0,
        709.79,
        745.2,
        8e5,
        1e22,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
    ];
    let beside = |x: f64| [x, x.next_up(), x.next_down(), -x];
    let small = (0..400).map(|k| 0.037 * f64::from(k) - 7.0);
    special.into_iter().flat_map(beside).chain(small)
}

/// The functions that lanes compute all at once.
fn functions<T: Scalar>(x: T, y: T) -> [T; 15] {
    let (sine, cosine) = x.sin_cos();
    let [(first, _), (second, _)] = T::sin_cos_all([x, y]);
    [
        x + y,
        x - y,
        x * y,
        x / y,
        -x,
        x.abs(),
        x.sqrt(),
        x.recip(),
        x.exp(),
        x.ln(),
        x.powi(3),
        sine,
        cosine,
        first,
        second,
    ]
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

fn compare<L: Lanes>() {
    // Neighbours in the list, and numbers of very different size side by side.
    for (apart, shift) in [(1, 0), (97, 5)] {
        let list = arguments().cycle();
        for first in 0..arguments().count() {
            let number = |lane: usize| list.clone().nth(first + apart * lane).unwrap_or(0.0);
            let other = |lane: usize| {
                list.clone()
                    .nth(first + apart * lane + shift)
                    .unwrap_or(1.0)
            };
            let (x, y) = (L::from_fn(number), L::from_fn(other));
            let found = functions(x, y);
            let (mut above, mut below, mut nan) = (false, true, false);
            for lane in 0..L::WIDTH {
                let (x, y) = (number(lane), other(lane));
                for (k, (found, expected)) in found.iter().zip(functions(x, y)).enumerate() {
                    let found = found.to_array().as_ref()[lane];
                    assert!(
                        same(found, expected),
                        "function {k} of {x:e} and {y:e}: {found:e}"
                    );
                }
                (above, below, nan) = (above | (x > 1.0), below & (x < 1.0), nan | x.is_nan());
                assert!(same(found[0].broadcast(lane).to_array().as_ref()[0], x + y));
            }
            assert_eq!(
                (x.any_above(1.0), x.all_below(1.0), x.any_nan()),
                (above, below, nan)
            );
            let chosen = x.if_below(y, -x, y);
            for lane in 0..L::WIDTH {
                let (x, y) = (number(lane), other(lane));
                let expected = if x < y { -x } else { y };
                assert!(
                    same(chosen.to_array().as_ref()[lane], expected),
                    "{x:e} {y:e}"
                );
            }
        }
    }
}
