//! The generalised-alpha method: its order, what it damps, and the constraints that it keeps.

use crate::common;
use crate::common::loops::{Coordinates, FourBar, Rod};
use crate::common::stiff::{Pair, Plane, Rubbing};
use crate::common::{Body, Driven, Motor, Pendulum, Scalar, distance};
use multibody::linear::least_norm;
use multibody::nalgebra::{SMatrix, SVector, Vector2};
use multibody::{
    Constrained, Differentiable, DormandPrince, GeneralisedAlpha, Impulsive, IntegrationError, Integrator, Jacobian,
    Method, Projection, Real, StateSpace, System,
};

/// `q'' = -w^2 q - 2 d w v`.
struct Vibration {
    frequency: f64,
    damping: f64,
}

impl System for Vibration {
    type Scalar = f64;
    type State = Scalar<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, x: &Scalar<f64>, (): &()) -> (f64, ()) {
        (-self.frequency * (self.frequency * x.q + 2.0 * self.damping * x.v), ())
    }
    fn position_rates(&self, _t: f64, x: &Scalar<f64>) -> f64 {
        x.v
    }
}

impl Differentiable for Vibration {
    type Matrix = [[f64; 1]; 1];
    fn jacobian(&self, _t: f64, _x: &Scalar<f64>, (): &()) -> Jacobian<[[f64; 1]; 1]> {
        let w = self.frequency;
        Jacobian { position: [[-w * w]], rates: [[-2.0 * self.damping * w]] }
    }
    fn input_derivative(&self, _t: f64, _x: &Scalar<f64>, (): &(), (): &()) -> (f64, ()) {
        (0.0, ())
    }
}

/// What is left of a fast vibration after each step, once the start is forgotten.
fn left(radius: f64, product: f64) -> f64 {
    let vibration = Vibration { frequency: product, damping: 0.0 };
    let mut sizes = vec![];
    // Steps of one second; the norm of a 3-vector (q, v, a) falls by the spectral radius, in the mean over many steps.
    let run = Integrator::fixed(GeneralisedAlpha::new(radius), 1.0).integrate(
        &vibration,
        0.0,
        60.0,
        &Scalar { q: 1e15, v: 0.0 }, // far above the rounding of one m/s, to which iterations go
        &(),
        |_, x| sizes.push((product * x.q).hypot(x.v)),
    );
    run.unwrap();
    // A double eigenvalue at infinity: its powers come with a factor that grows like the number of steps.
    let growth = if product > 1e3 { 2.0 } else { 1.0 };
    (sizes[59] / sizes[29] / growth).powf(1.0 / 30.0)
}

#[test]
fn fast_vibrations_are_damped_as_asked_for() {
    for radius in [0.9, 0.8, 0.5, 0.3] {
        let seen = left(radius, 1e6);
        println!("spectral radius {radius}: {seen:.4} at h w = 1e6, {:.6} at 0.1", left(radius, 0.1));
        assert!((seen - radius).abs() < 0.01 * radius, "{radius}: {seen}");
        assert!((left(radius, 0.1) - 1.0).abs() < 1e-3);
    }
    let conserved = left(1.0, 3.0);
    assert!((conserved - 1.0).abs() < 1e-2, "{conserved}");
    // Zero removes it in a few steps.
    let vibration = Vibration { frequency: 1e6, damping: 0.0 };
    let start = Scalar { q: 1.0, v: 0.0 };
    let (end, _) = Integrator::fixed(GeneralisedAlpha::new(0.0), 1.0)
        .integrate(&vibration, 0.0, 8.0, &start, &(), |_, _| ())
        .unwrap();
    println!("spectral radius 0: {end:?} after 8 steps");
    assert!(end.q.abs() < 1e-9 && end.v.abs() < 1e-9, "{end:?}");
    // A stiff damper: what is slow is as exact as ever.
    for radius in [0.0, 0.5, 1.0] {
        let damped = Vibration { frequency: 1e3, damping: 1e3 };
        let start = Scalar { q: 1.0, v: -0.500_000_125 };
        let fixed = Integrator::fixed(GeneralisedAlpha::new(radius), 0.1);
        let (end, _) = fixed.integrate(&damped, 0.0, 10.0, &start, &(), |_, _| ()).unwrap();
        println!("stiff damper, {radius}: {:e} relative", end.q * 5.0_f64.exp() - 1.0);
        assert!((end.q * 5.0_f64.exp() - 1.0).abs() < 5e-3, "{radius}: {end:?}");
    }
}

