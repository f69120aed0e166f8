//! Random states of the mechanisms with loops, their loops closed, and the same in the common coordinates.

use std::sync::LazyLock;

use crate::export::COUNT;
use crate::loops::{biped, biped_reduced, delta, delta_reduced, stewart, stewart_reduced};
use crate::random::Random;
use multibody::nalgebra::{Rotation3, SVector, UnitQuaternion, Vector3};
use multibody::{FreeRollPitchYaw, Pose, Projection, RollPitchYaw, Twist};

/// A state with its accelerations: positions of a floating base are a point and a quaternion, real part last, its
/// velocities and accelerations are spatial vectors in its own axes, linear part first.
pub struct Sample {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub effort: Vec<f64>,
    pub accel: Vec<f64>,
}

impl Sample {
    /// In the order of `subject.h`.
    pub fn numbers(&self) -> Vec<f64> {
        [&self.q[..], &self.v, &self.accel, &self.effort].concat()
    }

    /// Whether these are its numbers: up to rounding, since they may come from another build of this program, with fused
    /// products where this one has none.
    pub fn is(&self, numbers: &[f64]) -> bool {
        let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-8 * (1.0 + a.abs());
        self.numbers().iter().zip(numbers).all(near)
    }
}

/// How a floating base moves: velocities and accelerations of its origin in ground axes, angular ones in its own.
pub struct Base {
    pub pose: Pose,
    pub velocity: Twist,
    pub accel: Twist,
}

impl Base {
    pub fn of_angles(q: &FreeRollPitchYaw, v: &FreeRollPitchYaw, a: &FreeRollPitchYaw) -> Self {
        let RollPitchYaw { roll, pitch, yaw } = q.orientation;
        let ((sr, cr), (sp, cp)) = (roll.sin_cos(), pitch.sin_cos());
        // Columns of the matrix that takes rates to the angular velocity, and their derivatives.
        let along = |w: &RollPitchYaw| {
            Vector3::new(w.roll - w.yaw * sp, w.pitch * cr + w.yaw * cp * sr, w.yaw * cp * cr - w.pitch * sr)
        };
        let w = v.orientation;
        let turning = Vector3::new(
            -w.yaw * cp * w.pitch,
            -w.pitch * sr * w.roll + w.yaw * (cp * cr * w.roll - sp * sr * w.pitch),
            -w.yaw * (sp * cr * w.pitch + cp * sr * w.roll) - w.pitch * cr * w.roll,
        );
        Self {
            pose: Pose { position: q.position, orientation: UnitQuaternion::from_euler_angles(roll, pitch, yaw) },
            velocity: Twist { linear: v.position, angular: along(&w) },
            accel: Twist { linear: a.position, angular: along(&a.orientation) + turning },
        }
    }

    /// Followed by the coordinates of joints, which are the same in all programs.
    pub fn sample(&self, q: &[f64], v: &[f64], effort: Vec<f64>, accel: &[f64]) -> Sample {
        let Pose { position, orientation } = self.pose;
        let own = |x: &Vector3<f64>| orientation.inverse() * x;
        let velocity = own(&self.velocity.linear);
        let linear = own(&self.accel.linear) - self.velocity.angular.cross(&velocity);
        Sample {
            q: [position.as_slice(), orientation.coords.as_slice(), q].concat(),
            v: [velocity.as_slice(), self.velocity.angular.as_slice(), v].concat(),
            effort,
            accel: [linear.as_slice(), self.accel.angular.as_slice(), accel].concat(),
        }
    }
}

/// The states of a mechanism.
fn draw<S>(one: fn(&mut Random) -> S) -> Vec<S> {
    let mut random = Random::new(1);
    (0..COUNT).map(|_| one(&mut random)).collect()
}

/// What a reduced model says differs from the accelerations of all coordinates by rounding.
fn assert_same(name: &str, reduced: &[f64], full: &[f64]) {
    assert_eq!(reduced.len(), full.len(), "{name}");
    let size = full.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let error = reduced.iter().zip(full).fold(0.0_f64, |error, (x, y)| error.max((x - y).abs()));
    assert!(error <= 1e-9 * size, "{name}: accelerations of {size:e} differ by {error:e}");
}

fn vector(random: &mut Random, size: f64) -> Vector3<f64> {
    size * Vector3::from(random.units::<3>())
}

fn angles(v: Vector3<f64>) -> RollPitchYaw {
    RollPitchYaw { roll: v.x, pitch: v.y, yaw: v.z }
}

