//! Stage `optimize`, packs: the work of several members as one expression on packs.
//!
//! In: an expression of each member, alike by signature. Out: one expression whose leaves are packs, and the members whose value is
//! minus what it gives. Terms and factors stand in the order of the first member.
//!
//! Limbs on the left and on the right differ by signs. A pack carries a sign for each member instead of the values themselves: signs
//! of products multiply, a sum has those of most of its terms, and what differs from these goes into a literal of the term, or
//! is a further product with ones and minus ones. So a mirrored limb costs few products, and no value is rounded otherwise; where
//! a sum cancels to zero, its zero may have the other sign.

use std::cmp::Reverse;
use std::collections::HashMap;

use crate::contracts::call::Call;
use crate::invariant::injection::{Break, broken};
use crate::optimize::program::{Expression, Local, MEMBERS, Size};

use super::likeness::Likeness;

/// Which members are minus what a pack gives.
pub(super) type Signs = [bool; MEMBERS];

/// Members' own expressions, with their places in the pack.
type Members<'e> = Vec<(usize, &'e Expression)>;

/// The signature of an operand, and what limbs may have in common beside it.
type Form = (u64, Vec<(u8, u64)>);

/// Where a local is in a pack: how many members that has, its local, the place there, the signs of the pack.
pub(super) type Packed = HashMap<Local, (Size, Local, usize, Signs)>;

pub(super) struct Unifier<'a> {
    pub(super) likeness: &'a Likeness<'a>,
    pub(super) packed: &'a Packed,
    /// How many members the pack has.
    pub(super) size: Size,
}

/// An expression on packs.
pub(super) struct Value {
    pub(super) expression: Expression,
    pub(super) signs: Signs,
}

