//! What the report proposes for loops that Newton's method closes: `solve` items that are pasted back into the text, compile, take what
//! was told, and give what Newton's method and multipliers give at poses near the default one.

use std::collections::HashMap;

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::loops::advice::{Closing, Figures};
use multibody_engine::model::types::Coordinate;
use multibody_engine::optimize::program::Compiled;
use multibody_engine::{Trouble, compile, emit};

use super::interpreter::run;
use super::support::{Case, Random, case_with, model_with};

/// A mechanism as its text, with places for what is pasted: `PART` in its part, `ITEMS` and `HANDLING` in the model.
#[derive(Clone, Copy)]
struct Mechanism<'a> {
    parts: &'a str,
    body: &'a str,
    /// Coordinates that stay in the state.
    independent: &'a str,
}

/// A line with the part in which it stands.
type Line = (Option<String>, String);

impl Mechanism<'_> {
    fn texts(&self, handling: &str, lines: &[Line]) -> (String, String) {
        let of = |wanted: bool| -> String {
            lines.iter().filter(|line| line.0.is_some() == wanted).map(|line| format!("{}\n", line.1)).collect()
        };
        let independent = if handling == "Reduced" { self.independent } else { "" };
        let formulation = format!("formulation {{ constraints: {handling}{independent} }}");
        let body = format!("{} {} {formulation} emit forward_dynamics, report;", self.body, of(false));
        (self.parts.replace("PART", &of(true)), body)
    }

    fn case(&self, handling: &str, lines: &[Line]) -> Case {
        let (parts, body) = self.texts(handling, lines);
        case_with(&parts, &body)
    }

    /// What the whole compiler says: lines with what is promised of them, the model's own figures, and its report.
    fn told(&self, handling: &str, lines: &[Line]) -> (Option<(Vec<Line>, Figures)>, Figures, String) {
        let (parts, body) = self.texts(handling, lines);
        let model = model_with(&parts, &body);
        let (structure, compiled) = match compile(&model) {
            Ok(done) => done,
            Err(Trouble::Complaints(list)) => panic!("{} in {body}", list[0].message),
            Err(_) => panic!("refused: {body}"),
        };
        let advice = structure.advice.clone().expect("advice");
        let report = emit::report(&model, &structure, &compiled);
        let lines = advice
            .solvable
            .map(|(lines, figures)| (lines.into_iter().map(|line| (line.part, line.text)).collect(), figures));
        (lines, advice.own.expect("figures"), report)
    }

    /// What is proposed, after it was pasted and compared; with what is left to Newton's method.
    fn check(&self, wanted: &[(Option<&str>, &str)], closing: Closing) {
        let (told, own, report) = self.told("Reduced", &[]);
        let (lines, promised) = told.unwrap_or_else(|| panic!("nothing is proposed: {report}"));
        let plain: Vec<(Option<&str>, &str)> = lines.iter().map(|line| (line.0.as_deref(), line.1.as_str())).collect();
        assert_eq!(plain, wanted);
        assert!(lines.iter().all(|line| report.contains(&format!("`{}`", line.1))), "{report}");
        assert_eq!((own.closing, promised.closing), (Closing::Newton, closing));
        assert!(promised.work < own.work);
        // Pasted, it takes what was told, and nothing is told again.
        let (again, found, _) = self.told("Reduced", &lines);
        assert_eq!(found, promised);
        assert_eq!(again, None);
        self.compare(&lines);
    }

    /// Of the same state in all three ways, with Newton's method from the default guess.
    fn compare(&self, lines: &[Line]) {
        let [newton, closed, kept] =
            [self.case("Reduced", &[]), self.case("Reduced", lines), self.case("Multipliers", &[])];
        let [by_newton, by_form, by_multipliers] = [&newton, &closed, &kept].map(Programs::of);
        let first = newton.structure.closed.first().expect("it closes");
        let guessed = newton.structure.guessed();
        let mut random = Random(0xC10_5ED);
        let mut compared = 0;
        for size in [0.0, 0.01, 0.03, 0.06, 0.1] {
            for _ in 0..3 {
                let mut values = Values::new();
                // Parameters too, at most states.
                for &symbol in &newton.derivation.symbols {
                    if let Symbol::Param { param, element } = symbol {
                        let value = newton.model.params[param].default[element];
                        values.insert(symbol, value + 0.3 * size * random.next() * value);
                    }
                }
                for &coordinate in &newton.structure.state {
                    values.insert(position(coordinate), size * random.next());
                    values.insert(velocity(coordinate), random.next());
                }
                for (index, &coordinate) in guessed.iter().enumerate() {
                    values.insert(Symbol::Guess { index }, first.value(&newton.model, coordinate).expect("a number"));
                }
                let found = by_newton.eval(FunctionKind::Guess, &values);
                if found[guessed.len()].is_nan() || found[guessed.len()] > 1e-12 {
                    continue;
                }
                let position_of: HashMap<Coordinate, f64> = guessed.iter().copied().zip(found).collect();
                // What is left to Newton's method with the closed forms starts at the same place.
                for (index, coordinate) in closed.structure.guessed().into_iter().enumerate() {
                    values.insert(Symbol::Guess { index }, position_of[&coordinate]);
                }
                let [got, want] = [&by_form, &by_newton].map(|one| one.eval(FunctionKind::ForwardDynamics, &values));
                // Behind the accelerations Newton's method tells what it has left.
                let count = newton.structure.state.len();
                close(&got[..count], &want[..count], 1e-7);
                let full = with_rates(&kept, &by_multipliers, &values, &position_of);
                let all = by_multipliers.eval(FunctionKind::ForwardDynamics, &full);
                let place = |c: &Coordinate| kept.structure.state.iter().position(|other| other == c).expect("kept");
                let own: Vec<f64> = newton.structure.state.iter().map(|c| all[place(c)]).collect();
                close(&got[..count], &own, 1e-7);
                compared += 1;
            }
        }
        assert!(compared >= 9, "{compared} states");
    }
}

