//! Stage `model`: what bodies whose mass changes can't be asked.
//!
//! In: bodies, expressions. Out: an error for each place where a rate of their mass would have to be known, or would have two
//! meanings.
//!
//! The centre of mass of several bodies wanders between them while the mass of one changes: its rate is not the momentum over
//! the mass. Where positions are decided, rates and second rates of all that decides them are needed, and those of a state
//! may jump. And the rate of a mass is that of a state, so it may stand where accelerations may.

use proc_macro2::{Ident, Span};

use crate::model::changing::{each_node, states_of};
use crate::model::checker::Checker;
use crate::model::types::{
    Bodies, Body, BodyId, Constraint, ConstraintKind, Drive, Expr, ExprNode, Force, Output, Selection, Solve, SolveHow,
    State, SystemQuantity, Variable,
};

/// What is wrong where, and what to write.
struct Mistake {
    at: Span,
    message: String,
    help: &'static str,
}

/// Where positions are decided.
const EARLY: &str = "only positions, parameters and time decide positions: a state's rate may jump";

const CENTRE: &str = "`linear_momentum(..) / total_mass(..)` is the mean velocity of what is there, `diff(centre_of_mass(..), t)` the rate \
                      of the place";

const RATE: &str = "write the rate of its state in its place";

impl Checker<'_, '_> {
    /// What moves inside a body, and does not leave it, has momentum: what centre of mass and inertia follow, the mass follows too.
    pub(in crate::model) fn check_followed(
        &mut self,
        name: &Ident,
        mass: &Expr,
        com: &Expr,
        inertia: &[Expr],
    ) -> Option<()> {
        let followed = states_of([mass]);
        for (what, exprs) in [("centre of mass", std::slice::from_ref(com)), ("inertia", inertia)] {
            let Some(alone) = states_of(exprs).difference(&followed).next().copied() else { continue };
            let mut at = name.span();
            each_node(exprs, &mut |expr| {
                if matches!(&*expr.node, ExprNode::State(id) if *id == alone) {
                    at = expr.span;
                }
            });
            let state = &self.states[alone].place.field;
            self.report.help(
                at,
                format!("the {what} of `{name}` follows `{state}`, and its mass does not"),
                "what moves inside a body has momentum, which no equation of a rigid body has: give it a body and a joint of its \
                 own. Where mass leaves or joins, `mass` follows the state too",
            );
            return None;
        }
        Some(())
    }

    /// What decides positions.
    pub(in crate::model) fn check_changing(
        &mut self,
        bodies: &Bodies,
        constraints: &[Constraint],
        solves: &[Solve],
        drives: &[Drive],
        assumptions: &[Option<Expr>],
    ) {
        let changing = Changing { bodies };
        if !changing.any() {
            return;
        }
        let held = constraints.iter().filter_map(|constraint| match &constraint.kind {
            ConstraintKind::Value(value) | ConstraintKind::Rate(value) => Some(value),
            ConstraintKind::Rod { .. } => None,
        });
        let solved = solves.iter().flat_map(|solve| match &solve.how {
            SolveHow::Formulas(list) | SolveHow::From { branches: list, .. } => list,
        });
        let driven = drives.iter().map(|drive| &drive.value);
        let early = held.chain(solved).chain(driven).chain(assumptions.iter().flatten());
        let mistakes = changing.early(early);
        self.tell(mistakes);
    }

    /// What is known before accelerations are, and outputs.
    pub(in crate::model) fn check_changing_values(
        &mut self,
        bodies: &Bodies,
        states: &[Option<State>],
        forces: &[Option<Force>],
        outputs: &[Option<Output>],
    ) {
        let changing = Changing { bodies };
        if !changing.any() {
            return;
        }
        let rates = states.iter().flatten().map(|state| &state.rate);
        let values: Vec<&Expr> = rates.chain(forces.iter().flatten().flat_map(|force| force.kind.values())).collect();
        let mut mistakes = changing.rates(values.iter().copied());
        let outputs: Vec<&Expr> = outputs.iter().flatten().map(|output| &output.value).collect();
        mistakes.extend(changing.rates_of_rates(outputs.iter().copied()));
        mistakes.extend(changing.centres(values.into_iter().chain(outputs)));
        self.tell(mistakes);
    }

