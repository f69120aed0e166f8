//! Inputs that produce a motion, whatever the structure of their forces: they are put back into forward dynamics, and
//! compared with those of the same mechanism whose inputs are turned by a dense constant matrix, which hides the structure.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::{InputId, ParamId};

use super::support::{Case, Point, Random, case, close};

/// A mechanism with a place for the forces and the state's joints; all have revolute joints of one coordinate.
struct Mechanism {
    text: String,
    /// In the state, in its order; empty where the state holds joints of more coordinates.
    joints: &'static [&'static str],
}

const PARAMS: &str = "param r: [Scalar; 4] = [10.0, 0.5, -3.0, 7.0];";

/// Four links on oblique axes.
fn arm() -> Mechanism {
    let link = |k: usize, parent: &str, axis: &str| {
        format!(
            "body b{k} {{ mass: 1.{k}, com: [0.1, 0.0{k}, 0.2], inertia: inertia(0.2, 0.3, 0.25, 0.01, -0.02, 0.0{k}) }}
            joint j{k}: Revolute {{ parent: {parent}.at([0.1, 0.2, 0.3]), child: b{k}, axis: {axis} }} "
        )
    };
    let text = format!(
        "world {{ gravity: [0.3, -0.4, -9.7] }} {}{}{}{}",
        link(1, "ground", "[0.3, 0.5, 1.0]"),
        link(2, "b1", "[1.0, -0.2, 0.4]"),
        link(3, "b2", "[0.1, 1.0, 0.7]"),
        link(4, "b3", "[0.6, 0.2, -1.0]"),
    );
    Mechanism { text, joints: &["j1", "j2", "j3", "j4"] }
}

/// Five bars in a plane, closed by equations or not; the first and the last bar may have motors.
fn five_bars(formulation: &str, joints: &'static [&'static str]) -> Mechanism {
    let bar = |name: &str, length: f64| {
        format!(
            "body {name} {{ mass: {length}, com: [{}, 0.02, 0.0], inertia: diag(0.01, 0.1, 0.11) }} ",
            0.45 * length
        )
    };
    let text = format!(
        "world {{ gravity: -9.81 * Y }} formulation {{ {formulation} }} {}{}{}{}
        joint j1: Revolute {{ parent: ground, child: left, axis: Z }}
        joint j2: Revolute {{ parent: left.at(0.8 * X), child: upper, axis: Z }}
        joint j3: Revolute {{ parent: ground.at(X), child: right, axis: Z }}
        joint j4: Revolute {{ parent: right.at(0.9 * X), child: lower, axis: Z }}
        #[cut] joint pin: Revolute {{ parent: upper.at(1.1 * X), child: lower.at(1.3 * X), axis: Z }} ",
        bar("left", 0.8),
        bar("upper", 1.1),
        bar("right", 0.9),
        bar("lower", 1.3),
    );
    Mechanism { text, joints }
}

/// A dense regular matrix.
const DENSE: [[f64; 4]; 4] =
    [[0.9, 0.4, -0.3, 0.5], [-0.6, 1.1, 0.2, 0.3], [0.4, -0.7, 0.8, -0.2], [0.1, 0.5, 0.6, -1.0]];

/// The mechanism with efforts `slopes[k] * u` on joint `jk`, or with u = D w.
fn driven(mechanism: &Mechanism, slopes: &[&[&str]], turned: bool) -> Case {
    let inputs = slopes.iter().map(|row| row.len()).max().unwrap_or(0);
    let input = |j: usize| {
        let terms = (0..inputs).map(|k| format!("({}) * u[{k}]", DENSE[j][k])).collect::<Vec<_>>();
        if turned { format!("({})", terms.join(" + ")) } else { format!("u[{j}]") }
    };
    let mut text = format!("{PARAMS} input u: [Scalar; {inputs}]; {}", mechanism.text);
    for (k, row) in slopes.iter().enumerate() {
        let terms: Vec<String> =
            (0..row.len()).filter(|&j| row[j] != "0").map(|j| format!("({}) * {}", row[j], input(j))).collect();
        if !terms.is_empty() {
            let at = k + 1;
            text += &format!("force m{at}: Effort {{ joint: j{at}, value: {} }} ", terms.join(" + "));
        }
    }
    case(&(text + "emit forward_dynamics, inverse_dynamics { solve_for: u };"))
}

