//! Mechanisms with wheels, blades and other equations of velocities: a configuration is drawn first, and planes are put where wheels
//! touch them.

use nalgebra::DMatrix;

use super::expression::Point;
use super::numbers::{axis, decimal, typed};
use super::{Expr, Frame, Held, Kind, Load, Mechanism, Step, Term, Vector};
use crate::algebra::{
    Matrix, V3, about, apply, cross, dot, least, minus, norm, plus, product, rank, scaled, transposed,
};
use crate::closed::{Equations, Source, linear, state};
use crate::plain::{Motion, Plain};
use crate::random::Random;

/// A wheel is at least so far from flat, and a blade from standing on end: the sine of the angle from there.
const NEAREST: f64 = 3e-3;

impl Mechanism {
    /// A mechanism with equations of velocities, in some formulation.
    pub fn on_wheels(random: &mut Random) -> Mechanism {
        loop {
            let found = if random.chance(20) { Mechanism::cart(random) } else { Mechanism::anywhere_on_wheels(random) };
            let Some((mut m, point)) = found else { continue };
            m.closed = point.q.clone();
            if random.chance(60) {
                m.put_beside(random, &point);
            }
            let equations = Equations::new(&m, &point);
            let (_, ratio, rank) = least(&equations.slope, &equations.drift);
            // Near a singular pose nothing can be compared; what is said of such models is looked at in a few.
            let is_odd = ratio < 3e-2 || rank >= m.freedoms() || (0..2).all(|_| state(&m, random).is_none());
            if m.held.is_empty() || m.freedoms() > 10 || is_odd && !random.chance(4) {
                continue;
            }
            m.load(random);
            m.follow(random);
            m.emit = vec!["forward_dynamics", "energy"];
            if random.chance(50) {
                m.emit.extend(["inverse_dynamics", "mass_matrix"]);
            }
            m.outputs = random.chance(40);
            m.contacts = random.chance(60);
            let beside = (0..4).filter_map(|_| state(&m, random)).map(|at| Equations::new(&m, &at));
            let several: Vec<Equations> = [equations].into_iter().chain(beside).collect();
            m.formulate_on_wheels(random, &several);
            m.read_loads(random, &several);
            m.ask_twice(random);
            return m;
        }
    }

    /// A tree with wheels wherever they come to stand.
    fn anywhere_on_wheels(random: &mut Random) -> Option<(Mechanism, Point)> {
        let mut m = Mechanism::base(random);
        for k in 0..1 + random.below(3) {
            let kind = if k == 0 { m.floating(random) } else { m.kind(random) };
            m.hang(random, kind);
        }
        let point = Point { time: 0.0, ..m.pose(random) };
        let mut equations = 0;
        for _ in 0..1 + random.below(2) {
            equations += m.hold(random, &point);
        }
        (m.freedoms() > equations).then_some((m, point))
    }

    /// What lets a carrier go anywhere.
    fn floating(&self, random: &mut Random) -> Kind {
        match random.below(5) {
            0 => Kind::Free(false),
            1 | 2 => Kind::Free(true),
            3 => Kind::Planar(random.below(3), random.chance(40)),
            _ => self.kind(random),
        }
    }

    fn formulate_on_wheels(&mut self, random: &mut Random, several: &[Equations]) {
        let are_numbers = self.joints[..self.bodies.len()].iter().all(|joint| joint.kind.quaternion().is_none());
        let constraints = *random.pick(&["Multipliers", "Multipliers", "Reduced", "Reduced", "Reduced"]);
        // A quaternion that follows from others is refused.
        let constraints = if are_numbers || random.chance(20) { constraints } else { "Multipliers" };
        let said = match random.below(12) {
            0 => "coordinates: Absolute(Quaternion)".to_owned(),
            1 => "coordinates: Absolute(RollPitchYaw)".to_owned(),
            2..=4 => format!("constraints: {constraints}, speeds: Auto"),
            5 => "constraints: Stabilised, rate: 10, position: 25".to_owned(),
            6 => "constraints: Auto".to_owned(),
            _ => format!("constraints: {constraints}"),
        };
        // Speeds in the place of all rates: as many as the equations leave.
        let is_plain = said == format!("constraints: {constraints}");
        if is_plain && are_numbers && random.chance(50) {
            let n = self.freedoms();
            let count = n - if constraints == "Reduced" { several[0].rank() } else { put_in(several).nrows() };
            let entry = |random: &mut Random, k: usize, at: usize| {
                let one = if k == at { 1.5 } else { 0.0 };
                one + (random.unit() * 1e3).round() / 1e3
            };
            self.speeds = (0..count).map(|k| (0..n).map(|at| entry(random, k, at)).collect()).collect();
        }
        self.tail += &format!("    formulation {{ {said} }}\n");
    }

