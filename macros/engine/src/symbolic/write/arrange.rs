//! Stage `symbolic`, writing: how a polynomial is set.
//!
//! In: a polynomial. Out: a [`Formula`]: common factors before brackets, fractions under one line, parameters before
//! coordinates before sines before rates. Of the ways to take a factor out the shortest to read is taken.

use std::collections::BTreeMap;

use crate::contracts::call::Call;
use crate::invariant::fault::raise;
use crate::symbolic::number::Number;

use super::Names;
use super::coefficient::{self, Quotient};
use super::formula::{Class, Formula, Function, Identifier, Relation};
use super::polynomial::{Atom, AtomId, Atoms, Head, Monomial, Polynomial, times};

/// With more terms than this only the most frequent factor is tried.
const MOST_TERMS_TRIED: usize = 10;

/// What turns polynomials into formulas.
pub(super) struct Arranger<'a> {
    pub atoms: &'a Atoms,
    pub names: &'a Names<'a>,
    /// Of values with equations of their own.
    pub defined: &'a [Identifier],
}

/// A factor on or below a line.
#[derive(Default)]
struct Line {
    above: Vec<Formula>,
    below: Vec<Formula>,
}

impl Arranger<'_> {
    pub(super) fn formula(&self, p: &Polynomial) -> Formula {
        joined(self.terms(p))
    }

    /// The same with the coefficients of these symbols together, in this order, and what has none of them last.
    pub(super) fn collected(&self, p: &Polynomial, by: &[AtomId]) -> Formula {
        let mut parts: Vec<Polynomial> = vec![Polynomial::default(); by.len() + 1];
        for (monomial, &n) in &p.terms {
            let place = by.iter().position(|&atom| monomial.contains(&(atom, 1)));
            parts[place.unwrap_or(by.len())].add_term(monomial.clone(), n);
        }
        joined(parts.iter().flat_map(|part| self.terms(part)).collect())
    }

    /// Terms of a sum, with whether each is subtracted.
    fn terms(&self, p: &Polynomial) -> Vec<(bool, Formula)> {
        if p.terms.len() < 2 {
            return p.terms.iter().map(|(monomial, &n)| self.product(n, monomial, None)).collect();
        }
        let (number, monomial) = self.content(p);
        if !number.is_one() || !monomial.is_empty() {
            let rest = divided(p, number, &monomial);
            let inside = joined(self.terms(&rest));
            return vec![self.product(number, &monomial, Some(inside))];
        }
        let mut best = self.flat(p);
        let mut least = length(&best);
        if let Some(terms) = self.square(p)
            && length(&terms) < least
        {
            (best, least) = (terms, 0);
        }
        let frequent = if least > 0 { self.frequent(p) } else { Vec::new() };
        for atom in frequent {
            let (with, without) = split(p, atom);
            let mut terms = self.terms(&with);
            terms.extend(self.terms(&without));
            let found = length(&terms);
            if found < least {
                (best, least) = (terms, found);
            }
        }
        let mut best = with_common_brackets(best);
        // What is added stands first.
        best.sort_by_key(|term| term.0);
        best
    }

    /// With three terms as a square, `(x - y)^2` times what they have in common.
    fn square(&self, p: &Polynomial) -> Option<Vec<(bool, Formula)>> {
        let squared = |monomial: &Monomial| -> Vec<(AtomId, Monomial)> {
            let twice = monomial.iter().filter(|factor| factor.1 == 2);
            twice.map(|&(atom, _)| (atom, times(monomial, &vec![(atom, -2)]))).collect()
        };
        let squares: Vec<(AtomId, Monomial, Number)> = p
            .terms
            .iter()
            .flat_map(|(monomial, &n)| squared(monomial).into_iter().map(move |(atom, rest)| (atom, rest, n)))
            .collect();
        for (at, (x, rest, n)) in squares.iter().enumerate() {
            for (y, other, m) in &squares[at + 1..] {
                if x == y || rest != other || n != m {
                    continue;
                }
                let product = times(&times(rest, &vec![(*x, 1)]), &vec![(*y, 1)]);
                let Some(&between) = p.terms.get(&product).filter(|&&k| k == *n + *n || k == -(*n + *n)) else {
                    continue;
                };
                let mut left = p.clone();
                for atom in [x, y] {
                    left.terms.remove(&times(rest, &vec![(*atom, 2)]));
                }
                left.terms.remove(&product);
                let minus = between.is_negative() != n.is_negative();
                // What moves less what it moves from.
                let (first, second) = if minus == (self.rank(*x) < self.rank(*y)) { (y, x) } else { (x, y) };
                let sum = Formula::Sum(vec![(false, self.factor(*first, 1)), (minus, self.factor(*second, 1))]);
                let mut terms = self.terms(&left);
                terms.push(self.product(*n, rest, Some(Formula::Power(Box::new(sum), 2))));
                return Some(terms);
            }
        }
        None
    }

    fn flat(&self, p: &Polynomial) -> Vec<(bool, Formula)> {
        let mut list: Vec<(&Monomial, Number)> = p.terms.iter().map(|(monomial, &n)| (monomial, n)).collect();
        list.sort_by_key(|(monomial, _)| {
            self.sorted(monomial).iter().map(|&(atom, _)| self.rank(atom)).collect::<Vec<_>>()
        });
        list.into_iter().map(|(monomial, n)| self.product(n, monomial, None)).collect()
    }

    /// What every term has: a number, if it leaves whole ones, and atoms.
    fn content(&self, p: &Polynomial) -> (Number, Monomial) {
        let mut common: Option<BTreeMap<AtomId, i32>> = None;
        for monomial in p.terms.keys() {
            let own: BTreeMap<AtomId, i32> = monomial.iter().copied().collect();
            common = Some(match common {
                None => own,
                Some(known) => known
                    .into_iter()
                    .filter_map(|(atom, e)| {
                        let other = *own.get(&atom)?;
                        (e.signum() == other.signum()).then(|| (atom, e.signum() * e.abs().min(other.abs())))
                    })
                    .collect(),
            });
        }
        let least = p.terms.values().copied().min_by(|a, b| a.value().abs().total_cmp(&b.value().abs()));
        let least = least.map_or(Number::ONE, Number::abs);
        let whole = |n: Number| (n / least).rational().is_some_and(|(_, d)| d == 1);
        // Before brackets it must leave more terms without a number than there are.
        let plain = |scale: Number| p.terms.values().filter(|n| (**n / scale).abs().is_one()).count();
        let shorter = least.is_sharp() && p.terms.values().all(|&n| whole(n)) && plain(least) > plain(Number::ONE);
        let number = if shorter { least } else { Number::ONE };
        let minus = 2 * p.terms.values().filter(|n| n.is_negative()).count();
        let flips = minus > p.terms.len() || minus == p.terms.len() && p.leads_negative();
        let number = if flips { -number } else { number };
        let monomial: Monomial = common.unwrap_or_default().into_iter().collect();
        // A sign alone is no reason for brackets.
        if monomial.is_empty() && number.abs().is_one() { (Number::ONE, monomial) } else { (number, monomial) }
    }

    /// Atoms that several terms have, those that save most first.
    fn frequent(&self, p: &Polynomial) -> Vec<(AtomId, i32)> {
        let mut counts: BTreeMap<(AtomId, i32), usize> = BTreeMap::new();
        for &(atom, e) in p.terms.keys().flatten() {
            *counts.entry((atom, e.signum())).or_default() += 1;
        }
        let mut list: Vec<((AtomId, i32), usize)> =
            counts.into_iter().filter(|&(_, n)| n > 1 && n < p.terms.len()).collect();
        let saves = |&(factor, n): &((AtomId, i32), usize)| (n - 1) * self.factor(factor.0, factor.1).length();
        list.sort_by_key(|entry| std::cmp::Reverse(saves(entry)));
        list.truncate(if p.terms.len() > MOST_TERMS_TRIED { 1 } else { 3 });
        list.into_iter().map(|(atom, _)| atom).collect()
    }

    /// One term: its sign, and its factors on and below the line.
    fn product(&self, n: Number, monomial: &Monomial, sum: Option<Formula>) -> (bool, Formula) {
        let Quotient { above, below } = coefficient::written(n);
        let mut line = Line { above, below };
        for (atom, exponent) in self.sorted(monomial) {
            self.place(atom, exponent, &mut line);
        }
        line.above.extend(sum);
        let above = multiplied(line.above);
        let formula = match line.below.is_empty() {
            true => above,
            false => Formula::Fraction(Box::new(above), Box::new(multiplied(line.below))),
        };
        (n.is_negative(), formula)
    }

    fn place(&self, atom: AtomId, exponent: i32, line: &mut Line) {
        let (inverted, base) = match self.atoms.get(atom) {
            Atom::Of(Head::Inverse, argument) => (true, argument.first().map(|p| self.formula(p))),
            Atom::Of(Head::Root, argument) if exponent.abs() > 1 => {
                let whole = argument.first().map(|p| self.formula(p));
                let side = if exponent < 0 { &mut line.below } else { &mut line.above };
                side.extend(whole.map(|p| power(p, exponent.unsigned_abs() / 2)));
                if exponent % 2 == 0 {
                    return;
                }
                side.push(self.factor(atom, 1));
                return;
            }
            _ => (false, None),
        };
        let base = base.unwrap_or_else(|| self.factor(atom, 1));
        let side = if (exponent < 0) != inverted { &mut line.below } else { &mut line.above };
        side.push(power(base, exponent.unsigned_abs()));
    }

    /// In the order in which they are written.
    fn sorted(&self, monomial: &Monomial) -> Monomial {
        let mut list = monomial.clone();
        list.sort_by_key(|&(atom, _)| self.rank(atom));
        list
    }

    fn rank(&self, atom: AtomId) -> (u8, AtomId, usize) {
        match self.atoms.get(atom) {
            Atom::Symbol(id) => (of_class((self.names.symbol)(*id).class), 0, id.0),
            Atom::Defined(number) => (of_class(Class::Defined), 0, *number),
            Atom::Of(Head::Sine | Head::Cosine, _) => (8, atom, 0),
            Atom::Of(Head::Inverse | Head::Bracket, _) => (12, atom, 0),
            Atom::Of(..) => (7, atom, 0),
        }
    }

    fn factor(&self, atom: AtomId, exponent: i32) -> Formula {
        let base = match self.atoms.get(atom) {
            Atom::Symbol(id) => Formula::Name((self.names.symbol)(*id)),
            Atom::Defined(number) => Formula::Name(self.defined[*number].clone()),
            Atom::Of(head, arguments) => self.applied(*head, arguments.iter().map(|p| self.formula(p)).collect()),
        };
        power(base, exponent.unsigned_abs())
    }

    fn applied(&self, head: Head, mut list: Vec<Formula>) -> Formula {
        let apply = |function, list| Formula::Apply(function, list);
        let first = |list: &mut Vec<Formula>| match list.is_empty() {
            true => raise("a function has its arguments"),
            false => Box::new(list.remove(0)),
        };
        let related = |relation, mut list: Vec<Formula>| {
            let left = first(&mut list);
            Formula::Related(relation, left, first(&mut list))
        };
        match head {
            Head::Sine => apply(Function::Sin, list),
            Head::Cosine => apply(Function::Cos, list),
            Head::Root | Head::Call(Call::Sqrt) => Formula::Root(first(&mut list)),
            Head::Inverse => Formula::Fraction(Box::new(Formula::integer(1)), first(&mut list)),
            Head::Bracket => *first(&mut list),
            Head::Call(call) if call.external().is_some() => {
                Formula::Called(Box::new((self.names.external)(call)), list)
            }
            Head::Call(call) => match call {
                Call::Tan => apply(Function::Tan, list),
                Call::Asin => apply(Function::Asin, list),
                Call::Acos => apply(Function::Acos, list),
                Call::Atan => apply(Function::Atan, list),
                Call::Atan2 => apply(Function::Atan2, list),
                Call::Sinh => apply(Function::Sinh, list),
                Call::Cosh => apply(Function::Cosh, list),
                Call::Tanh => apply(Function::Tanh, list),
                Call::Exp => apply(Function::Exp, list),
                Call::Ln => apply(Function::Ln, list),
                Call::Signum => apply(Function::Signum, list),
                Call::Min => apply(Function::Min, list),
                Call::Max => apply(Function::Max, list),
                Call::Epsilon => apply(Function::Epsilon, list),
                Call::Nan => apply(Function::Undefined, list),
                Call::Sqrt => Formula::Root(first(&mut list)),
                Call::Abs => Formula::Absolute(first(&mut list)),
                Call::Powf => {
                    let base = first(&mut list);
                    Formula::General(base, first(&mut list))
                }
                Call::Less => related(Relation::Less, list),
                Call::LessEqual => related(Relation::LessEqual, list),
                Call::Equal => related(Relation::Equal, list),
                Call::And => related(Relation::And, list),
                Call::Or => related(Relation::Or, list),
                Call::Not => Formula::Not(first(&mut list)),
                Call::External(_) | Call::ExternalSlope(..) | Call::ExternalCurvature(_) => {
                    raise("functions of the user's own have names")
                }
                Call::Select => {
                    let [condition, yes] = [*first(&mut list), *first(&mut list)];
                    Formula::Cases(Box::new([condition, yes, *first(&mut list)]))
                }
            },
        }
    }
}

