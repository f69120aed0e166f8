//! Stage `syntax`: the place where reading has got to, among the tokens between two brackets.
//!
//! In: a token stream. Out: tokens one by one, with a look ahead; what stands there in words for error messages. The
//! tokens of one level are held as a list, so that recovery can skip and look ahead without limit or cost.

use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

use super::keywords::Keyword;
use crate::diagnostics::Diagnostics;

/// Brackets within brackets are read to this depth. The bound keeps the stack small in every stage: they all recurse
/// into expressions.
pub(super) const DEEPEST: usize = 64;

/// An error that has been recorded; the reader goes on behind what it could not read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reported;

/// What was read, or a promise that somebody has been told why not.
pub(super) type Read<T> = Result<T, Reported>;

/// The place where reading has got to.
pub(super) struct Cursor {
    tokens: Vec<TokenTree>,
    position: usize,
    /// The closing bracket.
    end: Span,
    /// The token before `position`; the opening bracket at first.
    last: Span,
    depth: usize,
}

impl Cursor {
    /// At the first token of a macro call.
    pub(super) fn new(tokens: TokenStream) -> Cursor {
        let tokens = visible(tokens);
        let end = tokens.last().map_or_else(Span::call_site, end_of);
        Cursor { tokens, position: 0, end, last: Span::call_site(), depth: 0 }
    }

    /// At the first token inside `group`, one level deeper.
    pub(super) fn enter(&self, group: &Group, diagnostics: &mut Diagnostics) -> Read<Cursor> {
        if self.depth >= DEEPEST {
            diagnostics.error_help(
                group.span_open(),
                format!("brackets are nested more than {DEEPEST} deep"),
                "name the inner expressions with `let`",
            );
            return Err(Reported);
        }
        Ok(Cursor {
            tokens: visible(group.stream()),
            position: 0,
            end: group.span_close(),
            last: group.span_open(),
            depth: self.depth + 1,
        })
    }

    /// The next token but `ahead`.
    pub(super) fn peek(&self, ahead: usize) -> Option<&TokenTree> {
        self.tokens.get(self.position.saturating_add(ahead))
    }

    /// Takes the next token.
    pub(super) fn bump(&mut self) -> Option<TokenTree> {
        let token = self.tokens.get(self.position)?.clone();
        self.position += 1;
        self.last = end_of(&token);
        Some(token)
    }

    /// How many tokens are read.
    pub(super) fn position(&self) -> usize {
        self.position
    }

    /// What was read since so many tokens were.
    pub(super) fn since(&self, position: usize) -> TokenStream {
        self.tokens.get(position..self.position).unwrap_or_default().iter().cloned().collect()
    }

    /// What is not read yet.
    pub(super) fn rest(&self) -> TokenStream {
        self.tokens.get(self.position..).unwrap_or_default().iter().cloned().collect()
    }

    /// Whether all tokens are read.
    pub(super) fn at_end(&self) -> bool {
        self.position >= self.tokens.len()
    }

    /// The next token, the closing bracket at the end; of a bracketed group the opening bracket.
    pub(super) fn span(&self) -> Span {
        match self.peek(0) {
            Some(TokenTree::Group(group)) => group.span_open(),
            Some(token) => token.span(),
            None => self.end,
        }
    }

    /// The token before the next one.
    pub(super) fn last_span(&self) -> Span {
        self.last
    }

    /// The name or keyword that comes after `ahead` tokens.
    pub(super) fn ident(&self, ahead: usize) -> Option<&Ident> {
        match self.peek(ahead) {
            Some(TokenTree::Ident(ident)) => Some(ident),
            _ => None,
        }
    }

    /// The number or text that comes next.
    pub(super) fn literal(&self) -> Option<&Literal> {
        match self.peek(0) {
            Some(TokenTree::Literal(literal)) => Some(literal),
            _ => None,
        }
    }

    /// The punctuation that comes after `ahead` tokens.
    pub(super) fn punct(&self, ahead: usize) -> Option<&Punct> {
        match self.peek(ahead) {
            Some(TokenTree::Punct(punct)) => Some(punct),
            _ => None,
        }
    }

    /// The bracketed group that comes after `ahead` tokens.
    pub(super) fn group(&self, ahead: usize) -> Option<&Group> {
        match self.peek(ahead) {
            Some(TokenTree::Group(group)) => Some(group),
            _ => None,
        }
    }

    /// Whether a group in these brackets comes after `ahead` tokens.
    pub(super) fn at_group(&self, ahead: usize, delimiter: Delimiter) -> bool {
        self.group(ahead).is_some_and(|group| group.delimiter() == delimiter)
    }

    /// Takes the group in these brackets, if one comes next.
    pub(super) fn take_group(&mut self, delimiter: Delimiter) -> Option<Group> {
        let group = self.group(0).filter(|group| group.delimiter() == delimiter)?.clone();
        self.bump();
        Some(group)
    }

    /// Whether this word comes next.
    pub(super) fn at_word(&self, word: &str) -> bool {
        self.ident(0).is_some_and(|ident| ident == word)
    }

    /// The punctuation that comes after `ahead` tokens, as one operator of up to three characters.
    pub(super) fn operator(&self, ahead: usize) -> String {
        let mut text = String::new();
        for next in ahead..ahead.saturating_add(3) {
            let Some(punct) = self.punct(next) else { break };
            let longer = format!("{text}{}", punct.as_char());
            if next > ahead && !OPERATORS.contains(&longer.as_str()) {
                break;
            }
            text = longer;
            if punct.spacing() == Spacing::Alone {
                break;
            }
        }
        text
    }

