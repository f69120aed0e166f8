//! Stage `model`: what is known of one model while it is checked.
//!
//! In: modules of the syntax tree. Out: scopes with their names, slots that the later steps fill, and the lazy
//! resolution of named values with its guard against circles.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use proc_macro2::{Ident, Span};

use crate::invariant::fault::OrFault;
use crate::invariant::index_vec::{IndexVec, id};
use crate::syntax::tree;

use super::checks::evaluate::Evaluator;
use super::expressions::bodies::Selected;
use super::expressions::formulas::Elsewhere;
use super::items::coordinates::Coordinates;
use super::joint_kinds::JointKind;
use super::report::Report;
use super::typed::{FrameValue, Typed};
use super::types::{
    BodyId, BodyRef, ConstraintId, Docs, Expr, ExternalId, ForceId, InputId, Instance, InstanceId, JointId, ParamId,
    PartType, PartTypeId, Place, StateId, Type,
};
use super::units::Declared;
use super::units::quantities::Quantity;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ScopeId(pub(super) usize);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NamedId(pub(super) usize);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SystemId(pub(super) usize);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FunctionId(pub(super) usize);

id!(ScopeId, NamedId, SystemId, FunctionId);

/// Bound on the expressions of one model, once all parts are expanded.
const MAX_EXPRESSIONS: usize = 1_000_000;

/// Of the model, or of the part that is checked by itself.
pub(super) const FIRST_SCOPE: ScopeId = ScopeId(0);

/// Ids from here on stand for what the ports of a part by itself lead to: more than there are items.
pub(super) const FIRST_OF_PORTS: BodyId = BodyId(usize::MAX / 2);

/// Names of one instance of a module. A part does not see the names of the model around it.
pub(super) struct Scope<'a> {
    pub(super) module: &'a tree::Module,
    pub(super) instance: InstanceId,
    pub(super) names: BTreeMap<String, Symbol>,
    /// Outputs have names of their own: an expression that names something finds an output last.
    pub(super) outputs: BTreeMap<String, NamedId>,
}

impl Scope<'_> {
    /// What `name` stands for in expressions.
    pub(super) fn symbol(&self, name: &str) -> Option<Symbol> {
        let output = || self.outputs.get(name).map(|id| Symbol::Named(*id, "output"));
        self.names.get(name).cloned().or_else(output)
    }
}

/// What a name stands for.
#[derive(Clone)]
pub(super) enum Symbol {
    /// Its slot is not made yet: only counts of parts are evaluated so early.
    Pending(&'static str),
    /// Reported already; the keyword is for messages.
    Opaque(&'static str),
    /// `const`, `let`, `speed`, `output`, a param set from outside, a bound port.
    Named(NamedId, &'static str),
    Param(ParamId),
    Input(InputId),
    State(StateId),
    Body(BodyId),
    Joint(JointId),
    Force(ForceId),
    Constraint(ConstraintId),
    /// An unknown of equations of the user's own.
    Unknown(SystemId, usize),
    Part(ScopeId),
    Parts(Rc<[ScopeId]>),
    /// `let name(x) = ..;`
    Function(FunctionId),
    /// `extern name(x) = ..;`
    External(ExternalId),
}

impl Symbol {
    /// The keyword that made it.
    pub(super) fn keyword(&self) -> &'static str {
        match self {
            Symbol::Pending(keyword) | Symbol::Opaque(keyword) | Symbol::Named(_, keyword) => keyword,
            Symbol::Param(_) => "param",
            Symbol::Input(_) => "input",
            Symbol::State(_) => "state",
            Symbol::Body(_) => "body",
            Symbol::Joint(_) => "joint",
            Symbol::Force(_) => "force",
            Symbol::Constraint(_) => "constraint",
            Symbol::Unknown(..) => "solve",
            Symbol::Part(_) | Symbol::Parts(_) => "part",
            Symbol::Function(_) => "let",
            Symbol::External(_) => "extern",
        }
    }
}

/// Where an expression stands: its scope, the index of `|i|` if it belongs to an array of parts, and the call whose
/// arguments it names if it belongs to a function.
#[derive(Clone, Copy)]
pub(super) struct Context<'a> {
    pub(super) scope: ScopeId,
    pub(super) index: Option<(&'a Ident, usize)>,
    /// Place among the calls that are being expanded: a context with one lives no longer than that call.
    pub(super) call: Option<usize>,
}

/// A function of the user's own, in one instance of its module.
pub(super) struct DefinedFunction<'a> {
    pub(super) item: &'a tree::Function,
    /// Where all names in its value are looked up but those of its arguments.
    pub(super) scope: ScopeId,
    /// Of its value, declared with it.
    pub(super) unit: Option<Declared>,
    /// It leads back to itself, or there are too many calls, which has been reported: calls are expanded no more.
    pub(super) refused: bool,
}

/// A call of a function while its value is read.
pub(super) struct Call {
    pub(super) function: FunctionId,
    /// In the order of the function's own names for them.
    pub(super) arguments: Vec<Meaning>,
}

/// What an expression means before it is asked for a value.
#[derive(Clone)]
pub(super) enum Meaning {
    Value(Typed),
    Frame(FrameValue),
    Joint(JointId),
    /// One scalar coordinate of a joint.
    Coordinate(JointId, usize),
    Force(ForceId),
    Constraint(ConstraintId),
    Part(ScopeId),
    Parts(Rc<[ScopeId]>),
}

/// Something that is worked out when it is first asked for.
#[derive(Clone)]
pub(super) enum Lazy<T> {
    Waiting,
    /// Met again in this state, it is a circle.
    Working,
    /// `None`: reported.
    Done(Option<T>),
}

pub(super) struct Named<'a> {
    pub(super) name: &'a Ident,
    pub(super) role: Role,
    pub(super) context: Context<'a>,
    /// The declaration, and the scope in which its type (and a bound param's own default) is read.
    pub(super) item: Option<&'a tree::Value>,
    pub(super) home: ScopeId,
    /// The value, read in `context`.
    pub(super) expr: Option<&'a syn::Expr>,
    /// Declared with it.
    pub(super) unit: Option<Declared>,
    pub(super) state: Lazy<Meaning>,
}

