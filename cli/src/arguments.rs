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
  equations FILE the equations of each model, for readers: --text (so by default), --latex or --mathml
  expand FILE    the generated code, formatted, with a heading over each paragraph
  import ROBOT   a robot's file (URDF, MJCF) as a part and a model of the language, for those who want to go on from its text
  diff OLD NEW   what has changed between two files in the operations of functions and in equations
  compare FILE   each model in every choice of coordinates and constraints: sizes, operations of forward dynamics
                 (--all: and of the other functions that it asks for), and which choice to take; --measure compiles
                 and times all of them
  report FILE    a page about each model: graph, drawing, tables, structure of matrices, costs, candidates, equations;
                 NAME.html in --out DIR (target/multibody by default), and with --markdown NAME.md beside it

options
  --model NAME   only the model of this name
  --parts FILE   a file that declares parts which a call of FILE uses by `use path::of::part;`; may be given several times
";

/// What a command looks at.
pub(crate) struct Subject {
    pub(crate) file: PathBuf,
    /// The only model that is looked at.
    pub(crate) model: Option<String>,
    /// Files whose parts it uses, beside its own.
    pub(crate) parts: Vec<PathBuf>,
}

/// How equations are printed.
#[derive(Clone, Copy, Default)]
pub(crate) enum Form {
    #[default]
    Text,
    Latex,
    Mathml,
}

/// What is compared.
#[derive(Clone, Copy, Default)]
pub(crate) struct Extent {
    /// All functions that models ask for, not forward dynamics alone.
    pub(crate) all: bool,
    /// Times of the compiled code too.
    pub(crate) measure: bool,
}

pub(crate) enum Command {
    Help,
    Version,
    Check(Subject),
    Counts(Subject),
    Compare(Subject, Extent),
    Equations(Subject, Form),
    Expand(Subject),
    /// A robot's file.
    Import(Subject),
    /// The older file, the newer one.
    Diff(Subject, Subject),
    /// Into a folder, and as Markdown too.
    Report(Subject, Option<PathBuf>, bool),
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
    let name = name.to_string_lossy().into_owned();
    let subject =
        |file: OsString| Subject { file: file.into(), model: given.model.clone(), parts: given.parts.clone() };
    let subjects: Vec<Subject> = values.map(subject).collect();
    match name.as_str() {
        "check" => Ok(Command::Check(one(&name, subjects)?)),
        "compare" => Ok(Command::Compare(one(&name, subjects)?, given.extent)),
        "counts" => Ok(Command::Counts(one(&name, subjects)?)),
        "equations" => Ok(Command::Equations(one(&name, subjects)?, given.form)),
        "expand" => Ok(Command::Expand(one(&name, subjects)?)),
        "import" => Ok(Command::Import(one(&name, subjects)?)),
        "report" => Ok(Command::Report(one(&name, subjects)?, given.out, given.markdown)),
        "diff" => {
            let [old, new] = files(&name, "two files", subjects)?;
            Ok(Command::Diff(old, new))
        }
        _ => Err(format!("unknown command `{name}`; `cargo multibody --help` lists them")),
    }
}

fn one(name: &str, subjects: Vec<Subject>) -> Result<Subject, String> {
    files(name, "one file", subjects).map(|[subject]| subject)
}

fn files<const N: usize>(name: &str, wanted: &str, subjects: Vec<Subject>) -> Result<[Subject; N], String> {
    let found = subjects.len();
    subjects.try_into().map_err(|_| format!("`{name}` takes {wanted}, and not {found}"))
}

#[derive(Default)]
struct Given {
    values: Vec<OsString>,
    model: Option<String>,
    parts: Vec<PathBuf>,
    form: Form,
    extent: Extent,
    out: Option<PathBuf>,
    markdown: bool,
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
                Arg::Long("parts") => given.parts.push(parser.value()?.into()),
                Arg::Long("all") => given.extent.all = true,
                Arg::Long("measure") => given.extent.measure = true,
                Arg::Long("out") => given.out = Some(parser.value()?.into()),
                Arg::Long("markdown") => given.markdown = true,
                Arg::Long("text") => given.form = Form::Text,
                Arg::Long("latex") => given.form = Form::Latex,
                Arg::Long("mathml") => given.form = Form::Mathml,
                Arg::Long("help") | Arg::Short('h') => given.help = true,
                Arg::Long("version") | Arg::Short('V') => given.version = true,
                other => return Err(other.unexpected()),
            }
        }
        Ok(given)
    }
}
