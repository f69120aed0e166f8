//! Stage `dynamics`: velocities and accelerations of the links, from the ground outwards.
//!
//! In: a tree, velocities, accelerations. Out: per link, in its own axes: angular velocity and acceleration, and the
//! acceleration of its origin. The acceleration of a body-fixed point r is a + U r with U = [dw x] + [w x][w x]; its
//! entries (Khalil and Kleinfinger 1987) serve the joints beyond, the force and the moment of the link.
//!
//! A hinge does not change the column of U along its own axis: U s = dw x s + w x (w x s) is what the carrier and the link have
//! in common there, whatever the rate and the acceleration of the hinge. Turned into the link's axes (four products, two
//! sums) it gives two entries of U, the third is the same number in both, and the angular acceleration follows as dw_j = U_ih - w_i w_h,
//! without the products of the hinge's rate that w x (rate s) takes. The entries across are then 2 w_i w_h - U_ih. Links without
//! inertia need no entries of U, and pass dw on as ever.

use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::tree::{Link, Motion, Tree};

/// Motion of one link, in its own axes at its origin.
#[derive(Clone, Copy, Debug)]
pub struct LinkMotion {
    /// rad/s
    pub angular: Vector,
    /// rad/s^2
    pub angular_rate: Vector,
    /// m/s^2; carries minus gravity if the base was given it.
    pub linear_rate: Vector,
    pub kept: Option<KeptColumn>,
}

/// Which column of U a link has in common with its carrier, by axes of the link.
#[derive(Clone, Copy, Debug)]
pub struct KeptColumn {
    /// That of its hinge.
    hinge: usize,
    /// The one along which the next hinge lies: its column is made of the others.
    next: usize,
}

impl LinkMotion {
    pub const REST: LinkMotion =
        LinkMotion { angular: Vector::ZERO, angular_rate: Vector::ZERO, linear_rate: Vector::ZERO, kept: None };
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// U = [dw x] + [w x][w x], entry by entry.
pub struct Field {
    w: [Scalar; 3],
    dw: [Scalar; 3],
    kept: Option<KeptColumn>,
    /// The link's, for names such as `u_elbow_xy`.
    name: String,
}

impl Field {
    pub fn new(g: &mut Graph, motion: &LinkMotion, name: &str) -> Field {
        let (w, dw) = (g.components(motion.angular), g.components(motion.angular_rate));
        Field { w, dw, kept: motion.kept, name: name.to_owned() }
    }

    /// dw_k
    pub fn angular_rate(&self, k: usize) -> Scalar {
        self.dw[k]
    }

    /// w_i w_j
    pub fn product(&self, g: &mut Graph, i: usize, j: usize) -> Scalar {
        g.mul(self.w[i], self.w[j])
    }

    /// U_ij
    pub fn entry(&self, g: &mut Graph, i: usize, j: usize) -> Scalar {
        let entry = if i == j {
            match self.kept {
                Some(KeptColumn { hinge, next }) if i != hinge && i != next => {
                    let along = self.entry(g, hinge, hinge);
                    let step = self.difference(g, i, hinge);
                    g.add(along, step)
                }
                _ => {
                    let squares = [(i + 1) % 3, (i + 2) % 3].map(|k| self.square(g, k));
                    -g.sum(&squares)
                }
            }
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

    /// U_ii - U_jj = w_i^2 - w_j^2. Where one entry of the diagonal is known two squares serve all: that along the next hinge is
    /// made of them, for the link beyond to know.
    pub fn difference(&self, g: &mut Graph, i: usize, j: usize) -> Scalar {
        if let Some(KeptColumn { hinge, next }) = self.kept
            && (i == next || j == next)
        {
            let other = 3 - hinge - next;
            if i == hinge || j == hinge {
                let (a, b) = (self.entry(g, i, i), self.entry(g, j, j));
                return g.sub(a, b);
            }
            let (a, b) = (self.difference(g, other, hinge), self.difference(g, hinge, next));
            let difference = g.add(a, b);
            return if i == next { -difference } else { difference };
        }
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
    for (index, link) in tree.links.iter().enumerate() {
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
        let angular = g.add_vectors(carried_w, w);
        let along = along_hinge(g, tree, link);
        let angular_rate = match along {
            Some((hinge, there)) => {
                let column = field.apply(g, there);
                let column = tree.to_link(g, link, column);
                let [column, w, carried, own] = [column, angular, carried_dw, dw].map(|vector| g.components(vector));
                let (i, j) = ((hinge + 1) % 3, (hinge + 2) % 3);
                let [products_i, products_j] = [i, j].map(|k| g.mul(w[k], w[hinge]));
                let mut rate = [Scalar::ZERO; 3];
                rate[hinge] = g.add(carried[hinge], own[hinge]);
                rate[i] = g.sub(products_j, column[j]);
                rate[j] = g.sub(column[i], products_i);
                g.vector(rate)
            }
            None => {
                let gyro = g.cross(carried_w, w);
                g.sum_vectors(&[carried_dw, gyro, dw])
            }
        };
        // Where the joint travels: Coriolis' 2 w x v.
        let coriolis = match link.motion {
            Motion::Prismatic(_) | Motion::Screw(..) => {
                let turn = g.cross(carried_w, v);
                g.add_vectors(turn, turn)
            }
            Motion::Revolute(_) | Motion::Ball(_) => Vector::ZERO,
        };
        let name = &link.name;
        let kept = along.map(|(hinge, _)| {
            let next = next_hinge(g, tree, index).filter(|&next| next != hinge);
            KeptColumn { hinge, next: next.unwrap_or((hinge + 2) % 3) }
        });
        motions.push(LinkMotion {
            angular: g.name_vector(angular, || format!("w_{name}")),
            angular_rate: g.name_vector(angular_rate, || format!("dw_{name}")),
            linear_rate: {
                let sum = g.sum_vectors(&[linear, dv, coriolis]);
                g.name_vector(sum, || format!("a_{name}"))
            },
            kept,
        });
        g.begin(before);
    }
    motions
}

/// A hinge along a coordinate axis of what carries it: its axis in the link, and there. Both have inertia: else U is of no other
/// use, and its column would cost more than it saves.
fn along_hinge(g: &mut Graph, tree: &Tree, link: &Link) -> Option<(usize, [Scalar; 3])> {
    let Motion::Revolute(hinge) = link.motion else { return None };
    if !tree.turns_columns || link.inertia.is_zero() || tree.links[link.parent?].inertia.is_zero() {
        return None;
    }
    let unit = g.along(hinge, Scalar::ONE);
    let there = g.rotate(link.rotation, unit);
    let there = g.components(there);
    unit_axis(&there).map(|_| (hinge, there))
}

/// The coordinate axis that a unit vector lies along, if it does.
fn unit_axis(unit: &[Scalar; 3]) -> Option<usize> {
    unit.iter().position(|component| component.positive() == Scalar::ONE)
}

/// The axis of a link along which a hinge lies that it carries.
fn next_hinge(g: &mut Graph, tree: &Tree, index: usize) -> Option<usize> {
    let mut carried = tree.links.iter().filter(|link| link.parent == Some(index));
    let (_, there) = carried.find_map(|link| along_hinge(g, tree, link))?;
    unit_axis(&there)
}
