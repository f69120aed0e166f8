//! Assembly modes of parallel robots: against the pose that legs were measured in, against the distances themselves, and against
//! what Newton's method finds from random guesses.

use std::f64::consts::PI;

use multibody::AssemblyMode;
use multibody::nalgebra::{DMatrix, DVector, Rotation2, Rotation3, Unit, Vector2, Vector3};
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody_tests::models::assembled::*;
use multibody_tests::support::random::Random;
use num_dual::Dual64;

/// A body held by distances, three of them in a plane or six.
struct Held {
    base: Vec<Vector3<f64>>,
    body: Vec<Vector3<f64>>,
    lengths: Vec<f64>,
    is_planar: bool,
}

/// `x, y, angle` or `x, y, z, roll, pitch, yaw`
fn moved(pose: &[f64], point: &Vector3<f64>) -> Vector3<f64> {
    match *pose {
        [x, y, angle] => {
            let turned = Rotation2::new(angle) * Vector2::new(point.x, point.y);
            Vector3::new(x + turned.x, y + turned.y, point.z)
        }
        [x, y, z, roll, pitch, yaw] => Rotation3::from_euler_angles(roll, pitch, yaw) * point + Vector3::new(x, y, z),
        _ => panic!("a pose"),
    }
}

impl Held {
    fn errors(&self, pose: &[f64]) -> Vec<f64> {
        let ends = self.base.iter().zip(&self.body).zip(&self.lengths);
        ends.map(|((a, b), length)| (moved(pose, b) - a).norm_squared() - length * length).collect()
    }

    /// The same pose, in other angles perhaps.
    fn apart(&self, one: &[f64], other: &[f64]) -> f64 {
        let points = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
        points.iter().map(|point| (moved(one, point) - moved(other, point)).norm()).fold(0.0, f64::max)
    }

    /// Newton's method from a guess, where it converges.
    fn near(&self, guess: &[f64]) -> Option<Vec<f64>> {
        let mut pose = guess.to_vec();
        let size = pose.len();
        for _ in 0..40 {
            let errors = DVector::from_vec(self.errors(&pose));
            let slopes = DMatrix::from_fn(size, size, |row, column| {
                let at = |h: f64| {
                    let mut moved = pose.clone();
                    moved[column] += h;
                    self.errors(&moved)[row]
                };
                (at(1e-6) - at(-1e-6)) / 2e-6
            });
            let step = slopes.lu().solve(&errors)?;
            pose.iter_mut().zip(step.iter()).for_each(|(x, step)| *x -= step.clamp(-1.0, 1.0));
        }
        let converged = self.errors(&pose).iter().all(|error| error.abs() < 1e-11);
        converged.then_some(pose)
    }
}

/// What was found out about the modes of one robot.
#[derive(Debug, Default)]
struct Tally {
    poses: usize,
    /// Worst distance between a pose and its mode, and worst error of a distance's square.
    missed: Vec<f64>,
    error: f64,
    most: usize,
    guessed: usize,
}

impl Tally {
    /// The modes must hold the pose, the distances, and what Newton's method finds.
    fn take<const N: usize>(
        &mut self,
        held: &Held,
        pose: &[f64],
        modes: &[AssemblyMode<f64, N>],
        guesses: usize,
        random: &mut Random,
    ) {
        let size = pose.len();
        let real: Vec<&[f64]> = modes
            .iter()
            .filter(|mode| mode.residual.is_finite())
            .map(|mode| &mode.position.as_slice()[..size])
            .collect();
        assert!(real.iter().flat_map(|mode| mode.iter()).all(|x| x.is_finite()));
        let nearest = |pose: &[f64]| real.iter().map(|mode| held.apart(mode, pose)).fold(f64::MAX, f64::min);
        self.poses += 1;
        self.missed.push(nearest(pose));
        self.most = self.most.max(real.len());
        if !held.is_planar {
            assert!(real.iter().all(|mode| mode[4].abs() <= 0.5 * PI), "pitches {real:?}");
        }
        for (mode, found) in modes.iter().filter(|mode| mode.residual.is_finite()).zip(&real) {
            let errors = held.errors(found);
            let error = errors.iter().fold(0.0_f64, |worst, error| worst.max(error.abs()));
            self.error = self.error.max(error);
            assert!(error < 1e3 * (mode.residual + 1e-15), "{error:e}, and {:e} is told", mode.residual);
        }
        for _ in 0..guesses {
            let guess: Vec<f64> = pose
                .iter()
                .enumerate()
                .map(|(k, x)| {
                    let turns = if held.is_planar { k == 2 } else { k > 2 };
                    if turns { PI * random.unit() } else { x + 2.0 * random.unit() }
                })
                .collect();
            if let Some(other) = held.near(&guess) {
                self.guessed += 1;
                assert!(nearest(&other) < 1e-4, "{other:?} is not among {real:?}");
            }
        }
    }

