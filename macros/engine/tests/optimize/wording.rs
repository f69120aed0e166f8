//! Names of locals and fields that are operations in words are the operations that they name: `cos_shaft_times_0_04` is no
//! other number. Symbols have random values; every name that can be read as an operation on names that stand before it is
//! compared with what its statement computes.

use std::collections::HashMap;

use crate::corpus::{calls, models};
use crate::rng::Rng;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::{Derivation, of};
use multibody_engine::optimize::compile;
use multibody_engine::optimize::program::{Expression, Program, Sine, Statement};
use multibody_engine::symbolic::evaluate::call_f64;

/// Literals in names have three digits.
const TOLERANCE: f64 = 0.02;

/// Files of models that are derived in moments, with closed loops among them.
const FILES: [&str; 6] = [
    "tests/models/small.rs",
    "tests/models/motion.rs",
    "examples/models/double_pendulum.rs",
    "examples/models/slider_crank.rs",
    "examples/models/four_bar.rs",
    "tests/models/linkages.rs",
];

/// Words that do something to what follows or stands before them.
const BEFORE: [&str; 6] = ["minus", "twice", "half", "sin", "cos", "with"];
const BEHIND: [&str; 4] = ["squared", "cubed", "inv", "root"];

/// What is known of a program so far.
struct Reader<'a> {
    rng: Rng,
    symbol_names: HashMap<Symbol, &'a str>,
    symbols: HashMap<Symbol, f64>,
    fields: Vec<f64>,
    locals: Vec<f64>,
    /// Values by name.
    known: HashMap<String, f64>,
    /// Names that are not what they say.
    wrong: Vec<String>,
    read: usize,
}

