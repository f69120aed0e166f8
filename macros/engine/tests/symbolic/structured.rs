//! Square systems solved by the structure of their matrix, against one pivoted solve of the whole: solutions, ranks where
//! entries vanish at run time, and what is left to the runtime at all.

use crate::rng::Rng;
use multibody_engine::symbolic::evaluate::{Evaluator, Real, solve_f64};
use multibody_engine::symbolic::graph::{BlockId, BlockKind, Graph, Scalar, ScalarNode, SymbolId};
use multibody_engine::symbolic::structured::solve_structured;

/// An entry of a matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Entry {
    Zero,
    Literal(f64),
    /// Symbols, each its own.
    Parameter,
    Moving,
}
use Entry::{Literal, Moving, Parameter, Zero};

struct System {
    g: Graph,
    /// The unknowns, then the rank.
    roots: Vec<Scalar>,
    /// By row: the symbol of each entry that is one.
    symbols: Vec<Vec<Option<usize>>>,
    entries: Vec<Vec<Entry>>,
}

impl System {
    /// Right sides are the first symbols.
    fn new(entries: &[Vec<Entry>]) -> System {
        let (mut g, n) = (Graph::new(), entries.len());
        let side: Vec<Scalar> = (0..n).map(|_| g.symbol()).collect();
        let mut parameters = Vec::new();
        let mut matrix = Vec::new();
        for row in entries {
            let entry = |entry: &Entry| match *entry {
                Zero => Scalar::ZERO,
                Literal(x) => g.decimal(x),
                Parameter => {
                    let symbol = g.symbol();
                    parameters.extend(g.symbol_id(symbol));
                    symbol
                }
                Moving => g.symbol(),
            };
            matrix.push(row.iter().map(entry).collect::<Vec<_>>());
        }
        let (mut roots, rank) = solve_structured(&mut g, &|id| parameters.contains(&id), &matrix, &side);
        roots.push(rank);
        let symbol = |s: &Scalar| g.symbol_id(*s).map(|id| id.0);
        let symbols = matrix.iter().map(|row| row.iter().map(symbol).collect()).collect();
        System { g, roots, symbols, entries: entries.to_vec() }
    }

    /// Values of the matrix by rows: what is no symbol as it is.
    fn values(&self, mut value: impl FnMut() -> f64) -> Vec<f64> {
        let entry = |entry: &Entry| match *entry {
            Zero => 0.0,
            Literal(x) => x,
            Parameter | Moving => value(),
        };
        self.entries.iter().flatten().map(entry).collect()
    }

    /// Unknowns and rank at these values.
    fn at(&self, matrix: &[f64], side: &[f64]) -> Vec<f64> {
        let mut point = side.to_vec();
        for (symbol, &value) in self.symbols.iter().flatten().zip(matrix) {
            if let Some(at) = *symbol {
                point.resize(point.len().max(at + 1), 0.0);
                point[at] = value;
            }
        }
        let symbols = |id: SymbolId| point[id.0];
        Evaluator::new(&self.g, Real { symbols: &symbols }).run(&self.roots)
    }

    /// Sizes of the systems that are left to pivots; whether each reads moving symbols, right sides among them.
    fn solves(&self) -> Vec<(usize, bool)> {
        let mut seen: Vec<BlockId> = Vec::new();
        for index in self.g.reachable_scalars(&self.roots) {
            if let ScalarNode::Output(id, _) = self.g.node(self.g.scalar_at(index)) {
                seen.extend((!seen.contains(id)).then_some(*id));
            }
        }
        let moving: Vec<usize> = (0..self.entries.len())
            .chain(
                self.entries
                    .iter()
                    .flatten()
                    .zip(self.symbols.iter().flatten())
                    .filter_map(|(entry, symbol)| symbol.filter(|_| *entry == Moving)),
            )
            .collect();
        let moving: Vec<Scalar> = moving.into_iter().filter_map(|at| self.g.symbol_handle(SymbolId(at))).collect();
        let list = seen.into_iter().map(|id| {
            let block = self.g.block(id);
            let BlockKind::Solve { size, .. } = block.kind else { panic!("an iteration") };
            (size, block.operands.iter().any(|&s| self.g.depends_on(s, &moving)))
        });
        list.collect()
    }

    /// The same answer as one pivoted solve: rank, a solution where there is one, and the same where there is one alone.
    fn agrees(&self, matrix: &[f64], x: &[f64]) {
        let n = x.len();
        let side: Vec<f64> = matrix.chunks(n).map(|row| row.iter().zip(x).map(|(a, x)| a * x).sum()).collect();
        let (got, whole) = (self.at(matrix, &side), solve_f64(matrix, &side));
        let said = format!("{:?} at {matrix:?}", self.entries);
        assert_eq!(got[n], whole[n], "rank of {said}");
        let size = got[..n].iter().chain(x).fold(1.0_f64, |most, x| most.max(x.abs()));
        for (row, side) in matrix.chunks(n).zip(&side) {
            let left = row.iter().zip(&got).map(|(a, x)| a * x).sum::<f64>() - side;
            assert!(left.abs() < 1e-11 * size, "{left:e} is left of {said}");
        }
    }
}

