//! The energy `r·M⁻¹ r/2` of a block of coupled velocities, as a formula.

use num_traits::One;

use super::half;
use crate::graph::{Graph, Id, Number, integer};

/// The largest block that is inverted by its adjugate.
const MAX_BY_ADJUGATE: usize = 3;

/// A symmetric matrix M and a vector r.
#[derive(Clone)]
pub(super) struct Block {
    matrix: Vec<Vec<Id>>,
    residuals: Vec<Id>,
    /// The diagonal entries before elimination.
    scales: Vec<Id>,
}

/// Whether a number is zero; the last argument has the size of its terms.
type Zero<'a> = &'a dyn Fn(&Graph, Id, Id) -> bool;

impl Block {
    /// A block from its entries.
    pub fn new(matrix: Vec<Vec<Id>>, residuals: Vec<Id>) -> Self {
        let scales = (0..residuals.len()).map(|k| matrix[k][k]).collect();
        Block {
            matrix,
            residuals,
            scales,
        }
    }

    /// `r·M⁻¹ r/2`; for a singular matrix, the index of a row and the combination of r that must vanish.
    pub fn energy(self, graph: &mut Graph, zero: Zero<'_>) -> Result<Id, (usize, Id)> {
        let mut scratch = graph.clone();
        match self.clone().eliminated(&mut scratch, zero) {
            Ok(_) if self.residuals.len() <= MAX_BY_ADJUGATE => Ok(self.by_adjugate(graph)),
            found => {
                *graph = scratch;
                found
            }
        }
    }

    /// The energy by the adjugate, with one divisor.
    fn by_adjugate(&self, graph: &mut Graph) -> Id {
        let m = &self.matrix;
        let others = |k: usize| -> Vec<usize> { (0..m.len()).filter(|&l| l != k).collect() };
        let mut cofactor = |row: usize, column: usize| {
            let sign = if (row + column).is_multiple_of(2) {
                1
            } else {
                -1
            };
            let (rows, columns) = (others(row), others(column));
            let minor = match (rows.as_slice(), columns.as_slice()) {
                (&[a], &[b]) => m[a][b],
                (&[a, b], &[c, d]) => determinant(graph, [[m[a][c], m[a][d]], [m[b][c], m[b][d]]]),
                _ => graph.integer(1),
            };
            graph.scale(integer(sign), minor)
        };
        let count = m.len();
        let cofactors: Vec<Vec<Id>> = (0..count)
            .map(|row| (row..count).map(|column| cofactor(row, column)).collect())
            .collect();
        let determinant: Vec<_> = (0..count)
            .map(|k| (Number::one(), graph.multiply(m[0][k], cofactors[0][k])))
            .collect();
        let determinant = graph.sum(determinant);
        let mut terms = Vec::new();
        for row in 0..count {
            for column in row..count {
                let sides = [self.residuals[row], self.residuals[column]];
                let factors = [sides[0], sides[1], cofactors[row][column - row]];
                let twice = if row == column { 1 } else { 2 };
                terms.push((integer(twice), product(graph, factors)));
            }
        }
        let form = graph.sum(terms);
        graph.product(
            half(),
            [(form, Number::one()), (determinant, -Number::one())],
        )
    }

    /// The energy by elimination, starting with the velocity with the fewest partners; a 2×2 pivot if both diagonal entries vanish.
    fn eliminated(mut self, graph: &mut Graph, zero: Zero<'_>) -> Result<Id, (usize, Id)> {
        let mut left: Vec<usize> = (0..self.residuals.len()).collect();
        let mut terms = Vec::new();
        while !left.is_empty() {
            let Some(pivot) = self.pivot(graph, &left, zero) else {
                let row = left[0];
                return Err((row, self.residuals[row]));
            };
            left.retain(|k| !pivot.contains(k));
            terms.push((Number::one(), self.eliminate(graph, &pivot, &left)));
        }
        Ok(graph.sum(terms))
    }

