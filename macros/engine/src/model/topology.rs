//! Stage `model`: how the bodies hang together.
//!
//! In: bodies and joints. Out: the spanning tree from the ground, parents before children, and the joints that close
//! loops; errors for bodies that no joint reaches and for joints written against the tree.
//!
//! The tree is the one with the fewest coordinates: each joint costs its freedoms, so the joints that close loops are
//! those that give the fewest equations; of equals the later one closes. A `Free` joint costs nothing: as a closing one it
//! would say nothing at all, it stands there for its coordinates. A body with absolute coordinates hangs on the ground,
//! and the joints at it are taken into the tree only for bodies that nothing else reaches.

use std::collections::BTreeSet;

use super::arborescence::{self, Edge};
use super::checker::Checker;
use super::types::{Bodies, BodyId, BodyRef, ExprNode, Joint, JointId, Joints, Place};
use crate::invariant::index_vec::IndexVec;
use crate::syntax::tree;

/// What hangs on what.
pub(super) struct Topology {
    /// Parents before children, in source order as far as that goes.
    pub(super) tree: Vec<JointId>,
    /// Joints that close loops, in source order.
    pub(super) cuts: Vec<JointId>,
    /// `#[cut]`s that another choice of coordinates has made void.
    pub(super) skipped: Vec<String>,
}

impl Topology {
    pub(super) fn is_cut(&self, joint: JointId) -> bool {
        self.cuts.binary_search(&joint).is_ok()
    }

    /// The joint that carries a body.
    pub(super) fn carrier(&self, body: BodyRef, joints: &Joints) -> Option<JointId> {
        self.tree.iter().copied().find(|id| joints[*id].child.body == body)
    }
}

/// Weights of joints in the tree, so far apart that a sum over all joints keeps their order: `#[cut]`, then whether the
/// joint has no armature (a rotor costs more where its rate is measured), then whether the parent is absolute, then
/// freedoms, and source order last.
const FREEDOM: i128 = 1 << 30;
const AT_ABSOLUTE: i128 = 1 << 48;
const NO_ARMATURE: i128 = 1 << 60;
const CUT: i128 = 1 << 72;

impl Checker<'_, '_> {
    /// The tree that costs least, and what is left over.
    pub(super) fn topology(&mut self, bodies: &Bodies, joints: &Joints, module: &tree::Module) -> Option<Topology> {
        if bodies.is_empty() && self.report.failed() {
            return None;
        }
        if bodies.is_empty() {
            let message = format!("the model `{}` has no body", module.name);
            self.report.help(module.name.span(), message, "write `body name { mass: 1.0 }` and a joint that holds it");
            return None;
        }
        let cuts: Marks = joints.ids().map(|id| self.says_cut(id)).collect();
        // Where the formulation sets all coordinates, `#[cut]` is a wish.
        let firm = self.coordinates.is_none();
        let usable: Marks = cuts.iter().map(|cut| !(firm && *cut)).collect();
        let follow: Marks = joints.iter_ids().map(|(id, joint)| usable[id] && self.may_carry(id, joint)).collect();
        self.connected(bodies, joints, &usable, follow.clone()).then_some(())?;
        let all: Marks = joints.iter().map(|_| true).collect();
        let chosen = self.cheapest(bodies, joints, &cuts, &follow).unwrap_or_else(|| {
            // Any tree is a good one.
            let mut walk = Walk::new(bodies.len(), joints, &all, follow);
            walk.reach(BodyRef::Ground);
            walk.run();
            joints.ids().map(|id| walk.tree.contains(&id)).collect()
        });
        let mut walk = Walk::new(bodies.len(), joints, &all, chosen.clone());
        walk.reach(BodyRef::Ground);
        walk.run();
        let closing = joints.ids().filter(|id| !chosen[*id]);
        let void = chosen.iter().zip(&cuts).zip(joints).filter(|((chosen, cut), _)| **chosen && **cut);
        let skipped = void.map(|(_, joint)| {
            format!("`#[cut]` of `{}`: with these coordinates the joint lies in the tree", self.path_text(&joint.place))
        });
        Some(Topology { skipped: skipped.collect(), tree: walk.tree, cuts: closing.collect() })
    }

    /// Whether the joint may be the one that carries its child.
    fn may_carry(&self, id: JointId, joint: &Joint) -> bool {
        joint.child.body != BodyRef::Ground && self.own_joint(joint.child.body).is_none_or(|own| own == id)
    }

