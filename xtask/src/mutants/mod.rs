//! `cargo xtask mutants`: which changes of an operator no test notices.
//!
//! All mutants of a package are compiled into one copy of it (mutant schemata, Untch, Offutt and Harrold 1993), each behind
//! a switch that an environment variable sets, so a mutant costs a run and no build. A run without a mutant measures every
//! test and records which sites it reaches; a mutant runs against those that reach it, the fast ones first. Mutants are
//! drawn from a seed until the budget is spent. Survivors are judged in `docs/mutants.md`.
//!
//! `--jury` has the engine's mutants judged by models instead, in an optimised build: what random mechanisms give against
//! their oracle, and the models of the project against what the engine gives without a mutant (`fuzz/src/jury.rs`).

mod build;
mod runs;
mod sites;

use crate::{Stop, root};
use build::{Built, JURY, Judges, Package};
use runs::{Test, Verdict};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::time::{Duration, Instant};

/// Sources that are mutated together with the tests that should notice.
struct Area {
    name: &'static str,
    package: Package,
    /// Below the package's `src`.
    folder: &'static str,
    /// Test binaries, "lib" for the library's own tests, and what the names of tests begin with.
    tests: &'static [(&'static str, &'static str)],
}

const ENGINE: Package = Package { name: "multibody-engine", folder: "macros/engine" };
const RUNTIME: Package = Package { name: "multibody", folder: "runtime" };

const AREAS: [Area; 5] = [
    Area { name: "symbolic", package: ENGINE, folder: "symbolic", tests: &[("lib", "symbolic::"), ("symbolic", "")] },
    Area { name: "optimize", package: ENGINE, folder: "optimize", tests: &[("optimize", "")] },
    Area { name: "solve", package: ENGINE, folder: "solve", tests: &[("solve", "")] },
    Area {
        name: "dynamics",
        package: ENGINE,
        folder: "dynamics",
        tests: &[
            ("dynamics", ""),
            // What needs a model to be reached: outputs, loops, loads.
            ("mechanics", "motion::"),
            ("mechanics", "forces::"),
            ("mechanics", "joints::"),
            ("mechanics", "reactions::"),
            ("mechanics", "balance::"),
            ("mechanics", "jacobians::"),
            ("mechanics", "formulations::"),
            ("mechanics", "loops::"),
        ],
    },
    Area { name: "integrators", package: RUNTIME, folder: "integrators", tests: &[("integrators", "")] },
];

pub(crate) const USAGE: &str =
    "[--jury] [--budget SECONDS] [--longest SECONDS] [--each SECONDS] [--seed N] [--among LIST] AREA...";

struct Options {
    areas: Vec<&'static Area>,
    /// Of each area, without compilation.
    budget: Duration,
    /// Tests that take longer are left out.
    longest: Duration,
    /// Of each mutant: of the tests that reach it, the fast ones that take no longer together.
    each: Duration,
    seed: u64,
    jury: bool,
    /// These instead of a sample, in the words of the lists that are written.
    among: Option<BTreeSet<String>>,
}

fn options(arguments: &[String]) -> Option<Options> {
    let (budget, longest) = (Duration::from_secs(300), Duration::from_secs(60));
    let each = Duration::MAX;
    let mut options = Options { areas: Vec::new(), budget, longest, each, seed: 1, jury: false, among: None };
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--budget" => options.budget = Duration::from_secs(arguments.next()?.parse().ok()?),
            "--longest" => options.longest = Duration::from_secs(arguments.next()?.parse().ok()?),
            "--seed" => options.seed = arguments.next()?.parse().ok()?,
            "--each" => options.each = Duration::from_secs(arguments.next()?.parse().ok()?),
            "--jury" => options.jury = true,
            "--among" => {
                let list = fs::read_to_string(arguments.next()?).ok()?;
                options.among = Some(list.lines().map(|line| place(line).to_string()).collect());
            }
            name => options.areas.push(AREAS.iter().find(|area| area.name == name)?),
        }
    }
    (!options.areas.is_empty()).then_some(options)
}

/// A line of a list without what was found of it.
fn place(line: &str) -> &str {
    line.split(" (").next().expect("a first part")
}

pub(crate) fn run(arguments: &[String]) -> Result<bool, Stop> {
    let names = AREAS.map(|area| area.name).join(", ");
    let options = options(arguments).ok_or_else(|| format!("{USAGE}\nareas: {names}"))?;
    for package in [ENGINE, RUNTIME] {
        if !options.areas.iter().any(|area| area.package == package) {
            continue;
        }
        // All areas of the package, whichever are asked for: mutants keep their numbers, and the library is compiled once.
        let all = AREAS.iter().filter(|area| area.package == package);
        let folders: Vec<&str> = all.map(|area| area.folder).collect();
        let asked = options.areas.iter().filter(|area| area.package == package);
        let mut binaries: Vec<&str> = asked.flat_map(|area| area.tests).map(|(binary, _)| *binary).collect();
        binaries.sort_unstable();
        binaries.dedup();
        let since = Instant::now();
        let judges = match (options.jury, package == ENGINE) {
            (true, true) => Judges::Jury,
            (true, false) => return Err("the jury judges the engine".into()),
            (false, _) => Judges::Tests(&binaries),
        };
        let built = build::build(package, &folders, judges)?;
        eprintln!("{} compiled in {} s", package.name, since.elapsed().as_secs());
        let jury = if options.jury { runs::measure(&built, JURY, "")? } else { Vec::new() };
        for area in options.areas.iter().filter(|area| area.package == package) {
            let mut tests = Vec::new();
            for (binary, filter) in area.tests.iter().filter(|_| !options.jury) {
                tests.extend(runs::measure(&built, binary, filter)?);
            }
            let tests = if options.jury { &jury } else { &tests };
            try_out(area, &built, tests, &options)?;
        }
    }
    Ok(true)
}

