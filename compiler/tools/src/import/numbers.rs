//! From the numbers of a table to its tableau.

use std::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::refine::refine_table;
use symplectic_compiler::Limits;
use symplectic_compiler::Stepping;
use symplectic_compiler::Tableau;
use symplectic_compiler::algebra::{Dense, Number, Rationals};
use symplectic_compiler::expression::Input;
use symplectic_compiler::inside::check_stages;
use symplectic_compiler::inside::order_within;
use symplectic_compiler::inside::shown;
use symplectic_compiler::inside::{LowerTriangular, Partitioned};
use symplectic_compiler::inside::{Notation, PLACES, Value, value_of, zero};
use symplectic_compiler::order::{HamiltonianClass, OrderOptions, ViolatedCondition};
use symplectic_compiler::{Definition, Key};
use symplectic_compiler::{Error, ErrorKind};
use symplectic_exact::rational::ratio;
use symplectic_exact::rounding::to_f64;

/// The rows of a matrix and the weights.
type Half = (Vec<Vec<Value>>, Vec<Value>);

/// The numbers of a table.
#[derive(Debug, Clone)]
pub(crate) enum Numbers {
    /// Drifts and kicks, equal in number.
    Splitting {
        drifts: Vec<Value>,
        kicks: Vec<Value>,
        drifts_first: bool,
    },
    /// Matrices and weights; those for momenta are the same as for positions if they are not given.
    RungeKutta {
        positions: Half,
        momenta: Option<Half>,
    },
}

/// The origin of the exact coefficients of a tableau.
#[derive(Debug, Clone)]
pub(crate) enum Origin {
    /// The numbers are exact, or satisfy their order conditions exactly as they are written.
    Exact,
    /// The exact method that is proved to be near the decimals, and the condition that the decimals violate as they are written.
    Refined(Within, Option<Forced>),
    /// The decimals themselves, because no exact method was found near them.
    Decimals(Within),
}

/// The orders of decimals up to their rounding, with the first conditions that are violated by more than that, for each class as in
/// [`HamiltonianClass::ALL`].
pub(crate) type Within = [(usize, Option<ViolatedCondition>); 3];

/// The reason for which decimals are moved: an order that they have up to their rounding, and a condition of this order.
#[derive(Debug, Clone)]
pub(crate) struct Forced {
    class: HamiltonianClass,
    order: usize,
    violated: ViolatedCondition,
}

impl fmt::Display for Forced {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Forced {
            class,
            order,
            violated,
        } = self;
        write!(f, "order {order} for {class} H: {violated}")
    }
}

/// An imported table.
pub(crate) struct Read {
    pub tableau: Tableau,
    pub origin: Origin,
}

/// The names of the drifts and kicks of a table, and their order.
pub(crate) struct Flows<'a> {
    pub drift: &'a str,
    pub kick: &'a str,
    pub drifts_first: bool,
    /// Whether the lists are the first half of a step that is the same from both ends.
    pub mirrored: bool,
}

impl From<&Stepping> for Flows<'_> {
    fn from(stepping: &Stepping) -> Self {
        Flows {
            drift: stepping.drift,
            kick: stepping.kick,
            drifts_first: stepping.drifts_first,
            mirrored: stepping.mirrored,
        }
    }
}

/// A half of a Runge–Kutta table, with the matrix row by row and optionally the nodes.
pub(crate) fn half(
    matrix: Vec<Value>,
    weights: Vec<Value>,
    nodes: Option<Vec<Value>>,
    limits: &Limits,
) -> Result<Half, ErrorKind> {
    let stages = weights.len();
    check_stages(&stages.into(), limits)?;
    let document = |message: String| ErrorKind::Document { message };
    if matrix.len() != stages * stages || stages == 0 {
        return Err(document(format!(
            "{} entries of a matrix for {stages} weights, which need {}",
            matrix.len(),
            stages * stages
        )));
    }
    if let Some(nodes) = nodes.as_ref().filter(|nodes| nodes.len() != stages) {
        let found = nodes.len();
        return Err(document(format!("{found} nodes `c` for {stages} weights")));
    }
    let rows: Vec<Vec<Value>> = matrix.chunks(stages).map(<[Value]>::to_vec).collect();
    for (i, (row, node)) in rows.iter().zip(nodes.iter().flatten()).enumerate() {
        let sum = sum(row)?;
        let distance = (sum.rational() - node.rational()).abs();
        // Irrational numbers are enclosed to 40 decimal places.
        let enclosed = BigRational::new(BigInt::one(), BigInt::from(10).pow(40));
        if distance > (&sum.error + &node.error) * ratio(4, 1) + enclosed {
            let i = i + 1;
            return Err(document(format!(
                "c_{i} is {}, and row {i} sums to {}",
                node.constant, sum.constant
            )));
        }
    }
    Ok((rows, weights))
}

