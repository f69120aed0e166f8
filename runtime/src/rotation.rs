//! Rotations as unit quaternions: displacement by an exponential, the differential of it, and normalisation.
//!
//! Angular velocities are those of the child relative to the parent in child axes, so a displacement `d` acts from the
//! right: `q * exp(d)`, and `d/dt exp(d) = exp(d) * v` gives `v = J(d) d'` with the right Jacobian
//! `J = 1 - (1 - cos a)/a^2 [d] + (a - sin a)/a^3 [d]^2`, `a = |d|` (Hairer, Lubich and Wanner, section IV.8, with the
//! sign of the argument turned; Chirikjian, Stochastic Models, volume 2, section 10.8). [`dexp_inv`] is its inverse.
//!
//! Both functions are free of branches and smooth at zero. Small angles take a series, chosen by select; the closed
//! form then works on a literal one in place of the angle, so that neither a quotient 0/0 nor the infinite derivative
//! of a root at zero comes up, in no lane and in no dual part.

use crate::Real;
use crate::configuration::compensated_sum;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// [rad^2] below this square of an angle, series are used: all terms kept, they are exact to rounding in `f64`.
const SMALL: f64 = 0.25;
/// Below this square of a sine, three terms of the arcsine's series are exact to rounding in `f64`.
const TINY: f64 = 1e-6;

/// A polynomial with the coefficients in rising order, by Horner's rule. A macro, so that each coefficient is a literal of the
/// scalar's: an array of `f64` would be converted number by number wherever the compiler leaves the loop rolled.
macro_rules! horner {
    ($x:expr, [$last:expr] $(,)?) => { T::lit($last) };
    ($x:expr, [$first:expr, $($rest:expr),+ $(,)?] $(,)?) => { horner!($x, [$($rest),+]) * $x + T::lit($first) };
}

/// `q * exp(d)`: the rotation `q` followed by one about the axis `d`, in child axes, by the angle `|d|`.
///
/// One Newton step brings the quaternion back to unit length, so that the error does not add up over steps.
///
/// ```
/// use multibody::{nalgebra::{UnitQuaternion, Vector3}, rotation};
///
/// let q = rotation::displace(&UnitQuaternion::identity(), &Vector3::new(0.0, 0.0, 1.0));
/// assert!((q.angle() - 1.0_f64).abs() < 1e-15);
/// ```
#[inline]
pub fn displace<T: Real>(q: &UnitQuaternion<T>, d: &Vector3<T>) -> UnitQuaternion<T> {
    let (w, [x, y, z]) = exponential(d);
    let p = q.as_ref().coords;
    let (px, py, pz, pw) = (p.x, p.y, p.z, p.w);
    let qw = pw * w - px * x - py * y - pz * z;
    let qx = pw * x + px * w + py * z - pz * y;
    let qy = pw * y - px * z + py * w + pz * x;
    let qz = pw * z + px * y - py * x + pz * w;
    let newton = T::lit(1.5) - T::lit(0.5) * (qw * qw + qx * qx + qy * qy + qz * qz);
    UnitQuaternion::new_unchecked(Quaternion::new(newton * qw, newton * qx, newton * qy, newton * qz))
}

