//! Stage `mechanics`: poses of all bodies.
//!
//! In: the derivation. Out: where the frames of bodies are in the world, in the order of declaration, on the tree.

use crate::mechanics::equations::Equations;
use crate::symbolic::graph::Scalar;

impl Equations<'_> {
    /// Body after body the position of its origin, then its rotation row by row, before definitions are put in.
    pub(in crate::mechanics) fn body_poses(&mut self) -> Vec<Scalar> {
        let frames = self.scene.model.body_frames();
        frames.iter().flat_map(|frame| self.pose(frame)).collect()
    }
}
