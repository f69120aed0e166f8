//! What is done once for a position, in compiled models: functions that go on from there give what the methods of `Model` give,
//! in `f64`, `f32` and lanes, wherever the mechanism stands, for any parameters, and cost no more.

use multibody::nalgebra::{SMatrix, SVector};
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody::{Cost, multibody};
use multibody_tests::support::random::Random;

multibody! {
    mod leg {
        port hip: Frame;
        input torque;
        param length = 0.3171;
        param m = 0.3;
        body thigh { mass: m, com: [0.15, 0.02, -0.01], inertia: inertia(0.001, 0.003, 0.003, 0.0002, -0.0001, 0.0003) }
        joint knee: Revolute { parent: hip, child: thigh, axis: [0.36, 0.48, 0.8] }
        force motor: Effort { joint: knee, value: torque - 0.1 * knee.rate }
        output foot = thigh.at(length * X).position;
        output track = thigh.at(length * X).jacobian;
    }
    /// A floating body with a quaternion, legs, time and a state of its own.
    pub(crate) mod tree {
        param stiff = 0.7;
        param tilt = 0.3;
        world { gravity: [0.2, -0.4, -9.80665] }
        body trunk { mass: 2.0, com: [0.1, 0.2, -0.05], inertia: inertia(0.13, 0.16, 0.2, 0.01, -0.02, 0.03) }
        joint root: Free { parent: ground.rotated([1.0, 0.3, 0.2], 0.3), child: trunk }
        part legs: [leg; 2] = |i| leg { hip: trunk.rotated([0.1, 0.2, 1.0], i * 2.0 * PI / 3.0).at(0.2 * X) };
        body tail { mass: 0.4, com: [0.1, 0.03, -0.2], inertia: diag(0.01, 0.012, 0.009) }
        joint swing: Universal { parent: trunk.at([-0.3, 0.05, 0.1]).rotated(X, tilt), child: tail, axes: [X, Y] }
        force spring: Effort { joint: swing, value: [-stiff * swing.first * (1.0 + 0.5 * sin(t)), slack] }
        state slack: rate = swing.second - slack, start: 0.1;
        // Names that generated code has of its own.
        output at = trunk.at(X).velocity;
        output model = tail.at(0.3 * Z).pose;
        emit forward_dynamics, inverse_dynamics, mass_matrix, mass_matrix_lower, bias, energy, poses, outputs { feet: [legs.foot, legs.track] };
        emit at {
            functions: [
                forward_dynamics, inverse_dynamics, mass_matrix, mass_matrix_lower, bias, kinetic_energy, potential_energy,
                poses, outputs, outputs_feet,
            ],
        };
    }
    /// Loops with multipliers.
    pub(crate) mod held {
        world { gravity: -9.80665 * Z }
        formulation { constraints: Multipliers }
        part legs: [leg; 3] = |i| leg { hip: ground.rotated(X, i * 0.3).at(0.2 * i * Y) };
        constraint link: Rod { between: [legs[0].thigh.at(0.2 * X), legs[1].thigh.at(0.25 * X)], length: 0.23012345678901234 }
        emit forward_dynamics, mass_matrix, bias, residual, impulse;
        emit at {
            functions: [
                forward_dynamics, mass_matrix, bias, residual, impulse, constraints, constraint_jacobian, constraint_rate,
                constraint_bias,
            ],
        };
    }
    /// The same closed by Newton's method.
    pub(crate) mod iterated {
        world { gravity: -9.80665 * Z }
        formulation { constraints: Reduced, independent: [legs[0].knee, legs[2].knee] }
        part legs: [leg; 3] = |i| leg { hip: ground.rotated(X, i * 0.3).at(0.2 * i * Y) };
        constraint link: Rod { between: [legs[0].thigh.at(0.2 * X), legs[1].thigh.at(0.25 * X)], length: 0.23012345678901234 }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
        emit at { functions: [forward_dynamics, inverse_dynamics, mass_matrix, bias, outputs] };
    }
    /// A loop in closed form, driven by the time beside it.
    pub(crate) mod linkage {
        param crank_length = 0.41;
        param rod_length = 0.83;
        input push;
        input twist;
        world { gravity: [0.1, -9.80665, 0.3] }
        formulation { constraints: Reduced, independent: [turn] }
        body crank { mass: 0.4, com: [0.2, 0.01, 0.0], inertia: diag(0.01, 0.02, 0.025) }
        body rod { mass: 0.6, com: [0.4, -0.02, 0.0], inertia: diag(0.02, 0.03, 0.04) }
        body rocker { mass: 0.5, com: [0.3, 0.0, 0.03], inertia: diag(0.01, 0.02, 0.025) }
        body fan { mass: 0.1, com: [0.1, 0.02, 0.04], inertia: diag(0.001, 0.002, 0.0025) }
        joint turn: Revolute { parent: ground.rotated(X, 0.2), child: crank, axis: Z }
        joint middle: Revolute { parent: crank.at(crank_length * X), child: rod, axis: Z }
        joint pivot: Revolute { parent: ground.rotated(X, 0.2).at(0.93 * X), child: rocker, axis: Z }
        joint spin: Revolute { parent: rocker.at([0.1, 0.2, 0.3]), child: fan, axis: [0.6, 0.0, 0.8] }
        #[cut]
        joint close: Revolute { parent: rod.at(rod_length * X), child: rocker.at(0.61 * X), axis: Z }
        solve (middle, pivot) from close { sin(pivot - turn - middle) > 0.0 }
        drive spin = 0.3 * sin(2.0 * t);
        force motor: Effort { joint: turn, value: push }
        force blower: Effort { joint: spin, value: twist }
        output end = rocker.at(0.61 * X).velocity;
        emit forward_dynamics, inverse_dynamics { solve_for: [push, twist] }, mass_matrix, bias;
        emit at { functions: [forward_dynamics, inverse_dynamics, mass_matrix, bias, outputs] };
    }
}

