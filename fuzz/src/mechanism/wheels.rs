//! Mechanisms with wheels, blades and other equations of velocities: a configuration is drawn first, and planes are put where wheels
//! touch them.

use super::expression::Point;
use super::numbers::{axis, decimal, typed};
use super::{Frame, Held, Kind, Mechanism, Step, Term, Vector};
use crate::algebra::{V3, about, apply, cross, dot, minus, norm, plus, product, scaled, transposed};
use crate::plain::{Motion, Plain};
use crate::random::Random;

/// A wheel is at least so far from flat: the sine of what is between its axle and the plane.
const UPRIGHT: f64 = 0.4;

impl Mechanism {
    /// A mechanism with equations of velocities, in some formulation.
    pub fn on_wheels(random: &mut Random) -> Mechanism {
        loop {
            let mut m = Mechanism::base(random);
            for k in 0..1 + random.below(3) {
                let kind = if k == 0 { m.floating(random) } else { m.kind(random) };
                m.hang(random, kind);
            }
            let point = m.pose(random);
            m.closed = point.q.clone();
            let mut equations = 0;
            for _ in 0..1 + random.below(2) {
                equations += m.hold(random, &point);
            }
            if m.held.is_empty() || m.freedoms() <= equations || m.freedoms() > 10 {
                continue;
            }
            m.load(random);
            m.follow(random);
            m.emit = vec!["forward_dynamics", "energy"];
            if random.chance(50) {
                m.emit.extend(["inverse_dynamics", "mass_matrix"]);
            }
            m.outputs = random.chance(50);
            m.formulate_on_wheels(random, equations);
            m.ask_twice(random);
            return m;
        }
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

    fn formulate_on_wheels(&mut self, random: &mut Random, equations: usize) {
        let constraints = *random.pick(&["Multipliers", "Multipliers", "Reduced", "Reduced", "Reduced"]);
        let are_numbers = self.joints.iter().all(|joint| joint.kind.quaternion().is_none());
        let said = match random.below(10) {
            0 => "coordinates: Absolute(Quaternion)".to_owned(),
            1 => "coordinates: Absolute(RollPitchYaw)".to_owned(),
            2..=4 => format!("constraints: {constraints}, speeds: Auto"),
            _ => format!("constraints: {constraints}"),
        };
        // Speeds in the place of all rates: as many as the equations leave.
        if said.starts_with("constraints") && !said.contains("Auto") && are_numbers && random.chance(40) {
            let n = self.freedoms();
            let count = if constraints == "Reduced" { n - equations } else { n };
            let entry = |random: &mut Random, k: usize, at: usize| {
                let one = if k == at { 1.5 } else { 0.0 };
                one + (random.unit() * 1e3).round() / 1e3
            };
            self.speeds = (0..count).map(|k| (0..n).map(|at| entry(random, k, at)).collect()).collect();
        }
        self.tail += &format!("    formulation {{ {said} }}\n");
    }

    /// One more wheel, blade or sum of rates, which holds in a configuration; how many equations that are.
    fn hold(&mut self, random: &mut Random, point: &Point) -> usize {
        let body = random.below(self.bodies.len());
        let on = if random.chance(65) || body == 0 { None } else { Some(random.below(body)) };
        let what = self.frame(random, Some(body));
        match random.below(4) {
            0 => {
                let radius = decimal(random, 0.1, 0.6);
                let on = self.plane(random, point, (&what, on), (radius.value(point), None));
                self.held.push(Held::Ball { wheel: what, radius, on });
                3
            }
            1 => {
                let (radius, axle) = (decimal(random, 0.1, 0.6), axis(random));
                let on = self.plane(random, point, (&what, on), (radius.value(point), Some(axle.value(point))));
                self.held.push(Held::Disc { wheel: what, axis: axle, radius, on });
                3
            }
            2 => {
                let (on, along) = (self.frame(random, on), axis(random));
                self.held.push(Held::Blade { blade: what, along, on });
                1
            }
            _ => {
                let numbers: Vec<(usize, usize)> = (0..self.bodies.len())
                    .flat_map(|joint| (0..self.joints[joint].kind.names().len()).map(move |k| (joint, k)))
                    .collect();
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

    /// A plane on a body, or the ground, that a ball or a disc touches in a configuration.
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
        loop {
            let turn = about([random.unit(), random.unit(), random.unit() + 1e-3], 3.0 * random.unit());
            let turn = product(&carrier.rotation, &turn);
            let normal = apply(&turn, [0.0, 0.0, 1.0]);
            let upright = axle.map_or(1.0, |axle| norm(cross(axle, normal)));
            if upright < UPRIGHT {
                continue;
            }
            let beside = apply(&turn, [random.unit(), random.unit(), 0.0]);
            let place = plus(minus(centre.place, scaled(radius * upright, normal)), beside);
            debug_assert!((dot(minus(centre.place, place), normal) - radius * upright).abs() < 1e-12);
            let back = transposed(&carrier.rotation);
            let steps = vec![
                Step::At(Vector::literal(apply(&back, minus(place, carrier.place)))),
                Step::Oriented(typed(&product(&back, &turn))),
            ];
            return Frame { body: on, steps };
        }
    }
}

/// The values of speeds.
pub fn speeds(of: &Mechanism, rates: &[f64]) -> Vec<f64> {
    of.speeds.iter().map(|factors| factors.iter().zip(rates).map(|(factor, rate)| factor * rate).sum()).collect()
}
