//! Generated models and integrators in a crate without std, without `unsafe`, with every warning an error.

#![no_std]
#![forbid(unsafe_code)]
#![deny(warnings, missing_docs, clippy::all)]

use multibody::{DormandPrince, IntegrationError, Integrator, Rk4, SemiImplicitEuler, Statistics, multibody};

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
