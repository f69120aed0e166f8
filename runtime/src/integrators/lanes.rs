//! Motions in the lanes of a scalar, each with steps of its own: [`Integrator::integrate_lanes`].
//!
//! In a round every lane tries one step, of its own length from its own time. A lane that refuses its step, that has arrived
//! or has failed takes part in the arithmetic and stays where it is: its displacement is zero. So a batch takes as
//! many rounds as its longest motion takes steps, where steps that lanes share are the shortest that any of them needs
//! at each time; and no lane changes another, but for what rounding of lanes that share an operation may differ by. That it stays also asks
//! [`System::accepted`] to leave alone what it has given.

use super::course::{Course, Kept};
use super::error::IntegrationError;
use super::integrator::Integrator;
use super::method::{Accepted, Attempt, Method};
use super::problem::{Problem, Step};
use super::run::{begin, error};
use super::scope::Scope;
use super::slope::{SlopeOf, advanced, displaced, owed};
use crate::{Real, System, Tangent, any};
use nalgebra::SimdValue;

/// A scalar may have so many lanes.
const MOST: usize = 16;

/// What became of motions in lanes, each with steps of its own.
#[derive(Clone, Copy, Debug)]
pub struct LaneEnds<Z> {
    /// The states at the end, and in lanes that have failed the last good ones.
    pub state: Z,
    /// Evaluations of the system, each of all lanes.
    pub evaluations: u32,
    lanes: [LaneEnd; MOST],
    count: usize,
}

/// What became of the motion in one lane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LaneEnd {
    /// `[s]` the time reached.
    pub time: f64,
    /// Accepted steps.
    pub accepted: u32,
    /// Rejected steps.
    pub rejected: u32,
    /// Why the motion stopped before its end.
    pub error: Option<IntegrationError>,
}

impl<Z> LaneEnds<Z> {
    /// Lane by lane, in their order.
    pub fn lanes(&self) -> &[LaneEnd] {
        self.lanes.get(..self.count).unwrap_or(&self.lanes)
    }
}

impl<M> Integrator<M> {
    /// The states at `t1` `[s]`, from `state` at `t0` `[s]`, with the input held throughout: in each lane of the scalar a
    /// motion with steps of its own, which are those that it takes alone. [`Integrator::integrate`] has all lanes take the
    /// same steps, the shortest that any of them needs; this takes fewer evaluations the more the motions differ, and a lane
    /// that fails leaves the others alone.
    ///
    /// For steps chosen by error with [`DormandPrince`](super::DormandPrince) or [`Dop853`](super::Dop853), and scalars of
    /// at most 16 lanes. `observe` is called after every round of steps with the times and the states of all lanes; a lane
    /// whose step was not accepted, or which has ended, has those that it had before.
    ///
    /// ```
    /// use multibody::simba::simd::WideF64x4;
    /// use multibody::{Dop853, Integrator, Real, multibody};
    ///
    /// multibody! {
    ///     pub mod pendulum {
    ///         world { gravity: -9.81 * Y }
    ///         body bob { mass: 1.0, com: -Y }
    ///         joint hinge: Revolute { parent: ground, child: bob, axis: Z }
    ///     }
    /// }
    /// use pendulum::{Model, State};
    ///
    /// let mut start = State::default();
    /// start.q.hinge = WideF64x4::from([1e-3, 1.0, 2.0, 3.1]); // rad: a small swing, and three wide ones
    /// let ends = Integrator::adaptive(Dop853, 1e-9, 1e-9).integrate_lanes(
    ///     &Model::default(), 0.0, 10.0, &start, &(), |_times, _states| (),
    /// )?;
    /// let [small, .., wide] = ends.lanes() else { unreachable!() };
    /// assert!(small.error.is_none() && small.time == 10.0);
    /// assert!(small.accepted < wide.accepted);
    /// # Ok::<(), multibody::IntegrationError>(())
    /// ```
    ///
    /// # Errors
    /// [`InvalidArgument`](IntegrationError::InvalidArgument), and what is wrong with the start, in whichever lane: open
    /// loops, or what is not finite. Errors of a motion are in its [`LaneEnd`].
    pub fn integrate_lanes<S: System>(
        &self,
        system: &S,
        t0: f64,
        t1: f64,
        state: &S::State,
        input: &S::Input,
        mut observe: impl FnMut(S::Scalar, &S::State),
    ) -> Result<LaneEnds<S::State>, IntegrationError>
    where
        M: Method<S, Memory = SlopeOf<S>>,
    {
        let problem = self.problem(system, input);
        let mut batch = Batch::new(self, &problem, (t0, t1), state)?;
        while let Some(times) = batch.round() {
            observe(times, &batch.state);
        }
        Ok(batch.ends())
    }
}

