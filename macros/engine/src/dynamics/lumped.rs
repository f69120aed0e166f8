//! Stage `dynamics`: recursive Newton-Euler over groups of links that turn together.
//!
//! In: a tree, its motion, forces that act on its links. Out: the efforts alone; wrenches of single links are not made.
//! Three things are done once that the plain recursion of [`super::newton_euler`] does link by link:
//! - links that slide on each other turn as one: their moments are added up about the first one's origin, and what they
//!   move against it (p'' + 2 w x p') acts on the sums;
//! - a link on a hinge about whose axis it is symmetric looks the same from the axes in which the hinge stands: its
//!   wrench is written there, and never turned;
//! - forces that are given in world axes on a link with several hinges through one point go to the point's carrier as
//!   they are, and only their moment descends from hinge to hinge.

use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::inertia::Inertia;
use super::kinematics::{Field, LinkMotion, motions};
use super::newton_euler::{Wrench, spin_moment, to_parent};
use super::tree::{Motion, Tree};

/// A link against the first of its group, in the group's axes.
#[derive(Clone, Copy)]
struct Member {
    first: usize,
    /// Position, velocity, acceleration of its origin.
    way: [Vector; 3],
}

/// What a list of members amounts to.
struct Sums {
    inertia: Inertia,
    /// Sum of m (p'' + 2 w x p').
    force: Vector,
    /// Sum of (h + m p) x (p'' + 2 w x p').
    moment: Vector,
}

/// Whether there is anything to gather.
pub fn differs(tree: &Tree) -> bool {
    tree.links.iter().any(|link| match link.motion {
        Motion::Prismatic(_) => link.parent.is_some() && link.rotation == Rotation::IDENTITY,
        Motion::Revolute(axis) => !link.inertia.is_zero() && link.inertia.is_symmetric(axis),
        _ => false,
    })
}

/// Efforts in the order of the coordinates; armature included. `world` are further forces, in world axes.
pub fn efforts(
    g: &mut Graph,
    tree: &Tree,
    acceleration: &[Scalar],
    base: Vector,
    applied: &[Wrench],
    world: &[(usize, Wrench)],
) -> Vec<Scalar> {
    let motions = motions(g, tree, &tree.velocity, acceleration, base);
    let members = members(g, tree, acceleration);
    let mut efforts = vec![Scalar::ZERO; tree.freedoms()];
    // What passes through links from outside and from what they carry, without their own inertia.
    let mut wrenches: Vec<Wrench> =
        applied.iter().map(|outside| Wrench { moment: -outside.moment, force: -outside.force }).collect();
    for (link, wrench) in world {
        descend(g, tree, *link, wrench, &mut wrenches, &mut efforts);
    }
    for index in (0..tree.links.len()).rev() {
        let link = &tree.links[index];
        let group: Vec<usize> = (0..members.len()).filter(|&k| beyond(tree, &members, k, index)).collect();
        let sums = sums(g, tree, &members, &group, &motions);
        let motion = &motions[members[index].first];
        let needed = needed(g, &sums, motion, &link.name);
        if members[index].first != index {
            // Its effort; the first of the group passes on what all need.
            let force = group.iter().fold(needed.force, |sum, &k| g.add_vectors(sum, wrenches[k].force));
            add_efforts(g, tree, index, &Wrench { moment: Vector::ZERO, force }, &mut efforts);
            continue;
        }
        let mut outer = Wrench::ZERO;
        for &k in &group {
            let Wrench { moment, force } = wrenches[k];
            let lever = g.cross(members[k].way[0], force);
            let moment = g.add_vectors(moment, lever);
            outer = outer.add(g, &Wrench { moment, force });
        }
        let unturned = match link.motion {
            Motion::Revolute(axis) if group.len() == 1 && link.inertia.is_symmetric(axis) => {
                let motion = before_turning(g, tree, index, acceleration, &motions, base);
                Some(self::needed(g, &sums, &motion, &format!("{}_unturned", link.name)))
            }
            _ => None,
        };
        let (turned, still) = match unturned {
            Some(still) => (outer, still),
            None => (outer.add(g, &needed), Wrench::ZERO),
        };
        // The component along the hinge is the same before and behind it.
        let whole = turned.add(g, &still);
        add_efforts(g, tree, index, &whole, &mut efforts);
        if let Some(parent) = link.parent {
            let mut carried = to_parent(g, tree, index, &turned);
            if unturned.is_some() {
                let force = g.rotate(link.rotation, still.force);
                let moment = g.rotate(link.rotation, still.moment);
                let lever = g.cross(link.offset, force);
                let moment = g.add_vectors(moment, lever);
                carried = carried.add(g, &Wrench { moment, force });
            }
            wrenches[parent] = wrenches[parent].add(g, &carried);
        }
    }
    for link in tree.links.iter().filter(|link| link.motion.freedoms() == 1) {
        let rotor = g.mul(link.armature, acceleration[link.freedom]);
        efforts[link.freedom] = g.add(efforts[link.freedom], rotor);
    }
    efforts
}

/// Which links turn together.
fn members(g: &mut Graph, tree: &Tree, acceleration: &[Scalar]) -> Vec<Member> {
    let mut members: Vec<Member> = Vec::with_capacity(tree.links.len());
    for (index, link) in tree.links.iter().enumerate() {
        let carrier = link.parent.map(|parent| members[parent]);
        let member = match (link.motion, carrier) {
            (Motion::Prismatic(axis), Some(carrier)) if link.rotation == Rotation::IDENTITY => {
                let origin = tree.origin(g, link);
                let steps =
                    [origin, g.along(axis, tree.velocity[link.freedom]), g.along(axis, acceleration[link.freedom])];
                Member { first: carrier.first, way: [0, 1, 2].map(|k| g.add_vectors(carrier.way[k], steps[k])) }
            }
            _ => Member { first: index, way: [Vector::ZERO; 3] },
        };
        members.push(member);
    }
    members
}

