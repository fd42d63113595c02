//! Formulas with names for the parts that they have in common.

use std::collections::HashMap;

use super::display::{MAX_CHARACTERS, Notation, Strength, Texts, index_letter};
use super::graph::{Id, LoopId, MAX_LOOPS};
use super::system::{Layout, System};

/// A part that occurs more than once in several formulas has a name if it has more characters; in LaTeX, twice as many.
const LONG: usize = 28;

impl System {
    /// Several formulas. A long part that occurs more than once has a name, `letter` with a number; the second list defines the names.
    pub(super) fn formulas(
        &self,
        roots: &[Id],
        letter: char,
        notation: Notation,
    ) -> (Vec<String>, Vec<String>) {
        let below = self.graph.below(roots.iter().copied());
        let mut uses: HashMap<Id, usize> = HashMap::new();
        let children = below.iter().flat_map(|&id| self.graph.children(id));
        for id in children.chain(roots.iter().copied()) {
            *uses.entry(id).or_default() += 1;
        }
        let letter = self.free_letter(letter);
        let long = match notation {
            Notation::Text => LONG,
            Notation::Latex => 2 * LONG,
        };
        let (mut texts, mut common) = (Texts::new(), Vec::new());
        for id in below {
            let mut text = self.write(id, notation, &texts);
            if text.0.len() > MAX_CHARACTERS {
                text.0 = "…".to_owned();
            } else if uses[&id] > 1 && text.0.chars().count() > long {
                let name = self.name_of_part(letter, common.len() + 1, id, notation);
                common.push(format!("{name} = {}", text.0));
                text = (name, Strength::Atom);
            }
            texts.insert(id, text);
        }
        let formulas = roots.iter().map(|id| texts[id].0.clone());
        (formulas.collect(), common)
    }

    /// A letter that, with a number, is not a name of the system: this one if possible.
    fn free_letter(&self, letter: char) -> char {
        let coordinates = match &self.layout {
            Layout::Named(names) => names.iter().flatten().collect(),
            Layout::Numbered(..) => Vec::new(),
        };
        let parameters = self.parameters.iter().map(|parameter| &parameter.name);
        let functions = self.functions.iter().filter_map(|names| names.first());
        let names: Vec<&String> = parameters.chain(functions).chain(coordinates).collect();
        let is_free = |letter: &char| {
            let numbered = |name: &&String| {
                let rest = name.strip_prefix(*letter);
                rest.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
            };
            !names.iter().any(numbered)
        };
        std::iter::once(letter)
            .chain('a'..='z')
            .find(is_free)
            .unwrap_or(letter)
    }

    /// The name of a part in common, with the indices on which its value depends: `s1(i, j)`.
    fn name_of_part(&self, letter: char, number: usize, id: Id, notation: Notation) -> String {
        let depends = self.graph.depends(id);
        let loops = (0..MAX_LOOPS).map(LoopId);
        let indices: Vec<String> = loops
            .filter(|&over| depends.changes_in(over))
            .map(index_letter)
            .collect();
        let name = match notation {
            Notation::Text => format!("{letter}{number}"),
            Notation::Latex => format!("{letter}_{{{number}}}"),
        };
        match indices.is_empty() {
            true => name,
            false => format!("{name}({})", indices.join(", ")),
        }
    }
}
