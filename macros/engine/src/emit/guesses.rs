//! Stage `emit`: what stands beside errors, its loops: how many equations a mechanism with mistakes would probably have.
//!
//! In: bodies, joints and options as written. Out: a [`Structure`] with every joint in the state and as many equations as
//! joints too many would give, so that methods and fields of loops exist, and the sizes of unsolved kinematics.

use syn::{Expr as Tokens, Member};

use crate::mechanics::structure::{Means, Row, Step, Structure};
use crate::model::types::{
    Closing, ConstraintId, Coordinate, Handling, InputId, JointId, Kinematics, Model, Orientation, SolveFor,
};
use crate::syntax::tree::{Fields, Item, ItemKind, Module};

/// As many equations are made up.
const MOST: usize = 512;

/// What is counted while the items are read.
#[derive(Default)]
pub(super) struct Loops {
    bodies: usize,
    /// Equations that each joint would give if it closed a loop; whether it is marked to.
    joints: Vec<(usize, bool)>,
    constraints: usize,
    /// Whether loops are solved by `solve` items.
    solves: bool,
}

impl Loops {
    pub(super) fn body(&mut self) {
        self.bodies += 1;
    }

    /// A joint with so many freedoms.
    pub(super) fn joint(&mut self, freedoms: usize, item: &Item) {
        let is_marked = item.attrs.iter().any(|attr| attr.path().is_ident("cut"));
        self.joints.push((6_usize.saturating_sub(freedoms), is_marked));
    }

    /// Any other item.
    pub(super) fn item(&mut self, kind: &ItemKind) {
        match kind {
            ItemKind::ConstraintValue { .. } | ItemKind::ConstraintKind { .. } => self.constraints += 1,
            ItemKind::Solve { .. } => self.solves = true,
            _ => {}
        }
    }

    pub(super) fn structure(&self, model: &Model) -> Structure {
        let excess = self.joints.len().saturating_sub(self.bodies);
        let marked = self.joints.iter().filter(|(_, is_marked)| *is_marked);
        let others = self.joints.iter().rev().filter(|(rows, is_marked)| !is_marked && *rows > 0);
        let closed: usize = marked.chain(others).take(excess).map(|(rows, _)| rows).sum();
        let rows = (closed + self.constraints).min(MOST);
        let mut structure = Structure::open(model);
        match model.handling {
            Handling::Reduced if self.solves => {}
            Handling::Reduced => {
                let unknown = Coordinate { joint: JointId(0), index: 0 };
                let means = Means::Newton { rows: Vec::new(), guess: 0 };
                let unknowns = vec![unknown; rows];
                structure.steps.extend((rows > 0).then_some(Step { unknowns, means }));
            }
            _ => {
                let row = |index| Row { closing: Closing::Constraint(ConstraintId(0)), index };
                structure.rows = (0..rows).map(row).collect();
            }
        }
        structure
    }
}

/// The options that change types: `constraints: Reduced`, `solve_for: ..`, `kinematics { .. }`.
pub(super) fn options(model: &mut Model, module: &Module) {
    for item in &module.items {
        match &item.kind {
            ItemKind::Formulation(fields) => {
                if let Some(Tokens::Path(path)) = field(fields, "constraints")
                    && path.path.is_ident("Reduced")
                {
                    model.handling = Handling::Reduced;
                }
            }
            ItemKind::Emit(requests) => {
                for (request, fields) in requests.iter().filter_map(|r| Some((r, r.options.as_ref()?))) {
                    let span = request.name.span();
                    if field(fields, "solve_for").is_some() && !model.inputs.is_empty() {
                        model.solve_for = vec![SolveFor { input: InputId(0), element: 0, span }];
                    }
                    if let Some(find) = field(fields, "find") {
                        let find = found(model, find);
                        model.kinematics.push(Kinematics { given: Vec::new(), find, span });
                    }
                }
            }
            _ => {}
        }
    }
}

/// Coordinates that `find: [legs.stroke, crank]` names; with an array of parts in between all of theirs.
fn found(model: &Model, expr: &Tokens) -> Vec<Coordinate> {
    if let Tokens::Array(array) = expr {
        return array.elems.iter().flat_map(|element| found(model, element)).collect();
    }
    let mut names = Vec::new();
    path(expr, &mut names);
    let mut all = Vec::new();
    for (number, joint) in model.joints.iter().enumerate() {
        let mut own = vec![joint.place.field.to_string()];
        let mut next = model.instances.get(joint.place.instance.0);
        while let Some((instance, parent)) = next.and_then(|instance| Some((instance, instance.parent?))) {
            own.push(instance.field.to_string());
            next = model.instances.get(parent.0);
        }
        own.reverse();
        let count = match names.strip_prefix(own.as_slice()) {
            Some([]) => joint.kind.freedoms(),
            Some(_) => 1,
            None => 0,
        };
        all.extend((0..count).map(|index| Coordinate { joint: JointId(number), index }));
    }
    all
}

/// `legs`, `gimbal` of `legs[2].gimbal`.
fn path(expr: &Tokens, names: &mut Vec<String>) {
    match expr {
        Tokens::Path(path) => names.extend(path.path.get_ident().map(ToString::to_string)),
        Tokens::Index(index) => path(&index.expr, names),
        Tokens::Field(field) => {
            path(&field.base, names);
            if let Member::Named(name) = &field.member {
                names.push(name.to_string());
            }
        }
        _ => {}
    }
}

/// Whether a body has coordinates of its own on the ground, and of which kind.
pub(super) fn absolute(module: &Module, fields: &Fields) -> Option<Orientation> {
    let said = module.items.iter().find_map(|item| match &item.kind {
        ItemKind::Formulation(fields) => field(fields, "coordinates"),
        _ => None,
    });
    let Some(Tokens::Call(call)) = said.or_else(|| field(fields, "coordinates")) else {
        return None;
    };
    let is_named = |expr: &Tokens, name: &str| matches!(expr, Tokens::Path(p) if p.path.is_ident(name));
    let is_angles = call.args.first().is_some_and(|angles| is_named(angles, "RollPitchYaw"));
    let orientation = if is_angles { Orientation::RollPitchYaw } else { Orientation::Quaternion };
    is_named(&call.func, "Absolute").then_some(orientation)
}

fn field<'a>(fields: &'a Fields, name: &str) -> Option<&'a Tokens> {
    fields.list.iter().find(|field| field.name == name).map(|field| &field.value)
}
