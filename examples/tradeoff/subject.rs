//! A mechanism in one formulation and one scalar, ready to be integrated and looked at.

use std::hint::black_box;
use std::rc::Rc;

use multibody::nalgebra::SVector;
use multibody::projection::ByMass;
use multibody::{
    Constrained, DisplacementOf, Impulsive, IntegrationError, Projection, Real, StateSpace, Statistics, System,
    Tangent, VelocityOf, WithProjection,
};

use crate::bench::greater;
use crate::reference::Motion;

/// What a motion should keep.
#[derive(Clone, Copy)]
pub(crate) struct Laws {
    /// `[J]`
    pub(crate) energy: f64,
    /// `[m]` the greatest gap of a loop; zero where loops are solved or there are none
    pub(crate) gap: f64,
}

/// A system, where it starts, and how to look at it: in double precision, whatever its scalar.
#[derive(Clone)]
pub(crate) struct Subject<S: System> {
    pub(crate) system: S,
    pub(crate) start: S::State,
    pub(crate) motion: fn(&S::State) -> Motion,
    pub(crate) laws: fn(&S::State) -> Laws,
}

type Integrate<S> =
    Rc<dyn Fn(&Subject<S>, f64, Observer<'_, S>) -> Result<(<S as System>::State, Statistics), IntegrationError>>;

/// Sees the states of a run.
pub(crate) type Observer<'a, S> = &'a mut dyn FnMut(f64, &<S as System>::State);

/// What a run came to.
pub(crate) struct Outcome {
    pub(crate) motion: Motion,
    /// At the end.
    pub(crate) last: Laws,
    /// The greatest change of energy and the greatest gap.
    pub(crate) worst: Laws,
    pub(crate) statistics: Statistics,
}

/// A method on a subject, of which the setting (a step, a tolerance) is still open. Only what integrates knows their types:
/// all else is compiled once.
pub(crate) struct Solver {
    /// Runs and looks at every state.
    pub(crate) observed: Box<dyn Fn(f64) -> Result<Outcome, IntegrationError>>,
    /// Runs, to be timed.
    pub(crate) plain: Box<dyn Fn(f64)>,
}

impl<S: System> Subject<S> {
    /// What runs by the given function.
    pub(crate) fn solver(
        this: &Rc<Self>,
        integrate: impl Fn(&Self, f64, Observer<'_, S>) -> Result<(S::State, Statistics), IntegrationError> + 'static,
    ) -> Solver
    where
        S: 'static,
    {
        Self::erased(this, Rc::new(integrate))
    }

    fn erased(this: &Rc<Self>, integrate: Integrate<S>) -> Solver
    where
        S: 'static,
    {
        let (subject, same) = (Rc::clone(this), Rc::clone(&integrate));
        let plain = Box::new(move |setting| {
            let _ = black_box(same(black_box(&subject), setting, &mut |_, _| ()));
        });
        let subject = Rc::clone(this);
        let observed = Box::new(move |setting| {
            let first = (subject.laws)(&subject.start);
            let mut worst = Laws { energy: 0.0, gap: first.gap };
            let (state, statistics) = integrate(&subject, setting, &mut |_, state| {
                let now = (subject.laws)(state);
                worst.energy = greater(worst.energy, (now.energy - first.energy).abs());
                worst.gap = greater(worst.gap, now.gap);
            })?;
            Ok(Outcome { motion: (subject.motion)(&state), last: (subject.laws)(&state), worst, statistics })
        });
        Solver { observed, plain }
    }

    /// The same motion by another system.
    pub(crate) fn with<W: System<State = S::State>>(&self, wrap: impl FnOnce(S) -> W) -> Subject<W>
    where
        S: Clone,
    {
        Subject { system: wrap(self.system.clone()), start: self.start, motion: self.motion, laws: self.laws }
    }
}

impl<S: Constrained + Clone> Subject<S> {
    /// Its loops closed after each step, as well as rounding allows.
    pub(crate) fn projected(&self) -> Subject<WithProjection<S>> {
        self.with(|system| WithProjection::new(system, Projection { tolerance: 0.0, ..Projection::default() }))
    }

    /// The same by the displacement that is least by the mass matrix.
    pub(crate) fn projected_by_mass(&self) -> Subject<WithProjection<S, ByMass>>
    where
        S: Impulsive<Rates = <S as Constrained>::Residual>,
    {
        self.with(|system| WithProjection::by_mass(system, Projection { tolerance: 0.0, ..Projection::default() }))
    }

    /// The same by one correction after each step.
    pub(crate) fn corrected(&self) -> Subject<WithProjection<S>> {
        self.with(|system| WithProjection::fixed(system, Projection { iterations: 1, ..Projection::default() }))
    }
}

/// A vector in the scalar of a model.
pub(crate) fn lit<T: Real, const N: usize>(values: [f64; N]) -> SVector<T, N> {
    SVector::from(values.map(T::lit))
}

/// A vector in double precision.
pub(crate) fn doubled<T: Real, const N: usize>(vector: SVector<T, N>) -> SVector<f64, N> {
    vector.map(Real::greatest)
}

/// The state with one of its coordinates (or velocities, behind them) displaced.
pub(crate) fn displaced<S: System<Scalar = f64>>(state: &S::State, number: usize, by: f64) -> S::State {
    let (q, v, x) = state.split();
    let mut count = 0;
    let mut component = |_| {
        count += 1;
        if count == number + 1 { by } else { 0.0 }
    };
    let (dq, dv) = (DisplacementOf::<S>::zero().map(&mut component), VelocityOf::<S>::zero().map(&mut component));
    state.join(multibody::Configuration::displace(&q, &dq), v.add(&dv), x)
}
