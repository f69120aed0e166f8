//! Stage `model`: names of a module, and the parts inside it, expanded into instances.
//!
//! In: a module of the syntax tree. Out: scopes with all names, a slot per body, joint, .., and the list of items to
//! check, in source order with the parts' own items where the parts stand.

use std::collections::BTreeMap;
use std::rc::Rc;

use proc_macro2::Ident;
use syn::Expr;

use crate::rust_keywords::is_keyword;
use crate::syntax::tree::{self, ItemKind};

use super::checker::{
    Checker, Context, FIRST_OF_PORTS, InputSlot, JointSlot, Lazy, Meaning, Named, NamedId, NamedRequest, ParamSlot,
    Role, Scope, ScopeId, Slot, Subject, Symbol, Task,
};
use super::docs;
use super::items::coordinates::Coordinates;
use super::items::fields::field;
use super::joint_kinds::{self, JointKind};
use super::names;
use super::typed::{FrameValue, Uses};
use super::types::{BodyId, BodyRef, Frame, Instance, InstanceId, JointId, Place};
use super::units::{self, Declared};

/// Bound on the items of one model once its parts are expanded.
pub(super) const MAX_ITEMS: usize = 10_000;

/// Bound on parts within parts.
const MAX_NESTING: usize = 24;

/// How a part is used: the item that says so, and where its expressions stand.
#[derive(Clone, Copy)]
struct Binding<'a> {
    part: &'a tree::Part,
    context: Context<'a>,
}

/// The name that an item declares, with its keyword.
pub(super) fn declared(kind: &ItemKind) -> Option<(&Ident, &'static str)> {
    Some(match kind {
        ItemKind::Const(value) => (&value.name, "const"),
        ItemKind::Param(value) => (&value.name, "param"),
        ItemKind::Input(value) => (&value.name, "input"),
        ItemKind::Let(value) => (&value.name, "let"),
        ItemKind::Function(function) => (&function.name, "let"),
        ItemKind::External(function) => (&function.name, "extern"),
        ItemKind::Output(value) => (&value.name, "output"),
        ItemKind::Speed(value) => (&value.name, "speed"),
        ItemKind::State { name, .. } => (name, "state"),
        ItemKind::Port { name, .. } => (name, "port"),
        ItemKind::Body { name, .. } => (name, "body"),
        ItemKind::Joint { name, .. } => (name, "joint"),
        ItemKind::Force { name, .. } => (name, "force"),
        ItemKind::Part(part) => (&part.name, "part"),
        ItemKind::ConstraintValue { name, .. } | ItemKind::ConstraintKind { name, .. } => (name, "constraint"),
        ItemKind::World(_)
        | ItemKind::Formulation(_)
        | ItemKind::Drive { .. }
        | ItemKind::Solve { .. }
        | ItemKind::Assume(_)
        | ItemKind::System { .. }
        | ItemKind::Small(_)
        | ItemKind::Settled(_)
        | ItemKind::Emit(_) => return None,
    })
}

