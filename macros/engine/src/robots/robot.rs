//! Stage `robots`: a robot, whatever file it comes from.
//!
//! In: what a reader of a format has found. Out: links and joints that are known to make one tree.

use std::collections::{BTreeMap, HashMap};

use super::mistake::{Mistake, Place};

/// A number with the digits that the file has.
#[derive(Clone, Debug)]
pub(super) struct Number {
    pub(super) is_negative: bool,
    /// Without a sign, as a literal of the language.
    pub(super) digits: String,
    pub(super) value: f64,
}

impl Number {
    pub(super) fn whole(value: u8) -> Number {
        Number { is_negative: false, digits: format!("{value}.0"), value: f64::from(value) }
    }

    /// What has been computed, with all its digits.
    pub(super) fn of(value: f64) -> Number {
        Number { is_negative: value < 0.0, digits: format!("{:?}", value.abs()), value }
    }
}

/// Where a frame lies in another one: the position in m, then roll, pitch and yaw in rad, `Rz(yaw) * Ry(pitch) * Rx(roll)`.
#[derive(Clone, Debug)]
pub(super) struct Origin {
    pub(super) xyz: [Number; 3],
    pub(super) rpy: [Number; 3],
}

impl Origin {
    pub(super) fn none() -> Origin {
        let zeros = || [0, 0, 0].map(Number::whole);
        Origin { xyz: zeros(), rpy: zeros() }
    }
}

/// Mass in kg, and the inertia about the centre of mass in kg m^2, in the axes of `origin`.
#[derive(Clone, Debug)]
pub(super) struct Inertial {
    /// Of the centre of mass in the link's frame.
    pub(super) origin: Origin,
    pub(super) mass: Number,
    /// xx, yy, zz, xy, xz, yz
    pub(super) tensor: [Number; 6],
}

#[derive(Clone, Debug)]
pub(super) struct Link {
    pub(super) name: String,
    pub(super) at: Place,
    pub(super) inertial: Option<Inertial>,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    Fixed,
    Revolute,
    Prismatic,
    Planar,
    Ball,
    Floating,
}

/// `coordinate = multiplier * other + offset`
#[derive(Clone, Debug)]
pub(super) struct Mimic {
    pub(super) joint: String,
    pub(super) at: Place,
    pub(super) multiplier: Number,
    pub(super) offset: Number,
}

#[derive(Clone, Debug)]
pub(super) struct Joint {
    pub(super) name: String,
    pub(super) at: Place,
    pub(super) kind: Kind,
    pub(super) parent: String,
    pub(super) child: String,
    /// Of the child's frame in the parent's, with all coordinates zero.
    pub(super) origin: Origin,
    /// In the child's frame; of any length but zero.
    pub(super) axis: [Number; 3],
    /// The point of the child's frame that the joint holds, where it is not the origin.
    pub(super) anchor: Option<[Number; 3]>,
    /// N m s/rad or N s/m; nothing if it is zero.
    pub(super) damping: Option<Number>,
    /// kg m^2 or kg; nothing if it is zero.
    pub(super) armature: Option<Number>,
    pub(super) spring: Option<Spring>,
    pub(super) mimic: Option<Mimic>,
}

/// `-stiffness * (coordinate - rest)`
#[derive(Clone, Debug)]
pub(super) struct Spring {
    pub(super) stiffness: Number,
    pub(super) rest: Number,
}

/// A joint that closes a loop.
#[derive(Clone, Debug)]
pub(super) struct Closure {
    pub(super) name: String,
    pub(super) at: Place,
    pub(super) kind: Kind,
    /// In the frame of the joint; of any length but zero. `Fixed` and `Ball` have none.
    pub(super) axis: Option<[Number; 3]>,
    pub(super) parent: String,
    pub(super) child: String,
    pub(super) in_parent: Origin,
    pub(super) in_child: Origin,
}

/// `ratio` times the coordinates on the way to one link is the sum of those on the way to another one, both from the nearest link
/// that carries both.
#[derive(Clone, Debug)]
pub(super) struct Coupling {
    pub(super) name: String,
    pub(super) at: Place,
    pub(super) ratio: Number,
    pub(super) predecessor: String,
    pub(super) successor: String,
}

