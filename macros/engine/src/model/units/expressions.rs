//! Stage `model`: units of expressions.
//!
//! In: typed expressions, and what parameters, inputs and states declare. Out: what is known of their units, each node
//! once; mistakes inside them. Nothing here recurses over the height of an expression.

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use proc_macro2::Span;

use crate::invariant::fault::OrFault;
use crate::model::joint_kinds::JointKind;
use crate::model::types::{
    Coordinate, Expr, ExprNode, Frame, FrameQuantity, FrameStep, Function, JointId, LoopClosure, Order, Variable,
};

use super::declared::Declared;
use super::dimension::{Unit, number};
use super::quantities::{self as quantity, OfCoordinate, Quantity};
use super::squares;
use super::table::DEGREE;
use super::value::{Known, Text, Value};

/// One mistake.
pub(super) struct Mistake {
    pub(super) span: Span,
    pub(super) message: String,
    pub(super) help: Option<String>,
}

/// What a constraint holds.
pub(super) enum Held {
    /// The half square of a length.
    Rod,
    Value(Expr, Option<Declared>),
}

#[derive(Default)]
pub(super) struct Expressions {
    pub(super) params: Vec<Option<Declared>>,
    pub(super) inputs: Vec<Option<Declared>>,
    pub(super) states: Vec<Option<Declared>>,
    pub(super) joints: Vec<Option<&'static JointKind>>,
    /// By constraint.
    pub(super) held: Vec<Option<Held>>,
    pub(super) mistakes: Vec<Mistake>,
    /// Units of names whose values have others: told once.
    pub(super) refused: HashSet<*const Declared>,
    /// By node, which is kept so that no other takes its address.
    pub(super) known: HashMap<*const ExprNode, (Rc<ExprNode>, Value)>,
}

impl Expressions {
    pub(super) fn mistake(&mut self, span: Span, message: String, help: Option<String>) {
        self.mistakes.push(Mistake { span, message, help });
    }

    /// The unit of an expression.
    pub(super) fn of(&mut self, expr: &Expr) -> Value {
        match &expr.unit {
            Some(declared) => self.of_name(declared),
            None => self.of_node(expr),
        }
    }

    fn of_name(&self, declared: &Rc<Declared>) -> Value {
        if self.refused.contains(&Rc::as_ptr(declared)) { Value::Wrong } else { Value::Known((&**declared).into()) }
    }

    /// The unit of an expression that declares one, by what it is made of.
    pub(super) fn beneath(&mut self, expr: &Expr) -> Value {
        match expr.unit.as_ref().and_then(|declared| declared.beneath.as_ref()) {
            Some(beneath) => self.of_name(beneath),
            None => self.of_node(expr),
        }
    }

    fn of_node(&mut self, expr: &Expr) -> Value {
        let mut waiting: Vec<(&Expr, bool)> = vec![(expr, false)];
        while let Some((next, entered)) = waiting.pop() {
            if self.known.contains_key(&Rc::as_ptr(&next.node)) {
                continue;
            }
            if !entered {
                waiting.push((next, true));
                // In reverse, so that mistakes come in the order of the text.
                let operands = next.node.operands().into_iter().rev();
                waiting.extend(operands.filter(|operand| operand.unit.is_none()).map(|operand| (operand, false)));
                continue;
            }
            let value = self.calculated(next);
            let value = self.settled(value, next);
            self.known.insert(Rc::as_ptr(&next.node), (next.node.clone(), value));
        }
        self.found_node(expr)
    }

    /// The unit of an operand, which has been found before.
    fn found(&self, expr: &Expr) -> Value {
        match &expr.unit {
            Some(declared) => self.of_name(declared),
            None => self.found_node(expr),
        }
    }

    fn found_node(&self, expr: &Expr) -> Value {
        let (_, value) =
            self.known.get(&Rc::as_ptr(&expr.node)).or_fault("operands are looked at before what uses them");
        value.clone()
    }

