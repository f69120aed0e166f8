//! The loop over steps: the same states as `Rk4::integrate`, times to a rounding, and typed errors in bounded work.

use crate::common;
use crate::common::{Body, Currents, Driven, Flight, Motor, Oscillator, Pendulum, Scalar, counted, rotate};
use core::marker::PhantomData;
use multibody::nalgebra::Vector3;
use multibody::simba::simd::WideF64x4;
use multibody::{
    Composition4, Composition6, Configuration, Dop853, DormandPrince, IntegrationError, Integrator, Method, Real, Rk4,
    Separable, StateSpace, Statistics, System, Tangent, Tolerance, Twist, Verlet,
};

const OSCILLATOR: Oscillator<f64> = Oscillator(PhantomData);

/// Steps of one length by an integrator are those of the method, bit by bit.
#[test]
fn fixed_steps_are_those_of_the_method() {
    fn same<S: System<Scalar = f64>>(system: &S, start: &S::State, input: &S::Input)
    where
        S::State: PartialEq + core::fmt::Debug,
    {
        for (t0, dt, steps) in [(0.0, 1e-2, 500), (0.3, 7e-3, 1000), (-1.0, 0.1, 33)] {
            let t1 = t0 + f64::from(steps) * dt;
            let mut states = Vec::new();
            let end = Rk4::integrate(system, t0, start, input, dt, steps, |t, x| states.push((t, *x))).unwrap();
            let mut k = 0;
            let check = |t: f64, x: &S::State| {
                assert_eq!((t, *x), states[k]);
                k += 1;
            };
            let (state, statistics) =
                Integrator::fixed(Rk4, dt).integrate(system, t0, t1, start, input, check).unwrap();
            assert_eq!((state, k, statistics.accepted), (end, steps as usize, steps));
            assert_eq!(statistics.evaluations, 4 * steps);

            let end = Dop853::integrate(system, t0, start, input, dt, steps, |_, _| ()).unwrap();
            let (state, statistics) =
                Integrator::fixed(Dop853, dt).integrate(system, t0, t1, start, input, |_, _| ()).unwrap();
            assert_eq!(state, end);
            assert_eq!(statistics.evaluations, 12 * steps);
        }
    }
    same(&Pendulum { gravity: 9.81, shake: 3.0 }, &Scalar { q: 1.0, v: 0.0 }, &());
    same(&Body::floating(), &Body::spinning(), &());
    same(&Motor, &Driven { q: 0.2, v: 0.0, x: Currents { current: 0.0 } }, &3.0);

    let single = Oscillator::<f32>(PhantomData);
    let start = Scalar { q: 1.0f32, v: 0.0 };
    let end = Rk4::integrate(&single, 0.0, &start, &0.0, 0.125, 400, |_, _| ()).unwrap();
    let (state, _) = Integrator::fixed(Rk4, 0.125).integrate(&single, 0.0, 50.0, &start, &0.0, |_, _| ()).unwrap();
    assert_eq!(state, end);
}

