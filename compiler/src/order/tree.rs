//! Bicoloured rooted trees.

use std::fmt::{self, Write as _};
use std::str::FromStr;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

/// The colour of a vertex: which of Hamilton's equations it differentiates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Colour {
    /// `q' = ∂H/∂p`, drawn white; its stages are weighted by `b` and coupled by `a`.
    Q,
    /// `p' = −∂H/∂q`, drawn black; its stages are weighted by `b̃` and coupled by `ã`.
    P,
}

impl Colour {
    /// The other colour.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Colour::Q => Colour::P,
            Colour::P => Colour::Q,
        }
    }

    fn letter(self) -> char {
        match self {
            Colour::Q => 'q',
            Colour::P => 'p',
        }
    }

    fn symbol(self) -> char {
        match self {
            Colour::Q => '○',
            Colour::P => '●',
        }
    }
}

/// A bicoloured rooted tree `τ` in canonical form: equal trees are equal values.
///
/// A tree represents one order condition: with the weights of the root's colour,
/// `Σ_i b_i Φ_i(τ) = 1/γ(τ)`. Here `Φ_i(τ)` is the product over the children `u` of the root of
/// `Σ_j a_ij Φ_j(u)` for a child coloured `q` and `Σ_j ã_ij Φ_j(u)` for a child coloured `p`.
///
/// It is written as the letter of its root, followed by its children in brackets. `q[p,p[q]]` has a white root
/// with a black leaf and a black child that has a white leaf. Four or more equal children are written once, with
/// their number: `q[p^4]`.
///
/// ```
/// use symplectic_compiler::order::BicolouredTree;
///
/// let tree: BicolouredTree = "q[p[q],p]".parse()?;
/// assert_eq!(tree.to_string(), "q[p,p[q]]");
/// assert_eq!((tree.order(), tree.density()), (4, 8.into()));
/// assert_eq!(tree.picture(), "○\n├─●\n└─●\n  └─○\n");
/// # Ok::<(), symplectic_compiler::order::TreeError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BicolouredTree {
    colour: Colour,
    /// In ascending order.
    children: Vec<BicolouredTree>,
}

impl BicolouredTree {
    /// The tree with a root of this colour and these children, in any order.
    pub fn new(colour: Colour, mut children: Vec<BicolouredTree>) -> Self {
        children.sort_unstable();
        BicolouredTree { colour, children }
    }

    /// The tree with one vertex.
    pub fn vertex(colour: Colour) -> Self {
        BicolouredTree::new(colour, Vec::new())
    }

    /// The tree whose `order − 1` children are leaves of the other colour. With a root coloured `p` it is in every
    /// class.
    pub fn bushy(colour: Colour, order: usize) -> Self {
        let leaf = BicolouredTree::vertex(colour.opposite());
        BicolouredTree::new(colour, vec![leaf; order.saturating_sub(1)])
    }

    /// The colour of the root.
    pub fn colour(&self) -> Colour {
        self.colour
    }

    /// The subtrees at the root, in ascending order.
    pub fn children(&self) -> &[BicolouredTree] {
        &self.children
    }

    /// The order `|τ|`: the number of vertices.
    pub fn order(&self) -> usize {
        1 + self
            .children
            .iter()
            .map(BicolouredTree::order)
            .sum::<usize>()
    }

    /// The density `γ(τ) = |τ| Π γ(u)` over the children `u`.
    pub fn density(&self) -> BigInt {
        let children = self.children.iter().map(BicolouredTree::density);
        children.fold(BigInt::from(self.order()), |product, child| product * child)
    }

    /// The symmetry `σ(τ) = Π σ(u)ᵐ m!` over the different children `u` with multiplicities `m`: the number
    /// of automorphisms.
    pub fn symmetry(&self) -> BigInt {
        let groups = self.children.chunk_by(|left, right| left == right);
        groups.fold(BigInt::one(), |product, group| {
            let one = group.first().map_or_else(BigInt::one, Self::symmetry);
            (1..=group.len()).fold(product, |product, count| product * count * &one)
        })
    }

    /// The coefficient `α(τ) = |τ|!/(γ(τ) σ(τ))`: the number of monotonic labellings.
    pub fn labellings(&self) -> BigInt {
        let factorial: BigInt = (1..=self.order()).map(BigInt::from).product();
        factorial / (self.density() * self.symmetry())
    }