    /// Whether this whole operator comes next: `=` is not there where `==` stands.
    pub(super) fn at(&self, operator: &str) -> bool {
        self.operator(0) == operator
    }

    /// Takes this operator, if it comes next, and returns its first character's place.
    pub(super) fn take(&mut self, operator: &str) -> Option<Span> {
        if !self.at(operator) {
            return None;
        }
        let span = self.span();
        for _ in operator.chars() {
            self.bump();
        }
        Some(span)
    }

    /// What comes next, in words.
    pub(super) fn found(&self) -> String {
        match self.peek(0) {
            None if self.depth == 0 => "the end".to_owned(),
            None => "the closing bracket".to_owned(),
            Some(TokenTree::Group(group)) => match group.delimiter() {
                Delimiter::Brace => "`{`".to_owned(),
                Delimiter::Bracket => "`[`".to_owned(),
                Delimiter::Parenthesis | Delimiter::None => "`(`".to_owned(),
            },
            Some(TokenTree::Punct(_)) => format!("`{}`", self.operator(0)),
            Some(TokenTree::Ident(ident)) => format!("`{}`", short(&ident.to_string())),
            Some(TokenTree::Literal(literal)) => format!("`{}`", short(&literal.to_string())),
        }
    }

    /// Whether the tokens after `ahead` others can only be the start of an item: inside an expression no two names
    /// stand side by side. This is where a missing `;` shows, and where recovery may stop.
    pub(super) fn at_item(&self, ahead: usize) -> bool {
        let next = ahead.saturating_add(1);
        if self.punct(ahead).is_some_and(|punct| punct.as_char() == '#') {
            let behind = ahead.saturating_add(2);
            let followed = self.ident(behind).is_some() || self.operator(behind) == "#";
            return self.at_group(next, Delimiter::Bracket) && followed;
        }
        let Some(word) = self.ident(ahead) else {
            return false;
        };
        let name_follows = self.ident(next).is_some_and(|name| name != "as");
        match Keyword::of(word) {
            Some(Keyword::World | Keyword::Formulation) => self.at_group(next, Delimiter::Brace),
            Some(Keyword::Solve) => {
                let behind = ahead.saturating_add(2);
                let goes_on = self.operator(behind) == "=" || self.ident(behind).is_some_and(|word| word == "from");
                self.at_group(next, Delimiter::Parenthesis) && goes_on
            }
            Some(Keyword::Assume) => name_follows || self.at_group(next, Delimiter::Parenthesis),
            Some(_) => name_follows,
            None if word == "pub" => true,
            // A misspelt keyword shows itself by what follows the name.
            None => {
                let item_like = self.at_group(ahead.saturating_add(2), Delimiter::Brace)
                    || matches!(self.operator(ahead.saturating_add(2)).as_str(), ":" | "=");
                name_follows && item_like && Keyword::near(word).is_some()
            }
        }
    }

    /// Skips what is left of an unreadable item: to behind its `;` or its braces, or to the start of the next item.
    pub(super) fn skip_item(&mut self) {
        while !self.at_end() && !self.at_item(0) {
            if self.take(";").is_some() {
                return;
            }
            let block = self.at_group(0, Delimiter::Brace);
            self.bump();
            if block && (self.at_end() || self.at_item(0)) {
                return;
            }
        }
    }

    /// Skips to the next one of these operators, or to the end.
    pub(super) fn skip_to(&mut self, operators: &[&str]) {
        while !self.at_end() && !operators.iter().any(|operator| self.at(operator)) {
            self.bump();
        }
    }

    /// Skips to the next one of these operators, or to where the item must be over.
    pub(super) fn skip_within_item(&mut self, operators: &[&str]) {
        while !self.at_end() && !self.at(";") && !self.at_item(0) && !operators.iter().any(|operator| self.at(operator))
        {
            self.bump();
        }
    }
}

/// Operators of more than one character that Rust knows.
const OPERATORS: &[&str] = &[
    "&&", "||", "==", "!=", "<=", ">=", "<<", ">>", "::", "..", "=>", "->", "+=", "-=", "*=", "/=", "%=", "^=", "&=",
    "|=", "...", "..=", "<<=", ">>=",
];

/// The tokens of one level. Groups without visible brackets come from macros of the user's own; where they hold one
/// token or a visibility they are opened, since a name or type is expected there, otherwise they hold together like
/// parentheses.
fn visible(stream: TokenStream) -> Vec<TokenTree> {
    let mut tokens = Vec::new();
    // Reversed, so that the next token is the last of the list.
    let mut rest: Vec<TokenTree> = stream.into_iter().collect();
    rest.reverse();
    while let Some(token) = rest.pop() {
        match token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::None => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                let visibility = matches!(inner.first(), Some(TokenTree::Ident(word)) if word == "pub");
                if inner.len() < 2 || visibility {
                    rest.extend(inner.into_iter().rev());
                } else {
                    let mut solid = Group::new(Delimiter::Parenthesis, group.stream());
                    solid.set_span(group.span());
                    tokens.push(TokenTree::Group(solid));
                }
            }
            token => tokens.push(token),
        }
    }
    tokens
}

/// Where a token ends: the closing bracket of a group.
fn end_of(token: &TokenTree) -> Span {
    match token {
        TokenTree::Group(group) => group.span_close(),
        token => token.span(),
    }
}

/// Long words are cut: a message stays readable whatever the input.
pub(super) fn short(text: &str) -> String {
    const LONGEST: usize = 40;
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    let start: String = text.chars().take(LONGEST).collect();
    format!("{start}..")
}
