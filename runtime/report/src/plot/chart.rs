//! A chart: axes, curves, and their names.

use core::fmt::Write;

use super::axis::Axis;
use super::element::{Element, Pixels};
use super::labels::{self, Area};
use super::look::{self, Look};
use crate::Kind;

/// The width of a chart, including texts.
pub const WIDTH: f64 = 820.0;
/// The height of a chart without the key of its pale curves.
const HEIGHT: f64 = 470.0;
/// The height of a line of the key.
const LINE: f64 = 17.0;
/// Between entries of the key.
const SEPARATOR: &str = "  ·  ";

/// The area of the curves.
const INNER: Area = Area {
    left: 72.0,
    top: 62.0,
    right: 628.0,
    bottom: 414.0,
};

/// Left end of the column of names of curves that end on the right.
const COLUMN: f64 = INNER.right + 16.0;

/// The content of a chart.
#[derive(Clone, Debug)]
pub struct Chart {
    pub title: String,
    pub subtitle: String,
    pub x: Axis,
    pub y: Axis,
    pub curves: Vec<Drawn>,
    /// The shaded region from this value of x to the end of the axis, where the reference is too inaccurate; and its
    /// label.
    pub unknown: Option<(f64, &'static str)>,
}

/// A curve in a chart.
#[derive(Clone, Debug)]
pub struct Drawn {
    pub name: String,
    pub look: Look,
    pub shape: Shape,
}

/// The shape of a curve.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Marks joined by lines, with a text for each mark.
    Marks(Vec<(f64, f64, String)>),
    /// A line, with gaps.
    Line(Vec<Option<(f64, f64)>>),
    /// The area between a lower and an upper line: x, lower y, upper y.
    Band(Vec<(f64, f64, f64)>),
}

impl Chart {
    /// The height of the chart.
    pub fn height(&self) -> f64 {
        match self.pale_key().len() {
            0 => HEIGHT,
            lines => HEIGHT + LINE * (lines as f64 + 0.4),
        }
    }

    /// The pale curves: their numbers begin with 1.
    fn pale(&self) -> Vec<&Drawn> {
        let curves = self.curves.iter();
        curves
            .filter(|curve| curve.look.colour.is_none() && !self.line(curve).is_empty())
            .collect()
    }

