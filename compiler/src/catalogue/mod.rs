//! The known methods, by name: one row a method or a family.

mod compositions;
mod decimals;
mod found;
mod perturbed;
mod processed;
mod splittings;

use crate::error::{Error, ErrorKind};
use crate::limits::Limits;

/// A method of the catalogue.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// The name: `gauss-3`.
    pub name: String,
    /// What it is.
    pub title: String,
    /// What it is derived from: `basis: polynomial(3), nodes: gauss(3)`.
    pub definition: String,
    /// The number of stages.
    pub stages: usize,
    /// Papers and books that it is from, and under which other names it is in this catalogue.
    pub source: String,
}

impl Entry {
    /// The default limits, or where the method has more stages, as many as it has.
    pub fn limits(&self) -> Limits {
        let default = Limits::default();
        Limits {
            stages: default.stages.max(self.stages),
        }
    }

    /// The other names of this method in the catalogue.
    pub fn same_as(&self) -> Vec<&'static str> {
        let group = COINCIDENCES
            .iter()
            .find(|g| g.contains(&self.name.as_str()));
        let others = group.into_iter().flat_map(|group| group.iter().copied());
        others.filter(|name| *name != self.name).collect()
    }
}

/// A method, or a family with one member for each number of stages `{s}`.
struct Row {
    name: &'static str,
    title: &'static str,
    definition: &'static str,
    stages: &'static [usize],
    source: &'static str,
}