impl Named<'_> {
    /// Its meaning, if that has been asked for and is sound.
    pub(super) fn known(&self) -> Option<&Meaning> {
        match &self.state {
            Lazy::Done(meaning) => meaning.as_ref(),
            Lazy::Waiting | Lazy::Working => None,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Const,
    Let,
    /// A velocity coordinate; in expressions what it stands for.
    Speed,
    Output,
    BoundParam,
    Port,
    /// A port for a coordinate.
    JointPort,
    /// A port for a value.
    Signal,
}

/// Equations of the user's own, for unknowns of theirs.
pub(super) struct System<'a> {
    pub(super) unknowns: Vec<&'a Ident>,
    /// Number of the first unknown among those of all systems.
    pub(super) first: usize,
    pub(super) equations: Vec<Equation<'a>>,
    /// What chooses one of several solutions.
    pub(super) branches: &'a [syn::Expr],
    pub(super) scope: ScopeId,
    /// Of the item.
    pub(super) span: Span,
    pub(super) state: Lazy<Rc<[Typed]>>,
}

#[derive(Clone, Copy)]
pub(super) enum Equation<'a> {
    /// Two sides.
    Equal(&'a syn::Expr, &'a syn::Expr),
    /// A rate that is zero.
    Settled(&'a syn::Expr),
}

/// What it takes to resolve a [`Named`].
pub(super) struct NamedRequest<'a> {
    pub(super) role: Role,
    pub(super) context: Context<'a>,
    pub(super) item: Option<&'a tree::Value>,
    pub(super) home: ScopeId,
    pub(super) expr: Option<&'a syn::Expr>,
}

pub(super) struct ParamSlot<'a> {
    pub(super) place: Place,
    pub(super) item: &'a tree::Value,
    pub(super) scope: ScopeId,
    pub(super) docs: Docs,
    /// Its type; the default's value is with the evaluator.
    pub(super) state: Lazy<Type>,
    /// Known when the type is.
    pub(super) default: Option<Expr>,
}

pub(super) struct InputSlot<'a> {
    pub(super) place: Place,
    pub(super) item: &'a tree::Value,
    pub(super) scope: ScopeId,
    pub(super) docs: Docs,
    pub(super) state: Lazy<Type>,
}

/// What expressions need to know of a joint.
pub(super) struct JointSlot<'a> {
    pub(super) place: Place,
    /// The joint's, or the body's for the implicit joint of absolute coordinates.
    pub(super) item: &'a tree::Item,
    pub(super) scope: ScopeId,
    /// `None`: unknown kind, reported.
    pub(super) kind: Option<&'static JointKind>,
    /// The frames, where they could be read.
    pub(super) frames: Lazy<[FrameValue; 2]>,
}

