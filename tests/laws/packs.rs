//! Limbs in packs against the same limbs one after the other, and one kind of pack against another.

use multibody::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody::{Real, multibody};
use multibody_tests::support::random::Random;

/// A body on limbs whose axes, places and masses are those of parameters, half of them mirrored.
macro_rules! spider {
    ($name:ident, $packs:ident, $legs:literal) => {
        multibody! {
            mod limb {
                port hip: Frame;
                /// [kg]
                param m = 0.41;
                /// [m]
                param length = 0.33;
                param side = 1.0;
                /// [N m]
                input effort: [Scalar; 3];
                body pelvis {
                    mass: 0.7 * m, com: [0.02, 0.05 * side, -0.01],
                    inertia: inertia(0.002 * m, 0.003 * m, 0.004 * m, 0.0004 * side * m, 0.0002 * m, -0.0003 * side * m),
                }
                body thigh {
                    mass: m, com: [0.01, 0.02 * side, -0.4 * length],
                    inertia: inertia(0.011 * m, 0.012 * m, 0.002 * m, 0.0007 * side * m, 0.0, -0.0004 * side * m),
                }
                body shin { mass: 0.6 * m, com: [0.013, 0.0, -0.35 * length], inertia: diag(0.006 * m, 0.007 * m, 0.001 * m) }
                joint roll: Revolute { parent: hip, child: pelvis, axis: [1.0, 0.2, 0.1] }
                joint pitch: Revolute { parent: pelvis.at([0.01, 0.06 * side, 0.0]), child: thigh, axis: [0.1, 1.0, 0.2] }
                joint knee: Revolute { parent: thigh.at(-length * Z), child: shin, axis: [0.0, 1.0, 0.3] }
                force first: Effort { joint: roll, value: effort[0] - 0.02 * roll.rate }
                force second: Effort { joint: pitch, value: effort[1] }
                force third: Effort { joint: knee, value: effort[2] }
            }
            pub(super) mod $name {
                const HIPS: [Vec3; 6] = [
                    [0.31, 0.22, 0.03], [0.29, -0.21, 0.02], [-0.33, 0.19, 0.01], [-0.28, -0.24, 0.05], [0.02, 0.3, 0.0],
                    [0.01, -0.32, 0.01],
                ];
                const TURNS: [Scalar; 6] = [0.3, -0.7, 2.2, -2.6, 1.5, -1.4];
                world { gravity: [0.3, -0.2, -9.7] }
                body trunk { mass: 2.1, com: [0.02, -0.01, 0.03], inertia: inertia(0.031, 0.043, 0.059, 0.002, -0.003, 0.004) }
                joint float: Free { parent: ground, child: trunk }
                part legs: [limb; $legs] = |i| limb { hip: trunk.at(HIPS[i]).rotated([0.2, 0.1, 1.0], TURNS[i]), };
                formulation { packs: $packs }
                emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
            }
        }
    };
}

mod plain_two {
    use super::multibody;
    spider!(two, Off, 2);
}
mod packed_two {
    use super::multibody;
    spider!(two, Four, 2);
}
mod plain {
    use super::multibody;
    spider!(four, Off, 4);
}
mod plain_six {
    use super::multibody;
    spider!(six, Off, 6);
}
mod packed {
    use super::multibody;
    spider!(four, Four, 4);
}
mod packed_six {
    use super::multibody;
    spider!(six, Four, 6);
}

/// Results of all functions of a model at a random state, whose numbers are those of a seed.
macro_rules! results {
    ($model:path, $scalar:ty, $legs:literal, $seed:expr, $to:expr) => {{
        use $model as model;
        let mut random = Random::new($seed);
        let mut draw = |size: f64| <$scalar as Real>::lit(size * (2.0 * random.unit() - 1.0));
        let mut params = model::Params::<$scalar>::default();
        for (k, leg) in params.legs.iter_mut().enumerate() {
            leg.m = <$scalar as Real>::lit(0.4) + draw(0.3);
            leg.length = <$scalar as Real>::lit(0.3) + draw(0.2);
            leg.side = <$scalar as Real>::lit(if k % 2 == 0 { 1.0 } else { -1.0 });
        }
        let m = model::Model::new(&params);
        let mut state = model::State::<$scalar>::default();
        let twist = |draw: &mut dyn FnMut(f64) -> $scalar, size: f64| {
            let mut velocity = model::Velocity::<$scalar>::default();
            let three = |draw: &mut dyn FnMut(f64) -> $scalar| Vector3::from_fn(|_, _| draw(size));
            velocity.float.linear = three(draw);
            velocity.float.angular = three(draw);
            for leg in &mut velocity.legs {
                (leg.roll, leg.pitch, leg.knee) = (draw(size), draw(size), draw(size));
            }
            velocity
        };
        // Far from the default: several turns away.
        for leg in &mut state.q.legs {
            (leg.roll, leg.pitch, leg.knee) = (draw(9.0), draw(9.0), draw(9.0));
        }
        state.q.float.position = Vector3::from_fn(|_, _| draw(9.0));
        // Of length one as far as any scalar holds it.
        let (sin, cos) = (0.6 * 0.28, 0.96);
        let [x, y, z, w] = [0.6 * 0.96, 0.8 * cos, 0.8 * 0.28, sin].map(|part| <$scalar as Real>::lit(part));
        state.q.float.orientation = UnitQuaternion::new_unchecked(Quaternion::new(w, x, -y, z));
        state.v = twist(&mut draw, 4.0);
        let accel = twist(&mut draw, 30.0);
        let mut input = model::Input::<$scalar>::default();
        for leg in &mut input.legs {
            leg.effort = [draw(5.0), draw(5.0), draw(5.0)];
        }
        let t = <$scalar as Real>::lit(0.0);
        let forward = m.forward_dynamics(t, &state, &input);
        let inverse = m.inverse_dynamics(t, &state, &input, &accel);
        let mass = m.mass_matrix(&state.q);
        let bias = m.bias(t, &state, &input);
        let size = 6 + 3 * $legs;
        assert_eq!(mass.nrows(), size);
        let mut list: Vec<f64> = Vec::new();
        list.extend(bias.iter().copied().map($to));
        for velocity in [forward, inverse] {
            list.extend(velocity.float.linear.iter().chain(velocity.float.angular.iter()).copied().map($to));
            list.extend(velocity.legs.iter().flat_map(|leg| [leg.roll, leg.pitch, leg.knee]).map($to));
        }
        list.extend(mass.iter().copied().map($to));
        list
    }};
}

