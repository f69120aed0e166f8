//! Forward kinematics of parallel robots: against their inverse, and against spheres that meet.

use std::f64::consts::TAU;

use multibody::nalgebra::{Rotation3, SMatrix, SVector, Vector3};
use multibody_tests::models::iterated::{delta_closed, delta_multipliers};
use multibody_tests::models::placed::*;
use multibody_tests::support::compare::mixed;
use multibody_tests::support::random::Random;

const N: usize = platform::DOF;

/// A platform stands on what its legs measure, however it moves, and whatever else the state says of it.
#[test]
fn a_platform_on_its_legs() {
    let mut random = Random::new(3);
    let (mut worst, mut found) = (0.0_f64, 0);
    for k in 0..200 {
        let mut params = platform::Params::default();
        for point in params.FEET.iter_mut().chain(&mut params.PINS) {
            *point += 0.02 * Vector3::from(random.units());
        }
        let model = platform::Model::new(&params);
        // The default pose has the plate among its feet.
        let mut state = platform::State::<f64>::default();
        let place: [f64; 6] = random.units();
        state.q.plate.position = [-1.2 + 0.4 * place[0], 0.4 * place[1], 2.0 + 0.4 * place[2]].into();
        let turns = [place[3], place[4], place[5]].map(|x| 0.5 * x);
        (state.q.plate.orientation.roll, state.q.plate.orientation.pitch, state.q.plate.orientation.yaw) = turns.into();
        state.v = SVector::<f64, N>::from(random.units()).into();
        let accel: platform::Velocity = SVector::<f64, N>::from(random.units()).into();
        let legs = model.kinematics_2(0.0, &state, &accel);
        // What legs measure, with all else off.
        let pose: SVector<f64, 6> = SVector::<f64, N>::from(state.q).fixed_rows::<6>(0).into();
        let [v, a] = [state.v, accel].map(|v| SVector::<f64, N>::from(v).fixed_rows::<6>(0).into_owned());
        let off = [1e-3, 0.03, 0.1][k % 3];
        let (mut q, mut v_legs, mut a_legs) = (state.q, state.v, accel);
        for (leg, i) in q.legs.iter_mut().zip(0..) {
            leg.gimbal.first = legs.position[2 * i] + off * random.unit();
            leg.gimbal.second = legs.position[2 * i + 1] + off * random.unit();
            leg.stroke = legs.position[12 + i];
            (v_legs.legs[i].stroke, a_legs.legs[i].stroke) = (legs.velocity[12 + i], legs.acceleration[12 + i]);
        }
        let mut all: SVector<f64, N> = q.into();
        (0..6).for_each(|i| all[i] += off * random.unit());
        let mut rates: [SVector<f64, N>; 2] = [v_legs.into(), a_legs.into()];
        rates.iter_mut().for_each(|rates| (0..6).for_each(|i| rates[i] = random.unit()));
        let state = platform::State { q: all.into(), v: rates[0].into() };
        let got = model.kinematics(0.0, &state, &rates[1].into());
        let with_angles = model.kinematics_3(0.0, &state, &rates[1].into());
        assert!(got.residual < 1e-13, "{k}: {:e}", got.residual);
        found += 1;
        for (got, want) in [(got.position, pose), (got.velocity, v), (got.acceleration, a)] {
            worst = worst.max(mixed(got.as_slice(), want.as_slice()));
        }
        let angles = &with_angles.position.as_slice()[6..];
        worst = worst.max(mixed(angles, &legs.position.as_slice()[..12]));
        worst = worst.max(mixed(&with_angles.acceleration.as_slice()[6..], &legs.acceleration.as_slice()[..12]));
    }
    println!("{found} poses, {worst:e}");
    assert!(found == 200 && worst < 1e-9, "{worst:e}");
}

/// Legs that are too short for any pose: what is left of the equations says so.
#[test]
fn legs_that_do_not_reach() {
    let model = platform::Model::<f64>::default();
    let mut state = platform::State::<f64>::default();
    state.q.plate.position = [-1.2, 0.0, 2.0].into();
    state.q.legs.iter_mut().for_each(|leg| leg.stroke = -0.8);
    let got = model.kinematics(0.0, &state, &platform::Velocity::default());
    assert!(!got.residual.is_finite() || got.residual > 1e-3, "{:e}", got.residual);
}

