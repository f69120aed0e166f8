//! Bodies whose mass follows states: at every moment all functions are those of the same mechanism with parameters in the place
//! of the states, and derivatives by the states are differences of those by the parameters.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::{ParamId, StateId};

use super::support::*;

/// Relative, of sums in another order.
const ROUNDING: f64 = 1e-12;

/// Of differences of order four.
const DIFFERENCES: f64 = 1e-8;

/// What stands for `@` in the masses of the two: `fuel`, a state, and `content`, a parameter of the same number.
const PAIR: &str = "state fuel: rate = -0.3 * fuel, start: 0.8; param content = 0.8;";

/// A tank on an oblique arm.
const ARM: &str = "
    body boom { mass: 1.0, com: [0.3, 0.1, -0.2], inertia: inertia(0.06, 0.05, 0.04, 0.01, 0.02, -0.01) }
    body tank {
        mass: 0.4 + @, com: [0.1, 0.05 * @, -0.1],
        inertia: cylinder(0.4 + @, 0.2 + 0.1 * @, 0.7, [1.0, 2.0, 0.5])
    }
    body cap { mass: 0.3 * @ * @, com: [0.0, 0.1, 0.05] }
    joint shoulder: Screw { parent: ground, child: boom, axis: [1.0, 2.0, 0.5], pitch: 0.05, armature: 0.07 }
    joint elbow: Universal {
        parent: boom.at([0.3, 0.1, 0.2]).rotated([1, 1, 0], 0.4), child: tank.at([0.1, 0, 0.2]), axes: [X, [0, 1, 1]]
    }
    joint lid: Fixed { parent: tank.at(0.2 * X).rotated([1.0, 1.0, 0.0], 0.5), child: cap }
    force drag: Force { at: tank.at(X), value: (push - 0.3 * @) * tank.velocity, axes: tank }
    output drain = diff(kinetic() + potential(), content);";

/// A floating hull with limbs in parts, each with a state of its own.
const TOE: &str = "
    mod toe {
        port foot: Frame;
        state fuel: rate = -0.2 * fuel, start: 0.35;
        param content = 0.35;
        body tip { mass: @, com: [0.03, -0.02, 0.05], inertia: inertia(0.08 * @, 0.09 * @, 0.07 * @, 0.006 * @, -0.009 * @, 0.003 * @) }
        joint bend: Cylindrical { parent: foot, child: tip.rotated(Y, 0.4), axis: [0.0, 1.0, -1.0] }
    }";
const FLOATING: &str = "
    body hull { mass: 2.0 + @, com: [0.1, 0.05, -0.1], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }
    body ball { mass: 0.6, com: [0.0, 0.1, 0.05], inertia: inertia(0.03, 0.05, 0.04, 0.005, 0.004, -0.006) }
    joint float: Free { parent: ground, child: hull.at([0.1, 0.2, -0.1]).rotated([1.0, 0.4, 0.2], 0.7) }
    joint socket: Ball { parent: hull.at([0.2, 0.5, 0.1]).rotated(X, 0.3), child: ball.at([0.0, 0.1, 0.1]), coordinates: RollPitchYaw }
    part toes: [toe; 2] = |i| toe { foot: ball.at([0.3, 0.1 * i, -0.2]).rotated([1.0, 2.0, 0.5], 0.3 + i) };
    force spring: Spring { between: [hull.at(X), toes[1].tip.at(Y)], stiffness: push, length: 0.5 }";

/// Two hinges that close a loop by a rod, and a slider on one that is held by a joint.
const LOOPS: &str = "
    body a { mass: 1.0, com: [0.5, 0.1, 0.2], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }
    body b { mass: 0.7 * @, com: [1.1, -0.2, 0.1], inertia: inertia(0.3 * @, 0.2 * @, 0.4 * @, 0.01 * @, 0.02 * @, -0.01 * @) }
    joint one: Revolute { parent: ground.at([0.1, 0.2, 0]), child: a, axis: [1, 0.3, -0.2], armature: 0.1 }
    joint two: Revolute { parent: a.at([1, 0.2, 0]).rotated([1, 1, 0], 0.4), child: b.at([0.1, 0, 0.2]), axis: Z }
    constraint rod: Rod { between: [ground.at([2, 0, 0]), b.at(Y)], length: 2.0 }";

