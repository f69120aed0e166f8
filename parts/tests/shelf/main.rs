//! Parts against closed solutions, and machines made of parts against their balance of energy.

mod control;
mod drives;
mod fluids;
mod machines;
mod stops;
mod tyres;

use multibody::{Rk4, System};

/// The state after some time at constant input.
fn after<S: System<Scalar = f64>>(system: &S, start: &S::State, input: &S::Input, time: f64, steps: u32) -> S::State
where
    S::State: Copy,
{
    let step = time / f64::from(steps);
    Rk4::integrate(system, 0.0, start, input, step, steps, |_, _| ()).expect("the motion is finite")
}

#[track_caller]
fn close(what: &str, found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() <= tolerance * wanted.abs().max(1e-3), "{what}: {found} in place of {wanted}");
}
