//! Stage `mechanics`: Jacobians of frames.
//!
//! In: a frame, axes. Out: per velocity of the state the partial velocity of the frame's origin and its partial angular
//! velocity. On the tree, for a motion about an axis z through o these are z x (p - o) and z, for one along it z and 0. All
//! are written in the wanted axes from the start, so a frame's own axes cost no turn at the end. Where coordinates follow
//! from others or from time, the columns of the tree times the velocity map are those of the state: J S.

use std::rc::Rc;

use crate::dynamics::columns::Columns;
use crate::dynamics::tree::Motion;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::translate::build::FixedFrame;
use crate::mechanics::translate::values::Value;
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

impl Equations<'_> {
    /// Linear rows, then angular ones.
    pub(in crate::mechanics) fn jacobian(&mut self, place: &FixedFrame, axes: &FixedFrame) -> Value {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        let plain = axes.link.is_none() && axes.rotation == Rotation::IDENTITY;
        let mut own = Columns::new(axes.link, axes.rotation.transpose());
        let g = &mut self.g;
        let columns = if plain { &mut self.caches.world } else { &mut own };
        let mut rows: [Vec<Scalar>; 6] = std::array::from_fn(|_| vec![Scalar::ZERO; self.scene.symbols.places()]);
        let point = columns.point(g, tree, place.link, place.offset);
        for index in tree.support(place.link) {
            let link = &tree.links[index];
            if link.freedom >= self.scene.symbols.places() {
                continue;
            }
            let turned = columns.of(g, tree, Some(index));
            let origin = columns.origin(g, tree, Some(index));
            let arm = g.sub_vectors(point, origin);
            let axes: &[usize] = match &link.motion {
                Motion::Revolute(axis) | Motion::Prismatic(axis) | Motion::Screw(axis, _) => &[*axis],
                Motion::Ball(_) => &[0, 1, 2],
            };
            for (k, &axis) in axes.iter().enumerate() {
                let freedom = link.freedom + k;
                let z = if mechanism.flipped.get(freedom) == Some(&true) { -turned[axis] } else { turned[axis] };
                let swing = g.cross(z, arm);
                let (linear, angular) = match link.motion {
                    Motion::Prismatic(_) => (z, Vector::ZERO),
                    Motion::Screw(_, pitch) => {
                        let travel = g.scale(pitch, z);
                        (g.add_vectors(swing, travel), z)
                    }
                    Motion::Revolute(_) | Motion::Ball(_) => (swing, z),
                };
                let (linear, angular) = (g.components(linear), g.components(angular));
                for (row, entry) in rows.iter_mut().zip(linear.into_iter().chain(angular)) {
                    row[freedom] = entry;
                }
            }
        }
        Value::Jacobian(Rc::new(self.by_velocity_of_state(rows)))
    }

    /// Rows by velocity of the tree, as they are by velocity of the state.
    pub(super) fn by_velocity_of_state(&mut self, rows: [Vec<Scalar>; 6]) -> [Vec<Scalar>; 6] {
        match self.reduced.clone() {
            Some(reduction) => self.by_state(&reduction, &rows),
            None => rows,
        }
    }

    /// Coefficients of the state's velocities, from those of the tree's.
    fn by_state(&mut self, reduction: &Reduction, rows: &[Vec<Scalar>; 6]) -> [Vec<Scalar>; 6] {
        let speeds = self.speeds();
        let map = self.velocity_map(reduction, &speeds);
        let g = &mut self.g;
        rows.each_ref().map(|row| {
            let column = |g: &mut Graph, j: usize| {
                let terms: Vec<Scalar> = row.iter().zip(&map).map(|(&entry, map)| g.mul(entry, map[j])).collect();
                g.sum(&terms)
            };
            (0..speeds.len()).map(|j| column(g, j)).collect()
        })
    }
}
