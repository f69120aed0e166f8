//! Groups of outputs, and poses: each gives what `outputs` gives of them, in trees, with multipliers and by Newton's method,
//! through arrays of parts, and takes no work for the others.

use multibody::nalgebra::{SVector, Vector3};
use multibody::{Cost, Placement, multibody};
use multibody_tests::support::random::Random;

macro_rules! legs {
    ($($name:ident [$($formulation:tt)*] { $($items:tt)* } [$($groups:tt)*])*) => {
        multibody! {
            mod leg {
                port hip: Frame;
                input torque;
                param length = 0.3171;
                body thigh { mass: 0.3, com: [0.15, 0.02, -0.01], inertia: diag(0.0001, 0.003, 0.003) }
                joint knee: Revolute { parent: hip, child: thigh, axis: [0.36, 0.48, 0.8] }
                force motor: Effort { joint: knee, value: torque }
                output foot = thigh.at(length * X).position;
                output load = knee.reaction;
                output track = thigh.at(length * X).jacobian;
            }
            $(pub(crate) mod $name {
                world { gravity: -9.80665 * Z }
                $($items)*
                $($formulation)*
                emit forward_dynamics, $($groups)*;
            })*
        }
    };
}

legs! {
    tree [] {
        body trunk { mass: 2.0, com: [0.1, 0.2, -0.05], inertia: diag(0.1, 0.12, 0.2) }
        joint root: Ball { parent: ground.rotated(X, 0.3), child: trunk, coordinates: RollPitchYaw }
        part legs: [leg; 3] = |i| leg { hip: trunk.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X) };
        part tail: leg { hip: trunk.at(-0.3 * X) };
        output heading = trunk.pose;
        output speed = norm(trunk.at(X).velocity);
    } [poses, outputs { pose: [heading, legs.foot, tail.foot], loads: legs[2].load, moving: [speed, legs.track] }]
    held [formulation { constraints: Multipliers }] {
        part legs: [leg; 3] = |i| leg { hip: ground.rotated(X, i * 0.3).at(0.2 * i * Y) };
        constraint link: Rod { between: [legs[0].thigh.at(0.2 * X), legs[1].thigh.at(0.25 * X)], length: 0.23012345678901234 }
        output gap = legs[0].thigh.at(X).acceleration;
    } [poses, outputs { pose: [legs.foot], loads: [legs[1].load, gap] }]
    iterated [formulation { constraints: Reduced, independent: [legs[0].knee, legs[2].knee] }] {
        part legs: [leg; 3] = |i| leg { hip: ground.rotated(X, i * 0.3).at(0.2 * i * Y) };
        constraint link: Rod { between: [legs[0].thigh.at(0.2 * X), legs[1].thigh.at(0.25 * X)], length: 0.23012345678901234 }
        output gap = legs[0].thigh.at(X).acceleration;
    } [poses, outputs { pose: [legs.foot], loads: [legs[1].load, gap] }]
}

/// Operations of a function.
fn operations(costs: &[Cost], function: &str) -> u32 {
    let Some(cost) = costs.iter().find(|cost| cost.function == function) else { panic!("{function}") };
    cost.add + cost.mul + cost.div
}

fn same(what: &str, got: impl IntoIterator<Item = f64>, want: impl IntoIterator<Item = f64>) {
    let (got, want): (Vec<f64>, Vec<f64>) = (got.into_iter().collect(), want.into_iter().collect());
    assert_eq!(got.len(), want.len(), "{what}");
    let size = want.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    for (a, b) in got.iter().zip(&want) {
        assert!((a - b).abs() <= 1e-12 * size, "{what}: {a} {b}");
    }
}

/// Where the pose of a thigh has its foot.
fn foot(thigh: &Placement<f64>) -> [f64; 3] {
    (thigh.rotation * Vector3::new(0.3171, 0.0, 0.0) + thigh.position).into()
}

