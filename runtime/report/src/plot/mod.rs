//! The plots of a study.

mod axis;
mod chart;
pub(super) mod element;
mod labels;
mod look;

use axis::{Axis, Scale};
use chart::{Chart, Drawn, Shape};
use element::Element;
use look::Look;
pub(super) use look::{COLOURS, style};

pub use look::Scheme;

use super::{Curve, Kind, Measured, Measurements, Parameter, ProblemRecord, Role, Trace, text};

/// A plot, for a light or a dark background.
///
/// With at most eight curves each has a colour-blind safe colour and its name at its end. With more, methods with a
/// [`Role`](super::Role) have a colour; the others are pale grey, with a number at their end and a key below the plot. Names,
/// and the numbers of every run, appear under the mouse.
#[derive(Clone, Debug)]
pub struct Plot {
    chart: Chart,
}

impl Plot {
    /// The plot as an SVG file.
    pub fn svg(&self, scheme: Scheme) -> String {
        let style = Element::new("style").markup(style(scheme));
        let svg = self.root().child(style).children(self.chart.elements());
        format!("{svg}\n")
    }

    /// The plot as part of a page that contains its [`style`].
    pub(super) fn inline(&self) -> Element {
        self.root().children(self.chart.elements())
    }

    fn root(&self) -> Element {
        let (width, height) = (chart::WIDTH, self.chart.height());
        Element::new("svg")
            .with("xmlns", "http://www.w3.org/2000/svg")
            .with("viewBox", format!("0 0 {width} {height}"))
            .with(
                "font-family",
                "system-ui, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif",
            )
            .with("font-size", 13)
            .with("role", "img")
            .child(
                Element::new("title")
                    .text(format!("{}: {}", self.chart.title, self.chart.subtitle)),
            )
    }
}

/// Errors from this value on are not drawn.
const DRAWN: f64 = 1.0;
/// Smallest error in plots; zero is drawn here.
const NOTHING: f64 = 1e-17;

impl Measurements {
    /// All plots with their file names: for each problem `…-time`, `…-evaluations` and `…-energy`, unless there is
    /// nothing to draw.
    pub fn plots(&self) -> Vec<(String, Plot)> {
        let plots = self.problems.iter().flat_map(|problem| {
            let name = file_name(&problem.name);
            let plots = [
                ("time", self.time_plot(problem)),
                ("evaluations", self.evaluations_plot(problem)),
                ("energy", self.energy_plot(problem)),
            ];
            plots
                .into_iter()
                .filter_map(move |(what, plot)| Some((format!("{name}-{what}"), plot?)))
        });
        plots.collect()
    }

    /// The appearance of the curves of a problem, by method.
    fn looks(&self, problem: &ProblemRecord) -> impl Fn(&str) -> Look {
        let roles = self.roles(problem);
        let held = |method: &str| {
            let held = roles.iter().filter(|(_, curve)| curve.method == method);
            // Verlet keeps its own colour even if it is also the best explicit method.
            held.map(|(role, _)| *role as usize).next_back()
        };
        let methods = problem.curves.iter().map(|curve| curve.method.as_str());
        let mut colours: Vec<(&str, Option<usize>)> =
            methods.map(|method| (method, held(method))).collect();
        if colours.len() <= COLOURS {
            for index in 0..colours.len() {
                let used = |colour| colours.iter().any(|(_, used)| *used == Some(colour));
                // The colours without a role come first.
                let free = (Role::ALL.len()..COLOURS).chain(0..Role::ALL.len());
                let free = free.into_iter().find(|colour| !used(*colour));
                colours[index].1 = colours[index].1.or(free);
            }
        }
        move |method| Look {
            kind: self.method(method).map_or(Kind::Peer, |known| known.kind),
            colour: colours
                .iter()
                .find(|(known, _)| *known == method)
                .and_then(|(_, colour)| *colour),
        }
    }

    /// CPU time against error.
    pub(super) fn time_plot(&self, problem: &ProblemRecord) -> Option<Plot> {
        self.work_plot(problem, "CPU time against error", "CPU time in s", |run| {
            run.seconds
        })
    }

    /// Evaluations against error.
    pub(super) fn evaluations_plot(&self, problem: &ProblemRecord) -> Option<Plot> {
        let label = "evaluations of velocities and forces";
        self.work_plot(problem, "evaluations against error", label, |run| {
            run.evaluations as f64
        })
    }

