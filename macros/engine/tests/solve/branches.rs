//! A condition of a `solve` item is a part of its meaning: with parameters far from the declared ones every model either
//! stands on the branch that its conditions name, closed, or gives what is no number. Screws count their turns.

use crate::interpreter;
use std::collections::HashMap;

use crate::rng::Rng;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::mechanics::Condition;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::check;
use multibody_engine::model::types::{JointId, Model, Type};
use multibody_engine::optimize::program::Compiled;
use multibody_engine::syntax::parse;
use multibody_engine::{Trouble, compile};

/// A compiled model.
struct Machine {
    model: Model,
    structure: Structure,
    compiled: Compiled,
}

/// Values by name: `tilt`, or `a` for the position of a joint, `a'` for its velocity.
type Values = HashMap<String, f64>;

fn model_of(body: &str) -> Result<Model, String> {
    let text = format!("pub mod m {{ {body} }}");
    let mut diagnostics = Diagnostics::default();
    let source = parse(text.parse().expect("tokens"), &mut diagnostics);
    let models = check(&source, &mut diagnostics);
    match diagnostics.errors().first() {
        Some(error) => Err(error.message.clone()),
        None => Ok(models.into_iter().next().expect("a model")),
    }
}

fn machine(body: &str) -> Result<Machine, String> {
    let model = model_of(body)?;
    match compile(&model) {
        Ok((structure, compiled)) if compiled.sound => Ok(Machine { model, structure, compiled }),
        Ok(_) => panic!("a pass has changed a value"),
        Err(Trouble::Complaints(complaints)) => Err(complaints[0].message.clone()),
        Err(Trouble::Refused(refusal)) => Err(format!("{refusal:?}")),
        Err(Trouble::Fault(fault)) => Err(format!("{fault:?}")),
    }
}

impl Machine {
    fn value(&self, symbol: Symbol, values: &Values) -> f64 {
        let joint = |joint: usize, tail: &str| {
            let name = format!("{}{tail}", self.model.joints[JointId(joint)].place.field);
            values.get(&name).copied().unwrap_or(0.0)
        };
        match symbol {
            Symbol::Param { param, element } => {
                let param = &self.model.params[param];
                values.get(&param.place.field.to_string()).copied().unwrap_or(param.default[element])
            }
            Symbol::Position { joint: id, .. } => joint(id.0, ""),
            Symbol::Velocity { joint: id, .. } => joint(id.0, "'"),
            Symbol::Guess { index } => values.get(&format!("guess{index}")).copied().unwrap_or(0.0),
            _ => 0.0,
        }
    }

    fn run(&self, kind: FunctionKind, values: &Values) -> Vec<f64> {
        let symbol = |symbol: Symbol| self.value(symbol, values);
        let fields = interpreter::run(&self.compiled.prelude, &symbol, &|_| f64::NAN);
        let function = self.compiled.functions.iter().find(|f| f.kind == kind).expect("derived");
        interpreter::run(&function.program, &symbol, &|field| fields[field.0])
    }

    /// One output.
    fn output(&self, name: &str, values: &Values) -> f64 {
        let all = self.run(FunctionKind::Outputs, values);
        let at = self.model.outputs.iter().position(|output| output.place.field == name).expect("an output");
        assert!(self.model.outputs.iter().all(|output| output.value.ty == Type::Scalar));
        all[at]
    }
}

fn values(list: &[(&str, f64)]) -> Values {
    list.iter().map(|&(name, value)| (name.to_owned(), value)).collect()
}

const BARS: &str = "
    param tilt = 0.0; param crank = 2.0; param coupler = 1.2; param follower = 1.5; param base = 3.5;
    world { gravity: -9.81 * Y }
    let pivot = ground.rotated(Z, tilt);
    body one { mass: 1.0, com: 0.5 * crank * X, inertia: rod(1.0, crank, X) }
    body two { mass: 1.0, com: 0.5 * coupler * X, inertia: rod(1.0, coupler, X) }
    body three { mass: 1.0, com: 0.5 * follower * X, inertia: rod(1.0, follower, X) }
    joint a: Revolute { parent: pivot, child: one, axis: Z }
    joint b: Revolute { parent: one.at(crank * X), child: two, axis: Z }
    joint c: Revolute { parent: pivot.at(base * X), child: three, axis: Z }
    #[cut] joint d: Revolute { parent: two.at(coupler * X), child: three.at(follower * X), axis: Z }
    formulation { constraints: Reduced }
    output gap = norm(two.at(coupler * X).position - three.at(follower * X).position);
    output above = three.at(follower * X).position.y - one.at(crank * X).position.y;
    output reach = three.at(follower * X).position.x;";