/// Each result is as large as others of its function.
fn near(a: &[f64], b: &[f64], tolerance: f64) {
    let size = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for (number, (x, y)) in a.iter().zip(b).enumerate() {
        assert!((x - y).abs() <= tolerance * size, "{number}: {x:e}, {y:e}, of {size:e}");
    }
}

#[test]
fn packs_give_what_limbs_give() {
    let mut differs = [false; 3];
    for seed in 0..200 {
        let two = [results!(plain_two::two, f64, 2, seed, |x| x), results!(packed_two::two, f64, 2, seed, |x| x)];
        let four = [results!(plain::four, f64, 4, seed, |x| x), results!(packed::four, f64, 4, seed, |x| x)];
        let six = [results!(plain_six::six, f64, 6, seed, |x| x), results!(packed_six::six, f64, 6, seed, |x| x)];
        for ([plain, packed], differs) in [two, four, six].into_iter().zip(&mut differs) {
            near(&plain, &packed, 1e-11);
            *differs |= plain != packed;
        }
    }
    // Terms are added in another order, so these are not the same programs.
    assert!(differs.iter().all(|&differs| differs));
}

#[test]
fn single_precision_is_as_near() {
    let single = |x: f32| f64::from(x);
    for seed in 0..50 {
        near(&results!(packed_two::two, f64, 2, seed, |x| x), &results!(packed_two::two, f32, 2, seed, single), 2e-3);
        near(&results!(packed::four, f64, 4, seed, |x| x), &results!(packed::four, f32, 4, seed, single), 2e-3);
    }
}

/// A vector of the processor, and an array of which each member is in lanes: no operation is rounded otherwise.
#[test]
fn a_pack_is_its_members_to_the_bit() {
    let lane = |x: WideF64x4| x.extract(2);
    for seed in 0..100 {
        let vectors = [
            results!(packed_two::two, f64, 2, seed, |x| x),
            results!(packed::four, f64, 4, seed, |x| x),
            results!(packed_six::six, f64, 6, seed, |x| x),
        ];
        let arrays = [
            results!(packed_two::two, WideF64x4, 2, seed, lane),
            results!(packed::four, WideF64x4, 4, seed, lane),
            results!(packed_six::six, WideF64x4, 6, seed, lane),
        ];
        for (number, (a, b)) in vectors.iter().flatten().zip(arrays.iter().flatten()).enumerate() {
            assert_eq!(a.to_bits(), b.to_bits(), "{number}: {a:e}, {b:e}");
        }
    }
}

/// Bits of single operations of a float, of vectors and of arrays, zeros with their signs and what is no number among them.
macro_rules! operations {
    ($float:ident, $count:literal, $vector:ident, $array:ident) => {{
        let values =
            [0.0, -0.0, 1.5, -2.25, 1e-310, 3e200, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 0.1, -1e-200, 7.0];
        let same = |a: [$float; $count], b: [$float; $count], scalar: &dyn Fn(usize) -> $float| {
            for (k, (a, b)) in a.into_iter().zip(b).enumerate() {
                let is_same = |b: $float| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
                assert!(is_same(b) && is_same(scalar(k)), "{a:e}, {b:e}, {:e}", scalar(k));
            }
        };
        for first in 0..values.len() {
            for second in 0..values.len() {
                let at = |k: usize| values[k % values.len()] as $float;
                let a: [$float; $count] = std::array::from_fn(|k| at(first + k));
                let b: [$float; $count] = std::array::from_fn(|k| at(second + 5 * k));
                let (v, w, x, y) = ($float::$vector(a), $float::$vector(b), $array::of(a), $array::of(b));
                same($float::members(v + w), (x + y).members(), &|k| a[k] + b[k]);
                same($float::members(v - w), (x - y).members(), &|k| a[k] - b[k]);
                same($float::members(v * w), (x * y).members(), &|k| a[k] * b[k]);
                same($float::members(v / w), (x / y).members(), &|k| a[k] / b[k]);
                same($float::members(-v), (-x).members(), &|k| -a[k]);
                same($float::members($float::roots(v)), x.roots().members(), &|k| a[k].sqrt());
            }
        }
    }};
}

#[test]
fn operations_of_vectors_are_those_of_scalars() {
    use multibody::{Four, Packed, Two};
    operations!(f64, 2, two, Two);
    operations!(f64, 4, four, Four);
    operations!(f32, 2, two, Two);
    operations!(f32, 4, four, Four);
    assert_eq!((f64::members(f64::two_of(2.5)), f64::members(f64::four_of(2.5))), ([2.5; 2], [2.5; 4]));
}
