//! Numbers and names as tokens.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

pub(super) use symplectic_exact::code::{double, identifier, single};

use super::symplectic_rounding::Rounded;
use crate::algebra::Number;

/// A coefficient as the runtime takes it: rounded to a double, the remainder, and rounded to a single.
pub(super) fn coefficient(number: &Number<'_>) -> TokenStream {
    rounded(Rounded::of(number))
}

/// [`coefficient`] for a number that has been rounded already.
pub(super) fn rounded(number: Rounded) -> TokenStream {
    let high = double(number.double);
    if number.single.to_bits() != (number.double as f32).to_bits() {
        let (low, single) = (double(number.low), single(number.single));
        return quote!(emitted::Coefficient::new(#high, #low, #single));
    }
    if number.low == 0.0 {
        return quote!(emitted::exact(#high));
    }
    let low = double(number.low);
    quote!(emitted::rounded(#high, #low))
}

/// A count as a literal without a suffix.
pub(super) fn count(value: usize) -> Literal {
    Literal::usize_unsuffixed(value)
}

/// An array of doubles.
pub(super) fn array(values: &[f64]) -> TokenStream {
    let values = values.iter().map(|&value| double(value));
    quote!([#(#values),*])
}

/// An array of coefficients.
pub(super) fn coefficients(numbers: &[Number<'_>]) -> TokenStream {
    let numbers = numbers.iter().map(coefficient);
    quote!([#(#numbers),*])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use crate::arithmetic::rounding::exact;

    #[test]
    fn literals_read_back() {
        assert_eq!(double(1.0).to_string(), "1.0");
        assert_eq!(double(-0.25).to_string(), "(- 0.25)");
        for value in [f32::MAX, f32::from_bits(1), 0.1, 16_777_216.0] {
            assert_eq!(single(value).to_string().parse(), Ok(value));
        }
    }

    #[test]
    fn coefficients_beyond_singles_are_infinite_as_such() {
        let code = |value| coefficient(&Number::Rational(value)).to_string();
        assert_eq!(code(exact(0.5)), "emitted :: exact (0.5)");
        assert_eq!(code(exact(-1e300)), "emitted :: exact ((- 1e300))");
        let seventh = exact(1e300) / ratio(7, 1);
        let seventh = code(seventh);
        assert!(
            seventh.starts_with("emitted :: rounded (1.4285714285714"),
            "{seventh}"
        );
    }

    /// A number above the middle of two singles, whose double is that middle: to a single it is not rounded by way of the double.
    #[test]
    fn a_single_that_the_double_does_not_give_is_written() {
        let middle = 1.0 + f64::from(f32::EPSILON) / 2.0;
        let above = exact(middle) + exact(f64::EPSILON / 16.0);
        assert_eq!(middle as f32, 1.0);
        let code = coefficient(&Number::Rational(above)).to_string();
        assert!(
            code.starts_with("emitted :: Coefficient :: new (1.0000000596046448"),
            "{code}"
        );
        assert!(code.ends_with("1.0000001)"), "{code}");
    }
}
