//! The damped Gauss-Newton method behind equilibria and trims: [`Search`].

use super::closing::Closing;
use super::error::EquilibriumError;
use super::least::{Row, least};
use super::{Equilibrium, Found, Free};
use crate::linear::{Square, residue};
use crate::shake::shaking;
use crate::tangent::{greatest, unit, unpack};
use crate::{
    Configuration, Differentiable, DisplacementOf, ExtraOf, JacobianMatrix, Real, StateSpace, System, Tangent,
    VelocityOf, all, any,
};

/// An equation holds up to this share of what it could be, unless rounding is greater.
const TOLERANCE: f64 = 1e-13;
/// ..or this many roundings.
const ROUNDINGS: f64 = 64.0;
/// Loops that are open by less, beside one more than the greatest coordinate, count as closed where nothing is found.
const NEARLY: f64 = 1e-4;
/// ..and Newton's method has so many iterations to close them.
const CLOSINGS: u32 = 20;
/// Greatest number of steps, those by shaking among them.
const ITERATIONS: u32 = 100;
/// Greatest number of halvings of one step.
const HALVINGS: u32 = 24;
/// A step has to gain this share of what it promises.
const GAIN: f64 = 0.1;
/// Where less than this share of a step gains anything, full steps are tried..
const SMALL: f64 = 0.1;
/// ..this many, before it is taken after all.
const EXCURSION: u32 = 6;
/// Steps after all equations hold, as long as they make them better.
const POLISH: u32 = 3;
/// Greatest number of shakings..
const SHAKES: u32 = 4;
/// ..the first by up to this much (m or rad), the others by four times the one before.
const SHAKE: f64 = 0.02;

/// Where the input comes from.
pub(super) trait Source<S: Differentiable> {
    type Value: Tangent<S::Scalar>;
    fn input<'a>(&'a self, value: &'a Self::Value) -> &'a S::Input;
    /// Rates along a change of the value.
    fn derivative(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        value: &Self::Value,
        change: &Self::Value,
    ) -> (VelocityOf<S>, ExtraOf<S>);
}

/// The input is given.
pub(super) struct Held<'a, U>(pub(super) &'a U);

impl<S: Differentiable> Source<S> for Held<'_, S::Input> {
    type Value = ();
    fn input<'a>(&'a self, (): &'a ()) -> &'a S::Input {
        self.0
    }
    fn derivative(&self, _: &S, _: S::Scalar, _: &S::State, (): &(), (): &()) -> (VelocityOf<S>, ExtraOf<S>) {
        (Tangent::zero(), Tangent::zero())
    }
}

/// The input is among the unknowns.
pub(super) struct Turned;

impl<S: Differentiable> Source<S> for Turned
where
    S::Input: Tangent<S::Scalar>,
{
    type Value = S::Input;
    fn input<'a>(&'a self, value: &'a S::Input) -> &'a S::Input {
        value
    }
    fn derivative(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        value: &S::Input,
        change: &S::Input,
    ) -> (VelocityOf<S>, ExtraOf<S>) {
        system.input_derivative(t, state, value, change)
    }
}

type Mask<S> = <<S as System>::Scalar as Real>::Mask;
type Unknowns<S, U> = Free<DisplacementOf<S>, VelocityOf<S>, ExtraOf<S>, U>;
type Rates<S> = (VelocityOf<S>, ExtraOf<S>);
type Rows<S, U> =
    <<S as Differentiable>::Matrix as Square<<S as System>::Scalar>>::Array<Row<<S as System>::Scalar, Unknowns<S, U>>>;
type Vector<S> = <<S as Differentiable>::Matrix as Square<<S as System>::Scalar>>::Vector;

/// Where the search stands.
pub(super) struct Search<'a, S: Differentiable, I: Source<S>, C> {
    system: &'a S,
    source: &'a I,
    closing: &'a C,
    t: S::Scalar,
    free: &'a Unknowns<S, I::Value>,
}

