//! Stage `dynamics`: common axes for links that turn about parallel ones.
//!
//! In: a tree, regrouped. Out: the same tree, written in other axes: links whose hinges are parallel keep their origins,
//! but get axes that don't turn against each other, so that vectors and inertias pass from one to the next without being
//! turned; each link's own inertia and offsets turn instead, by the sum of the angles. The recursions take components at
//! one instant and never differentiate them, so any axes will do. A planar chain costs one sine and cosine per absolute
//! angle and has nothing else left to turn. A last link that is symmetric about its hinge, as a wheel, is written in axes that its
//! hinge does not turn, whatever the others are written in: no sine of its angle is left.

use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::inertia::Inertia;
use super::newton_euler::Wrench;
use super::tree::{Link, Motion, Tree};

/// Whose axes the links of a group take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SharedAxes {
    /// Those of what the first link hangs on: best for chains of parallel hinges that end there.
    Base,
    /// Those of the last link: best where more hangs on it.
    Tip,
}

/// A tree in common axes.
pub struct Shared {
    pub tree: Tree,
    /// From each link's own axes to those it is written in now: for wrenches that are given in link axes.
    pub turns: Vec<Rotation>,
    /// Each link's own origin from the one that it has now, in its own axes, where they differ: for the same.
    pub ways: Option<Vec<Vector>>,
    /// Whether parallel neighbours have axes in common.
    pub is_joined: bool,
}

impl Shared {
    /// Every link in its own axes, but for symmetric last ones.
    pub fn own(g: &mut Graph, tree: &Tree) -> Shared {
        let mut tree = tree.clone();
        let mut turns = vec![Rotation::IDENTITY; tree.links.len()];
        for (index, turn) in turns.iter_mut().enumerate() {
            if let Some(axis) = symmetric_end(&tree, index) {
                let link = &mut tree.links[index];
                *turn = g.axis_rotation(axis, link.q);
                link.q = Scalar::ZERO;
            }
        }
        Shared { tree, turns, ways: None, is_joined: false }
    }

    /// Wrenches given in link axes about links' own origins, in the axes and about the origins of the tree.
    pub fn turn(&self, g: &mut Graph, wrenches: &[Wrench]) -> Vec<Wrench> {
        let turned = wrenches.iter().zip(&self.turns).enumerate().map(|(index, (w, &r))| {
            let way = self.ways.as_ref().map_or(Vector::ZERO, |ways| ways[index]);
            let lever = g.cross(way, w.force);
            let moment = g.add_vectors(w.moment, lever);
            Wrench { moment: g.rotate(r, moment), force: g.rotate(r, w.force) }
        });
        turned.collect()
    }
}

/// A link's place among its parallel neighbours.
#[derive(Clone, Copy)]
struct Member {
    axis: usize,
    /// First link of the group.
    head: usize,
    /// Whether its axis points along the head's or against.
    reversed: bool,
    /// Nothing before the group turns: angular velocities have the one axis.
    planar: bool,
    /// Sum of the angles from the base, about the head's axis.
    total: Scalar,
}

/// Writes a tree in common axes; `None` if no two neighbours are parallel.
pub fn share_axes(g: &mut Graph, tree: &Tree, axes: SharedAxes) -> Option<Shared> {
    let members = members(g, tree);
    let joined = |(index, member): (usize, &Option<Member>)| member.is_some_and(|m| m.head != index);
    if !members.iter().enumerate().any(joined) {
        return None;
    }
    let references = references(tree, &members, axes);
    // How far each link has turned against its new axes.
    let mut angles = Vec::with_capacity(members.len());
    for member in &members {
        let angle = member.map_or(Scalar::ZERO, |m| {
            let rest = g.sub(m.total, references[m.head]);
            if m.reversed { -rest } else { rest }
        });
        angles.push((member.map_or(0, |m| m.axis), angle));
    }
    let turns: Vec<Rotation> = angles.iter().map(|&(axis, angle)| g.axis_rotation(axis, angle)).collect();
    let mut tree = tree.clone();
    for (index, link) in tree.links.iter_mut().enumerate() {
        if let Some(parent) = link.parent {
            link.offset = g.rotate(turns[parent], link.offset);
        }
        match members[index] {
            Some(m) if m.head != index => link.q = Scalar::ZERO,
            member => {
                if let Some(parent) = link.parent {
                    link.rotation = g.compose(turns[parent], link.rotation);
                }
                if member.is_some() {
                    link.q = g.sub(link.q, angles[index].1);
                }
            }
        }
        let (axis, angle) = angles[index];
        if angle != Scalar::ZERO {
            let planar = members[index].is_some_and(|m| m.planar);
            link.inertia =
                if planar { turn_planar(g, &link.inertia, axis, angle) } else { link.inertia.turn(g, axis, angle) };
        }
    }
    Some(Shared { tree, turns, ways: None, is_joined: true })
}

fn members(g: &mut Graph, tree: &Tree) -> Vec<Option<Member>> {
    let mut members: Vec<Option<Member>> = Vec::with_capacity(tree.links.len());
    for (index, link) in tree.links.iter().enumerate() {
        let Motion::Revolute(axis) = link.motion else {
            members.push(None);
            continue;
        };
        let parent = link.parent.and_then(|p| members[p]);
        let joined = parent.and_then(|parent| join(g, link, axis, parent));
        let planar = || tree.support(link.parent).all(|p| is_straight(&tree.links[p]));
        let alone = || Member { axis, head: index, reversed: false, planar: planar(), total: link.q };
        members.push(Some(joined.unwrap_or_else(alone)));
    }
    members
}

fn is_straight(link: &Link) -> bool {
    matches!(link.motion, Motion::Prismatic(_))
}

/// In the plane only the moment of inertia about the axis counts, which no turn changes.
fn turn_planar(g: &mut Graph, inertia: &Inertia, axis: usize, angle: Scalar) -> Inertia {
    let mut second = [Scalar::ZERO; 6];
    second[(axis + 1) % 3] = inertia.tensor(g, axis, axis);
    let flat = Inertia { second: [Scalar::ZERO; 6], ..*inertia };
    Inertia { second, ..flat.turn(g, axis, angle) }
}

/// The member that a link is, if its axis is its parent's or the opposite.
fn join(g: &mut Graph, link: &Link, axis: usize, parent: Member) -> Option<Member> {
    let along = g.rotation_rows(link.rotation)[parent.axis][axis];
    if along.positive() != Scalar::ONE {
        return None;
    }
    let reversed = parent.reversed != along.is_negative();
    let total = g.add(parent.total, if reversed { -link.q } else { link.q });
    Some(Member { axis, head: parent.head, reversed, planar: parent.planar, total })
}

/// The angle of each group's new axes, at the position of its head.
fn references(tree: &Tree, members: &[Option<Member>], axes: SharedAxes) -> Vec<Scalar> {
    let mut references = vec![Scalar::ZERO; members.len()];
    if axes == SharedAxes::Tip {
        for (index, member) in members.iter().enumerate() {
            if let Some(member) = member.filter(|_| symmetric_end(tree, index).is_none()) {
                references[member.head] = member.total;
            }
        }
    }
    references
}

/// The axis of a hinge whose link carries nothing and looks the same however it is turned.
fn symmetric_end(tree: &Tree, index: usize) -> Option<usize> {
    let link = &tree.links[index];
    let Motion::Revolute(axis) = link.motion else { return None };
    let is_last = tree.links.iter().all(|other| other.parent != Some(index));
    (is_last && link.inertia.is_symmetric(axis)).then_some(axis)
}
