//! The unit of times that mean something on other machines: one sine and cosine of std.
//!
//! Std's sine takes one of several ways, and a processor learns which: of a few arguments over and over it knows them all. Two units
//! are measured: of as few arguments as all other subjects have states, and of more than it can learn, as a sine alone takes that comes once.

use std::f64::consts::PI;
use std::ffi::CStr;

use crate::abi::{Subject, subject};
use crate::export::{COUNT, PROGRAM};
use crate::random::Random;

const KNOWN: &CStr = c"unit";
const UNKNOWN: &CStr = c"unit, arguments that come once";

/// How many angles a unit has, and these in parts of pi.
pub fn states(robot: &CStr) -> Option<(usize, Vec<f64>)> {
    let count = match robot {
        robot if robot == KNOWN => COUNT,
        robot if robot == UNKNOWN => 1 << 16,
        _ => return None,
    };
    let mut random = Random::new(1);
    Some((count, (0..count).map(|_| random.unit()).collect()))
}

macro_rules! sine {
    ($unit:expr) => {
        subject!(
            $unit,
            c"sin_cos",
            PROGRAM,
            1,
            1,
            f64,
            |x| PI * x[0],
            (|angle: &f64| angle.sin_cos()),
            (|_, _, (sine, cosine): (f64, f64)| vec![sine, cosine]),
        )
    };
}

pub const SUBJECTS: &[Subject] = &[sine!(KNOWN), sine!(UNKNOWN)];
