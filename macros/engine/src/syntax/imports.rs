//! Stage `syntax`: parts that were declared in another call.
//!
//! In: `use robot_parts::leg;` at the head of a call. Out: the modules of that part, as its own call has them.
//!
//! A macro sees the tokens of its own call alone, so rustc brings them. A public part is exported as a declarative macro of
//! its name that knows the part's tokens (see [`super::exports`]). A call with a `use` expands to a call of that macro, with its
//! own tokens as argument, and this one expands to the first call once more, where the part's tokens stand in place of the
//! `use`:
//!
//! ```text
//! multibody! { use robot_parts::leg; mod robot { .. } }
//!     use robot_parts::leg as name;
//!     name! { (::multibody::__multibody) (@runtime(::multibody) @as(leg)) mod robot { .. } }
//!     ::multibody::__multibody! { @runtime(::multibody) @as(leg) @part(1 leg mod leg { .. }) mod robot { .. } }
//! ```
//!
//! Several go one after the other. So paths are resolved by rustc where the user's call stands, a path that leads nowhere is
//! its own error at the user's token, and all tokens keep their places in either file.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote, quote_spanned};

use super::attributes;
use super::cursor::{Cursor, Read, Reported};
use super::expressions::is_name;
use super::modules;
use super::tree::{Module, Pending, Source, Use};
use crate::diagnostics::Diagnostics;

/// Of the language that parts are handed on in. It counts up where a part of before would be read as something else.
pub(super) const VERSION: u32 = 1;

const FORM: &str = "write `use robot_parts::leg;`";

/// A `use` may name so many parts: each is two macro calls within each other, and rustc has a bound for these.
const MOST: usize = 48;

/// A part of another call, with all that it needs.
pub(super) struct Bundle {
    /// What this call calls it.
    pub(super) local: Ident,
    /// What its own call calls it.
    pub(super) entry: Ident,
    /// Parts of further calls.
    pub(super) bundles: Vec<Bundle>,
    /// Of its call; nothing where its own call has an error, which was told there.
    pub(super) modules: Vec<Module>,
    /// `@as(..) @part(..)`
    pub(super) tokens: TokenStream,
}

/// What stands before a call that goes on.
#[derive(Default)]
pub(super) struct Handed {
    pub(super) bundles: Vec<Bundle>,
    /// A `use` of the call was lost to an error that was told before.
    pub(super) lost: bool,
    /// All of the bundles as written.
    pub(super) tokens: TokenStream,
}

