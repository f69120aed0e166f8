//! Room `written`: the order of definitions for a reader.
//!
//! In: definitions in the order in which they are found. Out: the same, each behind those that it reads. Couplings are found first,
//! in terms of coordinates that later steps find, so the order in which they are found is not the one in which they can be read.

use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Definition;
use crate::symbolic::graph::Scalar;

/// What does not read each other stays in its order. Unknowns of one iteration read none of their own, so no circle is expected;
/// one would stay as it is.
pub(super) fn in_reading_order(e: &Equations<'_>, definitions: &[Definition]) -> Vec<Definition> {
    let symbols: Vec<Scalar> = definitions.iter().flat_map(|d| e.coordinate_symbols(d.coordinate)).collect();
    let reads = |d: &Definition| e.g.read_by(&[d.position, d.rate, d.acceleration], &symbols);
    let reads: Vec<Vec<bool>> = definitions.iter().map(reads).collect();
    let reads = |reader: usize, read: usize| reader != read && reads[reader][3 * read..3 * read + 3].contains(&true);
    let mut waiting: Vec<usize> = (0..definitions.len()).collect();
    let mut ordered = Vec::with_capacity(definitions.len());
    while !waiting.is_empty() {
        let is_free = |&reader: &usize| waiting.iter().all(|&read| !reads(reader, read));
        let next = waiting.iter().position(is_free).unwrap_or(0);
        ordered.push(definitions[waiting.remove(next)]);
    }
    ordered
}
