//! A model with closed loops, made by hand: a bead on a ring (two slides and one equation), joints of which a drive takes a
//! part, and legs whose joints are found by Newton's method. The dynamics mean nothing: every scalar is a number of its own.

#![allow(dead_code, unreachable_pub)]

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::mechanics::loops::structure::{Means, Role, Row, Step, Structure};
use multibody_engine::model::joint_kinds;
use multibody_engine::model::types::*;
use multibody_engine::optimize::program::{Compiled, Expression};
use proc_macro2::Span;

use super::samples::{
    add_joint, add_param, derived, docs, empty, expr, lit, local, minus, mul, name, number, place, program, q, set,
    sum, time, v, vector,
};

/// Coordinates in the state.
pub const DOF: usize = 10;
/// Unknowns of Newton's method.
pub const GUESSES: usize = 4;

fn coordinate(joint: usize, index: usize) -> Coordinate {
    Coordinate { joint: JointId(joint), index }
}

fn guess(index: usize) -> Expression {
    Expression::Symbol(Symbol::Guess { index })
}

fn multiplier(row: usize) -> Expression {
    Expression::Symbol(Symbol::Multiplier { row })
}

/// `first`, `first + 1`, ..
fn numbers(first: usize, count: usize) -> Vec<Expression> {
    (first..first + count).map(|i| lit(i as f64)).collect()
}

pub fn model() -> Model {
    let mut model = empty("looped");
    let slide = || &joint_kinds::PRISMATIC;
    for part in ["leg", "toe"] {
        model.part_types.push(PartType { name: name(part), docs: Docs::default() });
    }
    let instance = |field: &str, parent, index, part| Instance {
        parent: Some(InstanceId(parent)),
        field: name(field),
        index,
        part_type: Some(PartTypeId(part)),
        docs: Docs::default(),
    };
    for index in 0..2 {
        let leg = model.instances.len();
        model.instances.push(instance("legs", 0, Some((index, 2)), 0));
        model.instances.push(instance("toe", leg, None, 1));
        model.inputs.push(Input { place: place(leg, "thrust"), ty: Type::Scalar, docs: docs("N", "pushes") });
    }
    model.inputs.push(Input { place: place(0, "wind"), ty: Type::Vec3, docs: Docs::default() });
    add_param(&mut model, place(0, "radius"), Type::Scalar, &[1.0], docs("m", ""));
    model.states.push(State { place: place(0, "current"), rate: number(0.0), start: 0.25, docs: Docs::default() });
    let joints = [
        (0, "a", slide()),
        (0, "b", slide()),
        (0, "table", &joint_kinds::PLANAR),
        (0, "table_y", &joint_kinds::FIXED),
        (0, "platform", &joint_kinds::FREE),
        (0, "head", &joint_kinds::FREE_BY_ANGLES),
        (1, "gimbal", &joint_kinds::UNIVERSAL),
        (2, "hinge", slide()),
        (3, "gimbal", &joint_kinds::UNIVERSAL),
        (4, "hinge", slide()),
        (1, "ball", &joint_kinds::BALL),
        (3, "ball", &joint_kinds::BALL),
    ];
    for (instance, name, kind) in joints {
        add_joint(&mut model, place(instance, name), kind);
    }
    model.cuts = vec![JointId(10), JointId(11)];
    model.tree.retain(|joint| joint.0 < 10);
    let span = Span::call_site();
    let value = ConstraintKind::Value(number(0.0));
    model.constraints.push(Constraint {
        place: place(0, "ring"),
        kind: value,
        drive: None,
        docs: docs("m", "the bead's"),
        span,
    });
    let time = || expr(ExprNode::Time, Type::Scalar);
    let swing =
        expr(ExprNode::Mul(number(0.5), expr(ExprNode::Call(Function::Sin, vec![time()]), Type::Scalar)), Type::Scalar);
    let drive = |target, value| Drive { target, value, span };
    model.drives = vec![
        drive(DriveTarget::Coordinate(coordinate(2, 0)), swing),
        drive(DriveTarget::Orientation(JointId(4)), number(0.0)),
        drive(DriveTarget::Position(JointId(5)), vector([0.0; 3])),
    ];
    let reach = ExprNode::Coordinate { joint: JointId(6), index: 0, order: Order::Position };
    model.assumptions =
        vec![expr(ExprNode::Compare(Comparison::Greater, expr(reach, Type::Scalar), number(0.0)), Type::Bool)];
    model.remarks = vec!["`#[cut]` on `legs[0].ball` says nothing new".to_string()];
    model.solve_for = [1, 0].map(|input| SolveFor { input: InputId(input), element: 0, span }).to_vec();
    model.kinematics = vec![
        Kinematics { given: vec![JointId(0)], find: vec![coordinate(6, 0), coordinate(6, 1)], span },
        Kinematics { given: vec![JointId(0)], find: vec![coordinate(7, 0)], span },
    ];
    model
}