    fn work_plot(
        &self,
        problem: &ProblemRecord,
        subtitle: &str,
        label: &str,
        work: impl Fn(&Measured) -> f64,
    ) -> Option<Plot> {
        let look = self.looks(problem);
        let curves: Vec<Drawn> = problem
            .curves
            .iter()
            .map(|curve| {
                let runs = curve
                    .measured()
                    .filter(|(_, run)| run.error < DRAWN && work(run) > 0.0);
                let points = runs.map(|(parameter, run)| {
                    let words = format!(
                        "{}: {}",
                        curve.method,
                        describe(curve.parameter, parameter, run)
                    );
                    (run.error.max(NOTHING), work(run), words)
                });
                Drawn {
                    name: curve.method.clone(),
                    look: look(&curve.method),
                    shape: Shape::Marks(points.collect()),
                }
            })
            .collect();
        let points = || {
            let shapes = curves.iter().map(|curve| &curve.shape);
            shapes.flat_map(|shape| match shape {
                Shape::Marks(points) => points.as_slice(),
                Shape::Line(_) | Shape::Band(_) => &[],
            })
        };
        let x = Axis::decades(
            "global error at the end",
            points().map(|(x, ..)| *x).chain([DRAWN]),
        )?;
        let y = Axis::decades(label, points().map(|(_, y, _)| *y))?;
        Some(Plot {
            chart: Chart {
                title: problem.name.clone(),
                subtitle: subtitle.into(),
                x: x.reversed(),
                y,
                curves,
                unknown: Some((problem.uncertainty, "the reference is no better")),
            },
        })
    }

    /// The error of the energy over time: signed if the problem prescribes a step size, otherwise on a logarithmic
    /// scale.
    pub(super) fn energy_plot(&self, problem: &ProblemRecord) -> Option<Plot> {
        let traced = || {
            let curves = problem.curves.iter();
            curves.filter_map(|curve| Some((curve, curve.trace.as_ref()?)))
        };
        let look = self.looks(problem);
        let drawn = |curve: &Curve, shape| Drawn {
            name: curve.method.clone(),
            look: look(&curve.method),
            shape,
        };
        let span = problem.end - problem.start;
        let time = |trace: &Trace, index: usize| {
            problem.start + span * (index as f64 + 0.5) / trace.ranges.len() as f64
        };
        let x = Axis {
            label: "time".into(),
            scale: Scale::Linear,
            from: problem.start,
            to: problem.end,
        };
        let (y, subtitle, curves): (_, String, Vec<Drawn>) = if let Some(size) = problem.traced_at {
            let curves = traced().map(|(curve, trace)| {
                let ranges = trace.ranges.iter().enumerate();
                let band = ranges.filter_map(|(index, range)| {
                    range.map(|(low, high)| (time(trace, index), low, high))
                });
                drawn(curve, Shape::Band(band.collect()))
            });
            let values = traced().flat_map(|(_, trace)| trace.ranges.iter().flatten());
            let values = values.flat_map(|(low, high)| [*low, *high]);
            let y = Axis::linear("relative change of the energy", values)?;
            let subtitle = format!("change of the energy over time, in steps of {size}");
            (y, subtitle, curves.collect())
        } else {
            let magnitude = |(low, high): (f64, f64)| low.abs().max(high.abs()).max(NOTHING);
            let curves = traced().map(|(curve, trace)| {
                let ranges = trace.ranges.iter().enumerate();
                let line = ranges.filter_map(|(index, range)| {
                    // Intervals without an observed state are skipped, not drawn as gaps.
                    range.map(|range| Some((time(trace, index), magnitude(range))))
                });
                drawn(curve, Shape::Line(line.collect()))
            });
            let values = traced().flat_map(|(_, trace)| trace.ranges.iter().flatten());
            let y = Axis::decades(
                "relative error of the energy",
                values.map(|range| magnitude(*range)),
            )?;
            let subtitle = "error of the energy over time, with about as many evaluations";
            (y, subtitle.into(), curves.collect())
        };
        Some(Plot {
            chart: Chart {
                title: problem.name.clone(),
                subtitle,
                x,
                y,
                curves,
                unknown: None,
            },
        })
    }
}

