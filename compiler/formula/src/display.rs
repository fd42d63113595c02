//! Formulas as text and as LaTeX.

use std::collections::HashMap;

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::derivative::Scatter;
use super::elaborate::STRETCH;
use super::graph::{Base, Coordinate, Half, Id, Index, LoopId, LoopRange, Node, Number};
use super::syntax::Length;
use super::system::{Layout, System};

/// The notation of formulas.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Notation {
    /// On one line, with Unicode letters.
    Text,
    /// For LaTeX and KaTeX.
    Latex,
}

/// How strongly a formula binds: a formula weaker than its surroundings needs brackets.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Strength {
    Sum,
    Product,
    Power,
    Atom,
}

/// The texts of nodes written so far.
pub(super) type Texts = HashMap<Id, (String, Strength)>;

/// Longest formula that is written out.
pub(super) const MAX_CHARACTERS: usize = 20_000;

impl System {
    /// A node as a formula.
    pub fn formula(&self, id: Id, notation: Notation) -> String {
        let mut texts = Texts::new();
        for next in self.graph.below([id]) {
            let text = self.write(next, notation, &texts);
            if text.0.len() > MAX_CHARACTERS {
                return "…".to_owned();
            }
            texts.insert(next, text);
        }
        texts.remove(&id).map_or_else(String::new, |(text, _)| text)
    }

    /// The rates of friction, as one formula or as a list.
    pub(super) fn rates(&self, notation: Notation) -> String {
        let rates = self
            .friction
            .iter()
            .map(|&rate| self.formula(rate, notation));
        let rates: Vec<String> = rates.collect();
        match &rates[..] {
            [rate] => rate.clone(),
            rates => format!("[{}]", rates.join(", ")),
        }
    }

    /// Derivatives, one line for each part: `q'[i] = …`, or `+=` where several are added; then a line for each part in common that has a name.
    pub fn equations(&self, halves: &[(Half, Vec<Scatter>)], notation: Notation) -> Vec<String> {
        let parts = halves.iter().flat_map(|(_, parts)| parts);
        let values: Vec<Id> = parts.map(|part| part.value).collect();
        let (values, common) = self.formulas(&values, 's', notation);
        let mut values = values.into_iter();
        let mut lines = Vec::new();
        for (half, parts) in halves {
            let own = values.by_ref().take(parts.len());
            lines.extend(self.lines(parts, own, notation, |target| {
                self.dotted(&target.of(*half), notation)
            }));
        }
        lines.extend(common);
        lines
    }

    /// A derivative, one line for each part with its value; `name` gives the left side.
    pub(super) fn lines(
        &self,
        parts: &[Scatter],
        values: impl Iterator<Item = String>,
        notation: Notation,
        name: impl Fn(&Coordinate) -> String,
    ) -> Vec<String> {
        let lines = parts.iter().zip(values).map(|(part, value)| {
            let name = name(&part.target);
            let sign = match (self.is_alone(parts, part), notation) {
                (true, _) => "=",
                (false, Notation::Text) => "+=",
                (false, Notation::Latex) => "\\mathrel{+}=",
            };
            let ranges = self.ranges(&part.loops, notation);
            format!("{name} {sign} {value}{ranges}")
        });
        lines.collect()
    }

    /// Whether a part of a derivative is the whole derivative by its coordinates.
    fn is_alone(&self, parts: &[Scatter], part: &Scatter) -> bool {
        let component = part.target.component;
        let mut others = parts
            .iter()
            .filter(|other| other.target.component == component && *other != part);
        let index = &part.target.index;
        match part.loops.as_slice() {
            [] => others.all(|other| {
                let apart = other.target.index != *index && other.target.index.base == index.base;
                other.loops.is_empty() && apart
            }),
            [over] => index.base == Base::Loop(*over) && others.next().is_none(),
            _ => false,
        }
    }

