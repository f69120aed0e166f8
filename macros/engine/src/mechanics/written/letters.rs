//! Room `written`: letters that stand for matrices and terms, kept apart from users' names.
//!
//! In: a page. Out: the same; where a user's vector or array has the name of a term, so that `c[x]` would be both, the term has another
//! letter, in equations and in what is said of them. Names of users stay what they are, but for the `r#` of Rust.

use std::collections::{HashMap, HashSet};

use crate::symbolic::write::formula::{Class, Identifier};
use crate::symbolic::write::vacant;

use super::Page;

/// Mass matrix, terms of the equations of motion, slopes and rests of what follows, constraints with Jacobian and multipliers.
const LETTERS: [&str; 9] = ["M", "c", "g", "Q", "S", "gamma", "Phi", "G", "lambda"];

impl Page {
    pub(super) fn keep_letters_apart(&mut self) {
        self.each_name(&mut |name| {
            name.text = name.text.replace("r#", "");
            name.index = name.index.as_ref().map(|index| index.replace("r#", ""));
        });
        let own = |name: &Identifier| matches!(name.class, Class::Defined | Class::Multiplier);
        let users: Vec<Identifier> =
            self.symbols.iter().map(|(name, _)| name).filter(|name| !own(name)).cloned().collect();
        let mut taken: HashSet<String> = HashSet::new();
        self.each_name(&mut |name| {
            taken.insert(name.text.clone());
        });
        let clashes = |letter: &str| {
            let is_array = |name: &Identifier| name.text.strip_prefix(letter).is_some_and(|rest| rest.starts_with('['));
            users.iter().any(|name| name.text == letter && name.index.is_some() || is_array(name))
        };
        let renamed: HashMap<&str, String> = LETTERS
            .into_iter()
            .filter(|letter| clashes(letter))
            .map(|letter| (letter, vacant(&format!("{letter}_1"), &mut taken)))
            .collect();
        if renamed.is_empty() {
            return;
        }
        self.each_name(&mut |name| {
            if own(name)
                && name.index.is_some()
                && let Some(letter) = renamed.get(name.text.as_str())
            {
                name.text.clone_from(letter);
            }
        });
        for says in self.sections.iter_mut().flat_map(|section| &mut section.says) {
            *says = with_words(says, &renamed);
        }
    }
}

/// With other letters, where these are words of their own.
fn with_words(says: &str, renamed: &HashMap<&str, String>) -> String {
    let mut result = String::new();
    let mut word = String::new();
    for letter in says.chars().chain(['\n']) {
        if letter.is_alphanumeric() || letter == '_' {
            word.push(letter);
            continue;
        }
        result.push_str(renamed.get(word.as_str()).unwrap_or(&word));
        word.clear();
        result.push(letter);
    }
    result.pop();
    result
}
