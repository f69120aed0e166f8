//! Stage `model`: the mechanism in numbers, at the declared defaults and a random configuration.
//!
//! In: bodies, joints, the tree. Out: per joint the inertia beyond it and its motion axes, in the joint's child frame.

use crate::invariant::fault::OrFault;
use crate::invariant::index_vec::IndexVec;
use crate::model::checker::Checker;
use crate::model::joint_kinds;
use crate::model::types::{Bodies, Body, BodyId, BodyRef, Joint, JointId, Joints};

use super::evaluate::cross;
use super::matrix3::{IDENTITY, Matrix3, Vector3, add, product, rotation, scale, sub, times, transpose};
use super::placement::{Pose, directions, pose};
use super::spatial::{Matrix6, Vector6, inertia, join};

/// One joint of the tree with the body that it carries.
pub(super) struct Link {
    /// Position in the tree of the joint that carries the parent body.
    pub(in crate::model) parent: Option<usize>,
    /// Of the body, in the joint's child frame.
    pub(in crate::model) inertia: Matrix6,
    pub(in crate::model) armature: f64,
    /// The joint's parent frame, seen from the child frame of the joint before.
    mount: Pose,
    /// From parent to child.
    sequence: Vec<Freedom>,
    /// Whether it turns in all directions after these, at rates in the child's axes.
    turns_freely: bool,
}

/// A freedom in numbers.
struct Freedom {
    /// Number of the coordinate.
    index: usize,
    /// Velocity at a rate of one, at the frame that the freedom stands in.
    axis: Vector6,
    /// A unit vector.
    direction: Vector3,
    /// Metres and radians for a change of one.
    amounts: [f64; 2],
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
            let (pose, axes) = link.moved(&mut random);
            let pose = link.mount.then(&pose);
            Motion { rotation: pose.rotation, position: pose.position, axes }
        });
        Configuration { joints: joints.collect() }
    }
}

impl Link {
    /// Where the joint goes, and its axes in the child's frame.
    fn moved(&self, random: &mut Random) -> (Pose, Vec<Vector6>) {
        let mut pose = Pose::IDENTITY;
        let mut axes: Vec<(usize, Vector6)> = Vec::new();
        let mut step = |axes: &mut Vec<(usize, Vector6)>, step: &Pose| {
            axes.iter_mut().for_each(|(_, axis)| *axis = carried(axis, step));
            pose = pose.then(step);
        };
        for freedom in &self.sequence {
            let [length, angle] = scale_pair(freedom.amounts, random.next());
            let position = scale(length, freedom.direction);
            step(&mut axes, &Pose { rotation: rotation(freedom.direction, angle), position });
            axes.push((freedom.index, freedom.axis));
        }
        if self.turns_freely {
            let turns = IDENTITY.map(|axis| rotation(axis, random.next()));
            for rotation in turns {
                step(&mut axes, &Pose { rotation, position: [0.0; 3] });
            }
            let first = axes.len();
            axes.extend(IDENTITY.iter().enumerate().map(|(k, axis)| (first + k, join(*axis, [0.0; 3]))));
        }
        axes.sort_by_key(|(index, _)| *index);
        (pose, axes.into_iter().map(|(_, axis)| axis).collect())
    }
}

fn scale_pair(pair: [f64; 2], s: f64) -> [f64; 2] {
    pair.map(|x| s * x)
}

/// A velocity at the origin of a frame, seen from the frame that a step leads to.
fn carried([a, b, c, d, e, f]: &Vector6, step: &Pose) -> Vector6 {
    let (angular, linear) = ([*a, *b, *c], [*d, *e, *f]);
    let back = transpose(step.rotation);
    join(times(&back, angular), times(&back, add(linear, cross(angular, step.position))))
}

impl Checker<'_, '_> {
    /// The tree in numbers; nothing if one of them is not known or not finite.
    pub(super) fn links(&mut self, bodies: &Bodies, joints: &Joints, tree: &[JointId]) -> Option<Vec<Link>> {
        // Per body: the joint that carries it, and that joint's child frame on it.
        let mut places: IndexVec<BodyId, Option<(usize, Pose)>> = bodies.iter().map(|_| None).collect();
        let mut links = Vec::with_capacity(tree.len());
        for (index, id) in tree.iter().enumerate() {
            let joint = &joints[*id];
            let (parent, child) = (pose(&mut self.evaluator, &joint.parent)?, pose(&mut self.evaluator, &joint.child)?);
            let (before, mount) = match joint.parent.body {
                BodyRef::Ground => (None, parent),
                BodyRef::Body(body) => {
                    let (before, frame) = places[body].or_fault("the tree has parents before children");
                    (Some(before), frame.inverse().then(&parent))
                }
            };
            let body = super::massless::carried(joint);
            places[body] = Some((index, child));
            let inertia = self.body_inertia(&bodies[body], &child)?;
            let armature = match &joint.armature {
                Some(armature) => self.evaluator.scalar(armature)?,
                None => 0.0,
            };
            if !inertia.iter().flatten().all(|x| x.is_finite()) {
                return None;
            }
            let (sequence, turns_freely) = (self.sequence(joint)?, joint.kind.has_quaternion());
            links.push(Link { parent: before, inertia, armature, mount, sequence, turns_freely });
        }
        Some(links)
    }

    /// The freedoms of a joint, but for those of a quaternion.
    fn sequence(&mut self, joint: &Joint) -> Option<Vec<Freedom>> {
        let directions = directions(&mut self.evaluator, &joint.directions)?;
        let pitch = match &joint.pitch {
            Some(pitch) => self.evaluator.scalar(pitch)?,
            None => 0.0,
        };
        let freedom = |index: usize| {
            let freedom = &joint.kind.freedoms[index];
            let direction = directions[freedom.direction];
            let [length, angle] = match freedom.motion {
                joint_kinds::Motion::Slides => [1.0, 0.0],
                joint_kinds::Motion::Turns => [pitch, 1.0],
            };
            let axis = join(scale(angle, direction), scale(length, direction));
            Freedom { index, axis, direction, amounts: [length, angle] }
        };
        Some(joint.kind.sequence().into_iter().map(freedom).collect())
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
