//! Sine and cosine in plain arithmetic (feature `reproducible`, and without std): error, large angles, symmetry.
//!
//! The reference was computed with 2,000 bits by `runtime/tools/trigonometry.py reference`. All f32 are swept by
//! `cargo bench --features reproducible --bench sines`.
#![cfg(feature = "reproducible")]

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
    for line in include_str!("data/trigonometry.txt").lines() {
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
    let unit = |exact: f64| 2f64.powi((exact.abs().log2().floor() as i32).max(-126) - 23);
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
