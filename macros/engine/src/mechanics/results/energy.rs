//! Stage `mechanics`: energies.
//!
//! In: the tree with regrouped inertias, springs. Out: kinetic energy, that of the links ([`energy`]) plus that of rotors of
//! joints that close loops; potential energy, minus gravity times the first moment of all mass, plus the springs'.

use crate::dynamics::energy;
use crate::mechanics::equations::Equations;
use crate::model::types::{ForceId, ForceKind};
use crate::symbolic::graph::Scalar;

impl Equations<'_> {
    /// J
    pub(in crate::mechanics) fn kinetic(&mut self) -> Scalar {
        let tree = self.regrouped();
        let velocities = self.link_velocities();
        let g = &mut self.g;
        let mut twice = energy::twice_kinetic(g, &tree, &velocities);
        twice.extend(self.twice_of_rotors());
        let g = &mut self.g;
        let sum = g.sum(&twice);
        let half = g.decimal(0.5);
        g.mul(half, sum)
    }

    /// J, parts of the potential energy of gravity.
    pub(in crate::mechanics) fn weight(&mut self) -> Vec<Scalar> {
        let Some(gravity) = self.scene.mechanism.tree.gravity else { return Vec::new() };
        let tree = self.regrouped();
        let gravity = self.g.vector(gravity);
        let moments = energy::first_moment(&mut self.g, &tree);
        moments.into_iter().map(|moment| -self.g.dot(gravity, moment)).collect()
    }

    /// J, zero at the world's origin and with relaxed springs.
    pub(in crate::mechanics) fn potential(&mut self) -> Scalar {
        let mut terms = self.weight();
        let model = self.scene.model;
        for (number, force) in model.forces.iter().enumerate() {
            match &force.kind {
                ForceKind::JointSpring { joint, coordinate, stiffness: stiffness @ Some(_), rest, .. } => {
                    let spring = self.joint_spring(*joint, *coordinate, [stiffness, &None, rest]);
                    terms.push(spring.energy(&mut self.g));
                }
                ForceKind::LineSpring { between, stiffness: stiffness @ Some(_), length, .. } => {
                    let ends = [self.place(&between[0]), self.place(&between[1])];
                    let line = self.line_spring(ForceId(number), &ends, [stiffness, &None, length]);
                    terms.push(line.energy(&mut self.g));
                }
                // What does not come from a potential.
                ForceKind::JointSpring { stiffness: None, .. }
                | ForceKind::LineSpring { stiffness: None, .. }
                | ForceKind::Effort { .. }
                | ForceKind::Force { .. }
                | ForceKind::Torque { .. } => {}
            }
        }
        self.g.sum(&terms)
    }
}
