//! Stage `symbolic`: square linear systems, solved by the structure of their matrix.
//!
//! In: A x = b; which symbols are parameters. Out: x and the numerical rank, a literal where it is known. Nothing is
//! computed that the pattern of A already says:
//!
//! - *Parts* that share no unknown are systems of their own.
//! - In the block triangular form of a part, blocks of literals that need no other blocks, or that no others need, are
//!   regular while compiling: they are inverted exactly and cost no pivot. What is left between them, the *core*, falls into
//!   parts again.
//! - A part of parameters alone is inverted in `Model::new`: one pivoted solve for each column. Its pivots depend on the matrix alone, so
//!   products with these columns are what the pivoted solve of the right side gives, beyond the rank too.
//! - A large part with many zeros, as that of inputs and multipliers of loops, is factorised with them
//!   ([`super::sparse_factors`]), as it stands or transposed: whichever takes less.
//! - Every other part is one pivoted solve in the runtime.
//!
//! Ranks add up exactly; of a part that is factorised it is known whether the rank is full. Blocks of literals are regular, so taking one away with what stands left of it or below it lowers
//! the rank by its size; and rows of different parts share no column. Blocks of the core that need each other in one direction alone
//! stay together, since the rank of a triangular matrix may be greater than the number of its pivots that are not zero.
//!
//! The runtime brings rows and columns to one scale and drops pivots below `16 n` roundings. A part is brought to scale by
//! itself: parts that share no unknown never had a common scale, and units in which a block of literals acts on the
//! core no longer change what counts as zero there. `n` is the size of the part. Literals must be regular by a margin that no threshold of any
//! scalar reaches (`CLEAR`); otherwise their part is left to the runtime as it is.

use super::constants::Constants;
use super::echelon::best_pivots;
use super::evaluate::solve_above;
use super::graph::{BlockKind, Graph, Scalar, SymbolId};
use super::number::Number;
use super::sparse_factors::{Purpose, SparseFactors, expressions};
use super::triangular_form::{components, matching};

/// Pivots of literals, of rows and columns that are brought to one scale, count if they are greater. The threshold of the
/// runtime stays below it up to 500 equations in single precision.
const CLEAR: f64 = 1e-3;

/// The largest block of literals that is inverted.
const MOST_LITERALS: usize = 16;

/// The largest part that is inverted in `Model::new`.
const MOST_PARAMETERS: usize = 8;

/// The largest part that is solved with pivots of the whole whatever its zeros are.
const MOST_PIVOTED: usize = 8;

/// Rows, and the columns in which their pivots stand.
type Rows = Vec<usize>;

/// Solves A x = b; the rank comes last.
pub fn solve_structured(
    g: &mut Graph,
    parameter: &dyn Fn(SymbolId) -> bool,
    matrix: &[Vec<Scalar>],
    side: &[Scalar],
) -> (Vec<Scalar>, Scalar) {
    let n = side.len();
    let constants = Constants::of(g, parameter, &matrix.concat());
    let pattern: Vec<Vec<(usize, f64)>> =
        matrix.iter().map(|row| (0..n).filter(|&j| row[j] != Scalar::ZERO).map(|j| (j, 1.0)).collect()).collect();
    let all = (0..n).collect::<Rows>();
    let mut system = System { matrix, side, pivots: all.clone(), unknowns: vec![None; n], ranks: Vec::new() };
    // Singular whatever its entries are: the runtime says so.
    let matched: Option<Vec<usize>> = matching(&pattern, n).into_iter().collect();
    match matched {
        None => system.solve_part(g, &constants, &all),
        Some(pivots) => {
            system.pivots = pivots;
            for part in system.parts(&all) {
                system.peel(g, &constants, &part);
            }
        }
    }
    let rank = g.sum(&system.ranks);
    (system.unknowns.into_iter().map(|x| x.unwrap_or(Scalar::ZERO)).collect(), rank)
}

struct System<'a> {
    matrix: &'a [Vec<Scalar>],
    side: &'a [Scalar],
    /// By row the column that it is matched with.
    pivots: Vec<usize>,
    /// Those that are known.
    unknowns: Vec<Option<Scalar>>,
    ranks: Vec<Scalar>,
}

/// A block of the triangular form.
struct Block {
    rows: Rows,
    /// Blocks that it needs, by number; itself is none of them.
    needs: Vec<usize>,
    /// If it consists of literals and is regular: by unknown its factors of the rows' sides.
    inverse: Option<Vec<Vec<Number>>>,
}

