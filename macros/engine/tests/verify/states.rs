//! States at which programs and laws are judged: what the usual ones don't show.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::mechanics::Inertia;
use multibody_engine::optimize::program::{Doubt, Expression, Part, Unchecked};
use multibody_engine::symbolic::graph::Scalar;
use multibody_engine::{emit, optimize, verify};

use crate::breaks::{Case, each};

fn arm(rest: &str) -> Case {
    Case::new(&format!(
        "pub mod arm {{
            world {{ gravity: -9.81 * Y }}
            body a {{ mass: 1.0, com: X, inertia: diag(0.1, 0.1, 0.1) }}
            joint j: Revolute {{ parent: ground, child: a, axis: Z }}
            {rest}
        }}"
    ))
}

/// Every literal that is this one, or its opposite, becomes another.
fn replace(program: &mut optimize::program::Program, from: f64, to: f64) -> usize {
    let mut count = 0;
    each(program, &mut |expression| {
        if let Expression::Literal(x) = expression
            && x.abs() == from
        {
            *x = to.copysign(*x);
            count += 1;
        }
    });
    count
}

/// Values that are finite far from where states are drawn first.
#[test]
fn numbers_of_other_sizes() {
    let case = arm("input load; output o = sqrt(load - 3.0) * j;");
    assert_eq!(case.check(&case.compiled).unchecked, []);
    let mut compiled = case.compiled.clone();
    let outputs = compiled.functions.iter_mut().find(|f| f.kind == FunctionKind::Outputs).unwrap();
    assert_eq!(replace(&mut outputs.program, 3.0, 3.000_001), 1);
    assert_eq!(case.check(&compiled).wrong, [FunctionKind::Outputs]);
}

/// What has no value anywhere is accepted, and the module's documentation says that nothing was compared.
#[test]
fn what_is_never_finite_is_said() {
    let case = arm("input load; output o = ln(-1.0 - load * load);");
    let unchecked = Unchecked { part: Part::Function(FunctionKind::Outputs), doubt: Doubt::NotFinite };
    assert_eq!(case.check(&case.compiled).unchecked, [unchecked]);
    let compiled = verify::compile(&case.model, &case.structure, &case.derivation).unwrap();
    let report = emit::report(&case.model, &case.structure, &compiled);
    assert!(report.contains("## Not checked in numbers"), "{report}");
    assert!(report.contains("- `outputs`: some value is not finite"), "{report}");
    let clear = arm("output o = j;");
    let compiled = verify::compile(&clear.model, &clear.structure, &clear.derivation).unwrap();
    assert!(!emit::report(&clear.model, &clear.structure, &compiled).contains("Not checked"));
}

/// Where parameters are zero nothing shows of what they multiply: a function that is clear there alone is not checked.
#[test]
fn defaults_alone_are_said() {
    let case = arm("param extra = 0.0; output o = sqrt(-extra * extra) + j;");
    let unchecked = Unchecked { part: Part::Function(FunctionKind::Outputs), doubt: Doubt::NotFinite };
    assert_eq!(case.check(&case.compiled).unchecked, [unchecked]);
}

