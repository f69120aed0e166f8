//! Serial arms of the reference data as trees on a graph.

use std::path::PathBuf;

use multibody_engine::dynamics::inertia::Inertia;
use multibody_engine::dynamics::tree::{Link, Motion, Tree};
use multibody_engine::symbolic::graph::{Graph, Scalar};
use serde_json::Value;

pub(crate) const ARMS: [&str; 4] = ["double_pendulum", "cart5", "puma560", "panda"];

/// Symbols stand in the order positions, velocities, accelerations, efforts.
pub(crate) struct Arm {
    pub(crate) graph: Graph,
    pub(crate) tree: Tree,
    pub(crate) efforts: Vec<Scalar>,
}

/// `NAME.model.json` or `NAME.samples.json` of the workspace's test data.
pub(crate) fn read(name: &str, kind: &str) -> Value {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../../tests/data/robots/{name}.{kind}.json"));
    let text = std::fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    serde_json::from_str(&text).unwrap()
}

/// All numbers of nested lists, row by row.
pub(crate) fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().unwrap()],
    }
}

pub(crate) fn load(name: &str) -> Arm {
    let model = read(name, "model");
    let joints = model["joints"].as_array().unwrap();
    let n = joints.len();
    let mut g = Graph::new();
    let mut symbols = || -> Vec<Scalar> { (0..n).map(|_| g.symbol()).collect() };
    let (q, velocity, acceleration, efforts) = (symbols(), symbols(), symbols(), symbols());
    let mut tree = Tree { velocity, acceleration, ..Tree::default() };
    tree.gravity = Some(vector(&mut g, &model["gravity"]));
    for (i, joint) in joints.iter().enumerate() {
        let rows = [0, 1, 2].map(|k| vector(&mut g, &joint["placement"]["R"][k]));
        let offset = vector(&mut g, &joint["placement"]["p"]);
        let kind = joint["type"].as_str().unwrap().as_bytes();
        let axis = usize::from(kind[1] - b'X');
        tree.links.push(Link {
            name: joint["name"].as_str().unwrap().into(),
            parent: usize::try_from(joint["parent"].as_i64().unwrap()).ok(),
            rotation: g.matrix_rotation(rows),
            offset: g.vector(offset),
            motion: if kind[0] == b'R' { Motion::Revolute(axis) } else { Motion::Prismatic(axis) },
            freedom: i,
            q: q[i],
            inertia: inertia(&mut g, joint),
            armature: Scalar::ZERO,
        });
    }
    Arm { graph: g, tree, efforts }
}

fn inertia(g: &mut Graph, joint: &Value) -> Inertia {
    let mass = g.decimal(joint["mass"].as_f64().unwrap());
    let com = vector(g, &joint["com"]);
    let tensor = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
        .map(|(a, b)| g.decimal(joint["inertia_com"][a][b].as_f64().unwrap()));
    Inertia::from_tensor(g, mass, com, tensor)
}

fn vector(g: &mut Graph, list: &Value) -> [Scalar; 3] {
    [0, 1, 2].map(|k| g.decimal(list[k].as_f64().unwrap()))
}
