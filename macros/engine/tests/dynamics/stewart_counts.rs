//! The Stewart-Gough platform with Tsai's data in struts: forces and accelerations against reference data (see
//! tests/data/stewart), and the operations that they cost.

use std::path::PathBuf;

use multibody_engine::contracts::cost::Cost;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::dynamics::inertia::Inertia;
use multibody_engine::dynamics::tree::{Link, Motion, Tree};
use multibody_engine::mechanics::strut::carrier::{Axes, Carrier};
use multibody_engine::mechanics::strut::detect::{Chain, detect};
use multibody_engine::mechanics::strut::inverse::{forces, ways};
use multibody_engine::mechanics::strut::triple::{self, Triple};
use multibody_engine::mechanics::strut::{self, motion};
use multibody_engine::model::types::{JointId, ParamId};
use multibody_engine::optimize::dag::Dag;
use multibody_engine::optimize::simplify;
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Graph, Rotation, Scalar, SymbolId, Vector};
use multibody_engine::symbolic::inputs::Known;
use multibody_engine::symbolic::lower::Lowering;
use serde_json::Value;

fn read(name: &str) -> Value {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../../tests/data/stewart/{name}.json"));
    serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap()
}

fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(flat).collect(),
        Value::String(text) => vec![text.parse().unwrap()],
        number => vec![number.as_f64().unwrap()],
    }
}

/// Symbols: pose, its rates, its second derivatives, forces, six each; then coordinates of the legs, which no result
/// needs, and parameters.
struct Machine {
    g: Graph,
    table: Vec<Symbol>,
    tree: Tree,
    platform: usize,
    legs: Vec<(Chain, Triple, bool)>,
    force: [Scalar; 6],
    /// Values of the parameters, by number of the symbol.
    values: Vec<f64>,
}

/// What of the geometry are parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Geometry {
    Literal,
    /// Two coordinates of every foot and pin; the third is a literal.
    Planar,
    Spatial,
    /// Literals in general position.
    Scattered,
}

/// Points of the base or of the platform.
fn points(
    g: &mut Graph,
    table: &mut Vec<Symbol>,
    values: &mut Vec<f64>,
    geometry: Geometry,
    data: &Value,
) -> Vec<Triple> {
    let mut seed = 4_711_u64;
    let mut point = |p: &Value| {
        [0, 1, 2].map(|k| {
            let value = p[k].as_f64().unwrap();
            if geometry == Geometry::Scattered {
                seed = (seed * 16_807) % 2_147_483_647;
                return g.decimal(value + (seed % 1000) as f64 * 1e-4);
            }
            if geometry == Geometry::Literal || (geometry == Geometry::Planar && k == 2) {
                return g.decimal(value);
            }
            table.push(Symbol::Param { param: ParamId(0), element: table.len() });
            values.resize(table.len(), 0.0);
            values[table.len() - 1] = value;
            g.symbol()
        })
    };
    data.as_array().unwrap().iter().map(&mut point).collect()
}

