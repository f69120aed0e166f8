//! Projection after steps: what it must keep, what it must not change, and how it fails.

use crate::common::loops::{Coordinates, FourBar, Rod, watched};
use crate::common::{Pendulum, Scalar};
use multibody::nalgebra::{SVector, Vector2};
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody::{
    Constrained, DormandPrince, IntegrationError, Integrator, Method, Projection, ProjectionError, Real, Rk4,
    SemiImplicitEuler, System, Tangent, Tolerance, WithProjection,
};

/// A bob at an angle from the vertical, at rest.
fn at_rest<T: Real>(angle: f64) -> Coordinates<T, 2> {
    let (sin, cos) = angle.sin_cos();
    Coordinates { q: Vector2::new(T::lit(sin), T::lit(-cos)), v: Tangent::zero() }
}

fn worst<const N: usize>(v: &SVector<f64, N>) -> f64 {
    v.amax()
}

type Projecting = WithProjection<Rod<f64>>;

/// The error of a bob on a rod after two seconds, against the pendulum in its angle.
fn error<M: Method<Projecting>>(method: M, steps: u32) -> f64 {
    let reference = Pendulum { gravity: 9.81, shake: 0.0 };
    let start = Scalar { q: 2.0, v: 0.0 };
    let (end, _) = Integrator::adaptive(DormandPrince, 1e-13, 1e-13)
        .integrate(&reference, 0.0, 2.0, &start, &(), |_, _| ())
        .unwrap();
    let rod = WithProjection::new(Rod::rigid(), Projection::default());
    let fixed = Integrator::fixed(method, 2.0 / f64::from(steps));
    let (x, _) = fixed
        .integrate(&rod, 0.0, 2.0, &at_rest(2.0), &(), |_, x| {
            assert!((x.q.norm() - 1.0).abs() < 2e-12 && x.q.dot(&x.v).abs() < 1e-11);
        })
        .unwrap();
    (x.q - Vector2::new(end.q.sin(), -end.q.cos())).norm()
}

#[test]
fn methods_keep_their_order() {
    fn check<M: Method<Projecting>>(method: M, steps: u32) {
        let (coarse, fine) = (error(method, steps), error(method, 2 * steps));
        let order = (coarse / fine).log2();
        assert!((order - f64::from(M::ORDER)).abs() < 0.4, "{order} for {}: {coarse} {fine}", M::ORDER);
    }
    check(SemiImplicitEuler, 4000);
    check(Rk4, 200);
    check(DormandPrince, 100);
}

#[test]
fn drift_is_what_projection_removes() {
    let rod = Rod::rigid();
    let projection = Projection::default();
    let (mut free, mut held) = (at_rest(2.0), at_rest(2.0));
    for k in 0..1000 {
        let t = 0.01 * f64::from(k);
        free = Rk4::step(&rod, t, &free, &(), 0.01);
        held = Rk4::step(&rod, t, &held, &(), 0.01);
        let projected = projection.project(&rod, t + 0.01, &held).unwrap();
        held = projected.state;
        assert!(projected.residual <= 1e-12 && projected.rank == 1.0 && projected.iterations <= 2);
    }
    let drift = |x: &Coordinates<f64, 2>| (x.q.norm() - 1.0).abs();
    assert!(drift(&free) > 1e-9 && drift(&held) < 1e-12, "{} {}", drift(&free), drift(&held));
}

/// A rod whose length changes in time pulls along itself: the angular momentum stays.
#[test]
fn constraints_that_move() {
    let rod = Rod::<f64> { gravity: 0.0, stretch: 0.3 };
    let start = Coordinates { q: Vector2::new(1.0, 0.0), v: Vector2::new(0.3, 2.0) };
    assert!(rod.constraint_rate(0.0, &start).abs() < 1e-15);
    let projected = WithProjection::new(&rod, Projection::default());
    let end = DormandPrince::integrate(&projected, 0.0, &start, &(), 0.01, 1000, |t, x| {
        assert!((x.q.norm() - 1.0 - 0.3 * t.sin()).abs() < 1e-11);
        assert!((x.q.dot(&x.v) / x.q.norm() - 0.3 * t.cos()).abs() < 1e-11);
    });
    let end = end.unwrap();
    assert!((end.q.x * end.v.y - end.q.y * end.v.x - 2.0).abs() < 1e-8);
    // Steps chosen by error keep it as well.
    let run =
        Integrator::adaptive(DormandPrince, 1e-10, 1e-10).integrate(&projected, 0.0, 10.0, &start, &(), |t, x| {
            assert!((x.q.norm() - 1.0 - 0.3 * t.sin()).abs() < 1e-11);
        });
    assert!((run.unwrap().0.q - end.q).norm() < 1e-7);
}

