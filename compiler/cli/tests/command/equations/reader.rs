//! Printed equations, read and evaluated.

use std::collections::HashMap;

/// Numbers by name: `g`, `m[2]`, `q[1,0]`, `x'`.
pub type Values = HashMap<String, f64>;

/// Where equations are evaluated.
#[derive(Clone, Default)]
pub struct World {
    pub values: Values,
    pub lengths: HashMap<String, i64>,
    pub pairs: HashMap<String, Vec<[i64; 2]>>,
}

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Number(f64),
    Name(String),
    Raised(i32),
    Symbol(char),
}

/// A token, and whether it follows the previous one without a space.
type Glued = (Token, bool);

fn tokens(text: &str) -> Vec<Glued> {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    let letters: Vec<char> = text.chars().collect();
    let is_raised = |c: char| RAISED.contains(c);
    let in_name = |c: char| (c.is_alphanumeric() && !is_raised(c)) || "_'′″".contains(c);
    let (mut all, mut k, mut glued) = (Vec::new(), 0, false);
    while k < letters.len() {
        let first = letters[k];
        let end = |inside: &dyn Fn(char) -> bool| {
            let more = letters[k..].iter().position(|&c| !inside(c));
            k + more.unwrap_or(letters.len() - k)
        };
        if first == ' ' {
            (k, glued) = (k + 1, false);
            continue;
        }
        let (token, next) = if first.is_ascii_digit() {
            let next = end(&|c| c.is_ascii_digit() || c == '.');
            let number: String = letters[k..next].iter().collect();
            (Token::Number(number.parse().expect("a number")), next)
        } else if is_raised(first) {
            let next = end(&is_raised);
            let digit = |c: &char| {
                "0123456789-"
                    .chars()
                    .nth(RAISED.chars().position(|r| r == *c).expect("raised"))
            };
            let number: String = letters[k..next].iter().filter_map(digit).collect();
            (Token::Raised(number.parse().expect("a power")), next)
        } else if in_name(first) && first != 'Σ' {
            let next = end(&in_name);
            (Token::Name(letters[k..next].iter().collect()), next)
        } else {
            (Token::Symbol(first), k + 1)
        };
        all.push((token, glued));
        (k, glued) = (next, true);
    }
    all
}

/// Lines `left = right`, `left += right`, with the loops in which they hold.
struct Line {
    left: Vec<Glued>,
    right: Vec<Glued>,
    is_added: bool,
    notes: Vec<Vec<Glued>>,
}

fn line(text: &str) -> Line {
    let (text, notes) = match text.split_once("    (") {
        Some((text, notes)) => (text, notes.trim().strip_suffix(')').expect("a bracket")),
        None => (text, ""),
    };
    let is_added = text.contains(" += ");
    let sign = if is_added { " += " } else { " = " };
    let (left, right) = text
        .split_once(sign)
        .unwrap_or_else(|| panic!("no sign: {text}"));
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for c in notes.chars() {
        depth += match c {
            '(' | '[' => 1,
            ')' | ']' => -1,
            _ => 0,
        };
        match (c, depth) {
            (',', 0) => parts.push(String::new()),
            _ => parts.last_mut().expect("a part").push(c),
        }
    }
    Line {
        left: tokens(left),
        right: tokens(right),
        is_added,
        notes: parts.iter().map(|part| tokens(part)).collect(),
    }
}

/// The left sides of equations of motion with their values; every one is set once, or added to.
pub fn solve(lines: &[String], world: &World) -> Values {
    let lines: Vec<Line> = lines.iter().map(|text| line(text)).collect();
    let is_common = |line: &Line| match &line.left[0].0 {
        Token::Name(name) => name
            .strip_prefix(['s', 'u'])
            .is_some_and(|rest| rest.parse::<u32>().is_ok()),
        _ => false,
    };
    let (common, equations): (Vec<Line>, Vec<Line>) = lines.into_iter().partition(is_common);
    let common = common.into_iter().map(|line| match line.left[0].0.clone() {
        Token::Name(name) => (name, line.right),
        other => panic!("{other:?}"),
    });
    let common = common.collect();
    let mut found = Values::new();
    for line in equations {
        each(&line.notes, world, &mut HashMap::new(), &mut |indices| {
            let mut reader = Reader::new(&line.left, world, indices, &common);
            let name = reader.key();
            let value = Reader::new(&line.right, world, indices, &common).whole();
            match line.is_added {
                true => *found.entry(name).or_insert(0.0) += value,
                false => assert_eq!(found.insert(name, value), None),
            }
        });
    }
    found
}

