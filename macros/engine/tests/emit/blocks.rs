//! No more than some hundred `let`s in a row, whatever the length of a function, and rustc copes with it.

use crate::parsed;
use std::process::Command;

use crate::samples::*;
use multibody_engine::emit::source;
use syn::{Block, Expr, Stmt};

/// The longest row of `let`s, and how many there are that compute something.
fn measure(block: &Block) -> (usize, usize) {
    let (mut row, mut longest, mut count) = (0, 0, 0);
    for statement in &block.stmts {
        let Stmt::Local(local) = statement else {
            continue;
        };
        row += 1;
        match local.init.as_ref().map(|init| init.expr.as_ref()) {
            Some(Expr::Block(inner)) => {
                let (deeper, more) = measure(&inner.block);
                longest = longest.max(deeper);
                count += more;
            }
            _ => count += 1,
        }
    }
    (longest.max(row), count)
}

#[test]
fn rows_are_short() {
    for count in [1, 255, 256, 257, 1000, 1999] {
        let (model, compiled) = long(count);
        let method = parsed::method(&parsed::module(&model, &compiled), "forward_dynamics");
        let (longest, found) = measure(&method.block);
        // Two more for `q` and `v`.
        assert!(longest <= 258, "{longest} in a row of {count}");
        assert!(found >= count && found <= count + 2, "{found} of {count}");
    }
}

#[test]
fn blocks_return_what_is_read_later() {
    let (model, compiled) = long(300);
    let method = parsed::method(&parsed::module(&model, &compiled), "forward_dynamics");
    let text = parsed::text(&method.block);
    assert!(text.contains("let(value_99,)={letvalue_0="), "{text}");
    assert!(text.contains("(value_99,)};let(value_199,)={letvalue_100="), "{text}");
}

#[test]
fn what_nothing_reads_is_left_out() {
    let statements =
        vec![set(0, q(0, 0)), sin_cos(1, 2, local(0)), set(3, v(0, 0)), set(4, mul(&[local(1), local(1)]))];
    let names = ["angle", "sin_angle", "cos_angle", "rate", "square"];
    let body = parsed::scalar_function(program(&names, statements, vec![local(4)]));
    assert_eq!(
        parsed::text(&body.block),
        "{letq=&state.q;letv=&state.v;letangle=q.hinge;let(sin_angle,_)=Real::sin_cos(angle);sin_angle*sin_angle}"
    );
}

/// What `long` needs of the runtime crate.
const RUNTIME: &str = concat!(
    "mod multibody {\npub mod emitted {\n",
    include_str!("../../../../runtime/src/emitted.rs"),
    "}
    pub trait Real: Copy + std::ops::Add<Output = Self> + std::ops::Mul<Output = Self> + PartialEq {
        fn lit(value: f64) -> Self;
    }
    impl Real for f64 { fn lit(value: f64) -> f64 { value } }
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
fn main() {
    let model = long::Model::<f64>::default();
    let state = long::State { q: long::Position { hinge: 1.0 }, v: long::Velocity { hinge: 1.0 } };
    println!(\"{}\", model.forward_dynamics(0.0, &state, &()).hinge);
}
"
);

#[test]
fn ten_thousand_statements_compile() {
    const COUNT: usize = 10_000;
    let (mut model, compiled) = long(COUNT);
    model.krate = syn::parse_quote!(crate::multibody);
    let directory = std::env::temp_dir().join(format!("multibody-blocks-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let file = directory.join("long.rs");
    let allowed = "#![allow(dead_code)]\n";
    let text = format!("{allowed}{RUNTIME}{}", source(&emit(&model, &compiled)));
    std::fs::write(&file, text).unwrap();

    let mut values: Vec<f64> = Vec::new();
    for i in 0..COUNT {
        let near = values.last().copied().unwrap_or(1.0);
        let far = if i < 1000 { 1.0 } else { values[i - 1000] };
        values.push(0.5 * near + 0.25 * far);
    }
    for level in ["0", "3"] {
        let program = directory.join(format!("long{level}"));
        let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_string());
        let output = Command::new(rustc)
            .args(["--edition", "2024", "-D", "warnings", "-C", "debuginfo=2"])
            .arg(format!("-Copt-level={level}"))
            .arg("-o")
            .args([&program, &file])
            .output()
            .unwrap();
        let messages = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "level {level}: {messages}");
        let output = Command::new(&program).output().unwrap();
        let printed: f64 = String::from_utf8_lossy(&output.stdout).trim().parse().unwrap();
        assert_eq!(printed.to_bits(), values[COUNT - 1].to_bits(), "level {level}");
    }
    std::fs::remove_dir_all(&directory).unwrap();
}
