//! Stage `mechanics`, its whole: from the checked model to expressions of every requested function.
//!
//! In: the checked model. Out: a [`Derivation`]. Where there are several ways to a function, each is a candidate, and the
//! count of the optimised code decides between them. The graph forgets between candidates: expressions of equal
//! value are one node, in the form that was made first, so a second way would come out as the first; and what one
//! function costs must not depend on which others are asked for.

mod assembly;
mod checks;
mod derivatives;
pub(in crate::mechanics) mod formula;
mod impulses;
mod inertia;
mod labels;
mod motion;
mod patterns;
mod recipes;
mod ways;
mod witnesses;

pub use patterns::{Entry, Patterns, patterns};

use std::cell::Cell;
use std::rc::Rc;

use crate::contracts::function::{Asked, FunctionKind};
use crate::contracts::results::Results;
use crate::dynamics::shared_axes::SharedAxes;
use crate::invariant::fault::raise;
use crate::model::site::Sited;
use crate::model::types::{BodyRef, Coordinate, Joint, JointId, Model, Packs, Request};
use crate::symbolic::graph::{Graph, Scalar};

use super::analysis::{Complaint, Hope, Pose, Writings};
use super::limbs::Limbs;
use super::loops::advice::Pivoted;
use super::loops::constraints::Writing;
use super::loops::known::Decided;
use super::loops::solutions::Solutions;
use super::loops::structure::{Modes, Role, Structure};
use super::results::{euler_singularities, first_order};
use super::scene::{Choices, Method};
use super::strut::inverse;
use super::translate::dependencies::Dependencies;
use super::translate::symbols::{Symbols, freedoms_of};
use super::translate::{manipulations, names};
use super::written::Page;
use super::{Derivation, Derived, Inertia};

/// Own axes for every link, or common ones for parallel hinges.
const AXES: [Option<SharedAxes>; 3] = [None, Some(SharedAxes::Base), Some(SharedAxes::Tip)];

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

const EMBEDDED: Names = [
    "articulated body, loops embedded",
    "articulated body, loops embedded, parallel hinges in the axes of their base",
    "articulated body, loops embedded, parallel hinges in the axes of their tip",
];

const LUMPED: &str = "Newton-Euler, links that turn together gathered";

/// Most ways to the equations of a body on struts.
const MOST_STRUT_WAYS: usize = 6;

/// Most coordinates of one model: a bound on the time that a derivation takes.
pub const MOST_FREEDOMS: usize = 200;

/// Beyond this many coordinates a factorisation, whose cost grows with their cube, is no candidate.
const MOST_COMPOSITE: usize = 32;

/// Derives what the model asks for, and its outputs.
pub fn derive(model: &Model, structure: &Structure) -> Result<Derivation, Vec<Complaint>> {
    let mut deriving = Deriving::new(model, structure);
    deriving.check_manipulations()?;
    deriving.check_impulses()?;
    deriving.check()?;
    deriving.choose_writing()?;
    let (mut functions, pivoted) = deriving.functions()?;
    functions.extend(deriving.found()?);
    let at = at_functions(model, &functions)?;
    let checks = deriving.checks()?;
    let inertia = deriving.inertia()?;
    for function in &functions {
        for (_, results) in &function.candidates {
            deriving.label(function.kind, &results.list);
            if !results.apart.is_empty() {
                deriving.label(function.kind, &results.apart);
            }
        }
    }
    if let Inertia::Own(entries) = &inertia {
        deriving.label(FunctionKind::MassMatrix, entries);
    }
    let read = [Request::Report, Request::Equations];
    let page = if read.iter().any(|request| model.emit.contains(request)) { Some(deriving.page()?) } else { None };
    // Last, so that nothing of them is found by what is emitted.
    let asked: Vec<FunctionKind> = functions.iter().map(|function| function.kind).collect();
    let witnesses = deriving.witnesses(&asked)?;
    let mut turns = Vec::new();
    deriving.only("", |e| {
        turns = e.turning();
        Ok(Results::default())
    })?;
    let limbs = (model.packs == Packs::Four).then(|| {
        let value = |&(symbol, value): &(Scalar, Scalar)| {
            Some((deriving.graph.symbol_id(symbol)?, deriving.graph.literal(value)?.value()))
        };
        Limbs::of(model).with_numbers(deriving.decided.numbers.iter().filter_map(value).collect())
    });
    let Deriving { graph, symbols, notes, dead_centres, modes, .. } = deriving;
    let symbol_names = symbols.table.iter().map(|&symbol| names::symbol(model, symbol)).collect();
    let symbols = symbols.table.clone();
    Ok(Derivation {
        graph,
        symbols,
        symbol_names,
        functions,
        at,
        notes,
        dead_centres,
        modes,
        pivoted,
        page,
        checks,
        inertia,
        witnesses,
        turns,
        limbs,
    })
}