#[test]
fn groups_of_a_tree() {
    let model = tree::Model::<f64>::default();
    let mut random = Random::new(5);
    for _ in 0..20 {
        let mut draw = |_| 2.5 * random.unit();
        let q: SVector<f64, 7> = SVector::from_fn(|_, _| draw(()));
        let v: SVector<f64, 7> = SVector::from_fn(|_, _| draw(()));
        let state = tree::State { q: q.into(), v: v.into() };
        let mut input = tree::Input::default();
        input.legs[1].torque = draw(());
        let all = model.outputs(0.0, &state, &input);
        let pose = model.outputs_pose(0.0, &state, &input);
        same("heading", pose.heading.position.iter().copied(), all.heading.position.iter().copied());
        for leg in 0..3 {
            same("foot", pose.legs_foot[leg].iter().copied(), all.legs[leg].foot.iter().copied());
        }
        same("tail", pose.tail_foot.iter().copied(), all.tail.foot.iter().copied());
        let bodies = model.poses(&state.q);
        same("trunk", bodies.trunk.position.iter().copied(), all.heading.position.iter().copied());
        let turned = all.heading.orientation.to_rotation_matrix();
        same("trunk", bodies.trunk.rotation.matrix().iter().copied(), turned.matrix().iter().copied());
        for leg in 0..3 {
            same("thigh", foot(&bodies.legs[leg].thigh), all.legs[leg].foot.iter().copied());
        }
        same("thigh of the tail", foot(&bodies.tail.thigh), all.tail.foot.iter().copied());
        let loads = model.outputs_loads(0.0, &state, &input);
        same("load", loads.legs_2_load.moment.iter().copied(), all.legs[2].load.moment.iter().copied());
        same("load", loads.legs_2_load.force.iter().copied(), all.legs[2].load.force.iter().copied());
        let moving = model.outputs_moving(0.0, &state, &input);
        same("speed", [moving.speed], [all.speed]);
        same("track", moving.legs_track[1].iter().copied(), all.legs[1].track.iter().copied());
    }
    // Reactions are dear: positions do without them.
    assert!(9 * operations(tree::COSTS, "outputs_pose") < operations(tree::COSTS, "outputs"));
}

#[test]
fn groups_of_closed_loops() {
    let mut compared = 0;
    let (kept, found) = (held::Model::<f64>::default(), iterated::Model::<f64>::default());
    let mut random = Random::new(9);
    for _ in 0..20 {
        let mut draw = |near: f64| near + 0.05 * random.unit();
        let q: SVector<f64, 3> = SVector::from_fn(|_, _| draw(0.0));
        let v: SVector<f64, 3> = SVector::from_fn(|_, _| draw(0.0));
        let state = held::State { q: q.into(), v: v.into() };
        let input = held::Input::default();
        let all = kept.outputs(0.0, &state, &input);
        let (pose, loads) = (kept.outputs_pose(0.0, &state, &input), kept.outputs_loads(0.0, &state, &input));
        let bodies = kept.poses(&state.q);
        for leg in 0..3 {
            same("foot", pose.legs_foot[leg].iter().copied(), all.legs[leg].foot.iter().copied());
            same("thigh", foot(&bodies.legs[leg].thigh), all.legs[leg].foot.iter().copied());
        }
        same("load", loads.legs_1_load.moment.iter().copied(), all.legs[1].load.moment.iter().copied());
        same("gap", loads.gap.iter().copied(), all.gap.iter().copied());

        let start = iterated::State::<f64>::default();
        let q = SVector::<f64, 2>::from(start.q).map(&mut draw);
        let v = SVector::<f64, 2>::zeros().map(|_: f64| 10.0 * draw(0.0));
        let state = iterated::State { q: q.into(), v: v.into(), ..start };
        let closed = found.close(0.0, &state);
        // Some of these poses cannot be closed.
        if closed.residual > 1e-14 {
            continue;
        }
        compared += 1;
        let state = closed.state;
        let input = iterated::Input::default();
        let all = found.outputs(0.0, &state, &input);
        let (pose, loads) = (found.outputs_pose(0.0, &state, &input), found.outputs_loads(0.0, &state, &input));
        let bodies = found.poses(&state);
        for leg in 0..3 {
            same("foot", pose.legs_foot[leg].iter().copied(), all.legs[leg].foot.iter().copied());
            same("thigh", foot(&bodies.legs[leg].thigh), all.legs[leg].foot.iter().copied());
        }
        same("load", loads.legs_1_load.force.iter().copied(), all.legs[1].load.force.iter().copied());
        same("gap", loads.gap.iter().copied(), all.gap.iter().copied());
    }
    assert!(compared > 5, "{compared}");
}
