//! Stage `mechanics`: points that closed joints hold together.
//!
//! In: two frames. Out: whether their origins are one point wherever loops are closed. A point of one body is a point of the
//! next one too where a joint between them leaves it in place: its centre for a ball or a universal joint, any point of its axis
//! for a hinge, every point for a rigid one. So it is handed from body to body. Joints of the tree need no rule: there the way
//! between two such points is zero as it is written.

use crate::mechanics::equations::Equations;
use crate::mechanics::translate::build::FixedFrame;
use crate::model::types::JointId;
use crate::symbolic::graph::{Scalar, Vector};
use crate::symbolic::rotations;

impl Equations<'_> {
    /// Whether it is certain: there may be other reasons for two points to meet.
    pub(in crate::mechanics) fn are_held_together(&mut self, ends: &[FixedFrame; 2]) -> bool {
        let model = self.scene.model;
        let mut known = vec![ends[0]];
        let mut cuts: Vec<JointId> = model.cuts.clone();
        let mut next = 0;
        while let Some(&point) = known.get(next) {
            next += 1;
            if self.coincide(&point, &ends[1]) {
                return true;
            }
            cuts.retain(|&id| match self.beyond(&point, id) {
                Some(beyond) => {
                    known.push(beyond);
                    false
                }
                None => true,
            });
        }
        false
    }

    fn coincide(&mut self, a: &FixedFrame, b: &FixedFrame) -> bool {
        self.way(a, b, 0).0[0] == Vector::ZERO
    }

    /// The same point on the body beyond a cut joint.
    fn beyond(&mut self, point: &FixedFrame, id: JointId) -> Option<FixedFrame> {
        let cut = self.cut(id)?;
        let kind = self.scene.model.joints[id].kind;
        for [near, far] in [cut.ends, [cut.ends[1], cut.ends[0]]] {
            let local = match point.link == near.link {
                true => {
                    let arm = self.g.sub_vectors(point.offset, near.offset);
                    rotations::rotate(&mut self.g, near.rotation.transpose(), arm)
                }
                false if self.coincide(point, &near) => Vector::ZERO,
                false => continue,
            };
            let parts = self.g.components(local);
            let axis = cut.aligned.first().copied();
            // Freedoms that turn leave in place what lies on all their axes.
            let turns = kind.slides() == 0 && !kind.has_pitch;
            let held = match (turns, kind.freedoms()) {
                (false, _) => false,
                (true, 0) => true,
                (true, 1) => (0..3).all(|k| Some(k) == axis || parts[k] == Scalar::ZERO),
                (true, _) => local == Vector::ZERO,
            };
            if held {
                let arm = rotations::rotate(&mut self.g, far.rotation, local);
                return Some(FixedFrame { offset: self.g.add_vectors(far.offset, arm), ..far });
            }
        }
        None
    }
}
