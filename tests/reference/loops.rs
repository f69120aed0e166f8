//! Motions of loops against exact or 25-digit solutions (`data/motion`): N four-bars in a row through their flat pose, and
//! Andrews' squeezer.

use multibody::{Dop853, DormandPrince, Integrator, Projection, System};
use multibody_tests::models::linkages::{squeezer, squeezer_reduced};
use multibody_tests::models::rows::{four_bars_1, four_bars_2, four_bars_10, redundant_1, redundant_2};
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::data::{array, flat, list, number, read};
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Calls `check` with every point and the state there, by steps of at most `dt` with `after` each.
fn follow<S>(
    system: &S,
    mut state: S::State,
    points: &[Value],
    dt: f64,
    after: impl Fn(f64, &S::State) -> S::State,
    mut check: impl FnMut(&Value, &S::State),
) where
    S: System<Scalar = f64, Input = ()>,
{
    let mut t = number(&points[0]["t"]);
    for point in points {
        let end = number(&point["t"]);
        let steps = ((end - t) / dt).ceil();
        for k in 0..steps as u32 {
            let (h, start) = ((end - t) / steps, t + (end - t) / steps * f64::from(k));
            state = after(start + h, &Dop853::step(system, start, &state, &(), h));
        }
        t = end;
        check(point, &state);
    }
}

/// Error of the first tip and of the rate of the cranks.
fn point_error(point: &Value, tip: &[f64], omega: f64) -> f64 {
    let place = mixed(&tip[..2], &[number(&point["x"]), number(&point["y"])]);
    worse(place, mixed(&[omega], &[number(&point["omega"])]))
}

macro_rules! reduced {
    ($model:ident, $n:expr) => {{
        let file = read("motion/a2_nfourbar");
        let data = &file["data"][stringify!($n)];
        let model = $model::Model::new(&$model::Params::default());
        let mut start = $model::State::default();
        (start.q.crank, start.v.crank) = (FRAC_PI_2, -1.0);
        let mut most = 0.0;
        // A full turn changes nothing, and small angles are rounded less.
        let unwound = |_, state: &$model::State| {
            let mut state = *state;
            state.q.crank -= TAU * (state.q.crank / TAU).round();
            state
        };
        follow(&model, start, list(&data["points"]), 2e-3, unwound, |point, state| {
            let output = model.outputs(0.0, state, &());
            most = worse(most, point_error(point, output.tip.as_slice(), state.v.crank));
        });
        println!("{} four-bars, reduced: {most:e}", $n);
        assert!(most <= 1e-12, "{most:e}");
    }};
}

#[test]
fn four_bars_in_a_row_reduced() {
    reduced!(four_bars_1, 1);
    reduced!(four_bars_2, 2);
    reduced!(four_bars_10, 10);
}

macro_rules! redundant {
    ($model:ident, $n:expr, $state:expr, $couplers:expr, $dt:expr, $bound:expr) => {{
        let file = read("motion/a2_nfourbar");
        let data = &file["data"][stringify!($n)];
        let model = $model::Model::new(&$model::Params::default());
        let rows = $model::CONSTRAINTS as f64;
        let projection = Projection::default();
        let mut start = $model::State::default();
        $state(&mut start);
        let before = projection.project(&model, 0.0, &start).unwrap();
        assert_eq!(before.rank, rows, "redundant equations are left out");
        // The lowest rank on the way, and that at the flat pose itself.
        let lowest = std::cell::Cell::new(rows);
        let after = |t: f64, state: &$model::State| {
            let projected = projection.project(&model, t, state).unwrap();
            let rank = model.forward_dynamics(t, &projected.state, &()).rank;
            lowest.set(lowest.get().min(rank).min(projected.rank));
            projected.state
        };
        let (mut early, mut late, mut flat) = (0.0, 0.0, false);
        follow(&model, start, list(&data["points"]), $dt, after, |point, state| {
            let output = model.outputs(0.0, state, &());
            let error = point_error(point, output.tip.as_slice(), state.v.crank);
            flat |= number(&point["y"]) < 0.05;
            if flat {
                late = worse(late, error)
            } else {
                early = worse(early, error)
            }
            // The branch is that of parallel bars: couplers keep their direction.
            let turned: [f64; $n] = $couplers(state);
            assert!(turned.iter().all(|angle: &f64| angle.cos() > 0.999), "t = {}: {turned:?}", point["t"]);
        });
        println!("{} four-bars, redundant: {early:e} before the flat pose, {late:e} through it", $n);
        assert!(flat && early <= 1e-10 && late <= $bound, "{early:e}, {late:e}");
        // All bars in one line: each loop may open in two ways.
        let mut state = $model::State::default();
        state.v.crank = -1.0;
        let flat = projection.project(&model, 0.0, &state).unwrap();
        let accel = model.forward_dynamics(0.0, &flat.state, &());
        assert!(flat.rank < rows && accel.rank < rows, "{} and {} of {rows}", flat.rank, accel.rank);
        assert!(accel.v.crank.is_finite());
        println!("lowest rank in steps {} of {rows}, {} at the flat pose", lowest.get(), accel.rank);
    }};
}

