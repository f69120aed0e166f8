//! Formulas of one model in another, against the model that they are taken from, and against models that are solved where they are.

use multibody_tests::models::formulas::{
    asker, controlled_arm, follower, gears, known_arm, pieces, pulled, slider, solved_platform, told_platform, twice,
};
use multibody_tests::support::random::Random;

const TOLERANCE: f64 = 1e-14;

fn close(what: &str, got: &[f64], want: &[f64]) {
    assert_eq!(got.len(), want.len(), "{what}");
    let scale = 1.0 + want.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    for (got, want) in got.iter().zip(want) {
        assert!((got - want).abs() <= TOLERANCE * scale, "{what}: {got} for {want}");
    }
}

/// A random motion of the platform, away from where its legs hold it badly.
macro_rules! motion {
    ($module:ident, $random:expr) => {{
        let random = $random;
        let mut state = $module::State::<f64>::default();
        let mut accel = $module::Velocity::<f64>::default();
        let (q, v, a) = (&mut state.q.platform, &mut state.v.platform, &mut accel.platform);
        q.position = [-1.5 + 0.2 * random.unit(), 0.2 * random.unit(), 1.0 + 0.2 * random.unit()].into();
        (q.orientation.roll, q.orientation.pitch) = (0.2 * random.unit(), 0.2 * random.unit());
        q.orientation.yaw = 0.2 * random.unit();
        v.position = [random.unit(), random.unit(), random.unit()].into();
        (v.orientation.roll, v.orientation.pitch) = (random.unit(), random.unit());
        v.orientation.yaw = random.unit();
        a.position = [random.unit(), random.unit(), random.unit()].into();
        (a.orientation.roll, a.orientation.pitch) = (random.unit(), random.unit());
        a.orientation.yaw = random.unit();
        (state, accel)
    }};
}

/// The inverse kinematics of one leg, found once, drives the platform's inverse dynamics.
#[test]
fn a_leg_in_a_platform() {
    let (told, solved) = (told_platform::Model::<f64>::default(), solved_platform::Model::<f64>::default());
    let (mut of_told, mut of_solved) = (Random::new(41), Random::new(41));
    for _ in 0..100 {
        let (state, accel) = motion!(told_platform, &mut of_told);
        let found = told.inverse_dynamics(0.0, &state, &told_platform::Input::default(), &accel);
        let found = found.input.legs.map(|leg| leg.thrust);
        let (state, accel) = motion!(solved_platform, &mut of_solved);
        let want = solved.inverse_dynamics(0.0, &state, &solved_platform::Input::default(), &accel);
        close("thrusts", &found, &want.input.legs.map(|leg| leg.thrust));
    }
}

/// Place, rate and acceleration of the slider while the crank turns at a constant rate.
fn turned(model: &slider::Model<f64>, turn: f64, rate: f64) -> [f64; 3] {
    let (q, v) = (slider::Position { turn }, slider::Velocity { turn: rate });
    let found = model.kinematics(0.0, &slider::State { q, v }, &slider::Velocity::default());
    [found.position[0], found.velocity[0], found.acceleration[0]]
}

#[test]
fn a_drive_that_follows_another_mechanism() {
    let model = follower::Model::<f64>::default();
    let params = slider::Params { rod: [0.7, 0.05 * 1.3, 0.0], ..slider::Params::default() };
    let other = slider::Model::<f64>::new(&params);
    let mut random = Random::new(43);
    for _ in 0..50 {
        let t = 5.0 * random.unit();
        let mut state = follower::State::default();
        (state.q.swing, state.v.swing) = (random.unit(), random.unit());
        let y = model.outputs(t, &state, &());
        let want = turned(&other, 1.3 * t, 1.3);
        close("place", &[y.place, y.rate, y.accel], &want);
        // By the model between.
        let mut state_of_twice = twice::State::default();
        state_of_twice.q.j = state.q.swing;
        let between = twice::Model::default().outputs(0.0, &state_of_twice, &twice::Input { u: 1.3 });
        close("by two models", &[y.seen], &[between.travel]);
        let params = slider::Params { arm: 0.31, ..slider::Params::default() };
        let turn = 1.3 * state.q.swing;
        let want = turned(&slider::Model::new(&params), turn, 0.5);
        close("travel", &[between.travel, between.rate], &want[..2]);
        let (x, y) = (0.1_f64.cos() * want[0], 0.05 + 0.1_f64.sin() * want[0]);
        close("distance", &[between.far], &[x.hypot(y)]);
    }
}

