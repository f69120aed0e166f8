//! What integrators ask of closed loops: are they closed, and does a dead centre lie within a step?
//!
//! In a dead centre two solutions of a loop meet. With time its root goes through zero at a steady rate `-a`, and the
//! mechanism goes on with the other solution; but the coordinates of a reduced model are functions of the root's square
//! `u`, so they turn back as if they were reflected. No energy tells: a motion that has come back is one of the same
//! equations. What tells is the root. Its square `u = a^2 s^2` at the distance `s` in time falls at the rate
//! `u' = -2 a^2 s`, so `u / |u'|` is half of the time that is left (all of it where the mechanism locks up, and `u` falls
//! like `s`). A step that is shorter has not come there, and its stages have not come near enough to lose their order. So
//! **`2 |u'| dt < u` at both ends of every step**: at its start nothing may lie ahead within twice its length, at its end
//! nothing behind. It holds for a step of any length that a method accepts, costs a few operations, and is true too for a near miss
//! that the step resolves. A root that changes sign (the determinant of what Newton's method solves), that is zero or NaN
//! has been passed.
//!
//! Steps chosen by error are cut to a little less, so they come nearer in a geometric sequence, and their error is judged
//! in the root too ([`Outlook::spread`]): near a dead centre coordinates stand still, and an error far below their
//! tolerance is a different motion. Where rounding alone is more than that, the dead centre is reached.

use super::error::IntegrationError;
use super::problem::Problem;
use super::scope::Scope;
use super::slope::{Slope, SlopeOf, displaced, is_finite, magnitude};
use crate::tangent::greatest;
use crate::{Configuration, Margin, Open, Real, StateSpace, System, Tangent, all, any};

/// No dead centre may lie within so many lengths of a step. With one, methods of first order creep up to it and never arrive.
const LENGTHS: f64 = 2.0;
/// Steps chosen by error are at most this share of `u / |u'|`.
const SHARE: f64 = 0.4;
/// From this share of their longest on, their error is judged in the root.
const NEAR: f64 = 0.05;
/// So many roundings of the coordinates count as an error too: what they do to the root no step makes good.
const ROUNDINGS: f64 = 4.0;
/// Where a step of this share is still too long for it, what is left is rounding.
const ROUNDING: f64 = 1e-3;
/// A state that is no longer finite is blamed on a dead centre within so many steps.
const BLAMED: f64 = 8.0;

/// So many roots of a system are told apart; a model has fewer, since it has at most 200 coordinates. Of further ones two
/// changes of sign at once can go unseen, where one can't.
const ROOTS: usize = 256;
/// So many roots are held to be compared.
const HELD: usize = 16;
/// Coordinates up to this one have their rounding judged by the tolerance..
const TURN: f64 = core::f64::consts::TAU;
/// ..and what the rounding of greater ones changes a root's square by may be this share of it.
const ROUNDED: f64 = 1e-2;

/// The signs of roots, in the order in which they are given.
#[derive(Clone, Copy, Default, PartialEq)]
pub(super) struct Signs {
    /// Which are negative, and which positive, in any lane; of roots that share a place, whether an odd number is.
    bits: [[u64; 2]; ROOTS / 64],
    count: usize,
}

impl Signs {
    #[inline]
    fn push<T: Real>(&mut self, root: T, scope: &Scope<T>) {
        let zero = T::lit(0.0);
        if let Some([negative, positive]) = self.bits.get_mut(self.count / 64 % (ROOTS / 64)) {
            *negative ^= u64::from(scope.any(Real::lt(root, zero))) << (self.count % 64);
            *positive ^= u64::from(scope.any(Real::gt(root, zero))) << (self.count % 64);
        }
        self.count += 1;
    }

    /// Whether the root is negative, and whether it is positive.
    fn at(&self, root: usize) -> Option<[bool; 2]> {
        self.bits.get(root / 64 % (ROOTS / 64)).map(|bits| bits.map(|bits| bits >> (root % 64) & 1 == 1))
    }
}

