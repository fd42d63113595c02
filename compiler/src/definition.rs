//! The definition of a tableau, as the user writes it.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use crate::error::{Error, ErrorKind};
use crate::expression::{Input, shown};
use crate::suggestion::did_you_mean;
use crate::symbolic::Constant;

/// Makes [`Key`] from its one list: each with its name, what the value is called (nothing for a switch), and a help text.
macro_rules! keys {
    ($($(#[$doc:meta])* $key:ident = $name:literal, $value:expr, $help:literal;)*) => {
        /// The parts of a definition.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Key {
            $($(#[$doc])* $key,)*
        }

        impl Key {
            /// All keys, in the order in which they are written.
            pub const ALL: [Key; [$($name),*].len()] = [$(Key::$key),*];

            /// The key as it is written in the macro and in files.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Key::$key => $name,)*
                }
            }

            /// What the value is called in the help of the command line; `None` where it is `true` or `false`.
            pub const fn value_name(self) -> Option<&'static str> {
                match self {
                    $(Key::$key => $value,)*
                }
            }

            /// What it is, for the command line.
            pub const fn help(self) -> &'static str {
                match self {
                    $(Key::$key => $help,)*
                }
            }
        }
    };
}

keys! {
    /// The name of a frequency in the basis, `w`: the coefficients are then functions of it. See [`Fitted`](crate::Fitted).
    Parameters = "parameters", Some("NAME"),
        "A frequency in the functions of the basis, such as w in \"1, cos(w*t), sin(w*t)\": the coefficients are functions of it";
    /// The functions in which velocities are approximated: `polynomial(3)`, `1, cos(pi*t), sin(pi*t)`.
    Basis = "basis", Some("BASIS"),
        "`polynomial(s)`, `legendre(s)`, or a list of functions of t: \"1, cos(pi*t), sin(pi*t)\"";
    /// The nodes of the square construction: `lobatto(3)`, `0, 1/2, 1`.
    Nodes = "nodes", Some("NODES"),
        "A rule such as `gauss(3)` (`symplectic list` shows all), or a list of numbers in [0, 1]: \"0, 1/3, 1\"";
    /// The nodes of the quadrature formula of the rectangular construction: at least as many as functions.
    Quadrature = "quadrature", Some("QUADRATURE"),
        "Nodes of the rectangular construction: as many as there are functions, or more";
    /// A method on which a composition is built: a name of the [`catalogue`](crate::catalogue), or a definition in
    /// brackets. Without [`Key::Weights`] it is the method itself.
    Base = "base", Some("METHOD"),
        "A method to compose with `--weights`: a name of `symplectic list`, or a definition in brackets: \"[kick: [1/2, 1/2], drift: [1, 0]]\"";
    /// The weights of the quadrature formula, if they are not the interpolatory ones. With a base, the fractions of the steps of
    /// the composition: `1/2, adjoint(1/2)`, `triple_jump(4)`, `suzuki(4)`.
    Weights = "weights", Some("WEIGHTS"),
        "The weights of the quadrature, if not the interpolatory ones: \"1/6, 2/3, 1/6\". With `--base`, the fractions of its steps: \"1/2, adjoint(1/2)\", \"triple_jump(4)\", \"suzuki(4)\"";
    /// Given coefficients `a_ij`: `[[0, 0], [1/2, 1/2]]`.
    A = "a", Some("ROWS"),
        "Given coefficients of the position stages, row by row: \"[[0, 0], [1/2, 1/2]]\"";
    /// Given weights `b_i`.
    B = "b", Some("LIST"),
        "Given weights: \"1/2, 1/2\"";
    /// Given coefficients `ã_ij`, or `symplectic_partner`; `a` where they are not given.
    ATilde = "a_tilde", Some("ROWS"),
        "Given coefficients of the momentum stages, or `symplectic_partner` [default: those of the positions]";
    /// Given weights `b̃_i`; `b` where they are not given.
    BTilde = "b_tilde", Some("LIST"),
        "Given weights of the forces [default: b]";
    /// The kicks `p −= kick_i h ∂U/∂q` of a splitting: `1/2, 1/2`.
    Kick = "kick", Some("LIST"),
        "The kicks of a splitting, p -= kick_i h dU/dq: \"1/2, 1/2\"";
    /// The drifts `q += drift_i h ∂T/∂p` of a splitting, each after the kick of the same number: `1, 0`.
    Drift = "drift", Some("LIST"),
        "The drifts of a splitting, q += drift_i h dT/dp, each after the kick of the same number: \"1, 0\"";
    /// The weights `g_i` of the gradient kicks of a splitting for quadratic kinetic energy, one for each kick: `0, 1/72, 0`. With the
    /// force `f = −∂U/∂q` a kick is then `p += h (kick_i f + 2 g_i h² f′ M⁻¹ f)`.
    Gradient = "gradient", Some("LIST"),
        "The gradient weights of the kicks of a splitting, for quadratic kinetic energy: p += h (kick_i f + 2 g_i h^2 f' f/M) with the force f: \"0, 1/72, 0\"";
    /// `drift` where each drift of a splitting comes before the kick of the same number; `kick` otherwise.
    First = "first", Some("FLOW"),
        "What comes first: kick or drift [default: kick]";
    /// The processor P of a processed method `P K P⁻¹`: steps of the base whose fractions sum to 0, `1/3, -1/2, 1/6`, or
    /// `back_and_forth(1/3, -1/2, 1/6)`, or kicks, and drifts that sum to 0, `[kick: [1/4, -1/4], drift: [1/5, -1/5]]`.
    Processor = "processor", Some("STEPS"),
        "The processor P of a processed method P K P^-1: with `--base`, fractions of steps of it that sum to 0, the first one first, or `back_and_forth(...)`; with `--kick` and `--drift`, a splitting whose drifts sum to 0: \"[kick: [1/4, -1/4], drift: [1/5, -1/5]]\"";
    /// The claimed order of printed kicks and drifts, `separable(6)`, `nystrom(6)`, `perturbed(8, 6, 4)`, or of printed weights of
    /// a composition, `separable(8)`. The coefficients are then those of the exact method that is proved to be near the digits: see
    /// [`certify`](crate::certify).
    Claim = "claim", Some("CLAIM"),
        "The claimed order of printed kicks and drifts, or of printed weights of a composition: `separable(6)`, `nystrom(6)`, `perturbed(8, 6, 4)`. The exact method near the digits is derived, with a proof that it exists";
    /// Steps of other methods one after another, each with its fraction of the step and its own
    /// definition: `[[1/2, basis: 1, nodes: 0], [1/2, basis: 1, nodes: 1]]`.
    Compose = "compose", Some("STEPS"),
        "Steps of other methods one after another, each with its fraction of the step: \"[1/2, basis: 1, nodes: 0], [1/2, basis: 1, nodes: 1]\"";
    /// `true` if the parts of a splitting, or the weights of a composition, are the first half of a palindrome. The last entry is
    /// the middle one and is not repeated.
    Symmetric = "symmetric", None,
        "Continue a splitting, or the weights of a composition, in reverse order; the last entry is the middle one and is not repeated";
    /// `true` where the coefficients for positions and momenta are exchanged in the end.
    Exchange = "exchange", None,
        "Exchange the coefficients of positions and momenta";
    /// `true` for the adjoint of the method that the other parts give. It does not matter whether it is
    /// taken before or after [`Key::Exchange`].
    Adjoint = "adjoint", None,
        "Take the adjoint method";
}

