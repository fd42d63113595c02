//! The code of a method that is fitted to a frequency: its coefficients as functions, in data that the runtime evaluates.

use proc_macro2::TokenStream;
use quote::quote;

use super::Header;
use super::literal::{count, double, identifier};
use crate::algebra::FieldElement;
use crate::error::ErrorKind;
use crate::fitted::{Fitted, Quotient, Waves};

/// The lengths of the power series.
const TERMS: usize = 64;
/// The angles up to which series may be used, of which the largest possible one is taken.
const NEAR: [f64; 4] = [1.0, 0.5, 0.25, 0.125];
/// The part of the largest term of a series that the last terms must be below.
const NEGLIGIBLE: f64 = 1e-31;

/// The type of a fitted method: a frequency, with the method for each step size.
///
/// # Errors
/// [`ErrorKind::Definition`] if a coefficient has no limit for small steps, or its series converges in too small an interval.
pub fn fitted_method(fitted: &Fitted, header: &Header) -> Result<TokenStream, ErrorKind> {
    let Header {
        attributes,
        visibility,
        name,
    } = header;
    let parameter = identifier(fitted.parameter());
    let orders = fitted.orders()?;
    let [general, separable, nystrom] =
        [orders.general, orders.separable, orders.nystrom].map(|class| count(class.order));
    let (denominator, a, b) = fitted.over_denominator();
    let series = |numerator: &Waves| {
        let quotient = Quotient {
            numerator: numerator.clone(),
            denominator: denominator.clone(),
        };
        fitted.ring().series(&quotient, TERMS)
    };
    let vector = |v: &[Waves]| v.iter().map(series).collect::<Result<Vec<_>, _>>();
    let b_series = vector(&b)?;
    let a_series = a
        .iter()
        .map(|row| vector(row))
        .collect::<Result<Vec<_>, _>>()?;
    let all = || b_series.iter().chain(a_series.iter().flatten());
    let fits = |near: &&f64| all().all(|series| is_short(fitted, series, **near));
    let near = NEAR.iter().find(fits).ok_or_else(|| ErrorKind::Definition {
        message: "the power series of a coefficient converges for very small steps only: take lower frequencies in the basis".to_owned(),
    })?;
    let near = double(*near);
    let entry = |(numerator, series): (&Waves, &Vec<FieldElement>)| {
        let end = series
            .iter()
            .rposition(|x| !x.is_zero())
            .map_or(0, |last| last + 1);
        let series = series.iter().take(end).map(|x| pair(fitted, x));
        let terms = terms(fitted, numerator);
        quote!(FittedEntry { series: &[#(#series),*], numerator: #terms })
    };
    let row = |(row, series): (&Vec<Waves>, &Vec<Vec<FieldElement>>)| {
        let entries = row.iter().zip(series).map(entry);
        quote!(&[#(#entries),*])
    };
    let b = b.iter().zip(&b_series).map(entry);
    let a = a.iter().zip(&a_series).map(row);
    let denominator = terms(fitted, &denominator);
    let exchanged = fitted.is_exchanged();
    let text = name.to_string();
    let definition = fitted.definition().to_string();
    let documentation = documentation(fitted, orders.general.order);
    let of_frequency = format!(" The frequency `{}`.", fitted.parameter());
    Ok(quote! {
        #attributes
        #[doc = #documentation]
        #[derive(Clone, Copy, Debug, PartialEq)]
        #visibility struct #name {
            #[doc = #of_frequency]
            pub #parameter: f64,
        }

        #[allow(clippy::approx_constant, clippy::excessive_precision)]
        impl #name {
            /// What it is derived from.
            pub const DEFINITION: &'static str = #definition;

            /// The coefficients as functions of the product of frequency and step size.
            pub const COEFFICIENTS: ::symplectic::at_run_time::FittedCoefficients = {
                use ::symplectic::at_run_time::{FittedCoefficients, FittedEntry, FittedTerm};
                FittedCoefficients {
                    name: #text,
                    orders: ::symplectic::Orders { general: #general, separable: #separable, nystrom: #nystrom },
                    near: #near,
                    denominator: #denominator,
                    a: &[#(#a),*],
                    b: &[#(#b),*],
                    exchanged: #exchanged,
                }
            };

            /// The method for steps of this size. Steps of another size, such as those to a time that is not a multiple of it, are not fitted.
            ///
            /// # Errors
            /// If the method has no coefficients there.
            pub fn at(
                &self,
                step_size: f64,
            ) -> ::core::result::Result<::symplectic::at_run_time::RunTimeTableau, ::symplectic::at_run_time::TableauError>
            {
                Self::COEFFICIENTS.method(self.#parameter * step_size)
            }
        }
    })
}

/// Whether the last terms of a series do not matter up to this angle.
fn is_short(fitted: &Fitted, series: &[FieldElement], near: f64) -> bool {
    let terms = series.iter().scan(1.0, |power, x| {
        let term = fitted.number(x).to_f64().abs() * *power;
        *power *= near;
        Some(term)
    });
    let terms: Vec<f64> = terms.collect();
    let largest = terms.iter().copied().fold(0.0, f64::max);
    let last = terms.iter().rev().take(4).copied().fold(0.0, f64::max);
    last <= NEGLIGIBLE * largest
}

fn documentation(fitted: &Fitted, order: usize) -> String {
    let list: Vec<&str> = fitted.basis().collect();
    let stages = match fitted.is_exchanged() {
        false => "positions for velocities",
        true => "momenta for forces",
    };
    format!(
        " Symplectic method of {} stages, fitted to the frequency `{}`, of order {order} for small steps. At the stages and at the end of a step \
         {stages} in the span of {} are exact.",
        fitted.stages(),
        fitted.parameter(),
        list.join(", ")
    )
}

/// A number as two doubles.
fn pair(fitted: &Fitted, x: &FieldElement) -> TokenStream {
    let number = fitted.number(x);
    let high = number.to_f64();
    let [high, low] = [high, number.low_double(high)].map(double);
    quote!([#high, #low])
}

fn terms(fitted: &Fitted, sum: &Waves) -> TokenStream {
    let terms = sum.terms().map(|(wave, coefficient)| {
        let coefficient = pair(fitted, coefficient);
        let frequency = pair(fitted, &wave.frequency);
        let power = count(wave.power.unsigned_abs() as usize);
        let sine = wave.sine;
        quote!(FittedTerm { coefficient: #coefficient, power: #power, frequency: #frequency, sine: #sine })
    });
    quote!(&[#(#terms),*])
}
