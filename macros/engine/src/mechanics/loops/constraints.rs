//! Stage `mechanics`: the equations of what closes loops.
//!
//! In: a closing (a joint that is cut, a rod, a user's expression), and how it is to be written. Out: its residuals, which
//! vanish where the loop is closed. The equations of a joint are parts of the way d from the parent's to the child's
//! point, and cosines of angles between axes of the child and axes of the parent that are perpendicular when it is
//! closed (Haug 1989, chapter 9). Which of them a joint holds stands in the table of joint kinds:
//!
//! | what is held | rows |
//! |---|---|
//! | point | d |
//! | line | d . both axes of the parent across it |
//! | plane | d . the direction across it |
//! | axis | child's axis . both parent's axes across it |
//! | crossing | second axis . first axis |
//! | orientation | three axes of the child . the next one of the parent |
//! | pitch | travel - pitch * angle |
//!
//! The angle of a screw counts its turns (`winding`), and so does the one that a Prismatic or Fixed joint holds where a
//! screw stands in its loop. Where an orientation alone gives it, up to whole turns, the
//! equation is pitch * sin(travel / pitch - angle): it holds on every turn of the thread, so a motion stays on its own,
//! and nothing tells on which it began. Solved from a guess such an equation could skip a turn: *Reduced* refuses it.
//!
//! Constraints of velocities have no residual (`rates`). A rod is (d . d - length^2) / 2, an expression is itself; where it counts the turns of measured angles, and so does a
//! drive of one, it is taken up to whole turns (`turns`). Cosines vanish on a further branch too, where axes point the
//! other way: [`Equations::alignments`] tells the branches apart. The axes in which d and the cosines are worked out
//! don't matter for what the equations say, but for what they cost: [`Writing`].

mod cut;
pub(in crate::mechanics) mod expression;
pub(in crate::mechanics) mod measured;
mod meeting;
mod names;
pub(in crate::mechanics) mod rates;
pub(in crate::mechanics) mod turns;
mod view;
mod winding;
mod wrenches;

use crate::invariant::fault::raise;
use crate::invariant::injection::{Break, broken};
use crate::mechanics::equations::Equations;
use crate::mechanics::scene::Style;
use crate::model::joint_kinds::Hold;
use crate::model::types::{ConstraintId, ConstraintKind, JointId, LoopClosure, Model};
use crate::symbolic::graph::Scalar;

pub use names::{body_name, closing_name, coordinate_name, local_name, parameter_name, place_of, row_name, unfit};
pub(in crate::mechanics) use names::{path, row_called, rows_of_joint};
pub use rates::{is_rate, rate_rows};
pub use wrenches::Held;

/// In which axes a closing is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ClosedIn {
    /// Those of the joint's parent frame, or the first frame of a rod.
    Parent,
    /// Those of the joint's child frame, or the second frame of a rod.
    Child,
    World,
    /// Those of the last link that carries both.
    Common,
    /// Those of the frame on which the first joint of the parent's side stands: for a leg its frame on the ground, turned
    /// by its heading. Where the parent itself carries both, this is `Parent`.
    ParentBase,
    /// The same of the child's side.
    ChildBase,
}

/// How a closing is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Writing {
    pub axes: ClosedIn,
    /// [`Style::World`]: points are taken in world axes from rotations that all closings share, but for the side on whose
    /// base the equations are written; it pays for a body that many loops hang on, and gives planar loops absolute
    /// angles. [`Style::Nested`]: each point passes joint by joint.
    pub style: Style,
}

impl Default for Writing {
    fn default() -> Self {
        Writing::PLAIN
    }
}

impl Writing {
    /// What derivation tries.
    pub const ALL: [Writing; 12] = {
        let axes = [
            ClosedIn::Parent,
            ClosedIn::ParentBase,
            ClosedIn::ChildBase,
            ClosedIn::World,
            ClosedIn::Common,
            ClosedIn::Child,
        ];
        let mut all = [Writing { axes: ClosedIn::Parent, style: Style::Nested }; 12];
        let mut k = 0;
        while k < 12 {
            let style = if k % 2 == 0 { Style::Nested } else { Style::World };
            all[k] = Writing { axes: axes[k / 2], style };
            k += 1;
        }
        all
    };
    /// As good as any where cost is of no concern.
    pub const PLAIN: Writing = Writing { axes: ClosedIn::Common, style: Style::Nested };
}

