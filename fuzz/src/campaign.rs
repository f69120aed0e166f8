//! Many models in a row, and what became of them.

use std::collections::BTreeMap;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use crate::mechanism::Mechanism;
use crate::mechanism::shrink::minimise;
use crate::oracle::{Verdict, excuses, loops, tree};
use crate::random::Random;

/// What to run.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// Number of models.
    pub models: usize,
    /// Of the first; the others follow.
    pub seed: u64,
    /// Of each class of failures so many are minimised and printed.
    pub shown: usize,
    /// No model is begun after this.
    pub time: Duration,
}

/// Nothing compared is allowed of one in so many models.
const SILENT: usize = 10;

/// Counts by class.
#[derive(Debug, Default)]
pub struct Tally {
    /// Models looked at.
    pub models: usize,
    /// Numbers compared.
    pub numbers: usize,
    /// The same by what they are.
    pub kinds: BTreeMap<String, usize>,
    /// Models that compile and of which nothing could be compared, such as those whose equations are singular wherever they are met.
    pub silent: Vec<u64>,
    /// Models that have a function behind `Model::at`, whose numbers were compared.
    pub at: usize,
    /// Models that have a mass matrix as a triangle.
    pub triangles: usize,
    /// Models that have limbs in packs.
    pub packs: usize,
    /// Refusals and failures by class.
    pub classes: BTreeMap<String, Vec<u64>>,
    /// Minimised failures as text.
    pub reports: Vec<String>,
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tally { models, numbers, at, triangles, packs, .. } = self;
        write!(
            f,
            "{models} models ({at} with `at`, {triangles} with triangles, {packs} with packs), {numbers} numbers"
        )?;
        if self.silent.is_empty() { Ok(()) } else { write!(f, " ({} models without any)", self.silent.len()) }
    }
}

impl Tally {
    /// How many models were wrong, or broke the compiler. Where of many nothing was compared those count, since they prove nothing.
    pub fn failures(&self) -> usize {
        let bad = |class: &&String| !class.starts_with("true");
        let wrong: usize = self.classes.keys().filter(bad).map(|class| self.classes[class].len()).sum();
        let is_silent = self.silent.len() > 2 && self.silent.len() * SILENT > self.models;
        wrong + if is_silent { self.silent.len() } else { 0 }
    }
}

/// A family of mechanisms and what is checked of them.
pub trait Family {
    /// The model of a seed.
    fn draw(&self, seed: u64) -> Mechanism;
    /// What becomes of it.
    fn check(&self, mechanism: &Mechanism, seed: u64) -> Verdict;
    /// Whether a refusal has a true reason.
    fn excuses(&self, mechanism: &Mechanism, seed: u64, said: &[String]) -> bool;
}

/// Open chains and trees.
pub struct Chains;

impl Family for Chains {
    fn draw(&self, seed: u64) -> Mechanism {
        Mechanism::tree(&mut Random::new(seed))
    }

    fn check(&self, mechanism: &Mechanism, seed: u64) -> Verdict {
        tree::check(mechanism, seed)
    }

    fn excuses(&self, mechanism: &Mechanism, seed: u64, said: &[String]) -> bool {
        let singular = |text: &String| text.contains("mass or inertia") || text.contains("singular");
        said.iter().all(singular) && tree::is_singular(mechanism, seed)
    }
}

/// Limbs that are alike, in packs.
pub struct Limbs;

impl Family for Limbs {
    fn draw(&self, seed: u64) -> Mechanism {
        Mechanism::limbed(&mut Random::new(seed))
    }

    fn check(&self, mechanism: &Mechanism, seed: u64) -> Verdict {
        tree::check(mechanism, seed)
    }

    fn excuses(&self, mechanism: &Mechanism, seed: u64, said: &[String]) -> bool {
        Chains.excuses(mechanism, seed, said)
    }
}

/// Loops of all kinds in all formulations.
pub struct Loops;

impl Family for Loops {
    fn draw(&self, seed: u64) -> Mechanism {
        Mechanism::looped_one(&mut Random::new(seed))
    }

    fn check(&self, mechanism: &Mechanism, seed: u64) -> Verdict {
        loops::check(mechanism, seed)
    }

    fn excuses(&self, mechanism: &Mechanism, _: u64, said: &[String]) -> bool {
        let all = |words: &str| said.iter().all(|text| text.contains(words));
        // The language has no coordinate for what a quaternion's loop leaves.
        all("and it is a quaternion")
            || all("and its orientation is a quaternion")
            || !loops::is_regular(mechanism)
            || all("how many of its equations count is not known") && loops::loses_rank_where_closed(mechanism)
            || all("tells the screw's angle up to whole turns only") && loops::turns_beside_a_screw(mechanism)
            || all("leaves no freedom") && loops::is_locked(mechanism)
            || all("depends on how loops share their load") && excuses::is_redundant(mechanism)
    }
}

/// Wheels, blades and other equations of velocities in all formulations, with speeds.
pub struct Wheels;

impl Family for Wheels {
    fn draw(&self, seed: u64) -> Mechanism {
        Mechanism::on_wheels(&mut Random::new(seed))
    }

    fn check(&self, mechanism: &Mechanism, seed: u64) -> Verdict {
        loops::check(mechanism, seed)
    }

    fn excuses(&self, mechanism: &Mechanism, _: u64, said: &[String]) -> bool {
        excuses::excuse(mechanism, said)
    }
}

/// Runs a family.
pub fn run(family: &dyn Family, plan: Plan) -> Tally {
    let start = Instant::now();
    let mut tally = Tally::default();
    for seed in plan.seed..plan.seed + plan.models as u64 {
        if start.elapsed() > plan.time {
            break;
        }
        let mechanism = family.draw(seed);
        tally.models += 1;
        // Panics of the engine are verdicts; this one is the oracle's own, and must not end the run without a word.
        let Ok(verdict) = catch_unwind(AssertUnwindSafe(|| family.check(&mechanism, seed))) else {
            tally.classes.entry("the oracle panicked: run this seed with --panics".to_owned()).or_default().push(seed);
            continue;
        };
        let mut class = verdict.class();
        match &verdict {
            Verdict::Right(compared) => {
                tally.numbers += compared.numbers;
                compared.kinds.iter().for_each(|(kind, count)| *tally.kinds.entry(kind.clone()).or_default() += count);
                if compared.numbers == 0 {
                    tally.silent.push(seed);
                }
                tally.at += usize::from(compared.at > 0);
                tally.triangles += usize::from(compared.triangles > 0);
                tally.packs += usize::from(compared.packs);
                continue;
            }
            Verdict::Refused(said) if family.excuses(&mechanism, seed, said) => class = format!("true {class}"),
            _ => {}
        }
        let seen = tally.classes.entry(class.clone()).or_default();
        seen.push(seed);
        if seen.len() <= plan.shown {
            let fails = |m: &Mechanism| {
                let Ok(other) = catch_unwind(AssertUnwindSafe(|| family.check(m, seed))) else { return false };
                let excused = |said: &[String]| family.excuses(m, seed, said) != class.starts_with("true");
                other.class() == verdict.class() && !matches!(&other, Verdict::Refused(said) if excused(said))
            };
            let small = minimise(mechanism, 400, &fails);
            let after = family.check(&small, seed);
            tally.reports.push(format!("== {class}, seed {seed}\n{after}\n{}", small.text()));
        }
    }
    tally
}
