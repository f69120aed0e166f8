//! Motions in lanes with steps of their own: each takes the steps and comes to the state that it comes to alone, whatever the
//! others do, and fails alone.

use std::fmt::Debug;

use multibody::integrators::SlopeOf;
use multibody::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use multibody::simba::simd::{SimdValue, WideF32x8, WideF64x4};
use multibody::{
    Dop853, DormandPrince, IntegrationError, Integrator, LaneEnds, Method, Real, System, multibody, simulate,
    simulate_lanes,
};

use crate::common::Scalar;

multibody! {
    /// A body that floats, with an arm on an axis askew, pulled by a spring and driven by a law of time.
    pub mod satellite {
        param gain = 1.3;
        param pull = [0.3, -0.2, 0.5];
        state heat: rate = 0.2 * arm.position.x - 0.7 * heat, start: 0.0;
        world { gravity: [0.1, -0.4, 0.2] }
        body hull { mass: 3.0, com: [0.05, -0.02, 0.1], inertia: inertia(0.4, 0.6, 0.5, 0.02, -0.03, 0.01) }
        body arm { mass: 0.7, com: [0.3, 0.1, -0.05], inertia: diag(0.01, 0.05, 0.06) }
        joint base: Free { parent: ground, child: hull }
        joint hinge: Revolute { parent: hull.at([0.2, 0.3, -0.1]).rotated([1, 2, 0.5], 0.7), child: arm, axis: [1, 3, -2] }
        force drive: Effort { joint: hinge, value: gain * sin(3.0 * t) - 0.1 * hinge.rate }
        force wind: Force { at: arm.at([0.5, 0.0, 0.1]), value: pull, axes: ground }
        force spring: Spring { between: [ground.at([0.1, 1.0, 0.3]), arm.at([0.5, 0.0, 0.1])], stiffness: 2.0, length: 0.3 }
        emit forward_dynamics;
    }
}
use satellite::{Model, Params, State};

/// A start in numbers: at rest, turning fast, far away, with a fast arm.
fn start(lane: usize) -> [f64; 16] {
    let [speed, spin, far, arm] =
        [[0.0, 0.0, 0.0, 0.1], [0.3, 9.0, 0.1, -2.0], [-1.5, 0.5, 4.0, 3.0], [0.1, 2.0, -1.0, 25.0]][lane % 4];
    let more = 0.01 * lane as f64;
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(far, 0.3 + more, -spin)).into_inner().coords;
    let position = [far, -0.5 * far, 0.2 + more];
    let hinge = 0.4 * far + 7.0 * lane as f64;
    let rates = [speed, 0.3, -speed, spin, -0.4 * spin, 0.2, arm];
    let mut all = [0.0; 16];
    let list = position.into_iter().chain(turn.iter().copied()).chain([hinge]).chain(rates).chain([more]);
    all.iter_mut().zip(list).for_each(|(all, value)| *all = value);
    all
}

fn state<T: Real>(x: &[T; 16]) -> State<T> {
    let [px, py, pz, i, j, k, w, hinge, vx, vy, vz, wx, wy, wz, rate, heat] = *x;
    let mut state = State::default();
    state.q.base.position = Vector3::new(px, py, pz);
    state.q.base.orientation = UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k));
    state.q.hinge = hinge;
    state.v.base.linear = Vector3::new(vx, vy, vz);
    state.v.base.angular = Vector3::new(wx, wy, wz);
    state.v.hinge = rate;
    state.x.heat = heat;
    state
}

fn numbers<T: Real>(x: &State<T>) -> [T; 16] {
    let (p, o) = (x.q.base.position, x.q.base.orientation.as_ref().coords);
    let (l, w) = (x.v.base.linear, x.v.base.angular);
    [p.x, p.y, p.z, o.x, o.y, o.z, o.w, x.q.hinge, l.x, l.y, l.z, w.x, w.y, w.z, x.v.hinge, x.x.heat]
}

fn model<T: Real>(gain: T) -> Model<T> {
    let pull = Params::<T>::default().pull.map(|pull| pull * gain);
    Model::new(&Params { gain, pull })
}

/// A number from each lane.
fn gathered<T: Real>(of: impl Fn(usize) -> f64) -> T
where
    T::Element: Real,
{
    let mut all = T::lit(0.0);
    (0..T::LANES).for_each(|lane| all.replace(lane, T::Element::lit(of(lane))));
    all
}

fn gain(lane: usize) -> f64 {
    1.3 + 2.0 * lane as f64
}

fn batch<T: Real, M>(integrator: &Integrator<M>, span: (f64, f64)) -> LaneEnds<State<T>>
where
    T::Element: Real,
    M: Method<Model<T>, Memory = SlopeOf<Model<T>>>,
{
    let starts: [T; 16] = std::array::from_fn(|k| gathered(|lane| start(lane)[k]));
    let model = model(gathered(gain));
    integrator.integrate_lanes(&model, span.0, span.1, &state(&starts), &(), |_, _| ()).unwrap()
}

