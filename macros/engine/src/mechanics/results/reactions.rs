//! Stage `mechanics`: what joints transmit.
//!
//! In: the tree with its original inertias, accelerations, forces, multipliers. Out: force and moment that the parent exerts
//! on the child at the joint's child frame; the efforts of the joint itself are part of them. For joints of the tree by the
//! Newton-Euler recursion, on which the multipliers' forces act like declared ones, for joints that close loops from their
//! multipliers. Equations that follow from others have none: how an over-constrained loop shares its load among them is
//! not determined by rigid bodies.

use std::rc::Rc;

use crate::dynamics::kinematics::motions;
use crate::dynamics::newton_euler::{Wrench, transmitted};
use crate::invariant::fault::OrFault;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::structure::Row;
use crate::mechanics::translate::build::FixedFrame;
use crate::mechanics::translate::forces::LoadCase;
use crate::mechanics::translate::values::Value;
use crate::model::types::{ConstraintId, Coordinate, ForceKind, JointId, LoopClosure};
use crate::symbolic::graph::{Scalar, Vector};

/// What joints of the tree transmit, at the links' origins in their axes.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct Transmitted(Option<Rc<[Wrench]>>);

impl Equations<'_> {
    /// In the axes of a frame.
    pub(in crate::mechanics) fn reaction(&mut self, joint: JointId, axes: &FixedFrame) -> Value {
        if self.scene.model.cuts.contains(&joint) {
            let [force, moment] = self.closing_reaction(joint, axes);
            return Value::Pair(force, moment);
        }
        let wrenches = self.wrenches();
        let link = self.scene.mechanism.joints.get(joint.0).and_then(|joint| joint.child).and_then(|child| child.link);
        let Some(&wrench) = link.and_then(|index| wrenches.get(index)) else {
            return Value::Pair(Vector::ZERO, Vector::ZERO);
        };
        let [force, moment] = self.turned_to(axes, link, [wrench.force, wrench.moment]);
        Value::Pair(force, moment)
    }

    /// Vectors in a link's axes, in those of a frame.
    fn turned_to(&mut self, axes: &FixedFrame, link: Option<usize>, vectors: [Vector; 2]) -> [Vector; 2] {
        vectors.map(|v| {
            let v = self.between(link, axes.link, v);
            self.g.rotate(axes.rotation.transpose(), v)
        })
    }

    /// Of a joint that closes a loop.
    fn closing_reaction(&mut self, joint: JointId, axes: &FixedFrame) -> [Vector; 2] {
        if self.derives_forces() {
            // Forces that depend on reactions are refused by the checker.
            return [Vector::ZERO; 2];
        }
        self.accelerations();
        let mut multiplied = self.rows_with_multipliers();
        multiplied.extend(self.reaction_multipliers().iter().copied());
        let held_across = self.expression_efforts(joint, &multiplied);
        multiplied.retain(|(row, _)| row.closing == LoopClosure::Cut(joint));
        let held = self.by_closing(&multiplied);
        let mut parts: Vec<[Vector; 2]> = held.iter().map(|one| self.cut_reaction(joint, one, axes)).collect();
        let mut declared = self.efforts_across(joint);
        let accelerations = self.accelerations();
        for rotor in self.rotors().iter().filter(|rotor| rotor.joint == joint) {
            let push = self.rotor_effort(rotor, &accelerations);
            declared.resize(declared.len().max(1), Scalar::ZERO);
            declared[0] = self.g.sub(declared[0], push);
        }
        for (efforts, held) in [(declared, false), (held_across, true)] {
            if let Some((ends, Wrench { moment, force })) = self.across(joint, &efforts, held) {
                parts.push(self.turned_to(axes, ends[0].link, [force, moment]));
            }
        }
        [0, 1].map(|k| {
            let list: Vec<Vector> = parts.iter().map(|part| part[k]).collect();
            self.g.sum_vectors(&list)
        })
    }

    /// Of the equation of a constraint; whether it has one is known before anything is derived.
    pub(in crate::mechanics) fn multiplier(&mut self, constraint: ConstraintId) -> Scalar {
        if self.derives_forces() {
            // Forces that depend on multipliers are refused by the checker.
            return Scalar::ZERO;
        }
        self.accelerations();
        let mut multiplied = self.rows_with_multipliers();
        multiplied.extend(self.reaction_multipliers().iter().copied());
        let of = |row: &Row| row.closing == LoopClosure::Constraint(constraint);
        multiplied.iter().find(|(row, _)| of(row)).or_fault("constraints without a multiplier are refused").1
    }

    /// Whether a drive holds a measured coordinate to its course.
    pub(in crate::mechanics) fn is_held(&self, coordinate: Coordinate) -> bool {
        self.scene.model.constraints.iter().any(|constraint| constraint.drive == Some(coordinate))
    }

    /// What a drive exerts on a measured coordinate beside all declared forces: less its multiplier.
    pub(in crate::mechanics) fn holding_effort(&mut self, coordinate: Coordinate) -> Scalar {
        if self.derives_forces() {
            return Scalar::ZERO;
        }
        self.accelerations();
        let mut multiplied = self.rows_with_multipliers();
        multiplied.extend(self.reaction_multipliers().iter().copied());
        let drives = |row: &Row| match row.closing {
            LoopClosure::Constraint(id) => self.scene.model.constraints[id].drive == Some(coordinate),
            LoopClosure::Cut(_) => false,
        };
        multiplied.iter().find(|(row, _)| drives(row)).map_or(Scalar::ZERO, |&(_, multiplier)| -multiplier)
    }

    /// Sums of the declared efforts on a joint that closes a loop.
    fn efforts_across(&mut self, joint: JointId) -> Vec<Scalar> {
        let model = self.scene.model;
        self.derive_forces(|e| {
            let mut sums: Vec<Scalar> = Vec::new();
            for force in &model.forces {
                match &force.kind {
                    ForceKind::Effort { joint: at, values } if *at == joint => {
                        sums.resize(sums.len().max(values.len()), Scalar::ZERO);
                        for (sum, value) in sums.iter_mut().zip(values) {
                            let value = e.scalar(value);
                            *sum = e.g.add(*sum, value);
                        }
                    }
                    ForceKind::JointSpring { joint: at, coordinate, stiffness, damping, rest } if *at == joint => {
                        sums.resize(sums.len().max(coordinate + 1), Scalar::ZERO);
                        let spring = e.joint_spring(joint, *coordinate, [stiffness, damping, rest]);
                        let effort = spring.effort(&mut e.g);
                        sums[*coordinate] = e.g.add(sums[*coordinate], effort);
                    }
                    // Elsewhere, or on no joint.
                    ForceKind::Effort { .. }
                    | ForceKind::JointSpring { .. }
                    | ForceKind::LineSpring { .. }
                    | ForceKind::Force { .. }
                    | ForceKind::Torque { .. } => {}
                }
            }
            sums
        })
    }

    /// Of all joints of the tree, at the links' origins in their axes.
    fn wrenches(&mut self) -> Rc<[Wrench]> {
        if let Some(wrenches) = &self.caches.transmitted.0 {
            return Rc::clone(wrenches);
        }
        let mechanism = Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        let user = self.accelerations();
        let mut acceleration = mechanism.sign(&user);
        acceleration.resize(tree.freedoms(), Scalar::ZERO);
        let loads = self.loads(LoadCase::Held);
        let mut loads = self.with_rotors(loads, &user);
        let holding = self.reaction_multipliers();
        if !holding.is_empty() {
            loads = self.held_by(&loads, &holding, false);
        }
        let base = self.base();
        let motions = motions(&mut self.g, tree, &tree.velocity, &acceleration, base);
        let wrenches: Rc<[Wrench]> = transmitted(&mut self.g, tree, &motions, &loads.applied).into();
        self.caches.transmitted.0 = Some(Rc::clone(&wrenches));
        wrenches
    }
}