fn sum(values: &[Value]) -> Result<Value, ErrorKind> {
    values.iter().try_fold(zero(), |sum, value| sum.add(value))
}

impl Numbers {
    /// The lists of a splitting in the order in which a library steps them.
    pub fn splitting(
        flows: &Flows<'_>,
        mut drifts: Vec<Value>,
        mut kicks: Vec<Value>,
        limits: &Limits,
    ) -> Result<Self, ErrorKind> {
        let (first, second) = match flows.drifts_first {
            true => (&mut drifts, &mut kicks),
            false => (&mut kicks, &mut drifts),
        };
        let (n, m) = (first.len(), second.len());
        if n == 0 || n != m && n != m + 1 {
            let message = format!(
                "{} drifts `{}` and {} kicks `{}`: a table has as many of both, or one more of what comes first",
                drifts.len(),
                shown(flows.drift),
                kicks.len(),
                shown(flows.kick)
            );
            return Err(ErrorKind::Document { message });
        }
        if flows.mirrored {
            // The flow written last is in the middle, once; the others alternate towards both ends.
            let reversed = |list: &[Value], skipped: usize| -> Vec<Value> {
                list.iter().rev().skip(skipped).cloned().collect()
            };
            let (back, other) = (reversed(first, n - m), reversed(second, 1 - (n - m)));
            first.extend(back);
            second.extend(other);
        }
        // The step ends as it begins.
        second.resize_with(first.len(), zero);
        check_stages(&drifts.len().into(), limits)?;
        Ok(Numbers::Splitting {
            drifts,
            kicks,
            drifts_first: flows.drifts_first,
        })
    }

    /// The drifts and kicks of the steps of a splitting by these fractions, one after the other.
    pub fn composition(
        base: &Tableau,
        weights: &[Value],
        limits: &Limits,
    ) -> Result<Self, ErrorKind> {
        let flows = flows(base).ok_or_else(|| ErrorKind::Document {
            message: "the base of a composition must be a splitting of exact drifts and kicks, such as velocity-verlet".to_owned(),
        })?;
        let mut steps: Vec<(bool, Value)> = Vec::new();
        for weight in weights {
            for (drift, fraction) in &flows {
                let flow = fraction.multiply(weight)?;
                match steps.last_mut() {
                    Some((last, sum)) if last == drift => *sum = sum.add(&flow)?,
                    _ => steps.push((*drift, flow)),
                }
            }
        }
        let drifts_first = steps.first().is_some_and(|(drift, _)| *drift);
        let list = |wanted: bool| -> Vec<Value> {
            let steps = steps.iter().filter(|(drift, _)| *drift == wanted);
            steps.map(|(_, flow)| flow.clone()).collect()
        };
        let names = Flows {
            drift: "drift",
            kick: "kick",
            drifts_first,
            mirrored: false,
        };
        Numbers::splitting(&names, list(true), list(false), limits)
    }

    /// All numbers.
    pub fn all(&self) -> Vec<&Value> {
        match self {
            Numbers::Splitting { drifts, kicks, .. } => drifts.iter().chain(kicks).collect(),
            Numbers::RungeKutta { positions, momenta } => {
                let halves = [Some(positions), momenta.as_ref()].into_iter().flatten();
                let halves =
                    halves.flat_map(|(rows, weights)| rows.iter().flatten().chain(weights));
                halves.collect()
            }
        }
    }

    /// Whether all numbers are exact.
    pub fn are_exact(&self) -> bool {
        self.all().into_iter().all(Value::is_exact)
    }

