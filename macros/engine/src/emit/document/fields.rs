//! Stage `emit`: what the fields of `Model` are, as formulas of parameters.
//!
//! In: the program of `Model::new`. Out: a line for each field. Locals are written out as far as a line holds them; what is
//! left of them has the name that it has in `Model::new`.

use std::collections::HashMap;

use crate::contracts::call::Call;
use crate::contracts::symbol::Symbol;
use crate::emit::layout::Layout;
use crate::emit::print::expressions::function;
use crate::emit::print::literals;
use crate::model::types::External;
use crate::optimize::program::{Expression, Local, Program, Statement};

/// Characters of a line.
const WIDTH: usize = 100;
/// As deep are locals written out at most.
const DEPTH: usize = 8;

/// How tightly text binds, loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Sum,
    Product,
    Power,
    Atom,
}

/// One line for each result of the program; `locals` are their names there.
pub(in crate::emit) fn lines(layout: &Layout<'_>, program: &Program, locals: &[String]) -> Vec<String> {
    let defined = program.statements.iter().filter_map(|statement| match statement {
        Statement::Let { local, value } => Some((*local, value)),
        _ => None,
    });
    let writer = Writer { layout, locals, values: defined.collect(), angles: angles(program) };
    program.results.iter().map(|result| format!("`{}`", writer.line(result).replace('`', "'"))).collect()
}

/// Locals that are the sine or cosine of an angle.
fn angles(program: &Program) -> HashMap<Local, (&'static str, &Expression)> {
    let sines = program.statements.iter().filter_map(|statement| match statement {
        Statement::SinCos(sines) => Some(sines),
        _ => None,
    });
    let pairs = sines.flatten().map(|sine| [(sine.sin, ("sin", &sine.angle)), (sine.cos, ("cos", &sine.angle))]);
    pairs.flatten().collect()
}

struct Writer<'a> {
    layout: &'a Layout<'a>,
    locals: &'a [String],
    values: HashMap<Local, &'a Expression>,
    angles: HashMap<Local, (&'static str, &'a Expression)>,
}

impl Writer<'_> {
    /// Written out as deep as the line is not too long; what is too long even so is cut.
    fn line(&self, expression: &Expression) -> String {
        let fits = |text: &String| text.len() <= WIDTH;
        (0..=DEPTH)
            .rev()
            .filter_map(|depth| self.write(expression, depth, &mut WIDTH.clone()).map(|text| text.0))
            .find(fits)
            .unwrap_or_else(|| "..".to_string())
    }

    /// Nothing where there are more than `left` leaves.
    fn write(&self, expression: &Expression, depth: usize, left: &mut usize) -> Option<(String, Level)> {
        *left = left.checked_sub(1)?;
        Some(match expression {
            Expression::Literal(value) => literal(*value),
            Expression::Symbol(symbol) => (self.symbol(*symbol), Level::Atom),
            // `Model::new` reads none, and has no packs and nothing fused.
            Expression::Field(_) | Expression::Fused(_) | Expression::Pack(_) => ("..".to_string(), Level::Atom),
            Expression::Local(local) => match (self.values.get(local), self.angles.get(local)) {
                (Some(value), _) if depth > 0 => self.write(value, depth - 1, left)?,
                (_, Some((name, angle))) if depth > 0 => {
                    (format!("{name}({})", self.write(angle, depth - 1, left)?.0), Level::Atom)
                }
                _ => (self.locals[local.0].clone(), Level::Atom),
            },
            Expression::Neg(inner) => (format!("-{}", self.bound(inner, Level::Product, depth, left)?), Level::Sum),
            Expression::Sum(terms) => {
                let mut text = String::new();
                for (number, (minus, term)) in terms.iter().enumerate() {
                    text.push_str(match (number, minus) {
                        (0, false) => "",
                        (0, true) => "-",
                        (_, false) => " + ",
                        (_, true) => " - ",
                    });
                    text.push_str(&self.bound(term, Level::Product, depth, left)?);
                }
                (text, if terms.len() == 1 { Level::Product } else { Level::Sum })
            }
            Expression::Product(_) | Expression::Quotient(..) => {
                let mut fraction = Fraction::default();
                self.gather(expression, depth, left, false, &mut fraction)?;
                fraction.text()
            }
            Expression::Call(call, arguments) => {
                let arguments: Option<Vec<String>> =
                    arguments.iter().map(|argument| Some(self.write(argument, depth, left)?.0)).collect();
                let name = match call.external() {
                    Some(id) => external(&self.layout.model.externals[id], *call),
                    None => function(*call).map_or_else(|| format!("{call:?}").to_lowercase(), str::to_string),
                };
                (format!("{name}({})", arguments?.join(", ")), Level::Atom)
            }
        })
    }

    /// In parentheses where it binds less.
    fn bound(&self, expression: &Expression, least: Level, depth: usize, left: &mut usize) -> Option<String> {
        let (text, binds) = self.write(expression, depth, left)?;
        Some(if binds < least { format!("({text})") } else { text })
    }

    /// Factors above and below the line.
    fn gather(
        &self,
        expression: &Expression,
        depth: usize,
        left: &mut usize,
        below: bool,
        fraction: &mut Fraction,
    ) -> Option<()> {
        match expression {
            Expression::Product(factors) => {
                factors.iter().try_for_each(|factor| self.gather(factor, depth, left, below, fraction))
            }
            Expression::Quotient(a, b) => {
                self.gather(a, depth, left, below, fraction)?;
                self.gather(b, depth, left, !below, fraction)
            }
            Expression::Local(local) if depth > 0 && self.values.contains_key(local) => {
                *left = left.checked_sub(1)?;
                self.gather(self.values.get(local)?, depth - 1, left, below, fraction)
            }
            Expression::Literal(value) => {
                fraction.literal = if below { fraction.literal / value } else { fraction.literal * value };
                Some(())
            }
            other => {
                let text = self.bound(other, Level::Power, depth, left)?;
                fraction.add(text, if below { -1 } else { 1 });
                Some(())
            }
        }
    }

    /// As the user has named it.
    fn symbol(&self, symbol: Symbol) -> String {
        let path: String = self.layout.path_of(symbol).to_string().split_whitespace().collect();
        path.trim_start_matches('.').to_string()
    }
}

