//! Wheels, blades, sums of rates, couplings and drives in plain numbers, as the language defines them.

use super::Row;
use super::joints::{Relative, UNITS};
use crate::algebra::{V3, apply, cross, dot, minus, norm, plus, scaled};
use crate::mechanism::expression::Point;
use crate::mechanism::{Coupling, Drive, Held, Term};
use crate::plain::Plain;

fn unit(v: V3) -> V3 {
    scaled(1.0 / norm(v), v)
}

/// Where something touches its plane, as the plane's frame sees it.
pub(super) struct Contact {
    /// Of the equations, behind each other.
    pub directions: Vec<V3>,
    /// Of the directions.
    turning: Vec<V3>,
    /// From the origin of the frame of what touches.
    pub low: V3,
    /// The material's velocity there, and the rate of that at what is the lowest point.
    pub slip: V3,
    slip_rate: V3,
}

impl Contact {
    pub(super) fn new(held: &Held, relative: &Relative, at: &Point) -> Option<Contact> {
        let up = UNITS[2];
        let Relative { s: [_, v, a], turn, w, dw } = relative;
        let with = |low: V3, moved: V3, directions: Vec<V3>, turning: Vec<V3>| {
            let slip = plus(*v, cross(*w, low));
            let slip_rate = plus(*a, plus(cross(*dw, low), cross(*w, moved)));
            Some(Contact { directions, turning, low, slip, slip_rate })
        };
        match held {
            Held::Ball { radius, .. } => {
                let low = scaled(-radius.value(at), up);
                with(low, [0.0; 3], vec![up, UNITS[0], UNITS[1]], vec![[0.0; 3]; 3])
            }
            Held::Disc { axis, radius, .. } => {
                let r = radius.value(at);
                let axle = apply(turn, unit(axis.value(at)));
                let turned = cross(*w, axle);
                let (tilt, tilting) = (axle[2], turned[2]);
                let upright = norm(cross(axle, up));
                let rising = -tilt * tilting / upright;
                // Ahead, and from the centre to the contact: quotients by `upright`.
                let quotient = |x: V3, dx: V3| {
                    let first = scaled(1.0 / upright, x);
                    (first, minus(scaled(1.0 / upright, dx), scaled(rising / upright, first)))
                };
                let (ahead, ahead_rate) = quotient(cross(axle, up), cross(turned, up));
                let down = minus(scaled(tilt, axle), up);
                let (low, moved) = quotient(down, plus(scaled(tilting, axle), scaled(tilt, turned)));
                let aside = minus(axle, scaled(tilt, up));
                let (aside, aside_rate) = quotient(aside, minus(turned, scaled(tilting, up)));
                // The material's velocity along the normal is the rate of the height.
                let turning = vec![[0.0; 3], ahead_rate, aside_rate];
                with(scaled(r, low), scaled(r, moved), vec![up, ahead, aside], turning)
            }
            Held::Blade { along, .. } => {
                let edge = apply(turn, along.value(at));
                let (side, turned) = (cross(up, edge), cross(up, cross(*w, edge)));
                let size = norm(side);
                let aside = scaled(1.0 / size, side);
                let aside_rate = scaled(1.0 / size, minus(turned, scaled(dot(aside, turned), aside)));
                with([0.0; 3], [0.0; 3], vec![aside], vec![aside_rate])
            }
            Held::Rates { .. } => None,
        }
    }

    fn row(&self, k: usize) -> Row {
        let (n, turning) = (self.directions[k], self.turning[k]);
        Row::of_velocities(dot(self.slip, n), dot(self.slip_rate, n) + dot(self.slip, turning))
    }
}

/// Of a wheel, a blade or rates.
pub(super) fn rows(held: &Held, plain: &Plain<'_>, at: &Point) -> Vec<Row> {
    if let Held::Rates { terms, drift } = held {
        return vec![rates(terms, *drift, at)];
    }
    let Some([what, on]) = held.frames() else { return Vec::new() };
    let relative = Relative::new(&plain.frame(on), &plain.frame(what));
    let Some(contact) = Contact::new(held, &relative, at) else { return Vec::new() };
    let mut rows: Vec<Row> = (0..contact.directions.len()).map(|k| contact.row(k)).collect();
    if matches!(held, Held::Ball { .. } | Held::Disc { .. }) {
        let height = relative.s[0][2] + contact.low[2];
        rows[0] = Row::of_positions(height, rows[0].rate, rows[0].acceleration);
    }
    rows
}

fn rates(terms: &[Term], drift: f64, at: &Point) -> Row {
    let (mut rate, mut acceleration) = (drift * at.time.sin(), drift * at.time.cos());
    for Term { rate: (joint, k), factor, wave, of } in terms {
        let (sin, cos) = at.q[of.0][of.1].sin_cos();
        let slope = factor + wave * sin;
        rate += slope * at.v[*joint][*k];
        acceleration += slope * at.a[*joint][*k] + wave * cos * at.v[of.0][of.1] * at.v[*joint][*k];
    }
    Row::of_velocities(rate, acceleration)
}

/// Of a coupling.
pub(super) fn coupling(coupling: &Coupling, at: &Point) -> Row {
    let (sin, cos) = at.time.sin_cos();
    let [mut held, mut rate, mut acceleration] =
        [coupling.offset + coupling.drift * sin, coupling.drift * cos, -coupling.drift * sin];
    for &((joint, k), factor, wave) in &coupling.terms {
        let (q, v, a) = (at.q[joint][k], at.v[joint][k], at.a[joint][k]);
        held += factor * q + wave * q.sin();
        let slope = factor + wave * q.cos();
        rate += slope * v;
        acceleration += slope * a - wave * q.sin() * v * v;
    }
    if let Some((one, other, factor)) = coupling.product {
        let of = |list: &[Vec<f64>]| (list[one.0][one.1], list[other.0][other.1]);
        let ((p, q), (v, w), (a, b)) = (of(&at.q), of(&at.v), of(&at.a));
        held += factor * p * q;
        rate += factor * (v * q + p * w);
        acceleration += factor * (a * q + 2.0 * v * w + p * b);
    }
    Row::of_positions(held, rate, acceleration)
}

/// Of a drive.
pub(super) fn drive(drive: &Drive, at: &Point) -> Row {
    let (joint, k) = drive.of;
    let (sin, cos) = (drive.pace * at.time).sin_cos();
    let where_to = drive.centre + drive.speed * at.time + drive.size * sin;
    let speed = drive.speed + drive.size * drive.pace * cos;
    let change = -drive.size * drive.pace * drive.pace * sin;
    Row::of_positions(at.q[joint][k] - where_to, at.v[joint][k] - speed, at.a[joint][k] - change)
}
