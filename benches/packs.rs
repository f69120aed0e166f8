//! Limbs in packs beside the same limbs one after the other, in one process: `cargo bench -p multibody-benches --bench packs`, and once more
//! with `RUSTFLAGS=-Ctarget-cpu=native`. What is printed is the plain time over the packed one, of least times of many turns.
//!
//! A floating robot on four legs of three hinges each is in packs of four; a floating trunk with a spine and two arms of four hinges in packs of
//! two; both are mirrored, as robots are.

use std::hint::black_box;
use std::time::Instant;

use multibody::nalgebra::{SVector, Vector3};
use multibody::{Configuration, Real, multibody};

macro_rules! robots {
    ($packs:ident) => {
        multibody! {
            mod leg {
                port hip: Frame;
                param side = 1.0;
                /// [N m]
                input torque: [Scalar; 3];
                body shoulder { mass: 0.54, com: [-0.0051, 0.0023 * side, 0.0001], inertia: diag(0.00038, 0.00056, 0.00044) }
                body thigh {
                    mass: 0.634, com: [-0.0035, -0.019 * side, -0.0273],
                    inertia: inertia(0.0044, 0.0047, 0.0008, 0.00001 * side, -0.0002, 0.00007 * side),
                }
                body shin { mass: 0.166, com: [0.0065, 0.0, -0.1074], inertia: diag(0.003, 0.003, 0.00004) }
                joint roll: Revolute { parent: hip, child: shoulder, axis: X }
                joint pitch: Revolute { parent: shoulder.at(0.08 * side * Y), child: thigh, axis: Y }
                joint knee: Revolute { parent: thigh.at(-0.2 * Z), child: shin, axis: Y }
                force roll_motor: Effort { joint: roll, value: torque[0] }
                force pitch_motor: Effort { joint: pitch, value: torque[1] }
                force knee_motor: Effort { joint: knee, value: torque[2] }
            }
            pub mod four_legged {
                const LENGTHWISE: [Scalar; 4] = [0.183, 0.183, -0.183, -0.183];
                const SIDES: [Scalar; 4] = [1.0, -1.0, 1.0, -1.0];
                world { gravity: -9.81 * Z }
                body trunk {
                    mass: 4.713, com: [0.011, 0.002, 0.0005],
                    inertia: inertia(0.0168, 0.063, 0.0717, 0.0001, 0.0002, 0.00003),
                }
                joint float: Free { parent: ground, child: trunk }
                part limbs: [leg; 4] = |i| leg { hip: trunk.at([LENGTHWISE[i], 0.047 * SIDES[i], 0.0]), side: SIDES[i] };
                formulation { packs: $packs }
                emit forward_dynamics, inverse_dynamics, mass_matrix, derivatives;
            }
            mod arm {
                port shoulder: Frame;
                param side = 1.0;
                /// [N m]
                input torque: [Scalar; 4];
                body clavicle {
                    mass: 1.4, com: [-0.01, 0.09 * side, 0.02],
                    inertia: inertia(0.012, 0.005, 0.01, 0.0008 * side, 0.0006, 0.0002 * side),
                }
                body humerus { mass: 1.7, com: [0.02, 0.01 * side, -0.11], inertia: diag(0.023, 0.022, 0.003) }
                body ulna {
                    mass: 1.1, com: [0.01, -0.01 * side, -0.09],
                    inertia: inertia(0.008, 0.009, 0.002, 0.0001 * side, 0.001, -0.0003 * side),
                }
                body hand { mass: 0.6, com: [0.01, 0.0, -0.06], inertia: diag(0.002, 0.0021, 0.0008) }
                joint pitch: Revolute { parent: shoulder, child: clavicle, axis: Y }
                joint roll: Revolute { parent: clavicle.at([0.0, 0.16 * side, 0.0]), child: humerus, axis: X }
                joint elbow: Revolute { parent: humerus.at([0.02, 0.0, -0.27]), child: ulna, axis: Y }
                joint wrist: Revolute { parent: ulna.at([-0.02, 0.0, -0.26]), child: hand, axis: Z }
                force pitch_motor: Effort { joint: pitch, value: torque[0] }
                force roll_motor: Effort { joint: roll, value: torque[1] }
                force elbow_motor: Effort { joint: elbow, value: torque[2] }
                force wrist_motor: Effort { joint: wrist, value: torque[3] }
            }
            pub mod torso {
                const SIDES: [Scalar; 2] = [1.0, -1.0];
                world { gravity: -9.81 * Z }
                body pelvis { mass: 14.2, com: [-0.05, 0.0, 0.02], inertia: diag(0.05, 0.07, 0.06) }
                body lumbar { mass: 2.1, com: [0.01, 0.0, 0.03], inertia: diag(0.006, 0.005, 0.004) }
                body thorax { mass: 2.3, com: [-0.01, 0.0, 0.05], inertia: diag(0.007, 0.006, 0.005) }
                body chest { mass: 16.1, com: [-0.04, 0.0, 0.17], inertia: inertia(0.3, 0.24, 0.18, 0.0, 0.02, 0.0) }
                joint float: Free { parent: ground, child: pelvis }
                joint yaw: Revolute { parent: pelvis.at([-0.03, 0.0, 0.1]), child: lumbar, axis: Z }
                joint roll: Revolute { parent: lumbar.at(0.08 * Z), child: thorax, axis: X }
                joint pitch: Revolute { parent: thorax.at(0.07 * Z), child: chest, axis: Y }
                part limbs: [arm; 2] = |i| arm { shoulder: chest.at([0.0, 0.16 * SIDES[i], 0.24]), side: SIDES[i] };
                formulation { packs: $packs }
                emit forward_dynamics, inverse_dynamics, mass_matrix, derivatives;
            }
        }
    };
}

