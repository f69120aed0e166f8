//! The error of sine and cosine in plain `f32` arithmetic, over every finite number from zero on (the functions are
//! exactly symmetric), against double precision.
//!
//! `cargo bench --features reproducible --bench sines`, about two minutes.

use multibody::Real;

/// The distance of numbers next to `exact`, on the side of zero.
fn unit(exact: f64) -> f64 {
    let exponent = (exact.to_bits() >> 52 & 0x7ff).max(1023 - 126);
    f64::from_bits((exponent - 23) << 52)
}

fn main() {
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