/// A crank rocker: a short crank that turns, under gravity.
fn crank_rocker<const M: usize>() -> (FourBar<f64, M>, Coordinates<f64, 9>) {
    let bars = FourBar::new(9.81, [2.0, 0.8, 1.9, 1.5]);
    let guess = bars.at_angles([1.0, 0.4, 1.4], [9.0, 0.0, 0.0]);
    let free = SVector::<f64, 9>::from([0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]); // the crank is held
    let start = multibody::assemble(&bars, 0.0, &guess, &free).unwrap();
    assert_eq!(start.rank, 6.0); // its own pin has nothing left to decide
    (bars, start.state)
}

#[test]
fn equations_that_repeat_others_change_nothing() {
    let (plain, start) = crank_rocker::<8>();
    let (redundant, same) = crank_rocker::<13>();
    assert!(worst(&(start.q - same.q)) < 1e-12);
    let (mut a, mut b) = (start, same);
    let projection = Projection { tolerance: 1e-13, ..Projection::default() };
    let energy = plain.energy(&a);
    for k in 0..2000 {
        let t = 1e-3 * f64::from(k);
        let next = projection.project(&plain, t, &Rk4::step(&plain, t, &a, &(), 1e-3)).unwrap();
        assert_eq!(next.rank, 8.0);
        a = next.state;
        let next = projection.project(&redundant, t, &Rk4::step(&redundant, t, &b, &(), 1e-3)).unwrap();
        assert_eq!(next.rank, 8.0);
        b = next.state;
    }
    assert!((plain.energy(&a) - energy).abs() < 1e-7, "{}", plain.energy(&a) - energy);
    assert!(worst(&(a.q - b.q)) < 1e-9 && worst(&(a.v - b.v)) < 1e-8, "{} {}", a.q - b.q, a.v - b.v);
    assert!((a.q[2] - start.q[2]).abs() > 6.0, "the crank has turned: {}", a.q[2]);
}

/// A parallelogram without gravity turns evenly, and passes flat poses in which one equation is lost and it could
/// fold over.
#[test]
fn flat_poses() {
    let bars = FourBar::<f64, 8>::new(0.0, [2.0, 1.0, 2.0, 1.0]);
    let projection = Projection::default();
    for flat in [0.0, core::f64::consts::PI] {
        let pose = bars.at_angles([flat, 0.0, flat], [3.0, 0.0, 3.0]);
        let projected = projection.project(&bars, 0.0, &pose).unwrap();
        assert_eq!(projected.rank, 7.0);
        assert!(worst(&(projected.state.v - pose.v)) < 1e-12);
    }

    let start = bars.at_angles([0.5, 0.0, 0.5], [3.0, 0.0, 3.0]);
    for h in [1e-3, 2.5e-3, 0.7e-3] {
        let (mut x, mut least) = (start, f64::INFINITY);
        for k in 0..(4.0 / h) as u32 {
            x = Rk4::step(&bars, 0.0, &x, &(), h);
            let projected = projection.project(&bars, 0.0, &x).unwrap();
            least = least.min(projected.rank);
            x = projected.state;
            assert!((x.q[2] - 0.5 - 3.0 * h * f64::from(k + 1)).abs() < 1e-5, "{h} {k}: {}", x.q);
            assert!(x.q[5].abs() < 1e-5 && (x.q[8] - x.q[2]).abs() < 1e-5, "{h} {k}: {}", x.q);
        }
        assert!(least >= 7.0);
    }
}

