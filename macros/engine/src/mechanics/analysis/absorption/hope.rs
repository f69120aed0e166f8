//! Stage `mechanics`: where a coordinate would have to be for equations to be absorbed.
//!
//! In: a volume that depends on one column alone, or is a product of functions of two. Out: how far each may go from where it
//! stands by default until the volume is too small, or loops don't close.

use crate::mechanics::analysis::problem::Point;
use crate::mechanics::analysis::tape::Values;

use super::limb::Limb;

/// Steps either way, and how often the last one is halved.
const STEPS: usize = 24;
const HALVES: usize = 10;

/// How far travels are followed, in sizes of the mechanism.
const FAR: f64 = 4.0;

/// Where a coordinate stands, and what it must not go beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hope {
    pub at: f64,
    pub least: Option<f64>,
    pub most: Option<f64>,
    /// A length, no angle.
    pub travels: bool,
}

impl Hope {
    /// Both hold.
    pub(super) fn and(self, other: Hope) -> Hope {
        let of = |a: Option<f64>, b: Option<f64>, pick: fn(f64, f64) -> f64| match (a, b) {
            (Some(a), Some(b)) => Some(pick(a, b)),
            (a, b) => a.or(b),
        };
        Hope { least: of(self.least, other.least, f64::max), most: of(self.most, other.most, f64::min), ..self }
    }
}

impl Limb<'_> {
    /// Where the volume, a product of functions of these columns, keeps a share of what it is at a pose; nothing where that asks
    /// for no bound of one, or leaves it no way.
    pub(super) fn hopes(
        &self,
        columns: &[usize],
        first: &Point,
        share: f64,
        values: &mut Values,
    ) -> Option<Vec<(usize, Hope)>> {
        let size = self.volume(first, values).size();
        let own = share.powf(1.0 / columns.len() as f64);
        let mut hopes = Vec::new();
        for &column in columns {
            let at = self.value(first, column)?;
            let [down, up] = [-1.0, 1.0].map(|way| self.bound(columns, column, way, first, own * size, values));
            let (least, most) = (down?, up?);
            let hope = Hope { at, least, most, travels: self.travels(column) };
            let room = |bound: Option<f64>| bound.is_none_or(|bound| (bound - at).abs() > 1e-3);
            let bounded = least.is_some() || most.is_some();
            hopes.push((column, Some(hope).filter(|_| bounded && room(least) && room(most))?));
        }
        Some(hopes)
    }

    /// How far one may go one way, others held: `Some(None)` without an end; nothing where it has none to go.
    fn bound(
        &self,
        held: &[usize],
        column: usize,
        way: f64,
        first: &Point,
        size: f64,
        values: &mut Values,
    ) -> Option<Option<f64>> {
        let mut step = way * self.reach(column, FAR) / STEPS as f64;
        let mut pose = first.clone();
        let (mut steps, mut halves) = (0, 0);
        while steps < STEPS && halves < HALVES {
            let next = self.moved_along(held, column, step, &pose, values);
            let next = next.filter(|next| self.volume(next, values).is_beyond(size));
            // The way is measured out in whole steps, and then in ever smaller ones, each of which is taken or not.
            match (&next, halves) {
                (Some(_), 0) => steps += 1,
                _ => {
                    halves += 1;
                    step *= 0.5;
                }
            }
            pose = next.unwrap_or(pose);
        }
        if halves == 0 { Some(None) } else { self.value(&pose, column).map(Some) }
    }
}
