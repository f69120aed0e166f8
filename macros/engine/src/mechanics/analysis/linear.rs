//! Stage `mechanics`: linear couplings between coordinates.
//!
//! In: constraints that a user wrote. Out: those that are proven linear (no derivative by a coordinate depends on a
//! position, and these times the coordinates are all that it reads of them), and for each the coordinate that it gives. Gears, racks and mimics are of this kind: they are eliminated
//! exactly, whatever becomes of the other equations.

use std::collections::HashSet;

use crate::contracts::symbol::Symbol;
use crate::mechanics::loops::constraints::Writing;
use crate::mechanics::loops::constraints::turns::Turns;
use crate::mechanics::translate::symbols::has_quaternion;
use crate::model::types::{ConstraintId, ConstraintKind, Coordinate, LoopClosure, Model};
use crate::symbolic::graph::{Scalar, ScalarNode};
use crate::symbolic::lower::Lowering;

use super::super::equations::Equations;

/// A constraint that is linear in the coordinates.
pub(super) struct Coupling {
    pub constraint: ConstraintId,
    /// Coordinates, and whether the coefficient is a number that isn't zero, so that the coordinate can be the one found.
    pub terms: Vec<(Coordinate, bool)>,
}

/// A coupling with the coordinate that it gives.
pub(super) struct Elimination {
    pub constraint: ConstraintId,
    pub unknown: Coordinate,
    /// What it is found from.
    pub others: Vec<Coordinate>,
}

/// All constraints that are linear couplings.
pub(super) fn couplings(model: &Model) -> Vec<Coupling> {
    let value = |k: usize| matches!(model.constraints.get(k).map(|c| &c.kind), Some(ConstraintKind::Value(_)));
    if !(0..model.constraints.len()).any(value) {
        return Vec::new();
    }
    let mut e = Equations::plain(model);
    (0..model.constraints.len())
        .filter(|&k| value(k))
        .filter_map(|k| coupling(&mut e, model, ConstraintId(k)))
        .collect()
}

fn coupling(e: &mut Equations<'_>, model: &Model, constraint: ConstraintId) -> Option<Coupling> {
    // An angle known up to whole turns gives nothing that is to count them.
    if let Turns::Whole(..) = e.turns(constraint) {
        return None;
    }
    let residual = e.residuals(LoopClosure::Constraint(constraint), Writing::PLAIN).first().copied()?;
    let mut terms = Vec::new();
    for (joint, component) in positions(e, residual) {
        // No component of a quaternion is a coordinate.
        let kind = &model.joints[joint];
        if has_quaternion(kind) && component + 3 >= kind.kind.freedoms() {
            return None;
        }
        let coordinate = Coordinate { joint, index: component };
        let slope = e.partial(&[residual], coordinate).first().copied()?;
        if !positions(e, slope).is_empty() {
            return None;
        }
        // What has a quaternion leaves the state as a whole or not at all.
        let gives = !has_quaternion(kind) && e.g.literal(slope).is_some_and(|n| n.value() != 0.0);
        terms.push((coordinate, gives));
    }
    terms.sort_unstable();
    let coordinates: Vec<Coordinate> = terms.iter().map(|term| term.0).collect();
    (!terms.is_empty() && is_affine(e, residual, &coordinates)).then_some(Coupling { constraint, terms })
}

/// Whether a constraint reads a coordinate with a number as its factor, whatever it does with all others.
pub(super) fn stands_alone(model: &Model, constraint: ConstraintId, coordinate: Coordinate) -> bool {
    let kind = &model.joints[coordinate.joint];
    if !matches!(model.constraints[constraint].kind, ConstraintKind::Value(_)) || has_quaternion(kind) {
        return false;
    }
    let mut e = Equations::plain(model);
    if let Turns::Whole(..) = e.turns(constraint) {
        return false;
    }
    let residuals = e.residuals(LoopClosure::Constraint(constraint), Writing::PLAIN);
    let (&[residual], [slope]) = (&residuals[..], &e.partial(&residuals, coordinate)[..]) else { return false };
    let mut lowering = Lowering::new(&e.g);
    let slopes = lowering.run(&[*slope]);
    let is_number = slopes.iter().all(|&slope| lowering.to.literal(slope).is_some_and(|n| n.value() != 0.0));
    is_number && is_affine(&mut e, residual, &[coordinate])
}

