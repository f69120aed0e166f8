//! Calls of `multibody!` in a file, with the places that they have in it.

use std::fs;
use std::path::Path;

use proc_macro2::{LineColumn, TokenStream, TokenTree};

/// One call.
pub(crate) struct Call {
    /// Between its braces.
    pub(crate) tokens: TokenStream,
    /// Where `multibody` stands.
    pub(crate) at: LineColumn,
}

/// What a file holds.
#[derive(Default)]
pub(crate) struct Found {
    pub(crate) calls: Vec<Call>,
    /// Calls that a declarative macro writes: what stands at `$` is known where that macro is called.
    pub(crate) templates: Vec<LineColumn>,
    /// Where tokens end to be Rust.
    pub(crate) unreadable: Option<LineColumn>,
}

/// A file as it is told of.
pub(crate) struct File {
    pub(crate) name: String,
    pub(crate) text: String,
}

impl File {
    pub(crate) fn read(path: &Path) -> Result<File, String> {
        let name = path.display().to_string();
        let text = fs::read_to_string(path).map_err(|error| format!("{name}: {error}"))?;
        // The compiler does not count it either.
        let text = text.strip_prefix('\u{feff}').map_or(text.clone(), str::to_owned);
        Ok(File { name, text })
    }

    /// All calls in the order of the text.
    pub(crate) fn calls(&self) -> Found {
        let mut found = Found::default();
        if self.name.ends_with(".md") {
            blocks(&self.text).iter().for_each(|block| found.read(block));
        } else {
            found.read(&self.text);
        }
        found
    }
}

impl Found {
    fn read(&mut self, text: &str) {
        match text.parse() {
            Ok(tokens) => self.collect(tokens),
            Err(error) => self.unreadable = Some(self.unreadable.unwrap_or(error.span().start())),
        }
    }

    /// `multibody! { .. }`, however deep.
    fn collect(&mut self, tokens: TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        for (at, token) in tokens.iter().enumerate() {
            let TokenTree::Group(group) = token else { continue };
            let before = |back: usize| at.checked_sub(back).and_then(|at| tokens.get(at));
            match (before(2), before(1)) {
                (Some(TokenTree::Ident(word)), Some(TokenTree::Punct(bang)))
                    if word == "multibody" && bang.as_char() == '!' =>
                {
                    let at = word.span().start();
                    if is_template(group.stream()) {
                        self.templates.push(at);
                    } else {
                        self.calls.push(Call { tokens: group.stream(), at });
                    }
                }
                _ => self.collect(group.stream()),
            }
        }
    }
}

/// Whether a `$` stands anywhere in it.
fn is_template(tokens: TokenStream) -> bool {
    tokens.into_iter().any(|token| match token {
        TokenTree::Punct(punct) => punct.as_char() == '$',
        TokenTree::Group(group) => is_template(group.stream()),
        _ => false,
    })
}

/// Each block of Rust in a page, with empty lines for all that is no part of it, so that its tokens keep their places.
fn blocks(page: &str) -> Vec<String> {
    let mut blocks = Vec::new();
    let mut before = String::new();
    let mut open: Option<(bool, String)> = None;
    for line in page.lines() {
        let fence = line.trim_start().strip_prefix("```");
        match (&mut open, fence) {
            (None, Some(info)) => open = Some((info.starts_with("rust"), before.clone() + "\n")),
            (None, None) => {}
            (Some(_), Some(_)) => {
                let closed = open.take();
                blocks.extend(closed.filter(|(rust, _)| *rust).map(|(_, text)| text));
            }
            (Some((_, text)), None) => {
                text.push_str(&unhidden(line));
                text.push('\n');
            }
        }
        before.push('\n');
    }
    blocks
}

/// A line that rustdoc hides, `# use ..`, is part of the code.
fn unhidden(line: &str) -> String {
    let code = line.trim_start();
    if code == "#" || code.starts_with("# ") { line.replacen('#', " ", 1) } else { line.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(name: &str, text: &str) -> Vec<(usize, usize)> {
        let file = File { name: name.to_owned(), text: text.to_owned() };
        file.calls().calls.iter().map(|call| (call.at.line, call.at.column)).collect()
    }

    #[test]
    fn calls_are_found_however_deep() {
        let text = "use multibody::multibody;\nmod a { multibody! { mod b {} } }\nfn f() { multibody::multibody!(mod c {}); }\n";
        assert_eq!(places("a.rs", text), [(2, 8), (3, 20)]);
        assert_eq!(places("a.rs", "macro_rules! multibody { () => {} }"), []);
    }

    #[test]
    fn blocks_of_a_page_keep_their_lines() {
        let page = "A page.\n\n```rust\n# use m;\nmultibody! { mod a {} }\n```\n```text\nmultibody! { mod b {} }\n```\n```rust\nmultibody! {}\n```\n";
        assert_eq!(places("a.md", page), [(5, 0), (11, 0)]);
        assert_eq!(blocks(page)[0].lines().nth(3), Some("  use m;"));
    }

    #[test]
    fn templates_are_told_apart() {
        let text = "macro_rules! m { ($n:ident) => { multibody! { mod $n {} } } }";
        let file = File { name: "a.rs".into(), text: text.into() };
        let found = file.calls();
        assert_eq!((found.calls.len(), found.templates.len()), (0, 1));
    }

    #[test]
    fn what_is_no_rust_has_a_place() {
        let file = File { name: "a.rs".into(), text: "fn f() {\n  \"open\n".into() };
        assert!(file.calls().unreadable.is_some());
    }
}
