//! Wheels as they stand on carts: several on one axle, on bodies that a joint keeps at their height anyway, and blades in a line. So
//! equations follow from others everywhere, which those of wheels that stand anywhere never do.

use super::expression::Point;
use super::numbers::{decimal, turn};
use super::{Expr, Frame, Held, Kind, Mechanism, Step, Vector};
use crate::algebra::{about, quaternion};
use crate::random::Random;

fn y() -> Vector {
    Vector::Whole("Y".into(), [0.0, 1.0, 0.0])
}

fn at(place: [f64; 3]) -> Step {
    Step::At(Vector::literal(place.map(|x| (x * 1e3).round() / 1e3)))
}

impl Mechanism {
    /// A body on a plane that lies anywhere, on wheels, balls or blades.
    pub(super) fn cart(random: &mut Random) -> Option<(Mechanism, Point)> {
        let mut m = Mechanism::base(random);
        let mut base = Frame { body: None, steps: vec![at([random.unit(), random.unit(), random.unit()])] };
        (0..random.below(3)).for_each(|_| base.steps.push(turn(random)));
        let kind = match random.below(5) {
            0 | 1 => Kind::Planar(2, false),
            2 => Kind::Free(false),
            _ => Kind::Free(true),
        };
        let radius = decimal(random, 0.1, 0.5);
        let nothing = Point::default();
        let below = -radius.value(&nothing);
        m.hang(random, kind);
        m.joints[0].parent = base.clone();
        m.joints[0].child.steps.clear();
        // The plane may have axes of its own, turned about its normal.
        let mut on = base;
        on.steps.push(at([random.unit(), random.unit(), 0.0]));
        on.steps.push(Step::At(Vector::Parts([Expr::literal(0.0), Expr::literal(0.0), Expr::literal(below)])));
        if random.chance(50) {
            on.steps.push(Step::Rotated(Vector::Whole("Z".into(), [0.0, 0.0, 1.0]), decimal(random, -3.0, 3.0)));
        }
        let wheels = random.below(3);
        for k in 0..wheels {
            m.hang(random, Kind::Revolute(y()));
            let side = [0.4, -0.3][k];
            m.joints[1 + k].parent = Frame { body: Some(0), steps: vec![at([0.1, side, 0.0])] };
            m.joints[1 + k].child.steps.clear();
            let wheel = Frame { body: Some(1 + k), steps: Vec::new() };
            m.held.push(Held::Disc { wheel, axis: y(), radius: radius.clone(), on: on.clone() });
        }
        let seat = |random: &mut Random| at([random.unit(), random.unit(), 0.0]);
        for _ in 0..if wheels == 0 { 1 + random.below(2) } else { random.below(2) } {
            let what = Frame { body: Some(0), steps: vec![seat(random)] };
            m.held.push(match random.below(3) {
                0 if wheels == 0 => Held::Ball { wheel: what, radius: radius.clone(), on: on.clone() },
                1 => Held::Disc { wheel: what, axis: y(), radius: radius.clone(), on: on.clone() },
                // Two blades beside each other hold the same.
                _ => Held::Blade { blade: what, along: Vector::Whole("X".into(), [1.0, 0.0, 0.0]), on: on.clone() },
            });
        }
        if m.held.is_empty() {
            return None;
        }
        let mut point = Point { time: 0.0, ..m.pose(random) };
        let yaw = random.unit();
        match m.joints[0].kind {
            Kind::Free(true) => point.q[0][2..].copy_from_slice(&[0.0, 0.0, 0.0, yaw]),
            Kind::Free(false) => {
                point.q[0][2] = 0.0;
                point.q[0][3..].copy_from_slice(&quaternion(&about([0.0, 0.0, 1.0], yaw)));
            }
            _ => {}
        }
        Some((m, point))
    }
}
