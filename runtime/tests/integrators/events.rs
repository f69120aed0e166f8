//! Events: located where closed forms have them, by every method, in order, once each, in both directions of time.

use crate::common::loops::{Coordinates, Rod};
use crate::common::{Oscillator, Pendulum, Scalar};
use core::f64::consts::PI;
use core::marker::PhantomData;
use multibody::integrators::{Action, Direction, Event, Events, Interval, Samples};
use multibody::nalgebra::Vector2;
use multibody::simba::simd::WideF64x4;
use multibody::{
    Dop853, DormandPrince, IntegrationError, Integrator, Method, Projection, Real, Rk4, SemiImplicitEuler, System,
    Tolerance, WithProjection,
};

const OSCILLATOR: Oscillator<f64> = Oscillator(PhantomData);

/// Functions, and what happens, by closures; keeps the events.
struct Watched<F, G> {
    functions: F,
    action: G,
    direction: Direction,
    tolerance: f64,
    samples: u32,
    seen: Vec<Event>,
}

impl<F, G> Watched<F, G> {
    fn new<Z, const N: usize>(functions: F, action: G) -> Self
    where
        F: Fn(f64, &Z) -> [f64; N],
        G: FnMut(&Event, &Z) -> Action<Z>,
    {
        Self { functions, action, direction: Direction::Both, tolerance: 0.0, samples: 3, seen: Vec::new() }
    }
    fn only(self, direction: Direction) -> Self {
        Self { direction, ..self }
    }
    fn times(&self) -> Vec<f64> {
        self.seen.iter().map(|event| event.time).collect()
    }
}

impl<S, F, G, const N: usize> Events<S, N> for Watched<F, G>
where
    S: System,
    F: Fn(f64, &S::State) -> [f64; N],
    G: FnMut(&Event, &S::State) -> Action<S::State>,
{
    fn values(&self, t: f64, state: &S::State) -> [f64; N] {
        (self.functions)(t, state)
    }
    fn direction(&self, _index: usize) -> Direction {
        self.direction
    }
    fn happened(&mut self, event: &Event, state: &S::State) -> Action<S::State> {
        self.seen.push(*event);
        (self.action)(event, state)
    }
    fn tolerance(&self) -> f64 {
        self.tolerance
    }
    fn samples(&self) -> u32 {
        self.samples
    }
}

/// A ball in free fall, with an acceleration of -10.
struct Ball;

impl System for Ball {
    type Scalar = f64;
    type State = Scalar<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, _state: &Scalar<f64>, (): &()) -> (f64, ()) {
        (-10.0, ())
    }
    fn position_rates(&self, _t: f64, state: &Scalar<f64>) -> f64 {
        state.v
    }
}

fn bounced(restitution: f64) -> impl Fn(&Event, &Scalar<f64>) -> Action<Scalar<f64>> {
    move |_, state| Action::Jump(Scalar { v: -restitution * state.v, ..*state })
}

/// The time of the bounce `k` from zero, after a fall from the height 5.
fn bounce(restitution: f64, k: u32) -> f64 {
    let rest: f64 = (1..=k as i32).map(|k| 2.0 * restitution.powi(k)).sum();
    1.0 + rest
}

fn bounces<M: Method<Ball>>(integrator: Integrator<M>, name: &str) {
    let mut ground = Watched::new(|_, x: &Scalar<f64>| [x.q], bounced(0.5)).only(Direction::Falling);
    let start = Scalar { q: 5.0, v: 0.0 };
    let end = 2.99;
    let mut reached = 0.0;
    let (state, statistics, time) = integrator
        .with_events(&Ball, 0.0, end, &start, &(), &mut ground, |interval| {
            assert_eq!(interval.start(), reached);
            reached = interval.end();
        })
        .unwrap();
    assert_eq!((time, reached), (end, end));
    let expected: Vec<f64> = (0..8).map(|k| bounce(0.5, k)).take_while(|&t| t < end).collect();
    let worst = ground.times().iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("{name}: {} bounces, times within {worst:.1e}, {statistics:?}", expected.len());
    assert_eq!(ground.seen.len(), expected.len(), "{name}");
    assert!(worst < 2e-15 * 20.0, "{name}: {worst:e}");
    let since = end - expected.last().unwrap();
    let speed = 10.0 * 0.5f64.powi(expected.len() as i32);
    assert!((state.q - since * (speed - 5.0 * since)).abs() < 1e-13, "{name}: {}", state.q);
}