/// A body, force, or state of the user: place and syntax.
#[derive(Clone)]
pub(super) struct Slot<'a> {
    pub(super) place: Place,
    pub(super) item: &'a tree::Item,
    pub(super) scope: ScopeId,
}

/// An item of one instance, to be checked in source order once all names are known.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    pub(super) scope: ScopeId,
    pub(super) item: &'a tree::Item,
    pub(super) subject: Subject,
}

/// What stands behind the item of a [`Task`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Subject {
    None,
    Named(NamedId),
    Param(ParamId),
    Input(InputId),
    State(StateId),
    Body(BodyId),
    Joint(JointId),
    Force(ForceId),
    Constraint(ConstraintId),
    System(SystemId),
}

pub(super) struct Checker<'a, 'd> {
    pub(super) source: &'a tree::Source,
    /// First module of each name.
    pub(super) modules: &'a BTreeMap<String, usize>,
    /// Modules that stand above and are models without mistakes.
    pub(super) sound: &'a BTreeSet<usize>,
    pub(super) report: &'a mut Report<'d>,
    pub(super) scopes: IndexVec<ScopeId, Scope<'a>>,
    pub(super) named: IndexVec<NamedId, Named<'a>>,
    pub(super) systems: IndexVec<SystemId, System<'a>>,
    pub(super) functions: IndexVec<FunctionId, DefinedFunction<'a>>,
    /// Calls that are being expanded, outermost first.
    pub(super) calls: Vec<Call>,
    /// Calls that have been expanded so far.
    pub(super) expanded_calls: usize,
    /// Values of calls for which the function declares a unit.
    pub(super) returned: Vec<Expr>,
    /// Of values of functions of Rust, declared with these.
    pub(super) external_units: BTreeMap<ExternalId, Declared>,
    /// Values that read unknowns of systems that are being solved.
    pub(super) opened: Vec<NamedId>,
    pub(super) part_types: IndexVec<PartTypeId, PartType>,
    /// Module of each part type, and the params that its instances set, with the first instance's name.
    pub(super) part_modules: IndexVec<PartTypeId, (usize, Vec<String>, String)>,
    pub(super) instances: IndexVec<InstanceId, Instance>,
    pub(super) params: IndexVec<ParamId, ParamSlot<'a>>,
    pub(super) inputs: IndexVec<InputId, InputSlot<'a>>,
    pub(super) states: IndexVec<StateId, Slot<'a>>,
    pub(super) bodies: IndexVec<BodyId, Slot<'a>>,
    pub(super) joints: IndexVec<JointId, JointSlot<'a>>,
    pub(super) forces: IndexVec<ForceId, Slot<'a>>,
    pub(super) constraints: IndexVec<ConstraintId, Slot<'a>>,
    /// What `formulation` says about the coordinates of all bodies.
    pub(super) coordinates: Option<Coordinates>,
    /// Its implicit joint on the ground, where its coordinates are absolute.
    pub(super) absolute: IndexVec<BodyId, Option<JointId>>,
    /// Where coordinates, rates, .. of joints are named.
    pub(super) coordinate_uses: Vec<(JointId, Span)>,
    /// Where several bodies are asked about as one.
    pub(super) selected: Vec<Selected>,
    pub(super) tasks: Vec<Task<'a>>,
    pub(super) evaluator: Evaluator,
    /// What has become part of something else, such as the mass in `rod(mass, ..)`, with the unit that it should have.
    pub(super) quantities: Vec<(Expr, Quantity)>,
    /// What is asked of other models, by the call.
    pub(super) asked_elsewhere: Elsewhere,
    /// Modules that are being expanded, outermost first.
    pub(super) expanding: Vec<usize>,
    /// Items so far, over all instances.
    pub(super) expanded: usize,
    /// A part by itself: its ports lead nowhere.
    pub(super) alone: bool,
    /// A port of it leads to a coordinate whose unit is not known.
    pub(super) open_unit: bool,
    pub(super) ports: usize,
    /// An item is missing: how the rest hangs together is not known.
    pub(super) lost: bool,
    /// Expressions that may still be resolved.
    pub(super) fuel: usize,
    /// Nesting of expressions that are being resolved.
    pub(super) depth: usize,
}

