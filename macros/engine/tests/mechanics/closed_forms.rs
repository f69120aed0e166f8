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
        let lines = advice.solvable.map(|(lines, figures)| {
            (lines.into_iter().map(|line| (line.part, line.text)).collect(), figures)
        });
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
                let (got, want) = [&by_form, &by_newton].map(|one| one.eval(FunctionKind::ForwardDynamics, &values)).into();
                close(&got, &want, 1e-7);
                let full = with_rates(&kept, &by_multipliers, &values, &position_of);
                let all = by_multipliers.eval(FunctionKind::ForwardDynamics, &full);
                let place = |c: &Coordinate| kept.structure.state.iter().position(|other| other == c).expect("kept");
                let own: Vec<f64> = newton.structure.state.iter().map(|c| all[place(c)]).collect();
                close(&got[..own.len()], &own, 1e-7);
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
        assert!((a - b).abs() <= tolerance * size, "{got:?} {want:?}");
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
            Symbol::Param { param, element } => self.case.model.params[param].default[element],
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

/// A four-bar in an oblique frame with parameters: `crank` and where the rocker stands decide how it is assembled.
fn four_bar(foot: &str) -> String {
    format!(
        "world {{ gravity: [1.0, -9.0, 2.0] }} param crank_length = 0.3; param reach = 0.9;
         body base {{ mass: 1.0, inertia: diag(1.0, 1.1, 1.2) }}
         joint mount: Fixed {{ parent: ground.rotated([1.0, 2.0, 2.0], 0.7), child: base }}
         body a {{ mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 0.3, X) }}
         body b {{ mass: 1.3, com: [0.3, 0.1, 0.0], inertia: diag(0.1, 0.2, 0.3) }}
         body c {{ mass: 0.7, com: 0.2 * X, inertia: rod(0.7, 1.0, X) }}
         joint crank: Revolute {{ parent: base, child: a, axis: -Z }}
         joint coupler: Revolute {{ parent: a.at(crank_length * X), child: b, axis: Z }}
         joint rocker: Revolute {{ parent: base.at({foot}), child: c, axis: Z }}
         #[cut] joint pin: Revolute {{ parent: b.at(reach * X), child: c.at(0.8 * X), axis: Z }}"
    )
}

/// Both ways to assemble it, with an axis that points backwards.
#[test]
fn four_bars_of_both_kinds() {
    for (foot, sign) in [("1.0 * X + 0.1 * Y", '>'), ("1.0 * X - 0.1 * Y", '<')] {
        let body = four_bar(foot);
        let bars = Mechanism { parts: "", body: &body, independent: ", independent: [crank]" };
        let line = format!("solve (coupler, rocker) from pin {{ sin(crank - coupler + rocker) {} 0.0 }}", turned(sign));
        bars.check(&[(None, &line)], Closing::ClosedForm);
    }
}

/// The sum that is written counts the other way about than the angle between coupler and rocker.
fn turned(sign: char) -> char {
    if sign == '>' { '<' } else { '>' }
}
