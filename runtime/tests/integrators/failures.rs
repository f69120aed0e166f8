//! Integrations that fail: every bad input ends in a typed error that says where, and every bound is kept.

use crate::common::{Oscillator, Scalar, counted};
use core::marker::PhantomData;
use multibody::{DormandPrince, IntegrationError, Integrator, Rk4, System, Tolerance};

const OSCILLATOR: Oscillator<f64> = Oscillator(PhantomData);
const START: Scalar<f64> = Scalar { q: 1.0, v: 0.0 };

#[test]
fn bad_numbers_end_in_typed_errors() {
    let adaptive = Tolerance::new(1e-6, 1e-6);
    let run = |tolerance, t0, t1, start, input| {
        Integrator::within(DormandPrince, tolerance).integrate(&OSCILLATOR, t0, t1, &start, &input, |_, _| ())
    };
    for bad in [f64::NAN, f64::INFINITY] {
        for (start, input) in [(Scalar { q: bad, v: 0.0 }, 0.0), (Scalar { q: 0.0, v: bad }, 0.0), (START, bad)] {
            assert_eq!(run(adaptive, 2.0, 3.0, start, input).unwrap_err(), IntegrationError::NonFinite { time: 2.0 });
            let fixed = Rk4::integrate(&OSCILLATOR, 2.0, &start, &input, 0.1, 5, |_, _| ());
            assert_eq!(fixed.unwrap_err(), IntegrationError::NonFinite { time: 2.0 });
        }
        let invalid = [
            run(adaptive, bad, 1.0, START, 0.0),
            run(adaptive, 0.0, bad, START, 0.0),
            run(Tolerance { relative: bad, ..adaptive }, 0.0, 1.0, START, 0.0),
            run(Tolerance { absolute: bad, ..adaptive }, 0.0, 1.0, START, 0.0),
            run(Tolerance { first_step: bad, ..adaptive }, 0.0, 1.0, START, 0.0),
            run(Tolerance { max_step: -bad, ..adaptive }, 0.0, 1.0, START, 0.0),
            run(Tolerance { absolute: 0.0, ..adaptive }, 0.0, 1.0, START, 0.0),
            run(Tolerance { relative: -1.0, ..adaptive }, 0.0, 1.0, START, 0.0),
            run(Tolerance { min_step: f64::NAN, ..adaptive }, 0.0, 1.0, START, 0.0),
            run(Tolerance { min_step: 0.2, max_step: 0.1, ..adaptive }, 0.0, 1.0, START, 0.0),
            run(adaptive, -1e308, 1e308, START, 0.0),
        ];
        for result in invalid {
            assert!(matches!(result, Err(IntegrationError::InvalidArgument { .. })), "{result:?}");
        }
    }
    let single = Oscillator(PhantomData);
    let result = Integrator::adaptive(DormandPrince, 1e-6, 1e-60).integrate(
        &single,
        0.0,
        1.0,
        &Scalar { q: 1f32, v: 0.0 },
        &0.0,
        |_, _| (),
    );
    assert!(matches!(result, Err(IntegrationError::InvalidArgument { .. })), "zero in f32: {result:?}");
}

#[test]
fn a_run_that_meets_nan_says_where() {
    let system = counted(OSCILLATOR, 1.5);
    let mut reached = 0.0;
    let result =
        Integrator::adaptive(DormandPrince, 1e-6, 1e-6).integrate(&system, 0.0, 3.0, &START, &0.0, |t, _| reached = t);
    let Err(IntegrationError::NonFinite { time }) = result else { panic!("{result:?}") };
    assert_eq!(time, reached);
    assert!((time - 1.5).abs() < 1e-6, "{time}");
    assert!(system.evaluations.get() < 2000);
}

/// `q'' = v^3`: the velocity reaches infinity in finite time.
struct Explosion;

