//! Random trees of 1 to 12 bodies with random joints: the engine's recursions, by interpreting their graphs, against a
//! plain recursive implementation, against each other, and exactly modulo a prime.

use std::cell::Cell;

use crate::on_graph::{Derived, derive, point};
use crate::random::{Kind, Mechanism, State};
use crate::rng::Rng;
use crate::{formulations, plain};
use multibody_engine::dynamics::floating_bases::floating_bases;
use multibody_engine::dynamics::newton_euler::Wrench;
use multibody_engine::dynamics::regroup::regroup;
use multibody_engine::dynamics::shared_axes::{SharedAxes, share_axes};
use multibody_engine::dynamics::tree::{Motion, Orientation, Tree};
use multibody_engine::dynamics::{articulated, composite_at_root};
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Graph, Scalar, ScalarNode, SymbolId};
use multibody_engine::symbolic::identity::{Draw, Modular, Verdict, identical};
use multibody_engine::symbolic::lower::Lowering;
use proptest::prelude::any;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// What is derived of a mechanism. Each in a graph of its own: in a common one, equal results are one node, and the
/// formulation that comes second would not be tested.
type Function = fn(&mut Derived) -> Vec<Scalar>;

fn inverse_dynamics(m: &mut Derived) -> Vec<Scalar> {
    let (velocity, acceleration) = (m.tree.velocity.clone(), m.tree.acceleration.clone());
    formulations::inverse_dynamics(&mut m.graph, &m.tree, &velocity, &acceleration)
}

fn bias(m: &mut Derived) -> Vec<Scalar> {
    formulations::bias(&mut m.graph, &m.tree)
}

fn mass_matrix(m: &mut Derived) -> Vec<Scalar> {
    formulations::mass_matrix(&mut m.graph, &m.tree)
}

fn mass_matrix_at_root(m: &mut Derived) -> Vec<Scalar> {
    composite_at_root::mass_matrix(&mut m.graph, &m.tree).concat()
}

fn by_composite(m: &mut Derived) -> Vec<Scalar> {
    formulations::by_composite(&mut m.graph, &m.tree, &m.efforts)
}

fn by_articulated(m: &mut Derived) -> Vec<Scalar> {
    formulations::by_articulated(&mut m.graph, &m.tree, &m.efforts)
}

/// Derives a function link by link, or with base inertial parameters.
fn derived(mechanism: &Mechanism, regrouped: bool, function: Function) -> (Graph, Vec<Scalar>) {
    let mut m = derive(mechanism);
    if regrouped {
        m.tree = regroup(&mut m.graph, &m.tree);
    }
    let roots = function(&mut m);
    (m.graph, roots)
}

fn interpret(mechanism: &Mechanism, state: &State, regrouped: bool, function: Function) -> Vec<f64> {
    let (graph, roots) = derived(mechanism, regrouped, function);
    let values = point(state);
    let symbols = |id: SymbolId| values[id.0];
    Evaluator::new(&graph, Real { symbols: &symbols }).run(&roots)
}

#[track_caller]
fn assert_near(what: &str, got: &[f64], want: &[f64], tolerance: f64) {
    assert_eq!(got.len(), want.len());
    // Some mechanisms need no force at all, but for rounding.
    let largest = want.iter().fold(1e-3_f64, |m, x| m.max(x.abs()));
    for (a, b) in got.iter().zip(want) {
        let error = (a - b).abs() / largest;
        assert!(error <= tolerance, "{what}: {a} for {b}, error {error:e}");
    }
}

/// The same trees in every run.
fn for_trees(cases: u32, test: impl Fn(Mechanism, Rng)) {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    runner
        .run(&(1..=12_usize, any::<u64>()), |(bodies, seed)| {
            let mut rng = Rng::new(seed);
            let mechanism = Mechanism::tree(&mut rng, bodies);
            test(mechanism, rng);
            Ok(())
        })
        .unwrap();
}

