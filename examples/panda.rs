//! The seven-joint arm Panda: torques along a trajectory, computed-torque control, energy, counts and times.
//!
//! `cargo run --release --example panda`

use std::hint::black_box;
use std::time::Instant;

use multibody::nalgebra::SVector;
use multibody::simba::simd::WideF64x4;
use multibody::{IntegrationError, Real, Rk4, StateSpace, System};

#[path = "models/panda.rs"]
mod model;

use model::panda::{self, Input, Model, Params, Position, State, Velocity};

type Joints = SVector<f64, 7>;

fn main() -> Result<(), IntegrationError> {
    along_the_trajectory();
    under_control()?;
    operations();
    times();
    Ok(())
}

// The trajectory: from pose to pose, starting and ending each piece at rest.

/// [rad]
const POSES: [[f64; 7]; 5] = [
    [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785],
    [0.9, 0.2, -0.5, -1.7, 0.6, 2.2, -0.4],
    [-0.4, 0.7, 0.8, -1.1, -0.9, 1.4, 1.2],
    [-1.2, -0.3, 0.3, -2.2, 0.5, 2.6, 0.2],
    [0.3, -0.1, 0.2, -0.6, 0.0, 2.0, 0.785],
];
/// [s] for each piece
const PIECE: f64 = 1.25;
/// [s]
const DURATION: f64 = PIECE * (POSES.len() - 1) as f64;

/// Positions, velocities and accelerations at a time: quintics without velocity or acceleration at the poses.
fn reference(t: f64) -> [Joints; 3] {
    let number = ((t / PIECE) as usize).min(POSES.len() - 2);
    let (from, to) = (Joints::from(POSES[number]), Joints::from(POSES[number + 1]));
    let s = (t / PIECE - number as f64).min(1.0);
    let (way, by_s, by_s_twice) = (
        s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s),
        30.0 * s * s * (1.0 - s).powi(2),
        60.0 * s * (1.0 - s) * (1.0 - 2.0 * s),
    );
    [from + (to - from) * way, (to - from) * (by_s / PIECE), (to - from) * (by_s_twice / PIECE.powi(2))]
}

fn along_the_trajectory() {
    println!("Torques along the trajectory, by inverse dynamics [N m]:\n");
    println!("  t [s]   motor 1       2       3       4       5       6       7      tool centre point [m]");
    let model = Model::<f64>::default();
    for k in 0..=8 {
        let t = DURATION * f64::from(k) / 8.0;
        let [q, v, a] = reference(t);
        let state = State { q: q.into(), v: v.into() };
        let torque: Joints = model.inverse_dynamics(t, &state, &Input::default(), &a.into()).into();
        let tip = model.outputs(t, &state, &Input { torque: torque.into() }).tip;
        print!("  {t:>5.3} ");
        torque.iter().for_each(|torque| print!(" {torque:>7.2}"));
        println!("    ({:>6.3}, {:>6.3}, {:>6.3})", tip.x, tip.y, tip.z);
    }
}

// Computed-torque control: inverse dynamics of what the controller believes, around the arm as it is.

/// The arm and the work that its motors have done.
#[derive(Clone, Copy)]
struct Run {
    arm: State,
    /// [J]
    work: f64,
}

impl StateSpace for Run {
    type Scalar = f64;
    type Position = Position;
    type Velocity = Velocity;
    type Extra = f64;
    fn split(&self) -> (Position, Velocity, f64) {
        (self.arm.q, self.arm.v, self.work)
    }
    fn join(&self, q: Position, v: Velocity, work: f64) -> Self {
        Self { arm: State { q, v }, work }
    }
}

struct Controlled {
    plant: Model,
    belief: Model,
}

impl Controlled {
    /// [N m] follows the reference; errors decay like a critically damped oscillator of 40 rad/s.
    fn torque(&self, t: f64, arm: &State) -> Joints {
        let [q, v, a] = reference(t);
        let (frequency, real_q, real_v) = (40.0, Joints::from(arm.q), Joints::from(arm.v));
        let accel = a + (v - real_v) * (2.0 * frequency) + (q - real_q) * (frequency * frequency);
        self.belief.inverse_dynamics(t, arm, &Input::default(), &accel.into()).into()
    }
}

impl System for Controlled {
    type Scalar = f64;
    type State = Run;
    type Input = ();
    fn derivative(&self, t: f64, run: &Run, (): &()) -> (Velocity, f64) {
        let torque = self.torque(t, &run.arm);
        let power = torque.dot(&run.arm.v.into());
        (self.plant.forward_dynamics(t, &run.arm, &Input { torque: torque.into() }), power)
    }
    fn position_rates(&self, _t: f64, run: &Run) -> Velocity {
        run.arm.v
    }
}