const ROWS: &[Row] = &[
    Row {
        name: "symplectic-euler",
        title: "symplectic Euler, implicit in p",
        definition: "basis: polynomial(1), nodes: 0",
        stages: &[1],
        source: "Leok & Zhang, Discrete Hamiltonian Variational Integrators, Example 2 with c = 0",
    },
    Row {
        name: "symplectic-euler-adjoint",
        title: "the adjoint of symplectic Euler, implicit in q",
        definition: "basis: polynomial(1), nodes: 1",
        stages: &[1],
        source: "Leok & Zhang, Discrete Hamiltonian Variational Integrators, Example 2 with c = 1",
    },
    Row {
        name: "midpoint",
        title: "the implicit midpoint rule",
        definition: "basis: polynomial(1), nodes: 1/2",
        stages: &[1],
        source: "Leok & Zhang, Discrete Hamiltonian Variational Integrators, Example 2 with c = 1/2",
    },
    Row {
        name: "stormer-verlet",
        title: "Störmer–Verlet",
        definition: "basis: polynomial(2), nodes: lobatto(2)",
        stages: &[2],
        source: "Verlet 1967; Marsden & West 2001, §2.6.2; Hairer, Lubich & Wanner, Geometric Numerical Integration, §I.1.4; \
                 Leok & Zhang, Example 3 and the remark after it (from the basis 1, cos(πτ), the same tableau)",
    },
    Row {
        name: "gauss-{s}",
        title: "Gauss–Legendre collocation",
        definition: "basis: polynomial({s}), nodes: gauss({s})",
        stages: &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10],
        source: "Kuntzmann 1961; Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964); \
                 Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3; built as in Marsden & West 2001, Theorem 2.6.2",
    },
    Row {
        name: "lobatto-{s}",
        title: "Lobatto IIIA–IIIB pair",
        definition: "basis: polynomial({s}), nodes: lobatto({s})",
        stages: &[2, 3, 4, 5, 6, 7, 8],
        source: "Sun, Symplectic partitioned Runge–Kutta methods, J. Comput. Math. 11 (1993); \
                 Jay, SIAM J. Numer. Anal. 33 (1996); Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.2.2 and §VI.4; \
                 built as in Marsden & West 2001, Theorem 2.6.2",
    },
    Row {
        name: "radau-left-{s}",
        title: "collocation at left Radau nodes with Radau IA for momenta",
        definition: "basis: polynomial({s}), nodes: radau-left({s})",
        stages: &[1, 2, 3, 4, 5, 6],
        source: "Radau IA: Ehle 1969; as a symplectic pair: Sun, J. Comput. Math. 11 (1993); \
                 built as in Marsden & West 2001, Theorem 2.6.2",
    },
    Row {
        name: "radau-right-{s}",
        title: "Radau IIA with its symplectic partner",
        definition: "basis: polynomial({s}), nodes: radau-right({s})",
        stages: &[1, 2, 3, 4, 5, 6],
        source: "Radau IIA: Ehle 1969, Axelsson 1969; as a symplectic pair: Sun, J. Comput. Math. 11 (1993); \
                 built as in Marsden & West 2001, Theorem 2.6.2",
    },
    Row {
        name: "chebyshev-{s}",
        title: "equal weights (Chebyshev quadrature)",
        definition: "basis: polynomial({s}), nodes: chebyshev({s})",
        stages: &[1, 2, 3, 4, 5, 6, 7, 9],
        source: "Leok & Zhang, Discrete Hamiltonian Variational Integrators, Example 5 (tables for s = 1, 2, 3; equation 44 gives the nodes)",
    },
    Row {
        name: "clenshaw-curtis-{s}",
        title: "Clenshaw–Curtis nodes, the extrema of a Chebyshev polynomial",
        definition: "basis: polynomial({s}), nodes: clenshaw-curtis({s})",
        stages: &[3, 4, 5, 6],
        source: "nodes: Clenshaw & Curtis, Numer. Math. 2 (1960); the method: Leok & Zhang, §4.4 and Marsden & West 2001, Theorem 2.6.2",
    },
    Row {
        name: "newton-cotes-{s}",
        title: "equidistant nodes, closed Newton–Cotes",
        definition: "basis: polynomial({s}), nodes: newton-cotes({s})",
        stages: &[2, 3, 4, 5, 6],
        source: "nodes: Newton and Cotes; the method: Leok & Zhang, §4.4 and Marsden & West 2001, Theorem 2.6.2",
    },
    Row {
        name: "lobatto-{s}-exchanged",
        title: "Lobatto IIIB–IIIA pair: the Lobatto pair with positions and momenta exchanged",
        definition: "basis: polynomial({s}), nodes: lobatto({s}), exchange: true",
        stages: &[2, 3, 4],
        source: "Tang, Two types of variational integrators, Remark 2.3; for two stages the drift–kick form of Störmer–Verlet",
    },
    Row {
        name: "galerkin-2-gauss-{s}",
        title: "Galerkin variational integrator of piecewise linear velocities with a Gauss rule of more nodes",
        definition: "basis: legendre(2), quadrature: gauss({s})",
        stages: &[3, 4],
        source: "Tang, Two types of variational integrators, §2.2 with (2.35)",
    },
    Row {
        name: "galerkin-2-lobatto-3",
        title: "Galerkin variational integrator of piecewise linear velocities with Simpson's rule",
        definition: "basis: legendre(2), quadrature: lobatto({s})",
        stages: &[3],
        source: "Marsden & West 2001, §2.6.6; Tang, Two types of variational integrators, §2.2 with (2.35)",
    },
    Row {
        name: "leok-zhang-3",
        title: "a half wave at both ends",
        definition: "basis: [1, cos(pi*t)], nodes: [0, 1]",
        stages: &[2],
        source: "Leok & Zhang, Discrete Hamiltonian Variational Integrators, Example 3 (whose Ã is misprinted)",
    },
    Row {
        name: "leok-zhang-4",
        title: "half waves at three equidistant nodes",
        definition: "basis: [1, cos(pi*t), sin(pi*t)], nodes: [0, 1/2, 1]",
        stages: &[3],
        source: "Leok & Zhang, Discrete Hamiltonian Variational Integrators, Example 4",
    },
    Row {
        name: "fourier-{s}",
        title: "one whole wave at equidistant midpoints: equal weights",
        definition: "basis: [1, cos(2*pi*t), sin(2*pi*t)], nodes: [1/6, 1/2, 5/6]",
        stages: &[3],
        source: "the construction of Leok & Zhang, §4.4, with the trigonometric interpolation of periodic functions",
    },
    Row {
        name: "trigonometric-lobatto-{s}",
        title: "exact for velocities 1, cos(t/h), sin(t/h): fitted to the frequency 1/h",
        definition: "basis: [1, cos(t), sin(t)], nodes: lobatto({s})",
        stages: &[3],
        source: "the construction of Leok & Zhang, §4.4; trigonometric fitting: Gautschi, Numer. Math. 3 (1961)",
    },
    Row {
        name: "exponential-lobatto-{s}",
        title: "exact for velocities 1, exp(−t/h): fitted to decay",
        definition: "basis: [1, exp(-t)], nodes: lobatto({s})",
        stages: &[2],
        source: "the construction of Leok & Zhang, §4.4; exponential fitting: Gautschi, Numer. Math. 3 (1961)",
    },
    Row {
        name: "hyperbolic-lobatto-{s}",
        title: "exact for velocities 1, cosh(t/h), sinh(t/h)",
        definition: "basis: [1, cosh(t), sinh(t)], nodes: lobatto({s})",
        stages: &[3],
        source: "the construction of Leok & Zhang, §4.4; exponential fitting: Gautschi, Numer. Math. 3 (1961)",
    },
    Row {
        name: "half-wave-gauss-{s}",
        title: "linear velocities and half waves at Gauss nodes",
        definition: "basis: [1, t, cos(pi*t), sin(pi*t)], nodes: gauss({s})",
        stages: &[4],
        source: "the construction of Leok & Zhang, §4.4, with the functions of their Example 4 and t",
    },
    Row {
        name: "trigonometric-gauss-{s}",
        title: "linear velocities and waves of the frequency 1/h at Gauss nodes",
        definition: "basis: [1, t, cos(t), sin(t)], nodes: gauss({s})",
        stages: &[4],
        source: "the construction of Leok & Zhang, §4.4; trigonometric fitting: Gautschi, Numer. Math. 3 (1961)",
    },
];

