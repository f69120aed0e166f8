//! Stage `mechanics`: what closings do to the bodies.
//!
//! In: a multiplier for every equation. Out: the wrenches -G^T lambda on the two bodies, so that the equations read
//! M a = f - G^T lambda; and the reaction of a cut joint. With v and w the velocities of points and axes the rates of the
//! equations are, for the component f of the way d = C - P along an axis fixed to a link A, f . (v_C - v_P) + w_A . (f x d),
//! for axes c of the child and p of the parent (w_child - w_parent) . (c x p), for a rod d . (v_2 - v_1).
//!
//! Exact everywhere: ways along an axis of the parent, cosines, rods and expressions ([`super::expression`]). For the gap of a
//! point the term w_A . (f x d) is left out, and the thread of a screw that doesn't count its turns is taken as it runs along
//! aligned axes without a lag: both hold where the loop is closed. Their slopes are not those of the exact wrenches, and
//! a residual is looked at where loops are open too, so derivatives and the residual ask for exact ones ([`Held::open`]).

use std::collections::BTreeMap;
use std::rc::Rc;

use crate::dynamics::newton_euler::{Wrench, to_parent};
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::build::FixedFrame;
use crate::mechanics::translate::forces::{Loads, Terms};
use crate::model::types::{ConstraintId, ConstraintKind, JointId, LoopClosure};
use crate::symbolic::graph::{Scalar, Vector};

use super::Writing;
use super::cut::{Cut, Equation};
use super::view::View;

/// A closing with the multipliers of all its equations; those of equations that were dropped are zero.
#[derive(Clone, Debug)]
pub struct Held {
    pub closing: LoopClosure,
    pub multipliers: Vec<Scalar>,
    pub writing: Writing,
    /// Whether wrenches are exact where the loop is open too.
    pub open: bool,
}

/// What the multipliers of a joint amount to, in the axes of its view: on the child at its point, and against it on the
/// parent at the same point (`away`) or at its own.
struct Push {
    force: Vector,
    away: Vector,
    moment: Vector,
}

/// Sums before they are turned into link axes.
struct WrenchSums {
    terms: Terms,
    /// By link, in world axes about its origin: turned once for all loops that end there.
    world: BTreeMap<usize, (Vec<Vector>, Vec<Vector>)>,
}

