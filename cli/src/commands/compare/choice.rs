//! Choices of coordinates and constraints, and models rewritten in them.

use std::collections::HashSet;

use multibody_engine::model::references::{self, Use};
use multibody_engine::syntax::tree::{Field, Fields, Item, ItemKind, Module, Request, Source};
use proc_macro2::{Ident, Span};
use syn::{Expr, parse_quote};

/// What `formulation { coordinates: .. }` says.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Coordinates {
    /// Nothing: each body has those that it declares.
    Declared,
    Joint,
    RollPitchYaw,
    Quaternion,
}

/// What `formulation { constraints: .. }` says.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Constraints {
    Multipliers,
    Reduced,
    /// One of these: it is written, and never a row of its own.
    Auto,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Choice {
    pub(super) coordinates: Coordinates,
    pub(super) constraints: Constraints,
}

impl Coordinates {
    pub(super) fn word(self) -> &'static str {
        match self {
            Coordinates::Declared => "as declared",
            Coordinates::Joint => "Joint",
            Coordinates::RollPitchYaw => "Absolute(RollPitchYaw)",
            Coordinates::Quaternion => "Absolute(Quaternion)",
        }
    }

    fn value(self) -> Option<Expr> {
        match self {
            Coordinates::Declared => None,
            Coordinates::Joint => Some(parse_quote!(Joint)),
            Coordinates::RollPitchYaw => Some(parse_quote!(Absolute(RollPitchYaw))),
            Coordinates::Quaternion => Some(parse_quote!(Absolute(Quaternion))),
        }
    }
}

impl Constraints {
    pub(super) fn word(self) -> &'static str {
        match self {
            Constraints::Multipliers => "Multipliers",
            Constraints::Reduced => "Reduced",
            Constraints::Auto => "Auto",
        }
    }

    fn value(self) -> Expr {
        match self {
            Constraints::Multipliers => parse_quote!(Multipliers),
            Constraints::Reduced => parse_quote!(Reduced),
            Constraints::Auto => parse_quote!(Auto),
        }
    }
}

impl Choice {
    pub(super) fn words(self) -> String {
        format!("coordinates {}, constraints {}", self.coordinates.word(), self.constraints.word())
    }
}

/// Parts are no models.
pub(super) fn is_part(module: &Module) -> bool {
    module.items.iter().any(|item| matches!(item.kind, ItemKind::Port { .. }))
}

/// Coordinates of a model that differ. Where no body declares its own they are those of joints unless the formulation says more.
pub(super) fn choices(source: &Source, model: usize) -> Vec<Coordinates> {
    let modules = source.modules.iter().enumerate().filter(|(index, module)| *index == model || is_part(module));
    let items = modules.flat_map(|(_, module)| &module.items);
    let mut bodies = items.filter_map(|item| match &item.kind {
        ItemKind::Body { fields, .. } => Some(fields),
        _ => None,
    });
    let declares = bodies.any(|fields| fields.list.iter().any(|field| field.name == "coordinates"));
    let declared = declares.then_some(Coordinates::Declared);
    declared.into_iter().chain([Coordinates::Joint, Coordinates::RollPitchYaw, Coordinates::Quaternion]).collect()
}

/// The choice that the user has made. `Stabilised` are multipliers too.
pub(super) fn written(source: &Source, model: usize) -> Choice {
    let fields =
        source.modules.get(model).into_iter().flat_map(|module| &module.items).find_map(|item| match &item.kind {
            ItemKind::Formulation(fields) => Some(fields),
            _ => None,
        });
    let said = |name: &str| fields?.list.iter().find(|field| field.name == name).map(|field| &field.value);
    let all = choices(source, model);
    let coordinates = match said("coordinates") {
        Some(value) => all.iter().copied().find(|choice| choice.value().as_ref() == Some(value)),
        None => all.first().copied(),
    };
    let written = said("constraints");
    let constraints = [Constraints::Reduced, Constraints::Auto].into_iter().find(|one| written == Some(&one.value()));
    let constraints = constraints.unwrap_or(Constraints::Multipliers);
    Choice { coordinates: coordinates.unwrap_or(Coordinates::Declared), constraints }
}

