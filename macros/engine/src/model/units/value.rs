//! Stage `model`: what is known of an expression's unit.
//!
//! In: nothing. Out: the abstract values that `expressions` calculates with, and their products.

use std::rc::Rc;

use super::declared::Declared;
use super::dimension::Unit;
use super::quantities::Quantity;

#[derive(Clone, Debug)]
pub(in crate::model) enum Value {
    /// It fits everywhere.
    Any,
    /// A plain number in products, and fits everywhere else: PI, unit vectors.
    Number,
    Known(Known),
    /// One half times this: known where a square stands with it, see the rule in the documentation of the room.
    Halved(Known),
    /// There is an error in it.
    Wrong,
}

#[derive(Clone, Debug)]
pub(in crate::model) struct Known {
    pub(super) unit: Unit,
    /// Whether the user has declared a unit on the way to it.
    pub(super) declared: bool,
    pub(super) text: Text,
}

#[derive(Clone, Debug)]
pub(in crate::model) enum Text {
    Written(Rc<str>),
    OfLanguage(&'static str),
    /// It is calculated.
    None,
}

impl Known {
    /// How messages write it.
    pub(super) fn text(&self) -> String {
        match &self.text {
            Text::Written(text) => text.to_string(),
            Text::OfLanguage(text) => (*text).to_string(),
            Text::None => self.unit.text(),
        }
    }

    pub(super) fn is(&self, other: &Known) -> bool {
        self.unit.is(other.unit)
    }
}

impl From<&Declared> for Known {
    fn from(declared: &Declared) -> Known {
        Known { unit: declared.unit, declared: true, text: Text::Written(declared.text.clone()) }
    }
}

impl From<Quantity> for Known {
    fn from(quantity: Quantity) -> Known {
        Known { unit: quantity.unit, declared: false, text: Text::OfLanguage(quantity.text) }
    }
}

impl From<Quantity> for Value {
    fn from(quantity: Quantity) -> Value {
        Value::Known(quantity.into())
    }
}

impl Value {
    /// Product, or quotient.
    pub(super) fn combined(self, other: Value, combine: fn(Unit, Unit) -> Option<Unit>) -> Value {
        let halved = matches!(self, Value::Halved(_)) != matches!(other, Value::Halved(_));
        let (a, b) = match (self, other) {
            (Value::Wrong, _) | (_, Value::Wrong) => return Value::Wrong,
            (Value::Any, _) | (_, Value::Any) | (Value::Halved(_), Value::Halved(_)) => return Value::Any,
            (Value::Number, Value::Number) => return Value::Number,
            (Value::Number, b) => (None, b.known()),
            (a, Value::Number) => (a.known(), None),
            (a, b) => (a.known(), b.known()),
        };
        let of = |known: &Option<Known>| known.as_ref().map_or(Unit::ONE, |known| known.unit);
        let Some(unit) = combine(of(&a), of(&b)) else {
            return Value::Any;
        };
        let declared = [&a, &b].into_iter().flatten().any(|known| known.declared);
        // A factor that is a plain number changes no text.
        let text = match (a, b) {
            (Some(a), b) if unit.is(a.unit) && b.as_ref().is_none_or(|b| b.unit.is(Unit::ONE)) => a.text,
            (a, Some(b)) if unit.is(b.unit) && a.as_ref().is_none_or(|a| a.unit.is(Unit::ONE)) => b.text,
            _ => Text::None,
        };
        let known = Known { unit, declared, text };
        if halved { Value::Halved(known) } else { Value::Known(known) }
    }

    fn known(self) -> Option<Known> {
        match self {
            Value::Known(known) | Value::Halved(known) => Some(known),
            Value::Any | Value::Number | Value::Wrong => None,
        }
    }

    /// A power or root of it.
    pub(super) fn power(self, exponent: f64) -> Value {
        match self {
            Value::Known(known) => match known.unit.power(exponent) {
                Some(unit) => Value::Known(Known { unit, text: Text::None, ..known }),
                None => Value::Any,
            },
            Value::Halved(_) => Value::Any,
            Value::Any | Value::Number | Value::Wrong => self,
        }
    }
}
