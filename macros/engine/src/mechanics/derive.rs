//! Stage `mechanics`, its whole: from the checked model to expressions of every requested function.
//!
//! In: the checked model. Out: a [`Derivation`]. Where there are several ways to a function, each is a candidate, and the
//! count of the optimised code decides between them (law 5). The graph forgets between candidates: expressions of equal
//! value are one node, in the form that was made first, so a second way would come out as the first; and what one
//! function costs must not depend on which others are asked for.

mod derivatives;
mod impulses;

use std::collections::HashMap;
use std::rc::Rc;

use crate::model::types::{BodyRef, Coordinate, Joint, JointId, JointKind, Model, Request};
use crate::optimize::program::FunctionKind;
use crate::symbolic::graph::{Graph, Rotation, Scalar};
use crate::symbolic::lower::Lowering;

use super::analysis::Complaint;
use super::closings::{self, Writing};
use super::constrained::Solved;
use super::cycles::Branch;
use super::equations::{Equations, Method, Style, Way};
use super::gathered;
use super::gimbals;
use super::names;
use super::needs::Needs;
use super::parallel::Axes;
use super::reduction::Reduction;
use super::structure::{Role, Structure};
use super::strut::{forward, inverse};
use super::symbols::{Symbols, freedoms_of};
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

const GATHERED: &str = "Newton-Euler, links that turn together gathered";

/// Most ways to the equations of a body on struts.
const MOST_STRUT_WAYS: usize = 6;

/// Most coordinates of one model: a bound on the time that a derivation takes.
pub const MOST_FREEDOMS: usize = 200;

/// Beyond this many coordinates a factorisation, whose cost grows with their cube, is no candidate.
const MOST_COMPOSITE: usize = 32;

/// Derives what the model asks for, and its outputs.
pub fn derive(model: &Model, structure: &Structure) -> Result<Derivation, Vec<Complaint>> {
    let mut graph = Graph::new();
    let symbols = Symbols::new(&mut graph, model).with_structure(&mut graph, structure);
    let symbols = symbols.with_impulses(&mut graph, model, structure);
    let symbol_names = symbols.table.iter().map(|&symbol| names::symbol(model, symbol)).collect();
    let mut deriving = Deriving {
        model,
        structure: Rc::new(structure.clone()),
        graph,
        symbols,
        branches: HashMap::new(),
        writing: Writing::PLAIN,
        notes: Vec::new(),
        dead_centres: Vec::new(),
    };
    deriving.check_impulses()?;
    deriving.check()?;
    deriving.choose_writing()?;
    let mut functions = Vec::new();
    for kind in kinds(model, structure) {
        let candidates = deriving.candidates(kind)?;
        if candidates.is_empty() {
            return Err(vec![Complaint {
                span: model.name.span(),
                message: format!("no way was found to derive a function of `{}`", model.name),
                help: Some("this is an error of multibody: please report it with the model".to_owned()),
            }]);
        }
        functions.push(Derived { kind, candidates });
    }
    if !deriving.dead_centres.is_empty() {
        let kind = FunctionKind::DeadCentres;
        functions.push(Derived { kind, candidates: deriving.candidates(kind)? });
    }
    let Deriving { graph, symbols, notes, dead_centres, .. } = deriving;
    Ok(Derivation { graph, symbols: symbols.table, symbol_names, functions, notes, dead_centres })
}

