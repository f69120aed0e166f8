//! What stands beside wheels: loops, rods, couplings and drives that hold in a configuration.

use super::expression::Point;
use super::numbers::{axis, perpendicular};
use super::{Coupling, Drive, Expr, Kind, Mechanism, Rod};
use crate::algebra::{minus, norm};
use crate::plain::Plain;
use crate::random::Random;

fn rounded(x: f64) -> f64 {
    (x * 1e3).round() / 1e3
}

impl Mechanism {
    /// One or two of these; sometimes fewer, where there is no room.
    pub(super) fn put_beside(&mut self, random: &mut Random, point: &Point) {
        for _ in 0..1 + random.below(2) {
            match random.below(6) {
                0 | 1 => self.couple(random, point),
                2 | 3 => self.lead(random, point),
                4 => self.tie(random, point),
                _ => self.close_beside(random, point),
            }
        }
    }

    fn couple(&mut self, random: &mut Random, point: &Point) {
        let numbers = self.numbers();
        if numbers.len() < 2 {
            return;
        }
        let first = random.below(numbers.len());
        let second = (first + 1 + random.below(numbers.len() - 1)) % numbers.len();
        let is_bent = random.chance(50);
        let terms = [first, second].map(|at| {
            let wave = if is_bent { rounded(0.6 * random.unit()) } else { 0.0 };
            (numbers[at], rounded(random.between(0.7, 2.0) * if random.chance(50) { 1.0 } else { -1.0 }), wave)
        });
        let product = is_bent && random.chance(40);
        let product = product.then(|| (*random.pick(&numbers), *random.pick(&numbers), rounded(0.4 * random.unit())));
        let drift = if random.chance(20) { rounded(0.3 * random.unit()) } else { 0.0 };
        let mut coupling = Coupling { terms: terms.to_vec(), product, drift, offset: 0.0 };
        let q = |at: (usize, usize)| point.q[at.0][at.1];
        let sum: f64 = coupling.terms.iter().map(|&(at, factor, wave)| factor * q(at) + wave * q(at).sin()).sum();
        coupling.offset = -sum - coupling.product.map_or(0.0, |(a, b, factor)| factor * q(a) * q(b));
        self.couplings.push(coupling);
    }

    fn lead(&mut self, random: &mut Random, point: &Point) {
        let free: Vec<(usize, usize)> =
            self.numbers().into_iter().filter(|&at| self.drives.iter().all(|drive| drive.of != at)).collect();
        if free.is_empty() {
            return;
        }
        let of = *random.pick(&free);
        let moving =
            |random: &mut Random, size: f64| if random.chance(70) { rounded(size * random.unit()) } else { 0.0 };
        let (speed, size) = (moving(random, 0.5), moving(random, 0.4));
        self.drives.push(Drive {
            of,
            centre: point.q[of.0][of.1],
            speed,
            size,
            pace: rounded(random.between(0.5, 3.0)),
        });
    }

    fn tie(&mut self, random: &mut Random, point: &Point) {
        let last = random.below(self.bodies.len());
        let other = if random.chance(70) || last == 0 { None } else { Some(random.below(last)) };
        let between = [self.frame(random, other), self.frame(random, Some(last))];
        let plain = Plain::new(self, point);
        let length = norm(minus(plain.frame(&between[0]).place, plain.frame(&between[1]).place));
        if length > 0.2 {
            self.rods.push(Rod { between, length: Expr::literal(length) });
        }
    }

    fn close_beside(&mut self, random: &mut Random, point: &Point) {
        let kind = match random.below(8) {
            0..=2 => Kind::Ball(false),
            3 => Kind::Planar(random.below(3), random.chance(50)),
            4 => {
                let (a, b) = perpendicular(random);
                Kind::PlanarAlong(a, b)
            }
            5 => Kind::Cylindrical(axis(random)),
            6 => {
                let (a, b) = perpendicular(random);
                Kind::Universal(a, b)
            }
            _ => Kind::Revolute(axis(random)),
        };
        let last = random.below(self.bodies.len());
        let other = if random.chance(70) || last == 0 { None } else { Some(random.below(last)) };
        let frame = self.frame(random, other);
        let c: Vec<f64> = (0..kind.coordinates()).map(|_| 0.8 * random.unit()).collect();
        let c = if kind.quaternion().is_some() { vec![1.0, 0.0, 0.0, 0.0] } else { c };
        self.close(kind, frame, Some(last), point, &c);
    }
}
