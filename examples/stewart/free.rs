//! A free motion: the plate on six springs with dampers, in two formulations.

use multibody::nalgebra::SVector;
use multibody::{Constrained, DormandPrince, ExtraOf, Margin, Projection, StateSpace, System, VelocityOf};

use crate::models::{hybrid, reduced};

/// [N] along a leg: a preload, a spring from the stroke of 0.262 m, and a damper.
fn thrust(stroke: f64, rate: f64) -> f64 {
    7.2 - 200.0 * (stroke - 0.262) - 5.0 * rate
}

/// Pose after one second, by an integration in quadruple precision of other equations.
const AFTER_A_SECOND: [f64; 6] = [
    -1.5000157984802573,
    0.001441516011428508,
    0.9942417244729724,
    -0.005449903684894745,
    0.004782482915867984,
    -1.3520691462194171e-5,
];
/// [s]
const STEP: f64 = 1e-3;

/// The closed form and the work that the legs have done.
#[derive(Clone, Copy)]
struct Run {
    plate: reduced::State,
    /// [J]
    work: f64,
}

impl StateSpace for Run {
    type Scalar = f64;
    type Position = reduced::Position;
    type Velocity = reduced::Velocity;
    type Extra = f64;
    fn split(&self) -> (reduced::Position, reduced::Velocity, f64) {
        (self.plate.q, self.plate.v, self.work)
    }
    fn join(&self, q: reduced::Position, v: reduced::Velocity, work: f64) -> Self {
        Self { plate: reduced::State { q, v }, work }
    }
}

/// The plate on its legs; the pose is all there is, strokes follow from it.
struct Sprung(reduced::Model);

impl System for Sprung {
    type Scalar = f64;
    type State = Run;
    type Input = ();
    fn derivative(&self, t: f64, run: &Run, (): &()) -> (reduced::Velocity, f64) {
        let legs = self.0.kinematics(t, &run.plate, &reduced::Velocity::default());
        let mut input = reduced::Input::default();
        let mut power = 0.0;
        for (leg, (stroke, rate)) in input.legs.iter_mut().zip(legs.position.iter().zip(&legs.velocity)) {
            leg.thrust = thrust(*stroke, *rate);
            power += leg.thrust * rate;
        }
        (self.0.forward_dynamics(t, &run.plate, &input), power)
    }
    fn position_rates(&self, _t: f64, run: &Run) -> reduced::Velocity {
        run.plate.v
    }
    /// A wrapper hands on what integrators ask of loops.
    fn margins(&self, t: f64, run: &Run, (): &(), visit: &mut dyn FnMut(Margin<f64>)) -> f64 {
        System::margins(&self.0, t, &run.plate, &reduced::Input::default(), visit)
    }
}

/// The same with all 24 coordinates and 18 multipliers.
struct Constraint(hybrid::Model);

impl System for Constraint {
    type Scalar = f64;
    type State = hybrid::State;
    type Input = ();
    fn derivative(&self, t: f64, state: &hybrid::State, (): &()) -> (VelocityOf<Self>, ExtraOf<Self>) {
        let mut input = hybrid::Input::default();
        for (k, leg) in input.legs.iter_mut().enumerate() {
            leg.thrust = thrust(state.q.legs[k].stroke, state.v.legs[k].stroke);
        }
        self.0.derivative(t, state, &input)
    }
    fn position_rates(&self, _t: f64, state: &hybrid::State) -> VelocityOf<Self> {
        state.v
    }
}

pub(crate) fn run() -> Result<(), Box<dyn std::error::Error>> {
    println!("The plate let go on six springs with dampers, Dormand and Prince's method at {} ms:\n", STEP * 1e3);
    let model = reduced::Model::<f64>::default();
    let mut start = Run { plate: reduced::State::default(), work: 0.0 };
    start.plate.q = SVector::from([-1.45, 0.05, 1.05, 0.1, -0.05, 0.15]).into();
    start.plate.v = SVector::from([0.3, -0.2, 0.4, 0.5, -0.4, 0.3]).into();
    let energy = |run: &Run| model.outputs(0.0, &run.plate, &reduced::Input::default()).energy;
    println!("  t [s]       x        y        z [m]   roll   pitch     yaw [rad]   energy [J]   less work [J]");
    let mut now = start;
    let mut second = start;
    let mut time = 0.0;
    for until in [0.0, 0.25, 0.5, 1.0, 2.0, 4.0] {
        let steps = ((until - time) / STEP).round() as u32;
        now = DormandPrince::integrate(&Sprung(model), time, &now, &(), STEP, steps, |_, _| ())?;
        time = until;
        if until == 1.0 {
            second = now;
        }
        let pose: SVector<f64, 6> = now.plate.q.into();
        print!("  {until:>5.2} ");
        pose.iter().for_each(|number| print!(" {number:>8.4}"));
        println!("{:>15.6}{:>16.12}", energy(&now), energy(&now) - now.work);
    }
    let pose: SVector<f64, 6> = second.plate.q.into();
    let error = (pose - SVector::from(AFTER_A_SECOND)).amax();
    println!("\n  after 1 s: {error:.0e} from the reference; there are no loops left that could open");

    let plain = Constraint(hybrid::Model::default());
    let legs = model.kinematics_2(0.0, &start.plate, &reduced::Velocity::default());
    let mut from = hybrid::State::default();
    (from.q.platform, from.v.platform) = (start.plate.q.platform, start.plate.v.platform);
    for k in 0..6 {
        let pick = |list: &SVector<f64, 18>| [list[2 * k], list[2 * k + 1], list[12 + k]];
        let put = |leg: &mut hybrid::leg::Position, list: &SVector<f64, 18>| {
            [leg.gimbal.first, leg.gimbal.second, leg.stroke] = pick(list);
        };
        put(&mut from.q.legs[k], &legs.position);
        let [first, second, stroke] = pick(&legs.velocity);
        (from.v.legs[k].gimbal.first, from.v.legs[k].gimbal.second, from.v.legs[k].stroke) = (first, second, stroke);
    }
    let open = |state: &hybrid::State| Constrained::constraints(&plain.0, 1.0, &state.q).amax();
    let from_reference = |state: &hybrid::State| {
        let pose = SVector::<f64, 6>::from(reduced::Position { platform: state.q.platform });
        (pose - SVector::from(AFTER_A_SECOND)).amax()
    };
    let drifted = DormandPrince::integrate(&plain, 0.0, &from, &(), STEP, 1000, |_, _| ())?;
    let mut held = from;
    let projection = Projection::default();
    for k in 0..1000_u32 {
        let t = f64::from(k) * STEP;
        held = DormandPrince::step(&plain, t, &held, &(), STEP);
        held = projection.project(&plain.0, t + STEP, &held)?.state;
    }
    for (name, state) in [("multipliers", drifted), ("multipliers, projected", held)] {
        println!("  {name}: {:.0e} from the reference; loops open by {:.0e} m", from_reference(&state), open(&state));
    }
    Ok(())
}
