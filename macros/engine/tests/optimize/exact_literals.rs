//! Chains with axes and frames that lie along nothing, from text to compiled programs: what is exactly zero is not there,
//! and the functions of a model agree with each other.

use crate::interpreter;
use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt::Write;

use crate::rng::Rng;
use multibody_engine::contracts::call::Call;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::optimize::program::Compiled;
use multibody_engine::symbolic::graph::{Graph, Scalar};
use multibody_engine::{model, syntax};

/// Below it nothing that a chain of these sizes holds is a number that anybody meant.
const DUST: f64 = 1e-13;

fn compiled(body: &str) -> Compiled {
    let text = format!("pub mod m {{ {body} }}");
    let mut diagnostics = Diagnostics::default();
    let source = syntax::parse(text.parse().expect("tokens"), &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    let messages: Vec<&str> = diagnostics.errors().iter().map(|error| error.message.as_str()).collect();
    assert!(messages.is_empty(), "{messages:?} in {text}");
    match multibody_engine::compile(models.last().expect("a model")) {
        Ok((_, compiled)) => compiled,
        Err(_) => panic!("refused: {text}"),
    }
}

/// Values of symbols: those set, and random ones that stay what they are.
struct Point {
    set: RefCell<HashMap<Symbol, f64>>,
    rng: RefCell<Rng>,
}

impl Point {
    fn new(seed: u64) -> Point {
        Point { set: RefCell::default(), rng: RefCell::new(Rng::new(seed)) }
    }

    fn value(&self, symbol: Symbol) -> f64 {
        *self.set.borrow_mut().entry(symbol).or_insert_with(|| self.rng.borrow_mut().real(-1.5, 1.5))
    }

    fn run(&self, compiled: &Compiled, kind: FunctionKind) -> Vec<f64> {
        let symbols = |symbol| self.value(symbol);
        let fields = interpreter::run(&compiled.prelude, &symbols, &|_| f64::NAN);
        let function = compiled.functions.iter().find(|f| f.kind == kind).expect("emitted");
        interpreter::run(&function.program, &symbols, &|field| fields[field.0])
    }
}

/// Mass matrix and kinetic energy, inverse of forward dynamics; literals that are dust.
fn judge(text: &str, joints: usize, seed: u64) -> usize {
    let compiled = compiled(text);
    assert!(compiled.sound, "{text}");
    let dust = |x: f64| x != 0.0 && (x.abs() < DUST || x.abs() > 1.0 / DUST);
    let found = compiled.functions.iter().flat_map(|f| f.program.literals()).filter(|&x| dust(x)).count();
    let point = Point::new(seed);
    let velocity: Vec<f64> =
        (0..joints).map(|k| point.value(Symbol::Velocity { joint: model::types::JointId(k), component: 0 })).collect();
    let mass = point.run(&compiled, FunctionKind::MassMatrix);
    let kinetic = point.run(&compiled, FunctionKind::KineticEnergy)[0];
    let twice: f64 =
        (0..joints).map(|i| (0..joints).map(|j| velocity[i] * mass[i * joints + j] * velocity[j]).sum::<f64>()).sum();
    assert!((0.5 * twice - kinetic).abs() <= 1e-12 * kinetic.abs(), "{} is not {kinetic}\n{text}", 0.5 * twice);
    let accelerations = point.run(&compiled, FunctionKind::ForwardDynamics);
    for (k, &a) in accelerations[..joints].iter().enumerate() {
        point.set.borrow_mut().insert(Symbol::Acceleration { joint: model::types::JointId(k), component: 0 }, a);
    }
    let efforts = point.run(&compiled, FunctionKind::InverseDynamics);
    let size = point.run(&compiled, FunctionKind::Bias).iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    let left = efforts.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(left <= 1e-10 * size, "{left:e} is left of {size}\n{text}");
    found
}

/// A number as people write it.
fn number(rng: &mut Rng) -> String {
    format!("{}", (rng.real(-1.0, 1.0) * 100.0).round() / 100.0)
}

fn axis(rng: &mut Rng) -> String {
    const PLAIN: [&str; 8] = [
        "X",
        "Y",
        "Z",
        "[1, 0, 1]",
        "[1, 1, 1]",
        "[0, 1, 1]",
        "[0.5773502691896258, 0.5773502691896258, 0.5773502691896258]",
        "[0.8660254037844386, 0.5, 0.0]",
    ];
    match rng.below(4) {
        0 | 1 => PLAIN[rng.below(PLAIN.len())].to_owned(),
        2 => format!("[{}, {}, {}]", 1 + rng.below(4), rng.below(4), rng.below(3)),
        _ => format!("[{}, {}, 0.31]", number(rng), number(rng)),
    }
}

fn angle(rng: &mut Rng) -> String {
    const PLAIN: [&str; 8] =
        ["deg(30)", "deg(60)", "deg(45)", "PI / 7", "deg(0.25)", "deg(-120)", "0.3", "deg(18) + 0.1"];
    match rng.below(3) {
        0 => format!("deg({})", number(rng)),
        _ => PLAIN[rng.below(PLAIN.len())].to_owned(),
    }
}

/// A matrix with sixteen digits: the product of turns about two axes.
fn matrix(rng: &mut Rng) -> String {
    let mut rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..1 + rng.below(2) {
        let axis = rng.below(3);
        let angle = match rng.below(3) {
            0 => rng.real(-3.0, 3.0),
            1 => f64::to_radians(30.0 * rng.below(12) as f64),
            _ => rng.decimal(-3.0, 3.0),
        };
        let (s, c) = angle.sin_cos();
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        for row in &mut rows {
            (row[j], row[k]) = (c * row[j] + s * row[k], c * row[k] - s * row[j]);
        }
    }
    // What is typed for a zero is a zero.
    let entry = |x: &f64| if x.abs() < 1e-15 { "0.0".to_owned() } else { format!("{x:?}") };
    let rows = rows.map(|row| format!("[{}]", row.iter().map(entry).collect::<Vec<String>>().join(", ")));
    format!("[{}]", rows.join(", "))
}

fn frame(rng: &mut Rng) -> String {
    let mut text = String::new();
    if rng.chance(60) {
        let _ = write!(text, ".at([{}, {}, {}])", number(rng), number(rng), number(rng));
    }
    match rng.below(6) {
        0..3 => {
            let _ = write!(text, ".rotated({}, {})", axis(rng), angle(rng));
        }
        3 => {
            let _ = write!(text, ".oriented({})", matrix(rng));
        }
        _ => {}
    }
    text
}

fn chain(rng: &mut Rng, joints: usize) -> String {
    let mut text = "world { gravity: -9.81 * Z }\n".to_owned();
    for k in 0..joints {
        let parent = if k == 0 { "ground".to_owned() } else { format!("b{}", k - 1) };
        let (com, place, axis) = (number(rng), frame(rng), axis(rng));
        let kind = if rng.chance(80) { "Revolute" } else { "Prismatic" };
        let _ = writeln!(text, "body b{k} {{ mass: 1.0, com: [{com}, 0.2, 0.0], inertia: diag(0.1, 0.12, 0.15) }}");
        let _ = writeln!(text, "joint j{k}: {kind} {{ parent: {parent}{place}, child: b{k}, axis: {axis} }}");
    }
    text + "emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;"
}

/// Three hinges, one behind a turn of 60 degrees about the diagonal of a cube.
#[test]
fn turned_about_a_diagonal() {
    let text = "
        world { gravity: -9.81 * Z }
        body b0 { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        body b1 { mass: 1.0, com: X, inertia: diag(0.1, 0.1, 0.1) }
        body b2 { mass: 1.0, com: X, inertia: diag(0.1, 0.1, 0.1) }
        joint j0: Revolute { parent: ground, child: b0, axis: X }
        joint j1: Revolute { parent: b0.at(X).rotated([1, 1, 1], deg(60)), child: b1, axis: [1, 0, 1] }
        joint j2: Revolute { parent: b1.at(Y).rotated(X, deg(60)), child: b2, axis: [1, 0, 1] }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;";
    assert_eq!(judge(text, 3, 1), 0);
}

#[test]
fn a_hinge_about_any_axis_has_derivatives() {
    compiled(
        "world { gravity: -9.81 * Z }
        body b0 { mass: 1.0, com: 0.1*X+0.05*Y, inertia: diag(0.1,0.1,0.1) }
        joint j0: Revolute { parent: ground, child: b0, axis: X }
        body b1 { mass: 1.0, com: 0.1*X+0.05*Y, inertia: diag(0.1,0.1,0.1) }
        joint j1: Revolute { parent: b0.at(0*X), child: b1, axis: [1.0,0.5,0.2] } emit derivatives;",
    );
}

/// Four-bars in oblique planes, closed to a frame of sixteen digits: its axis is the others', and they have a closed form.
#[test]
fn typed_frames_keep_a_plane() {
    for (from, to, [a, b, c]) in [
        (
            "ground.at([-0.19, sqrt(2) / 2, 0]).rotated(X + Y, deg(60))",
            "ground.at([0.7449588134572304, 2.369299753722191, 0.8906763066320611])
            .oriented([[-0.4835009379699021, -0.6254812890744414, 0.6123724356957945],
            [0.2102844684776120, -0.7620895238205865, -0.6123724356957945],
            [0.8497101183929215, -0.1673102348951994, 0.5000000000000001]])",
            [0.807, 0.921, 1.038],
        ),
        (
            "ground.at([0, -0.5, 2 / 3])
            .oriented([[0.8944271909999159, -0.4472135954999579, 0], [0.4472135954999579, 0.8944271909999159, 0], [0, 0, 1]])
            .rotated([1, 2, 3] / norm([1, 2, 3]), -1.305720)",
            "ground.at([1.8746613329278576, 1.1176742872919085, 1.3580388835109347]).oriented([[0.5009120492087283, -0.6453346276461307, -0.5767411354484285],
            [0.8651882199529257, 0.3555246024609412, 0.3536263580386476],
            [-0.0231616711875536, -0.6761253400116136, 0.7364224749299683]])",
            [1.147, 1.294, 0.905],
        ),
    ] {
        compiled(&format!(
            "body b0 {{ mass: 1, inertia: diag(0.1, 0.1, 0.1) }} body b1 {{ mass: 1, inertia: diag(0.1, 0.1, 0.1) }}
            body b2 {{ mass: 1, inertia: diag(0.1, 0.1, 0.1) }}
            joint j0: Revolute {{ parent: {from}, child: b0, axis: Z }}
            joint j1: Revolute {{ parent: b0.at({a} * X), child: b1, axis: Z }}
            joint j2: Revolute {{ parent: b1.at({b} * X), child: b2, axis: Z }}
            #[cut] joint j3: Revolute {{ parent: b2.at({c} * X), child: {to}, axis: Z }}
            solve (j1.angle, j2.angle) from j3 {{ sin(j2) > 0.0 }}
            formulation {{ constraints: Reduced }} emit energy;"
        ));
    }
}

