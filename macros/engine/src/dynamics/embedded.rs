//! Stage `dynamics`: articulated bodies ([`super::articulated`]) with coordinates embedded in them that follow from those of the state (Jain 2012;
//! Chignoli, Adrian, Kim and Wensing 2023).
//!
//! In: a tree, what moves it, how coordinates of the tree follow from those of the state. Out: the accelerations.
//!
//! Where loops are closed, coordinates of the tree accelerate by q'' = G u' beside what they do while u' is zero: several joints move with one
//! coordinate u of the state, and it can't be eliminated before all of them are met. Until then it is open: f = A a + U u' + p with a column for each,
//! and equations U^T a + D u' = r of their own. A joint that moves by s G adds G_j A s to U_j, G_j s . U_k + G_k s . U_j + G_j G_k s . A s to D_jk and
//! G_j (tau - s . p) to r_j; branches are added where they meet. When the last joint of a coordinate is in, its column and row go from all that is left,
//! as a freedom of an articulated body does. So a loop costs what is between its joints alone, and the rest of the tree stays linear.
//!
//! Translations of what floats are eliminated where it sits if nothing follows them.

use std::collections::BTreeMap;

use crate::invariant::fault::OrFault;
use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::articulated::{components, dot, falling, inertia_to_parent, is_zero, slides, translations};
use super::articulated_inertia::ArticulatedInertia;
use super::floating_bases::FloatingBase;
use super::kinematics::motions;
use super::newton_euler::{Wrench, inertial_wrench, to_parent};
use super::tree::Tree;

/// How coordinates of a tree accelerate with those of the state.
pub struct Embedding {
    /// Accelerations while none of the state's coordinates accelerates.
    pub still: Vec<Scalar>,
    /// By coordinate of the tree: coordinates of the state that it moves with, and slopes. One of the state moves with itself.
    pub slopes: Vec<Vec<(usize, Scalar)>>,
}

impl Embedding {
    /// All coordinates are of the state.
    pub fn open(freedoms: usize) -> Embedding {
        Embedding {
            still: vec![Scalar::ZERO; freedoms],
            slopes: (0..freedoms).map(|k| vec![(k, Scalar::ONE)]).collect(),
        }
    }

    /// How many coordinates of the tree move with each.
    fn counts(&self) -> Vec<usize> {
        let mut counts = vec![0; self.slopes.len()];
        self.slopes.iter().flatten().for_each(|one| counts[one.0] += 1);
        counts
    }

    /// Whether a coordinate that others follow is eliminated before the ground.
    pub fn is_local(&self, tree: &Tree) -> bool {
        let counts = self.counts();
        let link_of = |freedom: usize| {
            tree.links.iter().position(|link| (link.freedom..link.freedom + link.motion.freedoms()).contains(&freedom))
        };
        (0..counts.len()).filter(|&k| counts[k] > 1).any(|k| {
            let movers = (0..counts.len()).filter(|&d| self.slopes[d].iter().any(|one| one.0 == k));
            let mut links = movers.map(link_of);
            let first = links.next().flatten();
            links.fold(first, |a, b| tree.common(a, b)).is_some()
        })
    }
}

/// What moves the links of a tree.
pub struct Causes<'a> {
    pub velocity: &'a [Scalar],
    /// Minus gravity.
    pub base: Vector,
    /// Wrenches on the links.
    pub applied: &'a [Wrench],
    /// Of all coordinates.
    pub efforts: &'a [Scalar],
}

/// A unit motion of a link.
struct Freedom {
    /// Nothing: a translation of a floating base.
    coordinate: Option<usize>,
    twist: [Scalar; 6],
    armature: Scalar,
    /// Less what the armature takes.
    effort: Scalar,
    /// As in [`Embedding::slopes`]; translations of floating bases have numbers of their own, behind those of coordinates.
    slopes: Vec<(usize, Scalar)>,
}

/// A motion that is not eliminated.
#[derive(Clone, Copy)]
struct Open {
    /// The wrench that it takes.
    column: [Scalar; 6],
    /// What is left of its effort.
    rest: Scalar,
    /// Freedoms that move with it, so far.
    met: usize,
}

