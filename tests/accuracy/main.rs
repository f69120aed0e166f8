//! Speed is not bought with accuracy: every function of every model of the ledger, with each optimisation on and off, in `f64` and
//! `f32`, against its equations as derived, in 67 digits.
//!
//! The error of results of one kind is normwise: the greatest error of any of them over the greatest of them, in units in the
//! last place of the latter. The condition number is that of the problem, with respect to all of its data, componentwise:
//! max_i sum_d |df_i / dd| |d| / max_i |f_i|, where d runs through the numbers that the function reads and the literals that are
//! no single numbers; it is the mixed condition number of Gohberg and Koltracht (1993), see Higham, Accuracy and Stability of Numerical
//! Algorithms, 2nd ed., sections 1.6 and 25.2, but for that it counts one at least. The median error, of all results at all
//! states, is at most [`MEDIAN`], the greatest [`GREATEST`] times the condition number.
//!
//! What is beside the question is not measured:
//!
//! - Parameters that are zero are moved by as much as their neighbours are. A product of inertia of another size than the moments
//!   beside it leaves a mass matrix that is not positive definite, at which no elimination without pivots is accurate.
//! - The rank behind a least displacement is no result whose size others are measured by, and where it falls it says so.
//! - The greater of two numbers is continuous where they are equal, as they are in symmetric limbs; so nothing is unclear.
//! - What is zero at a state and comes out so is right, and counts.
//!
//! A miss is put down to its cause ([`judge::Miss`]): to the data, where medians are no more than the condition number asks for; to the
//! equations as derived, where no error is more than one rounding of each of their operations may leave; else to the optimiser.
//!
//! It takes minutes, and functions are known that miss these bounds, so it is run by hand. `MODEL=puma` looks at the models with
//! this in their names alone: then no page is written.
//! `STATES=1000` looks at as many states, with every pass left out in turn, which takes 50 minutes of one processor;
//! `UPDATE_ACCURACY=1` writes `docs/accuracy.md`:
//!
//! ```text
//! STATES=1000 UPDATE_ACCURACY=1 cargo test --release -p multibody-tests --test accuracy -- --ignored
//! ```

mod digits;
mod judge;
mod machine;
mod report;
mod states;
mod variants;

use std::sync::atomic::{AtomicUsize, Ordering};

use multibody_tests::support::data::path;
use multibody_tests::support::ledger::entries;

use judge::{Figures, judge};

/// Units in the last place.
const MEDIAN: f64 = 4.0;

/// Units in the last place, over the condition number.
const GREATEST: f64 = 64.0;

/// Without `STATES`.
const FEW: usize = 10;

/// All models, by as many threads as there are processors.
fn all(only: &str, states: usize, thorough: bool) -> Vec<Figures> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut found = Vec::new();
        let entries = entries();
        loop {
            let done = next.fetch_add(1, Ordering::Relaxed);
            // Those that take longest stand last.
            let Some(number) = entries.len().checked_sub(done + 1) else { return found };
            let entry = &entries[number];
            if entry.name().contains(only) {
                found.push((number, judge(entry, states, thorough)));
            }
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut found: Vec<(usize, Vec<Figures>)> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("a worker that ends")).collect()
    });
    found.sort_by_key(|(number, _)| *number);
    found.into_iter().flat_map(|(_, figures)| figures).collect()
}

#[test]
#[ignore = "minutes, and misses that are known"]
fn errors_are_those_of_the_data() {
    let wanted = std::env::var("STATES").ok().and_then(|text| text.parse().ok());
    let states = wanted.unwrap_or(FEW);
    let only = std::env::var("MODEL").unwrap_or_default();
    let figures = all(&only, states, wanted.is_some());
    assert!(!figures.is_empty(), "no model of the ledger has {only} in its name");
    if only.is_empty() && std::env::var_os("UPDATE_ACCURACY").is_some() {
        std::fs::write(path("../docs/accuracy.md"), report::written(&figures, states)).unwrap();
    }
    let missed: Vec<String> = figures.iter().filter(|figures| figures.miss().is_some()).map(report::line).collect();
    println!("{} functions in {} forms", figures.len(), report::variants(&figures).len());
    assert!(missed.is_empty(), "{missed:#?}");
}
