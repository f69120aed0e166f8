//! Functions in parts give what whole functions give, to the bit: no operation and no order of operations differs.

use std::fmt::Debug;

use multibody::Real;
use multibody::nalgebra::{Quaternion, SVector, UnitQuaternion, Vector3};
use multibody::simba::simd::WideF64x4;
use multibody_test_cut::{cut, whole};

/// Numbers between -1 and 1 that look random: splitmix64 of Vigna.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A scalar, or lanes of numbers that differ.
trait Draw: Real + Debug {
    fn draw(random: &mut Random) -> Self;
}

impl Draw for f64 {
    fn draw(random: &mut Random) -> f64 {
        random.unit()
    }
}

impl Draw for f32 {
    fn draw(random: &mut Random) -> f32 {
        random.unit() as f32
    }
}

impl Draw for WideF64x4 {
    fn draw(random: &mut Random) -> WideF64x4 {
        WideF64x4::from(std::array::from_fn(|_| random.unit()))
    }
}

/// What a function of one of the two modules gives, as text: that of a float is as exact as the float, signs of zeros included.
fn text(value: impl Debug) -> String {
    format!("{value:?}")
}

macro_rules! walker {
    ($module:ident, $scalar:ty, $seed:expr) => {{
        use $module::walker as model;
        let mut random = Random($seed);
        let mut draw = |size: f64| <$scalar as Real>::lit(size) * <$scalar as Draw>::draw(&mut random);
        let mut params = model::Params::<$scalar>::default();
        for leg in &mut params.legs {
            leg.m += draw(0.1);
        }
        let m = model::Model::new(&params);
        let mut state = model::State::<$scalar>::default();
        state.q.float.position = Vector3::from_fn(|_, _| draw(2.0));
        // Of any length: what is compared holds for whatever numbers there are.
        let parts = [draw(1.0), draw(1.0), draw(1.0), draw(1.0)];
        state.q.float.orientation =
            UnitQuaternion::new_unchecked(Quaternion::new(parts[0], parts[1], parts[2], parts[3]));
        state.q.legs.iter_mut().for_each(|leg| leg.lift = draw(3.0));
        state.v = SVector::<$scalar, { model::DOF }>::from_fn(|_, _| draw(4.0)).into();
        let accel = model::Velocity::from(SVector::<$scalar, { model::DOF }>::from_fn(|_, _| draw(9.0)));
        let mut input = model::Input::<$scalar>::default();
        input.legs.iter_mut().for_each(|leg| leg.torque = draw(2.0));
        let t = draw(1.0);
        [
            text(m.forward_dynamics(t, &state, &input)),
            text(m.inverse_dynamics(t, &state, &input, &accel)),
            text(m.mass_matrix(&state.q)),
            text(m.bias(t, &state, &input)),
            text(m.kinetic_energy(&state)),
            text(m.potential_energy(&state.q)),
        ]
    }};
}

macro_rules! linkage {
    ($module:ident, $scalar:ty, $seed:expr) => {{
        use $module::linkage as model;
        let mut random = Random($seed);
        let mut draw = |size: f64| <$scalar as Real>::lit(size) * <$scalar as Draw>::draw(&mut random);
        let mut params = model::Params::<$scalar>::default();
        for leg in &mut params.legs {
            leg.m += draw(0.1);
            leg.length += draw(0.05);
        }
        let m = model::Model::new(&params);
        let start = model::State::<$scalar>::default();
        let near = SVector::<$scalar, 2>::from(start.q).map(|x| x + draw(0.2));
        let v = SVector::<$scalar, 2>::from_fn(|_, _| draw(2.0));
        let state = model::State { q: near.into(), v: v.into(), ..start };
        let accel = model::Velocity::from(SVector::<$scalar, 2>::from_fn(|_, _| draw(9.0)));
        let mut input = model::Input::<$scalar>::default();
        input.legs.iter_mut().for_each(|leg| leg.torque = draw(2.0));
        let t = draw(1.0);
        [
            text(m.forward_dynamics(t, &state, &input)),
            text(m.inverse_dynamics(t, &state, &input, &accel)),
            text(m.mass_matrix(&state)),
            text(m.bias(t, &state, &input)),
            text(m.outputs(t, &state, &input)),
        ]
    }};
}

macro_rules! same {
    ($results:ident, $scalar:ty) => {
        for seed in 0..50 {
            let (whole, parts) = ($results!(whole, $scalar, seed), $results!(cut, $scalar, seed));
            assert_eq!(whole, parts, "{} of {seed}", stringify!($scalar));
            // Text of what is no number tells nothing of bits.
            assert!(whole.iter().all(|text| !text.contains("NaN") && !text.contains("inf")), "{whole:#?}");
        }
    };
}

#[test]
fn a_floating_tree_in_packs() {
    same!(walker, f64);
    same!(walker, f32);
    same!(walker, WideF64x4);
}

#[test]
fn loops_closed_by_iterations() {
    same!(linkage, f64);
    same!(linkage, f32);
    same!(linkage, WideF64x4);
}

/// What is compared is in parts, and the first model in packs.
#[test]
fn there_are_parts() {
    let [walker, linkage] = cut::TEXT;
    for function in ["forward_dynamics", "inverse_dynamics", "bias"] {
        for text in [walker, linkage] {
            assert!(text.contains(&format!("fn {function}_part_2 ")), "{function}");
        }
    }
    assert!(linkage.contains("fn mass_matrix_part_2 ") && linkage.contains("fn outputs_part_2 "));
    assert!(walker.contains("T :: four"), "packs");
}