    /// The tableau of the numbers if they are exact or satisfy their order conditions as they are written, otherwise of the exact method
    /// near them.
    ///
    /// # Errors
    /// Numbers that are too long.
    pub fn derive(&self, limits: &Limits) -> Result<Read, Error> {
        if self.are_exact() {
            let tableau = self.as_they_stand(limits)?;
            return Ok(Read {
                tableau,
                origin: Origin::Exact,
            });
        }
        let within = self.orders_within();
        let forced = self.forced(&within);
        if forced.is_none()
            && let Some(tableau) = self.as_written(&within, limits)
        {
            let origin = Origin::Exact;
            return Ok(Read { tableau, origin });
        }
        let (separable, nystrom) = (within[1].0, within[2].0);
        let claims = [("nystrom", nystrom), ("separable", separable)];
        // The order for separable H is at most the order for quadratic T.
        let skipped = usize::from(nystrom <= separable);
        for (class, order) in claims.into_iter().skip(skipped) {
            if let Some(tableau) = self.refined(class, order, limits)? {
                let origin = Origin::Refined(within, forced);
                return Ok(Read { tableau, origin });
            }
        }
        let tableau = self.as_they_stand(limits)?;
        let origin = Origin::Decimals(within);
        Ok(Read { tableau, origin })
    }

    fn orders_within(&self) -> Within {
        /// The allowed residual of a condition, in units of the largest error of a coefficient.
        const UNITS: i64 = 50;
        /// The highest order of conditions for every `H` that are evaluated: 4 116 at this order, five times as many at the next.
        const MAX_GENERAL: usize = 7;
        let all = self.all();
        let error = all.iter().map(|value| &value.error).max();
        let error = error.cloned().unwrap_or_default() * ratio(UNITS, 1);
        let least = BigRational::new(BigInt::one(), BigInt::from(10).pow(10));
        let tolerance = error.max(least);
        let pair = self.rational_pair();
        let within = |class, limit| order_within(&pair, class, &tolerance, limit);
        let limit = OrderOptions::default().limit;
        let nystrom = within(HamiltonianClass::Nystrom, limit);
        // The orders for larger classes are not higher.
        let separable = within(HamiltonianClass::Separable, limit.min(nystrom.0 + 1));
        let general = match self {
            // Without colours, alternating colours are all trees.
            Numbers::RungeKutta { momenta: None, .. } => separable.clone(),
            _ => within(HamiltonianClass::General, MAX_GENERAL.min(separable.0 + 1)),
        };
        [general, separable, nystrom]
    }

    /// The first condition of the orders up to rounding that the numbers violate as they are written.
    fn forced(&self, within: &Within) -> Option<Forced> {
        let least = BigRational::new(BigInt::one(), BigInt::from(10).pow(PLACES));
        let pair = self.rational_pair();
        let classes = HamiltonianClass::ALL.into_iter().zip(within).rev();
        // Those for every H are not looked for by any refinement.
        let classes = classes.filter(|(class, _)| *class != HamiltonianClass::General);
        let mut found = classes.filter_map(|(class, &(order, _))| {
            let (_, violated) = order_within(&pair, class, &least, order);
            violated.map(|violated| Forced {
                class,
                order,
                violated,
            })
        });
        found.next()
    }

    /// The tableau of the numbers as they are written, if it is proved to have the orders that they have up to rounding.
    fn as_written(&self, within: &Within, limits: &Limits) -> Option<Tableau> {
        let [_, (separable, _), (nystrom, _)] = within;
        let tableau = self.as_they_stand(limits).ok()?;
        let report = tableau.order(&OrderOptions {
            limit: *separable.max(nystrom),
            ..OrderOptions::default()
        });
        let kept = *nystrom > 0
            && report.separable.order >= *separable
            && report.nystrom.order >= *nystrom;
        kept.then_some(tableau)
    }

    fn rational_pair(&self) -> Partitioned<Dense<Rationals>> {
        let list =
            |values: &[Value]| -> Vec<BigRational> { values.iter().map(Value::rational).collect() };
        match self {
            Numbers::Splitting {
                drifts,
                kicks,
                drifts_first,
            } => {
                let lower_triangular = match drifts_first {
                    true => LowerTriangular::DriftsFirst,
                    false => LowerTriangular::KicksFirst,
                };
                Partitioned::of_splitting(Rationals, lower_triangular, list(drifts), list(kicks))
            }
            Numbers::RungeKutta { positions, momenta } => {
                let matrix =
                    |rows: &[Vec<Value>]| rows.iter().map(|row| list(row)).collect::<Vec<_>>();
                let algebra = Dense::new(Rationals, positions.1.len());
                let mut pair =
                    Partitioned::equal(algebra.into(), matrix(&positions.0), list(&positions.1));
                if let Some((rows, weights)) = momenta {
                    (pair.a_tilde, pair.b_tilde) = (matrix(rows), list(weights));
                }
                pair
            }
        }
    }

