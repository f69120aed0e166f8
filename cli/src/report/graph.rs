//! The mechanism as a graph: bodies, the joints that carry them, what closes loops, what is driven.
//!
//! In: the model, its structure and its facts. Out: a picture and the same as an indented list.

use std::fmt::Write;

use multibody_engine::emit::Facts;
use multibody_engine::mechanics::Reads;
use multibody_engine::mechanics::loops::structure::{Role, Structure};
use multibody_engine::model::types::{BodyRef, ConstraintKind, Coordinate, DriveTarget, JointId, Model};

use super::document::Figure;
use super::layers::{self, Gaps, Placed, Vertex, place};
use super::svg::{Picture, number, width};

/// Widest picture that a page holds.
const WIDEST: f64 = 960.0;

const NAME: f64 = 12.0;
const KIND: f64 = 10.0;
const PADDING: f64 = 20.0;
const MARGIN: f64 = 12.0;

struct Node {
    name: String,
    /// Below the name; nothing for bodies.
    kind: String,
    class: &'static str,
    layer: usize,
}

struct Edge {
    from: usize,
    to: usize,
    closes: bool,
}

/// Everything that the picture shows.
pub(super) struct Graph {
    nodes: Vec<Node>,
    edges: Vec<Edge>,
}

/// What a reader can tell a joint by.
const LEGEND: [(&str, &str); 7] = [
    ("ground", "ground"),
    ("body", "body"),
    ("state", "joint whose coordinates are in the state"),
    ("follows", "joint that follows from others"),
    ("driven", "driven joint"),
    ("fixed", "joint without freedoms"),
    ("closes", "closes a loop"),
];

impl Graph {
    pub(super) fn new(model: &Model, structure: &Structure, facts: &Facts) -> Graph {
        let ground = Node { name: "ground".to_owned(), kind: String::new(), class: "ground", layer: 0 };
        let mut graph = Graph { nodes: vec![ground], edges: Vec::new() };
        let mut bodies = vec![0; model.bodies.len()];
        let mut joints = vec![None; model.joints.len()];
        for &id in &model.tree {
            let (joint, fact) = (&model.joints[id], &facts.joints[id.0]);
            let parent = at(&bodies, joint.parent.body);
            let class = class(model, structure, id);
            let kind = if class == "driven" { format!("{}, driven", fact.kind) } else { fact.kind.to_owned() };
            let node = graph.beyond(&[parent], fact.name.clone(), kind, class);
            joints[id.0] = Some(node);
            if let BodyRef::Body(body) = joint.child.body {
                bodies[body.0] = graph.beyond(&[node], facts.bodies[body.0].name.clone(), String::new(), "body");
            }
        }
        for &id in &model.cuts {
            let (joint, fact) = (&model.joints[id], &facts.joints[id.0]);
            let ends = [at(&bodies, joint.parent.body), at(&bodies, joint.child.body)];
            let measured = model.constraints.iter().any(|constraint| constraint.drive.is_some_and(|c| c.joint == id));
            let (kind, class) = match measured {
                true => (format!("{}, driven", fact.kind), "driven closes"),
                false => (fact.kind.to_owned(), "closes"),
            };
            joints[id.0] = Some(graph.beyond(&ends, fact.name.clone(), kind, class));
        }
        for (constraint, name) in model.constraints.iter().zip(&facts.constraints) {
            match &constraint.kind {
                ConstraintKind::Rod { between, .. } => {
                    let ends = between.each_ref().map(|frame| at(&bodies, frame.body));
                    graph.beyond(&ends, name.clone(), "rod".to_owned(), "closes");
                }
                // The drive of a measured coordinate is told at its joint.
                ConstraintKind::Value(_) if constraint.drive.is_some() => {}
                ConstraintKind::Value(value) | ConstraintKind::Rate(value) => {
                    let reads = Reads::of([value]);
                    let on_joints = reads.joints.iter().filter_map(|joint| joints[joint.0]);
                    let ends: Vec<usize> =
                        on_joints.chain(reads.bodies().into_iter().map(|body| at(&bodies, body))).collect();
                    graph.beyond(&ends, name.clone(), "expression".to_owned(), "closes");
                }
            }
        }
        graph
    }

