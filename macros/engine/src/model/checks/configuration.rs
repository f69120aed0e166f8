//! Stage `model`: the mechanism in numbers, at the declared defaults and a random configuration.
//!
//! In: bodies, joints, the tree. Out: per joint the inertia beyond it and its motion axes, in the joint's child frame.

use crate::model::checker::Checker;
use crate::model::types::{Body, BodyRef, Frame, FrameStep, Joint, JointId, JointKind, Orientation};

use super::evaluate::{cross, dot};
use super::matrix3::{IDENTITY, Matrix3, Vector3, add, product, rotation, scale, sub, times, transpose, unit};
use super::spatial::{Matrix6, Vector6, inertia, join};

/// Orientation (columns are the axes) and origin of a frame.
#[derive(Clone, Copy)]
struct Pose {
    rotation: Matrix3,
    position: Vector3,
}

impl Pose {
    const IDENTITY: Pose = Pose { rotation: IDENTITY, position: [0.0; 3] };

    fn then(&self, next: &Pose) -> Pose {
        Pose {
            rotation: product(&self.rotation, &next.rotation),
            position: add(self.position, times(&self.rotation, next.position)),
        }
    }

    fn inverse(&self) -> Pose {
        let rotation = transpose(self.rotation);
        Pose { rotation, position: scale(-1.0, times(&rotation, self.position)) }
    }
}

/// One joint of the tree with the body that it carries.
pub(super) struct Link {
    /// Position in the tree of the joint that carries the parent body.
    pub(in crate::model) parent: Option<usize>,
    /// Of the body, in the joint's child frame.
    pub(in crate::model) inertia: Matrix6,
    pub(in crate::model) armature: f64,
    /// The joint's parent frame, seen from the child frame of the joint before.
    mount: Pose,
    kind: Kind,
}

/// Joint kinds with their numbers; axes are unit vectors.
enum Kind {
    Fixed,
    /// Axis, and metres per radian.
    Turn(Vector3, f64),
    Slide(Vector3),
    Cylindrical(Vector3),
    Universal(Vector3, Vector3),
    Planar(Vector3),
    Ball(Orientation),
    Free(Orientation),
}

/// A joint somewhere: from its child frame to the child frame of the joint before, and its axes in the child frame.
pub(super) struct Motion {
    pub(in crate::model) rotation: Matrix3,
    pub(in crate::model) position: Vector3,
    pub(in crate::model) axes: Vec<Vector6>,
}

pub(super) struct Configuration {
    pub(in crate::model) joints: Vec<Motion>,
}

impl Configuration {
    /// The same `trial` gives the same configuration, always.
    pub(in crate::model) fn random(links: &[Link], trial: u64) -> Configuration {
        let mut random = Random(0x9e37_79b9_7f4a_7c15 ^ (trial + 1).wrapping_mul(0xd1b5_4a32_d192_ed03));
        let joints = links.iter().map(|link| {
            let (pose, axes) = link.kind.moved(&mut random);
            let pose = link.mount.then(&pose);
            Motion { rotation: pose.rotation, position: pose.position, axes }
        });
        Configuration { joints: joints.collect() }
    }
}

impl Kind {
    /// Where the joint goes, and its axes in the child's frame.
    fn moved(&self, random: &mut Random) -> (Pose, Vec<Vector6>) {
        let zero = [0.0; 3];
        let turned = |rotation| Pose { rotation, position: zero };
        match self {
            Kind::Fixed => (Pose::IDENTITY, Vec::new()),
            Kind::Turn(axis, pitch) => {
                let angle = random.next();
                let pose = Pose { rotation: rotation(*axis, angle), position: scale(angle * pitch, *axis) };
                (pose, vec![join(*axis, scale(*pitch, *axis))])
            }
            Kind::Slide(axis) => {
                let pose = Pose { rotation: IDENTITY, position: scale(random.next(), *axis) };
                (pose, vec![join(zero, *axis)])
            }
            Kind::Cylindrical(axis) => {
                let pose = Pose { rotation: rotation(*axis, random.next()), position: scale(random.next(), *axis) };
                (pose, vec![join(zero, *axis), join(*axis, zero)])
            }
            Kind::Universal(first, second) => {
                let after = rotation(*second, random.next());
                let turn = product(&rotation(*first, random.next()), &after);
                let carried = times(&transpose(after), *first);
                (turned(turn), vec![join(carried, zero), join(*second, zero)])
            }
            Kind::Planar(axis) => {
                let (x, y) = in_plane(*axis);
                let turn = rotation(*axis, random.next());
                let position = add(scale(random.next(), x), scale(random.next(), y));
                let back = transpose(turn);
                let axes = vec![join(zero, times(&back, x)), join(zero, times(&back, y)), join(*axis, zero)];
                let pose = Pose { rotation: turn, position };
                (pose, axes)
            }
            Kind::Ball(orientation) => {
                let (turn, axes) = ball(*orientation, random);
                (turned(turn), axes)
            }
            Kind::Free(orientation) => {
                let (turn, spins) = ball(*orientation, random);
                let back = transpose(turn);
                let mut axes: Vec<Vector6> = IDENTITY.iter().map(|axis| join(zero, times(&back, *axis))).collect();
                axes.extend(spins);
                let pose = Pose { rotation: turn, position: [random.next(), random.next(), random.next()] };
                (pose, axes)
            }
        }
    }
}

