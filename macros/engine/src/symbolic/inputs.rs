//! Stage `symbolic`: linear systems for unknown inputs, whose rows may be constant in disguise.
//!
//! In: A x = b, n rows and columns; what counts as constant; what may be divided by. Out: x and the numerical rank. A
//! row that is an expression times constants (all struts of a level platform rise by the same height z: z (1, .. 1))
//! is divided by that expression, guarded by a select where nobody says that it can't vanish. A row that differs from
//! such a one by multiples of constant rows is freed of them. Columns whose entries in one row may be divided by are
//! scaled so that this row is ones: others that are proportional to it become constant too. What is constant is
//! eliminated at compile time, exactly; the rest is left to [`super::pivoted`].

use crate::invariant::fault::OrFault;

use super::constants::Constants;
use super::echelon::best_pivots;
use super::graph::{Graph, Scalar, ScalarNode, SymbolId};
use super::number::Number;
use super::pivoted::{guarded, solve_pivoted};

/// What the caller knows about expressions.
pub struct Known<'a> {
    /// Symbols that are known before run time: parameters.
    pub parameter: &'a dyn Fn(SymbolId) -> bool,
    /// Whether an expression can't vanish, proven or assumed by the user.
    pub nonzero: &'a dyn Fn(&Graph, Scalar) -> bool,
}

/// The solution of a system for inputs.
pub struct Found {
    pub unknowns: Vec<Scalar>,
    /// Numerical rank, a literal where it is known.
    pub rank: Scalar,
    /// Rows that were eliminated at compile time.
    pub constant: usize,
}

/// A row as constants by expression, and its right side.
struct InputRow {
    parts: Vec<(Scalar, Vec<Scalar>)>,
    side: Scalar,
}

/// Solves for inputs. A system that is not square has no solution here: rank zero.
pub fn solve_inputs(g: &mut Graph, known: &Known, matrix: &[Vec<Scalar>], side: &[Scalar]) -> Found {
    let n = side.len();
    if matrix.len() != n || matrix.iter().any(|row| row.len() != n) {
        return Found { unknowns: vec![Scalar::ZERO; n], rank: Scalar::ZERO, constant: 0 };
    }
    let constants = Constants::of(g, known.parameter, &matrix.concat());
    let (scales, scaled) = scale_columns(g, known, &constants, matrix);
    let (constant, mut rest, rank) = reduce(g, known, &constants, &scaled, side);
    let eliminated = constant.len();
    // All of it is known before run time: the inverse is a set of fields, with the exchanges that the values ask for.
    if eliminated == n && !is_literal(g, &constant) {
        let (unknowns, full) = invert(g, &constant);
        let unknowns = unknowns.iter().zip(&scales).map(|(&x, &scale)| g.mul(x, scale)).collect();
        // What guards and the inverse have lost together.
        let all = g.integer(n as i64);
        let rank = g.sum(&[rank, full, -all]);
        return Found { unknowns, rank, constant: n };
    }
    // Of pivots that are parameters nobody knows which is large: such rows stay.
    let (constant, parametric): (Vec<_>, Vec<_>) =
        constant.into_iter().partition(|row| is_literal(g, std::slice::from_ref(row)));
    let own = g.integer(parametric.len() as i64);
    let rank = g.sub(rank, own);
    rest.splice(0..0, parametric);
    let found = eliminate(g, n, &constant, &rest);
    let constant = constant.len();
    let Some((unknowns, left)) = found else {
        // Dependent by structure: the runtime says so.
        let (mut solutions, rank) = solve_pivoted(g, matrix, &[side.to_vec()]);
        return Found { unknowns: solutions.pop().or_fault("a right-hand side has a solution"), rank, constant: 0 };
    };
    let unknowns = unknowns.iter().zip(&scales).map(|(&x, &scale)| g.mul(x, scale)).collect();
    let rank = g.add(rank, left);
    Found { unknowns, rank, constant }
}