    /// Reports bodies that are not reached from the ground, or only against the direction of a joint.
    fn connected(&mut self, bodies: &Bodies, joints: &Joints, usable: &Marks, follow: Marks) -> bool {
        let mut walk = Walk::new(bodies.len(), joints, usable, follow);
        walk.reach(BodyRef::Ground);
        let mut sound = true;
        loop {
            walk.run();
            if let Some(id) = walk.against_the_tree() {
                self.report_against(&joints[id]);
                walk.reach(joints[id].parent.body);
                sound = false;
                continue;
            }
            let Some(first) = walk.unreached() else { break };
            let group = walk.group(first);
            match self.held_by_cut(&group, joints) {
                Some(joint) => {
                    let body = &bodies[first].place.field;
                    let name = &joint.place.field;
                    self.report.help(
                        joint.span,
                        format!("the joint `{name}` can't be cut: nothing else holds the body `{body}`"),
                        "remove the `#[cut]`, or give the body a joint of its own",
                    );
                }
                None => self.report_disconnected(first, &group, bodies),
            }
            sound = false;
            walk.reach(BodyRef::Body(first));
        }
        sound
    }

    fn report_against(&mut self, joint: &Joint) {
        let name = &joint.place.field;
        if joint.child.body == BodyRef::Ground {
            let message = format!("the child of the joint `{name}` is the ground, which cannot move");
            self.report.help(joint.child.span, message, "swap `parent` and `child`");
            return;
        }
        self.report.help(
            joint.span,
            format!("the joint `{name}` leads towards the ground: its parent hangs on its child"),
            "swap `parent` and `child`",
        );
    }

    /// A cut joint that holds one of these bodies to something else.
    fn held_by_cut<'j>(&self, group: &[BodyId], joints: &'j Joints) -> Option<&'j Joint> {
        let inside = |body: BodyRef| matches!(body, BodyRef::Body(id) if group.binary_search(&id).is_ok());
        let mut joints = joints.iter_ids();
        let found =
            joints.find(|(id, joint)| self.says_cut(*id) && inside(joint.child.body) != inside(joint.parent.body));
        found.map(|(_, joint)| joint)
    }

    /// Which joints the cheapest tree is made of.
    fn cheapest(&self, bodies: &Bodies, joints: &Joints, cuts: &Marks, follow: &Marks) -> Option<Marks> {
        let node = |body| match body {
            BodyRef::Ground => bodies.len(),
            BodyRef::Body(id) => id.0,
        };
        let mut origins = Vec::new();
        let mut edges = Vec::new();
        for (id, joint) in joints.iter_ids().filter(|(id, _)| follow[*id]) {
            let freedoms = if joint.kind.is_free() { 0 } else { i128::try_from(joint.kind.freedoms()).ok()? + 1 };
            let absolute = self.own_joint(joint.parent.body).is_some();
            let mut weight = freedoms * FREEDOM + i128::try_from(id.0).ok()?;
            weight += i128::from(absolute) * AT_ABSOLUTE + i128::from(cuts[id]) * CUT;
            weight += i128::from(!has_armature(joint)) * NO_ARMATURE;
            origins.push(id);
            edges.push(Edge { from: node(joint.parent.body), to: node(joint.child.body), weight });
        }
        let best = arborescence::cheapest(bodies.len() + 1, bodies.len(), &edges)?;
        let mut chosen: Marks = joints.iter().map(|_| false).collect();
        for position in best.into_iter().flatten() {
            chosen[origins[position]] = true;
        }
        Some(chosen)
    }

    pub(super) fn says_cut(&self, joint: JointId) -> bool {
        self.joints[joint].item.attrs.iter().any(|a| a.path().is_ident("cut"))
    }

    /// Whether coordinates of the joint are measured where it closes a loop: it lies between bodies that stand in the tree by
    /// themselves.
    pub(super) fn is_measured(&self, joint: &Joint) -> bool {
        let own = match joint.child.body {
            BodyRef::Ground => joint.parent.body,
            body => body,
        };
        self.own_joint(own).is_some()
    }

    /// Refuses coordinates of joints that have none.
    pub(super) fn check_coordinate_uses(&mut self, topology: &Topology, joints: &Joints) {
        for (id, span) in std::mem::take(&mut self.coordinate_uses) {
            if topology.is_cut(id) && !self.is_measured(&joints[id]) {
                self.refuse_cut_coordinate(id, span, joints);
            }
        }
    }

    pub(super) fn refuse_cut_coordinate(&mut self, id: JointId, span: proc_macro2::Span, joints: &Joints) {
        let joint = &joints[id];
        let help = if self.coordinates.is_some() {
            "with the coordinates that `formulation` sets it has none; take what frames have, such as `.position`"
        } else if self.says_cut(id) {
            "take coordinates of the joints in the tree, or cut another joint of the loop"
        } else {
            "take coordinates of the joints in the tree, or choose another cut: `#[cut]` on another joint of the loop"
        };
        let message = format!("the joint `{}` closes a loop and has no coordinates", joint.place.field);
        self.report.help(span, message, help);
    }

    /// `legs[2].ball`
    pub(super) fn path_text(&self, place: &Place) -> String {
        let mut text = place.field.to_string();
        let mut instance = &self.instances[place.instance];
        while let Some(parent) = instance.parent {
            text = match instance.index {
                Some((k, _)) => format!("{}[{k}].{text}", instance.field),
                None => format!("{}.{text}", instance.field),
            };
            instance = &self.instances[parent];
        }
        text
    }

    fn report_disconnected(&mut self, first: BodyId, group: &[BodyId], bodies: &Bodies) {
        let body = &bodies[first];
        let name = &body.place.field;
        let others: Vec<String> = group
            .iter()
            .filter(|id| **id != first)
            .take(5)
            .map(|id| format!("`{}`", bodies[*id].place.field))
            .collect();
        let with =
            if others.is_empty() { String::new() } else { format!(", nor is what hangs on it: {}", others.join(", ")) };
        self.report.help(
            body.span,
            format!("the body `{name}` is not connected to the ground{with}"),
            format!("write `joint ..: Free {{ parent: ground, child: {name} }}` if it is to move freely"),
        );
    }
}

