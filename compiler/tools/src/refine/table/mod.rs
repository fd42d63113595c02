//! Butcher arrays in the usual form: decimals of `a`, `b`, `c` and of `ã`, `b̃`, `c̃`.
//!
//! ```toml
//! [claim]
//! class = "general"                                  # or "separable", or "nystrom" for quadratic T
//! order = 4
//! properties = ["symplectic", "symmetric", "collocation"]
//!
//! [printed]                                          # `c` may be left out, and so may `a_tilde`, `b_tilde`, `c_tilde`
//! a = [["0.25", "-0.038675134595"], ["0.538675134595", "0.25"]]
//! b = ["0.5", "0.5"]
//! c = ["0.211324865405", "0.788675134595"]
//! ```
//!
//! Five kinds of arrays are recognised by their digits and refined; the first that fits is used.
//!
//! 1. **collocation** with polynomials, alone or with its symplectic partner, in either order of positions and momenta, or
//!    the partner alone, such as Radau IA and Lobatto IIIB.
//!    The method is determined by its nodes (MW 2.6.2), and these by their polynomial `M`. The order `p` of the quadrature
//!    means `∫M x^k = 0` for `k < p − s`; nodes printed as 0, 1 or fractions are roots; symmetric nodes mean
//!    `M(1 − x) = ±M(x)`. All of this is linear in the coefficients of `M`, and is solved in rational numbers. The remaining
//!    free coefficients move until all entries round to their prints. The table is derived in the algebra of the roots, so
//!    all its properties are proved.
//! 2. **steps of the implicit midpoint rule**, the symplectic diagonally implicit methods: `a_ij = b_j` for `j < i`,
//!    `a_ii = b_i/2`. The `b_i` are the weights of a composition, which are [certified](symplectic_compiler::certify).
//! 3. **explicit pairs**, `a_ij = b_j` and `ã_ij = b̃_j` below or on the diagonal: a splitting, also certified.
//! 4. **fractions and surds**, if all digits are the roundings of short `(m + n√d)/k` with one `d`: Lobatto IIIC,
//!    Crouzeix's methods, the classical explicit methods. Their properties are decided in exact arithmetic.
//! 5. **no particular construction**: the entries are unknowns, and the claims are equations, which are solved near
//!    the print. A solution is certified, or verified to some binary places if equations depend on one another.

mod collocation;
mod composed;
mod exact;
mod general;
mod kinds;
mod nodes;
mod read;
mod surds;
mod write;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed};

use symplectic_compiler::Coefficients;
use symplectic_compiler::Error;
use symplectic_compiler::Tableau;
use symplectic_compiler::algebra::Number;
use symplectic_compiler::certify::{Certificate, Coefficient, Digits, Printed};
use symplectic_compiler::expression::Input;
use symplectic_exact::interval::Interval;

/// The largest number of stages of a table.
pub(super) const MAX_STAGES: usize = 16;

/// The arrays of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Array {
    A,
    B,
    C,
    ATilde,
    BTilde,
    CTilde,
}

impl Array {
    pub const ALL: [Array; 6] = [
        Array::A,
        Array::B,
        Array::C,
        Array::ATilde,
        Array::BTilde,
        Array::CTilde,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Array::A => "a",
            Array::B => "b",
            Array::C => "c",
            Array::ATilde => "a_tilde",
            Array::BTilde => "b_tilde",
            Array::CTilde => "c_tilde",
        }
    }

    pub fn is_matrix(self) -> bool {
        matches!(self, Array::A | Array::ATilde)
    }
}

/// One printed number and its place in the file.
#[derive(Debug, Clone)]
pub(super) struct Cell {
    pub array: Array,
    /// The row of a matrix, or the index in a list.
    pub row: usize,
    /// The column of a matrix.
    pub column: usize,
    pub printed: Printed,
    pub span: std::ops::Range<usize>,
}

impl Cell {
    pub fn name(&self) -> String {
        let (array, row, column) = (self.array.name(), self.row, self.column);
        match self.array.is_matrix() {
            true => format!("{array}[{row}][{column}]"),
            false => format!("{array}[{row}]"),
        }
    }
}

/// A linear combination of certified coefficients.
pub(super) type Terms = Vec<(Coefficient, BigRational)>;

/// The exact numbers behind the cells.
#[derive(Debug, Clone)]
pub(super) enum Exact {
    /// A derived table, and the index of its stage for each printed stage.
    Derived {
        tableau: Box<Tableau>,
        stages: Vec<usize>,
    },
    /// Combinations of certified coefficients, one for each cell.
    Certified {
        certificate: Box<Certificate>,
        terms: Vec<Terms>,
    },
    /// Zeros of the equations of the claims.
    Solved(general::Solved),
}

