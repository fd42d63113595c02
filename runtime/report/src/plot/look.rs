//! Colours and shapes.

use core::fmt::Write;

use super::element::{Element, Pixels};
use crate::{Kind, Measurements};

/// For what background a plot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// A light one.
    Light,
    /// A dark one.
    Dark,
    /// The one that the reader prefers: light, or dark where the reader's system is.
    Reader,
}

/// Colours that are told apart by all: those of M. Okabe & K. Ito (2008) without yellow, brighter on a dark background
/// where they would be hard to see. For lines and marks, and for texts, which need more contrast.
struct Palette {
    background: &'static str,
    ink: &'static str,
    muted: &'static str,
    grid: &'static str,
    lines: [&'static str; COLOURS],
    texts: [&'static str; COLOURS],
}

/// Number of colours.
const COLOURS: usize = 7;

const LIGHT: Palette = Palette {
    background: "#ffffff",
    ink: "#1b1f24",
    muted: "#5b6570",
    grid: "#e4e8ec",
    lines: [
        "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#444444",
    ],
    texts: [
        "#00609a", "#b04c00", "#007354", "#a34a7c", "#8a5f00", "#1d719f", "#333333",
    ],
};

const DARK: Palette = Palette {
    background: "#14181d",
    ink: "#e6e9ec",
    muted: "#98a2ad",
    grid: "#29303a",
    lines: [
        "#3b9ade", "#ee7733", "#1dbb8c", "#dd94bb", "#e9a820", "#8fd0f5", "#c9ced3",
    ],
    texts: [
        "#6fb6ea", "#f59a66", "#45cfa5", "#e6acca", "#efbb50", "#a5daf8", "#d5d9dd",
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
         .hollow {{ fill: {background}; stroke-width: 1.6 }}\n"
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

/// What the curves of a method look like in all plots of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    pub kind: Kind,
    /// Its place among all methods.
    index: usize,
}

impl Look {
    const fn new(kind: Kind, index: usize) -> Self {
        Self { kind, index }
    }

    /// The look of a method; that of an unknown one is the first.
    pub fn of(method: &str, measurements: &Measurements) -> Self {
        let mut methods = measurements.methods.iter().enumerate();
        let found = methods.find(|(_, record)| record.name == method);
        found.map_or(Self::new(Kind::Peer, 0), |(index, record)| {
            Self::new(record.kind, index)
        })
    }

    /// The look of a mark that stands for its kind only: grey.
    pub const fn grey(kind: Kind) -> Self {
        Self::new(kind, COLOURS - 1)
    }

    const fn colour(self) -> usize {
        self.index % COLOURS
    }

    /// How often all colours are used up before it: marks and lines tell those of one colour apart.
    const fn round(self) -> usize {
        self.index / COLOURS
    }

    /// Whether marks are hollow.
    const fn is_hollow(self) -> bool {
        self.round() % 2 == 1
    }

    /// The classes of a line.
    pub fn line(self) -> String {
        format!("line{}", self.colour())
    }

    /// The classes of an area.
    pub fn area(self) -> String {
        format!("fill{}", self.colour())
    }

    /// The classes of a text.
    pub fn letters(self) -> String {
        format!("text{}", self.colour())
    }

    /// The dashes of a line: short ones for methods that are not of the library, long ones where a colour comes again.
    pub const fn dashes(self) -> Option<&'static str> {
        match (self.kind, self.round() % 4) {
            (Kind::Peer, 0) => Some("5 3"),
            (Kind::Peer, 1) => Some("5 3 1.5 3"),
            (Kind::Peer, 2) => Some("5 3 1.5 3 1.5 3"),
            (Kind::Peer, _) => Some("2 3"),
            (_, 0) => None,
            (_, 1) => Some("14 3"),
            (_, 2) => Some("14 3 2.5 3"),
            (_, _) => Some("14 3 2.5 3 2.5 3"),
        }
    }

    /// A mark at a place: a disc for explicit methods, a square for implicit ones, a triangle for others.
    pub fn mark(self, x: f64, y: f64) -> Element {
        let class = if self.is_hollow() {
            format!("hollow {}", self.line())
        } else {
            self.area()
        };
        match self.kind {
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
        .with("class", class)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

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
    fn methods_of_one_colour_are_told_apart_without_it() {
        for kind in [Kind::Explicit, Kind::Implicit, Kind::Peer] {
            for colour in 0..COLOURS {
                let looks = (0..4).map(|round| Look::new(kind, colour + round * COLOURS));
                let seen: BTreeSet<_> = looks
                    .map(|look| {
                        assert_eq!(look.line(), Look::new(kind, colour).line());
                        look.dashes()
                    })
                    .collect();
                assert_eq!(seen.len(), 4);
            }
        }
        // A peer is none of the library's either.
        let of = |kind| (0..4).map(move |round| Look::new(kind, round * COLOURS).dashes());
        assert!(of(Kind::Peer).all(|dashes| of(Kind::Implicit).all(|other| other != dashes)));
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
            assert!(contrast(palette.grid) < 2.0);
        }
    }
}
