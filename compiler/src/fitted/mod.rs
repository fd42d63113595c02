//! Methods that are fitted to a frequency: the coefficients are functions of `ν = wh`.
//!
//! The basis contains `cos(w·t)` and `sin(w·t)` with a parameter `w`, where `t` is the part of the step. The square construction (LZ §4.4)
//! is carried out over the field of quotients of sums of `νᵏ cos(φν)` and `νᵏ sin(φν)`, with `φ` and the coefficients in the number field of
//! the nodes. Equality in this field is decided, and quotients have power series in `ν`. The series decide the order for `h → 0` with a
//! fixed `w`, where the coefficients change with `h`.

mod order;
mod oscillator;
mod parameters;
mod quotient;
mod read;
mod waves;

pub use self::order::{FittedOrder, FittedOrders};
pub use self::oscillator::PhaseError;
pub use self::quotient::Quotient;
pub use self::waves::{Ring, Wave, Waves};

use num_rational::BigRational;

use crate::algebra::{Constants, Field, FieldElement};
use crate::coefficients::Coefficients;
use crate::definition::{Definition, Key};
use crate::error::{Error, ErrorKind};
use crate::expression::Input;
use crate::limits::Limits;
use crate::quadrature::Nodes;

/// The coefficients of `1, ν, ν², …`.
type Series = Vec<FieldElement>;

/// The largest number of stages: the determinants grow with its factorial.
const MAX_STAGES: usize = 5;

/// A symplectic method whose coefficients are functions of `ν = wh`.
///
/// ```
/// use symplectic_compiler::{Definition, Fitted, Limits};
///
/// let definition = Definition::parse("parameters: w, basis: [1, cos(w*t), sin(w*t)], nodes: [0, 1/2, 1]")?;
/// let fitted = Fitted::derive(&definition, &Limits::default())?;
/// assert!(fitted.is_symmetric());
/// assert_eq!(fitted.orders()?.general.order, 4);
/// // As w → 0 it becomes the method of polynomials at the same nodes.
/// let series = fitted.series(3)?;
/// assert_eq!(fitted.number(&series.b[0][0]).to_f64(), 1.0 / 6.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Fitted {
    definition: Definition,
    name: Option<String>,
    parameter: String,
    ring: Ring,
    /// Each function of the basis, as it is written and as waves in `t`.
    basis: Vec<(String, Waves)>,
    nodes: Vec<FieldElement>,
    /// The common denominator of `a` and `b`, and their numerators.
    denominator: Waves,
    a: Vec<Vec<Waves>>,
    b: Vec<Waves>,
    exchanged: bool,
}

/// For which functions of the basis, by their places, stages and step are exact.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExactOn {
    /// If the velocity along the step is such a function, all stages of the position and its new value are exact.
    pub velocities: Vec<usize>,
    /// The same for forces and momenta.
    pub forces: Vec<usize>,
    /// If the force along the step is such a function, the new momentum is exact, and with velocities the new position.
    pub step: Vec<usize>,
}

