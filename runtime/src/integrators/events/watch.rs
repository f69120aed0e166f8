//! Looks for events in accepted steps: [`Watch`].

use super::bracket::{Bracket, STEPS};
use super::{Action, Event, Events};
use crate::integrators::error::IntegrationError;
use crate::integrators::interval::{Interval, Part};
use crate::integrators::method::Method;
use crate::integrators::slope::{is_finite, magnitude};
use crate::{Real, System};

/// At most so many crossings are located between two neighbouring points: functions that cross more often there, or whose
/// crossings by dense output and by steps of the method contradict each other, have no end of them.
const CROSSINGS: u32 = 100;
/// At most so many points between the ends of a step are looked at: whatever the user says, a step is bounded work.
const SAMPLES: u32 = 1000;
/// The first sample after a jump, as a share of the time since the restart before; the next ones are four times as far
/// each, up to those of every step.
const FIRST: f64 = 1e-3;
/// The same after the start, as a share of the step.
const START: f64 = 1e-6;
/// Events of one function, each sooner than the one before, are taken to accumulate when their spacing has fallen to
/// this share of the first one.
const ACCUMULATED: f64 = 1e-7;

/// What is known of one function.
#[derive(Clone, Copy)]
struct Track {
    /// Minus one, one, or zero where it has no sign.
    sign: f64,
    /// Its value after a jump at its own crossing: nearly zero, and taken for zero until it has left.
    zero: f64,
    /// Its last value.
    last: f64,
    /// `[s]` the time of its last event with a jump, NaN if there was none; the time from the one before, and the first
    /// of such times that shrank since.
    jumped: f64,
    spacing: f64,
    longest: f64,
}

impl Track {
    fn new(value: f64) -> Self {
        let none = f64::NAN;
        Self { sign: Real::signum(value), zero: 0.0, last: value, jumped: none, spacing: none, longest: none }
    }

    /// Whether a value lies on the other side, zero being there.
    fn crosses(&self, value: f64) -> bool {
        self.sign * (value - self.zero) <= 0.0 && self.sign != 0.0
    }

    /// Below zero on this side, zero or more on the other.
    fn beyond(&self, value: f64) -> f64 {
        -self.sign * (value - self.zero)
    }

    /// A sample.
    fn see(&mut self, value: f64) {
        if (value - self.zero).abs() > 1e3 * self.zero.abs() {
            self.zero = 0.0;
        }
        self.sign = Real::signum(value - self.zero);
        self.last = value;
    }

    /// After an event: on the other side.
    fn cross(&mut self, value: f64) {
        self.sign = if value == self.zero { 0.0 } else { -self.sign };
        self.last = value;
    }

    /// After a jump. A function that crossed and that the jump left where it was is at zero.
    fn land(&mut self, crossed: Option<f64>, value: f64) {
        let scale = self.last.abs();
        match crossed {
            Some(before) if value.abs() <= Real::max(8.0 * before.abs(), 1e-10 * scale) => {
                self.zero = value;
                self.sign = 0.0;
            }
            _ => {
                self.zero = 0.0;
                self.sign = Real::signum(value);
            }
        }
        self.last = value;
    }

    /// A jump at its own event; whether such jumps accumulate.
    fn accumulates(&mut self, time: f64, resolution: f64) -> bool {
        let spacing = (time - self.jumped).abs();
        self.jumped = time;
        if spacing.is_nan() {
            return false;
        }
        let shrinks = spacing <= self.spacing && spacing >= 0.02 * self.spacing;
        if !shrinks {
            self.longest = spacing;
        }
        self.spacing = spacing;
        spacing <= 16.0 * resolution || spacing <= ACCUMULATED * self.longest
    }
}

/// The end of a step that an event cut short.
pub(super) struct Cut<S: System, M: Method<S>> {
    pub(super) part: Part<S, M>,
    /// The state after the event.
    pub(super) state: S::State,
    pub(super) stop: bool,
}

/// Follows the signs of the functions.
pub(super) struct Watch<const N: usize> {
    tracks: [Track; N],
    /// `[s]` time of the last restart.
    restarted: f64,
    /// `[s]` time to the first sample of the next step, if that step is to be looked at closely; NaN at the start.
    close: Option<f64>,
}

/// The values at a state; NaN is an error.
fn values<S: System, E: Events<S, N>, const N: usize>(
    events: &E,
    time: f64,
    state: &S::State,
) -> Result<[f64; N], IntegrationError> {
    let values = events.values(time, state);
    if values.iter().any(|value| value.is_nan()) {
        return Err(IntegrationError::NonFinite { time });
    }
    Ok(values)
}

impl<const N: usize> Watch<N> {
    pub(super) fn new<S: System>(
        events: &impl Events<S, N>,
        t0: f64,
        state: &S::State,
    ) -> Result<Self, IntegrationError> {
        let values = values::<S, _, N>(events, t0, state)?;
        Ok(Self { tracks: values.map(Track::new), restarted: t0, close: Some(f64::NAN) })
    }