impl System for Explosion {
    type Scalar = f64;
    type State = Scalar<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, state: &Scalar<f64>, (): &()) -> (f64, ()) {
        (state.v.powi(3), ())
    }
    fn position_rates(&self, _t: f64, state: &Scalar<f64>) -> f64 {
        state.v
    }
}

#[test]
fn a_pole_ends_the_run() {
    let start = Scalar { q: 0.0, v: 1.0 }; // the pole is at one half
    let result =
        Integrator::adaptive(DormandPrince, 1e-8, 1e-8).integrate(&Explosion, 0.0, 1.0, &start, &(), |_, _| ());
    match result {
        Err(IntegrationError::StepTooSmall { time, .. } | IntegrationError::NonFinite { time }) => {
            assert!((time - 0.5).abs() < 1e-3, "{time}");
        }
        other => panic!("{other:?}"),
    }
    let result = Rk4::integrate(&Explosion, 0.0, &start, &(), 0.01, 1000, |_, _| ());
    assert!(matches!(result, Err(IntegrationError::NonFinite { time }) if time < 0.7), "{result:?}");
}

#[test]
fn bounds_are_kept() {
    let few = Integrator::adaptive(DormandPrince, 1e-9, 1e-9).max_steps(7);
    let mut reached = 0.0;
    let result = few.integrate(&OSCILLATOR, 0.0, 100.0, &START, &0.0, |t, _| reached = t);
    assert_eq!(result.unwrap_err(), IntegrationError::TooManySteps { time: reached });

    let coarse = Integrator::within(DormandPrince, Tolerance { min_step: 0.5, ..Tolerance::new(1e-12, 1e-12) });
    let result = coarse.integrate(&OSCILLATOR, 0.0, 100.0, &START, &0.0, |_, _| ());
    assert!(matches!(result, Err(IntegrationError::StepTooSmall { step, .. }) if step <= 0.5), "{result:?}");

    let short = Integrator::within(DormandPrince, Tolerance { max_step: 0.01, ..Tolerance::new(1e-3, 1e-3) });
    let mut last = 0.0;
    let (_, statistics) = short
        .integrate(&OSCILLATOR, 0.0, 1.0, &START, &0.0, |t, _| {
            assert!(t - last < 0.010_11);
            last = t;
        })
        .unwrap();
    assert!((99..=101).contains(&statistics.accepted));

    // The least step is one that may be taken, whatever the rounding of times.
    for (step, t0) in [(0.01, 0.0), (0.01, 0.3), (0.3, -0.1), (0.07, 1e3)] {
        let one = Tolerance { min_step: step, max_step: step, ..Tolerance::new(1.0, 1.0) };
        let end = t0 + 100.0 * step;
        let result = Integrator::within(DormandPrince, one).integrate(&OSCILLATOR, t0, end, &START, &0.0, |_, _| ());
        assert!(
            matches!(result, Ok((_, statistics)) if (100..=101).contains(&statistics.accepted)),
            "{step}: {result:?}"
        );
    }

    // A span that no bound on steps can cross, and one without any steps to take.
    let result =
        Integrator::adaptive(DormandPrince, 1e-6, 1e-6).integrate(&OSCILLATOR, 0.0, 1e300, &START, &0.0, |_, _| ());
    assert!(matches!(result, Err(IntegrationError::TooManySteps { .. })), "{result:?}");
    let none = Integrator::adaptive(DormandPrince, 1e-6, 1e-6).max_steps(0);
    assert!(none.integrate(&OSCILLATOR, 0.0, 1.0, &START, &0.0, |_, _| ()).is_err());
}

#[test]
fn errors_read_well() {
    let error = IntegrationError::StepTooSmall { time: 1.5, step: 1e-17 };
    assert_eq!(
        error.to_string(),
        "at t = 1.5 s the tolerance asks for a step of 0.00000000000000001 s, below the least one"
    );
    let boxed: Box<dyn core::error::Error> = Box::new(IntegrationError::NonFinite { time: 2.0 });
    assert_eq!(boxed.to_string(), "the state is no longer finite after t = 2 s");
}
