//! Radau IIA of order 5, an implicit method for stiff systems (Hairer and Wanner, Solving Ordinary Differential Equations
//! II, sections IV.5 and IV.8, and their program `radau5`); on manifolds after Munthe-Kaas (1998).
//!
//! Stages `Z_i` are displacements from the start of a step, `Z_i = h sum_j a_ij F(Z_j)`, where `F` is the slope at the end
//! of such a displacement, as its rate. A simplified Newton iteration solves for them with the exact derivatives at the
//! start of the step or of an earlier one: the matrix `A^-1` of the method is brought to a real and a pair of complex
//! eigenvalues, and positions are eliminated, so that one real and one complex matrix are factored whose size is the
//! number of velocities and own states.
//!
//! Derivatives are kept as long as the iteration converges fast, and factors as long as the step stays the same, for
//! which small gains in length are passed over. The error is estimated by the difference to a formula of third order that
//! takes the slope at the start in, filtered by `(gamma - h J)^-1`, so that it stays sensible where `h J` is great.

mod linear;
mod newton;
mod tableau;

use super::dense::Dense;
use super::method::{Accepted, Attempt, Method, inherent};
use super::problem::{Problem, Step};
use super::slope::{Slope, SlopeOf, magnitude};
use crate::{Configuration, Differentiable, JacobianOf, PositionOf, Real, Tangent};
use linear::MatricesOf;
pub(crate) use linear::{Eliminated, Entire, Matrices};
use newton::{Aim, Solution};
use tableau::{C, E, combination};

/// Derivatives are kept while each iteration reduces the error to this share or less.
const FAST: f64 = 0.01;
/// With derivatives kept, steps that could grow by no more than this factor stay as they are.
const HOLD: f64 = 1.2;
/// Steps grow no further than to where the iteration would still reduce the error to this share. Its rate is taken to
/// grow with the square of the step, as for a stiff direction that turns.
const SLOW: f64 = 0.1;

/// Radau IIA of order 5: three implicit stages, L-stable. The first choice for stiff systems, such as mechanisms with
/// stiff bushings, contacts or fast controllers; for models with `emit derivatives`.
///
/// The length of its steps follows the motion and not the fastest time constant of the model. A step takes about three
/// evaluations for each iteration, seldom more than four of them, and one for the estimate; steps of one length are
/// solved for to rounding and take some more.
#[derive(Clone, Copy, Debug, Default)]
pub struct Radau;

/// What passes from one step of [`Radau`] to the next.
pub struct Memory<S: Differentiable> {
    /// The slope at the start of the step, once it has been needed.
    slope: Option<SlopeOf<S>>,
    derivatives: Option<Derivatives<S>>,
    matrices: Option<MatricesOf<S>>,
    last: Option<Last<S>>,
    /// How fast the last iteration converged..
    eta: f64,
    /// ..and at what rate; zero if it took one iteration.
    rate: f64,
    /// Whether this is the first step, or one that repeats a rejected one.
    cautious: bool,
}

/// Derivatives, and whether they are those at the start of the step.
struct Derivatives<S: Differentiable> {
    jacobian: JacobianOf<S>,
    current: bool,
}

/// The last step, as the polynomial through its stages.
struct Last<S: Differentiable> {
    terms: [SlopeOf<S>; 3],
    dt: S::Scalar,
}

/// What a step of [`Radau`] leaves behind.
pub struct Details<S: Differentiable> {
    memory: Memory<S>,
    terms: [SlopeOf<S>; 3],
    theta: f64,
    shrink: f64,
}

macro_rules! copied {
    ($($name:ident)+) => {
        $(
            impl<S: Differentiable> Clone for $name<S> {
                #[inline]
                fn clone(&self) -> Self {
                    *self
                }
            }
            impl<S: Differentiable> Copy for $name<S> {}
        )+
    };
}

copied! { Memory Derivatives Last Details }

impl<S: Differentiable> Memory<S> {
    /// Derivatives and matrices for a step, new ones if there are none or if they are asked for.
    fn prepare(&mut self, problem: &Problem<'_, S>, step: &Step<'_, S>, anew: bool) -> MatricesOf<S> {
        let kept = self.derivatives.filter(|kept| kept.current || !anew);
        let matrices = self.matrices.filter(|matrices| kept.is_some() && matrices.are_for(step.dt));
        let derivatives =
            kept.unwrap_or_else(|| Derivatives { jacobian: problem.jacobian(step.t, step.state), current: true });
        let matrices = matrices.unwrap_or_else(|| {
            problem.count_factorisation();
            MatricesOf::<S>::new(&derivatives.jacobian, step.dt)
        });
        self.derivatives = Some(derivatives);
        self.matrices = Some(matrices);
        matrices
    }

    /// The stages, if the last step's polynomial went on.
    fn guess(&self, step: &Step<'_, S>) -> [SlopeOf<S>; 3] {
        let Some(last) = &self.last else {
            return [SlopeOf::<S>::zero(); 3];
        };
        let (one, two) = (S::Scalar::lit(1.0), S::Scalar::lit(2.0));
        let polynomial = Dense::<S>::new(step.state, last.terms);
        let end = polynomial.displacement(one);
        let ratio = step.dt / last.dt;
        C.map(|c| {
            let on = polynomial.displacement(one + S::Scalar::lit(c) * ratio).add_scaled(-one, &end);
            // From the coordinates around the last start to those around this one, to second order: 2 - dexp_inv for dexp.
            let q = on.q.scale(two).add_scaled(-one, &PositionOf::<S>::dexp_inv(&end.q, &on.q));
            Slope { q, ..on }
        })
    }
}

