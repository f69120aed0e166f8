//! Stage `mechanics`: derivatives where roots vanish.
//!
//! In: derivatives, and what was differentiated. Out: the same, a number where a root is zero and the derivative exists.
//! The derivative of sqrt(x) is x' / (2 sqrt(x)). In `norm(v) * v` the root vanishes together with x', so the quotient is
//! 0 / 0 where the derivative is zero. Dividing by max(sqrt(x), 1e-30) gives zero there, and is the same wherever the root
//! is larger; x' is of the order of the root where x is a sum of squares, so nothing else changes. Where the slope is
//! infinite, as that of sqrt(x) itself, it comes out as a number of the order of 1e30. Quotients by roots that stand in the
//! function itself stay: where these are no numbers the function is none.

use std::collections::HashSet;

use crate::contracts::call::Call;
use crate::symbolic::graph::{Graph, Scalar, ScalarNode};
use crate::symbolic::substitute::Substitution;

/// Far below any length or speed, and a normal number in single precision, as its reciprocal is.
const LEAST_ROOT: f64 = 1e-30;

/// `values` is what `derivatives` were made from.
pub(super) fn guarded(g: &mut Graph, values: &[Scalar], derivatives: &[Scalar]) -> Vec<Scalar> {
    let own: HashSet<usize> = g.reachable_scalars(values).into_iter().collect();
    let mut quotients: Vec<(Scalar, Scalar)> = Vec::new();
    let mut reached = g.reachable_scalars(derivatives);
    reached.sort_unstable();
    for index in reached {
        let quotient = g.scalar_at(index);
        let ScalarNode::Reciprocal(root) = *g.node(quotient) else { continue };
        if own.contains(&index) || !matches!(g.node(root), ScalarNode::Sqrt(_) | ScalarNode::Call(Call::Sqrt, _)) {
            continue;
        }
        let least = g.decimal(LEAST_ROOT);
        let guarded = g.call(Call::Max, &[root.positive(), least]);
        let guarded = if root.is_negative() { -guarded } else { guarded };
        quotients.push((quotient, g.reciprocal(guarded)));
    }
    if quotients.is_empty() {
        return derivatives.to_vec();
    }
    Substitution::of_nodes(&quotients).scalars(g, derivatives)
}
