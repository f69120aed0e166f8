//! Struts against the plain recursion on the same links: the force at the point and the actuator's force, for random
//! rods on universal joints, balls and three hinges; what is no strut; and bodies on struts forwards against
//! backwards.

use crate::formulations;
use crate::rng::Rng;
use multibody_engine::dynamics::inertia::Inertia;
use multibody_engine::dynamics::tree::{Link, Motion, Orientation, Tree};
use multibody_engine::mechanics::strut::carrier::{Axes, Carrier};
use multibody_engine::mechanics::strut::detect::{Chain, detect};
use multibody_engine::mechanics::strut::forward::{self, accelerations};
use multibody_engine::mechanics::strut::inverse::{Arms, Gather, Variant, forces};
use multibody_engine::mechanics::strut::motion::{coordinates, moves};
use multibody_engine::mechanics::strut::triple::{self, Triple, sub};
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Graph, Rotation, Scalar, SymbolId};
use multibody_engine::symbolic::inputs::Known;

const GRAVITY: [f64; 3] = [0.7, -1.9, -9.3];

/// How the centre turns.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Centre {
    Universal,
    Hinges,
    Ball,
}

fn number(g: &mut Graph, rng: &mut Rng, from: f64, to: f64) -> Scalar {
    g.decimal(rng.decimal(from, to))
}

fn point(g: &mut Graph, rng: &mut Rng) -> Triple {
    [0, 1, 2].map(|_| number(g, rng, -1.0, 1.0))
}

struct Bench {
    g: Graph,
    rng: Rng,
    tree: Tree,
    /// By number of the symbol.
    values: Vec<f64>,
}

impl Bench {
    fn new(seed: u64) -> Bench {
        let mut g = Graph::new();
        let gravity = Some(GRAVITY.map(|x| g.decimal(x)));
        Bench { g, rng: Rng::new(seed), tree: Tree { gravity, ..Tree::default() }, values: Vec::new() }
    }

    fn symbol(&mut self, value: f64) -> Scalar {
        self.values.push(value);
        self.g.symbol()
    }

    fn freedom(&mut self) -> usize {
        let (v, a) = (self.rng.real(-1.0, 1.0), self.rng.real(-1.0, 1.0));
        let (v, a) = (self.symbol(v), self.symbol(a));
        self.tree.velocity.push(v);
        self.tree.acceleration.push(a);
        self.tree.velocity.len() - 1
    }

    fn link(&mut self, parent: Option<usize>, motion: Motion, q: Scalar, offset: Triple, inertia: Inertia) -> usize {
        let freedom = self.freedom();
        for _ in 1..motion.freedoms() {
            self.freedom();
        }
        let (rotation, offset) = (Rotation::IDENTITY, self.g.vector(offset));
        let name = String::new();
        let armature = Scalar::ZERO;
        self.tree.links.push(Link { name, parent, rotation, offset, motion, freedom, q, inertia, armature });
        self.tree.links.len() - 1
    }

    fn coordinate(&mut self) -> Scalar {
        let value = self.rng.real(-0.8, 0.8);
        self.symbol(value)
    }

    /// A unit quaternion with a value.
    fn quaternion(&mut self) -> [Scalar; 4] {
        let list = [0; 4].map(|_| self.rng.real(-1.0, 1.0));
        let norm = list.iter().map(|x| x * x).sum::<f64>().sqrt();
        self.values.extend(list.map(|x| x / norm));
        self.g.unit_quaternion()
    }

    /// A rod on an axis, with moments about the link's origin.
    fn rod(&mut self, axis: usize) -> Inertia {
        let mut inertia = Inertia::ZERO;
        let com = number(&mut self.g, &mut self.rng, -0.6, 0.6);
        inertia.mass = number(&mut self.g, &mut self.rng, 0.1, 2.0);
        inertia.first[axis] = self.g.mul(inertia.mass, com);
        let own = number(&mut self.g, &mut self.rng, 0.01, 0.3);
        let steiner = self.g.mul(inertia.first[axis], com);
        inertia.second[axis] = self.g.add(own, steiner);
        inertia
    }

    /// A strut that slides along an axis other than those of its last hinge; its end, and the point there.
    fn strut(&mut self, centre: Centre, slide: usize) -> (usize, Triple) {
        let foot = point(&mut self.g, &mut self.rng);
        let (second, first) = ((slide + 1) % 3, (slide + 2) % 3);
        let hinges: &[usize] = match centre {
            Centre::Universal => &[first, second],
            Centre::Hinges => &[slide, first, second],
            Centre::Ball => &[],
        };
        let cylinder = self.rod(slide);
        let mut parent = None;
        for (at, &axis) in hinges.iter().enumerate() {
            let q = self.coordinate();
            let inertia = if at + 1 == hinges.len() { cylinder } else { Inertia::ZERO };
            let offset = if at == 0 { foot } else { triple::ZERO };
            parent = Some(self.link(parent, Motion::Revolute(axis), q, offset, inertia));
        }
        if centre == Centre::Ball {
            let quaternion = self.quaternion();
            parent =
                Some(self.link(None, Motion::Ball(Orientation::Quaternion(quaternion)), Scalar::ZERO, foot, cylinder));
        }
        let piston = self.rod(slide);
        let q = self.coordinate();
        let mut offset = triple::ZERO;
        offset[slide] = number(&mut self.g, &mut self.rng, -0.5, 0.5);
        let end = self.link(parent, Motion::Prismatic(slide), q, offset, piston);
        let mut reach = triple::ZERO;
        reach[slide] = number(&mut self.g, &mut self.rng, -2.0, 2.0);
        (end, reach)
    }

