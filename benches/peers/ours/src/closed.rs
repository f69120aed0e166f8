//! Mechanisms with closed loops: in the coordinates that are independent, and in all of them with multipliers.

use std::ffi::CStr;

use crate::abi::{Subject, subject};
use crate::export::{MULTIPLIERS, PACKS, PROGRAM};
use crate::loops::{
    biped, biped_packed, biped_reduced, delta, delta_reduced, stewart, stewart_packed, stewart_reduced,
};
use crate::samples::{BIPED, Base, Biped, DELTA, Delta, STEWART, Sample, Stewart};
use multibody::nalgebra::SVector;
use multibody::{FreeRollPitchYaw, Pose, RollPitchYaw, Twist};

/// Numbers of a state.
const LENGTHS: [usize; 3] = [25 + 3 * 24, 22 + 3 * 21, 21 + 3 * 20];

/// States of the robot, one behind the other; none of an unknown one.
pub fn states(robot: &CStr) -> Vec<f64> {
    let numbers = |sample: &Sample| sample.numbers();
    match robot.to_bytes() {
        b"stewart" => STEWART.iter().flat_map(|all| numbers(&all.4)).collect(),
        b"delta" => DELTA.iter().flat_map(|all| numbers(&all.4)).collect(),
        b"biped" => BIPED.iter().flat_map(|all| numbers(&all.4)).collect(),
        _ => Vec::new(),
    }
}

/// The accelerations of all coordinates, of which those of the base are `base`'s.
fn accelerations(base: &Base, sample: &Sample) -> Vec<f64> {
    base.sample(&[], &[], Vec::new(), &sample.accel[6..]).accel
}

