//! Stage `mechanics`, its whole: what a candidate is.
//!
//! In: a function of [`Equations`] in one formulation. Out: its results with the name of the method, in each of the axes,
//! writings and groupings that may make a difference.

use std::rc::Rc;

use crate::contracts::results::Results;
use crate::dynamics::lumped;
use crate::dynamics::shared_axes::SharedAxes;
use crate::invariant::fault::raise;
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::scene::{Choices, Method, Passing, Scene};
use crate::mechanics::translate::division;
use crate::mechanics::translate::symbols::Symbols;
use crate::model::site::Sited;
use crate::model::types::JointId;
use crate::symbolic::graph::{Graph, Scalar};
use crate::symbolic::lower::Lowering;

use super::{AXES, Candidate, Deriving, Found, LUMPED, MOST_COMPOSITE, Names, freedoms};

/// Operations, beyond which one way alone is optimised.
const LONG: usize = 30_000;

impl<'m> Deriving<'m> {
    /// One method, in the axes that [`AXES`] names.
    pub(super) fn one(
        &mut self,
        names: Names,
        f: impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        self.in_all_axes(&names, Method::Composite, &[], f)
    }

    /// The recursion over groups of links, where it is another way.
    pub(super) fn lumped(
        &mut self,
        mut f: impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Option<Candidate>, Vec<Complaint>> {
        self.maybe(Choices { lumped: true, ..self.way() }, |e| {
            if !lumped::differs(&e.scene.mechanism.tree) {
                return Ok(None);
            }
            Ok(Some((LUMPED, f(e)?)))
        })
    }

    /// The same, with the definitions of dependent coordinates.
    pub(super) fn reduced(
        &mut self,
        names: Names,
        f: impl Fn(&mut Equations<'m>, &Reduction) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        self.one(names, |e| {
            let reduction = e.reduce()?;
            f(e, &reduction)
        })
    }

