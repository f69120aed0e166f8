//! Equilibria and trims with known solutions, and every way in which there is none.

use crate::common::stiff::{Held, Plane, SpringPendulum, Winding, turned};
use crate::common::{Body, Currents, Driven, Flight, Scalar};
use multibody::linear::least_norm;
use multibody::nalgebra::{Vector1, Vector2, Vector3};
use multibody::simba::simd::WideF64x4;
use multibody::{
    Constrained, Differentiable, EquilibriumError, Free, Jacobian, Opening, Pose, Real, System, Tangent, Twist,
    constrained_equilibrium, equilibrium, trim,
};

/// `q'' = moment - gravity sin q - friction v`.
struct Pendulum<T> {
    gravity: T,
    friction: T,
}

impl<T: Real> System for Pendulum<T> {
    type Scalar = T;
    type State = Scalar<T>;
    type Input = T;
    fn derivative(&self, _t: T, s: &Scalar<T>, moment: &T) -> (T, ()) {
        (*moment - self.gravity * Real::sin(s.q) - self.friction * s.v, ())
    }
    fn position_rates(&self, _t: T, s: &Scalar<T>) -> T {
        s.v
    }
}

impl<T: Real> Differentiable for Pendulum<T> {
    type Matrix = [[T; 1]; 1];
    fn jacobian(&self, _t: T, s: &Scalar<T>, _: &T) -> Jacobian<[[T; 1]; 1]> {
        Jacobian { position: [[-self.gravity * Real::cos(s.q)]], rates: [[-self.friction]] }
    }
    fn input_derivative(&self, _t: T, _: &Scalar<T>, _: &T, change: &T) -> (T, ()) {
        (*change, ())
    }
}

const PENDULUM: Pendulum<f64> = Pendulum { gravity: 9.81, friction: 0.5 };

fn at(q: f64) -> Scalar<f64> {
    Scalar { q, v: 0.0 }
}

/// The same with a loop that is closed where it hangs and where it stands alone.
struct Looped(Pendulum<f64>);

impl System for Looped {
    type Scalar = f64;
    type State = Scalar<f64>;
    type Input = f64;
    fn derivative(&self, t: f64, s: &Scalar<f64>, moment: &f64) -> (f64, ()) {
        self.0.derivative(t, s, moment)
    }
    fn position_rates(&self, _t: f64, s: &Scalar<f64>) -> f64 {
        s.v
    }
    fn opening(&self, _t: f64, s: &Scalar<f64>, _: &f64) -> Opening<f64> {
        Opening::of_equation(s.q.sin(), "loop")
    }
}

impl Differentiable for Looped {
    type Matrix = [[f64; 1]; 1];
    fn jacobian(&self, t: f64, s: &Scalar<f64>, moment: &f64) -> Jacobian<[[f64; 1]; 1]> {
        self.0.jacobian(t, s, moment)
    }
    fn input_derivative(&self, _t: f64, _: &Scalar<f64>, _: &f64, change: &f64) -> (f64, ()) {
        (*change, ())
    }
}

/// Accelerations vanish where a loop is open: that is no equilibrium.
#[test]
fn open_loops_are_told() {
    let looped = Looped(PENDULUM);
    let free = Free { input: 1.0, ..Free::default() };
    assert!(equilibrium(&looped, 0.0, &at(0.3), &0.0, &1.0).is_ok());
    assert!(trim(&looped, 0.0, &at(0.0), &0.0, &free).is_ok());
    let told = equilibrium(&looped, 0.0, &at(0.3), &3.0, &1.0);
    assert!(matches!(told, Err(EquilibriumError::Open { gap, .. }) if (gap - 3.0 / 9.81).abs() < 1e-12), "{told:?}");
    let told = trim(&looped, 0.0, &at(0.5), &0.0, &free);
    assert!(matches!(told, Err(EquilibriumError::Open { .. })), "{told:?}");
}

