//! Symplectic and symmetric methods: order of steps and of states within them, symmetry in time, symplecticity, and what
//! happens where their equations have no solution.

use crate::common::canonical::DoublePendulum;
use crate::common::loops::Coordinates;
use crate::common::separable::{Compass, Star};
use crate::common::{Body, Currents, Driven, Motor, Oscillator, Pendulum, Scalar, distance};
use core::marker::PhantomData;
use multibody::nalgebra::{SMatrix, UnitQuaternion, Vector2};
use multibody::simba::simd::WideF64x4;
use multibody::{
    Composition4, Composition6, DormandPrince, GaussLegendre4, GaussLegendre6, ImplicitMidpoint, IntegrationError,
    Integrator, Method, PositionOf, Rk4, SymplecticGauss4, SymplecticGauss6, SymplecticMidpoint, System, Verlet,
};

const START: f64 = 0.5;
const SPAN: f64 = 2.0;
/// Steps of the reference.
const FINE: usize = 4000;

/// How far apart two positions are.
trait Apart {
    fn apart(&self, other: &Self) -> f64;
}

impl Apart for f64 {
    fn apart(&self, other: &Self) -> f64 {
        (self - other).abs()
    }
}

impl Apart for Vector2<f64> {
    fn apart(&self, other: &Self) -> f64 {
        (self - other).amax()
    }
}

impl Apart for multibody::Pose<f64> {
    fn apart(&self, other: &Self) -> f64 {
        // Twice the vector part of the rotation between: an arccosine would lose half the digits.
        let turn: UnitQuaternion<f64> = self.orientation.inverse() * other.orientation;
        (self.position - other.position).amax().max(2.0 * turn.imag().amax())
    }
}

/// A system with a state to start from.
struct Case<'a, S: System> {
    name: &'static str,
    system: &'a S,
    start: S::State,
    input: S::Input,
}

impl<S: System<Scalar = f64>> Case<'_, S>
where
    PositionOf<S>: Apart,
{
    fn run<M: Method<S>>(&self, method: M, span: f64, steps: u32) -> S::State {
        let fixed = Integrator::fixed(method, span / f64::from(steps));
        fixed.integrate(self.system, START, START + span, &self.start, &self.input, |_, _| ()).unwrap().0
    }

    /// States at [`FINE`] equal steps.
    fn fine(&self) -> Vec<S::State> {
        let mut states = vec![self.start];
        let dt = SPAN / FINE as f64;
        let keep = |_, state: &S::State| states.push(*state);
        DormandPrince::integrate(self.system, START, &self.start, &self.input, dt, FINE as u32, keep).unwrap();
        states
    }

    /// The order of the state at the end and of those within the steps, seen between `steps` and twice as many.
    fn check<M: Method<S>>(&self, method: M, steps: u32) {
        let apart = |a: &PositionOf<S>, b: &PositionOf<S>| a.apart(b);
        let fine = self.fine();
        let error = |n: u32| distance(&self.run(method, SPAN, n), &fine[FINE], apart);
        let (coarse, halved) = (error(steps), error(2 * steps));
        let seen = (coarse / halved).log2();

        let within = |n: u32| {
            let each = FINE / n as usize;
            assert_eq!(each * n as usize, FINE);
            let (mut worst, mut first) = (0.0_f64, 0);
            let fixed = Integrator::fixed(method, SPAN / f64::from(n));
            let (system, start, input) = (self.system, &self.start, &self.input);
            let run = fixed.intervals(system, START, START + SPAN, start, input, |interval| {
                for k in [each / 5, each / 2, each * 4 / 5] {
                    let state = interval.share(k as f64 / each as f64);
                    worst = worst.max(distance(&state, &fine[first + k], apart));
                }
                first += each;
            });
            run.unwrap();
            worst
        };
        let (coarse_within, halved_within) = (within(steps), within(2 * steps));
        let dense = (coarse_within / halved_within).log2();

        let order = f64::from(M::ORDER);
        println!(
            "{:22} order {order}: seen {seen:.3}, within steps {dense:.3}, errors {coarse:.1e} {halved:.1e}, within \
             {coarse_within:.1e} {halved_within:.1e}",
            self.name
        );
        assert!(halved > 2e-13, "{halved} is rounding: the order cannot be seen");
        let margin = if order < 6.0 { 0.1 } else { 0.3 };
        assert!((seen - order).abs() <= margin, "{}: order {order}, seen {seen}", self.name);
        assert!(dense >= order - 0.4, "{}: order {order}, within steps {dense}", self.name);
    }

    /// Forward, and backward in time: how far from the start that ends.
    fn return_error<M: Method<S>>(&self, method: M, dt: f64) -> f64 {
        let fixed = Integrator::fixed(method, dt);
        let (system, input, end) = (self.system, &self.input, START + 40.0 * dt);
        let (there, _) = fixed.integrate(system, START, end, &self.start, input, |_, _| ()).unwrap();
        let (back, _) = fixed.integrate(system, end, START, &there, input, |_, _| ()).unwrap();
        distance(&back, &self.start, |a, b| a.apart(b))
    }

    fn symmetric<M: Method<S>>(&self, method: M) {
        let error = self.return_error(method, 0.05);
        println!("{:22} order {}: returns to {error:.1e}", self.name, M::ORDER);
        assert!(error < 3e-13, "{}: {error}", self.name);
    }
}

