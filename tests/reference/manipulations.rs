//! `diff`, `substitute` and entries of matrices against dual numbers, and against what they are entries of.

use multibody::System;
use multibody::nalgebra::SVector;
use multibody_tests::models::manipulations::{
    arm, bars, exact_poles, field_motor, four_unknowns, held_arm, held_bars, held_poles, iterated_bars, motor,
    small_poles, smaller_poles, unknown_angles, unknowns, vanishing_squares,
};
use multibody_tests::support::random::Random;
use num_dual::Dual64;

const TOLERANCE: f64 = 1e-12;

fn close(what: &str, got: &[f64], want: &[f64]) {
    assert_eq!(got.len(), want.len(), "{what}");
    let scale = 1.0 + want.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    for (got, want) in got.iter().zip(want) {
        assert!((got - want).abs() <= TOLERANCE * scale, "{what}: {got} for {want}");
    }
}

fn moving(list: &[Dual64]) -> Vec<f64> {
    list.iter().map(|x| x.eps).collect()
}

/// A state of the arm with dual numbers, in which one of position, velocity and own state may move.
fn arm_state(numbers: &[f64; 7], at: Option<usize>) -> arm::State<Dual64> {
    let x: Vec<Dual64> =
        numbers.iter().enumerate().map(|(k, x)| Dual64::new(*x, if at == Some(k) { 1.0 } else { 0.0 })).collect();
    let mut state = arm::State::<Dual64>::default();
    (state.q.shoulder.first, state.q.shoulder.second, state.q.elbow) = (x[0], x[1], x[2]);
    (state.v.shoulder.first, state.v.shoulder.second, state.v.elbow) = (x[3], x[4], x[5]);
    state.x.lag = x[6];
    state
}

fn arm_outputs(
    numbers: &[f64; 7],
    inputs: &[f64; 4],
    at: Option<usize>,
    edit: impl Fn(&mut arm::Params<Dual64>),
) -> arm::Output<Dual64> {
    let mut params = arm::Params::<Dual64>::default();
    edit(&mut params);
    let seed = |k: usize, x: f64| Dual64::new(x, if at == Some(7 + k) { 1.0 } else { 0.0 });
    let mut input = arm::Input::<Dual64>::default();
    (0..3).for_each(|k| input.torque[k] = seed(k, inputs[k]));
    input.valve = seed(3, inputs[3]);
    arm::Model::new(&params).outputs(Dual64::from(0.0), &arm_state(numbers, at), &input)
}

#[test]
fn open_tree() {
    let mut random = Random::new(17);
    for _ in 0..20 {
        let numbers: [f64; 7] = std::array::from_fn(|_| 2.0 * random.unit());
        let inputs: [f64; 4] = std::array::from_fn(|_| random.unit());
        let at = |at: usize| arm_outputs(&numbers, &inputs, Some(at), |_| {});
        let y = arm_outputs(&numbers, &inputs, None, |_| {});
        let re = |list: &[Dual64]| -> Vec<f64> { list.iter().map(|x| x.re).collect() };
        close("place by second", &re(y.place_by_second.as_slice()), &moving(at(1).place.as_slice()));
        close("speed by first", &re(y.speed_by_first.as_slice()), &moving(at(0).speed.as_slice()));
        close("moving by elbow", &re(&[y.moving_by_elbow]), &moving(&[at(2).moving]));
        close("moving by rate", &re(&[y.moving_by_rate]), &moving(&[at(5).moving]));
        close("mixture by lag", &re(&[y.mixture_by_lag]), &moving(&[at(6).mixture]));
        close("mixture by torque", &re(&[y.mixture_by_torque]), &moving(&[at(8).mixture]));
        close("mixture by valve", &re(&[y.mixture_by_valve]), &moving(&[at(10).mixture]));
        close("twice", &re(&[y.twice]), &moving(&[at(3).moving_by_rate]));
        let by = |edit: fn(&mut arm::Params<Dual64>)| arm_outputs(&numbers, &inputs, None, edit);
        let stored = by(|p| p.reach.z.eps = 1.0).stored;
        close("stored by reach", &re(&[y.stored_by_reach]), &moving(&[stored]));
        let stored = by(|p| p.many[0].eps = 1.0).stored;
        close("stored by stiffness", &re(&[y.stored_by_stiffness]), &moving(&[stored]));
        // By time: the velocity, the acceleration, and the power by dual numbers along the motion.
        close("place by time", &re(y.place_by_time.as_slice()), &re(y.speed.as_slice()));
        close("speed by time", &re(y.speed_by_time.as_slice()), &re(y.acceleration.as_slice()));
        let state = arm_state(&numbers, None);
        let model = arm::Model::<Dual64>::default();
        let mut input = arm::Input::<Dual64>::default();
        (0..3).for_each(|k| input.torque[k] = Dual64::from(inputs[k]));
        input.valve = Dual64::from(inputs[3]);
        let rates = model.forward_dynamics(Dual64::from(0.0), &state, &input);
        let along = |x: Dual64, rate: Dual64| Dual64::new(x.re, rate.re);
        let mut later = state;
        later.q.shoulder.first = along(state.q.shoulder.first, state.v.shoulder.first);
        later.q.shoulder.second = along(state.q.shoulder.second, state.v.shoulder.second);
        later.q.elbow = along(state.q.elbow, state.v.elbow);
        later.v.shoulder.first = along(state.v.shoulder.first, rates.v.shoulder.first);
        later.v.shoulder.second = along(state.v.shoulder.second, rates.v.shoulder.second);
        later.v.elbow = along(state.v.elbow, rates.v.elbow);
        later.x.lag = along(state.x.lag, rates.x.lag);
        let moved = model.outputs(Dual64::from(0.0), &later, &input);
        close("moving by time", &re(&[y.moving_by_time]), &moving(&[moved.moving]));
        // Entries, and values put in.
        let matrix = model.mass_matrix(&state.q);
        close("entry", &re(&[y.entry]), &re(&[matrix[(2, 0)]]));
        close("effort", &re(&[y.effort]), &re(&[model.bias(Dual64::from(0.0), &state, &input)[2]]));
        let mut put = numbers;
        (put[5], put[1]) = (0.0, 0.3 * numbers[6]);
        let still = arm_outputs(&put, &inputs, None, |p| p.many[1] = Dual64::from(2.0)).moving;
        close("still", &re(&[y.still]), &re(&[still]));
    }
}

