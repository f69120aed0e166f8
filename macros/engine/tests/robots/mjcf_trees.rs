//! Trees of bodies as MJCF against the numbers they were drawn from: several joints a body with anchors of their own, shapes,
//! defaults, angles in both units. Of shapes the truth is an integral over slices, each a link of its own in the recursion.

use std::fmt::Write;

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::JointId;

use crate::recursion::{Draw, Link, Matrix, Vector, add, apply, product, recursion, transposed, turn};
use crate::support::{functions, model_of, value};

const IDENTITY: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Name, armature, stiffness and rest of a joint.
type Sprung = (String, f64, f64, f64);

struct Tree {
    draw: Draw,
    is_degree: bool,
    sequence: &'static str,
    links: Vec<Link>,
    text: String,
    /// Of each joint: its name, armature, stiffness and rest.
    joints: Vec<Sprung>,
}

fn words(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}

/// Volume and moments of inertia about the three axes for a density of one, by Gauss' rule over slices across Z: exact, as a
/// slice's are polynomials of the fourth degree.
fn sliced(kind: &str, [a, b, c]: Vector) -> (f64, Vector) {
    let pieces = match kind {
        "capsule" => vec![(-b - a, -b), (-b, b), (b, b + a)],
        "cylinder" => vec![(-b, b)],
        "sphere" => vec![(-a, a)],
        _ => vec![(-c, c)],
    };
    let mut whole = (0.0, [0.0; 3]);
    for (low, high) in pieces {
        for (node, weight) in [(-0.6_f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6_f64.sqrt(), 5.0 / 9.0)] {
            let z = f64::midpoint(low, high) + (high - low) / 2.0 * node;
            let round = |radius2: f64| (std::f64::consts::PI * radius2, radius2 / 4.0, radius2 / 4.0);
            // The slice's area, and its mean squares of x and y.
            let (area, xx, yy) = match kind {
                "sphere" => round(a * a - z * z),
                "cylinder" => round(a * a),
                "capsule" => round(a * a - (z.abs() - b).max(0.0).powi(2)),
                "ellipsoid" => {
                    let part = 1.0 - z * z / (c * c);
                    (std::f64::consts::PI * a * b * part, a * a * part / 4.0, b * b * part / 4.0)
                }
                _ => (4.0 * a * b, a * a / 3.0, b * b / 3.0),
            };
            let volume = area * weight * (high - low) / 2.0;
            whole.0 += volume;
            whole.1 = add(whole.1, [yy + z * z, xx + z * z, xx + yy].map(|square| volume * square));
        }
    }
    whole
}

impl Tree {
    fn vector(&mut self) -> Vector {
        [(); 3].map(|()| self.draw.number())
    }

    fn angle(&self, value: f64) -> f64 {
        if self.is_degree { value * std::f64::consts::PI / 180.0 } else { value }
    }

    /// An orientation in one of the ways to write it, and its matrix.
    fn turned(&mut self) -> (String, Matrix) {
        let (v, w) = (self.vector(), 40.0 * self.draw.number() + 0.01);
        match self.draw.below(5) {
            0 => {
                // A quaternion of any length: half of the angle lies between it and its first number.
                let square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
                let matrix = turn(v, 2.0 * square.sqrt().atan2(w));
                (format!("quat='{}'", words(&[w, v[0], v[1], v[2]])), matrix)
            }
            1 => (format!("axisangle='{} {w}'", words(&v)), turn(v, self.angle(w))),
            2 => {
                let mut whole = IDENTITY;
                for (letter, angle) in self.sequence.chars().zip(v) {
                    let axis = IDENTITY["xyz".find(letter.to_ascii_lowercase()).unwrap()];
                    let step = turn(axis, self.angle(30.0 * angle));
                    whole = if letter.is_lowercase() { product(&whole, &step) } else { product(&step, &whole) };
                }
                (format!("euler='{}'", words(&v.map(|angle| 30.0 * angle))), whole)
            }
            3 => {
                // Axes of a known matrix, of other lengths, the second not quite across the first.
                let matrix = turn(v, w);
                let [x, y, _] = transposed(&matrix);
                let y = add(y.map(|k| 1.5 * k), x.map(|k| 0.25 * k));
                (format!("xyaxes='{} {}'", words(&x.map(|k| 2.0 * k)), words(&y)), matrix)
            }
            _ => {
                let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
                // About Z cross v.
                (format!("zaxis='{}'", words(&v)), turn([-v[1], v[0], 0.0], (v[2] / length).acos()))
            }
        }
    }

    fn link(&mut self, parent: Option<usize>, at: Vector, turned: Matrix) -> usize {
        self.links.push(Link {
            name: String::new(),
            parent,
            joint: String::new(),
            kind: "fixed".to_owned(),
            at,
            turned,
            axis: [0.0, 0.0, 1.0],
            damping: 0.0,
            mass: 0.0,
            com: [0.0; 3],
            inertia: [[0.0; 3]; 3],
        });
        self.links.len() - 1
    }

