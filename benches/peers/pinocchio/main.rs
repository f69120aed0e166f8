//! Forward dynamics of mechanisms with closed loops, to be compared with Pinocchio's.
//!
//! `benches/peers/pinocchio/run` measures both programs, turn by turn. This one checks that models in reduced coordinates
//! say the same as those with multipliers, writes states and accelerations to the file that its argument names, which the
//! other program compares with its own, and prints a line for each model: mechanism, formulation, \[ns\] least time of an
//! evaluation.

mod models;
#[path = "../../../tests/support/random.rs"]
#[allow(dead_code, reason = "what tests share has more than this needs")]
mod random;
mod states;

use models::{biped, biped_reduced, delta, delta_reduced, stewart, stewart_reduced};
use random::Random;
use states::{COUNT, Sample};
use std::fmt::Write;
use std::hint::black_box;
use std::time::Instant;

/// Evaluations between two looks at the clock.
const EVALUATIONS: usize = 10_000;
const RUNS: usize = 20;

fn main() {
    let mut random = Random::new(1);
    let stewarts: Vec<_> = (0..COUNT).map(|_| states::stewart(&mut random)).collect();
    let deltas: Vec<_> = (0..COUNT).map(|_| states::delta(&mut random)).collect();
    let bipeds: Vec<_> = (0..COUNT).map(|_| states::biped(&mut random)).collect();
    if let Some(path) = std::env::args().nth(1).filter(|argument| argument != "--bench") {
        let mut text = String::new();
        write(&mut text, "stewart", stewarts.iter().map(|all| &all.4));
        write(&mut text, "delta", deltas.iter().map(|all| &all.4));
        write(&mut text, "biped", bipeds.iter().map(|all| &all.4));
        std::fs::write(path, text).expect("the states can be written");
    }

    let stewart = stewart::Model::default();
    let stewart_reduced = stewart_reduced::Model::default();
    let delta = delta::Model::default();
    let delta_reduced = delta_reduced::Model::default();
    let biped = biped::Model::default();
    let biped_reduced = biped_reduced::Model::default();
    let angles: Vec<f64> = (0..EVALUATIONS).map(|_| std::f64::consts::PI * random.unit()).collect();
    let mut rows = [
        Row::new("stewart multipliers", |k| {
            let (state, input, ..) = &stewarts[k % COUNT];
            black_box(stewart.forward_dynamics(0.0, black_box(state), input));
        }),
        Row::new("stewart reduced", |k| {
            let (_, _, state, input, _) = &stewarts[k % COUNT];
            black_box(stewart_reduced.forward_dynamics(0.0, black_box(state), input));
        }),
        Row::new("delta multipliers", |k| {
            let (state, input, ..) = &deltas[k % COUNT];
            black_box(delta.forward_dynamics(0.0, black_box(state), input));
        }),
        Row::new("delta reduced", |k| {
            let (_, _, state, input, _) = &deltas[k % COUNT];
            black_box(delta_reduced.forward_dynamics(0.0, black_box(state), input));
        }),
        Row::new("biped multipliers", |k| {
            let (state, input, ..) = &bipeds[k % COUNT];
            black_box(biped.forward_dynamics(0.0, black_box(state), input));
        }),
        Row::new("biped reduced", |k| {
            let (_, _, state, input, _) = &bipeds[k % COUNT];
            black_box(biped_reduced.forward_dynamics(0.0, black_box(state), input));
        }),
        Row::new("unit sin_cos", |k| {
            black_box(black_box(angles[k]).sin_cos());
        }),
    ];
    // Turn by turn, so that what else the machine does meets all of them.
    for _ in 0..RUNS {
        for row in &mut rows {
            row.time = row.time.min((row.run)());
        }
    }
    for row in rows {
        println!("{} {:.1}", row.name, row.time);
    }
}

/// A mechanism's name, its number of states, and a line for each: positions, velocities, efforts and accelerations.
fn write<'a>(text: &mut String, name: &str, samples: impl ExactSizeIterator<Item = &'a Sample>) {
    writeln!(text, "{name} {}", samples.len()).unwrap();
    for sample in samples {
        for value in [&sample.q, &sample.v, &sample.effort, &sample.accel].into_iter().flatten() {
            write!(text, "{value:e} ").unwrap();
        }
        text.push('\n');
    }
}

struct Row<'a> {
    name: &'static str,
    /// \[ns\] of one evaluation in a run
    run: Box<dyn Fn() -> f64 + 'a>,
    /// \[ns\] the least
    time: f64,
}

impl<'a> Row<'a> {
    fn new(name: &'static str, evaluate: impl Fn(usize) + 'a) -> Self {
        let run = move || {
            let (start, before) = (Instant::now(), waited());
            (0..EVALUATIONS).for_each(&evaluate);
            let lost = waited() - before;
            (start.elapsed().as_secs_f64() * 1e9 - lost) / EVALUATIONS as f64
        };
        Self { name, run: Box::new(run), time: f64::INFINITY }
    }
}

/// \[ns\] how long this thread has been ready to run and did not, where the system tells (Linux): time of others.
fn waited() -> f64 {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    text.split_whitespace().nth(1).and_then(|word| word.parse().ok()).unwrap_or(0.0)
}