/// The description of a run.
fn describe(kind: Parameter, parameter: f64, run: &Measured) -> String {
    let of = match kind {
        Parameter::StepSize => format!("step size {}", text::scientific(parameter)),
        Parameter::Tolerance => format!("tolerance {}", text::scientific(parameter)),
    };
    format!(
        "error {} in {}, {} evaluations, {of}",
        text::scientific(run.error),
        text::seconds(run.seconds),
        text::grouped(run.evaluations),
    )
}

/// A file name: lower-case letters and digits, with hyphens for other characters.
pub(super) fn file_name(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars().flat_map(char::to_lowercase) {
        match c {
            'é' | 'è' => text.push('e'),
            'ö' => text.push('o'),
            'ä' => text.push('a'),
            'ü' => text.push('u'),
            c if c.is_ascii_alphanumeric() => text.push(c),
            _ if text.is_empty() || text.ends_with('-') => {}
            _ => text.push('-'),
        }
    }
    text.trim_end_matches('-').into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::measurements;

    #[test]
    fn plots_are_well_formed_in_all_schemes() {
        let mut found = measurements();
        for traced_at in [None, Some(0.5)] {
            found.problems[0].traced_at = traced_at;
            let plots = found.plots();
            let names: Vec<&str> = plots.iter().map(|(name, _)| name.as_str()).collect();
            assert_eq!(
                names,
                [
                    "kepler-co-time",
                    "kepler-co-evaluations",
                    "kepler-co-energy"
                ]
            );
            for (name, plot) in &plots {
                for scheme in [Scheme::Light, Scheme::Dark, Scheme::Reader] {
                    let svg = plot.svg(scheme);
                    let document = roxmltree::Document::parse(&svg).expect(name);
                    let texts: Vec<&str> = document
                        .descendants()
                        .filter(|node| {
                            node.has_tag_name("text") || node.tag_name().name() == "text"
                        })
                        .filter_map(|node| node.text())
                        .collect();
                    assert!(
                        texts.contains(&"Kepler & co") && texts.contains(&"Verlet"),
                        "{texts:?}"
                    );
                    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
                    assert_eq!(
                        svg.contains("prefers-color-scheme"),
                        scheme == Scheme::Reader
                    );
                }
            }
        }
    }

    #[test]
    fn the_same_measurements_are_the_same_plots() {
        let draw = || {
            let plots = measurements().plots().into_iter();
            plots
                .map(|(_, plot)| plot.svg(Scheme::Reader))
                .collect::<Vec<_>>()
        };
        assert_eq!(draw(), draw());
    }

    #[test]
    fn every_run_below_one_has_a_mark() {
        let found = measurements();
        let plot = found.time_plot(&found.problems[0]).expect("there are runs");
        let svg = plot.svg(Scheme::Light);
        // Two marks of Verlet, three of Gauss, two of the peer, and one per kind in the key.
        assert_eq!(svg.matches("<circle").count(), 2 + 1);
        assert_eq!(svg.matches("l3.8 6.6h-7.6z").count(), 2 + 1);
        assert_eq!(svg.matches("<rect").count(), 3 + 1 + 1);
        assert!(svg.contains("Gauss 4: error 1.0·10⁻⁷ in 2.00 ms"), "{svg}");
    }

    #[test]
    fn eight_curves_have_eight_colours_and_their_names() {
        let mut found = measurements();
        for name in ["A", "B", "C", "D", "E"] {
            let runs = [(1e-2, 1e-2), (1e-4, 1e-1)];
            found.problems[0]
                .curves
                .push(crate::tests::curve(name, &runs));
        }
        let look = found.looks(&found.problems[0]);
        let methods = found.problems[0].curves.iter();
        let mut colours: Vec<_> = methods.map(|curve| look(&curve.method).colour).collect();
        colours.sort_unstable();
        assert_eq!(colours, (0..8).map(Some).collect::<Vec<_>>());
        let plot = found.time_plot(&found.problems[0]).expect("there are runs");
        let svg = plot.svg(Scheme::Light);
        for curve in &found.problems[0].curves {
            assert!(svg.contains(&format!(">{}</text>", curve.method)), "{svg}");
        }
    }

    #[test]
    fn a_study_without_curves_has_no_plots() {
        let mut found = measurements();
        found.problems[0].curves.clear();
        assert!(found.plots().is_empty());
    }

    #[test]
    fn names_of_problems_become_names_of_files() {
        assert_eq!(file_name("Hénon–Heiles, E = 1/8"), "henon-heiles-e-1-8");
        assert_eq!(file_name("(q² + 1)"), "q-1");
    }
}