/// The shortest steps: no time is lost, and the state moves by what the steps are long.
#[test]
fn steps_of_an_attosecond() {
    let (dt, steps) = (1e-18, 1_000_000);
    for t0 in [0.0, 1.0] {
        let start = Scalar { q: 1.0, v: 1.0 };
        let mut t = t0;
        Rk4::integrate(&OSCILLATOR, t0, &start, &0.0, dt, steps, |now, _| t = now).unwrap();
        assert!((t - (t0 + 1e-12)).abs() <= f64::EPSILON * t, "{t:e}");
        let t1 = t0 + 1e-12;
        let (mut t, mut last) = (t0, t0);
        let (end, statistics) = Integrator::fixed(Rk4, dt)
            .compensated()
            .integrate(&OSCILLATOR, t0, t1, &start, &0.0, |now, _| (last, t) = (t, now))
            .unwrap();
        assert!(t == t1 && last <= t);
        // The last steps before an end that is itself rounded to 111 steps.
        assert!(statistics.accepted.abs_diff(steps) <= if t0 == 0.0 { 0 } else { 112 }, "{statistics:?}");
        let moved = f64::from(statistics.accepted) * dt;
        println!("from {t0}: {} steps to {t:e}, moved by {:e}", statistics.accepted, end.q - 1.0);
        assert!((end.q - 1.0 - moved).abs() <= f64::EPSILON);
    }
    // Chosen steps that are bounded by so little.
    let short = Tolerance { max_step: dt, ..Tolerance::new(1e-9, 1e-9) };
    let mut t = 0.0;
    let (_, statistics) = Integrator::within(DormandPrince, short)
        .integrate(&OSCILLATOR, 0.0, 1e-14, &Scalar { q: 1.0, v: 1.0 }, &0.0, |now, _| t = now)
        .unwrap();
    assert!(t == 1e-14 && statistics.accepted.abs_diff(10_000) <= 1, "{statistics:?}");
}

/// A stiff spring: the frequency is 1e4.
struct Stiff;

impl System for Stiff {
    type Scalar = f64;
    type State = Scalar<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, state: &Scalar<f64>, (): &()) -> (f64, ()) {
        (-1e8 * state.q - 1e3 * state.v, ())
    }
    fn position_rates(&self, _t: f64, state: &Scalar<f64>) -> f64 {
        state.v
    }
}

/// Two equal rods in a row with rates that may grow: no step of 1e3 s makes sense.
struct Double;

impl System for Double {
    type Scalar = f64;
    type State = common::loops::Coordinates<f64, 2>;
    type Input = ();
    fn derivative(&self, _t: f64, x: &Self::State, (): &()) -> (multibody::nalgebra::Vector2<f64>, ()) {
        // Point masses on massless rods, in absolute angles.
        let (sin, cos) = (x.q[0] - x.q[1]).sin_cos();
        let (f, g) = (-sin * x.v[1] * x.v[1] - 19.62 * x.q[0].sin(), sin * x.v[0] * x.v[0] - 9.81 * x.q[1].sin());
        let det = 2.0 - cos * cos;
        (multibody::nalgebra::Vector2::new((f - cos * g) / det, (2.0 * g - cos * f) / det), ())
    }
    fn position_rates(&self, _t: f64, x: &Self::State) -> multibody::nalgebra::Vector2<f64> {
        x.v
    }
}

/// The longest steps: an error of its own type after little work, or steps that were made short enough.
#[test]
fn steps_of_a_thousand_seconds() {
    fn fails<S: System<Scalar = f64, Input = ()>, M: Method<S>>(system: &S, start: &S::State, method: M, name: &str) {
        let result = Integrator::fixed(method, 1e3).integrate(system, 0.0, 1e9, start, &(), |_, _| ());
        let Err(IntegrationError::NonFinite { time }) = result else { panic!("{name} {:?}", result.map(|(_, n)| n)) };
        println!("{name}: not finite after {} steps of 1e3 s", time / 1e3);
        assert!(time <= 1e6);
    }
    let stiff = Scalar { q: 1.0, v: 0.0 };
    let double = common::loops::Coordinates { q: [1.0, 2.0].into(), v: [0.0, 0.0].into() };
    fails(&Stiff, &stiff, Rk4, "stiff, Rk4");
    fails(&Stiff, &stiff, DormandPrince, "stiff, DormandPrince");
    fails(&Stiff, &stiff, Dop853, "stiff, Dop853");
    fails(&Double, &double, Rk4, "double pendulum, Rk4");
    fails(&Double, &double, Dop853, "double pendulum, Dop853");

    // Chosen steps with such a first one: it is cut down. As the least one it is an error.
    let long = Tolerance { first_step: 1e3, ..Tolerance::new(1e-6, 1e-6) };
    let system = counted(Stiff, f64::INFINITY);
    let (end, statistics) =
        Integrator::within(DormandPrince, long).integrate(&system, 0.0, 1.0, &stiff, &(), |_, _| ()).unwrap();
    println!("stiff, chosen steps: {statistics:?}");
    assert!(end.q.abs() < 1e-5 && system.evaluations.get() < 100_000);
    let least = Tolerance { min_step: 1e3, ..long };
    let result = Integrator::within(Dop853, least).integrate(&Stiff, 0.0, 1e9, &stiff, &(), |_, _| ());
    assert!(matches!(result, Err(IntegrationError::StepTooSmall { time: 0.0, .. })), "{result:?}");
    // A span that no such steps can cover ends at the bound on their number.
    let system = counted(Stiff, f64::INFINITY);
    let tolerant = Integrator::within(DormandPrince, long).max_steps(1000);
    let result = tolerant.integrate(&system, 0.0, 1e9, &stiff, &(), |_, _| ());
    assert!(matches!(result, Err(IntegrationError::TooManySteps { .. })), "{result:?}");
    assert!(system.evaluations.get() <= 6 * 1000 + 2);
}

