//! For the tests of the stage `model`: reads a call, and writes checked expressions as short text.

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::model::{self, types::*};

/// Parses and checks one `multibody!` call.
pub(crate) fn check(text: &str) -> (Vec<Model>, Diagnostics) {
    let mut diagnostics = Diagnostics::default();
    let tokens = text.parse().expect("tokens");
    let source = multibody_engine::parse(tokens, &mut diagnostics);
    let models = model::check(&source, &mut diagnostics);
    (models, diagnostics)
}

/// One line per error: the underlined text, the message, the help.
pub(crate) fn said(text: &str) -> Vec<String> {
    let (_, diagnostics) = check(text);
    let errors = diagnostics.errors().iter();
    errors
        .map(|error| {
            let token = error.span.source_text().unwrap_or_default();
            let help = error.help.as_deref().map(|help| format!(" | {help}"));
            format!("{token} | {}{}", error.message, help.unwrap_or_default())
        })
        .collect()
}

/// The one model of a call without mistakes.
#[allow(dead_code)]
pub(crate) fn model(text: &str) -> Model {
    let (mut models, _) = check(text);
    assert_eq!(said(text), Vec::<String>::new());
    assert_eq!(models.len(), 1);
    models.remove(0)
}

/// Writes a model's expressions with the names of its leaves.
#[allow(dead_code)]
pub(crate) struct Writer<'m>(pub(crate) &'m Model);

