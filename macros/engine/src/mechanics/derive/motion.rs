//! Stage `mechanics`, its whole: accelerations, kinematics and outputs.
//!
//! In: what the model asks for. Out: candidates by every formulation that fits.

use std::rc::Rc;

use crate::contracts::results::{Results, Slot};
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::results::constrained::ConstrainedMotion;
use crate::mechanics::scene::{Choices, Method, Style};
use crate::mechanics::strut::forward;
use crate::mechanics::translate::dependencies::Dependencies;
use crate::model::types::Output;
use crate::symbolic::graph::Scalar;

use super::{
    AXES, Candidate, Deriving, EMBEDDED, Found, METHODS, MOST_COMPOSITE, MOST_STRUT_WAYS, articulates, floats, freedoms,
};

impl<'m> Deriving<'m> {
    pub(super) fn forward_dynamics(&mut self) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let model = self.model;
        let needs = Dependencies::of(model.states.iter().map(|state| &state.rate));
        let kept = needs.kept(model);
        let all = |equations: &mut Equations<'m>| {
            let accelerations = equations.accelerations().to_vec();
            let rates = model.states.iter().map(|state| equations.scalar(&state.rate)).collect();
            Ok(Results::velocity(accelerations).with_any(Slot::States, rates))
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
            let way = Choices { method: Method::Floating, ..self.way() };
            candidates.extend(self.candidate(name, way, &kept, &mut { all })?);
        }
        Ok(candidates)
    }

    /// With dependent or driven coordinates, or multipliers.
    pub(super) fn constrained_dynamics(&mut self) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let model = self.model;
        let kept = Dependencies::of(model.states.iter().map(|state| &state.rate)).kept(model);
        let all = |equations: &mut Equations<'m>| {
            let reduction = equations.reduce()?;
            let solved = equations.solve_constrained(&reduction);
            let rates: Vec<Scalar> = model.states.iter().map(|state| equations.scalar(&state.rate)).collect();
            let results =
                solved.results(equations.put_in_all(&reduction, &solved, &rates), equations.moved(&reduction));
            Ok(equations.with_residual(&reduction, results))
        };
        let mut candidates = self.in_all_axes(&METHODS[0].1, Method::Composite, &kept, all)?;
        if kept.is_empty() {
            let way = Choices { method: Method::Articulated, ..self.way() };
            let name = METHODS[1].1[0];
            candidates
                .extend(self.accelerated(way, |e, reduction| Some((name, e.accelerations_on_balls(reduction)?)))?);
            candidates = self.with_embedded(candidates, all)?;
        }
        for at in 0..MOST_STRUT_WAYS {
            let found = self.accelerated(self.way(), |e, reduction| {
                let platform = e.platform(reduction)?;
                let name = forward::ways(&platform.carrier, e.is_packed()).get(at)?.0;
                Some((name, e.platform_accelerations(&platform, reduction, at)?))
            })?;
            let Some(found) = found else { break };
            candidates.push(found);
        }
        if floats(model) && model.small.is_empty() {
            let name = "composite rigid body, LDL^T, translations first";
            let way = Choices { method: Method::Floating, ..self.way() };
            candidates.extend(self.candidate(name, way, &kept, &mut { all })?);
        }
        Ok(candidates)
    }

    /// With those that embed loops, where some are closed before the ground: in common axes only where links' own are worth it, and the model is
    /// not large. What takes a good deal more is left out.
    pub(super) fn with_embedded(
        &mut self,
        mut candidates: Vec<Candidate>,
        mut f: impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let [own, common @ ..] = EMBEDDED;
        let way = Choices { method: Method::Articulated, ..self.way() };
        let Some(found) = self.embedding(own, way, &mut f)? else { return Ok(candidates) };
        let least = candidates.iter().map(|candidate| self.weight(&candidate.1.list)).min();
        let pays = least.is_none_or(|least| self.weight(&found.1.list) < least);
        let pays = pays && freedoms(self.model) <= MOST_COMPOSITE;
        candidates.push(found);
        for (axes, name) in AXES.into_iter().skip(1).zip(common).filter(|_| pays) {
            candidates.extend(self.embedding(name, Choices { axes, ..way }, &mut f)?);
        }
        Ok(self.promising(candidates))
    }

    /// One that embeds loops, if it is another way.
    fn embedding(
        &mut self,
        name: &'static str,
        way: Choices,
        f: &mut impl FnMut(&mut Equations<'m>) -> Found,
    ) -> Result<Option<Candidate>, Vec<Complaint>> {
        self.maybe(way, |e| {
            let reduction = e.reduce()?;
            if e.embeds(&reduction) { Ok(Some((name, f(e)?))) } else { Ok(None) }
        })
    }

    /// What knows accelerations of some models only, without multipliers.
    fn accelerated(
        &mut self,
        way: Choices,
        f: impl Fn(&mut Equations<'m>, &Reduction) -> Option<(&'static str, Vec<Scalar>)>,
    ) -> Result<Option<Candidate>, Vec<Complaint>> {
        let model = self.model;
        self.maybe(way, |e| {
            let reduction = e.reduce()?;
            let Some((name, accelerations)) = f(e, &reduction) else { return Ok(None) };
            let solved = ConstrainedMotion::without_rows(accelerations);
            let rates: Vec<Scalar> = model.states.iter().map(|state| e.scalar(&state.rate)).collect();
            let rates = e.put_in_all(&reduction, &solved, &rates);
            let results = solved.results(rates, e.moved(&reduction));
            let results = e.with_residual(&reduction, results);
            Ok(Some((name, e.with_numbers(results))))
        })
    }

    /// Values, rates and accelerations of coordinates from those that are given.
    pub(super) fn kinematics(&mut self, number: usize) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let Some(wanted) = self.model.kinematics.get(number) else { return Ok(Vec::new()) };
        let closure = self.structure.closures.get(number).and_then(Clone::clone);
        let begins = closure.is_some();
        let (name, structure) = match closure {
            Some(structure) => ("Newton's method from where the position stands", structure),
            None => {
                let structure = self.structure.solved(self.model);
                (if structure.guesses() > 0 { "Newton's method" } else { "closed form" }, Rc::new(structure))
            }
        };
        let before = std::mem::replace(&mut self.structure, structure);
        let found = self.only(name, |e| {
            let reduction = e.reduce()?;
            e.verify(&reduction)?;
            let found = e.kinematics(wanted, &reduction)?;
            Ok(if begins { e.begin_where_it_stands(found) } else { found })
        });
        self.structure = before;
        found
    }

    pub(super) fn outputs(&mut self, wanted: &[&'m Output]) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let needs = Dependencies::of(wanted.iter().map(|output| &output.value));
        self.shown(&needs, |equations| equations.output_scalars(wanted))
    }

    pub(super) fn poses(&mut self) -> Result<Vec<Candidate>, Vec<Complaint>> {
        self.shown(&Dependencies::on_frames(), |equations| Ok(equations.body_poses()))
    }

    /// What a model shows of itself, by all ways that what it needs leaves; `scalars` gives it on the tree.
    fn shown(
        &mut self,
        needs: &Dependencies,
        mut scalars: impl FnMut(&mut Equations<'m>) -> Result<Vec<Scalar>, Vec<Complaint>>,
    ) -> Result<Vec<Candidate>, Vec<Complaint>> {
        let model = self.model;
        let kept = needs.kept(model);
        let open = self.is_open();
        let mut all = |equations: &mut Equations<'m>| {
            if open {
                return scalars(equations).map(Results::vector);
            }
            let reduction = equations.reduce()?;
            let results = scalars(equations)?;
            Ok(Results::vector(match equations.solved() {
                Some(solved) => equations.put_in_all(&reduction, &solved, &results),
                None => equations.finish(&reduction, &results),
            }))
        };
        let articulates = needs.accelerations && articulates(model, &kept);
        let mut ways = Vec::new();
        if !(open && articulates && super::freedoms(model) > MOST_COMPOSITE) {
            ways.push((Style::World, Method::Composite, "world axes"));
            if needs.frames {
                ways.push((Style::Nested, Method::Composite, "link axes"));
            }
        }
        if open && articulates {
            ways.push((Style::World, Method::Articulated, "world axes, articulated body"));
            if needs.frames {
                ways.push((Style::Nested, Method::Articulated, "link axes, articulated body"));
            }
        }
        let mut candidates = Vec::new();
        for (style, method, name) in ways {
            candidates.extend(self.candidate(name, Choices { style, method, ..self.way() }, &kept, &mut all)?);
        }
        if open || !articulates {
            return Ok(candidates);
        }
        let embedded = [
            (Style::World, "world axes, articulated body, loops embedded"),
            (Style::Nested, "link axes, articulated body, loops embedded"),
        ];
        let mut found = false;
        for (style, name) in embedded.into_iter().take(if needs.frames { 2 } else { 1 }) {
            let way = Choices { style, method: Method::Articulated, ..self.way() };
            let candidate = self.embedding(name, way, &mut all)?;
            found |= candidate.is_some();
            candidates.extend(candidate);
        }
        Ok(if found { self.promising(candidates) } else { candidates })
    }
}
