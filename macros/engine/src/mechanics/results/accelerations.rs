//! Stage `mechanics`: accelerations that expressions ask for.
//!
//! In: the tree; definitions of dependent coordinates, if there are any. Out: accelerations of all coordinates of the tree. In
//! an open tree they are what forward dynamics gives; with constraints they stay symbols, for which
//! [`Equations::put_in_all`] puts in what the multipliers' system gives.

use std::rc::Rc;

use crate::mechanics::equations::Equations;
use crate::mechanics::translate::forces::LoadCase;
use crate::model::types::Coordinate;
use crate::symbolic::graph::Scalar;

use super::constrained::ConstrainedMotion;

#[derive(Clone, Default)]
pub(in crate::mechanics) struct Accelerations {
    /// Of the user's coordinates.
    list: Option<Rc<[Scalar]>>,
    solved: Option<Rc<ConstrainedMotion>>,
}

impl Equations<'_> {
    /// Of the user's coordinates.
    pub(in crate::mechanics) fn accelerations(&mut self) -> Rc<[Scalar]> {
        if let Some(accelerations) = &self.caches.accelerations.list {
            return Rc::clone(accelerations);
        }
        if self.derives_forces() {
            // Forces that depend on accelerations are refused by the checker.
            return vec![Scalar::ZERO; self.scene.symbols.places()].into();
        }
        if self.is_constrained() {
            return self.tree_accelerations();
        }
        let accelerations: Rc<[Scalar]> = self.forward_dynamics().into();
        self.caches.accelerations.list = Some(Rc::clone(&accelerations));
        accelerations
    }

    /// Symbols of all coordinates of the tree.
    fn tree_accelerations(&mut self) -> Rc<[Scalar]> {
        let accelerations: Rc<[Scalar]> = self.all_accelerations().into();
        self.caches.accelerations.list = Some(Rc::clone(&accelerations));
        if let Some(reduction) = self.reduced.clone() {
            let solved = self.solve_constrained(&reduction);
            self.caches.accelerations.solved = Some(Rc::new(solved));
        }
        accelerations
    }

    /// What takes the place of the symbols, where something has asked for accelerations.
    pub(in crate::mechanics) fn solved(&self) -> Option<Rc<ConstrainedMotion>> {
        self.caches.accelerations.solved.clone()
    }

    /// What a drive exerts on its coordinate beside all declared forces.
    pub(in crate::mechanics) fn drive_effort(&mut self, coordinate: Coordinate) -> Scalar {
        let (false, Some(reduction)) = (self.derives_forces(), self.reduced.clone()) else { return Scalar::ZERO };
        // Multipliers and the accelerations of the state are found first: both are in the efforts.
        self.accelerations();
        let efforts = self.projected_efforts(&reduction, LoadCase::Held);
        efforts[self.freedom(coordinate)]
    }
}