/// A term times a parameter that is zero by default contradicts other functions all the same.
#[test]
fn parameters_of_zero() {
    let mut case = arm("param extra = 0.0;
        output o = extra;
        emit forward_dynamics, inverse_dynamics, mass_matrix, energy;");
    assert_eq!(case.check(&case.compiled).broken, None);
    let outputs = case.derivation.functions.iter().find(|f| f.kind == FunctionKind::Outputs).unwrap();
    let extra = outputs.candidates[0].1.list[0];
    let energy = case.derivation.functions.iter().position(|f| f.kind == FunctionKind::KineticEnergy).unwrap();
    for candidate in &mut case.derivation.functions[energy].candidates {
        let results = &mut candidate.1.list;
        results[0] = case.derivation.graph.add(results[0], extra);
    }
    let compiled = optimize::compile(&case.derivation).unwrap();
    let found = case.check(&compiled);
    assert!(found.wrong.is_empty() && found.broken.is_some(), "{found:?}");
}

/// Parameters that are equal by default are no reason not to judge what compares them.
#[test]
fn parameters_that_are_equal() {
    let case = arm("param low = 0.3;
        param high = 0.3;
        force motor: Effort { joint: j, value: select(low < high, 1.0, 2.0) * max(low, high) }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;");
    assert_eq!(case.check(&case.compiled).unchecked, []);
}

/// A wrong result among many that rounding may have moved further.
#[test]
fn suspects_hide_nobody() {
    let inputs = ["i1", "i2", "i3", "i4", "i5", "i6"];
    let declared: String = inputs.iter().map(|name| format!("input {name};")).collect();
    // A product with a power of two has no rounding, so the equations as derived are better than their bound.
    let steep: String = inputs.iter().map(|name| format!("output of_{name} = sin(134217728.0 * {name});")).collect();
    let case = arm(&format!("{declared} {steep} output plain = 0.7 * (i1 + j);"));
    let mut compiled = case.compiled.clone();
    let outputs = compiled.functions.iter_mut().find(|f| f.kind == FunctionKind::Outputs).unwrap();
    assert!(replace(&mut outputs.program, 134_217_728.0, 134_217_728.0 * (1.0 + f64::EPSILON)) >= 5);
    let found = case.check(&compiled);
    assert!(found.wrong.is_empty(), "{found:?}");
    let outputs = compiled.functions.iter_mut().find(|f| f.kind == FunctionKind::Outputs).unwrap();
    assert_eq!(replace(&mut outputs.program, 0.7, 0.7 * (1.0 + 1e-9)), 1);
    assert_eq!(case.check(&compiled).wrong, [FunctionKind::Outputs]);
}

/// The program of `Params::check` is compared as functions are.
#[test]
fn tests_of_parameters() {
    let case =
        arm("param mass = 2.0; body b { mass: mass * 3.0 - 1.0, com: X } joint k: Fixed { parent: a, child: b }");
    let found = case.check(&case.compiled);
    assert!(!found.wrong_checks && found.unchecked.is_empty(), "{found:?}");
    let (mut told, mut count) = (0, 0);
    each(&mut case.compiled.checks.program.clone(), &mut |_| count += 1);
    for at in 0..count {
        let mut compiled = case.compiled.clone();
        let (mut number, mut changed) = (0, false);
        each(&mut compiled.checks.program, &mut |expression| {
            if let (true, Expression::Literal(x)) = (number == at, expression) {
                *x *= 1.000_001;
                changed = true;
            }
            number += 1;
        });
        if changed {
            assert!(case.check(&compiled).wrong_checks, "node {at}");
            told += 1;
        }
    }
    assert!(told > 0, "{:?}", case.compiled.checks);
}

/// The mass matrix of `System::without_inertia` is compared too, where it may be singular; literals prove where it is not.
#[test]
fn matrices_that_may_be_singular() {
    let own = |case: &Case| matches!(case.compiled.inertia, Inertia::Own(_));
    let case = arm(
        "param mass = 2.0; body b { mass: 3.0 * mass, com: X } joint k: Revolute { parent: a.at(X), child: b, axis: Z }",
    );
    let found = case.check(&case.compiled);
    assert!(own(&case) && !found.wrong_inertia && found.unchecked.is_empty(), "{found:?}");
    // Nothing but parameters is kept for it: `Model::new` has no more to compute.
    let mut compiled = case.compiled.clone();
    let Inertia::Own(program) = &mut compiled.inertia else { panic!() };
    assert!(replace(program, 3.0, 3.000_001) > 0, "{program:?}");
    let found = case.check(&compiled);
    assert!(found.wrong_inertia && found.wrong.is_empty(), "{found:?}");
    let mut regular = case.derivation;
    regular.inertia = Inertia::Regular;
    assert_eq!(optimize::compile(&regular).unwrap().prelude_cost, case.compiled.prelude_cost);
    let heavy = "body b { mass: 3, com: X, inertia: diag(1, 1, 1) }";
    let point = "body b { mass: 3, com: X }";
    let revolute = "joint k: Revolute { parent: a.at(X), child: b, axis: Z }";
    let geared = "joint k: Revolute { parent: a.at(X), child: b, axis: Z, armature: 0.01 }";
    for (parts, singular) in [
        ([heavy, revolute, ""], false),
        ([heavy, "joint k: Ball { parent: a.at(X), child: b }", ""], false),
        ([heavy, "joint k: Ball { parent: a.at(X), child: b, coordinates: RollPitchYaw }", ""], true),
        ([point, "joint k: Universal { parent: a, child: b, axes: [Y, Z] }", ""], true),
        ([point, geared, ""], false),
        ([point, revolute, ""], true),
        ([heavy, revolute, "emit inverse_dynamics;"], false),
        ([point, revolute, "emit inverse_dynamics;"], false),
    ] {
        let case = arm(&parts.join(" "));
        assert_eq!(own(&case), singular, "{parts:?}");
    }
    let case = arm(&[point, revolute, "emit forward_dynamics, mass_matrix;"].join(" "));
    assert!(matches!(case.compiled.inertia, Inertia::Requested));
}

/// Functions that lose digits as they were derived already: what they do lose is known, and no error.
#[test]
fn lost_digits_are_no_errors() {
    for text in [
        "pub mod turned {
            world { gravity: -9.81 * Z }
            body b0 { mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }
            body b1 { mass: 1, com: [sqrt(2) / 2, sqrt(3), -0.780], inertia: diag(0.1, 0.1, 0.1) }
            body b2 { mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }
            joint j0: Prismatic {
                parent: ground,
                child: b0.oriented([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]]).oriented([
                    [0.5578710440442189, -0.3889107231664566, 0.7331632475943928],
                    [0.0580127018922193, 0.8995190528383290, 0.4330127018922194],
                    [-0.8278975930851458, -0.1990324671679957, 0.5243773949903288]
                ]),
                axis: Z
            }
            joint j1: Revolute { parent: b0, child: b1, axis: Z }
            joint j2: Universal {
                parent: b1.oriented([[1, 0, 0], [0, 0, -1], [0, 1, 0]]),
                child: b2,
                axes: [[0, 0, 1], [1, 0, 0]]
            }
            output twist0 = b0.twist;
            output accel0 = b0.acceleration;
            output jacobian0 = b0.jacobian;
            output twist1 = b1.twist;
            output accel1 = b1.acceleration;
            output jacobian1 = b1.jacobian;
            output twist2 = b2.twist;
            output accel2 = b2.acceleration;
            output alpha2 = b2.angular_acceleration;
            output jacobian2 = b2.jacobian;
            output reaction0 = j0.reaction;
            output reaction1 = j1.reaction;
            output reaction2 = j2.reaction;
            emit forward_dynamics;
        }",
        "pub mod stacked {
            body b13 { mass: 0.7, inertia: sphere(0.7, 0.7) }
            joint j14: Free { parent: ground, child: b13, coordinates: RollPitchYaw }
            body b15 { mass: 0.5 * 2 + 0.25, inertia: diag(0.7, 0.7, 0.7) }
            joint j16: Free { parent: b13.at(1e-3 * Z).at(4 * X), child: b15, coordinates: RollPitchYaw }
            emit forward_dynamics, derivatives;
        }",
    ] {
        let case = Case::new(text);
        let found = case.check(&case.compiled);
        println!("{}: {found:?}", case.model.name);
        let refused = verify::compile(&case.model, &case.structure, &case.derivation).err();
        assert_eq!(refused, None, "{}", case.model.name);
    }
}

