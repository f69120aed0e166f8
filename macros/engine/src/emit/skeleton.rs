//! Stage `emit`: types that stand beside errors, so that one mistake doesn't cause forty.
//!
//! In: the syntax tree alone. Out: the module that the model would probably be, with all functions and no bodies: what
//! the user's code says about `Model`, `State` and their fields still resolves, and only the mistake itself is
//! reported. Guesses are made without a word; whatever can't be read is left out.

use std::collections::HashSet;
use std::rc::Rc;

use proc_macro2::{Ident, Span, TokenStream};
use syn::{Expr as Tokens, ExprLit, Lit, Path};

use super::guesses::{self, Loops};
use super::{context, module};
use crate::model::types::{
    BodyRef, Docs, Expr, ExprNode, Frame, Handling, Input, Instance, InstanceId, Joint, JointKind, Model, Orientation,
    Output, Param, PartType, PartTypeId, Place, State, Type,
};
use crate::optimize::program::{Compiled, Cost, Function, FunctionKind, Program};
use crate::syntax::tree::{Fields, Item, ItemKind, Module, Part, Source, UNREADABLE, Value};

/// Parts inside parts, and instances in all, up to here.
const DEEPEST: usize = 8;
const MOST: usize = 512;

/// Skeletons of all models of one call; parts appear inside the models that use them.
pub fn skeletons(source: &Source) -> TokenStream {
    let mut names = HashSet::new();
    source
        .modules
        .iter()
        .filter(|module| !is_part(module) && module.name != UNREADABLE)
        // Two modules of one name are an error already, unless `cfg` takes one away.
        .filter(|module| names.insert(module.name.to_string()) || has_cfg(module))
        .map(|module| build(module, source.krate.clone(), &source.modules))
        .collect()
}

/// The skeleton of one module; parts that it uses are left out, as their modules aren't known.
pub fn skeleton(module: &Module) -> TokenStream {
    build(module, None, &[])
}

fn is_part(module: &Module) -> bool {
    let mut items = module.items.iter();
    items.any(|item| matches!(item.kind, ItemKind::Port { .. }))
}

fn has_cfg(module: &Module) -> bool {
    module.attrs.iter().any(|attr| attr.path().is_ident("cfg"))
}

fn build(of: &Module, krate: Option<Path>, all: &[Module]) -> TokenStream {
    let mut guess = Guess { modules: all, root: of, model: empty(of, krate), loops: Loops::default() };
    guess.module(of, InstanceId(0), DEEPEST);
    guesses::options(&mut guess.model, of);
    let structure = guess.loops.structure(&guess.model);
    let mut compiled = Compiled::default();
    let mut kinds = vec![
        FunctionKind::ForwardDynamics,
        FunctionKind::InverseDynamics,
        FunctionKind::MassMatrix,
        FunctionKind::Bias,
        FunctionKind::KineticEnergy,
        FunctionKind::PotentialEnergy,
        FunctionKind::Outputs,
        FunctionKind::Residual,
        FunctionKind::ForwardDerivatives,
        FunctionKind::InverseDerivatives,
        FunctionKind::Impulse,
        FunctionKind::Momentum,
        FunctionKind::MomentumRate,
        FunctionKind::MomentumVelocity,
    ];
    if !structure.rows.is_empty() {
        kinds.extend([
            FunctionKind::Constraints,
            FunctionKind::ConstraintJacobian,
            FunctionKind::ConstraintRate,
            FunctionKind::ConstraintBias,
        ]);
    }
    kinds.extend((0..guess.model.kinematics.len()).map(FunctionKind::Kinematics));
    kinds.extend((structure.guesses() > 0).then_some(FunctionKind::Guess));
    compiled.functions.extend(kinds.into_iter().map(|kind| Function {
        kind,
        program: Program::default(),
        before: Cost::default(),
        after: Cost::default(),
        method: "",
    }));
    module(&context(&guess.model, &structure, &compiled, true))
}

