//! Stage `symbolic`: square linear systems, eliminated in an order that the pattern of their matrix gives.
//!
//! In: a matrix. Out: its factors as expressions, and solutions with them for any number of right sides.
//!
//! The order of columns is found while compiling: next comes the column whose elimination takes the least work, a row that has
//! one column left before all others (it says what its unknown is, whatever stands below it). The rows that still have an
//! entry in the column compete for its pivot, the largest entry wins, and rows change places by selects: partial pivoting, so
//! a column without a pivot means that the matrix is singular, and not that the order was a bad one. Rows that have no entry
//! there are left alone, so systems that hang together by few unknowns cost what these couple (Duff, Erisman and Reid,
//! Direct Methods for Sparse Matrices). Among literals the pivot is chosen while compiling.
//!
//! A pivot that is rounding beside the column as it was given counts as zero, and its unknown is zero then: a solution is finite
//! where the matrix is singular. The rank is not told; who asks for it takes the pivoted solve of the runtime.

use crate::contracts::call::Call;

use super::graph::{Graph, Scalar};

/// Pivots below this many roundings for each equation are none, as in the runtime.
const UNITS: i64 = 16;

/// What is done to the rows, right sides included.
enum Step {
    /// Rows change places where the mask says so.
    Exchange { mask: Scalar, rows: [usize; 2] },
    /// Takes a multiple of the first row from the second.
    Subtract { factor: Scalar, rows: [usize; 2] },
}

/// An unknown in terms of those that are eliminated later.
struct Pivot {
    row: usize,
    column: usize,
    inverse: Scalar,
    rest: Vec<(usize, Scalar)>,
}

/// A factorised matrix.
pub struct Elimination {
    steps: Vec<Step>,
    /// In the order of elimination.
    pivots: Vec<Pivot>,
}

/// What is left to eliminate.
struct Work<'a> {
    g: &'a mut Graph,
    size: usize,
    rows: Vec<Vec<Scalar>>,
    open_rows: Vec<usize>,
    open_columns: Vec<usize>,
    /// By column whether an elimination has changed it.
    changed: Vec<bool>,
    /// By column its largest entry as it was given, once somebody asks.
    scales: Vec<Option<Scalar>>,
    given: &'a [Scalar],
    done: Elimination,
}

impl Elimination {
    /// Factorises a matrix, given row by row.
    pub fn of(g: &mut Graph, size: usize, matrix: &[Scalar]) -> Elimination {
        let rows = matrix.chunks(size.max(1)).map(<[Scalar]>::to_vec).collect();
        let done = Elimination { steps: Vec::new(), pivots: Vec::with_capacity(size) };
        let mut work = Work {
            g,
            size,
            rows,
            open_rows: (0..size).collect(),
            open_columns: (0..size).collect(),
            changed: vec![false; size],
            scales: vec![None; size],
            given: matrix,
            done,
        };
        while let Some((column, rows)) = work.next() {
            work.eliminate(column, rows);
        }
        work.done
    }

    /// The unknowns for a right side.
    pub fn solve(&self, g: &mut Graph, side: &[Scalar]) -> Vec<Scalar> {
        let mut side = side.to_vec();
        for step in &self.steps {
            match *step {
                Step::Exchange { mask, rows } => exchange(g, mask, &mut side, rows),
                Step::Subtract { factor, rows: [above, below] } => {
                    let update = g.mul(factor, side[above]);
                    side[below] = g.sub(side[below], update);
                }
            }
        }
        let mut unknowns = vec![Scalar::ZERO; side.len()];
        for pivot in self.pivots.iter().rev() {
            let mut terms = vec![side[pivot.row]];
            terms.extend(pivot.rest.iter().map(|&(column, entry)| -g.mul(entry, unknowns[column])));
            let sum = g.sum(&terms);
            unknowns[pivot.column] = g.mul(sum, pivot.inverse);
        }
        unknowns
    }
}

