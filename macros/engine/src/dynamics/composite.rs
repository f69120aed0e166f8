//! Stage `dynamics`: composite rigid bodies (Walker and Orin 1982; Featherstone 2008, chapter 6).
//!
//! In: a tree. Out: its mass matrix. The composite of a subtree is the sum of its links' moments; a unit acceleration of
//! a joint gives the composite the force s x h + m v and a moment, whose projections on the joints towards the ground
//! are a row of the matrix. Entries between branches are zero and stay so.

use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::inertia::Inertia;
use super::newton_euler::{Wrench, to_parent};
use super::tree::{Motion, Tree};

/// The symmetric mass matrix.
pub fn mass_matrix(g: &mut Graph, tree: &Tree) -> Vec<Vec<Scalar>> {
    let composites = composites(g, tree);
    let n = tree.freedoms();
    let mut matrix = vec![vec![Scalar::ZERO; n]; n];
    let still: Vec<bool> = (0..tree.links.len()).map(|index| tree.turns_columns && !tree.moves(g, index)).collect();
    for (index, link) in tree.links.iter().enumerate() {
        for (column, twist) in tree.twists(link) {
            let mut wrench = unit_wrench(g, &composites[index], &twist);
            let mut child = None;
            for ancestor in tree.support(Some(index)) {
                if let Some(child) = child.replace(ancestor) {
                    if still[child] && !still[index] {
                        // All hinges from here on go through one point, about which the moment is known.
                        let outermost = tree.support(Some(index)).find(|&at| still[at]).unwrap_or(child);
                        let axis = axis_in(g, tree, ancestor, outermost);
                        let effort = g.dot(axis, wrench.moment);
                        let row = tree.links[ancestor].freedom;
                        (matrix[row][column], matrix[column][row]) = (effort, effort);
                        continue;
                    }
                    wrench = match still[ancestor] {
                        true => about_still(g, tree, child, &wrench),
                        false => to_parent(g, tree, child, &wrench),
                    };
                }
                // What a unit acceleration of the column's coordinate asks for at each link below.
                let at = &tree.links[ancestor].name;
                g.label_vector(wrench.force, || format!("f_{}_by_{}", at, column + 1));
                g.label_vector(wrench.moment, || format!("n_{}_by_{}", at, column + 1));
                for (row, effort) in tree.project(g, &tree.links[ancestor], wrench.moment, wrench.force) {
                    matrix[row][column] = effort;
                    matrix[column][row] = effort;
                }
            }
            matrix[column][column] = g.add(matrix[column][column], link.armature);
        }
    }
    named(g, &matrix);
    matrix
}

/// The axis of a hinge in the axes of a link further out.
fn axis_in(g: &mut Graph, tree: &Tree, hinge: usize, link: usize) -> Vector {
    let axis = tree.links[hinge].motion.axis().map_or(Vector::ZERO, |axis| g.along(axis, Scalar::ONE));
    tree.path(Some(hinge), Some(link)).into_iter().fold(axis, |axis, at| tree.to_link(g, &tree.links[at], axis))
}

/// A link's wrench about the origin of its carrier, which stands still, so that the force counts no more. Across the hinge the lever
/// is turned into the link's axes, once for all columns, and not the force of each.
fn about_still(g: &mut Graph, tree: &Tree, index: usize, wrench: &Wrench) -> Wrench {
    let link = &tree.links[index];
    let lever = tree.to_link(g, link, link.offset);
    let Motion::Revolute(axis) = link.motion else { return to_parent(g, tree, index, wrench) };
    if g.components(lever)[axis] != Scalar::ZERO {
        return to_parent(g, tree, index, wrench);
    }
    let across = g.cross(lever, wrench.force);
    let across = g.components(across)[axis];
    let across = g.along(axis, across);
    let moment = g.add_vectors(wrench.moment, across);
    let along = g.components(wrench.force)[axis];
    let along = g.along(axis, along);
    let along = g.rotate(link.rotation, along);
    let rest = g.cross(link.offset, along);
    let moment = tree.to_parent(g, link, moment);
    Wrench { moment: g.add_vectors(moment, rest), force: Vector::ZERO }
}

/// Says which entries of a mass matrix its values are.
pub(super) fn named(g: &mut Graph, matrix: &[Vec<Scalar>]) {
    for (i, row) in matrix.iter().enumerate() {
        for (j, &entry) in row.iter().enumerate().skip(i) {
            g.under("Mass matrix.", |g| g.name(entry, || format!("m_{}_{}", i + 1, j + 1)));
        }
    }
}

/// Moments of each link's subtree about the link's origin.
pub(crate) fn composites(g: &mut Graph, tree: &Tree) -> Vec<Inertia> {
    let mut composites: Vec<Inertia> = tree.links.iter().map(|link| link.inertia).collect();
    for index in (0..tree.links.len()).rev() {
        let link = &tree.links[index];
        let Some(parent) = link.parent else { continue };
        let turned = match link.motion {
            Motion::Revolute(axis) | Motion::Screw(axis, _) => composites[index].turn(g, axis, link.q),
            Motion::Prismatic(_) => composites[index],
            Motion::Ball(orientation) => {
                let r = orientation.rotation(g);
                composites[index].turned(g, r)
            }
        };
        let placed = turned.rotate(g, link.rotation);
        let origin = tree.origin(g, link);
        let mut origin = g.components(origin);
        if broken(Break::CompositeShift) {
            origin[0] = -origin[0];
        }
        let shifted = placed.shift(g, origin);
        composites[parent] = composites[parent].add(g, &shifted);
    }
    for (link, composite) in tree.links.iter().zip(&composites) {
        let heading = format!("Inertia of {} and all that it carries.", link.name);
        g.under(&heading, |g| composite.label(g, &format!("{}_outward", link.name)));
    }
    composites
}

/// The wrench that gives a body at rest this unit acceleration (angular, linear).
pub(crate) fn unit_wrench(g: &mut Graph, inertia: &Inertia, twist: &[Scalar; 6]) -> Wrench {
    let angular = g.vector([twist[0], twist[1], twist[2]]);
    let linear = g.vector([twist[3], twist[4], twist[5]]);
    let first = g.vector(inertia.first);
    let swing = g.cross(angular, first);
    let push = g.scale(inertia.mass, linear);
    let lever = g.cross(first, linear);
    let rows = [0, 1, 2].map(|i| {
        let terms = [0, 1, 2].map(|j| {
            if twist[j] == Scalar::ZERO {
                return Scalar::ZERO;
            }
            let entry = inertia.tensor(g, i, j);
            g.mul(entry, twist[j])
        });
        g.sum(&terms)
    });
    let turn: Vector = g.vector(rows);
    Wrench { moment: g.add_vectors(turn, lever), force: g.add_vectors(push, swing) }
}
