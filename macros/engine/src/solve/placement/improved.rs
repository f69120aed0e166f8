//! Stage `solve`: a pose that is nearly where its distances leave it, by one step of Newton's method.
//!
//! A polynomial of high degree leaves its roots fewer digits than the distances themselves would, all the more where two modes are near
//! each other. With n = p + R b - a and a twist (v, w) of the body, J delta = e has rows n . (v_k + w_k x R b) and sides (r^2 - n^2) / 2;
//! the turn w is Cayley's, so that R stays a rotation. A step that is not small would lead elsewhere, and is not taken: there two modes meet.

use crate::contracts::call::Call;
use crate::symbolic::graph::{BlockKind, Graph, Scalar, Vector};

use super::{Distance, Pose, turned};

/// Largest step: of the origin beside the length of a leg, of the turn beside one.
const LARGEST: f64 = 0.01;

/// Linear and angular velocity of the body's origin.
pub(super) type Twist = (Vector, Vector);

impl Pose {
    /// Nearer to what the distances say, along these twists, as many as there are distances.
    pub(super) fn improved(
        self,
        g: &mut Graph,
        distances: &[Distance],
        twists: &[Twist],
        normal: Option<Vector>,
    ) -> Pose {
        let half = g.decimal(0.5);
        let (mut matrix, mut side) = (Vec::new(), Vec::new());
        for distance in distances {
            let arm = turned(g, &self.rows, distance.body);
            let from = g.sub_vectors(self.position, distance.base);
            let between = g.add_vectors(arm, from);
            let between = distance.seen(g, normal, between);
            for &(linear, angular) in twists {
                let way = g.cross(angular, arm);
                let way = g.add_vectors(linear, way);
                matrix.push(g.dot(between, way));
            }
            let square = g.dot(between, between);
            let open = g.sub(distance.square, square);
            side.push(g.mul(half, open));
        }
        let operands = [matrix, side].concat();
        let steps = g.block_outputs(BlockKind::Eliminate { size: distances.len(), strict: false }, &operands);
        let sum = |g: &mut Graph, part: fn(&Twist) -> Vector| {
            let terms: Vec<Vector> = steps.iter().zip(twists).map(|(&s, twist)| g.scale(s, part(twist))).collect();
            g.sum_vectors(&terms)
        };
        let (linear, angular) = (sum(g, |twist| twist.0), sum(g, |twist| twist.1));
        // Beside the length of a leg, and beside one.
        let (way, turn) = (g.dot(linear, linear), g.dot(angular, angular));
        let largest = g.decimal(LARGEST * LARGEST);
        let length = distances.first().map_or(Scalar::ONE, |distance| distance.square);
        let part = g.mul(largest, length);
        let small = [(way, part), (turn, largest)].map(|(a, b)| g.call(Call::LessEqual, &[a, b]));
        let small = g.call(Call::And, &small);
        let keep = |g: &mut Graph, v: Vector| {
            let kept = g.components(v).map(|x| g.call(Call::Select, &[small, x, Scalar::ZERO]));
            g.vector(kept)
        };
        let (linear, angular) = (keep(g, linear), keep(g, angular));
        let halved = g.scale(half, angular);
        let size = g.dot(halved, halved);
        let whole = g.add(Scalar::ONE, size);
        let inverse = g.reciprocal(whole);
        let two = g.integer(2);
        let scale = g.mul(two, inverse);
        let columns = [0, 1, 2].map(|column| {
            let column = g.vector([0, 1, 2].map(|row| self.rows[row][column]));
            let across = g.cross(halved, column);
            let back = g.cross(halved, across);
            let both = g.add_vectors(across, back);
            let turn = g.scale(scale, both);
            let moved = g.add_vectors(column, turn);
            g.components(moved)
        });
        let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| columns[column][row]));
        Pose { rows, position: g.add_vectors(self.position, linear), condition: self.condition }
    }
}
