//! Stage `optimize`: what locals without a name are called.
//!
//! In: the expression that a local holds, names of what it reads, the name that it serves. Out: a name that tells it from
//! others by what it is: the operation where that is short (`legs_0_line_x_times_z`, `crank_rate_squared`), else what it
//! goes into and what of (`pivot_2_with_legs_0_mu`). A number tells values apart only where all of these are taken.

use std::collections::HashMap;

use crate::contracts::call::Call;
use crate::contracts::symbol::Symbol;
use crate::symbolic::number::Number;

use super::dag::{Dag, Id, Kind, ONE};
use super::names::Names;
use super::program::{Expression, Local};

/// Characters of an operation in words.
const LONGEST: usize = 42;
/// Characters of a name that says what a value goes into, and of what two.
const WIDEST: usize = 64;
/// As many simple names are remembered of what a local is made of.
const ORIGINS: usize = 12;

/// Names of what expressions read.
pub(super) struct Wording<'a> {
    symbols: HashMap<Symbol, String>,
    fields: &'a [String],
    locals: Vec<Read>,
}

/// A local as others read it.
struct Read {
    name: String,
    /// Whether a dynamicist has a word for it: it is no operation in words and no part of another value.
    is_simple: bool,
    /// Simple names of what it is made of, itself if it is simple.
    origins: Vec<String>,
}

impl<'a> Wording<'a> {
    pub(super) fn new(dag: &Dag, fields: &'a [String]) -> Self {
        let symbols = dag.symbols.iter().zip(&dag.symbol_names).filter(|(_, name)| !name.is_empty());
        let symbols = symbols.map(|(symbol, name)| (*symbol, name.clone())).collect();
        Wording { symbols, fields, locals: Vec::new() }
    }

    /// A local with a name of its own, or for a second such value one that says what it is made of.
    pub(super) fn named(&mut self, names: &mut Names, name: &str, values: &[&Expression]) -> String {
        let origins = self.origins(values);
        let with = origins.iter().map(|origin| joined(name, "with", origin));
        let free = std::iter::once(name.to_owned()).chain(with).find(|candidate| names.is_free(candidate));
        let is_simple = free.as_deref() == Some(name);
        self.take(names, free.unwrap_or_else(|| name.to_owned()), is_simple, origins)
    }

    /// A local without a name, which serves `hint`.
    pub(super) fn described(&mut self, names: &mut Names, hint: Option<&str>, value: &Expression) -> String {
        let origins = self.origins(&[value]);
        let operation = self.operation(value).filter(|text| text.len() <= LONGEST);
        let served = hint.unwrap_or("value");
        let pairs = || origins.iter().enumerate().flat_map(|(k, a)| origins[k + 1..].iter().map(move |b| (a, b)));
        let with = origins.iter().filter(|origin| !served.ends_with(origin.as_str()));
        let with = with.map(|origin| joined(served, "with", origin));
        let with_two = pairs().map(|(a, b)| joined(&joined(served, "with", a), "and", b));
        let with_two = with_two.filter(|text| text.len() <= WIDEST);
        let part = std::iter::once(format!("{served}_part"));
        let mut candidates = operation.into_iter().chain(with).chain(with_two).chain(part);
        let free = candidates.find(|candidate| names.is_free(candidate));
        self.take(names, free.unwrap_or_else(|| format!("{served}_part")), false, origins)
    }

    fn take(&mut self, names: &mut Names, wanted: String, is_simple: bool, mut origins: Vec<String>) -> String {
        let name = names.unique(&wanted);
        if is_simple && name == wanted {
            origins = vec![name.clone()];
        }
        self.locals.push(Read { name: name.clone(), is_simple, origins });
        name
    }

