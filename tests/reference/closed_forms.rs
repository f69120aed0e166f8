//! Loops with solutions to twenty digits (`reference/closed_forms`): both branches, rates and accelerations.

use multibody::Kinematics;
use multibody::nalgebra::Vector3;
use multibody_tests::models::loops::*;
use multibody_tests::support::compare::mixed;

const BOUND: f64 = 1e-13;

fn assert_close(what: &str, got: &[f64], want: &[f64]) {
    let error = mixed(got, want);
    println!("{what}: {error:e}");
    assert!(error <= BOUND, "{what}: {got:?} instead of {want:?}, error {error:e}");
}

/// Angles are the same when they differ by whole turns.
fn assert_angles(what: &str, got: &[f64], want: &[f64]) {
    let turned: Vec<f64> = got
        .iter()
        .zip(want)
        .map(|(a, b)| a - std::f64::consts::TAU * ((a - b) / std::f64::consts::TAU).round())
        .collect();
    assert_close(what, &turned, want);
}

/// The state and what kinematics finds, for a model with one input coordinate.
macro_rules! found {
    ($model:ident, $input:ident = $q:expr, $v:expr, $a:expr) => {{
        let model = $model::Model::new(&$model::Params::default());
        let state = $model::State { q: $model::Position { $input: $q }, v: $model::Velocity { $input: $v } };
        model.kinematics(0.0, &state, &$model::Velocity { $input: $a })
    }};
}

#[test]
fn m1_four_bar() {
    let crank = [1.0, 2.0, 0.0];
    let check = |name: &str, found: Kinematics<f64, 2>, angles: [f64; 2], rates: [f64; 2], accel: f64| {
        let Kinematics { position, velocity, acceleration, residual } = found;
        assert_eq!(residual, 0.0);
        assert_angles(name, &[crank[0] + position[0], position[1]], &angles);
        assert_close(name, &[crank[1] + velocity[0], velocity[1]], &rates);
        assert_close(name, &[acceleration[1]], &[accel]);
        // The coupler's from the differentiated constraint: cos(x) + 3.5 cos(k) - 4 - 3 cos(r) = 0, twice.
        let ([k, r], [kd, rd]) = (angles, rates);
        let rest = -4.0 * crank[0].cos() - 3.5 * kd * kd * k.cos() + 3.0 * rd * rd * r.cos() + 3.0 * accel * r.sin();
        assert_close(name, &[acceleration[0]], &[rest / (3.5 * k.sin())]);
    };
    let open = found!(rrr_open, crank = crank[0], crank[1], crank[2]);
    let angles = [0.638_947_907_787_067_4, 1.789_251_403_387_524_9];
    let rates = [-0.444_320_678_020_159_7, 0.257_978_881_147_562_46];
    check("open", open, angles, rates, 1.588_940_210_204_704_8);
    let crossed = found!(rrr_crossed, crank = crank[0], crank[1], crank[2]);
    let (a, b) =
        ([-1.116_124_470_400_68, -2.266_427_966_001_138], [0.077_938_740_388_610_26, -0.624_360_818_779_111_9]);
    check("crossed", crossed, a, b, 0.924_146_982_215_668_7);

    // The same where the crank is driven: nothing is left to be integrated.
    let model = rrr_driven::Model::new(&rrr_driven::Params::default());
    let output = model.outputs(0.0, &rrr_driven::State::default(), &());
    assert_angles("driven", &output.angles, &angles);
    assert_close("driven", &output.rates, &rates);
    assert_close("driven", &output.accels[1..], &[1.588_940_210_204_704_8]);
    assert_eq!(rrr_driven::DOF, 0);
    // The crank's motor is all that does work, in steps of 1e-4 s, to the fourth order.
    let at = |t: f64| model.outputs(t, &rrr_driven::State::default(), &());
    for t in [0.0, 0.3, 1.7, 2.9] {
        let h = 1e-3;
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| at(t + k * h).moving);
        let power = (a - 8.0 * b + 8.0 * c - d) / (12.0 * h);
        let error = (2.0 * at(t).torque - power).abs();
        assert!(error <= 1e-7 * (1.0 + power.abs()), "t = {t}: power {power}, error {error:e}");
    }
}

#[test]
fn m2_slider_crank() {
    let right = found!(rrp_right, crank = 0.7, 3.0, 0.0);
    assert_angles("rod", &[0.7 + right.position[0]], &[-0.081_496_076_659_919_6]);
    let slider = [right.position[1], right.velocity[1], right.acceleration[1]];
    assert_close("slider", &slider, &[3.754_885_284_171_266_3, -2.120_063_059_523_724_6, -8.182_561_118_798_352]);
    let left = found!(rrp_left, crank = 0.7, 3.0, 0.0);
    assert_close("left", &[left.position[1]], &[-2.225_200_909_602_289_6]);
    // sin(a) + 3 sin(b) = 0.4 and x = cos(a) + 3 cos(b), differentiated.
    for found in [right, left] {
        let (a, b) = (0.7_f64, 0.7 + found.position[0]);
        let rate = -3.0 * a.cos() / (3.0 * b.cos());
        let accel = (9.0 * a.sin() + 3.0 * rate * rate * b.sin()) / (3.0 * b.cos());
        assert_close("rod's rate", &[3.0 + found.velocity[0], found.acceleration[0]], &[rate, accel]);
        let velocity = -3.0 * a.sin() - 3.0 * rate * b.sin();
        let acceleration = -9.0 * a.cos() - 3.0 * rate * rate * b.cos() - 3.0 * accel * b.sin();
        assert_close("slider's", &[found.velocity[1], found.acceleration[1]], &[velocity, acceleration]);
    }
}

