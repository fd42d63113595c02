//! The largest distance between coordinates in a formula.

use super::graph::{Base, Coordinate, Index, LoopRange};
use super::syntax::Length;
use super::system::System;

/// The largest `|i − j|` of the components `i` and `j` of two coordinates, if it is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Distance {
    /// A number, independent of the parameters.
    Number(u64),
    /// For indices `k` and `l` in the pairs of a parameter: the largest `components·|k − l| + more`.
    OfPairs {
        /// The index of the parameter.
        list: usize,
        /// The number of components of each coordinate.
        components: u64,
        /// The constant that is added.
        more: u64,
    },
}

/// The largest distance of two coordinates inside the same loops.
pub fn distance(system: &System, [a, b]: [&Coordinate; 2]) -> Option<Distance> {
    let components = system.layout.components() as i64;
    let within = a.component as i64 - b.component as i64;
    if let (Base::Pair(id, 0 | 1), Base::Pair(other, 0 | 1)) = (&a.index.base, &b.index.base)
        && id == other
        && a.index.base != b.index.base
    {
        let LoopRange::List(list) = system.graph.get_loop(*id).range else {
            return None;
        };
        let offsets = a.index.offset.abs_diff(b.index.offset);
        let components = components as u64;
        return Some(Distance::OfPairs {
            list,
            components,
            more: offsets.saturating_mul(components) + within.unsigned_abs(),
        });
    }
    let [a, b] = [a, b].map(|coordinate| spans(system, &coordinate.index));
    let pairs = a.iter().flat_map(|a| b.iter().map(move |b| (a, b)));
    let distances = pairs.filter(|(a, b)| a.base == b.base).map(|(a, b)| {
        let ends = [
            a.last.saturating_sub(b.first),
            a.first.saturating_sub(b.last),
        ];
        let ends = ends.map(|indices| indices.saturating_mul(components).saturating_add(within));
        ends[0].unsigned_abs().max(ends[1].unsigned_abs())
    });
    distances.min().map(Distance::Number)
}

/// Bounds of an index: it lies between `base + first` and `base + last`.
struct Span {
    base: Base,
    first: i64,
    last: i64,
}

/// All known bounds of an index: by its own base, by that of the range of its loop, and so on.
fn spans(system: &System, index: &Index) -> Vec<Span> {
    let mut spans = Vec::new();
    let mut next = Some(Span {
        base: index.base.clone(),
        first: index.offset,
        last: index.offset,
    });
    while let Some(span) = next {
        next = match &span.base {
            Base::Loop(id) => match &system.graph.get_loop(*id).range {
                LoopRange::Between(start, end) => {
                    let [start, end] = [start, end].map(from_start);
                    (start.base == end.base).then(|| Span {
                        first: span.first.saturating_add(start.offset),
                        last: span.last.saturating_add(end.offset - 1),
                        base: start.base,
                    })
                }
                LoopRange::List(_) => None,
            },
            _ => None,
        };
        spans.push(span);
    }
    if let Some(Span { base, first, last }) = spans.last_mut()
        && let Base::End(Length::Fixed(n)) = base
    {
        (*first, *last) = (
            first.saturating_add(*n as i64),
            last.saturating_add(*n as i64),
        );
        *base = Base::Start;
    }
    spans
}

/// The same index, counted from the start if the length is a number.
fn from_start(index: &Index) -> Index {
    match index.base {
        Base::End(Length::Fixed(n)) => Index::number(index.offset.saturating_add(n as i64)),
        _ => index.clone(),
    }
}
