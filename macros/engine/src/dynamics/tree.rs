//! Stage `dynamics`: the kinematic tree that all recursions walk.
//!
//! In: links. Out: a [`Tree`] of links, parents before children. Every joint of the language is
//! a chain of four primitive motions, with massless links between: a revolute or prismatic motion along a coordinate
//! axis, a screw, and a ball. A link's frame stands at its joint, moves with the link and is oriented so
//! that the motion's axis is a coordinate axis.

use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::inertia::Inertia;

/// How a link moves against its parent. The axis is a coordinate axis of both frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    Revolute(usize),
    Prismatic(usize),
    /// Axis, and metres per radian.
    Screw(usize, Scalar),
    /// Velocity is the angular velocity in the link's axes.
    Ball(Orientation),
}

/// How a ball is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// A unit quaternion w, i, j, k.
    Quaternion([Scalar; 4]),
    /// From the link's axes to those of the frame that the joint stands in.
    Turn(Rotation),
}

impl Orientation {
    pub fn rotation(self, g: &mut Graph) -> Rotation {
        match self {
            Orientation::Quaternion(quaternion) => g.quaternion_rotation(quaternion),
            Orientation::Turn(rotation) => rotation,
        }
    }
}

impl Motion {
    pub fn freedoms(self) -> usize {
        if matches!(self, Motion::Ball(_)) { 3 } else { 1 }
    }

    /// The coordinate axis that it turns about or slides along.
    pub fn axis(self) -> Option<usize> {
        match self {
            Motion::Revolute(axis) | Motion::Prismatic(axis) | Motion::Screw(axis, _) => Some(axis),
            Motion::Ball(_) => None,
        }
    }
}

/// One moving frame with what is fixed to it.
#[derive(Clone, Debug)]
pub struct Link {
    pub name: String,
    /// `None`: the ground.
    pub parent: Option<usize>,
    /// The joint frame in the parent's link frame; constant.
    pub rotation: Rotation,
    /// m, in the parent's axes; constant.
    pub offset: Vector,
    pub motion: Motion,
    /// Position in the vector of velocity coordinates of the first freedom.
    pub freedom: usize,
    /// The coordinate of a motion that has one.
    pub q: Scalar,
    pub inertia: Inertia,
    /// Added to the diagonal of the mass matrix.
    pub armature: Scalar,
}

impl Link {
    /// How far it has turned against the frame that its joint stands in.
    pub fn turn(&self, g: &mut Graph) -> Rotation {
        match self.motion {
            Motion::Revolute(axis) | Motion::Screw(axis, _) => g.axis_rotation(axis, self.q),
            Motion::Prismatic(_) => Rotation::IDENTITY,
            Motion::Ball(orientation) => orientation.rotation(g),
        }
    }

    /// How far it has moved along its axis, in the axes of the frame that its joint stands in.
    pub fn travel(&self, g: &mut Graph) -> Vector {
        match self.motion {
            Motion::Prismatic(axis) => g.along(axis, self.q),
            Motion::Screw(axis, pitch) => {
                let length = g.mul(pitch, self.q);
                g.along(axis, length)
            }
            Motion::Revolute(_) | Motion::Ball(_) => Vector::ZERO,
        }
    }
}

/// The mechanism as recursions see it.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    pub links: Vec<Link>,
    /// Velocity and acceleration symbols in the order of the generated structs.
    pub velocity: Vec<Scalar>,
    pub acceleration: Vec<Scalar>,
    /// In world axes, m/s^2.
    pub gravity: Option<[Scalar; 3]>,
    /// What is fixed to the ground: it only counts in the potential energy.
    pub ground: Option<Inertia>,
    /// Columns of U that neighbours have in common are turned from link to link ([`super::kinematics`]), and columns of the mass
    /// matrix are taken about points that stand still ([`super::composite`]).
    pub turns_columns: bool,
}

impl Tree {
    pub fn freedoms(&self) -> usize {
        self.velocity.len()
    }

    /// Links from this one to the ground, this one first. The ground, `None`, has none.
    pub fn support(&self, link: Option<usize>) -> impl Iterator<Item = usize> {
        std::iter::successors(link, |&index| self.links[index].parent)
    }

    /// Links beyond a carrier on the way out to another, in this order; empty where they are one.
    pub fn path(&self, carrier: Option<usize>, link: Option<usize>) -> Vec<usize> {
        let mut path: Vec<usize> = self.support(link).take_while(|&index| Some(index) != carrier).collect();
        path.reverse();
        path
    }

