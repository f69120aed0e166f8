//! Reduced models come to dead centres: where two solutions of a loop meet, coordinates of the state end and the mechanism
//! goes on with the other solution. Every method ends there in an error that names the unknown and the time, whatever its
//! steps, and none of them stops at what only comes near. The truth is the same mechanism with its equations, projected.

use std::f64::consts::TAU;
use std::mem;

use multibody::integrators::{Action, Direction, Event, Events};
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody::{
    Canonical, Differentiable, Dop853, DormandPrince, Euler, GaussLegendre4, GaussLegendre6, GeneralisedAlpha,
    ImplicitMidpoint, IntegrationError, Integrator, Method, Projection, Radau, Rk4, SecondOrder, SemiImplicitEuler,
    SymplecticGauss4, SymplecticGauss6, SymplecticMidpoint, System, WithProjection, multibody, simulate,
};

/// A four-bar that comes into line with its crank: no crank turns all the way.
macro_rules! rocker {
    ($($name:ident { $($items:tt)* })*) => {
        multibody! {
            $(
                pub mod $name {
                    world { gravity: -9.81 * Y }
                    body one { mass: 1.0, com: X, inertia: rod(1.0, 2.0, X) }
                    body two { mass: 1.0, com: 0.6 * X, inertia: rod(1.0, 1.2, X) }
                    body three { mass: 1.0, com: 0.75 * X, inertia: rod(1.0, 1.5, X) }
                    joint a: Revolute { parent: ground, child: one, axis: Z }
                    joint b: Revolute { parent: one.at(2.0 * X), child: two, axis: Z }
                    joint c: Revolute { parent: ground.at(3.5 * X), child: three, axis: Z }
                    #[cut]
                    joint d: Revolute { parent: two.at(1.2 * X), child: three.at(1.5 * X), axis: Z }
                    output energy = kinetic() + potential();
                    output angles = [a.angle, b.angle, c.angle];
                    $($items)*
                }
            )*
        }
    };
}
rocker! {
    solved {
        formulation { constraints: Reduced }
        solve (b, c) from d { sin(c.angle - a.angle - b.angle) > 0.0 }
        emit forward_dynamics, derivatives, momentum;
    }
    iterated { formulation { constraints: Reduced, independent: [a] } emit forward_dynamics, derivatives; }
    kept { formulation { constraints: Multipliers } }
}

/// Two cranks on axes askew with a rod between them: nothing is planar.
macro_rules! askew {
    ($($name:ident { $($items:tt)* })*) => {
        multibody! {
            $(
                pub mod $name {
                    world { gravity: [1.0, -9.0, 2.0] }
                    let seat = ground.at([2.0, 0.3, -0.4]).rotated([1, 2, 0.5], 0.7);
                    body one { mass: 2.0, com: [0.5, 0.1, 0.05], inertia: diag(0.02, 0.2, 0.2) }
                    body two { mass: 1.0, com: [0.6, 0, -0.1], inertia: diag(0.02, 0.15, 0.15) }
                    joint p: Revolute { parent: ground, child: one, axis: [1, 1, 4] }
                    joint r: Revolute { parent: seat, child: two, axis: [0.2, -1, 3] }
                    constraint rod: Rod { between: [one.at(1.6 * X), two.at(1.3 * X)], length: 1.5 }
                    output energy = kinetic() + potential();
                    $($items)*
                }
            )*
        }
    };
}
askew! {
    askew_reduced { formulation { constraints: Reduced, independent: [p] } emit forward_dynamics, derivatives; }
    askew_kept { formulation { constraints: Multipliers } }
}

