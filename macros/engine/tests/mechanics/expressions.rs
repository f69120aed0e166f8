//! User expressions: every function, operator and shape against f64.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::{InputId, StateId};

use super::support::*;

const PENDULUM: &str = "
    input u;
    input list: [Vec3; 2];
    body b { mass: 2.0, com: -0.3 * Y, inertia: diag(0.1, 0.1, 0.1) }
    joint j: Revolute { parent: ground, child: b, axis: Z }
    state x: rate = 2.0 * x + j.rate, start: 0.5;
    force f: Effort { joint: j, value: u * x }
    emit forward_dynamics;";

#[test]
fn functions() {
    type Expected = fn(f64, f64) -> f64;
    let cases: [(&str, Expected); 35] = [
        ("sin(u)", |u, _| u.sin()),
        ("cos(u) * tan(x)", |u, x| u.cos() * x.tan()),
        ("asin(u) - acos(x)", |u, x| u.asin() - x.acos()),
        ("atan(u) / atan2(u, x)", |u, x| u.atan() / u.atan2(x)),
        ("sinh(u) + cosh(x) + tanh(u)", |u, x| u.sinh() + x.cosh() + u.tanh()),
        ("exp(u) - ln(2.0 + x)", |u, x| u.exp() - (2.0 + x).ln()),
        ("sqrt(u * u + 1.0)", |u, _| (u * u + 1.0).sqrt()),
        ("hypot(u, x)", f64::hypot),
        ("abs(u) + abs(-x)", |u, x| u.abs() + x.abs()),
        ("signum(u)", |u, _| u.signum()),
        ("min(u, x)", f64::min),
        ("max(u, x)", f64::max),
        ("powi(u, 3)", |u, _| u.powi(3)),
        ("powi(u, -2)", |u, _| u.powi(-2)),
        ("powf(2.0 + u, x)", |u, x| (2.0 + u).powf(x)),
        ("powf(u - 2.0, 3.0) + powf(x - 3.0, -2.0) + powf(u, 1.0)", |u, x| {
            (u - 2.0).powf(3.0) + (x - 3.0).powf(-2.0) + u
        }),
        ("deg(30.0) * u", |u, _| 30.0_f64.to_radians() * u),
        ("dot([u, x, 1.0], [x, 2.0, u])", |u, x| u * x + 2.0 * x + u),
        ("norm([u, x, 1.0])", |u, x| (u * u + x * x + 1.0).sqrt()),
        ("norm([0.0, u, 0.0])", |u, _| u.abs()),
        ("cross([u, x, 1.0], [x, 2.0, u]).y", |u, x| x - u * u),
        ("([u, x, 1.0] / x).z", |_, x| 1.0 / x),
        ("(2.0 * -[u, x, 1.0] + [x, x, x]).x", |u, x| x - 2.0 * u),
        ("select(u < x, 1.0, 2.0)", |u, x| if u < x { 1.0 } else { 2.0 }),
        ("select(u > x, u, x)", f64::max),
        ("select(u >= x && u <= 1.0, u, 5.0)", |u, x| if u >= x { u } else { 5.0 }),
        ("select(u == u || u < x, u, x)", |u, _| u),
        ("select(u != x, u, 7.0)", |u, _| u),
        ("select(!(u > x), u, x)", f64::min),
        ("select(u > x, [u, x, 1.0], [x, u, 2.0]).y", |u, x| if u > x { x } else { u }),
        ("PI * u", |u, _| std::f64::consts::PI * u),
        ("sin(u) * sin(u) + cos(u) * cos(u)", |_, _| 1.0),
        ("u - u", |_, _| 0.0),
        ("t * 0.0 + [u, x][1]", |_, x| x),
        ("-u + x - 1.5e-3", |u, x| x - u - 1.5e-3),
    ];
    for (text, expected) in cases {
        let case = case(&format!("{PENDULUM} output value = {text};"));
        for seed in 1..5 {
            let point = case.random(seed);
            let u = point.get(Symbol::Input { input: InputId(0), element: 0 });
            let x = point.get(Symbol::State { state: StateId(0) });
            close(text, &case.output("value", &point), &[expected(u, x)], 1e-14);
        }
    }
}

