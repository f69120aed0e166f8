//! Motions that are known, along runs of all four formulations: with multipliers and reduced, in rates and in speeds.

use multibody::impact::impulse_at;
use multibody::integrators::{Action, Event, Events};
use multibody::nalgebra::{SVector, UnitQuaternion, Vector3};
use multibody::{Dop853, Free, Integrator, Projection, Tangent, WithProjection, multibody, trim};

use crate::speeds::{flat, with_rates};

four_ways!([solid_held, solid, solid_chosen, solid_beside], [x, y, turn], {
    const R = 0.2;
    /// [rad/s]
    param turning = 1.7;
    world { gravity: -9.81 * Z }
    body ball { mass: 1.3, inertia: sphere(1.3, R) }
    body ahead { mass: 0 }
    body aside { mass: 0 }
    joint x: Prismatic { parent: ground.at(R * Z), child: ahead, axis: X }
    joint y: Prismatic { parent: ahead, child: aside, axis: Y }
    joint turn: Ball { parent: aside, child: ball }
    let slip = ball.velocity + cross(ball.angular_velocity, -R * Z) - cross(turning * Z, ball.position);
    constraint along = slip.x;
    constraint across = slip.y;
    output place = ball.position;
    output twist = [ball.velocity, ball.angular_velocity];
}, {
    /// [m/s]
    speed ahead_of = ball.velocity.x + 0.3 * ball.velocity.y;
    /// [m/s]
    speed aside_of = ball.velocity.y;
    /// [rad/s]
    speed about = ball.express(ball.angular_velocity).z + 2.0 * ball.angular_velocity.z;
}, {
    /// [m/s]
    speed sliding_along = slip.x;
    /// [m/s]
    speed sliding_across = slip.y;
});

four_ways!([coin_held, coin, coin_chosen, coin_beside], [x, y, yaw, lean, spin], {
    const R = 0.25;
    world { gravity: -9.81 * Z }
    body ahead { mass: 0 }
    body aside { mass: 0 }
    body above { mass: 0 }
    body yawed { mass: 0 }
    body leaned { mass: 0 }
    body disc { mass: 0.7, inertia: diag(0.011, 0.0219, 0.011) }
    joint x: Prismatic { parent: ground, child: ahead, axis: X }
    joint y: Prismatic { parent: ahead, child: aside, axis: Y }
    joint z: Prismatic { parent: aside, child: above, axis: Z }
    joint yaw: Revolute { parent: above, child: yawed, axis: Z }
    joint lean: Revolute { parent: yawed, child: leaned, axis: X }
    joint spin: Revolute { parent: leaned, child: disc, axis: Y }
    constraint roll: Rolling { wheel: disc, axis: Y, radius: R }
    output place = disc.position;
    output twist = [disc.velocity, disc.angular_velocity];
    output angles = [yaw, lean, spin];
    output slip = roll.slip;
    output jacobian = disc.jacobian;
    output energy = kinetic() + potential();
}, {
    /// [rad/s]
    speed one = leaned.express(disc.angular_velocity).x;
    /// [rad/s]
    speed two = leaned.express(disc.angular_velocity).y + 0.2 * leaned.express(disc.angular_velocity).x;
    /// [rad/s]
    speed three = leaned.express(disc.angular_velocity).z;
}, {
    /// [m/s]
    speed by_x = disc.velocity.x;
    /// [m/s]
    speed by_y = disc.velocity.y;
    /// [m/s]
    speed by_z = disc.velocity.z;
});

