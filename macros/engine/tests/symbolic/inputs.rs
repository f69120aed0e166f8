//! Linear systems that are written out: pivoted ones at matrices that need exchanges or have no full rank, and systems
//! for inputs, whose constant rows are to be found.

use crate::rng::Rng;
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Graph, Scalar, SymbolId};
use multibody_engine::symbolic::inputs::{Found, Known, solve_inputs};
use multibody_engine::symbolic::pivoted::solve_pivoted;

fn symbols(g: &mut Graph, n: usize) -> Vec<Scalar> {
    (0..n).map(|_| g.symbol()).collect()
}

fn evaluate(g: &Graph, roots: &[Scalar], point: &[f64]) -> Vec<f64> {
    let symbols = |id: SymbolId| point[id.0];
    Evaluator::new(g, Real { symbols: &symbols }).run(roots)
}

fn square(list: &[Scalar], n: usize) -> Vec<Vec<Scalar>> {
    list.chunks(n).map(<[Scalar]>::to_vec).collect()
}

/// Largest entry of A x - b.
fn residual(a: &[f64], x: &[f64], b: &[f64]) -> f64 {
    let n = b.len();
    let row = |i: usize| (0..n).map(|j| a[i * n + j] * x[j]).sum::<f64>() - b[i];
    (0..n).map(|i| row(i).abs()).fold(0.0, f64::max)
}

/// A pivoted system of symbols: matrix, then side. Results: solution, rank.
fn pivoted(n: usize) -> (Graph, Vec<Scalar>) {
    let mut g = Graph::new();
    let (a, b) = (symbols(&mut g, n * n), symbols(&mut g, n));
    let (mut x, rank) = solve_pivoted(&mut g, &square(&a, n), &[b]);
    let mut roots = x.pop().unwrap();
    roots.push(rank);
    (g, roots)
}

#[test]
fn random_matrices_of_full_rank() {
    let mut rng = Rng::new(7);
    for n in 1..=6 {
        let (g, roots) = pivoted(n);
        for _ in 0..200 {
            let mut point: Vec<f64> = (0..n * n + n).map(|_| rng.real(-1.0, 1.0)).collect();
            // Zeros where elimination without exchanges would divide.
            point[0] = if n > 1 { 0.0 } else { 1.0 };
            let got = evaluate(&g, &roots, &point);
            let size = got[..n].iter().fold(1.0_f64, |m, x| m.max(x.abs()));
            assert!(residual(&point[..n * n], &got[..n], &point[n * n..]) < 1e-13 * size, "{point:?}");
            assert_eq!(got[n], n as f64);
        }
    }
}

#[test]
fn rank_is_lost_where_rows_repeat() {
    let mut rng = Rng::new(11);
    let n = 5;
    let (g, roots) = pivoted(n);
    for rank in 0..n {
        let mut a = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..n {
                // Rows beyond the rank are the first one again, or nothing.
                a[i * n + j] = if i < rank {
                    rng.real(-1.0, 1.0)
                } else if rank > 0 {
                    -3.0 * a[j]
                } else {
                    0.0
                };
            }
        }
        let x: Vec<f64> = (0..n).map(|_| rng.real(0.0, 1.0)).collect();
        let b: Vec<f64> = (0..n).map(|i| (0..n).map(|j| a[i * n + j] * x[j]).sum()).collect();
        let got = evaluate(&g, &roots, &[a.clone(), b.clone()].concat());
        assert_eq!(got[n], rank as f64);
        assert!(got.iter().all(|x| x.is_finite()));
    }
}

#[test]
fn nan_shows() {
    let (g, roots) = pivoted(3);
    for at in 0..9 {
        let mut point = vec![1.0, 2.0, 3.0, 0.5, 4.0, 1.0, 2.0, 1.0, 5.0, 1.0, 1.0, 1.0];
        point[at] = f64::NAN;
        assert!(evaluate(&g, &roots, &point)[..3].iter().any(|x| x.is_nan()), "entry {at}");
    }
}

/// A system, and what the caller knows: symbols from `parameters` on are parameters, those in `nonzero` don't vanish.
fn inputs(g: &mut Graph, a: &[Vec<Scalar>], b: &[Scalar], parameters: usize, nonzero: &[Scalar]) -> Found {
    let nonzero = |g: &Graph, s: Scalar| nonzero.contains(&s) || g.literal(s).is_some_and(|n| !n.is_zero());
    solve_inputs(g, &Known { parameter: &|id| id.0 >= parameters, nonzero: &nonzero }, a, b)
}

/// The solution at a point satisfies the system there; the rank.
fn check(g: &Graph, a: &[Vec<Scalar>], b: &[Scalar], found: &Found, point: &[f64]) -> f64 {
    let n = b.len();
    let values = evaluate(g, &[a.concat(), b.to_vec()].concat(), point);
    let mut roots = found.unknowns.clone();
    roots.push(found.rank);
    let got = evaluate(g, &roots, point);
    let size = got[..n].iter().fold(1.0_f64, |m, x| m.max(x.abs()));
    assert!(residual(&values[..n * n], &got[..n], &values[n * n..]) < 1e-12 * size, "{got:?}");
    got[n]
}

