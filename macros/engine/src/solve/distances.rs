//! Stage `solve`: distances that hold a body.
//!
//! In: cycles through the motions by which a body moves about, the same in all of them. Out: of each cycle the one distance that
//! is known between a point of the body and a point beside it, whatever the other joints of the cycle do: that of the centres of a
//! universal joint and a ball joint at the ends of a strut, of the hinges at the ends of a planar link.

use crate::invariant::fault::OrFault;
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::chain::{Link, unit};
use super::measures::Measure;
use super::pairs::{Opened, pairs};
use super::system::{Part, System};
use super::{KinematicLoop, Segment};

/// The distance of two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Distance {
    /// In the frame in front of the motions.
    pub(super) base: Vector,
    /// In the frame behind them.
    pub(super) body: Vector,
    pub(super) square: Scalar,
}

/// A chain of motions with the distances that are measured across it.
pub(super) struct Held {
    pub(super) links: Vec<Link>,
    pub(super) distances: Vec<Distance>,
}

/// Distances across the motions with these coordinates, in their order; nothing where a cycle gives none, or has other
/// unknowns between them.
pub(super) fn distances(g: &mut Graph, cycles: &[KinematicLoop], chain: &[Scalar]) -> Option<Held> {
    let mut held = Held { links: Vec::new(), distances: Vec::new() };
    for cycle in cycles {
        let (part, rest) = forward(g, cycle, chain)?;
        let opened = Opened::around(&rest);
        let groups = opened.groups(g);
        let measured = pairs(&groups).filter(|pair| pair.2 == Measure::Points).find_map(|(first, second, measure)| {
            let ends = (second.far.point()?, first.near.point()?);
            Some((ends, opened.along_rest(g, first, second, measure)?))
        });
        let ((base, body), along) = measured?;
        // Squares of distances come halved.
        let two = g.integer(2);
        held.distances.push(Distance { base, body, square: g.mul(two, along) });
        held.links = part;
    }
    Some(held)
}

/// The motions, walked from the base to the body, and the rest of the cycle.
fn forward(g: &mut Graph, cycle: &KinematicLoop, chain: &[Scalar]) -> Option<(Vec<Link>, Vec<Link>)> {
    let walk = |cycle: &KinematicLoop| {
        let system = System::new(std::slice::from_ref(cycle));
        let numbers: Option<Vec<usize>> = chain
            .iter()
            .map(|&symbol| system.unknowns.iter().position(|other| other.wanted && other.symbol == symbol))
            .collect();
        let numbers = numbers?;
        let parts: Vec<Part> = system.cycles.first()?.parts(&numbers).collect();
        parts.into_iter().find(|part| part.unknowns == numbers).map(|part| (part.links, part.rest))
    };
    walk(cycle).or_else(|| {
        let back = reversed(g, cycle);
        walk(&back)
    })
}

/// The same cycle, walked the other way.
fn reversed(g: &mut Graph, cycle: &KinematicLoop) -> KinematicLoop {
    let pi = g.pi();
    let mut segments = Vec::with_capacity(3 * cycle.segments.len());
    for &segment in cycle.segments.iter().rev() {
        match segment {
            Segment::Fixed { rotation, offset } => {
                let back = g.rotate(rotation.transpose(), offset);
                segments.push(Segment::Fixed { rotation: rotation.transpose(), offset: -back });
            }
            Segment::Unknown { motion, .. } => {
                // The same motion about the opposite axis; a ball is its own inverse, since nobody asks for its coordinates.
                let half = motion.axis().map(|axis| g.axis_rotation((axis + 1) % 3, pi));
                let turn = half.map(|rotation| Segment::Fixed { rotation, offset: Vector::ZERO });
                segments.extend(turn);
                segments.push(segment);
                segments.extend(turn);
            }
        }
    }
    KinematicLoop { segments, winding: None }
}

/// Where a chain of links leads with its coordinates all zero, and the directions of its motions seen from its left side then.
pub(super) fn at_rest(g: &mut Graph, links: &[Link]) -> (Rotation, Vector, Vec<Vector>) {
    let (mut rotation, mut offset, mut axes) = (Rotation::IDENTITY, Vector::ZERO, Vec::new());
    for &link in links {
        match link {
            Link::Known { rotation: turn, offset: way } => {
                let way = g.rotate(rotation, way);
                offset = g.add_vectors(offset, way);
                rotation = g.compose(rotation, turn);
            }
            Link::Free { motion, .. } => {
                let axis = motion.axis().map_or(Vector::ZERO, |axis| unit(g, axis));
                axes.push(g.rotate(rotation, axis));
            }
        }
    }
    (rotation, offset, axes)
}

/// Where it leads with these coordinates, in their order.
pub(super) fn moved(g: &mut Graph, links: &[Link], coordinates: &[Scalar]) -> (Rotation, Vector) {
    let mut coordinates = coordinates.iter();
    let links: Vec<Link> = links
        .iter()
        .map(|&link| match link {
            Link::Free { motion, .. } => {
                let coordinate = coordinates.next().or_fault("each motion of the chain has its coordinate");
                Link::moved(g, motion, *coordinate)
            }
            known => known,
        })
        .collect();
    let (rotation, offset, _) = at_rest(g, &links);
    (rotation, offset)
}
