//! Stage `robots`: XML, with places and bounds.
//!
//! In: the text of a file. Out: its elements, numbers with all their digits, or the first mistake. A definition of entities is
//! refused, so that nothing in a file grows as it is read.

use roxmltree::{Document, Node, ParsingOptions};

use super::mistake::{Mistake, Place};
use super::robot::Number;

/// Bytes of a file.
const LONGEST: usize = 8 << 20;
/// Elements, attributes and texts.
const MOST_NODES: u32 = 200_000;
/// Elements within one another: the reader of XML recurses.
const DEEPEST: usize = 64;
/// Digits of one number, as in the language.
const MOST_DIGITS: usize = 800;

/// What to do about macros.
pub(super) const XACRO: &str = "write the robot out first: `xacro robot.urdf.xacro > robot.urdf`";

/// Where lines begin.
pub(super) struct Lines<'a> {
    text: &'a str,
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a str) -> Lines<'a> {
        let behind = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at + 1);
        Lines { text, starts: std::iter::once(0).chain(behind).collect() }
    }

    fn place(&self, byte: usize) -> Place {
        let line = self.starts.partition_point(|start| *start <= byte).max(1);
        let before = self.text.get(self.starts[line - 1]..byte).unwrap_or_default();
        Place { line, column: before.chars().count() + 1 }
    }

    pub(super) fn of(&self, node: Node) -> Place {
        self.place(node.range().start)
    }
}

pub(super) fn parse(text: &str) -> Result<Document<'_>, Mistake> {
    if text.len() > LONGEST {
        return Err(Mistake::file(format!("the file has more than {LONGEST} bytes")));
    }
    if let Some(byte) = too_deep(text) {
        let message = format!("elements are nested more than {DEEPEST} deep");
        return Err(Mistake::at(Lines::new(text).place(byte), message));
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| match error {
        roxmltree::Error::DtdDetected => Mistake::file("a document type is not read").help("remove `<!DOCTYPE ..>`"),
        roxmltree::Error::NodesLimitReached => Mistake::file(format!("the file has more than {MOST_NODES} elements")),
        error => {
            let place = Place { line: error.pos().row as usize, column: error.pos().col as usize };
            // The reader of XML ends its own words with the place.
            let words = error.to_string();
            let words = words.rsplit_once(" at ").map_or(words.as_str(), |(words, _)| words);
            let mistake = Mistake::at(place, format!("no XML: {words}"));
            match error {
                roxmltree::Error::UnknownNamespace(space, _) if space == "xacro" => mistake.help(XACRO),
                _ => mistake,
            }
        }
    })
}

/// Where elements may be nested too deep, counted by brackets alone: never less than what they are.
fn too_deep(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let mut depth = 0_usize;
    let mut at = 0;
    while let Some(found) = bytes.get(at..).and_then(|rest| rest.iter().position(|byte| *byte == b'<')) {
        let start = at + found;
        let rest = &text.as_bytes()[start..];
        let skip =
            |end: &[u8]| rest.windows(end.len()).position(|window| window == end).map_or(rest.len(), |k| k + end.len());
        let length = if rest.starts_with(b"<!--") {
            skip(b"-->")
        } else if rest.starts_with(b"<![CDATA[") {
            skip(b"]]>")
        } else if rest.starts_with(b"</") {
            depth = depth.saturating_sub(1);
            skip(b">")
        } else if rest.starts_with(b"<?") || rest.starts_with(b"<!") {
            skip(b">")
        } else {
            let length = tag(rest);
            if !rest[..length].ends_with(b"/>") {
                depth += 1;
            }
            length
        };
        if depth > DEEPEST {
            return Some(start);
        }
        at = start + length;
    }
    None
}

/// Bytes to the end of a tag, past the texts of its attributes.
fn tag(rest: &[u8]) -> usize {
    let mut quote = None;
    for (k, byte) in rest.iter().enumerate() {
        match (quote, byte) {
            (None, b'>') => return k + 1,
            (None, b'"' | b'\'') => quote = Some(*byte),
            (Some(open), byte) if open == *byte => quote = None,
            _ => {}
        }
    }
    rest.len()
}

/// An element of the file.
#[derive(Clone, Copy)]
pub(super) struct Element<'a, 'input> {
    pub(super) node: Node<'a, 'input>,
    pub(super) lines: &'a Lines<'a>,
}

