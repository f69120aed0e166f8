//! Stage `mechanics`: springs and dampers between points that loops hold together.
//!
//! In: the model and its closed configurations. Out: the springs whose ends are held to one point by joints, between which nothing
//! acts; complaints about others whose ends meet at every closed configuration. There the line has no direction: what
//! rounding leaves of its length would give it one.

use crate::mechanics::loops::structure::Structure;
use crate::model::site::Sited;
use crate::model::types::{ForceId, ForceKind, Model};
use crate::symbolic::graph::Scalar;
use crate::symbolic::lower::Lowering;

use super::super::equations::Equations;
use super::Complaint;
use super::problem::Problem;
use super::tape::{Tape, Values};

/// A way up to this share of the mechanism's size is what closed loops leave.
const NO_WAY: f64 = 1e-9;

/// Springs whose ends joints hold together.
pub(super) fn meeting(model: &Model, problem: &Problem, structure: &Structure) -> Result<Vec<ForceId>, Vec<Complaint>> {
    let lines = model.forces.iter().enumerate().filter_map(|(number, force)| match &force.kind {
        ForceKind::LineSpring { between, damping, length, .. } => Some((ForceId(number), between, [damping, length])),
        ForceKind::Effort { .. }
        | ForceKind::JointSpring { .. }
        | ForceKind::Force { .. }
        | ForceKind::Torque { .. } => None,
    });
    let lines: Vec<_> = lines.collect();
    if lines.is_empty() {
        return Ok(Vec::new());
    }
    let mut e = Equations::plain(model);
    let (mut held, mut open, mut roots) = (Vec::new(), Vec::new(), Vec::new());
    for (id, between, [damping, length]) in lines {
        let ends = between.each_ref().map(|frame| e.place(frame));
        let [damping, length, _] = e.optional([damping, length, &None]);
        // Without them its force has no quotient, and is zero by itself.
        if ends[0].link == ends[1].link || (damping == Scalar::ZERO && length == Scalar::ZERO) {
            continue;
        }
        if e.are_held_together(&ends) {
            held.push(id);
        } else {
            let ([way, _], _) = e.way(&ends[0], &ends[1], 0);
            open.push(id);
            roots.push(e.g.dot(way, way));
        }
    }
    let mut lowering = Lowering::new(&e.g);
    let roots = lowering.run(&roots);
    let tape = Tape::new(&lowering.to, &roots);
    let mut values = Values::default();
    let mut longest = vec![0.0_f64; open.len()];
    for closed in &structure.closed {
        tape.run(&mut values, &problem.at(&closed.positions).0);
        for (root, longest) in longest.iter_mut().enumerate() {
            *longest = longest.max(tape.value(&values, root).sqrt());
        }
    }
    let meets = |&(_, &way): &(&ForceId, &f64)| way <= NO_WAY * problem.size;
    let complaint = |(id, _): (&ForceId, &f64)| Complaint {
        at: model.forces[*id].site(),
        message: "the two points meet wherever the loops are closed: a line between them has no direction".to_owned(),
        help: Some("let it act between other points, or leave it out".to_owned()),
    };
    // Equations of velocities alone hold no points together.
    let complaints: Vec<Complaint> = match structure.closed.is_empty() || problem.equations.is_empty() {
        true => Vec::new(),
        false => open.iter().zip(&longest).filter(meets).map(complaint).collect(),
    };
    if complaints.is_empty() { Ok(held) } else { Err(complaints) }
}
