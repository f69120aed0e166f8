//! Stage `mechanics`: a cut joint as equations.
//!
//! In: the joint. Out: its two frames, turned so that its axis is a coordinate axis, and the list of its equations.

use crate::dynamics::tree::Motion;
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::build::FixedFrame;
use crate::mechanics::translate::directions::Axis;
use crate::model::joint_kinds::Hold;
use crate::model::types::{Directions, JointId};
use crate::symbolic::graph::{Scalar, Vector};
use crate::symbolic::rotations;

use super::Writing;
use super::view::View;

/// One equation of a joint.
#[derive(Clone, Copy, Debug)]
pub(super) enum Equation {
    /// A component of the way in the axes that the equations are written in.
    Gap(usize),
    /// The way along one of the parent's axes.
    Along(usize),
    /// An axis of the child . an axis of the parent.
    Turn(usize, usize),
    /// Travel along the axis against the angle about it, with metres per radian.
    Pitch(usize, Scalar),
    /// The angle about an axis, whole turns included.
    Turns(usize),
}

/// A cut joint.
#[derive(Clone, Debug)]
pub(super) struct Cut {
    /// Parent and child.
    pub ends: [FixedFrame; 2],
    pub equations: Vec<Equation>,
    /// Axes that coincide when the joint is closed as it was meant.
    pub aligned: Vec<usize>,
}

