//! Stage `dynamics`: what floats.
//!
//! In: a tree. Out: its [`FloatingBase`]s. The three translations of a free body and the two of a planar one are declared along
//! the axes of what the body moves against, but they span the same space in the body's own axes, since a rigid
//! translation moves every point alike. Eliminated there, together with the rotation and before it, a rigid body's mass
//! is the same in all directions and what is left of it is its inertia about the centre of mass: constants, wherever the
//! body's frame stands. Along the declared axes the first moment would turn with the body.

use crate::symbolic::graph::{Rotation, Scalar};

use super::tree::{Link, Motion, Tree};

/// A link that is carried by translations in every direction in which its rotation could turn them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FloatingBase {
    pub link: usize,
    /// Massless links with the translations, outwards; the axes of all are those of the first.
    pub slides: Vec<usize>,
    /// Massless links that turn between these and the floating base, outwards.
    pub turners: Vec<usize>,
}

impl FloatingBase {
    /// Links before the floating base.
    pub fn carriers(&self) -> impl Iterator<Item = usize> + '_ {
        self.slides.iter().chain(&self.turners).copied()
    }
}

/// All floating bases of a tree whose inertias have not been regrouped.
pub fn floating_bases(tree: &Tree) -> Vec<FloatingBase> {
    let mut floating_bases: Vec<FloatingBase> = Vec::new();
    for index in 0..tree.links.len() {
        // The last two of three translations are no floating base of their own.
        if !floating_bases.iter().any(|floating_base| floating_base.slides.contains(&index)) {
            floating_bases.extend(floating_base(tree, index));
        }
    }
    floating_bases
}

/// The floating base whose translations begin with a link.
fn floating_base(tree: &Tree, first: usize) -> Option<FloatingBase> {
    let slide = |index: usize| match tree.links[index].motion {
        Motion::Prismatic(axis) if is_carrier(&tree.links[index]) => Some(axis),
        _ => None,
    };
    let mut axes = vec![slide(first)?];
    let mut slides = vec![first];
    let mut link = only_child(tree, first)?;
    while let Some(axis) = slide(link).filter(|axis| is_aligned(&tree.links[link]) && !axes.contains(axis)) {
        axes.push(axis);
        slides.push(link);
        link = only_child(tree, link)?;
    }
    let mut turners = Vec::new();
    match (axes.as_slice(), tree.links[link].motion) {
        (&[_, _, _], _) => {
            while matches!(tree.links[link].motion, Motion::Revolute(_) | Motion::Ball(_))
                && is_carrier(&tree.links[link])
            {
                turners.push(link);
                link = only_child(tree, link)?;
            }
        }
        (&[a, b], Motion::Revolute(axis))
            if a + b + axis == 3 && axis != a && axis != b && is_aligned(&tree.links[link]) => {}
        _ => return None,
    }
    matches!(tree.links[link].motion, Motion::Revolute(_) | Motion::Ball(_)).then_some(FloatingBase {
        link,
        slides,
        turners,
    })
}

/// Its axes are its parent's while its coordinate is zero.
fn is_aligned(link: &Link) -> bool {
    link.rotation == Rotation::IDENTITY
}

/// Without inertia of its own.
fn is_carrier(link: &Link) -> bool {
    link.inertia.is_zero() && link.armature == Scalar::ZERO
}

fn only_child(tree: &Tree, parent: usize) -> Option<usize> {
    let mut children = (0..tree.links.len()).filter(|&child| tree.links[child].parent == Some(parent));
    let child = children.next()?;
    children.next().is_none().then_some(child)
}
