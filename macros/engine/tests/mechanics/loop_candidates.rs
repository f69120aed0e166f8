//! Every way to a function of a mechanism with loops gives the same values: bodies on struts against the general way,
//! with loads that depend on driven and dependent coordinates, on inputs to solve for, and with steps whose equations
//! hold later unknowns in form alone.

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::mechanics;
use multibody_engine::model::check;
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::fingerprint::mix;
use multibody_engine::symbolic::graph::SymbolId;
use multibody_engine::syntax::parse;

/// Ways of each function, and the worst difference between any two, relative to one plus the value.
fn compare(text: &str) -> (usize, f64) {
    let mut diagnostics = Diagnostics::default();
    let source = parse(text.parse().expect("tokens"), &mut diagnostics);
    let models = check(&source, &mut diagnostics);
    assert!(diagnostics.is_empty(), "{}", diagnostics.to_tokens());
    let derivation = match mechanics::of(&models[0]) {
        Ok((_, derivation)) => derivation,
        Err(complaints) => panic!("{}", complaints[0].message),
    };
    let (mut most, mut worst) = (0, 0.0_f64);
    for function in &derivation.functions {
        most = most.max(function.candidates.len());
        for draw in 0..8_u64 {
            let value = |id: SymbolId| {
                let random = (mix(mix(draw ^ 0xCA5E) ^ id.0 as u64) >> 11) as f64 / (1_u64 << 53) as f64;
                0.2 + 0.6 * random
            };
            let values = |k: usize| {
                let field = Real { symbols: &value };
                Evaluator::new(&derivation.graph, field).run(&function.candidates[k].1.list)
            };
            let first = values(0);
            for k in 1..function.candidates.len() {
                for (a, b) in first.iter().zip(values(k)) {
                    let gap = (a - b).abs() / (1.0 + a.abs());
                    worst = worst.max(if gap.is_nan() && a.is_nan() { 0.0 } else { gap });
                    assert!(!gap.is_nan() || a.is_nan(), "{}: {a} and {b}", function.candidates[k].0);
                }
            }
        }
    }
    (most, worst)
}

/// A plate on six struts, with more items.
fn platform(items: &str) -> String {
    let feet = "[[-2.1, 1.4, 0.0], [-2.4, 1.2, 0.1], [-2.3, -1.2, 0.0], [-2.1, -1.3, 0.0], [0.1, -0.2, 0.0], [0.0, 0.15, 0.2]]";
    let pins =
        "[[0.2, 0.6, 2.0], [-0.6, 0.2, 2.1], [-0.6, -0.2, 2.0], [0.2, -0.6, 2.0], [0.4, -0.4, 2.2], [0.4, 0.4, 2.0]]";
    format!(
        "mod leg {{ port base: Frame; port tip: Frame; input thrust;
            body cylinder {{ mass: 0.1, com: 0.5 * Z, inertia: diag(0.006, 0.006, 0.0) }}
            body piston {{ mass: 0.2, com: -0.4 * Z, inertia: diag(0.005, 0.005, 0.0) }}
            joint gimbal: Universal {{ parent: base, child: cylinder, axes: [X, Y] }}
            joint stroke: Prismatic {{ parent: cylinder.at(1.0 * Z), child: piston, axis: Z }}
            #[cut] joint ball: Ball {{ parent: piston, child: tip }}
            force actuator: Effort {{ joint: stroke, value: thrust - 0.3 * stroke.rate }}
            solve (gimbal, stroke) from ball {{ stroke.travel > -1.0, cos(gimbal.second) > 0.0 }} }}
         pub mod machine {{ const FEET: [Vec3; 6] = {feet}; const PINS: [Vec3; 6] = {pins};
            world {{ gravity: -9.81 * Z }} formulation {{ constraints: Reduced }}
            body plate {{ mass: 1.5, com: [0.01, 0.02, -0.03], inertia: diag(0.08, 0.09, 0.1),
                coordinates: Absolute(RollPitchYaw) }}
            part legs: [leg; 6] = |i| leg {{ base: ground.at(FEET[i]), tip: plate.at(PINS[i]) }}; {items} }}"
    )
}

#[test]
fn a_plate_on_struts() {
    let emit = "emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust };";
    let loads = [
        "",
        "force f: Force { at: plate.at(X), value: [0.0, 1.0, -1.0], axes: ground }",
        "force f: Force { at: plate.at(X), value: [0.0, legs[0].stroke.rate, -1.0], axes: ground }",
        "force f: Force { at: plate.at(Y), value: [sin(legs[0].gimbal.first), 0.0, 0.0], axes: plate }",
        "force f: Force { at: plate, value: [0.0, 0.0, 0.1 * legs[0].thrust], axes: ground }",
        "drive plate.orientation = identity(); force f: Force { at: plate.at(X), value: [0.0, 1.0, -1.0], axes: ground }",
        "drive plate.orientation = roll_pitch_yaw(0.1 * t, 0.2, 0.3 * sin(t));",
    ];
    for load in loads {
        let (ways, worst) = compare(&platform(&format!("{load} {emit}")));
        println!("{load}: {ways} ways, {worst:.1e}");
        assert!(ways > 1 && worst < 1e-9, "{load}: {worst:.1e}");
    }
}