/// Efforts of all coordinates, of which the given ones are driven.
fn efforts(count: usize, driven: impl Iterator<Item = (usize, f64)>) -> Vec<f64> {
    let mut all = vec![0.0; count];
    driven.for_each(|(at, value)| all[at] = value);
    all
}

const FEET: [[f64; 2]; 6] =
    [[-2.12, 1.374], [-2.38, 1.224], [-2.38, -1.224], [-2.12, -1.374], [0.0, -0.15], [0.0, 0.15]];
const PINS: [[f64; 2]; 6] = [[0.17, 0.595], [-0.6, 0.15], [-0.6, -0.15], [0.17, -0.595], [0.43, -0.445], [0.43, 0.445]];
const HEADING: [f64; 6] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85];

/// A state, and what of it the reduced model takes.
pub type Stewart = (stewart::State, stewart::Input, stewart_reduced::State, stewart_reduced::Input, Sample);

pub static STEWART: LazyLock<Vec<Stewart>> = LazyLock::new(|| draw(stewart));

fn stewart(random: &mut Random) -> Stewart {
    let model = stewart::Model::default();
    let mut state = stewart::State::default();
    let orientation = vector(random, 0.25);
    let position = Vector3::new(-1.5, 0.0, 1.0) + vector(random, 0.2);
    state.q.platform = FreeRollPitchYaw { position, orientation: angles(orientation) };
    state.v.platform = FreeRollPitchYaw { position: vector(random, 0.6), orientation: angles(vector(random, 0.6)) };
    let turned = Rotation3::from_euler_angles(orientation.x, orientation.y, orientation.z);
    for (i, leg) in state.q.legs.iter_mut().enumerate() {
        let pin = position + turned * Vector3::new(PINS[i][0], PINS[i][1], -0.4);
        let way = pin - Vector3::new(FEET[i][0], FEET[i][1], 0.0);
        let way = Rotation3::from_axis_angle(&Vector3::z_axis(), -HEADING[i]) * way;
        leg.gimbal.first = (-way.y).atan2(way.z);
        leg.gimbal.second = (way.x / way.norm()).asin();
        leg.stroke = way.norm() - 1.0;
    }
    let state = Projection::default().project(&model, 0.0, &state).expect("legs reach").state;
    let thrusts: [f64; 6] = random.units().map(|x| 10.0 * x);
    let mut input = stewart::Input::default();
    let mut reduced_input = stewart_reduced::Input::default();
    for (i, thrust) in thrusts.into_iter().enumerate() {
        (input.legs[i].thrust, reduced_input.legs[i].thrust) = (thrust, thrust);
    }
    let a = model.forward_dynamics(0.0, &state, &input).v;
    let effort = efforts(24, thrusts.into_iter().enumerate().map(|(i, thrust)| (8 + 3 * i, thrust)));
    let base = Base::of_angles(&state.q.platform, &state.v.platform, &a.platform);
    let (q, v, a) = (flat::<24>(state.q), flat::<24>(state.v), flat::<24>(a));
    let mut reduced = stewart_reduced::State::default();
    (reduced.q.platform, reduced.v.platform) = (state.q.platform, state.v.platform);
    let alone = stewart_reduced::Model::default().forward_dynamics(0.0, &reduced, &reduced_input);
    assert_same("Stewart platform", &flat::<6>(alone), &a[..6]);
    let sample = base.sample(&q[6..], &v[6..], effort, &a[6..]);
    (state, input, reduced, reduced_input, sample)
}

pub type Delta = (delta::State, delta::Input, delta_reduced::State, delta_reduced::Input, Sample);

pub static DELTA: LazyLock<Vec<Delta>> = LazyLock::new(|| draw(delta));

