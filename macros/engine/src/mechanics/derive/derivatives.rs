//! Stage `mechanics`, its whole: partial derivatives.
//!
//! In: what the model asks for. Out: candidates for the derivatives of forward and inverse dynamics.

use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::results::linearisation::Accumulation;
use crate::mechanics::scene::{Method, Passing};
use crate::mechanics::translate::dependencies::Dependencies;
use crate::model::types::{Force, ForceKind, JointId};

use super::{Candidate, Deriving, Found, MOST_COMPOSITE, freedoms};

/// Ways to derivatives. From the results' side common axes cost more than they save.
const SIDES: [(Accumulation, &[&str]); 3] = [
    (
        Accumulation::Forward,
        &[
            "differentiated recursion, by columns",
            "differentiated recursion, by columns, parallel hinges in the axes of their base",
            "differentiated recursion, by columns, parallel hinges in the axes of their tip",
        ],
    ),
    (Accumulation::Reverse, &["differentiated recursion, by rows"]),
    (Accumulation::Weighted, &["differentiated recursion, by rows of the inverse mass matrix"]),
];

impl<'m> Deriving<'m> {
    /// Derivatives of forward dynamics.
    pub(super) fn forward_derivatives(&mut self) -> Result<Vec<Candidate>, Vec<Complaint>> {
        self.linearised(&SIDES, &[], |e, reduction, side| Ok(e.forward_derivatives(reduction, side)))
    }

    /// Derivatives of inverse dynamics.
    pub(super) fn inverse_derivatives(&mut self) -> Result<Vec<Candidate>, Vec<Complaint>> {
        self.linearised(&SIDES[..2], &[], |e, reduction, side| Ok(e.inverse_derivatives(reduction, side)))
    }

    /// The equations as a linear system. Weighted rows give no slopes of multipliers, which outputs may show.
    pub(super) fn linearizations(&mut self) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let model = self.model;
        let shown =
            model.outputs.iter().map(|output| &output.value).chain(model.states.iter().map(|state| &state.rate));
        let kept = Dependencies::of(shown).kept(model);
        let sides = if self.structure.rows.is_empty() { &SIDES[..] } else { &SIDES[..2] };
        self.linearised(sides, &kept, |e, reduction, side| e.linearized(reduction, side))
    }

    fn linearised(
        &mut self,
        sides: &[(Accumulation, &[&'static str])],
        kept: &[JointId],
        f: impl Fn(&mut Equations<'m>, &Reduction, Accumulation) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        // An effort reads what carries its joint and what hangs on it, so of large trees rows have come out as the cheapest.
        let is_large = self.is_open() && freedoms(self.model) > MOST_COMPOSITE;
        let sides = sides.iter().filter(|side| !is_large || side.0 == Accumulation::Reverse);
        // Forces on links read the sines and levers of links as they are, and slopes of these with them.
        let on_links = |force: &Force| !matches!(force.kind, ForceKind::Effort { .. } | ForceKind::JointSpring { .. });
        let passing = if self.model.forces.iter().any(on_links) { Passing::Plain } else { Passing::Columns };
        let mut candidates = Vec::new();
        for &(side, names) in sides {
            candidates.extend(self.passed_in_all_axes(
                names,
                Method::Composite,
                passing,
                kept,
                &mut |e: &mut Equations<'m>| {
                    let reduction = e.reduce()?;
                    f(e, &reduction, side)
                },
            )?);
        }
        Ok(self.promising(candidates))
    }
}
