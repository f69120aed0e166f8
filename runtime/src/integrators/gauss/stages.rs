//! The equations of a Gauss step and their solution by fixed-point iteration.
//!
//! Everything is seen from the middle of start and end: with the displacement `D = h sum b_j k_j` of a step, its stages
//! lie at the middle plus `h sum (a_ij - b_j / 2) k_j`. On vector spaces that is the method as it is usually written. On
//! rotations it is what makes it symmetric in time: the exponential's chart is centred on the geodesic middle of the
//! step, which forward and backward steps share (Zanna, Engo and Munthe-Kaas, Adjoint and selfadjoint Lie-group methods,
//! BIT 41, 2001), where a chart centred on the start is symmetric for the midpoint rule alone.
//!
//! Iteration (Hairer, Lubich and Wanner, section VIII.6): starts from the polynomial through the stages of the steps
//! before, takes velocities from momenta, then positions from velocities, then forces from both, and ends when no
//! component's increment shrinks any further, so that what is left is rounding and has no preferred sign (Hairer,
//! McLachlan and Razakarivony, BIT 48, 2008; by components after Antonana, Makazaga and Murua, Numer. Algorithms 76, 2017).

use super::tableau::Tableau;
use super::variables::Variables;
use crate::integrators::method::Attempt;
use crate::integrators::problem::{Problem, Step};
use crate::integrators::slope::SlopeOf;
use crate::{Configuration, DisplacementOf, PositionOf, Real, StateSpace, System, Tangent, VelocityOf, all, any};

/// Greatest number of sweeps over all stages. Where a step is short enough to be of use, a quarter of them will do.
const MOST: u32 = 60;

/// The slopes at the stages of the last steps, and where the next one starts.
pub struct Stages<S: System, const STAGES: usize, const HISTORY: usize> {
    /// The last step first. Those of velocities are slopes of momenta where these are integrated.
    slopes: [[SlopeOf<S>; STAGES]; HISTORY],
    /// `[s]` length of those steps.
    dt: S::Scalar,
    /// Velocities or momenta at the end.
    second: VelocityOf<S>,
}

impl<S: System, const STAGES: usize, const HISTORY: usize> Clone for Stages<S, STAGES, HISTORY> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<S: System, const STAGES: usize, const HISTORY: usize> Copy for Stages<S, STAGES, HISTORY> {}

/// The start of a step.
struct Start<S: System> {
    state: S::State,
    q: PositionOf<S>,
    /// Velocities or momenta.
    w: VelocityOf<S>,
}

impl<const STAGES: usize, const HISTORY: usize> Tableau<f64, STAGES, HISTORY> {
    #[inline]
    pub(super) fn begin<S: System, V: Variables<S>>(
        &self,
        problem: &Problem<'_, S>,
        t: S::Scalar,
        state: &S::State,
    ) -> Stages<S, STAGES, HISTORY> {
        let q = V::position_rates(problem.system, t, state);
        let (v, x) = V::rates(problem, t, state);
        let slope = SlopeOf::<S> { q, v, x };
        let second = V::of(problem.system, state);
        Stages { slopes: [[slope; STAGES]; HISTORY], dt: S::Scalar::lit(0.0), second }
    }

    #[inline]
    pub(super) fn attempt<S: System, V: Variables<S>>(
        &self,
        problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        memory: &Stages<S, STAGES, HISTORY>,
    ) -> Attempt<S, Stages<S, STAGES, HISTORY>> {
        let (q, v, _) = step.state.split();
        let start = Start::<S> { state: *step.state, q, w: memory.second };
        let tableau = self.lit::<S::Scalar>();
        let mut slopes = tableau.first(step, memory);
        let converged = tableau.solve::<S, V>(problem, step, &start, &mut slopes);

        let mut displacement: SlopeOf<S> = tableau.sum(&slopes).scale(step.dt);
        let second = start.w.add(&displacement.v);
        displacement.v = V::change(problem.system, &v, &q.displace(&displacement.q), &second, &displacement.v);

        let mut history = memory.slopes;
        history.rotate_right(1);
        if let Some(last) = history.first_mut() {
            *last = slopes;
        }
        let details = Stages { slopes: history, dt: step.dt, second };
        Attempt { displacement, error: SlopeOf::<S>::zero(), converged, details }
    }

