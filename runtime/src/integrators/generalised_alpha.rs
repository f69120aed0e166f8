//! The generalised-alpha method: [`GeneralisedAlpha`], for reduced systems and for constrained ones.
//!
//! Chung and Hulbert (1993), A time integration algorithm for structural dynamics with improved numerical dissipation; on
//! Lie groups and with constraints after Arnold and Brüls (2007), Convergence of the generalized-alpha scheme for
//! constrained mechanical systems, and Brüls, Cardona and Arnold (2012), Lie group generalized-alpha time integration of
//! constrained flexible multibody systems. With accelerations `f(t, q, v)` and vectors `a` that lag behind them:
//!
//! ```text
//! q1 = q0 exp(h v0 + h^2 ((1/2 - beta) a0 + beta a1))        (1 - am) a1 + am a0 = (1 - af) f1 + af f0
//! v1 = v0 + h ((1 - gamma) a0 + gamma a1)
//! am = (2 r - 1) / (r + 1),   af = r / (r + 1),   gamma = 1/2 + af - am,   beta = (1/2 + gamma)^2 / 4
//! ```
//!
//! Own states go with `v`, after Jansen, Whiting and Hulbert (2000).
//!
//! Constraints are kept in position and in velocity (stabilised index 2; Arnold, Cardona and Brüls 2015, Order reduction
//! in time integration caused by velocity projection): `q1` and `f1` have terms `M^-1 G^T mu` and `M^-1 G^T lambda` of
//! their own, with `Phi(q1) = 0` and `G v1 + dPhi/dt = 0`. The index-3 form keeps positions alone and projects velocities
//! afterwards, which can cost an order.

use super::method::{Accepted, Attempt, Method};
use super::problem::{Problem, Step};
use super::slope::{SlopeOf, displaced};
use crate::linear::Square;
use crate::tangent::{greatest, unpack};
use crate::{
    Constrained, Differentiable, ExtraOf, Impulsive, JacobianMatrix, Real, SecondOrder, StateSpace, System, Tangent,
    VelocityOf,
};

/// Derivatives are renewed where a change is more than this share of the one before.
const SLOW: f64 = 0.1;
/// Greatest number of iterations of a step.
const ITERATIONS: u32 = 50;
/// Iterations end where velocities change by fewer roundings than this..
const ROUNDINGS: f64 = 4.0;
/// ..or, where rounding is greater, by no less than before and by fewer than this, up to the root of one.
const STALLED: f64 = 4e5;

