//! Packs of limbs in random programs: values are those without packs, whatever limbs have in common or not, and nothing is read
//! before it is there.

use std::collections::HashSet;

use crate::corpus;
use crate::interpreter;
use crate::rng::Rng;
use multibody_engine::contracts::call::Call;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::limbs::Limbs;
use multibody_engine::model::types::{JointId, Model};
use multibody_engine::optimize::packs::pack;
use multibody_engine::optimize::program::{Expression, Local, Program, Sine, Statement};

/// Limbs of two joints on one body.
fn model(limbs: usize) -> Model {
    let each = (0..limbs).map(|k| {
        format!(
            "body a{k} {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }}
            body b{k} {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }}
            joint hip{k}: Revolute {{ parent: trunk, child: a{k}, axis: X }}
            joint knee{k}: Revolute {{ parent: a{k}, child: b{k}, axis: Y }}"
        )
    });
    let each: String = each.collect();
    corpus::model(&format!(
        "pub mod spider {{
            body trunk {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }}
            joint slide: Prismatic {{ parent: ground, child: trunk, axis: Z }}
            {each}
        }}"
    ))
}

fn position(joint: usize) -> Expression {
    Expression::Symbol(Symbol::Position { joint: JointId(joint), component: 0 })
}

/// What a limb computes, up to numbers, signs and the order of terms: statement by statement, from what stands before.
struct Template {
    statements: Vec<(u8, Vec<usize>)>,
}

impl Template {
    fn random(rng: &mut Rng) -> Template {
        let count = 4 + rng.below(9);
        let of = |rng: &mut Rng, number: usize| (0..2 + rng.below(3)).map(|_| rng.below(number + 3)).collect();
        Template { statements: (0..count).map(|k| (rng.below(6) as u8, of(rng, k))).collect() }
    }
}

/// Random limbs, twice, with values that all of them share before and between.
struct Writer<'r> {
    rng: &'r mut Rng,
    program: Program,
}

impl Writer<'_> {
    fn local(&mut self, name: String) -> Local {
        self.program.locals.push(name);
        Local(self.program.locals.len() - 1)
    }

    fn set(&mut self, name: String, value: Expression) -> Expression {
        let local = self.local(name);
        self.program.statements.push(Statement::Let { local, value });
        Expression::Local(local)
    }

    fn literal(&mut self) -> Expression {
        Expression::Literal(self.rng.real(0.3, 1.7) * if self.rng.below(4) == 0 { -1.0 } else { 1.0 })
    }

    /// With a sign and a factor or not.
    fn signed(&mut self, value: &Expression) -> (bool, Expression) {
        let minus = self.rng.below(3) == 0;
        (minus, value.clone())
    }

    fn limb(&mut self, template: &Template, limb: usize, shared: &[Expression; 2], oddity: bool) -> Vec<Expression> {
        let mut values = vec![position(1 + 2 * limb), position(2 + 2 * limb), shared[limb % 2].clone()];
        for (number, (kind, operands)) in template.statements.iter().enumerate() {
            let read: Vec<Expression> = operands.iter().map(|&k| values[k].clone()).collect();
            let name = format!("limb_{limb}_{}", self.program.locals.len());
            let scaled = |value: Expression, by: Expression| Expression::Product(vec![by, value]);
            let value = match kind {
                _ if oddity && number == 2 => Expression::Neg(Box::new(read[0].clone())),
                0 | 1 => {
                    let mut terms: Vec<(bool, Expression)> = read.iter().map(|value| self.signed(value)).collect();
                    if *kind == 1 {
                        terms[0].1 = scaled(terms[0].1.clone(), self.literal());
                    }
                    // Of two terms of a kind the first goes on being the first.
                    if self.rng.below(3) == 0 {
                        terms.rotate_left(1);
                    }
                    Expression::Sum(terms)
                }
                2 => Expression::Product(read),
                3 => {
                    let square = Expression::Product(vec![read[0].clone(), read[0].clone()]);
                    let below = Expression::Sum(vec![(false, Expression::Literal(2.0)), (false, square)]);
                    Expression::Quotient(Box::new(self.signed(&read[1]).1), Box::new(below))
                }
                4 => {
                    let square = Expression::Product(vec![read[0].clone(), read[0].clone()]);
                    let sum = Expression::Sum(vec![(false, square), (false, Expression::Literal(0.7))]);
                    Expression::Call(Call::Sqrt, vec![sum])
                }
                _ => {
                    let (sin, cos) = (self.local(format!("sin_{name}")), self.local(format!("cos_{name}")));
                    let angle = if self.rng.below(2) == 0 {
                        Expression::Neg(Box::new(read[0].clone()))
                    } else {
                        read[0].clone()
                    };
                    self.program.statements.push(Statement::SinCos(vec![Sine { sin, cos, angle }]));
                    values.push(Expression::Local(if number % 2 == 0 { sin } else { cos }));
                    continue;
                }
            };
            let value = self.set(name, value);
            values.push(value);
        }
        values.split_off(3)
    }

    fn sum(&mut self, name: &str, parts: &[Vec<Expression>], number: usize) -> Expression {
        let terms = parts.iter().map(|values| {
            let (a, b) = (values[number % values.len()].clone(), values[values.len() - 1].clone());
            (self.rng.below(3) == 0, Expression::Product(vec![a, b]))
        });
        let terms = terms.collect();
        self.set(name.to_owned(), Expression::Sum(terms))
    }
}

