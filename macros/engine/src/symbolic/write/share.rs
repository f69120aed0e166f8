//! Stage `symbolic`, writing: what several formulas have in common, written once.
//!
//! In: formulas that are read together, such as the equations of one loop. Out: the same with names for what they share, and
//! what these stand for. Two terms of a sum or two factors of a product are shared wherever both stand, so the whole is
//! what an engineer who counts operations would write. Angles stay as they are: `sin(a + b)` says what it is.

use std::collections::HashMap;

use super::formula::{Class, Formula, Identifier};
use super::text;

/// What is shorter stays where it stands.
const LEAST: usize = 3;

/// What counts.
#[derive(Clone, Copy, PartialEq)]
pub enum By {
    /// Every addition and product once.
    Operations,
    /// Fewer symbols in all, by far.
    Length,
}

/// A name is worth its line where it saves so many symbols.
const LEAST_SAVED: usize = 4;

/// A bound; each round shares one thing.
const MOST_ROUNDS: usize = 40;

/// A name and what it stands for.
#[derive(Clone)]
pub struct Shared {
    pub name: Identifier,
    pub value: Formula,
}

/// Something that may stand in several places.
#[derive(Clone, PartialEq)]
enum Common {
    /// Two terms, and whether their signs differ.
    Terms(Formula, Formula, bool),
    Factors(Formula, Formula),
    Whole(Formula),
}

impl Common {
    fn value(self) -> Formula {
        match self {
            Common::Terms(first, second, differ) => Formula::Sum(vec![(false, first), (differ, second)]),
            Common::Factors(first, second) => Formula::Product(vec![first, second]),
            Common::Whole(formula) => formula,
        }
    }
}

/// Names at most `most` values that stand in several places; `name` gives the name of each by its number, from one.
pub fn share(formulas: &mut [Formula], by: By, most: usize, name: &mut dyn FnMut(usize) -> Identifier) -> Vec<Shared> {
    let mut list: Vec<Formula> = formulas.to_vec();
    // What is shared stands behind the formulas, by the number that its name has for now.
    let mut names: Vec<Identifier> = Vec::new();
    let wanted = list.len();
    for _ in 0..MOST_ROUNDS {
        let common = match by {
            By::Operations => most_frequent(&list),
            By::Length => longest(&list),
        };
        let Some(common) = common else { break };
        let own = temporary(names.len());
        let before = (list.clone(), names.clone());
        let put_in = Formula::Name(own.clone());
        list.iter_mut().for_each(|formula| replace(formula, &common, &put_in, true));
        list.push(common.value());
        names.push(own);
        inline(&mut list, &mut names, wanted);
        if names.len() > most {
            (list, names) = before;
            break;
        }
    }
    let values = list.split_off(wanted);
    let order = by_first_use(&list, &values, &names);
    let fresh: HashMap<Identifier, Identifier> =
        order.iter().enumerate().map(|(k, &at)| (names[at].clone(), name(k + 1))).collect();
    let rename = |formula: &mut Formula| {
        formula.each_name_mut(&mut |identifier| {
            if let Some(known) = fresh.get(identifier) {
                *identifier = known.clone();
            }
        });
        in_order(formula);
    };
    list.iter_mut().for_each(rename);
    formulas.clone_from_slice(&list);
    let shared = order.into_iter().map(|at| {
        let mut value = values[at].clone();
        rename(&mut value);
        Shared { name: fresh[&names[at]].clone(), value }
    });
    shared.collect()
}

/// Puts names in wherever what they stand for is written out.
pub fn put_in(formula: &mut Formula, shared: &[Shared]) {
    for Shared { name, value } in shared {
        let common = match value {
            Formula::Sum(terms) if terms.len() == 2 => {
                Common::Terms(terms[0].1.clone(), terms[1].1.clone(), terms[0].0 != terms[1].0)
            }
            Formula::Product(factors) if factors.len() == 2 => Common::Factors(factors[0].clone(), factors[1].clone()),
            other => Common::Whole(other.clone()),
        };
        replace(formula, &common, &Formula::Name(name.clone()), true);
    }
    in_order(formula);
}

/// Factors as they are written elsewhere: numbers, names, sines, rates, sums.
fn in_order(formula: &mut Formula) {
    fn rank(factor: &Formula) -> u8 {
        match factor {
            Formula::Number(_) | Formula::Pi => 0,
            Formula::Name(name) => match name.class {
                Class::Parameter | Class::Time | Class::Input | Class::State => 1,
                Class::Defined => 2,
                Class::Position => 3,
                Class::Rate | Class::Acceleration | Class::Multiplier => 6,
            },
            Formula::Power(base, _) => rank(base),
            Formula::Apply(..) | Formula::Called(..) => 5,
            Formula::Sum(_) => 7,
            _ => 4,
        }
    }
    if let Formula::Product(factors) = formula {
        factors.sort_by_key(rank);
    }
    each_part_mut(formula, &mut in_order);
}

