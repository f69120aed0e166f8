//! Stage `model`: how the bodies hang together.
//!
//! In: bodies and joints. Out: the spanning tree from the ground, parents before children; errors for bodies that no
//! joint reaches, for joints written against the tree, and for loops.

use std::collections::BTreeSet;

use super::checker::Checker;
use super::types::{Body, BodyId, BodyRef, Joint, JointId};
use crate::syntax::tree;

impl Checker<'_, '_> {
    /// The joints towards the ground, one per body, in source order as far as parents come first.
    pub(super) fn tree(&mut self, bodies: &[Body], joints: &[Joint], module: &tree::Module) -> Option<Vec<JointId>> {
        if bodies.is_empty() && self.report.failed() {
            return None;
        }
        if bodies.is_empty() {
            let message = format!("the model `{}` has no body", module.name);
            self.report.help(module.name.span(), message, "write `body name { mass: 1.0 }` and a joint that holds it");
            return None;
        }
        let mut walk = Walk::new(bodies.len(), joints);
        walk.reach(BodyRef::Ground);
        let mut sound = true;
        loop {
            walk.run();
            if let Some(id) = walk.against_the_tree() {
                if let Some(joint) = joints.get(id.0) {
                    let name = &joint.place.field;
                    self.report.help(
                        joint.span,
                        format!("the joint `{name}` leads towards the ground: its parent hangs on its child"),
                        "swap `parent` and `child`",
                    );
                    walk.used.insert(id.0);
                    walk.reach(joint.parent.body);
                }
                sound = false;
                continue;
            }
            let Some(first) = walk.unreached() else { break };
            self.report_disconnected(first, &walk.group(first), bodies);
            sound = false;
            walk.reach(BodyRef::Body(first));
        }
        for (index, joint) in joints.iter().enumerate() {
            if walk.used.contains(&index) {
                continue;
            }
            sound = false;
            // Of a cut joint it has been said.
            if !self.is_cut(index) {
                let name = &joint.place.field;
                self.report.help(
                    joint.span,
                    format!("the joint `{name}` closes a loop: loops are not available yet"),
                    "every body hangs on one joint for now",
                );
            }
        }
        sound.then_some(walk.tree)
    }

    fn is_cut(&self, joint: usize) -> bool {
        let slot = self.joints.get(joint);
        slot.is_some_and(|slot| slot.item.attrs.iter().any(|a| a.path().is_ident("cut")))
    }

    fn report_disconnected(&mut self, first: BodyId, group: &[BodyId], bodies: &[Body]) {
        let Some(body) = bodies.get(first.0) else {
            return;
        };
        let name = &body.place.field;
        let others: Vec<String> = group
            .iter()
            .filter(|id| **id != first)
            .filter_map(|id| bodies.get(id.0))
            .take(5)
            .map(|body| format!("`{}`", body.place.field))
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

/// A walk from the ground over joints.
struct Walk<'j> {
    joints: &'j [Joint],
    /// Joints at each body, and at the ground as the last entry.
    at: Vec<Vec<usize>>,
    reached: Vec<bool>,
    /// Joints whose parent is reached and that were not looked at.
    ready: BTreeSet<usize>,
    /// Joints of the tree, those against it included.
    used: BTreeSet<usize>,
    /// Joints whose child is reached and whose parent was not.
    against: BTreeSet<usize>,
    /// All bodies before this one are reached.
    searched: usize,
    tree: Vec<JointId>,
}

impl<'j> Walk<'j> {
    fn new(bodies: usize, joints: &'j [Joint]) -> Self {
        let mut walk = Walk {
            joints,
            at: vec![Vec::new(); bodies + 1],
            reached: vec![false; bodies + 1],
            ready: BTreeSet::new(),
            used: BTreeSet::new(),
            against: BTreeSet::new(),
            searched: 0,
            tree: Vec::new(),
        };
        for (index, joint) in joints.iter().enumerate() {
            for body in [joint.parent.body, joint.child.body] {
                let slot = walk.slot(body);
                if let Some(list) = walk.at.get_mut(slot) {
                    list.push(index);
                }
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
        self.reached.get(self.slot(body)).copied().unwrap_or(true)
    }

    fn reach(&mut self, body: BodyRef) {
        let slot = self.slot(body);
        if let Some(reached) = self.reached.get_mut(slot) {
            *reached = true;
        }
        let touching = self.at.get(slot).cloned().unwrap_or_default();
        for index in touching {
            let Some(joint) = self.joints.get(index) else {
                continue;
            };
            if joint.parent.body == body {
                self.ready.insert(index);
            } else {
                self.against.insert(index);
            }
        }
    }

    /// Follows joints from parents to children until no new body is found.
    fn run(&mut self) {
        while let Some(index) = self.ready.pop_first() {
            let Some(joint) = self.joints.get(index) else {
                continue;
            };
            if !self.is_reached(joint.child.body) {
                self.used.insert(index);
                self.tree.push(JointId(index));
                self.reach(joint.child.body);
            }
        }
    }

    /// The first joint that could only be followed from child to parent.
    fn against_the_tree(&mut self) -> Option<JointId> {
        while let Some(index) = self.against.pop_first() {
            let joint = self.joints.get(index)?;
            if !self.is_reached(joint.parent.body) {
                return Some(JointId(index));
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
            for index in self.at.get(slot).into_iter().flatten() {
                let Some(joint) = self.joints.get(*index) else {
                    continue;
                };
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
