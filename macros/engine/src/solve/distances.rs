//! Stage `solve`: distances that hold a body.
//!
//! In: cycles through the motions by which a body moves about, the same in all of them. Out: of each cycle the one distance that
//! is known between a point of the body and a point beside it, whatever the other joints of the cycle do, and which is all that the cycle
//! says: every pose with that distance closes it. So these are the legs that are known, for all parameters:
//!
//! - two balls, the ends of a rod;
//! - a ball, and two hinges whose axes meet at right angles, the second one at a right angle to the line to the ball, so that they turn
//!   that line wherever one likes;
//! - two hinges that are parallel, for bodies in a plane across them. Their distance is that in the plane.

use crate::dynamics::tree::Motion;
use crate::invariant::fault::OrFault;
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::chain::{Kind, Link, Side, unit};
use super::elements::{JointGroup, Seen, parallel};
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
    /// Whether it is one in the plane across two hinges, whatever their places along these.
    pub(super) is_flat: bool,
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
        let leg = Leg::new(g, &rest)?;
        // Squares of distances come halved.
        let two = g.integer(2);
        let mut square = g.mul(two, along);
        let mut is_flat = false;
        if let Leg::Hinges { height, axes: [near, far] } = leg {
            let across = |g: &mut Graph, v: Option<Vector>, normal: Vector| v.is_some_and(|v| parallel(g, v, normal));
            let (rotation, _, directions) = at_rest(g, &part);
            let turn = part.iter().filter_map(motion).zip(directions).find(|one| matches!(one.0, Motion::Revolute(_)));
            let normal = turn?.1;
            let own = g.rotate(rotation.transpose(), normal);
            if chain.len() != 3 || !across(g, near, own) || !across(g, far, normal) {
                return None;
            }
            let height = g.mul(height, height);
            square = g.sub(square, height);
            is_flat = true;
        }
        held.distances.push(Distance { base, body, square, is_flat });
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

/// What stands between a body and what is beside it.
enum Leg {
    /// One distance in space.
    Distance,
    /// Two parallel hinges: how far they are apart along their axes, and these as the body and the base see them.
    Hinges { height: Scalar, axes: [Option<Vector>; 2] },
}

impl Leg {
    /// From the body round to the base; nothing where it is of no kind that is known.
    fn new(g: &mut Graph, rest: &[Link]) -> Option<Leg> {
        let open: Vec<(usize, Motion)> =
            rest.iter().enumerate().filter_map(|(at, link)| Some((at, motion(link)?))).collect();
        match open[..] {
            [(_, Motion::Ball(_)), (_, Motion::Ball(_))] => Some(Leg::Distance),
            [(first, Motion::Revolute(a)), (second, Motion::Revolute(b)), (ball, Motion::Ball(_))] => {
                let group = grown(g, &rest[first..=second])?;
                let centre = carry(g, &rest[second + 1..ball], Side::Left, Kind::Point, Vector::ZERO)?;
                let before = unit(g, a);
                let before = carry(g, &rest[first + 1..second], Side::Right, Kind::Direction, before)?;
                turns_anywhere(g, before, b, (centre, group.right))
            }
            [(ball, Motion::Ball(_)), (second, Motion::Revolute(b)), (first, Motion::Revolute(a))] => {
                let group = grown(g, &rest[second..=first])?;
                let centre = carry(g, &rest[ball + 1..second], Side::Right, Kind::Point, Vector::ZERO)?;
                let behind = unit(g, a);
                let behind = carry(g, &rest[second + 1..first], Side::Left, Kind::Direction, behind)?;
                turns_anywhere(g, behind, b, (centre, group.left))
            }
            [(first, Motion::Revolute(a)), (second, Motion::Revolute(b))] => {
                let (between, axis) = (&rest[first + 1..second], unit(g, a));
                let other = unit(g, b);
                let seen = carry(g, between, Side::Left, Kind::Direction, other)?;
                let way = carry(g, between, Side::Left, Kind::Point, Vector::ZERO)?;
                let near = carry(g, &rest[..first], Side::Left, Kind::Direction, axis);
                let far = carry(g, &rest[second + 1..], Side::Right, Kind::Direction, other);
                parallel(g, seen, axis).then(|| Leg::Hinges { height: g.dot(way, axis), axes: [near, far] })
            }
            _ => None,
        }
    }
}

fn motion(link: &Link) -> Option<Motion> {
    match link {
        Link::Free { motion, .. } => Some(*motion),
        Link::Known { .. } => None,
    }
}

/// The point about which hinges turn.
fn grown(g: &mut Graph, links: &[Link]) -> Option<Seen> {
    let mut group = JointGroup::new();
    links.iter().for_each(|&link| group.append(g, link));
    group.centre()
}

fn carry(g: &mut Graph, links: &[Link], way: Side, kind: Kind, v: Vector) -> Option<Vector> {
    match way {
        Side::Left => links.iter().rev().try_fold(v, |v, link| link.carry(g, way, kind, v)),
        Side::Right => links.iter().try_fold(v, |v, link| link.carry(g, way, kind, v)),
    }
}

/// Of two hinges through one point, the second about a coordinate axis, and a ball: whether they take it everywhere around the point.
fn turns_anywhere(g: &mut Graph, first: Vector, axis: usize, (ball, centre): (Vector, Vector)) -> Option<Leg> {
    let second = unit(g, axis);
    let arm = g.sub_vectors(ball, centre);
    let square = [g.dot(first, second), g.dot(arm, second)] == [Scalar::ZERO; 2];
    square.then_some(Leg::Distance)
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