impl Machine {
    fn new(level: bool, geometry: Geometry) -> Machine {
        let mut g = Graph::new();
        let mut table = Vec::new();
        let joint = JointId(0);
        let mut six = |g: &mut Graph, symbol: &dyn Fn(usize) -> Symbol| -> Vec<Scalar> {
            (0..6)
                .map(|k| {
                    table.push(symbol(k));
                    g.symbol()
                })
                .collect()
        };
        let mut pose = six(&mut g, &|component| Symbol::Position { joint, component });
        let mut velocity = six(&mut g, &|component| Symbol::Velocity { joint, component });
        let mut acceleration = six(&mut g, &|component| Symbol::Acceleration { joint, component });
        let force = six(&mut g, &|component| Symbol::Multiplier { row: component });
        if level {
            for list in [&mut pose, &mut velocity, &mut acceleration] {
                list[3..].fill(Scalar::ZERO);
            }
        }
        let mut values = Vec::new();
        let data = read("parameters");
        let feet = points(&mut g, &mut table, &mut values, geometry, &data["A"]);
        let pins = points(&mut g, &mut table, &mut values, geometry, &data["B"]);
        let headings: Vec<Scalar> = flat(&data["ang"]).into_iter().map(|x| g.decimal(x)).collect();
        let set = &data["sets"]["tsai"];
        let number = |g: &mut Graph, key: &str| g.decimal(set[key].as_f64().unwrap());
        let [m1, m2, e1, e2, gravity, m] = ["m1", "m2", "e1", "e2", "g", "m_p"].map(|key| number(&mut g, key));
        let zero = Scalar::ZERO;
        let rod = |g: &mut Graph, m: Scalar, e: Scalar, key: &str| {
            let i = g.decimal(set[key][1].as_f64().unwrap());
            Inertia::from_tensor(g, m, [zero, zero, e], [i, i, zero, zero, zero, zero])
        };
        let (cylinder, piston) = (rod(&mut g, m1, e1, "I1"), rod(&mut g, m2, -e2, "I2"));
        let tensor = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
            .map(|(a, b)| g.decimal(set["I_p"][a][b].as_f64().unwrap()));
        let body = Inertia::from_tensor(&mut g, m, [zero; 3], tensor);
        let mut links: Vec<Link> = Vec::new();
        let plain = Link {
            name: String::new(),
            parent: None,
            rotation: Rotation::IDENTITY,
            offset: Vector::ZERO,
            motion: Motion::Prismatic(0),
            freedom: 0,
            q: zero,
            inertia: Inertia::ZERO,
            armature: zero,
        };
        let turns = [Motion::Revolute(2), Motion::Revolute(1), Motion::Revolute(0)];
        let motions = [0, 1, 2].map(Motion::Prismatic).into_iter().chain(turns);
        for (at, (motion, freedom)) in motions.zip([0, 1, 2, 5, 4, 3]).enumerate() {
            let inertia = if at == 5 { body } else { Inertia::ZERO };
            links.push(Link { parent: at.checked_sub(1), motion, freedom, q: pose[freedom], inertia, ..plain.clone() });
        }
        let one = g.integer(1);
        let mut ends = Vec::new();
        for (foot, heading) in feet.iter().zip(headings) {
            let up = g.along(2, one);
            let steps = [
                (Motion::Revolute(0), Inertia::ZERO, g.axis_rotation(2, heading), g.vector(*foot)),
                (Motion::Revolute(1), cylinder, Rotation::IDENTITY, Vector::ZERO),
                (Motion::Prismatic(2), piston, Rotation::IDENTITY, up),
            ];
            let mut parent = None;
            for (motion, inertia, rotation, offset) in steps {
                let freedom = velocity.len();
                let [q, v, a] = [(); 3].map(|()| {
                    table.push(Symbol::Time);
                    g.symbol()
                });
                velocity.push(v);
                acceleration.push(a);
                links.push(Link { parent, rotation, offset, motion, freedom, q, inertia, ..plain.clone() });
                parent = Some(links.len() - 1);
            }
            ends.extend(parent);
        }
        let tree = Tree {
            links,
            velocity,
            acceleration,
            gravity: Some([zero, zero, -gravity]),
            ground: None,
            turns_columns: false,
        };
        let legs = ends.into_iter().zip(&pins).map(|(end, &pin)| {
            let chain = detect(&mut g, &tree, end, triple::ZERO).expect("a strut");
            assert_eq!(chain.zero, one);
            (chain, pin, true)
        });
        let legs = legs.collect();
        let force = force.try_into().unwrap();
        Machine { g, table, tree, platform: 5, legs, force, values }
    }

    fn carrier(&mut self) -> Carrier {
        Carrier::of(&mut self.g, &self.tree, self.platform, &self.legs).expect("a body on struts")
    }
}

/// Second derivatives of the six coordinates, in one of the ways.
fn forward(m: &mut Machine, at: usize) -> (&'static str, Vec<Scalar>) {
    let carrier = m.carrier();
    let g = &mut m.g;
    let (name, way, reference) = strut::forward::ways(&carrier, true)[at];
    let (a, dw) = strut::forward::accelerations(g, &carrier, &m.force, (&reference, way), false);
    let mut found = motion::coordinates(g, &m.tree, m.platform, &a, &dw).expect("coordinates");
    found.sort_by_key(|f| f.0);
    (name, found.into_iter().map(|f| f.1).collect())
}

fn count(m: &Machine, roots: &[Scalar]) -> Cost {
    let mut lowering = Lowering::new(&m.g);
    let roots = lowering.run(roots);
    let mut dag = Dag::import(&lowering.to, &roots, &m.table);
    assert!(simplify(&mut dag));
    dag.cost().0
}

fn flops(c: &Cost) -> u32 {
    c.add + c.mul + c.div + c.sqrt
}

fn evaluate(m: &Machine, roots: &[Scalar], point: &[f64]) -> Vec<f64> {
    let symbols = |id: SymbolId| point.get(id.0).or(m.values.get(id.0)).copied().unwrap_or(f64::NAN);
    Evaluator::new(&m.g, Real { symbols: &symbols }).run(roots)
}