#[test]
fn bouncing_ball() {
    for step in [1e-3, 0.03, 0.1, 0.5, 2.0, 10.0] {
        bounces(Integrator::fixed(Rk4, step), "Rk4, fixed");
        bounces(Integrator::fixed(DormandPrince, step), "DormandPrince, fixed");
        bounces(Integrator::fixed(Dop853, step), "Dop853, fixed");
        bounces(Integrator::fixed(Rk4, step).compensated(), "Rk4, compensated");
    }
    for tolerance in [1e-3, 1e-6, 1e-12] {
        bounces(Integrator::adaptive(DormandPrince, tolerance, tolerance), "DormandPrince, adaptive");
        bounces(Integrator::adaptive(Dop853, tolerance, tolerance), "Dop853, adaptive");
    }
}

#[test]
fn bounces_that_accumulate_are_an_error() {
    fn fails<M: Method<Ball>>(integrator: Integrator<M>, restitution: f64) {
        let mut ground = Watched::new(|_, x: &Scalar<f64>| [x.q], bounced(restitution)).only(Direction::Falling);
        let start = Scalar { q: 5.0, v: 0.0 };
        let result = integrator.with_events(&Ball, 0.0, 300.0, &start, &(), &mut ground, |_| ());
        let rest = (1.0 + restitution) / (1.0 - restitution);
        println!("{restitution}: {} bounces, {result:?}, at rest at {rest}", ground.seen.len());
        let Err(IntegrationError::EventsAccumulate { time }) = result else { panic!("{result:?}") };
        assert!((time - rest).abs() < 3e-5, "{time}");
        assert!(ground.seen.len() < 2000);
    }
    for restitution in [0.1, 0.5, 0.9, 0.99] {
        fails(Integrator::fixed(Rk4, 0.1), restitution);
        fails(Integrator::fixed(Rk4, 7.0), restitution);
        fails(Integrator::adaptive(DormandPrince, 1e-6, 1e-6), restitution);
        fails(Integrator::adaptive(Dop853, 1e-9, 1e-9), restitution);
    }
    // Steps are bounded too.
    let mut ground = Watched::new(|_, x: &Scalar<f64>| [x.q], bounced(0.9)).only(Direction::Falling);
    let few = Integrator::adaptive(Dop853, 1e-9, 1e-9).max_steps(40);
    let result = few.with_events(&Ball, 0.0, 100.0, &Scalar { q: 5.0, v: 0.0 }, &(), &mut ground, |_| ());
    assert!(matches!(result, Err(IntegrationError::TooManySteps { .. })), "{result:?}");
}

/// The period of a pendulum, by the arithmetic-geometric mean.
fn period(frequency: f64, amplitude: f64) -> f64 {
    let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    2.0 * PI / (frequency * a)
}

/// Passages through the lowest point, at odd quarters of the period: the greatest error of their times.
fn passages<M: Method<Pendulum<f64>>>(integrator: Integrator<M>) -> f64 {
    let quarter = 0.25 * period(9.81f64.sqrt(), 1.2);
    let mut low = Watched::new(|_, x: &Scalar<f64>| [x.q], |_, _| Action::Continue);
    integrator.with_events(&PENDULUM, 0.0, 8.0, &Scalar { q: 1.2, v: 0.0 }, &(), &mut low, |_| ()).unwrap();
    assert_eq!(low.seen.len(), (8.0 / quarter + 1.0) as usize / 2);
    for (k, event) in low.seen.iter().enumerate() {
        assert_eq!(event.rising, k % 2 == 1);
    }
    let errors = low.times().into_iter().enumerate().map(|(k, t)| (t - (2.0 * k as f64 + 1.0) * quarter).abs());
    errors.fold(0.0, f64::max)
}

const PENDULUM: Pendulum<f64> = Pendulum { gravity: 9.81, shake: 0.0 };

