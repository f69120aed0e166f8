//! Spanned errors, gathered and reported all at once.
//!
//! In: errors of any stage. Out: one `compile_error!` per mistake, at the user's token.

use proc_macro2::{Span, TokenStream};

/// All mistakes found so far.
#[derive(Default)]
pub struct Diagnostics {
    errors: Vec<Diagnostic>,
}

/// One mistake: where, what, and what to do about it.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// The user's own token.
    pub span: Span,
    /// What is wrong: lower case, no full stop.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
}

impl Diagnostics {
    /// Adds an error at `span`.
    pub fn error(&mut self, span: Span, message: impl Into<String>) {
        self.errors.push(Diagnostic { span, message: message.into(), help: None });
    }

    /// Adds an error with a suggestion.
    pub fn error_help(&mut self, span: Span, message: impl Into<String>, help: impl Into<String>) {
        self.errors.push(Diagnostic { span, message: message.into(), help: Some(help.into()) });
    }

    /// Whether all is well so far.
    pub fn is_empty(&self) -> bool {
        self.errors.is_empty()
    }

    /// The errors in the order in which they were found.
    pub fn errors(&self) -> &[Diagnostic] {
        &self.errors
    }

    /// The errors as tokens: one `compile_error!` each.
    pub fn to_tokens(&self) -> TokenStream {
        self.errors
            .iter()
            .map(|e| {
                let text = match &e.help {
                    Some(help) => format!("{}\n  help: {help}", e.message),
                    None => e.message.clone(),
                };
                syn::Error::new(e.span, text).to_compile_error()
            })
            .collect()
    }
}

/// The candidate that `name` was probably meant to be, for 'did you mean'; the first one where several are as near.
///
/// Near means: at most a third of the letters are wrong (at least one may be), where a letter too many, a letter too
/// few, a wrong letter and two swapped letters count one each, and a wrong case counts nothing. `name` itself is no
/// answer.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let letters = lower(name);
    let limit = (letters.len() / 3).max(1);
    let mut best: Option<(usize, &'a str)> = None;
    for candidate in candidates {
        let other = lower(candidate);
        // One letter is never near another: `x` is not a misspelt `y`.
        if candidate == name || letters.len().min(other.len()) < 2 && letters != other {
            continue;
        }
        if letters.len().abs_diff(other.len()) > limit {
            continue;
        }
        let distance = edit_distance(&letters, &other);
        if distance <= limit && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Long names are cut: the cost of a comparison stays bounded whatever the input.
fn lower(name: &str) -> Vec<char> {
    name.chars().take(64).flat_map(char::to_lowercase).collect()
}

/// Optimal string alignment distance: Levenshtein's, and neighbours swapped count one.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut row = vec![i + 1];
        let mut left = i + 1;
        for (j, y) in b.iter().enumerate() {
            let at = |row: &[usize], j: usize| row.get(j).copied().unwrap_or(usize::MAX / 2);
            let mut least = (at(&last, j) + usize::from(x != y)).min(at(&last, j + 1) + 1);
            least = least.min(left + 1);
            let swapped = i > 0 && j > 0 && a.get(i - 1) == Some(y) && b.get(j - 1) == Some(x);
            if swapped {
                least = least.min(at(&before, j - 1) + 1);
            }
            row.push(least);
            left = least;
        }
        before = std::mem::replace(&mut last, row);
    }
    last.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn near_names_are_found() {
        let names = ["body", "joint", "force", "m", "x", "shoulder", "elbow"];
        let near = |name| nearest(name, names);
        assert_eq!(near("jiont"), Some("joint"));
        assert_eq!(near("join"), Some("joint"));
        assert_eq!(near("bodies"), None);
        assert_eq!(near("bodyy"), Some("body"));
        assert_eq!(near("Body"), Some("body"));
        assert_eq!(near("sholuder"), Some("shoulder"));
        assert_eq!(near("body"), None);
        assert_eq!(near("y"), None);
        assert_eq!(near("M"), Some("m"));
        assert_eq!(near(""), None);
        assert_eq!(nearest("abd", ["abe", "abc"]), Some("abe"));
    }
}