impl<'a, 'd> Checker<'a, 'd> {
    pub(super) fn new(
        source: &'a tree::Source,
        modules: &'a BTreeMap<String, usize>,
        sound: &'a BTreeSet<usize>,
        report: &'a mut Report<'d>,
        alone: bool,
    ) -> Self {
        Checker {
            source,
            modules,
            sound,
            report,
            scopes: IndexVec::new(),
            named: IndexVec::new(),
            systems: IndexVec::new(),
            functions: IndexVec::new(),
            calls: Vec::new(),
            expanded_calls: 0,
            returned: Vec::new(),
            external_units: BTreeMap::new(),
            opened: Vec::new(),
            part_types: IndexVec::new(),
            part_modules: IndexVec::new(),
            instances: IndexVec::new(),
            params: IndexVec::new(),
            inputs: IndexVec::new(),
            states: IndexVec::new(),
            bodies: IndexVec::new(),
            joints: IndexVec::new(),
            forces: IndexVec::new(),
            constraints: IndexVec::new(),
            coordinates: None,
            absolute: IndexVec::new(),
            coordinate_uses: Vec::new(),
            selected: Vec::new(),
            tasks: Vec::new(),
            evaluator: Evaluator::default(),
            quantities: Vec::new(),
            asked_elsewhere: Elsewhere::default(),
            expanding: Vec::new(),
            expanded: 0,
            alone,
            open_unit: false,
            ports: 0,
            lost: false,
            fuel: MAX_EXPRESSIONS,
            depth: 0,
        }
    }

    /// The module that is checked.
    pub(super) fn module(&self) -> usize {
        let own = &self.scopes[FIRST_SCOPE].module.name;
        let mut modules = self.source.modules.iter();
        modules.position(|module| std::ptr::eq(&module.name, own)).or_fault("the module is one of the call")
    }

    /// The joint on the ground that stands for the coordinates of a body; nothing where they are those of its joints, and for what
    /// a port of a part by itself leads to, which is no body of this model.
    pub(super) fn own_joint(&self, body: BodyRef) -> Option<JointId> {
        match body {
            BodyRef::Body(id) if id >= FIRST_OF_PORTS => None,
            BodyRef::Body(id) => self.absolute[id],
            BodyRef::Ground => None,
        }
    }

    /// The value behind a `const`, `let`, `output`, bound param or port, asked for at `site`.
    pub(super) fn named_meaning(&mut self, id: NamedId, site: Span) -> Option<Meaning> {
        let named = &mut self.named[id];
        match &named.state {
            Lazy::Done(meaning) => return meaning.clone(),
            Lazy::Working => {
                let name = named.name;
                self.report.error(site, format!("`{name}` is defined through itself"));
                return None;
            }
            Lazy::Waiting => named.state = Lazy::Working,
        }
        let request = NamedRequest {
            role: named.role,
            context: named.context,
            item: named.item,
            home: named.home,
            expr: named.expr,
        };
        let mut meaning = self.resolve_named(&request);
        self.check_joint_unit(id, meaning.as_ref());
        let named = &mut self.named[id];
        if let (Some(unit), Some(Meaning::Value(value))) = (&named.unit, &mut meaning) {
            value.expr.unit = Some(Rc::new(unit.clone().over(value.expr.unit.take())));
        }
        // Inside its equations an unknown is another value than behind them: kept until these are solved.
        if matches!(&meaning, Some(Meaning::Value(value)) if self.holds_unknown(&value.expr)) {
            self.opened.push(id);
        }
        self.named[id].state = Lazy::Done(meaning.clone());
        meaning
    }

    /// The type of a param, asked for at `site`; its default is known to the evaluator afterwards.
    pub(super) fn param_type(&mut self, id: ParamId, site: Span) -> Option<Type> {
        let slot = &mut self.params[id];
        match &slot.state {
            Lazy::Done(ty) => return ty.clone(),
            Lazy::Working => {
                let name = &slot.item.name;
                let message = format!("the default of `{name}` is defined through itself");
                self.report.error(site, message);
                return None;
            }
            Lazy::Waiting => slot.state = Lazy::Working,
        }
        let (item, scope) = (slot.item, slot.scope);
        let found = self.resolve_param(item, scope);
        let default = found.map(|(expr, value)| {
            self.evaluator.set_param(id, value);
            expr
        });
        let ty = default.as_ref().map(|expr| expr.ty.clone());
        let slot = &mut self.params[id];
        slot.state = Lazy::Done(ty.clone());
        slot.default = default;
        ty
    }

    /// The type of an input.
    pub(super) fn input_type(&mut self, id: InputId) -> Option<Type> {
        let slot = &self.inputs[id];
        if let Lazy::Done(ty) = &slot.state {
            return ty.clone();
        }
        let (item, scope) = (slot.item, slot.scope);
        let ty = self.resolve_input(item, scope);
        self.inputs[id].state = Lazy::Done(ty.clone());
        ty
    }
}
