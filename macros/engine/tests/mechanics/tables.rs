//! Tables: values and slopes at points, between them and beyond.

use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::InputId;

use super::support::*;

const PENDULUM: &str = "
    input u;
    param height = 3.25;
    body b { mass: 2.0, com: -0.3 * Y, inertia: diag(0.1, 0.1, 0.1) }
    joint j: Revolute { parent: ground, child: b, axis: Z }
    output of_input = CURVE(u, XS, YS);
    output of_angle = CURVE(2.0 * j.angle, XS, YS);
    output slope = diff(CURVE(2.0 * j.angle, XS, YS), j) / 2.0;
    force f: Effort { joint: j, value: CURVE(u, XS, YS) * j.rate }
    emit forward_dynamics;";

fn table(curve: &str, points: &str, values: &str) -> Case {
    let consts = format!("const XS = {points}; let YS = {values};");
    case(&format!("{consts} {}", PENDULUM.replace("CURVE", curve)))
}

/// The value and the slope, the same by whatever it is asked for.
fn at(case: &Case, x: f64) -> [f64; 2] {
    let mut point = case.random(1);
    let joint = case.joint("j");
    point.set(Symbol::Input { input: InputId(0), element: 0 }, x);
    point.set(Symbol::Position { joint, component: 0 }, x / 2.0);
    let [of_input, of_angle, slope] = ["of_input", "of_angle", "slope"].map(|name| case.output(name, &point)[0]);
    assert_eq!(of_input, of_angle);
    [of_angle, slope]
}

/// Values and slopes of SciPy 1.17.1, `PchipInterpolator`: the data of Fritsch and Carlson (1980), and a table with a plateau, a peak and
/// uneven steps.
#[test]
fn smooth_tables_are_those_of_another_library() {
    let chemistry = table(
        "smooth_table",
        "[7.99, 8.09, 8.19, 8.7, 9.2, 10.0, 12.0, 15.0, 20.0]",
        "[0.0, 2.76429e-5, 4.37498e-2, 0.169183, 0.469428, 0.943740, 0.998636, 0.999919, 0.999994]",
    );
    let expected = [
        [7.99, 0.0, 0.0],
        [8.02, 2.4900617042310537e-06, 0.00016597267498353368],
        [8.13, 0.012201380711979303, 0.5220521741235129],
        [8.5, 0.1166325769392755, 0.20580225251505585],
        [8.7, 0.169183, 0.3494491676859672],
        [9.01, 0.34435525388403815, 0.6828367008613808],
        [9.9, 0.9252702456904094, 0.3008154294883696],
        [11.3, 0.9925090139650791, 0.017380243513672254],
        [13.7, 0.99967934785907, 0.00035163342656505136],
        [19.9, 0.99999397279238, 5.447222751398541e-07],
    ];
    for [x, value, slope] in expected {
        close(&format!("chemistry at {x}"), &at(&chemistry, x), &[value, slope], 1e-14);
    }
    let peak = table("smooth_table", "[-3, -1.25, 0.5, 0.75, 4]", "[2, -1, -1, 3.5, -2.25]");
    let expected = [
        [-2.9, 1.7431370262390669, -2.5630320699708458],
        [-2.0, -0.2915451895043731, -1.7317784256559765],
        [-1.1, -1.0, 0.0],
        [0.1, -1.0, 0.0],
        [0.6, 0.5839999999999992, 25.919999999999998],
        [0.74, 3.4789759999999994, 4.147199999999998],
        [2.5, 2.6022985889849792, -1.5389167045971779],
        [3.99, -2.197086223031408, -5.275079836140192],
    ];
    for [x, value, slope] in expected {
        close(&format!("peak at {x}"), &at(&peak, x), &[value, slope], 1e-14);
    }
    for (x, value) in [(-3.5, 2.0), (-1e9, 2.0), (4.0, -2.25), (7.0, -2.25)] {
        assert_eq!(at(&peak, x), [value, 0.0], "{x}");
    }
}

/// Values may be parameters; a point has the slope of what begins there.
#[test]
fn straight_tables_are_straight() {
    let xs = [-2.5, -0.75, 0.0, 0.3125, 4.0];
    let ys = [1.0, 3.25, -2.0, -2.0, 6.5];
    let case = table("table", "[-2.5, -0.75, 0.0, 0.3125, 4.0]", "[1.0, height, -2.0, -2.0, 2.0 * height]");
    let expected = |x: f64| {
        let Some(k) = xs.iter().rposition(|&point| point <= x) else { return [ys[0], 0.0] };
        let Some(end) = xs.get(k + 1) else { return [ys[k], 0.0] };
        let slope = (ys[k + 1] - ys[k]) / (end - xs[k]);
        [ys[k] + slope * (x - xs[k]), slope]
    };
    let between = (0..80).map(|k| -3.0 + 0.1 * f64::from(k) + 0.0123);
    for x in between.chain(xs) {
        close(&format!("at {x}"), &at(&case, x), &expected(x), 1e-15);
    }
    let two = table("table", "[1, 2]", "[5, 7]");
    let smooth = table("smooth_table", "[1, 2]", "[5, 7]");
    for (x, value) in [(0.0, 5.0), (1.25, 5.5), (2.0, 7.0), (3.0, 7.0)] {
        assert_eq!(at(&two, x)[0], value);
        assert_eq!(at(&smooth, x)[0], value);
    }
}

/// However far beyond the ends; what is not a number stays so.
#[test]
fn the_ends_hold_at_infinity() {
    for curve in ["table", "smooth_table"] {
        let case = table(curve, "[-2.5, -0.75, 0.0, 4.0]", "[1.0, 3.25, -2.0, 6.5]");
        for (x, value) in [(f64::INFINITY, 6.5), (f64::NEG_INFINITY, 1.0), (1e300, 6.5), (-1e300, 1.0)] {
            assert_eq!(at(&case, x), [value, 0.0], "{curve} at {x}");
        }
        let mut point = case.random(1);
        point.set(Symbol::Input { input: InputId(0), element: 0 }, f64::NAN);
        assert!(case.output("of_input", &point)[0].is_nan(), "{curve}");
    }
}

/// A value of the user's own that is called so comes first.
#[test]
fn a_function_of_the_users_comes_first() {
    let case = case(&format!(
        "let table(x, y, z) = x + y * z; let smooth_table = 2.0;
         input u; body b {{ mass: 2.0 }} joint j: Prismatic {{ parent: ground, child: b, axis: Z }}
         output value = table(u, 3.0, smooth_table); {}",
        "emit forward_dynamics;"
    ));
    let point = case.random(3);
    let u = point.get(Symbol::Input { input: InputId(0), element: 0 });
    close("own", &case.output("value", &point), &[u + 6.0], 1e-15);
}