fn rows<const N: usize>(list: [[Entry; N]; N]) -> Vec<Vec<Entry>> {
    list.iter().map(|row| row.to_vec()).collect()
}

const fn integer(n: i32) -> Entry {
    Literal(n as f64)
}
const ONE: Entry = integer(1);

/// Patterns of every kind, with entries that vanish at run time.
#[test]
fn ranks_and_solutions_are_those_of_the_whole() {
    let mut rng = Rng::new(1_814);
    let (mut lost, mut peeled) = (0, 0);
    for case in 0..1_500 {
        let n = 1 + rng.below(6);
        // Triangular or not, sparse or full, rows and columns in any order.
        let (triangular, density, literals) = (rng.chance(60), 15 + rng.below(60), 20 + rng.below(60));
        let mut entries = vec![vec![Zero; n]; n];
        let mut order: Vec<usize> = (0..n).collect();
        (1..n).rev().for_each(|k| order.swap(k, rng.below(k + 1)));
        for (i, &row) in order.iter().enumerate() {
            for (j, entry) in entries[row].iter_mut().enumerate() {
                if i != j && (!rng.chance(density) || triangular && j > i) {
                    continue;
                }
                let value = (1 + rng.below(6)) as f64 * if rng.chance(50) { 0.5 } else { -0.25 };
                let moving = if rng.chance(50) { Moving } else { Parameter };
                *entry = if rng.chance(literals) { Literal(value) } else { moving };
            }
        }
        let system = System::new(&entries);
        peeled += usize::from(!system.solves().iter().any(|solve| solve.0 == n));
        for round in 0..6 {
            let zeros = [0, 0, 20, 40, 60, 90][round];
            let matrix =
                system.values(|| if rng.chance(zeros) { 0.0 } else { rng.real(0.3, 2.0) * [1.0, -1.0][rng.below(2)] });
            let x: Vec<f64> = (0..n).map(|_| rng.real(-1.0, 1.0)).collect();
            // Values that happen to make it nearly singular have no rank to speak of.
            let sure = [1e-9, 1e-13].map(|shift| {
                let shifted: Vec<f64> = matrix.iter().map(|x| x * (1.0 + shift * rng.real(-1.0, 1.0))).collect();
                solve_f64(&shifted, &vec![0.0; n])[n]
            });
            if sure[0] != sure[1] || sure[0] != solve_f64(&matrix, &vec![0.0; n])[n] {
                continue;
            }
            lost += usize::from(sure[0] < n as f64);
            system.agrees(&matrix, &x);
        }
        assert_eq!(system.entries.len(), n, "{case}");
    }
    assert!(lost > 1_000 && peeled > 500, "{lost} {peeled}");
}