/// Runs an area's mutants and writes `target/mutants/AREA.txt`, what has survived, and `AREA-killed.txt`.
fn try_out(area: &Area, built: &Built, tests: &[Test], options: &Options) -> Result<(), Stop> {
    let plain: f64 = tests.iter().map(|test| test.time.as_secs_f64()).sum();
    let all = tests.len();
    let tests: Vec<&Test> = tests.iter().filter(|test| test.time <= options.longest).collect();
    println!("{}: {} of {all} tests run; all take {plain:.1} s without a mutant", area.name, tests.len());
    let folder = format!("{}/src/{}", area.package.folder, area.folder);
    let sources = built.sources.iter().filter(|source| source.path.starts_with(&folder));
    let sites = sources.flat_map(|source| (source.first..).zip(&source.sites).map(move |(n, site)| (n, source, site)));
    let mut mutants: Vec<_> = sites.filter(|(number, ..)| !built.refused.contains(number)).collect();
    let all = mutants.len();
    if let Some(among) = &options.among {
        mutants.retain(|(_, source, site)| among.contains(&format!("{}:{}: {}", source.path, site.line, site.change)));
    }
    shuffle(&mut mutants, options.seed);
    let since = Instant::now();
    let (mut killed, mut timed_out, mut survivors, mut dead) = (0, 0, Vec::new(), Vec::new());
    for (number, source, site) in mutants {
        if since.elapsed() > options.budget {
            break;
        }
        let reaching: Vec<&Test> = tests.iter().copied().filter(|test| test.reached.contains(&number)).collect();
        let verdict = runs::run(built, number, &reaching, options.each)?;
        match verdict {
            Verdict::Failed(by) => {
                killed += 1;
                dead.push((&source.path, site.line, format!("{} (by {by})", site.change)));
            }
            Verdict::TimedOut => {
                timed_out += 1;
                dead.push((&source.path, site.line, format!("{} (out of time)", site.change)));
            }
            Verdict::Passed | Verdict::OtherCode => {
                let found = match verdict {
                    Verdict::OtherCode => ", other code",
                    _ if reaching.is_empty() => ", reached by no test",
                    _ => "",
                };
                let change = format!("{} (mutant {number}{found})", site.change);
                eprintln!("{}:{}: {change}", source.path, site.line); // at once: a run may take long
                survivors.push((&source.path, site.line, change));
            }
        }
    }
    for (mut found, suffix) in [(dead, "-killed"), (survivors.clone(), "")] {
        found.sort();
        let mut list = String::new();
        for (path, line, change) in &found {
            let _ = writeln!(list, "{path}:{line}: {change}");
        }
        fs::write(root().join(format!("target/mutants/{}{suffix}.txt", area.name)), &list)?;
    }
    let ran = killed + timed_out + survivors.len();
    let spent = since.elapsed().as_secs();
    println!(
        "{}: seed {}, {ran} of {all} mutants in {spent} s: {killed} killed, {timed_out} ran out of time, {} survived",
        area.name,
        options.seed,
        survivors.len()
    );
    Ok(())
}

/// A permutation by the seed (Fisher and Yates; numbers by splitmix64).
fn shuffle<T>(list: &mut [T], seed: u64) {
    let mut state = seed;
    for index in (1..list.len()).rev() {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        list.swap(index, usize::try_from(z % (index as u64 + 1)).expect("below the length"));
    }
}

#[cfg(test)]
mod tests {
    use super::{AREAS, options, place, shuffle};

    #[test]
    fn a_seed_is_an_order() {
        let order = |seed| {
            let mut list: Vec<u32> = (0..100).collect();
            shuffle(&mut list, seed);
            list
        };
        assert_eq!(order(3), order(3));
        assert_ne!(order(3), order(4));
        let mut sorted = order(3);
        sorted.sort_unstable();
        assert_eq!(sorted, (0..100).collect::<Vec<_>>());
    }

    #[test]
    fn a_list_names_places() {
        assert_eq!(place("a/b.rs:7: + -> - (mutant 3, other code)"), "a/b.rs:7: + -> -");
        assert_eq!(place("a/b.rs:7: + -> -"), "a/b.rs:7: + -> -");
    }

    #[test]
    fn arguments() {
        let read = |text: &str| options(&text.split_whitespace().map(str::to_string).collect::<Vec<_>>());
        let read_all = read("--budget 60 --seed 7 --jury solve dynamics").expect("they are complete");
        assert_eq!((read_all.budget.as_secs(), read_all.seed, read_all.jury), (60, 7, true));
        assert_eq!(read_all.areas.iter().map(|area| area.name).collect::<Vec<_>>(), ["solve", "dynamics"]);
        for wrong in ["", "--budget", "--seed x solve", "nowhere"] {
            assert!(read(wrong).is_none(), "{wrong}");
        }
        for area in &AREAS {
            let folder = crate::root().join(area.package.folder).join("src").join(area.folder);
            assert!(folder.is_dir(), "{}", area.name);
        }
    }
}
