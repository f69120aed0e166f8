//! Stage `emit`: what there is to say of a model, before it is written in any language.
//!
//! In: the checked model, its structure and its programs. Out: [`Facts`]: names, units, texts, counts. The report in the
//! module's documentation is written from them, and so is what tools print. Lists stand in the order of the model and have
//! one entry for each of its items, so that the number of a body or a joint finds it. Texts are Markdown of the user's, or
//! sentences with names between backticks.

use crate::contracts::function::FunctionKind;
use crate::emit::Context;
use crate::emit::items::separable::is_separable;
use crate::emit::layout::{Layout, joints};
use crate::emit::print::{literals, range};
use crate::model::types::{Body, BodyRef, Coordinate, Docs, ExprNode, Force, ForceKind, Frame, JointId, Place, Type};

use super::{advice, formula, loops, unchecked, values};

/// What is said of a model.
pub struct Facts {
    /// The user's own text, line by line.
    pub text: Vec<String>,
    pub params: Vec<Declared>,
    pub states: Vec<Declared>,
    pub inputs: Vec<Declared>,
    pub outputs: Vec<Declared>,
    pub bodies: Vec<BodyFact>,
    /// Those that close loops among them.
    pub joints: Vec<JointFact>,
    pub forces: Vec<ForceFact>,
    /// Names of rods and expressions that hold coordinates together.
    pub constraints: Vec<String>,
    pub closings: Vec<ClosingFact>,
    /// How loops are closed, what is driven, left out and assumed.
    pub loops: Vec<String>,
    /// What is left out of them; it stands among `loops` too.
    pub left_out: Option<String>,
    /// What the ways to close loops cost, where that was asked for. It stands among `loops` too.
    pub advice: Vec<String>,
    /// What stands in the model several times.
    pub repeated: Vec<String>,
    /// Names of the state's velocity coordinates.
    pub coordinates: Vec<String>,
    /// Names of the equations that keep multipliers.
    pub equations: Vec<String>,
    /// Numbers that `f32` doesn't hold.
    pub beyond_single: Vec<String>,
    /// Numbers of functions that are told of among those of the model.
    pub functions: Vec<usize>,
    pub is_separable: bool,
    /// What could not be checked in numbers, and why.
    pub unchecked: Vec<String>,
    /// Choices that the model leaves to the language.
    pub defaults: Vec<String>,
}

/// A parameter, state, input or output.
pub struct Declared {
    pub name: String,
    pub unit: Option<String>,
    /// The default or the start; the type of what has none.
    pub value: String,
    pub text: String,
}

pub struct BodyFact {
    pub name: String,
    /// `rigid body`
    pub inertia: &'static str,
    /// As the user wrote it.
    pub mass: String,
    pub text: String,
}

pub struct JointFact {
    pub name: String,
    pub kind: &'static str,
    /// What it stands on; nothing for the ground.
    pub parent: Option<String>,
    pub child: Option<String>,
    /// `2 of 3` of them are in the state.
    pub freedoms: String,
    pub closes: bool,
    pub text: String,
}

pub struct ForceFact {
    pub name: String,
    /// `effort`
    pub kind: &'static str,
    /// What it acts on, and what between.
    pub on: String,
    pub text: String,
}

/// What closes a loop.
pub struct ClosingFact {
    pub name: String,
    pub kind: &'static str,
    /// What it is between; nothing for the ground, an empty text where it is between nothing.
    pub between: [Option<String>; 2],
    /// `5, solved`
    pub equations: String,
    pub text: String,
}

impl Facts {
    pub(in crate::emit) fn new(context: &Context<'_>) -> Facts {
        let layout = &context.layout;
        let model = layout.model;
        let functions = context.compiled.functions.iter().enumerate();
        let functions = functions.filter(|(_, f)| f.kind != FunctionKind::Outputs || !model.outputs.is_empty());
        Facts {
            text: model.attrs.iter().filter_map(doc_text).collect(),
            params: model.params.iter().map(|p| declared(layout, &p.place, &p.docs, values(&p.default))).collect(),
            states: model.states.iter().map(|s| declared(layout, &s.place, &s.docs, values(&[s.start]))).collect(),
            inputs: model.inputs.iter().map(|i| declared(layout, &i.place, &i.docs, ty(&i.ty))).collect(),
            outputs: model.outputs.iter().map(|o| declared(layout, &o.place, &o.docs, ty(&o.value.ty))).collect(),
            bodies: model.bodies.iter().map(|body| body_fact(layout, body)).collect(),
            joints: (0..model.joints.len()).map(|number| joint_fact(layout, JointId(number))).collect(),
            forces: force_facts(layout),
            constraints: model.constraints.iter().map(|constraint| layout.name(&constraint.place)).collect(),
            closings: loops::closings(layout),
            loops: loops::items(context),
            left_out: loops::left_out(context),
            advice: advice::items(context),
            repeated: layout.structure.groups.iter().map(|group| group.sentence()).collect(),
            coordinates: layout.coordinates(),
            equations: layout.structure.rows.iter().map(|row| layout.row(*row)).collect(),
            beyond_single: range::beyond_single(context).into_iter().map(literals::text).collect(),
            functions: functions.map(|(number, _)| number).collect(),
            is_separable: is_separable(context),
            unchecked: unchecked::items(context),
            defaults: defaults(layout),
        }
    }
}

/// The text of a `#[doc = ".."]`.
pub(super) fn doc_text(attr: &syn::Attribute) -> Option<String> {
    let syn::Meta::NameValue(pair) = &attr.meta else { return None };
    match &pair.value {
        syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) if pair.path.is_ident("doc") => {
            let text = text.value();
            Some(text.strip_prefix(' ').map_or(text.clone(), str::to_string))
        }
        _ => None,
    }
}

