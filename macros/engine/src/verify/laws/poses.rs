//! Stage `verify`: poses of bodies against what outputs show of them.
//!
//! In: poses of all bodies, outputs. Out: whether outputs show bodies where poses have them.

use crate::contracts::function::FunctionKind;
use crate::model::types::{BodyRef, FrameQuantity};
use crate::symbolic::doubled::Doubled;

use super::outputs::Shown;
use super::{At, Judged, Law, Sum, judged};

pub(super) const LAWS: &[Law] = &[Law { between: "poses and outputs", judge: |at| at.shown_poses() }];

/// Of a body's scalars the first of its rotation, and their number.
const ROTATION: usize = 3;
const POSE: usize = 12;

impl At<'_, '_> {
    /// What outputs show of bodies' own frames.
    fn shown_poses(&mut self) -> Judged {
        let (outputs, poses) = (FunctionKind::Outputs, FunctionKind::Poses);
        if !self.has(outputs) || !self.has(poses) {
            return Some(None);
        }
        let shown = Shown::new(self.laws.model, self.dof());
        let (all, own) = (self.values(outputs)?, self.values(poses)?);
        let (mut sum, mut any) = (Sum::default(), false);
        let (mut of_all, mut of_own) = (vec![0.0; all.len()], vec![0.0; own.len()]);
        for &(place, frame, quantity) in shown.quantities.iter().filter(|shown| shown.1.steps.is_empty()) {
            let BodyRef::Body(body) = frame.body else { continue };
            let (first, count) = match quantity {
                FrameQuantity::Position | FrameQuantity::Pose => (0, ROTATION),
                FrameQuantity::Rotation => (ROTATION, POSE - ROTATION),
                _ => continue,
            };
            any = true;
            for (k, weight) in self.weights(count).into_iter().enumerate() {
                let (of_output, of_pose) = (place + k, POSE * body.0 + first + k);
                sum.product(&[all[of_output], Doubled::new(weight)]);
                sum.product(&[-own[of_pose], Doubled::new(weight)]);
                of_all[of_output] += weight;
                of_own[of_pose] -= weight;
            }
        }
        if !any {
            return Some(None);
        }
        if sum.holds() != Some(true) {
            sum.bound = self.bound(outputs, &of_all) + self.bound(poses, &of_own);
        }
        judged(&sum, poses, outputs)
    }
}
