//! Lanes agree with scalars, for ordinary values and at the edges, and NaN is never lost.

use multibody::simba::simd::{SimdBool, SimdValue, WideF32x4, WideF32x8, WideF64x4};
use multibody::{Real, all, any};

/// Angles from zero to beyond every limit, both signs, and what is no angle.
fn values() -> impl Iterator<Item = f64> {
    let spread = (-300..=300).map(|k| f64::from(k) * 0.037);
    let growing = (-30..36).map(|k| 1.7 * 10f64.powi(k));
    let odd = [0.0, -0.0, 1e300, 5e-324, f64::INFINITY, f64::NAN, core::f64::consts::PI, 1e6, 1.000_001e6, 1e3];
    spread.chain(growing).chain(odd).flat_map(|x| [x, -x])
}

/// Equal to a few roundings of one (absolute, as for a sine) or of the value, or both NaN.
fn close(a: f64, b: f64, rounding: f64) -> bool {
    (a.is_nan() && b.is_nan()) || a == b || (a - b).abs() <= rounding * (1.0 + b.abs())
}

macro_rules! agreement {
    ($test:ident, $lanes:ty, $element:ident) => {
        #[test]
        fn $test() {
            type Element = $element;
            let rounding = 2.5 * f64::from(Element::EPSILON);
            let unary: [(&str, fn($lanes) -> $lanes, fn(Element) -> Element); 18] = [
                ("sin", |x| Real::sin_cos(x).0, |x| Real::sin_cos(x).0),
                ("cos", |x| Real::sin_cos(x).1, |x| Real::sin_cos(x).1),
                ("sin", Real::sin, Real::sin),
                ("cos", Real::cos, Real::cos),
                ("asin", Real::asin, Real::asin),
                ("acos", Real::acos, Real::acos),
                ("atan", Real::atan, Real::atan),
                ("sinh", Real::sinh, Real::sinh),
                ("cosh", Real::cosh, Real::cosh),
                ("tanh", Real::tanh, Real::tanh),
                ("exp", Real::exp, Real::exp),
                ("ln", Real::ln, Real::ln),
                ("sqrt", Real::sqrt, Real::sqrt),
                ("abs", Real::abs, Real::abs),
                ("signum", Real::signum, Real::signum),
                ("floor", Real::floor, Real::floor),
                ("powi 3", |x| Real::powi(x, 3), |x| Real::powi(x, 3)),
                ("powi -2", |x| Real::powi(x, -2), |x| Real::powi(x, -2)),
            ];
            let binary: [(&str, fn($lanes, $lanes) -> $lanes, fn(Element, Element) -> Element); 6] = [
                ("atan2", Real::atan2, Real::atan2),
                ("powf", Real::powf, Real::powf),
                ("hypot", Real::hypot, Real::hypot),
                ("min", Real::min, Real::min),
                ("max", Real::max, Real::max),
                ("select", |a, b| Real::select(Real::lt(a, b), a, b), |a, b| if a < b { a } else { b }),
            ];
            let lanes = <$lanes as SimdValue>::LANES;
            // Neighbours in the list share a register, so every function sees its edges beside ordinary values.
            let list: Vec<Element> = values().map(|x| x as Element).collect();
            for (start, _) in list.iter().enumerate() {
                let mut x = <$lanes as Real>::lit(0.5);
                let mut y = <$lanes as Real>::lit(0.5);
                for lane in 0..lanes {
                    x.replace(lane, list[(start + lane) % list.len()]);
                    y.replace(lane, list[(start + 7 * lane + 3) % list.len()]);
                }
                for lane in 0..lanes {
                    let (a, b) = (x.extract(lane), y.extract(lane));
                    for (name, in_lanes, scalar) in &unary {
                        let (got, want) = (in_lanes(x).extract(lane), scalar(a));
                        assert!(close(got.into(), want.into(), rounding), "{name}({a:e}) = {got:e}, not {want:e}");
                    }
                    for (name, in_lanes, scalar) in &binary {
                        let (got, want) = (in_lanes(x, y).extract(lane), scalar(a, b));
                        assert!(
                            close(got.into(), want.into(), rounding),
                            "{name}({a:e}, {b:e}) = {got:e}, not {want:e}"
                        );
                    }
                    let masks = [
                        (Real::lt(x, y), a < b),
                        (Real::le(x, y), a <= b),
                        (Real::gt(x, y), a > b),
                        (Real::ge(x, y), a >= b),
                        (Real::eq(x, y), a == b),
                        (Real::ne(x, y), a != b),
                        (Real::is_finite(x), a.is_finite()),
                    ];
                    if a.abs() < 1.5 {
                        let (got, want) = (Real::tan(x).extract(lane), Real::tan(a));
                        assert!(close(got.into(), want.into(), rounding), "tan({a:e}) = {got:e}, not {want:e}");
                    }
                    for (k, (mask, expected)) in masks.into_iter().enumerate() {
                        assert_eq!((mask.bitmask() >> lane) & 1 == 1, expected, "comparison {k} of {a:e} and {b:e}");
                    }
                }
            }
        }
    };
}

agreement!(four_doubles, WideF64x4, f64);
agreement!(four_singles, WideF32x4, f32);
agreement!(eight_singles, WideF32x8, f32);

#[test]
fn nan_is_not_lost() {
    fn check<T: Real>() {
        let (nan, one) = (T::lit(f64::NAN), T::lit(1.0));
        for result in [Real::min(nan, one), Real::min(one, nan), Real::max(nan, one), Real::max(one, nan)] {
            assert!(result.greatest().is_nan());
        }
        assert_eq!(Real::min(T::lit(2.0), one).greatest(), 1.0);
        assert_eq!(Real::max(T::lit(2.0), one).greatest(), 2.0);
        assert!(!any(Real::eq(nan, nan)) && all(Real::ne(nan, nan)) && !any(Real::is_finite(nan)));
        assert_eq!(Real::select(Real::lt(one, nan), nan, one).greatest(), 1.0);
    }
    check::<f32>();
    check::<f64>();
    check::<WideF64x4>();
    check::<WideF32x4>();
    check::<WideF32x8>();
    let one_lane = WideF64x4::from([1.0, 2.0, f64::NAN, 0.0]);
    assert!(one_lane.greatest().is_nan());
    assert_eq!(WideF64x4::from([1.0, 7.0, -3.0, 0.0]).greatest(), 7.0);
}

/// The sine and cosine of f32 angles of every size, against f64, and exactly symmetric. Without std this is the
/// library's own function, otherwise the platform's.
#[test]
fn single_sine() {
    let mut worst = 0.0f64;
    for k in 0..4_000_000u32 {
        // Half of them are in the range that is reduced in f32, half spread over all finite numbers.
        let bits = if k % 2 == 0 { k.wrapping_mul(2_147_483) % 0x7f80_0000 } else { 0x3a00_0000 + k * 24 };
        let x = f32::from_bits(bits);
        let (sin, cos) = Real::sin_cos(x);
        let (s, c) = f64::from(x).sin_cos();
        worst = worst.max((f64::from(sin) - s).abs()).max((f64::from(cos) - c).abs());
        assert_eq!((Real::sin(-x), Real::cos(-x)), (-sin, cos), "{x:e}");
    }
    assert!(worst < 0.9e-7, "{worst:e}");
    assert!(Real::sin(f32::NAN).is_nan() && Real::cos(f32::INFINITY).is_nan());
    assert_eq!(Real::sin(1e-20f32), 1e-20);
    assert_eq!(Real::sin(-0.0f32).to_bits(), (-0.0f32).to_bits());
}