    /// A node in the layer behind those that it hangs on.
    fn beyond(&mut self, on: &[usize], name: String, kind: String, class: &'static str) -> usize {
        let layer = on.iter().map(|&node| self.nodes[node].layer + 1).max().unwrap_or(1);
        let to = self.nodes.len();
        let closes = class.contains("closes");
        self.nodes.push(Node { name, kind, class, layer });
        let mut known = Vec::new();
        for &from in on {
            // Both ends of a joint may be on one body.
            if !known.contains(&from) {
                known.push(from);
                self.edges.push(Edge { from, to, closes });
            }
        }
        to
    }

    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    pub(super) fn figure(&self, model: &Model) -> Figure {
        let shown = |class: &str| self.nodes.iter().any(|node| node.class.split(' ').any(|word| word == class));
        Figure {
            svg: self.svg(&model.name.to_string()),
            text: self.text(),
            caption: String::new(),
            legend: LEGEND.into_iter().filter(|(class, _)| shown(class)).collect(),
        }
    }

    /// From the ground downwards, or to the right where that is narrower than the page and this is not.
    fn svg(&self, name: &str) -> String {
        let sizes: Vec<[f64; 2]> = self.nodes.iter().map(Node::size).collect();
        // What carries stands straight before what it carries.
        let pull = |edge: &Edge| if edge.closes { 1.0 } else { layers::STRAIGHT };
        let edges = self.edges.iter().map(|edge| layers::Edge { from: edge.from, to: edge.to, pull: pull(edge) });
        let edges: Vec<layers::Edge> = edges.collect();
        let placed = |downwards: bool| {
            let vertex = |(node, &[w, h]): (&Node, &[f64; 2])| {
                let [along, across] = if downwards { [w, h] } else { [h, w] };
                Vertex { along, across, layer: node.layer }
            };
            let vertices: Vec<Vertex> = self.nodes.iter().zip(&sizes).map(vertex).collect();
            let gaps = if downwards { Gaps { along: 14.0, across: 18.0 } } else { Gaps { along: 10.0, across: 28.0 } };
            let Placed { vertices, bends, size } = place(&vertices, &edges, gaps);
            let turn = |p: [f64; 2]| if downwards { p } else { [p[1], p[0]] };
            Placed {
                vertices: vertices.into_iter().map(turn).collect(),
                bends: bends.into_iter().map(|own| own.into_iter().map(turn).collect()).collect(),
                size: turn(size),
            }
        };
        let (down, right) = (placed(true), placed(false));
        let fits = |placed: &Placed| placed.size[0] <= WIDEST;
        let downwards = match (fits(&down), fits(&right)) {
            (true, true) => down.size[0] * down.size[1] <= right.size[0] * right.size[1],
            (true, false) => true,
            (false, true) => false,
            (false, false) => down.size[0] <= right.size[0],
        };
        let placed = if downwards { down } else { right };
        let title = format!("The mechanism {name} as a graph");
        let [w, h] = placed.size.map(|x| x + 2.0 * MARGIN);
        let mut picture = Picture::new("graph", title, w, h);
        let inside = |[x, y]: [f64; 2]| [x + MARGIN, y + MARGIN];
        for (edge, bends) in self.edges.iter().zip(&placed.bends) {
            let border = |node: usize, forwards: f64| {
                let ([x, y], [w, h]) = (placed.vertices[node], sizes[node]);
                inside(if downwards { [x, y + forwards * h / 2.0] } else { [x + forwards * w / 2.0, y] })
            };
            let bends = bends.iter().map(|&bend| inside(bend));
            let points: Vec<[f64; 2]> =
                std::iter::once(border(edge.from, 1.0)).chain(bends).chain([border(edge.to, -1.0)]).collect();
            let class = if edge.closes { "edge closes" } else { "edge" };
            picture.add(&format!("<path class=\"{class}\" d=\"{}\"/>", curve(&points, downwards)));
        }
        for ((node, &point), &size) in self.nodes.iter().zip(&placed.vertices).zip(&sizes) {
            node.draw(&mut picture, inside(point), size);
        }
        picture.finish()
    }

