//! Stage `model`: tables of values.
//!
//! In: `table(x, XS, YS)`, `smooth_table(x, XS, YS)`. Out: the value of the piece that `x` lies in, a polynomial in its distance from the
//! piece's left end, whose coefficients are selected. The selections are a binary tree over the points, so they are few in a row,
//! and each coefficient is selected by itself: differentiation leaves them alone, so a derivative selects nothing that the value
//! hasn't selected. A point belongs to the piece on its right. Before the first point and behind the last the end's value holds.
//!
//! A smooth table has the slopes of F. N. Fritsch and J. Butland (SIAM J. Sci. Stat. Comput. 5, 1984, 300): cubic pieces that
//! have no extremum but at points. At the ends the parabola through three points gives the slope, bounded so that this holds there too.

use proc_macro2::{Ident, Span};
use syn::Expr;
use syn::spanned::Spanned;

use crate::model::checker::{Checker, Context};
use crate::model::typed::{Allowed, Typed, type_text};
use crate::model::types::{Comparison, ExprNode, Type};

use super::element_of;

/// More points are refused: each takes a comparison and three or five selections.
const MAX_POINTS: usize = 200;

/// What one piece adds to the value at its left end: coefficients of powers of the distance from there, the first power first.
type Piece = Vec<Typed>;

impl<'a> Checker<'a, '_> {
    pub(super) fn table(&mut self, name: &Ident, arguments: &[&Expr], at: Span, context: Context<'a>) -> Option<Typed> {
        self.arity(name, arguments, 3, at)?;
        let [x, points, values] = arguments else { return None };
        let is_smooth = name == "smooth_table";
        let x = self.expect(x, context, &Type::Scalar);
        let xs = self.column(points, context, Allowed::Constants);
        let ys = self.column(values, context, if is_smooth { Allowed::Constants } else { Allowed::Parameters });
        let (x, xs, ys) = (x?, xs?, ys?);
        if xs.len() != ys.len() {
            let message = format!("`{name}` has {} points and {} values", xs.len(), ys.len());
            self.report.error(values.span(), message);
            return None;
        }
        if !(2..=MAX_POINTS).contains(&xs.len()) {
            let message = format!("`{name}` has from 2 to {MAX_POINTS} points, found {}", xs.len());
            self.report.error(points.span(), message);
            return None;
        }
        let numbers: Option<Vec<f64>> = xs.iter().map(|x| self.evaluator.scalar(&x.expr)).collect();
        let numbers = numbers?;
        if let Some(k) = (1..numbers.len()).find(|&k| numbers[k - 1] >= numbers[k]) {
            let message = format!("points of a table increase, but {} stands behind {}", numbers[k], numbers[k - 1]);
            self.report.error(xs[k].expr.span, message);
            return None;
        }
        let pieces = if is_smooth {
            let heights: Option<Vec<f64>> = ys.iter().map(|y| self.evaluator.scalar(&y.expr)).collect();
            cubics(&numbers, &heights?, at)
        } else {
            self.lines(&xs, &ys, at)?
        };
        self.selected(&x, &xs, &ys, &pieces, at)
    }

    /// The scalars of an array.
    fn column(&mut self, expr: &Expr, context: Context<'a>, allowed: Allowed) -> Option<Vec<Typed>> {
        let array = self.value(expr, context)?;
        if let Some((span, message)) = array.uses.refusal(allowed) {
            self.report.error(span, message);
            return None;
        }
        let count = match &array.expr.ty {
            Type::Array(element, count) if **element == Type::Scalar => *count,
            other => {
                let message = format!("expected an array of scalars, found {}", type_text(other));
                self.report.help(expr.span(), message, "write `const XS: [Scalar; 3] = [0.0, 1.0, 2.0];`");
                return None;
            }
        };
        let element = |k| {
            let expr = element_of(&array.expr, k)?;
            Some(Typed { expr, uses: array.uses.clone(), depth: array.depth.saturating_add(1) })
        };
        (0..count).map(element).collect()
    }

    /// The slopes of straight pieces, exact where their ends are.
    fn lines(&mut self, xs: &[Typed], ys: &[Typed], at: Span) -> Option<Vec<Piece>> {
        let slope = |k: usize| {
            let run = self.of_two(ExprNode::Sub, &xs[k + 1], &xs[k], at)?;
            let rise = self.of_two(ExprNode::Sub, &ys[k + 1], &ys[k], at)?;
            Some(vec![self.of_two(ExprNode::Div, &rise, &run, at)?])
        };
        (0..xs.len() - 1).map(slope).collect()
    }

    fn of_two(
        &mut self,
        node: fn(crate::model::types::Expr, crate::model::types::Expr) -> ExprNode,
        a: &Typed,
        b: &Typed,
        at: Span,
    ) -> Option<Typed> {
        self.build(node(a.expr.clone(), b.expr.clone()), Type::Scalar, at, &[a, b])
    }

    fn selected(&mut self, x: &Typed, xs: &[Typed], ys: &[Typed], pieces: &[Piece], at: Span) -> Option<Typed> {
        let masks: Option<Vec<Typed>> = xs
            .iter()
            .map(|point| {
                let node = ExprNode::Compare(Comparison::Less, x.expr.clone(), point.expr.clone());
                self.build(node, Type::Bool, at, &[x, point])
            })
            .collect();
        let masks = masks?;
        // What holds before the first point, between two, and behind the last.
        let ends = |column: &[Typed]| -> Vec<Typed> { std::iter::once(&column[0]).chain(column).cloned().collect() };
        let start = self.choice(&masks, &ends(xs), at)?;
        let mut value = self.choice(&masks, &ends(ys), at)?;
        let zero = Typed::number(0.0, at);
        let way = self.of_two(ExprNode::Sub, x, &start, at)?;
        let way = self.within(x, xs, &masks, &way, at)?;
        let mut sum: Option<Typed> = None;
        for power in (0..pieces[0].len()).rev() {
            let inner = pieces.iter().map(|piece| piece[power].clone());
            let all: Vec<Typed> = std::iter::once(zero.clone()).chain(inner).chain([zero.clone()]).collect();
            let chosen = self.choice(&masks, &all, at)?;
            let factor = match sum {
                Some(sum) => self.of_two(ExprNode::Add, &chosen, &sum, at)?,
                None => chosen,
            };
            sum = Some(self.of_two(ExprNode::Mul, &factor, &way, at)?);
        }
        if let Some(sum) = sum {
            value = self.of_two(ExprNode::Add, &value, &sum, at)?;
        }
        Some(value)
    }

    /// The way from a piece's left end, and zero beyond the ends: no slope there would take an infinite one. What is not a number is
    /// beyond neither.
    fn within(&mut self, x: &Typed, xs: &[Typed], masks: &[Typed], way: &Typed, at: Span) -> Option<Typed> {
        let (Some(before), Some(last)) = (masks.first(), xs.last()) else { return Some(way.clone()) };
        let zero = Typed::number(0.0, at);
        let node = ExprNode::Compare(Comparison::Less, last.expr.clone(), x.expr.clone());
        let behind = self.build(node, Type::Bool, at, &[last, x])?;
        let node = ExprNode::Select(behind.expr.clone(), zero.expr.clone(), way.expr.clone());
        let way = self.build(node, Type::Scalar, at, &[&behind, &zero, way])?;
        let node = ExprNode::Select(before.expr.clone(), zero.expr.clone(), way.expr.clone());
        self.build(node, Type::Scalar, at, &[before, &zero, &way])
    }

    /// The one of `values` before whose mask `x` lies; the last if it lies before none.
    fn choice(&mut self, masks: &[Typed], values: &[Typed], at: Span) -> Option<Typed> {
        let cut = masks.len() / 2;
        let Some(middle) = masks.get(cut) else { return values.first().cloned() };
        let left = self.choice(&masks[..cut], &values[..=cut], at)?;
        let right = self.choice(&masks[cut + 1..], &values[cut + 1..], at)?;
        let node = ExprNode::Select(middle.expr.clone(), left.expr.clone(), right.expr.clone());
        self.build(node, Type::Scalar, at, &[middle, &left, &right])
    }
}

