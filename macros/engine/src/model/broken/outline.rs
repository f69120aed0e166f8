//! Stage `model`: what is known of a model that has mistakes.
//!
//! In: a checker that has reported all it had to say. Out: the model again, with something of the right type and place
//! wherever an item was wrong, so that what stands beside the error has the fields that the model would have had, and
//! the user's code about it still compiles: one mistake, one error. Items are worked out once more, silently; those that
//! give nothing are replaced: a misspelt kind by the nearest, an output by a value of the type that its expression
//! seems to have, an unknown frame by none. Values are never looked at: only names, types and what hangs on what.

use std::collections::HashSet;

use proc_macro2::{Ident, Span};
use syn::{Expr as Written, Type as WrittenType};

use crate::diagnostics::nearest;
use crate::invariant::fault::raise;
use crate::invariant::index_vec::IndexVec;
use crate::model::assemble::{Collected, Loops};
use crate::model::checker::{Checker, Context, Subject, Task};
use crate::model::expand::root;
use crate::model::items::fields::field;
use crate::model::items::joints::{fields_of, meant};
use crate::model::items::loops::Driven;
use crate::model::joint_kinds::{self, JointKind};
use crate::model::topology::Topology;
use crate::model::typed::{bounded_scalars, new_expr};
use crate::model::types::{
    Bodies, Body, BodyRef, Constraint, ConstraintKind, Coordinate, Directions, Docs, Drive, DriveTarget, Expr,
    ExprNode, Frame, Handling, Input, InstanceId, Joint, JointId, Joints, Kinematics, Model, Output, Param, Place,
    Request, Solve, SolveHow, State, Type,
};
use crate::model::{Checked, Soundness};
use crate::syntax::tree::{self, ItemKind};