/// The centre of a plate that doesn't turn is where three spheres about the elbows meet.
#[test]
fn a_delta_robot_by_spheres() {
    let model = delta::Model::<f64>::default();
    let mut random = Random::new(4);
    // The lower one of two points.
    let meet = |shoulders: [f64; 3]| {
        let centre = |i: usize| {
            let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), i as f64 * TAU / 3.0);
            let (sin, cos) = shoulders[i].sin_cos();
            turn * Vector3::new(0.2 + 0.3 * cos - 0.05, 0.0, -0.3 * sin)
        };
        let [a, b, c] = [0, 1, 2].map(centre);
        let x = (b - a).normalize();
        let i = x.dot(&(c - a));
        let y = (c - a - i * x).normalize();
        let (d, j) = ((b - a).norm(), y.dot(&(c - a)));
        let along = d / 2.0;
        let across = (i * i + j * j) / (2.0 * j) - i / j * along;
        let height = (0.8_f64.powi(2) - along * along - across * across).sqrt();
        let [up, down] = [1.0, -1.0].map(|sign| a + along * x + across * y + sign * height * x.cross(&y));
        if up.z < down.z { up } else { down }
    };
    let (mut worst, mut again) = (0.0_f64, 0);
    for _ in 0..200 {
        let shoulders = random.units::<3>().map(|x| 0.4 + 0.6 * x);
        let rates = random.units::<3>();
        let accels = random.units::<3>();
        let mut state = delta::State::<f64>::default();
        let mut accel = delta::Velocity::default();
        state.q.plate.position = [0.0, 0.0, -0.75].into();
        for (i, limb) in state.q.limbs.iter_mut().enumerate() {
            limb.shoulder = shoulders[i];
            (limb.elbow_a.first, limb.elbow_b.first) = (1.2 - shoulders[i], 1.2 - shoulders[i]);
            (state.v.limbs[i].shoulder, accel.limbs[i].shoulder) = (rates[i], accels[i]);
        }
        let mut got = model.kinematics(0.0, &state, &accel);
        // From so far away once may not be enough, and tells: the next rounds go on from there.
        for _ in 0..2 {
            if got.residual > 1e-13 {
                again += 1;
                let at = got.position;
                let plate = &mut state.q.plate;
                plate.position = at.fixed_rows::<3>(0).into();
                (plate.orientation.roll, plate.orientation.pitch, plate.orientation.yaw) = (at[3], at[4], at[5]);
                for (i, limb) in state.q.limbs.iter_mut().enumerate() {
                    (limb.elbow_a.first, limb.elbow_a.second) = (at[6 + 2 * i], at[7 + 2 * i]);
                    (limb.elbow_b.first, limb.elbow_b.second) = (at[12 + 2 * i], at[13 + 2 * i]);
                }
                got = model.kinematics(0.0, &state, &accel);
            }
        }
        assert!(got.residual < 1e-13, "{:e} at {shoulders:?}", got.residual);
        // The fifth order of differences; rounding leaves ten digits of the second.
        let h = 1e-2;
        let at = |t: f64| meet(std::array::from_fn(|i| shoulders[i] + t * rates[i] + 0.5 * t * t * accels[i]));
        let [p3, p2, p1, n1, n2, n3] = [3.0, 2.0, 1.0, -1.0, -2.0, -3.0].map(|k| at(k * h));
        let here = meet(shoulders);
        let first = (45.0 * (p1 - n1) - 9.0 * (p2 - n2) + (p3 - n3)) / (60.0 * h);
        let second = (270.0 * (p1 + n1) - 27.0 * (p2 + n2) + 2.0 * (p3 + n3) - 490.0 * here) / (180.0 * h * h);
        let pose = |list: &SVector<f64, 18>| [list.as_slice()[..3].to_vec(), list.as_slice()[3..6].to_vec()];
        let [place, turn] = pose(&got.position);
        worst = worst.max(mixed(&place, here.as_slice())).max(mixed(&turn, &[0.0; 3]));
        for (list, want) in [(&got.velocity, first), (&got.acceleration, second)] {
            let [moves, turns] = pose(list);
            assert!(mixed(&moves, want.as_slice()) < 1e-7, "{moves:?} {want:?}");
            assert!(mixed(&turns, &[0.0; 3]) < 1e-11, "{turns:?}");
        }
    }
    println!("{worst:e}, {again} times again");
    assert!(worst < 1e-12, "{worst:e}");
}

