//! The order in which columns of a sparse matrix are eliminated, by its pattern alone, and what that comes to.

use crate::symbolic::graph::Scalar;

/// Expressions that an entry of one row takes where a multiple of another is taken from it: the product and the sum, those of
/// its noise, and the choices that bring rows to their places.
const OF_AN_UPDATE: usize = 9;

/// The next column, and the rows that compete for its pivot.
pub(super) fn next(
    open_rows: &[usize],
    open_columns: &[usize],
    filled: &dyn Fn(usize, usize) -> bool,
) -> Option<(usize, Vec<usize>)> {
    for &row in open_rows {
        let mut columns = open_columns.iter().copied().filter(|&column| filled(row, column));
        if let (Some(column), None) = (columns.next(), columns.next()) {
            return Some((column, vec![row]));
        }
    }
    let candidates = open_columns.iter().map(|&column| {
        let rows: Vec<usize> = open_rows.iter().copied().filter(|&row| filled(row, column)).collect();
        let is_wide = |&other: &usize| rows.iter().any(|&row| filled(row, other));
        let width = open_columns.iter().filter(|other| is_wide(other)).count();
        (rows.len().saturating_sub(1) * width, rows.len(), column, rows)
    });
    candidates.min_by_key(|(work, rows, column, _)| (*work, *rows, *column)).map(|(.., column, rows)| (column, rows))
}

/// How many expressions the factors of a matrix are, about, and at most: as if no columns were orthogonal and nothing cancelled.
pub fn expressions(size: usize, matrix: &[Scalar]) -> usize {
    let mut filled: Vec<Vec<bool>> =
        matrix.chunks(size.max(1)).map(|row| row.iter().map(|&entry| entry != Scalar::ZERO).collect()).collect();
    let (mut rows, mut columns): (Vec<usize>, Vec<usize>) = ((0..size).collect(), (0..size).collect());
    let mut count = 0;
    while let Some((column, candidates)) = next(&rows, &columns, &|row, column| filled[row][column]) {
        let Some(top) = candidates.first().copied().or(rows.last().copied()) else { break };
        columns.retain(|&other| other != column);
        rows.retain(|&row| row != top);
        // Any of the candidates may come to the top.
        let wide: Vec<usize> =
            columns.iter().copied().filter(|&other| candidates.iter().any(|&row| filled[row][other])).collect();
        for below in rows.iter().copied().filter(|&row| filled[row][column]).collect::<Vec<_>>() {
            count += OF_AN_UPDATE * (1 + wide.len());
            wide.iter().for_each(|&other| filled[below][other] = true);
        }
    }
    count
}
