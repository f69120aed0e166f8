//! Stage `optimize`, packs: sums over members.
//!
//! In: a sum with members of packs among its terms. Out: the same with those of even places added up by themselves, and those of odd
//! places beside them, then both: places 0 and 1 of a pack of `f64`, and 2 and 3, are a register of two each, so compilers add the
//! halves of packs as they are, with one addition for two of them, and take members out of the last one alone.

use std::collections::HashMap;

use crate::optimize::program::{Expression, Local};

/// Fewer members are added as they come.
const LEAST: usize = 4;

/// Puts members together; `places` are those of members in their packs.
pub(super) fn halve(value: &mut Expression, places: &HashMap<Local, usize>) {
    let Expression::Sum(terms) = value else { return };
    let place = |term: &Expression| match term {
        Expression::Local(local) => places.get(local).copied(),
        _ => None,
    };
    let count = |odd: usize| terms.iter().filter(|(_, term)| place(term).is_some_and(|at| at % 2 == odd)).count();
    let (even, odd) = (count(0), count(1));
    if even < 2 || odd < 2 || even + odd < LEAST {
        return;
    }
    let mut halves: [Vec<(bool, Expression)>; 2] = Default::default();
    let mut rest = Vec::new();
    for (minus, term) in std::mem::take(terms) {
        match place(&term) {
            Some(at) => halves[at % 2].push((minus, term)),
            None => rest.push((minus, term)),
        }
    }
    // In the order of their places, and with the sign of most in front.
    let negative = halves.iter().flatten().filter(|(minus, _)| *minus).count();
    let minus = 2 * negative > even + odd;
    for half in &mut halves {
        half.iter_mut().for_each(|term| term.0 ^= minus);
        half.sort_by_key(|(minus, term)| (*minus, place(term)));
    }
    let sums = halves.map(|half| (false, Expression::Sum(half)));
    let sum = (minus, Expression::Sum(sums.into()));
    let at = if minus { rest.len() } else { 0 };
    rest.insert(at, sum);
    *terms = rest;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn terms(list: &[(bool, usize)]) -> Vec<(bool, Expression)> {
        list.iter().map(|&(minus, local)| (minus, Expression::Local(Local(local)))).collect()
    }

    /// Six members of two packs, with what is no member, then all with the other sign; three members stay as they are.
    #[test]
    fn members_are_added_by_halves() {
        let places: HashMap<Local, usize> = (0..6).map(|k| (Local(k), k % 4)).collect();
        let mut sum =
            Expression::Sum(terms(&[(false, 9), (true, 0), (true, 1), (true, 2), (false, 3), (true, 4), (true, 5)]));
        halve(&mut sum, &places);
        let halves = [terms(&[(false, 0), (false, 4), (false, 2)]), terms(&[(false, 1), (false, 5), (true, 3)])];
        let both = Expression::Sum(halves.map(|half| (false, Expression::Sum(half))).into());
        assert_eq!(sum, Expression::Sum([terms(&[(false, 9)]), vec![(true, both)]].concat()));

        let few = Expression::Sum(terms(&[(false, 0), (false, 1), (false, 2)]));
        let mut same = few.clone();
        halve(&mut same, &places);
        assert_eq!(same, few);
    }
}
