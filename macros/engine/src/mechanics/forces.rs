//! Stage `mechanics`: declared forces.
//!
//! In: forces of the checked model. Out: [`Loads`]: per link the wrench that acts on it, and per coordinate the efforts
//! that act on it directly; efforts of single coordinates; powers. A force is turned into its link's axes by way of the
//! last link that carries both, a spring along a line is worked out in the axes of the last link that carries both ends.

use std::rc::Rc;

use crate::model::types::{Expr, ForceId, ForceKind, Frame, JointId};
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::build::Place;
use super::equations::Equations;
use super::newton_euler::Wrench;
use super::springs::JointSpring;

/// What acts on the tree.
#[derive(Clone, Debug)]
pub(super) struct Loads {
    /// By link: moment about its origin and force, in its axes.
    pub applied: Vec<Wrench>,
    /// By coordinate of the tree.
    pub efforts: Vec<Scalar>,
}

/// Terms of sums, added up once.
struct Terms {
    moments: Vec<Vec<Vector>>,
    forces: Vec<Vec<Vector>>,
    efforts: Vec<Vec<Scalar>>,
}

impl Terms {
    fn effort(&mut self, freedom: usize, effort: Scalar) {
        if let Some(list) = self.efforts.get_mut(freedom) {
            list.push(effort);
        }
    }

    fn force(&mut self, g: &mut Graph, place: &Place, force: Vector) {
        let Some(link) = place.link else { return };
        let moment = g.cross(place.offset, force);
        self.moments[link].push(moment);
        self.forces[link].push(force);
    }
}

