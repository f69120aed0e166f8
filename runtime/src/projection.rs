//! Keeps constraints satisfied: [`Projection`] after steps, [`assemble`] before the first one.
//!
//! Steps of an integrator keep constraints in their accelerations only, so positions and velocities drift away by the
//! error of the steps. A projection brings them back by the least displacement (Hairer, Lubich and Wanner, Geometric
//! Numerical Integration, section IV.4): positions by Newton's method, then velocities by one linear system. Both are
//! exact for the state they start from, so the order of a method stays what it is.
//!
//! ```
//! # mod bead {
//! # use multibody::{Constrained, StateSpace, System, linear::least_norm, nalgebra::{Vector1, Vector2}};
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
//! # pub struct Model;
//! # impl System for Model {
//! #     type Scalar = f64;
//! #     type State = State;
//! #     type Input = ();
//! #     fn derivative(&self, _t: f64, state: &State, (): &()) -> (Vector2<f64>, ()) {
//! #         let gravity = Vector2::new(0.0, -9.81);
//! #         (gravity - state.q * (gravity.dot(&state.q) + state.v.norm_squared()) / state.q.norm_squared(), ())
//! #     }
//! #     fn position_rates(&self, _t: f64, state: &State) -> Vector2<f64> { state.v }
//! # }
//! # impl Constrained for Model {
//! #     type Residual = f64;
//! #     fn constraints(&self, _t: f64, q: &Vector2<f64>) -> f64 { 0.5 * (q.norm_squared() - 1.0) }
//! #     fn constraint_rate(&self, _t: f64, state: &State) -> f64 { state.q.dot(&state.v) }
//! #     fn correction(&self, _t: f64, state: &State, r: &f64, weights: &Vector2<f64>) -> (Vector2<f64>, f64) {
//! #         least_norm(&state.q.transpose(), &Vector1::new(*r), weights)
//! #     }
//! #     fn velocity_correction(&self, t: f64, state: &State, r: &f64, weights: &Vector2<f64>) -> (Vector2<f64>, f64) {
//! #         self.correction(t, state, r, weights)
//! #     }
//! #     fn constraints_along(&self, t: f64, state: &State, d: &Vector2<f64>) -> f64 { self.constraint_rate_along(t, state, d) }
//! # }
//! # }
//! use bead::{Model, State}; // a bead on a ring of radius one, see `Constrained`
//! use multibody::{DormandPrince, Integrator, Projection, Rk4, WithProjection, assemble, nalgebra::Vector2};
//!
//! // From a rough guess; the height is held.
//! let guess = State { q: Vector2::new(0.9, -0.6), v: Vector2::new(1.0, 0.0) };
//! let assembled = assemble(&Model, 0.0, &guess, &Vector2::new(1.0, 0.0))?;
//! assert!((assembled.state.q.x - 0.8).abs() < 1e-12);
//!
//! // Steps of a given length, each with a projection after it.
//! let projection = Projection::default();
//! let mut x = assembled.state;
//! for k in 0..1000 {
//!     let t = 1e-2 * f64::from(k);
//!     x = Rk4::step(&Model, t, &x, &(), 1e-2);
//!     x = projection.project(&Model, t + 1e-2, &x)?.state;
//! }
//! assert!((x.q.norm() - 1.0).abs() < 1e-12 && x.q.dot(&x.v).abs() < 1e-12);
//!
//! // The same within any integrator.
//! let projected = WithProjection::new(&Model, projection);
//! let (y, _) = Integrator::adaptive(DormandPrince, 1e-9, 1e-9).integrate(&projected, 0.0, 10.0, &assembled.state, &(), |_, _| ())?;
//! assert!((y.q.norm() - 1.0).abs() < 1e-12 && (y.q - x.q).norm() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What is close enough
//! The greatest component of a residual counts, in metres and radians alike, and the tolerance is never below 16
//! roundings of one plus the greatest coordinate. Where even that is out of reach, because a model's lengths are far
//! greater than its coordinates, a position counts as closed when what Newton's method would still change is below the
//! rounding of the coordinates, and would close it.
//!
//! # Singular poses
//! Where constraints come to depend on each other, as in a parallelogram that lies flat, motions cross: the mechanism goes
//! on smoothly, but a residual, however small, makes the other motion turn off before it. Steps lead over such a pose; one
//! that ends so near that rounding decides which motion goes on ends in
//! [`IntegrationError::Ambiguous`](crate::IntegrationError::Ambiguous), or is tried shorter where steps are chosen by error.
//! [`ambiguity`] tells how near a position is. Not watched are single steps, and mechanisms of which
//! [`Constrained::tells_crossings`] is false. Where stages of a given step come near, its error grows, as everywhere near
//! such a pose: in `f32` within hundredths of a radian.
//!
//! # Lanes
//! Every lane is iterated as if it were alone: lanes that have converged stay where they are while others go on. An
//! error is given if any lane fails; [`Projection::project_fixed`] has no errors and reports lane by lane.

