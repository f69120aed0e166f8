//! Impulses and impacts against closed forms and conservation laws.

use crate::common::loops::{Coordinates, FourBar, Rod};

use multibody::impact::{ImpactError, along, impact, impact_at_rate, impacts, impulse, impulse_at};

use multibody::nalgebra::{Matrix2, Matrix3x2, SVector, Vector2, Vector3};
use multibody::simba::simd::{SimdValue, WideF64x4};
use multibody::{Constrained, Impulsive, Real, System, Tangent};

/// A system with nothing but masses, one for each coordinate.
#[derive(Clone, Copy)]
struct Masses<T, const N: usize>([T; N]);

impl<T: Real, const N: usize> System for Masses<T, N> {
    type Scalar = T;
    type State = Coordinates<T, N>;
    type Input = ();
    fn derivative(&self, _t: T, _x: &Coordinates<T, N>, (): &()) -> (SVector<T, N>, ()) {
        (Tangent::zero(), ())
    }
    fn position_rates(&self, _t: T, x: &Coordinates<T, N>) -> SVector<T, N> {
        x.v
    }
}

impl<T: Real, const N: usize> Impulsive for Masses<T, N> {
    type Rates = ();
    fn jump(&self, _t: T, _state: &Self::State, impulse: &SVector<T, N>, (): &()) -> (SVector<T, N>, T) {
        (impulse.zip(&SVector::from(self.0), &mut |p, m| p / m), T::lit(0.0))
    }
}

impl<const N: usize> Masses<f64, N> {
    fn energy(&self, v: &SVector<f64, N>) -> f64 {
        (0..N).map(|i| 0.5 * self.0[i] * v[i] * v[i]).sum()
    }
}

fn moving<const N: usize>(v: [f64; N]) -> Coordinates<f64, N> {
    Coordinates { q: SVector::zeros(), v: v.into() }
}

#[test]
fn two_balls_on_a_line() {
    // Closed form: v1' = (m1 v1 + m2 v2 + m2 e (v2 - v1)) / (m1 + m2).
    let (m1, m2, v1, v2) = (2.0, 0.5, 3.0, -1.0);
    let balls = Masses([m1, m2]);
    for e in [0.0, 0.3, 1.0] {
        let hit = impact(&balls, 0.0, &moving([v1, v2]), &Vector2::new(-1.0, 1.0), e).unwrap();
        let want = [
            (m1 * v1 + m2 * v2 + m2 * e * (v2 - v1)) / (m1 + m2),
            (m1 * v1 + m2 * v2 + m1 * e * (v1 - v2)) / (m1 + m2),
        ];
        assert!((hit.state.v - Vector2::from(want)).amax() < 1e-15, "{e}: {hit:?}");
        assert!((hit.after + e * hit.before).abs() < 1e-15 && hit.before == v2 - v1);
        let lost = balls.energy(&moving([v1, v2]).v) - balls.energy(&hit.state.v);
        let reduced = m1 * m2 / (m1 + m2);
        assert!((lost - 0.5 * reduced * (1.0 - e * e) * 16.0).abs() < 1e-14);
    }
    // Parting already: nothing happens.
    let apart = impact(&balls, 0.0, &moving([-1.0, 3.0]), &Vector2::new(-1.0, 1.0), 0.5).unwrap();
    assert_eq!((apart.impulse, apart.state.v), (0.0, Vector2::new(-1.0, 3.0)));
    // A wall that comes along at 2 m/s, as seen from it.
    let wall = impact_at_rate(&Masses([m1]), 0.0, &moving([1.0]), &SVector::from([-1.0]), -2.0 - 1.0, 1.0).unwrap();
    assert!((wall.state.v[0] + 5.0).abs() < 1e-15 && wall.after == 3.0);
}

/// Two rods in a plane that hang from each other, masses and lengths one; absolute angles from the vertical.
struct Rods;

impl Rods {
    fn mass(q: &Vector2<f64>) -> Matrix2<f64> {
        let coupling = 0.5 * (q[0] - q[1]).cos();
        Matrix2::new(4.0 / 3.0, coupling, coupling, 1.0 / 3.0)
    }
    /// Of the tip, linear rows alone.
    fn jacobian(q: &Vector2<f64>) -> Matrix3x2<f64> {
        Matrix3x2::new(q[0].cos(), q[1].cos(), q[0].sin(), q[1].sin(), 0.0, 0.0)
    }
}

