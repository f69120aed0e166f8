//! Loops at the edges: Andrews' squeezer at all its points, rows of four-bars through their flat pose, and mechanisms that
//! lock up. Reference data in `data/motion`.

#[path = "../models/forty.rs"]
mod forty;

use forty::{four_bars_40, redundant_40};
use multibody::impact::impact;
use multibody::integrators::{Action, Direction, Event, Events};
use multibody::nalgebra::SVector;
use multibody::projection::rank;
use multibody::{
    Constrained, Dop853, DormandPrince, IntegrationError, Integrator, Projection, ProjectionError, System,
    WithBaumgarte, WithProjection, WithRank, multibody,
};
use multibody_tests::models::linkages::{squeezer as kept, squeezer_reduced as solved};
use multibody_tests::models::rows::{four_bars_2, four_bars_10, redundant_2, redundant_10};
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::data::{array, flat, list, number, read};
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Errors of angles (up to whole turns) and of rates.
fn squeezer_error(point: &Value, q: &[f64], v: &[f64]) -> [f64; 2] {
    let (want, rates) = (flat(&point["q"]), flat(&point["v"]));
    let unturned: Vec<f64> = q.iter().zip(&want).map(|(a, b)| a - TAU * ((a - b) / TAU).round()).collect();
    [mixed(&unturned, &want), mixed(v, &rates)]
}

fn both(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [worse(a[0], b[0]), worse(a[1], b[1])]
}

/// From point to point; the last number is that of evaluations.
fn follow<S, M>(
    integrator: &Integrator<M>,
    system: &S,
    start: S::State,
    points: &[Value],
    mut check: impl FnMut(&Value, &S::State),
) -> u32
where
    S: System<Scalar = f64, Input = ()>,
    M: multibody::Method<S>,
{
    let (mut state, mut t, mut evaluations) = (start, number(&points[0]["t"]), 0);
    for point in points {
        let end = number(&point["t"]);
        if end > t {
            let (next, statistics) = integrator.integrate(system, t, end, &state, &(), |_, _| ()).unwrap();
            (state, evaluations) = (next, evaluations + statistics.evaluations);
        }
        t = end;
        check(point, &state);
    }
    evaluations
}

fn kept_state(point: &Value) -> kept::State {
    let [beta, theta, gamma, phi, delta, omega, epsilon] = array(&point["q"]);
    let q = kept::Position { beta, theta, gamma, phi, delta, omega, epsilon };
    let [beta, theta, gamma, phi, delta, omega, epsilon] = array(&point["v"]);
    kept::State { q, v: kept::Velocity { beta, theta, gamma, phi, delta, omega, epsilon } }
}

#[test]
fn squeezer_at_all_points_reduced() {
    let file = read("motion/andrews");
    let points = list(&file["points"]);
    assert_eq!(points.len(), 51);
    let model = solved::Model::default();
    let mut start = solved::State::default();
    start.q.beta = number(&points[0]["q"][0]);
    let run = |integrator: Integrator<Dop853>| {
        let mut most = [0.0; 2];
        let evaluations = follow(&integrator, &model, start, points, |point, x| {
            let output = model.outputs(0.0, x, &());
            most = both(most, squeezer_error(point, output.angles.as_slice(), output.rates.as_slice()));
        });
        println!("squeezer, reduced: q {:.1e}, v {:.1e}, {evaluations} evaluations", most[0], most[1]);
        (most, evaluations)
    };
    let (fine, evaluations) = run(Integrator::fixed(Dop853, 1e-3 / 13.0).compensated());
    assert!(fine[0] <= 1e-12 && fine[1] <= 2e-10 && evaluations <= 8000, "{fine:?}, {evaluations}");
    let (rough, evaluations) = run(Integrator::fixed(Dop853, 1e-3 / 4.0));
    assert!(worse(rough[0], rough[1]) <= 1e-7 && evaluations <= 2600, "{rough:?}, {evaluations}");
}