/// Names of one method each. The test of the catalogue proves that these and no others coincide.
const COINCIDENCES: &[&[&str]] = &[
    &["symplectic-euler", "radau-left-1"],
    &["symplectic-euler-adjoint", "radau-right-1"],
    &["midpoint", "gauss-1", "chebyshev-1"],
    &["gauss-2", "chebyshev-2"],
    &[
        "stormer-verlet",
        "lobatto-2",
        "newton-cotes-2",
        "leok-zhang-3",
    ],
    &[
        "lobatto-3",
        "clenshaw-curtis-3",
        "newton-cotes-3",
        "galerkin-2-lobatto-3",
    ],
    &["velocity-verlet", "sbab-1"],
    &["position-verlet", "saba-1"],
];

/// All methods, in the order of the catalogue.
pub fn entries() -> impl Iterator<Item = Entry> {
    [
        ROWS,
        splittings::ROWS,
        decimals::ROWS,
        compositions::ROWS,
        perturbed::ROWS,
        processed::ROWS,
        found::ROWS,
    ]
    .into_iter()
    .flatten()
    .flat_map(|row| row.stages.iter().map(move |&stages| row.entry(stages)))
}

/// The method of this name. Case, hyphens and how the ö of Störmer is written do not matter: `StoermerVerlet` and
/// `stormer-verlet` are one name.
///
/// ```
/// use symplectic_compiler::catalogue;
///
/// let name = |name| catalogue::find(name).map(|entry| entry.name);
/// assert_eq!(name("StoermerVerlet").as_deref(), Some("stormer-verlet"));
/// assert_eq!(name("stormerverlet2"), None);
/// ```
pub fn find(name: &str) -> Option<Entry> {
    let wanted = plain(name);
    entries().find(|entry| plain(&entry.name) == wanted)
}

/// The letters and digits of a name.
fn plain(name: &str) -> String {
    let name = name.to_lowercase().replace('ö', "o").replace("oe", "o");
    name.chars().filter(|c| c.is_ascii_alphanumeric()).collect()
}

/// The error for a name that is not in the catalogue, with the names that look most like it.
pub fn unknown(name: &str) -> Error {
    let written = plain(name);
    let mut near: Vec<(usize, String)> = entries()
        .map(|entry| (distance(&written, &plain(&entry.name)), entry.name))
        .filter(|(distance, known)| *distance <= 2.max(known.len() / 3))
        .collect();
    near.sort_by_key(|(distance, _)| *distance);
    if near.is_empty() {
        // Names that begin with the same word.
        let word = |name: &str| name.split(['-', '_', ' ']).next().map(plain);
        let same = entries().filter(|entry| word(&entry.name) == word(name));
        near.extend(same.map(|entry| (0, entry.name)));
    }
    let near: Vec<String> = near.into_iter().take(3).map(|(_, name)| name).collect();
    let known = if near.is_empty() {
        "the names that `symplectic list` shows".to_owned()
    } else {
        format!("{}, …", near.join(", "))
    };
    ErrorKind::Unknown {
        what: "method",
        name: crate::expression::shown(name),
        known,
    }
    .into()
}

/// The number of insertions, deletions and changes that turn one word into another (Levenshtein).
fn distance(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, c) in from.chars().take(64).enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, d) in to.iter().enumerate() {
            let change = diagonal + usize::from(c != *d);
            diagonal = row[j + 1];
            row[j + 1] = change.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[to.len()]
}

impl Row {
    fn entry(&self, stages: usize) -> Entry {
        let fill = |pattern: &str| pattern.replace("{s}", &stages.to_string());
        let mut entry = Entry {
            name: fill(self.name),
            title: self.title.to_owned(),
            definition: fill(self.definition),
            stages,
            source: self.source.to_owned(),
        };
        let others = entry.same_as();
        if !others.is_empty() {
            entry.source = format!(
                "{}; the same method as {}",
                entry.source,
                others.join(" and ")
            );
        }
        entry
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_names_are_suggested() {
        assert_eq!(distance("gaus-3", "gauss-3"), 1);
        assert_eq!(distance("", "abc"), 3);
        let message = unknown("gaus-3").to_string();
        assert!(
            message.starts_with("unknown method `gaus-3`; known here: gauss-3, "),
            "{message}"
        );
        let message = unknown("yoshida-4").to_string();
        assert!(message.contains("known here: yoshida-1990-"), "{message}");
        assert!(
            unknown("runge-kutta-fehlberg")
                .to_string()
                .ends_with("`symplectic list` shows")
        );
    }

    #[test]
    fn names_of_the_catalogue_are_unique() {
        let mut names: Vec<String> = entries().map(|entry| entry.name).collect();
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
        assert!(
            names
                .iter()
                .all(|name| find(name).is_some_and(|entry| entry.name == *name))
        );
    }
}
