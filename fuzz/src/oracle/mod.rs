//! What must hold, whatever the model.

pub mod excuses;
pub mod loops;
mod outputs;
mod speeds;
pub mod tree;

use std::collections::BTreeMap;
use std::fmt;

use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::optimize::Refusal;
use nalgebra::DMatrix;

use crate::mechanism::expression::Point;
use crate::programs::{Failure, Programs, Values, Way};

/// What became of a model.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// Everything agrees.
    Right(Compared),
    /// The compiler says no.
    Refused(Vec<String>),
    /// The compiler says that it has made an error: no reason excuses it.
    Engine(Refusal),
    /// The compiler has told what its optimiser made from the derived equations, and taken these.
    GivenBack,
    /// A panic.
    Panic,
    /// What, by how much, and where.
    Wrong(Vec<Fault>),
}

/// What has been looked at.
#[derive(Clone, Debug, Default)]
pub struct Compared {
    /// All numbers.
    pub numbers: usize,
    /// The same by what they are.
    pub kinds: BTreeMap<String, usize>,
    /// Those of functions that go on from what `Model::at` computes.
    pub at: usize,
    /// Those of lower triangles.
    pub triangles: usize,
    /// Whether limbs were computed together.
    pub packs: bool,
}

impl From<Failure> for Verdict {
    fn from(failure: Failure) -> Verdict {
        match failure {
            Failure::Refused(list) => Verdict::Refused(list),
            Failure::Engine(refusal) => Verdict::Engine(refusal),
            Failure::GivenBack => Verdict::GivenBack,
            Failure::Panic => Verdict::Panic,
        }
    }
}

/// Numbers that don't agree.
#[derive(Clone, Debug)]
pub struct Fault {
    /// Which function, against what.
    pub what: String,
    /// Difference over size.
    pub error: f64,
    /// What came and what should have come.
    pub detail: String,
}

impl Verdict {
    /// What minimising must keep: the kind of failure, and the first words of it.
    pub fn class(&self) -> String {
        match self {
            Verdict::Right(_) => "right".into(),
            Verdict::Refused(list) => {
                // Names and numbers differ from model to model.
                let text = list.first().cloned().unwrap_or_default();
                let mut class = String::new();
                for (k, part) in text.split('`').enumerate() {
                    class += if k % 2 == 0 { part } else { "_" };
                }
                let digits = |c: char| if c.is_ascii_digit() { '0' } else { c };
                format!("refused: {}", class.chars().map(digits).collect::<String>())
            }
            Verdict::Engine(refusal) => format!("engine: {refusal:?}"),
            Verdict::GivenBack => "engine: what the optimiser made was given back".into(),
            Verdict::Panic => "panic".into(),
            Verdict::Wrong(list) => {
                let text = list.first().map_or("", |fault| fault.what.as_str());
                format!("wrong: {}", text.split(|c: char| c.is_ascii_digit()).next().unwrap_or_default())
            }
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Right(compared) => write!(f, "right ({} numbers)", compared.numbers),
            Verdict::Refused(list) => write!(f, "refused: {}", list.join("; ")),
            Verdict::Engine(refusal) => write!(f, "the engine's own check: {refusal:?}"),
            Verdict::GivenBack => write!(f, "the engine's own check has given back what the optimiser made"),
            Verdict::Panic => write!(f, "panic"),
            Verdict::Wrong(list) => {
                for fault in list.iter().take(4) {
                    writeln!(f, "{}: error {:.2e}; {}", fault.what, fault.error, fault.detail)?;
                }
                Ok(())
            }
        }
    }
}

/// What is compared, without the number of its body.
fn kind(what: &str) -> String {
    let words = what.split(' ').filter(|word| !word.contains(|c: char| c.is_ascii_digit()));
    words.collect::<Vec<&str>>().join(" ")
}

/// Faults so far, and what was compared.
pub struct Findings {
    faults: Vec<Fault>,
    compared: Compared,
    /// Whose methods are looked at.
    way: Way,
    /// Of each output that reads multipliers how often these are known, and how often equations share the load there.
    loads: BTreeMap<usize, [usize; 2]>,
}

