//! Constraints kept by other means than a plain projection: weighted by mass, by Baumgarte's accelerations; and the rank
//! met on the way.

use crate::common::loops::{Coordinates, FourBar, Rod};
use crate::common::{Pendulum, Scalar};
use core::cell::RefCell;
use multibody::integrators::{Action, Event, Events};
use multibody::nalgebra::{SVector, Vector2};
use multibody::projection::{ByMass, Weights, rank};
use multibody::{
    Constrained, DormandPrince, Euler, Integrator, Method, Projection, Rk4, SemiImplicitEuler, StateSpace, System,
    WithBaumgarte, WithProjection, WithRank,
};

/// A crank rocker under gravity; `M` beyond eight repeats equations.
fn crank_rocker<const M: usize>() -> (FourBar<f64, M>, Coordinates<f64, 9>) {
    let bars = FourBar::new(9.81, [2.0, 0.8, 1.9, 1.5]);
    let guess = bars.at_angles([1.0, 0.4, 1.4], [9.0, 0.0, 0.0]);
    let free = SVector::<f64, 9>::from([0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
    let start = multibody::assemble(&bars, 0.0, &guess, &free).unwrap();
    (bars, start.state)
}

#[test]
fn weighted_by_mass() {
    // The masses of the bars stand on a diagonal, so their inverses are weights.
    let (bars, start) = crank_rocker::<8>();
    let inverse = SVector::<f64, 9>::from_fn(|i, _| {
        let l = bars.lengths[i / 3 + 1];
        if i % 3 == 2 { 12.0 / (l * l * l) } else { 1.0 / l }
    });
    let mut off = start;
    for i in 0..9 {
        off.q[i] += 0.01 * f64::from(i as u32).sin();
        off.v[i] += 0.1 * f64::from(i as u32).cos();
    }
    let projection = Projection::default();
    let by_mass = projection.project_by_mass(&bars, 0.0, &off).unwrap();
    let by_weights = projection.project_weighted(&bars, 0.0, &off, &inverse).unwrap();
    let plain = projection.project(&bars, 0.0, &off).unwrap();
    assert!((by_mass.state.q - by_weights.state.q).amax() < 1e-12, "{}", by_mass.state.q - by_weights.state.q);
    assert!((by_mass.state.v - by_weights.state.v).amax() < 1e-11);
    assert!((by_mass.state.q - plain.state.q).amax() > 1e-3, "the weights matter");
    assert_eq!((by_mass.rank, by_weights.rank), (8.0, 8.0));
    let fixed = Projection { iterations: 4, ..projection };
    let same = fixed.project_fixed_by(&ByMass, &bars, 0.0, &off);
    assert!((same.state.q - by_mass.state.q).amax() < 1e-12 && same.residual < 1e-14);

    // A velocity loses energy, and no other projection leaves more of it.
    let only = Projection { position: false, ..projection };
    let moving = Coordinates { q: start.q, v: off.v };
    let left = bars.energy(&only.project_by_mass(&bars, 0.0, &moving).unwrap().state);
    let kinetic = |x: &Coordinates<f64, 9>| (0..9).map(|i| x.v[i] * x.v[i] / inverse[i]).sum::<f64>();
    let change = |x: &Coordinates<f64, 9>| kinetic(&Coordinates { q: x.q, v: x.v - moving.v });
    assert!(left <= bars.energy(&moving));
    let least = change(&only.project_by_mass(&bars, 0.0, &moving).unwrap().state);
    assert!(least < 0.999 * change(&only.project(&bars, 0.0, &moving).unwrap().state));

    // As wrappers, with redundant equations too.
    let (redundant, _) = crank_rocker::<13>();
    let run = |system: &dyn Fn(Coordinates<f64, 9>) -> Coordinates<f64, 9>| system(start);
    let a = WithProjection::by_mass(&bars, projection);
    let b = WithProjection::weighted(&bars, projection, Weights(inverse));
    let c = WithProjection::fixed_weighted(&redundant, fixed, ByMass);
    let [a, b, c] = [
        run(&|x| Rk4::integrate(&a, 0.0, &x, &(), 1e-3, 1000, |_, _| ()).unwrap()),
        run(&|x| Rk4::integrate(&b, 0.0, &x, &(), 1e-3, 1000, |_, _| ()).unwrap()),
        run(&|x| Rk4::integrate(&c, 0.0, &x, &(), 1e-3, 1000, |_, _| ()).unwrap()),
    ];
    assert!((a.q - b.q).amax() < 1e-9 && (a.q - c.q).amax() < 1e-9, "{} {}", a.q - b.q, a.q - c.q);
}

/// The greatest residuals of position and velocity over the second half of `steps` steps.
fn drift<S, const N: usize>(
    method: impl Method<S>,
    system: &S,
    start: &Coordinates<f64, N>,
    dt: f64,
    steps: u32,
) -> [f64; 2]
where
    S: Constrained<Scalar = f64, State = Coordinates<f64, N>> + System<Input = ()>,
    S::Residual: multibody::Tangent<f64>,
{
    let (mut worst, half) = ([0.0; 2], 0.5 * dt * f64::from(steps));
    let greatest = |r: &S::Residual| multibody::Tangent::fold(r, 0.0, &mut |m: f64, x: f64| m.max(x.abs()));
    let run = Integrator::fixed(method, dt).integrate(system, 0.0, dt * f64::from(steps), start, &(), |t, x| {
        if t > half {
            let (q, _, _) = x.split();
            worst[0] = greatest(&system.constraints(t, &q)).max(worst[0]);
            worst[1] = greatest(&system.constraint_rate(t, x)).max(worst[1]);
        }
    });
    if run.is_err() { [f64::INFINITY; 2] } else { worst }
}

/// The error of positions after one second, against a projection after each of far finer steps.
fn end_error<S>(method: impl Method<S>, system: &S, start: &Coordinates<f64, 9>, dt: f64) -> f64
where
    S: System<Scalar = f64, State = Coordinates<f64, 9>, Input = ()>,
{
    let (bars, _) = crank_rocker::<8>();
    let fine = WithProjection::new(bars, Projection::default());
    let want = DormandPrince::integrate(&fine, 0.0, start, &(), 1e-3, 1000, |_, _| ()).unwrap();
    let run = Integrator::fixed(method, dt).integrate(system, 0.0, 1.0, start, &(), |_, _| ());
    run.map_or(f64::INFINITY, |(end, _)| (end.q - want.q).amax())
}

/// For steps of one length: without, for rising shares `a dt`, and with a projection; over short and long times.
#[test]
fn drift_by_the_share_of_the_step() {
    fn check<'a, M>(name: &str, method: M, dt: f64)
    where
        M: Method<FourBar<f64, 8>>
            + Method<WithBaumgarte<&'a FourBar<f64, 8>>>
            + Method<WithProjection<&'a FourBar<f64, 8>>>,
    {
        let (bars, start) = crank_rocker::<8>();
        let bars: &'a FourBar<f64, 8> = Box::leak(Box::new(bars));
        let steps = (4.0 / dt) as u32;
        let none = drift(method, bars, &start, dt, steps);
        let error = end_error(method, bars, &start, dt);
        println!("{name}, dt {dt}: none {:.1e} {:.1e}, error {error:.1e}", none[0], none[1]);
        let mut default = [0.0; 2];
        for share in [0.02, 0.1, 0.4, 1.6] {
            let [position, rate] = drift(method, &WithBaumgarte::new(bars, share / dt), &start, dt, steps);
            let error = end_error(method, &WithBaumgarte::new(bars, share / dt), &start, dt);
            println!("{name}, dt {dt}: a dt {share}: {position:.1e} {rate:.1e}, error {error:.1e}");
            if share == 0.1 {
                default = [position, rate];
            }
        }
        let projected = drift(method, &WithProjection::new(bars, Projection::default()), &start, dt, steps);
        let error = end_error(method, &WithProjection::new(bars, Projection::default()), &start, dt);
        println!("{name}, dt {dt}: projection {:.1e} {:.1e}, error {error:.1e}", projected[0], projected[1]);
        let same = drift(method, &WithBaumgarte::for_step(bars, dt), &start, dt, steps);
        assert_eq!(same, default);
        assert!(same[0] < 0.1 * none[0] && projected[0] < 1e-12, "{name}: {same:?} {none:?}");
    }
    check("Euler", Euler, 1e-4);
    check("semi-implicit Euler", SemiImplicitEuler, 1e-4);
    check("RK4", Rk4, 4e-3);
    check("Dormand-Prince", DormandPrince, 8e-3);
}

#[test]
fn drift_stays_bounded() {
    let (bars, start) = crank_rocker::<8>();
    let (redundant, same) = crank_rocker::<13>();
    let dt = 4e-3;
    let [short, long] = [2000, 20_000].map(|n| drift(Rk4, &WithBaumgarte::for_step(&bars, dt), &start, dt, n)[0]);
    let free = drift(Rk4, &bars, &start, dt, 2000)[0];
    let plain = drift(Rk4, &WithBaumgarte::plain_for_step(&bars, dt), &start, dt, 2000)[0];
    let repeated = drift(Rk4, &WithBaumgarte::for_step(&redundant, dt), &same, dt, 2000)[0];
    println!("8 s: {short:.1e}, 80 s: {long:.1e}, plain {plain:.1e}, redundant {repeated:.1e}, none {free:.1e}");
    assert!(long < 2.0 * short && short < 1e-3 * free && plain < 1e-3 * free);
    assert!((repeated / short - 1.0).abs() < 1e-3);
}

#[test]
fn methods_keep_their_order() {
    fn error<'a, M: Method<WithBaumgarte<&'a Rod<f64>>>>(method: M, rod: &'a Rod<f64>, steps: u32) -> f64 {
        let reference = Pendulum { gravity: 9.81, shake: 0.0 };
        let (want, _) = Integrator::adaptive(DormandPrince, 1e-13, 1e-13)
            .integrate(&reference, 0.0, 2.0, &Scalar { q: 2.0_f64, v: 0.0 }, &(), |_, _| ())
            .unwrap();
        let start = Coordinates { q: Vector2::new(2.0_f64.sin(), -(2.0_f64.cos())), v: Vector2::zeros() };
        // One rate for both steps, as the equation is to be the same.
        let closing = WithBaumgarte::new(rod, 5.0);
        let fixed = Integrator::fixed(method, 2.0 / f64::from(steps));
        let (x, _) = fixed.integrate(&closing, 0.0, 2.0, &start, &(), |_, _| ()).unwrap();
        (x.q - Vector2::new(want.q.sin(), -want.q.cos())).norm()
    }
    fn check<'a, M: Method<WithBaumgarte<&'a Rod<f64>>>>(method: M, rod: &'a Rod<f64>, steps: u32) {
        let (coarse, fine) = (error(method, rod, steps), error(method, rod, 2 * steps));
        let order = (coarse / fine).log2();
        println!("order {order:.2} for {}", M::ORDER);
        // Errors of the stabilisation itself fall faster than those of the method, and are seen where they prevail.
        assert!(order > f64::from(M::ORDER) - 0.3, "{order} for {}: {coarse} {fine}", M::ORDER);
    }
    let rod = Rod::rigid();
    check(SemiImplicitEuler, &rod, 4000);
    check(Rk4, &rod, 400);
    check(DormandPrince, &rod, 200);
}

/// A parallelogram turns evenly through flat poses, with every handling; the rank that it had there is reported.
#[test]
fn singular_poses() {
    let bars = FourBar::<f64, 8>::new(0.0, [2.0, 1.0, 2.0, 1.0]);
    let redundant = FourBar::<f64, 12>::new(0.0, [2.0, 1.0, 2.0, 1.0]);
    let start = bars.at_angles([0.5, 0.0, 0.5], [3.0, 0.0, 3.0]);
    assert_eq!(rank(&bars, 0.0, &start), 8.0);
    assert_eq!(rank(&redundant, 0.0, &start), 8.0);
    // So that the third step ends in the flat pose: rounding is all that it is away.
    let dt = (core::f64::consts::PI - 0.5) / 3.0 / 300.0;
    fn check<S>(name: &str, system: S, start: &Coordinates<f64, 9>, dt: f64)
    where
        S: Constrained<Scalar = f64, State = Coordinates<f64, 9>> + System<Input = ()>,
    {
        let watched = WithRank::new(system);
        assert!(watched.least().is_none());
        let mut worst = 0.0_f64;
        let run = Integrator::fixed(DormandPrince, dt).integrate(&watched, 0.0, 1000.0 * dt, start, &(), |t, x| {
            worst = worst.max((x.q[2] - 0.5 - 3.0 * t).abs()).max(x.q[5].abs()).max((x.q[8] - x.q[2]).abs());
        });
        run.unwrap();
        let (least, when) = watched.least().unwrap();
        println!("{name}: rank {least} at t = {when:.4} s, off by {worst:.1e}");
        assert!(worst < 1e-5, "{name}: {worst}");
        assert!(least == 8.0 || (least == 7.0 && (when / dt - 300.0).abs() < 1.5), "{name}: {least} {when}");
    }
    let projection = Projection::default();
    check("none", &bars, &start, dt);
    check("projection", WithProjection::new(&bars, projection), &start, dt);
    check("projection by mass", WithProjection::by_mass(&bars, projection), &start, dt);
    check("Baumgarte", WithBaumgarte::for_step(&bars, dt), &start, dt);
    check("Baumgarte, plain", WithBaumgarte::plain_for_step(&bars, dt), &start, dt);
    check("projection, redundant", WithProjection::new(&redundant, projection), &start, dt);
    check("projection by mass, redundant", WithProjection::by_mass(&redundant, projection), &start, dt);
    check("Baumgarte, redundant", WithBaumgarte::for_step(&redundant, dt), &start, dt);
    // In the pose itself.
    for angle in [0.0, core::f64::consts::PI] {
        let flat = bars.at_angles([angle, 0.0, angle], [3.0, 0.0, 3.0]);
        assert_eq!((rank(&bars, 0.0, &flat), rank(&redundant, 0.0, &flat)), (7.0, 7.0));
        let watched = WithRank::new(WithProjection::by_mass(&bars, projection));
        let next = watched.accepted(0.25, &flat, &());
        assert_eq!(watched.least(), None, "not every such state is kept");
        watched.reached(0.25, &next);
        assert_eq!(watched.least(), Some((7.0, 0.25)));
        assert!((next.v - flat.v).amax() < 1e-12);
    }
}

/// A point on a line, whose one equation is lost beyond a limit; it remembers where steps ended.
struct Limited {
    limit: f64,
    ends: RefCell<Vec<(f64, Scalar<f64>)>>,
}

impl System for Limited {
    type Scalar = f64;
    type State = Scalar<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, _state: &Scalar<f64>, (): &()) -> (f64, ()) {
        (0.0, ())
    }
    fn position_rates(&self, _t: f64, state: &Scalar<f64>) -> f64 {
        state.v
    }
    fn reached(&self, t: f64, state: &Scalar<f64>) {
        self.ends.borrow_mut().push((t, *state));
    }
}

impl Constrained for Limited {
    type Residual = f64;
    fn constraints(&self, _t: f64, _q: &f64) -> f64 {
        0.0
    }
    fn constraint_rate(&self, _t: f64, _state: &Scalar<f64>) -> f64 {
        0.0
    }
    fn correction(&self, _t: f64, state: &Self::State, _residual: &f64, _weights: &f64) -> (f64, f64) {
        (0.0, if state.q > self.limit { 0.0 } else { 1.0 })
    }
    fn velocity_correction(&self, t: f64, state: &Scalar<f64>, residual: &f64, weights: &f64) -> (f64, f64) {
        self.correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: f64, state: &Scalar<f64>, d: &f64) -> f64 {
        self.constraint_rate_along(t, state, d)
    }
}

/// Turns back just before the limit, twice, and then stops there.
struct Stop(f64, u32);

impl<S: System<Scalar = f64, State = Scalar<f64>>> Events<S, 1> for Stop {
    fn values(&self, _t: f64, x: &Scalar<f64>) -> [f64; 1] {
        [x.q - self.0]
    }
    fn happened(&mut self, _event: &Event, x: &Scalar<f64>) -> Action<Scalar<f64>> {
        self.1 += 1;
        if self.1 == 3 { Action::Stop } else { Action::Jump(Scalar { q: x.q - 0.2, v: x.v }) }
    }
}

/// A search for an event tries states that are never reached: they don't count.
#[test]
fn only_states_that_are_reached_count() {
    fn check<M>(method: M)
    where
        M: for<'a> Method<WithRank<WithProjection<&'a Limited>>>,
    {
        let line = Limited { limit: 0.5, ends: RefCell::default() };
        let watched = WithRank::new(WithProjection::new(&line, Projection::default()));
        let start = Scalar { q: 0.0, v: 1.0 };
        let mut seen = Vec::new();
        let run = Integrator::fixed(method, 0.3).with_events(
            &watched,
            0.0,
            10.0,
            &start,
            &(),
            &mut Stop(0.48, 0),
            |interval| seen.push((interval.end(), *interval.last())),
        );
        let (_, _, end) = run.unwrap();
        assert!((end - 0.88).abs() < 1e-12, "{end}");
        assert_eq!(watched.least(), Some((1.0, 0.3)), "no step ends beyond the limit");
        assert_eq!(*line.ends.borrow(), seen, "a step is reported when it is kept");
        assert_eq!(seen.len(), 5);
    }
    check(Rk4);
    check(DormandPrince);

    // The loops of one's own, too.
    let line = Limited { limit: 0.5, ends: RefCell::default() };
    let mut seen = Vec::new();
    Rk4::integrate(&&line, 0.0, &Scalar { q: 0.0, v: 1.0 }, &(), 0.1, 3, |t, x| seen.push((t, *x))).unwrap();
    let last = seen.last().copied().unwrap();
    seen.push((last.0 + 0.1, Rk4::step(&WithBaumgarte::plain(&line, 1.0), last.0, &last.1, &(), 0.1)));
    assert_eq!(*line.ends.borrow(), seen);
}
