//! The whole engine on models whose results are known: the jury of `cargo xtask mutants`.
//!
//! It speaks as a test binary does, one line a model, so that it can stand in the place of one. Random mechanisms are judged
//! by their oracle. A model of the project is judged by what the same program has recorded of it: the first run with
//! `--record FOLDER` writes what functions give at a few points, later ones compare. `ok, other code` says that the numbers are
//! right and the emitted code is another one: what is different only costs.

use std::collections::hash_map::DefaultHasher;
use std::fs;
use std::hash::{Hash, Hasher};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::emit;
use multibody_engine::mechanics::loops::structure::Means;
use multibody_engine::model::types::{Coordinate, JointId};
use nalgebra::{DMatrix, DVector};

use crate::campaign::{Chains, Family, Limbs, Loops};
use crate::corpus;
use crate::oracle::Verdict;
use crate::programs::{Failure, Programs, Values, Way};

/// What it takes.
pub const USAGE: &str = "[--record FOLDER] [--exact NAME..]";

/// Seeds of random mechanisms.
const CHAINS: std::ops::Range<u64> = 1..61;
const LIMBS: std::ops::Range<u64> = 1..17;
const LOOPS: std::ops::Range<u64> = 35..61;

/// Of the numbers of a function, relative to the largest. Another formula for the same rounds otherwise.
const TOLERANCE: f64 = 1e-6;

/// How far a point is moved, relative to one and its values, to see which numbers hang on rounding, as those of a flat pose do.
const NOISE: f64 = 1e-11;

/// Runs the models that are named, or all, and says whether all are right.
pub fn run(arguments: &[String]) -> bool {
    let at = |name: &str| arguments.iter().position(|word| word == name);
    let record = at("--record").and_then(|k| arguments.get(k + 1)).map(PathBuf::from);
    let names: Vec<String> = match at("--exact") {
        Some(k) => arguments[k + 1..].to_vec(),
        None => names(),
    };
    std::panic::set_hook(Box::new(|_| {}));
    let mut all = true;
    for name in names {
        let judged = {
            let (name, record) = (name.clone(), record.clone());
            // What belongs to a thread belongs to a model.
            let thread = std::thread::Builder::new().name(name.clone()).stack_size(256 << 20);
            let thread = thread.spawn(move || judge(&name, record.as_deref()));
            thread.expect("a thread").join().unwrap_or(Judged::Wrong("panic".into()))
        };
        match judged {
            Judged::Right => println!("test {name} ... ok"),
            Judged::OtherCode => println!("test {name} ... ok, other code"),
            Judged::Wrong(why) => {
                println!("test {name} ... FAILED");
                eprintln!("{name}: {why}");
                all = false;
            }
        }
    }
    all
}

enum Judged {
    Right,
    OtherCode,
    Wrong(String),
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Families by seed, models of the project by file and name.
fn names() -> Vec<String> {
    let mut names: Vec<String> = CHAINS.map(|seed| format!("chains::{seed}")).collect();
    names.extend(LIMBS.map(|seed| format!("limbs::{seed}")));
    names.extend(LOOPS.map(|seed| format!("loops::{seed}")));
    for (file, call) in corpus::PLACES.iter().flat_map(|place| corpus::calls_of(&root(), place)) {
        names.extend(corpus::models(call).iter().map(|model| format!("{file}::{}", model.name)));
    }
    names.sort();
    names.dedup();
    names
}

fn judge(name: &str, record: Option<&Path>) -> Judged {
    let (group, item) = name.rsplit_once("::").expect("a name with a group");
    let found = match (group, item.parse()) {
        ("chains", Ok(seed)) => drawn(&Chains, seed),
        ("limbs", Ok(seed)) => drawn(&Limbs, seed),
        ("loops", Ok(seed)) => drawn(&Loops, seed),
        _ => catch_unwind(AssertUnwindSafe(|| declared(group, item))).unwrap_or(Found::bare("panic".into())),
    };
    let Some(folder) = record else { return if found.good() { Judged::Right } else { Judged::Wrong(found.class) } };
    let file = folder.join(name.replace(['/', ':'], "_"));
    match fs::read_to_string(&file) {
        Ok(text) => found.against(&Found::read(&text)),
        Err(_) => {
            fs::create_dir_all(folder).and_then(|()| fs::write(&file, found.write())).expect("a folder to write to");
            Judged::Right
        }
    }
}

/// What has come of a model.
#[derive(Debug)]
struct Found {
    class: String,
    /// A hash of what is emitted; nothing for random mechanisms.
    code: u64,
    /// Of each function at each point.
    numbers: Vec<Vec<f64>>,
}

impl Found {
    fn bare(class: String) -> Found {
        Found { class, code: 0, numbers: Vec::new() }
    }

