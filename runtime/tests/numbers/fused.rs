//! `Real::mul_add`: one rounding with the feature `fma` where the target has an instruction for it, two everywhere else, and the
//! same of a number whether it stands alone, in a lane or in a pack.

use multibody::simba::simd::{SimdValue, WideF32x4, WideF32x8, WideF64x4};
use multibody::{Four, Packed, Real, Two, multibody};

const FUSED: bool = cfg!(all(
    feature = "fma",
    not(feature = "reproducible"),
    any(all(target_arch = "x86_64", target_feature = "fma"), target_arch = "aarch64")
));

/// Numbers whose products lose digits, of both signs, tiny, huge, and none.
fn triples() -> impl Iterator<Item = [f64; 3]> {
    let ordinary = (0..1000_u32).map(|k| {
        let [a, b, c] =
            [0.754_877_666, 0.569_840_291, 0.324_717_957].map(|step| 2.0 * (step * f64::from(k)).fract() - 1.0);
        // Every other one cancels.
        if k % 2 == 0 { [a, b, c] } else { [a, b, -a * b] }
    });
    let odd = [0.0, -0.0, 1.0, 1e-310, 1e300, f64::INFINITY, f64::NAN];
    ordinary.chain(odd.into_iter().flat_map(move |a| odd.map(|b| [a, b, -1.5])))
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

#[test]
fn numbers_are_rounded_once_or_twice() {
    let mut differ = 0;
    for [a, b, c] in triples() {
        let (once, twice) = (a.mul_add(b, c), a * b + c);
        let got = Real::mul_add(a, b, c);
        assert!(same(got, if FUSED { once } else { twice }), "{a} {b} {c}");
        differ += usize::from(!same(once, twice));
        let [a, b, c] = [a as f32, b as f32, c as f32];
        let expected = if FUSED { a.mul_add(b, c) } else { a * b + c };
        assert!(same(Real::mul_add(a, b, c).into(), expected.into()), "{a} {b} {c}");
    }
    // Else this would say nothing.
    assert!(differ > 500, "{differ}");
}

/// Each lane is the number alone.
fn lanes<L: Real + SimdValue<Element = E>, E: Real + Into<f64>>(of: fn(f64) -> E) {
    let all: Vec<[f64; 3]> = triples().collect();
    for chunk in all.chunks_exact(L::LANES) {
        let mut operands = [L::lit(0.0); 3];
        for (k, triple) in chunk.iter().enumerate() {
            (0..3).for_each(|which| operands[which].replace(k, of(triple[which])));
        }
        let [a, b, c] = operands;
        let got = Real::mul_add(a, b, c);
        for (k, triple) in chunk.iter().enumerate() {
            let [a, b, c] = triple.map(of);
            assert!(same(got.extract(k).into(), Real::mul_add(a, b, c).into()), "{triple:?}");
        }
    }
}

#[test]
fn lanes_are_numbers() {
    lanes::<WideF64x4, f64>(|x| x);
    lanes::<WideF32x4, f32>(|x| x as f32);
    lanes::<WideF32x8, f32>(|x| x as f32);
}

#[test]
fn packs_are_numbers() {
    let all: Vec<[f64; 3]> = triples().collect();
    for chunk in all.chunks_exact(4) {
        let [a, b, c] = [0, 1, 2].map(|which| [0, 1, 2, 3].map(|k| chunk[k][which]));
        let expected: [f64; 4] = std::array::from_fn(|k| Real::mul_add(a[k], b[k], c[k]));
        let vector = f64::members(f64::mul_adds(f64::four(a), f64::four(b), f64::four(c)));
        let array = Four::of(a).mul_add(Four::of(b), Four::of(c)).members();
        for k in 0..4 {
            assert!(same(vector[k], expected[k]) && same(array[k], expected[k]), "{:?}", chunk[k]);
        }
        let [a, b, c] = [a, b, c].map(|[x, y, ..]| [x, y]);
        let vector = f64::members(f64::mul_adds(f64::two(a), f64::two(b), f64::two(c)));
        let array = Two::of(a).mul_add(Two::of(b), Two::of(c)).members();
        for k in 0..2 {
            assert!(same(vector[k], expected[k]) && same(array[k], expected[k]), "{:?}", chunk[k]);
        }
    }
}

#[cfg(feature = "num-dual")]
#[test]
fn dual_numbers_have_the_derivative_of_a_product() {
    let [a, b, c] = [0.3, -1.7, 2.9].map(|x| num_dual::Dual::new(x, 10.0 * x));
    let got = Real::mul_add(a, b, c);
    assert_eq!(got, a * b + c);
}

multibody! {
    /// Three oblique links.
    mod arm {
        world { gravity: [0.3, -1.1, -9.7] }
        body one { mass: 1.3, com: [0.11, -0.07, 0.21], inertia: inertia(0.031, 0.043, 0.029, 0.002, -0.003, 0.001) }
        body two { mass: 0.9, com: [0.05, 0.13, -0.17], inertia: inertia(0.021, 0.017, 0.019, -0.001, 0.002, 0.0015) }
        body three { mass: 0.7, com: [-0.09, 0.08, 0.15], inertia: inertia(0.012, 0.011, 0.014, 0.001, 0.0005, -0.002) }
        joint first: Revolute { parent: ground, child: one, axis: [1.0, 2.0, 3.0] }
        joint second: Revolute { parent: one.at([0.2, -0.1, 0.4]), child: two, axis: [-2.0, 1.0, 1.0] }
        joint third: Prismatic { parent: two.at([0.1, 0.3, -0.2]), child: three, axis: [3.0, -1.0, 2.0] }
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
}

/// What is generated with fused products: its functions agree, the mass matrix is symmetric to the bit, and lanes are numbers.
#[test]
fn functions_agree() {
    let model = arm::Model::<f64>::default();
    let lanes = arm::Model::<WideF64x4>::default();
    for k in 0..200_u32 {
        let draw = |n: u32| 3.0 * ((0.754_877_666 * f64::from(7 * k + n)).fract() * 2.0 - 1.0);
        let q = arm::Position { first: draw(0), second: draw(1), third: draw(2) };
        let v = arm::Velocity { first: draw(3), second: draw(4), third: draw(5) };
        let state = arm::State { q, v };
        let accel = model.forward_dynamics(0.0, &state, &());
        let effort = model.inverse_dynamics(0.0, &state, &(), &accel);
        let mass = model.mass_matrix(&q);
        let size = mass.norm() * (accel.first.abs() + accel.second.abs() + accel.third.abs() + 10.0);
        for effort in [effort.first, effort.second, effort.third] {
            assert!(effort.abs() < 1e-13 * size, "{effort} {size}");
        }
        assert_eq!(mass, mass.transpose());
        let all = |x: f64| WideF64x4::splat(x);
        let q = arm::Position { first: all(q.first), second: all(q.second), third: all(q.third) };
        let wide = lanes.mass_matrix(&q);
        for (a, b) in mass.iter().zip(wide.iter()) {
            let difference = (0..4).map(|lane| (a - b.extract(lane)).abs()).fold(0.0, f64::max);
            assert!(difference < 1e-14 * mass.norm());
        }
    }
}
