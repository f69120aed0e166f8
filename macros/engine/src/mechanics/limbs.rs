//! Stage `mechanics`: which coordinates belong to limbs that are built alike.
//!
//! In: the checked model. Out: for joints of limbs, which limb and which of its joints. Limbs are branches of one body, or of the
//! ground, with the same kinds of joints in the same order; the outermost count. It is a proposal by form alone: what is
//! worked out together is compared where it is put together (`optimize/packs`), and nothing is wrong where limbs differ.

use std::collections::HashMap;

use crate::contracts::symbol::Symbol;
use crate::model::types::{BodyRef, JointId, Model};
use crate::symbolic::graph::SymbolId;

/// Joints of limbs.
#[derive(Clone, Debug, Default)]
pub struct Limbs {
    joints: HashMap<JointId, Place>,
    /// What symbols stand for that are numbers of limbs (see `strut/apart`).
    pub numbers: HashMap<SymbolId, f64>,
}

/// A joint of a limb.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Which limbs are alike.
    pub set: usize,
    /// The limb among these.
    pub limb: usize,
    /// The joint in its limb.
    pub joint: usize,
}

impl Limbs {
    pub fn of(model: &Model) -> Limbs {
        let mut children: HashMap<BodyRef, Vec<JointId>> = HashMap::new();
        for &id in &model.tree {
            children.entry(model.joints[id].parent.body).or_default().push(id);
        }
        let forest = Forest { model, children };
        let mut limbs = Limbs::default();
        let mut sets = 0;
        let mut carriers = vec![BodyRef::Ground];
        while let Some(carrier) = carriers.pop() {
            let mut alike: Vec<(String, Vec<JointId>)> = Vec::new();
            for &joint in forest.on(carrier) {
                let shape = forest.shape(joint);
                match alike.iter_mut().find(|(known, _)| *known == shape) {
                    Some((_, members)) => members.push(joint),
                    None => alike.push((shape, vec![joint])),
                }
            }
            for (_, members) in alike {
                if let [single] = members[..] {
                    carriers.push(model.joints[single].child.body);
                    continue;
                }
                for (limb, &first) in members.iter().enumerate() {
                    for (joint, id) in forest.branch(first).into_iter().enumerate() {
                        limbs.joints.insert(id, Place { set: sets, limb, joint });
                    }
                }
                sets += 1;
            }
        }
        limbs
    }

    /// With what symbols stand for.
    #[must_use]
    pub fn with_numbers(self, numbers: HashMap<SymbolId, f64>) -> Limbs {
        Limbs { numbers, ..self }
    }

    /// Of a symbol that is a coordinate of a limb.
    pub fn place(&self, symbol: Symbol) -> Option<Place> {
        match symbol {
            Symbol::Position { joint, .. }
            | Symbol::Velocity { joint, .. }
            | Symbol::Acceleration { joint, .. }
            | Symbol::Impulse { joint, .. }
            | Symbol::Momentum { joint, .. } => self.joints.get(&joint).copied(),
            _ => None,
        }
    }
}

struct Forest<'m> {
    model: &'m Model,
    children: HashMap<BodyRef, Vec<JointId>>,
}

impl Forest<'_> {
    fn on(&self, carrier: BodyRef) -> &[JointId] {
        self.children.get(&carrier).map_or(&[], Vec::as_slice)
    }

    /// The joint and all that it carries, parents first.
    fn branch(&self, joint: JointId) -> Vec<JointId> {
        let mut found = vec![joint];
        let mut next = 0;
        while let Some(&joint) = found.get(next) {
            // No joint of the tree carries the ground, on which everything stands.
            if let body @ BodyRef::Body(_) = self.model.joints[joint].child.body {
                found.extend(self.on(body));
            }
            next += 1;
        }
        found
    }

    /// Kinds of joints, each with how many it carries.
    fn shape(&self, joint: JointId) -> String {
        let words = self.branch(joint).into_iter().map(|id| {
            let joint = &self.model.joints[id];
            format!("{}{}", joint.kind.name, self.on(joint.child.body).len())
        });
        words.collect::<Vec<_>>().join(" ")
    }
}