impl Key {
    /// Whether the value is `true` or `false`.
    pub const fn is_switch(self) -> bool {
        self.value_name().is_none()
    }

    /// The key of this name.
    pub fn find(name: &str) -> Option<Key> {
        Key::ALL.into_iter().find(|key| key.name() == name)
    }
}

/// What a tableau is derived from: `basis: polynomial(3), nodes: lobatto(3)`.
///
/// | parts | construction |
/// |---|---|
/// | `basis`, `nodes` | square: as many functions as nodes (LZ §4.4) |
/// | `basis`, `quadrature`, perhaps `weights` | rectangular Galerkin: at least as many nodes (T §2.2) |
/// | `a`, `b`, perhaps `a_tilde`, `b_tilde` | given coefficients |
/// | `kick`, `drift`, perhaps `first`, `symmetric` | a splitting `H = T(p) + U(q)`: kicks and drifts one after another (MW 2.6.4) |
/// | `kick`, `drift`, `gradient`, perhaps `first`, `symmetric`, `claim` | the same with gradient kicks, for quadratic `T` (Chin 1997) |
/// | `kick`, `drift`, `claim`, perhaps `first`, `symmetric` | the exact splitting behind printed digits, certified |
/// | `base`, perhaps `weights`, `symmetric` | a method of the catalogue, or steps of it one after another (GNI II.4) |
/// | `base`, `weights`, `claim`, perhaps `symmetric` | the exact composition behind printed weights, certified |
/// | either of these with `processor` | `P ∘ K ∘ P⁻¹` with that method as the kernel K |
/// | `parameters`, `basis`, `nodes` | square, with coefficients that are functions of a frequency: [`Fitted`](crate::Fitted) |
/// | `compose` | `Φ_{γ_m h} ∘ … ∘ Φ_{γ_1 h}` (MW 2.5): a list of `[γ_k, definition of Φ_k]`, the first step first |
///
/// Each may have `exchange: true` and `adjoint: true`. Every value is text in the grammar of
/// [`expression`](crate::expression); in `compose`, what follows `γ_k` is again a definition as it is printed.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Definition {
    parts: BTreeMap<Key, String>,
}

impl Definition {
    /// The definition with these parts.
    pub fn new<T: Into<String>>(parts: impl IntoIterator<Item = (Key, T)>) -> Self {
        Definition {
            parts: parts
                .into_iter()
                .map(|(key, text)| (key, text.into()))
                .collect(),
        }
    }

