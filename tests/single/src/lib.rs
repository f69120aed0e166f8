//! Steps of generated models in single precision: `tests/generated/single_precision.rs` reads the assembly that they become.
//!
//! Sines and cosines are calls of the platform's library, and what they compute in is its own affair.

#![forbid(unsafe_code)]
#![deny(warnings)]

use multibody::{
    AssemblyError, Composition4, Composition6, Dop853, DormandPrince, Euler, GaussLegendre4, GaussLegendre6,
    GeneralisedAlpha, ImplicitMidpoint, IntegrationError, Integrator, Projection, ProjectionError, Radau, Rk4,
    SemiImplicitEuler, SymplecticGauss6, SymplecticMidpoint, Verlet, assemble, multibody,
};

multibody! {
    /// A pendulum with adjustable length: constant mass matrix.
    pub mod pendulum {
        param g = 9.81;
        param l = 1.0;
        world { gravity: -g * Y }
        body bob { mass: 1.3, com: -l * Y, inertia: rod(1.3, l, Y) }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        emit forward_dynamics;
    }
}

multibody! {
    /// Planar double pendulum with damping and a motor.
    pub mod double_pendulum {
        param m1 = 1.1;
        param m2 = 0.7;
        param l1 = 1.3;
        param l2 = 0.9;
        input torque;
        world { gravity: -9.81 * Y }
        body upper { mass: m1, com: -0.5 * l1 * Y, inertia: rod(m1, l1, Y) }
        body lower { mass: m2, com: -0.5 * l2 * Y, inertia: rod(m2, l2, Y) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-l1 * Y), child: lower, axis: Z }
        force motor: Effort { joint: elbow, value: torque - 0.013 * elbow.rate }
        emit forward_dynamics, inverse_dynamics, momentum, derivatives;
    }
}

multibody! {
    /// A free body under thrust: quaternions and a state of its own.
    pub mod satellite {
        input thrust: Vec3;
        state filtered: rate = 5.0 * (thrust.x - filtered), start: 0.0;
        body hull { mass: 4.0, com: 0.1 * X, inertia: diag(0.3, 0.4, 0.5) }
        joint free: Free { parent: ground, child: hull }
        force engine: Force { at: hull.at(-0.5 * X), value: [filtered, thrust.y, thrust.z], axes: hull }
        emit forward_dynamics;
    }
}

multibody! {
    /// A four-bar whose loop stays open to drift.
    pub mod linkage {
        world { gravity: -9.81 * Y }
        body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body coupler { mass: 2.0, com: X, inertia: rod(2.0, 2.0, X) }
        body rocker { mass: 1.5, com: 0.75 * X, inertia: rod(1.5, 1.5, X) }
        joint shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint knee: Revolute { parent: crank.at(X), child: coupler, axis: Z }
        joint pivot: Revolute { parent: ground.at(2 * X), child: rocker, axis: Z }
        #[cut]
        joint pin: Revolute { parent: coupler.at(2 * X), child: rocker.at(1.5 * X), axis: Z }
        formulation { constraints: Multipliers }
        emit forward_dynamics, impulse;
    }
}

macro_rules! steps {
    ($($name:ident: $method:ident of $model:ident with $input:ty;)+) => {$(
        #[allow(missing_docs)]
        #[inline(never)]
        pub fn $name(
            model: &$model::Model<f32>,
            t: f32,
            state: &$model::State<f32>,
            input: &$input,
            dt: f32,
        ) -> $model::State<f32> {
            $method::step(model, t, state, input, dt)
        }
    )+};
}