/// `@lost`, `@as(limb) @part(1 leg ..)`, as this macro itself has written them.
pub(super) fn handed(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Handed {
    let mut lost = marker(cursor, "lost");
    if lost {
        cursor.bump();
        cursor.bump();
    }
    let start = cursor.position();
    let bundles = bundles(cursor, &mut lost, diagnostics);
    Handed { bundles, lost, tokens: cursor.since(start) }
}

/// Says too whether one was lost to an error.
fn bundles(cursor: &mut Cursor, lost: &mut bool, diagnostics: &mut Diagnostics) -> Vec<Bundle> {
    let mut bundles = Vec::new();
    loop {
        let start = cursor.position();
        let Some(name) = marked(cursor, "as") else { return bundles };
        let Some(part) = marked(cursor, "part") else { return bundles };
        let name = name.stream().into_iter().find_map(|token| match token {
            TokenTree::Ident(name) => Some(name),
            _ => None,
        });
        let Some(local) = name else { return bundles };
        match bundle(local, &part, cursor, diagnostics) {
            Ok(bundle) => bundles.push(Bundle { tokens: cursor.since(start), ..bundle }),
            Err(Reported) => *lost = true,
        }
    }
}

/// `1 leg @as(..) @part(..) mod leg { .. } mod foot { .. }`, or `1 leg "why not"`
fn bundle(local: Ident, group: &Group, outer: &Cursor, diagnostics: &mut Diagnostics) -> Read<Bundle> {
    let mut cursor = outer.enter(group, diagnostics)?;
    let version = cursor.literal().map(ToString::to_string).unwrap_or_default();
    if version != VERSION.to_string() {
        diagnostics.error_help(
            local.span(),
            format!(
                "the part `{local}` is written in version {version} of the language, this call in version {VERSION}"
            ),
            "let both crates depend on one version of multibody",
        );
        return Err(Reported);
    }
    cursor.bump();
    let Some(TokenTree::Ident(entry)) = cursor.bump() else { return Err(Reported) };
    let empty = |modules| Bundle {
        local: local.clone(),
        entry: entry.clone(),
        bundles: Vec::new(),
        modules,
        tokens: TokenStream::new(),
    };
    if let Some(TokenTree::Literal(why)) = cursor.peek(0) {
        let why: Read<syn::LitStr> = syn::parse2(TokenTree::Literal(why.clone()).into()).map_err(|_| Reported);
        diagnostics.error(local.span(), format!("the part `{local}` can't be used in another call: {}", why?.value()));
        return Err(Reported);
    }
    let mut lost = false;
    let bundles = bundles(&mut cursor, &mut lost, diagnostics);
    if lost {
        return Err(Reported);
    }
    let mut modules = Vec::new();
    while !cursor.at_end() {
        let start = cursor.position();
        let attrs = attributes::outer(&mut cursor, diagnostics);
        let vis = attributes::visibility(&mut cursor, diagnostics);
        // `mod`
        cursor.bump();
        let module = modules::module(attrs, vis, &mut cursor, diagnostics).ok_or(Reported)?;
        modules.push(Module { tokens: cursor.since(start), ..module });
    }
    Ok(Bundle { bundles, ..empty(modules) })
}

fn marker(cursor: &Cursor, word: &str) -> bool {
    cursor.at("@") && cursor.ident(1).is_some_and(|found| found == word)
}

/// Takes `@word(..)`.
fn marked(cursor: &mut Cursor, word: &str) -> Option<Group> {
    if !marker(cursor, word) || !cursor.at_group(2, Delimiter::Parenthesis) {
        return None;
    }
    cursor.bump();
    cursor.bump();
    cursor.take_group(Delimiter::Parenthesis)
}

/// All `use ..;` at the head of a call, one for each part; says whether one was lost to an error.
pub(super) fn uses(cursor: &mut Cursor, lost: &mut bool, diagnostics: &mut Diagnostics) -> Vec<Use> {
    let mut uses = Vec::new();
    while at_use(cursor) {
        let keyword = cursor.span();
        match read(cursor, diagnostics) {
            Ok(read) => uses.extend(read),
            Err(Reported) => {
                *lost = true;
                skip(cursor);
            }
        }
        if uses.len() > MOST {
            diagnostics.error(keyword, format!("a call uses at most {MOST} parts of other calls"));
            uses.truncate(MOST);
            *lost = true;
        }
    }
    uses
}

/// A `use` behind the first model. Reports and skips it.
pub(super) fn late(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> bool {
    if !at_use(cursor) {
        return false;
    }
    diagnostics.error(cursor.span(), "`use` stands at the head of the call, before the first model");
    skip(cursor);
    true
}

/// To behind the `;`, or to where a module begins.
fn skip(cursor: &mut Cursor) {
    loop {
        cursor.bump();
        if cursor.at_end() || cursor.take(";").is_some() || cursor.at_word("mod") || cursor.at_word("pub") {
            return;
        }
    }
}

/// Whether `use` comes next, with attributes and a visibility or without.
fn at_use(cursor: &Cursor) -> bool {
    let is_attribute = |at| {
        let hash = cursor.punct(at).is_some_and(|punct| punct.as_char() == '#');
        hash && cursor.at_group(at + 1, Delimiter::Bracket)
    };
    let mut at = 0;
    while is_attribute(at) {
        at += 2;
    }
    let public = cursor.ident(at).is_some_and(|word| word == "pub");
    let restricted = usize::from(public && cursor.at_group(at + 1, Delimiter::Parenthesis));
    cursor.ident(at + usize::from(public) + restricted).is_some_and(|word| word == "use")
}

fn read(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Vec<Use>> {
    if cursor.at("#") {
        let help = "write `#[cfg(..)]` before the whole call";
        diagnostics.error_help(cursor.span(), "attributes mean nothing on a `use` of a call", help);
        return Err(Reported);
    }
    if cursor.at_word("pub") {
        let help = "write `pub use robot_parts::leg;` outside of the call, where this is Rust";
        diagnostics.error_help(cursor.span(), "a call hands on no part of another one", help);
        return Err(Reported);
    }
    cursor.bump();
    let mut uses = Vec::new();
    tree(cursor, TokenStream::new(), &mut uses, diagnostics)?;
    if cursor.take(";").is_none() {
        let help = "a `use` ends with `;`";
        diagnostics.error_help(cursor.span(), format!("expected `;`, found {}", cursor.found()), help);
        return Err(Reported);
    }
    Ok(uses)
}

/// What comes behind `before`: `a::b`, `a::b as c` or `a::{b, c}`.
fn tree(cursor: &mut Cursor, before: TokenStream, uses: &mut Vec<Use>, diagnostics: &mut Diagnostics) -> Read<()> {
    let mut path = before;
    let mut name = loop {
        let start = cursor.position();
        if cursor.take("::").is_some() {
            path.extend(cursor.since(start));
        }
        if let Some(group) = cursor.take_group(Delimiter::Brace) {
            let mut inner = cursor.enter(&group, diagnostics)?;
            while !inner.at_end() {
                tree(&mut inner, path.clone(), uses, diagnostics)?;
                if inner.take(",").is_none() && !inner.at_end() {
                    let message = format!("expected `,`, found {}", inner.found());
                    diagnostics.error_help(inner.span(), message, FORM);
                    return Err(Reported);
                }
            }
            return Ok(());
        }
        if cursor.at("*") {
            let help = "name them: `use robot_parts::{leg, arm};`";
            diagnostics.error_help(cursor.span(), "a call uses parts by their names", help);
            return Err(Reported);
        }
        let Some(name) = cursor.ident(0).cloned() else {
            let message = format!("expected the path of a part, found {}", cursor.found());
            diagnostics.error_help(cursor.span(), message, FORM);
            return Err(Reported);
        };
        cursor.bump();
        name.to_tokens(&mut path);
        if !cursor.at("::") {
            break name;
        }
    };
    if cursor.at_word("as") {
        cursor.bump();
        name = alias(cursor, diagnostics)?;
    }
    if !is_name(&name) {
        let message = format!("`{name}` is no name of a part");
        diagnostics.error_help(name.span(), message, "write `use robot_parts::leg;` or `use robot_parts as leg;`");
        return Err(Reported);
    }
    uses.push(Use { path, name });
    Ok(())
}

fn alias(cursor: &mut Cursor, diagnostics: &mut Diagnostics) -> Read<Ident> {
    let name = cursor.ident(0).filter(|name| is_name(name)).cloned();
    let Some(name) = name else {
        let message = format!("expected a name, found {}", cursor.found());
        diagnostics.error_help(cursor.span(), message, "write `use robot_parts::leg as limb;`");
        return Err(Reported);
    };
    cursor.bump();
    Ok(name)
}

/// What is left of a call when its uses are read.
pub(super) fn pending(source: &Source, handed: TokenStream, uses: Vec<Use>, rest: TokenStream) -> Pending {
    let krate = match &source.krate {
        Some(path) => path.to_token_stream(),
        None => quote!(::multibody),
    };
    let fused = source.fused.then(|| quote!(@fused));
    let lost = source.lost.then(|| quote!(@lost));
    Pending { head: quote!(@runtime(#krate) #fused #lost #handed), callback: quote!(#krate::__multibody), uses, rest }
}

impl Pending {
    /// Expands to `use robot_parts::leg as macro_name; macro_name! { .. }`, a call of the first part's macro, which hands the
    /// part's tokens to a call with the rest. Of an import that leads nowhere rustc says more than of such a macro.
    ///
    /// `suffix` tells imports of one module apart.
    pub fn invocation(&self, suffix: &str) -> TokenStream {
        let Pending { head, callback, uses, rest } = self;
        let Some((Use { path, name }, others)) = uses.split_first() else { return TokenStream::new() };
        let others = others.iter().map(|Use { path, name }| quote!(use #path as #name;));
        let arguments = quote!((#callback) (#head @as(#name)) #(#others)* #rest);
        // An error of the import stands at the user's path.
        let span = Span::call_site().located_at(name.span());
        let import = format_ident!("__multibody_use_{}_{suffix}", plain(name), span = span);
        let import_it = quote_spanned!(span=> use #path as #import;);
        quote! {
            #import_it
            #import! { #arguments }
        }
    }

    /// The next call, with the tokens of the first part: for those who know the other call.
    pub fn resolved(&self, part: &TokenStream) -> TokenStream {
        let Pending { head, uses, rest, .. } = self;
        let Some((Use { name, .. }, others)) = uses.split_first() else { return rest.clone() };
        let others = others.iter().map(|Use { path, name }| quote!(use #path as #name;));
        quote!(#head @as(#name) @part(#part) #(#others)* #rest)
    }
}

fn plain(name: &Ident) -> String {
    name.to_string().trim_start_matches("r#").to_owned()
}
