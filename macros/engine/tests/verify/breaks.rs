//! Errors that are put into compiled programs one at a time, and into derived equations.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::results::{Form, Parts, Slot};
use multibody_engine::emit;
use multibody_engine::mechanics::{self, Derivation};
use multibody_engine::model::types::Model;
use multibody_engine::optimize::program::{Compiled, Expression, Program, Statement};
use multibody_engine::optimize::{self, program::Local};
use multibody_engine::verify;

use crate::{corpus, interpreter};

const MODELS: [&str; 4] = [
    "pub mod tree {
        param l = 0.7;
        param stiffness = 3.0;
        input torque;
        world { gravity: [0.3, -9.81, 0.2] }
        body a { mass: 1.3, com: [0.1, 0.2, -0.3], inertia: inertia(0.2, 0.3, 0.25, 0.01, -0.02, 0.03) }
        body b { mass: 0.7, com: [0.1, -0.2, 0.4], inertia: diag(0.02, 0.03, 0.04) }
        joint first: Revolute { parent: ground, child: a, axis: [1, 2, 0.5] }
        joint second: Prismatic { parent: a.at([l, 0.1, 0]).rotated(Y, 0.4), child: b, axis: [0, 1, 1] }
        force motor: Effort { joint: first, value: torque - 0.1 * first.rate }
        force spring: SpringDamper { joint: second, stiffness: stiffness, damping: 0.2 }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives, momentum, impulse;
    }",
    "pub mod pinned {
        world { gravity: -9.81 * Y }
        formulation { constraints: Multipliers }
        body crank { mass: 0.4, com: 0.2 * X, inertia: diag(0.01, 0.02, 0.025) }
        body coupler { mass: 0.6, com: 0.4 * X, inertia: diag(0.02, 0.03, 0.04) }
        body follower { mass: 0.5, com: 0.3 * X, inertia: diag(0.01, 0.02, 0.025) }
        joint a: Revolute { parent: ground, child: crank, axis: Z }
        joint b: Revolute { parent: crank.at(0.4 * X), child: coupler, axis: Z }
        joint c: Revolute { parent: ground.at(0.9 * X), child: follower, axis: Z }
        #[cut]
        joint d: Revolute { parent: coupler.at(0.8 * X), child: follower.at(0.6 * X), axis: Z }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, residual, derivatives, impulse;
    }",
    "pub mod ball {
        world { gravity: -9.81 * Z }
        body top { mass: 0.9, com: [0.02, 0.01, 0.3], inertia: diag(0.02, 0.021, 0.03) }
        joint tip: Ball { parent: ground, child: top }
        let seen = top.at([0.1, 0.2, 0.3]);
        output place = seen.position;
        output speed = seen.velocity;
        output columns = seen.jacobian;
        output middle = top.position;
        output turned = top.rotation;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives, poses;
    }",
    CALLING,
];

/// Functions of Rust, for which others stand here.
const CALLING: &str = "pub mod calling {
        extern grip(slip, load) = crate::Grip;
        extern curve(x) = crate::Curve;
        param mu = 0.3;
        input torque;
        world { gravity: [0.3, -9.81, 0.2] }
        body a { mass: 1.3, com: [0.1, 0.2, -0.3], inertia: inertia(0.2, 0.3, 0.25, 0.01, -0.02, 0.03) }
        body b { mass: 0.7, com: [0.1, -0.2, 0.4], inertia: diag(0.02, 0.03, 0.04) }
        joint first: Revolute { parent: ground, child: a, axis: [1, 2, 0.5] }
        joint second: Prismatic { parent: a.at([0.7, 0.1, 0]).rotated(Y, 0.4), child: b, axis: [0, 1, 1] }
        state z: rate = grip(second, z) - curve(mu) * z, start: 0.1;
        force motor: Effort { joint: first, value: grip(first.rate, mu * curve(second)) + torque }
        force wind: Force { at: b.at(0.2 * X), value: [curve(z), 0.3, grip(b.velocity.x, torque)], axes: a }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, derivatives, impulse;
    }";