impl<S: Differentiable> Method<S> for Radau {
    const ORDER: u32 = 5;
    const ESTIMATE: u32 = 4;
    type Memory = Memory<S>;
    type Details = Details<S>;

    fn begin(&self, _problem: &Problem<'_, S>, _t: S::Scalar, _state: &S::State) -> Memory<S> {
        Memory { slope: None, derivatives: None, matrices: None, last: None, eta: 1.0, rate: 0.0, cautious: true }
    }

    fn first_slope(
        &self,
        problem: &Problem<'_, S>,
        t: S::Scalar,
        state: &S::State,
        memory: &mut Memory<S>,
    ) -> SlopeOf<S> {
        *memory.slope.get_or_insert_with(|| problem.slope(t, state))
    }

    fn attempt(&self, problem: &Problem<'_, S>, step: &Step<'_, S>, memory: &Memory<S>) -> Attempt<S, Details<S>> {
        let mut memory = *memory;
        let aim = Aim::of::<S::Scalar>(problem.tolerance());
        let guess = memory.guess(step);
        let mut matrices = memory.prepare(problem, step, false);
        let mut solution = newton::solve(problem, step, &matrices, &aim, &guess, memory.eta);
        if !solution.converged && memory.derivatives.is_some_and(|kept| !kept.current) {
            matrices = memory.prepare(problem, step, true);
            solution = newton::solve(problem, step, &matrices, &aim, &guess, 1.0);
        }
        let Solution { stages, converged, theta, eta, shrink } = solution;
        memory.eta = eta;
        if theta > 0.0 {
            memory.rate = theta;
        }
        let displacement = stages[2];
        let mut error = SlopeOf::<S>::zero();
        // Nobody asks for the error of steps of one length.
        if converged && step.full && problem.tolerance().is_some() {
            let slope = memory.slope.unwrap_or_else(|| problem.slope(step.t, step.state));
            memory.slope = Some(slope);
            let difference = combination(&E, &stages).scale(S::Scalar::lit(1.0 / 3.0));
            let filtered = |slope: &SlopeOf<S>| matrices.solve_real(&difference.add_scaled(step.dt, slope));
            error = filtered(&slope);
            if memory.cautious {
                let size = magnitude(step.state);
                if aim.tolerance.norm(&error, &size, &size).greatest() >= 1.0 {
                    error = filtered(&problem.stage(step.t, step.state, &error));
                }
            }
            error = error.scale(S::Scalar::lit(aim.share));
        }
        let terms = polynomial(&stages);
        Attempt { displacement, error, converged, details: Details { memory, terms, theta, shrink } }
    }

    fn proceed(
        &self,
        _problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        _memory: &Memory<S>,
        attempt: &Attempt<S, Details<S>>,
        _next: &Accepted<S>,
    ) -> Memory<S> {
        let Details { memory, terms, theta, .. } = attempt.details;
        let kept = memory.derivatives.filter(|_| theta <= FAST);
        Memory {
            slope: None,
            derivatives: kept.map(|kept| Derivatives { current: false, ..kept }),
            matrices: memory.matrices.filter(|_| kept.is_some()),
            last: Some(Last { terms, dt: step.dt }),
            eta: memory.eta,
            rate: theta,
            cautious: false,
        }
    }

    /// What was evaluated at the start of the step serves again.
    fn repeat(&self, memory: &Memory<S>, attempt: &Attempt<S, Details<S>>) -> Memory<S> {
        Memory { last: memory.last, eta: 1.0, cautious: true, ..attempt.details.memory }
    }

    fn next_step(&self, attempt: &Attempt<S, Details<S>>, length: f64, proposed: f64) -> f64 {
        let Details { theta, shrink, .. } = attempt.details;
        if !attempt.converged {
            return length * shrink;
        }
        let growth = proposed / length;
        let rate = attempt.details.memory.rate;
        let growth = if rate > 0.0 { Real::min(growth, Real::max(1.0, Real::sqrt(SLOW / rate))) } else { growth };
        if theta <= FAST && (1.0..=HOLD).contains(&growth) { length } else { length * growth }
    }

    /// The collocation polynomial, of third order.
    fn dense(
        &self,
        _problem: &Problem<'_, S>,
        step: &Step<'_, S>,
        _memory: &Memory<S>,
        attempt: &Attempt<S, Details<S>>,
    ) -> Dense<S> {
        Dense::new(step.state, attempt.details.terms)
    }
}

/// The cubic through zero and the stages, in the form of [`Dense`]: `c (k1 + (1 - c) (k2 + c k3))`.
fn polynomial<T: Real, V: Tangent<T>>(stages: &[V; 3]) -> [V; 3] {
    let [c1, c2, _] = C;
    let [z1, z2, z3] = stages;
    let minus = T::lit(-1.0);
    let at = |z: &V, c: f64| z.scale(T::lit(1.0 / c)).add_scaled(minus, z3).scale(T::lit(1.0 / (1.0 - c)));
    let (first, second) = (at(z1, c1), at(z2, c2));
    let k3 = second.add_scaled(minus, &first).scale(T::lit(1.0 / (c2 - c1)));
    [*z3, first.add_scaled(T::lit(-c1), &k3), k3]
}

inherent!(Radau: crate::Differentiable);
