//! Exact coefficients as polynomials with rational coefficients.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use symplectic_compiler::Tableau;
use symplectic_compiler::algebra::{ClosedForm, Constants, Dense, FieldElement, NodeAlgebra};
use symplectic_compiler::inside::Exact;
use symplectic_compiler::inside::Partitioned;
use symplectic_exact::polynomial::Polynomial;

/// The coefficients of a method, for positions and for momenta.
pub(super) struct Halves<T> {
    /// `a_ij`, `ã_ij`
    pub a: [Vec<Vec<T>>; 2],
    /// `b_i`, `b̃_i`
    pub b: [Vec<T>; 2],
}

/// The representation of the coefficients.
pub(super) enum Polynomials<'a> {
    /// In one number `x`, a root of a polynomial.
    InNumber {
        /// A polynomial with the root `x`; `x` itself if all coefficients are rational.
        modulus: Polynomial,
        /// A description of `x`.
        number: String,
        coefficients: Halves<Polynomial>,
    },
    /// In the nodes.
    InNodes(&'a Partitioned<NodeAlgebra>),
}

impl<'a> Polynomials<'a> {
    /// The coefficients in the simplest form.
    ///
    /// # Errors
    /// The reason why there is none.
    pub fn of(tableau: &'a Tableau) -> Result<Self, &'static str> {
        match tableau.exact() {
            Exact::Nodes(pair) => Ok(quadratic(pair).unwrap_or(Polynomials::InNodes(pair))),
            Exact::Field(pair) => in_field(pair)
                .ok_or("its coefficients are not algebraic numbers; they contain pi, e or such"),
            Exact::Reals(_) => Err("its coefficients are known by enclosures, not exactly"),
        }
    }
}

/// All coefficients in one quadratic field, or rational.
fn quadratic<'a>(pair: &Partitioned<NodeAlgebra>) -> Option<Polynomials<'a>> {
    let algebra = &pair.algebra;
    let matrix = |m| {
        let rows = algebra.closed_entries(m).into_iter();
        rows.map(|row| row.into_iter().collect())
            .collect::<Option<_>>()
    };
    let vector = |f| algebra.closed_values(f).into_iter().collect::<Option<_>>();
    let found: Halves<ClosedForm> = Halves {
        a: [matrix(&pair.a)?, matrix(&pair.a_tilde)?],
        b: [vector(&pair.b)?, vector(&pair.b_tilde)?],
    };
    let all = found.a.iter().flatten().chain(&found.b).flatten();
    let radicand = all.filter_map(ClosedForm::radicand).next().cloned();
    let (modulus, number) = match &radicand {
        None => (Polynomial::variable(), "0".to_owned()),
        Some(d) => {
            let square = BigRational::from_integer(d.clone());
            let modulus = &Polynomial::monomial(2) - &Polynomial::constant(square);
            (modulus, format!("sqrt({d})"))
        }
    };
    let radicand = radicand.unwrap_or_else(BigInt::one);
    Some(Polynomials::InNumber {
        modulus,
        number,
        coefficients: found.map(|form| Some(Polynomial::from_rationals(&form.over(&radicand)?)))?,
    })
}

/// Elements of a field of algebraic numbers.
fn in_field<'a>(pair: &Partitioned<Dense<Constants>>) -> Option<Polynomials<'a>> {
    let field = pair.algebra.field().number_field()?;
    let elements = Halves {
        a: [pair.a.clone(), pair.a_tilde.clone()],
        b: [pair.b.clone(), pair.b_tilde.clone()],
    };
    Some(Polynomials::InNumber {
        modulus: field.modulus().clone(),
        number: field.display(&field.reduce(&Polynomial::variable())),
        coefficients: elements.map(FieldElement::as_algebraic)?,
    })
}

impl<T> Halves<T> {
    /// Applies `each` to every coefficient; `None` if it fails for one.
    fn map<U>(&self, each: impl Fn(&T) -> Option<U>) -> Option<Halves<U>> {
        let vector = |v: &Vec<T>| v.iter().map(&each).collect::<Option<Vec<U>>>();
        let matrix = |m: &Vec<Vec<T>>| m.iter().map(vector).collect::<Option<Vec<_>>>();
        let ([a, a_tilde], [b, b_tilde]) = (&self.a, &self.b);
        Some(Halves {
            a: [matrix(a)?, matrix(a_tilde)?],
            b: [vector(b)?, vector(b_tilde)?],
        })
    }
}