mod assembly;
mod baumgarte;
mod clarity;
mod error;
mod handed_on;
mod rank;
mod weighting;
mod wrapper;

pub use assembly::{Assembled, assemble, assemble_by};
pub use baumgarte::WithBaumgarte;
pub(crate) use clarity::TURNED;
pub use clarity::ambiguity;
pub use error::{AssemblyError, ProjectionError};
pub use rank::{WithRank, rank};
pub use weighting::{ByMass, Plain, SeparateWeights, Weighting, Weights};
pub use wrapper::WithProjection;

use crate::system::displacement_by;
use crate::tangent::greatest;
use crate::{
    Configuration, Constrained, DisplacementOf, Impulsive, PositionOf, Real, SecondOrder, StateSpace, System, Tangent,
    VelocityOf, all, any,
};
use clarity::{is_unclear, noticed};

/// Tolerances are at least this many roundings.
const ROUNDINGS: f64 = 16.0;
/// A residual of this many roundings is left as it is without being asked what it takes to close it.
const POLISHED: f64 = 0.25;
/// What would close a residual of rounding is done up to this many roundings of the coordinates.
const POLISHING: f64 = 100.0;

/// Brings states back to where the constraints are satisfied, after each step of an integrator.
///
/// Of all displacements that do so the least is taken: that of the least sum of squares, of metres and radians alike,
/// or weighted coordinate by coordinate, or by the mass matrix. See the [module](self) for an example.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// `[m]` or `[rad]`: greatest residual that a position may be left with. That of velocities, per second, is this times
    /// one plus the greatest velocity.
    pub tolerance: f64,
    /// Greatest number of Newton's iterations; with [`Projection::project_fixed`] exactly this many.
    pub iterations: u32,
    /// Whether positions are projected.
    pub position: bool,
    /// Whether velocities are projected.
    pub velocity: bool,
}

/// Positions and velocities, to 1e-12 and in at most 20 iterations.
impl Default for Projection {
    fn default() -> Self {
        Self { tolerance: 1e-12, iterations: 20, position: true, velocity: true }
    }
}

/// A state that satisfies the constraints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected<Z, T = f64> {
    /// The state.
    pub state: Z,
    /// How many of the equations are independent at this position, in each lane. Less than their number in a singular
    /// configuration, where bars come to lie in one line, and always less where equations repeat others.
    pub rank: T,
    /// `[m]` or `[rad]` greatest component of what is left of the position's residual, in each lane.
    pub residual: T,
    /// Newton's iterations, of the lane that took most.
    pub iterations: u32,
}

impl Projection {
    /// The state nearest to `state` that satisfies the constraints at the time `t` `[s]`. Own states are kept.
    ///
    /// A position is corrected once even where it is within the tolerance, and once more after a long correction, since near
    /// a singular pose a motion goes where the least residual leads it. Velocities are always corrected, so the rank is that
    /// of the final position.
    ///
    /// # Errors
    /// See [`ProjectionError`]; one is given if any lane fails.
    pub fn project<S: Constrained>(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
    ) -> Result<Projected<S::State, S::Scalar>, ProjectionError> {
        self.project_by(&Plain, system, t, state)
    }

    /// The same for other weights: the sum of `d^2 / weight` is least, and a coordinate of weight zero is held.
    ///
    /// With the inverses of masses and moments of inertia as weights, what is heavy moves less. Where velocities are not
    /// the rates of coordinates, take [`Projection::project_by`] with [`SeparateWeights`].
    ///
    /// # Errors
    /// See [`ProjectionError`].
    pub fn project_weighted<S: Constrained + SecondOrder>(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
        weights: &VelocityOf<S>,
    ) -> Result<Projected<S::State, S::Scalar>, ProjectionError> {
        self.project_by(&Weights(*weights), system, t, state)
    }

