//! The command line.

use std::ffi::OsString;
use std::path::PathBuf;

use lexopt::{Arg, Parser, ValueExt};

pub(crate) const HELP: &str = "\
The compiler of multibody models as a command.

usage: cargo multibody COMMAND FILE [--model NAME]

FILE is a Rust file, or Markdown with blocks of Rust; its calls `multibody! { .. }` are read.

commands
  check FILE     mistakes with their places, as the compiler tells them; else one line per model
  counts FILE    operations of every function, as derived and as emitted
  expand FILE    the generated code, formatted, with a heading over each paragraph
  diff OLD NEW   what has changed between two files in the operations of functions

options
  --model NAME   only the model of this name
";

/// What a command looks at.
pub(crate) struct Subject {
    pub(crate) file: PathBuf,
    /// The only model that is looked at.
    pub(crate) model: Option<String>,
}

pub(crate) enum Command {
    Help,
    Version,
    Check(Subject),
    Counts(Subject),
    Expand(Subject),
    /// The older file, the newer one.
    Diff(Subject, Subject),
}

/// The words behind the program's name. Cargo puts `multibody` before those of its user.
pub(crate) fn read(mut words: Vec<OsString>) -> Result<Command, String> {
    if words.first().is_some_and(|word| word == "multibody") {
        words.remove(0);
    }
    let given = Given::read(words).map_err(|error| error.to_string())?;
    if given.help {
        return Ok(Command::Help);
    }
    if given.version {
        return Ok(Command::Version);
    }
    let mut values = given.values.into_iter();
    let Some(name) = values.next() else { return Ok(Command::Help) };
    let files = if name == "diff" { 2 } else { 1 };
    let mut subjects: Vec<Subject> =
        values.map(|file| Subject { file: file.into(), model: given.model.clone() }).collect();
    let name = name.to_string_lossy().into_owned();
    let command: fn(Subject, Option<Subject>) -> Command = match name.as_str() {
        "check" => |file, _| Command::Check(file),
        "counts" => |file, _| Command::Counts(file),
        "expand" => |file, _| Command::Expand(file),
        "diff" => |old, new| new.map_or(Command::Help, |new| Command::Diff(old, new)),
        _ => return Err(format!("unknown command `{name}`; `cargo multibody --help` lists them")),
    };
    if subjects.len() != files {
        let noun = if files == 1 { "one file" } else { "two files" };
        return Err(format!("`{name}` takes {noun}, and not {}", subjects.len()));
    }
    let second = if files == 2 { subjects.pop() } else { None };
    Ok(command(subjects.remove(0), second))
}

#[derive(Default)]
struct Given {
    values: Vec<OsString>,
    model: Option<String>,
    help: bool,
    version: bool,
}

impl Given {
    fn read(words: Vec<OsString>) -> Result<Given, lexopt::Error> {
        let mut given = Given::default();
        let mut parser = Parser::from_args(words);
        while let Some(argument) = parser.next()? {
            match argument {
                Arg::Value(value) => given.values.push(value),
                Arg::Long("model") => given.model = Some(parser.value()?.string()?),
                Arg::Long("help") | Arg::Short('h') => given.help = true,
                Arg::Long("version") | Arg::Short('V') => given.version = true,
                other => return Err(other.unexpected()),
            }
        }
        Ok(given)
    }
}