/// The equations of a model for readers, with loops closed as they are in the generated functions.
pub fn page(model: &Model, structure: &Structure) -> Result<Page, Vec<Complaint>> {
    let mut deriving = Deriving::new(model, structure);
    deriving.check_manipulations()?;
    deriving.check()?;
    deriving.choose_writing()?;
    deriving.page()
}

/// What would have to be assumed of coordinates for more equations with multipliers to be absorbed, each of which keeps so much
/// of the volume that they span: a list for each way to write the equations, if there is something to assume.
pub fn hopes(model: &Model, structure: &Structure, share: f64) -> Result<Vec<Vec<(Coordinate, Hope)>>, Vec<Complaint>> {
    let mut deriving = Deriving::new(model, structure);
    deriving.check()?;
    let mut all: Vec<Vec<(Coordinate, Hope)>> = Vec::new();
    let ways =
        if freedoms(model) > MOST_COMPOSITE { vec![structure.writing] } else { Writings::new(model, structure).ways() };
    for writing in ways {
        deriving.writing = writing;
        let mut found = Vec::new();
        deriving.only("", |e| {
            let reduction = e.reduce()?;
            found = e.hopes(&reduction, share);
            Ok(Results::default())
        })?;
        if !found.is_empty() && !all.contains(&found) {
            all.push(found);
        }
    }
    Ok(all)
}

/// Solutions of `solve` items without conditions, from one of them on, at some poses; nothing of those without a closed form. What else
/// the items have to do with each other is of no account.
pub fn solutions(
    model: &Model,
    structure: &Structure,
    from: usize,
    poses: &[Pose],
) -> Result<Vec<Option<Solutions>>, Vec<Complaint>> {
    let mut deriving = Deriving::new(model, structure);
    let (mut found, mut plans) = (Vec::new(), Vec::new());
    deriving.only("", |e| {
        found = (from..model.solves.len()).map(|number| e.solutions_at(number, poses, &mut plans)).collect();
        Ok(Results::default())
    })?;
    Ok(found)
}

/// Whether coordinates that follow stand at some poses where these have them.
pub fn agrees(model: &Model, structure: &Structure, poses: &[Pose]) -> Result<bool, Vec<Complaint>> {
    let mut deriving = Deriving::new(model, structure);
    let mut agrees = false;
    deriving.only("", |e| {
        let reduction = e.reduce()?;
        agrees = e.agrees(&reduction, poses);
        Ok(Results::default())
    })?;
    Ok(agrees)
}

