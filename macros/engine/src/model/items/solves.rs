//! Stage `model`: coordinates that are found from others.
//!
//! In: `solve (a, b) = (f, g);`, `solve (a, b) from closing { conditions }`, `solve (a, b) from (closing, closing) { conditions }`.
//! Out: the unknowns, and their formulas or what closes the loops. What another choice of coordinates has made void is said instead.

use proc_macro2::Span;
use syn::Expr;
use syn::spanned::Spanned;

use crate::model::checker::{Checker, Context, Meaning};
use crate::model::expressions::source_text;
use crate::model::topology::Topology;
use crate::model::typed::Allowed;
use crate::model::types::{Closing, Coordinate, Joints, LoopClosure, Solve, SolveHow, Type};
use crate::syntax::tree::Solution;

/// What a `solve` item gives.
pub(in crate::model) enum SolveItem {
    Item(Solve),
    /// The sentence for the report.
    Skipped(String),
}

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn solve(
        &mut self,
        unknowns: &[Expr],
        how: &Solution,
        keyword: Span,
        context: Context<'a>,
        joints: Option<(&Topology, &Joints)>,
    ) -> Option<SolveItem> {
        let uses = self.coordinate_uses.len();
        let found: Vec<Option<Vec<Coordinate>>> = unknowns
            .iter()
            .map(|expr| Some(self.several_coordinates(expr, context)?.into_iter().map(|(c, _)| c).collect()))
            .collect();
        let lists: Option<Vec<Vec<Coordinate>>> = found.into_iter().collect();
        let how = match how {
            Solution::Formulas(formulas) => self.formulas(formulas, lists.as_deref(), context),
            Solution::From { closings, branches } => self.by_closings(closings, branches, context),
        };
        let (lists, how) = (lists?, how?);
        for (expr, list) in unknowns.iter().zip(&lists) {
            if self.has_quaternion(list, &how) {
                self.report.help(
                    expr.span(),
                    format!("`{}` has a quaternion, for which there are no formulas", source_text(expr)),
                    "write `coordinates: RollPitchYaw` on it",
                );
                return None;
            }
        }
        let (topology, list) = joints?;
        if let Some(why) = self.void(unknowns, &lists, &how, (topology, list))? {
            // Its conditions may speak of coordinates that aren't there.
            self.coordinate_uses.truncate(uses);
            return Some(SolveItem::Skipped(why));
        }
        let mut all: Vec<Coordinate> = Vec::new();
        for (expr, coordinates) in unknowns.iter().zip(lists) {
            for coordinate in coordinates {
                if all.contains(&coordinate) {
                    let message = format!("{} is named twice", self.coordinate_name(coordinate));
                    self.report.error(expr.span(), message);
                    return None;
                }
                all.push(coordinate);
            }
        }
        Some(SolveItem::Item(Solve { unknowns: all, how, span: keyword }))
    }

    /// Whether coordinates have no formulas: where they are written, those of a joint with a quaternion; of closed forms, those
    /// that turn it.
    fn has_quaternion(&self, coordinates: &[Coordinate], how: &SolveHow) -> bool {
        coordinates.iter().any(|coordinate| {
            let kind = self.joints[coordinate.joint].kind.filter(|kind| kind.has_quaternion());
            kind.is_some_and(|kind| matches!(how, SolveHow::Formulas(_)) || kind.turning().contains(&coordinate.index))
        })
    }

    /// One scalar for each coordinate.
    fn formulas(
        &mut self,
        formulas: &[Expr],
        lists: Option<&[Vec<Coordinate>]>,
        context: Context<'a>,
    ) -> Option<SolveHow> {
        let values: Vec<_> = formulas
            .iter()
            .map(|expr| self.scalar(expr, context, Allowed::Positions).map(|value| value.expr))
            .collect();
        let lists = lists?;
        let count: usize = lists.iter().map(Vec::len).sum();
        if values.len() != count {
            let plural = |n: usize| if n == 1 { "" } else { "s" };
            let message = format!(
                "{count} unknown coordinate{} but {} formula{}",
                plural(count),
                values.len(),
                plural(values.len())
            );
            // At the first one too many, or at the last there is.
            let at = formulas.get(count.min(formulas.len() - 1)).map_or_else(Span::call_site, Spanned::span);
            self.report.help(at, message, "write one formula for each coordinate, in the order of the unknowns");
            return None;
        }
        values.into_iter().collect::<Option<_>>().map(SolveHow::Formulas)
    }

    fn by_closings(&mut self, named: &[Expr], branches: &[Expr], context: Context<'a>) -> Option<SolveHow> {
        let mut closings: Vec<Closing> = Vec::new();
        for expr in named {
            let what = match self.meaning(expr, context) {
                Some(Meaning::Joint(id)) => LoopClosure::Cut(id),
                Some(Meaning::Constraint(id)) => LoopClosure::Constraint(id),
                Some(_) => {
                    self.report.help(
                        expr.span(),
                        "expected what closes the loop",
                        "write the name of a joint that closes a loop, or of a constraint",
                    );
                    continue;
                }
                None => continue,
            };
            if closings.iter().any(|closing| closing.what == what) {
                self.report.error(expr.span(), format!("`{}` is named twice", source_text(expr)));
            }
            closings.push(Closing { what, span: expr.span() });
        }
        let branches: Vec<_> = branches
            .iter()
            .map(|expr| self.typed(expr, context, &Type::Bool, Allowed::Positions).map(|condition| condition.expr))
            .collect();
        let branches = branches.into_iter().collect::<Option<_>>()?;
        (closings.len() == named.len()).then_some(SolveHow::From { closings, branches })
    }

    /// Why the item means nothing with these coordinates; an error where nobody has changed them.
    fn void(
        &mut self,
        unknowns: &[Expr],
        lists: &[Vec<Coordinate>],
        how: &SolveHow,
        (topology, joints): (&Topology, &Joints),
    ) -> Option<Option<String>> {
        let changed = self.coordinates.is_some();
        let names: Vec<String> = lists.iter().flatten().map(|coordinate| self.coordinate_name(*coordinate)).collect();
        let subject = format!("`solve` of {}", names.join(", "));
        let closings: &[Closing] = if let SolveHow::From { closings, .. } = how { closings } else { &[] };
        for closing in closings {
            let LoopClosure::Cut(id) = closing.what else { continue };
            if topology.is_cut(id) {
                continue;
            }
            let joint = &joints[id];
            if changed {
                let name = self.path_text(&joint.place);
                return Some(Some(format!("{subject}: with these coordinates the joint `{name}` lies in the tree")));
            }
            let message = format!("the joint `{}` closes no loop", joint.place.field);
            self.report.help(
                closing.span,
                message,
                "name a joint that closes the loop; `#[cut]` on a joint makes it one",
            );
            return None;
        }
        for (expr, list) in unknowns.iter().zip(lists) {
            let cut = list.iter().find(|coordinate| topology.is_cut(coordinate.joint));
            let Some(&Coordinate { joint: id, .. }) = cut else { continue };
            let joint = &joints[id];
            if changed {
                let name = self.path_text(&joint.place);
                let why = format!("{subject}: with these coordinates the joint `{name}` closes a loop and has none");
                return Some(Some(why));
            }
            self.refuse_cut_coordinate(id, expr.span(), joints);
            return None;
        }
        Some(None)
    }
}
