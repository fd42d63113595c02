//! Reading a file with Butcher arrays.

use std::ops::Range;

use num_rational::BigRational;
use num_traits::Signed;
use serde::Deserialize;
use toml::Spanned;

use super::{Array, Cell, MAX_STAGES};
use crate::refine::file::read_printed;
use symplectic_compiler::expression::Input;
use symplectic_compiler::inside::first_line;
use symplectic_compiler::inside::shown;
use symplectic_compiler::inside::with_suggestion;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{Error, ErrorKind};
use symplectic_exact::rounding::Decimal;

type List = Spanned<Vec<Spanned<String>>>;
type Matrix = Spanned<Vec<List>>;

/// The largest number of decimal places of an entry.
const MAX_PLACES: u32 = 400;
/// The largest absolute value of an entry.
const MAX_VALUE: u32 = 1000;

/// The part of a file that distinguishes these files from others.
#[derive(Deserialize)]
struct Probe {
    printed: Option<toml::Table>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    name: Option<String>,
    source: Option<String>,
    claim: Spanned<ClaimTable>,
    printed: PrintedTable,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ClaimTable {
    class: Spanned<String>,
    order: Spanned<usize>,
    #[serde(default)]
    properties: Vec<Spanned<String>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PrintedTable {
    a: Matrix,
    b: List,
    c: Option<List>,
    a_tilde: Option<Matrix>,
    b_tilde: Option<List>,
    c_tilde: Option<List>,
}

/// A property that is claimed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Claimed {
    Symplectic,
    Symmetric,
    Collocation,
}

const PROPERTIES: [(&str, Claimed); 3] = [
    ("symplectic", Claimed::Symplectic),
    ("symmetric", Claimed::Symmetric),
    ("collocation", Claimed::Collocation),
];

/// A file that has been read.
#[derive(Clone)]
pub(super) struct Table {
    pub name: Option<String>,
    pub source: Option<String>,
    pub class: HamiltonianClass,
    pub order: usize,
    pub order_span: Range<usize>,
    pub properties: Vec<(Claimed, Range<usize>)>,
    pub stages: usize,
    pub cells: Vec<Cell>,
}

impl Table {
    pub fn claims(&self, property: Claimed) -> bool {
        self.properties.iter().any(|(known, _)| *known == property)
    }

    pub fn has(&self, array: Array) -> bool {
        self.cells.iter().any(|cell| cell.array == array)
    }

    pub fn cell(&self, array: Array, row: usize, column: usize) -> Option<&Cell> {
        let here = |cell: &&Cell| (cell.array, cell.row, cell.column) == (array, row, column);
        self.cells.iter().find(here)
    }

    /// A printed value; zero if nothing is printed.
    pub fn value(&self, array: Array, row: usize, column: usize) -> BigRational {
        let cell = self.cell(array, row, column);
        cell.map_or_else(BigRational::default, |cell| cell.printed.value().clone())
    }