mod plain {
    use super::multibody;
    robots!(Off);
}
mod packed {
    use super::multibody;
    robots!(Four);
}

const STATES: usize = 16;
const TURNS: usize = 2000;

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

/// Plain and packed, by turns.
macro_rules! compare {
    ($robot:ident, $dof:literal, $scalar:ident) => {{
        macro_rules! states {
            ($module:ident) => {{
                use $module::$robot::{Position, State, Velocity};
                let mut seed = 7;
                let states: [State<$scalar>; STATES] = std::array::from_fn(|_| {
                    let mut vector =
                        |size: f64| SVector::<$scalar, $dof>::from_fn(|_, _| (size * draw(&mut seed)) as $scalar);
                    let mut q = Position::default().displace(&vector(0.8).into());
                    q.float.position = Vector3::zeros();
                    State { q, v: Velocity::from(vector(2.0)) }
                });
                states
            }};
        }
        let (plain, packed) = (plain::$robot::Model::<$scalar>::default(), packed::$robot::Model::<$scalar>::default());
        let (states, same) = (states!(plain), states!(packed));
        let t = <$scalar as Real>::lit(0.0);
        macro_rules! function {
            ($name:literal, |$model:ident, $state:ident, $input:ident| $call:expr) => {{
                let mut least = [f64::INFINITY; 2];
                for _ in 0..TURNS {
                    let times = [
                        time(|| {
                            let ($model, $input) = (&plain, &plain::$robot::Input::<$scalar>::default());
                            for $state in &states {
                                let $state = black_box($state);
                                let _ = ($input, t);
                                black_box($call);
                            }
                        }),
                        time(|| {
                            let ($model, $input) = (&packed, &packed::$robot::Input::<$scalar>::default());
                            for $state in &same {
                                let $state = black_box($state);
                                let _ = ($input, t);
                                black_box($call);
                            }
                        }),
                    ];
                    least.iter_mut().zip(times).for_each(|(least, time)| *least = least.min(time));
                }
                let [plain, packed] = least.map(|seconds| 1e9 * seconds);
                println!(
                    "{}, {}, {}: {:.2} ({plain:.0} ns, {packed:.0} ns in packs)",
                    stringify!($robot),
                    $name,
                    stringify!($scalar),
                    plain / packed
                );
            }};
        }
        function!("forward dynamics", |model, state, input| model.forward_dynamics(t, state, input));
        function!("inverse dynamics", |model, state, input| model.inverse_dynamics(t, state, input, &state.v));
        function!("mass matrix", |model, state, input| model.mass_matrix(&state.q));
        function!("derivatives of forward dynamics", |model, state, input| model.forward_derivatives(t, state, input));
    }};
}

fn main() {
    compare!(four_legged, 18, f64);
    compare!(four_legged, 18, f32);
    compare!(torso, 17, f64);
    compare!(torso, 17, f32);
}
