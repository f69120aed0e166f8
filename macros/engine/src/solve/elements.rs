//! Stage `solve`: what a group of neighbouring joints leaves fixed.
//!
//! In: the links of the group, from left to right. Out: [`Features`]: points, lines, planes and directions that have
//! known coordinates on both sides of the group whatever its joints do. Joints are merged by their geometry: parallel
//! axes keep a direction and move points in planes, axes through one point keep the point, sliding along an axis keeps
//! the line (Woernle 1988, Hiller and Woernle 1987: the characteristic pair of joints).

use crate::dynamics::tree::Motion;
use crate::invariant::fault::OrFault;
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::chain::{Kind, Link, Side, is_along, unit};

/// One vector in the coordinates of either side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    pub(super) left: Vector,
    pub(super) right: Vector,
}

/// A point with a direction: a line's point and axis, or a plane's point and normal.
pub(super) type Flat = (Seen, Seen);

/// What the two sides agree on.
#[derive(Clone, Debug, Default)]
pub(super) struct Features {
    pub(super) point: Option<Seen>,
    /// The point may move along the line.
    pub(super) lines: Vec<Flat>,
    /// The point may move in the plane.
    pub(super) planes: Vec<Flat>,
    pub(super) directions: Vec<Seen>,
}

/// How a group turns.
#[derive(Clone, Copy, Debug)]
enum Turning {
    /// Not at all: from right to left by this rotation.
    Fixed(Rotation),
    About(Seen),
    Free,
}

/// How a group moves its reference point.
#[derive(Clone, Copy, Debug)]
enum Shift {
    /// Without turning every point keeps its place, with turning about an axis those on it do.
    Nothing,
    Along(Seen),
    /// In the plane with this normal.
    Across(Seen),
    Any,
}

/// A group that grows to the right.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointGroup {
    turning: Turning,
    shift: Shift,
    reference: Seen,
}

impl JointGroup {
    /// No joint at all.
    pub(super) fn new() -> JointGroup {
        let reference = Seen { left: Vector::ZERO, right: Vector::ZERO };
        JointGroup { turning: Turning::Fixed(Rotation::IDENTITY), shift: Shift::Nothing, reference }
    }

    /// Whether nothing is left fixed.
    pub(super) fn is_useless(&self) -> bool {
        matches!((self.turning, self.shift), (Turning::Free, Shift::Any))
    }

    /// The point about which the group turns freely, and does nothing else.
    pub(super) fn centre(&self) -> Option<Seen> {
        matches!((self.turning, self.shift), (Turning::Free, Shift::Nothing)).then_some(self.reference)
    }

    /// Adds a link on the right.
    pub(super) fn append(&mut self, g: &mut Graph, link: Link) {
        match link {
            Link::Known { rotation, .. } => {
                let mut carry = |kind: Kind, v: Vector| {
                    link.carry(g, Side::Right, kind, v).or_fault("known links carry everything")
                };
                self.reference.right = carry(Kind::Point, self.reference.right);
                if let Turning::About(axis) = &mut self.turning {
                    axis.right = carry(Kind::Direction, axis.right);
                }
                if let Shift::Along(d) | Shift::Across(d) = &mut self.shift {
                    d.right = carry(Kind::Direction, d.right);
                }
                if let Turning::Fixed(turn) = &mut self.turning {
                    *turn = g.compose(*turn, rotation);
                }
            }
            Link::Free { motion, .. } => match motion {
                Motion::Prismatic(axis) => self.slide(g, axis),
                Motion::Revolute(axis) => self.turn(g, axis),
                Motion::Screw(axis, _) => {
                    self.turn(g, axis);
                    self.slide(g, axis);
                }
                Motion::Ball(_) => self.swivel(g),
            },
        }
    }

    fn slide(&mut self, g: &mut Graph, axis: usize) {
        let right = unit(g, axis);
        self.shift = match (self.turning, self.shift) {
            (Turning::Fixed(turn), Shift::Nothing) => Shift::Along(Seen { left: g.rotate(turn, right), right }),
            (Turning::Fixed(turn), Shift::Along(d)) => {
                let normal = g.cross(d.right, right);
                match normal {
                    Vector::ZERO => Shift::Along(d),
                    right => Shift::Across(Seen { left: g.rotate(turn, right), right }),
                }
            }
            (Turning::About(d), Shift::Nothing) if parallel(g, d.right, right) => Shift::Along(d),
            (Turning::About(d), Shift::Nothing) if g.dot(d.right, right) == Scalar::ZERO => Shift::Across(d),
            (Turning::About(_), Shift::Along(d)) if parallel(g, d.right, right) => Shift::Along(d),
            (Turning::Fixed(_) | Turning::About(_), Shift::Across(n)) if g.dot(n.right, right) == Scalar::ZERO => {
                Shift::Across(n)
            }
            _ => Shift::Any,
        };
    }