/// An input that drives a joint.
#[derive(Clone, Debug)]
pub(super) struct Motor {
    pub(super) name: String,
    pub(super) at: Place,
    pub(super) joint: String,
    /// Effort for an input of one.
    pub(super) gear: Number,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Robot {
    pub(super) name: String,
    pub(super) links: Vec<Link>,
    pub(super) joints: Vec<Joint>,
    pub(super) closures: Vec<Closure>,
    pub(super) couplings: Vec<Coupling>,
    pub(super) motors: Vec<Motor>,
    /// Elements that carry no mechanics, with how often they stand in the file.
    pub(super) read_over: BTreeMap<String, usize>,
}

impl Robot {
    /// The joint that each link hangs on; nothing for the root, of which there is one.
    pub(super) fn tree(&self) -> Result<Tree, Mistake> {
        let mut links = HashMap::new();
        for (k, link) in self.links.iter().enumerate() {
            if links.insert(link.name.as_str(), k).is_some() {
                return Err(Mistake::at(link.at, format!("two links are called `{}`", link.name)));
            }
        }
        let mut names = HashMap::new();
        let mut above: Vec<Option<usize>> = vec![None; self.links.len()];
        let mut parents = Vec::new();
        for (k, joint) in self.joints.iter().enumerate() {
            if names.insert(joint.name.as_str(), k).is_some() {
                return Err(Mistake::at(joint.at, format!("two joints are called `{}`", joint.name)));
            }
            let find = |name: &str| {
                let message = || format!("joint `{}` names the link `{name}`, which isn't there", joint.name);
                links.get(name).copied().ok_or_else(|| Mistake::at(joint.at, message()))
            };
            let (parent, child) = (find(&joint.parent)?, find(&joint.child)?);
            if let Some(other) = above[child] {
                let other = &self.joints[other].name;
                let message = format!("link `{}` hangs on two joints, `{other}` and `{}`", joint.child, joint.name);
                return Err(Mistake::at(joint.at, message));
            }
            above[child] = Some(k);
            parents.push(parent);
        }
        let mut roots = (0..self.links.len()).filter(|&link| above[link].is_none());
        let Some(root) = roots.next() else {
            return Err(match self.links.first() {
                Some(link) => Mistake::at(link.at, "every link hangs on a joint: they go round in a circle"),
                None => Mistake::file("there is no link"),
            });
        };
        if let Some(second) = roots.next() {
            let [a, b] = [root, second].map(|link| &self.links[link]);
            let message = format!("two links hang on no joint, `{}` and `{}`: a robot is one tree", a.name, b.name);
            return Err(Mistake::at(b.at, message));
        }
        let mut order = vec![root];
        let mut below: Vec<Vec<usize>> = vec![Vec::new(); self.links.len()];
        for (link, joint) in above.iter().enumerate() {
            if let Some(joint) = joint {
                below[parents[*joint]].push(link);
            }
        }
        let mut next = 0;
        while let Some(&link) = order.get(next) {
            order.extend(&below[link]);
            next += 1;
        }
        let mut is_reached = vec![false; self.links.len()];
        order.iter().for_each(|&link| is_reached[link] = true);
        if let Some(lost) = is_reached.iter().position(|is_reached| !is_reached) {
            let (link, root) = (&self.links[lost], &self.links[root].name);
            let message =
                format!("link `{}` does not hang on the root `{root}`: joints go round in a circle", link.name);
            return Err(Mistake::at(link.at, message));
        }
        Ok(Tree { root, above, parents, order })
    }
}

/// Places among links and joints.
pub(super) struct Tree {
    pub(super) root: usize,
    /// Of each link.
    pub(super) above: Vec<Option<usize>>,
    /// Of each joint.
    pub(super) parents: Vec<usize>,
    /// Links, parents first.
    pub(super) order: Vec<usize>,
}

impl Tree {
    /// The joints that a link hangs on, from the link to the root.
    fn path(&self, link: usize) -> Vec<usize> {
        let above = |joint: &usize| self.above[self.parents[*joint]];
        std::iter::successors(self.above[link], above).collect()
    }

    /// The joints on the way to each of two links from the nearest link that carries both.
    pub(super) fn ways(&self, a: usize, b: usize) -> [Vec<usize>; 2] {
        let [mut a, mut b] = [self.path(a), self.path(b)];
        while a.last().is_some() && a.last() == b.last() {
            a.pop();
            b.pop();
        }
        [a, b]
    }
}
