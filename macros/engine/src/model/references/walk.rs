//! Stage `model`: the walk over one module that finds its names and their uses.
//!
//! In: the syntax tree, the names that all modules declare. Out: references in source order. What stands for a name is
//! decided as `model/expressions` decides it: an index hides what has its name, then come values of the language, the module's own names, and
//! outputs last; behind a part, or an array of them, stand names of the part's module.

use std::collections::HashMap;

use proc_macro2::{Ident, Span};
use syn::{Expr, Member, Type};

use crate::model::docs;
use crate::model::names::{
    CONSTRUCTORS, FUNCTIONS, MANIPULATIONS, MATRICES, SPECIAL_FUNCTIONS, SYSTEM_QUANTITIES, VALUES,
};
use crate::syntax::tree::{self, Fields, ItemKind, Solution, UNREADABLE};

use super::words::{self, JOINT};
use super::{Declared, Module, Use};

/// As many names may lead to one another, as in `let a = legs[0]; let b = a;`.
const MOST_STEPS: usize = 24;

/// The names of a module; those of outputs last, since an output is what a name means last.
pub(super) fn declared(module: &tree::Module) -> Vec<Declared> {
    let mut names = Vec::new();
    let mut outputs = Vec::new();
    for item in &module.items {
        let mut add = |name: &Ident, room, word| {
            let list = if word == "Output" { &mut outputs } else { &mut names };
            let docs = docs::docs(&item.attrs);
            list.push(Declared { name: name.clone(), docs, room, word, hidden: false });
        };
        match &item.kind {
            ItemKind::Const(value) => add(&value.name, "name", "Const"),
            ItemKind::Param(value) => add(&value.name, "name", "Param"),
            ItemKind::Input(value) => add(&value.name, "name", "Input"),
            ItemKind::Let(value) => add(&value.name, "name", "Let"),
            ItemKind::Speed(value) => add(&value.name, "name", "Speed"),
            ItemKind::Function(function) => add(&function.name, "name", "Function"),
            ItemKind::External(function) => add(&function.name, "name", "Extern"),
            ItemKind::Output(value) => add(&value.name, "name", "Output"),
            ItemKind::State { name, .. } => add(name, "name", "State"),
            ItemKind::Port { name, .. } => add(name, "name", "Port"),
            ItemKind::Body { name, .. } => add(name, "name", "Body"),
            ItemKind::Joint { name, kind, .. } => match words::joint_kind(&kind.to_string()) {
                Some(kind) => add(name, JOINT, kind),
                None => add(name, "name", "Joint"),
            },
            ItemKind::Force { name, .. } => add(name, "name", "Force"),
            ItemKind::ConstraintValue { name, .. } | ItemKind::ConstraintKind { name, .. } => {
                add(name, "name", "Constraint");
            }
            ItemKind::Part(part) => add(&part.name, "name", "Part"),
            ItemKind::System { unknowns, .. } => {
                for unknown in unknowns.iter().filter_map(single) {
                    add(unknown, "name", "Unknown");
                }
            }
            ItemKind::World(_)
            | ItemKind::Formulation(_)
            | ItemKind::Drive { .. }
            | ItemKind::Solve { .. }
            | ItemKind::Assume(_)
            | ItemKind::Small(_)
            | ItemKind::Settled(_)
            | ItemKind::Emit(_) => {}
        }
    }
    names.append(&mut outputs);
    names.retain(|declared| declared.name != UNREADABLE);
    names
}

/// What is looked up, by text.
pub(super) struct Known<'a> {
    /// The first module of each name, and whether it is a part.
    modules: HashMap<String, (usize, bool)>,
    /// The names of each module, with the items that may stand for parts.
    names: Vec<HashMap<String, Option<&'a ItemKind>>>,
}

impl<'a> Known<'a> {
    pub(super) fn new(source: &'a tree::Source, modules: &[Module]) -> Self {
        let mut known = Known { modules: HashMap::new(), names: Vec::new() };
        for (index, (module, tree)) in modules.iter().zip(&source.modules).enumerate() {
            known.modules.entry(module.name.to_string()).or_insert((index, module.is_part));
            let declared = module.declared.iter().map(|declared| (declared.name.to_string(), None));
            let mut names: HashMap<String, Option<&ItemKind>> = declared.collect();
            for item in &tree.items {
                let name = match &item.kind {
                    ItemKind::Part(part) => &part.name,
                    ItemKind::Let(value) => &value.name,
                    ItemKind::Function(function) => &function.name,
                    ItemKind::External(function) => &function.name,
                    _ => continue,
                };
                names.entry(name.to_string()).or_default().get_or_insert(&item.kind);
            }
            names.retain(|name, _| !VALUES.contains(&name.as_str()));
            known.names.push(names);
        }
        known
    }

