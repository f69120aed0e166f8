//! Room `written`: the order of definitions for a reader.
//!
//! In: definitions in the order in which they are found. Out: the same, each behind those that it reads: its position behind the positions
//! that this is written with, its rate behind rates, its acceleration behind accelerations. Couplings are found first, in terms of
//! coordinates that later steps find, and loops by coordinates whose rates equations of velocities give, so the order in which they are
//! found is not the one in which they can be read.

use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Definition;
use crate::symbolic::graph::Scalar;

/// What does not read each other stays in its order, and so do those that are found together, which read each other: what comes next
/// is read by all that it reads.
pub(super) fn in_reading_order(e: &Equations<'_>, definitions: &[Definition]) -> Vec<Definition> {
    let size = definitions.len();
    let mut leads = vec![vec![false; size]; size];
    for level in 0..3 {
        let symbols: Vec<Scalar> = definitions.iter().map(|d| e.coordinate_symbols(d.coordinate)[level]).collect();
        for (row, d) in leads.iter_mut().zip(definitions) {
            let value = [d.position, d.rate, d.acceleration][level];
            row.iter_mut().zip(e.g.read_by(&[value], &symbols)).for_each(|(leads, reads)| *leads |= reads);
        }
    }
    // Through others too (Warshall).
    for by in 0..size {
        for from in 0..size {
            for to in 0..size {
                leads[from][to] |= leads[from][by] && leads[by][to];
            }
        }
    }
    let mut waiting: Vec<usize> = (0..size).collect();
    let mut ordered = Vec::with_capacity(size);
    while !waiting.is_empty() {
        let is_free = |&reader: &usize| waiting.iter().all(|&read| !leads[reader][read] || leads[read][reader]);
        let next = waiting.iter().position(is_free).unwrap_or(0);
        ordered.push(definitions[waiting.remove(next)]);
    }
    ordered
}