/// A rate `[1/s]` with the coordinate that has it.
type Rate = (f64, &'static str);

/// What lies ahead and behind at a state.
#[derive(Clone, Copy)]
pub(super) struct Outlook {
    /// The greatest share of the root's square that is lost, and gained, in a second.
    falls: Rate,
    rises: Rate,
    /// A root that is zero or NaN.
    lost: Option<&'static str>,
    /// Which roots are negative, and which positive, in any lane.
    signs: Option<Signs>,
    /// The residual that Newton's method has left, if it is too great.
    open: Option<f64>,
}

impl Outlook {
    /// Nothing is known: at a start, where Newton's method has not been at work.
    pub(super) const fn unknown() -> Self {
        Self { falls: (0.0, ""), rises: (0.0, ""), lost: None, signs: None, open: None }
    }

    /// At a state that [`System::accepted`] gave.
    #[inline]
    pub(super) fn at<S: System>(
        problem: &Problem<'_, S>,
        t: S::Scalar,
        state: &S::State,
        scope: &Scope<S::Scalar>,
    ) -> Self {
        let mut found = Self { signs: Some(Signs::default()), ..Self::unknown() };
        let zero = S::Scalar::lit(0.0);
        let residual = problem.margins(t, state, &mut |margin: Margin<S::Scalar>| {
            if let Some(signs) = &mut found.signs {
                signs.push(margin.root, scope);
            }
            let square = margin.root * margin.root;
            let known = Real::gt(square, zero) & Real::is_finite(square) & Real::eq(margin.rate, margin.rate);
            if !scope.all(known) {
                found.lost = found.lost.or(Some(margin.coordinate));
                return;
            }
            let rate = margin.rate / square;
            for (known, rate) in [(&mut found.falls, -rate), (&mut found.rises, rate)] {
                let rate = scope.greatest(rate);
                if rate > known.0 {
                    *known = (rate, margin.coordinate);
                }
            }
        });
        if !scope.all(is_closed(residual)) {
            found.open = Some(scope.greatest(residual));
        }
        found
    }

    /// Whether Newton's method has left a loop open.
    pub(super) const fn open(&self) -> Option<f64> {
        self.open
    }

    /// The loop whose dead centre lies within the length `[s]` ahead, with its sign.
    pub(super) fn ahead(&self, length: f64) -> Option<&'static str> {
        self.lost.or_else(|| within(if length > 0.0 { self.falls } else { self.rises }, length))
    }

    /// The loop whose dead centre lies within the length `[s]` behind, after a step from where `before` was.
    pub(super) fn behind<S: System>(
        &self,
        length: f64,
        before: &Self,
        problem: &Problem<'_, S>,
        (t, state): (S::Scalar, &S::State),
    ) -> Option<&'static str> {
        let passed = match (self.signs, before.signs) {
            (Some(signs), Some(others)) if signs != others => Some(changed(problem, t, state, &signs, &others)),
            _ => None,
        };
        let near = || within(if length > 0.0 { self.rises } else { self.falls }, length);
        self.lost.or(passed).or_else(near)
    }

    /// The loop to blame for a state that is not finite after a step of this length from here.
    pub(super) fn blamed(&self, length: f64) -> Option<&'static str> {
        self.ahead(BLAMED * length)
    }

    /// The greatest length `[s]` of a step in the direction of `length`, if it is less.
    pub(super) fn cut(&self, length: f64) -> f64 {
        let (rate, _) = if length > 0.0 { self.falls } else { self.rises };
        if rate * length.abs() > SHARE { (SHARE / rate).copysign(length) } else { length }
    }

    /// The loop that would be reached first in the direction of `length`.
    pub(super) const fn name_ahead(&self, length: f64) -> &'static str {
        match self.lost {
            Some(name) => name,
            None if (length > 0.0 || self.rises.1.is_empty()) && !self.falls.1.is_empty() => self.falls.1,
            None => self.rises.1,
        }
    }

    fn nearest(&self) -> Rate {
        if self.falls.0 > self.rises.0 { self.falls } else { self.rises }
    }

    /// Whether errors are to be judged in the roots, where steps of this length have been taken.
    pub(super) fn is_near(&self, length: f64) -> bool {
        self.nearest().0 * length.abs() > NEAR
    }

    /// Whether a step of this length is so short beside what is left that its error is rounding.
    pub(super) fn is_rounding(&self, length: f64) -> bool {
        self.nearest().0 * length.abs() < ROUNDING
    }

    /// How much an error of the step to `end`, and the rounding of its coordinates, change roots and their rates, in units of
    /// a relative tolerance; the square root of the rounding unit is the least one. Coordinates that have turned many times
    /// are rounded by more than that anywhere, which no step makes less and no dead centre causes: more is allowed to them.
    pub(super) fn spread<S: System>(
        problem: &Problem<'_, S>,
        (t, length): (S::Scalar, f64),
        end: &S::State,
        error: &SlopeOf<S>,
        tolerance: f64,
        scope: &Scope<S::Scalar>,
    ) -> f64 {
        let (zero, turn) = (S::Scalar::lit(0.0), S::Scalar::lit(TURN));
        let rounding = S::Scalar::lit(ROUNDINGS) * S::Scalar::epsilon();
        let sizes = magnitude(end).map(&mut |size| Real::abs(size));
        let far = scope.any(Real::gt(greatest(&sizes.q), turn));
        let near = Slope { q: sizes.q.map(&mut |size| Real::min(size, turn)), ..sizes };
        let change = |displacement: &SlopeOf<S>| {
            let pair = [*end, displaced(end, displacement)].map(|state| problem.accepted(t, &state));
            change(problem, (t, S::Scalar::lit(length)), &pair, scope)
        };
        let error = change(&error.zip(&near, &mut |error, size| {
            let rounding = rounding * size;
            -(error + Real::select(Real::lt(error, zero), -rounding, rounding))
        }));
        let error = error / Real::max(tolerance, Real::sqrt(S::Scalar::epsilon()).greatest());
        if !far {
            return error;
        }
        let rounding = change(&sizes.scale(rounding)) / ROUNDED;
        // NaN counts as more than any number.
        if rounding <= error || error.is_nan() { error } else { rounding }
    }
}

