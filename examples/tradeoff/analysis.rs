//! What the points say: hulls, orders, floors, and the cost of an accuracy.

use crate::bench::{Bench, Point, Series, Steps};

/// The accuracies that are asked for.
pub(crate) const TARGETS: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// What a point costs.
pub(crate) type Cost = fn(&Point) -> f64;

/// Evaluations of the equations of motion.
pub(crate) const EVALUATIONS: Cost = |point| point.evaluations;
/// Time per simulated second.
pub(crate) const TIME: Cost = |point| point.seconds;

/// A curve and what it says.
pub(crate) struct Curve<'a> {
    pub(crate) series: Series,
    pub(crate) points: Vec<&'a Point>,
    /// Observed order, where there is enough of a slope.
    pub(crate) order: Option<f64>,
    /// The least error reached.
    pub(crate) floor: f64,
}

/// All curves of a scene, in the order in which they were run.
pub(crate) fn curves(bench: &Bench) -> Vec<Curve<'_>> {
    let mut all: Vec<Curve<'_>> = Vec::new();
    for point in &bench.points {
        match all.last_mut() {
            Some(curve) if curve.series == point.series => curve.points.push(point),
            _ => all.push(Curve { series: point.series, points: vec![point], order: None, floor: 0.0 }),
        }
    }
    for curve in &mut all {
        curve.floor = curve.points.iter().map(|point| point.own).fold(f64::INFINITY, f64::min);
        curve.order = order(curve);
    }
    all
}

/// An order is reported if the work differs by at least that factor.
const WORK: f64 = 1.5;

/// The slope of errors over the number of steps (over evaluations, where steps were chosen by error), both as logarithms,
/// by least squares over the finest points above the floor.
fn order(curve: &Curve<'_>) -> Option<f64> {
    let rounding = if curve.series.scalar == "f32" { 1e-6 } else { 2e-14 };
    let low = (20.0 * curve.floor).max(50.0 * rounding);
    let high = if curve.series.order > 2 { 1e-4 } else { 1e-2 };
    // Steps of one length follow their order once they are short; the shortest of them are taken.
    let usable = curve.points.iter().filter(|point| point.bound < high && point.bound > low);
    let fixed = curve.series.steps == Steps::Fixed;
    let work = |point: &Point| if fixed { -point.setting.ln() } else { point.evaluations.ln() };
    let mut list: Vec<(f64, f64)> = usable.map(|point| (work(point), point.bound.ln())).collect();
    if fixed {
        list.drain(..list.len().saturating_sub(5));
    }
    if list.len() < 3 {
        return None;
    }
    // Where steps are bound by stability, errors fall at no cost, which is no order.
    let range = list.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), point| (a.min(point.0), b.max(point.0)));
    if range.1 - range.0 < WORK.ln() {
        return None;
    }
    let count = list.len() as f64;
    let (x, y) = list.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / count, y + point.1 / count));
    let (mut xx, mut xy) = (0.0, 0.0);
    for point in &list {
        xx += (point.0 - x) * (point.0 - x);
        xy += (point.0 - x) * (point.1 - y);
    }
    Some(-xy / xx)
}

impl Curve<'_> {
    /// What an accuracy costs: of the point from which on the error stays within, or between it and the one before.
    pub(crate) fn cost(&self, target: f64, cost: Cost) -> Option<f64> {
        let first = self.points.iter().position(|point| point.bound <= target)?;
        let here = self.points[first];
        let Some(before) = first.checked_sub(1).map(|k| self.points[k]).filter(|before| before.bound.is_finite())
        else {
            return Some(cost(here));
        };
        let share = (before.bound / target).ln() / (before.bound / here.bound).ln();
        let between = cost(before).ln() + share.clamp(0.0, 1.0) * (cost(here) / cost(before)).ln();
        Some(between.exp().min(cost(here)))
    }
}

/// The points that nothing beats: no other has less error at no more cost. From cheap to accurate.
pub(crate) fn hull<'a>(points: impl IntoIterator<Item = &'a Point>, cost: Cost) -> Vec<&'a Point> {
    let mut list: Vec<&Point> = points.into_iter().filter(|point| point.bound.is_finite()).collect();
    list.sort_by(|a, b| cost(a).total_cmp(&cost(b)).then(a.bound.total_cmp(&b.bound)));
    let mut best = f64::INFINITY;
    list.retain(|point| {
        let better = point.bound < best;
        best = best.min(point.bound);
        better
    });
    list
}

/// The cheapest curve at an accuracy, with what it costs.
pub(crate) fn best<'a, 'b>(
    curves: impl IntoIterator<Item = &'a Curve<'b>>,
    target: f64,
    cost: Cost,
) -> Option<(&'a Curve<'b>, f64)>
where
    'b: 'a,
{
    let costs = curves.into_iter().filter_map(|curve| Some((curve, curve.cost(target, cost)?)));
    costs.min_by(|a, b| a.1.total_cmp(&b.1))
}
