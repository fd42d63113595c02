//! Colours and marks.

use core::fmt::Write;

use super::element::{Element, Pixels};
use crate::Kind;

/// The background of a plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// Light.
    Light,
    /// Dark.
    Dark,
    /// As the reader's system prefers.
    Reader,
}

/// Six colours of the colour-blind safe palette of M. Okabe & K. Ito (2008), brightened for dark backgrounds, with brown
/// and violet. Texts need more contrast than lines and marks.
struct Palette {
    background: &'static str,
    ink: &'static str,
    muted: &'static str,
    grid: &'static str,
    /// Curves in the background.
    pale: &'static str,
    lines: [&'static str; COLOURS],
    texts: [&'static str; COLOURS],
}

/// Number of colours. The first belong to the [roles](crate::Role).
pub const COLOURS: usize = 8;

const LIGHT: Palette = Palette {
    background: "#ffffff",
    ink: "#1b1f24",
    muted: "#5b6570",
    grid: "#e9ecf0",
    pale: "#c6ccd3",
    lines: [
        "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5230", "#6a3d9a",
    ],
    texts: [
        "#00609a", "#b04c00", "#007354", "#a34a7c", "#8a5f00", "#23719f", "#6b4628", "#6a3d9a",
    ],
};

const DARK: Palette = Palette {
    background: "#14181d",
    ink: "#e6e9ec",
    muted: "#98a2ad",
    grid: "#242a33",
    pale: "#464f5a",
    lines: [
        "#3b9ade", "#ee7733", "#1dbb8c", "#dd94bb", "#e9a820", "#9bd3f5", "#b8895f", "#a985dd",
    ],
    texts: [
        "#6fb6ea", "#f59a66", "#45cfa5", "#e6acca", "#efbb50", "#b5dff8", "#cda480", "#c3a8ea",
    ],
};

/// The style sheet of plots.
pub fn style(scheme: Scheme) -> String {
    match scheme {
        Scheme::Light => rules(&LIGHT),
        Scheme::Dark => rules(&DARK),
        Scheme::Reader => format!(
            "{}@media (prefers-color-scheme: dark) {{\n{}}}\n",
            rules(&LIGHT),
            rules(&DARK)
        ),
    }
}

fn rules(palette: &Palette) -> String {
    let Palette {
        background,
        ink,
        muted,
        grid,
        pale,
        ..
    } = palette;
    let mut text = format!(
        ".background {{ fill: {background} }}\n\
         .ink {{ fill: {ink} }}\n\
         .muted {{ fill: {muted} }}\n\
         .grid {{ stroke: {grid}; stroke-width: 1 }}\n\
         .frame {{ stroke: {muted}; stroke-width: 1; fill: none }}\n\
         .leader {{ stroke-width: 0.8; fill: none; opacity: 0.75 }}\n\
         .unknown {{ fill: {muted}; fill-opacity: 0.13 }}\n\
         .label {{ stroke: {background}; stroke-width: 3px; stroke-linejoin: round; paint-order: stroke }}\n\
         .key {{ fill: {muted} }}\n\
         .hit {{ fill: none; stroke: transparent; stroke-width: 11; pointer-events: stroke }}\n\
         .pale .line {{ stroke: {pale} }}\n\
         .pale .fill {{ fill: {pale} }}\n\
         .pale .label, .pale .leader {{ visibility: hidden }}\n\
         .pale:hover .line, .forward .line {{ stroke: {ink} }}\n\
         .pale:hover .fill, .forward .fill {{ fill: {ink} }}\n\
         .pale:hover .label, .forward .label {{ visibility: visible; fill: {ink} }}\n\
         .pale:hover .leader, .forward .leader {{ visibility: visible }}\n"
    );
    for (index, (line, letters)) in palette.lines.iter().zip(&palette.texts).enumerate() {
        let written = writeln!(
            text,
            ".line{index} {{ stroke: {line} }}\n.fill{index} {{ fill: {line} }}\n.text{index} {{ fill: {letters} }}"
        );
        debug_assert!(written.is_ok(), "a string takes all");
    }
    text
}

/// The appearance of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    pub kind: Kind,
    /// The colour, below [`COLOURS`]; pale grey without one.
    pub colour: Option<usize>,
}

impl Look {
    fn class(self, what: &str) -> String {
        match self.colour {
            Some(colour) => format!("{what}{colour}"),
            None => what.into(),
        }
    }

    /// CSS class of a line.
    pub fn line(self) -> String {
        self.class("line")
    }

    /// CSS class of an area or a mark.
    pub fn area(self) -> String {
        self.class("fill")
    }

    /// CSS class of a text.
    pub fn letters(self) -> String {
        self.class("text")
    }

    /// The dashes of a line, for methods from elsewhere.
    pub fn dashes(self) -> Option<&'static str> {
        (self.kind == Kind::Peer).then_some("5 3")
    }

    /// A mark: a disc for explicit methods, a square for implicit methods, a triangle for others.
    pub fn mark(self, x: f64, y: f64) -> Element {
        mark(self.kind, x, y).with("class", self.area())
    }
}

/// The mark of a kind, for the key.
pub fn key(kind: Kind, x: f64, y: f64) -> Element {
    mark(kind, x, y).with("class", "key")
}

fn mark(kind: Kind, x: f64, y: f64) -> Element {
    match kind {
        Kind::Explicit => Element::new("circle")
            .at("cx", x)
            .at("cy", y)
            .with("r", "3.2"),
        Kind::Implicit => Element::new("rect")
            .at("x", x - 2.9)
            .at("y", y - 2.9)
            .with("width", "5.8")
            .with("height", "5.8"),
        Kind::Peer => Element::new("path").with(
            "d",
            format!("M{} {}l3.8 6.6h-7.6z", Pixels(x), Pixels(y - 4.2)),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The relative luminance of a colour (WCAG 2).
    fn luminance(colour: &str) -> f64 {
        let channel = |start: usize| {
            let value = u8::from_str_radix(&colour[start..start + 2], 16).expect("two hex digits");
            let value = f64::from(value) / 255.0;
            if value <= 0.04045 {
                value / 12.92
            } else {
                ((value + 0.055) / 1.055).powf(2.4)
            }
        };
        0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5)
    }

    #[test]
    fn texts_are_legible_and_lines_visible() {
        for palette in [LIGHT, DARK] {
            let contrast = |colour: &str| {
                let (a, b) = (
                    luminance(colour) + 0.05,
                    luminance(palette.background) + 0.05,
                );
                if a > b { a / b } else { b / a }
            };
            for text in palette.texts.iter().chain([&palette.ink, &palette.muted]) {
                assert!(contrast(text) >= 4.5, "{text}: {}", contrast(text));
            }
            for line in palette.lines {
                assert!(contrast(line) >= 2.0, "{line}: {}", contrast(line));
            }
            assert!(contrast(palette.grid) < contrast(palette.pale));
            // Pale curves are visible, with less contrast than coloured ones.
            let nearest = palette.lines.iter().map(|line| contrast(line));
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            assert!(contrast(palette.pale) >= 1.5 && contrast(palette.pale) <= 0.8 * nearest);
        }
    }
}
