//! Wrappers say of loops, poses and inertia what the system says that they hold.

use std::cell::Cell;

use multibody::linear::least_norm;
use multibody::nalgebra::{Vector1, Vector2};
use multibody::projection::Plain;
use multibody::{
    Constrained, Margin, Open, Opening, Projection, StateSpace, System, WithBaumgarte, WithProjection, WithRank,
    closed_loop,
};

#[derive(Clone, Copy)]
struct State {
    q: Vector2<f64>,
    v: Vector2<f64>,
}

impl StateSpace for State {
    type Scalar = f64;
    type Position = Vector2<f64>;
    type Velocity = Vector2<f64>;
    type Extra = ();
    fn split(&self) -> (Vector2<f64>, Vector2<f64>, ()) {
        (self.q, self.v, ())
    }
    fn join(&self, q: Vector2<f64>, v: Vector2<f64>, (): ()) -> Self {
        Self { q, v }
    }
}

/// A bead on a line that counts what it is asked.
#[derive(Default)]
struct Bead {
    accepted: Cell<u32>,
    reached: Cell<u32>,
}

impl System for Bead {
    type Scalar = f64;
    type State = State;
    type Input = ();
    fn derivative(&self, _t: f64, _state: &State, (): &()) -> (Vector2<f64>, ()) {
        (Vector2::zeros(), ())
    }
    fn position_rates(&self, _t: f64, state: &State) -> Vector2<f64> {
        state.v
    }
    fn accepted(&self, _t: f64, state: &State, (): &()) -> State {
        self.accepted.set(self.accepted.get() + 1);
        *state
    }
    fn reached(&self, _t: f64, _state: &State) {
        self.reached.set(self.reached.get() + 1);
    }
    fn horizon(&self, t: f64, _state: &State) -> f64 {
        t + 7.0
    }
    fn margins(&self, _t: f64, _state: &State, (): &(), visit: &mut dyn FnMut(Margin<f64>)) -> f64 {
        visit(Margin { coordinate: "bead", root: 3.0, rate: 1.0 });
        0.125
    }
    fn opening(&self, _t: f64, _state: &State, (): &()) -> Opening<f64> {
        Opening { residual: 0.25, tolerance: 0.5, what: Open::Velocities, remedy: "none" }
    }
    fn ambiguity(&self, _t: f64, _state: &State, (): &()) -> f64 {
        0.75
    }
    fn without_inertia(&self, _t: f64, _state: &State, (): &()) -> Option<&'static str> {
        Some("bead")
    }
}

impl Constrained for Bead {
    type Residual = f64;
    fn constraints(&self, _t: f64, q: &Vector2<f64>) -> f64 {
        q.y
    }
    fn constraint_rate(&self, _t: f64, state: &State) -> f64 {
        state.v.y
    }
    fn correction(&self, _t: f64, _state: &Self::State, residual: &f64, weights: &Vector2<f64>) -> (Vector2<f64>, f64) {
        least_norm(&Vector2::new(0.0, 1.0).transpose(), &Vector1::new(*residual), weights)
    }
    fn velocity_correction(
        &self,
        t: f64,
        state: &State,
        residual: &f64,
        weights: &Vector2<f64>,
    ) -> (Vector2<f64>, f64) {
        self.correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: f64, state: &State, d: &Vector2<f64>) -> f64 {
        self.constraint_rate_along(t, state, d)
    }
}

/// Whether all is handed on; what projections say of crossing motions is their own, and none cross here.
fn check<S: System<Scalar = f64, State = State, Input = ()>>(name: &str, wrapper: &S, bead: &Bead, ambiguity: f64) {
    let state = State { q: Vector2::new(1.0, 0.0), v: Vector2::zeros() };
    let (accepted, reached) = (bead.accepted.get(), bead.reached.get());
    let _ = wrapper.accepted(0.0, &state, &());
    wrapper.reached(0.0, &state);
    assert_eq!((bead.accepted.get(), bead.reached.get()), (accepted + 1, reached + 1), "{name}");
    assert_eq!(wrapper.horizon(1.0, &state), 8.0, "{name}");
    let mut seen = Vec::new();
    assert_eq!(wrapper.margins(0.0, &state, &(), &mut |margin| seen.push(margin)), 0.125, "{name}");
    assert_eq!(seen, [Margin { coordinate: "bead", root: 3.0, rate: 1.0 }], "{name}");
    assert_eq!(wrapper.opening(0.0, &state, &()), bead.opening(0.0, &state, &()), "{name}");
    assert_eq!(wrapper.ambiguity(0.0, &state, &()), ambiguity, "{name}");
    assert_eq!(wrapper.without_inertia(0.0, &state, &()), Some("bead"), "{name}");
}

#[test]
fn all_that_a_system_says_is_handed_on() {
    let bead = Bead::default();
    check("reference", &&bead, &bead, 0.75);
    check("feedback", &closed_loop(&bead, |_, _: &State| ()), &bead, 0.75);
    check("rank", &WithRank::new(&bead), &bead, 0.75);
    check("projection", &WithProjection::new(&bead, Projection::default()), &bead, 0.0);
    check("fixed projection", &WithProjection::fixed(&bead, Projection::default()), &bead, 0.0);
    check("weighted", &WithProjection::weighted(&bead, Projection::default(), Plain), &bead, 0.0);
    check("Baumgarte", &WithBaumgarte::plain(&bead, 1.0), &bead, 0.0);
    let both = closed_loop(WithRank::new(WithProjection::new(&bead, Projection::default())), |_, _: &State| ());
    check("all", &both, &bead, 0.0);
}
