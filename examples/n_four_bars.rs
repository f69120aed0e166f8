//! Two four-bars in a row, all bars of one length: a benchmark whose loops lose rank whenever the bars lie flat.
//!
//! `cargo run --release --example n_four_bars`
//!
//! Flat, the linkage could go on as parallelograms or fold over, so equations alone don't say how it moves on. A user who
//! knows that it stays parallel writes that down, `solve (..) = (..)`, and the compiler checks that it closes the loops: one
//! coordinate is left, and the flat pose is nothing special. With multipliers and projection the linkage passes it too: the
//! linear systems for the multipliers notice the loss of rank, leave out what is lost, and report it.

use multibody::{Constrained, DormandPrince, Projection};

#[path = "models/n_four_bars.rs"]
mod model;

use model::{parallel, redundant};

/// [m] tip of the first bar at whole seconds, by elliptic functions
const EXACT: [[f64; 2]; 5] = [
    [0.0, 1.0],
    [0.05781579576801143, 0.9983272678634555],
    [0.11761610237680861, 0.9930591384513251],
    [0.18138112622340818, 0.9834128772036331],
    [0.2510559146283013, 0.967972586249294],
];
/// [s] between them
const APART: f64 = 2.0;
/// [s]
const STEP: f64 = 1e-3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "One coordinate, or {} with {} equations; steps of {} ms. A turn takes 1.94 s, and lies flat twice.\n",
        redundant::DOF,
        redundant::CONSTRAINTS,
        STEP * 1e3
    );
    println!("          parallelograms               multipliers and projection");
    println!("  t [s]   error [m]   energy [J]       error [m]   energy [J]");
    let free = parallel::Model::<f64>::default();
    let mut one = parallel::State::<f64>::default();
    (one.q.crank, one.v.crank) = (std::f64::consts::FRAC_PI_2, -1.0);
    let loops = redundant::Model::<f64>::default();
    let mut many = redundant::State::<f64>::default();
    let up = std::f64::consts::FRAC_PI_2;
    many.q = redundant::Position { crank: up, middle: up, last: up, coupler1: -up, coupler2: -up };
    many.v = redundant::Velocity { crank: -1.0, middle: -1.0, last: -1.0, coupler1: 1.0, coupler2: 1.0 };
    let energies = |one: &parallel::State, many: &redundant::State| {
        [free.outputs(0.0, one, &()).energy, loops.outputs(0.0, many, &()).energy]
    };
    let start = energies(&one, &many);
    let projection = Projection::default();
    let steps = (APART / STEP).round() as u32;
    for (k, [x, y]) in EXACT.into_iter().enumerate() {
        let tips = [free.outputs(0.0, &one, &()).tip, loops.outputs(0.0, &many, &()).tip];
        let error = tips.map(|tip| (tip.x - x).hypot(tip.y - y));
        let now = energies(&one, &many);
        println!(
            "  {:>5}{:>12.0e}{:>13.0e}{:>16.0e}{:>13.0e}",
            k as f64 * APART,
            error[0],
            now[0] - start[0],
            error[1],
            now[1] - start[1]
        );
        one = DormandPrince::integrate(&free, 0.0, &one, &(), STEP, steps, |_, _| ())?;
        for _ in 0..steps {
            let next = DormandPrince::step(&loops, 0.0, &many, &(), STEP);
            many = projection.project(&loops, 0.0, &next)?.state;
        }
    }
    println!("\n  at the end the loops are open by {:.0e} m", Constrained::constraints(&loops, 0.0, &many.q).amax());
    let rank = |state: &redundant::State| loops.forward_dynamics(0.0, state, &()).rank;
    println!("  independent equations: {} now, {} when flat", rank(&many), rank(&redundant::State::default()));
    println!("\nOperations of the generated functions:\n");
    for cost in parallel::COSTS.iter().chain(redundant::COSTS).filter(|cost| cost.function == "forward_dynamics") {
        println!("  {cost}");
    }
    Ok(())
}
