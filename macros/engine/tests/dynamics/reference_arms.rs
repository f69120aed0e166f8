//! Serial arms against reference data of another library (see tests/data/robots): inverse dynamics, bias, gravity, mass
//! matrix and forward dynamics by both formulations, graphs interpreted in double precision.

use crate::arms::{ARMS, Arm, flat, load, read};
use crate::formulations;
use multibody_engine::dynamics::kinematics::motions;
use multibody_engine::dynamics::newton_euler::{Wrench, efforts, transmitted};
use multibody_engine::dynamics::regroup::{regroup, regroup_keeping};
use multibody_engine::dynamics::shared_axes::Shared;
use multibody_engine::dynamics::slid_origins::slide_origins;
use multibody_engine::dynamics::tree::Tree;
use multibody_engine::dynamics::turned_ends::turn_ends;
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Graph, Rotation, Scalar, SymbolId, Vector};
use multibody_engine::symbolic::lower::Lowering;

/// Relative to the largest entry of a sample's vector.
const TOLERANCE: f64 = 1e-12;

fn error(got: &[f64], want: &[f64]) -> f64 {
    assert_eq!(got.len(), want.len());
    let largest = want.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    got.iter().zip(want).map(|(a, b)| (a - b).abs() / largest).fold(0.0, worse)
}

/// The larger of two errors; NaN is the largest.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || a >= b { a } else { b }
}

/// A function of an arm, and the samples' name for it.
type Function = (&'static str, &'static str, fn(&mut Arm) -> Vec<Scalar>);

const FUNCTIONS: [Function; 6] = [
    ("inverse dynamics", "rnea", |arm| {
        let (velocity, acceleration) = (arm.tree.velocity.clone(), arm.tree.acceleration.clone());
        formulations::inverse_dynamics(&mut arm.graph, &arm.tree, &velocity, &acceleration)
    }),
    ("bias", "nle", |arm| formulations::bias(&mut arm.graph, &arm.tree)),
    ("gravity", "gravity", |arm| {
        let still = vec![Scalar::ZERO; arm.tree.freedoms()];
        formulations::inverse_dynamics(&mut arm.graph, &arm.tree, &still, &still)
    }),
    ("mass matrix", "M", |arm| formulations::mass_matrix(&mut arm.graph, &arm.tree)),
    ("composite rigid body", "aba", |arm| formulations::by_composite(&mut arm.graph, &arm.tree, &arm.efforts)),
    ("articulated body", "aba", |arm| formulations::by_articulated(&mut arm.graph, &arm.tree, &arm.efforts)),
];

