//! Systems eliminated in the order of their pattern, against the pivoted solve of the whole, and what they cost.

use crate::rng::Rng;
use multibody_engine::symbolic::evaluate::{Evaluator, Real, solve_f64};
use multibody_engine::symbolic::graph::{BlockKind, Graph, Scalar, ScalarNode, SymbolId};
use multibody_engine::symbolic::lower::Lowering;
use multibody_engine::symbolic::sparse_factors::{Purpose, SparseFactors};

/// An entry: zero, a literal, or a symbol.
#[derive(Clone, Copy, PartialEq)]
enum Entry {
    Zero,
    Literal(f64),
    Moving,
}

/// The unknowns for values of what moves, with the matrix in numbers.
fn solved(entries: &[Vec<Entry>], value: &dyn Fn(usize) -> f64) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let (mut g, n) = (Graph::new(), entries.len());
    let side: Vec<Scalar> = (0..n).map(|_| g.symbol()).collect();
    let matrix: Vec<Scalar> = entries
        .iter()
        .flatten()
        .map(|entry| match *entry {
            Entry::Zero => Scalar::ZERO,
            Entry::Literal(x) => g.decimal(x),
            Entry::Moving => g.symbol(),
        })
        .collect();
    let factors = SparseFactors::of(&mut g, n, &matrix, Purpose::Solutions);
    let unknowns = factors.solve(&mut g, &side);
    let symbols = |id: SymbolId| value(id.0);
    let numbers = |list: &[Scalar]| Evaluator::new(&g, Real { symbols: &symbols }).run(list);
    (numbers(&unknowns), numbers(&matrix), numbers(&side))
}

fn random(rng: &mut Rng, n: usize, filled: f64) -> Vec<Vec<Entry>> {
    let mut entry = |on: bool| match rng.real(0.0, 1.0) {
        x if x < 0.15 && on => Entry::Literal((rng.real(0.0, 1.0) * 9.0).round() - 4.5),
        x if x < filled || on => Entry::Moving,
        _ => Entry::Zero,
    };
    (0..n).map(|i| (0..n).map(|j| entry(i == j)).collect()).collect()
}

#[test]
fn solutions_are_those_of_the_pivoted_solve() {
    let mut rng = Rng::new(5);
    for round in 0..300 {
        let n = 1 + round % 9;
        let entries = random(&mut rng, n, [0.25, 0.5, 1.0][round % 3]);
        let values: Vec<f64> = (0..n + n * n).map(|_| 2.0 * rng.real(0.0, 1.0) - 1.0).collect();
        let (got, matrix, side) = solved(&entries, &|k| values[k]);
        let want = solve_f64(&matrix, &side);
        if want[n] < n as f64 {
            assert!(got.iter().all(|x| x.is_finite()), "{got:?}");
            continue;
        }
        let size = want[..n].iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        for (a, b) in got.iter().zip(&want) {
            assert!((a - b).abs() <= 1e-11 * size * size, "{n}: {got:?} {want:?}");
        }
    }
}

/// Whatever the order is, the largest entry of a column gives the pivot: nothing is lost beside small ones.
#[test]
fn small_entries_are_no_pivots() {
    let mut rng = Rng::new(6);
    for _ in 0..200 {
        let entries = random(&mut rng, 6, 0.6);
        let values: Vec<f64> = (0..42)
            .map(|_| (2.0 * rng.real(0.0, 1.0) - 1.0) * if rng.real(0.0, 1.0) < 0.3 { 1e-9 } else { 1.0 })
            .collect();
        let (got, matrix, side) = solved(&entries, &|k| values[k]);
        let size = got.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        if solve_f64(&matrix, &side)[6] < 6.0 || size > 1e6 {
            continue;
        }
        for (row, b) in matrix.chunks(6).zip(&side) {
            let left = row.iter().zip(&got).map(|(a, x)| a * x).sum::<f64>() - b;
            assert!(left.abs() <= 1e-13 * size, "{left:e} of {size:e}");
        }
    }
}