    /// The derivative of a coordinate with respect to the time.
    fn dotted(&self, coordinate: &Coordinate, notation: Notation) -> String {
        let name = self.coordinate_name(coordinate, notation);
        match notation {
            Notation::Text => match name.split_once('[') {
                Some((head, rest)) => format!("{head}'[{rest}"),
                None => format!("{name}'"),
            },
            Notation::Latex => format!("\\dot{{{name}}}"),
        }
    }

    /// The loops over which a line holds, in parentheses.
    pub(super) fn ranges(&self, loops: &[LoopId], notation: Notation) -> String {
        self.notes(loops, None, notation)
    }

    /// The loops over which a line holds, and a note, in parentheses.
    pub(super) fn notes(
        &self,
        loops: &[LoopId],
        note: Option<String>,
        notation: Notation,
    ) -> String {
        let ranges = loops.iter().map(|&over| self.range(over, notation));
        let notes: Vec<String> = ranges.chain(note).collect();
        match (notes.is_empty(), notation) {
            (true, _) => String::new(),
            (false, Notation::Text) => format!("    ({})", notes.join(", ")),
            (false, Notation::Latex) => format!("\\quad ({})", notes.join(",\\; ")),
        }
    }

    fn range(&self, over: LoopId, notation: Notation) -> String {
        let index = index_letter(over);
        match &self.graph.get_loop(over).range {
            LoopRange::Between(start, end) => {
                let (start, end) = (index_text(start, notation), index_text(end, notation));
                match notation {
                    Notation::Text => format!("{start} ≤ {index} < {end}"),
                    Notation::Latex => format!("{start} \\le {index} < {end}"),
                }
            }
            LoopRange::List(parameter) => {
                let list = symbol(&self.parameters[*parameter].name, notation);
                let [first, second, _] = primes(notation).map(|mark| format!("{index}{mark}"));
                match notation {
                    Notation::Text => format!("({first}, {second}) in {list}"),
                    Notation::Latex => format!("({first}, {second}) \\in {list}"),
                }
            }
        }
    }

    /// The name of a coordinate.
    pub fn coordinate_name(&self, coordinate: &Coordinate, notation: Notation) -> String {
        if coordinate.index == STRETCH {
            return "d".to_owned();
        }
        // A system with H has velocities in constraints only.
        if coordinate.half == Half::V && self.lagrangian.is_none() {
            return self.dotted(&coordinate.of(Half::Q), notation);
        }
        let half = coordinate.half.letter();
        let index = index_text(&coordinate.index, notation);
        match (&self.layout, notation) {
            (Layout::Named(_), _) => symbol(&self.name_of(coordinate), notation),
            (Layout::Numbered(_, None), Notation::Text) => format!("{half}[{index}]"),
            (Layout::Numbered(_, None), Notation::Latex) => format!("{half}_{{{index}}}"),
            (Layout::Numbered(_, Some(_)), Notation::Text) => {
                format!("{half}[{index}][{}]", coordinate.component)
            }
            (Layout::Numbered(_, Some(_)), Notation::Latex) => {
                format!("{half}_{{{index},{}}}", coordinate.component)
            }
        }
    }

