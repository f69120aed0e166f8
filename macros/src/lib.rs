//! The procedural macro `multibody!`: a shell around the engine, which is an ordinary library.

use proc_macro::TokenStream;

/// Derives the equations of motion of the declared mechanisms and emits them as Rust modules.
///
/// The language is described in the documentation of the `multibody` crate, which re-exports this macro.
#[proc_macro]
pub fn multibody(input: TokenStream) -> TokenStream {
    multibody_engine::expand(input.into()).into()
}
