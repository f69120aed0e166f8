//! Runs a scene and prints what there is to know, one `name: value` a line, without a format that could panic.

use core::hint::black_box;
use core::num::NonZeroU64;

use crate::digest::Digest;
use crate::machine::{self, put};
use crate::random::Random;
use crate::{Scalar, Scene};

/// Calls in the hashed sequence.
const CALLS: u32 = 10_000;
/// Inputs for which instructions are counted.
const SAMPLES: u32 = 200;
/// The base of printed numbers: with a divisor that is known not to be zero a division cannot panic.
const TEN: NonZeroU64 = NonZeroU64::MIN.saturating_add(9);
/// [rad] the greatest random angle
const SPAN: Scalar = 1e4;

/// The call by itself, so that it can be counted.
#[inline(never)]
fn call<S: Scene>(scene: &S, input: &S::Input, output: &mut Option<S::Output>) {
    *output = Some(scene.call(input));
}

/// Reports on a scene.
pub fn run<S: Scene>() {
    let scene = black_box(S::default());
    put("scene: ");
    put(S::NAME);
    put(if size_of::<Scalar>() == 4 { ", f32\n" } else { ", f64\n" });

    put("first result:");
    S::numbers(&scene.call(&scene.start()), micro);
    put("\n");

    put("hash of 10000 results: ");
    hexadecimal(digest(&scene).value());
    put("\n");
    cost(&scene);
}

/// The hash of the sequence.
pub(crate) fn digest<S: Scene>(scene: &S) -> Digest {
    let mut digest = Digest::new();
    let mut input = scene.start();
    for _ in 0..CALLS {
        let output = scene.call(&input);
        S::numbers(&output, |number| digest.add(number));
        input = scene.next(&input, &output);
    }
    digest
}

/// Instructions and stack of a call, where the machine can tell.
fn cost<S: Scene>(scene: &S) {
    let mut random = Random::new();
    let mut output = None;
    let Some(nothing) = machine::instructions(|| ()) else { return };
    let mut count = |input: &S::Input| {
        let input = black_box(*input);
        machine::instructions(|| call(scene, &input, black_box(&mut output))).unwrap_or(0) - nothing
    };
    let (mut least, mut most) = (u32::MAX, 0);
    for _ in 0..SAMPLES {
        let counted = count(&scene.random(&mut random, SPAN));
        (least, most) = (least.min(counted), most.max(counted));
    }
    put("instructions, least: ");
    decimal(u64::from(least));
    put("\ninstructions, most: ");
    decimal(u64::from(most));
    put("\ninstructions, NaN: ");
    decimal(u64::from(count(&scene.random(&mut random, Scalar::NAN))));
    put("\ninstructions, angles beyond the limit: ");
    decimal(u64::from(count(&scene.random(&mut random, 1e9))));
    let input = scene.random(&mut random, 1.0);
    let used = machine::stack(|| call(scene, &input, black_box(&mut output)));
    put("\nstack bytes: ");
    decimal(u64::from(used));
    put("\n");
}

/// Prints a number in millionths.
fn micro(number: Scalar) {
    let scaled = (number * 1e6) as i64;
    put(if scaled < 0 { " -" } else { " " });
    decimal(scaled.unsigned_abs());
    put("e-6");
}

fn decimal(number: u64) {
    let mut power = NonZeroU64::MIN;
    while number / power >= 10 {
        power = power.saturating_mul(TEN);
    }
    loop {
        digit((number / power % TEN) as u8);
        let Some(next) = NonZeroU64::new(power.get() / TEN) else { break };
        power = next;
    }
}

fn hexadecimal(number: u64) {
    for k in (0..16).rev() {
        digit((number >> (4 * k) & 15) as u8);
    }
}

/// One digit to the base of sixteen.
fn digit(value: u8) {
    let character = [if value < 10 { b'0' + value } else { b'a' - 10 + value }];
    put(core::str::from_utf8(&character).unwrap_or("?"));
}