    /// The exact method of this order near the numbers, if one is found.
    fn refined(
        &self,
        class: &str,
        order: usize,
        limits: &Limits,
    ) -> Result<Option<Tableau>, Error> {
        if order == 0 {
            return Ok(None);
        }
        let texts = |values: &[Value]| -> Result<Vec<String>, ErrorKind> {
            let printed = values
                .iter()
                .map(|value| Ok(value.printed()?.text().to_owned()));
            printed.collect()
        };
        match self {
            Numbers::Splitting {
                drifts,
                kicks,
                drifts_first,
            } => {
                let claim = format!("{class}({order})");
                let definition =
                    definition(*drifts_first, &texts(drifts)?, &texts(kicks)?, Some(&claim));
                Ok(definition.derive(limits).ok())
            }
            Numbers::RungeKutta { positions, momenta } => {
                // Trees are enumerated up to a limit; a quadrature of a higher order determines its method.
                let order = match order >= OrderOptions::default().limit {
                    true => order.max(quadrature_order(positions)),
                    false => order,
                };
                let quoted = |texts: Vec<String>| {
                    let texts: Vec<String> =
                        texts.iter().map(|text| format!("\"{text}\"")).collect();
                    format!("[{}]", texts.join(", "))
                };
                let mut text =
                    format!("[claim]\nclass = \"{class}\"\norder = {order}\n[printed]\n");
                let halves = [("", Some(positions)), ("_tilde", momenta.as_ref())];
                for (suffix, (rows, weights)) in
                    halves.into_iter().filter_map(|(s, half)| Some((s, half?)))
                {
                    let nodes: Result<Vec<String>, ErrorKind> =
                        rows.iter().map(|row| node(row)).collect();
                    let rows: Result<Vec<String>, ErrorKind> =
                        rows.iter().map(|row| texts(row).map(quoted)).collect();
                    text.push_str(&format!(
                        "a{suffix} = [{}]\nb{suffix} = {}\nc{suffix} = {}\n",
                        rows?.join(", "),
                        quoted(texts(weights)?),
                        quoted(nodes?)
                    ));
                }
                let found = refine_table("table", &text).ok().flatten();
                let found = found.and_then(|table| table.tableau().cloned());
                Ok(found.and_then(|tableau| match momenta {
                    None => alone(tableau, positions, limits),
                    Some(_) => Some(tableau),
                }))
            }
        }
    }

    /// The tableau of the numbers, whatever their sums.
    fn as_they_stand(&self, limits: &Limits) -> Result<Tableau, Error> {
        let texts = |values: &[Value]| -> Vec<String> {
            values.iter().map(|v| v.constant.to_string()).collect()
        };
        match self {
            Numbers::Splitting {
                drifts,
                kicks,
                drifts_first,
            } => {
                let (drifts, kicks) = (texts(drifts), texts(kicks));
                let splitting = definition(*drifts_first, &drifts, &kicks, None);
                // Numbers that do not sum to 1 are rejected there.
                if let Ok(tableau) = splitting.derive(limits) {
                    return Ok(tableau);
                }
                let matrix = |list: &[String], own: bool| {
                    let row = |i: usize| {
                        let entries = list.iter().enumerate();
                        let entries = entries.map(|(j, text)| {
                            if j < i + usize::from(own) {
                                text.as_str()
                            } else {
                                "0"
                            }
                        });
                        format!("[{}]", entries.collect::<Vec<_>>().join(", "))
                    };
                    (0..list.len()).map(row).collect::<Vec<_>>().join(", ")
                };
                let parts = [
                    (Key::A, format!("[{}]", matrix(&drifts, *drifts_first))),
                    (Key::B, drifts.join(", ")),
                    (Key::ATilde, format!("[{}]", matrix(&kicks, !*drifts_first))),
                    (Key::BTilde, kicks.join(", ")),
                ];
                Definition::new(parts).derive(limits)
            }
            Numbers::RungeKutta { positions, momenta } => {
                let matrix = |rows: &[Vec<Value>]| {
                    let rows: Vec<String> = rows
                        .iter()
                        .map(|row| format!("[{}]", texts(row).join(", ")))
                        .collect();
                    format!("[{}]", rows.join(", "))
                };
                let mut parts = vec![
                    (Key::A, matrix(&positions.0)),
                    (Key::B, texts(&positions.1).join(", ")),
                ];
                if let Some((rows, weights)) = momenta {
                    parts.push((Key::ATilde, matrix(rows)));
                    parts.push((Key::BTilde, texts(weights).join(", ")));
                }
                Definition::new(parts).derive(limits)
            }
        }
    }