impl System for Rods {
    type Scalar = f64;
    type State = Coordinates<f64, 2>;
    type Input = ();
    fn derivative(&self, _t: f64, _x: &Coordinates<f64, 2>, (): &()) -> (Vector2<f64>, ()) {
        (Vector2::zeros(), ())
    }
    fn position_rates(&self, _t: f64, x: &Coordinates<f64, 2>) -> Vector2<f64> {
        x.v
    }
}

impl Impulsive for Rods {
    type Rates = ();
    fn jump(&self, _t: f64, state: &Self::State, impulse: &Vector2<f64>, (): &()) -> (Vector2<f64>, f64) {
        (Self::mass(&state.q).try_inverse().unwrap() * impulse, 0.0)
    }
}

#[test]
fn a_double_pendulum_is_struck_at_its_tip() {
    // Both rods hang: the textbook answer for a blow P at the tip is w1 = -6/7 P / (m l), w2 = 30/7 P / (m l).
    let hanging = moving([0.0, 0.0]);
    let struck = impulse_at(&Rods, 0.0, &hanging, &Rods::jacobian(&hanging.q), &Vector3::new(0.7, 0.0, 0.0)).unwrap();
    assert!((struck.state.v - Vector2::new(-0.6, 3.0)).amax() < 1e-14, "{:?}", struck.state.v);
    assert_eq!(struck.state.q, hanging.q);

    // The tip falls on a floor; what the impulse gives is what the momenta get, and no energy is gained.
    let x = Coordinates { q: Vector2::new(0.4, 1.1), v: Vector2::new(-0.8, -1.3) };
    let up: Vector2<f64> = along(&Rods::jacobian(&x.q), &Vector3::y());
    let energy = |v: &Vector2<f64>| 0.5 * (v.transpose() * Rods::mass(&x.q) * v)[0];
    for e in [0.0, 0.5, 1.0] {
        let hit = impact(&Rods, 0.0, &x, &up, e).unwrap();
        assert!(hit.impulse > 0.0 && (up.dot(&hit.state.v) + e * up.dot(&x.v)).abs() < 1e-15);
        let gained = Rods::mass(&x.q) * (hit.state.v - x.v);
        assert!((gained - up * hit.impulse).amax() < 1e-15, "only the floor pushes");
        let lost = energy(&x.v) - energy(&hit.state.v);
        assert!((lost + 0.5 * hit.impulse * (1.0 - e) * hit.before).abs() < 1e-15 && lost > -1e-15);
        let impulsive = impulse(&Rods, 0.0, &x, &(up * hit.impulse)).unwrap();
        assert!((impulsive.state.v - hit.state.v).amax() < 1e-15);
    }
}

