//! Stage `mechanics`: bodies whose mass does not change with all that their centre of mass and inertia follow.
//!
//! In: the model. Out: complaints. What moves inside a body has momentum, which no equation of a rigid body has; what leaves takes its mass
//! along. That the mass reads the state says the model stage; that it changes with it, and isn't multiplied by zero, the graph.

use crate::mechanics::equations::Equations;
use crate::model::site::Sited;
use crate::model::types::Model;
use crate::symbolic::graph::Scalar;

use super::Complaint;

pub(super) fn complaints(model: &Model) -> Vec<Complaint> {
    if model.inertial_states().is_empty() {
        return Vec::new();
    }
    let mut e = Equations::plain(model);
    let mut complaints = Vec::new();
    for body in &model.bodies {
        let mass = e.scalar(&body.mass);
        for id in body.states() {
            let state = e.scene.symbols.states[id.0];
            if e.g.derivative(mass, &[(state, Scalar::ONE)]) == Scalar::ZERO {
                let (body_name, name) = (&body.place.field, &model.states[id].place.field);
                let message = format!("`{body_name}` follows `{name}`, and its mass does not change with it");
                let help = "what moves inside a body has momentum, which no equation of a rigid body has: give it a body and a joint of its own";
                complaints.push(Complaint { at: body.mass.site(), message, help: Some(help.to_owned()) });
            }
        }
    }
    complaints
}
