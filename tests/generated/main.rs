//! What is generated, and what is said instead: text, interface, statements, instructions, errors.

mod expanded;
mod fuzz;
mod interface;
mod loop_errors;
mod parameters;
mod record;
mod single_precision;
mod statements;

use std::path::{Path, PathBuf};
use std::process::Command;

/// Where workspaces of their own are built: where trybuild builds its cases, so that all of them share one engine.
fn apart() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("../tests/trybuild")
}

/// The triple of this computer.
fn host() -> String {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let printed = Command::new(rustc).args(["--print", "host-tuple"]).output().unwrap();
    String::from_utf8(printed.stdout).unwrap().trim().to_owned()
}

/// cargo for a workspace of its own, in `apart`.
///
/// The engine is shared by what has the same settings. So, as trybuild, these builds name their target, are not
/// incremental and in the profile `dev`, which they change for packages that they name and never for `*`, since that
/// holds for the engine too.
fn cargo(subcommand: &str, workspace: impl AsRef<Path>) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args([subcommand, "--target", &host()]).current_dir(workspace);
    command.env("CARGO_TARGET_DIR", apart()).env("CARGO_INCREMENTAL", "0");
    for flags in ["RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS", "CARGO_BUILD_RUSTFLAGS", "RUST_MIN_STACK"] {
        command.env_remove(flags);
    }
    command
}
