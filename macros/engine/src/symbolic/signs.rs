//! Stage `symbolic`: signs that are proven from the form of an expression.
//!
//! In: a scalar, or a mask. Out: whether it is positive, or holds, whatever its symbols are, as far as it is a number. It
//! is enough that a sum has no negative term and a product an even number of negative factors; roots are taken for
//! positive, since where one vanishes two branches meet. What isn't seen is not proven: the answer is never wrong.

use crate::contracts::call::Call;

use super::graph::{Graph, Scalar, ScalarNode};

/// How deep an expression is looked into.
const DEEPEST: usize = 64;

/// Whether a mask holds whatever its symbols are.
pub fn is_proven(g: &Graph, mask: Scalar) -> bool {
    match g.node(mask) {
        ScalarNode::Call(Call::And, list) => list.iter().all(|&one| is_proven(g, one)),
        ScalarNode::Call(Call::Or, list) => list.iter().any(|&one| is_proven(g, one)),
        ScalarNode::Call(Call::Less | Call::LessEqual, list) => match list[..] {
            [a, b] => is_difference_positive(g, a, b),
            _ => false,
        },
        _ => false,
    }
}

/// Whether a scalar is positive whatever its symbols are.
pub fn is_positive(g: &Graph, s: Scalar) -> bool {
    sign(g, s, DEEPEST) == Some(true)
}

/// b - a > 0, term by term.
fn is_difference_positive(g: &Graph, a: Scalar, b: Scalar) -> bool {
    let mut terms: Vec<Scalar> = Vec::new();
    for (s, flip) in [(a, true), (b, false)] {
        match g.node(s) {
            ScalarNode::Sum(list) => terms.extend(list.iter().map(|&t| t.flip_if(s.is_negative() != flip))),
            _ => terms.push(s.flip_if(flip)),
        }
    }
    terms.retain(|&t| t != Scalar::ZERO);
    // Terms that cancel, and literals together.
    let mut rest: Vec<Scalar> = Vec::new();
    let mut constant = 0.0;
    for term in terms {
        if let Some(n) = g.literal(term) {
            constant += n.value();
        } else if let Some(at) = rest.iter().position(|&other| other == -term) {
            rest.remove(at);
        } else {
            rest.push(term);
        }
    }
    constant >= 0.0 && (!rest.is_empty() || constant > 0.0) && rest.iter().all(|&t| sign(g, t, DEEPEST) == Some(true))
}

/// `true` for positive; nothing where it isn't known. An edge's own sign counts.
fn sign(g: &Graph, s: Scalar, depth: usize) -> Option<bool> {
    let depth = depth.checked_sub(1)?;
    let of = |s: Scalar| sign(g, s, depth);
    let own = match g.node(s) {
        ScalarNode::Literal(n) => match n.value() {
            x if x > 0.0 => true,
            x if x < 0.0 => false,
            _ => return None,
        },
        ScalarNode::Sum(list) => {
            let first = of(*list.first()?)?;
            if !list.iter().all(|&t| of(t) == Some(first)) {
                return None;
            }
            first
        }
        ScalarNode::Product(list) => {
            let mut positive = true;
            let mut rest: Vec<Scalar> = list.to_vec();
            while let Some(factor) = rest.pop() {
                // The square of what may be anything.
                if let Some(at) = rest.iter().position(|other| other.positive() == factor.positive()) {
                    positive ^= rest.remove(at) != factor;
                    continue;
                }
                positive ^= !of(factor)?;
            }
            positive
        }
        // A vector by itself is a sum of squares.
        ScalarNode::Dot(a, b) if *a == *b => true,
        ScalarNode::Dot(a, b) if *a == -*b => false,
        ScalarNode::Reciprocal(x) => of(*x)?,
        ScalarNode::Sqrt(_) | ScalarNode::Call(Call::Exp | Call::Cosh | Call::Abs, _) => true,
        ScalarNode::Call(Call::Select, list) => match list[..] {
            [_, a, b] => {
                let first = of(a)?;
                if of(b)? != first {
                    return None;
                }
                first
            }
            _ => return None,
        },
        _ => return None,
    };
    Some(own != s.is_negative())
}