/// Rocker and rocker, for which tilts and negative lengths put another root where the condition asks for it.
#[test]
fn tilts_and_lengths_choose_their_root() {
    let solve = "solve (b, c) from d { three.at(follower * X).position.y > one.at(crank * X).position.y }
        emit forward_dynamics;";
    let bars = machine(&format!("{BARS} {solve}")).unwrap_or_else(|e| panic!("{e}"));
    let mut closed = 0;
    let mut changed: Vec<Vec<(&str, f64)>> =
        [0.0, 0.5, 2.0, 3.1, -2.0, 7.0, -40.0].iter().map(|&tilt| vec![("tilt", tilt)]).collect();
    changed.extend([
        vec![("coupler", -1.2)],
        vec![("follower", -1.5)],
        vec![("coupler", 0.0)],
        vec![("crank", 0.0), ("base", 1.6)],
        vec![("coupler", 0.1)],
        vec![("coupler", f64::NAN)],
        vec![("crank", -2.0), ("tilt", 3.0)],
    ]);
    for list in changed {
        let mut at = values(&list);
        at.insert("a".to_owned(), 0.7);
        let (gap, above) = (bars.output("gap", &at), bars.output("above", &at));
        let a = bars.run(FunctionKind::ForwardDynamics, &at)[0];
        let centres = bars.run(FunctionKind::DeadCentres, &at);
        if !a.is_finite() {
            // Without length and inertia nothing resists the crank; the loop is closed all the same.
            if list[0].0 == "crank" && above > 0.0 {
                continue;
            }
            assert!(above.is_nan() && centres.iter().any(|x| x.is_nan()), "{list:?}: {above} {centres:?}");
            continue;
        }
        closed += 1;
        assert!(gap < 1e-12 && above > 0.0 && a.is_finite(), "{list:?}: {gap:e} {above} {a}");
    }
    assert!(closed >= 6, "{closed}");
}

const NUT: &str = "
    world { gravity: -9.81 * Z }
    body spindle { mass: 1.0, inertia: diag(0.01, 0.01, 0.02) }
    body nut { mass: 2.0, inertia: diag(0.01, 0.01, 0.02) }
    joint turn: Revolute { parent: ground, child: spindle, axis: Z }
    joint rail: Prismatic { parent: ground, child: nut, axis: Z }
    #[cut] joint thread: Screw { parent: spindle, child: nut.rotated(Z, 0.5), axis: Z, pitch: 0.01 }
    output z = rail.travel; output phi = turn.angle;";

/// By Newton's method, in closed form for either coordinate, and with multipliers: many turns on, and back.
#[test]
fn a_thread_counts_its_turns() {
    let by = |text: &str| machine(&format!("{NUT} {text}")).unwrap_or_else(|e| panic!("{text}: {e}"));
    let reduced = "formulation { constraints: Reduced, independent: [turn] }";
    let from_turn = [by(reduced), by(&format!("{reduced} solve (rail) from thread {{}}"))];
    let from_rail = by("formulation { constraints: Reduced } solve (turn) from thread {}");
    let held = by("formulation { constraints: Multipliers }");
    for turn in [0.0, 0.3, 3.0, 4.0, 100.0, -1234.5] {
        // The nut's frame stands half a radian ahead.
        let rail = 0.01 * (0.5 - turn);
        for machine in &from_turn {
            let z = machine.output("z", &values(&[("turn", turn)]));
            assert!((z - rail).abs() < 1e-14 * (1.0 + turn.abs()), "{turn}: {z}");
        }
        let phi = from_rail.output("phi", &values(&[("rail", rail)]));
        assert!((phi - turn).abs() < 1e-11 * (1.0 + turn.abs()), "{turn}: {phi}");
        let residual = held.run(FunctionKind::Constraints, &values(&[("rail", rail), ("turn", turn)]));
        assert!(residual.len() == 1 && residual[0].abs() < 1e-13, "{turn}: {residual:?}");
        // A turn off is off by the lead.
        let off = held
            .run(FunctionKind::Constraints, &values(&[("rail", rail + 0.02 * std::f64::consts::PI), ("turn", turn)]));
        assert!((off[0].abs() - 0.02 * std::f64::consts::PI).abs() < 1e-13, "{off:?}");
    }
    // All agree on the motion: (20.02 + ..) by hand: (I + m p^2) a = m g p.
    let a = 2.0 * 9.81 * 0.01 / (0.02 + 2.0 * 1e-4);
    for machine in &from_turn {
        let found = machine.run(FunctionKind::ForwardDynamics, &values(&[("turn", 40.0), ("turn'", 3.0)]))[0];
        assert!((found - a).abs() < 1e-12 * a, "{found} {a}");
    }
}