    /// What is one half of something in a product is known once the product has its square.
    fn settled(&self, value: Value, expr: &Expr) -> Value {
        match value {
            Value::Halved(known) if self.is_quadratic(expr) => Value::Known(known),
            other => other,
        }
    }

    /// Whether a product holds a square, and besides it something of a declared unit.
    fn is_quadratic(&self, expr: &Expr) -> bool {
        squares::beside(expr).into_iter().any(|factor| match self.found(factor) {
            Value::Known(known) => known.declared && !known.unit.dimension.is_none(),
            Value::Any | Value::Number | Value::Halved(_) | Value::Wrong => false,
        })
    }

    fn calculated(&mut self, expr: &Expr) -> Value {
        match &*expr.node {
            ExprNode::Number(_) | ExprNode::Identity => Value::Any,
            ExprNode::Pi => Value::Number,
            ExprNode::Time => quantity::TIME.into(),
            ExprNode::Param(id) => of_item(&self.params, id.0),
            ExprNode::Input(id) => of_item(&self.inputs, id.0),
            ExprNode::State(id) => of_item(&self.states, id.0),
            ExprNode::Coordinate { joint, index, order } => self.coordinate(*joint, *index, |of| of.order(*order)),
            ExprNode::Effort { joint, index } => self.coordinate(*joint, *index, |of| of.effort),
            ExprNode::RelativeAngularVelocity(_) => quantity::ANGULAR_VELOCITY.into(),
            ExprNode::OfFrame(frame, what) => {
                self.frame(frame);
                quantity::of_frame(*what).map_or(Value::Any, Value::from)
            }
            ExprNode::Jacobian { frame, axes } => {
                self.frame(frame);
                self.frame(axes);
                Value::Any
            }
            ExprNode::Reaction { axes, .. } => {
                self.frame(axes);
                Value::Any
            }
            ExprNode::Multiplier(_) => Value::Any,
            ExprNode::Power(_) => quantity::POWER.into(),
            ExprNode::Kinetic | ExprNode::Potential => quantity::ENERGY.into(),
            ExprNode::OfBodies(_, what) => quantity::of_system(*what).into(),
            ExprNode::Express { frame, vector } => {
                self.frame(frame);
                self.found(vector)
            }
            ExprNode::Derivative { of, by, .. } => self.found(of).combined(self.variable(*by), Unit::over),
            ExprNode::Substituted { of, pairs } => {
                for (variable, value) in pairs {
                    self.put(*variable, value);
                }
                self.found(of)
            }
            ExprNode::MassMatrix([row, column]) => {
                let acceleration = self.coordinate(column.joint, column.index, |of| of.order(Order::Acceleration));
                self.coordinate(row.joint, row.index, |of| of.effort).combined(acceleration, Unit::over)
            }
            ExprNode::Residual { closing, component } => self.residual(*closing, component.as_deref()),
            &ExprNode::Closed(Coordinate { joint, index }) => {
                self.coordinate(joint, index, |of| of.order(Order::Position))
            }
            ExprNode::Bias(row) => self.coordinate(row.joint, row.index, |of| of.effort),
            ExprNode::Formula { formula, given } => {
                let model = &formula.model.name;
                for given in given {
                    if let Some(wanted) = &given.wanted {
                        self.gives(&format!("`{}` of `{model}`", wanted.name), &given.value, &wanted.unit);
                    }
                }
                formula.unit.clone()
            }
            // The unknown takes the unit that fits; its equations are looked at as operands.
            ExprNode::Unknown(_) | ExprNode::Solved { .. } | ExprNode::OneOfTwo { .. } | ExprNode::Undefined => {
                Value::Any
            }
            ExprNode::Vec3(elements) if is_unit_vector(elements) => Value::Number,
            ExprNode::Vec3(elements) => self.elements(elements),
            ExprNode::Array(elements) => self.elements(elements),
            ExprNode::Index(inner, _) | ExprNode::Component(inner, _) | ExprNode::Neg(inner) => self.found(inner),
            ExprNode::Linear(of) => halves(of).map_or(Value::Any, |(linear, _)| linear.into()),
            ExprNode::Angular(of) => halves(of).map_or(Value::Any, |(_, angular)| angular.into()),
            ExprNode::Add(a, b) | ExprNode::Sub(a, b) => self.one_unit(a, b, "a sum"),
            ExprNode::RotationAbout { angle, .. } => self.angles([angle]),
            ExprNode::RollPitchYaw(angles) => self.angles(angles),
            ExprNode::Compose(..) => Value::Any,
            ExprNode::Rotated(rotation, vector) => {
                self.of(rotation);
                self.found(vector)
            }
            ExprNode::Pose(position, _) => {
                self.expect(position, quantity::LENGTH);
                Value::Any
            }
            ExprNode::Mul(a, b) => self.factor(a, 0.5).combined(self.factor(b, 0.5), Unit::times),
            ExprNode::Div(a, b) => self.factor(a, 0.5).combined(self.factor(b, 2.0), Unit::over),
            ExprNode::Call(function, arguments) => self.call(*function, arguments),
            // Of any units; what comes back has the one that is declared with the function.
            ExprNode::External(..) => Value::Any,
            ExprNode::Compare(_, a, b) => {
                self.one_unit(a, b, "a comparison");
                Value::Any
            }
            ExprNode::And(..) | ExprNode::Or(..) | ExprNode::Not(_) => Value::Any,
            ExprNode::Select(_, a, b) => self.one_unit(a, b, "`select`"),
        }
    }