impl Unifier<'_> {
    /// Nothing where the members are not alike.
    pub(super) fn unify(&self, members: &Members<'_>) -> Option<Value> {
        let mut signs = [false; MEMBERS];
        let bare: Members<'_> = members
            .iter()
            .map(|&(place, mut expression)| {
                while let Expression::Neg(inner) = expression {
                    signs[place] ^= true;
                    expression = inner;
                }
                (place, expression)
            })
            .collect();
        let mut value = self.bare(&bare)?;
        for &(place, _) in members {
            value.signs[place] ^= signs[place];
        }
        Some(value)
    }

    /// With all signs of the members in the expression.
    pub(super) fn unsigned(&self, members: &Members<'_>) -> Option<Expression> {
        let value = self.unify(members)?;
        Some(positive(value, members).expression)
    }

    fn bare(&self, members: &Members<'_>) -> Option<Value> {
        let &(_, first) = members.first()?;
        match first {
            Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => {
                self.leaves(members)
            }
            Expression::Sum(_) => self.sum(members),
            Expression::Product(_) => self.product(members),
            Expression::Quotient(..) => {
                let part = |which: usize| {
                    let each = members.iter().map(|&(place, expression)| match expression {
                        Expression::Quotient(above, below) => Some((place, [&**above, &**below][which])),
                        _ => None,
                    });
                    self.unify(&each.collect::<Option<Members<'_>>>()?)
                };
                let (above, below) = (part(0)?, part(1)?);
                let signs = std::array::from_fn(|k| above.signs[k] != below.signs[k]);
                let expression = Expression::Quotient(Box::new(above.expression), Box::new(below.expression));
                Some(Value { expression, signs })
            }
            Expression::Call(Call::Sqrt, _) => {
                let each = members.iter().map(|&(place, expression)| match expression {
                    Expression::Call(Call::Sqrt, list) => list.first().map(|item| (place, item)),
                    _ => None,
                });
                let inner = self.unsigned(&each.collect::<Option<Members<'_>>>()?)?;
                Some(Value { expression: Expression::Call(Call::Sqrt, vec![inner]), signs: [false; MEMBERS] })
            }
            Expression::Fused(_) | Expression::Call(..) | Expression::Neg(_) | Expression::Pack(_) => None,
        }
    }

    /// One pack, one value for all, or a pack of scalars.
    fn leaves(&self, members: &Members<'_>) -> Option<Value> {
        let none = [false; MEMBERS];
        let &(first, expression) = members.first()?;
        let is_leaf = |expression: &Expression| {
            matches!(
                expression,
                Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_)
            )
        };
        if !members.iter().all(|(_, expression)| is_leaf(expression)) {
            return None;
        }
        if members.iter().all(|(_, other)| *other == expression) {
            return Some(Value { expression: Expression::Pack(vec![expression.clone()]), signs: none });
        }
        let place_of = |expression: &Expression| match expression {
            Expression::Local(local) => self.packed.get(local).copied(),
            _ => None,
        };
        if let Some((size, pack, at, signs)) = place_of(expression)
            && (size, at) == (self.size, first)
            && members
                .iter()
                .all(|&(place, other)| place_of(other).is_some_and(|(_, theirs, at, _)| theirs == pack && at == place))
        {
            return Some(Value { expression: Expression::Local(pack), signs });
        }
        let mut list = vec![expression.clone(); MEMBERS];
        for &(place, expression) in members {
            let lane = if broken(Break::LaneIndex) { (place + 1) % self.size.members() } else { place };
            list[lane] = expression.clone();
        }
        Some(Value { expression: Expression::Pack(list), signs: none })
    }

    fn sum(&self, members: &Members<'_>) -> Option<Value> {
        let mut lists = Vec::with_capacity(members.len());
        for &(place, expression) in members {
            let Expression::Sum(terms) = expression else { return None };
            // An empty one is a number, which is no pack.
            terms.first()?;
            let list: Vec<&Expression> = terms.iter().map(|(_, term)| term).collect();
            lists.push((place, terms, list));
        }
        let order = self.aligned(&lists.iter().map(|(.., list)| &list[..]).collect::<Vec<_>>())?;
        let mut terms: Vec<Value> = Vec::new();
        for row in &order {
            let each: Members<'_> = lists.iter().zip(row).map(|((place, _, list), &at)| (*place, list[at])).collect();
            let mut value = self.unify(&each)?;
            for ((place, terms, _), &at) in lists.iter().zip(row) {
                value.signs[*place] ^= terms[at].0;
            }
            terms.push(value);
        }
        let places: Vec<usize> = members.iter().map(|member| member.0).collect();
        let signs = prevailing(&terms, &places);
        let summed = terms.into_iter().map(|term| {
            let rest: Signs = std::array::from_fn(|k| places.contains(&k) && term.signs[k] != signs[k]);
            // One sign for all of them is a subtraction.
            let minus = rest[places[0]];
            let flips: Signs = std::array::from_fn(|k| places.contains(&k) && rest[k] != minus);
            (minus, flipped(term.expression, flips))
        });
        Some(Value { expression: Expression::Sum(summed.collect()), signs })
    }

    fn product(&self, members: &Members<'_>) -> Option<Value> {
        let mut lists = Vec::with_capacity(members.len());
        for &(place, expression) in members {
            let Expression::Product(factors) = expression else { return None };
            factors.first()?;
            lists.push((place, factors.iter().collect::<Vec<_>>()));
        }
        let order = self.aligned(&lists.iter().map(|(_, list)| &list[..]).collect::<Vec<_>>())?;
        let mut signs = [false; MEMBERS];
        let mut factors = Vec::new();
        for row in &order {
            let each: Members<'_> = lists.iter().zip(row).map(|((place, list), &at)| (*place, list[at])).collect();
            let value = self.unify(&each)?;
            signs = std::array::from_fn(|k| signs[k] != value.signs[k]);
            factors.push(value.expression);
        }
        let product = Expression::Product(factors);
        if holds_literals(&product) {
            return Some(Value { expression: flipped(product, signs), signs: [false; MEMBERS] });
        }
        Some(Value { expression: product, signs })
    }

    /// For each operand of the first list the one of each list that goes with it: those of one form, and of these the ones first that have
    /// most numbers and shared values in common.
    fn aligned(&self, lists: &[&[&Expression]]) -> Option<Vec<Vec<usize>>> {
        let forms = |list: &[&Expression]| -> Option<Vec<Form>> {
            list.iter().map(|item| Some((self.likeness.signature(item)?, self.likeness.common(item)))).collect()
        };
        let first = forms(lists.first()?)?;
        let mut order: Vec<Vec<usize>> = (0..first.len()).map(|at| vec![at]).collect();
        for list in &lists[1..] {
            let others = forms(list)?;
            if others.len() != first.len() {
                return None;
            }
            let mut pairs = Vec::new();
            for (row, (signature, common)) in first.iter().enumerate() {
                for (at, (_, other)) in others.iter().enumerate().filter(|(_, form)| form.0 == *signature) {
                    let shared = common.iter().filter(|entry| other.contains(entry)).count();
                    pairs.push((Reverse((common == other, shared)), row, at));
                }
            }
            pairs.sort_unstable();
            let (mut found, mut taken) = (vec![None; first.len()], vec![false; others.len()]);
            for (_, row, at) in pairs {
                if found[row].is_none() && !taken[at] {
                    found[row] = Some(at);
                    taken[at] = true;
                }
            }
            for (row, at) in order.iter_mut().zip(found) {
                row.push(at?);
            }
        }
        Some(order)
    }
}