pub fn structure(model: &Model) -> Structure {
    let mut structure = Structure::open(model);
    let state = [(0, 0), (1, 0), (2, 1), (2, 2), (4, 0), (4, 1), (4, 2), (5, 3), (5, 4), (5, 5)];
    structure.state = state.map(|(joint, index)| coordinate(joint, index)).to_vec();
    for (joint, roles) in structure.roles.iter_mut().enumerate() {
        for (index, role) in roles.iter_mut().enumerate() {
            *role = match joint {
                _ if state.contains(&(joint, index)) => Role::State,
                2 => Role::Driven(0),
                4 => Role::Driven(1),
                5 => Role::Driven(2),
                6 | 8 => Role::Dependent(0),
                _ => Role::Dependent(1),
            };
        }
    }
    let row = |closing, index| Row { closing, index };
    let ring = LoopClosure::Constraint(ConstraintId(0));
    structure.rows = vec![row(ring, 0)];
    structure.dropped = vec![row(LoopClosure::Cut(JointId(11)), 2)];
    let rows = [10, 10, 11, 11]
        .into_iter()
        .zip([0, 1, 0, 1])
        .map(|(joint, index)| row(LoopClosure::Cut(JointId(joint)), index));
    structure.steps = vec![
        Step {
            unknowns: vec![coordinate(6, 0), coordinate(6, 1), coordinate(8, 0), coordinate(8, 1)],
            means: Means::Newton { rows: rows.collect(), guess: 0 },
        },
        Step { unknowns: vec![coordinate(7, 0)], means: Means::Linear(ConstraintId(0)) },
        Step { unknowns: vec![coordinate(9, 0)], means: Means::Linear(ConstraintId(0)) },
    ];
    structure.dead_centres = vec![coordinate(6, 0), coordinate(7, 0)];
    structure.notes = vec!["`legs[_].ball` closes the loop: the cheapest joint".to_string()];
    structure
}

pub fn looped() -> (Model, Structure, Compiled) {
    let model = model();
    let structure = structure(&model);
    let square = |of: fn(usize, usize) -> Expression| sum(&[mul(&[of(0, 0), of(0, 0)]), mul(&[of(1, 0), of(1, 0)])]);
    let mut jacobian = vec![lit(0.0); DOF];
    jacobian[0] = q(0, 0);
    jacobian[1] = q(1, 0);
    let forward = [numbers(1, DOF), vec![lit(0.75)], vec![sum(&[lit(100.0), guess(3)]), lit(1.0), lit(1e-9)]].concat();
    let mut residual: Vec<Expression> = numbers(0, DOF);
    residual[0] = mul(&[q(0, 0), multiplier(0)]);
    residual.push(square(q));
    let closed = (0..GUESSES).map(|index| sum(&[guess(index), lit(1.0 + index as f64)])).chain([lit(0.125)]);
    let function = |kind, results| derived(kind, program(&[], vec![], results));
    let compiled = Compiled {
        checks: Default::default(),
        inertia: Default::default(),
        sound: true,
        unchecked: Vec::new(),
        functions: vec![
            function(FunctionKind::ForwardDynamics, forward),
            // The inputs looked for in the order of `solve_for`: the second leg's, then the first one's.
            function(FunctionKind::InverseDynamics, vec![lit(22.0), lit(11.0), lit(2.0)]),
            function(FunctionKind::MassMatrix, numbers(0, DOF * DOF)),
            function(FunctionKind::Constraints, vec![mul(&[lit(0.5), minus(square(q), lit(1.0))])]),
            function(FunctionKind::ConstraintJacobian, jacobian),
            function(FunctionKind::ConstraintRate, vec![sum(&[mul(&[q(0, 0), v(0, 0)]), mul(&[q(1, 0), v(1, 0)])])]),
            derived(
                FunctionKind::ConstraintBias,
                program(&["guess"], vec![set(0, square(v))], vec![mul(&[lit(1.0), local(0)])]),
            ),
            function(FunctionKind::Residual, residual),
            function(FunctionKind::Kinematics(0), vec![q(2, 1), q(4, 2), v(2, 2), v(5, 4), q(5, 3), time(), lit(0.0)]),
            function(FunctionKind::Kinematics(1), numbers(7, 4)),
            function(FunctionKind::Guess, closed.collect()),
            function(FunctionKind::DeadCentres, vec![sum(&[q(0, 0), time()]), lit(0.5)]),
        ],
        ..Compiled::default()
    };
    (model, structure, compiled)
}