    /// The lines of the key of the pale curves.
    fn pale_key(&self) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for (index, curve) in self.pale().into_iter().enumerate() {
            let entry = format!("{} {}", index + 1, curve.name);
            match lines.last_mut() {
                Some(line)
                    if labels::width(&[line, SEPARATOR, &entry].concat()) < WIDTH - INNER.left =>
                {
                    line.push_str(SEPARATOR);
                    line.push_str(&entry);
                }
                _ => lines.push(entry),
            }
        }
        lines
    }

    /// The elements of the chart, in a rectangle of [`WIDTH`] and [`height`](Self::height).
    pub fn elements(&self) -> Vec<Element> {
        let mut elements = vec![
            Element::new("rect")
                .with("class", "background")
                .at("width", WIDTH)
                .at("height", self.height()),
            text(INNER.left, 26.0, "ink", &self.title)
                .with("font-size", 16)
                .with("font-weight", 600),
            text(INNER.left, 46.0, "muted", &self.subtitle),
        ];
        elements.extend(self.key());
        elements.extend(self.unknown_area());
        elements.extend(self.grid());
        // Coloured curves are drawn over pale ones, but their names are placed first.
        let coloured = self.curves.iter();
        let coloured: Vec<&Drawn> = coloured
            .filter(|curve| curve.look.colour.is_some())
            .collect();
        let (coloured, taken) = self.groups(&coloured, &[], COLUMN);
        let pale = self.pale();
        let numbers = self.numbers(&pale, &taken);
        let (pale, _) = self.groups(&pale, &taken, f64::INFINITY);
        elements.extend(pale);
        elements.extend(coloured);
        elements.extend(numbers);
        for (index, line) in self.pale_key().iter().enumerate() {
            let y = HEIGHT + LINE * (index as f64 + 0.4);
            elements.push(text(INNER.left, y, "muted", line).with("font-size", 12));
        }
        elements
    }

    /// The numbers of pale curves at their ends.
    fn numbers(&self, pale: &[&Drawn], taken: &[Area]) -> Vec<Element> {
        let ends = pale.iter().enumerate().filter_map(|(index, curve)| {
            Some(((index + 1).to_string(), self.line(curve).last().copied()?))
        });
        let ends: Vec<(String, (f64, f64))> = ends.collect();
        let ends: Vec<(&str, (f64, f64))> = ends
            .iter()
            .map(|(number, end)| (number.as_str(), *end))
            .collect();
        let frame = Area {
            right: WIDTH - 2.0,
            ..INNER
        };
        let areas = labels::place(&ends, &[], taken, &frame, f64::INFINITY);
        let numbers = ends.iter().zip(areas).map(|((number, _), area)| {
            let y = (area.top + area.bottom) / 2.0 + 4.0;
            text(area.left, y, "label muted", number).with("font-size", 11)
        });
        numbers.collect()
    }

    /// Draws curves with their names; also returns the areas of the names.
    fn groups(&self, curves: &[&Drawn], taken: &[Area], column: f64) -> (Vec<Element>, Vec<Area>) {
        let lines: Vec<Vec<(f64, f64)>> = curves.iter().map(|curve| self.line(curve)).collect();
        let ends: Vec<Option<(f64, f64)>> = lines.iter().map(|line| line.last().copied()).collect();
        let labelled: Vec<(&str, (f64, f64))> = curves
            .iter()
            .zip(&ends)
            .filter_map(|(curve, end)| Some((curve.name.as_str(), (*end)?)))
            .collect();
        let frame = Area {
            left: INNER.left,
            right: WIDTH - 2.0,
            ..INNER
        };
        let areas = labels::place(&labelled, &lines, taken, &frame, column);
        let mut places = areas.iter();
        let mut groups = Vec::new();
        for (curve, end) in curves.iter().zip(ends) {
            let group = Element::new("g");
            let group = match curve.look.colour {
                Some(_) => group.with("class", "curve"),
                None => group
                    .with("class", "curve pale")
                    .with("data-method", &curve.name),
            };
            let mut group = group.children(self.draw(curve));
            if let (Some(end), Some(area)) = (end, end.and_then(|_| places.next())) {
                group = group.children(label(&curve.name, curve.look, end, area));
            }
            groups.push(group);
        }
        (groups, areas)
    }

    fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (
            INNER.left + (INNER.right - INNER.left) * self.x.place(x),
            INNER.bottom - (INNER.bottom - INNER.top) * self.y.place(y),
        )
    }

    /// The key of the marks in use.
    fn key(&self) -> Vec<Element> {
        let kinds = [
            (Kind::Explicit, "explicit"),
            (Kind::Implicit, "implicit"),
            (Kind::Peer, "other"),
        ];
        let has_marks = |curve: &Drawn| matches!(curve.shape, Shape::Marks(_));
        let mut x = INNER.right;
        let mut elements = Vec::new();
        for (kind, name) in kinds.into_iter().rev() {
            let used = self
                .curves
                .iter()
                .any(|curve| curve.look.kind == kind && has_marks(curve));
            if used {
                x -= labels::width(name);
                elements.push(text(x, 46.0, "muted", name).with("font-size", 12));
                x -= 10.0;
                elements.push(look::key(kind, x, 42.0));
                x -= 16.0;
            }
        }
        elements
    }

    fn unknown_area(&self) -> Vec<Element> {
        let Some((value, words)) = self.unknown else {
            return Vec::new();
        };
        let place = self.x.place(value);
        if !(0.0..1.0).contains(&place) {
            return Vec::new();
        }
        let left = INNER.left + (INNER.right - INNER.left) * place;
        let mut elements = vec![
            Element::new("rect")
                .with("class", "unknown")
                .at("x", left)
                .at("y", INNER.top)
                .at("width", INNER.right - left)
                .at("height", INNER.bottom - INNER.top)
                .child(Element::new("title").text(words)),
        ];
        if INNER.right - left > 1.1 * labels::width(words) {
            elements.push(
                text(INNER.right - 6.0, INNER.bottom - 8.0, "muted", words)
                    .with("text-anchor", "end")
                    .with("font-size", 11),
            );
        }
        elements
    }

    fn grid(&self) -> Vec<Element> {
        let line = |class, (x1, y1): (f64, f64), (x2, y2): (f64, f64)| {
            let line = Element::new("line").with("class", class);
            line.at("x1", x1).at("y1", y1).at("x2", x2).at("y2", y2)
        };
        let Area {
            left,
            top,
            right,
            bottom,
        } = INNER;
        let column = |value| left + (right - left) * self.x.place(value);
        let row = |value| bottom - (bottom - top) * self.y.place(value);
        let mut elements = Vec::new();
        for (value, name) in self.x.ticks() {
            let x = column(value);
            elements.push(line("grid", (x, top), (x, bottom)));
            elements.push(text(x, bottom + 19.0, "muted", &name).with("text-anchor", "middle"));
        }
        for (value, name) in self.y.ticks() {
            let y = row(value);
            elements.push(line("grid", (left, y), (right, y)));
            elements.push(text(left - 9.0, y + 4.0, "muted", &name).with("text-anchor", "end"));
        }
        for value in self.x.minor_ticks() {
            elements.push(line(
                "frame",
                (column(value), bottom),
                (column(value), bottom + 3.0),
            ));
        }
        for value in self.y.minor_ticks() {
            elements.push(line("frame", (left - 3.0, row(value)), (left, row(value))));
        }
        let corner = format!("M{left} {top}V{bottom}H{right}");
        elements.push(
            Element::new("path")
                .with("class", "frame")
                .with("d", corner),
        );
        let middle = (top + bottom) / 2.0;
        elements.push(
            text((left + right) / 2.0, bottom + 42.0, "ink", &self.x.label)
                .with("text-anchor", "middle"),
        );
        elements.push(
            text(20.0, middle, "ink", &self.y.label)
                .with("text-anchor", "middle")
                .with("transform", format!("rotate(-90 20 {})", Pixels(middle))),
        );
        elements
    }

    /// The positions of the points of a curve, in pixels.
    fn line(&self, curve: &Drawn) -> Vec<(f64, f64)> {
        match &curve.shape {
            Shape::Marks(points) => points
                .iter()
                .map(|(x, y, _)| self.place((*x, *y)))
                .collect(),
            Shape::Line(points) => points
                .iter()
                .flatten()
                .map(|point| self.place(*point))
                .collect(),
            Shape::Band(points) => points
                .iter()
                .map(|(x, low, high)| self.place((*x, (low + high) / 2.0)))
                .collect(),
        }
    }

    fn draw(&self, curve: &Drawn) -> Vec<Element> {
        let look = curve.look;
        let stroke = |path: String, width: &str| {
            let line = Element::new("path")
                .with("class", look.line())
                .with("fill", "none")
                .with("stroke-width", width)
                .with("stroke-linejoin", "round")
                .with("d", path);
            match look.dashes() {
                Some(dashes) => line.with("stroke-dasharray", dashes),
                None => line,
            }
        };
        let width = |coloured| {
            if look.colour.is_some() {
                coloured
            } else {
                "1.1"
            }
        };
        // The area that reacts to the mouse is wider than the visible line.
        let hit = |path: &str| {
            let title = Element::new("title").text(curve.name.as_str());
            Element::new("path")
                .with("class", "hit")
                .with("d", path)
                .child(title)
        };
        match &curve.shape {
            Shape::Marks(points) => {
                let line = self.line(curve);
                let whole = path(&line);
                let mut elements = vec![hit(&whole), stroke(whole, width("2"))];
                for ((x, y), (_, _, words)) in line.into_iter().zip(points) {
                    let title = Element::new("title").text(words.as_str());
                    elements.push(look.mark(x, y).child(title));
                }
                elements
            }
            Shape::Line(points) => {
                let parts = points.split(Option::is_none);
                let paths = parts.map(|part| {
                    path(
                        &part
                            .iter()
                            .flatten()
                            .map(|point| self.place(*point))
                            .collect::<Vec<_>>(),
                    )
                });
                let paths: String = paths.collect();
                vec![hit(&paths), stroke(paths, width("1.6"))]
            }
            Shape::Band(points) => {
                let low = points.iter().map(|(x, low, _)| self.place((*x, *low)));
                let high = points.iter().map(|(x, _, high)| self.place((*x, *high)));
                let area: Vec<(f64, f64)> = low.chain(high.rev()).collect();
                let area = path(&area) + "Z";
                vec![
                    hit(&area),
                    Element::new("path")
                        .with("class", look.area())
                        .with("fill-opacity", "0.3")
                        .with("d", area.as_str())
                        .child(Element::new("title").text(curve.name.as_str())),
                    stroke(area, "1"),
                ]
            }
        }
    }
}