/// A motion in one lane.
struct Lane<T: Real> {
    course: Course<T>,
    error: Option<IntegrationError>,
    /// `[s]` the end of the step that is tried, and its signed length; none if there is no step.
    step: Option<(f64, f64)>,
    /// What the step that is tried has come to, if it may be kept.
    kept: Option<Kept>,
}

impl<T: Real> Lane<T> {
    fn runs(&self) -> bool {
        self.error.is_none() && !self.course.arrived()
    }

    /// The value, or none where the motion has failed.
    fn unless_failed<V>(&mut self, result: Result<V, IntegrationError>) -> Option<V> {
        result.map_err(|error| self.error = Some(error)).ok()
    }
}

/// Where all lanes stand.
struct Batch<'a, S: System, M: Method<S>> {
    settings: &'a Integrator<M>,
    problem: &'a Problem<'a, S>,
    state: S::State,
    /// What compensated summation still owes the states.
    rest: SlopeOf<S>,
    memory: SlopeOf<S>,
    /// As many as the scalar has.
    lanes: [Option<Lane<S::Scalar>>; MOST],
}

impl<'a, S: System, M: Method<S, Memory = SlopeOf<S>>> Batch<'a, S, M> {
    fn new(
        settings: &'a Integrator<M>,
        problem: &'a Problem<'a, S>,
        times: (f64, f64),
        state: &S::State,
    ) -> Result<Self, IntegrationError> {
        if S::Scalar::LANES > MOST {
            return Err(IntegrationError::InvalidArgument { what: "a scalar may have at most 16 lanes here" });
        }
        if problem.tolerance().is_none() {
            let what = "steps of one length are the same in all lanes: `integrate` takes them";
            return Err(IntegrationError::InvalidArgument { what });
        }
        let memory = begin(settings, problem, times, state)?;
        if any(Real::is_finite(problem.horizon(S::Scalar::lit(times.0), state))) {
            let what =
                "lanes with steps of their own would sample at different times: `integrate` has them share their steps";
            return Err(IntegrationError::InvalidArgument { what });
        }
        let mut lanes = [const { None }; MOST];
        for (number, lane) in lanes.iter_mut().enumerate().take(S::Scalar::LANES) {
            let control = (problem.tolerance(), M::ESTIMATE);
            let course = Course::start(control, problem, times, state, || memory, Scope::lane(number))?;
            *lane = Some(Lane { course, error: None, step: None, kept: None });
        }
        Ok(Self { settings, problem, state: *state, rest: SlopeOf::<S>::zero(), memory, lanes })
    }

    /// A step of every lane that has not ended. Gives the times reached, or nothing where all lanes had ended.
    fn round(&mut self) -> Option<S::Scalar> {
        self.aim();
        if !self.lanes.iter().flatten().any(|lane| lane.step.is_some()) {
            return None;
        }
        let (method, problem) = (&self.settings.method, self.problem);
        let state = self.state;
        let step = self.step(&state, |lane| lane.step);
        let mut attempt = method.attempt(problem, &step, &self.memory);
        let end = displaced(&state, &attempt.displacement);
        let errors = error(method, problem, &step, &attempt, &end);
        for lane in self.lanes.iter_mut().flatten() {
            let Some((_, length)) = lane.step else { continue };
            let error = lane.course.scope().greatest(errors);
            let judged = lane.course.judge((method, problem), (&step, length), &attempt, &end, error);
            if lane.unless_failed(judged) != Some(true) {
                lane.step = None;
            }
        }
        // Lanes whose step ends where it can't be kept go back, and what is left is looked at again.
        let tried = attempt.displacement;
        loop {
            let step = self.step(&state, |lane| lane.step);
            attempt.displacement = self.moved(&tried);
            let (end, rest) = if self.settings.compensated {
                advanced(&state, &attempt.displacement, &self.moved(&self.rest))
            } else {
                (displaced(&state, &attempt.displacement), self.rest)
            };
            let next = Accepted::new(problem, &step, &end);
            if self.inspect(&step, &end, &next.state) {
                if self.settings.compensated {
                    self.rest = self.chosen(&owed(&next.state, &rest), &self.rest);
                }
                return Some(self.keep(&step, &attempt, &next));
            }
        }
    }

