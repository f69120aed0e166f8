//! Equations against compiled functions: a page is read from its first line to its last, each line giving the value of its left
//! side, and what comes out must be what the generated functions give.

use std::collections::HashMap;

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::loops::structure::{Role, Structure};
use multibody_engine::mechanics::written::{Line, Page, Subject};
use multibody_engine::mechanics::{self, freedoms};
use multibody_engine::model::types::{Coordinate, JointId, Model, Request};
use multibody_engine::optimize::program::Compiled;
use multibody_engine::symbolic::write::formula::{Formula, Identifier};

use crate::values::{Known, value};
use crate::{corpus, interpreter};

/// Larger models are left to the long run, `WRITTEN=1000`.
const MOST_FREEDOMS: usize = 7;
/// States at which a model is looked at.
const STATES: usize = 2;
/// Of the greatest entry: what is written apart is rounded elsewhere.
const TOLERANCE: f64 = 1e-9;

/// Fractions between minus one and one.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

struct Subjected<'a> {
    model: &'a Model,
    structure: Structure,
    compiled: Compiled,
    page: Page,
}

/// Values of symbols at a state, near a configuration in which loops are closed.
fn state(of: &Subjected<'_>, random: &mut Random) -> HashMap<Symbol, f64> {
    let mut quaternions: HashMap<JointId, f64> = HashMap::new();
    let mut found = HashMap::new();
    for (_, symbol) in &of.page.symbols {
        let draw = random.unit();
        let value = match *symbol {
            Symbol::Param { param, element } => of.model.params[param].default[element],
            Symbol::Position { joint, component } => {
                let closed = of.structure.closed.first().and_then(|c| c.positions[joint.0].get(component)).copied();
                let kind = of.model.joints[joint].kind;
                match kind.has_quaternion() && component >= kind.turning().start {
                    true => {
                        let x = closed.unwrap_or(0.0) + 0.4 * draw;
                        *quaternions.entry(joint).or_default() += x * x;
                        x
                    }
                    false => closed.unwrap_or(0.0) + if of.structure.closed.is_empty() { draw } else { 0.05 * draw },
                }
            }
            _ => draw,
        };
        found.insert(*symbol, value);
    }
    for (symbol, value) in &mut found {
        if let Symbol::Position { joint, component } = *symbol
            && component >= of.model.joints[joint].kind.turning().start
            && let Some(square) = quaternions.get(&joint)
        {
            *value /= square.sqrt();
        }
    }
    found
}

fn run(of: &Subjected<'_>, kind: FunctionKind, at: &HashMap<Symbol, f64>) -> Option<Vec<f64>> {
    let function = of.compiled.functions.iter().find(|f| f.kind == kind)?;
    let symbols = |symbol: Symbol| at.get(&symbol).copied().unwrap_or(f64::NAN);
    let fields = interpreter::run(&of.compiled.prelude, &symbols, &|_| f64::NAN);
    Some(interpreter::run(&function.program, &symbols, &|field| fields[field.0]))
}

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
}

