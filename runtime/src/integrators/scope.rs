//! Which lanes of a scalar a decision is about: [`Scope`].
//!
//! Steps that all lanes share are decided by the worst of them; where each lane has steps of its own
//! ([`super::lanes`]), the same decisions are made for one lane at a time.

use crate::{Real, all, any};

/// All lanes of a scalar, or one of them.
#[derive(Clone, Copy)]
pub(super) struct Scope<T: Real> {
    mask: T::Mask,
}

impl<T: Real> Scope<T> {
    /// All lanes.
    #[inline]
    pub(super) fn whole() -> Self {
        let zero = T::lit(0.0);
        Self { mask: Real::le(zero, zero) }
    }

    /// One lane, counted from zero.
    #[inline]
    pub(super) fn lane(lane: usize) -> Self {
        let (mut one, zero) = (T::lit(0.0), T::lit(0.0));
        if lane < T::LANES {
            one.replace(lane, T::lit(1.0).extract(0));
        }
        Self { mask: Real::gt(one, zero) }
    }

    /// Whether a mask is true in a lane of the scope.
    #[inline]
    pub(super) fn any(&self, mask: T::Mask) -> bool {
        any(mask & self.mask)
    }

    /// Whether a mask is true in every lane of the scope.
    #[inline]
    pub(super) fn all(&self, mask: T::Mask) -> bool {
        all(mask | !self.mask)
    }

    /// The greatest lane of the scope, NaN if one of them is.
    #[inline]
    pub(super) fn greatest(&self, value: T) -> f64 {
        self.select(value, T::lit(f64::NEG_INFINITY)).greatest()
    }

    /// One value in the lanes of the scope, the other elsewhere.
    #[inline]
    pub(super) fn select(&self, inside: T, outside: T) -> T {
        Real::select(self.mask, inside, outside)
    }
}
