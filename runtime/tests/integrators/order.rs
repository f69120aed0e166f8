//! Every method converges with its order: on a vector space, in time, on rotations, and with states of the user's own.

use crate::common::{Body, Currents, Driven, Motor, Pendulum, Scalar, distance};
use multibody::integrators::Interval;
use multibody::{Dop853, DormandPrince, Euler, Integrator, Method, Pose, Rk4, SemiImplicitEuler, StateSpace, System};

/// `[s]` start of all runs.
const START: f64 = 0.5;

type Position<S> = <<S as System>::State as StateSpace>::Position;

/// A system with a start, and the distance of its positions.
struct Case<S: System, F> {
    system: S,
    start: S::State,
    input: S::Input,
    /// `[s]` length of a run.
    span: f64,
    position: F,
}

impl<S: System<Scalar = f64>, F: Fn(&Position<S>, &Position<S>) -> f64> Case<S, F> {
    fn run<M: Method<S>>(&self, method: M, steps: u32, span: f64) -> S::State {
        let fixed = Integrator::fixed(method, span / f64::from(steps));
        fixed.integrate(&self.system, START, START + span, &self.start, &self.input, |_, _| ()).unwrap().0
    }

    fn distance(&self, a: &S::State, b: &S::State) -> f64 {
        distance(a, b, &self.position)
    }

    /// The order seen between `steps` and twice as many, against a run that is far finer.
    fn observed<M: Method<S>>(&self, method: M, steps: u32) -> f64 {
        let fine = self.run(Dop853, 1000, self.span);
        let [coarse, halved] = [steps, 2 * steps].map(|n| self.distance(&self.run(method, n, self.span), &fine));
        assert!(halved > 1e-14, "{halved} is rounding: the order cannot be seen");
        (coarse / halved).log2()
    }

    /// The power of the step with which the error within one step shrinks: the order of dense output and one.
    fn observed_within<M: Method<S>>(&self, method: M, step: f64) -> f64 {
        let [coarse, halved] = [step, 0.5 * step].map(|step| {
            let mut worst = 0.0;
            let once = Integrator::fixed(method, step);
            let look = |interval: &Interval<'_, S, M>| {
                for c in [0.1, 0.3, 0.5, 0.7, 0.9] {
                    let error = self.distance(&interval.share(c), &self.run(Dop853, 40, c * step));
                    worst = f64::max(worst, error);
                }
            };
            once.intervals(&self.system, START, START + step, &self.start, &self.input, look).unwrap();
            worst
        });
        assert!(halved > 1e-14, "{halved} is rounding: the order cannot be seen");
        (coarse / halved).log2()
    }

    /// Every method, with numbers of steps that show its order: neither rounding nor long steps.
    fn check(&self, name: &str, [euler, fourth, fifth, eighth]: [u32; 4]) {
        let seen = [
            (self.observed(Euler, euler), 1.0, 0.1),
            (self.observed(SemiImplicitEuler, euler), 1.0, 0.1),
            (self.observed(Rk4, fourth), 4.0, 0.1),
            (self.observed(DormandPrince, fifth), 5.0, 0.1),
            (self.observed(Dop853, eighth), 8.0, 0.3),
        ];
        println!("{name}: orders {:.3?}", seen.map(|(seen, ..)| seen));
        for (seen, order, bar) in seen {
            assert!((seen - order).abs() <= bar, "{name}: order {order}, seen {seen}");
        }
    }

    /// The same with lengths of a step.
    fn check_within(&self, name: &str, [euler, fourth, fifth, eighth]: [f64; 4]) {
        let seen = [
            (self.observed_within(Euler, euler), 2.0, 0.1),
            (self.observed_within(Rk4, fourth), 4.0, 0.1),
            (self.observed_within(DormandPrince, fifth), 5.0, 0.1),
            (self.observed_within(Dop853, eighth), 8.0, 0.3),
        ];
        println!("{name}: within a step {:.3?}", seen.map(|(seen, ..)| seen));
        for (seen, power, bar) in seen {
            assert!((seen - power).abs() <= bar, "{name}: power {power}, seen {seen}");
        }
    }
}