    fn judge(&mut self, name: &str) {
        self.missed.sort_by(f64::total_cmp);
        let worst = self.missed.last().copied().unwrap_or(f64::MAX);
        let median = self.missed[self.missed.len() / 2];
        println!(
            "{name}: {} poses, off by {median:e} (median) and {worst:e}, squares by {:e}, {} modes at most, {} guesses found again",
            self.poses, self.error, self.most, self.guessed
        );
        assert!(median < 5e-14 && worst < 1e-9, "{name}: {worst:e}");
        assert!(self.guessed > 20, "{name}");
    }
}

fn spatial(random: &mut Random, centre: [f64; 3]) -> Vec<f64> {
    let place = centre.map(|x| x + 0.5 * random.unit());
    let turns: [f64; 3] = [PI, 1.5, PI].map(|size| size * random.unit());
    [place, turns].concat()
}

macro_rules! on_struts {
    ($name:ident, $model:ident, $base:expr, $body:expr) => {
        #[test]
        fn $name() {
            let (mut random, mut tally) = (Random::new(11), Tally::default());
            for number in 0..150 {
                let mut params = $model::Params::default();
                for point in params.FEET.iter_mut().chain(&mut params.PINS) {
                    *point += 0.1 * Vector3::from(random.units());
                }
                let model = $model::Model::new(&params);
                let pose = spatial(&mut random, [-1.2, 0.0, 1.5]);
                let base: Vec<Vector3<f64>> = $base.map(|k: usize| params.FEET[k]).to_vec();
                let body: Vec<Vector3<f64>> = $body.map(|k: usize| params.PINS[k]).to_vec();
                let lengths: Vec<f64> = base.iter().zip(&body).map(|(a, b)| (moved(&pose, b) - a).norm()).collect();
                let mut q = $model::Position::<f64>::default();
                q.legs.iter_mut().zip(&lengths).for_each(|(leg, length)| leg.stroke = length - 0.9);
                let modes = model.assembly_modes(0.0, &q);
                let held = Held { base, body, lengths, is_planar: false };
                tally.take(&held, &pose, &modes, if number < 12 { 60 } else { 0 }, &mut random);
            }
            tally.judge(stringify!($model));
        }
    };
}

on_struts!(two_legs_at_each_of_three_points, six_three, [0, 1, 2, 3, 4, 5], [0, 0, 1, 1, 2, 2]);
on_struts!(two_legs_from_each_of_three_points, three_six, [0, 0, 1, 1, 2, 2], [0, 1, 2, 3, 4, 5]);
on_struts!(an_octahedron, octahedron, [0, 1, 1, 2, 2, 0], [0, 0, 1, 1, 2, 2]);
on_struts!(three_legs_at_one_point, three_one, [0, 1, 2, 3, 4, 5], [0, 1, 0, 2, 0, 3]);
on_struts!(three_points_in_turn, three_two_one, [0, 1, 2, 3, 4, 5], [0, 1, 0, 2, 0, 1]);