/// What stands in which form: systems left to pivots, and whether they are solved at each call.
#[test]
fn what_is_left_to_the_runtime() {
    let (two, minus) = (integer(2), integer(-1));
    /// Sizes of systems, and whether they are solved at each call.
    type Solves = Vec<(usize, bool)>;
    let cases: Vec<(&str, Vec<Vec<Entry>>, Solves)> = vec![
        ("a motor on each joint", rows([[ONE, Zero, Zero], [Zero, minus, Zero], [Zero, Zero, two]]), vec![]),
        ("in another order", rows([[Zero, ONE, Zero], [Zero, Zero, minus], [two, Zero, Zero]]), vec![]),
        ("belts of constant ratio", rows([[ONE, two, minus], [Zero, ONE, two], [Zero, Zero, ONE]]), vec![]),
        ("motors in a column of joints", rows([[ONE, minus, Zero], [Zero, ONE, minus], [Zero, Zero, ONE]]), vec![]),
        ("a differential", rows([[ONE, ONE, Zero], [ONE, minus, Zero], [Zero, Zero, two]]), vec![]),
        ("gears", rows([[Parameter, Zero], [Zero, Parameter]]), vec![(1, false); 2]),
        ("gears and a belt", rows([[Parameter, ONE], [Zero, ONE]]), vec![(1, false)]),
        ("a belt of any ratio", rows([[Parameter, Parameter], [Zero, Parameter]]), vec![(2, false); 2]),
        ("a differential of any ratio", rows([[Parameter, Parameter], [Parameter, Parameter]]), vec![(2, false); 2]),
        ("levers that move", rows([[Moving, Zero], [Zero, Moving]]), vec![(1, true); 2]),
        ("what couples literals", rows([[ONE, Zero, Zero], [Moving, two, Zero], [Moving, Parameter, ONE]]), vec![]),
        (
            "a motor beside a loop",
            rows([[ONE, Moving, Moving], [Zero, Moving, Moving], [Zero, Moving, Moving]]),
            vec![(2, true)],
        ),
        (
            "a loop on a motor",
            rows([[ONE, Zero, Zero], [Moving, Moving, Moving], [Zero, Moving, Moving]]),
            vec![(2, true)],
        ),
        ("between two that move", rows([[Moving, Zero, Zero], [ONE, ONE, Zero], [ONE, ONE, Moving]]), vec![(3, true)]),
        ("singular", rows([[ONE, ONE], [ONE, ONE]]), vec![(2, true)]),
        (
            "singular beside a regular one",
            rows([[ONE, ONE, Zero], [ONE, ONE, Zero], [Zero, Zero, two]]),
            vec![(2, true)],
        ),
        ("nearly singular", rows([[ONE, ONE], [ONE, Literal(1.000_001)]]), vec![(2, true)]),
        ("smaller than any number in single precision", rows([[Literal(1e-39)]]), vec![(1, true)]),
        ("small, alone", rows([[Literal(1e-20), Zero], [Zero, ONE]]), vec![]),
        (
            "small beside both sides",
            rows([[ONE, Zero, Zero], [ONE, Literal(1e-20), Zero], [ONE, ONE, ONE]]),
            vec![(3, true)],
        ),
        ("without a place for a pivot", rows([[Moving, Zero], [ONE, Zero]]), vec![(2, true)]),
    ];
    let mut rng = Rng::new(14);
    for (name, entries, mut expected) in cases {
        let system = System::new(&entries);
        let mut solves = system.solves();
        solves.sort_unstable();
        expected.sort_unstable();
        assert_eq!(solves, expected, "{name}");
        for _ in 0..20 {
            let matrix = system.values(|| rng.real(0.5, 2.0) * [1.0, -1.0][rng.below(2)]);
            let x: Vec<f64> = entries.iter().map(|_| rng.real(-1.0, 1.0)).collect();
            if name == "smaller than any number in single precision" {
                // The evaluator has one threshold, the runtime another.
                continue;
            }
            system.agrees(&matrix, &x);
        }
    }
}

/// Units apart by what people use: forces in N beside torques in kN m or in uN m, lengths in mm.
#[test]
fn units_change_no_rank() {
    let mut rng = Rng::new(5);
    let patterns = [
        rows([[ONE, Moving, Moving], [Zero, Moving, Moving], [Zero, Moving, Moving]]),
        rows([[Moving, Zero, Zero], [Moving, Parameter, Zero], [Zero, Zero, Moving]]),
        rows([[Parameter, Parameter, Moving], [Parameter, Parameter, Zero], [Zero, Zero, integer(3)]]),
    ];
    for pattern in patterns {
        let system = System::new(&pattern);
        for _ in 0..200 {
            let scales = [(); 6].map(|()| 10.0_f64.powi(rng.below(13) as i32 - 6));
            let mut matrix = system.values(|| rng.real(0.3, 2.0));
            let rotten = rng.chance(50);
            for i in 0..3 {
                for j in 0..3 {
                    if matches!(pattern[i][j], Parameter | Moving) {
                        matrix[3 * i + j] *= scales[i] * scales[3 + j];
                    }
                }
            }
            if rotten {
                // The last row that holds more than one symbol repeats another in them.
                let last = (0..3).rev().find(|&i| pattern[i][1..].iter().filter(|e| **e == Moving).count() == 2);
                if let Some(last) = last {
                    (1..3).for_each(|j| matrix[3 * last + j] = -3.0 * matrix[3 * (last - 1) + j]);
                }
            }
            let (got, whole) = (system.at(&matrix, &[1.0; 3]), solve_f64(&matrix, &[1.0; 3]));
            assert_eq!(got[3], whole[3], "{pattern:?} {matrix:?}");
        }
    }
}

/// What is no number shows.
#[test]
fn numbers_that_are_none_show() {
    let system = System::new(&rows([[ONE, Zero, Zero], [Moving, ONE, Zero], [Zero, Zero, Moving]]));
    let fine = [1.0, 0.0, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0, 2.0];
    assert_eq!(system.at(&fine, &[1.0, 2.0, 3.0]), [1.0, 1.5, 1.5, 3.0]);
    let mut coupled = fine;
    coupled[3] = f64::NAN;
    assert!(system.at(&coupled, &[1.0, 2.0, 3.0])[1].is_nan());
    assert!(system.at(&fine, &[1.0, f64::NAN, 3.0])[1].is_nan());
}
