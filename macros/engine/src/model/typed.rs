//! Stage `model`: a typed expression together with what it depends on.
//!
//! In: nothing. Out: the values that `expressions` hands around, and the question where they may stand.

use std::rc::Rc;

use proc_macro2::Span;

use super::types::{Expr, ExprNode, Frame, Type};

/// What a value may depend on, from early to late.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    /// A function of the user's own Rust, whose values nobody knows before the model runs. It comes first, so that it is what is
    /// told of where nothing of the kind may stand.
    External,
    Parameter,
    /// Of bodies, which may follow from parameters.
    Mass,
    Time,
    /// What another model says: known where equations are derived, and not while the model is checked.
    Formula,
    Input,
    /// Coordinates, and where frames are.
    Position,
    /// States of the user's own.
    Own,
    /// Velocities, energies, and all that follows from them.
    State,
    /// What is made of finished equations: derivatives, entries of matrices.
    Finished,
    /// The potential energy, of which springs are a part.
    Potential,
    Acceleration,
    /// Efforts, reactions, power: known only when all forces are.
    Load,
}

const CLASSES: [Class; 13] = [
    Class::External,
    Class::Parameter,
    Class::Mass,
    Class::Time,
    Class::Formula,
    Class::Input,
    Class::Position,
    Class::Own,
    Class::State,
    Class::Finished,
    Class::Potential,
    Class::Acceleration,
    Class::Load,
];

/// The first name that brings a dependence in.
#[derive(Debug)]
pub(super) struct Culprit {
    name: String,
    /// The `let` through which it is seen.
    via: Option<String>,
    span: Span,
}

impl Culprit {
    /// Of a sentence about it.
    fn subject(&self) -> String {
        match &self.via {
            Some(via) => format!("`{via}` depends on `{}`, which", self.name),
            None => format!("`{}`", self.name),
        }
    }
}

/// Per class the first culprit.
#[derive(Clone, Debug, Default)]
pub(super) struct Uses([Option<Rc<Culprit>>; CLASSES.len()]);

impl Uses {
    pub(super) fn of(class: Class, name: impl Into<String>, span: Span) -> Uses {
        let mut uses = Uses::default();
        uses.add(class, name, span);
        uses
    }

    pub(super) fn add(&mut self, class: Class, name: impl Into<String>, span: Span) {
        self.0[class as usize].get_or_insert_with(|| Rc::new(Culprit { name: name.into(), via: None, span }));
    }

    pub(super) fn merge(&mut self, other: &Uses) {
        for (mine, theirs) in self.0.iter_mut().zip(&other.0) {
            if mine.is_none() {
                mine.clone_from(theirs);
            }
        }
    }

    /// The first name that brings a class in: its place, and the subject of a sentence about it.
    pub(super) fn culprit(&self, class: Class) -> Option<(Span, String)> {
        let culprit = self.0.get(class as usize)?.as_ref()?;
        Some((culprit.span, culprit.subject()))
    }

    /// The same dependences, seen at a use of the `let` called `name`.
    pub(super) fn through(&self, name: &str, span: Span) -> Uses {
        Uses(self.0.each_ref().map(|slot| {
            slot.as_ref()
                .map(|culprit| Rc::new(Culprit { name: culprit.name.clone(), via: Some(name.to_string()), span }))
        }))
    }

    /// Where a value with these dependences is refused: span and message.
    pub(super) fn refusal(&self, allowed: Allowed) -> Option<(Span, String)> {
        for (class, slot) in CLASSES.iter().zip(&self.0) {
            let Some(culprit) = slot else { continue };
            if allowed.contains(*class) {
                continue;
            }
            return Some((culprit.span, format!("{} {}", culprit.subject(), allowed.why(*class))));
        }
        None
    }
}

/// What the values of a field may depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Allowed {
    /// `const` and literals.
    Constants,
    /// Those and `param`.
    Parameters,
    /// Those and states of the user's own: what a body is.
    Inertia,
    /// Those and time: what a drive may follow.
    Time,
    /// Those and positions: what chooses a position.
    Positions,
    /// The same with velocities, held at zero.
    Constraint,
    /// The same for a velocity coordinate of the user's choice.
    Speed,
    /// All that is known before forces and accelerations are.
    Forces,
    /// Those, without the potential energy: a spring's is part of it.
    Springs,
}

impl Allowed {
    fn contains(self, class: Class) -> bool {
        match self {
            Allowed::Constants => false,
            Allowed::Parameters => class == Class::Parameter,
            Allowed::Inertia => matches!(class, Class::Parameter | Class::Own),
            Allowed::Time => matches!(class, Class::Parameter | Class::Mass | Class::Time | Class::Formula),
            Allowed::Positions => {
                matches!(class, Class::Parameter | Class::Mass | Class::Time | Class::Formula | Class::Position)
            }
            Allowed::Constraint => class == Class::Own || Allowed::Speed.contains(class),
            Allowed::Speed => class == Class::State || Allowed::Positions.contains(class),
            Allowed::Forces => !matches!(class, Class::Acceleration | Class::Load),
            Allowed::Springs => !matches!(class, Class::Potential | Class::Acceleration | Class::Load),
        }
    }