fn close(got: &[f64], want: &[f64], tolerance: f64) {
    let size = want.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    assert_eq!(got.len(), want.len());
    for (a, b) in got.iter().zip(want) {
        assert!((a - b).abs() <= tolerance * size, "{got:?} is not {want:?}");
    }
}

type Values = HashMap<Symbol, f64>;

/// Functions as they are emitted.
struct Programs<'a> {
    case: &'a Case,
    compiled: Compiled,
}

impl Programs<'_> {
    fn of(case: &Case) -> Programs<'_> {
        let compiled = multibody_engine::optimize::compile(&case.derivation).unwrap_or_else(|_| panic!("too large"));
        Programs { case, compiled }
    }

    fn eval(&self, kind: FunctionKind, values: &Values) -> Vec<f64> {
        let value = |symbol: Symbol| match symbol {
            Symbol::Param { param, element } => {
                values.get(&symbol).copied().unwrap_or(self.case.model.params[param].default[element])
            }
            symbol => values.get(&symbol).copied().unwrap_or(0.0),
        };
        let fields = run(&self.compiled.prelude, &value, &|_| f64::NAN);
        let function = self.compiled.functions.iter().find(|f| f.kind == kind).expect("derived");
        run(&function.program, &value, &|field| fields[field.0])
    }
}

fn position(coordinate: Coordinate) -> Symbol {
    Symbol::Position { joint: coordinate.joint, component: coordinate.index }
}

fn velocity(coordinate: Coordinate) -> Symbol {
    Symbol::Velocity { joint: coordinate.joint, component: coordinate.index }
}

/// Positions of all coordinates, with rates of those that follow which keep the loops closed: by least squares.
fn with_rates(kept: &Case, programs: &Programs<'_>, values: &Values, follows: &HashMap<Coordinate, f64>) -> Values {
    let mut full = values.clone();
    full.extend(follows.iter().map(|(&coordinate, &x)| (position(coordinate), x)));
    let all = &kept.structure.state;
    let jacobian = programs.eval(FunctionKind::ConstraintJacobian, &full);
    let rows: Vec<&[f64]> = jacobian.chunks(all.len()).collect();
    let columns: Vec<usize> = (0..all.len()).filter(|&k| follows.contains_key(&all[k])).collect();
    let pairs = columns.iter().flat_map(|&i| columns.iter().map(move |&j| (i, j)));
    let normal: Vec<f64> = pairs.map(|(i, j)| rows.iter().map(|row| row[i] * row[j]).sum()).collect();
    for _ in 0..3 {
        let rate_of = |c: &Coordinate| full.get(&velocity(*c)).copied().unwrap_or(0.0);
        let rates: Vec<f64> = rows.iter().map(|row| row.iter().zip(all).map(|(a, c)| a * rate_of(c)).sum()).collect();
        let side = columns.iter().map(|&i| rows.iter().zip(&rates).map(|(row, r)| -row[i] * r).sum());
        let side: Vec<f64> = side.collect();
        let changes = multibody_engine::symbolic::evaluate::solve_f64(&normal, &side);
        for (&column, change) in columns.iter().zip(changes) {
            *full.entry(velocity(all[column])).or_default() += change;
        }
    }
    full
}