#[test]
fn four_bars_with_redundant_joints() {
    let start = |s: &mut redundant_1::State| {
        (s.q.crank, s.q.coupler1, s.q.follower1) = (FRAC_PI_2, -FRAC_PI_2, FRAC_PI_2);
        (s.v.crank, s.v.coupler1, s.v.follower1) = (-1.0, 1.0, -1.0);
    };
    redundant!(redundant_1, 1, start, |s: &redundant_1::State| [s.q.crank + s.q.coupler1], 1e-3, 1e-3);
    let start = |s: &mut redundant_2::State| {
        (s.q.crank, s.q.coupler1, s.q.follower1) = (FRAC_PI_2, -FRAC_PI_2, FRAC_PI_2);
        (s.v.crank, s.v.coupler1, s.v.follower1) = (-1.0, 1.0, -1.0);
        (s.q.coupler2, s.q.follower2, s.v.coupler2, s.v.follower2) = (-FRAC_PI_2, FRAC_PI_2, 1.0, -1.0);
    };
    let couplers = |s: &redundant_2::State| [s.q.crank + s.q.coupler1, s.q.follower1 + s.q.coupler2];
    // Where steps land beside the flat pose decides: 5e-5 to 1.2e-3 with steps of 0.5 to 1.1 ms.
    redundant!(redundant_2, 2, start, couplers, 1e-3, 2e-3);
}

/// beta, Theta, gamma, Phi, delta, Omega, epsilon.
fn squeezer_error(point: &Value, q: &[f64], v: &[f64]) -> [f64; 2] {
    let (want, rates) = (flat(&point["q"]), flat(&point["v"]));
    // The reduced model gives angles up to whole turns.
    let unturned: Vec<f64> = q.iter().zip(&want).map(|(a, b)| a - TAU * ((a - b) / TAU).round()).collect();
    [mixed(&unturned, &want), mixed(v, &rates)]
}

#[test]
fn squeezer_with_its_loops_solved() {
    let file = read("motion/andrews");
    let model = squeezer_reduced::Model::new(&squeezer_reduced::Params::default());
    let points = list(&file["points"]);
    let mut start = squeezer_reduced::State::default();
    start.q.beta = number(&points[0]["q"][0]);
    let mut most = [0.0; 2];
    follow(
        &model,
        start,
        points,
        2e-6,
        |_, state| *state,
        |point, state| {
            let found = model.kinematics(0.0, state, &Default::default());
            let (q, v) = (found.position, found.velocity);
            let order = |x: f64, f: &[f64]| [x, f[0], f[1], f[2], f[3], f[4], f[5]];
            let error = squeezer_error(point, &order(state.q.beta, q.as_slice()), &order(state.v.beta, v.as_slice()));
            most = [0, 1].map(|k| worse(most[k], error[k]));
        },
    );
    println!("squeezer, reduced: q {:e}, v {:e}", most[0], most[1]);
    assert!(most[0] <= 1e-11 && most[1] <= 1e-9, "{most:?}");
}

#[test]
fn squeezer_with_multipliers() {
    let file = read("motion/andrews");
    let model = squeezer::Model::new(&squeezer::Params::default());
    let points = list(&file["points"]);
    let projection = Projection::default();
    let state_of = |q: [f64; 7], v: [f64; 7]| {
        let [beta, theta, gamma, phi, delta, omega, epsilon] = q;
        let q = squeezer::Position { beta, theta, gamma, phi, delta, omega, epsilon };
        let [beta, theta, gamma, phi, delta, omega, epsilon] = v;
        squeezer::State { q, v: squeezer::Velocity { beta, theta, gamma, phi, delta, omega, epsilon } }
    };
    let numbers = |q: &squeezer::Position| [q.beta, q.theta, q.gamma, q.phi, q.delta, q.omega, q.epsilon];
    let rates = |v: &squeezer::Velocity| [v.beta, v.theta, v.gamma, v.phi, v.delta, v.omega, v.epsilon];
    // Accelerations at the reference states.
    let mut accel = 0.0;
    for point in points {
        let at = model.forward_dynamics(0.0, &state_of(array(&point["q"]), array(&point["v"])), &());
        accel = worse(accel, mixed(&rates(&at.v), &flat(&point["a"])));
        assert_eq!(at.rank, 6.0);
    }
    println!("squeezer: accelerations {accel:e}");
    assert!(accel <= 1e-10, "{accel:e}");
    let start = projection.project(&model, 0.0, &state_of(array(&points[0]["q"]), [0.0; 7])).unwrap();
    let mut most = [0.0; 2];
    let after = |t: f64, state: &squeezer::State| projection.project(&model, t, state).unwrap().state;
    follow(&model, start.state, points, 2e-6, after, |point, state| {
        let error = squeezer_error(point, &numbers(&state.q), &rates(&state.v));
        most = [0, 1].map(|k| worse(most[k], error[k]));
    });
    println!("squeezer, multipliers: q {:e}, v {:e}", most[0], most[1]);
    assert!(most[0] <= 1e-11 && most[1] <= 1e-9, "{most:?}");
}

#[test]
fn squeezer_by_an_adaptive_method() {
    let file = read("motion/andrews");
    let model = squeezer_reduced::Model::new(&squeezer_reduced::Params::default());
    let mut start = squeezer_reduced::State::default();
    start.q.beta = number(&file["points"][0]["q"][0]);
    let (end, statistics) =
        Integrator::adaptive(DormandPrince, 1e-12, 1e-12).integrate(&model, 0.0, 0.03, &start, &(), |_, _| ()).unwrap();
    let point = list(&file["points"]).iter().find(|point| (number(&point["t"]) - 0.03).abs() < 1e-9).unwrap();
    let error = [mixed(&[end.q.beta], &flat(&point["q"])[..1]), mixed(&[end.v.beta], &flat(&point["v"])[..1])];
    println!("adaptive: {error:?} after {} evaluations", statistics.evaluations);
    assert!(error[0] <= 1e-10 && error[1] <= 1e-8, "{error:?}");
}
