//! The robots of `scripts/robots.py`, against the same typed in, and against a reader, a recursion and an elimination of their own.

use std::fs;
use std::path::Path;

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::{JointId, Model};
use proc_macro2::{Delimiter, TokenStream, TokenTree};

use crate::recursion::{Link, Matrix, Vector, links, motions, recursion, turn};
use crate::support::{assert_same, assert_same_at, evaluated, model_of, value};
use crate::ties::{Ties, gauss};

const FUNCTIONS: &str = "emit forward_dynamics, inverse_dynamics, mass_matrix, bias;";
const GRAVITY: Vector = [0.0, 0.0, -9.81];

fn data(file: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/robots").join(file)).unwrap()
}

/// A robot of `typed_in.rs` with what a test asks of it.
fn typed_in(name: &str, more: &str) -> Model {
    let tokens: TokenStream = data("typed_in.rs").replace("{functions}", more).parse().unwrap();
    let calls = tokens.into_iter().filter_map(|token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(group.stream().to_string()),
        _ => None,
    });
    let call = calls.into_iter().find(|call| call.starts_with(&format!("pub mod {name} "))).unwrap();
    model_of(&call, "")
}

fn read(name: &str, base: &str, more: &str) -> Model {
    let call =
        format!("mod m {{ world {{ gravity: -9.81 * Z }} part r: Urdf {{ file: \"r.urdf\", base: {base} }}; {more} }}");
    model_of(&call, &data(&format!("{name}.urdf")))
}

/// A number for each symbol, positions so small that loops close.
fn small(symbol: Symbol) -> f64 {
    let is_position = matches!(symbol, Symbol::Position { .. });
    if is_position { 0.25 * value(symbol) } else { value(symbol) }
}

/// The coordinates of a model in its order, and where it is.
struct State {
    joints: Vec<String>,
    ids: Vec<(JointId, usize)>,
    base: (Vector, Matrix),
    q: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    quaternion: [f64; 4],
}

impl State {
    fn of(model: &Model, links: &[Link]) -> State {
        let angle = 0.9_f64;
        let axis = [2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0];
        let (s, c) = (angle / 2.0).sin_cos();
        let quaternion = [c, s * axis[0], s * axis[1], s * axis[2]];
        let mut state = State {
            joints: Vec::new(),
            ids: Vec::new(),
            base: ([0.0; 3], turn([0.0, 0.0, 1.0], 0.0)),
            q: Vec::new(),
            v: Vec::new(),
            a: Vec::new(),
            quaternion,
        };
        for joint in (0..model.joints.len()).map(JointId) {
            let name = model.joints[joint].place.field.to_string();
            if name.ends_with("floating") {
                state.base.1 = turn(axis, angle);
                for component in 0..6 {
                    state.enter(if component == 0 { "floating" } else { "" }, (joint, component));
                }
                state.base.0 = [0, 1, 2].map(|k| state.q[k]);
            } else if let Some(link) = links.iter().find(|link| link.kind != "fixed" && name.ends_with(&link.joint)) {
                state.enter(&link.joint, (joint, 0));
            }
        }
        state
    }

    fn enter(&mut self, name: &str, (joint, component): (JointId, usize)) {
        self.joints.push(name.to_owned());
        self.ids.push((joint, component));
        self.q.push(small(Symbol::Position { joint, component }));
        self.v.push(value(Symbol::Velocity { joint, component }));
        self.a.push(value(Symbol::Acceleration { joint, component }));
    }

    fn value(&self, symbol: Symbol) -> f64 {
        let of =
            |list: &[f64], joint, component| list[self.ids.iter().position(|id| *id == (joint, component)).unwrap()];
        match symbol {
            Symbol::Position { joint, component: component @ 3.. } => {
                assert!(self.ids.contains(&(joint, 5)));
                self.quaternion[component - 3]
            }
            Symbol::Position { joint, component } => of(&self.q, joint, component),
            Symbol::Velocity { joint, component } => of(&self.v, joint, component),
            Symbol::Acceleration { joint, component } => of(&self.a, joint, component),
            other => value(other),
        }
    }
}

fn times(matrix: &[Vec<f64>], vector: &[f64]) -> Vec<f64> {
    matrix.iter().map(|row| row.iter().zip(vector).map(|(m, x)| m * x).sum()).collect()
}

fn transposed(matrix: &[Vec<f64>]) -> Vec<Vec<f64>> {
    (0..matrix[0].len()).map(|k| matrix.iter().map(|row| row[k]).collect()).collect()
}

fn sum(a: Vec<f64>, b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x + y).collect()
}