/// A mechanism with its loops kept as equations.
macro_rules! multipliers {
    ($name:literal, $module:ident, $samples:ident, $sample:ty, $length:expr) => {{
        type Point = ($module::Model<f64>, &'static $sample);
        subject!(
            $name,
            c"forward",
            MULTIPLIERS,
            $length,
            1,
            Point,
            |x| ($module::Model::default(), $samples.iter().find(|all| all.4.is(x)).expect("one of ours")),
            (|(model, all): &Point| model.forward_dynamics(0.0, &all.0, &all.1)),
            // The states themselves hold what this gives.
            (|(_, all): &Point, _, _| all.4.accel.clone()),
        )
    }};
}

/// A mechanism with its loops solved. Of the accelerations of coordinates that follow it says nothing.
macro_rules! reduced {
    ($name:literal, $module:ident, $samples:ident, $sample:ty, $length:expr, $results:expr) => {{
        type Point = ($module::Model<f64>, &'static $sample);
        subject!(
            $name,
            c"forward",
            PROGRAM,
            $length,
            1,
            Point,
            |x| ($module::Model::default(), $samples.iter().find(|all| all.4.is(x)).expect("one of ours")),
            (|(model, all): &Point| model.forward_dynamics(0.0, &all.2, &all.3)),
            (|(_, all): &Point, _, accel: $module::Velocity<f64>| $results(*all, accel)),
        )
    }};
}

fn delta_results(all: &Delta, accel: delta_reduced::Velocity<f64>) -> Vec<f64> {
    let level = |position| FreeRollPitchYaw { position, orientation: RollPitchYaw::default() };
    let base = Base::of_angles(&level(all.2.q.plate), &level(all.2.v.plate), &level(accel.plate));
    accelerations(&base, &all.4)
}

fn biped_results(all: &Biped, pelvis: Twist<f64>, accel: SVector<f64, 16>) -> Vec<f64> {
    let (pose, velocity): (Pose<f64>, Twist<f64>) = (all.2.q.pelvis, all.2.v.pelvis);
    let mut results = accelerations(&Base { pose, velocity, accel: pelvis }, &all.4);
    // Of each leg's seven coordinates the first five are independent.
    for leg in 0..2 {
        results[6 + 7 * leg..][..5].copy_from_slice(&accel.as_slice()[6 + 5 * leg..][..5]);
    }
    results
}

/// The biped alone, with its legs one after the other or in packs.
macro_rules! biped_alone {
    ($program:expr, $module:ident) => {{
        type Point = ($module::Model<f64>, $module::State<f64>, $module::Input<f64>, &'static Biped);
        subject!(
            c"biped",
            c"forward",
            $program,
            LENGTHS[2],
            1,
            Point,
            |x| {
                let all = BIPED.iter().find(|all| all.4.is(x)).expect("one of ours");
                let (mut state, mut input) = ($module::State::default(), $module::Input::default());
                let velocity: SVector<f64, 16> = all.2.v.into();
                (state.q.pelvis, state.v) = (all.2.q.pelvis, velocity.into());
                for (leg, q) in state.q.legs.iter_mut().zip(&all.2.q.legs) {
                    (leg.yaw, leg.roll, leg.pitch, leg.knee, leg.drive) = (q.yaw, q.roll, q.pitch, q.knee, q.drive);
                }
                for (leg, given) in input.legs.iter_mut().zip(&all.3.legs) {
                    leg.torque = given.torque;
                }
                ($module::Model::default(), state, input, all)
            },
            (|(model, state, input, _): &Point| model.forward_dynamics(0.0, state, input)),
            (|(.., all): &Point, _, accel: $module::Velocity<f64>| biped_results(all, accel.pelvis, accel.into())),
        )
    }};
}

/// A state of the platform alone, for a model of it.
macro_rules! platform {
    ($module:ident, $all:expr) => {{
        let (mut state, mut input) = ($module::State::default(), $module::Input::default());
        (state.q.platform, state.v.platform) = ($all.2.q.platform, $all.2.v.platform);
        for (leg, given) in input.legs.iter_mut().zip(&$all.3.legs) {
            leg.thrust = given.thrust;
        }
        (state, input)
    }};
}

/// The platform alone, with its legs one after the other or in packs.
macro_rules! stewart_alone {
    (forward, $program:expr, $module:ident) => {{
        type Point = ($module::Model<f64>, $module::State<f64>, $module::Input<f64>, &'static Stewart);
        subject!(
            c"stewart",
            c"forward",
            $program,
            LENGTHS[0],
            1,
            Point,
            |x| {
                let all = STEWART.iter().find(|all| all.4.is(x)).expect("one of ours");
                let (state, input) = platform!($module, all);
                ($module::Model::default(), state, input, all)
            },
            (|(model, state, input, _): &Point| model.forward_dynamics(0.0, state, input)),
            (|(.., all): &Point, _, accel: $module::Velocity<f64>| {
                let (q, v) = (&all.2.q.platform, &all.2.v.platform);
                accelerations(&Base::of_angles(q, v, &accel.platform), &all.4)
            }),
        )
    }};
    (forces, $program:expr, $module:ident) => {{
        type Point = ($module::Model<f64>, $module::State<f64>, $module::Velocity<f64>, [f64; 6]);
        subject!(
            c"stewart",
            c"leg forces",
            $program,
            LENGTHS[0],
            1,
            Point,
            |x| {
                let all = STEWART.iter().find(|all| all.4.is(x)).expect("one of ours");
                let model = $module::Model::default();
                let (state, input) = platform!($module, all);
                (model, state, model.forward_dynamics(0.0, &state, &input), input.legs.map(|leg| leg.thrust))
            },
            (|(model, state, accel, _): &Point| {
                model.inverse_dynamics(0.0, state, &$module::Input::default(), accel).input
            }),
            // The forces that the accelerations came from.
            (|(.., thrusts): &Point, _, input: $module::Input<f64>| {
                let found = input.legs.map(|leg| leg.thrust);
                let error = found.iter().zip(thrusts).fold(0.0_f64, |error, (x, y)| error.max((x - y).abs()));
                assert!(error <= 1e-10, "leg forces differ by {error:e}");
                found.to_vec()
            }),
        )
    }};
    (strokes, $program:expr, $module:ident) => {{
        type Point = ($module::Model<f64>, $module::State<f64>, $module::Velocity<f64>);
        subject!(
            c"stewart",
            c"strokes, their rates and accelerations",
            $program,
            LENGTHS[0],
            1,
            Point,
            |x| {
                let all = STEWART.iter().find(|all| all.4.is(x)).expect("one of ours");
                let model = $module::Model::default();
                let (state, input) = platform!($module, all);
                (model, state, model.forward_dynamics(0.0, &state, &input))
            },
            (|(model, state, accel): &Point| model.kinematics(0.0, state, accel)),
            (|_, _, found: multibody::Kinematics<f64, 6>| {
                [found.position, found.velocity, found.acceleration].iter().flat_map(|x| x.iter().copied()).collect()
            }),
        )
    }};
}

pub const SUBJECTS: &[Subject] = &[
    stewart_alone!(forward, PROGRAM, stewart_reduced),
    stewart_alone!(forward, PACKS, stewart_packed),
    multipliers!(c"stewart", stewart, STEWART, Stewart, LENGTHS[0]),
    reduced!(c"delta", delta_reduced, DELTA, Delta, LENGTHS[1], delta_results),
    multipliers!(c"delta", delta, DELTA, Delta, LENGTHS[1]),
    biped_alone!(PROGRAM, biped_reduced),
    biped_alone!(PACKS, biped_packed),
    multipliers!(c"biped", biped, BIPED, Biped, LENGTHS[2]),
    stewart_alone!(forces, PROGRAM, stewart_reduced),
    stewart_alone!(forces, PACKS, stewart_packed),
    stewart_alone!(strokes, PROGRAM, stewart_reduced),
    stewart_alone!(strokes, PACKS, stewart_packed),
];