/// Whether a link is another or slides on it, by way of its group.
fn beyond(tree: &Tree, members: &[Member], link: usize, from: usize) -> bool {
    let group = members[from].first;
    let mut own = tree.support(Some(link)).take_while(|&index| index >= from && members[index].first == group);
    own.any(|index| index == from)
}

/// Moments about the origin of the group's first link, and what its members' own ways add.
fn sums(g: &mut Graph, tree: &Tree, members: &[Member], group: &[usize], motions: &[LinkMotion]) -> Sums {
    let mut sums = Sums { inertia: Inertia::ZERO, force: Vector::ZERO, moment: Vector::ZERO };
    for &k in group {
        let (inertia, member) = (&tree.links[k].inertia, &members[k]);
        if inertia.is_zero() {
            continue;
        }
        let way = g.components(member.way[0]);
        let seen = inertia.shift(g, way);
        sums.inertia = sums.inertia.add(g, &seen);
        let turn = g.cross(motions[member.first].angular, member.way[1]);
        let own = g.sum_vectors(&[member.way[2], turn, turn]);
        let force = g.scale(inertia.mass, own);
        sums.force = g.add_vectors(sums.force, force);
        let first = g.vector(seen.first);
        let moment = g.cross(first, own);
        sums.moment = g.add_vectors(sums.moment, moment);
    }
    sums
}

/// The wrench that it takes to move a group so.
fn needed(g: &mut Graph, sums: &Sums, motion: &LinkMotion, name: &str) -> Wrench {
    if sums.inertia.is_zero() {
        return Wrench::ZERO;
    }
    let field = Field::new(g, motion, name);
    let turning = field.apply(g, sums.inertia.first);
    let pushed = g.scale(sums.inertia.mass, motion.linear_rate);
    let first = g.vector(sums.inertia.first);
    let lever = g.cross(first, motion.linear_rate);
    let spin = spin_moment(g, &field, &sums.inertia.second);
    Wrench { moment: g.sum_vectors(&[lever, spin, sums.moment]), force: g.sum_vectors(&[pushed, turning, sums.force]) }
}

/// Motion of a link on a hinge, in the axes in which the hinge stands.
fn before_turning(
    g: &mut Graph,
    tree: &Tree,
    index: usize,
    acceleration: &[Scalar],
    motions: &[LinkMotion],
    base: Vector,
) -> LinkMotion {
    let link = &tree.links[index];
    let parent = link.parent.map_or(LinkMotion { linear_rate: base, ..LinkMotion::REST }, |parent| motions[parent]);
    let above = link.parent.map_or("ground", |parent| &tree.links[parent].name);
    let field = Field::new(g, &parent, above);
    let r = g.components(link.offset);
    let carried = field.apply(g, r);
    let linear = g.add_vectors(parent.linear_rate, carried);
    let back = link.rotation.transpose();
    let [linear_rate, w, dw] = [linear, parent.angular, parent.angular_rate].map(|v| g.rotate(back, v));
    let (turn, _) = tree.joint_motion(g, link, &tree.velocity);
    let (faster, _) = tree.joint_motion(g, link, acceleration);
    let gyro = g.cross(w, turn);
    LinkMotion {
        angular: g.add_vectors(w, turn),
        angular_rate: g.sum_vectors(&[dw, gyro, faster]),
        linear_rate,
        kept: None,
    }
}

/// Adds what a wrench at a link takes.
fn add_efforts(g: &mut Graph, tree: &Tree, index: usize, wrench: &Wrench, efforts: &mut [Scalar]) {
    for (freedom, effort) in tree.project(g, &tree.links[index], wrench.moment, wrench.force) {
        efforts[freedom] = g.add(efforts[freedom], effort);
    }
}

/// Takes a force in world axes off the efforts of the hinges that meet in the link's origin, and off what passes through
/// the link that carries them.
fn descend(g: &mut Graph, tree: &Tree, link: usize, wrench: &Wrench, wrenches: &mut [Wrench], efforts: &mut [Scalar]) {
    let turns = |index: usize| matches!(tree.links[index].motion, Motion::Revolute(_) | Motion::Ball(_));
    let mut hinges = Vec::new();
    let mut at = Some(link);
    while let Some(index) = at.filter(|&index| turns(index)) {
        hinges.push(index);
        at = tree.links[index].parent;
        if tree.links[index].offset != Vector::ZERO {
            break;
        }
    }
    let [mut moment, mut force] = [wrench.moment, wrench.force];
    for index in tree.path(None, at) {
        [moment, force] = [moment, force].map(|v| tree.to_link(g, &tree.links[index], v));
    }
    if let Some(carrier) = at {
        let offset = hinges.last().map_or(Vector::ZERO, |&hinge| tree.links[hinge].offset);
        let lever = g.cross(offset, force);
        let whole = g.add_vectors(moment, lever);
        wrenches[carrier] = wrenches[carrier].add(g, &Wrench { moment: -whole, force: -force });
    }
    for &hinge in hinges.iter().rev() {
        moment = tree.to_link(g, &tree.links[hinge], moment);
        add_efforts(g, tree, hinge, &Wrench { moment: -moment, force: Vector::ZERO }, efforts);
    }
}
