//! Every method with every use of an integrator, at any time, step, tolerance and state.

use super::bounded::Bounded;
use super::drawn::{Drawn, Numbers, finite};
use multibody::integrators::{Action, Direction, Event, Events, Samples};
use multibody::*;
use std::hint::black_box;

/// Functions of time and of the state that may be anything, with any action.
struct Wild<'a, 'b, S> {
    numbers: &'a Numbers,
    system: &'a Bounded<'b, S>,
    level: f64,
    frequency: f64,
    tolerance: f64,
    samples: u32,
}

impl<'a, 'b, S> Wild<'a, 'b, S> {
    fn new(numbers: &'a Numbers, system: &'a Bounded<'b, S>) -> Self {
        let [level, frequency, tolerance, samples] = std::array::from_fn(|_| numbers.setting());
        let samples = match samples {
            x if x > 9.0 => u32::MAX,
            x if x > 4.0 => 20,
            x if x < -5.0 => 0,
            _ => 3,
        };
        Self { numbers, system, level, frequency, tolerance, samples }
    }
}

impl<S: System<Scalar: Drawn>, R: System<Scalar = S::Scalar, State = S::State>> Events<R, 2> for Wild<'_, '_, S> {
    fn values(&self, t: f64, state: &S::State) -> [f64; 2] {
        self.system.count();
        let (q, v, _) = state.split();
        let size = v.fold(q.magnitude().fold(0.0, &mut |sum, x| sum + x.greatest()), &mut |sum, x| sum + x.greatest());
        [size - self.level, (self.frequency * t).sin()]
    }
    fn direction(&self, index: usize) -> Direction {
        [Direction::Both, Direction::Rising][index]
    }
    fn happened(&mut self, _: &Event, state: &S::State) -> Action<S::State> {
        self.system.count();
        let (q, v, x) = state.split();
        match self.numbers.setting() {
            x if x > 3.0 => Action::Stop,
            y if y > 0.0 => Action::Jump(state.join(q.displace(&self.numbers.vector()), v, x)),
            y if y > -1.0 => Action::Jump(state.join(q, v.scale(S::Scalar::lit(-0.5)), x)),
            _ => Action::Continue,
        }
    }
    fn tolerance(&self) -> f64 {
        self.tolerance
    }
    fn samples(&self) -> u32 {
        self.samples
    }
}

/// What an integration may give: a state that is finite, or an error.
pub(super) fn ended<Z: StateSpace, R>(outcome: &Result<(Z, R), IntegrationError>) {
    assert!(outcome.as_ref().is_ok_and(|(state, _)| finite(state)) || outcome.is_err(), "a state that is not finite");
}

/// Every use of an integrator, of a system that wraps `bounded` or is it.
fn uses<S, R, M>(
    integrator: Integrator<M>,
    (system, bounded): (&R, &Bounded<S>),
    (t0, t1): (f64, f64),
    (state, input): (&S::State, &S::Input),
    n: &Numbers,
) where
    S: System<Scalar: Drawn>,
    R: System<Scalar = S::Scalar, State = S::State, Input = S::Input>,
    M: Method<R>,
{
    bounded.reset();
    ended(&integrator.integrate(system, t0, t1, state, input, |_, _| ()));
    bounded.reset();
    ended(&integrator.intervals(system, t0, t1, state, input, |interval| {
        black_box(interval.first().split().1.len() + interval.last().split().1.len());
        black_box(interval.at(n.setting()));
        black_box(interval.share(n.setting()));
        let _ = black_box(interval.step_to(n.setting()).is_ok());
        let _ = black_box(interval.step_to(0.5 * (interval.start() + interval.end())).is_ok());
    }));
    bounded.reset();
    let times = [t0, n.setting(), n.setting(), 0.5 * (t0 + t1), n.setting(), t1];
    ended(&integrator.sampled(system, t0, t1, state, input, times, |_, x| {
        black_box(x.split().1.len());
    }));
    bounded.reset();
    let mut times = Samples::new(times);
    times.first(n.setting(), state, |_, _| ());
    let mut events = Wild::new(n, bounded);
    let outcome = integrator.max_steps(4).with_events(system, t0, t1, state, input, &mut events, |interval| {
        times.within(interval, |_, x| {
            black_box(x.split().1.len());
        });
    });
    ended(&outcome.map(|(state, statistics, time)| (state, (statistics, time))));
}