fn check_numbers(mechanism: &Mechanism, state: &State) {
    let State { q, v, a, effort } = state;
    let efforts = plain::inverse_dynamics(mechanism, q, v, a, mechanism.gravity);
    let bias_forces = plain::bias(mechanism, q, v);
    let matrix = plain::mass_matrix(mechanism, q);
    let accelerations = plain::forward_dynamics(mechanism, q, v, effort);
    for regrouped in [false, true] {
        let get = |function| interpret(mechanism, state, regrouped, function);
        assert_near("inverse dynamics", &get(inverse_dynamics), &efforts, 1e-10);
        assert_near("bias", &get(bias), &bias_forces, 1e-10);
        assert_near("mass matrix", &get(mass_matrix), &matrix.concat(), 1e-10);
        assert_near("mass matrix at the root", &get(mass_matrix_at_root), &matrix.concat(), 1e-10);
        for (what, function) in [("composite", by_composite as Function), ("articulated", by_articulated)] {
            let got = get(function);
            assert_near(what, &got, &accelerations, 1e-10);
            // Inverse after forward.
            let back = State { a: got, ..state.clone() };
            let back = interpret(mechanism, &back, regrouped, inverse_dynamics);
            let scale = bias_forces.iter().chain(effort).fold(0.0_f64, |m, x| m.max(x.abs()));
            for (b, e) in back.iter().zip(effort) {
                assert!((b - e).abs() <= 1e-10 * scale, "{what}: effort {e} came back as {b}");
            }
        }
    }
}

#[test]
fn recursions_agree_with_plain_numbers() {
    for_trees(96, |mechanism, mut rng| {
        let state = mechanism.state(&mut rng);
        check_numbers(&mechanism, &state);
    });
}

#[test]
fn floating_bases_agree_with_plain_numbers() {
    for seed in 0..40 {
        let mut rng = Rng::new(seed);
        let mut mechanism = Mechanism { gravity: [0.3, 0.0, -9.81], ..Mechanism::default() };
        mechanism.float(&mut rng);
        assert_eq!(floating_bases(&derive(&mechanism).tree).len(), 1, "{mechanism:?}");
        if rng.chance(50) {
            mechanism.float(&mut rng);
            assert!(!floating_bases(&derive(&mechanism).tree).is_empty());
        }
        let state = mechanism.state(&mut rng);
        check_numbers(&mechanism, &state);
    }
}

/// Two slides and a hinge are a plane's where the hinge stands across both, in their axes.
#[test]
fn what_is_no_plane() {
    let planar = (0..100).find_map(|seed| {
        let mut mechanism = Mechanism::default();
        mechanism.float(&mut Rng::new(seed));
        (mechanism.bodies.len() == 3).then_some(mechanism)
    });
    let planar = planar.expect("three in ten are planar");
    let bases = |mechanism: &Mechanism| floating_bases(&derive(mechanism).tree).len();
    assert_eq!(bases(&planar), 1);
    for slide in 0..2 {
        let mut along = planar.clone();
        let Kind::Prismatic(axis) = along.bodies[slide].kind else { panic!("a slide") };
        along.bodies[2].kind = Kind::Revolute(axis);
        assert_eq!(bases(&along), 0, "along slide {slide}");
    }
    let mut turned = planar;
    turned.bodies[2].placement = [2, 1, 0, 0];
    assert_eq!(bases(&turned), 0);
}

/// What acts on a carrier is felt by some of the translations only: without the floating base it says the same.
#[test]
fn carriers_may_be_pushed() {
    for seed in 0..20 {
        let mut rng = Rng::new(seed);
        let mut mechanism = Mechanism { gravity: [0.3, 0.0, -9.81], ..Mechanism::default() };
        mechanism.float(&mut rng);
        let state = mechanism.state(&mut rng);
        let carriers = floating_bases(&derive(&mechanism).tree)[0].carriers().collect::<Vec<_>>();
        // One of them, or all.
        for pushed in carriers.iter().map(std::slice::from_ref).chain([&carriers[..]]) {
            let wrenches: Vec<[f64; 6]> = (0..mechanism.bodies.len())
                .map(|link| if pushed.contains(&link) { [(); 6].map(|()| rng.real(0.5, 2.0)) } else { [0.0; 6] })
                .collect();
            let accelerations = |floats: bool| {
                let mut m = derive(&mechanism);
                let g = &mut m.graph;
                let applied: Vec<Wrench> = wrenches
                    .iter()
                    .map(|wrench| {
                        let [a, b, c, x, y, z] = wrench.map(|component| g.decimal(component));
                        Wrench { moment: g.vector([a, b, c]), force: g.vector([x, y, z]) }
                    })
                    .collect();
                let base = g.vector(m.tree.gravity.expect("gravity").map(|component| -component));
                let bases = if floats { floating_bases(&m.tree) } else { Vec::new() };
                let (tree, velocity) = (&m.tree, &m.tree.velocity);
                let roots = articulated::forward_dynamics(g, tree, &bases, velocity, base, &applied, &m.efforts);
                let values = point(&state);
                let symbols = |id: SymbolId| values[id.0];
                Evaluator::new(&m.graph, Real { symbols: &symbols }).run(&roots)
            };
            assert_near("pushed carriers", &accelerations(true), &accelerations(false), 1e-9);
        }
    }
}