impl Reader<'_> {
    fn draw(&mut self) -> f64 {
        self.rng.real(0.5, 2.0)
    }

    fn value(&mut self, expression: &Expression) -> f64 {
        match expression {
            Expression::Literal(x) => *x,
            Expression::Symbol(symbol) => self.symbol(*symbol),
            Expression::Field(field) => self.fields[field.0],
            Expression::Local(local) => self.locals[local.0],
            Expression::Neg(inner) => -self.value(inner),
            Expression::Sum(terms) => {
                terms.iter().map(|(minus, term)| self.value(term) * if *minus { -1.0 } else { 1.0 }).sum()
            }
            Expression::Product(list) => list.iter().map(|factor| self.value(factor)).product(),
            Expression::Quotient(a, b) => self.value(a) / self.value(b),
            Expression::Call(call, list) => {
                let list: Vec<f64> = list.iter().map(|argument| self.value(argument)).collect();
                call_f64(*call, &list)
            }
            Expression::Fused(_) | Expression::Pack(_) => panic!("nothing is fused or packed here"),
        }
    }

    fn symbol(&mut self, symbol: Symbol) -> f64 {
        let drawn = self.draw();
        // Names that other programs read are not known here.
        let value = *self.symbols.entry(symbol).or_insert(drawn);
        if let Some(name) = self.symbol_names.get(&symbol) {
            self.known.insert((*name).to_owned(), value);
        }
        value
    }

    /// The number that a name says, by the words from the loosest to the tightest.
    fn said(&self, words: &[&str]) -> Option<f64> {
        if matches!(words, ["sin" | "cos", "of", ..]) {
            return self.factor(words);
        }
        for at in (1..words.len()).rev().filter(|&at| matches!(words[at], "plus" | "minus")) {
            let (before, rest) = (&words[..at], &words[at + 1..]);
            let (Some(a), Some(b)) = (self.said(before), self.behind(before, rest)) else { continue };
            return Some(if words[at] == "plus" { a + b } else { a - b });
        }
        self.product(words)
    }

    fn product(&self, words: &[&str]) -> Option<f64> {
        if words.first() == Some(&"minus") && !self.known.contains_key(&words.join("_")) {
            return Some(-self.product(&words[1..])?);
        }
        for at in (1..words.len()).rev().filter(|&at| matches!(words[at], "times" | "over")) {
            let (before, rest) = (&words[..at], &words[at + 1..]);
            let (Some(a), Some(b)) = (self.product(before), self.factor_behind(before, rest)) else { continue };
            return Some(if words[at] == "times" { a * b } else { a / b });
        }
        self.factor(words)
    }

    fn factor(&self, words: &[&str]) -> Option<f64> {
        if let Some(&value) = self.known.get(&words.join("_")) {
            return Some(value);
        }
        match words {
            ["twice", rest @ ..] => Some(2.0 * self.factor(rest)?),
            ["half", rest @ ..] => Some(0.5 * self.factor(rest)?),
            ["minus", rest @ ..] => Some(-self.factor(rest)?),
            [rest @ .., "squared"] => Some(self.factor(rest)?.powi(2)),
            [rest @ .., "cubed"] => Some(self.factor(rest)?.powi(3)),
            [rest @ .., "inv"] => Some(1.0 / self.factor(rest)?),
            [rest @ .., "root"] => Some(self.factor(rest)?.sqrt()),
            ["sin", "of", rest @ ..] => Some(self.said(rest)?.sin()),
            ["cos", "of", rest @ ..] => Some(self.said(rest)?.cos()),
            ["sin", rest @ ..] => Some(self.factor(rest)?.sin()),
            ["cos", rest @ ..] => Some(self.factor(rest)?.cos()),
            [] => None,
            words => {
                let text = words.join(".");
                words[0].starts_with(|c: char| c.is_ascii_digit()).then(|| text.parse().ok())?
            }
        }
    }

    /// An operand that stands in the place of the last words of the one before, as `legs_0_x_times_y`.
    fn behind(&self, before: &[&str], words: &[&str]) -> Option<f64> {
        self.product(words).or_else(|| self.shortened(before, words))
    }

    fn factor_behind(&self, before: &[&str], words: &[&str]) -> Option<f64> {
        self.factor(words).or_else(|| self.shortened(before, words))
    }

    fn shortened(&self, before: &[&str], words: &[&str]) -> Option<f64> {
        let count = before.len().checked_sub(words.len()).filter(|count| *count > 0)?;
        let begin = &before[..count];
        let acts = |word: &&str| BEFORE.contains(word) || BEHIND.contains(word);
        if words.is_empty() || begin.iter().any(acts) { None } else { self.factor(&[begin, words].concat()) }
    }

    fn name(&mut self, place: &str, name: &str, value: f64) {
        let words: Vec<&str> = name.split('_').collect();
        let is_operation = words.len() > 1 && !self.known.contains_key(name);
        match self.said(&words).filter(|_| is_operation) {
            Some(said) => {
                self.read += 1;
                if (said - value).abs() > TOLERANCE * value.abs().max(1.0) {
                    self.wrong.push(format!("{place}: {name} says {said}, is {value}"));
                }
            }
            None => self.learn(name, value),
        }
    }

    /// With `minus_x` a reader knows `x`.
    fn learn(&mut self, name: &str, value: f64) {
        self.known.insert(name.to_owned(), value);
        if let Some(of) = name.strip_prefix("minus_") {
            self.known.entry(of.to_owned()).or_insert(-value);
        }
    }

    fn statements(&mut self, place: &str, program: &Program, statements: &[Statement]) {
        for statement in statements {
            statement.expressions().for_each(|expression| {
                self.touch(expression);
            });
            match statement {
                Statement::Let { local, value } => {
                    let number = self.value(value);
                    self.locals[local.0] = number;
                    let before = self.wrong.len();
                    self.name(place, &program.locals[local.0], number);
                    if self.wrong.len() > before {
                        let text = self.wrong.pop().unwrap();
                        let names = self.text(program, value);
                        self.wrong.push(format!("{text}: {names}"));
                    }
                }
                Statement::SinCos(sines) => {
                    for Sine { sin, cos, angle } in sines {
                        let angle = self.value(angle);
                        for (local, value) in [(sin, angle.sin()), (cos, angle.cos())] {
                            self.locals[local.0] = value;
                            self.name(place, program.locals[local.0].trim_start_matches('_'), value);
                        }
                    }
                }
                Statement::Solve { .. }
                | Statement::Called { .. }
                | Statement::Pack { .. }
                | Statement::PackSines(..)
                | Statement::Members { .. } => self.results(program, statement),
                Statement::Iterate { body, .. } => {
                    self.results(program, statement);
                    self.statements(place, program, body);
                }
            }
        }
    }

    /// What comes of a block is any number.
    fn results(&mut self, program: &Program, statement: &Statement) {
        for local in statement.defined() {
            let value = self.draw();
            self.locals[local.0] = value;
            self.learn(&program.locals[local.0], value);
        }
    }

    /// All symbols below have values and names.
    fn touch(&mut self, expression: &Expression) {
        match expression {
            Expression::Symbol(symbol) => {
                self.symbol(*symbol);
            }
            Expression::Literal(_) | Expression::Field(_) | Expression::Local(_) => {}
            Expression::Neg(inner) => self.touch(inner),
            Expression::Sum(terms) => terms.iter().for_each(|term| self.touch(&term.1)),
            Expression::Product(list) | Expression::Call(_, list) | Expression::Pack(list) => {
                list.iter().for_each(|one| self.touch(one));
            }
            Expression::Fused(operands) => operands.iter().for_each(|one| self.touch(one)),
            Expression::Quotient(a, b) => [a, b].into_iter().for_each(|one| self.touch(one)),
        }
    }

    fn text(&self, program: &Program, expression: &Expression) -> String {
        let list = |list: &[Expression], with: &str| {
            list.iter().map(|one| self.text(program, one)).collect::<Vec<_>>().join(with)
        };
        match expression {
            Expression::Literal(x) => x.to_string(),
            Expression::Symbol(symbol) => self.symbol_names.get(symbol).map_or("?".into(), |name| (*name).to_owned()),
            Expression::Field(field) => format!("self.{}", field.0),
            Expression::Local(local) => program.locals[local.0].clone(),
            Expression::Neg(inner) => format!("-{}", self.text(program, inner)),
            Expression::Sum(terms) => {
                let text = |(minus, term): &(bool, Expression)| {
                    format!("{}{}", if *minus { "- " } else { "+ " }, self.text(program, term))
                };
                format!("({})", terms.iter().map(text).collect::<Vec<_>>().join(" "))
            }
            Expression::Product(factors) => list(factors, " * "),
            Expression::Quotient(a, b) => format!("{} / {}", self.text(program, a), self.text(program, b)),
            Expression::Fused(operands) => format!("fused({})", list(&operands[..], ", ")),
            Expression::Call(call, arguments) => format!("{call:?}({})", list(arguments, ", ")),
            Expression::Pack(members) => format!("[{}]", list(members, ", ")),
        }
    }
}