#[test]
fn pendulum_through_its_lowest_point() {
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let fifth = passages(Integrator::adaptive(DormandPrince, tolerance, tolerance));
        let eighth = passages(Integrator::adaptive(Dop853, tolerance, tolerance));
        println!("tolerance {tolerance:e}: times of DormandPrince within {fifth:.1e}, of Dop853 within {eighth:.1e}");
        assert!(fifth < 30.0 * tolerance && eighth < 30.0 * tolerance);
    }
    let eighth = passages(Integrator::fixed(Dop853, 0.01).compensated());
    println!("Dop853 with steps of 0.01, compensated: {eighth:.1e}");
    assert!(eighth < 1e-14);
}

/// The error of one event in one step from a state that is right: by steps of the method, and by dense output alone.
fn located<M: Method<Pendulum<f64>>>(method: M, step: f64) -> (f64, f64) {
    let quarter = 0.25 * period(9.81f64.sqrt(), 1.2);
    let t0 = quarter - 0.6 * step;
    let fine = Integrator::fixed(Dop853, 1e-3).compensated();
    let (start, _) = fine.integrate(&PENDULUM, 0.0, t0, &Scalar { q: 1.2, v: 0.0 }, &(), |_, _| ()).unwrap();
    let mut low = Watched::new(|_, x: &Scalar<f64>| [x.q], |_, _| Action::Continue);
    let mut dense = 0.0;
    let look = |interval: &Interval<'_, Pendulum<f64>, M>| {
        let (mut a, mut b) = (interval.start(), interval.end());
        for _ in 0..60 {
            let middle = 0.5 * (a + b);
            *if interval.at(middle).q > 0.0 { &mut a } else { &mut b } = middle;
        }
        dense = b;
    };
    Integrator::fixed(method, step).with_events(&PENDULUM, t0, t0 + step, &start, &(), &mut low, look).unwrap();
    ((low.seen[0].time - quarter).abs(), (dense - quarter).abs())
}

/// Events have the accuracy of the method, an order above that of its dense output.
#[test]
fn events_are_as_accurate_as_steps() {
    for step in [0.2, 0.1, 0.05, 0.025] {
        let (rk4, fifth, eighth) = (located(Rk4, step), located(DormandPrince, step), located(Dop853, step));
        println!("steps of {step}, errors by steps and by dense output:");
        for (name, (own, dense)) in [("Rk4", rk4), ("DormandPrince", fifth), ("Dop853", eighth)] {
            println!("  {name:14} {own:.1e} {dense:.1e}");
        }
        assert!(rk4.0 < 0.5 * rk4.1 && fifth.0 < 0.5 * fifth.1);
        assert!(eighth.0 <= eighth.1 + 1e-15);
    }
}

#[test]
fn both_crossings_of_one_step() {
    let (t0, t1) = (-0.5, 0.5);
    let start = Scalar { q: t0.cos(), v: -t0.sin() };
    let mut level = Watched::new(|_, x: &Scalar<f64>| [x.q - 0.95], |_, _| Action::Continue);
    Integrator::fixed(Dop853, 1.0).with_events(&OSCILLATOR, t0, t1, &start, &0.0, &mut level, |_| ()).unwrap();
    let at = 0.95f64.acos();
    assert_eq!(level.seen.len(), 2);
    assert!(level.seen[0].rising && !level.seen[1].rising);
    // One step of eighth order: an error of 1e-10.
    assert!((level.seen[0].time + at).abs() < 1e-9 && (level.seen[1].time - at).abs() < 1e-9);
}

/// Functions of time alone, several in one step, come in the order of time; those of one time in that of their indices.
#[test]
fn events_of_one_step_in_order() {
    let start = Scalar { q: 1.0, v: 0.0 };
    let functions = |t: f64, _: &Scalar<f64>| [t - 0.7, 0.3 - t, t - 0.3, t - 0.9, 0.30001 - t];
    for backwards in [false, true] {
        let (t0, t1) = if backwards { (1.0, 0.0) } else { (0.0, 1.0) };
        let mut clock = Watched::new(functions, |_, _| Action::Continue);
        Integrator::fixed(Rk4, 1.0).with_events(&OSCILLATOR, t0, t1, &start, &0.0, &mut clock, |_| ()).unwrap();
        let expected = if backwards {
            [(3, 0.9), (0, 0.7), (4, 0.30001), (1, 0.3), (2, 0.3)]
        } else {
            [(1, 0.3), (2, 0.3), (4, 0.30001), (0, 0.7), (3, 0.9)]
        };
        assert_eq!(clock.seen.len(), 5);
        for (event, (index, time)) in clock.seen.iter().zip(expected) {
            assert_eq!(event.index, index);
            assert!((event.time - time).abs() < 1e-15, "{event:?}");
            assert_eq!(event.rising, [0, 2, 3].contains(&index) != backwards);
        }
    }
}