/// The generalised-alpha method: second order, implicit, damping high frequencies as much as asked for and low ones as
/// little as possible.
///
/// The spectral radius at infinite frequency is what is left of a fast vibration after each step: 1 damps nothing, 0.8 is
/// a common choice, 0 removes it at once. Steps are given; there is no estimate of the error.
///
/// Steps should be of one length: by how much `a` lags behind the accelerations depends on it, so a shorter last step, or
/// the start anew after an event, costs an order there. A projection after a step does not renew that lag.
///
/// Velocities have to be the rates of coordinates ([`SecondOrder`]).
///
/// States within a step are those of a cubic through both ends and the slopes there: of second order, as its ends are.
///
/// - [`GeneralisedAlpha::new`]: systems without constraints, or with loops solved, by Newton's method with the exact
///   derivatives ([`Differentiable`], `emit derivatives`).
/// - [`GeneralisedAlpha::constrained`]: systems with constraints ([`Constrained`] and [`Impulsive`], `emit impulse`).
///   Positions and velocities satisfy them after every step to rounding; redundant equations are harmless.
/// - [`GeneralisedAlpha::functional`]: either of them without derivatives, by functional iteration, for systems that are
///   not stiff.
///
/// ```
/// use multibody::{Differentiable, GeneralisedAlpha, Integrator, Jacobian, StateSpace, System};
///
/// #[derive(Clone, Copy)]
/// struct State { q: f64, v: f64 }
///
/// impl StateSpace for State {
///     type Scalar = f64;
///     type Position = f64;
///     type Velocity = f64;
///     type Extra = ();
///     fn split(&self) -> (f64, f64, ()) { (self.q, self.v, ()) }
///     fn join(&self, q: f64, v: f64, (): ()) -> Self { Self { q, v } }
/// }
///
/// struct Oscillator { frequency: f64 }
///
/// impl System for Oscillator {
///     type Scalar = f64;
///     type State = State;
///     type Input = ();
///     fn derivative(&self, _t: f64, x: &State, (): &()) -> (f64, ()) { (-self.frequency.powi(2) * x.q, ()) }
///     fn position_rates(&self, _t: f64, x: &State) -> f64 { x.v }
/// }
///
/// impl Differentiable for Oscillator {
///     type Matrix = [[f64; 1]; 1];
///     fn jacobian(&self, _t: f64, _x: &State, (): &()) -> Jacobian<[[f64; 1]; 1]> {
///         Jacobian { position: [[-self.frequency.powi(2)]], rates: [[0.0]] }
///     }
///     fn input_derivative(&self, _t: f64, _x: &State, (): &(), (): &()) -> (f64, ()) { (0.0, ()) }
/// }
///
/// let method = GeneralisedAlpha::new(0.8);
/// let start = State { q: 1.0, v: 0.0 };
/// let (slow, _) = Integrator::fixed(method, 1e-2).integrate(&Oscillator { frequency: 1.0 }, 0.0, 1.0, &start, &(), |_, _| ())?;
/// assert!((slow.q - 1.0_f64.cos()).abs() < 2e-5);
/// let (fast, _) = Integrator::fixed(method, 1e-2).integrate(&Oscillator { frequency: 1e5 }, 0.0, 1.0, &start, &(), |_, _| ())?;
/// assert!(fast.q.abs() < 1e-6);
/// # Ok::<(), multibody::IntegrationError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneralisedAlpha<C = Reduced, I = Newton> {
    /// What is left of an infinitely fast vibration after a step, from zero to one.
    pub spectral_radius: f64,
    closing: C,
    iteration: I,
}

impl GeneralisedAlpha {
    /// For reduced systems, by Newton's method. A spectral radius outside of zero to one is taken as the nearer of the
    /// two.
    pub const fn new(spectral_radius: f64) -> Self {
        Self { spectral_radius, closing: Reduced, iteration: Newton }
    }
}

impl<C, I> GeneralisedAlpha<C, I> {
    /// The same for systems with constraints.
    #[must_use]
    pub fn constrained(self) -> GeneralisedAlpha<Multipliers, I> {
        GeneralisedAlpha { spectral_radius: self.spectral_radius, closing: Multipliers, iteration: self.iteration }
    }

    /// The same without derivatives: converges where `h` times the fastest frequency is below one.
    #[must_use]
    pub fn functional(self) -> GeneralisedAlpha<C, Functional> {
        GeneralisedAlpha { spectral_radius: self.spectral_radius, closing: self.closing, iteration: Functional }
    }
}

/// Without constraints: see [`GeneralisedAlpha::new`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reduced;

/// With constraints: see [`GeneralisedAlpha::constrained`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Multipliers;

/// Newton's method: see [`GeneralisedAlpha::new`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Newton;

/// Functional iteration: see [`GeneralisedAlpha::functional`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Functional;

/// How steps keep constraints: [`Reduced`], [`Multipliers`].
pub trait Closing<S: System>: Copy {
    /// The displacement along `M^-1 G^T` that closes the position at the end of a step.
    fn position(&self, system: &S, t: S::Scalar, state: &S::State) -> VelocityOf<S>;
    /// The change of the velocity along `M^-1 G^T` that closes its rates.
    fn velocity(&self, system: &S, t: S::Scalar, state: &S::State) -> VelocityOf<S>;
}

impl<S: System> Closing<S> for Reduced {
    #[inline]
    fn position(&self, _: &S, _: S::Scalar, _: &S::State) -> VelocityOf<S> {
        Tangent::zero()
    }
    #[inline]
    fn velocity(&self, _: &S, _: S::Scalar, _: &S::State) -> VelocityOf<S> {
        Tangent::zero()
    }
}