    /// The same weighted by the mass matrix: see [`ByMass`]. For models with `emit impulse`.
    ///
    /// # Errors
    /// See [`ProjectionError`].
    pub fn project_by_mass<S: Constrained + Impulsive<Rates = <S as Constrained>::Residual>>(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
    ) -> Result<Projected<S::State, S::Scalar>, ProjectionError> {
        self.project_by(&ByMass, system, t, state)
    }

    /// The same for any weighting.
    ///
    /// # Errors
    /// See [`ProjectionError`].
    pub fn project_by<S: Constrained>(
        &self,
        weighting: &impl Weighting<S>,
        system: &S,
        t: S::Scalar,
        state: &S::State,
    ) -> Result<Projected<S::State, S::Scalar>, ProjectionError> {
        self.run(weighting, system, t, state).check()
    }

    /// Exactly [`Projection::iterations`] corrections of the position and one of the velocities, whatever the numbers:
    /// no branch depends on them, and every call costs the same. One or two suffice after a short step.
    ///
    /// Nothing is refused: the residual tells lane by lane how far it came, and what is not finite passes through.
    ///
    /// ```
    /// use multibody::{Projection, Rk4, multibody};
    ///
    /// multibody! {
    ///     mod swing {
    ///         world { gravity: -9.81 * Y }
    ///         body carriage { mass: 0.1 }
    ///         body bob { mass: 1.0 }
    ///         joint x: Prismatic { parent: ground, child: carriage, axis: X }
    ///         joint y: Prismatic { parent: carriage, child: bob, axis: Y }
    ///         constraint rope: Rod { between: [ground, bob], length: 1.0 }
    ///     }
    /// }
    /// let once = Projection { iterations: 1, ..Projection::default() };
    /// let model = swing::Model::<f64>::default();
    /// let mut state = swing::State::default();
    /// state.q.x = 1.0;
    /// for k in 0..1000 {
    ///     let t = 1e-3 * f64::from(k);
    ///     state = Rk4::step(&model, t, &state, &(), 1e-3);
    ///     state = once.project_fixed(&model, t + 1e-3, &state).state;
    /// }
    /// assert!((state.q.x.hypot(state.q.y) - 1.0).abs() < 1e-15);
    /// ```
    pub fn project_fixed<S: Constrained>(
        &self,
        system: &S,
        t: S::Scalar,
        state: &S::State,
    ) -> Projected<S::State, S::Scalar> {
        self.project_fixed_by(&Plain, system, t, state)
    }

    /// The same for any weighting.
    pub fn project_fixed_by<S: Constrained>(
        &self,
        weighting: &impl Weighting<S>,
        system: &S,
        t: S::Scalar,
        state: &S::State,
    ) -> Projected<S::State, S::Scalar> {
        let (mut q, mut v, x) = state.split();
        let mut rank = S::Scalar::lit(f64::NAN);
        let iterations = if self.position { self.iterations } else { 0 };
        for _ in 0..iterations {
            let residual = negative(&system.constraints(t, &q));
            let (d, now) = weighting.fixed_correction(system, t, &state.join(q, v, x), &residual);
            q = q.displace(&d);
            rank = now;
        }
        if self.velocity {
            let open = state.join(q, v, x);
            let rate = negative(&system.constraint_rate(t, &open));
            let (d, now) = weighting.fixed_velocity_correction(system, t, &open, &rate);
            v = v.add(&d);
            rank = now;
        }
        let residual = greatest(&system.constraints(t, &q));
        Projected { state: state.join(q, v, x), rank, residual, iterations }
    }