    /// Simple names of what expressions are made of: of locals, then of symbols, then of fields.
    fn origins(&self, values: &[&Expression]) -> Vec<String> {
        let (mut origins, mut far, mut fields): (Vec<String>, Vec<String>, Vec<String>) = Default::default();
        let mut stack: Vec<&Expression> = values.iter().rev().copied().collect();
        while let Some(expression) = stack.pop() {
            match expression {
                Expression::Literal(_) => {}
                Expression::Symbol(_) => origins.extend(self.leaf(expression)),
                Expression::Field(_) => fields.extend(self.leaf(expression)),
                Expression::Local(Local(local)) => match self.locals.get(*local) {
                    Some(read) if read.is_simple => origins.extend(read.origins.iter().cloned()),
                    Some(read) => far.extend(read.origins.iter().cloned()),
                    None => {}
                },
                Expression::Neg(inner) => stack.push(inner),
                Expression::Sum(terms) => stack.extend(terms.iter().rev().map(|term| &term.1)),
                Expression::Product(list) | Expression::Call(_, list) => stack.extend(list.iter().rev()),
                Expression::Quotient(a, b) => stack.extend([&**b, &**a]),
            }
        }
        let mut unique: Vec<String> = Vec::new();
        for origin in origins.into_iter().chain(far).chain(fields) {
            let origin = origin.strip_prefix("minus_").map_or(origin.clone(), str::to_owned);
            if unique.len() < ORIGINS && !unique.contains(&origin) {
                unique.push(origin);
            }
        }
        unique
    }

    /// The name of what is read; nothing where only a number tells it from others.
    fn leaf(&self, expression: &Expression) -> Option<String> {
        let name = match expression {
            Expression::Symbol(symbol) => self.symbols.get(symbol)?,
            Expression::Field(field) => self.fields.get(field.0)?,
            Expression::Local(local) => &self.locals.get(local.0)?.name,
            _ => return None,
        };
        (!is_numbered(name)).then(|| name.clone())
    }

    /// What a value of parameters is, in words, if they are few.
    pub(super) fn of_node(&self, dag: &Dag, id: Id) -> Option<String> {
        self.operation(&written(dag, id, 3)?).filter(|text| text.len() <= LONGEST)
    }

    /// What an expression does, in words; nothing where they would be many.
    fn operation(&self, expression: &Expression) -> Option<String> {
        match expression {
            Expression::Literal(value) => Some(digits(*value)),
            Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => self.leaf(expression),
            Expression::Neg(inner) => Some(format!("minus_{}", self.operation(inner)?)),
            Expression::Sum(terms) => {
                let mut text: Option<String> = None;
                // A name begins with no digit.
                let is_literal = |term: &&(bool, Expression)| matches!(term.1, Expression::Literal(_));
                let (literals, rest): (Vec<_>, Vec<_>) = terms.iter().partition(is_literal);
                for (minus, term) in rest.into_iter().chain(literals) {
                    let term = self.operation(term)?;
                    text = Some(match (text, minus) {
                        (None, false) => term,
                        (None, true) => format!("minus_{term}"),
                        (Some(before), false) => joined(&before, "plus", &term),
                        (Some(before), true) => joined(&before, "minus", &term),
                    });
                    if text.as_ref().is_some_and(|text| text.len() > LONGEST) {
                        return None;
                    }
                }
                text
            }
            Expression::Product(factors) => self.product(factors),
            Expression::Quotient(above, below) => {
                let below = self.factor(below)?;
                match **above {
                    Expression::Literal(1.0) => Some(format!("{below}_inv")),
                    Expression::Literal(value) => Some(format!("{below}_inv_times_{}", digits(value))),
                    _ => Some(joined(&self.factor(above)?, "over", &below)),
                }
            }
            Expression::Call(call, arguments) => self.call(*call, arguments),
        }
    }

    /// An operand of a product: words for a sum within it would belong to no one.
    fn factor(&self, expression: &Expression) -> Option<String> {
        if matches!(expression, Expression::Sum(_)) { None } else { self.operation(expression) }
    }

    fn product(&self, factors: &[Expression]) -> Option<String> {
        let mut before = "";
        let mut behind = String::new();
        let mut powers: Vec<(String, usize)> = Vec::new();
        for factor in factors {
            match factor {
                Expression::Literal(2.0) => before = "twice_",
                Expression::Literal(0.5) => before = "half_",
                Expression::Literal(value) => behind = format!("_times_{}", digits(*value)),
                _ => {
                    let name = self.factor(factor)?;
                    match powers.iter_mut().find(|known| known.0 == name) {
                        Some(known) => known.1 += 1,
                        None => powers.push((name, 1)),
                    }
                }
            }
        }
        let mut text: Option<String> = None;
        for (name, power) in powers {
            let name = match power {
                1 => name,
                2 => format!("{name}_squared"),
                3 => format!("{name}_cubed"),
                power => format!("{name}_to_the_{power}"),
            };
            text = Some(text.map_or(name.clone(), |before| joined(&before, "times", &name)));
        }
        text.map(|text| format!("{before}{text}{behind}"))
    }

