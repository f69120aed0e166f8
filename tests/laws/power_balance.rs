//! Every force's power, in every example that has forces: what they feed in is what the energy changes by.
//!
//! Power is an output of each model, that of springs included: energy is that of motion and gravity. Work is integrated with
//! the motion, by the fifth-order method of Dormand and Prince at a step where its error is a rounding. Differences are
//! relative to the work and the change of energy, not to an energy, whose zero is anyone's choice.

#[path = "../models/powers.rs"]
mod powers;

/// Those that the examples themselves use, which have no such outputs.
#[path = "../../examples/models"]
mod examples {
    pub(crate) mod andrews;
    pub(crate) mod cart_pole;
    pub(crate) mod double_pendulum;
    pub(crate) mod four_bar;
    pub(crate) mod impacts;
    pub(crate) mod panda;
    pub(crate) mod slider_crank;
}

use multibody::nalgebra::{SVector, Vector3};
use multibody::{
    Configuration, DisplacementOf, DormandPrince, Projection, RollPitchYaw, StateSpace, System, Tangent, VelocityOf,
};
use multibody_tests::support::compare::worse;
use multibody_tests::support::data::{array, list, read};
use multibody_tests::support::random::Random;

use powers::*;

/// Of the greatest of the work and of the change of energy.
const BOUND: f64 = 1e-10;

/// A model whose work is integrated with its motion.
struct Working<'a, M, P> {
    model: &'a M,
    power: P,
}

/// Its state.
#[derive(Clone, Copy)]
struct Worked<Z> {
    plant: Z,
    /// [J]
    work: f64,
}

impl<Z: StateSpace<Scalar = f64, Extra = ()>> StateSpace for Worked<Z> {
    type Scalar = f64;
    type Position = Z::Position;
    type Velocity = Z::Velocity;
    type Extra = f64;
    fn split(&self) -> (Z::Position, Z::Velocity, f64) {
        let (q, v, ()) = self.plant.split();
        (q, v, self.work)
    }
    fn join(&self, q: Z::Position, v: Z::Velocity, work: f64) -> Self {
        Self { plant: self.plant.join(q, v, ()), work }
    }
}

impl<M, P> System for Working<'_, M, P>
where
    M: System<Scalar = f64>,
    M::State: StateSpace<Scalar = f64, Extra = ()>,
    P: Fn(f64, &M::State, &M::Input) -> f64,
{
    type Scalar = f64;
    type State = Worked<M::State>;
    type Input = M::Input;
    fn derivative(&self, t: f64, state: &Self::State, input: &M::Input) -> (VelocityOf<Self>, f64) {
        (self.model.derivative(t, &state.plant, input).0, (self.power)(t, &state.plant, input))
    }
    fn position_rates(&self, t: f64, state: &Self::State) -> DisplacementOf<M> {
        self.model.position_rates(t, &state.plant)
    }
    fn accepted(&self, t: f64, state: &Self::State, input: &M::Input) -> Self::State {
        Worked { plant: self.model.accepted(t, &state.plant, input), ..*state }
    }
}

/// Integrates `steps` of `dt`, with what `input` gives for the time held over each step, and compares.
macro_rules! balance {
    ($model:ident, $start:expr, $input:expr, $dt:expr, $steps:expr) => {
        balance!($model, $start, $input, $dt, $steps, |_, _, state| state)
    };
    ($model:ident, $start:expr, $input:expr, $dt:expr, $steps:expr, $after:expr) => {{
        let model = $model::Model::new(&$model::Params::default());
        let after: fn(&$model::Model, f64, $model::State) -> $model::State = $after;
        let power = |t, state: &$model::State, input: &_| model.outputs(t, state, input).power;
        let working = Working { model: &model, power };
        let mut state = Worked { plant: $start, work: 0.0 };
        let first = model.outputs(0.0, &state.plant, &$input(0.0)).energy;
        let (mut worst, mut scale) = (0.0_f64, 0.0_f64);
        for k in 0..$steps {
            let t = f64::from(k) * $dt;
            let input = $input(t);
            state = DormandPrince::step(&working, t, &state, &input, $dt);
            state.plant = after(&model, t + $dt, state.plant);
            let change = model.outputs(t + $dt, &state.plant, &input).energy - first;
            scale = scale.max(change.abs()).max(state.work.abs());
            worst = worse(worst, (change - state.work).abs());
        }
        let error = worst / scale;
        println!("{}: work {:.6} J, scale {scale:.3e} J, balance {error:.1e}", stringify!($model), state.work);
        assert!(error <= BOUND, "{}: {error:e}", stringify!($model));
    }};
}

