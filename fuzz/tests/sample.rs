//! A bounded, seeded sample of the long runs (see `ARCHITECTURE.md`, "How it is proven").

use std::time::Duration;

use multibody_fuzz::campaign::{Chains, Family, Limbs, Loops, Plan, Tally, run};
use multibody_fuzz::{differentiated, grammar_campaign, manipulated};

fn plan(models: usize, seed: u64) -> Plan {
    // On a slow machine fewer are looked at; none is judged less strictly.
    Plan { models, seed, shown: 1, time: Duration::from_secs(12) }
}

#[track_caller]
fn passes(family: &dyn Family, models: usize, seed: u64) -> Tally {
    let tally = run(family, plan(models, seed));
    println!("{tally} compared");
    assert!(tally.models > 0 && tally.numbers > 0);
    assert_eq!(tally.failures(), 0, "{:#?}\n{}", tally.classes, tally.reports.join("\n"));
    // However many models the time is enough for, some are asked for functions in other forms.
    assert!(6 * tally.at > tally.models && 6 * tally.triangles > tally.models, "{tally}");
    tally
}

#[test]
fn chains_and_trees() {
    passes(&Chains, 80, 1);
}

#[test]
fn limbs_that_are_alike() {
    let tally = passes(&Limbs, 40, 1);
    assert!(2 * tally.packs > tally.models, "{tally}");
}

#[test]
fn loops_in_all_formulations() {
    passes(&Loops, 26, 35);
}

#[test]
fn calls_that_keep_to_the_grammar() {
    let (tally, good) = grammar_campaign::run(plan(60, 1), false);
    assert_eq!(tally.failures(), 0, "{:#?}\n{}", tally.classes, tally.reports.join("\n"));
    assert!(4 * good.len() > tally.models, "{} of {} compile", good.len(), tally.models);
}

#[test]
fn derivatives_of_expressions() {
    let found = differentiated::run(&differentiated::Plan { models: 24, states: 4, seed: 5, most_freedoms: 4 });
    assert!(found.models == 24 && found.numbers > 800, "{} models, {} numbers", found.models, found.numbers);
    assert!(found.wrong.is_empty(), "{:#?}", found.wrong);
}

#[test]
fn expressions_that_take_others_apart() {
    let tally = manipulated::run(plan(40, 1));
    assert!(tally.models > 5 && tally.numbers > 50, "{} models, {} numbers", tally.models, tally.numbers);
    assert_eq!(tally.failures(), 0, "{:#?}\n{}", tally.classes, tally.reports.join("\n"));
}

#[test]
fn broken_calls() {
    let (tally, _) = grammar_campaign::run(plan(300, 1), true);
    assert!(tally.models > 10);
    assert_eq!(tally.failures(), 0, "{:#?}\n{}", tally.classes, tally.reports.join("\n"));
}