/// A step, and what it was made from.
struct Proposal<S: Differentiable, U: Tangent<S::Scalar>> {
    rows: Rows<S, U>,
    /// The rows for displacements that need not keep the loops closed.
    open: Rows<S, U>,
    step: Unknowns<S, U>,
    rank: S::Scalar,
    /// What each equation could be.
    scale: Vector<S>,
    /// Whether everything is finite, and the greatest derivative.
    finite: Mask<S>,
}

/// Full steps that need not gain anything at first (the watchdog technique; Nocedal and Wright, section 15.5).
struct Excursion<S: System, U> {
    /// Where to go if they lead nowhere.
    fallback: (S::State, U),
    /// The square of the length of Newton's step where they began.
    length: S::Scalar,
    steps: u32,
}

/// How far a search has come.
struct Course<S: System, U> {
    state: S::State,
    value: U,
    /// What the equations leave there.
    residual: Rates<S>,
    iterations: u32,
    excursion: Option<Excursion<S, U>>,
    /// Steps after all equations held.
    polished: u32,
    shakes: u32,
    random: u32,
    best: Best<S::Scalar>,
}

/// The best that was seen of each lane, for errors.
struct Best<T> {
    /// What the equations left where the loops were closed, and the rank there.
    residual: T,
    rank: T,
    /// How far the loops ever were from closed.
    gap: T,
}

/// What a search ends with.
struct End<S: System> {
    /// Whether all equations hold.
    closed: Mask<S>,
    rank: S::Scalar,
}

impl<'a, S: Differentiable, I: Source<S>, C: Closing<S>> Search<'a, S, I, C> {
    /// Searches for a state and values of the inputs.
    pub(super) fn run(
        system: &'a S,
        source: &'a I,
        closing: &'a C,
        t: S::Scalar,
        guess: &S::State,
        value: I::Value,
        free: &'a Unknowns<S, I::Value>,
    ) -> Found<S, I::Value> {
        let search = Self { system, source, closing, t, free };
        let mut course = search.start(guess, value)?;
        let end = loop {
            if let Some(end) = search.step(&mut course)? {
                break end;
            }
        };
        if !all(end.closed) {
            return Err(search.failure(course, end.closed));
        }
        let Course { state, value, residual, iterations, .. } = course;
        Ok(Equilibrium { state, input: value, rank: end.rank, residual: greatest(&residual), iterations })
    }

    fn start(&self, guess: &S::State, value: I::Value) -> Result<Course<S, I::Value>, EquilibriumError> {
        let lit = S::Scalar::lit;
        let residual = self.rates(guess, &value);
        let sizes = self.sizes(guess, &value);
        if !all(Real::is_finite(greatest(&residual))
            & Real::is_finite(greatest(&sizes))
            & Real::is_finite(greatest(self.free)))
        {
            return Err(EquilibriumError::NotFinite);
        }
        let best = Best { residual: lit(f64::INFINITY), rank: lit(0.0), gap: lit(f64::INFINITY) };
        Ok(Course {
            state: *guess,
            value,
            residual,
            iterations: 0,
            excursion: None,
            polished: 0,
            shakes: 0,
            random: 1,
            best,
        })
    }

    /// One step, unless the search is at its end.
    fn step(&self, course: &mut Course<S, I::Value>) -> Result<Option<End<S>>, EquilibriumError> {
        let proposal = self.propose(&course.state, &course.value, &course.residual);
        let closed = self.holds(&course.state, &course.residual, &proposal.scale);
        self.remember(course, proposal.rank);
        let end = Ok(Some(End { closed, rank: proposal.rank }));
        if all(closed) && course.polished == POLISH {
            return end;
        }
        if !all(proposal.finite) {
            return Err(EquilibriumError::NotFinite);
        }
        if course.iterations == ITERATIONS {
            return end;
        }
        let length = self.length(&proposal.step, &course.state, &course.value);
        if !self.go_on(course, &proposal, closed, length) && !self.gain(course, &proposal, closed, length) {
            return end;
        }
        course.residual = self.rates(&course.state, &course.value);
        course.iterations += 1;
        Ok(None)
    }

