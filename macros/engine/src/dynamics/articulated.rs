//! Stage `dynamics`: articulated bodies (Featherstone 1983; 2008, chapter 7).
//!
//! In: a tree, velocities, minus gravity, wrenches that act on the links, efforts. Out: the accelerations.
//!
//! All accelerations are counted from those that the links have while no coordinate accelerates: the wrenches that these
//! need come from the Newton-Euler recursion, and no velocity term is left in the articulated equation f = A a + p. From
//! the leaves inwards each freedom s is eliminated: with U = A s and d = s . U + armature the outer bodies are felt as
//! A - U U^T / d and p + U (tau - s . p) / d; outwards again, q'' = (tau - s . p - U . a) / d. The pivots d are those of
//! the positive definite mass matrix.
//!
//! Translations of what floats ([`super::floating_bases`]) are eliminated where it sits, in its own axes, and turned back at the
//! end. If they start from the ground they fall freely while no coordinate accelerates: then gravity goes no further.

use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::articulated_inertia::ArticulatedInertia;
use super::floating_bases::FloatingBase;
use super::kinematics::motions;
use super::newton_euler::{Wrench, inertial_wrench, to_parent};
use super::tree::{Link, Motion, Tree};

/// What is eliminated.
#[derive(Clone, Copy)]
enum Freedom {
    /// A coordinate.
    Of(usize),
    /// A translation along an axis of a floating base.
    Along(usize),
}

impl Freedom {
    /// For names of values.
    fn name(self, link: &Link) -> String {
        match self {
            Freedom::Of(freedom) => (freedom + 1).to_string(),
            Freedom::Along(axis) => format!("{}_{}", link.name, ["x", "y", "z"][axis]),
        }
    }
}

/// One eliminated freedom.
struct Pivot {
    link: usize,
    freedom: Freedom,
    twist: [Scalar; 6],
    /// U / d
    gain: [Scalar; 6],
    /// (tau - s . p) / d
    drive: Scalar,
}

/// Accelerations in the order of the coordinates. `base` is minus gravity, `efforts` are those of all coordinates; `floating_bases`
/// may be empty, then every freedom is eliminated where it was declared.
pub fn forward_dynamics(
    g: &mut Graph,
    tree: &Tree,
    floating_bases: &[FloatingBase],
    velocity: &[Scalar],
    base: Vector,
    applied: &[Wrench],
    efforts: &[Scalar],
) -> Vec<Scalar> {
    // What acts on a carrier would be felt by some of the translations only.
    let floating_bases: Vec<&FloatingBase> = floating_bases
        .iter()
        .filter(|floating_base| floating_base.carriers().all(|k| is_zero(g, &applied[k])))
        .collect();
    let still = falling(g, tree, &floating_bases, base, &vec![Scalar::ZERO; tree.freedoms()]);
    let motions = motions(g, tree, velocity, &still, base);
    let mut wrenches = Vec::with_capacity(tree.links.len());
    for ((link, motion), outside) in tree.links.iter().zip(&motions).zip(applied) {
        let needed = inertial_wrench(g, link, motion);
        let outside = Wrench { moment: -outside.moment, force: -outside.force };
        wrenches.push(needed.add(g, &outside));
    }
    let pivots = eliminate(g, tree, &floating_bases, wrenches, efforts);
    let beside = accelerate(g, tree, &floating_bases, &pivots);
    still.iter().zip(beside).map(|(&still, beside)| g.add(still, beside)).collect()
}

/// Accelerations of what falls freely from the ground; elsewhere as given.
pub(super) fn falling(
    g: &mut Graph,
    tree: &Tree,
    floating_bases: &[&FloatingBase],
    base: Vector,
    still: &[Scalar],
) -> Vec<Scalar> {
    let mut still = still.to_vec();
    for floating_base in floating_bases {
        let first = &tree.links[floating_base.slides[0]];
        if first.parent.is_none() {
            let pull = g.rotate(first.rotation.transpose(), base);
            for (freedom, axis) in slides(tree, floating_base) {
                still[freedom] = -g.component(pull, axis);
            }
        }
    }
    still
}

