//! Forces one by one: each changes the bias by minus its Jacobian's transpose times itself.

use multibody_engine::contracts::function::FunctionKind;

use super::support::*;

const MECHANISM: &str = "
    input u: Vec3;
    world { gravity: -9.81 * Z }
    body a { mass: 1.0, com: 0.2 * X, inertia: diag(0.1, 0.2, 0.25) }
    body b { mass: 0.7, com: [0.1, 0.2, 0.0], inertia: diag(0.05, 0.04, 0.03) }
    body c { mass: 0.4, com: [0.0, 0.1, 0.3], inertia: diag(0.02, 0.03, 0.04) }
    joint one: Universal { parent: ground.at(Z), child: a, axes: [-Z, X] }
    joint two: Revolute { parent: a.at(X).rotated(X, 0.3), child: b.rotated(Y, -0.4), axis: [1.0, 2.0, 0.0] }
    joint three: Ball { parent: a.at(0.5 * Y), child: c.at(0.1 * X) }
    let p = b.at([0.1, -0.3, 0.2]);
    let q = c.at([-0.2, 0.1, 0.4]);
    output jp = p.jacobian;
    output jq = q.jacobian;
    output rotation_a = a.rotated(Y, 0.5).rotation;
    output way = q.position - p.position;
    output way_rate = q.velocity - p.velocity;
    output p_velocity = p.velocity;
    output rates = [one.first.rate, one.second.rate, two.rate];
    output position = p.position;
    emit bias;";

/// Bias with the force less bias without it.
fn added(force: &str, check: impl Fn(&Case, &Point) -> Vec<f64>) {
    let without = case(MECHANISM);
    let with = case(&format!("{MECHANISM} {force}"));
    for seed in 1..4 {
        let point = without.random(seed);
        let (a, b) = (with.eval(FunctionKind::Bias, &point), without.eval(FunctionKind::Bias, &point));
        let effort: Vec<f64> = a.iter().zip(&b).map(|(a, b)| b - a).collect();
        close(force, &effort, &check(&without, &point), 1e-12);
    }
}

/// J^T times a wrench.
fn transposed(case: &Case, point: &Point, jacobian: &str, force: [f64; 3], moment: [f64; 3]) -> Vec<f64> {
    let j = case.output(jacobian, point);
    let n = case.dof();
    let wrench = [force, moment].concat();
    (0..n).map(|k| (0..6).map(|row| j[row * n + k] * wrench[row]).sum()).collect()
}

fn input(case: &Case, point: &Point) -> [f64; 3] {
    use multibody_engine::contracts::symbol::Symbol;
    use multibody_engine::model::types::InputId;
    assert_eq!(case.model.inputs.len(), 1);
    [0, 1, 2].map(|element| point.get(Symbol::Input { input: InputId(0), element }))
}

fn matrix(list: &[f64]) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| list[3 * i + j]))
}

fn three(list: &[f64]) -> [f64; 3] {
    std::array::from_fn(|k| list[k])
}

#[test]
fn at_frames() {
    added("force f: Force { at: p, value: u, axes: ground }", |case, point| {
        transposed(case, point, "jp", input(case, point), [0.0; 3])
    });
    added("force f: Torque { at: q, value: u, axes: ground }", |case, point| {
        transposed(case, point, "jq", [0.0; 3], input(case, point))
    });
    added("force f: Force { at: p, value: u, axes: a.rotated(Y, 0.5) }", |case, point| {
        let turned = apply(&matrix(&case.output("rotation_a", point)), &input(case, point));
        transposed(case, point, "jp", turned, [0.0; 3])
    });
    added("force f: Force { at: q, value: u, axes: ground.rotated(Y, 0.5) }", |case, point| {
        transposed(case, point, "jq", apply(&turn([0.0, 1.0, 0.0], 0.5), &input(case, point)), [0.0; 3])
    });
    added("force f: Force { at: p, value: u - 2.0 * p.velocity, axes: ground }", |case, point| {
        let (u, v) = (input(case, point), case.output("p_velocity", point));
        transposed(case, point, "jp", [0, 1, 2].map(|k| u[k] - 2.0 * v[k]), [0.0; 3])
    });
    added("force f: Force { at: ground, value: u, axes: ground }", |case, _| vec![0.0; case.dof()]);
}

