//! Operations of machines with closed loops, from text to program: the Stewart-Gough platform beside published counts,
//! and machines that the same rules must serve.

use multibody_engine::contracts::cost::Cost;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::SymbolId;
use multibody_engine::{mechanics, model, optimize, syntax};

const LEG: &str = "mod leg {
    port base: Frame; port tip: Frame;
    input thrust;
    body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
    body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
    joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
    joint stroke: Prismatic { parent: cylinder.at(1.0 * Z), child: piston, axis: Z }
    #[cut] joint ball: Ball { parent: piston, child: tip }
    force actuator: Effort { joint: stroke, value: thrust }
    ASSUME
    solve (gimbal, stroke) from ball { stroke.travel > -1.0, cos(gimbal.second) > 0.0 }
}";
const FEET: [[f64; 3]; 7] = [
    [-2.12, 1.374, 0.0],
    [-2.38, 1.224, 0.0],
    [-2.38, -1.224, 0.0],
    [-2.12, -1.374, 0.0],
    [0.0, -0.15, 0.0],
    [0.0, 0.15, 0.0],
    [1.3, 0.4, 0.0],
];
const PINS: [[f64; 3]; 7] = [
    [0.17, 0.595, -0.4],
    [-0.6, 0.15, -0.4],
    [-0.6, -0.15, -0.4],
    [0.17, -0.595, -0.4],
    [0.43, -0.445, -0.4],
    [0.43, 0.445, -0.4],
    [0.2, 0.1, -0.4],
];
const HEADING: [f64; 7] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85, 0.3];

/// A platform on its legs.
#[derive(Clone, Copy)]
struct Machine {
    legs: usize,
    /// Feet and pins are parameters.
    params: bool,
    /// The user vouches that pins are above feet.
    assume: bool,
    /// Orientation is driven to stay level.
    level: bool,
    /// Feet and pins in general position.
    scattered: bool,
    handling: &'static str,
    emit: &'static str,
}

const STEWART: Machine = Machine {
    legs: 6,
    params: false,
    assume: false,
    level: false,
    scattered: false,
    handling: "Reduced",
    emit: "inverse_dynamics { solve_for: legs.thrust }",
};

impl Machine {
    fn text(&self) -> String {
        let n = self.legs;
        let mut seed = 4_711_u64;
        let mut move_off = |x: f64| {
            seed = (seed * 16_807) % 2_147_483_647;
            if self.scattered { x + (seed % 1000) as f64 * 1e-4 } else { x }
        };
        let mut points =
            |list: &[[f64; 3]]| format!("{:?}", list[..n].iter().map(|p| p.map(&mut move_off)).collect::<Vec<_>>());
        let (feet, pins) = (points(&FEET), points(&PINS));
        let word = if self.params { "param" } else { "const" };
        let assume = if self.assume { "assume tip.position.z > base.position.z;" } else { "" };
        let level = if self.level { "drive platform.orientation = identity();" } else { "" };
        let (leg, heading, handling, emit) = (LEG.replace("ASSUME", assume), &HEADING[..n], self.handling, self.emit);
        format!(
            "{leg} pub mod machine {{
                {word} FEET: [Vec3; {n}] = {feet};
                {word} PINS: [Vec3; {n}] = {pins};
                const HEADING: [Scalar; {n}] = {heading:?};
                world {{ gravity: -9.80665 * Z }}
                formulation {{ constraints: {handling} }}
                body platform {{ mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }}
                part legs: [leg; {n}] = |i| leg {{ base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: platform.at(PINS[i]) }};
                {level}
                emit {emit};
            }}"
        )
    }

    fn flops(&self, kind: FunctionKind) -> u32 {
        flops(&count(&self.text(), kind))
    }
}

fn flops(cost: &Cost) -> u32 {
    cost.add + cost.mul + cost.div + cost.sqrt
}