/// Every lane against its motion alone: the same numbers of steps (they may part where rounding decides, which `slack` allows)
/// and the same states.
fn as_alone<T: Real, M>(integrator: Integrator<M>, span: (f64, f64), tolerance: f64, slack: u32)
where
    T::Element: Real,
    M: Method<Model<T>, Memory = SlopeOf<Model<T>>> + Method<Model<T::Element>>,
{
    let ends = batch::<T, M>(&integrator, span);
    assert_eq!(ends.lanes().len(), T::LANES);
    let reached = numbers(&ends.state);
    let mut steps = Vec::new();
    for (lane, end) in ends.lanes().iter().enumerate() {
        let one = start(lane).map(T::Element::lit);
        let alone =
            integrator.integrate(&model(T::Element::lit(gain(lane))), span.0, span.1, &state(&one), &(), |_, _| ());
        let (alone, statistics) = alone.unwrap();
        assert_eq!((end.error, end.time), (None, span.1));
        for (own, other) in [(end.accepted, statistics.accepted), (end.rejected, statistics.rejected)] {
            assert!(own.abs_diff(other) <= slack, "lane {lane}: {end:?} and {statistics:?}");
        }
        for (lanes, alone) in reached.into_iter().zip(numbers(&alone)) {
            let (lanes, alone) = (lanes.extract(lane).greatest(), alone.greatest());
            assert!((lanes - alone).abs() <= tolerance * (1.0 + alone.abs()), "lane {lane}: {lanes} and {alone}");
        }
        steps.push(end.accepted + end.rejected);
    }
    // As many rounds as the longest motion takes steps, and the motions differ.
    let most = steps.iter().max().copied().unwrap_or_default();
    assert!(ends.evaluations <= 13 * most + 20, "{} evaluations, {steps:?}", ends.evaluations);
    assert!(steps.iter().any(|&steps| 2 * steps < most), "{steps:?}");
}

#[test]
fn a_lane_is_what_it_is_alone() {
    as_alone::<WideF64x4, _>(Integrator::adaptive(Dop853, 1e-9, 1e-9), (0.0, 2.0), 1e-9, 1);
    as_alone::<WideF64x4, _>(Integrator::adaptive(DormandPrince, 1e-7, 1e-7), (0.0, 2.0), 1e-9, 1);
    as_alone::<WideF64x4, _>(Integrator::adaptive(Dop853, 1e-9, 1e-9).compensated(), (0.0, 2.0), 1e-9, 1);
    // Backwards, and by single precision.
    as_alone::<WideF64x4, _>(Integrator::adaptive(Dop853, 1e-9, 1e-9), (1.0, -1.0), 1e-9, 1);
    as_alone::<WideF32x8, _>(Integrator::adaptive(DormandPrince, 1e-4, 1e-4), (0.0, 1.0), 2e-3, 4);
    // A scalar that is one lane.
    as_alone_of_one();
}

fn as_alone_of_one() {
    let integrator = Integrator::adaptive(Dop853, 1e-9, 1e-9);
    let (one, model) = (state(&start(1)), model(gain(1)));
    let ends = integrator.integrate_lanes(&model, 0.0, 2.0, &one, &(), |_, _| ()).unwrap();
    let (alone, statistics) = integrator.integrate(&model, 0.0, 2.0, &one, &(), |_, _| ()).unwrap();
    assert_eq!(numbers(&ends.state), numbers(&alone));
    assert_eq!((ends.lanes()[0].accepted, ends.evaluations), (statistics.accepted, statistics.evaluations));
}

/// By an accuracy, with each method that is chosen.
#[test]
fn simulated() {
    for accuracy in [1e-2, 1e-3, 1e-7] {
        let starts: [WideF64x4; 16] = std::array::from_fn(|k| gathered(|lane| start(lane)[k]));
        let wide = model(gathered(gain));
        let ends = simulate_lanes(&wide, 0.0, 1.0, &state(&starts), &(), accuracy, |_, _| ()).unwrap();
        for lane in 0..4 {
            let alone = simulate(&model(gain(lane)), 0.0, 1.0, &state(&start(lane)), &(), accuracy, |_, _| ()).unwrap();
            for (lanes, alone) in numbers(&ends.state).into_iter().zip(numbers(&alone.0)) {
                assert!((lanes.extract(lane) - alone).abs() <= 1e-9 * (1.0 + alone.abs()), "{accuracy:e}");
            }
            assert_eq!(ends.lanes()[lane].accepted, alone.1.accepted);
        }
    }
    let start = State::<WideF64x4>::default();
    let result = simulate_lanes(&Model::default(), 0.0, 1.0, &start, &(), -1.0, |_, _| ());
    assert!(matches!(result, Err(IntegrationError::InvalidArgument { .. })));
}

/// Grows without bound: `q = 1 / (end - t)`.
#[derive(Clone, Copy)]
struct Explosion;