fn set_inputs(point: &mut Point, values: &[f64]) {
    for (element, &value) in values.iter().enumerate() {
        point.set(Symbol::Input { input: InputId(0), element }, value);
    }
}

/// The acceleration of each joint in the state.
fn set_accelerations(case: &Case, joints: &[&str], point: &mut Point, values: &[f64]) {
    if joints.is_empty() {
        let mut symbols: Vec<Symbol> = case.derivation.symbols.clone();
        symbols.retain(|symbol| matches!(symbol, Symbol::Acceleration { .. }));
        symbols.into_iter().zip(values).for_each(|(symbol, &value)| point.set(symbol, value));
    }
    for (name, &value) in joints.iter().zip(values) {
        point.set(Symbol::Acceleration { joint: case.joint(name), component: 0 }, value);
    }
}

/// Inputs give accelerations, these give inputs that give them again; inputs of the turned mechanism are the same. The rank
/// that is missing.
fn back_and_forth(mechanism: &Mechanism, slopes: &[&[&str]], params: [f64; 4]) -> f64 {
    let (plain, turned) = (driven(mechanism, slopes, false), driven(mechanism, slopes, true));
    let inputs = slopes.iter().map(|row| row.len()).max().unwrap_or(0);
    let rows = plain.structure.rows.len();
    let states = plain.structure.freedoms();
    let mut missing = None;
    // Guesses are random too, and few of them lead to where loops close.
    for seed in 0..if plain.structure.guesses() > 0 { 40 } else { 12 } {
        let mut point = plain.random(100 + seed);
        for (element, &value) in params.iter().enumerate() {
            point.set(Symbol::Param { param: ParamId(0), element }, value);
        }
        let mut random = Random(seed);
        let given: Vec<f64> = (0..inputs).map(|_| 3.0 * random.next()).collect();
        set_inputs(&mut point, &given);
        // Where the loop does not close there is no motion.
        let tried = plain.candidate(FunctionKind::ForwardDynamics, 0, &point);
        let is_open = plain.structure.guesses() > 0 && tried.last().is_none_or(|&residual| residual > 1e-9);
        if is_open || tried.iter().any(|x| x.is_nan()) {
            continue;
        }
        let motion = plain.eval(FunctionKind::ForwardDynamics, &point)[..states].to_vec();
        set_accelerations(&plain, mechanism.joints, &mut point, &motion);
        // Inputs that are solved for don't count.
        set_inputs(&mut point, &vec![f64::NAN; inputs]);
        let solved = plain.eval(FunctionKind::InverseDynamics, &point);
        let turned = turned.eval(FunctionKind::InverseDynamics, &point);
        assert_eq!(solved[inputs], turned[inputs], "rank with {slopes:?}");
        let lost = (inputs + rows) as f64 - solved[inputs];
        assert_eq!(*missing.get_or_insert(lost), lost);
        set_inputs(&mut point, &solved[..inputs]);
        let again = plain.eval(FunctionKind::ForwardDynamics, &point);
        close(&format!("motion with {slopes:?}"), &again[..states], &motion, 1e-12);
        if lost == 0.0 {
            // Multipliers of a loop have passed through a Schur complement on the way forward.
            let tolerance = if rows == 0 { 1e-12 } else { 1e-8 };
            // What holds a driven joint does not show in the motion.
            if !mechanism.text.contains("drive") {
                close(&format!("inputs with {slopes:?}"), &solved[..inputs], &given, tolerance);
            }
            let back: Vec<f64> = (0..inputs).map(|j| (0..inputs).map(|k| DENSE[j][k] * turned[k]).sum()).collect();
            close(&format!("turned inputs with {slopes:?}"), &solved[..inputs], &back, tolerance);
            // Near a pose where motors can't move the loop, inputs tell little of the motion: what they bring about is the same.
            set_inputs(&mut point, &back);
            let again = plain.eval(FunctionKind::ForwardDynamics, &point);
            close(&format!("motion with turned inputs, {slopes:?}"), &again[..states], &motion, 1e-12);
        }
    }
    missing.expect("seeds")
}

