//! Systems eliminated in the order of their pattern, against the pivoted solve of the whole, and what they cost.

use crate::rng::Rng;
use multibody_engine::symbolic::elimination::Elimination;
use multibody_engine::symbolic::evaluate::{Evaluator, Real, solve_f64};
use multibody_engine::symbolic::graph::{BlockKind, Graph, Scalar, SymbolId};
use multibody_engine::symbolic::lower::Lowering;

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
    let elimination = Elimination::of(&mut g, n, &matrix);
    let unknowns = elimination.solve(&mut g, &side);
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
            roots.extend(g.block_outputs(BlockKind::Eliminate { size: n }, &operands));
        }
        let mut lowering = Lowering::new(&g);
        let roots = lowering.run(&roots);
        let cost = lowering.to.cost(&roots);
        cost.add + cost.mul + cost.div + cost.compare + cost.other
    };
    let (one, two) = (count(1), count(2));
    println!("{one} operations, {two} for two sides");
    // The pivoted solve of the runtime takes 25,000.
    assert!(one < 2_000 && 3 * (two - one) < one, "{one} {two}");
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
        let roots = g.block_outputs(BlockKind::Eliminate { size }, &operands);
        let mut lowering = Lowering::new(&g);
        let lowered = lowering.run(&roots);
        let cost = lowering.to.cost(&lowered);
        // Guards of the pivots and of a normal's length, and the last two rows of the second, which do compete.
        assert!(cost.compare + cost.other <= [2, 17][size - 3], "{cost:?}");
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
