//! Every rewrite pass under the exact identity test, whose draws have nothing in common with the prints by which passes
//! find equal values, and in double precision: arms, models from text, random expressions.

use crate::arms::{ARMS, Arm, load};
use crate::expressions::{Expression, SYMBOLS};
use crate::formulations;
use crate::rebuild::rebuild;
use crate::rng::Rng;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::results::Results;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::dynamics::regroup::regroup;
use multibody_engine::mechanics::{Derivation, Derived, of};
use multibody_engine::model::types::{InputId, JointId, ParamId};
use multibody_engine::optimize::dag::{Dag, Kind};
use multibody_engine::optimize::{Pass, compile, fields, flatten, passes, simplify};
use multibody_engine::symbolic::graph::{Graph, Scalar, ScalarNode};
use multibody_engine::symbolic::identity::{Verdict, close, identical};
use multibody_engine::symbolic::lower::Lowering;
use multibody_engine::symbolic::number::Number;
use multibody_engine::{model, syntax};
use std::iter;

/// Relative to 1 + |x|: passes reorder sums, and mechanisms at random points are not well conditioned.
const TOLERANCE: f64 = 1e-7;

/// Expressions as they were derived, without vectors.
struct Reference {
    graph: Graph,
    roots: Vec<Scalar>,
}

impl Reference {
    /// What the exact test and the one in double precision say of a DAG.
    fn compare(&self, dag: &Dag, seed: u64) -> (Verdict, Verdict) {
        let (graph, roots) = rebuild(&self.graph, dag);
        let exact = identical(&self.graph, &self.roots, &graph, &roots, seed);
        (exact, close(&self.graph, &self.roots, &graph, &roots, seed, TOLERANCE))
    }
}

/// Lowers a derivation's results, as `compile` does.
fn lower(derivation: &Derivation, results: &[Scalar]) -> (Reference, Dag) {
    let mut lowering = Lowering::new(&derivation.graph);
    let roots = lowering.run(results);
    let dag = Dag::import(&lowering.to, &roots, &derivation.symbols);
    (Reference { graph: lowering.to, roots }, dag)
}

/// All passes one by one, then all at once. Returns what has been said of them, with their names.
fn said(derivation: &Derivation, results: &[Scalar], seed: u64) -> Vec<(String, Verdict, Verdict)> {
    let (reference, imported) = lower(derivation, results);
    let mut list = Vec::new();
    let mut say = |name: String, dag: &Dag| {
        let (exact, real) = reference.compare(dag, seed + list.len() as u64);
        list.push((name, exact, real));
    };
    say("import".into(), &imported);
    let mut dag = imported.clone();
    let flat: Pass = ("flatten", flatten::flatten);
    for (k, (name, pass)) in iter::once(flat).chain(passes()).enumerate() {
        pass(&mut dag);
        say(format!("{name}, pass {k}"), &dag);
    }
    let mut whole = imported;
    assert!(simplify(&mut whole), "simplify is not sound");
    say("simplify".into(), &whole);
    list
}

/// Every candidate of every function keeps its values, and the values that depend on parameters alone do.
fn check(what: &str, derivation: &Derivation) {
    let mut simplified = Vec::new();
    for function in &derivation.functions {
        for (method, results) in &function.candidates {
            for (pass, exact, real) in said(derivation, &results.list, 17) {
                let place = format!("{what}, {:?}, {method}, {pass}", function.kind);
                assert_eq!(exact, Verdict::Identical, "{place}");
                assert_eq!(real, Verdict::Identical, "{place}, in double precision");
            }
            let (_, mut dag) = lower(derivation, &results.list);
            simplify(&mut dag);
            simplified.push(dag);
        }
    }
    check_fields(what, derivation, &simplified.iter().collect::<Vec<_>>());
    assert!(compile(derivation).is_ok_and(|compiled| compiled.sound), "{what}");
}

/// `Model::new` is gathered from the functions and simplified by itself.
fn check_fields(what: &str, derivation: &Derivation, dags: &[&Dag]) {
    let gathered = fields::gather(dags, &derivation.symbols).prelude;
    let (graph, roots) = rebuild(&derivation.graph, &gathered);
    let reference = Reference { graph, roots };
    let mut prelude = gathered;
    assert!(simplify(&mut prelude), "{what}, fields");
    let same = (Verdict::Identical, Verdict::Identical);
    assert_eq!(reference.compare(&prelude, 23), same, "{what}, fields");
}