/// Where rows depend on each other unknowns are finite: rounding is no pivot, and neither is zero.
#[test]
fn singular_matrices_have_finite_solutions() {
    let all = vec![vec![Entry::Moving; 3]; 3];
    let rows = [0.3, -0.7, 0.1, 0.9, 0.2, -0.4];
    let dependent: Vec<f64> = (0..3).map(|k| (rows[k] + rows[k + 3]) / 3.0).collect();
    let values: Vec<f64> = [1.0, 2.0, 1.0].into_iter().chain(rows).chain(dependent).collect();
    let (got, ..) = solved(&all, &|k| values[k]);
    assert!(got.iter().all(|x| x.abs() < 100.0), "{got:?}");
    let (got, ..) = solved(&all, &|k| if k < 3 { 1.0 } else { 0.0 });
    assert_eq!(got, [0.0; 3]);
    // By structure: a column and a row of zeros.
    let mut entries = all.clone();
    entries.iter_mut().for_each(|row| row[1] = Entry::Zero);
    entries[2] = vec![Entry::Zero; 3];
    let (got, ..) = solved(&entries, &|k| values[k]);
    assert!(got[1] == 0.0 && got.iter().all(|x| x.is_finite()), "{got:?}");
    // What is no number shows.
    let (got, ..) = solved(&all, &|k| if k == 5 { f64::NAN } else { values[k] });
    assert!(got.iter().any(|x| x.is_nan()), "{got:?}");
}

/// Six pairs of unknowns, each in three equations of its own, that six more unknowns couple: linear in the number of pairs but for
/// the core, and a second right side costs a fraction of the first.
#[test]
fn what_hangs_together_loosely_is_cheap() {
    let count = |sides: usize| {
        let (mut g, n) = (Graph::new(), 18);
        let mut matrix = vec![Scalar::ZERO; n * n];
        for row in 0..n {
            for column in [row / 3 * 2, row / 3 * 2 + 1].into_iter().chain(12..18) {
                matrix[row * n + column] = g.symbol();
            }
        }
        let mut roots = Vec::new();
        for _ in 0..sides {
            let side: Vec<Scalar> = (0..n).map(|_| g.symbol()).collect();
            let operands: Vec<Scalar> = matrix.iter().chain(&side).copied().collect();
            roots.extend(g.block_outputs(BlockKind::Eliminate { size: n, strict: false }, &operands));
        }
        let mut lowering = Lowering::new(&g);
        let roots = lowering.run(&roots);
        let cost = lowering.to.cost(&roots);
        cost.add + cost.mul + cost.div + cost.compare + cost.other
    };
    let (one, two) = (count(1), count(2));
    println!("{one} operations, {two} for two sides");
    // The pivoted solve of the runtime takes 25,000.
    assert!(one < 2_500 && 3 * (two - one) < one, "{one} {two}");
}

