//! Stage `model`: which functions are derived.
//!
//! In: `emit`. Out: the functions, the inputs that inverse dynamics finds, what kinematics is given and finds; 'not yet'
//! for what later versions bring.

use std::collections::BTreeSet;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, Member};

use crate::model::checker::{Checker, Context, Meaning, ScopeId};
use crate::model::expand::root;
use crate::model::expressions::bodies::{NO_CENTRE, Selected};
use crate::model::expressions::source_text;
use crate::model::topology::Topology;
use crate::model::typed::MAX_SCALARS;
use crate::model::types::Expr as Checked;
use crate::model::types::{Coordinate, ExprNode, InputId, JointId, Joints, Kinematics, Request, SolveFor};
use crate::syntax::tree;

use super::fields::{Known, field};

const REQUESTS: [(&str, Request); 20] = [
    ("forward_dynamics", Request::ForwardDynamics),
    ("inverse_dynamics", Request::InverseDynamics),
    ("mass_matrix", Request::MassMatrix),
    ("mass_matrix_lower", Request::MassMatrixLower),
    ("bias", Request::Bias),
    ("energy", Request::Energy),
    ("constraints", Request::Constraints),
    ("residual", Request::Residual),
    ("kinematics", Request::Kinematics),
    ("assembly_modes", Request::AssemblyModes),
    ("derivatives", Request::Derivatives),
    ("linearize", Request::Linearize),
    ("impulse", Request::Impulse),
    ("momentum", Request::Momentum),
    ("centroidal_momentum_matrix", Request::CentroidalMomentumMatrix),
    ("poses", Request::Poses),
    ("outputs", Request::Outputs),
    ("at", Request::At),
    ("report", Request::Report),
    ("equations", Request::Equations),
];

/// Named by the design, derived by later versions; what there is instead.
const NOT_YET: [(&str, &str); 4] = [
    ("regressor", "`inverse_dynamics` is linear in masses and moments of mass: differences of two calls give a column"),
    ("assemble", "call `multibody::assemble`, for models whose loops are held by multipliers"),
    ("reactions", "write `output name = joint.reaction;`"),
    ("gravity", "write `bias`: at rest, without other forces, it is what gravity demands"),
];

/// They come with another function.
const TOGETHER: [(&str, &str); 11] = [
    ("constraint_jacobian", "constraints"),
    ("constraint_rate", "constraints"),
    ("constraint_bias", "constraints"),
    ("kinetic_energy", "energy"),
    ("potential_energy", "energy"),
    ("forward_derivatives", "derivatives"),
    ("inverse_derivatives", "derivatives"),
    ("momentum_rate", "momentum"),
    ("velocity", "momentum"),
    ("close", "forward_dynamics"),
    ("dead_centres", "forward_dynamics"),
];

/// What other tools call a function, or what is no function here.
const ELSEWHERE: [(&str, &str); 13] = [
    ("ForwardDynamics", "write `forward_dynamics`"),
    ("dynamics", "write `forward_dynamics`"),
    ("accelerations", "write `forward_dynamics`"),
    ("acceleration", "write `forward_dynamics`"),
    ("InverseDynamics", "write `inverse_dynamics`"),
    ("coriolis", "write `bias`: the efforts at zero acceleration"),
    ("inertia_matrix", "write `mass_matrix`"),
    ("linearise", "write `linearize`"),
    ("linearization", "write `linearize`"),
    ("state_space", "write `linearize`"),
    ("gradients", "write `derivatives`"),
    ("jacobian", "write `output name = body.jacobian;`: outputs are always emitted"),
    ("forward_kinematics", "write `poses` for all bodies, or `output name = body.pose;`: outputs are always emitted"),
];

const KINEMATICS: Known<'static> = Known { required: &["given", "find"], optional: &[] };

const INVERSE: Known<'static> = Known { required: &[], optional: &["solve_for"] };