/// The estimate of the eighth-order method follows the tolerance, in single precision and in lanes too.
#[test]
fn eighth_order_with_chosen_steps() {
    let start = Scalar { q: 1.0, v: 0.0 };
    let mut last = f64::INFINITY;
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let integrator = Integrator::adaptive(Dop853, tolerance, tolerance);
        let (end, statistics) = integrator.integrate(&OSCILLATOR, 0.0, 20.0, &start, &0.0, |_, _| ()).unwrap();
        let error = (end.q - 20f64.cos()).hypot(end.v + 20f64.sin());
        println!("{tolerance:e}: error {error:.1e}, {statistics:?}");
        assert!(error < 20.0 * tolerance && error < last);
        // One at the start and one to choose the first step; the slope at a step's end belongs to the next step.
        let Statistics { accepted, rejected, evaluations, .. } = statistics;
        assert_eq!(evaluations, 2 + 11 * (accepted + rejected) + accepted - 1);
        last = error;
    }
    let (end, _) = Integrator::adaptive(Dop853, 1e-12, 1e-12)
        .integrate(&OSCILLATOR, 20.0, 0.0, &Scalar { q: 20f64.cos(), v: -20f64.sin() }, &0.0, |_, _| ())
        .unwrap();
    assert!((end.q - 1.0).hypot(end.v) < 1e-11);

    let single = Oscillator(PhantomData);
    let (end, _) = Integrator::adaptive(Dop853, 1e-5, 1e-5)
        .integrate(&single, 0.0, 20.0, &Scalar { q: 1.0f32, v: 0.0 }, &0.0, |_, _| ())
        .unwrap();
    assert!((end.q - 20f32.cos()).abs() < 1e-4, "{}", end.q);

    // The worst lane decides, whatever the others' estimates.
    let amplitudes = [1.0, 1e-3, 0.0, 5.0];
    let lanes = Scalar { q: WideF64x4::from(amplitudes), v: WideF64x4::ZERO };
    let (end, _) = Integrator::adaptive(Dop853, 1e-10, 1e-10)
        .integrate(&Oscillator(PhantomData), 0.0, 20.0, &lanes, &WideF64x4::lit(0.0), |_, _| ())
        .unwrap();
    for (q, amplitude) in end.split().0.into_arr().into_iter().zip(amplitudes) {
        assert!((q - amplitude * 20f64.cos()).abs() < 1e-8);
    }
}

/// An oscillator whose position is moved at the end of every step, its velocity is not.
struct Moved(f64);