fn random(rng: &mut Rng, limbs: usize) -> Program {
    let (first, second) = (Template::random(rng), Template::random(rng));
    let odd = if rng.below(3) == 0 { rng.below(limbs) } else { limbs };
    let neighbours = rng.below(3) == 0;
    let mut writer = Writer { rng, program: Program::default() };
    let (a, b) = (writer.literal(), writer.literal());
    let shared = [a, b].map(|literal| Expression::Product(vec![literal, position(0)]));
    let mut named = Vec::new();
    for (k, value) in shared.into_iter().enumerate() {
        named.push(writer.set(format!("shared_{k}"), value));
    }
    let shared = [named[0].clone(), named[1].clone()];
    let parts: Vec<_> = (0..limbs).map(|limb| writer.limb(&first, limb, &shared, limb == odd)).collect();
    let trunk = [writer.sum("trunk_0", &parts, 0), writer.sum("trunk_1", &parts, 1)];
    // The limbs once more, with what they have together, and with one another.
    let again = (0..limbs).map(|limb| {
        let of_next = parts[(limb + 1) % limbs][0].clone();
        let shared = [trunk[0].clone(), if neighbours { of_next } else { trunk[1].clone() }];
        writer.limb(&second, limb, &shared, false)
    });
    let again: Vec<_> = again.collect();
    let mut program = writer.program;
    program.results = trunk.into_iter().chain(parts.into_iter().chain(again).flatten()).collect();
    program
}

/// Whatever is read stands before.
fn is_in_order(statements: &[Statement]) -> bool {
    let mut written: HashSet<Local> = HashSet::new();
    statements.iter().all(|statement| {
        let mut ready = true;
        for expression in statement.expressions() {
            expression.each_local(&mut |local| ready &= written.contains(&local));
        }
        written.extend(statement.defined());
        ready
    })
}

#[test]
fn values_are_those_of_the_limbs() {
    let mut rng = Rng::new(20_261_125);
    let (mut packed, mut most) = (0, 0);
    for limbs in [2, 3, 4, 5, 6, 8, 9] {
        let known = Limbs::of(&model(limbs));
        for case in 0..60 {
            let before = random(&mut rng, limbs);
            let after = pack(before.clone(), &known);
            assert!(is_in_order(&after.statements), "{limbs} limbs, {case}");
            let packs = after.statements.iter().filter(|one| matches!(one, Statement::Pack { .. })).count();
            packed += usize::from(packs > 0);
            most = most.max(packs);
            let names: HashSet<&String> = after.locals.iter().collect();
            assert_eq!(names.len(), after.locals.len(), "{limbs} limbs, {case}: names");
            for draw in 0..3 {
                let values: Vec<f64> = (0..=2 * limbs).map(|_| rng.real(-2.0, 2.0)).collect();
                let symbol = |symbol: Symbol| match symbol {
                    Symbol::Position { joint, .. } => values[joint.0],
                    _ => f64::NAN,
                };
                let run = |program: &Program| interpreter::run(program, &symbol, &|_| f64::NAN);
                for (number, (a, b)) in run(&before).into_iter().zip(run(&after)).enumerate() {
                    let near = (a - b).abs() <= 1e-9 * (1.0 + a.abs()) || (!a.is_finite() && !b.is_finite());
                    assert!(
                        near || a.abs() > 1e6,
                        "{limbs} limbs, {case}, {draw}: result {number} is {b:e}, not {a:e}"
                    );
                }
            }
        }
    }
    // Programs without likeness, or too small to be worth it, are some of them.
    assert!(packed > 100 && most > 10, "{packed}, {most}");
}