    pub(super) fn in_all_axes(
        &mut self,
        names: &[&'static str],
        method: Method,
        kept: &[JointId],
        mut f: impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let mut candidates = self.passed_in_all_axes(names, method, Passing::Masses, kept, &mut f)?;
        // What has few moments may be better off as it is.
        if self.is_open() && freedoms(self.model) <= MOST_COMPOSITE {
            candidates.extend(self.candidate(names[0], Choices { method, ..self.way() }, kept, &mut f)?);
        }
        Ok(candidates)
    }

    /// The same, passed from link to link in one way. Where loops are closed all is plain: their equations read the same sines.
    pub(super) fn passed_in_all_axes(
        &mut self,
        names: &[&'static str],
        method: Method,
        passing: Passing,
        kept: &[JointId],
        f: &mut impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let passing = if self.is_open() { passing } else { Passing::Plain };
        // Common axes pay where a matrix is factored or passed on; beyond that size each way costs too much time.
        let ways = if freedoms(self.model) > MOST_COMPOSITE { 1 } else { AXES.len() };
        let mut candidates = Vec::new();
        for (axes, &name) in AXES.into_iter().zip(names).take(ways) {
            candidates.extend(self.candidate(name, Choices { method, axes, passing, ..self.way() }, kept, f)?);
        }
        Ok(candidates)
    }

    /// One that has no choice of axes.
    pub(super) fn only(
        &mut self,
        name: &'static str,
        mut f: impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        Ok(self.candidate(name, self.way(), &[], &mut f)?.into_iter().collect())
    }

    /// Where there is nothing to choose but the axes in which loops are closed.
    pub(super) fn way(&self) -> Choices {
        Choices { writing: self.writing, ..Choices::PLAIN }
    }

    /// A way that is there for some models only, with its name.
    pub(super) fn maybe(
        &mut self,
        way: Choices,
        mut f: impl FnMut(&mut Equations<'m>) -> Result<Option<Candidate>, Vec<Complaint>>,
    ) -> Result<Option<Candidate>, Vec<Complaint>> {
        let mut name = None;
        let found = self.candidate("", way, &[], &mut |e| {
            let candidate = f(e)?;
            name = candidate.as_ref().map(|candidate| candidate.0);
            Ok(candidate.map(|candidate| candidate.1).unwrap_or_default())
        })?;
        Ok(found.and_then(|(_, results)| Some((name?, results))))
    }

    /// Equations of loops, as they are written in the whole model.
    pub(super) fn written(
        &mut self,
        axes: &[Option<SharedAxes>],
        f: impl Fn(&mut Equations<'m>, &Reduction) -> Results<Scalar>,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let mut candidates = Vec::new();
        for &axes in axes {
            let name = match self.writing.axes {
                constraints::ClosedIn::Parent => "loops in the axes of the parent's frame",
                constraints::ClosedIn::Child => "loops in the axes of the child's frame",
                constraints::ClosedIn::World => "loops in world axes",
                constraints::ClosedIn::Common => "loops in the axes of what carries both sides",
                constraints::ClosedIn::ParentBase => "loops in the axes in which the parent's side stands",
                constraints::ClosedIn::ChildBase => "loops in the axes in which the child's side stands",
            };
            let way = Choices { axes, ..self.way() };
            let found = self.candidate(name, way, &[], &mut |e: &mut Equations<'m>| {
                let reduction = e.reduce()?;
                Ok(f(e, &reduction))
            })?;
            candidates.extend(found);
        }
        Ok(candidates)
    }

    /// Of expressions as they are derived.
    pub(super) fn weight(&self, results: &[Scalar]) -> u32 {
        let mut lowering = Lowering::new(&self.graph);
        let roots = lowering.run(results);
        lowering.to.cost(&roots).weight()
    }

    /// Of long functions only those that may come out as the cheapest, which are worth optimising; of very long ones, in which
    /// little is left to share, the first of the cheapest.
    pub(super) fn promising(&self, mut candidates: Vec<Candidate>) -> Vec<Candidate> {
        let weights: Vec<u32> = candidates.iter().map(|candidate| self.weight(&candidate.1.list)).collect();
        let least = weights.iter().copied().min().unwrap_or(0);
        let cheapest = weights.iter().position(|&weight| weight == least);
        let is_long = least as usize > LONG;
        let mut kept = weights.iter().enumerate().map(|(at, &weight)| {
            if is_long { Some(at) == cheapest } else { 10 * u64::from(weight) <= 11 * u64::from(least) }
        });
        candidates.retain(|_| kept.next() == Some(true));
        candidates
    }

    /// A way that pays where chains are long.
    pub(super) fn far_out(
        &mut self,
        name: &'static str,
        f: fn(&mut Equations<'_>) -> Option<Results<Scalar>>,
    ) -> Result<Option<Candidate>, Vec<Complaint>> {
        if freedoms(self.model) <= MOST_COMPOSITE {
            return Ok(None);
        }
        self.maybe(self.way(), |e| Ok(f(e).map(|results| (name, results))))
    }

    /// The same, with the definitions at hand.
    pub(super) fn equations(
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
    pub(super) fn put_in(
        &mut self,
        name: &'static str,
        f: impl Fn(&mut Equations<'m>) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        self.equations(name, |e, reduction| {
            let results = f(e)?;
            Ok(Results { list: e.finish(reduction, &results.list), ..results })
        })
    }

    pub(super) fn candidate(
        &mut self,
        name: &'static str,
        way: Choices,
        kept: &[JointId],
        f: &mut impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Option<Candidate>, Vec<Complaint>> {
        let mut graph = std::mem::take(&mut self.graph);
        graph.forget();
        let scene = Scene {
            structure: Rc::clone(&self.structure),
            way,
            kept: kept.into(),
            ..Scene::new(self.model, Rc::clone(&self.symbols))
        };
        let mut equations = Equations::new(graph, scene);
        equations.decided = std::mem::take(&mut self.decided);
        let exists = way.axes.is_none() || equations.shared().is_joined;
        let results = if exists { f(&mut equations) } else { Ok(Results::default()) };
        let unfinished = |g: &Graph, results: &[Scalar]| results.iter().any(|&root| Symbols::is_unfinished(g, root));
        // Nodes are found by value: what is made after definitions were put in may come out as an older node, in which a
        // coordinate outside the state stands and cancels. Put in once more, it goes.
        let results = results.map(|mut results| {
            let g = &mut equations.g;
            if let Some(reduction) = equations.reduced.as_ref().filter(|_| unfinished(g, &results.list)) {
                results.list = g.substitute(&results.list, &reduction.map);
            }
            results
        });
        self.graph = equations.g;
        self.decided = equations.decided;
        self.pivoted.extend(self.decided.pivoted.take());
        let results = results?;
        if self.graph.has_pole() {
            return Err(vec![division::at_a_pole(self.model)]);
        }
        self.check_slopes(&results.list)?;
        // What a way has left unreplaced has no place in the generated structs.
        if unfinished(&self.graph, &results.list) {
            raise("a way leaves no coordinate that is not in the state");
        }
        Ok(exists.then_some((name, results)))
    }

    /// Functions of Rust give slopes, and no slopes of these.
    fn check_slopes(&mut self, results: &[Scalar]) -> Result<(), Vec<Complaint>> {
        if self.model.externals.is_empty() {
            return Ok(());
        }
        let Some(function) = self.graph.curvature(results) else { return Ok(()) };
        self.curved = true;
        let name = &self.model.externals[function].name;
        let asked = self.request.and_then(|request| self.model.asked_at(request));
        Err(vec![Complaint {
            at: asked.unwrap_or_else(|| self.model.site()),
            message: format!("this takes slopes of the slopes of `{name}`, which a function of Rust doesn't give"),
            help: Some(format!("leave out the `diff` of what `{name}` gives, or let another function of Rust give it")),
        }])
    }
}