impl Findings {
    /// Nothing yet.
    pub fn new(programs: &Programs) -> Findings {
        let compared = Compared { packs: programs.has_packs(), ..Compared::default() };
        Findings { faults: Vec::new(), compared, way: Way::Model, loads: BTreeMap::new() }
    }

    /// Two lists, whose errors count in terms of `size`.
    pub fn compare(&mut self, what: &str, got: &[f64], want: &[f64], size: f64, tolerance: f64) {
        self.compared.numbers += got.len();
        *self.compared.kinds.entry(kind(what)).or_default() += got.len();
        let what = match self.way {
            Way::Model => what.to_owned(),
            Way::At => {
                self.compared.at += got.len();
                format!("at: {what}")
            }
        };
        if got.len() != want.len() {
            let detail = format!("{} numbers for {}", got.len(), want.len());
            self.faults.push(Fault { what, error: f64::INFINITY, detail });
            return;
        }
        let mut worst = (0.0_f64, 0);
        for (k, (a, b)) in got.iter().zip(want).enumerate() {
            let error = (a - b).abs() / size.max(1e-3);
            let error = if error.is_nan() { f64::INFINITY } else { error };
            if error > worst.0 {
                worst = (error, k);
            }
        }
        if worst.0 > tolerance {
            let k = worst.1;
            let detail = format!("number {k} of {}: {:e} for {:e}", got.len(), got[k], want[k]);
            self.faults.push(Fault { what, error: worst.0, detail });
        }
    }

    /// What is on and below the diagonal of a matrix, row by row.
    pub fn compare_lower(&mut self, got: &[f64], want: &DMatrix<f64>, size: f64, tolerance: f64) {
        self.compared.triangles += got.len();
        let rows = (0..want.nrows()).flat_map(|row| (0..=row).map(move |column| want[(row, column)]));
        self.compare("lower triangle of the mass matrix", got, &rows.collect::<Vec<f64>>(), size, tolerance);
    }

    /// What became of it.
    pub fn verdict(mut self) -> Verdict {
        // How equations that depend on each other everywhere share their load is not to be told.
        for (load, [known, shared]) in std::mem::take(&mut self.loads) {
            if known == 0 && shared > 4 {
                let detail = format!("load{load} is a number at {shared} states, and at none is it determined");
                self.faults.push(Fault { what: "a shared load".to_owned(), error: f64::INFINITY, detail });
            }
        }
        if self.faults.is_empty() { Verdict::Right(self.compared) } else { Verdict::Wrong(self.faults) }
    }
}

/// A point as symbols: what other symbols there are is NaN.
pub struct At<'a> {
    /// Coordinates, parameters, inputs.
    pub point: &'a Point,
    /// Momenta and impulses, joint by joint.
    pub momenta: Vec<Vec<f64>>,
}

impl<'a> At<'a> {
    /// Without momenta.
    pub fn new(point: &'a Point) -> At<'a> {
        At { point, momenta: Vec::new() }
    }
}

impl Values for At<'_> {
    fn value(&self, symbol: Symbol, joint: Option<&str>) -> f64 {
        let number = joint.and_then(|name| name.strip_prefix('j')).and_then(|text| text.parse::<usize>().ok());
        let of = |list: &[Vec<f64>], component: usize| {
            number.and_then(|k| list.get(k)).and_then(|list| list.get(component)).copied().unwrap_or(f64::NAN)
        };
        match symbol {
            Symbol::Time => self.point.time,
            Symbol::Param { param, .. } => self.point.params[param.0],
            Symbol::Input { input, .. } => self.point.inputs[input.0],
            Symbol::State { state } => self.point.states[state.0],
            Symbol::Position { component, .. } => of(&self.point.q, component),
            Symbol::Velocity { component, .. } => of(&self.point.v, component),
            Symbol::Acceleration { component, .. } => of(&self.point.a, component),
            Symbol::Impulse { component, .. } | Symbol::Momentum { component, .. } => of(&self.momenta, component),
            _ => f64::NAN,
        }
    }
}