fn read(of: &Subjected<'_>, at: &HashMap<Symbol, f64>) -> Read {
    let mut known: Known = of
        .page
        .symbols
        .iter()
        .filter(|(_, symbol)| !follows(of, *symbol))
        .map(|(name, symbol)| (name.clone(), at[symbol]))
        .collect();
    let mut sides = Vec::new();
    let mut cosines: HashMap<Coordinate, f64> = HashMap::new();
    for line in of.page.sections.iter().flat_map(|section| &section.lines) {
        if matches!(line.subject, Subject::Motion(_)) {
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
    let rows = lines(&of.page).filter(|line| matches!(line.subject, Subject::Motion(_)));
    let motion = rows.map(|line| value(&line.equation.left, &known) - value(&line.equation.right, &known)).collect();
    Read { sides, motion }
}

fn lines(page: &Page) -> impl Iterator<Item = &Line> {
    page.sections.iter().flat_map(|section| &section.lines)
}

/// Whether a symbol has an equation on the page, or none at all.
fn follows(of: &Subjected<'_>, symbol: Symbol) -> bool {
    let (joint, component) = match symbol {
        Symbol::Position { joint, component }
        | Symbol::Velocity { joint, component }
        | Symbol::Acceleration { joint, component } => (joint, component),
        _ => return false,
    };
    let size = of.model.joints[joint].kind.freedoms();
    of.structure.role(Coordinate { joint, index: component.min(size.saturating_sub(1)) }) != Role::State
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
fn look(of: &Subjected<'_>, label: &str, findings: &mut Findings) -> usize {
    let n = of.structure.state.len();
    let mut random = Random(11);
    let mut looked = 0;
    for _ in 0..40 {
        let at = state(of, &mut random);
        let Some(mass) = run(of, FunctionKind::MassMatrix, &at) else { return 0 };
        let bias = run(of, FunctionKind::Bias, &at).unwrap();
        let read = read(of, &at);
        if mass.iter().chain(&bias).any(|x| !x.is_finite() || x.abs() > 1e6) {
            continue;
        }
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
        let residual =
            run(of, FunctionKind::Residual, &at).or_else(|| run(of, FunctionKind::InverseDynamics, &at)).unwrap();
        compare("equations of motion", &read.motion, &residual[..n], findings, label);
        if let Some(gaps) = run(of, FunctionKind::Constraints, &at) {
            let own: Vec<f64> =
                read.sides.iter().filter(|(s, _)| matches!(s, Subject::Constraint(_))).map(|entry| entry.1).collect();
            compare("constraints", &own, &gaps, findings, label);
            let jacobian = run(of, FunctionKind::ConstraintJacobian, &at).unwrap();
            let mut own = vec![0.0; jacobian.len()];
            for &(subject, x) in &read.sides {
                if let Subject::Slope(i, j) = subject {
                    own[i * n + j] = x;
                }
            }
            compare("Jacobian", &own, &jacobian, findings, label);
        }
        if let Some(outputs) = run(of, FunctionKind::Outputs, &at) {
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
        if looked == STATES {
            break;
        }
    }
    looked
}

#[test]
fn pages_say_what_functions_compute() {
    let most = std::env::var("WRITTEN").ok().and_then(|text| text.parse().ok()).unwrap_or(MOST_FREEDOMS);
    let (mut models, mut looked, mut findings) = (0, 0, Findings::default());
    let mut unseen = Vec::new();
    for (file, call) in corpus::calls() {
        for mut model in corpus::models(call) {
            let label = format!("{file}: {}", model.name);
            if freedoms(&model) > most {
                continue;
            }
            model.emit = vec![Request::MassMatrix, Request::Bias, Request::InverseDynamics];
            let Ok(structure) = mechanics::analysis::analyse(&model) else { continue };
            if !structure.rows.is_empty() {
                model.emit.push(Request::Residual);
            }
            let iterates = structure.guesses() > 0;
            model.solve_for.clear();
            let Ok((structure, compiled)) = multibody_engine::compile(&model) else { continue };
            let Ok(page) = mechanics::page(&model, &structure) else { panic!("{label}: no page") };
            models += 1;
            // What Newton's method finds has no formula.
            if iterates
                || structure.roles.iter().flatten().any(|role| matches!(role, Role::Driven(_)))
                    && model.drives.is_empty()
            {
                continue;
            }
            let of = Subjected { model: &model, structure, compiled, page };
            match look(&of, &label, &mut findings) {
                0 => unseen.push(label),
                _ => looked += 1,
            }
        }
    }
    println!("{models} pages, {looked} looked at, worst {:.1e}; not: {unseen:?}", findings.worst);
    assert!(findings.wrong.is_empty(), "{:#?}", findings.wrong);
    assert!(looked > 60, "{looked} of {models}");
}