    fn is_declared(&self, module: usize, name: &str) -> bool {
        self.names.get(module).is_some_and(|names| names.contains_key(name))
    }

    fn part(&self, kind: &Ident) -> Option<usize> {
        let (index, is_part) = self.modules.get(&kind.to_string())?;
        is_part.then_some(*index)
    }

    /// Whether the first item of this name in a module is a function.
    fn is_function(&self, module: usize, name: &Ident) -> bool {
        let item = self.names.get(module).and_then(|names| names.get(&name.to_string()));
        matches!(item, Some(Some(ItemKind::Function(_) | ItemKind::External(_))))
    }

    /// The model that a function's name stands for, if it is none of the language.
    fn model(&self, name: &Ident) -> Option<usize> {
        let text = name.to_string();
        let own = FUNCTIONS.iter().map(|function| function.0).chain(SPECIAL_FUNCTIONS).chain(CONSTRUCTORS);
        if own.chain(MANIPULATIONS).any(|known| known == text) {
            return None;
        }
        self.modules.get(&text).map(|module| module.0)
    }

    /// The module of the part, or of the array of parts, that an expression in `module` means.
    fn part_in(&self, module: usize, expr: &Expr, steps: usize) -> Option<usize> {
        let steps = steps.checked_sub(1)?;
        match expr {
            Expr::Paren(inner) => self.part_in(module, &inner.expr, steps),
            Expr::Group(inner) => self.part_in(module, &inner.expr, steps),
            Expr::Index(index) => self.part_in(module, &index.expr, steps),
            Expr::Field(field) => {
                let Member::Named(name) = &field.member else { return None };
                let inner = self.part_in(module, &field.base, steps)?;
                self.part_named(inner, name, steps)
            }
            other => self.part_named(module, single(other)?, steps),
        }
    }

    /// The module of the part that a name of `module` stands for, itself or by a `let`.
    fn part_named(&self, module: usize, name: &Ident, steps: usize) -> Option<usize> {
        match self.names.get(module)?.get(&name.to_string())? {
            Some(ItemKind::Part(part)) => self.part(&part.kind),
            Some(ItemKind::Let(value)) => self.part_in(module, value.value.as_ref()?, steps),
            _ => None,
        }
    }
}

/// All uses in a module.
pub(super) fn uses(source: &tree::Source, known: &Known<'_>, index: usize) -> Vec<Use> {
    let mut walk = Walk { known, module: index, locals: &[], uses: Vec::new() };
    for item in source.modules.get(index).map_or(&[][..], |module| &module.items) {
        walk.item(item);
    }
    walk.uses
}

struct Walk<'a> {
    known: &'a Known<'a>,
    module: usize,
    /// `|i|` of the part whose fields are read, arguments of the function whose value is read.
    locals: &'a [Ident],
    uses: Vec<Use>,
}

