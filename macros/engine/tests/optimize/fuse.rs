//! Products that are added to something: which ones are fused, in what order, and what becomes of errors.

use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics;
use multibody_engine::optimize::fuse::{bounded_fields, fuse};
use multibody_engine::optimize::program::{Expression, FieldId, Local, Program, Size, Statement};
use multibody_engine::optimize::{Plain, compile_with};
use multibody_engine::symbolic::doubled::Doubled;

use crate::corpus;
use crate::interpreter;
use crate::rng::Rng;
use crate::together::{local, number, set};

fn product(list: &[Expression]) -> Expression {
    Expression::Product(list.to_vec())
}

fn mul_add(a: Expression, b: Expression, c: Expression) -> Expression {
    Expression::Fused(Box::new([a, b, c]))
}

fn neg(x: Expression) -> Expression {
    Expression::Neg(Box::new(x))
}

fn fused(value: Expression) -> Expression {
    let mut program = Program { results: vec![value], ..Program::default() };
    fuse(&mut program, &[]);
    program.results.remove(0)
}

#[test]
fn a_sum_begins_with_what_is_no_product() {
    let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(local);
    let ab = product(&[a.clone(), b.clone()]);
    let cd = product(&[c.clone(), d.clone()]);
    // Of two products the first is rounded by itself.
    let minus = fused(Expression::Sum(vec![(false, ab.clone()), (true, cd.clone())]));
    assert_eq!(minus, mul_add(neg(c.clone()), d.clone(), ab.clone()));
    let three = fused(Expression::Sum(vec![(false, ab.clone()), (true, e.clone()), (false, cd.clone())]));
    assert_eq!(three, mul_add(c.clone(), d.clone(), mul_add(a.clone(), b.clone(), neg(e.clone()))));
    // Literals take signs, as they do elsewhere.
    let literal = product(&[number(0.5), a.clone()]);
    let half = fused(Expression::Sum(vec![(false, e.clone()), (true, literal)]));
    assert_eq!(half, mul_add(number(-0.5), a.clone(), e.clone()));
    // A product of three is one product and one that is fused.
    let abc = product(&[a.clone(), b.clone(), c.clone()]);
    let long = fused(Expression::Sum(vec![(false, abc), (false, e.clone())]));
    assert_eq!(long, mul_add(ab.clone(), c.clone(), e.clone()));
    // What is no sum stays as it is, and what stands inside of something else is found.
    assert_eq!(fused(ab.clone()), ab);
    let inside = product(&[d.clone(), Expression::Sum(vec![(false, ab.clone()), (false, e.clone())])]);
    assert_eq!(fused(inside), product(&[d, mul_add(a, b, e)]));
}

#[test]
fn what_has_no_product_stays_as_it_is() {
    let plain = Expression::Sum(vec![(true, local(0)), (false, local(1)), (true, Expression::Literal(2.0))]);
    assert_eq!(fused(plain.clone()), plain);
    let pack =
        Expression::Pack(vec![Expression::Sum(vec![(false, product(&[local(0), local(1)])), (false, local(2))])]);
    assert_eq!(fused(pack.clone()), pack);
}

/// A root of a a - b b is zero where a and b are equal: neither in the root nor on the way to it is it fused, but sums of squares
/// are, and so is what no such function reads.
#[test]
fn roots_of_what_cancels_stay_numbers() {
    use multibody_engine::contracts::call::Call;
    let root = |x: Expression| Expression::Call(Call::Sqrt, vec![x]);
    let [a, b, c] = [0, 1, 2].map(local);
    let difference =
        Expression::Sum(vec![(false, product(&[a.clone(), a.clone()])), (true, product(&[b.clone(), b.clone()]))]);
    let scaled = |x: Expression| product(&[number(0.5), x, c.clone()]);
    let (four, six) = (number(4.0), local(6));
    let mut program = Program {
        locals: (0..7).map(|k| format!("x{k}")).collect(),
        statements: vec![
            set(0, number(0.1)),
            set(1, number(0.1)),
            set(2, number(3.0)),
            // Read by a root by way of another local, a quotient and a choice.
            set(3, difference.clone()),
            set(4, Expression::Call(Call::Max, vec![number(-1.0), scaled(local(3))])),
            set(5, root(Expression::Quotient(Box::new(local(4)), Box::new(four)))),
            set(6, difference.clone()),
        ],
        results: vec![root(difference.clone()), local(5), difference.clone(), six],
        ..Program::default()
    };
    fuse(&mut program, &[]);
    let run = interpreter::run(&program, &|_| f64::NAN, &|_| f64::NAN);
    assert_eq!(run[..2], [0.0, 0.0]);
    assert!(run[2] != 0.0, "a rounding of one of the products");
    assert_eq!(program.results[2], fused(difference.clone()));
    assert_ne!(program.results[2], difference);
    let Statement::Let { value, .. } = &program.statements[6] else { unreachable!() };
    assert_eq!(*value, fused(difference.clone()));
    let squares = Expression::Sum(vec![(false, product(&[a.clone(), a])), (false, product(&[b.clone(), c, b]))]);
    assert_eq!(fused(root(squares.clone())), root(squares), "of which one may be negative");
    let [a, b] = [0, 1].map(local);
    let squares = Expression::Sum(vec![
        (false, product(&[a.clone(), a.clone()])),
        (false, product(&[b.clone(), number(2.0), b.clone()])),
    ]);
    assert_eq!(fused(root(squares.clone())), root(fused(squares)));
}

