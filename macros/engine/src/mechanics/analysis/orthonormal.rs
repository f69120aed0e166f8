//! Stage `mechanics`: orthonormal directions.
//!
//! In: vectors. Out: what lies along them and across.

use super::singular::{add, dot};

/// Makes a vector one of unit length, and gives the length that it had.
pub(super) fn unit(vector: &mut [f64]) -> Option<f64> {
    let length = dot(vector, vector).sqrt();
    if length > 0.0 {
        vector.iter_mut().for_each(|x| *x /= length);
    }
    length.is_finite().then_some(length)
}

/// Less what lies along unit vectors; twice, for the digits that the first time has lost.
pub(super) fn without(mut vector: Vec<f64>, basis: &[Vec<f64>]) -> Vec<f64> {
    for unit in basis.iter().chain(basis) {
        let along = dot(&vector, unit);
        add(&mut vector, -along, unit);
    }
    vector
}

pub(super) fn greatest(rows: &[Vec<f64>]) -> Option<&Vec<f64>> {
    rows.iter().max_by(|a, b| dot(a, a).total_cmp(&dot(b, b)))
}

/// What lies across orthonormal vectors, orthonormal.
pub(super) fn complement(taken: &[&Vec<f64>], dimension: usize) -> Vec<Vec<f64>> {
    let unit_vector = |k: usize| (0..dimension).map(|i| f64::from(u8::from(i == k))).collect::<Vec<f64>>();
    let mut left: Vec<Vec<f64>> = (0..dimension).map(unit_vector).collect();
    let clear = |left: &mut [Vec<f64>], direction: &[f64]| {
        for vector in left {
            let share = dot(direction, vector);
            add(vector, -share, direction);
        }
    };
    taken.iter().for_each(|direction| clear(&mut left, direction));
    let mut found: Vec<Vec<f64>> = Vec::new();
    while taken.len() + found.len() < dimension {
        let Some(mut next) = greatest(&left).cloned() else { break };
        for direction in taken.iter().copied().chain(&found) {
            let share = dot(direction, &next);
            add(&mut next, -share, direction);
        }
        if unit(&mut next).is_none() {
            break;
        }
        clear(&mut left, &next);
        found.push(next);
    }
    found
}
