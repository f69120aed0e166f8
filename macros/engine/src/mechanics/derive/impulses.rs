//! Stage `mechanics`, its whole: jumps of velocities, and momenta.
//!
//! In: what the model asks for. Out: candidates, or complaints about mechanisms whose equations these functions can't hold.

use crate::contracts::results::Results;
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints::path;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::results::momentum::Weight;
use crate::mechanics::scene::{Choices, Method};
use crate::mechanics::translate::symbols::has_quaternion;
use crate::model::site::Sited;
use crate::model::types::{Coordinate, Request};
use crate::symbolic::graph::{Graph, Scalar};

use super::{COMPOSITE, Candidates, Deriving, METHODS, MOST_COMPOSITE, Names, articulates, floats, freedoms};

const MOMENTA: Names = [
    "momenta of the links",
    "momenta of the links, parallel hinges in the axes of their base",
    "momenta of the links, parallel hinges in the axes of their tip",
];

const POTENTIAL: Names = [
    "momenta of the links, gradient of the weight's energy",
    "momenta of the links, parallel hinges in the axes of their base, gradient of the weight's energy",
    "momenta of the links, parallel hinges in the axes of their tip, gradient of the weight's energy",
];

const FLOATING: &str = "composite rigid body, LDL^T, translations first";