/// Reciprocals by which columns are to be multiplied, and the matrix that follows: the row that makes most others
/// constant becomes ones.
fn scale_columns(
    g: &mut Graph,
    known: &Known,
    constants: &Constants,
    matrix: &[Vec<Scalar>],
) -> (Vec<Scalar>, Vec<Vec<Scalar>>) {
    let n = matrix.len();
    let mut best: Option<(usize, usize)> = None;
    for (at, row) in matrix.iter().enumerate() {
        let free = row.iter().all(|&entry| (known.nonzero)(g, entry));
        // A common factor is the row's own affair.
        if !free || row.iter().all(|&entry| entry.positive() == row[0].positive()) {
            continue;
        }
        let count = matrix.iter().filter(|other| proportions(g, constants, row, other).is_some()).count();
        if count > best.map_or(1, |b| b.1) {
            best = Some((at, count));
        }
    }
    let Some((at, _)) = best else { return (vec![Scalar::ONE; n], matrix.to_vec()) };
    let scales: Vec<Scalar> = matrix[at].iter().map(|&entry| g.reciprocal(entry)).collect();
    let scaled = matrix
        .iter()
        .map(|row| match proportions(g, constants, &matrix[at], row) {
            Some(constants) => constants,
            None => row.iter().zip(&scales).map(|(&entry, &scale)| g.mul(entry, scale)).collect(),
        })
        .collect();
    (scales, scaled)
}

/// Constants by which a row's entries are those of another.
fn proportions(g: &mut Graph, constants: &Constants, base: &[Scalar], row: &[Scalar]) -> Option<Vec<Scalar>> {
    let pairs = base.iter().zip(row);
    pairs
        .map(|(&b, &r)| {
            let (below, above) = (parts(g, constants, b), parts(g, constants, r));
            if above.is_empty() {
                return Some(Scalar::ZERO);
            }
            let (first, rest) = (below.first()?, above.iter().find(|part| part.0 == below[0].0)?);
            g.literal(first.1).filter(|n| n.is_sharp())?;
            let ratio = g.div(rest.1, first.1);
            (g.mul(ratio, b) == r).then_some(ratio)
        })
        .collect()
}

/// An expression as a sum of others with constant factors; the constant term goes with one.
fn parts(g: &mut Graph, constants: &Constants, s: Scalar) -> Vec<(Scalar, Scalar)> {
    let mut list = Vec::new();
    gather(g, constants, s, Scalar::ONE, &mut list);
    let mut merged: Vec<(Scalar, Scalar)> = Vec::new();
    for (expression, factor) in list {
        match merged.iter_mut().find(|m| m.0 == expression) {
            Some(m) => m.1 = g.add(m.1, factor),
            None => merged.push((expression, factor)),
        }
    }
    merged.retain(|m| m.1 != Scalar::ZERO);
    merged
}

fn gather(g: &mut Graph, constants: &Constants, s: Scalar, factor: Scalar, list: &mut Vec<(Scalar, Scalar)>) {
    let factor = if s.is_negative() { -factor } else { factor };
    let s = s.positive();
    if constants.holds(g, s) {
        let factor = g.mul(factor, s);
        list.push((Scalar::ONE, factor));
        return;
    }
    match g.node(s).clone() {
        ScalarNode::Sum(terms) => terms.iter().for_each(|&t| gather(g, constants, t, factor, list)),
        ScalarNode::Product(factors) => {
            let (early, late): (Vec<Scalar>, Vec<Scalar>) = factors.iter().partition(|&&f| constants.holds(g, f));
            if early.is_empty() {
                list.push((s, factor));
                return;
            }
            let early = g.product(&early);
            let factor = g.mul(factor, early);
            let late = g.product(&late);
            gather(g, constants, late, factor, list);
        }
        _ => list.push((s, factor)),
    }
}

/// Constant rows with their right sides, the rest, and the rank that guards have lost or not, beyond that of the rest.
type Reduced = (Vec<(Vec<Scalar>, Scalar)>, Vec<(Vec<Scalar>, Scalar)>, Scalar);

