//! Stage `model`: bodies whose mass changes.
//!
//! In: expressions of bodies. Out: the states that they follow.
//!
//! Mass, centre of mass and inertia of a body may follow states of the user's own: a tank that empties. The equations are those of
//! the material that is there. A particle rests in its body until it leaves, and leaves, or joins, with the velocity that the body has
//! at its place; so what goes pushes nothing that stays, and Newton's law of each particle, `m_i a_i = f_i`, summed over those that
//! are there now, is that of a rigid body with the present moments: no rate of a moment stands in it (Meriam and Kraige, Dynamics,
//! 4/7; Eke and Wang 1994). Mass that leaves with another velocity is a force, which the user declares. What a flow inside the body
//! would add, whirling and jet damping, is not there.
//!
//! So every stage may take moments for constants of the moment at hand: they are moved to the parent, composed, factorised and
//! differentiated by positions and velocities as others are. What differs is what asks for a rate: of momenta and energies (`diff`
//! by time takes states along), and of the centre of mass of several bodies, which wanders between them
//! (`checks/changing_mass.rs`).

use std::collections::{BTreeSet, HashSet};
use std::rc::Rc;

use super::types::{Body, Expr, ExprNode, Model, StateId};

impl Body {
    /// States that its mass, centre of mass and inertia follow.
    pub fn states(&self) -> BTreeSet<StateId> {
        let tensor = self.inertia.iter().flat_map(|entries| entries.iter());
        states_of([&self.mass, &self.com].into_iter().chain(tensor))
    }
}

impl Model {
    /// States that some body follows.
    pub fn inertial_states(&self) -> BTreeSet<StateId> {
        self.bodies.iter().flat_map(Body::states).collect()
    }
}

impl Expr {
    /// Whether states of the user's own stand in it.
    pub fn follows_states(&self) -> bool {
        !states_of([self]).is_empty()
    }
}

/// States that stand in these expressions.
pub(super) fn states_of<'e>(exprs: impl IntoIterator<Item = &'e Expr>) -> BTreeSet<StateId> {
    let mut states = BTreeSet::new();
    each_node(exprs, &mut |expr| {
        if let ExprNode::State(id) = &*expr.node {
            states.insert(*id);
        }
    });
    states
}

/// Looks at every expression inside these once.
pub(super) fn each_node<'e>(exprs: impl IntoIterator<Item = &'e Expr>, look: &mut impl FnMut(&'e Expr)) {
    let mut stack: Vec<&Expr> = exprs.into_iter().collect();
    let mut seen = HashSet::new();
    while let Some(expr) = stack.pop() {
        if seen.insert(Rc::as_ptr(&expr.node)) {
            look(expr);
            stack.extend(expr.node.operands());
        }
    }
}