impl<'a, 'input> Element<'a, 'input> {
    pub(super) fn name(self) -> &'a str {
        self.node.tag_name().name()
    }

    pub(super) fn place(self) -> Place {
        self.lines.of(self.node)
    }

    pub(super) fn mistake(self, message: impl Into<String>) -> Mistake {
        Mistake::at(self.place(), message)
    }

    pub(super) fn children(self) -> impl Iterator<Item = Element<'a, 'input>> {
        let lines = self.lines;
        self.node.children().filter(Node::is_element).map(move |node| Element { node, lines })
    }

    /// The one child of this name, if there is one.
    pub(super) fn child(self, name: &str) -> Result<Option<Element<'a, 'input>>, Mistake> {
        let mut found = self.children().filter(|child| child.name() == name);
        let first = found.next();
        match found.next() {
            Some(second) => Err(second.mistake(format!("`<{}>` has two `<{name}>`", self.name()))),
            None => Ok(first),
        }
    }

    pub(super) fn wanted_child(self, name: &str) -> Result<Element<'a, 'input>, Mistake> {
        let message = || self.mistake(format!("`<{}>` has no `<{name}>`", self.name()));
        self.child(name)?.ok_or_else(message)
    }

    /// What is said but not understood would be left out of the model.
    pub(super) fn only(self, names: &[&str]) -> Result<Self, Mistake> {
        match self.node.attributes().find(|attribute| !names.contains(&attribute.name())) {
            Some(other) => Err(self.mistake(format!("`{}` of `<{}>` is not supported", other.name(), self.name()))),
            None => Ok(self),
        }
    }

    pub(super) fn attribute(self, name: &str) -> Option<&'a str> {
        self.node.attribute(name)
    }

    pub(super) fn wanted(self, name: &str) -> Result<&'a str, Mistake> {
        let message = || self.mistake(format!("`<{}>` has no `{name}`", self.name()));
        self.attribute(name).ok_or_else(message)
    }

    /// So many numbers with blanks between.
    pub(super) fn numbers<const N: usize>(self, name: &str) -> Result<Option<[Number; N]>, Mistake> {
        if self.attribute(name).is_none() {
            return Ok(None);
        }
        let numbers = self.list(name)?;
        let found = numbers.len();
        let wrong = |_| {
            self.mistake(format!(
                "`{name}` of `<{}>` has {N} number{}, found {found}",
                self.name(),
                if N == 1 { "" } else { "s" }
            ))
        };
        numbers.try_into().map(Some).map_err(wrong)
    }

    /// All numbers, none if there is no such attribute.
    pub(super) fn list(self, name: &str) -> Result<Vec<Number>, Mistake> {
        let words = self.attribute(name).unwrap_or_default().split_ascii_whitespace();
        words.map(|word| self.read(name, word)).collect()
    }

    pub(super) fn number(self, name: &str) -> Result<Option<Number>, Mistake> {
        Ok(self.numbers::<1>(name)?.map(|[number]| number))
    }

    pub(super) fn wanted_number(self, name: &str) -> Result<Number, Mistake> {
        self.wanted(name)?;
        let message = || self.mistake(format!("`<{}>` has no `{name}`", self.name()));
        self.number(name)?.ok_or_else(message)
    }

    fn read(self, name: &str, word: &str) -> Result<Number, Mistake> {
        number(word).ok_or_else(|| {
            let short: String = word.chars().take(40).collect();
            self.mistake(format!("`{short}` in `{name}` of `<{}>` is no number", self.name()))
        })
    }
}

/// A decimal number, its digits as they are written, with the zeros before and behind the point that a literal has.
pub(super) fn number(word: &str) -> Option<Number> {
    let (is_negative, rest) = match word.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, word.strip_prefix('+').unwrap_or(word)),
    };
    let (mantissa, exponent) = match rest.find(['e', 'E']) {
        Some(at) => (&rest[..at], Some(&rest[at + 1..])),
        None => (rest, None),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let are_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if word.len() > MOST_DIGITS || whole.len() + fraction.len() == 0 || !are_digits(whole) || !are_digits(fraction) {
        return None;
    }
    let some = |text: &str| if text.is_empty() { "0".to_owned() } else { text.to_owned() };
    let mut digits = format!("{}.{}", some(whole), some(fraction));
    if let Some(exponent) = exponent {
        let plain = exponent.strip_prefix(['-', '+']).unwrap_or(exponent);
        if plain.is_empty() || !are_digits(plain) {
            return None;
        }
        digits.push('e');
        digits.push_str(exponent.strip_prefix('+').unwrap_or(exponent));
    }
    let value: f64 = digits.parse().ok()?;
    let value = if is_negative { -value } else { value };
    value.is_finite().then_some(Number { is_negative, digits, value })
}