/// An oblique frame.
const FRAME: &str = "world { gravity: [1.0, -9.0, 2.0] }
    body base { mass: 1.0, inertia: diag(1.0, 1.1, 1.2) }
    joint mount: Fixed { parent: ground.rotated([1.0, 2.0, 2.0], 0.7), child: base }";

/// What stands in an oblique frame.
const BASE: &str = "world { gravity: [1.0, -9.0, 2.0] }
    body base { mass: 1.0, inertia: diag(1.0, 1.1, 1.2) }
    joint mount: Fixed { parent: ground.rotated([1.0, 2.0, 2.0], 0.7), child: base }
    body a { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 0.3, X) }
    body b { mass: 1.3, com: [0.3, 0.1, 0.0], inertia: diag(0.1, 0.2, 0.3) }
    body c { mass: 0.7, com: 0.2 * X, inertia: rod(0.7, 1.0, X) }";

/// Both ways to assemble it, with an axis that points backwards: the coupler's own zero is turned towards one or the other.
#[test]
fn four_bars_of_both_kinds() {
    for (turn, hand, wanted) in [
        ("-0.8", "-0.8", "sin(crank - coupler + rocker - 0.7707963267949) < 0.0"),
        ("0.8", "0.8", "sin(crank - coupler + rocker + 0.7707963267949) > 0.0"),
    ] {
        let body = format!(
            "{BASE} param l = 0.3; param reach = 0.9;
             joint crank: Revolute {{ parent: base, child: a, axis: -Z }}
             joint coupler: Revolute {{ parent: a.at(l * X).rotated(Z, {turn}), child: b, axis: Z }}
             joint rocker: Revolute {{ parent: base.at(1.0 * X + 0.1 * Y), child: c, axis: Z }}
             #[cut] joint pin: Revolute {{ parent: b.at(reach * X), child: c.at({hand} * Y), axis: Z }}"
        );
        let bars = Mechanism { parts: "", body: &body, independent: ", independent: [crank]" };
        let line = format!("solve (coupler, rocker) from pin {{ {wanted} }}");
        bars.check(&[(None, &line)], Closing::ClosedForm);
    }
}

#[test]
fn sliders_on_both_sides() {
    for way in ["l", "-l"] {
        let body = format!(
            "{BASE} param l = 0.7; param off = 0.02;
             joint crank: Revolute {{ parent: base, child: a, axis: -Z }}
             joint coupler: Revolute {{ parent: a.at(0.2 * X), child: b, axis: Z }}
             joint slide: Prismatic {{ parent: base.at(off * Y), child: c, axis: X }}
             #[cut] joint pin: Revolute {{ parent: b.at({way} * X), child: c, axis: Z }}"
        );
        let slider = Mechanism { parts: "", body: &body, independent: ", independent: [crank]" };
        let line = "solve (coupler, slide) from pin { cos(crank - coupler) > 0.0 }";
        slider.check(&[(None, line)], Closing::ClosedForm);
    }
}

/// The comparison sees the other branch.
#[test]
#[should_panic(expected = "is not")]
fn a_mirrored_slider_is_seen() {
    let body = format!(
        "{BASE} joint crank: Revolute {{ parent: base, child: a, axis: -Z }}
         joint coupler: Revolute {{ parent: a.at(0.2 * X), child: b, axis: Z }}
         joint slide: Prismatic {{ parent: base.at(0.02 * Y), child: c, axis: X }}
         #[cut] joint pin: Revolute {{ parent: b.at(0.7 * X), child: c, axis: Z }}"
    );
    let slider = Mechanism { parts: "", body: &body, independent: ", independent: [crank]" };
    slider.compare(&[(None, "solve (coupler, slide) from pin { cos(crank - coupler) < 0.0 }".to_owned())]);
}

