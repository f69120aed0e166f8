//! Stage `model`: the unit that an item declares.
//!
//! In: its name and documentation. Out: its unit with the text it is written in.

use std::rc::Rc;

use crate::model::types::Docs;

use super::dimension::Unit;
use super::parse::parse;

#[derive(Clone, Debug)]
pub(in crate::model) struct Declared {
    pub(in crate::model) name: String,
    /// Between the brackets.
    pub(in crate::model) text: Rc<str>,
    pub(super) unit: Unit,
    /// What the value declares itself: that of `G` in `const A = G;`.
    pub(super) beneath: Option<Rc<Declared>>,
}

/// `None`: there are no brackets, or they hold no known unit, or the text goes on with another: `[N m] or [N]`.
pub(in crate::model) fn declared(name: &str, docs: &Docs) -> Option<Declared> {
    let text = docs.unit.as_deref()?;
    let unit = parse(text)?;
    let others = docs.text.iter().flat_map(|line| line.split('[').skip(1)).filter_map(|rest| rest.split_once(']'));
    let alone = !others.filter_map(|(other, _)| parse(other)).any(|other| !other.is(unit));
    alone.then(|| Declared { name: name.to_string(), text: Rc::from(text), unit, beneath: None })
}

impl Declared {
    /// Of a value that declares a unit itself.
    pub(in crate::model) fn over(self, beneath: Option<Rc<Declared>>) -> Declared {
        Declared { beneath, ..self }
    }
}
