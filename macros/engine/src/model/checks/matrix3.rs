//! Stage `model`: vectors and 3x3 matrices in f64, for checks at the declared defaults.
//!
//! In: numbers. Out: products, rotations, eigenvalues of symmetric matrices by Jacobi's rotations (Golub and Van Loan,
//! section 8.5).

use super::evaluate::dot;

pub(in crate::model) type Vector3 = [f64; 3];

pub(in crate::model) type Matrix3 = [[f64; 3]; 3];

pub(super) const IDENTITY: Matrix3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

pub(in crate::model) fn add([ax, ay, az]: Vector3, [bx, by, bz]: Vector3) -> Vector3 {
    [ax + bx, ay + by, az + bz]
}

pub(in crate::model) fn sub(a: Vector3, b: Vector3) -> Vector3 {
    add(a, scale(-1.0, b))
}

pub(super) fn scale(s: f64, v: Vector3) -> Vector3 {
    v.map(|x| s * x)
}

pub(in crate::model) fn unit(v: Vector3) -> Vector3 {
    scale(1.0 / dot(v, v).sqrt(), v)
}

pub(super) fn transpose([[a, b, c], [d, e, f], [g, h, i]]: Matrix3) -> Matrix3 {
    [[a, d, g], [b, e, h], [c, f, i]]
}

pub(in crate::model) fn times(a: &Matrix3, v: Vector3) -> Vector3 {
    a.map(|row| dot(row, v))
}

pub(in crate::model) fn product(a: &Matrix3, b: &Matrix3) -> Matrix3 {
    let columns = transpose(*b);
    a.map(|row| columns.map(|column| dot(row, column)))
}

/// Turns by `angle` about `axis`, of any length but zero (Rodrigues).
pub(in crate::model) fn rotation(axis: Vector3, angle: f64) -> Matrix3 {
    let n = unit(axis);
    let (sin, cos) = angle.sin_cos();
    let [x, y, z] = n;
    let cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    let mut rows = [[0.0; 3]; 3];
    let parts = cross.into_iter().zip(n).zip(IDENTITY);
    for (row, ((cross, component), one)) in rows.iter_mut().zip(parts) {
        let along = scale((1.0 - cos) * component, n);
        *row = add(add(scale(cos, one), scale(sin, cross)), along);
    }
    rows
}

/// Eigenvalues of a symmetric matrix, in no order.
pub(in crate::model) fn eigenvalues(mut a: Matrix3) -> [f64; 3] {
    for _ in 0..12 {
        a = rotate_xy(a);
        a = cycle(a);
        a = rotate_xy(a);
        a = cycle(a);
        a = rotate_xy(a);
        a = cycle(a);
    }
    let [[x, ..], [_, y, _], [.., z]] = a;
    [x, y, z]
}

/// Zeroes the entry xy.
fn rotate_xy(a: Matrix3) -> Matrix3 {
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = a;
    if xy == 0.0 {
        return a;
    }
    let tau = (yy - xx) / (2.0 * xy);
    let t = tau.signum() / (tau.abs() + (1.0 + tau * tau).sqrt());
    let c = 1.0 / (1.0 + t * t).sqrt();
    let s = t * c;
    let (xz, yz) = (c * xz - s * yz, s * xz + c * yz);
    [[xx - t * xy, 0.0, xz], [0.0, yy + t * xy, yz], [xz, yz, zz]]
}

/// Renames x, y, z to y, z, x.
fn cycle(a: Matrix3) -> Matrix3 {
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = a;
    [[yy, yz, xy], [yz, zz, xz], [xy, xz, xx]]
}

#[cfg(test)]
mod tests {
    use super::eigenvalues;

    #[test]
    fn eigenvalues_of_a_full_matrix() {
        let mut found = eigenvalues([[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 2.0]]);
        found.sort_by(f64::total_cmp);
        let root = std::f64::consts::SQRT_2;
        for (x, y) in found.iter().zip([2.0 - root, 2.0, 2.0 + root]) {
            assert!((x - y).abs() < 1e-14, "{x} {y}");
        }
    }
}
