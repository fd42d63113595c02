//! The overview: the fastest method for each problem and target.

use super::{link, tag};
use crate::plot::element::Element;
use crate::plot::file_name;
use crate::table::{cost, error};
use crate::{Measurements, ProblemRecord};

impl Measurements {
    /// The fastest method for each problem and target, with an explanation of the numbers; empty without problems.
    pub(super) fn overview(&self) -> Vec<Element> {
        if self.problems.is_empty() {
            return Vec::new();
        }
        let targets = self.targets.iter().map(|target| tag("th", error(*target)));
        let header = Element::new("tr")
            .child(tag("th", "the fastest for an error of"))
            .children(targets);
        let rows = self
            .problems
            .iter()
            .map(|problem| self.fastest_row(problem));
        let table = Element::new("table")
            .with("class", "overview")
            .child(Element::new("thead").child(header))
            .child(Element::new("tbody").children(rows));
        vec![table, tag("p", EXPLANATION).with("class", "quiet")]
    }

    fn fastest_row(&self, problem: &ProblemRecord) -> Element {
        let cells = self.targets.iter().map(|target| {
            // Narrow pages hide the header, so each cell contains its error.
            let cell = Element::new("td").with("data-error", error(*target));
            match problem.fastest(*target).first() {
                Some((curve, found)) => cell
                    .child(tag("b", cost(found)))
                    .child(tag("span", &curve.method)),
                None => cell.child(tag("b", "–")),
            }
        });
        let name = Element::new("th").child(link(&problem.name, &file_name(&problem.name)));
        Element::new("tr").child(name).children(cells)
    }
}

const EXPLANATION: &str = "Errors are global ones at the end of the run: the larger one of |q − q*|/|q*| and |p − p*|/|p*|. \
    Times are CPU times of the whole integration, the median of several runs that all methods made in turn. Times for an error \
    are interpolated between two runs on a logarithmic scale; ≤ is the time of the least accurate run, which is better already; \
    nothing is extrapolated. Evaluations count velocities and forces together, about twice the number of forces; those from \
    which Newton's iteration takes derivatives are not counted. The best method of a kind is the fastest at the smallest \
    error that one of them reaches. In the plots, each run shows its numbers under the mouse.";