/// Number of equations that a closing gives.
pub fn row_count(model: &Model, closing: LoopClosure) -> usize {
    match closing {
        LoopClosure::Cut(joint) => model.joints[joint].kind.rows().count(),
        LoopClosure::Constraint(_) => 1,
    }
}

/// Whether the equation of a cut joint is a length (m), and not a cosine.
pub fn is_length(model: &Model, closing: LoopClosure, index: usize) -> bool {
    let LoopClosure::Cut(joint) = closing else { return false };
    hold(model, joint, index).is_some_and(Hold::is_length)
}

/// What an equation of a cut joint belongs to.
fn hold(model: &Model, joint: JointId, index: usize) -> Option<Hold> {
    model.joints[joint].kind.rows().nth(index)
}

/// Whether an equation is one of three components of the way between a joint's frames, in the axes of the [`Writing`]; all
/// others say the same in any axes.
pub(in crate::mechanics) fn is_component(model: &Model, closing: LoopClosure, index: usize) -> bool {
    let LoopClosure::Cut(joint) = closing else { return false };
    hold(model, joint, index) == Some(Hold::Point)
}

/// Everything that gives equations of positions, in source order: joints, then constraints.
pub fn closings(model: &Model) -> Vec<LoopClosure> {
    let cuts = model.cuts.iter().map(|&joint| LoopClosure::Cut(joint));
    let of_positions = |id: &ConstraintId| !matches!(model.constraints[*id].kind, ConstraintKind::Rate(_));
    let constraints = (0..model.constraints.len()).map(ConstraintId).filter(of_positions);
    cuts.chain(constraints.map(LoopClosure::Constraint)).collect()
}

/// Whether a cut screw knows its angle up to whole turns only.
pub(in crate::mechanics) fn is_uncounted(model: &Model, joint: JointId) -> bool {
    if !model.joints[joint].kind.has_pitch {
        return false;
    }
    Equations::plain(model).turns_unknown(joint)
}

impl Equations<'_> {
    /// The equations of a closing, [`row_count`] of them: lengths in metres (half squares of lengths for a rod), cosines.
    pub fn residuals(&mut self, closing: LoopClosure, writing: Writing) -> Vec<Scalar> {
        let mut residuals = self.residuals_of(closing, writing);
        if broken(Break::LostRow) {
            residuals.pop();
        }
        if residuals.len() != row_count(self.scene.model, closing) {
            raise("a closing gives as many equations as are counted for it");
        }
        residuals
    }

    fn residuals_of(&mut self, closing: LoopClosure, writing: Writing) -> Vec<Scalar> {
        match closing {
            LoopClosure::Cut(joint) => self.cut(joint).map_or_else(Vec::new, |cut| self.cut_residuals(&cut, writing)),
            LoopClosure::Constraint(id) => {
                let model = self.scene.model;
                let constraint = &model.constraints[id];
                match &constraint.kind {
                    ConstraintKind::Value(_) => vec![self.expression_residual(id)],
                    ConstraintKind::Rate(_) => vec![Scalar::ZERO],
                    ConstraintKind::Rod { between, length } => {
                        let ends = [self.place(&between[0]), self.place(&between[1])];
                        let length = self.scalar(length);
                        let way = self.way_in(&ends, writing);
                        let g = &mut self.g;
                        let (square, target) = (g.dot(way, way), g.mul(length, length));
                        let (half, rest) = (g.decimal(0.5), g.sub(square, target));
                        vec![g.mul(half, rest)]
                    }
                }
            }
        }
    }

    /// Time derivatives of the residuals, in terms of the velocity symbols.
    pub fn residual_rates(&mut self, closing: LoopClosure, writing: Writing) -> Vec<Scalar> {
        let residuals = self.residuals(closing, writing);
        self.time_derivative(&residuals)
    }

    /// Cosines that are one where a joint is closed as it was meant, and minus one (or anything else) on the branches
    /// that the equations cannot tell from it.
    pub fn alignments(&mut self, closing: LoopClosure) -> Vec<Scalar> {
        match closing {
            LoopClosure::Cut(joint) => self.cut(joint).map_or_else(Vec::new, |cut| self.cut_alignments(&cut)),
            // Their equations vanish nowhere else.
            LoopClosure::Constraint(_) => Vec::new(),
        }
    }
}
