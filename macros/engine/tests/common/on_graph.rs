//! A random mechanism as a tree on a graph of its own.

use multibody_engine::dynamics::inertia::Inertia;
use multibody_engine::dynamics::tree::{Link, Motion, Orientation, Tree};
use multibody_engine::symbolic::graph::{Graph, Scalar};
use multibody_engine::symbolic::number::Number;

use super::random::{Body, Kind, Mechanism, State, fractions};

/// Symbols stand in the order positions, velocities, accelerations, efforts.
pub(crate) struct Derived {
    pub(crate) graph: Graph,
    pub(crate) tree: Tree,
    pub(crate) efforts: Vec<Scalar>,
}

pub(crate) fn derive(mechanism: &Mechanism) -> Derived {
    let mut g = Graph::new();
    let motions: Vec<(Motion, Scalar)> = mechanism.bodies.iter().map(|body| motion(&mut g, body)).collect();
    let mut symbols = || -> Vec<Scalar> { (0..mechanism.freedoms()).map(|_| g.symbol()).collect() };
    let (velocity, acceleration, efforts) = (symbols(), symbols(), symbols());
    let gravity = (mechanism.gravity != [0.0; 3]).then(|| mechanism.gravity.map(|x| g.decimal(x)));
    let mut tree = Tree { velocity, acceleration, gravity, ..Tree::default() };
    let mut freedom = 0;
    for (index, (body, (motion, q))) in mechanism.bodies.iter().zip(motions).enumerate() {
        let (rows, denominator) = fractions(body.placement);
        let rows = rows.map(|row| row.map(|n| g.number(Number::integer(n) / Number::integer(denominator))));
        let rotation = g.matrix_rotation(rows);
        let offset = body.offset.map(|x| g.decimal(x));
        let (mass, com) = (g.decimal(body.mass), body.com.map(|x| g.decimal(x)));
        let tensor = body.tensor.map(|x| g.decimal(x));
        tree.links.push(Link {
            name: format!("b{index}"),
            parent: body.parent,
            rotation,
            offset: g.vector(offset),
            motion,
            freedom,
            q,
            inertia: Inertia::from_tensor(&mut g, mass, com, tensor),
            armature: g.decimal(body.armature),
        });
        freedom += body.kind.freedoms();
    }
    Derived { graph: g, tree, efforts }
}

/// The motion and its coordinate, if it has only one.
fn motion(g: &mut Graph, body: &Body) -> (Motion, Scalar) {
    match body.kind {
        Kind::Revolute(axis) => (Motion::Revolute(axis), g.symbol()),
        Kind::Prismatic(axis) => (Motion::Prismatic(axis), g.symbol()),
        Kind::Screw(axis, pitch) => {
            let pitch = g.decimal(pitch);
            (Motion::Screw(axis, pitch), g.symbol())
        }
        Kind::Ball => (Motion::Ball(Orientation::Quaternion(g.unit_quaternion())), Scalar::ZERO),
    }
}

/// Values of the symbols.
pub(crate) fn point(state: &State) -> Vec<f64> {
    [&state.q[..], &state.v, &state.a, &state.effort].concat()
}