#[allow(dead_code)]
impl Writer<'_> {
    pub(crate) fn place(&self, place: &Place) -> String {
        let mut text = place.field.to_string();
        let mut at = place.instance;
        while let Some(parent) = self.0.instances[at].parent {
            let instance = &self.0.instances[at];
            text = match instance.index {
                Some((k, _)) => format!("{}[{k}].{text}", instance.field),
                None => format!("{}.{text}", instance.field),
            };
            at = parent;
        }
        text
    }

    pub(crate) fn joint(&self, id: JointId) -> String {
        self.place(&self.0.joints[id].place)
    }

    pub(crate) fn frame(&self, frame: &Frame) -> String {
        let mut text = match frame.body {
            BodyRef::Ground => "ground".to_string(),
            BodyRef::Body(id) => self.place(&self.0.bodies[id].place),
        };
        for step in &frame.steps {
            text += &match step {
                FrameStep::At(v) => format!(".at({})", self.expr(v)),
                FrameStep::Rotated(v, a) => {
                    format!(".rotated({}, {})", self.expr(v), self.expr(a))
                }
                FrameStep::Oriented(rows) => {
                    let row = |r: &[Expr; 3]| self.list(r.iter());
                    let rows: Vec<String> = rows.iter().map(row).collect();
                    format!(".oriented({})", rows.join(", "))
                }
            };
        }
        text
    }

    pub(crate) fn list<'e>(&self, list: impl IntoIterator<Item = &'e Expr>) -> String {
        let list: Vec<String> = list.into_iter().map(|e| self.expr(e)).collect();
        format!("[{}]", list.join(", "))
    }

    pub(crate) fn expr(&self, expr: &Expr) -> String {
        let two = |op: &str, a, b| format!("({} {op} {})", self.expr(a), self.expr(b));
        match &*expr.node {
            ExprNode::Number(x) => format!("{x}"),
            ExprNode::Pi => "PI".into(),
            ExprNode::Time => "t".into(),
            ExprNode::Param(id) => self.place(&self.0.params[*id].place),
            ExprNode::Input(id) => self.place(&self.0.inputs[*id].place),
            ExprNode::State(id) => self.place(&self.0.states[*id].place),
            ExprNode::Coordinate { joint, index, order } => {
                let name = ["q", "v", "a"][*order as usize];
                format!("{name}({}, {index})", self.joint(*joint))
            }
            ExprNode::RelativeAngularVelocity(joint) => format!("omega({})", self.joint(*joint)),
            ExprNode::Effort { joint, index } => format!("effort({}, {index})", self.joint(*joint)),
            ExprNode::OfFrame(frame, quantity) => format!("{quantity:?}({})", self.frame(frame)),
            ExprNode::Jacobian { frame, axes } => {
                format!("Jacobian({}, {})", self.frame(frame), self.frame(axes))
            }
            ExprNode::Reaction { joint, axes } => {
                format!("Reaction({}, {})", self.joint(*joint), self.frame(axes))
            }
            ExprNode::Multiplier(id) => format!("{}.multiplier", self.0.constraints[*id].place.field),
            ExprNode::Power(id) => format!("Power({})", self.place(&self.0.forces[*id].place)),
            ExprNode::Kinetic => "Kinetic".into(),
            ExprNode::Potential => "Potential".into(),
            ExprNode::OfBodies(bodies, quantity) => {
                let place = |id: &BodyId| self.place(&self.0.bodies[*id].place);
                let names: Vec<String> = bodies.iter().flat_map(|list| list.iter()).map(place).collect();
                format!("{quantity:?}({})", names.join(", "))
            }
            ExprNode::Express { frame, vector } => {
                format!("Express({}, {})", self.frame(frame), self.expr(vector))
            }
            ExprNode::Derivative { of, by, .. } => format!("Derivative({}, {by:?})", self.expr(of)),
            ExprNode::Substituted { of, pairs } => {
                let pairs: Vec<String> = pairs.iter().map(|(by, e)| format!("{by:?} = {}", self.expr(e))).collect();
                format!("Substituted({}, {})", self.expr(of), pairs.join(", "))
            }
            ExprNode::Unknown(number) => format!("unknown {number}"),
            ExprNode::Solved { system, index, .. } => format!("Solved({}, {index})", self.list(system.iter())),
            ExprNode::OneOfTwo { form, coefficients, second } => {
                format!("OneOfTwo({form:?}, {}, {second})", self.list(coefficients.iter()))
            }
            ExprNode::Formula { formula, given } => {
                let given: Vec<String> =
                    given.iter().map(|given| format!("{:?} = {}", given.variables, self.expr(&given.value))).collect();
                format!("Formula({}, {})", formula.model.name, given.join(", "))
            }
            ExprNode::Residual { closing, component } => format!("Residual({closing:?}, {component:?})"),
            ExprNode::Closed(coordinate) => format!("Closed({coordinate:?})"),
            ExprNode::Undefined => "Undefined".into(),
            ExprNode::MassMatrix(entry) => format!("{entry:?}"),
            ExprNode::Bias(entry) => format!("{entry:?}"),
            ExprNode::Vec3(v) => format!("<{}>", self.list(v.iter())),
            ExprNode::Array(list) => self.list(list.iter()),
            ExprNode::Index(a, k) => format!("{}[{k}]", self.expr(a)),
            ExprNode::Component(a, k) => format!("{}.{}", self.expr(a), ["x", "y", "z"][*k]),
            ExprNode::Linear(a) => format!("Linear({})", self.expr(a)),
            ExprNode::Angular(a) => format!("Angular({})", self.expr(a)),
            ExprNode::Identity => "Identity".into(),
            ExprNode::RotationAbout { axis, angle } => format!("Rotation{}", self.list([axis, angle])),
            ExprNode::RollPitchYaw(angles) => format!("RollPitchYaw{}", self.list(angles)),
            ExprNode::Rotated(a, b) => format!("turned{}", self.list([a, b])),
            ExprNode::Compose(a, b) => two("o", a, b),
            ExprNode::Pose(p, r) => format!("Pose{}", self.list([p, r])),
            ExprNode::Neg(a) => format!("-{}", self.expr(a)),
            ExprNode::Add(a, b) => two("+", a, b),
            ExprNode::Sub(a, b) => two("-", a, b),
            ExprNode::Mul(a, b) => two("*", a, b),
            ExprNode::Div(a, b) => two("/", a, b),
            ExprNode::Call(f, list) => format!("{f:?}{}", self.list(list)),
            ExprNode::External(f, list) => format!("extern{}{}", f.0, self.list(list)),
            ExprNode::Compare(c, a, b) => two(&format!("{c:?}"), a, b),
            ExprNode::And(a, b) => two("&&", a, b),
            ExprNode::Or(a, b) => two("||", a, b),
            ExprNode::Not(a) => format!("!{}", self.expr(a)),
            ExprNode::Select(c, a, b) => format!("select{}", self.list([c, a, b])),
        }
    }

    /// The output called `name`.
    pub(crate) fn output(&self, name: &str) -> String {
        let mut outputs = self.0.outputs.iter();
        let output = outputs.find(|o| self.place(&o.place) == name);
        output.map_or_else(|| "none".into(), |o| self.expr(&o.value))
    }
}