/// Three lines of force that rise by the same z: (x + k, z; r z) and the like.
#[test]
fn rows_with_a_common_factor() {
    for assumed in [false, true] {
        let mut g = Graph::new();
        let list = symbols(&mut g, 5);
        let (x, z) = (list[0], list[1]);
        let mut a = vec![Vec::new(); 3];
        for (k, r) in [(1.5, 0.3), (-0.5, -1.1), (0.25, 2.0)] {
            let (k, r) = (g.decimal(k), g.decimal(r));
            a[0].push(g.add(x, k));
            a[1].push(z);
            a[2].push(g.mul(r, z));
        }
        let side = &list[2..];
        let nonzero = if assumed { vec![z] } else { Vec::new() };
        let found = inputs(&mut g, &a, side, usize::MAX, &nonzero);
        assert_eq!(found.constant, 3);
        assert_eq!(check(&g, &a, side, &found, &[0.7, -1.3, 1.0, 2.0, 3.0]), 3.0);
        if !assumed {
            // Where they don't rise two rows are gone.
            let roots = [&found.unknowns[..], &[found.rank]].concat();
            let got = evaluate(&g, &roots, &[0.7, 0.0, 1.0, 0.0, 0.0]);
            assert!(got.iter().all(|x| x.is_finite()));
            assert_eq!(got[3], 1.0);
        }
    }
}

/// Entries of one row may be divided by: another that is proportional to it becomes constant with it.
#[test]
fn columns_are_scaled() {
    let mut g = Graph::new();
    let list = symbols(&mut g, 9);
    let (heights, others, side) = (&list[..3], &list[3..6], &list[6..]);
    let factors = [0.5, -2.0, 3.0].map(|c| g.decimal(c));
    let second: Vec<Scalar> = (0..3).map(|k| g.mul(factors[k], heights[k])).collect();
    let a = [others.to_vec(), heights.to_vec(), second];
    let point = [1.1, 0.4, 0.9, -0.3, 0.8, 2.2, 1.0, -1.0, 0.5];
    let free = inputs(&mut g, &a, side, usize::MAX, &[]);
    assert_eq!(free.constant, 0);
    assert_eq!(check(&g, &a, side, &free, &point), 3.0);
    let scaled = inputs(&mut g, &a, side, usize::MAX, heights);
    assert_eq!(scaled.constant, 2);
    assert_eq!(check(&g, &a, side, &scaled, &point), 3.0);
}

/// What parameters alone decide is inverted before run time, also where a pivot happens to be zero.
#[test]
fn parameters_are_inverted() {
    let mut g = Graph::new();
    let list = symbols(&mut g, 4 + 8);
    let (x, z, side) = (list[0], list[1], &list[2..4]);
    let (p, q) = (&list[4..6], &list[6..8]);
    // Rows z p and x p + q.
    let first: Vec<Scalar> = p.iter().map(|&p| g.mul(z, p)).collect();
    let second = (0..2).map(|k| {
        let carried = g.mul(x, p[k]);
        g.add(carried, q[k])
    });
    let a = [first, second.collect()];
    let found = inputs(&mut g, &a, side, 4, &[]);
    assert_eq!(found.constant, 2);
    for p in [[1.0, 2.0], [0.0, 2.0], [1.0, 0.0]] {
        let point = [0.3, 1.7, 1.0, -2.0, p[0], p[1], 0.6, 0.9, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(check(&g, &a, side, &found, &point), 2.0);
    }
}

/// Rows that depend on each other by structure are left to run time, and reported there.
#[test]
fn dependent_rows_lose_rank() {
    let mut g = Graph::new();
    let list = symbols(&mut g, 2);
    let ones = vec![Scalar::ONE; 2];
    let two = g.integer(2);
    let a = [ones, vec![two; 2]];
    let found = inputs(&mut g, &a, &list, usize::MAX, &[]);
    let roots = [&found.unknowns[..], &[found.rank]].concat();
    let got = evaluate(&g, &roots, &[1.0, 2.0]);
    assert_eq!(got[2], 1.0);
    assert!((got[0] + got[1] - 1.0).abs() < 1e-15);
}

/// More inputs than rows have no solution here.
#[test]
fn systems_that_are_not_square() {
    let mut g = Graph::new();
    let list = symbols(&mut g, 8);
    let a: Vec<Vec<Scalar>> = list[..6].chunks(3).map(<[Scalar]>::to_vec).collect();
    let found = inputs(&mut g, &a, &list[6..], usize::MAX, &[]);
    assert_eq!((found.rank, found.constant), (Scalar::ZERO, 0));
}

/// One row of parameters, and one that moves.
#[test]
fn a_row_of_parameters() {
    let mut g = Graph::new();
    let list = symbols(&mut g, 6);
    let a = vec![list[4..].to_vec(), list[..2].to_vec()];
    let found = inputs(&mut g, &a, &list[2..4], 4, &list[4..]);
    assert_eq!(check(&g, &a, &list[2..4], &found, &[0.7, -1.3, 1.0, 2.0, 0.4, 0.9]), 2.0);
}
