//! A leg whose joints are turned through four-bars: articulated bodies with the loops embedded, against multipliers.

use multibody::nalgebra::{SVector, UnitQuaternion, Vector3};
use multibody::{Pose, Projection, Twist};
use multibody_tests::models::hopper::{hopper, hopper_held};
use multibody_tests::support::compare::mixed;
use multibody_tests::support::random::Random;

fn vector(random: &mut Random, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| size * random.unit())
}

#[test]
fn a_leg_on_linkages_moves_as_with_multipliers() {
    let mut random = Random::new(0x1E6);
    let (model, held) = (hopper::Model::<f64>::default(), hopper_held::Model::<f64>::default());
    let mut seen = 0;
    for _ in 0..40 {
        let mut state = hopper_held::State::default();
        state.q.float = Pose {
            position: vector(&mut random, 2.0),
            orientation: UnitQuaternion::from_scaled_axis(vector(&mut random, 2.0)),
        };
        state.v.float = Twist { linear: vector(&mut random, 1.0), angular: vector(&mut random, 2.0) };
        let mut input = hopper_held::Input::default();
        let (q, v) = (&mut state.q.leg, &mut state.v.leg);
        [q.roll, q.pitch] = random.units().map(|x: f64| 3.0 * x);
        [q.knee_motor, q.ankle_motor] = random.units().map(|x: f64| 0.5 * x);
        (q.knee_hinge, q.knee, q.ankle_hinge, q.ankle) = (-q.knee_motor, q.knee_motor, -q.ankle_motor, q.ankle_motor);
        [v.roll, v.pitch] = random.units().map(|x: f64| 3.0 * x);
        [v.knee_motor, v.ankle_motor] = random.units().map(|x: f64| 3.0 * x);
        input.leg.torque = random.units().map(|x| 20.0 * x);
        let Ok(closed) = Projection::default().project(&held, 0.0, &state) else { continue };
        let state = closed.state;
        let mut own = hopper::State::default();
        let mut own_input = hopper::Input::default();
        (own.q.float, own.v.float) = (state.q.float, state.v.float);
        let (p, w) = (&mut own.q.leg, &mut own.v.leg);
        let (q, v) = (&state.q.leg, &state.v.leg);
        (p.roll, p.pitch, p.knee_motor, p.ankle_motor) = (q.roll, q.pitch, q.knee_motor, q.ankle_motor);
        (w.roll, w.pitch, w.knee_motor, w.ankle_motor) = (v.roll, v.pitch, v.knee_motor, v.ankle_motor);
        own_input.leg.torque = input.leg.torque;
        let want = held.forward_dynamics(0.0, &state, &input).v;
        let got = model.forward_dynamics(0.0, &own, &own_input);
        let of = |twist: &Twist<f64>| [twist.linear, twist.angular].map(|v| [v.x, v.y, v.z]).concat();
        let (mut a, mut b) = (of(&got.float), of(&want.float));
        let (leg, held_leg) = (&got.leg, &want.leg);
        a.extend([leg.roll, leg.pitch, leg.knee_motor, leg.ankle_motor]);
        b.extend([held_leg.roll, held_leg.pitch, held_leg.knee_motor, held_leg.ankle_motor]);
        let error = mixed(&a, &b);
        assert!(error <= 1e-9, "{a:?} instead of {b:?}, error {error:e}");
        // And back to what acts.
        let needed = model.inverse_dynamics(0.0, &own, &own_input, &got);
        let leg = &needed.leg;
        let of_leg = [leg.roll, leg.pitch, leg.knee_motor, leg.ankle_motor];
        let left = of(&needed.float).into_iter().chain(of_leg).fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(left <= 1e-9, "{left:e}");
        let (got, want) = (model.outputs(0.0, &own, &own_input).felt, held.outputs(0.0, &state, &input).felt);
        let error = (got - want).norm() / (1.0 + want.norm());
        assert!(error <= 1e-9, "{got} instead of {want}, error {error:e}");
        // A blow at the trunk and at all coordinates of the leg that are in both states.
        let (mut blow, mut held_blow) = (hopper::Velocity::default(), hopper_held::Velocity::default());
        blow.float = Twist { linear: vector(&mut random, 5.0), angular: vector(&mut random, 1.0) };
        let of_leg: [f64; 4] = random.units();
        (blow.leg.roll, blow.leg.pitch, blow.leg.knee_motor, blow.leg.ankle_motor) = of_leg.into();
        held_blow.float = blow.float;
        let leg = &mut held_blow.leg;
        (leg.roll, leg.pitch, leg.knee_motor, leg.ankle_motor) = of_leg.into();
        let (got, want) = (model.impulse(&own.q, &blow), held.impulse(&state.q, &held_blow, &SVector::zeros()).v);
        let (mut a, mut b) = (of(&got.float), of(&want.float));
        a.extend([got.leg.roll, got.leg.pitch, got.leg.knee_motor, got.leg.ankle_motor]);
        b.extend([want.leg.roll, want.leg.pitch, want.leg.knee_motor, want.leg.ankle_motor]);
        let error = mixed(&a, &b);
        assert!(error <= 1e-9, "{a:?} instead of {b:?}, error {error:e}");
        seen += 1;
    }
    assert!(seen > 20, "{seen}");
}
