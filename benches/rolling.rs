//! Whipple's bicycle, its 26 numbers parameters, beside one `sin_cos` of the standard library, in one process: `cargo bench --bench rolling`.
//!
//! A right-hand side is a call of `forward_dynamics` at one of many states in turn: states that don't depend on each other, as in a
//! sweep, and each beginning with what the one before gave, as in an integrator. The unit is one `sin_cos` of arguments uniform in +-pi,
//! measured in the same turns; all are least times of many turns. Bar: [`MOST`] of them for a right-hand side of the reduced bicycle.

#[path = "../runtime/tests/rolling/bicycle.rs"]
#[macro_use]
mod bicycle;

use std::hint::black_box;
use std::time::Instant;

use multibody::multibody;

bicycle!(reduced, {
    formulation { constraints: Reduced, independent: [roll, steer, spin_rear] }
    emit forward_dynamics;
});
bicycle!(multipliers, {
    formulation { constraints: Multipliers }
    emit forward_dynamics;
});

/// Of `sin_cos` for a right-hand side of the reduced bicycle, whatever it begins with.
const MOST: f64 = 40.0;
const STATES: usize = 64;
const TURNS: usize = 4000;

/// SplitMix64, between -1 and 1.
fn draw(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let x = (*seed ^ (*seed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Seconds of one call.
fn time(mut calls: impl FnMut()) -> f64 {
    let start = Instant::now();
    calls();
    start.elapsed().as_secs_f64() / STATES as f64
}

fn main() {
    let mut seed = 1;
    let mut angle = |most: f64| most * draw(&mut seed);
    let angles: [f64; STATES] = std::array::from_fn(|_| angle(std::f64::consts::PI));
    let states: [reduced::State; STATES] = std::array::from_fn(|_| {
        let mut state = reduced::State::default();
        (state.q.yaw, state.q.roll, state.q.steer) = (angle(3.0), angle(0.4), angle(0.6));
        (state.v.roll, state.v.steer, state.v.spin_rear) = (angle(1.0), angle(1.0), -15.0 + angle(5.0));
        state
    });
    let all: [multipliers::State; STATES] = std::array::from_fn(|_| {
        let mut state = multipliers::State::default();
        (state.q.yaw, state.q.roll, state.q.steer) = (angle(3.0), angle(0.4), angle(0.6));
        (state.v.roll, state.v.steer, state.v.spin_rear) = (angle(1.0), angle(1.0), -15.0 + angle(5.0));
        state
    });
    let (few, many) = (reduced::Model::<f64>::default(), multipliers::Model::<f64>::default());
    let (few_input, many_input) = (reduced::Input::default(), multipliers::Input::default());
    let mut least = [f64::INFINITY; 4];
    for _ in 0..TURNS {
        let mut chained = states[0];
        let times = [
            time(|| {
                for &angle in &angles {
                    black_box(black_box(angle).sin_cos());
                }
            }),
            time(|| {
                for state in &states {
                    black_box(few.forward_dynamics(0.0, black_box(state), &few_input));
                }
            }),
            time(|| {
                for _ in 0..STATES {
                    let rate = few.forward_dynamics(0.0, &chained, &few_input);
                    chained.v.roll -= 1e-9 * rate.v.roll;
                    chained.v.steer -= 1e-9 * rate.v.steer;
                }
                black_box(&chained);
            }),
            time(|| {
                for state in &all {
                    black_box(many.forward_dynamics(0.0, black_box(state), &many_input));
                }
            }),
        ];
        least.iter_mut().zip(times).for_each(|(least, time)| *least = least.min(time));
    }
    let [unit, ..] = least;
    println!("one sin_cos takes {:.2} ns", 1e9 * unit);
    let names = [("reduced", true), ("reduced, one after the other", true), ("multipliers", false)];
    for ((name, has_bar), time) in names.iter().zip(&least[1..]) {
        let count = time / unit;
        let verdict = match (has_bar, count <= MOST) {
            (false, _) => String::new(),
            (true, true) => format!(": met, at most {MOST}"),
            (true, false) => format!(": MISSED, at most {MOST}"),
        };
        println!("{name}: {count:.1} sin_cos ({:.1} ns){verdict}", 1e9 * time);
    }
}