    /// Handles the events within a step; gives where the first one with a jump or a stop ends it.
    pub(super) fn inspect<S: System, M: Method<S>>(
        &mut self,
        interval: &Interval<'_, S, M>,
        events: &mut impl Events<S, N>,
    ) -> Result<Option<Cut<S, M>>, IntegrationError> {
        let length = interval.length().abs();
        let sharpest = resolution(interval, 0.0);
        let width = resolution(interval, events.tolerance()) / length;
        let first =
            self.close.take().map(|time| if time.is_nan() { START } else { Real::max(time, 4.0 * sharpest) / length });
        let inner = f64::from(events.samples().min(SAMPLES)) + 1.0;
        let (mut low, mut c) = (0.0, 0.0);
        while c < 1.0 {
            c = next_share(c, inner, first);
            if c < low {
                continue; // an event was located beyond
            }
            let (time, state) = (interval.time(c), if c < 1.0 { interval.share(c) } else { *interval.last() });
            let seen = values::<S, _, N>(events, time, &state)?;
            let (mut refuted, mut located) = ([false; N], 0);
            while let Some((index, guess)) = self.earliest(interval, events, (low, c, width), &seen, &refuted) {
                located += 1;
                if located > CROSSINGS {
                    return Err(IntegrationError::EventsAccumulate { time: interval.time(low) });
                }
                match self.locate(interval, events, index, (low, guess, c), width)? {
                    None => refuted.iter_mut().skip(index).take(1).for_each(|refuted| *refuted = true),
                    Some(part) => {
                        let (index, part) = self.sooner(interval, events, (index, part), low, width)?;
                        low = part.share;
                        if let Some(cut) = self.handle(interval, events, index, part, sharpest)? {
                            return Ok(Some(cut));
                        }
                    }
                }
            }
            for ((track, value), refuted) in self.tracks.iter_mut().zip(seen).zip(refuted) {
                if !refuted {
                    track.see(value);
                }
            }
            low = Real::max(low, c);
        }
        Ok(None)
    }

    /// The first crossing between two shares, with its share, by dense output.
    fn earliest<S: System, M: Method<S>>(
        &self,
        interval: &Interval<'_, S, M>,
        events: &impl Events<S, N>,
        (low, high, width): (f64, f64, f64),
        seen: &[f64; N],
        refuted: &[bool; N],
    ) -> Option<(usize, f64)> {
        let mut first: Option<(usize, f64)> = None;
        for (index, ((track, &value), refuted)) in self.tracks.iter().zip(seen).zip(refuted).enumerate() {
            if *refuted || !track.crosses(value) || !events.direction(index).admits(track.sign < 0.0) {
                continue;
            }
            let function = |c: f64| {
                let values = events.values(interval.time(c), &interval.share(c));
                track.beyond(values.get(index).copied().unwrap_or(f64::NAN))
            };
            let mut bracket = Bracket::new((low, track.beyond(track.last)), (high, track.beyond(value)));
            for _ in 0..STEPS {
                let Some(x) = bracket.next(0.1 * width) else { break };
                bracket.narrow(x, function(x));
            }
            if first.is_none_or(|(_, share)| bracket.high < share) {
                first = Some((index, bracket.high));
            }
        }
        first
    }

    /// The end, on the far side of the crossing, of a step of the method; none if there is no crossing by such steps.
    fn locate<S: System, M: Method<S>>(
        &self,
        interval: &Interval<'_, S, M>,
        events: &impl Events<S, N>,
        index: usize,
        (low, guess, high): (f64, f64, f64),
        width: f64,
    ) -> Result<Option<Part<S, M>>, IntegrationError> {
        let Some(track) = self.tracks.get(index) else { return Ok(None) };
        let value = |part: &Part<S, M>| -> Result<f64, IntegrationError> {
            let values = values::<S, _, N>(events, part.time, &part.state)?;
            Ok(track.beyond(values.get(index).copied().unwrap_or(f64::NAN)))
        };
        // A first step to the guess. How far the crossing may be from it tells the slope of dense output.
        let mut part = interval.part(guess)?;
        let at_guess = value(&part)?;
        let near = Real::max(1e-3 * (high - low), 2.0 * width);
        let other = if guess - near > low { guess - near } else { guess + near };
        let slope = {
            let values = events.values(interval.time(other), &interval.share(other));
            let at_other = track.beyond(values.get(index).copied().unwrap_or(f64::NAN));
            let values = events.values(interval.time(guess), &interval.share(guess));
            (track.beyond(values.get(index).copied().unwrap_or(f64::NAN)) - at_other) / (guess - other)
        };
        let correction = 2.0 * (at_guess / slope).abs() + 0.9 * width;
        let mut reach = if correction < near { correction } else { near };

        // Outwards from there, to the other side.
        let mut bracket = if at_guess >= 0.0 {
            let mut known = (low, f64::NAN);
            let mut at_high = (guess, at_guess);
            for _ in 0..STEPS {
                let x = at_high.0 - reach;
                if x <= low {
                    break;
                }
                let try_part = interval.part(x)?;
                let at_x = value(&try_part)?;
                if at_x < 0.0 {
                    known = (x, at_x);
                    break;
                }
                at_high = (x, at_x);
                part = try_part;
                reach *= 8.0;
            }
            Bracket::new(known, at_high)
        } else {
            let mut at_low = (guess, at_guess);
            loop {
                let x = Real::min(at_low.0 + reach, 1.0);
                part = interval.part(x)?;
                let at_x = value(&part)?;
                if at_x >= 0.0 {
                    break Bracket::new(at_low, (x, at_x));
                }
                if x >= 1.0 {
                    return Ok(None);
                }
                at_low = (x, at_x);
                reach *= 8.0;
            }
        };
        for _ in 0..STEPS {
            let Some(x) = bracket.next(width) else { break };
            let try_part = interval.part(x)?;
            let at_x = value(&try_part)?;
            bracket.narrow(x, at_x);
            if at_x >= 0.0 {
                part = try_part;
            }
        }
        Ok(Some(part))
    }

