//! Every joint kind against plain matrices: place and orientation of the child, and its velocity by differences.

use multibody_engine::contracts::symbol::Symbol;

use super::support::*;

/// Parent and child frames off their bodies' origins and turned; a second joint so that the parent moves too.
fn declaration(kind: &str) -> String {
    let (kind, fields) = kind.split_once('{').expect("fields");
    format!(
        "param p = [0.3, -0.2, 0.5];
        param tilt = 0.4;
        world {{ gravity: [0.3, -9.0, 1.0] }}
        body base {{ mass: 1.3, com: [0.1, 0.2, -0.1], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }}
        body arm {{ mass: 0.8, com: [0.2, -0.1, 0.3], inertia: inertia(0.2, 0.3, 0.25, 0.01, 0.02, -0.03) }}
        joint first: Revolute {{ parent: ground.at([0.1, 0.2, 0.3]), child: base, axis: [1.0, 2.0, -0.5] }}
        joint j: {kind} {{ parent: base.at(p).rotated([1.0, 1.0, 0.0], tilt), child: arm.rotated(X, 0.3).at([-0.1, 0.4, 0.2]).rotated(-Y, 1.1), {fields} }}
        output position = arm.at([0.5, 0.1, -0.2]).position;
        output rotation = arm.rotated(Z, 0.2).rotation;
        output velocity = arm.at([0.5, 0.1, -0.2]).velocity;
        output angular = arm.angular_velocity;
        output pose = arm.pose;
        output acceleration = arm.at([0.5, 0.1, -0.2]).acceleration;
        output angular_acceleration = arm.angular_acceleration;
        output jacobian = arm.at([0.5, 0.1, -0.2]).jacobian;
        output own_jacobian = arm.at([0.5, 0.1, -0.2]).jacobian.express(arm.rotated(Y, 0.7));
        output base_jacobian = arm.at([0.5, 0.1, -0.2]).jacobian.express(base.rotated(Y, 0.7));
        output own_velocity = arm.rotated(Y, 0.7).express(arm.at([0.5, 0.1, -0.2]).velocity);
        output own_angular = arm.rotated(Y, 0.7).express(arm.angular_velocity);
        output between = base.express(arm.at([0.5, 0.1, -0.2]).position - base.position);
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;"
    )
}

type Place = (Matrix, [f64; 3]);

fn then(a: &Place, b: &Place) -> Place {
    (times(&a.0, &b.0), plus(&a.1, &apply(&a.0, &b.1)))
}

fn inverse(a: &Place) -> Place {
    let r = transpose(&a.0);
    let back = apply(&r, &a.1);
    (r, back.map(|x| -x))
}

/// Pose of `arm` from the pose of the joint.
fn arm(first: f64, joint: &Place) -> Place {
    let base = (turn([1.0, 2.0, -0.5], first), [0.1, 0.2, 0.3]);
    let parent = (turn([1.0, 1.0, 0.0], 0.4), [0.3, -0.2, 0.5]);
    let child = then(&(turn([1.0, 0.0, 0.0], 0.3), [0.0; 3]), &(ONE, [-0.1, 0.4, 0.2]));
    let child = then(&child, &(turn([0.0, -1.0, 0.0], 1.1), [0.0; 3]));
    then(&then(&then(&base, &parent), joint), &inverse(&child))
}

fn check(kind: &str, joint: impl Fn(&[f64]) -> Place) {
    let case = case(&declaration(kind));
    for seed in 1..4 {
        let point = case.random(seed);
        let id = case.joint("j");
        let positions: Vec<f64> =
            (0..7).map_while(|component| known(&case, &point, Symbol::Position { joint: id, component })).collect();
        let first = point.get(Symbol::Position { joint: case.joint("first"), component: 0 });
        let (r, p) = arm(first, &joint(&positions));
        let tip = plus(&p, &apply(&r, &[0.5, 0.1, -0.2]));
        close(&format!("{kind} position"), &case.output("position", &point), &tip, 1e-13);
        let turned = times(&r, &turn([0.0, 0.0, 1.0], 0.2));
        close(&format!("{kind} rotation"), &case.output("rotation", &point), turned.as_flattened(), 1e-13);
        let pose = case.output("pose", &point);
        close(&format!("{kind} pose"), &pose[..3], &p, 1e-13);
        close(&format!("{kind} orientation"), of_quaternion(&pose[3..]).as_flattened(), r.as_flattened(), 1e-13);
        velocities(kind, &case, &point);
        dynamics(kind, &case, &point);
    }
}

fn known(case: &Case, point: &Point, symbol: Symbol) -> Option<f64> {
    case.derivation.symbols.contains(&symbol).then(|| point.get(symbol))
}

