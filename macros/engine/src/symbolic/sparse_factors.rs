//! Stage `symbolic`: square linear systems, factorised in an order that the pattern of their matrix gives.
//!
//! In: a matrix. Out: its factors as expressions, and solutions with them for any number of right sides.
//!
//! The order of columns is found while compiling (`order`): next comes the column whose elimination takes the least work, a row
//! that has one column left before all others (it says what its unknown is, whatever stands below it). The rows that still have an
//! entry in the column compete for its pivot, the largest entry wins, and rows change places by selects: partial pivoting, so
//! a column without a pivot means that the matrix is singular, and not that the order was a bad one. Rows that have no entry
//! there are left alone, so systems that hang together by few unknowns cost what these couple (Duff, Erisman and Reid,
//! Direct Methods for Sparse Matrices). Among literals the pivot is chosen while compiling.
//!
//! Columns with entries in few equations may be orthogonal to each other whatever the configuration is: the joint of a rod, or the
//! joints of a leg, move its tip along vectors at right angles. Then nothing competes: unknowns are projections, and what is left
//! of as many equations and one more is the one along their normal, as good as any pivot.
//!
//! # What counts as zero
//!
//! Neither may depend on units, which are those of parameters at run time: a row of lengths beside one of cosines, metres or
//! micrometres. With s_i the greatest entry of row i as it was given, row i wins against row j in column k where
//! |a_ik| / s_i > |a_jk| / s_j: implicit scaling (Higham 2002, Accuracy and Stability of Numerical Algorithms, section 9.3),
//! written |a_jk| s_i < |a_ik| s_j.
//!
//! A pivot p is rounding where it is small beside what that entry itself was made of, its *noise* (`rows`): n = |a| as given,
//! and n_ij + |l| n_kj once l times row k is taken from row i, since a_kj is known to n_kj roundings, whatever has cancelled in
//! it. With |p| <= 16 eps n the pivot is lost: no digit of it is known. Rows and columns in other units multiply p and n alike, so
//! a small pivot counts wherever its own digits are there. What was given is taken for exact: where a whole row is rounding as it
//! is given, so is what it says.
//!
//! Where a pivot is lost its unknown is zero, and a solution is finite where the matrix is singular. The row that was to give the
//! pivot says something of other unknowns all the same, and which of the rows is superfluous then nobody knows: each of those that
//! competed takes a share of it, all different, so that none is lost whatever depends on what. That is one select for each
//! factor. A column of which one row alone has entries takes this row along; to leave it open would be one more row to
//! compete for every pivot behind it.
//!
//! Whoever asks for the rank too ([`Purpose::Rank`]) is told that of pivots which are no rounding beside their row either, by the
//! size of the matrix. It is full or not; how short it is, is a bound. Pivots of few digits multiply rounding in ways that no noise
//! tells: of random matrices one row of which depends on two others, two of a thousand are told regular, and have unknowns beyond
//! all bounds.
//!
//! What is infinite or no number is measured by what is infinite or no number: zero times that stands in the place of the unknown, so
//! it shows in the solution.

mod order;
mod rows;

use crate::contracts::call::Call;
use crate::invariant::fault::{OrFault, raise};

use super::graph::{Graph, Scalar};

use rows::{Row, exchange, largest};

pub use order::expressions;

/// Pivots below this many roundings of what they are made of are none.
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

/// One over a pivot.
struct Inverse {
    /// Zero where the pivot is lost.
    guarded: Scalar,
    /// As it is, and the mask that tells where it is lost; nothing where it can't be.
    plain: Option<(Scalar, Scalar)>,
}

/// A factorised matrix.
pub struct SparseFactors {
    steps: Vec<Step>,
    /// In the order of elimination.
    pivots: Vec<Pivot>,
    /// How many pivots are literals, and of each of the others whether it is there.
    literals: usize,
    found: Vec<Scalar>,
}

/// What is to be known of a matrix.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Solutions, in any units: a pivot counts wherever its own digits are there.
    Solutions,
    /// The same, and where a pivot is lost there is none: it is no number.
    Regular,
    /// The rank too. There pivots are measured beside their rows as well, so entries that are rounding as they are given don't count,
    /// and by the size of the matrix.
    Rank,
}

