//! Collocation methods with polynomials and their symplectic partners, from their nodes.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::collocation::{Family, Nodes, coefficients, off_collocation, rule, symmetric};
use super::kinds::close;
use super::read::{Claimed, Table, not_certified};
use super::{Array, Cell, Exact, RefinedTable};
use symplectic_compiler::Basis;
use symplectic_compiler::Error;
use symplectic_compiler::Evidence;
use symplectic_compiler::Limits;
use symplectic_compiler::QuadratureRule;
use symplectic_compiler::expression::Input;
use symplectic_compiler::inside::{Best, Row, middle, minimax};
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{Definition, Key};
use symplectic_compiler::{Tableau, derive_from};
use symplectic_exact::interval::Interval;
use symplectic_exact::rational::ratio;

/// Which array belongs to the collocation method.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// `a`; `ã` is its partner or not printed.
    Positions,
    /// `ã`; `a` is its partner.
    Momenta,
    /// The partner of `a`, which is not printed: `a` belongs to Radau IA or Lobatto IIIB.
    Partner,
}

impl Role {
    /// An entry of the collocation method; `None` if a weight vanishes, so that there is no partner.
    fn entry(self, table: &Table, i: usize, j: usize) -> Option<BigRational> {
        let weight = |i: usize| table.value(Array::B, i, 0);
        match self {
            Role::Positions => Some(table.value(Array::A, i, j)),
            Role::Momenta => Some(table.value(Array::ATilde, i, j)),
            Role::Partner if weight(i).is_zero() => None,
            Role::Partner => {
                Some(weight(j) * (BigRational::one() - table.value(Array::A, j, i) / weight(i)))
            }
        }
    }

    /// The printed node of a stage: an entry of `c`, or the sum of the row.
    fn node(self, table: &Table, stage: usize) -> BigRational {
        let row = (0..table.stages).filter_map(|j| self.entry(table, stage, j));
        let sum: BigRational = row.sum();
        let list = match self {
            Role::Positions | Role::Partner => Array::C,
            Role::Momenta => Array::CTilde,
        };
        let cell = table.cell(list, stage, 0);
        match (self, cell.map(|cell| cell.printed.value().clone())) {
            // Its nodes need not be the sums of the printed rows.
            (Role::Partner, Some(printed)) if close(&printed, &sum) => near_end(printed),
            (Role::Partner, _) => near_end(sum),
            (_, Some(printed)) => printed,
            (_, None) => sum,
        }
    }

    /// Whether a node is printed exactly: as a fraction or an integer, or as 0 or 1.
    fn is_exact(self, table: &Table, stage: usize) -> bool {
        let (list, matrix) = match self {
            Role::Positions => (Array::C, Array::A),
            Role::Momenta => (Array::CTilde, Array::ATilde),
            Role::Partner => {
                let value = self.node(table, stage);
                return value.is_zero() || value.is_one();
            }
        };
        let value = self.node(table, stage);
        let exact = |cell: &Cell| cell.printed.places().is_none();
        let row = table.cells.iter();
        let mut row = row.filter(|cell| cell.array == matrix && cell.row == stage);
        value.is_zero()
            || value.is_one()
            || match table.cell(list, stage, 0) {
                Some(cell) => exact(cell),
                None => row.all(exact),
            }
    }
}

/// 0 or 1, if a number computed from rounded ones is that close to it; otherwise the number.
fn near_end(value: BigRational) -> BigRational {
    let ends = [BigRational::zero(), BigRational::one()].into_iter();
    let mut near = ends.filter(|end| (&value - end).abs() <= ratio(1, 1_000_000));
    near.next().unwrap_or(value)
}

pub(super) fn collocation_of(table: &Table) -> Option<Role> {
    let is = |role: &Role| {
        let stages = 0..table.stages;
        let row = |i: usize| stages.clone().map(move |j| role.entry(table, i, j));
        let entries: Option<Vec<Vec<BigRational>>> =
            stages.clone().map(|i| row(i).collect()).collect();
        let c: Vec<BigRational> = stages.clone().map(|i| role.node(table, i)).collect();
        entries.is_some_and(|a| {
            let off = off_collocation(table.stages, |i, j| a[i][j].clone(), |i| c[i].clone());
            off <= ratio(1, 1000)
        })
    };
    let roles: &[Role] = match table.has(Array::ATilde) {
        true => &[Role::Positions, Role::Momenta],
        false => &[Role::Positions, Role::Partner],
    };
    roles.iter().copied().find(is)
}