/// Cubic pieces from slopes at their ends.
fn cubics(xs: &[f64], ys: &[f64], at: Span) -> Vec<Piece> {
    let steps: Vec<f64> = xs.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let secants: Vec<f64> = ys.windows(2).zip(&steps).map(|(pair, step)| (pair[1] - pair[0]) / step).collect();
    let slopes = slopes(&steps, &secants);
    let piece = |k: usize| {
        let (step, secant, [first, second]) = (steps[k], secants[k], [slopes[k], slopes[k + 1]]);
        let square = (3.0 * secant - 2.0 * first - second) / step;
        let cube = (first + second - 2.0 * secant) / (step * step);
        [first, square, cube].map(|factor| Typed::number(factor, at)).into()
    };
    (0..steps.len()).map(piece).collect()
}

/// At all points.
fn slopes(steps: &[f64], secants: &[f64]) -> Vec<f64> {
    let count = secants.len();
    if count == 1 {
        return vec![secants[0]; 2];
    }
    let inner = (1..count).map(|k| {
        let ([before, after], [one, other]) = ([steps[k - 1], steps[k]], [secants[k - 1], secants[k]]);
        if one * other <= 0.0 {
            return 0.0;
        }
        let weights = [2.0 * after + before, after + 2.0 * before];
        (weights[0] + weights[1]) / (weights[0] / one + weights[1] / other)
    });
    let last = count - 1;
    let first = end([steps[0], steps[1]], [secants[0], secants[1]]);
    let end = end([steps[last], steps[last - 1]], [secants[last], secants[last - 1]]);
    std::iter::once(first).chain(inner).chain([end]).collect()
}

/// At an end: of the piece there, then of its neighbour.
fn end([step, next]: [f64; 2], [secant, other]: [f64; 2]) -> f64 {
    let slope = ((2.0 * step + next) * secant - step * other) / (step + next);
    if slope * secant <= 0.0 {
        0.0
    } else if secant * other <= 0.0 && slope.abs() > 3.0 * secant.abs() {
        3.0 * secant
    } else {
        slope
    }
}
