//! Equations against compiled functions: a page is read from its first line to its last, each line giving the value of its left
//! side, and what comes out must be what the generated functions give.

use std::collections::HashMap;

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::freedoms;
use multibody_engine::mechanics::written::{Line, Page, Subject};
use multibody_engine::model::types::Coordinate;
use multibody_engine::symbolic::write::formula::{Formula, Identifier};

use crate::corpus;
use crate::pages::{Random, Written};
use crate::values::{Known, value};

/// Larger models are left to the long run, `WRITTEN=1000`.
const MOST_FREEDOMS: usize = 7;
/// States at which a model is looked at.
const STATES: usize = 2;
/// Of the greatest entry: what is written apart is rounded elsewhere.
const TOLERANCE: f64 = 1e-9;

fn name(formula: &Formula) -> Option<&Identifier> {
    match formula {
        Formula::Name(name) => Some(name),
        _ => None,
    }
}

/// What a page comes to: right sides by subject, and what is left of equations of motion.
struct Read {
    sides: Vec<(Subject, f64)>,
    motion: Vec<f64>,
    /// What is left of what speeds stand for, and of equations of velocities, with the rates that follow from them.
    implied: Vec<f64>,
}

/// Whether a line says what rates obey that other lines give.
fn is_implicit(line: &Line) -> bool {
    matches!(line.subject, Subject::Speed(_) | Subject::Rolling(_))
}

fn read(of: &Written, at: &HashMap<Symbol, f64>) -> Read {
    let mut known: Known = of
        .page
        .symbols
        .iter()
        .filter(|(_, symbol)| !of.follows(*symbol))
        .map(|(name, symbol)| (name.clone(), at[symbol]))
        .collect();
    let (mut sides, mut implied) = (Vec::new(), Vec::new());
    let mut cosines: HashMap<Coordinate, f64> = HashMap::new();
    for line in of.page.sections.iter().flat_map(|section| &section.lines) {
        if matches!(line.subject, Subject::Motion(_)) {
            continue;
        }
        if is_implicit(line) {
            continue;
        }
        let right = value(&line.equation.right, &known);
        sides.push((line.subject, right));
        match (line.subject, &line.equation.left) {
            (Subject::Cosine(coordinate), _) => drop(cosines.insert(coordinate, right)),
            (Subject::Sine(coordinate), Formula::Apply(_, list)) => {
                let angle = right.atan2(cosines[&coordinate]);
                known.extend(name(&list[0]).map(|name| (name.clone(), angle)));
            }
            (_, left) => known.extend(name(left).map(|name| (name.clone(), right))),
        }
    }
    for line in lines(&of.page).filter(|line| is_implicit(line)) {
        let wanted = name(&line.equation.left).and_then(|name| known.get(name)).copied();
        implied.push(value(&line.equation.right, &known) - wanted.unwrap_or(0.0));
    }
    let rows = lines(&of.page).filter(|line| matches!(line.subject, Subject::Motion(_)));
    let motion = rows.map(|line| value(&line.equation.left, &known) - value(&line.equation.right, &known)).collect();
    Read { sides, motion, implied }
}

fn lines(page: &Page) -> impl Iterator<Item = &Line> {
    page.sections.iter().flat_map(|section| &section.lines)
}

/// What was found.
#[derive(Default)]
struct Findings {
    worst: f64,
    wrong: Vec<String>,
}

fn compare(what: &str, got: &[f64], want: &[f64], findings: &mut Findings, of: &str) {
    if got.len() != want.len() {
        findings.wrong.push(format!("{of}: {} {what} for {}", got.len(), want.len()));
        return;
    }
    let scale = want.iter().fold(1.0_f64, |r, x| r.max(x.abs()));
    for (k, (a, b)) in got.iter().zip(want).enumerate() {
        let error = (a - b).abs() / scale;
        findings.worst = findings.worst.max(error);
        if error.is_nan() || error > TOLERANCE {
            findings.wrong.push(format!("{of}: {what} {k} is {a:e} on the page and {b:e} compiled"));
        }
    }
}