/// The greatest change of a root's square, and of its rate over the length, from one state to the other, as a share of the
/// square; NaN if one is NaN. Roots are held a few at a time, so that nothing is evaluated for each of them.
fn change<S: System>(
    problem: &Problem<'_, S>,
    (t, length): (S::Scalar, S::Scalar),
    [one, other]: &[S::State; 2],
    scope: &Scope<S::Scalar>,
) -> f64 {
    let (mut worst, mut first) = (0.0_f64, 0);
    loop {
        let mut held = [[S::Scalar::lit(1.0), S::Scalar::lit(0.0)]; HELD];
        let mut count = 0;
        problem.margins(t, one, &mut |margin| {
            if let Some(held) = usize::checked_sub(count, first).and_then(|at| held.get_mut(at)) {
                *held = [margin.root, margin.rate];
            }
            count += 1;
        });
        let mut at = 0;
        problem.margins(t, other, &mut |margin| {
            if let Some([root, rate]) = usize::checked_sub(at, first).and_then(|at| held.get(at)) {
                let square = *root * *root;
                let change = Real::abs(square - margin.root * margin.root);
                let rate = Real::abs(length * (*rate - margin.rate));
                let share = scope.greatest(Real::max(change, rate) / square);
                worst = if share <= worst || worst.is_nan() { worst } else { share };
            }
            at += 1;
        });
        first += HELD;
        if first >= count {
            return worst;
        }
    }
}

/// The coordinate of this rate, if it takes all within the length.
fn within((rate, coordinate): Rate, length: f64) -> Option<&'static str> {
    (rate * length.abs() * LENGTHS >= 1.0).then_some(coordinate)
}

/// Whether what Newton's method has left is no more than it leaves where it converges.
#[inline]
fn is_closed<T: Real>(residual: T) -> T::Mask {
    Real::le(residual, Real::max(T::lit(1e-8), T::lit(1e4) * T::epsilon()))
}

/// What lies around the end of a step of one length, in the scalar's own precision.
pub(super) struct Soundness<T: Real> {
    /// Whether the loops are closed and no dead centre lies within the step's length ahead or behind, lane by lane.
    pub(super) mask: T::Mask,
    /// The coordinate of a dead centre that does.
    coordinate: Option<&'static str>,
    /// What Newton's method has left.
    residual: T,
    /// Which roots are negative, and which positive, in any lane.
    signs: Signs,
}

impl<T: Real> Soundness<T> {
    #[inline]
    pub(super) fn at<S: System<Scalar = T>>(
        problem: &Problem<'_, S>,
        t: T,
        state: &S::State,
        dt: T,
        scope: &Scope<T>,
    ) -> Self {
        let zero = T::lit(0.0);
        let mut mask = Real::le(zero, zero);
        let mut coordinate = None;
        let mut signs = Signs::default();
        let residual = problem.margins(t, state, &mut |margin| {
            let square = margin.root * margin.root;
            let far = Real::lt(Real::abs(margin.rate * dt) * T::lit(LENGTHS), square);
            if !scope.all(far) {
                coordinate = coordinate.or(Some(margin.coordinate));
            }
            mask = mask & far;
            signs.push(margin.root, scope);
        });
        Self { mask: mask & is_closed(residual), coordinate, residual, signs }
    }

