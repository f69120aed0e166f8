//! Whether the constraints tell which motion goes on.
//!
//! Where constraints come to depend on each other, as in a parallelogram that lies flat, motions cross: the one that a
//! mechanism is in goes on smoothly, and the other one turns off. Of a residual `c` that is left there, however small, the
//! crossing becomes two branches of a hyperbola that avoid each other, and a run that follows them turns off sharply,
//! where the mechanism goes straight on. A step that leads over the pose does what the mechanism does; one that ends so
//! near to it that rounding decides about the branch does not.
//!
//! The measure needs no unit and no derivative: the displacement that makes up for a residual of rounding grows like the
//! inverse of the distance from the pose, and turns where that distance is no longer large beside it. So the displacement
//! is asked for twice, at the position and displaced by it; what it changes by, as a share of itself, is the share of
//! that distance that rounding is.

use super::{Mask, closeness, greatest, ones};
use crate::{Configuration, Constrained, DisplacementOf, PositionOf, Real, StateSpace, Tangent, any};

/// The residual of rounding, as a share of the least tolerance of a projection.
const ROUNDING: f64 = 0.25;
/// A displacement of this many roots of the rounding unit is measured; below it no pose is near.
const NOTICED: f64 = 0.1;
/// The change that leaves no doubt, inverted.
const DOUBT: f64 = 16.0;
/// A second correction of a projection is at most this share of the first, as far as it isn't rounding: Newton's method
/// has started near its solution, and that is the one of the branch.
const CONTRACTION: f64 = 0.25;
/// What a projection may change velocities by, as a share of them, where motions cross: more, and it has turned them.
pub(crate) const TURNED: f64 = 0.125;

/// How unclear it is at a position which motion goes on, in each lane: zero far from a pose in which constraints come to
/// depend on each other and motions cross, and one where what is left of the residual, or rounding, decides about it.
///
/// It is what generated models with constraints, and projections of them, say of themselves as [`System::ambiguity`](crate::System::ambiguity).
pub fn ambiguity<S: Constrained>(system: &S, t: S::Scalar, state: &S::State) -> S::Scalar {
    let zero = S::Scalar::lit(0.0);
    if !system.tells_crossings() {
        return zero;
    }
    let (q, v, x) = state.split();
    let open = greatest(&system.constraints(t, &q));
    let residual = Real::max(open, S::Scalar::lit(ROUNDING) * closeness::<S>(0.0, &q));
    let first = probe(system, t, state, residual);
    let size = greatest(&first);
    let is_near = !Real::le(size, noticed::<S>(&q)); // what isn't a number is no better
    if !any(is_near) {
        return zero;
    }
    let other = probe(system, t, &state.join(q.displace(&first), v, x), residual);
    let change = greatest(&other.add_scaled(S::Scalar::lit(-1.0), &first));
    Real::select(is_near, S::Scalar::lit(DOUBT) * change / size, zero)
}

/// Whether the corrections of a position, the first and the second, leave the branch open.
pub(super) fn is_unclear<S: Constrained>(
    system: &S,
    t: S::Scalar,
    state: &S::State,
    [first, second]: [S::Scalar; 2],
) -> Mask<S> {
    let (q, _, _) = state.split();
    let doubtful = Real::gt(first, noticed::<S>(&q)) & Real::gt(second, S::Scalar::lit(CONTRACTION) * first);
    if !any(doubtful) || !system.tells_crossings() {
        return doubtful & !doubtful;
    }
    let rounding = greatest(&probe(system, t, state, closeness::<S>(0.0, &q)));
    doubtful & Real::gt(second, rounding)
}

/// The displacement from which on another correction is worth its cost.
pub(super) fn noticed<S: Constrained>(q: &PositionOf<S>) -> S::Scalar {
    let one = S::Scalar::lit(1.0);
    S::Scalar::lit(NOTICED) * Real::sqrt(S::Scalar::epsilon()) * (one + greatest(&q.magnitude()))
}

/// The displacement for a residual of this size, in no direction that a mechanism is likely to be built in.
fn probe<S: Constrained>(system: &S, t: S::Scalar, state: &S::State, size: S::Scalar) -> DisplacementOf<S> {
    // Steps of the golden section around a circle, between a half and one and of either sign.
    let (half, one) = (S::Scalar::lit(0.5), S::Scalar::lit(1.0));
    let mut turn = S::Scalar::lit(0.3);
    let residual = S::Residual::zero().map(&mut |_| {
        turn += S::Scalar::lit(0.618_034);
        turn = Real::select(Real::ge(turn, one), turn - one, turn);
        size * Real::select(Real::lt(turn, half), turn + half, -turn)
    });
    system.correction(t, state, &residual, &ones()).0
}