/// The left sides of constraints, which are zero, with the names of their multipliers.
pub fn constraints(lines: &[String], world: &World) -> Vec<(Option<String>, f64)> {
    let (common, mut found) = (HashMap::new(), Vec::new());
    for text in lines {
        let line = line(text);
        assert_eq!(line.right, tokens("0"), "{text}");
        each(&line.notes, world, &mut HashMap::new(), &mut |indices| {
            let multiplier = line.notes.iter().find(|note| is_multiplier(note));
            let name = multiplier.map(|note| Reader::new(note, world, indices, &common).key());
            found.push((
                name,
                Reader::new(&line.left, world, indices, &common).whole(),
            ));
        });
    }
    found
}

fn is_multiplier(note: &[Glued]) -> bool {
    matches!(&note.first(), Some((Token::Name(name), _)) if name.starts_with('λ'))
}

/// Goes through the loops of some notes.
fn each(
    notes: &[Vec<Glued>],
    world: &World,
    indices: &mut HashMap<String, i64>,
    run: &mut dyn FnMut(&HashMap<String, i64>),
) {
    let Some((note, rest)) = notes.split_first() else {
        return run(indices);
    };
    if note.is_empty() || is_multiplier(note) {
        return each(rest, world, indices, run);
    }
    let common = HashMap::new();
    let values = Reader::new(note, world, indices, &common).range();
    for value in values {
        indices.extend(value);
        each(rest, world, indices, run);
    }
}

struct Reader<'a> {
    tokens: &'a [Glued],
    next: usize,
    world: &'a World,
    indices: HashMap<String, i64>,
    common: &'a HashMap<String, Vec<Glued>>,
}

