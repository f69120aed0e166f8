//! `cargo xtask COMMAND`: what the project checks about itself beyond tests.

mod firmware;
mod instructions;
mod minimum;
mod mutants;
mod packages;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// What stops a command.
type Stop = Box<dyn Error>;

const USAGE: &str = "\
cargo xtask firmware [--accept] [VARIANT...]   build, run and compare examples/firmware
cargo xtask instructions [--accept]            instructions of benches, counted by callgrind
cargo xtask packages                           what would be published, and that nothing is missing
cargo xtask minimum                            build with the oldest Rust that Cargo.toml admits
cargo xtask mutants [--jury] [--budget SECONDS] [--longest SECONDS] [--each SECONDS] [--seed N] [--among LIST] AREA...
                                               changes of operators that no test notices";

/// The folder of the workspace.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A command whose output is text of this language and without colours.
fn command(program: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(program);
    command.env("LC_ALL", "C").env("CARGO_TERM_COLOR", "never");
    command
}

/// The standard output of a command that succeeds; its errors go where this program's go.
fn output(command: &mut Command) -> Result<String, Stop> {
    let output = command.stdin(std::process::Stdio::null()).stderr(std::process::Stdio::inherit()).output();
    let output = output.map_err(|error| format!("{}: {error}", command.get_program().display()))?;
    if !output.status.success() {
        return Err(format!("{} ended with {}", command.get_program().display(), output.status).into());
    }
    Ok(String::from_utf8(output.stdout)?)
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some((name, rest)) = arguments.split_first() else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    let passed = match (name.as_str(), rest) {
        ("firmware", rest) => firmware::run(rest),
        ("instructions", []) => instructions::run(false),
        ("instructions", [accept]) if accept == "--accept" => instructions::run(true),
        ("packages", []) => packages::run(),
        ("mutants", rest) => mutants::run(rest),
        ("minimum", []) => minimum::run(),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match passed {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(stop) => {
            eprintln!("{name}: {stop}");
            ExitCode::from(2)
        }
    }
}
