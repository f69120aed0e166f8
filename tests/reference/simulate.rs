//! What `simulate` chooses: that it reaches the accuracy asked for, and that no other explicit method reaches it with less
//! than half of its evaluations, nor a splitting where the mass matrix is constant. What misses that is allowed by name and
//! by how much, so that it cannot get worse. Truth: solutions of 16 digits and more in `data` and in those of
//! `examples/tradeoff`. Errors are divided by the problem's own growth of errors, as that example measures it; it compares
//! times too.

#[path = "../../examples/models/four_bar.rs"]
mod four_bar_of_the_example;
#[path = "../../examples/models/panda.rs"]
mod panda_of_the_example;

use multibody::nalgebra::{SVector, Vector3};
use multibody::{
    Composition4, Composition6, Dop853, DormandPrince, ExtraOf, IntegrationError, Integrator, Method, Radau, Rk4,
    Separable, System, VelocityOf, Verlet, simulate, simulate_stiff,
};
use multibody_tests::models::energy::swing;
use multibody_tests::models::linkages::squeezer_reduced;
use multibody_tests::models::motion::{free_body, two_masses};
use multibody_tests::models::small::oscillator;
use multibody_tests::models::stewart::reduced;
use multibody_tests::models::stiff::governor;
use multibody_tests::support::compare::{mixed, worse};
use multibody_tests::support::data::{array, flat, list, number, path, read};
use serde_json::Value;

use four_bar_of_the_example::free;
use panda_of_the_example::panda;

const ACCURACIES: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// At most so many times the evaluations of the best method at its best setting in hindsight.
const AIM: f64 = 2.0;

/// Runs a curve: evaluations and errors.
type Collect<'a> = dyn Fn(&mut Vec<(u32, f64)>) + 'a;

/// A problem with its truth: how far a state at the end is from it.
struct Problem<'a, S: System> {
    name: &'static str,
    system: &'a S,
    start: S::State,
    input: S::Input,
    end: f64,
    /// By `cargo run --release --example tradeoff`.
    growth: f64,
    error: &'a dyn Fn(&S::State) -> f64,
}

/// The point at a time.
fn at(file: &Value, t: f64) -> &Value {
    list(&file["points"]).iter().find(|point| number(&point["t"]) == t).unwrap()
}

impl<S: System<Scalar = f64>> Problem<'_, S> {
    /// Evaluations and errors of a sweep.
    fn sweep<M: Method<S>>(&self, runs: &mut Vec<(u32, f64)>, integrators: impl Iterator<Item = Integrator<M>>) {
        for integrator in integrators {
            let end = integrator.integrate(self.system, 0.0, self.end, &self.start, &self.input, |_, _| ());
            let Ok((state, statistics)) = end else { continue };
            runs.push((statistics.evaluations, (self.error)(&state) / self.growth));
        }
    }

    /// What explicit methods reach with how many evaluations.
    fn best(&self) -> Vec<(u32, f64)> {
        let tolerances = || (0..24).map(|k| 1e-1 * 3.0_f64.powi(-k));
        let mut all = Vec::new();
        let mut add = |collect: &Collect<'_>| all.extend(without_luck(collect));
        let first = self.end / 10.0;
        add(&|runs| self.sweep(runs, steps(first).map(|step| Integrator::fixed(Rk4, step))));
        add(&|runs| self.sweep(runs, steps(first).map(|step| Integrator::fixed(DormandPrince, step))));
        add(&|runs| self.sweep(runs, steps(first).map(|step| Integrator::fixed(Dop853, step))));
        add(&|runs| self.sweep(runs, tolerances().map(|t| Integrator::adaptive(DormandPrince, t, t))));
        add(&|runs| self.sweep(runs, tolerances().map(|t| Integrator::adaptive(Dop853, t, t))));
        all
    }

    /// `ratios` are the greatest allowed at each accuracy; the aim is [`AIM`].
    fn check(&self, ratios: [f64; 3]) {
        self.check_against(ratios, self.best());
    }

    fn check_against(&self, ratios: [f64; 3], best: Vec<(u32, f64)>) {
        for (accuracy, bound) in ACCURACIES.into_iter().zip(ratios) {
            let least = best.iter().filter(|run| run.1 <= accuracy).map(|run| run.0).min().unwrap();
            let (state, statistics) =
                simulate(self.system, 0.0, self.end, &self.start, &self.input, accuracy, |_, _| ()).unwrap();
            let error = (self.error)(&state) / self.growth;
            let ratio = f64::from(statistics.evaluations) / f64::from(least);
            println!(
                "{:<14}{accuracy:.0e}: error {error:.1e}, {} evaluations, {ratio:.2} times the least",
                self.name, statistics.evaluations
            );
            assert!(error <= accuracy, "{}: error {error:e} at {accuracy:e}", self.name);
            assert!(ratio <= bound, "{}: {ratio} times the least at {accuracy:e}", self.name);
        }
    }
}