pub(crate) struct Case {
    pub(crate) model: Model,
    pub(crate) structure: mechanics::loops::structure::Structure,
    pub(crate) derivation: Derivation,
    pub(crate) compiled: Compiled,
}

impl Case {
    pub(crate) fn new(text: &str) -> Case {
        let model = corpus::model(text);
        let (structure, derivation) = mechanics::of(&model).unwrap_or_else(|c| panic!("{c:?}"));
        let compiled = optimize::compile(&derivation).unwrap();
        Case { model, structure, derivation, compiled }
    }

    pub(crate) fn check(&self, compiled: &Compiled) -> verify::Found {
        verify::check(&self.model, &self.structure, &self.derivation, compiled)
    }
}

/// Every sign, every term and every literal of every function, wrong one at a time.
#[test]
fn every_break_of_a_program_is_told() {
    for text in MODELS {
        let case = Case::new(text);
        let found = case.check(&case.compiled);
        assert!(found.wrong.is_empty() && found.broken.is_none(), "{}: {found:?}", case.model.name);
        let (mut told, mut idle) = (0, 0);
        for (number, function) in case.compiled.functions.iter().enumerate() {
            let count = nodes(&function.program);
            for at in (0..count).step_by(1 + count / 60) {
                let Some(broken) = broken(&function.program, at) else { continue };
                if !differs(&function.program, &broken) {
                    idle += 1;
                    continue;
                }
                let mut compiled = case.compiled.clone();
                compiled.functions[number].program = broken;
                let found = case.check(&compiled);
                assert_eq!(found.wrong, [function.kind], "{} {:?}, node {at}", case.model.name, function.kind);
                told += 1;
            }
        }
        println!("{}: {told} told, {idle} that change nothing", case.model.name);
        assert!(told > 50 && idle < told);
    }
}

/// A slope in the place of another, or of the value.
#[test]
fn slopes_that_are_mistaken_for_each_other_are_told() {
    let case = Case::new(CALLING);
    let mut told = 0;
    for (number, function) in case.compiled.functions.iter().enumerate() {
        for at in 0..function.program.statements.len() {
            let mut compiled = case.compiled.clone();
            let Statement::Called { value, slopes, .. } = &mut compiled.functions[number].program.statements[at] else {
                continue;
            };
            match &mut slopes[..] {
                [only] => std::mem::swap(value, only),
                [first, second] => std::mem::swap(first, second),
                _ => unreachable!("functions here have two arguments at most"),
            }
            let broken = &compiled.functions[number].program;
            if !differs(&function.program, broken) {
                continue;
            }
            assert_eq!(case.check(&compiled).wrong, [function.kind], "statement {at}");
            told += 1;
        }
    }
    assert!(told >= 6, "{told}");
}

/// Results of derived equations with the wrong sign, or off by a millionth: the laws between functions tell.
#[test]
fn every_break_of_derived_equations_is_told() {
    for text in MODELS {
        let mut told = 0;
        let kinds: Vec<FunctionKind> = Case::new(text).derivation.functions.iter().map(|f| f.kind).collect();
        for (number, kind) in kinds.into_iter().enumerate() {
            for factor in [-1.0, 1.000_001] {
                let mut case = Case::new(text);
                let candidate = std::mem::take(&mut case.compiled.functions[number].candidate);
                let ways = &mut case.derivation.functions[number].candidates;
                *ways = vec![ways.swap_remove(candidate)];
                let roots = &mut case.derivation.functions[number].candidates[0].1.list;
                // One that is not zero everywhere.
                let zero = multibody_engine::symbolic::graph::Scalar::ZERO;
                let Some(root) = roots.iter_mut().find(|root| **root != zero) else { continue };
                let times = case.derivation.graph.decimal(factor);
                *root = case.derivation.graph.mul(times, *root);
                let found = case.check(&case.compiled);
                assert!(found.broken.is_some(), "{} {kind:?} {factor:?}: {found:?}", case.model.name);
                let refused = verify::compile(&case.model, &case.structure, &case.derivation);
                assert!(matches!(refused, Err(optimize::Refusal::Contradiction(..))), "{kind:?}");
                told += 1;
            }
        }
        assert!(told >= 10, "{told}");
    }
}