/// Two solutions meet where the points of the arm stand in line, at an angle that no parameter changes.
#[test]
fn arms_with_offsets() {
    for (side, turn, wanted) in [
        ("0.1", "0.0", "sin(elbow - 0.0644268394256) < 0.0"),
        ("-0.5", "0.0", "sin(elbow - 0.0644268394256) < 0.0"),
        ("0.1", "1.5", "sin(elbow + 1.4355731605744) > 0.0"),
    ] {
        let body = format!(
            "{BASE} param off = 0.6;
             joint shoulder: Revolute {{ parent: base, child: a, axis: Z }}
             joint elbow: Revolute {{ parent: a.at([0.4, 0.05, 0.02]).rotated(Z, {turn}), child: b, axis: Z }}
             joint slide: Prismatic {{ parent: base.at([off, {side}, 0.0]), child: c, axis: Y }}
             #[cut] joint pin: Revolute {{ parent: b.at([0.5, 0.03, -0.02]), child: c, axis: Z }}"
        );
        let arm = Mechanism { parts: "", body: &body, independent: ", independent: [slide]" };
        let line = format!("solve (shoulder, elbow) from pin {{ {wanted} }}");
        arm.check(&[(None, &line)], Closing::ClosedForm);
    }
}

/// One loop behind the other: Watt's and Stephenson's six-bars.
#[test]
fn six_bars() {
    let first = "body d { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 1.0, X) }
        body e { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 1.0, X) }
        joint crank: Revolute { parent: base, child: a, axis: Z }
        joint coupler: Revolute { parent: a.at(0.3 * X).rotated(Z, PI / 4.0), child: b, axis: Z }
        joint rocker: Revolute { parent: base.at(1.0 * X + 0.1 * Y).rotated(Z, PI / 2.0), child: c, axis: Z }
        #[cut] joint pin: Revolute { parent: b.at(0.9 * X), child: c.at(0.8 * X), axis: Z }
        joint second: Revolute { parent: b.at(0.4 * X + 0.1 * Y), child: d, axis: Z }";
    let bar = "solve (coupler, rocker) from pin { sin(crank + coupler - rocker - 0.7853981633974483) < 0.0 }";
    for (third, sum, sign) in [
        ("c.at(0.5 * X - 0.2 * Y)", "crank + coupler - rocker + second - third - 0.7853981633974483", '<'),
        ("base.at(0.5 * X + 0.9 * Y)", "crank + coupler + second - third + 0.7853981633974483", '>'),
    ] {
        let body = format!(
            "{BASE} {first} joint third: Revolute {{ parent: {third}, child: e, axis: Z }}
             #[cut] joint last: Revolute {{ parent: d.at(0.7 * X), child: e.at(0.6 * X), axis: Z }}"
        );
        let bars = Mechanism { parts: "", body: &body, independent: ", independent: [crank]" };
        let line = format!("solve (second, third) from last {{ sin({sum}) {sign} 0.0 }}");
        bars.check(&[(None, bar), (None, &line)], Closing::ClosedForm);
    }
}

const PLATE: &str = "world { gravity: [1.0, -2.0, -9.0] }
    const FEET: [Vec3; 3] = [[-0.2, 0.1, -1.0], [0.2, 0.15, -1.2], [0.03, -0.25, -1.1]];
    const PINS: [Vec3; 3] = [[-0.25, 0.12, 0.0], [0.2, 0.1, 0.0], [0.03, -0.25, 0.0]];
    body plate { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }
    part legs: [leg; 3] = |i| leg { base: ground.at(FEET[i]).rotated(X, 0.2), tip: plate.at(PINS[i]) };";

/// One line for all legs, in the names of their part: slides along either way of their axis, and screws, whose turns count.
#[test]
fn legs_have_one_line() {
    for (joint, wanted) in [
        ("joint stroke: Prismatic { parent: cylinder.at(0.9 * Z), child: piston, axis: Z }", "stroke > -0.9"),
        ("joint stroke: Prismatic { parent: cylinder.at(0.9 * Z), child: piston, axis: -Z }", "stroke < 0.9"),
        ("joint stroke: Screw { parent: cylinder.at(0.9 * Z), child: piston, axis: Z, pitch: -0.1 }", "stroke < 9.0"),
        (
            "param drop = 0.9; joint stroke: Prismatic { parent: cylinder.at(drop * Z), child: piston, axis: Z }",
            "stroke > -drop",
        ),
    ] {
        let parts = format!(
            "mod leg {{ port base: Frame; port tip: Frame;
                body cylinder {{ mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.001) }}
                body piston {{ mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.001) }}
                joint gimbal: Universal {{ parent: base, child: cylinder, axes: [X, Y] }}
                {joint}
                #[cut] joint ball: Ball {{ parent: piston, child: tip }} PART }}"
        );
        let platform = Mechanism { parts: &parts, body: PLATE, independent: ", independent: [plate]" };
        let line = format!("solve (gimbal, stroke) from ball {{ cos(gimbal.second) > 0.0, {wanted} }}");
        platform.check(&[(Some("leg"), &line)], Closing::ClosedForm);
    }
}

