//! Every method converges with its order: on a vector space, in time, on rotations, and with states of the user's own.

mod common;

use common::{Body, Currents, Driven, Motor, Pendulum, Scalar, distance};
use multibody::{DormandPrince, Euler, Integrator, Method, Rk4, SemiImplicitEuler, StateSpace, System};

/// The order seen between `steps` and twice as many, against a run that is far finer.
fn observed<M: Method<S>, S: System<Scalar = f64>>(
    method: M,
    system: &S,
    start: &S::State,
    input: &S::Input,
    steps: u32,
    position: impl Fn(&Position<S>, &Position<S>) -> f64,
) -> f64 {
    let span = 2.0;
    let run = |n: u32| {
        let fixed = Integrator::fixed(method, span / f64::from(n));
        fixed.integrate(system, 0.5, 0.5 + span, start, input, |_, _| ()).unwrap().0
    };
    let fine = DormandPrince::integrate(system, 0.5, start, input, span / 3000.0, 3000, |_, _| ()).unwrap();
    let error = |n: u32| distance(&run(n), &fine, &position);
    let (coarse, halved) = (error(steps), error(2 * steps));
    assert!(halved > 1e-13, "{halved} is rounding: the order cannot be seen");
    (coarse / halved).log2()
}

fn order<M: Method<S>, S: System>() -> u32 {
    M::ORDER
}

type Position<S> = <<S as System>::State as StateSpace>::Position;

fn check<S: System<Scalar = f64>>(
    system: &S,
    start: &S::State,
    input: &S::Input,
    position: impl Fn(&Position<S>, &Position<S>) -> f64,
) {
    let orders = [
        (observed(Euler, system, start, input, 1000, &position), order::<Euler, S>()),
        (observed(SemiImplicitEuler, system, start, input, 1000, &position), order::<SemiImplicitEuler, S>()),
        (observed(Rk4, system, start, input, 60, &position), order::<Rk4, S>()),
        (observed(DormandPrince, system, start, input, 30, &position), order::<DormandPrince, S>()),
    ];
    for (seen, order) in orders {
        assert!(seen > f64::from(order) - 0.3 && seen < f64::from(order) + 0.6, "order {order}, seen {seen}");
    }
}

#[test]
fn shaken_pendulum() {
    let pendulum = Pendulum { gravity: 9.81, shake: 4.0 };
    check(&pendulum, &Scalar { q: 1.0, v: 0.5 }, &(), |a, b| (a - b).abs());
}

#[test]
fn rotating_body() {
    check(&Body::floating(), &Body::spinning(), &(), |a, b| a.orientation.angle_to(&b.orientation));
}

#[test]
fn motor_with_a_current() {
    let start = Driven { q: 0.2, v: 0.0, x: Currents { current: 0.0 } };
    check(&Motor, &start, &3.0, |a, b| (a - b).abs());
}

/// With velocities in place of the displacement's rates, Runge-Kutta methods fall to second order: the body's order is
/// the work of `dexp_inv`, not an accident of the test.
#[test]
fn order_is_lost_without_dexp_inv() {
    let seen = observed(Rk4, &naive::Body(Body::floating()), &naive::spinning(), &(), 60, |a, b| {
        a.0.orientation.angle_to(&b.0.orientation)
    });
    assert!(seen < 2.5, "{seen}");
}

/// The body with a `dexp_inv` that does nothing.
mod naive {
    use super::common;
    use multibody::{Configuration, Pose, StateSpace, System, Twist};

    #[derive(Clone, Copy)]
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
    }
}
