//! Broken files of robots: each is read as a model, or refused by one error that tells a place in the file.

mod mutate;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::{model, parse_reading, robots};

use crate::campaign::{Plan, Tally};
use crate::random::Random;

/// Of one file: thousands of times what the largest takes.
const LONGEST: Duration = Duration::from_secs(20);

const NAME: &str = "robot.file";

/// Mutations of the files in `tests/data/robots`.
pub fn run(plan: Plan) -> Tally {
    let files = files();
    let (start, mut tally) = (Instant::now(), Tally::default());
    for seed in plan.seed..plan.seed + plan.models as u64 {
        if start.elapsed() > plan.time {
            break;
        }
        let mut random = Random::new(seed);
        let (path, text) = random.pick(&files);
        let (text, changes) = mutate::mutated(&mut random, text);
        let kind = if path.extension().is_some_and(|end| end == "xml") { "Mjcf" } else { "Urdf" };
        let base = *random.pick(&["ground", "Free"]);
        let begun = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| outcome(&text, kind, base)));
        let outcome = match outcome {
            Ok(_) if begun.elapsed() > LONGEST => Err(format!("broken: slow\n{:?}", begun.elapsed())),
            Ok(outcome) => outcome,
            Err(_) => Err("broken: panic".to_owned()),
        };
        tally.models += 1;
        match outcome {
            Ok(errors) => tally.numbers += usize::from(errors == 0),
            Err(said) => {
                let class = said.lines().next().unwrap_or_default().to_owned();
                let seen = tally.classes.entry(class).or_default();
                seen.push(seed);
                if seen.len() <= plan.shown {
                    tally.reports.push(format!("== seed {seed}, {}, {}\n{said}", path.display(), changes.join(", ")));
                }
            }
        }
    }
    tally
}

/// All that there are, with their texts.
fn files() -> Vec<(PathBuf, String)> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/robots");
    let entries = fs::read_dir(directory).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_robot = |path: &PathBuf| path.extension().is_some_and(|end| end == "urdf" || end == "xml");
    let mut paths: Vec<PathBuf> = entries.filter(is_robot).collect();
    paths.sort();
    paths.into_iter().filter_map(|path| Some((path.clone(), fs::read_to_string(path).ok()?))).collect()
}

/// How many errors are told of the file, or what is wrong with them.
fn outcome(text: &str, kind: &str, base: &str) -> Result<usize, String> {
    let call = format!(
        "mod m {{ part r: {kind} {{ file: \"{NAME}\", base: {base}, allow: unphysical_inertia }}; emit mass_matrix; }}"
    );
    let tokens = call.parse().map_err(|_| "broken: no call".to_owned())?;
    let mut diagnostics = Diagnostics::default();
    let source = parse_reading(tokens, &|_| Ok(text.to_owned()), &mut diagnostics);
    match diagnostics.errors() {
        [] => {
            // The command takes the format from the root element.
            robots::import(text, NAME).map_err(|said| format!("broken: refused by `import` alone\n{said}"))?;
            // Its mechanics may be refused, such as an inertia that no body has: of each body.
            model::check(&source, &mut diagnostics);
            Ok(diagnostics.errors().len())
        }
        [only] if is_placed(&only.message, text) => Ok(1),
        [only] => Err(format!("broken: no place in the file\n{}", only.message)),
        more => Err(format!("broken: more than one error\n{more:?}")),
    }
}

/// `robot.file:line:column: ..` of a place that is there, or `robot.file: ..`.
fn is_placed(message: &str, text: &str) -> bool {
    let Some(rest) = message.strip_prefix(NAME) else { return false };
    if rest.starts_with(": ") {
        return true;
    }
    let mut words = rest.split(':').skip(1).map_while(|word| word.parse::<usize>().ok());
    let (Some(line), Some(column)) = (words.next(), words.next()) else { return false };
    // The end of a file has a place, behind the last character.
    let mut lines = text.split('\n');
    line.checked_sub(1).and_then(|k| lines.nth(k)).is_some_and(|line| column >= 1 && column <= line.chars().count() + 1)
}