/// Parts that are assembled in different ways have lines of their own, in the model.
#[test]
fn what_differs_between_parts_has_full_names() {
    let parts = "mod bars { port left: Frame; port right: Frame; param l = 0.4;
        body a { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 0.3, X) }
        body b { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 1.0, X) }
        body c { mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 1.0, X) }
        joint p: Revolute { parent: left, child: a, axis: Z }
        joint q: Revolute { parent: a.at(l * X), child: b, axis: Z }
        joint r: Revolute { parent: right, child: c, axis: Z }
        #[cut] joint pin: Revolute { parent: b.at(0.9 * X), child: c.at(0.8 * X), axis: Z } PART }";
    let body = format!(
        "{FRAME} part one: bars {{ left: base, right: base.at(X) }};
         part two: bars {{ left: base.at(3.0 * X), right: base.at(2.0 * X) }};"
    );
    let both = Mechanism { parts, body: &body, independent: ", independent: [one.p, two.p]" };
    let one = "solve (one.q, one.r) from one.pin { sin(one.p + one.q - one.r) < 0.0 }";
    let two = "solve (two.q, two.r) from two.pin { sin(two.p + two.q - two.r) > 0.0 }";
    both.check(&[(None, one), (None, two)], Closing::ClosedForm);
}

/// A rod holds a hinge: no angle tells the solutions apart, but on which side of the arm its far end lies.
#[test]
fn a_rod_has_a_side() {
    for (length, turn, sign) in [("0.95", "0.0", '<'), ("0.95", "2.8", '>'), ("0.7", "0.1", '<')] {
        let body = format!(
            "{BASE} param l = {length}; param arm = 0.25;
             joint driver: Revolute {{ parent: base, child: a, axis: Z }}
             joint idle: Revolute {{ parent: base, child: c, axis: Y }}
             joint shaft: Revolute {{ parent: base.at([0.8, 0.1, 0.2]).rotated(Y, {turn}), child: b.at(0.1 * Y), axis: Y }}
             constraint link: Rod {{ between: [a.at(0.3 * Y), b.at(arm * X + 0.1 * Z)], length: l }}"
        );
        let rods = Mechanism { parts: "", body: &body, independent: ", independent: [driver, idle]" };
        let from = |end: &str| format!("b.at(0.1 * Y).express({end}.position - b.at(0.1 * Y).position)");
        let [near, far] = ["b.at(arm * X + 0.1 * Z)", "a.at(0.3 * Y)"].map(from);
        let line = format!("solve (shaft) from link {{ dot(Y, cross({near}, {far})) {sign} 0.0 }}");
        rods.check(&[(None, &line)], Closing::ClosedForm);
    }
}

/// In a part that has both ends of the rod all names are its own, parameters among them.
#[test]
fn rods_of_parts_have_one_line() {
    let parts = "mod lever { port base: Frame; param l = 0.3; param r = 0.8;
        body arm { mass: 1.0, com: 0.1 * X, inertia: diag(0.1, 0.2, 0.3) }
        body bar { mass: 1.0, com: 0.1 * X, inertia: diag(0.1, 0.2, 0.3) }
        joint hinge: Revolute { parent: base, child: arm, axis: Y }
        joint swing: Revolute { parent: base.at([0.7, 0.1, 0.2]), child: bar, axis: Z }
        constraint link: Rod { between: [arm.at(l * X), bar.at((l + 0.1) * Y - 0.2 * Z)], length: r } PART }";
    let body = format!("{FRAME} part all: [lever; 2] = |i| lever {{ base: base.at(2.0 * i * X) }};");
    let levers = Mechanism { parts, body: &body, independent: ", independent: [all[0].hinge, all[1].hinge]" };
    let from = |end: &str| format!("bar.express({end}.position - bar.position)");
    let [near, far] = ["bar.at((l + 0.1) * Y - 0.2 * Z)", "arm.at(l * X)"].map(from);
    let line = format!("solve (swing) from link {{ dot(Z, cross({near}, {far})) > 0.0 }}");
    levers.check(&[(Some("lever"), &line)], Closing::ClosedForm);
}