impl Fitted {
    /// Derives the coefficients of `parameters`, `basis` and `nodes`, perhaps with `exchange`.
    ///
    /// # Errors
    /// Other keys; functions that are not sums of rational multiples of `tᵏ cos(q·w·t)` and `tᵏ sin(q·w·t)`; nodes that are not algebraic;
    /// as many functions as nodes are needed; functions that are dependent at the nodes for every `w`, and weights that vanish for
    /// every `w`.
    pub fn derive(definition: &Definition, limits: &Limits) -> Result<Self, Error> {
        const TAKES: [Key; 4] = [Key::Parameters, Key::Basis, Key::Nodes, Key::Exchange];
        if let Some((key, _)) = definition.parts().find(|(key, _)| !TAKES.contains(key)) {
            return Err(refused(format!(
                "a method with `parameters` is defined by a `basis` at `nodes`, perhaps with `exchange`: leave out `{}`, or give \
                 the parameter a number, on the command line by `--at w=3`",
                key.name()
            )));
        }
        let part = |key: Key| {
            let text = definition.get(key);
            text.ok_or_else(|| {
                let needs = "`parameters: w` needs a `basis` with functions such as cos(w*t), and as many `nodes`";
                refused(format!("{needs}: `{}` is missing", key.name()))
            })
        };
        let parameter = read::parameter(part(Key::Parameters)?)?;
        let nodes_text = part(Key::Nodes)?;
        let nodes = Nodes::parse("nodes", nodes_text, limits)?;
        let at_nodes = |kind: ErrorKind| {
            let input = Input {
                name: "nodes",
                text: nodes_text,
            };
            input.error(&(0..nodes_text.len()), kind)
        };
        let constants = nodes.constants().map_err(at_nodes)?;
        let field =
            Constants::containing(&constants).filter(|field| field.number_field().is_some());
        let elements = field.as_ref().and_then(|field| {
            let elements = constants.iter().map(|c| Field::constant(field, c));
            elements.collect::<Option<Vec<_>>>()
        });
        let (Some(field), Some(elements)) = (field, elements) else {
            let message =
                "with `parameters` the nodes are algebraic numbers in a field of small degree"
                    .to_owned();
            return Err(at_nodes(ErrorKind::Definition { message }));
        };
        let ring = Ring { field };
        let basis = read::basis(part(Key::Basis)?, &parameter, &ring)?;
        if basis.len() != elements.len() {
            return Err(at_nodes(ErrorKind::NotSquare {
                basis: basis.len(),
                nodes: elements.len(),
            }));
        }
        if basis.len() > MAX_STAGES {
            return Err(at_nodes(ErrorKind::Definition {
                message: format!(
                    "a method with `parameters` has at most {MAX_STAGES} stages; with a number for `{parameter}`, on the command line by `--at {parameter}=3`, any number"
                ),
            }));
        }
        let exchanged = match definition.get(Key::Exchange) {
            None | Some("false") => false,
            Some("true") => true,
            Some(_) => return Err(refused("`exchange` is `true` or `false`".to_owned())),
        };
        Self::of(definition, parameter, ring, basis, elements, exchanged).map_err(at_nodes)
    }

    fn of(
        definition: &Definition,
        parameter: String,
        ring: Ring,
        basis: Vec<(String, Waves)>,
        nodes: Vec<FieldElement>,
        exchanged: bool,
    ) -> Result<Self, ErrorKind> {
        // The row of a at c_i solves Σ_j ψ_k(c_j) a_ij = ∫_0^{c_i} ψ_k, and so do the weights with c_i = 1.
        let values: Vec<Vec<Waves>> = basis
            .iter()
            .map(|(_, f)| nodes.iter().map(|c| value(&ring, f, c)).collect())
            .collect();
        let adjugate = ring.adjugate(&values);
        let denominator = match (values.first(), adjugate.first()) {
            (Some(row), Some(_)) => {
                let terms = row.iter().zip(&adjugate).map(|(x, column)| {
                    column
                        .first()
                        .map(|y| ring.multiply(x, y))
                        .unwrap_or_default()
                });
                terms.fold(Waves::default(), |sum, term| ring.add(&sum, &term))
            }
            _ => ring.one(),
        };
        if denominator.is_zero() {
            return Err(ErrorKind::Definition {
                message: format!(
                    "for every {parameter} a combination of the functions vanishes at all nodes: take other nodes or functions"
                ),
            });
        }
        let solved = |end: &FieldElement| -> Vec<Waves> {
            let integrals: Vec<Waves> =
                basis.iter().map(|(_, f)| integral(&ring, f, end)).collect();
            let entry = |row: &Vec<Waves>| dot(&ring, row, &integrals);
            adjugate.iter().map(entry).collect()
        };
        let b = solved(&ring.rational(BigRational::from_integer(1.into())));
        if let Some(index) = b.iter().position(Waves::is_zero) {
            return Err(ErrorKind::ZeroWeight {
                index: index + 1,
                node: Field::exact(&ring.field, &nodes[index]).unwrap_or_default(),
            });
        }
        Ok(Fitted {
            a: nodes.iter().map(solved).collect(),
            definition: definition.clone(),
            name: None,
            parameter,
            basis,
            nodes,
            denominator,
            b,
            exchanged,
            ring,
        })
    }

    /// The same method with a name.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// The name, if it was given one.
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// What it is derived from.
    pub fn definition(&self) -> &Definition {
        &self.definition
    }

    /// The name of the frequency.
    pub fn parameter(&self) -> &str {
        &self.parameter
    }

    /// The number of stages.
    pub fn stages(&self) -> usize {
        self.b.len()
    }

