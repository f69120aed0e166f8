//! Stage `mechanics`: hinges that speeds make a ball.
//!
//! In: the tree with a link for each hinge, speeds of the user's choice. Out: the same tree, in which a link on three hinges about one
//! point, whose turn against what carries them has components among the speeds, is a ball link: its velocity is those speeds, as the
//! velocity of a quaternion's ball is its angular velocity; in open trees alone. So the partial velocities are unit vectors in the link's axes, and all
//! recursions are as short as with a quaternion (Kane and Levinson 1985; Mitiguy and Kane 1996). The first two hinges stay, as links that
//! carry nothing, for what is said of them; their rates, and that of the third, follow from the speeds, w = E q', by E^-1 = adj(E) / det(E).

use crate::dynamics::tree::{Motion, Orientation};
use crate::mechanics::equations::Equations;
use crate::model::types::{BodyRef, Coordinate, Expr, ExprNode, Frame, FrameQuantity, JointId, Speed};
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};
use crate::symbolic::rotations;

use super::build::{FixedFrame, Mechanism};
use super::dependencies::Dependencies;
use super::manipulations::roots;

/// A ball on three hinges.
#[derive(Clone, Debug)]
pub struct HingedBall {
    /// The number of the first of its speeds; two more follow.
    pub speed: usize,
    /// From what carries it on.
    pub hinges: [Coordinate; 3],
    /// Columns of E: what the body turns by where the rate of a hinge is one, in axes of the speeds.
    pub axes: [Vector; 3],
}

/// What speeds are components of.
struct Turn<'m> {
    axes: &'m Frame,
    of: BodyRef,
    base: BodyRef,
}

