//! Assembly: loops that close, loops that can't, and that every call ends.

use crate::common::loops::{Coordinates, FourBar, Rod, watched};
use multibody::linear::least_norm;
use multibody::nalgebra::{SMatrix, SVector, UnitQuaternion, Vector2, Vector3};
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody::{
    AssemblyError, Configuration, Constrained, Pose, Real, StateSpace, System, Tangent, Twist, assemble, rotation,
};

/// Everything but the crank is free.
fn coupler_and_rocker<T: Real>() -> SVector<T, 9> {
    core::array::from_fn::<T, 9, _>(|i| T::lit(if i < 3 { 0.0 } else { 1.0 })).into()
}

/// Where the pin between coupler and rocker can be: two circles meet.
fn pins([ground, crank, coupler, rocker]: [f64; 4], angle: f64) -> [Vector2<f64>; 2] {
    let (a, b) = (Vector2::new(angle.cos(), angle.sin()) * crank, Vector2::new(ground, 0.0));
    let line = b - a;
    let along = (coupler.powi(2) - rocker.powi(2) + line.norm_squared()) / (2.0 * line.norm());
    let (direction, height) = (line.normalize(), (coupler.powi(2) - along.powi(2)).sqrt());
    [1.0, -1.0].map(|side| a + direction * along + Vector2::new(-direction.y, direction.x) * (side * height))
}

#[test]
fn four_bar_from_rough_guesses() {
    let lengths = [2.0, 0.8, 1.9, 1.5];
    let bars = FourBar::<f64, 8>::new(9.81, lengths);
    for k in 0..60 {
        let angle = 0.11 * f64::from(k);
        let turn = 0.7 * f64::from(k);
        let guess = bars.at_angles([angle, 0.8 * turn.sin(), 1.3 + turn.cos()], [2.0, 0.0, 0.0]);
        let done = assemble(&bars, 0.0, &guess, &coupler_and_rocker()).unwrap();
        let (q, v) = (done.state.q, done.state.v);
        assert!(q[2] == angle && v[2] == 2.0 && q[0] == guess.q[0], "the crank is held");
        let pin = Vector2::new(q[3] + 0.95 * q[5].cos(), q[4] + 0.95 * q[5].sin());
        assert!(pins(lengths, angle).iter().any(|expected| (pin - expected).norm() < 1e-11), "{k}: {pin}");
        assert!(bars.constraint_rate(0.0, &done.state).amax() < 1e-11 && done.residual < 1e-12);
        assert!(done.iterations < 40, "{}", done.iterations);
    }
}

/// All zeros: every bar in one line, where no direction leads towards closing.
#[test]
fn from_nothing() {
    let bars = FourBar::<f64, 8>::new(9.81, [2.0, 0.8, 1.9, 1.5]);
    let zero = Coordinates { q: SVector::zero(), v: SVector::zero() };
    let done = assemble(&bars, 0.0, &zero, &SVector::from([1.0; 9])).unwrap();
    assert!(bars.constraints(0.0, &done.state.q).amax() < 1e-12 && done.rank == 8.0);

    let pivot = Coordinates { q: Vector2::zero(), v: Vector2::new(1.0, 0.0) };
    let done = assemble(&Rod::<f64>::rigid(), 0.0, &pivot, &Vector2::new(1.0, 1.0)).unwrap();
    assert!((done.state.q.norm() - 1.0).abs() < 1e-12 && done.state.q.dot(&done.state.v).abs() < 1e-12);
}

#[test]
fn velocities_follow() {
    // A rod that grows: the bob keeps what is across it, and goes along as fast as it grows.
    let rod = Rod { gravity: 0.0, stretch: 0.5 };
    let guess = Coordinates { q: Vector2::new(0.0, 1.1), v: Vector2::new(3.0, 7.0) };
    let done = assemble(&rod, 0.0, &guess, &Vector2::new(1.0, 1.0)).unwrap();
    assert!((done.state.q - Vector2::new(0.0, 1.0)).norm() < 1e-12);
    assert!((done.state.v - Vector2::new(3.0, 0.5)).norm() < 1e-12);
    // Across it is held, and there is nothing else to give way.
    let guess = Coordinates { q: Vector2::new(0.0, 1.0), v: Vector2::new(3.0, 7.0) };
    let error = assemble(&rod, 0.0, &guess, &Vector2::new(1.0, 0.0)).unwrap_err();
    assert_eq!(error, AssemblyError::CannotMove { rate: 6.5, equation: 0, rank: 0, equations: 1 });
}