type Function = (FunctionKind, &'static str, fn(&mut Arm) -> Vec<Scalar>);

const FUNCTIONS: [Function; 4] = [
    (FunctionKind::InverseDynamics, "Newton-Euler", |arm| {
        let (velocity, acceleration) = (arm.tree.velocity.clone(), arm.tree.acceleration.clone());
        formulations::inverse_dynamics(&mut arm.graph, &arm.tree, &velocity, &acceleration)
    }),
    (FunctionKind::MassMatrix, "composite", |arm| formulations::mass_matrix(&mut arm.graph, &arm.tree)),
    (FunctionKind::ForwardDynamics, "composite", |arm| {
        formulations::by_composite(&mut arm.graph, &arm.tree, &arm.efforts)
    }),
    (FunctionKind::ForwardDynamics, "articulated", |arm| {
        formulations::by_articulated(&mut arm.graph, &arm.tree, &arm.efforts)
    }),
];

/// One function of an arm, in a graph of its own.
fn arm(name: &str, (kind, method, results): Function) -> Derivation {
    let mut arm = load(name);
    arm.tree = regroup(&mut arm.graph, &arm.tree);
    let results = results(&mut arm);
    let n = arm.tree.freedoms();
    let of = |make: fn(usize) -> Symbol| (0..n).map(make);
    let symbols = of(|k| Symbol::Position { joint: JointId(k), component: 0 })
        .chain(of(|k| Symbol::Velocity { joint: JointId(k), component: 0 }))
        .chain(of(|k| Symbol::Acceleration { joint: JointId(k), component: 0 }))
        .chain(of(|k| Symbol::Input { input: InputId(0), element: k }));
    derivation(arm.graph, symbols.collect(), kind, method, results)
}

fn derivation(
    graph: Graph,
    symbols: Vec<Symbol>,
    kind: FunctionKind,
    method: &'static str,
    results: Vec<Scalar>,
) -> Derivation {
    let symbol_names = (0..symbols.len()).map(|k| format!("symbol{k}")).collect();
    let functions = vec![Derived { kind, candidates: vec![(method, Results::vector(results))] }];
    Derivation {
        graph,
        symbols,
        symbol_names,
        functions,
        at: Vec::new(),
        notes: Vec::new(),
        dead_centres: Vec::new(),
        modes: None,
        pivoted: Vec::new(),
        page: None,
        checks: Vec::new(),
        inertia: Default::default(),
        witnesses: Vec::new(),
        limbs: None,
        turns: Vec::new(),
    }
}

/// The equations of the body of a `mod m { .. }`.
fn from_text(body: &str) -> Derivation {
    let mut diagnostics = Diagnostics::default();
    let tokens = format!("mod m {{ {body} }}").parse().expect("tokens");
    let source = syntax::parse(tokens, &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    let messages: Vec<&str> = diagnostics.errors().iter().map(|error| error.message.as_str()).collect();
    assert!(messages.is_empty(), "{messages:?}");
    of(&models[0]).map(|(_, derivation)| derivation).expect("a mechanism")
}

#[test]
fn arms_keep_values() {
    for name in ARMS {
        for function in FUNCTIONS {
            check(&format!("{name}, {}", function.1), &arm(name, function));
        }
    }
}

const PENDULUM: &str = "
    param m1 = 1.0; param m2 = 1.5; param l1 = 0.8; param l2 = 1.2; param k = 3.0; input u;
    world { gravity: -9.81 * Y }
    body upper { mass: m1, com: -0.5 * l1 * Y, inertia: rod(m1, l1, Y) }
    body lower { mass: m2, com: -0.5 * l2 * Y, inertia: rod(m2, l2, Y) }
    joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
    joint elbow: Revolute { parent: upper.at(-l1 * Y), child: lower, axis: Z }
    force spring: Spring { joint: elbow, stiffness: k * k, rest: 0.1 }
    force motor: Effort { joint: shoulder, value: u - 0.25 * shoulder.rate }
    output tip: Vec3 = lower.at(-l2 * Y).position;
    output energy = kinetic() + potential();
    emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;";

#[test]
fn pendulums_keep_values() {
    check("pendulum", &from_text(PENDULUM));
}

#[test]
fn calls_keep_values() {
    check(
        "calls",
        &from_text(
            "param a = 1.0; param b = 2.0; param c = 0.5; input u; input w: Vec3;
             state s: rate = u - 2.0 * s * a - j1.rate, start: 0.5;
             body b1 { mass: a, com: 0.1 * X, inertia: sphere(a, 0.3) }
             body b2 { mass: b, inertia: cuboid(b, [0.1, 0.2, c]) }
             joint j1: Revolute { parent: ground, child: b1, axis: Z, armature: 0.1 }
             joint j2: Universal { parent: b1.at(c * X), child: b2, axes: [X, Y] }
             force f: SpringDamper { between: [b2.at(c * X), ground.at(2.0 * Z)], stiffness: a, damping: b, length: 0.4 }
             force g: Effort { joint: j1, value: select(j1 > c, u, 3.0 * c * sin(2.0 * t)) }
             force h: Torque { at: b2, value: w, axes: b2 }
             let reach = b2.position - b1.position;
             output least = min(a * j1, b * j1 + c) + max(u, -u) - min(2.0 * c, a * b);
             output root = sqrt(a * a + 4.0 * c) + sqrt(1.0 + j1 * j1) / sqrt(b);
             output angle = atan2(3.0 * a * sin(j1), 3.0 * a * cos(j1)) + atan2(u, b);
             output chosen = select(u > 0.0 && !(t < a), reach + a * X, X - 2.0 * reach);
             output power = f.power + norm(cross(reach, w)) * exp(-a * t) + powi(u, 3);
             output turned = sin(j1 + 2.0 * t) * cos(j1 - 2.0 * t) + sin(a + b) * cos(0.3 + j1);
             emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;",
        ),
    );
}

#[test]
fn quaternions_keep_values() {
    check(
        "ball",
        &from_text(
            "param m = 2.0; param r = 0.3; input u: Vec3;
             world { gravity: -9.81 * Z }
             body b { mass: m, com: r * Z, inertia: cuboid(m, [r, 0.2, 0.3]) }
             joint j: Ball { parent: ground, child: b }
             force f: Torque { at: b, value: u, axes: ground }
             force s: Spring { between: [b.at(r * X), ground.at(X)], stiffness: 10.0, length: 0.5 }
             output height = b.at(r * X).position;
             output rotation = b.rotation;
             output power = s.power;
             emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;",
        ),
    );
    check(
        "free",
        &from_text(
            "param m = 2.0; param r = 0.3; input u: Vec3;
             world { gravity: -9.81 * Z }
             body b { mass: m, com: [0.1, r, 0.0], inertia: diag(1.0, 1.5, 2.0 * r) }
             body arm { mass: 0.5, com: 0.2 * X, inertia: rod(0.5, 0.4, X) }
             joint j: Free { parent: ground, child: b }
             joint hinge: Revolute { parent: b.at(r * Z), child: arm, axis: Y }
             force f: Force { at: arm.at(0.4 * X), value: u, axes: arm }
             output tip: Vec3 = arm.at(0.4 * X).position;
             output moment: Wrench = hinge.reaction.express(b);
             output pose = b.pose;
             output jacobian = arm.jacobian;
             emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;",
        ),
    );
}

/// Symbols of all stages.
const STAGES: [Symbol; SYMBOLS] = [
    Symbol::Param { param: ParamId(0), element: 0 },
    Symbol::Param { param: ParamId(1), element: 0 },
    Symbol::Time,
    Symbol::Position { joint: JointId(0), component: 0 },
    Symbol::Input { input: InputId(0), element: 0 },
];

/// Whether a quotient by nothing is left: `compile` refuses it, and there is no value that a pass could keep.
fn divides_by_zero(derivation: &Derivation) -> bool {
    let (Reference { graph, roots }, _) = lower(derivation, &derivation.functions[0].candidates[0].1.list);
    let nothing = |index| matches!(graph.node(graph.scalar_at(index)), ScalarNode::Reciprocal(x) if *x == Scalar::ZERO);
    graph.reachable_scalars(&roots).into_iter().any(nothing)
}

/// Several results over the same symbols. Roots and quotients may have no value, or none that is exact enough.
#[test]
fn random_expressions_keep_values() {
    let (mut exactly, mut closely, mut all) = (0, 0, 0);
    for seed in 0..40 {
        let mut rng = Rng::new(31_000 + seed);
        let mut graph = Graph::new();
        let symbols = [(); SYMBOLS].map(|()| graph.symbol());
        let list: Vec<Expression> = (0..3).map(|_| Expression::random(&mut rng, 5)).collect();
        let results = list.iter().map(|e| e.make(&mut graph, &symbols)).collect();
        let derivation = derivation(graph, STAGES.to_vec(), FunctionKind::Outputs, "random", results);
        if divides_by_zero(&derivation) {
            continue;
        }
        for (pass, exact, real) in said(&derivation, &derivation.functions[0].candidates[0].1.list, 100 * seed) {
            assert!(!matches!(exact, Verdict::Different(_)), "seed {seed}, {pass}, {exact:?}: {list:?}");
            assert!(!matches!(real, Verdict::Different(_)), "seed {seed}, {pass}, {real:?}: {list:?}");
            exactly += usize::from(exact == Verdict::Identical);
            closely += usize::from(real == Verdict::Identical);
            all += 1;
        }
        assert!(compile(&derivation).is_ok_and(|compiled| compiled.sound), "seed {seed}");
    }
    assert!(10 * exactly > 9 * all && 10 * closely > 9 * all, "{exactly} and {closely} of {all}");
}

/// Each coefficient, sine, cosine and root that a DAG has, changed by itself: all are noticed.
#[test]
fn broken_passes_are_told() {
    let pendulum = from_text(PENDULUM);
    let cases = pendulum.functions.iter().map(|f| (&pendulum, &f.candidates[0].1.list));
    let arm = arm("cart5", FUNCTIONS[2]);
    let (mut coefficients, mut swaps) = (0, 0);
    for (derivation, results) in cases.chain([(&arm, &arm.functions[0].candidates[0].1.list)]) {
        let (reference, mut dag) = lower(derivation, results);
        simplify(&mut dag);
        let told = |broken: &Dag, what: &str| {
            let (graph, roots) = rebuild(&reference.graph, broken);
            let verdict = identical(&reference.graph, &reference.roots, &graph, &roots, 5);
            assert!(matches!(verdict, Verdict::Different(_)), "{what}: {verdict:?}");
        };
        for id in dag.order() {
            let mut broken = dag.clone();
            match &mut broken.nodes[id].kind {
                Kind::Sum(terms) => {
                    coefficients += 1;
                    terms[0].0 = terms[0].0 + Number::ONE;
                }
                kind @ (Kind::Sin(_) | Kind::Cos(_)) => {
                    swaps += 1;
                    *kind = match *kind {
                        Kind::Sin(angle) => Kind::Cos(angle),
                        Kind::Cos(angle) => Kind::Sin(angle),
                        _ => continue,
                    };
                }
                _ => continue,
            }
            told(&broken, &format!("node {id}, {:?}", dag.nodes[id].kind));
        }
        for k in 0..dag.roots.len() {
            let mut broken = dag.clone();
            broken.roots[k].0 = broken.roots[k].0 + Number::ONE;
            told(&broken, &format!("root {k}"));
        }
    }
    assert!(coefficients > 50 && swaps > 10, "{coefficients} and {swaps}");
}

/// An operation on what reads the node already would have it depend on itself, however many steps the way back has.
#[test]
fn no_node_is_rewritten_to_read_itself() {
    let mut g = Graph::new();
    let [x, y, z] = [(); 3].map(|()| g.symbol());
    let p = g.mul(x, y);
    let s = g.add(p, z);
    let t = g.mul(s, x);
    let symbols = vec![STAGES[3], STAGES[4], STAGES[2]];
    let (_, mut dag) = lower(&derivation(g, symbols, FunctionKind::Outputs, "", vec![p, s, t]), &[p, s, t]);
    let [p, s, t] = [0, 1, 2].map(|root| dag.roots[root].1);
    let z = (0..dag.nodes.len()).find(|&id| matches!(&dag.nodes[id].kind, Kind::Symbol(of) if of.0 == 2));
    let z = z.expect("it is read");
    let minus = Number::integer(-1);
    // p = s - z, and p = s - z + t - t.
    assert!(!dag.rewrite(p, Kind::Sum(vec![(minus, z), (Number::ONE, s)])));
    assert!(!dag.rewrite(p, Kind::Sum(vec![(minus, z), (minus, t), (Number::ONE, t), (Number::ONE, s)])));
    assert_eq!(dag.nodes[s].kind, Kind::Sum(dag.normal_terms(vec![(Number::ONE, p), (Number::ONE, z)])));
}