    /// Outputs of multipliers: seldom of those that others share the load with, which are refused.
    fn read_loads(&mut self, random: &mut Random, several: &[Equations]) {
        if !random.chance(60) {
            return;
        }
        // Where equations depend on each other in one pose alone their loads can be told.
        let mut known = vec![false; several[0].sources.len()];
        for equations in several {
            known.iter_mut().zip(equations.stands_alone()).for_each(|(known, alone)| *known |= alone);
        }
        let sources = &several[0].sources;
        let all = |of: Source| sources.iter().zip(&known).filter(|(source, _)| **source == of).all(|one| *one.1);
        let mut offer = |load: Load, is_known: bool| {
            if random.chance(if is_known { 70 } else { 3 }) {
                self.loads.push(load);
            }
        };
        for (k, held) in self.held.iter().enumerate() {
            if held.frames().is_some() {
                offer(Load::Force(k), all(Source::Held(k)));
            }
            let first = sources.iter().position(|source| *source == Source::Held(k));
            for row in 0..held.rows().len() {
                offer(Load::Row(k, row), first.is_some_and(|first| known[first + row]));
            }
        }
        (0..self.rods.len()).for_each(|k| offer(Load::Rod(k), all(Source::Rod(k))));
        for (k, coupling) in self.couplings.iter().enumerate() {
            // A linear one is put in where its coordinates are, without a multiplier.
            offer(Load::Coupling(k), all(Source::Coupling(k)) && !coupling.is_linear());
        }
        (0..self.drives.len()).for_each(|k| offer(Load::Drive(k), all(Source::Drive(k))));
    }

    /// One more wheel, blade or sum of rates, which holds in a configuration; how many equations that are.
    fn hold(&mut self, random: &mut Random, point: &Point) -> usize {
        let body = random.below(self.bodies.len());
        let on = if random.chance(60) || body == 0 { None } else { Some(random.below(body)) };
        let what = self.frame(random, Some(body));
        match random.below(4) {
            0 => {
                let radius = radius(random);
                let on = self.plane(random, point, (&what, on), (radius.value(point), None));
                self.held.push(Held::Ball { wheel: what, radius, on });
                3
            }
            1 => {
                let (radius, axle) = (radius(random), direction(random));
                let on = self.plane(random, point, (&what, on), (radius.value(point), Some(axle.value(point))));
                self.held.push(Held::Disc { wheel: what, axis: axle, radius, on });
                3
            }
            2 => {
                let along = direction(random);
                // Standing nearly on end, or anyhow.
                let on = match random.chance(30) {
                    true => self.plane(random, point, (&what, on), (0.0, Some(along.value(point)))),
                    false => self.frame(random, on),
                };
                self.held.push(Held::Blade { blade: what, along, on });
                1
            }
            _ => {
                let numbers = self.numbers();
                if numbers.len() < 2 {
                    return 0;
                }
                let terms = (0..2 + random.below(2)).map(|_| Term {
                    rate: *random.pick(&numbers),
                    factor: (random.between(0.5, 2.0) * 1e3).round() / 1e3,
                    wave: (random.unit() * 300.0).round() / 1e3,
                    of: *random.pick(&numbers),
                });
                let terms = terms.collect();
                let drift = if random.chance(30) { (random.unit() * 1e3).round() / 1e3 } else { 0.0 };
                self.held.push(Held::Rates { terms, drift });
                1
            }
        }
    }