/// A name that no user can give.
fn temporary(number: usize) -> Identifier {
    Identifier { text: format!("\u{0}{number}"), dots: 0, index: None, class: Class::Defined, typed: true }
}

/// What stands in the most places, the first of several; none if everything stands in one.
fn most_frequent(list: &[Formula]) -> Option<Common> {
    let mut counts: HashMap<String, usize> = HashMap::new();
    let mut order: Vec<(String, Common)> = Vec::new();
    for formula in list {
        each_common(formula, true, &mut |common| {
            // A number times a name is no reason for a line.
            if common.clone().value().length() < LEAST {
                return;
            }
            let key = text::formula(&common.clone().value());
            let count = counts.entry(key.clone()).or_default();
            *count += 1;
            if *count == 1 {
                order.push((key, common));
            }
        });
    }
    let most = counts.values().copied().max().filter(|&most| most > 1)?;
    order.into_iter().find(|(key, _)| counts[key] == most).map(|(_, common)| common)
}

/// The whole that saves most.
fn longest(list: &[Formula]) -> Option<Common> {
    fn visit(formula: &Formula, counts: &mut HashMap<String, usize>, order: &mut Vec<(String, Formula, usize)>) {
        if matches!(
            formula,
            Formula::Apply(..) | Formula::Called(..) | Formula::Related(..) | Formula::Not(_) | Formula::Cases(_)
        ) {
            return;
        }
        let length = formula.length();
        if length > LEAST && !matches!(formula, Formula::Minus(_)) {
            let key = text::formula(formula);
            let count = counts.entry(key.clone()).or_default();
            *count += 1;
            if *count == 1 {
                order.push((key, formula.clone(), length));
            }
        }
        formula.each_part(&mut |part| visit(part, counts, order));
    }
    let (mut counts, mut order) = (HashMap::new(), Vec::new());
    list.iter().for_each(|formula| visit(formula, &mut counts, &mut order));
    // Its line has a name, a sign and what it says.
    let saved = |(key, _, length): &(String, Formula, usize)| {
        let count = counts[key];
        (count * length).saturating_sub(count + length + 3)
    };
    let most = order.iter().map(saved).max().filter(|&most| most >= LEAST_SAVED)?;
    order.into_iter().find(|one| saved(one) == most).map(|(_, formula, _)| Common::Whole(formula))
}

/// Visits what may be shared. Of a sum of two terms that is a factor the sign can't be taken out, so its first term is added.
fn each_common(formula: &Formula, is_line: bool, visit: &mut dyn FnMut(Common)) {
    match formula {
        Formula::Number(_) | Formula::Pi | Formula::Name(_) | Formula::Minus(_) => {}
        Formula::Apply(..) | Formula::Called(..) | Formula::Related(..) | Formula::Not(_) | Formula::Cases(_) => return,
        Formula::Sum(terms) => {
            for (i, first) in terms.iter().enumerate() {
                for second in &terms[i + 1..] {
                    if is_line || terms.len() > 2 || !first.0 {
                        visit(terms_of(first, second));
                    }
                }
            }
        }
        Formula::Product(factors) => {
            for (i, first) in factors.iter().enumerate() {
                for second in &factors[i + 1..] {
                    visit(factors_of(first, second));
                }
            }
        }
        // A root of a number is a number.
        Formula::Root(x) if matches!(**x, Formula::Number(_)) => {}
        whole => visit(Common::Whole(whole.clone())),
    }
    formula.each_part(&mut |part| each_common(part, false, visit));
}

fn terms_of(first: &(bool, Formula), second: &(bool, Formula)) -> Common {
    Common::Terms(first.1.clone(), second.1.clone(), first.0 != second.0)
}

fn factors_of(first: &Formula, second: &Formula) -> Common {
    Common::Factors(first.clone(), second.clone())
}

