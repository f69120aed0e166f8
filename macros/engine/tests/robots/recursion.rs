//! Trees of links that nobody has typed in, against a reader and a recursion of their own: rotation matrices, Jacobians of
//! centres of mass, and Newton's and Euler's equations in the ground's axes.

use std::fmt::Write;

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::JointId;
use roxmltree::{Document, Node};

use crate::support::{functions, model_of, value};

pub(crate) type Vector = [f64; 3];
pub(crate) type Matrix = [Vector; 3];

pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] + b[i])
}

pub(crate) fn scaled(a: Vector, factor: f64) -> Vector {
    a.map(|x| x * factor)
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn apply(m: &Matrix, a: Vector) -> Vector {
    m.map(|row| dot(row, a))
}

pub(crate) fn transposed(m: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i]))
}

pub(crate) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let columns = transposed(b);
    a.map(|row| columns.map(|column| dot(row, column)))
}

/// Rodrigues' formula.
pub(crate) fn turn(axis: Vector, angle: f64) -> Matrix {
    let [x, y, z] = scaled(axis, 1.0 / dot(axis, axis).sqrt());
    let (s, c) = angle.sin_cos();
    let v = 1.0 - c;
    [
        [c + x * x * v, x * y * v - z * s, x * z * v + y * s],
        [y * x * v + z * s, c + y * y * v, y * z * v - x * s],
        [z * x * v - y * s, z * y * v + x * s, c + z * z * v],
    ]
}

pub(crate) fn rpy([roll, pitch, yaw]: Vector) -> Matrix {
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    product(&turn(z, yaw), &product(&turn(y, pitch), &turn(x, roll)))
}

/// A link with the joint that it hangs on.
pub(crate) struct Link {
    pub(crate) name: String,
    pub(crate) parent: Option<usize>,
    pub(crate) joint: String,
    pub(crate) kind: String,
    pub(crate) at: Vector,
    pub(crate) turned: Matrix,
    pub(crate) axis: Vector,
    pub(crate) damping: f64,
    pub(crate) mass: f64,
    pub(crate) com: Vector,
    /// About the centre of mass, in the link's axes.
    pub(crate) inertia: Matrix,
}

pub(crate) fn numbers<const N: usize>(node: Option<Node>, name: &str) -> [f64; N] {
    let text = node.and_then(|node| node.attribute(name)).unwrap_or("0 0 0");
    let list: Vec<f64> = text.split_whitespace().map(|word| word.parse().unwrap()).collect();
    list.try_into().unwrap()
}

pub(crate) fn child<'a, 'b>(node: Node<'a, 'b>, name: &str) -> Option<Node<'a, 'b>> {
    node.children().find(|child| child.has_tag_name(name))
}

