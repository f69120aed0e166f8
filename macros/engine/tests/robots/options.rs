//! What a file may hold beside arms, and what a part says of it, against the same typed in.

use crate::support::{assert_same, checked, model_of};

/// A link of some inertia.
fn link(name: &str, inertial: &str) -> String {
    let inertial = match inertial {
        "" => {
            "<origin xyz='.1 -2e-2 +0.3'/><mass value='2.'/><inertia ixx='0.2' iyy='0.3' izz='0.4' ixy='0.01' ixz='-0.02' iyz='3e-2'/>"
        }
        other => other,
    };
    format!("<link name='{name}'><inertial>{inertial}</inertial></link>")
}

fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], inside: &str) -> String {
    format!("<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>{inside}</joint>")
}

const BODY: &str = "mass: 2.0, com: [0.1, -0.02, 0.3], inertia: inertia(0.2, 0.3, 0.4, 0.01, -0.02, 0.03)";
const END: &str = "emit forward_dynamics, inverse_dynamics, mass_matrix, energy;";

fn same(fields: &str, file: &str, items: &str, more: &str) {
    let call = format!(
        "mod robot {{ world {{ gravity: [1.0, -2.0, -9.0] }} part r: Urdf {{ file: \"r.urdf\", {fields} }}; {more} {END} }}"
    );
    let robot = model_of(&call, &format!("<robot name='r'>{file}</robot>"));
    let typed = model_of(&format!("mod typed {{ world {{ gravity: [1.0, -2.0, -9.0] }} {items} {END} }}"), "");
    assert_same(&typed, &robot, true);
}

const OBLIQUE: &str = "<origin xyz='0.3 0.2 -0.1' rpy='0.4 -0.7 1.1'/><axis xyz='1 2 -2'/>";
const FRAME: &str = ".at([0.3, 0.2, -0.1]).rotated(Z, 1.1).rotated(Y, -0.7).rotated(X, 0.4)";

#[test]
fn joints_of_every_type_are_where_the_file_has_them() {
    let kinds = [
        ("revolute", "Revolute", ", axis: [1, 2, -2]"),
        ("prismatic", "Prismatic", ", axis: [1, 2, -2]"),
        ("planar", "Planar", ", axis: [1, 2, -2]"),
        ("floating", "Free", ""),
    ];
    for (kind, word, axis) in kinds {
        let file = format!(
            "{}{}{}{}{}",
            link("a", ""),
            link("b", ""),
            link("c", ""),
            joint("j", "continuous", ["a", "b"], OBLIQUE),
            joint("k", kind, ["b", "c"], OBLIQUE)
        );
        let items = format!(
            "body a {{ {BODY} }} body b {{ {BODY} }} body c {{ {BODY} }} joint m: Fixed {{ parent: ground.at(2 * X), child: a }} \
             joint j: Revolute {{ parent: a{FRAME}, child: b, axis: [1, 2, -2] }} \
             joint k: {word} {{ parent: b{FRAME}, child: c{axis} }}"
        );
        same("base: ground.at(2 * X)", &file, &items, "");
    }
}

/// A base that floats, with a link that is welded to it, dampers, a joint that is locked, a limb that is dropped.
#[test]
fn fields_choose_what_the_robot_is() {
    let file = [
        link("a", ""),
        link("b", ""),
        link("c", ""),
        link("d", ""),
        joint(
            "j",
            "revolute",
            ["a", "b"],
            &format!("{OBLIQUE}<limit effort='1' velocity='2'/><dynamics damping='0.7' friction='0.1'/>"),
        ),
        joint("k", "prismatic", ["b", "c"], &format!("{OBLIQUE}<dynamics damping='3'/>")),
        joint("l", "prismatic", ["c", "d"], OBLIQUE),
    ]
    .concat();
    let items = format!(
        "body a {{ {BODY} }} body b {{ {BODY} }} body c {{ {BODY} }} joint float: Free {{ parent: ground, child: a }} \
         joint j: Revolute {{ parent: a{FRAME}, child: b, axis: [1, 2, -2] }} force f: Damper {{ joint: j, damping: 0.7 }} \
         joint k: Fixed {{ parent: b{FRAME}, child: c }}"
    );
    same("base: Free, lock: [k], drop: [d], friction: Ignored", &file, &items, "");
}

