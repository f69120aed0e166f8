//! Stage `mechanics`: what is decided once for all derivations of a model.
//!
//! In: an [`Equations`] to which nothing was added yet. Out: the same after [`Equations::reduce`], from a copy where one of
//! the same way is known. The functions of a model have some dozen candidates in all. Most of them start with the same
//! definitions of dependent coordinates, which can take longer than what follows. A copy holds all that the derivation has
//! made and what the graph shares at that point, so what follows comes out as if the definitions had been made anew.

use crate::symbolic::graph::Scalar;
use std::rc::Rc;

use crate::dynamics::elimination::{Order, Pattern};
use crate::mechanics::analysis::{Absorption, Complaint, Hope, Poses};
use crate::mechanics::equations::{Caches, Equations};
use crate::mechanics::scene::{Choices, Scene};
use crate::model::types::Coordinate;
use crate::symbolic::graph::Sharing;

use super::advice::Pivoted;
use super::branches::Branches;
use super::constraints::ClosedIn;
use super::reduction::{Newton, Reduction};

/// A derivation just after its reduction, without its graph.
struct Reduced<'m> {
    scene: Rc<Scene<'m>>,
    newton: Newton,
    caches: Caches,
    sharing: Sharing,
    reduction: Rc<Reduction>,
}

/// A system that takes fewer operations than this is eliminated as it stands: nothing is gained that pays for the search.
const LEAST_COST: usize = 1_000;

/// What goes from one derivation of a model to the next.
#[derive(Default)]
pub(in crate::mechanics) struct Decided<'m> {
    pub(in crate::mechanics) branches: Branches,
    reductions: Vec<Rc<Reduced<'m>>>,
    orders: Vec<Known>,
    poses: Poses,
    /// What became of equations with multipliers in the system that was factorised last.
    pub(in crate::mechanics) pivoted: Option<Pivoted>,
    /// Symbols that stand for literals of struts, and these (see `mechanics/strut/apart`).
    pub(in crate::mechanics) numbers: Vec<(Scalar, Scalar)>,
}

/// In which order systems of one pattern are eliminated, loops closed in some axes, coordinates given in some order.
struct Known {
    axes: ClosedIn,
    pattern: Pattern,
    coordinates: Vec<usize>,
    order: Rc<Order>,
}

impl Equations<'_> {
    /// Works out all definitions, or takes them from a derivation that began in the same way.
    pub(in crate::mechanics) fn reduce(&mut self) -> Result<Rc<Reduction>, Vec<Complaint>> {
        self.reduce_by(Newton::Iterated)
    }

    pub(in crate::mechanics) fn reduce_by(&mut self, newton: Newton) -> Result<Rc<Reduction>, Vec<Complaint>> {
        let reduction = self.known_reduction(newton)?;
        self.reduced = Some(Rc::clone(&reduction));
        Ok(reduction)
    }

    /// In which order masses and loops are eliminated: as the tree is, or as zeros suggest where that costs less.
    pub(in crate::mechanics) fn order_of(&mut self, pattern: Pattern, coordinates: &[usize]) -> Rc<Order> {
        let writing = self.scene.way.writing;
        let known =
            |known: &&Known| known.axes == writing.axes && known.pattern == pattern && known.coordinates == coordinates;
        if let Some(known) = self.decided.orders.iter().find(known) {
            return Rc::clone(&known.order);
        }
        let plain = Order::plain(&pattern, coordinates);
        let (scene, poses) = (&self.scene, &mut self.decided.poses);
        let absorption = (plain.cost(&pattern) > LEAST_COST)
            .then(|| Absorption::new(scene.model, &scene.structure, writing, poses))
            .flatten();
        let sparse = absorption.map(|mut absorption| {
            let mut absorbs = |row: usize, others: &[usize], at: &[usize]| absorption.absorbs(row, others, at);
            Order::sparse(&pattern, coordinates, &mut absorbs)
        });
        let order = Rc::new(match sparse {
            Some(sparse) if sparse.cost(&pattern) < plain.cost(&pattern) => sparse,
            _ => plain,
        });
        let known = Known { axes: writing.axes, pattern, coordinates: coordinates.to_vec(), order: Rc::clone(&order) };
        self.decided.orders.push(known);
        order
    }

    /// What would have to be assumed of coordinates for more equations to be absorbed, each of which keeps so much of their volumes.
    pub(in crate::mechanics) fn hopes(&mut self, reduction: &Reduction, share: f64) -> Vec<(Coordinate, Hope)> {
        let (pattern, coordinates) = self.pattern_of_solution(reduction);
        let known = self.order_of(pattern.clone(), &coordinates).cost(&pattern);
        let (scene, poses) = (&self.scene, &mut self.decided.poses);
        let absorption = (known > LEAST_COST)
            .then(|| Absorption::new(scene.model, &scene.structure, scene.way.writing, poses))
            .flatten();
        let Some(mut absorption) = absorption.map(|absorption| absorption.hoping(share)) else { return Vec::new() };
        let mut absorbs = |row: usize, others: &[usize], at: &[usize]| absorption.absorbs(row, others, at);
        let order = Order::sparse(&pattern, &coordinates, &mut absorbs);
        if order.cost(&pattern) < known { absorption.hopes() } else { Vec::new() }
    }

    fn known_reduction(&mut self, newton: Newton) -> Result<Rc<Reduction>, Vec<Complaint>> {
        if self.g.size() != self.born {
            return Ok(Rc::new(self.define_all(newton)?));
        }
        let is_like = |reduced: &&Rc<Reduced<'_>>| reduced.newton == newton && is_like(&reduced.scene, &self.scene);
        if let Some(reduced) = self.decided.reductions.iter().find(is_like).cloned() {
            self.g.share(&reduced.sharing);
            self.scene = Rc::new(Scene { way: self.scene.way, ..(*reduced.scene).clone() });
            self.caches = reduced.caches.clone();
            return Ok(Rc::clone(&reduced.reduction));
        }
        let decided = self.decided.branches.len();
        let reduction = Rc::new(self.define_all(newton)?);
        // Where signs were decided, the graph has seen more than the definitions.
        if self.decided.branches.len() == decided {
            self.decided.reductions.push(Rc::new(Reduced {
                scene: Rc::clone(&self.scene),
                newton,
                caches: self.caches.clone(),
                sharing: self.g.sharing(),
                reduction: Rc::clone(&reduction),
            }));
        }
        Ok(reduction)
    }
}

/// Whether definitions come out alike in two scenes of a model.
fn is_like(a: &Scene<'_>, b: &Scene<'_>) -> bool {
    // No definition asks for inverse dynamics.
    let way = |scene: &Scene<'_>| Choices { lumped: false, ..scene.way };
    Rc::ptr_eq(&a.structure, &b.structure) && way(a) == way(b) && a.kept == b.kept
}
