//! What hangs on what.

use std::collections::HashMap;

use super::Wrong;
use super::robot::{Joint, Kind, Placed, Robot};

/// A model may have as many items.
const MOST_LINKS: usize = 10_000;

pub(super) struct Tree {
    pub(super) root: usize,
    /// Joints from the root outwards, each before those beyond its child: along a branch to its end, then the next one.
    pub(super) joints: Vec<Hung>,
}

/// A joint between two links, all by their number in the robot.
pub(super) struct Hung {
    pub(super) joint: usize,
    pub(super) parent: usize,
    pub(super) child: usize,
}

/// The tree of a robot, of which every link is reached from one root.
pub(super) fn grow(robot: &Robot) -> Result<Tree, Wrong> {
    let links: HashMap<&str, usize> =
        robot.links.iter().enumerate().map(|(k, link)| (link.name.value.as_str(), k)).collect();
    if robot.links.len() > MOST_LINKS {
        let message = format!("the robot has {} links; {MOST_LINKS} are read", robot.links.len());
        return Err(Wrong::new(&robot.name.at, message));
    }
    let find = |name: &Placed<String>| {
        let unknown = || Wrong::new(&name.at, format!("there is no link `{}`", name.value));
        links.get(name.value.as_str()).copied().ok_or_else(unknown)
    };
    let mut outward: Vec<Vec<Hung>> = robot.links.iter().map(|_| Vec::new()).collect();
    let mut holder: Vec<Option<usize>> = vec![None; robot.links.len()];
    for (k, joint) in robot.joints.iter().enumerate() {
        let (parent, child) = (find(&joint.parent)?, find(&joint.child)?);
        if let Some(first) = holder[child] {
            let (name, first) = (&joint.child.value, &robot.joints[first].name.value);
            let message = format!("the link `{name}` hangs on the joint `{first}` already");
            return Err(Wrong::help(&joint.child.at, message, "URDF has trees alone: close loops in the model"));
        }
        holder[child] = Some(k);
        outward[parent].push(Hung { joint: k, parent, child });
    }
    let roots: Vec<usize> = (0..robot.links.len()).filter(|&k| holder[k].is_none()).collect();
    let root = match roots[..] {
        [root] => root,
        [] => return Err(Wrong::new(&robot.joints[0].at, "every link hangs on another one: none is the root")),
        [first, second, ..] => {
            let (first, second) = (&robot.links[first].name, &robot.links[second].name);
            let message = format!("two links hang on nothing, `{}` and `{}`", first.value, second.value);
            return Err(Wrong::help(&second.at, message, "a robot has one root: a joint is missing"));
        }
    };
    let tree = Tree { root, joints: walk(root, outward) };
    let reached = |link: usize| link == root || tree.joints.iter().any(|hung| hung.child == link);
    if tree.joints.len() + 1 < robot.links.len()
        && let Some(lost) = (0..robot.links.len()).find(|&link| !reached(link))
    {
        let name = &robot.links[lost].name;
        return Err(Wrong::new(&name.at, format!("the link `{}` hangs on itself, in a ring of joints", name.value)));
    }
    mimics(robot)?;
    Ok(tree)
}

/// Without recursion: a file may be a chain of any length.
fn walk(root: usize, mut outward: Vec<Vec<Hung>>) -> Vec<Hung> {
    let mut order = Vec::new();
    let mut next: Vec<Hung> = std::mem::take(&mut outward[root]).into_iter().rev().collect();
    while let Some(hung) = next.pop() {
        next.extend(std::mem::take(&mut outward[hung.child]).into_iter().rev());
        order.push(hung);
    }
    order
}

/// Joints that follow others end at one that follows none.
fn mimics(robot: &Robot) -> Result<(), Wrong> {
    let joints: HashMap<&str, &Joint> = robot.joints.iter().map(|joint| (joint.name.value.as_str(), joint)).collect();
    for joint in &robot.joints {
        let mut last = joint;
        let mut steps = 0;
        while let Some(mimic) = &last.mimic {
            if steps > robot.joints.len() {
                return Err(Wrong::new(&mimic.at, "joints follow each other in a ring"));
            }
            steps += 1;
            let name = &mimic.joint;
            let unknown = || Wrong::new(&name.at, format!("there is no joint `{}`", name.value));
            last = joints.get(name.value.as_str()).ok_or_else(unknown)?;
            if !matches!(last.kind, Kind::Revolute | Kind::Prismatic) {
                let message = format!("the joint `{}` has no coordinate that could be followed", name.value);
                return Err(Wrong::new(&name.at, message));
            }
        }
    }
    Ok(())
}