/// `q * exp(rest) * exp(d)`, and the rotation vector, in the axes of the result, that rounding left out of it.
///
/// The change of each component is small beside the component, so its sum is compensated; `exp(d) - 1` is made without
/// cancellation. `rest` is of the size of a rounding: its square is dropped.
#[inline]
pub fn advance<T: Real>(q: &UnitQuaternion<T>, d: &Vector3<T>, rest: &Vector3<T>) -> (UnitQuaternion<T>, Vector3<T>) {
    let zero = T::lit(0.0);
    let (w, [x, y, z]) = exponential(d);
    // exp(d) - 1: the real part is -2 sin^2(|d|/4), and sin^2(|d|/2) / (1 + cos(|d|/2)) is the same.
    let sine2 = x * x + y * y + z * z;
    let back = Real::lt(w, zero);
    let dw = Real::select(back, w - T::lit(1.0), -sine2 / (T::lit(1.0) + Real::select(back, zero, w)));
    // (1 + rest/2) * exp(d) - 1
    let half = T::lit(0.5);
    let (rx, ry, rz) = (half * rest.x, half * rest.y, half * rest.z);
    let dw = dw - (rx * x + ry * y + rz * z);
    let (dx, dy, dz) = (x + (rx * w + ry * z - rz * y), y + (ry * w + rz * x - rx * z), z + (rz * w + rx * y - ry * x));

    let p = q.as_ref().coords;
    let (px, py, pz, pw) = (p.x, p.y, p.z, p.w);
    let (qw, ew) = compensated_sum(pw, pw * dw - px * dx - py * dy - pz * dz);
    let (qx, ex) = compensated_sum(px, pw * dx + px * dw + py * dz - pz * dy);
    let (qy, ey) = compensated_sum(py, pw * dy - px * dz + py * dw + pz * dx);
    let (qz, ez) = compensated_sum(pz, pw * dz + px * dy - py * dx + pz * dw);

    // The unit quaternion along q + e, and what that is beside its rounding: Newton's factor is one up to roundings.
    let excess = half * (T::lit(1.0) - (qw * qw + qx * qx + qy * qy + qz * qz));
    let (nw, fw) = compensated_sum(qw, excess * qw + ew);
    let (nx, fx) = compensated_sum(qx, excess * qx + ex);
    let (ny, fy) = compensated_sum(qy, excess * qy + ey);
    let (nz, fz) = compensated_sum(qz, excess * qz + ez);
    // Twice the vector part of conjugate(n) * f.
    let two = T::lit(2.0);
    let left = Vector3::new(
        two * (nw * fx - nx * fw - ny * fz + nz * fy),
        two * (nw * fy + nx * fz - ny * fw - nz * fx),
        two * (nw * fz - nx * fy + ny * fx - nz * fw),
    );
    (UnitQuaternion::new_unchecked(Quaternion::new(nw, nx, ny, nz)), left)
}

/// The rate of the displacement `d` while the angular velocity in child axes is `v`.
///
/// `v + d x v / 2 + c d x (d x v)` with `c = (1 - a/2 cot(a/2)) / a^2`, `a = |d|`. Singular where `|d|` is a whole
/// turn, which a Runge-Kutta step comes near only if it is far too long.
///
/// ```
/// use multibody::{nalgebra::Vector3, rotation};
///
/// let (d, v) = (Vector3::new(0.0, 0.0, 0.1), Vector3::new(0.0, 0.0, 2.0));
/// assert_eq!(rotation::dexp_inv(&d, &v), v); // turning about one axis, rates are velocities
/// ```
#[inline]
pub fn dexp_inv<T: Real>(d: &Vector3<T>, v: &Vector3<T>) -> Vector3<T> {
    let a2 = square(d);
    let small = Real::lt(a2, T::lit(SMALL));
    // 1 - x cot x = x^2/3 + x^4/45 + 2 x^6/945 + ..., by powers of a^2 = 4 x^2
    let series = horner!(
        a2,
        [
            1.0 / 12.0,
            1.0 / 720.0,
            1.0 / 30_240.0,
            1.0 / 1_209_600.0,
            1.0 / 47_900_160.0,
            691.0 / 1_307_674_368_000.0,
            1.0 / 74_724_249_600.0,
        ],
    );
    let safe = Real::select(small, T::lit(1.0), a2);
    let half = T::lit(0.5) * Real::sqrt(safe);
    let (sin, cos) = Real::sin_cos(half);
    let closed = (T::lit(1.0) - half * cos / sin) / safe;
    let c = Real::select(small, series, closed);

    let dv = d.cross(v);
    v + dv * T::lit(0.5) + d.cross(&dv) * c
}