#[test]
fn loops_that_cannot_close() {
    let all = SVector::from([1.0; 9]);
    // The ground is longer than the three bars: 0.5 remain, and they spread over four pins.
    let bars = watched(FourBar::<f64, 8>::new(0.0, [5.0, 1.0, 2.0, 1.5]));
    for k in 0..20 {
        let turn = 0.3 * f64::from(k);
        let guess = bars.system.at_angles([turn.sin(), turn.cos(), 2.0 + turn.sin()], [1.0; 3]);
        let error = assemble(&bars, 0.0, &guess, &all).unwrap_err();
        let AssemblyError::CannotClose { residual, equations: 8, .. } = error else { panic!("{k}: {error:?}") };
        assert!((0.1..0.3).contains(&residual), "{k}: {residual}");
    }
    // At the very minimum, where the sum of squares has no slope: each of four pins open by an eighth.
    let mut flat = bars.system.at_angles([0.0, 0.0, core::f64::consts::PI], [0.0; 3]);
    for (bar, shift) in [0.125, 0.25, 0.375].into_iter().enumerate() {
        flat.q[3 * bar] += shift;
    }
    let error = assemble(&bars, 0.0, &flat, &all).unwrap_err();
    assert!(
        matches!(error, AssemblyError::CannotClose { residual, rank: 7 | 8, .. } if (residual - 0.125).abs() < 1e-3),
        "{error:?}"
    );
    assert!(bars.evaluations.get() < 22 * 100 * 16);

    // It could close, were it not held.
    let bars = FourBar::<f64, 8>::new(0.0, [2.0, 0.8, 1.9, 1.5]);
    let guess = bars.at_angles([1.0, 0.5, 1.5], [0.0; 3]);
    let error = assemble(&bars, 0.0, &guess, &SVector::zero()).unwrap_err();
    assert!(matches!(error, AssemblyError::CannotClose { rank: 0, equations: 8, .. }), "{error:?}");
    let mut held = SVector::<f64, 9>::from([1.0; 9]);
    held[2] = 0.0;
    held[8] = 0.0; // crank and rocker: one coordinate too many
    let error = assemble(&bars, 0.0, &guess, &held).unwrap_err();
    assert!(matches!(error, AssemblyError::CannotClose { rank: 7, .. }), "{error:?}");
}

#[test]
fn repeated_equations_close_too() {
    let bars = FourBar::<f64, 12>::new(9.81, [2.0, 0.8, 1.9, 1.5]);
    let guess = bars.at_angles([0.4, 0.2, 1.0], [1.0, 0.0, 0.0]);
    let done = assemble(&bars, 0.0, &guess, &SVector::from([1.0; 9])).unwrap();
    assert!(done.rank == 8.0 && done.residual < 1e-12);
}

#[test]
fn what_is_not_finite() {
    let bars = FourBar::<f64, 8>::new(9.81, [2.0, 0.8, 1.9, 1.5]);
    let good = bars.at_angles([0.4, 0.2, 1.0], [1.0, 0.0, 0.0]);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for i in 0..9 {
            let (mut q, mut v, mut free) = (good, good, SVector::<f64, 9>::from([1.0; 9]));
            q.q[i] = bad;
            v.v[i] = bad;
            assert_eq!(assemble(&bars, 0.0, &q, &free).unwrap_err(), AssemblyError::NotFinite);
            assert_eq!(assemble(&bars, 0.0, &v, &free).unwrap_err(), AssemblyError::NotFinite);
            free[i] = bad;
            assert_eq!(assemble(&bars, 0.0, &good, &free).unwrap_err(), AssemblyError::NotFinite);
        }
        let broken = FourBar::<f64, 8>::new(9.81, [bad, 0.8, 1.9, 1.5]);
        assert_eq!(assemble(&broken, 0.0, &good, &SVector::from([1.0; 9])).unwrap_err(), AssemblyError::NotFinite);
    }
}

