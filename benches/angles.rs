//! Sines and cosines of several angles: one by one by std, and all at once by `Real::sin_cos_all`.
//!
//! `cargo bench --bench angles`, and the same with `RUSTFLAGS="-C target-cpu=native"`. Each time is the least of many rounds over a
//! thousand sets of angles between -pi and pi; behind it the time where each set waits for the one before, as the head of
//! an evaluation waits for its sines. Then the error of `f32` in vectors, over all angles up to the limit of 12,800 rad, against
//! double precision (without `reproducible` and `std-sines`).

use std::hint::black_box;
use std::time::Instant;

use multibody::Real;

const SETS: usize = 1_000;
const ROUNDS: usize = 400;

fn main() {
    println!("[ns]         f64: throughput       latency      f32: throughput       latency");
    println!("angles       std   all ratio   std   all ratio   std   all ratio   std   all ratio");
    macro_rules! lines {
        ($($n:literal)+) => { $(
            print!("{:>6}    ", $n);
            compare::<f64, $n>(|angles| angles.map(f64::sin_cos));
            compare::<f32, $n>(|angles| angles.map(f32::sin_cos));
            println!();
        )+ };
    }
    lines!(1 2 3 4 5 6 7 8 9 10 11 12);
    sweep();
}

/// Every number from zero on; what is negative is exactly symmetric.
fn sweep() {
    let mut worst = [(0.0_f64, 0.0_f32); 2];
    for first in (0..=12_800.0_f32.to_bits()).step_by(8) {
        let angles: [f32; 8] = core::array::from_fn(|k| f32::from_bits(first + k as u32));
        for (x, (sin, cos)) in angles.into_iter().zip(Real::sin_cos_all(angles)) {
            let (s, c) = f64::from(x).sin_cos();
            for (worst, (found, exact)) in worst.iter_mut().zip([(sin, s), (cos, c)]) {
                let error = (f64::from(found) - exact).abs() / unit(exact);
                assert!(error < 1.0, "{x:e}: sine {sin:e}, cosine {cos:e}");
                if error > worst.0 {
                    *worst = (error, x);
                }
            }
        }
    }
    println!(
        "error of all f32 up to 12,800 rad [ulp]: sine {:.3} at {:e}, cosine {:.3} at {:e}",
        worst[0].0, worst[0].1, worst[1].0, worst[1].1
    );
}

/// The distance of numbers next to `exact`, on the side of zero, as `f32` has them.
fn unit(exact: f64) -> f64 {
    let exponent = (exact.to_bits() >> 52 & 0x7ff).max(1023 - 126);
    f64::from_bits((exponent - 23) << 52)
}

fn compare<T: Real, const N: usize>(std: impl Fn([T; N]) -> [(T, T); N]) {
    let sets = sets::<T, N>();
    // In turns, so that what else the machine does falls on both.
    let mut least = [f64::INFINITY; 4];
    for _ in 0..ROUNDS {
        let now = [
            independent(&sets, &std),
            independent(&sets, &T::sin_cos_all::<N>),
            waiting(&std),
            waiting(&T::sin_cos_all::<N>),
        ];
        least.iter_mut().zip(now).for_each(|(least, now)| *least = least.min(now));
    }
    for pair in least.chunks(2) {
        print!("{:>6.1}{:>6.1}{:>6.2}", pair[0], pair[1], pair[0] / pair[1]);
    }
}

fn sets<T: Real, const N: usize>() -> Vec<[T; N]> {
    let mut state = 1_u64;
    let mut angle = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        T::lit(((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0) * core::f64::consts::PI)
    };
    (0..SETS).map(|_| core::array::from_fn(|_| angle())).collect()
}

/// [ns] for each set.
fn independent<T: Real, const N: usize>(sets: &[[T; N]], function: &impl Fn([T; N]) -> [(T, T); N]) -> f64 {
    let start = Instant::now();
    for set in sets {
        black_box(function(*black_box(set)));
    }
    start.elapsed().as_secs_f64() * 1e9 / SETS as f64
}

/// [ns] for each set, whose angles are made of the sines before.
fn waiting<T: Real, const N: usize>(function: &impl Fn([T; N]) -> [(T, T); N]) -> f64 {
    let mut angles: [T; N] = core::array::from_fn(|k| T::lit(0.3 + k as f64));
    let start = Instant::now();
    for _ in 0..SETS {
        let pairs = function(angles);
        angles = core::array::from_fn(|k| pairs[k].0 + pairs[k].0 + pairs[(k + 1) % N].1);
    }
    let time = start.elapsed().as_secs_f64() * 1e9 / SETS as f64;
    black_box(angles);
    time
}