pub(super) fn by_nodes(file: Input<'_>, table: &Table, role: Role) -> Result<RefinedTable, Error> {
    let printed: Vec<BigRational> = (0..table.stages).map(|i| role.node(table, i)).collect();
    let exact = (0..table.stages).filter(|&i| role.is_exact(table, i));
    let claimed = table.claims(Claimed::Symmetric);
    let mut nodes = Nodes {
        exact: exact.map(|i| printed[i].clone()).collect(),
        symmetric: claimed,
        order: table.order,
        printed,
    };
    // Nodes that are symmetric in print, though this is not claimed, are kept symmetric if there is a choice.
    let mut family = Family::of(&nodes);
    let only_one = family
        .as_ref()
        .is_some_and(|family| family.free().is_empty());
    if family.is_some() && !only_one && symmetric(&nodes.printed) {
        nodes.symmetric = true;
        family = Family::of(&nodes).or(family);
    }
    let refused = |message: String| not_certified(file, table.order_span.clone(), message);
    let Some(family) = family else {
        let stages = table.stages;
        let message = format!(
            "no collocation method with {stages} node{}{}{} has order {}",
            if stages == 1 { "" } else { "s" },
            if nodes.symmetric {
                ", symmetric ones,"
            } else {
                ""
            },
            match nodes.exact.len() {
                0 => String::new(),
                count => format!(", {count} of them as printed exactly,"),
            },
            table.order
        );
        return Err(refused(message));
    };
    let build = |coefficients: &[BigRational]| {
        let (rule, named) = rule(&family.polynomial(coefficients))?;
        let exact = Exact::Derived {
            tableau: Box::new(derived(&rule, named, role)?),
            stages: ranks(&nodes.printed),
        };
        Ok::<_, String>((rule, exact))
    };
    let start = coefficients(&nodes.printed);
    let near = within_last_places(table, &family.free(), start, build).map_err(&refused)?;
    let notes = notes(table, &near, only_one);
    let Nearest {
        rule,
        exact,
        suspects,
        misses,
    } = near;
    let Exact::Derived { tableau, .. } = &exact else {
        return Err(refused("the table is not derived".to_owned()));
    };
    let collocation = format!("polynomial({}) at {}", table.stages, rule.name());
    let method = match (role, table.has(Array::ATilde)) {
        (Role::Positions, false) => collocation,
        (Role::Positions, true) => format!("{collocation} with its symplectic partner"),
        (Role::Momenta, _) => {
            format!("{collocation} for momenta, with its symplectic partner for positions")
        }
        (Role::Partner, _) => format!("the symplectic partner of {collocation}, alone"),
    };
    let facts = proved(file, table, tableau, &rule, role)?;
    Ok(RefinedTable {
        name: table.name.clone(),
        source: table.source.clone(),
        cells: table.cells.clone(),
        exact,
        method,
        facts,
        notes,
        only_one,
        are_wrong: only_one || !misses || !suspects.is_empty(),
    })
}

/// Notes that numbers other than the marked one may be wrong, or that no single number is.
fn notes(table: &Table, near: &Nearest, only_one: bool) -> Vec<String> {
    let names = near.suspects.iter().skip(1);
    let names: Vec<String> = names.map(|&cell| table.cells[cell].name()).collect();
    if !names.is_empty() {
        let others = names.join(" or ");
        return vec![format!("the wrong number may as well be {others}")];
    }
    if only_one || !near.misses || !near.suspects.is_empty() {
        return Vec::new();
    }
    let message = "no change of one number alone was found that leads to a method of this kind";
    vec![message.to_owned()]
}

/// A method near the printed numbers, with its wrong prints.
struct Nearest {
    rule: QuadratureRule,
    exact: Exact,
    /// The cells whose change alone gives a method with all other digits; the cell for this method comes first.
    suspects: Vec<usize>,
    /// Whether some numbers are not rounded to their prints.
    misses: bool,
}

/// The method whose numbers are nearest to their prints, each measured by its own last place. The free coefficients of the
/// node polynomial are moved as in [`minimax`]. If no method has all digits, one that has all but one, if it exists.
fn within_last_places(
    table: &Table,
    free: &[usize],
    start: Vec<BigRational>,
    build: impl Fn(&[BigRational]) -> Result<(QuadratureRule, Exact), String>,
) -> Result<Nearest, String> {
    let search = Search::new(table, free, build);
    let near = search.shifted(start, None)?;
    let (rule, exact) = near.method;
    let mut nearest = Nearest {
        rule,
        exact,
        suspects: Vec::new(),
        misses: !near.reached,
    };
    let Some((rows, best)) = near.last.filter(|_| !near.reached) else {
        return Ok(nearest);
    };
    // A number with multiplier zero is an inactive constraint: leaving it out changes nothing.
    let is_active = |index: &usize| !best.multipliers[*index].is_zero();
    let reachable = |index: &usize| {
        let rest = without(&rows, *index);
        minimax(&rest).is_some_and(|best| best.level <= slack())
    };
    let indices = (0..rows.len()).filter(is_active).filter(reachable);
    let mut methods = Vec::new();
    for index in indices.take(MAX_SUSPECTS) {
        let found = search.shifted(near.coefficients.clone(), Some(index))?;
        if found.reached {
            methods.push((search.printed[index], found.method));
        }
    }
    nearest.suspects = methods.iter().map(|(cell, _)| *cell).collect();
    if let Some((_, (rule, exact))) = methods.into_iter().next() {
        (nearest.rule, nearest.exact) = (rule, exact);
    }
    Ok(nearest)
}