#[test]
fn steps_in_a_row() {
    let text = "pub mod machine { formulation { constraints: Reduced } world { gravity: -9.81 * Z }
        body plate { mass: 1.0, inertia: diag(0.1, 0.1, 0.1), coordinates: Absolute(RollPitchYaw) }
        body r1 { mass: 1.0, com: 0.5 * Z, inertia: diag(0.1, 0.1, 0.01) }
        joint a: Universal { parent: ground, child: r1, axes: [X, Y] }
        joint b: Ball { parent: r1.at(Z), child: plate }
        emit forward_dynamics, inverse_dynamics; }";
    let (ways, worst) = compare(text);
    assert!(ways > 1 && worst < 1e-9, "{ways} ways, {worst:.1e}");
}

/// A row that is redundant at a parameter's default alone stays where assembly and the pivoted solve see it.
#[test]
fn rows_that_hold_at_the_default_alone() {
    let text = |tilt: &str| {
        format!(
            "pub mod machine {{ param tilt = 0.0; param length = 3.5; formulation {{ constraints: Multipliers }}
            body c {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }}
            body k {{ mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }}
            body r {{ mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }}
            joint crank: Revolute {{ parent: ground{tilt}, child: c, axis: Z }}
            joint coupler: Revolute {{ parent: c.at(X), child: k, axis: Z }}
            joint rocker: Revolute {{ parent: ground.at(4.0 * X), child: r, axis: Z }}
            #[cut] joint pin: Revolute {{ parent: k.at(length * X), child: r.at(3.0 * X), axis: Z }} }}"
        )
    };
    let rows = |text: &str| {
        let mut diagnostics = Diagnostics::default();
        let source = parse(text.parse().expect("tokens"), &mut diagnostics);
        let models = check(&source, &mut diagnostics);
        let structure = mechanics::analysis::analyse(&models[0]).unwrap_or_else(|c| panic!("{}", c[0].message));
        (structure.rows.len(), structure.dropped.len())
    };
    assert_eq!(rows(&text("")), (2, 3));
    assert_eq!(rows(&text(".rotated(X, tilt)")), (5, 0));
}

/// The same planar loop in planes of all kinds: the axes in which its equations are chosen and those in which they are
/// written need not be the same, and what moves in the plane must not notice.
#[test]
fn loops_in_any_plane() {
    let accelerations = |turn: &str, last: &str| {
        let text = format!(
            "pub mod machine {{ formulation {{ constraints: Multipliers }} emit forward_dynamics;
            body c {{ mass: 1.0, com: 0.5 * X, inertia: diag(0.1, 0.1, 0.1) }}
            body k {{ mass: 3.5, com: 1.75 * X, inertia: diag(0.1, 0.3, 0.3) }}
            body r {{ mass: 3.0, com: 1.5 * X, inertia: diag(0.1, 0.2, 0.2) }}
            joint crank: Revolute {{ parent: ground{turn}, child: c, axis: Z }}
            joint coupler: Revolute {{ parent: c.at(X), child: k, axis: Z }}
            joint rocker: Revolute {{ parent: k.at(3.5 * X), child: r, axis: Z }}
            #[cut] joint pin: {last} {{ parent: r.at(3.0 * X), child: ground{turn}.at([4.0, 0.3, 0.0]){} }} }}",
            if last == "Ball" { "" } else { ", axis: Z" }
        );
        let mut diagnostics = Diagnostics::default();
        let source = parse(text.parse().expect("tokens"), &mut diagnostics);
        let models = check(&source, &mut diagnostics);
        assert!(diagnostics.is_empty(), "{}", diagnostics.to_tokens());
        let Ok((structure, derivation)) = mechanics::of(&models[0]) else { panic!("refused: {text}") };
        assert_eq!(structure.rows.len(), 2, "{:?}", structure.notes);
        let found = &derivation.functions[0].candidates[0].1.list;
        let value = |id: SymbolId| 0.2 + 0.6 * (mix(mix(0xCA5E) ^ id.0 as u64) >> 11) as f64 / (1_u64 << 53) as f64;
        let field = Real { symbols: &value };
        Evaluator::new(&derivation.graph, field).run(&found[..3])
    };
    for last in ["Revolute", "Ball"] {
        let flat = accelerations("", last);
        for turn in [
            ".rotated(X, deg(90))",
            ".oriented([[0, 0, 1], [1, 0, 0], [0, 1, 0]])",
            ".rotated([1, 2, 2], 0.7)",
            ".rotated(Y, 0.3)",
        ] {
            let turned = accelerations(turn, last);
            let worst =
                flat.iter().zip(&turned).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs() / (1.0 + a.abs())));
            assert!(worst < 1e-9, "{last} {turn}: {turned:?} for {flat:?}");
        }
    }
}
