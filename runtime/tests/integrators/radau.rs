//! Radau IIA: its function of stability, its order, stiff systems with known or independent solutions, and its economy.

use crate::common::stiff::{
    Decay, Follower, Held, Linear, Pair, Plane, Rubbing, SpringPendulum, VanDerPol, Winding, turned,
};
use crate::common::{Body, Currents, Driven, Flight, Scalar, distance};
use multibody::linear::Square;
use multibody::nalgebra::{Vector2, Vector3};
use multibody::simba::simd::WideF64x4;
use multibody::{
    Configuration, Differentiable, DormandPrince, IntegrationError, Integrator, JacobianMatrix, Radau, Real,
    SecondOrder, StateSpace, Statistics, System, Tangent, Tolerance, Twist,
};

/// The derivatives that the other tests rest on, against central differences.
#[test]
fn derivatives_of_the_systems() {
    fn check<S: Differentiable<Scalar = f64> + SecondOrder>(system: &S, state: &S::State, input: &S::Input) {
        let jacobian = system.jacobian(0.3, state, input);
        let (q, v, x) = state.split();
        let count = v.len();
        let step = 1e-6;
        for j in 0..S::Matrix::SIZE {
            let mut place = 0..;
            let mut unit = |_: f64| if place.next() == Some(j) { step } else { 0.0 };
            let (dv, dx) = (v.map(&mut unit), x.map(&mut unit));
            let mut slopes = [[0.0; 16]; 4];
            let states = [
                state.join(q.displace(&S::as_displacement(dv)), v, x),
                state.join(q.displace(&S::as_displacement(dv.scale(-1.0))), v, x),
                state.join(q, v.add(&dv), x.add(&dx)),
                state.join(q, v.add_scaled(-1.0, &dv), x.add_scaled(-1.0, &dx)),
            ];
            for (slopes, state) in slopes.iter_mut().zip(states) {
                let (a, r) = system.derivative(0.3, &state, input);
                let mut places = slopes.iter_mut();
                let mut fill = |(), c| *places.next().unwrap() = c;
                a.fold((), &mut fill);
                r.fold((), &mut fill);
            }
            let [right, left, up, down] = slopes;
            for i in 0..S::Matrix::SIZE {
                let by_position = if j < count { (right[i] - left[i]) / (2.0 * step) } else { 0.0 };
                let by_rate = (up[i] - down[i]) / (2.0 * step);
                let found = [S::Matrix::by_position(&jacobian, i, j), S::Matrix::by_rates(&jacobian, i, j)];
                for (found, seen) in found.into_iter().zip([by_position, by_rate]) {
                    assert!((found - seen).abs() < 1e-6 * (1.0 + found.abs()), "{i} {j}: {found} and {seen}");
                }
            }
        }
    }
    check(&VanDerPol(0.1), &Scalar { q: 0.4, v: 1.1 }, &0.0);
    check(&Follower { stiffness: 3.0, damping: 2.0 }, &Scalar { q: 0.4, v: 1.1 }, &0.0);
    check(&Linear { stiffness: 3.0, damping: 2.0 }, &Scalar { q: 0.4, v: 1.1 }, &0.0);
    check(&Decay(-3.0), &Driven { q: 0.4, v: 1.1, x: Currents { current: 0.5 } }, &());
    check(&Winding { inductance: 0.2 }, &Driven { q: 0.4, v: 1.1, x: Currents { current: 0.5 } }, &2.0);
    let spring = SpringPendulum { stiffness: 30.0, damping: 2.0 };
    check(&spring, &Plane { q: Vector2::new(0.7, -0.9), v: Vector2::new(0.4, 0.8) }, &());
    let held = Held { body: Body::floating(), stiffness: 3.0, damping: 2.0 };
    let state = Flight { q: turned([0.5, -0.3, 0.9]), ..Body::spinning() };
    check(&held, &state, &Vector3::new(0.1, 0.2, 0.3));
}