    fn why(self, class: Class) -> &'static str {
        match (self, class) {
            (_, Class::External) => {
                "is a function of Rust, whose values are not known while the model is checked; it may stand in forces, \
                 springs, dampers, states, outputs, and the `let` that they use"
            }
            (Allowed::Constants, Class::Parameter) => "is a `param`; only literals and `const` may stand here",
            (_, Class::Formula) => {
                "is a formula of another model; it may stand in drives, constraints, `solve`, `assume`, forces, states, outputs, and the \
                 `let` that they use"
            }
            (Allowed::Constants | Allowed::Parameters, Class::Mass) => {
                "is known when all bodies are; only literals, `const` and `param` may stand here"
            }
            (Allowed::Inertia, Class::Mass) => {
                "is known when all bodies are; only literals, `const`, `param` and `state` may stand here"
            }
            (Allowed::Inertia, Class::Input) => {
                "is an input, which may jump, and mass can't: declare a `state` with the rate at which it leaves or joins"
            }
            (Allowed::Inertia, Class::Time) => {
                "is the time; mass that leaves or joins is counted: declare a `state` with its rate"
            }
            (Allowed::Springs, Class::Potential) => "holds this spring's energy, so the spring can't follow from it",
            (Allowed::Forces | Allowed::Springs, Class::Acceleration) => {
                "is an acceleration, not known where forces and states are evaluated"
            }
            (Allowed::Forces | Allowed::Springs, Class::Load) => {
                "follows from the forces, so no force or state may use it"
            }
            (Allowed::Time, Class::Input) => {
                "is an input, whose rate nobody knows; a drive follows time and parameters"
            }
            (Allowed::Time, _) => "moves with the mechanism; a drive follows time and parameters",
            (_, Class::Finished) => {
                "is made of finished equations; it may stand in outputs, forces, states, and the `let` that they use"
            }
            (Allowed::Inertia, _) => {
                "moves with the mechanism, and how mass moves then is not known here; only `const`, `param` and `state` may stand here"
            }
            (Allowed::Positions, Class::Own) => {
                "is a state, whose rate may jump; only positions, parameters and time may stand here"
            }
            (Allowed::Speed, Class::Own) => {
                "is a state, whose rate may jump; only positions, velocities, parameters and time may stand here"
            }
            (Allowed::Constraint, Class::Input) => {
                "is an input, whose rate nobody knows; beside velocities a `state` that follows it may stand here"
            }
            (Allowed::Speed, Class::Input) => {
                "is an input, whose rate nobody knows; positions, velocities, parameters and time may stand here"
            }
            (Allowed::Constraint, _) => {
                "is no position and no velocity; only these, parameters, time and, beside velocities, states may stand here"
            }
            (Allowed::Speed, _) => "is no position and no velocity; only these, parameters and time may stand here",
            (Allowed::Positions, Class::Input) => "is an input; only positions, parameters and time may stand here",
            (Allowed::Positions, _) => "is no position; only positions, parameters and time may stand here",
            (Allowed::Constants, _) => "changes in time; only literals and `const` may stand here",
            _ => "changes in time; only `const` and `param` may stand here",
        }
    }
}

/// A checked expression on its way into the model.
#[derive(Clone)]
pub(super) struct Typed {
    pub(super) expr: Expr,
    pub(super) uses: Uses,
    /// Height of the tree.
    pub(super) depth: u16,
}

impl Typed {
    /// A leaf that depends on nothing.
    pub(super) fn leaf(node: ExprNode, ty: Type, span: Span) -> Typed {
        Typed { expr: new_expr(node, ty, span), uses: Uses::default(), depth: 1 }
    }

    pub(super) fn number(value: f64, span: Span) -> Typed {
        Typed::leaf(ExprNode::Number(value), Type::Scalar, span)
    }

    pub(super) fn vector(value: [f64; 3], span: Span) -> Typed {
        let node = ExprNode::Vec3(value.map(|x| number(x, span)));
        Typed { depth: 2, ..Typed::leaf(node, Type::Vec3, span) }
    }

    pub(super) fn with(mut self, uses: Uses) -> Typed {
        self.uses = uses;
        self
    }

    pub(super) fn at(mut self, span: Span) -> Typed {
        self.expr.span = span;
        self
    }
}

/// A frame on its way into the model.
#[derive(Clone)]
pub(super) struct FrameValue {
    pub(super) frame: Frame,
    /// Of the steps.
    pub(super) uses: Uses,
}

pub(super) fn new_expr(node: ExprNode, ty: Type, span: Span) -> Expr {
    Expr::new(node, ty, span)
}

pub(super) fn number(value: f64, span: Span) -> Expr {
    new_expr(ExprNode::Number(value), Type::Scalar, span)
}

/// Arrays larger than this are refused: no loop over a type can blow up.
pub(super) const MAX_SCALARS: usize = 10_000;

/// Number of scalars, if it is not too many.
pub(super) fn bounded_scalars(ty: &Type) -> Option<usize> {
    let count = match ty {
        Type::Vec3 => 3,
        Type::Array(element, count) => bounded_scalars(element)?.checked_mul(*count)?,
        _ => 1,
    };
    (count <= MAX_SCALARS).then_some(count)
}

/// How messages name a type, with its article.
pub(super) fn type_text(ty: &Type) -> String {
    match ty {
        Type::Scalar => "a scalar".into(),
        Type::Bool => "a condition".into(),
        Type::Array(..) => format!("`{}`", type_name(ty)),
        other => format!("a {}", type_name(other)),
    }
}

/// How the language writes a type.
pub(super) fn type_name(ty: &Type) -> String {
    match ty {
        Type::Scalar => "Scalar".into(),
        Type::Bool => "bool".into(),
        Type::Vec3 => "Vec3".into(),
        Type::Rotation => "Rotation".into(),
        Type::Pose => "Pose".into(),
        Type::Twist => "Twist".into(),
        Type::Wrench => "Wrench".into(),
        Type::Jacobian => "Jacobian".into(),
        Type::Array(element, count) => format!("[{}; {count}]", type_name(element)),
    }
}
