//! Linear systems and iterations as Rust: what is emitted compiles without a warning and computes what was derived.

use crate::parsed;
use std::process::Command;

use crate::samples::*;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::results::Results;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::emit::source;
use multibody_engine::mechanics::{Derivation, Derived};
use multibody_engine::model::types::{JointId, Model};
use multibody_engine::optimize::compile;
use multibody_engine::optimize::program::{Compiled, Local, Program, Statement};
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{BlockKind, Graph, Scalar, SymbolId};

/// Newton's method for x + q sin y = v, y - q cos x = 1/2, its step a linear system.
fn newton(g: &mut Graph, q: Scalar, v: Scalar, [x, y]: [Scalar; 2], count: usize) -> Vec<Scalar> {
    let (sin, cos) = (g.sin(y), g.cos(x));
    let (first, second) = (g.mul(q, sin), g.mul(q, cos));
    let half = g.decimal(0.5);
    let residuals = [g.sum(&[x, first, -v]), g.sum(&[y, -second, -half])];
    let mut system: Vec<Scalar> = residuals.iter().flat_map(|&r| g.gradient(r, &[x, y])).collect();
    system.extend(residuals);
    let step = g.block_outputs(BlockKind::Solve { size: 2, symmetric: false, groups: [].into() }, &system);
    let next = [g.sub(x, step[0]), g.sub(y, step[1])];
    let squares = residuals.map(|r| g.mul(r, r));
    let size = g.sum(&squares);
    let unknowns = [x, y].iter().filter_map(|&s| g.symbol_id(s)).collect();
    let outputs = g.block_outputs(BlockKind::Iterate { unknowns, count }, &[v, q, next[0], next[1], size]);
    g.name(outputs[0], || "rocker".into());
    outputs
}

/// One result of q, v and two unknowns.
fn result(k: usize, g: &mut Graph, q: Scalar, v: Scalar, unknowns: [Scalar; 2]) -> Scalar {
    let found = newton(g, q, v, unknowns, 5);
    let sine = g.sin(found[0]);
    match k {
        // All results; one of them; the residual alone; a second iteration over the same unknowns.
        0 => g.sum(&[found[0], found[1], found[2], sine]),
        1 => found[1],
        2 => found[2],
        3 => {
            let again = newton(g, sine, found[1], unknowns, 3);
            g.add(again[0], found[0])
        }
        // A symmetric system; its rank alone; one unknown whose next value is read by nothing else.
        4 => {
            let one = g.mul(v, v);
            let diagonal = g.add(one, Scalar::ONE);
            let solved = g.block_outputs(
                BlockKind::Solve { size: 2, symmetric: true, groups: [].into() },
                &[diagonal, q, q, diagonal, v, sine],
            );
            g.sum(&[solved[1], solved[2]])
        }
        5 => g.block_outputs(BlockKind::Solve { size: 1, symmetric: false, groups: [].into() }, &[q, v])[1],
        // A thousand values within a round.
        6 => {
            let mut value = unknowns[0];
            for _ in 0..300 {
                let (square, third) = (g.mul(value, value), g.decimal(0.3));
                let sum = g.sum(&[square, q, third]);
                let root = g.sqrt(sum);
                g.name(root, || "root".into());
                let sum = g.add(root, v);
                value = g.mul(sum, third);
            }
            let id = g.symbol_id(unknowns[0]).unwrap();
            g.block_outputs(BlockKind::Iterate { unknowns: Box::new([id]), count: 2 }, &[q, value, Scalar::ZERO])[0]
        }
        // Unknowns that trade places, and one that nothing reads.
        _ => {
            let ids: Box<[SymbolId]> = unknowns.iter().filter_map(|&s| g.symbol_id(s)).collect();
            let [x, y] = unknowns;
            let swap = g.block_outputs(BlockKind::Iterate { unknowns: ids.clone(), count: 3 }, &[q, v, y, x, x]);
            let idle = g.block_outputs(BlockKind::Iterate { unknowns: ids, count: 2 }, &[v, q, q, sine, y]);
            g.sum(&[swap[0], swap[2], idle[0]])
        }
    }
}

const CASES: usize = 8;