    /// The domain of the numerators and denominators.
    pub fn ring(&self) -> &Ring {
        &self.ring
    }

    /// The functions of the basis, as they are written.
    pub fn basis(&self) -> impl Iterator<Item = &str> {
        self.basis.iter().map(|(text, _)| text.as_str())
    }

    /// An element of the number field as a number.
    pub fn number(&self, x: &FieldElement) -> crate::algebra::Number<'_> {
        Field::number(&self.ring.field, x)
    }

    /// The coefficients `a_ij` and `b_i` of the construction. The others follow: `b̃ = b`, `ã_ij = b_j (b_i − a_ji)/b_i`, and `c_i` and `c̃_i`
    /// are the sums of the rows. With `exchange` `a_ij` is `ã_ij` of the method, and so on.
    pub fn constructed(&self) -> (Vec<Vec<Quotient>>, Vec<Quotient>) {
        let over = |numerator: &Waves| {
            self.ring
                .quotient(numerator.clone(), self.denominator.clone())
        };
        let vector = |v: &Vec<Waves>| v.iter().map(over).collect();
        (self.a.iter().map(vector).collect(), vector(&self.b))
    }

    /// The common denominator of the `a_ij` and `b_i`, and their numerators, without negative powers of `ν`; before any exchange of
    /// positions and momenta.
    pub fn over_denominator(&self) -> (Waves, Vec<Vec<Waves>>, Vec<Waves>) {
        let all = self
            .a
            .iter()
            .flatten()
            .chain(&self.b)
            .chain([&self.denominator]);
        let lowest = all.filter_map(Waves::lowest_power).min().unwrap_or(0);
        let one = self.ring.rational(BigRational::from_integer(1.into()));
        let shifted = |x: &Waves| self.ring.scale(x, &one, -lowest);
        let vector = |v: &Vec<Waves>| v.iter().map(shifted).collect();
        (
            shifted(&self.denominator),
            self.a.iter().map(vector).collect(),
            vector(&self.b),
        )
    }

    /// Whether positions and momenta are exchanged.
    pub fn is_exchanged(&self) -> bool {
        self.exchanged
    }

    /// The first coefficients of the power series in `ν` of all coefficients. The first of each is the coefficient of the limit.
    ///
    /// # Errors
    /// [`ErrorKind::Definition`] if a coefficient has no limit at `ν = 0`.
    pub fn series(&self, length: usize) -> Result<Coefficients<Vec<FieldElement>>, ErrorKind> {
        let (a, b) = self.constructed();
        let vector = |v: &[Quotient]| -> Result<Vec<Series>, ErrorKind> {
            v.iter().map(|x| self.ring.series(x, length)).collect()
        };
        let a = a
            .iter()
            .map(|row| vector(row))
            .collect::<Result<Vec<_>, _>>()?;
        let b = vector(&b)?;
        let ring = &self.ring;
        let partner = |i: usize, j: usize| -> Result<Series, ErrorKind> {
            let pairs = b[i].iter().zip(&a[j][i]);
            let rest: Series = pairs
                .map(|(b, a)| Field::subtract(&ring.field, b, a))
                .collect();
            ring.divide(&ring.times(&b[j], &rest, length), &b[i], length)
        };
        let stages = 0..self.stages();
        let row = |i: usize| {
            stages
                .clone()
                .map(|j| partner(i, j))
                .collect::<Result<Vec<_>, _>>()
        };
        let a_tilde = stages.clone().map(row).collect::<Result<Vec<_>, _>>()?;
        let (a, a_tilde) = match self.exchanged {
            false => (a, a_tilde),
            true => (a_tilde, a),
        };
        let sums = |m: &[Vec<Series>]| m.iter().map(|row| ring.total(row, length)).collect();
        Ok(Coefficients {
            c: sums(&a),
            c_tilde: sums(&a_tilde),
            b_tilde: b.clone(),
            b,
            a,
            a_tilde,
            gradient: Vec::new(),
        })
    }

    /// Whether the method is symmetric for every `ν`, with the stages in reverse order: `a_{s+1−i,s+1−j} + a_ij = b_j` and
    /// `b_{s+1−j} = b_j`. The same then holds for `ã`.
    pub fn is_symmetric(&self) -> bool {
        let ring = &self.ring;
        let last = self.stages().saturating_sub(1);
        let indices = || 0..self.stages();
        let palindrome = indices().all(|j| ring.subtract(&self.b[j], &self.b[last - j]).is_zero());
        palindrome
            && indices().all(|i| {
                indices().all(|j| {
                    let sum = ring.add(&self.a[i][j], &self.a[last - i][last - j]);
                    ring.subtract(&sum, &self.b[j]).is_zero()
                })
            })
    }

    /// Whether the weights sum to 1 for every `ν`.
    pub fn is_consistent(&self) -> bool {
        let ring = &self.ring;
        let sum = self
            .b
            .iter()
            .fold(Waves::default(), |sum, b| ring.add(&sum, b));
        ring.subtract(&sum, &self.denominator).is_zero()
    }

    /// For which functions of the basis the stages and the step are exact, for every `ν`.
    ///
    /// Rows of `a` and the weights integrate every function of the basis exactly by construction, with its values at the nodes. The rows
    /// of `ã` do so only where `Σ_j ã_ij ψ(c_j) = ∫_0^{c_i} ψ` for all i, which is decided.
    pub fn exact_on(&self) -> ExactOn {
        let ring = &self.ring;
        let all: Vec<usize> = (0..self.basis.len()).collect();
        let has = |place: &usize| {
            let Some((_, f)) = self.basis.get(*place) else {
                return false;
            };
            let values: Vec<Waves> = self.nodes.iter().map(|c| value(ring, f, c)).collect();
            self.nodes.iter().enumerate().all(|(i, c)| {
                // Σ_j b_j (b_i − a_ji) ψ(c_j) = b_i ∫ψ
                let terms = (0..self.stages()).map(|j| {
                    let rest = ring.subtract(&self.b[i], &self.a[j][i]);
                    ring.multiply(&ring.multiply(&self.b[j], &rest), &values[j])
                });
                let left = terms.fold(Waves::default(), |sum, term| ring.add(&sum, &term));
                let right = ring.multiply(&integral(ring, f, c), &self.denominator);
                let right = ring.multiply(&right, &self.b[i]);
                ring.subtract(&left, &right).is_zero()
            })
        };
        let partner: Vec<usize> = all.iter().copied().filter(has).collect();
        let (velocities, forces) = match self.exchanged {
            false => (all.clone(), partner),
            true => (partner, all.clone()),
        };
        ExactOn {
            velocities,
            forces,
            step: all,
        }
    }

    /// The definition of the method for one number `ν`, given as text.
    ///
    /// # Errors
    /// Those of [`Definition::at`].
    pub fn definition_at(&self, value: &str) -> Result<Definition, Error> {
        self.definition.at(&[(self.parameter.as_str(), value)])
    }
}