/// Gimbals go along, so that the whole state stands where the mode is.
#[test]
fn legs_follow_their_mode() {
    let model = six_three::Model::<f64>::default();
    let mut random = Random::new(5);
    let mut seen = 0;
    for _ in 0..20 {
        let pose = spatial(&mut random, [-1.2, 0.0, 1.5]);
        let mut state = six_three::State::<f64>::default();
        state.q.plate.position = [pose[0], pose[1], pose[2]].into();
        (state.q.plate.orientation.roll, state.q.plate.orientation.pitch, state.q.plate.orientation.yaw) =
            (pose[3], pose[4], pose[5]);
        let legs = model.kinematics(0.0, &state, &six_three::Velocity::default());
        state.q.legs.iter_mut().zip(legs.position.iter()).for_each(|(leg, stroke)| leg.stroke = *stroke);
        for mode in model.assembly_modes(0.0, &state.q).iter().filter(|mode| mode.residual < 1e-10) {
            let mut q = state.q;
            let x = mode.position.as_slice();
            q.plate.position = [x[0], x[1], x[2]].into();
            (q.plate.orientation.roll, q.plate.orientation.pitch, q.plate.orientation.yaw) = (x[3], x[4], x[5]);
            for (leg, gimbal) in q.legs.iter_mut().zip(x[6..].chunks(2)) {
                (leg.gimbal.first, leg.gimbal.second) = (gimbal[0], gimbal[1]);
            }
            // All equations of all loops, as they are derived for multipliers.
            let open = model.constraints(0.0, &q).amax();
            assert!(open < 1e-9, "{open:e}, {:e} is told", mode.residual);
            seen += 1;
        }
    }
    println!("{seen} modes");
    assert!(seen > 40);
}

/// A stroke behind its gimbal is one that the legs' formulas don't give: the pose is one, and angles for it are not made up.
#[test]
fn legs_on_another_branch() {
    let model = six_three::Model::<f64>::default();
    let mut state = six_three::State::<f64>::default();
    state.q.plate.position = [-1.2, 0.1, 1.6].into();
    let legs = model.kinematics(0.0, &state, &six_three::Velocity::default());
    state.q.legs.iter_mut().zip(legs.position.iter()).for_each(|(leg, stroke)| leg.stroke = *stroke);
    let count =
        |q: &six_three::Position| model.assembly_modes(0.0, q).iter().filter(|mode| mode.residual.is_finite()).count();
    assert!(count(&state.q) > 0);
    state.q.legs[2].stroke = -1.8 - state.q.legs[2].stroke;
    assert_eq!(count(&state.q), 0);

    let model = three_two_one::Model::<f64>::default();
    let mut state = three_two_one::State::<f64>::default();
    state.q.plate.position = [-1.2, 0.1, 1.6].into();
    let legs = model.kinematics(0.0, &state, &three_two_one::Velocity::default());
    state.q.legs.iter_mut().zip(legs.position.iter()).for_each(|(leg, stroke)| leg.stroke = *stroke);
    let count = |q: &three_two_one::Position| {
        model.assembly_modes(0.0, q).iter().filter(|mode| mode.residual.is_finite()).count()
    };
    assert!(count(&state.q) > 0);
    state.q.legs[2].stroke = -1.8 - state.q.legs[2].stroke;
    assert_eq!(count(&state.q), 0);
}

#[test]
fn rods_from_rails() {
    const FEET: [[f64; 3]; 6] = [
        [1.1, 0.2, -0.9],
        [-0.7, 1.2, -0.8],
        [-0.6, -1.1, -1.1],
        [0.1, 0.3, -1.2],
        [0.8, -0.7, -0.7],
        [-0.4, 0.5, -1.3],
    ];
    const AXES: [[f64; 3]; 6] =
        [[1.0, 2.0, 0.3], [-0.4, 1.0, 0.2], [0.7, 0.1, 1.0], [1.0, 1.0, 1.0], [0.2, -0.3, 1.0], [-0.1, 0.6, 0.9]];
    let (mut random, mut tally) = (Random::new(12), Tally::default());
    while tally.poses < 150 {
        let mut params = rails::Params::default();
        params.HUB += 0.1 * Vector3::from(random.units());
        params.ENDS.iter_mut().for_each(|end| *end += 0.1 * Vector3::from(random.units()));
        params.slides.iter_mut().for_each(|slide| slide.length += 0.1 * random.unit());
        let pose = spatial(&mut random, [0.1, 0.1, 0.2]);
        let body = [params.HUB, params.ENDS[0], params.HUB, params.HUB, params.ENDS[1], params.ENDS[2]];
        let lengths: Vec<f64> = params.slides.iter().map(|slide| slide.length).collect();
        let mut q = rails::Position::<f64>::default();
        let mut base = Vec::new();
        for i in 0..6 {
            let turn = Rotation3::from_axis_angle(&Unit::new_normalize(AXES[i].into()), 0.3 - 0.1 * i as f64);
            let (along, from) = (turn * Vector3::new(0.3, -0.2, 1.0).normalize(), turn * Vector3::new(0.1, 0.0, 0.0));
            let way = Vector3::from(FEET[i]) + from - moved(&pose, &body[i]);
            let half = way.dot(&along);
            let travel = (half * half - way.norm_squared() + lengths[i] * lengths[i]).sqrt() - half;
            q.slides[i].rail = travel;
            base.push(Vector3::from(FEET[i]) + from + along * travel);
        }
        if q.slides.iter().any(|slide| slide.rail.is_nan()) {
            continue;
        }
        let modes = rails::Model::new(&params).assembly_modes(0.0, &q);
        let held = Held { base, body: body.to_vec(), lengths, is_planar: false };
        tally.take(&held, &pose, &modes, if tally.poses < 12 { 60 } else { 0 }, &mut random);
    }
    tally.judge("rails");
}