    /// Of what values are differentiated by.
    pub(super) fn variable(&self, variable: Variable) -> Value {
        match variable {
            Variable::Time => quantity::TIME.into(),
            Variable::Coordinate(coordinate, order) => {
                self.coordinate(coordinate.joint, coordinate.index, |of| of.order(order))
            }
            Variable::State(id) => of_item(&self.states, id.0),
            Variable::Param(id, _) => of_item(&self.params, id.0),
            Variable::Input(id, _) => of_item(&self.inputs, id.0),
        }
    }

    /// What is put in the place of a variable.
    fn put(&mut self, variable: Variable, value: &Expr) {
        if let Value::Known(wanted) = self.variable(variable) {
            self.gives("the variable", value, &wanted);
        }
    }

    fn gives(&mut self, variable: &str, value: &Expr, wanted: &Known) {
        if let Some((span, what, found)) = self.misfit(value, wanted) {
            let message = format!("{variable} is in {}, {what} is in {}", wanted.text(), found.text());
            self.mistake(span, message, conversion(&found, wanted, &what));
        }
    }

    /// What an equation leaves. Those of joints are lengths and cosines of angles, the latter called `turn..`.
    fn residual(&mut self, closing: LoopClosure, component: Option<&str>) -> Value {
        match (closing, component) {
            (LoopClosure::Cut(_), Some(name)) if name.starts_with("turn") => quantity::NUMBER.into(),
            (LoopClosure::Cut(_), _) => quantity::LENGTH.into(),
            (LoopClosure::Constraint(id), _) => match self.held.get(id.0).and_then(Option::as_ref) {
                Some(Held::Rod) => Value::from(quantity::LENGTH).power(2.0),
                Some(Held::Value(_, Some(declared))) => Value::Known(declared.into()),
                Some(Held::Value(value, None)) => {
                    let value = value.clone();
                    self.of(&value)
                }
                None => Value::Any,
            },
        }
    }

    /// What belongs to a coordinate.
    fn coordinate(&self, joint: JointId, index: usize, what: impl Fn(&OfCoordinate) -> Quantity) -> Value {
        let kind = self.joints.get(joint.0).copied().flatten();
        kind.map_or(Value::Any, |kind| what(OfCoordinate::of(kind, index)).into())
    }