/// The same of functions that are asked for alone: what they are compared with is derived beside them.
#[test]
fn every_break_of_a_function_alone_is_told() {
    let requests = [
        ("forward_dynamics", &[FunctionKind::ForwardDynamics][..]),
        ("inverse_dynamics", &[FunctionKind::InverseDynamics]),
        ("mass_matrix", &[FunctionKind::MassMatrix]),
        ("mass_matrix_lower", &[FunctionKind::MassMatrixLower]),
        ("bias", &[FunctionKind::Bias]),
        ("energy", &[FunctionKind::KineticEnergy, FunctionKind::PotentialEnergy]),
        ("residual", &[FunctionKind::Residual]),
        ("derivatives", &[FunctionKind::ForwardDerivatives, FunctionKind::InverseDerivatives]),
        ("impulse", &[FunctionKind::Impulse]),
        ("centroidal_momentum_matrix", &[FunctionKind::CentroidalMomentumMatrix]),
        ("momentum", &[FunctionKind::Momentum, FunctionKind::MomentumRate, FunctionKind::MomentumVelocity]),
    ];
    // Of forces that are no springs and not linear in velocities, as those of Rust are, energies say nothing.
    for text in MODELS.into_iter().filter(|&text| text != CALLING) {
        let emit = text.find("emit ").expect("functions");
        for (request, kinds) in requests {
            // What it says elsewhere: multipliers and quaternions have no momenta.
            if request == "momentum" && !text.contains("mod tree") {
                continue;
            }
            let text = format!("{}emit {request}; }}", &text[..emit]);
            for &kind in kinds {
                for factor in [-1.0, 1.000_001] {
                    let mut case = Case::new(&text);
                    let plain = case.check(&case.compiled);
                    assert!(plain.broken.is_none() && plain.unchecked.is_empty(), "{} {kind:?}", case.model.name);
                    let number = case.compiled.functions.iter().position(|f| f.kind == kind).expect("the function");
                    let candidate = case.compiled.functions[number].candidate;
                    let roots = &mut case.derivation.functions[number].candidates[candidate].1.list;
                    let zero = multibody_engine::symbolic::graph::Scalar::ZERO;
                    let root = roots.iter_mut().find(|root| **root != zero).expect("a result");
                    let times = case.derivation.graph.decimal(factor);
                    *root = case.derivation.graph.mul(times, *root);
                    let found = case.check(&case.compiled);
                    assert!(found.broken.is_some(), "{} {kind:?} {factor:?}: {found:?}", case.model.name);
                }
            }
        }
    }
}

/// Results in other slots than those that the function's value is built from, or one too few.
#[test]
fn slots_that_do_not_fit_are_told() {
    for text in MODELS {
        let case = Case::new(text);
        let misfit = |compiled: &Compiled| emit::misfit(&case.model, &case.structure, compiled);
        assert_eq!(misfit(&case.compiled), None, "{}", case.model.name);
        for number in 0..case.compiled.functions.len() {
            let kind = case.compiled.functions[number].kind;
            let mut short = case.compiled.clone();
            short.functions[number].program.results.pop();
            assert_eq!(misfit(&short), Some(kind));
            let mut other = case.compiled.clone();
            let parts = &mut other.functions[number].parts;
            *parts = Parts::default().with(Slot::Rank, Form::Vector(parts.count()));
            assert_eq!(misfit(&other), Some(kind));
        }
    }
}