#[test]
fn two_balls_meet_the_ground_at_once() {
    /// Two balls side by side.
    struct Balls;
    impl System for Balls {
        type Scalar = f64;
        type State = Coordinates<f64, 2>;
        type Input = ();
        fn derivative(&self, _t: f64, _state: &Coordinates<f64, 2>, (): &()) -> (Vector2<f64>, ()) {
            (Vector2::new(-10.0, -10.0), ())
        }
        fn position_rates(&self, _t: f64, state: &Coordinates<f64, 2>) -> Vector2<f64> {
            state.v
        }
    }
    for gap in [0.0, 1e-15, 1e-12, -1e-15, -1e-12, 1e-3] {
        let start = Coordinates { q: Vector2::new(5.0, 5.0 + gap), v: Vector2::new(0.0, 0.0) };
        let action = |event: &Event, state: &Coordinates<f64, 2>| {
            let mut next = *state;
            next.v[event.index] *= -0.5;
            Action::Jump(next)
        };
        let mut ground = Watched::new(|_, x: &Coordinates<f64, 2>| [x.q[0], x.q[1]], action).only(Direction::Falling);
        let fixed = Integrator::fixed(DormandPrince, 0.07);
        let (end, ..) = fixed.with_events(&Balls, 0.0, 2.9, &start, &(), &mut ground, |_| ()).unwrap();
        let count = |index| ground.seen.iter().filter(|event| event.index == index).count();
        assert_eq!((count(0), count(1)), (5, 5), "{gap}");
        assert!(end.q[0] > 0.0 && end.q[1] > 0.0 && (end.q[0] - end.q[1]).abs() < 1e-3 + 2.0 * gap.abs());
        assert!(ground.seen.windows(2).all(|pair| pair[0].time <= pair[1].time));
    }
}

#[test]
fn a_function_that_is_zero_at_the_start() {
    // Thrown from the ground: it comes back once before the end.
    for step in [0.1, 1.0, 100.0] {
        let mut ground = Watched::new(|_, x: &Scalar<f64>| [x.q], |_, _| Action::Stop);
        let start = Scalar { q: 0.0, v: 1.0 };
        let (state, _, time) =
            Integrator::fixed(Rk4, step).with_events(&Ball, 0.0, 100.0, &start, &(), &mut ground, |_| ()).unwrap();
        assert!(ground.seen.len() == 1 && !ground.seen[0].rising);
        let rounding = 1e-15 * (1.0 + step); // crossings are located to the rounding of the step
        assert!((time - 0.2).abs() < rounding && (state.v + 1.0).abs() < 10.0 * rounding, "{time}");
    }
    // Zero throughout.
    let mut never = Watched::new(|_, _: &Scalar<f64>| [0.0], |_, _| Action::Stop);
    let fixed = Integrator::fixed(Rk4, 0.1);
    let (.., time) = fixed.with_events(&Ball, 0.0, 1.0, &Scalar { q: 0.0, v: 0.0 }, &(), &mut never, |_| ()).unwrap();
    assert_eq!((time, never.seen.len()), (1.0, 0));
}

#[test]
fn stop_and_go_on_in_both_directions() {
    for (t0, t1, at) in [(0.0, 10.0, 0.5 * PI), (0.0, -10.0, -0.5 * PI), (3.0 * PI, 0.0, 2.5 * PI)] {
        let start = Scalar { q: f64::cos(t0), v: -f64::sin(t0) };
        let adaptive = Integrator::adaptive(DormandPrince, 1e-12, 1e-12);
        let mut zero = Watched::new(|_, x: &Scalar<f64>| [x.q], |_, _| Action::Stop);
        let mut last = t0;
        let (state, statistics, time) = adaptive
            .with_events(&OSCILLATOR, t0, t1, &start, &0.0, &mut zero, |interval| last = interval.end())
            .unwrap();
        assert!((time - at).abs() < 1e-11 && state.q.abs() < 1e-13 && (state.v.abs() - 1.0).abs() < 1e-11, "{time}");
        assert_eq!((time, 1), (last, zero.seen.len()));
        assert!(statistics.accepted > 0);
        // From there on, the function is at zero and has no sign.
        let (.., time) = adaptive.with_events(&OSCILLATOR, time, t1, &state, &0.0, &mut zero, |_| ()).unwrap();
        assert!((time - at).abs() > 3.0, "{time}");
    }
}

