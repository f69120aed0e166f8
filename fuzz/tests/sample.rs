//! A bounded, seeded sample of the long runs (see `ARCHITECTURE.md`, "How it is proven").

use std::ops::Range;
use std::time::Duration;

use multibody_fuzz::campaign::{Chains, Family, Limbs, Loops, Plan, Tally, Wheels, run};
use multibody_fuzz::mechanism::Mechanism;
use multibody_fuzz::{differentiated, grammar_campaign, manipulated, robots};

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
    tally
}

/// Whatever is asked for in another form is compared, unless the model is refused.
#[track_caller]
fn passes_in_all_forms(family: &dyn Family, models: usize, seed: u64) -> Tally {
    let tally = passes(family, models, seed);
    let refused: usize = tally.classes.values().map(Vec::len).sum();
    let [at, triangles] = asked(family, seed..seed + tally.models as u64);
    assert!(
        tally.at + refused >= at && tally.triangles + refused >= triangles,
        "{tally}; {at} and {triangles} asked for"
    );
    tally
}

/// How many models ask for functions behind `Model::at`, and for triangles.
fn asked(family: &dyn Family, seeds: Range<u64>) -> [usize; 2] {
    let drawn: Vec<Mechanism> = seeds.map(|seed| family.draw(seed)).collect();
    let of = |has: fn(&Mechanism) -> bool| drawn.iter().filter(|mechanism| has(mechanism)).count();
    [of(|m| !m.at.is_empty()), of(|m| m.emit.contains(&"mass_matrix_lower"))]
}

#[test]
fn chains_and_trees() {
    passes_in_all_forms(&Chains, 80, 1);
}

#[test]
fn limbs_that_are_alike() {
    // Packs in more than half of them, however many the time is enough for.
    let tally = passes_in_all_forms(&Limbs, 40, 2);
    assert!(2 * tally.packs > tally.models, "{tally}");
}

#[test]
fn wheels_blades_and_speeds() {
    passes(&Wheels, 60, 7076);
}

#[test]
fn other_forms_are_drawn_often() {
    for family in [&Chains as &dyn Family, &Limbs, &Loops, &Wheels] {
        let asked = asked(family, 1..101);
        assert!(asked.iter().all(|&count| count > 25), "{asked:?}");
    }
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

/// Files of robots that are broken.
#[test]
fn broken_files_of_robots() {
    let tally = robots::run(Plan { time: Duration::from_secs(8), ..plan(600, 1) });
    assert_eq!(tally.failures(), 0, "{:#?}\n{}", tally.classes, tally.reports.join("\n"));
    // Not all are refused: what is read is not only the first mistake.
    assert!(tally.models > 50 && 20 * tally.numbers > tally.models, "{} of {} are read", tally.numbers, tally.models);
}