/// Where forces are the slopes of the potential energy and nothing else acts, what is left of the equations at rest is what was
/// added to them.
#[test]
fn forces_from_energies() {
    let model = held_arm::Model::<f64>::default();
    let mut random = Random::new(5);
    for _ in 0..20 {
        let mut state = held_arm::State::<f64>::default();
        state.q.shoulder.first = 3.0 * random.unit();
        state.q.shoulder.second = 3.0 * random.unit();
        state.q.elbow = 3.0 * random.unit();
        let pull = [random.unit(), random.unit(), random.unit()];
        let input = held_arm::Input { pull: pull.into() };
        let bias = model.bias(0.0, &state, &input);
        let matrix = model.mass_matrix(&state.q);
        assert!((bias[2] + 0.5 * matrix[(2, 2)]).abs() < 1e-12, "{bias}");
        // A pull at the origin of the lower link acts on the shoulder by the columns of its Jacobian.
        let slopes = model.outputs(0.0, &state, &input).slopes;
        for column in 0..2 {
            let along: f64 = (0..3).map(|row| slopes[(row, column)] * pull[row]).sum();
            assert!((bias[column] + along).abs() < 1e-12, "{bias}");
        }
    }
}

#[test]
fn closed_loop() {
    let mut random = Random::new(23);
    let model = bars::Model::<f64>::default();
    let dual = bars::Model::<Dual64>::default();
    for _ in 0..20 {
        let (q, v, torque) = (0.9 + 0.6 * random.unit(), random.unit(), random.unit());
        let state = bars::State { q: bars::Position { crank: q }, v: bars::Velocity { crank: v } };
        let input = bars::Input { torque };
        let y = model.outputs(0.0, &state, &input);
        let moved = |dq: f64, dv: f64| {
            let state = bars::State {
                q: bars::Position { crank: Dual64::new(q, dq) },
                v: bars::Velocity { crank: Dual64::new(v, dv) },
            };
            dual.outputs(Dual64::from(0.0), &state, &bars::Input { torque: Dual64::from(torque) })
        };
        let (by_crank, by_rate) = (moved(1.0, 0.0), moved(0.0, 1.0));
        close("top by crank", y.top_by_crank.as_slice(), &moving(by_crank.top.as_slice()));
        close("speed by crank", y.speed_by_crank.as_slice(), &moving(by_crank.top_speed.as_slice()));
        close("speed by rate", y.speed_by_rate.as_slice(), &moving(by_rate.top_speed.as_slice()));
        close("moving by crank", &[y.moving_by_crank], &moving(&[by_crank.moving]));
        close("top by time", y.top_by_time.as_slice(), y.top_speed.as_slice());
        close("speed by time", y.speed_by_time.as_slice(), y.top_acceleration.as_slice());
        let accel = model.forward_dynamics(0.0, &state, &input).crank;
        close("moving by time", &[y.moving_by_time], &moving(&[moved(v, accel).moving]));
        close("inertia seen", &[y.inertia_seen], &[model.mass_matrix(&state.q)[(0, 0)]]);
        close("closed", y.closed_form.as_slice(), &[0.0; 3]);
        close("work", &[y.work], &[2.0]);
    }
}

