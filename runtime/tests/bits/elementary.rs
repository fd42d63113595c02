//! Elementary functions of doubles and of lanes.

use symplectic::Scalar;
use symplectic::simd::{F64x2, F64x4, F64x8, F64x16, Lanes};

/// What is made of sums and products, for one scalar.
fn functions<T: Scalar>(x: T) -> [T; 7] {
    let (sine, cosine) = x.sin_cos();
    [
        x.sin(),
        x.cos(),
        x.exp(),
        x.ln(),
        sine,
        cosine,
        x.abs().ln(),
    ]
}

/// Doubles of all sizes: dense around small ones, at the limits of what is left to `libm`, and next to them.
fn arguments() -> Vec<f64> {
    let mut all = vec![
        0.0,
        f64::MIN_POSITIVE,
        5e-324,
        1e-310,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
    ];
    for limit in [1.0_f64, 708.0, 709.79, 745.2, 8e5, 1e22] {
        all.extend([limit, limit.next_up(), limit.next_down()]);
    }
    let (mut far, mut near) = (1e-300, 0.0);
    while far < 1e300 {
        all.push(far);
        far *= 7.3;
    }
    while near < 40.0 {
        all.push(near);
        near += 0.037;
    }
    for n in 1..200 {
        all.push(f64::from(n) * std::f64::consts::FRAC_PI_2);
    }
    all.extend(all.clone().iter().map(|x| -x));
    all
}

/// The same bits, or NaN both.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

#[test]
fn lanes_have_the_bits_of_doubles() {
    fn check<L: Lanes>() {
        let all = arguments();
        // Neighbours in the list, and numbers of very different size side by side.
        for apart in [1, 97] {
            for from in 0..all.len() {
                let of = |lane: usize| all[(from + apart * lane) % all.len()];
                let found = functions(L::from_fn(of)).map(|lanes| lanes.to_array());
                for lane in 0..L::WIDTH {
                    let expected = functions(of(lane));
                    for (function, (lanes, one)) in found.iter().zip(expected).enumerate() {
                        let found = lanes.as_ref()[lane];
                        assert!(
                            same(found, one),
                            "{function} of {}: {found} {one}",
                            of(lane)
                        );
                    }
                }
            }
        }
    }
    check::<F64x2>();
    check::<F64x4>();
    check::<F64x8>();
    check::<F64x16>();
}

#[test]
fn symmetries_are_exact() {
    for x in arguments() {
        let ([sine, cosine, ..], [of_minus, same_cosine, ..]) = (functions(x), functions(-x));
        assert!(same(-sine, of_minus) && same(cosine, same_cosine), "{x}");
        let (s, c) = Scalar::sin_cos(x);
        assert!(same(s, sine) && same(c, cosine), "{x}");
    }
}

#[test]
fn several_angles_at_once_have_the_bits_of_each() {
    let all = arguments();
    fn check<L: Lanes>(of: impl Fn(usize) -> f64) {
        let angles = [0, 1, 2].map(|first| L::from_fn(|lane| of(first + lane)));
        for (first, (sine, cosine)) in L::sin_cos_all(angles).into_iter().enumerate() {
            let (sine, cosine) = (sine.to_array(), cosine.to_array());
            for lane in 0..L::WIDTH {
                let (s, c) = Scalar::sin_cos(of(first + lane));
                let found = (sine.as_ref()[lane], cosine.as_ref()[lane]);
                assert!(same(s, found.0) && same(c, found.1), "{}", of(first + lane));
            }
        }
    }
    for apart in [1, 97] {
        for from in 0..all.len() {
            let of = |k: usize| all[(from + apart * k) % all.len()];
            check::<F64x2>(of);
            check::<F64x4>(of);
            check::<F64x8>(of);
            check::<F64x16>(of);
            let one_by_one = [of(0), of(1), of(2)];
            for (x, (sine, cosine)) in one_by_one.into_iter().zip(Scalar::sin_cos_all(one_by_one)) {
                let (s, c) = Scalar::sin_cos(x);
                assert!(same(s, sine) && same(c, cosine), "{x}");
            }
            let singles = one_by_one.map(|x| x as f32);
            for (x, found) in singles.into_iter().zip(Scalar::sin_cos_all(singles)) {
                assert!(
                    x.is_nan() || x.is_infinite() || found == Scalar::sin_cos(x),
                    "{x}"
                );
            }
        }
    }
}

#[test]
fn elementary_functions_follow_the_standard_at_special_values() {
    let (nan, infinity) = (f64::NAN, f64::INFINITY);
    for (found, expected) in [
        (Scalar::sin(0.0), 0.0),
        (Scalar::sin(-0.0), -0.0),
        (Scalar::sin(5e-324), 5e-324),
        (Scalar::sin(infinity), nan),
        (Scalar::sin(nan), nan),
        (Scalar::cos(0.0), 1.0),
        (Scalar::cos(-infinity), nan),
        (Scalar::exp(0.0), 1.0),
        (Scalar::exp(-0.0), 1.0),
        (Scalar::exp(infinity), infinity),
        (Scalar::exp(-infinity), 0.0),
        (Scalar::exp(710.0), infinity),
        (Scalar::exp(-746.0), 0.0),
        (Scalar::exp(nan), nan),
        (Scalar::ln(1.0), 0.0),
        (Scalar::ln(0.0), -infinity),
        (Scalar::ln(-0.0), -infinity),
        (Scalar::ln(-1.0), nan),
        (Scalar::ln(infinity), infinity),
        (Scalar::ln(nan), nan),
    ] {
        assert!(same(found, expected), "{found} {expected}");
    }
    // Results that are subnormal.
    assert!(Scalar::exp(-740.0_f64) > 0.0 && Scalar::exp(-740.0_f64) < f64::MIN_POSITIVE);
}

/// The bits of many values, mixed: they are the same in every build on every platform, with and without the feature `fma` each. Of the
/// far ones among them too, which are left to `libm`.
#[test]
fn bits_are_the_same_in_every_build() {
    let mut mixed = 0_u64;
    let near = (0..20_000).map(|step| f64::from(step - 10_000) * 0.0123);
    let far = (0..600).map(|step| f64::from(step - 300) * 1e6 + 0.5);
    let beside = (0..100).map(|step| 700.0 + f64::from(step) * 0.5);
    for x in near.chain(far).chain(beside) {
        for value in [
            Scalar::sin(x),
            Scalar::cos(x),
            Scalar::exp(x),
            Scalar::ln(x.abs() + 0.001),
        ] {
            mixed = mixed.rotate_left(7).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ value.to_bits();
        }
    }
    let expected = if cfg!(feature = "fma") {
        0x423D_5BC6_FE48_87AA
    } else {
        0xEFE9_699B_68FF_FF1C
    };
    assert_eq!(mixed, expected, "{mixed:#x}");
}