impl<S: Constrained + Impulsive<Rates = <S as Constrained>::Residual>> Closing<S> for Multipliers {
    #[inline]
    fn position(&self, system: &S, t: S::Scalar, state: &S::State) -> VelocityOf<S> {
        let (q, _, _) = state.split();
        let open = system.constraints(t, &q).map(&mut |x| -x);
        system.jump(t, state, &Tangent::zero(), &open).0
    }
    #[inline]
    fn velocity(&self, system: &S, t: S::Scalar, state: &S::State) -> VelocityOf<S> {
        let open = system.constraint_rate(t, state).map(&mut |x| -x);
        system.jump(t, state, &Tangent::zero(), &open).0
    }
}

/// How steps find their solution: [`Newton`], [`Functional`].
pub trait Iterating<S: System>: Copy {
    /// What is prepared once in a step, and again where iterations are slow.
    type Operator: Copy;
    /// The operator `own - position * df/dq - rate * df/dv` at a state.
    fn prepare(
        &self,
        problem: &Problem<'_, S>,
        t: S::Scalar,
        state: &S::State,
        factors: [S::Scalar; 3],
    ) -> Self::Operator;
    /// The solution for a right side.
    fn solve(&self, operator: &Self::Operator, right: &RatesOf<S>) -> RatesOf<S>;
}

impl<S: System> Iterating<S> for Functional {
    type Operator = S::Scalar;
    #[inline]
    fn prepare(&self, _: &Problem<'_, S>, _: S::Scalar, _: &S::State, [own, ..]: [S::Scalar; 3]) -> S::Scalar {
        S::Scalar::lit(1.0) / own
    }
    #[inline]
    fn solve(&self, inverse: &S::Scalar, right: &RatesOf<S>) -> RatesOf<S> {
        right.scale(*inverse)
    }
}

impl<S: Differentiable> Iterating<S> for Newton {
    type Operator = S::Matrix;
    fn prepare(
        &self,
        problem: &Problem<'_, S>,
        t: S::Scalar,
        state: &S::State,
        [own, position, rate]: [S::Scalar; 3],
    ) -> S::Matrix {
        let jacobian = problem.jacobian(t, state);
        S::Matrix::from_fn(|i, j| {
            let diagonal = if i == j { own } else { S::Scalar::lit(0.0) };
            diagonal - position * S::Matrix::by_position(&jacobian, i, j) - rate * S::Matrix::by_rates(&jacobian, i, j)
        })
    }
    fn solve(&self, operator: &S::Matrix, right: &RatesOf<S>) -> RatesOf<S> {
        unpack(operator.solution(&S::Matrix::packed(right)).0.as_ref())
    }
}

/// Rates of velocities and own states.
pub type RatesOf<S> = (VelocityOf<S>, ExtraOf<S>);

/// What passes from one step to the next.
#[derive(Clone, Copy, Debug)]
pub struct Lag<R> {
    /// Rates at the end of the last step, with the forces of constraint of the step.
    rates: R,
    /// What lags behind them.
    lagging: R,
}

/// The coefficients for a spectral radius.
#[derive(Clone, Copy)]
struct Coefficients {
    mass: f64,
    force: f64,
    beta: f64,
    gamma: f64,
}

impl Coefficients {
    fn new(radius: f64) -> Self {
        let radius = Real::max(0.0, Real::min(radius, 1.0));
        let (mass, force) = ((2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0));
        let gamma = 0.5 + force - mass;
        Self { mass, force, beta: 0.25 * (0.5 + gamma) * (0.5 + gamma), gamma }
    }
}

impl<S: SecondOrder, C: Closing<S>, I: Iterating<S>> Method<S> for GeneralisedAlpha<C, I> {
    const ORDER: u32 = 2;
    type Memory = Lag<RatesOf<S>>;
    type Details = Lag<RatesOf<S>>;

    fn begin(&self, problem: &Problem<'_, S>, t: S::Scalar, state: &S::State) -> Lag<RatesOf<S>> {
        let rates = problem.derivative(t, state);
        Lag { rates, lagging: rates }
    }