/// Whatever the numbers, a call ends, within its bounds, in a state that is closed or in an error.
#[test]
fn every_call_ends() {
    let mut seed = 1u64;
    let mut random = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let size = 10f64.powi(((seed >> 20) % 40) as i32 - 20);
        let sign = if seed >> 63 == 0 { 1.0 } else { -1.0 };
        match (seed >> 40) % 23 {
            0 => 0.0,
            1 => 1e300 * sign,
            2 => 5e-324,
            _ => size * sign,
        }
    };
    let mut closed = 0;
    for _ in 0..300 {
        let bars = watched(FourBar::<f64, 8>::new(0.0, [random(), random(), random(), random()]));
        let guess = Coordinates { q: [0.0; 9].map(|_| random()).into(), v: [0.0; 9].map(|_| random()).into() };
        let free: SVector<f64, 9> = [0.0; 9].map(|_| random().abs()).into();
        if let Ok(done) = assemble(&bars, 0.0, &guess, &free) {
            closed += 1;
            assert!(done.state.q.iter().chain(done.state.v.iter()).all(|x| x.is_finite()));
        }
        assert!(bars.corrections.get() <= 102 && bars.evaluations.get() < 100 * 16);
    }
    println!("{closed} closed");
}

#[test]
fn single_precision_and_lanes() {
    let bars = FourBar::<f32, 8>::new(9.81, [2.0, 0.8, 1.9, 1.5]);
    let guess = bars.at_angles([0.4, 0.2, 1.0], [1.0, 0.0, 0.0]);
    let done = assemble(&bars, 0.0, &guess, &coupler_and_rocker()).unwrap();
    assert!(done.residual < 1e-5 && done.rank == 6.0);

    // Angles of the crank in lanes; each lane closes as if it were alone.
    let angles = [0.2, 1.1, 3.0, 5.0];
    let four = FourBar::<WideF64x4, 8>::new(9.81, [2.0, 0.8, 1.9, 1.5]);
    let lit = WideF64x4::lit;
    let guess = four.at_angles([WideF64x4::from(angles), lit(0.2), lit(1.0)], [lit(1.0), lit(0.0), lit(0.0)]);
    let done = assemble(&four, lit(0.0), &guess, &coupler_and_rocker()).unwrap();
    let single = FourBar::<f64, 8>::new(9.81, [2.0, 0.8, 1.9, 1.5]);
    for (lane, angle) in angles.into_iter().enumerate() {
        let guess = single.at_angles([angle, 0.2, 1.0], [1.0, 0.0, 0.0]);
        let alone = assemble(&single, 0.0, &guess, &coupler_and_rocker()).unwrap();
        for i in 0..9 {
            assert!((done.state.q[i].extract(lane) - alone.state.q[i]).abs() < 1e-12, "{lane}");
            assert!((done.state.v[i].extract(lane) - alone.state.v[i]).abs() < 1e-11, "{lane}");
        }
    }
    // One lane can't close: that is what the error is about.
    let mut long = FourBar::<WideF64x4, 8>::new(9.81, [2.0, 0.8, 1.9, 1.5]);
    long.lengths[0].replace(2, 6.0);
    let error = assemble(&long, lit(0.0), &guess, &coupler_and_rocker()).unwrap_err();
    assert!(
        matches!(error, AssemblyError::CannotClose { residual, rank: 5 | 6, equations: 8 } if residual > 0.1),
        "{error:?}"
    );
}

/// A plate on three legs of given lengths that end in a plane: rotations are coordinates too.
struct Plate {
    lengths: [f64; 6],
}

#[derive(Clone, Copy, Debug)]
struct Flight {
    q: Pose,
    v: Twist,
}

impl StateSpace for Flight {
    type Scalar = f64;
    type Position = Pose;
    type Velocity = Twist;
    type Extra = ();
    fn split(&self) -> (Pose, Twist, ()) {
        (self.q, self.v, ())
    }
    fn join(&self, q: Pose, v: Twist, (): ()) -> Self {
        Self { q, v }
    }
}

impl System for Plate {
    type Scalar = f64;
    type State = Flight;
    type Input = ();
    fn derivative(&self, _t: f64, _state: &Flight, (): &()) -> (Twist, ()) {
        (Tangent::zero(), ())
    }
    fn position_rates(&self, _t: f64, state: &Flight) -> Twist {
        state.v
    }
}

