//! Rotations: exponential, differential and normalisation against their definitions, at every size of angle.

use crate::common::{Body, rotate};
use multibody::nalgebra::{UnitQuaternion, Vector3};
use multibody::{DormandPrince, Real, Rk4, SemiImplicitEuler, rotation};

fn axis() -> Vector3<f64> {
    Vector3::new(1.0, -2.0, 0.5).normalize()
}

/// Angles from none to nearly a whole turn, close to where the series ends too.
fn angles() -> impl Iterator<Item = f64> {
    let tiny = [0.0, 5e-324, 1e-200, 1e-160, 1e-100, 1e-20, 1e-8, 0.5, 0.5 - 1e-16, 0.5 + 1e-15];
    tiny.into_iter().chain((1..125).map(|k| f64::from(k) * 0.05))
}

#[test]
fn exponential_is_the_rotation_about_an_axis() {
    for angle in angles() {
        let q = rotation::from_scaled_axis(&(axis() * angle));
        let (sin, cos) = (0.5 * angle).sin_cos();
        assert!((q.w - cos).abs() < 8e-16, "{angle}");
        let expected = axis() * sin;
        assert!(
            (q.imag() - expected).norm() <= 1e-15 * expected.norm().max((angle - 3.0).max(0.0)) + 1e-323,
            "{angle}: relative"
        );
    }
}

#[test]
fn displacement_acts_from_the_right() {
    let q = rotation::normalized(0.3, -0.5, 0.7, 0.2);
    let d = Vector3::new(0.4, -1.1, 0.6);
    let expected = q * rotation::from_scaled_axis(&d);
    assert!(rotation::displace(&q, &d).angle_to(&expected) < 1e-15);
    assert!((rotation::displace(&q, &d).as_ref() - expected.as_ref()).norm() < 4e-16);
}

/// `J(d) dexp_inv(d, v) = v`, with the right Jacobian written out.
#[test]
fn dexp_inv_inverts_the_right_jacobian() {
    let v = Vector3::new(0.3, 0.8, -1.3);
    for angle in angles().filter(|angle| *angle < 6.0) {
        let d = axis() * angle;
        let rate = rotation::dexp_inv(&d, &v);
        let dr = d.cross(&rate);
        let (b, c) = if angle < 1e-3 {
            (0.5 - angle * angle / 24.0, 1.0 / 6.0)
        } else {
            (2.0 * (0.5 * angle).sin().powi(2) / angle.powi(2), (angle - angle.sin()) / angle.powi(3))
        };
        let back = rate - dr * b + d.cross(&dr) * c;
        assert!((back - v).norm() < 2e-13, "{angle}: {:e}", (back - v).norm());
        assert!((back - v).norm() < 4e-15 || angle > 3.0, "{angle}: {:e}", (back - v).norm());
    }
}

/// The differential quotient of `exp(d(t))` is the angular velocity, in child axes.
#[test]
fn dexp_inv_is_the_rate_of_the_displacement() {
    let (d, v) = (Vector3::new(0.7, -0.2, 1.1), Vector3::new(-0.5, 1.0, 0.3));
    let h = 1e-5;
    let rate = rotation::dexp_inv(&d, &v);
    let moved = |s: f64| rotation::from_scaled_axis(&(d + rate * s));
    let turn = moved(-h).inverse() * moved(h);
    assert!((turn.imag() * 2.0 / (2.0 * h) - v).norm() < 1e-9);
}

#[test]
fn normalised_whatever_the_size() {
    for scale in [1.0, 1e-300, 1e-160, 1e160, 1e300] {
        let q = rotation::normalized(scale, -2.0 * scale, 3.0 * scale, 0.0);
        assert!((q.as_ref().norm() - 1.0).abs() < 4e-16, "{scale:e}");
        assert!((q.w - 1.0 / 14f64.sqrt()).abs() < 4e-16);
    }
    assert!(rotation::normalized(0.0_f64, 0.0, 0.0, 0.0).w.is_nan());
    assert!((rotation::normalized(1.0f32, 1.0, 1.0, 1.0).w - 0.5).abs() < 1e-7);
}