#[test]
fn directions() {
    let start = Scalar { q: 1.0, v: 0.0 };
    for (direction, expected) in [(Direction::Rising, vec![1.5]), (Direction::Falling, vec![0.5, 2.5])] {
        let mut zero = Watched::new(|_, x: &Scalar<f64>| [x.q], |_, _| Action::Continue).only(direction);
        let fixed = Integrator::fixed(Dop853, 0.1);
        fixed.with_events(&OSCILLATOR, 0.0, 10.0, &start, &0.0, &mut zero, |_| ()).unwrap();
        assert_eq!(zero.seen.len(), expected.len());
        for (event, quarter) in zero.seen.iter().zip(expected) {
            assert!((event.time - quarter * PI).abs() < 1e-13);
        }
    }
}

/// Events that only look leave the integration as it is, bit by bit.
#[test]
fn looking_changes_nothing() {
    fn same<M: Method<Pendulum<f64>>>(integrator: Integrator<M>) {
        let pendulum = Pendulum { gravity: 9.81, shake: 3.0 };
        let start = Scalar { q: 1.0, v: 0.0 };
        let mut states = Vec::new();
        integrator.integrate(&pendulum, 0.0, 5.0, &start, &(), |t, x| states.push((t, *x))).unwrap();
        let mut looked = Vec::new();
        let mut zero = Watched::new(|_, x: &Scalar<f64>| [x.q, x.v], |_, _| Action::Continue);
        let record = |interval: &Interval<'_, _, _>| looked.push((interval.end(), *interval.last()));
        integrator.with_events(&pendulum, 0.0, 5.0, &start, &(), &mut zero, record).unwrap();
        assert!(zero.seen.len() > 5);
        assert_eq!(states, looked);
    }
    same(Integrator::fixed(Rk4, 0.03));
    same(Integrator::fixed(SemiImplicitEuler, 0.03));
    same(Integrator::adaptive(Dop853, 1e-8, 1e-8));
    same(Integrator::adaptive(DormandPrince, 1e-8, 1e-8).compensated());
}

/// A jump of something else across zero is no crossing; one that leads away from zero gives a sign.
#[test]
fn jumps_are_no_crossings() {
    let start = Scalar { q: 1.0, v: 0.0 };
    // At the time 1 the oscillator is put to -2, so that it crosses zero upwards later.
    let action = |event: &Event, _: &Scalar<f64>| {
        if event.index == 0 { Action::Jump(Scalar { q: -2.0, v: 0.0 }) } else { Action::Continue }
    };
    let mut events = Watched::new(|t, x: &Scalar<f64>| [t - 1.0, x.q], action);
    let adaptive = Integrator::adaptive(Dop853, 1e-12, 1e-12);
    adaptive.with_events(&OSCILLATOR, 0.0, 3.0, &start, &0.0, &mut events, |_| ()).unwrap();
    assert_eq!(events.seen.len(), 2, "{:?}", events.seen);
    let [clock, zero] = [events.seen[0], events.seen[1]];
    assert!(clock.index == 0 && (clock.time - 1.0).abs() < 1e-15);
    assert!(zero.index == 1 && zero.rising && (zero.time - 1.0 - 0.5 * PI).abs() < 1e-11, "{zero:?}");
}