    fn good(&self) -> bool {
        self.class == "right" || self.class.starts_with("true ")
    }

    fn write(&self) -> String {
        let line = |list: &Vec<f64>| list.iter().map(|x| format!("{x:e}")).collect::<Vec<_>>().join(" ") + "\n";
        format!("{}\n{}\n{}", self.class, self.code, self.numbers.iter().map(line).collect::<String>())
    }

    fn read(text: &str) -> Found {
        let mut lines = text.lines();
        let class = lines.next().expect("a class").to_owned();
        let code = lines.next().and_then(|line| line.parse().ok()).expect("a hash");
        let number = |word: &str| word.parse().expect("a number");
        Found { class, code, numbers: lines.map(|line| line.split_whitespace().map(number).collect()).collect() }
    }

    fn against(&self, recorded: &Found) -> Judged {
        if self.class != recorded.class {
            return Judged::Wrong(format!("{} for {}", self.class, recorded.class));
        }
        if self.numbers.len() != recorded.numbers.len() {
            return Judged::Wrong("not the same functions".into());
        }
        for (number, (found, want)) in self.numbers.iter().zip(&recorded.numbers).enumerate() {
            let size = size(want);
            // What has no value here by the engine as it is, or hangs on rounding, says nothing.
            let close = |(x, y): (&f64, &f64)| !y.is_finite() || (x - y).abs() <= TOLERANCE * size;
            if found.len() != want.len() || !found.iter().zip(want).all(close) {
                return Judged::Wrong(format!("list {number}: {found:?} for {want:?}"));
            }
        }
        if self.code == recorded.code { Judged::Right } else { Judged::OtherCode }
    }
}

/// The largest number; what is small beside nothing counts as zero.
fn size(list: &[f64]) -> f64 {
    list.iter().filter(|x| x.is_finite()).fold(1e-3_f64, |most, x| most.max(x.abs()))
}

fn drawn(family: &dyn Family, seed: u64) -> Found {
    let mechanism = family.draw(seed);
    let checked = catch_unwind(AssertUnwindSafe(|| family.check(&mechanism, seed)));
    let Ok(verdict) = checked else { return Found::bare("the oracle panicked".into()) };
    let excused = matches!(&verdict, Verdict::Refused(said) if family.excuses(&mechanism, seed, said));
    Found::bare(if excused { format!("true {}", verdict.class()) } else { verdict.class() })
}

fn declared(file: &str, name: &str) -> Found {
    let models = corpus::calls_of(&root(), file).into_iter().flat_map(|(_, call)| corpus::models(call));
    let model = models.into_iter().find(|model| model.name == name).expect("a model of the project");
    let programs = match Programs::of(model) {
        Ok(programs) => programs,
        Err(Failure::Refused(said)) => return Found::bare(format!("refused: {}", said.join("; "))),
        Err(failure) => return Found::bare(format!("{failure:?}")),
    };
    let mut hasher = DefaultHasher::new();
    emit::emit(&programs.model, &programs.structure, &programs.compiled).to_string().hash(&mut hasher);
    let held = !programs.structure.rows.is_empty();
    let free = programs.structure.state.len();
    let mut numbers = Vec::new();
    for seed in 0..2 {
        let mut point = Spot { programs: &programs, seed, noise: 0.0, velocities: None };
        if held {
            point.velocities = Some(point.admitted());
        }
        let beside = Spot { noise: NOISE, velocities: point.velocities.clone(), ..point };
        let whole = programs.compiled.functions.iter().map(|function| (Way::Model, function.kind));
        let behind = programs.behind().iter().map(|function| (Way::At, function.kind));
        for (way, kind) in whole.chain(behind) {
            // Beside what the state is, equations with multipliers have values that depend on the axes they are written in.
            let independent = [
                FunctionKind::ForwardDynamics,
                FunctionKind::MassMatrix,
                FunctionKind::MassMatrixLower,
                FunctionKind::KineticEnergy,
                FunctionKind::PotentialEnergy,
            ];
            if held && !independent.contains(&kind) {
                continue;
            }
            let run = |spot: &Spot<'_>| programs.run_by(way, kind, spot).expect("a function that is there");
            let (mut list, other) = (run(&point), run(&beside));
            let size = size(&list);
            for (value, other) in list.iter_mut().zip(other) {
                if (*value - other).abs() > 0.1 * TOLERANCE * size {
                    *value = f64::NAN;
                }
            }
            if held && kind == FunctionKind::ForwardDynamics {
                list.truncate(free);
            }
            numbers.push(list);
        }
    }
    Found { class: "right".into(), code: hasher.finish(), numbers }
}

/// A point of a declared model: loops are closed, velocities keep them so; the rest is arbitrary.
struct Spot<'a> {
    programs: &'a Programs,
    seed: u64,
    /// How far values are off, relative to one and their size.
    noise: f64,
    /// By coordinate of the state; nothing where all are possible.
    velocities: Option<Vec<f64>>,
}

