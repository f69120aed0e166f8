//! The check of inertias: legal ones in any axes pass, illegal ones do not, in every precision.

use multibody::nalgebra::{Matrix3, UnitQuaternion, Vector3};
use multibody::simba::simd::{SimdBool, WideF64x4};
use multibody::{ParamError, inertia_violation};

fn violates(i: &Matrix3<f64>) -> bool {
    inertia_violation(i.m11, i.m22, i.m33, i.m12, i.m13, i.m23)
}

fn violates_single(i: &Matrix3<f64>) -> bool {
    let i = i.map(|x| x as f32);
    inertia_violation(i.m11, i.m22, i.m33, i.m12, i.m13, i.m23)
}

/// Principal moments turned into many other axes.
fn turned(moments: [f64; 3]) -> impl Iterator<Item = Matrix3<f64>> {
    (0..200).map(move |k| {
        let k = f64::from(k);
        let r = UnitQuaternion::from_scaled_axis(Vector3::new(0.1 * k, (0.7 * k).sin(), 0.02 * k)).to_rotation_matrix();
        r.matrix() * Matrix3::from_diagonal(&Vector3::from(moments)) * r.matrix().transpose()
    })
}

#[test]
fn legal_in_any_axes_and_at_any_size() {
    for moments in
        [[1.0, 1.0, 0.0], [1.0, 1.0, 2.0], [1.0, 2.0, 3.0], [1.0, 1.0, 1.0], [2.0, 3.0, 4.0], [1.0, 1.0, 1e-9]]
    {
        for size in [1.0, 1e-12, 1e12] {
            for i in turned(moments.map(|m| m * size)) {
                assert!(!violates(&i), "{moments:?} times {size}: {i}");
                assert!(!violates_single(&i), "{moments:?} times {size} in f32: {i}");
            }
        }
    }
    assert!(!violates(&Matrix3::zeros()), "a point mass");
}

#[test]
fn illegal_in_any_axes() {
    for moments in
        [[1.0, 1.0, 2.001], [1.0, 3.0, 1.0], [1.0, 0.0, 0.0], [-1.0, 1.0, 1.0], [-1.0, -1.0, -1.0], [0.0, 0.0, 1e-9]]
    {
        for i in turned(moments) {
            assert!(violates(&i), "{moments:?}: {i}");
            assert!(violates_single(&i), "{moments:?} in f32: {i}");
        }
    }
    let off_diagonal = Matrix3::new(0.0, 1e-3, 0.0, 1e-3, 0.0, 0.0, 0.0, 0.0, 0.0);
    assert!(violates(&off_diagonal));
    for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
        assert!(inertia_violation(bad, 1.0, 1.0, 0.0, 0.0, 0.0));
        assert!(inertia_violation(1.0, 1.0, bad, 0.0, 0.0, 0.0));
        assert!(inertia_violation(1.0, 1.0, 1.0, 0.0, bad, 0.0));
        assert!(inertia_violation(1.0, 1.0, 1.0, 0.0, 0.0, bad));
    }
}

/// The tolerance is 1e-9 of the trace, neither ten times more nor ten times less.
#[test]
fn the_tolerance_is_where_it_is_documented() {
    // moments (1, 1, 2 + e): the least eigenvalue is -e/2, the trace 4 + e
    let with = |e: f64| Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 2.0 + e));
    assert!(!violates(&with(7.9e-9)));
    assert!(violates(&with(8.1e-9)));
}

#[test]
fn lanes_answer_one_by_one() {
    let lanes = |v: [f64; 4]| WideF64x4::from(v);
    let zero = WideF64x4::ZERO;
    let one = WideF64x4::ONE;
    let mask = inertia_violation(one, one, lanes([1.0, 2.0, 3.0, f64::NAN]), zero, zero, zero);
    assert_eq!(mask.bitmask(), 0b1100);
}

#[test]
fn the_error_is_an_error() {
    let error: Box<dyn core::error::Error> = Box::new(ParamError { what: "no body can have the inertia of `arm`" });
    assert_eq!(error.to_string(), "no body can have the inertia of `arm`");
}