#[test]
fn least_change() {
    // A bob off its rod goes straight to it; with a weight of zero it goes along the other axis; heavy things stay.
    let rod = Rod::<f64>::rigid();
    let off = Coordinates { q: Vector2::new(0.9, -1.2), v: Vector2::new(1.0, 1.0) };
    let near = Projection::default().project(&rod, 0.0, &off).unwrap().state;
    assert!((near.q - Vector2::new(0.6, -0.8)).norm() < 1e-12);
    assert!((near.v - Vector2::new(0.96 + 0.16, 0.72 + 0.12)).norm() < 0.2 && near.q.dot(&near.v).abs() < 1e-12);
    let held = Projection::default().project_weighted(&rod, 0.0, &off, &Vector2::new(1.0, 0.0)).unwrap_err();
    assert!(matches!(held, ProjectionError::NoConvergence { .. }), "1.2 m down there is no rod: {held:?}");
    let off = Coordinates { q: Vector2::new(0.9, -0.8), ..off };
    let held = Projection::default().project_weighted(&rod, 0.0, &off, &Vector2::new(1.0, 0.0)).unwrap().state;
    assert!(held.q.y == -0.8 && (held.q.x - 0.6).abs() < 1e-12 && held.v.y == 1.0);
    assert!((held.v.x - 0.8 / 0.6).abs() < 1e-12);

    let only = |position, velocity| Projection { position, velocity, ..Projection::default() };
    let moved = only(true, false).project(&rod, 0.0, &off).unwrap();
    assert!(moved.state.v == off.v && moved.state.q != off.q && moved.rank == 1.0);
    let moved = only(false, true).project(&rod, 0.0, &off).unwrap();
    assert!(moved.state.q == off.q && moved.state.v != off.v && moved.rank == 1.0);
    let moved = only(false, false).project(&rod, 0.0, &off).unwrap();
    assert!(moved.state == off && moved.rank == 1.0 && moved.residual > 0.1);
}

#[test]
fn single_precision() {
    let rod = WithProjection::new(Rod::<f32>::rigid(), Projection::default());
    let end = Rk4::integrate(&rod, 0.0, &at_rest(2.0), &(), 1e-2, 5000, |_, x| {
        assert!((x.q.norm() - 1.0).abs() < 1e-5);
    });
    let end = end.unwrap();
    let energy = 0.5 * end.v.norm_squared() + 9.81 * end.q.y;
    assert!((energy - 9.81 * -(2f32.cos())).abs() < 0.02, "{energy}");
}

#[test]
fn lanes_go_on_alone() {
    let lanes = |v: [f64; 4]| WideF64x4::from(v);
    let angles = [0.3, 1.0, 2.0, 3.0];
    let mut x = Coordinates {
        q: Vector2::new(lanes(angles.map(f64::sin)), lanes(angles.map(|a| -f64::cos(a)))),
        v: Vector2::new(lanes([0.1, 0.2, 0.0, 0.0]), lanes([0.0; 4])),
    };
    x.q.x *= lanes([1.0 + 1e-13, 1.1, 1.0, 1.5]); // some lanes have farther to go
    let of = |x: &Coordinates<WideF64x4, 2>, lane: usize| Coordinates {
        q: Vector2::new(x.q.x.extract(lane), x.q.y.extract(lane)),
        v: Vector2::new(x.v.x.extract(lane), x.v.y.extract(lane)),
    };
    let (rod, single, projection) = (Rod::<WideF64x4>::rigid(), Rod::<f64>::rigid(), Projection::default());
    let four = projection.project(&rod, WideF64x4::ZERO, &x).unwrap();
    for lane in 0..4 {
        let one = projection.project(&single, 0.0, &of(&x, lane)).unwrap();
        assert_eq!(of(&four.state, lane), one.state, "{lane}");
        assert!(four.iterations >= one.iterations && four.rank.extract(lane) == 1.0);
    }

    // One lane is no number: an error here, NaN in that lane alone where there is no place for an error.
    let mut bad = x;
    bad.q.x.replace(2, f64::NAN);
    assert_eq!(projection.project(&rod, WideF64x4::ZERO, &bad).unwrap_err(), ProjectionError::NotFinite);
    let fixed = Projection { iterations: 6, ..projection }.project_fixed(&rod, WideF64x4::ZERO, &bad);
    let step = |x| WithProjection::new(&rod, projection).accepted(WideF64x4::ZERO, x, &());
    let (accepted, good) = (step(&bad), step(&x));
    for lane in [0, 1, 3] {
        assert!(fixed.residual.extract(lane) < 1e-14 && fixed.rank.extract(lane) == 1.0);
        assert_eq!(of(&accepted, lane), of(&good, lane));
    }
    assert!(fixed.residual.extract(2).is_nan() && accepted.v.x.extract(2).is_nan());
    let run = Rk4::integrate(
        &WithProjection::new(&rod, projection),
        WideF64x4::ZERO,
        &bad,
        &(),
        WideF64x4::ONE,
        3,
        |_, _| (),
    );
    assert!(matches!(run, Err(IntegrationError::NonFinite { time: 0.0 })));
}

