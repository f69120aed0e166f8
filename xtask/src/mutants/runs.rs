//! Test binaries, run until the first test that fails.

use super::build::{Built, JURY};
use crate::Stop;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{BufRead, BufReader};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

/// A test, how long it takes without a mutant, and the sites it reaches.
pub(super) struct Test {
    binary: String,
    name: String,
    pub(super) time: Duration,
    pub(super) reached: BTreeSet<u32>,
}

/// Why a run ended.
#[derive(Debug, PartialEq)]
pub(super) enum Verdict {
    Passed,
    /// All passed, and some said that the code they saw was another one.
    OtherCode,
    Failed(String),
    TimedOut,
}

/// Mutants that ask for more memory than this, in kilobytes, die of it.
const MEMORY: u32 = 4_000_000;

/// Limit of a run without a mutant.
const MEASURE: Duration = Duration::from_secs(900);

/// Limits are of processor time, whatever else the machine does; this many times as long a run may last.
const WAITING: u32 = 10;

/// The signal of a limit of processor time (SIGXCPU).
const OUT_OF_TIME: i32 = 24;

/// Every test of the binaries whose name begins with the filter, without a mutant.
pub(super) fn measure(built: &Built, binary: &str, filter: &str) -> Result<Vec<Test>, Stop> {
    let record = built.folder.join(format!("reached-{binary}.txt"));
    let _ = fs::remove_file(&record);
    let _ = fs::remove_dir_all(known(built));
    let mut command = command(built, binary, MEASURE)?;
    command.env("MUTANTS_REACHED", &record);
    if binary != JURY {
        command.arg(filter);
    }
    let mut tests = Vec::new();
    let mut since = Instant::now();
    let verdict = follow(command, MEASURE, |name| {
        let time = since.elapsed();
        since = Instant::now();
        tests.push(Test { binary: binary.to_string(), name: name.to_string(), time, reached: BTreeSet::new() });
    })?;
    if verdict != Verdict::Passed {
        return Err(format!("without a mutant {binary} is {verdict:?}").into());
    }
    let reached = reached(&record)?;
    for test in &mut tests {
        // What a thread without a test's name reached may be any test's.
        for name in [test.name.as_str(), "?", "main"] {
            test.reached.extend(reached.get(name).into_iter().flatten());
        }
    }
    Ok(tests)
}

fn reached(record: &Path) -> Result<BTreeMap<String, BTreeSet<u32>>, Stop> {
    let mut reached = BTreeMap::<String, BTreeSet<u32>>::new();
    for line in fs::read_to_string(record).unwrap_or_default().lines() {
        let (name, site) = line.rsplit_once(' ').ok_or("a line without a site")?;
        reached.entry(name.to_string()).or_default().insert(site.parse()?);
    }
    Ok(reached)
}

/// What the jury knows of the project's models.
fn known(built: &Built) -> PathBuf {
    built.folder.join("jury")
}

/// Runs the tests that reach a mutant, the fast ones first, each batch within a few times its own time; none is begun that
/// would end after the budget.
pub(super) fn run(built: &Built, mutant: u32, tests: &[&Test], budget: Duration) -> Result<Verdict, Stop> {
    let mut batches: BTreeMap<(bool, &str), Vec<&Test>> = BTreeMap::new();
    let mut sorted = tests.to_vec();
    sorted.sort_by_key(|test| test.time);
    let mut spent = Duration::ZERO;
    for test in sorted {
        spent += test.time;
        if spent > budget {
            break;
        }
        batches.entry((spent > Duration::from_secs(1), &test.binary)).or_default().push(test);
    }
    let mut best = Verdict::Passed;
    for ((_, binary), batch) in batches {
        let plain: Duration = batch.iter().map(|test| test.time).sum();
        let limit = plain * 4 + Duration::from_secs(4);
        let mut command = command(built, binary, limit)?;
        command.env("MUTANT", mutant.to_string()).arg("--exact").args(batch.iter().map(|test| &test.name));
        match follow(command, limit * WAITING, |_| {})? {
            Verdict::Passed => {}
            Verdict::OtherCode => best = Verdict::OtherCode,
            verdict => return Ok(verdict),
        }
    }
    Ok(best)
}

