//! Stage `dynamics`: velocities and accelerations of the links in world axes, from the ground outwards.
//!
//! In: the tree, accelerations where they are asked for. Out: per link angular velocity and acceleration, velocity and
//! acceleration of the origin. They share the columns of [`super::columns`]; for planar chains they are plain sums.

use std::rc::Rc;

use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::columns::Columns;
use super::tree::{Link, Motion, Tree};

/// In world axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WorldMotion {
    pub angular: Vector,
    pub linear: Vector,
    pub angular_rate: Vector,
    pub linear_rate: Vector,
}

impl WorldMotion {
    const REST: WorldMotion = WorldMotion {
        angular: Vector::ZERO,
        linear: Vector::ZERO,
        angular_rate: Vector::ZERO,
        linear_rate: Vector::ZERO,
    };
}

/// Motion of one link; without accelerations their rates are left at zero.
pub(crate) fn motion(
    g: &mut Graph,
    tree: &Tree,
    columns: &mut Columns,
    link: Option<usize>,
    acceleration: Option<&Rc<[Scalar]>>,
) -> WorldMotion {
    let mut motion = WorldMotion::REST;
    for index in tree.path(None, link) {
        motion = outwards(g, tree, columns, index, motion, acceleration.map(|list| &list[..]));
    }
    motion
}

fn outwards(
    g: &mut Graph,
    tree: &Tree,
    columns: &mut Columns,
    index: usize,
    parent: WorldMotion,
    acceleration: Option<&[Scalar]>,
) -> WorldMotion {
    let link = &tree.links[index];
    let (from, to) = (columns.origin(g, tree, link.parent), columns.origin(g, tree, Some(index)));
    let d = g.sub_vectors(to, from);
    let (turn, travel) = joint_rates(g, tree, columns, index, &tree.velocity);
    let swing = g.cross(parent.angular, d);
    let mut motion = WorldMotion {
        angular: g.add_vectors(parent.angular, turn),
        linear: g.sum_vectors(&[parent.linear, swing, travel]),
        ..WorldMotion::REST
    };
    let name = &link.name;
    g.name_vector(motion.angular, || format!("w_{name}_world"));
    g.name_vector(motion.linear, || format!("v_{name}_world"));
    if let Some(acceleration) = acceleration {
        let (turn_rate, travel_rate) = joint_rates(g, tree, columns, index, acceleration);
        let gyro = g.cross(parent.angular, turn);
        motion.angular_rate = g.sum_vectors(&[parent.angular_rate, gyro, turn_rate]);
        let tangential = g.cross(parent.angular_rate, d);
        let centripetal = g.cross(parent.angular, swing);
        let coriolis = if moves(link) { g.cross(parent.angular, travel) } else { Vector::ZERO };
        let terms = [parent.linear_rate, tangential, centripetal, coriolis, coriolis, travel_rate];
        motion.linear_rate = g.sum_vectors(&terms);
        g.name_vector(motion.angular_rate, || format!("dw_{name}_world"));
        g.name_vector(motion.linear_rate, || format!("a_{name}_world"));
    }
    motion
}

fn moves(link: &Link) -> bool {
    matches!(link.motion, Motion::Prismatic(_) | Motion::Screw(..))
}

/// Angular and linear rates of a joint.
fn joint_rates(g: &mut Graph, tree: &Tree, columns: &mut Columns, index: usize, rates: &[Scalar]) -> (Vector, Vector) {
    let (turn, travel) = tree.joint_motion(g, &tree.links[index], rates);
    (columns.rotate(g, tree, Some(index), turn), columns.rotate(g, tree, Some(index), travel))
}
