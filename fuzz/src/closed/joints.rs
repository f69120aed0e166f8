//! Joints that close loops: how one frame moves against the other, and what of that a joint holds.

use super::Row;
use crate::algebra::{Matrix, V3, apply, cross, dot, minus, norm, plus, product, scaled, transposed};
use crate::mechanism::Kind;
use crate::mechanism::expression::Point;
use crate::plain::Motion;

/// Two directions that are perpendicular to one.
fn across(n: V3) -> [V3; 2] {
    let k = (0..3).fold(0, |best, k| if n[k].abs() < n[best].abs() { k } else { best });
    let mut e = [0.0; 3];
    e[k] = 1.0;
    let u = cross(n, e);
    let u = scaled(1.0 / norm(u), u);
    [u, cross(n, u)]
}

/// Half the axial part: the sine of the angle along the axis.
fn axial(m: &Matrix) -> V3 {
    [0.5 * (m[2][1] - m[1][2]), 0.5 * (m[0][2] - m[2][0]), 0.5 * (m[1][0] - m[0][1])]
}

pub(super) const UNITS: [V3; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The child's frame as the parent's sees it: place, turn, and their first and second rates, in the parent's axes.
pub(super) struct Relative {
    /// Of the place: itself and its rates.
    pub s: [V3; 3],
    pub turn: Matrix,
    /// Of the turn.
    pub w: V3,
    pub dw: V3,
}

impl Relative {
    pub(super) fn new(parent: &Motion, child: &Motion) -> Relative {
        let back = transposed(&parent.rotation);
        let arm = minus(child.place, parent.place);
        let sweep = cross(parent.omega, arm);
        let v = minus(minus(child.velocity, parent.velocity), sweep);
        let carried = plus(cross(parent.alpha, arm), cross(parent.omega, sweep));
        let coriolis = scaled(2.0, cross(parent.omega, v));
        let a = minus(minus(minus(child.acceleration, parent.acceleration), carried), coriolis);
        let w = minus(child.omega, parent.omega);
        let dw = minus(minus(child.alpha, parent.alpha), cross(parent.omega, w));
        Relative {
            s: [arm, v, a].map(|x| apply(&back, x)),
            turn: product(&back, &child.rotation),
            w: apply(&back, w),
            dw: apply(&back, dw),
        }
    }

    pub(super) fn along(&self, n: V3) -> Row {
        let [residual, rate, acceleration] = self.s.map(|x| dot(n, x));
        Row::of_positions(residual, rate, acceleration)
    }

    /// The turn has no part about a direction, since an axis stays where it is.
    fn upright(&self, n: V3, u: V3) -> Row {
        Row::of_positions(dot(u, cross(n, apply(&self.turn, n))), dot(u, self.w), dot(u, self.dw))
    }

    pub(super) fn rows(&self, kind: &Kind, at: &Point) -> Vec<Row> {
        let unit = |v: V3| scaled(1.0 / norm(v), v);
        let point = || UNITS.map(|e| self.along(e)).to_vec();
        let still = || {
            let sine = axial(&self.turn);
            let row = |e: V3| Row::of_positions(dot(e, sine), dot(e, self.w), dot(e, self.dw));
            UNITS.map(row).to_vec()
        };
        let axis = |n: V3| across(n).map(|u| self.upright(n, u)).to_vec();
        let line = |n: V3| across(n).map(|u| self.along(u)).to_vec();
        match kind {
            Kind::Fixed => [point(), still()].concat(),
            Kind::Revolute(v) => [point(), axis(unit(v.value(at)))].concat(),
            Kind::Prismatic(v) => [line(unit(v.value(at))), still()].concat(),
            Kind::Cylindrical(v) => {
                let n = unit(v.value(at));
                [line(n), axis(n)].concat()
            }
            Kind::Screw(v, pitch) => {
                let (n, p) = (unit(v.value(at)), pitch.value(at));
                let u = across(n)[0];
                let turned = apply(&self.turn, u);
                let angle = dot(n, cross(u, turned)).atan2(dot(u, turned));
                let [s, ds, dds] = self.s.map(|x| dot(n, x));
                // The travel tells which turn it is.
                let angle = angle + std::f64::consts::TAU * ((s / p - angle) / std::f64::consts::TAU).round();
                let thread = Row::of_positions(s - p * angle, ds - p * dot(n, self.w), dds - p * dot(n, self.dw));
                [line(n), axis(n), vec![thread]].concat()
            }
            Kind::Universal(a, b) => {
                let (a, b) = (unit(a.value(at)), apply(&self.turn, unit(b.value(at))));
                let m = cross(a, b);
                let turning = dot(m, self.dw) + dot(self.w, cross(a, cross(self.w, b)));
                // Signs: the rate of a . b is a . (w x b) = -w . (a x b).
                [point(), vec![Row::of_positions(-dot(a, b), dot(m, self.w), turning)]].concat()
            }
            Kind::Planar(k, _) => [vec![self.along(UNITS[*k])], axis(UNITS[*k])].concat(),
            Kind::PinSlot(a, b) => [line(unit(b.value(at))), axis(unit(a.value(at)))].concat(),
            Kind::PlanarAlong(a, b) => {
                let n = unit(cross(a.value(at), b.value(at)));
                [vec![self.along(n)], axis(n)].concat()
            }
            Kind::Ball(_) => point(),
            Kind::Free(_) => Vec::new(),
        }
    }
}
