//! Runs a scene and prints what there is to know, one `name: value` a line, without a format that could panic.

use core::hint::black_box;
use core::num::NonZeroU64;

use crate::digest::Digest;
use crate::machine::{self, put};
use crate::random::{Draw, Random};
use crate::{Scalar, Scene};

/// Calls in the hashed sequence.
const CALLS: u32 = 10_000;
/// Inputs for which instructions are counted.
const SAMPLES: u32 = 200;
/// The base of printed numbers: with a divisor that is known not to be zero a division cannot panic.
const TEN: NonZeroU64 = NonZeroU64::MIN.saturating_add(9);
/// Inputs of each kind for which the stack is measured.
const PAINTED: u32 = 16;
/// Kinds of inputs: angles of up to 10,000 rad, which are reduced by subtraction, and all others there are.
const KINDS: [(&str, Draw); 4] = [
    ("", |random| random.within(1e4)),
    (", angles beyond the limit", Random::beyond),
    (", infinity", |_| Scalar::INFINITY),
    (", NaN", |_| Scalar::NAN),
];

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

/// Instructions and stack of a call, where the machine can tell: least and most of each kind of inputs, and the deepest.
fn cost<S: Scene>(scene: &S) {
    let mut random = Random::new();
    let mut output = None;
    let Some(nothing) = machine::instructions(|| ()) else { return };
    for (kind, coordinate) in KINDS {
        let (mut least, mut most) = (u32::MAX, 0);
        for _ in 0..SAMPLES {
            let input = black_box(scene.random(&mut random, coordinate));
            let counted = machine::instructions(|| call(scene, &input, black_box(&mut output))).unwrap_or(0) - nothing;
            (least, most) = (least.min(counted), most.max(counted));
        }
        for (name, counted) in [("instructions, least", least), ("instructions, most", most)] {
            put(name);
            put(kind);
            put(": ");
            decimal(u64::from(counted));
            put("\n");
        }
    }
    let mut deepest = 0;
    for (_, coordinate) in KINDS {
        for _ in 0..PAINTED {
            let input = black_box(scene.random(&mut random, coordinate));
            deepest = deepest.max(machine::stack(|| call(scene, &input, black_box(&mut output))));
        }
    }
    put("stack bytes: ");
    decimal(u64::from(deepest));
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