    /// A node, from the texts of its parts.
    pub(super) fn write(&self, id: Id, notation: Notation, known: &Texts) -> (String, Strength) {
        let plain = |id: &Id| known[id].0.clone();
        let held = |id: &Id, strength: Strength| {
            let (text, own) = &known[id];
            match *own >= strength {
                true => text.clone(),
                false => bracket(text, notation),
            }
        };
        match self.graph.node(id) {
            Node::Constant(value) => {
                let (text, strength) = number(value, notation);
                match notation {
                    Notation::Text => (text.replace('-', "−"), strength),
                    Notation::Latex => (text, strength),
                }
            }
            Node::Pi => (
                if notation == Notation::Text {
                    "π"
                } else {
                    "\\pi"
                }
                .to_owned(),
                Strength::Atom,
            ),
            Node::Time => ("t".to_owned(), Strength::Atom),
            Node::Parameter(parameter, indices) => {
                let name = &self.parameters[*parameter].name;
                let indices = indices.iter().map(|index| index_text(index, notation));
                let indices: Vec<String> = indices.collect();
                let text = match (indices.is_empty(), notation) {
                    (true, _) => symbol(name, notation),
                    (false, Notation::Text) => format!("{name}[{}]", indices.join(", ")),
                    (false, Notation::Latex) => {
                        let (head, index) = head_and_index(name);
                        let indices: Vec<String> = index.into_iter().chain(indices).collect();
                        format!("{head}_{{{}}}", indices.join(","))
                    }
                };
                (text, Strength::Atom)
            }
            Node::Coordinate(coordinate) => {
                (self.coordinate_name(coordinate, notation), Strength::Atom)
            }
            Node::Sum(terms, constant) => {
                // −(a − b) is b − a.
                if let [(factor, x)] = terms.as_slice()
                    && constant.is_zero()
                    && *factor == -Number::one()
                    && let Node::Sum(inner, constant) = self.graph.node(*x)
                {
                    let terms: Vec<(Number, Id)> =
                        inner.iter().map(|(factor, x)| (-factor, *x)).collect();
                    return self.terms(&terms, &-constant, notation, known);
                }
                self.terms(terms, constant, notation, known)
            }
            Node::Product(factors) => {
                let power = |x: &Id, exponent: &Number| {
                    self.power(
                        &held(x, Strength::Power),
                        &held(x, Strength::Atom),
                        &plain(x),
                        exponent,
                        notation,
                    )
                };
                if let [(x, exponent)] = factors.as_slice()
                    && !exponent.is_negative()
                {
                    return (power(x, exponent), Strength::Power);
                }
                let above: Vec<String> = factors
                    .iter()
                    .filter(|(_, e)| e.is_positive())
                    .map(|(x, e)| power(x, e))
                    .collect();
                let below: Vec<String> = factors
                    .iter()
                    .filter(|(_, e)| e.is_negative())
                    .map(|(x, e)| power(x, &-e))
                    .collect();
                let join = |parts: &[String]| parts.join(space(notation));
                let above_text = if above.is_empty() {
                    "1".to_owned()
                } else {
                    join(&above)
                };
                let text = match (below.len(), notation) {
                    (0, _) => above_text,
                    (_, Notation::Latex) => format!("\\frac{{{above_text}}}{{{}}}", join(&below)),
                    (1, Notation::Text) => format!("{above_text}/{}", below[0]),
                    (_, Notation::Text) => format!("{above_text}/({})", join(&below)),
                };
                (text, Strength::Product)
            }
            Node::Elementary(function, x) => {
                let name = match notation {
                    Notation::Text => function.name().to_owned(),
                    Notation::Latex => match function.name() {
                        "asin" => "\\arcsin".to_owned(),
                        "acos" => "\\arccos".to_owned(),
                        "atan" => "\\arctan".to_owned(),
                        name => format!("\\{name}"),
                    },
                };
                (
                    format!("{name}{}", bracket(&plain(x), notation)),
                    Strength::Atom,
                )
            }
            Node::Atan2(y, x) => (
                format!(
                    "{}({}, {})",
                    operator("atan2", notation),
                    plain(y),
                    plain(x)
                ),
                Strength::Atom,
            ),
            Node::User(function, derivative, x) => {
                let mark = "'".repeat(*derivative);
                let name = symbol(&self.functions[*function][0], notation);
                (
                    format!("{name}{mark}{}", bracket(&plain(x), notation)),
                    Strength::Atom,
                )
            }
            Node::Total(over, body) => {
                let range = self.range(*over, notation);
                let body = held(body, Strength::Product);
                let text = match notation {
                    Notation::Text => format!("Σ({range}) {body}"),
                    Notation::Latex => format!("\\sum_{{{range}}} {body}"),
                };
                (text, Strength::Product)
            }
        }
    }

