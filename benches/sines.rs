//! The error of sine, cosine and the inverse functions in plain `f32` arithmetic, over every finite number from zero on
//! (all but the arc cosine, which is tried on both sides, are exactly symmetric), against double precision; that of the angle
//! of a point over 130 million points.
//!
//! `cargo bench --features reproducible --bench sines`, about five minutes.

use multibody::Real;

/// The distance of numbers next to `exact`, on the side of zero.
fn unit(exact: f64) -> f64 {
    let exponent = (exact.to_bits() >> 52 & 0x7ff).max(1023 - 126);
    f64::from_bits((exponent - 23) << 52)
}

fn main() {
    sines();
    inverse();
    points();
}

fn sines() {
    println!("{:<24}{:>14}{:>14}{:>14}{:>14}", "angles up to", "sine [ulp]", "at", "cosine [ulp]", "at");
    let limits = [1.0_f32, 100.0, 12_800.0, f32::MAX];
    let mut bits = 0_u32;
    for limit in limits {
        let mut worst = [(0.0_f64, 0.0_f32); 2];
        while f32::from_bits(bits) <= limit {
            let x = f32::from_bits(bits);
            let (sin, cos) = Real::sin_cos(x);
            let (s, c) = f64::from(x).sin_cos();
            for (worst, (found, exact)) in worst.iter_mut().zip([(sin, s), (cos, c)]) {
                let error = (f64::from(found) - exact).abs() / unit(exact);
                assert!(!error.is_nan(), "{x:e}: sine {sin:e}, cosine {cos:e}");
                if error > worst.0 {
                    *worst = (error, x);
                }
            }
            bits += 1;
        }
        let [(sine, a), (cosine, b)] = worst;
        println!("{limit:<24e}{sine:>14.3}{a:>14.6e}{cosine:>14.3}{b:>14.6e}");
        assert!(sine < 1.5 && cosine < 1.5, "more than 1.5 units in the last place");
    }
}

/// One number, from zero on.
fn inverse() {
    let (mut tangent, mut sine, mut cosine) = (Worst::default(), Worst::default(), Worst::default());
    for bits in 0..=f32::MAX.to_bits() {
        let x = f32::from_bits(bits);
        let exact = f64::from(x);
        tangent.add(Real::atan(x), exact.atan(), x);
        if x <= 1.0 {
            sine.add(Real::asin(x), exact.asin(), x);
            cosine.add(Real::acos(x), exact.acos(), x);
            cosine.add(Real::acos(-x), (-exact).acos(), -x);
        }
    }
    for (name, worst, bound) in [("atan", tangent, 1.5), ("asin", sine, 2.0), ("acos", cosine, 2.0)] {
        worst.print(name);
        assert!(worst.0 < bound, "more than {bound} units in the last place");
    }
}

/// Eight lengths for each quotient from one half to one, where the reduction is, and for some of the lesser ones.
fn points() {
    let mut worst = Worst::default();
    for bits in (0x3f00_0000..0x3f80_0000_u32).chain((0..0x3f00_0000).step_by(127)) {
        for k in 0..8_u32 {
            let long =
                f32::from_bits(0x3f80_0000 + (k << 20) + (bits.wrapping_mul(2_654_435_769) >> 12) + (k * 5 << 23));
            let short = f32::from_bits(bits) * long;
            let (y, x) = if k & 1 == 0 { (short, long) } else { (long, short) };
            let x = if k & 2 == 0 { x } else { -x };
            worst.add(Real::atan2(y, x), f64::from(y).atan2(x.into()), y);
        }
    }
    worst.print("atan2");
    assert!(worst.0 < 1.5, "more than 1.5 units in the last place");
}

/// The greatest error [ulp], and where.
#[derive(Default)]
struct Worst(f64, f32);

impl Worst {
    fn add(&mut self, found: f32, exact: f64, at: f32) {
        let error = (f64::from(found) - exact).abs() / unit(exact);
        if error > self.0 {
            *self = Self(error, at);
        }
    }

    fn print(&self, name: &str) {
        println!("{name:<24}{:>14.3}{:>14.6e}", self.0, self.1);
    }
}
