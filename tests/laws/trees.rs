//! Laws that every motion keeps: energy, momentum, power, and formulations that must agree.

use multibody::nalgebra::{Matrix3, Rotation3, SMatrix, SVector, UnitQuaternion, Vector3};
use multibody::{DormandPrince, Pose, RollPitchYaw, Twist};
use multibody_tests::models::laws::{by_angles, by_quaternion, driven, motor, satellite, tree, walker, walker_by_hand};
use multibody_tests::support::arm::*;
use multibody_tests::support::compare::{mixed, relative};
use multibody_tests::support::random::Random;
use num_dual::Dual64;

fn assert_close(what: &str, got: &[f64], want: &[f64], bound: f64) {
    let error = mixed(got, want);
    assert!(error <= bound, "{what}: error {error:e}, allowed {bound:e}");
}

/// A state of the tree with every coordinate within one of its zero.
fn state(random: &mut Random) -> tree::State {
    let mut position = [0.0; tree::DOF + 1];
    position.iter_mut().for_each(|x| *x = random.unit());
    tree::State {
        q: tree::Position::normalized(SVector::from(position)),
        v: SVector::<f64, { tree::DOF }>::from(random.units()).into(),
    }
}

#[test]
fn energy_stays_without_losses() {
    let model = tree::Model::new(&tree::Params::default());
    let start = state(&mut Random::new(1));
    let input = tree::Input { push: [0.0; 3] };
    let energy = |x: &tree::State| model.kinetic_energy(x) + model.potential_energy(&x.q);
    let first = energy(&start);
    let mut most = 0.0_f64;
    let end = DormandPrince::integrate(&model, 0.0, &start, &input, 1e-4, 10000, |_, x| {
        most = most.max((energy(x) - first).abs());
    });
    let end = end.unwrap();
    println!("energy: {first} J, drift {most:e} J");
    assert!(most <= 1e-9 * (1.0 + first.abs()), "drift {most:e} of {first}");
    assert_close("output", &[model.outputs(1.0, &end, &input).energy], &[energy(&end)], 1e-14);
    assert!((end.q.eye.as_ref().norm() - 1.0).abs() <= 1e-15);
}

#[test]
fn inverse_after_forward() {
    let model = tree::Model::new(&tree::Params::default());
    let mut random = Random::new(2);
    for _ in 0..20 {
        let x = state(&mut random);
        let input = tree::Input { push: random.units() };
        let accel = model.forward_dynamics(0.3, &x, &input);
        let scale: f64 = SVector::<f64, { tree::DOF }>::from(accel).amax();
        let left: SVector<f64, { tree::DOF }> = model.inverse_dynamics(0.3, &x, &input, &accel).into();
        assert!(left.amax() <= 1e-13 * (1.0 + scale), "{left}");
        // M a + bias = effort
        let accel = SVector::<f64, { tree::DOF }>::from(random.units());
        let effort: SVector<f64, { tree::DOF }> = model.inverse_dynamics(0.3, &x, &input, &accel.into()).into();
        let sum = model.mass_matrix(&x.q) * accel + model.bias(0.3, &x, &input);
        assert_close("M a + bias", sum.as_slice(), effort.as_slice(), 1e-13);
    }
}

#[test]
fn mass_matrix_is_symmetric_and_positive() {
    let model = tree::Model::new(&tree::Params::default());
    let mut random = Random::new(3);
    for _ in 0..20 {
        let x = state(&mut random);
        let mass: SMatrix<f64, { tree::DOF }, { tree::DOF }> = model.mass_matrix(&x.q);
        assert_eq!(mass, mass.transpose());
        assert!(mass.cholesky().is_some());
        let v: SVector<f64, { tree::DOF }> = x.v.into();
        // The armature turns with the joint's rate.
        let kinetic = 0.5 * (v.transpose() * mass * v)[0];
        assert_close("v' M v / 2", &[model.kinetic_energy(&x)], &[kinetic], 1e-13);
    }
}

