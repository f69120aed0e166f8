//! A copy of the workspace, one for each package, with all mutants in it, and its test binaries.

use super::sites::{self, Site};
use crate::{Stop, command, output, root};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::Stdio;

/// A package, and its folder in the workspace.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Package {
    pub(super) name: &'static str,
    pub(super) folder: &'static str,
}

/// A source file with mutants, numbered from `first`.
pub(super) struct Source {
    pub(super) path: String,
    pub(super) first: u32,
    pub(super) sites: Vec<Site>,
    text: String,
}

/// What is compiled of the copy to judge mutants.
#[derive(Clone, Copy)]
pub(super) enum Judges<'a> {
    /// Test binaries of the package.
    Tests(&'a [&'a str]),
    /// `multibody-fuzz jury`, optimised.
    Jury,
}

/// The mutated package and what became of its mutants.
pub(super) struct Built {
    pub(super) sources: Vec<Source>,
    /// Mutants that rustc refuses.
    pub(super) refused: BTreeSet<u32>,
    /// By name of the test binary, "lib" for the library's own, [`JURY`] for the program that isn't one.
    pub(super) binaries: BTreeMap<String, PathBuf>,
    /// Where they run.
    pub(super) folder: PathBuf,
}

/// The jury, as a binary.
pub(super) const JURY: &str = "jury";

const SWITCH: &str = include_str!("switch.rs");

/// Rounds of rustc; what it refuses is left out of the next.
const ROUNDS: usize = 12;

/// Compiles a package with mutants in all sources below the folders, and what judges them.
pub(super) fn build(package: Package, folders: &[&str], judges: Judges<'_>) -> Result<Built, Stop> {
    let place = root().join("target/mutants").join(package.name);
    let copy = place.join("source");
    let files = output(command("git").args(["ls-files"]).current_dir(root()))?;
    let mut sources = Vec::new();
    let mut first = 0;
    for path in files.lines() {
        let mutated = path.strip_prefix(package.folder).and_then(|path| path.strip_prefix("/src/"));
        let mutated = mutated.is_some_and(|path| path.ends_with(".rs") && folders.iter().any(|f| path.starts_with(f)));
        let from = root().join(path);
        if mutated {
            let text = fs::read_to_string(from)?;
            let sites = sites::find(&text).map_err(|error| format!("{path}: {error}"))?;
            let next = first + u32::try_from(sites.len())?;
            sources.push(Source { path: path.to_string(), first, sites, text });
            first = next;
        } else if from.is_file() {
            let mut bytes = fs::read(from)?;
            if path == format!("{}/src/lib.rs", package.folder) {
                bytes.extend(b"\nmod mutant;\n");
            }
            write(&copy.join(path), &bytes)?;
        }
    }
    write(&copy.join(package.folder).join("src/mutant.rs"), SWITCH.as_bytes())?;
    // What was refused before of the same sources: without it the next build would begin anew.
    let record = place.join("refused.txt");
    let mut key = DefaultHasher::new();
    sources.iter().for_each(|source| source.text.hash(&mut key));
    let key = format!("{:x}", key.finish());
    let mut refused = recorded(&fs::read_to_string(&record).unwrap_or_default(), &key);
    for _ in 0..ROUNDS {
        let ranges: BTreeMap<&str, _> = sources.iter().map(|s| (s.path.as_str(), rewrite(s, &refused))).collect();
        for (path, (text, _)) in &ranges {
            write(&copy.join(path), text.as_bytes())?;
        }
        let mut cargo = command("cargo");
        match judges {
            Judges::Tests(tests) => {
                cargo.args(["test", "--no-run", "--package", package.name]);
                for test in tests {
                    if *test == "lib" {
                        cargo.arg("--lib")
                    } else {
                        cargo.args(["--test", test])
                    };
                }
            }
            Judges::Jury => {
                cargo.args(["build", "--profile", "checked", "--package", "multibody-fuzz", "--bin", "multibody-fuzz"]);
            }
        }
        cargo.args(["--locked", "--message-format=json"]);
        // Lints of mutated code are of no interest.
        cargo.env("RUSTFLAGS", "--cap-lints=allow").env("CARGO_TARGET_DIR", place.join("build"));
        let built = cargo.current_dir(&copy).stdin(Stdio::null()).stderr(Stdio::null()).output()?;
        let messages: Vec<Value> =
            String::from_utf8(built.stdout)?.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
        if built.status.success() {
            let folder = copy.join(package.folder);
            return Ok(Built { binaries: binaries(&messages), sources, refused, folder });
        }
        let before = refused.len();
        for message in &messages {
            refused.extend(blamed(message, &ranges));
        }
        if refused.len() == before {
            let told = messages.iter().find_map(|message| message["message"]["rendered"].as_str());
            return Err(format!("the copy does not compile: {}", told.unwrap_or("see target/mutants")).into());
        }
        let list: String = refused.iter().map(|number| format!("{number}\n")).collect();
        fs::write(&record, format!("{key}\n{list}"))?;
        eprintln!("{} of {first} mutants do not compile", refused.len());
    }
    Err(format!("{ROUNDS} rounds did not find all mutants that do not compile").into())
}