/// What a link with all beyond it feels like.
struct Felt {
    inertia: ArticulatedInertia,
    wrench: Wrench,
    open: BTreeMap<usize, Open>,
    /// Entries of the mass matrix between open motions, the lower number first.
    masses: BTreeMap<(usize, usize), Scalar>,
}

/// One eliminated motion.
struct Pivot {
    /// Nothing: the ground.
    link: Option<usize>,
    /// How many of the link's freedoms are in: what it felt like moves without these.
    within: usize,
    motion: usize,
    /// U / d
    gain: [Scalar; 6],
    /// (tau - s . p) / d
    drive: Scalar,
    /// Motions that were open then, with D / d.
    beside: Vec<(usize, Scalar)>,
}

/// Accelerations in the order of the coordinates. `floating_bases` may be empty, then every freedom is eliminated where it was declared.
pub fn forward_dynamics(
    g: &mut Graph,
    tree: &Tree,
    floating_bases: &[FloatingBase],
    causes: &Causes<'_>,
    embedding: &Embedding,
) -> Vec<Scalar> {
    let counts = embedding.counts();
    let is_alone = |&k: &usize| {
        let freedom = tree.links[k].freedom;
        counts[freedom] == 1 && embedding.slopes[freedom] == [(freedom, Scalar::ONE)]
    };
    // What acts on a carrier would be felt by some of the translations only.
    let floating_bases: Vec<&FloatingBase> = floating_bases
        .iter()
        .filter(|floating_base| floating_base.carriers().all(|k| is_zero(g, &causes.applied[k])))
        .filter(|floating_base| floating_base.slides.iter().all(is_alone))
        .collect();
    let still = falling(g, tree, &floating_bases, causes.base, &embedding.still);
    let motions = motions(g, tree, causes.velocity, &still, causes.base);
    let mut wrenches = Vec::with_capacity(tree.links.len());
    for ((link, motion), outside) in tree.links.iter().zip(&motions).zip(causes.applied) {
        let needed = inertial_wrench(g, link, motion);
        let outside = Wrench { moment: -outside.moment, force: -outside.force };
        wrenches.push(needed.add(g, &outside));
    }
    let freedoms = freedoms(g, tree, &floating_bases, causes.efforts, &still, embedding);
    let pivots = eliminate(g, tree, &floating_bases, wrenches, &freedoms);
    let moved = accelerate(g, tree, &floating_bases, &freedoms, &pivots);
    still.iter().zip(moved).map(|(&still, moved)| g.add(still, moved)).collect()
}

/// Numbers of a floating base's translations along its own axes.
fn along(tree: &Tree, base: usize, axis: usize) -> usize {
    tree.freedoms() + 3 * base + axis
}

/// The unit motions of each link, in the order in which they are eliminated where they can be.
fn freedoms(
    g: &mut Graph,
    tree: &Tree,
    floating_bases: &[&FloatingBase],
    efforts: &[Scalar],
    still: &[Scalar],
    embedding: &Embedding,
) -> Vec<Vec<Freedom>> {
    let mut all = Vec::with_capacity(tree.links.len());
    for (index, link) in tree.links.iter().enumerate() {
        let mut freedoms = Vec::new();
        if let Some(base) = floating_bases.iter().position(|floating_base| floating_base.link == index) {
            for (axis, twist, effort) in translations(g, tree, floating_bases[base], efforts) {
                let slopes = vec![(along(tree, base, axis), Scalar::ONE)];
                freedoms.push(Freedom { coordinate: None, twist, armature: Scalar::ZERO, effort, slopes });
            }
        }
        if !floating_bases.iter().any(|floating_base| floating_base.slides.contains(&index)) {
            for (k, twist) in tree.twists(link) {
                let taken = g.mul(link.armature, still[k]);
                let effort = g.sub(efforts[k], taken);
                let slopes = embedding.slopes[k].clone();
                freedoms.push(Freedom { coordinate: Some(k), twist, armature: link.armature, effort, slopes });
            }
        }
        all.push(freedoms);
    }
    all
}