fn declared(layout: &Layout<'_>, place: &Place, docs: &Docs, value: String) -> Declared {
    Declared { name: layout.name(place), unit: docs.unit.clone(), value, text: text(docs) }
}

/// The first paragraph, in one line.
pub(super) fn text(docs: &Docs) -> String {
    let lines = super::text(docs);
    let first: Vec<&str> = lines.iter().map(String::as_str).take_while(|line| !line.is_empty()).collect();
    first.join(" ")
}

fn ty(ty: &Type) -> String {
    match ty {
        Type::Scalar => "scalar".to_string(),
        Type::Bool => "condition".to_string(),
        Type::Vec3 => "vector".to_string(),
        Type::Rotation => "rotation".to_string(),
        Type::Pose => "pose".to_string(),
        Type::Twist => "twist".to_string(),
        Type::Wrench => "wrench".to_string(),
        Type::Jacobian => "Jacobian".to_string(),
        Type::Array(element, count) => format!("{count} of {}", self::ty(element)),
    }
}

/// The body that a frame is fixed to; nothing for the ground.
pub(super) fn carrier(layout: &Layout<'_>, frame: &Frame) -> Option<String> {
    match frame.body {
        BodyRef::Ground => None,
        BodyRef::Body(body) => Some(layout.name(&layout.model.bodies[body].place)),
    }
}

fn body_fact(layout: &Layout<'_>, body: &Body) -> BodyFact {
    let inertia = match (&body.mass.node.as_ref(), &body.inertia) {
        (ExprNode::Number(mass), None) if *mass == 0.0 => "massless",
        (_, None) => "point mass",
        _ => "rigid body",
    };
    let mass = formula::text(layout, &body.mass);
    BodyFact { name: layout.name(&body.place), inertia, mass, text: text(&body.docs) }
}

fn joint_fact(layout: &Layout<'_>, id: JointId) -> JointFact {
    let model = layout.model;
    let joint = &model.joints[id];
    let closes = model.cuts.contains(&id);
    let all = joint.kind.freedoms();
    let freedoms = if closes {
        String::new()
    } else {
        let held = joints::held(model, &layout.structure.state, id).iter().filter(|held| **held).count();
        if held == all { all.to_string() } else { format!("{held} of {all}") }
    };
    JointFact {
        name: layout.name(&joint.place),
        kind: joint.kind.word,
        parent: carrier(layout, &joint.parent),
        child: carrier(layout, &joint.child),
        freedoms,
        closes,
        text: text(&joint.docs),
    }
}

fn force_facts(layout: &Layout<'_>) -> Vec<ForceFact> {
    let model = layout.model;
    let body = |frame: &Frame| carrier(layout, frame).map_or_else(|| "ground".to_owned(), |name| format!("`{name}`"));
    let joint = |joint: JointId| format!("`{}`", layout.name(&model.joints[joint].place));
    let fact = |force: &Force| {
        let (kind, on) = match &force.kind {
            ForceKind::Effort { joint: id, .. } => ("effort", joint(*id)),
            ForceKind::JointSpring { joint: id, coordinate, .. } => {
                let coordinate = Coordinate { joint: *id, index: *coordinate };
                ("spring, damper", format!("`{}`", layout.coordinate(coordinate)))
            }
            ForceKind::LineSpring { between, .. } => {
                let [a, b] = &**between;
                ("spring, damper", format!("{} to {}", body(a), body(b)))
            }
            ForceKind::Force { at, .. } => ("force", body(at)),
            ForceKind::Torque { at, .. } => ("torque", body(at)),
        };
        ForceFact { name: layout.name(&force.place), kind, on, text: text(&force.docs) }
    };
    model.forces.iter().map(fact).collect()
}

/// `legs[_].m` for `legs[2].m`
fn general(name: &str) -> String {
    let mut general = String::new();
    for (number, piece) in name.split('[').enumerate() {
        match piece.split_once(']') {
            Some((_, after)) if number > 0 => general = format!("{general}[_]{after}"),
            _ => general.push_str(piece),
        }
    }
    general
}

fn defaults(layout: &Layout<'_>) -> Vec<String> {
    let model = layout.model;
    let mut lines = Vec::new();
    if model.gravity.is_none() {
        lines.push("no gravity".to_string());
    }
    let mut list = |what: &str, places: Vec<&Place>| {
        let mut names: Vec<String> = Vec::new();
        for place in places {
            let name = format!("`{}`", general(&layout.name(place)));
            if !names.contains(&name) {
                names.push(name);
            }
        }
        if !names.is_empty() {
            lines.push(format!("{what}: {}", names.join(", ")));
        }
    };
    let in_tree = model.joints.iter().enumerate().filter(|(number, _)| !model.cuts.contains(&JointId(*number)));
    let quaternions = in_tree.map(|(_, joint)| joint).filter(|joint| joint.kind.has_quaternion());
    list("orientation by quaternions", quaternions.map(|joint| &joint.place).collect());
    let at_origin = model.bodies.iter().filter(|body| is_zero(body));
    list("centre of mass at the body's origin", at_origin.map(|body| &body.place).collect());
    lines
}

fn is_zero(body: &Body) -> bool {
    let number = |node: &ExprNode| matches!(node, ExprNode::Number(value) if *value == 0.0);
    match body.com.node.as_ref() {
        ExprNode::Vec3(components) => components.iter().all(|c| number(&c.node)),
        _ => false,
    }
}
