//! Stage `mechanics`, its whole: from the checked model to expressions of every requested function.
//!
//! In: the checked model. Out: a [`Derivation`]. Where there are several ways to a function, each is a candidate, and the
//! count of the optimised code decides between them (law 5). The graph forgets between candidates: expressions of equal
//! value are one node, in the form that was made first, so a second way would come out as the first; and what one
//! function costs must not depend on which others are asked for.

use std::collections::HashSet;
use std::rc::Rc;

use crate::model::types::{BodyRef, Expr, ExprNode, Joint, JointId, JointKind, Model, Order, Request};
use crate::optimize::program::FunctionKind;
use crate::symbolic::graph::{Graph, Rotation, Scalar};

use super::equations::{Equations, Method, Style, Way};
use super::names;
use super::parallel::Axes;
use super::symbols::Symbols;
use super::{Derivation, Derived};

/// Own axes for every link, or common ones for parallel hinges.
const AXES: [Option<Axes>; 3] = [None, Some(Axes::Base), Some(Axes::Tip)];

/// A method's name with each of [`AXES`].
type Names = [&'static str; 3];

const NEWTON_EULER: Names = [
    "recursive Newton-Euler",
    "recursive Newton-Euler, parallel hinges in the axes of their base",
    "recursive Newton-Euler, parallel hinges in the axes of their tip",
];
const COMPOSITE: Names = [
    "composite rigid body",
    "composite rigid body, parallel hinges in the axes of their base",
    "composite rigid body, parallel hinges in the axes of their tip",
];
const METHODS: [(Method, Names); 2] = [
    (
        Method::Composite,
        [
            "composite rigid body, LDL^T",
            "composite rigid body, LDL^T, parallel hinges in the axes of their base",
            "composite rigid body, LDL^T, parallel hinges in the axes of their tip",
        ],
    ),
    (
        Method::Articulated,
        [
            "articulated body",
            "articulated body, parallel hinges in the axes of their base",
            "articulated body, parallel hinges in the axes of their tip",
        ],
    ),
];

/// Most coordinates of one model: a bound on the time that a derivation takes.
pub const MOST_FREEDOMS: usize = 200;

/// Beyond this many coordinates a factorisation, whose cost grows with their cube, is no candidate.
const MOST_COMPOSITE: usize = 32;

/// Derives what the model asks for, and its outputs.
pub fn derive(model: &Model) -> Derivation {
    let mut graph = Graph::new();
    let symbols = Symbols::new(&mut graph, model);
    let symbol_names = symbols.table.iter().map(|&symbol| names::symbol(model, symbol)).collect();
    let mut deriving = Deriving { model, graph, symbols };
    let functions = kinds(model).into_iter().map(|kind| Derived { kind, candidates: deriving.candidates(kind) });
    let functions = functions.collect();
    Derivation { graph: deriving.graph, symbols: deriving.symbols.table, symbol_names, functions }
}

/// What to derive, each once, in a fixed order.
fn kinds(model: &Model) -> Vec<FunctionKind> {
    let wanted = |request: Request, kinds: &[FunctionKind]| {
        if model.emit.contains(&request) { kinds.to_vec() } else { Vec::new() }
    };
    let mut kinds = wanted(Request::ForwardDynamics, &[FunctionKind::ForwardDynamics]);
    kinds.extend(wanted(Request::InverseDynamics, &[FunctionKind::InverseDynamics]));
    kinds.extend(wanted(Request::MassMatrix, &[FunctionKind::MassMatrix]));
    kinds.extend(wanted(Request::Bias, &[FunctionKind::Bias]));
    kinds.extend(wanted(Request::Energy, &[FunctionKind::KineticEnergy, FunctionKind::PotentialEnergy]));
    if !model.outputs.is_empty() {
        kinds.push(FunctionKind::Outputs);
    }
    kinds
}

type Candidate = (&'static str, Vec<Scalar>);

/// A graph that goes from candidate to candidate.
struct Deriving<'m> {
    model: &'m Model,
    graph: Graph,
    symbols: Symbols,
}

impl<'m> Deriving<'m> {
    fn candidates(&mut self, kind: FunctionKind) -> Vec<Candidate> {
        match kind {
            FunctionKind::ForwardDynamics => self.forward_dynamics(),
            FunctionKind::Outputs => self.outputs(),
            FunctionKind::InverseDynamics => self.one(NEWTON_EULER, Equations::inverse_dynamics),
            FunctionKind::Bias => self.one(NEWTON_EULER, Equations::bias),
            FunctionKind::MassMatrix => self.one(COMPOSITE, Equations::mass_matrix),
            FunctionKind::KineticEnergy => self.only("sum over links", |e| vec![e.kinetic()]),
            FunctionKind::PotentialEnergy => self.only("first moment of mass, springs", |e| vec![e.potential()]),
        }
    }

    /// One method, in the axes that [`AXES`] names.
    fn one(&mut self, names: Names, f: impl Fn(&mut Equations<'m>) -> Vec<Scalar>) -> Vec<Candidate> {
        self.in_all_axes(names, Method::Composite, &[], f)
    }

    fn in_all_axes(
        &mut self,
        names: Names,
        method: Method,
        kept: &[JointId],
        f: impl Fn(&mut Equations<'m>) -> Vec<Scalar>,
    ) -> Vec<Candidate> {
        // Common axes pay where a matrix is factored or passed on; beyond that size each way costs too much time.
        let ways = if freedoms(self.model) > MOST_COMPOSITE { 1 } else { AXES.len() };
        let ways = AXES.into_iter().zip(names).take(ways);
        ways.filter_map(|(axes, name)| self.candidate(name, Way { style: Style::Nested, method, axes }, kept, &f))
            .collect()
    }

    /// One that has no choice of axes.
    fn only(&mut self, name: &'static str, f: impl Fn(&mut Equations<'m>) -> Vec<Scalar>) -> Vec<Candidate> {
        let way = Way { style: Style::Nested, method: Method::Composite, axes: None };
        self.candidate(name, way, &[], f).into_iter().collect()
    }

    fn candidate(
        &mut self,
        name: &'static str,
        way: Way,
        kept: &[JointId],
        f: impl Fn(&mut Equations<'m>) -> Vec<Scalar>,
    ) -> Option<Candidate> {
        let mut graph = std::mem::take(&mut self.graph);
        graph.forget();
        let mut equations = Equations::new(self.model, graph, self.symbols.clone(), way, kept);
        let exists = way.axes.is_none() || equations.shared().turns.iter().any(|&turn| turn != Rotation::IDENTITY);
        let results = if exists { f(&mut equations) } else { Vec::new() };
        self.graph = equations.g;
        exists.then_some((name, results))
    }

    fn forward_dynamics(&mut self) -> Vec<Candidate> {
        let model = self.model;
        let needs = Needs::of(model.states.iter().map(|state| &state.rate));
        let kept = needs.kept(model);
        let all = |equations: &mut Equations<'m>| {
            let mut results = equations.accelerations().to_vec();
            results.extend(model.states.iter().map(|state| equations.scalar(&state.rate)));
            results
        };
        let methods = match articulates(model, &kept) {
            true if freedoms(model) > MOST_COMPOSITE => &METHODS[1..],
            true => &METHODS[..],
            false => &METHODS[..1],
        };
        let mut candidates = Vec::new();
        for &(method, names) in methods {
            candidates.extend(self.in_all_axes(names, method, &kept, all));
        }
        if floats(model) && freedoms(model) <= MOST_COMPOSITE {
            let name = "composite rigid body, LDL^T, translations first";
            let way = Way { style: Style::Nested, method: Method::Floating, axes: None };
            candidates.extend(self.candidate(name, way, &kept, all));
        }
        candidates
    }

    fn outputs(&mut self) -> Vec<Candidate> {
        let model = self.model;
        let needs = Needs::of(model.outputs.iter().map(|output| &output.value));
        let kept = needs.kept(model);
        let all = |equations: &mut Equations<'m>| {
            let mut results = Vec::new();
            for output in &model.outputs {
                let value = equations.value(&output.value);
                value.flatten(&mut equations.g, &mut results);
            }
            results
        };
        let articulates = needs.accelerations && articulates(model, &kept);
        let mut ways = Vec::new();
        if !(articulates && freedoms(model) > MOST_COMPOSITE) {
            ways.push((Style::World, Method::Composite, "world axes"));
            if needs.frames {
                ways.push((Style::Nested, Method::Composite, "link axes"));
            }
        }
        if articulates {
            ways.push((Style::World, Method::Articulated, "world axes, articulated body"));
            if needs.frames {
                ways.push((Style::Nested, Method::Articulated, "link axes, articulated body"));
            }
        }
        let candidates = ways
            .into_iter()
            .filter_map(|(style, method, name)| self.candidate(name, Way { style, method, axes: None }, &kept, all));
        candidates.collect()
    }
}

/// Whether the articulated-body algorithm is another way: with one coordinate it is the same one, and it would move the
/// links of `Fixed` joints that are kept for their reactions.
fn articulates(model: &Model, kept: &[JointId]) -> bool {
    kept.is_empty() && freedoms(model) > 1
}

/// Whether something moves about in the world by translations.
fn floats(model: &Model) -> bool {
    let floating = |joint: &Joint| matches!(joint.kind, JointKind::Free(_) | JointKind::Planar { .. });
    model.joints.iter().any(|joint| floating(joint) && joint.parent.body == BodyRef::Ground)
}

/// Number of velocity coordinates.
pub fn freedoms(model: &Model) -> usize {
    model.joints.iter().map(|joint| joint.kind.freedoms()).sum()
}

/// What expressions ask for.
#[derive(Default)]
struct Needs {
    frames: bool,
    accelerations: bool,
    reactions: Vec<JointId>,
}

impl Needs {
    fn of<'m>(roots: impl Iterator<Item = &'m Expr>) -> Needs {
        let mut needs = Needs::default();
        let mut seen = HashSet::new();
        let mut stack: Vec<&Expr> = roots.collect();
        while let Some(expr) = stack.pop() {
            if !seen.insert(Rc::as_ptr(&expr.node)) {
                continue;
            }
            match &*expr.node {
                ExprNode::OfFrame(_, quantity) => {
                    use crate::model::types::FrameQuantity::{Acceleration, AngularAcceleration};
                    needs.frames = true;
                    needs.accelerations |= matches!(quantity, Acceleration | AngularAcceleration);
                }
                ExprNode::Power(_) | ExprNode::Express { .. } => needs.frames = true,
                ExprNode::Coordinate { order: Order::Acceleration, .. } => needs.accelerations = true,
                ExprNode::Reaction { joint, .. } => {
                    needs.accelerations = true;
                    needs.reactions.push(*joint);
                }
                _ => {}
            }
            stack.extend(super::expressions::operands(&expr.node));
        }
        needs
    }

    /// `Fixed` joints whose reactions are asked for.
    fn kept(&self, model: &Model) -> Vec<JointId> {
        let fixed = |id: &JointId| model.joints.get(id.0).is_some_and(|joint| matches!(joint.kind, JointKind::Fixed));
        self.reactions.iter().copied().filter(fixed).collect()
    }
}