/// Functions that go on from a position; what is wrong where one of them is not derived.
fn at_functions(model: &Model, functions: &[Derived]) -> Result<Vec<FunctionKind>, Vec<Complaint>> {
    let (mut found, mut complaints) = (Vec::new(), Vec::new());
    for wanted in &model.at {
        let mut kinds = functions.iter().map(|function| function.kind);
        match kinds.find(|kind| kind.method(model) == wanted.name) {
            Some(kind) => found.push(kind),
            None => {
                let name = &wanted.name;
                let (message, help) = match name.as_str() {
                    "velocity" => ("`velocity` is not emitted: `impulse` gives the same", "name `impulse`".to_owned()),
                    _ => ("no equation of this model keeps a multiplier", format!("there is no function `{name}`")),
                };
                complaints.push(Complaint { at: wanted.site(), message: message.to_owned(), help: Some(help) });
            }
        }
    }
    if complaints.is_empty() { Ok(found) } else { Err(complaints) }
}

/// What to derive, each once, in a fixed order.
fn kinds(model: &Model, structure: &Structure) -> Vec<FunctionKind> {
    // What integrates positions, and what projects them, asks how they move where velocities are others.
    let moved = model.emit.contains(&Request::ForwardDynamics) || !structure.rows.is_empty();
    let moves = structure.has_speeds() && moved;
    let wanted = |kind: FunctionKind| match (kind, kind.row().asked) {
        (FunctionKind::Kinematics(_), _) => (0..model.kinematics.len()).map(FunctionKind::Kinematics).collect(),
        (FunctionKind::OutputGroup(_), _) => (0..model.output_groups.len()).map(FunctionKind::OutputGroup).collect(),
        // Velocities from momenta are the jump under an impulse: with both, one function serves.
        (FunctionKind::MomentumVelocity, _) if model.emit.contains(&Request::Impulse) => Vec::new(),
        (_, Asked::By { request, .. }) => vec![kind; usize::from(model.emit.contains(&request))],
        (FunctionKind::PositionJacobian, _) if !moves => Vec::new(),
        (_, Asked::Equations) => vec![kind; usize::from(!structure.rows.is_empty())],
        (FunctionKind::RateDerivatives, _) if !model.emit.contains(&Request::Derivatives) => Vec::new(),
        (_, Asked::Speeds) => vec![kind; usize::from(moves)],
        (_, Asked::Guesses) => vec![kind; usize::from(structure.guesses() > 0)],
        (_, Asked::Outputs) => vec![kind; usize::from(!model.outputs.is_empty())],
        (_, Asked::Found) => Vec::new(),
    };
    FunctionKind::ALL.into_iter().flat_map(wanted).collect()
}

type Candidate = (&'static str, Results<Scalar>);

type Candidates = Result<Vec<Candidate>, Vec<Complaint>>;

/// A graph that goes from candidate to candidate.
struct Deriving<'m> {
    model: &'m Model,
    structure: Rc<Structure>,
    graph: Graph,
    symbols: Rc<Symbols>,
    /// What goes from candidate to candidate with it.
    decided: Decided<'m>,
    /// How equations of loops are written.
    writing: Writing,
    /// Sentences for the report.
    notes: Vec<String>,
    /// Unknowns whose closed forms have a root, and pitches.
    dead_centres: Vec<Coordinate>,
    /// How many assembly modes there are.
    modes: Option<Modes>,
    /// What asks for the function that is derived.
    request: Option<Request>,
    /// Whether something was refused that takes slopes of slopes of functions of Rust.
    curved: bool,
    /// By candidate of the function that is derived what became of equations with multipliers.
    pivoted: Vec<Pivoted>,
}

/// Results of one way, or what is wrong with the model.
type Found = Result<Results<Scalar>, Vec<Complaint>>;

impl<'m> Deriving<'m> {
    fn new(model: &'m Model, structure: &Structure) -> Self {
        let mut graph = Graph::new();
        let structures = structure.closures.iter().flatten().chain(&structure.assembly).map(|other| &**other);
        let guesses = structures.chain([structure]).map(Structure::guesses).max().unwrap_or(0);
        let symbols = Symbols::new(&mut graph, model).with_structure(&mut graph, model, structure, guesses);
        let symbols = symbols.with_impulses(&mut graph, model, structure).with_alternative(&mut graph, model);
        Deriving {
            model,
            structure: Rc::new(structure.clone()),
            graph,
            symbols: Rc::new(symbols),
            decided: Decided::default(),
            writing: structure.writing,
            notes: Vec::new(),
            dead_centres: Vec::new(),
            modes: None,
            request: None,
            curved: false,
            pivoted: Vec::new(),
        }
    }

