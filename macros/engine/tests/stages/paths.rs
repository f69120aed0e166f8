//! Paths in a source: those of `use`, with everything between their braces, and those in between.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// What a path reads.
#[derive(Debug)]
pub(crate) enum Reading {
    /// Of this crate, from its root.
    Inside(Vec<String>),
    /// What is in scope under this name: a crate, an item, a method.
    Name(String),
}

/// All paths of a module, macros included. Comments are no tokens.
pub(crate) fn readings(module: &[String], tokens: TokenStream) -> Vec<Reading> {
    let list: Vec<TokenTree> = tokens.into_iter().collect();
    let mut found = Vec::new();
    let mut at = 0;
    while at < list.len() {
        if let Some((name, group)) = inner(&list[at..]) {
            let module: Vec<String> = module.iter().cloned().chain([name]).collect();
            found.extend(readings(&module, group));
            at += 3;
        } else if let TokenTree::Ident(_) = &list[at] {
            let mut paths = Vec::new();
            at += path(&list[at..], &[], &mut paths);
            found.extend(paths.into_iter().filter_map(|path| resolved(module, &path)));
        } else {
            if let TokenTree::Group(group) = &list[at] {
                found.extend(readings(module, group.stream()));
            }
            at += 1;
        }
    }
    found
}

/// `mod name { .. }` at the start.
fn inner(list: &[TokenTree]) -> Option<(String, TokenStream)> {
    match list {
        [TokenTree::Ident(word), TokenTree::Ident(name), TokenTree::Group(group), ..] if word == "mod" => {
            Some((name.to_string(), group.stream()))
        }
        _ => None,
    }
}

/// `a::b::{c, d::e}` at the start, behind what stands before the braces; how many tokens it takes.
fn path(list: &[TokenTree], before: &[String], found: &mut Vec<Vec<String>>) -> usize {
    let mut names = before.to_vec();
    let mut at = 0;
    loop {
        match list.get(at) {
            Some(TokenTree::Ident(name)) => names.push(name.to_string()),
            Some(TokenTree::Group(group)) if at > 0 && group.delimiter() == Delimiter::Brace => {
                let inside: Vec<TokenTree> = group.stream().into_iter().collect();
                for part in inside.split(|token| is_punct(Some(token), ',')) {
                    path(part, &names, found);
                }
                return at + 1;
            }
            // What else can follow `::`, such as `*` or `<`.
            _ => break,
        }
        at += 1;
        if !(is_punct(list.get(at), ':') && is_punct(list.get(at + 1), ':')) {
            break;
        }
        at += 2;
    }
    if !names.is_empty() {
        found.push(names);
    }
    at
}

fn is_punct(token: Option<&TokenTree>, wanted: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == wanted)
}

/// From the root of the crate.
fn resolved(module: &[String], path: &[String]) -> Option<Reading> {
    let (first, rest) = path.split_first()?;
    let mut base = match first.as_str() {
        "crate" => Vec::new(),
        "self" => module.to_vec(),
        "super" => module[..module.len().saturating_sub(1)].to_vec(),
        _ => return Some(Reading::Name(first.clone())),
    };
    for name in rest {
        match name.as_str() {
            "super" => drop(base.pop()),
            "self" => {}
            _ => base.push(name.clone()),
        }
    }
    // `super::*` in a stage's own file, `self` alone, `pub(crate)`.
    (!base.is_empty()).then_some(Reading::Inside(base))
}