    /// Newton's method on the position, one correction of the velocities, and how each lane fared.
    fn run<S: Constrained>(&self, weighting: &impl Weighting<S>, system: &S, t: S::Scalar, state: &S::State) -> Run<S> {
        let (mut q, v, x) = state.split();
        let mut residual = system.constraints(t, &q);
        let mut closed = if self.position { never::<S>() } else { !never::<S>() };
        let mut rank = None;
        let mut iterations = 0;
        let mut corrections = [S::Scalar::lit(0.0); 2];
        for _ in 0..self.iterations {
            let size = greatest(&residual);
            let close = Real::le(size, closeness::<S>(self.tolerance, &q));
            // Near a singular pose a motion goes where the residual leads it, so what is within the tolerance is corrected
            // all the same, and once more after a long way.
            let enough = match iterations {
                0 => Real::le(size, S::Scalar::lit(POLISHED) * S::Scalar::epsilon()),
                1 => Real::le(corrections[0], noticed::<S>(&q)),
                _ => !never::<S>(),
            };
            closed = closed | (close & enough);
            let settled = closed | !Real::is_finite(size);
            if all(settled) {
                break;
            }
            let here = state.join(q, v, x);
            let (d, now) = weighting.correction(system, t, &here, &negative(&residual));
            rank = Some(now);
            let rounding = at_rounding::<S>(&q, &d, &residual, || system.constraints_along(t, &here, &d));
            closed = closed | (!settled & rounding);
            // In the pose itself what is within the tolerance is rounding, and no displacement makes it good.
            let settled = settled | (close & Real::gt(greatest(&d), polishing::<S>(&q, size)));
            closed = closed | (close & settled);
            let d = d.map(&mut |d| Real::select(settled, S::Scalar::lit(0.0), d));
            if let Some(correction) = corrections.get_mut(iterations as usize) {
                *correction = greatest(&d);
            }
            q = q.displace(&d);
            residual = system.constraints(t, &q);
            iterations += 1;
        }
        let size = greatest(&residual);
        closed = closed | Real::le(size, closeness::<S>(self.tolerance, &q));
        let unclear = is_unclear(system, t, &state.join(q, v, x), corrections);

        let state = state.join(q, v, x);
        let motion = if self.velocity {
            Motion::of(weighting, system, t, &state, self.tolerance)
        } else {
            let rank = rank.unwrap_or_else(|| weighting.correction(system, t, &state, &S::Residual::zero()).1);
            Motion { state, rank, rate: S::Scalar::lit(0.0), consistent: !never::<S>() }
        };
        Run { motion, residual: size, closed, unclear, iterations }
    }
}

/// A projection in progress or at its end, lane by lane.
struct Run<S: System> {
    motion: Motion<S>,
    residual: S::Scalar,
    closed: Mask<S>,
    /// Whether it may have come to another branch of a motion.
    unclear: Mask<S>,
    iterations: u32,
}

impl<S: System> Run<S> {
    /// The state, if all lanes have one.
    fn check(self) -> Result<Projected<S::State, S::Scalar>, ProjectionError> {
        let Self { motion, residual, closed, unclear: _, iterations } = self;
        if !all(finite::<S>(&motion.state)) || !all(Real::is_finite(residual)) {
            Err(ProjectionError::NotFinite)
        } else if !all(closed) {
            let residual = Real::select(closed, S::Scalar::lit(0.0), residual).greatest();
            Err(ProjectionError::NoConvergence { residual, iterations })
        } else if !all(motion.consistent) {
            Err(ProjectionError::NoVelocity { rate: motion.worst_rate() })
        } else {
            Ok(Projected { state: motion.state, rank: motion.rank, residual, iterations })
        }
    }
}

/// Velocities that satisfy the constraints' rates, or come as near as they can.
struct Motion<S: System> {
    state: S::State,
    rank: S::Scalar,
    rate: S::Scalar,
    consistent: Mask<S>,
}

impl<S: Constrained> Motion<S> {
    /// The equations are linear in the velocities, so one correction does it; a second one is for what rounding left
    /// near a singular configuration.
    fn of(weighting: &impl Weighting<S>, system: &S, t: S::Scalar, state: &S::State, tolerance: f64) -> Self {
        let (q, mut v, x) = state.split();
        let position = closeness::<S>(tolerance, &q);
        let mut rate = system.constraint_rate(t, state);
        let mut rank = S::Scalar::lit(0.0);
        let mut consistent = never::<S>();
        for again in [false, true] {
            let here = state.join(q, v, x);
            let (d, now) = if again {
                weighting.fixed_velocity_correction(system, t, &here, &negative(&rate))
            } else {
                weighting.velocity_correction(system, t, &here, &negative(&rate))
            };
            let moved = displacement_by(system, t, &here, &d);
            let at_rounding = at_rounding::<S>(&q, &moved, &rate, || system.constraint_rate_along(t, &here, &d));
            v = v.zip(&d, &mut |v, d| Real::select(consistent, v, v + d));
            rate = system.constraint_rate(t, &state.join(q, v, x));
            rank = now;
            let close = position * (S::Scalar::lit(1.0) + greatest(&v));
            consistent = consistent | at_rounding | Real::le(greatest(&rate), close);
            if all(consistent | !Real::is_finite(close)) {
                break;
            }
        }
        Self { state: state.join(q, v, x), rank, rate: greatest(&rate), consistent }
    }
}