    fn geom(&mut self, body: usize, density: f64) {
        let kind = ["sphere", "capsule", "cylinder", "box", "ellipsoid"][self.draw.below(5) as usize];
        let size = [(); 3].map(|()| 0.3 + 0.1 * self.draw.number());
        let (at, (way, matrix)) = (self.vector(), self.turned());
        let (volume, inertia) = sliced(kind, size);
        let mass = if self.draw.below(2) == 0 { Some(2.0 + self.draw.number() / 2.0) } else { None };
        let said = mass.map_or_else(String::new, |mass| format!("mass='{mass}'"));
        // Ends at the same places, where there is a length.
        let place = if kind == "capsule" || kind == "cylinder" {
            let along = apply(&matrix, [0.0, 0.0, size[1]]);
            let ends = [add(at, along), add(at, along.map(|x| -x))].concat();
            format!("fromto='{}'", words(&ends))
        } else {
            format!("pos='{}' {way}", words(&at))
        };
        let _ = write!(self.text, "<geom type='{kind}' size='{}' {place} {said}/>", words(&size));
        let density = mass.map_or(density, |mass| mass / volume);
        let number = self.link(Some(body), at, matrix);
        let link = &mut self.links[number];
        link.mass = density * volume;
        link.inertia = [0, 1, 2].map(|i| [0, 1, 2].map(|j| if i == j { density * inertia[i] } else { 0.0 }));
    }

    fn body(&mut self, parent: Option<usize>, is_stiff: bool, depth: usize) {
        let (at, (way, matrix)) = (self.vector(), self.turned());
        let is_stiff = is_stiff || self.draw.below(3) == 0;
        let class = if is_stiff { "childclass='stiff'" } else { "" };
        let _ = write!(self.text, "<body pos='{}' {way} {class}>", words(&at));
        let mut own = self.link(parent, at, matrix);
        for _ in 0..self.draw.below(3) + u64::from(depth == 0) {
            let name = format!("j{:02}", self.joints.len());
            let (anchor, axis, slides) = (self.vector(), self.vector(), self.draw.below(3) == 0);
            let kind = if slides { "type='slide'" } else { "" };
            let pos = format!("pos='{}' axis='{}'", words(&anchor), words(&axis));
            let _ = write!(self.text, "<joint name='{name}' {kind} {pos}/>");
            // There and back again.
            own = self.link(Some(own), anchor, IDENTITY);
            let link = &mut self.links[own];
            link.joint.clone_from(&name);
            (if slides { "prismatic" } else { "revolute" }).clone_into(&mut link.kind);
            (link.axis, link.damping) = (axis, 0.25);
            own = self.link(Some(own), anchor.map(|x| -x), IDENTITY);
            let rest = if slides { 20.0 } else { self.angle(20.0) };
            self.joints.push((name, 0.125, if is_stiff { 2.0 } else { 0.0 }, rest));
        }
        for _ in 0..=self.draw.below(2) {
            self.geom(own, if is_stiff { 700.0 } else { 500.0 });
        }
        self.text.push_str("<geom type='mesh' mesh='skin' mass='0'/>");
        for _ in 0..if depth < 2 { 1 + self.draw.below(2) } else { 0 } {
            self.body(Some(own), is_stiff, depth + 1);
        }
        self.text.push_str("</body>");
    }
}

fn drawn(seed: u64) -> Tree {
    let mut tree = Tree {
        draw: Draw(seed),
        is_degree: seed.is_multiple_of(2),
        sequence: ["xyz", "ZYX", "zXy"][seed as usize % 3],
        links: Vec::new(),
        text: String::new(),
        joints: Vec::new(),
    };
    let unit = if tree.is_degree { "" } else { "angle='radian'" };
    let _ = write!(tree.text, "<mujoco><compiler {unit} eulerseq='{}'/><worldbody>", tree.sequence);
    tree.body(None, false, 0);
    tree.text.push_str(
        "</worldbody><default><joint damping='0.25' armature='0.125' springref='20'/><geom density='500'/>\
         <default class='stiff'><joint stiffness='2'/><geom density='700'/></default></default></mujoco>",
    );
    tree
}

#[test]
fn trees_are_what_they_were_drawn_from() {
    let call = "mod m { world { gravity: [1.5, -2.25, -9.0] } \
        part r: Mjcf { file: \"r.xml\", base: ground }; emit mass_matrix, bias; }";
    let mut coordinates = 0;
    for seed in 0..8 {
        let tree = drawn(seed);
        let model = model_of(call, &tree.text);
        let ids = (0..model.joints.len()).map(JointId);
        let moving: Vec<(JointId, &Sprung)> = ids
            .filter_map(|id| {
                let name = model.joints[id].place.field.to_string();
                Some((id, tree.joints.iter().find(|joint| name.ends_with(&joint.0))?))
            })
            .collect();
        assert_eq!(moving.len(), tree.joints.len());
        coordinates += moving.len();
        let names: Vec<String> = moving.iter().map(|(_, joint)| joint.0.clone()).collect();
        let of = |symbol: fn(JointId) -> Symbol| moving.iter().map(|&(id, _)| value(symbol(id))).collect::<Vec<f64>>();
        let q = of(|joint| Symbol::Position { joint, component: 0 });
        let v = of(|joint| Symbol::Velocity { joint, component: 0 });
        let base = ([0.0; 3], IDENTITY);
        let (mut matrix, mut bias) = recursion(&tree.links, &names, &base, [1.5, -2.25, -9.0], [&q, &v]);
        for (k, (_, (_, armature, stiffness, rest))) in moving.iter().enumerate() {
            matrix[k][k] += armature;
            bias[k] += stiffness * (q[k] - rest);
        }
        let found = functions(&model);
        for (kind, want) in [(FunctionKind::MassMatrix, matrix.concat()), (FunctionKind::Bias, bias)] {
            let got = &found[&kind].0;
            assert_eq!(got.len(), want.len(), "{kind:?} of {}", tree.text);
            let size = want.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
            for (x, y) in got.iter().zip(&want) {
                assert!((x - y).abs() <= 1e-11 * size, "{kind:?} {seed}: {x} and {y} of {}", tree.text);
            }
        }
    }
    assert!(coordinates > 20, "{coordinates}");
}
