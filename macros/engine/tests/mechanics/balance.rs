//! Energy and power: what forces put in is what the mechanism's energy gains.

use multibody_engine::contracts::function::FunctionKind;

use super::support::*;

/// One of everything.
const ZOO: &str = "
    param k = 30.0;
    param points = [[0.3, 0.1, -0.2], [-0.2, 0.5, 0.1]];
    input u;
    input push: Vec3;
    world { gravity: [0.5, -9.0, 1.0] }
    body hull { mass: 2.0, com: [0.1, 0.0, -0.1], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }
    body mast { mass: 0.5, com: 0.4 * Z, inertia: diag(0.1, 0.1, 0.02) }
    body boom { mass: 0.4, com: 0.3 * X, inertia: cylinder(0.4, 0.05, 0.6, X) }
    body weight { mass: 0.3 }
    body ball { mass: 0.6, com: [0.0, 0.1, 0.05], inertia: sphere(0.6, 0.1) }
    body nut { mass: 0.2, com: [0.01, 0.0, 0.0], inertia: diag(0.01, 0.012, 0.02) }
    body puck { mass: 0.7, com: [0.1, 0.0, 0.0], inertia: cuboid(0.7, [0.3, 0.2, 0.1]) }
    body tag { mass: 0.1, com: 0.1 * Y, inertia: diag(0.001, 0.002, 0.003) }
    joint float: Free { parent: ground, child: hull }
    joint gimbal: Universal { parent: hull.at(points[0]), child: mast, axes: [X, [0.0, 1.0, 1.0]] }
    joint reach: Cylindrical { parent: mast.at(0.8 * Z), child: boom.rotated(Y, 0.2), axis: -Z }
    joint slide: Prismatic { parent: boom, child: weight, axis: X, armature: 0.05 }
    joint socket: Ball { parent: hull.at(points[1]).rotated(X, 0.3), child: ball, coordinates: RollPitchYaw }
    joint thread: Screw { parent: hull, child: nut, axis: [0.0, 1.0, -1.0], pitch: 0.05, armature: 0.02 }
    joint table: Planar { parent: ground.rotated(X, 0.4), child: puck, axis: Z }
    joint glue: Fixed { parent: puck.at(0.2 * X).rotated(Z, 0.5), child: tag }
    state charge: rate = (u - 2.0 * charge - 0.3 * slide.rate) / 0.5, start: 0.1;
    let tip = boom.at(0.6 * X);
    force motor: Effort { joint: slide, value: 4.0 * charge }
    force wind: Force { at: tip, value: [0.2 * t, push.y, -0.3 * tip.velocity.z], axes: ground }
    force drag: Force { at: hull.at(0.1 * Y), value: -0.4 * hull.at(0.1 * Y).velocity, axes: ground }
    force jet: Force { at: hull.at(points[1]), value: push, axes: hull.rotated(Z, 0.3) }
    force side: Force { at: puck.at(0.1 * Y), value: [1.0, u, 0.5], axes: mast }
    force twist: Torque { at: ball, value: [0.1, push.x, 0.2], axes: boom }
    force spin: Torque { at: mast, value: 0.2 * push - 0.1 * mast.angular_velocity, axes: ground }
    force free_effort: Effort { joint: float, value: [0.1, 0.2, u, 0.3, -0.1, 0.05] }
    force ball_effort: Effort { joint: socket, value: [0.1, 0.2, u] }
    force hinge: Damper { joint: gimbal.first, damping: 0.3 }
    force piston: Damper { between: [mast.at(0.1 * X), weight], damping: 0.7 }
    force coil: Spring { joint: gimbal.second, stiffness: k, rest: 0.2 }
    force bungee: Spring { between: [ground.at(Y), weight], stiffness: k, length: 0.0 }
    force band: Spring { between: [puck, tip], stiffness: 12.0, length: 0.3 }
    force bushing: SpringDamper { between: [ball.at(0.2 * X), boom], stiffness: 9.0, damping: 0.8, length: 0.25 }
    force wobble: SpringDamper { joint: thread, stiffness: 3.0, damping: 0.2, rest: 0.1 }
    output motor_power = motor.power;
    output powers = [wind.power, drag.power, jet.power, side.power, twist.power, spin.power, free_effort.power,
        ball_effort.power, hinge.power, piston.power];
    output elastic = [coil.power, bungee.power, band.power];
    output bushings = [bushing.power, wobble.power];
    output way = weight.position - mast.at(0.1 * X).position;
    output loss = 0.2 * powi(thread.rate, 2);
    output line = ball.at(0.2 * X).position - boom.position;
    output total = kinetic() + potential();
    output motion = kinetic();
    emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;";

