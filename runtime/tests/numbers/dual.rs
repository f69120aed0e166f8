//! Derivatives by dual numbers: of every function, of rotations at zero too, and of whole steps.

use crate::common::{Body, Pendulum, Scalar};
use multibody::nalgebra::{UnitQuaternion, Vector3};
use multibody::{Configuration, Real, Rk4, rotation};
use num_dual::{Dual3, Dual64, DualSVec64, HyperDual64};

/// The derivative by a central difference, in f64.
fn difference(f: impl Fn(f64) -> f64, x: f64) -> f64 {
    let h = 1e-6;
    (f(x + h) - f(x - h)) / (2.0 * h)
}

fn seed(x: f64) -> Dual64 {
    Dual64::new(x, 1.0)
}

#[test]
fn functions_of_one_variable() {
    type Pair = (fn(f64) -> f64, fn(Dual64) -> Dual64);
    let functions: [(&str, Pair); 16] = [
        ("sin", (|x| Real::sin_cos(x).0, |x| Real::sin_cos(x).0)),
        ("cos", (|x| Real::sin_cos(x).1, |x| Real::sin_cos(x).1)),
        ("tan", (Real::tan, Real::tan)),
        ("asin", (Real::asin, Real::asin)),
        ("acos", (Real::acos, Real::acos)),
        ("atan", (Real::atan, Real::atan)),
        ("sinh", (Real::sinh, Real::sinh)),
        ("cosh", (Real::cosh, Real::cosh)),
        ("tanh", (Real::tanh, Real::tanh)),
        ("exp", (Real::exp, Real::exp)),
        ("ln", (|x| Real::ln(x + 2.0), |x| Real::ln(x + 2.0))),
        ("sqrt", (|x| Real::sqrt(x + 2.0), |x| Real::sqrt(x + 2.0))),
        ("abs", (Real::abs, Real::abs)),
        ("powi", (|x| Real::powi(x, -3), |x| Real::powi(x, -3))),
        ("powf", (|x| Real::powf(x + 2.0, 1.7), |x| Real::powf(x + 2.0, Dual64::lit(1.7)))),
        ("exponent", (|x| Real::powf(2.5, x), |x| Real::powf(Dual64::lit(2.5), x))),
    ];
    for x in [-0.8, -0.31, 0.2, 0.9] {
        for (name, (f, dual)) in functions {
            let (got, want) = (dual(seed(x)), difference(f, x));
            assert!((got.re - f(x)).abs() < 1e-13, "{name}({x})");
            assert!((got.eps - want).abs() < 1e-6 * (1.0 + want.abs()), "{name}'({x}) = {}, not {want}", got.eps);
        }
        assert_eq!(Real::floor(seed(x)).eps, 0.0);
        assert_eq!(Real::signum(seed(x)).re, Real::signum(x));
    }
}

#[test]
fn powers_at_zero() {
    let contact = Real::powf(seed(0.0), Dual64::lit(1.5));
    assert_eq!((contact.re, contact.eps), (0.0, 0.0));
    let cubic = Real::powf(seed(-2.0), Dual64::lit(3.0));
    assert_eq!((cubic.re, cubic.eps), (-8.0, 12.0));
    let x = Dual3::new(2.0, 1.0, 0.0, 0.0);
    let y = Real::powf(x, Dual3::from_re(2.5));
    let expected = [2f64.powf(2.5), 2.5 * 2f64.powf(1.5), 3.75 * 2f64.powf(0.5), 1.875 * 2f64.powf(-0.5)];
    for (got, want) in [y.re, y.v1, y.v2, y.v3].into_iter().zip(expected) {
        assert!((got - want).abs() < 1e-13, "{got} {want}");
    }
}

#[test]
fn atan2_all_around() {
    for k in 0..16 {
        let angle = f64::from(k) * core::f64::consts::FRAC_PI_8 - 3.0;
        for (y, x) in [(angle.sin(), angle.cos()), (0.0, 2.0), (0.0, -2.0), (3.0, 0.0), (-3.0, 0.0)] {
            let y: DualSVec64<2> = DualSVec64::from_re(y).derivative(0);
            let x = DualSVec64::from_re(x).derivative(1);
            let got = Real::atan2(y, x);
            let gradient = got.eps.unwrap_generic(multibody::nalgebra::Const::<2>, multibody::nalgebra::U1);
            let r2 = x.re * x.re + y.re * y.re;
            assert_eq!(got.re, y.re.atan2(x.re));
            assert!((gradient[0] - x.re / r2).abs() < 1e-14 && (gradient[1] + y.re / r2).abs() < 1e-14, "{y} {x}");
        }
    }
}