impl Equations<'_> {
    /// The wrenches -G^T lambda of several closings together, to be added to other loads.
    pub(in crate::mechanics) fn constraint_wrenches(&mut self, held: &[Held]) -> Loads {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let mut gathered = WrenchSums { terms: Terms::new(&mechanism), world: BTreeMap::new() };
        for one in held {
            if one.multipliers.iter().all(|&m| m == Scalar::ZERO) {
                continue;
            }
            match one.closing {
                LoopClosure::Cut(joint) => {
                    if let Some(cut) = self.cut(joint) {
                        self.hold_cut(&mut gathered, &cut, one);
                    }
                }
                LoopClosure::Constraint(_) => self.hold(&mut gathered, one),
            }
        }
        let mut world = Vec::new();
        for (link, (moments, forces)) in gathered.world {
            let g = &mut self.g;
            let (moment, force) = (g.sum_vectors(&moments), g.sum_vectors(&forces));
            if self.scene.way.lumped {
                world.push((link, Wrench { moment, force }));
                continue;
            }
            let [moment, force] = [moment, force].map(|v| self.between(None, Some(link), v));
            gathered.terms.wrench(link, moment, force);
        }
        Loads { world, ..gathered.terms.sums(&mut self.g, &mechanism) }
    }

    /// The same as efforts on the user's coordinates.
    pub fn constraint_efforts(&mut self, held: &[Held]) -> Vec<Scalar> {
        let loads = self.constraint_wrenches(held);
        let mechanism = Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        let g = &mut self.g;
        let mut wrenches: Vec<Wrench> = loads.applied.clone();
        let mut efforts = loads.efforts;
        for index in (0..tree.links.len()).rev() {
            let link = &tree.links[index];
            let wrench = wrenches[index];
            for (freedom, effort) in tree.project(g, link, wrench.moment, wrench.force) {
                efforts[freedom] = g.add(efforts[freedom], effort);
            }
            if let Some(parent) = link.parent {
                let carried = to_parent(g, tree, index, &wrench);
                wrenches[parent] = wrenches[parent].add(g, &carried);
            }
        }
        efforts.truncate(self.scene.symbols.places());
        mechanism.sign(&efforts)
    }

    fn hold_cut(&mut self, gathered: &mut WrenchSums, cut: &Cut, held: &Held) {
        let view = self.view(&cut.ends, held.writing);
        let push = self.push(cut, &view, held);
        let [parent, child] = &cut.ends;
        self.apply(gathered, &view, child, push.force, push.moment);
        self.apply(gathered, &view, parent, -push.force, -push.moment);
        if held.open && view.place.link.is_some() && push.force != Vector::ZERO {
            // The axes of the gap turn with the body that they are fixed to.
            let way = self.see_way(&view, &cut.ends);
            let moment = self.g.cross(push.force, way);
            self.apply(gathered, &view, &view.place, Vector::ZERO, moment);
        }
        if push.away == Vector::ZERO {
            return;
        }
        self.apply(gathered, &view, child, push.away, Vector::ZERO);
        // On the parent at the child's point.
        let way = self.see_way(&view, &cut.ends);
        let lever = self.g.cross(way, push.away);
        self.apply(gathered, &view, parent, -push.away, -lever);
    }

    /// Minus G^T lambda on the child.
    fn push(&mut self, cut: &Cut, view: &View, held: &Held) -> Push {
        let mut gap = [Scalar::ZERO; 3];
        let (mut along, mut moments) = (Vec::new(), Vec::new());
        for (&equation, &multiplier) in cut.equations.iter().zip(&held.multipliers) {
            if multiplier == Scalar::ZERO {
                continue;
            }
            match equation {
                Equation::Gap(k) => gap[k] = -multiplier,
                Equation::Along(k) => {
                    let axis = self.see_axis(view, &cut.ends[0], k);
                    along.push(self.g.scale(-multiplier, axis));
                }
                Equation::Turn(k, other) => {
                    let c = self.see_axis(view, &cut.ends[1], k);
                    let p = self.see_axis(view, &cut.ends[0], other);
                    let both = self.g.cross(c, p);
                    moments.push(self.g.scale(-multiplier, both));
                }
                Equation::Turns(k) => {
                    let axis = self.see_axis(view, &cut.ends[0], k);
                    moments.push(self.g.scale(-multiplier, axis));
                }
                Equation::Pitch(k, pitch) => {
                    let axis = self.see_axis(view, &cut.ends[0], k);
                    if held.open
                        && let Some((advance, twist)) = self.thread_slopes(cut, view, k, pitch)
                    {
                        let force = self.g.mul(multiplier, advance);
                        along.push(self.g.scale(-force, axis));
                        moments.push(self.g.scale(-multiplier, twist));
                        continue;
                    }
                    let turn = self.g.mul(pitch, multiplier);
                    along.push(self.g.scale(-multiplier, axis));
                    moments.push(self.g.scale(turn, axis));
                }
            }
        }
        let g = &mut self.g;
        Push { force: g.vector(gap), away: g.sum_vectors(&along), moment: g.sum_vectors(&moments) }
    }

    /// Adds a force at a frame's origin and a moment, both in the view's axes.
    fn apply(&mut self, gathered: &mut WrenchSums, view: &View, place: &FixedFrame, force: Vector, moment: Vector) {
        let Some(link) = place.link else { return };
        if force == Vector::ZERO && moment == Vector::ZERO {
            return;
        }
        if view.shares(self.hangs_on(view, place.link).is_some()) {
            let mechanism = Rc::clone(&self.scene.mechanism);
            let [force, moment] = [force, moment].map(|v| self.g.rotate(view.place.rotation, v));
            let arm = self.caches.world.rotate(&mut self.g, &mechanism.tree, place.link, place.offset);
            let lever = self.g.cross(arm, force);
            let (moments, forces) = gathered.world.entry(link).or_default();
            moments.extend([lever, moment]);
            forces.push(force);
            return;
        }
        let [force, moment] = [force, moment].map(|v| self.unsee(view, v, place.link));
        gathered.terms.force(&mut self.g, place, force);
        gathered.terms.wrench(link, moment, Vector::ZERO);
    }

    /// Rods and expressions.
    fn hold(&mut self, gathered: &mut WrenchSums, held: &Held) {
        let multiplier = held.multipliers[0];
        let model = self.scene.model;
        let LoopClosure::Constraint(id) = held.closing else { return };
        match &model.constraints[id].kind {
            ConstraintKind::Rod { between, .. } => {
                let ends = [self.place(&between[0]), self.place(&between[1])];
                let view = self.view(&ends, held.writing);
                let way = self.see_way(&view, &ends);
                let force = self.g.scale(multiplier, way);
                self.apply(gathered, &view, &ends[0], force, Vector::ZERO);
                self.apply(gathered, &view, &ends[1], -force, Vector::ZERO);
            }
            ConstraintKind::Value(_) | ConstraintKind::Rate(_) => self.hold_expression(gathered, id, multiplier),
        }
    }

    fn hold_expression(&mut self, gathered: &mut WrenchSums, id: ConstraintId, multiplier: Scalar) {
        let slopes = self.slopes(id);
        for &(link, wrench) in &slopes.wrenches {
            let (moments, forces) = gathered.world.entry(link).or_default();
            moments.push(self.g.scale(-multiplier, wrench.moment));
            forces.push(self.g.scale(-multiplier, wrench.force));
        }
        for &(coordinate, slope) in &slopes.efforts {
            let effort = -self.g.mul(multiplier, slope);
            if self.scene.model.cuts.contains(&coordinate.joint) {
                let mut efforts = vec![Scalar::ZERO; coordinate.index];
                efforts.push(effort);
                self.act_across(&mut gathered.terms, coordinate.joint, &efforts, true);
            } else {
                gathered.terms.effort(self.freedom(coordinate), effort);
            }
        }
    }

    /// Force and moment that the parent of a cut joint exerts on the child at the child frame, in the axes of a frame.
    pub fn cut_reaction(&mut self, joint: JointId, held: &Held, axes: &FixedFrame) -> [Vector; 2] {
        let Some(cut) = self.cut(joint) else { return [Vector::ZERO; 2] };
        let view = self.view(&cut.ends, held.writing);
        let push = self.push(&cut, &view, held);
        let force = self.g.add_vectors(push.force, push.away);
        [force, push.moment].map(|v| {
            let v = self.unsee(&view, v, axes.link);
            self.g.rotate(axes.rotation.transpose(), v)
        })
    }
}