/// Whether a joint has an armature that may differ from zero.
fn has_armature(joint: &Joint) -> bool {
    joint.armature.as_ref().is_some_and(|armature| !matches!(*armature.node, ExprNode::Number(0.0)))
}

/// What is said of each joint.
type Marks = IndexVec<JointId, bool>;

/// A walk from the ground over joints.
struct Walk<'j> {
    joints: &'j Joints,
    /// Joints that may be followed from parent to child.
    follow: Marks,
    /// Joints at each body, and at the ground as the last entry.
    at: Vec<Vec<JointId>>,
    reached: Vec<bool>,
    /// Joints whose parent is reached and that were not looked at.
    ready: BTreeSet<JointId>,
    /// Joints whose child is reached and whose parent was not.
    against: BTreeSet<JointId>,
    /// All bodies before this one are reached.
    searched: usize,
    tree: Vec<JointId>,
}

impl<'j> Walk<'j> {
    /// Over the `usable` joints; others are not there.
    fn new(bodies: usize, joints: &'j Joints, usable: &Marks, follow: Marks) -> Self {
        let mut walk = Walk {
            joints,
            follow,
            at: vec![Vec::new(); bodies + 1],
            reached: vec![false; bodies + 1],
            ready: BTreeSet::new(),
            against: BTreeSet::new(),
            searched: 0,
            tree: Vec::new(),
        };
        for (id, joint) in joints.iter_ids().filter(|(id, _)| usable[*id]) {
            for body in [joint.parent.body, joint.child.body] {
                let slot = walk.slot(body);
                walk.at[slot].push(id);
            }
        }
        walk
    }

    fn slot(&self, body: BodyRef) -> usize {
        match body {
            BodyRef::Ground => self.at.len() - 1,
            BodyRef::Body(id) => id.0,
        }
    }

    fn is_reached(&self, body: BodyRef) -> bool {
        self.reached[self.slot(body)]
    }

    fn reach(&mut self, body: BodyRef) {
        let slot = self.slot(body);
        self.reached[slot] = true;
        for &id in &self.at[slot] {
            if self.joints[id].parent.body != body {
                self.against.insert(id);
            } else if self.follow[id] {
                self.ready.insert(id);
            }
        }
    }

    /// Follows joints from parents to children until no new body is found.
    fn run(&mut self) {
        while let Some(id) = self.ready.pop_first() {
            let child = self.joints[id].child.body;
            if !self.is_reached(child) {
                self.tree.push(id);
                self.reach(child);
            }
        }
    }

    /// The first joint that could only be followed from child to parent.
    fn against_the_tree(&mut self) -> Option<JointId> {
        while let Some(id) = self.against.pop_first() {
            if !self.is_reached(self.joints[id].parent.body) {
                return Some(id);
            }
        }
        None
    }

    /// The first body that hangs on nothing; preferably one that is no joint's child.
    fn unreached(&mut self) -> Option<BodyId> {
        let bodies = self.at.len() - 1;
        while self.searched < bodies && self.is_reached(BodyRef::Body(BodyId(self.searched))) {
            self.searched += 1;
        }
        if self.searched >= bodies {
            return None;
        }
        let group = self.group(BodyId(self.searched));
        let is_child = |id: &BodyId| {
            let mut joints = self.joints.iter();
            joints.any(|joint| joint.child.body == BodyRef::Body(*id))
        };
        // Searched only in small groups: the choice is a courtesy.
        let root = (group.len() < 100).then(|| group.iter().find(|id| !is_child(id))).flatten();
        root.or(group.first()).copied()
    }

    /// All bodies that are joined to this one, in source order.
    fn group(&self, first: BodyId) -> Vec<BodyId> {
        let mut found: BTreeSet<usize> = BTreeSet::from([first.0]);
        let mut open = vec![first.0];
        while let Some(slot) = open.pop() {
            for &id in &self.at[slot] {
                let joint = &self.joints[id];
                for body in [joint.parent.body, joint.child.body] {
                    if let BodyRef::Body(id) = body
                        && found.insert(id.0)
                    {
                        open.push(id.0);
                    }
                }
            }
        }
        found.into_iter().map(BodyId).collect()
    }
}
