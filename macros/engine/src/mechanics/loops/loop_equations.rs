//! Stage `mechanics`: loops as cycles for the stage `solve`.
//!
//! In: a `solve` item, or a closing with what is unknown of its loop. Out: each of its loops as a [`KinematicLoop`], walked once around: from the last link that carries both ends out to
//! the closing's parent frame, through the closing, and back from its child frame. Motions that are known stay as they
//! are, unknown ones keep the symbols of their coordinates as placeholders. A motion that is walked against its sense is
//! the same motion about the opposite axis: turned by half a turn before and after.

use crate::dynamics::tree::{Link, Motion, Orientation};
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::build::FixedFrame;
use crate::mechanics::translate::symbols::UNWANTED;
use crate::model::types::{ConstraintKind, Coordinate, Joint, JointId, LoopClosure, Solve};
use crate::solve::{KinematicLoop, Segment};
use crate::symbolic::graph::{Rotation, Scalar, Vector};
use crate::symbolic::rotations;

impl Equations<'_> {
    /// Once around the loop of each closing.
    pub(super) fn cycles(&mut self, item: &Solve) -> Vec<KinematicLoop> {
        let closings = item.closings().enumerate();
        closings
            .map(|(number, closing)| {
                // The first of the closing's own coordinates.
                let own = number * UNWANTED;
                let segments = self.segments(closing, own, &item.unknowns);
                let winding = match closing {
                    LoopClosure::Cut(id) => self.cycle_winding(id, own),
                    LoopClosure::Constraint(_) => None,
                };
                KinematicLoop { segments, winding }
            })
            .collect()
    }

    /// The sum of all angles of a loop that counts turns. That of a screw which closes it stands there as its coordinate.
    fn cycle_winding(&mut self, id: JointId, own: usize) -> Option<Scalar> {
        let sum = self.counted_turns(id)?;
        let screw = self.scene.model.joints[id].kind.has_pitch;
        let own = if screw { self.scene.symbols.unwanted(own) } else { Scalar::ZERO };
        Some(self.g.sub(sum, own))
    }

    /// Once around the loop of a closing, with these coordinates unknown; the closing's own ones are numbered from `own` on.
    pub(in crate::mechanics) fn segments(
        &mut self,
        closing: LoopClosure,
        own: usize,
        unknowns: &[Coordinate],
    ) -> Vec<Segment> {
        let model = self.scene.model;
        let mut cycle = Vec::new();
        match closing {
            LoopClosure::Cut(id) => {
                let joint = &model.joints[id];
                let (from, to) = (self.place(&joint.parent), self.place(&joint.child));
                let common = self.common(from.link, to.link);
                self.outwards_to(&from, common, unknowns, &mut cycle);
                self.closing_motions(joint, own, &mut cycle);
                self.back_from(&to, common, unknowns, &mut cycle);
            }
            LoopClosure::Constraint(id) => {
                let ConstraintKind::Rod { between, length } = &model.constraints[id].kind else {
                    return cycle;
                };
                let (from, to) = (self.place(&between[0]), self.place(&between[1]));
                let length = self.scalar(length);
                let common = self.common(from.link, to.link);
                self.outwards_to(&from, common, unknowns, &mut cycle);
                cycle.push(self.unwanted(Motion::Ball(Orientation::Quaternion([Scalar::ZERO; 4])), own));
                let offset = self.g.along(0, length);
                cycle.push(Segment::Fixed { rotation: Rotation::IDENTITY, offset });
                cycle.push(self.unwanted(Motion::Ball(Orientation::Quaternion([Scalar::ZERO; 4])), own + 3));
                self.back_from(&to, common, unknowns, &mut cycle);
            }
        }
        cycle
    }

    fn outwards_to(
        &mut self,
        place: &FixedFrame,
        common: Option<usize>,
        unknowns: &[Coordinate],
        cycle: &mut Vec<Segment>,
    ) {
        let mechanism = std::rc::Rc::clone(&self.scene.mechanism);
        for index in mechanism.tree.path(common, place.link) {
            let link = &mechanism.tree.links[index];
            cycle.push(Segment::Fixed { rotation: link.rotation, offset: link.offset });
            self.motion(link, false, unknowns, cycle);
        }
        cycle.push(Segment::Fixed { rotation: place.rotation, offset: place.offset });
    }

    fn back_from(
        &mut self,
        place: &FixedFrame,
        common: Option<usize>,
        unknowns: &[Coordinate],
        cycle: &mut Vec<Segment>,
    ) {
        let mechanism = std::rc::Rc::clone(&self.scene.mechanism);
        self.inverse(place.rotation, place.offset, cycle);
        for index in mechanism.tree.path(common, place.link).into_iter().rev() {
            let link = &mechanism.tree.links[index];
            self.motion(link, true, unknowns, cycle);
            self.inverse(link.rotation, link.offset, cycle);
        }
    }

    fn inverse(&mut self, rotation: Rotation, offset: Vector, cycle: &mut Vec<Segment>) {
        let back = rotations::rotate(&mut self.g, rotation.transpose(), offset);
        cycle.push(Segment::Fixed { rotation: rotation.transpose(), offset: -back });
    }

    /// A link's motion, or its inverse.
    fn motion(&mut self, link: &Link, back: bool, unknowns: &[Coordinate], cycle: &mut Vec<Segment>) {
        let unknown = unknowns.iter().any(|&u| {
            let symbol = self.coordinate_symbols(u)[0];
            symbol.index() == link.q.index() && symbol != Scalar::ZERO
        });
        if unknown {
            let against = back != link.q.is_negative();
            let axis = match link.motion {
                Motion::Revolute(axis) | Motion::Prismatic(axis) | Motion::Screw(axis, _) => axis,
                Motion::Ball(_) => 0,
            };
            let half = against.then(|| {
                let pi = self.g.pi();
                self.g.axis_rotation((axis + 1) % 3, pi)
            });
            let turn = half.map(|rotation| Segment::Fixed { rotation, offset: Vector::ZERO });
            cycle.extend(turn);
            cycle.push(Segment::Unknown { motion: link.motion, symbol: link.q.positive(), wanted: true });
            cycle.extend(turn);
            return;
        }
        let rotation = link.turn(&mut self.g);
        let offset = link.travel(&mut self.g);
        if back {
            // The travel lies on the axis of the turn, so it needs no turning back.
            cycle.push(Segment::Fixed { rotation: rotation.transpose(), offset: -offset });
        } else {
            cycle.push(Segment::Fixed { rotation, offset });
        }
    }

    /// The motions of what closes the loop, from its parent frame to its child frame.
    fn closing_motions(&mut self, joint: &Joint, own: usize, cycle: &mut Vec<Segment>) {
        let kind = joint.kind;
        if kind.turns_freely() {
            // What is free closes nothing.
            if !kind.is_free() {
                cycle.push(self.unwanted(Motion::Ball(Orientation::Quaternion([Scalar::ZERO; 4])), own));
            }
            return;
        }
        let axes = self.joint_axes(joint);
        for (number, index) in kind.sequence().into_iter().enumerate() {
            let (axis, motion) = self.freedom_motion(joint, &axes, index);
            let place = |rotation| Segment::Fixed { rotation, offset: Vector::ZERO };
            cycle.push(place(axis.turn));
            cycle.push(self.unwanted(motion, own + number));
            cycle.push(place(axis.turn.transpose()));
        }
    }

    /// An unknown that nobody asks for.
    fn unwanted(&self, motion: Motion, number: usize) -> Segment {
        Segment::Unknown { motion, symbol: self.scene.symbols.unwanted(number), wanted: false }
    }
}