/// The centre of a solid ball on a plate that turns runs on a circle at two sevenths of its rate, about a point that the start sets, and its
/// spin about the vertical stays.
#[test]
fn a_solid_ball_on_a_turning_plate() {
    let (r, turning) = (0.2, 1.7);
    let (place, velocity, about) = (Vector3::new(0.5, 0.2, r), Vector3::new(0.3, -0.2, 0.0), 0.7);
    let plane = Vector3::z().cross(&place) * turning;
    let omega = Vector3::z().cross(&(plane - velocity)) / -r + Vector3::z() * about;
    let orientation = UnitQuaternion::from_euler_angles(0.3, -0.4, 2.0);
    let own = orientation.inverse() * omega;
    let rate = 2.0 / 7.0 * turning;
    let centre = place + Vector3::z().cross(&velocity) / rate;
    macro_rules! check {
        ($name:ident, $held:tt) => {
            let model = $name::Model::<f64>::default();
            let mut start = $name::State::<f64>::default();
            (start.q.x, start.q.y, start.q.turn) = (place.x, place.y, orientation);
            let start = with_rates(&model, 0.0, &start, &[velocity.x, velocity.y, own.x, own.y, own.z]);
            let mut looked = 0;
            run!(model, $held, 0.0, 4.0, &start, &(), |t, state| {
                let out = model.outputs(t, state, &());
                let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), rate * t);
                let wanted = centre + turn * (place - centre);
                assert!((out.place - wanted).amax() < 1e-10, "{} {wanted}", out.place);
                assert!((out.twist[0] - turn * velocity).amax() < 1e-10);
                let drift = (out.twist[1].z / about - 1.0).abs();
                // Each projection rounds.
                let bound = if $held { 3e-12 } else { 1e-12 };
                assert!(drift < bound, "{} {drift:e} at {t}", stringify!($name));
                looked += 1;
            })
            .unwrap();
            assert!(looked > 5);
        };
    }
    each_way!(check: solid_held, solid, solid_chosen, solid_beside);
}

/// On its circle a disc leans as it did and heads on evenly; off it the four motions are one. Energy stays.
#[test]
fn a_disc_runs() {
    let (m, r, a, c, g, heading) = (0.7, 0.25, 0.011, 0.0219, 9.81, 2.1);
    for (lean, pushed) in [(0.6_f64, 0.0), (0.6, 0.4), (-0.3, 0.0)] {
        let (sin, cos) = lean.sin_cos();
        // See `a_disc_on_its_circle`.
        let whole = (a * heading * heading * sin * cos - m * g * r * sin) / ((c + m * r * r) * heading * cos);
        let [yaw_rate, spin_rate] = [-heading, heading * sin - whole];
        let mut ends: Vec<[f64; 6]> = Vec::new();
        macro_rules! check {
            ($name:ident, $held:tt) => {
                let model = $name::Model::<f64>::default();
                let mut start = $name::State::<f64>::default();
                (start.q.x, start.q.y, start.q.yaw, start.q.lean, start.q.spin) = (0.3, -0.4, 0.9, lean, 1.1);
                check!(@height $name, start, $held);
                let upright = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.9)
                    * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), lean);
                let axle = upright * Vector3::y();
                let omega = Vector3::z() * yaw_rate + axle * spin_rate + upright * Vector3::x() * pushed;
                let low = (axle * axle.z - Vector3::z()) * (r / cos);
                let v = low.cross(&omega);
                let mut rates = vec![v.x, v.y, v.z, yaw_rate, pushed, spin_rate];
                if !$held {
                    rates.remove(2);
                }
                let start = with_rates(&model, 0.0, &start, &rates);
                let before = model.outputs(0.0, &start, &());
                assert!((before.place.z - r * cos).abs() < 1e-14 && (before.twist[0] - v).amax() < 1e-13);
                let centre = before.place + Vector3::z().cross(&v) / yaw_rate;
                let (end, _) = run!(model, $held, 0.0, 1.5, &start, &(), |t, state| {
                    let out = model.outputs(t, state, &());
                    assert!((out.energy / before.energy - 1.0).abs() < 1e-12, "{} {}", out.energy, before.energy);
                    if pushed == 0.0 {
                        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw_rate * t);
                        assert!((out.angles[1] - lean).abs() < 1e-10, "{t}: {:e}", out.angles[1] - lean);
                        assert!((out.angles[0] - 0.9 - yaw_rate * t).abs() < 1e-10);
                        assert!((out.place - centre - turn * (before.place - centre)).amax() < 1e-10);
                    }
                })
                .unwrap();
                let out = model.outputs(1.5, &end, &());
                let [yaw, lean, spin] = out.angles;
                ends.push([out.place.x, out.place.y, out.place.z, yaw, lean, spin]);
            };
            (@height $name:ident, $start:ident, true) => {
                $start.q.z = r * cos;
            };
            (@height $name:ident, $start:ident, false) => {};
        }
        each_way!(check: coin_held, coin, coin_chosen, coin_beside);
        assert!(pushed == 0.0 || (ends[0][4] - lean).abs() > 1e-3);
        for other in &ends[1..] {
            let apart = other.iter().zip(&ends[0]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-10, "{other:?} {:?}", ends[0]);
        }
        assert_eq!(flat(&coin::Velocity::<f64>::default()).len(), 3);
    }
}