impl<S: Separable + System<Scalar = f64>> Problem<'_, S> {
    /// What splittings reach with how many evaluations.
    fn splittings(&self) -> Vec<(u32, f64)> {
        let mut all = Vec::new();
        let mut add = |collect: &Collect<'_>| all.extend(without_luck(collect));
        let first = self.end / 10.0;
        add(&|runs| self.sweep(runs, steps(first).map(|step| Integrator::fixed(Verlet, step))));
        add(&|runs| self.sweep(runs, steps(first).map(|step| Integrator::fixed(Composition4, step))));
        add(&|runs| self.sweep(runs, steps(first).map(|step| Integrator::fixed(Composition6, step))));
        all
    }
}

/// Ever shorter ones `[s]`.
fn steps(first: f64) -> impl Iterator<Item = f64> {
    (0..18).map(move |k| first * 1.5_f64.powi(-k))
}

/// A curve where an error counts only if no finer run has a greater one.
fn without_luck(collect: &Collect<'_>) -> Vec<(u32, f64)> {
    let mut curve = Vec::new();
    collect(&mut curve);
    let mut greatest = 0.0;
    let worst_so_far = |(evaluations, error): (u32, f64)| {
        greatest = worse(greatest, error);
        (evaluations, greatest)
    };
    curve.into_iter().rev().map(worst_so_far).collect()
}

/// Positions and velocities of a scene of `examples/tradeoff` at its end.
fn truth<const N: usize>(scene: &str) -> [[f64; N]; 2] {
    let text = std::fs::read_to_string(path("../examples/tradeoff/data/references.txt")).unwrap();
    let line = text.lines().find(|line| line.split(' ').next() == Some(scene)).unwrap();
    let numbers = |part: &str| part.split_whitespace().map(|word| word.parse().unwrap()).collect::<Vec<f64>>();
    let parts: Vec<_> = line.split('|').skip(1).map(numbers).collect();
    [0, 1].map(|k| parts[k].clone().try_into().unwrap())
}

/// The friction of the scene's arm, its motors off `[N m s/rad]`.
const FRICTION: [f64; 7] = [2.0, 2.0, 1.0, 1.0, 0.4, 0.4, 0.2];

/// The arm of the example with viscous friction in place of its motors.
struct Arm(panda::Model);

impl System for Arm {
    type Scalar = f64;
    type State = panda::State;
    type Input = ();
    fn derivative(&self, t: f64, state: &panda::State, (): &()) -> (VelocityOf<Self>, ExtraOf<Self>) {
        let v = SVector::<f64, 7>::from(state.v);
        self.0.derivative(t, state, &panda::Input { torque: std::array::from_fn(|i| -FRICTION[i] * v[i]) })
    }
    fn position_rates(&self, _t: f64, state: &panda::State) -> VelocityOf<Self> {
        state.v
    }
}

#[test]
fn arm() {
    let [true_q, true_v] = truth::<7>("panda");
    let error = |x: &panda::State| {
        let (q, v): (SVector<f64, 7>, SVector<f64, 7>) = (x.q.into(), x.v.into());
        worse(mixed(q.as_slice(), &true_q), mixed(v.as_slice(), &true_v))
    };
    Problem {
        name: "arm",
        system: &Arm(panda::Model::new(&panda::Params::default())),
        start: panda::State {
            q: SVector::from([0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]).into(),
            v: SVector::from([0.5, -0.3, 0.2, 0.4, -0.6, 0.3, 0.1]).into(),
        },
        input: (),
        end: 2.0,
        growth: 48.437,
        error: &error,
    }
    .check([AIM; 3]);
}