    /// A bound on the distance of the exact coefficients from the numbers, if each has its number.
    pub fn largest_error(&self, tableau: &Tableau) -> Option<BigRational> {
        let Numbers::RungeKutta { positions, momenta } = self else {
            return self.distance(tableau);
        };
        let numbers = tableau.numbers();
        let halves = [
            (Some(positions), &numbers.a, &numbers.b),
            (momenta.as_ref(), &numbers.a_tilde, &numbers.b_tilde),
        ];
        let mut largest = BigRational::zero();
        for (half, matrix, list) in halves {
            let Some((rows, weights)) = half else {
                continue;
            };
            let written: Vec<&Value> = rows.iter().flatten().chain(weights).collect();
            let exact: Vec<&Number<'_>> = matrix.iter().flatten().chain(list).collect();
            if written.len() != exact.len() {
                return None;
            }
            for (x, y) in written.into_iter().zip(exact) {
                largest = largest.max((x.rational() - y.enclose(400).middle()).abs());
            }
        }
        Some(largest)
    }

    /// A bound on the distance of the exact method from the numbers, for a splitting or a table whose stages are in the written order.
    pub fn distance(&self, tableau: &Tableau) -> Option<BigRational> {
        let Numbers::Splitting {
            drifts,
            kicks,
            drifts_first,
        } = self
        else {
            return None;
        };
        let alternating = |second: &[Value], first: &[Value]| -> Vec<(bool, BigRational)> {
            let pairs = first.iter().zip(second);
            pairs
                .flat_map(|(x, y)| {
                    [
                        (*drifts_first, x.rational()),
                        (!*drifts_first, y.rational()),
                    ]
                })
                .collect()
        };
        let written = match drifts_first {
            true => alternating(kicks, drifts),
            false => alternating(drifts, kicks),
        };
        let numbers = tableau.numbers();
        let stages = tableau.stages();
        // The stages of the tableau begin with the flow that makes it shorter.
        let starts = tableau_starts_with_drift(tableau);
        let mut exact = Vec::new();
        for i in 0..stages {
            let middle = |number: &Number<'_>| number.enclose(400).middle();
            let (drift, kick) = (
                (true, middle(&numbers.b[i])),
                (false, middle(&numbers.b_tilde[i])),
            );
            exact.extend(if starts { [drift, kick] } else { [kick, drift] });
        }
        let merged = |flows: Vec<(bool, BigRational)>| {
            let mut merged: Vec<(bool, BigRational)> = Vec::new();
            for (drift, value) in flows.into_iter().filter(|(_, value)| !value.is_zero()) {
                match merged.last_mut() {
                    Some((last, sum)) if *last == drift => *sum += value,
                    _ => merged.push((drift, value)),
                }
            }
            merged
        };
        let (written, exact) = (merged(written), merged(exact));
        let same = written.len() == exact.len();
        let distances = written
            .iter()
            .zip(&exact)
            .map(|((_, x), (_, y))| (x - y).abs());
        same.then(|| distances.max().unwrap_or_default())
    }
}

/// The sum of a row as a table prints it; sums near 0 and 1 are the ends of the step.
fn node(row: &[Value]) -> Result<String, ErrorKind> {
    let sum = sum(row)?;
    for end in [BigRational::zero(), BigRational::one()] {
        if (sum.rational() - &end).abs() <= sum.error {
            return Ok(end.to_string());
        }
    }
    Ok(sum.printed()?.text().to_owned())
}

