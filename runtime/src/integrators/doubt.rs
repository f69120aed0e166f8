//! Whether it is clear which motion goes on from the end of a step: see [`System::ambiguity`].

use super::problem::Problem;
use super::scope::Scope;
use super::slope::{finite, magnitude};
use crate::projection::TURNED;
use crate::tangent::greatest;
use crate::{Real, StateSpace, System, Tangent};

/// The end of a step where motions cross.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Doubt {
    /// None cross near it, or what is not finite is reported as such.
    None,
    /// It is so near that rounding would decide, but the motion came there as it would go on: a step of given length that is
    /// long beside what is unclear leads on from here.
    Here,
    /// The motion has been turned, or may have been led to another one.
    Turned,
}

impl Doubt {
    /// Of the end of a step, and of `next`, which the system has made of it.
    pub(super) fn at<S: System>(
        problem: &Problem<'_, S>,
        t: S::Scalar,
        end: &S::State,
        next: &S::State,
        scope: &Scope<S::Scalar>,
    ) -> Self {
        let one = S::Scalar::lit(1.0);
        let ambiguity = problem.ambiguity(t, next);
        if !scope.any(Real::ge(ambiguity, one)) || !scope.all(finite(&magnitude(end))) {
            return Self::None;
        }
        let ((_, before, _), (_, after, _)) = (end.split(), next.split());
        let change = greatest(&after.add_scaled(-one, &before));
        let turned = !Real::le(change, S::Scalar::lit(TURNED) * greatest(&before)) | !Real::is_finite(ambiguity);
        if scope.any(Real::ge(ambiguity, one) & turned) { Self::Turned } else { Self::Here }
    }

    /// Whether steps of one length can't go on from here, where the one before ended in `last`: steps that are short beside
    /// what is unclear would follow what rounding has made of it.
    pub(super) fn stops(self, last: Self) -> bool {
        self == Self::Turned || self == Self::Here && last != Self::None
    }
}