/// What `emit` asks for.
#[derive(Default)]
pub(in crate::model) struct Requested<'a> {
    pub(in crate::model) list: Vec<Request>,
    /// With the place of each.
    pub(in crate::model) asked: Vec<(Request, Span)>,
    pub(in crate::model) solve_for: Vec<SolveFor>,
    /// Read when it is known what hangs on what.
    pub(in crate::model) kinematics: Vec<(&'a tree::Request, ScopeId)>,
    /// The same of `assembly_modes`.
    pub(in crate::model) assembly: Option<(&'a tree::Request, ScopeId)>,
    /// Groups of outputs, read when all outputs are known.
    pub(in crate::model) outputs: Vec<&'a tree::Fields>,
    /// Functions that go on from a position, read when all else that is asked for is known.
    pub(in crate::model) at: Option<&'a tree::Request>,
    /// Where `constraints` is asked for.
    pub(in crate::model) constraints: Option<Span>,
}

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn emit(&mut self, requests: &'a [tree::Request], scope: ScopeId, into: &mut Requested<'a>) {
        for request in requests {
            let name = request.name.to_string();
            let span = request.name.span();
            if name == tree::UNREADABLE {
                self.report.silent();
                continue;
            }
            if let Some((_, found)) = REQUESTS.iter().find(|(known, _)| *known == name) {
                if *found == Request::Kinematics {
                    into.kinematics.push((request, scope));
                } else if *found == Request::Outputs {
                    let Some(options) = &request.options else {
                        let instead =
                            "outputs are always emitted; `outputs { name: [output, ..] }` gives some of them alone";
                        self.report.help(span, "`outputs` needs no asking for", instead);
                        continue;
                    };
                    into.outputs.push(options);
                } else if into.list.contains(found) {
                    let message = format!("`{name}` is asked for twice");
                    self.report.error(span, message);
                    continue;
                } else if *found == Request::AssemblyModes {
                    into.assembly = Some((request, scope));
                } else if *found == Request::At {
                    into.at = Some(request);
                } else {
                    self.options(request, scope, into);
                }
                if *found == Request::Poses {
                    self.check_poses(span);
                }
                if *found == Request::CentroidalMomentumMatrix {
                    self.selected.push(Selected { bodies: None, text: name, help: NO_CENTRE, span });
                }
                if *found == Request::Constraints {
                    into.constraints = Some(span);
                }
                if !into.list.contains(found) {
                    into.list.push(*found);
                    into.asked.push((*found, span));
                }
            } else if let Some((_, instead)) = NOT_YET.iter().find(|(known, _)| *known == name) {
                self.report.help(span, format!("`{name}` is not available yet"), *instead);
            } else if let Some((_, instead)) = ELSEWHERE.iter().find(|(known, _)| *known == name) {
                self.report.help(span, format!("`{name}` is nothing that can be derived"), *instead);
            } else if let Some((_, with)) = TOGETHER.iter().find(|(known, _)| *known == name) {
                self.report.help(
                    span,
                    format!("`{name}` is not asked for by itself"),
                    format!("it comes with `{with}`"),
                );
            } else {
                let list: Vec<&str> = REQUESTS.iter().map(|(known, _)| *known).collect();
                self.report.unknown(
                    span,
                    format!("`{name}` is nothing that can be derived"),
                    &name,
                    list.iter().copied().chain(NOT_YET.iter().map(|(known, _)| *known)),
                    Some(format!("there are `{}`", list.join("`, `"))),
                );
            }
        }
    }

    /// A part of this name is in the way only of who asks for the struct.
    fn check_poses(&mut self, span: Span) {
        if let Some(part) = self.part_types.iter().find(|part| part.name == "Poses") {
            let message = "the struct that `poses` gives would be `Poses`";
            let help = format!("there is a part of this name: give `mod {}` another one", part.name);
            self.report.help(span, message, help);
        }
    }

    /// Of all but kinematics.
    fn options(&mut self, request: &'a tree::Request, scope: ScopeId, into: &mut Requested<'a>) {
        let Some(options) = &request.options else {
            return;
        };
        if options.broken {
            self.report.silent();
        }
        let name = request.name.to_string();
        if name != "inverse_dynamics" {
            if let Some(option) = options.list.first() {
                self.report.error(option.name.span(), format!("`{name}` has no options"));
            }
            return;
        }
        self.check_given("`inverse_dynamics`", options, &INVERSE);
        if let Some(expr) = field(options, "solve_for") {
            self.solve_for(expr, root(scope), into);
        }
    }

    /// `solve_for: legs.thrust`: inputs, element by element.
    fn solve_for(&mut self, expr: &'a Expr, context: Context<'a>, into: &mut Requested<'a>) {
        let elements: Vec<&Expr> = match expr {
            Expr::Array(array) => array.elems.iter().collect(),
            other => vec![other],
        };
        let mut seen: BTreeSet<(InputId, usize)> = into.solve_for.iter().map(|of| (of.input, of.element)).collect();
        for element in elements {
            let Some(meanings) = self.several_meanings(element, context) else {
                continue;
            };
            let span = element.span();
            for meaning in meanings {
                let place = match &meaning {
                    Meaning::Value(value) => input_element(&value.expr),
                    _ => None,
                };
                let Some((input, first, count)) = place else {
                    let message = format!("`{}` is no input", source_text(element));
                    self.report.help(span, message, "`solve_for` lists inputs, which inverse dynamics finds");
                    break;
                };
                if into.solve_for.len() + count > MAX_SCALARS {
                    self.report.error(span, format!("more than {MAX_SCALARS} inputs can't be solved for"));
                    return;
                }
                for element in first..first + count {
                    if !seen.insert((input, element)) {
                        self.report.error(span, "this input is named twice");
                        break;
                    }
                    into.solve_for.push(SolveFor { input, element, span });
                }
            }
        }
    }

    /// `kinematics { given: platform.pose, find: legs.stroke }`
    pub(in crate::model) fn kinematics(
        &mut self,
        request: &'a tree::Request,
        scope: ScopeId,
        joints: Option<(&Topology, &Joints)>,
    ) -> Option<Kinematics> {
        let word = request.name.to_string();
        let form = match &word[..] {
            "assembly_modes" => "write `assembly_modes { given: legs.stroke, find: platform.pose }`",
            _ => "write `kinematics { given: platform.pose, find: legs.stroke }`",
        };
        let span = request.name.span();
        let Some(options) = &request.options else {
            self.report.help(span, format!("`{word}` needs to know what is given and what to find"), form);
            return None;
        };
        self.check_fields(&format!("`{word}`"), &request.name, options, &KINEMATICS);
        let context = root(scope);
        let given = field(options, "given").and_then(|expr| self.given(expr, context, joints));
        let find = field(options, "find").and_then(|expr| {
            let mut found = Vec::new();
            for (coordinate, at) in self.found(expr, context, joints)? {
                if let Some((topology, list)) = joints
                    && topology.is_cut(coordinate.joint)
                {
                    self.refuse_cut_coordinate(coordinate.joint, at, list);
                    return None;
                }
                if found.contains(&coordinate) {
                    let message = format!("{} is named twice", self.coordinate_name(coordinate));
                    self.report.error(at, message);
                    return None;
                }
                found.push(coordinate);
            }
            Some(found)
        });
        let (given, find) = (given?, find?);
        if let Some(both) = find.iter().find(|coordinate| given.contains(&coordinate.joint)) {
            let at = field(options, "find").map_or(span, Spanned::span);
            self.report.error(at, format!("{} is given already", self.coordinate_name(*both)));
            return None;
        }
        Some(Kinematics { given, find, span })
    }

    /// Coordinates, and all of bodies whose pose is named.
    fn found(
        &mut self,
        expr: &'a Expr,
        context: Context<'a>,
        joints: Option<(&Topology, &Joints)>,
    ) -> Option<Vec<(Coordinate, Span)>> {
        let mut found = Vec::new();
        for element in elements(expr) {
            let Some(base) = posed(element) else {
                found.extend(self.several_coordinates(element, context)?);
                continue;
            };
            for meaning in self.several_meanings(base, context)? {
                let Meaning::Frame(frame) = meaning else {
                    self.report.help(
                        element.span(),
                        "expected a coordinate or the pose of a body",
                        "`find` lists coordinates, and bodies with `.pose`",
                    );
                    return None;
                };
                let joint = self.free_carrier(&frame, base, joints)?;
                let freedoms = self.joint_kind(joint)?.freedoms();
                found.extend((0..freedoms).map(|index| (Coordinate { joint, index }, element.span())));
            }
        }
        Some(found)
    }

    /// Joints, and bodies on a Free joint.
    fn given(
        &mut self,
        expr: &'a Expr,
        context: Context<'a>,
        joints: Option<(&Topology, &Joints)>,
    ) -> Option<Vec<JointId>> {
        let mut given: Vec<JointId> = Vec::new();
        for element in elements(expr) {
            let base = posed(element).unwrap_or(element);
            for meaning in self.several_meanings(base, context)? {
                let joint = match meaning {
                    Meaning::Joint(joint) => joint,
                    Meaning::Coordinate(joint, _) if self.joint_kind(joint)?.freedoms() == 1 => joint,
                    Meaning::Frame(frame) => self.free_carrier(&frame, base, joints)?,
                    _ => {
                        self.report.help(
                            element.span(),
                            "expected a joint or the pose of a body",
                            "`given` lists joints, and bodies with `.pose`",
                        );
                        return None;
                    }
                };
                if let Some((topology, list)) = joints
                    && topology.is_cut(joint)
                {
                    self.refuse_cut_coordinate(joint, element.span(), list);
                    return None;
                }
                if given.contains(&joint) {
                    self.report.error(element.span(), format!("`{}` is given twice", source_text(base)));
                    return None;
                }
                given.push(joint);
            }
        }
        Some(given)
    }
}

/// Of a list each, else the expression itself.
pub(super) fn elements(expr: &Expr) -> Vec<&Expr> {
    match expr {
        Expr::Array(array) => array.elems.iter().collect(),
        other => vec![other],
    }
}

/// The body of `body.pose`.
fn posed(expr: &Expr) -> Option<&Expr> {
    match expr {
        Expr::Field(field) if matches!(&field.member, Member::Named(name) if name == "pose") => Some(&field.base),
        _ => None,
    }
}

/// The input behind an expression, its first scalar, and how many.
fn input_element(expr: &Checked) -> Option<(InputId, usize, usize)> {
    match &*expr.node {
        ExprNode::Input(id) => Some((*id, 0, expr.ty.scalars())),
        ExprNode::Index(base, index) | ExprNode::Component(base, index) => {
            let (id, first, _) = input_element(base)?;
            let count = expr.ty.scalars();
            Some((id, first + index * count, count))
        }
        _ => None,
    }
}