/// Accelerations at random states.
fn accelerations<S: System<Scalar = f64, State: Default>>(system: &S, input: &S::Input) -> Vec<f64> {
    let (mut random, mut all) = (Random::new(11), Vec::new());
    for _ in 0..10 {
        let start = S::State::default();
        let (q, v, own) = start.split();
        let q = q.displace(&DisplacementOf::<S>::zero().map(&mut |_| random.unit()));
        let state = start.join(q, v.map(&mut |_| random.unit()), own);
        system.derivative(0.0, &state, input).0.fold((), &mut |(), x| all.push(x));
    }
    all
}

/// What is declared here with a power moves as what the example declares, so one can't be changed without the other.
#[test]
fn these_are_the_examples() {
    use examples as theirs;
    let same = |name: &str, ours: &[f64], theirs: &[f64]| {
        assert!(ours.iter().all(|x| x.is_finite()), "{name}: {ours:?}");
        let gap = ours.iter().zip(theirs).fold(0.0, |most, (a, b)| worse(most, (a - b).abs() / (1.0 + b.abs())));
        println!("{name}: {gap:.0e}");
        assert!(ours.len() == theirs.len() && gap <= 1e-10, "{name}: {gap:e}");
    };
    macro_rules! same {
        ($model:ident, $example:path $(, $field:ident: $value:expr)?) => {{
            use $example as example;
            #[allow(clippy::let_unit_value)]
            let inputs = same!(@inputs $model, example $(, $field: $value)?);
            let ours = accelerations(&$model::Model::<f64>::default(), &inputs.0);
            same(stringify!($model), &ours, &accelerations(&example::Model::<f64>::default(), &inputs.1));
        }};
        (@inputs $model:ident, $example:ident) => { ((), ()) };
        (@inputs $model:ident, $example:ident, $field:ident: $value:expr) => {
            ($model::Input { $field: $value }, $example::Input { $field: $value })
        };
    }
    same!(double_pendulum, theirs::double_pendulum::double_pendulum);
    same!(cart_pole, theirs::cart_pole::cart_pole, push: 0.7);
    same!(four_bar, theirs::four_bar::free, torque: 0.7);
    same!(slider_crank, theirs::slider_crank::engine, gas: 0.7);
    same!(block, theirs::impacts::block);
    same!(mount, theirs::impacts::mount);
    same!(andrews, theirs::andrews::andrews);
    let input = [8.0, -40.0, 5.0, 20.0, 1.0, 2.0, 0.3];
    let arm = panda::Model::new(&panda::Params { friction: 0.0, ..Default::default() });
    let example = theirs::panda::panda::Model::<f64>::default();
    let theirs = accelerations(&example, &theirs::panda::panda::Input { torque: input });
    same("panda", &accelerations(&arm, &panda::Input { torque: input }), &theirs);
}

#[test]
fn double_pendulum_with_friction() {
    let mut start = double_pendulum::State::default();
    (start.q.shoulder, start.q.elbow) = (1.2, 0.8);
    balance!(double_pendulum, start, |_| (), 1e-3, 5000);
}