impl Equations<'_> {
    /// Makes balls of all hinges that speeds allow it of.
    pub(super) fn merge_hinges(&mut self, mechanism: &mut Mechanism) {
        let model = self.scene.model;
        if !self.allows_balls() {
            return;
        }
        let mut number = 0;
        while let Some(speeds) = model.speeds.get(number..number + 3) {
            let ball = self.turn(speeds).and_then(|turn| self.hinged_ball(mechanism, number, &turn));
            number += if ball.is_some() { 3 } else { 1 };
            mechanism.balls.extend(ball);
        }
    }

    /// What three speeds are the x, y and z components of, if they are those of one turn.
    fn turn<'m>(&mut self, speeds: &'m [Speed]) -> Option<Turn<'m>> {
        let mut found: Option<(Turn<'m>, Rotation)> = None;
        for (k, speed) in speeds.iter().enumerate() {
            let (at, turn) = component(&speed.value)?;
            let rotation = self.steps(turn.axes).0;
            let is_same = found.as_ref().is_none_or(|(known, first)| {
                (known.of, known.base, known.axes.body, *first) == (turn.of, turn.base, turn.axes.body, rotation)
            });
            if at != k || !is_same {
                return None;
            }
            found.get_or_insert((turn, rotation));
        }
        found.map(|one| one.0)
    }

    fn hinged_ball(&mut self, mechanism: &mut Mechanism, speed: usize, turn: &Turn<'_>) -> Option<HingedBall> {
        let (rotation, _) = self.steps(turn.axes);
        let axes = mechanism.body(turn.axes.body).then(&mut self.g, rotation, Vector::ZERO);
        let last = axes.link.filter(|&link| mechanism.body(turn.of).link == Some(link))?;
        let tree = &mechanism.tree;
        let middle = tree.links[last].parent?;
        let first = tree.links[middle].parent?;
        let links = [first, middle, last];
        let meets = [middle, last].iter().all(|&at| tree.links[at].offset == Vector::ZERO);
        let is_hinge = |at: &usize| matches!(tree.links[*at].motion, Motion::Revolute(_));
        let is_plain = meets && links.iter().all(is_hinge) && tree.links[last].armature == Scalar::ZERO;
        let carrier = tree.links[first].parent;
        // Travels turn nothing.
        let turning =
            |link: Option<usize>| tree.support(link).find(|&at| !matches!(tree.links[at].motion, Motion::Prismatic(_)));
        if !is_plain || turning(mechanism.body(turn.base).link) != turning(carrier) {
            return None;
        }
        let hinges = links.map(|at| self.scene.symbols.coordinate_at(tree.links[at].freedom));
        let [Some(a), Some(b), Some(c)] = hinges else { return None };
        let hinges = [a, b, c];
        let follows = |hinge: &Coordinate| self.scene.structure.rates.unknowns.contains(hinge);
        if !hinges.iter().all(follows) || self.tells_of(mechanism, &hinges, [first, middle]) {
            return None;
        }
        let to_speeds = axes.rotation.transpose();
        let g = &mut self.g;
        let found = [0, 1, 2].map(|k| {
            let Motion::Revolute(axis) = tree.links[links[k]].motion else { return Vector::ZERO };
            let along = g.along(axis, Scalar::ONE);
            let carried = links[k + 1..].iter().fold(along, |v, &next| tree.to_link(g, &tree.links[next], v));
            let v = rotations::rotate(g, to_speeds, carried);
            if mechanism.flipped[tree.links[links[k]].freedom] { -v } else { v }
        });
        let [one, two, three] = links.map(|at| tree.links[at].turn(g));
        let (to_two, to_three) = (tree.links[middle].rotation, tree.links[last].rotation);
        let whole = [to_two, two, to_three, three, axes.rotation].into_iter();
        let orientation = whole.fold(one, |all, next| g.compose(all, next));
        let (placed, offset) = (tree.links[first].rotation, tree.links[first].offset);
        let freedom = self.scene.symbols.freedoms + speed;
        let link = &mut mechanism.tree.links[last];
        (link.parent, link.rotation, link.offset) = (carrier, placed, offset);
        (link.motion, link.freedom, link.q) = (Motion::Ball(Orientation::Turn(orientation)), freedom, Scalar::ZERO);
        self.turn_axes(mechanism, last, to_speeds);
        Some(HingedBall { speed, hinges, axes: found })
    }

    /// Whether nothing takes motions of the tree apart by the rates of its hinges, which a ball doesn't have: what holds it together, drives,
    /// derivatives and substitutions.
    fn allows_balls(&self) -> bool {
        let model = self.scene.model;
        let is_open =
            model.cuts.is_empty() && model.constraints.is_empty() && model.drives.is_empty() && model.small.is_empty();
        let speeds = model.speeds.iter().map(|speed| &speed.value);
        is_open && !Dependencies::of(roots(model).into_iter().chain(speeds)).manipulations
    }

    /// Whether it is asked what the first hinges transmit, whose links carry nothing any more.
    fn tells_of(&self, mechanism: &Mechanism, hinges: &[Coordinate; 3], links: [usize; 2]) -> bool {
        let between = |joint: &JointId| {
            let child = mechanism.joints[joint.0].child.and_then(|child| child.link);
            hinges.iter().any(|hinge| hinge.joint == *joint) && child.is_some_and(|link| links.contains(&link))
        };
        Dependencies::of(roots(self.scene.model).into_iter()).reactions().iter().any(between)
    }

    /// Turns the axes of a link.
    fn turn_axes(&mut self, mechanism: &mut Mechanism, link: usize, turn: Rotation) {
        let g = &mut self.g;
        for other in mechanism.tree.links.iter_mut().filter(|other| other.parent == Some(link)) {
            other.rotation = rotations::compose(g, turn, other.rotation);
            other.offset = rotations::rotate(g, turn, other.offset);
        }
        let joints = mechanism.joints.iter_mut().filter_map(|joint| joint.child.as_mut());
        for place in mechanism.bodies.iter_mut().chain(joints).filter(|place| place.link == Some(link)) {
            let FixedFrame { rotation, offset, .. } = *place;
            place.rotation = rotations::compose(g, turn, rotation);
            place.offset = rotations::rotate(g, turn, offset);
        }
    }

    /// What the rates of a ball's hinges give its speeds, E q'.
    pub(in crate::mechanics) fn turned_by_hinges(&mut self, ball: &HingedBall) -> [Scalar; 3] {
        let rates = ball.hinges.map(|hinge| self.coordinate_symbols(hinge)[1]);
        let g = &mut self.g;
        let turned: Vec<Vector> = ball.axes.iter().zip(rates).map(|(&axis, rate)| g.scale(rate, axis)).collect();
        let turned = g.sum_vectors(&turned);
        g.components(turned)
    }

    /// Rates of a ball's hinges and their accelerations, with positions and rates on the tree; and det(E).
    pub(in crate::mechanics) fn hinge_rates(&mut self, ball: &HingedBall) -> ([Scalar; 3], [Scalar; 3], Scalar) {
        let [a, b, c] = ball.axes;
        let speeds = [0, 1, 2].map(|k| self.scene.symbols.speeds[ball.speed + k]);
        let turned = self.turned_by_hinges(ball);
        let drift = self.time_derivative(&turned);
        let g = &mut self.g;
        let across = [g.cross(b, c), g.cross(c, a), g.cross(a, b)];
        let volume = g.dot(a, across[0]);
        let inverse = g.reciprocal(volume);
        let solve = |g: &mut Graph, side: [Scalar; 3]| {
            let side = g.vector(side);
            across.map(|row| {
                let along = g.dot(row, side);
                g.mul(inverse, along)
            })
        };
        let first = solve(g, speeds.map(|speed| speed[0]));
        let pushed = [0, 1, 2].map(|k| (speeds[k][1], drift[k]));
        let pushed = pushed.map(|(accelerated, drift)| self.g.sub(accelerated, drift));
        let second = solve(&mut self.g, pushed);
        (first, second, volume)
    }
}

fn component(value: &Expr) -> Option<(usize, Turn<'_>)> {
    let ExprNode::Component(vector, k) = &*value.node else { return None };
    let ExprNode::Express { frame: axes, vector } = &*vector.node else { return None };
    let angular = |vector: &Expr| match &*vector.node {
        ExprNode::OfFrame(frame, FrameQuantity::AngularVelocity) => Some(frame.body),
        _ => None,
    };
    let (of, base) = match &*vector.node {
        ExprNode::Sub(of, base) => (angular(of)?, angular(base)?),
        _ => (angular(vector)?, BodyRef::Ground),
    };
    Some((*k, Turn { axes, of, base }))
}
