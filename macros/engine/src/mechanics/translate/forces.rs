//! Stage `mechanics`: declared forces.
//!
//! In: forces of the checked model. Out: [`Loads`]: per link the wrench that acts on it, and per coordinate the efforts
//! that act on it directly; efforts of single coordinates; powers. A force is turned into its link's axes by way of the
//! last link that carries both, a spring along a line is worked out in the axes of the last link that carries both ends.

use std::rc::Rc;

use crate::dynamics::newton_euler::Wrench;
use crate::invariant::injection::{Break, broken};
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints::measured::Dual;
use crate::mechanics::loops::constraints::{Held, row_count};
use crate::mechanics::loops::structure::Row;
use crate::mechanics::translate::directions::Axis;
use crate::model::joint_kinds::Motion;
use crate::model::types::{Coordinate, Expr, ForceId, ForceKind, Frame, JointId, Order};
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::build::{FixedFrame, Mechanism};
use super::springs::JointSpring;

/// What acts on the tree.
#[derive(Clone, Debug)]
pub(in crate::mechanics) struct Loads {
    /// By link: moment about its origin and force, in its axes.
    pub applied: Vec<Wrench>,
    /// By coordinate of the tree.
    pub efforts: Vec<Scalar>,
    /// Further wrenches on links about their origins, in world axes; only where [`crate::dynamics::lumped`] takes them.
    pub world: Vec<(usize, Wrench)>,
}

impl Loads {
    pub(in crate::mechanics) fn add(&self, g: &mut Graph, others: &Loads) -> Loads {
        let applied = self.applied.iter().zip(&others.applied).map(|(a, b)| a.add(g, b)).collect();
        let efforts = self.efforts.iter().zip(&others.efforts).map(|(&a, &b)| g.add(a, b)).collect();
        let world = [&self.world[..], &others.world].concat();
        Loads { applied, efforts, world }
    }
}

/// Terms of sums, added up once.
pub(in crate::mechanics) struct Terms {
    moments: Vec<Vec<Vector>>,
    forces: Vec<Vec<Vector>>,
    efforts: Vec<Vec<Scalar>>,
}

impl Terms {
    pub(in crate::mechanics) fn new(mechanism: &Mechanism) -> Self {
        let tree = &mechanism.tree;
        Terms {
            moments: vec![Vec::new(); tree.links.len()],
            forces: vec![Vec::new(); tree.links.len()],
            efforts: vec![Vec::new(); tree.freedoms()],
        }
    }

    /// The sums; efforts were those of the user's coordinates.
    pub(in crate::mechanics) fn sums(&self, g: &mut Graph, mechanism: &Mechanism) -> Loads {
        let sums = self.moments.iter().zip(&self.forces);
        let applied =
            sums.map(|(moments, forces)| Wrench { moment: g.sum_vectors(moments), force: g.sum_vectors(forces) });
        let applied = applied.collect();
        let efforts: Vec<Scalar> = self.efforts.iter().map(|list| g.sum(list)).collect();
        Loads { applied, efforts: mechanism.sign(&efforts), world: Vec::new() }
    }

    pub(in crate::mechanics) fn wrench(&mut self, link: usize, moment: Vector, force: Vector) {
        self.moments[link].push(moment);
        self.forces[link].push(force);
    }

    pub(in crate::mechanics) fn effort(&mut self, freedom: usize, effort: Scalar) {
        if let Some(list) = self.efforts.get_mut(freedom) {
            list.push(effort);
        }
    }

    fn moment(&mut self, place: &FixedFrame, moment: Vector) {
        if let Some(moments) = place.link.and_then(|link| self.moments.get_mut(link)) {
            moments.push(moment);
        }
    }

    pub(in crate::mechanics) fn force(&mut self, g: &mut Graph, place: &FixedFrame, force: Vector) {
        let Some(link) = place.link else { return };
        let moment = g.cross(place.offset, force);
        self.moments[link].push(moment);
        self.forces[link].push(force);
    }
}

/// Which forces act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::mechanics) enum LoadCase {
    /// Those that the model declares.
    Declared,
    /// And those of the multipliers, which are symbols.
    Held,
    /// The same, exact where loops are open too: slopes of what is left out where they are closed are not zero.
    HeldOpen,
}