/// From the leaves inwards.
fn eliminate(
    g: &mut Graph,
    tree: &Tree,
    floating_bases: &[&FloatingBase],
    wrenches: Vec<Wrench>,
    freedoms: &[Vec<Freedom>],
) -> Vec<Pivot> {
    let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
    for &(motion, _) in freedoms.iter().flatten().flat_map(|freedom| &freedom.slopes) {
        *counts.entry(motion).or_default() += 1;
    }
    let links = tree.links.iter().zip(wrenches);
    let mut felt: Vec<Felt> =
        links.map(|(link, wrench)| Felt::new(ArticulatedInertia::rigid(g, &link.inertia), wrench)).collect();
    let mut ground = Felt::new(ArticulatedInertia::ZERO, Wrench::ZERO);
    let mut pivots = Vec::with_capacity(tree.freedoms());
    for (index, link) in tree.links.iter().enumerate().rev() {
        let mut own = felt.pop().or_fault("each link is felt");
        let heading = format!("Articulated inertia of {}.", link.name);
        for within in 0..=freedoms[index].len() {
            if let Some(freedom) = within.checked_sub(1).and_then(|last| freedoms[index].get(last)) {
                own.enter(g, freedom);
            }
            while let Some(motion) = own.complete(&counts) {
                let name = name(tree, floating_bases, motion);
                let pivot = own.eliminate(g, motion, (&name, &heading));
                pivots.push(Pivot { link: Some(index), within, ..pivot });
            }
        }
        let carried = own.carried(g, tree, index);
        match link.parent {
            Some(parent) => felt[parent].add(g, &carried),
            None => ground.add(g, &carried),
        }
    }
    while let Some(motion) = ground.complete(&counts) {
        let name = name(tree, floating_bases, motion);
        pivots.push(ground.eliminate(g, motion, (&name, "What moves the whole mechanism.")));
    }
    pivots
}

/// A motion in names of values.
fn name(tree: &Tree, floating_bases: &[&FloatingBase], motion: usize) -> String {
    let translation = motion.checked_sub(tree.freedoms());
    let base = translation.and_then(|at| Some((floating_bases.get(at / 3)?, at % 3)));
    match base {
        Some((base, axis)) => format!("{}_{}", tree.links[base.link].name, ["x", "y", "z"][axis]),
        None => (motion + 1).to_string(),
    }
}

impl Felt {
    fn new(inertia: ArticulatedInertia, wrench: Wrench) -> Felt {
        Felt { inertia, wrench, open: BTreeMap::new(), masses: BTreeMap::new() }
    }

    /// A unit motion of the link against what carries it.
    fn enter(&mut self, g: &mut Graph, freedom: &Freedom) {
        if freedom.slopes.is_empty() {
            return;
        }
        let twist = &freedom.twist;
        let column = self.inertia.apply(g, twist);
        let along = dot(g, twist, &column);
        let mass = g.add(along, freedom.armature);
        let wrench = components(g, &self.wrench);
        let pushed = dot(g, twist, &wrench);
        let rest = g.sub(freedom.effort, pushed);
        let across: Vec<(usize, Scalar)> =
            self.open.iter().map(|(&motion, open)| (motion, dot(g, twist, &open.column))).collect();
        for (at, &(motion, slope)) in freedom.slopes.iter().enumerate() {
            for &(other, across) in &across {
                let part = g.mul(slope, across);
                let part = if other == motion { g.add(part, part) } else { part };
                self.add_mass(g, motion, other, part);
            }
            let weighted = g.mul(slope, mass);
            for &(other, also) in &freedom.slopes[at..] {
                let part = g.mul(also, weighted);
                self.add_mass(g, motion, other, part);
            }
            let open = self.open.entry(motion).or_insert(Open::NOTHING);
            let mut more = |sum: Scalar, x: Scalar| {
                let part = g.mul(slope, x);
                g.add(sum, part)
            };
            open.column = std::array::from_fn(|k| more(open.column[k], column[k]));
            open.rest = more(open.rest, rest);
            open.met += 1;
        }
    }