#[test]
fn arms_in_an_oblique_plane() {
    let (mut random, mut tally) = (Random::new(13), Tally::default());
    while tally.poses < 300 {
        let mut params = three_arms::Params::default();
        for point in params.FEET.iter_mut().chain(&mut params.PINS) {
            *point += 0.05 * Vector3::new(random.unit(), random.unit(), 0.0);
        }
        let flat = params;
        // Hinges say nothing of places along their axes.
        params.FEET.iter_mut().chain(&mut params.PINS).for_each(|point| point.z += 0.3 * random.unit());
        params.arms.iter_mut().for_each(|arm| arm.upper_length += 0.1 * random.unit());
        // From the joint's frame, which stands before the feet.
        let pose = [0.1 + 0.4 * random.unit(), 0.4 + 0.4 * random.unit(), PI * random.unit()];
        let shift = Vector3::new(0.4, 0.0, 0.0);
        let mut q = three_arms::Position::<f64>::default();
        let mut base = Vec::new();
        for i in 0..3 {
            let arm = &params.arms[i];
            let way = moved(&pose, &flat.PINS[i]) + shift - flat.FEET[i];
            let far = way.norm();
            let cos = (far * far + arm.upper_length * arm.upper_length - arm.lower_length * arm.lower_length)
                / (2.0 * far * arm.upper_length);
            let crank = way.y.atan2(way.x) + if random.unit() > 0.0 { cos.acos() } else { -cos.acos() };
            q.arms[i].crank = crank;
            base.push(flat.FEET[i] - shift + arm.upper_length * Vector3::new(crank.cos(), crank.sin(), 0.0));
        }
        if q.arms.iter().any(|arm| arm.crank.is_nan()) {
            continue;
        }
        let modes = three_arms::Model::new(&params).assembly_modes(0.0, &q);
        let lengths = params.arms.iter().map(|arm| arm.lower_length).collect();
        let held = Held { base, body: flat.PINS.to_vec(), lengths, is_planar: true };
        tally.take(&held, &pose, &modes, if tally.poses < 20 { 60 } else { 0 }, &mut random);
    }
    tally.judge("three_arms");
}

macro_rules! in_a_plane {
    ($name:ident, $model:ident, $base:expr, $body:expr) => {
        #[test]
        fn $name() {
            let (mut random, mut tally) = (Random::new(14), Tally::default());
            for number in 0..300 {
                let mut params = $model::Params::default();
                for point in params.FEET.iter_mut().chain(&mut params.PINS) {
                    *point += 0.05 * Vector3::new(random.unit(), random.unit(), 0.0);
                }
                let pose = [0.5 + random.unit(), 0.4 + random.unit(), PI * random.unit()];
                let base: Vec<Vector3<f64>> = $base.map(|k: usize| params.FEET[k]).to_vec();
                let body: Vec<Vector3<f64>> = $body.map(|k: usize| params.PINS[k]).to_vec();
                let lengths: Vec<f64> = base.iter().zip(&body).map(|(a, b)| (moved(&pose, b) - a).norm()).collect();
                let mut q = $model::Position::<f64>::default();
                q.struts.iter_mut().zip(&lengths).for_each(|(strut, length)| strut.stroke = length - 0.5);
                let modes = $model::Model::new(&params).assembly_modes(0.0, &q);
                assert_eq!(modes.len(), 4, "circles that meet");
                let held = Held { base, body, lengths, is_planar: true };
                tally.take(&held, &pose, &modes, if number < 20 { 60 } else { 0 }, &mut random);
            }
            tally.judge(stringify!($model));
        }
    };
}