    fn call(&mut self, function: Function, arguments: &[Expr]) -> Value {
        let pair = arguments.first().zip(arguments.get(1));
        let Some(first) = arguments.first() else {
            return Value::Any;
        };
        match function {
            Function::Sin => self.plain(first, "sin", quantity::NUMBER),
            Function::Cos => self.plain(first, "cos", quantity::NUMBER),
            Function::Tan => self.plain(first, "tan", quantity::NUMBER),
            Function::Asin => self.plain(first, "asin", quantity::ANGLE),
            Function::Acos => self.plain(first, "acos", quantity::ANGLE),
            Function::Atan => self.plain(first, "atan", quantity::ANGLE),
            Function::Sinh => self.plain(first, "sinh", quantity::NUMBER),
            Function::Cosh => self.plain(first, "cosh", quantity::NUMBER),
            Function::Tanh => self.plain(first, "tanh", quantity::NUMBER),
            Function::Exp => self.plain(first, "exp", quantity::NUMBER),
            Function::Ln => self.plain(first, "ln", quantity::NUMBER),
            Function::Sqrt => self.found(first).power(0.5),
            Function::Abs | Function::Norm => self.found(first),
            Function::Signum => quantity::NUMBER.into(),
            Function::Min => pair.map_or(Value::Any, |(a, b)| self.one_unit(a, b, "`min`")),
            Function::Max => pair.map_or(Value::Any, |(a, b)| self.one_unit(a, b, "`max`")),
            Function::Hypot => pair.map_or(Value::Any, |(a, b)| self.one_unit(a, b, "`hypot`")),
            Function::Atan2 => {
                let both = pair.map(|(a, b)| self.one_unit(a, b, "`atan2`"));
                if let Some(Value::Wrong) = both { Value::Wrong } else { quantity::ANGLE.into() }
            }
            Function::Powi | Function::Powf => pair.map_or(Value::Any, |(base, exponent)| self.power(base, exponent)),
            Function::Deg => self.degrees(first),
            Function::Dot | Function::Cross => {
                let product = |(a, b)| self.found(a).combined(self.found(b), Unit::times);
                pair.map_or(Value::Any, product)
            }
        }
    }

    fn power(&mut self, base: &Expr, exponent: &Expr) -> Value {
        let value = self.found(base);
        match (&*exponent.node, &exponent.unit) {
            (ExprNode::Number(power), None) => value.power(*power),
            _ => match value {
                Value::Known(known) if !known.unit.is(Unit::ONE) => Value::Any,
                other => other,
            },
        }
    }

    /// The argument of a function that takes plain numbers; what it gives.
    fn plain(&mut self, argument: &Expr, name: &str, gives: Quantity) -> Value {
        match self.found(argument) {
            Value::Wrong => return Value::Wrong,
            Value::Known(known) if known.declared && !known.unit.is(Unit::ONE) => {
                let angle = matches!(name, "sin" | "cos" | "tan");
                let takes = if angle { "an angle in rad" } else { "a plain number" };
                let (what, text) = (self.name(argument, "this"), known.text());
                let help = (angle && known.unit.is(DEGREE)).then(|| in_radians(&what));
                self.mistake(argument.span, format!("`{name}` takes {takes}, {what} is in {text}"), help);
                return Value::Wrong;
            }
            Value::Any | Value::Number | Value::Known(_) | Value::Halved(_) => {}
        }
        gives.into()
    }