fn check_forces(m: &Machine, roots: &[Scalar], name: &str) -> f64 {
    let data = read(name);
    let list = |key: &str| -> Vec<Vec<f64>> { data[key].as_array().unwrap().iter().map(flat).collect() };
    let (q, qd, qdd, f) = (list("q"), list("qd"), list("qdd"), list("f"));
    let mut worst = 0.0_f64;
    for k in 0..q.len() {
        let point = [&q[k][..], &qd[k], &qdd[k], &[0.0; 6]].concat();
        let got = evaluate(m, roots, &point);
        for i in 0..6 {
            worst = worst.max((got[i] - f[k][i]).abs());
        }
        assert!(!got.iter().any(|x| x.is_nan()));
    }
    worst
}

/// The cheapest of all ways to the forces: flops, error against reference data. `above`: pins are assumed above the
/// base.
fn inverse(geometry: Geometry, above: bool, level: bool) -> (u32, f64) {
    let mut best: Option<(u32, f64)> = None;
    let count_ways = ways(&Machine::new(level, geometry).carrier(), above, true).len();
    for at in 0..count_ways {
        let mut m = Machine::new(level, geometry);
        let carrier = m.carrier();
        let g = &mut m.g;
        let (name, way, reference) = ways(&carrier, above, true)[at];
        let view = carrier.view(g, Axes::World, &reference);
        let heights: Vec<Scalar> = (0..6).map(|leg| view.line(g, leg)[2]).filter(|_| above).collect();
        let nonzero = |g: &Graph, s: Scalar| heights.contains(&s) || g.literal(s).is_some_and(|n| !n.is_zero());
        let known = Known { parameter: &|id| matches!(m.table[id.0], Symbol::Param { .. }), nonzero: &nonzero };
        let found = forces(g, &carrier, way, &reference, &known).expect("six struts");
        let mut roots = found.forces;
        roots.push(found.rank);
        let mut error = 0.0;
        if geometry != Geometry::Scattered {
            let names: &[&str] = if level { &["heave_forces"] } else { &["general_motion_tsai", "yaw_tsai"] };
            error = names.iter().map(|name| check_forces(&m, &roots, name)).fold(0.0, f64::max);
        }
        let cost = flops(&count(&m, &roots));
        println!("{geometry:?} above {above} level {level} {name}: {cost}, {} rows", found.constant);
        best = Some(best.map_or((cost, error), |(c, e)| (c.min(cost), e.max(error))));
    }
    best.unwrap()
}

/// The cheapest of all ways to the accelerations of the coordinates, and their error.
fn forwards(geometry: Geometry) -> (u32, f64) {
    let data = read("forward");
    let mut best: Option<(u32, f64)> = None;
    let count_ways = strut::forward::ways(&Machine::new(false, geometry).carrier(), true).len();
    for at in 0..count_ways {
        let mut m = Machine::new(false, geometry);
        let (name, roots) = forward(&mut m, at);
        let cost = flops(&count(&m, &roots));
        let cases = data["cases"].as_array().unwrap().iter().filter(|case| case["parameter_set"] == "tsai");
        let mut worst = 0.0_f64;
        for case in cases.filter(|_| geometry != Geometry::Scattered) {
            let point = ["pose", "vel", "acc", "f"].map(|key| flat(&case[key])).concat();
            let want = flat(&case["acc"]);
            let size = want.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let got = evaluate(&m, &roots, &point);
            let error = got.iter().zip(&want).map(|(a, b)| (a - b).abs() / (1.0 + size)).fold(0.0, f64::max);
            worst = worst.max(error);
        }
        println!("{geometry:?} forward, {name}: {cost}, error {worst:.1e}");
        best = Some(best.map_or((cost, worst), |(c, e)| (c.min(cost), e.max(worst))));
    }
    best.unwrap()
}

/// Flops that the forces may cost: level, any orientation.
#[test]
fn forces_from_motion() {
    let bounds = [
        (Geometry::Literal, false, [590, 1060]),
        (Geometry::Literal, true, [530, 950]),
        (Geometry::Planar, false, [690, 1340]),
        (Geometry::Spatial, false, [690, 1340]),
        (Geometry::Scattered, false, [690, 1340]),
    ];
    for (geometry, above, bounds) in bounds {
        for (level, bound) in [true, false].into_iter().zip(bounds) {
            let (cost, error) = inverse(geometry, above, level);
            println!("{geometry:?}, above {above}, level {level}: {cost} flops, error {error:.1e} N");
            assert!(cost <= bound && error < 1e-10);
        }
    }
}

#[test]
fn motion_from_forces() {
    let bounds =
        [(Geometry::Literal, 1130), (Geometry::Planar, 1580), (Geometry::Spatial, 1580), (Geometry::Scattered, 1580)];
    for (geometry, bound) in bounds {
        let (cost, error) = forwards(geometry);
        println!("{geometry:?}: {cost} flops, error {error:.1e}");
        assert!(cost <= bound && error < 1e-12);
    }
}
