//! Stage `model`: units of what is asked of another model.
//!
//! In: the checker of the model that is asked, the expression in its terms, the variables that are given. Out: the unit of the
//! expression by that model's declarations, mistakes inside it, and the units that values of the variables must have.

use crate::invariant::index_vec::IndexVec;
use crate::model::checker::Checker;
use crate::model::types::{Constraint, ConstraintId, Expr, Variable};

use super::check::Units;
use super::value::{Known, Value};

/// The unit of a variable of another model.
#[derive(Clone, Debug)]
pub(in crate::model) struct Wanted {
    /// As messages name it.
    pub(super) name: String,
    pub(super) unit: Known,
}

impl Units {
    /// Of the model that is asked, which has no mistakes.
    pub(in crate::model) fn of_asked(
        checker: &Checker<'_, '_>,
        constraints: &IndexVec<ConstraintId, Constraint>,
    ) -> Units {
        let mut units = Units::new(checker);
        units.hold(constraints.iter().map(Some));
        units
    }

    /// The unit of what is asked for.
    pub(in crate::model) fn question(&mut self, of: &Expr) -> Value {
        match self.expressions.of(of) {
            Value::Halved(_) => Value::Any,
            value => value,
        }
    }

    /// The unit of what is given: all scalars of a parameter or an input have one.
    pub(in crate::model) fn wanted(&self, name: String, variables: &[Variable]) -> Option<Wanted> {
        match self.expressions.variable(*variables.first()?) {
            Value::Known(unit) => Some(Wanted { name, unit }),
            Value::Any | Value::Number | Value::Halved(_) | Value::Wrong => None,
        }
    }
}
