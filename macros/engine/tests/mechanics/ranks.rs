//! Which equations the analysis keeps: collapsed branches, equations of rounding, bodies that stay at their place.

use multibody_engine::mechanics::analysis::{Complaint, analyse};
use multibody_engine::mechanics::loops::constraints::row_name;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::types::Model;

use super::support::model_of;

fn looked(text: &str) -> (Model, Result<Structure, Vec<Complaint>>) {
    let model = model_of(text);
    let found = analyse(&model);
    (model, found)
}

fn sound(text: &str) -> (Model, Structure) {
    let (model, found) = looked(text);
    let messages = |list: Vec<Complaint>| list.into_iter().map(|one| one.message).collect::<Vec<_>>();
    let structure = found.unwrap_or_else(|complaints| panic!("{:?} in {text}", messages(complaints)));
    (model, structure)
}

/// Rhombic stages one upon the other, the first on a slider.
fn scissor(stages: usize, formulation: &str) -> String {
    let mut text = format!("body carriage {{ mass: 0.5 }} formulation {{ {formulation} }}");
    let mut add = |line: String| text.push_str(&line);
    for k in 1..=stages {
        for name in ["a", "b"] {
            add(format!("body {name}{k} {{ mass: 2.0, com: X, inertia: diag(0.1, 0.7, 0.7) }} "));
        }
        let under = if k == 1 { "ground".to_owned() } else { format!("b{}.at(2.0 * X)", k - 1) };
        add(format!("joint q{k}: Revolute {{ parent: {under}, child: a{k}, axis: Z }} "));
        add(format!("joint c{k}: Revolute {{ parent: a{k}.at(X), child: b{k}.at(X), axis: Z }} "));
    }
    add("joint rail: Prismatic { parent: ground, child: carriage, axis: X } ".to_owned());
    add("#[cut] joint foot: Revolute { parent: b1, child: carriage, axis: Z } ".to_owned());
    for k in 2..=stages {
        let under = k - 1;
        add(format!("#[cut] joint l{k}: Revolute {{ parent: a{under}.at(2.0 * X), child: b{k}, axis: Z }} "));
    }
    text
}

/// Most starts end where a rhombus has collapsed, and less is left to hold.
#[test]
fn collapsed_scissors_drop_nothing() {
    for stages in 2..=6 {
        let (model, structure) = sound(&scissor(stages, "constraints: Multipliers"));
        let kept = |row: &&multibody_engine::mechanics::loops::structure::Row| !structure.dropped.contains(row);
        assert_eq!(structure.rows.len(), 2 * stages, "{:?}", structure.notes);
        assert_eq!(structure.rows.iter().filter(kept).count(), 2 * stages);
        assert!(structure.rows.iter().all(|row| {
            let name = row_name(&model, row.closing, row.index);
            name.ends_with(".x") || name.ends_with(".y")
        }));
    }
}

#[test]
fn reduced_scissors_have_one_freedom() {
    for stages in 2..=4 {
        let (_, structure) = sound(&scissor(stages, "constraints: Reduced"));
        assert_eq!(structure.freedoms(), 1, "{:?}", structure.notes);
    }
}

fn five_bars(ground: &str, closing: &str, formulation: &str) -> String {
    let bodies: Vec<String> = [("one", 0.2), ("two", 0.5), ("three", 0.4), ("four", 0.4)]
        .map(|(name, com)| format!("body {name} {{ mass: 1.0, com: {com} * X, inertia: diag(0.1, 0.1, 0.1) }}"))
        .into();
    format!(
        "{} {formulation}
        joint a: Revolute {{ parent: {ground}, child: one, axis: Z }}
        joint b: Revolute {{ parent: one.at(0.4 * X), child: two, axis: Z }}
        joint c: Revolute {{ parent: two.at(1.0 * X), child: three, axis: Z }}
        joint d: Revolute {{ parent: three.at(0.8 * X), child: four, axis: Z }}
        #[cut] joint e: Universal {{ parent: four.at(0.9 * X), child: {closing}, axes: [Y, Z] }}",
        bodies.join(" ")
    )
}

const REDUCED: &str = "formulation { constraints: Reduced }";