    fn attempt(
        &self,
        problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        memory: &Lag<RatesOf<S>>,
    ) -> Attempt<S, Lag<RatesOf<S>>> {
        let Coefficients { mass, force, beta, gamma } = Coefficients::new(self.spectral_radius);
        let lit = S::Scalar::lit;
        let (dt, system) = (step.dt, problem.system);
        let (_, v, _) = step.state.split();
        let Lag { rates: first, lagging } = *memory;
        // The displacement of the step, for the lagging rates at its end and what closes the position.
        let over = |last: &RatesOf<S>, closing: &VelocityOf<S>| {
            let mean = lagging.scale(lit(0.5 - beta)).add_scaled(lit(beta), last).0;
            let (dv, x) = lagging.scale(lit(1.0 - gamma)).add_scaled(lit(gamma), last).scale(dt);
            SlopeOf::<S> { q: S::as_displacement(v.add_scaled(dt, &mean).scale(dt).add(closing)), v: dv, x }
        };

        let factors = [lit(1.0 - mass), lit((1.0 - force) * beta) * dt * dt, lit((1.0 - force) * gamma) * dt];
        let known = first.scale(lit(force)).add_scaled(lit(-mass), &lagging);
        let mut last = lagging;
        let (mut closing, mut push) = (VelocityOf::<S>::zero(), VelocityOf::<S>::zero());
        // Derivatives belong to the end: directions that constraints leave free may have turned, and stiff ones must not.
        let guess = displaced(step.state, &over(&last, &closing));
        let mut operator = self.iteration.prepare(problem, step.end, &guess, factors);
        let mut rates = first;
        let epsilon = S::Scalar::epsilon().greatest();
        let (mut before, mut converged) = (f64::INFINITY, false);
        for _ in 0..ITERATIONS {
            let state = displaced(step.state, &over(&last, &closing));
            closing = closing.add(&self.closing.position(system, step.end, &state));
            let (accel, own) = problem.derivative(step.end, &state);
            rates = (accel.add(&push), own);
            let left = rates.scale(lit(1.0 - force)).add(&known).add_scaled(lit(mass - 1.0), &last);
            let mut change = self.iteration.solve(&operator, &left);
            // The forces of constraint follow the velocity that they have to close.
            let moved = displaced(step.state, &over(&last.add(&change), &closing));
            let closed = self.closing.velocity(system, step.end, &moved).scale(lit(1.0) / (lit(gamma) * dt));
            push = push.add_scaled(lit((1.0 - mass) / (1.0 - force)), &closed);
            change.0 = change.0.add(&closed);
            last = last.add(&change);

            let (_, now, own) = moved.split();
            let scale = greatest(&(now, own)) + lit(1.0);
            let size = (greatest(&change) * Real::abs(dt) / scale).greatest();
            let stalled = size >= 0.5 * before && size <= Real::min(STALLED * epsilon, Real::sqrt(epsilon));
            converged = size <= ROUNDINGS * epsilon || stalled;
            if converged || !size.is_finite() || size > 1e6 * before {
                break;
            }
            if size > SLOW * before {
                operator = self.iteration.prepare(problem, step.end, &moved, factors);
            }
            before = size;
        }
        // Both once more, since the state has moved with the last change.
        let state = displaced(step.state, &over(&last, &closing));
        let closing = closing.add(&self.closing.position(system, step.end, &state));
        let state = displaced(step.state, &over(&last, &closing));
        let closed = self.closing.velocity(system, step.end, &state).scale(lit(1.0) / (lit(gamma) * dt));
        rates.0 = rates.0.add_scaled(lit((1.0 - mass) / (1.0 - force)), &closed);
        let mut d = over(&last, &closing);
        d.v = d.v.add_scaled(lit(gamma) * dt, &closed);
        last.0 = last.0.add(&closed);
        Attempt { converged, ..Attempt::new(d, Lag { rates, lagging: last }) }
    }

    fn proceed(
        &self,
        _problem: &Problem<'_, S>,
        _step: &Step<'_, S>,
        _memory: &Lag<RatesOf<S>>,
        attempt: &Attempt<S, Lag<RatesOf<S>>>,
        _next: &Accepted<S>,
    ) -> Lag<RatesOf<S>> {
        attempt.details
    }
}
