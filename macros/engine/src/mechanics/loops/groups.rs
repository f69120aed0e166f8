//! Stage `mechanics`: what stands in a mechanism several times, identical up to parameters.
//!
//! In: the checked model. Out: [`Group`]s of closed loops, of branches of one body, and of links in a row. Names and
//! parts play no role: what was written out by hand is found as well. Two members are alike if their `shapes` are: the
//! kinds of joints on the way, the axes' components that are zero and the signs of the others, frames' steps, entries of
//! inertias that are zero, kinds of forces, armatures, and what follows from a `solve` item. Values count as far as they
//! are zero whatever the parameters. A frame on what members hang on is an argument of theirs and may be any.
//!
//! Shapes are a proposal. Whatever is shared between members is checked where it is shared.

mod shapes;

use std::collections::{BTreeMap, HashMap};

use crate::model::types::{BodyId, BodyRef, ConstraintKind, Frame, JointId, LoopClosure, Model};

use super::constraints::{closings, path};
use shapes::Shapes;

/// What members of a group are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repeated {
    /// Closed loops.
    Loops,
    /// Trees without loops on one body.
    Branches,
    /// Links, each on the one before.
    Links,
}

/// Members that are identical up to parameters, in source order.
#[derive(Clone, Debug)]
pub struct Group {
    pub what: Repeated,
    /// What closes each loop; nothing for what is open.
    pub closings: Vec<LoopClosure>,
    /// Names of what closes the loops, or of the branches' first joints.
    pub names: Vec<String>,
}

/// Links in a row are named from this number on: two of a kind are in most arms.
const LEAST_ROW: usize = 3;
/// A body that this many loops pass is one that they hang on.
const HUB: usize = 3;

impl Group {
    /// For the report: `six identical loops: "legs[0].ball" to "legs[5].ball"`.
    pub fn sentence(&self) -> String {
        let what = match self.what {
            Repeated::Loops => "identical loops",
            Repeated::Branches => "identical branches",
            Repeated::Links => "identical links in a row",
        };
        let words = ["two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"];
        let count = self.names.len();
        let number =
            count.checked_sub(2).and_then(|k| words.get(k)).map_or_else(|| count.to_string(), ToString::to_string);
        let quoted: Vec<String> = self.names.iter().map(|name| format!("`{name}`")).collect();
        let list = match &quoted[..] {
            [first, .., last] if count > 2 && counts_up(&self.names) => format!("{first} to {last}"),
            [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
            _ => quoted.concat(),
        };
        format!("{number} {what}: {list}")
    }
}

/// Whether names differ in one number alone, which goes up by one.
fn counts_up(names: &[String]) -> bool {
    let split = |name: &String| {
        let mut pieces: Vec<(bool, String)> = Vec::new();
        for c in name.chars() {
            let digit = c.is_ascii_digit();
            match pieces.last_mut() {
                Some((same, piece)) if *same == digit => piece.push(c),
                _ => pieces.push((digit, c.to_string())),
            }
        }
        pieces
    };
    names.windows(2).all(|pair| {
        let (a, b) = (split(&pair[0]), split(&pair[1]));
        let mut different = a.iter().zip(&b).filter(|(a, b)| a != b);
        let (first, second) = (different.next(), different.next());
        let (Some(((true, x), (true, y))), None, true) = (first, second, a.len() == b.len()) else { return false };
        matches!((x.parse::<u64>(), y.parse::<u64>()), (Ok(x), Ok(y)) if x.checked_add(1) == Some(y))
    })
}

/// All groups of a model: loops, then branches and rows of what is on no loop.
pub fn find(model: &Model) -> Vec<Group> {
    let forest = Forest::new(model);
    let loops: Vec<Loop> = closings(model).into_iter().filter_map(|closing| forest.around(closing)).collect();
    let mut passes = vec![0_usize; model.bodies.len()];
    let mut on_loop = vec![false; model.joints.len()];
    for joint in loops.iter().flat_map(|l| l.sides.iter().flatten()) {
        on_loop[joint.0] = true;
        if let Some(body) = forest.body(*joint) {
            passes[body.0] += 1;
        }
    }
    let mut hubs: Vec<bool> = passes.iter().map(|&count| count >= HUB).collect();
    for (number, joint) in model.joints.iter().enumerate() {
        if let (true, Some(body)) = (joint.kind.is_free(), forest.body(JointId(number))) {
            hubs[body.0] = true;
        }
    }
    let mut shapes = Shapes::new(model, &forest, hubs, on_loop);
    let mut groups = looped(model, &loops, &mut shapes);
    open(model, &forest, &mut shapes, &mut groups);
    groups
}

fn looped(model: &Model, loops: &[Loop], shapes: &mut Shapes<'_>) -> Vec<Group> {
    let mut order: Vec<Vec<LoopClosure>> = Vec::new();
    let mut known: HashMap<String, usize> = HashMap::new();
    for one in loops {
        let place = *known.entry(shapes.looped(one)).or_insert(order.len());
        if place == order.len() {
            order.push(Vec::new());
        }
        order[place].push(one.closing);
    }
    let name = |closing: &LoopClosure| {
        let place = match closing {
            LoopClosure::Cut(id) => &model.joints[*id].place,
            LoopClosure::Constraint(id) => &model.constraints[*id].place,
        };
        path(model, place)
    };
    let several = order.into_iter().filter(|members| members.len() > 1);
    several
        .map(|closings| Group { what: Repeated::Loops, names: closings.iter().map(name).collect(), closings })
        .collect()
}

/// Branches and rows, from the ground outwards; what is inside a member is not looked at again.
fn open(model: &Model, forest: &Forest<'_>, shapes: &mut Shapes<'_>, groups: &mut Vec<Group>) {
    let mut add = |what: Repeated, joints: &[JointId]| {
        let joints = joints.iter().map(|&id| &model.joints[id]);
        groups.push(Group {
            what,
            closings: Vec::new(),
            names: joints.map(|joint| path(model, &joint.place)).collect(),
        });
    };
    let mut carriers: Vec<Option<BodyId>> = vec![None];
    while let Some(carrier) = carriers.pop() {
        let mut alike: BTreeMap<usize, Vec<JointId>> = BTreeMap::new();
        let mut first: HashMap<String, usize> = HashMap::new();
        let mut single = Vec::new();
        for &joint in forest.children(carrier) {
            match shapes.branch(joint) {
                Some(shape) => alike.entry(*first.entry(shape).or_insert(joint.0)).or_default().push(joint),
                None => single.push(joint),
            }
        }
        for members in alike.into_values() {
            if members.len() > 1 {
                add(Repeated::Branches, &members);
                continue;
            }
            single.extend(members);
        }
        for joint in single {
            let row = row(forest, shapes, joint);
            let last = if row.len() >= LEAST_ROW {
                add(Repeated::Links, &row);
                row.last().copied().unwrap_or(joint)
            } else {
                joint
            };
            carriers.extend(forest.body(last).map(Some));
        }
    }
}

/// The longest row of links that are alike, from one outwards.
fn row(forest: &Forest<'_>, shapes: &mut Shapes<'_>, from: JointId) -> Vec<JointId> {
    let mut row = vec![from];
    let shape = shapes.link(from);
    let mut step = None;
    let mut at = from;
    while let (true, [next]) = (!shapes.is_on_loop(at), forest.children(forest.body(at))) {
        if forest.body(at).is_none() || shapes.is_on_loop(*next) || shapes.link(*next) != shape {
            break;
        }
        // Where the next one stands on this one.
        let stand = shapes.stand(*next);
        if step.get_or_insert_with(|| stand.clone()) != &stand {
            break;
        }
        row.push(*next);
        at = *next;
    }
    row
}

/// A closed loop.
struct Loop {
    closing: LoopClosure,
    /// Whether the last body that carries both ends is the ground.
    on_ground: bool,
    carrier: Option<BodyId>,
    /// Joints from there to what closes the loop, on its parent's and on its child's side.
    sides: [Vec<JointId>; 2],
}

/// The spanning tree, to walk in both directions.
struct Forest<'m> {
    model: &'m Model,
    /// By body.
    joints: Vec<Option<JointId>>,
    /// By body, then the ground.
    children: Vec<Vec<JointId>>,
}