#[test]
fn energy_gains_what_forces_put_in() {
    let case = case(ZOO);
    for seed in 1..4 {
        let point = case.random(seed);
        let put_in: f64 = case.output("motor_power", &point)[0] + case.output("powers", &point).iter().sum::<f64>();
        // The viscous parts of the two that are springs and dampers at once.
        let length = |p: &Point| vec![case.output("line", p).iter().map(|x| x * x).sum::<f64>().sqrt()];
        let rate = case.rate_along_flow(&point, length)[0];
        let lost = 0.8 * rate * rate + case.output("loss", &point)[0];
        let gain = case.rate_along_flow(&point, |p| case.output("total", p))[0];
        close("power balance", &[gain], &[put_in - lost], 1e-6);
    }
}

#[test]
fn springs_give_back_what_they_hold() {
    let case = case(ZOO);
    let without = case_without_springs();
    let point = case.random(5);
    let springs = |p: &Point| {
        let all = case.eval(FunctionKind::PotentialEnergy, p)[0];
        vec![all - without.eval(FunctionKind::PotentialEnergy, p)[0]]
    };
    let length = |p: &Point| vec![case.output("line", p).iter().map(|x| x * x).sum::<f64>().sqrt()];
    let rate = case.rate_along_flow(&point, length)[0];
    let lost = 0.8 * rate * rate + case.output("loss", &point)[0];
    let given: f64 =
        case.output("elastic", &point).iter().sum::<f64>() + case.output("bushings", &point).iter().sum::<f64>() + lost;
    close("elastic power", &case.rate_along_flow(&point, springs), &[-given], 1e-6);
}

fn case_without_springs() -> Case {
    let kept =
        |line: &&str| !line.contains("Spring") && !line.contains("output elastic") && !line.contains("output bushings");
    case(&ZOO.lines().filter(kept).collect::<Vec<&str>>().join("\n"))
}

#[test]
fn forward_undoes_inverse() {
    let case = case(ZOO);
    let n = case.dof();
    for seed in 11..14 {
        let point = case.random(seed);
        let matrix = case.eval(FunctionKind::MassMatrix, &point);
        let bias = case.eval(FunctionKind::Bias, &point);
        let a = case.eval(FunctionKind::ForwardDynamics, &point);
        let product = |a: &[f64]| -> Vec<f64> {
            (0..n).map(|i| (0..n).map(|j| matrix[i * n + j] * a[j]).sum::<f64>() + bias[i]).collect()
        };
        close("equations of motion", &product(&a[..n]), &vec![0.0; n], 1e-9);
        let given = case.acceleration(&point);
        close("inverse dynamics", &case.eval(FunctionKind::InverseDynamics, &point), &product(&given), 1e-12);
        for i in 0..n {
            for j in 0..n {
                close("symmetry", &[matrix[i * n + j]], &[matrix[j * n + i]], 1e-13);
            }
        }
        let v = case.velocity(&point);
        let twice: f64 = (0..n * n).map(|k| v[k / n] * matrix[k] * v[k % n]).sum();
        close("kinetic energy", &case.eval(FunctionKind::KineticEnergy, &point), &[0.5 * twice], 1e-12);
    }
}

#[test]
fn nothing_is_derived_that_is_not_there() {
    let free = case(
        "body b { mass: 2.0, inertia: diag(0.1, 0.2, 0.3) }
        joint j: Free { parent: ground, child: b }
        output u = potential();
        emit forward_dynamics;",
    );
    let point = free.random(3);
    let a = free.eval(FunctionKind::ForwardDynamics, &point);
    assert_eq!(a[..3], [0.0; 3]);
    assert_eq!(free.output("u", &point), [0.0]);
    assert_eq!(free.derivation.functions.len(), 2);
}