    /// Equations for readers.
    fn page(&mut self) -> Result<Page, Vec<Complaint>> {
        // Reactions of `Fixed` joints are told only where these stay joints.
        let model = self.model;
        let told = model.outputs.iter().map(|output| &output.value).chain(model.states.iter().map(|state| &state.rate));
        let kept = Dependencies::of(told).kept(model);
        let mut page = Page::default();
        let way = Choices { for_readers: true, ..self.way() };
        self.candidate("", way, &kept, &mut |e| {
            page = e.page()?;
            Ok(Results::default())
        })?;
        Ok(page)
    }

    /// What was asked for, and what became of equations with multipliers in the candidates of forward dynamics.
    fn functions(&mut self) -> Result<(Vec<Derived>, Vec<Pivoted>), Vec<Complaint>> {
        let model = self.model;
        let (mut functions, mut pivoted) = (Vec::new(), Vec::new());
        for kind in kinds(model, &self.structure) {
            self.pivoted.clear();
            self.request = match kind.row().asked {
                Asked::By { request, .. } => Some(request),
                _ => None,
            };
            let candidates = self.candidates(kind)?;
            if candidates.is_empty() && kind == FunctionKind::AssemblyCondition {
                // Where no point tells the modes.
                continue;
            }
            if candidates.is_empty() {
                raise("there is a way to each function");
            }
            if kind == FunctionKind::ForwardDynamics && self.pivoted.len() == candidates.len() {
                pivoted = std::mem::take(&mut self.pivoted);
            }
            functions.push(Derived { kind, candidates });
        }
        Ok((functions, pivoted))
    }

    /// What was found to be needed.
    fn found(&mut self) -> Result<Vec<Derived>, Vec<Complaint>> {
        let forward = self.model.emit.contains(&Request::ForwardDynamics);
        let kinds = [
            (FunctionKind::DeadCentres, !self.dead_centres.is_empty()),
            (FunctionKind::Margins, forward && self.may_reach_dead_centres()),
            (FunctionKind::Granted, forward && !self.structure.granted.is_empty()),
            (FunctionKind::Displacement, forward && self.structure.is_projected_by_zeros()),
        ];
        let wanted = kinds.into_iter().filter(|kind| kind.1);
        wanted.map(|(kind, _)| Ok(Derived { kind, candidates: self.candidates(kind)? })).collect()
    }

    /// Inputs of a body on struts.
    fn strut_inputs(&mut self) -> Candidates {
        let mut candidates = Vec::new();
        for at in 0..MOST_STRUT_WAYS {
            let found = self.maybe(self.way(), |e| {
                let reduction = e.reduce()?;
                let Some(platform) = e.platform(&reduction) else { return Ok(None) };
                let ways = inverse::ways(&platform.carrier, platform.assumed(), e.is_packed());
                let name = ways.get(at).map(|way| way.0);
                let results = e.platform_inputs(&platform, &reduction, at).map(|results| e.with_numbers(results));
                Ok(name.zip(results))
            })?;
            let Some(found) = found else { break };
            candidates.push(found);
        }
        Ok(candidates)
    }

    /// Whether loops are solved in a way that ends in dead centres.
    fn may_reach_dead_centres(&self) -> bool {
        let dependent = |c: &Coordinate| matches!(self.structure.role(*c), Role::Dependent(_));
        self.structure.guesses() > 0 || self.structure.has_speeds() || self.dead_centres.iter().any(dependent)
    }

