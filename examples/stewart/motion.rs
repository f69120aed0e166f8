//! The diagonal heave: the driven motion of the published task, and its leg forces.

use multibody::FreeRollPitchYaw;
use multibody::nalgebra::Vector3;

use crate::models::{level, reduced};
use crate::svg::Sample;

/// [rad/s]
pub(crate) const FREQUENCY: f64 = 3.0;
/// [s]
pub(crate) const PERIOD: f64 = std::f64::consts::TAU / FREQUENCY;

/// Position, velocity and acceleration of the plate, which stays level.
pub(crate) fn heave(t: f64) -> [Vector3<f64>; 3] {
    let (sin, cos) = (FREQUENCY * t).sin_cos();
    let along = Vector3::new(0.2, 0.2, 0.2);
    [Vector3::new(-1.5, 0.0, 1.0) + along * sin, along * (FREQUENCY * cos), along * (-FREQUENCY * FREQUENCY * sin)]
}

/// The plate at rest in rotation.
pub(crate) fn level_plate(position: Vector3<f64>) -> FreeRollPitchYaw<f64> {
    FreeRollPitchYaw { position, ..FreeRollPitchYaw::default() }
}

/// [N] by the model whose plate is driven level.
pub(crate) fn level_forces(t: f64) -> [f64; 6] {
    let [position, velocity, acceleration] = heave(t);
    let state = level::State { q: level::Position { platform: position }, v: level::Velocity { platform: velocity } };
    let accel = level::Velocity { platform: acceleration };
    let solved = level::Model::<f64>::default().inverse_dynamics(t, &state, &level::Input::default(), &accel);
    solved.input.legs.map(|leg| leg.thrust)
}

/// [N] by the model whose plate may turn, which here it doesn't.
pub(crate) fn free_forces(t: f64) -> [f64; 6] {
    let [position, velocity, acceleration] = heave(t).map(level_plate);
    let state =
        reduced::State { q: reduced::Position { platform: position }, v: reduced::Velocity { platform: velocity } };
    let accel = reduced::Velocity { platform: acceleration };
    let solved = reduced::Model::<f64>::default().inverse_dynamics(t, &state, &reduced::Input::default(), &accel);
    solved.input.legs.map(|leg| leg.thrust)
}

/// What independent equations give at 101 times of one period.
pub(crate) fn reference() -> Vec<Sample> {
    let lines = include_str!("heave_forces.csv").lines().filter(|line| !line.starts_with('#'));
    let samples = lines.filter_map(|line| {
        let numbers: Vec<f64> = line.split(',').filter_map(|number| number.parse().ok()).collect();
        Some((*numbers.first()?, numbers.get(1..)?.try_into().ok()?))
    });
    samples.collect()
}
