//! Laws that act once in a period, against integrations from sample to sample with the input held, and against the closed form
//! of an oscillator under a force that is held.

use std::fmt::Debug;

use multibody::integrators::{Action, Event, Events};
use multibody::nalgebra::{SimdValue, UnitQuaternion, Vector3};
use multibody::simba::simd::WideF64x4;
use multibody::{
    Dop853, DormandPrince, Feedback, GaussLegendre4, GeneralisedAlpha, Held, ImplicitMidpoint, IntegrationError,
    Integrator, Method, Radau, Real, Rk4, Sampled, SemiImplicitEuler, StateSpace, System, closed_loop, multibody,
    sampled, simulate, simulate_lanes, simulate_stiff,
};

multibody! {
    /// A body that floats, with an arm on an axis askew and a motor there, and a state of its own.
    pub mod satellite {
        input torque;
        input push: Vec3;
        state heat: rate = 0.2 * torque * torque - 0.7 * heat, start: 0.0;
        world { gravity: [0.1, -0.4, 0.2] }
        body hull { mass: 3.0, com: [0.05, -0.02, 0.1], inertia: inertia(0.4, 0.6, 0.5, 0.02, -0.03, 0.01) }
        body arm { mass: 0.7, com: [0.3, 0.1, -0.05], inertia: diag(0.01, 0.05, 0.06) }
        joint base: Free { parent: ground, child: hull }
        joint hinge: Revolute { parent: hull.at([0.2, 0.3, -0.1]).rotated([1, 2, 0.5], 0.7), child: arm, axis: [1, 3, -2] }
        force motor: Effort { joint: hinge, value: torque }
        force thruster: Force { at: hull.at([0.1, 0.2, 0.3]), value: push, axes: hull }
        emit forward_dynamics, derivatives;
    }

    pub mod oscillator {
        input force;
        body block { mass: 0.5 }
        joint x: Prismatic { parent: ground, child: block, axis: [2, -1, 3] }
        force spring: Spring { joint: x, stiffness: 4.5 }
        force motor: Effort { joint: x, value: force }
        emit forward_dynamics, derivatives;
    }
}
use satellite::{Input, Model, State};

const PERIOD: f64 = 0.07;

/// A law with a memory: the angle at the sample before, and how many samples there were.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Before {
    angle: f64,
    samples: u32,
}

fn law(t: f64, state: &State, before: &mut Before) -> Input {
    let rate = (state.q.hinge - before.angle) / PERIOD;
    *before = Before { angle: state.q.hinge, samples: before.samples + 1 };
    let torque = 0.3 * (t.sin() - state.q.hinge) - 0.02 * rate;
    Input { torque, push: Vector3::new(0.1, -0.2, 0.05) - 0.3 * state.v.base.linear }
}

fn start() -> State {
    let mut state = State::default();
    state.q.base.orientation = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -1.2, 2.0));
    state.q.hinge = -0.8;
    state.v.base.angular = Vector3::new(0.5, 0.2, -0.7);
    state.v.hinge = 1.5;
    state
}

/// From sample to sample with the input held, `samples` of them, then `rest` `[s]`.
fn by_hand(mut run: impl FnMut(f64, f64, &State, &Input) -> State, samples: u32, rest: f64) -> (State, Before, Input) {
    let (mut state, mut before) = (start(), Before::default());
    let mut input = Input::default();
    for k in 0..samples {
        let t = PERIOD * f64::from(k);
        input = law(t, &state, &mut before);
        let end = if k + 1 == samples { t + rest } else { PERIOD * f64::from(k + 1) };
        state = run(t, end, &state, &input);
    }
    (state, before, input)
}

fn distance(a: &State, b: &State) -> f64 {
    let (a, b) = (a.split(), b.split());
    let turn = a.0.base.orientation.angle_to(&b.0.base.orientation);
    let positions = (a.0.base.position - b.0.base.position).norm() + (a.0.hinge - b.0.hinge).abs() + turn;
    let rates = (a.1.base.linear - b.1.base.linear).norm() + (a.1.base.angular - b.1.base.angular).norm();
    positions + rates + (a.1.hinge - b.1.hinge).abs() + (a.2.heat - b.2.heat).abs()
}

/// Twenty samples and a part of a period, in the way of the method, against the same from sample to sample.
fn check<
    M: Method<Model> + for<'a> Method<Sampled<&'a Model, fn(f64, &State, &mut Before) -> Input, Before>> + Debug,
