//! Stage `model`: one model from its items.
//!
//! In: the expanded scopes and slots. Out: the checked model, if nothing was wrong.

use std::collections::BTreeSet;
use std::rc::Rc;

use proc_macro2::Span;
use syn::Path;

use crate::invariant::index_vec::IndexVec;
use crate::syntax::tree::{self, ItemKind};

use super::checker::{Checker, ScopeId, Subject, Task};
use super::docs;
use super::expand::root;
use super::items::loops::Driven;
use super::items::requests::Requested;
use super::items::solves::SolveItem;
use super::topology::Topology;
use super::types::{
    Bodies, Body, Constraint, Coordinate, Drive, Expr, Force, Handling, Input, Joint, Joints, Kinematics, Model,
    Output, Packs, Param, Request, Solve, Speed, SpeedChoice, State, Type,
};
use super::units::Units;

/// What the items have given so far; `None` for those with mistakes.
#[derive(Default)]
pub(super) struct Collected<'a> {
    pub(super) states: Vec<Option<State>>,
    pub(super) bodies: Vec<Option<Body>>,
    pub(super) joints: Vec<Option<Joint>>,
    pub(super) forces: Vec<Option<Force>>,
    pub(super) outputs: Vec<Option<Output>>,
    pub(super) speeds: Vec<Option<Speed>>,
    pub(super) constraints: Vec<Option<Constraint>>,
    pub(super) assumptions: Vec<Option<Expr>>,
    pub(super) gravity: Option<Expr>,
    pub(super) handling: Option<Handling>,
    pub(super) rounds: Option<usize>,
    pub(super) packs: Option<Packs>,
    /// Where that is said.
    pub(super) chooses_speeds: Option<Span>,
    pub(super) independent: Option<(&'a tree::Fields, ScopeId)>,
    pub(super) requested: Requested<'a>,
    /// `drive` and `solve`, which need to know what hangs on what.
    pub(super) deferred: Vec<Task<'a>>,
    /// What is small.
    pub(super) small: Vec<(&'a syn::Expr, ScopeId)>,
    world: bool,
    formulation: bool,
}

/// What closes loops and what follows from that.
#[derive(Default)]
pub(super) struct Loops {
    pub(super) drives: Vec<Drive>,
    /// Drives of measured coordinates.
    pub(super) held: Vec<Constraint>,
    pub(super) solves: Vec<Solve>,
    pub(super) independent: Vec<Coordinate>,
    pub(super) kinematics: Vec<Kinematics>,
    pub(super) assembly: Option<Kinematics>,
    pub(super) skipped: Vec<String>,
    pub(super) small: Vec<Coordinate>,
}

/// What a port may be.
const PORTS: [&str; 4] = ["Frame", "Joint", "Scalar", "Vec3"];

impl<'a> Checker<'a, '_> {
    /// Checks the module at `index` and all parts inside it.
    pub(super) fn model(&mut self, index: usize) -> Option<Model> {
        let module = &self.source.modules[index];
        self.expand_root(index);
        let mut collected = self.read_all();
        let mut units = Units::new(self);
        units.items(self, &collected);
        // Without all joints and bodies nothing can be said about how they hang together.
        let bodies: Option<Bodies> = all(std::mem::take(&mut collected.bodies)).map(Into::into);
        let joints: Option<Joints> = all(std::mem::take(&mut collected.joints)).map(Into::into);
        let known = bodies.zip(joints).filter(|_| !self.alone && !self.lost_items());
        let found = known.and_then(|(bodies, joints)| {
            let topology = self.topology(&bodies, &joints, module)?;
            Some((bodies, joints, topology))
        });
        let tree = found.as_ref().map(|(_, joints, topology)| (topology, joints));
        let loops = self.loops(&collected, tree);
        units.loops(&loops);
        if !self.open_unit {
            units.tell(self.report);
        }
        let (bodies, joints, topology) = found?;
        self.check_coordinate_uses(&topology, &joints);
        let mut constraints: Vec<Constraint> = all(collected.constraints)?;
        constraints.extend(loops.held);
        if let Some(span) =
            collected.requested.constraints.filter(|_| constraints.is_empty() && topology.cuts.is_empty())
        {
            self.report.error(span, "this model has no constraints");
        }
        self.check_changing(&bodies, &constraints, &loops.solves, &loops.drives, &collected.assumptions);
        self.check_changing_values(&bodies, &collected.states, &collected.forces, &collected.outputs);
        let held = self.held(&bodies, &joints, &topology, &constraints, &loops.drives);
        self.check_weightless(&bodies);
        let massless = self.check_massless(&bodies, &joints, &topology.tree, &held);
        if massless && !self.report.failed() {
            self.check_mass_matrix(&bodies, &joints, &topology.tree, &held);
        }
        let (params, inputs) = (self.finish_params()?, self.finish_inputs()?);
        let outputs = all(collected.outputs)?;
        let mut emit = collected.requested.list;
        if emit.is_empty() {
            emit.push(Request::ForwardDynamics);
        }
        let output_groups = self.output_groups(&collected.requested.outputs, &outputs);
        if let (Some(span), false) = (collected.chooses_speeds, collected.speeds.is_empty()) {
            let help = "leave `speeds: Auto` out, or the `speed` items";
            self.report.help(span, "speeds are declared, and to be chosen too", help);
        }
        let mut remarks = topology.skipped;
        remarks.extend(loops.skipped);
        remarks.extend(self.settled_states());
        Some(Model {
            params: params.into(),
            inputs: inputs.into(),
            states: all(collected.states)?.into(),
            bodies,
            joints,
            tree: topology.tree,
            cuts: topology.cuts,
            constraints: constraints.into(),
            drives: loops.drives,
            solves: loops.solves,
            assumptions: all(collected.assumptions)?,
            handling: collected.handling.unwrap_or_default(),
            rounds: collected.rounds,
            packs: collected.packs.unwrap_or_default(),
            speeds: all(collected.speeds)?,
            speed_choice: if collected.chooses_speeds.is_some() { SpeedChoice::Open } else { SpeedChoice::Written },
            independent: loops.independent,
            remarks,
            small: loops.small,
            solve_for: collected.requested.solve_for,
            kinematics: loops.kinematics,
            assembly: loops.assembly,
            at: self.at_functions(collected.requested.at, &emit, &outputs, &output_groups),
            output_groups,
            forces: all(collected.forces)?.into(),
            outputs,
            gravity: collected.gravity,
            emit,
            asked: collected.requested.asked,
            ..self.blank(module)
        })
    }

    /// A model of this name, with the parts that were expanded and nothing in them.
    pub(super) fn blank(&self, module: &tree::Module) -> Model {
        Model {
            name: module.name.clone(),
            vis: module.vis.clone(),
            attrs: module.attrs.iter().filter(|attr| !docs::is_derive(attr)).cloned().collect(),
            krate: self.source.krate.clone().unwrap_or_else(runtime),
            fused: self.source.fused,
            serialised: self.source.serialised,
            externals: Rc::new(self.source.externals().map(|function| function.described()).collect()),
            part_types: self.part_types.clone(),
            instances: self.instances.clone(),
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
            solve_for: Vec::new(),
            kinematics: Vec::new(),
            assembly: None,
            output_groups: Vec::new(),
            at: Vec::new(),
            forces: IndexVec::new(),
            outputs: Vec::new(),
            gravity: None,
            emit: Vec::new(),
            asked: Vec::new(),
        }
    }

    /// What all items give.
    pub(super) fn read_all(&mut self) -> Collected<'a> {
        let mut collected = Collected::default();
        let tasks = self.tasks.clone();
        // First, so that a `let` that is read both in the equations of an unknown and behind them is no circle.
        for task in &tasks {
            if let Subject::System(id) = task.subject {
                self.solve_system(id);
            }
        }
        for task in tasks {
            self.task(task, &mut collected);
        }
        collected
    }

    /// Whether items were given up, by the parser or here: what hangs together is not known then.
    fn lost_items(&mut self) -> bool {
        let lost = self.lost || self.scopes.iter().any(|scope| scope.module.broken);
        if lost {
            self.report.silent();
        }
        lost
    }

    fn task(&mut self, task: Task<'a>, into: &mut Collected<'a>) {
        match task.subject {
            Subject::Named(id) => {
                if let ItemKind::Output(_) = task.item.kind {
                    into.outputs.push(self.finish_output(id, task.item));
                } else if let ItemKind::Speed(_) = task.item.kind {
                    into.speeds.push(self.finish_speed(id, task.item));
                } else {
                    let site = self.named[id].name.span();
                    self.named_meaning(id, site);
                }
            }
            Subject::Param(id) => {
                let site = self.params[id].item.name.span();
                self.param_type(id, site);
            }
            Subject::Input(id) => {
                self.input_type(id);
            }
            Subject::State(id) => {
                let slot = self.states[id].clone();
                into.states.push(self.finish_state(&slot));
            }
            Subject::Body(id) => {
                let slot = self.bodies[id].clone();
                into.bodies.push(self.finish_body(&slot));
                if let Some(joint) = self.absolute[id] {
                    into.joints.push(self.finish_joint(joint));
                }
            }
            Subject::Joint(id) => into.joints.push(self.finish_joint(id)),
            Subject::Force(id) => {
                let slot = self.forces[id].clone();
                into.forces.push(self.finish_force(&slot));
            }
            Subject::Constraint(id) => {
                let slot = self.constraints[id].clone();
                into.constraints.push(self.finish_constraint(&slot));
            }
            Subject::System(_) | Subject::None => {}
        }
        if !matches!(task.item.kind, ItemKind::Body { .. } | ItemKind::Joint { .. } | ItemKind::Force { .. }) {
            let attributes = docs::attributes(&task.item.attrs, self.report);
            self.refuse_cut(&attributes);
            self.refuse_waiver(&attributes);
        }
        self.other(task, into);
    }

    /// Items without a slot.
    fn other(&mut self, task: Task<'a>, into: &mut Collected<'a>) {
        let Task { scope, item, .. } = task;
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
                let handling = self.formulation(fields, scope);
                into.handling = into.handling.take().or(handling);
                into.rounds = into.rounds.or(self.rounds(fields, scope));
                into.packs = into.packs.or(self.packs(fields));
                into.chooses_speeds = into.chooses_speeds.or(self.speed_choice(fields));
                into.independent.get_or_insert((fields, scope));
            }
            ItemKind::Emit(requests) => self.emit(requests, scope, &mut into.requested),
            ItemKind::Assume(condition) => into.assumptions.push(self.assumption(condition, root(scope))),
            ItemKind::Drive { .. } | ItemKind::Solve { .. } => into.deferred.push(task),
            ItemKind::Settled(state) => self.check_settled(state, scope),
            ItemKind::Small(list) => into.small.extend(list.iter().map(|expr| (expr, scope))),
            ItemKind::Port { ty, .. } if ty != tree::UNREADABLE && !PORTS.iter().any(|known| ty == known) => {
                let help = "a port is a `Frame`, a `Joint`, a `Scalar` or a `Vec3`";
                self.report.help(ty.span(), format!("a port is no `{ty}`"), help);
            }
            _ => {}
        }
    }

    /// What needs to know the tree. Without one its mistakes are reported all the same.
    pub(super) fn loops(&mut self, collected: &Collected<'a>, tree: Option<(&Topology, &Joints)>) -> Loops {
        let mut loops = Loops::default();
        for task in &collected.deferred {
            let context = root(task.scope);
            match &task.item.kind {
                ItemKind::Drive { target, value } => match self.drive(target, value, context, tree) {
                    Some(Driven::Follows(drive)) => loops.drives.push(drive),
                    Some(Driven::Held(constraint)) => loops.held.push(constraint),
                    None => {}
                },
                ItemKind::Solve { unknowns, how } => {
                    match self.solve(unknowns, how, task.item.keyword, context, tree) {
                        Some(SolveItem::Item(solve)) => loops.solves.push(solve),
                        Some(SolveItem::Skipped(why)) => loops.skipped.push(why),
                        None => {}
                    }
                }
                _ => {}
            }
        }
        if let Some((fields, scope)) = collected.independent {
            loops.independent = self.independent(fields, scope, tree);
        }
        for (expr, scope) in &collected.small {
            let found = self.small(expr, root(*scope), tree, &loops.small);
            loops.small.extend(found);
        }
        for (request, scope) in &collected.requested.kinematics {
            loops.kinematics.extend(self.kinematics(request, *scope, tree));
        }
        if let Some((request, scope)) = collected.requested.assembly {
            loops.assembly = self.kinematics(request, scope, tree);
        }
        self.check_conflicts(&loops);
        loops
    }

    /// A coordinate is found in one way.
    fn check_conflicts(&mut self, loops: &Loops) {
        let mut driven: BTreeSet<Coordinate> = BTreeSet::new();
        let solved: BTreeSet<Coordinate> = loops.solves.iter().flat_map(|solve| &solve.unknowns).copied().collect();
        for drive in &loops.drives {
            let list = self.driven(drive.target);
            if let Some(twice) = list.iter().find(|coordinate| driven.contains(coordinate)) {
                let message = format!("{} is driven twice", self.coordinate_name(*twice));
                self.report.error(drive.span, message);
            } else if let Some(dependent) = list.iter().find(|coordinate| solved.contains(coordinate)) {
                let name = self.coordinate_name(*dependent);
                let message = format!("{name} is dependent, it follows from a `solve`: a drive can't prescribe it");
                self.report.help(drive.span, message, "drive an independent coordinate, or remove one of the two");
            }
            driven.extend(list);
        }
        for constraint in &loops.held {
            let Some(coordinate) = constraint.drive else { continue };
            if !driven.insert(coordinate) {
                let message = format!("{} is driven twice", self.coordinate_name(coordinate));
                self.report.error(constraint.span, message);
            }
        }
        let mut found: BTreeSet<Coordinate> = BTreeSet::new();
        for solve in &loops.solves {
            if let Some(twice) = solve.unknowns.iter().find(|coordinate| found.contains(coordinate)) {
                let message = format!("{} is an unknown of another `solve` already", self.coordinate_name(*twice));
                self.report.error(solve.span, message);
            }
            found.extend(&solve.unknowns);
        }
    }

    fn is_part_scope(&self, scope: super::checker::ScopeId) -> bool {
        super::is_part(self.scopes[scope].module)
    }

    fn finish_params(&mut self) -> Option<Vec<Param>> {
        let mut params = Vec::with_capacity(self.params.len());
        for id in self.params.ids() {
            let ty = self.param_type(id, Span::call_site())?;
            let mut default = Vec::new();
            self.evaluator.param(id)?.flatten(&mut default);
            let slot = &self.params[id];
            params.push(Param { place: slot.place.clone(), ty, default, docs: slot.docs.clone() });
        }
        Some(params)
    }

    fn finish_inputs(&mut self) -> Option<Vec<Input>> {
        let types: Vec<Option<Type>> = self.inputs.ids().map(|id| self.input_type(id)).collect();
        let slots = self.inputs.iter().zip(types);
        slots.map(|(slot, ty)| Some(Input { place: slot.place.clone(), ty: ty?, docs: slot.docs.clone() })).collect()
    }
}

fn all<T>(list: Vec<Option<T>>) -> Option<Vec<T>> {
    list.into_iter().collect()
}

/// `::multibody`
pub(super) fn runtime() -> Path {
    let name = syn::Ident::new("multibody", Span::call_site());
    let mut path = Path::from(name);
    path.leading_colon = Some(syn::token::PathSep::default());
    path
}
