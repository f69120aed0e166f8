//! Stage `mechanics`, its whole: what laws compare a function with that is asked for alone.
//!
//! In: the functions that a model asks for. Out: one way to each of those that the laws of stage `verify` need beside them:
//! energies for everything that says how the mechanism moves, since they share nothing with the recursions of the dynamics,
//! and inverse dynamics for forward dynamics, which sees declared forces too. They are evaluated in numbers, at a few states, and
//! are no part of what is emitted, so nothing of them is optimised or counted.

use std::rc::Rc;

use crate::contracts::function::FunctionKind;
use crate::contracts::results::Results;
use crate::invariant::fault::OrFault;
use crate::mechanics::Witness;
use crate::mechanics::analysis::Complaint;
use crate::symbolic::graph::MOST_NODES;

use super::{Deriving, MOST_COMPOSITE};

/// The functions that are missing beside these.
fn partners(asked: &[FunctionKind], solves_inputs: bool) -> Vec<FunctionKind> {
    use FunctionKind as F;
    let mut all = asked.to_vec();
    let has = |all: &[F], kind: F| all.contains(&kind);
    let add = |all: &mut Vec<F>, needed: bool, kind: F| {
        if needed && !all.contains(&kind) {
            all.push(kind);
        }
    };
    // What energies are energies of.
    let still = [F::ForwardDynamics, F::InverseDynamics].iter().all(|&kind| !has(&all, kind));
    let needed = !solves_inputs && still && has(&all, F::KineticEnergy);
    add(&mut all, needed, F::InverseDynamics);
    // What is differentiated, factorised, or what rates of momenta come from.
    let needed = has(&all, F::ForwardDerivatives) || has(&all, F::Linearization);
    add(&mut all, needed, F::ForwardDynamics);
    let needed = !solves_inputs && (has(&all, F::InverseDerivatives) || has(&all, F::Residual));
    add(&mut all, needed, F::InverseDynamics);
    let needed = has(&all, F::Impulse);
    add(&mut all, needed, F::MassMatrix);
    let needed = has(&all, F::MomentumRate) && !has(&all, F::ForwardDynamics);
    add(&mut all, needed, F::Bias);
    let needed = has(&all, F::CentroidalMomentumMatrix);
    add(&mut all, needed, F::CentroidalMomentum);
    // Forward dynamics from the other side.
    let inverse = !solves_inputs && has(&all, F::InverseDynamics);
    let known = inverse || has(&all, F::Residual) || (has(&all, F::MassMatrix) && has(&all, F::Bias));
    let needed = has(&all, F::ForwardDynamics) && !known;
    add(&mut all, needed, if solves_inputs { F::Residual } else { F::InverseDynamics });
    // Energies.
    let moves = [F::ForwardDynamics, F::InverseDynamics, F::Bias].iter().any(|&kind| has(&all, kind));
    let needed = moves || has(&all, F::MassMatrix) || has(&all, F::MassMatrixLower) || has(&all, F::Momentum);
    add(&mut all, needed, F::KineticEnergy);
    add(&mut all, moves, F::PotentialEnergy);
    all.split_off(asked.len())
}

impl Deriving<'_> {
    /// What is to be compared with these functions.
    pub(super) fn witnesses(&mut self, asked: &[FunctionKind]) -> Result<Vec<Witness>, Vec<Complaint>> {
        // No model is to be refused as too large for what is not emitted.
        if self.graph.size() > MOST_NODES / 2 {
            return Ok(Vec::new());
        }
        let (mut plain, mut witnesses) = (Vec::new(), Vec::new());
        let moved = self.structure.has_speeds() && !asked.contains(&FunctionKind::PositionRates);
        let of_positions = moved.then_some(FunctionKind::PositionRates);
        for kind in partners(asked, !self.model.solve_for.is_empty()).into_iter().chain(of_positions) {
            // Forward dynamics holds what has no inertia of its own by equations that inverse dynamics doesn't know.
            let held = !self.structure.rows.is_empty() && asked.contains(&FunctionKind::ForwardDynamics);
            if held && kind == FunctionKind::InverseDynamics {
                continue;
            }
            // As many entries as no derivation of what was asked for has made.
            if kind == FunctionKind::MassMatrix && self.structure.freedoms() > MOST_COMPOSITE {
                continue;
            }
            match self.plain_way(kind) {
                Some(way) => plain.push((kind, way)),
                None => {
                    let first = self.candidates(kind)?.into_iter().next();
                    let (_, results) = first.or_fault("there is a way to each function");
                    witnesses.push(Witness { kind, results });
                }
            }
        }
        // All in one derivation: they have tree and kinematics in common.
        let (open, mut parts) = (self.is_open(), Vec::new());
        let found = self.only("", |e| {
            let definitions = if open { Rc::default() } else { e.reduce()? };
            let mut all = Vec::new();
            for (_, way) in &plain {
                let results = way.derive(e, &definitions)?;
                all.extend(results.list);
                parts.push(results.parts);
            }
            Ok(Results::vector(all))
        })?;
        let mut list = found.into_iter().flat_map(|(_, results)| results.list);
        for ((kind, _), parts) in plain.into_iter().zip(parts) {
            let list = list.by_ref().take(parts.count()).collect();
            witnesses.push(Witness { kind, results: Results { parts, list, apart: Vec::new() } });
        }
        Ok(witnesses)
    }
}