    /// The same of what another model is asked about this one.
    pub(in crate::model) fn check_changing_question(&mut self, bodies: &Bodies, value: &Expr) {
        let changing = Changing { bodies };
        let mut mistakes = changing.rates([value]);
        mistakes.extend(changing.centres([value]));
        self.tell(mistakes);
    }

    fn tell(&mut self, mistakes: Vec<Mistake>) {
        for mistake in mistakes {
            self.report.help(mistake.at, mistake.message, mistake.help);
        }
    }
}

/// Bodies of which some follow states.
struct Changing<'m> {
    bodies: &'m Bodies,
}

impl<'m> Changing<'m> {
    fn any(&self) -> bool {
        self.bodies.iter().any(|body| !body.states().is_empty())
    }

    /// Of these bodies one whose mass, or centre of mass, changes.
    fn found(&self, of: &Selection) -> Option<&'m Body> {
        self.chosen(of).into_iter().find(|body| body.mass.follows_states() || body.com.follows_states())
    }

    fn chosen(&self, of: &Selection) -> Vec<&'m Body> {
        let body = |id: &BodyId| &self.bodies[*id];
        of.as_ref().map_or_else(|| self.bodies.iter().collect(), |list| list.iter().map(body).collect())
    }

    /// The body that makes a mass or a centre of mass change with a state.
    fn moments(&self, node: &ExprNode) -> Option<&'m Body> {
        match node {
            ExprNode::OfBodies(of, SystemQuantity::TotalMass | SystemQuantity::CentreOfMass) => self.found(of),
            _ => None,
        }
    }

    fn early<'e>(&self, exprs: impl Iterator<Item = &'e Expr>) -> Vec<Mistake> {
        let mut mistakes = Vec::new();
        each_node(exprs, &mut |expr| {
            if let Some(body) = self.moments(&expr.node) {
                let message = format!("the mass of `{}` follows a state, and so does this value", body.place.field);
                mistakes.push(Mistake { at: expr.span, message, help: EARLY });
            }
        });
        mistakes
    }

    /// Rates of masses, where they are not known yet.
    fn rates<'e>(&self, exprs: impl IntoIterator<Item = &'e Expr>) -> Vec<Mistake> {
        let mut mistakes = Vec::new();
        each_node(exprs, &mut |expr| {
            let ExprNode::Derivative { of, by: Variable::Time, .. } = &*expr.node else { return };
            each_node([of], &mut |inner| {
                if let Some(body) = self.moments(&inner.node) {
                    let message = format!(
                        "the mass of `{}` follows a state, whose rate stands in no force, no state and no other derivative",
                        body.place.field
                    );
                    mistakes.push(Mistake { at: expr.span, message, help: RATE });
                }
            });
        });
        mistakes
    }

    fn rates_of_rates<'e>(&self, exprs: impl Iterator<Item = &'e Expr>) -> Vec<Mistake> {
        let mut mistakes = Vec::new();
        each_node(exprs, &mut |expr| match &*expr.node {
            ExprNode::Derivative { of, .. } => mistakes.extend(self.rates([of])),
            ExprNode::Substituted { of, pairs } => {
                mistakes.extend(self.rates(std::iter::once(of).chain(pairs.iter().map(|pair| &pair.1))));
            }
            _ => {}
        });
        mistakes
    }

    /// Velocities of centres of mass that wander between bodies, or within one.
    fn centres<'e>(&self, exprs: impl IntoIterator<Item = &'e Expr>) -> Vec<Mistake> {
        let mut mistakes = Vec::new();
        each_node(exprs, &mut |expr| {
            let ExprNode::OfBodies(of, SystemQuantity::CentreOfMassVelocity | SystemQuantity::CentreOfMassAcceleration) =
                &*expr.node
            else {
                return;
            };
            let chosen = self.chosen(of);
            let rests =
                |body: &&&Body| !body.com.follows_states() && (chosen.len() == 1 || !body.mass.follows_states());
            let Some(body) = chosen.iter().find(|body| !rests(body)) else { return };
            let message = format!(
                "the mass of `{}` follows a state: the centre of mass has a velocity by its momentum, and another one by its place",
                body.place.field
            );
            mistakes.push(Mistake { at: expr.span, message, help: CENTRE });
        });
        mistakes
    }
}