/// How many names were read as operations, and those that are others.
fn read(place: &str, derivation: &Derivation) -> (usize, Vec<String>) {
    let compiled = compile(derivation).expect("programs");
    let names = derivation.symbols.iter().zip(&derivation.symbol_names).filter(|(_, name)| !name.is_empty());
    let mut reader = Reader {
        rng: Rng::new(7),
        symbol_names: names.map(|(symbol, name)| (*symbol, name.as_str())).collect(),
        symbols: HashMap::new(),
        fields: Vec::new(),
        locals: vec![f64::NAN; compiled.prelude.locals.len()],
        known: HashMap::new(),
        wrong: Vec::new(),
        read: 0,
    };
    reader.statements(place, &compiled.prelude, &compiled.prelude.statements);
    let mut fields: HashMap<String, f64> = HashMap::new();
    for (name, result) in compiled.fields.iter().zip(&compiled.prelude.results) {
        reader.known.clear();
        reader.touch(result);
        let value = reader.value(result);
        reader.name(place, name, value);
        fields.insert(name.clone(), value);
        reader.fields.push(value);
    }
    for function in &compiled.functions {
        reader.known = fields.clone();
        reader.locals = vec![f64::NAN; function.program.locals.len()];
        reader.statements(&format!("{place} {:?}", function.kind), &function.program, &function.program.statements);
    }
    (reader.read, reader.wrong)
}

/// With `ALL_MODELS` of every model of the project, which takes two minutes.
#[test]
fn names_are_what_they_say() {
    let all = std::env::var_os("ALL_MODELS").is_some();
    let (mut count, mut wrong) = (0, Vec::new());
    for (file, call) in calls() {
        if !all && !FILES.contains(&file.as_str()) {
            continue;
        }
        for model in models(call) {
            let Ok((_, derivation)) = of(&model) else { continue };
            let (read, list) = read(&format!("{file} {}", model.name), &derivation);
            count += read;
            wrong.extend(list);
        }
    }
    assert!(count > 100, "only {count} names were read");
    assert!(wrong.is_empty(), "{} of {count}: {wrong:#?}", wrong.len());
}
