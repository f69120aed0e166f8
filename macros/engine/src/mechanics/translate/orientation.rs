//! Stage `mechanics`: orientations as quaternions.
//!
//! In: a frame. Out: its orientation in the world as w, i, j, k. Where one joint at most turns the frame, the quaternion is
//! that of the joint (the coordinates of a ball, half the angle of a hinge) times those of the constant placements.
//! Else it is read off the rotation matrix without branches: of the four forms, each with a component as its pivot, the
//! one is selected whose pivot is at least 1/2, so there is one root and one reciprocal and no cancellation (after
//! Shepperd 1978).

use crate::contracts::call::Call;

use crate::mechanics::equations::Equations;
use crate::symbolic::graph::{Graph, Rotation, RotationNode, Scalar, Vector};
use crate::symbolic::number::Number;
use crate::symbolic::rotations;

use super::build::FixedFrame;

type Quaternion = [Scalar; 4];

impl Equations<'_> {
    /// Orientation of a frame.
    pub(in crate::mechanics) fn quaternion(&mut self, place: &FixedFrame) -> Quaternion {
        match self.few_turns(place) {
            Some(turns) => {
                let identity = [Scalar::ONE, Scalar::ZERO, Scalar::ZERO, Scalar::ZERO];
                turns.into_iter().fold(identity, |product, turn| {
                    let turn = self.quaternion_of(turn);
                    multiply(&mut self.g, product, turn)
                })
            }
            None => {
                let rows = self.frame_rows(place);
                of_rows(&mut self.g, &rows)
            }
        }
    }

    /// The rotations from the ground to a frame if one at most is not constant.
    fn few_turns(&mut self, place: &FixedFrame) -> Option<Vec<Rotation>> {
        let mechanism = std::rc::Rc::clone(&self.scene.mechanism);
        let tree = &mechanism.tree;
        let g = &mut self.g;
        // Constant, moving, constant.
        let mut turns: [Rotation; 3] = [Rotation::IDENTITY; 3];
        for index in tree.path(None, place.link) {
            let link = &tree.links[index];
            let moving = link.turn(g);
            let slot = if turns[1] == Rotation::IDENTITY { 0 } else { 2 };
            turns[slot] = rotations::compose(g, turns[slot], link.rotation);
            if moving == Rotation::IDENTITY {
                continue;
            }
            let parallel = turns[2] == Rotation::IDENTITY && is_axis(g, turns[1]) && is_axis(g, moving);
            let both = if turns[1] == Rotation::IDENTITY {
                moving
            } else if parallel {
                g.compose(turns[1], moving)
            } else {
                return None;
            };
            if matches!(g.rotation_node(both), RotationNode::Product(..)) {
                return None;
            }
            turns[1] = both;
        }
        let slot = if turns[1] == Rotation::IDENTITY { 0 } else { 2 };
        turns[slot] = rotations::compose(g, turns[slot], place.rotation);
        Some(turns.into_iter().filter(|&r| r != Rotation::IDENTITY).collect())
    }

    /// Of one turn or a constant.
    fn quaternion_of(&mut self, rotation: Rotation) -> Quaternion {
        let g = &mut self.g;
        let [w, i, j, k] = match *g.rotation_node(rotation) {
            RotationNode::Quaternion(q) => q,
            RotationNode::Axis(axis, angle) => {
                let half = g.decimal(0.5);
                let half = g.mul(half, angle);
                let mut q = [g.cos(half), Scalar::ZERO, Scalar::ZERO, Scalar::ZERO];
                q[axis + 1] = g.sin(half);
                q
            }
            _ => {
                let rows = rotations::rows(g, rotation);
                return of_rows(g, &rows);
            }
        };
        if rotation.is_transposed() { [w, -i, -j, -k] } else { [w, i, j, k] }
    }
}

fn is_axis(g: &Graph, r: Rotation) -> bool {
    matches!(g.rotation_node(r), RotationNode::Axis(..))
}

/// Rate of a unit quaternion: q (0, w) / 2.
pub(super) fn quaternion_rate(g: &mut Graph, q: Quaternion, w: [Scalar; 3]) -> Quaternion {
    let half = g.decimal(0.5);
    let w = w.map(|w| g.mul(half, w));
    multiply(g, q, [Scalar::ZERO, w[0], w[1], w[2]])
}

/// Of a unit quaternion that changes at this rate, in the child's axes: the vector of 2 q* q'.
pub(in crate::mechanics) fn angular_velocity(g: &mut Graph, [w, x, y, z]: Quaternion, dq: Quaternion) -> Vector {
    let two = g.integer(2);
    let product = multiply(g, [w, -x, -y, -z], dq);
    let vector = g.vector([product[1], product[2], product[3]]);
    g.scale(two, vector)
}