    /// Keeps what is best so far.
    fn remember(&self, course: &mut Course<S, I::Value>, rank: S::Scalar) {
        let (size, gap) = (greatest(&course.residual), self.closing.gap(self.t, &course.state));
        let nearly = Real::le(self.relative(gap, &course.state), S::Scalar::lit(NEARLY));
        let best = &mut course.best;
        best.gap = Real::min(best.gap, gap);
        let better = Real::lt(size, best.residual) & nearly;
        best.residual = Real::select(better, size, best.residual);
        best.rank = Real::select(better, rank, best.rank);
    }

    /// On the way through a bent valley: full steps until Newton's step is shorter than where it began. Whether one was taken,
    /// or the way back.
    fn go_on(
        &self,
        course: &mut Course<S, I::Value>,
        proposal: &Proposal<S, I::Value>,
        closed: Mask<S>,
        length: S::Scalar,
    ) -> bool {
        let lit = S::Scalar::lit;
        let Some(left) = course.excursion.as_mut() else { return false };
        if all(closed | Real::lt(length, left.length * lit(1.0 - GAIN))) {
            course.excursion = None;
            return false;
        }
        if left.steps < EXCURSION && all(Real::gt(length, lit(0.0))) {
            left.steps += 1;
            let (step, _) = self.limited(&proposal.step, &course.state, &course.value);
            (course.state, course.value) = self.moved(&course.state, &course.value, &step);
        } else {
            (course.state, course.value) = left.fallback;
            course.excursion = None;
        }
        true
    }

    /// A step that gains something, or is shaken where none does; or the first of an excursion. Whether there was one to take.
    fn gain(
        &self,
        course: &mut Course<S, I::Value>,
        proposal: &Proposal<S, I::Value>,
        closed: Mask<S>,
        length: S::Scalar,
    ) -> bool {
        let lit = S::Scalar::lit;
        let zero = lit(0.0);
        let (step, share) = self.limited(&proposal.step, &course.state, &course.value);
        let (factor, stalled) = self.damping(&course.state, &course.value, proposal, &step, share);
        if all(closed) {
            if all(Real::eq(factor, zero)) {
                return false; // nothing makes it better
            }
            course.polished += 1;
        }
        let shaken = stalled & !closed;
        let moved = if any(shaken) {
            if course.shakes == SHAKES {
                return false;
            }
            let reach = (0..course.shakes).fold(SHAKE, |reach, _| 4.0 * reach);
            course.shakes += 1;
            let shaking = shaking(self.free, &mut course.random, lit(reach));
            step.zip(&shaking, &mut |d, s| Real::select(shaken, s, chosen(factor, d)))
        } else {
            step.map(&mut |d| chosen(factor, d))
        };
        let next = self.moved(&course.state, &course.value, &moved);
        if all(Real::gt(length, zero) | closed) && any(Real::lt(factor, lit(SMALL)) & !closed) {
            course.excursion = Some(Excursion { fallback: next, length, steps: 1 });
            (course.state, course.value) = self.moved(&course.state, &course.value, &step);
        } else {
            (course.state, course.value) = next;
        }
        true
    }

    /// What is said where not all equations hold.
    fn failure(&self, course: Course<S, I::Value>, closed: Mask<S>) -> EquilibriumError {
        let lit = S::Scalar::lit;
        let zero = lit(0.0);
        let Course { mut state, value, iterations, mut best, .. } = course;
        let unmet = !closed & Real::gt(best.residual, lit(f64::MAX)) & Real::is_finite(best.gap);
        let mut open = unmet;
        if any(unmet) {
            // No closed state was met: what is left where the last one is closed.
            state = self.closed(&state);
            let gap = self.closing.gap(self.t, &state);
            best.gap = Real::select(Real::lt(gap, best.gap), gap, best.gap);
            let residual = self.rates(&state, &value);
            let proposal = self.propose(&state, &value, &residual);
            let found = unmet & Real::le(self.relative(gap, &state), lit(NEARLY));
            best.residual = Real::select(found, greatest(&residual), best.residual);
            best.rank = Real::select(found, proposal.rank, best.rank);
            open = open & !found;
        }
        if any(open) {
            return EquilibriumError::Open { gap: Real::select(open, best.gap, zero).greatest(), iterations };
        }
        // As many as loops close hold by themselves.
        let equations = Rates::<S>::zero().len().saturating_sub(self.loops(&state));
        let residual = Real::select(closed | !Real::is_finite(best.residual), zero, best.residual).greatest();
        let rank = Real::select(closed, lit(f64::from(u32::MAX)), best.rank);
        let rank = -(-rank).greatest() as usize;
        if rank < equations {
            EquilibriumError::Singular { residual, rank, equations }
        } else {
            EquilibriumError::NotFound { residual, iterations }
        }
    }