#[test]
fn pendulum() {
    for guess in [-1.3, -0.1, 0.3, 1.2, 1.5] {
        let found = equilibrium(&PENDULUM, 0.0, &Scalar { q: guess, v: 3.0 }, &2.0, &1.0).unwrap();
        let angle = (2.0 / 9.81_f64).asin();
        println!("from {guess}: {found:?}");
        assert!((found.state.q - angle).abs() < 1e-15 && found.state.v == 0.0 && found.rank == 1.0);
        assert!(found.iterations < 10);
    }
    // Upright is one, too.
    let up = equilibrium(&PENDULUM, 0.0, &at(3.0), &0.0, &1.0).unwrap();
    assert!((up.state.q - core::f64::consts::PI).abs() < 4e-16, "{up:?}");
    // Level, no direction leads anywhere: it is shaken.
    let level = equilibrium(&PENDULUM, 0.0, &at(core::f64::consts::FRAC_PI_2), &0.0, &1.0).unwrap();
    assert!(level.state.q.sin().abs() < 1e-14, "{level:?}");
}

#[test]
fn stiff_spring() {
    for stiffness in [1e2, 1e8, 1e12] {
        let system = SpringPendulum { stiffness, damping: 1.0 };
        let guess = Plane { q: Vector2::new(0.3, -0.7), v: Vector2::zeros() };
        let found = equilibrium(&system, 0.0, &guess, &(), &Vector2::new(1.0, 1.0)).unwrap();
        println!("{stiffness:e}: {found:?}");
        assert!(found.state.q.x.abs() < 1e-14 && (found.state.q.y + 1.0 + 9.81 / stiffness).abs() < 4e-16);
        assert_eq!(found.rank, 2.0);
    }
}

/// A body turns until its spring bears the moment: `2 k sin(a/2) cos(a/2) = k sin a = M`.
#[test]
fn rotation() {
    let system = Held { body: Body::floating(), stiffness: 50.0, damping: 2.0 };
    let axis = Vector3::new(0.6, 0.0, -0.8);
    let guess = Flight { q: turned([0.9, 0.4, -0.2]), ..Body::spinning() };
    let ones = Twist { linear: Vector3::repeat(1.0), angular: Vector3::repeat(1.0) };
    let found = equilibrium(&system, 0.0, &guess, &(axis * 30.0), &ones).unwrap();
    println!("{found:?}");
    let angle = (30.0_f64 / 50.0).asin();
    let expected = turned([angle * axis.x, 0.0, angle * axis.z]);
    assert!(found.state.q.orientation.angle_to(&expected.orientation) < 1e-14 && found.rank == 6.0);
    assert!(found.state.q.position.norm() < 1e-14 && found.state.v == Twist::default());
    assert!((found.state.q.orientation.as_ref().norm() - 1.0).abs() < 4e-16);
}

#[test]
fn own_states_and_inputs() {
    let motor = Winding { inductance: 1e-3 };
    let guess = Driven { q: 0.1, v: 0.0, x: Currents { current: 0.0 } };
    let rest = equilibrium(&motor, 0.0, &guess, &3.0, &1.0).unwrap();
    println!("{rest:?}");
    assert!((rest.state.x.current - 1.5).abs() < 1e-15 && (rest.state.q - 0.75_f64.asin()).abs() < 1e-15);
    // The voltage that holds it at 0.5 rad.
    let guess = Driven { q: 0.5, ..guess };
    let states = Currents { current: 1.0 };
    let free = Free { position: 0.0, velocity: 0.0, states, input: 1.0 };
    let held = trim(&motor, 0.0, &guess, &0.0, &free).unwrap();
    println!("{held:?}");
    assert_eq!(held.state.q, 0.5);
    assert!((held.input - 4.0 * 0.5_f64.sin()).abs() < 1e-14 && held.rank == 2.0);
    // The speed that a voltage gives a shaft at that angle, with the angle held: a steady motion at that instant.
    let free = Free { position: 0.0, velocity: 1.0, states, input: 0.0 };
    let turning = trim(&motor, 0.0, &Driven { q: 0.0, ..guess }, &6.0, &free).unwrap();
    // 0.5 i = 0.1 v and 6 = 2 i + 0.5 v
    println!("{turning:?}");
    assert!((turning.state.v - 6.0 / 0.9).abs() < 1e-14 && (turning.state.x.current - 1.2 / 0.9).abs() < 1e-14);
}