    fn call(&self, call: Call, arguments: &[Expression]) -> Option<String> {
        let mut names = arguments.iter().map(|argument| self.operation(argument));
        let (first, second) = (names.next()??, names.next());
        Some(match (call, second) {
            (Call::Less, Some(b)) => joined(&first, "below", &b?),
            (Call::LessEqual, Some(b)) => joined(&first, "at_most", &b?),
            (Call::Equal, Some(b)) => joined(&first, "is", &b?),
            (Call::And, Some(b)) => joined(&first, "and", &b?),
            (Call::Or, Some(b)) => joined(&first, "or", &b?),
            (Call::Max, Some(b)) => joined(&first, "at_least", &b?),
            (Call::Min, Some(b)) => joined(&first, "up_to", &b?),
            (Call::Atan2, Some(b)) => format!("angle_of_{}", joined(&first, "and", &b?)),
            (_, Some(_)) => return None,
            (Call::Not, None) => format!("not_{first}"),
            (Call::Sqrt, None) => format!("{first}_root"),
            (call, None) => format!("{}_{first}", format!("{call:?}").to_lowercase()),
        })
    }
}

/// A value of symbols as an expression; nothing where it is deeper, or more than sums and products.
fn written(dag: &Dag, id: Id, depth: usize) -> Option<Expression> {
    let depth = depth.checked_sub(1)?;
    Some(match &dag.nodes[id].kind {
        Kind::Symbol(symbol) => Expression::Symbol(*dag.symbols.get(symbol.0)?),
        Kind::Product(factors) => {
            let factors: Option<Vec<Expression>> = factors.iter().map(|&f| written(dag, f, depth)).collect();
            Expression::Product(factors?)
        }
        Kind::Reciprocal(x) => {
            Expression::Quotient(Box::new(Expression::Literal(1.0)), Box::new(written(dag, *x, depth)?))
        }
        Kind::Sum(terms) => {
            let term = |&(c, id): &(Number, Id)| {
                let literal = Expression::Literal(c.abs().value());
                let term = match (id, c.is_unit()) {
                    (ONE, _) => literal,
                    (_, true) => written(dag, id, depth)?,
                    (_, false) => Expression::Product(vec![literal, written(dag, id, depth)?]),
                };
                Some((c.is_negative(), term))
            };
            let terms: Option<Vec<(bool, Expression)>> = terms.iter().map(term).collect();
            Expression::Sum(terms?)
        }
        _ => return None,
    })
}

/// `legs_0_line_x_times_y` for two that begin alike.
fn joined(a: &str, word: &str, b: &str) -> String {
    let common = a.split('_').zip(b.split('_')).take_while(|(x, y)| x == y).count();
    let rest: Vec<&str> = b.split('_').skip(common).collect();
    match rest.first() {
        Some(first) if !first.starts_with(|c: char| c.is_ascii_digit()) => format!("{a}_{word}_{}", rest.join("_")),
        _ => format!("{a}_{word}_{b}"),
    }
}

/// Three digits of a number, or more where these are all: `0_0625`, `44_1`.
fn digits(value: f64) -> String {
    let magnitude = value.abs();
    let whole = if magnitude < 1.0 { 0 } else { magnitude.log10() as usize + 1 };
    let short = format!("{magnitude}");
    let zeros = if magnitude < 1.0 && magnitude > 0.0 { (-magnitude.log10()) as usize } else { 0 };
    let text = if short.len() <= 6 { short } else { format!("{magnitude:.0$}", (3 + zeros).saturating_sub(whole)) };
    text.replace('.', "_")
}

/// Whether a name ends in `_v2`.
fn is_numbered(name: &str) -> bool {
    name.split('_')
        .any(|word| word.strip_prefix('v').is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit())))
}
