//! Stage `mechanics`: quantities of several bodies together.
//!
//! In: bodies, the tree. Out: their mass, the motion of their centre of mass, their momentum, in world axes.
//!
//! The tree is loaded with these bodies alone and regrouped, which leaves first moments and momenta as they are: what a link hands on
//! moves with its parent. The first moment of mass climbs to the ground as a point does (`dynamics/energy`), momenta and their
//! rates do as wrenches do: the momentum p of all links and h about the world's origin, so h - c x p about the centre of mass c; the rate of p
//! is the mass times the acceleration of c.

use std::rc::Rc;

use crate::dynamics::energy::first_moment;
use crate::dynamics::inertia::Inertia;
use crate::dynamics::kinematics::motions;
use crate::dynamics::momentum::carried;
use crate::dynamics::newton_euler::{Wrench, to_parent, transmitted};
use crate::dynamics::regroup::regroup;
use crate::dynamics::tree::Tree;
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::values::Value;
use crate::model::types::{BodyId, Whole};
use crate::symbolic::graph::{Scalar, Vector};

impl Equations<'_> {
    /// Of these bodies, or of all.
    pub(in crate::mechanics) fn whole(&mut self, bodies: Option<&[BodyId]>, quantity: Whole) -> Value {
        let mass = self.mass_of(bodies);
        match quantity {
            Whole::Mass => Value::Scalar(mass),
            Whole::Position => Value::Vector(self.centre(bodies, mass)),
            Whole::Velocity => {
                let momentum = self.momentum_of(bodies).force;
                Value::Vector(self.shared_by(mass, momentum))
            }
            Whole::Acceleration => {
                let rate = self.momentum_rate_of(bodies);
                Value::Vector(self.shared_by(mass, rate))
            }
            Whole::LinearMomentum => Value::Vector(self.momentum_of(bodies).force),
            Whole::AngularMomentum => {
                let centre = self.centre(bodies, mass);
                let Wrench { moment, force } = self.momentum_of(bodies);
                let orbital = self.g.cross(centre, force);
                Value::Vector(self.g.sub_vectors(moment, orbital))
            }
        }
    }

    fn mass_of(&mut self, bodies: Option<&[BodyId]>) -> Scalar {
        let model = self.scene.model;
        let masses: Vec<Scalar> = match bodies {
            Some(list) => list.iter().map(|body| self.scalar(&model.bodies[*body].mass)).collect(),
            None => model.bodies.iter().map(|body| self.scalar(&body.mass)).collect(),
        };
        self.g.sum(&masses)
    }

    fn shared_by(&mut self, mass: Scalar, vector: Vector) -> Vector {
        let share = self.g.reciprocal(mass);
        self.g.scale(share, vector)
    }

    fn centre(&mut self, bodies: Option<&[BodyId]>, mass: Scalar) -> Vector {
        let tree = self.carrying(bodies);
        let parts = first_moment(&mut self.g, &tree);
        let moment = self.g.sum_vectors(&parts);
        self.shared_by(mass, moment)
    }

    /// Linear, and angular about the world's origin.
    fn momentum_of(&mut self, bodies: Option<&[BodyId]>) -> Wrench {
        let tree = self.carrying(bodies);
        let velocities = self.link_velocities();
        let momenta = carried(&mut self.g, &tree, &velocities);
        self.on_ground(&tree, &momenta)
    }

    /// Of the linear momentum, N.
    fn momentum_rate_of(&mut self, bodies: Option<&[BodyId]>) -> Vector {
        let tree = self.carrying(bodies);
        let user = self.accelerations();
        let mut accelerations = self.scene.mechanism.sign(&user);
        accelerations.resize(tree.freedoms(), Scalar::ZERO);
        let motions = motions(&mut self.g, &tree, &tree.velocity, &accelerations, Vector::ZERO);
        let unloaded = vec![Wrench::ZERO; tree.links.len()];
        let rates = transmitted(&mut self.g, &tree, &motions, &unloaded);
        self.on_ground(&tree, &rates).force
    }

    /// The sum of what the links that hang on the ground carry, about the world's origin.
    fn on_ground(&mut self, tree: &Tree, wrenches: &[Wrench]) -> Wrench {
        let mut sum = Wrench::ZERO;
        for (index, link) in tree.links.iter().enumerate() {
            if link.parent.is_none() {
                let carried = to_parent(&mut self.g, tree, index, &wrenches[index]);
                sum = sum.add(&mut self.g, &carried);
            }
        }
        sum
    }

    /// The tree with the inertia of these bodies alone, regrouped.
    fn carrying(&mut self, bodies: Option<&[BodyId]>) -> Rc<Tree> {
        let Some(bodies) = bodies else { return self.regrouped() };
        let (model, mechanism) = (self.scene.model, Rc::clone(&self.scene.mechanism));
        let mut tree = mechanism.tree.clone();
        tree.ground = None;
        tree.links.iter_mut().for_each(|link| link.inertia = Inertia::ZERO);
        for &body in bodies {
            self.load(&mut tree, &model.bodies[body], mechanism.bodies[body.0]);
        }
        Rc::new(regroup(&mut self.g, &tree))
    }
}