impl Deriving<'_> {
    /// What these functions can't hold, each at the word that asks for it.
    pub(super) fn check_impulses(&self) -> Result<(), Vec<Complaint>> {
        let (model, structure) = (self.model, &self.structure);
        let mut complaints = Vec::new();
        if self.model.asked_at(Request::Impulse).is_some() && structure.guesses() > 0 {
            let message = "`impulse` knows no guess, and a loop of this model is closed by Newton's method";
            let help = "write a `solve` for the loop, or `constraints: Multipliers`";
            complaints.push(self.complaint(Request::Impulse, message, help));
        }
        if self.model.asked_at(Request::Momentum).is_some() {
            let mut refuse = |message: &str, help: &str| {
                complaints.push(self.complaint(Request::Momentum, message, help));
            };
            if !model.states.is_empty() {
                refuse("`momentum` has no place for states of your own", SYMMETRIC);
            }
            if !structure.rows.is_empty() {
                let help = format!("write `constraints: Reduced`, or {SYMMETRIC}");
                refuse("`momentum` has no place for multipliers", &help);
            }
            if structure.guesses() > 0 {
                let message = "`momentum` knows no guess, and a loop of this model is closed by Newton's method";
                refuse(message, "write a `solve` for the loop");
            }
            let cuts = model.cuts.iter().map(|&joint| &model.joints[joint]);
            if let Some(joint) = cuts.into_iter().find(|joint| joint.armature.is_some()) {
                let message =
                    format!("`momentum` has no place for the armature of `{}`, which closes a loop", joint.place.field);
                refuse(&message, "leave the joint in the tree, or write the rotor as a body of its own");
            }
            let quaternion = |at: &&Coordinate| has_quaternion(&model.joints[at.joint]);
            if let Some(joint) = structure.state.iter().find(quaternion).and_then(|at| model.joints.get(at.joint.0)) {
                let name = path(model, &joint.place);
                let message =
                    format!("the velocities of `{name}` are no rates of coordinates, so they have no momenta");
                refuse(&message, &format!("write `coordinates: RollPitchYaw` there, or {SYMMETRIC}"));
            }
        }
        if complaints.is_empty() { Ok(()) } else { Err(complaints) }
    }

    fn complaint(&self, request: Request, message: &str, help: &str) -> Complaint {
        let at = self.model.asked_at(request).unwrap_or_else(|| self.model.site());
        Complaint { at, message: message.to_owned(), help: Some(help.to_owned()) }
    }

    /// M d = impulse.
    pub(super) fn jumps(&mut self) -> Candidates {
        let model = self.model;
        let methods = match articulates(model, &[]) {
            true if freedoms(model) > MOST_COMPOSITE => &METHODS[1..],
            true => &METHODS[..],
            false => &METHODS[..1],
        };
        let mut candidates = Vec::new();
        for &(method, names) in methods {
            candidates.extend(self.in_all_axes(&names, method, &[], |e| Ok(Results::velocity(e.jump())))?);
        }
        if floats(model) && freedoms(model) <= MOST_COMPOSITE {
            candidates
                .extend(self.candidate(FLOATING, self.floating(), &[], &mut |e| Ok(Results::velocity(e.jump())))?);
        }
        Ok(candidates)
    }

    /// The same with dependent or driven coordinates, or multipliers.
    pub(super) fn constrained_jumps(&mut self) -> Candidates {
        let mut all = |e: &mut Equations<'_>| {
            let reduction = e.reduce()?;
            let solved = e.constrained_jump(&reduction);
            Ok(solved.results(Vec::new(), Vec::new()))
        };
        let mut candidates = self.in_all_axes(&METHODS[0].1, Method::Composite, &[], &mut all)?;
        if floats(self.model) {
            candidates.extend(self.candidate(FLOATING, self.floating(), &[], &mut all)?);
        }
        self.with_embedded(candidates, all)
    }

    fn floating(&self) -> Choices {
        Choices { method: Method::Floating, ..self.way() }
    }

    /// M v
    pub(super) fn momenta(&mut self) -> Candidates {
        let mut candidates = self.one(MOMENTA, |e| Ok(Results::velocity(e.momenta())))?;
        if freedoms(self.model) <= MOST_COMPOSITE {
            candidates.extend(self.one(COMPOSITE, |e| Ok(Results::velocity(e.momenta_by_matrix())))?);
        }
        Ok(candidates)
    }

    pub(super) fn reduced_momenta(&mut self) -> Candidates {
        let still = Still { time: self.symbols.time, complaint: self.complaint(Request::Momentum, LATE, SYMMETRIC) };
        let mut candidates = self.reduced(MOMENTA, |e, reduction| {
            still.check(&e.g, reduction)?;
            Ok(Results::velocity(e.reduced_momenta(reduction)))
        })?;
        candidates.extend(
            self.reduced(COMPOSITE, |e, reduction| Ok(Results::velocity(e.reduced_momenta_by_matrix(reduction))))?,
        );
        Ok(candidates)
    }

    /// p'
    pub(super) fn momentum_rates(&mut self) -> Candidates {
        let mut candidates = self.one(MOMENTA, |e| Ok(Results::velocity(e.momentum_rates(Weight::Force))))?;
        if self.is_straight() {
            candidates.extend(self.one(POTENTIAL, |e| Ok(Results::velocity(e.momentum_rates(Weight::Gradient))))?);
        }
        Ok(candidates)
    }

    pub(super) fn reduced_momentum_rates(&mut self) -> Candidates {
        let rates = |weight| {
            move |e: &mut Equations<'_>, r: &Reduction| Ok(Results::velocity(e.reduced_momentum_rates(r, weight)))
        };
        let mut candidates = self.reduced(MOMENTA, rates(Weight::Force))?;
        if self.is_straight() {
            candidates.extend(self.reduced(POTENTIAL, rates(Weight::Gradient))?);
        }
        Ok(candidates)
    }

    /// Whether gravity pulls, and every coordinate of the tree changes at the rate of a velocity.
    fn is_straight(&self) -> bool {
        let lists = self.symbols.positions.iter().zip(&self.symbols.velocities);
        self.model.gravity.is_some() && lists.into_iter().all(|(q, v)| q.len() == v.len())
    }
}

/// What is said of coordinates that follow the time.
const LATE: &str = "`momentum` belongs to coordinates alone, and some of this model follow the time";

/// What helps where there are no momenta.
const SYMMETRIC: &str = "take a symmetric method, which integrates positions and velocities";

/// Velocities must be linear in those of the state, with nothing that moves in time by itself.
struct Still {
    time: Scalar,
    complaint: Complaint,
}

impl Still {
    fn check(&self, g: &Graph, reduction: &Reduction) -> Result<(), Vec<Complaint>> {
        let moves = reduction.map.values().any(|&value| g.depends_on(value, &[self.time]));
        if moves { Err(vec![self.complaint.clone()]) } else { Ok(()) }
    }
}
