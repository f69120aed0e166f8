//! Closings against what they mean: a joint that closes a loop where the same joint stands in the tree already is closed
//! at all times, its equations leave free what the joint leaves free and nothing else, and multipliers act as the
//! transposed Jacobian.

use multibody_engine::contracts::results::Results;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::equations::Equations;
use multibody_engine::mechanics::loops::constraints::{ClosedIn, Held, Writing, closings, row_count, row_name};
use multibody_engine::mechanics::scene::Style;
use multibody_engine::model::types::{BodyId, BodyRef, Coordinate, JointId, LoopClosure, Model};
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Scalar, SymbolId};

use super::support::{Random, close, model_of};

/// Every kind with what it needs besides its frames.
const KINDS: [(&str, &str, usize); 21] = [
    ("Ball", "", 3),
    ("Universal", ", axes: [X, Y]", 4),
    ("Universal", ", axes: [[0.6, 0.8, 0.0], Z]", 4),
    ("Revolute", ", axis: Z", 5),
    ("Revolute", ", axis: -Y", 5),
    ("Revolute", ", axis: [0.48, 0.64, 0.6]", 5),
    ("Prismatic", ", axis: X", 5),
    ("Prismatic", ", axis: [0.0, 0.6, -0.8]", 5),
    ("Cylindrical", ", axis: Y", 4),
    ("Screw", ", axis: Z, pitch: 0.3", 5),
    ("Screw", ", axis: -Z, pitch: 0.3", 5),
    ("Screw", ", axis: Z, pitch: 0.0", 5),
    ("Planar", ", axis: X", 3),
    ("Planar", ", axes: [X, Z]", 3),
    ("Planar", ", axes: [-Z, Y]", 3),
    ("Planar", ", axes: [[1.0, 1.0, 1.0], [1.0, -1.0, 0.0]]", 3),
    ("PinSlot", ", axis: Z, slide: X", 4),
    ("PinSlot", ", axis: -Y, slide: [3.0, 0.0, -4.0]", 4),
    ("PinSlot", ", axis: [1.0, 1.0, 1.0], slide: [1.0, -1.0, 0.0]", 4),
    ("Fixed", "", 6),
    ("Free", "", 0),
];

/// The model's last joint becomes one that closes a loop, from its parent to `child`; its own child goes.
fn cut_last(mut model: Model, child: &str) -> Model {
    let body = model.bodies.iter().position(|body| body.place.field == child).expect("a body");
    let last = JointId(model.joints.len() - 1);
    model.joints[last].child.body = BodyRef::Body(BodyId(body));
    model.tree.retain(|&id| id != last);
    model.cuts.push(last);
    model.bodies.pop();
    model
}

fn body(name: &str) -> String {
    format!("body {name} {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }}")
}

const PARENT: &str = "a.at([0.1, -0.2, 0.3]).rotated([1.0, 2.0, 2.0], 0.4)";
const CHILD: &str = "at([0.3, 0.1, -0.4]).rotated([2.0, -1.0, 2.0], 0.7)";

#[test]
fn a_joint_beside_itself_is_closed() {
    for (kind, rest, rows) in KINDS {
        let joint = |name: &str, child: &str| {
            format!("joint {name}: {kind} {{ parent: {PARENT}, child: {child}.{CHILD}{rest} }}")
        };
        let text = format!(
            "{} {} {} joint base: Free {{ parent: ground, child: a, coordinates: RollPitchYaw }} {} {}",
            body("a"),
            body("b"),
            body("probe"),
            joint("tree", "b"),
            joint("closing", "probe")
        );
        let model = cut_last(model_of(&text), "b");
        let closing = closings(&model)[0];
        assert_eq!(row_count(&model, closing), rows, "{kind}");
        for writing in Writing::ALL {
            let mut e = Equations::plain(&model);
            let residuals = e.residuals(closing, writing);
            assert_eq!(residuals, vec![Scalar::ZERO; rows], "{kind} {rest} {writing:?}");
            let aligned = e.alignments(closing);
            assert!(aligned.iter().all(|&s| s == Scalar::ONE), "{kind} {rest}");
        }
    }
}

struct Values(std::collections::HashMap<Symbol, f64>);