/// A load on a vertical slide, `m a = force - m g`: the force that holds it, from none at all.
struct Load<T> {
    mass: T,
}

impl<T: Real> System for Load<T> {
    type Scalar = T;
    type State = Scalar<T>;
    type Input = T;
    fn derivative(&self, _t: T, _: &Scalar<T>, force: &T) -> (T, ()) {
        (*force / self.mass - T::lit(9.81), ())
    }
    fn position_rates(&self, _t: T, state: &Scalar<T>) -> T {
        state.v
    }
}

impl<T: Real> Differentiable for Load<T> {
    type Matrix = [[T; 1]; 1];
    fn jacobian(&self, _t: T, _: &Scalar<T>, _: &T) -> Jacobian<[[T; 1]; 1]> {
        Jacobian { position: [[T::lit(0.0)]], rates: [[T::lit(0.0)]] }
    }
    fn input_derivative(&self, _t: T, _: &Scalar<T>, _: &T, change: &T) -> (T, ()) {
        (*change / self.mass, ())
    }
}

/// Unknowns that are far from the guess, in any unit: each step goes no farther than twice as far, and gains its share.
#[test]
fn far_from_the_guess() {
    let free = Free { position: 0.0, velocity: 0.0, states: (), input: 1.0 };
    for mass in [1e-3, 0.5, 100.0, 1e5, 1e9] {
        let found = trim(&Load { mass }, 0.0, &at(0.0), &0.0, &free).unwrap();
        println!("{mass:e} kg: {found:?}");
        assert!((found.input / (9.81 * mass) - 1.0).abs() < 1e-14 && found.iterations < 50);
    }
    let found = trim(
        &Load { mass: 100.0_f32 },
        0.0,
        &Scalar { q: 0.0, v: 0.0 },
        &0.0,
        &Free { position: 0.0, velocity: 0.0, states: (), input: 1.0 },
    )
    .unwrap();
    assert!((found.input / 981.0 - 1.0).abs() < 1e-6);
    let wide = WideF64x4::lit;
    let load = Load { mass: WideF64x4::from([1e-2, 3.0, 100.0, 1e6]) };
    let free = Free { position: wide(0.0), velocity: wide(0.0), states: (), input: wide(1.0) };
    let found = trim(&load, wide(0.0), &Scalar { q: wide(0.0), v: wide(0.0) }, &wide(0.0), &free).unwrap();
    for (force, mass) in found.input.into_arr().into_iter().zip([1e-2, 3.0, 100.0, 1e6]) {
        assert!((force / (9.81 * mass) - 1.0).abs() < 1e-14, "{force} for {mass}");
    }
}

/// Of all that is free the least changes: weights decide between position and input.
#[test]
fn least_change() {
    let free = |position, input| Free { position, velocity: 0.0, states: (), input };
    let both = trim(&PENDULUM, 0.0, &at(0.01), &0.0, &free(1.0, 1e-6)).unwrap();
    assert!(both.input.abs() < 1e-6 && (9.81 * both.state.q.sin() - both.input).abs() < 1e-15);
    let both = trim(&PENDULUM, 0.0, &at(0.01), &0.0, &free(1e-9, 1.0)).unwrap();
    assert!((both.state.q - 0.01).abs() < 1e-6 && (9.81 * both.state.q.sin() - both.input).abs() < 1e-15);
}