/// With the same load what is left is the arm without gravity; with another one it is not.
#[test]
fn a_controller_with_a_model_of_its_own() {
    let mut random = Random::new(47);
    for _ in 0..50 {
        let model = controlled_arm::Model::<f64>::new(&controlled_arm::Params { load: 0.8 });
        let mut state = controlled_arm::State::default();
        (state.q.base, state.q.elbow) = (2.0 * random.unit(), 2.0 * random.unit());
        let still = model.forward_dynamics(0.0, &state, &controlled_arm::Input::default());
        assert!(still.base.abs().max(still.elbow.abs()) < 1e-12, "{still:?}");
        let mut bare = known_arm::State::default();
        (bare.q.base, bare.q.elbow) = (state.q.base, state.q.elbow);
        let falling = known_arm::Model::<f64>::default().forward_dynamics(0.0, &bare, &());
        assert!(falling.base.abs().max(falling.elbow.abs()) > 1e-2, "{falling:?}");
        (state.v.base, state.v.elbow) = (random.unit(), random.unit());
        // Declared with the load that the known arm has by default.
        let y = controlled_arm::Model::<f64>::default().outputs(0.0, &state, &controlled_arm::Input::default());
        close("energy", &[y.energy_known], &[y.energy]);
        close("inertia", &[y.inertia_known], &[y.inertia]);
    }
}

/// The gears, asked directly.
fn geared(ratio: f64, [ja, angle]: [f64; 2], rates: [f64; 2], t: f64, s: f64, u: [f64; 3]) -> gears::Output<f64> {
    let mut state = gears::State::default();
    (state.q.ja, state.q.jc_angle) = (ja, angle);
    (state.v.ja, state.v.jc_angle) = rates.into();
    state.x.s = s;
    gears::Model::<f64>::new(&gears::Params { ratio }).outputs(t, &state, &gears::Input { u: u.into() })
}

/// Couplings, drives, screws, states, inputs and parameters of the model that is asked; absolute coordinates, parts, forces and
/// multipliers in those that ask.
#[test]
fn whatever_the_model_has() {
    let mut random = Random::new(53);
    let still = [0.0; 3];
    for _ in 0..20 {
        let (t, place) = (random.unit(), [3.0 * random.unit(), 3.0 * random.unit(), random.unit()]);
        let w = [random.unit(), random.unit(), random.unit()];
        let mut state = asker::State::default();
        state.q.e.position = place.into();
        let y = asker::Model::<f64>::default().outputs(t, &state, &asker::Input { w: w.into() });
        let at = [place[0], place[1]];
        close("place", y.place.as_slice(), geared(3.0, at, [0.0; 2], t, 0.0, still).place.as_slice());
        close("speed", y.speed.as_slice(), geared(2.0, at, [3.0, w[2]], 2.0 * t, 0.0, still).speed.as_slice());
        close("moved", y.moved.as_slice(), geared(2.0, [3.0 * t, t], [3.0, 1.0], t, 0.0, still).speed.as_slice());
        close("mixed", &[y.mixed], &[geared(6.0, [0.1, 0.3], [0.2, -0.4], 0.5, w[0], w).mixed]);

        let mut state = pieces::State::default();
        for (i, (q, v)) in state.q.all.iter_mut().zip(&mut state.v.all).enumerate() {
            (q.q, v.q) = (random.unit() + i as f64, random.unit());
        }
        let y = pieces::Model::<f64>::default().outputs(t, &state, &());
        for (i, piece) in y.all.iter().enumerate() {
            let gain = 1.0 + i as f64;
            let at = [gain * state.q.all[i].q, state.v.all[i].q];
            close("turn", &[piece.seen], &[geared(gain, at, [0.0; 2], 0.0, 0.0, still).turn]);
        }

        let model = pulled::Model::<f64>::default();
        let (x, phi, h) = (random.unit(), 2.0 * random.unit(), 1e-5);
        let reach = |phi: f64| geared(2.0, [phi, 0.2 * phi], [0.0; 2], 0.0, 0.0, still).place.norm();
        let held = pulled::Position { x, phi };
        close("left", model.constraints(0.0, &held).as_slice(), &[x - reach(phi)]);
        let slope = model.constraint_jacobian(0.0, &held)[(0, 1)];
        assert!((slope + (reach(phi + h) - reach(phi - h)) / (2.0 * h)).abs() < 1e-8);
    }
}