impl<'a> Checker<'a, '_> {
    /// The model with its mistakes filled in.
    pub(in crate::model) fn outline(&mut self, index: usize) -> Option<Checked> {
        self.report.mute(true);
        let checked = self.filled(index);
        self.report.mute(false);
        self.report.take_failed();
        checked.map(|mut checked| {
            rename_doubles(&mut checked.model);
            checked
        })
    }

    fn filled(&mut self, index: usize) -> Option<Checked> {
        let module = &self.source.modules[index];
        let mut whole = !module.broken && !self.lost;
        let mut collected = self.read_all();
        let bodies: Bodies = self.filled_bodies(std::mem::take(&mut collected.bodies));
        let mut ends: IndexVec<JointId, _> = IndexVec::new();
        let mut joints: Joints = IndexVec::new();
        for joint in std::mem::take(&mut collected.joints) {
            let id = joints.next();
            let (joint, known) = joint.map(known_ends).unwrap_or_else(|| self.filled_joint(id, &mut whole));
            joints.push(joint);
            ends.push(known);
        }
        let topology = match ends.iter().flatten().all(Option::is_some) {
            true => self.topology(&bodies, &joints, module),
            false => None,
        };
        whole &= topology.is_some();
        let topology = topology.unwrap_or_else(|| self.supposed(bodies.len(), &joints, &ends));
        whole &= collected.constraints.iter().all(Option::is_some);
        let mut constraints = self.filled_constraints(std::mem::take(&mut collected.constraints));
        let mut loops = self.filled_loops(&collected, (&topology, &joints), &mut whole);
        constraints.append(&mut loops.held);
        let handling = collected.handling.take().or_else(|| meant_handling(&collected));
        let mut emit = collected.requested.list;
        if emit.is_empty() {
            emit.push(Request::ForwardDynamics);
        }
        let outputs = self.filled_outputs();
        let output_groups = self.output_groups(&collected.requested.outputs, &outputs);
        let model = Model {
            params: self.filled_params().into(),
            inputs: self.filled_inputs().into(),
            states: self.filled_states(collected.states).into(),
            bodies,
            joints,
            tree: topology.tree,
            cuts: topology.cuts,
            constraints: constraints.into(),
            drives: loops.drives,
            solves: loops.solves,
            handling: handling.unwrap_or_default(),
            independent: loops.independent,
            solve_for: collected.requested.solve_for,
            kinematics: loops.kinematics,
            assembly: loops.assembly,
            at: self.at_functions(collected.requested.at, &emit, &outputs, &output_groups),
            output_groups,
            outputs,
            emit,
            ..self.blank(module)
        };
        Some(Checked { model, state: if whole { Soundness::Whole } else { Soundness::Guessed } })
    }

    fn filled_bodies(&mut self, bodies: Vec<Option<Body>>) -> Bodies {
        let slots: Vec<_> = self.bodies.iter().map(|slot| slot.place.clone()).collect();
        let filled = bodies.into_iter().zip(slots).map(|(body, place)| {
            body.unwrap_or_else(|| Body {
                place,
                mass: zero(Type::Scalar),
                com: zero(Type::Vec3),
                inertia: None,
                docs: Docs::default(),
                span: Span::call_site(),
            })
        });
        filled.collect()
    }

    /// A joint with mistakes, and the bodies on both sides as far as they are known. Where misspelt words are all that was
    /// wrong, it is the joint that was meant.
    fn filled_joint(&mut self, id: JointId, whole: &mut bool) -> (Joint, [Option<BodyRef>; 2]) {
        let slot = &self.joints[id];
        let (place, item, context) = (slot.place.clone(), slot.item, root(slot.scope));
        let ItemKind::Joint { kind, fields, .. } = &item.kind else {
            raise("the joint of a body with absolute coordinates has no mistakes");
        };
        let meant_kind = slot.kind.unwrap_or_else(|| meant(&kind.to_string(), fields));
        let fields = self.corrected_fields(fields, &fields_of(meant_kind, fields), context);
        let frames = ["parent", "child"].map(|name| {
            let found = field(&fields, name).and_then(|expr| self.near_frame(expr, context));
            *whole &= matches!(found, Some((_, true)));
            found.map(|(frame, _)| frame)
        });
        let found = self.joint_directions(meant_kind, &fields, context);
        *whole &= found.is_some();
        let ends = frames.each_ref().map(|frame| frame.as_ref().map(|frame| frame.body));
        let nowhere = || Frame { body: BodyRef::Ground, steps: Vec::new(), span: Span::call_site() };
        let [parent, child] = frames.map(|frame| frame.unwrap_or_else(nowhere));
        let (directions, pitch) = found.unwrap_or_else(|| unread(meant_kind));
        let joint = Joint {
            place,
            kind: meant_kind,
            directions,
            pitch,
            parent,
            child,
            armature: None,
            docs: Docs::default(),
            span: Span::call_site(),
        };
        (joint, ends)
    }

    /// A frame whose steps may be wrong, and whether they are not: of `b.at(mistake)` the body is known.
    fn near_frame(&mut self, expr: &Written, context: Context<'a>) -> Option<(Frame, bool)> {
        if let Some(frame) = self.frame(expr, context) {
            return Some((frame.frame, true));
        }
        match expr {
            Written::MethodCall(call) => self.near_frame(&call.receiver, context).map(|(frame, _)| (frame, false)),
            Written::Paren(inner) => self.near_frame(&inner.expr, context),
            _ => None,
        }
    }

    fn filled_constraints(&mut self, constraints: Vec<Option<Constraint>>) -> Vec<Constraint> {
        let places: Vec<_> = self.constraints.iter().map(|slot| slot.place.clone()).collect();
        let filled = constraints.into_iter().zip(places).map(|(constraint, place)| {
            constraint.unwrap_or_else(|| Constraint {
                place,
                kind: ConstraintKind::Value(zero(Type::Scalar)),
                drive: None,
                docs: Docs::default(),
                span: Span::call_site(),
            })
        });
        filled.collect()
    }

    /// Drives and `solve` items whose coordinates are known count, whatever is wrong with their values.
    fn filled_loops(&mut self, collected: &Collected<'a>, tree: (&Topology, &Joints), whole: &mut bool) -> Loops {
        let mut loops = Loops::default();
        for task in &collected.deferred {
            let context = root(task.scope);
            match &task.item.kind {
                ItemKind::Drive { target, value } => {
                    let found = self.drive(target, value, context, Some(tree)).or_else(|| {
                        let target = self.drive_target(target, context, Some(tree))?;
                        // What is only measured has no coordinate to take away.
                        let is_cut = matches!(target, DriveTarget::Coordinate(c) if tree.0.is_cut(c.joint));
                        let value = zero(type_of(target));
                        (!is_cut).then(|| Driven::Follows(Drive { target, value, span: Span::call_site() }))
                    });
                    *whole &= found.is_some();
                    match found {
                        Some(Driven::Follows(drive)) => loops.drives.push(drive),
                        Some(Driven::Held(constraint)) => loops.held.push(constraint),
                        None => {}
                    }
                }
                ItemKind::Solve { unknowns, how } => {
                    let found = self.solve(unknowns, how, task.item.keyword, context, Some(tree));
                    *whole &= found.is_some();
                    if let Some(found) = found {
                        if let crate::model::items::solves::SolveItem::Item(solve) = found {
                            loops.solves.push(solve);
                        }
                        continue;
                    }
                    let lists = unknowns.iter().filter_map(|expr| self.several_coordinates(expr, context));
                    let unknowns = lists.flatten().map(|(coordinate, _)| coordinate).collect();
                    let how = SolveHow::Formulas(Vec::new());
                    loops.solves.push(Solve { unknowns, how, span: Span::call_site() });
                }
                _ => {}
            }
        }
        if let Some((fields, scope)) = collected.independent {
            loops.independent = self.independent(fields, scope, Some(tree));
        }
        for (request, scope) in &collected.requested.kinematics {
            let found = self.kinematics(request, *scope, Some(tree)).unwrap_or_else(|| {
                let context = root(*scope);
                let find = request.options.as_ref().and_then(|options| field(options, "find"));
                let find = find.and_then(|expr| self.several_coordinates(expr, context));
                // One at least.
                let first = Coordinate { joint: JointId(0), index: 0 };
                let find = find.map_or(vec![first], |list| list.into_iter().map(|(c, _)| c).collect());
                Kinematics { given: Vec::new(), find, span: Span::call_site() }
            });
            loops.kinematics.push(found);
        }
        loops
    }

    fn filled_params(&mut self) -> Vec<Param> {
        let mut params = Vec::with_capacity(self.params.len());
        for id in self.params.ids() {
            let known = self.param_type(id, Span::call_site());
            let slot = &self.params[id];
            let (place, item, scope) = (slot.place.clone(), slot.item, slot.scope);
            let mut default = Vec::new();
            if let Some(value) = self.evaluator.param(id) {
                value.flatten(&mut default);
            }
            let ty = known.unwrap_or_else(|| self.seeming(item, root(scope)));
            let ty = if matches!(ty, Type::Vec3 | Type::Array(..)) { ty } else { Type::Scalar };
            default.resize(ty.scalars(), 0.0);
            params.push(Param { place, ty, default, docs: Docs::default() });
        }
        params
    }

    fn filled_inputs(&mut self) -> Vec<Input> {
        let mut inputs = Vec::with_capacity(self.inputs.len());
        for id in self.inputs.ids() {
            let known = self.input_type(id);
            let slot = &self.inputs[id];
            let (place, item, scope) = (slot.place.clone(), slot.item, slot.scope);
            let ty = known.unwrap_or_else(|| self.seeming(item, root(scope)));
            inputs.push(Input { place, ty, docs: Docs::default() });
        }
        inputs
    }

    fn filled_states(&mut self, states: Vec<Option<State>>) -> Vec<State> {
        let places: Vec<_> = self.states.iter().map(|slot| slot.place.clone()).collect();
        let filled = states.into_iter().zip(places).map(|(state, place)| {
            state.unwrap_or_else(|| State { place, rate: zero(Type::Scalar), start: 0.0, docs: Docs::default() })
        });
        filled.collect()
    }

    fn filled_outputs(&mut self) -> Vec<Output> {
        let mut outputs = Vec::new();
        for Task { item, subject, .. } in self.tasks.clone() {
            let (Subject::Named(id), ItemKind::Output(value)) = (subject, &item.kind) else {
                continue;
            };
            if let Some(output) = self.finish_output(id, item) {
                outputs.push(output);
                continue;
            }
            let named = &self.named[id];
            let (field, home) = (named.name.clone(), named.home);
            let instance = self.scopes[home].instance;
            let ty = match self.seeming(value, root(home)) {
                Type::Bool => Type::Scalar,
                ty => ty,
            };
            outputs.push(Output { place: Place { instance, field }, value: zero(ty), docs: Docs::default() });
        }
        outputs
    }

    /// The declared type of a value, also where it is misspelt, or the one that its expression seems to have.
    fn seeming(&mut self, item: &'a tree::Value, context: Context<'a>) -> Type {
        let declared = match &item.ty {
            Some(written) => self.read_type(written, context, 0).or_else(|| self.near_type(written, context)),
            None => None,
        };
        let seeming = || item.value.as_ref().map_or(Type::Scalar, |expr| self.seeming_type(expr, context));
        match declared.unwrap_or_else(seeming) {
            Type::Array(element, count) if *element == Type::Array(Box::new(Type::Scalar), 3) => {
                Type::Array(Box::new(Type::Vec3), count)
            }
            ty => ty,
        }
    }

    /// `Vector3`, `[f64; 3]`
    fn near_type(&mut self, written: &WrittenType, context: Context<'a>) -> Option<Type> {
        match written {
            WrittenType::Array(array) => {
                let element = self.near_type(&array.elem, context)?;
                let count = usize::try_from(self.whole_number(&array.len, context)?).ok()?;
                let ty = Type::Array(Box::new(element), count);
                bounded_scalars(&ty).filter(|count| *count > 0).map(|_| ty)
            }
            WrittenType::Path(path) => path.path.segments.last().map(|last| named_type(&last.ident.to_string())),
            _ => None,
        }
    }
}

