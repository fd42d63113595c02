//! Long vectors by rows: the lanes run along the components.

use crate::number::{F64x8, Lanes, Scalar, WideF64x8, WidestF64x8};

/// Several components side by side.
pub(crate) trait Row<T: Scalar> {
    /// A row in memory.
    type Array;
    /// A row as one number.
    type Numbers: Scalar;

    /// Number of components of a row.
    const WIDTH: usize;

    /// The full rows of a vector.
    fn rows(vector: &[T]) -> &[Self::Array];
    /// Mutable [`rows`](Self::rows).
    fn rows_mut(vector: &mut [T]) -> &mut [Self::Array];

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
    fn rows(vector: &[T]) -> &[[T; 1]] {
        vector.as_chunks().0
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rows_mut(vector: &mut [T]) -> &mut [[T; 1]] {
        vector.as_chunks_mut().0
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

macro_rules! rows_of_eight {
    ($name:ident $numbers:ident) => {
        impl Row<f64> for $name {
            type Array = [f64; 8];
            type Numbers = $numbers;

            const WIDTH: usize = 8;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn rows(vector: &[f64]) -> &[[f64; 8]] {
                vector.as_chunks().0
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn rows_mut(vector: &mut [f64]) -> &mut [[f64; 8]] {
                vector.as_chunks_mut().0
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn load(row: &[f64; 8]) -> $numbers {
                $numbers::from_array(*row)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn store(numbers: $numbers) -> [f64; 8] {
                numbers.to_array()
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn splat(number: f64) -> $numbers {
                $numbers::from_f64(number)
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn last(numbers: $numbers) -> f64 {
                numbers.to_array()[7]
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn right(numbers: $numbers, next: $numbers) -> $numbers {
                let (numbers, [after, ..]) = (numbers.to_array(), next.to_array());
                $numbers::from_fn(|lane| if lane < 7 { numbers[lane + 1] } else { after })
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn left(previous: $numbers, numbers: $numbers) -> $numbers {
                let ([.., before], numbers) = (previous.to_array(), numbers.to_array());
                $numbers::from_fn(|lane| if lane > 0 { numbers[lane - 1] } else { before })
            }
        }
    };
}

/// Rows of eight doubles.
pub(crate) struct Eight;

rows_of_eight! { Eight F64x8 }

/// Rows of eight doubles in registers of AVX2.
pub(crate) struct WideEight;

rows_of_eight! { WideEight WideF64x8 }

/// Rows of eight doubles in registers of AVX-512.
pub(crate) struct WidestEight;

rows_of_eight! { WidestEight WidestF64x8 }