    /// The outermost link that carries both.
    pub fn common(&self, mut a: Option<usize>, mut b: Option<usize>) -> Option<usize> {
        // Parents stand before children, so the later of two different links is never the common one.
        while a != b {
            let later = if a > b { &mut a } else { &mut b };
            *later = later.and_then(|index| self.links[index].parent);
        }
        a
    }

    /// Rotation from the link's to its parent's axes.
    pub fn rotation(&self, g: &mut Graph, link: &Link) -> Rotation {
        let turn = link.turn(g);
        g.compose(link.rotation, turn)
    }

    /// The same in two steps, so that vectors pass the constant placement and the motion one after the other.
    pub fn to_parent(&self, g: &mut Graph, link: &Link, v: Vector) -> Vector {
        let turn = link.turn(g);
        let turned = g.rotate(turn, v);
        g.rotate(link.rotation, turned)
    }

    /// Components in the link's axes of a vector given in the parent's.
    pub fn to_link(&self, g: &mut Graph, link: &Link, v: Vector) -> Vector {
        let placed = g.rotate(link.rotation.transpose(), v);
        let turn = link.turn(g);
        g.rotate(turn.transpose(), placed)
    }

    /// The link's origin in its parent's frame.
    pub fn origin(&self, g: &mut Graph, link: &Link) -> Vector {
        let along = link.travel(g);
        let travel = g.rotate(link.rotation, along);
        g.add_vectors(link.offset, travel)
    }

    /// Angular and linear part of the unit twists of a link's freedoms, in link axes.
    pub fn twists(&self, link: &Link) -> Vec<(usize, [Scalar; 6])> {
        let unit = |k: usize| {
            let mut twist = [Scalar::ZERO; 6];
            twist[k] = Scalar::ONE;
            twist
        };
        match link.motion {
            Motion::Revolute(axis) => vec![(link.freedom, unit(axis))],
            Motion::Prismatic(axis) => vec![(link.freedom, unit(axis + 3))],
            Motion::Screw(axis, pitch) => {
                let mut twist = unit(axis);
                twist[axis + 3] = pitch;
                vec![(link.freedom, twist)]
            }
            Motion::Ball(_) => (0..3).map(|k| (link.freedom + k, unit(k))).collect(),
        }
    }

    /// Sum of a link's unit twists times the given coordinates (velocities or accelerations): angular, linear.
    pub fn joint_motion(&self, g: &mut Graph, link: &Link, coordinates: &[Scalar]) -> (Vector, Vector) {
        let x = coordinates[link.freedom];
        match link.motion {
            Motion::Revolute(axis) => (g.along(axis, x), Vector::ZERO),
            Motion::Prismatic(axis) => (Vector::ZERO, g.along(axis, x)),
            Motion::Screw(axis, pitch) => {
                let travel = g.mul(pitch, x);
                (g.along(axis, x), g.along(axis, travel))
            }
            Motion::Ball(_) => {
                let w = [0, 1, 2].map(|k| coordinates[link.freedom + k]);
                (g.vector(w), Vector::ZERO)
            }
        }
    }

    /// Efforts on a link's freedoms from the moment and force at its origin, in link axes.
    pub fn project(&self, g: &mut Graph, link: &Link, moment: Vector, force: Vector) -> Vec<(usize, Scalar)> {
        match link.motion {
            Motion::Revolute(axis) => vec![(link.freedom, g.component(moment, axis))],
            Motion::Prismatic(axis) => vec![(link.freedom, g.component(force, axis))],
            Motion::Screw(axis, pitch) => {
                let along = g.component(force, axis);
                let push = g.mul(pitch, along);
                let turn = g.component(moment, axis);
                vec![(link.freedom, g.add(turn, push))]
            }
            Motion::Ball(_) => (0..3).map(|k| (link.freedom + k, g.component(moment, k))).collect(),
        }
    }

    /// Whether the origin of a link moves: a force on one that doesn't takes no effort.
    pub(super) fn moves(&self, g: &mut Graph, index: usize) -> bool {
        let support: Vec<usize> = self.support(Some(index)).collect();
        let on_hinges = support.iter().all(|&at| matches!(self.links[at].motion, Motion::Revolute(_)));
        let still = support.iter().all(|&at| {
            let Some(parent) = self.links[at].parent else { return true };
            let offset = g.components(self.links[at].offset);
            // What stands on the axis of the first hinge stands still as well.
            let axis = self.links[parent].motion.axis().filter(|_| self.links[parent].parent.is_none());
            (0..3).all(|k| offset[k] == Scalar::ZERO || Some(k) == axis)
        });
        !(on_hinges && still)
    }
}