#[test]
fn shapes() {
    let case = case(&format!(
        "{PENDULUM}
        param table: [[Scalar; 3]; 2] = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
        param place = [0.1, 0.2, 0.3];
        output picked = [list[1].y, place.z];
        output both = [list[0] + place, list[1] - place];
        output numbers = table;"
    ));
    let point = case.random(2);
    let list: Vec<f64> = (0..6).map(|element| point.get(Symbol::Input { input: InputId(1), element })).collect();
    close("picked", &case.output("picked", &point), &[list[4], 0.3], 1e-15);
    let both = [list[0] + 0.1, list[1] + 0.2, list[2] + 0.3, list[3] - 0.1, list[4] - 0.2, list[5] - 0.3];
    close("both", &case.output("both", &point), &both, 1e-15);
    close("numbers", &case.output("numbers", &point), &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 1e-15);
}

#[test]
fn states_have_rates() {
    let case = case(PENDULUM);
    let point = case.random(4);
    let rates = case.eval(FunctionKind::ForwardDynamics, &point);
    let u = point.get(Symbol::Input { input: InputId(0), element: 0 });
    let x = point.get(Symbol::State { state: StateId(0) });
    let acceleration = u * x / (0.1 + 2.0 * 0.09);
    close("rates", &rates, &[acceleration, 2.0 * x + case.velocity(&point)[0]], 1e-14);
}

#[test]
fn shared_names_are_translated_once() {
    // Doubled sixty times: 2^60 terms, if each use were expanded.
    let mut lets = String::from("let a0 = sin(u);");
    for k in 1..=60 {
        lets += &format!("let a{k} = 0.5 * a{} * a{} + 0.3 * u;", k - 1, k - 1);
    }
    let case = case(&format!("{PENDULUM} {lets} output value = a60;"));
    let point = case.random(1);
    let u = point.get(Symbol::Input { input: InputId(0), element: 0 });
    let expected = (0..60).fold(u.sin(), |a, _| 0.5 * a * a + 0.3 * u);
    close("value", &case.output("value", &point), &[expected], 1e-9);
}

#[test]
fn long_chains_of_names() {
    let mut lets = String::from("let a0 = u;");
    for k in 1..=150 {
        lets += &format!("let a{k} = a{} * 0.999 + x;", k - 1);
    }
    let case = case(&format!("{PENDULUM} {lets} output value = a150;"));
    let point = case.random(1);
    let u = point.get(Symbol::Input { input: InputId(0), element: 0 });
    let x = point.get(Symbol::State { state: StateId(0) });
    let expected = (0..150).fold(u, |a, _| a * 0.999 + x);
    close("value", &case.output("value", &point), &[expected], 1e-9);
}

#[test]
fn shared_vectors_are_looked_into_with_measure() {
    // Doubled forty times, and turned into the body's axes.
    let mut lets = String::from("let v0 = b.at(X).velocity;");
    for k in 1..=40 {
        lets += &format!("let v{k} = 0.5 * (v{} + v{});", k - 1, k - 1);
    }
    let case = case(&format!(
        "{PENDULUM} {lets}
        output value = b.express(v40 - v1 + b.at(X).velocity);
        output own = b.express(b.at(X).velocity);"
    ));
    let point = case.random(1);
    let rate = case.velocity(&point)[0];
    close("own", &case.output("own", &point), &[0.0, rate, 0.0], 1e-15);
    close("value", &case.output("value", &point), &[0.0, rate, 0.0], 1e-14);
}

/// The graph knows that 0.1 + 0.2 is 0.3, and f64 does not: no error of the compiler.
#[test]
fn comparisons_of_decimals_may_hang_on_their_rounding() {
    for mass in
        ["select(0.1 + 0.2 == 0.3, 1.0, 2.0)", "select(0.1 + 0.2 <= 0.3, 1.0, 2.0)", "2 + signum(0.1 + 0.2 - 0.3)"]
    {
        let case = case(&format!(
            "param p = 1.0;
            body a {{ mass: p * ({mass}), inertia: diag(1, 1, 1) }}
            joint slide: Prismatic {{ parent: ground, child: a, axis: X }}
            emit mass_matrix;"
        ));
        let mass = case.eval(FunctionKind::MassMatrix, &case.rest())[0];
        assert!(mass == 1.0 || mass == 2.0, "{mass}");
    }
}
