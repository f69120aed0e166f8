//! XML with places: elements, and attributes that have been asked for.

use std::cell::RefCell;
use std::ops::Range;

use roxmltree::{Attribute, Document, Error, Node, ParsingOptions};

use super::Wrong;
use super::number::Number;
use super::robot::Placed;

/// Bytes of a file: a robot with meshes beside it has some hundred thousand.
const LONGEST: usize = 16 << 20;
/// Elements, texts and comments.
const MOST_NODES: u32 = 1_000_000;

pub(super) fn parse(text: &str) -> Result<Document<'_>, Wrong> {
    if text.len() > LONGEST {
        return Err(Wrong::new(&(0..0), format!("the file has {} bytes; {LONGEST} are read", text.len())));
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| {
        let place = error.pos();
        let at = match error {
            Error::UnexpectedEndOfStream | Error::UnclosedRootNode => text.trim_end().len(),
            _ => offset(text, place.row, place.col),
        };
        let at = at..at;
        match error {
            Error::UnknownNamespace(prefix, _) if prefix == "xacro" => xacro(&at),
            Error::DtdDetected => Wrong::new(&at, "a document type is declared here, and none is read"),
            Error::NodesLimitReached => Wrong::new(&at, format!("more than {MOST_NODES} elements")),
            // The place is told beside it.
            error => {
                let words = error.to_string().replace(&format!(" at {place}"), "");
                Wrong::new(&at, format!("this is not XML: {words}"))
            }
        }
    })
}

/// What a file of macros is told.
pub(super) fn xacro(at: &Range<usize>) -> Wrong {
    Wrong::help(at, "this file is of xacro, which writes URDF", "run `xacro FILE > robot.urdf` and import that")
}

/// Bytes before a row and a column, both counted from one.
fn offset(text: &str, row: u32, column: u32) -> usize {
    let rows = text.split_inclusive('\n').take(row.saturating_sub(1) as usize);
    let start: usize = rows.map(str::len).sum();
    let before = text[start..].chars().take(column.saturating_sub(1) as usize);
    start + before.map(char::len_utf8).sum::<usize>()
}

/// An element of which everything has to be understood.
pub(super) struct Element<'a, 'i> {
    node: Node<'a, 'i>,
    read: RefCell<Vec<&'a str>>,
}

impl<'a, 'i> Element<'a, 'i> {
    pub(super) fn new(node: Node<'a, 'i>) -> Element<'a, 'i> {
        Element { node, read: RefCell::new(Vec::new()) }
    }

    /// Its start, `<joint`.
    pub(super) fn at(&self) -> Range<usize> {
        let start = self.node.range().start;
        start..start + 1 + self.name().len()
    }

    pub(super) fn name(&self) -> &'a str {
        self.node.tag_name().name()
    }

    /// Of another vocabulary than the document, `drake:..`.
    pub(super) fn is_foreign(&self) -> bool {
        self.node.tag_name().namespace() != self.node.document().root_element().tag_name().namespace()
    }

    pub(super) fn children(&self) -> impl Iterator<Item = Element<'a, 'i>> + use<'a, 'i> {
        self.node.children().filter(Node::is_element).map(Element::new)
    }

    /// The only child of this name, if it is there.
    pub(super) fn child(&self, name: &str) -> Result<Option<Element<'a, 'i>>, Wrong> {
        let mut all = self.children().filter(|child| child.name() == name && !child.is_foreign());
        let first = all.next();
        match all.next() {
            Some(second) => Err(Wrong::new(&second.at(), format!("`{}` has two elements `{name}`", self.name()))),
            None => Ok(first),
        }
    }

    pub(super) fn required_child(&self, name: &str) -> Result<Element<'a, 'i>, Wrong> {
        self.child(name)?.ok_or_else(|| Wrong::new(&self.at(), format!("`{}` has no element `{name}`", self.name())))
    }

    fn attribute(&self, name: &'a str) -> Option<Attribute<'a, 'i>> {
        self.read.borrow_mut().push(name);
        self.node.attributes().find(|attribute| attribute.name() == name && attribute.namespace().is_none())
    }

    pub(super) fn text(&self, name: &'a str) -> Option<Placed<String>> {
        self.attribute(name).map(|found| Placed { value: found.value().to_owned(), at: found.range_value() })
    }

    /// A text that is not empty.
    pub(super) fn required(&self, name: &'a str) -> Result<Placed<String>, Wrong> {
        match self.text(name) {
            Some(text) if text.value.trim().is_empty() => {
                Err(Wrong::new(&text.at, format!("the attribute `{name}` of `{}` is empty", self.name())))
            }
            Some(text) => Ok(text),
            None => Err(Wrong::new(&self.at(), format!("`{}` has no attribute `{name}`", self.name()))),
        }
    }

    pub(super) fn number(&self, name: &'a str) -> Result<Option<Placed<Number>>, Wrong> {
        self.text(name)
            .map(|text| match Number::read(text.value.trim()) {
                Some(value) => Ok(Placed { value, at: text.at }),
                None => Err(Wrong::new(
                    &text.at,
                    format!("`{name}` is one finite number, and not `{}`", shown(&text.value)),
                )),
            })
            .transpose()
    }

    pub(super) fn required_number(&self, name: &'a str) -> Result<Placed<Number>, Wrong> {
        self.required(name)?;
        self.number(name)?.ok_or_else(|| Wrong::new(&self.at(), format!("`{}` has no `{name}`", self.name())))
    }

    /// Three numbers with blanks between them.
    pub(super) fn vector(&self, name: &'a str) -> Result<Option<[Number; 3]>, Wrong> {
        let Some(text) = self.text(name) else { return Ok(None) };
        let numbers: Option<Vec<Number>> = text.value.split_whitespace().map(Number::read).collect();
        let three = numbers.and_then(|numbers| <[Number; 3]>::try_from(numbers).ok());
        let message =
            || format!("`{name}` is three finite numbers with blanks between them, and not `{}`", shown(&text.value));
        three.map(Some).ok_or_else(|| Wrong::new(&text.at, message()))
    }

    /// Attributes that nobody has asked for would be left out without a word.
    pub(super) fn no_others(&self) -> Result<(), Wrong> {
        let read = self.read.borrow();
        let other = self.node.attributes().find(|found| found.namespace().is_none() && !read.contains(&found.name()));
        match other {
            Some(found) => {
                let known = read.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
                let message = format!("unknown attribute `{}` of `{}`", found.name(), self.name());
                Err(Wrong::help(&found.range_qname(), message, format!("it has {known}")))
            }
            None => Ok(()),
        }
    }

    /// Whether an expression of xacro is left in an attribute.
    pub(super) fn expression(&self) -> Option<Range<usize>> {
        let mut attributes = self.node.attributes();
        attributes.find(|found| found.value().contains("${")).map(|found| found.range_value())
    }

    pub(super) fn is_of_xacro(&self) -> bool {
        self.node.tag_name().namespace().is_some_and(|namespace| namespace.ends_with("/xacro"))
    }
}

/// The beginning of what a file says, on one line.
fn shown(text: &str) -> String {
    let line: String = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(40) {
        Some((end, _)) => format!("{}..", &line[..end]),
        None => line,
    }
}