fn pendulum(system: &Pendulum<f64>) -> Case<'_, Pendulum<f64>> {
    Case { name: "shaken pendulum", system, start: Scalar { q: 1.0, v: 0.5 }, input: () }
}

const SHAKEN: Pendulum<f64> = Pendulum { gravity: 9.81, shake: 4.0 };

fn compass(system: &Compass) -> Case<'_, Compass> {
    Case { name: "magnet", system, start: Compass::start(), input: () }
}

fn motor() -> Case<'static, Motor> {
    let start = Driven { q: 0.2, v: 0.0, x: Currents { current: 0.0 } };
    Case { name: "motor", system: &Motor, start, input: 3.0 }
}

const DOUBLE: DoublePendulum<f64> = DoublePendulum { gravity: 9.81 };

fn double() -> Case<'static, DoublePendulum<f64>> {
    let start = Coordinates { q: Vector2::new(1.0, 0.4), v: Vector2::new(-0.3, 0.8) };
    Case { name: "double pendulum", system: &DOUBLE, start, input: () }
}

#[test]
fn splittings_keep_their_order() {
    let case = pendulum(&SHAKEN);
    case.check(Verlet, 400);
    case.check(Composition4, 40);
    case.check(Composition6, 16);
    let ball = Compass::ball();
    let case = compass(&ball);
    case.check(Verlet, 400);
    case.check(Composition4, 40);
    case.check(Composition6, 10);
}

#[test]
fn gauss_methods_in_velocities_keep_their_order() {
    let case = pendulum(&SHAKEN);
    case.check(ImplicitMidpoint, 400);
    case.check(GaussLegendre4, 80);
    case.check(GaussLegendre6, 25);
    let top = Compass::top();
    let case = compass(&top);
    case.check(ImplicitMidpoint, 400);
    case.check(GaussLegendre4, 50);
    case.check(GaussLegendre6, 20);
    let body = Body::floating();
    let case = Case { name: "free body", system: &body, start: Body::spinning(), input: () };
    case.check(ImplicitMidpoint, 200);
    case.check(GaussLegendre4, 25);
    case.check(GaussLegendre6, 10);
    let case = motor();
    case.check(ImplicitMidpoint, 200);
    case.check(GaussLegendre4, 25);
    case.check(GaussLegendre6, 10);
}

#[test]
fn gauss_methods_in_momenta_keep_their_order() {
    let case = double();
    case.check(SymplecticMidpoint, 500);
    case.check(SymplecticGauss4, 80);
    case.check(SymplecticGauss6, 100);
    let top = Compass::top();
    let case = compass(&top);
    case.check(SymplecticMidpoint, 400);
    case.check(SymplecticGauss4, 50);
    case.check(SymplecticGauss6, 20);
}

