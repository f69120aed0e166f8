//! Stage `mechanics`: motions that are taken to be small.
//!
//! In: finished equations of motion, M(q) a + h(q, v, ..) in the coordinates of the state. Out: the same to first order in the
//! positions and rates that the model calls small, at fixed accelerations: f(0) + df/ds(0) s. Mass matrix, bias and inverse
//! dynamics are expanded alike, and accelerations solve what is left of them, so all of these go on saying the same; so do the
//! equations that are printed, term by term, where no coordinate of theirs follows from others. Nothing is taken to be small
//! before it has been differentiated: the slope of a cosine is a sine, and not the slope of one.

use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints::coordinate_name;
use crate::mechanics::loops::structure::{Role, Structure};
use crate::model::site::Sited;
use crate::model::types::{Model, Request};
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::Scalar;

impl Equations<'_> {
    /// Whether some motions are small.
    pub(in crate::mechanics) fn is_first_order(&self) -> bool {
        !self.scene.model.small.is_empty()
    }

    /// Finished expressions to first order in what is small.
    pub(in crate::mechanics) fn first_order(&mut self, list: &[Scalar]) -> Vec<Scalar> {
        if !self.is_first_order() {
            return list.to_vec();
        }
        let small: Vec<Scalar> =
            self.scene.model.small.iter().flat_map(|&at| self.coordinate_symbols(at)[..2].to_vec()).collect();
        let zeros: Vec<(Scalar, Scalar)> = small.iter().map(|&symbol| (symbol, Scalar::ZERO)).collect();
        let zeros = self.map(&zeros);
        let mut terms: Vec<Vec<Scalar>> = self.g.substitute(list, &zeros).into_iter().map(|rest| vec![rest]).collect();
        for symbol in small {
            let slopes = Differentiator::new(&[(symbol, Scalar::ONE)]).scalars(&mut self.g, list);
            let slopes = self.g.substitute(&slopes, &zeros);
            for (terms, slope) in terms.iter_mut().zip(slopes) {
                terms.push(self.g.mul(slope, symbol));
            }
        }
        terms.iter().map(|terms| self.g.sum(terms)).collect()
    }
}

/// What small motions can't be asked for.
pub(in crate::mechanics) fn complaints(model: &Model, structure: &Structure) -> Vec<Complaint> {
    let complaint = |at, message, help: &str| Complaint { at, message, help: Some(help.to_owned()) };
    if model.small.is_empty() {
        return Vec::new();
    }
    let mut complaints = Vec::new();
    for coordinate in &model.small {
        if structure.role(*coordinate) != Role::State {
            let name = coordinate_name(model, *coordinate);
            let message = format!("{name} is not in the state: it follows from others, and can't be small by itself");
            complaints.push(complaint(model.site(), message, "name coordinates of the state in `simplify small(..)`"));
        }
    }
    if structure.has_speeds() {
        let message =
            "motions are small in coordinates and their rates, and velocities of this model are others".to_owned();
        complaints.push(complaint(model.site(), message, "leave out the speeds, or the constraints of velocities"));
    }
    if !structure.rows.is_empty() {
        let message = "loops that keep multipliers can't be taken to first order".to_owned();
        complaints.push(complaint(model.site(), message, "write `formulation { constraints: Reduced }`"));
    }
    if structure.guesses() > 0 {
        let message = "loops that Newton's method closes can't be taken to first order".to_owned();
        complaints.push(complaint(model.site(), message, "solve the loops by `solve (..) from ..`"));
    }
    if let (false, Some(at)) = (model.solve_for.is_empty(), model.asked_at(Request::InverseDynamics)) {
        let message = "inputs are not solved for where motions are taken to be small".to_owned();
        complaints.push(complaint(at, message, "write `inverse_dynamics` without `solve_for`"));
    }
    if let Some(at) = model.asked_at(Request::Momentum) {
        let message = "`momentum` is not derived where motions are taken to be small".to_owned();
        complaints.push(complaint(at, message, "leave it out of `emit`, or remove `simplify small(..)`"));
    }
    complaints
}