    /// The first of the crossings before an event that steps of the method show and dense output had after it.
    fn sooner<S: System, M: Method<S>>(
        &self,
        interval: &Interval<'_, S, M>,
        events: &impl Events<S, N>,
        (mut index, mut part): (usize, Part<S, M>),
        low: f64,
        width: f64,
    ) -> Result<(usize, Part<S, M>), IntegrationError> {
        let reached = values::<S, _, N>(events, part.time, &part.state)?;
        for (other, (track, value)) in self.tracks.iter().zip(reached).enumerate() {
            let crossed = track.crosses(value) && events.direction(other).admits(track.sign < 0.0);
            if other == index || !crossed {
                continue;
            }
            match self.locate(interval, events, other, (low, part.share, part.share), width)? {
                Some(earlier) if earlier.share < part.share => (index, part) = (other, earlier),
                _ => (),
            }
        }
        Ok((index, part))
    }

    /// Calls the user for every function that has crossed at the end of a step of the method.
    fn handle<S: System, M: Method<S>>(
        &mut self,
        interval: &Interval<'_, S, M>,
        events: &mut impl Events<S, N>,
        located: usize,
        part: Part<S, M>,
        resolution: f64,
    ) -> Result<Option<Cut<S, M>>, IntegrationError> {
        let time = part.time;
        let reached = values::<S, _, N>(events, time, &part.state)?;
        let mut crossed = [None; N];
        let (mut state, mut jumped, mut stop) = (part.state, false, false);
        for (index, ((track, value), crossed)) in self.tracks.iter_mut().zip(reached).zip(&mut crossed).enumerate() {
            let rising = track.sign < 0.0;
            if index != located && !(track.crosses(value) && events.direction(index).admits(rising)) {
                continue;
            }
            *crossed = Some(value - track.zero);
            match events.happened(&Event { index, time, rising }, &state) {
                Action::Continue => (),
                Action::Stop => stop = true,
                Action::Jump(other) => {
                    state = other;
                    jumped = true;
                    if track.accumulates(time, resolution) {
                        return Err(IntegrationError::EventsAccumulate { time });
                    }
                }
            }
        }
        if !jumped {
            for ((track, value), crossed) in self.tracks.iter_mut().zip(reached).zip(crossed) {
                if crossed.is_some() {
                    track.cross(value);
                }
            }
            return Ok(stop.then_some(Cut { part, state, stop }));
        }
        state = interval.accepted(time, &state);
        if !is_finite(&magnitude(&state)) {
            return Err(IntegrationError::NonFinite { time });
        }
        let landed = values::<S, _, N>(events, time, &state)?;
        for ((track, value), crossed) in self.tracks.iter_mut().zip(landed).zip(crossed) {
            track.land(crossed, value);
        }
        self.close = Some(FIRST * (time - self.restarted).abs());
        self.restarted = time;
        Ok(Some(Cut { part, state, stop }))
    }
}

/// `[s]` how sharply a crossing can be located.
fn resolution<S: System, M: Method<S>>(interval: &Interval<'_, S, M>, tolerance: f64) -> f64 {
    let latest = Real::max(interval.start().abs(), interval.end().abs());
    let step = S::Scalar::epsilon().greatest() * interval.length().abs();
    let least = 2.0 * Real::max(f64::EPSILON * latest, step);
    if tolerance > least { tolerance } else { least }
}

/// The share of the next sample: whole parts of the step, and where a step is looked at closely, shares that grow from
/// the first one before those.
fn next_share(c: f64, parts: f64, first: Option<f64>) -> f64 {
    let whole = (Real::floor(c * parts + 1e-6) + 1.0) / parts;
    let close = match first {
        Some(first) if c == 0.0 => first,
        Some(_) => 4.0 * c,
        None => 1.0,
    };
    Real::min(Real::min(whole, close), 1.0)
}