/// Entries are components in the axes of the parent, and slopes what dual numbers say they are, wherever the loop is open too.
#[test]
fn entries_of_constraints() {
    let (model, dual) = (held_bars::Model::<f64>::default(), held_bars::Model::<Dual64>::default());
    let mut random = Random::new(37);
    for _ in 0..20 {
        let mut at = || 3.0 * random.unit();
        let [crank, coupler, rocker, slide] = [at(), at(), at(), at()];
        let state = held_bars::State { q: held_bars::Position { crank, coupler, rocker, slide }, ..Default::default() };
        let y = model.outputs(0.0, &state, &());
        let rack = slide + 0.3 * rocker.sin() - 0.1 * crank * crank;
        close("what is left", y.left.as_slice(), &[y.gap.x, y.gap.y, rack]);
        for k in 0..4 {
            let along = |at: usize, x: f64| Dual64::new(x, f64::from(u8::from(at == k)));
            let q = held_bars::Position {
                crank: along(0, crank),
                coupler: along(1, coupler),
                rocker: along(2, rocker),
                slide: along(3, slide),
            };
            let moved = dual.outputs(Dual64::from(0.0), &held_bars::State { q, ..Default::default() }, &());
            let found = [0, 1, 2].map(|row| y.slopes[4 * row + k]);
            close("slopes", &found, &moving(moved.left.as_slice()));
        }
    }
}

/// Dependent coordinates that an iteration finds move with the crank too. With m(q) q'' + m'(q) q'^2 / 2 for what a mechanism
/// of one freedom takes without gravity, the motor leaves an acceleration of its input.
#[test]
fn inertia_of_an_iterated_loop() {
    let mut random = Random::new(31);
    let model = iterated_bars::Model::<Dual64>::default();
    let t = Dual64::from(0.0);
    for _ in 0..10 {
        let (q, v, torque) = (0.9 + 0.3 * random.unit(), random.unit(), random.unit());
        let input = iterated_bars::Input { torque: Dual64::from(torque) };
        let mut state = iterated_bars::State::<Dual64>::default();
        state.q.crank = Dual64::new(q, 1.0);
        state.v.crank = Dual64::from(v);
        // Near the branch that is meant: elsewhere the iteration may end in the other one.
        (state.guess.coupler, state.guess.rocker) = (Dual64::from(-2.0), Dual64::from(-2.2));
        state = (0..10).fold(state, |state, _| model.accepted(t, &state, &input));
        let y = model.outputs(t, &state, &input);
        close("inertia by crank", &[y.inertia_by_crank.re], &[y.inertia_seen.eps]);
        close("inertia by time", &[y.inertia_by_time.re], &[y.inertia_seen.eps * v]);
        close("acceleration", &[model.derivative(t, &state, &input).0.crank.re], &[torque]);
    }
}

/// Without inductance the current is that of the resistance: i = (u - k w) / R.
#[test]
fn motor_without_inductance() {
    let model = motor::Model::<f64>::default();
    let p = motor::Params::<f64>::default();
    let mut random = Random::new(2);
    for _ in 0..10 {
        let (speed, voltage) = (9.0 * random.unit(), 24.0 * random.unit());
        let state = motor::State { v: motor::Velocity { shaft: speed }, ..Default::default() };
        let input = motor::Input { voltage };
        let current = (voltage - p.constant * speed) / p.resistance;
        close("current", &[model.outputs(0.0, &state, &input).flowing], &[current]);
        let accel = model.forward_dynamics(0.0, &state, &input).shaft;
        close("acceleration", &[accel], &[p.constant * current / 0.02]);
    }
}

