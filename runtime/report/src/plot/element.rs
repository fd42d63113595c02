//! Elements of SVG and HTML.

use core::fmt::{self, Display, Write};

/// An element with attributes and content.
#[derive(Clone, Debug)]
pub struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Node>,
}

#[derive(Clone, Debug)]
enum Node {
    Element(Element),
    Text(String),
    /// Raw markup.
    Markup(String),
}

impl Element {
    pub const fn new(name: &'static str) -> Self {
        Self {
            name,
            attributes: Vec::new(),
            children: Vec::new(),
        }
    }

    /// Adds an attribute.
    pub fn with(mut self, name: &'static str, value: impl Display) -> Self {
        self.attributes.push((name, value.to_string()));
        self
    }

    /// Adds a length or position in pixels, rounded to a tenth.
    pub fn at(self, name: &'static str, value: f64) -> Self {
        self.with(name, Pixels(value))
    }

    /// Adds a child element.
    pub fn child(mut self, child: Self) -> Self {
        self.children.push(Node::Element(child));
        self
    }

    /// Adds child elements.
    pub fn children(mut self, children: impl IntoIterator<Item = Self>) -> Self {
        self.children
            .extend(children.into_iter().map(Node::Element));
        self
    }

    /// Adds text, escaped.
    pub fn text(mut self, text: impl Into<String>) -> Self {
        self.children.push(Node::Text(text.into()));
        self
    }

    /// Adds raw markup.
    pub fn markup(mut self, markup: impl Into<String>) -> Self {
        self.children.push(Node::Markup(markup.into()));
        self
    }
}

impl Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "<{}", self.name)?;
        for (name, value) in &self.attributes {
            write!(f, " {name}=\"{}\"", Escaped(value))?;
        }
        // In HTML only void elements may be self-closing.
        if self.children.is_empty() && !matches!(self.name, "td" | "th" | "p" | "span" | "div") {
            return f.write_str("/>");
        }
        f.write_char('>')?;
        for child in &self.children {
            match child {
                Node::Element(element) => element.fmt(f)?,
                Node::Text(text) => Escaped(text).fmt(f)?,
                Node::Markup(markup) => f.write_str(markup)?,
            }
        }
        write!(f, "</{}>", self.name)
    }
}

/// A text escaped for markup.
struct Escaped<'a>(&'a str);

impl Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for c in self.0.chars() {
            match c {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                c => f.write_char(c)?,
            }
        }
        Ok(())
    }
}

/// A position in pixels, rounded to a tenth.
pub struct Pixels(pub f64);

impl Display for Pixels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Avoids −0.
        let tenths = (10.0 * self.0).round() + 0.0;
        write!(f, "{}", tenths / 10.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_escaped_and_places_rounded() {
        let element = Element::new("text")
            .at("x", -0.04)
            .at("y", 12.26)
            .with("class", "a\"b")
            .text("q < p & p > 0")
            .child(Element::new("tspan"));
        assert_eq!(
            element.to_string(),
            "<text x=\"0\" y=\"12.3\" class=\"a&quot;b\">q &lt; p &amp; p &gt; 0<tspan/></text>"
        );
    }
}