impl Values {
    fn of(&self, e: &Equations<'_>, list: &[Scalar]) -> Vec<f64> {
        let symbols = |id: SymbolId| self.0[&e.scene.symbols.table[id.0]];
        Evaluator::new(&e.g, Real { symbols: &symbols }).run(list)
    }
}

/// Two bodies that float freely, a as Ball on a slide, b as Free.
fn loose(kind: &str, rest: &str, offset: &str) -> Model {
    let text = format!(
        "{} {} {} {}
        joint rail: Prismatic {{ parent: ground.rotated(X, 0.3), child: mid, axis: Y }}
        joint arm: Universal {{ parent: mid.at(0.2 * X).rotated(Y, -0.8), child: a, axes: [Z, X] }}
        joint free: Free {{ parent: ground, child: b }}
        joint closing: {kind} {{ parent: {PARENT}, child: probe.{CHILD}{offset}{rest} }}",
        body("mid"),
        body("a"),
        body("b"),
        body("probe"),
    );
    cut_last(model_of(&text), "b")
}

/// Random numbers for everything; the second body is put where the joint is closed if `closed`.
fn draw(e: &Equations<'_>, seed: u64) -> Values {
    let mut random = Random(seed);
    let mut values: std::collections::HashMap<Symbol, f64> =
        e.scene.symbols.table.iter().map(|&symbol| (symbol, random.next())).collect();
    // `free` is joint 2, its quaternion starts at component 3.
    let key = |k: usize| Symbol::Position { joint: JointId(2), component: 3 + k };
    let norm = (0..4).map(|k| values[&key(k)].powi(2)).sum::<f64>().sqrt();
    (0..4).for_each(|k| *values.get_mut(&key(k)).expect("known") /= norm);
    Values(values)
}

/// Newton's method on the six coordinates of `free`, least squares by normal equations.
fn close_loop(e: &mut Equations<'_>, residuals: &[Scalar], values: &mut Values) {
    let columns: Vec<Vec<Scalar>> =
        (0..6).map(|index| e.partial(residuals, Coordinate { joint: JointId(2), index })).collect();
    for _ in 0..60 {
        let r = values.of(e, residuals);
        if r.iter().all(|x| x.abs() < 1e-14) {
            break;
        }
        let g: Vec<Vec<f64>> = columns.iter().map(|column| values.of(e, column)).collect();
        let mut a = vec![vec![0.0; 7]; 6];
        for i in 0..6 {
            for j in 0..6 {
                a[i][j] = g[i].iter().zip(&g[j]).map(|(x, y)| x * y).sum::<f64>();
            }
            a[i][i] += 1e-9;
            a[i][6] = -g[i].iter().zip(&r).map(|(x, y)| x * y).sum::<f64>();
        }
        for k in 0..6 {
            let pivot = a[k].clone();
            for (i, row) in a.iter_mut().enumerate() {
                let factor = row[k] / pivot[k];
                if i != k {
                    row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= factor * p);
                }
            }
        }
        let step: Vec<f64> = (0..6).map(|k| (a[k][6] / a[k][k]).clamp(-0.5, 0.5)).collect();
        let at = |component: usize| Symbol::Position { joint: JointId(2), component };
        (0..3).for_each(|k| *values.0.get_mut(&at(k)).expect("known") += step[k]);
        let q: Vec<f64> = (3..7).map(|k| values.0[&at(k)]).collect();
        let turn = [1.0, 0.5 * step[3], 0.5 * step[4], 0.5 * step[5]];
        let turned = super::support::multiply_quaternions(&q, &turn);
        let norm = turned.iter().map(|x| x * x).sum::<f64>().sqrt();
        for (k, component) in turned.iter().enumerate() {
            values.0.insert(at(3 + k), component / norm);
        }
    }
}

/// G^T lambda from the residuals' derivatives by every coordinate.
fn transposed(e: &mut Equations<'_>, residuals: &[Scalar], multipliers: &[Scalar]) -> Vec<Scalar> {
    let mut efforts = Vec::new();
    for joint in 0..e.scene.symbols.velocities.len() {
        for index in 0..e.scene.symbols.velocities[joint].len() {
            let slopes = e.partial(residuals, Coordinate { joint: JointId(joint), index });
            let products: Vec<Scalar> = slopes.iter().zip(multipliers).map(|(&s, &m)| e.g.mul(s, m)).collect();
            efforts.push(-e.g.sum(&products));
        }
    }
    efforts
}

