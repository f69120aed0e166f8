//! What MJCF has beside trees, against the same typed in, and its mistakes.

use crate::support::{assert_same, checked, model_of};

const END: &str = "emit forward_dynamics, inverse_dynamics, mass_matrix, energy;";
const INERTIAL: &str = "<inertial pos='.1 -2e-2 +0.3' mass='2.' fullinertia='0.2 0.3 0.4 0.01 -0.02 3e-2'/>";
const BODY: &str = "mass: 2.0, com: [0.1, -0.02, 0.3], inertia: inertia(0.2, 0.3, 0.4, 0.01, -0.02, 0.03)";

fn same(fields: &str, file: &str, items: &str) {
    let world = "world { gravity: [1.0, -2.0, -9.0] }";
    let call = format!("mod robot {{ {world} part r: Mjcf {{ file: \"r.xml\", {fields} }}; {END} }}");
    let file = format!("<mujoco><compiler angle='radian'/>{file}</mujoco>");
    let typed = model_of(&format!("mod typed {{ {world} {items} {END} }}"), "");
    assert_same(&typed, &model_of(&call, &file), true);
}

/// A body on a ball that is held off its origin, one that floats.
#[test]
fn balls_have_anchors_and_free_joints_the_worlds_coordinates() {
    let file = format!(
        "<worldbody><body name='a' pos='0.3 0.2 -0.1' euler='0.4 0 0'><joint name='j' type='ball' pos='0.1 0.2 0.3'/>{INERTIAL}</body>\
         <body name='b' pos='1 2 3'><freejoint name='k'/>{INERTIAL}</body></worldbody>"
    );
    let items = format!(
        "body a {{ {BODY} }} body b {{ {BODY} }} \
         joint j: Ball {{ parent: ground.at([0.3, 0.2, -0.1]).rotated(X, 0.4).at([0.1, 0.2, 0.3]), child: a.at([0.1, 0.2, 0.3]) }} \
         joint k: Free {{ parent: ground, child: b }}"
    );
    same("base: ground", &file, &items);
}

const CHAIN: &str = "<body name='a' pos='0.3 0.2 -0.1'><joint name='j' axis='1 2 -2'/>{I}\
    <body name='b' pos='0.5 0 0.2'><joint name='k' type='slide' axis='1 2 -2'/>{I}</body></body>";
const TYPED: &str = "body a { {B} } body b { {B} } \
    joint j: Revolute { parent: ground.at([0.3, 0.2, -0.1]), child: a, axis: [1, 2, -2] } \
    joint k: Prismatic { parent: a.at([0.5, 0.0, 0.2]), child: b, axis: [1, 2, -2] } ";

#[test]
fn joints_are_coupled_and_driven() {
    let file = format!(
        "<worldbody>{CHAIN}</worldbody><equality><joint joint1='k' joint2='j' polycoef='0.1 -0.5 0 0 0'/></equality>\
         <actuator><motor name='j' joint='j' gear='3 0 0 0 0 0'/><motor joint='k'/></actuator>"
    );
    let items = format!(
        "{TYPED} constraint g = k.travel - (-0.5 * j.angle + 0.1); input u: Scalar; input w: Scalar; \
         force f: Effort {{ joint: j, value: 3.0 * u }} force h: Effort {{ joint: k, value: w }}"
    );
    same("base: ground", &file.replace("{I}", INERTIAL), &items.replace("{B}", BODY));
}

/// The point of the other body is where both are while all coordinates are zero.
#[test]
fn loops_are_closed_where_the_bodies_are() {
    let three = CHAIN.replace(
        "</body></body>",
        "</body></body><body name='c' pos='1.2 0.4 0' quat='1 0 0 0'><joint name='l' type='ball'/>{I}</body>",
    );
    let file = format!(
        "<worldbody>{three}</worldbody><equality><connect body1='b' body2='c' anchor='0.1 0.25 0.5'/></equality>"
    );
    // (0.8, 0.2, 0.1) + (0.1, 0.25, 0.5) - (1.2, 0.4, 0)
    let items = format!(
        "{TYPED} body c {{ {{B}} }} joint l: Ball {{ parent: ground.at([1.2, 0.4, 0.0]), child: c }} \
         joint n: Ball {{ parent: b.at([0.1, 0.25, 0.5]), child: c.at([-0.3, 0.05, 0.6]) }}"
    );
    let typed = model_of(&format!("mod typed {{ {} emit mass_matrix, bias; }}", items.replace("{B}", BODY)), "");
    let call = "mod robot { part r: Mjcf { file: \"r.xml\", base: ground }; emit mass_matrix, bias; }";
    let robot = model_of(call, &format!("<mujoco>{}</mujoco>", file.replace("{I}", INERTIAL)));
    assert_same(&typed, &robot, false);
}

/// The numbers of a line of the text that a file is written as.
fn numbers(text: &str, item: &str) -> Vec<f64> {
    let line = text.lines().find(|line| line.trim().starts_with(item)).unwrap();
    let words = line[line.find(':').unwrap()..].split(|c: char| !(c.is_ascii_digit() || ".-e".contains(c)));
    words.filter_map(|word| word.parse().ok()).collect()
}

/// A body that is turned by a quarter about Z: what lies off it along the world's X is along its own -Y.
#[test]
fn loops_are_closed_in_the_axes_of_both_bodies() {
    let file = format!(
        "<mujoco><worldbody><body name='a' pos='1 2 3'><joint name='j'/>{INERTIAL}</body>\
         <body name='b' pos='0.5 2 3' euler='0 0 90'><joint name='k'/>{INERTIAL}</body></worldbody>\
         <equality><connect name='c' body1='a' body2='b' anchor='0.25 0 0.5'/><weld name='w' body1='a' body2='b'/></equality></mujoco>"
    );
    let text = multibody_engine::robots::import(&file, "r.xml").unwrap();
    // Off `b` by (0.75, 0, 0.5) in the world; `b` off `a` by (-0.5, 0, 0), turned.
    for (item, wanted) in [
        ("joint c: Ball", vec![0.25, 0.0, 0.5, 0.0, -0.75, 0.5]),
        ("joint w: Fixed", vec![-0.5, 0.0, 0.0, std::f64::consts::FRAC_PI_2]),
    ] {
        let found = numbers(&text, item);
        assert_eq!(found.len(), wanted.len(), "{text}");
        assert!(found.iter().zip(&wanted).all(|(x, y)| (x - y).abs() < 1e-12), "{found:?} of {text}");
    }
}

/// A file, then what is said of it. `{J}` is the line of a joint in a body of a good file.
const MISTAKES: [(&str, &str); 33] = include!("mjcf_mistakes.txt");

#[test]
fn every_mistake_is_told_once() {
    let mut wrong = String::new();
    for (case, expected) in MISTAKES {
        let file = match case.strip_prefix("joint ") {
            Some(joint) => {
                format!("<mujoco>\n<worldbody>\n<body name='a'>{INERTIAL}\n  {joint}\n</body></worldbody></mujoco>")
            }
            None => case.replace("{I}", INERTIAL),
        };
        let (_, said) = checked("mod m { part r: Mjcf { file: \"r.xml\", base: ground }; }".parse().unwrap(), &file);
        if said != [expected] {
            wrong.push_str(&format!("{case}\n    {said:?}\n"));
        }
    }
    assert!(wrong.is_empty(), "said instead:\n{wrong}");
}