/// A free body has idle coordinates, in which nothing depends on anything.
#[test]
fn idle_coordinates_stay() {
    let system = Held { body: Body::floating(), stiffness: 0.0, damping: 1.0 };
    let guess =
        Flight { q: Pose { position: Vector3::new(1.0, 2.0, 3.0), ..turned([0.1, 0.2, 0.3]) }, ..Body::spinning() };
    let ones = Twist { linear: Vector3::repeat(1.0), angular: Vector3::repeat(1.0) };
    let found = equilibrium(&system, 0.0, &guess, &Vector3::zeros(), &ones).unwrap();
    assert_eq!((found.state.q, found.rank), (guess.q, 0.0));
    let pushed = equilibrium(&system, 0.0, &guess, &Vector3::new(0.0, 0.3, 0.0), &ones);
    println!("{pushed:?}");
    assert!(matches!(pushed, Err(EquilibriumError::Singular { rank: 0, equations: 6, residual }) if residual == 0.15));
}

#[test]
fn failures() {
    // More than gravity can bear.
    let beyond = equilibrium(&PENDULUM, 0.0, &at(0.3), &12.0, &1.0);
    println!("{beyond:?}");
    assert!(matches!(
        beyond,
        Err(EquilibriumError::NotFound { residual, .. } | EquilibriumError::Singular { residual, .. })
            if (residual - 2.19).abs() < 1e-2
    ));
    // Nothing may change.
    let held = equilibrium(&PENDULUM, 0.0, &at(0.3), &0.0, &0.0);
    assert!(matches!(held, Err(EquilibriumError::Singular { rank: 0, equations: 1, .. })), "{held:?}");
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(equilibrium(&PENDULUM, 0.0, &at(bad), &0.0, &1.0), Err(EquilibriumError::NotFinite));
        assert_eq!(equilibrium(&PENDULUM, 0.0, &at(0.1), &bad, &1.0), Err(EquilibriumError::NotFinite));
        assert_eq!(equilibrium(&PENDULUM, 0.0, &at(0.1), &0.0, &bad), Err(EquilibriumError::NotFinite));
        let free = Free { position: 0.0, velocity: 0.0, states: (), input: bad };
        assert_eq!(trim(&PENDULUM, 0.0, &at(0.1), &0.0, &free), Err(EquilibriumError::NotFinite));
    }
    for error in [beyond.unwrap_err(), held.unwrap_err(), EquilibriumError::NotFinite] {
        assert!(error.to_string().len() > 20);
    }
}

#[test]
fn single_precision_and_lanes() {
    let small = Pendulum { gravity: 9.81_f32, friction: 0.5 };
    let found = equilibrium(&small, 0.0, &Scalar { q: 0.4, v: 0.0 }, &2.0, &1.0).unwrap();
    assert!((found.state.q - (2.0 / 9.81_f32).asin()).abs() < 1e-6);
    let wide = WideF64x4::lit;
    let moments = [0.0, 2.0, -5.0, 9.0];
    let lanes = Pendulum { gravity: wide(9.81), friction: wide(0.5) };
    let guess = Scalar { q: WideF64x4::from([1.0, 0.3, -1.2, 0.9]), v: wide(0.0) };
    let found = equilibrium(&lanes, wide(0.0), &guess, &WideF64x4::from(moments), &wide(1.0)).unwrap();
    for (q, moment) in found.state.q.into_arr().into_iter().zip(moments) {
        assert!((q - (moment / 9.81_f64).asin()).abs() < 1e-14, "{q} {moment}");
    }
    let one = equilibrium(&lanes, wide(0.0), &guess, &WideF64x4::from([0.0, 12.0, 0.0, 0.0]), &wide(1.0));
    assert!(one.is_err());
}

/// A bead of 1 kg on a ring of radius one, pulled by gravity along -y and by a spring to the point (2, 0).
struct Bead {
    stiffness: f64,
}