    /// Whether every coordinate is in the state and no equation keeps a multiplier.
    fn is_open(&self) -> bool {
        let roles = self.structure.roles.iter().flatten();
        let is_exact = self.model.small.is_empty();
        let plain = is_exact && !self.structure.has_speeds();
        plain && self.structure.rows.is_empty() && roles.copied().all(|role| role == Role::State)
    }

    /// Derivatives, substitutions and entries are of what is in the state.
    fn check_manipulations(&self) -> Result<(), Vec<Complaint>> {
        let mut complaints = manipulations::complaints(self.model, &self.structure);
        complaints.extend(first_order::complaints(self.model, &self.structure));
        if complaints.is_empty() { Ok(()) } else { Err(complaints) }
    }

    /// Solutions are checked once, whatever is derived.
    fn check(&mut self) -> Result<(), Vec<Complaint>> {
        let pitches = euler_singularities::pitches(self.model, &self.structure);
        if self.is_open() {
            self.dead_centres = pitches;
            return Ok(());
        }
        let (mut notes, mut centres) = (Vec::new(), Vec::new());
        let mut outcome = Ok(());
        self.only("", |e| {
            outcome = e.reduce().and_then(|reduction| {
                notes.clone_from(&reduction.notes);
                centres.extend(reduction.dead_centres.iter().map(|centre| centre.0));
                notes.extend(e.verify(&reduction)?);
                Ok(())
            });
            Ok(Results::default())
        })?;
        centres.extend(pitches);
        (self.notes, self.dead_centres) = (notes, centres);
        outcome
    }

    /// In which axes loops are closed: one choice for all functions, since multipliers are components in them. The way is
    /// taken whose equations are cheapest as they are derived; that choice alone can halve their cost.
    fn choose_writing(&mut self) -> Result<(), Vec<Complaint>> {
        if self.structure.rows.is_empty() || freedoms(self.model) > MOST_COMPOSITE {
            return Ok(());
        }
        let residual = self.model.emit.contains(&Request::Residual);
        let solving = [Request::ForwardDynamics, Request::Impulse];
        let solved = solving.iter().any(|request| self.model.emit.contains(request));
        let structure = Rc::clone(&self.structure);
        let ways = Writings::new(self.model, &structure).ways();
        if let [only] = ways[..] {
            self.writing = only;
            return Ok(());
        }
        let mut least = None;
        for writing in ways {
            self.writing = writing;
            let solution = Cell::new(0);
            let found = self.written(&[None], |e, reduction| {
                if solved {
                    solution.set(e.cost_of_solution(reduction));
                }
                if residual {
                    return e.residual(reduction);
                }
                let mut all = e.constraints(reduction);
                all.extend(e.constraint_jacobian(reduction));
                all.extend(e.constraint_bias(reduction));
                Results::vector(all)
            })?;
            let Some((_, results)) = found.into_iter().next() else { continue };
            let weight = self.weight(&results.list).saturating_add(solution.get());
            if least.is_none_or(|(known, _)| weight < known) {
                least = Some((weight, writing));
            }
        }
        self.writing = least.map_or(structure.writing, |(_, writing)| writing);
        Ok(())
    }
}

/// Whether the articulated-body algorithm is another way: with one coordinate it is the same one, and it would move the
/// links of `Fixed` joints that are kept for their reactions.
fn articulates(model: &Model, kept: &[JointId]) -> bool {
    kept.is_empty() && freedoms(model) > 1
}

/// Whether something moves about in the world by translations.
fn floats(model: &Model) -> bool {
    let floating = |joint: &Joint| joint.kind.slides() > 1;
    model.joints.iter().any(|joint| floating(joint) && joint.parent.body == BodyRef::Ground)
}

/// Number of velocity coordinates of the tree.
pub fn freedoms(model: &Model) -> usize {
    model.joints.iter().enumerate().map(|(k, joint)| freedoms_of(model, JointId(k), joint)).sum()
}
