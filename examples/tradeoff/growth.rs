//! How much a problem itself magnifies an error: the norm of the derivative of the motion by its start.

use multibody::{Differentiable, Dop853, Integrator, Radau, Tangent, VelocityOf};

use crate::bench::Kind;
use crate::reference::Truth;
use crate::subject::{Observer, Subject, displaced};

/// The end of an accurate run, by the implicit method for stiff scenes.
pub(crate) fn accurate<S: Differentiable<Scalar = f64, Input = ()>>(
    subject: &Subject<S>,
    kind: Kind,
    end: f64,
    state: &S::State,
    observe: Observer<'_, S>,
) -> S::State {
    let system = &subject.system;
    let run = if kind == Kind::Stiff {
        Integrator::adaptive(Radau, 1e-12, 1e-12).integrate(system, 0.0, end, state, &(), observe)
    } else {
        Integrator::adaptive(Dop853, 1e-13, 1e-13).integrate(system, 0.0, end, state, &(), observe)
    };
    run.expect("the scenes' motions are smooth").0
}

/// The greatest ratio of an error at the end to one at the start, both measured as in [`Truth::error`]; at least one.
///
/// By central differences of accurate runs, one for each coordinate and velocity.
pub(crate) fn growth<S: Differentiable<Scalar = f64, Input = ()>>(
    subject: &Subject<S>,
    truth: &Truth,
    kind: Kind,
) -> f64 {
    let differences = |state: &S::State| {
        let end = accurate(subject, kind, truth.end, state, &mut |_, _| ());
        truth.differences(&(subject.motion)(&end))
    };
    let count = VelocityOf::<S>::zero().len();
    let start = (subject.motion)(&subject.start);
    let scale = |list: &[f64]| list.iter().fold(1.0_f64, |most, x| most.max(1.0 + x.abs()));
    let mut rows = Vec::new();
    for number in 0..2 * count {
        let by = 1e-7 * scale(if number < count { &start.q } else { &start.v });
        let ahead = differences(&displaced::<S>(&subject.start, number, by));
        let behind = differences(&displaced::<S>(&subject.start, number, -by));
        rows.resize(ahead.len(), 0.0);
        for (row, (ahead, behind)) in rows.iter_mut().zip(ahead.iter().zip(behind)) {
            *row += (ahead - behind).abs() / 2e-7;
        }
    }
    rows.into_iter().fold(1.0, f64::max)
}