    fn terms(
        &self,
        terms: &[(Number, Id)],
        constant: &Number,
        notation: Notation,
        known: &Texts,
    ) -> (String, Strength) {
        let held = |id: &Id, strength: Strength| {
            let (text, own) = &known[id];
            match *own >= strength {
                true => text.clone(),
                false => bracket(text, notation),
            }
        };
        let mut text = String::new();
        let mut push = |minus: bool, term: String| {
            match (text.is_empty(), minus, notation) {
                (true, false, _) => {}
                (true, true, Notation::Text) => text.push('−'),
                (true, true, Notation::Latex) => text.push('-'),
                (false, false, _) => text.push_str(" + "),
                (false, true, Notation::Text) => text.push_str(" − "),
                (false, true, Notation::Latex) => text.push_str(" - "),
            }
            text.push_str(&term);
        };
        let alone = terms.len() == 1 && constant.is_zero();
        // A positive constant comes first.
        let before = constant.is_positive() && terms.iter().all(|(factor, _)| factor.is_negative());
        if before {
            push(false, number(constant, notation).0);
        }
        let first = terms
            .iter()
            .position(|(factor, _)| factor.is_positive())
            .unwrap_or(0);
        let order = std::iter::once(first).chain((0..terms.len()).filter(|&k| k != first));
        for k in order {
            let (factor, x) = &terms[k];
            let size = factor.abs();
            let term = match size.is_one() {
                true => held(x, Strength::Product),
                false => {
                    let (size, text) = (number(&size, notation).0, held(x, Strength::Product));
                    match (notation, text.strip_prefix("1/")) {
                        (Notation::Text, Some(below)) => format!("{size}/{below}"),
                        _ => format!("{size}{}{text}", space(notation)),
                    }
                }
            };
            push(factor.is_negative(), term);
        }
        if !constant.is_zero() && !before {
            push(constant.is_negative(), number(&constant.abs(), notation).0);
        }
        let product = alone && terms[0].0.is_positive();
        (
            text,
            if product {
                Strength::Product
            } else {
                Strength::Sum
            },
        )
    }

    fn power(
        &self,
        base: &str,
        atom: &str,
        plain: &str,
        exponent: &Number,
        notation: Notation,
    ) -> String {
        if exponent.is_one() {
            return base.to_owned();
        }
        let half = *exponent == Number::new(1.into(), 2.into());
        match (half, notation) {
            (true, Notation::Text) => format!(
                "√{}",
                if atom == plain {
                    plain.to_owned()
                } else {
                    format!("({plain})")
                }
            ),
            (true, Notation::Latex) => format!("\\sqrt{{{plain}}}"),
            (false, Notation::Text) => match exponent
                .is_integer()
                .then(|| superscript(&exponent.to_string()))
            {
                Some(raised) => format!("{atom}{raised}"),
                None => format!("{atom}^({exponent})"),
            },
            (false, Notation::Latex) => format!("{{{atom}}}^{{{exponent}}}"),
        }
    }
}

fn space(notation: Notation) -> &'static str {
    match notation {
        Notation::Text => " ",
        Notation::Latex => "\\,",
    }
}

fn bracket(text: &str, notation: Notation) -> String {
    match notation {
        Notation::Text => format!("({text})"),
        Notation::Latex => format!("\\left({text}\\right)"),
    }
}

fn operator(name: &str, notation: Notation) -> String {
    match notation {
        Notation::Text => name.to_owned(),
        Notation::Latex => format!("\\operatorname{{{name}}}"),
    }
}

/// A name; in LaTeX a long name is upright.
fn symbol(name: &str, notation: Notation) -> String {
    match notation {
        Notation::Text => name.to_owned(),
        Notation::Latex => match head_and_index(name) {
            (head, Some(index)) => format!("{head}_{{{index}}}"),
            (head, None) => head,
        },
    }
}

/// A name in LaTeX. What follows a Greek letter and `_` is an index.
fn head_and_index(name: &str) -> (String, Option<String>) {
    let upright = |text: &str| {
        let escaped = text.replace('_', "\\_");
        match text.chars().count() {
            1 => escaped,
            _ => format!("\\mathrm{{{escaped}}}"),
        }
    };
    let mut letters = name.chars();
    let first = letters.next().and_then(greek);
    match (first, letters.as_str(), letters.as_str().strip_prefix('_')) {
        (Some(letter), "", _) => (format!("\\{letter}"), None),
        (Some(letter), _, Some(index)) if !index.is_empty() => {
            (format!("\\{letter}"), Some(upright(index)))
        }
        _ => (upright(name), None),
    }
}

