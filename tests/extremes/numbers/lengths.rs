//! Steps of an attosecond and of a thousand seconds, of models with generated code, by every method.

use super::bounded::Bounded;
use super::models::tree;
use super::steps::ended;
use multibody::*;
use multibody_tests::models::energy::{double_swing, swing};

/// No step of any method asks for more than this: sixty iterations of three stages, and an estimate.
const A_STEP: u32 = 400;
/// Steps of each run.
const STEPS: u32 = 200;

/// A state and what it is to be moved with, at a speed of one in each coordinate.
fn moving<Z: StateSpace<Scalar = f64> + Default>() -> Z {
    let start = Z::default();
    let (q, v, own) = start.split();
    let d: <Z::Position as Configuration<f64>>::Velocity = Tangent::zero();
    start.join(q.displace(&d.map(&mut |_| 0.3)), v.map(&mut |_| 1.0), own)
}

/// How far the velocities of a state are from one.
fn changed<Z: StateSpace<Scalar = f64>>(state: &Z) -> f64 {
    state.split().1.fold(0.0, &mut |most: f64, x| if (x - 1.0).abs() <= most { most } else { (x - 1.0).abs() })
}

fn method<S, M>(name: &str, system: &S, input: &S::Input, method: M)
where
    S: System<Scalar = f64, State: Default>,
    M: for<'a> Method<Bounded<'a, S>>,
{
    let start: S::State = moving();
    let system = Bounded::new(system, STEPS * A_STEP);
    // At one second a unit in the last place is 222 steps long.
    let dt = 1e-18;
    for (t0, span) in [(0.0, f64::from(STEPS) * dt), (1.0, f64::EPSILON)] {
        system.reset();
        let (mut t, mut last) = (t0, t0);
        let integrator = Integrator::fixed(method, dt).compensated().max_steps(2 * STEPS);
        let run = integrator.integrate(&system, t0, t0 + span, &start, input, |now, _| (last, t) = (t, now));
        let (end, statistics) = run.unwrap_or_else(|error| panic!("{name} from {t0}: {error}"));
        assert!((t - (t0 + span)).abs() <= f64::EPSILON * t && last <= t, "{name}: {t:e}");
        assert!(statistics.accepted.abs_diff(STEPS) <= if t0 == 0.0 { 1 } else { 112 }, "{name}: {statistics:?}");
        // Nothing accelerates by more than 1e3 here.
        assert!(changed(&end) <= 1e-12, "{name}: velocities changed by {:e}", changed(&end));
    }
    // Whatever becomes of steps that are too long, there is an end to it.
    let dt = 1e3;
    let end = f64::from(STEPS) * dt;
    system.reset();
    let outcome = Integrator::fixed(method, dt).integrate(&system, 0.0, end, &start, input, |_, _| ());
    ended(&outcome);
    let told = outcome.map_or_else(|error| error.to_string(), |_| "a finite state".into());
    println!("{name}, steps of 1e3 s: {told}, asked at most {} times so far", system.most());
    system.reset();
    let first = Tolerance { first_step: dt, ..Tolerance::new(1e-6, 1e-6) };
    let within = Integrator::within(method, first).max_steps(STEPS);
    ended(&within.integrate(&system, 0.0, end, &start, input, |_, _| ()));
}

#[test]
fn shortest_and_longest_steps() {
    fn explicit<S: SecondOrder<Scalar = f64, State: Default>>(name: &str, system: &S, input: &S::Input) {
        method(&format!("{name}, Euler"), system, input, Euler);
        method(&format!("{name}, SemiImplicitEuler"), system, input, SemiImplicitEuler);
        method(&format!("{name}, Rk4"), system, input, Rk4);
        method(&format!("{name}, DormandPrince"), system, input, DormandPrince);
        method(&format!("{name}, Dop853"), system, input, Dop853);
        method(&format!("{name}, ImplicitMidpoint"), system, input, ImplicitMidpoint);
        method(&format!("{name}, GaussLegendre4"), system, input, GaussLegendre4);
        method(&format!("{name}, GaussLegendre6"), system, input, GaussLegendre6);
        method(&format!("{name}, GeneralisedAlpha"), system, input, GeneralisedAlpha::new(0.8).functional());
    }
    let (pendulum, double) = (swing::Model::<f64>::default(), double_swing::Model::<f64>::default());
    explicit("pendulum", &pendulum, &());
    explicit("double pendulum", &double, &());
    method("pendulum, Verlet", &pendulum, &(), Verlet);
    method("pendulum, Composition4", &pendulum, &(), Composition4);
    method("pendulum, Composition6", &pendulum, &(), Composition6);
    method("double pendulum, SymplecticMidpoint", &double, &(), SymplecticMidpoint);
    method("double pendulum, SymplecticGauss4", &double, &(), SymplecticGauss4);
    method("double pendulum, SymplecticGauss6", &double, &(), SymplecticGauss6);
    let (tree, input) = (tree::Model::<f64>::default(), tree::Input { torque: 0.5 });
    explicit("tree", &tree, &input);
    method("tree, Radau", &tree, &input, Radau);
    method("tree, GeneralisedAlpha by Newton", &tree, &input, GeneralisedAlpha::new(0.8));
}