/// One step on `x' = z x` multiplies by `(1 + 2z/5 + z^2/20) / (1 - 3z/5 + 3z^2/20 - z^3/60)` (Hairer and Wanner, table
/// IV.3.1), which vanishes as `-3/z`: L-stability.
#[test]
fn function_of_stability() {
    for z in [-1e-3, -0.3, -3.0, -1e2, -1e4, -1e8, -1e12, 1.0] {
        let start = Driven { q: 0.0, v: 0.0, x: Currents { current: 1.0 } };
        let end = Radau::step(&Decay(2.0 * z), 0.0, &start, &(), 0.5);
        let expected = (1.0 + 0.4 * z + 0.05 * z * z) / (1.0 - 0.6 * z + 0.15 * z * z - z * z * z / 60.0);
        let error = (end.x.current - expected).abs();
        assert!(error < 1e-14 * (1.0 + expected.abs()), "{z:e}: {} and {expected}", end.x.current);
        assert!(expected.abs() < 4.0);
    }
    // A coordinate: both eigenvalues at once, by the same function of the matrix [0, 1; -k, -c].
    for (stiffness, damping) in [(4.0, 0.3), (1e4, 10.0), (1e10, 1e3), (1e10, 0.0)] {
        let h = 0.1;
        let m = multibody::nalgebra::Matrix2::new(0.0, h, -stiffness * h, -damping * h);
        let one = multibody::nalgebra::Matrix2::identity();
        let numerator = one + m * 0.4 + m * m * 0.05;
        let denominator = one - m * 0.6 + m * m * 0.15 - m * m * m / 60.0;
        let expected = denominator.try_inverse().unwrap() * (numerator * Vector2::new(1.0, 2.0));
        let end = Radau::step(&Linear { stiffness, damping }, 0.0, &Scalar { q: 1.0, v: 2.0 }, &0.0, h);
        let scale = 1e-12 * (1.0 + stiffness.sqrt());
        assert!((end.q - expected.x).abs() < 1e-12, "{stiffness:e}: {} and {}", end.q, expected.x);
        assert!((end.v - expected.y).abs() < scale, "{stiffness:e}: {} and {}", end.v, expected.y);
    }
}

type Position<S> = <<S as System>::State as StateSpace>::Position;

/// The order seen between `steps` and twice as many, against a finer run of another method.
fn observed<S: Differentiable<Scalar = f64>>(
    system: &S,
    start: &S::State,
    input: &S::Input,
    steps: u32,
    position: impl Fn(&Position<S>, &Position<S>) -> f64,
) -> f64 {
    let span = 2.0;
    let run = |n: u32| {
        let fixed = Integrator::fixed(Radau, span / f64::from(n));
        fixed.integrate(system, 0.5, 0.5 + span, start, input, |_, _| ()).unwrap().0
    };
    let fine = DormandPrince::integrate(system, 0.5, start, input, span / 3000.0, 3000, |_, _| ()).unwrap();
    let error = |n: u32| distance(&run(n), &fine, &position);
    let (coarse, halved) = (error(steps), error(2 * steps));
    let order = (coarse / halved).log2();
    println!("errors {coarse:.2e}, {halved:.2e}: order {order:.3}");
    order
}

#[test]
fn fifth_order() {
    let spring = SpringPendulum { stiffness: 30.0, damping: 0.2 };
    let swinging = Plane { q: Vector2::new(0.9, -0.9), v: Vector2::new(0.4, 0.8) };
    let motor = Driven { q: 0.2, v: 0.0, x: Currents { current: 0.0 } };
    let held = Held { body: Body::floating(), stiffness: 3.0, damping: 0.2 };
    let orders = [
        observed(&spring, &swinging, &(), 160, |a, b| (a - b).norm()),
        observed(&Winding { inductance: 0.5 }, &motor, &3.0, 40, |a, b| (a - b).abs()),
        observed(&VanDerPol(0.5), &Scalar { q: 2.0, v: 0.0 }, &0.0, 80, |a, b| (a - b).abs()),
        observed(&held, &Body::spinning(), &Vector3::zeros(), 60, |a, b| a.orientation.angle_to(&b.orientation)),
    ];
    for order in orders {
        assert!((order - 5.0).abs() < 0.1, "{orders:?}");
    }
}