impl Bead {
    fn force(&self, q: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(self.stiffness * (2.0 - q.x), -9.81 - self.stiffness * q.y)
    }
}

impl System for Bead {
    type Scalar = f64;
    type State = Plane<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, s: &Plane<f64>, (): &()) -> (Vector2<f64>, ()) {
        let f = self.force(&s.q);
        let pull = (f.dot(&s.q) + s.v.norm_squared()) / s.q.norm_squared();
        (f - s.q * pull, ())
    }
    fn position_rates(&self, _t: f64, s: &Plane<f64>) -> Vector2<f64> {
        s.v
    }
}

impl Differentiable for Bead {
    type Matrix = [[f64; 2]; 2];
    fn jacobian(&self, _t: f64, s: &Plane<f64>, (): &()) -> Jacobian<[[f64; 2]; 2]> {
        let (f, r2) = (self.force(&s.q), s.q.norm_squared());
        let (top, k) = (f.dot(&s.q) + s.v.norm_squared(), self.stiffness);
        let delta = |i: usize, j: usize| f64::from(u8::from(i == j));
        let entry = |i: usize, j: usize| {
            let pull = (f[j] - k * s.q[j]) / r2 - top * 2.0 * s.q[j] / (r2 * r2);
            -k * delta(i, j) - delta(i, j) * top / r2 - s.q[i] * pull
        };
        Jacobian {
            position: [0, 1].map(|i| [0, 1].map(|j| entry(i, j))),
            rates: [0, 1].map(|i| [0, 1].map(|j| -2.0 * s.q[i] * s.v[j] / r2)),
        }
    }
    fn input_derivative(&self, _: f64, _: &Plane<f64>, (): &(), (): &()) -> (Vector2<f64>, ()) {
        (Tangent::zero(), ())
    }
}

impl Constrained for Bead {
    type Residual = f64;
    fn constraints(&self, _t: f64, q: &Vector2<f64>) -> f64 {
        0.5 * (q.norm_squared() - 1.0)
    }
    fn constraint_rate(&self, _t: f64, s: &Plane<f64>) -> f64 {
        s.q.dot(&s.v)
    }
    fn correction(&self, _t: f64, state: &Self::State, residual: &f64, weights: &Vector2<f64>) -> (Vector2<f64>, f64) {
        least_norm(&state.q.transpose(), &Vector1::new(*residual), weights)
    }
    fn velocity_correction(
        &self,
        t: f64,
        state: &Plane<f64>,
        residual: &f64,
        weights: &Vector2<f64>,
    ) -> (Vector2<f64>, f64) {
        self.correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: f64, state: &Plane<f64>, d: &Vector2<f64>) -> f64 {
        self.constraint_rate_along(t, state, d)
    }
}

/// At rest where the force points along the radius: towards the point (2, -9.81/k), for weights of any kind.
#[test]
fn closed_loop() {
    for stiffness in [5.0, 1e2, 1e4, 1e6, 1e8] {
        for weights in [Vector2::new(1.0, 1.0), Vector2::new(1.0, 0.01)] {
            let guess = Plane { q: Vector2::new(0.9, 0.1), v: Vector2::new(1.0, 1.0) };
            let found = constrained_equilibrium(&Bead { stiffness }, 0.0, &guess, &(), &weights).unwrap();
            println!("{found:?}");
            let expected = Vector2::new(2.0, -9.81 / stiffness).normalize();
            assert!((found.state.q - expected).norm() < 1e-14 && found.rank == 1.0 && found.iterations < 20);
        }
    }
}