/// `q^2 / 2 = t`: at zero both have to stand still, and time does not.
struct Fold;

impl System for Fold {
    type Scalar = f64;
    type State = Scalar<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, _state: &Scalar<f64>, (): &()) -> (f64, ()) {
        (0.0, ())
    }
    fn position_rates(&self, _t: f64, state: &Scalar<f64>) -> f64 {
        state.v
    }
}

impl Constrained for Fold {
    type Residual = f64;
    fn constraints(&self, t: f64, q: &f64) -> f64 {
        0.5 * q * q - t
    }
    fn constraint_rate(&self, _t: f64, state: &Scalar<f64>) -> f64 {
        state.q * state.v - 1.0
    }
    fn correction(&self, _t: f64, state: &Self::State, residual: &f64, weight: &f64) -> (f64, f64) {
        let (d, rank) = multibody::linear::least_norm(&[[state.q]].into(), &[*residual].into(), &[*weight].into());
        (d[0], rank)
    }
    fn velocity_correction(&self, t: f64, state: &Scalar<f64>, residual: &f64, weights: &f64) -> (f64, f64) {
        self.correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: f64, state: &Scalar<f64>, d: &f64) -> f64 {
        self.constraint_rate_along(t, state, d)
    }
}

#[test]
fn failures_have_types() {
    let projection = Projection::default();
    let rod = watched(Rod::<f64>::rigid());
    for bad in [f64::NAN, f64::INFINITY] {
        for state in [(bad, 1.0, 0.0), (1.0, 0.0, bad)] {
            let state = Coordinates { q: Vector2::new(state.0, state.1), v: Vector2::new(0.0, state.2) };
            assert_eq!(projection.project(&rod, 0.0, &state).unwrap_err(), ProjectionError::NotFinite);
        }
        let moving = Rod { gravity: 0.0, stretch: bad };
        assert_eq!(projection.project(&moving, 1.0, &at_rest(0.0)).unwrap_err(), ProjectionError::NotFinite);
    }
    // Nothing leads away from the pivot: no direction, and a residual that stays.
    let pivot = Coordinates { q: Vector2::zero(), v: Vector2::zero() };
    let lost = projection.project(&rod, 0.0, &pivot).unwrap_err();
    assert_eq!(lost, ProjectionError::NoConvergence { residual: 0.5, iterations: 20 });
    let impatient = Projection { iterations: 1, ..projection };
    let far = Coordinates { q: Vector2::new(100.0, 0.0), v: Vector2::zero() };
    let error = impatient.project(&rod, 0.0, &far).unwrap_err();
    assert!(matches!(error, ProjectionError::NoConvergence { residual, iterations: 1 } if residual > 100.0));
    assert!(projection.project(&rod, 0.0, &far).is_ok());
    let never = Projection { tolerance: f64::NAN, ..projection };
    assert!(never.project(&rod, 0.0, &far).unwrap().residual < 1e-15, "to rounding if nothing else is asked for");
    assert!(rod.corrections.get() < 100);

    let stuck = projection.project(&Fold, 0.0, &Scalar { q: 0.0, v: 1.0 }).unwrap_err();
    assert_eq!(stuck, ProjectionError::NoVelocity { rate: 1.0 });
    assert!(projection.project(&Fold, 0.5, &Scalar { q: 1.1, v: 0.0 }).unwrap().state.v == 1.0);
    // Within integrators: not a number, and an end.
    let one_step = Integrator::within(DormandPrince, Tolerance { first_step: 1.0, ..Tolerance::new(1e-6, 1e-6) });
    let run = one_step.integrate(
        &WithProjection::new(Fold, projection),
        0.0,
        -1.0,
        &Scalar { q: 0.0, v: 0.0 },
        &(),
        |_, _| (),
    );
    assert!(matches!(run, Err(IntegrationError::NonFinite { .. })), "{run:?}");
}