/// A million steps leave the quaternion as long as the first, and momentum, energy and path where they belong.
#[test]
fn a_million_steps() {
    let body = Body::<f64>::floating();
    let start = Body::spinning();
    let (momentum, energy) = (body.momentum(&start), body.energy(&start));
    let mut longest = 0.0f64;
    let end = Rk4::integrate(&body, 0.0, &start, &(), 1e-3, 1_000_000, |_, state| {
        let c = state.q.orientation.as_ref().coords;
        longest = longest.max((c.norm() - 1.0).abs());
    })
    .unwrap();
    assert!(longest <= 4e-16, "{longest:e}");
    assert!((body.momentum(&end) - momentum).norm() < 1e-9, "{:e}", (body.momentum(&end) - momentum).norm());
    assert!((body.energy(&end) - energy).abs() < 1e-9, "{:e}", (body.energy(&end) - energy).abs());
    assert!((end.q.position - start.v.linear * 1e3).norm() < 1e-7);
}

/// Without the Newton step the length walks away: the test above can fail.
#[test]
fn length_walks_without_renormalisation() {
    let turn = rotation::from_scaled_axis(&Vector3::new(1e-3, 2e-3, -1e-3)).into_inner();
    let mut q = turn;
    let mut longest = 0.0f64;
    for _ in 0..1_000_000 {
        q *= turn;
        longest = longest.max((q.norm() - 1.0).abs());
    }
    assert!(longest > 1e-14, "{longest:e}");
}

#[test]
fn single_precision() {
    let body = Body::<f32>::floating();
    let start = Body::spinning();
    let momentum = body.momentum(&start);
    let end = DormandPrince::integrate(&body, 0.0, &start, &(), 1e-2, 10_000, |_, _| ()).unwrap();
    assert!((end.q.orientation.as_ref().norm() - 1.0).abs() < 2.5e-7);
    assert!((body.momentum(&end) - momentum).norm() < 2e-3, "{}", (body.momentum(&end) - momentum).norm());
}

/// A body spinning about an axis of symmetry, where the exponential is the exact solution.
#[test]
fn steady_spin_is_exact() {
    let body = Body { inertia: Vector3::new(1.0, 1.0, 1.0), force: Vector3::zeros() };
    let mut start = Body::spinning();
    start.v.angular = Vector3::new(0.0, 0.0, 40.0);
    let end = SemiImplicitEuler::integrate(&body, 0.0, &start, &(), 0.1, 100, |_, _| ()).unwrap();
    let expected = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 400.0);
    assert!(end.q.orientation.angle_to(&expected) < 1e-12);
    let world = rotate(&end.q.orientation, &Vector3::x());
    assert!((world - Vector3::new(400f64.cos(), 400f64.sin(), 0.0)).norm() < 1e-12);
}

#[test]
fn whatever_the_step_nothing_panics() {
    let body = Body::<f64>::floating();
    for dt in [0.0, 5e-324, 1e-300, 1e3, 1e160, 1e300, f64::INFINITY, f64::NAN, -1.0] {
        for spin in [0.0, 1e-300, 1e200, f64::NAN] {
            let mut start = Body::spinning();
            start.v.angular = Vector3::repeat(spin);
            let end = Rk4::step(&body, 0.0, &start, &(), dt);
            let _ = SemiImplicitEuler::step(&body, 0.0, &end, &(), dt);
            let c = end.q.orientation.as_ref().norm();
            assert!(c.is_nan() || (c - 1.0).abs() < 4e-16, "{dt:e} {spin:e}: {c}");
        }
    }
    assert!(Real::greatest(rotation::dexp_inv(&Vector3::repeat(f64::NAN), &Vector3::x()).x).is_nan());
}