    /// Accelerations and rates of own states.
    fn rates(&self, state: &S::State, value: &I::Value) -> Rates<S> {
        self.system.derivative(self.t, state, self.source.input(value))
    }

    /// The sizes of all unknowns.
    fn sizes(&self, state: &S::State, value: &I::Value) -> Unknowns<S, I::Value> {
        let (q, v, x) = state.split();
        Free { position: q.magnitude(), velocity: v, states: x, input: *value }
    }

    fn moved(&self, state: &S::State, value: &I::Value, step: &Unknowns<S, I::Value>) -> (S::State, I::Value) {
        let (q, v, x) = state.split();
        let state = state.join(q.displace(&step.position), v.add(&step.velocity), x.add(&step.states));
        (self.system.accepted(self.t, &state, self.source.input(value)), value.add(&step.input))
    }

    /// The state with its loops closed by Newton's method alone, as far as that leads.
    fn closed(&self, state: &S::State) -> S::State {
        let mut state = *state;
        for _ in 0..CLOSINGS {
            let d = self.closing.correction(self.t, &state, &self.free.position);
            let (q, v, x) = state.split();
            state = state.join(q.displace(&d), v, x);
        }
        state
    }

    /// The number of independent constraints: the trace of the projection across the loops.
    fn loops(&self, state: &S::State) -> usize {
        if !C::LOOPS {
            return 0;
        }
        let zero = S::Scalar::lit(0.0);
        let mut trace = zero;
        for i in 0..VelocityOf::<S>::zero().len() {
            let unit = unit(i);
            let across = self.closing.rates_across(self.t, state, &unit);
            trace += across.zip(&unit, &mut |a, u| a * u).fold(zero, &mut |sum, a| sum + a);
        }
        (trace.greatest() + 0.5) as usize
    }

    /// The part of rates along the loops: across them there is only rounding.
    fn along(&self, state: &S::State, rates: &Rates<S>) -> Rates<S> {
        if !C::LOOPS {
            return *rates;
        }
        let across = self.closing.rates_across(self.t, state, &rates.0);
        (rates.0.add_scaled(S::Scalar::lit(-1.0), &across), rates.1)
    }

    /// Whether all equations hold, and all loops are closed.
    fn holds(&self, state: &S::State, residual: &Rates<S>, scale: &Vector<S>) -> Mask<S> {
        let lit = S::Scalar::lit;
        let tolerance = Real::max(lit(TOLERANCE), lit(ROUNDINGS) * S::Scalar::epsilon());
        let worst = scaled::<S>(&self.along(state, residual), scale)
            .fold(lit(0.0), &mut |worst, r| Real::max(worst, Real::abs(r)));
        let gap = self.relative(self.closing.gap(self.t, state), state);
        Real::le(worst, tolerance) & Real::le(gap, tolerance)
    }

    /// A gap beside one more than the greatest coordinate.
    fn relative(&self, gap: S::Scalar, state: &S::State) -> S::Scalar {
        let (q, _, _) = state.split();
        gap / (S::Scalar::lit(1.0) + greatest(&q.magnitude()))
    }