/// The four-bar in the angle of its crank alone: its mass is the kinetic energy of a unit rate, twice.
fn reduced(bars: &FourBar<f64, 8>, x: &Coordinates<f64, 9>) -> (f64, SVector<f64, 9>) {
    // Velocities with a crank rate of one.
    let free = SVector::from([0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
    let mut unit = *x;
    unit.v = SVector::zeros();
    (unit.v[0], unit.v[1], unit.v[2]) =
        (-0.5 * bars.lengths[1] * x.q[2].sin(), 0.5 * bars.lengths[1] * x.q[2].cos(), 1.0);
    let unit = multibody::assemble(bars, 0.0, &unit, &free).unwrap().state;
    let masses = |i: usize| {
        let l = bars.lengths[i / 3 + 1];
        if i % 3 == 2 { l * l * l / 12.0 } else { l }
    };
    ((0..9).map(|i| masses(i) * unit.v[i] * unit.v[i]).sum(), unit.v)
}

#[test]
fn loops_pass_impulses_on() {
    fn check<const M: usize>() {
        let bars = FourBar::<f64, M>::new(9.81, [2.0, 0.8, 1.9, 1.5]);
        let plain = FourBar::<f64, 8>::new(9.81, [2.0, 0.8, 1.9, 1.5]);
        let guess = bars.at_angles([1.0, 0.4, 1.4], [3.0, 0.0, 0.0]);
        let free = SVector::<f64, 9>::from([0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
        let start = multibody::assemble(&bars, 0.0, &guess, &free).unwrap().state;
        let (mass, unit) = reduced(&plain, &start);
        assert!((start.v - unit * 3.0).amax() < 1e-12);

        // A blow at the coupler's middle, in multipliers and in the crank's angle.
        let mut blow = SVector::<f64, 9>::zeros();
        (blow[3], blow[4], blow[5]) = (0.3, -0.8, 0.1);
        let struck = impulse(&bars, 0.0, &start, &blow).unwrap();
        let want = 3.0 + unit.dot(&blow) / mass;
        assert_eq!(struck.rank, 8.0);
        assert!((struck.state.v - unit * want).amax() < 1e-12, "{:?}", struck.state.v - unit * want);
        assert!(bars.constraint_rate(0.0, &struck.state).amax() < 1e-13);

        // The rocker runs into a stop.
        let mut stop = SVector::<f64, 9>::zeros();
        stop[8] = -(unit[8] * 3.0).signum();
        for e in [0.0, 0.6, 1.0] {
            let hit = impact(&bars, 0.0, &start, &stop, e).unwrap();
            assert!((hit.state.v + unit * (3.0 * e)).amax() < 1e-12, "one degree of freedom turns back as a whole");
            let lost = bars.energy(&start) - bars.energy(&hit.state);
            assert!((lost - 0.5 * mass * 9.0 * (1.0 - e * e)).abs() < 1e-12);
        }
    }
    check::<8>();
    check::<13>();
}

#[test]
fn what_cannot_move_is_not_struck() {
    // A bob on a rod is struck along the rod: nothing can move there, whatever rounding says.
    let bob = Coordinates { q: Vector2::new(0.6, -0.8), v: Vector2::new(0.8, 0.6) };
    let hit = impact_at_rate(&Rod::rigid(), 0.0, &bob, &bob.q, -1.0, 0.5).unwrap();
    assert_eq!((hit.impulse, hit.state), (0.0, bob));
    let across = impact(&Rod::rigid(), 0.0, &bob, &Vector2::new(-0.8, -0.6), 0.5).unwrap();
    assert!((across.state.v + bob.v * 0.5).amax() < 1e-15 && across.rank == 1.0);
    let both = [bob.q, Vector2::new(-0.8, -0.6)];
    let several = impacts(&Rod::rigid(), 0.0, &bob, &both, 0.5).unwrap();
    assert!((several.state.v + bob.v * 0.5).amax() < 1e-15 && several.impulses[0] == 0.0);
}

#[test]
fn several_at_one_time() {
    // A ball in a corner: both walls.
    let ball = Masses([2.0, 2.0]);
    let corner = [Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)];
    let hit = impacts(&ball, 0.0, &moving([-1.0, -2.0]), &corner, 0.5).unwrap();
    assert!((hit.state.v - Vector2::new(0.5, 1.0)).amax() < 1e-15 && (hit.impulses[1] - 6.0).abs() < 1e-15);
    // Only one of them is approached.
    let hit = impacts(&ball, 0.0, &moving([1.0, -2.0]), &corner, 0.5).unwrap();
    assert!(hit.state.v == Vector2::new(1.0, 1.0) && hit.impulses[0] == 0.0);
    // A plate falls flat: height and angle, ends at both sides; one impulse in the middle does the same.
    let plate = Masses([3.0, 0.25]);
    let ends = [Vector2::new(1.0, 0.5), Vector2::new(1.0, -0.5)];
    let hit = impacts(&plate, 0.0, &moving([-2.0, 0.0]), &ends, 0.25).unwrap();
    assert!((hit.state.v - Vector2::new(0.5, 0.0)).amax() < 1e-15 && (hit.impulses[0] - 3.75).abs() < 1e-14);
    // A table with four legs: impulses are not determined, the motion is.
    let table = Masses([5.0, 0.4, 0.4]);
    let legs = [[0.5, 0.5], [0.5, -0.5], [-0.5, 0.5], [-0.5, -0.5]].map(|[a, b]| SVector::from([1.0, a, b]));
    let hit = impacts(&table, 0.0, &moving([-1.0, 0.0, 0.0]), &legs, 0.5).unwrap();
    assert!((hit.state.v - SVector::from([0.5, 0.0, 0.0])).amax() < 1e-14, "{hit:?}");
    assert!(hit.impulses.iter().all(|p| *p >= -1e-14) && (hit.impulses.iter().sum::<f64>() - 7.5).abs() < 1e-13);

    // Random ones: the law of Newton and Moreau, and no energy.
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let mut struck = 0;
    for _ in 0..300 {
        let system = Masses(core::array::from_fn::<f64, 4, _>(|_| 1.0 + 0.9 * random()));
        let x = moving::<4>(core::array::from_fn(|_| random()));
        let directions =
            core::array::from_fn::<_, 5, _>(|_| SVector::<f64, 4>::from(core::array::from_fn(|_| random())));
        let e = 0.5 + 0.5 * random();
        let hit = impacts(&system, 0.0, &x, &directions, e).unwrap();
        for i in 0..5 {
            let law = hit.after[i] + e * hit.before[i];
            assert!(hit.impulses[i] > -1e-9 && law > -1e-9 && (hit.impulses[i] * law).abs() < 1e-9, "{hit:?}");
        }
        struck += usize::from(hit.impulses.iter().filter(|p| **p > 1e-9).count() > 1);
        assert!(system.energy(&hit.state.v) <= system.energy(&x.v) * (1.0 + 1e-12));
    }
    println!("{struck} of 300 with several impulses");
    assert!(struck > 50);
}

#[test]
fn lanes_and_what_is_no_number() {
    let lanes = |v: [f64; 4]| WideF64x4::from(v);
    let balls = Masses([lanes([2.0; 4]), lanes([0.5, 1.0, 2.0, 3.0])]);
    let (v1, v2) = ([3.0, -3.0, 0.5, 1.0], [-1.0, 1.0, 0.0, 0.0]);
    let state = |v1| Coordinates { q: Tangent::zero(), v: SVector::from([lanes(v1), lanes(v2)]) };
    let (t, e) = (lanes([0.0; 4]), lanes([0.5; 4]));
    let apart = SVector::from([lanes([-1.0; 4]), lanes([1.0; 4])]);
    let four = impact(&balls, t, &state(v1), &apart, e).unwrap();
    let many = impacts(&balls, t, &state(v1), &[apart], e).unwrap();
    for lane in 0..4 {
        let single = Masses([2.0, [0.5, 1.0, 2.0, 3.0][lane]]);
        let one = impact(&single, 0.0, &moving([v1[lane], v2[lane]]), &Vector2::new(-1.0, 1.0), 0.5).unwrap();
        assert_eq!(four.impulse.extract(lane), one.impulse);
        assert!((many.impulses[0].extract(lane) - one.impulse).abs() < 1e-14);
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        // In any lane, and whatever it is that isn't finite.
        assert_eq!(impact(&balls, t, &state([3.0, -3.0, bad, 1.0]), &apart, e), Err(ImpactError::NotFinite));
        assert_eq!(impacts(&balls, t, &state([3.0, -3.0, bad, 1.0]), &[apart], e), Err(ImpactError::NotFinite));
        let (one, x, n) = (Masses([1.0]), moving([-1.0]), SVector::from([1.0]));
        for (x, n, rate, e) in [
            (moving([bad]), n, -1.0, 0.5),
            (x, SVector::from([bad]), -1.0, 0.5),
            (x, n, bad, 0.5),
            (x, n, -1.0, bad),
            (x, n, 1.0, bad),
        ] {
            assert_eq!(impact_at_rate(&one, 0.0, &x, &n, rate, e), Err(ImpactError::NotFinite));
            if rate == -1.0 {
                assert_eq!(impacts(&one, 0.0, &x, &[n], e), Err(ImpactError::NotFinite));
            }
        }
        assert_eq!(impulse(&one, 0.0, &x, &SVector::from([bad])), Err(ImpactError::NotFinite));
        assert_eq!(
            impulse_at(&one, 0.0, &x, &Vector3::new(1.0, 0.0, 0.0), &Vector3::repeat(bad)),
            Err(ImpactError::NotFinite)
        );
    }
    // Without a mass nothing holds against an impulse.
    let (massless, x, n) = (Masses([0.0]), moving([-1.0]), SVector::from([1.0]));
    assert_eq!(impulse(&massless, 0.0, &x, &n), Err(ImpactError::NotFinite));
    assert_eq!(impact(&massless, 0.0, &x, &n, 0.5), Err(ImpactError::NotFinite));
    assert_eq!(impacts(&massless, 0.0, &x, &[n], 0.5), Err(ImpactError::NotFinite));
    assert!(ImpactError::NotFinite.to_string().contains("singular"));
}

/// A ball in a wedge strikes one side, and is thrown onto the other that it was leaving: a second impact, without any gain
/// of energy.
#[test]
fn thrown_back_onto_what_it_leaves() {
    let ball = Masses([1.0, 1.0]);
    let sides = [Vector2::new(1.0, 0.0), Vector2::new(-0.8, 0.6)];
    let first = impacts(&ball, 0.0, &moving([1.0, 0.0]), &sides, 1.0).unwrap();
    assert!((first.state.v - Vector2::new(-0.28, 0.96)).amax() < 1e-15, "{first:?}");
    assert!(first.impulses[0] == 0.0 && (first.after[0] + 0.28).abs() < 1e-15);
    let second = impacts(&ball, 0.0, &first.state, &sides, 1.0).unwrap();
    assert!((second.state.v - Vector2::new(0.28, 0.96)).amax() < 1e-15, "{second:?}");
    assert!(second.after.iter().all(|&rate| rate > 0.0));
    assert!((ball.energy(&second.state.v) - 0.5).abs() < 1e-15);
}