steps! {
    single_pendulum_verlet: Verlet of pendulum with ();
    single_pendulum_composition4: Composition4 of pendulum with ();
    single_pendulum_composition6: Composition6 of pendulum with ();
    single_pendulum_euler: Euler of pendulum with ();
    single_pendulum_rk4: Rk4 of pendulum with ();
    single_double_semi_implicit: SemiImplicitEuler of double_pendulum with double_pendulum::Input<f32>;
    single_double_rk4: Rk4 of double_pendulum with double_pendulum::Input<f32>;
    single_double_dormand_prince: DormandPrince of double_pendulum with double_pendulum::Input<f32>;
    single_double_midpoint: ImplicitMidpoint of double_pendulum with double_pendulum::Input<f32>;
    single_double_gauss4: GaussLegendre4 of double_pendulum with double_pendulum::Input<f32>;
    single_double_gauss6: GaussLegendre6 of double_pendulum with double_pendulum::Input<f32>;
    single_double_dop853: Dop853 of double_pendulum with double_pendulum::Input<f32>;
    single_double_symplectic_midpoint: SymplecticMidpoint of double_pendulum with double_pendulum::Input<f32>;
    single_double_symplectic_gauss6: SymplecticGauss6 of double_pendulum with double_pendulum::Input<f32>;
    single_satellite_rk4: Rk4 of satellite with satellite::Input<f32>;
    single_satellite_dormand_prince: DormandPrince of satellite with satellite::Input<f32>;
    single_satellite_midpoint: ImplicitMidpoint of satellite with satellite::Input<f32>;
    single_satellite_gauss6: GaussLegendre6 of satellite with satellite::Input<f32>;
}

macro_rules! controlled {
    ($($name:ident: $integrator:expr, of $model:ident with $input:ty;)+) => {$(
        #[allow(missing_docs)]
        #[inline(never)]
        pub fn $name(
            model: &$model::Model<f32>,
            end: f64,
            state: &$model::State<f32>,
            input: &$input,
        ) -> Result<$model::State<f32>, IntegrationError> {
            Ok($integrator.integrate(model, 0.0, end, state, input, |_, _| ())?.0)
        }
    )+};
}

// Times, lengths of steps and when iterations end are in double precision, whatever the scalar: what is computed with
// the state is not.
controlled! {
    controlled_double_radau: Integrator::fixed(Radau, 1e-2), of double_pendulum with double_pendulum::Input<f32>;
    controlled_double_radau_adaptive:
        Integrator::adaptive(Radau, 1e-4, 1e-4), of double_pendulum with double_pendulum::Input<f32>;
    controlled_double_alpha:
        Integrator::fixed(GeneralisedAlpha::new(0.8), 1e-2), of double_pendulum with double_pendulum::Input<f32>;
    controlled_double_adaptive:
        Integrator::adaptive(DormandPrince, 1e-4, 1e-4), of double_pendulum with double_pendulum::Input<f32>;
    controlled_satellite_adaptive: Integrator::adaptive(Dop853, 1e-4, 1e-4), of satellite with satellite::Input<f32>;
}

/// A first state.
///
/// # Errors
/// Where the search fails.
#[inline(never)]
pub fn closed_linkage_assembled(
    model: &linkage::Model<f32>,
    state: &linkage::State<f32>,
    free: &linkage::Velocity<f32>,
) -> Result<linkage::State<f32>, AssemblyError> {
    Ok(assemble(model, 0.0, state, free)?.state)
}

/// A state brought back.
///
/// # Errors
/// Where it is too far.
#[inline(never)]
pub fn closed_linkage_projected(
    model: &linkage::Model<f32>,
    projection: Projection,
    state: &linkage::State<f32>,
) -> Result<linkage::State<f32>, ProjectionError> {
    Ok(projection.project_by_mass(model, 0.0, state)?.state)
}

/// The model alone.
#[inline(never)]
pub fn single_double_inverse_dynamics(
    model: &double_pendulum::Model<f32>,
    state: &double_pendulum::State<f32>,
    input: &double_pendulum::Input<f32>,
    accel: &double_pendulum::Velocity<f32>,
) -> double_pendulum::Velocity<f32> {
    model.inverse_dynamics(0.0, state, input, accel)
}

/// Parameter work.
#[inline(never)]
pub fn single_double_new(params: &double_pendulum::Params<f32>) -> double_pendulum::Model<f32> {
    double_pendulum::Model::new(params)
}
