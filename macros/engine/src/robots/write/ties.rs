//! Stage `robots`: what a robot has beside its tree, in the language.
//!
//! In: closures, couplings and mimicking joints. Out: joints that close loops, as `#[cut]` says, and constraints.

use std::fmt::Write;

use super::super::angles;
use super::super::mistake::{Mistake, Place};
use super::super::robot::{Closure, Coupling, Joint, Kind};
use super::{Fault, Writer, along, word};

impl Writer<'_> {
    /// Joints beyond the tree, where both of their links are there.
    pub(super) fn closures(&mut self) -> Result<(), Fault> {
        for Closure { name, at, kind, axis, parent, child, in_parent, in_child } in &self.robot.closures {
            let [a, b] = [self.end(name, parent, *at)?, self.end(name, child, *at)?];
            if !self.kept[a] || !self.kept[b] {
                continue;
            }
            let a = self.frame(self.names.links[a].clone(), in_parent, name);
            let b = self.frame(self.names.links[b].clone(), in_child, name);
            let own = self.names.own(name, *at)?;
            self.document(*at);
            let (word, axis) = (word(*kind), along(axis.as_ref()));
            let _ = writeln!(self.items, "#[cut]\njoint {own}: {word} {{ parent: {a}, child: {b}{axis} }}");
        }
        Ok(())
    }

    /// Gears and belts, where both of their links are there.
    pub(super) fn couplings(&mut self) -> Result<(), Fault> {
        for Coupling { name, at, ratio, predecessor, successor } in &self.robot.couplings {
            let [a, b] = [self.end(name, predecessor, *at)?, self.end(name, successor, *at)?];
            if !self.kept[a] || !self.kept[b] {
                continue;
            }
            let [leading, following] = self.tree.ways(a, b);
            let is_fixed = |joint: &usize| self.robot.joints[*joint].kind == Kind::Fixed;
            if leading.iter().chain(&following).all(is_fixed) {
                return Err(Mistake::at(*at, format!("`{name}` couples no joint that moves")).into());
            }
            let sums = [self.sum(name, &leading, *at)?, self.sum(name, &following, *at)?];
            let (ratio, own) = (angles::signed(ratio), self.names.own(name, *at)?);
            let difference = match sums {
                [Some(leading), Some(following)] => format!("({ratio}) * ({leading}) - ({following})"),
                // The other side has no coordinate: it is zero.
                [Some(sum), None] | [None, Some(sum)] => sum,
                // All that it couples is locked.
                [None, None] => continue,
            };
            self.document(*at);
            let _ = writeln!(self.items, "constraint {own} = {difference};");
        }
        Ok(())
    }

    /// Of the coordinates of joints that move; nothing if none does.
    fn sum(&self, tie: &str, joints: &[usize], at: Place) -> Result<Option<String>, Mistake> {
        let mut terms = Vec::new();
        for &joint in joints.iter().rev() {
            let Joint { name, kind, .. } = &self.robot.joints[joint];
            if *kind == Kind::Fixed || self.locked[joint] {
                continue;
            }
            let Some(coordinate) = coordinate(*kind) else {
                let message = format!("`{tie}` couples the joint `{name}`, which has not one coordinate");
                return Err(Mistake::at(at, message));
            };
            terms.push(format!("{}.{coordinate}", self.names.joints[joint]));
        }
        Ok(Some(terms.join(" + ")).filter(|sum| !sum.is_empty()))
    }

    fn end(&self, tie: &str, link: &str, at: Place) -> Result<usize, Mistake> {
        let message = || format!("`{tie}` names the link `{link}`, which isn't there");
        self.robot.links.iter().position(|other| other.name == link).ok_or_else(|| Mistake::at(at, message()))
    }

    pub(super) fn mimic(&mut self, joint: &Joint, name: &str, kind: Kind) -> Result<(), Fault> {
        let Some(mimic) = &joint.mimic else { return Ok(()) };
        let find = |found: &Joint| found.name == mimic.joint;
        let Some(other) = self.robot.joints.iter().position(find) else {
            let message = format!("joint `{}` mimics `{}`, which isn't there", joint.name, mimic.joint);
            return Err(Mistake::at(mimic.at, message).into());
        };
        let leader = &self.robot.joints[other];
        if leader.name == joint.name {
            return Err(Mistake::at(mimic.at, format!("joint `{}` mimics itself", joint.name)).into());
        }
        if kind == Kind::Fixed {
            return Ok(());
        }
        let is_there = self.robot.links.iter().position(|link| link.name == leader.child).is_some_and(|k| self.kept[k]);
        if self.locked[other] || !is_there {
            let message = format!("joint `{}` mimics `{}`, which is locked or dropped", joint.name, leader.name);
            return Err(Mistake::at(mimic.at, message).help("lock or drop it too").into());
        }
        let only = |kind: Kind, joint: &str| {
            let message = || format!("joint `{joint}` has not one coordinate: it neither mimics nor is mimicked");
            coordinate(kind).ok_or_else(|| Mistake::at(mimic.at, message()))
        };
        let (own, leading) = (only(kind, &joint.name)?, only(leader.kind, &leader.name)?);
        let constraint = self.names.free(&format!("{name}_mimic"));
        let leader = self.names.joints[other].clone();
        let (multiplier, offset) = (angles::signed(&mimic.multiplier), angles::signed(&mimic.offset));
        let offset = if mimic.offset.value == 0.0 { String::new() } else { format!(" - ({offset})") };
        self.document(mimic.at);
        let _ = writeln!(
            self.items,
            "constraint {constraint} = {name}.{own} - ({multiplier}) * {leader}.{leading}{offset};"
        );
        Ok(())
    }
}

/// The name of a joint's only coordinate.
fn coordinate(kind: Kind) -> Option<&'static str> {
    match kind {
        Kind::Revolute => Some("angle"),
        Kind::Prismatic => Some("travel"),
        Kind::Fixed | Kind::Planar | Kind::Ball | Kind::Floating => None,
    }
}