/// What an iteration leaves is rounding where loops close, and is compared where they are open: it is all that tells of open loops.
#[test]
fn residuals_of_open_loops() {
    let case = Case::new(
        "pub mod newton {
            param reach = 1.0;
            world { gravity: -9.81 * Y }
            formulation { constraints: Reduced, independent: [crank] }
            body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
            body link { mass: 3.5, com: [1.7, 0.2, 0.0], inertia: diag(0.1, 3.0, 3.1) }
            body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
            joint crank: Revolute { parent: ground, child: arm, axis: Z }
            joint coupler: Revolute { parent: arm.at(reach * X), child: link, axis: Z }
            joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
            #[cut]
            joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
            emit forward_dynamics;
        }",
    );
    assert_eq!(case.check(&case.compiled).unchecked, []);
    let kinds = [FunctionKind::ForwardDynamics, FunctionKind::Guess, FunctionKind::Margins];
    for kind in kinds {
        let mut compiled = case.compiled.clone();
        let function = compiled.functions.iter_mut().find(|f| f.kind == kind).unwrap();
        let last = function.program.results.last_mut().unwrap();
        *last = Expression::Product(vec![Expression::Literal(1e-3), last.clone()]);
        let found = case.check(&compiled);
        assert_eq!(found.wrong, [kind]);
    }
}

/// A law that is never judged is no law that holds, and the reason is the one that there was.
#[test]
fn laws_without_a_value() {
    let case = arm("input load;
        force motor: Effort { joint: j, value: ln(-1.0 - load * load) }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;");
    let list = case.check(&case.compiled).unchecked;
    assert!(list.iter().any(|open| matches!(open.part, Part::Law(_))), "{list:?}");
    assert!(list.iter().all(|open| open.doubt == Doubt::NotFinite), "{list:?}");

    let mut case = Case::new(
        "pub mod pinned {
            formulation { constraints: Multipliers }
            body crank { mass: 0.4, com: 0.2 * X, inertia: diag(0.01, 0.02, 0.025) }
            body coupler { mass: 0.6, com: 0.4 * X, inertia: diag(0.02, 0.03, 0.04) }
            body follower { mass: 0.5, com: 0.3 * X, inertia: diag(0.01, 0.02, 0.025) }
            joint a: Revolute { parent: ground, child: crank, axis: Z }
            joint b: Revolute { parent: crank.at(0.4 * X), child: coupler, axis: Z }
            joint c: Revolute { parent: ground.at(0.9 * X), child: follower, axis: Z }
            #[cut]
            joint d: Revolute { parent: coupler.at(0.8 * X), child: follower.at(0.6 * X), axis: Z }
            emit forward_dynamics, impulse;
        }",
    );
    assert_eq!(case.check(&case.compiled).unchecked, []);
    // As if equations followed from others everywhere.
    for function in &mut case.derivation.functions {
        if matches!(function.kind, FunctionKind::ForwardDynamics | FunctionKind::Impulse) {
            let results = function.candidates.iter_mut().map(|candidate| &mut candidate.1.list);
            results.for_each(|results| *results.last_mut().unwrap() = Scalar::ZERO);
        }
    }
    let compiled = optimize::compile(&case.derivation).unwrap();
    let list = case.check(&compiled).unchecked;
    assert_eq!(list.len(), 2, "{list:?}");
    assert!(list.iter().all(|open| matches!(open.part, Part::Law(_)) && open.doubt == Doubt::Rank), "{list:?}");
}