/// Axes of the inertia's own, checked against a body of those axes that is welded on.
#[test]
fn inertias_have_axes_of_their_own() {
    let turned = "<origin xyz='0.1 0.2 0.3' rpy='0.4 -0.7 1.1'/><mass value='2'/>\
        <inertia ixx='0.2' iyy='0.3' izz='0.4' ixy='0.01' ixz='-0.02' iyz='0.03'/>";
    let file = format!("<link name='world'/>{}{}", link("b", turned), joint("j", "revolute", ["world", "b"], OBLIQUE));
    let items = format!(
        "body b {{ mass: 0 }} body mass {{ mass: 2, inertia: inertia(0.2, 0.3, 0.4, 0.01, -0.02, 0.03) }} \
         joint j: Revolute {{ parent: ground{FRAME}, child: b, axis: [1, 2, -2] }} \
         joint w: Fixed {{ parent: b.at([0.1, 0.2, 0.3]).rotated(Z, 1.1).rotated(Y, -0.7).rotated(X, 0.4), child: mass }}"
    );
    let call = format!("mod robot {{ part r: Urdf {{ file: \"r\", base: ground }}; {END} }}");
    let robot = model_of(&call, &format!("<robot>{file}</robot>"));
    assert_same(&model_of(&format!("mod typed {{ {items} {END} }}"), ""), &robot, false);
}

#[test]
fn a_joint_mimics_another_one() {
    let file = [
        link("a", ""),
        link("b", ""),
        link("c", ""),
        joint("j", "revolute", ["a", "b"], OBLIQUE),
        joint("k", "prismatic", ["a", "c"], &format!("{OBLIQUE}<mimic joint='j' multiplier='-0.5' offset='0.1'/>")),
    ]
    .concat();
    let items = format!(
        "body a {{ {BODY} }} body b {{ {BODY} }} body c {{ {BODY} }} joint m: Fixed {{ parent: ground, child: a }} \
         joint j: Revolute {{ parent: a{FRAME}, child: b, axis: [1, 2, -2] }} \
         joint k: Prismatic {{ parent: a{FRAME}, child: c, axis: [1, 2, -2] }} \
         constraint g = k.travel - (-0.5 * j.angle + 0.1);"
    );
    same("base: ground", &file, &items, "");
}

/// Joints that nothing else holds have an input each, in the order of the file, whatever the order of links is.
#[test]
fn efforts_are_inputs() {
    let file = [
        link("d", ""),
        link("a", ""),
        link("b", ""),
        link("c", ""),
        link("e", ""),
        link("f", ""),
        joint("k", "prismatic", ["a", "c"], OBLIQUE),
        joint("j", "revolute", ["a", "b"], OBLIQUE),
        joint("stopped", "revolute", ["b", "d"], OBLIQUE),
        joint("gone", "revolute", ["d", "e"], OBLIQUE),
        joint("l", "prismatic", ["b", "f"], &format!("{OBLIQUE}<mimic joint='j' multiplier='2'/>")),
    ]
    .concat();
    let items = format!(
        "input u: [Scalar; 2]; \
         body a {{ {BODY} }} body b {{ {BODY} }} body c {{ {BODY} }} body d {{ {BODY} }} body f {{ {BODY} }} \
         joint m: Fixed {{ parent: ground, child: a }} \
         joint d_: Fixed {{ parent: b{FRAME}, child: d }} \
         joint j: Revolute {{ parent: a{FRAME}, child: b, axis: [1, 2, -2] }} force on_j: Effort {{ joint: j, value: u[1] }} \
         joint k: Prismatic {{ parent: a{FRAME}, child: c, axis: [1, 2, -2] }} force on_k: Effort {{ joint: k, value: u[0] }} \
         joint l: Prismatic {{ parent: b{FRAME}, child: f, axis: [1, 2, -2] }} constraint g = l.travel - 2.0 * j.angle;"
    );
    same("base: ground, efforts: Inputs, lock: [stopped], drop: [e]", &file, &items, "");
}

/// Names that Rust or the language has, and links and joints of one name.
#[test]
fn names_become_identifiers() {
    let file = [
        link("a-1", ""),
        link("1/b", ""),
        link("ground", ""),
        joint("type", "revolute", ["a-1", "1/b"], ""),
        joint("ground", "revolute", ["1/b", "ground"], ""),
        // Heads of items that have no name.
        link("world", ""),
        link("formulation", ""),
        joint("solve", "revolute", ["1/b", "world"], ""),
        joint("force", "revolute", ["1/b", "formulation"], ""),
    ]
    .concat();
    let call = "mod robot { part r: Urdf { file: \"r\", base: ground }; part s: [Urdf; 2] = |i| Urdf { file: \"r\", base: ground.at(i * X) }; \
        output a = r.a_1.position; output b = s[1]._1_b.position; output c = r.ground_.position; output d = r.type_.angle + s[0].ground__joint.angle; \
        output e = r.world_.position + s[0].formulation_.position; output f = r.solve.angle + r.force.angle; }";
    let (models, said) = checked(call.parse().unwrap(), &format!("<robot>{file}</robot>"));
    assert_eq!(said, Vec::<String>::new());
    // One file with the same fields is one part.
    assert_eq!(models[0].part_types.len(), 1);
}

#[test]
fn a_part_of_the_users_comes_first() {
    let call = "mod Urdf { port p: Frame; body b { mass: 1 } joint j: Prismatic { parent: p, child: b, axis: X } } \
        mod m { part r: Urdf { p: ground }; }";
    assert_eq!(model_of(call, "no file").bodies.len(), 1);
}
