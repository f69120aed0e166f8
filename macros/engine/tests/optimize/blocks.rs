//! Linear systems and iterations through all passes, to programs and to Rust.

use crate::expressions::{Expression, SYMBOLS};
use crate::interpreter;
use crate::rebuild::rebuild;
use crate::rng::Rng;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::results::Results;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::{Derivation, Derived};
use multibody_engine::model::types::{InputId, JointId, ParamId};
use multibody_engine::optimize::dag::Dag;
use multibody_engine::optimize::program::{Compiled, Statement};
use multibody_engine::optimize::{compile, simplify};
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{BlockKind, Graph, Scalar, ScalarNode, SymbolId};
use multibody_engine::symbolic::identity::{Verdict, identical};
use multibody_engine::symbolic::lower::Lowering;

/// Symbols of all stages, then unknowns.
fn symbols(g: &Graph, count: usize) -> Vec<Symbol> {
    let known = [
        Symbol::Param { param: ParamId(0), element: 0 },
        Symbol::Param { param: ParamId(1), element: 0 },
        Symbol::Time,
        Symbol::Position { joint: JointId(0), component: 0 },
        Symbol::Input { input: InputId(0), element: 0 },
    ];
    assert!(g.symbol_handle(SymbolId(count)).is_none());
    (0..count).map(|k| known.get(k).copied().unwrap_or(Symbol::Unknown { index: k.saturating_sub(SYMBOLS) })).collect()
}

/// A random expression, kept small: x / (1 + x^2).
fn tame(g: &mut Graph, rng: &mut Rng, symbols: &[Scalar; SYMBOLS]) -> Scalar {
    let x = Expression::random(rng, 3).make(g, symbols);
    let square = g.mul(x, x);
    let below = g.add(square, Scalar::ONE);
    g.div(x, below)
}

/// A system with a strong diagonal over these symbols.
fn solve(g: &mut Graph, rng: &mut Rng, size: usize, symbols: &[Scalar; SYMBOLS]) -> Vec<Scalar> {
    let mut operands = Vec::new();
    for at in 0..size * size + size {
        let entry = match rng.below(3) {
            0 => Scalar::ZERO,
            _ => tame(g, rng, symbols),
        };
        let large = g.integer(4);
        let diagonal = at < size * size && at % (size + 1) == 0;
        let right = at >= size * size;
        operands.push(match (diagonal, right) {
            (true, _) => g.add(entry, large),
            // Solutions that are zero stand in denominators elsewhere.
            (_, true) => g.add(entry, symbols[at % SYMBOLS]),
            _ => entry,
        });
    }
    let outputs = g.block_outputs(BlockKind::Solve { size, symmetric: false, groups: [].into() }, &operands);
    g.name(outputs[0], || "found".into());
    outputs
}

/// Some rounds over these unknowns, with a system in each; what is known stays in reach.
fn iterate(
    g: &mut Graph,
    rng: &mut Rng,
    unknowns: &[Scalar; 2],
    known: &[Scalar; SYMBOLS],
    depth: usize,
) -> Vec<Scalar> {
    let mut inside = *known;
    inside[rng.below(2)] = unknowns[0];
    inside[3] = unknowns[1];
    let mut step = solve(g, rng, 2, &inside);
    if depth > 0 {
        let inner = [g.symbol(), g.symbol()];
        step = iterate(g, rng, &inner, &inside, depth - 1);
    }
    let more = tame(g, rng, &inside);
    let next = [g.add(step[0], more), g.sub(more, step[1])];
    let next = next.map(|x| {
        let half = g.decimal(0.25);
        g.mul(half, x)
    });
    // Not zero: modulo the prime, one over zero is a value without a sign of its own.
    let start = [tame(g, rng, known), known[rng.below(SYMBOLS)]];
    let start = [g.add(start[0], known[0]), start[1]];
    let size = g.mul(more, step[0]);
    let ids: Vec<SymbolId> = unknowns.iter().filter_map(|&s| g.symbol_id(s)).collect();
    let kind = BlockKind::Iterate { unknowns: ids.into(), count: 1 + rng.below(4) };
    g.block_outputs(kind, &[start[0], start[1], next[0], next[1], size])
}

struct Case {
    derivation: Derivation,
    point: Vec<f64>,
}

/// Solves and iterations on each other's results, shared work between them, two iterations over the same unknowns.
fn case(seed: u64) -> Case {
    let mut rng = Rng::new(seed);
    let mut g = Graph::new();
    let known = [(); SYMBOLS].map(|()| g.symbol());
    let unknowns = [g.symbol(), g.symbol()];
    let solved = solve(&mut g, &mut rng, 1 + seed as usize % 4, &known);
    let depth = rng.below(2);
    let first = iterate(&mut g, &mut rng, &unknowns, &known, depth);
    let mut later = known;
    later[4] = first[0];
    later[2] = solved[0];
    let second = iterate(&mut g, &mut rng, &unknowns, &later, 0);
    let early = solve(&mut g, &mut rng, 2, &[known[0], known[1], known[0], known[1], known[0]]);
    let mut results: Vec<Scalar> = (0..2).map(|_| tame(&mut g, &mut rng, &later)).collect();
    results.push(g.sum(&[second[0], -first[1], solved[0]]));
    results.extend([second[2], -solved[solved.len() - 1], first[2]]);
    results.push(g.mul(early[1], second[1]));
    results.truncate(3 + rng.below(5));
    let mut count = SYMBOLS + 2;
    while g.symbol_handle(SymbolId(count)).is_some() {
        count += 1;
    }
    let symbols = symbols(&g, count);
    let symbol_names = (0..count).map(|k| format!("symbol{k}")).collect();
    let functions =
        vec![Derived { kind: FunctionKind::Outputs, candidates: vec![("random", Results::vector(results))] }];
    let derivation = Derivation {
        graph: g,
        symbols,
        symbol_names,
        functions,
        at: Vec::new(),
        notes: Vec::new(),
        dead_centres: Vec::new(),
        modes: None,
        pivoted: Vec::new(),
        page: None,
        checks: Vec::new(),
        inertia: Default::default(),
        witnesses: Vec::new(),
        limbs: None,
        turns: Vec::new(),
    };
    let point = (0..count).map(|k| if k < SYMBOLS { rng.real(-1.5, 1.5) } else { f64::NAN }).collect();
    Case { derivation, point }
}

