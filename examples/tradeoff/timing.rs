//! Time of every run: the least of several rounds through all runs of a scene.

use std::time::{Duration, Instant};

use crate::bench::Bench;

/// `[s]` Runs that take longer are timed twice at most.
const LONG: f64 = 5e-3;

/// Times all runs, round after round, so that a slow moment of the machine strikes no method alone.
pub(crate) fn time(bench: &mut Bench) {
    for pass in 0..bench.effort.passes {
        bench.progress(&format!("timing {} of {}", pass + 1, bench.effort.passes));
        let (effort, end) = (bench.effort, bench.truth.end);
        for (point, solver) in bench.points.iter_mut().zip(&bench.solvers) {
            if pass < 2 || point.seconds * end < LONG {
                let spent = least(|| (solver.plain)(point.setting), effort.timing, effort.batch);
                point.seconds = point.seconds.min(spent / end);
            }
        }
    }
    println!();
}

/// `[s]` the least time of a run, from several batches of them.
fn least(run: impl Fn(), timing: Duration, batch: Duration) -> f64 {
    let (start, mut least) = (Instant::now(), f64::INFINITY);
    while start.elapsed() < timing || least.is_infinite() {
        // A wait between the readings of the two clocks must not count as lost if it doesn't count as spent.
        let (begin, before, mut count) = (Instant::now(), waited(), 0);
        while count == 0 || begin.elapsed() < batch {
            run();
            count += 1;
        }
        // Others had their turn: a short batch is lost, unless all are; a long one is corrected.
        let lost = waited().saturating_sub(before);
        let all = begin.elapsed();
        if lost.is_zero() || all > timing || start.elapsed() > 20 * timing {
            least = least.min(all.saturating_sub(lost).as_secs_f64() / f64::from(count));
        }
    }
    least
}

/// How long this thread has been ready to run and did not, where the system tells (Linux): time of others.
fn waited() -> Duration {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    Duration::from_nanos(text.split_whitespace().nth(1).and_then(|word| word.parse().ok()).unwrap_or(0))
}
