//! Stage `dynamics`: recursive Newton-Euler (Luh, Walker and Paul 1980; Featherstone 2008, chapter 5).
//!
//! In: a tree, its motion, forces that act on its links. Out: the wrenches that the joints transmit, and the efforts. With
//! the moments (m, h, D) of [`super::inertia`] and the field U of [`super::kinematics`] a link's force is m a + U h, and
//! its moment about the origin h x a plus the axial vector of U D - (U D)^T, so no product of an inertia tensor with a
//! vector is left.

use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::inertia::entry;
use super::kinematics::{Field, LinkMotion};
use super::tree::{Link, Tree};

/// Moment about a link's origin and force, in link axes.
#[derive(Clone, Copy, Debug)]
pub struct Wrench {
    pub moment: Vector,
    pub force: Vector,
}

impl Wrench {
    pub const ZERO: Wrench = Wrench { moment: Vector::ZERO, force: Vector::ZERO };

    pub fn add(&self, g: &mut Graph, other: &Wrench) -> Wrench {
        Wrench { moment: g.add_vectors(self.moment, other.moment), force: g.add_vectors(self.force, other.force) }
    }
}

/// The rate of a link's momentum: the wrench it takes to move it so.
pub fn inertial_wrench(g: &mut Graph, link: &Link, motion: &LinkMotion) -> Wrench {
    let inertia = &link.inertia;
    if inertia.is_zero() {
        return Wrench::ZERO;
    }
    let field = Field::new(g, motion, &link.name);
    let turning = field.apply(g, inertia.first);
    let pushed = g.scale(inertia.mass, motion.linear_rate);
    let force = g.add_vectors(pushed, turning);
    let first = g.vector(inertia.first);
    let lever = g.cross(first, motion.linear_rate);
    let lever = if broken(Break::LeverSign) { -lever } else { lever };
    let spin = spin_moment(g, &field, &inertia.second);
    Wrench { moment: g.add_vectors(lever, spin), force }
}

/// Moment of a distribution that turns: axial vector of U D - (U D)^T. Component i is the sum over k of U_bk D_ka - U_ak D_kb, with
/// (i, a, b) cyclic. Where two second moments are equal, or opposite, both entries of U between them have one factor: their
/// difference, 2 dw_i, or their sum, 2 w_a w_b.
pub fn spin_moment(g: &mut Graph, field: &Field, second: &[Scalar; 6]) -> Vector {
    let components = [0, 1, 2].map(|i| {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        let mut terms = Vec::with_capacity(5);
        let mut term = |g: &mut Graph, d: Scalar, u: &dyn Fn(&mut Graph) -> Scalar, minus: bool| {
            if d != Scalar::ZERO {
                let u = u(g);
                let product = g.mul(d, u);
                terms.push(if minus { -product } else { product });
            }
        };
        let twice = g.add(second[a], second[a]);
        if second[a] == second[b] {
            term(g, twice, &|_| field.angular_rate(i), false);
        } else if second[a] == -second[b] {
            term(g, twice, &|g| field.product(g, a, b), false);
        } else {
            term(g, second[a], &|g| field.entry(g, b, a), false);
            term(g, second[b], &|g| field.entry(g, a, b), true);
        }
        term(g, second[entry(i, a)], &|g| field.entry(g, b, i), false);
        term(g, second[entry(i, b)], &|g| field.entry(g, a, i), true);
        term(g, second[entry(a, b)], &|g| field.difference(g, b, a), false);
        g.sum(&terms)
    });
    g.vector(components)
}

/// What passes through each joint, from the leaves inwards: what the link needs, less what acts on it from outside.
pub fn transmitted(g: &mut Graph, tree: &Tree, motions: &[LinkMotion], applied: &[Wrench]) -> Vec<Wrench> {
    let mut wrenches: Vec<Wrench> = Vec::with_capacity(tree.links.len());
    for ((link, motion), outside) in tree.links.iter().zip(motions).zip(applied) {
        let needed = inertial_wrench(g, link, motion);
        let outside = Wrench { moment: -outside.moment, force: -outside.force };
        wrenches.push(needed.add(g, &outside));
    }
    for index in (0..tree.links.len()).rev() {
        let link = &tree.links[index];
        let name = &link.name;
        let wrench = wrenches[index];
        g.under(&format!("Force and moment through {name}."), |g| {
            g.name_vector(wrench.force, || format!("f_{name}"));
            g.name_vector(wrench.moment, || format!("n_{name}"));
        });
        let Some(parent) = link.parent else { continue };
        let carried = to_parent(g, tree, index, &wrench);
        wrenches[parent] = wrenches[parent].add(g, &carried);
    }
    wrenches
}

/// A wrench at a link's origin as its parent sees it.
pub fn to_parent(g: &mut Graph, tree: &Tree, index: usize, wrench: &Wrench) -> Wrench {
    let link = &tree.links[index];
    let force = tree.to_parent(g, link, wrench.force);
    let moment = tree.to_parent(g, link, wrench.moment);
    g.name_vector(force, || format!("f_{}_passed", link.name));
    g.name_vector(moment, || format!("n_{}_passed", link.name));
    let origin = tree.origin(g, link);
    let lever = g.cross(origin, force);
    Wrench { moment: g.add_vectors(moment, lever), force }
}

/// Efforts in the order of the coordinates; armature included.
pub fn efforts(g: &mut Graph, tree: &Tree, wrenches: &[Wrench], acceleration: &[Scalar]) -> Vec<Scalar> {
    let mut efforts = vec![Scalar::ZERO; tree.freedoms()];
    for (link, wrench) in tree.links.iter().zip(wrenches) {
        for (freedom, effort) in tree.project(g, link, wrench.moment, wrench.force) {
            let rotor = g.mul(link.armature, acceleration[freedom]);
            efforts[freedom] = g.add(effort, rotor);
        }
    }
    efforts
}