/// The same screw in the tree, where the rail closes the loop: it holds an angle, whole turns included.
#[test]
fn a_rail_behind_a_thread_counts_turns() {
    let nut = |text: &str| {
        machine(&format!(
            "body spindle {{ mass: 1.0, inertia: diag(0.01, 0.01, 0.02) }}
            body nut {{ mass: 2.0, inertia: diag(0.01, 0.01, 0.02) }}
            joint turn: Revolute {{ parent: ground, child: spindle, axis: Z }}
            joint thread: Screw {{ parent: spindle, child: nut, axis: Z, pitch: 0.01 }}
            #[cut] joint rail: Prismatic {{ parent: ground.rotated(Z, 0.5), child: nut, axis: Z }}
            formulation {{ constraints: Reduced, independent: [turn] }}
            output z = nut.position.z; {text}"
        ))
        .unwrap_or_else(|e| panic!("{e}"))
    };
    for machine in [nut(""), nut("solve (thread) from rail {}")] {
        for turn in [0.0, 3.0, 4.0, 100.0, -1234.5] {
            let z = machine.output("z", &values(&[("turn", turn)]));
            assert!((z - 0.01 * (0.5 - turn)).abs() < 1e-14 * (1.0 + turn.abs()), "{turn}: {z}");
        }
    }
}

/// Where an orientation alone tells the angle, whole turns are not known: multipliers hold the nut on any turn of its
/// thread, and a reduced model, which would look for the turn anew at every step, is refused.
#[test]
fn what_no_coordinate_counts_is_refused_or_said() {
    let absolute = |handling: &str| {
        machine(&format!(
            "body spindle {{ mass: 1.0, inertia: diag(0.01, 0.01, 0.02) }}
            body nut {{ mass: 2.0, inertia: diag(0.01, 0.01, 0.02) }}
            joint hold: Ball {{ parent: ground, child: spindle, coordinates: RollPitchYaw }}
            #[cut] joint bearing: Revolute {{ parent: ground.at(X), child: spindle.at(X), axis: X }}
            joint rail: Prismatic {{ parent: ground, child: nut, axis: X }}
            #[cut] joint thread: Screw {{ parent: spindle, child: nut, axis: X, pitch: 0.01 }}
            formulation {{ constraints: {handling} }}"
        ))
    };
    let held = absolute("Multipliers").unwrap_or_else(|e| panic!("{e}"));
    let lead = 0.02 * std::f64::consts::PI;
    for turns in [0.0, 1.0, 7.0] {
        let residual = held.run(FunctionKind::Constraints, &values(&[("rail", turns * lead)]));
        assert!(residual.iter().all(|x| x.abs() < 1e-13), "{residual:?}");
    }
    let refused = absolute("Reduced").err().expect("refused");
    assert!(refused.contains("up to whole turns only"), "{refused}");
}

/// Wheels coupled by their measured angles: Newton's method could go to another tooth, unless from one tooth to the next
/// all wheels go round whole times.
#[test]
fn teeth_that_no_coordinate_counts_are_refused() {
    let wheels = |constraint: &str, formulation: &str| {
        machine(&format!(
            "body a {{ mass: 1.0, com: 0.5 * X, inertia: diag(0.01, 0.01, 0.02) }}
            body b {{ mass: 2.0, com: 0.5 * X, inertia: diag(0.01, 0.01, 0.02) }}
            joint one: Revolute {{ parent: ground, child: a, axis: Z }}
            joint two: Revolute {{ parent: a.at(X), child: b, axis: Z }}
            constraint gear = {constraint};
            formulation {{ {formulation} }}"
        ))
    };
    let absolute = |handling: &str| format!("coordinates: Absolute(RollPitchYaw), constraints: {handling}");
    for constraint in
        ["47.0 * one - 13.0 * two", "one - 2.0 * two", "two / 3.0 - one / 2.0", "one - sin(one) - 3 * two"]
    {
        let refused = wheels(constraint, &absolute("Reduced")).err().unwrap_or_else(|| panic!("{constraint} is taken"));
        assert!(refused.contains("another tooth"), "{refused}");
        for formulation in [absolute("Multipliers").as_str(), "constraints: Reduced"] {
            assert!(wheels(constraint, formulation).is_ok(), "{constraint} {formulation}");
        }
    }
    for constraint in
        ["two - 2.0 * one", "3.0 * (two - 2.0 * one)", "two - one", "47.0 * two - 0.3 * sin(t)", "two + one"]
    {
        let taken = wheels(constraint, &absolute("Reduced"));
        assert!(taken.is_ok(), "{constraint}: {}", taken.err().unwrap_or_default());
    }
}