>(
    integrator: Integrator<M>,
    tolerance: f64,
) {
    let (model, rest) = (Model::default(), 0.4 * PERIOD);
    let end = 20.0 * PERIOD + rest;
    let controlled = sampled(&model, PERIOD, law as fn(f64, &State, &mut Before) -> Input);
    let first = controlled.start(0.0, &start(), Before::default());
    let (reached, _) = integrator.integrate(&controlled, 0.0, end, &first, &(), |_, _| ()).unwrap();
    let run =
        |t0, t1, state: &State, input: &Input| integrator.integrate(&model, t0, t1, state, input, |_, _| ()).unwrap().0;
    let (state, before, input) = by_hand(run, 21, rest);
    let off = distance(&reached.state, &state);
    println!("{:?}: {off:.1e}", integrator.method);
    assert!(off <= tolerance, "{:?}: {off:e}", integrator.method);
    assert_eq!(reached.memory.samples, 21);
    assert!((reached.memory.angle - before.angle).abs() <= tolerance);
    assert!((reached.input.torque - input.torque).abs() <= 10.0 * tolerance);
}

#[test]
fn as_from_sample_to_sample() {
    // Steps that divide the period, and some that don't: those end at samples too.
    for step in [0.01, PERIOD / 3.0, 0.016, 0.2] {
        check(Integrator::fixed(Rk4, step), if step < 0.03 && step != 0.016 { 1e-12 } else { 1e-5 });
        check(Integrator::fixed(SemiImplicitEuler, step), if step < 0.03 && step != 0.016 { 1e-12 } else { 1e-1 });
    }
    check(Integrator::fixed(GaussLegendre4, 0.01), 1e-9);
    check(Integrator::fixed(ImplicitMidpoint, 0.01), 1e-9);
    check(Integrator::fixed(GeneralisedAlpha::new(0.8), PERIOD / 7.0), 1e-9);
    check(Integrator::fixed(GeneralisedAlpha::new(0.8).functional(), PERIOD / 7.0), 1e-9);
    check(Integrator::adaptive(DormandPrince, 1e-11, 1e-11), 1e-8);
    check(Integrator::adaptive(Dop853, 1e-12, 1e-12), 1e-9);
    check(Integrator::adaptive(Radau, 1e-11, 1e-11), 1e-8);
    check(Integrator::adaptive(Dop853, 1e-12, 1e-12).compensated(), 1e-9);
}

/// A proportional law on a spring, in closed form from sample to sample; a long run, by all that takes a system.
#[test]
fn an_oscillator_in_closed_form() {
    use oscillator::{Input, Model, State};
    let model = Model::<f64>::default();
    let (period, frequency) = (0.1_f64, 3.0_f64);
    let gain = |q: f64, v: f64| -0.8 * q - 0.9 * v;
    let (mut q, mut v, mut u) = (1.0, 0.0, 0.0);
    let samples = 1000;
    for _ in 0..samples {
        u = gain(q, v);
        let rest = u / 4.5;
        let (sin, cos) = (frequency * period).sin_cos();
        (q, v) = (rest + (q - rest) * cos + v / frequency * sin, v * cos - (q - rest) * frequency * sin);
    }
    let controlled = sampled(model, period, |_, x: &State, (): &mut ()| Input { force: gain(x.q.x, x.v.x) });
    let mut first = State::default();
    first.q.x = 1.0;
    let first = controlled.start(0.0, &first, ());
    let end = f64::from(samples) * period;
    let near = |name: &str, held: &Held<State, Input, ()>, tolerance: f64| {
        let off = (held.state.q.x - q).hypot(held.state.v.x - v);
        println!("{name}: {off:.1e}");
        assert!(off < tolerance, "{name}: {off:e}");
        assert!(
            (held.input.force - gain(q, v)).abs() < 3.0 * tolerance && (held.input.force - u).abs() < 1.0,
            "{name}"
        );
    };
    let (reached, _) = simulate(&controlled, 0.0, end, &first, &(), 1e-10, |_, _| ()).unwrap();
    near("simulate", &reached, 1e-10);
    let (reached, _) = simulate_stiff(&controlled, 0.0, end, &first, &(), 1e-10, |_, _| ()).unwrap();
    near("simulate_stiff", &reached, 1e-9);
    let reached = Rk4::integrate(&controlled, 0.0, &first, &(), period / 50.0, 50 * samples, |_, _| ()).unwrap();
    near("Rk4::integrate", &reached, 1e-9);
    let mut stepped = first;
    for k in 0..50 * samples {
        stepped = Rk4::step(&controlled, period / 50.0 * f64::from(k), &stepped, &(), period / 50.0);
    }
    near("Rk4::step", &stepped, 1e-9);

    // States within steps, asked for between samples, follow the input that was held there.
    let mut seen = 0;
    let times = (0..200).map(|k| 0.013 + 0.05 * f64::from(k));
    let tolerant = Integrator::adaptive(Dop853, 1e-11, 1e-11);
    let (mut q, mut v, mut sample) = (1.0, 0.0, 0.0);
    let _ = tolerant.sampled(&controlled, 0.0, 10.0, &first, &(), times, |t, held| {
        while t >= sample + period {
            let rest = gain(q, v) / 4.5;
            let (sin, cos) = (frequency * period).sin_cos();
            (q, v) = (rest + (q - rest) * cos + v / frequency * sin, v * cos - (q - rest) * frequency * sin);
            sample += period;
        }
        let rest = gain(q, v) / 4.5;
        let (sin, cos) = (frequency * (t - sample)).sin_cos();
        assert!((held.state.q.x - (rest + (q - rest) * cos + v / frequency * sin)).abs() < 1e-8, "{t}");
        assert!((held.input.force - gain(q, v)).abs() < 1e-8, "{t}");
        seen += 1;
    });
    assert_eq!(seen, 200);
}