fn shaken() -> Case<Pendulum<f64>, impl Fn(&f64, &f64) -> f64> {
    Case {
        system: Pendulum { gravity: 9.81, shake: 4.0 },
        start: Scalar { q: 1.0, v: 0.5 },
        input: (),
        span: 2.0,
        position: |a: &f64, b: &f64| (a - b).abs(),
    }
}

fn turning() -> Case<Body<f64>, impl Fn(&Pose, &Pose) -> f64> {
    Case {
        system: Body::floating(),
        start: Body::spinning(),
        input: (),
        span: 2.0,
        position: |a: &Pose, b: &Pose| a.orientation.angle_to(&b.orientation),
    }
}

fn driven() -> Case<Motor, impl Fn(&f64, &f64) -> f64> {
    Case {
        system: Motor,
        start: Driven { q: 0.2, v: 0.0, x: Currents { current: 0.0 } },
        input: 3.0,
        span: 0.5, // before the current is settled
        position: |a: &f64, b: &f64| (a - b).abs(),
    }
}

#[test]
fn shaken_pendulum() {
    shaken().check("pendulum", [10_000, 240, 120, 20]);
}

#[test]
fn rotating_body() {
    turning().check("body", [10_000, 100, 40, 7]);
}

#[test]
fn motor_with_a_current() {
    driven().check("motor", [10_000, 60, 45, 4]);
}

#[test]
fn states_within_a_step() {
    shaken().check_within("pendulum", [2e-3, 0.02, 0.02, 0.2]);
    turning().check_within("body", [4e-3, 0.02, 0.04, 0.4]);
    driven().check_within("motor", [2e-3, 4e-3, 0.01, 0.2]);
}

/// With velocities in place of the displacement's rates, Runge-Kutta methods fall to second order: the body's order is
/// the work of `dexp_inv`, not an accident of the test.
#[test]
fn order_is_lost_without_dexp_inv() {
    let case = Case {
        system: naive::Body(Body::floating()),
        start: naive::spinning(),
        input: (),
        span: 2.0,
        position: |a: &naive::Naive, b: &naive::Naive| a.0.orientation.angle_to(&b.0.orientation),
    };
    let seen = case.observed(Rk4, 60);
    assert!(seen < 2.5, "{seen}");
}

/// The body with a `dexp_inv` that does nothing.
mod naive {
    use crate::common;
    use multibody::{Configuration, Pose, StateSpace, System, Twist};

    #[derive(Clone, Copy, PartialEq)]
    pub(crate) struct Naive(pub(crate) Pose);

    #[derive(Clone, Copy)]
    pub(crate) struct State(Naive, Twist);

    pub(crate) struct Body(pub(crate) common::Body<f64>);

    pub(crate) fn spinning() -> State {
        let common::Flight { q, v } = common::Body::spinning();
        State(Naive(q), v)
    }

    impl Configuration<f64> for Naive {
        type Velocity = Twist;
        fn displace(&self, d: &Twist) -> Self {
            Self(self.0.displace(d))
        }
        fn dexp_inv(_: &Twist, v: &Twist) -> Twist {
            *v
        }
        fn magnitude(&self) -> Twist {
            self.0.magnitude()
        }
    }

    impl StateSpace for State {
        type Scalar = f64;
        type Position = Naive;
        type Velocity = Twist;
        type Extra = ();
        fn split(&self) -> (Naive, Twist, ()) {
            (self.0, self.1, ())
        }
        fn join(&self, q: Naive, v: Twist, (): ()) -> Self {
            Self(q, v)
        }
    }

    impl System for Body {
        type Scalar = f64;
        type State = State;
        type Input = ();
        fn derivative(&self, t: f64, state: &State, input: &()) -> (Twist, ()) {
            self.0.derivative(t, &common::Flight { q: state.0.0, v: state.1 }, input)
        }
        fn position_rates(&self, _t: f64, state: &State) -> Twist {
            state.1
        }
    }
}
