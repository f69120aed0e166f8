//! Stage `syntax`: tokens to syntax tree.
//!
//! In: the tokens between the braces of `multibody! { .. }`. Out: a [`tree::Source`], however broken the tokens are, and
//! one error for each mistake, at the user's own token.
//!
//! The grammar (`*`: any number, `?`: at most one, `,*`: with commas between and perhaps one behind):
//!
//! ```text
//! call        = ("#![krate(" "::" path ")]")? use* module*
//! use         = "use" PATH ("as" NAME)? ";", with braces as in Rust
//! module      = attribute* visibility? "mod" NAME "{" item* "}"
//! item        = attribute* (value | function | extern | state | port | world | formulation | body | joint | force | constraint
//!             | drive | solve | assume | part | emit)
//! value       = ("const" | "param" | "let" | "output") NAME (":" type)? "=" expr ";"
//!             | "input" NAME (":" type)? ";"
//! function    = "let" NAME "(" NAME,* ")" "=" expr ";"
//! extern      = "extern" NAME "(" NAME,* ")" "=" PATH ";"
//! state       = "state" NAME ":" "rate" "=" expr ("," "start" ":" expr)? ","? ";"
//! port        = "port" NAME ":" NAME ";"
//! world       = "world" fields
//! formulation = "formulation" fields
//! body        = "body" NAME fields
//! joint       = "joint" NAME ":" KIND fields
//! force       = "force" NAME ":" KIND fields
//! constraint  = "constraint" NAME "=" expr ";"
//!             | "constraint" NAME ":" KIND fields
//! drive       = "drive" expr "=" expr ";"
//! solve       = "solve" "(" expr,* ")" "=" "(" expr,* ")" ";"
//!             | "solve" "(" expr,* ")" "from" expr "{" expr,* "}"
//! assume      = "assume" expr ";"
//! part        = "part" NAME ":" KIND fields ";"
//!             | "part" NAME ":" "[" KIND ";" expr "]" "=" ("|" NAME "|")? KIND fields ";"
//! emit        = "emit" (NAME fields?),* ";"
//! fields      = "{" (NAME ":" expr | "file" ":" TEXT),* "}"
//! type        = NAME | "[" type ";" expr "]"
//! expr        = NUMBER | NAME | NAME "(" expr,* ")" | expr "." NAME ("(" expr,* ")")? | expr "[" expr "]"
//!             | "(" expr ")" | "[" expr,* "]" | ("-" | "!") expr | expr OPERATOR expr
//! ```
//!
//! Operators are `* /`, `+ -`, `< <= > >= == !=`, `&&`, `||`, and bind as in Rust.

mod attributes;
mod blocks;
mod build;
mod cursor;
mod exports;
mod expressions;
mod externals;
mod fields;
mod functions;
mod hints;
mod imports;
mod items;
pub mod keywords;
mod link;
mod modules;
mod names;
mod numbers;
mod raw;
mod text;
pub mod tree;
mod written;

use proc_macro2::TokenStream;

pub(crate) use exports::{MJCF, URDF};
pub(crate) use text::text;
pub(crate) use written::written;

use crate::diagnostics::Diagnostics;

/// Reads what can be read of one `multibody! { .. }`. Stacks stay small and time linear whatever the tokens.
pub fn parse(tokens: TokenStream, diagnostics: &mut Diagnostics) -> tree::Source {
    modules::source(raw::plain(tokens), diagnostics)
}