fn empty(module: &Module, krate: Option<Path>) -> Model {
    Model {
        name: module.name.clone(),
        vis: module.vis.clone(),
        attrs: module.attrs.clone(),
        krate: krate.unwrap_or_else(runtime),
        part_types: Vec::new(),
        instances: vec![Instance {
            parent: None,
            field: module.name.clone(),
            index: None,
            part_type: None,
            docs: Docs::default(),
        }],
        params: Vec::new(),
        inputs: Vec::new(),
        states: Vec::new(),
        bodies: Vec::new(),
        joints: Vec::new(),
        tree: Vec::new(),
        cuts: Vec::new(),
        constraints: Vec::new(),
        drives: Vec::new(),
        solves: Vec::new(),
        assumptions: Vec::new(),
        handling: Handling::default(),
        independent: Vec::new(),
        skipped: Vec::new(),
        forces: Vec::new(),
        outputs: Vec::new(),
        gravity: None,
        emit: Vec::new(),
        asked: Vec::new(),
        solve_for: Vec::new(),
        kinematics: Vec::new(),
    }
}

fn runtime() -> Path {
    let mut path = Path::from(Ident::new("multibody", Span::call_site()));
    path.leading_colon = Some(syn::token::PathSep::default());
    path
}

struct Guess<'a> {
    modules: &'a [Module],
    /// The model's own module.
    root: &'a Module,
    model: Model,
    loops: Loops,
}

impl Guess<'_> {
    /// The items of a module as those of `instance`.
    fn module(&mut self, module: &Module, instance: InstanceId, depth: usize) {
        let mut taken: HashSet<String> = HashSet::new();
        for item in &module.items {
            let name = match &item.kind {
                ItemKind::Param(value) | ItemKind::Input(value) | ItemKind::Output(value) => &value.name,
                ItemKind::State { name, .. } | ItemKind::Joint { name, .. } => name,
                ItemKind::Part(part) => &part.name,
                ItemKind::Body { name, .. } => name,
                other => {
                    self.loops.item(other);
                    continue;
                }
            };
            if name != UNREADABLE && taken.insert(name.to_string()) {
                let place = Place { instance, field: name.clone() };
                self.item(module, item, place, depth);
            }
        }
    }

    fn item(&mut self, module: &Module, item: &Item, place: Place, depth: usize) {
        let docs = Docs::default();
        match &item.kind {
            ItemKind::Param(value) => {
                let ty = ty(value, module);
                let default = vec![0.0; ty.scalars()];
                self.model.params.push(Param { place, ty, default, docs });
            }
            ItemKind::Input(value) => {
                let ty = ty(value, module);
                self.model.inputs.push(Input { place, ty, docs });
            }
            ItemKind::Output(value) => {
                let value = zero(ty(value, module));
                self.model.outputs.push(Output { place, value, docs });
            }
            ItemKind::State { .. } => {
                self.model.states.push(State { place, rate: zero(Type::Scalar), start: 0.0, docs })
            }
            ItemKind::Joint { kind, fields, .. } => {
                let kind = joint_kind(kind, fields);
                self.loops.joint(kind.as_ref().map_or(0, JointKind::freedoms), item);
                if let Some(kind) = kind {
                    self.joint(place, kind);
                }
            }
            ItemKind::Body { fields, .. } => {
                self.loops.body();
                if let Some(orientation) = guesses::absolute(self.root, fields) {
                    self.loops.joint(6, item);
                    self.joint(place, JointKind::Free(orientation));
                }
            }
            ItemKind::Part(part) => self.part(module, part, place, depth),
            _ => {}
        }
    }

    fn joint(&mut self, place: Place, kind: JointKind) {
        self.model.joints.push(Joint {
            place,
            kind,
            parent: ground(),
            child: ground(),
            armature: None,
            docs: Docs::default(),
            span: Span::call_site(),
        });
    }

    fn part(&mut self, module: &Module, part: &Part, place: Place, depth: usize) {
        let Some(of) = self.modules.iter().find(|m| m.name == part.kind && is_part(m)) else {
            return;
        };
        let count = part.count.as_ref().map(|count| number(count, module).unwrap_or(1));
        let wanted = count.unwrap_or(1);
        if depth == 0 || self.model.instances.len() + wanted > MOST {
            return;
        }
        let part_type = self.part_type(of);
        for index in 0..wanted {
            let instance = InstanceId(self.model.instances.len());
            self.model.instances.push(Instance {
                parent: Some(place.instance),
                field: place.field.clone(),
                index: count.map(|count| (index, count)),
                part_type: Some(part_type),
                docs: Docs::default(),
            });
            self.module(of, instance, depth - 1);
        }
    }

    fn part_type(&mut self, module: &Module) -> PartTypeId {
        let known = self.model.part_types.iter().position(|part| part.name == module.name);
        PartTypeId(known.unwrap_or_else(|| {
            self.model.part_types.push(PartType { name: module.name.clone(), docs: Docs::default() });
            self.model.part_types.len() - 1
        }))
    }
}

