//! Stage `model`: mass matrices that are singular by structure.
//!
//! In: bodies, joints, the tree, at the declared defaults. Out: an error that names the coordinate which nothing
//! resists, such as a rod's idle spin.
//!
//! The mass matrix factors as `L' D L` from the branch ends to the ground, where the blocks of `D` are `S' I S` with the
//! articulated inertias `I` (Featherstone 2008, section 7.3). It is singular where a block is, so one pass per
//! configuration, linear in the number of bodies, finds it; and only a block that is singular in all of several
//! configurations is singular by structure.

use crate::invariant::fault::OrFault;
use crate::invariant::index_vec::IndexVec;
use crate::model::checker::Checker;
use crate::model::types::{Bodies, BodyId, JointId, Joints};

use super::configuration::{Configuration, Link};
use super::massless::carried;
use super::spatial::{Matrix6, Vector6, accumulate, apply, deflate, dot6, magnitude, shifted};

/// Configurations that are tried.
const TRIALS: u64 = 5;

/// A pivot below this, relative to what it would be without cancellation, is none.
const SMALL: f64 = 1e-12;

/// Reported at most; the rest would be the same mistake again.
const MAX_REPORTED: usize = 16;

/// One joint during a pass.
struct Pass {
    /// Of the body and all beyond it, as one rigid body.
    composite: Matrix6,
    articulated: Matrix6,
}

/// A joint with an idle motion, and how much each of its coordinates takes part in that.
struct Idle {
    /// Position in the tree.
    joint: usize,
    shares: Vec<f64>,
}

impl Checker<'_, '_> {
    pub(in crate::model) fn check_mass_matrix(
        &mut self,
        bodies: &Bodies,
        joints: &Joints,
        tree: &[JointId],
        held: &IndexVec<BodyId, bool>,
    ) {
        let Some(links) = self.links(bodies, joints, tree) else {
            return;
        };
        let mut idle: Vec<Idle> = Vec::new();
        for trial in 0..TRIALS {
            let configuration = Configuration::random(&links, trial);
            let mut found = eliminate(&links, &configuration);
            // What a loop holds is no idle motion for sure.
            found.retain(|idle| !is_held(idle, joints, tree, held));
            if trial == 0 {
                idle = found;
            } else {
                idle.retain_mut(|old| {
                    let same = found.iter().find(|new| new.joint == old.joint);
                    for (sum, share) in old.shares.iter_mut().zip(same.iter().flat_map(|new| &new.shares)) {
                        *sum += share;
                    }
                    same.is_some()
                });
            }
            if idle.is_empty() {
                return;
            }
        }
        idle.sort_by_key(|idle| idle.joint);
        for idle in &idle {
            self.report_idle(idle, joints, tree);
        }
    }

    fn report_idle(&mut self, idle: &Idle, joints: &Joints, tree: &[JointId]) {
        let largest = idle.shares.iter().copied().fold(0.0, f64::max);
        // The first of equals: rounding must not decide.
        let coordinate = idle.shares.iter().position(|share| *share > 0.999 * largest);
        let joint = &joints[tree[idle.joint]];
        let coordinate = coordinate.or_fault("an idle motion has a share in a coordinate");
        let kind = joint.kind;
        let name = kind.coordinate_text(&joint.place.field.to_string(), coordinate);
        let help = if kind.freedoms() == 1 {
            "give the bodies beyond it inertia in this direction, or the joint an `armature`"
        } else {
            "give the bodies beyond it inertia in this direction, or take a joint without this freedom"
        };
        self.report.help(
            joint.span,
            format!("the mass matrix is singular by structure: nothing resists the coordinate {name}"),
            help,
        );
    }
}

fn is_held(idle: &Idle, joints: &Joints, tree: &[JointId], held: &IndexVec<BodyId, bool>) -> bool {
    held[carried(&joints[tree[idle.joint]])]
}

/// One pass from the branch ends to the ground.
fn eliminate(links: &[Link], configuration: &Configuration) -> Vec<Idle> {
    let mut passes: Vec<Pass> =
        links.iter().map(|link| Pass { composite: link.inertia, articulated: link.inertia }).collect();
    let mut idle = Vec::new();
    for (index, link) in links.iter().enumerate().rev() {
        let (motion, pass) = (&configuration.joints[index], &mut passes[index]);
        let null = pivots(pass, &motion.axes, link.armature);
        let (composite, articulated) = (pass.composite, pass.articulated);
        if let (Some(shares), true) = (null, idle.len() < MAX_REPORTED) {
            idle.push(Idle { joint: index, shares });
        }
        if let Some(parent) = link.parent.map(|parent| &mut passes[parent]) {
            accumulate(&mut parent.composite, &shifted(&composite, motion));
            accumulate(&mut parent.articulated, &shifted(&articulated, motion));
        }
    }
    idle
}

/// Eliminates the coordinates of one joint from its articulated inertia, the best conditioned first. If there is an idle
/// direction it is left in, and the answer says how much each coordinate has of it, between 0 and 1.
fn pivots(pass: &mut Pass, axes: &[Vector6], armature: f64) -> Option<Vec<f64>> {
    // Coordinate, axis, its share in every coordinate once those before it are held fixed, size without cancellation.
    let mut open: Vec<(Vector6, Vec<f64>, f64)> = Vec::new();
    for (k, axis) in axes.iter().enumerate() {
        let size = magnitude(&pass.composite, axis) + armature;
        let one = |j| if j == k { 1.0 } else { 0.0 };
        open.push((*axis, (0..axes.len()).map(one).collect(), size));
    }
    let sizes: Vec<f64> = open.iter().map(|(.., size)| size.sqrt()).collect();
    loop {
        let mut best: Option<(usize, f64, f64)> = None;
        for (k, (axis, _, size)) in open.iter().enumerate() {
            let pivot = dot6(&apply(&pass.articulated, axis), axis) + armature;
            let relative = if *size > 0.0 { pivot / size } else { 0.0 };
            if best.is_none_or(|(.., most)| relative > most) {
                best = Some((k, pivot, relative));
            }
        }
        let (k, pivot, relative) = best?;
        let (axis, mix, size) = open.swap_remove(k);
        if relative <= SMALL {
            // A coordinate without any inertia is idle by itself.
            let shares = mix.iter().zip(&sizes);
            let shares: Vec<f64> =
                shares.map(|(x, size)| if size.is_normal() { (x * size).abs() } else { x.abs() }).collect();
            let largest = shares.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
            let alone = mix.iter().map(|x| if *x == 1.0 { 1.0 } else { 0.0 });
            return Some(if size > 0.0 {
                shares.iter().map(|share| share / largest).collect()
            } else {
                alone.collect()
            });
        }
        let force = apply(&pass.articulated, &axis);
        for (other, others, _) in &mut open {
            let factor = dot6(&force, other) / pivot;
            for (o, x) in others.iter_mut().zip(&mix) {
                *o -= factor * x;
            }
        }
        deflate(&mut pass.articulated, &force, pivot);
    }
}
