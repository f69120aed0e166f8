//! States that stay as they are: [`equilibrium`], at rest, and [`trim`], in a steady motion, with the exact derivatives of
//! [`Differentiable`].
//!
//! Asked for are zero accelerations, rates of speeds where velocities are speeds, and zero rates of own states. What may change are the position, as a displacement, own
//! states, and for a trim velocities and inputs, each component by a weight of its own. Each step is the least one,
//! weighted, that solves the linearised equations: their rows are made orthogonal one after the other, the least
//! dependent first (modified Gram-Schmidt with pivots, as in [`linear::least_norm`](crate::linear::least_norm)), so that
//! the condition is not squared, idle coordinates stay where they are, and the rank is known. Steps are limited to about
//! one radian and halved until the sum of squares falls (damped Gauss-Newton method; Nocedal and Wright, Numerical
//! Optimization, chapter 10), each equation divided by what it could be, `1 + sum_j |J_ij| (1 + |z_j|)`: so neither
//! masses nor stiffnesses decide what is near. Where nothing falls any more and the equations are dependent (a pendulum
//! held level), coordinates are shaken a little, by numbers that are the same in every run.
//!
//! ```
//! use multibody::{Differentiable, Jacobian, StateSpace, System, equilibrium, trim, Free};
//! # #[derive(Clone, Copy, Debug)]
//! # struct State { q: f64, v: f64 }
//! # impl StateSpace for State {
//! #     type Scalar = f64;
//! #     type Position = f64;
//! #     type Velocity = f64;
//! #     type Extra = ();
//! #     fn split(&self) -> (f64, f64, ()) { (self.q, self.v, ()) }
//! #     fn join(&self, q: f64, v: f64, (): ()) -> Self { Self { q, v } }
//! # }
//! /// A pendulum with a motor at its hinge; `emit derivatives` makes such a thing of a model.
//! struct Pendulum;
//! # impl System for Pendulum {
//! #     type Scalar = f64;
//! #     type State = State;
//! #     type Input = f64;
//! #     fn derivative(&self, _t: f64, x: &State, u: &f64) -> (f64, ()) { (-9.81 * x.q.sin() - x.v + u, ()) }
//! #     fn position_rates(&self, _t: f64, x: &State) -> f64 { x.v }
//! # }
//! # impl Differentiable for Pendulum {
//! #     type Matrix = [[f64; 1]; 1];
//! #     fn jacobian(&self, _t: f64, x: &State, _u: &f64) -> Jacobian<[[f64; 1]; 1]> {
//! #         Jacobian { position: [[-9.81 * x.q.cos()]], rates: [[-1.0]] }
//! #     }
//! #     fn input_derivative(&self, _t: f64, _x: &State, _u: &f64, change: &f64) -> (f64, ()) { (*change, ()) }
//! # }
//!
//! // Where it hangs under a moment of 3 N m.
//! let rest = equilibrium(&Pendulum, 0.0, &State { q: 0.2, v: 0.0 }, &3.0, &1.0)?;
//! assert!((9.81 * rest.state.q.sin() - 3.0).abs() < 1e-12 && rest.rank == 1.0);
//!
//! // The moment that holds it at 0.5 rad: position and velocity stay, the input is free.
//! let held = trim(&Pendulum, 0.0, &State { q: 0.5, v: 0.0 }, &0.0, &Free { input: 1.0, ..Free::default() })?;
//! assert!((held.input - 9.81 * 0.5_f64.sin()).abs() < 1e-12);
//! # Ok::<(), multibody::EquilibriumError>(())
//! ```
//!
//! # Closed loops
//! Reduced models have none left. Of a model that keeps its loops, the accelerations are those along its constraints: see
//! [`constrained_equilibrium`].

mod closing;
mod error;
mod least;
mod search;

pub use error::EquilibriumError;

use crate::{Constrained, Differentiable, DisplacementOf, ExtraOf, Real, StateSpace, System, Tangent, VelocityOf, all};
use closing::{Loops, Open};
use search::{Held, Search, Turned};