type Position<S> = <<S as System>::State as StateSpace>::Position;

/// The order seen in positions, velocities and own states together.
fn order<M: Method<S>, S: System<Scalar = f64>>(
    method: M,
    system: &S,
    start: &S::State,
    input: &S::Input,
    steps: u32,
    position: impl Fn(&Position<S>, &Position<S>) -> f64,
) -> f64 {
    let run = |n: u32| {
        let fixed = Integrator::fixed(method, 2.0 / f64::from(n));
        fixed.integrate(system, 0.5, 2.5, start, input, |_, _| ()).unwrap().0
    };
    let fine = DormandPrince::integrate(system, 0.5, start, input, 2.0 / 3000.0, 3000, |_, _| ()).unwrap();
    let error = |n: u32| distance(&run(n), &fine, &position);
    let (coarse, halved) = (error(steps), error(2 * steps));
    println!("errors {coarse:.2e} {halved:.2e}, order {:.3}", (coarse / halved).log2());
    (coarse / halved).log2()
}

#[test]
fn second_order() {
    for radius in [0.0, 0.5, 0.8, 1.0] {
        let method = GeneralisedAlpha::new(radius).functional();
        let pendulum = Pendulum { gravity: 9.81, shake: 4.0 };
        let seen = [
            order(method, &pendulum, &Scalar { q: 1.0, v: 0.5 }, &(), 400, |a, b| (a - b).abs()),
            order(method, &Body::floating(), &Body::spinning(), &(), 400, |a, b| {
                a.orientation.angle_to(&b.orientation)
            }),
            order(
                method,
                &Motor,
                &Driven { q: 0.2, v: 0.0, x: common::Currents { current: 0.0 } },
                &3.0,
                400,
                |a, b| (a - b).abs(),
            ),
            order(
                GeneralisedAlpha::new(radius),
                &Vibration { frequency: 3.0, damping: 0.1 },
                &Scalar { q: 1.0, v: 0.5 },
                &(),
                400,
                |a, b| (a - b).abs(),
            ),
        ];
        for seen in seen {
            assert!((seen - 2.0).abs() < 0.1, "{radius}: {seen}");
        }
    }
}