/// The command of LaTeX for a Greek letter.
fn greek(letter: char) -> Option<&'static str> {
    const FROM_ALPHA: &str = "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi o pi rho \
                              varsigma sigma tau upsilon phi chi psi omega";
    let place = u32::from(letter).checked_sub(u32::from('α'))?;
    FROM_ALPHA
        .split(' ')
        .nth(place as usize)
        .filter(|name| *name != "o")
}

fn superscript(digits: &str) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = digits
        .chars()
        .map(|c| c.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]));
    raised.collect()
}

/// The value of a parameter: a decimal if it is one, else a fraction.
pub fn number_text(value: &Number) -> String {
    decimal(value).unwrap_or_else(|| number(value, Notation::Text).0)
}

/// A number that is the shortest decimal of a double, as that decimal.
fn decimal(value: &Number) -> Option<String> {
    let text = symplectic_exact::rounding::to_f64(value).to_string();
    if text.len() >= 25 {
        return None;
    }
    let places = text.split_once('.').map_or(0, |(_, places)| places.len());
    // Not a number if the double is infinite.
    let digits: BigInt = text.replace('.', "").parse().ok()?;
    let power = BigInt::from(10).pow(u32::try_from(places).ok()?);
    (Number::new(digits, power) == *value).then_some(text)
}

fn number(value: &Number, notation: Notation) -> (String, Strength) {
    let (numerator, denominator) = (value.numer(), value.denom());
    let strength = if value.is_negative() {
        Strength::Sum
    } else {
        Strength::Atom
    };
    // Fractions of small numbers stay fractions.
    if denominator.bits() > 4
        && let Some(decimal) = decimal(value)
    {
        return (decimal, strength);
    }
    if denominator.is_one() {
        return (numerator.to_string(), strength);
    }
    match notation {
        Notation::Text => (format!("({numerator}/{denominator})"), strength),
        Notation::Latex => (format!("\\tfrac{{{numerator}}}{{{denominator}}}"), strength),
    }
}

/// The letter of the index of a loop.
pub fn index_letter(over: LoopId) -> String {
    match ["i", "j", "k", "l", "m"].get(over.0) {
        Some(letter) => (*letter).to_owned(),
        None => format!("i{}", over.0),
    }
}

/// The marks of the indices of a pair, and of its number.
fn primes(notation: Notation) -> [&'static str; 3] {
    match notation {
        Notation::Text => ["′", "″", ""],
        Notation::Latex => ["'", "''", ""],
    }
}

fn index_text(index: &Index, notation: Notation) -> String {
    let base = match &index.base {
        Base::Start => return index.offset.to_string(),
        Base::End(Length::Fixed(n)) => n.to_string(),
        Base::End(Length::Generic(name)) => name.clone(),
        Base::End(_) => "n".to_owned(),
        Base::Loop(id) => index_letter(*id),
        Base::Pair(id, slot) => format!("{}{}", index_letter(*id), primes(notation)[*slot]),
    };
    match index.offset {
        0 => base,
        offset if offset > 0 => format!("{base}+{offset}"),
        offset => format!("{base}{offset}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{BigInt, Number, number_text};

    #[test]
    fn values_are_shown_exactly() {
        let large = BigInt::from(12_345_678_901_234_567_891_u64);
        let huge = BigInt::from(10).pow(400);
        let quotient = |a: i64, b: i64| Number::new(a.into(), b.into());
        for (value, text) in [
            (quotient(-1, 4), "-0.25".to_owned()),
            (quotient(3, 10), "0.3".to_owned()),
            (quotient(1, 3), "(1/3)".to_owned()),
            (large.clone().into(), large.to_string()),
            (huge.clone().into(), huge.to_string()),
            (Number::new(1.into(), huge.clone()), format!("(1/{huge})")),
        ] {
            assert_eq!(number_text(&value), text);
        }
    }
}
