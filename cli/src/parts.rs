//! Parts that a call uses by `use path::of::part;`. In a build rustc brings them; here they are looked up by their names among the
//! calls of files.

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::syntax;
use multibody_engine::syntax::tree::Use;
use proc_macro2::{Group, TokenStream, TokenTree};

/// The tokens of a call, with those of all parts that it uses from `calls`.
pub(crate) fn linked(call: &TokenStream, calls: &[TokenStream]) -> Result<TokenStream, Diagnostics> {
    link(call, calls, &mut Vec::new())
}

/// `open`: calls that are being read, which no part of theirs can come from.
fn link(call: &TokenStream, calls: &[TokenStream], open: &mut Vec<usize>) -> Result<TokenStream, Diagnostics> {
    let mut tokens = call.clone();
    loop {
        let mut diagnostics = Diagnostics::default();
        let source = syntax::parse(tokens.clone(), &mut diagnostics);
        let Some(pending) = source.pending else { return Ok(tokens) };
        if !diagnostics.is_empty() {
            return Err(diagnostics);
        }
        let Some(first) = pending.uses.first() else { return Ok(tokens) };
        let Some(part) = exported(first, calls, open) else {
            let message = format!("no file that is read here declares the part `{}`", last(&first.path));
            diagnostics.error_help(first.name.span(), message, "name the file: `--parts FILE`");
            return Err(diagnostics);
        };
        tokens = pending.resolved(&written_out(part));
    }
}

/// With `crate` for `$crate`, which only rustc reads: here it is the crate of the file that declares the part.
fn written_out(tokens: TokenStream) -> TokenStream {
    let is_dollar = |token: &TokenTree| matches!(token, TokenTree::Punct(punct) if punct.as_char() == '$');
    let inside = |token| match token {
        TokenTree::Group(group) => {
            let mut own = Group::new(group.delimiter(), written_out(group.stream()));
            own.set_span(group.span());
            TokenTree::Group(own)
        }
        token => token,
    };
    tokens.into_iter().filter(|token| !is_dollar(token)).map(inside).collect()
}

/// What the first call that declares a public part of this name says of it.
fn exported(wanted: &Use, calls: &[TokenStream], open: &mut Vec<usize>) -> Option<TokenStream> {
    let name = last(&wanted.path);
    calls.iter().enumerate().find_map(|(index, call)| {
        if open.contains(&index) || !declares(call, &name) {
            return None;
        }
        open.push(index);
        let tokens = link(call, calls, open);
        open.pop();
        let tokens = tokens.ok()?;
        let mut diagnostics = Diagnostics::default();
        let source = syntax::parse(tokens, &mut diagnostics);
        let export = source.exports.iter().find(|export| source.modules[export.module].name == name)?;
        Some(if diagnostics.is_empty() { export.tokens.clone() } else { export.withheld() })
    })
}

/// Whether `mod name` stands in a call. Most calls need not be read.
fn declares(call: &TokenStream, name: &str) -> bool {
    let is = |token: &TokenTree, text: &str| matches!(token, TokenTree::Ident(word) if word == text);
    let tokens: Vec<TokenTree> = call.clone().into_iter().collect();
    tokens.windows(2).any(|pair| is(&pair[0], "mod") && is(&pair[1], name))
}

/// `leg` of `robot_parts::leg`
fn last(path: &TokenStream) -> String {
    path.clone().into_iter().last().map_or_else(String::new, |token| token.to_string())
}
