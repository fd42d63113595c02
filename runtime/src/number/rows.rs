//! Long vectors by rows: the lanes run along the components.

use crate::number::{F64x4, F64x8, Lanes, Scalar};

/// Several components side by side.
pub(crate) trait Row<T: Scalar> {
    /// A row in memory.
    type Array;
    /// A row as one number.
    type Numbers: Scalar;

    /// Number of components of a row.
    const WIDTH: usize;

    /// Number of components before the first one at which a row is aligned in memory.
    fn misaligned(vector: &[T]) -> usize;

    /// The rows of a vector, and the components that do not fill a row.
    fn rows(vector: &[T]) -> (&[Self::Array], &[T]);
    /// Mutable [`rows`](Self::rows).
    fn rows_mut(vector: &mut [T]) -> (&mut [Self::Array], &mut [T]);

    /// Loads a row from memory.
    fn load(row: &Self::Array) -> Self::Numbers;
    /// Converts a row for storage in memory.
    fn store(numbers: Self::Numbers) -> Self::Array;
    /// The same number in every component.
    fn splat(number: T) -> Self::Numbers;

    /// The last component.
    fn last(numbers: Self::Numbers) -> T;
    /// The right neighbour of each component, from two successive rows.
    fn right(numbers: Self::Numbers, next: Self::Numbers) -> Self::Numbers;
    /// The left neighbour of each component, from two successive rows.
    fn left(previous: Self::Numbers, numbers: Self::Numbers) -> Self::Numbers;
}

/// Rows of one component.
pub(crate) struct Single;

impl<T: Scalar> Row<T> for Single {
    type Array = [T; 1];
    type Numbers = T;

    const WIDTH: usize = 1;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn misaligned(_vector: &[T]) -> usize {
        0
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rows(vector: &[T]) -> (&[[T; 1]], &[T]) {
        vector.as_chunks()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rows_mut(vector: &mut [T]) -> (&mut [[T; 1]], &mut [T]) {
        vector.as_chunks_mut()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn load(&[number]: &[T; 1]) -> T {
        number
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn store(number: T) -> [T; 1] {
        [number]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn splat(number: T) -> T {
        number
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn last(number: T) -> T {
        number
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn right(_number: T, next: T) -> T {
        next
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn left(previous: T, _number: T) -> T {
        previous
    }
}

macro_rules! row {
    ($(#[$text:meta])* $name:ident, $lanes:ident, $width:literal) => {
        $(#[$text])*
        pub(crate) struct $name;

        impl Row<f64> for $name {
            type Array = [f64; $width];
            type Numbers = $lanes;

            const WIDTH: usize = $width;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn misaligned(vector: &[f64]) -> usize {
                vector.as_ptr().align_offset(align_of::<$lanes>())
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn rows(vector: &[f64]) -> (&[[f64; $width]], &[f64]) {
                vector.as_chunks()
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn rows_mut(vector: &mut [f64]) -> (&mut [[f64; $width]], &mut [f64]) {
                vector.as_chunks_mut()
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn load(row: &[f64; $width]) -> $lanes {
                $lanes::from_array(*row)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn store(numbers: $lanes) -> [f64; $width] {
                numbers.to_array()
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn splat(number: f64) -> $lanes {
                $lanes::from_f64(number)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn last(numbers: $lanes) -> f64 {
                numbers.to_array()[$width - 1]
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn right(numbers: $lanes, next: $lanes) -> $lanes {
                let (numbers, [after, ..]) = (numbers.to_array(), next.to_array());
                $lanes::from_fn(|lane| {
                    if lane + 1 < $width {
                        numbers[lane + 1]
                    } else {
                        after
                    }
                })
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn left(previous: $lanes, numbers: $lanes) -> $lanes {
                let ([.., before], numbers) = (previous.to_array(), numbers.to_array());
                $lanes::from_fn(|lane| if lane > 0 { numbers[lane - 1] } else { before })
            }
        }
    };
}

row! {
    /// Four doubles side by side.
    Four, F64x4, 4
}
row! {
    /// Eight doubles side by side.
    Eight, F64x8, 8
}
