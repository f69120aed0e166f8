//! Tyres.

use multibody::multibody;

use super::{after, close};

multibody! {
    use multibody_parts::{linear_tyre, magic_tyre};

    /// A car of one track on the plane, which is pushed along so that it keeps its speed.
    pub mod car {
        /// [rad]
        param steer = 1e-3;
        body frame { mass: 1400, inertia: diag(500, 2000, 2400) }
        joint plane: Planar { parent: ground, child: frame, axis: Z }
        part front: linear_tyre { carrier: frame.at(1.1 * X).rotated(Z, steer), stiffness: 7e4, passage: 1e-3 };
        part rear: linear_tyre { carrier: frame.at(-1.6 * X), stiffness: 1.2e5, passage: 1e-3 };
        let ahead = frame.express(frame.velocity).x;
        force drive: Force { at: frame, value: [1e4 * (20 - ahead), 0, 0], axes: frame }
        output yaw_rate = frame.angular_velocity.z;
    }

    /// A sledge on one tyre that is drawn askew.
    pub mod sledge {
        body frame { mass: 1, inertia: diag(1, 1, 1) }
        joint plane: Planar { parent: ground, child: frame, axis: Z }
        part tyre: magic_tyre { carrier: frame, load: 4000, friction: 0.9, stiffness: 11, shape: 1.4, curvature: -0.6, passage: 1e-9 };
        output side = tyre.side;
    }
}

/// Steady cornering of the linear car: r = V s / (L + K V^2), K = m (b Cr - a Cf) / (L Cf Cr).
#[test]
fn a_linear_car_corners_as_its_gradient_says() {
    let model = car::Model::<f64>::default();
    let mut x = car::State::default();
    x.v.plane.x = 20.0;
    let end = after(&model, &x, &(), 6.0, 12_000);
    let (a, b, front, rear) = (1.1, 1.6, 7e4, 1.2e5);
    let gradient = 1400.0 * (b * rear - a * front) / ((a + b) * front * rear);
    let wanted = 20.0 * 1e-3 / (a + b + gradient * 400.0);
    close("yaw rate", model.outputs(0.0, &end, &()).yaw_rate, wanted, 2e-5);
}

/// The formula's slope at zero is B C D, its greatest value D.
#[test]
fn the_magic_formula_has_its_slope_and_its_peak() {
    let model = sledge::Model::<f64>::default();
    let side = |slip: f64| {
        let mut x = sledge::State::default();
        (x.v.plane.x, x.v.plane.y) = (17.0, 17.0 * slip.tan());
        model.outputs(0.0, &x, &()).side
    };
    let peak = 0.9 * 4000.0;
    close("slope", side(1e-7) / 1e-7, -11.0 * 1.4 * peak, 1e-6);
    let greatest = (1..3000).map(|k| -side(1e-4 * f64::from(k))).fold(0.0, f64::max);
    close("peak", greatest, peak, 1e-6);
    assert!(-side(0.3) < 0.999 * peak);
}