fn differs(a: &Program, b: &Program) -> bool {
    let run = |program: &Program| {
        // Fields and symbols are any numbers here.
        let number = |k: usize| 0.3 + 0.17 * ((k * 7919 % 101) as f64 / 101.0);
        let symbols = |symbol| number(format!("{symbol:?}").bytes().map(usize::from).sum());
        interpreter::run(program, &symbols, &|field| number(field.0 + 3))
    };
    run(a).iter().zip(run(b)).any(|(x, y)| (x - y).abs() > 1e-9 * (x.abs() + y.abs()))
}

fn nodes(program: &Program) -> usize {
    let mut count = 0;
    let mut program = program.clone();
    each(&mut program, &mut |_| count += 1);
    count
}

/// The program with an error in the expression with this number.
fn broken(program: &Program, at: usize) -> Option<Program> {
    let mut program = program.clone();
    let (mut number, mut changed) = (0, false);
    each(&mut program, &mut |expression| {
        if number == at {
            let other = match expression {
                Expression::Literal(x) => Some(Expression::Literal(*x * 1.000_001)),
                Expression::Neg(inner) => Some((**inner).clone()),
                Expression::Sum(terms) if terms.len() > 1 => Some(Expression::Sum(terms[..terms.len() - 1].to_vec())),
                Expression::Product(_) | Expression::Symbol(_) | Expression::Field(_) => {
                    Some(Expression::Neg(Box::new(expression.clone())))
                }
                _ => None,
            };
            if let Some(other) = other {
                *expression = other;
                changed = true;
            }
        }
        number += 1;
    });
    changed.then_some(program)
}

pub(crate) fn each(program: &mut Program, visit: &mut dyn FnMut(&mut Expression)) {
    statements(&mut program.statements, visit);
    program.results.iter_mut().for_each(|result| expression(result, visit));
}

fn statements(list: &mut [Statement], visit: &mut dyn FnMut(&mut Expression)) {
    for statement in list {
        match statement {
            Statement::Let { value, .. } | Statement::Pack { value, .. } => expression(value, visit),
            Statement::PackSines(_, sine) => expression(&mut sine.angle, visit),
            Statement::Members { pack, .. } => expression(pack, visit),
            Statement::SinCos(sines) => sines.iter_mut().for_each(|sine| expression(&mut sine.angle, visit)),
            Statement::Called { arguments, .. } => arguments.iter_mut().for_each(|e| expression(e, visit)),
            Statement::Solve { size, symmetric, matrix, rhs, .. } => {
                // Of a symmetric matrix what is right of the diagonal isn't read.
                let (size, symmetric) = (*size, *symmetric);
                let read = |at: usize| !symmetric || at / size >= at % size;
                let matrix = matrix.iter_mut().enumerate().filter(|entry| read(entry.0)).map(|entry| entry.1);
                matrix.chain(rhs).for_each(|e| expression(e, visit));
            }
            Statement::Iterate { start, body, next, .. } => {
                start.iter_mut().for_each(|e| expression(e, visit));
                statements(body, visit);
                next.iter_mut().for_each(|e| expression(e, visit));
            }
        }
    }
}

fn expression(root: &mut Expression, visit: &mut dyn FnMut(&mut Expression)) {
    visit(root);
    match root {
        Expression::Neg(x) => expression(x, visit),
        Expression::Sum(terms) => terms.iter_mut().for_each(|term| expression(&mut term.1, visit)),
        Expression::Product(list) | Expression::Call(_, list) | Expression::Pack(list) => {
            list.iter_mut().for_each(|e| expression(e, visit));
        }
        Expression::Fused(operands) => operands.iter_mut().for_each(|e| expression(e, visit)),
        Expression::Quotient(a, b) => [a, b].into_iter().for_each(|e| expression(e, visit)),
        Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(Local(_)) => {}
    }
}