/// What is left to eliminate.
struct Work<'a> {
    g: &'a mut Graph,
    rows: Vec<Row>,
    open_rows: Vec<usize>,
    open_columns: Vec<usize>,
    purpose: Purpose,
    size: i64,
    done: SparseFactors,
}

impl SparseFactors {
    /// Factorises a matrix, given row by row.
    pub fn of(g: &mut Graph, size: usize, matrix: &[Scalar], purpose: Purpose) -> SparseFactors {
        let rows = matrix.chunks(size.max(1)).map(|entries| Row::new(entries.to_vec())).collect();
        let done =
            SparseFactors { steps: Vec::new(), pivots: Vec::with_capacity(size), literals: 0, found: Vec::new() };
        let mut work = Work {
            g,
            rows,
            open_rows: (0..size).collect(),
            open_columns: (0..size).collect(),
            purpose,
            size: size as i64,
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

impl SparseFactors {
    /// The unknowns of the transposed matrix for a right side: what [`SparseFactors::solve`] does, the other way round.
    pub fn solve_transposed(&self, g: &mut Graph, side: &[Scalar]) -> Vec<Scalar> {
        let combined = self.steps.iter().filter(|step| matches!(step, Step::Combine { .. })).count();
        let (mut given, mut unknowns) = (side.to_vec(), vec![Scalar::ZERO; side.len() + combined]);
        let take = |g: &mut Graph, given: &mut [Scalar], entries: &Entries, part: Scalar| {
            for &(column, entry) in entries {
                let update = g.mul(entry, part);
                given[column] = g.sub(given[column], update);
            }
        };
        for pivot in &self.pivots {
            match pivot {
                Pivot::Row { row, column, inverse, rest } => {
                    let part = g.mul(given[*column], *inverse);
                    unknowns[*row] = g.add(unknowns[*row], part);
                    take(g, &mut given, rest, part);
                }
                Pivot::Orthogonal { rows, columns } => {
                    let along: Vec<Scalar> =
                        columns.iter().map(|(column, _, inverse)| g.mul(given[*column], *inverse)).collect();
                    for (k, (row, rest)) in rows.iter().enumerate() {
                        let entries: Vec<Scalar> = columns.iter().map(|(_, entries, _)| entries[k]).collect();
                        let part = dot(g, &entries, &along);
                        unknowns[*row] = g.add(unknowns[*row], part);
                        take(g, &mut given, rest, part);
                    }
                }
            }
        }
        for step in self.steps.iter().rev() {
            match *step {
                Step::Exchange { mask, rows } => exchange(g, mask, &mut unknowns, rows),
                Step::Subtract { factor, rows: [above, below] } => {
                    let update = g.mul(factor, unknowns[below]);
                    unknowns[above] = g.sub(unknowns[above], update);
                }
                Step::Combine { ref terms } => {
                    let last = unknowns.pop().or_fault("a combined row has a place behind the others");
                    for &(row, factor) in terms {
                        let update = g.mul(factor, last);
                        unknowns[row] = g.add(unknowns[row], update);
                    }
                }
            }
        }
        unknowns
    }

    /// How many pivots are there: the size where the matrix is regular. Where it is not, one that is none may take others along.
    pub fn rank(&self, g: &mut Graph) -> Scalar {
        let mut terms = vec![g.integer(self.literals as i64)];
        terms.extend(self.found.iter().map(|&mask| g.call(Call::Select, &[mask, Scalar::ONE, Scalar::ZERO])));
        g.sum(&terms)
    }
}

impl Work<'_> {
    /// The next column, and the rows that compete for its pivot.
    fn next(&self) -> Option<(usize, Vec<usize>)> {
        let filled = |row: usize, column: usize| self.rows[row].entries[column] != Scalar::ZERO;
        order::next(&self.open_rows, &self.open_columns, &filled)
    }

    /// Columns that are orthogonal to each other and have entries in as many rows, or in one more, of up to three; these rows.
    fn orthogonal(&mut self) -> Option<(Vec<usize>, Vec<usize>)> {
        let columns = self.open_columns.clone();
        let reach = |work: &Self, column: usize| -> Vec<usize> {
            work.open_rows.iter().copied().filter(|&row| work.rows[row].entries[column] != Scalar::ZERO).collect()
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
        let [a, b] = [a, b].map(|column| rows.iter().map(|&row| self.rows[row].entries[column]).collect::<Vec<_>>());
        dot(self.g, &a, &b)
    }

    /// Eliminates columns that are orthogonal in these rows.
    fn project(&mut self, rows: &[usize], columns: &[usize]) {
        let squares: Vec<Scalar> = columns.iter().map(|&column| self.gram(rows, column, column)).collect();
        let entries = |column: usize| rows.iter().map(|&row| self.rows[row].entries[column]).collect::<Vec<_>>();
        let vectors: Vec<Vec<Scalar>> = columns.iter().map(|&column| entries(column)).collect();
        let inverses: Vec<Scalar> = squares.iter().map(|&square| self.pivot_of_square(square, rows)).collect();
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
            self.open_rows.push(self.rows.len());
            let mut combined = rows::combined(self.g, &mut self.rows, &terms, &self.open_columns);
            if self.purpose == Purpose::Rank {
                combined = combined.with_scale(rows::combined_scale(self.g, &mut self.rows, &terms));
            }
            self.rows.push(combined);
            self.done.steps.push(Step::Combine { terms });
        }
        let rest = |&row: &usize| {
            let entries = self.open_columns.iter().map(|&other| (other, self.rows[row].entries[other]));
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

    /// One over a square that is a pivot.
    fn pivot_of_square(&mut self, square: Scalar, rows: &[usize]) -> Scalar {
        if self.g.literal(square).is_some() {
            self.done.literals += 1;
            return self.g.reciprocal(square);
        }
        if self.purpose == Purpose::Rank {
            let scales: Vec<Scalar> = rows.iter().map(|&row| self.rows[row].scale(self.g)).collect();
            let scale = scales.into_iter().reduce(|a, b| self.g.call(Call::Max, &[a, b])).unwrap_or(Scalar::ZERO);
            let least = self.rounding_of(scale);
            let least = self.g.mul(least, least);
            self.count(square, least);
        }
        self.positive(square)
    }

    /// One over a square; zero if that is zero.
    fn positive(&mut self, square: Scalar) -> Scalar {
        if self.g.literal(square).is_some() {
            return self.g.reciprocal(square);
        }
        let least = self.rounding_of(square);
        self.guard(square, square, least).guarded
    }

    fn eliminate(&mut self, column: usize, rows: Vec<usize>) {
        // A column of zeros: its unknown is zero, and some row is left over.
        let Some(top) = self.winner(column, &rows).or(self.open_rows.last().copied()) else { return };
        let inverse = self.inverse(column, top);
        self.open_columns.retain(|&other| other != column);
        self.open_rows.retain(|&row| row != top);
        let mut shares = 0;
        for below in self.open_rows.clone() {
            let entry = self.rows[below].entries[column];
            if entry == Scalar::ZERO {
                continue;
            }
            let factor = match inverse.plain.filter(|_| rows.contains(&below)) {
                Some((mask, plain)) => {
                    shares += 1;
                    let share = self.g.decimal(100.0 / f64::from(37 + 100 * shares));
                    let factor = self.g.mul(entry, plain);
                    self.g.call(Call::Select, &[mask, -share, factor])
                }
                // Where a row has one column left, the others are no candidates and have entries all the same.
                None => self.g.mul(entry, inverse.guarded),
            };
            if factor == Scalar::ZERO {
                continue;
            }
            self.g.label(factor, || format!("factor_{}_{}", below + 1, column + 1));
            let open = std::mem::take(&mut self.open_columns);
            rows::subtract(self.g, &mut self.rows, factor, [top, below], &open);
            self.open_columns = open;
            self.done.steps.push(Step::Subtract { factor, rows: [top, below] });
        }
        let entries = self.open_columns.iter().map(|&other| (other, self.rows[top].entries[other]));
        let rest = entries.filter(|entry| entry.1 != Scalar::ZERO).collect();
        self.done.pivots.push(Pivot::Row { row: top, column, inverse: inverse.guarded, rest });
    }

    /// The row that gives the pivot, of those that compete.
    fn winner(&mut self, column: usize, rows: &[usize]) -> Option<usize> {
        if rows.is_empty() {
            return None;
        }
        if let Some(best) = largest(self.g, &mut self.rows, column, rows) {
            return Some(best);
        }
        // Pairs, then pairs of winners: as many comparisons as one row against all others, and few that wait for each other.
        let mut left = rows.to_vec();
        while left.len() > 1 {
            let round = |pair: &[usize]| match *pair {
                [a, b] => self.compete(column, [a, b]),
                _ => pair[0],
            };
            left = left.chunks(2).map(round).collect();
        }
        left.first().copied()
    }

    /// Brings the row with the larger entry to the first place; that row.
    fn compete(&mut self, column: usize, rows: [usize; 2]) -> usize {
        let [above, below] = rows.map(|row| self.rows[row].entries[column]);
        let scales = rows.map(|row| self.rows[row].scale(self.g));
        let ratio = self.g.div(below, above);
        // Multiples of one value, in one unit: the larger one is known.
        if let Some(ratio) = self.g.literal(ratio).filter(|_| scales[0] == scales[1]) {
            return rows[usize::from(ratio.value().abs() > 1.0)];
        }
        let [mut above, mut below] = [above, below].map(|entry| self.g.call(Call::Abs, &[entry]));
        if scales[0] != scales[1] {
            (above, below) = (self.g.mul(above, scales[1]), self.g.mul(below, scales[0]));
        }
        let mask = self.g.call(Call::Less, &[above, below]);
        self.g.label(mask, || format!("exchanged_{}_{}", rows[1] + 1, column + 1));
        let open = std::mem::take(&mut self.open_columns);
        rows::change_places(self.g, &mut self.rows, mask, rows, &open);
        self.open_columns = open;
        self.done.steps.push(Step::Exchange { mask, rows });
        rows[0]
    }

    fn inverse(&mut self, column: usize, row: usize) -> Inverse {
        let pivot = self.rows[row].entries[column];
        if pivot == Scalar::ZERO {
            let none = if self.purpose == Purpose::Regular { self.g.call(Call::Nan, &[]) } else { Scalar::ZERO };
            return Inverse { guarded: none, plain: None };
        }
        if let Some(number) = self.g.literal(pivot) {
            // Of the quotient by what has cancelled nothing is known.
            let known = number.is_sharp();
            self.done.literals += usize::from(known);
            let guarded = if known { self.g.reciprocal(pivot) } else { self.g.call(Call::Nan, &[]) };
            return Inverse { guarded, plain: None };
        }
        let noise = self.rows[row].noise(self.g, column);
        let least = self.rounding_of(noise);
        let size = self.g.call(Call::Abs, &[pivot]);
        let inverse = self.guard(pivot, size, least);
        if self.purpose == Purpose::Rank {
            let (count, scale) = (self.g.integer(self.size), self.rows[row].scale(self.g));
            let noise = self.g.mul(count, noise);
            let most = self.g.call(Call::Max, &[noise, scale]);
            let least = self.rounding_of(most);
            self.count(size, least);
        }
        self.g.label(inverse.guarded, || format!("pivot_{}_inv", column + 1));
        inverse
    }

    /// The size up to which a pivot is rounding.
    fn rounding_of(&mut self, noise: Scalar) -> Scalar {
        let (units, unit) = (self.g.integer(UNITS), self.g.call(Call::Epsilon, &[]));
        self.g.product(&[units, unit, noise])
    }

    /// A pivot has a share in the rank. What is no number has none.
    fn count(&mut self, size: Scalar, least: Scalar) {
        let found = self.g.call(Call::Less, &[least, size]);
        self.done.found.push(found);
    }

    /// One over a pivot of a size, zero up to the least.
    fn guard(&mut self, pivot: Scalar, size: Scalar, least: Scalar) -> Inverse {
        let mask = self.g.call(Call::LessEqual, &[size, least]);
        // Zero, but the graph does not know that: its product with what is infinite is no number.
        let unit = self.g.call(Call::Epsilon, &[]);
        let zero = self.g.call(Call::Min, &[unit, Scalar::ZERO]);
        let nothing = self.g.mul(least, zero);
        let plain = self.g.reciprocal(pivot);
        if self.purpose == Purpose::Regular {
            let none = self.g.call(Call::Nan, &[]);
            return Inverse { guarded: self.g.call(Call::Select, &[mask, none, plain]), plain: None };
        }
        let guarded = self.g.call(Call::Select, &[mask, nothing, plain]);
        Inverse { guarded, plain: Some((mask, plain)) }
    }
}

fn dot(g: &mut Graph, a: &[Scalar], b: &[Scalar]) -> Scalar {
    let terms: Vec<Scalar> = a.iter().zip(b).map(|(&a, &b)| g.mul(a, b)).collect();
    g.sum(&terms)
}
