//! Stage `mechanics`: how far one frame has turned against another, whole turns included.
//!
//! In: two frames on the tree and an axis of theirs. Out: the angle as the sum of the coordinates that turn about it. A
//! rotation knows an angle up to whole turns only, which is not enough where an angle counts as a length: a nut travels on
//! with every turn of its thread. Coordinates know the turns. Their sum is the angle where it and the rotation differ by
//! what no coordinate changes, that is where everything between the frames turns about the axis or not at all: this is
//! asked of the graph, so what is hidden behind frames, couplings of axes and the like needs no rule. The constant left
//! over is taken between minus and plus half a turn.

use std::rc::Rc;

use crate::contracts::call::Call;
use crate::dynamics::tree::Motion;
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::build::FixedFrame;
use crate::symbolic::graph::Scalar;

use super::view::View;

impl Equations<'_> {
    /// The angle of the second frame against the first about their axis number `axis`; nothing where the coordinates
    /// don't tell how many turns it holds.
    pub(super) fn winding(&mut self, view: &View, ends: &[FixedFrame; 2], axis: usize) -> Option<Scalar> {
        let common = self.common(ends[0].link, ends[1].link);
        let [parent, child] = [self.turns_about(&ends[0], axis, common), self.turns_about(&ends[1], axis, common)];
        let turns = self.g.sub(child, parent);
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let [from, other] = [i, j].map(|k| self.see_axis(view, &ends[0], k));
        let to = self.see_axis(view, &ends[1], i);
        let (c, s) = (self.g.dot(to, from), self.g.dot(to, other));
        // The rotation less the coordinates.
        let (cos, sin) = (self.g.cos(turns), self.g.sin(turns));
        let g = &mut self.g;
        let products = [g.mul(c, cos), g.mul(s, sin), g.mul(s, cos), -g.mul(c, sin)];
        let (cos, sin) = (g.sum(&products[..2]), g.sum(&products[2..]));
        let moves: Vec<Scalar> = self.scene.symbols.positions.concat();
        if self.g.depends_on(cos, &moves) || self.g.depends_on(sin, &moves) {
            return None;
        }
        // As frames know it, even where it was written as an angle of several turns.
        let literal = self.g.literal(cos).is_some() && self.g.literal(sin).is_some();
        let rest = if literal { self.g.angle(cos, sin) } else { self.g.call(Call::Atan2, &[sin, cos]) };
        Some(self.g.add(turns, rest))
    }

    /// Sum of the coordinates between a frame and a link that carries it which turn about an axis of the frame.
    fn turns_about(&mut self, end: &FixedFrame, axis: usize, carrier: Option<usize>) -> Scalar {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        let mut direction = self.axis_in_link(end, axis);
        let mut turns = Scalar::ZERO;
        for index in tree.path(carrier, end.link).into_iter().rev() {
            let (g, link) = (&mut self.g, &tree.links[index]);
            if let Motion::Revolute(k) | Motion::Screw(k, _) = link.motion {
                turns = match g.component(direction, k) {
                    Scalar::ONE => g.add(turns, link.q),
                    s if s == -Scalar::ONE => g.sub(turns, link.q),
                    _ => turns,
                };
            }
            let rotation = tree.rotation(g, link);
            direction = g.rotate(rotation, direction);
        }
        turns
    }
}