    /// The step of Newton's method that is the least one.
    fn propose(&self, state: &S::State, value: &I::Value, residual: &Rates<S>) -> Proposal<S, I::Value> {
        let lit = S::Scalar::lit;
        let (zero, one) = (lit(0.0), lit(1.0));
        let mut rows = self.rows(state, value);
        let sizes = self.sizes(state, value);
        let mut scale = S::Matrix::vector(|_| one);
        let mut poison = zero;
        for (row, scale) in rows.as_mut().iter_mut().zip(scale.as_mut()) {
            let reach = row.entries.zip(&sizes, &mut |a, z| Real::abs(a) * (one + Real::abs(z)));
            *scale = one + reach.fold(zero, &mut |sum, a| sum + a);
            poison += residue(*scale);
            row.square = square(&row.entries, self.free);
        }
        let mut open = rows;
        if C::LOOPS {
            self.project(state, &mut rows, &mut open);
        }
        for row in rows.as_mut() {
            row.square = Real::select(Real::gt(row.square, zero), row.square, one) + poison;
        }
        let (step, rank) = self.correction(&rows, &open, state, residual);
        let finite = Real::is_finite(greatest(&step)) & Real::is_finite(poison);
        Proposal { rows, open, step, rank, scale, finite }
    }

    /// The least step for the rates at a state, by equations that were linearised there or nearby, and their rank.
    fn correction(
        &self,
        rows: &Rows<S, I::Value>,
        open: &Rows<S, I::Value>,
        state: &S::State,
        residual: &Rates<S>,
    ) -> (Unknowns<S, I::Value>, S::Scalar) {
        let zero = S::Scalar::lit(0.0);
        let mut rows = *rows;
        let closing = self.closing.correction(self.t, state, &self.free.position);
        for ((row, open), &rate) in
            rows.as_mut().iter_mut().zip(open.as_ref()).zip(S::Matrix::packed(&self.along(state, residual)).as_ref())
        {
            // Less what closing the loops does to the equation.
            let closed = open.entries.position.zip(&closing, &mut |a, d| a * d).fold(zero, &mut |sum, a| sum + a);
            row.right = -rate - closed;
        }
        let threshold = S::Scalar::lit(16.0 * S::Matrix::SIZE as f64) * S::Scalar::epsilon();
        let (mut step, rank) = least(rows.as_mut(), self.free, threshold);
        step.position = step.position.add(&closing);
        (step, rank)
    }

    /// Leaves of the equations what lies along the loops. Accelerations do so, and what their change has across comes from
    /// the curvature of the constraints alone: with the projection `P` of least squares, `P J P` in place of `J`, the right
    /// one in the weights of the displacements. `open` becomes `P J`.
    fn project(&self, state: &S::State, rows: &mut Rows<S, I::Value>, open: &mut Rows<S, I::Value>) {
        let (zero, one) = (S::Scalar::lit(0.0), S::Scalar::lit(1.0));
        let weights = &self.free.position;
        let all = *rows;
        for (i, row) in rows.as_mut().iter_mut().enumerate().take(VelocityOf::<S>::zero().len()) {
            let unit: VelocityOf<S> = unit(i);
            let across = self.closing.rates_across(self.t, state, &unit);
            let mut others = all.as_ref().iter();
            row.entries =
                unit.zip(&across, &mut |u, a| u - a).fold(Unknowns::<S, I::Value>::zero(), &mut |sum, share| {
                    others.next().map_or(sum, |other| sum.add_scaled(share, &other.entries))
                });
        }
        *open = *rows;
        for row in rows.as_mut() {
            let along = row.entries.position.zip(weights, &mut |a, w| a * w);
            let across = self.closing.across(self.t, state, &along, weights);
            let across = across.zip(weights, &mut |d, w| d / Real::select(Real::gt(w, zero), w, one));
            row.entries.position = row.entries.position.zip(&across, &mut |a, d| a - d);
        }
    }