impl System<'_> {
    /// Columns of a part or a block, in order.
    fn columns(&self, rows: &[usize]) -> Vec<usize> {
        let mut columns: Vec<usize> = rows.iter().map(|&row| self.pivots[row]).collect();
        columns.sort_unstable();
        columns
    }

    /// Rows by number among these, the columns of all of which are theirs, that have a pivot in a column of each row.
    fn needs(&self, rows: &[usize]) -> Vec<Vec<usize>> {
        let needed = |&row: &usize| {
            let reads = |other: &usize| self.matrix[row][self.pivots[rows[*other]]] != Scalar::ZERO;
            (0..rows.len()).filter(reads).collect()
        };
        rows.iter().map(needed).collect()
    }

    /// Rows that share no unknown with others, directly or through others, among these.
    fn parts(&self, rows: &[usize]) -> Vec<Rows> {
        let mut both = self.needs(rows);
        for (row, list) in both.clone().into_iter().enumerate() {
            for other in list {
                both[other].push(row);
            }
        }
        let mut parts = components(&both);
        parts.sort_unstable();
        parts.into_iter().map(|part| part.into_iter().map(|at| rows[at]).collect()).collect()
    }

    /// Solves a part: blocks of literals in front, the core, blocks of literals behind.
    fn peel(&mut self, g: &mut Graph, constants: &Constants, part: &[usize]) {
        let blocks = self.blocks(g, part);
        let mut front = vec![false; blocks.len()];
        for (at, block) in blocks.iter().enumerate() {
            front[at] = block.inverse.is_some() && block.needs.iter().all(|&other| front[other]);
        }
        let mut behind = vec![false; blocks.len()];
        for at in (0..blocks.len()).rev() {
            let mut users = (at + 1..blocks.len()).filter(|&user| blocks[user].needs.contains(&at));
            behind[at] = !front[at] && blocks[at].inverse.is_some() && users.all(|user| behind[user]);
        }
        let rows_of = |which: &[bool]| -> Rows {
            let mut rows: Rows =
                blocks.iter().zip(which).filter(|(_, is)| **is).flat_map(|(b, _)| b.rows.clone()).collect();
            rows.sort_unstable();
            rows
        };
        let mut core: Vec<bool> = front.iter().zip(&behind).map(|(front, behind)| !front && !behind).collect();
        if !self.is_clear(g, &rows_of(&core.iter().map(|is| !is).collect::<Vec<_>>())) {
            [&mut front, &mut behind].into_iter().for_each(|list| list.fill(false));
            core.fill(true);
        }
        blocks.iter().zip(&front).filter(|(_, is)| **is).for_each(|(block, _)| self.substitute(g, block));
        for part in self.parts(&rows_of(&core)) {
            self.solve_part(g, constants, &part);
        }
        blocks.iter().zip(&behind).filter(|(_, is)| **is).for_each(|(block, _)| self.substitute(g, block));
    }

    /// The block triangular form of a part, what is needed first.
    fn blocks(&self, g: &Graph, part: &[usize]) -> Vec<Block> {
        let needs = self.needs(part);
        let groups = components(&needs);
        let mut of = vec![0; part.len()];
        for (at, group) in groups.iter().enumerate() {
            group.iter().for_each(|&row| of[row] = at);
        }
        let block = |(at, group): (usize, &Vec<usize>)| {
            let rows: Rows = group.iter().map(|&row| part[row]).collect();
            let mut needed: Vec<usize> = group.iter().flat_map(|&row| &needs[row]).map(|&row| of[row]).collect();
            needed.sort_unstable();
            needed.dedup();
            needed.retain(|&other| other != at);
            Block { inverse: self.inverse(g, &rows), rows, needs: needed }
        };
        groups.iter().enumerate().map(block).collect()
    }

    /// The inverse of a regular block of literals.
    fn inverse(&self, g: &Graph, rows: &[usize]) -> Option<Vec<Vec<Number>>> {
        let (columns, n) = (self.columns(rows), rows.len());
        if n > MOST_LITERALS {
            return None;
        }
        let row = |&row: &usize| columns.iter().map(|&j| g.literal(self.matrix[row][j])).collect();
        let literals: Vec<Vec<Number>> = rows.iter().map(row).collect::<Option<_>>()?;
        let (reduced, pivots) = best_pivots(&literals, n)?;
        let mut inverse = vec![Vec::new(); n];
        for (row, pivot) in reduced.into_iter().zip(pivots) {
            inverse[pivot] = row[n..].to_vec();
        }
        Some(inverse)
    }

    /// Whether the literals in these rows and their columns are regular beyond doubt; what else couples them does not matter.
    fn is_clear(&self, g: &Graph, rows: &[usize]) -> bool {
        let columns = self.columns(rows);
        let value = |row: usize, column: usize| g.literal(self.matrix[row][column]).map_or(0.0, Number::value);
        let values: Vec<f64> = rows.iter().flat_map(|&row| columns.iter().map(move |&j| value(row, j))).collect();
        // What is smaller counts as zero in the runtime.
        let least = f64::from(f32::MIN_POSITIVE);
        let tiny = rows.iter().any(|&row| {
            let entries = columns.iter().map(|&j| value(row, j).abs());
            entries.fold(0.0, f64::max) < least
        });
        !tiny && solve_above(&values, &vec![0.0; rows.len()], CLEAR).last() == Some(&(rows.len() as f64))
    }

    /// What the unknowns that are known leave of a right side.
    fn rest(&self, g: &mut Graph, row: usize) -> Scalar {
        let mut terms = vec![self.side[row]];
        for (&entry, known) in self.matrix[row].iter().zip(&self.unknowns) {
            if let (Some(known), false) = (known, entry == Scalar::ZERO) {
                terms.push(-g.mul(entry, *known));
            }
        }
        g.sum(&terms)
    }

    /// The unknowns of a block of literals.
    fn substitute(&mut self, g: &mut Graph, block: &Block) {
        let Some(inverse) = &block.inverse else { return };
        let sides: Vec<Scalar> = block.rows.iter().map(|&row| self.rest(g, row)).collect();
        for (column, factors) in self.columns(&block.rows).into_iter().zip(inverse) {
            let terms: Vec<Scalar> = factors
                .iter()
                .zip(&sides)
                .map(|(&factor, &side)| {
                    let factor = g.number(factor);
                    g.mul(factor, side)
                })
                .collect();
            self.unknowns[column] = Some(g.sum(&terms));
        }
        let size = g.integer(block.rows.len() as i64);
        self.ranks.push(size);
    }

    /// A part by itself.
    fn solve_part(&mut self, g: &mut Graph, constants: &Constants, rows: &[usize]) {
        let (columns, size, known) = (self.columns(rows), rows.len(), self.ranks.len());
        let sides: Vec<Scalar> = rows.iter().map(|&row| self.rest(g, row)).collect();
        let matrix: Vec<Scalar> = rows
            .iter()
            .flat_map(|&row| columns.iter().map(move |&j| (row, j)))
            .map(|(i, j)| self.matrix[i][j])
            .collect();
        let early = matrix.iter().all(|&entry| constants.holds(g, entry));
        let literal = matrix.iter().all(|&entry| g.literal(entry).is_some());
        let mut solve = |g: &mut Graph, side: &[Scalar]| {
            let operands: Vec<Scalar> = matrix.iter().chain(side).copied().collect();
            let mut unknowns =
                g.block_outputs(BlockKind::Solve { size, symmetric: false, groups: [].into() }, &operands);
            self.ranks.truncate(known);
            self.ranks.extend(unknowns.pop());
            unknowns
        };
        let unknowns = if early && !literal && size <= MOST_PARAMETERS {
            let unit = |at: usize| -> Vec<Scalar> {
                (0..size).map(|k| if k == at { Scalar::ONE } else { Scalar::ZERO }).collect()
            };
            let inverse: Vec<Vec<Scalar>> = (0..size).map(|at| solve(g, &unit(at))).collect();
            for (&row, entries) in rows.iter().zip(&inverse) {
                for (&column, &entry) in columns.iter().zip(entries) {
                    g.label(entry, || format!("inverse_{}_{}", column + 1, row + 1));
                }
            }
            let unknown = |k: usize| {
                let terms: Vec<Scalar> =
                    inverse.iter().zip(&sides).map(|(column, &side)| g.mul(column[k], side)).collect();
                g.sum(&terms)
            };
            (0..size).map(unknown).collect()
        } else if let Some((unknowns, rank)) = sparse(g, &matrix, &sides) {
            self.ranks.push(rank);
            unknowns
        } else {
            solve(g, &sides)
        };
        for (column, unknown) in columns.into_iter().zip(unknowns) {
            self.unknowns[column] = Some(unknown);
        }
    }
}

/// The solution of a part with its zeros, and its rank, where that takes less than pivots of the whole do.
fn sparse(g: &mut Graph, matrix: &[Scalar], side: &[Scalar]) -> Option<(Vec<Scalar>, Scalar)> {
    let size = side.len();
    if size <= MOST_PIVOTED {
        return None;
    }
    let transposed: Vec<Scalar> =
        (0..size).flat_map(|column| (0..size).map(move |row| matrix[row * size + column])).collect();
    let [plain, turned] = [matrix, &transposed].map(|matrix| expressions(size, matrix));
    // Sums, products, comparisons and exchanges of the runtime.
    if plain.min(turned) > 2 * size.pow(3) {
        return None;
    }
    if plain < turned {
        let factors = SparseFactors::of(g, size, matrix, Purpose::Rank);
        Some((factors.solve(g, side), factors.rank(g)))
    } else {
        let factors = SparseFactors::of(g, size, &transposed, Purpose::Rank);
        Some((factors.solve_transposed(g, side), factors.rank(g)))
    }
}