fn same(what: &str, got: impl IntoIterator<Item = f64>, want: impl IntoIterator<Item = f64>, bound: f64) {
    let (got, want): (Vec<f64>, Vec<f64>) = (got.into_iter().collect(), want.into_iter().collect());
    assert_eq!(got.len(), want.len(), "{what}");
    let size = want.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    for (a, b) in got.iter().zip(&want) {
        assert!((a - b).abs() <= bound * size, "{what}: {a} {b}");
    }
}

fn list<const R: usize, const C: usize>(matrix: SMatrix<f64, R, C>) -> Vec<f64> {
    matrix.iter().copied().collect()
}

/// `at` and what goes on from there cost no more than the functions alone.
fn saves(costs: &[Cost]) {
    let operations = |cost: &Cost| cost.add + cost.mul + cost.div + cost.sqrt + cost.sincos + cost.other;
    let of = |function: &str| costs.iter().find(|cost| cost.function == function).map(operations);
    let mut together = of("at").unwrap();
    let mut alone = 0;
    for cost in costs.iter().filter(|cost| cost.function.starts_with("at.")) {
        together += operations(cost);
        alone += of(cost.function.strip_prefix("at.").unwrap()).unwrap();
    }
    println!("{together} operations, {alone} alone");
    assert!(together < alone, "{together}, {alone} alone");
}

#[test]
fn no_more_is_done() {
    [tree::COSTS, held::COSTS, iterated::COSTS, linkage::COSTS].iter().for_each(|costs| saves(costs));
}

