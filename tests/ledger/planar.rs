//! Only what is needed is derived: planar chains come out planar, no gravity declared leaves no gravity terms, a point mass
//! has no inertia terms, and nothing is made that `emit` does not ask for.

use std::collections::BTreeSet;

use multibody_engine::contracts::cost::Cost;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::emit::emit;
use multibody_engine::model::types::Model;
use multibody_engine::optimize::program::{Compiled, Expression, Program};
use multibody_engine::{mechanics, optimize};
use multibody_tests::support::engine::model_of;

fn compiled(model: &Model) -> Compiled {
    optimize::compile(&mechanics::of(model).unwrap_or_else(|_| panic!("mechanics")).1)
        .unwrap_or_else(|_| panic!("too large"))
}

fn of(text: &str) -> (Model, Compiled) {
    let model = model_of(text);
    let compiled = compiled(&model);
    (model, compiled)
}

fn cost(compiled: &Compiled, kind: FunctionKind) -> Cost {
    compiled.functions.iter().find(|f| f.kind == kind).unwrap().after
}

fn collect(expression: &Expression, into: &mut BTreeSet<Symbol>) {
    match expression {
        Expression::Symbol(symbol) => drop(into.insert(*symbol)),
        Expression::Literal(_) | Expression::Field(_) | Expression::Local(_) => {}
        Expression::Neg(inner) => collect(inner, into),
        Expression::Sum(terms) => terms.iter().for_each(|(_, term)| collect(term, into)),
        Expression::Product(list) | Expression::Call(_, list) | Expression::Pack(list) => {
            list.iter().for_each(|e| collect(e, into));
        }
        Expression::Fused(operands) => operands.iter().for_each(|e| collect(e, into)),
        Expression::Quotient(a, b) => [a, b].into_iter().for_each(|e| collect(e, into)),
    }
}

fn symbols(programs: impl IntoIterator<Item = Program>) -> BTreeSet<Symbol> {
    let mut found = BTreeSet::new();
    for program in programs {
        program.expressions().for_each(|expression| collect(expression, &mut found));
    }
    found
}

/// Names of the params that are read anywhere, with the element of a vector.
fn params(model: &Model, compiled: &Compiled) -> Vec<String> {
    let programs = compiled.functions.iter().map(|f| f.program.clone()).chain([compiled.prelude.clone()]);
    let read = symbols(programs).into_iter().filter_map(|symbol| match symbol {
        Symbol::Param { param, element } => Some(format!("{}{element}", model.params[param].place.field)),
        _ => None,
    });
    read.collect()
}

const ALL: &str = "emit forward_dynamics, inverse_dynamics, mass_matrix, bias;";

/// Two links in the plane of x and y, everything about them adjustable.
fn two_links(world: &str, emit: &str) -> String {
    format!(
        "mod m {{
            param g: Vec3 = [0.1, -9.81, 0.2]; param m1 = 1.0; param m2 = 2.0;
            param c1: Vec3 = [0.1, 0.2, 0.3]; param c2: Vec3 = [0.2, 0.3, 0.4]; param l: Vec3 = [0.5, 0.6, 0.7];
            param i1: [Scalar; 6] = [1.0, 1.1, 1.2, 0.1, 0.2, 0.3]; param i2: [Scalar; 6] = [1.3, 1.4, 1.5, 0.1, 0.2, 0.3];
            {world}
            body a {{ mass: m1, com: c1, inertia: inertia(i1[0], i1[1], i1[2], i1[3], i1[4], i1[5]) }}
            body b {{ mass: m2, com: c2, inertia: inertia(i2[0], i2[1], i2[2], i2[3], i2[4], i2[5]) }}
            joint one: Revolute {{ parent: ground, child: a, axis: Z }}
            joint two: Revolute {{ parent: a.at(l), child: b, axis: Z }}
            {emit}
        }}"
    )
}

#[test]
fn a_planar_chain_reads_what_lies_in_its_plane() {
    let (model, compiled) = of(&two_links("world { gravity: g }", ALL));
    let read = params(&model, &compiled);
    for name in &read {
        // Of tensors zz alone, of vectors no z.
        let (stem, element) = name.split_at(name.len() - 1);
        let allowed = match stem {
            "i1" | "i2" => element == "2",
            "c1" | "c2" | "l" | "g" => element != "2",
            _ => true,
        };
        assert!(allowed, "{name} is read, of {read:?}");
    }
    for name in ["g0", "g1", "m10", "m20", "c10", "c11", "c20", "c21", "l0", "l1", "i12", "i22"] {
        assert!(read.iter().any(|r| r == name), "{name} is not read, only {read:?}");
    }
    // The mass matrix knows the angle between the links alone; what gravity turns needs both absolute angles.
    assert_eq!(cost(&compiled, FunctionKind::MassMatrix).sincos, 1);
    for kind in [FunctionKind::ForwardDynamics, FunctionKind::InverseDynamics, FunctionKind::Bias] {
        assert_eq!(cost(&compiled, kind).sincos, 2, "{kind:?}");
    }
}

#[test]
fn no_gravity_no_gravity_terms() {
    let (model, compiled) = of(&two_links("", ALL));
    assert!(!params(&model, &compiled).iter().any(|name| name.starts_with('g')));
    let with = of(&two_links("world { gravity: g }", ALL)).1;
    for kind in [FunctionKind::ForwardDynamics, FunctionKind::InverseDynamics, FunctionKind::Bias] {
        let (less, more) = (cost(&compiled, kind), cost(&with, kind));
        assert!(less.add < more.add && less.mul < more.mul && less.sincos < more.sincos, "{kind:?}");
        assert_eq!(less.sincos, 1);
    }
    // The position of the first joint does not matter without gravity.
    let read = symbols(compiled.functions.into_iter().map(|f| f.program));
    let first = |symbol: &Symbol| matches!(symbol, Symbol::Position { joint, .. } if joint.0 == 0);
    assert!(!read.iter().any(first));
}