#[test]
fn a_fixed_number_costs_the_same_for_every_input() {
    let projection = Projection { iterations: 3, ..Projection::default() };
    for start in [at_rest(1.0), Coordinates { q: Vector2::new(9.0, 3.0), v: Vector2::new(f64::NAN, 1e300) }] {
        let rod = watched(Rod::rigid());
        let projected = projection.project_fixed(&rod, 0.0, &start);
        assert_eq!((rod.evaluations.get(), rod.corrections.get(), projected.iterations), (5, 4, 3));
    }
    let near = Coordinates { q: Vector2::new(1.0 + 1e-6, 0.0), v: Vector2::new(0.5, 0.5) };
    let once = Projection { iterations: 1, ..projection };
    let projected = once.project_fixed(&Rod::rigid(), 0.0, &near);
    assert!(projected.residual < 1e-12 && projected.state.v == Vector2::new(0.0, 0.5));
    // In steps.
    let rod = WithProjection::fixed(Rod::<f64>::rigid(), once);
    let end = Rk4::integrate(&rod, 0.0, &at_rest(2.0), &(), 1e-2, 1000, |_, _| ()).unwrap();
    assert!((end.q.norm() - 1.0).abs() < 1e-9);
}

/// Ten thousand kilometres of lever: the residual is never below its rounding, the angle is exact nevertheless.
struct Lever;

impl System for Lever {
    type Scalar = f64;
    type State = Scalar<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, _state: &Scalar<f64>, (): &()) -> (f64, ()) {
        (0.0, ())
    }
    fn position_rates(&self, _t: f64, state: &Scalar<f64>) -> f64 {
        state.v
    }
}

impl Constrained for Lever {
    type Residual = f64;
    fn constraints(&self, _t: f64, q: &f64) -> f64 {
        1e7 * q.sin() - 1e7 / 3.0
    }
    fn constraint_rate(&self, _t: f64, state: &Scalar<f64>) -> f64 {
        1e7 * state.q.cos() * state.v
    }
    fn correction(&self, _t: f64, state: &Self::State, residual: &f64, weight: &f64) -> (f64, f64) {
        (if *weight > 0.0 { residual / (1e7 * state.q.cos()) } else { 0.0 }, 1.0)
    }
    fn velocity_correction(&self, t: f64, state: &Scalar<f64>, residual: &f64, weights: &f64) -> (f64, f64) {
        self.correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: f64, state: &Scalar<f64>, d: &f64) -> f64 {
        self.constraint_rate_along(t, state, d)
    }
}

#[test]
fn rounding_is_close_enough() {
    for k in 0..100 {
        let start = Scalar { q: 0.2 + 0.003 * f64::from(k), v: 0.3 };
        let projected = Projection::default().project(&Lever, 0.0, &start).unwrap();
        assert!((projected.state.q - (1.0f64 / 3.0).asin()).abs() < 1e-15 && projected.state.v.abs() < 1e-15);
        let assembled = multibody::assemble(&Lever, 0.0, &start, &1.0).unwrap();
        assert!((assembled.state.q - (1.0f64 / 3.0).asin()).abs() < 1e-15);
    }
}
