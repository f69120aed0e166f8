//! Room `references`: what leads an editor from a word of the user's to what it stands for.
//!
//! Editors expand a macro and look for tokens that stand at the cursor's place; whatever such a token is in the generated
//! code, the user's word is to them: going to definitions, documentation, completion, highlights and renaming follow.
//! Equations name nothing by the user's tokens, so each token that names something stands here once more, in bodies that
//! nobody calls, behind `const _`.

mod fields;
mod names;

use std::sync::OnceLock;

pub use self::fields::fields;
pub use self::names::names;

/// Names of environment variables by which editors tell that they run the macro: rust-analyzer's server of macros demands
/// the first itself, IntelliJ's sets the second where it completes.
const EDITORS: [&str; 2] = ["RUST_ANALYZER_INTERNALS_DO_NOT_USE", "RUST_IDE_PROC_MACRO_COMPLETION"];

/// Whether an editor expands the macro: it wants to hear of names that lead nowhere too, since it completes them. To a compiler
/// each of these would be one more error.
pub fn for_an_editor() -> bool {
    static ASKED: OnceLock<bool> = OnceLock::new();
    *ASKED.get_or_init(|| EDITORS.iter().any(|variable| std::env::var_os(variable).is_some()))
}
