//! Stage `emit`: numbers that single precision doesn't hold.
//!
//! In: programs. Out: the numbers beyond the range of `f32`: those that become infinite, and those that become zero or
//! lose digits. Products of literals are literals once a program is written, so looking at these is enough.

use crate::emit::Context;
use crate::mechanics::Inertia;

/// Numbers in order, each once, without signs.
pub(in crate::emit) fn beyond_single(context: &Context<'_>) -> Vec<f64> {
    let compiled = context.compiled;
    let programs = compiled.functions.iter().map(|function| &function.program);
    let inertia = match &compiled.inertia {
        Inertia::Own(program) => Some(program),
        Inertia::Regular | Inertia::Requested => None,
    };
    let programs = programs.chain([&compiled.prelude, &compiled.checks.program]).chain(inertia);
    let mut list: Vec<f64> = programs.flat_map(|program| program.literals()).map(f64::abs).collect();
    list.retain(|&x| is_beyond(x));
    list.sort_by(f64::total_cmp);
    list.dedup();
    list
}

/// Whether `f32` makes infinity, zero, or a number with fewer digits of it.
pub(in crate::emit) fn is_beyond(x: f64) -> bool {
    x != 0.0 && !(f64::from(f32::MIN_POSITIVE)..=f64::from(f32::MAX)).contains(&x.abs())
}