#[test]
fn squeezer_at_all_points_with_multipliers() {
    let file = read("motion/andrews");
    let points = list(&file["points"]);
    let model = kept::Model::default();
    let once = Projection { iterations: 1, ..Projection::default() };
    let start =
        WithProjection::fixed(&model, Projection { iterations: 3, ..once }).accepted(0.0, &kept_state(&points[0]), &());
    fn run<S: System<Scalar = f64, Input = (), State = kept::State>>(
        name: &str,
        system: &S,
        (start, points): (kept::State, &[Value]),
        steps: f64,
    ) -> ([f64; 2], f64, u32) {
        let model = kept::Model::<f64>::default();
        let (mut most, mut residual) = ([0.0; 2], 0.0);
        let integrator = Integrator::fixed(Dop853, 1e-3 / steps).compensated();
        let evaluations = follow(&integrator, system, start, points, |point, x| {
            let output = model.outputs(0.0, x, &());
            most = both(most, squeezer_error(point, output.angles.as_slice(), output.rates.as_slice()));
            residual = worse(residual, model.constraints(0.0, &x.q).amax());
        });
        println!("{name}: q {:.1e}, v {:.1e}, residual {residual:.1e} m, {evaluations} evaluations", most[0], most[1]);
        (most, residual, evaluations)
    }
    let scene: (_, &[Value]) = (start, points);
    let (fine, residual, evaluations) = run("plain projection", &WithProjection::fixed(&model, once), scene, 12.0);
    assert!(fine[0] <= 1e-12 && fine[1] <= 2e-10 && evaluations <= 8000, "{fine:?}, {evaluations}");
    assert!(residual <= 2e-16, "{residual:e}");
    let by_mass = WithProjection::fixed_weighted(&model, once, multibody::projection::ByMass);
    let (fine, residual, evaluations) = run("projection by mass", &by_mass, scene, 12.0);
    assert!(fine[0] <= 1e-12 && fine[1] <= 2e-10 && evaluations <= 8000 && residual <= 2e-16, "{fine:?} {residual:e}");
    let (rough, residual, evaluations) = run("plain projection", &WithProjection::fixed(&model, once), scene, 4.0);
    assert!(worse(rough[0], rough[1]) <= 1e-7 && evaluations <= 2600 && residual <= 2e-16, "{rough:?}, {evaluations}");
    let (free, ..) = run("none", &model, scene, 13.0);
    let (closing, ..) = run("Baumgarte", &WithBaumgarte::for_step(&model, 1e-3 / 13.0), scene, 13.0);
    assert!(free[0] < 1e-8 && closing[0] < 1e-8, "{free:?} {closing:?}");
}

/// Energies and evaluations; `benches/long_runs.rs` has the time.
#[test]
fn squeezer_by_energy() {
    let file = read("motion/andrews");
    let start = list(&file["points"])[0].clone();
    let model = solved::Model::default();
    let mut state = solved::State::default();
    state.q.beta = number(&start["q"][0]);
    let energy = |x: &solved::State| model.outputs(0.0, x, &()).energy;
    let at_start = energy(&state);
    let mut fewest = u32::MAX;
    for tolerance in [1e-7, 1e-8, 1e-9, 1e-10] {
        let integrator = Integrator::adaptive(Dop853, tolerance, tolerance);
        let mut drift = 0.0_f64;
        let look = |_: f64, x: &solved::State| drift = drift.max((energy(x) - at_start).abs());
        let (_, statistics) = integrator.integrate(&model, 0.0, 0.05, &state, &(), look).unwrap();
        println!("tolerance {tolerance:e}: {drift:.1e} J, {} evaluations", statistics.evaluations);
        if drift <= 1e-8 {
            fewest = fewest.min(statistics.evaluations);
        }
    }
    println!("{fewest} evaluations for 1e-8 J");
    assert!(fewest <= 3000, "{fewest} evaluations");
}

/// Error of the first tip and of the rate of the cranks.
fn point_error(point: &Value, tip: &[f64], omega: f64) -> f64 {
    let place = mixed(&tip[..2], &[number(&point["x"]), number(&point["y"])]);
    worse(place, mixed(&[omega], &[number(&point["omega"])]))
}