impl Equations<'_> {
    pub(super) fn cut(&mut self, id: JointId) -> Option<Cut> {
        let model = self.scene.model;
        let joint = &model.joints[id];
        let mut ends = [self.place(&joint.parent), self.place(&joint.child)];
        let axes = self.joint_axes(joint);
        // Both frames so that the directions are coordinate axes, or the opposite of one: no equation minds.
        let [of_parent, of_child] = match joint.directions {
            Directions::Frame | Directions::Axis(_) | Directions::Plane(_) | Directions::Slot(_) => [axes[0], axes[0]],
            Directions::Crossed(_) => [axes[0], axes[1]],
        };
        self.turn_end(&mut ends[0], &of_parent);
        self.turn_end(&mut ends[1], &of_child);
        let pitch = joint.pitch.as_ref().map(|pitch| self.scalar(pitch));
        let of = |k: usize| axes[k % 3].index;
        let across = |k: usize| [(of(k) + 1) % 3, (of(k) + 2) % 3];
        let (mut equations, mut aligned) = (Vec::new(), Vec::new());
        for hold in joint.kind.holds {
            match *hold {
                Hold::Point => equations.extend((0..3).map(Equation::Gap)),
                Hold::Line(k) => equations.extend(across(k).map(Equation::Along)),
                Hold::Plane(k) => equations.push(Equation::Along(of(k))),
                Hold::Axis(k) => {
                    equations.extend(across(k).map(|other| Equation::Turn(of(k), other)));
                    aligned.push(of(k));
                }
                Hold::Crossing => equations.push(Equation::Turn(of(1), of(0))),
                Hold::Orientation => {
                    equations.extend((0..3).map(|k| Equation::Turn(k, (k + 1) % 3)));
                    aligned.extend(0..3);
                }
                Hold::Pitch => equations.extend(pitch.map(|pitch| Equation::Pitch(of(0), pitch))),
            }
        }
        let mut cut = Cut { ends, equations, aligned };
        if joint.kind.holds(Hold::Orientation) && self.holds_screw(&ends) {
            self.count_turns(&mut cut);
        }
        Some(cut)
    }

    /// Whether a screw of the tree stands between two frames.
    fn holds_screw(&self, ends: &[FixedFrame; 2]) -> bool {
        let common = self.common(ends[0].link, ends[1].link);
        let tree = &self.scene.mechanism.tree;
        let is_screw = |index: usize| matches!(tree.links[index].motion, Motion::Screw(..));
        ends.iter().any(|end| tree.path(common, end.link).into_iter().any(is_screw))
    }

    /// Where everything in the loop turns about one axis, the cosine that speaks of this turn becomes the angle: with
    /// cosines alone a screw of the loop would be free to skip turns, and its nut to jump.
    fn count_turns(&mut self, cut: &mut Cut) {
        let view = self.view(&cut.ends, Writing::PLAIN);
        for equation in 0..cut.equations.len() {
            // Axis k of the child against k + 1 of the parent: a turn about k + 2.
            let Equation::Turn(k, other) = cut.equations[equation] else { continue };
            let axis = 3 - k - other;
            let angle = self.winding(&view, &cut.ends, axis);
            if angle.is_some_and(|angle| self.g.literal(angle).is_none()) {
                cut.equations[equation] = Equation::Turns(axis);
                return;
            }
        }
    }

    fn turn_end(&mut self, end: &mut FixedFrame, axis: &Axis) {
        end.rotation = rotations::compose(&mut self.g, end.rotation, axis.turn);
    }

    pub(super) fn cut_residuals(&mut self, cut: &Cut, writing: Writing) -> Vec<Scalar> {
        let view = self.view(&cut.ends, writing);
        let way = self.see_cut_way(&view, cut);
        let equations = cut.equations.iter();
        equations.map(|&equation| self.cut_residual(cut, &view, way, equation)).collect()
    }

    /// The way from parent to child, if an equation speaks of it.
    pub(super) fn see_cut_way(&mut self, view: &View, cut: &Cut) -> Vector {
        let turns = |equation: &Equation| matches!(equation, Equation::Turn(..));
        if cut.equations.iter().all(turns) { Vector::ZERO } else { self.see_way(view, &cut.ends) }
    }

    fn cut_residual(&mut self, cut: &Cut, view: &View, way: Vector, equation: Equation) -> Scalar {
        match equation {
            Equation::Gap(k) => self.g.component(way, k),
            Equation::Along(k) => {
                let axis = self.see_axis(view, &cut.ends[0], k);
                self.g.dot(way, axis)
            }
            Equation::Turn(k, other) => self.see_cosine(view, cut, k, other),
            Equation::Turns(k) => match self.winding(view, &cut.ends, k) {
                Some(angle) => angle,
                None => self.see_cosine(view, cut, (k + 1) % 3, (k + 2) % 3),
            },
            Equation::Pitch(k, pitch) => {
                let axis = self.see_axis(view, &cut.ends[0], k);
                let travel = self.g.dot(way, axis);
                if let Some(angle) = self.winding(view, &cut.ends, k) {
                    let turned = self.g.mul(pitch, angle);
                    return self.g.sub(travel, turned);
                }
                let Some((sin, cos)) = self.thread(travel, pitch) else { return travel };
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                let (c, s) = (self.see_cosine(view, cut, i, i), self.see_cosine(view, cut, i, j));
                let g = &mut self.g;
                let (plus, minus) = (g.mul(sin, c), g.mul(cos, s));
                let lag = g.sub(plus, minus);
                g.mul(pitch, lag)
            }
        }
    }

    /// How the equation of a screw that doesn't count its turns changes with the travel, and with turns of the child against the
    /// parent; nothing where it is linear in both.
    pub(super) fn thread_slopes(
        &mut self,
        cut: &Cut,
        view: &View,
        k: usize,
        pitch: Scalar,
    ) -> Option<(Scalar, Vector)> {
        if self.winding(view, &cut.ends, k).is_some() {
            return None;
        }
        let way = self.see_cut_way(view, cut);
        let axis = self.see_axis(view, &cut.ends[0], k);
        let travel = self.g.dot(way, axis);
        let (sin, cos) = self.thread(travel, pitch)?;
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let (c, s) = (self.see_cosine(view, cut, i, i), self.see_cosine(view, cut, i, j));
        let child = self.see_axis(view, &cut.ends[1], i);
        let [first, second] = [i, j].map(|axis| self.see_axis(view, &cut.ends[0], axis));
        let g = &mut self.g;
        let products = [g.mul(cos, c), g.mul(sin, s)];
        let advance = g.sum(&products);
        let (by_cosine, by_sine) = (g.cross(child, first), g.cross(child, second));
        let (by_cosine, by_sine) = (g.scale(sin, by_cosine), g.scale(cos, by_sine));
        let twist = g.sub_vectors(by_cosine, by_sine);
        Some((advance, g.scale(pitch, twist)))
    }

    /// The angle of a cut joint that counts its turns: of a screw, or of a joint that holds an angle where a screw stands
    /// in its loop.
    pub(in crate::mechanics) fn counted_turns(&mut self, joint: JointId) -> Option<Scalar> {
        let cut = self.cut(joint)?;
        let axis = cut.equations.iter().find_map(|&equation| match equation {
            Equation::Pitch(k, _) | Equation::Turns(k) => Some(k),
            _ => None,
        })?;
        let view = self.view(&cut.ends, Writing::PLAIN);
        self.winding(&view, &cut.ends, axis)
    }

    /// Whether this is a screw that knows its angle up to whole turns only.
    pub(in crate::mechanics) fn turns_unknown(&mut self, joint: JointId) -> bool {
        let Some(cut) = self.cut(joint) else { return false };
        let pitched = |equation: &Equation| matches!(equation, Equation::Pitch(_, pitch) if *pitch != Scalar::ZERO);
        cut.equations.iter().any(pitched) && self.counted_turns(joint).is_none()
    }

    /// Sine and cosine of the angle that belongs to a travel; nothing for a thread without pitch, which has no travel.
    fn thread(&mut self, travel: Scalar, pitch: Scalar) -> Option<(Scalar, Scalar)> {
        if pitch == Scalar::ZERO {
            return None;
        }
        let angle = self.g.div(travel, pitch);
        Some((self.g.sin(angle), self.g.cos(angle)))
    }

    pub(super) fn see_axis(&mut self, view: &View, place: &FixedFrame, axis: usize) -> Vector {
        let axis = self.axis_in_link(place, axis);
        self.see_vector(view, place.link, axis)
    }

    fn see_cosine(&mut self, view: &View, cut: &Cut, child: usize, parent: usize) -> Scalar {
        let (c, p) = (self.see_axis(view, &cut.ends[1], child), self.see_axis(view, &cut.ends[0], parent));
        self.g.dot(c, p)
    }

    pub(super) fn cut_alignments(&mut self, cut: &Cut) -> Vec<Scalar> {
        let view = self.view(&cut.ends, Writing::PLAIN);
        let mut cosines: Vec<Scalar> = Vec::new();
        for &k in &cut.aligned {
            cosines.push(self.see_cosine(&view, cut, k, k));
        }
        for &equation in &cut.equations {
            let Equation::Pitch(k, pitch) = equation else { continue };
            // A thread that counts its turns has no branch on which it runs the other way.
            if self.winding(&view, &cut.ends, k).is_some() {
                continue;
            }
            let way = self.see_cut_way(&view, cut);
            let axis = self.see_axis(&view, &cut.ends[0], k);
            let travel = self.g.dot(way, axis);
            if let Some((sin, cos)) = self.thread(travel, pitch) {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                let (c, s) = (self.see_cosine(&view, cut, i, i), self.see_cosine(&view, cut, i, j));
                let products = [self.g.mul(cos, c), self.g.mul(sin, s)];
                cosines.push(self.g.sum(&products));
            }
        }
        cosines
    }
}