#[test]
fn a_tolerance_saves_steps() {
    let start = Scalar { q: 1.0, v: 0.0 };
    let cost = |tolerance: f64| {
        let mut zero = Watched::new(|_, x: &Scalar<f64>| [x.q], |_, _| Action::Continue);
        zero.tolerance = tolerance;
        let fixed = Integrator::fixed(Dop853, 0.3);
        let (_, statistics, _) = fixed.with_events(&OSCILLATOR, 0.0, 30.0, &start, &0.0, &mut zero, |_| ()).unwrap();
        let error = |(k, t): (usize, f64)| (t - (k as f64 + 0.5) * PI).abs();
        let worst = zero.times().into_iter().enumerate().map(error).fold(0.0, f64::max);
        assert!(worst <= tolerance + 1e-9, "{worst:e}");
        f64::from(statistics.evaluations) / 10.0
    };
    let (_, plain) = Integrator::fixed(Dop853, 0.3).integrate(&OSCILLATOR, 0.0, 30.0, &start, &0.0, |_, _| ()).unwrap();
    let costs = [0.0, 1e-12, 1e-9, 1e-6, 1e-3].map(cost);
    println!("evaluations for each of 10 events and 10 of 100 steps: {costs:?}, without events {}", plain.evaluations);
    assert!(costs[0] < 250.0 && costs[3] < costs[0]);
}

/// At an event the state lies on the constraints as it does between steps.
#[test]
fn states_at_events_are_projected() {
    let rod = WithProjection::new(Rod::<f64>::rigid(), Projection::default());
    let start = Coordinates { q: Vector2::new(1.0, 0.0), v: Vector2::new(0.0, 0.0) };
    let mut worst = 0.0;
    let action = |_: &Event, state: &Coordinates<f64, 2>| {
        worst = f64::max(worst, (state.q.norm() - 1.0).abs());
        // A wall that gives back half of the speed, and that pushes the bob off its circle.
        Action::Jump(Coordinates { q: state.q * 1.001, v: state.v * -0.5 })
    };
    let mut wall = Watched::new(|_, x: &Coordinates<f64, 2>| [x.q[0]], action).only(Direction::Falling);
    let fixed = Integrator::fixed(Rk4, 0.05);
    let mut open = 0.0;
    fixed
        .with_events(&rod, 0.0, 2.0, &start, &(), &mut wall, |interval| {
            open = f64::max(open, (interval.first().q.norm() - 1.0).abs());
        })
        .unwrap();
    assert!(wall.seen.len() >= 2);
    assert!(worst < 1e-12 && open < 1e-12, "{worst:e} {open:e}"); // the tolerance of the projection
}

#[test]
fn single_precision_and_lanes() {
    let single = Oscillator::<f32>(PhantomData);
    let start = Scalar { q: 1.0f32, v: 0.0 };
    let mut zero = Watched::new(|_, x: &Scalar<f32>| [f64::from(x.q)], |_, _| Action::Continue);
    Integrator::adaptive(DormandPrince, 1e-5, 1e-5)
        .with_events(&single, 0.0, 10.0, &start, &0.0, &mut zero, |_| ())
        .unwrap();
    assert_eq!(zero.seen.len(), 3);
    for (k, time) in zero.times().into_iter().enumerate() {
        assert!((time - (k as f64 + 0.5) * PI).abs() < 1e-4, "{time}");
    }

    // The event of four lanes is the first one of them.
    let lanes = Oscillator::<WideF64x4>(PhantomData);
    let start = Scalar { q: WideF64x4::from([1.0, 2.0, 1.0, 1.0]), v: WideF64x4::from([0.0, 0.0, -1.0, 0.0]) };
    let least = |_: f64, x: &Scalar<WideF64x4>| [-Real::greatest(-x.q)];
    let mut zero = Watched::new(least, |_, _| Action::Stop);
    let (.., time) = Integrator::fixed(Dop853, 0.1)
        .with_events(&lanes, 0.0, 10.0, &start, &WideF64x4::ZERO, &mut zero, |_| ())
        .unwrap();
    assert!((time - 0.25 * PI).abs() < 1e-13, "{time}");
}