#[test]
fn steps_are_symmetric_in_time() {
    let case = pendulum(&SHAKEN);
    case.symmetric(Verlet);
    case.symmetric(Composition4);
    case.symmetric(Composition6);
    case.symmetric(ImplicitMidpoint);
    case.symmetric(GaussLegendre4);
    case.symmetric(GaussLegendre6);
    let ball = Compass::ball();
    let case = compass(&ball);
    case.symmetric(Verlet);
    case.symmetric(Composition4);
    case.symmetric(Composition6);
    let top = Compass::top();
    let case = compass(&top);
    case.symmetric(ImplicitMidpoint);
    case.symmetric(GaussLegendre4);
    case.symmetric(GaussLegendre6);
    case.symmetric(SymplecticMidpoint);
    case.symmetric(SymplecticGauss4);
    case.symmetric(SymplecticGauss6);
    let case = double();
    case.symmetric(SymplecticMidpoint);
    case.symmetric(SymplecticGauss4);
    case.symmetric(SymplecticGauss6);
    case.symmetric(GaussLegendre6);
    assert!(case.return_error(Rk4, 0.05) > 1e-6, "the test sees a method that is not symmetric");
}

/// Largest entry of `J^T Omega J - Omega` for one step as a map of positions and momenta, by central differences of
/// fourth order.
fn symplectic_defect<S, M>(
    system: &S,
    method: M,
    momentum: impl Fn(&Coordinates<f64, 2>) -> Vector2<f64>,
    velocity: impl Fn(&Vector2<f64>, &Vector2<f64>) -> Vector2<f64>,
) -> f64
where
    S: System<Scalar = f64, State = Coordinates<f64, 2>, Input = ()>,
    M: Method<S>,
{
    type Phase = [f64; 4];
    let dt = 0.05;
    let step = |z: Phase| -> Phase {
        let q = Vector2::new(z[0], z[1]);
        let start = Coordinates { q, v: velocity(&q, &Vector2::new(z[2], z[3])) };
        let (end, _) = Integrator::fixed(method, dt).integrate(system, 0.0, dt, &start, &(), |_, _| ()).unwrap();
        let p = momentum(&end);
        [end.q.x, end.q.y, p.x, p.y]
    };
    let z = [0.4, -0.3, 0.5, 0.2];
    let delta = 2e-3;
    let column = |k: usize| -> [f64; 4] {
        let at = |share: f64| {
            let mut z = z;
            z[k] += share * delta;
            step(z)
        };
        let (a, b, c, d) = (at(-2.0), at(-1.0), at(1.0), at(2.0));
        core::array::from_fn(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * delta))
    };
    let jacobian: SMatrix<f64, 4, 4> = [column(0), column(1), column(2), column(3)].into();
    let mut omega = SMatrix::<f64, 4, 4>::zeros();
    omega.fixed_view_mut::<2, 2>(0, 2).fill_with_identity();
    omega -= omega.transpose();
    (jacobian.transpose() * omega * jacobian - omega).amax()
}

#[test]
fn steps_are_symplectic() {
    let star = |name: &str, defect: f64| {
        println!("star {name}: {defect:.1e}");
        assert!(defect < 1e-10, "{name}: {defect}");
    };
    macro_rules! star {
        ($($method:ident)+) => {$(
            star(stringify!($method), symplectic_defect(&Star, $method, |x| x.v, |_, p| *p));
        )+};
    }
    // With a constant mass matrix momenta are velocities, up to a factor.
    star!(Verlet Composition4 Composition6 ImplicitMidpoint GaussLegendre4 GaussLegendre6);

    use multibody::Canonical;
    macro_rules! double {
        ($method:ident) => {{
            let defect = symplectic_defect(&DOUBLE, $method, |x| DOUBLE.momentum(x), |q, p| DOUBLE.velocity(q, p));
            println!("double pendulum {}: {defect:.1e}", stringify!($method));
            defect
        }};
    }
    assert!(double!(SymplecticMidpoint) < 1e-9);
    assert!(double!(SymplecticGauss4) < 1e-9);
    assert!(double!(SymplecticGauss6) < 1e-9);
    // In velocities the midpoint rule is symmetric, and no more than that; Runge and Kutta's method is neither.
    assert!(double!(ImplicitMidpoint) > 1e-6);
    assert!(double!(Rk4) > 1e-7);
}