/// An exact table behind printed digits.
#[derive(Debug, Clone)]
pub struct RefinedTable {
    pub(super) name: Option<String>,
    pub(super) source: Option<String>,
    pub(super) cells: Vec<Cell>,
    pub(super) exact: Exact,
    /// A description of the method.
    pub(super) method: String,
    /// The proved claims.
    pub(super) facts: Vec<String>,
    /// Sums of printed rows that differ from the printed `c`.
    pub(super) notes: Vec<String>,
    /// Whether the method is the only one of its kind that satisfies the claim.
    pub(super) only_one: bool,
    /// Whether printed numbers that differ from the rounded exact ones are known to be the wrong numbers.
    pub(super) are_wrong: bool,
}

/// Reads a file with Butcher arrays and finds the exact method near them; `None` if the file has other printed lists, which
/// [`refine`](super::refine()) reads.
///
/// ```
/// let text = r#"
/// [claim]
/// class = "general"
/// order = 4
/// properties = ["symplectic", "symmetric", "collocation"]
///
/// [printed]
/// a = [["0.25", "-0.038675134595"], ["0.538675134595", "0.25"]]
/// b = ["0.5", "0.5"]
/// c = ["0.211324865405", "0.788675134595"]
/// "#;
/// let table = symplectic_tools::refine_table("gauss.toml", text)?.expect("arrays");
/// let text = table.text(30)?;
/// assert!(text.contains("method       polynomial(2) at gauss(2)"), "{text}");
/// assert!(text.contains("c[0]      0.211324865405187117745425609749"), "{text}");
/// assert!(text.contains("wrong digits none"), "{text}");
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Document`](symplectic_compiler::ErrorKind::Document) for an invalid file, and
/// [`ErrorKind::NotCertified`](symplectic_compiler::ErrorKind::NotCertified) if a `c` is not a row sum, if no exact method is found,
/// if a claim does not hold, or if the nearest method is too far away. Each with its place.
pub fn refine_table(file_name: &str, text: &str) -> Result<Option<RefinedTable>, Error> {
    refined(file_name, text, false)
}

/// The same with the method that was found, however far it is from the digits.
///
/// # Errors
/// Those of [`refine_table`], except for digits that are too far from the method.
pub fn refine_table_to_nearest(file_name: &str, text: &str) -> Result<Option<RefinedTable>, Error> {
    refined(file_name, text, true)
}

fn refined(file_name: &str, text: &str, nearest: bool) -> Result<Option<RefinedTable>, Error> {
    let file = Input {
        name: file_name,
        text,
    };
    let Some(table) = read::read(file)? else {
        return Ok(None);
    };
    kinds::refine(file, table, nearest).map(Some)
}

/// Bounds on the distance of a number from its print.
pub(super) struct Distance {
    pub at_least: BigRational,
    pub at_most: BigRational,
}

impl RefinedTable {
    /// All numbers to `digits` significant digits and the proved facts, for people.
    ///
    /// # Errors
    /// [`ErrorKind::NotCertified`](symplectic_compiler::ErrorKind::NotCertified) for more digits than are computed.
    pub fn text(&self, digits: usize) -> Result<String, Error> {
        write::text(self, digits)
    }

    /// All numbers to `digits` significant digits and the proved facts, as JSON.
    ///
    /// ```text
    /// {"name", "source", "evidence": "proved", "certified" or "verified", "method", "facts": [string], "distance": D,
    ///  "wrong_digits": [{"coefficient", "distance": D}], "printed_digits": "all", "excluded" or "not found",
    ///  "notes": [string], "digits",
    ///  "a": [[C]], "b": [C], …}    with    C = {"printed": string, "decimal": string}, D = "1.9e-15"
    /// ```
    ///
    /// # Errors
    /// The errors of [`RefinedTable::text`].
    pub fn json(&self, digits: usize) -> Result<String, Error> {
        write::json(self, digits)
    }

    /// The printed numbers that differ from the rounded exact ones, with upper bounds on their distances.
    pub fn wrong_digits(&self) -> Vec<(String, BigRational)> {
        let pairs = self.cells.iter().zip(self.distances());
        pairs
            .filter(|(cell, distance)| distance.at_least > cell.printed.half_unit())
            .map(|(cell, distance)| (cell.name(), distance.at_most))
            .collect()
    }

    /// Whether the weights and the matrices are the printed numbers, as far as enclosures tell.
    fn is_as_printed(&self) -> bool {
        /// The places behind those of the print that are compared; enclosures have 192 more.
        const PLACES: u32 = 150;
        let sums = [Array::C, Array::CTilde];
        let mut pairs = self.cells.iter().zip(self.distances());
        pairs.all(|(cell, distance)| {
            let half = cell.printed.half_unit();
            let unit = if half.is_positive() {
                half
            } else {
                BigRational::one()
            };
            let least = unit / BigRational::from_integer(BigInt::one() << PLACES);
            sums.contains(&cell.array) || distance.at_most <= least
        })
    }

    /// Whether a method of this kind that satisfies the claims has all printed digits.
    pub fn digits(&self) -> Digits {
        match (self.wrong_digits().is_empty(), self.only_one) {
            (true, _) => Digits::All,
            (false, true) => Digits::Excluded,
            (false, false) => Digits::NotFound,
        }
    }

    /// The derived table, if the method is a collocation method or consists of fractions and surds.
    pub fn tableau(&self) -> Option<&Tableau> {
        match &self.exact {
            Exact::Derived { tableau, .. } => Some(tableau),
            Exact::Certified { .. } | Exact::Solved(_) => None,
        }
    }

    /// The distances of all cells from their prints.
    pub(super) fn distances(&self) -> Vec<Distance> {
        let places = self.cells.iter().filter_map(|cell| cell.printed.places());
        let bits = 192 + places.max().unwrap_or(0).saturating_mul(4);
        let enclosures = self.exact.enclosures(&self.cells, bits);
        let pairs = self.cells.iter().zip(enclosures);
        pairs
            .map(|(cell, enclosure)| distance(&enclosure, cell.printed.value()))
            .collect()
    }
}

