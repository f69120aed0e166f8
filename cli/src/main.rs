//! `cargo multibody`: the compiler of multibody models as a command. See `HELP` in `arguments.rs` for what it does.
//!
//! Results go to stdout, mistakes of models, warnings and progress to stderr. The exit code is 1 where a model has a mistake,
//! 2 where the command line or a file cannot be read.

mod arguments;
mod build;
mod commands;
mod parts;
mod progress;
mod report;
mod said;
mod source;
mod table;

use std::process::ExitCode;

use arguments::{Command, HELP};

/// What stands in the way of an answer.
enum Stop {
    /// The command line, or a file that cannot be read.
    Usage(String),
    /// Mistakes of models, which have been told.
    Mistakes,
}

fn main() -> ExitCode {
    // Faults of the engine are caught there and told as errors with a place; the panic's own message would be told twice.
    std::panic::set_hook(Box::new(|_| ()));
    let answer = arguments::read(std::env::args_os().skip(1).collect()).map_err(Stop::Usage).and_then(run);
    match answer {
        Ok(text) => {
            use std::io::Write;
            // A reader that has seen enough, such as `head`, is no error.
            let _ = std::io::stdout().write_all(text.as_bytes());
            ExitCode::SUCCESS
        }
        Err(Stop::Mistakes) => ExitCode::from(1),
        Err(Stop::Usage(message)) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn run(command: Command) -> Result<String, Stop> {
    match command {
        Command::Help => Ok(HELP.to_owned()),
        Command::Version => Ok(format!("cargo-multibody {}\n", env!("CARGO_PKG_VERSION"))),
        Command::Check(subject) => commands::check::run(&subject),
        Command::Counts(subject) => commands::counts::run(&subject),
        Command::Compare(subject, extent) => commands::compare::run(&subject, extent),
        Command::Equations(subject, form) => commands::equations::run(&subject, form),
        Command::Expand(subject) => commands::expand::run(&subject),
        Command::Import(subject) => commands::import::run(&subject),
        Command::Report(subject, folder, markdown) => commands::report::run(&subject, folder.as_deref(), markdown),
        Command::Diff(old, new) => commands::diff::run(&old, &new),
    }
}