#[test]
fn one_evaluation_for_each_drift() {
    let start = Scalar { q: 1.0, v: 0.0 };
    let oscillator = Oscillator::<f64>(PhantomData);
    let count = |evaluations: u32, drifts: u32| assert_eq!(evaluations, 100 * drifts + 1);
    let run = |m: &str| match m {
        "verlet" => {
            Integrator::fixed(Verlet, 0.01).integrate(&oscillator, 0.0, 1.0, &start, &0.0, |_, _| ()).unwrap().1
        }
        "4" => {
            Integrator::fixed(Composition4, 0.01).integrate(&oscillator, 0.0, 1.0, &start, &0.0, |_, _| ()).unwrap().1
        }
        _ => Integrator::fixed(Composition6, 0.01).integrate(&oscillator, 0.0, 1.0, &start, &0.0, |_, _| ()).unwrap().1,
    };
    count(run("verlet").evaluations, 1);
    count(run("4").evaluations, 6);
    count(run("6").evaluations, 11);
}

/// Sweeps of the midpoint rule on an oscillator multiply an error by `dt^2 / 4`.
#[test]
fn steps_without_a_solution_end_in_an_error() {
    let start = Scalar { q: 1.0, v: 0.0 };
    let oscillator = Oscillator::<f64>(PhantomData);
    for dt in [2.5, 10.0, 1e3, 1e100] {
        let run =
            Integrator::fixed(ImplicitMidpoint, dt).integrate(&oscillator, 0.0, 4.0 * dt, &start, &0.0, |_, _| ());
        assert!(matches!(run, Err(IntegrationError::NoConvergence { .. })), "{dt}: {run:?}");
        let run = GaussLegendre6::integrate(&oscillator, 0.0, &start, &0.0, 4.0 * dt, 3, |_, _| ());
        assert!(run.is_err(), "{dt}: {run:?}");
    }
    // Short of that it takes more sweeps and ends at the same solution.
    let (end, statistics) =
        Integrator::fixed(ImplicitMidpoint, 1.0).integrate(&oscillator, 0.0, 3.0, &start, &0.0, |_, _| ()).unwrap();
    let angle = 2.0 * 0.5_f64.atan() * 3.0; // the midpoint rule turns phase space by 2 atan(dt / 2)
    assert!((end.q - angle.cos()).abs() < 1e-14 && (end.v + angle.sin()).abs() < 1e-14);
    assert!(statistics.evaluations < 130, "{statistics:?}");

    let lost = Scalar { q: f64::NAN, v: 0.0 };
    let run = ImplicitMidpoint::integrate(&oscillator, 0.0, &lost, &0.0, 0.1, 3, |_, _| ());
    assert!(matches!(run, Err(IntegrationError::NonFinite { .. })));
}

#[test]
fn lanes_and_single_precision() {
    let start = Scalar { q: 1.0, v: 0.5 };
    let lanes = Scalar { q: WideF64x4::from([1.0, 0.5, -0.2, 2.0]), v: WideF64x4::from([0.5; 4]) };
    let wide = Pendulum { gravity: WideF64x4::from([9.81; 4]), shake: WideF64x4::from([4.0; 4]) };
    let single = Pendulum { gravity: 9.81_f32, shake: 4.0 };
    macro_rules! check {
        ($($method:ident)+) => {$(
            let one = $method::integrate(&SHAKEN, 0.0, &start, &(), 0.01, 200, |_, _| ()).unwrap();
            let (zero, dt) = (WideF64x4::from([0.0; 4]), WideF64x4::from([0.01; 4]));
            let four = $method::integrate(&wide, zero, &lanes, &(), dt, 200, |_, _| ()).unwrap();
            let four: [f64; 4] = four.q.into();
            assert!((four[0] - one.q).abs() < 1e-11, "{}: {four:?} {}", stringify!($method), one.q);
            let f32 = Scalar { q: 1.0_f32, v: 0.5 };
            let small = $method::integrate(&single, 0.0, &f32, &(), 0.01, 200, |_, _| ()).unwrap();
            assert!((f64::from(small.q) - one.q).abs() < 3e-5, "{}: {} {}", stringify!($method), small.q, one.q);
            let step = $method::step(&single, 0.0, &f32, &(), 0.01);
            assert!((step.q - 1.0048).abs() < 1e-3);
        )+};
    }
    check!(Verlet Composition4 Composition6 ImplicitMidpoint GaussLegendre4 GaussLegendre6);
}