    /// What each lane tries next.
    fn aim(&mut self) {
        let (problem, state) = (self.problem, &self.state);
        for lane in self.lanes.iter_mut().flatten() {
            lane.step = None;
            if !lane.runs() {
                continue;
            }
            let course = &lane.course;
            let bounded = if course.tried() >= self.settings.max_steps {
                Err(IntegrationError::TooManySteps { time: course.t })
            } else {
                Ok(())
            };
            let target = bounded.and_then(|()| course.target(problem, state));
            let clear = target.and_then(|(end, length)| course.look_ahead(length).map(|()| (end, length)));
            lane.step = lane.unless_failed(clear);
        }
    }

    /// The steps of all lanes; one of no length where a lane takes none.
    fn step<'b>(&self, state: &'b S::State, of: impl Fn(&Lane<S::Scalar>) -> Option<(f64, f64)>) -> Step<'b, S> {
        let zero = S::Scalar::lit(0.0);
        let (mut t, mut end, mut dt) = (zero, zero, zero);
        for lane in self.lanes.iter().flatten() {
            let start = lane.course.t;
            let (target, length) = of(lane).unwrap_or((start, 0.0));
            for (all, value) in [(&mut t, start), (&mut end, target), (&mut dt, length)] {
                *all = lane.course.scope().select(S::Scalar::lit(value), *all);
            }
        }
        Step { t, end, dt, state, full: true }
    }

    /// A displacement in the lanes whose step is still to be kept, zero in the others.
    fn moved(&self, displacement: &SlopeOf<S>) -> SlopeOf<S> {
        self.chosen(displacement, &SlopeOf::<S>::zero())
    }

    /// One vector in the lanes whose step is still to be kept, the other in the rest.
    fn chosen(&self, moved: &SlopeOf<S>, other: &SlopeOf<S>) -> SlopeOf<S> {
        let scopes = || self.lanes.iter().flatten().filter(|lane| lane.step.is_some()).map(|lane| lane.course.scope());
        moved.zip(other, &mut |moved, other| scopes().fold(other, |chosen, scope| scope.select(moved, chosen)))
    }

    /// Whether all lanes can keep the ends of their steps; those that can't have none afterwards.
    fn inspect(&mut self, step: &Step<'_, S>, end: &S::State, next: &S::State) -> bool {
        let mut all = true;
        for lane in self.lanes.iter_mut().flatten() {
            let Some((_, length)) = lane.step else { continue };
            let inspected = lane.course.inspect(self.problem, (step, length), end, next);
            lane.kept = lane.unless_failed(inspected).flatten();
            if lane.kept.is_none() {
                lane.step = None;
                all = false;
            }
        }
        all
    }

    /// Goes on from the ends of the steps. Gives the times reached.
    fn keep(&mut self, step: &Step<'_, S>, attempt: &Attempt<S, M::Details>, next: &Accepted<S>) -> S::Scalar {
        let mut moved = false;
        for lane in self.lanes.iter_mut().flatten() {
            let (Some((target, length)), Some(kept)) = (lane.step, lane.kept.take()) else { continue };
            lane.course.keep(kept, length);
            lane.course.t = target;
            moved = true;
        }
        if moved {
            self.problem.reached(step.end, &next.state);
            if self.lanes.iter().flatten().any(Lane::runs) {
                let memory = self.settings.method.proceed(self.problem, step, &self.memory, attempt, next);
                self.memory = self.chosen(&memory, &self.memory);
            }
            self.state = next.state;
        }
        step.end
    }

    fn ends(&self) -> LaneEnds<S::State> {
        let mut lanes = [LaneEnd::default(); MOST];
        for (end, lane) in lanes.iter_mut().zip(self.lanes.iter().flatten()) {
            let Course { t, accepted, rejected, .. } = lane.course;
            *end = LaneEnd { time: t, accepted, rejected, error: lane.error };
        }
        LaneEnds { state: self.state, evaluations: self.problem.evaluations(), lanes, count: S::Scalar::LANES }
    }
}
