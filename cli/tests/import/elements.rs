//! What each element of a file does, beside closed forms.

use std::f64::consts::FRAC_PI_2;

use multibody_engine::contracts::function::FunctionKind;

use super::{At, Functions, difference, imported, written};

const BLOCK: &str = r#"<inertia ixx="0.1" iyy="0.2" izz="0.25" ixy="0" ixz="0" iyz="0"/>"#;

/// A link of a mass in kg, with its centre of mass at `xyz`.
fn link(name: &str, mass: &str, xyz: &str) -> String {
    format!(r#"<link name="{name}"><inertial><origin xyz="{xyz}"/><mass value="{mass}"/>{BLOCK}</inertial></link>"#)
}

/// A joint; `more` stands in it.
fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], more: &str) -> String {
    format!(r#"<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{more}</joint>"#)
}

fn robot(file: &str, parts: &[String]) -> String {
    written(file, &format!("<robot name=\"r\">\n{}\n</robot>\n", parts.join("\n")))
}

fn close(got: &[f64], expected: &[f64]) {
    assert!(difference(got, expected) < 1e-14, "{got:?} and not {expected:?}");
}

#[test]
fn a_joint_that_mimics_shares_the_coordinate() {
    let file = robot(
        "gripper.urdf",
        &[
            r#"<link name="palm"/>"#.to_owned(),
            link("left", "0.5", "0 0 0"),
            link("right", "0.3", "0 0 0"),
            joint("grip", "prismatic", ["palm", "left"], r#"<axis xyz="0 1 0"/><dynamics damping="4" friction="0"/>"#),
            joint(
                "follow",
                "prismatic",
                ["palm", "right"],
                r#"<axis xyz="0 0 1"/><mimic joint="grip" multiplier="-2.5" offset="0.02"/>"#,
            ),
        ],
    );
    let (text, _) = imported(&[&file, "--efforts"]);
    assert!(text.contains("constraint follow_mimic = follow.travel - (-2.5 * grip.travel + 0.02);"), "{text}");
    let functions = Functions::of(&text);
    let at = At { q: vec![("grip", 0, 0.3)], v: vec![("grip", 0, 0.7)], inputs: vec![3.0], ..At::default() };
    // (m1 + k^2 m2) a = f - d v + k m2 g_z, of which gravity's part acts along the follower's axis alone.
    let mass = 0.5 + 2.5 * 2.5 * 0.3;
    let force = 3.0 - 4.0 * 0.7 - 2.5 * 0.3 * -9.81;
    close(&functions.run(FunctionKind::MassMatrix, &at), &[mass]);
    close(&functions.run(FunctionKind::ForwardDynamics, &at), &[force / mass]);
}

#[test]
fn fixed_links_are_carried_and_empty_ones_are_frames() {
    let file = robot(
        "carried.urdf",
        &[
            r#"<link name="world"/>"#.to_owned(),
            link("arm", "2", "0.1 0 0"),
            r#"<link name="flange"/>"#.to_owned(),
            link("tool", "3", "0 0 0.2"),
            joint("hinge", "continuous", ["world", "arm"], r#"<axis xyz="0 0 -1"/>"#),
            joint("mount", "fixed", ["arm", "flange"], r#"<origin xyz="0.4 0 0" rpy="0 1.57079632679 0"/>"#),
            joint("grasp", "fixed", ["flange", "tool"], r#"<origin xyz="0 0.3 0"/>"#),
        ],
    );
    let (text, notes) = imported(&[&file]);
    assert_eq!(
        notes,
        "note: right angles that the file has rounded, taken as exact: 1.57079632679 of `mount`\nnote: names: `world` is `world_link`\n"
    );
    assert!(text.contains("let flange = arm.at([0.4, 0.0, 0.0]).rotated(Y, PI / 2);"), "{text}");
    // The tool's z is the arm's x: its mass is at (0.6, 0.3), and what it has about the arm's z is its xx.
    let about = 0.25 + 2.0 * 0.01 + 0.1 + 3.0 * (0.36 + 0.09);
    close(&Functions::of(&text).run(FunctionKind::MassMatrix, &At::default()), &[about]);
}

#[test]
fn a_base_that_floats_falls() {
    let file = robot(
        "falls.urdf",
        &[
            r#"<link name="footprint"/>"#.to_owned(),
            link("trunk", "5", "0 0 0"),
            joint("up", "fixed", ["footprint", "trunk"], r#"<origin xyz="0 0 0.5" rpy="0.3 0.2 0.1"/>"#),
        ],
    );
    let (text, _) = imported(&[&file, "--base", "floating"]);
    let functions = Functions::of(&text);
    let at = At { q: vec![("float", 3, 0.6), ("float", 4, 0.8)], ..At::default() };
    let falls = functions.run(FunctionKind::ForwardDynamics, &at);
    assert!(difference(&falls, &[0.0, 0.0, -9.81, 0.0, 0.0, 0.0]) < 1e-13, "{falls:?}");
    // Held, nothing of it moves.
    assert!(imported(&[&file]).0.contains("let footprint = ground;"));
}

#[test]
fn a_floating_joint_and_a_planar_one() {
    let file = robot(
        "slides.urdf",
        &[
            link("table", "9", "0 0 0"),
            link("puck", "2", "0 0 0"),
            link("bird", "4", "0 0 0"),
            joint("slide", "planar", ["table", "puck"], r#"<axis xyz="0 0 1"/>"#),
            joint("fly", "floating", ["table", "bird"], ""),
        ],
    );
    let (text, notes) = imported(&[&file]);
    assert!(notes.contains("`slide`: URDF does not say which way the coordinates of a planar joint go"), "{notes}");
    let matrix = Functions::of(&text).run(FunctionKind::MassMatrix, &At { q: vec![("fly", 3, 1.0)], ..At::default() });
    let diagonal: Vec<f64> = (0..9).map(|k| matrix[k * 10]).collect();
    close(&diagonal, &[2.0, 2.0, 0.25, 4.0, 4.0, 4.0, 0.1, 0.2, 0.25]);
}

/// A pendulum whose axis, damping and inertia frame are oblique: the moment about an axis `n` is `n I n`.
#[test]
fn an_inertia_is_turned_with_its_frame() {
    let inertial =
        format!(r#"<link name="bob"><inertial><origin rpy="0.4 -0.7 1.1"/><mass value="1"/>{BLOCK}</inertial></link>"#);
    let hinge = r#"<axis xyz="0.6 0 0.8"/><dynamics damping="0.125"/>"#;
    let file = robot(
        "bob.urdf",
        &[r#"<link name="base"/>"#.to_owned(), inertial, joint("h", "revolute", ["base", "bob"], hinge)],
    );
    let (text, notes) = imported(&[&file]);
    assert!(notes.contains("inertias turned into the axes of their links, in double precision: `bob`"), "{notes}");
    // The axis in the inertia's frame, by the inverse turns one after the other: about z, y, x.
    let turn = |[a, b]: [f64; 2], angle: f64| [a * angle.cos() + b * angle.sin(), b * angle.cos() - a * angle.sin()];
    let [x, y] = turn([0.6, 0.0], 1.1);
    let [z, x] = turn([0.8, x], -0.7);
    let [y, z] = turn([y, z], 0.4);
    let about = 0.1 * x * x + 0.2 * y * y + 0.25 * z * z;
    let functions = Functions::of(&text);
    let at = At { v: vec![("h", 0, 2.0)], a: vec![("h", 0, 3.0)], q: vec![("h", 0, FRAC_PI_2)], ..At::default() };
    close(&functions.run(FunctionKind::InverseDynamics, &at), &[3.0 * about + 0.125 * 2.0]);
}

#[test]
fn numbers_stay_as_they_are_written() {
    let file = robot(
        "digits.urdf",
        &[
            r#"<link name="base"/>"#.to_owned(),
            link("a", "1.50", "0.10000000000000000555 -.5 +2E-1"),
            joint("j", "revolute", ["base", "a"], r#"<origin xyz="1. 0 0" rpy="1.5708 0 0.10"/><axis xyz="0 3 4"/>"#),
        ],
    );
    let (text, notes) = imported(&[&file]);
    for part in
        ["mass: 1.50, com: [0.10000000000000000555, -0.5, 2.0E-1]".replace('E', "e"), "axis: [0.0, 3.0, 4.0]".into()]
    {
        assert!(text.contains(&part), "{part} of\n{text}");
    }
    assert!(text.contains("base.at([1.0, 0.0, 0.0]).rotated(Z, 0.10).rotated(X, 1.5708)"), "{text}");
    assert!(
        notes.contains("almost right angles, taken as they stand (exact ones take fewer operations): 1.5708 of `j`"),
        "{notes}"
    );
    assert!(notes.contains("`j`: the axis has the length 5"), "{notes}");
}

#[test]
fn names_that_change_are_told() {
    let file = robot(
        "names.urdf",
        &[
            r#"<link name="base link"/>"#.to_owned(),
            link("LH_HAA", "1", "0 0 0"),
            joint("LH_HAA", "revolute", ["base link", "LH_HAA"], ""),
        ],
    );
    let (text, notes) = imported(&[&file]);
    let expected = "note: names: `base link` is `base_link`, `LH_HAA` is `lh_haa`, `LH_HAA` is `lh_haa_joint`\n";
    assert_eq!(notes, expected);
    assert!(text.contains("joint lh_haa_joint: Revolute { parent: base_link, child: lh_haa, axis: X }"), "{text}");
}

#[test]
fn what_is_read_over_is_listed_once() {
    let shape = r#"<visual><geometry><mesh filename="package://a.stl"/></geometry></visual><collision/>"#;
    let file = robot(
        "shown.urdf",
        &[
            r#"<link name="base"/><material name="red"/><gazebo reference="a"/><gazebo/>"#.to_owned(),
            link("a", "1", "0 0 0").replace("</link>", &format!("{shape}{shape}</link>")),
            joint("j", "revolute", ["base", "a"], r#"<limit lower="0" upper="1" effort="2" velocity="3"/>"#),
            r#"<transmission name="t"/>"#.to_owned(),
        ],
    );
    let expected =
        "note: read over: collision (2), gazebo (2), limit (1), material (1), transmission (1), visual (2)\n";
    assert_eq!(imported(&[&file]).1, expected);
}

/// As published with a well-known arm: the words beside `damping` are a simulator's.
#[test]
fn friction_is_left_out_where_that_is_asked_for() {
    let dynamics = r#"<dynamics D="1" K="7000" damping="0.5" friction="0.2" mu_coulomb="0" mu_viscous="16"/>"#;
    let file = robot(
        "rough.urdf",
        &[
            r#"<link name="base"/>"#.to_owned(),
            link("a", "1", "0 0 0"),
            joint("j", "revolute", ["base", "a"], dynamics),
        ],
    );
    let (text, notes) = imported(&[&file, "--without-friction"]);
    assert_eq!(notes, "note: read over: D (1), K (1), friction (1), mu_coulomb (1), mu_viscous (1)\n");
    let at = At { v: vec![("j", 0, 2.0)], ..At::default() };
    close(&Functions::of(&text).run(FunctionKind::InverseDynamics, &at), &[1.0]);
}

#[test]
fn a_word_of_the_language_is_no_name() {
    let file = robot(
        "words.urdf",
        &[
            r#"<link name="world"/>"#.to_owned(),
            link("body", "1", "0 0 0"),
            link("sin", "1", "0 0 0"),
            joint("fn", "fixed", ["world", "body"], ""),
            joint("joint", "revolute", ["body", "sin"], ""),
            joint("float", "fixed", ["sin", "x y"], ""),
            r#"<link name="x y"/>"#.to_owned(),
        ],
    );
    for base in ["fixed", "floating"] {
        let (text, notes) = imported(&[&file, "--base", base]);
        assert!(notes.contains("`world` is `world_link`") && notes.contains("`fn` is `fn_joint`"), "{notes}");
        assert_eq!(Functions::of(&text).model.bodies.len(), if base == "fixed" { 2 } else { 3 });
    }
}

/// What stands in a name stays in one comment, whatever it is.
#[test]
fn names_cannot_write_items() {
    let file = written(
        "hostile.urdf",
        &format!(
            "<robot name=\"r&#10;}} input evil; `\"><link name=\"*/ &#10;input worse;\"/>{}{}</robot>",
            link("a", "1", "0 0 0"),
            joint("j", "revolute", ["*/ &#10;input worse;", "a"], ""),
        ),
    );
    let (text, notes) = imported(&[&file]);
    assert!(text.contains("/// The robot `r\\n} input evil; `` of hostile.urdf.\n"), "{text}");
    assert!(notes.lines().count() == 1 && Functions::of(&text).model.inputs.is_empty(), "{text}");
}