#[test]
fn multipliers_act_as_the_transposed_jacobian() {
    for (kind, rest, rows) in KINDS {
        let model = loose(kind, rest, "");
        let closing = closings(&model)[0];
        for (seed, writing) in Writing::ALL.into_iter().enumerate() {
            let mut e = Equations::plain(&model);
            let residuals = e.residuals(closing, writing);
            let mut values = draw(&e, seed as u64);
            close_loop(&mut e, &residuals, &mut values);
            close(kind, &values.of(&e, &residuals), &vec![0.0; rows], 1e-12);
            let lambda: Vec<Scalar> = (0..rows).map(|k| e.g.decimal(0.3 + 0.7 * k as f64)).collect();
            let wanted = transposed(&mut e, &residuals, &lambda);
            let held = Held { closing, multipliers: lambda, writing, open: false };
            let efforts = e.constraint_efforts(&[held]);
            // On the branch with the axes the other way round a screw turns the other way.
            let aligned = e.alignments(closing);
            let aligned = values.of(&e, &aligned).iter().all(|&c| c > 0.0);
            if aligned || kind != "Screw" {
                let what = format!("{kind} {rest} {writing:?}");
                close(&what, &values.of(&e, &efforts), &values.of(&e, &wanted), 1e-11);
            }
        }
    }
}

/// As derivatives take them: far from any closed position, in all axes.
#[test]
fn multipliers_may_act_exactly_where_loops_are_open() {
    for (kind, rest, rows) in KINDS {
        let model = loose(kind, rest, "");
        let closing = closings(&model)[0];
        for (seed, writing) in Writing::ALL.into_iter().enumerate() {
            let mut e = Equations::plain(&model);
            let residuals = e.residuals(closing, writing);
            let values = draw(&e, 200 + seed as u64);
            let lambda: Vec<Scalar> = (0..rows).map(|k| e.g.decimal(0.3 + 0.7 * k as f64)).collect();
            let wanted = transposed(&mut e, &residuals, &lambda);
            let efforts = e.constraint_efforts(&[Held { closing, multipliers: lambda, writing, open: true }]);
            let what = format!("{kind} {rest} {writing:?}");
            close(&what, &values.of(&e, &efforts), &values.of(&e, &wanted), 1e-11);
        }
    }
}

#[test]
fn rods_and_expressions_are_exact() {
    let text = format!(
        "{} {} {}
        joint rail: Prismatic {{ parent: ground.rotated(X, 0.3), child: mid, axis: Y }}
        joint arm: Universal {{ parent: mid.at(0.2 * X).rotated(Y, -0.8), child: a, axes: [Z, X] }}
        joint free: Free {{ parent: ground, child: b }}
        output reach = dot(a.at(X).position - b.at(Y).position, b.position) + rail.travel * t;
        force spring: Spring {{ between: [a.at(0.3 * X), b.at(0.7 * Z)], stiffness: 1.0, length: 0.4 }}",
        body("mid"),
        body("a"),
        body("b"),
    );
    let mut model = model_of(&text);
    let place = model.outputs[0].place.clone();
    let span = proc_macro2::Span::call_site();
    let docs = multibody_engine::model::types::Docs::default;
    use multibody_engine::model::types::{Constraint, ConstraintId, ConstraintKind, ForceId, ForceKind};
    let kind = ConstraintKind::Value(model.outputs[0].value.clone());
    model.constraints.push(Constraint { place: place.clone(), kind, drive: None, docs: docs(), span });
    let ForceKind::LineSpring { between, length: Some(length), .. } = &model.forces[ForceId(0)].kind else {
        panic!("a spring")
    };
    let kind = ConstraintKind::Rod { between: between.clone(), length: length.clone() };
    model.constraints.push(Constraint { place, kind, drive: None, docs: docs(), span });
    for (seed, writing) in Writing::ALL.into_iter().enumerate() {
        let mut e = Equations::plain(&model);
        let values = draw(&e, 100 + seed as u64);
        for k in 0..2 {
            let closing = LoopClosure::Constraint(ConstraintId(k));
            assert_eq!(row_name(&model, closing, 0), "reach");
            let residuals = e.residuals(closing, writing);
            let lambda = vec![e.g.decimal(0.7)];
            let wanted = transposed(&mut e, &residuals, &lambda);
            let efforts = e.constraint_efforts(&[Held { closing, multipliers: lambda, writing, open: false }]);
            close("efforts", &values.of(&e, &efforts), &values.of(&e, &wanted), 1e-12);
            // r' = G v + dr/dt
            let rates = e.residual_rates(closing, writing);
            let rate = values.of(&e, &rates)[0];
            let velocities: Vec<Scalar> = e.scene.symbols.velocities.concat();
            let v = values.of(&e, &velocities);
            let power: f64 = values.of(&e, &wanted).iter().zip(&v).map(|(f, v)| -f * v / 0.7).sum();
            let rail = Symbol::Position { joint: JointId(0), component: 0 };
            let by_time = if k == 0 { values.0[&rail] } else { 0.0 };
            close("rate", &[rate], &[power + by_time], 1e-12);
        }
    }
}