/// Columns at right angles whatever the angles are: their unknowns are projections, and nothing competes for a pivot. With as many
/// rows as columns, and with one more, where a third unknown is left that another equation couples to a fourth.
#[test]
fn orthogonal_columns_need_no_pivots() {
    for size in [3, 4] {
        let mut g = Graph::new();
        let [a, b, l] = [g.symbol(), g.symbol(), g.symbol()];
        let (sines, cosines) = ([a, b].map(|x| g.sin(x)), [a, b].map(|x| g.cos(x)));
        // The tip of a leg l (sin b, -sin a cos b, cos a cos b), and what its joints do to it.
        let tip = [sines[1], -g.mul(sines[0], cosines[1]), g.mul(cosines[0], cosines[1])];
        let first = [Scalar::ZERO, -tip[2], tip[1]].map(|x| g.mul(l, x));
        let second = [cosines[1], g.mul(sines[0], sines[1]), -g.mul(cosines[0], sines[1])].map(|x| g.mul(l, x));
        let others: Vec<Scalar> = (0..16).map(|_| g.symbol()).collect();
        let mut matrix = vec![Scalar::ZERO; size * size];
        for row in 0..3 {
            matrix[row * size] = first[row];
            matrix[row * size + 1] = second[row];
            matrix[row * size + 2] = if size == 3 { tip[row] } else { others[row] };
        }
        if size == 4 {
            (0..3).for_each(|row| matrix[row * 4 + 3] = others[3 + row]);
            (matrix[14], matrix[15]) = (others[6], others[7]);
        }
        let side: Vec<Scalar> = others[8..8 + size].to_vec();
        let operands: Vec<Scalar> = matrix.iter().chain(&side).copied().collect();
        let roots = g.block_outputs(BlockKind::Eliminate { size, strict: false }, &operands);
        let mut lowering = Lowering::new(&g);
        let lowered = lowering.run(&roots);
        let cost = lowering.to.cost(&lowered);
        // Guards of the pivots and of a normal's length, and the last two rows of the second, which do compete.
        assert!(cost.compare + cost.other <= [2, 22][size - 3], "{cost:?}");
        let mut rng = Rng::new(8);
        for round in 0..50 {
            let mut values: Vec<f64> = (0..19).map(|_| rng.real(-1.0, 1.0)).collect();
            values[2] += 2.0;
            // The leg along its first axis: a column of rounding, and its unknown is some number.
            let singular = size == 3 && round == 0;
            if singular {
                values[1] = std::f64::consts::FRAC_PI_2;
            }
            let symbols = |id: SymbolId| values[id.0];
            let numbers = |g: &Graph, list: &[Scalar]| Evaluator::new(g, Real { symbols: &symbols }).run(list);
            let got = numbers(&lowering.to, &lowered);
            let want = solve_f64(&numbers(&g, &matrix), &numbers(&g, &side));
            let scale = want.iter().fold(1.0_f64, |scale, x| scale.max(x.abs()));
            for (x, y) in got.iter().zip(&want) {
                assert!(singular && x.is_finite() || (x - y).abs() <= 1e-12 * scale * scale, "{got:?} {want:?}");
            }
        }
    }
}

/// The greatest share of an equation that a solution leaves, of what its terms are made of.
fn left(matrix: &[f64], side: &[f64], unknowns: &[f64]) -> f64 {
    let of_row = |(row, b): (&[f64], &f64)| {
        let terms: Vec<f64> = row.iter().zip(unknowns).map(|(a, x)| a * x).chain([-b]).collect();
        let size: f64 = terms.iter().map(|x| x.abs()).sum();
        if size == 0.0 { 0.0 } else { terms.iter().sum::<f64>().abs() / size }
    };
    matrix
        .chunks(side.len())
        .zip(side)
        .map(of_row)
        .fold(0.0, |most, x| if x.is_nan() { f64::INFINITY } else { x.max(most) })
}

/// Rows and columns in any units, by parameters that nobody knew while compiling: each solution is that of the system in units
/// of one.
#[test]
fn units_do_not_matter() {
    let mut rng = Rng::new(9);
    for round in 0..400 {
        let n = 2 + round % 7;
        let entries: Vec<Vec<Entry>> = random(&mut rng, n, [0.4, 0.7, 1.0][round % 3])
            .into_iter()
            .map(|row| row.into_iter().map(|e| if let Entry::Literal(_) = e { Entry::Moving } else { e }).collect())
            .collect();
        let values: Vec<f64> = (0..n + n * n).map(|_| 2.0 * rng.real(0.0, 1.0) - 1.0).collect();
        let (plain, matrix, side) = solved(&entries, &|k| values[k]);
        let size = plain.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        if solve_f64(&matrix, &side)[n] < n as f64 || size > 1e4 {
            continue;
        }
        let mut unit = |most: f64| -> Vec<f64> { (0..n).map(|_| rng.real(-most, most).round().exp2()).collect() };
        let (rows, columns) = (unit(40.0), unit(40.0));
        // Symbols stand in the order of the entries that move, behind the right side.
        let places: Vec<usize> = (0..n * n).filter(|&at| entries[at / n][at % n] == Entry::Moving).collect();
        let scaled = |k: usize| match k.checked_sub(n) {
            None => values[k] * rows[k],
            Some(at) => values[k] * rows[places[at] / n] / columns[places[at] % n],
        };
        let (got, ..) = solved(&entries, &scaled);
        for ((x, want), unit) in got.iter().zip(&plain).zip(&columns) {
            assert!((x / unit - want).abs() <= 1e-10 * size * size, "{n}: {got:?} {plain:?} {rows:?} {columns:?}");
        }
    }
}

