//! reference arms
use multibody_engine::mechanics::{composite, inertia::Inertia, kinematics, newton_euler as ne, regroup, tree::*};
use multibody_engine::symbolic::{evaluate::*, graph::*, linear_algebra, lower::Lowering};
use serde_json::Value;

fn num(v: &Value) -> f64 { v.as_f64().unwrap() }

struct Arm { g: Graph, tree: Tree, q: Vec<Scalar>, tau: Vec<Scalar> }

fn load(name: &str) -> Arm {
    let text = std::fs::read_to_string(format!("/work/shared/reference/robots/{name}.model.json")).unwrap();
    let v: Value = serde_json::from_str(&text).unwrap();
    let mut g = Graph::new();
    let mut tree = Tree::default();
    let joints = v["joints"].as_array().unwrap();
    let n = joints.len();
    let q: Vec<Scalar> = (0..n).map(|_| g.symbol()).collect();
    tree.velocity = (0..n).map(|_| g.symbol()).collect();
    tree.acceleration = (0..n).map(|_| g.symbol()).collect();
    let tau: Vec<Scalar> = (0..n).map(|_| g.symbol()).collect();
    for (i, j) in joints.iter().enumerate() {
        let mut rows = [[Scalar::ZERO; 3]; 3];
        for a in 0..3 { for b in 0..3 { rows[a][b] = g.decimal(num(&j["placement"]["R"][a][b])); } }
        let p = [0, 1, 2].map(|a| g.decimal(num(&j["placement"]["p"][a])));
        let com = [0, 1, 2].map(|a| g.decimal(num(&j["com"][a])));
        let mass = g.decimal(num(&j["mass"]));
        let t = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|(a, b)| g.decimal(num(&j["inertia_com"][a][b])));
        let inertia = Inertia::from_tensor(&mut g, mass, com, t);
        let ty = j["type"].as_str().unwrap();
        let axis = (ty.as_bytes()[1] - b'X') as usize;
        let parent = j["parent"].as_i64().unwrap();
        tree.links.push(Link {
            name: j["name"].as_str().unwrap().into(),
            parent: usize::try_from(parent).ok(),
            rotation: g.matrix_rotation(rows),
            offset: g.vector(p),
            motion: if ty.starts_with('R') { Motion::Revolute(axis) } else { Motion::Prismatic(axis) },
            freedom: i, q: q[i], inertia, armature: Scalar::ZERO,
        });
    }
    tree.gravity = Some([0, 1, 2].map(|a| g.decimal(num(&v["gravity"][a]))));
    Arm { g, tree, q, tau }
}

fn err(got: &[f64], want: &Value) -> f64 {
    let want: Vec<f64> = flat(want);
    let scale = want.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    got.iter().zip(&want).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / scale
}
fn flat(v: &Value) -> Vec<f64> { match v { Value::Array(a) => a.iter().flat_map(flat).collect(), v => vec![num(v)] } }