fn multiply(g: &mut Graph, p: Quaternion, q: Quaternion) -> Quaternion {
    // Row by row: which component of q meets w, i, j, k of p, and with which sign.
    let table: [[(usize, bool); 4]; 4] = [
        [(0, false), (1, true), (2, true), (3, true)],
        [(1, false), (0, false), (3, false), (2, true)],
        [(2, false), (3, true), (0, false), (1, false)],
        [(3, false), (2, false), (1, true), (0, false)],
    ];
    table.map(|row| {
        let terms = [0, 1, 2, 3].map(|k| {
            let (other, minus) = row[k];
            let product = g.mul(p[k], q[other]);
            if minus { -product } else { product }
        });
        g.sum(&terms)
    })
}

/// Of a rotation matrix, row by row.
pub(in crate::mechanics) fn of_rows(g: &mut Graph, m: &[[Scalar; 3]; 3]) -> Quaternion {
    if let Some(literal) = literal(g, m) {
        return literal;
    }
    let [x, y, z] = [m[0][0], m[1][1], m[2][2]];
    // Twice w times, and the products among, i, j, k, all times two.
    let turns = [g.sub(m[2][1], m[1][2]), g.sub(m[0][2], m[2][0]), g.sub(m[1][0], m[0][1])];
    let both = [g.add(m[1][2], m[2][1]), g.add(m[2][0], m[0][2]), g.add(m[0][1], m[1][0])];
    // Four times the squares of w, i, j, k.
    let (plus, minus) = (g.add(Scalar::ONE, x), g.sub(Scalar::ONE, x));
    let (sum, difference) = (g.add(y, z), g.sub(y, z));
    let squares = [g.add(plus, sum), g.sub(plus, sum), g.add(minus, difference), g.sub(minus, difference)];
    let forms: [Quaternion; 4] = [
        [squares[0], turns[0], turns[1], turns[2]],
        [turns[0], squares[1], both[2], both[1]],
        [turns[1], both[2], squares[2], both[0]],
        [turns[2], both[1], both[0], squares[3]],
    ];
    let lower = g.call(Call::Less, &[z, Scalar::ZERO]);
    let first = g.call(Call::Less, &[y, x]);
    let opposite = g.call(Call::Less, &[x, -y]);
    let mut select = |pick: &dyn Fn(usize) -> Scalar| {
        // z < 0: i or j is large; else k or w.
        let inner = g.call(Call::Select, &[first, pick(1), pick(2)]);
        let outer = g.call(Call::Select, &[opposite, pick(3), pick(0)]);
        g.call(Call::Select, &[lower, inner, outer])
    };
    let pivot = select(&|form| squares[form]);
    let chosen = [0, 1, 2, 3].map(|component| select(&|form| forms[form][component]));
    let root = g.sqrt(pivot);
    let inverse = g.reciprocal(root);
    let half = g.decimal(0.5);
    let scale = g.mul(half, inverse);
    chosen.map(|c| g.mul(c, scale))
}

/// A matrix of literals needs no code. Its quaternion is exact where the root in it is.
fn literal(g: &mut Graph, m: &[[Scalar; 3]; 3]) -> Option<Quaternion> {
    let mut n = [[Number::ZERO; 3]; 3];
    for (row, scalars) in n.iter_mut().zip(m) {
        for (value, &s) in row.iter_mut().zip(scalars) {
            *value = g.literal(s)?;
        }
    }
    let (one, [x, y, z]) = (Number::ONE, [n[0][0], n[1][1], n[2][2]]);
    let squares = [one + x + y + z, one + x - y - z, one - x + y - z, one - x - y + z];
    let turns = [n[2][1] - n[1][2], n[0][2] - n[2][0], n[1][0] - n[0][1]];
    let both = [n[1][2] + n[2][1], n[2][0] + n[0][2], n[0][1] + n[1][0]];
    let forms = [
        [squares[0], turns[0], turns[1], turns[2]],
        [turns[0], squares[1], both[2], both[1]],
        [turns[1], both[2], squares[2], both[0]],
        [turns[2], both[1], both[0], squares[3]],
    ];
    let (square, form) = squares.iter().zip(forms).max_by(|a, b| a.0.value().total_cmp(&b.0.value()))?;
    let square = g.number(*square);
    let root = g.sqrt(square);
    match g.literal(root) {
        Some(root) => Some(form.map(|c| g.number(c / (Number::integer(2) * root)))),
        None => {
            let scale = 0.5 / g.literal(square)?.value().sqrt();
            Some(form.map(|c| g.decimal(c.value() * scale)))
        }
    }
}