#[test]
fn currents_that_depend_on_each_other() {
    let model = field_motor::Model::<f64>::default();
    let mut random = Random::new(3);
    for _ in 0..10 {
        let (speed, voltage) = (9.0 * random.unit(), [random.unit(), random.unit()]);
        let state = field_motor::State { v: field_motor::Velocity { shaft: speed }, ..Default::default() };
        let input = field_motor::Input { voltage };
        // 0.8 d - 0.3 w q = u, 0.2 w d + 0.7 q = v
        let det = 0.56 + 0.06 * speed * speed;
        let direct = (0.7 * voltage[0] + 0.3 * speed * voltage[1]) / det;
        let quadrature = (0.8 * voltage[1] - 0.2 * speed * voltage[0]) / det;
        close("currents", model.outputs(0.0, &state, &input).currents.as_slice(), &[direct, quadrature]);
        let rates = model.forward_dynamics(0.0, &state, &input);
        close("rates", &[rates.v.shaft, rates.x.heat], &[1.1 * quadrature / 0.02, 0.8 * direct * direct - 0.1]);
    }
}

#[test]
fn equations_of_ones_own() {
    let model = unknowns::Model::<f64>::default();
    let mut random = Random::new(4);
    for _ in 0..20 {
        let (q, w) = (random.unit(), random.unit());
        let (x, y, z) = (random.unit(), -3.0 + random.unit(), random.unit());
        let state = unknowns::State { q: unknowns::Position { shaft: q }, v: unknowns::Velocity { shaft: w } };
        let found = model.outputs(0.0, &state, &unknowns::Input { pull: [x, y, z].into() });
        let [a, b, c] = [0, 1, 2].map(|k| found.found[k]);
        let gaps = [1.3 * a - b - x - q.cos() * c, a + 1.6 * b + 0.5 * c - 3.0 * y, a * w + c - z + b];
        close("gaps", &gaps, &[0.0; 3]);
        close("alone", &[found.alone], &[(x - 1.0) / 2.2]);
        let [root, other] = [found.roots[0], found.roots[1]];
        assert!(root > 0.0);
        close("root", &[root * (root + x)], &[4.0 + q * q]);
        // Of the two values one is positive and never below; the other only where it lies below y.
        let below = (0.2 - (0.04 + 12.0 * root).sqrt()) / (2.0 * root);
        if below < y {
            close("other", &[other], &[below]);
        } else {
            assert!(other.is_nan());
        }
    }
}

#[test]
fn squares_that_vanish() {
    let model = vanishing_squares::Model::<f64>::default();
    let mut random = Random::new(7);
    let mut undefined = 0;
    for _ in 0..200 {
        let [x, z] = [random.unit(), random.unit()];
        let input = vanishing_squares::Input { pull: [x, 0.0, z].into() };
        let found = model.outputs(0.0, &vanishing_squares::State::default(), &input);
        close("first", &[found.lines[0]], &[(3.0 - x * x) / (2.0 * x)]);
        let (square, half, flat) = (x.max(0.0), 0.5 * (1.3 - z), found.lines[1]);
        let root = (half * half + 0.1 * square).sqrt();
        if square > 0.0 && (half + root) / square < 2.0 {
            undefined += 1;
            assert!(flat.is_nan() && found.slope.is_nan());
            continue;
        }
        close("flat", &[square * flat * flat + 2.0 * half * flat], &[0.1]);
        assert!(flat.abs() < 2.0);
        close("slope", &[found.slope], &[flat / (2.0 * root)]);
    }
    assert!(undefined > 10, "{undefined}");
}