/// The model, its program and the value at (0.4, 0.7).
fn case(k: usize) -> (Model, Compiled, f64) {
    let mut g = Graph::new();
    let (q, v) = (g.symbol(), g.symbol());
    let unknowns = [g.symbol(), g.symbol()];
    let value = result(k, &mut g, q, v, unknowns);
    let point = |id: SymbolId| [0.4, 0.7, f64::NAN, f64::NAN][id.0];
    let expected = Evaluator::new(&g, Real { symbols: &point }).run(&[value])[0];
    let symbols = vec![
        Symbol::Position { joint: JointId(0), component: 0 },
        Symbol::Velocity { joint: JointId(0), component: 0 },
        Symbol::Unknown { index: 0 },
        Symbol::Unknown { index: 1 },
    ];
    let symbol_names = ["q", "v", "coupler", "follower"].map(String::from).to_vec();
    let functions = vec![Derived {
        kind: FunctionKind::ForwardDynamics,
        candidates: vec![("loop", Results::velocity(vec![value]))],
    }];
    let compiled = compile(&Derivation {
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
    })
    .unwrap();
    assert!(compiled.sound);
    let mut model = empty(&format!("case{k}"));
    add_joint(&mut model, place(0, "hinge"), revolute());
    model.krate = syn::parse_quote!(crate::multibody);
    (model, compiled, expected)
}

/// What the cases need of the runtime crate.
const RUNTIME: &str = concat!(
    "pub mod multibody {\npub mod emitted {\n",
    include_str!("../../../../runtime/src/emitted.rs"),
    "}
    use std::ops::*;
    pub trait Real: Copy + PartialEq + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
        + Div<Output = Self> + Neg<Output = Self> {
        fn lit(value: f64) -> Self;
        fn sqrt(self) -> Self;
        fn sin_cos(self) -> (Self, Self);
        fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] { angles.map(Self::sin_cos) }
        fn value(self) -> f64;
    }
    impl Real for f64 {
        fn lit(value: f64) -> f64 { value }
        fn sqrt(self) -> f64 { self.sqrt() }
        fn sin_cos(self) -> (f64, f64) { self.sin_cos() }
        fn value(self) -> f64 { self }
    }
    pub mod linear {
        use super::Real;
        /// For the strong diagonals of the cases.
        pub fn solve<T: Real, const N: usize>(mut a: [[T; N]; N], mut b: [T; N]) -> ([T; N], T) {
            for k in 0..N {
                let (row, right) = (a[k], b[k]);
                for i in (0..N).filter(|&i| i != k) {
                    let factor = a[i][k] / row[k];
                    for j in 0..N { a[i][j] = a[i][j] - factor * row[j]; }
                    b[i] = b[i] - factor * right;
                }
            }
            (std::array::from_fn(|k| b[k] / a[k][k]), T::lit(N as f64))
        }
        pub fn solve_symmetric<T: Real, const N: usize>(a: [[T; N]; N], b: [T; N]) -> ([T; N], T) { solve(a, b) }
    }
    pub struct Cost { pub function: &'static str, pub add: u32, pub mul: u32, pub div: u32, pub sqrt: u32,
        pub sincos: u32, pub other: u32 }
    pub struct ParamError { pub what: &'static str }
    pub trait Tangent<T>: Copy {
        fn zero() -> Self;
        fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self;
        fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A;
    }
    impl<T: Real> Tangent<T> for T {
        fn zero() -> T { T::lit(0.0) }
        fn zip<F: FnMut(T, T) -> T>(&self, other: &T, f: &mut F) -> T { f(*self, *other) }
        fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A { f(start, *self) }
    }
    pub struct Column<'a>(pub &'a str);
    impl Column<'_> {
        pub fn field(&self, name: &'static str, _unit: &'static str) -> Column<'_> { Column(name) }
    }
    pub trait Columns<T> {
        fn columns(&self, place: &Column<'_>, f: &mut dyn FnMut(&Column<'_>, T));
    }
    impl<T: Real> Columns<T> for T {
        fn columns(&self, place: &Column<'_>, f: &mut dyn FnMut(&Column<'_>, T)) { f(place, *self) }
    }
    pub trait Configuration<T>: Copy {
        type Velocity: Copy;
        fn displace(&self, d: &Self::Velocity) -> Self;
        fn advance(&self, d: &Self::Velocity, rest: &Self::Velocity) -> (Self, Self::Velocity);
        fn dexp_inv(d: &Self::Velocity, v: &Self::Velocity) -> Self::Velocity;
        fn magnitude(&self) -> Self::Velocity;
    }
    impl<T: Real> Configuration<T> for T {
        type Velocity = T;
        fn displace(&self, d: &T) -> T { *self + *d }
        fn advance(&self, d: &T, rest: &T) -> (T, T) { (*self + *d + *rest, *rest) }
        fn dexp_inv(_: &T, v: &T) -> T { *v }
        fn magnitude(&self) -> T { *self }
    }
    pub trait StateSpace {
        type Scalar; type Position; type Velocity; type Extra;
        fn split(&self) -> (Self::Position, Self::Velocity, Self::Extra);
        fn join(&self, q: Self::Position, v: Self::Velocity, x: Self::Extra) -> Self;
    }
    pub trait System {
        type Scalar; type State: StateSpace; type Input;
        fn derivative(&self, t: Self::Scalar, state: &Self::State, input: &Self::Input)
            -> (<Self::State as StateSpace>::Velocity, <Self::State as StateSpace>::Extra);
        fn position_rates(&self, t: Self::Scalar, state: &Self::State) -> <Self::State as StateSpace>::Velocity;
    }
    pub mod nalgebra {
        pub struct Data<T, const N: usize>(pub [[T; N]; 1]);
        pub struct SVector<T, const N: usize> { pub data: Data<T, N> }
        impl<T, const N: usize> From<[T; N]> for SVector<T, N> {
            fn from(list: [T; N]) -> Self { Self { data: Data([list]) } }
        }
    }
}
"
);