/// What may change in the search for a [`trim`]: zero where a component is held, one where it is free, other positive
/// numbers where it is to change more or less willingly. By default nothing is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Free<Q, V, X, U> {
    /// Displacements of the position.
    pub position: Q,
    /// Velocities.
    pub velocity: V,
    /// Own states.
    pub states: X,
    /// Inputs.
    pub input: U,
}

/// A state without accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilibrium<Z, U = (), T = f64> {
    /// The state.
    pub state: Z,
    /// The inputs that go with it; `()` where they were given.
    pub input: U,
    /// How many of the equations are independent for what is free, in each lane. Less than their number where coordinates
    /// are idle or constraints hold.
    pub rank: T,
    /// Greatest acceleration or rate that is left, in each lane.
    pub residual: T,
    /// Steps made, of the lane that took most.
    pub iterations: u32,
}

/// What a search for an equilibrium of `S` gives, with inputs of the type `U`.
pub type Found<S, U> = Result<Equilibrium<<S as System>::State, U, <S as System>::Scalar>, EquilibriumError>;

/// A state of rest near `guess`, under the given input, at the time `t` `[s]`: no velocities, no accelerations, no rates of
/// own states.
///
/// `free` says which positions may change: one where they may, zero where they are held. Own states always may. Which of
/// several equilibria is found is up to the guess, and nothing says whether it is stable. See the [module](self) for an
/// example.
///
/// # Errors
/// See [`EquilibriumError`]; one is given if any lane fails, or if loops are open where accelerations vanish: by what is free, if they hold by
/// multipliers, or since an iteration has not converged.
pub fn equilibrium<S: Differentiable>(
    system: &S,
    t: S::Scalar,
    guess: &S::State,
    input: &S::Input,
    free: &DisplacementOf<S>,
) -> Found<S, ()> {
    let found = Search::run(system, &Held(input), &Open, t, &resting::<S>(guess), (), &at_rest::<S>(free))?;
    closed(system, t, input, standing(system, t, found)?)
}

/// A steady motion near `guess` at the time `t` `[s]`: no accelerations and no rates of own states. What is free, of
/// position, velocity, own states and inputs, is up to the caller; the rest stays as in the guess.
///
/// Steady flight, a turning governor, the voltage for a speed, a bicycle that goes round in circles: positions that go on changing, such
/// as the angle of a shaft or the place of a vehicle, are to be held, and so are velocities that tell of others, where these are to
/// stay. Accelerations are those of the model's velocities: a vehicle's are steady in a turn where they are its speeds, not the rates of
/// its place, so constraints are to be solved (`constraints: Reduced`).
///
/// # Errors
/// See [`EquilibriumError`]; one is given if any lane fails, or if loops are open in the end: by what is free, if they hold by
/// multipliers, or since an iteration has not converged.
pub fn trim<S: Differentiable>(
    system: &S,
    t: S::Scalar,
    guess: &S::State,
    input: &S::Input,
    free: &Free<DisplacementOf<S>, VelocityOf<S>, ExtraOf<S>, S::Input>,
) -> Found<S, S::Input>
where
    S::Input: Tangent<S::Scalar>,
{
    let found = Search::run(system, &Turned, &Open, t, guess, *input, free)?;
    let input = found.input;
    closed(system, t, &input, found)
}

/// What was found, if no loop is open there.
fn closed<S: System, U>(
    system: &S,
    t: S::Scalar,
    input: &S::Input,
    found: Equilibrium<S::State, U, S::Scalar>,
) -> Found<S, U> {
    let opening = system.opening(t, &found.state, input);
    if opening.is_open() {
        return Err(EquilibriumError::Open { gap: opening.residual.greatest(), iterations: found.iterations });
    }
    Ok(found)
}

