//! Stage `model`: assumptions that are made for the user to see what they bring.
//!
//! In: where a coordinate may be. Out: the same as the user would write it, and the model with it.

use std::f64::consts::FRAC_PI_2;

use super::types::{Comparison, Coordinate, Expr, ExprNode, Function, Model, Order, Type};

/// Where a coordinate is assumed to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Assumed {
    Above(f64),
    Below(f64),
    Between(f64, f64),
    /// The cosine of an angle.
    CosineAbove(f64),
    SineAbove(f64),
    SineBelow(f64),
}

/// Angles that differ by less are the same to a reader.
const SAME: f64 = 0.05;

impl Assumed {
    /// Between two angles, by a sine or cosine where these say it.
    pub fn angle(from: f64, to: f64) -> Assumed {
        let centre = 0.5 * (from + to);
        let (far, short) = (0.5 * (to - from), 0.5 * (to - from) <= FRAC_PI_2);
        let is_about = |angle: f64| (centre - angle).abs() < SAME;
        match () {
            () if short && is_about(0.0) => Assumed::CosineAbove(tidied(far.cos(), 1.0)),
            () if short && is_about(FRAC_PI_2) => Assumed::SineAbove(tidied(far.cos(), 1.0)),
            () if short && is_about(-FRAC_PI_2) => Assumed::SineBelow(tidied(-far.cos(), -1.0)),
            () => Assumed::Between(tidied(from, to), tidied(to, from)),
        }
    }

    /// As it stands behind `assume`.
    pub fn text(&self, name: &str) -> String {
        match *self {
            Assumed::Above(least) => format!("{name} > {least:?}"),
            Assumed::Below(most) => format!("{name} < {most:?}"),
            Assumed::Between(least, most) => format!("{name} > {least:?} && {name} < {most:?}"),
            Assumed::CosineAbove(least) => format!("cos({name}) > {least:?}"),
            Assumed::SineAbove(least) => format!("sin({name}) > {least:?}"),
            Assumed::SineBelow(most) => format!("sin({name}) < {most:?}"),
        }
    }

    fn condition(&self, of: Expr) -> Expr {
        let span = of.span;
        let number = |value: f64| Expr::new(ExprNode::Number(value), Type::Scalar, span);
        let call = |function: Function| Expr::new(ExprNode::Call(function, vec![of.clone()]), Type::Scalar, span);
        let compare = |value: Expr, comparison: Comparison, bound: f64| {
            Expr::new(ExprNode::Compare(comparison, value, number(bound)), Type::Bool, span)
        };
        let (above, below) = (Comparison::Greater, Comparison::Less);
        match *self {
            Assumed::Above(least) => compare(of, above, least),
            Assumed::Below(most) => compare(of, below, most),
            Assumed::Between(least, most) => {
                let both = ExprNode::And(compare(of.clone(), above, least), compare(of.clone(), below, most));
                Expr::new(both, Type::Bool, span)
            }
            Assumed::CosineAbove(least) => compare(call(Function::Cos), above, least),
            Assumed::SineAbove(least) => compare(call(Function::Sin), above, least),
            Assumed::SineBelow(most) => compare(call(Function::Sin), below, most),
        }
    }
}

impl Model {
    /// The same with something assumed of coordinates.
    pub fn assuming(&self, all: &[(Coordinate, Assumed)]) -> Model {
        let mut model = self.clone();
        for (coordinate, assumed) in all {
            let Coordinate { joint, index } = *coordinate;
            let node = ExprNode::Coordinate { joint, index, order: Order::Position };
            let value = Expr::new(node, Type::Scalar, model.joints[joint].span);
            model.assumptions.push(assumed.condition(value));
        }
        model
    }
}

/// A bound with few digits, a little nearer to what is inside.
pub fn tidied(bound: f64, inside: f64) -> f64 {
    let way = inside - bound;
    let unit = 10_f64.powf((0.05 * way.abs()).log10().floor());
    let steps = bound / unit;
    let steps = if way > 0.0 { steps.ceil() } else { steps.floor() };
    // A decimal is written with the digits that it has, not as a multiple of a rounded unit.
    let digits = (-unit.log10()).round();
    if digits > 0.0 { steps / 10_f64.powf(digits) } else { steps * unit }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_have_few_digits() {
        assert_eq!(tidied(-0.7437, 1.5), -0.7);
        assert_eq!(tidied(0.123_456, 0.3), 0.124);
        assert_eq!(tidied(2.345, 0.0), 2.3);
        assert_eq!(tidied(0.001_234, 0.002), 0.001_24);
        assert_eq!(tidied(1234.0, 2000.0), 1240.0);
    }

    #[test]
    fn angles_are_said_by_sines() {
        assert_eq!(Assumed::angle(-1.4, 1.4).text("a"), "cos(a) > 0.17");
        assert_eq!(Assumed::angle(0.1, 3.0).text("a"), "sin(a) > 0.13");
        assert_eq!(Assumed::angle(-3.0, -0.1).text("a"), "sin(a) < -0.13");
        assert_eq!(Assumed::angle(0.5, 2.0).text("a"), "a > 0.5 && a < 2.0");
    }
}
