//! Stage `mechanics`: mass, centre of mass and momenta of several bodies as one.
//!
//! In: the tree with the inertias of these bodies alone. Out: quantities in world axes. All is summed where the outermost link
//! stands that carries the bodies, in its axes: the angular momentum about their centre of mass does not depend on where that
//! link is, so the way from the world's origin, which may be long, takes no part in it. With the mass m, the first moment h and
//! the momenta p and L about the link's origin it is L - h x p / m (Orin, Goswami and Lee 2013).
//!
//! Rotors of `armature` have no axis in space and no place of their own, so they have no share in any of this: their moments
//! act between two bodies.

use std::rc::Rc;

use crate::dynamics::energy::first_moment_about;
use crate::dynamics::inertia::Inertia;
use crate::dynamics::kinematics::motions;
use crate::dynamics::momentum::{from_rest, moved_whole};
use crate::dynamics::newton_euler::Wrench;
use crate::dynamics::regroup::regroup_but;
use crate::dynamics::tree::Tree;
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::build::FixedFrame;
use crate::mechanics::translate::values::Value;
use crate::model::types::{Body, BodyId, FrameQuantity, Selection, SystemQuantity};
use crate::symbolic::graph::{Rotation, Scalar, Vector};

/// Bodies that are looked at as one.
pub(super) struct System {
    pub(super) tree: Tree,
    /// The outermost link that carries them all.
    pub(super) carrier: Option<usize>,
    /// kg
    pub(super) mass: Scalar,
}

impl Equations<'_> {
    /// A quantity of several bodies as one.
    pub(in crate::mechanics) fn of_bodies(&mut self, bodies: &Selection, quantity: SystemQuantity) -> Value {
        let chosen = self.chosen(bodies);
        Value::Vector(match quantity {
            SystemQuantity::TotalMass => return Value::Scalar(self.total_mass(&chosen)),
            SystemQuantity::CentreOfMass if self.stands_apart() => self.read_centre(&chosen),
            SystemQuantity::CentreOfMass => return self.centre_of_mass(&chosen),
            SystemQuantity::CentreOfMassVelocity => {
                let system = self.as_one(&chosen);
                let momentum = self.momentum(&system);
                self.per_mass(&system, momentum.force)
            }
            SystemQuantity::CentreOfMassAcceleration => {
                let system = self.as_one(&chosen);
                let rate = self.momentum_rate(&system);
                self.per_mass(&system, rate.force)
            }
            SystemQuantity::LinearMomentum => {
                let system = self.as_one(&chosen);
                let momentum = self.momentum(&system);
                self.between(system.carrier, None, momentum.force)
            }
            SystemQuantity::AngularMomentum => {
                let system = self.as_one(&chosen);
                let momentum = self.momentum(&system);
                let centre = self.centre(&system);
                let lever = self.g.cross(centre, momentum.force);
                let angular = self.g.sub_vectors(momentum.moment, lever);
                self.between(system.carrier, None, angular)
            }
        })
    }

    pub(super) fn chosen(&self, bodies: &Selection) -> Vec<BodyId> {
        bodies.as_ref().map_or_else(|| self.scene.model.bodies.ids().collect(), |list| list.to_vec())
    }

    fn total_mass(&mut self, bodies: &[BodyId]) -> Scalar {
        let model = self.scene.model;
        let masses: Vec<Scalar> = bodies.iter().map(|id| self.scalar(&model.bodies[*id].mass)).collect();
        self.g.sum(&masses)
    }

    /// The tree of the mechanism with nothing but these bodies on it.
    pub(super) fn as_one(&mut self, bodies: &[BodyId]) -> System {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let model = self.scene.model;
        let mut tree = mechanism.tree.clone();
        tree.ground = None;
        for link in &mut tree.links {
            link.inertia = Inertia::ZERO;
            link.armature = Scalar::ZERO;
        }
        for id in bodies {
            self.load(&mut tree, &model.bodies[*id], mechanism.bodies[id.0]);
        }
        let carrier = outermost(&tree);
        let keep: Vec<usize> = carrier.into_iter().collect();
        let tree = regroup_but(&mut self.g, &tree, false, &keep);
        System { tree, carrier, mass: self.total_mass(bodies) }
    }

    /// The centre of mass from the carrier's origin, in its axes.
    pub(super) fn centre(&mut self, system: &System) -> Vector {
        let parts = first_moment_about(&mut self.g, &system.tree, system.carrier);
        let first = self.g.sum_vectors(&parts);
        let factor = self.g.reciprocal(system.mass);
        self.g.scale(factor, first)
    }

    fn centre_of_mass(&mut self, bodies: &[BodyId]) -> Value {
        let system = self.as_one(bodies);
        let offset = self.centre(&system);
        let place = FixedFrame { link: system.carrier, rotation: Rotation::IDENTITY, offset };
        self.of_place(&place, FrameQuantity::Position)
    }

    /// The same of what an expression reads that is held at zero: by the places of the bodies, on which its multiplier acts.
    fn read_centre(&mut self, bodies: &[BodyId]) -> Vector {
        let model = self.scene.model;
        let moments: Vec<Vector> = bodies.iter().map(|id| self.read_first_moment(*id, &model.bodies[*id])).collect();
        let first = self.g.sum_vectors(&moments);
        let mass = self.total_mass(bodies);
        let factor = self.g.reciprocal(mass);
        self.g.scale(factor, first)
    }

    fn read_first_moment(&mut self, id: BodyId, body: &Body) -> Vector {
        let (mass, com) = (self.scalar(&body.mass), self.vector(&body.com));
        let place = self.scene.mechanism.bodies[id.0].then(&mut self.g, Rotation::IDENTITY, com);
        let position = self.read_place(&place, FrameQuantity::Position).vector(&mut self.g);
        self.g.scale(mass, position)
    }

    fn momentum(&mut self, system: &System) -> Wrench {
        let velocities = self.link_velocities();
        moved_whole(&mut self.g, &system.tree, &from_rest(&velocities), system.carrier)
    }

    /// What must act on the bodies from outside, gravity included.
    fn momentum_rate(&mut self, system: &System) -> Wrench {
        let accelerations = self.accelerations();
        let tree = &system.tree;
        let mut accelerations = self.scene.mechanism.sign(&accelerations);
        accelerations.resize(tree.freedoms(), Scalar::ZERO);
        let motions = motions(&mut self.g, tree, &tree.velocity, &accelerations, Vector::ZERO);
        moved_whole(&mut self.g, tree, &motions, system.carrier)
    }

    /// A vector of the carrier over the mass, in world axes.
    fn per_mass(&mut self, system: &System, v: Vector) -> Vector {
        let v = self.between(system.carrier, None, v);
        let factor = self.g.reciprocal(system.mass);
        self.g.scale(factor, v)
    }
}

/// The outermost link that carries all that has inertia; `None`: the ground.
fn outermost(tree: &Tree) -> Option<usize> {
    if tree.ground.is_some_and(|inertia| !inertia.is_zero()) {
        return None;
    }
    let mut heavy = (0..tree.links.len()).filter(|&link| !tree.links[link].inertia.is_zero());
    let first = heavy.next();
    heavy.fold(first, |carrier, link| tree.common(carrier, Some(link)))
}
