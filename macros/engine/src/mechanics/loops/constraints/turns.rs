//! Stage `mechanics`: equations in which measured angles count.
//!
//! In: an expression phi that is held at zero, and reads angles that are known up to whole turns. Out: what it is to be
//! multiplied with, so that its value is known up to whole turns. Where a turn of each angle adds a fraction m / n of a turn
//! to phi, there is a least factor f > 0 by which all of them become whole. The turns then add whole numbers without a
//! common divisor to f phi, so every whole number can be their sum: the positions at which phi vanishes for some count
//! of the turns, which is all that a coordinate would know in their place, are those at which f phi is a whole number of
//! turns, neither more nor fewer. So the equation is the angle of the point (cos f phi, sin f phi), over f. It is smooth
//! wherever the loop is closed or nearly so, has the slopes of phi, and vanishes on no other branch, as a sine would.
//!
//! Shares of a turn are asked of the graph, as the difference that a turn makes to phi: what is written in sines and cosines
//! needs no rule, nor does what is hidden behind names. An angle that adds anything else, a share that is no fraction, that
//! a parameter changes, or that depends on where things are, can't be held: the equation would jump.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use crate::contracts::call::Call;
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::model::site::Sited;
use crate::model::types::{ConstraintId, ConstraintKind, Coordinate, Expr, ExprNode, LoopClosure, Model, Order};
use crate::symbolic::evaluate::{Evaluator, Real};
use crate::symbolic::graph::{Scalar, SymbolId};
use crate::symbolic::number::Number;

use super::{coordinate_name, row_name};

/// Greatest numerator and denominator of a share: with more, turns lie so close that which of them is meant is lost.
const MOST: i64 = 1000;

/// What whole turns of the angles do to an expression.
#[derive(Clone, Copy, Debug)]
pub(in crate::mechanics) enum Turns {
    /// Nothing.
    None,
    /// They are whole turns of the expression times this fraction; last the number of angles that have a share.
    Whole(i64, i64, usize),
    /// Something that can't be told from motion, for this angle.
    Lost(Coordinate),
}

/// What whole turns of measured angles do, by constraint.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct KnownTurns(HashMap<ConstraintId, Turns>);

impl Equations<'_> {
    /// The equation of an expression.
    pub(super) fn expression_residual(&mut self, id: ConstraintId) -> Scalar {
        let model = self.scene.model;
        let ConstraintKind::Value(value) = &model.constraints[id].kind else {
            return Scalar::ZERO;
        };
        let phi = self.scalar(value);
        let Turns::Whole(n, d, _) = self.turns(id) else { return phi };
        let g = &mut self.g;
        let (factor, inverse) = (g.number(Number::ratio(n, d)), g.number(Number::ratio(d, n)));
        let whole = g.mul(factor, phi);
        let (sin, cos) = (g.sin(whole), g.cos(whole));
        let angle = g.call(Call::Atan2, &[sin, cos]);
        g.mul(inverse, angle)
    }

    pub(in crate::mechanics) fn turns(&mut self, id: ConstraintId) -> Turns {
        if let Some(&known) = self.caches.turns.0.get(&id) {
            return known;
        }
        let turns = self.find_turns(id);
        self.caches.turns.0.insert(id, turns);
        turns
    }

    fn find_turns(&mut self, id: ConstraintId) -> Turns {
        let model = self.scene.model;
        let ConstraintKind::Value(value) = &model.constraints[id].kind else {
            return Turns::None;
        };
        let measured = measured(model, value);
        if measured.is_empty() {
            return Turns::None;
        }
        let (phi, read) = self.standing_apart(value);
        let mut shares = Vec::new();
        for (coordinate, symbol) in read {
            if !measured.iter().any(|one| one.0 == coordinate) || !self.is_angle(coordinate) {
                continue;
            }
            match self.share(phi, symbol) {
                Some((0, _)) => {}
                Some(share) => shares.push((coordinate, share)),
                None => return Turns::Lost(coordinate),
            }
        }
        // Over their least common denominator they have the greatest common divisor of the numerators alone.
        let (mut least, mut common) = (1, 0);
        for &(coordinate, (n, d)) in &shares {
            least = least / divisor(least, d) * d;
            common = divisor(common, n);
            if least > MOST {
                return Turns::Lost(coordinate);
            }
        }
        let far = |&&(_, (n, d)): &&(Coordinate, (i64, i64))| (n / common * (least / d)).abs() > MOST;
        match (shares.first(), shares.iter().find(far)) {
            (None, _) => Turns::None,
            (_, None) => Turns::Whole(least, common, shares.len()),
            (_, Some(&(coordinate, _))) => Turns::Lost(coordinate),
        }
    }

    /// The share of a turn that a turn of an angle adds to an expression, in lowest terms.
    fn share(&mut self, phi: Scalar, angle: Scalar) -> Option<(i64, i64)> {
        let (pi, two) = (self.g.pi(), self.g.decimal(2.0));
        let turn = self.g.mul(two, pi);
        let turned = self.g.add(angle, turn);
        let map = self.map(&[(angle, turned)]);
        let turned = self.g.substitute(&[phi], &map)[0];
        let (n, d) = (0..8).find_map(|seed| {
            let place = move |SymbolId(k): SymbolId| 0.3 + ((k + 1 + 37 * seed) as f64 * 0.618_033_988_749_895).fract();
            let values = Evaluator::new(&self.g, Real { symbols: &place }).run(&[phi, turned]);
            fraction((values[1] - values[0]) / std::f64::consts::TAU)
        })?;
        let share = self.g.number(Number::ratio(n, d));
        let gain = self.g.mul(share, turn);
        (self.g.add(phi, gain) == turned).then_some((n, d))
    }
}