/// Entries over thirty orders of magnitude, in no units that would put them right: whatever has digits left counts, and
/// every equation is met.
#[test]
fn small_pivots_count_where_nothing_has_cancelled() {
    let mut rng = Rng::new(10);
    let mut met = 0;
    for round in 0..400 {
        let n = 2 + round % 5;
        let entries = vec![vec![Entry::Moving; n]; n];
        let mut value = || (2.0 * rng.real(0.0, 1.0) - 1.0) * 10_f64.powf(rng.real(-30.0, 0.0));
        let values: Vec<f64> = (0..n + n * n).map(|_| value()).collect();
        let (got, matrix, side) = solved(&entries, &|k| values[k]);
        met += usize::from(left(&matrix, &side, &got) < 1e-9);
    }
    println!("{met} of 400");
    assert!(met >= 375, "{met}");
}

/// The pivot of a column that vanishes takes a row along, of which the others get their share: what it says of other unknowns
/// is not lost, whichever row it is and whichever is superfluous.
#[test]
fn what_is_undetermined_takes_nothing_along() {
    let mut rng = Rng::new(11);
    for round in 0..300 {
        let n = 3 + round % 5;
        let entries = vec![vec![Entry::Moving; n]; n];
        let (idle, superfluous) = (rng.below(n), rng.below(n));
        let mut rows: Vec<Vec<f64>> = (0..n).map(|_| (0..n).map(|_| rng.real(-1.0, 1.0)).collect()).collect();
        rows.iter_mut().for_each(|row| row[idle] = 0.0);
        // A copy of one row, or a combination of two.
        let (a, b) = ((superfluous + 1) % n, (superfluous + 2) % n);
        let share = if round % 2 == 0 { 0.0 } else { 1.0 };
        rows[superfluous] = (0..n).map(|k| rows[a][k] + share * rows[b][k]).collect();
        let want: Vec<f64> = (0..n).map(|k| if k == idle { 0.0 } else { rng.real(-1.0, 1.0) }).collect();
        let side: Vec<f64> = rows.iter().map(|row| row.iter().zip(&want).map(|(a, x)| a * x).sum()).collect();
        let regular: Vec<f64> = (0..n)
            .filter(|&i| i != superfluous)
            .flat_map(|i| rows[i].iter().enumerate().filter(|(k, _)| *k != idle).map(|(_, &a)| a).collect::<Vec<_>>())
            .collect();
        let condition = solve_f64(&regular, &vec![1.0; n - 1]);
        if condition[n - 1] < (n - 1) as f64 || condition.iter().any(|x| x.abs() > 1e3) {
            continue;
        }
        let values: Vec<f64> = side.into_iter().chain(rows.concat()).collect();
        let (got, ..) = solved(&entries, &|k| values[k]);
        for (x, want) in got.iter().zip(&want) {
            assert!((x - want).abs() <= 1e-8, "{n}: {got:?} {want:?}, column {idle}, row {superfluous}");
        }
    }
}