impl Plate {
    /// Foot in world axes, head in plate axes.
    fn leg(k: usize) -> (Vector3<f64>, Vector3<f64>) {
        let around = |angle: f64, radius: f64| Vector3::new(angle.cos() * radius, angle.sin() * radius, 0.0);
        let side = [1.0, -1.0][k % 2];
        let third = core::f64::consts::TAU / 3.0 * (k / 2) as f64;
        (around(third + 0.2 * side, 2.0), around(third + 0.8 * side, 0.7))
    }
    /// Foot to head, the unit vector along it, and the head from the plate's origin in plate axes.
    fn along(q: &Pose, k: usize) -> (f64, Vector3<f64>, Vector3<f64>) {
        let (foot, head) = Self::leg(k);
        let leg = q.position + q.orientation * head - foot;
        (leg.norm(), leg.normalize(), head)
    }
    fn jacobian(q: &Pose) -> SMatrix<f64, 6, 6> {
        let mut g = SMatrix::<f64, 6, 6>::zeros();
        for k in 0..6 {
            let (_, along, head) = Self::along(q, k);
            let turn = head.cross(&(q.orientation.inverse() * along));
            for i in 0..3 {
                (g[(k, i)], g[(k, 3 + i)]) = (along[i], turn[i]);
            }
        }
        g
    }
}

impl Constrained for Plate {
    type Residual = SVector<f64, 6>;
    fn constraints(&self, _t: f64, q: &Pose) -> SVector<f64, 6> {
        SVector::<f64, 6>::from_fn(|k, _| Self::along(q, k).0 - self.lengths[k])
    }
    fn constraint_rate(&self, _t: f64, state: &Flight) -> SVector<f64, 6> {
        let (l, a) = (state.v.linear, state.v.angular);
        Self::jacobian(&state.q) * SVector::from([l.x, l.y, l.z, a.x, a.y, a.z])
    }
    fn correction(&self, _t: f64, state: &Self::State, residual: &SVector<f64, 6>, weights: &Twist) -> (Twist, f64) {
        let (l, a) = (weights.linear, weights.angular);
        let weights = SVector::from([l.x, l.y, l.z, a.x, a.y, a.z]);
        let (d, rank) = least_norm(&Self::jacobian(&state.q), residual, &weights);
        (Twist { linear: Vector3::new(d[0], d[1], d[2]), angular: Vector3::new(d[3], d[4], d[5]) }, rank)
    }
    fn velocity_correction(&self, t: f64, state: &Flight, residual: &SVector<f64, 6>, weights: &Twist) -> (Twist, f64) {
        self.correction(t, state, residual, weights)
    }
    fn constraints_along(&self, t: f64, state: &Flight, d: &Twist) -> SVector<f64, 6> {
        self.constraint_rate_along(t, state, d)
    }
}

/// The pose of a Stewart platform from the lengths of its legs.
#[test]
fn pose_from_six_lengths() {
    let target = Pose {
        position: Vector3::new(0.2, -0.1, 1.4),
        orientation: rotation::from_scaled_axis(&Vector3::new(0.2, -0.3, 0.4)),
    };
    let plate = Plate { lengths: core::array::from_fn(|k| Plate::along(&target, k).0) };
    let guess = Flight {
        q: Pose { position: Vector3::new(0.0, 0.0, 1.0), orientation: UnitQuaternion::identity() },
        v: Twist { linear: Vector3::new(1.0, 0.0, 0.0), angular: Vector3::zero() },
    };
    let ones = Twist::zero().map(&mut |_: f64| 1.0);
    let done = assemble(&plate, 0.0, &guess, &ones).unwrap();
    assert!((done.state.q.position - target.position).norm() < 1e-11, "{:?}", done.state.q);
    assert!(done.state.q.orientation.angle_to(&target.orientation) < 1e-11);
    assert!((done.state.q.orientation.as_ref().norm() - 1.0).abs() < 1e-15);
    assert!(done.state.v.linear.norm() + done.state.v.angular.norm() < 1e-11, "six lengths that stay");
    assert_eq!(done.rank, 6.0);
    assert!(Configuration::<f64>::magnitude(&done.state.q).angular.x > 0.0);
}