impl Spot<'_> {
    /// Between -1 and 1.
    fn any(&self, symbol: Symbol) -> f64 {
        let mut hash = 0xcbf2_9ce4_8422_2325 ^ self.seed;
        for byte in format!("{symbol:?}").bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        // The last bytes count in the first bits too.
        hash = (hash ^ (hash >> 32)).wrapping_mul(0xd6e8_feb8_6659_fd93);
        (hash >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn position(&self, joint: JointId, component: usize) -> f64 {
        let structure = &self.programs.structure;
        let closed = structure.closed.first().and_then(|closed| closed.positions.get(joint.0)?.get(component));
        if let Some(&closed) = closed {
            return closed;
        }
        let kind = &self.programs.model.joints[joint].kind;
        let raw = |component| self.any(Symbol::Position { joint, component });
        let first = kind.freedoms().saturating_sub(3);
        if !kind.has_quaternion() || component < first {
            return raw(component);
        }
        raw(component) / (first..first + 4).map(|k| raw(k).powi(2)).sum::<f64>().sqrt()
    }

    /// Arbitrary velocities without the part that opens loops.
    fn admitted(&self) -> Vec<f64> {
        let symbol = |at: &Coordinate| Symbol::Velocity { joint: at.joint, component: at.index };
        let any = DVector::from_iterator(
            self.programs.structure.state.len(),
            self.programs.structure.state.iter().map(|at| self.any(symbol(at))),
        );
        let Some(slopes) = self.programs.run(FunctionKind::ConstraintJacobian, self) else {
            return vec![0.0; any.len()];
        };
        let slopes = DMatrix::from_row_slice(slopes.len() / any.len(), any.len(), &slopes);
        let opening =
            slopes.clone().svd(true, true).solve(&(slopes * &any), 1e-9).expect("both sides of the decomposition");
        (any - opening).as_slice().to_vec()
    }

    fn guess(&self, index: usize) -> f64 {
        for step in &self.programs.structure.steps {
            let Means::Newton { guess, .. } = step.means else { continue };
            if let Some(&Coordinate { joint, index }) = index.checked_sub(guess).and_then(|k| step.unknowns.get(k)) {
                return self.position(joint, index);
            }
        }
        f64::NAN
    }
}

impl Values for Spot<'_> {
    fn value(&self, symbol: Symbol, _: Option<&str>) -> f64 {
        let value = self.exactly(symbol);
        value + self.noise * (1.0 + value.abs()) * self.any(symbol)
    }
}

impl Spot<'_> {
    fn exactly(&self, symbol: Symbol) -> f64 {
        let structure = &self.programs.structure;
        match symbol {
            Symbol::Time => 0.4,
            Symbol::Param { param, element } => {
                let default = self.programs.model.params[param].default[element];
                // Loops are closed at the defaults.
                let moved = structure.closed.is_empty() && self.seed > 0;
                if moved { default * (1.0 + 0.02 * self.any(symbol)) } else { default }
            }
            Symbol::Position { joint, component } => self.position(joint, component),
            Symbol::Velocity { joint, component } if self.velocities.is_some() => {
                let at = structure.state.iter().position(|at| (at.joint, at.index) == (joint, component));
                self.velocities.as_ref().zip(at).map_or(f64::NAN, |(list, at)| list[at])
            }
            Symbol::Guess { index } => self.guess(index),
            other => self.any(other),
        }
    }
}
