//! Stage `mechanics`: poses of all bodies.
//!
//! In: the derivation. Out: where the frames of bodies are in the world, in the order of declaration, on the tree.

use crate::mechanics::equations::Equations;
use crate::model::types::{BodyRef, Frame};
use crate::symbolic::graph::Scalar;

impl Equations<'_> {
    /// Body after body the position of its origin, then its rotation row by row, before definitions are put in.
    pub(in crate::mechanics) fn body_poses(&mut self) -> Vec<Scalar> {
        let bodies = self.scene.model.bodies.iter_ids();
        let frames: Vec<Frame> =
            bodies.map(|(id, body)| Frame { body: BodyRef::Body(id), steps: Vec::new(), span: body.span }).collect();
        frames.iter().flat_map(|frame| self.pose(frame)).collect()
    }
}
