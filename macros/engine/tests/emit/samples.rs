//! Models and programs made by hand, for the tests of the `emit` stage.

#![allow(dead_code, unreachable_pub)]

use multibody_engine::contracts::call::Call;
use multibody_engine::contracts::cost::Cost;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::results::Parts;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::invariant::index_vec::IndexVec;
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::joint_kinds::{self, JointKind, Written};
use multibody_engine::model::types::*;
use multibody_engine::optimize::program::{
    Compiled, Expression, FieldId, Function as Derived, Local, Program, Sine, Statement,
};
use proc_macro2::{Ident, Span, TokenStream};
use syn::parse_quote;

pub fn name(text: &str) -> Ident {
    Ident::new(text, Span::call_site())
}

pub fn docs(unit: &str, text: &str) -> Docs {
    Docs {
        unit: (!unit.is_empty()).then(|| unit.to_string()),
        text: text.lines().map(|line| format!(" {line}")).collect(),
    }
}

pub fn place(instance: usize, field: &str) -> Place {
    Place { instance: InstanceId(instance), field: name(field) }
}

pub fn expr(node: ExprNode, ty: Type) -> Expr {
    Expr::new(node, ty, Span::call_site())
}

pub fn number(value: f64) -> Expr {
    expr(ExprNode::Number(value), Type::Scalar)
}

pub fn vector(v: [f64; 3]) -> Expr {
    expr(ExprNode::Vec3(v.map(number)), Type::Vec3)
}

pub fn param(id: usize) -> Expr {
    expr(ExprNode::Param(ParamId(id)), Type::Scalar)
}

/// The module of a model without loops.
pub fn emit(model: &Model, compiled: &Compiled) -> TokenStream {
    multibody_engine::emit::emit(model, &Structure::open(model), compiled)
}

