//! Sines in lanes and of several angles at once: error, large angles, what is no angle, every number of angles.
//!
//! All `f32` up to the limit are swept by `cargo bench --bench angles`.

#[cfg(not(feature = "reproducible"))]
use crate::truth;
use multibody::Real;
use multibody::simba::simd::{SimdValue, WideF32x4, WideF32x8, WideF64x4};

/// Angles drawn by a seed.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 11
    }

    /// Between -1 and 1.
    fn part(&mut self) -> f64 {
        self.next() as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Of one turn, of some, next to a multiple of pi/2, or of any size from 1e-9 up to the limit.
    fn angle(&mut self, limit: f64) -> f64 {
        match self.next() % 4 {
            0 => self.part() * 3.2,
            1 => self.part() * 50.0,
            2 => {
                let n = (self.part().abs() * limit * 0.6).ceil();
                n * core::f64::consts::FRAC_PI_2 * (1.0 + self.part() * 1e-15)
            }
            _ => self.part() * limit * 1e-9_f64.powf(self.part().abs()),
        }
    }
}

/// The greatest errors of sine and cosine [ulp].
#[cfg(not(feature = "reproducible"))]
fn worst_double(sin_cos: impl Fn([f64; 4]) -> [(f64, f64); 4]) -> f64 {
    let (mut draw, mut worst) = (Draw(7), 0.0_f64);
    for _ in 0..50_000 {
        let angles = [0; 4].map(|_| draw.angle(0.999e6));
        for (x, (sin, cos)) in angles.into_iter().zip(sin_cos(angles)) {
            let (s, c) = truth::sin_cos(x);
            for error in [s.error(sin, 53), c.error(cos, 53)] {
                assert!(error < 1.0, "{error} at {x:e}");
                worst = worst.max(error);
            }
        }
    }
    worst
}

#[cfg(not(feature = "reproducible"))]
fn worst_single(sin_cos: impl Fn([f32; 8]) -> [(f32, f32); 8]) -> f64 {
    let (mut draw, mut worst) = (Draw(11), 0.0_f64);
    for _ in 0..100_000 {
        let angles = [0; 8].map(|_| draw.angle(12_799.0) as f32);
        for (x, (sin, cos)) in angles.into_iter().zip(sin_cos(angles)) {
            let (s, c) = f64::from(x).sin_cos();
            for error in [truth::Double(s, 0.0).error(sin.into(), 24), truth::Double(c, 0.0).error(cos.into(), 24)] {
                assert!(error < 1.0, "{error} at {x:e}");
                worst = worst.max(error);
            }
        }
    }
    worst
}

/// Through lanes and back.
fn by_lanes<L: Real + SimdValue<Element: Copy>, const N: usize>(
    angles: [<L as SimdValue>::Element; N],
) -> [(<L as SimdValue>::Element, <L as SimdValue>::Element); N] {
    assert_eq!(N % L::LANES, 0);
    let mut pairs = angles.map(|angle| (angle, angle));
    for first in (0..N).step_by(L::LANES) {
        let mut x = L::splat(angles[first]);
        for lane in 0..L::LANES {
            x.replace(lane, angles[first + lane]);
        }
        let (sin, cos) = Real::sin_cos(x);
        for lane in 0..L::LANES {
            pairs[first + lane] = (sin.extract(lane), cos.extract(lane));
        }
    }
    pairs
}

/// With `std-sines` of std's, whose error is below one unit too. What `reproducible` has is judged in `trigonometry`.
#[cfg(not(feature = "reproducible"))]
#[test]
fn error() {
    let doubles = [worst_double(Real::sin_cos_all), worst_double(by_lanes::<WideF64x4, 4>)];
    let singles = [
        worst_single(Real::sin_cos_all),
        worst_single(by_lanes::<WideF32x4, 8>),
        worst_single(by_lanes::<WideF32x8, 8>),
    ];
    println!("f64: at most {doubles:?} ulp, f32: {singles:?}");
}