/// `exp` is smooth at zero: its derivative there is the axis, its second derivative that of a cosine.
#[test]
fn displacement_at_zero() {
    for angle in [0.0, 1e-9, 0.3, 0.5, 1.2] {
        let d = Vector3::new(seed(angle), Dual64::lit(0.0), Dual64::lit(0.0));
        let q = rotation::from_scaled_axis(&d);
        assert!((q.i.eps - 0.5 * (0.5 * angle).cos()).abs() < 1e-15, "{angle}: {:?}", q.i);
        assert!((q.w.eps + 0.5 * (0.5 * angle).sin()).abs() < 1e-15, "{angle}: {:?}", q.w);
        assert_eq!((q.j.eps, q.k.eps), (0.0, 0.0));

        let h = HyperDual64::new(angle, 1.0, 1.0, 0.0);
        let q = rotation::from_scaled_axis(&Vector3::new(h, HyperDual64::lit(0.0), HyperDual64::lit(0.0)));
        assert!((q.w.eps1eps2 + 0.25 * (0.5 * angle).cos()).abs() < 1e-14, "{angle}: {:?}", q.w);

        let v = Vector3::new(0.3, -0.4, 0.5);
        let rate = |a: f64| rotation::dexp_inv(&Vector3::new(a, 0.0, 0.0), &v);
        let got = rotation::dexp_inv(&d, &v.map(Dual64::lit));
        for axis in 0..3 {
            let want = difference(|a| rate(a)[axis], angle);
            assert!((got[axis].eps - want).abs() < 1e-8, "{angle}, {axis}: {} {want}", got[axis].eps);
        }
    }
}

/// The derivative of a pendulum's position after many steps by where it started.
#[test]
fn through_an_integrator() {
    fn end<T: Real>(start: T) -> T {
        let pendulum = Pendulum { gravity: T::lit(9.81), shake: T::lit(1.0) };
        let start = Scalar { q: start, v: T::lit(0.0) };
        Rk4::integrate(&pendulum, T::lit(0.0), &start, &(), T::lit(0.01), 200, |_, _| ()).unwrap().q
    }
    let want = difference(end, 0.7);
    let got = end(seed(0.7));
    assert!((got.eps - want).abs() < 1e-7, "{} {want}", got.eps);
    assert_eq!(got.re, end(0.7));
}

/// A free body at rest, seeded in its angular velocity: no 0/0 anywhere.
#[test]
fn a_body_at_rest() {
    let body = Body::<Dual64>::floating();
    let mut start = Body::spinning();
    start.v.angular = Vector3::new(seed(0.0), Dual64::lit(0.0), Dual64::lit(0.0));
    let end = Rk4::integrate(&body, Dual64::lit(0.0), &start, &(), Dual64::lit(0.1), 10, |_, _| ()).unwrap();
    assert!((end.q.orientation.i.eps - 0.5).abs() < 1e-14, "{:?}", end.q.orientation.i);
    let q: UnitQuaternion<Dual64> = end.q.orientation;
    assert_eq!(Configuration::magnitude(&q).x.re, 1.0);
}

#[test]
fn linear_systems() {
    use multibody::linear::{least_norm, solve, solve_symmetric};
    use multibody::nalgebra::{SMatrix, SVector};

    let entry = |i: usize, j: usize, x: f64| (x + 1.3 * (i * 3 + j) as f64).sin() + if i == j { 2.0 } else { 0.0 };
    let plain = |x: f64| -> [[f64; 3]; 3] { core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j, x))) };
    let dual = |x: f64| -> [[Dual64; 3]; 3] {
        core::array::from_fn(|i| {
            core::array::from_fn(|j| Dual64::new(entry(i, j, x), (x + 1.3 * (i * 3 + j) as f64).cos()))
        })
    };
    let product = |a: [[f64; 3]; 3]| a.map(|r| a.map(|s| r.iter().zip(s).map(|(x, y)| x * y).sum::<f64>()));
    let product_of_duals =
        |a: [[Dual64; 3]; 3]| a.map(|r| a.map(|s| r.iter().zip(s).fold(Dual64::lit(0.0), |sum, (&x, y)| sum + x * y)));
    let b = [1.0, -2.0, 0.5];
    for x in [0.0, 0.4, 1.1] {
        let (general, _) = solve(dual(x), b.map(Dual64::lit));
        let (symmetric, rank) = solve_symmetric(product_of_duals(dual(x)), b.map(Dual64::lit));
        assert_eq!((rank.re, rank.eps), (3.0, 0.0));
        let g = |a: [[Dual64; 3]; 3]| SMatrix::<Dual64, 2, 3>::from_fn(|i, j| a[i][j]);
        let (least, _) = least_norm(
            &g(dual(x)),
            &SVector::from([1.0, 2.0].map(Dual64::lit)),
            &SVector::from([1.0; 3].map(Dual64::lit)),
        );
        for i in 0..3 {
            let want = difference(|x| solve(plain(x), b).0[i], x);
            assert!((general[i].eps - want).abs() < 1e-6 * (1.0 + want.abs()), "{} {want}", general[i].eps);
            let want = difference(|x| solve_symmetric(product(plain(x)), b).0[i], x);
            assert!((symmetric[i].eps - want).abs() < 1e-6 * (1.0 + want.abs()), "{} {want}", symmetric[i].eps);
            let want = difference(
                |x| {
                    let a = plain(x);
                    let g = SMatrix::<f64, 2, 3>::from_fn(|i, j| a[i][j]);
                    least_norm(&g, &SVector::from([1.0, 2.0]), &SVector::from([1.0; 3])).0[i]
                },
                x,
            );
            assert!((least[i].eps - want).abs() < 1e-6 * (1.0 + want.abs()), "{} {want}", least[i].eps);
        }
    }
}