    /// The required value of the elementary weight of the tree: `1/γ(τ)`.
    pub fn wanted(&self) -> BigRational {
        BigRational::new(BigInt::one(), self.density())
    }

    /// A picture of several lines, the root first: `○` for `q` and `●` for `p`.
    pub fn picture(&self) -> String {
        let mut picture = String::from(self.colour.symbol());
        picture.push('\n');
        self.draw_children("", &mut picture);
        picture
    }

    fn draw_children(&self, indent: &str, picture: &mut String) {
        for (index, child) in self.children.iter().enumerate() {
            let last = index + 1 == self.children.len();
            let (branch, space) = if last {
                ("└─", "  ")
            } else {
                ("├─", "│ ")
            };
            // Writing to a string cannot fail.
            let _ = writeln!(picture, "{indent}{branch}{}", child.colour.symbol());
            child.draw_children(&format!("{indent}{space}"), picture);
        }
    }
}

impl fmt::Display for BicolouredTree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char(self.colour.letter())?;
        let mut separator = '[';
        for group in self.children.chunk_by(|left, right| left == right) {
            let (shown, exponent) = match group.len() {
                count @ SPELLED_OUT.. => (&group[..1], Some(count)),
                _ => (group, None),
            };
            for child in shown {
                write!(f, "{separator}{child}")?;
                separator = ',';
            }
            if let Some(count) = exponent {
                write!(f, "^{count}")?;
            }
        }
        if self.children.is_empty() {
            Ok(())
        } else {
            f.write_char(']')
        }
    }
}

/// The error for text that is not a bicoloured tree.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TreeError {
    /// An unexpected character, or a premature end.
    #[error("expected {expected} at character {position} of the tree")]
    Unexpected {
        /// The expected text.
        expected: &'static str,
        /// The position of the character, counted from 1.
        position: usize,
    },
    /// Too many vertices.
    #[error("the tree has more than {limit} vertices")]
    TooLarge {
        /// The largest number of vertices.
        limit: usize,
    },
}

/// From this number on, equal children are written once with an exponent.
const SPELLED_OUT: usize = 4;

/// The largest number of vertices of a tree that is read; it bounds the depth of the recursion.
const READ_LIMIT: usize = 1000;

impl FromStr for BicolouredTree {
    type Err = TreeError;

    /// Reads the format of [`fmt::Display`], with the children in any order and any exponents, without spaces.
    ///
    /// # Errors
    /// If the text is not a tree, or a tree with more than 1000 vertices.
    fn from_str(text: &str) -> Result<Self, TreeError> {
        let mut reader = Reader {
            rest: text.chars().collect::<Vec<_>>().into_iter(),
            position: 0,
            vertices: 0,
        };
        let tree = reader.tree()?;
        match reader.next() {
            None => Ok(tree),
            Some(_) => Err(reader.expected("the end")),
        }
    }
}

struct Reader {
    rest: std::vec::IntoIter<char>,
    position: usize,
    vertices: usize,
}

impl Reader {
    fn next(&mut self) -> Option<char> {
        self.position += 1;
        self.rest.next()
    }

    fn expected(&self, expected: &'static str) -> TreeError {
        TreeError::Unexpected {
            expected,
            position: self.position,
        }
    }

    fn tree(&mut self) -> Result<BicolouredTree, TreeError> {
        let colour = match self.next() {
            Some('q') => Colour::Q,
            Some('p') => Colour::P,
            _ => return Err(self.expected("`q` or `p`")),
        };
        self.vertices += 1;
        if self.vertices > READ_LIMIT {
            return Err(TreeError::TooLarge { limit: READ_LIMIT });
        }
        let mut children = Vec::new();
        if self.rest.as_slice().first() == Some(&'[') {
            self.next();
            loop {
                let before = self.vertices;
                let child = self.tree()?;
                let count = self.exponent()?;
                let added = (self.vertices - before).saturating_mul(count);
                self.vertices = before.saturating_add(added);
                if self.vertices > READ_LIMIT {
                    return Err(TreeError::TooLarge { limit: READ_LIMIT });
                }
                children.extend(std::iter::repeat_n(child, count));
                match self.next() {
                    Some(',') => {}
                    Some(']') => break,
                    _ => return Err(self.expected("`,` or `]`")),
                }
            }
        }
        Ok(BicolouredTree::new(colour, children))
    }