/// A crank rocker under gravity; `M` beyond eight repeats equations.
fn crank_rocker<const M: usize>() -> (FourBar<f64, M>, Coordinates<f64, 9>) {
    let bars = FourBar::new(9.81, [2.0, 0.8, 1.9, 1.5]);
    let guess = bars.at_angles([1.0, 0.4, 1.4], [9.0, 0.0, 0.0]);
    let free = SVector::<f64, 9>::from([0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
    let start = multibody::assemble(&bars, 0.0, &guess, &free).unwrap();
    (bars, start.state)
}

fn worst_kept<S>(method: impl Method<S>, system: &S, start: &S::State, dt: f64) -> [f64; 2]
where
    S: Constrained<Scalar = f64> + System<Input = ()>,
    S::Residual: Into<Residuals>,
{
    let mut worst = [0.0_f64; 2];
    let run = Integrator::fixed(method, dt).integrate(system, 0.0, 4.0, start, &(), |t, x| {
        let (q, _, _) = x.split();
        let (position, rate): (Residuals, Residuals) =
            (system.constraints(t, &q).into(), system.constraint_rate(t, x).into());
        worst = [worst[0].max(position.0), worst[1].max(rate.0)];
    });
    run.unwrap();
    worst
}

/// The greatest component of a residual.
struct Residuals(f64);
impl From<f64> for Residuals {
    fn from(x: f64) -> Self {
        Self(x.abs())
    }
}
impl<const N: usize> From<SVector<f64, N>> for Residuals {
    fn from(x: SVector<f64, N>) -> Self {
        Self(x.amax())
    }
}

#[test]
fn constraints_are_kept_to_rounding() {
    for radius in [0.0, 0.7, 1.0] {
        let method = GeneralisedAlpha::new(radius).constrained().functional();
        let swinging = Coordinates { q: Vector2::new(1.0, 0.0), v: Vector2::new(0.3, 2.0) };
        let rod = worst_kept(method, &Rod { gravity: 9.81, stretch: 0.3 }, &swinging, 0.02);
        let (plain, start) = crank_rocker::<8>();
        let plain = worst_kept(method, &plain, &start, 2e-3);
        let (redundant, start) = crank_rocker::<13>();
        let redundant = worst_kept(method, &redundant, &start, 2e-3);
        println!("radius {radius}: rod {rod:?}, four-bar {plain:?}, redundant {redundant:?}");
        for [position, rate] in [rod, plain, redundant] {
            assert!(position < 3e-15 && rate < 1e-13, "{position:e} {rate:e}");
        }
    }
}

#[test]
fn second_order_with_constraints() {
    // Against the same equations by a method of high order with a projection.
    fn seen<S, const N: usize>(system: &S, start: &Coordinates<f64, N>, radius: f64, steps: u32) -> [f64; 2]
    where
        S: Constrained<Scalar = f64, State = Coordinates<f64, N>>
            + Impulsive<Rates = <S as Constrained>::Residual>
            + System<Input = ()>,
    {
        let mut fine = *start;
        let h = 0.5 / 4000.0;
        for k in 0..4000 {
            let t = h * f64::from(k);
            fine = DormandPrince::step(system, t, &fine, &(), h);
            fine = Projection::default().project(system, t + h, &fine).unwrap().state;
        }
        let error = |n: u32| {
            let method = GeneralisedAlpha::new(radius).constrained().functional();
            let fixed = Integrator::fixed(method, 0.5 / f64::from(n));
            let (end, _) = fixed.integrate(system, 0.0, 0.5, start, &(), |_, _| ()).unwrap();
            [(end.q - fine.q).amax(), (end.v - fine.v).amax()]
        };
        let (coarse, halved) = (error(steps), error(2 * steps));
        println!("radius {radius}: errors {coarse:?} {halved:?}");
        [0, 1].map(|k| (coarse[k] / halved[k]).log2())
    }
    for radius in [0.0, 0.8, 1.0] {
        let swinging = Coordinates { q: Vector2::new(1.0, 0.0), v: Vector2::new(0.3, 2.0) };
        let rod = seen(&Rod { gravity: 9.81, stretch: 0.3 }, &swinging, radius, 200);
        let (bars, start) = crank_rocker::<8>();
        let bars = seen(&bars, &start, radius, 2000);
        println!("radius {radius}: orders {rod:?} {bars:?}");
        for order in rod.into_iter().chain(bars) {
            assert!((order - 2.0).abs() < 0.1, "{radius}: {order}");
        }
    }
}

/// A bob on a rigid rod, and a second mass tied to it by a spring so stiff that no step follows it.
struct Tied {
    stiffness: f64,
}

const GRAVITY: f64 = 9.81;

impl Tied {
    fn forces(&self, q: &SVector<f64, 4>) -> SVector<f64, 4> {
        let pull = Vector2::new(q[2] - q[0], q[3] - q[1]) * self.stiffness;
        SVector::from([pull.x, pull.y - GRAVITY, -pull.x, -pull.y - GRAVITY])
    }
    fn row(q: &SVector<f64, 4>) -> SMatrix<f64, 1, 4> {
        SMatrix::from([[q[0]], [q[1]], [0.0], [0.0]])
    }
}

impl System for Tied {
    type Scalar = f64;
    type State = Coordinates<f64, 4>;
    type Input = ();
    fn derivative(&self, t: f64, x: &Coordinates<f64, 4>, (): &()) -> (SVector<f64, 4>, ()) {
        let bias = -(x.v[0] * x.v[0] + x.v[1] * x.v[1]);
        (self.jump(t, x, &self.forces(&x.q), &bias).0, ())
    }
    fn position_rates(&self, _t: f64, x: &Coordinates<f64, 4>) -> SVector<f64, 4> {
        x.v
    }
}

impl Constrained for Tied {
    type Residual = f64;
    fn constraints(&self, _t: f64, q: &SVector<f64, 4>) -> f64 {
        0.5 * (q[0] * q[0] + q[1] * q[1] - 1.0)
    }
    fn constraint_rate(&self, _t: f64, x: &Coordinates<f64, 4>) -> f64 {
        (Self::row(&x.q) * x.v)[0]
    }
    fn correction(&self, _t: f64, state: &Self::State, r: &f64, w: &SVector<f64, 4>) -> (SVector<f64, 4>, f64) {
        least_norm(&Self::row(&state.q), &SVector::from([*r]), w)
    }
    fn velocity_correction(
        &self,
        t: f64,
        state: &Coordinates<f64, 4>,
        residual: &f64,
        weights: &SVector<f64, 4>,
    ) -> (SVector<f64, 4>, f64) {
        self.correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: f64, state: &Coordinates<f64, 4>, d: &SVector<f64, 4>) -> f64 {
        self.constraint_rate_along(t, state, d)
    }
}

impl Impulsive for Tied {
    type Rates = f64;
    fn jump(&self, _t: f64, state: &Self::State, impulse: &SVector<f64, 4>, rates: &f64) -> (SVector<f64, 4>, f64) {
        let g = Self::row(&state.q);
        let pull = ((g * impulse)[0] - rates) / (g * g.transpose())[0];
        (impulse - g.transpose() * pull, 1.0)
    }
}

/// By central differences: exact enough for Newton's method.
impl Differentiable for Tied {
    type Matrix = [[f64; 4]; 4];
    fn jacobian(&self, t: f64, x: &Coordinates<f64, 4>, (): &()) -> Jacobian<[[f64; 4]; 4]> {
        let column = |k: usize, q: f64, v: f64| {
            let mut y = *x;
            y.q[k] += q;
            y.v[k] += v;
            self.derivative(t, &y, &()).0
        };
        let by = |q: f64, v: f64| {
            let columns: [_; 4] = core::array::from_fn(|k| (column(k, q, v) - column(k, -q, -v)) / (2.0 * (q + v)));
            core::array::from_fn(|i| core::array::from_fn(|j| columns[j][i]))
        };
        Jacobian { position: by(1e-5, 0.0), rates: by(0.0, 1e-5) }
    }
    fn input_derivative(&self, _: f64, _: &Coordinates<f64, 4>, (): &(), (): &()) -> (SVector<f64, 4>, ()) {
        (SVector::zeros(), ())
    }
}

#[test]
fn stiff_springs_between_constrained_bodies() {
    let start = Coordinates { q: SVector::from([1.0, 0.0, 1.0 + 1e-8, 0.0]), v: SVector::zeros() };
    let tied = Tied { stiffness: 1e10 };
    let pendulum = Pendulum { gravity: GRAVITY, shake: 0.0 };
    let (want, _) = Integrator::adaptive(DormandPrince, 1e-12, 1e-12)
        .integrate(&pendulum, 0.0, 2.0, &Scalar { q: core::f64::consts::FRAC_PI_2, v: 0.0 }, &(), |_, _| ())
        .unwrap();
    let error = |dt: f64| {
        let method = GeneralisedAlpha::new(0.5).constrained();
        let mut kept = 0.0_f64;
        let run = Integrator::fixed(method, dt).integrate(&tied, 0.0, 2.0, &start, &(), |t, x| {
            kept = kept.max(tied.constraints(t, &x.q).abs()).max(0.1 * tied.constraint_rate(t, x).abs());
        });
        let (end, statistics) = run.unwrap();
        let each = f64::from(statistics.evaluations) / f64::from(statistics.accepted);
        println!("dt {dt}: constraints kept to {kept:.1e}, {each:.1} evaluations a step");
        assert!(kept < 1e-14 && (end.q[0] - end.q[2]).hypot(end.q[1] - end.q[3]) < 1e-8);
        (end.q.fixed_rows::<2>(0) - Vector2::new(want.q.sin(), -want.q.cos())).norm()
    };
    let (coarse, fine) = (error(4e-3), error(2e-3));
    println!("stiff pendulum: {coarse:.2e} {fine:.2e}, order {:.3}", (coarse / fine).log2());
    assert!(((coarse / fine).log2() - 2.0).abs() < 0.1 && coarse < 1e-3);
    // Functional iteration can't, and says so.
    let functional = Integrator::fixed(GeneralisedAlpha::new(0.5).constrained().functional(), 2e-3);
    let run = functional.integrate(&tied, 0.0, 2.0, &start, &(), |_, _| ());
    assert!(matches!(run, Err(IntegrationError::NoConvergence { .. } | IntegrationError::NonFinite { .. })), "{run:?}");
}

#[test]
fn single_precision_and_what_is_no_number() {
    let rod = Rod::<f32>::rigid();
    let start = Coordinates { q: Vector2::new(1.0_f32, 0.0), v: Vector2::zeros() };
    let method = GeneralisedAlpha::new(0.8).constrained().functional();
    let run = Integrator::fixed(method, 1e-2).integrate(&rod, 0.0, 10.0, &start, &(), |_, x| {
        assert!((x.q.norm() - 1.0).abs() < 1e-6);
    });
    run.unwrap();
    for bad in [f64::NAN, f64::INFINITY] {
        let start = Coordinates { q: Vector2::new(1.0, bad), v: Vector2::zeros() };
        assert!(
            Integrator::fixed(method, 1e-2).integrate(&Rod::<f64>::rigid(), 0.0, 1.0, &start, &(), |_, _| ()).is_err()
        );
    }
    let far = Integrator::fixed(method, 1e3).integrate(
        &Rod::<f64>::rigid(),
        0.0,
        1e6,
        &Coordinates { q: Vector2::new(1.0, 0.0), v: Vector2::zeros() },
        &(),
        |_, _| (),
    );
    println!("steps of 1000 s: {:?}", far.map(|x| x.0));
}

/// The size of an iteration's change that goes round in a circle: taken for rounding up to 4e5 roundings in double
/// precision, for which 9e-11 are still exact, and up to the root of one in single precision, 3e-4.
#[test]
fn what_stalls_above_rounding_has_not_converged() {
    fn converges<T: Real>(method: impl Method<Rubbing<T>>, circle: f64) -> bool {
        // The acceleration jumps by twice the friction, of which a step of 0.1 s makes about a tenth.
        let friction = 5.0 * circle;
        let start = Scalar { q: T::lit(0.3), v: T::lit(0.01 * friction) };
        let run =
            Integrator::fixed(method, 0.1).integrate(&Rubbing(T::lit(friction)), 0.0, 0.1, &start, &(), |_, _| ());
        match run {
            Ok(_) => true,
            Err(IntegrationError::NoConvergence { .. }) => false,
            Err(other) => panic!("{circle:e}: {other}"),
        }
    }
    fn check<T: Real>(bound: f64) {
        for radius in [0.5, 0.8] {
            let newton = GeneralisedAlpha::new(radius);
            for (share, expected) in [(1e3, false), (4.0, false), (0.25, true), (1e-2, true)] {
                let circle = share * bound;
                assert_eq!(converges::<T>(newton, circle), expected, "{radius}: {circle:e}");
                assert_eq!(converges::<T>(newton.functional(), circle), expected, "{radius}, functional: {circle:e}");
            }
        }
    }
    check::<f64>(4e5 * f64::EPSILON);
    check::<f32>(f64::from(f32::EPSILON).sqrt());
}

/// Velocities of masses between stiff springs round to what their places round to, over the step: there iterations
/// stall.
#[test]
fn what_stalls_at_the_rounding_of_stiff_springs_has_converged() {
    fn check<T: Real>(stiffness: f64, dt: f64) {
        let start = Plane { q: [T::lit(1.1), T::lit(2.1)].into(), v: [T::lit(1.0); 2].into() };
        let run = Integrator::fixed(GeneralisedAlpha::new(0.5), dt).integrate(
            &Pair(T::lit(stiffness)),
            0.0,
            100.0 * dt,
            &start,
            &(),
            |_, _| (),
        );
        let end = run.unwrap_or_else(|error| panic!("{stiffness:e} {dt:e}: {error}")).0;
        let off = (end.q.x - T::lit(1.1 + 100.0 * dt)).greatest().abs();
        assert!(off < 1e3 * T::epsilon().greatest() * (1.0 + 100.0 * dt), "{stiffness:e} {dt:e}: {off:e}");
    }
    for dt in [1e-1, 1e-2, 1e-3] {
        for stiffness in [1e4, 1e8, 1e12] {
            check::<f64>(stiffness, dt);
            check::<f32>(stiffness.sqrt(), dt);
        }
    }
}

/// The cubic within a step is as good as its ends: what it adds has an order more than what they are off by.
#[test]
fn states_within_steps_are_of_second_order() {
    fn worst<M: Method<S>, S: System<Scalar = f64, Input = ()>>(
        method: M,
        system: &S,
        start: &S::State,
        steps: u32,
        position: impl Fn(&Position<S>, &Position<S>) -> f64,
    ) -> f64 {
        const FINE: usize = 4000;
        let mut fine = vec![*start];
        let dt = 2.0 / FINE as f64;
        DormandPrince::integrate(system, 0.0, start, &(), dt, FINE as u32, |_, x| fine.push(*x)).unwrap();
        let (mut worst, mut first, each) = (0.0_f64, 0, FINE / steps as usize);
        let fixed = Integrator::fixed(method, 2.0 / f64::from(steps));
        let run = fixed.intervals(system, 0.0, 2.0, start, &(), |interval| {
            for k in [each / 5, each / 2, each * 4 / 5] {
                let state = interval.share(k as f64 / each as f64);
                worst = worst.max(distance(&state, &fine[first + k], &position));
            }
            first += each;
        });
        run.unwrap();
        worst
    }
    let order = |coarse: f64, halved: f64| {
        println!("errors within steps {coarse:.2e} {halved:.2e}, order {:.3}", (coarse / halved).log2());
        (coarse / halved).log2()
    };
    for radius in [0.0, 0.5, 0.8, 1.0] {
        let method = GeneralisedAlpha::new(radius);
        let pendulum = Pendulum { gravity: 9.81, shake: 4.0 };
        let swing = |n| {
            let start = Scalar { q: 1.0, v: 0.5 };
            worst(method.functional(), &pendulum, &start, n, |a, b| (a - b).abs())
        };
        let body = |n| {
            worst(method.functional(), &Body::floating(), &Body::spinning(), n, |a, b| {
                a.orientation.angle_to(&b.orientation)
            })
        };
        let (rod, start) =
            (Rod { gravity: 9.81, stretch: 0.3 }, Coordinates { q: Vector2::new(1.0, 0.0), v: Vector2::new(0.3, 2.0) });
        let kept = |n| worst(method.constrained().functional(), &rod, &start, n, |a, b| (a - b).amax());
        for seen in [order(swing(400), swing(800)), order(body(400), body(800)), order(kept(1000), kept(2000))] {
            assert!((seen - 2.0).abs() < 0.1, "{radius}: {seen}");
        }
    }
}