#[test]
fn writings_say_the_same() {
    for (kind, rest, rows) in KINDS {
        let model = loose(kind, rest, "");
        let closing = closings(&model)[0];
        let mut e = Equations::plain(&model);
        let values = draw(&e, 7);
        let mut squares = Vec::new();
        for writing in Writing::ALL {
            let mut one = Equations::plain(&model);
            let residuals = one.residuals(closing, writing);
            let r = values.of(&one, &residuals);
            assert_eq!(r.len(), rows);
            // The way's components depend on the axes, its length does not; nor does any other row.
            let gap = if rows > 0 && !matches!(kind, "Prismatic" | "Cylindrical" | "Screw" | "Planar" | "PinSlot") {
                3
            } else {
                0
            };
            let mut list = vec![r[..gap].iter().map(|x| x * x).sum::<f64>()];
            list.extend(&r[gap..]);
            squares.push(list);
        }
        for list in &squares {
            close(kind, list, &squares[0], 1e-12);
        }
        let mut names: Vec<String> = (0..rows).map(|k| row_name(&model, closing, k)).collect();
        names.dedup();
        assert_eq!(names.len(), rows, "{names:?}");
        let _ = e.alignments(closing);
    }
}

#[test]
fn planar_loops_have_absolute_angles() {
    // A four-bar: both sides in the axes of the ground, three angles, and rows out of the plane that vanish.
    let text = format!(
        "{} {} {} {}
        joint crank: Revolute {{ parent: ground, child: one, axis: Z }}
        joint elbow: Revolute {{ parent: one.at(X), child: two, axis: Z }}
        joint rocker: Revolute {{ parent: ground.at(3.0 * X), child: three, axis: Z }}
        joint pin: Revolute {{ parent: two.at(2.0 * X), child: probe.at(1.5 * X), axis: Z }}",
        body("one"),
        body("two"),
        body("three"),
        body("probe"),
    );
    let model = cut_last(model_of(&text), "three");
    let closing = closings(&model)[0];
    for axes in [ClosedIn::World, ClosedIn::Common] {
        for style in [Style::Nested, Style::World] {
            let mut e = Equations::plain(&model);
            let r = e.residuals(closing, Writing { axes, style });
            assert_eq!(&r[2..], &[Scalar::ZERO; 3], "{axes:?} {style:?}");
            let [a, b, c] = [0, 1, 2].map(|k| e.scene.symbols.positions[k][0]);
            let sum = e.g.add(a, b);
            let cosines = [a, sum, c].map(|angle| e.g.cos(angle));
            let two = e.g.integer(2);
            let wanted = [
                e.g.decimal(3.0),
                {
                    let l = e.g.decimal(1.5);
                    e.g.mul(l, cosines[2])
                },
                -cosines[0],
                -e.g.mul(two, cosines[1]),
            ];
            assert_eq!(r[0], e.g.sum(&wanted), "{axes:?} {style:?}");
        }
    }
}