fn command(built: &Built, binary: &str, limit: Duration) -> Result<Command, Stop> {
    let path = built.binaries.get(binary).ok_or_else(|| format!("no test binary {binary}"))?;
    let mut command = Command::new("sh");
    let limits = format!("ulimit -v {MEMORY}; ulimit -t {}; exec \"$0\" \"$@\"", limit.as_secs());
    command.args(["-c", &limits]).arg(path);
    if binary == JURY {
        command.arg("jury").arg("--record").arg(known(built));
    } else {
        command.arg("--test-threads=1");
    }
    command.env("CARGO_MANIFEST_DIR", &built.folder).env("RUST_BACKTRACE", "0").current_dir(&built.folder);
    Ok(command)
}

/// Reads what tests print and ends them at the first failure.
fn follow(mut command: Command, limit: Duration, mut passed: impl FnMut(&str)) -> Result<Verdict, Stop> {
    let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn()?;
    let output = child.stdout.take().ok_or("no output")?;
    let (sender, lines) = mpsc::channel();
    std::thread::spawn(move || BufReader::new(output).lines().map_while(Result::ok).try_for_each(|l| sender.send(l)));
    let end = Instant::now() + limit;
    let mut good = Verdict::Passed;
    let verdict = loop {
        match lines.recv_timeout(end.saturating_duration_since(Instant::now())) {
            Ok(line) => match outcome(&line) {
                Some((name, Outcome::Failed)) => break Some(Verdict::Failed(name.to_string())),
                Some((name, outcome)) => {
                    if outcome == Outcome::OtherCode {
                        good = Verdict::OtherCode;
                    }
                    passed(name);
                }
                None => {}
            },
            Err(RecvTimeoutError::Timeout) => break Some(Verdict::TimedOut),
            Err(RecvTimeoutError::Disconnected) => break None,
        }
    };
    if let Some(verdict) = verdict {
        child.kill()?;
        child.wait()?;
        return Ok(verdict);
    }
    let status = child.wait()?;
    Ok(match status.signal() {
        Some(OUT_OF_TIME) => Verdict::TimedOut,
        _ if status.success() => good,
        _ => Verdict::Failed("the process".to_string()),
    })
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Outcome {
    Passed,
    OtherCode,
    Failed,
}

/// A test's name and what became of it.
fn outcome(line: &str) -> Option<(&str, Outcome)> {
    let (name, end) = line.strip_prefix("test ")?.split_once(" ... ")?;
    let name = name.split(' ').next()?;
    match end {
        "FAILED" => Some((name, Outcome::Failed)),
        "ok" => Some((name, Outcome::Passed)),
        "ok, other code" => Some((name, Outcome::OtherCode)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_tests() {
        assert_eq!(outcome("test blocks::a ... ok"), Some(("blocks::a", Outcome::Passed)));
        assert_eq!(outcome("test blocks::b - should panic ... ok"), Some(("blocks::b", Outcome::Passed)));
        assert_eq!(outcome("test blocks::c ... FAILED"), Some(("blocks::c", Outcome::Failed)));
        assert_eq!(outcome("test a.rs::d ... ok, other code"), Some(("a.rs::d", Outcome::OtherCode)));
        assert_eq!(outcome("test blocks::d ... ignored"), None);
        assert_eq!(outcome("test result: ok. 3 passed"), None);
    }

    #[test]
    fn a_run_ends_at_its_first_failure_or_at_its_limit() {
        let run = |script: &str, limit: u64| {
            let mut command = Command::new("sh");
            command.args(["-c", script]);
            let mut passed = Vec::new();
            let verdict = follow(command, Duration::from_millis(limit), |name| passed.push(name.to_string()));
            (verdict.expect("sh runs"), passed)
        };
        let some = vec!["a".to_string()];
        assert_eq!(run("echo 'test a ... ok'", 60_000), (Verdict::Passed, some.clone()));
        let other = "echo 'test b ... ok, other code'; echo 'test a ... ok'";
        assert_eq!(run(other, 60_000), (Verdict::OtherCode, vec!["b".to_string(), "a".to_string()]));
        assert_eq!(run("exec sleep 60", 50), (Verdict::TimedOut, vec![]));
        let failing = "echo 'test a ... ok'; echo 'test b ... FAILED'; exec sleep 60";
        assert_eq!(run(failing, 60_000), (Verdict::Failed("b".to_string()), some));
        assert_eq!(run("kill -XCPU $$", 60_000).0, Verdict::TimedOut);
        assert_eq!(run("exit 1", 60_000).0, Verdict::Failed("the process".to_string()));
    }
}