/// Whether an equation is what it is with some coordinates at zero, and these times their slopes there: a slope that does not change is not
/// enough, since steps, choices and angles that wrap around have such too.
fn is_affine(e: &mut Equations<'_>, residual: Scalar, coordinates: &[Coordinate]) -> bool {
    let symbols: Vec<Scalar> = coordinates.iter().map(|&coordinate| e.coordinate_symbols(coordinate)[0]).collect();
    let zeros = e.map(&symbols.iter().map(|&symbol| (symbol, Scalar::ZERO)).collect::<Vec<_>>());
    let mut terms = e.g.substitute(&[residual], &zeros);
    for (&coordinate, &symbol) in coordinates.iter().zip(&symbols) {
        let slopes = e.partial(&[residual], coordinate);
        let slopes = e.g.substitute(&slopes, &zeros);
        terms.extend(slopes.iter().map(|&slope| e.g.mul(slope, symbol)));
    }
    terms.push(-residual);
    let mut lowering = Lowering::new(&e.g);
    let lowered = lowering.run(&terms);
    lowering.to.sum(&lowered) == Scalar::ZERO
}

/// Components of positions that a scalar depends on.
fn positions(e: &Equations<'_>, s: Scalar) -> Vec<(crate::model::types::JointId, usize)> {
    let reachable = e.g.reachable_scalars(&[s]);
    let symbol = |index: usize| match e.g.node(e.g.scalar_at(index)) {
        ScalarNode::Symbol(id) => match e.scene.symbols.table.get(id.0) {
            Some(&Symbol::Position { joint, component }) => Some((joint, component)),
            _ => None,
        },
        _ => None,
    };
    reachable.into_iter().filter_map(symbol).collect()
}

/// Chooses what each coupling gives: not what is `taken` (driven, wished to be independent), the one latest in source
/// order. The eliminations come in an order in which each is found from what stands before it.
pub(super) fn eliminations(couplings: &[Coupling], taken: &HashSet<Coordinate>) -> Vec<Elimination> {
    let mut list: Vec<Elimination> = Vec::new();
    for coupling in couplings {
        let free = |unknown: &Coordinate| {
            !taken.contains(unknown)
                && list.iter().all(|other| other.unknown != *unknown)
                // What the unknown would be found from must not be found from it.
                && coupling.terms.iter().all(|&(c, _)| c == *unknown || !depends(&list, c, *unknown))
        };
        let mut candidates = coupling.terms.iter().rev().filter(|term| term.1).map(|term| term.0);
        let Some(unknown) = candidates.find(free) else { continue };
        let others = coupling.terms.iter().map(|term| term.0).filter(|&c| c != unknown).collect();
        list.push(Elimination { constraint: coupling.constraint, unknown, others });
    }
    let mut ordered: Vec<Elimination> = Vec::new();
    while !list.is_empty() {
        let ready = |one: &Elimination| one.others.iter().all(|c| list.iter().all(|other| other.unknown != *c));
        let Some(next) = list.iter().position(ready) else { break };
        ordered.push(list.remove(next));
    }
    ordered
}

/// Whether a coordinate is found from another, by eliminations.
fn depends(list: &[Elimination], coordinate: Coordinate, on: Coordinate) -> bool {
    let (mut open, mut seen) = (vec![coordinate], HashSet::new());
    while let Some(c) = open.pop() {
        if c == on {
            return true;
        }
        if seen.insert(c) {
            open.extend(list.iter().filter(|one| one.unknown == c).flat_map(|one| one.others.iter().copied()));
        }
    }
    false
}
