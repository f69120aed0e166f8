//! Choices of coordinates and constraints, and models rewritten in them.

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
pub(super) fn choices(source: &Source, name: &str) -> Vec<Coordinates> {
    let modules = source.modules.iter().filter(|module| is_part(module) || module.name == name);
    let items = modules.flat_map(|module| &module.items);
    let mut bodies = items.filter_map(|item| match &item.kind {
        ItemKind::Body { fields, .. } => Some(fields),
        _ => None,
    });
    let declares = bodies.any(|fields| fields.list.iter().any(|field| field.name == "coordinates"));
    let declared = declares.then_some(Coordinates::Declared);
    declared.into_iter().chain([Coordinates::Joint, Coordinates::RollPitchYaw, Coordinates::Quaternion]).collect()
}

/// The choice that the user has made. `Stabilised` are multipliers too.
pub(super) fn written(source: &Source, name: &str) -> Choice {
    let module = source.modules.iter().find(|module| module.name == name);
    let fields = module.into_iter().flat_map(|module| &module.items).find_map(|item| match &item.kind {
        ItemKind::Formulation(fields) => Some(fields),
        _ => None,
    });
    let said = |name: &str| fields?.list.iter().find(|field| field.name == name).map(|field| &field.value);
    let all = choices(source, name);
    let coordinates = match said("coordinates") {
        Some(value) => all.iter().copied().find(|choice| choice.value().as_ref() == Some(value)),
        None => all.first().copied(),
    };
    let reduced: Expr = parse_quote!(Reduced);
    let constraints =
        if said("constraints") == Some(&reduced) { Constraints::Reduced } else { Constraints::Multipliers };
    Choice { coordinates: coordinates.unwrap_or(Coordinates::Declared), constraints }
}

/// Writes the choice into the formulation of the model. Unless `all` that is asked for shall stay, what is left is forward
/// dynamics: a function or an output may be written for one choice of coordinates.
pub(super) fn rewrite(source: &mut Source, name: &str, choice: Choice, all: bool) {
    for module in source.modules.iter_mut().filter(|module| module.name == name) {
        let span = module.name.span();
        if !all {
            module.items.retain(|item| !matches!(item.kind, ItemKind::Emit(_) | ItemKind::Output(_)));
        }
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
    field(
        "constraints",
        match choice.constraints {
            Constraints::Multipliers => parse_quote!(Multipliers),
            Constraints::Reduced => parse_quote!(Reduced),
        },
    );
}
