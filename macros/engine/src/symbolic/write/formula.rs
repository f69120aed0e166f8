//! Stage `symbolic`, writing: the small tree of mathematics that printers read.
//!
//! In: what `compose` and `arrange` make of nodes. Out: types alone. Everything that mathematics sets by position (fractions,
//! powers, roots, dots) is a node here, so a printer decides how something looks and never what it says.

/// A name as users know it, and what stands on it.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Identifier {
    /// Of the user: `shoulder`, `legs[2].knee`, `l1`.
    pub text: String,
    /// 1 for a rate, 2 for an acceleration.
    pub dots: u8,
    /// What the symbol is one entry of, such as `x` of a vector or `1, 2` of a matrix.
    pub index: Option<String>,
    pub class: Class,
    /// Set letter by letter, as it is typed: taken apart into a letter and an index it would look like another.
    pub typed: bool,
}

/// What an identifier is: products are written in this order, as textbooks do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Class {
    Parameter,
    Time,
    Input,
    State,
    /// Defined by an equation of its own.
    Defined,
    Position,
    Rate,
    Acceleration,
    Multiplier,
}

/// A function that is written with its name before its arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Signum,
    Min,
    Max,
    /// The rounding unit of the scalar.
    Epsilon,
    /// No number.
    Undefined,
}

impl Function {
    /// In plain text, and between the words of LaTeX's `\operatorname`.
    pub fn word(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Asin => "arcsin",
            Function::Acos => "arccos",
            Function::Atan => "arctan",
            Function::Atan2 => "atan2",
            Function::Sinh => "sinh",
            Function::Cosh => "cosh",
            Function::Tanh => "tanh",
            Function::Exp => "exp",
            Function::Ln => "ln",
            Function::Signum => "sign",
            Function::Min => "min",
            Function::Max => "max",
            Function::Epsilon => "eps",
            Function::Undefined => "undefined",
        }
    }
}

/// What ties two values, or two truths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Relation {
    Less,
    LessEqual,
    Equal,
    And,
    Or,
}

/// Mathematics.
#[derive(Clone, Debug, PartialEq)]
pub enum Formula {
    /// Digits as they are written, never negative.
    Number(String),
    Pi,
    Name(Identifier),
    /// Minus, where it stands first or before a factor.
    Minus(Box<Formula>),
    /// Terms, each with whether it is subtracted.
    Sum(Vec<(bool, Formula)>),
    Product(Vec<Formula>),
    Fraction(Box<Formula>, Box<Formula>),
    Power(Box<Formula>, u32),
    Root(Box<Formula>),
    Absolute(Box<Formula>),
    Apply(Function, Vec<Formula>),
    /// A function that has a name of the user's.
    Called(Box<Identifier>, Vec<Formula>),
    /// To a power that is no small integer.
    General(Box<Formula>, Box<Formula>),
    Related(Relation, Box<Formula>, Box<Formula>),
    Not(Box<Formula>),
    /// The first where the condition holds, else the second.
    Cases(Box<[Formula; 3]>),
}

impl Formula {
    pub fn integer(n: u64) -> Formula {
        Formula::Number(n.to_string())
    }

    pub fn zero() -> Formula {
        Formula::integer(0)
    }

    pub fn is_zero(&self) -> bool {
        matches!(self, Formula::Number(digits) if digits == "0")
    }

    pub fn each_name_mut(&mut self, visit: &mut dyn FnMut(&mut Identifier)) {
        match self {
            Formula::Number(_) | Formula::Pi => {}
            Formula::Name(identifier) => visit(identifier),
            Formula::Minus(x) | Formula::Power(x, _) | Formula::Root(x) | Formula::Absolute(x) | Formula::Not(x) => {
                x.each_name_mut(visit)
            }
            Formula::Sum(terms) => terms.iter_mut().for_each(|(_, term)| term.each_name_mut(visit)),
            Formula::Product(list) | Formula::Apply(_, list) => list.iter_mut().for_each(|x| x.each_name_mut(visit)),
            Formula::Called(function, list) => {
                visit(function);
                list.iter_mut().for_each(|x| x.each_name_mut(visit));
            }
            Formula::Fraction(a, b) | Formula::General(a, b) | Formula::Related(_, a, b) => {
                [a, b].into_iter().for_each(|x| x.each_name_mut(visit))
            }
            Formula::Cases(parts) => parts.iter_mut().for_each(|x| x.each_name_mut(visit)),
        }
    }

    /// How long it is to read: names, numbers and signs, each one.
    pub fn length(&self) -> usize {
        match self {
            Formula::Number(_) | Formula::Pi | Formula::Name(_) => 1,
            Formula::Minus(x) | Formula::Power(x, _) | Formula::Root(x) | Formula::Absolute(x) | Formula::Not(x) => {
                1 + x.length()
            }
            // A sum as a factor has brackets.
            Formula::Sum(terms) => terms.iter().map(|(_, term)| 1 + term.length()).sum::<usize>().saturating_sub(1),
            Formula::Product(factors) => {
                let bracketed = factors.iter().filter(|factor| matches!(factor, Formula::Sum(_))).count();
                factors.iter().map(Formula::length).sum::<usize>() + bracketed
            }
            Formula::Fraction(a, b) | Formula::General(a, b) | Formula::Related(_, a, b) => 1 + a.length() + b.length(),
            Formula::Apply(_, list) | Formula::Called(_, list) => 1 + list.iter().map(Formula::length).sum::<usize>(),
            Formula::Cases(parts) => 2 + parts.iter().map(Formula::length).sum::<usize>(),
        }
    }

    /// Sums and differences, and products and quotients: what a reader would count, sines apart.
    pub fn operations(&self) -> (usize, usize) {
        let mut counts = (0, 0);
        self.count(&mut counts);
        counts
    }

    fn count(&self, counts: &mut (usize, usize)) {
        match self {
            Formula::Sum(terms) => counts.0 += terms.len().saturating_sub(1),
            Formula::Product(factors) => counts.1 += factors.len().saturating_sub(1),
            Formula::Fraction(..) => counts.1 += 1,
            Formula::Power(_, n) => counts.1 += (*n as usize).saturating_sub(1),
            _ => {}
        }
        self.each_part(&mut |part| part.count(counts));
    }

    /// What it is made of.
    pub fn each_part<'f>(&'f self, visit: &mut dyn FnMut(&'f Formula)) {
        match self {
            Formula::Number(_) | Formula::Pi | Formula::Name(_) => {}
            Formula::Minus(x) | Formula::Power(x, _) | Formula::Root(x) | Formula::Absolute(x) | Formula::Not(x) => {
                visit(x)
            }
            Formula::Sum(terms) => terms.iter().for_each(|(_, term)| visit(term)),
            Formula::Product(list) | Formula::Apply(_, list) | Formula::Called(_, list) => list.iter().for_each(visit),
            Formula::Fraction(a, b) | Formula::General(a, b) | Formula::Related(_, a, b) => {
                [a, b].into_iter().for_each(|x| visit(x))
            }
            Formula::Cases(parts) => parts.iter().for_each(visit),
        }
    }
}

/// One line: what is defined or demanded, and by what.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    pub left: Formula,
    pub right: Formula,
}