    /// Why an integration can't go on, which has reached the time `t`; `before` is the end of the last step.
    #[inline]
    pub(super) fn check<S: System<Scalar = T>>(
        &self,
        t: T,
        before: Option<Signs>,
        problem: &Problem<'_, S>,
        state: &S::State,
    ) -> Result<Signs, IntegrationError> {
        let passed = before.filter(|before| *before != self.signs);
        if all(self.mask) && passed.is_none() {
            return Ok(self.signs);
        }
        let time = t.greatest();
        let coordinate = self.coordinate.or_else(|| Some(changed(problem, t, state, &self.signs, &passed?)));
        Err(match coordinate {
            Some(coordinate) => IntegrationError::DeadCentre { time, coordinate },
            None => IntegrationError::OpenLoops { time, residual: self.residual.greatest(), remedy: STUCK },
        })
    }
}

/// Why a state is not finite after a step of one length from `state`.
pub(super) fn cause<S: System>(
    problem: &Problem<'_, S>,
    t: S::Scalar,
    state: &S::State,
    dt: S::Scalar,
    scope: &Scope<S::Scalar>,
) -> IntegrationError {
    let (time, blamed) = (scope.greatest(t), dt * S::Scalar::lit(BLAMED));
    if let Some(coordinate) = Soundness::at(problem, t, &problem.accepted(t, state), blamed, scope).coordinate {
        return IntegrationError::DeadCentre { time, coordinate };
    }
    // Where the step began, and about where most methods look within it.
    let (q, v, x) = state.split();
    let rates = problem.position_rates(t, state);
    let without_inertia = |share: f64| {
        let ahead = dt * S::Scalar::lit(share);
        let near = state.join(q.displace(&rates.scale(ahead)), v, x);
        problem.without_inertia(t + ahead, &problem.accepted(t + ahead, &near))
    };
    let found = problem.without_inertia(t, state).or_else(|| without_inertia(0.5)).or_else(|| without_inertia(1.0));
    match found {
        Some(coordinate) => IntegrationError::NoInertia { time, coordinate },
        None => IntegrationError::NonFinite { time },
    }
}

/// What is wrong with the horizon of a start, if anything.
pub(super) fn check_horizon<S: System>(
    problem: &Problem<'_, S>,
    t: S::Scalar,
    state: &S::State,
    backwards: bool,
) -> Result<(), IntegrationError> {
    let horizon = problem.horizon(t, state);
    let what = if !all(Real::gt(horizon, t)) {
        "a state that samples starts at the time for which it was made, with a positive period"
    } else if backwards && any(Real::is_finite(horizon)) {
        "a system that samples goes forwards in time alone"
    } else {
        return Ok(());
    };
    Err(IntegrationError::InvalidArgument { what })
}

/// What is wrong with a start, if anything.
pub(super) fn check_start<S: System>(
    problem: &Problem<'_, S>,
    t: S::Scalar,
    state: &S::State,
) -> Result<(), IntegrationError> {
    if !is_finite(&magnitude(state)) {
        return Ok(()); // what is not finite is reported as such
    }
    let opening = problem.opening(t, state);
    if !opening.is_open() {
        return Ok(());
    }
    let (time, residual, remedy) = (t.greatest(), opening.residual.greatest(), opening.remedy);
    Err(match opening.what {
        Open::Positions => IntegrationError::OpenLoops { time, residual, remedy },
        Open::Velocities => IntegrationError::OpenVelocities { time, rate: residual, remedy },
        Open::Equation(equation) => IntegrationError::UnfitParameters { equation, residual, remedy },
    })
}

/// The coordinate of the first root whose sign is another one.
fn changed<S: System>(
    problem: &Problem<'_, S>,
    t: S::Scalar,
    state: &S::State,
    signs: &Signs,
    others: &Signs,
) -> &'static str {
    let (mut at, mut name) = (0, None);
    problem.margins(t, state, &mut |margin| {
        if signs.at(at) != others.at(at) {
            name = name.or(Some(margin.coordinate));
        }
        at += 1;
    });
    name.unwrap_or_default()
}

/// What Newton's method says of a run in which it stops converging.
pub(super) const STUCK: &str = "Newton's method no longer converges from the solution of the step before: shorter steps \
     help, if not a dead centre is near";

#[cfg(test)]
mod tests {
    use super::within;

    #[test]
    fn a_dead_centre_is_near_within_two_lengths() {
        assert_eq!(within((0.125, "crank"), -4.0), Some("crank"));
        assert_eq!(within((0.5, "crank"), 1.0), Some("crank"));
        assert_eq!(within((0.4, "crank"), 1.0), None);
    }
}
