//! The dynamics of a tree, derived in every way that the engine knows.

use multibody_engine::dynamics::floating_bases::floating_bases;
use multibody_engine::dynamics::newton_euler::{Wrench, efforts, transmitted};
use multibody_engine::dynamics::tree::Tree;
use multibody_engine::dynamics::{articulated, composite, kinematics};
use multibody_engine::symbolic::graph::{Graph, Scalar, Vector};
use multibody_engine::symbolic::linear_algebra::solve_symmetric;

/// Minus gravity, in world axes.
fn base(g: &mut Graph, tree: &Tree) -> Vector {
    tree.gravity.map_or(Vector::ZERO, |gravity| g.vector(gravity.map(|s| -s)))
}

pub(crate) fn inverse_dynamics(
    g: &mut Graph,
    tree: &Tree,
    velocity: &[Scalar],
    acceleration: &[Scalar],
) -> Vec<Scalar> {
    let base = base(g, tree);
    let motions = kinematics::motions(g, tree, velocity, acceleration, base);
    let wrenches = transmitted(g, tree, &motions, &no_forces(tree));
    efforts(g, tree, &wrenches, acceleration)
}

pub(crate) fn bias(g: &mut Graph, tree: &Tree) -> Vec<Scalar> {
    let still = vec![Scalar::ZERO; tree.freedoms()];
    inverse_dynamics(g, tree, &tree.velocity, &still)
}

/// Row by row.
pub(crate) fn mass_matrix(g: &mut Graph, tree: &Tree) -> Vec<Scalar> {
    composite::mass_matrix(g, tree).concat()
}

/// Accelerations by composite rigid bodies and L^T D L.
pub(crate) fn by_composite(g: &mut Graph, tree: &Tree, applied: &[Scalar]) -> Vec<Scalar> {
    let bias = bias(g, tree);
    let matrix = composite::mass_matrix(g, tree);
    let rest: Vec<Scalar> = applied.iter().zip(&bias).map(|(&a, &b)| g.sub(a, b)).collect();
    let leaves_first: Vec<usize> =
        tree.links.iter().rev().flat_map(|link| (0..link.motion.freedoms()).map(|k| link.freedom + k)).collect();
    solve_symmetric(g, &matrix, &leaves_first, &rest)
}

/// Accelerations by articulated bodies.
pub(crate) fn by_articulated(g: &mut Graph, tree: &Tree, applied: &[Scalar]) -> Vec<Scalar> {
    let base = base(g, tree);
    articulated::forward_dynamics(g, tree, &floating_bases(tree), &tree.velocity, base, &no_forces(tree), applied)
}

fn no_forces(tree: &Tree) -> Vec<Wrench> {
    vec![Wrench::ZERO; tree.links.len()]
}
