//! Loops, wheels and blades in plain numbers: residuals, their rates and accelerations, states that satisfy them, and the accelerations that
//! follow from the plain mass matrix with a multiplier for each equation, redundant ones included.

use nalgebra::{DMatrix, DVector};

use crate::algebra::{Matrix, V3, apply, cross, dot, least, minus, norm, plus, product, scaled, transposed};
use crate::mechanism::expression::Point;
use crate::mechanism::{Frame, Held, Kind, Mechanism, Term};
use crate::plain::{Motion, Plain, displaced, split};
use crate::random::Random;

/// One scalar equation at a point.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// NaN of an equation of velocities.
    residual: f64,
    rate: f64,
    acceleration: f64,
}

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

const UNITS: [V3; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The child's frame as the parent's sees it: place, turn, and their first and second rates, in the parent's axes.
struct Relative {
    s: [V3; 3],
    turn: Matrix,
    w: V3,
    dw: V3,
}

impl Relative {
    fn new(parent: &Motion, child: &Motion) -> Relative {
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

    fn along(&self, n: V3) -> Row {
        let [residual, rate, acceleration] = self.s.map(|x| dot(n, x));
        Row { residual, rate, acceleration }
    }

    /// The turn has no part about a direction, since an axis stays where it is.
    fn upright(&self, n: V3, u: V3) -> Row {
        Row { residual: dot(u, cross(n, apply(&self.turn, n))), rate: dot(u, self.w), acceleration: dot(u, self.dw) }
    }

    fn rows(&self, kind: &Kind, at: &Point) -> Vec<Row> {
        let unit = |v: V3| scaled(1.0 / norm(v), v);
        let point = || UNITS.map(|e| self.along(e)).to_vec();
        let still = || {
            let sine = axial(&self.turn);
            let row = |e: V3| Row { residual: dot(e, sine), rate: dot(e, self.w), acceleration: dot(e, self.dw) };
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
                let thread = Row {
                    residual: s - p * angle,
                    rate: ds - p * dot(n, self.w),
                    acceleration: dds - p * dot(n, self.dw),
                };
                [line(n), axis(n), vec![thread]].concat()
            }
            Kind::Universal(a, b) => {
                let (a, b) = (unit(a.value(at)), apply(&self.turn, unit(b.value(at))));
                let m = cross(a, b);
                let row = Row {
                    residual: dot(a, b),
                    rate: dot(m, self.w),
                    acceleration: dot(m, self.dw) + dot(self.w, cross(a, cross(self.w, b))),
                };
                // Signs: the rate of a . b is a . (w x b) = -w . (a x b).
                let row = Row { residual: -row.residual, ..row };
                [point(), vec![row]].concat()
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

fn rows(of: &Mechanism, at: &Point) -> Vec<Row> {
    let plain = Plain::new(of, at);
    let mut list = Vec::new();
    for joint in of.cuts() {
        list.extend(Relative::new(&plain.frame(&joint.parent), &plain.frame(&joint.child)).rows(&joint.kind, at));
    }
    for rod in &of.rods {
        let [a, b] = rod.between.each_ref().map(|frame| plain.frame(frame));
        let (d, v) = (minus(b.place, a.place), minus(b.velocity, a.velocity));
        let (reach, length) = (norm(d), rod.length.value(at));
        let n = scaled(1.0 / reach, d);
        list.push(Row {
            residual: reach - length,
            rate: dot(n, v),
            acceleration: dot(n, minus(b.acceleration, a.acceleration)) + (dot(v, v) - dot(n, v).powi(2)) / reach,
        });
    }
    for held in &of.held {
        list.extend(held_rows(held, &plain, at));
    }
    list
}

/// Of a wheel, a blade or rates, in the axes of the plane, as the language defines them.
fn held_rows(held: &Held, plain: &Plain<'_>, at: &Point) -> Vec<Row> {
    let moving = |on: &Frame, what: &Frame| Relative::new(&plain.frame(on), &plain.frame(what));
    let rate = |rate: f64, acceleration: f64| Row { residual: f64::NAN, rate, acceleration };
    let unit = |v: V3| scaled(1.0 / norm(v), v);
    let up = UNITS[2];
    // The material's velocity at a point of the body, which moves on it, and the rate of that.
    let slip = |relative: &Relative, low: V3, moved: V3| {
        let Relative { s: [_, v, a], w, dw, .. } = relative;
        let slip = plus(*v, cross(*w, low));
        (slip, plus(*a, plus(cross(*dw, low), cross(*w, moved))))
    };
    match held {
        Held::Ball { wheel, radius, on } => {
            let relative = moving(on, wheel);
            let (v, dv) = slip(&relative, scaled(-radius.value(at), up), [0.0; 3]);
            let height = relative.along(up);
            let touch = Row { residual: height.residual - radius.value(at), ..height };
            vec![touch, rate(v[0], dv[0]), rate(v[1], dv[1])]
        }
        Held::Disc { wheel, axis, radius, on } => {
            let (relative, r) = (moving(on, wheel), radius.value(at));
            let axle = apply(&relative.turn, unit(axis.value(at)));
            let turned = cross(relative.w, axle);
            let (tilt, tilting) = (axle[2], turned[2]);
            let upright = (1.0 - tilt * tilt).sqrt();
            let rising = -tilt * tilting / upright;
            // Ahead, and from the centre to the contact: quotients by `upright`.
            let quotient = |x: V3, dx: V3| {
                let first = scaled(1.0 / upright, x);
                (first, minus(scaled(1.0 / upright, dx), scaled(rising / upright, first)))
            };
            let (ahead, ahead_rate) = quotient(cross(axle, up), cross(turned, up));
            let down = minus(scaled(tilt, axle), up);
            let (low, moved) = quotient(down, plus(scaled(tilting, axle), scaled(tilt, turned)));
            let (v, dv) = slip(&relative, scaled(r, low), scaled(r, moved));
            let aside = minus(axle, scaled(tilt, up));
            let (aside, aside_rate) = quotient(aside, minus(turned, scaled(tilting, up)));
            // The material's velocity along the normal is the rate of the height.
            let touch = Row { residual: relative.s[0][2] - r * upright, rate: v[2], acceleration: dv[2] };
            let across = |n: V3, dn: V3| rate(dot(v, n), dot(dv, n) + dot(v, dn));
            vec![touch, across(ahead, ahead_rate), across(aside, aside_rate)]
        }
        Held::Blade { blade, along, on } => {
            let relative = moving(on, blade);
            let edge = apply(&relative.turn, along.value(at));
            let (side, turned) = (cross(up, edge), cross(up, cross(relative.w, edge)));
            let size = norm(side);
            let aside = scaled(1.0 / size, side);
            let aside_rate = scaled(1.0 / size, minus(turned, scaled(dot(aside, turned), aside)));
            let [_, v, a] = relative.s;
            vec![rate(dot(v, aside), dot(a, aside) + dot(v, aside_rate))]
        }
        Held::Rates { terms, drift } => {
            let mut row = rate(drift * at.time.sin(), drift * at.time.cos());
            for Term { rate: (joint, k), factor, wave, of } in terms {
                let (sin, cos) = at.q[of.0][of.1].sin_cos();
                let slope = factor + wave * sin;
                row.rate += slope * at.v[*joint][*k];
                row.acceleration += slope * at.a[*joint][*k] + wave * cos * at.v[of.0][of.1] * at.v[*joint][*k];
            }
            vec![row]
        }
    }
}

/// Rates of all equations where nothing moves.
fn drifts(of: &Mechanism, at: &Point) -> DVector<f64> {
    let mut at = at.clone();
    at.v.iter_mut().chain(&mut at.a).for_each(|list| list.fill(0.0));
    DVector::from(rows(of, &at).iter().map(|row| row.rate).collect::<Vec<f64>>())
}

/// Which equations are of positions.
fn of_positions(of: &Mechanism, at: &Point) -> Vec<usize> {
    let all = rows(of, at);
    (0..all.len()).filter(|&k| !all[k].residual.is_nan()).collect()
}

/// Residuals of all equations of positions.
pub fn residuals(of: &Mechanism, at: &Point) -> Vec<f64> {
    rows(of, at).iter().map(|row| row.residual).filter(|residual| !residual.is_nan()).collect()
}

/// Rates of the residuals by velocity coordinate.
pub fn jacobian(of: &Mechanism, at: &Point) -> DMatrix<f64> {
    let n = of.freedoms();
    let rest = drifts(of, at);
    let mut at = at.clone();
    at.a.iter_mut().for_each(|list| list.fill(0.0));
    let columns: Vec<DVector<f64>> = (0..n)
        .map(|k| {
            let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == k))).collect();
            at.v = split(of, &unit);
            DVector::from(rows(of, &at).iter().map(|row| row.rate).collect::<Vec<f64>>()) - &rest
        })
        .collect();
    DMatrix::from_columns(&columns)
}

/// Those of equations of positions alone.
pub fn position_jacobian(of: &Mechanism, at: &Point) -> DMatrix<f64> {
    jacobian(of, at).select_rows(&of_positions(of, at))
}

/// Whether some velocity turns the ends of a screw that closes a loop about another axis than its own.
pub fn turns_beside(of: &Mechanism, at: &Point) -> bool {
    let n = of.freedoms();
    let mut at = at.clone();
    (0..n).any(|k| {
        let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == k))).collect();
        at.v = split(of, &unit);
        let plain = Plain::new(of, &at);
        of.cuts().iter().any(|joint| match &joint.kind {
            Kind::Screw(axis, _) => {
                let relative = Relative::new(&plain.frame(&joint.parent), &plain.frame(&joint.child));
                let axis = axis.value(&at);
                norm(cross(axis, relative.w)) > 1e-9 * norm(axis)
            }
            _ => false,
        })
    })
}