/// What a function that stands as it was derived loses by the form in which its operations are written has a limit too.
#[test]
fn forms_that_lose_digits_are_refused() {
    // u (u + 2 c) after (u + c)^2 - c^2, which is the same node unless it is made anew.
    for (c, refused) in [(1e3, false), (1e8, true)] {
        let mut case = arm("input u; output bad = u; output good = j; output same = u + 1.0;");
        let at = case.derivation.functions.iter().position(|f| f.kind == FunctionKind::Outputs).unwrap();
        let g = &mut case.derivation.graph;
        let [u, ..] = case.derivation.functions[at].candidates[0].1.list[..] else { panic!() };
        let literal = g.decimal(c);
        let shifted = g.add(u, literal);
        let (square, less) = (g.mul(shifted, shifted), g.mul(literal, literal));
        let bad = g.sub(square, less);
        g.forget();
        let twice = g.decimal(2.0 * c);
        let shifted = g.add(u, twice);
        let good = g.mul(u, shifted);
        assert_ne!(bad, good);
        for candidate in &mut case.derivation.functions[at].candidates {
            candidate.1.list = vec![bad, good, good];
        }
        let compiled = verify::compile(&case.model, &case.structure, &case.derivation);
        println!("{c:e} {:?}", compiled.as_ref().err());
        assert_eq!(compiled.is_err(), refused, "{c:e}");
    }
}

/// Two results without digits at every state, one of them beside a great one: what is written as derived computes t (t + 2) as
/// (t + 1)^2 - 1. They excuse no other, and are no worse than rounding of their own terms.
#[test]
fn results_without_digits_excuse_nothing() {
    let mut case = arm("input u; output bad = u; output good = j; output great = u * 2.0; output plain = u + 0.7;");
    let at = case.derivation.functions.iter().position(|f| f.kind == FunctionKind::Outputs).unwrap();
    let g = &mut case.derivation.graph;
    let [u, _, _, plain] = case.derivation.functions[at].candidates[0].1.list[..] else { panic!() };
    let (tiny, great, one, two) = (g.decimal(1e-33), g.decimal(1e12), g.decimal(1.0), g.decimal(2.0));
    let t = g.mul(tiny, u);
    let shifted = g.add(t, one);
    let square = g.mul(shifted, shifted);
    let bad = g.sub(square, one);
    g.forget();
    let shifted = g.add(t, two);
    let good = g.mul(t, shifted);
    assert_ne!(bad, good);
    let great = g.mul(great, u);
    for candidate in &mut case.derivation.functions[at].candidates {
        candidate.1.list = vec![bad, good, great, plain];
    }
    let compiled = verify::compile(&case.model, &case.structure, &case.derivation).unwrap();
    assert_eq!(compiled.unchecked, []);
    let functions = [FunctionKind::Outputs];
    for plain in [optimize::Plain::default(), optimize::Plain { functions: &functions, at: true, checks: false }] {
        let compiled = optimize::compile_with(&case.derivation, plain, false).unwrap();
        let check = |compiled: &_| verify::check_with(&case.model, &case.structure, &case.derivation, compiled, plain);
        let found = check(&compiled);
        assert!(found.wrong.is_empty() && found.unchecked.is_empty(), "{plain:?}: {found:?}");
        for (result, value) in
            [(1, Expression::Literal(1e-12)), (1, Expression::Literal(1e-2)), (3, Expression::Literal(0.8))]
        {
            let mut broken = compiled.clone();
            broken.functions[at].program.results[result] = value;
            assert_eq!(check(&broken).wrong, functions, "{plain:?}: {result}");
        }
        let mut broken = compiled.clone();
        assert!(replace(&mut broken.functions[at].program, 0.7, 0.700_000_1) > 0);
        assert_eq!(check(&broken).wrong, functions, "{plain:?}");
    }
}