/// How fast energies change along the motion, by dual numbers, is what the forces feed in.
#[test]
fn power_balance() {
    let model = driven::Model::<f64>::new(&driven::Params::default());
    let dual = driven::Model::<Dual64>::new(&driven::Params::default());
    let mut random = Random::new(4);
    for k in 0..20 {
        let t = 0.1 * f64::from(k);
        let q = SVector::<f64, 4>::from(random.units());
        let v = SVector::<f64, 4>::from(random.units());
        let x = driven::State { q: q.into(), v: v.into() };
        let thrust = Vector3::from(random.units());
        let input = driven::Input { thrust };
        let a: SVector<f64, 4> = model.forward_dynamics(t, &x, &input).into();
        let moving = driven::State { q: q.zip_map(&v, Dual64::new).into(), v: v.zip_map(&a, Dual64::new).into() };
        let output = model.outputs(t, &x, &input);
        let rates = dual.outputs(Dual64::new(t, 1.0), &moving, &driven::Input { thrust: thrust.map(Dual64::from) });
        assert_close("power", &[output.power], &[rates.moving.eps], 1e-13);
        assert_close("power of springs", &[output.of_springs], &[-rates.stored.eps], 1e-13);
        assert!(output.power.abs() > 1e-3 && output.of_springs.abs() > 1e-3);
    }
}

/// Linear momentum, and the angular one about the origin.
fn momentum(model: &satellite::Model, x: &satellite::State, input: &satellite::Input) -> [Vector3<f64>; 2] {
    let o = model.outputs(0.0, x, input);
    let (mut linear, mut angular) = (Vector3::zeros(), Vector3::zeros());
    let axes: [Rotation3<f64>; 3] = [o.hull_axes, o.left_axes, o.right_axes];
    for (k, mass) in [5.0, 1.0, 1.5].into_iter().enumerate() {
        linear += mass * o.velocities[k];
        angular += o.centres[k].cross(&(mass * o.velocities[k])) + axes[k] * o.spins[k];
    }
    [linear, angular]
}

#[test]
fn momentum_stays_on_a_floating_base() {
    let model = satellite::Model::new(&satellite::Params::default());
    let mut random = Random::new(5);
    let mut x = satellite::State::default();
    x.q.free = Pose { position: random.units().into(), orientation: UnitQuaternion::from_euler_angles(0.3, -0.4, 1.2) };
    x.v.free = Twist { linear: random.units().into(), angular: random.units().into() };
    (x.v.one, x.v.two) = (0.7, -0.4);
    let first = momentum(&model, &x, &satellite::Input { motors: [0.0; 2] });
    assert!(first[1].norm() > 0.1);
    let (mut most, mut norm) = (0.0_f64, 0.0_f64);
    for k in 0..2000 {
        let t = 1e-3 * f64::from(k);
        let input = satellite::Input { motors: [0.5 * (3.0 * t).sin(), -0.2 * (5.0 * t).cos()] };
        x = DormandPrince::step(&model, t, &x, &input, 1e-3);
        for (now, then) in momentum(&model, &x, &input).iter().zip(&first) {
            most = most.max((now - then).norm());
        }
        norm = norm.max((x.q.free.orientation.as_ref().norm() - 1.0).abs());
    }
    println!("momentum: {first:?}, drift {most:e}; quaternion: {norm:e}");
    assert!(most <= 1e-11, "drift {most:e}");
    assert!(norm <= 1e-15, "quaternion: {norm:e}");
}

