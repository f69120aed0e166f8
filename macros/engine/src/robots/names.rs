//! Stage `robots`: names of links and joints in the language.
//!
//! In: the names of a file. Out: one identifier for each. What no identifier has becomes `_`; `_` stands before a digit at the
//! beginning and behind a name that the language or Rust needs; a joint that is called as a link has `_joint` behind it.

use std::collections::HashMap;

use crate::model::names::{module_refusal, refusal};

use super::mistake::{Mistake, Place};
use super::robot::Robot;

/// Words that braces stand behind at the head of an item: no body can be called so.
const HEADS: [&str; 2] = ["world", "formulation"];

pub(super) struct Names {
    pub(super) links: Vec<String>,
    pub(super) joints: Vec<String>,
    /// Everything that has a name, with the words for it.
    taken: HashMap<String, String>,
}

impl Names {
    pub(super) fn of(robot: &Robot) -> Result<Names, Mistake> {
        let mut names = Names { links: Vec::new(), joints: Vec::new(), taken: HashMap::new() };
        for link in &robot.links {
            let name = identifier(&link.name, link.at)?;
            names.take(&name, format!("link `{}`", link.name), Some(link.at))?;
            names.links.push(name);
        }
        for joint in &robot.joints {
            let mut name = identifier(&joint.name, joint.at)?;
            if names.links.contains(&name) {
                name.push_str("_joint");
            }
            names.take(&name, format!("joint `{}`", joint.name), Some(joint.at))?;
            names.joints.push(name);
        }
        Ok(names)
    }

    /// Enters a name, of which there may be one.
    pub(super) fn take(&mut self, name: &str, what: String, at: Option<Place>) -> Result<(), Mistake> {
        if let Some(first) = self.taken.get(name) {
            let message = format!("{what} and {first} would both be `{name}`");
            return Err(Mistake { at, message, help: Some("names differ by letters, digits and `_`".to_owned()) });
        }
        self.taken.insert(name.to_owned(), what);
        Ok(())
    }

    /// Of a motor or of a joint that closes a loop: files give them the names of others.
    pub(super) fn own(&mut self, name: &str, at: Place) -> Result<String, Mistake> {
        let mut own = identifier(name, at)?;
        if self.taken.contains_key(&own) {
            own.push('_');
        }
        self.take(&own, format!("`{name}`"), Some(at))?;
        Ok(own)
    }

    /// A name that nothing has yet.
    pub(super) fn free(&mut self, wish: &str) -> String {
        let mut name = wish.to_owned();
        while self.taken.contains_key(&name) {
            name.push('_');
        }
        self.taken.insert(name.clone(), "the base".to_owned());
        name
    }
}

/// Of a part, from what a robot is called.
pub(super) fn module(name: &str) -> String {
    let name = identifier(name, Place { line: 1, column: 1 }).unwrap_or_else(|_| "robot".to_owned());
    // The model beside it has that name.
    let name = if name == "model" { "robot".to_owned() } else { name };
    if module_refusal(&name).is_some() { format!("{name}_") } else { name }
}

fn identifier(name: &str, at: Place) -> Result<String, Mistake> {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let mut text: String = name.chars().map(letter).collect();
    if !text.contains(|c: char| c != '_') {
        return Err(Mistake::at(at, format!("the name `{}` has no letter and no digit", printable(name))));
    }
    if text.starts_with(|c: char| c.is_ascii_digit()) {
        text.insert(0, '_');
    }
    if refusal(&text).is_some() || HEADS.contains(&text.as_str()) {
        text.push('_');
    }
    Ok(text)
}

/// On one line.
pub(super) fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(80).collect()
}