/// What a pack is filled with, where a root is taken of the pack.
#[test]
fn ways_go_through_packs() {
    use multibody_engine::contracts::call::Call;
    let [a, b] = [0, 1].map(local);
    let difference = Expression::Sum(vec![(false, product(&[a.clone(), a])), (true, product(&[b.clone(), b]))]);
    let mut program = Program {
        locals: (0..5).map(|k| format!("x{k}")).collect(),
        statements: vec![
            set(0, number(0.1)),
            set(1, number(0.1)),
            set(2, difference.clone()),
            set(3, difference.clone()),
            Statement::Pack {
                size: Size::Four,
                local: Local(4),
                value: Expression::Pack(vec![local(2), local(2), number(1.0), local(0)]),
            },
        ],
        results: vec![Expression::Call(Call::Sqrt, vec![local(4)])],
        ..Program::default()
    };
    fuse(&mut program, &[]);
    let value = |number: usize| match &program.statements[number] {
        Statement::Let { value, .. } => value.clone(),
        _ => unreachable!(),
    };
    assert_eq!([value(2), value(3)], [difference.clone(), fused(difference)]);
}

/// What a later program hands to a root, by way of a product and a choice, is known of the fields that it reads.
#[test]
fn fields_that_roots_read_are_known() {
    use multibody_engine::contracts::call::Call;
    let field = |number| Expression::Field(FieldId(number));
    let root = |x: Expression| Expression::Call(Call::Sqrt, vec![x]);
    let square = product(&[field(3), field(3)]);
    let mut program = Program {
        locals: vec!["x0".to_owned()],
        statements: vec![set(0, Expression::Call(Call::Max, vec![number(-1.0), product(&[field(1), number(0.5)])]))],
        results: vec![root(Expression::Sum(vec![(false, local(0)), (false, square)])), field(2), field(1)],
        ..Program::default()
    };
    let found = bounded_fields(&program);
    assert_eq!(found, [FieldId(1)].into(), "a square is never negative");
    fuse(&mut program, &[]);
    assert_eq!(bounded_fields(&program), found);

    // Of two results that are alike the one that such a field holds stays plain, with the locals in it.
    let value = Expression::Sum(vec![(false, product(&[local(1), local(1)])), (true, product(&[local(2), local(2)]))]);
    let twice = product(&[number(2.0), local(0)]);
    let mut program = Program {
        locals: (0..3).map(|k| format!("x{k}")).collect(),
        statements: vec![set(0, value.clone())],
        results: vec![value.clone(), twice.clone()],
        ..Program::default()
    };
    fuse(&mut program, &[1]);
    assert_eq!(program.results, [fused(value.clone()), twice]);
    let Statement::Let { value: kept, .. } = &program.statements[0] else { unreachable!() };
    assert_eq!(*kept, value);
}