/// `log(exp(first) * exp(second))`: the displacement that does the work of two, its angle below a whole turn.
///
/// ```
/// use multibody::{nalgebra::Vector3, rotation};
///
/// let both = rotation::compose(&Vector3::new(0.0, 0.0, 0.5), &Vector3::new(0.0, 0.0, 0.75));
/// assert!((both.z - 1.25_f64).abs() < 1e-15);
/// ```
#[inline]
pub fn compose<T: Real>(first: &Vector3<T>, second: &Vector3<T>) -> Vector3<T> {
    let (aw, [ax, ay, az]) = exponential(first);
    let (bw, [bx, by, bz]) = exponential(second);
    let w = aw * bw - ax * bx - ay * by - az * bz;
    let u = Vector3::new(
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    );
    // 2 asin(s) / s = 2 + s^2/3 + 3 s^4/20 + ..
    let sine2 = square(&u);
    let small = Real::lt(sine2, T::lit(TINY)) & Real::gt(w, T::lit(0.0));
    let series = horner!(sine2, [2.0, 1.0 / 3.0, 3.0 / 20.0]);
    let sine = Real::sqrt(Real::select(small, T::lit(1.0), sine2));
    let closed = T::lit(2.0) * Real::atan2(sine, w) / sine;
    let scale = Real::select(small, series, closed);
    Vector3::new(scale * u.x, scale * u.y, scale * u.z)
}

/// The rotation by the angle `|d|` about the axis `d`.
#[inline]
pub fn from_scaled_axis<T: Real>(d: &Vector3<T>) -> UnitQuaternion<T> {
    displace(&UnitQuaternion::new_unchecked(Quaternion::new(T::lit(1.0), T::lit(0.0), T::lit(0.0), T::lit(0.0))), d)
}

/// The unit quaternion along `w + x i + y j + z k`, whatever the length of that; NaN if the length is zero or infinite.
#[inline]
pub fn normalized<T: Real>(w: T, x: T, y: T, z: T) -> UnitQuaternion<T> {
    // Divided by the greatest entry first: squares of huge entries overflow and those of tiny ones vanish.
    let greatest = Real::max(Real::max(Real::abs(w), Real::abs(x)), Real::max(Real::abs(y), Real::abs(z)));
    let (w, x, y, z) = (w / greatest, x / greatest, y / greatest, z / greatest);
    let length = Real::sqrt(w * w + x * x + y * y + z * z);
    UnitQuaternion::new_unchecked(Quaternion::new(w / length, x / length, y / length, z / length))
}

/// Real and vector part of the exponential of `d / 2`: `cos(a/2)` and `d sin(a/2) / a`.
#[inline]
fn exponential<T: Real>(d: &Vector3<T>) -> (T, [T; 3]) {
    let a2 = square(d);
    let small = Real::lt(a2, T::lit(SMALL));
    let x2 = T::lit(0.25) * a2;
    let cos_series = horner!(
        x2,
        [1.0, -1.0 / 2.0, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0, -1.0 / 3_628_800.0, 1.0 / 479_001_600.0],
    );
    let sin_series = horner!(
        x2,
        [0.5, -1.0 / 12.0, 1.0 / 240.0, -1.0 / 10_080.0, 1.0 / 725_760.0, -1.0 / 79_833_600.0, 1.0 / 12_454_041_600.0],
    );
    let angle = Real::sqrt(Real::select(small, T::lit(1.0), a2));
    let (sin, cos) = Real::sin_cos(T::lit(0.5) * angle);
    let scale = Real::select(small, sin_series, sin / angle);
    (Real::select(small, cos_series, cos), [scale * d.x, scale * d.y, scale * d.z])
}

/// `|d|^2`.
#[inline]
fn square<T: Real>(d: &Vector3<T>) -> T {
    d.x * d.x + d.y * d.y + d.z * d.z
}