/// Complaints about constraints that count turns of angles that are known up to whole turns only.
pub(in crate::mechanics) fn complaints(model: &Model) -> Vec<Complaint> {
    let candidates: Vec<ConstraintId> = (0..model.constraints.len())
        .map(ConstraintId)
        .filter(|id| match &model.constraints[*id].kind {
            ConstraintKind::Value(value) => !measured(model, value).is_empty(),
            ConstraintKind::Rod { .. } | ConstraintKind::Rate(_) => false,
        })
        .collect();
    if candidates.is_empty() {
        return Vec::new();
    }
    let mut e = Equations::plain(model);
    let lost = candidates.into_iter().filter_map(|id| match e.turns(id) {
        Turns::Lost(coordinate) => Some((id, coordinate)),
        Turns::None | Turns::Whole(..) => None,
    });
    lost.map(|(id, coordinate)| complaint(model, id, coordinate)).collect()
}

/// Of constraints, where they vanish for every whole number of turns of a multiple of themselves: how much (rad) lies
/// between one solution and the next, and how many angles count in it.
pub(in crate::mechanics) fn periods(model: &Model, constraints: &[ConstraintId]) -> Vec<(ConstraintId, f64, usize)> {
    if constraints.is_empty() {
        return Vec::new();
    }
    let mut e = Equations::plain(model);
    let period = |&id: &ConstraintId| match e.turns(id) {
        Turns::Whole(n, d, angles) => Some((id, std::f64::consts::TAU * d as f64 / n as f64, angles)),
        Turns::None | Turns::Lost(_) => None,
    };
    constraints.iter().filter_map(period).collect()
}

fn complaint(model: &Model, id: ConstraintId, coordinate: Coordinate) -> Complaint {
    let constraint = &model.constraints[id];
    let found = match &constraint.kind {
        ConstraintKind::Value(value) => measured(model, value).into_iter().find(|one| one.0 == coordinate),
        ConstraintKind::Rod { .. } | ConstraintKind::Rate(_) => None,
    };
    let at = found.map_or(constraint.site(), |(_, expr)| expr.site());
    let (name, angle) = (row_name(model, LoopClosure::Constraint(id), 0), coordinate_name(model, coordinate));
    let message = format!(
        "the constraint `{name}` counts the turns of `{angle}`, which is measured between bodies and known up to whole turns"
    );
    let help = format!(
        "give ratios of angles as numbers or fractions up to {MOST}, such as `1.0 / 3.0`, take `sin` and `cos` of it, \
         or let the joint have a coordinate: with `coordinates: Joint`, or none, in the place of `Absolute(..)`"
    );
    Complaint { at, message, help: Some(help) }
}

/// Coordinates of joints that close loops which an expression reads, with where it does so first.
fn measured<'e>(model: &Model, value: &'e Expr) -> Vec<(Coordinate, &'e Expr)> {
    let (mut open, mut seen) = (vec![value], HashSet::new());
    let mut found: Vec<(Coordinate, &Expr)> = Vec::new();
    while let Some(expr) = open.pop() {
        if !seen.insert(Rc::as_ptr(&expr.node)) {
            continue;
        }
        if let ExprNode::Coordinate { joint, index, order: Order::Position } = *expr.node
            && model.cuts.contains(&joint)
        {
            found.push((Coordinate { joint, index }, expr));
        }
        open.extend(expr.node.operands().into_iter().rev());
    }
    found
}

/// The fraction in lowest terms that a number rounds.
fn fraction(x: f64) -> Option<(i64, i64)> {
    let near = |d: &i64| ((x * *d as f64) - (x * *d as f64).round()).abs() < 1e-9;
    let d = (1..=MOST).find(near).filter(|_| x.is_finite())?;
    let n = (x * d as f64).round();
    (n.abs() <= MOST as f64).then_some((n as i64, d))
}

fn divisor(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { divisor(b, a % b) }
}
