//! Ten thousand arms at once: which of its poses at rest does an arm with two links come to, from which start?
//!
//! `cargo run --release --example basins [-- SIDE]` lets SIDE times SIDE arms (100 times 100) go from rest, each with other angles,
//! four in the lanes of one scalar, on all cores. An arm that has gone over the top counts its turns, so there are many poses at
//! rest that look alike; their basins of attraction are drawn into `target/basins.svg`. The same arms on one core tell what
//! the others are worth.

use std::f64::consts::{PI, TAU};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody::{IntegrationError, LaneEnd, Real, multibody, simulate_lanes};
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;

#[path = "basins/svg.rs"]
mod svg;

multibody! {
    /// An arm of two links in a vertical plane. Gravity pulls along -y, both joints have friction.
    mod arm {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        body lower { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-Y), child: lower, axis: Z }
        /// [N m s/rad]
        param friction = 0.06;
        force first: Damper { joint: shoulder, damping: friction }
        force second: Damper { joint: elbow, damping: friction }
        output energy = kinetic() + potential();
    }
}
use arm::{Model, State};

/// Arms in one scalar.
const LANES: usize = 4;
/// [s] by then friction has left most arms too little to go over the top.
const SPAN: f64 = 60.0;
/// Of the angles, to be reached at the end.
const ACCURACY: f64 = 1e-6;
/// [J] above the energy at rest: with less than what it takes to lift the lower link over the elbow, 9.81, an arm makes no more
/// turns.
const LEAST_TURN: f64 = 9.81;

/// What has become of an arm.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fate {
    /// Comes to rest after so many turns of shoulder and elbow.
    Rests([i32; 2]),
    /// May still turn.
    Moves,
    /// Could not be followed.
    Lost,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let side = std::env::args().nth(1).map_or(Ok(100), |side| side.parse::<usize>())?.clamp(1, 2000);
    let cores = std::thread::available_parallelism()?.get();
    println!("{} arms, {SPAN} s each, on {cores} cores:", side * side);

    let all = batch(side, cores)?;
    println!("{} steps in {:.2} s: {:.2e} steps a second", all.steps, all.seconds, all.rate());
    // A share of the arms will do on one core, drawn evenly.
    let one = batch(side.div_ceil(2), 1)?;
    println!("on one core {:.2e}: {cores} cores are worth {:.2} of it", one.rate(), all.rate() / one.rate());
    let fates = all.fates;

    let mut known: Vec<([i32; 2], usize)> = Vec::new();
    for fate in &fates {
        match (fate, known.iter_mut().find(|(turns, _)| *fate == Fate::Rests(*turns))) {
            (_, Some((_, count))) => *count += 1,
            (Fate::Rests(turns), None) => known.push((*turns, 1)),
            _ => (),
        }
    }
    known.sort_by_key(|&(turns, count)| (std::cmp::Reverse(count), turns));
    let rest: usize = known.iter().map(|(_, count)| count).sum();
    println!("{rest} arms come to rest, in {} poses; most of them after", known.len());
    for ([shoulder, elbow], count) in known.iter().take(5) {
        println!("  {shoulder:>2} turns of the shoulder and {elbow:>2} of the elbow: {count:>6}");
    }
    let lost = fates.iter().filter(|fate| **fate == Fate::Lost).count();
    assert_eq!(lost, 0, "motions that could not be followed");

    let directory = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../target");
    std::fs::create_dir_all(&directory)?;
    std::fs::write(directory.join("basins.svg"), svg::basins(side, &fates))?;
    println!("The basins are in target/basins.svg.");
    Ok(())
}

/// What side times side arms have come to, row by row from below, and what that took.
struct Batch {
    fates: Vec<Fate>,
    steps: u64,
    seconds: f64,
}

impl Batch {
    /// Steps in a second.
    fn rate(&self) -> f64 {
        self.steps as f64 / self.seconds
    }
}

fn batch(side: usize, cores: usize) -> Result<Batch, Box<dyn std::error::Error>> {
    let bar = ProgressBar::new((side * side) as u64);
    bar.set_style(ProgressStyle::with_template("{wide_bar} {pos}/{len}, {eta} to go")?);
    let pool = ThreadPoolBuilder::new().num_threads(cores).build()?;
    let start = Instant::now();
    let ends: Result<Vec<_>, _> = pool.install(|| {
        (0..side * side)
            .into_par_iter()
            .step_by(LANES)
            .map(|first| {
                let ends = four(side, first)?;
                bar.inc(LANES as u64);
                Ok::<_, IntegrationError>(ends)
            })
            .collect()
    });
    let seconds = start.elapsed().as_secs_f64();
    bar.finish_and_clear();
    let mut ends: Vec<(Fate, u32)> = ends?.into_iter().flatten().collect();
    ends.truncate(side * side);
    let steps = ends.iter().map(|(_, steps)| u64::from(*steps)).sum();
    Ok(Batch { fates: ends.into_iter().map(|(fate, _)| fate).collect(), steps, seconds })
}

/// The angles [rad] of shoulder and elbow that the arm with this number starts with.
fn angles(side: usize, number: usize) -> [f64; 2] {
    let angle = |place: usize| ((place % side) as f64 + 0.5) / side as f64 * TAU - PI;
    [angle(number), angle(number / side)]
}

/// Four arms from the one with this number on, with the steps that each has taken.
fn four(side: usize, first: usize) -> Result<[(Fate, u32); LANES], IntegrationError> {
    let starts: [_; LANES] = std::array::from_fn(|lane| angles(side, first + lane));
    let mut state = State::default();
    state.q.shoulder = WideF64x4::from(starts.map(|[shoulder, _]| shoulder));
    state.q.elbow = WideF64x4::from(starts.map(|[_, elbow]| elbow));
    let model = Model::default();
    let ends = simulate_lanes(&model, 0.0, SPAN, &state, &(), ACCURACY, |_, _| ())?;
    let least = model.outputs(WideF64x4::lit(SPAN), &State::default(), &()).energy;
    let above = model.outputs(WideF64x4::lit(SPAN), &ends.state, &()).energy - least;
    let turns = |angle: WideF64x4, lane: usize| (angle.extract(lane) / TAU).round() as i32;
    let mut fates = [(Fate::Lost, 0); LANES];
    for (lane, (fate, end)) in fates.iter_mut().zip(ends.lanes()).enumerate() {
        let LaneEnd { accepted, rejected, error, .. } = *end;
        let q = &ends.state.q;
        let reached = if above.extract(lane) < LEAST_TURN {
            Fate::Rests([turns(q.shoulder, lane), turns(q.elbow, lane)])
        } else {
            Fate::Moves
        };
        *fate = (if error.is_none() { reached } else { Fate::Lost }, accepted + rejected);
    }
    Ok(fates)
}