    fn add_mass(&mut self, g: &mut Graph, a: usize, b: usize, mass: Scalar) {
        let entry = self.masses.entry((a.min(b), a.max(b))).or_insert(Scalar::ZERO);
        *entry = g.add(*entry, mass);
    }

    /// A motion with which nothing moves that is not in yet.
    fn complete(&self, counts: &BTreeMap<usize, usize>) -> Option<usize> {
        self.open.iter().rev().find(|(motion, open)| counts.get(motion) == Some(&open.met)).map(|one| *one.0)
    }

    fn eliminate(&mut self, g: &mut Graph, motion: usize, (name, heading): (&str, &str)) -> Pivot {
        let Open { column, rest, .. } = self.open.remove(&motion).or_fault("what is eliminated is open");
        let pivot = self.masses.remove(&(motion, motion)).or_fault("what is open has a mass");
        let before = g.begin(Some(heading.to_owned().into()));
        let inverse = g.reciprocal(pivot);
        let drive = g.mul(rest, inverse);
        let gain = column.map(|u| g.mul(u, inverse));
        g.name(pivot, || format!("pivot_{name}"));
        g.name(inverse, || format!("inverse_{name}"));
        g.label(rest, || format!("rest_{name}"));
        g.label(drive, || format!("drive_{name}"));
        for (k, part) in ["wx", "wy", "wz", "x", "y", "z"].iter().enumerate() {
            g.label(column[k], || format!("column_{name}_{part}"));
            g.label(gain[k], || format!("gain_{name}_{part}"));
        }
        g.begin(before);
        self.inertia = self.inertia.less(g, &column, &gain);
        let wrench = components(g, &self.wrench);
        let wrench: [Scalar; 6] = std::array::from_fn(|k| {
            let handed = g.mul(gain[k], rest);
            let handed = if broken(Break::HandedSign) { -handed } else { handed };
            g.add(wrench[k], handed)
        });
        self.wrench = of_components(g, wrench);
        let mut beside: Vec<(usize, Scalar, Scalar)> = Vec::new();
        for &other in self.open.keys() {
            if let Some(mass) = self.masses.remove(&(motion.min(other), motion.max(other))) {
                beside.push((other, mass, g.mul(mass, inverse)));
            }
        }
        for (at, &(other, mass, share)) in beside.iter().enumerate() {
            for &(further, _, also) in &beside[at..] {
                let felt = g.mul(mass, also);
                self.add_mass(g, other, further, -felt);
            }
            if let Some(open) = self.open.get_mut(&other) {
                let mut less = |sum: Scalar, x: Scalar| {
                    let part = g.mul(share, x);
                    g.sub(sum, part)
                };
                open.column = std::array::from_fn(|k| less(open.column[k], column[k]));
                open.rest = less(open.rest, rest);
            }
        }
        let beside = beside.into_iter().map(|(other, _, share)| (other, share)).collect();
        Pivot { link: None, within: 0, motion, gain, drive, beside }
    }

    /// As what carries the link feels it. The ground feels nothing; motions may be open still.
    fn carried(mut self, g: &mut Graph, tree: &Tree, index: usize) -> Felt {
        if tree.links[index].parent.is_none() {
            self.open.values_mut().for_each(|open| open.column = [Scalar::ZERO; 6]);
            return Felt { inertia: ArticulatedInertia::ZERO, wrench: Wrench::ZERO, ..self };
        }
        self.wrench = to_parent(g, tree, index, &self.wrench);
        self.inertia = inertia_to_parent(g, tree, &tree.links[index], &self.inertia);
        for open in self.open.values_mut() {
            let column = of_components(g, open.column);
            let column = to_parent(g, tree, index, &column);
            open.column = components(g, &column);
        }
        self
    }