/// A slope that is infinite is in no solution.
#[test]
fn what_is_infinite_shows() {
    let mut rng = Rng::new(12);
    for round in 0..300 {
        let n = 1 + round % 6;
        let entries = random(&mut rng, n, [0.4, 0.7, 1.0][round % 3]);
        let moving = entries.iter().flatten().filter(|e| **e == Entry::Moving).count();
        if moving == 0 {
            continue;
        }
        let at = n + rng.below(moving);
        let values: Vec<f64> = (0..n + n * n).map(|_| 2.0 * rng.real(0.0, 1.0) - 1.0).collect();
        for bad in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            let (got, matrix, _) = solved(&entries, &|k| if k == at { bad } else { values[k] });
            assert!(got.iter().any(|x| !x.is_finite()), "{n}, {bad}: {got:?} {matrix:?}");
        }
    }
}

/// Literals of which cancellation has left few digits are no pivots beside others, and no quotients.
#[test]
fn literals_without_digits_are_no_pivots() {
    let mut g = Graph::new();
    let (half, one, three) = (g.decimal(0.5), g.decimal(1.0), g.integer(3));
    // What 31 digits leave of an irrational number.
    let mut blurred = g.sqrt(three);
    let near = g.literal(blurred).expect("a literal").value();
    let near = g.decimal(near);
    blurred = g.sub(blurred, near);
    assert!(!g.literal(blurred).expect("a literal").is_sharp(), "it is to be blurred");
    let side = [g.symbol(), g.symbol()];
    let symbols = |id: SymbolId| [1.0, 2.0][id.0];
    let factors = SparseFactors::of(&mut g, 2, &[blurred, one, half, one], Purpose::Solutions);
    let unknowns = factors.solve(&mut g, &side);
    let got = Evaluator::new(&g, Real { symbols: &symbols }).run(&unknowns);
    assert!((got[0] - 2.0).abs() < 1e-15 && (got[1] - 1.0).abs() < 1e-15, "{got:?}");
    let factors = SparseFactors::of(&mut g, 1, &[blurred], Purpose::Solutions);
    let unknowns = factors.solve(&mut g, &side[..1]);
    let got = Evaluator::new(&g, Real { symbols: &symbols }).run(&unknowns);
    assert!(got[0].is_nan(), "{got:?}");
}

/// What would be too large to be written out is left to the runtime, whatever else is there; what has zeros is not.
#[test]
fn dense_systems_are_solved_by_the_runtime() {
    for (size, dense, written) in
        [(6, true, true), (12, true, true), (32, true, false), (60, true, false), (60, false, true)]
    {
        let mut g = Graph::new();
        let filled = |at: usize| dense || (at / size).abs_diff(at % size) <= 1;
        let matrix: Vec<Scalar> =
            (0..size * size).map(|at| if filled(at) { g.symbol() } else { Scalar::ZERO }).collect();
        let mut roots = Vec::new();
        for _ in 0..2 {
            let side: Vec<Scalar> = (0..size).map(|_| g.symbol()).collect();
            let operands: Vec<Scalar> = matrix.iter().chain(&side).copied().collect();
            roots.extend(g.block_outputs(BlockKind::Eliminate { size, strict: false }, &operands));
        }
        let mut lowering = Lowering::new(&g);
        let lowered = lowering.run(&roots);
        assert_eq!(lowered.len(), 2 * size);
        assert!(lowering.to.len() < 40_000, "{size}: {}", lowering.to.len());
        let is_block = |&root: &Scalar| matches!(lowering.to.node(root), ScalarNode::Output(..));
        assert!(lowered.iter().all(|root| is_block(root) != written), "{size}");
        if size > 12 && dense {
            continue;
        }
        let mut rng = Rng::new(13);
        let values: Vec<f64> = (0..size * size + 2 * size).map(|_| rng.real(-1.0, 1.0)).collect();
        let symbols = |id: SymbolId| values[id.0];
        let numbers = |g: &Graph, list: &[Scalar]| Evaluator::new(g, Real { symbols: &symbols }).run(list);
        for (x, y) in numbers(&lowering.to, &lowered).iter().zip(numbers(&g, &roots)) {
            assert!((x - y).abs() <= 1e-8 * (1.0 + y.abs()), "{size}: {x} {y}");
        }
    }
}