/// A joint without mistakes, and its bodies.
fn known_ends(joint: Joint) -> (Joint, [Option<BodyRef>; 2]) {
    let ends = [Some(joint.parent.body), Some(joint.child.body)];
    (joint, ends)
}

/// The type that somebody who writes `name` is looking for.
fn named_type(name: &str) -> Type {
    let near = nearest(name, ["Vec3", "Vector3", "Rotation", "Pose", "Twist", "Wrench", "Jacobian", "Scalar"]);
    match near.unwrap_or(name) {
        "Vec3" | "Vector3" | "Vector" | "Point3" => Type::Vec3,
        "Rotation" | "UnitQuaternion" | "Quaternion" | "Rotation3" => Type::Rotation,
        "Pose" | "Isometry3" | "Frame" => Type::Pose,
        "Twist" => Type::Twist,
        "Wrench" => Type::Wrench,
        "Jacobian" => Type::Jacobian,
        _ => Type::Scalar,
    }
}

/// `constraints: Reducd`
fn meant_handling(collected: &Collected<'_>) -> Option<Handling> {
    let (fields, _) = collected.independent?;
    let said = field(fields, "constraints")?;
    let Written::Path(path) = said else { return None };
    let name = path.path.get_ident()?.to_string();
    match nearest(&name, ["Reduced", "Multipliers", "Stabilised", "Auto"]).unwrap_or(&name) {
        "Reduced" => Some(Handling::Reduced),
        "Auto" => Some(Handling::Auto),
        _ => None,
    }
}

