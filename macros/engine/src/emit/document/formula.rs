//! Stage `emit`: the user's expressions as text for documentation.
//!
//! In: checked expressions. Out: a line close to what the user wrote; what is long or of no interest is `..`.

use crate::emit::layout::Layout;
use crate::emit::print::literals;
use crate::model::types::{
    BodyId, BodyRef, Comparison, Coordinate, Expr, ExprNode, Frame, FrameQuantity, Order, Selection, SystemQuantity,
};

/// As many nodes are written.
const MOST: usize = 60;

/// How tightly text binds, loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Or,
    And,
    Compare,
    Sum,
    Product,
    Unary,
}

/// The expression as text.
pub(in crate::emit) fn text(layout: &Layout<'_>, expr: &Expr) -> String {
    Writer { layout, left: MOST }.write(expr, Level::Or)
}

struct Writer<'a> {
    layout: &'a Layout<'a>,
    /// Nodes that may still be written: shared expressions are trees here, and may be large.
    left: usize,
}

impl Writer<'_> {
    fn write(&mut self, expr: &Expr, least: Level) -> String {
        let Some(left) = self.left.checked_sub(1) else {
            return "..".to_string();
        };
        self.left = left;
        let (text, binds) = self.node(&expr.node);
        if binds < least { format!("({text})") } else { text }
    }

    fn node(&mut self, node: &ExprNode) -> (String, Level) {
        let layout = self.layout;
        let model = layout.model;
        let text = match node {
            ExprNode::Number(value) => literals::text(*value),
            ExprNode::Pi => "PI".to_string(),
            ExprNode::Time => "t".to_string(),
            ExprNode::Param(id) => layout.name(&model.params[*id].place),
            ExprNode::Input(id) => layout.name(&model.inputs[*id].place),
            ExprNode::State(id) => layout.name(&model.states[*id].place),
            ExprNode::Coordinate { joint, index, order } => {
                let order = match order {
                    Order::Position => "",
                    Order::Rate => ".rate",
                    Order::Acceleration => ".accel",
                };
                format!("{}{order}", layout.coordinate(Coordinate { joint: *joint, index: *index }))
            }
            ExprNode::OfFrame(frame, quantity) => format!("{}.{}", self.frame(frame), quantity_name(*quantity)),
            ExprNode::OfBodies(bodies, quantity) => self.of_bodies(bodies, *quantity),
            ExprNode::Vec3(list) => format!("[{}]", self.list(list)),
            ExprNode::Array(list) => format!("[{}]", self.list(list)),
            ExprNode::Index(array, index) => format!("{}[{index}]", self.write(array, Level::Unary)),
            ExprNode::Component(vector, axis) => {
                let axis = ["x", "y", "z"][*axis];
                format!("{}.{axis}", self.write(vector, Level::Unary))
            }
            ExprNode::Call(function, list) => {
                format!("{}({})", format!("{function:?}").to_lowercase(), self.list(list))
            }
            ExprNode::External(function, list) => {
                format!("{}({})", model.externals[*function].name, self.list(list))
            }
            ExprNode::Select(condition, a, b) => {
                let list = [condition, a, b].map(|expr| self.write(expr, Level::Or));
                format!("select({})", list.join(", "))
            }
            ExprNode::Identity => "identity()".to_string(),
            ExprNode::RotationAbout { axis, angle } => {
                let list = [axis, angle].map(|expr| self.write(expr, Level::Or));
                format!("rotation({})", list.join(", "))
            }
            ExprNode::RollPitchYaw(list) => format!("roll_pitch_yaw({})", self.list(list)),
            ExprNode::Pose(position, orientation) => {
                let list = [position, orientation].map(|expr| self.write(expr, Level::Or));
                format!("pose({})", list.join(", "))
            }
            ExprNode::Compose(a, b) | ExprNode::Rotated(a, b) => {
                return self.pair(a, "*", b, Level::Product, Level::Unary);
            }
            ExprNode::Neg(a) => return (format!("-{}", self.write(a, Level::Product)), Level::Product),
            ExprNode::Not(a) => return (format!("!{}", self.write(a, Level::Unary)), Level::Unary),
            ExprNode::Add(a, b) => return self.pair(a, "+", b, Level::Sum, Level::Product),
            ExprNode::Sub(a, b) => return self.pair(a, "-", b, Level::Sum, Level::Product),
            ExprNode::Mul(a, b) => return self.pair(a, "*", b, Level::Product, Level::Unary),
            ExprNode::Div(a, b) => return self.pair(a, "/", b, Level::Product, Level::Unary),
            ExprNode::Compare(comparison, a, b) => {
                return self.pair(a, comparison_name(*comparison), b, Level::Compare, Level::Sum);
            }
            ExprNode::And(a, b) => return self.pair(a, "&&", b, Level::And, Level::Compare),
            ExprNode::Or(a, b) => return self.pair(a, "||", b, Level::Or, Level::And),
            _ => "..".to_string(),
        };
        (text, Level::Unary)
    }

    fn pair(&mut self, a: &Expr, operator: &str, b: &Expr, binds: Level, right: Level) -> (String, Level) {
        let left = if binds == Level::Compare { right } else { binds };
        let (a, b) = (self.write(a, left), self.write(b, right));
        (format!("{a} {operator} {b}"), binds)
    }

    fn list(&mut self, list: &[Expr]) -> String {
        let list: Vec<String> = list.iter().map(|expr| self.write(expr, Level::Or)).collect();
        list.join(", ")
    }

    /// Several bodies as one, as the language writes it.
    fn of_bodies(&self, bodies: &Selection, quantity: SystemQuantity) -> String {
        let place = |id: &BodyId| self.layout.name(&self.layout.model.bodies[*id].place);
        let list = bodies.as_ref().map(|list| format!("[{}]", list.iter().map(place).collect::<Vec<_>>().join(", ")));
        let (name, member) = match quantity {
            SystemQuantity::TotalMass => ("total_mass", ""),
            SystemQuantity::CentreOfMass => ("centre_of_mass", ""),
            SystemQuantity::CentreOfMassVelocity => ("centre_of_mass", ".velocity"),
            SystemQuantity::CentreOfMassAcceleration => ("centre_of_mass", ".acceleration"),
            SystemQuantity::LinearMomentum => ("linear_momentum", ""),
            SystemQuantity::AngularMomentum => ("angular_momentum", ""),
        };
        format!("{name}({}){member}", list.unwrap_or_default())
    }

    /// A body, or a point of it.
    fn frame(&self, frame: &Frame) -> String {
        let name = match frame.body {
            BodyRef::Ground => "ground".to_string(),
            BodyRef::Body(body) => {
                let body = self.layout.model.bodies.get(body.0);
                body.map_or_else(|| "..".to_string(), |body| self.layout.name(&body.place))
            }
        };
        if frame.steps.is_empty() { name } else { format!("{name}.at(..)") }
    }
}

fn quantity_name(quantity: FrameQuantity) -> &'static str {
    match quantity {
        FrameQuantity::Position => "position",
        FrameQuantity::Rotation => "rotation",
        FrameQuantity::Pose => "pose",
        FrameQuantity::Velocity => "velocity",
        FrameQuantity::AngularVelocity => "angular_velocity",
        FrameQuantity::Twist => "twist",
        FrameQuantity::Acceleration => "acceleration",
        FrameQuantity::AngularAcceleration => "angular_acceleration",
    }
}

fn comparison_name(comparison: Comparison) -> &'static str {
    match comparison {
        Comparison::Less => "<",
        Comparison::LessEqual => "<=",
        Comparison::Greater => ">",
        Comparison::GreaterEqual => ">=",
        Comparison::Equal => "==",
        Comparison::NotEqual => "!=",
    }
}