#[test]
fn values_that_are_no_numbers() {
    let start = Scalar { q: 1.0, v: 0.0 };
    let fixed = Integrator::fixed(Rk4, 0.1);
    let mut bad = Watched::new(|t, _: &Scalar<f64>| [if t > 0.55 { f64::NAN } else { 1.0 }], |_, _| Action::Continue);
    let result = fixed.with_events(&OSCILLATOR, 0.0, 1.0, &start, &0.0, &mut bad, |_| ());
    assert!(matches!(result, Err(IntegrationError::NonFinite { time }) if (0.5..0.7).contains(&time)), "{result:?}");
    let nowhere = |_: &Event, _: &Scalar<f64>| Action::Jump(Scalar { q: f64::NAN, v: 0.0 });
    let mut bad = Watched::new(|_, x: &Scalar<f64>| [x.q], nowhere);
    let result = fixed.with_events(&OSCILLATOR, 0.0, 3.0, &start, &0.0, &mut bad, |_| ());
    assert!(matches!(result, Err(IntegrationError::NonFinite { .. })), "{result:?}");
    // Infinite values have a sign.
    let step = |t: f64, _: &Scalar<f64>| [if t > 0.55 { f64::INFINITY } else { f64::NEG_INFINITY }];
    let mut jump = Watched::new(step, |_, _| Action::Stop);
    let (.., time) = fixed.with_events(&OSCILLATOR, 0.0, 1.0, &start, &0.0, &mut jump, |_| ()).unwrap();
    assert!((time - 0.55).abs() < 1e-15);
}

/// States at given times, with steps of one length and with chosen ones, in both directions, and between events.
#[test]
fn states_at_given_times() {
    let start = Scalar { q: 1.0, v: 0.0 };
    for (end, count) in [(5.0, 51), (-5.0, 51)] {
        let times = || (0..60).map(|k| f64::from(k) * 0.1_f64.copysign(end));
        let mut seen = Vec::new();
        let mut look = |t: f64, x: &Scalar<f64>| {
            assert!((x.q - t.cos()).abs() < 1e-9 && (x.v + t.sin()).abs() < 1e-9, "{t} {x:?}");
            seen.push(t);
        };
        let tolerant = Integrator::within(Dop853, Tolerance::new(1e-11, 1e-11));
        tolerant.sampled(&OSCILLATOR, 0.0, end, &start, &0.0, times(), &mut look).unwrap();
        let fixed = Integrator::fixed(DormandPrince, 0.03);
        fixed.sampled(&OSCILLATOR, 0.0, end, &start, &0.0, times(), &mut look).unwrap();
        assert_eq!(seen.len(), 2 * count);
        assert!(seen[..count].iter().zip(times()).all(|(a, b)| *a == b) && seen[..count] == seen[count..]);
    }

    let mut ground = Watched::new(|_, x: &Scalar<f64>| [x.q], bounced(0.5)).only(Direction::Falling);
    let mut samples = Samples::new((0..30).map(|k| f64::from(k) * 0.1));
    let mut count = 0;
    let mut look = |t: f64, x: &Scalar<f64>| {
        let bounces = (0..9).take_while(|&k| bounce(0.5, k) < t - 1e-12).count();
        let q = match bounces {
            0 => 5.0 - 5.0 * t * t,
            k => {
                let since = t - bounce(0.5, k as u32 - 1);
                since * (10.0 * 0.5f64.powi(k as i32) - 5.0 * since)
            }
        };
        assert!((x.q - q).abs() < 1e-12, "{t}: {} {q}", x.q);
        count += 1;
    };
    let start = Scalar { q: 5.0, v: 0.0 };
    samples.first(0.0, &start, &mut look);
    Integrator::fixed(Rk4, 0.07)
        .with_events(&Ball, 0.0, 2.95, &start, &(), &mut ground, |interval| samples.within(interval, &mut look))
        .unwrap();
    assert_eq!(count, 30);
}

/// A function that crosses zero thirty million times a second, with a jump at each crossing: an error after a bounded number
/// of them, by steps of one length too.
#[test]
fn crossings_without_end() {
    for step in [1e-3, 1e-2, 1.0] {
        for frequency in [1e8, 1e12] {
            let mut events =
                Watched::new(move |t, _: &Scalar<f64>| [(frequency * t).sin()], |_, x: &Scalar<f64>| Action::Jump(*x));
            let start = Scalar { q: 1.0, v: 0.0 };
            let run = Integrator::fixed(Rk4, step);
            let result = run.with_events(&OSCILLATOR, 0.0, 10.0, &start, &0.0, &mut events, |_| ());
            assert!(matches!(result, Err(IntegrationError::EventsAccumulate { .. })), "{result:?}");
            assert!(events.seen.len() <= 10_001, "{}", events.seen.len());
        }
    }
}