/// A model of nothing.
pub fn empty(module: &str) -> Model {
    Model {
        name: name(module),
        vis: parse_quote!(pub),
        attrs: vec![parse_quote!(#[doc = " A model made by hand."])],
        krate: parse_quote!(::multibody),
        fused: false,
        serialised: false,
        externals: std::rc::Rc::default(),
        part_types: IndexVec::new(),
        instances: IndexVec::from(vec![Instance {
            parent: None,
            field: name(module),
            index: None,
            part_type: None,
            docs: Docs::default(),
        }]),
        params: IndexVec::new(),
        inputs: IndexVec::new(),
        states: IndexVec::new(),
        bodies: IndexVec::new(),
        joints: IndexVec::new(),
        tree: Vec::new(),
        cuts: Vec::new(),
        constraints: IndexVec::new(),
        drives: Vec::new(),
        solves: Vec::new(),
        assumptions: Vec::new(),
        handling: Handling::default(),
        rounds: None,
        packs: Packs::default(),
        speeds: Vec::new(),
        speed_choice: SpeedChoice::Written,
        independent: Vec::new(),
        remarks: Vec::new(),
        small: Vec::new(),
        forces: IndexVec::new(),
        outputs: Vec::new(),
        gravity: None,
        emit: vec![Request::ForwardDynamics],
        asked: Vec::new(),
        solve_for: Vec::new(),
        kinematics: Vec::new(),
        assembly: None,
        output_groups: Vec::new(),
        at: Vec::new(),
    }
}

pub fn add_param(model: &mut Model, place: Place, ty: Type, default: &[f64], docs: Docs) -> ParamId {
    model.params.push(Param { place, ty, default: default.to_vec(), docs });
    ParamId(model.params.len() - 1)
}

pub fn add_joint(model: &mut Model, place: Place, kind: &'static JointKind) -> JointId {
    let id = JointId(model.joints.len());
    let frame = |body| Frame { body, steps: Vec::new(), span: Span::call_site() };
    let parent = match model.bodies.len() {
        0 => BodyRef::Ground,
        count => BodyRef::Body(BodyId(count - 1)),
    };
    let directions = match kind.written {
        Written::Frame => Directions::Frame,
        Written::Axis | Written::Plane => Directions::Axis(vector([0.0, 0.0, 1.0])),
        Written::Slot => Directions::Slot(Box::new([vector([0.0, 0.0, 1.0]), vector([1.0, 0.0, 0.0])])),
        Written::Crossed => Directions::Crossed(Box::new([vector([1.0, 0.0, 0.0]), vector([0.0, 1.0, 0.0])])),
    };
    model.joints.push(Joint {
        place: place.clone(),
        kind,
        directions,
        pitch: kind.has_pitch.then(|| number(0.1)),
        parent: frame(parent),
        child: frame(BodyRef::Body(BodyId(model.bodies.len()))),
        armature: None,
        docs: Docs::default(),
        span: Span::call_site(),
    });
    model.bodies.push(Body {
        place: Place { instance: place.instance, field: name(&format!("body_of_{}", place.field)) },
        mass: number(1.0),
        com: vector([0.0; 3]),
        inertia: None,
        docs: Docs::default(),
        span: Span::call_site(),
    });
    model.tree.push(id);
    id
}

pub fn add_output(model: &mut Model, place: Place, ty: Type, docs: Docs) {
    model.outputs.push(Output { place, value: expr(ExprNode::Number(0.0), ty), docs });
}

pub fn revolute() -> &'static JointKind {
    &joint_kinds::REVOLUTE
}

// Expressions.

pub fn lit(value: f64) -> Expression {
    Expression::Literal(value)
}

pub fn local(number: usize) -> Expression {
    Expression::Local(Local(number))
}

pub fn field(number: usize) -> Expression {
    Expression::Field(FieldId(number))
}

pub fn q(joint: usize, component: usize) -> Expression {
    Expression::Symbol(Symbol::Position { joint: JointId(joint), component })
}

pub fn v(joint: usize, component: usize) -> Expression {
    Expression::Symbol(Symbol::Velocity { joint: JointId(joint), component })
}

pub fn accel(joint: usize, component: usize) -> Expression {
    Expression::Symbol(Symbol::Acceleration { joint: JointId(joint), component })
}

pub fn p(param: usize, element: usize) -> Expression {
    Expression::Symbol(Symbol::Param { param: ParamId(param), element })
}

pub fn u(input: usize, element: usize) -> Expression {
    Expression::Symbol(Symbol::Input { input: InputId(input), element })
}

pub fn x(state: usize) -> Expression {
    Expression::Symbol(Symbol::State { state: StateId(state) })
}

pub fn time() -> Expression {
    Expression::Symbol(Symbol::Time)
}

pub fn neg(a: Expression) -> Expression {
    Expression::Neg(Box::new(a))
}

pub fn sum(terms: &[Expression]) -> Expression {
    Expression::Sum(terms.iter().map(|term| (false, term.clone())).collect())
}

pub fn minus(a: Expression, b: Expression) -> Expression {
    Expression::Sum(vec![(false, a), (true, b)])
}

pub fn mul(factors: &[Expression]) -> Expression {
    Expression::Product(factors.to_vec())
}

pub fn div(a: Expression, b: Expression) -> Expression {
    Expression::Quotient(Box::new(a), Box::new(b))
}

pub fn call(call: Call, arguments: &[Expression]) -> Expression {
    Expression::Call(call, arguments.to_vec())
}

/// A program whose locals are named and defined in order.
pub fn program(locals: &[&str], statements: Vec<Statement>, results: Vec<Expression>) -> Program {
    Program {
        locals: locals.iter().map(|name| (*name).to_string()).collect(),
        statements,
        results,
        ..Program::default()
    }
}

pub fn set(number: usize, value: Expression) -> Statement {
    Statement::Let { local: Local(number), value }
}

pub fn sin_cos(sin: usize, cos: usize, angle: Expression) -> Statement {
    Statement::SinCos(vec![Sine { sin: Local(sin), cos: Local(cos), angle }])
}

pub fn derived(kind: FunctionKind, program: Program) -> Derived {
    Derived {
        kind,
        parts: Parts::default(),
        program,
        before: Cost { add: 7, mul: 9, div: 1, sqrt: 0, sincos: 1, compare: 0, other: 0 },
        after: Cost { add: 0, mul: 1, div: 0, sqrt: 0, sincos: 1, compare: 0, other: 0 },
        method: "articulated body",
        candidate: 0,
        rivals: Vec::new(),
    }
}

/// A rod of length `l` on a hinge: `a = -3 g / (2 l) sin(q)`.
pub fn pendulum() -> (Model, Compiled) {
    let mut model = empty("pendulum");
    model.gravity = Some(vector([0.0, -9.81, 0.0]));
    let m = add_param(&mut model, place(0, "m"), Type::Scalar, &[1.0], docs("kg", "of the rod"));
    let l = add_param(&mut model, place(0, "l"), Type::Scalar, &[2.0], docs("m", ""));
    add_joint(&mut model, place(0, "hinge"), revolute());
    let of = |id: ParamId| param(id.0);
    let square = expr(ExprNode::Mul(of(l), of(l)), Type::Scalar);
    let third = expr(ExprNode::Div(expr(ExprNode::Mul(of(m), square), Type::Scalar), number(12.0)), Type::Scalar);
    model.bodies[BodyId(0)].mass = of(m);
    model.bodies[BodyId(0)].inertia =
        Some(Box::new([third.clone(), number(0.0), third, number(0.0), number(0.0), number(0.0)]));
    add_output(&mut model, place(0, "height"), Type::Scalar, docs("m", "of the tip"));
    let compiled = Compiled {
        fields: vec!["g_by_l".into(), "inertia".into(), "l".into(), "moment".into()],
        prelude: program(
            &["l_squared"],
            vec![set(0, mul(&[p(1, 0), p(1, 0)]))],
            vec![
                div(lit(1.5 * 9.81), p(1, 0)),
                div(mul(&[p(0, 0), local(0)]), lit(3.0)),
                p(1, 0),
                mul(&[lit(0.5 * 9.81), p(0, 0), p(1, 0)]),
            ],
        ),
        prelude_cost: Cost { mul: 4, div: 2, ..Cost::default() },
        checks: Default::default(),
        at: None,
        inertia: Default::default(),
        sound: true,
        unchecked: Vec::new(),
        functions: vec![
            derived(
                FunctionKind::ForwardDynamics,
                program(
                    &["sin_hinge", "cos_hinge"],
                    vec![sin_cos(0, 1, q(0, 0))],
                    vec![mul(&[neg(field(0)), local(0)])],
                ),
            ),
            derived(
                FunctionKind::InverseDynamics,
                program(
                    &["sin_hinge", "cos_hinge"],
                    vec![sin_cos(0, 1, q(0, 0))],
                    vec![sum(&[mul(&[field(1), accel(0, 0)]), mul(&[field(3), local(0)])])],
                ),
            ),
            derived(FunctionKind::MassMatrix, program(&[], vec![], vec![field(1)])),
            derived(
                FunctionKind::Bias,
                program(&["sin_hinge", "cos_hinge"], vec![sin_cos(0, 1, q(0, 0))], vec![mul(&[field(3), local(0)])]),
            ),
            derived(
                FunctionKind::KineticEnergy,
                program(&["energy"], vec![set(0, mul(&[lit(0.5), field(1), v(0, 0), v(0, 0)]))], vec![local(0)]),
            ),
            derived(
                FunctionKind::PotentialEnergy,
                program(
                    &["sin_hinge", "cos_hinge"],
                    vec![sin_cos(0, 1, q(0, 0))],
                    vec![mul(&[neg(field(3)), local(1)])],
                ),
            ),
            derived(
                FunctionKind::Outputs,
                program(
                    &["sin_hinge", "cos_hinge"],
                    vec![sin_cos(0, 1, q(0, 0))],
                    vec![neg(mul(&[field(2), local(1)]))],
                ),
            ),
        ],
    };
    (model, compiled)
}

/// One of everything: all joint kinds, an array of parts with parts inside, arrays of vectors, own states, inputs, and
/// outputs of every type. What is computed means nothing; every symbol is read.
pub fn zoo() -> (Model, Compiled) {
    let mut model = empty("zoo");
    for part in ["leg", "foot"] {
        model.part_types.push(PartType { name: name(part), docs: Docs::default() });
    }
    for index in 0..2 {
        let leg = model.instances.len();
        model.instances.push(Instance {
            parent: Some(InstanceId(0)),
            field: name("legs"),
            index: Some((index, 2)),
            part_type: Some(PartTypeId(0)),
            docs: Docs::default(),
        });
        model.instances.push(Instance {
            parent: Some(InstanceId(leg)),
            field: name("foot"),
            index: None,
            part_type: Some(PartTypeId(1)),
            docs: Docs::default(),
        });
        add_param(&mut model, place(leg, "m"), Type::Scalar, &[0.1 + index as f64], docs("kg", ""));
        add_param(&mut model, place(leg + 1, "R"), Type::Scalar, &[0.2], docs("m", "radius | of\nthe foot"));
        model.inputs.push(Input { place: place(leg, "thrust"), ty: Type::Scalar, docs: docs("N", "pushes") });
        model.states.push(State { place: place(leg, "current"), rate: number(0.0), start: 0.25, docs: docs("A", "") });
        add_output(&mut model, place(leg, "reach"), Type::Scalar, docs("m", ""));
        add_joint(&mut model, place(leg, "gimbal"), &joint_kinds::UNIVERSAL);
        add_joint(&mut model, place(leg, "stroke"), &joint_kinds::PRISMATIC);
        add_joint(&mut model, place(leg + 1, "sole"), &joint_kinds::BALL);
    }
    let corners = Type::Array(Box::new(Type::Vec3), 2);
    add_param(&mut model, place(0, "corners"), corners, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], docs("m", ""));
    add_param(&mut model, place(0, "pi"), Type::Scalar, &[std::f64::consts::PI], Docs::default());
    add_param(&mut model, place(0, "about_pi"), Type::Scalar, &[314.0 / 100.0], Docs::default());
    model.inputs.push(Input { place: place(0, "wind"), ty: Type::Vec3, docs: Docs::default() });
    let kinds = [
        ("mount", &joint_kinds::FIXED),
        ("base", &joint_kinds::FREE),
        ("float", &joint_kinds::FREE_BY_ANGLES),
        ("neck", &joint_kinds::BALL_BY_ANGLES),
        ("slide", &joint_kinds::PLANAR),
        ("rod", &joint_kinds::CYLINDRICAL),
        ("pin", &joint_kinds::PIN_SLOT),
        ("thread", &joint_kinds::SCREW),
        ("type_", revolute()),
    ];
    for (name, kind) in kinds {
        add_joint(&mut model, place(0, name), kind);
    }
    let types = [
        ("scalar", Type::Scalar),
        ("vector", Type::Vec3),
        ("rotation", Type::Rotation),
        ("pose", Type::Pose),
        ("twist", Type::Twist),
        ("wrench", Type::Wrench),
        ("jacobian", Type::Jacobian),
        ("many", Type::Array(Box::new(Type::Vec3), 2)),
    ];
    for (name, ty) in types {
        add_output(&mut model, place(0, name), ty, Docs::default());
    }
    let compiled = everything_read(&model);
    (model, compiled)
}