/// Derivatives of solutions by every entry, along it and back from the unknowns, by the transposed system: in any units those that
/// differences of the pivoted solve give in units of one.
#[test]
fn derivatives_in_any_units() {
    let mut rng = Rng::new(14);
    for _ in 0..60 {
        let n = 3;
        let mut g = Graph::new();
        let entries: Vec<Scalar> = (0..n * n).map(|_| g.symbol()).collect();
        let side: Vec<Scalar> = (0..n).map(|_| g.symbol()).collect();
        let weights: Vec<Scalar> = (0..n).map(|_| g.symbol()).collect();
        let operands: Vec<Scalar> = entries.iter().chain(&side).copied().collect();
        let unknowns = g.block_outputs(BlockKind::Eliminate { size: n, strict: false }, &operands);
        let weighted: Vec<(Scalar, Scalar)> = unknowns.iter().copied().zip(weights.iter().copied()).collect();
        let mut roots = g.transpose_vectors(&weighted, &[], &entries);
        let terms: Vec<Scalar> = weighted.iter().map(|&(x, w)| g.mul(x, w)).collect();
        let sum = g.sum(&terms);
        roots.extend(entries.iter().map(|&entry| g.derivative(sum, &[(entry, Scalar::ONE)])).collect::<Vec<_>>());
        let mut lowering = Lowering::new(&g);
        let lowered = lowering.run(&roots);

        let plain: Vec<f64> = (0..n * n + 2 * n).map(|_| rng.real(-1.0, 1.0)).collect();
        let of = |entries: &[f64]| -> f64 {
            let x = solve_f64(entries, &plain[n * n..n * n + n]);
            x.iter().zip(&plain[n * n + n..]).map(|(x, w)| x * w).sum()
        };
        let found = solve_f64(&plain[..n * n], &plain[n * n..n * n + n]);
        let size = found[..n].iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        if found[n] < n as f64 || size > 10.0 {
            continue;
        }
        let slope = |at: usize| {
            let moved = |step: f64| {
                let mut entries = plain[..n * n].to_vec();
                entries[at] += step;
                of(&entries)
            };
            (moved(1e-6) - moved(-1e-6)) / 2e-6
        };
        let mut unit = || -> Vec<f64> { (0..n).map(|_| rng.real(-30.0, 30.0).round().exp2()).collect() };
        let (rows, columns) = (unit(), unit());
        let value = |at: usize| match at {
            at if at < n * n => plain[at] * rows[at / n] * columns[at % n],
            at if at < n * n + n => plain[at] * rows[at - n * n],
            at => plain[at] * columns[at - n * n - n],
        };
        let symbols = |id: SymbolId| value(id.0);
        let got = Evaluator::new(&lowering.to, Real { symbols: &symbols }).run(&lowered);
        for (k, x) in got.iter().enumerate() {
            let at = k % (n * n);
            let (x, want) = (x * rows[at / n] * columns[at % n], slope(at));
            assert!((x - want).abs() <= 1e-5 * size * size * (1.0 + want.abs()), "{k}: {x} {want}");
        }
    }
}

/// The factors of a matrix solve the transposed system too, and their pivots tell whether it is regular.
#[test]
fn transposed_systems_and_ranks() {
    let mut rng = Rng::new(13);
    let mut regular = 0;
    for round in 0..600 {
        let n = 2 + round % 8;
        let entries = random(&mut rng, n, [0.4, 0.7, 1.0][round % 3]);
        let mut g = Graph::new();
        let side: Vec<Scalar> = (0..n).map(|_| g.symbol()).collect();
        let matrix: Vec<Scalar> = entries
            .iter()
            .flatten()
            .map(|entry| match *entry {
                Entry::Zero => Scalar::ZERO,
                Entry::Literal(x) => g.decimal(x),
                Entry::Moving => g.symbol(),
            })
            .collect();
        let factors = SparseFactors::of(&mut g, n, &matrix, Purpose::Rank);
        let mut roots = factors.solve_transposed(&mut g, &side);
        roots.push(factors.rank(&mut g));
        let values: Vec<f64> = (0..n + n * n).map(|_| 2.0 * rng.real(0.0, 1.0) - 1.0).collect();
        let symbols = |id: SymbolId| values[id.0];
        let numbers = |list: &[Scalar]| Evaluator::new(&g, Real { symbols: &symbols }).run(list);
        let (got, matrix, side) = (numbers(&roots), numbers(&matrix), numbers(&side));
        let transposed: Vec<f64> = (0..n * n).map(|at| matrix[at % n * n + at / n]).collect();
        let want = solve_f64(&transposed, &side);
        let size = want.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        if want[n] == n as f64 && size < 1e4 {
            regular += 1;
            assert_eq!(got[n], n as f64, "{matrix:?}");
            for (x, want) in got.iter().zip(&want[..n]) {
                assert!((x - want).abs() <= 1e-11 * size * size, "{got:?} {want:?}");
            }
        }
    }
    assert!(regular > 300, "{regular}");
}