/// What to derive, each once, in a fixed order.
fn kinds(model: &Model, structure: &Structure) -> Vec<FunctionKind> {
    let wanted = |request: Request, kinds: &[FunctionKind]| {
        if model.emit.contains(&request) { kinds.to_vec() } else { Vec::new() }
    };
    let mut kinds = wanted(Request::ForwardDynamics, &[FunctionKind::ForwardDynamics]);
    kinds.extend(wanted(Request::InverseDynamics, &[FunctionKind::InverseDynamics]));
    kinds.extend(wanted(Request::MassMatrix, &[FunctionKind::MassMatrix]));
    kinds.extend(wanted(Request::Bias, &[FunctionKind::Bias]));
    kinds.extend(wanted(Request::Energy, &[FunctionKind::KineticEnergy, FunctionKind::PotentialEnergy]));
    if !structure.rows.is_empty() {
        kinds.extend([
            FunctionKind::Constraints,
            FunctionKind::ConstraintJacobian,
            FunctionKind::ConstraintRate,
            FunctionKind::ConstraintBias,
        ]);
    }
    if structure.guesses() > 0 {
        kinds.push(FunctionKind::Guess);
    }
    kinds.extend(wanted(Request::Residual, &[FunctionKind::Residual]));
    kinds.extend((0..model.kinematics.len()).map(FunctionKind::Kinematics));
    kinds.extend(wanted(Request::Derivatives, &[FunctionKind::ForwardDerivatives, FunctionKind::InverseDerivatives]));
    kinds.extend(impulses::kinds(model));
    if !model.outputs.is_empty() {
        kinds.push(FunctionKind::Outputs);
    }
    kinds
}

type Candidate = (&'static str, Vec<Scalar>);

/// A graph that goes from candidate to candidate.
struct Deriving<'m> {
    model: &'m Model,
    structure: Rc<Structure>,
    graph: Graph,
    symbols: Symbols,
    branches: HashMap<usize, Branch>,
    /// How equations of loops are written.
    writing: Writing,
    /// Sentences for the report.
    notes: Vec<String>,
    /// Unknowns whose closed forms have a root, and pitches.
    dead_centres: Vec<Coordinate>,
}

/// Results of one way, or what is wrong with the model.
type Found = Result<Vec<Scalar>, Vec<Complaint>>;