/// A literal and powers.
struct Fraction {
    literal: f64,
    powers: Vec<(String, i32)>,
}

impl Default for Fraction {
    fn default() -> Self {
        Fraction { literal: 1.0, powers: Vec::new() }
    }
}

impl Fraction {
    fn add(&mut self, text: String, power: i32) {
        match self.powers.iter_mut().find(|known| known.0 == text) {
            Some(known) => known.1 += power,
            None => self.powers.push((text, power)),
        }
    }

    /// `1 / 3 * m * l^2 / d`
    fn text(&self) -> (String, Level) {
        let written = |(text, power): (&String, i32)| {
            if power == 1 { text.clone() } else { format!("{text}^{power}") }
        };
        let side = |above: bool| -> Vec<String> {
            let powers = self.powers.iter().filter(|(_, power)| if above { *power > 0 } else { *power < 0 });
            powers.map(|(text, power)| written((text, power.abs()))).collect()
        };
        let (mut above, below) = (side(true), side(false));
        let is_one = self.literal == 1.0;
        if !is_one || above.is_empty() {
            above.insert(0, literal(self.literal).0);
        }
        // With a sign before it, it can't follow one.
        let level = if self.literal < 0.0 { Level::Sum } else { Level::Product };
        let above = above.join(" * ");
        let text = match &below[..] {
            [] => above,
            [single] => format!("{above} / {single}"),
            more => format!("{above} / ({})", more.join(" * ")),
        };
        (text, level)
    }
}

/// As it is called, or `grip.slopes[1]`.
fn external(function: &External, call: Call) -> String {
    match call {
        Call::ExternalSlope(_, argument) => format!("{}.slopes[{argument}]", function.name),
        _ => function.name.to_string(),
    }
}

/// A simple fraction as such, a whole number without a point.
fn literal(value: f64) -> (String, Level) {
    let whole = |x: f64| x == x.trunc() && x.abs() < 1e9;
    let text = literals::text(value);
    let short = text.trim_start_matches('-').len() <= 6;
    // The nearest number to a quotient of two small ones is one.
    let denominator = (2..=100).map(f64::from).find(|d| whole((value * d).round()) && (value * d).round() / d == value);
    match denominator {
        _ if whole(value) => (format!("{value}"), if value < 0.0 { Level::Sum } else { Level::Atom }),
        Some(d) if !short => (format!("{} / {d}", (value * d).round()), Level::Product),
        _ => (text, if value < 0.0 { Level::Sum } else { Level::Atom }),
    }
}