/// A body that turns by 1000 rad/s about an axis near its greatest inertia, by steps of a tenth to a third of a radian:
/// order and Newton's convergence survive the derivatives of `dexp_inv` that its matrix leaves out.
#[test]
fn fast_spin() {
    let held = Held { body: Body::floating(), stiffness: 0.0, damping: 0.0 };
    let spin = Twist { linear: Vector3::zeros(), angular: Vector3::new(20.0, 30.0, 1000.0) };
    let start = Flight { q: turned([0.1, 0.2, 0.3]), v: spin };
    let span = 0.02;
    let run = |n: u32| {
        let fixed = Integrator::fixed(Radau, span / f64::from(n));
        fixed.integrate(&held, 0.0, span, &start, &Vector3::zeros(), |_, _| ()).unwrap()
    };
    let fine = DormandPrince::integrate(&held, 0.0, &start, &Vector3::zeros(), span / 2e4, 20_000, |_, _| ()).unwrap();
    let error = |n: u32| {
        let (end, statistics) = run(n);
        let error = end.q.orientation.angle_to(&fine.q.orientation);
        println!("{n} steps: {error:.2e} rad, {statistics:?}");
        assert!(statistics.evaluations < 36 * n, "{statistics:?}");
        error
    };
    let order = (error(80) / error(160)).log2();
    println!("order {order:.3}");
    assert!((order - 5.0).abs() < 0.1);
}

/// Solutions for mu = 1e-6 from q = 2, v = -0.66, of 23 digits: `tests/data/motion/van_der_pol.json`.
const VAN_DER_POL: [(f64, [f64; 2]); 2] = [
    (1.0, [-1.863_646_006_138_872, 0.753_543_268_361_539_4]),
    (2.0, [1.706_167_437_543_195, -0.892_810_016_510_051_1]),
];

fn run<S: Differentiable<Scalar = f64>>(
    system: &S,
    tolerance: f64,
    (t0, t1): (f64, f64),
    start: &S::State,
    input: &S::Input,
) -> (S::State, Statistics) {
    Integrator::adaptive(Radau, tolerance, tolerance).integrate(system, t0, t1, start, input, |_, _| ()).unwrap()
}

#[test]
fn van_der_pol() {
    let system = VanDerPol(1e-6);
    let mut last = f64::INFINITY;
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let mut state = Scalar { q: 2.0, v: -0.66 };
        let (mut t, mut worst) = (0.0, 0.0_f64);
        let mut total = Statistics::default();
        for (end, [q, v]) in VAN_DER_POL {
            let (next, statistics) = run(&system, tolerance, (t, end), &state, &0.0);
            worst = worst.max((next.q - q).abs()).max((next.v - v).abs());
            total.evaluations += statistics.evaluations;
            total.jacobians += statistics.jacobians;
            total.factorisations += statistics.factorisations;
            total.accepted += statistics.accepted;
            total.rejected += statistics.rejected;
            (t, state) = (end, next);
        }
        println!("tolerance {tolerance:e}: error {worst:.2e}, {total:?}");
        assert!(worst < 100.0 * tolerance && worst < last);
        assert!(total.accepted < 3000 && total.jacobians <= total.accepted && total.rejected * 2 < total.accepted);
        last = worst;
    }
}

/// Springs and dampers far faster than the motion: the exact solution stays `cos t`, and steps follow it alone.
#[test]
fn follower_of_a_moving_point() {
    for (stiffness, damping) in [(1e2, 2e1), (1e6, 2e3), (1e10, 1e7), (1e14, 1e8)] {
        let system = Follower { stiffness, damping };
        let (end, statistics) = run(&system, 1e-8, (0.0, 10.0), &Scalar { q: 1.0, v: 0.0 }, &0.0);
        let error = (end.q - 10f64.cos()).abs().max((end.v + 10f64.sin()).abs());
        println!("stiffness {stiffness:e}: error {error:.2e}, {statistics:?}");
        assert!(error < 1e-7 && statistics.accepted < 400, "{error:e} {statistics:?}");
        assert!(statistics.jacobians < 10 && 5 * statistics.factorisations < 3 * statistics.accepted);
    }
}

