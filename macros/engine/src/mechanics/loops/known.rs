//! Stage `mechanics`: reductions that are known.
//!
//! In: an [`Equations`] to which nothing was added yet. Out: the same after [`Equations::reduce`], from a copy where one of
//! the same way is known. The functions of a model have some dozen candidates in all. Most of them start with the same
//! definitions of dependent coordinates, which can take longer than what follows. A copy holds all that the derivation has
//! made and what the graph shares at that point, so what follows comes out as if the definitions had been made anew.

use std::rc::Rc;

use crate::dynamics::shared_axes::Axes;
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::{Equations, Method, Style};
use crate::model::types::JointId;
use crate::symbolic::graph::Sharing;

use super::constraints::Writing;
use super::reduction::Reduction;
use super::structure::Structure;

/// What definitions depend on, the model aside.
struct Key {
    structure: Rc<Structure>,
    way: (Style, Method, Option<Axes>, Writing),
    kept: Rc<[JointId]>,
    at_guess: bool,
}

/// A derivation just after its reduction, without its graph.
struct Reduced<'m> {
    key: Key,
    equations: Equations<'m>,
    sharing: Sharing,
    reduction: Reduction,
}

/// Reductions of one model.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct Known<'m>(Vec<Rc<Reduced<'m>>>);

impl<'m> Equations<'m> {
    /// Works out all definitions, or takes them from a derivation that began in the same way.
    pub(in crate::mechanics) fn reduce(&mut self) -> Result<Reduction, Vec<Complaint>> {
        if self.g.size() != self.born {
            return self.define_all();
        }
        if let Some(reduced) = self.known.0.iter().find(|reduced| self.is_like(&reduced.key)) {
            let reduced = Rc::clone(reduced);
            self.g.share(&reduced.sharing);
            let graph = std::mem::take(&mut self.g);
            *self = Equations {
                g: graph,
                lumped: self.lumped,
                branches: std::mem::take(&mut self.branches),
                known: std::mem::take(&mut self.known),
                ..reduced.equations.clone()
            };
            return Ok(reduced.reduction.clone());
        }
        let decided = self.branches.len();
        let reduction = self.define_all()?;
        // Where signs were decided, the graph has seen more than the definitions.
        if self.branches.len() == decided {
            let reduced = Reduced {
                key: self.key(),
                sharing: self.g.sharing(),
                reduction: reduction.clone(),
                equations: self.without_graph(),
            };
            self.known.0.push(Rc::new(reduced));
        }
        Ok(reduction)
    }

    fn key(&self) -> Key {
        Key {
            structure: Rc::clone(&self.structure),
            way: (self.style, self.method, self.axes, self.writing),
            kept: Rc::clone(&self.kept),
            at_guess: self.at_guess,
        }
    }

    fn is_like(&self, key: &Key) -> bool {
        Rc::ptr_eq(&self.structure, &key.structure)
            && (self.style, self.method, self.axes, self.writing) == key.way
            && self.kept == key.kept
            && self.at_guess == key.at_guess
    }

    /// A copy of all but the graph and what goes from one derivation to the next.
    fn without_graph(&mut self) -> Equations<'m> {
        let passed = (std::mem::take(&mut self.g), std::mem::take(&mut self.branches), std::mem::take(&mut self.known));
        let copy = self.clone();
        (self.g, self.branches, self.known) = passed;
        copy
    }
}