fn delta(random: &mut Random) -> Delta {
    let model = delta::Model::default();
    let mut state = delta::State::default();
    let position = Vector3::new(0.0, 0.0, -0.7) + vector(random, 0.1);
    state.q.plate.position = position;
    state.v.plate.position = vector(random, 0.6);
    for (i, limb) in state.q.limbs.iter_mut().enumerate() {
        let heading = Rotation3::from_axis_angle(&Vector3::z_axis(), -(i as f64) * std::f64::consts::TAU / 3.0);
        // From the hip to the middle of the plate's pins; the arm's tip is one rod's length away from it.
        let pin = heading * position + Vector3::new(0.05 - 0.2, 0.0, 0.0);
        let share = (pin.norm_squared() + 0.09 - 0.64) / 0.6 / pin.x.hypot(pin.z);
        limb.shoulder = (-pin.z).atan2(pin.x) - share.acos();
        let arm = Rotation3::from_axis_angle(&Vector3::y_axis(), limb.shoulder);
        let rod = (arm.inverse() * pin - Vector3::new(0.3, 0.0, 0.0)) / 0.8;
        limb.elbow_a.first = (-rod.z).atan2(rod.x);
        limb.elbow_a.second = rod.y.asin();
        limb.elbow_b = limb.elbow_a;
    }
    let state = Projection::default().project(&model, 0.0, &state).expect("arms reach").state;
    let torques: [f64; 3] = random.units();
    let mut input = delta::Input::default();
    let mut reduced_input = delta_reduced::Input::default();
    for (i, torque) in torques.into_iter().enumerate() {
        (input.limbs[i].torque, reduced_input.limbs[i].torque) = (torque, torque);
    }
    let a = model.forward_dynamics(0.0, &state, &input).v;
    let effort = efforts(21, torques.into_iter().enumerate().map(|(i, torque)| (6 + 5 * i, torque)));
    let base = Base::of_angles(&state.q.plate, &state.v.plate, &a.plate);
    let (q, v, a) = (flat::<21>(state.q), flat::<21>(state.v), flat::<21>(a));
    let mut reduced = delta_reduced::State::default();
    (reduced.q.plate, reduced.v.plate) = (state.q.plate.position, state.v.plate.position);
    let alone = delta_reduced::Model::default().forward_dynamics(0.0, &reduced, &reduced_input);
    assert_same("Delta robot", &flat::<3>(alone), &a[..3]);
    let sample = base.sample(&q[6..], &v[6..], effort, &a[6..]);
    (state, input, reduced, reduced_input, sample)
}

pub type Biped = (biped::State, biped::Input, biped_reduced::State, biped_reduced::Input, Sample);

pub static BIPED: LazyLock<Vec<Biped>> = LazyLock::new(|| draw(biped));

fn biped(random: &mut Random) -> Biped {
    let model = biped::Model::default();
    let mut state = biped::State::default();
    state.q.pelvis =
        Pose { position: vector(random, 1.0), orientation: UnitQuaternion::from_scaled_axis(vector(random, 1.5)) };
    state.v.pelvis = Twist { linear: vector(random, 1.0), angular: vector(random, 1.0) };
    for (q, v) in state.q.legs.iter_mut().zip(&mut state.v.legs) {
        [q.yaw, q.roll, q.pitch] = random.units().map(|x| 0.6 * x);
        q.knee = 0.6 + 0.6 * random.unit();
        q.drive = 0.5 * random.unit();
        (q.hinge, q.ankle) = (-q.drive, q.drive);
        [v.yaw, v.roll, v.pitch, v.knee, v.drive] = random.units().map(|x| 2.0 * x);
    }
    let state = Projection::default().project(&model, 0.0, &state).expect("linkages close").state;
    let mut input = biped::Input::default();
    let mut reduced_input = biped_reduced::Input::default();
    let mut reduced = biped_reduced::State::default();
    (reduced.q.pelvis, reduced.v.pelvis) = (state.q.pelvis, state.v.pelvis);
    for i in 0..2 {
        input.legs[i].torque = random.units().map(|x| 20.0 * x);
        reduced_input.legs[i].torque = input.legs[i].torque;
        let (q, v) = (&state.q.legs[i], &state.v.legs[i]);
        let (p, w) = (&mut reduced.q.legs[i], &mut reduced.v.legs[i]);
        (p.yaw, p.roll, p.pitch, p.knee, p.drive) = (q.yaw, q.roll, q.pitch, q.knee, q.drive);
        (w.yaw, w.roll, w.pitch, w.knee, w.drive) = (v.yaw, v.roll, v.pitch, v.knee, v.drive);
    }
    let a = model.forward_dynamics(0.0, &state, &input).v;
    let driven = (0..2).flat_map(|i| (0..5).map(move |k| (i, k)));
    let effort = efforts(20, driven.map(|(i, k)| (6 + 7 * i + k, input.legs[i].torque[k])));
    let base = Base { pose: state.q.pelvis, velocity: state.v.pelvis, accel: a.pelvis };
    let (q, v, a) = (flat::<21>(state.q), flat::<20>(state.v), flat::<20>(a));
    let alone = biped_reduced::Model::default().forward_dynamics(0.0, &reduced, &reduced_input);
    assert_same("biped", &flat::<16>(alone), &[&a[..11], &a[13..18]].concat());
    let sample = base.sample(&q[7..], &v[6..], effort, &a[6..]);
    (state, input, reduced, reduced_input, sample)
}

/// All coordinates in their order.
fn flat<const N: usize>(coordinates: impl Into<SVector<f64, N>>) -> Vec<f64> {
    coordinates.into().as_slice().to_vec()
}