/// A method in steps of one length and in steps chosen by error, of any and of ordinary lengths.
pub(super) fn method<S, R, M>(
    method: M,
    (system, bounded): (&R, &Bounded<S>),
    (state, input): (&S::State, &S::Input),
    n: &Numbers,
) where
    S: System<Scalar: Drawn>,
    R: System<Scalar = S::Scalar, State = S::State, Input = S::Input>,
    M: Method<R>,
{
    let wild = Tolerance {
        first_step: n.setting(),
        min_step: n.setting(),
        max_step: n.setting(),
        ..Tolerance::new(n.setting(), n.setting())
    };
    let systems = (system, bounded);
    uses(Integrator::fixed(method, n.setting()).max_steps(20), systems, (n.setting(), n.setting()), (state, input), n);
    uses(Integrator::fixed(method, 2e-3).max_steps(20).compensated(), systems, (0.0, 0.013), (state, input), n);
    uses(Integrator::within(method, wild).max_steps(20), systems, (n.setting(), n.setting()), (state, input), n);
    uses(Integrator::adaptive(method, 1e-5, 1e-5).max_steps(20), systems, (0.1, -0.1), (state, input), n);
}

/// Those that ask for nothing but rates.
pub(super) fn any<S: SecondOrder<Scalar: Drawn>>(system: &Bounded<S>, start: (&S::State, &S::Input), n: &Numbers) {
    let systems = (system, system);
    method(Euler, systems, start, n);
    method(SemiImplicitEuler, systems, start, n);
    method(Rk4, systems, start, n);
    method(DormandPrince, systems, start, n);
    method(Dop853, systems, start, n);
    method(ImplicitMidpoint, systems, start, n);
    method(GaussLegendre4, systems, start, n);
    method(GaussLegendre6, systems, start, n);
    method(GeneralisedAlpha::new(n.setting()).functional(), systems, start, n);
    system.reset();
    let (state, input) = start;
    let (q, v, _) = Rk4::step(system, n.scalar(), state, input, n.scalar()).split();
    black_box(q.magnitude().len() + v.len());
    let outcome = Dop853::integrate(system, n.scalar(), state, input, n.scalar(), 5, |_, _| ());
    let _ = black_box(outcome.is_ok());
}

pub(super) fn differentiable<S: Differentiable<Scalar: Drawn> + SecondOrder>(
    system: &Bounded<S>,
    start: (&S::State, &S::Input),
    n: &Numbers,
) {
    method(Radau, (system, system), start, n);
    method(GeneralisedAlpha::new(n.setting()), (system, system), start, n);
}

pub(super) fn canonical<S: Canonical<Scalar: Drawn>>(system: &Bounded<S>, start: (&S::State, &S::Input), n: &Numbers) {
    method(SymplecticMidpoint, (system, system), start, n);
    method(SymplecticGauss4, (system, system), start, n);
    method(SymplecticGauss6, (system, system), start, n);
}

pub(super) fn separable<S: Separable<Scalar: Drawn>>(system: &Bounded<S>, start: (&S::State, &S::Input), n: &Numbers) {
    method(Verlet, (system, system), start, n);
    method(Composition4, (system, system), start, n);
    method(Composition6, (system, system), start, n);
}

/// By accuracy alone; a hundred thousand steps are allowed, so few cases are drawn.
pub(super) fn simulated<S: Differentiable<Scalar: Drawn>>(
    system: &Bounded<S>,
    (state, input): (&S::State, &S::Input),
    n: &Numbers,
) {
    for (t0, t1, accuracy) in [(n.setting(), n.setting(), n.setting()), (0.0, n.setting(), 1e-3), (0.0, 0.1, 1e-6)] {
        system.reset();
        ended(&simulate(system, t0, t1, state, input, accuracy, |_, _| ()));
        system.reset();
        let ends = simulate_lanes(system, t0, t1, state, input, accuracy, |_, _| ());
        assert!(ends.is_err() || ends.is_ok_and(|ends| finite(&ends.state) && !ends.lanes().is_empty()));
        system.reset();
        ended(&simulate_stiff(system, t0, t1, state, input, accuracy, |_, _| ()));
    }
}