/// A plate on struts, which are solved by the vectors between their ends.
const LEG: &str = "
    mod leg {
        port base: Frame;
        port tip: Frame;
        input thrust;
        state fuel: rate = -0.1, start: 0.2;
        param content = 0.2;
        body cylinder { mass: 0.1 + @, com: 0.5 * Z, inertia: diag(0.05 * @, 0.05 * @, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
        solve (gimbal, stroke) from ball { stroke > -1.0, cos(gimbal.second) > 0.0 }
    }";
const PLATE: &str = "
    const FEET: [Vec3; 6] = [
        [-2.12, 1.374, 0.0], [-2.38, 1.224, 0.0], [-2.38, -1.224, 0.0], [-2.12, -1.374, 0.0], [0.0, -0.15, 0.0], [0.0, 0.15, 0.0],
    ];
    const PINS: [Vec3; 6] = [
        [0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.4], [0.17, -0.595, -0.4], [0.43, -0.445, -0.4],
        [0.43, 0.445, -0.4],
    ];
    const HEADING: [Scalar; 6] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85];
    body plate { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
    part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(Z, HEADING[i]), tip: plate.at(PINS[i]) };";

const ALL: &str = "emit forward_dynamics, inverse_dynamics, mass_matrix, mass_matrix_lower, bias, energy, residual, \
                   derivatives, centroidal_momentum_matrix;";

const OUTPUTS: &str = "output mass = total_mass(); output centre = centre_of_mass(); output linear = linear_momentum();
    output angular = angular_momentum(); output stored = kinetic() + potential();";

/// The mechanism with states, and with parameters.
struct Pair {
    states: Case,
    params: Case,
}

impl Pair {
    fn new(parts: &str, items: &str) -> Pair {
        let items = format!("input push; world {{ gravity: [1.0, -9.0, 2.0] }} {OUTPUTS} {items}");
        let with = |name: &str| case_with(&parts.replace('@', name), &items.replace('@', name));
        Pair { states: with("fuel"), params: with("content") }
    }

    /// Parameters named `content`, in the order of the states.
    fn contents(&self) -> Vec<ParamId> {
        let params = self.params.model.params.iter_ids();
        params.filter(|(_, param)| param.place.field == "content").map(|(id, _)| id).collect()
    }

    /// Some point, and the same with the states' values as parameters.
    fn points(&self, seed: u64) -> (Point, Point) {
        let (mut point, mut random) = (self.states.random(seed), Random(seed));
        if let Some(closed) =
            self.states.structure.closed.get(seed as usize % self.states.structure.closed.len().max(1))
        {
            for &symbol in &self.states.derivation.symbols {
                let Symbol::Position { joint, component } = symbol else { continue };
                if let Some(&x) = closed.positions.get(joint.0).and_then(|list| list.get(component)) {
                    point.set(symbol, x);
                }
            }
        }
        for (index, guessed) in self.states.structure.guessed().into_iter().enumerate() {
            if let Some(x) =
                self.states.structure.closed.first().and_then(|closed| closed.value(&self.states.model, guessed))
            {
                point.set(Symbol::Guess { index }, x);
            }
        }
        let mut frozen = point.clone();
        for (k, id) in self.contents().into_iter().enumerate() {
            let x = 0.5 + 0.2 * random.next();
            point.set(Symbol::State { state: StateId(k) }, x);
            frozen.set(Symbol::State { state: StateId(k) }, x);
            frozen.set(Symbol::Param { param: id, element: 0 }, x);
        }
        (point, frozen)
    }

    fn kinds(&self) -> Vec<FunctionKind> {
        self.states.derivation.functions.iter().map(|function| function.kind).collect()
    }

    /// All functions in all ways, at two points; how many numbers were compared.
    fn agrees(&self, what: &str) -> usize {
        let (mut points, mut numbers) = (0, 0);
        for seed in 1..12 {
            let (point, frozen) = self.points(seed);
            let forward = self.params.candidate(FunctionKind::ForwardDynamics, 0, &frozen);
            if !forward.iter().all(|x| x.is_finite()) {
                continue;
            }
            points += 1;
            for kind in self.kinds() {
                numbers += self.same(what, kind, &point, &frozen);
            }
            if points == 2 {
                return numbers;
            }
        }
        panic!("{what}: loops close nowhere");
    }

    fn same(&self, what: &str, kind: FunctionKind, point: &Point, frozen: &Point) -> usize {
        let expected = self.params.candidate(kind, 0, frozen);
        let derivatives = matches!(kind, FunctionKind::ForwardDerivatives | FunctionKind::InverseDerivatives);
        for way in 0..self.states.candidates(kind) {
            let what = format!("{what}, {kind:?}, way {way}");
            let found = self.states.candidate(kind, way, point);
            // Ways through other factorisations.
            let tolerance = if self.states.structure.rows.is_empty() { ROUNDING } else { 1e3 * ROUNDING };
            if derivatives {
                self.same_derivatives(&what, kind, [&found, &expected], frozen);
            } else if kind == FunctionKind::Outputs {
                // The one by the parameter has another meaning in each.
                let drain = self.params.model.outputs.iter().any(|output| output.place.field == "drain");
                let count = expected.len() - usize::from(drain);
                close(&what, &found[..count], &expected[..count], tolerance);
            } else {
                close(&what, &found, &expected, tolerance);
            }
        }
        expected.len()
    }

    /// Columns of the states are differences by the parameters, and what rates of states give by themselves.
    fn same_derivatives(&self, what: &str, kind: FunctionKind, [found, expected]: [&[f64]; 2], frozen: &Point) {
        let (dof, states) = (self.params.structure.state.len(), self.params.model.states.len());
        let rows = if kind == FunctionKind::ForwardDerivatives { dof + states } else { dof };
        let (from, to) = (2 * rows * dof, 2 * rows * dof + rows * states);
        close(what, &found[..from], &expected[..from], 1e3 * ROUNDING);
        close(what, &found[to..], &expected[to..], 1e3 * ROUNDING);
        let of = if kind == FunctionKind::ForwardDerivatives {
            FunctionKind::ForwardDynamics
        } else {
            FunctionKind::InverseDynamics
        };
        for (column, id) in self.contents().into_iter().enumerate() {
            let symbol = Symbol::Param { param: id, element: 0 };
            let slopes = self.params.derivative(|h| {
                let mut moved = frozen.clone();
                moved.set(symbol, frozen.get(symbol) + h);
                self.params.candidate(of, 0, &moved)[..rows].to_vec()
            });
            let entries = (0..rows).map(|row| from + row * states + column);
            let sums: Vec<f64> = entries.clone().zip(&slopes).map(|(at, slope)| expected[at] + slope).collect();
            let entries: Vec<f64> = entries.map(|at| found[at]).collect();
            assert!(slopes.iter().any(|slope| slope.abs() > 1e-3), "{what}: nothing depends on the mass");
            close(&format!("{what}, by state {column}"), &entries, &sums, DIFFERENCES);
        }
    }
}

#[test]
fn a_tank_on_an_arm() {
    let numbers = Pair::new("", &format!("{PAIR} {ARM} {ALL}")).agrees("arm");
    assert!(numbers > 100, "{numbers}");
}

#[test]
fn limbs_of_what_floats() {
    Pair::new(TOE, &format!("{PAIR} {FLOATING} {ALL}")).agrees("floating");
}

#[test]
fn loops_in_every_formulation() {
    for formulation in [
        "constraints: Multipliers",
        "constraints: Reduced",
        "constraints: Stabilised, rate: 20.0, position: 100.0",
        "coordinates: Absolute(RollPitchYaw)",
        "coordinates: Absolute(Quaternion)",
    ] {
        let items = format!("formulation {{ {formulation} }} {PAIR} {LOOPS} {ALL}");
        Pair::new("", &items).agrees(formulation);
    }
}

#[test]
fn bodies_on_struts() {
    for constraints in ["Reduced", "Multipliers"] {
        let items =
            format!("formulation {{ constraints: {constraints} }} {PLATE} emit forward_dynamics, mass_matrix, energy;");
        Pair::new(LEG, &items).agrees(constraints);
    }
    let items = format!(
        "formulation {{ constraints: Reduced }} {PLATE} emit forward_dynamics, inverse_dynamics {{ solve_for: legs.thrust }};"
    );
    Pair::new(LEG, &items).agrees("struts");
}

/// A `diff` by the state is that by the parameter, and the total derivative by time goes along the state.
#[test]
fn rates_of_energies_and_momenta() {
    let text = |name: &str| {
        format!(
            "input push; world {{ gravity: [1.0, -9.0, 2.0] }} {PAIR} {ARM} {OUTPUTS} emit forward_dynamics;
            output by_state = diff(kinetic() + potential(), fuel); output moving = diff(centre_of_mass(), t);
            output growing = diff(total_mass(), t); output pushed = diff(linear_momentum(), t);
            output feeding = diff(kinetic() + potential(), t);"
        )
        .replace('@', name)
    };
    let (states, params) = (case(&text("fuel")), case(&text("content")));
    for seed in 1..4 {
        let mut point = states.random(seed);
        let fuel = Symbol::State { state: StateId(0) };
        point.set(fuel, 0.7);
        let mut frozen = point.clone();
        let content = params.model.params.iter_ids().find(|(_, param)| param.place.field == "content").unwrap().0;
        frozen.set(Symbol::Param { param: content, element: 0 }, 0.7);
        let outputs = states.outputs(&point);
        close("by the state", &outputs["by_state"], &params.outputs(&frozen)["drain"], ROUNDING);
        for (rate, value) in [("moving", "centre"), ("growing", "mass"), ("pushed", "linear"), ("feeding", "stored")] {
            let slopes = states.rate_along_flow(&point, |p| states.output(value, p));
            close(rate, &outputs[rate], &slopes, DIFFERENCES);
        }
    }
}

/// A derivative by time asks for rates of those states alone that it reads.
#[test]
fn a_rate_of_a_position_in_the_rate_of_a_state() {
    let case = case(
        "body b { mass: 1.0, com: X } joint j: Revolute { parent: ground, child: b, axis: Z }
        state s: rate = diff(centre_of_mass(), t).x, start: 0.0; output speed = centre_of_mass().velocity;",
    );
    let point = case.random(1);
    let rates = case.eval(FunctionKind::ForwardDynamics, &point);
    close("rate", &rates[1..], &case.output("speed", &point)[..1], ROUNDING);
}
