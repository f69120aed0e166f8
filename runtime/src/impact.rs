//! Impulses and impacts: velocities that jump while positions stay.
//!
//! An impulse is the integral of a force that acts for no time. Velocities answer to it at once, and bars and loops pass
//! it on: [`Impulsive::jump`] (`emit impulse`) solves `M d + G^T mu = impulse, G d = 0`. What strikes what is a
//! *direction* in the space of velocities, a row `n` such that `n v` is the rate at which two things part: one in the
//! field of a joint, or for a frame [`along`] an axis by the frame's Jacobian. An impulse along it acts as `n^T P`.
//!
//! Newton's law of impact: where the rate is negative before, it is `-e` times that afterwards, with the coefficient of
//! restitution `e`, by an impulse `P >= 0` that only pushes. Then `P (1 - e) / 2` times the speed of approach before is the
//! energy that is lost, so for `e` from zero to one none is gained. Friction is left to forces.
//!
//! ```
//! # mod ball {
//! # use multibody::{Impulsive, StateSpace, System, nalgebra::Vector2};
//! # #[derive(Clone, Copy)]
//! # pub struct State { pub q: Vector2<f64>, pub v: Vector2<f64> }
//! # impl StateSpace for State {
//! #     type Scalar = f64;
//! #     type Position = Vector2<f64>;
//! #     type Velocity = Vector2<f64>;
//! #     type Extra = ();
//! #     fn split(&self) -> (Vector2<f64>, Vector2<f64>, ()) { (self.q, self.v, ()) }
//! #     fn join(&self, q: Vector2<f64>, v: Vector2<f64>, (): ()) -> Self { Self { q, v } }
//! # }
//! # pub struct Ball { pub mass: f64 }
//! # impl System for Ball {
//! #     type Scalar = f64;
//! #     type State = State;
//! #     type Input = ();
//! #     fn derivative(&self, _t: f64, _state: &State, (): &()) -> (Vector2<f64>, ()) { (Vector2::new(0.0, -9.81), ()) }
//! #     fn position_rates(&self, _t: f64, state: &State) -> Vector2<f64> { state.v }
//! # }
//! # impl Impulsive for Ball {
//! #     type Rates = ();
//! #     fn jump(&self, _t: f64, _state: &State, impulse: &Vector2<f64>, (): &()) -> (Vector2<f64>, f64) {
//! #         (impulse / self.mass, 0.0)
//! #     }
//! # }
//! # }
//! use ball::{Ball, State}; // in x and y, without spin
//! use multibody::{impact::impact, nalgebra::Vector2};
//!
//! let falling = State { q: Vector2::new(0.0, 0.0), v: Vector2::new(1.0, -2.0) };
//! let hit = impact(&Ball { mass: 0.5 }, 0.0, &falling, &Vector2::new(0.0, 1.0), 0.8)?; // the floor pushes along y
//! assert_eq!(hit.state.v, Vector2::new(1.0, 1.6));
//! assert_eq!(hit.impulse, 0.5 * 3.6);
//! # Ok::<(), multibody::impact::ImpactError>(())
//! ```

mod error;

pub use error::ImpactError;

use crate::linear::solve_symmetric;
use crate::{Configuration, Impulsive, Real, StateSpace, Tangent, VelocityOf, all};
use nalgebra::{SMatrix, SVector};

/// What an impulse did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impulse<Z, T = f64> {
    /// The state after it.
    pub state: Z,
    /// How many of the equations between coordinates are independent at this position; zero where there are none.
    pub rank: T,
}

/// What an impact did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<Z, T = f64> {
    /// The state after it.
    pub state: Z,
    /// `[N s]` or `[N m s]` the impulse along the direction, never negative; zero where nothing struck.
    pub impulse: T,
    /// `[m/s]` or `[rad/s]` the rate along the direction before; negative where something approaches.
    pub before: T,
    /// `[m/s]` or `[rad/s]` the rate afterwards.
    pub after: T,
    /// How many of the equations between coordinates are independent at this position; zero where there are none.
    pub rank: T,
}

/// What several impacts at one time did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impacts<Z, T, const N: usize> {
    /// The state after them.
    pub state: Z,
    /// `[N s]` or `[N m s]` the impulse along each direction, never negative but for rounding.
    pub impulses: [T; N],
    /// `[m/s]` or `[rad/s]` the rates along the directions before.
    pub before: [T; N],
    /// `[m/s]` or `[rad/s]` the rates afterwards.
    pub after: [T; N],
}