    fn evaluate(&self, roots: &[Scalar]) -> Vec<f64> {
        let symbols = |id: SymbolId| self.values[id.0];
        Evaluator::new(&self.g, Real { symbols: &symbols }).run(roots)
    }

    /// Position, velocity and acceleration of a point of a link, in world axes.
    fn carried(&mut self, link: usize, at: Triple) -> [Triple; 3] {
        let accelerations = self.tree.acceleration.clone();
        let g = &mut self.g;
        let m = moves(g, &self.tree, link, &accelerations).pop().unwrap();
        let r = g.vector(at);
        let swing = g.cross(m.omega, r);
        let (tangential, centripetal) = (g.cross(m.d_omega, r), g.cross(m.omega, swing));
        let second = g.add_vectors(tangential, centripetal);
        [(m.place, r), (m.velocity, swing), (m.acceleration, second)].map(|(origin, offset)| {
            let turned = g.rotate(m.rotation, offset);
            let sum = g.add_vectors(origin, turned);
            g.components(sum)
        })
    }
}

#[test]
fn the_plain_recursion_agrees() {
    let mut negative = 0;
    for seed in 0..60 {
        let mut b = Bench::new(seed);
        let centre = [Centre::Universal, Centre::Hinges, Centre::Ball][seed as usize % 3];
        let (end, reach) = b.strut(centre, seed as usize / 3 % 3);
        let chain = detect(&mut b.g, &b.tree, end, reach).unwrap_or_else(|| panic!("{centre:?} {seed}"));
        let [place, velocity, acceleration] = b.carried(end, reach);
        let g = &mut b.g;
        let d = sub(g, &place, &chain.centre);
        // On which side of the axis the point is.
        let along = g.add(chain.zero, b.tree.links[end].q);
        let positive = b.evaluate(&[along])[0] > 0.0;
        negative += usize::from(!positive);
        let strut = chain.strut(positive);
        let g = &mut b.g;
        let gravity = b.tree.gravity.unwrap();
        let line = strut.moving(g, d, velocity);
        let transverse = line.transverse(g, &acceleration, &gravity);
        let phi = g.decimal(0.83);
        let pull = triple::scale(g, -phi, &d);
        let fall = sub(g, &acceleration, &gravity);
        let mass = triple::scale(g, chain.mass, &fall);
        let force = triple::total(g, &[transverse, pull, mass]);
        let actuator = line.actuator(g, &strut, &transverse, phi);
        let along = line.actuator_along(g, &strut, &acceleration, &gravity, phi);
        let (v, a) = (b.tree.velocity.clone(), b.tree.acceleration.clone());
        let efforts = formulations::inverse_dynamics(g, &b.tree, &v, &a);
        let roots = [&efforts[..], &force, &velocity, &[actuator, along]].concat();
        let n = efforts.len();
        let got = b.evaluate(&roots);
        // Power of the force at unit rates.
        let slide = b.tree.links[end].freedom;
        for k in 0..n {
            let mut unit = Bench { values: b.values.clone(), ..Bench::new(0) };
            for (j, &v) in b.tree.velocity.iter().enumerate() {
                let at = (0..b.values.len()).find(|&s| b.g.symbol_handle(SymbolId(s)) == Some(v)).unwrap();
                unit.values[at] = f64::from(u8::from(j == k));
            }
            let symbols = |id: SymbolId| unit.values[id.0];
            let rate = Evaluator::new(&b.g, Real { symbols: &symbols }).run(&velocity);
            let power: f64 = (0..3).map(|i| got[n + i] * rate[i]).sum();
            let effort = got[k] - power;
            let want = if k == slide { got[n + 6] * if positive { 1.0 } else { -1.0 } } else { 0.0 };
            assert!((effort - want).abs() < 1e-11 * (1.0 + got[k].abs()), "{centre:?} {seed} {k}: {effort} {want}");
        }
        assert!((got[n + 6] - got[n + 7]).abs() < 1e-12 * (1.0 + got[n + 6].abs()));
    }
    assert!((10..50).contains(&negative));
}