/// A wall that throws the oscillator back between two samples.
struct Wall;

impl<S: System<Scalar = f64, State = Held<oscillator::State, oscillator::Input, u32>>> Events<S, 1> for Wall {
    fn values(&self, _t: f64, held: &S::State) -> [f64; 1] {
        [held.state.q.x + 0.5]
    }
    fn happened(&mut self, _event: &Event, held: &S::State) -> Action<S::State> {
        let mut next = *held;
        next.state.v.x = -next.state.v.x;
        Action::Jump(next)
    }
}

#[test]
fn events_between_samples() {
    use oscillator::{Input, Model, State};
    let (period, model) = (0.1, Model::<f64>::default());
    let law = |_: f64, x: &State, samples: &mut u32| {
        *samples += 1;
        Input { force: 0.4 * x.v.x }
    };
    let controlled = sampled(model, period, law);
    let mut first = State::default();
    first.q.x = 1.0;
    let run = |integrator: Integrator<Dop853>| {
        let first = controlled.start(0.0, &first, 0);
        integrator.with_events(&controlled, 0.0, 8.03, &first, &(), &mut Wall, |_| ()).unwrap().0
    };
    let reached = run(Integrator::adaptive(Dop853, 1e-11, 1e-11));
    let fixed = run(Integrator::fixed(Dop853, 0.03));
    assert_eq!((reached.memory, fixed.memory), (81, 81));

    // Once more by hand: where a step passes the wall, its time is found by bisection of the closed form.
    let motion = |q: f64, v: f64, u: f64, t: f64| {
        let (rest, (sin, cos)) = (u / 4.5, (3.0 * t).sin_cos());
        (rest + (q - rest) * cos + v / 3.0 * sin, v * cos - (q - rest) * 3.0 * sin)
    };
    let (mut q, mut v) = (1.0, 0.0);
    for k in 0..81 {
        let u = 0.4 * v;
        let mut left = if k == 80 { 0.03 } else { period };
        for _ in 0..2 {
            let fine = |n: i32| f64::from(n) * left / 1000.0;
            let Some(n) = (1..=1000).find(|&n| motion(q, v, u, fine(n)).0 < -0.5) else { break };
            let (mut low, mut high) = (fine(n - 1), fine(n));
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if motion(q, v, u, middle).0 < -0.5 { high = middle } else { low = middle }
            }
            (q, v) = motion(q, v, u, low);
            (v, left) = (-v, left - low);
        }
        (q, v) = motion(q, v, u, left);
    }
    for held in [reached, fixed] {
        assert!((held.state.q.x - q).hypot(held.state.v.x - v) < 1e-6, "{held:?} {q} {v}");
    }
}