impl System for Explosion {
    type Scalar = WideF64x4;
    type State = Scalar<WideF64x4>;
    type Input = ();
    fn derivative(&self, _t: WideF64x4, x: &Self::State, (): &()) -> (WideF64x4, ()) {
        (WideF64x4::lit(2.0) * x.q * x.q * x.q, ())
    }
    fn position_rates(&self, _t: WideF64x4, x: &Self::State) -> WideF64x4 {
        x.v
    }
}

/// Two lanes end in a singularity, one is bounded in its steps; the others go on as they would.
#[test]
fn a_lane_fails_alone() {
    let (tolerant, ends_at) = (Integrator::adaptive(Dop853, 1e-10, 1e-10), [0.5, 4.0, 0.75, 1e3]);
    let q = WideF64x4::from(ends_at.map(|end| 1.0 / end));
    let first = Scalar { q, v: q * q };
    let ends = tolerant.integrate_lanes(&Explosion, 0.0, 1.0, &first, &(), |_, _| ()).unwrap();
    let result = |lane: usize| ends.lanes()[lane];
    for lane in [0, 2] {
        let end = result(lane);
        assert!(
            matches!(end.error, Some(IntegrationError::StepTooSmall { .. } | IntegrationError::NonFinite { .. })),
            "{end:?}"
        );
        assert!((end.time - ends_at[lane]).abs() < 1e-9, "{end:?}");
        assert!(ends.state.q.extract(lane).is_finite(), "{end:?}"); // what is left is the last good state
    }
    for lane in [1, 3] {
        assert_eq!((result(lane).error, result(lane).time), (None, 1.0));
        assert!((ends.state.q.extract(lane) * (ends_at[lane] - 1.0) - 1.0).abs() < 1e-9);
    }
    let few = tolerant.max_steps(result(1).accepted + result(1).rejected);
    let ends = few.integrate_lanes(&Explosion, 0.0, 1.0, &first, &(), |_, _| ()).unwrap();
    let errors = [0, 1, 2, 3].map(|lane| ends.lanes()[lane].error);
    assert!(matches!(errors, [Some(IntegrationError::TooManySteps { .. }), None, Some(_), None]), "{errors:?}");
}

/// Times and states that are seen belong together, and those of a lane that has arrived stay.
#[test]
fn what_is_seen() {
    let ends_at = [2.0, 40.0, 1e3, 1.1];
    let q = WideF64x4::from(ends_at.map(|end| 1.0 / end));
    let (mut rounds, mut last) = (0, [0.0; 4]);
    let seen = |t: WideF64x4, x: &Scalar<WideF64x4>| {
        rounds += 1;
        for lane in 0..4 {
            let (t, q) = (t.extract(lane), x.q.extract(lane));
            assert!(t >= last[lane] && t <= 1.0);
            assert!((q * (ends_at[lane] - t) - 1.0).abs() < 1e-7);
            last[lane] = t;
        }
    };
    let tolerant = Integrator::adaptive(DormandPrince, 1e-9, 1e-9);
    let first = Scalar { q, v: q * q };
    let ends = tolerant.integrate_lanes(&Explosion, 0.0, 1.0, &first, &(), seen).unwrap();
    assert_eq!(last, [1.0; 4]);
    assert_eq!(rounds, ends.lanes().iter().map(|end| end.accepted + end.rejected).max().unwrap());
    // A span without length has no steps.
    let none = tolerant.integrate_lanes(&Explosion, 1.0, 1.0, &first, &(), |_, _| unreachable!()).unwrap();
    assert_eq!((none.lanes()[0].accepted, none.state.q), (0, q));
}

#[test]
fn refused() {
    let start = Scalar { q: WideF64x4::lit(1.0), v: WideF64x4::lit(0.0) };
    fn refused<Z: Debug>(result: Result<LaneEnds<Z>, IntegrationError>) -> bool {
        matches!(result, Err(IntegrationError::InvalidArgument { .. }))
    }
    let fixed = Integrator::fixed(Dop853, 0.1);
    assert!(refused(fixed.integrate_lanes(&Explosion, 0.0, 1.0, &start, &(), |_, _| ())));
    let tolerant = Integrator::adaptive(Dop853, 1e-6, 0.0);
    assert!(refused(tolerant.integrate_lanes(&Explosion, 0.0, 1.0, &start, &(), |_, _| ())));
    let tolerant = Integrator::adaptive(Dop853, 1e-6, 1e-6);
    assert!(refused(tolerant.integrate_lanes(&Explosion, 0.0, f64::NAN, &start, &(), |_, _| ())));
    let bad = Scalar { q: WideF64x4::from([1.0, 1.0, f64::NAN, 1.0]), ..start };
    let result = tolerant.integrate_lanes(&Explosion, 0.0, 1.0, &bad, &(), |_, _| ());
    assert_eq!(result.unwrap_err(), IntegrationError::NonFinite { time: 0.0 });
}
