//! Stage `dynamics`: velocities and accelerations of the links, from the ground outwards.
//!
//! In: a tree, velocities, accelerations. Out: per link, in its own axes: angular velocity and acceleration, and the
//! acceleration of its origin. The acceleration of a body-fixed point r is a + U r with U = [dw x] + [w x][w x]; its
//! entries (Khalil and Kleinfinger 1987) serve the joints beyond, the force and the moment of the link.

use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::tree::{Motion, Tree};

/// Motion of one link, in its own axes at its origin.
#[derive(Clone, Copy, Debug)]
pub struct LinkMotion {
    /// rad/s
    pub angular: Vector,
    /// rad/s^2
    pub angular_rate: Vector,
    /// m/s^2; carries minus gravity if the base was given it.
    pub linear_rate: Vector,
}

impl LinkMotion {
    pub const REST: LinkMotion =
        LinkMotion { angular: Vector::ZERO, angular_rate: Vector::ZERO, linear_rate: Vector::ZERO };
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// U = [dw x] + [w x][w x], entry by entry.
pub struct Field {
    w: [Scalar; 3],
    dw: [Scalar; 3],
    /// The link's, for names such as `u_elbow_xy`.
    name: String,
}

impl Field {
    pub fn new(g: &mut Graph, motion: &LinkMotion, name: &str) -> Field {
        Field { w: g.components(motion.angular), dw: g.components(motion.angular_rate), name: name.to_owned() }
    }

    /// dw_k
    pub fn angular_rate(&self, k: usize) -> Scalar {
        self.dw[k]
    }

    /// U_ij
    pub fn entry(&self, g: &mut Graph, i: usize, j: usize) -> Scalar {
        let entry = if i == j {
            let squares = [(i + 1) % 3, (i + 2) % 3].map(|k| self.square(g, k));
            -g.sum(&squares)
        } else {
            let both = g.mul(self.w[i], self.w[j]);
            let turn = self.dw[3 - i - j];
            // [dw x]_ij is -dw_k for (i, j, k) in cyclic order.
            if (i + 1) % 3 == j { g.sub(both, turn) } else { g.add(both, turn) }
        };
        g.name(entry, || format!("u_{}_{}{}", self.name, AXES[i], AXES[j]))
    }

    fn square(&self, g: &mut Graph, k: usize) -> Scalar {
        let square = g.mul(self.w[k], self.w[k]);
        g.name(square, || format!("w2_{}_{}", self.name, AXES[k]))
    }

    /// U_ii - U_jj = w_i^2 - w_j^2
    pub fn difference(&self, g: &mut Graph, i: usize, j: usize) -> Scalar {
        let (a, b) = (self.square(g, i), self.square(g, j));
        if broken(Break::CentrifugalSign) { g.sub(b, a) } else { g.sub(a, b) }
    }

    /// U r
    pub fn apply(&self, g: &mut Graph, r: [Scalar; 3]) -> Vector {
        let components = [0, 1, 2].map(|i| {
            let terms = [0, 1, 2].map(|j| {
                if r[j] == Scalar::ZERO {
                    return Scalar::ZERO;
                }
                let u = self.entry(g, i, j);
                g.mul(u, r[j])
            });
            g.sum(&terms)
        });
        g.vector(components)
    }
}

/// Motions of all links. `base` is minus gravity where forces are wanted, zero for true accelerations.
pub fn motions(
    g: &mut Graph,
    tree: &Tree,
    velocity: &[Scalar],
    acceleration: &[Scalar],
    base: Vector,
) -> Vec<LinkMotion> {
    let mut motions: Vec<LinkMotion> = Vec::with_capacity(tree.links.len());
    for link in &tree.links {
        let parent = match link.parent {
            Some(p) => motions[p],
            None => LinkMotion { linear_rate: base, ..LinkMotion::REST },
        };
        let before = g.begin(Some(format!("Motion of {}.", link.name).into()));
        let origin = tree.origin(g, link);
        let above = link.parent.map_or("ground", |p| &tree.links[p].name);
        let field = Field::new(g, &parent, above);
        let r = g.components(origin);
        let carried = field.apply(g, r);
        let at_joint = g.add_vectors(parent.linear_rate, carried);
        let linear = tree.to_link(g, link, at_joint);
        let (w, v) = tree.joint_motion(g, link, velocity);
        let (dw, dv) = tree.joint_motion(g, link, acceleration);
        let carried_w = tree.to_link(g, link, parent.angular);
        let carried_dw = tree.to_link(g, link, parent.angular_rate);
        let gyro = g.cross(carried_w, w);
        let angular = g.add_vectors(carried_w, w);
        // Where the joint travels: Coriolis' 2 w x v.
        let coriolis = match link.motion {
            Motion::Prismatic(_) | Motion::Screw(..) => {
                let turn = g.cross(carried_w, v);
                g.add_vectors(turn, turn)
            }
            Motion::Revolute(_) | Motion::Ball(_) => Vector::ZERO,
        };
        let name = &link.name;
        motions.push(LinkMotion {
            angular: g.name_vector(angular, || format!("w_{name}")),
            angular_rate: {
                let sum = g.sum_vectors(&[carried_dw, gyro, dw]);
                g.name_vector(sum, || format!("dw_{name}"))
            },
            linear_rate: {
                let sum = g.sum_vectors(&[linear, dv, coriolis]);
                g.name_vector(sum, || format!("a_{name}"))
            },
        });
        g.begin(before);
    }
    motions
}