fn truth(case: &Case, roots: &[Scalar]) -> Vec<f64> {
    let value = |id: SymbolId| case.point[id.0];
    Evaluator::new(&case.derivation.graph, Real { symbols: &value }).run(roots)
}

/// Whether a quotient by nothing is left: there is no value that a pass could keep.
fn divides_by_zero(case: &Case) -> bool {
    any_node(case, |node| matches!(node, ScalarNode::Reciprocal(x) if *x == Scalar::ZERO))
}

fn takes_roots(case: &Case) -> bool {
    any_node(case, |node| matches!(node, ScalarNode::Sqrt(_)))
}

fn any_node(case: &Case, is: impl Fn(&ScalarNode) -> bool) -> bool {
    let mut lowering = Lowering::new(&case.derivation.graph);
    let roots = lowering.run(&case.derivation.functions[0].candidates[0].1.list);
    let g = &lowering.to;
    g.reachable_scalars(&roots).into_iter().any(|index| is(g.node(g.scalar_at(index))))
}

fn interpret(case: &Case, compiled: &Compiled) -> Vec<f64> {
    let value = |symbol: Symbol| {
        let at = case.derivation.symbols.iter().position(|&s| s == symbol);
        assert!(!matches!(symbol, Symbol::Unknown { .. }), "an unknown outside");
        case.point[at.expect("a symbol of the case")]
    };
    let fields = interpreter::run(&compiled.prelude, &value, &|_| f64::NAN);
    interpreter::run(&compiled.functions[0].program, &value, &|field| fields[field.0])
}

fn statements(program: &[Statement]) -> (usize, usize) {
    program.iter().fold((0, 0), |(solves, loops), statement| match statement {
        Statement::Solve { .. } => (solves + 1, loops),
        Statement::Iterate { body, .. } => {
            let inside = statements(body);
            (solves + inside.0, loops + 1 + inside.1)
        }
        _ => (solves, loops),
    })
}

#[test]
fn programs_are_what_was_derived() {
    let (mut solves, mut loops, mut told) = (0, 0, 0);
    for seed in 0..260 {
        let case = case(seed);
        let roots = case.derivation.functions[0].candidates[0].1.list.clone();
        let expected = truth(&case, &roots);
        if divides_by_zero(&case) || !expected.iter().all(|x| x.is_finite()) {
            continue;
        }
        let compiled = compile(&case.derivation).expect("finite numbers");
        assert!(compiled.sound, "seed {seed}");
        let found = interpret(&case, &compiled);
        for (k, (x, y)) in found.iter().zip(&expected).enumerate() {
            assert!((x - y).abs() < 1e-9 * (1.0 + y.abs()), "seed {seed}, {k}: {x} {y}");
        }
        told += 1;
        let count = statements(&compiled.functions[0].program.statements);
        (solves, loops) = (solves + count.0, loops + count.1);
        let early = statements(&compiled.prelude.statements);
        solves += early.0;
        assert_eq!(early.1, 0);
    }
    assert!(told > 100 && solves > 300 && loops > 200, "{told}: {solves} and {loops}");
}

/// The DAG before and after all passes, modulo the prime.
#[test]
fn passes_keep_blocks() {
    let (mut exact, mut told) = (0, 0);
    for seed in 300..400 {
        let case = case(seed);
        // Points at which all roots of all rounds exist are hard to find.
        if divides_by_zero(&case) || takes_roots(&case) {
            continue;
        }
        let mut lowering = Lowering::new(&case.derivation.graph);
        let roots = lowering.run(&case.derivation.functions[0].candidates[0].1.list);
        let mut dag = Dag::import(&lowering.to, &roots, &case.derivation.symbols);
        assert!(simplify(&mut dag), "seed {seed}");
        let (graph, rebuilt) = rebuild(&lowering.to, &dag);
        let verdict = identical(&lowering.to, &roots, &graph, &rebuilt, seed);
        assert!(!matches!(verdict, Verdict::Different(_)), "seed {seed}: {verdict:?}");
        exact += usize::from(verdict == Verdict::Identical);
        // A changed operand is noticed.
        if let Some(block) = dag.blocks.first_mut()
            && verdict == Verdict::Identical
        {
            block.operands.reverse();
            let (graph, rebuilt) = rebuild(&lowering.to, &dag);
            let verdict = identical(&lowering.to, &roots, &graph, &rebuilt, seed);
            told += usize::from(matches!(verdict, Verdict::Different(_)));
        }
    }
    assert!(exact > 3 && told > 2, "{exact}, {told}");
}