#[test]
fn a_floating_tree() {
    let mut random = Random::new(5);
    for far in [1.0, 30.0] {
        for _ in 0..20 {
            let mut draw = |size: f64| size * random.unit();
            let mut params = tree::Params::<f64>::default();
            (params.stiff, params.tilt) = (0.7 + draw(0.5), draw(2.0));
            params.legs[1].length = 0.3 + draw(0.2);
            params.legs[0].m = 0.5 + draw(0.3);
            let model = tree::Model::new(&params);
            let mut state = tree::State::<f64>::default();
            state.q.root.position = SVector::from_fn(|_, _| draw(far));
            state.q.root.orientation =
                multibody::nalgebra::UnitQuaternion::from_euler_angles(draw(3.0), draw(1.5), draw(3.0));
            state.q.legs[0].knee = draw(far);
            state.q.legs[1].knee = draw(far);
            (state.q.swing.first, state.q.swing.second) = (draw(far), draw(far));
            let v: SVector<f64, { tree::DOF }> = SVector::from_fn(|_, _| draw(2.5));
            state.v = v.into();
            state.x.slack = draw(1.0);
            let mut input = tree::Input::default();
            input.legs[1].torque = draw(1.0);
            let accel = tree::Velocity::from(SVector::<f64, { tree::DOF }>::from_fn(|_, _| draw(3.0)));
            let t = draw(5.0);
            let at = model.at(t, &state.q, &state.x);
            same("mass", list(at.mass_matrix()), list(model.mass_matrix(&state.q)), 1e-13);
            same(
                "lower",
                at.mass_matrix_lower().packed().iter().copied(),
                model.mass_matrix_lower(&state.q).packed().iter().copied(),
                1e-13,
            );
            let (bodies, alone) = (at.poses(), model.poses(&state.q));
            same("tail", list(bodies.tail.position), list(alone.tail.position), 1e-13);
            let thigh = |bodies: &tree::Poses<f64>| list(*bodies.legs[1].thigh.rotation.matrix());
            same("thigh", thigh(&bodies), thigh(&alone), 1e-13);
            same("bias", list(at.bias(&state.v, &input)), list(model.bias(t, &state, &input)), 1e-12);
            let (efforts, alone) =
                (at.inverse_dynamics(&state.v, &input, &accel), model.inverse_dynamics(t, &state, &input, &accel));
            let flat = |v: tree::Velocity<f64>| list(SVector::<f64, { tree::DOF }>::from(v));
            same("efforts", flat(efforts), flat(alone), 1e-12);
            let (found, alone) = (at.forward_dynamics(&state.v, &input), model.forward_dynamics(t, &state, &input));
            same("accelerations", flat(found.v), flat(alone.v), 1e-10);
            same("rates", [found.x.slack], [alone.x.slack], 1e-13);
            same("kinetic", [at.kinetic_energy(&state.v)], [model.kinetic_energy(&state)], 1e-12);
            same("potential", [at.potential_energy()], [model.potential_energy(&state.q)], 1e-12);
            let (all, alone) = (at.outputs(&state.v, &input), model.outputs(t, &state, &input));
            same("point", list(all.at), list(alone.at), 1e-12);
            same("pose", list(all.model.position), list(alone.model.position), 1e-12);
            let (feet, alone) = (at.outputs_feet(&state.v, &input), model.outputs_feet(t, &state, &input));
            for leg in 0..2 {
                same("foot", list(feet.legs_foot[leg]), list(alone.legs_foot[leg]), 1e-12);
                same("track", list(feet.legs_track[leg]), list(alone.legs_track[leg]), 1e-12);
            }
            assert_eq!(at.model(), &model);
        }
    }
}

#[test]
fn multipliers() {
    let model = held::Model::<f64>::default();
    let mut random = Random::new(9);
    for _ in 0..20 {
        let mut draw = |_: f64| random.unit();
        let q: SVector<f64, 3> = SVector::<f64, 3>::zeros().map(&mut draw);
        let v: SVector<f64, 3> = SVector::<f64, 3>::zeros().map(&mut draw);
        let state = held::State { q: q.into(), v: v.into() };
        let mut input = held::Input::default();
        input.legs[2].torque = draw(0.0);
        let accel = held::Velocity::from(SVector::<f64, 3>::zeros().map(&mut draw));
        let multipliers = SVector::<f64, 1>::new(draw(0.0));
        let at = model.at(&state.q);
        let flat = |v: held::Velocity<f64>| list(SVector::<f64, 3>::from(v));
        same("mass", list(at.mass_matrix()), list(model.mass_matrix(&state.q)), 1e-13);
        same("bias", list(at.bias(&state.v, &input)), list(model.bias(0.0, &state, &input)), 1e-12);
        same("equations", list(at.constraints()), list(model.constraints(0.0, &state.q)), 1e-13);
        same("rows", list(at.constraint_jacobian()), list(model.constraint_jacobian(0.0, &state.q)), 1e-13);
        same("rates", list(at.constraint_rate(&state.v)), list(model.constraint_rate(0.0, &state)), 1e-13);
        same("rest", list(at.constraint_bias(&state.v)), list(model.constraint_bias(0.0, &state)), 1e-12);
        same(
            "residual",
            list(at.residual(&state.v, &input, &accel, &multipliers)),
            list(model.residual(0.0, &state, &input, &accel, &multipliers)),
            1e-12,
        );
        let (found, alone) = (at.forward_dynamics(&state.v, &input), model.forward_dynamics(0.0, &state, &input));
        same("accelerations", flat(found.v), flat(alone.v), 1e-10);
        same("multipliers", list(found.multipliers), list(alone.multipliers), 1e-10);
        let (found, alone) = (at.impulse(&accel, &multipliers), model.impulse(&state.q, &accel, &multipliers));
        same("jump", flat(found.v), flat(alone.v), 1e-10);
    }
}

