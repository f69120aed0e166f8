//! Blades and wheels that a state of the user's own steers, beside the same whose course is written as a function of time.

use multibody::{Dop853, Integrator, Projection, Radau, WithProjection, multibody};

use super::speeds::{derivatives_are_slopes, with_rates};

/// A car with one wheel ahead, on an oblique plane, with its centre of mass beside the line between its wheels.
macro_rules! cars {
    ($($name:ident: { $($steer:tt)* } { $($more:tt)* })*) => {
        multibody! { $(
            mod $name {
                /// [m]
                param base = 0.73;
                /// [s]
                param lag = 0.41;
                /// [rad]
                param wish = 0.9;
                world { gravity: [0.4, -0.3, -9.7] }
                body car { mass: 1.3, com: [0.31, 0.07, 0.02], inertia: inertia(0.1, 0.2, 0.25, 0.01, 0.02, -0.01) }
                joint plane: Planar { parent: ground.rotated([1, 2, 2], 0.04), child: car, axis: Z }
                $($steer)*
                let along = car.express(car.velocity).x;
                let aside = car.express(car.velocity).y;
                constraint rear = aside;
                constraint front = cos(steer) * (aside + base * plane.angle.rate) - sin(steer) * along;
                force push: Force { at: car.at([0.1, 0.2, 0.0]), value: [1.7, 0.0, 0.0], axes: car }
                output heading = plane.angle;
                output place = car.position;
                output speed = along;
                output accel = car.acceleration;
                $($more)*
            }
        )* }
    };
}

cars! {
    held: { state steer: rate = (wish - steer) / lag, start: -0.2; }
        { formulation { constraints: Multipliers } emit forward_dynamics, constraints, derivatives; }
    reduced: { state steer: rate = (wish - steer) / lag, start: -0.2; }
        { formulation { constraints: Reduced, independent: [plane.x] } emit forward_dynamics, derivatives, mass_matrix, bias, inverse_dynamics; }
    chosen: { state steer: rate = (wish - steer) / lag, start: -0.2; }
        { speed forward = along; formulation { constraints: Reduced } emit forward_dynamics, derivatives; }
    timed: { let steer = wish - (wish + 0.2) * exp(-t / lag); }
        { speed forward = along; formulation { constraints: Reduced } emit forward_dynamics; }
}

/// What a car is at in the end.
macro_rules! end {
    ($name:ident, $until:expr, $method:expr, $tolerance:expr, $wrap:expr) => {{
        let model = $name::Model::<f64>::default();
        let mut start = $name::State::<f64>::default();
        start.q.plane.angle = HEADING;
        let rates = [SPEED * HEADING.cos(), SPEED * HEADING.sin(), SPEED * (-0.2_f64).tan() / 0.73];
        let start = with_rates(&model, 0.0, &start, &rates);
        let system = $wrap(model);
        let integrator = Integrator::adaptive($method, $tolerance, $tolerance);
        let (end, _) = integrator.integrate(&system, 0.0, $until, &start, &(), |_, _| ()).unwrap();
        let out = model.outputs($until, &end, &());
        [out.heading, out.place.x, out.place.y, out.place.z, out.speed, out.accel.x, out.accel.y, out.accel.z]
    }};
}

const HEADING: f64 = 0.4;
const SPEED: f64 = 1.1;

/// A lag's course is known: the state follows it, so both cars go the same way, by whatever equations and method.
#[test]
fn a_car_that_is_steered() {
    let apart = |a: [f64; 8], b: [f64; 8]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let wanted = end!(timed, 2.0, Dop853, 1e-13, |model| model);
    assert!((wanted[0] - HEADING).abs() > 1.0 && (wanted[4] - SPEED).abs() > 0.3, "{wanted:?}");
    let projected = |model| WithProjection::new(model, Projection::default());
    for found in [end!(held, 2.0, Dop853, 1e-13, projected), end!(chosen, 2.0, Dop853, 1e-13, |model| model)] {
        assert!(apart(found, wanted) < 1e-10, "{:e}: {found:?} {wanted:?}", apart(found, wanted));
    }
    // An implicit method takes slopes by the state too.
    let found = end!(chosen, 2.0, Radau, 1e-11, |model| model);
    assert!(apart(found, wanted) < 1e-8, "{:e}", apart(found, wanted));
    // A rate along a fixed axis tells nothing any more where the car heads across it, from 0.9 s on.
    let wanted = end!(timed, 0.7, Dop853, 1e-13, |model| model);
    let found = end!(reduced, 0.7, Dop853, 1e-13, |model| model);
    assert!(apart(found, wanted) < 1e-10, "{:e}: {found:?} {wanted:?}", apart(found, wanted));
}

#[test]
fn derivatives_by_what_steers() {
    macro_rules! check {
        ($name:ident) => {
            let model = $name::Model::<f64>::default();
            for k in 0..5 {
                let x = f64::from(k);
                let mut state = $name::State::<f64>::default();
                state.q.plane.angle = 1.3 * x - 2.0;
                state.x.steer = 0.7 * (1.7 * x).sin();
                let (sin, cos) = state.q.plane.angle.sin_cos();
                let state = with_rates(&model, 0.3, &state, &[0.9 * cos, 0.9 * sin, 0.9 * state.x.steer.tan() / 0.73]);
                derivatives_are_slopes(&model, 0.3, &state, &());
            }
        };
    }
    check!(reduced);
    check!(chosen);
}
