//! Stage `syntax`: documentation, attributes and visibility.
//!
//! In: tokens before an item or module. Out: attributes as written, for `model` to judge and `emit` to pass on; the
//! path of `#![krate(..)]`. Only here tokens are handed to syn's own parsers, which recurse without a bound: so only
//! short runs of them are.

use proc_macro2::{Delimiter, Group, Span, TokenStream, TokenTree};
use quote::ToTokens;
use syn::parse::Parser;
use syn::{Attribute, Path, PathSegment, Token, Visibility};

use super::cursor::{Cursor, Read, Reported};
use crate::diagnostics::Diagnostics;

/// More tokens are never needed: documentation is one, and what stands in a list's brackets isn't counted.
const LONGEST: usize = 48;

/// Attributes before an item, `#[..]` and `///`.
pub(super) fn outer(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Vec<Attribute> {
    let mut attributes = Vec::new();
    while cursor.at("#") && cursor.at_group(1, Delimiter::Bracket) {
        let mut tokens = TokenStream::from_iter(cursor.bump());
        if let Some(group) = cursor.take_group(Delimiter::Bracket) {
            attributes.extend(read(&mut tokens, group, diagnostics));
        }
    }
    attributes
}

/// Attributes at the beginning of a call or module, `#![..]` and `//!`, made outer ones: what is said from inside is
/// generated as said from outside.
pub(super) fn inner(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Vec<Attribute> {
    let mut attributes = Vec::new();
    while cursor.punct(0).is_some_and(|punct| punct.as_char() == '#')
        && cursor.punct(1).is_some_and(|punct| punct.as_char() == '!')
        && cursor.at_group(2, Delimiter::Bracket)
    {
        let mut tokens = TokenStream::from_iter(cursor.bump());
        cursor.bump();
        if let Some(group) = cursor.take_group(Delimiter::Bracket) {
            attributes.extend(read(&mut tokens, group, diagnostics));
        }
    }
    attributes
}

/// `#` and its brackets as an attribute.
fn read(tokens: &mut TokenStream, group: Group, diagnostics: &mut Diagnostics) -> Read<Attribute> {
    let span = group.span_open();
    let list = matches!(group.stream().into_iter().last(), Some(TokenTree::Group(_)));
    if shorter(group.stream(), list).is_none() {
        diagnostics.error(span, "this attribute is too long");
        return Err(Reported);
    }
    tokens.extend([TokenTree::Group(group)]);
    match Attribute::parse_outer.parse2(tokens.clone()).map(|attributes| attributes.into_iter().next()) {
        Ok(Some(attribute)) => Ok(attribute),
        Ok(None) => {
            diagnostics.error(span, "expected an attribute");
            Err(Reported)
        }
        Err(error) => {
            diagnostics.error(error.span(), format!("this attribute can't be read: {error}"));
            Err(Reported)
        }
    }
}

/// `Some` if there are few tokens, where the brackets of a `list` don't count what is in them, and these are not nested
/// deeply.
fn shorter(stream: TokenStream, list: bool) -> Option<()> {
    let mut left = LONGEST;
    let mut levels = vec![stream.into_iter()];
    while let Some(level) = levels.last_mut() {
        let Some(token) = level.next() else {
            levels.pop();
            continue;
        };
        let inside = levels.len() > 1;
        if !(list && inside) {
            left = left.checked_sub(1)?;
        }
        if let TokenTree::Group(group) = token {
            levels.push(group.stream().into_iter());
        }
        if levels.len() > LONGEST {
            return None;
        }
    }
    Some(())
}

/// `pub`, `pub(crate)`, `pub(in path)` or nothing.
pub(super) fn visibility(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Visibility {
    if !cursor.at_word("pub") {
        return Visibility::Inherited;
    }
    let span = cursor.span();
    let mut tokens = TokenStream::from_iter(cursor.bump());
    let group = cursor.take_group(Delimiter::Parenthesis);
    if let Some(group) = &group
        && shorter(group.stream(), false).is_none()
    {
        diagnostics.error(group.span_open(), "this path is too long");
        return Visibility::Public(Token![pub](span));
    }
    tokens.extend(group.map(TokenTree::Group));
    syn::parse2(tokens).unwrap_or_else(|error: syn::Error| {
        diagnostics.error(error.span(), format!("this visibility can't be read: {error}"));
        Visibility::Public(Token![pub](span))
    })
}

/// The path in `#![krate(::mb)]`.
pub(super) fn krate(attribute: &Attribute, diagnostics: &mut Diagnostics) -> Read<Path> {
    let Some(list) = attribute.meta.require_list().ok().filter(|list| !list.tokens.is_empty()) else {
        diagnostics.error_help(name(attribute).1, "`krate` needs the path of the runtime crate", FORM);
        return Err(Reported);
    };
    crate_path(list.tokens.clone(), name(attribute).1, diagnostics)
}

const FORM: &str = "write `#![krate(::name)]`";

/// `::mb`, `crate::mb`, `$crate`
pub(super) fn crate_path(tokens: TokenStream, at: Span, diagnostics: &mut Diagnostics) -> Read<Path> {
    let mut cursor = Cursor::new(tokens);
    let start = if cursor.at_end() { at } else { cursor.span() };
    let mut path = Path { leading_colon: None, segments: syn::punctuated::Punctuated::new() };
    if let Some(span) = cursor.take("::") {
        path.leading_colon = Some(Token![::](span));
    } else if !(cursor.at_word("crate") || cursor.at_word("$crate")) {
        // A relative path would mean something else inside the generated module.
        diagnostics.error_help(start, "the path of the runtime crate starts with `::`", FORM);
        return Err(Reported);
    }
    loop {
        let Some(segment) = cursor.ident(0).cloned() else {
            diagnostics.error_help(cursor.span(), format!("expected a crate's name, found {}", cursor.found()), FORM);
            return Err(Reported);
        };
        cursor.bump();
        path.segments.push_value(PathSegment::from(segment));
        let Some(span) = cursor.take("::") else { break };
        path.segments.push_punct(Token![::](span));
    }
    if !cursor.at_end() {
        let message = format!("expected the end of the path, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, FORM);
        return Err(Reported);
    }
    Ok(path)
}

/// The name of an attribute and where it stands.
pub(super) fn name(attribute: &Attribute) -> (String, Span) {
    let path = attribute.path();
    let span = path.segments.first().map_or(attribute.pound_token.span, |segment| segment.ident.span());
    (path.to_token_stream().to_string(), span)
}
