//! The long runs: `cargo run --release -p multibody-fuzz -- chains --models 10000 --seed 1`.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use multibody_fuzz::campaign::{Chains, Family, Limbs, Loops, Plan, Tally, Wheels, run};
use multibody_fuzz::{differentiated, grammar_campaign, jury, manipulated, robots, written};

fn number(arguments: &[String], name: &str, default: u64) -> u64 {
    let at = arguments.iter().position(|word| word == name);
    at.and_then(|k| arguments.get(k + 1)).and_then(|text| text.parse().ok()).unwrap_or(default)
}

fn show(what: &str, tally: &Tally, start: Instant) -> bool {
    for report in &tally.reports {
        println!("{report}");
    }
    let time = start.elapsed().as_secs_f64();
    println!("{what}: {tally} compared, {time:.1} s");
    for (class, seeds) in &tally.classes {
        println!("  {:5}  {class}  (seeds {:?})", seeds.len(), &seeds[..seeds.len().min(6)]);
    }
    for (kind, count) in &tally.kinds {
        println!("  {count:9} numbers: {kind}");
    }
    if !tally.silent.is_empty() {
        println!(
            "  {:5}  nothing compared  (seeds {:?})",
            tally.silent.len(),
            &tally.silent[..tally.silent.len().min(12)]
        );
    }
    tally.failures() == 0
}

/// Equations as they are printed, to standard output.
fn put_down(arguments: &[String]) -> ExitCode {
    // Every option has a number behind it.
    let files = (0..arguments.len()).filter(|&k| {
        let behind = k.checked_sub(1).is_some_and(|before| arguments[before].starts_with("--"));
        !behind && !arguments[k].starts_with("--")
    });
    let plan = written::Plan {
        models: number(arguments, "--models", u64::MAX) as usize,
        states: number(arguments, "--states", 100) as usize,
        seed: number(arguments, "--seed", 1),
        most_freedoms: number(arguments, "--most-freedoms", u64::MAX) as usize,
        files: files.map(|k| arguments[k].clone()).collect(),
    };
    match written::run(&plan, &mut std::io::stdout().lock()) {
        Ok(models) => {
            eprintln!("{models} models");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// `diff` in all models of the project.
fn differentiate(arguments: &[String]) -> ExitCode {
    let found = differentiated::run(&differentiated::Plan {
        models: number(arguments, "--models", u64::MAX) as usize,
        states: number(arguments, "--states", 10) as usize,
        seed: number(arguments, "--seed", 1),
        most_freedoms: number(arguments, "--most-freedoms", 12) as usize,
    });
    for wrong in &found.wrong {
        println!("{wrong}");
    }
    println!("{} models, {} derivatives compared, worst {:.1e}", found.models, found.numbers, found.worst);
    if found.wrong.is_empty() && found.numbers > 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments.first().is_some_and(|word| word == "jury") {
        return if jury::run(&arguments[1..]) { ExitCode::SUCCESS } else { ExitCode::FAILURE };
    }
    if arguments.first().is_some_and(|word| word == "written") {
        return put_down(&arguments[1..]);
    }
    if arguments.first().is_some_and(|word| word == "differentiated") {
        return differentiate(&arguments[1..]);
    }
    let plan = Plan {
        models: number(&arguments, "--models", 1000) as usize,
        seed: number(&arguments, "--seed", 1),
        shown: number(&arguments, "--shown", 2) as usize,
        time: Duration::from_secs(number(&arguments, "--seconds", 36_000)),
    };
    if !arguments.iter().any(|word| word == "--panics") {
        std::panic::set_hook(Box::new(|_| {}));
    }
    let start = Instant::now();
    let done = match arguments.first().map(String::as_str) {
        Some("grammar") => Some(grammar_campaign::run(plan, false).0),
        Some("broken") => Some(grammar_campaign::run(plan, true).0),
        Some("manipulated") => Some(manipulated::run(plan)),
        Some("robots") => Some(robots::run(plan)),
        Some("rustc") => match grammar_campaign::through_rustc(plan, "long") {
            Ok(tally) => Some(tally),
            Err(error) => {
                println!("{error}");
                return ExitCode::FAILURE;
            }
        },
        _ => None,
    };
    if let Some(tally) = done {
        return if show(&arguments[0], &tally, start) { ExitCode::SUCCESS } else { ExitCode::FAILURE };
    }
    let family: Box<dyn Family> = match arguments.first().map(String::as_str) {
        Some("chains") => Box::new(Chains),
        Some("limbs") => Box::new(Limbs),
        Some("loops") => Box::new(Loops),
        Some("wheels") => Box::new(Wheels),
        _ => {
            println!(
                "chains|limbs|loops|wheels|grammar|broken|manipulated|robots|rustc [--models N] [--seed S] [--shown K] [--seconds T]"
            );
            println!("jury {}", jury::USAGE);
            println!("written {}", written::USAGE);
            return ExitCode::FAILURE;
        }
    };
    let name = arguments[0].as_str();
    if let Some(seed) = arguments.iter().position(|word| word == "--print") {
        let seed = arguments.get(seed + 1).and_then(|text| text.parse().ok()).unwrap_or(plan.seed);
        println!("{}", family.draw(seed).text());
    }
    let tally = run(family.as_ref(), plan);
    if show(name, &tally, start) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