/// Coordinates and axes of a floating base's translations.
pub(super) fn slides<'t>(tree: &'t Tree, floating_base: &'t FloatingBase) -> impl Iterator<Item = (usize, usize)> + 't {
    floating_base.slides.iter().filter_map(|&index| match tree.links[index].motion {
        Motion::Prismatic(axis) => Some((tree.links[index].freedom, axis)),
        _ => None,
    })
}

/// Unit translations along the axes of a floating base, with their efforts.
pub(super) fn translations(
    g: &mut Graph,
    tree: &Tree,
    floating_base: &FloatingBase,
    efforts: &[Scalar],
) -> Vec<(usize, [Scalar; 6], Scalar)> {
    let mut along = [Scalar::ZERO; 3];
    for (freedom, axis) in slides(tree, floating_base) {
        along[axis] = efforts[freedom];
    }
    let mut along = g.vector(along);
    for &index in floating_base.turners.iter().chain([&floating_base.link]) {
        along = tree.to_link(g, &tree.links[index], along);
    }
    let along = g.components(along);
    // Where two translations float, they lie in the plane in which the floating base turns.
    let normal = match tree.links[floating_base.link].motion {
        Motion::Revolute(axis) if floating_base.slides.len() == 2 => Some(axis),
        _ => None,
    };
    let axes = (0..3).filter(|&axis| Some(axis) != normal);
    let unit = |axis: usize| std::array::from_fn(|k| if k == axis + 3 { Scalar::ONE } else { Scalar::ZERO });
    axes.map(|axis| (axis, unit(axis), along[axis])).collect()
}

/// From the leaves inwards.
fn eliminate(
    g: &mut Graph,
    tree: &Tree,
    floating_bases: &[&FloatingBase],
    mut wrenches: Vec<Wrench>,
    efforts: &[Scalar],
) -> Vec<Pivot> {
    let mut inertias: Vec<ArticulatedInertia> =
        tree.links.iter().map(|link| ArticulatedInertia::rigid(g, &link.inertia)).collect();
    let mut pivots = Vec::with_capacity(tree.freedoms());
    for (index, link) in tree.links.iter().enumerate().rev() {
        let mut inertia = inertias[index];
        let mut wrench = components(g, &wrenches[index]);
        let mut freedoms = Vec::new();
        if let Some(floating_base) = floating_bases.iter().find(|floating_base| floating_base.link == index) {
            let translations = translations(g, tree, floating_base, efforts);
            freedoms
                .extend(translations.into_iter().map(|(axis, twist, effort)| (Freedom::Along(axis), twist, effort)));
        }
        if !floating_bases.iter().any(|floating_base| floating_base.slides.contains(&index)) {
            freedoms.extend(tree.twists(link).into_iter().map(|(k, twist)| (Freedom::Of(k), twist, efforts[k])));
        }
        for (freedom, twist, effort) in freedoms {
            let column = inertia.apply(g, &twist);
            let along = dot(g, &twist, &column);
            let pivot = match freedom {
                Freedom::Of(_) => g.add(along, link.armature),
                Freedom::Along(_) => along,
            };
            let before = g.begin(Some(format!("Articulated inertia of {}.", link.name).into()));
            let inverse = g.reciprocal(pivot);
            let pushed = dot(g, &twist, &wrench);
            let rest = g.sub(effort, pushed);
            let drive = g.mul(rest, inverse);
            let gain = column.map(|u| g.mul(u, inverse));
            g.name(pivot, || format!("pivot_{}", freedom.name(link)));
            g.name(inverse, || format!("inverse_{}", freedom.name(link)));
            let name = freedom.name(link);
            g.label(rest, || format!("rest_{name}"));
            g.label(drive, || format!("drive_{name}"));
            for (k, motion) in ["wx", "wy", "wz", "x", "y", "z"].iter().enumerate() {
                g.label(column[k], || format!("column_{name}_{motion}"));
                g.label(gain[k], || format!("gain_{name}_{motion}"));
            }
            g.begin(before);
            inertia = inertia.less(g, &column, &gain);
            wrench = std::array::from_fn(|k| {
                let handed = g.mul(gain[k], rest);
                let handed = if broken(Break::HandedSign) { -handed } else { handed };
                g.add(wrench[k], handed)
            });
            pivots.push(Pivot { link: index, freedom, twist, gain, drive });
        }
        let Some(parent) = link.parent else { continue };
        let wrench = Wrench {
            moment: g.vector([wrench[0], wrench[1], wrench[2]]),
            force: g.vector([wrench[3], wrench[4], wrench[5]]),
        };
        let carried = to_parent(g, tree, index, &wrench);
        wrenches[parent] = wrenches[parent].add(g, &carried);
        let carried = inertia_to_parent(g, tree, link, &inertia);
        inertias[parent] = inertias[parent].add(g, &carried);
    }
    pivots
}