/// A crank that turns all the way and comes near its dead centres: the rod is a little longer than the crank and the offset.
macro_rules! press {
    ($($name:ident { $($items:tt)* })*) => {
        multibody! {
            $(
                pub mod $name {
                    param length = 1.02;
                    world { gravity: -9.81 * Y }
                    body arm { mass: 2.0, com: 0.3 * X, inertia: rod(2.0, 1.0, X) }
                    body rod { mass: 1.0, com: 0.5 * length * X, inertia: rod(1.0, length, X) }
                    body slider { mass: 0.5 }
                    joint crank: Revolute { parent: ground, child: arm, axis: Z }
                    joint pin: Revolute { parent: arm.at(X), child: rod, axis: Z }
                    joint slide: Prismatic { parent: ground, child: slider, axis: X }
                    #[cut]
                    joint end: Revolute { parent: rod.at(length * X), child: slider, axis: Z }
                    output energy = kinetic() + potential();
                    output angles = [crank.angle, pin.angle];
                    output travel = slide.travel;
                    $($items)*
                }
            )*
        }
    };
}
press! {
    pressed { formulation { constraints: Reduced } solve (pin, slide) from end { slider.position.x > arm.at(X).position.x } }
    pressed_kept { formulation { constraints: Multipliers } }
}

/// The time at which the crank of the mechanism with its equations turns back.
struct Turns<R>(R, f64);
impl<S: System, R: Fn(&S::State) -> f64> Events<S, 1> for Turns<R> {
    fn values(&self, _t: f64, x: &S::State) -> [f64; 1] {
        [(self.0)(x)]
    }
    fn happened(&mut self, event: &Event, _x: &S::State) -> Action<S::State> {
        self.1 = event.time;
        Action::Stop
    }
}

/// Ends in a dead centre that is named, at the time it has.
fn ends<S: System<Input = ()>, M: Method<S>>(
    name: &str,
    integrator: Integrator<M>,
    system: &S,
    start: &S::State,
    (when, coordinate): (f64, &str),
    early: f64,
) {
    let result = integrator.integrate(system, 0.0, 3.0, start, &(), |_, _| ()).map(|(_, statistics)| statistics);
    println!("{name}: {result:?}");
    let Err(IntegrationError::DeadCentre { time, coordinate: found }) = result else {
        panic!("{name}: {result:?}, not a dead centre at {when} s")
    };
    assert_eq!(found, coordinate, "{name}");
    let late = if M::ORDER == 1 { early } else { 0.1 * early };
    assert!(time <= when + late && when - time <= early, "{name}: at {time} s, should be {when} s");
}

/// Methods that ask nothing of the model.
fn plain<S: System<Input = ()>>(name: &str, system: &S, start: &S::State, truth: (f64, &str)) {
    for step in [1e-3, 7e-3] {
        let near = 6.0 * step;
        let name = format!("{name}, {step} s");
        ends(&format!("{name}, Euler"), Integrator::fixed(Euler, step), system, start, truth, near + 5.0 * step);
        let semi = Integrator::fixed(SemiImplicitEuler, step);
        ends(&format!("{name}, SemiImplicitEuler"), semi, system, start, truth, near + 5.0 * step);
        ends(&format!("{name}, Rk4"), Integrator::fixed(Rk4, step), system, start, truth, near);
        ends(&format!("{name}, DormandPrince"), Integrator::fixed(DormandPrince, step), system, start, truth, near);
        ends(&format!("{name}, Dop853"), Integrator::fixed(Dop853, step), system, start, truth, near);
        ends(&format!("{name}, midpoint"), Integrator::fixed(ImplicitMidpoint, step), system, start, truth, 3.0 * near);
        ends(&format!("{name}, Gauss4"), Integrator::fixed(GaussLegendre4, step), system, start, truth, 3.0 * near);
        ends(&format!("{name}, Gauss6"), Integrator::fixed(GaussLegendre6, step), system, start, truth, 3.0 * near);
    }
    for tolerance in [1e-4, 1e-6, 1e-9] {
        let name = format!("{name}, tolerance {tolerance}");
        let five = Integrator::adaptive(DormandPrince, tolerance, tolerance);
        ends(&format!("{name}, DormandPrince"), five, system, start, truth, 0.02);
        let eight = Integrator::adaptive(Dop853, tolerance, tolerance);
        ends(&format!("{name}, Dop853"), eight, system, start, truth, 0.02);
        ends(&format!("{name}, compensated"), eight.compensated(), system, start, truth, 0.02);
    }
}

