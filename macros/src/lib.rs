//! The procedural macro `multibody!`: a shell around the engine, which is an ordinary library.

use std::path::{Path, PathBuf};

use proc_macro::TokenStream;
use syn::LitStr;

/// Derives the equations of motion of the declared mechanisms and emits them as Rust modules.
///
/// A call holds models and the parts that they use, one `mod` for each:
///
/// ```text
/// multibody! {
///     /// A rod that hangs from a hinge.
///     pub mod pendulum {
///         /// [m]
///         param length = 1.0;
///         world { gravity: -9.81 * Y }
///         body rod { mass: 2.0, com: -0.5 * length * Y, inertia: rod(2.0, length, Y) }
///         joint hinge: Revolute { parent: ground, child: rod, axis: Z }
///         output energy = kinetic() + potential();
///         emit forward_dynamics, mass_matrix; // outputs are always emitted
///     }
/// }
/// ```
///
/// Users call the macro of this name in the crate `multibody`, which says where that crate is found and hands on the rest.
/// There the language is documented in the module `language` and what is emitted in the module `generated`.
///
/// # Errors
///
/// Every mistake of a call is a compile error at the token where it stands, all of them in one build.
#[proc_macro]
pub fn multibody(input: TokenStream) -> TokenStream {
    let place = place(input.clone());
    multibody_engine::expand_at(input.into(), &place, &read).into()
}

/// The same for a runtime with its feature `serde`: generated structs are written and read by serde.
///
/// # Errors
///
/// Those of [`multibody!`].
#[proc_macro]
pub fn multibody_with_serde(input: TokenStream) -> TokenStream {
    let place = place(input.clone());
    multibody_engine::expand_serialised_at(input.into(), &place, &read).into()
}

/// Where the call ends in its crate: the last token is the user's own, whatever macros the call went through.
fn place(input: TokenStream) -> String {
    let Some(last) = input.into_iter().last() else { return String::new() };
    let span = last.span();
    format!("{}:{}:{}", span.file(), span.line(), span.column())
}

/// The text of a file beside the one that calls, or in the manifest's folder where the compiler names none.
fn read(file: &LitStr) -> Result<String, String> {
    let folder = file.span().unwrap().local_file().and_then(|calling| calling.parent().map(Path::to_owned));
    let folder = folder.or_else(|| std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from)).unwrap_or_default();
    std::fs::read_to_string(folder.join(file.value())).map_err(|error| error.to_string())
}