impl<'m> Deriving<'m> {
    fn candidates(&mut self, kind: FunctionKind) -> Result<Vec<Candidate>, Vec<Complaint>> {
        if self.is_open() {
            return match kind {
                FunctionKind::ForwardDynamics => self.forward_dynamics(),
                FunctionKind::Outputs => self.outputs(),
                FunctionKind::InverseDynamics if !self.model.solve_for.is_empty() => {
                    self.one(NEWTON_EULER, |e| e.actuate(&Reduction::default()))
                }
                FunctionKind::InverseDynamics => {
                    let mut candidates = self.one(NEWTON_EULER, |e| Ok(e.inverse_dynamics()))?;
                    candidates.extend(self.gathered(|e| Ok(e.inverse_dynamics()))?);
                    Ok(candidates)
                }
                FunctionKind::Bias => {
                    let mut candidates = self.one(NEWTON_EULER, |e| Ok(e.bias()))?;
                    candidates.extend(self.gathered(|e| Ok(e.bias()))?);
                    Ok(candidates)
                }
                FunctionKind::MassMatrix => self.one(COMPOSITE, |e| Ok(e.mass_matrix())),
                FunctionKind::KineticEnergy => self.only("sum over links", |e| Ok(vec![e.kinetic()])),
                FunctionKind::PotentialEnergy => {
                    self.only("first moment of mass, springs", |e| Ok(vec![e.potential()]))
                }
                FunctionKind::Residual => self.one(NEWTON_EULER, |e| Ok(e.inverse_dynamics())),
                FunctionKind::Kinematics(k) => self.kinematics(k),
                FunctionKind::ForwardDerivatives => self.forward_derivatives(),
                FunctionKind::InverseDerivatives => self.inverse_derivatives(),
                FunctionKind::Constraints
                | FunctionKind::ConstraintJacobian
                | FunctionKind::ConstraintRate
                | FunctionKind::ConstraintBias
                | FunctionKind::Guess => Ok(Vec::new()),
                FunctionKind::DeadCentres => self.only("closed forms", |e| {
                    let pitches = gimbals::pitches(e.model, &e.structure);
                    Ok(gimbals::cosines(&mut e.g, &e.symbols, &pitches))
                }),
                FunctionKind::Impulse | FunctionKind::MomentumVelocity => self.jumps(),
                FunctionKind::Momentum => self.momenta(),
                FunctionKind::MomentumRate => self.momentum_rates(),
            };
        }
        match kind {
            FunctionKind::ForwardDynamics => self.constrained_dynamics(),
            FunctionKind::Outputs => self.outputs(),
            FunctionKind::InverseDynamics if !self.model.solve_for.is_empty() => {
                let mut candidates = self.reduced(NEWTON_EULER, |e, reduction| e.actuate(reduction))?;
                for at in 0..MOST_STRUT_WAYS {
                    let found = self.maybe(|e| {
                        let reduction = e.reduce()?;
                        let Some(platform) = e.platform(&reduction) else { return Ok(None) };
                        let name = inverse::ways(&platform.carrier, platform.assumed()).get(at).map(|way| way.0);
                        Ok(name.zip(e.platform_inputs(&platform, &reduction, at)))
                    })?;
                    let Some(found) = found else { break };
                    candidates.push(found);
                }
                Ok(candidates)
            }
            FunctionKind::InverseDynamics => {
                self.reduced(NEWTON_EULER, |e, reduction| Ok(e.reduced_efforts(reduction, true)))
            }
            FunctionKind::Bias => self.reduced(NEWTON_EULER, |e, reduction| Ok(e.reduced_efforts(reduction, false))),
            FunctionKind::MassMatrix => {
                self.reduced(COMPOSITE, |e, reduction| Ok(e.reduced_mass_matrix(reduction).concat()))
            }
            FunctionKind::KineticEnergy => self.put_in("sum over links", |e| Ok(vec![e.kinetic()])),
            FunctionKind::PotentialEnergy => self.put_in("first moment of mass, springs", |e| Ok(vec![e.potential()])),
            FunctionKind::Constraints => self.written(&[None], |e, r| e.constraints(r)),
            FunctionKind::ConstraintJacobian => self.written(&[None], |e, r| e.constraint_jacobian(r)),
            FunctionKind::ConstraintRate => self.written(&[None], |e, r| e.constraint_rate(r)),
            FunctionKind::ConstraintBias => self.written(&[None], |e, r| e.constraint_bias(r)),
            FunctionKind::Residual => {
                let mut candidates = self.written(&AXES, |e, r| e.residual(r))?;
                candidates.extend(self.gathered(|e| {
                    let reduction = e.reduce()?;
                    Ok(e.residual(&reduction))
                })?);
                Ok(candidates)
            }
            FunctionKind::Kinematics(k) => self.kinematics(k),
            FunctionKind::ForwardDerivatives => self.forward_derivatives(),
            FunctionKind::InverseDerivatives => self.inverse_derivatives(),
            FunctionKind::Guess => self.equations("Newton's method", |e, reduction| {
                let mut results = reduction.guesses.clone();
                results.push(e.worst_residual(reduction));
                Ok(e.finish(reduction, &results))
            }),
            FunctionKind::DeadCentres => self.equations("closed forms", |e, reduction| {
                let mut roots: Vec<Scalar> = reduction.dead_centres.iter().map(|centre| centre.1).collect();
                let pitches = gimbals::pitches(e.model, &e.structure);
                roots.extend(gimbals::cosines(&mut e.g, &e.symbols, &pitches));
                Ok(e.finish(reduction, &roots))
            }),
            FunctionKind::Impulse | FunctionKind::MomentumVelocity => self.constrained_jumps(),
            FunctionKind::Momentum => self.reduced_momenta(),
            FunctionKind::MomentumRate => self.reduced_momentum_rates(),
        }
    }

    /// Whether every coordinate is in the state and no equation keeps a multiplier.
    fn is_open(&self) -> bool {
        let roles = self.structure.roles.iter().flatten();
        self.structure.rows.is_empty() && roles.copied().all(|role| role == Role::State)
    }

    /// Solutions are checked once, whatever is derived.
    fn check(&mut self) -> Result<(), Vec<Complaint>> {
        let pitches = gimbals::pitches(self.model, &self.structure);
        if self.is_open() {
            self.dead_centres = pitches;
            return Ok(());
        }
        let (mut notes, mut centres) = (Vec::new(), Vec::new());
        let mut outcome = Ok(());
        self.only("", |e| {
            outcome = e.reduce().and_then(|mut reduction| {
                let verdict = e.verify(&mut reduction);
                notes = reduction.notes;
                centres = reduction.dead_centres.into_iter().map(|centre| centre.0).collect();
                verdict
            });
            Ok(Vec::new())
        })?;
        centres.extend(pitches);
        (self.notes, self.dead_centres) = (notes, centres);
        outcome
    }