/// An articulated inertia about a link's origin as its parent sees it.
pub(super) fn inertia_to_parent(
    g: &mut Graph,
    tree: &Tree,
    link: &Link,
    inertia: &ArticulatedInertia,
) -> ArticulatedInertia {
    let turned = match link.motion {
        Motion::Revolute(axis) | Motion::Screw(axis, _) => {
            let (sin, cos) = (g.sin(link.q), g.cos(link.q));
            inertia.turn(g, axis, cos, sin)
        }
        Motion::Prismatic(_) => *inertia,
        Motion::Ball(orientation) => {
            let r = orientation.rotation(g);
            inertia.rotate(g, r)
        }
    };
    let placed = turned.rotate(g, link.rotation);
    let origin = tree.origin(g, link);
    let origin = g.components(origin);
    placed.shift(g, origin)
}

/// From the ground outwards.
fn accelerate(g: &mut Graph, tree: &Tree, floating_bases: &[&FloatingBase], pivots: &[Pivot]) -> Vec<Scalar> {
    let mut result = vec![Scalar::ZERO; tree.freedoms()];
    let mut pivots = pivots.iter().rev().peekable();
    let mut motions: Vec<(Vector, Vector)> = Vec::with_capacity(tree.links.len());
    for (index, link) in tree.links.iter().enumerate() {
        let mut motion = [Scalar::ZERO; 6];
        let mut travel = [Scalar::ZERO; 3];
        if let Some(parent) = link.parent {
            let (angular, linear) = motions[parent];
            let origin = tree.origin(g, link);
            let lever = g.cross(angular, origin);
            let linear = g.add_vectors(linear, lever);
            let angular = tree.to_link(g, link, angular);
            let linear = tree.to_link(g, link, linear);
            let (angular, linear) = (g.components(angular), g.components(linear));
            motion[..3].copy_from_slice(&angular);
            motion[3..].copy_from_slice(&linear);
        }
        // The freedom that was eliminated first depends on those after it.
        while let Some(pivot) = pivots.next_if(|p| p.link == index) {
            let felt = dot(g, &pivot.gain, &motion);
            let acceleration = g.sub(pivot.drive, felt);
            let heading = format!("Acceleration of {}.", link.name);
            g.under(&heading, |g| g.name(acceleration, || format!("acceleration_{}", pivot.freedom.name(link))));
            motion = std::array::from_fn(|k| {
                let part = g.mul(pivot.twist[k], acceleration);
                g.add(motion[k], part)
            });
            match pivot.freedom {
                Freedom::Of(freedom) => result[freedom] = acceleration,
                Freedom::Along(axis) => travel[axis] = acceleration,
            }
        }
        if let Some(floating_base) = floating_bases.iter().find(|floating_base| floating_base.link == index) {
            let mut travel = g.vector(travel);
            for &index in floating_base.turners.iter().chain([&floating_base.link]).rev() {
                travel = tree.to_parent(g, &tree.links[index], travel);
            }
            for (freedom, axis) in slides(tree, floating_base) {
                result[freedom] = g.component(travel, axis);
            }
        }
        let [a, b, c, x, y, z] = motion;
        motions.push((g.vector([a, b, c]), g.vector([x, y, z])));
    }
    result
}

pub(super) fn is_zero(g: &mut Graph, wrench: &Wrench) -> bool {
    components(g, wrench).iter().all(|&component| component == Scalar::ZERO)
}

pub(super) fn components(g: &mut Graph, wrench: &Wrench) -> [Scalar; 6] {
    let (m, f) = (g.components(wrench.moment), g.components(wrench.force));
    [m[0], m[1], m[2], f[0], f[1], f[2]]
}

pub(super) fn dot(g: &mut Graph, a: &[Scalar; 6], b: &[Scalar; 6]) -> Scalar {
    let terms: [Scalar; 6] = std::array::from_fn(|k| g.mul(a[k], b[k]));
    g.sum(&terms)
}