    /// The sum of a row of a matrix, and a bound on its rounding error.
    pub fn row_sum(&self, matrix: Array, row: usize) -> (BigRational, BigRational) {
        let cells = self.cells.iter();
        let cells = cells.filter(|cell| cell.array == matrix && cell.row == row);
        cells.fold(Default::default(), |(sum, slack), cell| {
            (sum + cell.printed.value(), slack + cell.printed.half_unit())
        })
    }
}

pub(super) fn wrong_file(file: Input<'_>, span: Range<usize>, message: String) -> Error {
    file.error(
        &first_line(file.text, span),
        ErrorKind::Document { message },
    )
}

pub(super) fn not_certified(file: Input<'_>, span: Range<usize>, message: String) -> Error {
    file.error(
        &first_line(file.text, span),
        ErrorKind::NotCertified { message },
    )
}

/// Reads the arrays; `None` for a file with other lists.
pub(super) fn read(file: Input<'_>) -> Result<Option<Table>, Error> {
    let arrays = |probe: Probe| {
        let printed = probe.printed.unwrap_or_default();
        Array::ALL
            .iter()
            .any(|array| printed.contains_key(array.name()))
    };
    if !toml::from_str::<Probe>(file.text).is_ok_and(arrays) {
        return Ok(None);
    }
    let keys: Keys = toml::from_str(file.text).map_err(|error| {
        let message = format!(
            "not a file of Butcher arrays: {}",
            with_suggestion(error.message())
        );
        wrong_file(file, error.span().unwrap_or(0..0), message)
    })?;
    let claim = keys.claim.get_ref();
    let class = class(file, &claim.class)?;
    let properties = claim.properties.iter();
    let properties = properties.map(|word| property(file, word));
    let printed = &keys.printed;
    let stages = printed.b.get_ref().len();
    if !(1..=MAX_STAGES).contains(&stages) {
        let message = format!("{stages} stages; tables of 1 to {MAX_STAGES} are refined");
        return Err(wrong_file(file, printed.b.span(), message));
    }
    if printed.a_tilde.is_none() && (printed.b_tilde.is_some() || printed.c_tilde.is_some()) {
        let message = "`b_tilde` and `c_tilde` come with an `a_tilde`, which is missing".to_owned();
        return Err(wrong_file(file, printed.b.span(), message));
    }
    let mut cells = Vec::new();
    for (array, matrix) in [
        (Array::A, Some(&printed.a)),
        (Array::ATilde, printed.a_tilde.as_ref()),
    ] {
        let Some(matrix) = matrix else { continue };
        check_length(file, array, matrix.get_ref().len(), stages, matrix.span())?;
        for (row, list) in matrix.get_ref().iter().enumerate() {
            check_length(file, array, list.get_ref().len(), stages, list.span())?;
            read_list(file, array, row, list, &mut cells)?;
        }
    }
    for (array, list) in [
        (Array::B, Some(&printed.b)),
        (Array::C, printed.c.as_ref()),
        (Array::BTilde, printed.b_tilde.as_ref()),
        (Array::CTilde, printed.c_tilde.as_ref()),
    ] {
        let Some(list) = list else { continue };
        check_length(file, array, list.get_ref().len(), stages, list.span())?;
        read_list(file, array, 0, list, &mut cells)?;
    }
    cells.sort_by_key(|cell| (cell.array, cell.row, cell.column));
    let table = Table {
        class,
        order: *claim.order.get_ref(),
        order_span: claim.order.span(),
        properties: properties.collect::<Result<_, _>>()?,
        name: keys.name,
        source: keys.source,
        stages,
        cells,
    };
    Ok(Some(table))
}

fn class(file: Input<'_>, word: &Spanned<String>) -> Result<HamiltonianClass, Error> {
    let known = HamiltonianClass::ALL.into_iter();
    let mut named = known.filter(|class| class.name() == word.get_ref());
    named.next().ok_or_else(|| {
        let kind = ErrorKind::Unknown {
            what: "class",
            name: shown(word.get_ref()),
            known: HamiltonianClass::ALL.map(HamiltonianClass::name).join(", "),
        };
        file.error(&first_line(file.text, word.span()), kind)
    })
}

fn property(file: Input<'_>, word: &Spanned<String>) -> Result<(Claimed, Range<usize>), Error> {
    let known = PROPERTIES.iter().find(|(name, _)| name == word.get_ref());
    let property = known.map(|(_, property)| (*property, word.span()));
    property.ok_or_else(|| {
        let kind = ErrorKind::Unknown {
            what: "property",
            name: shown(word.get_ref()),
            known: PROPERTIES.map(|(name, _)| name).join(", "),
        };
        file.error(&first_line(file.text, word.span()), kind)
    })
}

fn check_length(
    file: Input<'_>,
    array: Array,
    length: usize,
    stages: usize,
    span: Range<usize>,
) -> Result<(), Error> {
    if length == stages {
        return Ok(());
    }
    let message = format!(
        "a length of {length} in `{}`, and `b` has {stages}: all lists and rows have one entry for each stage",
        array.name()
    );
    Err(wrong_file(file, span, message))
}

fn read_list(
    file: Input<'_>,
    array: Array,
    row: usize,
    list: &List,
    cells: &mut Vec<Cell>,
) -> Result<(), Error> {
    for (index, text) in list.get_ref().iter().enumerate() {
        let printed = read_printed(file, text)?;
        if printed.places().is_some_and(|places| places > MAX_PLACES) {
            let message = format!("more than {MAX_PLACES} decimal places; give as many or fewer");
            return Err(wrong_file(file, text.span(), message));
        }
        if printed.value().abs() > BigRational::from_integer(MAX_VALUE.into()) {
            let message =
                format!("this number is larger than {MAX_VALUE}: no entry of a method in use is");
            return Err(wrong_file(file, text.span(), message));
        }
        let (row, column) = if array.is_matrix() {
            (row, index)
        } else {
            (index, 0)
        };
        cells.push(Cell {
            array,
            row,
            column,
            printed,
            span: text.span(),
        });
    }
    Ok(())
}

/// A `c` that differs from the sum of its row by more than the digits explain.
pub(super) struct OffSum {
    pub cell: Cell,
    pub message: String,
}

pub(super) fn off_sums(table: &Table) -> Vec<OffSum> {
    let mut found = Vec::new();
    for (list, matrix) in [(Array::C, Array::A), (Array::CTilde, Array::ATilde)] {
        for cell in table.cells.iter().filter(|cell| cell.array == list) {
            let (sum, slack) = table.row_sum(matrix, cell.row);
            let off = (cell.printed.value() - &sum).abs();
            if off > slack + cell.printed.half_unit() {
                let message = format!(
                    "{} = {} is not the sum of row {} of `{}`, which is {}",
                    cell.name(),
                    cell.printed.text(),
                    cell.row,
                    matrix.name(),
                    Decimal::round(&sum, 20),
                );
                found.push(OffSum {
                    cell: cell.clone(),
                    message,
                });
            }
        }
    }
    found
}