/// Parents first.
pub(crate) fn links(text: &str) -> Vec<Link> {
    let document = Document::parse(text).unwrap();
    let all = |tag| document.root_element().children().filter(move |node| node.has_tag_name(tag));
    let of_joint = |joint: &Node, end| child(*joint, end).unwrap().attribute("link").unwrap().to_owned();
    let mut found: Vec<Link> = Vec::new();
    while found.len() < all("link").count() {
        for node in all("link") {
            let name = node.attribute("name").unwrap();
            let joint = all("joint").find(|joint| of_joint(joint, "child") == name);
            let parent = joint.map(|joint| of_joint(&joint, "parent"));
            let at = parent.as_ref().map(|parent| found.iter().position(|link| link.name == *parent));
            if at == Some(None) || found.iter().any(|link| link.name == name) {
                continue;
            }
            let inertial = child(node, "inertial");
            let number = |tag, name| numbers::<1>(inertial.and_then(|inner| child(inner, tag)), name)[0];
            let origin = inertial.and_then(|inner| child(inner, "origin"));
            let own = rpy(numbers(origin, "rpy"));
            let inertia = match inertial {
                Some(_) => {
                    let [xx, yy, zz, xy, xz, yz] =
                        ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"].map(|name| number("inertia", name));
                    product(&own, &product(&[[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], &transposed(&own)))
                }
                None => [[0.0; 3]; 3],
            };
            let placed = joint.and_then(|joint| child(joint, "origin"));
            let dynamics = joint.and_then(|joint| child(joint, "dynamics"));
            found.push(Link {
                name: name.to_owned(),
                parent: at.flatten(),
                joint: joint.map_or("", |joint| joint.attribute("name").unwrap()).to_owned(),
                kind: joint.map_or("fixed", |joint| joint.attribute("type").unwrap()).to_owned(),
                at: numbers(placed, "xyz"),
                turned: rpy(numbers(placed, "rpy")),
                axis: numbers(joint.and_then(|joint| child(joint, "axis")), "xyz"),
                damping: dynamics.map_or(0.0, |node| numbers::<1>(Some(node), "damping")[0]),
                mass: if inertial.is_some() { number("mass", "value") } else { 0.0 },
                com: numbers(origin, "xyz"),
                inertia,
            });
        }
    }
    found
}

/// How a link moves while no coordinate accelerates, in the ground's axes.
#[derive(Clone)]
pub(crate) struct Motion {
    pub(crate) place: Vector,
    pub(crate) turned: Matrix,
    pub(crate) omega: Vector,
    pub(crate) alpha: Vector,
    /// Of the place, with that which holds against gravity.
    pub(crate) acceleration: Vector,
    /// Joints on the way to it: coordinate, axis, place, whether it turns.
    above: Vec<(usize, Vector, Vector, bool)>,
}

impl Motion {
    /// What each coordinate's rate gives a point of the link: coordinate, velocity, angular velocity.
    pub(crate) fn columns(&self, point: Vector) -> Vec<(usize, Vector, Vector)> {
        let columns = self.above.iter().map(|&(number, axis, place, turns)| match turns {
            true => (number, cross(axis, add(point, scaled(place, -1.0))), axis),
            false => (number, axis, [0.0; 3]),
        });
        columns.collect()
    }

    /// Of a point that is off the place by this much.
    pub(crate) fn acceleration_at(&self, arm: Vector) -> Vector {
        let centrifugal = cross(self.omega, cross(self.omega, arm));
        add(self.acceleration, add(cross(self.alpha, arm), centrifugal))
    }
}

/// Of all links. A `floating` root lies where the base is: its coordinates are the rates of its place in the ground's axes and its
/// angular velocity in its own.
pub(crate) fn motions(
    links: &[Link],
    joints: &[String],
    base: &(Vector, Matrix),
    gravity: Vector,
    [q, v]: [&[f64]; 2],
) -> Vec<Motion> {
    let mut motions: Vec<Motion> = Vec::new();
    for link in links {
        let zero = [0.0; 3];
        let ground = Motion {
            place: base.0,
            turned: base.1,
            omega: zero,
            alpha: zero,
            acceleration: scaled(gravity, -1.0),
            above: Vec::new(),
        };
        let parent = link.parent.map_or(ground, |parent| motions[parent].clone());
        let mut own = parent.clone();
        own.turned = product(&parent.turned, &link.turned);
        let mut way = apply(&parent.turned, link.at);
        let number = || joints.iter().position(|joint| *joint == link.joint).unwrap();
        if link.kind == "floating" {
            let (first, axes) = (number(), transposed(&own.turned));
            own.omega = apply(&own.turned, [3, 4, 5].map(|k| v[first + k]));
            own.above.extend((0..3).map(|k| (first + k, [0, 1, 2].map(|i| f64::from(i == k)), own.place, false)));
            own.above.extend((0..3).map(|k| (first + 3 + k, axes[k], own.place, true)));
        } else if link.kind != "fixed" {
            let number = number();
            let unit = scaled(link.axis, 1.0 / dot(link.axis, link.axis).sqrt());
            let axis = apply(&own.turned, unit);
            let turns = link.kind != "prismatic";
            if turns {
                own.turned = product(&own.turned, &turn(unit, q[number]));
                own.omega = add(parent.omega, scaled(axis, v[number]));
                own.alpha = add(parent.alpha, cross(parent.omega, scaled(axis, v[number])));
            } else {
                way = add(way, scaled(axis, q[number]));
            }
            own.above.push((number, axis, add(parent.place, way), turns));
        }
        own.place = add(parent.place, way);
        own.acceleration = parent.acceleration_at(way);
        if link.kind == "prismatic" {
            let &(number, axis, ..) = own.above.last().unwrap();
            own.acceleration = add(own.acceleration, scaled(cross(parent.omega, axis), 2.0 * v[number]));
        }
        motions.push(own);
    }
    motions
}

/// Mass matrix and bias for coordinates in the order of `joints`.
pub(crate) fn recursion(
    links: &[Link],
    joints: &[String],
    base: &(Vector, Matrix),
    gravity: Vector,
    [q, v]: [&[f64]; 2],
) -> (Vec<Vec<f64>>, Vec<f64>) {
    let count = joints.len();
    let (mut matrix, mut bias) = (vec![vec![0.0; count]; count], vec![0.0; count]);
    for (link, own) in links.iter().zip(motions(links, joints, base, gravity, [q, v])) {
        if let Some(number) = joints.iter().position(|joint| *joint == link.joint) {
            bias[number] += link.damping * v[number];
        }
        let arm = apply(&own.turned, link.com);
        let inertia = product(&own.turned, &product(&link.inertia, &transposed(&own.turned)));
        let gyroscopic = cross(own.omega, apply(&inertia, own.omega));
        let force = scaled(own.acceleration_at(arm), link.mass);
        let moment = add(apply(&inertia, own.alpha), gyroscopic);
        let columns = own.columns(add(own.place, arm));
        for &(row, linear, angular) in &columns {
            bias[row] += dot(linear, force) + dot(angular, moment);
            for &(column, other_linear, other_angular) in &columns {
                matrix[row][column] +=
                    link.mass * dot(linear, other_linear) + dot(angular, apply(&inertia, other_angular));
            }
        }
    }
    (matrix, bias)
}

/// Numbers with few digits, as files have them.
pub(crate) struct Draw(pub(crate) u64);

impl Draw {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    pub(crate) fn below(&mut self, bound: u64) -> u64 {
        self.next() % bound
    }

    pub(crate) fn number(&mut self) -> f64 {
        (self.below(4001) as f64 - 2000.0) / 1000.0
    }

    fn triple(&mut self) -> String {
        let numbers = [(); 3].map(|()| self.number());
        format!("{} {} {}", numbers[0], numbers[1], numbers[2])
    }
}

/// A tree of links, of which none is in any order.
fn robot(draw: &mut Draw, count: usize) -> String {
    let mut items = Vec::new();
    for k in 0..count {
        let kind = ["revolute", "continuous", "prismatic", "fixed"][draw.below(4) as usize];
        let mut inertial = String::new();
        // A link on a fixed joint may have none.
        if k > 0 && (kind != "fixed" || draw.below(2) == 0) {
            let [xx, yy, zz] = [(); 3].map(|()| 1.0 + 0.1 * draw.number());
            let [xy, xz, yz] = [(); 3].map(|()| 0.05 * draw.number());
            let turned = if draw.below(2) == 0 { String::new() } else { format!("rpy='{}'", draw.triple()) };
            let _ = write!(
                inertial,
                "<inertial><origin xyz='{}' {turned}/><mass value='{}'/><inertia ixx='{xx}' ixy='{xy}' ixz='{xz}' \
                 iyy='{yy}' iyz='{yz}' izz='{zz}'/></inertial>",
                draw.triple(),
                3.0 + draw.number()
            );
        }
        items.push(format!("<link name='link-{k}'>{inertial}</link>"));
        if k > 0 {
            let parent = draw.below(k as u64);
            let damping = if draw.below(2) == 0 { "<dynamics damping='0.375'/>" } else { "" };
            let axis = if draw.below(4) == 0 { "0 -1 0".to_owned() } else { draw.triple() };
            let damping = if kind == "fixed" { "" } else { damping };
            items.push(format!(
                "<joint name='joint {k}' type='{kind}'><origin xyz='{}' rpy='{}'/><axis xyz='{axis}'/>\
                 <parent link='link-{parent}'/><child link='link-{k}'/><limit effort='1' velocity='2'/>{damping}</joint>",
                draw.triple(),
                draw.triple()
            ));
        }
    }
    for last in (1..items.len()).rev() {
        let other = draw.below(last as u64 + 1) as usize;
        items.swap(last, other);
    }
    format!("<robot name='drawn'>{}</robot>", items.concat())
}

#[test]
fn trees_are_what_another_reader_makes_of_them() {
    let call = "mod m { world { gravity: [1.5, -2.25, -9.0] } \
        part r: Urdf { file: \"r.urdf\", base: ground.at([0.3, -0.2, 0.5]).rotated(Z, 0.3).rotated(X, -0.8) }; \
        emit mass_matrix, bias, inverse_dynamics; }";
    let base = ([0.3, -0.2, 0.5], product(&turn([0.0, 0.0, 1.0], 0.3), &turn([1.0, 0.0, 0.0], -0.8)));
    let mut coordinates = 0;
    for seed in 0..12 {
        let text = robot(&mut Draw(seed), 7);
        let links = links(&text);
        let model = model_of(call, &text);
        let ids: Vec<JointId> = (0..model.joints.len()).map(JointId).collect();
        let of_file = |id: &JointId| {
            let name = model.joints[*id].place.field.to_string();
            links.iter().find(|link| link.kind != "fixed" && name.ends_with(&link.joint.replace(' ', "_")))
        };
        let moving: Vec<(JointId, &Link)> = ids.iter().filter_map(|id| Some((*id, of_file(id)?))).collect();
        if moving.is_empty() {
            continue;
        }
        coordinates += moving.len();
        let joints: Vec<String> = moving.iter().map(|(_, link)| link.joint.clone()).collect();
        let of = |symbol: fn(JointId) -> Symbol| moving.iter().map(|&(id, _)| value(symbol(id))).collect::<Vec<f64>>();
        let q = of(|joint| Symbol::Position { joint, component: 0 });
        let v = of(|joint| Symbol::Velocity { joint, component: 0 });
        let a = of(|joint| Symbol::Acceleration { joint, component: 0 });
        let (matrix, bias) = recursion(&links, &joints, &base, [1.5, -2.25, -9.0], [&q, &v]);
        let efforts =
            matrix.iter().zip(&bias).map(|(row, bias)| bias + row.iter().zip(&a).map(|(m, a)| m * a).sum::<f64>());
        let wanted = [
            (FunctionKind::MassMatrix, matrix.concat()),
            (FunctionKind::Bias, bias.clone()),
            (FunctionKind::InverseDynamics, efforts.collect()),
        ];
        let found = functions(&model);
        for (kind, want) in wanted {
            let got = &found[&kind].0;
            assert_eq!(got.len(), want.len(), "{kind:?} of {text}");
            let size = want.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
            for (x, y) in got.iter().zip(&want) {
                assert!((x - y).abs() <= 1e-12 * size, "{kind:?}: {x} and {y} of {text}");
            }
        }
    }
    assert!(coordinates > 30, "{coordinates}");
}