/// Those that ask for derivatives.
fn implicit<S: Differentiable<Input = ()> + SecondOrder>(name: &str, system: &S, start: &S::State, truth: (f64, &str)) {
    let radau = Integrator::fixed(Radau, 5e-3);
    ends(&format!("{name}, Radau"), radau, system, start, truth, 0.06);
    let alpha = Integrator::fixed(GeneralisedAlpha::new(0.8), 2e-3);
    ends(&format!("{name}, generalised alpha"), alpha, system, start, truth, 0.03);
    ends(&format!("{name}, Radau by error"), Integrator::adaptive(Radau, 1e-7, 1e-7), system, start, truth, 0.02);
}

fn canonical<S: Canonical<Input = ()>>(name: &str, system: &S, start: &S::State, truth: (f64, &str)) {
    ends(&format!("{name}, midpoint"), Integrator::fixed(SymplecticMidpoint, 2e-3), system, start, truth, 0.03);
    ends(&format!("{name}, Gauss4"), Integrator::fixed(SymplecticGauss4, 2e-3), system, start, truth, 0.03);
    ends(&format!("{name}, Gauss6"), Integrator::fixed(SymplecticGauss6, 2e-3), system, start, truth, 0.03);
}

fn solved_start() -> solved::State {
    solved::State { q: solved::Position { a: 0.7 }, ..Default::default() }
}

/// When the crank turns back.
fn truth() -> f64 {
    let model = kept::Model::<f64>::default();
    let [a, b, c] = solved::Model::default().outputs(0.0, &solved_start(), &()).angles;
    let start = kept::State { q: kept::Position { a, b, c }, ..Default::default() };
    let mut turns = Turns(|x: &kept::State| x.v.a, 0.0);
    let system = WithProjection::new(&model, Projection::default());
    let integrator = Integrator::adaptive(Dop853, 1e-11, 1e-11);
    // It starts at rest: a little later it moves.
    let (later, _) = integrator.integrate(&system, 0.0, 0.1, &start, &(), |_, _| ()).unwrap();
    integrator.with_events(&system, 0.1, 3.0, &later, &(), &mut turns, |_| ()).unwrap();
    println!("the crank turns back at {} s", turns.1);
    assert!((turns.1 - 0.99).abs() < 0.01);
    turns.1
}

#[test]
fn every_method_ends_in_a_dead_centre() {
    let truth = (truth(), "b");
    let (model, start) = (solved::Model::default(), solved_start());
    plain("closed form", &model, &start, truth);
    implicit("closed form", &model, &start, truth);
    canonical("closed form", &model, &start, truth);
    let result = simulate(&model, 0.0, 3.0, &start, &(), 1e-6, |_, _| ());
    assert!(matches!(result, Err(IntegrationError::DeadCentre { coordinate: "b", .. })), "{result:?}");

    let model = iterated::Model::default();
    let mut start = iterated::State { q: iterated::Position { a: 0.7 }, ..Default::default() };
    let [_, b, c] = solved::Model::default().outputs(0.0, &solved_start(), &()).angles;
    start.guess = iterated::Guess { b: b + 0.01, c: c - 0.01 };
    plain("Newton", &model, &start, truth);
    implicit("Newton", &model, &start, truth);
}