#[test]
fn m3_swinging_arm() {
    let (angle, travel) = (1.223_115_121_633_425_3, 2.934_630_781_520_197);
    let ahead = found!(rpr_ahead, crank = 0.7, 3.0, 0.0);
    assert_angles("arm", &[ahead.position[0]], &[angle]);
    assert_close("travel", &[ahead.position[1]], &[travel]);
    assert_close("rates", ahead.velocity.as_slice(), &[0.885_563_323_592_489_6, 1.720_134_085_645_582]);
    assert_close("arm's", &[ahead.acceleration[0]], &[0.560_789_472_669_148_9]);
    let behind = found!(rpr_behind, crank = 0.7, 3.0, 0.0);
    assert_angles("arm", &[behind.position[0]], &[-1.748_508_724_178_818]);
    assert_close("travel", &[behind.position[1]], &[-travel]);
    // (x, y + 2.2) = R(arm) (travel, 0.25); along and across the arm, differentiated twice.
    for found in [ahead, behind] {
        let (w, q) = (found.velocity[0], found.position);
        let (sin, cos) = q[0].sin_cos();
        let turned = |v: [f64; 2]| [cos * v[0] + sin * v[1], -sin * v[0] + cos * v[1]];
        let (s, c) = 0.7_f64.sin_cos();
        let [v, a] = [turned([-3.0 * s, 3.0 * c]), turned([-9.0 * c, -9.0 * s])];
        let rates = [v[1] / q[1], v[0] + 0.25 * v[1] / q[1]];
        assert_close("differentiated", found.velocity.as_slice(), &rates);
        let arm = (a[1] - 2.0 * w * rates[1] + 0.25 * w * w) / q[1];
        assert_close("differentiated", found.acceleration.as_slice(), &[arm, a[0] + 0.25 * arm + q[1] * w * w]);
    }
}

#[test]
fn m4_rod_between_levers() {
    let up = found!(rssr_up, driver = 0.9, 2.0, 0.0);
    let down = found!(rssr_down, driver = 0.9, 2.0, 0.0);
    let of_up = [-1.259_438_342_328_270_2, -15.123_049_209_938_625];
    assert_angles("up", up.position.as_slice(), &[0.386_255_894_002_213]);
    assert_close("up", &[up.velocity[0], up.acceleration[0]], &of_up);
    assert_angles("down", down.position.as_slice(), &[-2.668_350_532_275_787_2]);
    assert_close("down", &[down.velocity[0], down.acceleration[0]], &[6.396_478_478_537_482, -9.918_535_139_410_729]);
    let body = found!(rusr, driver = 0.9, 2.0, 0.0);
    assert_angles("rod", &body.position.as_slice()[..1], &[0.386_255_894_002_213]);
    assert_close("rod", &[body.velocity[0], body.acceleration[0]], &of_up);
}

#[test]
fn m5_leg() {
    let d = [0.4, 0.5, 1.1];
    let length = 1.272_792_206_135_785_5;
    let (first, second) = (-0.426_627_493_126_876_1, 0.319_687_259_130_279_95);
    let rates = [0.294_520_547_945_205_5, 0.284_042_514_853_652_2, 0.180_705_066_303_228_8];
    let accels = [1.649_840_495_402_514_5, 0.731_289_893_105_346_6, 0.162_906_150_754_843_16];
    let pi = std::f64::consts::PI;
    macro_rules! leg {
        ($model:ident, $angles:expr, $length:expr, $rates:expr, $accels:expr) => {{
            let name = stringify!($model);
            let model = $model::Model::new(&$model::Params::default());
            let mut state = $model::State::default();
            (state.q.tip.position, state.v.tip.position) = (d.into(), [0.4, -0.3, 0.2].into());
            let mut accel = $model::Velocity::default();
            accel.tip.position = [1.0, -2.0, 0.5].into();
            let found = model.kinematics(0.0, &state, &accel);
            assert_angles(name, &found.position.as_slice()[..2], &$angles);
            assert_close(name, &[found.position[2]], &[$length]);
            assert_close(name, found.velocity.as_slice(), &$rates);
            assert_close(name, found.acceleration.as_slice(), &$accels);
            let end: Vector3<f64> = model.outputs(0.0, &state, &()).end;
            assert_close(name, end.as_slice(), &d);
        }};
    }
    let [a, b, c] = rates;
    let [e, f, g] = accels;
    leg!(ups, [first, second], length, rates, accels);
    leg!(ups_turned, [2.714_965_160_462_917, 2.821_905_394_459_513], length, [a, -b, c], [e, -f, g]);
    // Through the foot: the leg points away from d.
    leg!(ups_through, [first + pi, -second], -length, [a, -b, -c], [e, -f, -g]);
    leg!(ups_turned_through, [first, second + pi], -length, [a, b, -c], [e, f, -g]);
}

#[test]
fn m6_bennett() {
    let found = found!(bennett, first = 0.8, 1.0, 0.0);
    assert_angles("angles", found.position.as_slice(), &[2.864_911_468_726_404, -0.8]);
    assert_close("rates", found.velocity.as_slice(), &[-0.380_793_542_546_099, -1.0]);
    assert_close("accels", found.acceleration.as_slice(), &[-0.140_808_069_835_311_27, 0.0]);
}
