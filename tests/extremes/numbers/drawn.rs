//! Numbers of every kind, drawn once and handed out again and again.

use multibody::simba::simd::{SimdValue, WideF32x8, WideF64x4};
use multibody::{Configuration, Real, StateSpace, Tangent};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::cell::Cell;

/// Numbers drawn once, handed out again and again.
#[derive(Debug)]
pub(super) struct Numbers {
    drawn: Vec<f64>,
    settings: Vec<f64>,
    next: Cell<usize>,
}

/// A scalar that is made of drawn numbers: in lanes each has its own.
pub(super) trait Drawn: Real {
    fn drawn(n: &Numbers) -> Self;
}

impl Drawn for f64 {
    fn drawn(n: &Numbers) -> Self {
        n.draw()
    }
}

impl Drawn for f32 {
    fn drawn(n: &Numbers) -> Self {
        n.draw() as f32
    }
}

macro_rules! lanes {
    ($($lanes:ident)+) => {
        $(
            impl Drawn for $lanes {
                fn drawn(n: &Numbers) -> Self {
                    let mut x = Self::lit(0.0);
                    for lane in 0..Self::LANES {
                        x.replace(lane, Drawn::drawn(n));
                    }
                    x
                }
            }
        )+
    };
}

lanes!(WideF64x4 WideF32x8);

impl Numbers {
    pub(super) fn draw(&self) -> f64 {
        self.next(&self.drawn)
    }

    /// Of a step, a tolerance, a time, an event: wild also where states are ordinary.
    pub(super) fn setting(&self) -> f64 {
        self.next(&self.settings)
    }

    fn next(&self, numbers: &[f64]) -> f64 {
        let k = self.next.get();
        self.next.set(k + 1);
        numbers[k % numbers.len()]
    }

    pub(super) fn scalar<T: Drawn>(&self) -> T {
        T::drawn(self)
    }

    pub(super) fn vector<T: Drawn, V: Tangent<T>>(&self) -> V {
        V::zero().map(&mut |_| T::drawn(self))
    }

    pub(super) fn state<Z: StateSpace<Scalar: Drawn> + Default>(&self) -> Z {
        let start = Z::default();
        let (q, _, _) = start.split();
        start.join(q.displace(&self.vector()), self.vector(), self.vector())
    }
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -10.0..10.0_f64,
        1 => Just(f64::NAN),
        1 => prop_oneof![Just(f64::INFINITY), Just(f64::NEG_INFINITY)],
        1 => prop_oneof![Just(f64::MAX), Just(-f64::MAX), Just(1e200), Just(-1e155), Just(3e38)],
        1 => prop_oneof![Just(0.0), Just(-0.0)],
        1 => prop_oneof![Just(5e-324), Just(-1e-310), Just(f64::MIN_POSITIVE), Just(1e-200), Just(1e-40)],
    ]
}

/// Draws many sets of numbers, the same in every run: wild ones, and as many of ordinary size, with which motions go on.
/// The environment variable `TIMES` asks for so many times the cases.
pub(super) fn all(cases: u32, check: impl Fn(&Numbers)) {
    let times: u32 = std::env::var("TIMES").map_or(1, |times| times.parse().unwrap());
    let config = Config { failure_persistence: None, cases: cases * times, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let states = prop_oneof![prop::collection::vec(number(), 67), prop::collection::vec(-2.0..2.0_f64, 67)];
    let sets = (states, prop::collection::vec(number(), 61));
    runner
        .run(&sets, |(drawn, settings)| {
            check(&Numbers { drawn, settings, next: Cell::new(0) });
            Ok(())
        })
        .unwrap();
}

/// Whether all components of a state are finite, in every lane.
pub(super) fn finite<Z: StateSpace>(state: &Z) -> bool {
    let (q, v, x) = state.split();
    let zero = Z::Scalar::lit(0.0);
    // Zero times what is not finite is NaN.
    let gap = &mut |sum, x| sum + zero * x;
    let gaps = q.magnitude().fold(zero, gap) + v.fold(zero, gap) + x.fold(zero, gap);
    gaps.greatest() == 0.0
}