#[test]
fn along_lines() {
    let check = |text: &str, stiffness: f64, damping: f64, length: f64| {
        let text = format!("force f: {text} }}");
        added(&text, |case, point| {
            let (d, rate) = (three(&case.output("way", point)), three(&case.output("way_rate", point)));
            let long = d.iter().map(|x| x * x).sum::<f64>().sqrt();
            let fast = (0..3).map(|k| d[k] * rate[k]).sum::<f64>() / long;
            let tension = (stiffness * (long - length) + damping * fast) / long;
            let far = transposed(case, point, "jq", d.map(|x| -tension * x), [0.0; 3]);
            let near = transposed(case, point, "jp", d.map(|x| tension * x), [0.0; 3]);
            far.iter().zip(&near).map(|(a, b)| a + b).collect()
        });
    };
    check("Spring { between: [p, q], stiffness: 3.0, length: 0.0", 3.0, 0.0, 0.0);
    check("Spring { between: [p, q], stiffness: 3.0, length: 0.4", 3.0, 0.0, 0.4);
    check("Spring { between: [q, p], stiffness: 3.0, length: 0.4", 3.0, 0.0, 0.4);
    check("Damper { between: [p, q], damping: 0.6", 0.0, 0.6, 0.0);
    check("SpringDamper { between: [p, q], stiffness: 3.0, damping: 0.6, length: 0.0", 3.0, 0.6, 0.0);
    check("SpringDamper { between: [p, q], stiffness: 3.0, damping: 0.6, length: 0.3", 3.0, 0.6, 0.3);
    added("force f: Spring { between: [ground.at(X), p], stiffness: 3.0, length: 0.2 }", |case, point| {
        let at = case.output("position", point);
        let d = [at[0] - 1.0, at[1], at[2]];
        let long = d.iter().map(|x| x * x).sum::<f64>().sqrt();
        transposed(case, point, "jp", d.map(|x| -3.0 * (long - 0.2) / long * x), [0.0; 3])
    });
    added("force f: Spring { between: [p, b], stiffness: 3.0, length: 0.2 }", |case, _| vec![0.0; case.dof()]);
}

#[test]
fn on_coordinates() {
    added("force f: Effort { joint: two, value: 2.0 * u.x }", |case, point| {
        vec![0.0, 0.0, 2.0 * input(case, point)[0], 0.0, 0.0, 0.0]
    });
    added("force f: Effort { joint: three, value: u }", |case, point| {
        [vec![0.0; 3], input(case, point).to_vec()].concat()
    });
    added("force f: Damper { joint: one.first, damping: 0.4 }", |case, point| {
        vec![-0.4 * case.output("rates", point)[0], 0.0, 0.0, 0.0, 0.0, 0.0]
    });
}

#[test]
fn efforts_add_up() {
    let case = case(&format!(
        "{MECHANISM}
        force f: Effort {{ joint: one.second, value: u.x }}
        force g: SpringDamper {{ joint: one.second, stiffness: 2.0, damping: 0.5, rest: 0.1 }}
        output sum = one.second.effort;
        output angle = one.second;
        output other = two.effort;"
    ));
    let point = case.random(9);
    let expected =
        input(&case, &point)[0] - 2.0 * (case.output("angle", &point)[0] - 0.1) - 0.5 * case.output("rates", &point)[1];
    close("effort", &case.output("sum", &point), &[expected], 1e-14);
    assert_eq!(case.output("other", &point), [0.0]);
}
