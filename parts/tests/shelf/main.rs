//! Parts against closed solutions, and machines made of parts against their balance of energy.

/// Stored and lost, less supplied, over a run.
macro_rules! balanced {
    ($what:expr, $model:expr, $start:expr, $input:expr, $time:expr, $steps:expr) => {{
        let (model, start, input, steps) = ($model, $start, $input, $steps / 10);
        let sum = |t: f64, x| {
            let y = model.outputs(t, x, &input);
            y.stored + y.gone
        };
        let (first, mut x) = (sum(0.0, &start), start);
        let kept = model.outputs(0.0, &start, &input).stored;
        let (mut size, step) = (first.abs().max(1.0), $time / 10.0);
        let mut moved: f64 = 0.0;
        for part in 0..10 {
            let t = step * f64::from(part);
            x = multibody::Rk4::integrate(&model, t, &x, &input, step / f64::from(steps), steps, |_, _| ()).unwrap();
            let y = model.outputs(t + step, &x, &input);
            size = size.max(y.stored.abs());
            moved = moved.max((y.stored - kept).abs());
            let off = (y.stored + y.gone - first).abs();
            assert!(off <= 1e-9 * size, "{} at {t}: {off} of {size}", $what);
        }
        assert!(moved > 1e-3 * size, "{} hardly moves", $what);
        x
    }};
}

mod cars;
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