in_a_plane!(two_struts_at_one_pin, planar_pair, [0, 1, 2], [0, 1, 0]);
in_a_plane!(two_struts_from_one_foot, planar_foot, [0, 1, 0], [0, 1, 2]);

/// The corners of a triangle.
fn corners(size: f64) -> [Vector3<f64>; 3] {
    let half = 0.5 * 3.0_f64.sqrt();
    [[1.0, 0.0], [-0.5, half], [-0.5, -half]].map(|[x, y]| size * Vector3::new(x, y, 0.0))
}

/// Equal legs of a symmetric robot: modes that are mirror images of each other have the same point on a circle.
#[test]
fn symmetric_platforms() {
    let (mut random, mut tally, mut hub) = (Random::new(15), Tally::default(), Tally::default());
    let feet = corners(1.0);
    for length in [0.9, 1.0, 1.1, 1.3, 1.7, 2.5] {
        let pins = corners(-0.6);
        let body = [2, 1, 2, 0, 0, 1].map(|k| pins[k]).to_vec();
        let base: Vec<Vector3<f64>> = [0, 0, 1, 1, 2, 2].map(|k: usize| feet[k]).to_vec();
        let height = (length * length - (base[0] - body[0]).norm_squared()).sqrt();
        let mut q = symmetric_octahedron::Position::<f64>::default();
        q.legs.iter_mut().for_each(|leg| leg.stroke = length - 0.9);
        let modes = symmetric_octahedron::Model::<f64>::default().assembly_modes(0.0, &q);
        let held = Held { base, body, lengths: vec![length; 6], is_planar: false };
        tally.take(&held, &[0.0, 0.0, height, 0.0, 0.0, 0.0], &modes, 100, &mut random);

        let base = (0..6).map(|k| if k % 2 == 0 { 0.8 } else { 1.0 } * feet[k / 2]).collect();
        let ends = corners(0.5);
        let body = (0..6).map(|k| if k % 2 == 0 { Vector3::zeros() } else { ends[k / 2] }).collect();
        let mut q = symmetric_hub::Position::<f64>::default();
        let lengths: Vec<f64> =
            (0..6).map(|k| if k % 2 == 0 { length } else { (length * length - 0.39).sqrt() }).collect();
        q.legs.iter_mut().zip(&lengths).for_each(|(leg, length)| leg.stroke = length - 0.9);
        let modes = symmetric_hub::Model::<f64>::default().assembly_modes(0.0, &q);
        let height = (length * length - 0.64).sqrt();
        let held = Held { base, body, lengths, is_planar: false };
        hub.take(&held, &[0.0, 0.0, height, 0.0, 0.0, 0.0], &modes, 100, &mut random);
    }
    println!("{tally:?}, {hub:?}");
    // Where modes have a root in common, or meet, half of the digits are left.
    for tally in [tally, hub] {
        assert!(tally.missed.iter().all(|&missed| missed < 1e-6) && tally.guessed > 100, "{tally:?}");
    }
}

#[test]
fn symmetric_arms_in_a_plane() {
    let (mut random, mut tally) = (Random::new(16), Tally::default());
    let feet = corners(1.0);
    for k in 0..24 {
        let crank = -PI + PI / 12.0 * f64::from(k);
        let mut q = symmetric_arms::Position::<f64>::default();
        let base: Vec<Vector3<f64>> = feet
            .iter()
            .enumerate()
            .map(|(i, foot)| {
                // The same in the axes of each foot.
                let angle = crank + 2.0 / 3.0 * PI * i as f64;
                q.arms[i].crank = angle;
                foot + 0.55 * Vector3::new(angle.cos(), angle.sin(), 0.0)
            })
            .collect();
        let held = Held { base, body: corners(0.3).to_vec(), lengths: vec![0.62; 3], is_planar: true };
        let Some(pose) = (0..200).find_map(|_| held.near(&[random.unit(), random.unit(), PI * random.unit()])) else {
            continue;
        };
        let modes = symmetric_arms::Model::<f64>::default().assembly_modes(0.0, &q);
        tally.take(&held, &pose, &modes, 100, &mut random);
    }
    println!("{tally:?}");
    assert!(tally.poses > 8 && tally.guessed > 50 && tally.missed.iter().all(|&missed| missed < 1e-6), "{tally:?}");
}