    /// The variables at the end are those of the state that was accepted.
    #[inline]
    pub(super) fn proceed<S: System, V: Variables<S>>(
        &self,
        problem: &Problem<'_, S>,
        _step: &Step<'_, S>,
        attempt: &Attempt<S, Stages<S, STAGES, HISTORY>>,
        next: &S::State,
    ) -> Stages<S, STAGES, HISTORY> {
        Stages { second: V::of(problem.system, next), ..attempt.details }
    }
}

// Loops in place of `map` over tables: they become constants in the precision of the scalar.
impl<T: Real, const STAGES: usize, const HISTORY: usize> Tableau<T, STAGES, HISTORY> {
    /// First slopes: extrapolated from steps of the same length, else those of the last stage.
    #[inline]
    fn first<S: System<Scalar = T>>(
        &self,
        step: &Step<'_, S>,
        memory: &Stages<S, STAGES, HISTORY>,
    ) -> [SlopeOf<S>; STAGES] {
        if !all(Real::eq(memory.dt, step.dt)) {
            let last = memory.slopes.first().and_then(|stages| stages.last()).copied();
            return [last.unwrap_or_else(SlopeOf::<S>::zero); STAGES];
        }
        let mut result = [SlopeOf::<S>::zero(); STAGES];
        for (sum, weights) in result.iter_mut().zip(&self.extrapolation) {
            for (weights, slopes) in weights.iter().zip(&memory.slopes) {
                for (weight, slope) in weights.iter().zip(slopes) {
                    *sum = sum.add_scaled(*weight, slope);
                }
            }
        }
        result
    }

    /// `sum b_j k_j` of slopes or parts of them, as the middle one and what the others differ from it, so that rounded
    /// weights still add up to one.
    #[inline]
    fn sum<W: Tangent<T>>(&self, slopes: &[W; STAGES]) -> W {
        let Some(middle) = slopes.get(STAGES / 2) else { return W::zero() };
        let mut sum = *middle;
        for (j, (weight, slope)) in self.weights.iter().zip(slopes).enumerate() {
            if j != STAGES / 2 {
                sum = sum.add_scaled(*weight, &slope.add_scaled(T::lit(-1.0), middle));
            }
        }
        sum
    }

    /// The displacements of the stages from the middle of the step, for slopes, or parts of them.
    #[inline]
    fn offsets<W: Tangent<T>>(&self, dt: T, slopes: &[W; STAGES]) -> [W; STAGES] {
        let mut result = [W::zero(); STAGES];
        for (i, (sum, weights)) in result.iter_mut().zip(&self.middle).enumerate() {
            for (j, (weight, slope)) in weights.iter().zip(slopes).enumerate() {
                if i != j {
                    *sum = sum.add_scaled(*weight * dt, slope);
                }
            }
        }
        result
    }

    /// Sweeps over the stages until nothing changes but rounding. False where that doesn't come to pass.
    #[inline]
    fn solve<S: System<Scalar = T>, V: Variables<S>>(
        &self,
        problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        start: &Start<S>,
        slopes: &mut [SlopeOf<S>; STAGES],
    ) -> bool {
        let (zero, huge) = (T::lit(0.0), T::lit(f64::INFINITY));
        let mut least = [SlopeOf::<S>::zero().map(&mut |_| huge); STAGES];
        let mut positions = self.positions(step, start, slopes);
        for k in 0..MOST {
            let before = *slopes;
            self.sweep::<S, V>(problem, step, start, slopes, &mut positions);

            let mut shrinking = false;
            let (mut greatest, mut size) = (zero, zero);
            for ((new, old), least) in slopes.iter().zip(&before).zip(&mut least) {
                let change = new.zip(old, &mut |new, old| Real::abs(new - old));
                *least = least.zip(&change, &mut |least, change| {
                    let smaller = Real::gt(change, zero) & Real::lt(change, least);
                    shrinking |= any(smaller);
                    Real::select(smaller, change, least)
                });
                greatest = change.fold(greatest, &mut Real::max);
                size = new.fold(size, &mut |size, k| Real::max(size, Real::abs(k)));
            }
            if !all(Real::is_finite(greatest)) {
                if k > 0 {
                    // The iteration ran away, where the system itself has values: the step ends where it started.
                    *slopes = [SlopeOf::<S>::zero(); STAGES];
                }
                return false;
            }
            // Noise of the forces, not a transient of the iteration.
            let small = Real::le(greatest, Real::sqrt(T::epsilon()) * size);
            if !shrinking && all(small) {
                return true;
            }
        }
        false
    }