/// Puts a name in wherever something stands.
fn replace(formula: &mut Formula, common: &Common, name: &Formula, is_line: bool) {
    if let Formula::Apply(..) | Formula::Called(..) | Formula::Related(..) | Formula::Not(_) | Formula::Cases(_) =
        formula
    {
        return;
    }
    match (&mut *formula, common) {
        (Formula::Sum(terms), Common::Terms(first, second, differ)) => {
            let place = |wanted: &Formula| terms.iter().position(|(_, term)| term == wanted);
            if let (Some(i), Some(j)) = (place(first), place(second))
                && (terms[i].0 != terms[j].0) == *differ
                && (is_line || terms.len() > 2 || !terms[i].0)
            {
                let minus = terms[i].0;
                terms[i] = (minus, name.clone());
                terms.remove(j);
                terms.sort_by_key(|term| term.0);
                if terms.len() == 1 {
                    *formula = if minus { Formula::Minus(Box::new(name.clone())) } else { name.clone() };
                    return;
                }
            }
        }
        (Formula::Product(factors), Common::Factors(first, second)) => {
            let i = factors.iter().position(|factor| factor == first);
            let j = factors.iter().enumerate().position(|(k, factor)| factor == second && Some(k) != i);
            if let (Some(i), Some(j)) = (i, j) {
                factors[i.min(j)] = name.clone();
                factors.remove(i.max(j));
                if factors.len() == 1 {
                    *formula = name.clone();
                    return;
                }
            }
        }
        (whole, Common::Whole(wanted)) if whole == wanted => {
            *formula = name.clone();
            return;
        }
        _ => {}
    }
    each_part_mut(formula, &mut |part| replace(part, common, name, false));
}

fn each_part_mut(formula: &mut Formula, visit: &mut dyn FnMut(&mut Formula)) {
    match formula {
        Formula::Number(_) | Formula::Pi | Formula::Name(_) => {}
        Formula::Minus(x) | Formula::Power(x, _) | Formula::Root(x) | Formula::Absolute(x) | Formula::Not(x) => {
            visit(x)
        }
        Formula::Sum(terms) => terms.iter_mut().for_each(|(_, term)| visit(term)),
        Formula::Product(list) | Formula::Apply(_, list) | Formula::Called(_, list) => list.iter_mut().for_each(visit),
        Formula::Fraction(a, b) | Formula::General(a, b) | Formula::Related(_, a, b) => {
            visit(a);
            visit(b);
        }
        Formula::Cases(parts) => parts.iter_mut().for_each(visit),
    }
}

/// What is read once only goes back to where it is read.
fn inline(list: &mut Vec<Formula>, names: &mut Vec<Identifier>, wanted: usize) {
    loop {
        let uses = |name: &Identifier| -> usize { list.iter().map(|formula| count(formula, name)).sum() };
        let Some(at) = names.iter().position(|name| uses(name) < 2) else { return };
        let (name, value) = (names.remove(at), list.remove(wanted + at));
        list.iter_mut().for_each(|formula| write_out(formula, &name, &value));
    }
}

fn count(formula: &Formula, name: &Identifier) -> usize {
    let mut uses = usize::from(matches!(formula, Formula::Name(own) if own == name));
    formula.each_part(&mut |part| uses += count(part, name));
    uses
}

/// Puts a value in for a name, without brackets where sums stand in sums and products in products.
fn write_out(formula: &mut Formula, name: &Identifier, value: &Formula) {
    let is_it = |part: &Formula| matches!(part, Formula::Name(own) if own == name);
    match (&mut *formula, value) {
        (Formula::Sum(terms), Formula::Sum(inner)) => {
            if let Some(at) = terms.iter().position(|(_, term)| is_it(term)) {
                let minus = terms[at].0;
                terms.splice(at..=at, inner.iter().map(|(own, term)| (*own != minus, term.clone())));
                terms.sort_by_key(|term| term.0);
            }
        }
        (Formula::Product(factors), Formula::Product(inner)) => {
            if let Some(at) = factors.iter().position(is_it) {
                factors.splice(at..=at, inner.iter().cloned());
            }
        }
        (own, _) if is_it(own) => {
            *formula = value.clone();
            return;
        }
        _ => {}
    }
    each_part_mut(formula, &mut |part| write_out(part, name, value));
}

/// Places of values, each behind those that it reads, in the order in which formulas come to need them.
fn by_first_use(list: &[Formula], values: &[Formula], names: &[Identifier]) -> Vec<usize> {
    fn visit(formula: &Formula, values: &[Formula], names: &[Identifier], order: &mut Vec<usize>) {
        if let Formula::Name(own) = formula
            && let Some(at) = names.iter().position(|name| name == own)
            && !order.contains(&at)
        {
            visit(&values[at], values, names, order);
            order.push(at);
        }
        formula.each_part(&mut |part| visit(part, values, names, order));
    }
    let mut order = Vec::new();
    list.iter().for_each(|formula| visit(formula, values, names, &mut order));
    order
}