/// Angular velocity in child axes: itself, or from the rates of `Rz(yaw) Ry(pitch) Rx(roll)`.
fn ball(orientation: Orientation, random: &mut Random) -> (Matrix3, Vec<Vector6>) {
    let [x, y, z] = IDENTITY;
    let (roll, pitch, yaw) = (random.next(), random.next(), random.next());
    let (about_x, about_y) = (rotation(x, roll), rotation(y, pitch));
    let turn = product(&product(&rotation(z, yaw), &about_y), &about_x);
    let axes = match orientation {
        Orientation::Quaternion => [x, y, z],
        Orientation::RollPitchYaw => {
            let back = transpose(about_x);
            let yaw = times(&back, times(&transpose(about_y), z));
            [x, times(&back, y), yaw]
        }
    };
    let axes = axes.map(|axis| join(axis, [0.0; 3]));
    (turn, axes.to_vec())
}

/// The plane of a planar joint: the axis that follows the largest component of `n`, cyclically, then the third.
fn in_plane(n: Vector3) -> (Vector3, Vector3) {
    let [a, b, c] = n.map(f64::abs);
    let [x, y, z] = IDENTITY;
    let near = if c >= a && c >= b {
        x
    } else if a >= b {
        y
    } else {
        z
    };
    let first = unit(sub(near, scale(dot(near, n), n)));
    (first, cross(n, first))
}

impl Checker<'_, '_> {
    /// The tree in numbers; nothing if one of them is not known or not finite.
    pub(super) fn links(&mut self, bodies: &[Body], joints: &[Joint], tree: &[JointId]) -> Option<Vec<Link>> {
        // Per body: the joint that carries it, and that joint's child frame on it.
        let mut carried: Vec<Option<(usize, Pose)>> = vec![None; bodies.len()];
        let mut links = Vec::with_capacity(tree.len());
        for (index, id) in tree.iter().enumerate() {
            let joint = joints.get(id.0)?;
            let (parent, child) = (self.pose(&joint.parent)?, self.pose(&joint.child)?);
            let (before, mount) = match joint.parent.body {
                BodyRef::Ground => (None, parent),
                BodyRef::Body(body) => {
                    let (before, frame) = (*carried.get(body.0)?)?;
                    (Some(before), frame.inverse().then(&parent))
                }
            };
            let BodyRef::Body(body) = joint.child.body else {
                return None;
            };
            *carried.get_mut(body.0)? = Some((index, child));
            let inertia = self.body_inertia(bodies.get(body.0)?, &child)?;
            let armature = match &joint.armature {
                Some(armature) => self.evaluator.scalar(armature)?,
                None => 0.0,
            };
            if !inertia.iter().flatten().all(|x| x.is_finite()) {
                return None;
            }
            links.push(Link { parent: before, inertia, armature, mount, kind: self.kind(&joint.kind)? });
        }
        Some(links)
    }

    fn kind(&mut self, kind: &JointKind) -> Option<Kind> {
        let mut axis = |axis| self.evaluator.vector(axis).map(unit);
        Some(match kind {
            JointKind::Fixed => Kind::Fixed,
            JointKind::Revolute { axis: a } => Kind::Turn(axis(a)?, 0.0),
            JointKind::Prismatic { axis: a } => Kind::Slide(axis(a)?),
            JointKind::Cylindrical { axis: a } => Kind::Cylindrical(axis(a)?),
            JointKind::Planar { axis: a } => Kind::Planar(axis(a)?),
            JointKind::Universal { axes } => {
                let [first, second] = axes.each_ref().map(&mut axis);
                Kind::Universal(first?, second?)
            }
            JointKind::Screw { axis: a, pitch } => {
                let axis = axis(a)?;
                Kind::Turn(axis, self.evaluator.scalar(pitch)?)
            }
            JointKind::Ball(orientation) => Kind::Ball(*orientation),
            JointKind::Free(orientation) => Kind::Free(*orientation),
        })
    }

    fn pose(&mut self, frame: &Frame) -> Option<Pose> {
        let mut pose = Pose::IDENTITY;
        for step in &frame.steps {
            let mut next = Pose::IDENTITY;
            match step {
                FrameStep::At(offset) => next.position = self.evaluator.vector(offset)?,
                FrameStep::Rotated(axis, angle) => {
                    let axis = self.evaluator.vector(axis)?;
                    next.rotation = rotation(axis, self.evaluator.scalar(angle)?);
                }
                FrameStep::Oriented(rows) => {
                    for (row, exprs) in next.rotation.iter_mut().zip(rows.iter()) {
                        for (entry, expr) in row.iter_mut().zip(exprs) {
                            *entry = self.evaluator.scalar(expr)?;
                        }
                    }
                }
            }
            pose = pose.then(&next);
        }
        Some(pose)
    }

    fn body_inertia(&mut self, body: &Body, frame: &Pose) -> Option<Matrix6> {
        let mass = self.evaluator.scalar(&body.mass)?;
        let com = self.evaluator.vector(&body.com)?;
        let mut tensor = [[0.0; 3]; 3];
        if let Some(entries) = &body.inertia {
            let mut numbers = [0.0; 6];
            for (number, entry) in numbers.iter_mut().zip(entries.iter()) {
                *number = self.evaluator.scalar(entry)?;
            }
            let [xx, yy, zz, xy, xz, yz] = numbers;
            tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        }
        let back = transpose(frame.rotation);
        let tensor = product(&product(&back, &tensor), &frame.rotation);
        let com = times(&back, sub(com, frame.position));
        Some(inertia(mass, com, &tensor))
    }
}

/// Random angles and lengths (Marsaglia's xorshift), away from zero and from right angles of pitch.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        let unit = (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        let sign = if self.0 & 1 == 0 { 1.0 } else { -1.0 };
        sign * (0.3 + 0.8 * unit)
    }
}
