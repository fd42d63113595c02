//! The roles of methods, which determine the coloured curves.

use super::{Curve, Kind, Measurements, ProblemRecord};

/// The role of a method in a comparison. Plots show methods with a role in colour, all others in pale grey.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// The implicit method that is fastest at the smallest target that any implicit method reaches.
    BestImplicit,
    /// The explicit method that is fastest at the smallest target that any explicit method reaches.
    BestExplicit,
    /// Störmer–Verlet: the first explicit method whose name contains “Verlet”.
    Verlet,
    /// The classical Runge–Kutta method: the peer named “RK4”.
    Rk4,
    /// The peer other than RK4 that is fastest at the smallest target that any of them reaches.
    BestPeer,
}

impl Role {
    /// All roles, in the order of their colours.
    pub const ALL: [Self; 5] = [
        Self::BestImplicit,
        Self::BestExplicit,
        Self::Verlet,
        Self::Rk4,
        Self::BestPeer,
    ];

    /// The name of the role.
    pub const fn name(self) -> &'static str {
        match self {
            Self::BestImplicit => "best implicit",
            Self::BestExplicit => "best explicit",
            Self::Verlet => "Verlet",
            Self::Rk4 => "RK4",
            Self::BestPeer => "best peer",
        }
    }

    /// The role that a method has by its name, independent of measurements.
    fn by_name(kind: Kind, name: &str) -> Option<Self> {
        match kind {
            Kind::Explicit => name.contains("Verlet").then_some(Self::Verlet),
            Kind::Peer => (name == "RK4").then_some(Self::Rk4),
            Kind::Implicit => None,
        }
    }
}

impl Measurements {
    /// The methods of a problem that have a role, in the order of [`Role::ALL`]. A method may have two roles: Verlet
    /// may also be the best explicit method.
    pub fn roles<'a>(&self, problem: &'a ProblemRecord) -> Vec<(Role, &'a Curve)> {
        let ranked = self.ranked(problem);
        let kind = |curve: &Curve| self.method(&curve.method).map(|method| method.kind);
        let named = |curve: &Curve| Role::by_name(kind(curve)?, &curve.method);
        let find = |role| {
            let mut curves = ranked.iter().copied();
            match role {
                Role::BestImplicit => curves.find(|curve| kind(curve) == Some(Kind::Implicit)),
                Role::BestExplicit => curves.find(|curve| kind(curve) == Some(Kind::Explicit)),
                Role::BestPeer => curves.find(|curve| {
                    kind(curve) == Some(Kind::Peer) && named(curve) != Some(Role::Rk4)
                }),
                Role::Verlet | Role::Rk4 => {
                    let mut curves = problem.curves.iter();
                    curves.find(|curve| named(curve) == Some(role))
                }
            }
        };
        let found = Role::ALL.map(|role| Some((role, find(role)?)));
        found.into_iter().flatten().collect()
    }

    /// The curves of a problem, ordered by the smallest target that they reach, then by their time for it.
    pub(super) fn ranked<'a>(&self, problem: &'a ProblemRecord) -> Vec<&'a Curve> {
        let key = |curve: &Curve| {
            let targets = self.targets.iter().rev();
            let costs = targets.map(|target| curve.cost(*target).seconds());
            let reached = costs.enumerate();
            let mut reached = reached.filter_map(|(missed, seconds)| Some((missed, seconds?)));
            reached.next().unwrap_or((usize::MAX, f64::INFINITY))
        };
        let mut curves: Vec<&Curve> = problem.curves.iter().collect();
        curves.sort_by(|a, b| {
            let (a, b) = (key(a), key(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        curves
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{curve, measurements};

    fn names(measurements: &Measurements) -> Vec<(Role, &str)> {
        let roles = measurements.roles(&measurements.problems[0]);
        let name = |(role, curve): (Role, &Curve)| {
            let mut curves = measurements.problems[0].curves.iter();
            let found = curves.find(|other| other.method == curve.method);
            (role, found.map_or("", |found| found.method.as_str()))
        };
        roles.into_iter().map(name).collect()
    }

    #[test]
    fn roles_go_to_the_best_of_each_kind_and_to_verlet() {
        let mut found = measurements();
        let expected = [
            (Role::BestImplicit, "Gauss 4"),
            (Role::BestExplicit, "Verlet"),
            (Role::Verlet, "Verlet"),
            (Role::BestPeer, "DOP853"),
        ];
        assert_eq!(names(&found), expected);
        // A faster explicit method takes only the role of the best explicit method from Verlet; RK4 is never the best
        // peer.
        for (name, kind) in [("Fast", Kind::Explicit), ("RK4", Kind::Peer)] {
            let mut record = found.methods[0].clone();
            record.name = name.into();
            record.kind = kind;
            found.methods.push(record);
            let runs = [(1e-3, 1e-6), (1e-13, 2e-6)];
            found.problems[0].curves.push(curve(name, &runs));
        }
        let expected = [
            (Role::BestImplicit, "Gauss 4"),
            (Role::BestExplicit, "Fast"),
            (Role::Verlet, "Verlet"),
            (Role::Rk4, "RK4"),
            (Role::BestPeer, "DOP853"),
        ];
        assert_eq!(names(&found), expected);
    }

    #[test]
    fn a_smaller_error_counts_more_than_time() {
        let mut found = measurements();
        let order = |found: &Measurements| {
            let ranked = found.ranked(&found.problems[0]).into_iter();
            ranked.map(|c| c.method.clone()).collect::<Vec<_>>()
        };
        assert_eq!(order(&found), ["Gauss 4", "DOP853", "Verlet"]);
        found.targets = vec![1e-3];
        assert_eq!(order(&found), ["Gauss 4", "DOP853", "Verlet"]);
        found.problems[0].curves.push(curve("none", &[]));
        assert_eq!(order(&found).last().map(String::as_str), Some("none"));
    }
}