/// By number of the subject.
fn chosen(read: &Read, f: impl Fn(Subject) -> Option<usize>) -> Vec<f64> {
    let mut list: Vec<(usize, f64)> = read.sides.iter().filter_map(|&(s, x)| Some((f(s)?, x))).collect();
    list.sort_by_key(|entry| entry.0);
    list.into_iter().map(|entry| entry.1).collect()
}

/// Compares one model; the number of states looked at.
fn look(of: &Written, label: &str, findings: &mut Findings) -> usize {
    let n = of.structure.freedoms();
    let mut random = Random(11);
    let mut looked = 0;
    while looked < STATES
        && let Some(at) = of.state(&mut random)
    {
        let mass = of.run(FunctionKind::MassMatrix, &at).unwrap();
        let bias = of.run(FunctionKind::Bias, &at).unwrap();
        let read = read(of, &at);
        let upper: Vec<f64> = (0..n).flat_map(|i| (i..n).map(move |j| (i, j))).map(|(i, j)| mass[i * n + j]).collect();
        let entries = chosen(&read, |s| if let Subject::Mass(i, j) = s { Some(i * n + j) } else { None });
        compare("mass matrix", &entries, &upper, findings, label);
        let parts = [
            chosen(&read, |s| if let Subject::Inertial(i) = s { Some(i) } else { None }),
            chosen(&read, |s| if let Subject::Gravity(i) = s { Some(i) } else { None }),
            chosen(&read, |s| if let Subject::Force(i) = s { Some(i) } else { None }),
        ];
        let sums: Vec<f64> = (0..n).map(|i| parts[0][i] + parts[1][i] - parts[2][i]).collect();
        compare("bias", &sums, &bias, findings, label);
        compare("equations of velocities", &read.implied, &vec![0.0; read.implied.len()], findings, label);
        compare("equations of motion", &read.motion, &of.motion(&at).unwrap(), findings, label);
        if let Some(gaps) = of.gaps(&at) {
            let own: Vec<f64> =
                read.sides.iter().filter(|(s, _)| matches!(s, Subject::Constraint(_))).map(|entry| entry.1).collect();
            compare("constraints", &own, &gaps, findings, label);
            let jacobian = of.run(FunctionKind::ConstraintJacobian, &at).unwrap();
            let mut own = vec![0.0; jacobian.len()];
            for &(subject, x) in &read.sides {
                if let Subject::Slope(i, j) = subject {
                    own[i * n + j] = x;
                }
            }
            compare("Jacobian", &own, &jacobian, findings, label);
        }
        if let Some(outputs) = of.run(FunctionKind::Outputs, &at) {
            // Accelerations and multipliers are the solution's there; what reads them can't be compared.
            let moved = at.iter().map(|(&symbol, &x)| match symbol {
                Symbol::Acceleration { .. } | Symbol::Multiplier { .. } => (symbol, x + 1.0),
                _ => (symbol, x),
            });
            let moved = self::read(of, &moved.collect());
            for (&(subject, x), other) in read.sides.iter().zip(&moved.sides) {
                if let Subject::Output(k) = subject
                    && x == other.1
                {
                    compare("output", &[x], &outputs[k..=k], findings, label);
                }
            }
        }
        looked += 1;
    }
    looked
}

#[test]
fn pages_say_what_functions_compute() {
    let most = std::env::var("WRITTEN").ok().and_then(|text| text.parse().ok()).unwrap_or(MOST_FREEDOMS);
    let (mut models, mut looked, mut in_speeds, mut findings) = (0, 0, 0, Findings::default());
    let mut unseen = Vec::new();
    for (file, call) in corpus::calls() {
        for model in corpus::models(call) {
            let label = format!("{file}: {}", model.name);
            if freedoms(&model) > most {
                continue;
            }
            models += 1;
            let Some(of) = Written::new(model, &[]) else { continue };
            match look(&of, &label, &mut findings) {
                0 => unseen.push(label),
                _ => {
                    looked += 1;
                    in_speeds += usize::from(of.structure.has_speeds());
                }
            }
        }
    }
    println!(
        "{models} models, {looked} pages looked at, {in_speeds} in speeds, worst {:.1e}; not: {unseen:?}",
        findings.worst
    );
    assert!(findings.wrong.is_empty(), "{:#?}", findings.wrong);
    assert!(looked > 60 && in_speeds >= 6, "{looked} of {models}, {in_speeds} in speeds");
}