    fn turn(&mut self, g: &mut Graph, axis: usize) {
        let right = unit(g, axis);
        match self.turning {
            Turning::Fixed(turn) => {
                let d = Seen { left: g.rotate(turn, right), right };
                self.shift = match self.shift {
                    Shift::Along(t) if !parallel(g, t.right, right) => {
                        if g.dot(t.right, right) == Scalar::ZERO {
                            Shift::Across(d)
                        } else {
                            Shift::Any
                        }
                    }
                    Shift::Across(n) => {
                        if parallel(g, n.right, right) {
                            Shift::Across(d)
                        } else {
                            Shift::Any
                        }
                    }
                    other => other,
                };
                // The origin lies on the axis.
                let back = g.rotate(turn, self.reference.right);
                let left = g.sub_vectors(self.reference.left, back);
                self.reference = Seen { left, right: Vector::ZERO };
                self.turning = Turning::About(d);
            }
            Turning::About(d) if parallel(g, d.right, right) => {
                let coaxial = is_along(g, self.reference.right, axis);
                self.shift = match self.shift {
                    Shift::Nothing if !coaxial => Shift::Across(d),
                    Shift::Along(_) if !coaxial => Shift::Any,
                    other => other,
                };
            }
            Turning::About(d) => {
                match self.meet(g, d, right) {
                    Some(point) if matches!(self.shift, Shift::Nothing) => self.reference = point,
                    _ => self.shift = Shift::Any,
                }
                self.turning = Turning::Free;
            }
            Turning::Free => {
                if !is_along(g, self.reference.right, axis) {
                    self.shift = Shift::Any;
                }
            }
        }
    }

    /// Where this group's axis meets the one through the origin.
    fn meet(&self, g: &mut Graph, d: Seen, other: Vector) -> Option<Seen> {
        let normal = g.cross(d.right, other);
        if g.dot(self.reference.right, normal) != Scalar::ZERO {
            return None;
        }
        // p + a d = b e, hence a = ((e x p) . n) / n^2 with n = d x e.
        let lever = g.cross(other, self.reference.right);
        let a = match g.dot(lever, normal) {
            Scalar::ZERO => Scalar::ZERO,
            top => {
                let square = g.dot(normal, normal);
                g.div(top, square)
            }
        };
        Some(self.along(g, d, a))
    }

    /// The reference point, moved along the axis.
    fn along(&self, g: &mut Graph, d: Seen, length: Scalar) -> Seen {
        let [left, right] = [(self.reference.left, d.left), (self.reference.right, d.right)].map(|(p, d)| {
            let step = g.scale(length, d);
            g.add_vectors(p, step)
        });
        Seen { left, right }
    }

    fn swivel(&mut self, g: &mut Graph) {
        let Shift::Nothing = self.shift else {
            (self.turning, self.shift) = (Turning::Free, Shift::Any);
            return;
        };
        match self.turning {
            Turning::Fixed(turn) => {
                let back = g.rotate(turn, self.reference.right);
                let left = g.sub_vectors(self.reference.left, back);
                self.reference = Seen { left, right: Vector::ZERO };
            }
            Turning::About(d) if parallel(g, d.right, self.reference.right) => {
                let a = g.dot(d.right, self.reference.right);
                self.reference = self.along(g, d, -a);
            }
            Turning::Free if self.reference.right == Vector::ZERO => {}
            _ => self.shift = Shift::Any,
        }
        self.turning = Turning::Free;
    }

    /// What the group leaves fixed.
    pub(super) fn features(&self, g: &mut Graph) -> Features {
        let mut features = Features::default();
        let p = self.reference;
        match self.turning {
            Turning::Fixed(turn) => {
                let axes = [0, 1, 2].map(|axis| {
                    let right = unit(g, axis);
                    Seen { left: g.rotate(turn, right), right }
                });
                features.directions = axes.to_vec();
                match self.shift {
                    Shift::Nothing => {
                        features.point = Some(p);
                        features.lines = axes.map(|d| (p, d)).to_vec();
                        features.planes = axes.map(|d| (p, d)).to_vec();
                    }
                    Shift::Along(d) => {
                        features.lines = vec![(p, d)];
                        for axis in axes {
                            let right = if g.dot(axis.right, d.right) == Scalar::ZERO {
                                axis.right
                            } else {
                                g.cross(axis.right, d.right)
                            };
                            if right != Vector::ZERO {
                                features.planes.push((p, Seen { left: g.rotate(turn, right), right }));
                            }
                        }
                    }
                    Shift::Across(n) => features.planes = vec![(p, n)],
                    Shift::Any => {}
                }
            }
            Turning::About(d) => {
                features.directions = vec![d];
                match self.shift {
                    Shift::Nothing => {
                        features.point = Some(p);
                        features.lines = vec![(p, d)];
                        features.planes = vec![(p, d)];
                    }
                    Shift::Along(_) => features.lines = vec![(p, d)],
                    Shift::Across(_) => features.planes = vec![(p, d)],
                    Shift::Any => {}
                }
            }
            Turning::Free => {
                if matches!(self.shift, Shift::Nothing) {
                    features.point = Some(p);
                }
            }
        }
        features
    }
}

/// Whether two vectors have one direction, or opposite ones.
pub(super) fn parallel(g: &mut Graph, a: Vector, b: Vector) -> bool {
    g.cross(a, b) == Vector::ZERO
}
