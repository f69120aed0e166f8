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

/// How tightly the words of a name bind, loosest first: nothing stands around the parts of a name.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Or,
    And,
    Compare,
    Sum,
    Product,
    Power,
    Atom,
}

/// Words between operands, with what binds as they do.
const BETWEEN: [(&str, Level); 12] = [
    ("of", Level::Or),
    ("or", Level::Or),
    ("and", Level::And),
    ("below", Level::Compare),
    ("most", Level::Compare),
    ("is", Level::Compare),
    ("least", Level::Compare),
    ("to", Level::Compare),
    ("plus", Level::Sum),
    ("minus", Level::Sum),
    ("times", Level::Product),
    ("over", Level::Product),
];
/// Words before what they change.
const BEFORE: [&str; 7] = ["minus", "twice", "half", "not", "angle", "sin", "cos"];
/// Words behind it.
const BEHIND: [&str; 4] = ["squared", "cubed", "inv", "root"];

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
        // An operation is told by what it is of.
        if is_simple && name == wanted && level(name.trim_start_matches("minus_")) == Level::Atom {
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
                Expression::Product(list) | Expression::Call(_, list) | Expression::Pack(list) => {
                    stack.extend(list.iter().rev());
                }
                Expression::Fused(operands) => stack.extend(operands.iter().rev()),
                Expression::Quotient(a, b) => stack.extend([&**b, &**a]),
            }
        }
        let mut unique: Vec<String> = Vec::new();
        for origin in origins.into_iter().chain(far).chain(fields) {
            let origin = origin.strip_prefix("minus_").map_or(origin.clone(), str::to_owned);
            // Behind `with` an operation would be read as one on all that stands before.
            let is_atom = level(&origin) == Level::Atom;
            if is_atom && unique.len() < ORIGINS && !unique.contains(&origin) {
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

    /// What an angle is called behind `sin` and `cos`: nothing where it has no name and its words are many.
    pub(super) fn of_angle(&self, name: Option<String>, angle: &Expression) -> Option<String> {
        let words = name.or_else(|| self.operation(angle).filter(|text| text.len() <= LONGEST))?;
        Some(if level(&words) == Level::Atom { words } else { format!("of_{words}") })
    }

    /// What a value of parameters is, in words, if they are few.
    pub(super) fn of_node(&self, dag: &Dag, id: Id) -> Option<String> {
        self.operation(&written(dag, id, 3)?).filter(|text| text.len() <= LONGEST)
    }

    /// What an expression does, in words; nothing where they would be many, or would say something else.
    fn operation(&self, expression: &Expression) -> Option<String> {
        match expression {
            Expression::Literal(value) => (*value >= 0.0).then(|| digits(*value)),
            Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => self.leaf(expression),
            Expression::Neg(inner) => Some(format!("minus_{}", self.operand(inner, Level::Product)?)),
            Expression::Sum(terms) => self.sum(terms),
            Expression::Product(factors) => self.product(factors),
            Expression::Quotient(above, below) => {
                let below = self.operand(below, Level::Power)?;
                match **above {
                    Expression::Literal(1.0) => Some(format!("{below}_inv")),
                    Expression::Literal(_) => Some(format!("{below}_inv_times_{}", self.operation(above)?)),
                    _ => Some(joined(&self.operand(above, Level::Product)?, "over", &below)),
                }
            }
            Expression::Call(call, arguments) => self.call(*call, arguments),
            Expression::Fused(_) | Expression::Pack(_) => None,
        }
    }

    /// The words of an operand, where they bind as tightly as they must.
    fn operand(&self, expression: &Expression, least: Level) -> Option<String> {
        self.operation(expression).filter(|words| level(words) >= least)
    }

    fn sum(&self, terms: &[(bool, Expression)]) -> Option<String> {
        let mut text: Option<String> = None;
        // A name begins with no digit.
        let is_literal = |term: &&(bool, Expression)| matches!(term.1, Expression::Literal(_));
        let (literals, rest): (Vec<_>, Vec<_>) = terms.iter().partition(is_literal);
        for (minus, term) in rest.into_iter().chain(literals) {
            let term = self.operand(term, if *minus { Level::Product } else { Level::Sum })?;
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

    fn product(&self, factors: &[Expression]) -> Option<String> {
        let mut literal: Option<f64> = None;
        let mut powers: Vec<(String, usize)> = Vec::new();
        for factor in factors {
            if let (Expression::Literal(value), None) = (factor, literal) {
                literal = Some(*value);
                continue;
            }
            let name = self.operand(factor, Level::Product)?;
            match powers.iter_mut().find(|known| known.0 == name) {
                Some(known) => known.1 += 1,
                None => powers.push((name, 1)),
            }
        }
        let mut text: Option<String> = None;
        for (name, power) in powers {
            let name = match power {
                1 => name,
                2 => behind(&name, "squared")?,
                3 => behind(&name, "cubed")?,
                power => behind(&name, &format!("to_the_{power}"))?,
            };
            text = Some(text.map_or(name.clone(), |before| joined(&before, "times", &name)));
        }
        let text = text?;
        match literal {
            None => Some(text),
            Some(2.0) => Some(format!("twice_{text}")),
            Some(0.5) => Some(format!("half_{text}")),
            Some(value) => (value >= 0.0).then(|| format!("{text}_times_{}", digits(value))),
        }
    }

    fn call(&self, call: Call, arguments: &[Expression]) -> Option<String> {
        let two = |word: &str, least: Level| {
            let [a, b] = arguments else { return None };
            Some(joined(&self.operand(a, least)?, word, &self.operand(b, least)?))
        };
        match call {
            Call::Less => two("below", Level::Sum),
            Call::LessEqual => two("at_most", Level::Sum),
            Call::Equal => two("is", Level::Sum),
            Call::And => two("and", Level::And),
            Call::Or => two("or", Level::Or),
            Call::Max => two("at_least", Level::Sum),
            Call::Min => two("up_to", Level::Sum),
            // Its name is the user's, and given where it is called.
            _ if call.external().is_some() => None,
            Call::Atan2 => Some(format!("angle_of_{}", two("and", Level::Product)?)),
            _ => {
                let [argument] = arguments else { return None };
                match call {
                    Call::Not => Some(format!("not_{}", self.operand(argument, Level::Compare)?)),
                    Call::Sqrt => behind(&self.operation(argument)?, "root"),
                    _ => {
                        Some(format!("{}_{}", format!("{call:?}").to_lowercase(), self.operand(argument, Level::Atom)?))
                    }
                }
            }
        }
    }
}

/// A name with a word behind it that concerns the whole; nothing where it would concern the last of its parts.
pub(super) fn behind(name: &str, word: &str) -> Option<String> {
    // What is squared has no sign.
    let name = if word == "squared" { name.strip_prefix("minus_").unwrap_or(name) } else { name };
    (level(name) >= Level::Power).then(|| format!("{name}_{word}"))
}

/// How tightly a name binds, by its words; also one of a user's that has such words, which costs a shorter name at most.
fn level(name: &str) -> Level {
    let words: Vec<&str> = name.split('_').collect();
    // What a value goes into and what of: a factor as any other.
    if words.contains(&"with") && !words.contains(&"of") {
        return Level::Product;
    }
    let between = |word: &&str| BETWEEN.iter().find(|one| one.0 == *word).map(|one| one.1);
    let first = words.first().copied().unwrap_or_default();
    let before = match first {
        "minus" | "twice" | "half" => Level::Product,
        "not" => Level::Compare,
        _ => Level::Atom,
    };
    let inside = words.iter().skip(1).filter_map(between).min().unwrap_or(Level::Atom);
    let last = words.last().is_some_and(|word| BEHIND.contains(word));
    before.min(inside).min(if last { Level::Power } else { Level::Atom })
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

/// `legs_0_line_x_times_y` for two that begin alike and are equally long: what stands behind takes the place of the last words
/// of what stands before. A word that does something is never left out.
fn joined(a: &str, between: &str, b: &str) -> String {
    let acts = |word: &str| {
        word == "with" || BEFORE.contains(&word) || BEHIND.contains(&word) || BETWEEN.iter().any(|one| one.0 == word)
    };
    let (first, second): (Vec<&str>, Vec<&str>) = (a.split('_').collect(), b.split('_').collect());
    let common = first.iter().zip(&second).take_while(|(x, y)| x == y && !acts(x)).count();
    let rest = &second[common..];
    let is_parallel = first.len() == second.len();
    match rest.first() {
        Some(word) if is_parallel && !acts(word) && !word.starts_with(|c: char| c.is_ascii_digit()) => {
            format!("{a}_{between}_{}", rest.join("_"))
        }
        _ => format!("{a}_{between}_{b}"),
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
