//! Many calls of the macro in a row: good ones, broken ones, and those that go through `rustc`.

use std::time::Instant;

use crate::campaign::{Plan, Tally};
use crate::grammar::oracle::{Outcome, minimise, outcome};
use crate::grammar::{call, mutate, rustc};
use crate::random::Random;

/// Calls that keep to the grammar, or broken ones. All refusals are counted; of the broken ones only what must not be.
pub fn run(plan: Plan, broken: bool) -> (Tally, Vec<Vec<String>>) {
    let start = Instant::now();
    let (mut tally, mut good) = (Tally::default(), Vec::new());
    for seed in plan.seed..plan.seed + plan.models as u64 {
        if start.elapsed() > plan.time {
            break;
        }
        let mut random = Random::new(seed);
        let mut lines = call(&mut random);
        if broken {
            lines = mutate::mutated(&mut random, lines);
        }
        let Some(found) = outcome(&lines.join("\n")) else { continue };
        tally.models += 1;
        let class = match &found {
            Outcome::Code(size) => {
                tally.numbers += size;
                good.push(lines);
                continue;
            }
            Outcome::Refused(_) if broken => continue,
            Outcome::Refused(_) => format!("true {}", found.class()),
            Outcome::Broken(_) => found.class(),
        };
        let seen = tally.classes.entry(class.clone()).or_default();
        seen.push(seed);
        if seen.len() <= plan.shown {
            let mut keeps = |lines: &[String]| outcome(&lines.join("\n")).is_some_and(|o| o.class() == found.class());
            let small = minimise(lines, &mut keeps);
            tally.reports.push(format!("== {class}, seed {seed}\n{found:?}\n{}\n", small.join("\n")));
        }
    }
    (tally, good)
}

/// Those that compile go through `rustc` and clippy, so many at once; a batch that fails is reported whole.
pub fn through_rustc(plan: Plan, name: &str) -> std::io::Result<Tally> {
    let mut tally = Tally::default();
    let mut seed = plan.seed;
    let start = Instant::now();
    while tally.models < plan.models && start.elapsed() < plan.time {
        let want = (plan.models - tally.models).min(50);
        let mut batch: Vec<Vec<String>> = Vec::new();
        while batch.len() < want {
            let lines = call(&mut Random::new(seed));
            seed += 1;
            // Big ones only take time.
            if matches!(outcome(&lines.join("\n")), Some(Outcome::Code(size)) if size < 400_000) {
                batch.push(lines);
            }
        }
        let directory = rustc::scratch(name);
        let said = rustc::build(&directory, &batch)?;
        tally.models += batch.len();
        for (tool, text) in [("rustc", said.build), ("clippy", said.clippy)] {
            if !text.is_empty() {
                let count =
                    text.lines().filter(|line| line.starts_with("error") || line.starts_with("warning")).count();
                tally.classes.entry(format!("broken: {tool}")).or_default().extend(vec![seed; count]);
                let numbers = text.match_indices("src/model").filter_map(|(at, _)| {
                    let digits: String = text[at + 9..].chars().take_while(char::is_ascii_digit).collect();
                    digits.parse::<usize>().ok()
                });
                let mut first: Vec<usize> = numbers.collect();
                first.dedup();
                let models: Vec<String> =
                    first.iter().take(3).filter_map(|&k| batch.get(k)).map(|lines| lines.join("\n")).collect();
                let text: String = text.chars().take(6000).collect();
                tally.reports.push(format!("== {tool}\n{text}\n{}\n", models.join("\n----\n")));
            }
        }
    }
    Ok(tally)
}

/// A file with the models of some seeds.
pub fn file(seeds: &[u64]) -> String {
    let mut text = "//! Written by `are_as_the_generator_says`.\n".to_owned();
    for seed in seeds {
        let lines = call(&mut Random::new(*seed));
        let lines: String = lines.iter().map(|line| format!("        {line}\n")).collect();
        let call = format!("    multibody::multibody! {{\n{lines}    }}\n");
        text += &format!("\n/// Of seed {seed}.\npub mod seed{seed} {{\n{call}}}\n");
    }
    text
}
