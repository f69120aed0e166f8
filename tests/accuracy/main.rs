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
//! It takes minutes, and functions are known that miss these bounds, so it is run by hand. `MODEL=puma` looks at the models with
//! this in their names alone: then no page is written.
//! `STATES=1000` looks at as many states, with every pass left out in turn; `UPDATE_ACCURACY=1` writes `docs/accuracy.md`:
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
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(entry) = entries.get(number) else { return found };
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
    let missed: Vec<String> = figures.iter().filter(|figures| !figures.within()).map(report::line).collect();
    println!("{} functions in {} forms", figures.len(), report::variants(&figures).len());
    assert!(missed.is_empty(), "{missed:#?}");
}

impl Figures {
    pub(crate) fn within(&self) -> bool {
        self.median() <= MEDIAN && self.greatest <= GREATEST
    }
}
