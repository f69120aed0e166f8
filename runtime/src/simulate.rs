//! A motion to an accuracy, without a choice of method: [`simulate`], [`simulate_lanes`] for one in each lane, and [`simulate_stiff`] for
//! stiff systems.
//!
//! Which method and which tolerances is what `examples/tradeoff` measured: over its scenes, the method of order eight
//! costs least from 1e-3 on. Tolerances are such that every scene reaches what was asked for, in all its formulations (f64).
//! What is lost to the best choice in hindsight is then at most a factor of 2.2 (`docs/tradeoff/summary.md` lists it), but
//! three where accelerations depend on positions alone and a symplectic composition takes less.

use crate::{
    Differentiable, Dop853, DormandPrince, IntegrationError, Integrator, LaneEnds, Radau, Real, Statistics, System,
};

/// Looser than that, the method of order five costs less.
const LOOSE: f64 = 3e-3;
/// Tighter than that, errors of the method of order eight may exceed the tolerance of its steps.
const TIGHT: f64 = 1e-4;
/// Tolerances of steps in units of the accuracy: of the method of order five, of that of order eight before and after
/// [`TIGHT`], and of the implicit one.
const SHARES: [f64; 4] = [0.1, 1.0, 0.5, 0.5];
/// No tolerance is below that many roundings.
const ROUNDINGS: f64 = 2.0;

/// The state at `t1` `[s]`, from `state` at `t0` `[s]`, to the given accuracy: method and steps are chosen.
///
/// `accuracy` is the error to aim at, of positions and of velocities, relative to one more than their size. It is that of
/// the whole motion, not of a step, as far as the motion itself doesn't magnify errors: where neighbouring motions part
/// by a factor of a thousand, as in chaos, so does the error. It is an aim and no bound. Where you need to know, run again
/// with a tenth of it: the difference is the error of the first run. `f32` ends at about 1e-5.
///
/// ```
/// use multibody::{multibody, simulate};
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
/// start.q.hinge = 1e-3; // rad: a small swing
/// let model = Model::<f64>::default();
/// let (end, statistics) = simulate(&model, 0.0, 10.0, &start, &(), 1e-9, |_, _| ())?;
/// let frequency = 9.81_f64.sqrt() * (1.0 - 1e-6 / 16.0);
/// assert!((end.q.hinge - 1e-3 * (10.0 * frequency).cos()).abs() < 1e-9);
/// assert!(statistics.evaluations < 1000);
/// # Ok::<(), multibody::IntegrationError>(())
/// ```
///
/// The method is always an explicit one, and nothing is projected. For stiff systems (springs, dampers or contacts that are
/// fast beside the motion) every explicit method needs steps as short as their fastest part: take [`simulate_stiff`]. Loops
/// kept as equations drift apart slowly: hand over [`WithProjection`](crate::WithProjection) around the model.
///
/// # Errors
/// [`InvalidArgument`](IntegrationError::InvalidArgument) if the accuracy is not positive and finite, and what
/// [`Integrator::integrate`] gives.
pub fn simulate<S: System>(
    system: &S,
    t0: f64,
    t1: f64,
    state: &S::State,
    input: &S::Input,
    accuracy: f64,
    observe: impl FnMut(f64, &S::State),
) -> Result<(S::State, Statistics), IntegrationError> {
    let tolerance = explicit::<S>(accuracy)?;
    if accuracy > LOOSE {
        return Integrator::adaptive(DormandPrince, tolerance, tolerance)
            .integrate(system, t0, t1, state, input, observe);
    }
    Integrator::adaptive(Dop853, tolerance, tolerance).integrate(system, t0, t1, state, input, observe)
}

/// The same in each lane of the scalar, each with steps of its own: see [`Integrator::integrate_lanes`].
///
/// # Errors
/// As those of [`simulate`], and what is wrong with the start in any lane; errors of a motion are in its
/// [`LaneEnd`](crate::LaneEnd).
pub fn simulate_lanes<S: System>(
    system: &S,
    t0: f64,
    t1: f64,
    state: &S::State,
    input: &S::Input,
    accuracy: f64,
    observe: impl FnMut(S::Scalar, &S::State),
) -> Result<LaneEnds<S::State>, IntegrationError> {
    let tolerance = explicit::<S>(accuracy)?;
    if accuracy > LOOSE {
        return Integrator::adaptive(DormandPrince, tolerance, tolerance)
            .integrate_lanes(system, t0, t1, state, input, observe);
    }
    Integrator::adaptive(Dop853, tolerance, tolerance).integrate_lanes(system, t0, t1, state, input, observe)
}

/// The same as [`simulate`] for stiff systems, by the implicit method [`Radau`] with the exact derivatives of `emit derivatives`.
///
/// Its steps follow the motion, however fast what is damped in it may be. Where nothing is fast it costs two to four times
/// as much as [`simulate`].
///
/// # Errors
/// As those of [`simulate`].
pub fn simulate_stiff<S: Differentiable>(
    system: &S,
    t0: f64,
    t1: f64,
    state: &S::State,
    input: &S::Input,
    accuracy: f64,
    observe: impl FnMut(f64, &S::State),
) -> Result<(S::State, Statistics), IntegrationError> {
    let [.., implicit] = SHARES;
    let tolerance = tolerance::<S>(implicit * accuracy, accuracy)?;
    Integrator::adaptive(Radau, tolerance, tolerance).integrate(system, t0, t1, state, input, observe)
}

/// The tolerance of steps of the explicit methods.
fn explicit<S: System>(accuracy: f64) -> Result<f64, IntegrationError> {
    let [five, coarse, fine, _] = SHARES;
    let share = if accuracy > LOOSE {
        five
    } else if accuracy > TIGHT {
        coarse
    } else {
        fine
    };
    tolerance::<S>(share * accuracy, accuracy)
}

/// A tolerance of steps, if the accuracy is one.
fn tolerance<S: System>(tolerance: f64, accuracy: f64) -> Result<f64, IntegrationError> {
    if accuracy > 0.0 && accuracy.is_finite() {
        Ok(Real::max(tolerance, ROUNDINGS * S::Scalar::epsilon().greatest()))
    } else {
        Err(IntegrationError::InvalidArgument { what: "an accuracy must be positive and finite" })
    }
}