#[test]
fn second_derivatives_follow_the_motion() {
    let model = loose("Universal", ", axes: [X, Y]", "");
    let closing = closings(&model)[0];
    let mut e = Equations::plain(&model);
    let residuals = e.residuals(closing, Writing::PLAIN);
    let [first, second] = e.time_derivatives(&residuals);
    let mut values = draw(&e, 3);
    // The rates along a motion with constant accelerations, which for this are those of all coordinates.
    let at = |values: &Values, e: &Equations<'_>, h: f64| {
        let mut moved = values.0.clone();
        for joint in 0..3 {
            let straight = e.scene.symbols.positions[joint].len() - if joint == 2 { 4 } else { 0 };
            let v = |k: usize| values.0[&Symbol::Velocity { joint: JointId(joint), component: k }];
            let a = |k: usize| values.0[&Symbol::Acceleration { joint: JointId(joint), component: k }];
            for component in 0..straight {
                let q = Symbol::Position { joint: JointId(joint), component };
                *moved.get_mut(&q).expect("known") += h * v(component) + 0.5 * h * h * a(component);
            }
            for component in 0..e.scene.symbols.velocities[joint].len() {
                let key = Symbol::Velocity { joint: JointId(joint), component };
                *moved.get_mut(&key).expect("known") += h * a(component);
            }
        }
        Values(moved).of(e, &first)
    };
    // The ball of `free` turns about a fixed axis, with no angular velocity here.
    for component in 3..6 {
        values.0.insert(Symbol::Velocity { joint: JointId(2), component }, 0.0);
        values.0.insert(Symbol::Acceleration { joint: JointId(2), component }, 0.0);
    }
    let h = 1e-3;
    let [a, b, c, d] = [-2.0 * h, -h, h, 2.0 * h].map(|h| at(&values, &e, h));
    let slope: Vec<f64> = (0..a.len()).map(|k| (a[k] - 8.0 * b[k] + 8.0 * c[k] - d[k]) / (12.0 * h)).collect();
    close("second derivative", &values.of(&e, &second), &slope, 1e-9);
}

/// What a strut with a universal joint at its foot costs, given where its pin is: the published counts, reached with literals and
/// with parameters.
#[test]
fn a_leg_costs_what_it_should() {
    use multibody_engine::contracts::function::FunctionKind;
    use multibody_engine::mechanics::{Derivation, Derived};
    for (foot, heading) in [("[-2.12, 1.374, 0.0]", "-0.75"), ("foot", "heading")] {
        let text = format!(
            "param foot = [-2.12, 1.374, 0.0]; param heading = -0.75; {}
            joint free: Free {{ parent: ground, child: pin }}
            joint gimbal: Universal {{ parent: ground.at({foot}).rotated(Z, {heading}), child: cylinder, axes: [X, Y] }}
            joint stroke: Prismatic {{ parent: cylinder.at(1.0 * Z), child: piston, axis: Z }}
            #[cut] joint ball: Ball {{ parent: piston, child: pin }}",
            ["pin", "cylinder", "piston"].map(body).join(" "),
        );
        let model = model_of(&text);
        let closing = closings(&model)[0];
        for (axes, most) in [(ClosedIn::Parent, [11, 12, 2]), (ClosedIn::ParentBase, [9, 8, 2])] {
            let mut e = Equations::plain(&model);
            let residuals = e.residuals(closing, Writing { axes, style: Style::Nested });
            let symbol_names = (0..e.scene.symbols.table.len()).map(|k| format!("s{k}")).collect();
            let derivation = Derivation {
                symbols: e.scene.symbols.table.clone(),
                graph: e.g,
                symbol_names,
                functions: vec![Derived {
                    kind: FunctionKind::Constraints,
                    candidates: vec![("one", Results::vector(residuals))],
                }],
                at: Vec::new(),
                notes: Vec::new(),
                dead_centres: Vec::new(),
                modes: None,
                pivoted: Vec::new(),
                page: None,
                checks: Vec::new(),
                inertia: Default::default(),
                witnesses: Vec::new(),
                limbs: None,
                turns: Vec::new(),
            };
            let compiled = multibody_engine::optimize::compile(&derivation).expect("compiled");
            let cost = compiled.functions[0].after;
            let cost = [cost.add, cost.mul, cost.sincos];
            assert!(cost.iter().zip(most).all(|(&have, most)| have <= most), "{axes:?}: {cost:?}");
        }
    }
}
