//! Stage `mechanics`: struts found in a tree.
//!
//! In: a tree, one of its links and a point of that link at which a ball closes a loop. Out: the chain of a strut, if
//! the links down to the point are one: a centre with two or more revolute motions through it, or a ball, then a
//! prismatic motion through the centre along a line that holds the point and all mass. Nothing else may hang on these
//! links, and no effort act on the motions at the centre: that is for the caller to see to, who knows forces.
//!
//! Link by link inertias are read: the tree must not have been regrouped.

use crate::dynamics::inertia::Inertia;
use crate::dynamics::tree::{Link, Motion, Tree};
use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::Strut;
use super::triple::{Triple, UNITS};

/// A strut as it stands in a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The link that carries the centre; `None`: the ground.
    pub parent: Option<usize>,
    /// The centre in that link's axes.
    pub centre: Triple,
    /// From the centre to the point.
    pub links: Vec<usize>,
    /// The link that slides: the last one.
    pub slide: usize,
    /// Signed distance from centre to point along the slide's axis where its coordinate is zero.
    pub zero: Scalar,
    /// Moments where the point lies on the positive side of the axis.
    pub strut: Strut,
    /// What joins the body at the point.
    pub mass: Scalar,
}

impl Chain {
    /// The words with which the names of all links begin, or that of the link that slides.
    pub fn name(&self, tree: &Tree) -> String {
        let names: Vec<Vec<&str>> = self.links.iter().map(|&at| tree.links[at].name.split('_').collect()).collect();
        let Some((last, others)) = names.split_last() else { return String::new() };
        let common = |k: usize| others.iter().all(|name| name.get(k) == last.get(k));
        match (0..last.len()).take_while(|&k| common(k)).count() {
            0 => last.join("_"),
            count => last[..count].join("_"),
        }
    }

    /// Moments where the distance from centre to point along the axis is positive, or negative.
    pub fn strut(&self, positive: bool) -> Strut {
        let Strut { first, tail, second } = self.strut;
        if positive { self.strut } else { Strut { first: -first, tail: -tail, second } }
    }
}

/// The strut that ends at a point of a link.
pub fn detect(g: &mut Graph, tree: &Tree, link: usize, point: Triple) -> Option<Chain> {
    let slide = tree.links.get(link)?;
    let Motion::Prismatic(axis) = slide.motion else { return None };
    let cylinder_at = slide.parent?;
    let cylinder = &tree.links[cylinder_at];
    // Everything in the slide's axes, in which the line is a coordinate axis.
    let back = slide.rotation.transpose();
    let offset = g.rotate(back, slide.offset);
    let offset = on_line(&g.components(offset), axis)?;
    let reach = on_line(&point, axis)?;
    let own = cylinder.inertia.rotate(g, back);
    let (fixed, sliding) = (rod(&own, axis)?, rod(&slide.inertia, axis)?);
    let line = g.along(axis, Scalar::ONE);
    let line = g.rotate(slide.rotation, line);
    let mut links = centre(g, tree, cylinder_at, line)?;
    let top = &tree.links[*links.first()?];
    let (parent, centre) = (top.parent, g.components(top.offset));
    links.push(link);
    let alone = |(at, other): (usize, &Link)| links.contains(&at) || other.parent.is_none_or(|p| !links.contains(&p));
    let plain = |&at: &usize| tree.links[at].armature == Scalar::ZERO;
    if !tree.links.iter().enumerate().all(alone) || !links.iter().all(plain) {
        return None;
    }
    // The sliding rod's moments about the point.
    let [mass, first, second] = sliding;
    let shift = g.mul(mass, reach);
    let tail = g.sub(first, shift);
    let two = g.integer(2);
    let (once, twice) = (g.mul(shift, reach), g.product(&[two, first, reach]));
    let second = g.sum(&[fixed[2], second, -twice, once]);
    let strut = Strut { first: g.add(fixed[1], tail), tail, second };
    Some(Chain { parent, centre, links, slide: link, zero: g.add(offset, reach), strut, mass })
}

/// The links that turn the line about the centre, the first one first.
fn centre(g: &mut Graph, tree: &Tree, last: usize, line: Vector) -> Option<Vec<usize>> {
    let mut links = vec![last];
    let Motion::Revolute(axis) = tree.links[last].motion else {
        return matches!(tree.links[last].motion, Motion::Ball(_)).then_some(links);
    };
    let mut at = last;
    while tree.links[at].offset == Vector::ZERO
        && let Some(parent) = tree.links[at].parent
        && matches!(tree.links[parent].motion, Motion::Revolute(_))
        && tree.links[parent].inertia.is_zero()
    {
        links.insert(0, parent);
        at = parent;
    }
    // The last axis must turn the line, and the one before it the last axis.
    let own = g.vector(UNITS[axis]);
    let turned = g.cross(own, line) != Vector::ZERO;
    let [.., before, _] = links[..] else { return None };
    let Motion::Revolute(axis) = tree.links[before].motion else { return None };
    let first = g.vector(UNITS[axis]);
    let own = g.rotate(tree.links[last].rotation, own);
    (turned && g.cross(first, own) != Vector::ZERO).then_some(links)
}

/// The component along an axis of a vector that has no other.
fn on_line(v: &Triple, axis: usize) -> Option<Scalar> {
    (0..3).all(|k| k == axis || v[k] == Scalar::ZERO).then_some(v[axis])
}

/// Mass, first and second moment of a distribution along an axis.
fn rod(inertia: &Inertia, axis: usize) -> Option<[Scalar; 3]> {
    let first = on_line(&inertia.first, axis)?;
    let along = (0..6).all(|k| k == axis || inertia.second[k] == Scalar::ZERO);
    along.then_some([inertia.mass, first, inertia.second[axis]])
}