/// What cancels beside angles that are no exact numbers: by exact points (acos of a number, directions), or up to rounding and
/// without a proof (exp), where terms stay.
#[test]
fn angles_without_an_exact_number() {
    let bodies = "
        body b0 { mass: 1.0, com: [0.1, 0.2, 0.3], inertia: diag(0.1, 0.12, 0.15) }
        body b1 { mass: 1.0, com: 0.3 * Y, inertia: diag(0.1, 0.12, 0.15) }";
    for angle in
        ["acos(1 / 3)", "-acos(1 / 3)", "asin(2 / 7)", "atan(-3)", "atan2(1, -2)", "exp(0.3)", "acos(1 / 3) + PI / 5"]
    {
        let text = format!(
            "world {{ gravity: -9 * [1, 2, 2] / 3 }} {bodies}
            joint j0: Revolute {{ parent: ground.rotated(X + Y, {angle}), child: b0, axis: Z }}
            joint j1: Revolute {{ parent: b0.at(X).rotated([1, 2, 2], {angle}), child: b1, axis: Z }}
            emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;"
        );
        judge(&text, 2, 7);
    }
    for (axis, slide) in [("[1, 2, 3]", "[3, 0, -1]"), ("[1, 2, 2]", "[2, 1, -2]"), ("[0.3, -0.7, 0.2]", "[7, 3, 0]")] {
        let text = format!(
            "{bodies}
            body b2 {{ mass: 1, inertia: diag(0.1, 0.1, 0.1) }}
            joint j0: Revolute {{ parent: ground, child: b0, axis: Z }}
            joint j1: PinSlot {{ parent: b0, child: b1, axis: {axis}, slide: {slide} }}
            joint j2: Revolute {{ parent: b1, child: b2, axis: X }}
            emit derivatives, forward_dynamics, mass_matrix, energy;"
        );
        assert!(compiled(&text).sound, "{text}");
    }
}

