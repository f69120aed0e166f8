//! Stage `dynamics`: composite rigid bodies of long chains, with all wrenches about one point.
//!
//! In: a tree. Out: its mass matrix, as [`super::composite`] gives it. There the wrench that a unit acceleration asks for is handed on
//! from link to link towards the ground, turned and shifted at each: some fifty operations for an entry where axes are oblique.
//! Here it is written once about the origin and in the axes of the *root*, the first link of the chain (or what floats), and
//! so is the twist of each joint between: an entry is their product, six products and five sums. That takes the columns of all rotations,
//! which pay where chains are long.

use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::columns::Columns;
use super::composite::{composites, named, unit_wrench};
use super::newton_euler::{Wrench, to_parent};
use super::tree::{Link, Motion, Tree};

/// The symmetric mass matrix.
pub fn mass_matrix(g: &mut Graph, tree: &Tree) -> Vec<Vec<Scalar>> {
    let composites = composites(g, tree);
    let roots = roots(tree);
    let mut columns: Vec<Option<Columns>> = vec![None; tree.links.len()];
    let mut twists: Vec<Option<Wrench>> = vec![None; tree.links.len()];
    let n = tree.freedoms();
    let mut matrix = vec![vec![Scalar::ZERO; n]; n];
    for (index, link) in tree.links.iter().enumerate() {
        let root = roots[index];
        let columns = columns[root].get_or_insert_with(|| Columns::at(root));
        twists[index] = (root != index).then(|| twist(g, tree, columns, index));
        for (column, unit) in tree.twists(link) {
            let mut set = |row: usize, effort: Scalar| {
                matrix[row][column] = effort;
                matrix[column][row] = effort;
            };
            let mut wrench = unit_wrench(g, &composites[index], &unit);
            tree.project(g, link, wrench.moment, wrench.force).into_iter().for_each(|(row, effort)| set(row, effort));
            if root != index {
                wrench = at_root(g, tree, columns, index, &wrench);
                for between in tree.support(link.parent).take_while(|&between| between != root) {
                    if let Some(twist) = &twists[between] {
                        let (turn, push) = (g.dot(twist.moment, wrench.moment), g.dot(twist.force, wrench.force));
                        set(tree.links[between].freedom, g.add(turn, push));
                    }
                }
                let efforts = tree.project(g, &tree.links[root], wrench.moment, wrench.force);
                efforts.into_iter().for_each(|(row, effort)| set(row, effort));
            }
            let mut child = root;
            for ancestor in tree.support(tree.links[root].parent) {
                wrench = to_parent(g, tree, child, &wrench);
                let efforts = tree.project(g, &tree.links[ancestor], wrench.moment, wrench.force);
                efforts.into_iter().for_each(|(row, effort)| set(row, effort));
                child = ancestor;
            }
            matrix[column][column] = g.add(matrix[column][column], link.armature);
        }
    }
    named(g, &matrix);
    matrix
}

/// Where it can be another way than link by link.
pub fn differs(tree: &Tree) -> bool {
    let roots = roots(tree);
    let is_far = |(index, link): (usize, &Link)| link.parent.is_some_and(|parent| roots[index] != parent);
    tree.links.iter().enumerate().any(is_far)
}

/// Of each link the outermost that carries it and turns freely, or else the first of its chain; itself, if it is one.
fn roots(tree: &Tree) -> Vec<usize> {
    let mut roots: Vec<usize> = Vec::with_capacity(tree.links.len());
    for (index, link) in tree.links.iter().enumerate() {
        roots.push(match link.parent {
            Some(parent) if !matches!(link.motion, Motion::Ball(_)) => roots[parent],
            _ => index,
        });
    }
    roots
}

/// Components of a link's wrench in the axes of the root, its moment about the origin there.
fn at_root(g: &mut Graph, tree: &Tree, columns: &mut Columns, index: usize, wrench: &Wrench) -> Wrench {
    let force = columns.rotate(g, tree, Some(index), wrench.force);
    let moment = columns.rotate(g, tree, Some(index), wrench.moment);
    let origin = columns.origin(g, tree, Some(index));
    let lever = g.cross(origin, force);
    Wrench { moment: g.add_vectors(moment, lever), force }
}

/// Twist of a joint with one coordinate, by what a moment and a force at the root's origin work along it: angular and linear part.
fn twist(g: &mut Graph, tree: &Tree, columns: &mut Columns, index: usize) -> Wrench {
    let along = |g: &mut Graph, columns: &mut Columns, axis: usize| {
        let unit = g.along(axis, Scalar::ONE);
        columns.rotate(g, tree, Some(index), unit)
    };
    let swing = |g: &mut Graph, columns: &mut Columns, axis: Vector| {
        let origin = columns.origin(g, tree, Some(index));
        g.cross(origin, axis)
    };
    match tree.links[index].motion {
        Motion::Revolute(axis) => {
            let axis = along(g, columns, axis);
            Wrench { moment: axis, force: swing(g, columns, axis) }
        }
        Motion::Prismatic(axis) => Wrench { moment: Vector::ZERO, force: along(g, columns, axis) },
        Motion::Screw(axis, pitch) => {
            let axis = along(g, columns, axis);
            let (swing, travel) = (swing(g, columns, axis), g.scale(pitch, axis));
            Wrench { moment: axis, force: g.add_vectors(swing, travel) }
        }
        // It is a root itself.
        Motion::Ball(_) => Wrench::ZERO,
    }
}
