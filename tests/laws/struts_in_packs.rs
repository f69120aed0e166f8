//! A platform on six legs, whose legs are computed four and two at a time, against the same legs one after the other: leg forces and
//! accelerations, at typed places of joints, in poses near and far, in every kind of scalar.

use multibody::nalgebra::Vector3;
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody::{Real, RollPitchYaw};
use multibody_tests::support::random::Random;
use num_dual::Dual64;

macro_rules! platform {
    ($name:ident, $packs:ident) => {
        multibody::multibody! {
            mod leg {
                port base: Frame;
                port tip: Frame;
                /// [N] pushes the tip away from the base
                input thrust;
                body cylinder { mass: 0.3141592653589793, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
                body piston { mass: 0.2718281828459045, com: -0.5 * Z, inertia: diag(0.00571, 0.00571, 0.0) }
                joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
                joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
                #[cut]
                joint ball: Ball { parent: piston, child: tip }
                force actuator: Effort { joint: stroke, value: thrust - 3.1 * (stroke.travel - 0.2) - 0.7 * stroke.rate }
                solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
            }
            pub(super) mod $name {
                // Some legs have numbers in common, and zeros.
                const FEET: [Vec3; 6] = [
                    [-2.1234567890123456, 1.3745678901234567, 0.0456789012345678], [-2.38, 1.224, 0.0],
                    [-2.3956789012345678, -1.2246789012345678, -0.0345678901234567], [0.0, -1.374, 0.0213456789012345],
                    [0.0123456789012345, -0.1523456789012345, 0.0], [0.0, 0.1534567890123456, -0.0123456789012345],
                ];
                const PINS: [Vec3; 6] = [
                    [0.1723456789012345, 0.5956789012345678, -0.4012345678901234], [-0.6, 0.15, -0.4],
                    [-0.6012345678901234, -0.1512345678901234, -0.4], [0.17, -0.595, -0.3898765432109876],
                    [0.4312345678901234, -0.4451234567890123, -0.4], [0.43, 0.0, -0.4123456789012345],
                ];
                world { gravity: [0.31, -0.22, -9.7] }
                formulation { constraints: Reduced, packs: $packs }
                body platform {
                    mass: 1.5123456789012345, com: [0.02, -0.03, 0.04],
                    inertia: inertia(0.08, 0.09, 0.11, 0.004, -0.003, 0.002), coordinates: Absolute(RollPitchYaw),
                }
                part legs: [leg; 6] = |i| leg {
                    base: ground.at(FEET[i]).rotated([0.2, -0.1, 1.0], 0.7 * i - 2.0), tip: platform.at(PINS[i]),
                };
                emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust };
            }
        }
    };
}

mod plain {
    platform!(alone, Off);
}
mod packed {
    platform!(together, Four);
}

/// Accelerations from thrusts, and thrusts from these accelerations with the rank of their system, at a random state. What moves
/// with `step` is the pose.
macro_rules! results {
    ($model:path, $scalar:ty, $seed:expr, $step:expr, $to:expr) => {{
        use $model as model;
        let mut random = Random::new($seed);
        let mut draw = |size: f64| <$scalar as Real>::lit(size * (2.0 * random.unit() - 1.0));
        // Every other one is several turns away, and far from the ground.
        let far = if $seed % 2 == 0 { 1.0 } else { 15.0 };
        let mut three = |size: f64| Vector3::from_fn(|_, _| draw(size));
        let (place, angles, v, w) = (three(0.6), three(0.35 * far), three(2.0), three(2.0));
        let step: $scalar = $step;
        let m = model::Model::<$scalar>::default();
        let mut state = model::State::<$scalar>::default();
        state.q.platform.position = place;
        state.q.platform.position.z += <$scalar as Real>::lit(1.1 * far) + step;
        state.q.platform.orientation = RollPitchYaw { roll: angles.x, pitch: angles.y + step, yaw: angles.z };
        state.v.platform.position = v;
        state.v.platform.orientation = RollPitchYaw { roll: w.x, pitch: w.y, yaw: w.z };
        let mut input = model::Input::<$scalar>::default();
        for leg in &mut input.legs {
            leg.thrust = draw(12.0);
        }
        let t = <$scalar as Real>::lit(0.0);
        let accel = m.forward_dynamics(t, &state, &input);
        let solved = m.inverse_dynamics(t, &state, &input, &accel);
        let turn = accel.platform.orientation;
        let mut list: Vec<f64> = accel.platform.position.iter().copied().map($to).collect();
        list.extend([turn.roll, turn.pitch, turn.yaw].map($to));
        let given: Vec<f64> = input.legs.iter().map(|leg| leg.thrust).map($to).collect();
        let thrusts: Vec<f64> = solved.input.legs.iter().map(|leg| leg.thrust).map($to).collect();
        (list, given, thrusts, ($to)(solved.rank))
    }};
}

fn near(a: &[f64], b: &[f64], tolerance: f64) {
    let size = a.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    for (number, (x, y)) in a.iter().zip(b).enumerate() {
        assert!((x - y).abs() <= tolerance * size, "{number}: {x:e}, {y:e}, of {size:e}");
    }
}

/// Thrusts come back from the accelerations that they make.
#[test]
fn packs_give_what_legs_give() {
    let mut differs = false;
    for seed in 0..200 {
        let (a, given, forces, rank) = results!(plain::alone, f64, seed, 0.0, |x| x);
        let (b, same, thrusts, packed_rank) = results!(packed::together, f64, seed, 0.0, |x| x);
        assert_eq!(given, same);
        assert_eq!([rank, packed_rank], [6.0; 2]);
        near(&a, &b, 1e-9);
        near(&given, &forces, 1e-8);
        near(&given, &thrusts, 1e-8);
        differs |= a != b;
    }
    // Terms are added in another order, so these are not the same programs.
    assert!(differs);
}

#[test]
fn single_precision_is_as_near() {
    for seed in (0..60).step_by(2) {
        let (a, ..) = results!(packed::together, f64, seed, 0.0, |x| x);
        let (b, ..) = results!(packed::together, f32, seed, 0.0, |x: f32| f64::from(x));
        near(&a, &b, 2e-2);
    }
}

/// A vector of the processor, and an array of which each member is in lanes.
#[test]
fn a_pack_is_its_members_to_the_bit() {
    for seed in 0..100 {
        let vectors = results!(packed::together, f64, seed, 0.0, |x| x);
        let arrays = results!(packed::together, WideF64x4, seed, WideF64x4::splat(0.0), |x: WideF64x4| x.extract(2));
        for (a, b) in vectors.0.iter().chain(&vectors.2).zip(arrays.0.iter().chain(&arrays.2)) {
            assert_eq!(a.to_bits(), b.to_bits(), "{a:e}, {b:e}");
        }
    }
}

/// Derivatives by the pose through packs of dual numbers against differences of the plain program.
#[test]
fn dual_numbers_go_through_packs() {
    for seed in 0..40 {
        let (slopes, ..) = results!(packed::together, Dual64, seed, Dual64::new(0.0, 1.0), |x: Dual64| x.eps);
        let at = |step: f64| results!(plain::alone, f64, seed, step, |x| x).0;
        let h = 1e-5;
        let differences: Vec<f64> = at(h).iter().zip(&at(-h)).map(|(b, a)| (b - a) / (2.0 * h)).collect();
        near(&slopes, &differences, 1e-5);
    }
}