#[test]
fn rows_of_four_bars_reduced() {
    let file = read("motion/a2_nfourbar");
    macro_rules! check {
        ($model:ident, $n:expr) => {{
            let model = $model::Model::default();
            let mut start = $model::State::default();
            (start.q.crank, start.v.crank) = (FRAC_PI_2, -1.0);
            let points = list(&file["data"][stringify!($n)]["points"]);
            // Whole turns change nothing, and small angles are rounded less.
            struct Unwound($model::Model);
            impl System for Unwound {
                type Scalar = f64;
                type State = $model::State;
                type Input = ();
                fn derivative(&self, t: f64, x: &$model::State, (): &()) -> ($model::Velocity, ()) {
                    self.0.derivative(t, x, &())
                }
                fn position_rates(&self, _t: f64, x: &$model::State) -> $model::Velocity {
                    x.v
                }
                fn accepted(&self, _t: f64, x: &$model::State, (): &()) -> $model::State {
                    let mut x = *x;
                    x.q.crank -= TAU * (x.q.crank / TAU).round();
                    x
                }
            }
            let mut most = 0.0;
            let integrator = Integrator::fixed(Dop853, 4e-3).compensated();
            let evaluations = follow(&integrator, &Unwound(model), start, points, |point, x| {
                let tip = model.outputs(0.0, x, &()).tip;
                most = worse(most, point_error(point, tip.as_slice(), x.v.crank));
            });
            println!("{} four-bars, reduced: {most:.1e}, {evaluations} evaluations", $n);
            assert!(most <= 1e-12, "{most:e}");
        }};
    }
    check!(four_bars_2, 2);
    check!(four_bars_10, 10);
    check!(four_bars_40, 40);
}

/// The rank of the equations where the cranks lie flat, by an event there.
struct Flat<C, R> {
    height: C,
    rank: R,
    least: f64,
    times: u32,
}

impl<S: System, C: Fn(&S::State) -> f64, R: Fn(&S::State) -> f64> Events<S, 1> for Flat<C, R> {
    fn values(&self, _t: f64, x: &S::State) -> [f64; 1] {
        [(self.height)(x)]
    }
    fn direction(&self, _index: usize) -> Direction {
        Direction::Both
    }
    fn happened(&mut self, _event: &Event, x: &S::State) -> Action<S::State> {
        self.least = self.least.min((self.rank)(x));
        self.times += 1;
        Action::Continue
    }
}

