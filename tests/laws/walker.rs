//! Legs whose joints are turned through four-bars: articulated bodies with the loops embedded, against multipliers.

use multibody::nalgebra::{UnitQuaternion, Vector3};
use multibody::{Pose, Projection, Twist};
use multibody_tests::models::walker::{walker, walker_held};
use multibody_tests::support::compare::mixed;
use multibody_tests::support::random::Random;

#[test]
fn legs_on_linkages_move_as_with_multipliers() {
    let mut random = Random::new(0x1E6);
    let (model, held) = (walker::Model::<f64>::default(), walker_held::Model::<f64>::default());
    let mut seen = 0;
    for _ in 0..40 {
        let mut vector = |size: f64| Vector3::from_fn(|_, _| size * random.unit());
        let mut state = walker_held::State::default();
        state.q.float = Pose { position: vector(2.0), orientation: UnitQuaternion::from_scaled_axis(vector(2.0)) };
        state.v.float = Twist { linear: vector(1.0), angular: vector(2.0) };
        let mut input = walker_held::Input::default();
        for ((q, v), input) in state.q.legs.iter_mut().zip(&mut state.v.legs).zip(&mut input.legs) {
            [q.roll, q.pitch] = random.units().map(|x: f64| 3.0 * x);
            [q.knee_motor, q.ankle_motor] = random.units().map(|x: f64| 0.5 * x);
            (q.knee_hinge, q.knee, q.ankle_hinge, q.ankle) =
                (-q.knee_motor, q.knee_motor, -q.ankle_motor, q.ankle_motor);
            [v.roll, v.pitch] = random.units().map(|x: f64| 3.0 * x);
            [v.knee_motor, v.ankle_motor] = random.units().map(|x: f64| 3.0 * x);
            input.torque = random.units().map(|x| 20.0 * x);
        }
        let Ok(closed) = Projection::default().project(&held, 0.0, &state) else { continue };
        let state = closed.state;
        let mut own = walker::State::default();
        let mut own_input = walker::Input::default();
        (own.q.float, own.v.float) = (state.q.float, state.v.float);
        let legs = state.q.legs.iter().zip(&state.v.legs).zip(&input.legs);
        let own_legs = own.q.legs.iter_mut().zip(&mut own.v.legs).zip(&mut own_input.legs);
        for (((q, v), given), ((p, w), taken)) in legs.zip(own_legs) {
            (p.roll, p.pitch, p.knee_motor, p.ankle_motor) = (q.roll, q.pitch, q.knee_motor, q.ankle_motor);
            (w.roll, w.pitch, w.knee_motor, w.ankle_motor) = (v.roll, v.pitch, v.knee_motor, v.ankle_motor);
            taken.torque = given.torque;
        }
        let want = held.forward_dynamics(0.0, &state, &input).v;
        let got = model.forward_dynamics(0.0, &own, &own_input);
        let of = |twist: &Twist<f64>| [twist.linear, twist.angular].map(|v| [v.x, v.y, v.z]).concat();
        let (mut a, mut b) = (of(&got.float), of(&want.float));
        for (got, want) in got.legs.iter().zip(&want.legs) {
            a.extend([got.roll, got.pitch, got.knee_motor, got.ankle_motor]);
            b.extend([want.roll, want.pitch, want.knee_motor, want.ankle_motor]);
        }
        let error = mixed(&a, &b);
        assert!(error <= 1e-9, "{a:?} instead of {b:?}, error {error:e}");
        // And back to what acts.
        let needed = model.inverse_dynamics(0.0, &own, &own_input, &got);
        let of_legs = needed.legs.iter().flat_map(|leg| [leg.roll, leg.pitch, leg.knee_motor, leg.ankle_motor]);
        let left = of(&needed.float).into_iter().chain(of_legs).fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(left <= 1e-9, "{left:e}");
        seen += 1;
    }
    assert!(seen > 20, "{seen}");
}