/// The steady motion of a lean and a heading is found in speeds, while place, heading and spin run, and an event tells when the heading
/// crosses zero on it.
#[test]
fn a_disc_is_trimmed() {
    struct North(Vec<f64>);
    impl Events<coin_chosen::Model<f64>, 1> for North {
        fn values(&self, _t: f64, state: &coin_chosen::State<f64>) -> [f64; 1] {
            [state.q.yaw]
        }
        fn happened(&mut self, event: &Event, _: &coin_chosen::State<f64>) -> Action<coin_chosen::State<f64>> {
            self.0.push(event.time);
            Action::Continue
        }
    }
    let model = coin_chosen::Model::<f64>::default();
    let (m, r, a, c, g) = (0.7, 0.25, 0.011, 0.0219, 9.81);
    for (lean, heading, yaw) in [(0.6_f64, 2.1, 0.9), (-0.4, 1.3, 0.5), (0.2, -3.0, -0.8)] {
        let (sin, cos) = lean.sin_cos();
        let mut guess = coin_chosen::State::<f64>::default();
        (guess.q.x, guess.q.yaw, guess.q.lean, guess.q.spin) = (0.3, yaw, lean, 4.0);
        // The whole turn along the axle is sought; across it stands the share of the heading.
        (guess.v.two, guess.v.three) = (1.0, -heading * cos);
        let mut velocity = coin_chosen::Velocity::zero();
        velocity.two = 1.0;
        let free = Free { position: coin_chosen::Rates::<f64>::zero(), velocity, states: (), input: () };
        let found = trim(&model, 0.0, &guess, &(), &free).unwrap().state;
        let whole = (a * heading * heading * sin * cos - m * g * r * sin) / ((c + m * r * r) * heading * cos);
        assert!((found.v.two + whole).abs() < 1e-10 && found.v.one == 0.0, "{} {whole}", found.v.two);
        let mut north = North(Vec::new());
        Integrator::adaptive(Dop853, 1e-13, 1e-13)
            .with_events(&model, 0.0, 1.0, &found, &(), &mut north, |_| ())
            .unwrap();
        assert!(north.0.len() == 1 && (north.0[0] - yaw / heading).abs() < 1e-9, "{:?}", north.0);
    }
}

/// A blow does the same in rates and in speeds, and leaves no slip.
#[test]
fn a_disc_is_struck() {
    let (held, beside) = (coin_held::Model::<f64>::default(), coin_beside::Model::<f64>::default());
    let mut start = coin_held::State::<f64>::default();
    (start.q.yaw, start.q.lean, start.q.spin, start.q.z) = (0.4, 0.5, 2.0, 0.25 * 0.5_f64.cos());
    let mut other = coin_beside::State::<f64>::default();
    (other.q.yaw, other.q.lean, other.q.spin, other.q.z) = (0.4, 0.5, 2.0, start.q.z);
    let blow = SVector::<f64, 6>::from([0.3, -0.2, 0.1, 0.02, 0.05, -0.03]);
    let [rates, speeds] = [held.outputs(0.0, &start, &()).jacobian, beside.outputs(0.0, &other, &()).jacobian];
    let start = impulse_at(&held, 0.0, &start, &rates, &blow).unwrap().state;
    let other = impulse_at(&beside, 0.0, &other, &speeds, &blow).unwrap().state;
    let (one, two) = (held.outputs(0.0, &start, &()), beside.outputs(0.0, &other, &()));
    assert!(one.twist[1].norm() > 0.1 && one.slip.amax() < 1e-13 && two.slip.amax() < 1e-13);
    assert!(one.twist.iter().zip(&two.twist).all(|(a, b)| (a - b).amax() < 1e-12), "{:?} {:?}", one.twist, two.twist);
}