#[test]
fn lanes_that_share_their_steps() {
    use oscillator::{Input, Model, State};
    fn run<T: Real>(starts: T) -> (T, T) {
        let law = |_: T, x: &State<T>, (): &mut ()| Input { force: -x.q.x - T::lit(0.3) * x.v.x };
        let controlled = sampled(Model::<T>::default(), T::lit(0.1), law);
        let mut first = State::default();
        first.q.x = starts;
        let first = controlled.start(T::lit(0.0), &first, ());
        let integrator = Integrator::fixed(Rk4, 0.015);
        let end = integrator.integrate(&controlled, 0.0, 3.05, &first, &(), |_, _| ()).unwrap().0;
        (end.state.q.x, end.input.force)
    }
    let starts = [1.0, -0.2, 3.0, 0.0];
    let (q, force) = run(WideF64x4::from(starts));
    for (lane, start) in starts.into_iter().enumerate() {
        let (alone, pushed) = run(start);
        assert!((q.extract(lane) - alone).abs() < 1e-13 && (force.extract(lane) - pushed).abs() < 1e-13);
    }
    let (single, _) = run(1.0_f32);
    assert!((f64::from(single) - run(1.0).0).abs() < 1e-5);
}

#[test]
fn what_cannot_be_sampled_is_refused() {
    use oscillator::{Input, Model, State};
    let model = Model::<f64>::default();
    let with = |period| sampled(model, period, |_, x: &State, (): &mut ()| Input { force: -x.v.x });
    let told = |result: Result<(), IntegrationError>, what: &str| {
        let error = result.unwrap_err();
        assert!(matches!(error, IntegrationError::InvalidArgument { .. }), "{error}");
        assert!(error.to_string().contains(what), "{error}");
    };
    let mut first = State::default();
    first.q.x = 1.0;
    let good = with(0.1);
    let held = good.start(0.0, &first, ());
    let fixed = Integrator::fixed(Rk4, 0.01);
    let run = |system: &_, t0, t1, held: Held<State, Input, ()>| {
        fixed.integrate(system, t0, t1, &held, &(), |_, _| ()).map(|_| ())
    };
    for period in [0.0, -0.1, f64::NAN] {
        told(run(&with(period), 0.0, 1.0, with(period).start(0.0, &first, ())), "positive period");
    }
    told(run(&good, 5.0, 6.0, held), "starts at the time for which it was made");
    told(run(&good, 0.0, -1.0, held), "forwards");
    told(Rk4::integrate(&good, 0.0, &held, &(), 0.03, 10, |_, _| ()).map(|_| ()), "divide the period");
    told(Rk4::integrate(&good, 0.0, &held, &(), -0.01, 10, |_, _| ()).map(|_| ()), "forwards");
    assert!(Rk4::step(&good, 0.08, &held, &(), 0.03).state.v.x.is_nan());
    assert!(!Rk4::step(&good, 0.08, &held, &(), 0.02).state.v.x.is_nan());

    let wide = sampled(Model::<WideF64x4>::default(), WideF64x4::lit(0.1), |_, _: &_, (): &mut ()| {
        oscillator::Input::default()
    });
    let start = wide.start(WideF64x4::lit(0.0), &oscillator::State::default(), ());
    told(simulate_lanes(&wide, 0.0, 1.0, &start, &(), 1e-6, |_, _| ()).map(|_| ()), "lanes");
    // Lanes that come to a sample at different times: nothing goes on.
    let times = WideF64x4::from([0.0, 0.0, 0.09, 0.0]);
    let late = Rk4::step(&wide, times, &start, &(), WideF64x4::lit(0.01));
    let after = Rk4::step(&wide, times + WideF64x4::lit(0.01), &late, &(), WideF64x4::lit(0.01));
    assert!((0..4).all(|lane| after.state.v.x.extract(lane).is_nan()));
}

/// An integration that goes on where another ended has the samples of one.
#[test]
fn goes_on_where_it_ended() {
    let controlled = sampled(Model::default(), PERIOD, law);
    let integrator = Integrator::adaptive(Dop853, 1e-12, 1e-12);
    let first = controlled.start(0.0, &start(), Before::default());
    let whole = integrator.integrate(&controlled, 0.0, 3.0, &first, &(), |_, _| ()).unwrap().0;
    let mut state = first;
    for k in 0..30 {
        let (t0, t1) = (0.1 * f64::from(k), 0.1 * f64::from(k + 1));
        state = integrator.integrate(&controlled, t0, t1, &state, &(), |_, _| ()).unwrap().0;
    }
    assert_eq!(state.memory.samples, whole.memory.samples);
    assert!(distance(&state.state, &whole.state) < 1e-9);
    let _: Feedback<_, _> = closed_loop(Model::default(), |_, _: &State| Input::default());
}