/// The tree in another form, with the same motions and efforts. Every function has a graph of its
/// own: in a common one, equal results are one node, and the formulation that comes second would not be tested.
fn check(name: &str, form: fn(&mut Graph, &Tree) -> Tree) {
    let samples = read(name, "samples");
    let samples = samples["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 20);
    for (what, key, derive) in FUNCTIONS {
        let mut arm = load(name);
        arm.tree = form(&mut arm.graph, &arm.tree);
        let roots = derive(&mut arm);
        let worst = samples.iter().fold(0.0_f64, |worst, sample| {
            let point = ["q", "v", "a", "tau"].map(|key| flat(&sample[key])).concat();
            let symbols = |id: SymbolId| point[id.0];
            let got = Evaluator::new(&arm.graph, Real { symbols: &symbols }).run(&roots);
            worse(worst, error(&got, &flat(&sample[key])))
        });
        println!("{name:16} {what:21} {worst:.1e}");
        assert!(worst <= TOLERANCE, "{name}, {what}: error {worst:e}");
    }
}

#[test]
fn base_parameters() {
    ARMS.iter().for_each(|name| check(name, regroup));
}

#[test]
fn link_by_link() {
    ARMS.iter().for_each(|name| check(name, |_, tree| tree.clone()));
}

/// As efforts are derived: origins slid, masses at hinges, last links turned, columns of U in common.
fn free(g: &mut Graph, tree: &Tree) -> Shared {
    let slid = slide_origins(g, tree);
    let tree = regroup_keeping(g, slid.as_ref().map_or(tree, |(tree, _)| tree));
    let turned = turn_ends(g, &tree);
    let turns = turned.as_ref().map_or(vec![Rotation::IDENTITY; tree.links.len()], |(_, turns)| turns.clone());
    let tree = Tree { turns_columns: true, ..turned.map_or(tree, |(turned, _)| turned) };
    Shared { tree, turns, ways: slid.map(|(_, ways)| ways), is_joined: false }
}

fn passed(g: &mut Graph, tree: &Tree) -> Tree {
    free(g, tree).tree
}

#[test]
fn passed_from_link_to_link() {
    ARMS.iter().for_each(|name| check(name, passed));
}

/// What each of the three saves of an arm's inverse dynamics, before any pass has seen it.
#[test]
fn what_passing_saves() {
    let columns = |g: &mut Graph, tree: &Tree| Tree { turns_columns: true, ..regroup(g, tree) };
    let masses = |g: &mut Graph, tree: &Tree| Tree { turns_columns: true, ..regroup_keeping(g, tree) };
    let forms: [fn(&mut Graph, &Tree) -> Tree; 4] = [regroup, columns, masses, passed];
    let weights = forms.map(|form| {
        let Arm { mut graph, tree, .. } = load("panda");
        let tree = form(&mut graph, &tree);
        let efforts = formulations::inverse_dynamics(&mut graph, &tree, &tree.velocity, &tree.acceleration);
        let mut lowering = Lowering::new(&graph);
        let roots = lowering.run(&efforts);
        lowering.to.cost(&roots).weight()
    });
    assert!(weights.is_sorted_by(|one, next| one > next), "{weights:?}");
    assert!(weights[3] + 40 <= weights[0], "{weights:?}");
}

/// Forces on links take the same efforts about origins that have slid and in axes that have turned.
#[test]
fn forces_on_links() {
    let Arm { graph: mut g, tree, .. } = load("panda");
    let wrenches: Vec<Wrench> = (0..tree.links.len())
        .map(|_| {
            let [moment, force] = [0, 1].map(|_| [0, 1, 2].map(|_| g.symbol()));
            Wrench { moment: g.vector(moment), force: g.vector(force) }
        })
        .collect();
    let shared = free(&mut g, &tree);
    let given = shared.turn(&mut g, &wrenches);
    let [one, other] = [(&tree, &wrenches), (&shared.tree, &given)].map(|(tree, applied)| {
        let motions = motions(&mut g, tree, &tree.velocity, &tree.acceleration, Vector::ZERO);
        let wrenches = transmitted(&mut g, tree, &motions, applied);
        efforts(&mut g, tree, &wrenches, &tree.acceleration)
    });
    let symbols = |id: SymbolId| (0.7 + 1.3 * id.0 as f64).sin();
    let [one, other] = [one, other].map(|roots| Evaluator::new(&g, Real { symbols: &symbols }).run(&roots));
    assert!(error(&other, &one) <= TOLERANCE, "{one:?} {other:?}");
    let ways = shared.ways.expect("the panda's hinges have offsets along them");
    assert_ne!(ways[2], Vector::ZERO);
    assert_eq!(shared.tree.links[2].offset, Vector::ZERO);
}

/// A mass at the last hinge leaves nothing of a component of its carrier's first moment; at a hinge that is too near it would have
/// to be too large.
#[test]
fn masses_at_hinges() {
    for (length, keeps) in [(0.088, true), (0.001, false)] {
        let Arm { graph: mut g, mut tree, .. } = load("panda");
        let length = g.decimal(length);
        tree.links[6].offset = g.along(0, length);
        let tree = regroup_keeping(&mut g, &tree);
        let (carrier, last) = (&tree.links[5].inertia, &tree.links[6].inertia);
        assert_eq!([carrier.first[0] == Scalar::ZERO, last.mass != Scalar::ZERO], [keeps; 2]);
        assert_ne!(carrier.first[1], Scalar::ZERO);
    }
}