    /// Positions of the stages, each with its displacement from the middle.
    #[inline]
    fn positions<S: System<Scalar = T>>(
        &self,
        step: &Step<'_, S>,
        start: &Start<S>,
        slopes: &[SlopeOf<S>; STAGES],
    ) -> [(DisplacementOf<S>, PositionOf<S>); STAGES] {
        let rates = part(slopes, |slope| slope.q);
        let half: DisplacementOf<S> = self.sum(&rates).scale(T::lit(0.5) * step.dt);
        let middle = start.q.displace(&half);
        let mut result = [(half, middle); STAGES];
        for ((offset, q), d) in result.iter_mut().zip(self.offsets(step.dt, &rates)) {
            (*offset, *q) = (d, middle.displace(&d));
        }
        result
    }

    /// The stages of what a vector space holds: momenta, velocities, own states.
    #[inline]
    fn vectors<W: Tangent<T>>(&self, dt: T, start: &W, rates: &[W; STAGES]) -> [W; STAGES] {
        let middle = start.add_scaled(T::lit(0.5) * dt, &self.sum(rates));
        let mut result = self.offsets(dt, rates);
        for stage in &mut result {
            *stage = middle.add(stage);
        }
        result
    }

    /// New slopes from the latest values of everything.
    #[inline]
    fn sweep<S: System<Scalar = T>, V: Variables<S>>(
        &self,
        problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        start: &Start<S>,
        slopes: &mut [SlopeOf<S>; STAGES],
        positions: &mut [(DisplacementOf<S>, PositionOf<S>); STAGES],
    ) {
        let (_, _, own) = start.state.split();
        let mut velocities = self.vectors(step.dt, &start.w, &part(slopes, |slope| slope.v));
        let own = self.vectors(step.dt, &own, &part(slopes, |slope| slope.x));
        let values = velocities.iter_mut().zip(&own).zip(positions.iter());
        for ((slope, ((velocity, x), (offset, q))), node) in slopes.iter_mut().zip(values).zip(&self.nodes) {
            *velocity = V::velocity(problem.system, q, velocity);
            let state = start.state.join(*q, *velocity, *x);
            let rates = V::position_rates(problem.system, step.t + *node * step.dt, &state);
            slope.q = <PositionOf<S> as Configuration<T>>::dexp_inv(offset, &rates);
        }
        *positions = self.positions(step, start, slopes);
        let states = positions.iter().zip(&velocities).zip(&own);
        for ((slope, (((_, q), v), x)), node) in slopes.iter_mut().zip(states).zip(&self.nodes) {
            (slope.v, slope.x) = V::rates(problem, step.t + *node * step.dt, &start.state.join(*q, *v, *x));
        }
    }
}

/// One part of the slopes of all stages.
#[inline]
fn part<T: Real, D: Copy, W: Tangent<T>, const STAGES: usize>(
    slopes: &[D; STAGES],
    of: impl Fn(&D) -> W,
) -> [W; STAGES] {
    let mut result = [W::zero(); STAGES];
    for (part, slope) in result.iter_mut().zip(slopes) {
        *part = of(slope);
    }
    result
}
