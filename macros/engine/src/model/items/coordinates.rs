//! Stage `model`: the choice of coordinates, body by body and for all of them.
//!
//! In: `coordinates: Joint`, `coordinates: Absolute(RollPitchYaw)`. Out: the choice, known from the syntax alone, since
//! joints that bodies imply are made before anything is checked.

use syn::Expr;
use syn::spanned::Spanned;

use crate::model::checker::Checker;
use crate::model::types::Orientation;
use crate::syntax::tree::{self, ItemKind};

use super::fields::field;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::model) enum Coordinates {
    /// Relative ones, of the joint that a body hangs on.
    Joint,
    /// Six on the ground.
    Absolute(Orientation),
}

const SEQUENCES: &str = "write `Absolute(RollPitchYaw)` or `Absolute(Quaternion)`";

impl Coordinates {
    /// What is written; nothing if it is a mistake.
    pub(in crate::model) fn read(expr: &Expr) -> Option<Coordinates> {
        match expr {
            Expr::Path(path) if path.path.is_ident("Joint") => Some(Coordinates::Joint),
            Expr::Call(call) if name(&call.func).as_deref() == Some("Absolute") && call.args.len() == 1 => {
                let sequence = name(call.args.first()?)?;
                Orientation::named(&sequence).map(Coordinates::Absolute)
            }
            _ => None,
        }
    }
}

/// What the `formulation` of a model says, which holds for all bodies; `None` if that can't be read.
pub(in crate::model) fn of_formulation(module: &tree::Module) -> Option<Option<Coordinates>> {
    let mut said = module.items.iter().filter_map(|item| match &item.kind {
        ItemKind::Formulation(fields) => Some(fields),
        _ => None,
    });
    match said.find_map(|fields| field(fields, "coordinates")) {
        Some(expr) => Coordinates::read(expr).map(Some),
        None => Some(None),
    }
}

fn name(expr: &Expr) -> Option<String> {
    match expr {
        Expr::Path(path) => path.path.get_ident().map(ToString::to_string),
        _ => None,
    }
}

impl Checker<'_, '_> {
    /// Reports what [`Coordinates::read`] can't read.
    pub(super) fn check_coordinates(&mut self, expr: &Expr) {
        if matches!(expr, Expr::Verbatim(_)) {
            return self.report.silent();
        }
        if Coordinates::read(expr).is_some() {
            return;
        }
        let called = match expr {
            Expr::Call(call) => name(&call.func),
            other => name(other),
        };
        let called = called.unwrap_or_default();
        let arguments = match expr {
            Expr::Call(call) if called == "Absolute" => call.args.first(),
            _ => None,
        };
        if let Some(sequence) = arguments {
            self.report.unknown(
                sequence.span(),
                "unknown kind of coordinates",
                &name(sequence).unwrap_or_default(),
                ["Quaternion", "RollPitchYaw"],
                Some(SEQUENCES.into()),
            );
        } else if called == "Absolute" {
            self.report.help(expr.span(), "`Absolute` needs its kind of angles", SEQUENCES);
        } else {
            self.report.unknown(
                expr.span(),
                "unknown kind of coordinates",
                &called,
                ["Joint", "Absolute"],
                Some("there are `Joint` and `Absolute(..)`".into()),
            );
        }
    }
}