/// Functions of the right sizes whose every result is a sum of some symbols.
fn everything_read(model: &Model) -> Compiled {
    let positions: Vec<Expression> = joint_symbols(model, true, q);
    let velocities: Vec<Expression> = joint_symbols(model, false, v);
    let accelerations: Vec<Expression> = joint_symbols(model, false, accel);
    let params: Vec<Expression> = (0..model.params.len())
        .flat_map(|i| (0..model.params[ParamId(i)].ty.scalars()).map(move |e| p(i, e)))
        .collect();
    let inputs: Vec<Expression> = (0..model.inputs.len())
        .flat_map(|i| (0..model.inputs[InputId(i)].ty.scalars()).map(move |e| u(i, e)))
        .collect();
    let states: Vec<Expression> = (0..model.states.len()).map(x).collect();
    let dof = velocities.len();
    let outputs = 1 + 1 + 1 + 3 + 9 + 7 + 6 + 6 + 6 * dof + 6;
    let mut all = positions.clone();
    all.extend(velocities);
    all.extend(inputs);
    all.extend(states.clone());
    all.push(time());
    let mut with_accel = all.clone();
    with_accel.extend(accelerations);
    let function = |kind, count: usize, symbols: &[Expression]| {
        let results = (0..count)
            .map(|i| {
                let chosen: Vec<Expression> = symbols
                    .iter()
                    .enumerate()
                    .filter(|(j, _)| j % count == i || (i + j) % 7 == 0)
                    .map(|(j, symbol)| mul(&[lit(0.5 + j as f64), symbol.clone()]))
                    .chain([lit(i as f64), field(0)])
                    .collect();
                sum(&chosen)
            })
            .collect();
        derived(kind, program(&[], vec![], results))
    };
    Compiled {
        fields: vec!["total".into()],
        prelude: program(&[], vec![], vec![sum(&params)]),
        prelude_cost: Cost::default(),
        checks: Default::default(),
        at: None,
        inertia: Default::default(),
        sound: true,
        unchecked: Vec::new(),
        functions: vec![
            function(FunctionKind::ForwardDynamics, dof + states.len(), &all),
            function(FunctionKind::InverseDynamics, dof, &with_accel),
            function(FunctionKind::MassMatrix, dof * dof, &positions),
            function(FunctionKind::Bias, dof, &all),
            function(FunctionKind::KineticEnergy, 1, &positions),
            function(FunctionKind::PotentialEnergy, 1, &all),
            function(FunctionKind::Outputs, outputs, &all),
        ],
    }
}