fn type_of(target: DriveTarget) -> Type {
    match target {
        DriveTarget::Coordinate(_) => Type::Scalar,
        DriveTarget::Position(_) => Type::Vec3,
        DriveTarget::Orientation(_) => Type::Rotation,
        DriveTarget::Pose(_) => Type::Pose,
    }
}

/// What nobody reads in place of a joint's directions and pitch.
fn unread(kind: &JointKind) -> (Directions, Option<Expr>) {
    let axis = || zero(Type::Vec3);
    let directions = match kind.written {
        joint_kinds::Written::Frame => Directions::Frame,
        joint_kinds::Written::Axis | joint_kinds::Written::Plane => Directions::Axis(axis()),
        joint_kinds::Written::Slot => Directions::Slot(Box::new([axis(), axis()])),
        joint_kinds::Written::Crossed => Directions::Crossed(Box::new([axis(), axis()])),
    };
    (directions, kind.has_pitch.then(|| zero(Type::Scalar)))
}

/// Nobody reads its value.
fn zero(ty: Type) -> Expr {
    let node = match ty {
        Type::Vec3 => {
            ExprNode::Vec3([(); 3].map(|()| new_expr(ExprNode::Number(0.0), Type::Scalar, Span::call_site())))
        }
        _ => ExprNode::Number(0.0),
    };
    new_expr(node, ty, Span::call_site())
}

/// Of two fields of one name, which have been reported, the later gets another: both may not stand in one struct.
fn rename_doubles(model: &mut Model) {
    let parts = || {
        let instances =
            model.instances.iter().filter_map(|instance| Some((instance.parent?, instance.field.to_string())));
        instances.collect::<HashSet<(InstanceId, String)>>()
    };
    let rename = |places: Vec<&mut Place>, mut taken: HashSet<(InstanceId, String)>| {
        for place in places {
            let name = place.field.to_string();
            let mut number = 1;
            while !taken.insert((place.instance, place.field.to_string())) {
                number += 1;
                place.field = Ident::new(&format!("{}_{number}", name.trim_start_matches("r#")), place.field.span());
            }
        }
    };
    let taken = parts();
    rename(model.params.iter_mut().map(|param| &mut param.place).collect(), taken.clone());
    rename(model.inputs.iter_mut().map(|input| &mut input.place).collect(), taken.clone());
    rename(model.states.iter_mut().map(|state| &mut state.place).collect(), taken.clone());
    rename(model.outputs.iter_mut().map(|output| &mut output.place).collect(), taken.clone());
    rename(model.joints.iter_mut().map(|joint| &mut joint.place).collect(), taken);
}