#[test]
fn rows_of_four_bars_with_redundant_joints() {
    let file = read("motion/a2_nfourbar");
    macro_rules! check {
        ($model:ident, $n:expr, $dt:expr) => {{
            let model = $model::Model::default();
            let rows = $model::CONSTRAINTS as f64;
            let points = list(&file["data"][stringify!($n)]["points"]);
            let vertical = |angle: f64, rate: f64| {
                // crank, then couplers and followers in the order of their names
                let names = $model::COORDINATES;
                let of = |name: &str, crank: f64| if name.starts_with("coupler") { -crank } else { crank };
                let q = SVector::<f64, { $model::DOF }>::from_fn(|i, _| of(names[i], angle));
                let v = SVector::<f64, { $model::DOF }>::from_fn(|i, _| of(names[i], rate));
                $model::State { q: q.into(), v: v.into() }
            };
            let projected = WithRank::new(WithProjection::new(&model, Projection::default()));
            let mut told = Flat {
                height: |x: &$model::State| x.q.crank.sin(),
                rank: |x: &$model::State| rank(&model, 0.0, x).min(model.forward_dynamics(0.0, x, &()).rank),
                least: rows,
                times: 0,
            };
            let (mut before, mut through, mut lean) = (0.0, 0.0, 0.0_f64);
            let (mut state, mut t) = (vertical(FRAC_PI_2, -1.0), 0.0);
            for point in points {
                let end = number(&point["t"]);
                if end > t {
                    let integrator = Integrator::fixed(DormandPrince, $dt);
                    let run = integrator.with_events(&projected, t, end, &state, &(), &mut told, |interval| {
                        let names = $model::COORDINATES;
                        let q = SVector::<f64, { $model::DOF }>::from(interval.last().q);
                        // Couplers keep their direction: the sums of angles from the crank on.
                        for i in 0..$model::DOF {
                            let of = |name: String| names.iter().position(|n| **n == name).map(|i| q[i]);
                            if let Some(number) = names[i].strip_prefix("coupler") {
                                let k: usize = number.parse().unwrap();
                                let parent = if k == 1 { "crank".into() } else { format!("follower{}", k - 1) };
                                lean = lean.max((q[i] + of(parent).unwrap()).sin().abs());
                            }
                        }
                    });
                    state = run.unwrap().0;
                }
                t = end;
                let tip = model.outputs(0.0, &state, &()).tip;
                let error = point_error(point, tip.as_slice(), state.v.crank);
                if told.times == 0 { before = worse(before, error) } else { through = worse(through, error) }
            }
            println!(
                "{} four-bars, redundant, dt {:e}: {before:.1e} before the flat pose, {through:.1e} through it; couplers \
                 lean {lean:.1e}; rank {} of {rows} in {} flat poses, {:?} at the ends of steps",
                $n, $dt, told.least, told.times, projected.least(),
            );
            assert!(lean < 0.1, "the branch of parallel bars was left: {lean}");
            assert!(told.times >= 5 && told.least < rows, "{} of {rows}", told.least);
            let at = |angle: f64| {
                let pose = vertical(angle, -1.0);
                (rank(&model, 0.0, &pose), model.forward_dynamics(0.0, &pose, &()).rank)
            };
            assert_eq!(at(0.0), (rows - f64::from($n), rows - f64::from($n)));
            // Away from there all of them count.
            for angle in [FRAC_PI_2, 1.0, 0.1, -0.1, 1e-3] {
                assert_eq!(at(angle), (rows, rows), "{angle}");
            }
        }};
    }
    check!(redundant_2, 2, 1e-3);
    check!(redundant_2, 2, 1e-2);
    check!(redundant_10, 10, 1e-2);
    check!(redundant_40, 40, 1e-2);
}