impl<'a> Walk<'a> {
    fn item(&mut self, item: &'a tree::Item) {
        match &item.kind {
            ItemKind::Const(value)
            | ItemKind::Param(value)
            | ItemKind::Input(value)
            | ItemKind::Let(value)
            | ItemKind::Speed(value)
            | ItemKind::Output(value) => {
                value.ty.iter().for_each(|ty| self.ty(ty));
                self.all(&value.value);
            }
            ItemKind::Function(function) => {
                self.within(&function.parameters, "Argument", |walk| walk.expr(&function.value));
            }
            // Its path is followed as Rust, where the function is called; names of its arguments stand for nothing.
            ItemKind::External(_) => {}
            ItemKind::State { rate, start, .. } => {
                self.expr(rate);
                self.all(start);
            }
            ItemKind::Port { ty, .. } => self.word("ty", ty.clone(), None),
            ItemKind::World(fields) => self.fields("item", keyword("World"), fields),
            ItemKind::Formulation(fields) => self.fields("item", keyword("Formulation"), fields),
            ItemKind::Body { fields, .. } => self.fields("item", keyword("Body"), fields),
            ItemKind::Joint { kind, fields, .. } => self.fields(JOINT, kind.clone(), fields),
            ItemKind::Force { kind, fields, .. } => self.fields("force", kind.clone(), fields),
            ItemKind::ConstraintKind { kind, fields, .. } => self.fields("constraint", kind.clone(), fields),
            ItemKind::ConstraintValue { value, .. } | ItemKind::Assume(value) | ItemKind::Settled(value) => {
                self.expr(value);
            }
            ItemKind::Part(part) => self.part(part),
            ItemKind::Drive { target, value } => {
                self.expr(target);
                self.expr(value);
            }
            ItemKind::Solve { unknowns, how } => {
                self.all(unknowns);
                match how {
                    Solution::Formulas(formulas) => self.all(formulas),
                    Solution::From { closings, branches } => {
                        self.all(closings);
                        self.all(branches);
                    }
                }
            }
            // The unknowns are declared here.
            ItemKind::System { equations, branches, .. } => {
                self.all(equations);
                self.all(branches);
            }
            ItemKind::Small(coordinates) => self.all(coordinates),
            ItemKind::Emit(requests) => {
                for request in requests {
                    // Groups of outputs have names of the user's.
                    let fields = request.options.as_ref().filter(|_| request.name != "outputs");
                    self.word("emit", request.name.clone(), fields);
                    let options = request.options.iter().flat_map(|options| &options.list);
                    // What `at` lists are functions, whatever the user's names are.
                    let values = options.filter(|_| request.name != "at").map(|option| &option.value);
                    values.for_each(|value| self.expr(value));
                }
            }
        }
    }

    /// A word with fields, and what stands in these.
    fn fields(&mut self, room: &'static str, word: Ident, fields: &'a Fields) {
        self.word(room, word, Some(fields));
        for field in &fields.list {
            match field.name.to_string().as_str() {
                "coordinates" => self.words_in("coordinates", &field.value),
                "constraints" => self.words_in("handling", &field.value),
                "packs" => self.words_in("packs", &field.value),
                "speeds" => self.words_in("speeds", &field.value),
                _ => self.expr(&field.value),
            }
        }
    }

    fn word(&mut self, room: &'static str, word: Ident, fields: Option<&Fields>) {
        if word != UNREADABLE {
            let names = fields.iter().flat_map(|fields| &fields.list).map(|field| field.name.clone());
            let mut fields: Vec<Ident> = Vec::new();
            for name in names.filter(|name| *name != UNREADABLE) {
                // What is given twice is a mistake, which has been reported.
                if !fields.contains(&name) {
                    fields.push(name);
                }
            }
            self.uses.push(Use::Word { room, word, fields });
        }
    }

    /// `Absolute(Quaternion)`
    fn words_in(&mut self, room: &'static str, expr: &Expr) {
        match expr {
            Expr::Call(call) => {
                self.words_in(room, &call.func);
                call.args.iter().for_each(|argument| self.words_in(room, argument));
            }
            other => {
                if let Some(word) = single(other) {
                    self.word(room, word.clone(), None);
                }
            }
        }
    }

    fn part(&mut self, part: &'a tree::Part) {
        let module = self.known.part(&part.kind);
        for kind in [Some(&part.kind), part.again.as_ref()].into_iter().flatten().filter(|kind| **kind != UNREADABLE) {
            self.uses.push(Use::Module { name: kind.clone(), is_known: self.known.part(kind).is_some() });
        }
        part.count.iter().for_each(|count| self.expr(count));
        if let Some(module) = module {
            for field in part.fields.list.iter().filter(|field| field.name != UNREADABLE) {
                self.name(module, &field.name);
            }
        }
        let index = part.index.as_slice();
        self.within(index, "Index", |walk| {
            for field in &part.fields.list {
                walk.expr(&field.value);
            }
        });
    }

    /// What stands where these names mean something.
    fn within(&mut self, locals: &'a [Ident], word: &'static str, inside: impl FnOnce(&mut Self)) {
        let before = std::mem::take(&mut self.uses);
        self.locals = locals;
        inside(self);
        self.locals = &[];
        let mut uses = std::mem::replace(&mut self.uses, before);
        for name in locals.iter().rev() {
            uses = vec![Use::Local { name: name.clone(), word, uses }];
        }
        self.uses.extend(uses);
    }