fn under_control() -> Result<(), IntegrationError> {
    println!("\nComputed-torque control for {DURATION} s, Runge-Kutta at 1 ms:\n");
    println!("  payload, unknown to it   largest error   final error   work of motors   change of energy   balance");
    for payload in [0.0, 0.5, 3.0] {
        let plant = Model::new(&Params { payload });
        let system = Controlled { plant, belief: Model::default() };
        let [q, v, _] = reference(0.0);
        let start = Run { arm: State { q: q.into(), v: v.into() }, work: 0.0 };
        let error = |t: f64, run: &Run| (Joints::from(run.arm.q) - reference(t)[0]).amax();
        let mut largest = 0.0_f64;
        let watch = |t: f64, run: &Run| largest = largest.max(error(t, run));
        let end = Rk4::integrate(&system, 0.0, &start, &(), 1e-3, (DURATION * 1000.0) as u32, watch)?;
        let energy = |run: &Run| plant.outputs(0.0, &run.arm, &Input::default()).energy;
        let (change, last) = (energy(&end) - energy(&start), error(DURATION, &end));
        println!(
            "  {payload:>4.1} kg {largest:>26.1e} rad {last:>9.1e} rad {:>14.6} J {change:>16.6} J {:>9.0e} J",
            end.work,
            end.work - change,
        );
    }
    Ok(())
}

// What it costs.

fn operations() {
    println!("\nOperations of the generated functions; `new` runs once, for the parameter:\n");
    println!("  {:<18}{:>5}{:>6}{:>5}{:>6}{:>8}", "", "add", "mul", "div", "sqrt", "sincos");
    for cost in panda::COSTS {
        let multibody::Cost { function, add, mul, div, sqrt, sincos, .. } = cost;
        println!("  {function:<18}{add:>5}{mul:>6}{div:>5}{sqrt:>6}{sincos:>8}");
    }
}

fn times() {
    println!(
        "\nTime of one evaluation, median of 31 batches [ns]; `RUSTFLAGS=-Ctarget-cpu=native` gives lanes their width:\n"
    );
    println!("  {:<18}{:>8}{:>24}", "", "f64", "in a lane of WideF64x4");
    let samples: [State; 4] = [0.3, 1.6, 2.9, 4.4].map(|t| {
        let [q, v, _] = reference(t);
        State { q: q.into(), v: v.into() }
    });
    let lanes = |of: fn(&State) -> Joints| {
        let columns = samples.each_ref().map(of);
        SVector::<WideF64x4, 7>::from_fn(|row, _| WideF64x4::from(columns.map(|column| column[row])))
    };
    let wide = State { q: lanes(|x| x.q.into()).into(), v: lanes(|x| x.v.into()).into() };
    let functions = times_of(&samples[0]).into_iter().zip(times_of(&wide));
    for ((name, one), (_, four)) in functions {
        println!("  {name:<18}{one:>8.1}{:>24.1}", four / 4.0);
    }
}

/// [ns] of the three functions with one kind of scalar.
fn times_of<T: Real>(state: &State<T>) -> [(&'static str, f64); 3] {
    // On the heap: beside a function's own values on the stack, arguments can slow down its memory accesses.
    let all = Box::new((Model::<T>::default(), *state, Input::default(), T::lit(0.0)));
    let arguments = || black_box(&*all);
    let inverse = || {
        let (model, state, input, t) = arguments();
        model.inverse_dynamics(*t, state, input, &state.v)
    };
    let mass = || {
        let (model, state, ..) = arguments();
        model.mass_matrix(&state.q)
    };
    let forward = || {
        let (model, state, input, t) = arguments();
        model.forward_dynamics(*t, state, input)
    };
    [("inverse_dynamics", time(inverse)), ("mass_matrix", time(mass)), ("forward_dynamics", time(forward))]
}

/// [ns] a call, median of batches.
fn time<R>(mut call: impl FnMut() -> R) -> f64 {
    const CALLS: u32 = 20_000;
    let mut batches: Vec<f64> = (0..31)
        .map(|_| {
            let start = Instant::now();
            for _ in 0..CALLS {
                black_box(call());
            }
            start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
        })
        .collect();
    batches.sort_by(f64::total_cmp);
    batches[batches.len() / 2]
}