#[test]
fn mass_matrices_are_symmetric_and_positive_definite() {
    for_trees(64, |mechanism, mut rng| {
        let state = mechanism.state(&mut rng);
        let n = mechanism.freedoms();
        let flat = interpret(&mechanism, &state, true, mass_matrix);
        let matrix: Vec<Vec<f64>> = flat.chunks(n).map(<[f64]>::to_vec).collect();
        for (i, row) in matrix.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                assert_eq!(entry, matrix[j][i]);
            }
        }
        assert!(plain::smallest_pivot(&matrix) > 0.0);
    });
}

#[track_caller]
fn assert_identical(what: &str, (a, xs): &(Graph, Vec<Scalar>), (b, ys): &(Graph, Vec<Scalar>)) {
    assert_eq!(identical(a, xs, b, ys, 0x7EE5), Verdict::Identical, "{what}");
}

#[test]
fn formulations_are_identical() {
    for_trees(48, |mechanism, _| {
        let get = |regrouped, function| derived(&mechanism, regrouped, function);
        let composite = get(false, by_composite);
        assert_identical("articulated", &composite, &get(false, by_articulated));
        assert_identical("articulated, regrouped", &composite, &get(true, by_articulated));
        assert_identical("composite, regrouped", &composite, &get(true, by_composite));
        assert_identical("inverse", &get(false, inverse_dynamics), &get(true, inverse_dynamics));
        assert_identical("mass", &get(false, mass_matrix), &get(true, mass_matrix));
        assert_identical("mass at the root", &get(false, mass_matrix), &get(true, mass_matrix_at_root));
    });
}

/// Links that turn about parallel axes, written in common ones.
#[test]
fn common_axes_change_no_value() {
    let written = Cell::new(0);
    for_trees(48, |mechanism, _| {
        for axes in [SharedAxes::Base, SharedAxes::Tip] {
            for function in [inverse_dynamics as Function, mass_matrix, by_composite, by_articulated] {
                let mut m = derive(&mechanism);
                m.tree = regroup(&mut m.graph, &m.tree);
                let Some(shared) = share_axes(&mut m.graph, &m.tree, axes) else { return };
                m.tree = shared.tree;
                let roots = function(&mut m);
                assert_identical("common axes", &(m.graph, roots), &derived(&mechanism, true, function));
                written.set(written.get() + 1);
            }
        }
    });
    assert!(written.get() > 40, "{}", written.get());
}

/// Efforts into accelerations and back, exactly modulo the prime.
#[test]
fn inverse_after_forward_is_exact() {
    for_trees(32, |mechanism, _| {
        let (graph, accelerations) = derived(&mechanism, true, by_articulated);
        let mut draw = Draw::new(&graph, 1);
        let found = Evaluator::new(&graph, Modular { draw: &draw }).run(&accelerations);
        let m = derive(&mechanism);
        for (&symbol, &value) in m.tree.acceleration.iter().zip(&found) {
            let ScalarNode::Symbol(id) = *m.graph.node(symbol) else { panic!("not a symbol") };
            draw.set(id, value);
        }
        let given = Evaluator::new(&m.graph, Modular { draw: &draw }).run(&m.efforts);
        let (graph, efforts) = derived(&mechanism, false, inverse_dynamics);
        assert_eq!(Evaluator::new(&graph, Modular { draw: &draw }).run(&efforts), given);
    });
}