/// The last equation of the universal joint holds everywhere in the plane, but for the rounding of its frame.
#[test]
fn equations_of_rounding_hold() {
    let tilted = |tilt: &str| {
        let tilted = format!("ground.at([0.9, 0.1, 0]).oriented([[1, 0, {tilt}], [0, 1, 0], [-{tilt}, 0, 1]])");
        tilted.replace("--", "")
    };
    let typed = "ground.oriented([[0.955336489125606, -0.22602632124962302, 0.19037934406737264],
        [0.29552020666133955, 0.7306816499355124, -0.6154446635582734], [0.0, 0.644217687237691, 0.7648421872844885]])
        .at([0.9, 0.1, 0])";
    let turned = "ground.rotated(Z, 0.3).rotated(X, 0.7)";
    let thrice = "ground.rotated([1, 1, 1], deg(120)).rotated([1, 1, 1], deg(120)).rotated([1, 1, 1], deg(120))";
    let place = "ground.at([0.9, 0.1, 0])";
    for (from, to) in [
        ("ground", tilted("0")),
        ("ground", tilted("5e-17")),
        ("ground", tilted("-2e-16")),
        (turned, typed.to_owned()),
        (thrice, place.to_owned()),
    ] {
        let (_, structure) = sound(&five_bars(from, &to, REDUCED));
        assert_eq!(structure.freedoms(), 2, "{from} to {to}: {:?}", structure.notes);
        let (_, structure) = sound(&five_bars(from, &to, ""));
        assert_eq!(structure.rows.len(), 2, "{from} to {to}: {:?}", structure.notes);
    }
    // Out of the plane by more than rounding nothing closes it, however small the slopes.
    let (_, found) = looked(&five_bars("ground", &tilted("5e-17").replace("0.1, 0]", "0.1, 2e-6]"), ""));
    let complaints = found.err().map(|list| list.into_iter().map(|one| one.message).collect::<Vec<_>>());
    assert!(
        complaints.as_ref().is_some_and(|list| list.len() == 1 && list[0].contains("cannot close")),
        "{complaints:?}"
    );
}

/// The last equation as a user's expression.
#[test]
fn expressions_of_rounding_hold() {
    let chain = |constraint: &str| {
        format!(
            "body one {{ mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }} body two {{ mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }}
            joint a: Revolute {{ parent: ground.oriented([[1, 0, 5e-17], [0, 1, 0], [-5e-17, 0, 1]]), child: one, axis: Z }}
            joint b: Revolute {{ parent: one.at(0.4 * X), child: two, axis: Z }} constraint flat = {constraint};"
        )
    };
    // The frame is the ground's turn that it rounds, so the equation is zero and not only constant.
    let (_, structure) = sound(&chain("two.at(X).position.z"));
    assert!(structure.rows.is_empty() && structure.dropped.len() == 1, "{:?}", structure.notes);
    let (_, structure) = sound(&chain("two.at(X).position.z + 5e-17 * cos(a)"));
    assert!(structure.rows.is_empty(), "{:?}", structure.notes);
    assert!(structure.notes.iter().any(|note| note.contains("`flat`")), "{:?}", structure.notes);
    let (_, structure) = sound(&chain("two.at(X).position.y"));
    assert_eq!(structure.rows.len(), 1);
    // A coupling is as it was written.
    let (_, structure) = sound(&chain("1e-17 * a + 2e-17 * b"));
    assert_eq!(structure.freedoms(), 1, "{:?}", structure.steps);
}

