//! Stage `mechanics`: in which axes, and in which order, equations of loops are looked at to keep the independent ones.
//!
//! In: a model. Out: its structure, where what is read of reactions is determined, and what is kept is enough at all poses. Which equations can be left
//! out depends on the axes: a planar loop on a body that turns needs those of that body. Bennett's linkage needs equations
//! of its own choice. Where none will do, multipliers keep all that these loops have, and the rank is found at run time; what is reduced is refused.

use crate::mechanics::loops::constraints::{ClosedIn, Writing};
use crate::mechanics::loops::structure::{Row, Structure};
use crate::model::types::{Handling, Model};

use super::steadiness::{Everywhere, STEADY, everywhere, steadiness};
use super::{Complaint, checks, split, stress};

/// How equations are looked at.
#[derive(Clone, Copy)]
pub(super) struct Choice<'a> {
    pub writing: Writing,
    /// Equations that are kept rather than others.
    pub first: &'a [Row],
    /// Loops with these equations keep all that say anything.
    pub whole: &'a [Row],
}

impl Choice<'_> {
    fn plain(axes: ClosedIn) -> Self {
        Choice { writing: Writing { axes, ..Writing::PLAIN }, first: &[], whole: &[] }
    }
}

/// The first axes in which what is kept is steady, or those in which it is steadiest and enough everywhere.
pub(super) fn structure(model: &Model) -> Result<Structure, Vec<Complaint>> {
    // What the first choice can't be split for, none can.
    let mut plain = Some(split(model, Choice::plain(ClosedIn::Common))?);
    let (mut undetermined, mut lacking) = (None, None);
    let mut best: Option<(f64, Structure)> = None;
    for axes in [ClosedIn::Common, ClosedIn::ParentBase, ClosedIn::Parent, ClosedIn::Child] {
        let choice = Choice::plain(axes);
        let Some(mut found) = plain.take().or_else(|| split(model, choice).ok()) else { continue };
        let complaints = stress::complaints(model, &found, choice.writing);
        if !complaints.is_empty() {
            undetermined.get_or_insert(complaints);
            continue;
        }
        if steadiness(model, &found, choice.writing) >= STEADY {
            return Ok(found);
        }
        let Everywhere { needed, enough } = everywhere(model, &found, choice.writing);
        if !needed.is_empty() {
            lacking.get_or_insert(needed);
            let Some(other) = enough.and_then(|first| other(model, Choice { first: &first, ..choice })) else {
                continue;
            };
            found = other;
        }
        let steadiness = steadiness(model, &found, choice.writing);
        if best.as_ref().is_none_or(|best| steadiness > best.0) {
            best = Some((steadiness, found));
        }
    }
    match (best, lacking) {
        (Some((_, structure)), _) => Ok(structure),
        (None, Some(needed)) if matches!(model.handling, Handling::Reduced) => Err(checks::unsteady(model, &needed)),
        (None, Some(needed)) => {
            let structure = split(model, Choice { whole: &needed, ..Choice::plain(ClosedIn::Common) })?;
            let complaints = stress::complaints(model, &structure, structure.writing);
            if complaints.is_empty() { Ok(structure) } else { Err(complaints) }
        }
        (None, None) => Err(undetermined.unwrap_or_default()),
    }
}

/// With other equations, if they are enough everywhere.
fn other(model: &Model, choice: Choice<'_>) -> Option<Structure> {
    let structure = split(model, choice).ok()?;
    let is_determined = stress::are_determined(model, &structure, choice.writing);
    (is_determined && everywhere(model, &structure, choice.writing).needed.is_empty()).then_some(structure)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostics::Diagnostics;

    /// Bennett's linkage, of which two equations are independent, but not the same two at all poses.
    const BENNETT: &str = "pub mod m {
        formulation { constraints: Multipliers }
        body one { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        body two { mass: 1.5, inertia: diag(0.1, 0.1, 0.1) }
        body three { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        joint a: Revolute { parent: ground, child: one, axis: Z }
        joint b: Revolute { parent: one.at(X).rotated(X, 0.6), child: two, axis: Z }
        joint c: Revolute { parent: two.at(sin(1.1) / sin(0.6) * X).rotated(X, 1.1), child: three, axis: Z }
        #[cut]
        joint d: Revolute {
            parent: three.at(X).rotated(X, 0.6), child: ground.rotated(X, -1.1).at(-sin(1.1) / sin(0.6) * X), axis: Z
        }
    }";

    #[test]
    fn a_whole_loop_keeps_all() {
        let mut diagnostics = Diagnostics::default();
        let source = crate::parse(BENNETT.parse().expect("tokens"), &mut diagnostics);
        let model = crate::model::check(&source, &mut diagnostics).remove(0);
        let common = Choice::plain(ClosedIn::Common);
        let plain = split(&model, common).expect("a structure");
        let Everywhere { needed, enough } = everywhere(&model, &plain, plain.writing);
        assert_eq!(plain.rows.len(), 2);
        assert!(!needed.is_empty());
        let enough = enough.expect("a better choice");
        let better = other(&model, Choice { first: &enough, ..common }).expect("a structure");
        assert_eq!(better.rows.len(), 2);
        assert!(better.rows != plain.rows);
        let whole = split(&model, Choice { whole: &needed, ..common }).expect("a structure");
        assert_eq!((whole.rows.len(), whole.dropped.len()), (5, 0));
        assert!(whole.redundant);
    }
}
