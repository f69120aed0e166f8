//! Stage `mechanics`: the mass matrix, where it may become singular.
//!
//! In: the model. Out: its entries, for what the runtime says of accelerations that are not finite. A model is left out
//! if its literals prove that nothing moves without energy, and if its matrix is singular by structure while constraints
//! hold what is idle: then a pivot says nothing. Lengths and masses that are parameters may be zero, whatever
//! `Params::check` says of them, so they prove nothing.

use crate::contracts::results::Results;
use crate::mechanics::Inertia;
use crate::model::types::{Body, BodyRef, Expr, Joint, Request};
use crate::symbolic::graph::Scalar;
use crate::symbolic::linear_algebra::Factors;

use super::super::equations::Equations;
use super::{Complaint, Deriving, MOST_COMPOSITE};

/// What a pivot of an inertia tensor must be of its greatest entry.
const CLEAR: f64 = 1e-9;

impl Deriving<'_> {
    /// The mass matrix of the state, row by row.
    pub(super) fn inertia(&mut self) -> Result<Inertia<Vec<Scalar>>, Vec<Complaint>> {
        let size = self.structure.freedoms();
        if !self.model.emit.contains(&Request::ForwardDynamics) || size == 0 || size > MOST_COMPOSITE {
            return Ok(Inertia::Regular);
        }
        let (open, held) = (self.is_open(), !self.structure.rows.is_empty());
        let found = self.only("", |e| {
            if e.is_never_singular() {
                return Ok(Results::default());
            }
            let entries = if open {
                e.mass_matrix()
            } else {
                let reduction = e.reduce()?;
                e.reduced_mass_matrix(&reduction).concat()
            };
            let idle = held && e.is_singular(&entries, size);
            let literal = entries.iter().all(|&entry| e.g.literal(entry).is_some()) && !e.is_singular(&entries, size);
            Ok(match idle || literal || entries.len() != size * size {
                true => Results::default(),
                false => Results::matrix(size, size, entries),
            })
        })?;
        let entries = found.into_iter().next().map(|(_, entries)| entries.list).unwrap_or_default();
        Ok(match entries.is_empty() {
            true => Inertia::Regular,
            false if self.model.emit.contains(&Request::MassMatrix) => Inertia::Requested,
            false => Inertia::Own(entries),
        })
    }
}

impl Equations<'_> {
    /// Whether a pivot vanishes whatever the state and the parameters are.
    fn is_singular(&mut self, entries: &[Scalar], size: usize) -> bool {
        let matrix: Vec<Vec<Scalar>> = entries.chunks(size.max(1)).map(<[Scalar]>::to_vec).collect();
        let order: Vec<usize> = (0..matrix.len()).rev().collect();
        Factors::new(&mut self.g, &matrix, &order).singular().is_some()
    }

    /// Whether no motion is without energy, by literals alone: every joint moves a body that resists in all directions,
    /// or has an armature, so all is at rest where the energy is zero. Roll, pitch and yaw may move while a body rests.
    fn is_never_singular(&mut self) -> bool {
        let model = self.scene.model;
        let resists: Vec<Option<bool>> = model.bodies.iter().map(|body| self.resists(body)).collect();
        resists.iter().all(Option::is_some)
            && model.joints.iter().all(|joint| {
                let armature = joint.armature.as_ref().map_or(Some(0.0), |armature| self.number(armature));
                let child = match joint.child.body {
                    BodyRef::Body(id) => resists.get(id.0) == Some(&Some(true)),
                    BodyRef::Ground => true,
                };
                armature.is_some_and(|a| a >= 0.0 && (child || a > 0.0 && has_one_axis(joint)))
                    && !joint.kind.has_angles()
                    || joint.kind.freedoms() == 0
            })
    }

    /// Whether a body resists every motion; nothing where parameters decide, or where its mass is negative.
    fn resists(&mut self, body: &Body) -> Option<bool> {
        let mass = self.number(&body.mass).filter(|&mass| mass >= 0.0)?;
        let Some(entries) = &body.inertia else { return Some(false) };
        let mut tensor = [0.0; 6];
        for (slot, entry) in tensor.iter_mut().zip(entries.iter()) {
            *slot = self.number(entry)?;
        }
        let [xx, yy, zz, xy, xz, yz] = tensor;
        let least = CLEAR * xx.max(yy).max(zz);
        let (b, c) = (yy - xy / xx * xy, zz - xz / xx * xz);
        let d = yz - xy / xx * xz;
        Some(mass > 0.0 && xx > least && b > least && c - d / b * d > least)
    }

    /// The value of an expression without symbols.
    fn number(&mut self, expr: &Expr) -> Option<f64> {
        let value = self.scalar(expr);
        self.g.literal(value).map(|number| number.value())
    }
}

/// Whether the armature is the inertia of all that the joint moves.
fn has_one_axis(joint: &Joint) -> bool {
    joint.kind.freedoms() == 1
}