fn distance(enclosure: &Interval, printed: &BigRational) -> Distance {
    let difference = enclosure.subtract(&Interval::enclosing(printed, enclosure.bits()));
    let (low, high) = (difference.low(), difference.high());
    let straddles = difference.contains(&BigRational::from_integer(BigInt::from(0)));
    let at_least = match straddles {
        true => BigRational::from_integer(BigInt::from(0)),
        false => low.abs().min(high.abs()),
    };
    Distance {
        at_least,
        at_most: low.abs().max(high.abs()),
    }
}

impl Exact {
    /// Applies `of_number` to the number behind each cell.
    pub fn values<T>(
        &self,
        cells: &[Cell],
        of_number: impl Fn(&Number<'_>) -> T,
        of_enclosures: impl Fn(&dyn Fn(u32) -> Interval) -> T,
    ) -> Vec<T> {
        match self {
            Exact::Derived { tableau, stages } => {
                let numbers = tableau.numbers();
                let number = |cell: &Cell| of_number(number_of(&numbers, cell, stages));
                cells.iter().map(number).collect()
            }
            Exact::Certified { certificate, terms } => {
                let value =
                    |terms: &Terms| of_enclosures(&|bits| enclosed(certificate, terms, bits));
                terms.iter().map(value).collect()
            }
            Exact::Solved(solved) => {
                let value = |cell: usize| of_enclosures(&|bits| solved.enclose(cell, bits));
                (0..cells.len()).map(value).collect()
            }
        }
    }

    pub fn enclosures(&self, cells: &[Cell], bits: u32) -> Vec<Interval> {
        self.values(
            cells,
            |number| number.enclose(bits),
            |enclose| enclose(bits),
        )
    }
}

/// An enclosure of a combination.
fn enclosed(certificate: &Certificate, terms: &Terms, bits: u32) -> Interval {
    let zero = Interval::enclosing(&BigRational::from_integer(BigInt::from(0)), bits);
    terms.iter().fold(zero, |sum, (name, factor)| {
        match certificate.enclose(*name, bits) {
            Some(value) if factor.is_one() => sum.add(&value),
            Some(value) => sum.add(&value.scale(factor)),
            None => sum,
        }
    })
}

fn number_of<'n, 'a>(
    numbers: &'n Coefficients<Number<'a>>,
    cell: &Cell,
    stages: &[usize],
) -> &'n Number<'a> {
    let row = stages[cell.row];
    match cell.array {
        Array::A => &numbers.a[row][stages[cell.column]],
        Array::ATilde => &numbers.a_tilde[row][stages[cell.column]],
        Array::B => &numbers.b[row],
        Array::BTilde => &numbers.b_tilde[row],
        Array::C => &numbers.c[row],
        Array::CTilde => &numbers.c_tilde[row],
    }
}