/// The order of the quadrature: the largest k with `Σ b_i c_i^(k−1) = 1/k` up to it, as far as decimals tell.
fn quadrature_order((rows, weights): &Half) -> usize {
    let nodes: Vec<BigRational> = rows
        .iter()
        .map(|row| row.iter().map(Value::rational).sum())
        .collect();
    let tolerance = BigRational::new(BigInt::one(), BigInt::from(10).pow(10));
    let mut terms: Vec<BigRational> = weights.iter().map(Value::rational).collect();
    for k in 1..=2 * weights.len() {
        let sum: BigRational = terms.iter().sum();
        let wanted = BigRational::new(BigInt::one(), k.into());
        if (sum - wanted).abs() > tolerance {
            return k - 1;
        }
        terms
            .iter_mut()
            .zip(&nodes)
            .for_each(|(term, node)| *term *= node);
    }
    2 * weights.len()
}

/// The Runge–Kutta method with the numbers of one half of a pair: the positions or the momenta.
fn alone(tableau: Tableau, (rows, weights): &Half, limits: &Limits) -> Option<Tableau> {
    /// Far more than the rounding of decimals, and far less than the difference of the halves.
    const NEAR: f64 = 1e-6;
    if tableau.equal_halves() == (true, true) {
        return Some(tableau);
    }
    let (forms, doubles) = (tableau.exact_forms(), tableau.to_f64());
    let printed = rows.iter().flatten().chain(weights);
    let printed: Vec<f64> = printed.map(|value| to_f64(&value.rational())).collect();
    let halves = [
        (forms.a, forms.b, [doubles.a.concat(), doubles.b].concat()),
        (
            forms.a_tilde,
            forms.b_tilde,
            [doubles.a_tilde.concat(), doubles.b_tilde].concat(),
        ),
    ];
    let near = |half: &[f64]| {
        let mut pairs = half.iter().zip(&printed);
        half.len() == printed.len() && pairs.all(|(x, y)| (x - y).abs() < NEAR)
    };
    let (a, b, _) = halves.into_iter().find(|(.., half)| near(half))?;
    let list = |entries: Vec<Option<String>>| {
        Some(entries.into_iter().collect::<Option<Vec<_>>>()?.join(", "))
    };
    let rows: Option<Vec<String>> = a
        .into_iter()
        .map(|row| list(row).map(|row| format!("[{row}]")))
        .collect();
    let parts = [
        (Key::A, format!("[{}]", rows?.join(", "))),
        (Key::B, list(b)?),
    ];
    Definition::new(parts).derive(limits).ok()
}

/// The drifts (`true`) and kicks of a splitting with exact coefficients, in their order.
fn flows(tableau: &Tableau) -> Option<Vec<(bool, Value)>> {
    tableau.exact().lower_triangular()?;
    let drifts_first = tableau_starts_with_drift(tableau);
    let forms = tableau.exact_forms();
    let mut flows = Vec::new();
    for (drift, kick) in forms.b.into_iter().zip(forms.b_tilde) {
        let value = |text: String| {
            let input = Input::of_file("base", &text);
            value_of(input, 0..text.len(), Notation::Julia).ok()
        };
        let pair = [(true, value(drift?)?), (false, value(kick?)?)];
        let (first, second) = pair.into();
        flows.extend(match drifts_first {
            true => [first, second],
            false => [second, first],
        });
    }
    flows.retain(|(_, value)| !value.rational().is_zero());
    Some(flows)
}

/// Whether a stage of a splitting drifts before it kicks.
fn tableau_starts_with_drift(tableau: &Tableau) -> bool {
    let lower_triangular = tableau.exact().lower_triangular();
    lower_triangular == Some(LowerTriangular::DriftsFirst)
}

/// The definition of a splitting.
fn definition(
    drifts_first: bool,
    drifts: &[String],
    kicks: &[String],
    claim: Option<&str>,
) -> Definition {
    let mut parts = vec![
        (Key::Kick, kicks.join(", ")),
        (Key::Drift, drifts.join(", ")),
    ];
    if drifts_first {
        parts.push((Key::First, "drift".to_owned()));
    }
    parts.extend(claim.map(|claim| (Key::Claim, claim.to_owned())));
    Definition::new(parts)
}