/// The determinant x y - z w is stored at a position, and a function of velocities takes the root of it and a square. Where
/// x, y are z, w and all is at rest the root is zero, whatever x and y are.
#[test]
fn roots_of_what_is_stored_stay_numbers() {
    let model = corpus::model(
        "pub mod stored {
            body a { mass: 1.3 }
            body b { mass: 0.7 }
            joint x: Prismatic { parent: ground, child: a, axis: [1, 2, 0.5] }
            joint y: Prismatic { parent: a, child: b, axis: [0.3, -1, 0.4] }
            body c { mass: 0.5 }
            body d { mass: 0.4 }
            joint z: Prismatic { parent: b, child: c, axis: [0.2, 1, 2] }
            joint w: Prismatic { parent: c, child: d, axis: [1, -0.2, 0.7] }
            output root = sqrt(x.travel * y.travel - z.travel * w.travel + x.rate * x.rate);
            output energy = kinetic();
            emit mass_matrix, at { functions: [outputs, mass_matrix] };
        }",
    );
    let (_, derivation) = mechanics::of(&model).unwrap_or_else(|_| panic!("a derivation"));
    let compiled = compile_with(&derivation, Plain::default(), true).unwrap();
    let at = compiled.at.as_ref().unwrap();
    let outputs = &at.functions[0].program;
    assert!(!bounded_fields(outputs).is_empty(), "nothing that is stored leads to the root: {at:#?}");
    let mut rng = Rng::new(0x0dd);
    for _ in 0..200 {
        let pair = [rng.real(-1.5, 1.5), rng.real(-1.5, 1.5)];
        let symbol = |symbol| match symbol {
            Symbol::Position { joint, .. } => pair[joint.0 % 2],
            _ => 0.0,
        };
        let mut fields = interpreter::run(&compiled.prelude, &symbol, &|_| f64::NAN);
        let stored = interpreter::run(&at.program, &symbol, &|field| fields[field.0]);
        fields.extend(stored);
        let root = interpreter::run(outputs, &symbol, &|field| fields[field.0])[0];
        assert_eq!(root, 0.0, "at {pair:?}");
    }
}

/// Random sums of products against 31 digits: each is within the rounding of its partial sums and of one product, and beside the plain
/// one errors are smaller on average.
#[test]
fn errors_are_those_of_partial_sums() {
    let mut rng = Rng::new(0x5eed);
    let (mut plain_error, mut fused_error) = (0.0, 0.0);
    for _ in 0..2000 {
        let count = 2 + rng.below(7);
        let values: Vec<f64> = (0..2 * count).map(|_| rng.real(-1.0, 1.0)).collect();
        let statements: Vec<Statement> = values.iter().enumerate().map(|(k, &x)| set(k, number(x))).collect();
        let signs: Vec<bool> = (0..count).map(|_| rng.below(2) == 0).collect();
        let terms = (0..count).map(|k| (signs[k], product(&[local(2 * k), local(2 * k + 1)])));
        let program = |result: Expression| Program {
            locals: (0..values.len()).map(|k| format!("x{k}")).collect(),
            statements: statements.clone(),
            results: vec![result],
            ..Program::default()
        };
        let plain = program(Expression::Sum(terms.collect()));
        let mut fused = plain.clone();
        fuse(&mut fused, &[]);
        assert_ne!(plain.results, fused.results);
        let run = |program: &Program| interpreter::run(program, &|_| f64::NAN, &|_| f64::NAN)[0];
        let signed = |k: usize| if signs[k] { -values[2 * k] } else { values[2 * k] };
        let (mut exact, mut bound, mut partial) = (Doubled::ZERO, 0.0, 0.0_f64);
        for k in 0..count {
            exact = exact + Doubled::new(signed(k)) * Doubled::new(values[2 * k + 1]);
            partial += signed(k) * values[2 * k + 1];
            bound += partial.abs();
        }
        let off = |x: f64| (Doubled::new(x) + -exact).high.abs();
        let half = f64::EPSILON / 2.0;
        // The first product is rounded: that is the first partial sum. Those of the plain sum differ by rounding.
        assert!(off(run(&fused)) <= 1.01 * half * bound, "{} {bound}", off(run(&fused)));
        plain_error += off(run(&plain));
        fused_error += off(run(&fused));
    }
    assert!(fused_error < 0.9 * plain_error, "{fused_error} {plain_error}");
}

/// Every statement is visited, those inside iterations too, and no local is lost.
#[test]
fn statements_keep_their_locals() {
    let value = Expression::Sum(vec![(false, product(&[local(0), local(1)])), (false, product(&[local(2), local(1)]))]);
    let body = vec![set(3, value.clone())];
    let iterate = Statement::Iterate {
        count: 2,
        unknowns: vec![Local(2)],
        start: vec![value.clone()],
        body,
        next: vec![value.clone()],
        residual: (Local(4), value.clone()),
    };
    let mut program = Program { statements: vec![set(5, value.clone()), iterate], ..Program::default() };
    fuse(&mut program, &[]);
    let expressions: Vec<&Expression> = program.expressions().collect();
    assert_eq!(expressions.len(), 5);
    assert!(expressions.iter().all(|expression| **expression == fused(value.clone())));
}