/// Counts of one function; all its candidates must have the same values.
fn count(text: &str, kind: FunctionKind) -> Cost {
    let mut diagnostics = Diagnostics::default();
    let source = syntax::parse(text.parse().unwrap(), &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    let errors: Vec<&str> = diagnostics.errors().iter().map(|e| e.message.as_str()).collect();
    assert!(errors.is_empty(), "{errors:#?}\n{text}");
    let derivation = mechanics::of(models.last().unwrap()).unwrap_or_else(|c| panic!("{}", c[0].message)).1;
    for function in derivation.functions.iter().filter(|f| f.kind == kind) {
        let values = |id: SymbolId| ((id.0 * id.0 * 31 + id.0 * 7919 + 13) % 997) as f64 / 997.0 * 1.3 - 0.6;
        let mut list = function.candidates.iter().map(|(name, results)| {
            (name, Evaluator::new(&derivation.graph, Real { symbols: &values }).run(&results.list))
        });
        let (_, first) = list.next().unwrap();
        for (name, values) in list {
            for (a, b) in first.iter().zip(&values) {
                assert!((a - b).abs() < 1e-9 * (1.0 + a.abs()), "{kind:?} {name}: {a} {b}");
            }
        }
    }
    let compiled = optimize::compile(&derivation).unwrap();
    assert!(compiled.sound);
    compiled.functions.iter().find(|f| f.kind == kind).unwrap().after
}

#[test]
fn forces_of_the_platform() {
    let level = Machine { level: true, ..STEWART };
    let bars = [
        ("level", level, 316),
        ("any orientation", STEWART, 929),
        ("level, pins above feet", Machine { assume: true, ..level }, 316),
        ("any orientation, pins above feet", Machine { assume: true, ..STEWART }, 950),
        ("level, parameters", Machine { params: true, ..level }, 690),
        ("any orientation, parameters", Machine { params: true, ..STEWART }, 1340),
        ("any orientation, parameters, pins above feet", Machine { params: true, assume: true, ..STEWART }, 1340),
        ("general position", Machine { scattered: true, ..STEWART }, 1340),
    ];
    let mut missed = Vec::new();
    for (name, machine, bar) in bars {
        let cost = machine.flops(FunctionKind::InverseDynamics);
        println!("forces, {name}: {cost}, bar {bar}");
        if cost > bar {
            missed.push((name, cost, bar));
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn motion_of_the_platform() {
    let stewart = Machine { emit: "forward_dynamics", ..STEWART };
    let bars = [
        ("literals", stewart, 1060),
        ("parameters", Machine { params: true, ..stewart }, 1580),
        ("general position", Machine { scattered: true, ..stewart }, 1580),
    ];
    for (name, machine, bar) in bars {
        let cost = machine.flops(FunctionKind::ForwardDynamics);
        println!("motion, {name}: {cost}, bar {bar}");
        assert!(cost <= bar);
    }
}

/// 24 dynamic rows and 18 equations of loops: 2,369 additions and 2,766 products are published.
#[test]
fn residual_of_the_equations() {
    let machine = Machine { handling: "Multipliers", emit: "residual", ..STEWART };
    let cost = count(&machine.text(), FunctionKind::Residual);
    println!("42 equations: {} flops, {} sincos; published 5135", flops(&cost), cost.sincos);
    assert!(flops(&cost) <= 677 && cost.sincos <= 15 && cost.div + cost.sqrt == 0);
}

/// A further leg costs no more than one of six.
#[test]
fn a_seventh_leg() {
    let machine = |legs| Machine { legs, emit: "forward_dynamics", ..STEWART };
    let bare = 37;
    let six = machine(6).flops(FunctionKind::ForwardDynamics) - bare;
    let seven = machine(7).flops(FunctionKind::ForwardDynamics) - bare;
    println!("forward dynamics: {} a leg of six, {} of seven", f64::from(six) / 6.0, f64::from(seven) / 7.0);
    assert!(f64::from(seven) / 7.0 <= 1.05 * f64::from(six) / 6.0);
    let scattered = |legs| Machine { scattered: true, ..machine(legs) };
    let six = scattered(6).flops(FunctionKind::ForwardDynamics) - bare;
    let seven = scattered(7).flops(FunctionKind::ForwardDynamics) - bare;
    println!("the same in general position: {} of six, {} of seven", f64::from(six) / 6.0, f64::from(seven) / 7.0);
    assert!(f64::from(seven) / 7.0 <= 1.05 * f64::from(six) / 6.0);
}