/// Forces that are derived, or being derived.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct Forces {
    declared: Option<Rc<Loads>>,
    held: Option<Rc<Loads>>,
    held_open: Option<Rc<Loads>>,
    /// The checker lets no force depend on others, and here that would be an endless regress.
    deriving: bool,
}

impl Equations<'_> {
    /// All forces together.
    pub(in crate::mechanics) fn loads(&mut self, case: LoadCase) -> Rc<Loads> {
        let known = |forces: &Forces| match case {
            LoadCase::Declared => forces.declared.clone(),
            LoadCase::Held => forces.held.clone(),
            LoadCase::HeldOpen => forces.held_open.clone(),
        };
        if let Some(loads) = known(&self.caches.forces) {
            return loads;
        }
        match case {
            LoadCase::Declared => {
                let loads = self.declared_loads();
                self.caches.forces.declared = Some(Rc::clone(&loads));
                loads
            }
            LoadCase::Held | LoadCase::HeldOpen => {
                let declared = self.loads(LoadCase::Declared);
                let multiplied = self.rows_with_multipliers();
                let open = case == LoadCase::HeldOpen;
                let loads = if multiplied.is_empty() { declared } else { self.held_by(&declared, &multiplied, open) };
                let known = &mut self.caches.forces;
                *if open { &mut known.held_open } else { &mut known.held } = Some(Rc::clone(&loads));
                loads
            }
        }
    }

    fn declared_loads(&mut self) -> Rc<Loads> {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let mut terms = Terms::new(&mechanism);
        let model = self.scene.model;
        self.derive_forces(|e| {
            for (number, force) in model.forces.iter().enumerate() {
                e.act(&mut terms, ForceId(number), &force.kind);
            }
        });
        Rc::new(terms.sums(&mut self.g, &mechanism))
    }

    /// Derives forces; nothing comes of it while others are being derived.
    pub(in crate::mechanics) fn derive_forces<T: Default>(&mut self, f: impl FnOnce(&mut Self) -> T) -> T {
        if std::mem::replace(&mut self.caches.forces.deriving, true) {
            return T::default();
        }
        let result = f(self);
        self.caches.forces.deriving = false;
        result
    }

    /// Whether forces are being derived.
    pub(in crate::mechanics) fn derives_forces(&self) -> bool {
        self.caches.forces.deriving
    }

    /// Loads with the forces of multipliers.
    pub(in crate::mechanics) fn held_by(
        &mut self,
        loads: &Loads,
        multiplied: &[(Row, Scalar)],
        open: bool,
    ) -> Rc<Loads> {
        let held = self.by_closing(multiplied);
        let held: Vec<Held> = held.into_iter().map(|held| Held { open, ..held }).collect();
        let others = self.constraint_wrenches(&held);
        Rc::new(loads.add(&mut self.g, &others))
    }

    /// Multipliers gathered by what they close.
    pub(in crate::mechanics) fn by_closing(&self, multiplied: &[(Row, Scalar)]) -> Vec<Held> {
        let mut held: Vec<Held> = Vec::new();
        for &(row, multiplier) in multiplied {
            let at = held.iter().position(|one| one.closing == row.closing).unwrap_or_else(|| {
                let multipliers = vec![Scalar::ZERO; row_count(self.scene.model, row.closing)];
                held.push(Held { closing: row.closing, multipliers, writing: self.scene.way.writing, open: false });
                held.len() - 1
            });
            held[at].multipliers[row.index] = multiplier;
        }
        held
    }

    fn act(&mut self, terms: &mut Terms, id: ForceId, kind: &ForceKind) {
        match kind {
            ForceKind::Effort { joint, values } if self.scene.model.cuts.contains(joint) => {
                let values: Vec<Scalar> = values.iter().map(|value| self.scalar(value)).collect();
                self.act_across(terms, *joint, &values, false);
            }
            ForceKind::Effort { joint, values } => {
                let first = self.scene.symbols.first[joint.0];
                for (k, value) in values.iter().enumerate() {
                    let value = self.scalar(value);
                    terms.effort(first + k, value);
                }
            }
            ForceKind::JointSpring { joint, coordinate, stiffness, damping, rest } => {
                let spring = self.joint_spring(*joint, *coordinate, [stiffness, damping, rest]);
                let effort = spring.effort(&mut self.g);
                if self.scene.model.cuts.contains(joint) {
                    let mut efforts = vec![Scalar::ZERO; *coordinate];
                    efforts.push(effort);
                    self.act_across(terms, *joint, &efforts, false);
                } else {
                    terms.effort(self.freedom(Coordinate { joint: *joint, index: *coordinate }), effort);
                }
            }
            ForceKind::LineSpring { between, stiffness, damping, length } => {
                let ends = [self.place(&between[0]), self.place(&between[1])];
                if ends[0].link == ends[1].link {
                    return;
                }
                let line = self.line_spring(id, &ends, [stiffness, damping, length]);
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

    /// Efforts on a joint that closes a loop: a wrench on the child at its point, and its opposite on the parent there.
    pub(in crate::mechanics) fn act_across(&mut self, terms: &mut Terms, id: JointId, efforts: &[Scalar], held: bool) {
        let Some((ends, Wrench { moment, force })) = self.across(id, efforts, held) else { return };
        let [parent, child] = ends;
        let ([way, _], common) = self.way(&parent, &child, 0);
        let way = self.between(common, parent.link, way);
        let lever = self.g.cross(way, force);
        let back = self.g.add_vectors(moment, lever);
        terms.force(&mut self.g, &parent, -force);
        terms.moment(&parent, -back);
        let [force, moment] = [force, moment].map(|v| self.between(parent.link, child.link, v));
        terms.force(&mut self.g, &child, force);
        terms.moment(&child, moment);
    }

    /// Efforts on a joint that closes a loop as a wrench on the child at its point, in the axes of the parent's link; the
    /// joint's two ends. The effort of a screw is a moment about its axis, or as much as a force along it that does the same
    /// work: what is `held` by a multiplier must do that of the measured coordinate, which is a travel, exactly.
    pub(in crate::mechanics) fn across(
        &mut self,
        id: JointId,
        efforts: &[Scalar],
        held: bool,
    ) -> Option<([FixedFrame; 2], Wrench)> {
        let model = self.scene.model;
        let joint = &model.joints[id];
        // What stands behind the last that is given is zero.
        let effort = |k: usize| efforts.get(k).copied().unwrap_or(Scalar::ZERO);
        let ends = [self.place(&joint.parent), self.place(&joint.child)];
        // In the axes of the parent's frame, but for what belongs to axes of the child.
        let (mut force, mut moment, mut own) = (Vector::ZERO, Vector::ZERO, Vector::ZERO);
        if joint.kind.has_angles() || joint.kind.is_free() {
            return Some((ends, self.along_duals(id, efforts)));
        }
        let axes = self.joint_axes(joint);
        let pitch = joint.pitch.as_ref().filter(|_| held).map(|pitch| self.scalar(pitch));
        if let Some(pitch) = pitch.filter(|&pitch| pitch != Scalar::ZERO) {
            let push = self.g.div(effort(0), pitch);
            force = self.along(axes[0], push);
        } else if joint.kind.has_quaternion() {
            own = self.g.vector([effort(0), effort(1), effort(2)]);
        } else {
            for (index, freedom) in joint.kind.freedoms.iter().enumerate() {
                let along = self.along(axes[freedom.direction % 3], effort(index));
                let slot = match freedom.motion {
                    Motion::Slides => &mut force,
                    // The axes are perpendicular, so each moment works on its own angle alone.
                    Motion::Turns if joint.directions.is_of_child(freedom.direction) => &mut own,
                    Motion::Turns => &mut moment,
                };
                *slot = self.g.add_vectors(*slot, along);
            }
        }
        let [parent, child] = &ends;
        let force = self.g.rotate(parent.rotation, force);
        let moment = self.g.rotate(parent.rotation, moment);
        let own = self.g.rotate(child.rotation, own);
        let own = self.between(child.link, parent.link, own);
        let moment = self.g.add_vectors(moment, own);
        Some((ends, Wrench { moment, force }))
    }

    /// Efforts along what is dual to the coordinates.
    fn along_duals(&mut self, joint: JointId, efforts: &[Scalar]) -> Wrench {
        let (mut forces, mut moments) = (Vec::new(), Vec::new());
        for (index, &effort) in efforts.iter().enumerate().filter(|(_, effort)| **effort != Scalar::ZERO) {
            match self.dual(Coordinate { joint, index }) {
                Some(Dual::Slides(direction)) => forces.push(self.g.scale(effort, direction)),
                Some(Dual::Turns(direction)) => moments.push(self.g.scale(effort, direction)),
                None => {}
            }
        }
        Wrench { moment: self.g.sum_vectors(&moments), force: self.g.sum_vectors(&forces) }
    }

    /// A length along an axis.
    pub(in crate::mechanics) fn along(&mut self, axis: Axis, length: Scalar) -> Vector {
        let length = if axis.flipped { -length } else { length };
        let along = self.g.along(axis.index, length);
        self.g.rotate(axis.turn, along)
    }

    /// A vector given in a frame's axes, in those of a place's link.
    fn given_in(&mut self, place: &FixedFrame, value: &Expr, axes: &Frame) -> Vector {
        let axes = self.place(axes);
        if axes.link.is_none() && axes.rotation == Rotation::IDENTITY {
            return self.in_link(place.link, value);
        }
        let value = self.vector(value);
        let value = self.g.rotate(axes.rotation, value);
        self.between(axes.link, place.link, value)
    }

    /// The springs' and dampers' data; what is left out is zero.
    pub(in crate::mechanics) fn joint_spring(
        &mut self,
        joint: JointId,
        index: usize,
        data: [&Option<Expr>; 3],
    ) -> JointSpring {
        let [stiffness, damping, rest] = self.optional(data);
        let coordinate = Coordinate { joint, index };
        let position = if data[0].is_some() { self.coordinate(coordinate, Order::Position) } else { Scalar::ZERO };
        let rate = self.coordinate(coordinate, Order::Rate);
        JointSpring { stiffness, damping, stretch: self.g.sub(position, rest), rate }
    }

    pub(in crate::mechanics) fn optional(&mut self, data: [&Option<Expr>; 3]) -> [Scalar; 3] {
        let [a, b, c] = data.map(|expr| expr.as_ref().map_or(Scalar::ZERO, |expr| self.scalar(expr)));
        if broken(Break::SpringData) { [b, a, c] } else { [a, b, c] }
    }

    /// Sum of `Effort`s and joint springs on one coordinate.
    pub(in crate::mechanics) fn effort(&mut self, joint: JointId, index: usize) -> Scalar {
        let model = self.scene.model;
        let terms = self.derive_forces(|e| {
            let mut terms = Vec::new();
            for force in &model.forces {
                match &force.kind {
                    ForceKind::Effort { joint: at, values } if *at == joint => {
                        terms.push(e.scalar(&values[index]));
                    }
                    ForceKind::JointSpring { joint: at, coordinate, stiffness, damping, rest }
                        if *at == joint && *coordinate == index =>
                    {
                        let spring = e.joint_spring(joint, index, [stiffness, damping, rest]);
                        terms.push(spring.effort(&mut e.g));
                    }
                    // Elsewhere, or on no joint.
                    ForceKind::Effort { .. }
                    | ForceKind::JointSpring { .. }
                    | ForceKind::LineSpring { .. }
                    | ForceKind::Force { .. }
                    | ForceKind::Torque { .. } => {}
                }
            }
            terms
        });
        self.g.sum(&terms)
    }

    /// What a force puts into the mechanism, W.
    pub(super) fn power(&mut self, id: ForceId) -> Scalar {
        self.derive_forces(|e| Some(e.derived_power(id))).unwrap_or(Scalar::ZERO)
    }

    fn derived_power(&mut self, id: ForceId) -> Scalar {
        let model = self.scene.model;
        let force = &model.forces[id];
        match &force.kind {
            ForceKind::Effort { joint, values } => {
                let mut terms = Vec::with_capacity(values.len());
                for (index, value) in values.iter().enumerate() {
                    let value = self.scalar(value);
                    if value != Scalar::ZERO {
                        let rate = self.coordinate(Coordinate { joint: *joint, index }, Order::Rate);
                        terms.push(self.g.mul(value, rate));
                    }
                }
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
                    let line = self.line_spring(id, &ends, [stiffness, damping, length]);
                    line.power(&mut self.g)
                }
            }
            ForceKind::Force { at, value, axes } => self.power_at(at, value, axes, false),
            ForceKind::Torque { at, value, axes } => self.power_at(at, value, axes, true),
        }
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