/// Rows and columns that depend on others at run time but for rounding: no rank is full as a rule, however many entries are zero.
#[test]
fn what_depends_on_others_has_no_full_rank() {
    let mut rng = Rng::new(14);
    let (mut full_ranks, mut short) = (0, 0);
    for round in 0..1200 {
        let n = 3 + round % 12;
        let full = [0.5, 1.0][round % 2];
        let mut rows: Vec<Vec<f64>> = (0..n)
            .map(|_| (0..n).map(|_| if rng.real(0.0, 1.0) < full { rng.real(-1.0, 1.0) } else { 0.0 }).collect())
            .collect();
        let (a, b, c) = (round % n, (round + 1) % n, (round + 2) % n);
        let shares = [rng.real(-1.0, 1.0), rng.real(-1.0, 1.0)];
        if round % 4 < 2 {
            rows[a] = (0..n).map(|k| shares[0] * rows[b][k] + shares[1] * rows[c][k]).collect();
        } else {
            rows.iter_mut().for_each(|row| row[a] = shares[0] * row[b] + shares[1] * row[c]);
        }
        let mut g = Graph::new();
        let mut values = Vec::new();
        let matrix: Vec<Scalar> = rows
            .iter()
            .flatten()
            .map(|&x| {
                if x == 0.0 {
                    return Scalar::ZERO;
                }
                values.push(x);
                g.symbol()
            })
            .collect();
        let rank = SparseFactors::of(&mut g, n, &matrix, Purpose::Rank).rank(&mut g);
        let symbols = |id: SymbolId| values[id.0];
        let rank = Evaluator::new(&g, Real { symbols: &symbols }).run(&[rank])[0];
        full_ranks += usize::from(rank == n as f64);
        short += usize::from(rank < (n - 1) as f64);
    }
    println!("{full_ranks} full, {short} below one less, of 1200");
    // Pivots of few digits multiply rounding in ways that no noise tells.
    assert!(full_ranks <= 6 && short <= 120, "{full_ranks} {short}");
}

/// An entry that is rounding as it is given, a cosine of a right angle, says nothing of a rank, and NaN has none.
#[test]
fn entries_of_rounding_are_in_no_rank() {
    for entry in [(std::f64::consts::FRAC_PI_2).cos(), 0.0, f64::NAN] {
        let mut g = Graph::new();
        let cosine = g.symbol();
        let (zero, one) = (Scalar::ZERO, Scalar::ONE);
        let matrix = [one, zero, zero, one, cosine, zero, zero, one, one];
        for transposed in [false, true] {
            let at = |k: usize| matrix[if transposed { k % 3 * 3 + k / 3 } else { k }];
            let matrix: Vec<Scalar> = (0..9).map(at).collect();
            let rank = SparseFactors::of(&mut g, 3, &matrix, Purpose::Rank).rank(&mut g);
            let rank = Evaluator::new(&g, Real { symbols: &|_| entry }).run(&[rank])[0];
            assert!(rank < 3.0, "{entry}: {rank}");
        }
    }
}
