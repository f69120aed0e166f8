//! Stage `model`: systems of bodies without mass.
//!
//! In: what expressions ask of several bodies as one. Out: an error for each list whose bodies have no mass at the declared
//! defaults: their centre of mass is nowhere, and their total mass is forgotten.

use crate::model::checker::Checker;
use crate::model::types::{Bodies, Body};

impl Checker<'_, '_> {
    /// Whether every system that is asked about has mass.
    pub(in crate::model) fn check_weightless(&mut self, bodies: &Bodies) {
        for selected in std::mem::take(&mut self.selected) {
            let chosen: Vec<&Body> = match &selected.bodies {
                None => bodies.iter().collect(),
                Some(list) => list.iter().map(|id| &bodies[*id]).collect(),
            };
            if chosen.into_iter().any(|body| self.evaluator.scalar(&body.mass) != Some(0.0)) {
                continue;
            }
            let message = match &selected.bodies {
                None => format!("`{}` of a model without mass at the declared defaults", selected.text),
                Some(_) => "these bodies have no mass at the declared defaults".to_owned(),
            };
            self.report.help(selected.span, message, selected.help);
        }
    }
}
