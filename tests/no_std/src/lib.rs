//! Generated models and integrators in a crate without std, without `unsafe`, with every warning an error.

#![no_std]
#![forbid(unsafe_code)]
#![deny(warnings, missing_docs, clippy::all)]

use multibody::impact::{Impact, ImpactError, impact};
use multibody::integrators::{Action, Direction, Event, Events};
use multibody::{
    DormandPrince, Equilibrium, EquilibriumError, GaussLegendre4, IntegrationError, Integrator, Radau, Rk4,
    SemiImplicitEuler, Statistics, equilibrium, multibody,
};

multibody! {
    /// Planar double pendulum with adjustable lengths.
    pub mod double_pendulum {
        /// [m/s^2] gravity
        const G = 9.81;
        /// [kg] upper rod
        param m1 = 1.0;
        /// [kg] lower rod
        param m2 = 1.0;
        /// [m] upper rod
        param l1 = 1.0;
        param l2 = 1.0;
        /// [N m] of the motor at the elbow
        input torque;
        world { gravity: -G * Y }
        body upper { mass: m1, com: -0.5 * l1 * Y, inertia: rod(m1, l1, Y) }
        body lower { mass: m2, com: -0.5 * l2 * Y, inertia: rod(m2, l2, Y) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-l1 * Y), child: lower, axis: Z }
        force motor: Effort { joint: elbow, value: torque }
        output tip: Vec3 = lower.at(-l2 * Y).position;
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// A free body with a filter of its own.
    pub mod satellite {
        input thrust: Vec3;
        state filtered: rate = 5.0 * (thrust.x - filtered), start: 0.0;
        body hull { mass: 4.0, com: 0.1 * X, inertia: diag(0.3, 0.4, 0.5) }
        joint free: Free { parent: ground, child: hull }
        force engine: Force { at: hull.at(-0.5 * X), value: [filtered, thrust.y, thrust.z], axes: hull }
        output pose = hull.pose;
        output reach = norm(hull.position);
        emit forward_dynamics, energy;
    }
}

/// One sample of a controller at 1 kHz: a plant model in single precision.
pub fn step(
    model: &double_pendulum::Model<f32>,
    state: &double_pendulum::State<f32>,
    torque: f32,
) -> double_pendulum::State<f32> {
    Rk4::step(model, 0.0, state, &double_pendulum::Input { torque }, 1e-3)
}

/// The torque that a motion needs.
pub fn torque(
    model: &double_pendulum::Model<f32>,
    state: &double_pendulum::State<f32>,
    accel: &double_pendulum::Velocity<f32>,
) -> double_pendulum::Velocity<f32> {
    model.inverse_dynamics(0.0, state, &double_pendulum::Input { torque: 0.0 }, accel)
}

/// A model with values of the user's own, if they make sense.
pub fn model(m2: f32) -> Option<double_pendulum::Model<f32>> {
    let params = double_pendulum::Params { m2, ..Default::default() };
    params.check().ok()?;
    Some(double_pendulum::Model::new(&params))
}

/// Everything that a state says.
pub fn outputs(
    model: &double_pendulum::Model<f32>,
    state: &double_pendulum::State<f32>,
) -> double_pendulum::Output<f32> {
    model.outputs(0.0, state, &double_pendulum::Input { torque: 0.0 })
}

/// A free body over one second, in double precision.
pub fn orbit(state: &satellite::State) -> Result<satellite::State, IntegrationError> {
    let model = satellite::Model::new(&satellite::Params::default());
    let state = DormandPrince::integrate(&model, 0.0, state, &satellite::Input::default(), 0.01, 100, |_, _| ())?;
    Ok(SemiImplicitEuler::step(&model, 1.0, &state, &satellite::Input::default(), 1e-3))
}

/// The same with steps chosen by error.
pub fn adaptive(state: &satellite::State) -> Result<(satellite::State, Statistics), IntegrationError> {
    let model = satellite::Model::new(&satellite::Params::default());
    Integrator::adaptive(DormandPrince, 1e-6, 1e-9).integrate(
        &model,
        0.0,
        1.0,
        state,
        &satellite::Input::default(),
        |_, _| (),
    )
}

multibody! {
    /// A pendulum with a damped spring and a motor at its hinge.
    pub mod flap {
        /// [N m] of the motor
        input torque;
        world { gravity: -9.81 * Y }
        body rod { mass: 2.0, com: -0.5 * Y, inertia: rod(2.0, 1.0, Y) }
        joint hinge: Revolute { parent: ground, child: rod, axis: Z }
        force motor: Effort { joint: hinge, value: torque - 40.0 * hinge - 3.0 * hinge.rate }
        emit forward_dynamics, derivatives, impulse;
    }
}

/// A flap over one second, by an implicit method with steps chosen by error.
pub fn stiff(state: &flap::State<f32>, torque: f32) -> Result<(flap::State<f32>, Statistics), IntegrationError> {
    let model = flap::Model::<f32>::default();
    Integrator::adaptive(Radau, 1e-4, 1e-4).integrate(&model, 0.0, 1.0, state, &flap::Input { torque }, |_, _| ())
}

/// The same with a method of Gauss in equal steps.
pub fn gauss(state: &flap::State, torque: f64) -> Result<(flap::State, Statistics), IntegrationError> {
    let model = flap::Model::<f64>::default();
    let integrator = Integrator::fixed(GaussLegendre4, 0.01).compensated();
    integrator.integrate(&model, 0.0, 1.0, state, &flap::Input { torque }, |_, _| ())
}

/// Where a flap rests.
pub fn rest(state: &flap::State, torque: f64) -> Result<Equilibrium<flap::State>, EquilibriumError> {
    let model = flap::Model::<f64>::default();
    equilibrium(&model, 0.0, state, &flap::Input { torque }, &flap::Velocity { hinge: 1.0 })
}

/// What happens where a flap meets a stop.
pub fn struck(state: &flap::State) -> Result<Impact<flap::State>, ImpactError> {
    impact(&flap::Model::<f64>::default(), 0.0, state, &flap::Velocity { hinge: 1.0 }, 0.5)
}

/// A stop that a flap meets where it hangs.
#[derive(Debug)]
pub struct Stop;

impl Events<flap::Model, 1> for Stop {
    fn values(&self, _t: f64, state: &flap::State) -> [f64; 1] {
        [state.q.hinge]
    }
    fn direction(&self, _index: usize) -> Direction {
        Direction::Falling
    }
    fn happened(&mut self, _event: &Event, state: &flap::State) -> Action<flap::State> {
        struck(state).map_or(Action::Stop, |hit| Action::Jump(hit.state))
    }
}

/// A flap that falls against the stop.
pub fn bounces(state: &flap::State) -> Result<(flap::State, Statistics, f64), IntegrationError> {
    let model = flap::Model::<f64>::default();
    let integrator = Integrator::adaptive(DormandPrince, 1e-8, 1e-8);
    integrator.with_events(&model, 0.0, 1.0, state, &flap::Input { torque: 0.0 }, &mut Stop, |_| ())
}