/// The direction in which a frame moves along an axis: the row `axis^T J` with the frame's Jacobian `J` (an output
/// `frame.jacobian`: linear rows, then angular, in world axes).
///
/// A 3-vector takes the linear rows alone. It is also the generalised impulse of the impulse `axis` at the frame.
///
/// ```
/// use multibody::{impact::along, nalgebra::{Matrix3x2, Vector2, Vector3}};
///
/// let jacobian = Matrix3x2::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
/// let row: Vector2<f64> = along(&jacobian, &Vector3::new(0.0, 1.0, 0.0));
/// assert_eq!(row, Vector2::new(3.0, 4.0));
/// ```
#[inline]
pub fn along<T: Real, V: Tangent<T>, const A: usize, const R: usize, const N: usize>(
    jacobian: &SMatrix<T, R, N>,
    axis: &SVector<T, A>,
) -> V {
    let mut columns = jacobian.data.0.iter();
    V::zero().map(&mut |zero| {
        let Some(column) = columns.next() else { return zero };
        column.iter().zip(axis.as_slice()).fold(zero, |sum, (&j, &axis)| sum + j * axis)
    })
}

/// The state after the generalised impulse `impulse`, `[N s]` or `[N m s]` for each coordinate: at a joint that is one
/// field. For an impulse at a frame see [`impulse_at`].
///
/// # Errors
/// See [`ImpactError`].
#[inline]
pub fn impulse<S: Impulsive>(
    system: &S,
    t: S::Scalar,
    state: &S::State,
    impulse: &VelocityOf<S>,
) -> Result<Impulse<S::State, S::Scalar>, ImpactError> {
    let (q, v, x) = state.split();
    let (jump, rank) = system.jump(t, state, impulse, &S::Rates::zero());
    Ok(Impulse { state: finite(state.join(q, v.add(&jump), x))?, rank })
}

/// The state after an impulse at a frame: `[N s]` in world axes, at the frame's origin, or six components with moments
/// `[N m s]` behind. `jacobian` is the frame's, see [`along`].
///
/// # Errors
/// See [`ImpactError`].
#[inline]
pub fn impulse_at<S: Impulsive, const A: usize, const R: usize, const N: usize>(
    system: &S,
    t: S::Scalar,
    state: &S::State,
    jacobian: &SMatrix<S::Scalar, R, N>,
    at: &SVector<S::Scalar, A>,
) -> Result<Impulse<S::State, S::Scalar>, ImpactError> {
    impulse(system, t, state, &along(jacobian, at))
}

/// The state after an impact along a direction, with a coefficient of restitution from zero (plastic) to one (elastic).
///
/// Positive along the direction is where the impulse pushes, and away from what is struck. Nothing changes where the
/// rate is not negative, or where the constraints let nothing move along the direction.
///
/// # Errors
/// See [`ImpactError`].
#[inline]
pub fn impact<S: Impulsive>(
    system: &S,
    t: S::Scalar,
    state: &S::State,
    direction: &VelocityOf<S>,
    restitution: S::Scalar,
) -> Result<Impact<S::State, S::Scalar>, ImpactError> {
    let (_, v, _) = state.split();
    impact_at_rate(system, t, state, direction, dot(direction, &v), restitution)
}

/// The same where the rate is not that of the velocities alone: what is struck moves on its own, or a drive moves what
/// strikes. `rate` is the rate along the direction before, `[m/s]` or `[rad/s]`.
///
/// # Errors
/// See [`ImpactError`].
#[inline]
pub fn impact_at_rate<S: Impulsive>(
    system: &S,
    t: S::Scalar,
    state: &S::State,
    direction: &VelocityOf<S>,
    rate: S::Scalar,
    restitution: S::Scalar,
) -> Result<Impact<S::State, S::Scalar>, ImpactError> {
    let (zero, one) = (S::Scalar::lit(0.0), S::Scalar::lit(1.0));
    let (q, v, x) = state.split();
    let (jump, rank) = system.jump(t, state, direction, &S::Rates::zero());
    let answer = dot(direction, &jump);
    let idle = Real::ge(rate, zero) | Real::le(answer, rounding(direction, &jump));
    let impulse = Real::select(idle, zero, -(one + restitution) * rate / Real::select(idle, one, answer));
    // Where nothing strikes, what is not finite is not taken for rest.
    let impulse = impulse + residue(rate) + residue(answer) + residue(restitution);
    let v = v.add_scaled(impulse, &jump);
    let state = finite(state.join(q, v, x))?;
    Ok(Impact { state, impulse, before: rate, after: rate + impulse * answer, rank })
}