/// Against Dormand and Prince's method, with steps that its stability allows.
#[test]
fn stiff_spring_pendulum() {
    let system = SpringPendulum { stiffness: 1e6, damping: 2e3 };
    let start = Plane { q: Vector2::new(0.8, -0.6), v: Vector2::zeros() };
    let (exact, explicit) =
        Integrator::adaptive(DormandPrince, 1e-12, 1e-12).integrate(&system, 0.0, 2.0, &start, &(), |_, _| ()).unwrap();
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let (end, statistics) = run(&system, tolerance, (0.0, 2.0), &start, &());
        let (rough, bound) = Integrator::adaptive(DormandPrince, tolerance, tolerance)
            .integrate(&system, 0.0, 2.0, &start, &(), |_, _| ())
            .unwrap();
        let error = |end: &Plane<f64>| (end.q - exact.q).norm().max((end.v - exact.v).norm());
        let (error, other) = (error(&end), error(&rough));
        println!("tolerance {tolerance:e}: error {error:.2e}, {statistics:?}; Dormand-Prince {other:.2e}, {bound:?}");
        assert!(error < 30.0 * tolerance, "{error:e}");
        assert!(bound.evaluations > 4 * statistics.evaluations);
    }
    assert!(explicit.accepted > 1000);
}

/// A winding that is a million times faster than the arm: the current follows the voltage at once.
#[test]
fn fast_winding() {
    let system = Winding { inductance: 1e-6 };
    let start = Driven { q: 0.2, v: 0.0, x: Currents { current: 0.0 } };
    let (end, statistics) = run(&system, 1e-9, (0.0, 5.0), &start, &3.0);
    println!("{statistics:?}");
    // Without the winding: current (3 - v/2) / 2 up to terms of the inductance, which are 1e-6 of it.
    struct Quasi;
    impl System for Quasi {
        type Scalar = f64;
        type State = Scalar<f64>;
        type Input = ();
        fn derivative(&self, _t: f64, s: &Scalar<f64>, (): &()) -> (f64, ()) {
            (0.5 * (3.0 - 0.5 * s.v) / 2.0 - 0.1 * s.v - s.q.sin(), ())
        }
        fn position_rates(&self, _t: f64, s: &Scalar<f64>) -> f64 {
            s.v
        }
    }
    let quasi = DormandPrince::integrate(&Quasi, 0.0, &Scalar { q: 0.2, v: 0.0 }, &(), 1e-3, 5000, |_, _| ()).unwrap();
    let error = (end.q - quasi.q).abs().max((end.v - quasi.v).abs());
    println!("{error:.2e} from the motion without the winding");
    assert!(error < 3e-6 && statistics.accepted < 300);
    assert!((end.x.current - (3.0 - 0.5 * end.v) / 2.0).abs() < 1e-5);
}

/// A body with stiff springs and dampers comes to rest in the axes of the world, in few steps.
#[test]
fn stiff_rotation() {
    let system = Held { body: Body::floating(), stiffness: 1e6, damping: 1e5 };
    let start = Flight { q: turned([0.5, -1.0, 0.8]), ..Body::spinning() };
    let none = Vector3::zeros();
    let fine = Integrator::adaptive(DormandPrince, 1e-12, 1e-12);
    let (exact, explicit) = fine.integrate(&system, 0.0, 0.05, &start, &none, |_, _| ()).unwrap();
    for tolerance in [1e-5, 1e-7, 1e-9] {
        let (end, statistics) = run(&system, tolerance, (0.0, 0.05), &start, &none);
        let angle = end.q.orientation.angle_to(&exact.q.orientation);
        let rate = (end.v.angular - exact.v.angular).norm();
        println!("tolerance {tolerance:e}: {angle:.2e} rad, {rate:.2e} rad/s, {statistics:?}, explicit {explicit:?}");
        assert!(angle < 10.0 * tolerance && rate < 100.0 * tolerance);
        assert!(10 * statistics.evaluations < explicit.evaluations);
        assert!((end.q.orientation.as_ref().norm() - 1.0).abs() < 4e-16);
    }
    let (rest, statistics) = run(&system, 1e-8, (0.0, 1e4), &start, &none);
    println!("to 1e4 s: {statistics:?}");
    assert!(rest.v.angular.norm() < 1e-6 && rest.q.orientation.angle() < 1e-6 && statistics.accepted < 400);
}

/// Errors follow the tolerance on problems that are not stiff, too, and work grows with its sixth root.
#[test]
fn error_follows_the_tolerance() {
    let spring = SpringPendulum { stiffness: 30.0, damping: 0.2 };
    let start = Plane { q: Vector2::new(0.9, -0.9), v: Vector2::new(0.4, 0.8) };
    let fine = DormandPrince::integrate(&spring, 0.0, &start, &(), 1e-3, 10_000, |_, _| ()).unwrap();
    let mut work = Vec::new();
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let (end, statistics) = run(&spring, tolerance, (0.0, 10.0), &start, &());
        let error = (end.q - fine.q).norm().max((end.v - fine.v).norm());
        println!("tolerance {tolerance:e}: error {error:.2e}, {statistics:?}");
        assert!(error < 300.0 * tolerance, "{error:e}");
        work.push(f64::from(statistics.accepted));
    }
    assert!(work[3] / work[0] < 15.0, "{work:?}");
}