    /// ```text
    /// ground
    ///   shoulder (revolute)
    ///     upper
    /// ```
    fn text(&self) -> String {
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); self.nodes.len()];
        let mut closings: Vec<(usize, Vec<&str>)> = Vec::new();
        for edge in &self.edges {
            if !edge.closes {
                children[edge.from].push(edge.to);
                continue;
            }
            let from = self.nodes[edge.from].name.as_str();
            match closings.last_mut().filter(|last| last.0 == edge.to) {
                Some((_, ends)) => ends.push(from),
                None => closings.push((edge.to, vec![from])),
            }
        }
        let mut text = String::new();
        let mut stack = vec![(0, 0)];
        while let Some((node, depth)) = stack.pop() {
            let _ = writeln!(text, "{}{}", "  ".repeat(depth), self.nodes[node].words());
            stack.extend(children[node].iter().rev().map(|&child| (child, depth + 1)));
        }
        for (node, ends) in closings {
            let _ = writeln!(text, "{} closes: {}", self.nodes[node].words(), ends.join(" - "));
        }
        text
    }
}

fn at(bodies: &[usize], body: BodyRef) -> usize {
    match body {
        BodyRef::Ground => 0,
        BodyRef::Body(id) => bodies[id.0],
    }
}

/// What becomes of a joint's coordinates.
fn class(model: &Model, structure: &Structure, id: JointId) -> &'static str {
    let freedoms = model.joints[id].kind.freedoms();
    let roles = (0..freedoms).map(|index| structure.role(Coordinate { joint: id, index }));
    let roles: Vec<Role> = roles.collect();
    let driven = model.drives.iter().any(|drive| match drive.target {
        DriveTarget::Coordinate(coordinate) => coordinate.joint == id,
        DriveTarget::Position(joint) | DriveTarget::Orientation(joint) | DriveTarget::Pose(joint) => joint == id,
    });
    if driven {
        "driven"
    } else if roles.is_empty() {
        "fixed"
    } else if roles.iter().any(|role| matches!(role, Role::Dependent(_))) {
        "follows"
    } else {
        "state"
    }
}

impl Node {
    fn size(&self) -> [f64; 2] {
        let name = width(&self.name, NAME);
        if self.kind.is_empty() {
            return [name + PADDING, 26.0];
        }
        [name.max(width(&self.kind, KIND)) + PADDING, 36.0]
    }

    fn words(&self) -> String {
        if self.kind.is_empty() { self.name.clone() } else { format!("{} ({})", self.name, self.kind) }
    }

    fn draw(&self, picture: &mut Picture, [x, y]: [f64; 2], [w, h]: [f64; 2]) {
        // Bodies have corners, joints are round.
        let radius = if self.kind.is_empty() { 3.0 } else { h / 2.0 };
        let [left, top, radius] = [x - w / 2.0, y - h / 2.0, radius].map(number);
        let [w, h] = [w, h].map(number);
        picture.add(&format!(
            "<rect class=\"node {}\" x=\"{left}\" y=\"{top}\" width=\"{w}\" height=\"{h}\" rx=\"{radius}\"/>",
            self.class
        ));
        if self.kind.is_empty() {
            picture.text("name", "middle", [x, y + 4.0], &self.name);
        } else {
            picture.text("name", "middle", [x, y - 2.0], &self.name);
            picture.text("kind", "middle", [x, y + 11.0], &self.kind);
        }
    }
}

/// A smooth line through points that leaves and arrives across the layers.
fn curve(points: &[[f64; 2]], downwards: bool) -> String {
    let mut path = String::new();
    for (k, &[x, y]) in points.iter().enumerate() {
        let [u, v] = [x, y].map(number);
        let Some(&[a, b]) = k.checked_sub(1).and_then(|before| points.get(before)) else {
            let _ = write!(path, "M{u} {v}");
            continue;
        };
        let [c, d, e, f] = if downwards {
            let half = (b + y) / 2.0;
            [a, half, x, half]
        } else {
            let half = (a + x) / 2.0;
            [half, b, half, y]
        };
        let [c, d, e, f] = [c, d, e, f].map(number);
        let _ = write!(path, " C{c} {d} {e} {f} {u} {v}");
    }
    path
}