    /// Coordinates that are numbers.
    pub(super) fn numbers(&self) -> Vec<(usize, usize)> {
        let of = |joint: usize| (0..self.joints[joint].kind.names().len()).map(move |k| (joint, k));
        (0..self.bodies.len()).flat_map(of).collect()
    }

    /// A plane on a body, or the ground, that a ball or a disc touches in a configuration, upright or nearly flat.
    fn plane(
        &self,
        random: &mut Random,
        point: &Point,
        (wheel, on): (&Frame, Option<usize>),
        (radius, axle): (f64, Option<V3>),
    ) -> Frame {
        let plain = Plain::new(self, point);
        let centre = plain.frame(wheel);
        let axle = axle.map(|axle| apply(&centre.rotation, scaled(1.0 / norm(axle), axle)));
        let carrier = on.map_or_else(Motion::still, |body| plain.bodies[body]);
        let turn = match axle {
            Some(axle) if random.chance(30) => {
                let sine = 0.4 * (NEAREST / 0.4_f64).powf(random.between(0.0, 1.0));
                nearly_along(random, axle, sine)
            }
            _ => {
                let turn = about([random.unit(), random.unit(), random.unit() + 1e-3], 3.0 * random.unit());
                product(&carrier.rotation, &turn)
            }
        };
        let normal = apply(&turn, [0.0, 0.0, 1.0]);
        let upright = axle.map_or(1.0, |axle| norm(cross(axle, normal)));
        let beside = apply(&turn, [random.unit(), random.unit(), 0.0]);
        let place = plus(minus(centre.place, scaled(radius * upright, normal)), beside);
        debug_assert!((dot(minus(centre.place, place), normal) - radius * upright).abs() < 1e-12);
        let back = transposed(&carrier.rotation);
        let steps = vec![
            Step::At(Vector::literal(apply(&back, minus(place, carrier.place)))),
            Step::Oriented(typed(&product(&back, &turn))),
        ];
        Frame { body: on, steps }
    }
}

/// What is taken out of the state whatever keeps multipliers, drives and linear equations of positions, as independent rows.
pub fn put_in(several: &[Equations]) -> DMatrix<f64> {
    let linear = linear(several);
    let of = &several[0];
    let is_out = |k: &usize| linear.contains(k) || matches!(of.sources[*k], Source::Drive(_));
    let rows: Vec<usize> = (0..of.sources.len()).filter(is_out).collect();
    let mut kept: Vec<usize> = Vec::new();
    for row in rows {
        let with: Vec<usize> = kept.iter().copied().chain([row]).collect();
        if rank(&of.slope.select_rows(&with)) == with.len() {
            kept = with;
        }
    }
    of.slope.select_rows(&kept)
}

/// A turn whose z axis is at an angle of this sine to a direction, or to its opposite.
fn nearly_along(random: &mut Random, direction: V3, sine: f64) -> Matrix {
    let aside = super::numbers::any_normal(random, direction);
    let sign = if random.chance(50) { 1.0 } else { -1.0 };
    let z = plus(scaled(sign * (1.0 - sine * sine).sqrt(), direction), scaled(sine, aside));
    let x = super::numbers::any_normal(random, z);
    let y = cross(z, x);
    [0, 1, 2].map(|k| [x[k], y[k], z[k]])
}

/// Of a wheel: as people write it, or as another program prints it.
fn radius(random: &mut Random) -> Expr {
    if random.chance(70) { decimal(random, 0.1, 0.6) } else { Expr::literal(random.between(0.1, 0.6)) }
}

/// Of an axle or an edge, the same.
fn direction(random: &mut Random) -> Vector {
    if random.chance(80) { axis(random) } else { Vector::literal([random.unit(), random.unit(), random.unit() + 1e-3]) }
}

/// The values of speeds.
pub fn speeds(of: &Mechanism, rates: &[f64]) -> Vec<f64> {
    of.speeds.iter().map(|factors| factors.iter().zip(rates).map(|(factor, rate)| factor * rate).sum()).collect()
}
