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
//! Columns with entries in few equations may be orthogonal to each other whatever the configuration is: the joint of a rod, or the
//! joints of a leg, move its tip along vectors at right angles. Then nothing competes: unknowns are projections, and what is left
//! of as many equations and one more is the one along their normal, as good as any pivot. Equations are to be in units in which
//! slopes are about one.
//!
//! A pivot that is rounding beside the column as it was given counts as zero, and its unknown is zero then: a solution is finite
//! where the matrix is singular. The rank is not told; who asks for it takes the pivoted solve of the runtime.

use crate::contracts::call::Call;
use crate::invariant::fault::raise;

use super::graph::{Graph, Scalar};

/// Pivots below this many roundings for each step that has changed them are none.
const UNITS: i64 = 16;

/// What is done to the rows, right sides included.
enum Step {
    /// Rows change places where the mask says so.
    Exchange { mask: Scalar, rows: [usize; 2] },
    /// Takes a multiple of the first row from the second.
    Subtract { factor: Scalar, rows: [usize; 2] },
    /// A new row behind all others: multiples of these.
    Combine { terms: Vec<(usize, Scalar)> },
}

/// Entries of a row, by column.
type Entries = Vec<(usize, Scalar)>;

/// Unknowns in terms of those that are eliminated later.
enum Pivot {
    /// Of one row.
    Row { row: usize, column: usize, inverse: Scalar, rest: Entries },
    /// Of rows in which the columns are orthogonal: by row what others have there, by column its entries and one over their square.
    Orthogonal { rows: Vec<(usize, Entries)>, columns: Vec<(usize, Vec<Scalar>, Scalar)> },
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
    /// By column how many steps have changed it.
    changes: Vec<i64>,
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
            changes: vec![0; size],
            scales: vec![None; size],
            given: matrix,
            done,
        };
        while let Some((rows, columns)) = work.orthogonal() {
            work.project(&rows, &columns);
        }
        while let Some((column, rows)) = work.next() {
            work.eliminate(column, rows);
        }
        work.done
    }

    /// The unknowns for a right side.
    pub fn solve(&self, g: &mut Graph, side: &[Scalar]) -> Vec<Scalar> {
        let (size, mut side) = (side.len(), side.to_vec());
        for step in &self.steps {
            match *step {
                Step::Exchange { mask, rows } => exchange(g, mask, &mut side, rows),
                Step::Subtract { factor, rows: [above, below] } => {
                    let update = g.mul(factor, side[above]);
                    side[below] = g.sub(side[below], update);
                }
                Step::Combine { ref terms } => {
                    let terms: Vec<Scalar> = terms.iter().map(|&(row, factor)| g.mul(factor, side[row])).collect();
                    side.push(g.sum(&terms));
                }
            }
        }
        let mut unknowns = vec![Scalar::ZERO; size];
        let rest = |g: &mut Graph, unknowns: &[Scalar], row: usize, entries: &Entries| {
            let mut terms = vec![side[row]];
            terms.extend(entries.iter().map(|&(column, entry)| -g.mul(entry, unknowns[column])));
            g.sum(&terms)
        };
        for pivot in self.pivots.iter().rev() {
            match pivot {
                Pivot::Row { row, column, inverse, rest: entries } => {
                    let sum = rest(g, &unknowns, *row, entries);
                    unknowns[*column] = g.mul(sum, *inverse);
                }
                Pivot::Orthogonal { rows, columns } => {
                    let sides: Vec<Scalar> = rows.iter().map(|(row, list)| rest(g, &unknowns, *row, list)).collect();
                    for (column, entries, inverse) in columns {
                        let along = dot(g, entries, &sides);
                        unknowns[*column] = g.mul(along, *inverse);
                    }
                }
            }
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

    /// Columns that are orthogonal to each other and have entries in as many rows, or in one more, of up to three; these rows.
    fn orthogonal(&mut self) -> Option<(Vec<usize>, Vec<usize>)> {
        let columns = self.open_columns.clone();
        let reach = |work: &Self, column: usize| -> Vec<usize> {
            work.open_rows.iter().copied().filter(|&row| work.rows[row][column] != Scalar::ZERO).collect()
        };
        let reaches: Vec<Vec<usize>> = columns.iter().map(|&column| reach(self, column)).collect();
        for rows in reaches.iter().filter(|rows| (2..=3).contains(&rows.len())) {
            let within = |own: &Vec<usize>| !own.is_empty() && own.iter().all(|row| rows.contains(row));
            let own: Vec<usize> =
                columns.iter().zip(&reaches).filter(|(_, own)| within(own)).map(|(&column, _)| column).collect();
            if own.len() != rows.len() && own.len() + 1 != rows.len() {
                continue;
            }
            // The product of one entry and others has no known size.
            if own.len() == 1 && {
                let square = self.gram(rows, own[0], own[0]);
                self.g.literal(square).is_none()
            } {
                continue;
            }
            let pairs = own.iter().enumerate().flat_map(|(at, &a)| own[at + 1..].iter().map(move |&b| (a, b)));
            if pairs.collect::<Vec<_>>().into_iter().all(|(a, b)| self.gram(rows, a, b) == Scalar::ZERO) {
                return Some((rows.clone(), own));
            }
        }
        None
    }

    /// The product of two columns in these rows.
    fn gram(&mut self, rows: &[usize], a: usize, b: usize) -> Scalar {
        let [a, b] = [a, b].map(|column| rows.iter().map(|&row| self.rows[row][column]).collect::<Vec<_>>());
        dot(self.g, &a, &b)
    }

    /// Eliminates columns that are orthogonal in these rows.
    fn project(&mut self, rows: &[usize], columns: &[usize]) {
        let squares: Vec<Scalar> = columns.iter().map(|&column| self.gram(rows, column, column)).collect();
        let entries = |column: usize| rows.iter().map(|&row| self.rows[row][column]).collect::<Vec<_>>();
        let vectors: Vec<Vec<Scalar>> = columns.iter().map(|&column| entries(column)).collect();
        let inverses: Vec<Scalar> = squares.iter().map(|&square| self.positive(square)).collect();
        self.open_rows.retain(|row| !rows.contains(row));
        self.open_columns.retain(|column| !columns.contains(column));
        if columns.len() < rows.len() {
            let normal = match &vectors[..] {
                [a] => vec![-a[1], a[0]],
                [a, b] => [[1, 2], [2, 0], [0, 1]].map(|[i, j]| self.minor(a, b, i, j)).to_vec(),
                _ => raise("a normal is one to one or two vectors"),
            };
            // Of length one: it competes with other equations, and what is left of it is measured beside them.
            let square = self.g.product(&squares);
            let inverse = self.positive(square);
            let length = self.g.sqrt(inverse);
            let terms: Vec<(usize, Scalar)> =
                rows.iter().copied().zip(normal).map(|(row, n)| (row, self.g.mul(length, n))).collect();
            let mut combined = vec![Scalar::ZERO; self.size];
            for &column in &self.open_columns {
                let list: Vec<Scalar> = terms.iter().map(|&(row, n)| self.g.mul(n, self.rows[row][column])).collect();
                combined[column] = self.g.sum(&list);
                self.changes[column] += i64::from(combined[column] != Scalar::ZERO);
            }
            self.open_rows.push(self.rows.len());
            self.rows.push(combined);
            self.done.steps.push(Step::Combine { terms });
        }
        let rest = |&row: &usize| {
            let entries = self.open_columns.iter().map(|&other| (other, self.rows[row][other]));
            (row, entries.filter(|entry| entry.1 != Scalar::ZERO).collect())
        };
        let rows = rows.iter().map(rest).collect();
        let columns =
            columns.iter().zip(vectors).zip(inverses).map(|((&column, vector), inverse)| (column, vector, inverse));
        self.done.pivots.push(Pivot::Orthogonal { rows, columns: columns.collect() });
    }

    fn minor(&mut self, a: &[Scalar], b: &[Scalar], i: usize, j: usize) -> Scalar {
        let (plus, minus) = (self.g.mul(a[i], b[j]), self.g.mul(a[j], b[i]));
        self.g.sub(plus, minus)
    }

    /// One over a square; zero if that is zero.
    fn positive(&mut self, square: Scalar) -> Scalar {
        if self.g.literal(square).is_some() {
            return self.g.reciprocal(square);
        }
        let lost = self.g.call(Call::LessEqual, &[square, Scalar::ZERO]);
        let inverse = self.g.reciprocal(square);
        self.g.call(Call::Select, &[lost, Scalar::ZERO, inverse])
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
                others.into_iter().for_each(|row| top = self.compete(column, [top, row]));
            }
        }
        let inverse = self.inverse(column, top);
        self.open_columns.retain(|&other| other != column);
        self.open_rows.retain(|&row| row != top);
        let mut changed = Vec::new();
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
                    changed.push(other);
                }
            }
            self.done.steps.push(Step::Subtract { factor, rows: [top, below] });
        }
        // A pivot changes an entry once, however many there are.
        changed.sort_unstable();
        changed.dedup();
        changed.into_iter().for_each(|other| self.changes[other] += 1);
        let entries = self.open_columns.iter().map(|&other| (other, self.rows[top][other]));
        let rest = entries.filter(|entry| entry.1 != Scalar::ZERO).collect();
        self.done.pivots.push(Pivot::Row { row: top, column, inverse, rest });
    }

    /// Brings the row with the larger entry to the first place; that row.
    fn compete(&mut self, column: usize, rows: [usize; 2]) -> usize {
        let [above, below] = rows.map(|row| self.rows[row][column]);
        let ratio = self.g.div(below, above);
        // Multiples of one value: the larger one is known.
        if let Some(ratio) = self.g.literal(ratio) {
            return rows[usize::from(ratio.value().abs() > 1.0)];
        }
        let [above, below] = rows.map(|row| self.g.call(Call::Abs, &[self.rows[row][column]]));
        let mask = self.g.call(Call::Less, &[above, below]);
        self.g.label(mask, || format!("exchanged_{}_{}", rows[1] + 1, column + 1));
        for &other in &self.open_columns {
            let mut entries = rows.map(|row| self.rows[row][other]);
            exchange(self.g, mask, &mut entries, [0, 1]);
            [self.rows[rows[0]][other], self.rows[rows[1]][other]] = entries;
        }
        self.done.steps.push(Step::Exchange { mask, rows });
        rows[0]
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
        let least = if self.changes[column] > 0 { self.least(column) } else { Scalar::ZERO };
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
        let (count, unit) = (self.g.integer(UNITS * (1 + self.changes[column])), self.g.call(Call::Epsilon, &[]));
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

fn dot(g: &mut Graph, a: &[Scalar], b: &[Scalar]) -> Scalar {
    let terms: Vec<Scalar> = a.iter().zip(b).map(|(&a, &b)| g.mul(a, b)).collect();
    g.sum(&terms)
}

/// Two entries of a column change places where the mask says so.
fn exchange(g: &mut Graph, mask: Scalar, column: &mut [Scalar], [above, below]: [usize; 2]) {
    let (a, b) = (column[above], column[below]);
    column[above] = g.call(Call::Select, &[mask, b, a]);
    column[below] = g.call(Call::Select, &[mask, a, b]);
}
