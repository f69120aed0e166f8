//! Sine, cosine and inverse functions in plain arithmetic (feature `reproducible`, and without std): error, large angles,
//! quadrants, symmetry.
//!
//! The references were computed with 2,000 bits by `runtime/tools/trigonometry.py`. All f32 are swept by
//! `cargo bench --features reproducible --bench sines`.

use multibody::Real;

/// [ulp] for `f32`; all of them swept gave 1.31, 1.39 and 1.44 up to one, up to the limit of subtraction, and beyond.
const BOUND: f64 = 1.5;

/// How many numbers two of one sign lie apart.
macro_rules! apart {
    ($a:expr, $b:expr) => {{
        let (a, b) = ($a, $b);
        assert_eq!(a.is_sign_negative(), b.is_sign_negative(), "{a:e} {b:e}");
        a.to_bits().abs_diff(b.to_bits())
    }};
}

#[test]
fn reference() {
    let (mut lines, mut worst) = (0, [0; 2]);
    for line in include_str!("../data/trigonometry.txt").lines() {
        let mut fields = line.split(' ');
        let name = fields.next().unwrap();
        let bits: Vec<u64> = fields.map(|field| u64::from_str_radix(field, 16).unwrap()).collect();
        let (found, k) = if name == "f32" {
            let [x, sin, cos] = [0, 1, 2].map(|k| f32::from_bits(bits[k] as u32));
            let (s, c) = Real::sin_cos(x);
            (apart!(s, sin).max(apart!(c, cos)).into(), 0)
        } else {
            let [x, sin, cos] = [0, 1, 2].map(|k| f64::from_bits(bits[k]));
            let (s, c) = Real::sin_cos(x);
            (apart!(s, sin).max(apart!(c, cos)), 1)
        };
        worst[k] = worst[k].max(found);
        assert!(found <= 1, "{line}: {found}");
        lines += 1;
    }
    println!("{lines} angles, at most {worst:?} numbers apart");
    assert_eq!(lines, 661);
}

#[test]
fn single() {
    let mut worst = 0.0f64;
    for k in 0..2_000_000_u32 {
        // Half of them up to 12,800, half over all finite numbers.
        let bits = if k % 2 == 0 { k.wrapping_mul(2_147_483) % 0x7f80_0000 } else { 0x3a00_0000 + k * 103 };
        let x = f32::from_bits(bits);
        let (sin, cos) = Real::sin_cos(x);
        let (s, c) = f64::from(x).sin_cos();
        assert!(sin.is_finite() && cos.is_finite(), "{x:e}"); // `max` below passes over NaN
        if x > 1e-30 {
            worst = worst.max((f64::from(sin) - s).abs() / unit(s)).max((f64::from(cos) - c).abs() / unit(c));
        }
        let mirrored = Real::sin_cos(-x);
        assert_eq!((mirrored.0.to_bits(), mirrored.1.to_bits()), ((-sin).to_bits(), cos.to_bits()), "{x:e}");
    }
    println!("error at most {worst} ulp");
    assert!(worst < BOUND);
}

#[test]
fn double() {
    let mut state = 1_u64;
    for _ in 0..1_000_000 {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let x = f64::from_bits((state >> 2) % (0x7ff << 52));
        let (sin, cos) = Real::sin_cos(x);
        let (s, c) = x.sin_cos(); // the platform's, which may be one off itself
        assert!(sin.is_finite() && cos.is_finite(), "{x:e}");
        assert!(apart!(sin, s) <= 1 && apart!(cos, c) <= 1, "{x:e}");
        let mirrored = Real::sin_cos(-x);
        assert_eq!((mirrored.0.to_bits(), mirrored.1.to_bits()), ((-sin).to_bits(), cos.to_bits()), "{x:e}");
    }
}

#[test]
fn edges() {
    fn check<T: Real + std::fmt::Debug>() {
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let (sin, cos) = Real::sin_cos(T::lit(wrong));
            assert!(multibody::all(Real::ne(sin, sin) & Real::ne(cos, cos)));
        }
        assert_eq!(Real::sin_cos(T::lit(0.0)), (T::lit(0.0), T::lit(1.0)));
        assert_eq!(Real::sin_cos(T::lit(1e-30)), (T::lit(1e-30), T::lit(1.0)));
    }
    check::<f32>();
    check::<f64>();
    assert!(Real::sin(-0.0f32).is_sign_negative() && Real::sin(-0.0f64).is_sign_negative());
}

/// Distance of numbers next to `exact`, on the side of zero, as `f32` has them.
fn unit(exact: f64) -> f64 {
    2f64.powi((exact.abs().log2().floor() as i32).max(-126) - 23)
}

