//! Plain text read back as formulas, so that what is typed here, or copied from a book, is counted and evaluated like what
//! printers have made. A name is what is printed, with its index; dots stay dots.

use multibody_engine::symbolic::write::formula::{Class, Equation, Formula, Function, Identifier, Relation};

/// Both sides.
pub(crate) fn equation(text: &str) -> Equation {
    let Some((left, right)) = text.split_once(" = ") else { panic!("no equation: {text}") };
    Equation { left: formula(left), right: formula(right) }
}

pub(crate) fn formula(text: &str) -> Formula {
    let mut reader = Reader { rest: text };
    let formula = reader.sum();
    assert!(reader.rest.is_empty(), "{:?} is left of {text}", reader.rest);
    formula
}

/// A name as the text has it.
pub(crate) fn named(text: &str) -> Identifier {
    let stem = text.trim_end_matches(['˙', '¨']);
    let dots = if text.ends_with('¨') { 2 } else { u8::from(text.ends_with('˙')) };
    Identifier { text: stem.to_owned(), dots, index: None, class: Class::Parameter, typed: false }
}

const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

const FUNCTIONS: [Function; 15] = [
    Function::Sin,
    Function::Cos,
    Function::Tan,
    Function::Asin,
    Function::Acos,
    Function::Atan,
    Function::Atan2,
    Function::Sinh,
    Function::Cosh,
    Function::Tanh,
    Function::Exp,
    Function::Ln,
    Function::Signum,
    Function::Min,
    Function::Max,
];

struct Reader<'t> {
    rest: &'t str,
}

impl<'t> Reader<'t> {
    fn take(&mut self, word: &str) -> bool {
        let rest = self.rest.strip_prefix(word);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn demand(&mut self, word: &str) {
        assert!(self.take(word), "no {word:?} before {:?}", self.rest);
    }

    /// What stands first as far as it is of a kind.
    fn run(&mut self, is_part: impl Fn(char) -> bool) -> &'t str {
        let end = self.rest.find(|c| !is_part(c)).unwrap_or(self.rest.len());
        let (run, rest) = self.rest.split_at(end);
        self.rest = rest;
        run
    }

    fn sum(&mut self) -> Formula {
        let mut terms = vec![(self.take("-"), self.product())];
        loop {
            let minus = match (self.take(" + "), self.take(" - ")) {
                (true, _) => false,
                (_, true) => true,
                _ => break,
            };
            terms.push((minus, self.product()));
        }
        match &terms[..] {
            [(false, term)] => term.clone(),
            [(true, term)] => Formula::Minus(Box::new(term.clone())),
            _ => Formula::Sum(terms),
        }
    }

    fn product(&mut self) -> Formula {
        let mut factors = vec![self.power()];
        loop {
            if self.take(" / ") {
                let below = self.power();
                factors = vec![Formula::Fraction(Box::new(multiplied(factors)), Box::new(below))];
            } else if self.has_factor() {
                self.rest = &self.rest[1..];
                factors.push(self.power());
            } else {
                return multiplied(factors);
            }
        }
    }

    /// Whether another factor stands behind a space; `if` and `else` are none.
    fn has_factor(&self) -> bool {
        let word = |word: &str| self.rest.starts_with(word);
        let is_factor = |rest: &str| rest.starts_with(|c: char| c.is_alphanumeric() || c == '(');
        !word(" if ") && !word(" else ") && self.rest.strip_prefix(' ').is_some_and(is_factor)
    }

    fn power(&mut self) -> Formula {
        let base = self.base();
        let digits = self.run(|c| SUPERSCRIPTS.contains(&c));
        let value = |c: char| SUPERSCRIPTS.iter().position(|known| *known == c).unwrap() as u32;
        match digits.chars().map(value).reduce(|n, digit| 10 * n + digit) {
            Some(n) => Formula::Power(Box::new(base), n),
            None => base,
        }
    }

    fn base(&mut self) -> Formula {
        if self.take("(") {
            let mut inside = self.sum();
            if self.take(" if ") {
                let left = self.sum();
                self.demand(" < ");
                let condition = Formula::Related(Relation::Less, Box::new(left), Box::new(self.sum()));
                self.demand(" else ");
                inside = Formula::Cases(Box::new([condition, inside, self.sum()]));
            }
            self.demand(")");
            return inside;
        }
        if self.take("undefined()") {
            return Formula::Apply(Function::Undefined, Vec::new());
        }
        if self.take("π") {
            return Formula::Pi;
        }
        if self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            return Formula::Number(self.run(|c| c.is_ascii_digit() || c == '.').to_owned());
        }
        let word = self.name();
        assert!(!word.is_empty(), "no value before {:?}", self.rest);
        if !self.take("(") {
            return Formula::Name(named(word));
        }
        let mut arguments = vec![self.sum()];
        while self.take(", ") {
            arguments.push(self.sum());
        }
        self.demand(")");
        let first = Box::new(arguments[0].clone());
        match word {
            "sqrt" => Formula::Root(first),
            "abs" => Formula::Absolute(first),
            _ => {
                let function = FUNCTIONS.into_iter().find(|function| function.word() == word);
                Formula::Apply(function.unwrap_or_else(|| panic!("no function: {word}")), arguments)
            }
        }
    }

    /// Letters, digits, points, indices in brackets, dots.
    fn name(&mut self) -> &'t str {
        let mut depth = 0;
        let mut end = self.rest.len();
        for (at, c) in self.rest.char_indices() {
            match c {
                '[' => depth += 1,
                ']' => depth -= 1,
                _ if depth > 0 || c.is_alphanumeric() && !SUPERSCRIPTS.contains(&c) || matches!(c, '_' | '.') => {}
                '˙' | '¨' => {
                    end = at + c.len_utf8();
                    break;
                }
                _ => {
                    end = at;
                    break;
                }
            }
        }
        let (name, rest) = self.rest.split_at(end);
        self.rest = rest;
        name
    }
}

fn multiplied(mut factors: Vec<Formula>) -> Formula {
    if factors.len() == 1 { factors.remove(0) } else { Formula::Product(factors) }
}