/// `ψ(c)` as a function of `ν`: `tᵏ cos(qνt)` is `cᵏ cos(qcν)`.
fn value(ring: &Ring, function: &Waves, c: &FieldElement) -> Waves {
    mapped(ring, function, |wave, coefficient| {
        let power = ring.power(c, wave.power.unsigned_abs());
        let frequency = Field::multiply(&ring.field, &wave.frequency, c);
        let factor = Field::multiply(&ring.field, coefficient, &power);
        ring.wave(0, frequency, wave.sine, factor)
    })
}

/// `∫_0^c ψ` as a function of `ν`.
fn integral(ring: &Ring, function: &Waves, c: &FieldElement) -> Waves {
    mapped(ring, function, |wave, coefficient| {
        let integral = ring.integral(c, wave.power.unsigned_abs(), &wave.frequency, wave.sine);
        ring.scale(&integral, coefficient, 0)
    })
}

fn mapped(ring: &Ring, function: &Waves, each: impl Fn(&Wave, &FieldElement) -> Waves) -> Waves {
    let terms = function
        .terms()
        .map(|(wave, coefficient)| each(wave, coefficient));
    terms.fold(Waves::default(), |sum, term| ring.add(&sum, &term))
}

fn dot(ring: &Ring, x: &[Waves], y: &[Waves]) -> Waves {
    let products = x.iter().zip(y).map(|(x, y)| ring.multiply(x, y));
    products.fold(Waves::default(), |sum, term| ring.add(&sum, &term))
}

fn refused(message: String) -> Error {
    ErrorKind::Definition { message }.into()
}

#[cfg(test)]
mod tests;