const DEFAULT: [f64; 4] = [10.0, 0.5, -3.0, 7.0];

/// What motors, gears, belts and differentials do to the joints of an arm; what is lost with gears of zero.
#[test]
fn motors_of_an_arm() {
    type Slopes = [[&'static str; 4]; 4];
    /// Parameters, and what they lack of the full rank.
    type Others = &'static [([f64; 4], f64)];
    let patterns: [(&str, Slopes, Others); 12] = [
        ("direct", [["1", "0", "0", "0"], ["0", "-1", "0", "0"], ["0", "0", "2.5", "0"], ["0", "0", "0", "1"]], &[]),
        ("permuted", [["0", "0", "1", "0"], ["-1", "0", "0", "0"], ["0", "0", "0", "2"], ["0", "3", "0", "0"]], &[]),
        (
            "gears",
            [["r[0]", "0", "0", "0"], ["0", "r[1]", "0", "0"], ["0", "0", "r[2]", "0"], ["0", "0", "0", "r[3]"]],
            &[
                ([10.0, 0.0, -3.0, 7.0], 1.0),
                ([0.0, 0.0, 1.0, 0.0], 3.0),
                ([1e-1, 1.0, 1e2, 1.0], 0.0),
                ([0.0; 4], 4.0),
            ],
        ),
        ("belts", [["1", "-1", "0", "0"], ["0", "1", "-1", "0"], ["0", "0", "1", "-1"], ["0", "0", "0", "1"]], &[]),
        (
            "belts of any ratio",
            [["r[0]", "0", "0", "0"], ["r[1]", "r[2]", "0", "0"], ["0", "0", "1", "0"], ["0", "r[3]", "1", "1"]],
            &[
                ([0.0, 0.5, -3.0, 7.0], 1.0),
                ([0.0, 0.5, 0.0, 7.0], 1.0),
                ([0.0, 0.5, 0.0, 0.0], 1.0),
                ([0.0, 0.0, 0.0, 7.0], 2.0),
                ([1e2, 1e-1, 1e1, 1e2], 0.0),
            ],
        ),
        (
            "a differential",
            [["2", "0", "0", "0"], ["0", "1", "1", "0"], ["0", "1", "-1", "0"], ["0", "0", "0", "1"]],
            &[],
        ),
        (
            "a differential of any ratio",
            [["1", "0", "0", "0"], ["0", "r[0]", "r[0]", "0"], ["0", "r[1]", "-r[1]", "0"], ["0", "0", "0", "r[2]"]],
            &[([0.0, 0.5, -3.0, 7.0], 1.0), ([1.0, 0.0, 0.0, 7.0], 2.0)],
        ),
        (
            "levers",
            [
                ["2 + cos(j2.angle)", "0", "0", "0"],
                ["sin(j1.angle)", "1", "0", "0"],
                ["0", "cos(j3.angle)", "2 + sin(j3.angle)", "0"],
                ["r[0]", "0", "1", "r[1]"],
            ],
            &[([1.0, 0.0, 1.0, 1.0], 1.0)],
        ),
        (
            "twice the same",
            [["1", "1", "0", "0"], ["1", "1", "0", "0"], ["0", "0", "1", "0"], ["0", "0", "0", "1"]],
            &[],
        ),
        (
            "dense",
            [["1", "2", "0.5", "1"], ["0.3", "-1", "1", "0.2"], ["1", "1", "1", "-2"], ["2", "0.1", "-0.4", "1"]],
            &[],
        ),
        (
            "dense and moving",
            [
                ["3", "sin(j1.angle)", "0.5", "1"],
                ["0.3", "-3", "j4.angle", "0.2"],
                ["1", "cos(j2.angle)", "4", "-1"],
                ["1", "0.1", "-0.4", "3 + r[0]"],
            ],
            &[],
        ),
        (
            "a wheel on a moving lever",
            [["1", "0", "0", "0"], ["sin(j1.angle)", "2", "0", "0"], ["0", "0", "0", "1"], ["r[3]", "0", "-1", "0"]],
            &[([0.0; 4], 0.0)],
        ),
    ];
    for (name, slopes, others) in patterns {
        let slopes = slopes.each_ref().map(|row| &row[..]);
        let missing = back_and_forth(&arm(), &slopes, DEFAULT);
        assert_eq!(missing, if name == "twice the same" { 1.0 } else { 0.0 }, "{name}");
        for (params, expected) in others {
            assert_eq!(back_and_forth(&arm(), &slopes, *params), *expected, "{name} {params:?}");
        }
    }
}

/// Two motors of a loop, in all formulations.
#[test]
fn motors_of_a_loop() {
    let formulations: [(&str, &[&str]); 3] = [
        ("constraints: Multipliers", &["j1", "j2", "j3", "j4"]),
        ("constraints: Multipliers, coordinates: Absolute(RollPitchYaw)", &[]),
        ("constraints: Multipliers, coordinates: Absolute(Quaternion)", &[]),
    ];
    let patterns: [&[&[&str]]; 4] = [
        &[&["1", "0"], &["0", "0"], &["0", "-1"]],
        &[&["1", "1"], &["0", "0"], &["1", "-1"]],
        &[&["r[0]", "0"], &["0", "0"], &["r[1]", "r[2]"]],
        &[&["1", "0"], &["0", "2 + sin(j1.angle)"]],
    ];
    for (formulation, joints) in formulations {
        for slopes in patterns {
            let measured = slopes.iter().flat_map(|row| row.iter()).any(|slope| slope.contains("angle"));
            if joints.is_empty() && measured {
                continue;
            }
            assert_eq!(
                back_and_forth(&five_bars(formulation, joints), slopes, DEFAULT),
                0.0,
                "{formulation} {slopes:?}"
            );
        }
    }
}

/// Loops whose coordinates are eliminated, by a formula and by iteration: motors on joints of the state, on others, on both.
#[test]
fn motors_of_an_eliminated_loop() {
    let closed =
        "constraints: Reduced } solve (j2, j4) from pin { sin(j3.angle + j4.angle - j1.angle - j2.angle) > 0.0 ";
    let patterns: [&[&[&str]]; 4] = [
        &[&["1", "0"], &["0", "0"], &["0", "-1"]],
        &[&["0", "1"], &["0", "0"], &["r[0]", "0"]],
        &[&["0", "0"], &["1", "0"], &["0", "0"], &["0", "1"]],
        &[&["1", "0"], &["0", "1"]],
    ];
    for formulation in [closed, "constraints: Reduced, rounds: 12, independent: [j1, j3]"] {
        for slopes in patterns {
            assert_eq!(back_and_forth(&five_bars(formulation, &["j1", "j3"]), slopes, DEFAULT), 0.0, "{slopes:?}");
        }
    }
}

/// A joint that follows its drive takes an input too.
#[test]
fn a_driven_joint() {
    let Mechanism { text, .. } = arm();
    let driven = Mechanism { text: text + "drive j2.angle = 0.3 + sin(t); ", joints: &["j1", "j3", "j4"] };
    let patterns: [[[&str; 4]; 4]; 2] = [
        [["1", "0", "0", "0"], ["0", "-1", "0", "0"], ["0", "0", "2.5", "0"], ["0", "0", "0", "1"]],
        [["r[0]", "0", "0", "0"], ["r[1]", "r[2]", "0", "0"], ["0", "0", "1", "0"], ["0", "r[3]", "1", "1"]],
    ];
    for slopes in patterns {
        assert_eq!(back_and_forth(&driven, &slopes.each_ref().map(|row| &row[..]), DEFAULT), 0.0, "{slopes:?}");
    }
}
