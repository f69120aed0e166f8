//! The unit of times that mean something on other machines: one sine and cosine of std.

use std::f64::consts::PI;

use crate::abi::{Subject, subject};
use crate::export::{COUNT, PROGRAM};
use crate::random::Random;

/// Angles in parts of pi.
pub fn states() -> Vec<f64> {
    let mut random = Random::new(1);
    (0..COUNT).map(|_| random.unit()).collect()
}

pub const SUBJECTS: &[Subject] = &[subject!(
    c"unit",
    c"sin_cos",
    PROGRAM,
    1,
    1,
    f64,
    |x| PI * x[0],
    (|angle: &f64| angle.sin_cos()),
    (|_, _, (sine, cosine): (f64, f64)| vec![sine, cosine]),
)];
