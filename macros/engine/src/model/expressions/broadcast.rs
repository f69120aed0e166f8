//! Stage `model`: names that stand for several things.
//!
//! In: `[a, b]`, `legs.stroke` where `legs` is an array of parts. Out: what each of them means.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr, Member};

use crate::model::checker::{Checker, Context, Meaning};
use crate::model::joint_kinds::JointKind;
use crate::model::types::{Coordinate, JointId};

use super::source_text;

/// More than this many are a mistake.
const MOST: usize = 10_000;

impl<'a> Checker<'a, '_> {
    /// All that an expression names: elements of a list, and of an array of parts the same item of each.
    pub(in crate::model) fn several_meanings(&mut self, expr: &Expr, context: Context<'a>) -> Option<Vec<Meaning>> {
        let list: Vec<Meaning> = match expr {
            Expr::Paren(inner) => self.several_meanings(&inner.expr, context)?,
            Expr::Array(array) => {
                let lists: Vec<_> = array.elems.iter().map(|e| self.several_meanings(e, context)).collect();
                lists.into_iter().collect::<Option<Vec<_>>>()?.into_iter().flatten().collect()
            }
            Expr::Field(field) if matches!(field.member, Member::Named(_)) => {
                let bases = self.several_meanings(&field.base, context)?;
                let members: Vec<_> = bases.into_iter().map(|base| self.member_of(base, field)).collect();
                members.into_iter().collect::<Option<_>>()?
            }
            _ => vec![self.meaning(expr, context)?],
        };
        let mut found = Vec::with_capacity(list.len());
        for meaning in list {
            match meaning {
                Meaning::Parts(scopes) => found.extend(scopes.iter().map(|scope| Meaning::Part(*scope))),
                other => found.push(other),
            }
        }
        if found.len() > MOST {
            self.report.error(expr.span(), format!("these are more than {MOST}"));
            return None;
        }
        Some(found)
    }

    /// The coordinates that an expression names, each with where that is; whole joints give all of theirs.
    pub(in crate::model) fn several_coordinates(
        &mut self,
        expr: &Expr,
        context: Context<'a>,
    ) -> Option<Vec<(Coordinate, Span)>> {
        if let Expr::Array(array) = expr {
            let lists: Vec<_> = array.elems.iter().map(|e| self.several_coordinates(e, context)).collect();
            return Some(lists.into_iter().collect::<Option<Vec<_>>>()?.into_iter().flatten().collect());
        }
        let mut found = Vec::new();
        for meaning in self.several_meanings(expr, context)? {
            match meaning {
                Meaning::Joint(joint) => {
                    let kind = self.joint_kind(joint)?;
                    if kind.freedoms() == 0 {
                        let message = format!("`{}` is a fixed joint, which has no coordinate", source_text(expr));
                        self.report.error(expr.span(), message);
                        return None;
                    }
                    found.extend(all(joint, kind));
                }
                Meaning::Coordinate(joint, index) => found.push(Coordinate { joint, index }),
                Meaning::Frame(frame) if self.absolute(&frame).is_some() => {
                    let joint = self.absolute(&frame)?;
                    let kind = self.joint_kind(joint)?;
                    found.extend(all(joint, kind));
                }
                _ => {
                    self.report.help(
                        expr.span(),
                        "expected a coordinate",
                        "write a joint's name, or one coordinate such as `gimbal.first`",
                    );
                    return None;
                }
            }
        }
        Some(found.into_iter().map(|coordinate| (coordinate, expr.span())).collect())
    }
}

/// All velocity coordinates of a joint.
fn all(joint: JointId, kind: &JointKind) -> impl Iterator<Item = Coordinate> {
    (0..kind.freedoms()).map(move |index| Coordinate { joint, index })
}