impl<'m> Forest<'m> {
    fn new(model: &'m Model) -> Forest<'m> {
        let count = model.bodies.len();
        let mut forest = Forest { model, joints: vec![None; count], children: vec![Vec::new(); count + 1] };
        for &id in &model.tree {
            let joint = &model.joints[id];
            if let BodyRef::Body(body) = joint.child.body {
                forest.joints[body.0] = Some(id);
            }
            let carrier = match joint.parent.body {
                BodyRef::Ground => count,
                BodyRef::Body(body) => body.0,
            };
            forest.children[carrier].push(id);
        }
        forest.children.iter_mut().for_each(|list| list.sort_unstable());
        forest
    }

    /// The body that a joint of the tree carries.
    fn body(&self, joint: JointId) -> Option<BodyId> {
        match self.model.joints[joint].child.body {
            BodyRef::Ground => None,
            BodyRef::Body(body) => Some(body),
        }
    }

    /// Joints on a body, on the ground for `None`.
    fn children(&self, carrier: Option<BodyId>) -> &[JointId] {
        &self.children[carrier.map_or(self.children.len() - 1, |body| body.0)]
    }

    /// Joints from the ground to a frame's body.
    fn chain(&self, frame: &Frame) -> Vec<JointId> {
        let mut chain = Vec::new();
        let mut at = frame.body;
        while let BodyRef::Body(body) = at {
            let Some(joint) = self.joints.get(body.0).copied().flatten() else { break };
            chain.push(joint);
            at = self.model.joints[joint].parent.body;
        }
        chain.reverse();
        chain
    }

    fn around(&self, closing: LoopClosure) -> Option<Loop> {
        let (from, to) = match closing {
            LoopClosure::Cut(id) => {
                let joint = &self.model.joints[id];
                (&joint.parent, &joint.child)
            }
            LoopClosure::Constraint(id) => match &self.model.constraints[id].kind {
                ConstraintKind::Rod { between, .. } => (&between[0], &between[1]),
                ConstraintKind::Value(_) | ConstraintKind::Rate(_) => return None,
            },
        };
        let (from, to) = (self.chain(from), self.chain(to));
        let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
        let carrier = common.checked_sub(1).and_then(|last| self.body(from[last]));
        Some(Loop {
            closing,
            on_ground: carrier.is_none(),
            carrier,
            sides: [from[common..].to_vec(), to[common..].to_vec()],
        })
    }
}