/// A force that turns with the bead, and so holds it nowhere: what is missing is a zero, not an equation.
#[test]
fn closed_loop_without_equilibrium() {
    struct Pushed;
    impl System for Pushed {
        type Scalar = f64;
        type State = Plane<f64>;
        type Input = ();
        fn derivative(&self, _t: f64, s: &Plane<f64>, (): &()) -> (Vector2<f64>, ()) {
            let along = Vector2::new(-s.q.y, s.q.x);
            (along * (2.0 + s.q.x) - s.q * (s.v.norm_squared() / s.q.norm_squared()), ())
        }
        fn position_rates(&self, _t: f64, s: &Plane<f64>) -> Vector2<f64> {
            s.v
        }
    }
    impl Differentiable for Pushed {
        type Matrix = [[f64; 2]; 2];
        fn jacobian(&self, _t: f64, s: &Plane<f64>, (): &()) -> Jacobian<[[f64; 2]; 2]> {
            let (x, y) = (s.q.x, s.q.y);
            Jacobian { position: [[-y, -(2.0 + x)], [2.0 + 2.0 * x, 0.0]], rates: [[0.0; 2]; 2] }
        }
        fn input_derivative(&self, _: f64, _: &Plane<f64>, (): &(), (): &()) -> (Vector2<f64>, ()) {
            (Tangent::zero(), ())
        }
    }
    impl Constrained for Pushed {
        type Residual = f64;
        fn constraints(&self, t: f64, q: &Vector2<f64>) -> f64 {
            Bead { stiffness: 0.0 }.constraints(t, q)
        }
        fn constraint_rate(&self, t: f64, s: &Plane<f64>) -> f64 {
            Bead { stiffness: 0.0 }.constraint_rate(t, s)
        }
        fn correction(&self, t: f64, state: &Self::State, r: &f64, weights: &Vector2<f64>) -> (Vector2<f64>, f64) {
            Bead { stiffness: 0.0 }.correction(t, state, r, weights)
        }
        fn velocity_correction(
            &self,
            t: f64,
            state: &Plane<f64>,
            residual: &f64,
            weights: &Vector2<f64>,
        ) -> (Vector2<f64>, f64) {
            self.correction(t, state, residual, weights)
        }
        fn constraints_along(&self, t: f64, state: &Plane<f64>, d: &Vector2<f64>) -> f64 {
            self.constraint_rate_along(t, state, d)
        }
    }
    let guess = Plane { q: Vector2::new(0.6, 0.8), v: Vector2::zeros() };
    let moving = constrained_equilibrium(&Pushed, 0.0, &guess, &(), &Vector2::new(1.0, 1.0));
    println!("{moving:?}");
    assert!(matches!(moving, Err(EquilibriumError::NotFound { .. })));
    let held = constrained_equilibrium(&Pushed, 0.0, &guess, &(), &Vector2::zeros());
    println!("{held:?}");
    assert!(matches!(held, Err(EquilibriumError::Singular { rank: 0, equations: 1, .. })));
    // Off the ring accelerations are as small as one likes, on it their greatest component is never below 0.9.
    for q in [Vector2::new(0.01, 0.02), Vector2::new(-1.2, 0.1), Vector2::new(0.6, 0.8)] {
        let moving =
            constrained_equilibrium(&Pushed, 0.0, &Plane { q, v: Vector2::zeros() }, &(), &Vector2::new(1.0, 1.0));
        println!("{moving:?}");
        assert!(
            matches!(moving, Err(EquilibriumError::NotFound { residual, .. }) if residual > 0.9 && residual < 3.0),
            "{q}: {moving:?}"
        );
    }
    // Where the ring is never met, what is left says nothing: here nothing may move.
    let off = Plane { q: Vector2::new(-1.9, 0.1), v: Vector2::zeros() };
    let open = constrained_equilibrium(&Pushed, 0.0, &off, &(), &Vector2::zeros());
    println!("{open:?}");
    let gap = 0.5 * (1.9 * 1.9 + 0.1 * 0.1 - 1.0);
    assert!(matches!(open, Err(EquilibriumError::Open { gap: left, .. }) if (left - gap).abs() < 1e-12), "{open:?}");
}