/// The polynomial within a step is off by no more than fourth order.
#[test]
fn dense_output() {
    let system = Follower { stiffness: 10.0, damping: 1.0 };
    let worst = |n: u32| {
        let mut worst = 0.0_f64;
        let fixed = Integrator::fixed(Radau, 4.0 / f64::from(n));
        let look = |interval: &multibody::integrators::Interval<'_, Follower<f64>, Radau>| {
            for k in 0..=20 {
                let t = interval.start() + 0.05 * f64::from(k) * (interval.end() - interval.start());
                worst = worst.max((interval.at(t).q - t.cos()).abs());
            }
        };
        fixed.intervals(&system, 0.0, 4.0, &Scalar { q: 1.0, v: 0.0 }, &0.0, look).unwrap();
        worst
    };
    let order = (worst(20) / worst(40)).log2();
    println!("order of dense output {order:.2}, error {:.2e}", worst(40));
    assert!(order > 3.7);
}

#[test]
fn single_precision_and_lanes() {
    let system = VanDerPol(1e-3_f32);
    let start = Scalar { q: 2.0_f32, v: -0.66 };
    let single = Integrator::adaptive(Radau, 1e-4, 1e-4).integrate(&system, 0.0, 0.5, &start, &0.0, |_, _| ()).unwrap();
    let double = run(&VanDerPol(1e-3), 1e-10, (0.0, 0.5), &Scalar { q: 2.0, v: -0.66 }, &0.0).0;
    println!("f32 {single:?}, f64 {double:?}");
    assert!((f64::from(single.0.q) - double.q).abs() < 1e-3 && single.1.accepted < 100);

    let wide = WideF64x4::lit;
    let start = Scalar { q: WideF64x4::from([2.0, 1.5, -2.0, 0.0]), v: WideF64x4::from([-0.66, 0.0, 0.66, 0.0]) };
    let lanes = VanDerPol(wide(1e-3));
    let (end, _) =
        Integrator::adaptive(Radau, 1e-8, 1e-8).integrate(&lanes, 0.0, 0.5, &start, &wide(0.0), |_, _| ()).unwrap();
    let found = end.q.into_arr();
    assert!((found[0] - double.q).abs() < 1e-6 && found[0] == -found[2] && found[3] == 0.0);
    let stepped = Radau::step(&lanes, wide(0.0), &start, &wide(0.0), WideF64x4::from([1e-3, 1e-4, 1e-5, 0.0]));
    assert!(stepped.q.into_arr().iter().all(|q| q.is_finite()) && stepped.q.into_arr()[3] == 0.0);
}

/// Whatever the numbers, an integration ends, in a typed error where there is no solution.
#[test]
fn failures() {
    let system = VanDerPol(1e-6);
    let start = Scalar { q: 2.0, v: -0.66 };
    // One step over several jumps has no solution near its start, or one that is finite.
    let fixed = Integrator::fixed(Radau, 0.9).integrate(&system, 0.0, 1.8, &start, &0.0, |_, _| ());
    assert!(matches!(fixed, Err(IntegrationError::NoConvergence { .. })) || fixed.is_ok_and(|(x, _)| x.q.is_finite()));
    for bad in [f64::NAN, f64::INFINITY] {
        let result = Integrator::adaptive(Radau, 1e-6, 1e-6).integrate(&system, 0.0, 1.0, &start, &bad, |_, _| ());
        assert!(matches!(result, Err(IntegrationError::NonFinite { .. })), "{result:?}");
        let result = Integrator::fixed(Radau, 0.1).integrate(&system, 0.0, 1.0, &start, &bad, |_, _| ());
        assert!(matches!(result, Err(IntegrationError::NonFinite { .. })), "{result:?}");
        assert!(!Radau::step(&system, 0.0, &start, &bad, 0.1).q.is_finite());
    }
    // A singular iteration matrix: x' = z x with 1 - h J singular where z h is the real eigenvalue.
    let growing = Decay(3.637_834_252_744_496);
    let state = Driven { q: 0.0, v: 0.0, x: Currents { current: 1.0 } };
    let (end, _) =
        Integrator::adaptive(Radau, 1e-6, 1e-6).integrate(&growing, 0.0, 3.0, &state, &(), |_, _| ()).unwrap();
    assert!((end.x.current / (3.0 * growing.0).exp() - 1.0).abs() < 1e-4);
    for dt in [1e-18, 1e3, 1e300, 5e-324] {
        let end = Radau::step(&Linear { stiffness: 1e4, damping: 1e3 }, 0.0, &start, &0.0, dt);
        println!("step {dt:e}: {end:?}");
        assert!(dt > 1e10 || (end.q.is_finite() && end.v.is_finite()));
    }
    let tolerance = Tolerance { min_step: 1e-3, ..Tolerance::new(1e-6, 1e-6) };
    let result = Integrator::within(Radau, tolerance).integrate(&system, 0.0, 2.0, &start, &0.0, |_, _| ());
    assert!(matches!(result, Err(IntegrationError::StepTooSmall { .. } | IntegrationError::NoConvergence { .. })));
}

