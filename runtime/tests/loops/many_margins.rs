//! What integrators see of the margins to dead centres: all of them, each asked for once, whatever the angle.

use std::cell::Cell;

use multibody::nalgebra::Vector1;
use multibody::{Dop853, IntegrationError, Integrator, Margin, Rk4, StateSpace, System, multibody};

const MARGINS: usize = 150;
const NAMES: [&str; 2] = ["another", "the one"];

#[derive(Clone, Copy)]
struct State {
    q: Vector1<f64>,
    v: Vector1<f64>,
}

impl StateSpace for State {
    type Scalar = f64;
    type Position = Vector1<f64>;
    type Velocity = Vector1<f64>;
    type Extra = ();
    fn split(&self) -> (Vector1<f64>, Vector1<f64>, ()) {
        (self.q, self.v, ())
    }
    fn join(&self, q: Vector1<f64>, v: Vector1<f64>, (): ()) -> Self {
        Self { q, v }
    }
}

/// A point that moves evenly, with many roots, one of which changes its sign at once at `q = 1.1`, as the determinant of
/// equations does whose solution has jumped to another one.
struct Many {
    which: usize,
    /// How fast all roots but that one fall.
    falling: f64,
    asked: Cell<u32>,
}

impl System for Many {
    type Scalar = f64;
    type State = State;
    type Input = ();
    fn derivative(&self, _t: f64, _state: &State, (): &()) -> (Vector1<f64>, ()) {
        (Vector1::new(0.0), ())
    }
    fn position_rates(&self, _t: f64, state: &State) -> Vector1<f64> {
        state.v
    }
    fn margins(&self, _t: f64, state: &State, (): &(), visit: &mut dyn FnMut(Margin<f64>)) -> f64 {
        self.asked.set(self.asked.get() + 1);
        for k in 0..MARGINS {
            let is_it = k == self.which;
            let root = if is_it { (1.1 - state.q[0]).signum() } else { 1.0 };
            let rate = if is_it { 0.0 } else { -self.falling };
            visit(Margin { coordinate: NAMES[usize::from(is_it)], root, rate });
        }
        0.0
    }
}

const START: State = State { q: Vector1::new(0.0), v: Vector1::new(1.0) };

#[test]
fn a_sign_is_seen_wherever_it_stands() {
    for which in [0, 3, 63, 64, 100, MARGINS - 1] {
        let system = Many { which, falling: 0.0, asked: Cell::new(0) };
        let expected = IntegrationError::DeadCentre { time: 0.0, coordinate: "the one" };
        let told = |error: IntegrationError| match error {
            IntegrationError::DeadCentre { time, coordinate } => {
                assert!((1.0..1.2).contains(&time), "{which}: {time}");
                IntegrationError::DeadCentre { time: 0.0, coordinate }
            }
            other => other,
        };
        let fixed = Rk4::integrate(&system, 0.0, &START, &(), 0.1, 30, |_, _| ()).map(|_| ()).map_err(told);
        assert_eq!(fixed, Err(expected), "{which}");
        let given = Integrator::fixed(Rk4, 0.1).integrate(&system, 0.0, 3.0, &START, &(), |_, _| ());
        assert_eq!(given.map(|_| ()).map_err(told), Err(expected), "{which}");
        let chosen = Integrator::adaptive(Dop853, 1e-6, 1e-6).integrate(&system, 0.0, 3.0, &START, &(), |_, _| ());
        assert_eq!(chosen.map(|_| ()).map_err(told), Err(expected), "{which}");
    }
}

#[test]
fn margins_are_not_asked_for_once_for_each() {
    // Near enough that errors are judged in the roots.
    let system = Many { which: MARGINS, falling: 0.2, asked: Cell::new(0) };
    let run = Integrator::adaptive(Dop853, 1e-6, 1e-6).integrate(&system, 0.0, 3.0, &START, &(), |_, _| ());
    let (_, steps) = run.unwrap();
    let (asked, steps) = (system.asked.get(), steps.accepted + steps.rejected);
    println!("{asked} times in {steps} steps");
    assert!(asked > 4 * steps && asked <= 50 * steps, "{asked} times in {steps} steps");
}

multibody! {
    /// A crank and a rocker: the crank turns all the way.
    mod rocker {
        body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body coupler { mass: 0.2, com: 1.5 * X, inertia: rod(0.2, 3.0, X) }
        body rocker { mass: 0.2, com: 1.25 * X, inertia: rod(0.2, 2.5, X) }
        joint a: Revolute { parent: ground, child: crank, axis: Z }
        joint b: Revolute { parent: crank.at(1.0 * X), child: coupler, axis: Z }
        joint c: Revolute { parent: ground.at(3.0 * X), child: rocker, axis: Z }
        #[cut]
        joint d: Revolute { parent: coupler.at(3.0 * X), child: rocker.at(2.5 * X), axis: Z }
        formulation { constraints: Reduced }
        solve (b, c) from d { sin(c.angle - a.angle - b.angle) > 0.0 }
    }
}

#[test]
fn turns_far_away_are_no_dead_centre_in_single_precision() {
    for (turns, tolerance) in [(0_u16, 1e-5), (200, 1e-3), (200, 1e-5), (1000, 1e-4)] {
        let angle = f32::from(turns) * core::f32::consts::TAU;
        let start = rocker::State { q: rocker::Position { a: angle }, v: rocker::Velocity { a: 6.0 } };
        let run = Integrator::adaptive(Dop853, tolerance, tolerance).integrate(
            &rocker::Model::<f32>::default(),
            0.0,
            5.0,
            &start,
            &(),
            |_, _| (),
        );
        let (end, steps) = run.unwrap_or_else(|error| panic!("after {turns} turns, {tolerance}: {error}"));
        println!("{turns} turns: {:.3} rad, {steps:?}", end.q.a - angle);
        assert!((end.q.a - angle).abs() > 10.0);
    }
}