/// A Delta robot on rods: its plate doesn't turn, and then one rod of each pair gives its arm.
#[test]
fn a_delta_on_rods() {
    let parts = "mod limb { port hip: Frame; port left: Frame; port right: Frame;
        body arm { mass: 0.3, com: 0.15 * X, inertia: diag(0.0001, 0.003, 0.003) }
        joint shoulder: Revolute { parent: hip, child: arm, axis: Y }
        constraint rod_a: Rod { between: [arm.at(0.3 * X + 0.05 * Y), left], length: 0.8 }
        constraint rod_b: Rod { between: [arm.at(0.3 * X - 0.05 * Y), right], length: 0.8 } PART }";
    let body = "world { gravity: [1.0, -2.0, -9.0] }
        body base { mass: 3.0, inertia: diag(1.0, 1.1, 1.2) }
        joint mount: Fixed { parent: ground.rotated([1.0, 2.0, 2.0], 0.7), child: base }
        body plate { mass: 0.5, inertia: diag(0.001, 0.001, 0.002) }
        joint moves: Free { parent: base.at(-0.6 * Z), child: plate, coordinates: RollPitchYaw }
        part limbs: [limb; 3] = |i| limb {
            hip: base.rotated(Z, i * 2.0 * PI / 3.0).at(0.2 * X),
            left: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X + 0.05 * Y),
            right: plate.rotated(Z, i * 2.0 * PI / 3.0).at(0.05 * X - 0.05 * Y),
        };";
    let delta = Mechanism { parts, body, independent: ", independent: [moves.x, moves.y, moves.z]" };
    let side = |i: usize| {
        let arm = format!("limbs[{i}].arm");
        let from = |end: &str| format!("{arm}.express({end}.position - {arm}.position)");
        let far = format!("plate.rotated(Z, {i}.0 * 2.0 * PI / 3.0).at(0.05 * X + 0.05 * Y)");
        let [near, far] = [format!("{arm}.at(0.3 * X + 0.05 * Y)"), far].map(|end| from(&end));
        format!("solve (limbs[{i}].shoulder) from limbs[{i}].rod_a {{ dot(Y, cross({near}, {far})) > 0.0 }}")
    };
    let flat = "solve (moves.roll, moves.pitch, moves.yaw) = (0.0, 0.0, 0.0);".to_owned();
    let lines: Vec<String> = [flat].into_iter().chain((0..3).map(side)).collect();
    let lines: Vec<(Option<&str>, &str)> = lines.iter().map(|line| (None, line.as_str())).collect();
    delta.check(&lines, Closing::ClosedForm);
}

/// A link between two points in space, whose ends turn as they like: the arm's side and the link's gimbal.
/// Three rods that give the place of a plate together, on one side of the plane of their other ends.
#[test]
fn three_rods_have_a_side() {
    for (turn, side) in [("0.5", ">"), ("-0.5", "<")] {
        let body = format!(
            "{BASE} param reach = 0.8123456789012345; body plate {{ mass: 0.8, com: 0.02 * Y, inertia: diag(0.01, 0.02, 0.02) }}
            body along {{ mass: 0.2 }} body across {{ mass: 0.3 }}
            joint first: Revolute {{ parent: base.at(0.2 * X), child: a, axis: Y }}
            joint second: Revolute {{ parent: base.rotated(Z, 2.1).at(0.21 * X), child: b, axis: [0.1, 1.0, 0.0] }}
            joint third: Revolute {{ parent: base.rotated(Z, -2.1).at(0.19 * X), child: c, axis: Y }}
            joint x: Prismatic {{ parent: base, child: along, axis: [1.0, 0.2, 0.1] }}
            joint y: Prismatic {{ parent: along, child: across, axis: Y }}
            joint z: Prismatic {{ parent: across.at({turn} * Z), child: plate, axis: [0.1, 0.0, 1.0] }}
            constraint one: Rod {{ between: [a.at(0.3 * X), plate.at(0.05 * X)], length: reach }}
            constraint two: Rod {{ between: [plate.at([-0.03, 0.04, 0.0]), b.at([0.3, 0.0, 0.01])], length: 0.79 }}
            constraint three: Rod {{ between: [c.at(0.3 * X), plate.at([-0.03, -0.04, 0.01])], length: 0.8 }}"
        );
        let plates = Mechanism { parts: "", body: &body, independent: ", independent: [first, second, third]" };
        let line = format!(
            "solve (x, y, z) from (one, two, three) {{ dot(cross(plate.at(0.05 * X).position - a.at(0.3 * X).position, \
            plate.at([-0.03, 0.04, 0.0]).position - b.at([0.3, 0.0, 0.01]).position), \
            plate.at([-0.03, -0.04, 0.01]).position - c.at(0.3 * X).position) {side} 0.0 }}"
        );
        plates.check(&[(None, &line)], Closing::ClosedForm);
    }
}