/// In lanes with steps of their own each motion ends as it does alone: in its dead centre at its time, or at its end.
#[test]
fn lanes_end_in_dead_centres_of_their_own() {
    let angles = [0.7, 0.2, 0.5, -0.3];
    let rates = [0.0, 0.5, -1.0, 2.0];
    let span = (0.0, 0.9);
    let alone = |a: f64, rate: f64, integrator: &Integrator<Dop853>| {
        let start = solved::State { q: solved::Position { a }, v: solved::Velocity { a: rate } };
        let mut last = (start, 0.0);
        let seen = |t: f64, x: &solved::State| last = (*x, t);
        let result = integrator.integrate(&solved::Model::default(), span.0, span.1, &start, &(), seen);
        (last, result.err())
    };
    let mut dead = 0;
    for tolerance in [1e-5, 1e-9] {
        let integrator = Integrator::adaptive(Dop853, tolerance, tolerance);
        let start = solved::State {
            q: solved::Position { a: WideF64x4::from(angles) },
            v: solved::Velocity { a: WideF64x4::from(rates) },
        };
        let model = solved::Model::<WideF64x4>::default();
        let closed = integrator.integrate_lanes(&model, span.0, span.1, &start, &(), |_, _| ()).unwrap();
        // The same by Newton's method, whose guess is part of the state.
        let [_, b, c] = model.outputs(WideF64x4::ZERO, &start, &()).angles;
        let start = iterated::State {
            q: iterated::Position { a: start.q.a },
            v: iterated::Velocity { a: start.v.a },
            guess: iterated::Guess { b, c },
        };
        let model = iterated::Model::<WideF64x4>::default();
        let newton = integrator.integrate_lanes(&model, span.0, span.1, &start, &(), |_, _| ()).unwrap();
        for lane in 0..4 {
            let ((state, time), error) = alone(angles[lane], rates[lane], &integrator);
            for (end, a) in [(closed.lanes()[lane], closed.state.q.a), (newton.lanes()[lane], newton.state.q.a)] {
                println!("{lane}: {end:?}, alone {error:?}");
                assert_eq!(
                    end.error.map(|e| mem::discriminant(&e)),
                    error.map(|e| mem::discriminant(&e)),
                    "{end:?} {error:?}"
                );
                let near = if error.is_some() { 1e-5 } else { 1e-7 }; // rounding decides where steps come to nothing
                assert!((end.time - time).abs() < near && (a.extract(lane) - state.q.a).abs() < near);
            }
            dead += usize::from(error.is_some());
        }
    }
    assert!((1..8).contains(&dead), "{dead} motions ended early");
}

#[test]
fn ends_near_a_dead_centre_are_right_or_refused() {
    let model = solved::Model::<f64>::default();
    let start = solved_start();
    let energy = model.outputs(0.0, &start, &()).energy;
    let when = truth();
    for k in 0..60 {
        let end = when + 0.02 - 1e-3 * f64::from(k);
        for tolerance in [1e-6, 1e-9] {
            let run =
                Integrator::adaptive(Dop853, tolerance, tolerance).integrate(&model, 0.0, end, &start, &(), |_, _| ());
            match run {
                Ok((x, _)) => {
                    let off = (model.outputs(end, &x, &()).energy - energy).abs();
                    assert!(end < when && off < 1e3 * tolerance, "to {end}: energy off by {off:e}");
                }
                Err(error) => assert!(matches!(error, IntegrationError::DeadCentre { .. }), "{error}"),
            }
        }
    }
}

#[test]
fn backwards_in_time_too() {
    // The same motion, which is symmetrical about the start at rest.
    let model = solved::Model::<f64>::default();
    for integrator in [Integrator::adaptive(Dop853, 1e-9, 1e-9), Integrator::fixed(Dop853, 1e-3)] {
        let result = integrator.integrate(&model, 0.0, -3.0, &solved_start(), &(), |_, _| ());
        let Err(IntegrationError::DeadCentre { time, coordinate: "b" }) = result else { panic!("{result:?}") };
        assert!((time + truth()).abs() < 7e-3, "at {time} s");
    }
}

#[test]
fn single_steps_end_in_nan() {
    let model = solved::Model::<f32>::default();
    let mut x = solved::State { q: solved::Position { a: 0.7_f32 }, ..Default::default() };
    let energy = model.outputs(0.0, &x, &()).energy;
    let mut t = 0.0;
    while x.v.a.is_finite() {
        let off = (model.outputs(t, &x, &()).energy - energy).abs();
        assert!(off < 0.1, "{t} s: {off}");
        t += 1e-3;
        x = Rk4::step(&model, t, &x, &(), 1e-3);
        assert!(t < 1.0, "it went on");
    }
    assert!(t > 0.98, "NaN at {t} s");
}

#[test]
fn single_precision() {
    let model = solved::Model::<f32>::default();
    let start = solved::State { q: solved::Position { a: 0.7_f32 }, ..Default::default() };
    let truth = (truth(), "b");
    ends("f32, Rk4", Integrator::fixed(Rk4, 1e-3), &model, &start, truth, 8e-3);
    ends("f32, DormandPrince", Integrator::adaptive(DormandPrince, 1e-4, 1e-4), &model, &start, truth, 0.1);
    ends("f32, Dop853", Integrator::adaptive(Dop853, 1e-5, 1e-5), &model, &start, truth, 0.1);
    let result = Rk4::integrate(&model, 0.0, &start, &(), 1e-3, 3000, |_, _| ());
    let Err(IntegrationError::DeadCentre { time, coordinate: "b" }) = result else { panic!("{result:?}") };
    assert!((time - truth.0).abs() < 8e-3);
}