/// The state after impacts along several directions at one time, with one coefficient of restitution: a box that falls
/// flat, a ball in a corner.
///
/// Newton's law in the form of Moreau: `P >= 0`, `after + e before >= 0`, and one of the two is zero. Where directions
/// are dependent (a table with four legs), the impulses are one choice of many and the motion is the same.
///
/// A direction that parts before (`before > 0`) may approach afterwards, at up to `e` times that rate, where the others
/// throw it back: to ask for `after >= 0` there would gain energy. It strikes next, at the same time: call this again
/// until no rate in `after` is negative.
///
/// All subsets of the directions are tried, of which there may be eight at most, so that lanes need no branch.
///
/// # Errors
/// See [`ImpactError`].
pub fn impacts<S: Impulsive, const N: usize>(
    system: &S,
    t: S::Scalar,
    state: &S::State,
    directions: &[VelocityOf<S>; N],
    restitution: S::Scalar,
) -> Result<Impacts<S::State, S::Scalar, N>, ImpactError> {
    const { assert!(N <= 8, "at most eight directions strike at one time") };
    let (zero, one) = (S::Scalar::lit(0.0), S::Scalar::lit(1.0));
    let (q, v, x) = state.split();
    let jumps = (*directions).map(|n| system.jump(t, state, &n, &S::Rates::zero()).0);
    let before = (*directions).map(|n| dot(&n, &v));
    let answers = (*directions).map(|n| jumps.map(|jump| dot(&n, &jump)));
    let locked: [_; N] = core::array::from_fn(|i| match (directions.get(i), jumps.get(i)) {
        (Some(n), Some(jump)) => Real::le(dot(n, jump), rounding(n, jump)),
        _ => Real::le(zero, zero),
    });

    let (mut impulses, mut least) = ([zero; N], S::Scalar::lit(f64::INFINITY));
    for subset in 0..1_u32 << N {
        let struck = |i: usize| subset >> i & 1 == 1;
        let mut matrix = answers;
        let mut right = before.map(|rate| -(one + restitution) * rate);
        for (i, (row, right)) in matrix.iter_mut().zip(&mut right).enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                if !(struck(i) && struck(j)) {
                    *entry = if i == j { one } else { zero };
                }
            }
            if !struck(i) {
                *right = zero;
            }
        }
        let (found, _) = solve_symmetric(matrix, right);
        let mut violation = zero;
        let rows = answers.iter().zip(&before).zip(found.iter().zip(&locked)).enumerate();
        for (i, ((row, &rate), (&impulse, &locked))) in rows {
            let change = row.iter().zip(&found).fold(zero, |sum, (&w, &p)| sum + w * p);
            let wanting = -((one + restitution) * rate + change);
            let own = row.get(i).copied().unwrap_or(zero);
            let pulling = Real::select(locked, S::Scalar::lit(f64::INFINITY), -impulse * own);
            let wanting = Real::select(locked, zero, wanting);
            violation = Real::max(violation, if struck(i) { pulling } else { wanting });
        }
        let better = Real::lt(violation, least);
        least = Real::select(better, violation, least);
        for (best, found) in impulses.iter_mut().zip(found) {
            *best = Real::select(better, found, *best);
        }
    }

    let poison = before.iter().zip(&answers).fold(residue(restitution), |sum, (&rate, row)| {
        row.iter().fold(sum + residue(rate), |sum, &w| sum + residue(w))
    });
    let impulses = impulses.map(|p| p + poison);
    let v = impulses.iter().zip(&jumps).fold(v, |v, (&p, jump)| v.add_scaled(p, jump));
    let after = (*directions).map(|n| dot(&n, &v));
    Ok(Impacts { state: finite(state.join(q, v, x))?, impulses, before, after })
}

/// The state, if all of it is finite.
fn finite<Z: StateSpace>(state: Z) -> Result<Z, ImpactError> {
    let (q, v, x) = state.split();
    if is_finite(&q.magnitude()) & is_finite(&v) & is_finite(&x) { Ok(state) } else { Err(ImpactError::NotFinite) }
}

fn is_finite<T: Real, V: Tangent<T>>(vector: &V) -> bool {
    vector.fold(true, &mut |finite, x| finite & all(Real::is_finite(x)))
}

/// `a b`.
#[inline]
fn dot<T: Real, V: Tangent<T>>(a: &V, b: &V) -> T {
    a.zip(b, &mut |a, b| a * b).fold(T::lit(0.0), &mut |sum, x| sum + x)
}

/// What `a b` may be by rounding alone.
#[inline]
fn rounding<T: Real, V: Tangent<T>>(a: &V, b: &V) -> T {
    T::lit(64.0) * T::epsilon() * a.zip(b, &mut |a, b| Real::abs(a * b)).fold(T::lit(0.0), &mut |sum, x| sum + x)
}

/// Zero, or NaN where `x` is not finite.
#[inline]
#[allow(clippy::eq_op)]
fn residue<T: Real>(x: T) -> T {
    x - x
}