impl<S: System> Motion<S> {
    /// The greatest rate left in a lane that found no velocities.
    fn worst_rate(&self) -> f64 {
        Real::select(self.consistent, S::Scalar::lit(0.0), self.rate).greatest()
    }
}

impl<S: Constrained> Motion<S> {
    /// The place of the equation with the greatest rate in lanes that found no velocities, and that rate: for an error.
    #[cold]
    #[inline(never)]
    fn worst_equation(&self, rates: &S::Residual) -> (usize, f64) {
        let zero = S::Scalar::lit(0.0);
        let size = |rate| Real::select(self.consistent, zero, Real::abs(rate)).greatest();
        let worse = |(place, worst): (usize, (usize, f64)), rate| {
            let size = size(rate);
            (place + 1, if size > worst.1 { (place, size) } else { worst })
        };
        rates.fold((0, (0, 0.0)), &mut |worst, rate| worse(worst, rate)).1
    }
}

/// The mask of a system's scalar.
type Mask<S> = <<S as System>::Scalar as Real>::Mask;

/// False in every lane.
fn never<S: System>() -> Mask<S> {
    Real::lt(S::Scalar::lit(0.0), S::Scalar::lit(0.0))
}

/// One for every coordinate.
fn ones<T: Real, V: Tangent<T>>() -> V {
    V::zero().map(&mut |_| T::lit(1.0))
}

fn negative<T: Real, V: Tangent<T>>(v: &V) -> V {
    v.map(&mut |x| -x)
}

/// Whether position and velocity are finite.
fn finite<S: System>(state: &S::State) -> Mask<S> {
    let (q, v, _) = state.split();
    Real::is_finite(greatest(&q.magnitude())) & Real::is_finite(greatest(&v))
}

/// The tolerance for residuals at a position: what was asked for, or what rounding allows.
fn closeness<S: System>(tolerance: f64, q: &PositionOf<S>) -> S::Scalar {
    let roundings = S::Scalar::lit(ROUNDINGS) * S::Scalar::epsilon();
    Real::max(S::Scalar::lit(tolerance), roundings * (S::Scalar::lit(1.0) + greatest(&q.magnitude())))
}

/// The greatest displacement that a residual within the tolerance is closed by.
fn polishing<S: Constrained>(q: &PositionOf<S>, residual: S::Scalar) -> S::Scalar {
    let rounding = closeness::<S>(0.0, q);
    let (least, most) = (S::Scalar::lit(POLISHING / ROUNDINGS) * rounding, noticed::<S>(q));
    Real::select(Real::le(residual, rounding), Real::min(least, most), most)
}

/// Whether the correction `d` for a residual is lost in the rounding of the coordinates, and yet would make up for at
/// least half of the residual, by `change`: then the residual is rounding too. Residuals that no displacement changes are
/// not. Velocities are compared by what they displace in a second.
fn at_rounding<S: Constrained>(
    q: &PositionOf<S>,
    d: &DisplacementOf<S>,
    residual: &S::Residual,
    change: impl FnOnce() -> S::Residual,
) -> Mask<S> {
    let one = S::Scalar::lit(1.0);
    let relative = d.zip(&q.magnitude(), &mut |d, q| d / (one + Real::abs(q)));
    let small = Real::le(greatest(&relative), S::Scalar::lit(ROUNDINGS) * S::Scalar::epsilon());
    if !any(small) {
        return small;
    }

    let left = greatest(&residual.add(&change()));
    small & Real::le(left, S::Scalar::lit(0.5) * greatest(residual))
}