#[test]
fn axes_askew() {
    let kept = askew_kept::Model::<f64>::default();
    let model = askew_reduced::Model::<f64>::default();
    let default = askew_reduced::State::<f64>::default();
    let closed = model.close(0.0, &default);
    println!("default guess {:?} leaves {:e}", default.guess, closed.residual);
    assert!(closed.residual < 1e-12, "the default guess closes the loop");
    let mut start = closed.state;
    start.v.p = 12.0;
    // Both models start with the same motion: the rate of the rocker follows.
    let mut same = askew_kept::State::default();
    (same.q.p, same.q.r, same.v.p) = (0.0, start.guess.r, 12.0);
    let held = askew_kept::Velocity { p: 0.0, r: 1.0 };
    let same = Projection::default().project_weighted(&kept, 0.0, &same, &held).unwrap().state;
    let off = model.outputs(0.0, &start, &()).energy - kept.outputs(0.0, &same, &()).energy;
    assert!(off.abs() < 1e-12, "{off:e}");
    let mut turns = Turns(|x: &askew_kept::State| x.v.p, 0.0);
    let system = WithProjection::new(&kept, Projection::default());
    let integrator = Integrator::adaptive(Dop853, 1e-11, 1e-11);
    let mut first = None;
    // Where it turns back with the rod and the rocker in one line: the other turns are those of a pendulum.
    let run = integrator.with_events(&system, 0.0, 3.0, &same, &(), &mut turns, |interval| {
        let jacobian = kept.constraint_jacobian(interval.end(), &interval.last().q);
        first.get_or_insert(jacobian[(0, 1)]);
    });
    let (end, ..) = run.unwrap();
    let slope = kept.constraint_jacobian(turns.1, &end.q)[(0, 1)];
    println!("turns at {} s with slope {slope:e}, at first {first:?}", turns.1);
    if slope.abs() < 1e-6 {
        plain("askew", &model, &start, (turns.1, "r"));
        implicit("askew", &model, &start, (turns.1, "r"));
    } else {
        panic!("no dead centre at {} s", turns.1);
    }
}

/// What comes near and goes on is not stopped, and is right.
#[test]
fn near_misses_go_on() {
    let model = pressed::Model::<f64>::default();
    let mut start = pressed::State::default();
    (start.q.crank, start.v.crank) = (0.3, 6.0);
    let energy = model.outputs(0.0, &start, &()).energy;
    let kept = pressed_kept::Model::<f64>::default();
    let mut same = pressed_kept::State::default();
    let o = model.outputs(0.0, &start, &());
    (same.q.crank, same.q.pin, same.q.slide, same.v.crank) = (o.angles[0], o.angles[1], o.travel, 6.0);
    let held = pressed_kept::Velocity { crank: 0.0, pin: 1.0, slide: 1.0 };
    let same = Projection::default().project_weighted(&kept, 0.0, &same, &held).unwrap().state;
    let system = WithProjection::new(&kept, Projection::default());
    let (truth, _) =
        Integrator::adaptive(Dop853, 1e-12, 1e-12).integrate(&system, 0.0, 3.0, &same, &(), |_, _| ()).unwrap();
    for tolerance in [1e-5, 1e-8, 1e-11] {
        let integrator = Integrator::adaptive(Dop853, tolerance, tolerance);
        let (end, statistics) = integrator.integrate(&model, 0.0, 3.0, &start, &(), |_, _| ()).unwrap();
        let off = (model.outputs(3.0, &end, &()).energy - energy).abs();
        let error = (end.q.crank - truth.q.crank).abs();
        println!("{tolerance:e}: {:.1} turns, {statistics:?}, energy {off:e}, error {error:e}", end.q.crank / TAU);
        assert!(end.q.crank.abs() > TAU && off < 1e4 * tolerance && error < 1e5 * tolerance);
    }
    let (end, _) = Integrator::fixed(Rk4, 1e-4).integrate(&model, 0.0, 3.0, &start, &(), |_, _| ()).unwrap();
    assert!((end.q.crank - truth.q.crank).abs() < 1e-4, "{:e}", end.q.crank - truth.q.crank);
    // Steps that are too long to tell are refused, and not passed over.
    let result = Integrator::fixed(Rk4, 3e-2).integrate(&model, 0.0, 3.0, &start, &(), |_, _| ());
    assert!(matches!(result, Err(IntegrationError::DeadCentre { coordinate: "pin" | "slide", .. })), "{result:?}");
}

