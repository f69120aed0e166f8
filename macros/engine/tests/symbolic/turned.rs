//! Expressions whose values turn with everything else, against themselves.

use crate::rng::Rng;
use multibody_engine::contracts::call::Call;
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Graph, Scalar, SymbolId};
use multibody_engine::symbolic::turned::{Turn, lower_turned};

/// An angle, the components of a velocity in the plane that it turns, and a number.
struct Plane {
    g: Graph,
    angle: Scalar,
    velocity: [Scalar; 2],
    number: Scalar,
}

fn plane() -> Plane {
    let mut g = Graph::new();
    let [angle, a, b, number] = std::array::from_fn(|_| g.symbol());
    Plane { g, angle, velocity: [a, b], number }
}

impl Plane {
    fn turn(&self) -> Turn {
        let id = |s| self.g.symbol_id(s).expect("a symbol");
        Turn { angle: id(self.angle), vectors: vec![self.velocity.map(id)] }
    }

    /// (x, y) from axes that head along to those of the world.
    fn in_world(&mut self, [x, y]: [Scalar; 2]) -> [Scalar; 2] {
        let (c, s) = (self.g.cos(self.angle), self.g.sin(self.angle));
        let terms = [[self.g.mul(c, x), -self.g.mul(s, y)], [self.g.mul(s, x), self.g.mul(c, y)]];
        terms.map(|terms| self.g.sum(&terms))
    }

    /// What is found for these, which has to have their values; by result whether it still reads the angle.
    fn turned(&self, roots: &[Scalar]) -> Option<Vec<bool>> {
        let (graph, found) = lower_turned(&self.g, roots, &self.turn())?;
        let mut rng = Rng::new(7);
        for _ in 0..20 {
            let values: [f64; 4] = std::array::from_fn(|_| rng.real(-3.0, 3.0));
            let value = |id: SymbolId| values[id.0];
            let wanted = Evaluator::new(&self.g, Real { symbols: &value }).run(roots);
            let got = Evaluator::new(&graph, Real { symbols: &value }).run(&found);
            for (wanted, got) in wanted.iter().zip(&got) {
                assert!((wanted - got).abs() <= 1e-12 * (1.0 + wanted.abs()), "{wanted} {got}");
            }
        }
        let angle = graph.symbol_handle(self.turn().angle).expect("a symbol");
        Some(found.iter().map(|&root| graph.depends_on(root, &[angle])).collect())
    }
}

/// The speed along the heading is a component of the turned velocity; a function of it that nobody can look through is the same
/// function.
#[test]
fn what_doesn_t_turn() {
    let mut p = plane();
    let one = [Scalar::ONE, Scalar::ZERO];
    let ahead = p.in_world(one);
    let along: Vec<Scalar> = ahead.iter().zip(p.velocity).map(|(&n, v)| p.g.mul(n, v)).collect();
    let along = p.g.sum(&along);
    let size = p.g.call(Call::Abs, &[along]);
    let squares: Vec<Scalar> = p.velocity.iter().map(|&v| p.g.mul(v, v)).collect();
    let square = p.g.sum(&squares);
    let root = p.g.sqrt(square);
    // All but the first two read no angle from the start, or are told by their values.
    assert_eq!(p.turned(&[along, size]), Some(vec![true, true]));
    assert_eq!(p.turned(&[root, square]), None);
    // Slopes of the speed along the heading are components of the heading itself; their squares add up to one.
    let slopes = p.velocity.map(|v| p.g.derivative(along, &[(v, Scalar::ONE)]));
    let product = p.g.mul(slopes[0], p.number);
    assert_eq!(p.turned(&[product, slopes[0]]), None, "half a vector is none");
}

/// Vectors of the world are turned last, whatever stands between their components and in whatever order they come.
#[test]
fn vectors_are_turned_last() {
    let mut p = plane();
    let (number, velocity) = (p.number, p.velocity);
    let heavy = p.g.call(Call::Exp, &[number]);
    let first = p.in_world([heavy, number]);
    let sum = p.g.add(heavy, number);
    let second = p.in_world([sum, Scalar::ONE]);
    let scaled = velocity.map(|v| p.g.mul(v, heavy));
    let roots = [second[1], first[0], scaled[1], first[1], number, second[0], scaled[0]];
    let found = p.turned(&roots).expect("vectors");
    assert_eq!(found, [true, true, false, true, false, true, false]);
}

/// What knows where the world's axes are stays as it was.
#[test]
fn a_wall_stays() {
    let mut p = plane();
    let (number, velocity) = (p.number, p.velocity);
    let ahead = p.in_world([number, Scalar::ONE]);
    let wall = p.g.call(Call::Max, &[velocity[0], ahead[0]]);
    assert_eq!(p.turned(&[wall]), None);
    let [x, y] = ahead;
    assert_eq!(p.turned(&[wall, x, y]), Some(vec![true; 3]), "the others are a vector");
    let twice = p.g.add(y, y);
    assert_eq!(p.turned(&[x, twice]), None, "no vector has these components");
}