#[test]
fn a_residue_of_an_offset_is_no_size() {
    for offset in ["0", "1e-17", "-3e-16", "1e-3"] {
        let text = format!(
            "body b0 {{ mass: 1.0, inertia: diag(0.1, 0.15, 0.2) }} body b1 {{ mass: 1.0, inertia: diag(0.1, 0.15, 0.2) }}
            body b2 {{ mass: 1.0, inertia: diag(0.1, 0.15, 0.2) }}
            joint j0: Revolute {{ parent: ground, child: b0, axis: X }}
            joint j1: Revolute {{ parent: b0, child: b1, axis: Y }}
            joint j2: Revolute {{ parent: b1, child: b2, axis: Z }}
            joint l0: Universal {{ parent: b2, child: ground.at([0, 0, {offset}]), axes: [X, Y] }}
            formulation {{ coordinates: Absolute(Quaternion) }}"
        );
        if offset == "1e-3" {
            // Each hinge holds two origins together, so that of `b2` is the ground's, whatever the angles; the last joint
            // asks it to be a millimetre away. Four joints can share that, a quarter of it each: no gap in all is less than
            // sqrt(4) 0.25 mm, as plain least squares over three free bodies finds too.
            let messages =
                looked(&text).1.err().map(|list| list.into_iter().map(|one| one.message).collect::<Vec<_>>());
            let said = messages.as_deref().unwrap_or_default();
            let gap = said.first().and_then(|text| text.strip_suffix(" m")?.rsplit(' ').next()?.parse::<f64>().ok());
            assert!(said.len() == 1 && said[0].contains("`l0` closes cannot close"), "{messages:?}");
            assert!(gap.is_some_and(|gap| (0.0005..0.00055).contains(&gap)), "{messages:?}");
            continue;
        }
        let (_, structure) = sound(&text);
        assert_eq!(structure.independent.len(), 16, "{offset}: {:?}", structure.notes);
    }
}

/// Some coordinates of a body are fixed each by an equation of its own; the body turns.
#[test]
fn bodies_on_hinges_may_stay_at_their_place() {
    for (joint, rows) in [("Revolute", 5), ("Prismatic", 5), ("Cylindrical", 4), ("Planar", 3)] {
        for coordinates in ["RollPitchYaw", "Quaternion"] {
            let text = format!(
                "body one {{ mass: 1.0, inertia: diag(0.01, 0.01, 0.02) }}
                joint a: {joint} {{ parent: ground, child: one, axis: Z }}
                formulation {{ constraints: Multipliers, coordinates: Absolute({coordinates}) }}"
            );
            let (_, structure) = sound(&text);
            assert_eq!(structure.rows.len(), rows, "{joint} {coordinates}: {:?}", structure.notes);
        }
    }
    let (_, found) = looked(
        "body one { mass: 1.0, inertia: diag(0.01, 0.01, 0.02) } joint x: Prismatic { parent: ground, child: one, axis: X }
        constraint still = x;",
    );
    assert!(found.is_err(), "nothing moves");
}

/// What time moves is not locked; what only holds at time zero does not hold.
#[test]
fn time_moves() {
    let slider = |constraints: &str| {
        format!(
            "body one {{ mass: 1.0, inertia: diag(0.01, 0.01, 0.02) }}
            joint x: Cylindrical {{ parent: ground, child: one, axis: X }} {constraints}"
        )
    };
    // Fully prescribed, and one equation follows from the other at all times.
    for constraints in [
        "constraint a = x.travel - 0.3 * t; constraint b = x.angle - t;",
        "constraint a = x.travel - 0.3 * t; constraint b = x.angle - t; constraint c = x.angle * 0.3 - x.travel;",
        "constraint a = sin(t) * (x.travel - 0.3);",
    ] {
        for formulation in ["", "formulation { constraints: Reduced }"] {
            let (_, structure) = sound(&slider(&format!("{constraints} {formulation}")));
            let count = constraints.matches("constraint").count().min(2);
            assert_eq!(structure.independent.len(), count, "{constraints}: {:?}", structure.notes);
        }
    }
    for constraints in [
        "constraint a = x.travel - 0.3 * t; constraint b = x.travel - 0.5 * t;",
        "constraint a = x.travel - 0.3 * t; constraint b = x.travel;",
        "constraint a = x.travel - 0.3 * t; constraint b = x.angle; constraint c = x.angle + x.travel;",
        "constraint a = 0.1 * t;",
        "constraint a = sin(t) * (1.0 + x.travel * 0.0);",
        "constraint a = sin(t) * x.travel; constraint b = x.travel - 0.3;",
    ] {
        for formulation in ["", "formulation { constraints: Reduced }"] {
            let (_, found) = looked(&slider(&format!("{constraints} {formulation}")));
            let messages = found.err().map(|list| list.into_iter().map(|one| one.message).collect::<Vec<_>>());
            let said = messages.as_ref().is_some_and(|list| list.len() == 1 && list[0].contains("cannot close"));
            assert!(said, "{constraints} {formulation}: {messages:?}");
        }
    }
}