fn of_class(class: Class) -> u8 {
    match class {
        Class::Parameter => 1,
        Class::Time => 2,
        Class::Input => 3,
        Class::State => 4,
        Class::Defined => 5,
        Class::Position => 6,
        Class::Rate => 9,
        Class::Acceleration => 10,
        Class::Multiplier => 11,
    }
}

fn power(base: Formula, exponent: u32) -> Formula {
    match (exponent, base) {
        (1, base) => base,
        (n, Formula::Power(base, m)) => Formula::Power(base, n * m),
        (n, base) => Formula::Power(Box::new(base), n),
    }
}

fn multiplied(mut factors: Vec<Formula>) -> Formula {
    match factors.len() {
        0 => Formula::integer(1),
        1 => factors.remove(0),
        _ => Formula::Product(factors),
    }
}

fn joined(mut terms: Vec<(bool, Formula)>) -> Formula {
    match terms.len() {
        0 => Formula::zero(),
        1 => {
            let (minus, formula) = terms.remove(0);
            if minus { Formula::Minus(Box::new(formula)) } else { formula }
        }
        _ => Formula::Sum(terms),
    }
}

/// Terms with the same sum for a factor, taken together.
fn with_common_brackets(mut terms: Vec<(bool, Formula)>) -> Vec<(bool, Formula)> {
    let bracket = |term: &Formula| match term {
        Formula::Product(factors) => factors.iter().find(|factor| matches!(factor, Formula::Sum(_))).cloned(),
        _ => None,
    };
    let mut at = 0;
    while at < terms.len() {
        let Some(sum) = bracket(&terms[at].1) else {
            at += 1;
            continue;
        };
        let has = |term: &(bool, Formula)| bracket(&term.1).as_ref() == Some(&sum);
        let (like, others): (Vec<_>, Vec<_>) = terms.drain(at..).partition(has);
        if like.len() > 1 {
            let rest = like.into_iter().map(|(minus, term)| (minus, without(term, &sum))).collect();
            terms.push((false, Formula::Product(vec![joined(rest), sum])));
        } else {
            terms.extend(like);
        }
        at += 1;
        terms.extend(others);
    }
    terms
}

/// A product without one of its factors.
fn without(product: Formula, factor: &Formula) -> Formula {
    match product {
        Formula::Product(mut factors) => {
            if let Some(at) = factors.iter().position(|own| own == factor) {
                factors.remove(at);
            }
            multiplied(factors)
        }
        other => other,
    }
}

fn length(terms: &[(bool, Formula)]) -> usize {
    terms.iter().map(|(_, term)| 1 + term.length()).sum()
}

fn divided(p: &Polynomial, number: Number, monomial: &Monomial) -> Polynomial {
    let inverse: Monomial = monomial.iter().map(|&(atom, e)| (atom, -e)).collect();
    let mut result = Polynomial::default();
    for (own, &n) in &p.terms {
        result.add_term(times(own, &inverse), n / number);
    }
    result
}

/// Terms with the factor, and the others.
fn split(p: &Polynomial, (atom, sign): (AtomId, i32)) -> (Polynomial, Polynomial) {
    let (mut with, mut without) = (Polynomial::default(), Polynomial::default());
    for (monomial, &n) in &p.terms {
        let has = monomial.iter().any(|&(own, e)| own == atom && e.signum() == sign);
        if has { &mut with } else { &mut without }.add_term(monomial.clone(), n);
    }
    (with, without)
}