/// Declares a slider-crank, crank 1 m and rod 3 m; what a call adds is its formulation.
macro_rules! slider_crank {
    ($name:ident { $($items:tt)* }) => {
        multibody! {
            mod $name {
                body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                body link { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
                body block { mass: 2.0 }
                joint slider: Prismatic { parent: ground, child: block, axis: X }
                joint crank: Revolute { parent: ground, child: arm, axis: Z }
                joint rod: Revolute { parent: arm.at(X), child: link, axis: Z }
                #[cut]
                joint pin: Revolute { parent: link.at(3.0 * X), child: block, axis: Z }
                output energy = kinetic() + potential();
                $($items)*
            }
        }
    };
}
slider_crank! { pushed { formulation { constraints: Reduced } solve (crank, rod) from pin { sin(rod.angle) < 0.0 } emit forward_dynamics; } }
slider_crank! { sliding { formulation { constraints: Multipliers } emit forward_dynamics, impulse; } }
slider_crank! { pulled { formulation { constraints: Multipliers } drive slider.travel = 3.5 + 0.5 * t; emit forward_dynamics; } }

/// Declares a crank-rocker, crank 1 m, coupler 3.5 m, rocker 3 m, ground 4 m; what a call adds is its formulation.
macro_rules! crank_rocker {
    ($name:ident { $($items:tt)* }) => {
        multibody! {
            mod $name {
                body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                body link { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
                body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
                joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
                joint crank: Revolute { parent: ground, child: arm, axis: Z }
                joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
                #[cut]
                joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
                output energy = kinetic() + potential();
                $($items)*
            }
        }
    };
}
crank_rocker! { rocked { formulation { constraints: Reduced } solve (crank, coupler) from pin { sin(coupler.angle) < 0.0 } emit forward_dynamics; } }
crank_rocker! { rocked_kept { formulation { constraints: Multipliers } drive rocker.angle = 2.0 - t; emit forward_dynamics; } }

/// How near a motion comes to a dead centre: where the coordinate that leads turns round, and at the ends of steps.
struct DeadCentre<R, D> {
    rate: R,
    distance: D,
    nearest: f64,
    turned: bool,
}

impl<S: System, R: Fn(&S::State) -> f64, D: Fn(&S::State) -> f64> Events<S, 1> for DeadCentre<R, D> {
    fn values(&self, _t: f64, x: &S::State) -> [f64; 1] {
        [(self.rate)(x)]
    }
    fn happened(&mut self, _event: &Event, x: &S::State) -> Action<S::State> {
        self.nearest = self.nearest.min((self.distance)(x));
        self.turned = true;
        Action::Continue
    }
}

/// Runs a motion that no position continues beyond its dead centre: it ends there, in the error that says so.
fn locks<S: System<Scalar = f64, Input = ()>>(
    name: &str,
    system: &S,
    start: &S::State,
    (rate, distance): (impl Fn(&S::State) -> f64, impl Fn(&S::State) -> f64),
) {
    let mut told = DeadCentre { rate, distance: &distance, nearest: f64::INFINITY, turned: false };
    let mut near_steps = f64::INFINITY;
    let integrator = Integrator::adaptive(DormandPrince, 1e-9, 1e-9);
    let run = integrator.with_events(system, 0.0, 10.0, start, &(), &mut told, |interval| {
        near_steps = near_steps.min(distance(interval.last()));
    });
    let nearest = told.nearest.min(near_steps);
    println!("{name}: {:?}, turned {}, nearest {nearest:.1e}", run.map(|run| run.1), told.turned);
    // It stops short of it by what rounding allows.
    let ended = matches!(run, Err(IntegrationError::DeadCentre { .. } | IntegrationError::StepTooSmall { .. }));
    assert!(ended, "{name}: it went on beyond its dead centre");
}

#[test]
fn a_slider_crank_locks_up() {
    // The slider as coordinate: with crank and rod in one line (at 4 m) it can't go on.
    let model = pushed::Model::default();
    println!("dead centres of {:?}", pushed::DEAD_CENTRES);
    let at = |travel: f64| {
        let mut x = pushed::State::default();
        (x.q.slider, x.v.slider) = (travel, 0.5);
        x
    };
    for (travel, wide) in [(3.0, 0.1), (3.9, 0.01), (4.0 - 1e-6, 0.0)] {
        let far = model.dead_centres(0.0, &at(travel).q).amin().abs();
        println!("slider at {travel}: {far:.2e} from a dead centre");
        assert!(far > wide);
    }
    assert!(model.dead_centres(0.0, &at(4.0).q).amin().abs() < 1e-7);
    let far = |x: &pushed::State| model.dead_centres(0.0, &x.q).amin().abs();
    locks("pushed to its dead centre", &model, &at(3.9), (|x| x.v.slider, far));

    // With its equations the crank turns through both dead centres.
    let model = sliding::Model::default();
    let mut start = sliding::State::default();
    (start.q.slider, start.v.crank, start.v.rod) = (4.0, 6.0, -8.0);
    assert!(model.constraint_rate(0.0, &start).amax() < 1e-15);
    let system = WithRank::new(WithProjection::by_mass(&model, Projection::default()));
    let energy: f64 = model.outputs(0.0, &start, &()).energy;
    let integrator = Integrator::fixed(Dop853, 1e-2);
    let (end, _) = integrator.integrate(&system, 0.0, 10.0, &start, &(), |_, _| ()).unwrap();
    let drift = (model.outputs(0.0, &end, &()).energy - energy).abs();
    println!("turned {:.2} times; energy {drift:.1e} J, least rank {:?}", end.q.crank / TAU, system.least());
    assert!(end.q.crank > 3.0 * TAU && drift < 1e-9 && system.least().unwrap().0 == sliding::CONSTRAINTS as f64);

    // The slider led by hand: at 4 m an equation is lost, beyond it there is no position.
    let full = sliding::CONSTRAINTS as f64;
    let led = sliding::Velocity { slider: 0.0, crank: 1.0, rod: 1.0 };
    let mut line = sliding::State::default();
    (line.q.slider, line.v.slider) = (4.0, 0.5);
    let (_, left) = model.correction(0.0, &line, &SVector::zeros(), &led);
    let stuck = Projection::default().project_weighted(&model, 0.0, &line, &led).unwrap_err();
    println!("led to its dead centre: rank {left} of {full}; {stuck}");
    assert!(left == full - 1.0 && matches!(stuck, ProjectionError::NoVelocity { .. }));
    line.q.slider = 4.1;
    let beyond = Projection::default().project_weighted(&model, 0.0, &line, &led).unwrap_err();
    println!("led beyond it: {beyond}");
    assert!(matches!(beyond, ProjectionError::NoConvergence { .. }));

    // The slider driven there, and beyond.
    let driven = pulled::Model::default();
    let line = pulled::State::default();
    let full = pulled::CONSTRAINTS as f64;
    assert!(driven.constraints(1.0, &line.q).amax() < 1e-15);
    let ranks = (rank(&driven, 1.0, &line), driven.forward_dynamics(1.0, &line, &()).rank);
    let stuck = Projection::default().project(&driven, 1.0, &line).unwrap_err();
    let beyond = Projection::default().project(&driven, 1.2, &line).unwrap_err();
    println!("driven to its dead centre: rank {ranks:?} of {full}; {stuck}; beyond it: {beyond}");
    assert_eq!(ranks, (full - 1.0, full - 1.0));
    assert!(matches!(stuck, ProjectionError::NoVelocity { .. }));
    assert!(matches!(beyond, ProjectionError::NoConvergence { .. }));

    // It runs into a stop at full speed.
    let stop = sliding::Velocity { crank: -1.0, ..Default::default() };
    let hit = impact(&model, 0.0, &start, &stop, 0.5).unwrap();
    assert!((hit.state.v.crank + 3.0).abs() < 1e-13 && (hit.state.v.rod - 4.0).abs() < 1e-13);
}

#[test]
fn a_four_bar_locks_up() {
    // Crank and coupler in one line where the rocker's end is 4.5 m away from the ground pin: 16 + 9 + 24 cos = 20.25.
    let lock = PI - ((16.0 + 9.0 - 20.25) / 24.0_f64).acos();
    let model = rocked::Model::default();
    println!("dead centres of {:?}", rocked::DEAD_CENTRES);
    let at = |angle: f64| {
        let mut x = rocked::State::default();
        (x.q.rocker, x.v.rocker) = (angle, -1.0);
        x
    };
    let far = |x: &rocked::State| model.dead_centres(0.0, &x.q).amin().abs();
    println!("from its dead centre: {:.2e} at 2 rad, {:.2e} at 1e-12 rad", far(&at(2.0)), far(&at(lock + 1e-12)));
    assert!(far(&at(2.0)) > 0.1 && far(&at(lock + 1e-12)) < 1e-4);
    assert!(far(&at(lock - 1e-3)).is_nan(), "beyond it there is no position");
    locks("swung to its dead centre", &model, &at(2.0), (|x| x.v.rocker, far));

    let model = rocked_kept::Model::default();
    let full = rocked_kept::CONSTRAINTS as f64;
    let end = [4.0 + 3.0 * lock.cos(), 3.0 * lock.sin()];
    let mut line = rocked_kept::State::default();
    line.q.crank = end[1].atan2(end[0]);
    let t = 2.0 - lock;
    assert!(model.constraints(t, &line.q).amax() < 1e-14, "{}", model.constraints(t, &line.q));
    let ranks = (rank(&model, t, &line), model.forward_dynamics(t, &line, &()).rank);
    let stuck = Projection::default().project(&model, t, &line).unwrap_err();
    println!("four-bar, driven to its lock: rank {ranks:?} of {full}; {stuck}");
    assert!(ranks.0 == full - 1.0 && ranks.1 == full - 1.0 && matches!(stuck, ProjectionError::NoVelocity { .. }));
    let beyond = Projection::default().project(&model, t + 0.2, &line).unwrap_err();
    println!("driven beyond it: {beyond}");
    assert!(matches!(beyond, ProjectionError::NoConvergence { .. }));
}