impl<'a> Reader<'a> {
    fn new(
        tokens: &'a [Glued],
        world: &'a World,
        indices: &HashMap<String, i64>,
        common: &'a HashMap<String, Vec<Glued>>,
    ) -> Self {
        let indices = indices.clone();
        Reader {
            tokens,
            next: 0,
            world,
            indices,
            common,
        }
    }

    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.next).map(|(token, _)| token)
    }

    fn accept(&mut self, symbol: char) -> bool {
        let found = self.peek() == Some(&Token::Symbol(symbol));
        self.next += usize::from(found);
        found
    }

    fn expect(&mut self, symbol: char) {
        assert!(
            self.accept(symbol),
            "{symbol} at {} of {:?}",
            self.next,
            self.tokens
        );
    }

    fn whole(&mut self) -> f64 {
        let value = self.sum();
        assert_eq!(self.next, self.tokens.len(), "{:?}", self.tokens);
        value
    }

    fn minus(&mut self) -> bool {
        self.accept('−') || self.accept('-')
    }

    fn sum(&mut self) -> f64 {
        let mut value = match self.minus() {
            true => -self.term(),
            false => self.term(),
        };
        loop {
            if self.minus() {
                value -= self.term();
            } else if self.accept('+') {
                value += self.term();
            } else {
                return value;
            }
        }
    }

    fn term(&mut self) -> f64 {
        let mut value = self.factor();
        loop {
            let divide = self.accept('/');
            let more = match self.peek() {
                Some(Token::Number(_) | Token::Name(_)) => true,
                Some(Token::Symbol(symbol)) => "(√Σ".contains(*symbol),
                _ => false,
            };
            match (divide, more) {
                (true, _) => value /= self.factor(),
                (_, true) => value *= self.factor(),
                _ => return value,
            }
        }
    }

    fn factor(&mut self) -> f64 {
        if self.accept('Σ') {
            self.expect('(');
            let end = self.closing();
            let range = &self.tokens[self.next..end];
            let values = Reader::new(range, self.world, &self.indices, self.common).range();
            self.next = end + 1;
            let (start, outer) = (self.next, self.indices.clone());
            let mut sum = 0.0;
            for value in values {
                self.next = start;
                self.indices.extend(value);
                sum += self.term();
            }
            if self.next == start {
                self.next = self.end_of_term();
            }
            self.indices = outer;
            return sum;
        }
        if self.accept('√') {
            return self.atom().sqrt();
        }
        let base = self.atom();
        if let Some(&Token::Raised(power)) = self.peek() {
            self.next += 1;
            return base.powi(power);
        }
        match self.accept('^') {
            true => {
                let power = self.atom();
                base.powf(power)
            }
            false => base,
        }
    }

    /// The place of the bracket that closes the present one.
    fn closing(&self) -> usize {
        let mut depth = 1;
        for (place, (token, _)) in self.tokens.iter().enumerate().skip(self.next) {
            depth += match token {
                Token::Symbol('(') => 1,
                Token::Symbol(')') => -1,
                _ => 0,
            };
            if depth == 0 {
                return place;
            }
        }
        panic!("{:?}", self.tokens)
    }

    /// The place after the present term.
    fn end_of_term(&self) -> usize {
        let mut depth = 0;
        for (place, (token, _)) in self.tokens.iter().enumerate().skip(self.next) {
            match token {
                Token::Symbol('(' | '[') => depth += 1,
                Token::Symbol(')' | ']') if depth > 0 => depth -= 1,
                Token::Symbol('+' | '−' | ')' | ']') if depth == 0 => return place,
                _ => {}
            }
        }
        self.tokens.len()
    }

    fn atom(&mut self) -> f64 {
        if self.accept('(') {
            let value = self.sum();
            self.expect(')');
            return value;
        }
        let token = self.peek().cloned();
        let name = match token {
            Some(Token::Number(value)) => {
                self.next += 1;
                return value;
            }
            Some(Token::Name(name)) => name,
            other => panic!("{other:?} in {:?}", self.tokens),
        };
        if let Some(definition) = self.common.get(&name) {
            self.next += 1;
            let is_glued = self.tokens.get(self.next).is_some_and(|(_, glued)| *glued);
            if is_glued && self.accept('(') {
                self.next = self.closing() + 1;
            }
            return Reader::new(definition, self.world, &self.indices, self.common).whole();
        }
        let function: Option<fn(f64) -> f64> = match name.as_str() {
            "sin" => Some(f64::sin),
            "cos" => Some(f64::cos),
            "exp" => Some(f64::exp),
            "π" => {
                self.next += 1;
                return std::f64::consts::PI;
            }
            _ => None,
        };
        if let Some(function) = function {
            self.next += 1;
            return function(self.atom());
        }
        let key = self.key();
        *self
            .world
            .values
            .get(&key)
            .unwrap_or_else(|| panic!("no value of {key}"))
    }

    /// A name with its indices.
    fn key(&mut self) -> String {
        let Some(Token::Name(name)) = self.peek().cloned() else {
            panic!("no name: {:?}", self.tokens);
        };
        self.next += 1;
        let mut indices = Vec::new();
        while self.accept('[') {
            loop {
                indices.push(self.index().to_string());
                if !self.accept(',') {
                    break;
                }
            }
            self.expect(']');
        }
        match indices.is_empty() {
            true => name,
            false => format!("{name}[{}]", indices.join(",")),
        }
    }

    fn index(&mut self) -> i64 {
        let mut value = match self.peek().cloned() {
            Some(Token::Number(number)) => number as i64,
            Some(Token::Name(name)) => {
                let found = self.indices.get(&name).or(self.world.lengths.get(&name));
                *found.unwrap_or_else(|| panic!("no index {name}: {:?}", self.tokens))
            }
            other => panic!("{other:?} in {:?}", self.tokens),
        };
        self.next += 1;
        if self.accept('+') {
            value += self.index();
        } else if self.minus() {
            value -= self.index();
        }
        value
    }

    /// The values of the indices in a range: `0 ≤ i < N`, or `(j′, j″) in rods`.
    fn range(&mut self) -> Vec<Vec<(String, i64)>> {
        let name = |reader: &mut Self| match reader.peek().cloned() {
            Some(Token::Name(name)) => {
                reader.next += 1;
                name
            }
            other => panic!("{other:?} in {:?}", reader.tokens),
        };
        if self.accept('(') {
            let first = name(self);
            self.expect(',');
            let second = name(self);
            self.expect(')');
            assert_eq!(name(self), "in");
            let list = &self.world.pairs[&name(self)];
            let number = first.trim_end_matches('′').to_owned();
            let all = list.iter().enumerate().map(|(k, [i, j])| {
                vec![
                    (number.clone(), k as i64),
                    (first.clone(), *i),
                    (second.clone(), *j),
                ]
            });
            return all.collect();
        }
        let start = self.index();
        self.expect('≤');
        let index = name(self);
        self.expect('<');
        let end = self.index();
        (start..end).map(|k| vec![(index.clone(), k)]).collect()
    }
}