/// `CHAINS` chooses how many.
#[test]
fn chains_hold_no_dust() {
    let count = std::env::var("CHAINS").ok().and_then(|n| n.parse().ok()).unwrap_or(60);
    let mut with_dust = Vec::new();
    for seed in 0..count {
        let mut rng = Rng::new(seed);
        let joints = 2 + rng.below(3);
        let text = chain(&mut rng, joints);
        let found = judge(&text, joints, seed);
        if found > 0 {
            with_dust.push((seed, found, text));
        }
    }
    assert!(with_dust.is_empty(), "{} of {count}: {with_dust:#?}", with_dust.len());
}

/// What rounding has left of a zero in an axis is one, with any number of places.
#[test]
fn an_axis_with_the_rest_of_a_zero() {
    let text = |axis: &str| {
        format!(
            "world {{ gravity: -9.81 * Z }}
            body b0 {{ mass: 1.0, com: [0.1, 0.2, 0.3], inertia: diag(0.1, 0.12, 0.15) }}
            body b1 {{ mass: 1.0, com: [0.3, 0.2, 0.1], inertia: diag(0.1, 0.12, 0.15) }}
            joint j0: Revolute {{ parent: ground, child: b0, axis: X }}
            joint j1: Revolute {{ parent: b0.at(X), child: b1, axis: {axis} }}
            emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;"
        )
    };
    let plain = compiled(&text("Y"));
    for axis in ["[0, 1, 6.1e-17]", "[0, 1, 6.123233995736766e-17]", "[1e-25, 1, 0]", "[1e-300, 3, -2e-20]"] {
        let text = text(axis);
        assert_eq!(judge(&text, 2, 1), 0, "{axis}");
        for (a, b) in plain.functions.iter().zip(&compiled(&text).functions) {
            assert_eq!(a.after, b.after, "{axis} {:?}", a.kind);
        }
    }
    // Small ones are as good as others where all are.
    for axis in ["[1e-25, 2e-25, 0]", "[1e-25, 1e-25, 1e-25]"] {
        assert_eq!(judge(&text(axis), 2, 1), 0, "{axis}");
    }
}