    /// Degrees to radians.
    fn degrees(&mut self, argument: &Expr) -> Value {
        match self.found(argument) {
            Value::Wrong => return Value::Wrong,
            Value::Known(known) if known.declared => {
                let plain = known.unit.is(Unit::ONE) && known.text() != "rad";
                if !plain && !known.unit.is(DEGREE) {
                    let message =
                        format!("`deg` takes degrees, {} is in {}", self.name(argument, "this"), known.text());
                    self.mistake(argument.span, message, None);
                    return Value::Wrong;
                }
                return Value::Known(Known { declared: true, ..quantity::ANGLE.into() });
            }
            Value::Any | Value::Number | Value::Known(_) | Value::Halved(_) => {}
        }
        quantity::ANGLE.into()
    }

    fn angles<'e>(&mut self, angles: impl IntoIterator<Item = &'e Expr>) -> Value {
        for angle in angles {
            self.expect(angle, quantity::ANGLE);
        }
        Value::Any
    }

    /// As a factor one half is no literal of any unit, nor is two as a divisor.
    fn factor(&self, expr: &Expr, half: f64) -> Value {
        match &*expr.node {
            ExprNode::Number(x) if expr.unit.is_none() && x.abs() == half => {
                Value::Halved(Known { declared: false, ..quantity::NUMBER.into() })
            }
            _ => self.found(expr),
        }
    }

    /// Two values that need one unit; it is the one that is known.
    fn one_unit(&mut self, a: &Expr, b: &Expr, needs: &str) -> Value {
        match (self.found(a), self.found(b)) {
            (Value::Wrong, _) | (_, Value::Wrong) => Value::Wrong,
            (Value::Known(left), Value::Known(right)) => {
                if left.is(&right) {
                    return Value::Known(if right.declared && !left.declared { right } else { left });
                }
                if !left.declared && !right.declared {
                    return Value::Any;
                }
                let (first, second) = (self.name(a, "the left side"), self.name(b, "the right side"));
                let [first, second] = match needs.starts_with('`') {
                    true => [self.name(a, "the first value"), self.name(b, "the second")],
                    false => [first, second],
                };
                let message =
                    format!("{first} is in {}, {second} in {}: {needs} needs one unit", left.text(), right.text());
                self.mistake(b.span, message, conversion(&right, &left, ""));
                Value::Wrong
            }
            (Value::Known(known), _) | (_, Value::Known(known)) => Value::Known(known),
            (Value::Number, Value::Number) => Value::Number,
            _ => Value::Any,
        }
    }

    /// Of vectors and arrays as they are written; literals take the unit of the others.
    fn elements(&mut self, elements: &[Expr]) -> Value {
        let mut one: Option<Known> = None;
        for element in elements {
            let literal = element.unit.is_none() && matches!(&*element.node, ExprNode::Number(_) | ExprNode::Pi);
            match self.found(element) {
                Value::Wrong => return Value::Wrong,
                Value::Known(known) => match &mut one {
                    Some(first) if !first.is(&known) => return Value::Any,
                    Some(first) => first.declared |= known.declared,
                    None => one = Some(known),
                },
                _ if literal => {}
                Value::Any | Value::Number | Value::Halved(_) => return Value::Any,
            }
        }
        one.map_or(Value::Any, Value::Known)
    }

    /// A value where a quantity of the language belongs: a unit that the user has declared is that one.
    pub(super) fn expect(&mut self, expr: &Expr, wanted: Quantity) {
        let Some((span, what, found)) = self.misfit(expr, &wanted.into()) else {
            return;
        };
        let message = format!("{} is in {}, {what} is in {}", wanted.what, wanted.text, found.text());
        self.mistake(span, message, conversion(&found, &wanted.into(), &what));
    }

    /// The first element of an expression that is known not to be in a unit.
    pub(super) fn misfit(&mut self, expr: &Expr, wanted: &Known) -> Option<(Span, String, Known)> {
        let value = self.of(expr);
        self.misfit_of(expr, value, wanted)
    }

    /// The same of an expression that declares a unit itself, by what it is made of.
    pub(super) fn misfit_beneath(&mut self, expr: &Expr, wanted: &Known) -> Option<(Span, String, Known)> {
        let value = self.beneath(expr);
        self.misfit_of(expr, value, wanted)
    }

    fn misfit_of(&mut self, expr: &Expr, value: Value, wanted: &Known) -> Option<(Span, String, Known)> {
        let elements = match &*expr.node {
            ExprNode::Vec3(elements) => elements.as_slice(),
            ExprNode::Array(elements) => elements.as_slice(),
            _ => &[],
        };
        if let Some(found) = elements.iter().find_map(|element| self.misfit(element, wanted)) {
            return Some(found);
        }
        match value {
            Value::Known(known) if !known.is(wanted) && (known.declared || wanted.declared) => {
                Some((expr.span, self.name(expr, "this"), known))
            }
            _ => None,
        }
    }

    /// What a frame's steps are made of.
    pub(super) fn frame(&mut self, frame: &Frame) {
        for step in &frame.steps {
            match step {
                FrameStep::At(offset) => self.expect(offset, quantity::LENGTH),
                FrameStep::Rotated(axis, angle) => {
                    self.of(axis);
                    self.expect(angle, quantity::ANGLE);
                }
                FrameStep::Oriented(rows) => {
                    for entry in rows.iter().flatten() {
                        self.expect(entry, quantity::NUMBER);
                    }
                }
            }
        }
    }

    /// How messages name an expression.
    fn name(&self, expr: &Expr, otherwise: &str) -> String {
        let of = |items: &[Option<Declared>], index: usize| items.get(index)?.as_ref().map(|item| item.name.clone());
        let name = match (&expr.unit, &*expr.node) {
            (Some(declared), _) => Some(declared.name.clone()),
            (None, ExprNode::Param(id)) => of(&self.params, id.0),
            (None, ExprNode::Input(id)) => of(&self.inputs, id.0),
            (None, ExprNode::State(id)) => of(&self.states, id.0),
            _ => None,
        };
        name.map_or_else(|| otherwise.to_string(), |name| format!("`{name}`"))
    }
}