fn joint_symbols(model: &Model, position: bool, symbol: fn(usize, usize) -> Expression) -> Vec<Expression> {
    let mut symbols = Vec::new();
    for (number, joint) in model.joints.iter().enumerate() {
        let count = joint.kind.freedoms() + usize::from(position && joint.kind.has_quaternion());
        symbols.extend((0..count).map(|component| symbol(number, component)));
    }
    symbols
}

/// Neither parameters nor coordinates.
pub fn nothing() -> (Model, Compiled) {
    let mut model = empty("nothing");
    add_joint(&mut model, place(0, "weld"), &joint_kinds::FIXED);
    let none = || program(&[], vec![], vec![]);
    let compiled = Compiled {
        checks: Default::default(),
        inertia: Default::default(),
        sound: true,
        unchecked: Vec::new(),
        functions: vec![
            derived(FunctionKind::ForwardDynamics, none()),
            derived(FunctionKind::InverseDynamics, none()),
            derived(FunctionKind::MassMatrix, none()),
            derived(FunctionKind::Bias, none()),
            derived(FunctionKind::KineticEnergy, program(&[], vec![], vec![lit(0.0)])),
            derived(FunctionKind::Outputs, none()),
        ],
        ..Compiled::default()
    };
    (model, compiled)
}

/// One coordinate and `count` statements, each of which reads the one before and one from far away.
pub fn long(count: usize) -> (Model, Compiled) {
    let mut model = empty("long");
    add_joint(&mut model, place(0, "hinge"), revolute());
    let mut locals = Vec::new();
    let mut statements = Vec::new();
    for i in 0..count {
        locals.push(format!("value_{i}"));
        let near = if i == 0 { q(0, 0) } else { local(i - 1) };
        let far = if i < 1000 { v(0, 0) } else { local(i - 1000) };
        let value = sum(&[mul(&[lit(0.5), near]), mul(&[lit(0.25), far])]);
        statements.push(set(i, value));
    }
    let compiled = Compiled {
        checks: Default::default(),
        inertia: Default::default(),
        sound: true,
        unchecked: Vec::new(),
        functions: vec![derived(
            FunctionKind::ForwardDynamics,
            Program { locals, statements, results: vec![local(count - 1)], ..Program::default() },
        )],
        ..Compiled::default()
    };
    (model, compiled)
}