    fn add(&mut self, g: &mut Graph, other: &Felt) {
        self.wrench = self.wrench.add(g, &other.wrench);
        self.inertia = self.inertia.add(g, &other.inertia);
        for (&motion, more) in &other.open {
            let open = self.open.entry(motion).or_insert(Open::NOTHING);
            open.column = std::array::from_fn(|k| g.add(open.column[k], more.column[k]));
            open.rest = g.add(open.rest, more.rest);
            open.met += more.met;
        }
        for (&(a, b), &mass) in &other.masses {
            self.add_mass(g, a, b, mass);
        }
    }
}

impl Open {
    const NOTHING: Open = Open { column: [Scalar::ZERO; 6], rest: Scalar::ZERO, met: 0 };
}

/// From the ground outwards.
fn accelerate(
    g: &mut Graph,
    tree: &Tree,
    floating_bases: &[&FloatingBase],
    freedoms: &[Vec<Freedom>],
    pivots: &[Pivot],
) -> Vec<Scalar> {
    let mut result = vec![Scalar::ZERO; tree.freedoms()];
    let mut found: BTreeMap<usize, Scalar> = BTreeMap::new();
    let mut pivots = pivots.iter().rev().peekable();
    let mut motions: Vec<(Vector, Vector)> = Vec::with_capacity(tree.links.len());
    while let Some(pivot) = pivots.next_if(|pivot| pivot.link.is_none()) {
        let acceleration = pivot.acceleration(g, &[Scalar::ZERO; 6], &found);
        g.under("Acceleration of the whole mechanism.", |g| {
            g.name(acceleration, || format!("acceleration_{}", name(tree, floating_bases, pivot.motion)));
        });
        found.insert(pivot.motion, acceleration);
    }
    for (index, link) in tree.links.iter().enumerate() {
        let mut motion = [Scalar::ZERO; 6];
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
        // What was eliminated first depends on what came after it, and the link moves by a freedom before what was eliminated within it.
        for within in (0..=freedoms[index].len()).rev() {
            while let Some(pivot) = pivots.next_if(|pivot| pivot.link == Some(index) && pivot.within == within) {
                let acceleration = pivot.acceleration(g, &motion, &found);
                let heading = format!("Acceleration of {}.", link.name);
                g.under(&heading, |g| {
                    g.name(acceleration, || format!("acceleration_{}", name(tree, floating_bases, pivot.motion)));
                });
                found.insert(pivot.motion, acceleration);
            }
            let Some(freedom) = within.checked_sub(1).and_then(|last| freedoms[index].get(last)) else { continue };
            let acceleration = moved(g, &freedom.slopes, &found);
            if let Some(coordinate) = freedom.coordinate {
                result[coordinate] = acceleration;
            }
            motion = std::array::from_fn(|k| {
                let part = g.mul(freedom.twist[k], acceleration);
                g.add(motion[k], part)
            });
        }
        if let Some(base) = floating_bases.iter().position(|floating_base| floating_base.link == index) {
            let travel = [0, 1, 2].map(|axis| found.get(&along(tree, base, axis)).copied().unwrap_or(Scalar::ZERO));
            let mut travel = g.vector(travel);
            let floating_base = floating_bases[base];
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

impl Pivot {
    /// Of its motion; the link moves by `motion` without the freedoms that are in.
    fn acceleration(&self, g: &mut Graph, motion: &[Scalar; 6], found: &BTreeMap<usize, Scalar>) -> Scalar {
        let felt = dot(g, &self.gain, motion);
        let beside = moved(g, &self.beside, found);
        let felt = g.add(felt, beside);
        g.sub(self.drive, felt)
    }
}

/// Sum of slopes times accelerations.
fn moved(g: &mut Graph, slopes: &[(usize, Scalar)], found: &BTreeMap<usize, Scalar>) -> Scalar {
    let known = |motion: usize| found.get(&motion).copied().or_fault("what was eliminated later is known first");
    let terms: Vec<Scalar> = slopes.iter().map(|&(motion, slope)| g.mul(slope, known(motion))).collect();
    g.sum(&terms)
}

fn of_components(g: &mut Graph, [a, b, c, x, y, z]: [Scalar; 6]) -> Wrench {
    Wrench { moment: g.vector([a, b, c]), force: g.vector([x, y, z]) }
}