/// Which root belongs to the branch depends on the crank, and the user says where the crank stays.
#[test]
fn assumptions_choose_the_root() {
    let slider = |assume: &str, sign: &str| {
        machine(&format!(
            "world {{ gravity: -9.81 * Y }}
            body crank {{ mass: 2.0, com: 0.5 * X, inertia: rod(2.0, 1.0, X) }}
            body coupler {{ mass: 2.0, com: 0.5 * X, inertia: rod(2.0, 1.0, X) }}
            body carriage {{ mass: 0.5 }}
            joint q: Revolute {{ parent: ground, child: crank, axis: Z }}
            joint c: Revolute {{ parent: crank.at(X), child: coupler, axis: Z }}
            joint rail: Prismatic {{ parent: ground, child: carriage, axis: X }}
            #[cut] joint foot: Revolute {{ parent: coupler.at(X), child: carriage, axis: Z }}
            {assume} solve (c, rail) from foot {{ rail {sign} 0.0 }}
            formulation {{ constraints: Reduced }} output z = rail.travel;"
        ))
    };
    assert!(slider("", ">").is_err());
    // The carriage would stand on the other side, or at the crank's axis.
    assert!(slider("assume cos(q) < 0.0;", ">").is_err());
    for (assume, sign, range) in
        [("assume cos(q) > 0.0;", ">", 0.0), ("assume cos(q) < 0.0;", "<", std::f64::consts::PI)]
    {
        let machine = slider(assume, sign).unwrap_or_else(|e| panic!("{assume} {e}"));
        assert_eq!(machine.structure.state.len(), 1);
        for q in [-1.2, 0.3, 1.5] {
            let z = machine.output("z", &values(&[("q", range + q)]));
            assert!((z - 2.0 * (range + q).cos()).abs() < 1e-13, "{assume} {q}: {z}");
        }
    }
}

/// A plate on two parallel rods keeps its angle: the user says so, the rest follows in closed form.
#[test]
fn a_formula_beside_a_closed_form() {
    let machine = machine(
        "body s1 { mass: 0.1 } body s2 { mass: 0.1 } body plate { mass: 0.6, inertia: diag(1e-3, 1e-3, 2e-3) }
        joint px: Prismatic { parent: ground, child: s1, axis: X }
        joint py: Prismatic { parent: s1, child: s2, axis: Y }
        joint turn: Revolute { parent: s2, child: plate, axis: Z }
        constraint left: Rod { between: [ground, plate], length: 0.7 }
        constraint right: Rod { between: [ground.at(X), plate.at(X)], length: 0.7 }
        solve (turn) = (0.0);
        solve (py) from left { py > 0.0 }
        formulation { constraints: Reduced }
        output y = py.travel; output gap = norm(plate.at(X).position - X);",
    )
    .unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(machine.structure.state.len(), 1);
    for x in [-0.6, 0.0, 0.4] {
        let at = values(&[("px", x)]);
        assert!((machine.output("y", &at) - (0.49 - x * x).sqrt()).abs() < 1e-15);
        assert!((machine.output("gap", &at) - 0.7).abs() < 1e-15);
    }
}