/// A handover: an event at some distance from the dead centre, and from there the mechanism with its equations.
#[test]
fn an_event_hands_over() {
    struct Near<'a>(&'a solved::Model);
    impl Events<solved::Model, 1> for Near<'_> {
        fn values(&self, t: f64, x: &solved::State) -> [f64; 1] {
            [self.0.dead_centres(t, &x.q)[0] - 0.3]
        }
        fn direction(&self, _index: usize) -> Direction {
            Direction::Falling
        }
        fn happened(&mut self, _event: &Event, _x: &solved::State) -> Action<solved::State> {
            Action::Stop
        }
    }
    let model = solved::Model::<f64>::default();
    let energy = model.outputs(0.0, &solved_start(), &()).energy;
    let integrator = Integrator::adaptive(Dop853, 1e-10, 1e-10);
    let mut near = Near(&model);
    let (end, _, when) = integrator.with_events(&model, 0.0, 3.0, &solved_start(), &(), &mut near, |_| ()).unwrap();
    assert!(when > 0.8 && when < truth(), "stopped at {when} s");
    let kept = kept::Model::<f64>::default();
    let [a, b, c] = model.outputs(when, &end, &()).angles;
    let other = kept::State { q: kept::Position { a, b, c }, v: kept::Velocity { a: end.v.a, b: 0.0, c: 0.0 } };
    let held = kept::Velocity { a: 0.0, b: 1.0, c: 1.0 };
    let other = Projection::default().project_weighted(&kept, when, &other, &held).unwrap().state;
    let system = WithProjection::new(&kept, Projection::default());
    let (end, _) = integrator.integrate(&system, when, 3.0, &other, &(), |_, _| ()).unwrap();
    let off = (kept.outputs(3.0, &end, &()).energy - energy).abs();
    assert!(off < 1e-7, "{off:e}");
}

#[test]
fn open_loops_are_refused() {
    let mut wrong = kept::State::<f64>::default();
    (wrong.q.a, wrong.q.b, wrong.q.c) = (0.7, 0.1, 0.2);
    let model = kept::Model::<f64>::default();
    let open = |result: Result<(), IntegrationError>| {
        let Err(IntegrationError::OpenLoops { time, residual, remedy }) = result else { panic!("{result:?}") };
        assert!(time == 2.0 && residual > 0.1 && remedy.contains("assemble"), "{residual} {remedy}");
    };
    open(Integrator::adaptive(Dop853, 1e-6, 1e-6).integrate(&model, 2.0, 3.0, &wrong, &(), |_, _| ()).map(drop));
    open(Integrator::fixed(Rk4, 1e-3).integrate(&model, 2.0, 3.0, &wrong, &(), |_, _| ()).map(drop));
    open(Rk4::integrate(&model, 2.0, &wrong, &(), 1e-3, 10, |_, _| ()).map(drop));
    open(simulate(&model, 2.0, 3.0, &wrong, &(), 1e-6, |_, _| ()).map(drop));
    let system = WithProjection::new(&model, Projection::default());
    open(Integrator::fixed(Rk4, 1e-3).integrate(&system, 2.0, 3.0, &wrong, &(), |_, _| ()).map(drop));

    // Newton's method from a guess that leads nowhere.
    let model = iterated::Model::<f32>::default();
    let mut lost = iterated::State { q: iterated::Position { a: 3.1_f32 }, ..Default::default() };
    lost.guess = iterated::Guess { b: 0.3, c: -2.0 };
    let result = Integrator::fixed(Rk4, 1e-3).integrate(&model, 0.0, 1.0, &lost, &(), |_, _| ());
    assert!(matches!(result, Err(IntegrationError::OpenLoops { .. })), "{result:?}");
}
