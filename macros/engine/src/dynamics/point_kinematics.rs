//! Stage `dynamics`: the motion of a point, seen from one link after the other towards the ground.
//!
//! In: a point of a link. Out: its position, velocity and acceleration in the axes of a link further in, or the world's.
//! Each joint turns what has been gathered so far once (Horner's scheme); the velocities are those relative to the link
//! from which the point is seen, so only the coordinates in between appear. Through joints with parallel axes the parts
//! stay apart, each with its summed angle, so a planar chain gives l1 cos(q1) + l2 cos(q1 + q2).

use crate::symbolic::graph::{Graph, Rotation, RotationNode, Scalar, Vector};

use super::tree::{Link, Tree};

/// A piece of the way to the point, and how it moves: d = R x, d' = R x' + w x d and so on.
#[derive(Clone, Copy, Debug)]
struct Part {
    rotation: Rotation,
    /// In its own axes: position, rate, second rate.
    local: [Vector; 3],
    /// Of its axes, in the present ones.
    angular: Vector,
    angular_rate: Vector,
}

impl Part {
    /// At rest in the present axes but for its own rates.
    fn fixed(local: [Vector; 3]) -> Part {
        Part { rotation: Rotation::IDENTITY, local, angular: Vector::ZERO, angular_rate: Vector::ZERO }
    }

    fn is_fixed(&self) -> bool {
        self.rotation == Rotation::IDENTITY && self.angular == Vector::ZERO && self.angular_rate == Vector::ZERO
    }
}

/// A point and the frame that it belongs to, as the present link sees them.
pub(crate) struct PointKinematics<'t> {
    tree: &'t Tree,
    /// 0: position; 1: velocity too; 2: acceleration too.
    order: u8,
    acceleration: &'t [Scalar],
    parts: Vec<Part>,
    pub angular: Vector,
    pub angular_rate: Vector,
}

impl<'t> PointKinematics<'t> {
    /// At a point of a link. `acceleration` is read for order 2.
    pub(crate) fn new(tree: &'t Tree, point: Vector, order: u8, acceleration: &'t [Scalar]) -> Self {
        let parts = vec![Part::fixed([point, Vector::ZERO, Vector::ZERO])];
        PointKinematics { tree, order, acceleration, parts, angular: Vector::ZERO, angular_rate: Vector::ZERO }
    }

    /// From `link` up to the link `end`, or the ground.
    pub(crate) fn up_to(&mut self, g: &mut Graph, link: Option<usize>, end: Option<usize>) {
        let tree = self.tree;
        for index in tree.support(link).take_while(|&index| Some(index) != end) {
            self.step(g, &tree.links[index]);
        }
    }

    /// Out of a link: through its motion, then from the joint's frame to the parent's.
    fn step(&mut self, g: &mut Graph, link: &Link) {
        self.leave(g, link);
        self.turn(g, link.rotation, (Vector::ZERO, Vector::ZERO));
        self.push(g, [link.offset, Vector::ZERO, Vector::ZERO]);
    }

    /// Through a link's motion, into the frame that its joint stands in.
    pub(crate) fn leave(&mut self, g: &mut Graph, link: &Link) {
        let tree = self.tree;
        let turn = link.turn(g);
        let (mut w, mut dw) = (Vector::ZERO, Vector::ZERO);
        let mut travel = [link.travel(g), Vector::ZERO, Vector::ZERO];
        // A ball's angular velocity is given in the link's axes, and so is its rate, since w x w = 0.
        if self.order > 0 {
            (w, travel[1]) = tree.joint_motion(g, link, &tree.velocity);
            w = g.rotate(turn, w);
        }
        if self.order > 1 {
            (dw, travel[2]) = tree.joint_motion(g, link, self.acceleration);
            dw = g.rotate(turn, dw);
        }
        self.turn(g, turn, (w, dw));
        self.push(g, travel);
    }

    /// Pieces that nothing has turned against each other are one.
    fn push(&mut self, g: &mut Graph, local: [Vector; 3]) {
        if local == [Vector::ZERO; 3] {
            return;
        }
        match self.parts.last_mut() {
            Some(part) if part.is_fixed() => {
                part.local = [0, 1, 2].map(|k| g.add_vectors(part.local[k], local[k]));
            }
            _ => self.parts.push(Part::fixed(local)),
        }
    }

    /// Everything so far turns by a rotation, whose angular velocity and acceleration are given.
    fn turn(&mut self, g: &mut Graph, rotation: Rotation, rates: (Vector, Vector)) {
        if rotation == Rotation::IDENTITY && rates == (Vector::ZERO, Vector::ZERO) {
            return;
        }
        let mut turned: Vec<Rotation> = self.parts.iter().map(|part| g.compose(rotation, part.rotation)).collect();
        if turned.iter().any(|&r| matches!(g.rotation_node(r), RotationNode::Product(..))) {
            self.parts = vec![Part::fixed(self.local(g))];
            turned = vec![rotation];
        }
        let order = self.order;
        for (part, turned) in self.parts.iter_mut().zip(turned) {
            part.rotation = turned;
            (part.angular, part.angular_rate) = carried(g, order, rotation, (part.angular, part.angular_rate), rates);
        }
        let frame = (self.angular, self.angular_rate);
        (self.angular, self.angular_rate) = carried(g, order, rotation, frame, rates);
    }

    /// Position, velocity and acceleration.
    pub(crate) fn local(&self, g: &mut Graph) -> [Vector; 3] {
        let (mut place, mut rate, mut second) = (Vec::new(), Vec::new(), Vec::new());
        for part in &self.parts {
            let d = g.rotate(part.rotation, part.local[0]);
            place.push(d);
            if self.order == 0 {
                continue;
            }
            let own = g.rotate(part.rotation, part.local[1]);
            let swing = g.cross(part.angular, d);
            rate.extend([own, swing]);
            if self.order == 1 {
                continue;
            }
            let faster = g.rotate(part.rotation, part.local[2]);
            let tangential = g.cross(part.angular_rate, d);
            let centripetal = g.cross(part.angular, swing);
            let coriolis = g.cross(part.angular, own);
            second.extend([faster, tangential, centripetal, coriolis, coriolis]);
        }
        [g.sum_vectors(&place), g.sum_vectors(&rate), g.sum_vectors(&second)]
    }
}

/// Angular velocity and acceleration of a frame as the next link sees them, which moves with `w` and `dw` itself.
fn carried(
    g: &mut Graph,
    order: u8,
    rotation: Rotation,
    (angular, angular_rate): (Vector, Vector),
    (w, dw): (Vector, Vector),
) -> (Vector, Vector) {
    if order == 0 {
        return (Vector::ZERO, Vector::ZERO);
    }
    let turned = g.rotate(rotation, angular);
    let sum = g.add_vectors(turned, w);
    if order == 1 {
        return (sum, Vector::ZERO);
    }
    let own = g.rotate(rotation, angular_rate);
    let gyro = g.cross(w, turned);
    (sum, g.sum_vectors(&[own, gyro, dw]))
}
