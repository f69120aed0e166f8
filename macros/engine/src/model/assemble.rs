//! Stage `model`: one model from its items.
//!
//! In: the expanded scopes and slots. Out: the checked model, if nothing was wrong.

use proc_macro2::Span;
use syn::Path;

use super::checker::{Checker, Context, Subject, Task};
use super::docs;
use super::expand::root;
use super::types::{Body, Expr, Force, Input, Joint, Model, Output, Param, Request, State, Type};
use crate::syntax::tree::{self, Item, ItemKind, Solution};

/// What the items have given so far; `None` for those with mistakes.
#[derive(Default)]
struct Collected {
    states: Vec<Option<State>>,
    bodies: Vec<Option<Body>>,
    joints: Vec<Option<Joint>>,
    forces: Vec<Option<Force>>,
    outputs: Vec<Option<Output>>,
    gravity: Option<Expr>,
    emit: Vec<Request>,
    world: bool,
    formulation: bool,
}

impl<'a> Checker<'a, '_> {
    /// Checks the module at `index` and all parts inside it.
    pub(super) fn model(&mut self, index: usize) -> Option<Model> {
        let source = self.source;
        let module = source.modules.get(index)?;
        self.expand_root(index);
        let mut collected = Collected::default();
        let tasks = std::mem::take(&mut self.tasks);
        for task in &tasks {
            self.task(*task, &mut collected);
        }
        if self.alone {
            return None;
        }
        // Without all joints and bodies nothing can be said about how they hang together.
        let bodies: Vec<Body> = all(collected.bodies)?;
        let joints: Vec<Joint> = all(collected.joints)?;
        if self.lost_items() {
            return None;
        }
        let tree = self.tree(&bodies, &joints, module)?;
        let massless = self.check_massless(&bodies, &joints, &tree);
        if massless && !self.report.failed() {
            self.check_mass_matrix(&bodies, &joints, &tree);
        }
        let (params, inputs) = (self.finish_params()?, self.finish_inputs()?);
        if collected.emit.is_empty() {
            collected.emit.push(Request::ForwardDynamics);
        }
        Some(Model {
            name: module.name.clone(),
            vis: module.vis.clone(),
            attrs: module.attrs.clone(),
            krate: source.krate.clone().unwrap_or_else(runtime),
            part_types: std::mem::take(&mut self.part_types),
            instances: std::mem::take(&mut self.instances),
            params,
            inputs,
            states: all(collected.states)?,
            bodies,
            joints,
            tree,
            forces: all(collected.forces)?,
            outputs: all(collected.outputs)?,
            gravity: collected.gravity,
            emit: collected.emit,
        })
    }

    /// Whether items were given up, by the parser or here: what hangs together is not known then.
    fn lost_items(&mut self) -> bool {
        let lost = self.lost || self.scopes.iter().any(|scope| scope.module.broken);
        if lost {
            self.report.silent();
        }
        lost
    }

    fn task(&mut self, task: Task<'a>, into: &mut Collected) {
        match task.subject {
            Subject::Named(id) => {
                if let ItemKind::Output(_) = task.item.kind {
                    into.outputs.push(self.finish_output(id, task.item));
                } else if let Some(named) = self.named.get(id.0) {
                    let site = named.name.span();
                    self.named_meaning(id, site);
                }
            }
            Subject::Param(id) => {
                if let Some(slot) = self.params.get(id.0) {
                    let site = slot.item.name.span();
                    self.param_type(id, site);
                }
            }
            Subject::Input(id) => {
                self.input_type(id);
            }
            Subject::State(id) => {
                let state = self.states.get(id.0).cloned();
                into.states.push(state.and_then(|slot| self.finish_state(&slot)));
            }
            Subject::Body(id) => {
                let body = self.bodies.get(id.0).cloned();
                into.bodies.push(body.and_then(|slot| self.finish_body(&slot)));
            }
            Subject::Joint(id) => into.joints.push(self.finish_joint(id)),
            Subject::Force(id) => {
                let force = self.forces.get(id.0).cloned();
                into.forces.push(force.and_then(|slot| self.finish_force(&slot)));
            }
            Subject::None => {}
        }
        if !matches!(task.item.kind, ItemKind::Body { .. } | ItemKind::Joint { .. } | ItemKind::Force { .. }) {
            let attributes = docs::attributes(&task.item.attrs, self.report);
            self.refuse_cut(&attributes);
            self.refuse_waiver(&attributes);
        }
        self.other(task, into);
    }

    /// Items without a slot.
    fn other(&mut self, task: Task<'a>, into: &mut Collected) {
        let Task { scope, item, .. } = task;
        let context = root(scope);
        match &item.kind {
            ItemKind::World(_) | ItemKind::Formulation(_) | ItemKind::Emit(_) if self.is_part_scope(scope) => {
                self.report.help(
                    item.keyword,
                    "this belongs to a model, not to a part",
                    "write it in the model that uses the part",
                );
            }
            ItemKind::World(fields) => {
                self.only_once(&mut into.world, item.keyword, "world");
                let gravity = self.world(fields, scope);
                into.gravity = into.gravity.take().or(gravity);
            }
            ItemKind::Formulation(fields) => {
                self.only_once(&mut into.formulation, item.keyword, "formulation");
                self.formulation(fields);
            }
            ItemKind::Emit(requests) => self.emit(requests, &mut into.emit),
            ItemKind::Port { ty, .. } => {
                if ty != "Frame" && ty != tree::UNREADABLE {
                    self.report.help(ty.span(), format!("a port is no `{ty}`"), "write `port name: Frame;`");
                }
            }
            _ => self.later(item, context),
        }
    }

    /// What later versions bring. Expressions are checked all the same, where they are ordinary ones.
    fn later(&mut self, item: &'a Item, context: Context<'a>) {
        let what = match &item.kind {
            ItemKind::ConstraintValue { value, .. } => {
                self.value(value, context);
                "constraints are"
            }
            ItemKind::ConstraintKind { .. } => "constraints are",
            ItemKind::Drive { value, .. } => {
                self.value(value, context);
                "drives are"
            }
            ItemKind::Solve { how, .. } => {
                if let Solution::Formulas(formulas) = how {
                    for formula in formulas {
                        self.value(formula, context);
                    }
                }
                "`solve` is"
            }
            ItemKind::Assume(_) => "`assume` is",
            _ => return,
        };
        self.report.error(item.keyword, format!("{what} not available yet"));
    }

    fn is_part_scope(&self, scope: super::checker::ScopeId) -> bool {
        let scope = self.scopes.get(scope.0);
        scope.is_some_and(|s| super::is_part(s.module))
    }

    fn finish_params(&mut self) -> Option<Vec<Param>> {
        let mut params = Vec::with_capacity(self.params.len());
        for index in 0..self.params.len() {
            let id = super::types::ParamId(index);
            let ty = self.param_type(id, Span::call_site())?;
            let mut default = Vec::new();
            self.evaluator.param(id)?.flatten(&mut default);
            let slot = self.params.get(index)?;
            params.push(Param { place: slot.place.clone(), ty, default, docs: slot.docs.clone() });
        }
        Some(params)
    }

    fn finish_inputs(&mut self) -> Option<Vec<Input>> {
        let types: Vec<Option<Type>> =
            (0..self.inputs.len()).map(|index| self.input_type(super::types::InputId(index))).collect();
        let slots = self.inputs.iter().zip(types);
        slots.map(|(slot, ty)| Some(Input { place: slot.place.clone(), ty: ty?, docs: slot.docs.clone() })).collect()
    }
}

fn all<T>(list: Vec<Option<T>>) -> Option<Vec<T>> {
    list.into_iter().collect()
}

/// `::multibody`
fn runtime() -> Path {
    let name = syn::Ident::new("multibody", Span::call_site());
    let mut path = Path::from(name);
    path.leading_colon = Some(syn::token::PathSep::default());
    path
}