/// The same as [`equilibrium`] for a model with constraints: they are closed, too. Where one moves by itself, as a plane that turns below a
/// wheel or a rod whose length follows the time, nothing is at rest.
///
/// Each step has two parts: the correction that closes the loops, and a displacement along them, for which the rows of the
/// derivatives are projected onto displacements that keep the constraints.
///
/// # Errors
/// See [`EquilibriumError`]; one is given if any lane fails.
pub fn constrained_equilibrium<S: Differentiable + Constrained>(
    system: &S,
    t: S::Scalar,
    guess: &S::State,
    input: &S::Input,
    free: &DisplacementOf<S>,
) -> Found<S, ()> {
    let found = Search::run(system, &Held(input), &Loops(system), t, &resting::<S>(guess), (), &at_rest::<S>(free))?;
    standing(system, t, found)
}

/// `[m/s]`, `[rad/s]` rates below this are those of rest, and so are rates of rates.
const REST: f64 = 1e-8;

/// What was found, if positions rest while velocities and accelerations are zero. They do where velocities are the rates of coordinates;
/// else there may be a share of time in `q' = N(q) u + n(q, t)`, which is q' then, and whose derivative by time is q''.
fn standing<S: System>(system: &S, t: S::Scalar, found: Equilibrium<S::State, (), S::Scalar>) -> Found<S, ()> {
    let share = |t: S::Scalar| system.position_rates(t, &found.state);
    let step = Real::sqrt(Real::sqrt(S::Scalar::epsilon())) * (S::Scalar::lit(1.0) + Real::abs(t));
    let apart = share(t + step).add_scaled(S::Scalar::lit(-1.0), &share(t - step));
    let change = apart.scale(S::Scalar::lit(0.5) / step);
    let roundings = S::Scalar::lit(16.0) * S::Scalar::epsilon();
    let rest = |rounding: S::Scalar| Real::max(S::Scalar::lit(REST), rounding);
    let (rates, leaves) = (share(t), rest(roundings / step));
    // The greatest, and no number if one is none.
    let worst = |v: &DisplacementOf<S>| {
        v.fold(S::Scalar::lit(0.0), &mut |worst, x| {
            let size = Real::abs(x);
            Real::select(Real::gt(size, worst) | Real::ne(size, size), size, worst)
        })
    };
    let (rate, acceleration) = (worst(&rates), worst(&change));
    if !all(Real::is_finite(rate) & Real::is_finite(acceleration)) {
        return Err(EquilibriumError::NotFinite);
    }
    if !all(Real::le(rate, rest(roundings))) {
        return Err(EquilibriumError::Moving { rate: rate.greatest() });
    }
    if !all(Real::le(acceleration, leaves)) {
        return Err(EquilibriumError::Leaving { acceleration: acceleration.greatest() });
    }
    Ok(found)
}

/// A state without velocities.
fn resting<S: System>(state: &S::State) -> S::State {
    let (q, _, x) = state.split();
    state.join(q, Tangent::zero(), x)
}

/// Positions and own states are free.
fn at_rest<S: System>(position: &DisplacementOf<S>) -> Free<DisplacementOf<S>, VelocityOf<S>, ExtraOf<S>, ()> {
    let states = ExtraOf::<S>::zero().map(&mut |_| S::Scalar::lit(1.0));
    Free { position: *position, velocity: Tangent::zero(), states, input: () }
}

impl<T: Real, Q: Tangent<T>, V: Tangent<T>, X: Tangent<T>, U: Tangent<T>> Tangent<T> for Free<Q, V, X, U> {
    #[inline]
    fn zero() -> Self {
        Self { position: Q::zero(), velocity: V::zero(), states: X::zero(), input: U::zero() }
    }
    #[inline]
    fn zip<F: FnMut(T, T) -> T>(&self, other: &Self, f: &mut F) -> Self {
        Self {
            position: self.position.zip(&other.position, f),
            velocity: self.velocity.zip(&other.velocity, f),
            states: self.states.zip(&other.states, f),
            input: self.input.zip(&other.input, f),
        }
    }
    #[inline]
    fn fold<A, F: FnMut(A, T) -> A>(&self, start: A, f: &mut F) -> A {
        let start = self.position.fold(start, f);
        let start = self.velocity.fold(start, f);
        let start = self.states.fold(start, f);
        self.input.fold(start, f)
    }
}