/// Against all roots of an equation's values, found without its form.
#[test]
fn angles_of_ones_own() {
    use std::f64::consts::PI;
    let model = unknown_angles::Model::<f64>::default();
    let mut random = Random::new(5);
    let (mut known, mut unknown) = (0, 0);
    for _ in 0..200 {
        let (q, w) = (3.0 * random.unit(), random.unit());
        let [x, y, z] = [8.0 * random.unit(), 0.8 * random.unit(), 2.0 * random.unit()];
        let state = unknown_angles::State {
            q: unknown_angles::Position { shaft: q },
            v: unknown_angles::Velocity { shaft: w },
        };
        let input = unknown_angles::Input { pull: [x, y, z].into() };
        let found = model.outputs(0.0, &state, &input);
        let crooked = |a: f64| {
            let (u, v) = ([0.2, -0.4, (a - 0.3).cos()], [0.4, -1.1, 0.3]);
            let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            0.5 * cross[0] + w * cross[1] + 0.9 * cross[2]
        };
        let first = |a: f64, q: f64| crooked(a) + 1.3 * (q - a).sin() - 0.3 * x + (a.sin() - (2.0 * q - a).cos()) / 2.2;
        let level = -(0.5 * y).acos();
        let direction = (x / (3.0 + y)).atan();
        let after = (0.4 * z / level.sin()).asin();
        let meant: Vec<f64> = roots(|a| first(a, q)).into_iter().filter(|a| (a - q).cos() > 0.2).collect();
        match meant[..] {
            [a] => {
                known += 1;
                close("angles", found.found.as_slice(), &[a, level, direction, after]);
                close("crooked", &[found.crookedness], &[crooked(a)]);
                close("turned", &[found.turned], &[a.cos() + 1.3 * (2.0 * level).sin()]);
                // The other unknown doesn't turn with the shaft; this one by its equation.
                let h = 1e-6;
                let by = |at: f64, q: f64| (first(at + h, q) - first(at - h, q)) / (2.0 * h);
                let along = (first(a, q + h) - first(a, q - h)) / (2.0 * h);
                assert!((found.slopes + along / by(a, q)).abs() < 1e-6 * (1.0 + found.slopes.abs()) / by(a, q).abs());
            }
            _ => {
                unknown += 1;
                assert!(found.found[0].is_nan() && found.slopes.is_nan());
                close("other angles", &found.found.as_slice()[1..], &[level, direction, after]);
            }
        }
        let force = model.forward_dynamics(0.0, &state, &input).shaft;
        close("force", &[force], &[(level + q).sin() / 0.02]);
        assert!(found.found.iter().all(|a| a.is_nan() || a.abs() <= PI));
    }
    assert!(known > 50 && unknown > 20, "{known} and {unknown}");
}

/// Where a function changes its sign between -pi and pi.
fn roots(f: impl Fn(f64) -> f64) -> Vec<f64> {
    let at = |k: i32| f64::from(k) * std::f64::consts::PI / 500.0;
    let bisect = |k: i32| {
        let (mut a, mut b) = (at(k), at(k + 1));
        for _ in 0..60 {
            let middle = 0.5 * (a + b);
            if f(a) * f(middle) <= 0.0 { b = middle } else { a = middle }
        }
        0.5 * (a + b)
    };
    (-500..500).filter(|&k| f(at(k)) * f(at(k + 1)) < 0.0).map(bisect).collect()
}

#[test]
fn systems_with_pivots() {
    let model = four_unknowns::Model::<f64>::default();
    let mut random = Random::new(6);
    for _ in 0..20 {
        let (q, w) = (random.unit(), random.unit());
        let (x, y, z) = (random.unit(), random.unit(), random.unit());
        let state =
            four_unknowns::State { q: four_unknowns::Position { shaft: q }, v: four_unknowns::Velocity { shaft: w } };
        let found = model.outputs(0.0, &state, &four_unknowns::Input { pull: [x, y, z].into() });
        let [d, e, f, g] = [0, 1, 2, 3].map(|k| found.four[k]);
        let gaps = [e + 2.0 * f - g - x, d - e + f * q.cos() - 1.0, 3.0 * d + g - y * z, 0.5 * e + d - f + 2.0 * g - w];
        close("gaps of four", &gaps, &[0.0; 4]);
    }
}