/// Roots that aren't exact are numbers, whose cancellation is told from what is left.
#[test]
fn roots_of_any_number() {
    let mut g = Graph::new();
    let (one, two, three) = (Scalar::ONE, g.integer(2), g.integer(3));
    let root = g.sqrt(two);
    // sqrt(3 + 2 sqrt(2)) = 1 + sqrt(2)
    let double = g.mul(two, root);
    let square = g.add(three, double);
    let nested = g.sqrt(square);
    assert!(g.literal(nested).is_some_and(|n| !n.is_exact() && n.is_sharp()));
    assert_eq!(g.sum(&[nested, -root, -one]), Scalar::ZERO);
    // sqrt(e) = exp(1 / 2)
    let (half, e) = (g.decimal(0.5), g.call(Call::Exp, &[one]));
    let roots = [g.sqrt(e), g.call(Call::Exp, &[half])];
    assert_eq!(g.sub(roots[0], roots[1]), Scalar::ZERO);
    // What is left of a cancellation is nothing to divide by.
    let nearly = g.decimal(2.414_213_562_373_095);
    let rest = g.sub(nested, nearly);
    assert!(g.literal(rest).is_some_and(|n| !n.is_zero() && !n.is_sharp()));
    let negative = g.sqrt(-two);
    assert!(g.literal(negative).is_none());
}