impl<'a> Checker<'a, '_> {
    /// Expands the model (or the part that is checked by itself) and all parts inside it.
    pub(super) fn expand_root(&mut self, index: usize) {
        let module = &self.source.modules[index];
        self.instances.push(Instance {
            parent: None,
            field: module.name.clone(),
            index: None,
            part_type: None,
            docs: docs::docs(&module.attrs),
        });
        match super::items::coordinates::of_formulation(module) {
            Some(said) => self.coordinates = said,
            // What hangs on what is not known then.
            None => self.lost = true,
        }
        self.expand(index, InstanceId(0), None);
    }

    fn expand(&mut self, index: usize, instance: InstanceId, binding: Option<Binding<'a>>) -> ScopeId {
        let module = &self.source.modules[index];
        let scope = self.scopes.push(Scope { module, instance, names: BTreeMap::new(), outputs: BTreeMap::new() });
        self.expanding.push(index);
        self.expanded += module.items.len();
        let own = self.declare(module, scope);
        let systems = self.declare_systems(module, scope);
        let settled = self.declare_settled(module, scope);
        for ((item, own), system) in module.items.iter().zip(own).zip(systems) {
            let subject = match (&item.kind, system) {
                (_, Some(system)) => Subject::System(system),
                // It has no place among the states: it follows from its equation.
                (ItemKind::State { name, .. }, None) if own && settled.contains(&name) => Subject::None,
                _ => self.expand_item(item, scope, binding, own),
            };
            self.tasks.push(Task { scope, item, subject });
        }
        self.expanding.pop();
        scope
    }

    /// Enters all names, so that the values which counts of parts need are there. Says per item whether the name is
    /// its own, or a second one that nobody can reach.
    fn declare(&mut self, module: &'a tree::Module, scope: ScopeId) -> Vec<bool> {
        let mut own = Vec::with_capacity(module.items.len());
        for item in &module.items {
            let Some((name, keyword)) = declared(&item.kind) else {
                own.push(false);
                continue;
            };
            let text = name.to_string();
            if let ItemKind::Output(value) = &item.kind
                && text != tree::UNREADABLE
            {
                let unit = units::declared(&text, &docs::docs(&item.attrs));
                own.push(self.declare_output(value, &text, scope, unit));
                continue;
            }
            if !self.is_free(name, scope) {
                // Nothing can hang on it.
                self.lost |= matches!(item.kind, ItemKind::Body { .. }) && self.is_taken(name, scope);
                own.push(false);
                continue;
            }
            own.push(true);
            self.set_symbol(scope, name, Symbol::Pending(keyword));
            let unit = || units::declared(&text, &docs::docs(&item.attrs));
            let (value, role) = match &item.kind {
                ItemKind::Const(value) => (value, Role::Const),
                ItemKind::Let(value) => (value, Role::Let),
                ItemKind::Speed(value) => (value, Role::Speed),
                ItemKind::Function(function) => {
                    let id = self.define(function, scope, unit());
                    self.set_symbol(scope, name, Symbol::Function(id));
                    continue;
                }
                ItemKind::External(function) => {
                    let id = self.external(function, unit());
                    self.set_symbol(scope, name, Symbol::External(id));
                    continue;
                }
                _ => continue,
            };
            let (context, unit) = (root(scope), unit());
            let request = NamedRequest { role, context, item: Some(value), home: scope, expr: value.value.as_ref() };
            let id = self.add_named(name, request, unit);
            self.set_symbol(scope, name, Symbol::Named(id, keyword));
        }
        own
    }

    /// Whether an item may have this name, which is reported if not.
    pub(super) fn is_free(&mut self, name: &Ident, scope: ScopeId) -> bool {
        let text = name.to_string();
        if text == tree::UNREADABLE {
            self.report.silent();
            return false;
        }
        if let Some(why) = names::refusal(&text) {
            self.report.help(name.span(), why, "take another name");
            return false;
        }
        let taken = self.scopes[scope].names.get(&text);
        if let Some(first) = taken.map(Symbol::keyword) {
            self.report.error(
                name.span(),
                format!("the name `{text}` is taken: {} `{first}` above has it already", article(first)),
            );
            return false;
        }
        true
    }

    fn is_taken(&self, name: &Ident, scope: ScopeId) -> bool {
        self.scopes[scope].names.contains_key(&name.to_string())
    }

    /// Enters the name of an output; whether it is its own. What else has that name doesn't matter.
    fn declare_output(&mut self, value: &'a tree::Value, text: &str, scope: ScopeId, unit: Option<Declared>) -> bool {
        let name = &value.name;
        if is_keyword(text) {
            let why = format!("`{text}` is a keyword of Rust");
            self.report.help(name.span(), why, "take another name");
            return false;
        }
        if self.scopes[scope].outputs.contains_key(text) {
            let message = format!("the name `{text}` is taken: an `output` above has it already");
            self.report.error(name.span(), message);
            return false;
        }
        let context = root(scope);
        let request =
            NamedRequest { role: Role::Output, context, item: Some(value), home: scope, expr: value.value.as_ref() };
        let id = self.add_named(name, request, unit);
        self.scopes[scope].outputs.insert(text.to_string(), id);
        true
    }

    fn add_named(&mut self, name: &'a Ident, request: NamedRequest<'a>, unit: Option<Declared>) -> NamedId {
        let NamedRequest { role, context, item, home, expr } = request;
        self.named.push(Named { name, role, context, item, home, expr, unit, state: Lazy::Waiting })
    }

    pub(super) fn set_symbol(&mut self, scope: ScopeId, name: &Ident, symbol: Symbol) {
        self.scopes[scope].names.insert(name.to_string(), symbol);
    }

    fn place(&self, scope: ScopeId, field: &Ident) -> Place {
        Place { instance: self.scopes[scope].instance, field: field.clone() }
    }

    /// Makes the slot of an item; `own`: whether its name may lead to it.
    fn expand_item(
        &mut self,
        item: &'a tree::Item,
        scope: ScopeId,
        binding: Option<Binding<'a>>,
        own: bool,
    ) -> Subject {
        let Some((name, keyword)) = declared(&item.kind) else {
            return Subject::None;
        };
        let place = self.place(scope, name);
        let (subject, symbol) = match &item.kind {
            ItemKind::Output(_) => {
                let id = self.scopes[scope].outputs.get(&name.to_string());
                return id.filter(|_| own).map_or(Subject::None, |id| Subject::Named(*id));
            }
            ItemKind::Const(_) | ItemKind::Let(_) | ItemKind::Speed(_) => {
                return match self.scopes[scope].names.get(&name.to_string()) {
                    Some(Symbol::Named(id, _)) if own => Subject::Named(*id),
                    _ => Subject::None,
                };
            }
            ItemKind::Function(function) => {
                self.check_parameters(function, scope);
                return Subject::None;
            }
            ItemKind::External(function) => {
                self.check_external(function);
                return Subject::None;
            }
            ItemKind::Param(value) => match binding.and_then(|b| bound(b, name)) {
                Some((expr, context)) => {
                    let unit = units::declared(&name.to_string(), &docs::docs(&item.attrs));
                    let (role, item) = (Role::BoundParam, Some(value));
                    let request = NamedRequest { role, context, item, home: scope, expr: Some(expr) };
                    let id = self.add_named(name, request, unit);
                    (Subject::Named(id), Symbol::Named(id, keyword))
                }
                None => {
                    let id = self.params.push(ParamSlot {
                        place,
                        item: value,
                        scope,
                        docs: docs::docs(&item.attrs),
                        state: Lazy::Waiting,
                        default: None,
                    });
                    (Subject::Param(id), Symbol::Param(id))
                }
            },
            ItemKind::Port { ty, signal, .. } => match binding.and_then(|b| bound(b, name)) {
                Some((expr, context)) => {
                    let (role, value) = match ty.to_string().as_str() {
                        "Joint" => (Role::JointPort, None),
                        "Scalar" | "Vec3" => (Role::Signal, Some(signal)),
                        _ => (Role::Port, None),
                    };
                    let has_unit = !matches!(role, Role::Port);
                    let unit = units::declared(&name.to_string(), &docs::docs(&item.attrs)).filter(|_| has_unit);
                    let request = NamedRequest { role, context, item: value, home: scope, expr: Some(expr) };
                    let id = self.add_named(name, request, unit);
                    (Subject::Named(id), Symbol::Named(id, keyword))
                }
                None if self.alone => self.open_port(item, name, &ty.to_string(), signal, scope),
                // The part's own item reports the missing port.
                None => (Subject::None, Symbol::Opaque(keyword)),
            },
            ItemKind::Input(value) => {
                let id = self.inputs.push(InputSlot {
                    place,
                    item: value,
                    scope,
                    docs: docs::docs(&item.attrs),
                    state: Lazy::Waiting,
                });
                (Subject::Input(id), Symbol::Input(id))
            }
            ItemKind::State { .. } => {
                let id = self.states.push(Slot { place, item, scope });
                (Subject::State(id), Symbol::State(id))
            }
            ItemKind::Body { fields, .. } => {
                let id = self.bodies.next();
                let joint = self.implicit_joint(id, fields, &place, item, scope);
                self.absolute.push(joint);
                self.bodies.push(Slot { place, item, scope });
                (Subject::Body(id), Symbol::Body(id))
            }
            ItemKind::Force { .. } => {
                let id = self.forces.push(Slot { place, item, scope });
                (Subject::Force(id), Symbol::Force(id))
            }
            ItemKind::Joint { kind, fields, .. } => {
                let id = self.joints.push(JointSlot {
                    place,
                    item,
                    scope,
                    kind: JointKind::read(&kind.to_string(), fields),
                    frames: Lazy::Waiting,
                });
                (Subject::Joint(id), Symbol::Joint(id))
            }
            ItemKind::Part(part) => match self.expand_part(item, part, scope) {
                Some(symbol) => (Subject::None, symbol),
                None => {
                    self.lost = true;
                    (Subject::None, Symbol::Opaque(keyword))
                }
            },
            ItemKind::ConstraintValue { .. } | ItemKind::ConstraintKind { .. } => {
                let id = self.constraints.push(Slot { place, item, scope });
                (Subject::Constraint(id), Symbol::Constraint(id))
            }
            _ => (Subject::None, Symbol::Opaque(keyword)),
        };
        if own {
            self.set_symbol(scope, name, symbol);
        }
        subject
    }

    /// The joint on the ground that a body with absolute coordinates hangs on. It has the body's name and place.
    fn implicit_joint(
        &mut self,
        body: BodyId,
        fields: &tree::Fields,
        place: &Place,
        item: &'a tree::Item,
        scope: ScopeId,
    ) -> Option<JointId> {
        let own = match field(fields, "coordinates") {
            Some(expr) => {
                let own = Coordinates::read(expr);
                self.lost |= own.is_none();
                own
            }
            None => None,
        };
        let Coordinates::Absolute(orientation) = self.coordinates.or(own)? else {
            return None;
        };
        let span = place.field.span();
        let frame = |body| FrameValue { frame: Frame { body, steps: Vec::new(), span }, uses: Uses::default() };
        Some(self.joints.push(JointSlot {
            place: place.clone(),
            item,
            scope,
            kind: joint_kinds::FREE.oriented(orientation),
            frames: Lazy::Done(Some([frame(BodyRef::Ground), frame(BodyRef::Body(body))])),
        }))
    }

    /// A port of a part by itself. What it leads to is not known: a frame is one of a body that no other port leads to, a joint is
    /// one between two such bodies, which turns unless the port's unit is a length, a value is an input.
    fn open_port(
        &mut self,
        item: &'a tree::Item,
        name: &'a Ident,
        ty: &str,
        signal: &'a tree::Value,
        scope: ScopeId,
    ) -> (Subject, Symbol) {
        let place = self.place(scope, name);
        let docs = docs::docs(&item.attrs);
        match ty {
            "Joint" => {
                let kind = match docs.unit.as_deref() {
                    Some("m") => &joint_kinds::PRISMATIC,
                    _ => &joint_kinds::REVOLUTE,
                };
                let frames = [self.open_frame(name), self.open_frame(name)];
                let slot = JointSlot { place, item, scope, kind: Some(kind), frames: Lazy::Done(Some(frames)) };
                self.open_unit |= docs.unit.is_none();
                (Subject::None, Symbol::Joint(self.joints.push(slot)))
            }
            "Scalar" | "Vec3" => {
                let slot = InputSlot { place, item: signal, scope, docs, state: Lazy::Waiting };
                (Subject::None, Symbol::Input(self.inputs.push(slot)))
            }
            _ => {
                let request =
                    NamedRequest { role: Role::Port, context: root(scope), item: None, home: scope, expr: None };
                let id = self.add_named(name, request, None);
                self.named[id].state = Lazy::Done(Some(Meaning::Frame(self.open_frame(name))));
                (Subject::Named(id), Symbol::Named(id, "port"))
            }
        }
    }

    /// A frame of a body that nobody knows.
    fn open_frame(&mut self, name: &Ident) -> FrameValue {
        let body = BodyId(FIRST_OF_PORTS.0 + self.ports);
        self.ports += 1;
        let frame = Frame { body: BodyRef::Body(body), steps: Vec::new(), span: name.span() };
        FrameValue { frame, uses: Uses::default() }
    }

    /// All instances of a part; nothing if the item is at fault.
    fn expand_part(&mut self, item: &'a tree::Item, part: &'a tree::Part, scope: ScopeId) -> Option<Symbol> {
        let kind = part.kind.to_string();
        if kind == tree::UNREADABLE {
            self.report.silent();
            return None;
        }
        let index = self.part_module(&part.kind)?;
        if self.expanding.contains(&index) {
            let message = format!("the part `{kind}` contains itself");
            self.report.error(part.kind.span(), message);
            return None;
        }
        if self.expanding.len() > MAX_NESTING {
            let message = format!("parts are nested more than {MAX_NESTING} deep");
            self.report.error(part.kind.span(), message);
            return None;
        }
        let count = match &part.count {
            Some(expr) => Some(self.part_count(expr, scope)?),
            None => None,
        };
        self.check_part_fields(part, index);
        self.check_index(part, scope);
        let part_type = self.part_type(index, part);
        let mut scopes = Vec::new();
        for k in 0..count.unwrap_or(1) {
            if self.expanded >= MAX_ITEMS {
                self.report.help(
                    part.name.span(),
                    format!("more than {MAX_ITEMS} items once all parts are expanded"),
                    "write fewer or smaller parts",
                );
                return None;
            }
            let parent = self.scopes[scope].instance;
            let instance = self.instances.push(Instance {
                parent: Some(parent),
                field: part.name.clone(),
                index: count.map(|n| (k, n)),
                part_type: Some(part_type),
                docs: docs::docs(&item.attrs),
            });
            let context = Context { scope, index: part.index.as_ref().map(|name| (name, k)), call: None };
            let binding = Binding { part, context };
            scopes.push(self.expand(index, instance, Some(binding)));
        }
        match count {
            Some(_) => Some(Symbol::Parts(Rc::from(scopes))),
            // One part has been expanded.
            None => scopes.first().map(|scope| Symbol::Part(*scope)),
        }
    }
}

/// `a` or `an`, before a keyword.
pub(super) fn article(keyword: &str) -> &'static str {
    if keyword.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}

/// The context of a module's own items.
pub(super) fn root<'a>(scope: ScopeId) -> Context<'a> {
    Context { scope, index: None, call: None }
}

/// What the part's declaration sets a port or param to.
fn bound<'a>(binding: Binding<'a>, name: &Ident) -> Option<(&'a Expr, Context<'a>)> {
    let field = binding.part.fields.list.iter().find(|f| f.name == *name)?;
    Some((&field.value, binding.context))
}