#[test]
fn iterations() {
    let model = iterated::Model::<f64>::default();
    let mut random = Random::new(3);
    let mut compared = 0;
    for _ in 0..20 {
        let mut draw = |near: f64| near + 0.05 * random.unit();
        let start = iterated::State::<f64>::default();
        let q = SVector::<f64, 2>::from(start.q).map(&mut draw);
        let v = SVector::<f64, 2>::zeros().map(|_: f64| 10.0 * draw(0.0));
        let state = iterated::State { q: q.into(), v: v.into(), ..start };
        let input = iterated::Input::default();
        let accel = iterated::Velocity::from(SVector::<f64, 2>::zeros().map(&mut draw));
        let at = model.at(&state.q, &state.guess);
        let (found, alone) = (at.forward_dynamics(&state.v, &input), model.forward_dynamics(0.0, &state, &input));
        // Both iterate from the same guess, whether that closes the loops or not.
        compared += usize::from(alone.residual < 1e-12);
        let flat = |v: iterated::Velocity<f64>| list(SVector::<f64, 2>::from(v));
        same("accelerations", flat(found.v), flat(alone.v), 1e-9);
        same("residual", [found.residual], [alone.residual], 1e-9);
        same(
            "efforts",
            flat(at.inverse_dynamics(&state.v, &input, &accel)),
            flat(model.inverse_dynamics(0.0, &state, &input, &accel)),
            1e-9,
        );
        let (outputs, alone) = (at.outputs(&state.v, &input), model.outputs(0.0, &state, &input));
        same("foot", list(outputs.legs[1].foot), list(alone.legs[1].foot), 1e-9);
    }
    assert!(compared > 10, "{compared}");
}

#[test]
fn a_closed_form_in_all_scalars() {
    let mut random = Random::new(7);
    for _ in 0..20 {
        let mut draw = |near: f64| near + random.unit();
        let params = linkage::Params { crank_length: 0.35 + 0.05 * draw(0.0), ..linkage::Params::<f64>::default() };
        let model = linkage::Model::new(&params);
        let (turn, rate, t, push) = (3.0 * draw(0.0), draw(0.0), draw(1.0), draw(0.0));
        let mut state = linkage::State::<f64>::default();
        (state.q.turn, state.v.turn) = (turn, rate);
        let accel = linkage::Velocity { turn: draw(0.0) };
        let input = linkage::Input { push, twist: 0.3 };
        let at = model.at(t, &state.q);
        let alone = model.forward_dynamics(t, &state, &input).turn;
        let found = at.forward_dynamics(&state.v, &input).turn;
        same("acceleration", [found], [alone], 1e-10);
        same("mass", list(at.mass_matrix()), list(model.mass_matrix(t, &state, &input)), 1e-12);
        same("bias", list(at.bias(&state.v, &input)), list(model.bias(t, &state, &input)), 1e-11);
        same("end", list(at.outputs(&state.v, &input).end), list(model.outputs(t, &state, &input).end), 1e-11);
        let solved = at.inverse_dynamics(&state.v, &input, &accel);
        same("push", [solved.input.push], [model.inverse_dynamics(t, &state, &input, &accel).input.push], 1e-11);

        // Single precision, against double.
        let single = linkage::Params { crank_length: params.crank_length as f32, ..linkage::Params::<f32>::default() };
        let single = linkage::Model::new(&single);
        let q = linkage::Position { turn: turn as f32 };
        let v = linkage::Velocity { turn: rate as f32 };
        let at = single.at(t as f32, &q);
        let found = at.forward_dynamics(&v, &linkage::Input { push: push as f32, twist: 0.3 }).turn;
        same("single", [f64::from(found)], [alone], 2e-3);

        // Lanes, each as alone.
        let wide =
            linkage::Params { crank_length: WideF64x4::splat(params.crank_length), ..linkage::Params::default() };
        let wide = linkage::Model::new(&wide);
        let turns = [turn, turn + 0.1, turn - 0.2, turn + 2.0];
        let q = linkage::Position { turn: WideF64x4::from(turns) };
        let v = linkage::Velocity { turn: WideF64x4::splat(rate) };
        let input = linkage::Input { push: WideF64x4::splat(push), twist: WideF64x4::splat(0.3) };
        let found = wide.at(WideF64x4::splat(t), &q).forward_dynamics(&v, &input).turn;
        for (lane, &turn) in turns.iter().enumerate() {
            state.q.turn = turn;
            let alone = model.at(t, &state.q).forward_dynamics(&state.v, &linkage::Input { push, twist: 0.3 }).turn;
            same("lane", [found.extract(lane)], [alone], 1e-11);
        }
    }
}