#[test]
fn what_is_no_strut() {
    let spoil: [fn(&mut Bench, usize, &mut Triple); 7] = [
        // Mass beside the line, axial inertia, a point beside the line.
        |b, end, _| b.tree.links[end].inertia.first[0] = Scalar::ONE,
        |b, end, _| b.tree.links[end - 1].inertia.second[0] = Scalar::ONE,
        |_, _, reach| reach[1] = Scalar::ONE,
        // A line that misses the centre, hinges that don't meet, a mass between them.
        |b, end, _| b.tree.links[end].offset = b.g.along(0, Scalar::ONE),
        |b, end, _| b.tree.links[end - 1].offset = b.g.along(0, Scalar::ONE),
        |b, end, _| b.tree.links[end - 2].inertia.mass = Scalar::ONE,
        // Something else on it.
        |b, end, _| {
            let q = b.coordinate();
            b.link(Some(end), Motion::Revolute(0), q, triple::ZERO, Inertia::ZERO);
        },
    ];
    for (at, spoil) in spoil.iter().enumerate() {
        let mut b = Bench::new(5);
        let (end, mut reach) = b.strut(Centre::Universal, 2);
        assert!(detect(&mut b.g, &b.tree, end, reach).is_some());
        spoil(&mut b, end, &mut reach);
        assert_eq!(detect(&mut b.g, &b.tree, end, reach), None, "{at}");
    }
}

/// A body of any inertia on six struts in general position, by quaternion or by three turns.
fn body(b: &mut Bench, turns: Option<[usize; 3]>) -> (usize, Vec<(Chain, Triple, bool)>) {
    let mut body = Inertia { mass: number(&mut b.g, &mut b.rng, 1.0, 3.0), ..Inertia::ZERO };
    body.first = point(&mut b.g, &mut b.rng);
    body.second = [4.0, 5.0, 6.0, 0.3, -0.4, 0.5].map(|x| b.g.decimal(x));
    let mut parent = None;
    for axis in 0..3 {
        let q = b.coordinate();
        parent = Some(b.link(parent, Motion::Prismatic(axis), q, triple::ZERO, Inertia::ZERO));
    }
    match turns {
        Some(axes) => {
            for axis in axes {
                let q = b.coordinate();
                parent = Some(b.link(parent, Motion::Revolute(axis), q, triple::ZERO, Inertia::ZERO));
            }
        }
        None => {
            let quaternion = b.quaternion();
            parent = Some(b.link(
                parent,
                Motion::Ball(Orientation::Quaternion(quaternion)),
                Scalar::ZERO,
                triple::ZERO,
                Inertia::ZERO,
            ));
        }
    }
    let platform = parent.unwrap();
    b.tree.links[platform].inertia = body;
    let legs = (0..6).map(|leg| {
        let (end, reach) = b.strut([Centre::Universal, Centre::Ball][leg % 2], leg % 3);
        let chain = detect(&mut b.g, &b.tree, end, reach).unwrap();
        (chain, point(&mut b.g, &mut b.rng), leg != 3)
    });
    (platform, legs.collect())
}

#[test]
fn forwards_is_backwards() {
    for (seed, turns) in [None, Some([2, 1, 0]), Some([0, 1, 2]), Some([2, 0, 2])].into_iter().enumerate() {
        let mut b = Bench::new(100 + seed as u64);
        let (platform, legs) = body(&mut b, turns);
        let mut carrier = Carrier::of(&mut b.g, &b.tree, platform, &legs).unwrap();
        carrier.load = (point(&mut b.g, &mut b.rng), point(&mut b.g, &mut b.rng));
        let known = Known { parameter: &|_| false, nonzero: &|g, s| g.literal(s).is_some_and(|n| !n.is_zero()) };
        let mut first: Option<Vec<f64>> = None;
        let ways = [Axes::Body, Axes::World].into_iter().flat_map(|axes| {
            let arms = [Arms::Pins, Arms::Pin, Arms::Feet].into_iter();
            arms.flat_map(move |arms| {
                [Gather::Forces, Gather::Moments].map(|gather| Variant { axes, arms, gather, apart: false })
            })
        });
        let references = [carrier.plane(), legs[0].1, point(&mut b.g, &mut b.rng)];
        for (way, reference) in ways.flat_map(|way| references.map(|reference| (way, reference))) {
            b.g.forget();
            let found = forces(&mut b.g, &carrier, way, &reference, &known).unwrap();
            let got = b.evaluate(&found.forces);
            assert_eq!(b.evaluate(&[found.rank]), [6.0]);
            let first = first.get_or_insert_with(|| got.clone());
            let size = first.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
            assert!(first.iter().zip(&got).all(|(x, y)| (x - y).abs() < 1e-10 * size), "{way:?} {first:?} {got:?}");
            let gathers = [forward::Gather::Sums, forward::Gather::Lines].into_iter();
            let ways =
                gathers.flat_map(|gather| [false, true].map(|pairs| forward::Variant { gather, pairs, apart: false }));
            for way in ways {
                b.g.forget();
                let (a, dw) = accelerations(&mut b.g, &carrier, &found.forces, (&reference, way), false);
                let back = coordinates(&mut b.g, &b.tree, platform, &a, &dw).unwrap();
                let got = b.evaluate(&back.iter().map(|f| f.1).collect::<Vec<_>>());
                let want: Vec<Scalar> = back.iter().map(|f| b.tree.acceleration[f.0]).collect();
                let want = b.evaluate(&want);
                assert!(got.iter().zip(&want).all(|(x, y)| (x - y).abs() < 1e-9), "{seed} {way:?} {got:?} {want:?}");
            }
        }
    }
}