    /// Reads `basis: polynomial(3), nodes: [0, 1/2, 1]`, as it is printed.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] where a key is unknown or given twice.
    ///
    /// ```
    /// use symplectic_compiler::{Definition, Key, Limits};
    ///
    /// let definition = Definition::parse("basis: polynomial(3), nodes: [0, 1/4, 1]")?;
    /// assert_eq!(definition.get(Key::Nodes), Some("[0, 1/4, 1]"));
    /// assert_eq!(definition.derive(&Limits::default())?.stages(), 3);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, Error> {
        let input = Input {
            name: "definition",
            text,
        };
        let mut definition = Definition::default();
        for (key, range) in read_parts(input, pieces(text, 0..text.len()))? {
            definition.parts.insert(key, text[range].to_owned());
        }
        Ok(definition)
    }

    /// The text of a part.
    pub fn get(&self, key: Key) -> Option<&str> {
        self.parts.get(&key).map(String::as_str)
    }

    /// All parts that are there.
    pub fn parts(&self) -> impl Iterator<Item = (Key, &str)> {
        self.parts.iter().map(|(&key, text)| (key, text.as_str()))
    }

    /// The definition of the adjoint, which is this one again where this one is of an adjoint.
    pub(crate) fn adjoint(&self) -> Definition {
        let mut definition = self.clone();
        if self.get(Key::Adjoint) == Some("true") {
            definition.parts.remove(&Key::Adjoint);
        } else {
            definition.parts.insert(Key::Adjoint, "true".to_owned());
        }
        definition
    }

    /// The definition of steps of methods one after another.
    pub(crate) fn composition<'a>(
        steps: impl IntoIterator<Item = (&'a Constant, &'a Definition)>,
    ) -> Definition {
        let steps = steps
            .into_iter()
            .map(|(fraction, definition)| format!("[{fraction}, {definition}]"));
        let steps: Vec<String> = steps.collect();
        Definition::new([(Key::Compose, format!("[{}]", steps.join(", ")))])
    }
}

/// The parts of a range of a text that the commas outside brackets separate.
pub(crate) fn pieces(text: &str, range: Range<usize>) -> Vec<Range<usize>> {
    let mut pieces = Vec::new();
    let (mut depth, mut start) = (0_i32, range.start);
    for (offset, byte) in text[range.clone()].bytes().enumerate() {
        match byte {
            b'(' | b'[' => depth += 1,
            b')' | b']' => depth -= 1,
            b',' if depth <= 0 => {
                pieces.push(start..range.start + offset);
                start = range.start + offset + 1;
            }
            _ => {}
        }
    }
    pieces.push(start..range.end);
    pieces
}

/// A range of a text without the white space at its ends.
pub(crate) fn trimmed(text: &str, range: Range<usize>) -> Range<usize> {
    let part = &text[range.clone()];
    let start = range.start + part.len() - part.trim_start().len();
    start..start + part.trim().len()
}

/// Reads `key: value` in each of some ranges of a text; the values as ranges.
///
/// # Errors
/// [`ErrorKind::Syntax`] where a key is unknown or given twice.
pub(crate) fn read_parts(
    input: Input<'_>,
    ranges: impl IntoIterator<Item = Range<usize>>,
) -> Result<Vec<(Key, Range<usize>)>, Error> {
    let error = |range: &Range<usize>, found: String, meant: &str| {
        let expected = Key::ALL.map(|key| format!("`{}:`", key.name())).join(", ");
        let kind = ErrorKind::Syntax {
            found,
            expected: format!("one of {expected}, each once{meant}"),
        };
        input.error(range, kind)
    };
    let mut parts: Vec<(Key, Range<usize>)> = Vec::new();
    for range in ranges {
        let part = &input.text[range.clone()];
        let unknown = |meant: &str| error(&range, format!("`{}`", shown(part.trim())), meant);
        let (name, _) = part.split_once(':').ok_or_else(|| unknown(""))?;
        let key = Key::find(name.trim()).ok_or_else(|| {
            let known = Key::ALL.iter().map(|key| key.name());
            unknown(&did_you_mean(name, known))
        })?;
        if parts.iter().any(|(known, _)| *known == key) {
            return Err(error(&range, format!("a second `{}`", key.name()), ""));
        }
        let value = range.start + name.len() + 1..range.end;
        parts.push((key, trimmed(input.text, value)));
    }
    Ok(parts)
}

impl fmt::Display for Definition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (key, text)) in self.parts().enumerate() {
            let comma = if index > 0 { ", " } else { "" };
            write!(f, "{comma}{}: {}", key.name(), Bracketed(text))?;
        }
        Ok(())
    }
}

/// A text with brackets if it is a list, so that its commas do not separate parts.
struct Bracketed<'a>(&'a str);

impl fmt::Display for Bracketed<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut depth = 0_i32;
        let lists = self.0.chars().any(|c| {
            depth += i32::from(matches!(c, '(' | '[')) - i32::from(matches!(c, ')' | ']'));
            c == ',' && depth == 0
        });
        if lists {
            write!(f, "[{}]", self.0)
        } else {
            f.write_str(self.0)
        }
    }
}