/// A loop with parameters everywhere, the conditions to choose from, and the parameters that may be moved.
struct Drawn {
    body: String,
    /// Both sides of every branch.
    conditions: Vec<[&'static str; 2]>,
    parameters: Vec<(&'static str, f64)>,
    knowns: Vec<&'static str>,
}

fn axes(rng: &mut Rng) -> String {
    let x: Vec<String> = (0..3).map(|_| format!("{:.3}", rng.real(-1.0, 1.0))).collect();
    format!("rotated([{}, {}, {} + 1.2], {:.3})", x[0], x[1], x[2], rng.real(-3.0, 3.0))
}

/// Four kinds of loops: bars, a slider, a leg, an arm whose elbow holds a rod.
fn drawn(rng: &mut Rng, kind: usize) -> Drawn {
    let ground = if rng.below(2) == 0 { "ground".to_owned() } else { format!("ground.{}", axes(rng)) };
    match kind {
        0 | 1 => {
            let lengths = [rng.decimal(0.6, 1.0), rng.decimal(1.6, 2.4), rng.decimal(1.5, 2.2), rng.decimal(1.4, 2.0)];
            let names = ["crank", "coupler", "follower", "base"];
            let mut parameters: Vec<(&str, f64)> = names.into_iter().zip(lengths).collect();
            let params: String = parameters.iter().map(|(name, x)| format!("param {name} = {x};")).collect();
            let tilt = rng.decimal(-0.4, 0.4);
            parameters.push(("tilt", tilt));
            let (last, conditions, unknowns) = if kind == 0 {
                (
                    "joint c: Revolute { parent: pivot.at(base * X), child: three, axis: Z }
                    #[cut] joint d: Revolute { parent: two.at(coupler * X), child: three.at(follower * X), axis: Z }
                    output gap = norm(two.at(coupler * X).position - three.at(follower * X).position);",
                    vec![["sin(b) > 0.0", "sin(b) < 0.0"], ["sin(c - a - b) > 0.0", "sin(c - a - b) < 0.0"]],
                    "b, c",
                )
            } else {
                (
                    "joint c: Prismatic { parent: pivot.rotated(Z, tilt), child: three, axis: X }
                    #[cut] joint d: Revolute { parent: two.at(coupler * X), child: three.at(0.1 * follower * Y), axis: Z }
                    output gap = norm(two.at(coupler * X).position - three.at(0.1 * follower * Y).position);",
                    vec![["c > cos(a - tilt) * crank", "c < cos(a - tilt) * crank"], ["cos(a + b - tilt) > 0.0", "cos(a + b - tilt) < 0.0"]],
                    "b, c",
                )
            };
            let body = format!(
                "param tilt = {tilt}; {params}
                world {{ gravity: -9.81 * Y }}
                let pivot = {ground}.rotated(Z, tilt);
                body one {{ mass: 1.0, com: 0.5 * crank * X, inertia: rod(1.0, crank, X) }}
                body two {{ mass: 1.0, com: 0.5 * coupler * X, inertia: rod(1.0, coupler, X) }}
                body three {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }}
                joint a: Revolute {{ parent: pivot, child: one, axis: Z }}
                joint b: Revolute {{ parent: one.at(crank * X), child: two, axis: Z }}
                {last} solve ({unknowns}) from d {{ CONDITION }}"
            );
            Drawn { body, conditions, parameters, knowns: vec!["a"] }
        }
        2 => {
            let (length, reach, tilt) = (rng.decimal(0.5, 1.2), rng.decimal(0.3, 0.9), rng.decimal(-0.3, 0.3));
            let body = format!(
                "param length = {length}; param reach = {reach}; param tilt = {tilt};
                body cylinder {{ mass: 0.1, com: 0.5 * Z, inertia: diag(0.006, 0.006, 0.001) }}
                body piston {{ mass: 0.2, com: -0.4 * Z, inertia: diag(0.005, 0.005, 0.001) }}
                body arm {{ mass: 1.0, inertia: diag(0.1, 0.2, 0.3) }}
                joint q: Revolute {{ parent: {ground}, child: arm, axis: Y }}
                joint gimbal: Universal {{ parent: ground.at(X).rotated(X, tilt), child: cylinder, axes: [X, Y] }}
                joint stroke: Prismatic {{ parent: cylinder.at(length * Z), child: piston, axis: Z }}
                #[cut] joint ball: Ball {{ parent: piston, child: arm.at([0.1, 0.2, reach]) }}
                output gap = norm(piston.position - arm.at([0.1, 0.2, reach]).position);
                solve (gimbal, stroke) from ball {{ CONDITION }}"
            );
            let conditions = vec![
                [
                    "stroke.travel > -length, cos(gimbal.second) > 0.0",
                    "stroke.travel < -length, cos(gimbal.second) > 0.0",
                ],
                [
                    "stroke.travel > -length, cos(gimbal.second) < 0.0",
                    "stroke.travel < -length, cos(gimbal.second) < 0.0",
                ],
            ];
            let parameters = vec![("length", length), ("reach", reach), ("tilt", tilt)];
            Drawn { body, conditions, parameters, knowns: vec!["q"] }
        }
        _ => {
            let (pitch, off, tilt) = (rng.decimal(0.01, 0.2), rng.decimal(-0.5, 0.5), rng.decimal(-0.4, 0.4));
            let [parent, child, gap] = if rng.below(2) == 0 {
                // The nut's frame stands `tilt` ahead.
                ["spindle", "nut", "abs(b - off - pitch * (atan2(sin(tilt), cos(tilt)) - a))"]
            } else {
                ["nut", "spindle", "abs(b + off + pitch * (a + atan2(sin(tilt), cos(tilt))))"]
            };
            let body = format!(
                "param pitch = {pitch}; param off = {off}; param tilt = {tilt};
                let bed = {ground};
                body spindle {{ mass: 1.0, inertia: diag(0.01, 0.01, 0.02) }}
                body nut {{ mass: 2.0, inertia: diag(0.01, 0.01, 0.02) }}
                joint a: Revolute {{ parent: bed, child: spindle, axis: Z }}
                joint b: Prismatic {{ parent: bed, child: nut, axis: Z }}
                #[cut] joint d: Screw {{ parent: {parent}.at(off * Z), child: {child}.rotated(Z, tilt), axis: Z, pitch: pitch }}
                output gap = {gap};
                solve (b) from d {{ }}"
            );
            let conditions = vec![["", ""]];
            let parameters = vec![("pitch", pitch), ("off", off), ("tilt", tilt)];
            Drawn { body, conditions, parameters, knowns: vec!["a"] }
        }
    }
}

/// Random loops with parameters far from the declared ones: signs flipped, tilts of several turns, threads of many turns.
/// Each stands closed on the branch that the condition names, or gives what is no number.

#[test]
fn parameters_far_away_are_never_wrong() {
    let (mut closed, mut nothing, mut refused) = (0, 0, 0);
    let mut rng = Rng::new(11);
    let models = std::env::var("BRANCH_MODELS").ok().and_then(|n| n.parse().ok()).unwrap_or(24);
    for number in 0..models {
        let drawn = drawn(&mut rng, number % 4);
        let pair = drawn.conditions[rng.below(drawn.conditions.len())];
        for condition in pair {
            let terms: Vec<&str> = condition.split(", ").filter(|term| !term.is_empty()).collect();
            let held = match terms.is_empty() {
                true => "1.0".to_owned(),
                false => terms.iter().map(|term| format!("select({term}, 1.0, 0.0)")).collect::<Vec<_>>().join(" * "),
            };
            let body = drawn.body.replace("CONDITION", condition);
            let text = format!("formulation {{ constraints: Reduced }} output held = {held}; {body}");
            let machine = match machine(&text) {
                Ok(machine) => machine,
                // What holds on no branch everywhere is refused, with the branches.
                Err(error) => {
                    assert!(error.contains("satisf"), "{error}\n{text}");
                    refused += 1;
                    continue;
                }
            };
            for draw in 0..24 {
                let mut at = Values::new();
                for &(name, value) in &drawn.parameters {
                    let moved = match rng.below(4) {
                        0 => value,
                        1 => -value,
                        2 => value * rng.real(-3.0, 3.0),
                        _ => value + if name == "tilt" { rng.real(-30.0, 30.0) } else { rng.real(-0.5, 0.5) },
                    };
                    at.insert(name.to_owned(), moved);
                }
                for &known in &drawn.knowns {
                    at.insert(known.to_owned(), rng.real(-3.0, 3.0) * if number % 4 == 3 { 40.0 } else { 1.0 });
                }
                let (gap, held) = (machine.output("gap", &at), machine.output("held", &at));
                let a = machine.run(FunctionKind::ForwardDynamics, &at);
                if a.iter().any(|x| !x.is_finite()) {
                    nothing += 1;
                    continue;
                }
                closed += 1;
                assert!(gap < 1e-9 && held == 1.0, "{draw}: {at:?} gap {gap:e} held {held}\n{text}");
            }
        }
    }
    println!("{models} models: {closed} closed, {nothing} no number, {refused} refused");
    assert!(closed > 10 * models && refused * 3 < models * 2, "{closed} {nothing} {refused}");
}

/// What `Params::check` computes, and which of its tests fail.
fn failing(machine: &Machine, at: &Values) -> Vec<String> {
    let symbol = |symbol: Symbol| machine.value(symbol, at);
    let results = interpreter::run(&machine.compiled.checks.program, &symbol, &|_| f64::NAN);
    let mut results = results.into_iter();
    let mut list = Vec::new();
    for (what, condition, count) in &machine.compiled.checks.list {
        let values: Vec<f64> = results.by_ref().take(*count).collect();
        let holds = match condition {
            Condition::Finite => values.iter().all(|x| x.is_finite()),
            Condition::Pivot => values[0] > 64.0 * f64::EPSILON * values[1],
            Condition::Small => values.iter().all(|x| x.abs() < f64::EPSILON.sqrt()),
        };
        list.extend((!holds).then(|| what.clone()));
    }
    list
}

#[test]
fn parameters_are_tested_at_the_default_position() {
    let slide = machine("param m = 1.0; body b { mass: m } joint j: Prismatic { parent: ground, child: b, axis: Z }")
        .unwrap_or_else(|e| panic!("{e}"));
    assert!(failing(&slide, &values(&[])).is_empty());
    assert!(failing(&slide, &values(&[("m", 0.0)]))[0].contains("nothing resists `j`"));
    // A point at the end of a bar without length resists no turn.
    let arm = machine(
        "param l = 1.0; world { gravity: -9.81 * Y }
        body a { mass: 1.0, com: l * X } body b { mass: 1.0, com: l * X }
        joint one: Revolute { parent: ground, child: a, axis: Z }
        joint two: Revolute { parent: a.at(X), child: b, axis: Z }",
    )
    .unwrap_or_else(|e| panic!("{e}"));
    assert!(failing(&arm, &values(&[("l", 0.5)])).is_empty());
    assert!(failing(&arm, &values(&[("l", 0.0)]))[0].contains("nothing resists `two`"));
    // The pendulum's link is never so short that it doesn't reach, but when its length says so.
    let slider = |rest: &str| {
        machine(&format!(
            "param crank = 0.5; param coupler = 2.0; param off = 0.1;
            body one {{ mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }} body two {{ mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }}
            body three {{ mass: 1.0 }}
            joint a: Revolute {{ parent: ground, child: one, axis: Z }}
            joint b: Revolute {{ parent: one.at(crank * X), child: two, axis: Z }}
            joint c: Prismatic {{ parent: ground.at(off * Y), child: three, axis: X }}
            #[cut] joint d: Revolute {{ parent: two.at(coupler * X), child: three, axis: Z }}
            {rest} formulation {{ constraints: Reduced }}"
        ))
        .unwrap_or_else(|e| panic!("{e}"))
    };
    let found = slider("solve (b, c) from d { c > 0.3 }");
    assert!(failing(&found, &values(&[("off", -0.4)])).is_empty());
    assert!(failing(&found, &values(&[("off", 3.0)]))[0].contains("conditions of its `solve`"));
    assert!(failing(&found, &values(&[("coupler", 0.2), ("crank", 0.0)]))[0].contains("conditions of its `solve`"));
    // Formulas that hold for some lengths alone.
    let written = machine(
        "param left = 0.7; param right = 0.7;
        body s1 { mass: 0.1 } body s2 { mass: 0.1 } body plate { mass: 0.6, inertia: diag(1e-3, 1e-3, 2e-3) }
        joint px: Prismatic { parent: ground, child: s1, axis: X }
        joint py: Prismatic { parent: s1.at(0.7 * Y), child: s2, axis: Y }
        joint turn: Revolute { parent: s2, child: plate, axis: Z }
        constraint a: Rod { between: [ground, plate], length: left }
        constraint b: Rod { between: [ground.at(X), plate.at(X)], length: right }
        solve (turn) = (0.0); solve (py) from a { py > -0.7 }
        formulation { constraints: Reduced }",
    )
    .unwrap_or_else(|e| panic!("{e}"));
    assert!(failing(&written, &values(&[("left", 0.8), ("right", 0.8)])).is_empty());
    assert!(failing(&written, &values(&[("left", 0.8)]))[0].contains("does not hold with these parameters"));
}