fn of_item(items: &[Option<Declared>], index: usize) -> Value {
    items.get(index).and_then(Option::as_ref).map_or(Value::Any, |declared| Value::Known(declared.into()))
}

/// Linear and angular part of a twist or wrench of the language itself; of what is made of one nothing is known.
fn halves(of: &Expr) -> Option<(Quantity, Quantity)> {
    match &*of.node {
        ExprNode::OfFrame(_, FrameQuantity::Twist) => Some((quantity::VELOCITY, quantity::ANGULAR_VELOCITY)),
        ExprNode::Reaction { .. } => Some((quantity::FORCE, quantity::TORQUE)),
        _ => None,
    }
}

/// One of `X`, `Y`, `Z` or its opposite.
fn is_unit_vector(elements: &[Expr; 3]) -> bool {
    let size = |element: &Expr| match &*element.node {
        ExprNode::Number(x) if element.unit.is_none() => x.abs(),
        _ => f64::NAN,
    };
    let mut sizes = elements.each_ref().map(size);
    sizes.sort_by(f64::total_cmp);
    sizes == [0.0, 0.0, 1.0]
}

/// How what differs by a factor alone becomes the other.
pub(super) fn conversion(from: &Known, to: &Known, name: &str) -> Option<String> {
    if from.unit.dimension != to.unit.dimension {
        return None;
    }
    if from.unit.is(DEGREE) && to.unit.is(Unit::ONE) {
        return Some(in_radians(name));
    }
    let checked = "units are checked, not converted";
    if let Text::None = from.text {
        return Some(checked.to_string());
    }
    let factor = number(from.unit.scale / to.unit.scale);
    Some(format!("one {} is {factor} {}: {checked}", from.text(), to.text()))
}

fn in_radians(name: &str) -> String {
    let name = name.trim_matches('`');
    format!("write `deg({})`", if name.is_empty() || name == "this" { ".." } else { name })
}