/// The four functions, in coordinates of which some follow, with accelerations by multipliers.
fn wanted(text: &str, links: &[Link], state: &mut State, follows: &[bool]) -> Vec<(FunctionKind, Vec<f64>)> {
    let ties = Ties::read(text, links, &state.joints);
    let own: Vec<usize> = (0..follows.len()).filter(|k| !follows[*k]).collect();
    let following: Vec<usize> = (0..follows.len()).filter(|k| follows[*k]).collect();
    // Solves for coordinates that follow, of which a row's others are on the right.
    let follow = |rows: &[Vec<f64>], right: Vec<f64>| {
        let rows = rows.iter().map(|row| following.iter().map(|k| row[*k]).collect()).collect();
        gauss(rows, right)
    };
    let rows_at = |q: &[f64], v: &[f64]| ties.rows(&motions(links, &state.joints, &state.base, GRAVITY, [q, v]), q);
    let (mut q, mut v) = (state.q.clone(), state.v.clone());
    for k in &following {
        q[*k] = 0.0;
        v[*k] = 0.0;
    }
    for _ in 0..20 {
        let rows = rows_at(&q, &v);
        let step = follow(&rows.jacobian, rows.error);
        following.iter().zip(step).for_each(|(k, step)| q[*k] -= step);
    }
    let rows = rows_at(&q, &v);
    assert!(rows.error.iter().all(|error| error.abs() < 1e-14), "{:?}", rows.error);
    // Velocities and accelerations are a matrix times those that are free.
    let mut map = vec![vec![0.0; own.len()]; follows.len()];
    for (column, k) in own.iter().enumerate() {
        map[*k][column] = 1.0;
        let right = rows.jacobian.iter().map(|row| -row[*k]).collect();
        following.iter().zip(follow(&rows.jacobian, right)).for_each(|(k, x)| map[*k][column] = x);
    }
    let free: Vec<f64> = own.iter().map(|k| v[*k]).collect();
    v = times(&map, &free);
    let rows = rows_at(&q, &v);
    let (matrix, bias) = recursion(links, &state.joints, &state.base, GRAVITY, [&q, &v]);

    let mut rest = vec![0.0; follows.len()];
    let right = rows.acceleration.iter().map(|x| -x).collect();
    following.iter().zip(follow(&rows.jacobian, right)).for_each(|(k, x)| rest[*k] = x);
    let back = transposed(&map);
    let reduced_bias = times(&back, &sum(times(&matrix, &rest), &bias));
    let columns: Vec<Vec<f64>> = transposed(&map).iter().map(|column| times(&back, &times(&matrix, column))).collect();
    let given: Vec<f64> = own.iter().map(|k| state.a[*k]).collect();
    let efforts = sum(times(&columns, &given), &reduced_bias);

    // M a - J' l = -b and J a = -c
    let mut system: Vec<Vec<f64>> = Vec::new();
    for (k, row) in matrix.iter().enumerate() {
        system.push(row.iter().copied().chain(rows.jacobian.iter().map(|tie| -tie[k])).collect());
    }
    let zeros = vec![0.0; rows.jacobian.len()];
    system.extend(rows.jacobian.iter().map(|row| row.iter().chain(&zeros).copied().collect()));
    let accelerations = gauss(system, bias.iter().chain(&rows.acceleration).map(|x| -x).collect());
    (state.q, state.v) = (q, v);
    vec![
        (FunctionKind::MassMatrix, columns.concat()),
        (FunctionKind::Bias, reduced_bias),
        (FunctionKind::InverseDynamics, efforts),
        (FunctionKind::ForwardDynamics, own.iter().map(|k| accelerations[*k]).collect()),
    ]
}

/// A robot whose joints of `follows` are not coordinates.
fn assert_true(name: &str, model: &Model, follows: &[&str], tolerance: f64) {
    let text = data(&format!("{name}.urdf"));
    let mut links = links(&text);
    if model.joints.iter().any(|joint| joint.place.field.to_string().ends_with("floating")) {
        "floating".clone_into(&mut links[0].kind);
        "floating".clone_into(&mut links[0].joint);
    }
    let mut state = State::of(model, &links);
    let follows: Vec<bool> = state.joints.iter().map(|joint| follows.contains(&joint.as_str())).collect();
    let wanted = wanted(&text, &links, &mut state, &follows);
    let found = evaluated(model, &|symbol| state.value(symbol));
    for (kind, want) in wanted {
        let got = &found[&kind].0;
        assert_eq!(got.len(), want.len(), "{kind:?} of {name}");
        let size = want.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        for (x, y) in got.iter().zip(&want) {
            assert!((x - y).abs() <= tolerance * size, "{kind:?} of {name}: {x} and {y}");
        }
    }
}

/// Six coordinates of the trunk and twelve of the legs.
#[test]
fn a_quadruped_floats() {
    let robot = read("quadruped", "Free", FUNCTIONS);
    assert_same(&typed_in("quadruped", FUNCTIONS), &robot, true);
    assert_true("quadruped", &robot, &[], 1e-12);
}

#[test]
fn a_humanoid_has_thirty_joints() {
    let robot = read("humanoid", "Free", FUNCTIONS);
    assert_same(&typed_in("humanoid", FUNCTIONS), &robot, true);
    assert_true("humanoid", &robot, &[], 1e-12);
}

/// The second finger follows the first.
#[test]
fn an_arm_rides_on_a_rail() {
    let reduced = format!("formulation {{ constraints: Reduced }} {FUNCTIONS}");
    let robot = read("rail_arm", "ground", &reduced);
    assert_same(&typed_in("rail_arm", &reduced), &robot, true);
    assert_true("rail_arm", &robot, &["finger_slide"], 1e-12);
}

/// One line closes each ankle; the rotors of the knees follow by their gears.
#[test]
fn ankles_of_a_biped_have_closed_forms() {
    let lines = |part: &str| {
        let solve = |side: &str| {
            let [rod, ankle, crank, pin] =
                ["rod_pivot", "ankle", "crank_drive", "pin"].map(|name| format!("{part}{side}_{name}"));
            format!("solve ({rod}, {ankle}) from {pin} {{ cos({ankle} - {crank} - {rod}) > 0.0 }}")
        };
        format!("formulation {{ constraints: Reduced }} {} {} {FUNCTIONS}", solve("left"), solve("right"))
    };
    let robot = read("biped", "Free", &lines("r."));
    assert_same_at(&small, &typed_in("biped", &lines("")), &robot, true);
    let follows = ["rod_pivot", "ankle", "knee_rotor"];
    let follows: Vec<String> =
        ["left", "right"].iter().flat_map(|side| follows.map(|name| format!("{side}_{name}"))).collect();
    let follows: Vec<&str> = follows.iter().map(String::as_str).collect();
    assert_true("biped", &robot, &follows, 1e-12);
}