/// The power of the efforts is the rate of the energy: d/dt (v . M v) / 2 = v . effort where no gravity pulls.
#[test]
fn power_balances() {
    for_trees(32, |mut mechanism, _| {
        mechanism.gravity = [0.0; 3];
        let mut m = derive(&mechanism);
        let matrix = mass_matrix(&mut m);
        let (g, v) = (&mut m.graph, &m.tree.velocity);
        let rows = matrix.chunks(v.len()).zip(v);
        let terms: Vec<Scalar> = rows
            .flat_map(|(row, &a)| row.iter().zip(v).map(move |(&e, &b)| [a, e, b]))
            .map(|t| g.product(&t))
            .collect();
        let (sum, half) = (g.sum(&terms), g.decimal(0.5));
        let energy = g.mul(half, sum);
        let rates = rates(g, &m.tree);
        let growth = g.derivative(energy, &rates);
        let growth = (m.graph, vec![growth]);
        let mut m = derive(&mechanism);
        let efforts = inverse_dynamics(&mut m);
        let terms: Vec<Scalar> = m.tree.velocity.iter().zip(&efforts).map(|(&v, &e)| m.graph.mul(v, e)).collect();
        let power = m.graph.sum(&terms);
        assert_identical("power", &growth, &(m.graph, vec![power]));
    });
}

/// How all symbols of a tree move: q' = v, quaternions by half their product with the angular velocity, v' = a.
fn rates(g: &mut Graph, tree: &Tree) -> Vec<(Scalar, Scalar)> {
    let mut rates: Vec<(Scalar, Scalar)> =
        tree.velocity.iter().copied().zip(tree.acceleration.iter().copied()).collect();
    let half = g.decimal(0.5);
    for link in &tree.links {
        let Motion::Ball(Orientation::Quaternion(q)) = link.motion else {
            rates.push((link.q, tree.velocity[link.freedom]));
            continue;
        };
        let [w, x, y, z] = q;
        let [a, b, c] = [0, 1, 2].map(|k| tree.velocity[link.freedom + k]);
        let products = [[-x, a, -y, b, -z, c], [w, a, y, c, -z, b], [w, b, z, a, -x, c], [w, c, x, b, -y, a]];
        for (symbol, list) in q.into_iter().zip(products) {
            let terms: Vec<Scalar> = list.chunks(2).map(|pair| g.product(&[half, pair[0], pair[1]])).collect();
            rates.push((symbol, g.sum(&terms)));
        }
    }
    rates
}

#[test]
fn lowering_changes_no_value() {
    for_trees(32, |mechanism, _| {
        for function in [inverse_dynamics as Function, by_composite, by_articulated] {
            let (graph, roots) = derived(&mechanism, true, function);
            let mut lowering = Lowering::new(&graph);
            let lowered = lowering.run(&roots);
            assert_identical("lowered", &(lowering.to, lowered), &(graph, roots));
        }
    });
}

/// Ways between links, against their ways from the ground.
#[test]
fn paths_between_links() {
    for_trees(32, |mechanism, _| {
        let tree = derive(&mechanism).tree;
        let ends: Vec<Option<usize>> = (0..tree.links.len()).map(Some).chain([None]).collect();
        let whole = |link: Option<usize>| tree.path(None, link);
        for &a in &ends {
            assert_eq!(whole(a).last().copied(), a);
            let parents: Vec<Option<usize>> = whole(a).iter().map(|&link| tree.links[link].parent).collect();
            let before: Vec<Option<usize>> = [None].into_iter().chain(whole(a).into_iter().map(Some)).collect();
            assert!(before.starts_with(&parents));
            for &b in &ends {
                let shared = whole(a).into_iter().zip(whole(b)).take_while(|(x, y)| x == y).count();
                let common = tree.common(a, b);
                assert_eq!(whole(common), whole(a)[..shared]);
                assert_eq!(tree.path(common, a), whole(a)[shared..]);
                assert_eq!(tree.path(common, b), whole(b)[shared..]);
            }
        }
    });
}