impl System for Moved {
    type Scalar = f64;
    type State = Scalar<f64>;
    type Input = f64;
    fn derivative(&self, t: f64, state: &Scalar<f64>, force: &f64) -> (f64, ()) {
        OSCILLATOR.derivative(t, state, force)
    }
    fn position_rates(&self, _t: f64, state: &Scalar<f64>) -> f64 {
        state.v
    }
    fn accepted(&self, _t: f64, state: &Scalar<f64>, _force: &f64) -> Scalar<f64> {
        Scalar { q: state.q + self.0, v: state.v }
    }
}

impl Separable for Moved {}

/// A compass in a field along x of the world, of unit inertia, which is turned about z of its own at the end of every step;
/// its velocity is not.
struct Turned(f64);

impl System for Turned {
    type Scalar = f64;
    type State = Flight<f64>;
    type Input = f64;
    fn derivative(&self, _t: f64, state: &Flight<f64>, _: &f64) -> (Twist, ()) {
        let field = rotate(&state.q.orientation.inverse(), &Vector3::x());
        (Twist { linear: Vector3::zeros(), angular: Vector3::new(0.0, 1.0, 0.5).cross(&field) }, ())
    }
    fn position_rates(&self, _t: f64, state: &Flight<f64>) -> Twist {
        state.v
    }
    fn accepted(&self, _t: f64, state: &Flight<f64>, _: &f64) -> Flight<f64> {
        if self.0 == 0.0 {
            return *state;
        }
        let turn = Twist { angular: Vector3::new(0.0, 0.0, self.0), ..Tangent::zero() };
        Flight { q: state.q.displace(&turn), v: state.v }
    }
}

impl Separable for Turned {}

/// The slope at the end of a step starts the next one if the state stays what it was, or changes by its rounding.
#[test]
fn slopes_are_those_of_accepted_states() {
    /// A method that takes `first` evaluations to start and `stages` for a step, and `again` after one whose end is moved.
    fn check<S: System<Scalar = f64, Input = f64>, M: Method<S>>(
        system: impl Fn(f64) -> S,
        start: S::State,
        method: M,
        [first, stages, again]: [u32; 3],
    ) where
        S::State: PartialEq + core::fmt::Debug,
    {
        let (dt, steps) = (0.125, 40);
        let run = |moved: f64, compensated: bool| {
            let integrator = Integrator { compensated, ..Integrator::fixed(method, dt) };
            let end = f64::from(steps) * dt;
            let (state, statistics) = integrator.integrate(&system(moved), 0.0, end, &start, &0.0, |_, _| ()).unwrap();
            (state, statistics.evaluations)
        };
        assert_eq!(run(0.0, false).1, first + stages * steps);
        assert_eq!(run(0.0, true).1, first + stages * steps);
        for moved in [1e-12, 1e-3] {
            let one = Integrator::fixed(method, dt);
            let mut state = start;
            for _ in 0..steps {
                state = one.integrate(&system(moved), 0.0, dt, &state, &0.0, |_, _| ()).unwrap().0;
            }
            assert_eq!(run(moved, false), (state, first + stages * steps + again * (steps - 1)));
        }
    }
    fn both(method: impl Method<Moved> + Method<Turned>, costs: [u32; 3]) {
        check(Moved, Scalar { q: 1.0, v: 0.0 }, method, costs);
        check(Turned, Body::spinning(), method, costs);
    }
    both(DormandPrince, [1, 6, 1]);
    both(Dop853, [0, 12, 0]);
    both(Verlet, [1, 1, 1]);
    both(Composition4, [1, 6, 1]);
    both(Composition6, [1, 11, 1]);

    // Nor are accelerations those of states that were left behind.
    let start = Scalar { q: 1.0, v: 0.0 };
    let mut state = start;
    for _ in 0..40 {
        state = Verlet::step(&Moved(1e-3), 0.0, &state, &0.0, 0.125);
    }
    assert_eq!(Verlet::integrate(&Moved(1e-3), 0.0, &start, &0.0, 0.125, 40, |_, _| ()).unwrap(), state);
}