    /// Reads `^12`, or nothing, which means 1.
    fn exponent(&mut self) -> Result<usize, TreeError> {
        if self.rest.as_slice().first() != Some(&'^') {
            return Ok(1);
        }
        self.next();
        let mut value = 0usize;
        while let Some(digit) = self.rest.as_slice().first().and_then(|c| c.to_digit(10)) {
            self.next();
            value = value.saturating_mul(10).saturating_add(digit as usize);
        }
        if value == 0 {
            self.position += 1;
            return Err(self.expected("a number of children"));
        }
        Ok(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn tree(text: &str) -> BicolouredTree {
        text.parse().expect(text)
    }

    fn numbers(text: &str) -> (usize, BigInt, BigInt, BigInt) {
        let tree = tree(text);
        (
            tree.order(),
            tree.density(),
            tree.symmetry(),
            tree.labellings(),
        )
    }

    /// GNI table III.1.1 for one colour.
    #[test]
    fn numbers_of_trees_are_those_of_the_tables() {
        for (text, order, density, symmetry, labellings) in [
            ("q", 1, 1, 1, 1),
            ("q[q]", 2, 2, 1, 1),
            ("q[q,q]", 3, 3, 2, 1),
            ("q[q[q]]", 3, 6, 1, 1),
            ("q[q,q,q]", 4, 4, 6, 1),
            ("q[q,q[q]]", 4, 8, 1, 3),
            ("q[q[q,q]]", 4, 12, 2, 1),
            ("q[q[q[q]]]", 4, 24, 1, 1),
            ("q[q[q],q[q]]", 5, 20, 2, 3),
            // A different colour makes the two branches different.
            ("q[q[p],q[q]]", 5, 20, 1, 6),
            ("q[q,p]", 3, 3, 1, 2),
        ] {
            let expected = (order, density.into(), symmetry.into(), labellings.into());
            assert_eq!(numbers(text), expected, "{text}");
        }
    }

    #[test]
    fn malformed_trees_are_refused_at_the_position() {
        let unexpected = |expected, position| TreeError::Unexpected { expected, position };
        for (text, error) in [
            ("", unexpected("`q` or `p`", 1)),
            ("q[]", unexpected("`q` or `p`", 3)),
            ("q[p", unexpected("`,` or `]`", 4)),
            ("q[p]]", unexpected("the end", 5)),
            ("q p", unexpected("the end", 2)),
            ("q[p^0]", unexpected("a number of children", 6)),
            ("q[p^]", unexpected("a number of children", 5)),
        ] {
            assert_eq!(text.parse::<BicolouredTree>(), Err(error), "{text}");
        }
        for large in [
            "q[".repeat(100_000),
            "q[p[q^999]^999]".to_owned(),
            "q[p^99999999999999999999]".to_owned(),
        ] {
            let error = TreeError::TooLarge { limit: 1000 };
            assert_eq!(large.parse::<BicolouredTree>(), Err(error));
        }
    }

    #[test]
    fn pictures_show_the_branches() {
        let picture = tree("p[q[p,q],q]").picture();
        assert_eq!(picture, "●\n├─○\n└─○\n  ├─○\n  └─●\n");
        assert_eq!(
            tree("q[q[p],q[q]]").picture(),
            "○\n├─○\n│ └─○\n└─○\n  └─●\n"
        );
    }

    fn any_tree() -> impl Strategy<Value = BicolouredTree> {
        let colour = || prop_oneof![Just(Colour::Q), Just(Colour::P)];
        colour()
            .prop_map(BicolouredTree::vertex)
            .prop_recursive(4, 20, 4, move |inner| {
                (colour(), prop::collection::vec(inner, 0..4))
                    .prop_map(|(colour, children)| BicolouredTree::new(colour, children))
            })
    }

    proptest! {
        #[test]
        fn trees_read_back(tree in any_tree()) {
            prop_assert_eq!(tree.to_string().parse(), Ok(tree.clone()));
            let mut children = tree.children().to_vec();
            children.reverse();
            prop_assert_eq!(BicolouredTree::new(tree.colour(), children), tree);
        }

        #[test]
        fn equal_children_are_written_once(child in any_tree(), count in 4usize..9) {
            let tree = BicolouredTree::new(Colour::P, vec![child.clone(); count]);
            prop_assert_eq!(tree.to_string(), format!("p[{child}^{count}]"));
            prop_assert_eq!(tree.to_string().parse(), Ok(tree));
        }
    }
}