    fn ty(&mut self, ty: &'a Type) {
        match ty {
            Type::Array(array) => {
                self.ty(&array.elem);
                self.expr(&array.len);
            }
            Type::Paren(inner) => self.ty(&inner.elem),
            Type::Group(inner) => self.ty(&inner.elem),
            Type::Path(path) => {
                if let Some(name) = path.path.get_ident() {
                    self.word("ty", name.clone(), None);
                }
            }
            _ => {}
        }
    }

    fn all(&mut self, expressions: impl IntoIterator<Item = &'a Expr>) {
        expressions.into_iter().for_each(|expr| self.expr(expr));
    }

    fn expr(&mut self, expr: &'a Expr) {
        match expr {
            Expr::Path(_) => self.path(expr),
            Expr::Paren(inner) => self.expr(&inner.expr),
            Expr::Group(inner) => self.expr(&inner.expr),
            Expr::Unary(unary) => self.expr(&unary.expr),
            Expr::Binary(binary) => {
                self.expr(&binary.left);
                self.expr(&binary.right);
            }
            Expr::Array(array) => self.all(&array.elems),
            Expr::Tuple(tuple) => self.all(&tuple.elems),
            Expr::Call(call) => self.call(call),
            Expr::MethodCall(call) => {
                self.expr(&call.receiver);
                let part = self.known.part_in(self.module, &call.receiver, MOST_STEPS);
                if let Some(module) = part.filter(|module| self.known.is_function(*module, &call.method)) {
                    self.name(module, &call.method);
                }
                self.all(&call.args);
            }
            Expr::Field(field) => {
                self.expr(&field.base);
                if let (Member::Named(name), Some(module)) =
                    (&field.member, self.known.part_in(self.module, &field.base, MOST_STEPS))
                {
                    self.name(module, name);
                }
            }
            Expr::Index(index) => {
                self.expr(&index.expr);
                self.expr(&index.index);
            }
            Expr::Assign(pair) => {
                self.expr(&pair.left);
                self.expr(&pair.right);
            }
            _ => {}
        }
    }

    /// What is called is a function of the module's own, one of the language, or another model: what it is asked for, and variables that are given, are names of
    /// that model.
    fn call(&mut self, call: &'a syn::ExprCall) {
        if let Some(name) = single(&call.func).filter(|name| self.known.is_function(self.module, name)) {
            self.name(self.module, name);
            return self.all(&call.args);
        }
        let Some((name, model)) = single(&call.func).and_then(|name| Some((name, self.known.model(name)?))) else {
            return self.all(&call.args);
        };
        self.uses.push(Use::Module { name: name.clone(), is_known: true });
        for (place, argument) in call.args.iter().enumerate() {
            match argument {
                Expr::Assign(pair) => {
                    self.elsewhere(model, &pair.left);
                    self.expr(&pair.right);
                }
                question if place == 0 => self.elsewhere(model, question),
                other => self.expr(other),
            }
        }
    }

    /// An expression in the terms of another module.
    fn elsewhere(&mut self, module: usize, expr: &'a Expr) {
        let (home, locals) = (self.module, std::mem::take(&mut self.locals));
        self.module = module;
        self.expr(expr);
        self.module = home;
        self.locals = locals;
    }

    fn path(&mut self, expr: &Expr) {
        let Some(name) = single(expr) else { return };
        let text = name.to_string();
        if self.locals.contains(name) {
            self.uses.push(Use::OfLocal(name.clone()));
        } else if self.known.is_declared(self.module, &text) || !is_of_the_language(&text) {
            self.name(self.module, name);
        }
    }

    fn name(&mut self, module: usize, name: &Ident) {
        let is_known = self.known.is_declared(module, &name.to_string());
        self.uses.push(Use::Name { module, name: name.clone(), is_known });
    }
}

/// A word whose token is the item's keyword, which has another text: it stands at no token.
fn keyword(word: &str) -> Ident {
    Ident::new(word, Span::mixed_site())
}

/// The one name that an expression is.
fn single(expr: &Expr) -> Option<&Ident> {
    match expr {
        Expr::Path(path) if path.qself.is_none() => path.path.get_ident(),
        _ => None,
    }
}

/// Values, and functions that somebody forgot to call.
fn is_of_the_language(name: &str) -> bool {
    VALUES.contains(&name)
        || FUNCTIONS.iter().any(|function| function.0 == name)
        || SYSTEM_QUANTITIES.iter().any(|function| function.0 == name)
        || SPECIAL_FUNCTIONS.contains(&name)
        || MATRICES.contains(&name)
}