#[test]
fn quaternion_and_angles_move_alike() {
    let angles = by_angles::Model::new(&by_angles::Params::default());
    let quaternion = by_quaternion::Model::new(&by_quaternion::Params::default());
    let mut a = by_angles::State::default();
    a.q.support = RollPitchYaw { roll: 0.3, pitch: -0.2, yaw: 0.5 };
    a.v.support = RollPitchYaw { roll: 0.4, pitch: 0.6, yaw: -0.3 };
    (a.q.hinge, a.v.hinge) = (0.2, -0.5);
    let omega: Vector3<f64> = angles.outputs(0.0, &a, &()).omega;
    let b = by_quaternion::State {
        // nalgebra's is Rz(yaw) Ry(pitch) Rx(roll), too.
        q: by_quaternion::Position { support: UnitQuaternion::from_euler_angles(0.3, -0.2, 0.5), hinge: 0.2 },
        v: by_quaternion::Velocity { support: omega, hinge: -0.5 },
    };
    let compare = |a: &by_angles::State, b: &by_quaternion::State, bound: f64| {
        let (of_a, of_b) = (angles.outputs(0.0, a, &()), quaternion.outputs(0.0, b, &()));
        for (what, a, b) in [
            ("tip", of_a.tip, of_b.tip),
            ("velocity", of_a.velocity, of_b.velocity),
            ("acceleration", of_a.acceleration, of_b.acceleration),
            ("force", of_a.reaction.force, of_b.reaction.force),
            ("moment", of_a.reaction.moment, of_b.reaction.moment),
        ] {
            assert_close(what, a.as_slice(), b.as_slice(), bound);
        }
        assert_close("energy", &[of_a.energy], &[of_b.energy], bound);
        // A ball transmits no moment.
        assert!(of_b.reaction.moment.norm() <= 1e-12 && of_b.reaction.force.norm() > 1.0);
    };
    compare(&a, &b, 1e-13);
    let a = DormandPrince::integrate(&angles, 0.0, &a, &(), 5e-4, 1000, |_, _| ()).unwrap();
    let b = DormandPrince::integrate(&quaternion, 0.0, &b, &(), 5e-4, 1000, |_, _| ()).unwrap();
    compare(&a, &b, 1e-10);
}

#[test]
fn parts_are_what_they_stand_for() {
    let parts = walker::Model::new(&walker::Params::default());
    let hand = walker_by_hand::Model::new(&walker_by_hand::Params::default());
    let mut random = Random::new(6);
    for _ in 0..10 {
        let q = SVector::<f64, 7>::from(random.units());
        let v = SVector::<f64, 7>::from(random.units());
        let torque: [f64; 3] = random.units();
        let a = walker::State { q: q.into(), v: v.into() };
        let b = walker_by_hand::State { q: q.into(), v: v.into() };
        assert_eq!((a.q.rail, a.q.limbs[1].hip, a.v.limbs[2].knee), (q[0], q[3], v[6]));
        let mut to = walker::Input::default();
        to.limbs.iter_mut().zip(torque).for_each(|(limb, torque)| limb.torque = torque);
        let by = walker_by_hand::Input { torque };
        let forward: [SVector<f64, 7>; 2] =
            [parts.forward_dynamics(0.0, &a, &to).into(), hand.forward_dynamics(0.0, &b, &by).into()];
        assert_close("forward dynamics", forward[0].as_slice(), forward[1].as_slice(), 1e-12);
        let (mass, other) = (parts.mass_matrix(&a.q), hand.mass_matrix(&b.q));
        assert_close("mass matrix", mass.as_slice(), other.as_slice(), 1e-14);
        let (bias, other) = (parts.bias(0.0, &a, &to), hand.bias(0.0, &b, &by));
        assert_close("bias", bias.as_slice(), other.as_slice(), 1e-13);
    }
    // Lengths are set where the part is used; masses stay params.
    let masses: Vec<f64> = walker::Params::<f64>::default().limbs.iter().map(|limb| limb.m).collect();
    assert_eq!(masses, [0.5; 3]);
}