/// Lanes, single precision, and derivatives by what is given.
#[test]
fn in_other_scalars() {
    let params = three_arms::Params::<f64>::default();
    let cranks = [0.9, 2.4, -1.9];
    let place = |cranks: [f64; 3]| {
        let mut q = three_arms::Position::<f64>::default();
        q.arms.iter_mut().zip(cranks).for_each(|(arm, crank)| arm.crank = crank);
        three_arms::Model::new(&params).assembly_modes(0.0, &q)
    };
    let plain = place(cranks);
    let real = plain.iter().filter(|mode| mode.residual.is_finite()).count();
    assert!(real >= 2, "{plain:?}");

    let mut q = three_arms::Position::<WideF64x4>::default();
    let shifts = [0.0, 0.05, -0.1, 0.2];
    for (arm, crank) in q.arms.iter_mut().zip(cranks) {
        arm.crank = WideF64x4::from(shifts.map(|shift| crank + shift));
    }
    let lanes = three_arms::Model::<WideF64x4>::default().assembly_modes(WideF64x4::splat(0.0), &q);
    for (lane, shift) in shifts.into_iter().enumerate() {
        for (found, mode) in lanes.iter().zip(place(cranks.map(|crank| crank + shift))) {
            assert_eq!(found.residual.extract(lane).is_finite(), mode.residual.is_finite());
            for (x, y) in found.position.iter().zip(&mode.position) {
                let x = x.extract(lane);
                assert!(x.is_nan() && y.is_nan() || (x - y).abs() < 1e-11, "{x} {y}");
            }
        }
    }

    let mut q = three_arms::Position::<f32>::default();
    q.arms.iter_mut().zip(cranks).for_each(|(arm, crank)| arm.crank = crank as f32);
    let single = three_arms::Model::<f32>::default().assembly_modes(0.0, &q);
    let nearest = |mode: &AssemblyMode<f64, 3>| {
        let apart = |other: &AssemblyMode<f32, 3>| {
            let other: Vec<f64> = other.position.iter().map(|&x| f64::from(x)).collect();
            other.iter().zip(&mode.position).fold(0.0, |worst: f64, (x, y)| worst.max((x - y).abs()))
        };
        single.iter().filter(|mode| mode.residual.is_finite()).map(apart).fold(f64::MAX, f64::min)
    };
    assert!(plain.iter().filter(|mode| mode.residual.is_finite()).all(|mode| nearest(mode) < 1e-4));

    let mut q = three_arms::Position::<Dual64>::default();
    q.arms.iter_mut().zip(cranks).for_each(|(arm, crank)| arm.crank = crank.into());
    q.arms[1].crank.eps = 1.0;
    let dual = three_arms::Model::<Dual64>::default().assembly_modes(Dual64::from(0.0), &q);
    let h = 1e-6;
    let [before, after] = [-h, h].map(|h| place([cranks[0], cranks[1] + h, cranks[2]]));
    for ((mode, before), after) in dual.iter().zip(&before).zip(&after) {
        for ((x, y), z) in mode.position.iter().zip(&before.position).zip(&after.position) {
            let slope = (z - y) / (2.0 * h);
            assert!(
                slope.is_nan() && x.re.is_nan() || (x.eps - slope).abs() < 1e-6 * (1.0 + slope.abs()),
                "{x} {slope}"
            );
        }
    }
}

/// Where nothing reaches, and where nothing is a number, no mode is real.
#[test]
fn out_of_reach() {
    let mut q = octahedron::Position::<f64>::default();
    q.legs.iter_mut().for_each(|leg| leg.stroke = -0.85);
    let none = octahedron::Model::<f64>::default().assembly_modes(0.0, &q);
    assert!(none.iter().all(|mode| mode.residual.is_nan()), "{none:?}");
    q.legs[2].stroke = f64::NAN;
    let none = octahedron::Model::<f64>::default().assembly_modes(0.0, &q);
    assert!(none.iter().all(|mode| mode.residual.is_nan()));
}
