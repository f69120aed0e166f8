//! Stage `mechanics`: shapes of joints, frames, bodies and forces, as text that is equal where they are alike.
//!
//! In: the checked model. Out: shapes of loops, branches and links. Expressions are evaluated with parameters at generic
//! values (of the defaults' signs), so that zero means zero whatever the parameters; what changes in time has no value.

use std::collections::HashMap;

use crate::mechanics::analysis::driven_by;
use crate::model::checks::evaluate::{Evaluator, Value};
use crate::model::types::{
    BodyId, BodyRef, ConstraintKind, Coordinate, DriveTarget, Expr, ForceKind, Frame, FrameStep, Joint, JointId,
    LoopClosure, Model, ParamId, SolveHow, Type,
};
use crate::symbolic::fingerprint::mix;

use super::{Forest, Loop};

pub(super) struct Shapes<'m> {
    model: &'m Model,
    forest: &'m Forest<'m>,
    values: Evaluator,
    /// Bodies that members hang on.
    hubs: Vec<bool>,
    on_loop: Vec<bool>,
    /// Of the forces on a joint, and on a body.
    on_joints: Vec<Vec<String>>,
    on_bodies: Vec<Vec<String>>,
    /// What becomes of a coordinate besides being in the state.
    marks: HashMap<Coordinate, char>,
}