/// Angles that vectors reduce, that they don't, and what is no angle; neighbours in the list share a vector.
fn odd_angles() -> Vec<f64> {
    let mut draw = Draw(3);
    let huge = (0..20).map(|k| draw.part() * 10f64.powi(5 + k));
    // The number nearest to a multiple of pi/2 is left to `trigonometry`: the platform's cosine of it is eight units off.
    let limits = [1e6, 1_000_000.000_000_1, 12_800.0, 12_800.001];
    let none = [0.0, -0.0, 5e-324, 1e-40, f64::MAX, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    let all: Vec<f64> = huge.chain(limits).chain(none).chain([0.7, -2.1, 3.3, 0.1]).collect();
    // In another order, so that each has every other beside it now and then.
    (0..all.len() * 7).map(|k| all[k * 5 % all.len()] * if k % 3 == 0 { -1.0 } else { 1.0 }).collect()
}

macro_rules! odd {
    ($test:ident, $float:ident, [$($n:literal)+], [$($lanes:ident $size:literal)+]) => {
        #[test]
        fn $test() {
            fn check(x: $float, (sin, cos): ($float, $float), name: &str) {
                let (s, c) = x.sin_cos();
                if !x.is_finite() {
                    return assert!(sin.is_nan() && cos.is_nan(), "{name}, {x:e}");
                }
                // The platform's may be one off itself, on the other side from those of `reproducible`.
                let most = if cfg!(feature = "reproducible") { 2 } else { 1 };
                let apart = |a: $float, b: $float| a.to_bits().abs_diff(b.to_bits());
                assert!(apart(sin, s) <= most && apart(cos, c) <= most, "{name}, {x:e}: {sin:e}, {cos:e}");
            }
            let list: Vec<$float> = odd_angles().into_iter().map(|x| x as $float).collect();
            $(
                for start in 0..list.len() - $n {
                    let angles: [$float; $n] = core::array::from_fn(|k| list[start + k]);
                    for (x, pair) in angles.into_iter().zip(Real::sin_cos_all(angles)) {
                        check(x, pair, concat!($n, " angles"));
                    }
                }
            )+
            $(
                for start in 0..list.len() - $size {
                    let angles: [$float; $size] = core::array::from_fn(|k| list[start + k]);
                    for (x, pair) in angles.into_iter().zip(by_lanes::<$lanes, $size>(angles)) {
                        check(x, pair, stringify!($lanes));
                    }
                }
            )+
        }
    };
}

odd!(doubles, f64, [1 2 3 4 5 6 7 8 9 13], [WideF64x4 4]);
odd!(singles, f32, [1 2 3 4 5 6 7 8 9 17], [WideF32x4 4 WideF32x8 8]);

/// Signs of zeros, and nothing where there is nothing.
#[test]
fn edges() {
    let pairs = Real::sin_cos_all([-0.0_f64, 0.0, -0.0, -1e-300]);
    assert_eq!(pairs.map(|pair| pair.0.to_bits()), [-0.0_f64, 0.0, -0.0, -1e-300].map(f64::to_bits));
    assert_eq!(pairs.map(|pair| pair.1), [1.0; 4]);
    let pairs = Real::sin_cos_all([-0.0_f32, 0.0, -1e-30]);
    assert_eq!(pairs.map(|pair| pair.0.to_bits()), [-0.0_f32, 0.0, -1e-30].map(f32::to_bits));
    let none: [(f64, f64); 0] = Real::sin_cos_all([]);
    assert!(none.is_empty());
}

/// Exactly symmetric, and the same whatever stands beside: what a vector is filled up with is not seen.
#[test]
fn one_angle_is_alone() {
    let mut draw = Draw(5);
    for _ in 0..10_000 {
        let angles = [0; 5].map(|_| draw.angle(2e6));
        let pairs = Real::sin_cos_all(angles);
        let mirrored = Real::sin_cos_all(angles.map(|angle| -angle));
        for (pair, mirror) in pairs.into_iter().zip(mirrored) {
            assert_eq!((pair.0.to_bits(), pair.1.to_bits()), ((-mirror.0).to_bits(), mirror.1.to_bits()));
        }
        if angles.iter().all(|angle| angle.abs() < 1e6) {
            let [a, b, ..] = angles;
            let short = Real::sin_cos_all([a, b]);
            assert_eq!([pairs[0], pairs[1]], short);
            let lanes = Real::sin_cos_all([b, b, a, angles[4]]);
            assert_eq!([lanes[2], lanes[0], lanes[3]], [pairs[0], pairs[1], pairs[4]]);
        }
    }
}

/// Where `reproducible` is on, or std's own sines, several angles have the bits that they have one by one; in lanes with
/// `reproducible`.
#[cfg(any(feature = "reproducible", feature = "std-sines"))]
#[test]
fn one_by_one() {
    let list = odd_angles();
    let bits = |pair: (f64, f64)| [pair.0.to_bits(), pair.1.to_bits()];
    let single_bits = |pair: (f32, f32)| [pair.0.to_bits(), pair.1.to_bits()];
    for start in 0..list.len() - 9 {
        let angles: [f64; 9] = core::array::from_fn(|k| list[start + k]);
        let expected = angles.map(Real::sin_cos);
        assert_eq!(Real::sin_cos_all(angles).map(bits), expected.map(bits));
        let singles = angles.map(|angle| angle as f32);
        let expected = singles.map(Real::sin_cos);
        assert_eq!(Real::sin_cos_all(singles).map(single_bits), expected.map(single_bits));
        if cfg!(feature = "reproducible") {
            let four: [f64; 4] = core::array::from_fn(|k| angles[k]);
            assert_eq!(by_lanes::<WideF64x4, 4>(four).map(bits), four.map(Real::sin_cos).map(bits));
        } else {
            assert_eq!(Real::sin_cos_all(angles).map(bits), angles.map(f64::sin_cos).map(bits));
        }
    }
}

/// Dual numbers take each angle by itself: values and derivatives are those of one alone.
#[cfg(feature = "num-dual")]
#[test]
fn dual_numbers() {
    use num_dual::Dual64;
    let angles = [0.3, -1.7, 2e7, 4.4, -0.0].map(|x| Dual64::new(x, 1.0 + x * 1e-3));
    for (angle, (sin, cos)) in angles.into_iter().zip(Real::sin_cos_all(angles)) {
        assert_eq!((sin, cos), Real::sin_cos(angle));
        assert_eq!((sin.re, cos.re), angle.re.sin_cos());
        assert_eq!((sin.eps, cos.eps), (cos.re * angle.eps, -sin.re * angle.eps));
    }
}

/// A scalar that says nothing of several angles goes one by one, any number of them.
#[test]
fn lanes_of_lanes() {
    let angles: [WideF64x4; 11] =
        core::array::from_fn(|k| WideF64x4::from([0.1, -2.0, 30.0, 1e3].map(|x| x * k as f64)));
    for (angle, pair) in angles.into_iter().zip(Real::sin_cos_all(angles)) {
        let expected = Real::sin_cos(angle);
        assert_eq!((pair.0.into_arr(), pair.1.into_arr()), (expected.0.into_arr(), expected.1.into_arr()));
    }
}
