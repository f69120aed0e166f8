//! Room `written`: letters that stand for matrices and terms, kept apart from users' names.
//!
//! In: names of users. Out: for each letter the one that pages have: where a vector or an array of the user's has the name of a
//! term, so that `c[x]` would be both, the term has another letter, in equations and in what is said of them.

use std::collections::{HashMap, HashSet};

use crate::symbolic::write::formula::{Class, Identifier};
use crate::symbolic::write::vacant;

use super::Page;

/// Mass matrix, terms of the equations of motion, slopes and rests of what follows, constraints with Jacobian and multipliers,
/// and what closed forms are made of.
const LETTERS: [&str; 19] =
    ["M", "c", "g", "Q", "S", "gamma", "Phi", "G", "lambda", "A", "B", "C", "D", "Delta", "r", "u", "v", "kappa", "N"];

pub(super) struct Letters(HashMap<&'static str, String>);

impl Letters {
    /// `users` are the names of what has components, `taken` all names.
    pub(super) fn new(users: &[Identifier], taken: &mut HashSet<String>) -> Letters {
        let clashes = |letter: &str| {
            let is_array = |name: &Identifier| name.text.strip_prefix(letter).is_some_and(|rest| rest.starts_with('['));
            users.iter().any(|name| name.text == letter && name.index.is_some() || is_array(name))
        };
        let letters = LETTERS.into_iter().map(|letter| {
            let own = if clashes(letter) { vacant(&format!("{letter}_1"), taken) } else { letter.to_owned() };
            (letter, own)
        });
        Letters(letters.collect())
    }

    /// The letter of a page.
    pub(super) fn word(&self, letter: &str) -> &str {
        &self.0[letter]
    }

    /// A letter with an index.
    pub(super) fn entry(&self, letter: &str, index: String) -> Identifier {
        let text = self.word(letter).to_owned();
        Identifier { text, dots: 0, index: Some(index), class: Class::Defined, typed: false }
    }

    /// A sentence with the letters of a page: those of the list, where they are words of their own.
    pub(super) fn sentence(&self, says: &str) -> String {
        let mut result = String::new();
        let mut word = String::new();
        for letter in says.chars().chain(['\n']) {
            if letter.is_alphanumeric() || letter == '_' {
                word.push(letter);
                continue;
            }
            result.push_str(self.0.get(word.as_str()).unwrap_or(&word));
            word.clear();
            result.push(letter);
        }
        result.pop();
        result
    }
}

/// A name without the `r#` of Rust.
pub(super) fn plain(mut name: Identifier) -> Identifier {
    name.text = name.text.replace("r#", "");
    name.index = name.index.map(|index| index.replace("r#", ""));
    name
}

impl Page {
    /// Names are what they are without the `r#` of Rust.
    pub(super) fn without_raw_names(&mut self) {
        self.each_name(&mut |name| *name = plain(name.clone()));
        for section in &mut self.sections {
            let said = section.says.iter_mut().chain(section.lines.iter_mut().filter_map(|line| line.says.as_mut()));
            said.for_each(|says| *says = says.replace("r#", ""));
        }
    }
}