fn velocities(kind: &str, case: &Case, point: &Point) {
    let v = case.velocity(point);
    let still = vec![0.0; v.len()];
    let at = |h: f64| case.displaced(point, h, &v, &still, &[]);
    let velocity = case.output("velocity", point);
    let angular = case.output("angular", point);
    close(&format!("{kind} velocity"), &velocity, &case.derivative(|h| case.output("position", &at(h))), 1e-9);
    let rows = case.output("rotation", point);
    let expected: Vec<f64> = (0..9)
        .map(|k| {
            let (i, j) = (k / 3, k % 3);
            let (a, b) = ((i + 1) % 3, (i + 2) % 3);
            angular[a] * rows[3 * b + j] - angular[b] * rows[3 * a + j]
        })
        .collect();
    let differences = case.derivative(|h| case.output("rotation", &at(h)));
    close(&format!("{kind} angular velocity"), &expected, &differences, 1e-9);
    let twist = [velocity.clone(), angular.clone()].concat();
    let times_v = |name: &str| -> Vec<f64> {
        let jacobian = case.output(name, point);
        jacobian.chunks(v.len()).map(|row| row.iter().zip(&v).map(|(a, b)| a * b).sum()).collect()
    };
    close(&format!("{kind} Jacobian"), &times_v("jacobian"), &twist, 1e-13);
    let own = [case.output("own_velocity", point), case.output("own_angular", point)].concat();
    close(&format!("{kind} Jacobian in the frame's axes"), &times_v("own_jacobian"), &own, 1e-13);
    let norm = |list: &[f64]| list.iter().map(|x| x * x).sum::<f64>();
    let base = times_v("base_jacobian");
    close(
        "lengths do not depend on axes",
        &[norm(&base[..3]), norm(&base[3..])],
        &[norm(&velocity), norm(&angular)],
        1e-12,
    );
}

fn dynamics(kind: &str, case: &Case, point: &Point) {
    use multibody_engine::contracts::function::FunctionKind::*;
    let n = case.dof();
    let accelerations = case.eval(ForwardDynamics, point);
    let bias = case.eval(Bias, point);
    let matrix = case.eval(MassMatrix, point);
    let product = |a: &[f64]| -> Vec<f64> {
        (0..n).map(|i| bias[i] + (0..n).map(|j| matrix[i * n + j] * a[j]).sum::<f64>()).collect()
    };
    close(&format!("{kind} equations of motion"), &product(&accelerations), &vec![0.0; n], 1e-10);
    let given = case.acceleration(point);
    close(&format!("{kind} inverse dynamics"), &case.eval(InverseDynamics, point), &product(&given), 1e-12);
    let v = case.velocity(point);
    let quadratic: f64 = (0..n * n).map(|k| 0.5 * v[k / n] * matrix[k] * v[k % n]).sum();
    let kinetic = case.eval(KineticEnergy, point)[0];
    close(&format!("{kind} kinetic energy"), &[kinetic], &[quadratic], 1e-12);
    let energy = case.rate_along_flow(point, |p| case.output("energy", p));
    close(&format!("{kind} energy is kept"), &energy, &[0.0], 1e-7);
    let tip = case.rate_along_flow(point, |p| case.output("velocity", p));
    close(&format!("{kind} acceleration"), &case.output("acceleration", point), &tip, 1e-7);
    let spin = case.rate_along_flow(point, |p| case.output("angular", p));
    close(&format!("{kind} angular acceleration"), &case.output("angular_acceleration", point), &spin, 1e-7);
}

const AXES: [(&str, [f64; 3]); 6] = [
    ("X", [1.0, 0.0, 0.0]),
    ("-Y", [0.0, -1.0, 0.0]),
    ("2.0 * Z", [0.0, 0.0, 2.0]),
    ("[0.0, 1.0, -1.0]", [0.0, 1.0, -1.0]),
    ("[-3.0, 0.0, 1.0]", [-3.0, 0.0, 1.0]),
    ("[-0.3, 0.4, -0.7]", [-0.3, 0.4, -0.7]),
];

fn along(axis: [f64; 3], length: f64) -> [f64; 3] {
    let norm = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    axis.map(|x| x / norm * length)
}

#[test]
fn fixed() {
    check("Fixed {", |_| (ONE, [0.0; 3]));
}

#[test]
fn one_coordinate() {
    for (text, axis) in AXES {
        check(&format!("Revolute {{ axis: {text}, armature: 0.1"), |q| (turn(axis, q[0]), [0.0; 3]));
        check(&format!("Prismatic {{ axis: {text}"), |q| (ONE, along(axis, q[0])));
        check(&format!("Screw {{ axis: {text}, pitch: 0.3"), |q| (turn(axis, q[0]), along(axis, 0.3 * q[0])));
        check(&format!("Cylindrical {{ axis: {text}"), |q| (turn(axis, q[1]), along(axis, q[0])));
    }
}