    /// The linearised equations, one in each row. A matrix that has rows of displacements too leaves as many empty at the
    /// end.
    fn rows(&self, state: &S::State, value: &I::Value) -> Rows<S, I::Value> {
        let zero = S::Scalar::lit(0.0);
        let jacobian = self.system.jacobian(self.t, state, self.source.input(value));
        let none = Unknowns::<S, I::Value>::zero();
        let mut rows = S::Matrix::array(|i| {
            let mut column = 0;
            let position = none.position.map(&mut |_| next(&mut column, |j| S::Matrix::by_position(&jacobian, i, j)));
            column = 0;
            let velocity = none.velocity.map(&mut |_| next(&mut column, |j| S::Matrix::by_rates(&jacobian, i, j)));
            let states = none.states.map(&mut |_| next(&mut column, |j| S::Matrix::by_rates(&jacobian, i, j)));
            Row { entries: Free { position, velocity, states, input: none.input }, right: zero, square: zero }
        });
        for k in 0..none.input.len() {
            let unit = unit(k);
            let change = S::Matrix::packed(&self.source.derivative(self.system, self.t, state, value, &unit));
            for (row, &change) in rows.as_mut().iter_mut().zip(change.as_ref()) {
                row.entries.input = row.entries.input.add_scaled(change, &unit);
            }
        }
        rows
    }

    /// The share of the step to take in each lane, and the lanes in which there is none. `step` is `share` of Newton's step,
    /// which cannot gain more than that share of what the whole step promises.
    ///
    /// What has to fall is the step that the same linearised equations would ask for at the new state (the natural
    /// monotonicity test; Deuflhard, Newton Methods for Nonlinear Problems, section 3.3): unlike the accelerations, it is
    /// not ruled by what is stiff.
    fn damping(
        &self,
        state: &S::State,
        value: &I::Value,
        proposal: &Proposal<S, I::Value>,
        step: &Unknowns<S, I::Value>,
        share: S::Scalar,
    ) -> (S::Scalar, Mask<S>) {
        let lit = S::Scalar::lit;
        let (zero, one) = (lit(0.0), lit(1.0));
        let now = self.length(&proposal.step, state, value);
        let (mut taken, mut factor, mut open) = (zero, one, !Real::lt(zero, zero));
        for _ in 0..=HALVINGS {
            let (next, next_value) = self.moved(state, value, &step.scale(factor));
            let (left, _) = self.correction(&proposal.rows, &proposal.open, &next, &self.rates(&next, &next_value));
            let good = open & Real::lt(self.length(&left, state, value), now * (one - lit(GAIN) * share * factor));
            taken = Real::select(good, factor, taken);
            open = open & !good;
            if !any(open) {
                break;
            }
            factor *= lit(0.5);
        }
        (taken, open)
    }

    /// The square of a step's length, relative to what moves.
    fn length(&self, step: &Unknowns<S, I::Value>, state: &S::State, value: &I::Value) -> S::Scalar {
        let (zero, one) = (S::Scalar::lit(0.0), S::Scalar::lit(1.0));
        let relative = step.zip(&self.sizes(state, value), &mut |d, z| d / (one + Real::abs(z)));
        relative.fold(zero, &mut |sum, d| sum + d * d)
    }

    /// A step not farther than a radian or, for what is longer, than it is long; and which share of the whole step it is.
    fn limited(
        &self,
        step: &Unknowns<S, I::Value>,
        state: &S::State,
        value: &I::Value,
    ) -> (Unknowns<S, I::Value>, S::Scalar) {
        let one = S::Scalar::lit(1.0);
        let reach = greatest(&step.zip(&self.sizes(state, value), &mut |d, z| d / (one + Real::abs(z))));
        let share = one / Real::max(one, reach);
        (step.scale(share), share)
    }
}

/// A share of a component; nothing where the share is zero, whatever the component.
fn chosen<T: Real>(factor: T, d: T) -> T {
    Real::select(Real::eq(factor, T::lit(0.0)), T::lit(0.0), factor * d)
}

/// The value at the next place.
fn next<T>(place: &mut usize, value: impl FnOnce(usize) -> T) -> T {
    let here = *place;
    *place += 1;
    value(here)
}

/// Accelerations and rates, each divided by what it could be.
fn scaled<S: Differentiable>(rates: &Rates<S>, scale: &Vector<S>) -> Rates<S> {
    rates.zip(&unpack(scale.as_ref()), &mut |rate, scale| rate / scale)
}

/// The square of a row's length.
fn square<T: Real, V: Tangent<T>>(row: &V, weights: &V) -> T {
    row.zip(weights, &mut |a, w| a * a * w).fold(T::lit(0.0), &mut |sum, a| sum + a)
}
