//! Whipple's bicycle beside one `sin_cos` of the standard library, in one process: `cargo bench --bench rolling`.
//!
//! A right-hand side is a call of `forward_dynamics` at one of many states in turn: states that don't depend on each other, as in a
//! sweep, and each beginning with what the one before gave, as in an integrator. The unit is one `sin_cos` of arguments uniform in +-pi,
//! measured in the same turns; all are least times of many turns.

use std::hint::black_box;
use std::time::Instant;

use multibody::multibody;

/// x ahead, y to the right, z down; parameters are those of a benchmark (Meijaard, Papadopoulos, Ruina, Schwab 2007).
macro_rules! bicycle {
    ($name:ident, $constraints:ident $($independent:tt)*) => {
        multibody! {
            mod $name {
                const BASE = 1.02;
                const TRAIL = 0.08;
                const TILT = PI / 10;
                const REAR = 0.3;
                const FRONT = 0.35;
                world { gravity: 9.81 * Z }
                body ahead { mass: 0 }
                body aside { mass: 0 }
                body below { mass: 0 }
                body headed { mass: 0 }
                body leaning { mass: 0 }
                body frame { mass: 85, com: [0.3, 0, REAR - 0.9], inertia: inertia(9.2, 11, 2.8, 0, 2.4, 0) }
                body rear { mass: 2, inertia: diag(0.0603, 0.12, 0.0603) }
                body fork {
                    mass: 4,
                    com: [0.9 - BASE - TRAIL, 0, -0.7],
                    inertia: inertia(0.05892, 0.06, 0.00708, 0, -0.00756, 0)
                }
                body front { mass: 3, inertia: diag(0.1405, 0.28, 0.1405) }
                joint x: Prismatic { parent: ground, child: ahead, axis: X }
                joint y: Prismatic { parent: ahead, child: aside, axis: Y }
                joint z: Prismatic { parent: aside, child: below, axis: Z }
                joint yaw: Revolute { parent: below, child: headed, axis: Z }
                joint roll: Revolute { parent: headed, child: leaning, axis: X }
                joint pitch: Revolute { parent: leaning, child: frame, axis: Y }
                joint spin_rear: Revolute { parent: frame, child: rear, axis: Y }
                joint steer: Revolute {
                    parent: frame.at([BASE + TRAIL, 0, REAR]),
                    child: fork,
                    axis: [sin(TILT), 0, cos(TILT)]
                }
                joint spin_front: Revolute { parent: fork.at([-TRAIL, 0, -FRONT]), child: front, axis: Y }
                input push;
                force on_roll: Effort { joint: roll, value: push }
                let road = ground.rotated(X, PI);
                constraint rear_wheel: Rolling { wheel: rear, axis: Y, radius: REAR, on: road }
                constraint front_wheel: Rolling { wheel: front, axis: Y, radius: FRONT, on: road }
                formulation { constraints: $constraints $($independent)* }
                emit forward_dynamics;
            }
        }
    };
}

bicycle!(reduced, Reduced, independent: [roll, steer, spin_rear]);
bicycle!(multipliers, Multipliers);

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
    let (push, other) = (reduced::Input { push: 1.0 }, multipliers::Input { push: 1.0 });
    let mut least = [f64::INFINITY; 4];
    for _ in 0..TURNS {
        let mut chained = states[0].clone();
        let times = [
            time(|| angles.iter().for_each(|&angle| drop(black_box(black_box(angle).sin_cos())))),
            time(|| states.iter().for_each(|x| drop(black_box(few.forward_dynamics(0.0, black_box(x), &push))))),
            time(|| {
                for _ in 0..STATES {
                    let rate = few.forward_dynamics(0.0, &chained, &push);
                    chained.v.roll -= 1e-9 * rate.v.roll;
                    chained.v.steer -= 1e-9 * rate.v.steer;
                }
                black_box(&chained);
            }),
            time(|| all.iter().for_each(|x| drop(black_box(many.forward_dynamics(0.0, black_box(x), &other))))),
        ];
        least.iter_mut().zip(times).for_each(|(least, time)| *least = least.min(time));
    }
    let [unit, ..] = least;
    println!("one sin_cos takes {:.2} ns", 1e9 * unit);
    for (name, time) in ["reduced", "reduced, one after the other", "multipliers"].iter().zip(&least[1..]) {
        println!("{name}: {:.1} sin_cos ({:.1} ns)", time / unit, 1e9 * time);
    }
}
