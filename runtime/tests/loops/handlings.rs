//! Every method with every handling of constraints, on one four-bar: the order that is seen, and what the loop is off by.
//!
//! The reference is the same four-bar without a loop, by a closed form that shares nothing with the equations of the
//! other. Errors are those of all angles and rates at the end.

use core::f64::consts::TAU;
use multibody::nalgebra::SVector;
use multibody::{
    Composition4, Composition6, Constrained, Differentiable, Dop853, DormandPrince, Euler, GaussLegendre4,
    GaussLegendre6, GeneralisedAlpha, ImplicitMidpoint, Impulsive, Integrator, Jacobian, Method, Projection, Radau,
    Rk4, SemiImplicitEuler, SymplecticGauss4, SymplecticGauss6, SymplecticMidpoint, System, Verlet, WithBaumgarte,
    WithProjection, multibody,
};

macro_rules! linkage {
    ($(#[$doc:meta])* $name:ident, $constraints:ident, [$($solve:tt)*], [$($emitted:ident),*]) => {
        multibody! {
            $(#[$doc])*
            mod $name {
                world { gravity: -9.81 * Y }
                formulation { constraints: $constraints }
                body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                body link { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
                body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
                joint crank: Revolute { parent: ground, child: arm, axis: Z }
                joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
                joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
                #[cut]
                joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
                $($solve)*
                output angles = [crank.angle, coupler.angle, rocker.angle];
                output rates = [crank.rate, coupler.rate, rocker.rate];
                emit forward_dynamics, $($emitted),*;
            }
        }
    };
}

linkage! {
    /// Its loop keeps its two equations.
    kept, Multipliers, [], [derivatives, impulse]
}
linkage! {
    /// Its loop is solved.
    reduced, Reduced,
    [solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }],
    [derivatives, momentum]
}

multibody! {
    /// A parallelogram, whose mass matrix is constant.
    mod parallelogram {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body lever { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(X), child: lever.at(X), axis: Z }
        solve (coupler, rocker) = (-crank.angle, crank.angle);
        emit forward_dynamics;
    }
}

/// `[s]`: until then the motion is smooth.
const SHORT: f64 = 0.8;
/// `[s]`: the linkage has been nearly flat by then, where the first term of the error of [`DormandPrince`] comes to
/// outweigh the ones after it.
const LONG: f64 = 1.5;

/// How the loop is kept closed. Rates of Baumgarte's accelerations are in 1/s, or a tenth of a step's inverse.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Handling {
    None,
    Both,
    BothByMass,
    Position,
    PositionByMass,
    Velocity,
    VelocityByMass,
    Fixed,
    FixedByMass,
    Baumgarte,
    BaumgartePlain,
    BaumgarteForStep,
    BaumgartePlainForStep,
}

/// No handling, and projections.
const STEADY: [Handling; 9] = [
    Handling::None,
    Handling::Both,
    Handling::BothByMass,
    Handling::Position,
    Handling::PositionByMass,
    Handling::Velocity,
    Handling::VelocityByMass,
    Handling::Fixed,
    Handling::FixedByMass,
];
/// Baumgarte's accelerations at a rate of their own.
const PULLED: [Handling; 2] = [Handling::Baumgarte, Handling::BaumgartePlain];
/// The same at a rate that grows with shorter steps.
const BY_STEP: [Handling; 2] = [Handling::BaumgarteForStep, Handling::BaumgartePlainForStep];

const TO_TOLERANCE: Projection = Projection { tolerance: 1e-13, iterations: 20, position: true, velocity: true };
const ONCE: Projection = Projection { iterations: 1, ..TO_TOLERANCE };
/// `[1/s]`
const RATE: f64 = 10.0;

/// The four-bar with any handling: one type, so that every method is compiled once.
struct Handled {
    model: kept::Model,
    handling: Handling,
    dt: f64,
}

impl System for Handled {
    type Scalar = f64;
    type State = kept::State;
    type Input = ();
    fn derivative(&self, t: f64, state: &kept::State, (): &()) -> (kept::Velocity, ()) {
        let model = &self.model;
        match self.handling {
            Handling::Baumgarte => WithBaumgarte::new(model, RATE).derivative(t, state, &()),
            Handling::BaumgartePlain => WithBaumgarte::plain(model, RATE).derivative(t, state, &()),
            Handling::BaumgarteForStep => WithBaumgarte::for_step(model, self.dt).derivative(t, state, &()),
            Handling::BaumgartePlainForStep => WithBaumgarte::plain_for_step(model, self.dt).derivative(t, state, &()),
            _ => model.derivative(t, state, &()),
        }
    }
    fn position_rates(&self, _t: f64, state: &kept::State) -> kept::Velocity {
        state.v
    }
    fn accepted(&self, t: f64, state: &kept::State, (): &()) -> kept::State {
        let model = &self.model;
        let plain = |projection| WithProjection::new(model, projection).accepted(t, state, &());
        let by_mass = |projection| WithProjection::by_mass(model, projection).accepted(t, state, &());
        let position = Projection { velocity: false, ..TO_TOLERANCE };
        let velocity = Projection { position: false, ..TO_TOLERANCE };
        match self.handling {
            Handling::Both => plain(TO_TOLERANCE),
            Handling::BothByMass => by_mass(TO_TOLERANCE),
            Handling::Position => plain(position),
            Handling::PositionByMass => by_mass(position),
            Handling::Velocity => plain(velocity),
            Handling::VelocityByMass => by_mass(velocity),
            Handling::Fixed => WithProjection::fixed(model, ONCE).accepted(t, state, &()),
            Handling::FixedByMass => {
                WithProjection::fixed_weighted(model, ONCE, multibody::projection::ByMass).accepted(t, state, &())
            }
            _ => *state,
        }
    }
}

impl Differentiable for Handled {
    type Matrix = <kept::Model as Differentiable>::Matrix;
    fn jacobian(&self, t: f64, state: &kept::State, (): &()) -> Jacobian<Self::Matrix> {
        let model = &self.model;
        match self.handling {
            Handling::Baumgarte => WithBaumgarte::new(model, RATE).jacobian(t, state, &()),
            Handling::BaumgartePlain => WithBaumgarte::plain(model, RATE).jacobian(t, state, &()),
            Handling::BaumgarteForStep => WithBaumgarte::for_step(model, self.dt).jacobian(t, state, &()),
            Handling::BaumgartePlainForStep => WithBaumgarte::plain_for_step(model, self.dt).jacobian(t, state, &()),
            _ => model.jacobian(t, state, &()),
        }
    }
    fn input_derivative(&self, t: f64, state: &kept::State, input: &(), change: &()) -> (kept::Velocity, ()) {
        self.model.input_derivative(t, state, input, change)
    }
}

impl Constrained for Handled {
    type Residual = <kept::Model as Constrained>::Residual;
    fn constraints(&self, t: f64, q: &kept::Position) -> Self::Residual {
        Constrained::constraints(&self.model, t, q)
    }
    fn constraint_rate(&self, t: f64, state: &kept::State) -> Self::Residual {
        Constrained::constraint_rate(&self.model, t, state)
    }
    fn correction(
        &self,
        t: f64,
        state: &Self::State,
        residual: &Self::Residual,
        weights: &kept::Velocity,
    ) -> (kept::Velocity, f64) {
        self.model.correction(t, state, residual, weights)
    }
    fn velocity_correction(
        &self,
        t: f64,
        state: &kept::State,
        residual: &Self::Residual,
        weights: &kept::Velocity,
    ) -> (kept::Velocity, f64) {
        self.correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: f64, state: &kept::State, d: &kept::Velocity) -> Self::Residual {
        self.constraint_rate_along(t, state, d)
    }
}

impl Impulsive for Handled {
    type Rates = <kept::Model as Impulsive>::Rates;
    fn jump(
        &self,
        t: f64,
        state: &Self::State,
        impulse: &kept::Velocity,
        rates: &Self::Rates,
    ) -> (kept::Velocity, f64) {
        Impulsive::jump(&self.model, t, state, impulse, rates)
    }
}

/// Angles, then rates.
type All = SVector<f64, 6>;

fn of_reduced(state: &reduced::State) -> All {
    let output = reduced::Model::default().outputs(0.0, state, &());
    let ([a, b, c], [d, e, f]) = (output.angles, output.rates);
    All::from([a, b, c, d, e, f])
}

fn of_kept(state: &kept::State) -> All {
    let (q, v) = (&state.q, &state.v);
    All::from([q.crank, q.coupler, q.rocker, v.crank, v.coupler, v.rocker])
}

fn start() -> reduced::State {
    let mut start = reduced::State::default();
    (start.q.crank, start.v.crank) = (1.0, 2.0);
    start
}

fn kept_start() -> kept::State {
    let [a, b, c, d, e, f] = of_reduced(&start()).into();
    let mut start = kept::State::default();
    (start.q.crank, start.q.coupler, start.q.rocker) = (a, b, c);
    (start.v.crank, start.v.coupler, start.v.rocker) = (d, e, f);
    start
}

fn reference(span: f64) -> All {
    let fine = Integrator::fixed(Dop853, span / 3000.0).compensated();
    of_reduced(&fine.integrate(&reduced::Model::default(), 0.0, span, &start(), &(), |_, _| ()).unwrap().0)
}

/// The greatest difference, of angles up to whole turns.
fn apart(a: &All, b: &All) -> f64 {
    let mut difference = a - b;
    for angle in difference.iter_mut().take(3) {
        *angle -= TAU * (*angle / TAU).round();
    }
    difference.amax()
}

fn order(coarse: f64, halved: f64) -> f64 {
    (coarse / halved).log2()
}

/// Errors at the end, and what position and velocity were off by at most at the end of any step.
fn run<M: Method<Handled>>(method: M, handling: Handling, (span, steps): (f64, u32)) -> (All, [f64; 2]) {
    let dt = span / f64::from(steps);
    let system = Handled { model: kept::Model::default(), handling, dt };
    let mut worst = [0.0_f64; 2];
    let run = Integrator::fixed(method, dt).integrate(&system, 0.0, span, &kept_start(), &(), |t, x| {
        let position = Constrained::constraints(&system, t, &x.q).amax();
        let velocity = Constrained::constraint_rate(&system, t, x).amax();
        worst = [worst[0].max(position), worst[1].max(velocity)];
    });
    (of_kept(&run.unwrap().0), worst)
}

fn margin(order: u32) -> f64 {
    if order < 6 { 0.1 } else { 0.3 }
}

/// Whether the order of a method is seen, between `steps` and twice as many. At a rate that grows with shorter steps,
/// accelerations come to be stiff: what stages are off by is multiplied by a number that doesn't shrink, and any order
/// from the first on is left.
fn check<M: Method<Handled>>(name: &str, method: M, (span, steps): (f64, u32), handlings: &[Handling]) {
    let reference = reference(span);
    println!("{name}: order {}", M::ORDER);
    for &handling in handlings {
        let (coarse, _) = run(method, handling, (span, steps));
        let (halved, [position, velocity]) = run(method, handling, (span, 2 * steps));
        let errors = [apart(&coarse, &reference), apart(&halved, &reference)];
        let seen = order(errors[0], errors[1]);
        println!(
            "  {:22} order {seen:.3}, errors {:.1e} {:.1e}, off by {position:.1e} {velocity:.1e}",
            format!("{handling:?}"),
            errors[0],
            errors[1]
        );
        assert!(errors[1] > 2e-13, "{name}, {handling:?}: {} is rounding", errors[1]);
        let (expected, margin) = (f64::from(M::ORDER), margin(M::ORDER));
        let least = if BY_STEP.contains(&handling) { 0.9 } else { expected - margin };
        let most = if BY_STEP.contains(&handling) { expected + 0.3 } else { expected + margin };
        assert!(seen >= least && seen <= most, "{name}, {handling:?}: order {expected}, seen {seen}");

        // What is projected is closed, by one iteration too; what isn't stays open by what steps leave.
        let (positions, velocities) = match handling {
            Handling::Both | Handling::BothByMass | Handling::Fixed | Handling::FixedByMass => (true, true),
            Handling::Position | Handling::PositionByMass => (true, false),
            Handling::Velocity | Handling::VelocityByMass => (false, true),
            _ => (false, false),
        };
        let first = M::ORDER == 1;
        let bounds = [if positions { 5e-13 } else { 1e-2 }, if velocities { 1e-13 } else { 3e-2 }];
        assert!(position < bounds[0] && velocity < bounds[1], "{name}, {handling:?}: {position:e} {velocity:e}");
        assert!(first || position < 1e-3, "{name}, {handling:?}: {position:e}");
    }
}

#[test]
fn explicit_methods() {
    fn all<M: Method<Handled>>(name: &str, method: M, steps: u32) {
        check(name, method, (SHORT, steps), &STEADY);
        check(name, method, (SHORT, steps), &PULLED);
        check(name, method, (SHORT, steps), &BY_STEP);
    }
    all("Euler", Euler, 2000);
    all("SemiImplicitEuler", SemiImplicitEuler, 2000);
    all("Rk4", Rk4, 120);
    all("Dop853", Dop853, 12);
    check("DormandPrince", DormandPrince, (LONG, 400), &STEADY);
    check("DormandPrince", DormandPrince, (1.0, 120), &PULLED);
    check("DormandPrince", DormandPrince, (LONG, 150), &BY_STEP);
}

#[test]
fn implicit_methods() {
    fn all<M: Method<Handled>>(name: &str, method: M, steps: u32) {
        check(name, method, (SHORT, steps), &STEADY);
        check(name, method, (SHORT, steps), &PULLED);
        check(name, method, (SHORT, steps), &BY_STEP);
    }
    all("ImplicitMidpoint", ImplicitMidpoint, 200);
    all("GaussLegendre4", GaussLegendre4, 40);
    all("GaussLegendre6", GaussLegendre6, 20);
    all("Radau", Radau, 40);
    all("GeneralisedAlpha", GeneralisedAlpha::new(0.8), 200);
    all("GeneralisedAlpha, functional", GeneralisedAlpha::new(0.8).functional(), 200);
    all("GeneralisedAlpha, constrained", GeneralisedAlpha::new(0.8).constrained().functional(), 200);
}

/// The loop solved: no handling is needed, and methods for velocities, momenta and constant mass matrices are at home.
#[test]
fn reduced_coordinates() {
    fn check<S: System<Scalar = f64, Input = ()>, M: Method<S>>(
        name: &str,
        (system, start, reference): (&S, &S::State, fn(f64) -> All),
        all: impl Fn(&S::State) -> All,
        method: M,
        (span, steps): (f64, u32),
    ) {
        let reference = reference(span);
        let error = |n: u32| {
            let fixed = Integrator::fixed(method, span / f64::from(n));
            apart(&all(&fixed.integrate(system, 0.0, span, start, &(), |_, _| ()).unwrap().0), &reference)
        };
        let errors = [error(steps), error(2 * steps)];
        let seen = order(errors[0], errors[1]);
        println!("{name}: order {}, seen {seen:.3}, errors {:.1e} {:.1e}", M::ORDER, errors[0], errors[1]);
        assert!(errors[1] > 2e-13, "{name}: {} is rounding", errors[1]);
        assert!((seen - f64::from(M::ORDER)).abs() <= margin(M::ORDER), "{name}: order {}, seen {seen}", M::ORDER);
    }
    let model = reduced::Model::default();
    let case: (_, _, fn(f64) -> All) = (&model, &start(), reference);
    check("Euler", case, of_reduced, Euler, (SHORT, 2000));
    check("SemiImplicitEuler", case, of_reduced, SemiImplicitEuler, (SHORT, 2000));
    check("Rk4", case, of_reduced, Rk4, (SHORT, 120));
    check("DormandPrince", case, of_reduced, DormandPrince, (LONG, 200));
    check("Dop853", case, of_reduced, Dop853, (SHORT, 12));
    check("ImplicitMidpoint", case, of_reduced, ImplicitMidpoint, (SHORT, 200));
    check("GaussLegendre4", case, of_reduced, GaussLegendre4, (SHORT, 40));
    check("GaussLegendre6", case, of_reduced, GaussLegendre6, (SHORT, 20));
    check("Radau", case, of_reduced, Radau, (SHORT, 40));
    check("GeneralisedAlpha", case, of_reduced, GeneralisedAlpha::new(0.8), (SHORT, 200));
    check("SymplecticMidpoint", case, of_reduced, SymplecticMidpoint, (SHORT, 200));
    check("SymplecticGauss4", case, of_reduced, SymplecticGauss4, (SHORT, 40));
    check("SymplecticGauss6", case, of_reduced, SymplecticGauss6, (SHORT, 20));

    // A parallelogram, whose mass matrix is constant.
    let model = parallelogram::Model::default();
    let mut start = parallelogram::State::default();
    (start.q.crank, start.v.crank) = (1.0, 2.0);
    fn both(x: &parallelogram::State) -> All {
        All::from([x.q.crank, x.v.crank, 0.0, 0.0, 0.0, 0.0])
    }
    let reference = |span: f64| {
        let mut start = parallelogram::State::default();
        (start.q.crank, start.v.crank) = (1.0, 2.0);
        let fine = Integrator::fixed(Dop853, span / 3000.0).compensated();
        both(&fine.integrate(&parallelogram::Model::default(), 0.0, span, &start, &(), |_, _| ()).unwrap().0)
    };
    let case: (_, _, fn(f64) -> All) = (&model, &start, reference);
    check("Verlet", case, both, Verlet, (SHORT, 200));
    check("Composition4", case, both, Composition4, (SHORT, 60));
    check("Composition6", case, both, Composition6, (SHORT, 16));
}