fn reduce(g: &mut Graph, known: &Known, constants: &Constants, matrix: &[Vec<Scalar>], side: &[Scalar]) -> Reduced {
    let mut open: Vec<InputRow> = Vec::new();
    for (row, &side) in matrix.iter().zip(side) {
        let entries: Vec<Vec<(Scalar, Scalar)>> = row.iter().map(|&entry| parts(g, constants, entry)).collect();
        let mut by: Vec<(Scalar, Vec<Scalar>)> = Vec::new();
        for (column, list) in entries.iter().enumerate() {
            for &(expression, factor) in list {
                let at = by.iter().position(|p| p.0 == expression).unwrap_or_else(|| {
                    by.push((expression, vec![Scalar::ZERO; row.len()]));
                    by.len() - 1
                });
                by[at].1[column] = factor;
            }
        }
        open.push(InputRow { parts: merge(g, by), side });
    }
    let mut constant: Vec<(Vec<Scalar>, Scalar)> = Vec::new();
    let mut full = Vec::new();
    loop {
        for row in &mut open {
            free(g, row, &constant);
        }
        let Some(at) = open.iter().position(|row| row.parts.len() == 1) else { break };
        let row = open.remove(at);
        let Some((expression, vector)) = row.parts.into_iter().next() else { break };
        let (inverse, flag) = if (known.nonzero)(g, expression) {
            (g.reciprocal(expression), Scalar::ONE)
        } else {
            guarded(g, expression, Scalar::ONE)
        };
        full.push(flag);
        let side = g.mul(row.side, inverse);
        constant.push((vector, side));
    }
    let rest = open.into_iter().map(|row| {
        let width = matrix.first().map_or(0, Vec::len);
        let entries = (0..width).map(|column| {
            let terms: Vec<Scalar> = row.parts.iter().map(|(e, v)| g.mul(*e, v[column])).collect();
            g.sum(&terms)
        });
        (entries.collect(), row.side)
    });
    let rest = rest.collect();
    let full = g.sum(&full);
    (constant, rest, full)
}

/// Parts with proportional constants are one: p (1, 1) + q (2, 2) = (p + 2 q) (1, 1).
fn merge(g: &mut Graph, parts: Vec<(Scalar, Vec<Scalar>)>) -> Vec<(Scalar, Vec<Scalar>)> {
    let mut merged: Vec<(Scalar, Vec<Scalar>)> = Vec::new();
    for (expression, vector) in parts {
        let found = (0..merged.len()).find_map(|at| multiple(g, &vector, &merged[at].1).map(|factor| (at, factor)));
        match found {
            Some((at, factor)) => {
                let more = g.mul(factor, expression);
                merged[at].0 = g.add(merged[at].0, more);
            }
            None => merged.push((expression, vector)),
        }
    }
    merged
}

/// The literal by which a vector is another one's multiple.
fn multiple(g: &mut Graph, vector: &[Scalar], base: &[Scalar]) -> Option<Scalar> {
    let plain = |g: &Graph, c: &Scalar| g.literal(*c).is_some_and(|n| !n.is_zero() && n.is_sharp());
    // Of literals of which cancellation has left little nothing is known to be a multiple.
    let other = |g: &Graph, c: &Scalar| *c != Scalar::ZERO && g.literal(*c).is_none();
    let column = base.iter().position(|c| plain(g, c)).or_else(|| base.iter().position(|c| other(g, c)))?;
    let factor = g.div(vector[column], base[column]);
    g.literal(factor)?;
    base.iter().zip(vector).all(|(&b, &v)| g.mul(factor, b) == v).then_some(factor)
}

/// Takes multiples of constant rows out of a row.
fn free(g: &mut Graph, row: &mut InputRow, constant: &[(Vec<Scalar>, Scalar)]) {
    let mut kept = Vec::new();
    for (expression, vector) in std::mem::take(&mut row.parts) {
        match combination(g, &vector, constant) {
            Some(factors) => {
                for (factor, (_, side)) in factors.into_iter().zip(constant) {
                    let taken = g.product(&[factor, expression, *side]);
                    row.side = g.sub(row.side, taken);
                }
            }
            None => kept.push((expression, vector)),
        }
    }
    // A row that is nothing else but constant rows can't be freed of the last.
    row.parts = kept;
}