#[test]
fn arms() {
    for name in ["double_pendulum", "cart5", "puma560", "panda"] {
        let start = std::time::Instant::now();
        let mut arm = load(name);
        let g = &mut arm.g;
        let tree = regroup::regroup(g, &arm.tree);
        let n = tree.freedoms();
        let gravity = g.vector(tree.gravity.unwrap().map(|s| -s));
        let none = vec![ne::Wrench::ZERO; tree.links.len()];
        let mut id = |g: &mut Graph, acc: &[Scalar]| {
            let m = kinematics::motions(g, &tree, &tree.velocity, acc, gravity);
            let w = ne::transmitted(g, &tree, &m, &none);
            ne::efforts(g, &tree, &w, acc)
        };
        let inverse = id(g, &tree.acceleration.clone());
        let bias = id(g, &vec![Scalar::ZERO; n]);
        let mass = composite::mass_matrix(g, &tree);
        let rhs: Vec<Scalar> = (0..n).map(|i| g.sub(arm.tau[i], bias[i])).collect();
        let order: Vec<usize> = (0..n).rev().collect();
        let fd = linear_algebra::solve_symmetric(g, &mass, &order, &rhs);
        let fd0 = { let rhs: Vec<Scalar> = bias.iter().map(|&b| -b).collect(); linear_algebra::solve_symmetric(g, &mass, &order, &rhs)};
        let flatm: Vec<Scalar> = mass.iter().flatten().copied().collect();
        println!("{name} derived {:?}", start.elapsed());
        for (what, list) in [("id", &inverse), ("bias", &bias), ("mass", &flatm), ("fd", &fd0)] {
            let mut low = Lowering::new(g);
            let roots = low.run(list);
            let before = low.to.cost(&roots);
            let mut symbols = Vec::new();
            let j = |i| multibody_engine::model::types::JointId(i);
            use multibody_engine::optimize::program::Symbol;
            for i in 0..n { symbols.push(Symbol::Position { joint: j(i), component: 0 }); }
            for i in 0..n { symbols.push(Symbol::Velocity { joint: j(i), component: 0 }); }
            for i in 0..n { symbols.push(Symbol::Acceleration { joint: j(i), component: 0 }); }
            for _ in 0..n { symbols.push(Symbol::Time); }
            let mut dag = multibody_engine::optimize::dag::Dag::import(&low.to, &roots, &symbols);
            let c0 = dag.cost().0;
            multibody_engine::optimize::simplify(&mut dag);
            let c1 = dag.cost().0;
            if std::env::var("SHOW").is_ok_and(|w| w == format!("{name}.{what}")) {
                dag.symbol_names = ["q", "v", "a", "tau"].iter().flat_map(|k| (1..=n).map(move |i| format!("{k}{i}"))).collect();
                let names = dag.symbol_names.clone();
                let p = multibody_engine::optimize::schedule::schedule(&dag, &Default::default());
                use multibody_engine::optimize::program::*;
                fn show(p: &Program, e: &Expression, names: &[String], syms: &[Symbol]) -> String {
                    let sh = |e: &Expression| show(p, e, names, syms);
                    match e {
                        Expression::Literal(x) => format!("{x}"),
                        Expression::Symbol(s) => names[syms.iter().position(|t| t == s).unwrap()].clone(),
                        Expression::Field(f) => format!("F{}", f.0),
                        Expression::Local(l) => p.locals[l.0].clone(),
                        Expression::Neg(e) => format!("-{}", sh(e)),
                        Expression::Sum(t) => format!("({})", t.iter().enumerate().map(|(i, (n, e))| format!("{}{}", if *n { " - " } else if i > 0 { " + " } else { "" }, sh(e))).collect::<String>()),
                        Expression::Product(t) => t.iter().map(sh).collect::<Vec<_>>().join("*"),
                        Expression::Quotient(a, b) => format!("{}/{}", sh(a), sh(b)),
                        Expression::Call(c, a) => format!("{c:?}({})", a.iter().map(sh).collect::<Vec<_>>().join(", ")),
                    }
                }
                for st in &p.statements {
                    match st {
                        Statement::Let { local, value } => println!("    {} = {}", p.locals[local.0], show(&p, value, &names, &symbols)),
                        Statement::SinCos { sin, cos, angle } => println!("    {}, {} = sincos {}", p.locals[sin.0], p.locals[cos.0], show(&p, angle, &names, &symbols)),
                    }
                }
                for r in &p.results { println!("    -> {}", show(&p, r, &names, &symbols)); }
            }
            println!("  {what} {}/{} -> {}/{} -> {}/{}/{} sum {} {:?}", before.add, before.mul, c0.add, c0.mul, c1.add, c1.mul, c1.div, c1.add+c1.mul+c1.div, start.elapsed());
        }
        let samples: Value = serde_json::from_str(&std::fs::read_to_string(format!("/work/shared/reference/robots/{name}.samples.json")).unwrap()).unwrap();
        let mut worst = [0.0_f64; 4];
        for s in samples["samples"].as_array().unwrap() {
            let get = |k: &str| flat(&s[k]);
            let all: Vec<f64> = [get("q"), get("v"), get("a"), get("tau")].concat();
            let symbols = |id: SymbolId| all[id.0];
            let mut e = Evaluator::new(g, Real { symbols: &symbols });
            for (k, (list, key)) in [(&inverse, "rnea"), (&bias, "nle"), (&flatm, "M"), (&fd, "aba")].into_iter().enumerate() {
                worst[k] = worst[k].max(err(&e.run(list), &s[key]));
            }
        }
        println!("  errors {worst:?}");
        let _ = &arm.q;
        assert!(worst.iter().all(|&w| w < 1e-12));
    }
}
