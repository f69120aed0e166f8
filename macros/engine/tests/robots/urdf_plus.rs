//! What URDF+ adds to URDF, against the same typed in: loops of every type, couplings over several joints.

use crate::support::{assert_same, functions, model_of};

const INERTIAL: &str = "<inertial><origin xyz='.1 -2e-2 +0.3'/><mass value='2.'/>\
    <inertia ixx='0.2' iyy='0.3' izz='0.4' ixy='0.01' ixz='-0.02' iyz='3e-2'/></inertial>";
const BODY: &str = "mass: 2.0, com: [0.1, -0.02, 0.3], inertia: inertia(0.2, 0.3, 0.4, 0.01, -0.02, 0.03)";
const END: &str = "emit forward_dynamics, inverse_dynamics, mass_matrix, bias;";

fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], place: &str) -> String {
    format!(
        "<link name='{child}'>{INERTIAL}</link><joint name='{name}' type='{kind}' independent='false'>\
         <parent link='{parent}'/><child link='{child}'/><origin xyz='{place}' rpy='0.4 -0.7 1.1'/><axis xyz='1 2 -2'/></joint>"
    )
}

fn typed(name: &str, kind: &str, [parent, child]: [&str; 2], place: &str) -> String {
    let axis = if kind == "Free" { "" } else { ", axis: [1, 2, -2]" };
    format!(
        "body {child} {{ {BODY} }} joint {name}: {kind} {{ \
         parent: {parent}.at([{place}]).rotated(Z, 1.1).rotated(Y, -0.7).rotated(X, 0.4), child: {child}{axis} }}"
    )
}

/// A tree of five joints, two chains from one link.
fn tree(joint: fn(&str, &str, [&str; 2], &str) -> String, kinds: [&str; 3], places: [&str; 5]) -> String {
    let joints = [
        joint("ja", kinds[0], ["root", "a"], places[0]),
        joint("jb", kinds[0], ["a", "b"], places[1]),
        joint("jc", kinds[1], ["b", "c"], places[2]),
        joint("jd", kinds[0], ["a", "d"], places[3]),
        joint("je", kinds[2], ["d", "e"], places[4]),
    ];
    joints.concat()
}

fn same(last: [&str; 2], ties: &str, items: &str) {
    let places = ["0.3 0.2 -0.1", "0.1 -0.4 0.2", "-0.2 0.5 0.3", "0.6 0.1 0.1", "0.2 0.2 -0.5"];
    let file = format!(
        "<robot name='r'><link name='root'/>{}{ties}</robot>",
        tree(joint, ["continuous", "prismatic", last[0]], places)
    );
    let with_points =
        |place: &str| place.split(' ').map(|x| format!("{:?}", x.parse::<f64>().unwrap())).collect::<Vec<_>>();
    let places = places.map(|place| with_points(place).join(", "));
    let tree = tree(typed, ["Revolute", "Prismatic", last[1]], places.each_ref().map(String::as_str))
        .replace("root", "ground");
    let world = "world { gravity: [1.0, -2.0, -9.0] }";
    let robot =
        model_of(&format!("mod robot {{ {world} part r: Urdf {{ file: \"r.urdf\", base: ground }}; {END} }}"), &file);
    assert_same(&model_of(&format!("mod typed {{ {world} {tree} {items} {END} }}"), ""), &robot, true);
}

/// The axis of a loop is in the frame that both of its ends have.
#[test]
fn loops_of_every_type_close() {
    let kinds = [
        ("revolute", "Revolute", ", axis: [2, -1, 3]"),
        ("continuous", "Revolute", ", axis: [2, -1, 3]"),
        ("prismatic", "Prismatic", ", axis: [2, -1, 3]"),
        ("planar", "Planar", ", axis: [2, -1, 3]"),
        ("fixed", "Fixed", ""),
    ];
    for (kind, word, axis) in kinds {
        let ties = format!(
            "<loop name='pin' type='{kind}'><predecessor link='c'><origin xyz='0.2 0.1 0.4' rpy='0.3 0 -0.2'/></predecessor>\
             <successor link='e'><origin rpy='0 0.8 0'/></successor><axis xyz='2 -1 3'/></loop>"
        );
        let items = format!(
            "#[cut] joint pin: {word} {{ parent: c.at([0.2, 0.1, 0.4]).rotated(Z, -0.2).rotated(X, 0.3), \
             child: e.rotated(Y, 0.8){axis} }}"
        );
        // A loop of any type closes on a joint of all freedoms.
        same(["floating", "Free"], &ties, &items);
    }
}

/// The ratio is of the sums of coordinates from the nearest link that carries both ends: `ja` carries both, so it is in neither.
#[test]
fn couplings_are_of_all_joints_on_the_way() {
    let tie = |ends: [&str; 2]| {
        let [a, b] = ends;
        format!("<coupling name='g'><predecessor link='{a}'/><successor link='{b}'/><ratio value='-2.5'/></coupling>")
    };
    let turns = ["continuous", "Revolute"];
    same(turns, &tie(["c", "e"]), "constraint g = -2.5 * (jb.angle + jc.travel) - (jd.angle + je.angle);");
    same(turns, &tie(["b", "d"]), "constraint g = -2.5 * jb.angle - jd.angle;");
    // One end carries the other: its own side is empty.
    same(turns, &tie(["a", "e"]), "constraint g = jd.angle + je.angle;");
}

/// What is locked has no coordinate; a tie of which one end is dropped is dropped.
#[test]
fn ties_follow_what_is_locked_and_dropped() {
    let ends = "<predecessor link='c'/><successor link='e'/>";
    let ties = format!("<coupling name='g'>{ends}<ratio value='3'/></coupling>");
    let file = |ties: &str| {
        let places = ["0.3 0.2 -0.1", "0.1 -0.4 0.2", "-0.2 0.5 0.3", "0.6 0.1 0.1", "0.2 0.2 -0.5"];
        format!("<robot><link name='root'/>{}{ties}</robot>", tree(joint, ["continuous"; 3], places))
    };
    let model = |fields: &str, items: &str, ties: &str| {
        let call =
            format!("mod robot {{ part r: Urdf {{ file: \"r.urdf\", base: ground, {fields} }}; {items} {END} }}");
        model_of(&call, &file(ties))
    };
    let locked = model("lock: [jb, je]", "", &ties);
    let typed = model("lock: [jb, je]", "constraint g = 3.0 * r.jc.angle - r.jd.angle;", "");
    assert_same(&typed, &locked, true);
    let ties = format!("{ties}<loop name='pin' type='fixed'>{ends}</loop>");
    assert_same(&model("drop: [e]", "", ""), &model("drop: [e]", "", &ties), true);
}

/// Which coordinates a state has is not for the file to say, but it is listed.
#[test]
fn independent_is_read_over() {
    let file = format!("<robot><link name='root'/>{}</robot>", joint("j", "continuous", ["root", "a"], "1 2 3"));
    let text = multibody_engine::robots::import(&file, "r.urdf").unwrap();
    assert!(text.contains("/// Read over, as it has no mechanics: `independent` (1)."), "{text}");
    assert!(
        functions(&model_of("mod m { part r: Urdf { file: \"r.urdf\", base: ground }; emit bias; }", &file)).len() == 1
    );
}