impl Work<'_> {
    /// The next column, and the rows that compete for its pivot.
    fn next(&self) -> Option<(usize, Vec<usize>)> {
        let filled = |row: usize, column: usize| self.rows[row][column] != Scalar::ZERO;
        for &row in &self.open_rows {
            let mut columns = self.open_columns.iter().copied().filter(|&column| filled(row, column));
            if let (Some(column), None) = (columns.next(), columns.next()) {
                return Some((column, vec![row]));
            }
        }
        let candidates = self.open_columns.iter().map(|&column| {
            let rows: Vec<usize> = self.open_rows.iter().copied().filter(|&row| filled(row, column)).collect();
            let is_wide = |&other: &usize| rows.iter().any(|&row| filled(row, other));
            let width = self.open_columns.iter().filter(|other| is_wide(other)).count();
            (rows.len().saturating_sub(1) * width, rows.len(), column, rows)
        });
        candidates
            .min_by_key(|(work, rows, column, _)| (*work, *rows, *column))
            .map(|(.., column, rows)| (column, rows))
    }

    fn eliminate(&mut self, column: usize, rows: Vec<usize>) {
        // A column of zeros: its unknown is zero, and some row is left over.
        let Some(mut top) = rows.first().copied().or(self.open_rows.last().copied()) else { return };
        let sizes: Option<Vec<f64>> =
            rows.iter().map(|&row| self.g.literal(self.rows[row][column]).map(|n| n.value().abs())).collect();
        match sizes {
            Some(sizes) => {
                let best = (0..rows.len()).max_by(|&a, &b| sizes[a].total_cmp(&sizes[b]).then(b.cmp(&a)));
                top = best.map_or(top, |best| rows[best]);
            }
            None => {
                let others: Vec<usize> = rows.iter().copied().filter(|&row| row != top).collect();
                others.into_iter().for_each(|row| self.compete(column, [top, row]));
            }
        }
        let inverse = self.inverse(column, top);
        self.open_columns.retain(|&other| other != column);
        self.open_rows.retain(|&row| row != top);
        for below in self.open_rows.clone() {
            // Where a row has one column left, the others are no candidates and have entries all the same.
            let factor = self.g.mul(self.rows[below][column], inverse);
            if factor == Scalar::ZERO {
                continue;
            }
            self.g.label(factor, || format!("factor_{}_{}", below + 1, column + 1));
            for &other in &self.open_columns {
                if self.rows[top][other] != Scalar::ZERO {
                    let update = self.g.mul(factor, self.rows[top][other]);
                    self.rows[below][other] = self.g.sub(self.rows[below][other], update);
                    self.changed[other] = true;
                }
            }
            self.done.steps.push(Step::Subtract { factor, rows: [top, below] });
        }
        let entries = self.open_columns.iter().map(|&other| (other, self.rows[top][other]));
        let rest = entries.filter(|entry| entry.1 != Scalar::ZERO).collect();
        self.done.pivots.push(Pivot { row: top, column, inverse, rest });
    }

    /// Brings the row with the larger entry to the first place.
    fn compete(&mut self, column: usize, rows: [usize; 2]) {
        let [above, below] = rows.map(|row| self.g.call(Call::Abs, &[self.rows[row][column]]));
        let mask = self.g.call(Call::Less, &[above, below]);
        self.g.label(mask, || format!("exchanged_{}_{}", rows[1] + 1, column + 1));
        for &other in &self.open_columns {
            let mut entries = rows.map(|row| self.rows[row][other]);
            exchange(self.g, mask, &mut entries, [0, 1]);
            [self.rows[rows[0]][other], self.rows[rows[1]][other]] = entries;
        }
        self.done.steps.push(Step::Exchange { mask, rows });
    }

    /// One over a pivot; zero if that is none.
    fn inverse(&mut self, column: usize, row: usize) -> Scalar {
        let pivot = self.rows[row][column];
        if pivot == Scalar::ZERO {
            return Scalar::ZERO;
        }
        if self.g.literal(pivot).is_some() {
            return self.g.reciprocal(pivot);
        }
        let size = self.g.call(Call::Abs, &[pivot]);
        let least = if self.changed[column] { self.least(column) } else { Scalar::ZERO };
        // What is no number is no zero: it shows in the solution.
        let lost = self.g.call(Call::LessEqual, &[size, least]);
        let inverse = self.g.reciprocal(pivot);
        let inverse = self.g.call(Call::Select, &[lost, Scalar::ZERO, inverse]);
        self.g.label(inverse, || format!("pivot_{}_inv", column + 1));
        inverse
    }

    /// What rounding leaves of a column.
    fn least(&mut self, column: usize) -> Scalar {
        let scale = match self.scales[column] {
            Some(scale) => scale,
            None => self.scale(column),
        };
        self.scales[column] = Some(scale);
        let (count, unit) = (self.g.integer(UNITS * self.size as i64), self.g.call(Call::Epsilon, &[]));
        self.g.product(&[count, unit, scale])
    }

    fn scale(&mut self, column: usize) -> Scalar {
        let entries: Vec<Scalar> = self.given.iter().skip(column).step_by(self.size).copied().collect();
        let mut scale = Scalar::ZERO;
        for entry in entries.into_iter().filter(|&entry| entry != Scalar::ZERO) {
            let size = self.g.call(Call::Abs, &[entry]);
            scale = if scale == Scalar::ZERO { size } else { self.g.call(Call::Max, &[scale, size]) };
        }
        self.g.label(scale, || format!("scale_{}", column + 1));
        scale
    }
}

/// Two entries of a column change places where the mask says so.
fn exchange(g: &mut Graph, mask: Scalar, column: &mut [Scalar], [above, below]: [usize; 2]) {
    let (a, b) = (column[above], column[below]);
    column[above] = g.call(Call::Select, &[mask, b, a]);
    column[below] = g.call(Call::Select, &[mask, a, b]);
}