/// The largest number of suspect prints that are examined.
const MAX_SUSPECTS: usize = 8;

/// The level up to which another shift may still reach all prints.
fn slack() -> BigRational {
    ratio(2, 1)
}

fn without<T: Clone>(list: &[T], index: usize) -> Vec<T> {
    let kept = list.iter().enumerate().filter(|(other, _)| *other != index);
    kept.map(|(_, x)| x.clone()).collect()
}

/// Shifts of the free coefficients.
struct Search<'a, B> {
    table: &'a Table,
    free: &'a [usize],
    build: B,
    /// The indices of the cells printed as decimals.
    printed: Vec<usize>,
    bits: u32,
    /// The step of difference quotients, as small as the digits.
    step: BigRational,
    /// The scale of rounded coefficients: they are multiples of its inverse.
    scale: BigRational,
}

/// The result of the shifts.
struct Shifted {
    coefficients: Vec<BigRational>,
    method: (QuadratureRule, Exact),
    /// Whether all numbers round to their prints.
    reached: bool,
    /// The last linear programme, if there was one.
    last: Option<(Vec<Row>, Best)>,
}

impl<'a, B: Fn(&[BigRational]) -> Result<(QuadratureRule, Exact), String>> Search<'a, B> {
    fn new(table: &'a Table, free: &'a [usize], build: B) -> Self {
        let cells = table.cells.iter();
        let places = cells.clone().filter_map(|cell| cell.printed.places()).max();
        let places = places.unwrap_or(0);
        let decimal = |(_, cell): &(usize, &Cell)| cell.printed.half_unit().is_positive();
        let printed = cells.enumerate().filter(decimal);
        Search {
            table,
            free,
            build,
            printed: printed.map(|(index, _)| index).collect(),
            bits: 192 + 4 * places,
            step: BigRational::new(BigInt::one(), BigInt::from(10).pow(places)),
            scale: BigRational::from_integer(BigInt::from(10).pow(places + 4)),
        }
    }

    fn units(&self, value: &BigRational) -> BigInt {
        middle(&Interval::enclosing(value, self.bits))
    }

    /// The exact numbers behind the decimals.
    fn numbers(&self, exact: &Exact) -> Vec<BigInt> {
        let all = exact.enclosures(&self.table.cells, self.bits);
        let printed = self.printed.iter();
        printed.map(|&cell| middle(&all[cell])).collect()
    }

    /// Shifts the free coefficients until all numbers except `apart_from` round to their prints.
    fn shifted(
        &self,
        start: Vec<BigRational>,
        apart_from: Option<usize>,
    ) -> Result<Shifted, String> {
        const MAX_SHIFTS: usize = 4;
        let halves: Vec<BigInt> = {
            let cells = self.printed.iter().map(|&cell| &self.table.cells[cell]);
            cells
                .map(|cell| self.units(&cell.printed.half_unit()))
                .collect()
        };
        let method = (self.build)(&start)?;
        let mut found = Shifted {
            coefficients: start,
            method,
            reached: false,
            last: None,
        };
        for shifts in 0..=MAX_SHIFTS {
            let at = self.numbers(&found.method.1);
            let residuals: Vec<BigInt> = {
                let pairs = at.iter().zip(&self.printed);
                let print = |cell: usize| self.units(self.table.cells[cell].printed.value());
                pairs.map(|(value, &cell)| value - print(cell)).collect()
            };
            let mut pairs = residuals.iter().zip(&halves).enumerate();
            found.reached = pairs.all(|(index, (residual, half))| {
                Some(index) == apart_from || residual.abs() <= *half
            });
            if self.free.is_empty() || found.reached || shifts == MAX_SHIFTS {
                break;
            }
            let mut slopes: Vec<Vec<BigInt>> = vec![Vec::new(); at.len()];
            for &power in self.free {
                let mut moved = found.coefficients.clone();
                moved[power] += &self.step;
                let moved = self.numbers(&(self.build)(&moved)?.1);
                for ((slopes, after), before) in slopes.iter_mut().zip(moved).zip(&at) {
                    slopes.push(after - before);
                }
            }
            let rows: Vec<Row> = {
                let rows = residuals.into_iter().zip(slopes).zip(halves.clone());
                rows.map(|((residual, slopes), half)| Row {
                    residual,
                    slopes,
                    half,
                })
                .collect()
            };
            let best = match apart_from {
                None => minimax(&rows),
                Some(index) => minimax(&without(&rows, index)),
            };
            // If the level does not fall, the nearest point has been reached.
            let Some(best) = best else { break };
            let last = found.last.as_ref();
            if last.is_some_and(|(_, last)| best.level >= last.level) {
                break;
            }
            for (&power, shift) in self.free.iter().zip(&best.shift) {
                let exact = (&found.coefficients[power] + shift * &self.step) * &self.scale;
                found.coefficients[power] = exact.round() / &self.scale;
            }
            found.last = Some((rows, best));
            found.method = (self.build)(&found.coefficients)?;
        }
        Ok(found)
    }
}

