//! Room `written`: where a closed form holds.
//!
//! In: the root that a closed form takes, the conditions that choose among solutions. Out: sentences: which branch was chosen, and
//! what must not be negative for it to be real.

use std::collections::HashMap;

use crate::contracts::call::Call;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::loops::structure::Means;
use crate::model::types::{Coordinate, SolveHow};
use crate::symbolic::graph::{Graph, Scalar, ScalarNode};
use crate::symbolic::write::formula::{Formula, Identifier, Relation};
use crate::symbolic::write::text;

/// Conditions as they are written, by the coordinate whose solution they choose.
pub(super) type Conditions = HashMap<Coordinate, Vec<String>>;

/// A longer one is not written out.
const MOST_SYMBOLS: usize = 60;

/// What is longer and stands in the line itself is not repeated.
const MOST_CHARACTERS: usize = 40;

/// What must not be negative for a root to be real, and is zero in its dead centres alone: what stands under it, or its square.
/// None where no one value says so much: of several roots each must be real, and a factor beside one may vanish too.
pub fn radicand(g: &mut Graph, root: Scalar) -> Option<Scalar> {
    let factors = match g.node(root) {
        ScalarNode::Product(factors) => factors.to_vec(),
        _ => vec![root],
    };
    let under = |&factor: &Scalar| match *g.node(factor) {
        ScalarNode::Sqrt(radicand) => Some(radicand),
        _ => None,
    };
    // A sign that is chosen at run time may stand before it.
    let is_sign =
        |&factor: &Scalar| matches!(g.node(factor), ScalarNode::Literal(_) | ScalarNode::Call(Call::Select, _));
    let roots: Vec<Scalar> = factors.iter().filter_map(under).collect();
    let signs = factors.iter().filter(|&factor| is_sign(factor)).count();
    match roots[..] {
        [] => Some(g.mul(root, root)),
        [radicand] if signs + 1 == factors.len() => Some(radicand),
        _ => None,
    }
}

/// What can be said of any root.
pub(super) const BETWEEN: &str = "real between its dead centres, where the root vanishes";

/// Whether conditions choose the value when it is evaluated.
pub(super) fn is_chosen(g: &Graph, value: Scalar) -> bool {
    let scalars = g.reachable_scalars(&[value]).into_iter().map(|index| g.scalar_at(index));
    scalars.into_iter().any(|s| matches!(g.node(s), ScalarNode::Call(Call::Select, _)))
}

/// Where a root is real. `hidden` are names that stand nowhere else; `is_square` says that the radicand is one, or a sum of them, however it is
/// written. `line` is the formula that takes it.
pub(super) fn real(radicand: &Formula, is_square: bool, line: &Formula, hidden: &[Identifier]) -> String {
    if radicand.length() > MOST_SYMBOLS || reads_any(radicand, hidden) {
        return BETWEEN.to_owned();
    }
    let written = text::formula(radicand);
    // Where the line itself has it, a long one is not repeated.
    let is_said = written.chars().count() > MOST_CHARACTERS && takes_root_of(line, radicand);
    let [zero, positive] = match is_said {
        true => ["the radicand is zero".to_owned(), "the radicand is not negative".to_owned()],
        false => [format!("`{written} = 0`"), format!("`{written} >= 0`")],
    };
    match at_least_zero(radicand).or(is_square.then_some(false)) {
        Some(true) => "real everywhere".to_owned(),
        Some(false) => format!("real everywhere, its only dead centres where {zero}"),
        None => format!("real where {positive}, with dead centres where it is zero"),
    }
}

/// Whether it is a vector by itself, which may be written out as any polynomial.
pub(super) fn is_square(g: &Graph, radicand: Scalar) -> bool {
    matches!(*g.node(radicand), ScalarNode::Dot(a, b) if a == b) && !radicand.is_negative()
}

/// Of what is written as numbers and squares, added and multiplied, and so is never negative: whether it is never zero.
fn at_least_zero(formula: &Formula) -> Option<bool> {
    match formula {
        Formula::Number(digits) => Some(digits != "0"),
        Formula::Power(_, n) if n % 2 == 0 => Some(false),
        Formula::Product(factors) => factors.iter().try_fold(true, |all, factor| Some(at_least_zero(factor)? && all)),
        Formula::Sum(terms) => terms.iter().try_fold(false, |any, (minus, term)| {
            let positive = at_least_zero(term).filter(|_| !minus)?;
            Some(positive || any)
        }),
        _ => None,
    }
}

/// A condition in plain text, with what varies on the left.
pub(super) fn condition(formula: &Formula) -> String {
    let is_number = |side: &Formula| {
        let mut is_number = true;
        side.each_part(&mut |part| is_number &= matches!(part, Formula::Number(_)));
        is_number && matches!(side, Formula::Number(_) | Formula::Minus(_))
    };
    match formula {
        Formula::Related(relation @ (Relation::Less | Relation::LessEqual), left, right) if is_number(left) => {
            let sign = if *relation == Relation::Less { ">" } else { ">=" };
            format!("{} {sign} {}", text::formula(right), text::formula(left))
        }
        other => text::formula(other),
    }
}

fn takes_root_of(formula: &Formula, radicand: &Formula) -> bool {
    let mut found = matches!(formula, Formula::Root(own) if **own == *radicand);
    formula.each_part(&mut |part| found |= takes_root_of(part, radicand));
    found
}

fn reads_any(formula: &Formula, names: &[Identifier]) -> bool {
    let mut found = matches!(formula, Formula::Name(own) if names.contains(own));
    formula.each_part(&mut |part| found |= reads_any(part, names));
    found
}

/// Conditions of all loops that are solved, each with the last found of the coordinates that it reads.
pub(super) fn chosen(e: &mut Equations<'_>, reduction: &Reduction) -> Vec<(Coordinate, Scalar)> {
    let model = e.scene.model;
    let structure = std::rc::Rc::clone(&e.scene.structure);
    let mut chosen = Vec::new();
    for step in &structure.steps {
        let Means::Solve(item) = step.means else { continue };
        let SolveHow::From { branches, .. } = &model.solves[item].how else { continue };
        for condition in branches {
            let value = e.scalar(condition);
            let value = e.put_in_stand_ins(&[value])[0];
            let read = e.g.reachable_scalars(&[value]);
            let mut found = reduction.definitions.iter().map(|definition| definition.coordinate);
            let is_read =
                |c: &Coordinate| step.unknowns.contains(c) && read.contains(&e.coordinate_symbols(*c)[0].index());
            if let Some(coordinate) = found.rfind(is_read) {
                chosen.push((coordinate, value));
            }
        }
    }
    chosen
}

/// Two sentences as one.
pub(super) fn joined(first: Option<String>, second: Option<String>) -> Option<String> {
    match (first, second) {
        (Some(first), Some(second)) => Some(format!("{first}; {second}")),
        (first, second) => first.or(second),
    }
}