#[test]
fn a_link_in_space() {
    let body = format!(
        "{BASE} param tilt = 0.0;
         joint crank: Revolute {{ parent: base.rotated(X, tilt), child: a, axis: [0.1, 0.2, 1.0] }}
         joint elbow: Universal {{ parent: a.at(0.2 * X), child: b, axes: [Z, Y] }}
         joint rocker: Revolute {{ parent: base.at([0.6, 0.2, 0.1]), child: c, axis: [0.3, 1.0, 0.1] }}
         #[cut] joint pin: Ball {{ parent: b.at(0.7 * X), child: c.at(0.4 * Z) }}"
    );
    let link = Mechanism { parts: "", body: &body, independent: ", independent: [crank]" };
    let from = |end: &str| format!("c.express({end}.position - c.position)");
    let side = format!("dot([0.3, 1.0, 0.1], cross({}, {}))", from("c.at(0.4 * Z)"), from("a.at(0.2 * X)"));
    let line = format!("solve (elbow, rocker) from pin {{ cos(elbow.second) > 0.0, {side} < 0.0 }}");
    link.check(&[(None, &line)], Closing::ClosedForm);
}

/// A dead centre says nothing of a branch, nor does a default position in which loops don't close.
#[test]
fn nothing_is_proposed_without_a_branch() {
    let bars = |foot: &str| {
        let body = format!(
            "{BASE} joint crank: Revolute {{ parent: base, child: a, axis: Z }}
             joint coupler: Revolute {{ parent: a.at(0.3 * X), child: b, axis: Z }}
             joint rocker: Revolute {{ parent: base.at({foot}), child: c, axis: Z }}
             #[cut] joint pin: Revolute {{ parent: b.at(0.9 * X), child: c.at(0.4 * X), axis: Z }}"
        );
        let bars = Mechanism { parts: "", body: &body, independent: ", independent: [crank]" };
        let (told, own, _) = bars.told("Reduced", &[]);
        assert_eq!(own.closing, Closing::Newton);
        told.map(|told| told.0)
    };
    assert_eq!(bars("[0.3 + 1.3 * 0.6, 1.3 * 0.8, 0.0]"), None);
    assert_eq!(bars("[-1.2, 0.05, 0.0]"), None);
    assert!(bars("[0.3 + 1.2 * 0.6, 1.2 * 0.8, 0.0]").is_some());
}

/// The choice stays what it was, and says what it would be.
#[test]
fn what_auto_would_take() {
    let body = format!(
        "{BASE} joint crank: Revolute {{ parent: base, child: a, axis: Z }}
         joint coupler: Revolute {{ parent: a.at(0.3 * X), child: b, axis: Z }}
         joint rocker: Revolute {{ parent: base.at(1.0 * X + 0.1 * Y), child: c, axis: Z }}
         #[cut] joint pin: Revolute {{ parent: b.at(0.9 * X), child: c.at(0.8 * X), axis: Z }}"
    );
    let bars = Mechanism { parts: "", body: &body, independent: "" };
    let (told, own, report) = bars.told("Auto", &[]);
    let (lines, promised) = told.expect("a proposal");
    assert_eq!((own.closing, promised.closing), (Closing::Multipliers, Closing::ClosedForm));
    assert!(report.contains("`constraints: Auto` would be `Reduced` with that"), "{report}");
    let (again, found, _) = bars.told("Auto", &lines);
    assert_eq!((again, found), (None, promised));
}