fn derived(rule: &QuadratureRule, named: bool, role: Role) -> Result<Tableau, String> {
    let basis = Basis::monomials(rule.len());
    if named && role != Role::Partner {
        let mut parts = vec![
            (Key::Basis, format!("polynomial({})", rule.len())),
            (Key::Nodes, rule.name().to_owned()),
        ];
        if role == Role::Momenta {
            parts.push((Key::Exchange, "true".to_owned()));
        }
        let derived = Definition::new(parts).derive(&Limits::default());
        return derived.map_err(|error| error.kind.to_string());
    }
    let tableau = derive_from(&basis, rule).map_err(|kind| kind.to_string())?;
    let exact = match role {
        Role::Positions => return Ok(tableau),
        Role::Momenta => tableau.exact().clone().exchanged(),
        Role::Partner => tableau.exact().partner_alone(),
    };
    Ok(tableau.with_exact(exact))
}

/// The place of each value in ascending order.
fn ranks(values: &[BigRational]) -> Vec<usize> {
    let mut sorted: Vec<usize> = (0..values.len()).collect();
    sorted.sort_by(|&i, &j| values[i].cmp(&values[j]));
    let mut ranks = vec![0; values.len()];
    for (rank, index) in sorted.into_iter().enumerate() {
        ranks[index] = rank;
    }
    ranks
}

/// The proved claims of a derived table.
fn proved(
    file: Input<'_>,
    table: &Table,
    tableau: &Tableau,
    rule: &QuadratureRule,
    role: Role,
) -> Result<Vec<String>, Error> {
    let properties = tableau.properties();
    // A single table stands for both halves.
    let pair = table.has(Array::ATilde) || properties.equal_matrices.holds;
    let quadrature = rule.degree_of_precision() + 1;
    let (order, class, why) = match pair {
        true => {
            let orders = tableau.orders();
            let found = orders.class(table.class);
            match found.evidence {
                Evidence::Proved | Evidence::Refuted => (found.order, table.class, "proved"),
                _ => (0, table.class, "not proved"),
            }
        }
        // The order of a collocation method is that of its quadrature (GNI II.1.5), for all Hamiltonians.
        false => (
            quadrature,
            HamiltonianClass::General,
            "that of the quadrature, proved",
        ),
    };
    if order < table.order {
        let message = format!(
            "the method has order {order} for {class} H, {why}, and not {}",
            table.order
        );
        return Err(not_certified(file, table.order_span.clone(), message));
    }
    let mut facts = vec![format!("order {order} for {class} H, {why}")];
    let degree = rule.degree_of_precision();
    for (claimed, span) in &table.properties {
        let (holds, name) = match claimed {
            Claimed::Symplectic if pair => (properties.symplectic.holds, "symplectic"),
            // With C(s) and the Vandermonde matrix V, VᵀMV of M_ij = b_i a_ij + b_j a_ji − b_i b_j vanishes iff B(2s) holds.
            Claimed::Symplectic => (degree + 1 >= 2 * table.stages, "symplectic"),
            Claimed::Symmetric if pair => (properties.symmetric.holds, "symmetric"),
            Claimed::Symmetric => (is_symmetric(rule), "symmetric"),
            Claimed::Collocation => (role != Role::Partner, "collocation"),
        };
        if !holds {
            let message = format!("the method is not {name}, which is proved");
            return Err(not_certified(file, span.clone(), message));
        }
        facts.push(format!("{name}, proved"));
    }
    Ok(facts)
}

/// Whether the nodes are symmetric: the polynomial equals its mirror image up to the sign.
fn is_symmetric(rule: &QuadratureRule) -> bool {
    let modulus = rule.algebra().modulus();
    let mirror = symplectic_exact::polynomial::Polynomial::from_integers(&[1, -1]);
    let mirrored = modulus.compose(&mirror);
    mirrored.primitive() == modulus.primitive()
        || mirrored.scale(&ratio(-1, 1)).primitive() == modulus.primitive()
}