    /// One method, in the axes that [`AXES`] names.
    fn one(
        &mut self,
        names: Names,
        f: impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        self.in_all_axes(&names, Method::Composite, &[], f)
    }

    /// The recursion over groups of links, where it is another way.
    fn gathered(
        &mut self,
        mut f: impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Option<Candidate>, Vec<Complaint>> {
        self.maybe(|e| {
            e.gathered = true;
            if !gathered::differs(&e.mechanism.tree) {
                return Ok(None);
            }
            Ok(Some((GATHERED, f(e)?)))
        })
    }

    /// The same, with the definitions of dependent coordinates.
    fn reduced(
        &mut self,
        names: Names,
        f: impl Fn(&mut Equations<'m>, &Reduction) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        self.one(names, |e| {
            let reduction = e.reduce()?;
            f(e, &reduction)
        })
    }

    fn in_all_axes(
        &mut self,
        names: &[&'static str],
        method: Method,
        kept: &[JointId],
        mut f: impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        // Common axes pay where a matrix is factored or passed on; beyond that size each way costs too much time.
        let ways = if freedoms(self.model) > MOST_COMPOSITE { 1 } else { AXES.len() };
        let mut candidates = Vec::new();
        for (axes, &name) in AXES.into_iter().zip(names).take(ways) {
            candidates.extend(self.candidate(
                name,
                Way { style: Style::Nested, method, axes, writing: self.writing },
                kept,
                &mut f,
            )?);
        }
        Ok(candidates)
    }

    /// One that has no choice of axes.
    fn only(
        &mut self,
        name: &'static str,
        mut f: impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let way = Way { style: Style::Nested, method: Method::Composite, axes: None, writing: self.writing };
        Ok(self.candidate(name, way, &[], &mut f)?.into_iter().collect())
    }

    /// A way that is there for some models only, with its name.
    fn maybe(
        &mut self,
        mut f: impl FnMut(&mut Equations<'m>) -> Result<Option<Candidate>, Vec<Complaint>>,
    ) -> Result<Option<Candidate>, Vec<Complaint>> {
        let mut name = None;
        let found = self.only("", |e| {
            let candidate = f(e)?;
            name = candidate.as_ref().map(|candidate| candidate.0);
            Ok(candidate.map(|candidate| candidate.1).unwrap_or_default())
        })?;
        Ok(found.into_iter().next().and_then(|(_, results)| Some((name?, results))))
    }

    /// Equations of loops, as they are written in the whole model.
    fn written(
        &mut self,
        axes: &[Option<Axes>],
        f: impl Fn(&mut Equations<'m>, &Reduction) -> Vec<Scalar>,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let mut candidates = Vec::new();
        for &axes in axes {
            let name = match self.writing.axes {
                closings::Axes::Parent => "loops in the axes of the parent's frame",
                closings::Axes::Child => "loops in the axes of the child's frame",
                closings::Axes::World => "loops in world axes",
                closings::Axes::Common => "loops in the axes of what carries both sides",
                closings::Axes::ParentBase => "loops in the axes in which the parent's side stands",
                closings::Axes::ChildBase => "loops in the axes in which the child's side stands",
            };
            let way = Way { style: Style::Nested, method: Method::Composite, axes, writing: self.writing };
            let found = self.candidate(name, way, &[], &mut |e: &mut Equations<'m>| {
                let reduction = e.reduce()?;
                Ok(f(e, &reduction))
            })?;
            candidates.extend(found);
        }
        Ok(candidates)
    }

    /// In which axes loops are closed: one choice for all functions, since multipliers are components in them. The way is
    /// taken whose equations are cheapest as they are derived; that choice alone can halve their cost.
    fn choose_writing(&mut self) -> Result<(), Vec<Complaint>> {
        if self.structure.rows.is_empty() || freedoms(self.model) > MOST_COMPOSITE {
            return Ok(());
        }
        let residual = self.model.emit.contains(&Request::Residual);
        let mut least = None;
        for writing in Writing::ALL {
            self.writing = writing;
            let found = self.written(&[None], |e, reduction| {
                if residual {
                    return e.residual(reduction);
                }
                let mut all = e.constraints(reduction);
                all.extend(e.constraint_jacobian(reduction));
                all.extend(e.constraint_bias(reduction));
                all
            })?;
            let Some((_, results)) = found.into_iter().next() else { continue };
            let weight = self.weight(&results);
            if least.is_none_or(|(known, _)| weight < known) {
                least = Some((weight, writing));
            }
        }
        self.writing = least.map_or(Writing::PLAIN, |(_, writing)| writing);
        Ok(())
    }

    /// Of expressions as they are derived.
    fn weight(&self, results: &[Scalar]) -> u32 {
        let mut lowering = Lowering::new(&self.graph);
        let roots = lowering.run(results);
        lowering.to.cost(&roots).weight()
    }

    /// The same, with the definitions at hand.
    fn equations(
        &mut self,
        name: &'static str,
        f: impl Fn(&mut Equations<'m>, &Reduction) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        self.only(name, |e| {
            let reduction = e.reduce()?;
            f(e, &reduction)
        })
    }

    /// Results on the tree with the definitions put in.
    fn put_in(
        &mut self,
        name: &'static str,
        f: impl Fn(&mut Equations<'m>) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        self.equations(name, |e, reduction| {
            let results = f(e)?;
            Ok(e.finish(reduction, &results))
        })
    }