#[test]
fn axis_of_parameters() {
    check("Revolute { axis: [p.x, p.y, p.z]", |q| (turn([0.3, -0.2, 0.5], q[0]), [0.0; 3]));
    check("Revolute { axis: [0.0, p.y, p.z]", |q| (turn([0.0, -0.2, 0.5], q[0]), [0.0; 3]));
    check("Revolute { axis: [0.0, p.y, 0.0]", |q| (turn([0.0, -0.2, 0.0], q[0]), [0.0; 3]));
}

#[test]
fn universal() {
    check("Universal { axes: [X, Y]", |q| {
        (times(&turn([1.0, 0.0, 0.0], q[0]), &turn([0.0, 1.0, 0.0], q[1])), [0.0; 3])
    });
    check("Universal { axes: [-Z, [1.0, 2.0, 0.0]]", |q| {
        (times(&turn([0.0, 0.0, -1.0], q[0]), &turn([1.0, 2.0, 0.0], q[1])), [0.0; 3])
    });
    check("Universal { axes: [[1.0, 1.0, 1.0], [1.0, -1.0, 0.0]]", |q| {
        (times(&turn([1.0, 1.0, 1.0], q[0]), &turn([1.0, -1.0, 0.0], q[1])), [0.0; 3])
    });
}

#[test]
fn planar() {
    for (k, text) in ["X", "Y", "Z"].into_iter().enumerate() {
        for sign in ["", "-"] {
            check(&format!("Planar {{ axis: {sign}{text}"), |q| {
                let mut axis = [0.0; 3];
                axis[k] = if sign.is_empty() { 1.0 } else { -1.0 };
                let mut travel = [0.0; 3];
                travel[(k + 1) % 3] = q[0];
                travel[(k + 2) % 3] = q[1];
                (turn(axis, q[2]), travel)
            });
        }
    }
}

/// Pairs of perpendicular directions: along coordinate axes, oblique, typed, and of parameters.
const PAIRS: [(&str, [f64; 3], [f64; 3]); 9] = [
    ("X, Z", [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("X, Y", [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ("-Z, Y", [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
    ("Y, -2.0 * Z", [0.0, 1.0, 0.0], [0.0, 0.0, -2.0]),
    ("X, [0.0, -1.0, 1.0]", [1.0, 0.0, 0.0], [0.0, -1.0, 1.0]),
    ("[1.0, 1.0, 1.0], [1.0, -1.0, 0.0]", [1.0, 1.0, 1.0], [1.0, -1.0, 0.0]),
    ("[-3.0, 0.0, 4.0], -Y", [-3.0, 0.0, 4.0], [0.0, -1.0, 0.0]),
    ("[0.3, -0.4, 1.2], [0.8, 0.6, 0.0]", [0.3, -0.4, 1.2], [0.8, 0.6, 0.0]),
    ("[p.x, p.y, 0.0], [-p.y, p.x, 0.0]", [0.3, -0.2, 0.0], [0.2, 0.3, 0.0]),
];

#[test]
fn planar_along_two_axes() {
    for (text, first, second) in PAIRS {
        check(&format!("Planar {{ axes: [{text}]"), |q| {
            (turn(cross(first, second), q[2]), plus(&along(first, q[0]), &along(second, q[1])))
        });
    }
}

#[test]
fn pin_in_a_slot() {
    for (text, axis, slide) in PAIRS {
        let (a, b) = split(text);
        check(&format!("PinSlot {{ axis: {a}, slide: {b}"), |q| (turn(axis, q[1]), along(slide, q[0])));
    }
}

/// At the comma between two directions.
fn split(text: &str) -> (&str, &str) {
    let at = if text.starts_with('[') { text.find("],").map_or(0, |at| at + 1) } else { text.find(',').unwrap_or(0) };
    (&text[..at], text[at + 1..].trim())
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn roll_pitch_yaw(q: &[f64]) -> Matrix {
    let (roll, pitch, yaw) = (turn([1.0, 0.0, 0.0], q[0]), turn([0.0, 1.0, 0.0], q[1]), turn([0.0, 0.0, 1.0], q[2]));
    times(&times(&yaw, &pitch), &roll)
}

#[test]
fn ball() {
    check("Ball {", |q| (of_quaternion(q), [0.0; 3]));
    check("Ball { coordinates: RollPitchYaw", |q| (roll_pitch_yaw(q), [0.0; 3]));
}

#[test]
fn free() {
    check("Free {", |q| (of_quaternion(&q[3..]), [q[0], q[1], q[2]]));
    check("Free { coordinates: RollPitchYaw", |q| (roll_pitch_yaw(&q[3..]), [q[0], q[1], q[2]]));
}
