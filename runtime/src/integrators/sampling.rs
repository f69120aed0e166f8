//! States at given times: [`Samples`].

use super::interval::Interval;
use super::method::Method;
use crate::System;
use core::iter::{Fuse, Peekable};

/// Times that follow each other, waiting for the intervals that hold them.
///
/// [`Integrator::sampled`](super::Integrator::sampled) is this with a plain integration; with events or with work of
/// one's own it goes into the closure that sees the intervals.
#[derive(Clone, Debug)]
pub struct Samples<I: Iterator<Item = f64>> {
    times: Peekable<Fuse<I>>,
}

impl<I: Iterator<Item = f64>> Samples<I> {
    /// In the order in which an integration meets them.
    pub fn new(times: impl IntoIterator<IntoIter = I>) -> Self {
        Self { times: times.into_iter().fuse().peekable() }
    }

    /// Calls `observe` if the next time is that of the start, `t0`.
    pub fn first<Z>(&mut self, t0: f64, state: &Z, mut observe: impl FnMut(f64, &Z)) {
        while self.times.next_if_eq(&t0).is_some() {
            observe(t0, state);
        }
    }

    /// Calls `observe` with every time after the start of the interval up to its end. Times before it are dropped.
    pub fn within<S: System, M: Method<S>>(
        &mut self,
        interval: &Interval<'_, S, M>,
        mut observe: impl FnMut(f64, &S::State),
    ) {
        let (start, end) = (interval.start(), interval.end());
        let forwards = end >= start;
        let reached = |&t: &f64| if forwards { t <= end } else { t >= end };
        while let Some(t) = self.times.next_if(reached) {
            if t == end {
                observe(t, interval.last());
            } else if (t > start) == forwards && t != start {
                observe(t, &interval.at(t));
            }
        }
    }
}