#[test]
fn inverse_reference() {
    let (mut lines, mut worst) = (0, [0; 2]);
    for line in include_str!("../data/arctangent.txt").lines() {
        let mut fields = line.split(' ');
        let name = fields.next().unwrap();
        let bits: Vec<u64> = fields.map(|field| u64::from_str_radix(field, 16).unwrap()).collect();
        let (found, k) = if name == "f32" {
            let [y, x, angle] = [0, 1, 2].map(|k| f32::from_bits(bits[k] as u32));
            (apart!(Real::atan2(y, x), angle).into(), 0)
        } else {
            let [y, x, angle] = [0, 1, 2].map(|k| f64::from_bits(bits[k]));
            (apart!(Real::atan2(y, x), angle), 1)
        };
        worst[k] = worst[k].max(found);
        assert!(found <= 1, "{line}: {found}");
        lines += 1;
    }
    println!("{lines} points, at most {worst:?} numbers apart");
    assert_eq!(lines, 1200);
}

#[test]
fn inverse_single() {
    let (mut worst, mut state) = ([0.0f64; 4], 1_u64);
    for k in 0..2_000_000_u32 {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let (high, low) = ((state >> 33) as u32, (state >> 9) as u32);
        // Half of them of like size, half over all finite numbers.
        let range = if k % 2 == 0 { 0x7f80_0000 } else { 0x0200_0000 };
        let [y, x] = [high, low].map(|bits| bits % range + if k % 2 == 0 { 0 } else { 0x3e80_0000 });
        let [y, x] = [y | high << 31, x | low << 31].map(f32::from_bits);
        let angle = Real::atan2(y, x);
        let part = (f64::from(high) / f64::from(1_u32 << 30) - 1.0) as f32;
        let all = [
            (angle, f64::from(y).atan2(x.into())),
            (Real::atan(y), f64::from(y).atan()),
            (Real::asin(part), f64::from(part).asin()),
            (Real::acos(part), f64::from(part).acos()),
        ];
        for (worst, (found, exact)) in worst.iter_mut().zip(all) {
            *worst = worst.max((f64::from(found) - exact).abs() / unit(exact));
        }
        assert_eq!(Real::atan2(-y, x).to_bits(), (-angle).to_bits(), "{y:e} {x:e}");
        // All instances are equal, wherever they are called from.
        assert_eq!(Real::atan(y).to_bits(), Real::atan2(y, 1.0).to_bits());
    }
    println!("error of atan2, atan, asin, acos at most {worst:?} ulp");
    assert!(worst[0] < 1.0 && worst[1] < 1.0 && worst[2] < 2.0 && worst[3] < 2.0);
}

#[test]
fn inverse_double() {
    let (mut worst, mut state) = ([0; 4], 1_u64);
    for k in 0..1_000_000 {
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            state >> 1
        };
        let (range, from) = if k % 2 == 0 { (0x7ff << 52, 0) } else { (4 << 52, 1021 << 52) };
        let [y, x] = [next(), next()].map(|bits| (bits % range + from) | (bits << 63)).map(f64::from_bits);
        let part = next() as f64 / (1_u64 << 62) as f64 - 1.0;
        // the platform's, which may be one off itself
        let all = [
            apart!(Real::atan2(y, x), y.atan2(x)),
            apart!(Real::atan(y), y.atan()),
            apart!(Real::asin(part), part.asin()),
            apart!(Real::acos(part), part.acos()),
        ];
        for (worst, found) in worst.iter_mut().zip(all) {
            *worst = found.max(*worst);
        }
    }
    println!("atan2, atan, asin, acos at most {worst:?} numbers apart");
    assert!(worst[0] <= 1 && worst[1] <= 1 && worst[2] <= 2 && worst[3] <= 2);
}

/// Zeros, infinities and NaN as IEEE 754 has them for `atan2`, which the platform follows.
#[test]
fn inverse_edges() {
    macro_rules! check {
        ($float:ident) => {
            let values = [0.0, $float::from_bits(1), 1e-20, 1.0, 1e20, $float::MAX, $float::INFINITY, $float::NAN];
            let values = values.map(|value| [value, -value]).concat();
            for &y in &values {
                for &x in &values {
                    let (found, exact): ($float, $float) = (Real::atan2(y, x), y.atan2(x));
                    // The platform's may be one off itself, but where the result is zero it is exact.
                    let same = if exact.is_nan() {
                        found.is_nan()
                    } else {
                        apart!(found, exact) <= u8::from(exact != 0.0).into()
                    };
                    assert!(same, "{y:e} {x:e}: {found:e} {exact:e}");
                }
            }
            for x in [-1.0 as $float, 0.0, -0.0, 1.0] {
                assert_eq!(Real::asin(x).to_bits(), x.asin().to_bits());
                assert_eq!(Real::acos(x).to_bits(), x.acos().to_bits());
            }
            for x in [1.0 + $float::EPSILON, -1e30, $float::INFINITY, $float::NAN] {
                assert!(Real::asin(x).is_nan() && Real::acos(x).is_nan());
            }
        };
    }
    check!(f32);
    check!(f64);
}