/// The mutants of a record that was made under this key.
fn recorded(record: &str, key: &str) -> BTreeSet<u32> {
    let mut lines = record.lines();
    if lines.next() != Some(key) {
        return BTreeSet::new();
    }
    lines.filter_map(|line| line.parse().ok()).collect()
}

type Ranges = Vec<(u32, Range<usize>)>;

fn rewrite(source: &Source, refused: &BTreeSet<u32>) -> (String, Ranges) {
    let numbered: Vec<_> = (source.first..).zip(&source.sites).filter(|(n, _)| !refused.contains(n)).collect();
    sites::rewrite(&source.text, &numbered)
}

/// Cargo compiles what is newer: a file that is the same is left as it is.
fn write(path: &Path, bytes: &[u8]) -> Result<(), Stop> {
    if fs::read(path).is_ok_and(|there| there == bytes) {
        return Ok(());
    }
    fs::create_dir_all(path.parent().ok_or("a file without a folder")?)?;
    Ok(fs::write(path, bytes)?)
}

/// Mutants whose text an error stands in; where it stands in none, those whose lines it stands in.
fn blamed(message: &Value, ranges: &BTreeMap<&str, (String, Ranges)>) -> Vec<u32> {
    let mut found = Vec::new();
    if message["message"]["level"] != "error" {
        return found;
    }
    let empty = Vec::new();
    for span in message["message"]["spans"].as_array().unwrap_or(&empty) {
        let name = span["file_name"].as_str().unwrap_or_default();
        let Some((_, (text, ranges))) = ranges.iter().find(|(path, _)| name.ends_with(*path) || path.ends_with(name))
        else {
            continue;
        };
        let at = |key: &str| usize::try_from(span[key].as_u64().unwrap_or(0)).unwrap_or(0).min(text.len());
        let (start, end) = (at("byte_start"), at("byte_end"));
        let within = |range: &Range<usize>| range.start <= start && end <= range.end;
        let exact: Vec<u32> = ranges.iter().filter(|(_, range)| within(range)).map(|(number, _)| *number).collect();
        if exact.is_empty() {
            let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
            let line_end = text[end..].find('\n').map_or(text.len(), |at| at + end);
            let near = |range: &Range<usize>| range.start < line_end && line_start < range.end;
            found.extend(ranges.iter().filter(|(_, range)| near(range)).map(|(number, _)| *number));
        } else {
            found.extend(exact);
        }
    }
    found
}

fn binaries(messages: &[Value]) -> BTreeMap<String, PathBuf> {
    let artifact = |message: &Value| {
        let path = message["executable"].as_str()?;
        if message["target"]["kind"][0] == "bin" {
            return Some((JURY.to_string(), PathBuf::from(path)));
        }
        let test = message["target"]["kind"][0] == "test";
        let name = if test { message["target"]["name"].as_str()? } else { "lib" };
        message["profile"]["test"].as_bool()?.then(|| (name.to_string(), PathBuf::from(path)))
    };
    messages.iter().filter_map(artifact).collect()
}