#[test]
fn four_bar() {
    let [true_q, true_v] = truth::<3>("four_bar");
    let (model, input) = (free::Model::default(), free::Input::default());
    let error = |x: &free::State| {
        // The rocker's angle, and its rate by the loop: the coupler's two equations.
        let (crank, rate) = (x.q.drive_shaft, x.v.drive_shaft);
        let rocker = model.outputs(0.0, x, &input).rocker_angle;
        let coupler = (3.0 * rocker.sin() - crank.sin()).atan2(4.0 + 3.0 * rocker.cos() - crank.cos());
        let sine = (rocker - coupler).sin();
        let rocker_rate = rate * (crank - coupler).sin() / (3.0 * sine);
        let coupler_rate = rate * (crank - rocker).sin() / (3.5 * sine);
        let q = [crank, coupler, rocker];
        worse(mixed(&q, &true_q), mixed(&[rate, coupler_rate, rocker_rate], &true_v))
    };
    Problem {
        name: "four-bar",
        system: &model,
        start: free::State { v: free::Velocity { drive_shaft: 6.0 }, ..Default::default() },
        input,
        end: 4.0,
        growth: 31.05,
        error: &error,
    }
    .check([AIM; 3]);
}

/// The one scene with a constant mass matrix, where splittings compete.
#[test]
fn pendulum() {
    let [[angle], [rate]] = truth::<1>("pendulum");
    let error = |x: &swing::State| worse(mixed(&[x.q.hinge], &[angle]), mixed(&[x.v.hinge], &[rate]));
    let problem = Problem {
        name: "pendulum",
        system: &swing::Model::new(&swing::Params::default()),
        start: swing::State { q: swing::Position { hinge: -std::f64::consts::FRAC_PI_2 }, ..Default::default() },
        input: (),
        end: 10.0,
        growth: 20.703,
        error: &error,
    };
    let rivals = [problem.best(), problem.splittings()].concat();
    // Missed: splittings of order two at 1e-3 and four at 1e-6. `simulate` asks for no constant mass matrix.
    problem.check_against([2.1, 2.3, AIM], rivals);
}

fn double_pendulum(name: &'static str, file: &str, end: f64, growth: f64, ratios: [f64; 3]) {
    let file = read(file);
    let start: [f64; 2] = array(&list(&file["points"])[0]["theta"]);
    let point = at(&file, end);
    let error = |x: &two_masses::State| {
        let q = [x.q.shoulder, x.q.shoulder + x.q.elbow];
        let v = [x.v.shoulder, x.v.shoulder + x.v.elbow];
        worse(mixed(&q, &flat(&point["theta"])), mixed(&v, &flat(&point["omega"])))
    };
    Problem {
        name,
        system: &two_masses::Model::new(&two_masses::Params::default()),
        start: two_masses::State {
            q: two_masses::Position { shoulder: start[0], elbow: start[1] - start[0] },
            ..Default::default()
        },
        input: (),
        end,
        growth,
        error: &error,
    }
    .check(ratios);
}

#[test]
fn regular_double_pendulum() {
    double_pendulum("regular", "motion/double_pendulum_mild", 10.0, 3.82, [AIM; 3]);
}

#[test]
fn chaotic_double_pendulum() {
    double_pendulum("chaotic", "motion/double_pendulum", 5.0, 1179.0, [AIM; 3]);
}

#[test]
fn free_rotation() {
    let file = read("motion/rigid_dzhanibekov");
    let point = at(&file, 20.0);
    let error = |x: &free_body::State| {
        let p = x.q.free.orientation.into_inner();
        let truth = flat(&point["q"]);
        let sign = (p.w * truth[0] + p.i * truth[1] + p.j * truth[2] + p.k * truth[3]).signum();
        let q = [p.w, p.i, p.j, p.k].map(|x| sign * x);
        worse(mixed(&q, &truth), mixed(x.v.free.angular.as_slice(), &flat(&point["omega"])))
    };
    let mut start = free_body::State::default();
    start.v.free.angular = Vector3::from(array(&file["omega0_body"]));
    Problem {
        name: "free rotation",
        system: &free_body::Model::new(&free_body::Params::default()),
        start,
        input: (),
        end: 20.0,
        growth: 30.0,
        error: &error,
    }
    .check([AIM; 3]);
}

#[test]
fn squeezer() {
    let file = read("motion/andrews");
    let point = at(&file, 0.05);
    let (q, v) = (flat(&point["q"])[0], flat(&point["v"])[0]);
    let error = |x: &squeezer_reduced::State| worse(mixed(&[x.q.beta], &[q]), mixed(&[x.v.beta], &[v]));
    Problem {
        name: "squeezer",
        system: &squeezer_reduced::Model::<f64>::default(),
        start: squeezer_reduced::State {
            q: squeezer_reduced::Position { beta: flat(&file["initial"]["q"])[0] },
            ..Default::default()
        },
        input: (),
        end: 0.05,
        growth: 40.0,
        error: &error,
    }
    .check([AIM; 3]);
}