/// i'' + R/L i' + K^2 / (L J) i = 0, i(0) = 0, i'(0) = u/L: a damped oscillation.
#[test]
fn current_of_a_motor() {
    let params = motor::Params::default();
    let model = motor::Model::new(&params);
    let (r, l, k, j, u) = (params.resistance, params.inductance, params.constant, 0.004, 12.0);
    let decay = 0.5 * r / l;
    let square = k * k / (l * j) - decay * decay;
    let mut x = motor::State::<f64>::default();
    let mut t = 0.0;
    for step in 1..=1000 {
        x = DormandPrince::step(&model, t, &x, &motor::Input { voltage: u }, 1e-3);
        t = 1e-3 * f64::from(step);
        // The sign of `square` decides between sines and their hyperbolic sisters.
        let wave = if square > 0.0 { (square.sqrt() * t).sin() } else { (t * (-square).sqrt()).sinh() };
        let current = u / (l * square.abs().sqrt()) * (-decay * t).exp() * wave;
        assert_close("current", &[x.x.current], &[current], 1e-10);
    }
    // At the end it turns as fast as its voltage allows, without current.
    assert_close("rate", &[x.v.shaft], &[u / k], 2e-3);
}

fn solve(mass: &[f64], rest: &[f64]) -> Vec<f64> {
    use multibody::nalgebra::{DMatrix, DVector};
    let n = rest.len();
    let mass = DMatrix::from_row_slice(n, n, mass);
    mass.cholesky().unwrap().solve(&DVector::from_column_slice(rest)).as_slice().to_vec()
}

fn formulations_agree<A: Arm<f64>, P: Arm<f64>>(dof: usize) {
    let (literal, param) = (A::new(), P::new());
    let mut random = Random::new(7);
    let mut vector = |scale: f64| -> Vec<f64> { (0..dof).map(|_| scale * random.unit()).collect() };
    for _ in 0..20 {
        let (q, v, tau) = (vector(3.0), vector(2.0), vector(5.0));
        let forward = literal.forward_dynamics(&q, &v, &tau);
        assert!(relative(&param.forward_dynamics(&q, &v, &tau), &forward) <= 1e-11, "{}", A::NAME);
        let rest: Vec<f64> = tau.iter().zip(literal.bias(&q, &v)).map(|(tau, bias)| tau - bias).collect();
        assert!(relative(&solve(&literal.mass_matrix(&q), &rest), &forward) <= 1e-11, "{}", A::NAME);
        let back = literal.inverse_dynamics(&q, &v, &forward);
        assert!(mixed(&back, &tau) <= 1e-11, "{}", A::NAME);
        let free = literal.free_dynamics(&q, &v);
        assert!(relative(&literal.forward_dynamics(&q, &v, &vec![0.0; dof]), &free) <= 1e-11, "{}", A::NAME);
    }
}

#[test]
fn formulations_of_the_arms_agree() {
    formulations_agree::<DoublePendulum<f64>, DoublePendulumParams<f64>>(2);
    formulations_agree::<Cart5<f64>, Cart5Params<f64>>(6);
    formulations_agree::<Puma560<f64>, Puma560Params<f64>>(6);
    formulations_agree::<Panda<f64>, PandaParams<f64>>(7);
}

#[test]
fn rotations_are_rotations() {
    let model = satellite::Model::<f64>::new(&satellite::Params::default());
    let x = state_of_satellite();
    let output = model.outputs(0.0, &x, &satellite::Input { motors: [0.0; 2] });
    for axes in [output.hull_axes, output.left_axes, output.right_axes] {
        let matrix: &Matrix3<f64> = axes.matrix();
        assert_close("R R'", (matrix * matrix.transpose()).as_slice(), Matrix3::identity().as_slice(), 1e-15);
        assert!(matrix.determinant() > 0.0);
    }
    let hull = x.q.free.orientation.to_rotation_matrix();
    assert_close("hull", output.hull_axes.matrix().as_slice(), hull.matrix().as_slice(), 1e-15);
}

fn state_of_satellite() -> satellite::State {
    let mut x = satellite::State::default();
    x.q.free.orientation = UnitQuaternion::from_euler_angles(-1.1, 0.4, 2.2);
    (x.q.one, x.q.two) = (1.3, -2.1);
    x
}