#[test]
fn loops_compile_without_a_warning() {
    let cases: Vec<(Model, Compiled, f64)> = (0..CASES).map(case).collect();
    let mut text = format!("#![allow(dead_code)]\n{RUNTIME}");
    let mut main = String::new();
    for (k, (model, compiled, _)) in cases.iter().enumerate() {
        text += &source(&emit(model, compiled));
        main += &format!(
            "let state = case{k}::State {{ q: case{k}::Position {{ hinge: 0.4 }}, v: case{k}::Velocity {{ hinge: 0.7 }} }};
             println!(\"{{}}\", case{k}::Model::<f64>::default().forward_dynamics(0.0, &state, &()).hinge);"
        );
    }
    text += &format!("fn main() {{ {main} }}");
    let directory = std::env::temp_dir().join(format!("multibody-loops-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let (file, program) = (directory.join("loops.rs"), directory.join("loops"));
    std::fs::write(&file, &text).unwrap();
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_string());
    let arguments = ["--edition", "2024", "-D", "warnings", "-o"];
    let output = Command::new(rustc).args(arguments).args([&program, &file]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let output = Command::new(&program).output().unwrap();
    let printed: Vec<f64> = String::from_utf8_lossy(&output.stdout).lines().map(|line| line.parse().unwrap()).collect();
    assert_eq!(printed.len(), CASES);
    for (k, (found, (.., expected))) in printed.iter().zip(&cases).enumerate() {
        assert!((found - expected).abs() < 1e-12 * (1.0 + expected.abs()), "case {k}: {found} {expected}");
    }
    std::fs::remove_dir_all(&directory).unwrap();
}

fn written(k: usize) -> String {
    let (model, compiled, _) = case(k);
    parsed::text(&parsed::method(&parsed::module(&model, &compiled), "forward_dynamics").block)
}

#[test]
fn what_is_asked_for_is_written() {
    assert_eq!(written(0).matches("linear::solve(").count(), 1, "{}", written(0));
    // The residual alone: the loop still runs, and keeps its unknowns.
    let residual = written(2);
    assert!(residual.contains("letmutcoupler=") || residual.contains("letmutrocker="), "{residual}");
    assert!(residual.contains("residual=T::lit(0.0);for_in0..5{"), "{residual}");
    // One unknown: no residual.
    let unknown = written(1);
    assert!(!unknown.contains("residual"), "{unknown}");
    assert!(unknown.contains("crate::multibody::linear::solve([["), "{unknown}");
    let rank = written(5);
    assert!(rank.contains("let([_],rank"), "{rank}");
    assert!(written(4).contains("linear::solve_symmetric("));
}

/// The statement as it is written.
#[test]
fn a_loop_is_written() {
    let statements = vec![Statement::Iterate {
        count: 4,
        unknowns: vec![Local(0), Local(1), Local(2)],
        start: vec![q(0, 0), lit(1.0), lit(2.0)],
        body: vec![set(3, mul(&[local(0), local(1)])), set(5, mul(&[local(2), local(2)]))],
        next: vec![local(1), local(3), local(5)],
        residual: (Local(4), minus(local(3), local(0))),
    }];
    let program = |results: Vec<_>| Program {
        locals: ["a", "b", "idle", "product", "size", "square"].map(String::from).to_vec(),
        statements: statements.clone(),
        results,
        ..Program::default()
    };
    let text = |results| parsed::text(&parsed::scalar_function(program(results)).block);
    let body = "letmuta=q.hinge;letmutb=T::lit(1.0);for_in0..4{letproduct=a*b;(a,b)=(b,product);}";
    assert!(text(vec![local(1)]).contains(&format!("{body}b}}")), "{}", text(vec![local(1)]));
    let both = text(vec![mul(&[local(0), local(4)])]);
    assert!(both.contains("letmutsize=T::lit(0.0);for_in0..4{letproduct=a*b;size=product-a;(a,b)="), "{both}");
}