/// To first order in what is small, at fixed accelerations: by dual numbers about zero.
macro_rules! small {
    ($module:ident, $($part:ident),*) => {{
        let (small, exact) = ($module::Model::<f64>::default(), exact_poles::Model::<Dual64>::default());
        let mut random = Random::new(8);
        for _ in 0..20 {
            let q: [f64; 3] = std::array::from_fn(|_| random.unit());
            let v: [f64; 3] = std::array::from_fn(|_| random.unit());
            let a: [f64; 3] = std::array::from_fn(|_| random.unit());
            let push = random.unit();
            let is_small = |name: &str| [$(stringify!($part)),*].contains(&name);
            let names = ["track", "hinge", "second"];
            // The expansion's argument moves all that is small at once: f(0) + df(0).
            let along = |k: usize, x: f64| {
                if is_small(names[k]) { Dual64::new(0.0, x) } else { Dual64::from(x) }
            };
            let state = exact_poles::State {
                q: exact_poles::Position { track: along(0, q[0]), hinge: along(1, q[1]), second: along(2, q[2]) },
                v: exact_poles::Velocity { track: along(0, v[0]), hinge: along(1, v[1]), second: along(2, v[2]) },
            };
            let lift = |k: usize| Dual64::from(a[k]);
            let accel = exact_poles::Velocity { track: lift(0), hinge: lift(1), second: lift(2) };
            let input = exact_poles::Input { push: Dual64::from(push) };
            let sum = |x: Dual64| x.re + x.eps;
            let t = Dual64::from(0.0);
            let want_efforts = exact.inverse_dynamics(t, &state, &input, &accel);
            let want_matrix: Vec<f64> = exact.mass_matrix(&state.q).iter().map(|x| sum(*x)).collect();
            let want_bias: Vec<f64> = exact.bias(t, &state, &input).iter().map(|x| sum(*x)).collect();
            let state = $module::State {
                q: $module::Position { track: q[0], hinge: q[1], second: q[2] },
                v: $module::Velocity { track: v[0], hinge: v[1], second: v[2] },
            };
            let input = $module::Input { push };
            let accel = $module::Velocity { track: a[0], hinge: a[1], second: a[2] };
            let efforts = small.inverse_dynamics(0.0, &state, &input, &accel);
            close(
                "efforts",
                &[efforts.track, efforts.hinge, efforts.second],
                &[want_efforts.track, want_efforts.hinge, want_efforts.second].map(sum),
            );
            let matrix = small.mass_matrix(&state.q);
            close("mass matrix", matrix.as_slice(), &want_matrix);
            let bias = small.bias(0.0, &state, &input);
            close("bias", bias.as_slice(), &want_bias);
            // Accelerations solve the expanded equations.
            let accel = small.forward_dynamics(0.0, &state, &input);
            let rest = matrix * SVector::from([accel.track, accel.hinge, accel.second]) + bias;
            close("rest", rest.as_slice(), &[0.0; 3]);
        }
    }};
}

#[test]
fn small_motions() {
    small!(small_poles, hinge);
    small!(smaller_poles, hinge, second);
}

/// Equations are printed as they are derived, and impulses move the expanded masses.
#[test]
fn small_motions_in_print_and_under_impulses() {
    let model = small_poles::Model::<f64>::default();
    let q = small_poles::Position { track: 0.2, hinge: 0.3, second: -0.7 };
    let impulse = small_poles::Velocity { track: 0.5, hinge: -0.3, second: 1.1 };
    let jump = model.impulse(&q, &impulse);
    let left = model.mass_matrix(&q) * SVector::from([jump.track, jump.hinge, jump.second]);
    close("impulse", left.as_slice(), &[0.5, -0.3, 1.1]);
    let motion: Vec<&str> = small_poles::FORMULAS
        .iter()
        .map(|line| line.text)
        .filter(|text| text.contains("hinge") && !text.starts_with("place"))
        .collect();
    assert!(motion.len() > 3, "{motion:?}");
    assert!(!motion.iter().any(|text| text.contains("sin(hinge") || text.contains("cos(hinge")), "{motion:#?}");
}

/// What is linear in all that moves is what the exact equations are linearised to.
#[test]
fn small_motions_and_the_linearised_equations() {
    let state = smaller_poles::State::<f64>::default();
    let small = smaller_poles::Model::<f64>::default().linearize(0.0, &state, &smaller_poles::Input { push: 0.4 });
    let state = exact_poles::State::<f64>::default();
    let exact = exact_poles::Model::<f64>::default().linearize(0.0, &state, &exact_poles::Input { push: 0.4 });
    // Gravity and the push accelerate the poles at zero: by them the mass matrix moves on, to first order too.
    close("A", small.a.as_slice(), exact.a.as_slice());
    close("B", small.b.as_slice(), exact.b.as_slice());
}

#[test]
fn what_is_held_leaves_the_state() {
    assert_eq!((exact_poles::DOF, held_poles::DOF), (3, 2));
    let (held, exact) = (held_poles::Model::<f64>::default(), exact_poles::Model::<f64>::default());
    let state = held_poles::State {
        q: held_poles::Position { track: 0.2, second: -0.7 },
        v: held_poles::Velocity { track: 0.5, second: 1.1 },
    };
    let accel = held.forward_dynamics(0.0, &state, &held_poles::Input { push: 0.6 });
    let state = exact_poles::State {
        q: exact_poles::Position { track: 0.2, hinge: 0.3, second: -0.7 },
        v: exact_poles::Velocity { track: 0.5, hinge: 0.0, second: 1.1 },
    };
    let accel = exact_poles::Velocity { track: accel.track, hinge: 0.0, second: accel.second };
    let efforts = exact.inverse_dynamics(0.0, &state, &exact_poles::Input { push: 0.6 }, &accel);
    close("efforts", &[efforts.track, efforts.second], &[0.0, 0.0]);
}