#[test]
fn pushed_cart() {
    let start = cart_pole::State { q: cart_pole::Position { track: 0.0, hinge: 3.0 }, ..Default::default() };
    let push = |t: f64| cart_pole::Input { push: 3.0 * (2.5 * t).sin() };
    balance!(cart_pole, start, push, 1e-3, 5000);
}

#[test]
fn linkages() {
    let mut start = four_bar::State::default();
    start.q.drive_shaft = 0.8;
    let torque = |t: f64| four_bar::Input { torque: 20.0 + 15.0 * t.cos() };
    balance!(four_bar, start, torque, 5e-4, 6000);
    let mut start = slider_crank::State::default();
    (start.q.shaft, start.v.shaft) = (0.1, 40.0);
    let gas = |t: f64| slider_crank::Input { gas: if (40.0 * t).sin() > 0.0 { 500.0 } else { 50.0 } };
    balance!(slider_crank, start, gas, 5e-5, 10_000);
}

#[test]
fn arm_with_seven_motors_and_friction() {
    let mut start = panda::State::default();
    (start.q.q2, start.q.q4, start.v.q1) = (-0.5, -2.0, 0.5);
    let torque = |t: f64| panda::Input { torque: [8.0, -40.0, 5.0, 20.0, 1.0, 2.0, 0.3].map(|x| x * (1.0 + t).cos()) };
    balance!(panda, start, torque, 2.5e-4, 2000);
}

/// Its loops keep their equations, which are differentiated twice: a projection after every step, to where an iteration
/// changes nothing, holds the positions and velocities on them.
#[test]
fn squeezer() {
    let start = andrews::State::<f64> { q: SVector::<f64, 7>::from(ANDREWS).into(), ..Default::default() };
    let model = andrews::Model::<f64>::default();
    let start = Projection::default().project(&model, 0.0, &start).unwrap().state;
    balance!(andrews, start, |_| (), 2e-6, 10_000, |model, t, state| {
        Projection::default().project(model, t, &state).unwrap().state
    });
}

/// [rad] beta, theta, gamma, delta, phi, epsilon, omega at the start (Hairer and Wanner, volume II, section VII.7)
const ANDREWS: [f64; 7] = [
    -0.06171389001427645,
    0.0,
    0.45527981916307038,
    0.4873649795438425,
    0.22266839016588588,
    1.2305474445498212,
    -0.22266839016588588,
];

#[test]
fn platform_on_six_motors_and_springs() {
    let mut start = stewart::State::default();
    start.q.platform.position = Vector3::new(-1.5, 0.1, 1.2);
    start.q.platform.orientation = RollPitchYaw { roll: 0.1, pitch: -0.05, yaw: 0.2 };
    let push = |t: f64| {
        let mut input = stewart::Input::default();
        for (k, leg) in input.legs.iter_mut().enumerate() {
            leg.thrust = 4.0 + (3.0 * t + k as f64).sin();
        }
        input
    };
    balance!(stewart, start, push, 5e-4, 1000);
}

/// Its links are stiff: steps resolve their motion.
#[test]
fn stiff_governor() {
    let y: [f64; 8] = array(&list(&read("motion/governor")["points"])[0]["y"]);
    let halves = [0, 4].map(|from| SVector::<f64, 4>::from_fn(|k, _| y[from + k]));
    let start = governor::State { q: halves[0].into(), v: halves[1].into() };
    balance!(governor, start, |_| (), 1e-6, 100_000);
}

#[test]
fn friction_and_a_bushing() {
    let mut start = block::State::default();
    start.v.slide = 2.0;
    balance!(block, start, |_| (), 2.5e-5, 40_000);
    let mut start = mount::State::default();
    start.q.free.position = Vector3::new(0.01, -0.02, 0.015);
    start.q.free.orientation = RollPitchYaw { roll: 0.2, pitch: -0.1, yaw: 0.3 };
    start.v.free.position = Vector3::new(0.3, 0.1, -0.2);
    balance!(mount, start, |_| (), 2.5e-4, 4000);
}
