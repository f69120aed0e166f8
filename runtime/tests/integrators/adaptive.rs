//! Adaptive integration: errors follow the tolerance, steps are reported as they were, and the end is met exactly.

use crate::common::{Body, Currents, Driven, Motor, Oscillator, Pendulum, Scalar, counted};
use core::marker::PhantomData;
use multibody::simba::simd::WideF64x4;
use multibody::{DormandPrince, IntegrationError, Integrator, Real, Rk4, Tolerance};

const OSCILLATOR: Oscillator<f64> = Oscillator(PhantomData);
const START: Scalar<f64> = Scalar { q: 1.0, v: 0.0 };

#[test]
fn error_follows_the_tolerance() {
    let mut last = f64::INFINITY;
    let mut last_steps = 0;
    for tolerance in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11] {
        let (end, statistics) = Integrator::adaptive(DormandPrince, tolerance, tolerance)
            .integrate(&OSCILLATOR, 0.0, 20.0, &START, &0.0, |_, _| ())
            .unwrap();
        let error = (end.q - 20f64.cos()).hypot(end.v + 20f64.sin());
        assert!(error < 40.0 * tolerance, "{tolerance:e}: {error:e}");
        assert!(error < 0.1 * last, "{tolerance:e}: {error:e} after {last:e}");
        assert!(statistics.accepted > last_steps);
        (last, last_steps) = (error, statistics.accepted);
    }
    assert!(last_steps < 1500, "{last_steps}");
}

#[test]
fn rotations_and_own_states_follow_the_tolerance() {
    let fine = DormandPrince::integrate(&Body::floating(), 0.0, &Body::spinning(), &(), 1e-3, 5000, |_, _| ()).unwrap();
    let adaptive = Integrator::adaptive(DormandPrince, 1e-10, 1e-10);
    let (end, _) = adaptive.integrate(&Body::floating(), 0.0, 5.0, &Body::spinning(), &(), |_, _| ()).unwrap();
    assert!(end.q.orientation.angle_to(&fine.q.orientation) < 1e-8);
    assert!((end.q.position - fine.q.position).norm() < 1e-9);

    let start = Driven { q: 0.2, v: 0.0, x: Currents { current: 0.0 } };
    let fine = DormandPrince::integrate(&Motor, 0.0, &start, &3.0, 1e-3, 5000, |_, _| ()).unwrap();
    let (end, _) = adaptive.integrate(&Motor, 0.0, 5.0, &start, &3.0, |_, _| ()).unwrap();
    assert!((end.x.current - fine.x.current).abs() < 1e-8 && (end.q - fine.q).abs() < 1e-8);
}

#[test]
fn statistics_and_observer_tell_the_truth() {
    let system = counted(Pendulum { gravity: 9.81, shake: 30.0 }, f64::INFINITY);
    let mut times = vec![0.0];
    let mut last = Scalar { q: 0.0, v: 0.0 };
    let rough = Integrator::within(DormandPrince, Tolerance { first_step: 3.0, ..Tolerance::new(1e-6, 1e-6) });
    let (end, statistics) = rough
        .integrate(&system, 0.0, 7.0, &Scalar { q: 3.0, v: 0.0 }, &(), |t, state| {
            times.push(t);
            last = *state;
        })
        .unwrap();
    assert_eq!(statistics.evaluations, system.evaluations.get());
    assert_eq!(statistics.evaluations, 1 + 6 * (statistics.accepted + statistics.rejected)); // first same as last
    assert_eq!(statistics.accepted as usize, times.len() - 1);
    assert!(statistics.rejected > 0);
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    assert_eq!(times.last(), Some(&7.0));
    assert_eq!(last, end);
}

#[test]
fn the_end_is_met_exactly_in_both_directions() {
    for (t0, t1) in [(0.0, 1.0 / 3.0), (1e6, 1e6 + 0.7), (0.0, -2.5), (5.0, 5.0), (0.0, 5e-324), (1e9, 1e9 + 1.2e-7)] {
        let mut t = t0;
        let (end, _) = Integrator::adaptive(DormandPrince, 1e-9, 1e-9)
            .integrate(&OSCILLATOR, t0, t1, &START, &0.0, |now, _| t = now)
            .unwrap();
        assert_eq!(t, t1);
        assert!((end.q - (t1 - t0).cos()).abs() < 1e-7 && (end.v + (t1 - t0).sin()).abs() < 1e-7, "{t0} {t1}");
    }
}

#[test]
fn time_of_fixed_steps_does_not_drift() {
    let mut t = 0.0;
    Rk4::integrate(&OSCILLATOR, 0.1, &START, &0.0, 1e-3, 1_000_000, |now, _| t = now).unwrap();
    assert!((t - 1000.1).abs() <= 1000.1 * f64::EPSILON, "{t}");
    let mut t = 0.0f32;
    let start = Scalar { q: 1.0f32, v: 0.0 };
    Rk4::integrate(&Oscillator(PhantomData), 0.0, &start, &0.0, 1e-3, 1_000_000, |now, _| t = now).unwrap();
    assert!((t - 1000.0).abs() <= 1000.0 * f32::EPSILON, "{t}");
}

#[test]
fn single_precision() {
    let system = Oscillator(PhantomData);
    let start = Scalar { q: 1.0f32, v: 0.0 };
    let (end, statistics) =
        Integrator::adaptive(DormandPrince, 1e-5, 1e-5).integrate(&system, 0.0, 10.0, &start, &0.0, |_, _| ()).unwrap();
    assert!((end.q - 10f32.cos()).abs() < 1e-4);
    assert!(statistics.accepted < 100);
    // A tolerance below the rounding of the scalar may be missed or refused, but it ends.
    let hopeless = Integrator::adaptive(DormandPrince, 0.0, 1e-14).max_steps(200_000);
    let result = hopeless.integrate(&system, 0.0, 1.0, &start, &0.0, |_, _| ());
    assert!(result.is_err() || result.is_ok_and(|(end, _)| (end.q - 1f32.cos()).abs() < 1e-2));
}

#[test]
fn lanes_share_their_steps() {
    let amplitudes = [1.0, 2.0, -0.5, 0.0];
    let start = Scalar { q: WideF64x4::from(amplitudes), v: WideF64x4::ZERO };
    let system = Oscillator(PhantomData);
    let (end, _) = Integrator::adaptive(DormandPrince, 1e-9, 1e-9)
        .integrate(&system, 0.0, 4.0, &start, &WideF64x4::ZERO, |_, _| ())
        .unwrap();
    for (q, amplitude) in end.q.into_arr().into_iter().zip(amplitudes) {
        assert!((q - amplitude * 4f64.cos()).abs() < 1e-7);
    }
    let bad = Scalar { q: WideF64x4::from([1.0, f64::NAN, 1.0, 1.0]), v: WideF64x4::ZERO };
    let result = Rk4::integrate(&system, WideF64x4::ZERO, &bad, &WideF64x4::ZERO, WideF64x4::lit(0.1), 9, |_, _| ());
    assert_eq!(result.unwrap_err(), IntegrationError::NonFinite { time: 0.0 });
}
