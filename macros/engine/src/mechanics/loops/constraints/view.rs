//! Stage `mechanics`: points and directions as another frame sees them.
//!
//! In: a frame on the tree to look from. Out: components in its axes. A point climbs from its link to the last link that
//! carries both and descends to the frame, turn by turn (Horner's scheme); or it is taken in world axes from the rotations
//! that all closings share. Where the frame is the one that a chain's first joint stands on, the chain ends there and
//! never passes the constant placement.

use std::rc::Rc;

use crate::dynamics::point_kinematics::PointKinematics;
use crate::mechanics::equations::Equations;
use crate::mechanics::scene::Style;
use crate::mechanics::translate::build::FixedFrame;
use crate::symbolic::graph::{Rotation, Scalar, Vector};
use crate::symbolic::rotations;

use super::{ClosedIn, Writing};

/// A frame to look from.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub place: FixedFrame,
    /// The link whose joint stands in this very frame.
    first: Option<usize>,
    style: Style,
}

impl View {
    /// Whether a side's point comes from the shared world rotations.
    pub(super) fn shares(&self, carried: bool) -> bool {
        self.style == Style::World && self.place.link.is_none() && !carried
    }
}

impl Equations<'_> {
    /// The frame that a writing means for a closing between two frames.
    pub(super) fn view(&mut self, ends: &[FixedFrame; 2], writing: Writing) -> View {
        let common = self.common(ends[0].link, ends[1].link);
        let (place, first) = match writing.axes {
            ClosedIn::Parent => (ends[0], None),
            ClosedIn::Child => (ends[1], None),
            ClosedIn::World => (FixedFrame::GROUND, None),
            ClosedIn::Common => (FixedFrame { link: common, ..FixedFrame::GROUND }, None),
            ClosedIn::ParentBase => self.base_of(&ends[0], common),
            ClosedIn::ChildBase => self.base_of(&ends[1], common),
        };
        View { place, first, style: writing.style }
    }

    /// The frame that the first joint beyond `common` stands in, on the way to a frame.
    fn base_of(&self, end: &FixedFrame, common: Option<usize>) -> (FixedFrame, Option<usize>) {
        let tree = &self.scene.mechanism.tree;
        let Some(&first) = tree.path(common, end.link).first() else { return (*end, None) };
        let link = &tree.links[first];
        (FixedFrame { link: common, rotation: link.rotation, offset: link.offset }, Some(first))
    }

    /// The link whose joint stands in the view's frame, if another hangs on it.
    pub(super) fn hangs_on(&self, view: &View, link: Option<usize>) -> Option<usize> {
        view.first.filter(|&first| self.common(link, Some(first)) == Some(first))
    }

    /// A frame's origin, from the view's origin in its axes.
    pub(super) fn see_point(&mut self, view: &View, point: &FixedFrame) -> Vector {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        if let Some(first) = self.hangs_on(view, point.link) {
            let mut kinematics = PointKinematics::new(tree, point.offset, 0, &[]);
            kinematics.up_to(&mut self.g, point.link, Some(first));
            kinematics.leave(&mut self.g, &tree.links[first]);
            return kinematics.local(&mut self.g)[0];
        }
        let to = view.place;
        if point.link == to.link {
            let way = self.g.sub_vectors(point.offset, to.offset);
            return rotations::rotate(&mut self.g, to.rotation.transpose(), way);
        }
        let mut seen = if view.shares(false) {
            self.caches.world.point(&mut self.g, tree, point.link, point.offset)
        } else {
            let common = self.common(point.link, to.link);
            let mut kinematics = PointKinematics::new(tree, point.offset, 0, &[]);
            kinematics.up_to(&mut self.g, point.link, common);
            let seen = kinematics.local(&mut self.g)[0];
            self.descend(common, to.link, seen)
        };
        seen = self.g.sub_vectors(seen, to.offset);
        self.g.rotate(to.rotation.transpose(), seen)
    }

    /// A point as a link further out sees it.
    fn descend(&mut self, from: Option<usize>, to: Option<usize>, mut point: Vector) -> Vector {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        let g = &mut self.g;
        for index in tree.path(from, to) {
            let link = &tree.links[index];
            let arm = g.sub_vectors(point, link.offset);
            point = g.rotate(link.rotation.transpose(), arm);
            let travel = link.travel(g);
            point = g.sub_vectors(point, travel);
            let turn = link.turn(g);
            point = g.rotate(turn.transpose(), point);
        }
        point
    }

    /// A vector of a link's axes in the view's.
    pub(super) fn see_vector(&mut self, view: &View, link: Option<usize>, v: Vector) -> Vector {
        if v == Vector::ZERO {
            return v;
        }
        let mechanism = Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        let to = view.place;
        if let Some(first) = self.hangs_on(view, link) {
            let turns = self.turns_from(first, link);
            return self.g.rotate(turns, v);
        }
        let seen = if link == to.link {
            return rotations::rotate(&mut self.g, to.rotation.transpose(), v);
        } else if view.shares(false) {
            self.caches.world.rotate(&mut self.g, tree, link, v)
        } else {
            self.between(link, to.link, v)
        };
        self.g.rotate(to.rotation.transpose(), seen)
    }

    /// Rotation from a link's axes to those of the frame that the joint of `first` stands in.
    fn turns_from(&mut self, first: usize, link: Option<usize>) -> Rotation {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        let mut rotation = Rotation::IDENTITY;
        for (k, index) in tree.path(tree.links[first].parent, link).into_iter().enumerate() {
            let link = &tree.links[index];
            if k > 0 {
                rotation = self.g.compose(rotation, link.rotation);
            }
            let turn = link.turn(&mut self.g);
            rotation = self.g.compose(rotation, turn);
        }
        rotation
    }

    /// A vector of the view's axes in a link's.
    pub(super) fn unsee(&mut self, view: &View, v: Vector, link: Option<usize>) -> Vector {
        if v == Vector::ZERO {
            return v;
        }
        if let Some(first) = self.hangs_on(view, link) {
            let turns = self.turns_from(first, link);
            return self.g.rotate(turns.transpose(), v);
        }
        let v = self.g.rotate(view.place.rotation, v);
        self.between(view.place.link, link, v)
    }

    /// The way from the first frame's origin to the second's, in the axes of a writing.
    pub(super) fn way_in(&mut self, ends: &[FixedFrame; 2], writing: Writing) -> Vector {
        let view = self.view(ends, writing);
        self.see_way(&view, ends)
    }

    pub(super) fn see_way(&mut self, view: &View, ends: &[FixedFrame; 2]) -> Vector {
        let [from, to] = [self.see_point(view, &ends[0]), self.see_point(view, &ends[1])];
        self.g.sub_vectors(to, from)
    }

    /// A coordinate axis of a frame, in its link's axes.
    pub(super) fn axis_in_link(&mut self, place: &FixedFrame, axis: usize) -> Vector {
        let unit = self.g.along(axis, Scalar::ONE);
        rotations::rotate(&mut self.g, place.rotation, unit)
    }
}