#[test]
fn platform() {
    let file = read("stewart/forward");
    let case = list(&file["trajectories"]).iter().find(|case| case["name"] == "spring_damper").unwrap();
    let [pose, rates] = ["pose", "vel"].map(|key| list(&case[key]));
    let error = |x: &reduced::State| {
        let (q, v): (SVector<f64, 6>, SVector<f64, 6>) = (x.q.into(), x.v.into());
        worse(mixed(q.as_slice(), &flat(pose.last().unwrap())), mixed(v.as_slice(), &flat(rates.last().unwrap())))
    };
    let mut params = reduced::Params::default();
    let mut input = reduced::Input::default();
    for (leg, input) in params.legs.iter_mut().zip(&mut input.legs) {
        (leg.k, leg.c, leg.s0, input.thrust) = (200.0, 5.0, 0.262, 7.2);
    }
    Problem {
        name: "platform",
        system: &reduced::Model::new(&params),
        start: reduced::State {
            q: SVector::from(array::<6>(&pose[0])).into(),
            v: SVector::from(array::<6>(&rates[0])).into(),
        },
        input,
        end: 1.0,
        growth: 15.7,
        error: &error,
    }
    .check([AIM; 3]);
}

/// The implicit choice, against a sweep of its own method; an explicit one needs a hundred times as much.
#[test]
fn stiff() {
    let file = read("motion/governor");
    let points = list(&file["points"]);
    let [y, truth] = [&points[0], points.last().unwrap()].map(|point| array::<8>(&point["y"]));
    let halves = |y: [f64; 8]| [0, 4].map(|from| SVector::<f64, 4>::from_fn(|k, _| y[from + k]));
    let [q, v] = halves(y);
    let start = governor::State { q: q.into(), v: v.into() };
    let [true_q, true_v] = halves(truth);
    let (model, input) = (governor::Model::new(&governor::Params::default()), governor::Input { speed: 9.0 });
    let error = |x: &governor::State| {
        let (q, v): (SVector<f64, 4>, SVector<f64, 4>) = (x.q.into(), x.v.into());
        worse(mixed(q.as_slice(), true_q.as_slice()), mixed(v.as_slice(), true_v.as_slice()))
    };
    let mut runs: Vec<(u32, f64)> = Vec::new();
    for k in 0..22 {
        let tolerance = 1e-1 * 3.0_f64.powi(-k);
        let radau = Integrator::adaptive(Radau, tolerance, tolerance);
        let (end, statistics) = radau.integrate(&model, 0.0, 2.0, &start, &input, |_, _| ()).unwrap();
        runs.push((statistics.evaluations, error(&end)));
    }
    for accuracy in ACCURACIES {
        let reached = runs.iter().rev().take_while(|run| run.1 <= accuracy).last().unwrap();
        let (end, statistics) = simulate_stiff(&model, 0.0, 2.0, &start, &input, accuracy, |_, _| ()).unwrap();
        let (error, ratio) = (error(&end), f64::from(statistics.evaluations) / f64::from(reached.0));
        println!("stiff {accuracy:.0e}: error {error:.1e}, {} evaluations, {ratio:.2}", statistics.evaluations);
        assert!(error <= accuracy && ratio <= 2.0);
    }
}

#[test]
fn arguments() {
    let (model, state) = (oscillator::Model::<f64>::new(&oscillator::Params::default()), oscillator::State::default());
    for accuracy in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let result = simulate(&model, 0.0, 1.0, &state, &(), accuracy, |_, _| ());
        assert!(matches!(result, Err(IntegrationError::InvalidArgument { .. })), "{accuracy}: {result:?}");
    }
    // Below what a scalar can do it does what it can.
    let model = oscillator::Model::<f32>::new(&oscillator::Params::default());
    let start = oscillator::State { v: oscillator::Velocity { rail: 1.0_f32 }, ..Default::default() };
    let (single, statistics) = simulate(&model, 0.0, 1.0, &start, &(), 1e-12, |_, _| ()).unwrap();
    let (frequency, rest) = (5.0_f64, -9.81 / 25.0);
    let exact = rest * (1.0 - frequency.cos()) + frequency.sin() / frequency;
    println!(
        "single precision: {} evaluations, error {:.0e}",
        statistics.evaluations,
        f64::from(single.q.rail) - exact
    );
    assert!((f64::from(single.q.rail) - exact).abs() < 1e-5 && statistics.evaluations < 2000);
}