/// The same in closed form, by what parallelograms do, moves as with an equation for each component of each wrist.
#[test]
fn a_delta_robot_in_closed_form() {
    let (closed, kept) = (delta_closed::Model::<f64>::default(), delta_multipliers::Model::<f64>::default());
    let (mut random, mut worst) = (Random::new(6), 0.0_f64);
    for _ in 0..200 {
        let place = SVector::<f64, 3>::new(0.2 * random.unit(), 0.2 * random.unit(), -0.75 + 0.1 * random.unit());
        let moves = SVector::<f64, 3>::from(random.units());
        let state = delta_closed::State { q: place.into(), v: moves.into() };
        let torques: [f64; 3] = random.units();
        let mut input = delta_closed::Input::default();
        input.limbs.iter_mut().zip(torques).for_each(|(limb, torque)| limb.torque = torque);
        let accel = closed.forward_dynamics(0.0, &state, &input);
        let limbs = closed.kinematics(0.0, &state, &accel);
        let mut all = delta_multipliers::State::<f64>::default();
        all.q.plate.position = place;
        let mut rates: SVector<f64, { delta_multipliers::DOF }> = all.v.into();
        rates.fixed_rows_mut::<3>(0).copy_from(&moves);
        all.v = rates.into();
        for (i, (q, v)) in all.q.limbs.iter_mut().zip(&mut all.v.limbs).enumerate() {
            let [shoulder, first, second] = [i, 3 + 2 * i, 4 + 2 * i];
            (q.shoulder, v.shoulder) = (limbs.position[shoulder], limbs.velocity[shoulder]);
            for (q, v) in [(&mut q.elbow_a, &mut v.elbow_a), (&mut q.elbow_b, &mut v.elbow_b)] {
                (q.first, q.second) = (limbs.position[first], limbs.position[second]);
                (v.first, v.second) = (limbs.velocity[first], limbs.velocity[second]);
            }
        }
        assert!(kept.constraints(0.0, &all.q).amax() < 1e-14);
        let mut input = delta_multipliers::Input::default();
        input.limbs.iter_mut().zip(torques).for_each(|(limb, torque)| limb.torque = torque);
        let want: SVector<f64, { delta_multipliers::DOF }> = kept.forward_dynamics(0.0, &all, &input).v.into();
        let got: SVector<f64, 3> = accel.into();
        worst = worst.max(mixed(got.as_slice(), &want.as_slice()[..3]));
    }
    println!("{worst:e}");
    assert!(worst < 1e-10, "{worst:e}");
}

/// r cos(t) + sqrt(l^2 - r^2 sin(t)^2) = x, and back.
#[test]
fn a_crank_from_its_slider() {
    let mut random = Random::new(5);
    for _ in 0..100 {
        let (r, l) = (0.31 + 0.05 * random.unit(), 0.83 + 0.05 * random.unit());
        let model = press::Model::new(&press::Params { r, l });
        let t = 1.5 + random.unit();
        let k = -(r * t.sin() / l).asin() - t;
        let x = r * t.cos() + l * (t + k).cos();
        let rate = random.unit();
        // x' = -r sin(t) t' - l sin(t + k) (t' + k'), and nothing across.
        let slope = SMatrix::<f64, 2, 2>::new(
            -r * t.sin() - l * (t + k).sin(),
            -l * (t + k).sin(),
            r * t.cos() + l * (t + k).cos(),
            l * (t + k).cos(),
        );
        let rates = slope.try_inverse().unwrap() * SVector::from([rate, 0.0]);
        let q = press::Position { turn: t + 0.1 * random.unit(), knee: k + 0.1 * random.unit(), rail: x };
        let v = press::Velocity { turn: 9.0, knee: -7.0, rail: rate };
        let got = model.kinematics(0.0, &press::State { q, v }, &press::Velocity::default());
        assert!(got.residual < 1e-14);
        assert!(mixed(got.position.as_slice(), &[t, k]) < 1e-13);
        assert!(mixed(got.velocity.as_slice(), rates.as_slice()) < 1e-12, "{:?} {rates:?}", got.velocity);
    }
}