/// Writes the choice into the formulation of the model. Unless `all` that is asked for shall stay, what is left is forward
/// dynamics with what it reads: a function or an output may be written for one choice of coordinates.
pub(super) fn rewrite(source: &mut Source, model: usize, choice: Choice, all: bool) {
    if !all {
        leave_out(source, model);
    }
    let Some(module) = source.modules.get_mut(model) else { return };
    let span = module.name.span();
    let has = |kind: fn(&ItemKind) -> bool| module.items.iter().any(|item| kind(&item.kind));
    let formulated = has(|kind| matches!(kind, ItemKind::Formulation(_)));
    let asks = has(|kind| match kind {
        ItemKind::Emit(list) => list.iter().any(|request| request.name == "forward_dynamics"),
        _ => false,
    });
    let item = |kind| Item { attrs: Vec::new(), keyword: span, kind };
    if !formulated {
        let fields = Fields { span, list: Vec::new(), broken: false };
        module.items.push(item(ItemKind::Formulation(fields)));
    }
    if !asks {
        let request = Request { name: Ident::new("forward_dynamics", span), options: None };
        module.items.push(item(ItemKind::Emit(vec![request])));
    }
    for item in &mut module.items {
        if let ItemKind::Formulation(fields) = &mut item.kind {
            say(fields, choice, span);
        }
    }
}

/// Takes out what is asked for, and outputs that nothing else reads.
fn leave_out(source: &mut Source, model: usize) {
    let Some(module) = source.modules.get_mut(model) else { return };
    let items = std::mem::take(&mut module.items);
    let (mut outputs, mut others) = (Vec::new(), Vec::new());
    for item in items {
        match item.kind {
            ItemKind::Emit(_) => {}
            ItemKind::Output(_) => outputs.push(item),
            _ => others.push(item),
        }
    }
    module.items = others;
    loop {
        // A name that nothing else declares is that of an output, which may read others.
        let mut missing = HashSet::new();
        each_unknown(&references::of(source).modules, model, &mut |name| {
            missing.insert(name.to_string());
        });
        let is_read =
            |item: &Item| matches!(&item.kind, ItemKind::Output(value) if missing.contains(&value.name.to_string()));
        let (read, rest): (Vec<Item>, Vec<Item>) = outputs.into_iter().partition(is_read);
        outputs = rest;
        let Some(module) = source.modules.get_mut(model).filter(|_| !read.is_empty()) else { return };
        module.items.extend(read);
    }
}

/// Names of a module that it does not declare.
fn each_unknown(modules: &[references::Module], model: usize, f: &mut impl FnMut(&Ident)) {
    let mut waiting: Vec<&Use> = modules.iter().flat_map(|module| &module.uses).collect();
    while let Some(next) = waiting.pop() {
        match next {
            Use::Name { module, name, is_known: false } if *module == model => f(name),
            Use::Local { uses, .. } => waiting.extend(uses),
            _ => {}
        }
    }
}

fn say(fields: &mut Fields, choice: Choice, span: Span) {
    let mut replaced = vec!["coordinates", "constraints", "rate", "position"];
    // It names coordinates of joints.
    if matches!(choice.coordinates, Coordinates::RollPitchYaw | Coordinates::Quaternion) {
        replaced.push("independent");
    }
    fields.list.retain(|field| !replaced.iter().any(|name| field.name == name));
    let mut field = |name: &str, value| fields.list.push(Field { name: Ident::new(name, span), value });
    if let Some(value) = choice.coordinates.value() {
        field("coordinates", value);
    }
    field("constraints", choice.constraints.value());
}