/// Position and velocity that close the loops, near those given.
pub fn settled(of: &Mechanism, mut at: Point) -> Option<Point> {
    let mut last = f64::INFINITY;
    for _ in 0..40 {
        let gap = DVector::from(residuals(of, &at));
        last = if gap.is_empty() { 0.0 } else { gap.amax() };
        if last < 1e-14 {
            break;
        }
        let (step, ..) = least(&position_jacobian(of, &at), &-gap);
        let step = if step.amax() > 0.5 { &step * (0.5 / step.amax()) } else { step };
        at.q = displaced(of, &at.q, &split(of, step.as_slice()), 1.0);
    }
    if last.is_nan() || last > 1e-12 {
        return None;
    }
    let v = DVector::from(at.v.concat());
    let slope = jacobian(of, &at);
    let (step, ..) = least(&slope, &-(&slope * &v + drifts(of, &at)));
    at.v = split(of, (v + step).as_slice());
    Some(at)
}

/// A closed state some way from the configuration that was drawn.
pub fn state(of: &Mechanism, random: &mut Random) -> Option<Point> {
    let mut at = of.point(random);
    at.params.clear();
    for default in &of.params {
        let value = default.value(&at);
        at.params.push(value);
    }
    at.q = of.closed.clone();
    let away = *random.pick(&[0.0, 0.1, 0.3, 0.6]);
    let direction: Vec<f64> = (0..of.freedoms()).map(|_| random.unit()).collect();
    // Along the motion that the loops allow, in small steps, so that it stays on the branch.
    for _ in 0..6 {
        let slope = position_jacobian(of, &at);
        let d = DVector::from(direction.clone());
        let (back, ratio, _) = least(&slope, &-(&slope * &d));
        if ratio < 1e-2 {
            return None;
        }
        at.q = displaced(of, &at.q, &split(of, (d + back).as_slice()), away / 6.0);
        at = settled(of, at)?;
    }
    Some(at)
}

/// What the plain equations say of a closed state.
pub struct Closed {
    /// Of all tree coordinates.
    pub accelerations: Vec<f64>,
    /// Of the equations.
    pub rank: usize,
    /// Least over greatest singular value of the equations.
    pub ratio: f64,
}

/// Accelerations: M a + bias + G^T l = 0 and G a + rest = 0.
pub fn accelerations(of: &Mechanism, at: &Point) -> Option<Closed> {
    let mut still = at.clone();
    still.a.iter_mut().for_each(|list| list.fill(0.0));
    let bias = DVector::from(Plain::new(of, &still).efforts().0);
    let matrix = Plain::mass_matrix(of, at);
    let gamma = DVector::from(rows(of, &still).iter().map(|row| row.acceleration).collect::<Vec<f64>>());
    let slope = jacobian(of, at);
    let factor = matrix.cholesky()?;
    let free = -factor.solve(&bias);
    let answer = factor.solve(&slope.transpose());
    let system = &slope * &answer;
    let (_, ratio, rank) = least(&slope, &gamma);
    let (multipliers, ..) = least(&system, &-(gamma + &slope * &free));
    let accelerations = free + answer * multipliers;
    Some(Closed { accelerations: accelerations.iter().copied().collect(), rank, ratio })
}
