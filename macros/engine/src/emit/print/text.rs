//! Stage `emit`: tokens as readable text.
//!
//! In: tokens. Out: Rust source with line breaks and `///` comments, which rustfmt makes handsome; good enough to read
//! without it.

use std::fmt::Write;

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};

/// Tokens as source text.
pub fn source(tokens: &TokenStream) -> String {
    let mut printer = Printer::default();
    printer.stream(tokens.clone(), Delimiter::None);
    printer.line();
    printer.text
}

#[derive(Default)]
struct Printer {
    text: String,
    depth: usize,
    /// Whether a space belongs before the next word.
    gap: bool,
}

impl Printer {
    fn stream(&mut self, tokens: TokenStream, delimiter: Delimiter) {
        let mut tokens = tokens.into_iter().peekable();
        while let Some(token) = tokens.next() {
            match token {
                TokenTree::Punct(hash) if hash.as_char() == '#' => {
                    let doc = match tokens.peek() {
                        Some(TokenTree::Group(group)) => doc_text(group.stream()),
                        _ => None,
                    };
                    match doc {
                        Some(text) => {
                            tokens.next();
                            self.line();
                            // What stands over statements documents nothing.
                            let slashes = if text.starts_with("//") { "" } else { "///" };
                            let _ = write!(self.text, "{slashes}{text}");
                            self.line();
                        }
                        None => self.word("#", false),
                    }
                }
                TokenTree::Punct(punct) => {
                    let joint = punct.spacing() == Spacing::Joint;
                    self.word(&punct.to_string(), !joint);
                    let end = match punct.as_char() {
                        ';' => true,
                        ',' => delimiter == Delimiter::Brace,
                        _ => false,
                    };
                    if end {
                        self.line();
                    }
                }
                TokenTree::Group(group) => self.group(group.delimiter(), group.stream()),
                other => self.word(&other.to_string(), true),
            }
        }
    }

    fn group(&mut self, delimiter: Delimiter, tokens: TokenStream) {
        let (open, close) = match delimiter {
            Delimiter::Brace => ("{", "}"),
            Delimiter::Parenthesis => ("(", ")"),
            Delimiter::Bracket => ("[", "]"),
            Delimiter::None => ("", ""),
        };
        let breaks = delimiter == Delimiter::Brace && !tokens.is_empty();
        self.word(open, false);
        if breaks {
            self.depth += 1;
            self.line();
        }
        self.gap = false;
        self.stream(tokens, delimiter);
        self.gap = false;
        if breaks {
            self.depth -= 1;
            self.line();
        }
        self.word(close, true);
    }

    fn word(&mut self, word: &str, gap_after: bool) {
        if self.text.is_empty() || self.text.ends_with('\n') {
            self.text.push_str(&"    ".repeat(self.depth));
        } else if self.gap && !matches!(word, "," | ";" | "(" | "[" | ")" | "]" | "?") {
            self.text.push(' ');
        }
        self.text.push_str(word);
        self.gap = gap_after;
    }

    fn line(&mut self) {
        if !self.text.is_empty() && !self.text.ends_with('\n') {
            self.text.push('\n');
        }
        self.gap = false;
    }
}

/// The text of `[doc = ".."]`, if it is one line.
fn doc_text(attribute: TokenStream) -> Option<String> {
    let mut tokens = attribute.into_iter();
    match (tokens.next(), tokens.next(), tokens.next(), tokens.next()) {
        (Some(TokenTree::Ident(name)), Some(TokenTree::Punct(_)), Some(TokenTree::Literal(literal)), None)
            if name == "doc" =>
        {
            let text = syn::parse_str::<syn::LitStr>(&literal.to_string()).ok()?.value();
            (!text.contains(['\n', '\r'])).then_some(text)
        }
        _ => None,
    }
}