/// An iteration that goes round in a circle has not converged, however small the circle, unless it is one of roundings.
#[test]
fn what_stalls_above_rounding_has_not_converged() {
    fn check<T: Real>(force: f64) {
        let start = Scalar { q: T::lit(0.3), v: T::lit(0.01 * force) };
        let run = Integrator::fixed(Radau, 0.1).integrate(&Rubbing(T::lit(force)), 0.0, 0.1, &start, &(), |_, _| ());
        assert!(matches!(run, Err(IntegrationError::NoConvergence { .. })), "{force:e}: {:?}", run.map(|run| run.1));
    }
    for force in [1.0, 1e-3, 1e-6, 1e-9, 1e-12] {
        check::<f64>(force);
    }
    for force in [1.0, 1e-2, 1e-4] {
        check::<f32>(force);
    }
    // Some circles are left at the bound of iterations, and not because they grow.
    for share in 1..10 {
        let start = Scalar { q: 0.3, v: 0.01 * f64::from(share) };
        let run = Integrator::fixed(Radau, 0.1).integrate(&Rubbing(1.0), 0.0, 0.1, &start, &(), |_, _| ());
        assert!(matches!(run, Err(IntegrationError::NoConvergence { .. })), "{share}: {:?}", run.map(|run| run.1));
    }
    // Circles that rounding hides.
    let start = Scalar { q: 0.3, v: 1e-19 };
    let (end, _) = Integrator::fixed(Radau, 0.1).integrate(&Rubbing(1e-17), 0.0, 0.1, &start, &(), |_, _| ()).unwrap();
    assert!((end.q - 0.3).abs() < 1e-16);
}

/// Two masses between stiff springs, far from the origin: their places round to more than a spring's stretch, and so
/// do velocities, by that over the step. There the iteration stalls, and has converged.
#[test]
fn what_stalls_at_the_rounding_of_stiff_springs_has_converged() {
    fn check<T: Real>(stiffness: f64, place: f64, dt: f64) {
        let lit = T::lit;
        let start =
            Plane { q: Vector2::new(lit(1.1 * place), lit(1.1 * place + 1.0)), v: Vector2::from([lit(1.0); 2]) };
        let run =
            Integrator::fixed(Radau, dt).integrate(&Pair(lit(stiffness)), 0.0, 100.0 * dt, &start, &(), |_, _| ());
        let (end, statistics) = run.unwrap();
        let off = (end.q.x - lit(1.1 * place + 100.0 * dt)).greatest().abs();
        let bound = 100.0 * T::epsilon().greatest() * (1.0 + 1.1 * place + 100.0 * dt);
        assert!(statistics.evaluations < 1000, "{stiffness:e} {place:e} {dt:e}: {}", statistics.evaluations);
        assert!(off <= bound, "{stiffness:e} {place:e} {dt:e}: {off:e}");
    }
    for stiffness in [1e4, 1e8, 1e12] {
        for place in [0.0, 1e3, 1e6] {
            for dt in [1e-1, 1e-3] {
                check::<f64>(stiffness, place, dt);
                check::<f32>(stiffness.sqrt(), place.min(1e3), dt);
            }
        }
    }
}