    fn candidate(
        &mut self,
        name: &'static str,
        way: Way,
        kept: &[JointId],
        f: &mut impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Option<Candidate>, Vec<Complaint>> {
        let mut graph = std::mem::take(&mut self.graph);
        graph.forget();
        let mut equations = Equations::new(self.model, graph, self.symbols.clone(), way, kept);
        equations.structure = Rc::clone(&self.structure);
        equations.branches = std::mem::take(&mut self.branches);
        let exists = way.axes.is_none() || equations.shared().turns.iter().any(|&turn| turn != Rotation::IDENTITY);
        let results = if exists { f(&mut equations) } else { Ok(Vec::new()) };
        let unfinished = |g: &Graph, results: &[Scalar]| results.iter().any(|&root| Symbols::is_unfinished(g, root));
        // Nodes are found by value: what is made after definitions were put in may come out as an older node, in which a
        // coordinate outside the state stands and cancels. Put in once more, it goes.
        let results = results.map(|results| {
            let (g, defined) = (&mut equations.g, &equations.defined);
            if !defined.is_empty() && unfinished(g, &results) { g.substitute(&results, defined) } else { results }
        });
        self.graph = equations.g;
        self.branches = equations.branches;
        let results = results?;
        // A net: what a way has left unreplaced has no place in the generated structs.
        let finished = !unfinished(&self.graph, &results);
        debug_assert!(finished, "{name} leaves a coordinate that is not in the state");
        Ok((exists && finished).then_some((name, results)))
    }

    fn forward_dynamics(&mut self) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let model = self.model;
        let needs = Needs::of(model.states.iter().map(|state| &state.rate));
        let kept = needs.kept(model);
        let all = |equations: &mut Equations<'m>| {
            let mut results = equations.accelerations().to_vec();
            results.extend(model.states.iter().map(|state| equations.scalar(&state.rate)));
            Ok(results)
        };
        let methods = match articulates(model, &kept) {
            true if freedoms(model) > MOST_COMPOSITE => &METHODS[1..],
            true => &METHODS[..],
            false => &METHODS[..1],
        };
        let mut candidates = Vec::new();
        for &(method, names) in methods {
            candidates.extend(self.in_all_axes(&names, method, &kept, all)?);
        }
        if floats(model) && freedoms(model) <= MOST_COMPOSITE {
            let name = "composite rigid body, LDL^T, translations first";
            let way = Way { style: Style::Nested, method: Method::Floating, axes: None, writing: self.writing };
            candidates.extend(self.candidate(name, way, &kept, &mut { all })?);
        }
        Ok(candidates)
    }

    /// With dependent or driven coordinates, or multipliers.
    fn constrained_dynamics(&mut self) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let model = self.model;
        let kept = Needs::of(model.states.iter().map(|state| &state.rate)).kept(model);
        let all = |equations: &mut Equations<'m>| {
            let reduction = equations.reduce()?;
            let solved = equations.solve_constrained(&reduction);
            let rates: Vec<Scalar> = model.states.iter().map(|state| equations.scalar(&state.rate)).collect();
            let mut results = solved.accelerations.clone();
            results.extend(equations.put_in_all(&reduction, &solved, &rates));
            results.extend(&solved.multipliers);
            results.extend(solved.rank);
            if !reduction.residuals.is_empty() {
                let residual = equations.worst_residual(&reduction);
                results.extend(equations.finish(&reduction, &[residual]));
            }
            Ok(results)
        };
        let mut candidates = self.in_all_axes(&METHODS[0].1, Method::Composite, &kept, all)?;
        for at in 0..MOST_STRUT_WAYS {
            let found = self.maybe(|e| {
                let reduction = e.reduce()?;
                let Some(platform) = e.platform(&reduction) else { return Ok(None) };
                let name = forward::ways(&platform.carrier).get(at).map(|way| way.0);
                let Some(mut results) = e.platform_accelerations(&platform, &reduction, at) else { return Ok(None) };
                let solved = Solved { accelerations: results.clone(), multipliers: Vec::new(), rank: None };
                let rates: Vec<Scalar> = model.states.iter().map(|state| e.scalar(&state.rate)).collect();
                results.extend(e.put_in_all(&reduction, &solved, &rates));
                Ok(name.map(|name| (name, results)))
            })?;
            let Some(found) = found else { break };
            candidates.push(found);
        }
        if floats(model) {
            let name = "composite rigid body, LDL^T, translations first";
            let way = Way { style: Style::Nested, method: Method::Floating, axes: None, writing: self.writing };
            candidates.extend(self.candidate(name, way, &kept, &mut { all })?);
        }
        Ok(candidates)
    }

    /// Values, rates and accelerations of coordinates from those that are given.
    fn kinematics(&mut self, number: usize) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let Some(wanted) = self.model.kinematics.get(number) else { return Ok(Vec::new()) };
        let structure = self.structure.solved(self.model);
        let before = std::mem::replace(&mut self.structure, Rc::new(structure));
        let found = self.only("closed form", |e| {
            let mut reduction = e.reduce()?;
            e.verify(&mut reduction)?;
            e.kinematics(wanted, &reduction)
        });
        self.structure = before;
        found
    }

    fn outputs(&mut self) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let model = self.model;
        let needs = Needs::of(model.outputs.iter().map(|output| &output.value));
        let kept = needs.kept(model);
        let open = self.is_open();
        let mut all = |equations: &mut Equations<'m>| {
            let flat = |equations: &mut Equations<'m>| {
                let mut results = Vec::new();
                for output in &model.outputs {
                    let value = equations.value(&output.value);
                    value.flatten(&mut equations.g, &mut results);
                }
                results
            };
            if open {
                return Ok(flat(equations));
            }
            let reduction = Rc::new(equations.reduce()?);
            equations.reduction = Some(Rc::clone(&reduction));
            let results = flat(equations);
            match equations.solved.clone() {
                Some(solved) => Ok(equations.put_in_all(&reduction, &solved, &results)),
                None => Ok(equations.finish(&reduction, &results)),
            }
        };
        let articulates = open && needs.accelerations && articulates(model, &kept);
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
        let mut candidates = Vec::new();
        for (style, method, name) in ways {
            candidates.extend(self.candidate(
                name,
                Way { style, method, axes: None, writing: self.writing },
                &kept,
                &mut all,
            )?);
        }
        Ok(candidates)
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

/// Number of velocity coordinates of the tree.
pub fn freedoms(model: &Model) -> usize {
    model.joints.iter().enumerate().map(|(k, joint)| freedoms_of(model, JointId(k), joint)).sum()
}