/// The name of a curve, with a leader line if it is far from the end of the curve.
fn label(name: &str, look: Look, end: (f64, f64), area: &Area) -> Vec<Element> {
    let middle = (area.top + area.bottom) / 2.0;
    let mut elements = Vec::new();
    if labels::distance(area, end) > 14.0 {
        // The leader ends at the nearest point of the text.
        let x = end.0.clamp(area.left - 3.0, area.right + 3.0);
        let leader = Element::new("path")
            .with("class", format!("leader {}", look.line()))
            .with("d", path(&[end, (x, middle)]));
        elements.push(leader);
    }
    let class = format!("label {}", look.letters());
    elements.push(text(area.left, middle + 4.3, &class, name).with("font-size", 12));
    elements
}

fn text(x: f64, y: f64, class: &str, words: &str) -> Element {
    Element::new("text")
        .with("class", class)
        .at("x", x)
        .at("y", y)
        .text(words)
}

/// An SVG path of straight lines.
fn path(points: &[(f64, f64)]) -> String {
    let mut path = String::new();
    for (index, (x, y)) in points.iter().enumerate() {
        let letter = if index == 0 { 'M' } else { 'L' };
        let written = write!(path, "{letter}{} {}", Pixels(*x), Pixels(*y));
        debug_assert!(written.is_ok(), "a string takes all");
    }
    path
}