impl<'m> Shapes<'m> {
    pub(super) fn new(model: &'m Model, forest: &'m Forest<'m>, hubs: Vec<bool>, on_loop: Vec<bool>) -> Shapes<'m> {
        let mut values = Evaluator::default();
        for (number, param) in model.params.iter().enumerate() {
            let mut generic = param.default.iter().enumerate().map(|(element, &default)| {
                let random = (mix(mix(number as u64) ^ element as u64) >> 11) as f64 / (1_u64 << 53) as f64;
                if default == 0.0 { 0.5 + random } else { default * (0.75 + 0.5 * random) }
            });
            if let Some(value) = shaped(&param.ty, &mut generic) {
                values.set_param(ParamId(number), value);
            }
        }
        let mut marks = HashMap::new();
        for solve in &model.solves {
            let mark = if matches!(solve.how, SolveHow::From { .. }) { 's' } else { 'f' };
            marks.extend(solve.unknowns.iter().map(|&unknown| (unknown, mark)));
        }
        for drive in &model.drives {
            let mark = if matches!(drive.target, DriveTarget::Coordinate(_)) { 'd' } else { 'D' };
            marks.extend(driven_by(model, drive.target).into_iter().map(|coordinate| (coordinate, mark)));
        }
        let (on_joints, on_bodies) = (vec![Vec::new(); model.joints.len()], vec![Vec::new(); model.bodies.len()]);
        let mut shapes = Shapes { model, forest, values, hubs, on_loop, on_joints, on_bodies, marks };
        shapes.forces();
        shapes
    }

    pub(super) fn is_on_loop(&self, joint: JointId) -> bool {
        self.on_loop[joint.0]
    }

    /// Once around.
    pub(super) fn looped(&mut self, one: &Loop) -> String {
        let model = self.model;
        let [out, back] = one.sides.each_ref().map(|side| {
            let links: Vec<String> = side
                .iter()
                .map(|&id| {
                    let stand = self.stand_on(id, one.carrier);
                    let link = self.link(id);
                    format!("{stand} {link}{}", self.beside(id))
                })
                .collect();
            links.join("; ")
        });
        let closed = match one.closing {
            LoopClosure::Cut(id) => model.joints.get(id.0).map(|joint| {
                let kind = self.kind(joint);
                let ends = [&joint.parent, &joint.child].map(|frame| self.end(frame, one.carrier));
                format!("{} {kind} {}{:?}", ends[0], ends[1], self.on_joints[id.0])
            }),
            LoopClosure::Constraint(id) => model.constraints.get(id.0).map(|constraint| match &constraint.kind {
                ConstraintKind::Rod { between, length } => {
                    let ends = between.each_ref().map(|frame| self.end(frame, one.carrier));
                    format!("{} rod {} {}", ends[0], self.entries(length), ends[1])
                }
                ConstraintKind::Value(_) | ConstraintKind::Rate(_) => String::new(),
            }),
        };
        let solved = model.solves.iter().filter_map(|solve| {
            let at = solve.closings().position(|closing| closing == one.closing)?;
            Some((at, solve.closings().count()))
        });
        let solved: Vec<(usize, usize)> = solved.collect();
        format!("{} | {out} | {} | {back} | {solved:?}", one.on_ground, closed.unwrap_or_default())
    }

    /// Branches without loops on a body of a loop.
    fn beside(&mut self, joint: JointId) -> String {
        let Some(body) = self.forest.body(joint).filter(|body| !self.hubs[body.0]) else { return String::new() };
        let forest = self.forest;
        let children = forest.children(Some(body));
        let mut shapes: Vec<String> = children
            .iter()
            .filter_map(|&child| {
                let branch = self.branch(child)?;
                Some(format!("{} {branch}", self.stand(child)))
            })
            .collect();
        shapes.sort_unstable();
        format!("[{}]", shapes.join(", "))
    }

    /// A joint and all that it carries; nothing where a loop passes.
    pub(super) fn branch(&mut self, joint: JointId) -> Option<String> {
        if self.is_on_loop(joint) {
            return None;
        }
        let mut children = Vec::new();
        if let Some(body) = self.forest.body(joint) {
            let forest = self.forest;
            for &child in forest.children(Some(body)) {
                let branch = self.branch(child)?;
                children.push(format!("{} {branch}", self.stand(child)));
            }
        }
        children.sort_unstable();
        Some(format!("{}({})", self.link(joint), children.join(", ")))
    }

    /// A joint and its body, wherever they stand.
    pub(super) fn link(&mut self, id: JointId) -> String {
        let joint = &self.model.joints[id];
        let kind = self.kind(joint);
        let child = self.steps(&joint.child);
        let armature = joint.armature.as_ref().map(|armature| self.entries(armature));
        let marks = (0..joint.kind.freedoms()).map(|index| self.marks.get(&Coordinate { joint: id, index }));
        let marks: String = marks.map(|mark| mark.copied().unwrap_or('-')).collect();
        let body = self.forest.body(id).map_or_else(String::new, |body| self.body(body));
        format!("{kind}{child}{armature:?}{marks}{:?}{body}", self.on_joints[id.0])
    }

    fn body(&mut self, id: BodyId) -> String {
        if self.hubs[id.0] {
            return "hub".to_owned();
        }
        let body = &self.model.bodies[id];
        let (mass, com) = (self.entries(&body.mass), self.entries(&body.com));
        let inertia = body.inertia.as_ref().map(|entries| {
            let entries = entries.iter().map(|entry| self.entries(entry));
            entries.collect::<String>()
        });
        format!("m{mass}c{com}i{inertia:?}{:?}", self.on_bodies[id.0])
    }

    /// Where a joint stands on its parent.
    pub(super) fn stand(&mut self, id: JointId) -> String {
        self.steps(&self.model.joints[id].parent)
    }

    fn stand_on(&mut self, id: JointId, carrier: Option<BodyId>) -> String {
        self.end(&self.model.joints[id].parent, carrier)
    }

    /// A frame that may be on what the members hang on.
    fn end(&mut self, frame: &Frame, carrier: Option<BodyId>) -> String {
        match frame.body {
            BodyRef::Ground => "any".to_owned(),
            BodyRef::Body(body) if self.hubs[body.0] || carrier == Some(body) => "any".to_owned(),
            BodyRef::Body(_) => self.steps(frame),
        }
    }

    fn steps(&mut self, frame: &Frame) -> String {
        let mut text = String::from("<");
        for step in &frame.steps {
            text += &match step {
                FrameStep::At(offset) => match self.entries(offset) {
                    zero if zero == "000" => continue,
                    entries => format!("at {entries} "),
                },
                FrameStep::Rotated(axis, angle) => format!("turn {} {} ", self.signs(axis), self.angle(angle)),
                FrameStep::Oriented(rows) => {
                    let entries = rows.iter().flatten().map(|entry| self.signs(entry));
                    format!("axes {} ", entries.collect::<String>())
                }
            };
        }
        text + ">"
    }

    fn kind(&mut self, joint: &Joint) -> String {
        let mut text = joint.kind.word.to_owned();
        for written in joint.directions.written().into_iter().chain(&joint.pitch) {
            text += &format!(" {}", self.signs(written));
        }
        if let Some(orientation) = joint.kind.orientation {
            text += &format!(" {orientation:?}");
        }
        text
    }

    /// `0` and `x` for each scalar.
    fn entries(&mut self, expr: &Expr) -> String {
        self.scalars(expr, |x| if x == 0.0 { '0' } else { 'x' })
    }

    /// `0`, `+` and `-`; ones are told apart, since with them other things vanish too.
    fn signs(&mut self, expr: &Expr) -> String {
        self.scalars(expr, |x| match x {
            0.0 => '0',
            1.0 => '1',
            -1.0 => 'i',
            x if x > 0.0 => '+',
            _ => '-',
        })
    }

    /// Quarters of a turn are told apart.
    fn angle(&mut self, expr: &Expr) -> String {
        self.scalars(expr, |x| {
            let quarters = x / std::f64::consts::FRAC_PI_2;
            let whole = quarters.round();
            if (quarters - whole).abs() > 1e-12 {
                return 'x';
            }
            match whole.rem_euclid(4.0) {
                0.0 => '0',
                1.0 => '1',
                2.0 => '2',
                _ => '3',
            }
        })
    }

    /// What changes in time is one `v`.
    fn scalars(&mut self, expr: &Expr, sort: impl Fn(f64) -> char) -> String {
        let Some(value) = self.values.value(expr) else { return "v".to_owned() };
        let mut flat = Vec::new();
        value.flatten(&mut flat);
        flat.into_iter().map(sort).collect()
    }

    /// Forces by what they act on.
    fn forces(&mut self) {
        let model = self.model;
        for force in &model.forces {
            match &force.kind {
                ForceKind::Effort { joint, values } => {
                    let values: Vec<String> = values.iter().map(|value| self.entries(value)).collect();
                    self.act_on_joint(*joint, format!("effort {}", values.join(" ")));
                }
                ForceKind::JointSpring { joint, coordinate, stiffness, damping, rest } => {
                    let shape = self.optional([stiffness, damping, rest]);
                    self.act_on_joint(*joint, format!("spring {coordinate} {shape}"));
                }
                ForceKind::LineSpring { between, stiffness, damping, length } => {
                    let shape = self.optional([stiffness, damping, length]);
                    for (end, frame) in between.iter().enumerate() {
                        let steps = self.steps(frame);
                        self.act_on_body(frame, format!("line {end} {steps} {shape}"));
                    }
                }
                ForceKind::Force { at, value, axes } => {
                    let shape = format!("force {} {} {}", self.steps(at), self.entries(value), self.axes(at, axes));
                    self.act_on_body(at, shape);
                }
                ForceKind::Torque { at, value, axes } => {
                    let shape = format!("torque {} {} {}", self.steps(at), self.entries(value), self.axes(at, axes));
                    self.act_on_body(at, shape);
                }
            }
        }
        for list in self.on_joints.iter_mut().chain(&mut self.on_bodies) {
            list.sort_unstable();
        }
    }

    fn optional(&mut self, list: [&Option<Expr>; 3]) -> String {
        let texts = list.map(|expr| expr.as_ref().map_or_else(|| "-".to_owned(), |expr| self.entries(expr)));
        texts.join(" ")
    }

    fn axes(&mut self, at: &Frame, axes: &Frame) -> String {
        match axes.body {
            BodyRef::Ground => "world".to_owned(),
            body => format!("{} {}", body == at.body, self.steps(axes)),
        }
    }

    fn act_on_joint(&mut self, joint: JointId, shape: String) {
        if let Some(list) = self.on_joints.get_mut(joint.0) {
            list.push(shape);
        }
    }

    fn act_on_body(&mut self, frame: &Frame, shape: String) {
        if let BodyRef::Body(body) = frame.body
            && let Some(list) = self.on_bodies.get_mut(body.0)
        {
            list.push(shape);
        }
    }
}

/// A value of a type from its scalars in order.
fn shaped(ty: &Type, scalars: &mut impl Iterator<Item = f64>) -> Option<Value> {
    Some(match ty {
        Type::Vec3 => Value::Vec3([scalars.next()?, scalars.next()?, scalars.next()?]),
        Type::Array(element, count) => {
            let mut list = Vec::with_capacity(*count);
            for _ in 0..*count {
                list.push(shaped(element, scalars)?);
            }
            Value::from(list)
        }
        _ => Value::Scalar(scalars.next()?),
    })
}