#[test]
fn a_point_mass_has_no_inertia_terms() {
    let text = |inertia: &str| {
        format!(
            "mod m {{ world {{ gravity: -9.81 * Y }}
                body a {{ mass: 1.5, com: -Y{inertia} }} body b {{ mass: 0.7, com: -0.4 * Y{inertia} }}
                joint one: Revolute {{ parent: ground, child: a, axis: Z }}
                joint two: Revolute {{ parent: a.at(-Y), child: b, axis: Z }} {ALL} }}"
        )
    };
    let (_, point) = of(&text(""));
    let (_, rigid) = of(&text(", inertia: diag(0.3, 0.2, 0.5)"));
    for kind in [FunctionKind::InverseDynamics, FunctionKind::ForwardDynamics] {
        let (less, more) = (cost(&point, kind).weight(), cost(&rigid, kind).weight());
        assert!(less <= more, "{kind:?}: {less}, {more}");
    }
    // The one inertia there is counts, since both turn with the first joint.
    let one = "mod m { param m = 1.0; param l = 1.0; param i = 1.0; body a { mass: m, com: l * X } body b { mass: 2.0, inertia: diag(i, i, i) }
        joint one: Revolute { parent: ground, child: a, axis: Z } joint two: Prismatic { parent: a.at(l * X), child: b, axis: Y }
        emit mass_matrix; }";
    let (model, compiled) = of(one);
    assert_eq!(params(&model, &compiled), ["m0", "l0", "i0"]);
}

#[test]
fn a_body_that_cannot_turn_has_no_inertia() {
    let (model, compiled) =
        of("mod m { param m = 1.0; param c: Vec3 = [1.0, 2.0, 3.0]; param i = 1.0; world { gravity: -9.81 * Z }
        body a { mass: m, com: c, inertia: diag(i, i, i) } joint one: Prismatic { parent: ground, child: a, axis: Z }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias; }");
    assert_eq!(params(&model, &compiled), ["m0"]);
    let fall = cost(&compiled, FunctionKind::ForwardDynamics);
    assert_eq!(fall, Cost::default(), "a body falls as all do");
}

/// The plane may lie anywhere, and hinges may turn either way.
#[test]
fn planes_at_any_angle_are_planes() {
    let chain = |frame: &str, axis: &str, offset: &str, gravity: &str| {
        let body = |k: usize| {
            let parent = if k == 0 { frame.to_owned() } else { format!("b{}.at({offset})", k - 1) };
            format!(
                "body b{k} {{ mass: 1.5, com: {offset}, inertia: diag(0.3, 0.4, 0.5) }}
                 joint j{k}: Revolute {{ parent: {parent}, child: b{k}, axis: {axis} }}"
            )
        };
        let bodies: String = (0..5).map(body).collect();
        let text = format!("mod m {{ world {{ gravity: {gravity} }} {bodies} {ALL} }}");
        of(&text).1
    };
    let flat = chain("ground", "Z", "-Y", "-9.81 * Y");
    let others = [
        chain("ground", "-Z", "-Y", "-9.81 * Y"),
        chain("ground", "X", "-Z", "-9.81 * Z"),
        chain("ground.rotated(X, 0.5 * PI)", "Z", "-Y", "-9.81 * Z"),
    ];
    for other in &others {
        for function in &flat.functions {
            let (a, b) = (function.after, cost(other, function.kind));
            // Signs and the inertia about the axis differ, and with them a product here and there.
            assert_eq!((a.div, a.sincos), (b.div, b.sincos), "{:?}: {a:?} {b:?}", function.kind);
            assert!(a.weight().abs_diff(b.weight()) * 20 <= a.weight(), "{:?}: {a:?} {b:?}", function.kind);
        }
    }
    for kind in [FunctionKind::ForwardDynamics, FunctionKind::InverseDynamics] {
        assert_eq!(cost(&flat, kind).sincos, 5);
    }
}

#[test]
fn nothing_is_made_that_is_not_asked_for() {
    let kinds = |emit: &str| -> Vec<FunctionKind> {
        let (_, compiled) = of(&two_links("world { gravity: g }", emit));
        compiled.functions.iter().map(|f| f.kind).collect()
    };
    use FunctionKind::*;
    assert_eq!(kinds(""), [ForwardDynamics]);
    assert_eq!(kinds("output p = b.position;"), [ForwardDynamics, Outputs]);
    assert_eq!(kinds("emit bias;"), [Bias]);
    assert_eq!(kinds("emit energy; output p = b.position;"), [KineticEnergy, PotentialEnergy, Outputs]);
    assert_eq!(kinds(ALL), [ForwardDynamics, InverseDynamics, MassMatrix, Bias]);
    let (model, compiled) = of(&two_links("world { gravity: g }", "emit bias;"));
    let text = emit(&model, &mechanics::loops::structure::Structure::open(&model), &compiled).to_string();
    assert!(text.contains("fn bias"));
    // What tells callers of a function that it was not asked for has a type parameter.
    for name in ["forward_dynamics", "mass_matrix", "inverse_dynamics", "outputs", "kinetic_energy"] {
        assert!(!text.contains(&format!("fn {name} (")), "{name}");
    }
}