/// Factors with which constant rows add up to a vector.
fn combination(g: &mut Graph, vector: &[Scalar], rows: &[(Vec<Scalar>, Scalar)]) -> Option<Vec<Scalar>> {
    let (at, factor) = (0..rows.len()).find_map(|at| multiple(g, vector, &rows[at].0).map(|factor| (at, factor)))?;
    let mut factors = vec![Scalar::ZERO; rows.len()];
    factors[at] = factor;
    Some(factors)
}

fn is_literal(g: &Graph, rows: &[(Vec<Scalar>, Scalar)]) -> bool {
    rows.iter().all(|(row, _)| row.iter().all(|&c| g.literal(c).is_some()))
}

/// Unknowns and rank of a system whose matrix consists of parameters.
fn invert(g: &mut Graph, rows: &[(Vec<Scalar>, Scalar)]) -> (Vec<Scalar>, Scalar) {
    let n = rows.len();
    let matrix: Vec<Vec<Scalar>> = rows.iter().map(|row| row.0.clone()).collect();
    let unit = |k: usize| (0..n).map(|i| if i == k { Scalar::ONE } else { Scalar::ZERO }).collect();
    let units: Vec<Vec<Scalar>> = (0..n).map(unit).collect();
    let (columns, rank) = solve_pivoted(g, &matrix, &units);
    let unknowns = (0..n).map(|i| {
        let terms: Vec<Scalar> = (0..n).map(|j| g.mul(columns[j][i], rows[j].1)).collect();
        g.sum(&terms)
    });
    (unknowns.collect(), rank)
}

/// Eliminates constant rows from the others and solves what is left.
fn eliminate(
    g: &mut Graph,
    n: usize,
    constant: &[(Vec<Scalar>, Scalar)],
    rest: &[(Vec<Scalar>, Scalar)],
) -> Option<(Vec<Scalar>, Scalar)> {
    let k = constant.len();
    let literals: Option<Vec<Vec<Number>>> =
        constant.iter().map(|(row, _)| row.iter().map(|&c| g.literal(c)).collect()).collect();
    let (rows, pivots) = best_pivots(&literals?, n)?;
    let free: Vec<usize> = (0..n).filter(|j| !pivots.contains(j)).collect();
    // x_pivot = side - sum over free unknowns.
    let sides: Vec<Scalar> = rows
        .iter()
        .map(|row| {
            let terms: Vec<Scalar> = (0..k)
                .map(|j| {
                    let c = g.number(row[n + j]);
                    g.mul(c, constant[j].1)
                })
                .collect();
            g.sum(&terms)
        })
        .collect();
    let mut matrix = Vec::new();
    let mut side = Vec::new();
    for (row, right) in rest {
        let entries = free.iter().map(|&j| {
            let mut terms = vec![row[j]];
            for (p, &pivot) in pivots.iter().enumerate() {
                let c = g.number(rows[p][j]);
                terms.push(-g.mul(c, row[pivot]));
            }
            g.sum(&terms)
        });
        matrix.push(entries.collect::<Vec<_>>());
        let mut terms = vec![*right];
        for (p, &pivot) in pivots.iter().enumerate() {
            terms.push(-g.mul(row[pivot], sides[p]));
        }
        side.push(g.sum(&terms));
    }
    let (found, rank) = match matrix.is_empty() {
        true => (Vec::new(), Scalar::ZERO),
        false => {
            let (mut list, rank) = solve_pivoted(g, &matrix, &[side]);
            (list.pop().or_fault("a right-hand side has a solution"), rank)
        }
    };
    let mut x = vec![Scalar::ZERO; n];
    for (&j, &value) in free.iter().zip(&found) {
        x[j] = value;
    }
    for (p, &pivot) in pivots.iter().enumerate() {
        let mut terms = vec![sides[p]];
        for &j in &free {
            let c = g.number(rows[p][j]);
            terms.push(-g.mul(c, x[j]));
        }
        x[pivot] = g.sum(&terms);
    }
    Some((x, rank))
}