/// The signs that most terms have that can't take others for nothing, up to one sign for all; the first member has none.
fn prevailing(terms: &[Value], places: &[usize]) -> Signs {
    let normal =
        |signs: &Signs| -> Signs { std::array::from_fn(|k| places.contains(&k) && signs[k] != signs[places[0]]) };
    let mut counts: Vec<(Signs, usize)> = Vec::new();
    for term in terms.iter().filter(|term| !holds_literals(&term.expression)) {
        let signs = normal(&term.signs);
        match counts.iter_mut().find(|known| known.0 == signs) {
            Some(known) => known.1 += 1,
            None => counts.push((signs, 1)),
        }
    }
    let most = counts.iter().map(|known| known.1).max();
    counts.iter().find(|known| Some(known.1) == most).map_or([false; MEMBERS], |known| known.0)
}

/// Whether it can change signs of members for nothing.
fn holds_literals(expression: &Expression) -> bool {
    match expression {
        Expression::Pack(list) => list.iter().all(|item| matches!(item, Expression::Literal(_))),
        Expression::Product(list) => list.iter().any(holds_literals),
        Expression::Quotient(above, _) => holds_literals(above),
        _ => false,
    }
}

fn positive(value: Value, members: &Members<'_>) -> Value {
    let all = members.iter().all(|member| value.signs[member.0]);
    let expression = match (all, value.expression) {
        (true, expression) => Expression::Neg(Box::new(expression)),
        (false, expression) => flipped(expression, value.signs),
    };
    Value { expression, signs: [false; MEMBERS] }
}

/// The same with these members negative.
fn flipped(expression: Expression, signs: Signs) -> Expression {
    if !signs.contains(&true) {
        return expression;
    }
    match expression {
        Expression::Pack(list) if list.iter().all(|item| matches!(item, Expression::Literal(_))) => {
            let flip = |k: usize| match list[k.min(list.len() - 1)] {
                Expression::Literal(value) => Expression::Literal(if signs[k] { -value } else { value }),
                ref other => other.clone(),
            };
            Expression::Pack((0..MEMBERS).map(flip).collect())
        }
        Expression::Product(mut list) => {
            match list.iter().position(holds_literals) {
                Some(at) => list[at] = flipped(list[at].clone(), signs),
                None => list.push(ones(signs)),
            }
            Expression::Product(list)
        }
        Expression::Quotient(above, below) => Expression::Quotient(Box::new(flipped(*above, signs)), below),
        other => Expression::Product(vec![other, ones(signs)]),
    }
}

fn ones(signs: Signs) -> Expression {
    Expression::Pack(signs.iter().map(|&minus| Expression::Literal(if minus { -1.0 } else { 1.0 })).collect())
}
