//! Stage `emit`: `MULTIBODY_DUMP=dir` writes each model's report to `dir/name.md` and its source to `dir/name.rs`.
//!
//! Paragraphs of statements have headings there, as comments. The source is formatted by the user's own rustfmt where there is one, so that no formatter is compiled into every
//! build. Nothing here can fail a build or be heard of: what can't be written is left out. Two models with one name
//! write to the same files, and cargo does not run the macro again for a new value of the variable alone.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use crate::mechanics::loops::structure::Structure;
use crate::model::types::Model;
use crate::optimize::program::Compiled;

use super::{commented, names, report, source};

/// Name of the environment variable.
const VARIABLE: &str = "MULTIBODY_DUMP";

/// Writes the files if the variable is set.
pub(super) fn dump(model: &Model, structure: &Structure, compiled: &Compiled) {
    let Some(directory) = std::env::var_os(VARIABLE).filter(|value| !value.is_empty()) else {
        return;
    };
    let directory = PathBuf::from(directory);
    let name = names::plain(&model.name);
    // Outside a macro the runtime is found by its name alone.
    let source = source(&commented(model, structure, compiled)).replace("$crate", "::multibody");
    let source = formatted(&source).unwrap_or(source);
    // A build goes on without the files.
    let _ = std::fs::create_dir_all(&directory);
    let _ = std::fs::write(directory.join(format!("{name}.md")), report(model, structure, compiled));
    let _ = std::fs::write(directory.join(format!("{name}.rs")), source);
}

/// The text as rustfmt writes it.
fn formatted(source: &str) -> Option<String> {
    let mut child = Command::new("rustfmt")
        .args(["--edition", "2024", "--emit", "stdout", "--quiet"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    let mut stdin = child.stdin.take()?;
    let text = source.as_bytes().to_vec();
    // Both ends at once: a pipe that nobody empties blocks.
    let writer = std::thread::spawn(move || stdin.write_all(&text).is_ok());
    let output = child.wait_with_output().ok()?;
    let written = writer.join().unwrap_or(false);
    (written && output.status.success()).then(|| String::from_utf8(output.stdout).ok()).flatten()
}
