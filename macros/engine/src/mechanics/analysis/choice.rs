//! Stage `mechanics`: in which axes, and in which order, equations of loops are looked at to keep the independent ones.
//!
//! In: a model. Out: its structure, where what is read of reactions is determined, and what is kept is enough at all poses. Which equations can be left
//! out depends on the axes: a planar loop on a body that turns needs those of that body. Bennett's linkage needs equations
//! of its own choice. Where none will do, multipliers keep all that these loops have, and the rank is found at run time; what is reduced is refused.

use crate::mechanics::loops::constraints::{ClosedIn, Writing};
use crate::mechanics::loops::structure::{Row, Structure};
use crate::model::types::{Handling, Model};

use super::steadiness::{STEADY, enough, needed, steadiness};
use super::{Complaint, checks, split, stress};

/// How equations are looked at.
#[derive(Clone, Copy)]
pub(super) struct Choice<'a> {
    pub writing: Writing,
    /// Equations that are kept rather than others.
    pub first: &'a [Row],
    /// Groups with these equations keep all that say anything.
    pub whole: &'a [Row],
}

impl Choice<'_> {
    fn plain(axes: ClosedIn) -> Self {
        Choice { writing: Writing { axes, ..Writing::PLAIN }, first: &[], whole: &[] }
    }
}

/// A structure that says what it should.
struct Candidate {
    structure: Structure,
    steadiness: f64,
    needed: Vec<Row>,
}

/// The first axes in which what is kept is steady, and enough at all poses; or the steadiest in which it is enough; or those in which another choice is.
pub(super) fn structure(model: &Model) -> Result<Structure, Vec<Complaint>> {
    let axes = [ClosedIn::Common, ClosedIn::ParentBase, ClosedIn::Parent, ClosedIn::Child];
    let mut candidates: Vec<Candidate> = Vec::new();
    let mut undetermined = None;
    for (number, choice) in axes.map(Choice::plain).into_iter().enumerate() {
        let structure = match split(model, choice) {
            Ok(structure) => structure,
            // What the first choice can't be split for, none can.
            Err(complaints) if number == 0 => return Err(complaints),
            Err(_) => continue,
        };
        let complaints = stress::complaints(model, &structure, choice.writing);
        if !complaints.is_empty() {
            undetermined.get_or_insert(complaints);
            continue;
        }
        let steadiness = steadiness(model, &structure, choice.writing);
        let needed = needed(model, &structure, choice.writing);
        if steadiness >= STEADY && needed.is_empty() {
            return Ok(structure);
        }
        candidates.push(Candidate { structure, steadiness, needed });
    }
    candidates.sort_by(|a, b| b.steadiness.total_cmp(&a.steadiness));
    if let Some(enough) = candidates.iter().position(|one| one.needed.is_empty()) {
        return Ok(candidates.swap_remove(enough).structure);
    }
    for Candidate { structure, .. } in &candidates {
        let choice = Choice::plain(structure.writing.axes);
        let enough = enough(model, structure, choice.writing);
        let other = enough.and_then(|first| checked(model, Choice { first: &first, ..choice }).ok());
        if let Some(other) = other.filter(|other| needed(model, other, choice.writing).is_empty()) {
            return Ok(other);
        }
    }
    match candidates.first() {
        None => Err(undetermined.unwrap_or_default()),
        Some(one) if matches!(model.handling, Handling::Reduced) => Err(checks::unsteady(model, &one.needed)),
        Some(one) => checked(model, Choice { whole: &one.needed, ..Choice::plain(one.structure.writing.axes) }),
    }
}

/// With what is read of reactions.
fn checked(model: &Model, choice: Choice<'_>) -> Result<Structure, Vec<Complaint>> {
    let structure = split(model, choice)?;
    let complaints = stress::complaints(model, &structure, choice.writing);
    if complaints.is_empty() { Ok(structure) } else { Err(complaints) }
}

#[cfg(test)]
#[path = "../../../tests/choices/mod.rs"]
mod tests;
