//! Stage `mechanics`: parameters that equations hold at their defaults.
//!
//! In: a group with equations that were left out though they hold for parameters like the declared ones only. Out: the parameters
//! that break them. At other values of these the loop is open: closed forms, which rest on all equations, give cosines and sines
//! that belong to no angle, and nothing can be told from comparing functions there.

use super::configurations::{Configuration, Search};
use super::problem::Problem;
use super::tape::Values;
use super::{CoupledRows, OFF, rank};

/// Parameters by number and element. One is free if the loop closes with it moved, and no more of its `rows` are independent then;
/// all that are free are moved together in the end.
pub(super) fn pinned(
    problem: &Problem,
    group: &CoupledRows,
    rows: &[usize],
    from: &[Configuration],
) -> Vec<(usize, usize)> {
    let parameters = problem.parameters_of(&group.equations);
    let Some(from) = from.iter().find(|configuration| configuration.closed) else {
        return parameters.into_iter().map(|(_, parameter)| parameter).collect();
    };
    let (search, rank) = (Search::new(problem, &group.equations, &group.columns), rank::of(&from.jacobian, rows));
    let mut values = Values::default();
    let mut holds = |moved: &[usize]| {
        let mut point = from.point.clone();
        for (k, &symbol) in moved.iter().enumerate() {
            if let Some(value) = point.0.get_mut(symbol) {
                // Each by something else: two that are equal may have to stay so.
                *value += OFF * (1.0 + value.abs()) / (1.0 + 0.37 * k as f64);
            }
        }
        search.close(&mut point, &mut values) && rank::of(&search.jacobian_at(&point, &mut values), rows) == rank
    };
    let (free, mut pinned): (Vec<_>, Vec<_>) = parameters.into_iter().partition(|&(symbol, _)| holds(&[symbol]));
    let symbols: Vec<usize> = free.iter().map(|one| one.0).collect();
    if !holds(&symbols) {
        pinned.extend(free);
    }
    pinned.into_iter().map(|(_, parameter)| parameter).collect()
}