/// The declared type, or the one that the value looks like.
fn ty(value: &Value, module: &Module) -> Type {
    match (&value.ty, &value.value) {
        (Some(ty), _) => declared(ty, module),
        (None, Some(Tokens::Array(array))) if array.elems.len() == 3 => Type::Vec3,
        _ => Type::Scalar,
    }
}

fn declared(ty: &syn::Type, module: &Module) -> Type {
    match ty {
        syn::Type::Path(path) => match path.path.get_ident().map(Ident::to_string).as_deref() {
            Some("Vec3") => Type::Vec3,
            Some("Rotation") => Type::Rotation,
            Some("Pose") => Type::Pose,
            Some("Twist") => Type::Twist,
            Some("Wrench") => Type::Wrench,
            Some("Jacobian") => Type::Jacobian,
            _ => Type::Scalar,
        },
        syn::Type::Array(array) => {
            let count = number(&array.len, module).filter(|count| *count <= MOST);
            Type::Array(Box::new(declared(&array.elem, module)), count.unwrap_or(1))
        }
        _ => Type::Scalar,
    }
}

/// A literal, or the name of a `const` that is one.
fn number(expr: &Tokens, module: &Module) -> Option<usize> {
    match expr {
        Tokens::Lit(ExprLit { lit: Lit::Int(literal), .. }) => literal.base10_parse().ok(),
        Tokens::Path(path) => {
            let name = path.path.get_ident()?;
            module.items.iter().find_map(|item| match &item.kind {
                ItemKind::Const(Value {
                    name: known,
                    value: Some(Tokens::Lit(ExprLit { lit: Lit::Int(literal), .. })),
                    ..
                }) if known == name => literal.base10_parse().ok(),
                _ => None,
            })
        }
        _ => None,
    }
}

fn joint_kind(kind: &Ident, fields: &Fields) -> Option<JointKind> {
    let axis = || zero(Type::Vec3);
    let orientation = || {
        let mut fields = fields.list.iter();
        let angles = fields.any(|field| {
            field.name == "coordinates" && matches!(&field.value, Tokens::Path(p) if p.path.is_ident("RollPitchYaw"))
        });
        if angles { Orientation::RollPitchYaw } else { Orientation::Quaternion }
    };
    Some(match kind.to_string().as_str() {
        "Revolute" => JointKind::Revolute { axis: axis() },
        "Prismatic" => JointKind::Prismatic { axis: axis() },
        "Screw" => JointKind::Screw { axis: axis(), pitch: zero(Type::Scalar) },
        "Cylindrical" => JointKind::Cylindrical { axis: axis() },
        "Universal" => JointKind::Universal { axes: Box::new([axis(), axis()]) },
        "Planar" => JointKind::Planar { axis: axis() },
        "Ball" => JointKind::Ball(orientation()),
        "Free" => JointKind::Free(orientation()),
        _ => return None,
    })
}

fn ground() -> Frame {
    Frame { body: BodyRef::Ground, steps: Vec::new(), span: Span::call_site() }
}

/// Nobody reads its value.
fn zero(ty: Type) -> Expr {
    Expr { node: Rc::new(ExprNode::Number(0.0)), ty, span: Span::call_site() }
}
