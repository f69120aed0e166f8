//! Events: what happens where a function of time and state crosses zero. [`Events`], [`Event`], [`Action`].
//!
//! Every accepted step is sampled at a few points of its dense output. Where a sign changes, the crossing is bracketed on
//! dense output first, and then by steps of the method itself from the start of the step: what is handed to the user is
//! a state of the method's own accuracy, whatever the order of its dense output, projected as every accepted state is.
//! Crossings that dense output shows and steps of the method don't are none.

mod bracket;
mod watch;

use super::error::IntegrationError;
use super::integrator::{Integrator, Statistics};
use super::interval::Interval;
use super::method::Method;
use super::run::{Run, Verdict};
use crate::{Real, System};
use watch::Watch;

/// Which crossings of zero count, as time goes on in the direction of the integration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// From below to above.
    Rising,
    /// From above to below.
    Falling,
    /// Both.
    #[default]
    Both,
}

impl Direction {
    pub(super) const fn admits(self, rising: bool) -> bool {
        match self {
            Self::Rising => rising,
            Self::Falling => !rising,
            Self::Both => true,
        }
    }
}

/// A crossing of zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Which function crossed.
    pub index: usize,
    /// `[s]` when.
    pub time: f64,
    /// Whether it rose, as time goes on in the direction of the integration.
    pub rising: bool,
}

/// What is to be done at an event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action<Z> {
    /// Nothing: the integration goes on with the step that it had.
    Continue,
    /// The integration goes on from this state, which [`System::accepted`] gets first.
    Jump(Z),
    /// The integration ends here.
    Stop,
}

/// Functions of time and state, `N` of them, with what happens where they cross zero.
///
/// A function that is zero has no sign, at the start too: the next value that is not zero gives it one, and no event. A
/// function that jumps across zero because another event changed the state does not cross it. Several events at one
/// time are handled in the order of their indices, each with the state that the one before left.
///
/// ```
/// use multibody::integrators::{Action, Direction, Event, Events};
/// use multibody::{DormandPrince, Integrator, multibody};
///
/// multibody! {
///     mod ball {
///         world { gravity: -9.81 * Y }
///         body ball { mass: 1.0 }
///         joint height: Prismatic { parent: ground, child: ball, axis: Y }
///     }
/// }
///
/// /// Loses half of its speed where it meets the ground; stops the integration at the third time.
/// struct Ground(u32);
///
/// impl Events<ball::Model, 1> for Ground {
///     fn values(&self, _t: f64, x: &ball::State) -> [f64; 1] {
///         [x.q.height]
///     }
///     fn direction(&self, _index: usize) -> Direction {
///         Direction::Falling
///     }
///     fn happened(&mut self, _event: &Event, x: &ball::State) -> Action<ball::State> {
///         self.0 += 1;
///         if self.0 == 3 {
///             return Action::Stop;
///         }
///         let mut bounced = *x;
///         bounced.v.height *= -0.5;
///         Action::Jump(bounced)
///     }
/// }
///
/// let mut start = ball::State::default();
/// start.q.height = 1.0;
/// let tolerant = Integrator::adaptive(DormandPrince, 1e-9, 1e-9);
/// let model = ball::Model::default();
/// let (_, _, time) = tolerant.with_events(&model, 0.0, 10.0, &start, &(), &mut Ground(0), |_| ())?;
/// let fall = (2.0_f64 / 9.81).sqrt();
/// assert!((time - 2.5 * fall).abs() < 1e-14); // 1 + 1 + 1/2
/// # Ok::<(), multibody::IntegrationError>(())
/// ```
pub trait Events<S: System, const N: usize> {
    /// The functions at a time `[s]` and a state. Near a crossing they should be smooth and cross with a slope. NaN ends
    /// the integration.
    fn values(&self, t: f64, state: &S::State) -> [f64; N];

    /// Which crossings of a function count. By default both.
    fn direction(&self, _index: usize) -> Direction {
        Direction::Both
    }

    /// What happens at a crossing. The state lies on its far side, within the tolerance.
    ///
    /// Where events of one function, each with a jump, follow each other ever faster, as the bounces of a ball that comes
    /// to rest, the integration ends in [`EventsAccumulate`](IntegrationError::EventsAccumulate): jump to a state or
    /// stop for a model that rests before that.
    fn happened(&mut self, event: &Event, state: &S::State) -> Action<S::State>;

    /// `[s]` crossings are located to this. By default, and at least, to rounding: of the time, and of the scalar in
    /// proportion to the step. A greater one saves steps of the method, of which an event takes four or five.
    fn tolerance(&self) -> f64 {
        0.0
    }

    /// Points between the ends of a step at which the functions are looked at, equally spaced, at most 1,000. A function
    /// that crosses twice between two of them goes unseen. With zero no dense output is made where nothing crosses.
    fn samples(&self) -> u32 {
        3
    }
}

impl<M> Integrator<M> {
    /// As [`intervals`](Self::intervals), with events. Gives the state at the end, the statistics, and the time of the
    /// end: `t1`, or that of the event that stopped the integration.
    ///
    /// `observe` sees a step after the events in it. Where an event jumps or stops, the step ends with the state before
    /// the jump.
    ///
    /// # Errors
    /// See [`IntegrationError`].
    #[expect(clippy::too_many_arguments, reason = "what an integration takes, and the events")]
    pub fn with_events<S: System, E: Events<S, N>, const N: usize>(
        &self,
        system: &S,
        t0: f64,
        t1: f64,
        state: &S::State,
        input: &S::Input,
        events: &mut E,
        mut observe: impl FnMut(&Interval<'_, S, M>),
    ) -> Result<(S::State, Statistics, f64), IntegrationError>
    where
        M: Method<S>,
    {
        let problem = self.problem(system, input);
        let mut run = Run::new(self, &problem, t0, t1, state)?;
        let mut watch = Watch::new(events, t0, state)?;
        while !run.arrived() {
            run.advance(|interval| {
                let Some(cut) = watch.inspect(interval, events)? else {
                    observe(interval);
                    return Ok(Verdict::Continue);
                };
                observe(&interval.cut(&cut.part));
                problem.reached(S::Scalar::lit(cut.part.time), &cut.part.state);
                let (time, state) = (cut.part.time, cut.state);
                Ok(if cut.stop { Verdict::Stop { time, state } } else { Verdict::Restart { time, state } })
            })?;
        }
        Ok((*run.state(), run.statistics(), run.time()))
    }
}