impl Equations<'_> {
    /// All declared forces together.
    pub(super) fn loads(&mut self) -> Rc<Loads> {
        if let Some(loads) = &self.loads {
            return Rc::clone(loads);
        }
        let mechanism = Rc::clone(&self.mechanism);
        let tree = &mechanism.tree;
        let mut terms = Terms {
            moments: vec![Vec::new(); tree.links.len()],
            forces: vec![Vec::new(); tree.links.len()],
            efforts: vec![Vec::new(); tree.freedoms()],
        };
        let model = self.model;
        if !std::mem::replace(&mut self.loading, true) {
            for force in &model.forces {
                self.act(&mut terms, &force.kind);
            }
            self.loading = false;
        }
        let g = &mut self.g;
        let sums = terms.moments.iter().zip(&terms.forces);
        let applied =
            sums.map(|(moments, forces)| Wrench { moment: g.sum_vectors(moments), force: g.sum_vectors(forces) });
        let applied = applied.collect();
        let efforts: Vec<Scalar> = terms.efforts.iter().map(|list| g.sum(list)).collect();
        let loads = Rc::new(Loads { applied, efforts: mechanism.sign(&efforts) });
        self.loads = Some(Rc::clone(&loads));
        loads
    }

    fn act(&mut self, terms: &mut Terms, kind: &ForceKind) {
        match kind {
            ForceKind::Effort { joint, values } => {
                let first = self.symbols.first.get(joint.0).copied().unwrap_or(0);
                for (k, value) in values.iter().enumerate() {
                    let value = self.scalar(value);
                    terms.effort(first + k, value);
                }
            }
            ForceKind::JointSpring { joint, coordinate, stiffness, damping, rest } => {
                let spring = self.joint_spring(*joint, *coordinate, [stiffness, damping, rest]);
                let effort = spring.effort(&mut self.g);
                let first = self.symbols.first.get(joint.0).copied().unwrap_or(0);
                terms.effort(first + coordinate, effort);
            }
            ForceKind::LineSpring { between, stiffness, damping, length } => {
                let ends = [self.place(&between[0]), self.place(&between[1])];
                if ends[0].link == ends[1].link {
                    return;
                }
                let line = self.line_spring(&ends, [stiffness, damping, length]);
                let force = line.force(&mut self.g);
                for (place, force) in ends.iter().zip([-force, force]) {
                    let force = self.between(line.axes, place.link, force);
                    terms.force(&mut self.g, place, force);
                }
            }
            ForceKind::Force { at, value, axes } => {
                let place = self.place(at);
                if place.link.is_some() {
                    let force = self.given_in(&place, value, axes);
                    terms.force(&mut self.g, &place, force);
                }
            }
            ForceKind::Torque { at, value, axes } => {
                let place = self.place(at);
                if let Some(link) = place.link {
                    let moment = self.given_in(&place, value, axes);
                    terms.moments[link].push(moment);
                }
            }
        }
    }

    /// A vector given in a frame's axes, in those of a place's link.
    fn given_in(&mut self, place: &Place, value: &Expr, axes: &Frame) -> Vector {
        let axes = self.place(axes);
        if axes.link.is_none() && axes.rotation == Rotation::IDENTITY {
            return self.in_link(place.link, value);
        }
        let value = self.vector(value);
        let value = self.g.rotate(axes.rotation, value);
        self.between(axes.link, place.link, value)
    }

    /// The springs' and dampers' data; what is left out is zero.
    pub(super) fn joint_spring(&mut self, joint: JointId, index: usize, data: [&Option<Expr>; 3]) -> JointSpring {
        let [stiffness, damping, rest] = self.optional(data);
        let component = |lists: &[Vec<Scalar>]| {
            lists.get(joint.0).and_then(|list| list.get(index)).copied().unwrap_or(Scalar::ZERO)
        };
        let coordinate = component(&self.symbols.positions);
        let rate = component(&self.symbols.velocities);
        JointSpring { stiffness, damping, stretch: self.g.sub(coordinate, rest), rate }
    }

    pub(super) fn optional(&mut self, data: [&Option<Expr>; 3]) -> [Scalar; 3] {
        data.map(|expr| expr.as_ref().map_or(Scalar::ZERO, |expr| self.scalar(expr)))
    }

    /// Sum of `Effort`s and joint springs on one coordinate.
    pub(super) fn effort(&mut self, joint: JointId, index: usize) -> Scalar {
        if std::mem::replace(&mut self.loading, true) {
            return Scalar::ZERO;
        }
        let model = self.model;
        let mut terms = Vec::new();
        for force in &model.forces {
            match &force.kind {
                ForceKind::Effort { joint: at, values } if *at == joint => {
                    terms.extend(values.get(index).map(|value| self.scalar(value)));
                }
                ForceKind::JointSpring { joint: at, coordinate, stiffness, damping, rest }
                    if *at == joint && *coordinate == index =>
                {
                    let spring = self.joint_spring(joint, index, [stiffness, damping, rest]);
                    terms.push(spring.effort(&mut self.g));
                }
                _ => {}
            }
        }
        self.loading = false;
        self.g.sum(&terms)
    }

    /// What a force puts into the mechanism, W.
    pub(super) fn power(&mut self, force: ForceId) -> Scalar {
        let model = self.model;
        let Some(force) = model.forces.get(force.0) else { return Scalar::ZERO };
        if std::mem::replace(&mut self.loading, true) {
            return Scalar::ZERO;
        }
        let power = match &force.kind {
            ForceKind::Effort { joint, values } => {
                let rates = self.symbols.velocities.get(joint.0).cloned().unwrap_or_default();
                let values: Vec<Scalar> = values.iter().map(|value| self.scalar(value)).collect();
                let terms: Vec<Scalar> = values.iter().zip(rates).map(|(&u, rate)| self.g.mul(u, rate)).collect();
                self.g.sum(&terms)
            }
            ForceKind::JointSpring { joint, coordinate, stiffness, damping, rest } => {
                let spring = self.joint_spring(*joint, *coordinate, [stiffness, damping, rest]);
                let effort = spring.effort(&mut self.g);
                self.g.mul(effort, spring.rate)
            }
            ForceKind::LineSpring { between, stiffness, damping, length } => {
                let ends = [self.place(&between[0]), self.place(&between[1])];
                if ends[0].link == ends[1].link {
                    Scalar::ZERO
                } else {
                    let line = self.line_spring(&ends, [stiffness, damping, length]);
                    line.power(&mut self.g)
                }
            }
            ForceKind::Force { at, value, axes } => self.power_at(at, value, axes, false),
            ForceKind::Torque { at, value, axes } => self.power_at(at, value, axes, true),
        };
        self.loading = false;
        power
    }

    /// Force times velocity or torque times angular velocity, in the world's axes if the force is given in them.
    fn power_at(&mut self, at: &Frame, value: &Expr, axes: &Frame, angular: bool) -> Scalar {
        let (place, given) = (self.place(at), self.place(axes));
        if given.link.is_none() && given.rotation == Rotation::IDENTITY {
            let (w, v) = self.world_velocity(&place);
            let value = self.vector(value);
            return self.g.dot(value, if angular { w } else { v });
        }
        let value = self.given_in(&place, value, axes);
        let (w, v) = self.point_velocity(&place);
        self.g.dot(value, if angular { w } else { v })
    }
}