    /// The next pivot; `None` if the rest of the matrix is zero.
    fn pivot(&self, graph: &mut Graph, left: &[usize], zero: Zero<'_>) -> Option<Vec<usize>> {
        let m = &self.matrix;
        let partners = |&k: &usize| left.iter().filter(|&&l| !graph.is_zero(m[k][l])).count();
        let mut order = left.to_vec();
        order.sort_by_cached_key(partners);
        let found = order
            .iter()
            .find(|&&k| !zero(graph, m[k][k], self.scales[k]));
        if let Some(&k) = found {
            return Some(vec![k]);
        }
        for (place, &k) in order.iter().enumerate() {
            for &l in &order[place + 1..] {
                if !zero(graph, m[k][l], m[k][l]) {
                    return Some(vec![k, l]);
                }
            }
        }
        None
    }

    /// Eliminates one velocity or two, and returns their contribution to the energy.
    fn eliminate(&mut self, graph: &mut Graph, pivot: &[usize], left: &[usize]) -> Id {
        let m = &mut self.matrix;
        let inverse = match *pivot {
            [k, l] => {
                let entries = [[m[k][k], m[k][l]], [m[l][k], m[l][l]]];
                let determinant = determinant(graph, entries);
                let [[a, b], [_, c]] = entries;
                let mut over = |sign: i64, x: Id| {
                    graph.product(
                        integer(sign),
                        [(x, Number::one()), (determinant, -Number::one())],
                    )
                };
                let (first, mixed, last) = (over(1, c), over(-1, b), over(1, a));
                vec![vec![first, mixed], vec![mixed, last]]
            }
            _ => vec![vec![graph.power(m[pivot[0]][pivot[0]], integer(-1))]],
        };
        // M⁻¹ of the pivot times a vector.
        let solve = |graph: &mut Graph, vector: &[Id]| -> Vec<Id> {
            let rows = inverse.iter();
            rows.map(|row| {
                let terms: Vec<_> = row
                    .iter()
                    .zip(vector)
                    .map(|(&a, &x)| (Number::one(), graph.multiply(x, a)))
                    .collect();
                graph.sum(terms)
            })
            .collect()
        };
        let own: Vec<Id> = pivot.iter().map(|&k| self.residuals[k]).collect();
        let speeds = solve(graph, &own);
        let energy: Vec<_> = own
            .iter()
            .zip(&speeds)
            .map(|(&r, &w)| (half(), graph.multiply(r, w)))
            .collect();
        for (place, &k) in left.iter().enumerate() {
            let column: Vec<Id> = pivot.iter().map(|&s| m[k][s]).collect();
            if column.iter().all(|&entry| graph.is_zero(entry)) {
                continue;
            }
            self.residuals[k] = reduced(graph, self.residuals[k], &column, &speeds);
            for &l in &left[place..] {
                let other: Vec<Id> = pivot.iter().map(|&s| m[l][s]).collect();
                if other.iter().all(|&entry| graph.is_zero(entry)) {
                    continue;
                }
                let other = solve(graph, &other);
                let entry = reduced(graph, m[k][l], &column, &other);
                (m[k][l], m[l][k]) = (entry, entry);
            }
        }
        graph.sum(energy)
    }
}

/// `x − a·b`
fn reduced(graph: &mut Graph, x: Id, a: &[Id], b: &[Id]) -> Id {
    let mut terms = vec![(Number::one(), x)];
    for (&a, &b) in a.iter().zip(b) {
        terms.push((-Number::one(), graph.multiply(a, b)));
    }
    graph.sum(terms)
}

fn determinant(graph: &mut Graph, [[a, b], [c, d]]: [[Id; 2]; 2]) -> Id {
    let (plus, minus) = (graph.multiply(a, d), graph.multiply(b, c));
    graph.sum([(Number::one(), plus), (-Number::one(), minus)])
}

/// A product; if the first two factors are equal, it contains their square.
fn product(graph: &mut Graph, factors: [Id; 3]) -> Id {
    graph.product(Number::one(), factors.map(|x| (x, Number::one())))
}
